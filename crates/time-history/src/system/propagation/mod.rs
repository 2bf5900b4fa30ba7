//! Exact steps for buildings that are no sums of oscillators: damping that couples modes,
//! coordinates that are no floors, several ground motions.
//!
//! Without contact every building is linear under a load that is linear in time, so that one
//! matrix leads from start to end of an interval between samples, or of a half, a quarter of it and so on
//! ([`building`]). With contacts whose laws are affine the buildings are linear together, and a
//! Taylor series leads over a step ([`contact_series`]).
//!
//! Nothing may be missed inside a step. A function that is a row `w` over the displacements lies
//! near the cubic with its values and slopes at both ends, by less than `h^4/384` times the bound
//! of its fourth derivative, and near the polynomial of degree 7 with three derivatives at both
//! ends by less than `h^8/(8! 256)` times that of its eighth (Hermite's remainders). The bounds follow
//! from energy: derivatives of the motion obey the equation of motion themselves, from the second
//! one on without load, so that with `C` positive semi-definite `x' M x + y' K y` of a derivative
//! `y` and its rate `x` never grows, and `|w' x| <= sqrt(w' M^-1 w) sqrt(x' M x)`.

mod building;
mod contact_series;
mod product;
mod whole_interval;

use nalgebra::DMatrix;

use crate::system::{Segment, System};
use building::Building;
pub(crate) use contact_series::{AffineContact, ContactSeries, SeriesTerms};
pub(crate) use product::{NARROW, RowBlocks, padded};
pub(crate) use whole_interval::Courses;

/// Lengths of intervals for which matrices are kept.
const LENGTHS: usize = 4;
/// How often an interval can be halved at least: of buildings in which a part of the motion dies out faster, more often.
pub(crate) const HALVINGS: usize = 6;
/// Lengths closer than this, relative to each other, are one.
const SAME: f64 = 1.0e-9;

/// Orders of derivatives that are known at both ends of a step, from zero.
pub(crate) const ORDERS: usize = 6;
/// First order of which there are bounds over a step, and the one after the last.
pub(crate) const BOUNDED: std::ops::Range<usize> = 4..11;

/// Matrices of all buildings.
#[derive(Debug, Clone)]
pub(crate) struct Propagation {
    buildings: Vec<Building>,
    lengths: Vec<f64>,
    pub ends: Ends,
    /// Whether they are those of a series.
    by_series: bool,
}

/// The motion at both ends of a step, and bounds over it.
#[derive(Debug, Clone)]
pub(crate) struct Ends {
    /// Length (s).
    pub length: f64,
    /// Derivatives of the displacements relative to the ground with respect to time, of order
    /// zero to five, by degree of freedom.
    pub start: [Vec<f64>; ORDERS],
    pub end: [Vec<f64>; ORDERS],
    /// The second and third with what the ground adds: absolute acceleration and its rate.
    pub absolute_start: [Vec<f64>; 2],
    pub absolute_end: [Vec<f64>; 2],
    /// Bounds of the derivatives by building and order, for a row with `w' M^-1 w = 1`.
    pub bounds: Vec<[f64; BOUNDED.end]>,
    /// Works over the step (J).
    pub input: f64,
    pub viscous: f64,
}

impl Ends {
    fn new(buildings: usize) -> Self {
        Self {
            length: 0.0,
            start: std::array::from_fn(|_| Vec::new()),
            end: std::array::from_fn(|_| Vec::new()),
            absolute_start: std::array::from_fn(|_| Vec::new()),
            absolute_end: std::array::from_fn(|_| Vec::new()),
            bounds: vec![[0.0; BOUNDED.end]; buildings],
            input: 0.0,
            viscous: 0.0,
        }
    }

    fn resize(&mut self, dofs: usize) {
        let relative = self.start.iter_mut().chain(&mut self.end);
        let absolute = (self.absolute_start.iter_mut()).chain(&mut self.absolute_end);
        for values in relative.chain(absolute) {
            values.resize(dofs, 0.0);
        }
    }
}

