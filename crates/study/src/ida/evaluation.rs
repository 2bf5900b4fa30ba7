//! The evaluation of an incremental dynamic analysis.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use pounding_case::Dimension;

use super::bootstrap::{FrequencyBounds, RecordCounts, bootstrap_sets, frequency_bounds};
use super::demands::{
    Demand, IMPACTS, ISOLATED, Lack, isolated_buildings, of_gap, of_limit, sides_of_gaps, usual,
    yielding_buildings,
};
use super::fragility::{Counts, CurveOfRuns, FragilityFit, fit};
use super::goodness::{self, Capacity, Evidence, FitRemark, Sampled, ShownIntensity};
use super::hazard::{self, least_frequency, mean_annual_frequency};
use super::report::{
    GapResult, IdaReport, IntensityLevel, LimitResult, MinimumGap, OpenGap, PoundingDemand,
};
use crate::error::StudyError;
use crate::fractiles::fractiles;
use crate::study_file::{Design, HazardCurve, IdaSettings, POUNDING, Study, Value, pounding_at};
use pounding_results::study::ResultReader;

/// Part of the records that have runs at all intensities where the others lack one here or there.
const MOSTLY_WHOLE: f64 = 0.9;

/// The state that every analysis has, where gaps vary from run to run.
const AT_GAPS_OF_RUNS: &str = "pounding at the gaps of the runs";

/// The state in which one of several gaps closes that have their least width each.
const AT_LEAST_GAPS: &str = "pounding at any gap of least width";

/// What is kept of a run.
struct Run {
    level: usize,
    /// Which record.
    record: usize,
    /// Which values of the other variables of the study.
    structure: usize,
    /// Which record with which of these.
    sample: usize,
    failed: bool,
    collapsed: bool,
    demands: Vec<f64>,
}

/// Evaluates the result of a study with an `[ida]` part.
///
/// Sets of records are drawn on so many threads, on whose number nothing depends, and `tell` is told how many of how many
/// states are evaluated.
///
/// # Errors
/// A study without that part, or a result that cannot be read or is not that of the study.
pub fn evaluate(
    study: &Study,
    result: &ResultReader,
    (threads, tell): (usize, &dyn Fn(usize, usize)),
) -> Result<IdaReport, StudyError> {
    let wrong = |reason: &str| StudyError::Evaluation {
        what: "incremental dynamic analysis",
        reason: reason.to_owned(),
    };
    let settings = study
        .ida
        .as_ref()
        .ok_or_else(|| wrong("the study has no [ida]"))?;
    if result.rows != study.runs() || result.description.coordinates.len() != study.variables.len()
    {
        return Err(wrong("the result is not that of the whole study"));
    }
    let layout = &result.description.layout;
    let sides = sides_of_gaps(&study.base);
    let isolated = isolated_buildings(&study.base);
    let yielding = yielding_buildings(&study.base);
    let mut shown = usual(layout, &sides, [&isolated, &yielding]);
    let limits: Vec<(Demand, f64)> = settings
        .limits
        .iter()
        .map(|l| {
            let building = l
                .building
                .map(|b| study.base.buildings[b].name.value.as_str());
            (of_limit(layout, &sides, &isolated, l, building), l.exceeds)
        })
        .collect();
    let gaps: Vec<&str> = study.base.gaps.iter().map(|g| g.name.as_str()).collect();
    let needs: Vec<Demand> = shown
        .iter()
        .cloned()
        .chain(limits.iter().map(|(d, _)| d.clone()))
        .chain(gaps.iter().map(|g| of_gap(layout, ISOLATED, g)))
        .chain(gaps.iter().map(|g| of_gap(layout, IMPACTS, g)))
        .collect();
    let mut intensities = study.variables[settings.intensity].values.numbers();
    intensities.sort_by(f64::total_cmp);
    // In a list several records have the same.
    intensities.dedup();
    // In a list each record stands at one intensity, and one of several intensities under several names.
    let records = match study.design {
        Design::List { .. } => study.same_records(),
        _ => (0..study.records.len()).collect(),
    };
    let (mut runs, lacking) = runs(result, (settings, &records), &needs, &intensities)?;
    let of_limits = limits.iter().zip(&lacking[shown.len()..]);
    for ((limit, _), lack) in of_limits {
        let (reason, help) = match lack {
            None | Some(Lack::Place) => continue,
            Some(Lack::Force) => (
                "rigid impacts have no contact force",
                "ask for the impulse instead: demand = \"impulse\"",
            ),
            Some(Lack::Acceleration) => (
                "rigid impacts are jumps of the velocity, which accelerations leave out",
                "ask for another demand, such as demand = \"drift_ratio\", or take a model with a contact force",
            ),
        };
        return Err(StudyError::NoDemand {
            state: limit.name.clone(),
            reason,
            help,
        });
    }
    // What some run does not have is shown of none.
    let mut left_out = Vec::new();
    for place in (0..shown.len()).rev() {
        let Some(lack) = lacking[place] else {
            continue;
        };
        left_out.push((shown.remove(place).name, lack));
        for run in &mut runs {
            run.demands.remove(place);
        }
    }
    left_out.reverse();
    let least = usize::from(settings.target_frequency.is_some());
    let states = 1 + limits.len() + gaps.len() * (settings.gaps.len() + least);
    let done = Cell::new(0);
    let evaluation = Evaluation {
        settings,
        intensities: &intensities,
        runs: &runs,
        threads,
        evaluated: &|| {
            done.set((done.get() + 1).min(states));
            tell(done.get(), states);
        },
    };
    let first_limit = shown.len();
    let first_gap = first_limit + limits.len();
    let first_impacts = first_gap + gaps.len();
    // Who has collapsed has been through every state before.
    let pounds = |r: &Run| r.collapsed || r.demands[first_impacts..].iter().any(|n| *n > 0.0);
    let paths = study.variables.iter().flat_map(|v| v.target.paths());
    let name = match paths.clone().any(|path| path.table() == "gap") {
        true => AT_GAPS_OF_RUNS,
        false => POUNDING,
    };
    let mut results = vec![evaluation.limit(name, &pounds)?];
    for (i, (demand, exceeds)) in limits.iter().enumerate() {
        let reached = |r: &Run| r.demands[first_limit + i] > *exceeds;
        results.push(evaluation.limit(&demand.name, &reached)?);
    }
    let variable = &study.variables[settings.intensity];
    let demanded: Vec<PoundingDemand> = gaps
        .iter()
        .enumerate()
        .map(|(i, g)| evaluation.gap(g, first_gap + i))
        .collect::<Result<_, _>>()?;
    let least = demanded.iter().map(|gap| gap.minimum.as_ref()?.width);
    let least: Option<Vec<f64>> = least.collect();
    let together = match least.filter(|least| least.len() > 1) {
        Some(least) => {
            let closed = |r: &Run| {
                let demands = &r.demands[first_gap..first_impacts];
                demands
                    .iter()
                    .zip(&least)
                    .any(|(demand, width)| demand > width)
            };
            Some(evaluation.limit(AT_LEAST_GAPS, &closed)?)
        }
        None => None,
    };
    Ok(IdaReport {
        measure: settings.measure.title(),
        unit: variable.unit.clone(),
        records: evaluation.records(),
        structures: (study.variables.len() > 2).then(|| evaluation.structures()),
        demands: shown
            .iter()
            .map(|d| (d.name.clone(), d.unit.to_owned()))
            .collect(),
        remarks: of_demands(&left_out),
        levels: evaluation.levels(shown.len()),
        curves: evaluation.curves(shown.len()),
        limits: results,
        gaps: demanded,
        least_gaps_together: together,
    })
}

