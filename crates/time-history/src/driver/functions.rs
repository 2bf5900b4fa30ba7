//! What has peaks, over an exact step: bounds, and the peaks where the bounds tell where they
//! are.

use nalgebra::DMatrix;
use pounding_vectorised::vectorised;
use std::ops::Range;

use crate::contact::{Contact, Contacts};
use crate::peak::Peak;
use crate::peaks::Peaks;
use crate::polynomial::{
    Polynomial, absolute_maximum, derivative, hermite_range, maximum_above, septic, value,
};
use crate::system::propagation::{
    AffineContact, ContactSeries, Courses, Ends, NARROW, RowBlocks, SeriesTerms, padded,
};
use crate::system::{ContactLevel, SectionPlace, Segment, System};

/// Part of a value that the polynomial of degree 7 may err by where a peak is read off it, and
/// where it only tells the place of a peak that is read off a series.
const ALLOWED: f64 = 1.0e-10;
const ALLOWED_BESIDE_SERIES: f64 = 1.0e-8;
/// Error of a polynomial halfway, relative to the peak, up to which it is taken although its bound is greater: less, as it is one
/// place that tells of all.
const MET_HALFWAY: f64 = 1.0e-12;
/// Corrections of the place of such a peak at most, and what is left of it.
const CORRECTIONS: usize = 4;
const PLACED: f64 = 1.0e-9;

/// A row over the degrees of freedom.
#[derive(Debug)]
pub(super) struct Row {
    terms: Vec<(usize, f64)>,
    /// The terms where there are at most two, as the floors of a gap are.
    pair: Option<[(usize, f64); 2]>,
    /// `sqrt(w' M^-1 w)` of each building: what multiplies its bounds.
    mobility: Vec<(usize, f64)>,
}

/// Where a step is.
pub(super) struct Place<'a> {
    pub system: &'a System,
    pub segment: &'a Segment,
    pub tau: f64,
    /// Closed levels with their laws, and the rows of all levels.
    pub contacts: &'a [AffineContact],
    pub levels: &'a [Row],
    /// The series that leads over the step, if one does.
    pub series: Option<&'a ContactSeries>,
    /// Whether there is no shorter step, so that polynomials count whatever their bounds say.
    pub finest: bool,
}

impl Place<'_> {
    /// Acceleration of the ground under a degree of freedom at the start of the step (m/s2), and
    /// its slope (m/s3).
    fn ground_on(&self, dof: usize) -> [f64; 2] {
        let at = self.segment.ground(self.tau);
        let value = self.system.ground_on(dof, at);
        [value, self.system.ground_slope_on(dof, self.segment)]
    }
}

/// A function of the motion with a peak.
#[derive(Debug)]
pub(super) struct Function {
    row: Row,
    what: What,
}

#[derive(Debug, Clone, Copy)]
enum What {
    Displacement(usize),
    /// Drift as the difference of two floors: floor, storey height (m), storey stiffness (N/m).
    Drift(usize, f64, Option<f64>),
    /// Absolute acceleration of a floor.
    Acceleration(usize),
    Section(SectionPlace),
    /// A sum of absolute accelerations.
    Accelerations(SectionPlace),
    /// Response of a level, by its number, whether its sign counts, and the force that it holds
    /// as level and factor.
    OfLevel(usize, bool, (usize, f64)),
}

/// A function with derivatives at both ends, and bounds of its own.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Values {
    start: [f64; 4],
    end: [f64; 4],
    /// Of the fourth, fifth and eighth derivative.
    bounds: [f64; 3],
}

impl Row {
    fn new(system: &System, terms: Vec<(usize, f64)>) -> Self {
        let mass = system.mass();
        let mut mobility = Vec::new();
        for building in 0..system.buildings().len() {
            let parts = system.parts(building);
            let own = terms
                .iter()
                .filter(|(i, _)| parts.iter().any(|p| p.contains(i)));
            let square: f64 = own.map(|(i, w)| w * w / mass[*i]).sum();
            if square > 0.0 {
                mobility.push((building, square.sqrt()));
            }
        }
        let pair = match terms.as_slice() {
            [one] => Some([*one, (one.0, 0.0)]),
            [one, other] => Some([*one, *other]),
            _ => None,
        };
        Self {
            terms,
            pair,
            mobility,
        }
    }

    /// The closing of a level.
    pub(super) fn of_level(system: &System, level: &ContactLevel) -> Self {
        let ends = [(level.left, 1.0), (level.right, -1.0)].into_iter();
        let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
        let further = level.terms.pushed.iter().chain(&level.terms.ground);
        Self::new(system, ends.chain(further.copied()).collect())
    }

