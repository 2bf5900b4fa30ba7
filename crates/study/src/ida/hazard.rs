//! From a fragility and the hazard at a site to a mean annual frequency.

use pounding_ground_motion::distributions::{mills_ratio, normal_distribution};

use super::fragility::{Fragility, FragilityFit};
use super::goodness::{FitRemark, ShownIntensity};
use crate::study_file::HazardCurve;

/// Power law through a point of a curve: `lambda = frequency (x / intensity)^-slope`.
#[derive(Clone, Copy)]
struct PowerLaw {
    intensity: f64,
    frequency: f64,
    slope: f64,
}

impl PowerLaw {
    /// The one between two neighbouring points. A slope may be in the thousands: no power of an
    /// intensity stands alone.
    fn between(a: (f64, f64), b: (f64, f64)) -> Self {
        Self {
            intensity: a.0,
            frequency: a.1,
            slope: logarithm(a.1, b.1) / logarithm(b.0, a.0),
        }
    }

    /// Logarithm of the frequency with which an intensity is exceeded.
    fn logarithm_at(&self, x: f64) -> f64 {
        libm::log(self.frequency) - self.slope * logarithm(x, self.intensity)
    }

    fn at(&self, x: f64) -> f64 {
        self.frequency * libm::exp(-self.slope * logarithm(x, self.intensity))
    }

    /// The intensity that is exceeded with this frequency.
    fn exceeded_with(&self, frequency: f64) -> f64 {
        self.intensity * libm::exp(logarithm(self.frequency, frequency) / self.slope)
    }
}

/// `ln(a / b)`, with all digits also where the two are close together.
fn logarithm(a: f64, b: f64) -> f64 {
    match a > 0.5 * b && a < 2.0 * b {
        true => libm::log1p((a - b) / b),
        false => libm::log(a / b),
    }
}

impl HazardCurve {
    /// Mean annual frequency (1/year) with which an intensity is exceeded: a power law
    /// between points, that of the last two above them; below the first point the
    /// frequency of the first.
    #[must_use]
    pub fn frequency(&self, intensity: f64) -> f64 {
        let first = self.points[0];
        if intensity <= first.0 {
            return first.1;
        }
        let above = self.points.partition_point(|p| p.0 < intensity);
        let i = above.clamp(1, self.points.len() - 1);
        PowerLaw::between(self.points[i - 1], self.points[i]).at(intensity)
    }

    fn with_fragility(&self, f: &Fragility) -> f64 {
        self.between(f, 0.0, f64::INFINITY)
    }

    /// What the intensities between these two count.
    fn between(&self, f: &Fragility, from: f64, to: f64) -> f64 {
        let last = self.points.len() - 2;
        let segments = self.points.windows(2).enumerate();
        segments
            .map(|(i, p)| {
                let end = if i == last { f64::INFINITY } else { p[1].0 };
                let (from, to) = (p[0].0.max(from), end.min(to));
                match from < to {
                    true => part(f, PowerLaw::between(p[0], p[1]), from, to),
                    false => 0.0,
                }
            })
            .sum()
    }

    /// The intensity that is exceeded with this frequency (1/year); `None` below the first point.
    pub(super) fn intensity(&self, frequency: f64) -> Option<f64> {
        if frequency > self.points[0].1 {
            return None;
        }
        let above = self.points.partition_point(|p| p.1 > frequency);
        let i = above.clamp(1, self.points.len() - 1);
        let law = PowerLaw::between(self.points[i - 1], self.points[i]);
        Some(law.exceeded_with(frequency))
    }

    /// What a state that is reached by all above an intensity would count below the first point,
    /// if the first power law went on there.
    fn missing_above(&self, intensity: f64) -> f64 {
        let first = self.points[0];
        if intensity >= first.0 {
            return 0.0;
        }
        PowerLaw::between(first, self.points[1]).at(intensity) - first.1
    }
}

