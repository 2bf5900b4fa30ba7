//! Is the gap wide enough? Demand by simulation of the isolated buildings, gaps by code,
//! and what pounding does at the provided gap and at many others.

mod averaged;
mod band_extremes;
mod code_answer;
mod codes;
mod collapse;
mod dealt;
mod demand;
mod error;
mod lower_roof;
mod parallel;
mod record_spectra;
mod records;
mod repeated;
mod required;
mod spectra;
mod statistics;
mod suite;
mod suite_spectrum;
mod sweep;
mod systems;
mod warnings;

pub use code_answer::{CodeAnswer, LevelAnswer, OwnershipAnswer};
pub use codes::{
    CodeGap, CombinationGap, LevelCombination, unknown_names, unknown_words, wrong_rules,
};
pub use collapse::{CollapsedRecord, collapsed_building};
pub(crate) use collapse::{stand_or_collapse, without_collapsed};
pub use dealt::Deal;
pub(crate) use dealt::identity;
#[cfg(feature = "results")]
pub use dealt::is_shard_of_check;
#[cfg(feature = "results")]
pub(crate) use dealt::{Numbers, Stored};
pub use demand::{
    Amplification, AmplifiedQuantity, GapLevel, RecordDemand, amplification, demands,
};
pub use error::CheckError;
pub use parallel::{Progress, UNWATCHED};
pub use records::{
    CaseUnderRecord, RecordFiles, SkippedFile, distinct, distinct_names, given_once,
    name_of_record, record_files, under_record, under_records,
};
pub use repeated::Repeated;
#[cfg(feature = "results")]
pub(crate) use repeated::Shape;
pub use required::{LognormalFit, RequiredGap};
pub use spectra::{SuiteSpectra, SuiteTarget};
pub use statistics::binomial_bounds;
pub use suite::SuiteStatistics;
pub use suite_spectrum::{MeanSpectrum, SuiteSpectrum};
pub use sweep::{
    GapRun, GapSweep, SweepOptions, SweepRun, WorstWidth, at_width, even_widths, widest,
};

#[cfg(feature = "results")]
pub(crate) use demand::closes;
pub(crate) use demand::levels;
#[cfg(feature = "results")]
pub(crate) use parallel::{Ending, in_parallel, runs_in_parallel};
pub use systems::rebuilt;
pub(crate) use warnings::warnings;
#[cfg(feature = "results")]
pub(crate) use warnings::{
    across_of_another, of_each_record, of_reading, on_grounds_of_their_own, said_in_reading,
};

use pounding_case::{Case, Separation};
use pounding_time_history::{LevelOutcome, NamedPeak};

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct GapCheckOptions {
    /// Part of the records that may bring the buildings into contact (-): zero asks for
    /// a gap that no record closes.
    pub target_probability: f64,
    /// Confidence of two-sided bounds (-).
    pub confidence: f64,
    /// Sweep over widths; `None`: no sweep.
    pub sweep: Option<SweepOptions>,
    /// Threads.
    pub threads: usize,
}