    #[inline]
    fn sum(&self, x: &[f64]) -> f64 {
        match self.pair {
            Some([(i, a), (j, b)]) => a * x[i] + b * x[j],
            None => self.terms.iter().map(|(i, w)| w * x[*i]).sum(),
        }
    }

    /// Bound of the derivative of this order over the step.
    #[inline]
    fn bound(&self, ends: &Ends, order: usize) -> f64 {
        let of = |(building, mobility): &(usize, f64)| mobility * ends.bounds[*building][order];
        match self.mobility.as_slice() {
            [one, other] => of(one) + of(other),
            all => all.iter().map(of).sum(),
        }
    }

    /// The derivative of this order at both ends.
    #[inline]
    fn both(&self, ends: &Ends, order: usize) -> (f64, f64) {
        (self.sum(&ends.start[order]), self.sum(&ends.end[order]))
    }

    /// Its value and rate in a state.
    #[inline]
    pub(super) fn at(&self, [u, v]: [&[f64]; 2]) -> [f64; 2] {
        [self.sum(u), self.sum(v)]
    }

    /// Its course over a whole interval from its value and rate at the start to the end.
    #[inline]
    pub(super) fn over(&self, start: [f64; 2], ends: &Ends) -> Course {
        let [u, v, ..] = &ends.end;
        Course {
            start,
            end: self.at([u, v]),
            fourth: self.bound(ends, 4),
            length: ends.length,
        }
    }

    /// Bounds from below and above of the derivative of this order.
    pub(super) fn range(&self, ends: &Ends, order: usize) -> (f64, f64) {
        let ((x0, x1), (v0, v1)) = (self.both(ends, order), self.both(ends, order + 1));
        let fourth = self.bound(ends, order + 4);
        hermite_range([x0, v0, x1, v1], fourth, ends.length)
    }

    /// The same of the force of a closed level.
    pub(super) fn range_of_force(&self, law: &AffineContact, ends: &Ends) -> (f64, f64) {
        let [u, v, a] = [0, 1, 2].map(|order| self.both(ends, order));
        let force = |constant: f64, by_penetration: (f64, f64), by_velocity: (f64, f64)| {
            let of = |u: f64, v: f64| constant + law.stiffness * u + law.dashpot * v;
            (
                of(by_penetration.0, by_velocity.0),
                of(by_penetration.1, by_velocity.1),
            )
        };
        let ((x0, x1), (v0, v1)) = (force(law.at_rest, u, v), force(0.0, v, a));
        let fourth = law.stiffness * self.bound(ends, 4) + law.dashpot * self.bound(ends, 5);
        hermite_range([x0, v0, x1, v1], fourth, ends.length)
    }

    /// Whether the penetration of a closed level and its force are sure to stay below these, by
    /// values and slopes at the ends alone.
    pub(super) fn stay_below(
        &self,
        (law, ends): (&AffineContact, &Ends),
        width: f64,
        [penetration, force]: [f64; 2],
    ) -> bool {
        let (_, closing) = self.range(ends, 0);
        // What is not a number is no proof.
        closing - width <= penetration && self.range_of_force(law, ends).1 <= force
    }

    /// The row as a function of displacements, or of absolute accelerations, which are of order
    /// two.
    fn values(&self, ends: &Ends, order: usize) -> Values {
        let mut values = Values {
            start: [0.0; 4],
            end: [0.0; 4],
            bounds: [4, 5, 8].map(|k| self.bound(ends, order + k)),
        };
        for k in 0..4 {
            let (start, end) = match (order, k) {
                (2, 0 | 1) => (&ends.absolute_start[k], &ends.absolute_end[k]),
                _ => (&ends.start[order + k], &ends.end[order + k]),
            };
            (values.start[k], values.end[k]) = (self.sum(start), self.sum(end));
        }
        values
    }

    fn force(&self, law: &AffineContact, ends: &Ends) -> Values {
        let mut values = Values {
            start: [0.0; 4],
            end: [0.0; 4],
            bounds: [4, 5, 8].map(|k| {
                law.stiffness * self.bound(ends, k) + law.dashpot * self.bound(ends, k + 1)
            }),
        };
        let mut now = self.both(ends, 0);
        for k in 0..4 {
            let later = self.both(ends, k + 1);
            let constant = if k == 0 { law.at_rest } else { 0.0 };
            values.start[k] = constant + law.stiffness * now.0 + law.dashpot * later.0;
            values.end[k] = constant + law.stiffness * now.1 + law.dashpot * later.1;
            now = later;
        }
        values
    }

