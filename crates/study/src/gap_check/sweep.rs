//! What pounding does at many widths: a gap slightly too small can be worse than none.

use std::sync::Arc;

use pounding_time_history::{
    BuildingOutcome, ContactLevel, Gap, GapOutcome, LevelOutcome, Recorder, RelativeDisplacement,
    RunOptions, System, run,
};

use super::SAME;
use super::collapse::collapsed_building;
use super::dealt::{Deal, Numbers, Stored};
use super::demand::{Amplification, RecordDemand, amplification};
use super::error::CheckError;
use super::parallel::{Ending, Progress};
use super::records::CaseUnderRecord;
use super::systems::rebuilt;

/// Most widths of a sweep: every one is a run of every record, whose peaks are kept.
const MOST_POINTS: usize = 100_000;

/// Which widths.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepOptions {
    /// Gap whose width varies; `None`: all gaps of the case, all with the same width.
    pub gap: Option<String>,
    /// Smallest width (m); `None`: one step, so that the next below were zero. If the maximum
    /// is not given either and nothing is demanded, there is no width.
    pub from: Option<f64>,
    /// Maximum width (m); `None`: that of [`widest`].
    pub to: Option<f64>,
    /// Number of widths, evenly spaced, both ends among them.
    pub points: usize,
}

/// The first width in words, and on the command line.
const FIRST_WIDTH: (&str, &str) = ("first width of the sweep", "--from");

impl SweepOptions {
    /// Number of widths unless another is asked for.
    pub const POINTS: usize = 400;

    pub(crate) fn check(&self) -> Result<(), CheckError> {
        let refuse = |(option, argument), value, allowed| {
            Err(CheckError::Option {
                option,
                argument,
                value,
                allowed,
            })
        };
        if self.points < 2 {
            return refuse(
                ("number of widths in the sweep", "--points"),
                self.points as f64,
                "two or more",
            );
        }
        if self.points > MOST_POINTS {
            return refuse(
                ("number of widths in the sweep", "--points"),
                self.points as f64,
                "at most 100000",
            );
        }
        let from = self.from.unwrap_or(0.0);
        if !(from.is_finite() && from >= 0.0) {
            return refuse(FIRST_WIDTH, from, "zero or more");
        }
        match self.to {
            Some(to) if !(to.is_finite() && to > from) => refuse(
                ("last width of the sweep", "--to"),
                to,
                "greater than the first width",
            ),
            _ => Ok(()),
        }
    }
}

/// One run of the sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRun {
    /// Amplification of each building and storey.
    pub amplification: Vec<Vec<Amplification>>,
    /// What happened in each gap of the case.
    pub gaps: Vec<GapRun>,
}

impl SweepRun {
    /// What happened in the gap of this number, or in all of them together.
    ///
    /// # Panics
    /// Where the case has no gap of this number.
    #[must_use]
    pub fn contact(&self, gap: Option<usize>) -> GapRun {
        gap.map_or_else(|| GapRun::together(&self.gaps), |gap| self.gaps[gap])
    }
}

/// What happened in one gap of a run, or in several.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GapRun {
    /// Impacts at all levels.
    pub impacts: usize,
    /// Maximum contact force (N); NaN where velocities jump at impacts: what rigid floors have
    /// is the force that holds them together where contact lasts.
    pub peak_force: f64,
    /// Energy dissipated in its contacts (J).
    pub impact_energy: f64,
}

impl GapRun {
    fn of(system: &System, gap: &Gap, outcome: &GapOutcome) -> Self {
        let levels = outcome.levels.iter().zip(system.levels_of(gap));
        let level = |(outcome, level): (&LevelOutcome, &ContactLevel)| Self {
            impacts: outcome.impacts,
            peak_force: match outcome.impacts {
                0 => 0.0,
                _ if level.model.rigid_restitution().is_some() => f64::NAN,
                _ => outcome.peak_force.value,
            },
            impact_energy: outcome.energy_dissipated,
        };
        Self::together(&levels.map(level).collect::<Vec<_>>())
    }

    /// The sum of what happened, and the maximum force: of a force and none there is no maximum.
    fn together(several: &[Self]) -> Self {
        let forces = several.iter().map(|run| run.peak_force);
        Self {
            impacts: several.iter().map(|run| run.impacts).sum(),
            peak_force: forces.fold(0.0, |m: f64, f| {
                if f.is_nan() || m.is_nan() {
                    f64::NAN
                } else {
                    m.max(f)
                }
            }),
            impact_energy: several.iter().map(|run| run.impact_energy).sum(),
        }
    }
}

/// The width at which pounding does most harm to one quantity of a building. A width of
/// the sweep, never one between two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstWidth {
    /// Amplification (-).
    pub amplification: f64,
    /// Width (m).
    pub width: f64,
    /// Record, from zero.
    pub record: usize,
    /// Storey, from zero.
    pub storey: usize,
}

impl WorstWidth {
    /// Whether pounding raises the quantity, by more than what two runs of one motion differ.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.amplification > 1.0 + SAME
    }
}

