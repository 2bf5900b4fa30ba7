//! Taylor series of the modes and of contacts with affine laws, summed to round-off.

use super::powers::{Law, Powers};
use super::tables::{TERMS, Tables, Terms, end_and_bend, maximum, value_and_slope};
use super::touch::Touch;
use super::touch_series::TouchSeries;
use crate::polynomial::maximum_above;
use crate::system::System;
use crate::system::modes::{Lane, LevelRows, ModalRow, ModeLanes, WIDTH};

/// Product of rate and step up to which Gauss's rule with six nodes is exact to round-off: over the
/// square of a velocity it errs by `(6!)^4 / (13 (12!)^3) = 1.9e-16` times the twelfth derivative,
/// which is at most `(2 x)^12` of the greatest square.
pub(super) const SLOW: f64 = 0.6;

/// Relative size below which a leading term is what a root that was just passed leaves.
const NEGLIGIBLE_START: f64 = 1.0e-13;
/// Part of the magnitudes in a sum that its round-off may have.
const ROUND_OFF: f64 = 4.0e-16;
/// What is greater than this (m, m/s) is no round-off of floors less than a kilometre from
/// where they stood.
const CLEAR_OF_ZERO: f64 = 1.0e-12;
/// Terms that can be round-off at a root: first floors at rest in touch move apart, or
/// together, like the fourth power of time, those of every further storey like a power that
/// is higher by two.
pub(super) const LEADING: usize = 18;

/// What a series starts from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeriesStep<'a> {
    pub displacement: &'a [Lane],
    pub velocity: &'a [Lane],
    /// Ground acceleration at the start (m/s2) and its slope (m/s3).
    pub ground: (f64, f64),
    /// Length (s).
    pub step: f64,
    /// Bound of the rate of the motion (1/s).
    pub rate: f64,
    /// Terms at least, and remainder beside the motion that may be left out.
    pub terms: usize,
    pub negligible: f64,
}

/// Works of a step.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Works {
    /// Of the ground motion (J).
    pub input: f64,
    /// Of the damping (J).
    pub viscous: f64,
}

/// The motion at the end of a step, and the works over it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeriesEnd<'a> {
    pub displacement: &'a [Lane],
    pub velocity: &'a [Lane],
    /// Absolute accelerations.
    pub absolute: &'a [Lane],
    pub works: Works,
}

/// Terms of the series over a step, in theta = time over step.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(super) lanes: usize,
    rate: f64,
    longest: f64,
    /// The last product of rate and step with its remainder, and the number of terms that it takes.
    pub(super) product: (f64, f64),
    pub(super) enough: usize,
    /// Number of the last term.
    pub(super) last: usize,
    pub(super) step: f64,
    pub(super) ground: (f64, f64),
    /// Term after term.
    pub(super) displacement: Vec<Lane>,
    pub(super) velocity: Vec<Lane>,
    pub touches: Vec<TouchSeries>,
    /// Series of the powers in the laws of the closed levels.
    pub(super) powers: Vec<Powers>,
    /// Acceleration (1/kg) with which each closed level parts under a unit force on each.
    pub(super) mobility: Vec<f64>,
    /// Terms of the rates of the closed levels to be taken in next.
    pub(super) next_rates: Vec<f64>,
    /// Sums of `k (k - 1) |term k|` of displacement and of acceleration: bounds of
    /// the second derivatives with respect to theta.
    pub bend: Vec<Lane>,
    pub snap: Vec<Lane>,
    /// Bound (m) of what any floor's displacement exceeds both ends of the step by.
    pub over: f64,
    pub(super) tables: &'static Tables,
}

impl Series {
    /// Maximum product of rate and step.
    pub(crate) const LONGEST: f64 = 1.3;
    /// A remainder below this, relative to the motion, is round-off.
    pub(crate) const ROUND_OFF: f64 = 1.0e-17;

    pub(crate) fn new(lanes: usize, levels: usize) -> Self {
        let terms = || vec![Lane::ZERO; lanes * TERMS];
        Self {
            lanes,
            rate: 0.0,
            longest: 0.0,
            product: (f64::NAN, 0.0),
            enough: 0,
            last: 0,
            step: 0.0,
            ground: (0.0, 0.0),
            displacement: terms(),
            velocity: terms(),
            touches: Vec::with_capacity(levels),
            powers: vec![Powers::NONE; levels],
            mobility: Vec::with_capacity(levels * levels),
            next_rates: vec![0.0; levels],
            bend: vec![Lane::ZERO; lanes],
            snap: vec![Lane::ZERO; lanes],
            over: 0.0,
            tables: Tables::all(),
        }
    }