/// One gap of the case with its answer.
#[derive(Debug, Clone)]
pub struct GapReport {
    /// Name.
    pub name: String,
    /// Left and right neighbour.
    pub between: [String; 2],
    /// Contact levels from the bottom.
    pub levels: Vec<GapLevel>,
    /// The level and the record that decide the verdict, of the records that have a demand.
    pub governing: Governing,
    /// Maximum demand over the levels for each record (m): the uniform width that the
    /// record would just not close.
    pub demand: Vec<f64>,
    /// Demand (m) by record and level.
    pub demand_by_level: Vec<Vec<f64>>,
    /// Records that close the provided gap at some level, those that
    /// [collapsed](Self::records_collapsed) among them.
    pub records_in_contact: usize,
    /// Of these, records under which a building collapses without contact: they have no demand,
    /// and are in contact at every width.
    pub records_collapsed: usize,
    /// Of these, records that close it only because another gap of the row closes: the
    /// demand does not see them.
    pub records_driven: usize,
    /// Of these, records whose [demand is the width](RecordDemand::closed_at_demand) to the last digits.
    pub records_at_demand: usize,
    /// Bounds of the probability of contact under records like these, by Clopper and
    /// Pearson (Biometrika 26 (1934) 404), at the confidence asked for.
    pub contact_bounds: (f64, f64),
    /// Uniform width for the target probability.
    pub required: RequiredGap,
    /// Statistics of that demand over the records.
    pub suite: SuiteStatistics,
    /// The answer of the one code that is asked for.
    pub code: Option<CodeAnswer>,
    /// Gaps by code, in the order of the registry.
    pub codes: Vec<CodeGap>,
    /// Gaps by combination rules; none beside a wall.
    pub combinations: Vec<CombinationGap>,
    /// Whether no more records than the target probability allows close the gap, whatever a
    /// code says.
    pub adequate: bool,
    /// Shear of columns that are hit, at the provided widths: of each such level the record
    /// under which it is a maximum; none where no run could be made.
    pub columns: Vec<LevelDemand>,
    /// Seat of the deck (m), where there is one.
    pub seat: Option<f64>,
    /// How far the joint opens at the provided widths, where there is a seat, as of columns.
    pub openings: Vec<LevelDemand>,
}

/// Where a gap is nearest to contact, or goes furthest beyond it: the level with the least
/// margin under the record that decides. As many records as may touch have less.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Governing {
    /// Level, from zero.
    pub level: usize,
    /// Record, from zero.
    pub record: usize,
    /// Its demand at that level (m).
    pub required: f64,
    /// Width of that level (m).
    pub provided: f64,
}

impl Governing {
    /// What is left of the width (m); negative where it falls short.
    #[must_use]
    pub fn margin(&self) -> f64 {
        self.provided - self.required
    }

    /// Of widths by level (m), and of demands by record and level (m).
    fn of(widths: &[f64], demands: &[Vec<f64>], allowed: usize) -> Self {
        let at = |record: usize, level: usize| Self {
            level,
            record,
            required: demands[record][level],
            provided: widths[level],
        };
        // Of equals the lowest level and the first record.
        let least = |record: usize| {
            let levels = (1..widths.len()).map(|level| at(record, level));
            levels.fold(at(record, 0), |least, other| {
                if other.margin() < least.margin() {
                    other
                } else {
                    least
                }
            })
        };
        let mut records: Vec<_> = (0..demands.len()).map(least).collect();
        records.sort_by(|a, b| a.margin().total_cmp(&b.margin()));
        records[allowed.min(records.len() - 1)]
    }
}

/// Maximum of a response at a level, over all records.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelDemand {
    /// Level of the gap, from zero.
    pub level: usize,
    /// Record, from zero.
    pub record: usize,
    /// The response, such as the shear of columns below or above the hit, with its capacity if
    /// that is known.
    pub response: NamedPeak,
}

/// The whole check.
#[derive(Debug, Clone)]
pub struct GapCheck {
    /// What was asked for.
    pub options: GapCheckOptions,
    /// Each record with its demands, isolated responses and responses with pounding, but for those
    /// that [`collapsed`](Self::collapsed). At least one.
    pub records: Vec<RecordDemand>,
    /// Records under which a building collapses without contact.
    pub collapsed: Vec<CollapsedRecord>,
    /// Records that are one motion under several names, by their order as given: codes count each
    /// motion once.
    pub repeated: Repeated,
    /// Spectra of the records as they are used, beside the target of the case's scale.
    pub spectra: SuiteSpectra,
    /// Gaps in the order of the case.
    pub gaps: Vec<GapReport>,
    /// Sweep over widths.
    pub sweep: Option<GapSweep>,
    /// What the user should know of the case.
    pub warnings: Vec<String>,
}

/// Part by which a width may fall short of a demand and still be the same: peaks of two
/// runs of the same motion differ by less.
pub(crate) const SAME: f64 = 1.0e-6;

impl GapReport {
    /// Records, those that collapsed among them.
    #[must_use]
    pub fn records(&self) -> usize {
        self.demand.len() + self.records_collapsed
    }

