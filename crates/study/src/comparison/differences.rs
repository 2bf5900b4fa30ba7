//! Where the answer of a comparison differs from that of a gap check. A comparison takes
//! the maximum of a peak over the storeys of a building, a gap check the ratio at every
//! storey: pounding can raise the peaks of some storeys and not their maximum. A comparison
//! says whether a gap closes, a gap check at which levels the isolated buildings would close
//! it.

use super::conclusions::raised;
use super::{Comparison, QuantityKind, quantities, ratio};
use crate::gap_check::Amplification;

/// A storey at which the answer to "does pounding raise this peak?" differs from that for
/// the maximum over the storeys, for some model, or the gaps' own law, under some record.
#[derive(Debug, Clone, PartialEq)]
pub struct StoreyDifference {
    /// Building, from zero.
    pub building: usize,
    /// Storey, from zero.
    pub storey: usize,
    /// The peak.
    pub kind: QuantityKind,
    /// For each record: the models for which the answers differ.
    pub models: Vec<Vec<usize>>,
    /// For each record: how many models have both answers.
    pub models_that_say: Vec<usize>,
    /// For each record: amplification at the storey with the gaps' own laws, as a gap
    /// check gives it (-).
    pub own_at_storey: Vec<f64>,
    /// For each record: ratio of the maxima over the storeys with these laws (-).
    pub own_of_maxima: Vec<f64>,
    /// Minimum and maximum amplification at the storey, over the models and records whose
    /// answers differ (-); NaN where these are of the gaps' own laws only.
    pub at_storey: (f64, f64),
    /// Minimum and maximum ratio of the maxima over the storeys, over the same (-).
    pub of_maxima: (f64, f64),
}

impl StoreyDifference {
    /// Whether the answers differ with the gaps' own laws under a record.
    #[must_use]
    pub fn own_differs(&self, record: usize) -> bool {
        differ(self.own_at_storey[record], self.own_of_maxima[record]) == Some(true)
    }
}

/// A level that models close under some record where the demand of the isolated buildings
/// stays below its width, or leave open where it does not.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelDifference {
    /// Gap, from zero.
    pub gap: usize,
    /// Level, from zero.
    pub level: usize,
    /// For each record: demand of the isolated buildings (m).
    pub demand: Vec<f64>,
    /// For each record: whether the demand closes the level.
    pub demand_closes: Vec<bool>,
    /// For each record: the models that close it.
    pub models: Vec<Vec<usize>>,
    /// For each record: impacts with the gaps' own laws.
    pub own_impacts: Vec<usize>,
}

/// Whether two ratios answer differently; `None` where one says nothing.
fn differ(at_storey: f64, of_maxima: f64) -> Option<bool> {
    let silent = at_storey.is_nan() || of_maxima.is_nan();
    (!silent).then(|| raised(at_storey) != raised(of_maxima))
}

fn widen(range: &mut (f64, f64), x: f64) {
    *range = (range.0.min(x), range.1.max(x));
}

/// All storeys with differing answers, in the order of the quantities.
pub(super) fn of_storeys(comparison: &Comparison) -> Vec<StoreyDifference> {
    let mut all = Vec::new();
    for (q, quantity) in comparison.quantities.iter().enumerate() {
        let Some(of) = quantity.kind.amplification() else {
            continue;
        };
        let own: Vec<_> = (0..comparison.records.len())
            .map(|r| own_ratios(comparison, q, r, of))
            .collect();
        let storeys = own.first().map_or(0, |(storeys, _)| storeys.len());
        let found = (0..storeys).map(|storey| {
            let own = own.iter();
            let own = own.map(|(storeys, maxima)| (storeys[storey], *maxima));
            of_storey(comparison, (q, of), storey, own.unzip())
        });
        let some = |d: &StoreyDifference| {
            let records = 0..comparison.records.len();
            let mut differing = records.filter(|r| !d.models[*r].is_empty() || d.own_differs(*r));
            differing.next().is_some()
        };
        all.extend(found.filter(some));
    }
    all
}

