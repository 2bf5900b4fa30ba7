//! Axes: ranges, ticks and their labels.

use serde::{Deserialize, Serialize};

/// How an axis divides its range.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Evenly; zero is in the range.
    Linear,
    /// By powers of ten; values that are not positive are left out.
    Logarithmic,
    /// A row for each of these names, the first on top; the values are their numbers from zero.
    Names(Vec<String>),
}

/// An axis before its range is known.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// How it is divided.
    pub scale: Scale,
    /// First and last value; by default those of the curves, with a margin.
    pub range: Option<(f64, f64)>,
}

impl Axis {
    /// A linear axis with zero.
    pub fn linear(label: &str) -> Self {
        Self::of(label, Scale::Linear)
    }

    /// A logarithmic axis.
    pub fn logarithmic(label: &str) -> Self {
        Self::of(label, Scale::Logarithmic)
    }

    fn of(label: &str, scale: Scale) -> Self {
        Self {
            label: label.to_owned(),
            scale,
            range: None,
        }
    }

    /// The same axis over this range.
    pub fn over(self, first: f64, last: f64) -> Self {
        Self {
            range: Some((first, last)),
            ..self
        }
    }
}

/// An axis with its range.
#[derive(Debug, Clone, PartialEq)]
pub struct Range {
    first: f64,
    last: f64,
    scale: Scale,
}

/// Values beyond this would make a range that is not finite.
const GREATEST: f64 = 1.0e150;

