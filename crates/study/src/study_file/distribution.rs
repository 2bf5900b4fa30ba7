//! Random numbers: their distribution, and what a study file says of it.

use std::fmt;
use std::ops::Range;

use pounding_case::document::{AboveZero, Entry, Fault, Field, Optional, Reader, Within, Written};
use pounding_case::{Dimension, Located};
use pounding_catalogue::numbers::six_digits;
use pounding_ground_motion::distributions::{normal_distribution, normal_quantile};
use schemars::JsonSchema;
use serde::Deserialize;

use super::keys::lacks;

/// How a random number is distributed, possibly between bounds.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    family: Family,
    /// The mean of a normal, the median of a lognormal distribution, without bounds.
    centre: f64,
    /// The standard deviation of the number, or of its logarithm, without bounds.
    spread: f64,
    lower: Option<f64>,
    upper: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Family {
    Normal,
    Lognormal,
}

/// What a study file may call a family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(
    rename = "distribution",
    rename_all = "snake_case",
    expecting = "a text in quotes"
)]
enum Kind {
    Normal,
    Lognormal,
    /// Refused: it is a range of the variable itself.
    #[schemars(skip)]
    Uniform,
}

/// Least probability of a number: that of the finest random number is zero.
const LEAST_PROBABILITY: f64 = f64::EPSILON / 8.0;

impl Distribution {
    /// The least number, if there is one.
    #[must_use]
    pub fn lower(&self) -> Option<f64> {
        self.lower
    }

    /// The number that it stays below with this probability, a decimal number of 12 digits, so that a file that
    /// holds it is read back as the same number, and libraries that differ in the last bit give the same.
    ///
    /// Between bounds probabilities are in proportion to those without.
    #[must_use]
    pub fn quantile(&self, probability: f64) -> f64 {
        let below = self.lower.map_or(0.0, |x| self.probability(x, 1.0));
        let above = self.upper.map_or(0.0, |x| self.probability(x, -1.0));
        let between = 1.0 - below - above;
        let probability = probability.clamp(LEAST_PROBABILITY, 1.0 - f64::EPSILON);
        let from_below = below + probability * between;
        // From the nearer end, where probabilities have all their digits.
        let z = match from_below <= 0.5 {
            true => normal_quantile(from_below),
            false => -normal_quantile(above + (1.0 - probability) * between),
        };
        let x = match self.family {
            Family::Normal => self.centre + self.spread * z,
            Family::Lognormal => self.centre * libm::exp(self.spread * z),
        };
        let x = format!("{x:.11e}").parse().unwrap_or(x);
        x.max(self.lower.unwrap_or(f64::NEG_INFINITY))
            .min(self.upper.unwrap_or(f64::INFINITY))
    }

    /// The probability without bounds of numbers below this one, or above it by the other sign.
    fn probability(&self, x: f64, sign: f64) -> f64 {
        let z = match self.family {
            Family::Normal => (x - self.centre) / self.spread,
            Family::Lognormal if x > 0.0 => libm::log(x / self.centre) / self.spread,
            Family::Lognormal => f64::NEG_INFINITY,
        };
        normal_distribution(sign * z)
    }
}

impl fmt::Display for Distribution {
    /// In words, with numbers in SI units.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [centre, spread] = [self.centre, self.spread].map(six_digits);
        match self.family {
            Family::Normal => write!(f, "normal, mean {centre}, standard deviation {spread}")?,
            Family::Lognormal => write!(f, "lognormal, median {centre}, dispersion {spread}")?,
        }
        for (word, bound) in [("from", self.lower), ("to", self.upper)] {
            if let Some(bound) = bound {
                write!(f, ", {word} {}", six_digits(bound))?;
            }
        }
        Ok(())
    }
}

/// A random number
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "distribution",
    expecting = "a table\nwrite a table, { kind = \"lognormal\", median = 1, dispersion = 0.2 }"
)]
pub(super) struct DistributionTable {
    /// normal or lognormal; even ones between two numbers are `from` and `to` of the variable
    kind: Field<Kind>,
    /// Mean
    mean: Optional<Written>,
    /// Median of a lognormal distribution, in the place of its mean
    median: Optional<Written>,
    /// Standard deviation
    standard_deviation: Optional<Written>,
    /// Standard deviation over the mean, in its place
    coefficient_of_variation: Optional<Written>,
    /// Standard deviation of the natural logarithm, in the place of both
    dispersion: Optional<Written>,
    /// Least number; probabilities of others keep their proportions
    lower: Optional<Written>,
    /// Greatest number
    upper: Optional<Written>,
}

/// A key of the table with its number and where it stands.
struct Stated {
    key: &'static str,
    number: f64,
    at: Located<Written>,
}

