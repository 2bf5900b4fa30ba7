//! The comparison for machines: SI units, full precision.

use std::collections::BTreeMap;

use pounding_study::comparison::{
    self, Comparison, LevelDifference, QuantityKind, ReferenceCollision, StoreyDifference,
};
use pounding_study::gap_check::{CollapsedRecord, collapsed_building};
use pounding_time_history::LevelPlace;
use serde::Serialize;

/// The object that `compare --json` prints.
#[derive(Serialize)]
pub struct Compared<'c> {
    stiffness_rule: &'static str,
    restitution_rule: &'static str,
    references: Vec<Reference>,
    /// Without those under which a building collapses.
    records: &'c [String],
    /// Records under which a building collapses without contact.
    collapsed: &'c [CollapsedRecord],
    warnings: &'c [String],
    models: Vec<Model<'c>>,
    quantities: Vec<Quantity<'c>>,
    gaps: Vec<Gap<'c>>,
    buildings: Vec<Building<'c>>,
    conclusions: Vec<Conclusion<'c>>,
    differences_from_gap: Differences<'c>,
}

impl<'c> Compared<'c> {
    /// All of a comparison.
    pub fn of(c: &'c Comparison) -> Self {
        let storeys = c.storey_differences.iter();
        let levels = c.level_differences.iter();
        Self {
            stiffness_rule: c.options.stiffness_rule.name(),
            restitution_rule: c.options.restitution_rule.name(),
            references: c.references.iter().map(Reference::of).collect(),
            records: &c.records,
            collapsed: &c.collapsed,
            warnings: &c.warnings,
            models: (0..c.models.len()).map(|m| Model::of(c, m)).collect(),
            quantities: (0..c.quantities.len())
                .map(|q| Quantity::of(c, q))
                .collect(),
            gaps: (0..c.levels.len()).map(|g| Gap::of(c, g)).collect(),
            buildings: (0..c.gaps_of_buildings.len())
                .map(|b| Building::of(c, b))
                .collect(),
            conclusions: c.conclusions.iter().map(|x| Conclusion::of(c, x)).collect(),
            differences_from_gap: Differences {
                storeys: storeys.map(|d| Storey::of(c, d)).collect(),
                levels: levels.map(|d| Level::of(c, d)).collect(),
            },
        }
    }
}

/// The collision at which models are made to agree.
#[derive(Serialize)]
struct Reference {
    approach_velocity: f64,
    effective_mass: f64,
    stiffness: f64,
    exponent: f64,
    restitution: f64,
}

impl Reference {
    fn of(r: &ReferenceCollision) -> Self {
        Self {
            approach_velocity: r.approach_velocity,
            effective_mass: r.effective_mass,
            stiffness: r.stiffness,
            exponent: r.exponent,
            restitution: r.restitution,
        }
    }
}

/// Under which records the models close a gap.
#[derive(Serialize)]
struct Gap<'c> {
    name: Option<&'c str>,
    models: usize,
    models_in_contact: Vec<usize>,
    records_without_contact: Vec<&'c str>,
}

impl<'c> Gap<'c> {
    fn of(c: &'c Comparison, index: usize) -> Self {
        let records = 0..c.records.len();
        let without = c.records_without_contact(index);
        Self {
            name: gap_name(c, index),
            models: c.complete().len(),
            models_in_contact: records.map(|r| c.models_in_contact(index, r)).collect(),
            records_without_contact: without.iter().map(|r| c.records[*r].as_str()).collect(),
        }
    }
}

/// Under which records no contact reaches a building.
#[derive(Serialize)]
struct Building<'c> {
    name: Option<&'c str>,
    records_without_contact: Vec<&'c str>,
}

impl<'c> Building<'c> {
    fn of(c: &'c Comparison, index: usize) -> Self {
        let without = c.records_not_reaching(index);
        Self {
            name: c.own.first().map(|r| r.isolated[index].name.as_str()),
            records_without_contact: without.iter().map(|r| c.records[*r].as_str()).collect(),
        }
    }
}