    /// Whether all levels have the same width.
    #[must_use]
    pub fn of_one_width(&self) -> bool {
        self.levels.iter().all(|l| l.width == self.levels[0].width)
    }

    /// Whether the gap is wide enough: by the code that is asked for, which must give an answer,
    /// else by the demand of the records.
    #[must_use]
    pub fn wide_enough(&self) -> bool {
        match &self.code {
            Some(code) => code.satisfied() == Some(true),
            None => self.adequate,
        }
    }

    /// Records whose demand exceeds a width (m) at some level, by more than two computations of one
    /// number differ, and those that collapsed. The width is given by record and level.
    #[must_use]
    pub fn records_beyond(&self, width: impl Fn(usize, usize) -> Option<f64>) -> usize {
        let beyond = |r: &usize| {
            let mut levels = self.demand_by_level[*r].iter().enumerate();
            levels.any(|(l, demand)| width(*r, l).is_some_and(|w| w < demand * (1.0 - SAME)))
        };
        (0..self.demand.len()).filter(beyond).count() + self.records_collapsed
    }

    /// Least ratio of a width, given by level, to the demand of a record at that level (-). A level
    /// that demands nothing beside the width has none.
    #[must_use]
    pub fn ratio_to_demand(
        &self,
        record: usize,
        width: impl Fn(usize) -> Option<f64>,
    ) -> Option<f64> {
        let levels = self.demand_by_level[record].iter().enumerate();
        let ratios = levels.filter_map(|(level, demand)| Some(width(level)? / demand));
        ratios
            .filter(|ratio| *ratio * SAME < 1.0)
            .min_by(f64::total_cmp)
    }

    /// The least of these over the records, of a width by record and level.
    #[must_use]
    pub fn least_ratio(&self, width: impl Fn(usize, usize) -> Option<f64>) -> Option<f64> {
        let of = |r: usize| self.ratio_to_demand(r, |level| width(r, level));
        (0..self.demand.len()).filter_map(of).min_by(f64::total_cmp)
    }

    /// The level at which a combination is reported (from zero): the governing one, or, where
    /// no record demands a gap, the one that the rule asks the widest gap of.
    #[must_use]
    pub fn reported_level(&self, combination: &CombinationGap) -> usize {
        let widest = |level: usize| {
            let records = combination.records.iter();
            let widths = records.filter_map(|levels| Some(levels.get(level)?.width));
            widths.fold(0.0_f64, f64::max)
        };
        let last = self.levels.len().saturating_sub(1);
        let maximum = (0..last).fold(last, |most, level| {
            if widest(level) > widest(most) {
                level
            } else {
                most
            }
        });
        let demand = self.demand.iter().fold(0.0_f64, |m, d| m.max(*d));
        if demand > SAME * widest(maximum) {
            self.governing.level
        } else {
            maximum
        }
    }
}

impl GapCheck {
    /// Whether every gap is wide enough.
    #[must_use]
    pub fn adequate(&self) -> bool {
        self.gaps.iter().all(GapReport::wide_enough)
    }
}

/// Checks the gaps of a case under records, made by [`under_records`].
///
/// # Errors
/// A case without gaps, unknown provisions, options out of range, or isolated buildings
/// that cannot be integrated, or collapse under every record. Runs with pounding that fail are kept
/// with their diagnosis.
pub fn gap_check(
    case: &Case,
    separation: &Separation,
    records: &[CaseUnderRecord],
    options: &GapCheckOptions,
    progress: Progress<'_>,
) -> Result<GapCheck, CheckError> {
    gap_check_dealt(case, separation, records, options, (progress, &Deal::All))
}