impl DistributionTable {
    /// The distribution of a table that stands here, and the places of numbers that it may be: its centre and its
    /// bounds. `number` reads such a number.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        span: Range<usize>,
        number: &dyn Fn(Written) -> Result<f64, Fault>,
    ) -> Option<(Distribution, Vec<Located<Written>>)> {
        let one = |key, given: Optional<Written>, read: &dyn Fn(Written) -> Result<f64, Fault>| {
            let Some(at) = given.stated()? else {
                return Some(None);
            };
            let number = reader.keep(&at.span, key, read(at.value.clone()))?;
            Some(Some(Stated { key, number, at }))
        };
        let positive = |written: Written| {
            let x = written.of(Dimension::NUMBER)?;
            AboveZero::check(x).map(|()| x)
        };
        let plain = |written: Written| {
            let x = written.any()?.value;
            AboveZero::check(x).map(|()| x)
        };
        let family = match self.kind.located() {
            None => None,
            Some(Located { value, span }) => match value {
                Kind::Normal => Some(Family::Normal),
                Kind::Lognormal => Some(Family::Lognormal),
                Kind::Uniform => {
                    let message = "a uniform distribution is a range of the variable itself";
                    let help = "write `from = ...` and `to = ...` in the place of `distribution`";
                    return reader.refuse(span, message, help);
                }
            },
        };
        let mean = one("mean", self.mean, number);
        let median = one("median", self.median, number);
        let lower = one("lower", self.lower, number);
        let upper = one("upper", self.upper, number);
        let deviation = one("standard_deviation", self.standard_deviation, &plain);
        let variation = one(
            "coefficient_of_variation",
            self.coefficient_of_variation,
            &positive,
        );
        let dispersion = one("dispersion", self.dispersion, &positive);
        let family = family?;
        let centre = only(reader, &span, [mean?, median?], "mean");
        let wanted = match family {
            Family::Normal => "standard_deviation",
            Family::Lognormal => "dispersion",
        };
        let spread = only(reader, &span, [deviation?, variation?, dispersion?], wanted);
        let (lower, upper) = (lower?, upper?);
        let (centre, spread) = (centre?, spread?);
        let (middle, width) = match family {
            Family::Normal => normal(reader, &centre, &spread)?,
            Family::Lognormal => lognormal(reader, &centre, &spread)?,
        };
        if let (Some(low), Some(high)) = (&lower, &upper)
            && low.number >= high.number
        {
            let message = "`upper` is not above `lower`";
            return reader.refuse(high.at.span.clone(), message, "exchange or correct them");
        }
        for (bound, outside) in [
            (&lower, lower.as_ref().is_some_and(|b| b.number > middle)),
            (&upper, upper.as_ref().is_some_and(|b| b.number < middle)),
        ] {
            if let Some(bound) = bound.as_ref().filter(|_| outside) {
                let side = if bound.key == "lower" {
                    "above"
                } else {
                    "below"
                };
                let message = format!(
                    "`{}` lies {side} the {} of the distribution, {}",
                    bound.key,
                    if family == Family::Normal {
                        "mean"
                    } else {
                        "median"
                    },
                    six_digits(middle)
                );
                let help = "correct it: bounds cut the ends of a distribution off";
                return reader.refuse(bound.at.span.clone(), message, help);
            }
        }
        let bound = |stated: &Option<Stated>| stated.as_ref().map(|stated| stated.number);
        let distribution = Distribution {
            family,
            centre: middle,
            spread: width,
            lower: bound(&lower),
            upper: bound(&upper),
        };
        let places = [Some(centre), lower, upper].into_iter().flatten();
        Some((distribution, places.map(|stated| stated.at).collect()))
    }
}

/// The one that is given of keys that exclude one another.
fn only<const N: usize>(
    reader: &Reader<'_>,
    span: &Range<usize>,
    keys: [Option<Stated>; N],
    wanted: &str,
) -> Option<Stated> {
    let mut given = keys.into_iter().flatten();
    let Some(first) = given.next() else {
        return lacks(reader, "the distribution", span.clone(), wanted);
    };
    let Some(other) = given.next() else {
        return Some(first);
    };
    let message = format!(
        "the distribution has `{}` and `{}`, which exclude one another",
        first.key, other.key
    );
    reader.refuse(other.at.span, message, "remove one of them")
}

/// Mean and standard deviation of a normal distribution.
fn normal(reader: &Reader<'_>, centre: &Stated, spread: &Stated) -> Option<(f64, f64)> {
    if centre.key == "median" {
        let message = "a normal distribution has a `mean`, which is its median too";
        return reader.refuse(centre.at.span.clone(), message, "write mean = ...");
    }
    let deviation = match spread.key {
        "standard_deviation" => {
            same_unit(reader, centre, spread)?;
            spread.number
        }
        "coefficient_of_variation" if centre.number == 0.0 => {
            let message = "a mean of zero has no `coefficient_of_variation`";
            let help = "write standard_deviation = ...";
            return reader.refuse(spread.at.span.clone(), message, help);
        }
        "coefficient_of_variation" => spread.number * centre.number.abs(),
        _ => {
            let message = "a normal distribution has no `dispersion`, that of logarithms";
            let help = "write standard_deviation = ..., or coefficient_of_variation = ...; or kind = \"lognormal\"";
            return reader.refuse(spread.at.span.clone(), message, help);
        }
    };
    Some((centre.number, deviation))
}

