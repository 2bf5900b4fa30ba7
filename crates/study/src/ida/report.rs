//! What an incremental dynamic analysis says: the intensities, the states with their fragilities and frequencies, and the
//! least gaps.

use pounding_catalogue::STANDARD_GRAVITY;

use super::bootstrap::FrequencyBounds;
use super::fragility::{Counts, FragilityFit};
use super::goodness::{FitRemark, GoodnessOfFit, ShownIntensity};

/// Runs at one intensity.
#[derive(Debug, Clone, PartialEq)]
pub struct IntensityLevel {
    /// Intensity (SI).
    pub intensity: f64,
    /// Runs that did not fail, collapses among them.
    pub runs: usize,
    /// Runs in which a building collapsed.
    pub collapsed: usize,
    /// Runs that failed; they count nowhere else.
    pub failed: usize,
    /// For each demand of the report its 16, 50 and 84 % fractiles over the records; a
    /// collapse is above everything, so that a fractile may be infinite.
    pub fractiles: Vec<[f64; 3]>,
}

/// A state, how often it was reached, and its fragility.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitResult {
    /// Name of the state.
    pub name: String,
    /// Counts at every intensity.
    pub counts: Vec<Counts>,
    /// Lognormal fragility by maximum likelihood.
    pub fit: FragilityFit,
    /// Test of the lognormal curve; `None` where there is none, or too few classes.
    pub goodness: Option<GoodnessOfFit>,
    /// What must be said of the fit.
    pub remarks: Vec<FitRemark>,
    /// Mean annual frequency (1/year), if there is a hazard curve and the counts give one.
    pub frequency: Option<f64>,
    /// Its bounds at the confidence of the study, by a bootstrap over records.
    pub frequency_bounds: Option<FrequencyBounds>,
}

impl LimitResult {
    /// Whether the frequency is an upper bound, as the counts give no curve.
    #[must_use]
    pub fn frequency_is_at_most(&self) -> bool {
        let at_most = |remark: &FitRemark| matches!(remark, FitRemark::AtMost { .. });
        self.remarks.iter().any(at_most)
    }

    /// What the frequency is: an `estimate`, an `upper bound`, or, where the counts give no curve
    /// and the hazard curve begins too high for a bound, an `assumption`.
    #[must_use]
    pub fn frequency_is(&self) -> &'static str {
        let assumed = |remark: &FitRemark| {
            matches!(
                remark,
                FitRemark::BelowHazard {
                    assumed: Some(_),
                    ..
                }
            )
        };
        match self.frequency_is_at_most() {
            true => "upper bound",
            false if self.remarks.iter().any(assumed) => "assumption",
            false => "estimate",
        }
    }
}

/// Pounding at one width of a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct GapResult {
    /// Width (m).
    pub width: f64,
    /// How often the isolated buildings come closer than that.
    pub result: LimitResult,
}

/// The least gap for a mean annual frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct MinimumGap {
    /// Width (m); `None` if the intensities of the analysis or the hazard curve do not reach far
    /// enough to tell, or no width does because the isolated buildings collapse.
    pub width: Option<f64>,
    /// What the intensities leave open: then the width is an upper bound.
    pub open: Option<OpenGap>,
    /// Where the hazard curve begins, if at the next narrower width, or without a width at any, what
    /// it leaves out below decides: then the width is an upper bound, too.
    pub hazard_begins: Option<ShownIntensity>,
    /// Pounding at this width, or at the maximum demand.
    pub result: LimitResult,
}

impl MinimumGap {
    /// Frequency of pounding at this width (1/year); without a width that of a gap as wide as the
    /// maximum demand. Infinite where the counts give none.
    #[must_use]
    pub fn frequency(&self) -> f64 {
        self.result.frequency.unwrap_or(f64::INFINITY)
    }