    /// Takes the peak penetration of a closed level; false if it is not sure.
    pub(super) fn takes_penetration(
        &self,
        place: &Place<'_>,
        ends: &Ends,
        width: f64,
        peak: &mut Peak,
    ) -> bool {
        let mut values = self.values(ends, 0);
        values.start[0] -= width;
        values.end[0] -= width;
        let present = (peak.value, true);
        let terms = |series: &ContactSeries| {
            let mut terms = series.terms_of(self.terms.iter().copied(), false);
            terms[0] -= width;
            terms
        };
        values.take(place, ends.length, present, terms, |top, time| {
            peak.raise(top, time)
        })
    }

    /// The same of its force.
    pub(super) fn takes_force(
        &self,
        place: &Place<'_>,
        (law, ends): (&AffineContact, &Ends),
        peak: &mut Peak,
    ) -> bool {
        let values = self.force(law, ends);
        let present = (peak.value, true);
        let terms = |series: &ContactSeries| series.force_of(law);
        values.take(place, ends.length, present, terms, |top, time| {
            peak.raise(top, time)
        })
    }
}

/// A function over an interval, by values and slopes at both ends and a bound of its fourth
/// derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct Course {
    start: [f64; 2],
    pub end: [f64; 2],
    fourth: f64,
    length: f64,
}

/// The slope of a function lies near that of its cubic by less than `sqrt(3)/216 h^3` times a
/// bound of its fourth derivative (Birkhoff and Priver, Hermite interpolation errors for
/// derivatives, Journal of Mathematics and Physics 46 (1967) 440).
const SLOPE_REMAINDER: f64 = 8.02e-3;

impl Course {
    /// Bounds from below and above.
    pub(super) fn range(&self) -> (f64, f64) {
        let ([x0, v0], [x1, v1]) = (self.start, self.end);
        hermite_range([x0, v0, x1, v1], self.fourth, self.length)
    }

    /// Whether it is sure to stay below this.
    pub(super) fn stays_below(&self, limit: f64) -> bool {
        let ([x0, v0], [x1, v1], h) = (self.start, self.end, self.length);
        let third = h / 3.0;
        let (a, b) = (x0 + third * v0, x1 - third * v1);
        let (first, last) = (0.25 * x0 + 0.75 * a, 0.25 * x1 + 0.75 * b);
        let middle = 0.5 * (a + b) + h * h * h * h / 144.0 * self.fourth;
        // What is not a number is no proof.
        x0 < limit && x1 < limit && first < limit && last < limit && middle < limit
    }

    /// Whether it may have a maximum or minimum inside: whether the control points of its slope
    /// are not all clear of zero on one side.
    pub(super) fn may_turn(&self) -> bool {
        let ([x0, v0], [x1, v1], h) = (self.start, self.end, self.length);
        let middle = 3.0 * (x1 - x0) / h - v0 - v1;
        let error = SLOPE_REMAINDER * h * h * h * self.fourth;
        let (least, most) = (v0.min(middle).min(v1), v0.max(middle).max(v1));
        !(least - error >= 0.0 || most + error <= 0.0)
    }
}

impl AffineContact {
    /// Whether its force is what the law would have without a limit, told by three motions.
    pub(super) fn is_raw_force_of(
        &self,
        contact: &Contact,
        level: &ContactLevel,
        contacts: &Contacts,
    ) -> bool {
        let width = contacts.width(self.level);
        let motions = [(0.0, 0.0), (1.0e-3, 0.3), (2.0e-3, -0.5)];
        motions.iter().all(|(delta, rate)| {
            let own = self.at_rest + self.stiffness * (delta + width) + self.dashpot * rate;
            let size = (self.at_rest.abs() + self.stiffness * (delta + width)).max(own.abs());
            (contact.raw_force(level, *delta, *rate) - own).abs() <= 1.0e-12 * size
        })
    }
}

impl Values {
    fn range(&self, h: f64) -> (f64, f64) {
        let ([x0, v0, ..], [x1, v1, ..]) = (self.start, self.end);
        hermite_range([x0, v0, x1, v1], self.bounds[0], h)
    }