/// Demands of which there are no fractiles.
fn of_demands(left_out: &[(String, Lack)]) -> Vec<String> {
    let said = |lack: Lack, reason: &str| {
        let names = left_out.iter().filter(|(_, l)| *l == lack);
        let names: Vec<&str> = names.map(|(name, _)| name.as_str()).collect();
        (!names.is_empty()).then(|| format!("{reason}: without {}", names.join(", ")))
    };
    let force = said(Lack::Force, "rigid impacts have no contact force");
    let jumps = "rigid impacts are jumps of the velocity, which accelerations leave out";
    let acceleration = said(Lack::Acceleration, jumps);
    acceleration.into_iter().chain(force).collect()
}

/// Runs with their demands, and of every demand what some run lacks for it.
fn runs(
    result: &ResultReader,
    (settings, records): (&IdaSettings, &[usize]),
    needs: &[Demand],
    intensities: &[f64],
) -> Result<(Vec<Run>, Vec<Option<Lack>>), StudyError> {
    let mut runs = Vec::new();
    let mut lacking = vec![None; needs.len()];
    let mut structures: BTreeMap<Vec<u64>, usize> = BTreeMap::new();
    let mut samples: BTreeMap<[usize; 2], usize> = BTreeMap::new();
    result.each(|row, point| {
        let Value::Number(x) = point[settings.intensity] else {
            return Ok(());
        };
        let record = match point[settings.record] {
            Value::Choice(record) => records[record],
            Value::Number(_) => 0,
        };
        let others = point.iter().enumerate();
        let others = others.filter(|(i, _)| ![settings.intensity, settings.record].contains(i));
        let others: Vec<u64> = others.map(|(_, value)| value.bits()).collect();
        let next = structures.len();
        let structure = *structures.entry(others).or_insert(next);
        let next = samples.len();
        if !row.ending.failed() && !row.ending.collapsed() {
            for (lacking, demand) in lacking.iter_mut().zip(needs) {
                *lacking = lacking.or_else(|| demand.lacks(&row.values));
            }
        }
        runs.push(Run {
            record,
            structure,
            sample: *samples.entry([record, structure]).or_insert(next),
            level: intensities.iter().position(|i| *i == x).unwrap_or(0),
            failed: row.ending.failed(),
            collapsed: row.ending.collapsed(),
            demands: needs
                .iter()
                .map(|d| d.of_run(&row.values, row.ending.collapsed()))
                .collect(),
        });
        Ok::<(), StudyError>(())
    })?;
    Ok((runs, lacking))
}