    /// Bound of the rate (1/s) of the motion with the closed levels, that of whose own is
    /// `sqrt(k / m) + c / m`.
    pub(crate) fn rate(&self) -> f64 {
        self.rate
    }

    /// Longest step (s).
    pub(crate) fn longest(&self) -> f64 {
        self.longest
    }

    /// Takes the laws of the closed levels, beside modes of which this is the fastest rate (1/s).
    pub(crate) fn take_laws(
        &mut self,
        system: &System,
        (rows, fastest): (&LevelRows, f64),
        touches: &[Touch],
    ) {
        let known = self.touches.iter().map(|touch| touch.level);
        // From phase to phase of a contact the levels are the same.
        let others = !known.eq(touches.iter().map(|touch| touch.level));
        for (index, touch) in touches.iter().enumerate() {
            let level = &system.levels()[touch.level];
            let (collision, phase) = (&touch.contact.collision, touch.contact.phase);
            let powers = level.model.power_law(collision, phase);
            let law = match powers {
                Some(law) if !level.model.is_affine(collision, phase) => Law::Powers(law),
                _ => {
                    let law = touch.contact.force(level, 0.0, 0.0);
                    Law::Affine {
                        constant: law.value,
                        stiffness: law.by_penetration,
                        dashpot: law.by_velocity,
                    }
                }
            };
            match self.touches.get_mut(index) {
                // The terms in it are written before they are read.
                Some(known) => (known.level, known.law) = (touch.level, law),
                None => self.touches.push(TouchSeries::new(touch.level, law)),
            }
        }
        self.touches.truncate(touches.len());
        if others {
            self.mobility.clear();
            for a in touches {
                let row = &rows.levels[a.level];
                let all = touches.iter().map(|b| row.product(&rows.levels[b.level]));
                self.mobility.extend(all);
            }
        }
        let touches = &self.touches;
        let rate = contact_rate(&self.mobility, touches.len(), |l| match touches[l].law {
            Law::Affine {
                stiffness, dashpot, ..
            } => [stiffness, dashpot],
            Law::Powers(_) => [0.0; 2],
        });
        self.rate = (fastest * fastest + rate * rate).sqrt();
        self.longest = Self::LONGEST / self.rate;
    }

    /// Part of the step over which the series of all levels end in terms below `allowed`
    /// (m); one if that is all of it.
    pub(crate) fn reach(&self, allowed: f64) -> f64 {
        let mut reach = 1.0_f64;
        for touch in &self.touches {
            for k in [self.last - 1, self.last] {
                let term = touch.delta[k].abs();
                if term > allowed {
                    reach = reach.min(libm::pow(allowed / term, 1.0 / k as f64));
                }
            }
        }
        reach
    }

    pub(crate) fn terms(&self) -> usize {
        self.last
    }

    /// Ground acceleration at the start (m/s2) and its slope (m/s3).
    pub(crate) fn ground(&self) -> (f64, f64) {
        self.ground
    }

    /// Length (s).
    pub(crate) fn step(&self) -> f64 {
        self.step
    }

    /// Absolute accelerations of the modes at the start.
    pub(crate) fn start_acceleration(&self, modes: &[ModeLanes], absolute: &mut [Lane]) {
        for ((absolute, first), m) in absolute
            .iter_mut()
            .zip(&self.velocity[self.lanes..])
            .zip(modes)
        {
            for l in 0..WIDTH {
                absolute[l] = first[l] / self.step + m.participation[l] * self.ground.0;
            }
        }
    }

    /// Displacements and velocities of the modes at the start.
    pub(crate) fn start(&self, displacement: &mut [Lane], velocity: &mut [Lane]) {
        displacement.copy_from_slice(&self.displacement[..self.lanes]);
        velocity.copy_from_slice(&self.velocity[..self.lanes]);
    }

