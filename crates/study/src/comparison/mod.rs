//! Is the answer sensitive to the impact model? Every model on every record, calibrated
//! alike, with the spread between models beside that between records.

mod conclusions;
mod differences;
mod quantities;
mod spread;

pub use conclusions::{Conclusion, Holds, Judgement};
pub use differences::{LevelDifference, StoreyDifference};
pub use quantities::{Quantity, QuantityKind};
pub use spread::{Ranking, Spread};

pub use crate::calibration::{CalibratedModel, ReferenceCollision, RestitutionRule, StiffnessRule};

use std::sync::Arc;

use pounding_case::Case;
use pounding_catalogue::numbers::significant;
use pounding_gap_element::{APPROACH_VELOCITY_FLOOR, ImpactModel, ModelDescriptor};
use pounding_time_history::{BuildingOutcome, Peak, Recorder, StoreyPeaks, System, run};

use crate::calibration::{calibrated, descriptors, references};
use crate::gap_check::{
    Amplification, CaseUnderRecord, CheckError, CollapsedRecord, Deal, GapLevel, Numbers, Progress,
    RecordDemand, Repeated, Stored, UNWATCHED, amplification, collapsed_building, identity,
    in_parallel, levels, rebuilt, stand_or_collapse, warnings, without_collapsed,
};

/// What is asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct ComparisonOptions {
    /// Names of the models; empty: all of the registry.
    pub models: Vec<String>,
    /// How stiffnesses follow from that of the gap's own law.
    pub stiffness_rule: StiffnessRule,
    /// Whether the restitution is asked for or returned exactly.
    pub restitution_rule: RestitutionRule,
    /// Restitution (-); `None`: that of the gap's own law.
    pub restitution: Option<f64>,
    /// Approach velocity of the reference collision (m/s); `None`: the maximum that the
    /// gap's own law meets under the records.
    pub approach_velocity: Option<f64>,
    /// Threads.
    pub threads: usize,
}

/// One model.
#[derive(Debug, Clone)]
pub struct ComparedModel {
    /// The model's descriptor.
    pub descriptor: &'static ModelDescriptor,
    /// Calibrated for each gap, or why it cannot be.
    pub calibrated: Result<Vec<CalibratedModel>, String>,
    /// Its run under each record, or why that failed.
    pub records: Vec<Result<ModelRun, String>>,
}

/// One model under one record.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelRun {
    /// Values in the order of [`Comparison::quantities`]; NaN where one has no meaning.
    pub values: Vec<f64>,
    /// Peaks of each building and storey.
    pub storeys: Vec<Vec<StoreyPeaks>>,
    /// Amplification of each building and storey, as a gap check computes it; that of
    /// the acceleration is NaN where impacts were jumps of the velocity.
    pub amplification: Vec<Vec<Amplification>>,
    /// Impacts of each gap and level.
    pub impacts: Vec<Vec<usize>>,
}

impl Stored for ModelRun {
    fn to_numbers(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.values.len() as f64);
        numbers.extend(&self.values);
        numbers.push(self.storeys.len() as f64);
        for building in &self.storeys {
            numbers.push(building.len() as f64);
            for s in building {
                let peaks = [s.displacement, s.drift_ratio, s.storey_shear];
                let peaks = peaks.into_iter().chain([s.acceleration_absolute]);
                numbers.extend(peaks.flat_map(|peak| [peak.value, peak.time]));
            }
        }
        Amplification::to_numbers(&self.amplification, numbers);
        numbers.push(self.impacts.len() as f64);
        for gap in &self.impacts {
            numbers.push(gap.len() as f64);
            numbers.extend(gap.iter().map(|n| *n as f64));
        }
    }

    fn from_numbers(numbers: &mut Numbers<'_>) -> Option<Self> {
        let peak = |numbers: &mut Numbers<'_>| {
            let (value, time) = (numbers.take()?, numbers.take()?);
            Some(Peak { value, time })
        };
        let storey = |numbers: &mut Numbers<'_>| {
            let mut storey = StoreyPeaks::default();
            storey.displacement = peak(numbers)?;
            storey.drift_ratio = peak(numbers)?;
            storey.storey_shear = peak(numbers)?;
            storey.acceleration_absolute = peak(numbers)?;
            Some(storey)
        };
        Some(Self {
            values: numbers.list(Numbers::take)?,
            storeys: numbers.list(|numbers| numbers.list(storey))?,
            amplification: Amplification::from_numbers(numbers)?,
            impacts: numbers.list(|numbers| numbers.list(|n| Some(n.take()? as usize)))?,
        })
    }
}