    /// Raises a peak if the function has a higher value; false if that is not sure.
    fn take(
        &self,
        place: &Place<'_>,
        h: f64,
        (peak, one_sided): (f64, bool),
        terms: impl Fn(&ContactSeries) -> SeriesTerms,
        mut raise: impl FnMut(f64, f64),
    ) -> bool {
        let (least, most) = self.range(h);
        let beyond = if one_sided { most } else { most.max(-least) };
        if beyond <= peak {
            return true;
        }
        let size = |x: f64| if one_sided { x } else { x.abs() };
        let start = place.segment.start + place.tau;
        let ([_, v0, a0, _], [_, v1, a1, _]) = (self.start, self.end);
        let (slowest, fastest) = hermite_range([v0, a0, v1, a1], self.bounds[1], h);
        if slowest >= 0.0 || fastest <= 0.0 {
            raise(size(self.start[0]), start);
            raise(size(self.end[0]), start + h);
            return true;
        }
        let error = h.powi(8) / (40_320.0 * 256.0) * self.bounds[2];
        let large = self.largest(peak);
        let allowed = match place.series {
            Some(_) => ALLOWED_BESIDE_SERIES,
            None => ALLOWED,
        };
        if !(place.finest || error <= allowed * large) {
            return false;
        }
        let polynomial = self.polynomial(h);
        let found = match one_sided {
            true => maximum_above(&polynomial, peak),
            false => absolute_maximum(&polynomial, peak),
        };
        if let Some((theta, top)) = found {
            let (theta, top) = match place.series {
                Some(series) => {
                    let (theta, top) = read_off(&terms(series), theta);
                    (theta, size(top))
                }
                None => (theta, top),
            };
            raise(top, start + theta * h);
        }
        true
    }

    /// The greatest of its ends and of its peak so far.
    fn largest(&self, peak: f64) -> f64 {
        peak.max(self.start[0].abs()).max(self.end[0].abs())
    }

    fn polynomial(&self, h: f64) -> Polynomial {
        let scaled = |x: [f64; 4]| [x[0], h * x[1], h * h * x[2], h * h * h * x[3]];
        septic(scaled(self.start), scaled(self.end))
    }
}

/// A turning point of a series near a place in the step, and the value there.
fn read_off(terms: &SeriesTerms, theta: f64) -> (f64, f64) {
    let at = |theta: f64| {
        let (mut value, mut slope, mut bend) = (0.0, 0.0, 0.0);
        for term in terms.iter().rev() {
            bend = bend * theta + 2.0 * slope;
            slope = slope * theta + value;
            value = value * theta + term;
        }
        [value, slope, bend]
    };
    let mut best = (theta, at(theta)[0]);
    if theta <= 0.0 || theta >= 1.0 {
        return best;
    }
    let mut now = theta;
    for _ in 0..CORRECTIONS {
        let [_, slope, bend] = at(now);
        let next = (now - slope / bend).clamp(0.0, 1.0);
        let moved = (next - now).abs();
        if !next.is_finite() {
            break;
        }
        let value = at(next)[0];
        if value.abs() > best.1.abs() {
            best = (next, value);
        }
        now = next;
        if moved <= PLACED {
            break;
        }
    }
    best
}

/// Where a step begins, as to the last one that was looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Begin {
    /// At its start.
    AtStart,
    /// At its end.
    AtEnd,
    /// Somewhere else, or after a jump.
    Unknown,
}

/// Functions of one building that are sums of displacements, and those that are sums of absolute
/// accelerations: a product for each tells the values of all. They stand one kind after the other,
/// each filled up to whole blocks; the first are the coordinates, whether they have peaks or not.
#[derive(Debug)]
pub(super) struct Group {
    building: usize,
    dofs: Vec<usize>,
    /// Numbers of the functions, and their places among the values.
    functions: Range<usize>,
    places: Vec<usize>,
    /// Where those of absolute accelerations begin.
    of_accelerations: usize,
    /// By kind: one column a degree of freedom.
    rows: [DMatrix<f64>; 2],
    weights: [RowBlocks; 2],
    mobility: Vec<f64>,
    peaks: Vec<f64>,
    motion: Vec<f64>,
    values: [Vec<f64>; 4],
    beyond: Vec<f64>,
}

