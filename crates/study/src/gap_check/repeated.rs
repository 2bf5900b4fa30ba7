//! Records that are one motion under several names.

use std::cell::OnceCell;

use pounding_catalogue::wording::counted;
use pounding_ground_motion::Accelerogram;

use super::averaged::{Averaged, OVERLAP};
use super::records::CaseUnderRecord;

/// Which records are copies of others: the same samples as they are used, but for a factor, its
/// sign, what is cut off at the ends, digits, and the time step.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Repeated {
    /// Records of one motion, by their numbers from zero: two or more together.
    pub groups: Vec<Vec<usize>>,
    /// Records without the copies.
    pub distinct: usize,
}

impl Repeated {
    /// Copies among the records of a case.
    pub(crate) fn among(records: &[CaseUnderRecord]) -> Self {
        let shapes = records.iter().map(|r| Shape::of(&r.assembly.accelerogram));
        let shapes: Vec<Shape<'_>> = shapes.collect();
        Self::by(records.len(), |a, b| shapes[a].is_that_of(&shapes[b]))
    }

    /// Copies among so many records, of which two are one motion or not.
    pub(crate) fn by(count: usize, same: impl Fn(usize, usize) -> bool) -> Self {
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for r in 0..count {
            match groups.iter_mut().find(|group| same(group[0], r)) {
                Some(group) => group.push(r),
                None => groups.push(vec![r]),
            }
        }
        let distinct = groups.len();
        groups.retain(|group| group.len() > 1);
        Self { groups, distinct }
    }

    /// What the user should know of records with these names.
    pub(crate) fn warnings(&self, names: &[&str]) -> Vec<String> {
        let warning = |group: &Vec<usize>| {
            let names: Vec<&str> = group.iter().map(|r| names[*r]).collect();
            let (last, others) = names.split_last().unwrap_or((&"", &[]));
            format!(
                "{} and {last} are the same motion, at most scaled, reversed, cut or at another time step: they are one record, of {} in all, and weigh in every statistic as several; name each record once",
                others.join(", "),
                counted(self.distinct, "record"),
            )
        };
        self.groups.iter().map(warning).collect()
    }
}

/// What two records of one motion may differ by, over their root mean square: more than the digits
/// of any format leave out, far less than any two components do.
const DIFFERENCE: f64 = 1.0e-3;

/// What tells a motion from others: its samples with the place of their peak.
#[derive(Debug)]
pub(crate) struct Shape<'a> {
    record: &'a Accelerogram,
    peak: Option<usize>,
    /// Sum of all squares.
    squares: f64,
    /// Whether it may be that of a record at another time step.
    of_a_file: bool,
    /// The motion whatever its samples, where it comes to that.
    averaged: OnceCell<Averaged>,
}

impl<'a> Shape<'a> {
    pub(crate) fn of(record: &'a Accelerogram) -> Self {
        let samples = record.samples();
        Self {
            record,
            peak: place_of_peak(samples),
            squares: samples.iter().map(|x| x * x).sum(),
            of_a_file: true,
            averaged: OnceCell::new(),
        }
    }

    /// That of a motion that a generator made, of which none is sampled from another one.
    #[cfg(feature = "results")]
    pub(crate) fn of_generated(motion: &'a Accelerogram) -> Self {
        Self {
            of_a_file: false,
            ..Self::of(motion)
        }
    }

    /// Whether the record is the other one times a factor, cut at other times, in other digits or at
    /// another time step.
    pub(crate) fn is_that_of(&self, other: &Self) -> bool {
        if self.has_step_of(other) {
            return self.has_samples_of(other);
        }
        let moves = self.peak.is_some() && other.peak.is_some();
        let from_files = self.of_a_file && other.of_a_file;
        from_files && moves && self.averaged().is_that_of(other.averaged())
    }

    fn has_step_of(&self, other: &Self) -> bool {
        let [own, others] = [self, other].map(|shape| shape.record.time_step());
        (own - others).abs() <= 1.0e-9 * own
    }

    fn averaged(&self) -> &Averaged {
        self.averaged.get_or_init(|| Averaged::of(self.record))
    }

