//! Menegotto and Pinto's curved law of reinforcing steel.

use crate::descriptor::{Alias, LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::history::{Branch, History, Point, Side};
use crate::law::HysteresisLaw;
use crate::parameters::{
    HARDENING_RATIO, LawParameters, STIFFNESS, YIELD_FORCE, non_negative, positive,
};
use crate::path::PathLaw;

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "menegotto_pinto_1973",
    aliases: &[Alias {
        name: "giuffre_menegotto_pinto",
        citation: "common name of the form without isotropic hardening",
    }],
    title: "Menegotto-Pinto",
    formula: "f = r s + (1-r) s / (1 + |s|^R)^(1/R), from the last turning point (s = f = 0) to where its tangent k meets the yield line (s = f = 1);  R = R0 (1 - c1 p / (c2 + p)), p = |xm - x0| / xy, x0 where the two lines meet",
    citation: "Menegotto and Pinto, IABSE Symposium on Resistance and Ultimate Deformability of Structures, Lisbon (1973) 15; R as in Filippou, Popov and Bertero, Report UCB/EERC-83/19 (1983)",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        HARDENING_RATIO,
        positive(
            "curvature",
            ParameterUnit::One,
            "Exponent R0 of the first loading: the greater, the sharper the knee",
        )
        .within((1.0, false), (100.0, true))
        .default_to(20.0),
        non_negative(
            "curvature_loss",
            ParameterUnit::One,
            "Coefficient c1, below 1: share of R lost after large plastic excursions",
        )
        .within((0.0, true), (1.0, false))
        .default_to(0.925),
        positive(
            "curvature_excursion",
            ParameterUnit::One,
            "Coefficient c2: excursion over xy after which half of that is lost",
        )
        .default_to(0.15),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified(
        "Steel02 of OpenSees along a path with partial unloadings, to round-off (pounding verify structures); the bilinear law away from the knee for a large R0",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("hardening_ratio", 0.05),
        ("curvature", 15.0),
    ],
    example_amplitude: 0.05,
    traps: &[
        "Inner loops are not closed: reloading after a small unloading overshoots the curve it left.",
        "R can fall below 1.5 with the usual coefficients; the curve then approaches the yield line slowly.",
        "R falls to R0 (1 - c1) at the least. From 0.225 down whole cycles give back more than they took, from 0.25 up none does (measured, with amplitudes of 0.3 to 50 times the deformation at yield); below 0.3 the law is refused.",
        "The stored energy is F^2 / 2k; unloading is curved, so the dissipated energy steps back a little on it.",
    ],
    build,
};

#[derive(Debug)]
struct MenegottoPinto {
    stiffness: f64,
    yield_force: f64,
    hardening_ratio: f64,
    curvature: f64,
    curvature_loss: f64,
    curvature_excursion: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let least = get("curvature")? * (1.0 - get("curvature_loss")?);
    if least < LEAST_CURVATURE {
        return Err(HysteresisError::Inconsistent {
            law: DESCRIPTOR.name,
            reason: format!(
                "R falls to curvature (1 - curvature_loss) = {least:.3}, below {LEAST_CURVATURE}: the element would create energy"
            ),
            remedy: "raise `curvature`, mostly 10 to 20, or lower `curvature_loss`",
        });
    }
    Ok(Box::new(MenegottoPinto {
        stiffness: get("stiffness")?,
        yield_force: get("yield_force")?,
        hardening_ratio: get("hardening_ratio")?,
        curvature: get("curvature")?,
        curvature_loss: get("curvature_loss")?,
        curvature_excursion: get("curvature_excursion")?,
    }))
}

/// Least R after large excursions: a margin above where cycles create energy, of which the descriptor tells. Measured with R0
/// from 1.05 to 20 and hardening ratios of 0 and 0.05.
const LEAST_CURVATURE: f64 = 0.3;

/// `R ln s` from which the binomial series serves at the least: there each of its terms is
/// below a twentieth of the one before, times a factor that tends to 1.
const SERIES_FROM: f64 = 3.0;

/// Terms of a series at most.
const MOST_TERMS: u32 = 10_000;