struct Evaluation<'a> {
    settings: &'a IdaSettings,
    intensities: &'a [f64],
    runs: &'a [Run],
    /// On which sets of records are drawn.
    threads: usize,
    /// Told after each state.
    evaluated: &'a dyn Fn(),
}

impl Evaluation<'_> {
    fn at(&self, level: usize) -> impl Iterator<Item = &Run> {
        self.runs
            .iter()
            .filter(move |r| r.level == level && !r.failed)
    }

    fn counts(&self, reached: &dyn Fn(&Run) -> bool) -> Vec<Counts> {
        let mut counts: Vec<Counts> = self
            .intensities
            .iter()
            .map(|intensity| Counts {
                intensity: *intensity,
                runs: 0,
                reached: 0,
            })
            .collect();
        for run in self.runs.iter().filter(|r| !r.failed) {
            counts[run.level].runs += 1;
            counts[run.level].reached += usize::from(reached(run));
        }
        counts
    }

    /// The frequency of a state, which is a number: comparisons with one that is none are all
    /// false, so that the search for a gap would end there.
    fn frequency(
        fit: &FragilityFit,
        hazard: &HazardCurve,
        of: &str,
    ) -> Result<Option<f64>, StudyError> {
        let frequency = mean_annual_frequency(fit, hazard);
        match frequency {
            Some(frequency) if !frequency.is_finite() => Err(StudyError::Evaluation {
                what: "mean annual frequency",
                reason: format!(
                    "{of}: its probabilities and the hazard curve give no number; are the values of the hazard curve right?"
                ),
            }),
            _ => Ok(frequency),
        }
    }

    fn limit(&self, name: &str, reached: &dyn Fn(&Run) -> bool) -> Result<LimitResult, StudyError> {
        let counts = self.counts(reached);
        let effect = self.design_effect(reached);
        let fit = self.errors_of(fit(&counts), (&counts, effect), reached);
        let evidence = self.evidence(reached);
        let goodness = match &fit {
            FragilityFit::Lognormal(f) => goodness::test(f, &counts, (&evidence, effect)),
            _ => None,
        };
        let hazard = self.settings.hazard.as_ref();
        let frequency = match hazard {
            Some(hazard) => Self::frequency(&fit, hazard, name)?,
            None => None,
        };
        let confidence = self.settings.confidence;
        let fitted = matches!(fit, FragilityFit::Lognormal(_));
        let bounds = hazard.filter(|_| fitted).and_then(|hazard| {
            let groups = self.of_records(reached);
            frequency_bounds(
                self.intensities,
                &groups,
                hazard,
                (confidence, self.threads),
            )
        });
        let of = (&evidence, self.records());
        let mut remarks = goodness::remarks(&fit, goodness.as_ref(), &counts, of);
        remarks.extend(hazard.into_iter().flat_map(|h| self.of_frequency(&fit, h)));
        remarks.extend(bounds.iter().flat_map(of_bounds));
        let several = self.records() > 1;
        if hazard.is_some() && fitted && several && bootstrap_sets(confidence).is_none() {
            remarks.push(FitRemark::NoBoundsSoSure { confidence });
        }
        (self.evaluated)();
        Ok(LimitResult {
            name: name.to_owned(),
            remarks,
            goodness,
            frequency,
            frequency_bounds: bounds,
            counts,
            fit,
        })
    }

    /// The fit with the errors of runs that depend on one another.
    fn errors_of(
        &self,
        fit: FragilityFit,
        (counts, effect): (&[Counts], f64),
        reached: &dyn Fn(&Run) -> bool,
    ) -> FragilityFit {
        let samples = self.curves_of_runs(&|run| run.sample, reached);
        if let Some(curves) = samples {
            let curves = (&curves[..], self.records());
            return fit.of_curves(counts, curves).of_alike_runs(effect);
        }
        // Structures may differ from run to run of a record, whose runs are alike all the same.
        match self.curves_of_runs(&|run| run.record, reached) {
            Some(curves) => fit.of_curves(counts, (&curves, self.records())),
            None => fit.of_alike_runs(effect),
        }
    }

    /// Intensities of the runs of each sample or record that did not fail; `None` where none has several.
    fn curves_of_runs(
        &self,
        key: &dyn Fn(&Run) -> usize,
        reached: &dyn Fn(&Run) -> bool,
    ) -> Option<Vec<CurveOfRuns>> {
        let curve = |states: Vec<Vec<Option<bool>>>| {
            let levels = states.iter().zip(self.intensities);
            let known = levels.map(|(runs, intensity)| {
                let known = runs.iter().flatten().count();
                (*intensity, known as f64)
            });
            known.filter(|(_, runs)| *runs > 0.0).collect()
        };
        let curves = self.states(key, reached).into_values().map(curve);
        let curves: Vec<CurveOfRuns> = curves.collect();
        curves.iter().any(|curve| curve.len() > 1).then_some(curves)
    }

    fn shown(&self, si: f64) -> ShownIntensity {
        ShownIntensity {
            si,
            in_g: self.settings.measure.dimension() == Dimension::ACCELERATION,
        }
    }

    /// What must be said of the frequency of a state.
    fn of_frequency(&self, fit: &FragilityFit, hazard: &HazardCurve) -> Vec<FitRemark> {
        hazard::remarks(fit, hazard, self.intensities, |x| self.shown(x))
    }

    /// How many records have runs that did not all fail: the others say nothing.
    fn records(&self) -> usize {
        let known = self.runs.iter().filter(|run| !run.failed);
        let records: BTreeSet<usize> = known.map(|run| run.record).collect();
        records.len()
    }

    /// The same of structures.
    fn structures(&self) -> usize {
        let known = self.runs.iter().filter(|run| !run.failed);
        let structures: BTreeSet<usize> = known.map(|run| run.structure).collect();
        structures.len()
    }

    /// What the runs say of a state beside its counts.
    fn evidence(&self, reached: &dyn Fn(&Run) -> bool) -> Evidence {
        let levels = self.intensities.len();
        let by_sample = self.states(&|run| run.sample, reached);
        let of = match by_sample.len() > self.records() {
            true => Sampled::RecordsWithStructures,
            false => Sampled::Records,
        };
        if let Some(capacities) = capacities(by_sample, levels) {
            return Evidence::Curves { capacities, of };
        }
        // Structures may differ from run to run of a record.
        let by_record = self.states(&|run| run.record, reached);
        let made = |states: &Vec<Vec<_>>| states.iter().filter(|runs| !runs.is_empty()).count();
        if by_record.values().all(|states| made(states) == 1) {
            return Evidence::Stripes;
        }
        match capacities(by_record, levels) {
            Some(capacities) => Evidence::Curves {
                capacities,
                of: Sampled::Records,
            },
            None => Evidence::Mixed,
        }
    }

    /// Of each sample or record at each intensity what its runs say of a state; `None` of those that failed. Those of which
    /// all failed are left out.
    fn states(
        &self,
        key: &dyn Fn(&Run) -> usize,
        reached: &dyn Fn(&Run) -> bool,
    ) -> BTreeMap<usize, Vec<Vec<Option<bool>>>> {
        let mut found = BTreeMap::new();
        for run in self.runs {
            let states = found
                .entry(key(run))
                .or_insert_with(|| vec![Vec::new(); self.intensities.len()]);
            states[run.level].push((!run.failed).then(|| reached(run)));
        }
        found.retain(|_, states| states.iter().flatten().any(Option::is_some));
        found
    }

    /// How many times as large as that of independent runs the variance of a counted fraction is, as runs of one record
    /// with several structures are alike (Kish 1965, Survey Sampling, eq. 5.4.1): one plus the runs of a record at an
    /// intensity, less one, times their correlation, that of the analysis of variance over the records.
    fn design_effect(&self, reached: &dyn Fn(&Run) -> bool) -> f64 {
        let by_record = self.states(&|run| run.record, reached);
        let (mut between, mut within) = (0.0, 0.0);
        let (mut free_between, mut free_within, mut sizes) = (0.0, 0.0, 0.0);
        for level in 0..self.intensities.len() {
            let records = by_record.values().map(|states| {
                let known = states[level].iter().flatten();
                let (runs, reached) = known.fold((0.0, 0.0), |(runs, reached), state| {
                    (runs + 1.0, reached + f64::from(u8::from(*state)))
                });
                (runs, reached)
            });
            let records: Vec<(f64, f64)> = records.filter(|(runs, _)| *runs > 0.0).collect();
            let runs: f64 = records.iter().map(|(runs, _)| runs).sum();
            let mean = records.iter().map(|(_, reached)| reached).sum::<f64>() / runs;
            if records.len() < 2 {
                continue;
            }
            for (runs, reached) in &records {
                let fraction = reached / runs;
                between += runs * (fraction - mean) * (fraction - mean);
                within += reached * (1.0 - fraction);
            }
            free_between += records.len() as f64 - 1.0;
            free_within += runs - records.len() as f64;
            let squares: f64 = records.iter().map(|(runs, _)| runs * runs).sum();
            sizes += runs - squares / runs;
        }
        if !(free_within > 0.0 && between > 0.0) {
            return 1.0;
        }
        let size = sizes / free_between;
        let (between, within) = (between / free_between, within / free_within);
        let correlation = (between - within) / (between + (size - 1.0) * within);
        (1.0 + (size - 1.0) * correlation).clamp(1.0, size)
    }

    /// Runs of each record by intensity, and how many reach a state; the records in groups that have runs at the same
    /// intensities. A record of which all failed cannot be drawn.
    fn of_records(&self, reached: &dyn Fn(&Run) -> bool) -> Vec<Vec<RecordCounts>> {
        let levels = self.intensities.len();
        let mut records: BTreeMap<usize, (Vec<bool>, RecordCounts)> = BTreeMap::new();
        for run in self.runs {
            let (made, counts) = records
                .entry(run.record)
                .or_insert_with(|| (vec![false; levels], vec![(0, 0); levels]));
            made[run.level] = true;
            if !run.failed {
                counts[run.level].0 += 1;
                counts[run.level].1 += usize::from(reached(run));
            }
        }
        let mut groups: BTreeMap<Vec<bool>, Vec<RecordCounts>> = BTreeMap::new();
        for (made, counts) in records.into_values() {
            if counts.iter().any(|(runs, _)| *runs > 0) {
                groups.entry(made).or_default().push(counts);
            }
        }
        groups.into_values().collect()
    }

    /// Demands of all samples at all intensities.
    fn curves(&self, demands: usize) -> Vec<Vec<Vec<f64>>> {
        let samples = self.runs.iter().map(|r| r.sample + 1).max().unwrap_or(0);
        let none = vec![vec![f64::NAN; self.intensities.len()]; samples];
        let mut curves = vec![none; demands];
        for run in self.runs.iter().filter(|r| !r.failed) {
            for (demand, curve) in curves.iter_mut().enumerate() {
                curve[run.sample][run.level] = run.demands[demand];
            }
        }
        curves
    }

    fn levels(&self, demands: usize) -> Vec<IntensityLevel> {
        let level = |(level, intensity): (usize, &f64)| IntensityLevel {
            intensity: *intensity,
            runs: self.at(level).count(),
            collapsed: self.at(level).filter(|r| r.collapsed).count(),
            failed: self
                .runs
                .iter()
                .filter(|r| r.level == level && r.failed)
                .count(),
            fractiles: (0..demands)
                .map(|d| fractiles(self.at(level).map(|r| r.demands[d]).collect()))
                .collect(),
        };
        self.intensities.iter().enumerate().map(level).collect()
    }

    fn gap(&self, name: &str, column: usize) -> Result<PoundingDemand, StudyError> {
        let at = |width: f64| {
            let result = self.limit(&pounding_at(name, width), &|r| r.demands[column] > width)?;
            Ok(GapResult { width, result })
        };
        let widths = self.settings.gaps.iter().map(|w| at(*w));
        Ok(PoundingDemand {
            gap: name.to_owned(),
            widths: widths.collect::<Result<_, StudyError>>()?,
            minimum: match self.settings.target_frequency {
                Some(target) => self.minimum(name, column, target)?,
                None => None,
            },
        })
    }

    /// The least width from which on the frequency stays at or below the target. Counts
    /// change only at the demands of the runs, which are looked at one by one, from the
    /// maximum down.
    fn minimum(
        &self,
        gap: &str,
        column: usize,
        target: f64,
    ) -> Result<Option<MinimumGap>, StudyError> {
        let Some(hazard) = &self.settings.hazard else {
            return Ok(None);
        };
        let mut demands: Vec<f64> = self
            .runs
            .iter()
            .filter(|r| !r.failed)
            .map(|r| r.demands[column])
            .collect();
        if demands.is_empty() {
            return Ok(None);
        }
        // Buildings that collapse by themselves are kept apart by no gap.
        demands.retain(|d| d.is_finite());
        demands.push(0.0);
        demands.sort_by(|a, b| b.total_cmp(a));
        demands.dedup();
        let reached = |width: f64| move |r: &Run| r.demands[column] > width;
        let fitted = |width: f64| fit(&self.counts(&reached(width)));
        let at = |width: Option<f64>, demand: f64| -> Result<_, StudyError> {
            Ok(MinimumGap {
                width,
                open: None,
                hazard_begins: None,
                result: self.limit(&pounding_at(gap, demand), &reached(demand))?,
            })
        };
        let mut best: Option<f64> = None;
        for (i, width) in demands.iter().enumerate() {
            let fit = fitted(*width);
            let frequency = Self::frequency(&fit, hazard, gap)?.unwrap_or(f64::INFINITY);
            // A gap is wide enough if it is with what the curve leaves out.
            let by_curve = frequency <= target;
            if frequency + hazard::uncounted(&fit, hazard, frequency) <= target {
                best = Some(*width);
                continue;
            }
            let mut least = at(best, best.unwrap_or(*width))?;
            if by_curve {
                least.hazard_begins = Some(self.shown(hazard.points[0].0));
            } else if best.is_some() && least_frequency(&fit, hazard) <= target {
                least.open = Some(self.open(&fit, hazard, target, || {
                    // Up to the next demand no run tells gaps apart.
                    let too_narrow = |w: &f64| least_frequency(&fitted(*w), hazard) > target;
                    let narrow = demands[i..].iter().position(too_narrow)?;
                    (i + narrow).checked_sub(1).map(|next| demands[next])
                }));
            }
            return Ok(Some(least));
        }
        best.map(|width| at(best, width)).transpose()
    }

    /// What a fit leaves open of a least gap.
    fn open(
        &self,
        fit: &FragilityFit,
        hazard: &HazardCurve,
        target: f64,
        too_narrow: impl Fn() -> Option<f64>,
    ) -> OpenGap {
        let (from, to) = match *fit {
            FragilityFit::Step { lower, upper } => (lower, upper),
            FragilityFit::Always { from } => (0.0, from),
            _ => (0.0, f64::INFINITY),
        };
        OpenGap {
            wider_than: too_narrow().unwrap_or(0.0),
            from: (from > 0.0).then(|| self.shown(from)),
            to: to.is_finite().then(|| self.shown(to)),
            wanted: hazard.intensity(target).map(|x| self.shown(x)),
        }
    }
}