/// Part of a frequency that may be left out below the hazard curve without a word.
const NEGLIGIBLE: f64 = 0.01;
/// Part of a frequency that may come from above the hazard curve without a word.
const FROM_ABOVE: f64 = 0.25;
/// Part of a frequency that may come from intensities of which no run tells, without a word.
const FROM_OUTSIDE: f64 = 0.25;

/// What a frequency leaves out below the first point of the curve (1/year), if the first power law
/// went on there; zero where that is negligible.
pub(super) fn uncounted(fit: &FragilityFit, hazard: &HazardCurve, frequency: f64) -> f64 {
    let first = hazard.points[0];
    let uncounted = match fit {
        FragilityFit::Lognormal(f) => {
            let law = PowerLaw::between(first, hazard.points[1]);
            part(f, law, 0.0, first.0)
        }
        FragilityFit::Step { lower: x, .. } | FragilityFit::Never { up_to: x } => {
            hazard.missing_above(*x)
        }
        FragilityFit::Always { .. } | FragilityFit::None => 0.0,
    };
    match uncounted <= NEGLIGIBLE * frequency {
        true => 0.0,
        false => uncounted,
    }
}

/// What must be said of a frequency: where the hazard curve or the intensities of the analysis,
/// which rise, leave out what it needs.
pub(super) fn remarks(
    fit: &FragilityFit,
    hazard: &HazardCurve,
    intensities: &[f64],
    shown: impl Fn(f64) -> ShownIntensity,
) -> Vec<FitRemark> {
    let Some(frequency) = mean_annual_frequency(fit, hazard) else {
        return Vec::new();
    };
    let (first, last) = (hazard.points[0], hazard.points[hazard.points.len() - 1]);
    // Where counts give no curve the state is taken as reached right above an intensity.
    let (assumed, above, probability) = match fit {
        FragilityFit::Lognormal(f) => {
            let above = hazard.between(f, last.0, f64::INFINITY) / frequency;
            (None, above, f.probability(first.0))
        }
        FragilityFit::Step { lower: x, .. } | FragilityFit::Never { up_to: x } => {
            (Some(*x), f64::from(*x > last.0), 1.0)
        }
        FragilityFit::Always { .. } | FragilityFit::None => return Vec::new(),
    };
    let mut remarks = Vec::new();
    let uncounted = uncounted(fit, hazard, frequency);
    if uncounted > 0.0 {
        remarks.push(FitRemark::BelowHazard {
            first: shown(first.0),
            probability,
            assumed: assumed.map(&shown),
            uncounted,
        });
    } else if let Some(above) = assumed {
        remarks.push(FitRemark::AtMost {
            above: shown(above),
        });
    }
    if above > FROM_ABOVE {
        remarks.push(FitRemark::AboveHazard {
            last: shown(last.0),
            share: above,
        });
    }
    let FragilityFit::Lognormal(f) = fit else {
        return remarks;
    };
    let made = || intensities.iter().copied().filter(|x| *x > 0.0);
    let lowest = made().fold(f64::INFINITY, f64::min);
    let highest = made().fold(0.0, f64::max);
    let share = hazard.between(f, 0.0, lowest) / frequency;
    if share > FROM_OUTSIDE {
        remarks.push(FitRemark::FromBelow {
            lowest: shown(lowest),
            share,
        });
    }
    let share = hazard.between(f, highest, f64::INFINITY) / frequency;
    // Where all reach the state already, runs above would change nothing.
    let open = hazard.frequency(highest) * (1.0 - f.probability(highest)) / frequency;
    if share.min(open) > FROM_OUTSIDE {
        remarks.push(FitRemark::FromAbove {
            highest: shown(highest),
            share,
        });
    }
    remarks
}

/// The least frequency (1/year) that counts leave possible: where they leave a step between two
/// intensities, the state may be reached at the higher alone.
pub(super) fn least_frequency(fit: &FragilityFit, hazard: &HazardCurve) -> f64 {
    match fit {
        FragilityFit::Lognormal(f) => hazard.with_fragility(f),
        FragilityFit::Step { upper: x, .. } | FragilityFit::Always { from: x } if x.is_finite() => {
            hazard.frequency(*x)
        }
        _ => 0.0,
    }
}