impl Group {
    /// Functions from a number on, as many as there are, those of displacements first.
    fn new(system: &System, building: usize, first: usize, all: &[Function]) -> Self {
        let dofs: Vec<usize> = system.parts(building).into_iter().flatten().collect();
        let own = &all[first..];
        let kinds = own.split_at(own.partition_point(|f| f.order() == 0));
        let weight = |f: &Function, dof: usize| -> f64 {
            let terms = f.row.terms.iter();
            terms.filter(|(i, _)| *i == dof).map(|(_, w)| w).sum()
        };
        let weights = |f: &Function| -> Vec<f64> { dofs.iter().map(|i| weight(f, *i)).collect() };
        let n = dofs.len();
        let unit = |j: usize| (0..n).map(|i| f64::from(u8::from(i == j))).collect();
        let mut of_displacements: Vec<Vec<f64>> = (0..n).map(unit).collect();
        let mut places: Vec<usize> = Vec::with_capacity(own.len());
        for row in kinds.0.iter().map(weights) {
            let coordinate = of_displacements[..n].iter().position(|unit| *unit == row);
            let free = coordinate.filter(|place| !places.contains(place));
            places.push(free.unwrap_or(of_displacements.len()));
            if free.is_none() {
                of_displacements.push(row);
            }
        }
        let accelerations: Vec<Vec<f64>> = kinds.1.iter().map(weights).collect();
        let of_accelerations = padded(of_displacements.len());
        places.extend((0..accelerations.len()).map(|k| of_accelerations + k));
        let rows = [of_displacements, accelerations]
            .map(|rows| DMatrix::from_fn(rows.len(), n, |k, j| rows[k][j]));
        let zeros = || vec![0.0; of_accelerations + padded(kinds.1.len())];
        // A coordinate without a peak exceeds none.
        let (mut mobility, mut peaks) = (zeros(), zeros());
        peaks[..n].fill(f64::INFINITY);
        for (place, function) in places.iter().zip(own) {
            mobility[*place] = function.row.mobility.iter().map(|(_, m)| m).sum();
            peaks[*place] = 0.0;
        }
        Self {
            building,
            weights: (rows.each_ref())
                .map(|rows| RowBlocks::new(rows.nrows(), dofs.len(), |i, j| rows[(i, j)])),
            rows,
            mobility,
            peaks,
            values: std::array::from_fn(|_| zeros()),
            beyond: zeros(),
            of_accelerations,
            motion: vec![0.0; dofs.len()],
            functions: first..all.len(),
            places,
            dofs,
        }
    }

    /// Takes the present peaks.
    pub(super) fn refresh(&mut self, all: &[Function], peaks: &Peaks) {
        for (place, function) in self.places.iter().zip(&all[self.functions.clone()]) {
            self.peaks[*place] = function.peak(peaks).0;
        }
    }

    /// Rows over the coordinates of the building: the coordinates themselves and further functions
    /// of displacements, and functions of absolute accelerations.
    pub(super) fn rows(&self) -> [&DMatrix<f64>; 2] {
        self.rows.each_ref()
    }

    /// Whether all functions are sure to stay below their peaks over a whole interval with
    /// these courses.
    pub(super) fn stay_below(&mut self, courses: &Courses<'_>, ends: &Ends) -> bool {
        let ([x0, v0], [x1, v1]) = (courses.start, courses.end);
        let bounds = (self.mobility.as_slice(), self.bounds(ends));
        let (beyond, second) = (&mut self.beyond, self.of_accelerations);
        let (values, limits) = ([x0, v0, x1, v1], (self.peaks.as_slice(), &mut beyond[..]));
        reaches(values, bounds, (ends.length, second), limits)
    }

    /// Bounds of what the fourth derivatives of the functions are made of, by kind.
    fn bounds(&self, ends: &Ends) -> [f64; 2] {
        let bounds = &ends.bounds[self.building];
        [bounds[4], bounds[6]]
    }

    /// The bound of a function, by its number in the group, where it may not stay below.
    pub(super) fn above(&self, number: usize) -> Option<f64> {
        let place = self.places[number];
        let beyond = self.beyond[place];
        // What is not a number is no proof.
        (!(beyond <= self.peaks[place])).then_some(beyond)
    }

    /// Number of its functions.
    pub(super) fn len(&self) -> usize {
        self.functions.len()
    }

    /// Number among all functions, and course, of one by its number in the group.
    pub(super) fn course(
        &self,
        number: usize,
        courses: &Courses<'_>,
        ends: &Ends,
    ) -> (usize, Course) {
        let place = self.places[number];
        let [of_displacements, of_accelerations] = self.bounds(ends);
        let bound = match place < self.of_accelerations {
            true => of_displacements,
            false => of_accelerations,
        };
        let course = Course {
            start: courses.start.map(|of| of[place]),
            end: courses.end.map(|of| of[place]),
            fourth: self.mobility[place] * bound,
            length: ends.length,
        };
        (self.functions.start + number, course)
    }

    /// Sets the peak of a function by its number in the group.
    pub(super) fn set_peak(&mut self, number: usize, peak: f64) {
        self.peaks[self.places[number]] = peak;
    }

    /// Number after its last function.
    pub(super) fn functions_end(&self) -> usize {
        self.functions.end
    }

    /// Number of its building.
    pub(super) fn building(&self) -> usize {
        self.building
    }