/// Amplification at every storey and ratio of the maxima, with the gaps' own laws.
fn own_ratios(
    comparison: &Comparison,
    q: usize,
    record: usize,
    of: fn(&Amplification) -> f64,
) -> (Vec<f64>, f64) {
    let (quantity, own) = (&comparison.quantities[q], &comparison.own[record]);
    let storeys = own.amplification().unwrap_or_default();
    let with = own.pounding.as_ref().map_or(f64::NAN, |(buildings, _)| {
        quantities::of_building(quantity.kind, &buildings[quantity.index])
    });
    let storeys = storeys.get(quantity.index);
    let of = |a: &Amplification| of(&a.one_where_nothing_moves());
    (
        storeys.map_or_else(Vec::new, |s| s.iter().map(of).collect()),
        ratio(with, comparison.isolated[record][q]),
    )
}

fn of_storey(
    comparison: &Comparison,
    (q, of): (usize, fn(&Amplification) -> f64),
    storey: usize,
    (own_at_storey, own_of_maxima): (Vec<f64>, Vec<f64>),
) -> StoreyDifference {
    let quantity = &comparison.quantities[q];
    let complete = comparison.complete();
    let none = (f64::NAN, f64::NAN);
    let mut difference = StoreyDifference {
        building: quantity.index,
        storey,
        kind: quantity.kind,
        models: Vec::new(),
        models_that_say: Vec::new(),
        own_at_storey,
        own_of_maxima,
        at_storey: none,
        of_maxima: none,
    };
    for record in 0..comparison.records.len() {
        let (mut models, mut say) = (Vec::new(), 0);
        for &model in &complete {
            let Ok(run) = &comparison.models[model].records[record] else {
                continue;
            };
            let at_storey = of(&run.amplification[quantity.index][storey]);
            let of_maxima = comparison.ratio_of_maxima(model, record, q);
            let Some(differs) = differ(at_storey, of_maxima) else {
                continue;
            };
            say += 1;
            if differs {
                models.push(model);
                widen(&mut difference.at_storey, at_storey);
                widen(&mut difference.of_maxima, of_maxima);
            }
        }
        difference.models.push(models);
        difference.models_that_say.push(say);
    }
    difference
}

/// All levels at which models and demand do not agree.
pub(super) fn of_levels(comparison: &Comparison) -> Vec<LevelDifference> {
    let complete = comparison.complete();
    let mut all = Vec::new();
    for (gap, levels) in comparison.levels.iter().enumerate() {
        for (level, place) in levels.iter().enumerate() {
            let closes = |model: &usize, record: usize| {
                let run = comparison.models[*model].records[record].as_ref();
                run.is_ok_and(|run| run.impacts[gap][level] > 0)
            };
            let own = comparison.own.iter();
            let models: Vec<Vec<usize>> = (0..own.len())
                .map(|r| {
                    let models = complete.iter().copied();
                    models.filter(|m| closes(m, r)).collect()
                })
                .collect();
            let demand_closes: Vec<bool> = own
                .clone()
                .map(|r| r.demand_exceeds(gap, level, place.width))
                .collect();
            let expected = |closed: &bool| if *closed { complete.len() } else { 0 };
            let mut records = demand_closes.iter().zip(&models);
            if records.all(|(closed, models)| models.len() == expected(closed)) {
                continue;
            }
            let impacts = |r: &crate::gap_check::RecordDemand| {
                let gaps = r.pounding.as_ref().map(|(_, gaps)| gaps);
                gaps.map_or(0, |gaps| gaps[gap].levels[level].impacts)
            };
            all.push(LevelDifference {
                gap,
                level,
                demand: own.clone().map(|r| r.demand[gap][level].value).collect(),
                demand_closes,
                models,
                own_impacts: own.map(impacts).collect(),
            });
        }
    }
    all
}