impl Range {
    /// The range of an axis for these values, with a part of it as margin.
    pub fn of(axis: &Axis, values: impl Iterator<Item = f64>, margin: f64) -> Self {
        let logarithmic = axis.scale == Scale::Logarithmic;
        let usable = values.filter(|x| x.abs() < GREATEST && (!logarithmic || *x > 0.0));
        let (low, high) = usable.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| {
            (l.min(x), h.max(x))
        });
        let empty = low > high;
        let scale = axis.scale.clone();
        let (first, last) = match (&axis.scale, axis.range) {
            (_, Some(range)) => range,
            (Scale::Names(names), None) => (-0.5, names.len() as f64 - 0.5),
            (Scale::Logarithmic, None) if empty => (0.1, 1.0),
            (Scale::Logarithmic, None) => {
                let high = if high > low { high } else { 10.0 * low };
                // A decade that is begun is shown to a round number.
                let part = (high / low).powf(margin);
                (low / part, high * part)
            }
            (Scale::Linear, None) => {
                let (low, high) = if empty {
                    (0.0, 0.0)
                } else {
                    (low.min(0.0), high.max(0.0))
                };
                // Nothing but zeros are seen as such beside one.
                let high = if high > low { high } else { 1.0 };
                let width = high - low;
                let below = if low < 0.0 { margin * width } else { 0.0 };
                (low - below, high + margin * width)
            }
        };
        Self { first, last, scale }
    }

    /// Where a value lies, zero at the first and one at the last; `None` for one that has no
    /// place.
    pub fn place(&self, x: f64) -> Option<f64> {
        let part = match self.scale {
            Scale::Logarithmic if x > 0.0 => (x / self.first).ln() / (self.last / self.first).ln(),
            Scale::Logarithmic => return None,
            // The first name on top.
            Scale::Names(_) => (self.last - x) / (self.last - self.first),
            _ => (x - self.first) / (self.last - self.first),
        };
        part.is_finite().then_some(part.clamp(-9.0, 10.0))
    }

    /// Values with their labels, at most so many of a linear axis.
    pub fn ticks(&self, most: usize) -> Vec<(f64, String)> {
        match &self.scale {
            Scale::Names(names) => {
                let names = names.iter().enumerate();
                names.map(|(i, name)| (i as f64, name.clone())).collect()
            }
            Scale::Logarithmic => self.powers(most),
            Scale::Linear => self.even(most),
        }
    }

    /// Round values an even step apart: one, two or five times a power of ten.
    fn even(&self, most: usize) -> Vec<(f64, String)> {
        let width = self.last - self.first;
        let least = width / most.max(2) as f64;
        let power = 10.0_f64.powf(least.log10().floor());
        let steps = [0.2, 0.5, 1.0, 2.0, 5.0, 10.0].map(|x| x * power);
        let ends = |step: f64| {
            let first = (self.first / step - 1e-9).ceil() as i64;
            let last = (self.last / step + 1e-9).floor() as i64;
            (first, last)
        };
        let place = steps.iter().position(|s| *s >= least * (1.0 - 1e-9));
        let place = place.unwrap_or(steps.len() - 1);
        // One value alone has no scale.
        let scaled = |step: &&f64| ends(**step).1 > ends(**step).0;
        let step = steps[..=place].iter().rev().find(scaled);
        let step = *step.unwrap_or(&steps[place]);
        let (first, last) = ends(step);
        let values: Vec<f64> = (first..=last).map(|i| i as f64 * step).collect();
        let greatest = values.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let decimals = (-step.log10() - 1e-9).ceil().max(0.0) as usize;
        let label = |x: f64| {
            if greatest >= 1e6 || decimals > 5 {
                power_of_ten(x)
            } else {
                let text = format!("{x:.decimals$}");
                // Round-off around zero has no sign.
                let zero = text.trim_start_matches('-').chars();
                let zero = zero.clone().all(|c| c == '0' || c == '.');
                if zero {
                    "0".to_owned()
                } else {
                    text.replace('-', "\u{2212}")
                }
            }
        };
        values.into_iter().map(|x| (x, label(x))).collect()
    }

    /// Powers of ten, and twice and five times these where there are few; all multiples, or even
    /// steps, where these are fewer than two.
    fn powers(&self, most: usize) -> Vec<(f64, String)> {
        const FEW: [f64; 3] = [1.0, 2.0, 5.0];
        const ALL: [f64; 9] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let decades = (self.last / self.first).log10();
        let every = (decades / most.max(2) as f64).ceil().max(1.0) as i32;
        let usual = if decades > 2.5 { &FEW[..1] } else { &FEW };
        let tried = [(every, usual), (1, usual), (1, &ALL)];
        let inside = tried.into_iter().map(|(every, f)| self.multiples(every, f));
        let Some(inside) = inside.into_iter().find(|inside| inside.len() > 1) else {
            return self.even(most);
        };
        let plain = self.first >= 9e-4 && self.last <= 1.1e4;
        let label = |x: f64| {
            if plain {
                let decimals = (-x.log10() - 1e-9).ceil().max(0.0) as usize;
                format!("{x:.decimals$}")
            } else {
                power_of_ten(x)
            }
        };
        inside.into_iter().map(|x| (x, label(x))).collect()
    }

    /// These multiples of every so many powers of ten, inside the range.
    fn multiples(&self, every: i32, factors: &[f64]) -> Vec<f64> {
        let from = self.first.log10().floor() as i32;
        let to = self.last.log10().ceil() as i32;
        let powers = (from..=to).filter(|p| p.rem_euclid(every) == 0);
        let values = powers.flat_map(|p| factors.iter().map(move |f| f * 10.0_f64.powi(p)));
        let inside = self.first * (1.0 - 1e-9)..=self.last * (1.0 + 1e-9);
        values.filter(|x| inside.contains(x)).collect()
    }

    /// Values between the ticks of a logarithmic axis, without labels.
    pub fn minor_ticks(&self) -> Vec<f64> {
        if self.scale != Scale::Logarithmic {
            return Vec::new();
        }
        let from = self.first.log10().floor() as i32;
        let to = self.last.log10().ceil() as i32;
        if to - from > 8 {
            return Vec::new();
        }
        let values =
            (from..=to).flat_map(|p| (2..10).map(move |f| f64::from(f) * 10.0_f64.powi(p)));
        values
            .filter(|x| (self.first..=self.last).contains(x))
            .collect()
    }
}