/// `int P(x) |d lambda(x)|` over a stretch where `lambda` is a power law, exactly: by parts,
/// completing the square in the logarithm. What that asks for is a tail of the normal
/// distribution times the exponential of half a square, which for a steep stretch is a product of
/// nothing and infinity: each end takes its tail over its density, and the exponents are added up
/// before any of them is taken. Never NaN; infinite only below the curve, where a steep law has
/// no bound.
fn part(f: &Fragility, law: PowerLaw, from: f64, to: f64) -> f64 {
    let shift = law.slope * f.dispersion;
    let z = |x: f64| logarithm(x, f.median) / f.dispersion;
    let end = |x: f64| End {
        z: z(x),
        log_frequency: law.logarithm_at(x),
    };
    let below = |x: f64| if x > 0.0 { end(x).below(shift) } else { 0.0 };
    let above = |x: f64| {
        if x.is_finite() {
            end(x).above(shift)
        } else {
            0.0
        }
    };
    // Where the integrand is largest if the law goes on to both sides, tails change sides.
    if z(from) >= -shift {
        above(from) - above(to)
    } else if z(to) <= -shift {
        below(to) - below(from)
    } else {
        let fall = shift * (-shift - z(law.intensity));
        let peak = End {
            z: -shift,
            log_frequency: libm::log(law.frequency) - fall,
        };
        (peak.below(shift) - below(from)) + (peak.above(shift) - above(to))
    }
}

/// An end of a stretch.
struct End {
    /// Quantile of the fragility.
    z: f64,
    /// Logarithm of the frequency with which the intensity is exceeded.
    log_frequency: f64,
}

impl End {
    /// What intensities above it count if the law goes on there: the end is above the peak.
    fn above(&self, shift: f64) -> f64 {
        let rest = mills_ratio((self.z + shift).max(0.0));
        if self.z < 0.0 {
            return self.with_density(mills_ratio(-self.z) + rest);
        }
        let reached = normal_distribution(self.z) * libm::exp(self.log_frequency);
        reached + self.with_density(rest)
    }

    /// What intensities below it count if the law goes on there: the end is below the peak.
    fn below(&self, shift: f64) -> f64 {
        // The probability at the end, which is far below the median, over its density.
        let reached = mills_ratio(-self.z);
        self.with_density(mills_ratio((-self.z - shift).max(0.0)) - reached)
    }

    /// Frequency and normal density times a factor.
    fn with_density(&self, factor: f64) -> f64 {
        let exponent = self.log_frequency - 0.5 * self.z * self.z - HALF_LOG_TWO_PI;
        factor * libm::exp(exponent)
    }
}

/// Half the logarithm of 2 pi.
const HALF_LOG_TWO_PI: f64 = 0.918_938_533_204_672_8;