    /// The same at one time step: by the samples themselves.
    fn has_samples_of(&self, other: &Self) -> bool {
        let (first, second) = (self.record.samples(), other.record.samples());
        let (Some(i), Some(j)) = (self.peak, other.peak) else {
            // Both are zero throughout, or one of them.
            return self.peak == other.peak;
        };
        let before = i.min(j);
        let after = (first.len() - i).min(second.len() - j);
        let shorter = first.len().min(second.len());
        if ((before + after) as f64) < OVERLAP * shorter as f64 {
            return false;
        }
        let factor = second[j] / first[i];
        let (mut difference, mut whole) = (0.0, 0.0);
        let common = first[i - before..i + after].iter();
        for (x, y) in common.zip(&second[j - before..j + after]) {
            difference += (factor * x - y) * (factor * x - y);
            whole += y * y;
            // More than all samples allow: other motions part within a few of them.
            if difference > DIFFERENCE * DIFFERENCE * other.squares {
                return false;
            }
        }
        difference <= DIFFERENCE * DIFFERENCE * whole
    }
}

/// The first of the largest absolute values, if any is not zero.
fn place_of_peak(samples: &[f64]) -> Option<usize> {
    let mut peak = (0.0, None);
    for (i, x) in samples.iter().enumerate() {
        if x.abs() > peak.0 {
            peak = (x.abs(), Some(i));
        }
    }
    peak.1
}

#[cfg(test)]
mod tests {
    use pounding_ground_motion::AccelerationUnit;

    use super::*;

    fn record(samples: Vec<f64>) -> Accelerogram {
        let unit = AccelerationUnit::MetrePerSecondSquared;
        Accelerogram::new(samples, unit, 0.01).unwrap()
    }

    /// Two motions of many sines, with their peaks inside.
    fn motion(seed: f64) -> Vec<f64> {
        let at = |i: usize| {
            let t = 0.01 * i as f64;
            let sines = (1..20).map(|k| {
                let k = f64::from(k);
                libm::sin(k * (3.0 + seed) * t + k * k * seed) / k
            });
            sines.sum::<f64>() * libm::exp(-(t - 5.0) * (t - 5.0) / 8.0)
        };
        (0..1000).map(at).collect()
    }

    fn are_one_motion(a: &Accelerogram, b: &Accelerogram) -> bool {
        Shape::of(a).is_that_of(&Shape::of(b))
    }

    #[test]
    fn one_motion_in_other_forms() {
        let all = motion(0.3);
        let whole = record(all.clone());
        let scaled = record(all.iter().map(|x| -1.7 * x).collect());
        let cut = record(all[37..960].to_vec());
        let digits = record(all.iter().map(|x| (x * 1e5).round() * 1e-5).collect());
        for other in [&scaled, &cut, &digits] {
            assert!(are_one_motion(&whole, other) && are_one_motion(other, &whole));
        }
        let other = record(motion(0.31));
        assert!(!are_one_motion(&whole, &other));
        // The same samples at another time step are another motion.
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let slow = Accelerogram::new(all, unit, 0.02).unwrap();
        assert!(!are_one_motion(&whole, &slow) && !are_one_motion(&slow, &whole));
        // Two motions of equal envelopes and bands.
        assert!(!are_one_motion(&record(motion(2.0)), &record(motion(2.6))));
        let zeros = record(vec![0.0; 10]);
        assert!(are_one_motion(&zeros, &record(vec![0.0; 12])) && !are_one_motion(&zeros, &whole));
    }

    /// Twice as many samples on straight lines, and every second one alone, reversed and cut.
    #[test]
    fn one_motion_at_another_time_step() {
        let all = motion(0.3);
        let whole = record(all.clone());
        let unit = AccelerationUnit::MetrePerSecondSquared;
        let between = all.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
        let fine = all.iter().zip(between).flat_map(|(x, half)| [*x, half]);
        let fine = Accelerogram::new(fine.collect(), unit, 0.005).unwrap();
        let coarse = all.iter().skip(21).step_by(2).map(|x| -2.0 * x);
        let coarse = Accelerogram::new(coarse.collect(), unit, 0.02).unwrap();
        let other = record(motion(0.31));
        for copy in [&fine, &coarse] {
            assert!(are_one_motion(&whole, copy) && are_one_motion(copy, &whole));
            assert!(!are_one_motion(&other, copy) && !are_one_motion(copy, &other));
        }
        assert!(are_one_motion(&fine, &coarse) && are_one_motion(&coarse, &fine));
        let made = Shape::of_generated(&whole);
        assert!(!made.is_that_of(&Shape::of(&fine)));
    }
}