    /// Adds the numbers of functions that may exceed their peaks. Returns the number after the
    /// last function of the group.
    pub(super) fn doubt(&mut self, ends: &Ends, begin: Begin, doubtful: &mut Vec<usize>) -> usize {
        if begin == Begin::AtEnd {
            self.values.swap(0, 2);
            self.values.swap(1, 3);
        }
        let of_displacements = [&ends.start, &ends.end].map(|x| [&x[0], &x[1]]);
        let of_accelerations = [&ends.absolute_start, &ends.absolute_end].map(|x| [&x[0], &x[1]]);
        let all = self.mobility.len();
        let kinds = [
            (0..self.of_accelerations, of_displacements, true),
            // The rate of the ground's acceleration jumps from interval to interval.
            (self.of_accelerations..all, of_accelerations, false),
        ];
        for ((own, motion, steady), weights) in kinds.into_iter().zip(&self.weights) {
            let known = match begin {
                Begin::Unknown => [false; 2],
                Begin::AtEnd => [true, steady],
                Begin::AtStart => [true; 2],
            };
            let known = known.into_iter().chain([false; 2]);
            let motion = motion.as_flattened().iter().zip(known);
            let wanted = self.values.iter_mut().zip(motion);
            for (values, (motion, _)) in wanted.filter(|(_, (_, known))| !known) {
                for (x, i) in self.motion.iter_mut().zip(&self.dofs) {
                    *x = motion[*i];
                }
                weights.multiply(&self.motion, &mut values[own.clone()]);
            }
        }
        let values = self.values.each_ref().map(Vec::as_slice);
        let bounds = (self.mobility.as_slice(), self.bounds(ends));
        let second = self.of_accelerations;
        let limits = (self.peaks.as_slice(), self.beyond.as_mut_slice());
        if reaches(values, bounds, (ends.length, second), limits) {
            return self.functions.end;
        }
        let above = (0..self.len()).filter(|number| self.above(*number).is_some());
        doubtful.extend(above.map(|number| self.functions.start + number));
        self.functions.end
    }
}

/// Bounds of the magnitudes of functions from values and slopes at the start and at the end, as
/// [`hermite_range`] has them for one, with one bound for those before a place and another from there
/// on. Returns whether all are at most these peaks.
#[vectorised]
fn reaches(
    [x0, v0, x1, v1]: [&[f64]; 4],
    (mobility, [first, second]): (&[f64], [f64; 2]),
    (h, place): (f64, usize),
    (peaks, out): (&[f64], &mut [f64]),
) -> bool {
    let (third, fourth) = (h / 3.0, h.powi(4) / 144.0);
    let (first, second, place) = (fourth * first, fourth * second, place / NARROW);
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let (out, _) = out.as_chunks_mut();
    let n = out.len();
    let (x0, v0) = (&x0.as_chunks().0[..n], &v0.as_chunks().0[..n]);
    let (x1, v1) = (&x1.as_chunks().0[..n], &v1.as_chunks().0[..n]);
    let (mobility, peaks) = (&mobility.as_chunks().0[..n], &peaks.as_chunks().0[..n]);
    let mut above = [0.0; NARROW];
    // One operation on a block after another, so that each is one of the processor's.
    for k in 0..n {
        let remainder = if k < place { first } else { second };
        let a = by_pairs(x0[k], v0[k], |x, v| x + third * v);
        let b = by_pairs(x1[k], v1[k], |x, v| x - third * v);
        let error = by_pairs(mobility[k], mobility[k], |mobility, _| remainder * mobility);
        let ends = by_pairs(x0[k], x1[k], |x, y| larger(x.abs(), y.abs()));
        let early = by_pairs(x0[k], a, |x, a| (0.25 * x + 0.75 * a).abs());
        let late = by_pairs(x1[k], b, |x, b| (0.25 * x + 0.75 * b).abs());
        let inner = by_pairs(early, late, larger);
        let middle = by_pairs(a, b, |a, b| (0.5 * (a + b)).abs());
        let middle = by_pairs(middle, error, |middle, error| middle + error);
        let reach = by_pairs(by_pairs(ends, inner, larger), middle, larger);
        // The last term lets nothing pass that is not finite.
        let reach = by_pairs(reach, error, |reach, error| reach + 0.0 * error);
        // What is not a number is no proof.
        let over = |reach, peak| if reach <= peak { 0.0 } else { 1.0 };
        above = by_pairs(above, by_pairs(reach, peaks[k], over), |all, one| all + one);
        out[k] = reach;
    }
    above == [0.0; NARROW]
}

/// As many values as are worked on side by side.
type Block = [f64; NARROW];

/// A function of two blocks, place by place.
#[inline(always)]
fn by_pairs(a: Block, b: Block, function: impl Fn(f64, f64) -> f64) -> Block {
    let mut out = [0.0; NARROW];
    for i in 0..NARROW {
        out[i] = function(a[i], b[i]);
    }
    out
}

