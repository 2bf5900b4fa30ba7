//! The analysis for machines: SI units, full precision.

use pounding_study::{FragilityFit, IdaReport, IdaSettings, LimitResult, MinimumGap, POOR};
use serde::Serialize;

use crate::study::Finished;

/// The object that `ida --json` prints.
#[derive(Serialize)]
pub struct Answer<'a> {
    /// What the runs say; nothing where all of them failed.
    #[serde(flatten)]
    pub analysis: Option<Analysis<'a>>,
    /// The runs themselves.
    pub sweep: Finished<'a>,
}

/// What the runs say.
#[derive(Serialize)]
pub struct Analysis<'a> {
    measure: &'a str,
    unit: &'a str,
    records: usize,
    /// Sets of the values of other variables, if there are such.
    #[serde(skip_serializing_if = "Option::is_none")]
    structures: Option<usize>,
    remarks: &'a [String],
    levels: Vec<Level<'a>>,
    limits: Vec<Limit<'a>>,
    gaps: Vec<Gap<'a>>,
    /// Pounding at any of several gaps that have their least width each.
    least_gaps_together: Option<Limit<'a>>,
    /// Points of the hazard curve: intensity and mean annual frequency (1/year).
    hazard: Option<&'a [(f64, f64)]>,
    /// Mean annual frequency of pounding that is aimed at (1/year).
    target_frequency: Option<f64>,
    /// Confidence of all bounds (-).
    confidence: f64,
}

/// Demands at one intensity.
#[derive(Serialize)]
struct Level<'a> {
    intensity: f64,
    runs: usize,
    failed: usize,
    collapsed: usize,
    demands: Vec<Demand<'a>>,
}

/// Fractiles of a demand over the records.
#[derive(Serialize)]
struct Demand<'a> {
    name: &'a str,
    unit: &'a str,
    p16: f64,
    p50: f64,
    p84: f64,
}

/// A state, how often it was reached, and its fragility.
#[derive(Serialize)]
struct Limit<'a> {
    name: &'a str,
    counts: Vec<Counts>,
    fit: Fit,
    /// Pearson's test of the lognormal curve.
    goodness_of_fit: Option<Goodness>,
    remarks: Vec<String>,
    mean_annual_frequency: Option<f64>,
    /// Whether that is an estimate, an upper bound or an assumption.
    mean_annual_frequency_is: Option<&'static str>,
    /// By a bootstrap over records, at the confidence of the study; one that is null is not known.
    mean_annual_frequency_bounds: Option<[Option<f64>; 2]>,
}

/// Pearson's test.
#[derive(Serialize)]
struct Goodness {
    statistic: f64,
    degrees_of_freedom: usize,
    p_value: f64,
    poor: bool,
    largest_distance: f64,
    intensity_of_largest_distance: f64,
}

/// How often a state was reached at one intensity.
#[derive(Serialize)]
struct Counts {
    intensity: f64,
    runs: usize,
    reached: usize,
}

/// What counts say of a fragility.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum Fit {
    Lognormal {
        median: f64,
        dispersion: f64,
        confidence: f64,
        median_bounds: [f64; 2],
        dispersion_bounds: [f64; 2],
        log_likelihood: f64,
    },
    Step {
        lower: f64,
        upper: Option<f64>,
    },
    Never {
        up_to: f64,
    },
    Always {
        from: f64,
    },
    None,
}

/// Pounding of neighbours by width of their gap.
#[derive(Serialize)]
struct Gap<'a> {
    gap: &'a str,
    widths: Vec<Width<'a>>,
    minimum: Option<Minimum>,
}

/// Pounding at one width.
#[derive(Serialize)]
struct Width<'a> {
    #[serde(flatten)]
    limit: Limit<'a>,
    width: f64,
}

/// The least width for the frequency asked for.
#[derive(Serialize)]
struct Minimum {
    width: Option<f64>,
    mean_annual_frequency: Option<f64>,
    /// Whether that is an estimate, an upper bound or an assumption.
    mean_annual_frequency_is: Option<&'static str>,
    mean_annual_frequency_bounds: Option<[Option<f64>; 2]>,
    goodness_of_fit: Option<Goodness>,
    /// Whether the width is an upper bound, as runs are missing at narrower ones or the hazard
    /// curve begins too high for them.
    upper_bound: bool,
    /// Width below which every gap is too narrow whatever the missing runs would say.
    wider_than: Option<f64>,
    remarks: Vec<String>,
}

