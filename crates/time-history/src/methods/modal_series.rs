//! Terms of the Taylor series in the coordinates of the modes, for large buildings whose
//! damping matrix is full: a term then costs a few operations a mode, where the damping
//! forces of the floors would cost the square of their number.

use super::chain::{Spring, Sums, TERMS};
use crate::polynomial::{Polynomial, derivative, septic, value};
use crate::system::System;
use crate::system::modes::{
    ContactFree, Four, Lane, LevelRows, WIDTH, gather, spread, transform, transform_fours,
};

/// Floors (all buildings together) above which terms are computed in the modes.
pub(crate) const LARGE: usize = 100;

/// Terms smaller than this end the series, in the unit of the modes (m sqrt(kg), and that
/// over s): those of a floor are smaller by the square root of its mass.
const NEGLIGIBLE: (f64, f64) = (1.0e-18, 1.0e-17);

/// Sums of the terms in the modes, in the order of [`Sums`].
const SUMS: usize = 9;

/// A state of the floors with that of the modes.
#[derive(Debug, Clone)]
struct Known {
    floors: Vec<f64>,
    modes: [Vec<Lane>; 2],
}

/// Work space of the series.
#[derive(Debug, Clone)]
pub(crate) struct ModalSeries {
    rows: LevelRows,
    /// Start and end of the last step: transformed there and back again at every step, a
    /// state would gather round-off.
    known: [Known; 2],
    term: [Vec<Lane>; 2],
    acceleration: Vec<Lane>,
    sums: [Vec<Lane>; SUMS],
    floors: [[Vec<Lane>; 4]; 2],
    all: Vec<bool>,
    /// Velocity of every mode over the step, and its `2 zeta omega`.
    speed: Vec<Polynomial>,
    damping: Vec<f64>,
}

impl ModalSeries {
    /// `None` where buildings are small, where modes are coupled, or where storeys and links
    /// follow laws.
    pub(crate) fn new(system: &System) -> Option<Self> {
        let n = system.degrees_of_freedom();
        if n <= LARGE || system.bands().is_some() || !system.elements().is_empty() {
            return None;
        }
        let constants = system.contact_free()?;
        let lanes = constants.modes.len();
        let zeros = || vec![Lane::ZERO; lanes];
        let known = || Known {
            floors: vec![f64::NAN; 2 * n],
            modes: [zeros(), zeros()],
        };
        Some(Self {
            rows: LevelRows::new(&constants.rows, system),
            known: [known(), known()],
            term: [zeros(), zeros()],
            acceleration: zeros(),
            sums: std::array::from_fn(|_| zeros()),
            floors: std::array::from_fn(|_| std::array::from_fn(|_| zeros())),
            all: vec![true; lanes],
            speed: vec![Polynomial::default(); n],
            damping: (0..n)
                .map(|i| constants.modes[i / WIDTH].damping[i % WIDTH])
                .collect(),
        })
    }

    /// Sums the series from the displacements and velocities `start`; `load` holds the
    /// ground acceleration and its change over the step. Returns the number of terms.
    pub(crate) fn sum(
        &mut self,
        constants: &ContactFree,
        contacts: &[Spring],
        (load, h): ([f64; 2], f64),
        start: &[f64],
        out: &mut Sums,
    ) -> u64 {
        self.begin(constants, start);
        let mut terms = TERMS;
        for k in 1..TERMS {
            let ground = load.get(k - 1).copied().unwrap_or(0.0);
            if self.add_term(constants, contacts, k, (ground, h)) {
                terms = k;
                break;
            }
        }
        self.write_floors(constants, out);
        let (n, end) = (out.displacement.len(), &mut self.known[1]);
        end.floors[..n].copy_from_slice(&out.displacement);
        end.floors[n..].copy_from_slice(&out.velocity);
        for (known, sum) in end.modes.iter_mut().zip(&self.sums) {
            known.copy_from_slice(sum);
        }
        self.interpolate();
        terms as u64
    }

    /// Takes the start of the step, and the term of order zero.
    fn begin(&mut self, constants: &ContactFree, start: &[f64]) {
        if self.known[1].floors == start {
            self.known.swap(0, 1);
        } else if self.known[0].floors != start {
            let n = start.len() / 2;
            let known = &mut self.known[0];
            known.floors.copy_from_slice(start);
            for (modes, floors) in known.modes.iter_mut().zip(start.chunks(n)) {
                spread(floors, &mut self.floors[0][0]);
                transform(&constants.inverse, &self.floors[0][0], modes);
            }
        }
        let [q, p] = &self.known[0].modes;
        self.term[0].copy_from_slice(q);
        self.term[1].copy_from_slice(p);
        for sum in &mut self.sums {
            sum.fill(Lane::ZERO);
        }
        for (sum, first) in self.sums.iter_mut().zip([q, p, q]) {
            sum.copy_from_slice(first);
        }
    }