    /// Whether the width is an upper bound.
    #[must_use]
    pub fn is_at_most(&self) -> bool {
        self.width.is_some() && (self.open.is_some() || self.hazard_begins.is_some())
    }

    /// What must be said of it, what leaves it open first.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let open = self.open.iter().map(ToString::to_string);
        let begins = self.hazard_begins.iter().map(|first| {
            let narrower = match self.width {
                Some(_) => "at narrower gaps what weaker motions add",
                None => "what weaker motions add",
            };
            format!("the hazard curve begins at {first}, and {narrower} may pass the target frequency; begin the curve lower")
        });
        let remarks = self.result.remarks.iter().map(ToString::to_string);
        open.chain(begins).chain(remarks).collect()
    }
}

/// Why a least gap is an upper bound: at narrower widths runs are missing where the frequency
/// passes the target.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OpenGap {
    /// Below this width (m) every gap is too narrow whatever the missing runs would say; zero if none
    /// is.
    pub wider_than: f64,
    /// Highest intensity at which no run closes a gap a little narrower; `None`: there is none.
    pub from: Option<ShownIntensity>,
    /// Lowest intensity from which on all runs close it; `None`: there is none.
    pub to: Option<ShownIntensity>,
    /// Intensity that is exceeded with the target frequency.
    pub wanted: Option<ShownIntensity>,
}

impl std::fmt::Display for OpenGap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the least gap may be as small as {:.1} mm: ",
            1e3 * self.wider_than
        )?;
        match (self.from, self.to) {
            (None, Some(to)) => {
                write!(f, "too little was computed at intensities below {to}")
            }
            (Some(from), Some(to)) => write!(
                f,
                "too little was computed at intensities between {from} and {to}"
            ),
            (Some(from), None) => {
                write!(f, "too little was computed at intensities above {from}")
            }
            (None, None) => write!(f, "too few intensities were computed"),
        }?;
        match self.wanted {
            Some(wanted) => write!(
                f,
                "; add intensities around {wanted}, which is exceeded with the target frequency"
            ),
            None => write!(f, "; add intensities"),
        }
    }
}

/// Pounding of one pair of neighbours by width of the gap.
#[derive(Debug, Clone, PartialEq)]
pub struct PoundingDemand {
    /// Name of the gap.
    pub gap: String,
    /// Widths asked for.
    pub widths: Vec<GapResult>,
    /// Least width for the target frequency, if there is a target.
    pub minimum: Option<MinimumGap>,
}

/// What an incremental dynamic analysis says.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaReport {
    /// The intensity measure, for people.
    pub measure: String,
    /// Its unit.
    pub unit: String,
    /// Number of records.
    pub records: usize,
    /// Number of structures, sets of the values of other variables; `None` without such variables.
    pub structures: Option<usize>,
    /// Names and units of the demands.
    pub demands: Vec<(String, String)>,
    /// What must be said of the demands: which are left out.
    pub remarks: Vec<String>,
    /// The intensities, rising.
    pub levels: Vec<IntensityLevel>,
    /// Each demand of each sample, a record or a record with other variables of the study, at
    /// the intensities: infinite in a collapse, NaN where there is no run or it failed.
    pub curves: Vec<Vec<Vec<f64>>>,
    /// Pounding at the widths of the case, then the states of the study.
    pub limits: Vec<LimitResult>,
    /// Pounding by width, for every gap of the case.
    pub gaps: Vec<PoundingDemand>,
    /// Pounding at any of several gaps that all have their least width for the target frequency: the target of each
    /// is none for all of them together.
    pub least_gaps_together: Option<LimitResult>,
}

impl IdaReport {
    /// What intensities (SI) are divided by for people, and their unit then: g for
    /// accelerations.
    #[must_use]
    pub fn shown_intensity(&self) -> (f64, &str) {
        match self.unit.as_str() {
            "m s-2" => (STANDARD_GRAVITY, "g"),
            other => (1.0, other),
        }
    }
}