/// Where each of samples first reaches a state, if nearly all have one run at every intensity. One with a run that
/// failed is left out where that could change it.
fn capacities(
    samples: BTreeMap<usize, Vec<Vec<Option<bool>>>>,
    levels: usize,
) -> Option<Vec<Capacity>> {
    let is_whole = |states: &&Vec<Vec<_>>| states.iter().all(|runs| runs.len() == 1);
    let whole = samples.values().filter(is_whole).count();
    let once = samples.values().flatten().all(|runs| runs.len() < 2);
    // A record may lack a run here or there.
    if !once || (whole as f64) < MOSTLY_WHOLE * samples.len() as f64 {
        return None;
    }
    let capacity = |states: Vec<Vec<Option<bool>>>| {
        let state = |level: usize| states[level].first().copied().flatten();
        let first = (0..levels).find(|level| state(*level) == Some(true));
        let first = first.unwrap_or(levels);
        let known = (0..first).all(|level| state(level).is_some());
        known.then(|| Capacity {
            first,
            returns: (first..levels).any(|level| state(level) == Some(false)),
        })
    };
    Some(samples.into_values().filter_map(capacity).collect())
}

/// What must be said of bounds that are missing.
fn of_bounds(bounds: &FrequencyBounds) -> Vec<FitRemark> {
    let &FrequencyBounds {
        sets,
        below,
        above,
        unknown,
        ..
    } = bounds;
    let low = bounds.low.is_none() && below + unknown > 0;
    let low = low.then_some(FitRemark::NoLowerBound {
        sets,
        below,
        unknown,
    });
    let high = bounds.high.is_none();
    let high = high.then_some(FitRemark::NoUpperBound {
        sets,
        above,
        unknown,
    });
    low.into_iter().chain(high).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::study_file::IntensityMeasure;
    use pounding_catalogue::STANDARD_GRAVITY;

    /// Of a single demand, for a hazard curve and a target frequency if there are such.
    fn settings(hazard: Option<(HazardCurve, f64)>) -> IdaSettings {
        let (hazard, target_frequency) = hazard.unzip();
        IdaSettings {
            record: 0,
            intensity: 1,
            measure: IntensityMeasure::PeakGroundAcceleration,
            gaps: Vec::new(),
            limits: Vec::new(),
            hazard,
            hazard_file: None,
            target_frequency,
            confidence: 0.95,
            asked: Vec::new(),
        }
    }

    /// Runs of twelve records at six intensities, with so many structures each, which act as `factor` says of record and structure.
    fn with_structures(structures: usize, factor: &dyn Fn(usize, usize) -> f64) -> LimitResult {
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let intensities: Vec<f64> = (0..6).map(|i| 0.5 * 1.35_f64.powi(i)).collect();
        let mut runs = Vec::new();
        for record in 0..12 {
            let capacity = libm::exp(0.4 * quantile((record as f64 + 0.5) / 12.0));
            for structure in 0..structures {
                for (level, intensity) in intensities.iter().enumerate() {
                    runs.push(Run {
                        level,
                        record,
                        structure: record * structures + structure,
                        sample: record * structures + structure,
                        failed: false,
                        collapsed: false,
                        demands: vec![intensity / capacity * factor(record, structure)],
                    });
                }
            }
        }
        let settings = settings(None);
        let evaluation = Evaluation {
            settings: &settings,
            intensities: &intensities,
            runs: &runs,
            threads: 2,
            evaluated: &|| (),
        };
        evaluation.limit("state", &|r| r.demands[0] > 1.0).unwrap()
    }

    /// Ten structures for each record that are one say what one does: median, dispersion, their bounds and the test of the
    /// fit. Of ten that differ far more than records do each counts.
    #[test]
    fn structures_of_a_record_that_are_alike_count_once() {
        let fitted = |result: &LimitResult| match result.fit {
            FragilityFit::Lognormal(fit) => fit,
            other => panic!("{other:?}"),
        };
        let (one, ten) = (
            with_structures(1, &|_, _| 1.0),
            with_structures(10, &|_, _| 1.0),
        );
        let (a, b) = (fitted(&one), fitted(&ten));
        let near = |x: f64, y: f64| assert!((x / y - 1.0).abs() < 1e-6, "{x} {y}");
        near(a.median, b.median);
        near(a.dispersion, b.dispersion);
        near(a.standard_errors[0], b.standard_errors[0]);
        near(a.standard_errors[1], b.standard_errors[1]);
        near(a.covariance, b.covariance);
        let (a, b) = (one.goodness.unwrap(), ten.goodness.unwrap());
        near(a.p_value, b.p_value);
        assert_eq!(a.degrees_of_freedom, b.degrees_of_freedom);
        let random = |record: usize, structure: usize| {
            let unit = crate::mixing::unit(&[5, record as u64, structure as u64]);
            libm::exp(2.0 * pounding_ground_motion::distributions::normal_quantile(unit))
        };
        let (one, ten) = (with_structures(1, &random), with_structures(10, &random));
        let ratio = fitted(&one).standard_errors[0] / fitted(&ten).standard_errors[0];
        assert!(ratio > 2.0 && ratio < 4.5, "{ratio}");
    }

    /// Records of which every run failed say nothing: they make no bound narrower, and hide no remark that records are
    /// few, whether the others run at all intensities, with one structure or two, or stand in stripes.
    #[test]
    fn records_of_which_all_runs_failed_do_not_count() {
        let points = [(0.1, 1e-1), (1.0, 1e-2), (10.0, 1e-4)];
        let settings = settings(Some((HazardCurve::new(points.to_vec()).unwrap(), 1e-3)));
        let intensities: Vec<f64> = (0..6).map(|i| 0.5 * 1.35_f64.powi(i)).collect();
        // Whether records stand in stripes, structures of each, and records that have results.
        for (in_stripes, structures, records) in [(false, 1, 4), (false, 2, 4), (true, 1, 24)] {
            let of = |failed: usize| {
                let mut runs = Vec::new();
                for (record, (level, intensity)) in (0..records + failed)
                    .flat_map(|r| intensities.iter().enumerate().map(move |at| (r, at)))
                {
                    if in_stripes && record % records / 4 != level {
                        continue;
                    }
                    for structure in 0..structures {
                        let place = 0.618 * (record * structures + structure + 1) as f64;
                        let demand = intensity / (0.6 + 1.2 * place.fract());
                        runs.push(Run {
                            level,
                            record,
                            structure,
                            sample: record * structures + structure,
                            failed: record >= records,
                            collapsed: false,
                            demands: vec![demand],
                        });
                    }
                }
                let evaluation = Evaluation {
                    settings: &settings,
                    intensities: &intensities,
                    runs: &runs,
                    threads: 2,
                    evaluated: &|| (),
                };
                assert_eq!(evaluation.records(), records);
                evaluation.limit("state", &|r| r.demands[0] > 1.0).unwrap()
            };
            let alone = of(0);
            assert!(matches!(alone.fit, FragilityFit::Lognormal(_)), "{alone:?}");
            assert!(alone.frequency_bounds.is_some());
            for failed in [1, 5, 20] {
                assert_eq!(of(failed), alone);
            }
        }
    }

    /// Records whose demand grows in proportion to the intensity, at quantiles of a lognormal
    /// distribution, and the least gap by these intensities (g).
    fn least_gap(intensities: &[f64]) -> MinimumGap {
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let per_g =
            (0..30).map(|record| 0.2 * libm::exp(0.4 * quantile((f64::from(record) + 0.5) / 30.0)));
        let demands: Vec<f64> = per_g.collect();
        least_gap_of(&demands, intensities, (2e-4, 2e-3))
    }

    /// The same of records with these demands (m) at 1 g, for a hazard of this frequency there, and a
    /// target.
    fn least_gap_of(
        per_g: &[f64],
        intensities: &[f64],
        (at_1_g, target): (f64, f64),
    ) -> MinimumGap {
        let points = [0.02, 0.5, 10.0].map(|x| (x * STANDARD_GRAVITY, at_1_g / f64::powi(x, 2)));
        least_gap_under(per_g, intensities, (&points, target))
    }

    /// The same for a hazard curve of these points.
    fn least_gap_under(
        per_g: &[f64],
        intensities: &[f64],
        (points, target): (&[(f64, f64)], f64),
    ) -> MinimumGap {
        let hazard = HazardCurve::new(points.to_vec()).unwrap();
        let settings = settings(Some((hazard, target)));
        let runs = per_g.iter().enumerate().flat_map(|(record, per_g)| {
            intensities.iter().enumerate().map(move |(level, g)| Run {
                level,
                record,
                structure: 0,
                sample: record,
                failed: false,
                collapsed: false,
                demands: vec![per_g * g],
            })
        });
        let runs: Vec<Run> = runs.collect();
        let intensities: Vec<f64> = intensities.iter().map(|g| g * STANDARD_GRAVITY).collect();
        let evaluation = Evaluation {
            settings: &settings,
            intensities: &intensities,
            runs: &runs,
            threads: 2,
            evaluated: &|| (),
        };
        evaluation.minimum("pair", 0, target).unwrap().unwrap()
    }

    /// Two records close every gap below 36.75 mm at 0.1 g, which is exceeded three times as often as the target
    /// allows: none of them can be the least one, wherever the next narrower demand lies.
    #[test]
    fn gaps_below_a_demand_are_too_narrow_up_to_it() {
        let found = least_gap_of(&[0.3675, 0.4], &[0.1, 0.3], (3e-4, 1e-2));
        let open = found.open.unwrap();
        assert!((open.wider_than - 0.03675).abs() < 1e-9, "{found:?}");
        assert!(found.width.unwrap() > 0.04, "{found:?}");
    }

    /// A curve that falls to a tenth within 2 % has its least gap as one without that does: the
    /// frequency comes from far below.
    #[test]
    fn a_steep_end_of_the_hazard_leaves_the_least_gap() {
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let per_g =
            (0..30).map(|record| 0.2 * libm::exp(0.4 * quantile((f64::from(record) + 0.5) / 30.0)));
        let per_g: Vec<f64> = per_g.collect();
        let fine: Vec<f64> = (0..16).map(|i| 0.05 * 1.35_f64.powi(i)).collect();
        let points = [(0.02, 0.5), (2.0, 5e-5)].map(|(x, y)| (x * STANDARD_GRAVITY, y));
        let smooth = least_gap_under(&per_g, &fine, (&points, 2e-3));
        let last = (2.02 * STANDARD_GRAVITY, 5e-6);
        let steep = least_gap_under(&per_g, &fine, (&[points[0], points[1], last], 2e-3));
        let (a, b) = (smooth.width.unwrap(), steep.width.unwrap());
        assert!((b / a - 1.0).abs() < 0.02, "{smooth:?} {steep:?}");
        assert!(
            steep.frequency() <= 2e-3 && steep.open.is_none(),
            "{steep:?}"
        );
    }

    /// A curve cut off where it passes the target leaves out what decides of narrow gaps: the width is
    /// at most that which is enough with its first power law going on, or there is none.
    #[test]
    fn a_curve_that_begins_late_bounds_the_least_gap() {
        let quantile = pounding_ground_motion::distributions::normal_quantile;
        let per_g =
            (0..30).map(|record| 0.2 * libm::exp(0.4 * quantile((f64::from(record) + 0.5) / 30.0)));
        let per_g: Vec<f64> = per_g.collect();
        let fine: Vec<f64> = (0..16).map(|i| 0.05 * 1.35_f64.powi(i)).collect();
        // Exceeded with 2e-4 / x^2, x in g, from this intensity on.
        let from = |first: f64| {
            let points = [first, 2.0 * first, 10.0];
            let points = points.map(|x| (x * STANDARD_GRAVITY, 2e-4 / (x * x)));
            least_gap_under(&per_g, &fine, (&points, 2e-3))
        };
        let whole = from(0.02);
        let late = from(0.29);
        let first = late.hazard_begins.unwrap().si;
        assert!((first / STANDARD_GRAVITY - 0.29).abs() < 1e-12);
        assert!(whole.hazard_begins.is_none() && !whole.is_at_most());
        assert_eq!(late.width, whole.width);
        assert!(late.is_at_most() && late.frequency() < whole.frequency());
        let said = late.remarks();
        assert!(
            said[0].contains("the hazard curve begins at 0.290 g"),
            "{said:?}"
        );
        // Steep at its beginning, it leaves out more than any number.
        let points = [(0.29, 2.38e-3), (0.2901, 2.37e-3), (10.0, 2e-6)];
        let points = points.map(|(x, y)| (x * STANDARD_GRAVITY, y));
        let steep = least_gap_under(&per_g, &fine, (&points, 2.2e-3));
        assert!(steep.hazard_begins.is_some(), "{steep:?}");
    }

    /// The frequency of a width `w` is `k0 (w / 0.2)^-2 exp(2 beta^2)`: the target asks for
    /// 0.2 sqrt(0.1 exp(0.32)) = 74.2 mm. Intensities that reach around 0.316 g find it; those
    /// that lie above or below give an upper bound, and say so with what lies below it.
    #[test]
    fn gaps_that_the_intensities_leave_open_are_bounds() {
        let exact = 0.2 * (0.1 * libm::exp(0.32)).sqrt();
        let fine: Vec<f64> = (0..16).map(|i| 0.05 * 1.35_f64.powi(i)).collect();
        let found = least_gap(&fine);
        assert!(
            (found.width.unwrap() / exact - 1.0).abs() < 0.06,
            "{found:?}"
        );
        assert_eq!((found.open, found.remarks()), (None, Vec::new()));
        for (intensities, place) in [
            (vec![3.0, 4.0], "intensities below"),
            (vec![0.05, 0.06], "intensities above"),
            (vec![0.1, 3.0], "intensities above 0.100 g"),
        ] {
            let found = least_gap(&intensities);
            let Some(width) = found.width else {
                // Which was said before.
                assert!(intensities[1] < 0.1, "{found:?}");
                continue;
            };
            let open = found.open.unwrap();
            assert!(open.wider_than < exact && exact < width, "{found:?}");
            let said = open.to_string();
            assert!(said.contains(place), "{said}");
            assert!(said.contains("around 0.316 g"), "{said}");
        }
    }
}