/// The whole sweep.
#[derive(Debug, Clone, PartialEq)]
pub struct GapSweep {
    /// Gap whose width varies; `None`: all.
    pub gap: Option<String>,
    /// Widths (m), ascending; none where no gap that varies demands any.
    pub widths: Vec<f64>,
    /// A run for each width and record, or why it failed.
    pub runs: Vec<Vec<Result<SweepRun, String>>>,
    /// Number of the gap whose width varies.
    number: Option<usize>,
}

impl GapSweep {
    /// What happened in the gap whose width varies, or in all gaps where all vary: what happens
    /// in the others of a row is not of this width.
    #[must_use]
    pub fn contact(&self, run: &SweepRun) -> GapRun {
        run.contact(self.number)
    }

    /// Maximum over records of what [`of_building`](Self::of_building) finds, at one width.
    #[must_use]
    pub fn over_records(
        &self,
        width: usize,
        building: usize,
        quantity: fn(&Amplification) -> f64,
    ) -> Option<f64> {
        let runs = self.runs.get(width)?.iter().flatten();
        let values = runs.filter_map(|run| Self::of_building(run, building, quantity));
        values.map(|(_, x)| x).reduce(f64::max)
    }

    /// Maximum amplification of a quantity over the storeys of a building, at one width
    /// under one record, with its storey (from zero); `None` where no storey has one.
    #[must_use]
    pub fn of_building(
        run: &SweepRun,
        building: usize,
        quantity: fn(&Amplification) -> f64,
    ) -> Option<(usize, f64)> {
        Amplification::of_storeys(run.amplification.get(building)?, quantity)
    }

    /// Maximum amplification of a quantity of a building over all widths and records;
    /// `None` if every run failed. Runs in which a building collapsed have no peaks and are
    /// worse than any: [`collapses`](Self::collapses).
    #[must_use]
    pub fn worst(
        &self,
        building: usize,
        quantity: fn(&Amplification) -> f64,
    ) -> Option<WorstWidth> {
        let mut worst: Option<WorstWidth> = None;
        for (width, runs) in self.widths.iter().zip(&self.runs) {
            for (record, run) in runs.iter().enumerate() {
                let Ok(run) = run else { continue };
                let Some((storey, x)) = Self::of_building(run, building, quantity) else {
                    continue;
                };
                if worst.is_none_or(|w| x > w.amplification) {
                    worst = Some(WorstWidth {
                        amplification: x,
                        width: *width,
                        record,
                        storey,
                    });
                }
            }
        }
        worst
    }

    /// Runs that failed; those in which a building collapsed did not.
    #[must_use]
    pub fn failures(&self) -> usize {
        let diagnoses = self.runs.iter().flatten().filter_map(|r| r.as_ref().err());
        diagnoses
            .filter(|d| collapsed_building(d).is_none())
            .count()
    }

    /// Whether pounding brings a building to collapse at one width, under some record.
    #[must_use]
    pub fn collapses(&self, width: usize, building: &str) -> bool {
        let mut diagnoses = self.runs[width].iter().filter_map(|r| r.as_ref().err());
        diagnoses.any(|d| collapsed_building(d) == Some(building))
    }
}

/// Number of the gap of this name.
pub(crate) fn find(system: &System, name: &str) -> Result<usize, CheckError> {
    let gaps = system.gaps();
    let found = gaps.iter().position(|g| g.name == name);
    found.ok_or_else(|| CheckError::UnknownGap {
        name: name.to_owned(),
        known: gaps.iter().map(|g| g.name.clone()).collect(),
    })
}

/// Who makes the runs, and how.
pub(crate) struct Shared<'s> {
    pub deal: &'s Deal,
    pub identity: &'s dyn Fn() -> String,
    pub threads: usize,
    pub progress: Progress<'s>,
}

impl Stored for SweepRun {
    fn to_numbers(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.gaps.len() as f64);
        for gap in &self.gaps {
            numbers.extend([gap.impacts as f64, gap.peak_force, gap.impact_energy]);
        }
        Amplification::to_numbers(&self.amplification, numbers);
    }

    fn from_numbers(numbers: &mut Numbers<'_>) -> Option<Self> {
        let count = numbers.take()? as usize;
        let gap = |_| {
            Some(GapRun {
                impacts: numbers.take()? as usize,
                peak_force: numbers.take()?,
                impact_energy: numbers.take()?,
            })
        };
        Some(Self {
            gaps: (0..count).map(gap).collect::<Option<_>>()?,
            amplification: Amplification::from_numbers(numbers)?,
        })
    }
}