/// Median and dispersion of a lognormal distribution (Benjamin and Cornell, Probability, Statistics, and Decision
/// for Civil Engineers, 1970, eqs. 3.3.29 to 3.3.31).
fn lognormal(reader: &Reader<'_>, centre: &Stated, spread: &Stated) -> Option<(f64, f64)> {
    if centre.number <= 0.0 {
        let message = format!(
            "the `{}` of a lognormal distribution is above zero",
            centre.key
        );
        return reader.refuse(
            centre.at.span.clone(),
            message,
            "correct it, or write kind = \"normal\"",
        );
    }
    let of_variation = |variation: f64| libm::sqrt(libm::log1p(variation * variation));
    let dispersion = match spread.key {
        "dispersion" => spread.number,
        "coefficient_of_variation" => of_variation(spread.number),
        _ if centre.key == "median" => {
            let message = "`standard_deviation` goes with the `mean` of a lognormal distribution";
            let help = "write dispersion = ... or coefficient_of_variation = ... beside the median";
            return reader.refuse(spread.at.span.clone(), message, help);
        }
        _ => {
            same_unit(reader, centre, spread)?;
            of_variation(spread.number / centre.number)
        }
    };
    let median = match centre.key {
        "median" => centre.number,
        _ => centre.number * libm::exp(-0.5 * dispersion * dispersion),
    };
    Some((median, dispersion))
}

/// Whether a standard deviation is of the kind of its mean.
fn same_unit(reader: &Reader<'_>, centre: &Stated, spread: &Stated) -> Option<()> {
    let dimension = |stated: &Stated| stated.at.value.clone().any().ok()?.dimension;
    let (of_centre, of_spread) = (dimension(centre), dimension(spread));
    // A plain number is SI, whatever it is of; a unit beside a mean without one could be of anything.
    if of_spread.is_none() || of_centre == of_spread {
        return Some(());
    }
    let message = match (of_centre, of_spread) {
        (Some(a), Some(b)) => format!("the `mean` is {a}, and its `standard_deviation` {b}"),
        _ => "`standard_deviation` has a unit, and the `mean` has none".to_owned(),
    };
    reader.refuse(spread.at.span.clone(), message, "give both the same unit")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, exact: f64) {
        assert!(
            (found - exact).abs() <= 2.0e-11 * exact.abs(),
            "{found} for {exact}"
        );
    }

    /// Quantiles by SciPy 1.17: `norm(2, 0.5).ppf`, `lognorm(0.3, scale=2).ppf`, `truncnorm(-2, 3, loc=2, scale=0.5).ppf`,
    /// and of the second distribution above 1.5 by its `sf` and `isf`.
    #[test]
    fn quantiles_are_those_of_an_independent_program() {
        let of = |family, spread, lower, upper| Distribution {
            family,
            centre: 2.0,
            spread,
            lower,
            upper,
        };
        let normal = of(Family::Normal, 0.5, None, None);
        let lognormal = of(Family::Lognormal, 0.3, None, None);
        let between = of(Family::Normal, 0.5, Some(1.0), Some(3.5));
        let long = of(Family::Lognormal, 0.3, Some(1.5), None);
        QUANTILES.iter().for_each(|[p, a, b, c, d]| {
            near(normal.quantile(*p), *a);
            near(lognormal.quantile(*p), *b);
            near(between.quantile(*p), *c);
            near(long.quantile(*p), *d);
        });
    }

    const QUANTILES: [[f64; 5]; 6] = [
        [
            1e-6,
            -0.376712154411,
            0.480523034994,
            1.00000903746,
            1.50000148488,
        ],
        [
            0.01,
            0.836826062980,
            0.995254115815,
            1.07743373882,
            1.51469278778,
        ],
        [
            0.2,
            1.57918938321,
            1.55373360281,
            1.61039859229,
            1.76003209346,
        ],
        [0.5, 2.0, 2.0, 2.01341221614, 2.13207113198],
        [
            0.9,
            2.64077578277,
            2.93765795583,
            2.64380782322,
            3.02969566912,
        ],
        [
            0.999999,
            4.37671215441,
            8.32426274849,
            3.49988993557,
            8.41774907072,
        ],
    ];

    /// No number is infinite, and none lies beyond a bound.
    #[test]
    fn ends_are_finite_and_within_bounds() {
        for family in [Family::Normal, Family::Lognormal] {
            let mut distribution = Distribution {
                family,
                centre: 1.0,
                spread: 0.4,
                lower: None,
                upper: None,
            };
            let ends = [0.0, 1.0].map(|p| distribution.quantile(p));
            assert!(ends[0] < ends[1] && ends.iter().all(|x| x.is_finite()));
            (distribution.lower, distribution.upper) = (Some(0.7), Some(1.0));
            near(distribution.quantile(0.0), 0.7);
            near(distribution.quantile(1.0), 1.0);
            assert!(distribution.quantile(1.0) <= 1.0 && distribution.quantile(0.0) >= 0.7);
        }
    }
}
