//! What holds for every model, and what hangs on it.

use super::{Comparison, QuantityKind};

/// How far a statement holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// For all models under all records.
    Always,
    /// For no model under any record.
    Never,
    /// For all models under some records and for none under the others: it hangs on the
    /// record alone.
    ByRecord,
    /// It hangs on the model.
    ByModel,
}

impl Holds {
    /// In words.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Always => "holds for all models",
            Self::Never => "fails for all models",
            Self::ByRecord => "hangs on the record, not on the model",
            Self::ByModel => "hangs on the model",
        }
    }
}

/// A statement held against every model and record.
#[derive(Debug, Clone, PartialEq)]
pub struct Conclusion {
    /// The statement.
    pub statement: String,
    /// How far it holds.
    pub holds: Holds,
    /// For each record: models for which it is true, and models that can say.
    pub counts: Vec<(usize, usize)>,
    /// For each record: numbers of the models in the minority.
    pub dissenters: Vec<Vec<usize>>,
}

/// All statements about a comparison, over its complete models.
pub(super) fn draw(comparison: &Comparison) -> Vec<Conclusion> {
    let mut conclusions = Vec::new();
    let kinds = [
        QuantityKind::Displacement,
        QuantityKind::StoreyShear,
        QuantityKind::AccelerationAbsolute,
    ];
    for (q, quantity) in comparison.quantities.iter().enumerate() {
        if kinds.contains(&quantity.kind) {
            let words = match quantity.kind {
                QuantityKind::Displacement => "displacement",
                QuantityKind::StoreyShear => "storey shear",
                _ => "absolute acceleration",
            };
            let statement = format!("pounding raises the peak {words} of {}", quantity.of);
            conclusions.push(judged(comparison, statement, |model, record| {
                comparison.value(model, record, q) - comparison.isolated[record][q]
            }));
        }
        if quantity.kind == QuantityKind::Impacts {
            let statement = format!("{} is closed", quantity.of);
            conclusions.push(judged(comparison, statement, |model, record| {
                comparison.value(model, record, q)
            }));
        }
    }
    conclusions.extend(hardest_hit(comparison));
    conclusions
}

/// Which of two neighbours has the greater amplification of acceleration.
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
            judged(comparison, statement, |model, record| {
                let amplified =
                    |q: usize| comparison.value(model, record, q) / comparison.isolated[record][q];
                amplified(pair[0]) - amplified(pair[1])
            })
        })
        .collect()
}

/// Holds a statement, true where `positive` is above zero, against models and records. A
/// model for which it is NaN says nothing.
fn judged(
    comparison: &Comparison,
    statement: String,
    positive: impl Fn(usize, usize) -> f64,
) -> Conclusion {
    let models = comparison.complete();
    let (mut counts, mut dissenters) = (Vec::new(), Vec::new());
    for record in 0..comparison.records.len() {
        let (mut yes, mut no) = (Vec::new(), Vec::new());
        for &model in &models {
            let x = positive(model, record);
            if x > 0.0 {
                yes.push(model);
            } else if !x.is_nan() {
                no.push(model);
            }
        }
        counts.push((yes.len(), yes.len() + no.len()));
        dissenters.push(if yes.len() < no.len() { yes } else { no });
    }
    Conclusion {
        statement,
        holds: holds(&counts),
        counts,
        dissenters,
    }
}

fn holds(counts: &[(usize, usize)]) -> Holds {
    let split = |&(yes, all): &(usize, usize)| yes > 0 && yes < all;
    if counts.iter().any(split) {
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
    }
}