pub(crate) fn sweep(
    records: &[CaseUnderRecord],
    demands: &[RecordDemand],
    (asked, gap): (&SweepOptions, Option<usize>),
    shared: &Shared<'_>,
) -> Result<GapSweep, CheckError> {
    let to = asked.to.unwrap_or_else(|| widest(records, demands, gap));
    if asked.to.is_none() && to <= asked.from.unwrap_or(0.0) {
        if let Some(from) = asked.from {
            return Err(CheckError::Option {
                option: FIRST_WIDTH.0,
                argument: FIRST_WIDTH.1,
                value: from,
                allowed: "less than the demand of some record, where `--to` is not given",
            });
        }
        // Nothing to make, which is dealt out as well.
        let on = (shared.threads, shared.progress);
        let none = |_: usize, _: &mut Ending<'_>| Err::<SweepRun, _>(String::new());
        shared.deal.runs(shared.identity, 0, on, none)?;
        return Ok(GapSweep {
            gap: asked.gap.clone(),
            widths: Vec::new(),
            runs: Vec::new(),
            number: gap,
        });
    }
    let widths = even_widths(asked.from, to, asked.points);
    let count = widths.len() * records.len();
    let make = |number: usize, ending: &mut Ending<'_>| {
        let (i, r) = (number / records.len(), number % records.len());
        let assembly = &records[r].assembly;
        let system = (&assembly.system, &assembly.options);
        at_width(
            system,
            &demands[r].isolated,
            (widths[i], gap),
            &mut [ending],
        )
    };
    let on = (shared.threads, shared.progress);
    let runs = shared.deal.runs(shared.identity, count, on, make)?;
    let mut runs = runs.into_iter();
    let by_width = widths.iter();
    let runs = by_width.map(|_| runs.by_ref().take(records.len()).collect());
    Ok(GapSweep {
        gap: asked.gap.clone(),
        runs: runs.collect(),
        widths,
        number: gap,
    })
}

/// So many widths (m), two or more, at even steps to the last one; from one step on, so that the
/// next below were zero, if the first is not given.
#[must_use]
pub fn even_widths(from: Option<f64>, to: f64, points: usize) -> Vec<f64> {
    let from = from.unwrap_or(to / points as f64);
    let steps = points.saturating_sub(1) as f64;
    let width = |i: usize| from + (to - from) * i as f64 / steps;
    (0..points).map(width).collect()
}

/// The last width of a sweep (m): a little more than the maximum demand of the gaps that vary,
/// beyond which they are not touched. Where one gap varies among others, buildings that were hit
/// there can close it beyond its demand: then a little more than what would keep it open, with the
/// others as they are, and than its own width.
#[must_use]
pub fn widest(records: &[CaseUnderRecord], demands: &[RecordDemand], gap: Option<usize>) -> f64 {
    let in_row = |(record, gap): (&CaseUnderRecord, usize)| {
        let (system, options) = (&record.assembly.system, &record.assembly.options);
        let gaps = system.gaps();
        let levels = system.levels_of(gaps.get(gap).filter(|_| gaps.len() > 1)?);
        let provided = levels.iter().fold(0.0_f64, |m, l| m.max(l.width));
        Some(provided.max(demand_in_row(system, options, gap).unwrap_or(0.0)))
    };
    let alone = gap
        .into_iter()
        .flat_map(|gap| records.iter().map(move |r| (r, gap)));
    let pushed = alone.filter_map(in_row).fold(0.0, f64::max);
    let gaps = demands.iter().flat_map(|r| r.demand.iter().enumerate());
    let varied = gaps.filter(|(index, _)| gap.is_none_or(|g| g == *index));
    let peaks = varied.flat_map(|(_, levels)| levels);
    1.05 * peaks.fold(pushed, |m, p| m.max(p.value))
}

/// A width (m) that no building closes.
const OPEN: f64 = 1.0e3;

/// The maximum approach (m) at the levels of a gap that cannot close, with the others as they are;
/// `None` where that run fails.
fn demand_in_row(system: &System, options: &RunOptions, gap: usize) -> Option<f64> {
    let opened = rebuilt(system, |index, level| {
        let width = if index == gap { OPEN } else { level.width };
        (width, Arc::clone(&level.model))
    });
    let mut approach = RelativeDisplacement::of_levels(system);
    run(&opened.ok()?, options, &mut [&mut approach], &mut |_| {}).ok()?;
    let levels = &system.gaps()[gap];
    let peaks = approach.peaks().iter().skip(levels.first_level);
    Some(peaks.take(levels.levels).fold(0.0, |m, p| m.max(p.value)))
}

/// The run of a system at one width (m) of all its gaps, or of the one of this number;
/// `isolated` are the peaks of its buildings without contact. Recorders see it, and may end it.
///
/// # Errors
/// Why it failed, in words.
pub fn at_width(
    (system, options): (&System, &RunOptions),
    isolated: &[BuildingOutcome],
    (width, gap): (f64, Option<usize>),
    recorders: &mut [&mut dyn Recorder],
) -> Result<SweepRun, String> {
    let system = rebuilt(system, |index, level| {
        let varies = gap.is_none_or(|g| g == index);
        let width = if varies { width } else { level.width };
        (width, Arc::clone(&level.model))
    });
    let system = system.map_err(|e| e.to_string())?;
    let outcome = run(&system, options, recorders, &mut |_| {});
    let outcome = outcome.map_err(|e| e.to_string())?;
    let gaps = system.gaps().iter().zip(&outcome.gaps);
    Ok(SweepRun {
        amplification: amplification(&outcome.buildings, isolated),
        gaps: gaps.map(|(gap, o)| GapRun::of(&system, gap, o)).collect(),
    })
}