/// The same with the runs of the sweep dealt out to several processes.
///
/// # Errors
/// As [`gap_check`], and [`CheckError::Shards`].
pub fn gap_check_dealt(
    case: &Case,
    separation: &Separation,
    records: &[CaseUnderRecord],
    options: &GapCheckOptions,
    (progress, deal): (Progress<'_>, &Deal),
) -> Result<GapCheck, CheckError> {
    check_options(options)?;
    let chosen = codes::Chosen::of(case, separation)?;
    let inputs = codes::Inputs::of(case, separation)?;
    let first = records.first().ok_or(CheckError::NoGap)?;
    if first.assembly.system.gaps().is_empty() {
        return Err(CheckError::NoGap);
    }
    let swept = options.sweep.as_ref();
    let gap = swept.and_then(|s| s.gap.as_deref());
    let gap = gap.map(|name| sweep::find(&first.assembly.system, name));
    let gap = gap.transpose()?;
    let runs = |records: usize| swept.map_or(0, |s| s.points) * records;
    let total = records.len() + runs(records.len());
    let tell = |done, _| progress(done, total);
    let (demands, collapsed) = stand_or_collapse(records, options.threads, &tell)?;
    // Under the others nothing is known that runs of the sweep could be compared with.
    let standing = without_collapsed(records, &collapsed);
    let total = records.len() + runs(standing.len());
    let repeated = Repeated::among(records);
    let names: Vec<&str> = records.iter().map(|r| r.name.as_str()).collect();
    let condition = chosen.code.as_ref().and_then(|code| code.suite.spectrum);
    let spectrum = SuiteSpectrum::of(case, records, condition, options.threads)?;
    let (mut gaps, mut roofs) = (Vec::new(), Vec::new());
    for index in 0..first.assembly.system.gaps().len() {
        let place = codes::GapPlace {
            system: &first.assembly.system,
            gap: index,
        };
        let codes = codes::by_code(&place, &chosen.provisions, &inputs, &demands);
        let combinations = codes::combinations(&place, &inputs, &demands)?;
        let suite = (&demands[..], collapsed.len());
        let mut report = report(&place, suite, options, (codes, combinations))?;
        report.code = chosen.code.clone().map(|code| {
            let code = (code, chosen.date);
            let records = (&demands[..], repeated.distinct, collapsed.len());
            let demand = &report.demand[..];
            code_answer::code_answer(code, &place, &inputs, records, (demand, spectrum.clone()))
        });
        gaps.push(report);
        roofs.extend(lower_roof::left_out(&place));
    }
    let at_the_end = warnings::greatest_at_the_end(records, &demands);
    let sweep = swept.map(|asked| {
        let tell = |done, _| progress(records.len() + done, total);
        let identity = || identity("gap", asked, case, records);
        let shared = sweep::Shared {
            deal,
            identity: &identity,
            threads: options.threads,
            progress: &tell,
        };
        sweep::sweep(&standing, &demands, (asked, gap), &shared)
    });
    Ok(GapCheck {
        options: options.clone(),
        spectra: spectra::spectra(case, records, options.threads)?,
        records: demands,
        collapsed,
        gaps,
        sweep: sweep.transpose()?,
        warnings: warnings(case, records)
            .into_iter()
            .chain(roofs)
            .chain(at_the_end)
            .chain(separation.warnings())
            .chain(repeated.warnings(&names))
            .collect(),
        repeated,
    })
}

fn check_options(options: &GapCheckOptions) -> Result<(), CheckError> {
    let refuse = |(option, argument), value, allowed| {
        Err(CheckError::Option {
            option,
            argument,
            value,
            allowed,
        })
    };
    let p = options.target_probability;
    if !(0.0..1.0).contains(&p) {
        return refuse(
            ("target probability", "--probability"),
            p,
            "at least 0 and less than 1",
        );
    }
    let c = options.confidence;
    if !(c > 0.0 && c < 1.0) {
        return refuse(
            ("confidence", "--confidence"),
            c,
            "greater than 0 and less than 1",
        );
    }
    if let Some(sweep) = &options.sweep {
        sweep.check()?;
    }
    Ok(())
}

fn report(
    place: &codes::GapPlace<'_>,
    (records, collapsed): (&[RecordDemand], usize),
    options: &GapCheckOptions,
    (codes, combinations): (Vec<CodeGap>, Vec<CombinationGap>),
) -> Result<GapReport, CheckError> {
    let gap = &place.system.gaps()[place.gap];
    let levels = levels(place.system, gap);
    let at = |record: &RecordDemand, level: usize| record.demand[place.gap][level].value;
    let by_level = |r: &RecordDemand| (0..levels.len()).map(|l| at(r, l)).collect();
    let by_record: Vec<Vec<f64>> = records.iter().map(by_level).collect();
    let over_levels = |levels: &Vec<f64>| levels.iter().fold(0.0_f64, |m, d| m.max(*d));
    let demand: Vec<f64> = by_record.iter().map(over_levels).collect();
    let touches = |r: &&RecordDemand| {
        let mut closed = levels.iter().enumerate();
        closed.any(|(l, level)| r.demand_exceeds(place.gap, l, level.width))
    };
    let at_demand = |r: &&RecordDemand| r.closed_at_demand(place.gap, &levels);
    let records_at_demand = records.iter().filter(at_demand).count();
    // A building that was hit on its other side can close a gap that it would have left open.
    let driven = |r: &&RecordDemand| !touches(r) && !at_demand(r) && r.closed(place.gap);
    let records_driven = records.iter().filter(driven).count();
    let touching = records.iter().filter(touches).count();
    let records_in_contact = touching + records_at_demand + records_driven + collapsed;
    let all = records.len() + collapsed;
    let required = required::required_gap(&demand, collapsed, options);
    let allowed = required.allowed_contacts;
    let widths: Vec<f64> = levels.iter().map(|l| l.width).collect();
    let most_of = |response| {
        let levels = 0..levels.len();
        let found = levels.filter_map(|level| level_demand(records, (place.gap, level), response));
        found.collect()
    };
    Ok(GapReport {
        name: gap.name.clone(),
        between: gap.between.clone(),
        governing: Governing::of(&widths, &by_record, allowed.saturating_sub(collapsed)),
        contact_bounds: binomial_bounds(records_in_contact, all, options.confidence),
        required,
        adequate: records_in_contact <= allowed,
        records_in_contact,
        records_collapsed: collapsed,
        records_driven,
        records_at_demand,
        suite: SuiteStatistics::of(&demand),
        code: None,
        demand,
        demand_by_level: by_record,
        columns: most_of(LevelOutcome::column_shear),
        seat: gap.seat,
        openings: most_of(LevelOutcome::joint_opening),
        levels,
        codes,
        combinations,
    })
}

/// The record under which a response of a level of a gap is a maximum; `None`
/// where floors hit floors.
fn level_demand(
    records: &[RecordDemand],
    (gap, level): (usize, usize),
    response: fn(&LevelOutcome) -> Option<&NamedPeak>,
) -> Option<LevelDemand> {
    let of = |(number, record): (usize, &RecordDemand)| {
        let (_, gaps) = record.pounding.as_ref().ok()?;
        let found = response(&gaps[gap].levels[level])?.clone();
        Some((number, found))
    };
    let all = records.iter().enumerate().filter_map(of);
    // Of equals the first record.
    let most = all.reduce(|a, b| {
        if b.1.peak.value > a.1.peak.value {
            b
        } else {
            a
        }
    });
    most.map(|(record, response)| LevelDemand {
        level,
        record,
        response,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 130, 95 and 40 mm against demands of three levels.
    #[test]
    fn the_least_margin_governs() {
        let widths = [0.040, 0.095, 0.130];
        let demands = [vec![0.049, 0.092, 0.117], vec![0.030, 0.100, 0.120]];
        let first = Governing::of(&widths, &demands, 0);
        assert_eq!((first.level, first.record), (0, 0));
        assert!((first.margin() + 0.009).abs() < 1e-15);
        // One may touch: the record with the least margin but one.
        let second = Governing::of(&widths, &demands, 1);
        assert_eq!((second.level, second.record), (1, 1));
        assert_eq!((second.required, second.provided), (0.100, 0.095));
        // One width at all levels: the level of the greatest demand; of equals the lowest.
        assert_eq!(Governing::of(&[0.1; 3], &demands, 0).level, 2);
        assert_eq!(Governing::of(&[0.1; 2], &[vec![0.0; 2]], 0).level, 0);
    }
}