impl Function {
    /// All that has peaks while no contact is closed: those of buildings in groups, responses of
    /// levels after them.
    pub(super) fn all(system: &System) -> (Vec<Self>, Vec<Group>) {
        let mut all: Vec<Self> = Vec::new();
        let mut groups = Vec::new();
        let new = |what: What, mut terms: Vec<(usize, f64)>| {
            terms.retain(|(_, w)| *w != 0.0);
            let row = Row::new(system, terms);
            Self { row, what }
        };
        for (b, building) in system.buildings().iter().enumerate() {
            let parts = system.parts(b);
            let own = |terms: &Vec<(usize, f64)>| {
                terms
                    .first()
                    .is_some_and(|(i, _)| parts[0].contains(i) || parts[1].contains(i))
            };
            let first = all.len();
            for (storey, i) in parts[0].clone().enumerate() {
                all.push(new(What::Displacement(i), vec![(i, 1.0)]));
                if building.drifts().is_none() {
                    let mut terms = vec![(i, 1.0)];
                    if storey > 0 {
                        terms.push((i - 1, -1.0));
                    }
                    let stiffness = building.stiffness().get(storey).copied();
                    let what = What::Drift(i, building.height()[storey], stiffness);
                    all.push(new(what, terms));
                }
            }
            for section in system.sections() {
                let terms = section.terms().collect();
                if own(&terms) {
                    all.push(new(What::Section(section.place), terms));
                }
            }
            for i in parts[0].clone() {
                all.push(new(What::Acceleration(i), vec![(i, 1.0)]));
            }
            for row in system.acceleration_rows() {
                let terms = row.terms().collect();
                if own(&terms) {
                    all.push(new(What::Accelerations(row.place), terms));
                }
            }
            groups.push(Group::new(system, b, first, &all));
        }
        for (number, row) in system.level_rows().iter().enumerate() {
            let force = (row.level, row.by_force);
            let what = What::OfLevel(number, row.one_sided, force);
            all.push(new(what, row.terms.clone()));
        }
        (all, groups)
    }

    /// Whether it depends on the motion of this building.
    pub(super) fn is_of(&self, building: usize) -> bool {
        self.buildings().any(|b| b == building)
    }

    /// The buildings on whose motion it depends.
    pub(super) fn buildings(&self) -> impl Iterator<Item = usize> {
        self.row.mobility.iter().map(|(b, _)| *b)
    }

    /// The function over a step without contact.
    pub(super) fn values(&self, ends: &Ends) -> Values {
        self.row.values(ends, self.order())
    }

    /// Whether its polynomial over a step is met halfway, where the first half of the step ends, as closely as bounds ask for.
    /// Bounds of the eighth derivative are those of the stiffest mode, which may rest.
    pub(super) fn is_met_halfway(&self, over: &Values, first_half: &Ends, peaks: &Peaks) -> bool {
        let met = over.polynomial(2.0 * first_half.length);
        let there = match self.order() {
            2 => first_half.absolute_end.each_ref(),
            _ => [&first_half.end[0], &first_half.end[1]],
        };
        let [at, rate] = there.map(|x| self.row.sum(x));
        let error = value(&met, 0.5) - at;
        let of_slope = value(&derivative(&met), 0.5) - 2.0 * first_half.length * rate;
        let large = over.largest(self.peak(peaks).0);
        // What is not a number is not met.
        error.abs() + 0.25 * of_slope.abs() <= MET_HALFWAY * large
    }

    fn order(&self) -> usize {
        match self.what {
            What::Acceleration(_) | What::Accelerations(_) => 2,
            _ => 0,
        }
    }

    /// The present peak, and whether the sign counts.
    pub(super) fn peak(&self, peaks: &Peaks) -> (f64, bool) {
        match self.what {
            What::Displacement(i) => (peaks.storeys[i].displacement.value, false),
            What::Drift(i, height, stiffness) => {
                let storey = &peaks.storeys[i];
                let drift = storey.drift_ratio.value * height;
                let shear = stiffness.map_or(drift, |k| storey.storey_shear.value / k);
                (drift.min(shear), false)
            }
            What::Acceleration(i) => (peaks.storeys[i].acceleration_absolute.value, false),
            What::Section(place) | What::Accelerations(place) => {
                (peaks.of_section(place).value, false)
            }
            What::OfLevel(number, one_sided, _) => (peaks.of_levels[number].value, one_sided),
        }
    }