impl Propagation {
    /// `None` for large buildings, and where the bounds would not hold. Elements with memory are
    /// not looked at.
    pub(crate) fn new(system: &System) -> Option<Self> {
        let lengths = lengths(system);
        let buildings: Option<Vec<_>> = (0..system.buildings().len())
            .map(|index| Building::new(system, index, &lengths))
            .collect();
        let buildings = buildings?;
        Some(Self {
            ends: Ends::new(buildings.len()),
            by_series: false,
            buildings,
            lengths,
        })
    }

    /// The same for a system that may have other displacements of the ground.
    pub(crate) fn for_system(&self, system: &System) -> Self {
        let mut this = self.clone();
        this.ends.resize(system.degrees_of_freedom());
        this
    }

    /// How often an interval of this length can be halved in this building: at the end, derivatives of the motion are those of a
    /// step within the reach of its series, whatever dies out in it.
    pub(crate) fn halvings(&self, which: usize, building: usize) -> usize {
        self.buildings[building].halvings(which)
    }

    /// The most of all buildings and lengths.
    pub(crate) fn most_halvings(&self) -> usize {
        let lengths = 0..self.lengths.len();
        let of = |building| {
            lengths
                .clone()
                .map(move |which| self.halvings(which, building))
        };
        (0..self.buildings.len()).flat_map(of).max().unwrap_or(0)
    }

    /// A series for contacts of a system with these buildings.
    pub(crate) fn contact_series(&self, system: &System) -> ContactSeries {
        ContactSeries::new(system, &self.buildings)
    }

    /// The length with matrices of an interval of this length (s).
    pub(crate) fn known_length(&self, length: f64) -> Option<usize> {
        let same = |known: &f64| (known - length).abs() <= SAME * length;
        self.lengths.iter().position(same)
    }

    /// Leads the state from `tau` (s) in an interval over as much of it as is left after so many
    /// halvings: of the buildings that are asked for alone. Works out bounds of orders 4 and 6.
    pub(crate) fn advance(
        &mut self,
        (system, segment): (&System, &Segment),
        tau: f64,
        (which, halvings): (usize, usize),
        state: &[f64],
        of: impl Fn(usize) -> bool,
    ) {
        let n = system.degrees_of_freedom();
        let h = part_of(segment.length, halvings);
        self.by_series = false;
        let ends = &mut self.ends;
        ends.length = h;
        (ends.input, ends.viscous) = (0.0, 0.0);
        let buildings = self.buildings.iter_mut().enumerate();
        for (index, building) in buildings.filter(|(index, _)| of(*index)) {
            let place = (tau, h, which, halvings);
            building.advance((system, segment), place, (state, n), (index, ends));
        }
        ground((system, segment), (tau, h), state, ends);
    }

    /// Leads the state over a whole interval from where the last one ended, or from
    /// [`Propagation::begin_whole`], with nothing but its end in [`Ends::end`] up to the
    /// velocities, works, and bounds of orders 4 and 6. The state is that of the ground alone.
    pub(crate) fn advance_whole(
        &mut self,
        (system, segment): (&System, &Segment),
        which: usize,
        state: &[f64],
    ) {
        self.by_series = false;
        let ends = &mut self.ends;
        ends.length = segment.length;
        (ends.input, ends.viscous) = (0.0, 0.0);
        for (index, building) in self.buildings.iter_mut().enumerate() {
            building.advance_whole((system, segment), which, (index, ends));
        }
        ground((system, segment), (0.0, segment.length), state, ends);
    }

    /// Takes the functions of a building, rows over its coordinates, whose courses whole
    /// intervals tell: of displacements, and of absolute accelerations.
    pub(crate) fn follow(&mut self, building: usize, functions: [&DMatrix<f64>; 2]) {
        self.buildings[building].follow(functions);
    }