/// Nodes and weights of Gauss's rule of ten points (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 5] = [
    (0.148_874_338_981_631_2, 0.295_524_224_714_752_9),
    (0.433_395_394_129_247_2, 0.269_266_719_309_996_4),
    (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
    (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
    (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
];

/// The curve of the held branch.
struct Curve {
    start: Point,
    /// From the start to where the tangents meet, in deformation (m).
    reach: f64,
    exponent: f64,
}

impl MenegottoPinto {
    fn curve(&self, history: &History) -> Curve {
        let branch = &history.branch;
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let start = branch.start;
        let line = branch.direction * self.yield_force * (1.0 - r) + r * k * start.deformation;
        let reach = (line - start.force) / (k * (1.0 - r));
        let meet = branch.direction * (start.deformation + reach);
        let farthest = history.side(branch.direction).peak.deformation;
        let excursion = (farthest - meet).abs() / (self.yield_force / k);
        let loss = self.curvature_loss * excursion / (self.curvature_excursion + excursion);
        Curve {
            start,
            reach,
            exponent: self.curvature * (1.0 - loss),
        }
    }

    fn branch(&self, direction: f64, start: Point) -> Branch {
        Branch::line(0, direction, start, self.stiffness).towards(direction)
    }
}

impl Curve {
    /// `s / (1 + |s|^R)^(1/R)` and its slope.
    fn bend(&self, share: f64) -> (f64, f64) {
        let size = share.abs();
        if size > 1.0 {
            // The same without overflow for large shares.
            let inverse = libm::pow(size, -self.exponent);
            let root = libm::pow(1.0 + inverse, -1.0 / self.exponent);
            let slope = root * inverse / ((1.0 + inverse) * size);
            return (root * share.signum(), slope);
        }
        let sum = 1.0 + libm::pow(size, self.exponent);
        let root = libm::pow(sum, -1.0 / self.exponent);
        (share * root, root / sum)
    }

    /// Integral of [`Curve::bend`] from zero, even in the share. With `t = s^R / (1 + s^R)`
    /// the curve is `t^(1/R)` and its integral the incomplete beta function
    /// `B(t; 2/R, -1/R) / R` (NIST Handbook of Mathematical Functions, section 8.17).
    fn area(&self, share: f64) -> f64 {
        let (s, exponent) = (share.abs(), self.exponent);
        if s <= 1.0 {
            return self.area_before_the_knee(s);
        }
        let behind = self.area_before_the_knee(1.0);
        let log = libm::log(s);
        // Its coefficients grow like powers of 1 / R.
        let from = SERIES_FROM.max(1.0 - libm::log(exponent));
        let near = log.min(from / exponent);
        let mut area = behind + self.area_at_the_knee(near);
        if log > near {
            area += self.area_beyond(near, log);
        }
        area
    }

    /// Up to a share of 1: the series of 8.17.8 in `t <= 1/2`, all of whose terms are
    /// positive.
    fn area_before_the_knee(&self, s: f64) -> f64 {
        let inverse = 1.0 / self.exponent;
        let power = libm::pow(s, self.exponent);
        let t = power / (1.0 + power);
        let (mut coefficient, mut sum) = (1.0_f64, 1.0_f64);
        for k in 1..MOST_TERMS {
            let k = f64::from(k);
            coefficient *= t * (k + inverse) / k;
            let term = coefficient * 2.0 * inverse / (2.0 * inverse + k);
            sum += term;
            if term <= f64::EPSILON * sum {
                break;
            }
        }
        let factor = libm::pow(1.0 + power, -2.0 * inverse);
        if factor == 0.0 {
            // An exponent so small leaves nothing of the curve.
            return 0.0;
        }
        0.5 * s * s * factor * sum
    }

    /// From a share of 1 to one whose logarithm is at most `SERIES_FROM / R`: Gauss's rule
    /// in `R ln s`, where the nearest singularity is pi away, and in `ln s`, by whose
    /// exponential the curve grows.
    fn area_at_the_knee(&self, log: f64) -> f64 {
        let panels = (self.exponent.max(1.0) * log).ceil().max(1.0);
        let half = 0.5 * log / panels;
        let mut area = 0.0;
        for panel in 0..panels as usize {
            let middle = half * (2.0 * panel as f64 + 1.0);
            for (node, weight) in GAUSS {
                for at in [middle - half * node, middle + half * node] {
                    area += half * weight * self.bend(libm::exp(at)).0 * libm::exp(at);
                }
            }
        }
        area
    }

    /// Between two shares, given by their logarithms, so far beyond the knee that the
    /// binomial series of `(1 + s^-R)^(-1/R)` converges fast.
    fn area_beyond(&self, from: f64, to: f64) -> f64 {
        let mut binomial = 1.0;
        let mut area = 0.0;
        for k in 0..MOST_TERMS {
            let k = f64::from(k);
            let power = 1.0 - k * self.exponent;
            let way = power * (to - from);
            let term = if way == 0.0 {
                to - from
            } else {
                libm::exp(power * from) * libm::expm1(way) / power
            };
            area += binomial * term;
            if (binomial * term).abs() <= f64::EPSILON * area {
                break;
            }
            binomial *= -(1.0 / self.exponent + k) / (k + 1.0);
        }
        area
    }
}

impl PathLaw for MenegottoPinto {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn stiffness_when_new(&self) -> f64 {
        self.stiffness
    }
    fn begin(&self) -> History {
        let mut history = History::new(self.branch(1.0, Point::default()));
        history.sides = [Side {
            peak: Point {
                deformation: self.yield_force / self.stiffness,
                force: self.yield_force,
            },
            ..Side::default()
        }; 2];
        history
    }
    fn on_branch(&self, history: &History, deformation: f64) -> (f64, f64) {
        let curve = self.curve(history);
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let way = deformation - curve.start.deformation;
        let (bend, slope) = if curve.reach == 0.0 {
            (0.0, 0.0)
        } else {
            curve.bend(way / curve.reach)
        };
        (
            curve.start.force + k * (r * way + (1.0 - r) * curve.reach * bend),
            k * (r + (1.0 - r) * slope),
        )
    }
    fn work(&self, history: &History, deformation: f64) -> f64 {
        let curve = self.curve(history);
        let (k, r) = (self.stiffness, self.hardening_ratio);
        let way = deformation - curve.start.deformation;
        let bent = if curve.reach == 0.0 {
            0.0
        } else {
            (1.0 - r) * curve.reach * curve.reach * curve.area(way / curve.reach)
        };
        history.branch.work + curve.start.force * way + k * (0.5 * r * way * way + bent)
    }
    fn stored(&self, history: &History, deformation: f64) -> f64 {
        let (force, _) = self.on_branch(history, deformation);
        0.5 * force * force / self.stiffness
    }
    fn turn(&self, history: &mut History, deformation: f64) {
        let (force, _) = self.on_branch(history, deformation);
        let direction = history.branch.direction;
        let next = self.branch(-direction, Point { deformation, force });
        self.switch(history, next);
        let peak = &mut history.side_mut(direction).peak;
        peak.deformation = peak.deformation.max(direction * deformation);
    }
    fn leave(&self, _: &mut History, _: f64) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The area against the closed forms for R = 2, `sqrt(1 + s^2) - 1`, and R = 1,
    /// `s - ln(1 + s)`, and otherwise against Gauss's rule on many short panels.
    #[test]
    fn the_area_under_the_curve() {
        let exponents = [
            5.0e-4, 0.01, 0.04, 0.3, 0.5, 0.99, 1.0, 1.01, 1.5, 2.0, 3.7, 15.0, 20.0, 60.0, 100.0,
        ];
        for exponent in exponents {
            let curve = Curve {
                start: Point::default(),
                reach: 1.0,
                exponent,
            };
            let (mut expected, mut at) = (0.0, 0.0_f64);
            let panel = |from: f64, to: f64| -> f64 {
                let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
                let points = GAUSS.iter().flat_map(|(x, w)| [(-x, w), (*x, w)]);
                points
                    .map(|(x, w)| half * w * curve.bend(middle + half * x).0)
                    .sum()
            };
            // Shorter towards zero, where a power that is not whole is not smooth.
            let mut marks: Vec<f64> = (0..40).map(|i| 0.25 * 0.5_f64.powi(40 - i)).collect();
            marks.extend((1..1600).map(|i| 0.25 + f64::from(i) * 0.0125));
            for to in marks {
                expected += panel(at, to);
                at = to;
                let got = curve.area(at);
                let close = |value: f64, what: &str| {
                    let wrong = (got - value).abs() / (1.0e-30 + value);
                    assert!(wrong < 4.0e-13, "R {exponent} s {at} {what}: {got} {value}");
                };
                if at > 1.0e-3 {
                    close(expected, "quadrature");
                }
                if exponent == 2.0 && at > 0.1 {
                    close((1.0 + at * at).sqrt() - 1.0, "R = 2");
                }
                if exponent == 1.0 && at > 0.1 {
                    close(at - libm::log1p(at), "R = 1");
                }
                assert_eq!(curve.area(-at).to_bits(), got.to_bits());
            }
        }
    }
}