    /// Takes over another series of the same system, without its bounds.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        (self.last, self.step, self.ground) = (other.last, other.step, other.ground);
        let terms = ..(other.last + 1) * other.lanes;
        self.displacement[terms].copy_from_slice(&other.displacement[terms]);
        self.velocity[terms].copy_from_slice(&other.velocity[terms]);
        self.touches.clone_from(&other.touches);
    }

    /// Maximum value above `floor` of one row less another, with its theta.
    pub(crate) fn maximum_of_difference(
        &self,
        (left, right): (Option<&ModalRow>, Option<&ModalRow>),
        floor: f64,
    ) -> Option<(f64, f64)> {
        let of = |row: Option<&ModalRow>| row.map_or([0.0; TERMS], |row| self.row(row));
        let (mut terms, less) = (of(left), of(right));
        for (term, less) in terms.iter_mut().zip(less) {
            *term -= less;
        }
        self.maximum(&terms, self.end_and_bend(&terms), floor)
    }

    /// Whether a rule of few nodes errs by round-off alone.
    pub(super) fn is_slow(&self) -> bool {
        let affine = |touch: &TouchSeries| matches!(touch.law, Law::Affine { .. });
        self.product.0 <= SLOW && self.touches.iter().all(affine)
    }

    /// A row's function of theta.
    pub(crate) fn row(&self, row: &ModalRow) -> Terms {
        self.along(row, &self.displacement)
    }

    /// A row's rate of change.
    pub(crate) fn row_rate(&self, row: &ModalRow) -> Terms {
        self.along(row, &self.velocity)
    }

    /// A row of absolute acceleration, for `ground` weighing the ground's part.
    pub(crate) fn row_acceleration(&self, row: &ModalRow, ground: f64) -> Terms {
        let rate = self.row_rate(row);
        let mut terms = [0.0; TERMS];
        for k in 0..self.last {
            terms[k] = rate[k + 1] * (k + 1) as f64 / self.step;
        }
        terms[0] += ground * self.ground.0;
        terms[1] += ground * self.ground.1 * self.step;
        terms
    }

    fn along(&self, row: &ModalRow, terms: &[Lane]) -> Terms {
        let mut out = [0.0; TERMS];
        row.dot_all(terms, self.lanes, &mut out[..=self.last]);
        out
    }

    /// Number of the first terms that are round-off of a sum of these multiples of a row's
    /// displacement and velocity: of sums that cancel, beside an `offset` of the term of order
    /// zero.
    pub(crate) fn leading_zeros(
        &self,
        (row, [by_displacement, by_velocity]): (&ModalRow, [f64; 2]),
        terms: &Terms,
        offset: f64,
    ) -> usize {
        let is_noise = |k: usize, noise: f64| {
            let term = terms[k].abs();
            // Beyond the last stands what longer series left.
            !(term > noise && term > NEGLIGIBLE_START * maximum(&terms[k..=self.last]))
        };
        // Most start clear of zero.
        let clear = CLEAR_OF_ZERO * (by_displacement.abs() + by_velocity.abs());
        if !is_noise(0, clear) {
            return 0;
        }
        let magnitude = |k: usize, factor: f64, terms: &[Lane]| match factor {
            0.0 => 0.0,
            _ => factor.abs() * row.dot_magnitudes(&terms[k * self.lanes..][..self.lanes]),
        };
        let leading = LEADING.min(self.last + 1);
        for k in 0..leading {
            if k > 0 && !is_noise(k, clear) {
                return k;
            }
            let offset = if k == 0 { offset } else { 0.0 };
            let sum = magnitude(k, by_displacement, &self.displacement)
                + magnitude(k, by_velocity, &self.velocity);
            if !is_noise(k, ROUND_OFF * (sum + offset)) {
                return k;
            }
        }
        leading
    }

    /// Value and derivative with respect to theta.
    pub(crate) fn at(&self, terms: &Terms, theta: f64) -> (f64, f64) {
        value_and_slope(terms, self.last, theta)
    }

    /// Maximum value above `floor`, with its theta, of a scalar series with its end and the bound
    /// of the distance from the chord.
    #[inline]
    pub(crate) fn maximum(
        &self,
        terms: &Terms,
        (after, bend): (f64, f64),
        floor: f64,
    ) -> Option<(f64, f64)> {
        if terms[0].max(after) + bend <= floor {
            return None;
        }
        let ends = match after > terms[0] {
            true => (1.0, after),
            false => (0.0, terms[0]),
        };
        // A larger change excludes a turning point inside.
        if (after - terms[0]).abs() > 4.0 * bend {
            return (ends.1 > floor).then_some(ends);
        }
        let (theta, _) = maximum_above(&self.fitted(terms), floor)?;
        Some((theta, self.at(terms, theta).0))
    }

    /// Value at the end, and the bound of the distance from the chord.
    pub(crate) fn end_and_bend(&self, terms: &Terms) -> (f64, f64) {
        end_and_bend(terms, self.last)
    }
}