    /// Adds term `k`; returns whether the next ones are negligible.
    fn add_term(
        &mut self,
        constants: &ContactFree,
        contacts: &[Spring],
        k: usize,
        (ground, h): (f64, f64),
    ) -> bool {
        let [q, p] = &mut self.term;
        for (c, m) in constants.modes.iter().enumerate() {
            self.acceleration[c] = Lane::from_fn(|l| {
                -(m.stiffness[l] * q[c][l] + m.damping[l] * p[c][l]) - m.participation[l] * ground
            });
        }
        for contact in contacts {
            let row = &self.rows.levels[contact.level];
            let force = contact.term(k, row.dot(q), row.dot(p));
            row.add(-force, &mut self.acceleration);
        }
        let order = k as f64;
        let scale = h / order;
        let [second, third] = [order * (order - 1.0), order * (order - 1.0) * (order - 2.0)];
        let factors = [1.0, 1.0, 1.0 / (order + 1.0)];
        let mut largest = [0.0_f64; 2];
        for c in 0..q.len() {
            let (a, b) = (
                p[c].map(|x| scale * x),
                self.acceleration[c].map(|x| scale * x),
            );
            (q[c], p[c]) = (a, b);
            let mut add = |place: usize, factor: f64, x: &Lane| {
                let sum = &mut self.sums[place][c];
                for l in 0..WIDTH {
                    sum[l] += factor * x[l];
                }
            };
            for (place, (factor, x)) in factors.iter().zip([&a, &b, &a]).enumerate() {
                add(place, *factor, x);
            }
            for (place, factor) in [order, second, third].into_iter().enumerate() {
                add(6 + place, factor, &b);
            }
            if k <= 3 {
                add(2 + k, [1.0, 2.0, 6.0][k - 1], &b);
            }
            for l in 0..WIDTH {
                largest[0] = largest[0].max(a[l].abs());
                largest[1] = largest[1].max(b[l].abs());
            }
        }
        k > 3 && largest[0] < NEGLIGIBLE.0 && largest[1] < NEGLIGIBLE.1
    }

    /// Sums of the floors from those of the modes.
    fn write_floors(&mut self, constants: &ContactFree, out: &mut Sums) {
        let [d, v, integral, s0, s1, s2, e0, e1, e2] = &self.sums;
        let shapes = &constants.shapes;
        let ([os0, os1, os2], [oe0, oe1, oe2]) = (&mut out.start, &mut out.end);
        let wanted = self.all.as_slice();
        let [first, second] = &mut self.floors;
        let fours = &mut [
            Four {
                modal: [d, v, integral, s0],
                floors: &mut *first,
                wanted,
            },
            Four {
                modal: [s1, s2, e0, e1],
                floors: &mut *second,
                wanted,
            },
        ];
        transform_fours(shapes, fours);
        let outs = [
            &mut out.displacement,
            &mut out.velocity,
            &mut out.integral,
            os0,
            os1,
            os2,
            oe0,
            oe1,
        ];
        for (floors, out) in first.iter().chain(second.iter()).zip(outs) {
            gather(floors, out);
        }
        transform(shapes, e2, &mut first[0]);
        gather(&first[0], oe2);
    }

    fn interpolate(&mut self) {
        let at = |lanes: &[Lane], i: usize| lanes[i / WIDTH][i % WIDTH];
        let speed = &self.known[0].modes[1];
        for (i, polynomial) in self.speed.iter_mut().enumerate() {
            let [start, end] = [3, 6].map(|first| {
                let from = |k: usize| at(&self.sums[first + k], i);
                [from(0), from(1), from(2)]
            });
            *polynomial = septic(
                [at(speed, i), start[0], start[1], start[2]],
                [at(&self.sums[1], i), end[0], end[1], end[2]],
            );
        }
    }

    /// The same with two derivatives by theta.
    pub(crate) fn viscous_powers(&self, theta: f64) -> [f64; 3] {
        let mut powers = [0.0; 3];
        for (damping, p) in self.damping.iter().zip(&self.speed) {
            let first = derivative(p);
            let (v, v1) = (value(p, theta), value(&first, theta));
            let v2 = value(&derivative(&first), theta);
            powers[0] += damping * v * v;
            powers[1] += 2.0 * damping * v * v1;
            powers[2] += 2.0 * damping * (v1 * v1 + v * v2);
        }
        powers
    }

    /// Power of the damping (W) at a part of the last step.
    pub(crate) fn viscous_power(&self, theta: f64) -> f64 {
        let powers = self.damping.iter().zip(&self.speed).map(|(damping, p)| {
            let speed = value(p, theta);
            damping * speed * speed
        });
        powers.sum()
    }
}