impl ComparedModel {
    /// Whether it ran under every record.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        self.records.iter().all(Result::is_ok)
    }

    /// The first reason why it did not.
    #[must_use]
    pub fn diagnosis(&self) -> Option<&str> {
        self.records
            .iter()
            .find_map(|r| r.as_ref().err())
            .map(String::as_str)
    }
}

/// The whole comparison.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// What was asked for.
    pub options: ComparisonOptions,
    /// The collision that models are calibrated in, for each gap.
    pub references: Vec<ReferenceCollision>,
    /// Names of the records under which all buildings stand without contact.
    pub records: Vec<String>,
    /// Records under which a building collapses without contact: no model has anything to change
    /// there, and they are left out of all else.
    pub collapsed: Vec<CollapsedRecord>,
    /// What a gap check finds under each record, with the gaps' own laws.
    pub own: Vec<RecordDemand>,
    /// Contact levels of each gap.
    pub levels: Vec<Vec<GapLevel>>,
    /// Gaps of each building: those beside it, and beside all that links join it with.
    pub gaps_of_buildings: Vec<Vec<usize>>,
    /// A building that each link joins: contacts that reach it reach the link.
    pub buildings_of_links: Vec<usize>,
    /// What is compared.
    pub quantities: Vec<Quantity>,
    /// Values without pounding for each record, in the order of `quantities`; NaN for
    /// those of gaps.
    pub isolated: Vec<Vec<f64>>,
    /// The models, those that failed among them.
    pub models: Vec<ComparedModel>,
    /// Spread of each quantity over the models that ran under every record.
    pub spreads: Vec<Spread>,
    /// Order of these models in each quantity; numbers are those of `models`.
    pub rankings: Vec<Ranking>,
    /// What holds for all these models, and what does not.
    pub conclusions: Vec<Conclusion>,
    /// Storeys at which pounding raises a peak although it does not raise the maximum over
    /// the storeys, or the reverse: a gap check answers storey by storey.
    pub storey_differences: Vec<StoreyDifference>,
    /// Levels that models close although the demand of a gap check does not, or the
    /// reverse.
    pub level_differences: Vec<LevelDifference>,
    /// What the user should know of the case.
    pub warnings: Vec<String>,
}

/// Compares models on a case under records, made by
/// [`crate::gap_check::under_records`].
///
/// # Errors
/// A case without gaps, unknown models, a gap whose own law gives nothing to calibrate
/// to, own runs that fail, or buildings that collapse without contact under every record. Models
/// that fail are kept with their diagnosis.
pub fn compare(
    case: &Case,
    records: &[CaseUnderRecord],
    options: &ComparisonOptions,
    progress: Progress<'_>,
) -> Result<Comparison, CheckError> {
    compare_dealt(case, records, options, (progress, &Deal::All))
}

