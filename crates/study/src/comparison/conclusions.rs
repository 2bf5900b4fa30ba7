//! What holds for every model, and what depends on it.

use super::{Comparison, QuantityKind};
use crate::gap_check::{Amplification, SAME};

/// How far a statement holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// For all models under all records.
    Always,
    /// For no model under any record.
    Never,
    /// For all models under some records and for none under the others: it depends
    /// on the record only.
    ByRecord,
    /// It depends on the model.
    ByModel,
    /// No model can say it under any record: rigid impacts have no accelerations, and models that did not run
    /// under every record say nothing.
    Unknown,
}

impl Holds {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Always => "holds for all models",
            Self::Never => "fails for all models",
            Self::ByRecord => "depends on the record, not on the model",
            Self::ByModel => "depends on the model",
            Self::Unknown => "no model can say",
        }
    }
}

/// Whether pounding raises a peak that it brings to this ratio of that without pounding,
/// by more than two computations of one number differ.
pub(super) fn raised(ratio: f64) -> bool {
    ratio > 1.0 + SAME
}

/// A statement held against every model and record.
#[derive(Debug, Clone, PartialEq)]
pub struct Conclusion {
    /// The statement.
    pub statement: String,
    /// What its peaks are: how one value comes from the storeys.
    pub statistic: &'static str,
    /// The answer.
    pub judgement: Judgement,
    /// The answer storey by storey, as a gap check gives it: whether the statement holds
    /// at some storey, or for the maximum amplification of a storey. `None` for
    /// statements that are not about storeys.
    pub by_storey: Option<Judgement>,
}

/// For which models and records a statement is true.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// How far it holds.
    pub holds: Holds,
    /// For each record: models for which it is true, and models that can say.
    pub counts: Vec<(usize, usize)>,
    /// For each record: numbers of the models in the minority.
    pub dissenters: Vec<Vec<usize>>,
    /// For each record: the least and the greatest ratio of a peak with pounding to that
    /// without, over the models that can say: how far those are apart that do not agree.
    /// `None` where none can, and for statements that are not about one such ratio.
    pub ratios: Vec<Option<(f64, f64)>>,
}

/// All statements about a comparison, over its complete models.
pub(super) fn draw(comparison: &Comparison) -> Vec<Conclusion> {
    let mut conclusions = Vec::new();
    let kinds = [
        QuantityKind::Displacement,
        QuantityKind::StoreyShear,
        QuantityKind::AccelerationAbsolute,
        QuantityKind::Ductility,
        QuantityKind::BaseMoment,
    ];
    for (q, quantity) in comparison.quantities.iter().enumerate() {
        if kinds.contains(&quantity.kind) {
            let words = match quantity.kind {
                QuantityKind::Displacement => "displacement",
                QuantityKind::StoreyShear => "storey shear",
                QuantityKind::BaseMoment => "overturning moment",
                QuantityKind::Ductility => "ductility",
                _ => "absolute acceleration",
            };
            let amplification = quantity.kind.amplification();
            conclusions.push(Conclusion {
                statement: format!("pounding raises the peak {words} of {}", quantity.of),
                statistic: quantity.statistic(),
                judgement: raises(comparison, |model, record| {
                    comparison.ratio_of_maxima(model, record, q)
                }),
                by_storey: amplification.map(|of| {
                    raises(comparison, |model, record| {
                        most(comparison, model, record, quantity.index, of)
                    })
                }),
            });
        }
        if quantity.kind == QuantityKind::Impacts {
            conclusions.push(Conclusion {
                statement: format!("{} is closed", quantity.of),
                statistic: "at some level",
                judgement: judged(comparison, |model, record| {
                    truth(comparison.value(model, record, q), |impacts| impacts > 0.0)
                }),
                by_storey: None,
            });
        }
    }
    conclusions.extend(hardest_hit(comparison));
    conclusions
}