pub(super) fn gap_name(c: &Comparison, index: usize) -> Option<&str> {
    let impacts = |q: &&comparison::Quantity| q.kind == QuantityKind::Impacts && q.index == index;
    c.quantities.iter().find(impacts).map(|q| q.of.as_str())
}

fn names_by_record(c: &Comparison, models: &[Vec<usize>]) -> Vec<Vec<&'static str>> {
    models.iter().map(|m| names(c, m)).collect()
}

fn names(c: &Comparison, models: &[usize]) -> Vec<&'static str> {
    let names = models.iter().map(|m| c.models[*m].descriptor.name);
    names.collect()
}

/// Where models differ from the case's own.
#[derive(Serialize)]
struct Differences<'c> {
    storeys: Vec<Storey<'c>>,
    levels: Vec<Level<'c>>,
}

/// A storey of which models say something else.
#[derive(Serialize)]
struct Storey<'c> {
    building: Option<&'c str>,
    storey: usize,
    quantity: &'static str,
    models: Vec<Vec<&'static str>>,
    models_that_say: &'c [usize],
    amplification_at_storey: (f64, f64),
    ratio_of_maxima: (f64, f64),
    own_law: OwnLaw<'c>,
}

/// What the model of the case says of a storey, by record.
#[derive(Serialize)]
struct OwnLaw<'c> {
    amplification_at_storey: &'c [f64],
    ratio_of_maxima: &'c [f64],
    differs: Vec<bool>,
}

impl<'c> Storey<'c> {
    fn of(c: &'c Comparison, d: &'c StoreyDifference) -> Self {
        let records = 0..c.records.len();
        let first = c.own.first();
        Self {
            building: first.map(|r| r.isolated[d.building].name.as_str()),
            storey: d.storey + 1,
            quantity: d.kind.name(),
            models: names_by_record(c, &d.models),
            models_that_say: &d.models_that_say,
            amplification_at_storey: d.at_storey,
            ratio_of_maxima: d.of_maxima,
            own_law: OwnLaw {
                amplification_at_storey: &d.own_at_storey,
                ratio_of_maxima: &d.own_of_maxima,
                differs: records.map(|r| d.own_differs(r)).collect(),
            },
        }
    }
}

/// A level at which models touch and the demand says otherwise, or the reverse.
#[derive(Serialize)]
struct Level<'c> {
    gap: Option<&'c str>,
    width: f64,
    demand: &'c [f64],
    demand_closes: &'c [bool],
    models_in_contact: Vec<Vec<&'static str>>,
    models: usize,
    own_law_impacts: &'c [usize],
    #[serde(flatten)]
    place: &'c LevelPlace,
}

impl<'c> Level<'c> {
    fn of(c: &'c Comparison, d: &'c LevelDifference) -> Self {
        let level = &c.levels[d.gap][d.level];
        Self {
            gap: gap_name(c, d.gap),
            width: level.width,
            demand: &d.demand,
            demand_closes: &d.demand_closes,
            models_in_contact: names_by_record(c, &d.models),
            models: c.complete().len(),
            own_law_impacts: &d.own_impacts,
            place: &level.place,
        }
    }
}

/// A model as it was calibrated, and where it failed.
#[derive(Serialize)]
struct Model<'c> {
    name: &'static str,
    gaps: Vec<Calibrated<'c>>,
    /// Whether velocities jump at impacts: it has neither accelerations nor contact forces then.
    rigid_impacts: bool,
    failures: Vec<Failed<'c>>,
}

/// A model in one gap.
#[derive(Serialize)]
struct Calibrated<'c> {
    parameters: &'c BTreeMap<String, f64>,
    free_restitution: f64,
    notes: &'c [String],
}

/// A record under which a model failed.
#[derive(Serialize)]
struct Failed<'c> {
    record: &'c str,
    diagnosis: &'c str,
    /// The building that collapsed, if that is why.
    #[serde(skip_serializing_if = "Option::is_none")]
    collapsed: Option<&'c str>,
}