impl<'a> Analysis<'a> {
    /// The evaluation, and what the study asked for.
    pub fn of(report: &'a IdaReport, settings: &'a IdaSettings) -> Self {
        let confidence = settings.confidence;
        let levels = report.levels.iter().map(|l| {
            let demands = report.demands.iter().zip(&l.fractiles);
            let demands = demands.map(|((name, unit), &[p16, p50, p84])| Demand {
                name,
                unit,
                p16,
                p50,
                p84,
            });
            Level {
                intensity: l.intensity,
                runs: l.runs,
                failed: l.failed,
                collapsed: l.collapsed,
                demands: demands.collect(),
            }
        });
        let limits = report.limits.iter().map(|l| Limit::of(l, confidence));
        let together = report.least_gaps_together.as_ref();
        let together = together.map(|l| Limit::of(l, confidence));
        let gaps = report.gaps.iter().map(|g| {
            let widths = g.widths.iter().map(|w| Width {
                limit: Limit::of(&w.result, confidence),
                width: w.width,
            });
            Gap {
                gap: &g.gap,
                widths: widths.collect(),
                minimum: g.minimum.as_ref().map(Minimum::of),
            }
        });
        Self {
            measure: &report.measure,
            unit: &report.unit,
            records: report.records,
            structures: report.structures,
            remarks: &report.remarks,
            levels: levels.collect(),
            limits: limits.collect(),
            gaps: gaps.collect(),
            least_gaps_together: together,
            hazard: settings.hazard.as_ref().map(|curve| &*curve.points),
            target_frequency: settings.target_frequency,
            confidence,
        }
    }
}

/// The bounds of a frequency, if one of them is known.
fn bounds(limit: &LimitResult) -> Option<[Option<f64>; 2]> {
    let bounds = limit.frequency_bounds.map(|b| [b.low, b.high]);
    bounds.filter(|b| b.iter().any(Option::is_some))
}

impl Goodness {
    fn of(limit: &LimitResult) -> Option<Self> {
        limit.goodness.map(|g| Self {
            statistic: g.statistic,
            degrees_of_freedom: g.degrees_of_freedom,
            p_value: g.p_value,
            poor: g.p_value < POOR,
            largest_distance: g.distance.0,
            intensity_of_largest_distance: g.distance.1,
        })
    }
}

impl Minimum {
    fn of(minimum: &MinimumGap) -> Self {
        let frequency = Some(minimum.frequency()).filter(|frequency| frequency.is_finite());
        Self {
            width: minimum.width,
            mean_annual_frequency: frequency,
            mean_annual_frequency_is: frequency.map(|_| minimum.result.frequency_is()),
            mean_annual_frequency_bounds: bounds(&minimum.result),
            goodness_of_fit: Goodness::of(&minimum.result),
            upper_bound: minimum.is_at_most(),
            wider_than: minimum.open.map(|open| open.wider_than),
            remarks: minimum.remarks(),
        }
    }
}

impl<'a> Limit<'a> {
    fn of(limit: &'a LimitResult, confidence: f64) -> Self {
        let counts = limit.counts.iter().map(|c| Counts {
            intensity: c.intensity,
            runs: c.runs,
            reached: c.reached,
        });
        let fit = match limit.fit {
            FragilityFit::Lognormal(f) => Fit::Lognormal {
                median: f.median,
                dispersion: f.dispersion,
                confidence,
                median_bounds: f.median_bounds(confidence),
                dispersion_bounds: f.dispersion_bounds(confidence),
                log_likelihood: f.log_likelihood,
            },
            FragilityFit::Step { lower, upper } => Fit::Step {
                lower,
                upper: upper.is_finite().then_some(upper),
            },
            FragilityFit::Never { up_to } => Fit::Never { up_to },
            FragilityFit::Always { from } => Fit::Always { from },
            FragilityFit::None => Fit::None,
        };
        Self {
            name: &limit.name,
            counts: counts.collect(),
            fit,
            goodness_of_fit: Goodness::of(limit),
            remarks: limit.remarks.iter().map(ToString::to_string).collect(),
            mean_annual_frequency: limit.frequency,
            mean_annual_frequency_is: limit.frequency.map(|_| limit.frequency_is()),
            mean_annual_frequency_bounds: bounds(limit),
        }
    }
}