    /// Takes the state at the start of a whole interval that does not begin where the last one
    /// ended.
    pub(crate) fn begin_whole(&mut self, (system, segment): (&System, &Segment), state: &[f64]) {
        let n = system.degrees_of_freedom();
        for building in &mut self.buildings {
            building.begin_whole((system, segment), (state, n));
        }
    }

    /// Courses over the last whole interval of the functions of a building.
    pub(crate) fn courses(&self, building: usize) -> Courses<'_> {
        self.buildings[building].courses()
    }

    /// Whether the last step was one by a series.
    pub(crate) fn is_by_series(&self) -> bool {
        self.by_series
    }

    /// Whether forces push a building: its loads are then not its ground's accelerations.
    pub(crate) fn is_pushed(&self) -> bool {
        self.buildings.iter().any(Building::is_pushed)
    }

    /// Works out what the last step left: derivatives of order 4 and 5 at both ends, and the
    /// other bounds; without contact those of the buildings that are asked for alone.
    pub(crate) fn deepen(&mut self, series: &mut ContactSeries, of: impl Fn(usize) -> bool) {
        if self.by_series {
            series.deepen(&self.buildings, &mut self.ends);
            return;
        }
        let buildings = self.buildings.iter_mut().enumerate();
        for (index, building) in buildings.filter(|(index, _)| of(*index)) {
            building.deepen(index, &mut self.ends);
        }
    }
}

impl Propagation {
    /// Expands the motion with contacts over a step from `tau` in an interval. Returns whether
    /// the terms have an end.
    pub(crate) fn expand(
        &self,
        series: &mut ContactSeries,
        system: &System,
        place: (&Segment, f64),
        (state, length): (&[f64], f64),
    ) -> bool {
        series.expand((system, &self.buildings), place, state, length)
    }

    /// Takes both ends of a series, and bounds of orders 4 to 6.
    pub(crate) fn lead(&mut self, series: &mut ContactSeries, system: &System) {
        self.by_series = true;
        series.lead((system, &self.buildings), &mut self.ends);
    }

    /// Works out what works over a series.
    pub(crate) fn works(&mut self, series: &mut ContactSeries, system: &System) {
        series.works((system, &self.buildings), &mut self.ends);
    }
}

/// A half, a quarter and so on of an interval (s).
pub(crate) fn part_of(length: f64, halvings: usize) -> f64 {
    length / (1_u64 << halvings) as f64
}

/// Displacements of the ground, which are cubics.
fn ground(
    (system, segment): (&System, &Segment),
    (tau, h): (f64, f64),
    state: &[f64],
    ends: &mut Ends,
) {
    let n = system.degrees_of_freedom();
    let instants = [segment.ground(tau), segment.ground(tau + h)];
    for i in system.with_mass()..n {
        let [a, b] = instants.map(|ground| -system.load_on(i, ground));
        let slope = -system.load_slope_on(i, segment);
        let (x, v) = (state[i], state[n + i]);
        let end = [
            x + h * (v + h * (0.5 * a + h * slope / 6.0)),
            v + h * (a + 0.5 * h * slope),
        ];
        let (start, end) = ([x, v, a, slope], [end[0], end[1], b, slope]);
        for k in 0..4 {
            ends.start[k][i] = start[k];
            ends.end[k][i] = end[k];
        }
    }
}

/// Distinct lengths of the intervals of a run, the most frequent ones.
fn lengths(system: &System) -> Vec<f64> {
    let mut found: Vec<(f64, usize)> = Vec::new();
    for length in system.interval_lengths() {
        let known = |(l, _): &&mut (f64, usize)| (*l - length).abs() <= SAME * length;
        match found.iter_mut().find(known) {
            Some((_, count)) => *count += 1,
            None => found.push((length, 1)),
        }
    }
    found.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.total_cmp(&b.0)));
    found.into_iter().take(LENGTHS).map(|(l, _)| l).collect()
}