/// Which of two neighbours has the larger amplification of acceleration.
fn hardest_hit(comparison: &Comparison) -> Vec<Conclusion> {
    let accelerations: Vec<usize> = (0..comparison.quantities.len())
        .filter(|q| comparison.quantities[*q].kind == QuantityKind::AccelerationAbsolute)
        .collect();
    let pairs = accelerations.windows(2);
    pairs
        .map(|pair| {
            let of = |q: usize| &comparison.quantities[q].of;
            let statement = format!(
                "pounding amplifies the acceleration of {} more than that of {}",
                of(pair[0]),
                of(pair[1])
            );
            let more = |x: f64| x > 0.0;
            let kind = QuantityKind::AccelerationAbsolute;
            Conclusion {
                statement,
                statistic: "ratio of the maxima over storeys",
                judgement: judged(comparison, |model, record| {
                    let amplified = |q: usize| comparison.ratio_of_maxima(model, record, q);
                    truth(amplified(pair[0]) - amplified(pair[1]), more)
                }),
                by_storey: kind.amplification().map(|quantity| {
                    judged(comparison, |model, record| {
                        let building = |q: usize| comparison.quantities[q].index;
                        let amplified =
                            |q: usize| most(comparison, model, record, building(q), quantity);
                        truth(amplified(pair[0]) - amplified(pair[1]), more)
                    })
                }),
            }
        })
        .collect()
}

/// Whether a number fulfils a condition; `None` for NaN, which says nothing.
fn truth(x: f64, condition: impl Fn(f64) -> bool) -> Option<bool> {
    (!x.is_nan()).then(|| condition(x))
}

/// Maximum amplification over the storeys of a building; NaN where it has no meaning.
fn most(
    comparison: &Comparison,
    model: usize,
    record: usize,
    building: usize,
    quantity: fn(&Amplification) -> f64,
) -> f64 {
    let run = comparison.models[model].records[record].as_ref();
    run.map_or(f64::NAN, |run| {
        let storeys = run.amplification[building].iter().map(quantity);
        storeys.fold(f64::NAN, f64::max)
    })
}

/// Holds against all models and records that pounding raises a peak, by its ratio to that
/// without.
fn raises(comparison: &Comparison, ratio: impl Fn(usize, usize) -> f64) -> Judgement {
    let models = comparison.complete();
    let range = |record: usize| {
        let ratios = models.iter().map(|model| ratio(*model, record));
        let mut known = ratios.filter(|ratio| !ratio.is_nan());
        let first = known.next()?;
        Some(known.fold((first, first), |(least, most), ratio| {
            (least.min(ratio), most.max(ratio))
        }))
    };
    let judgement = judged(comparison, |model, record| {
        truth(ratio(model, record), raised)
    });
    Judgement {
        ratios: (0..comparison.records.len()).map(range).collect(),
        ..judgement
    }
}

/// Holds a statement about a model and a record against all of them; `None` says nothing.
fn judged(comparison: &Comparison, holds_for: impl Fn(usize, usize) -> Option<bool>) -> Judgement {
    let models = comparison.complete();
    let (mut counts, mut dissenters) = (Vec::new(), Vec::new());
    for record in 0..comparison.records.len() {
        let (mut yes, mut no) = (Vec::new(), Vec::new());
        for &model in &models {
            match holds_for(model, record) {
                Some(true) => yes.push(model),
                Some(false) => no.push(model),
                None => {}
            }
        }
        counts.push((yes.len(), yes.len() + no.len()));
        dissenters.push(if yes.len() < no.len() { yes } else { no });
    }
    Judgement {
        holds: holds(&counts),
        ratios: vec![None; counts.len()],
        counts,
        dissenters,
    }
}

fn holds(counts: &[(usize, usize)]) -> Holds {
    let split = |&(yes, all): &(usize, usize)| yes > 0 && yes < all;
    if counts.iter().all(|(_, all)| *all == 0) {
        Holds::Unknown
    } else if counts.iter().any(split) {
        Holds::ByModel
    } else if counts.iter().all(|(yes, all)| yes == all) {
        Holds::Always
    } else if counts.iter().all(|(yes, _)| *yes == 0) {
        Holds::Never
    } else {
        Holds::ByRecord
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_holds() {
        assert_eq!(holds(&[(3, 3), (3, 3)]), Holds::Always);
        assert_eq!(holds(&[(0, 3), (0, 3)]), Holds::Never);
        assert_eq!(holds(&[(0, 3), (3, 3)]), Holds::ByRecord);
        assert_eq!(holds(&[(3, 3), (2, 3)]), Holds::ByModel);
        assert_eq!(holds(&[(0, 0), (0, 0)]), Holds::Unknown);
        assert_eq!(holds(&[(0, 0), (3, 3)]), Holds::Always);
    }
}
