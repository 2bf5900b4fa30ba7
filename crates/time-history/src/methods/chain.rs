//! Terms of the Taylor series of buildings with tridiagonal matrices.

use pounding_vectorised::vectorised;

use crate::bands::Bands;
use crate::system::{System, Terms};

/// Terms at most; ten to twenty reach round-off for steps below a sixth of the
/// shortest period.
pub(crate) const TERMS: usize = 60;
/// Terms smaller than this (m, m/s) end the series.
const NEGLIGIBLE: (f64, f64) = (1.0e-18, 1.0e-17);

/// A closed contact, or a storey or link on a straight branch of its law, whose force is
/// `at_rest + stiffness u + dashpot v`, with the displacement `u` and velocity `v` of its
/// left floor relative to its right one. What the matrices of the buildings carry of an
/// element is left out.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spring {
    /// The level of a contact; of no use for an element.
    pub level: usize,
    /// The element; of no use for a contact.
    pub element: usize,
    pub left: Option<usize>,
    pub right: Option<usize>,
    pub at_rest: f64,
    pub stiffness: f64,
    pub dashpot: f64,
}

impl Spring {
    /// Its force from term number `k - 1`.
    pub(crate) fn term(&self, k: usize, u: f64, v: f64) -> f64 {
        let constant = if k == 1 { self.at_rest } else { 0.0 };
        constant + self.stiffness * u + self.dashpot * v
    }

    /// What its relative displacement holds beside both floors.
    pub(crate) fn terms<'s>(&self, system: &'s System) -> &'s Terms {
        match system.levels().get(self.level) {
            Some(level) => &level.terms,
            None => &system.elements()[self.element].terms,
        }
    }

    /// Adds the force from term number `k - 1`, with these further terms, to all that it acts on.
    pub(crate) fn push_weighted(
        &self,
        k: usize,
        (u, v): (&[f64], &[f64]),
        terms: &Terms,
        out: &mut [f64],
    ) {
        let at = |x: &[f64], floor: Option<usize>| floor.map_or(0.0, |i| x[i]);
        let relative = |x: &[f64]| at(x, self.left) - at(x, self.right) + terms.sum_of(|i| x[i]);
        let force = self.term(k, relative(u), relative(v));
        if let Some(l) = self.left {
            out[l] -= force;
        }
        if let Some(r) = self.right {
            out[r] += force;
        }
        terms.push(force, out);
    }

    /// Adds that force, times a factor of the floor, to its floors: it pushes them apart.
    /// Displacements and velocities stand from the place `first` on.
    #[inline(always)]
    pub(crate) fn push(
        &self,
        (k, first): (usize, usize),
        (u, v): (&[f64], &[f64]),
        factor: impl Fn(usize) -> f64,
        out: &mut [f64],
    ) {
        let at = |x: &[f64], floor: Option<usize>| floor.map_or(0.0, |i| x[first + i]);
        let relative = |x: &[f64]| at(x, self.left) - at(x, self.right);
        let force = self.term(k, relative(u), relative(v));
        if let Some(l) = self.left {
            out[l] -= force * factor(l);
        }
        if let Some(r) = self.right {
            out[r] += force * factor(r);
        }
    }
}

/// Sums of the terms, for theta = 1.
#[derive(Debug, Clone)]
pub(crate) struct Sums {
    pub displacement: Vec<f64>,
    pub velocity: Vec<f64>,
    /// Integral of the displacement over theta.
    pub integral: Vec<f64>,
    /// Three derivatives of the velocity with respect to theta, at both ends.
    pub start: [Vec<f64>; 3],
    pub end: [Vec<f64>; 3],
}

impl Sums {
    pub(crate) fn new(dofs: usize) -> Self {
        let zeros = || vec![0.0; dofs];
        Self {
            displacement: zeros(),
            velocity: zeros(),
            integral: zeros(),
            start: [zeros(), zeros(), zeros()],
            end: [zeros(), zeros(), zeros()],
        }
    }