/// The same with the runs of the models dealt out to several processes.
///
/// # Errors
/// As [`compare`], and [`CheckError::Shards`].
pub fn compare_dealt(
    case: &Case,
    records: &[CaseUnderRecord],
    options: &ComparisonOptions,
    (progress, deal): (Progress<'_>, &Deal),
) -> Result<Comparison, CheckError> {
    let first = records.first().ok_or(CheckError::NoGap)?;
    let system = &first.assembly.system;
    if system.gaps().is_empty() {
        return Err(CheckError::NoGap);
    }
    let descriptors = descriptors(&options.models)?;
    let (looked_at, total) = (records.len(), records.len() * (1 + descriptors.len()));
    let tell = |done, _| progress(done, total);
    let (own, collapsed) = stand_or_collapse(records, options.threads, &tell)?;
    let (asked_for, records) = (records, &*without_collapsed(records, &collapsed));
    let total = looked_at + descriptors.len() * records.len();
    let wanted = (options.restitution, options.approach_velocity);
    let references = references(case, &records[0].assembly.system, &own, wanted)?;
    let rules = (options.stiffness_rule, options.restitution_rule);
    let mut models: Vec<ComparedModel> =
        in_parallel(descriptors.len(), options.threads, UNWATCHED, |i| {
            let gaps = references.iter();
            ComparedModel {
                descriptor: descriptors[i],
                calibrated: gaps
                    .map(|reference| calibrated(descriptors[i], reference, rules))
                    .collect(),
                records: Vec::new(),
            }
        })?;
    let quantities = quantities::of_system(system);
    let tell = |done, _| progress(looked_at + done, total);
    let count = models.len() * records.len();
    let asked = ComparisonOptions {
        // Nothing depends on it.
        threads: 0,
        ..options.clone()
    };
    let identity = || identity("compare", &asked, case, asked_for);
    let runs = deal.runs(
        identity,
        count,
        (options.threads, &tell),
        |number, ending| {
            let model = &models[number / records.len()];
            let record = number % records.len();
            let isolated = &own[record].isolated;
            one(model, &records[record], isolated, &quantities, ending)
        },
    )?;
    let mut runs = runs.into_iter();
    for model in &mut models {
        model.records = runs.by_ref().take(records.len()).collect();
    }
    let isolated = own.iter().map(|r| isolated(&quantities, &r.isolated));
    let gaps = system.gaps().iter();
    let names: Vec<&str> = records.iter().map(|r| r.name.as_str()).collect();
    let copies = Repeated::among(records).warnings(&names);
    let mut warnings = warnings(case, records);
    warnings.extend(unequal_levels(case));
    warnings.extend(undamped(system, &references));
    warnings.extend(untouched(system, &references));
    warnings.extend(slow(system, &references, &models));
    warnings.extend(copies);
    let mut comparison = Comparison {
        options: options.clone(),
        references,
        records: records.iter().map(|r| r.name.clone()).collect(),
        collapsed,
        isolated: isolated.collect(),
        own,
        levels: gaps.map(|gap| levels(system, gap)).collect(),
        gaps_of_buildings: gaps_of_buildings(system),
        buildings_of_links: buildings_of_links(system),
        quantities,
        models,
        spreads: Vec::new(),
        rankings: Vec::new(),
        conclusions: Vec::new(),
        storey_differences: Vec::new(),
        level_differences: Vec::new(),
        warnings,
    };
    comparison.sum_up();
    Ok(comparison)
}

/// Gaps whose own law has other parameters at other levels.
fn unequal_levels(case: &Case) -> Vec<String> {
    let gaps = case.gaps.iter();
    let unequal = gaps.filter(|gap| gap.parameters.iter().any(|p| !p.is_one()));
    let told = unequal.map(|gap| {
        format!(
            "gap {}: its levels have different parameters; every compared model has at all levels those that follow from the level that is hit fastest, also {} itself",
            gap.name, gap.model.value
        )
    });
    told.collect()
}

/// Gaps whose columns without mass take elastic laws alone, at a restitution of one, where models
/// with damping have none.
fn undamped(system: &System, references: &[ReferenceCollision]) -> Vec<String> {
    let gaps = system.gaps().iter().zip(references);
    let without = gaps.filter(|(gap, reference)| {
        let mut levels = system.levels_of(gap).iter();
        reference.restitution >= 1.0 && levels.any(|l| l.model.spring_behind().is_some())
    });
    let told = without.map(|(gap, _)| {
        format!(
            "gap {}: the columns that are hit have no mass, so that contacts are elastic, and models with damping are compared at restitution 1 without it; `contact_mass` in `column` lets their damping act",
            gap.name
        )
    });
    told.collect()
}

/// Gaps that the own law closes under no record, so that nothing is known of a collision there.
fn untouched(system: &System, references: &[ReferenceCollision]) -> Vec<String> {
    let gaps = system.gaps().iter().zip(references);
    let untouched = gaps.filter(|(_, reference)| reference.of_other_gaps);
    let told = untouched.map(|(gap, reference)| {
        format!(
            "gap {}: nothing touches it with the own law, and its reference collision has the maximum approach of the other gaps, {} m/s; `--approach-velocity` gives another one",
            gap.name,
            significant(reference.approach_velocity)
        )
    });
    told.collect()
}

/// Gaps whose reference collision is slower than what laws divide by at least: it is calibrated as
/// runs are, and the restitution that is asked for is that of faster ones.
fn slow(
    system: &System,
    references: &[ReferenceCollision],
    models: &[ComparedModel],
) -> Vec<String> {
    let divide = models.iter().map(|m| m.descriptor);
    let divide = divide.filter(|d| d.divides_by_approach_velocity());
    let names: Vec<&str> = divide.map(|d| d.name).collect();
    let gaps = system.gaps().iter().zip(references);
    let slow = gaps.filter(|(_, r)| r.approach_velocity < APPROACH_VELOCITY_FLOOR);
    let told = slow.map(|(gap, reference)| {
        format!(
            "gap {}: the reference approach of {} mm/s lies below 1 mm/s, the least that laws divide by: at it these are damped less, and return more, than they are asked for, as in the runs: {}",
            gap.name,
            significant(1.0e3 * reference.approach_velocity),
            names.join(", ")
        )
    });
    told.filter(|_| !names.is_empty()).collect()
}

/// Gaps from which contacts reach each building: those beside it, and beside buildings that links
/// join it with.
fn gaps_of_buildings(system: &System) -> Vec<Vec<usize>> {
    let buildings = system.buildings();
    let place = |name: &String| buildings.iter().position(|b| b.name() == name);
    let mut group: Vec<usize> = (0..buildings.len()).collect();
    for link in system.links() {
        if let [Some(left), Some(right)] = [0, 1].map(|side| place(&link.between[side])) {
            let (from, to) = (group[right], group[left]);
            group
                .iter_mut()
                .filter(|g| **g == from)
                .for_each(|g| *g = to);
        }
    }
    let beside = |building: usize| {
        let gaps = system.gaps().iter().enumerate();
        let beside = gaps.filter(|(_, gap)| {
            let mut sides = gap.between.iter().filter_map(place);
            sides.any(|side| group[side] == group[building])
        });
        beside.map(|(index, _)| index).collect()
    };
    (0..buildings.len()).map(beside).collect()
}

/// A building that each link joins; none joins two walls.
fn buildings_of_links(system: &System) -> Vec<usize> {
    let buildings = system.buildings();
    let joined = system.links().iter().filter_map(|link| {
        let joins = |name: &str| link.between.iter().any(|side| side == name);
        buildings.iter().position(|b| joins(b.name()))
    });
    joined.collect()
}

impl Comparison {
    /// Numbers of the models that ran under every record.
    #[must_use]
    pub fn complete(&self) -> Vec<usize> {
        let all = 0..self.models.len();
        all.filter(|m| self.models[*m].is_complete()).collect()
    }

    /// Models (by number) that bring a building to collapse, with the record (by number) and the
    /// building. They have no peaks: conclusions are drawn from the other models.
    #[must_use]
    pub fn collapses(&self) -> Vec<(usize, usize, &str)> {
        let models = self.models.iter().enumerate();
        let runs = models.flat_map(|(m, model)| {
            let records = model.records.iter().enumerate();
            records.map(move |(r, run)| (m, r, run))
        });
        runs.filter_map(|(m, r, run)| {
            let building = collapsed_building(run.as_ref().err()?)?;
            Some((m, r, building))
        })
        .collect()
    }

    /// Value of a quantity; NaN where a model failed or it has no meaning.
    #[must_use]
    pub fn value(&self, model: usize, record: usize, quantity: usize) -> f64 {
        let run = self.models[model].records[record].as_ref();
        run.map_or(f64::NAN, |run| run.values[quantity])
    }

    /// Whether impacts of a model were jumps of the velocity under some record: it has then
    /// neither an acceleration nor a force there.
    #[must_use]
    pub fn has_rigid_impacts(&self, model: usize) -> bool {
        let of_acceleration = |q: &Quantity| q.kind == QuantityKind::AccelerationAbsolute;
        let place = self.quantities.iter().position(of_acceleration);
        let mut runs = self.models[model].records.iter().flatten();
        place.is_some_and(|q| runs.any(|run| run.values[q].is_nan()))
    }

    /// Ratio of a quantity of a building to that without pounding (-): of the maxima over
    /// the storeys. One where both are the same.
    #[must_use]
    pub fn ratio_of_maxima(&self, model: usize, record: usize, quantity: usize) -> f64 {
        ratio(
            self.value(model, record, quantity),
            self.isolated[record][quantity],
        )
    }

    /// How many of the models that ran under every record close a gap under this one.
    #[must_use]
    pub fn models_in_contact(&self, gap: usize, record: usize) -> usize {
        let complete = self.complete();
        let closes = |m: &&usize| {
            let run = self.models[**m].records[record].as_ref();
            run.is_ok_and(|run| run.impacts[gap].iter().any(|n| *n > 0))
        };
        complete.iter().filter(closes).count()
    }

    /// Records under which none of these models closes a gap: its contacts have no force
    /// there, and spreads and rankings leave it out. None where no model ran under every record.
    #[must_use]
    pub fn records_without_contact(&self, gap: usize) -> Vec<usize> {
        let records = 0..self.records.len();
        let without = |r: &usize| self.models_in_contact(gap, *r) == 0;
        let none = self.complete().is_empty();
        records.filter(|r| !none && without(r)).collect()
    }

    /// Records under which no contact reaches a building with any of these models: its peaks are
    /// those without pounding there, and the spread between models and the ranking leave it out. None where no model
    /// ran under every record.
    #[must_use]
    pub fn records_not_reaching(&self, building: usize) -> Vec<usize> {
        let reached = |record: &usize| {
            let mut gaps = self.gaps_of_buildings[building].iter();
            gaps.any(|gap| self.models_in_contact(*gap, *record) > 0)
        };
        let records = 0..self.records.len();
        let none = self.complete().is_empty();
        records.filter(|r| !none && !reached(r)).collect()
    }

    fn sum_up(&mut self) {
        let complete = self.complete();
        let buildings = 0..self.gaps_of_buildings.len();
        let not_reached: Vec<_> = buildings.map(|b| self.records_not_reaching(b)).collect();
        for quantity in 0..self.quantities.len() {
            let left_out = match &self.quantities[quantity] {
                q if q.is_of_building() => not_reached[q.index].as_slice(),
                q if q.is_of_link() => not_reached[self.buildings_of_links[q.index]].as_slice(),
                _ => &[],
            };
            let of_model = |m: &usize| -> Vec<f64> {
                let records = 0..self.records.len();
                records.map(|r| self.value(*m, r, quantity)).collect()
            };
            let values: Vec<Vec<f64>> = complete.iter().map(of_model).collect();
            let mut ranking = spread::ranking(&values, left_out);
            for place in &mut ranking.order {
                *place = complete[*place];
            }
            self.spreads.push(spread::spread(&values, left_out));
            self.rankings.push(ranking);
        }
        self.conclusions = conclusions::draw(self);
        self.storey_differences = differences::of_storeys(self);
        self.level_differences = differences::of_levels(self);
    }
}

/// Ratio of two peaks; 1 where they are the same.
fn ratio(with: f64, isolated: f64) -> f64 {
    if with == isolated {
        1.0
    } else {
        with / isolated
    }
}

fn isolated(quantities: &[Quantity], isolated: &[BuildingOutcome]) -> Vec<f64> {
    let value = |q: &Quantity| {
        if q.is_of_building() {
            quantities::of_building(q.kind, &isolated[q.index])
        } else {
            f64::NAN
        }
    };
    quantities.iter().map(value).collect()
}

/// One model under one record.
fn one(
    model: &ComparedModel,
    record: &CaseUnderRecord,
    isolated: &[BuildingOutcome],
    quantities: &[Quantity],
    ending: &mut dyn Recorder,
) -> Result<ModelRun, String> {
    let calibrated = model.calibrated.as_ref().map_err(Clone::clone)?;
    let laws: Vec<Arc<dyn ImpactModel>> = calibrated.iter().map(|c| Arc::clone(&c.model)).collect();
    let system = rebuilt(&record.assembly.system, |gap, level| {
        (level.width, Arc::clone(&laws[gap]))
    });
    let system = system.map_err(|e| e.to_string())?;
    let outcome = run(
        &system,
        &record.assembly.options,
        &mut [ending],
        &mut |_| {},
    );
    let outcome = outcome.map_err(|e| e.to_string())?;
    let rigid = laws.iter().any(|l| l.rigid_restitution().is_some());
    let jumps = quantities::jumps(&outcome, rigid);
    let values = quantities.iter().map(|q| {
        // What round-off leaves of the zero of an elastic law is none.
        let energy = q.kind == QuantityKind::ImpactEnergy;
        match energy && calibrated[q.index].is_elastic() {
            true => 0.0,
            false => quantities::value(q, &outcome, jumps),
        }
    });
    let values = values.collect();
    let mut amplification = amplification(&outcome.buildings, isolated);
    for storey in amplification.iter_mut().flatten() {
        *storey = storey.one_where_nothing_moves();
        if jumps {
            storey.acceleration_absolute = f64::NAN;
        }
    }
    let gaps = outcome.gaps.iter();
    Ok(ModelRun {
        values,
        storeys: outcome
            .buildings
            .iter()
            .map(|b| b.storeys.clone())
            .collect(),
        amplification,
        impacts: gaps
            .map(|g| g.levels.iter().map(|l| l.impacts).collect())
            .collect(),
    })
}