impl<'c> Model<'c> {
    fn of(c: &'c Comparison, index: usize) -> Self {
        let m = &c.models[index];
        let gaps = m.calibrated.iter().flatten().map(|g| Calibrated {
            parameters: &g.parameters.values,
            free_restitution: g.free_restitution,
            notes: &g.notes,
        });
        let runs = c.records.iter().zip(&m.records);
        let failures = runs.filter_map(|(record, run)| {
            let diagnosis = run.as_ref().err()?;
            Some(Failed {
                record,
                diagnosis,
                collapsed: collapsed_building(diagnosis),
            })
        });
        Self {
            name: m.descriptor.name,
            gaps: gaps.collect(),
            rigid_impacts: c.has_rigid_impacts(index),
            failures: failures.collect(),
        }
    }
}

/// A number of every model under every record, and how far they lie apart.
#[derive(Serialize)]
struct Quantity<'c> {
    name: &'static str,
    of: &'c str,
    unit: &'static str,
    statistic: &'static str,
    isolated: Vec<f64>,
    values: Vec<Vec<f64>>,
    spread: Spread,
    ranking: Ranking<'c>,
}

/// How much models differ, and how much records do.
#[derive(Serialize)]
struct Spread {
    between_models: f64,
    between_records: f64,
    /// Models left out of the spread between records, since the quantity is zero in all.
    models_of_zero: usize,
    greatest_ratio: f64,
    records: usize,
    records_left_out: usize,
}

/// The models in their order.
#[derive(Serialize)]
struct Ranking<'c> {
    models: Vec<&'static str>,
    /// Those that share the maximum; none where all models are the same.
    maximum_by: Vec<&'static str>,
    relative: &'c [f64],
    concordance: f64,
}

impl<'c> Quantity<'c> {
    fn of(c: &'c Comparison, q: usize) -> Self {
        let (quantity, spread, ranking) = (&c.quantities[q], &c.spreads[q], &c.rankings[q]);
        let records = 0..c.records.len();
        let of_model = |m: usize| records.clone().map(|r| c.value(m, r, q)).collect();
        Self {
            name: quantity.kind.name(),
            of: &quantity.of,
            unit: quantity.kind.unit(),
            statistic: quantity.statistic(),
            isolated: c.isolated.iter().map(|r| r[q]).collect(),
            values: (0..c.models.len()).map(of_model).collect(),
            spread: Spread {
                between_models: spread.between_models,
                between_records: spread.between_records,
                models_of_zero: spread.models_of_zero,
                greatest_ratio: spread.greatest_ratio,
                records: spread.records,
                records_left_out: c.records.len() - spread.records,
            },
            ranking: Ranking {
                models: names(c, &ranking.order),
                maximum_by: names(c, ranking.at_the_top()),
                relative: &ranking.relative,
                concordance: ranking.concordance,
            },
        }
    }
}

/// A statement, and whether the models agree in it.
#[derive(Serialize)]
struct Conclusion<'c> {
    statement: &'c str,
    statistic: &'static str,
    #[serde(flatten)]
    judgement: Judgement<'c>,
    by_storey: Option<Judgement<'c>>,
}

/// Whether a statement holds, and who says otherwise.
#[derive(Serialize)]
struct Judgement<'c> {
    holds: &'static str,
    counts: &'c [(usize, usize)],
    minority: Vec<Vec<&'static str>>,
    ratios: &'c [Option<(f64, f64)>],
}

impl<'c> Judgement<'c> {
    fn of(c: &Comparison, j: &'c comparison::Judgement) -> Self {
        Self {
            holds: j.holds.name(),
            counts: &j.counts,
            minority: names_by_record(c, &j.dissenters),
            ratios: &j.ratios,
        }
    }
}

impl<'c> Conclusion<'c> {
    fn of(c: &Comparison, x: &'c comparison::Conclusion) -> Self {
        Self {
            statement: &x.statement,
            statistic: x.statistic,
            judgement: Judgement::of(c, &x.judgement),
            by_storey: x.by_storey.as_ref().map(|j| Judgement::of(c, j)),
        }
    }
}