/// Whether a series that starts from `first` stays clear of zero and positive, so that its start is
/// no root either, by its end and the bound of the distance from the chord.
pub(super) fn stays_positive(first: f64, (after, bend): (f64, f64)) -> bool {
    !(first <= CLEAR_OF_ZERO) && first.min(after) - bend > 0.0
}

/// Bound of the rate (1/s) of so many closed levels with these stiffnesses (N/m) and dashpots
/// (N s/m). They act through the mobility (1/kg): the eigenvalues of their product with it, which
/// are those of a symmetric matrix and so bound what contacts add to the motion, are at most the
/// greatest sum over a row (Gershgorin), and at most the sum over the diagonal. Levels that share no
/// floor do not add up.
fn contact_rate(mobility: &[f64], count: usize, law: impl Fn(usize) -> [f64; 2]) -> f64 {
    let (mut greatest, mut diagonal) = ([0.0_f64; 2], [0.0_f64; 2]);
    for (l, row) in mobility.chunks(count.max(1)).enumerate() {
        let mut sums = [0.0; 2];
        for (m, mobility) in row.iter().enumerate() {
            for (k, law) in law(m).into_iter().enumerate() {
                let part = (mobility * law).abs();
                sums[k] += part;
                if l == m {
                    diagonal[k] += part;
                }
            }
        }
        greatest = [greatest[0].max(sums[0]), greatest[1].max(sums[1])];
    }
    greatest[0].min(diagonal[0]).sqrt() + greatest[1].min(diagonal[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_that_share_no_floor_do_not_add_up() {
        let laws = [[50.0, 3.0], [27.0, 4.0]];
        let rate = contact_rate(&[2.0, 0.0, 0.0, 3.0], 2, |l| laws[l]);
        assert_eq!(rate, 10.0 + 12.0);
        assert_eq!(contact_rate(&[], 0, |_| [1.0; 2]), 0.0);
    }

    /// Against the largest eigenvalue by the power method, of levels that share floors.
    #[test]
    fn the_rate_of_levels_bounds_their_eigenvalues() {
        let mut closest = f64::INFINITY;
        for seed in 0..200 {
            let count = 2 + seed % 5;
            let number = |k: usize| libm::sin((seed * 97 + k) as f64 * 1.3);
            let row = |l: usize| std::array::from_fn::<_, 4, _>(|j| number(7 * l + j));
            let product = |a: [f64; 4], b: [f64; 4]| -> f64 { (0..4).map(|j| a[j] * b[j]).sum() };
            let mobility: Vec<f64> = (0..count * count)
                .map(|i| product(row(i / count), row(i % count)))
                .collect();
            let stiffness: Vec<f64> = (0..count).map(|l| 1.5 + number(500 + l)).collect();
            let rate = contact_rate(&mobility, count, |l| [stiffness[l], 0.0]);
            let mut x = vec![1.0; count];
            let mut eigenvalue = 0.0;
            for _ in 0..2000 {
                let y: Vec<f64> = (0..count)
                    .map(|l| {
                        (0..count)
                            .map(|m| mobility[l * count + m] * stiffness[m] * x[m])
                            .sum()
                    })
                    .collect();
                eigenvalue = y.iter().fold(0.0_f64, |most, y| most.max(y.abs()));
                x = y.iter().map(|y| y / eigenvalue).collect();
            }
            let ratio = rate * rate / eigenvalue;
            assert!(ratio >= 1.0 - 1e-9, "{seed}: {ratio}");
            closest = closest.min(ratio);
        }
        assert!(closest < 1.2, "{closest}");
    }
}