    /// Bound of what counts in the peak from bounds from below and above.
    pub(super) fn size_of(&self, (least, most): (f64, f64)) -> f64 {
        match self.what {
            What::OfLevel(_, true, _) => most,
            _ => most.max(-least),
        }
    }

    /// Raises the peak to a higher value.
    pub(super) fn raise(&self, peaks: &mut Peaks, top: f64, time: f64) {
        match self.what {
            What::Displacement(i) => peaks.storeys[i].displacement.raise(top, time),
            What::Drift(i, height, stiffness) => {
                let storey = &mut peaks.storeys[i];
                storey.drift_ratio.raise(top / height, time);
                if let Some(stiffness) = stiffness {
                    storey.storey_shear.raise(stiffness * top, time);
                }
            }
            What::Acceleration(i) => peaks.storeys[i].acceleration_absolute.raise(top, time),
            What::Section(section) | What::Accelerations(section) => {
                peaks.raise_section(section, top, time);
            }
            What::OfLevel(number, ..) => peaks.of_levels[number].raise(top, time),
        }
    }

    /// What the force of a closed level adds.
    fn force(&self, place: &Place<'_>, ends: &Ends) -> Option<(f64, Values)> {
        let (factor, law) = self.law(place)?;
        Some((factor, place.levels[law.level].force(law, ends)))
    }

    /// The law of the closed level whose force counts, with its factor.
    fn law<'a>(&self, place: &Place<'a>) -> Option<(f64, &'a AffineContact)> {
        let What::OfLevel(_, _, (level, factor)) = self.what else {
            return None;
        };
        let law = place.contacts.iter().find(|c| c.level == level);
        law.filter(|_| factor != 0.0).map(|law| (factor, law))
    }

    /// Whether a response of a level is sure to stay below its peak, by values and slopes at the
    /// ends alone.
    pub(super) fn stays_below(&self, place: &Place<'_>, ends: &Ends, peaks: &Peaks) -> bool {
        let h = ends.length;
        let (mut x, mut v) = (self.row.both(ends, 0), self.row.both(ends, 1));
        let mut fourth = self.row.bound(ends, 4);
        if let Some((factor, force)) = self.force(place, ends) {
            (x.0, x.1) = (x.0 + factor * force.start[0], x.1 + factor * force.end[0]);
            (v.0, v.1) = (v.0 + factor * force.start[1], v.1 + factor * force.end[1]);
            fourth += factor.abs() * force.bounds[0];
        }
        let (least, most) = hermite_range([x.0, v.0, x.1, v.1], fourth, h);
        let (peak, one_sided) = self.peak(peaks);
        let beyond = if one_sided { most } else { most.max(-least) };
        beyond <= peak
    }

    /// A response of a level over a whole interval without contact, from this state on.
    pub(super) fn over(&self, start: [&[f64]; 2], ends: &Ends) -> Course {
        self.row.over(self.row.at(start), ends)
    }

    /// Takes its peak; false if it is not sure where there is one.
    pub(super) fn takes_peak(&self, place: &Place<'_>, ends: &Ends, peaks: &mut Peaks) -> bool {
        let (order, h) = (self.order(), ends.length);
        let mut values = self.row.values(ends, order);
        if let Some((factor, force)) = self.force(place, ends) {
            for k in 0..4 {
                values.start[k] += factor * force.start[k];
                values.end[k] += factor * force.end[k];
            }
            for (bound, further) in values.bounds.iter_mut().zip(force.bounds) {
                *bound += factor.abs() * further;
            }
        }
        let present = self.peak(peaks);
        let raise = |top: f64, time: f64| self.raise(peaks, top, time);
        let terms = |series: &ContactSeries| {
            let mut terms = series.terms_of(self.row.terms.iter().copied(), order == 2);
            if order == 2 {
                for (i, weight) in &self.row.terms {
                    let ground = place.ground_on(*i);
                    terms[0] += weight * ground[0];
                    terms[1] += weight * ground[1] * h;
                }
            }
            if let Some((factor, law)) = self.law(place) {
                for (term, force) in terms.iter_mut().zip(series.force_of(law)) {
                    *term += factor * force;
                }
            }
            terms
        };
        values.take(place, h, present, terms, raise)
    }

    /// Takes its peak over a step without contact whose polynomial is exact.
    pub(super) fn takes_exact_peak(
        &self,
        place: &Place<'_>,
        (over, length): (&Values, f64),
        peaks: &mut Peaks,
    ) {
        let present = self.peak(peaks);
        let raise = |top: f64, time: f64| self.raise(peaks, top, time);
        let no_terms = |series: &ContactSeries| series.terms_of(std::iter::empty(), false);
        over.take(place, length, present, no_terms, raise);
    }
}