    /// Takes the term of order zero.
    pub(crate) fn begin(&mut self, u: &[f64], v: &[f64]) {
        self.displacement.copy_from_slice(u);
        self.velocity.copy_from_slice(v);
        self.integral.copy_from_slice(u);
        for end in &mut self.end {
            end.fill(0.0);
        }
    }

    /// Takes a further term; returns whether the next ones are negligible.
    #[inline(always)]
    pub(crate) fn add(&mut self, k: usize, u: &[f64], v: &[f64]) -> bool {
        let n = u.len();
        let order = k as f64;
        let inverse = 1.0 / (order + 1.0);
        let [first, second] = [order, order * (order - 1.0)];
        let third = second * (order - 2.0);
        accumulate(&mut self.displacement[..n], u, 1.0);
        accumulate(&mut self.velocity[..n], v, 1.0);
        accumulate(&mut self.integral[..n], u, inverse);
        for (end, factor) in self.end.iter_mut().zip([first, second, third]) {
            accumulate(&mut end[..n], v, factor);
        }
        if k <= 3 {
            let factorial = [1.0, 2.0, 6.0][k - 1];
            for (start, v) in self.start[k - 1].iter_mut().zip(v) {
                *start = factorial * v;
            }
        }
        let largest = |x: &[f64]| x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        k > 3 && largest(u) < NEGLIGIBLE.0 && largest(v) < NEGLIGIBLE.1
    }
}

#[inline(always)]
fn accumulate(sum: &mut [f64], x: &[f64], factor: f64) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += factor * x;
    }
}

/// All buildings as one chain without links between them; matrices over masses.
#[derive(Debug, Clone)]
pub(crate) struct Chain {
    /// Over the masses.
    bands: Bands,
    inverse_mass: Vec<f64>,
    /// Present term, with a zero on either side.
    u: Vec<f64>,
    v: Vec<f64>,
    acceleration: Vec<f64>,
    pub sums: Sums,
}

impl Chain {
    /// `None` if a building's damping matrix is not tridiagonal.
    pub(crate) fn new(system: &System) -> Option<Self> {
        let n = system.degrees_of_freedom();
        let terms = system.elements().iter().map(|e| &e.terms);
        if !system.is_plain() || !terms.into_iter().all(Terms::is_empty) {
            return None;
        }
        let mut bands = system.bands()?.clone();
        bands.divide(system.mass());
        Some(Self {
            bands,
            inverse_mass: system.mass().iter().map(|m| 1.0 / m).collect(),
            u: vec![0.0; n + 2],
            v: vec![0.0; n + 2],
            acceleration: vec![0.0; n],
            sums: Sums::new(n),
        })
    }

    /// Sums the series from displacements and velocities `start`; `load` holds the
    /// ground acceleration and its change over the step. Returns the number of terms.
    pub(crate) fn sum(
        &mut self,
        springs: &[Spring],
        load: [f64; 2],
        h: f64,
        start: (&[f64], &[f64]),
    ) -> u64 {
        let n = self.acceleration.len();
        self.u[1..=n].copy_from_slice(start.0);
        self.v[1..=n].copy_from_slice(start.1);
        self.sums.begin(start.0, start.1);
        series(self, springs, load, h)
    }
}

#[vectorised]
fn series(chain: &mut Chain, springs: &[Spring], load: [f64; 2], h: f64) -> u64 {
    let n = chain.acceleration.len();
    for k in 1..TERMS {
        let a = &mut chain.acceleration[..n];
        chain.bands.resist(&chain.u, &chain.v, a);
        for spring in springs {
            let (motion, inverse_mass) = ((&*chain.u, &*chain.v), &chain.inverse_mass);
            spring.push((k, 1), motion, |i| inverse_mass[i], a);
        }
        let ground = load.get(k - 1).copied().unwrap_or(0.0);
        let scale = h / k as f64;
        let (u, v) = (&mut chain.u[1..=n], &mut chain.v[1..=n]);
        for i in 0..n {
            u[i] = scale * v[i];
        }
        for i in 0..n {
            v[i] = scale * (a[i] - ground);
        }
        if chain.sums.add(k, u, v) {
            return k as u64;
        }
    }
    TERMS as u64
}