/// Mean annual frequency (1/year) of a state, `int P(state | x) |d lambda(x)|`, without
/// error of quadrature.
///
/// Intensities below the first point of the curve count nothing; above the last point its
/// last power law goes on. A step counts with its lower end and a state that is never
/// reached as if it were reached right above the last intensity, both of which err on the
/// safe side as far as the curve reaches down to there; `None` where the counts give no curve, or
/// a step that begins at the least intensity.
#[must_use]
pub fn mean_annual_frequency(fit: &FragilityFit, hazard: &HazardCurve) -> Option<f64> {
    match fit {
        FragilityFit::Lognormal(f) => Some(hazard.with_fragility(f)),
        FragilityFit::Step { lower, .. } => (*lower > 0.0).then(|| hazard.frequency(*lower)),
        FragilityFit::Never { up_to } => Some(hazard.frequency(*up_to)),
        FragilityFit::Always { .. } | FragilityFit::None => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn fragility(median: f64, dispersion: f64) -> Fragility {
        Fragility {
            records: None,
            median,
            dispersion,
            standard_errors: [0.0; 2],
            covariance: 0.0,
            log_likelihood: 0.0,
        }
    }

    /// Lognormal fragility on `lambda = k0 x^-k`: `k0 median^-k exp(k^2 beta^2 / 2)`
    /// (Cornell, Jalayer, Hamburger and Foutch 2002, J. Struct. Eng. 128, 526).
    #[test]
    fn a_power_law_has_a_closed_form() {
        for (k, median, beta) in [(2.5, 0.4, 0.45), (1.7, 3.0, 0.8), (3.2, 1.0, 0.2)] {
            let k0 = 2.0e-4;
            let grid = (0..400).map(|i| 1e-6 * 1.1_f64.powi(i));
            let curve =
                HazardCurve::new(grid.map(|x| (x, k0 * libm::pow(x, -k))).collect()).unwrap();
            let expected = k0 * libm::pow(median, -k) * libm::exp(0.5 * k * k * beta * beta);
            let found = curve.with_fragility(&fragility(median, beta));
            assert!((found / expected - 1.0).abs() < 1e-10, "{found} {expected}");
        }
    }

    /// Two power laws: against an integral by a million trapezoids in the logarithm.
    #[test]
    fn a_bent_curve_agrees_with_a_fine_sum() {
        let points = vec![(0.05, 0.1), (0.3, 4e-3), (1.0, 1.5e-4), (2.0, 5e-6)];
        let curve = HazardCurve::new(points).unwrap();
        let f = fragility(0.5, 0.5);
        let count = 1_000_000;
        let (from, to) = (libm::log(0.05_f64), libm::log(60.0_f64));
        let h = (to - from) / f64::from(count);
        let mut sum = 0.0;
        for i in 0..count {
            let (a, b) = (from + h * f64::from(i), from + h * f64::from(i + 1));
            let fall = curve.frequency(libm::exp(a)) - curve.frequency(libm::exp(b));
            sum += fall * f.probability(libm::exp(0.5 * (a + b)));
        }
        let found = curve.with_fragility(&f);
        assert!((found / sum - 1.0).abs() < 1e-8, "{found} {sum}");
    }

    /// `int P(x) |d lambda(x)|` by Gauss's rule of five points on many panels, in the logarithm of
    /// the intensity; without an upper end up to where nothing is left.
    fn quadrature(f: &Fragility, law: PowerLaw, from: f64, to: f64) -> f64 {
        const RULE: [(f64, f64); 5] = [
            (0.0, 0.568_888_888_888_888_9),
            (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (-0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
            (0.906_179_845_938_664, 0.236_926_885_056_189_08),
            (-0.906_179_845_938_664, 0.236_926_885_056_189_08),
        ];
        let reach = libm::log(from / f.median).max(9.0 * f.dispersion) + 60.0 / law.slope;
        let to = to.min(f.median * libm::exp(reach));
        let rise = 0.5 * (libm::log(from / f.median).min(0.0) / f.dispersion).powi(2);
        let to = to.min(from * libm::exp((60.0 + rise) / law.slope));
        // Above, all reach the state: the law alone is left.
        let all = f.median * libm::exp(9.0 * f.dispersion);
        if from < all && all < to {
            return quadrature(f, law, from, all) + quadrature(f, law, all, to);
        }
        let panels = 3_000;
        let width = libm::log(to / from) / f64::from(panels);
        let at = |u: f64| {
            let quantile = (libm::log(from / f.median) + u) / f.dispersion;
            let log = law.slope * (libm::log(from / law.intensity) + u);
            law.slope * law.frequency * libm::exp(-log) * normal_distribution(quantile)
        };
        let panel = |i: u32| -> f64 {
            let middle = (f64::from(i) + 0.5) * width;
            let value = |(x, w): (f64, f64)| w * at(middle + 0.5 * width * x);
            RULE.map(value).iter().sum()
        };
        0.5 * width * (0..panels).map(panel).sum::<f64>()
    }

    /// Stretches of every steepness, on all sides of the median, against quadrature.
    #[test]
    fn steep_stretches_agree_with_quadrature() {
        let mut found_of = 0;
        for slope in [0.3, 1.0, 3.0, 20.0, 116.0, 1e3, 1e4] {
            for (median, dispersion) in [(0.083, 0.395), (0.5, 0.05), (0.51, 0.8), (3.0, 0.4)] {
                for (from, to) in [(0.5, 0.51), (0.05, 0.2), (0.05, 5.0), (0.4, f64::INFINITY)] {
                    let law = PowerLaw {
                        intensity: 0.5,
                        frequency: 1e-3,
                        slope,
                    };
                    if law.at(from) > 1e250 || (to.is_finite() && law.at(to) < 1e-250) {
                        continue;
                    }
                    let f = fragility(median, dispersion);
                    let found = part(&f, law, from, to);
                    let expected = quadrature(&f, law, from, to);
                    if expected < 1e-280 {
                        continue;
                    }
                    found_of += 1;
                    assert!(
                        (found / expected - 1.0).abs() < 2e-12,
                        "{slope} {median} {dispersion} {from} {to}: {found:e} {expected:e}"
                    );
                }
            }
        }
        assert!(found_of > 60, "{found_of}");
    }

    /// A curve with a stretch of a slope of 116, in g; the sum by quadrature, its value by mpmath.
    #[test]
    fn a_steep_end_of_a_curve_has_a_frequency() {
        let points = vec![(0.02, 1.2), (0.1, 3.5e-2), (0.5, 1.0e-3), (0.51, 1.0e-4)];
        let curve = HazardCurve::new(points.clone()).unwrap();
        let f = fragility(0.083, 0.395);
        let expected: f64 = points
            .windows(2)
            .map(|p| {
                let end = if p[1].0 == 0.51 {
                    f64::INFINITY
                } else {
                    p[1].0
                };
                quadrature(&f, PowerLaw::between(p[0], p[1]), p[0].0, end)
            })
            .sum();
        let found = mean_annual_frequency(&FragilityFit::Lognormal(f), &curve).unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
        assert!((found - 0.076_707_627_594_565).abs() < 1e-13, "{found}");
        // Points as close as numbers are.
        for next in [0.5 + f64::EPSILON, 0.500_001] {
            let curve = HazardCurve::new(vec![(0.1, 1e-2), (0.5, 1e-3), (next, 1e-9)]).unwrap();
            for median in [0.01, 0.083, 0.5, 2.0, 1e3] {
                let fit = FragilityFit::Lognormal(fragility(median, 0.395));
                let found = mean_annual_frequency(&fit, &curve).unwrap();
                assert!((0.0..=1e-2).contains(&found), "{median} {found}");
            }
            assert!((curve.frequency(0.5) / 1e-3 - 1.0).abs() < 1e-12);
            assert_eq!(curve.frequency(0.6), 0.0);
        }
        // A steep law has no bound below its curve: said without a number.
        let steep = HazardCurve::new(vec![(0.5, 1e-3), (0.51, 1e-4)]).unwrap();
        let shown = |si: f64| ShownIntensity { si, in_g: false };
        let fit = FragilityFit::Lognormal(f);
        let said = remarks(&fit, &steep, &[0.01, 9.0], shown);
        let [FitRemark::BelowHazard { uncounted, .. }, ..] = said[..] else {
            panic!("{said:?}")
        };
        assert_eq!(uncounted, f64::INFINITY);
        assert!(said[0].to_string().contains("without bound"), "{}", said[0]);
    }

    /// A curve that begins in the middle of a fragility says what it leaves out: with one power
    /// law all parts together are the closed form.
    #[test]
    fn what_a_curve_leaves_out_is_told() {
        let (k0, k, median, beta) = (2.0e-4_f64, 2.2_f64, 0.4_f64, 0.5_f64);
        let law = |x: f64| (x, k0 * libm::pow(x, -k));
        let shown = |si: f64| ShownIntensity { si, in_g: false };
        let all = k0 * libm::pow(median, -k) * libm::exp(0.5 * k * k * beta * beta);
        let fit = FragilityFit::Lognormal(fragility(median, beta));
        let wide = [0.01, 9.0];
        let short = HazardCurve::new(vec![law(0.3), law(3.0)]).unwrap();
        let counted = mean_annual_frequency(&fit, &short).unwrap();
        let said = remarks(&fit, &short, &wide, shown);
        let [
            FitRemark::BelowHazard {
                first,
                probability,
                assumed: None,
                uncounted,
            },
        ] = said[..]
        else {
            panic!("{said:?}")
        };
        assert_eq!(first.si, 0.3);
        assert!((probability - 0.282_515).abs() < 1e-5, "{probability}");
        assert!(((uncounted + counted) / all - 1.0).abs() < 1e-10);
        let whole = HazardCurve::new(vec![law(0.01), law(3.0)]).unwrap();
        assert_eq!(remarks(&fit, &whole, &wide, shown), []);
        // It ends below the fragility, or no run was made where the frequency comes from.
        let ends = HazardCurve::new(vec![law(0.01), law(0.3)]).unwrap();
        let said = remarks(&fit, &ends, &wide, shown);
        assert!(
            matches!(said[..], [FitRemark::AboveHazard { .. }]),
            "{said:?}"
        );
        let said = remarks(&fit, &whole, &[0.5, 0.6], shown);
        assert!(
            matches!(said[..], [FitRemark::FromBelow { .. }]),
            "{said:?}"
        );
        // A step below the first point.
        let step = FragilityFit::Step {
            lower: 0.2,
            upper: 0.25,
        };
        let said = remarks(&step, &short, &wide, shown);
        let expected = law(0.2).1 - law(0.3).1;
        let [FitRemark::BelowHazard { uncounted, .. }] = said[..] else {
            panic!("{said:?}")
        };
        assert!((uncounted / expected - 1.0).abs() < 1e-12);
        // Where the curve reaches below it the frequency is an upper bound, and so is that of a state
        // which nobody reaches.
        for fit in [step, FragilityFit::Never { up_to: 0.2 }] {
            let said = remarks(&fit, &whole, &wide, shown);
            let [FitRemark::AtMost { above }] = said[..] else {
                panic!("{said:?}")
            };
            assert_eq!(above.si, 0.2);
            let bound = mean_annual_frequency(&fit, &whole).unwrap();
            assert!((bound / law(0.2).1 - 1.0).abs() < 1e-12);
        }
        for x in [0.3, 0.7, 2.9, 30.0] {
            let again = short.intensity(short.frequency(x)).unwrap();
            assert!((again / x - 1.0).abs() < 1e-12);
        }
        assert_eq!(short.intensity(1.0), None);
    }

    #[test]
    fn steps_take_their_safe_side() {
        let curve = HazardCurve::new(vec![(0.1, 1e-2), (1.0, 1e-4)]).unwrap();
        let step = FragilityFit::Step {
            lower: 0.5,
            upper: 0.7,
        };
        let expected = 1e-2 * libm::pow(5.0_f64, -2.0);
        assert!((mean_annual_frequency(&step, &curve).unwrap() / expected - 1.0).abs() < 1e-12);
        let never = FragilityFit::Never { up_to: 1.0 };
        assert!((mean_annual_frequency(&never, &curve).unwrap() / 1e-4 - 1.0).abs() < 1e-12);
        assert_eq!(
            mean_annual_frequency(&FragilityFit::Always { from: 0.1 }, &curve),
            None
        );
        // One intensity, at which some reach it and others do not.
        let one = FragilityFit::Step {
            lower: 0.0,
            upper: f64::INFINITY,
        };
        assert_eq!(mean_annual_frequency(&one, &curve), None);
    }
}