/// `2×10⁻⁵`, `10³`, `0`.
fn power_of_ten(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let exponent = (x.abs().log10() + 1e-9).floor();
    let mantissa = x / 10.0_f64.powf(exponent);
    let digits: String = format!("{exponent:.0}")
        .chars()
        .map(|c| match c {
            '-' => '\u{207b}',
            '0' => '\u{2070}',
            '1' => '\u{b9}',
            '2' => '\u{b2}',
            '3' => '\u{b3}',
            '4' => '\u{2074}',
            '5' => '\u{2075}',
            '6' => '\u{2076}',
            '7' => '\u{2077}',
            '8' => '\u{2078}',
            _ => '\u{2079}',
        })
        .collect();
    let shown = format!("{mantissa:.1}")
        .replace(".0", "")
        .replace('-', "\u{2212}");
    match shown.as_str() {
        "1" => format!("10{digits}"),
        "\u{2212}1" => format!("\u{2212}10{digits}"),
        _ => format!("{shown}\u{d7}10{digits}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis, values: &[f64]) -> Vec<String> {
        let range = Range::of(axis, values.iter().copied(), 0.0);
        range.ticks(6).into_iter().map(|(_, label)| label).collect()
    }

    #[test]
    fn labels_have_no_needless_digits() {
        let linear = Axis::linear("x");
        assert_eq!(
            labels(&linear, &[3000.0]),
            ["0", "500", "1000", "1500", "2000", "2500", "3000"]
        );
        assert_eq!(
            labels(&linear, &[-0.2, 0.3]),
            ["\u{2212}0.2", "\u{2212}0.1", "0", "0.1", "0.2", "0.3"]
        );
        // A gap that never closes has no force.
        assert_eq!(
            labels(&linear, &[0.0, 0.0]),
            ["0", "0.2", "0.4", "0.6", "0.8", "1.0"]
        );
        assert_eq!(labels(&linear, &[2e7])[1], "5\u{d7}10\u{2076}");
        let log = Axis::logarithmic("x");
        assert_eq!(
            labels(&log, &[0.05, 4.0]),
            ["0.05", "0.1", "0.2", "0.5", "1", "2"]
        );
        assert_eq!(
            labels(&log, &[1e-5, 1e-2]),
            [
                "10\u{207b}\u{2075}",
                "10\u{207b}\u{2074}",
                "10\u{207b}\u{b3}",
                "10\u{207b}\u{b2}"
            ]
        );
        for wrong in labels(&linear, &[-1e-17, 1.0]) {
            assert!(!wrong.starts_with("\u{2212}"), "{wrong}");
        }
    }

    /// However few fit, two ticks give the scale of an axis.
    #[test]
    fn an_axis_has_two_ticks() {
        let linear = |ends: (f64, f64)| Axis::linear("x").over(ends.0, ends.1);
        let logarithmic = |ends: (f64, f64)| Axis::logarithmic("x").over(ends.0, ends.1);
        for most in 2..=10 {
            for axis in [
                linear((-0.876, 0.876)),
                linear((-0.5, 0.9)),
                linear((0.0, 1.9)),
                linear((-4.99, 4.99)),
                logarithmic((1.1, 1.9)),
                logarithmic((2.1, 4.9)),
                logarithmic((3.1, 3.8)),
                logarithmic((11.0, 9.9e3)),
            ] {
                let ticks = Range::of(&axis, [].into_iter(), 0.0).ticks(most);
                assert!(ticks.len() >= 2, "{axis:?} {most} {ticks:?}");
            }
        }
        let range = Range::of(&linear((-0.876, 0.876)), [].into_iter(), 0.0);
        let ticks = range.ticks(2).into_iter().map(|(_, label)| label);
        let labels: Vec<String> = ticks.collect();
        assert_eq!(labels, ["\u{2212}0.5", "0", "0.5"]);
    }

    #[test]
    fn places_run_from_zero_to_one() {
        let log = Range::of(&Axis::logarithmic("x"), [0.1, 10.0].into_iter(), 0.0);
        assert!((log.place(1.0).unwrap_or(9.0) - 0.5).abs() < 1e-12);
        assert_eq!(log.place(0.0), None);
        let names = Axis {
            label: String::new(),
            scale: Scale::Names(vec!["a".to_owned(), "b".to_owned()]),
            range: None,
        };
        let names = Range::of(&names, [].into_iter(), 0.0);
        assert_eq!(names.place(0.0), Some(0.75));
        assert_eq!(names.place(1.0), Some(0.25));
        // Nothing to show is an axis all the same.
        let empty = Range::of(&Axis::linear("x"), [].into_iter(), 0.05);
        assert!(empty.place(0.0).is_some());
    }
}
