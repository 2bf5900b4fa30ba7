//! Spread between models beside spread between records, and the order of the models.

use crate::gap_check::SAME;

/// Spread of one quantity. A value without meaning (NaN) is left out wherever it stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Standard deviation over mean between models, root mean square over records (-).
    pub between_models: f64,
    /// The same between records, root mean square over models (-); NaN with one record. A model
    /// whose values are all zero, or zero but for round-off beside those of others, has none.
    pub between_records: f64,
    /// Models left out of the spread between records since theirs are zero.
    pub models_of_zero: usize,
    /// Maximum over minimum between models, of the record where that is a maximum
    /// (-); NaN where a smallest value is zero, or zero but for round-off.
    pub greatest_ratio: f64,
    /// Records under which some model has a value that is not zero, and those of a building under
    /// which a contact reaches it: those that the spread between models is over. Where all are zero, as the impacts under a record without contact, there is
    /// no spread: zero over zero.
    pub records: usize,
}

/// The order of the models in one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Numbers of the models, maximum value first. Records under which no model has a value, or
    /// none that is not zero, are left out, then models without a value under one of the others.
    pub order: Vec<usize>,
    /// Mean over records of value over the mean of the models (-), in that order.
    pub relative: Vec<f64>,
    /// Agreement of the records on the order (-), 0 to 1: Kendall's W (Kendall and
    /// Babington Smith, Annals of Mathematical Statistics 10 (1939) 275), ties with mean
    /// ranks; NaN with one record or one model. Records under which all models are the same are none.
    pub concordance: f64,
}

impl Ranking {
    /// Numbers of the models that share the maximum; none where all models are the same.
    #[must_use]
    pub fn at_the_top(&self) -> &[usize] {
        let most = self.relative.first().copied().unwrap_or_default();
        let tied = self.relative.iter().take_while(|x| same(most, **x)).count();
        match tied == self.order.len() {
            true => &[],
            false => &self.order[..tied],
        }
    }
}

/// Whether two values differ by no more than two computations of one number.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// Part of the maximum value below which another is zero but for round-off.
const ROUND_OFF: f64 = 1.0e-9;

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Standard deviation (with `n - 1`) over mean; `None` for fewer than two values, and where all
/// are zero.
fn variation(values: &[f64]) -> Option<f64> {
    if values.len() < 2 || values.iter().all(|x| *x == 0.0) {
        return None;
    }
    let mean = mean(values);
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    Some((squares / (values.len() - 1) as f64).sqrt() / mean)
}

fn root_mean_square(values: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.map(|x| x * x).collect();
    mean(&squares).sqrt()
}

/// Finite values of one record, over models.
fn of_record(values: &[Vec<f64>], record: usize) -> Vec<f64> {
    let column = values.iter().map(|m| m[record]);
    column.filter(|x| x.is_finite()).collect()
}

/// What round-off leaves of a zero among these values at most.
fn round_off(values: &[Vec<f64>]) -> f64 {
    let finite = values.iter().flatten().filter(|x| x.is_finite());
    ROUND_OFF * finite.fold(0.0_f64, |m, x| m.max(x.abs()))
}

/// Whether there is nothing but zeros, or what round-off leaves of them.
fn is_zero(values: &[f64], round_off: f64) -> bool {
    values.iter().all(|x| x.abs() <= round_off)
}

/// Spread of `values[model][record]`; that between models without the records that are left out.
pub(super) fn spread(values: &[Vec<f64>], left_out: &[usize]) -> Spread {
    let records = values.first().map_or(0, Vec::len);
    let round_off = round_off(values);
    let counted = (0..records).filter(|r| !left_out.contains(r));
    let columns = counted.map(|r| of_record(values, r));
    let columns: Vec<Vec<f64>> = columns.filter(|c| !is_zero(c, round_off)).collect();
    let finite = |row: &Vec<f64>| row.iter().copied().filter(|x| x.is_finite()).collect();
    let rows: Vec<Vec<f64>> = values.iter().map(finite).collect();
    let zero = |row: &Vec<f64>| !row.is_empty() && is_zero(row, round_off);
    let (zeros, rows): (Vec<Vec<f64>>, Vec<Vec<f64>>) = rows.into_iter().partition(zero);
    let ratio = |column: &Vec<f64>| {
        let low = column.iter().copied().fold(f64::INFINITY, f64::min);
        let high = column.iter().copied().fold(0.0, f64::max);
        // What round-off leaves of a zero is no value to divide by.
        (column.len() > 1 && low > ROUND_OFF * high).then(|| high / low)
    };
    Spread {
        records: columns.len(),
        between_models: root_mean_square(columns.iter().filter_map(|c| variation(c))),
        between_records: root_mean_square(rows.iter().filter_map(|r| variation(r))),
        models_of_zero: zeros.len(),
        greatest_ratio: columns.iter().filter_map(ratio).fold(f64::NAN, f64::max),
    }
}

/// Order of the models in `values[model][record]` without the records that are left out, unless
/// these are all: then the models are the same.
pub(super) fn ranking(values: &[Vec<f64>], left_out: &[usize]) -> Ranking {
    let records = values.first().map_or(0, Vec::len);
    let round_off = round_off(values);
    let used: Vec<usize> = (0..records)
        .filter(|r| left_out.len() == records || !left_out.contains(r))
        .filter(|r| !is_zero(&of_record(values, *r), round_off))
        .collect();
    let full = |row: &Vec<f64>| !used.is_empty() && used.iter().all(|r| row[*r].is_finite());
    let kept: Vec<usize> = (0..values.len()).filter(|m| full(&values[*m])).collect();
    let column = |r: &usize| -> Vec<f64> { kept.iter().map(|m| values[*m][*r]).collect() };
    let columns = used.iter().map(column);
    // Who had another value under it may be among those left out.
    let columns: Vec<Vec<f64>> = columns.filter(|c| !is_zero(c, round_off)).collect();
    let relative = |place: usize| {
        let ratios = columns.iter().map(|c| c[place] / mean(c));
        mean(&ratios.collect::<Vec<_>>())
    };
    let mut order: Vec<(usize, f64)> = kept
        .iter()
        .enumerate()
        .filter(|_| !columns.is_empty())
        .map(|(place, model)| (*model, relative(place)))
        .collect();
    order.sort_by(|a, b| b.1.total_cmp(&a.1));
    // Of those that are the same the order is that of the models, not of round-off.
    for tied in order.chunk_by_mut(|a, b| same(a.1, b.1)) {
        tied.sort_by_key(|o| o.0);
    }
    Ranking {
        concordance: concordance(&columns),
        order: order.iter().map(|o| o.0).collect(),
        relative: order.iter().map(|o| o.1).collect(),
    }
}

/// Ranks from 1, ties with their mean. Neighbours that are the same are tied.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let (mut ranks, mut below) = (vec![0.0; values.len()], 0);
    for tied in order.chunk_by(|a, b| same(values[*a], values[*b])) {
        for place in tied {
            ranks[*place] = below as f64 + 0.5 * (tied.len() as f64 + 1.0);
        }
        below += tied.len();
    }
    ranks
}

/// Kendall's W with its correction for ties.
fn concordance(columns: &[Vec<f64>]) -> f64 {
    let models = columns.first().map_or(0, Vec::len);
    // A record under which all models are the same has no order to agree on.
    let orders = |ranks: &Vec<f64>| ranks.iter().any(|r| *r != ranks[0]);
    let ranked = columns.iter().map(|c| ranks(c)).filter(orders);
    let ranked: Vec<Vec<f64>> = ranked.collect();
    let judges = ranked.len() as f64;
    if ranked.len() < 2 || models < 2 {
        return f64::NAN;
    }
    let sums: Vec<f64> = (0..models)
        .map(|m| ranked.iter().map(|r| r[m]).sum())
        .collect();
    let centre = mean(&sums);
    let squares: f64 = sums.iter().map(|s| (s - centre).powi(2)).sum();
    let ties: f64 = ranked
        .iter()
        .map(|r| {
            // Each of t equal ranks brings t^2 - 1: together t^3 - t.
            r.iter()
                .map(|x| (r.iter().filter(|y| *y == x).count() as f64).powi(2) - 1.0)
                .sum::<f64>()
        })
        .sum();
    let n = models as f64;
    12.0 * squares / (judges * judges * n * (n * n - 1.0) - judges * ties)
}

#[cfg(test)]
mod tests {
    use super::{Ranking, Spread, concordance};

    fn spread(values: &[Vec<f64>]) -> Spread {
        super::spread(values, &[])
    }

    fn ranking(values: &[Vec<f64>]) -> Ranking {
        super::ranking(values, &[])
    }

    /// Two models of 1 and 3 under a record with contact, both of 5 under two without: the spread is
    /// that of the one record, sqrt(2) / 2, and not sqrt(3) times less. Between the records it is of
    /// all: 5, 5 and 1 have the deviation sqrt(16/3) about 11/3, 5, 5 and 3 sqrt(4/3) about 13/3.
    #[test]
    fn records_that_are_left_out() {
        let values = [vec![5.0, 1.0, 5.0], vec![5.0, 3.0, 5.0]];
        let s = super::spread(&values, &[0, 2]);
        assert!((s.between_models - 0.5_f64.sqrt()).abs() < 1.0e-15);
        assert_eq!((s.records, s.greatest_ratio), (1, 3.0));
        let squares =
            (16.0 / 3.0) * (3.0 / 11.0_f64).powi(2) + (4.0 / 3.0) * (3.0 / 13.0_f64).powi(2);
        assert!((s.between_records - (0.5 * squares).sqrt()).abs() < 1.0e-15);
        let r = super::ranking(&values, &[0, 2]);
        assert_eq!((r.order, r.relative), (vec![1, 0], vec![1.5, 0.5]));
        let same = [vec![5.0, 5.0], vec![5.0, 5.0]];
        let none = super::spread(&same, &[0, 1]);
        assert!(none.between_models.is_nan() && none.records == 0);
        let r = super::ranking(&same, &[0, 1]);
        assert!(r.at_the_top().is_empty() && r.order.len() == 2);
    }

    /// Two models of 1 and 3, records that scale both: deviation sqrt(2) over mean 2 in
    /// each record; between records 1 and 2: sqrt(0.5) over 1.5.
    #[test]
    fn by_hand() {
        let s = spread(&[vec![1.0, 2.0], vec![3.0, 6.0]]);
        assert!((s.between_models - 0.5_f64.sqrt()).abs() < 1.0e-15);
        assert!((s.between_records - 0.5_f64.sqrt() / 1.5).abs() < 1.0e-15);
        assert!((s.greatest_ratio - 3.0).abs() < 1.0e-15);
    }

    /// The energy that an elastic law dissipates is round-off: no ratio to it.
    #[test]
    fn no_ratio_to_round_off() {
        assert!(
            spread(&[vec![1.0e-12], vec![4.0e3]])
                .greatest_ratio
                .is_nan()
        );
    }

    /// Nor has it a spread between records: that is of the other models alone, and how many are
    /// left out is counted. Where all are zero there is no spread.
    #[test]
    fn no_spread_of_round_off() {
        let others = [vec![4.0e3, 5.0e3], vec![2.0e3, 3.0e3]];
        let alone = spread(&others);
        assert_eq!(alone.models_of_zero, 0);
        for zero in [
            vec![1.0e-12, -7.0e-12],
            vec![0.0, 0.0],
            vec![3.0e-6, 1.0e-6],
        ] {
            let found = spread(&[&[zero][..], &others[..]].concat());
            assert_eq!(found.between_records, alone.between_records);
            assert_eq!(found.models_of_zero, 1);
        }
        let none = spread(&[vec![0.0, 0.0], vec![0.0, 0.0]]);
        assert!(none.between_records.is_nan() && none.between_models.is_nan());
        assert_eq!((none.models_of_zero, none.records), (2, 0));
        // Small in one record alone is a value.
        let some = spread(&[vec![1.0e-12, 1.0], vec![1.0, 1.0]]);
        assert_eq!(some.models_of_zero, 0);
    }

    #[test]
    fn values_without_meaning_are_left_out() {
        let s = spread(&[vec![1.0], vec![f64::NAN], vec![3.0]]);
        assert!((s.between_models - 0.5_f64.sqrt()).abs() < 1.0e-15);
        assert!(s.between_records.is_nan());
        let r = ranking(&[vec![1.0], vec![f64::NAN], vec![3.0]]);
        assert_eq!(r.order, [2, 0]);
        assert_eq!(r.relative, [1.5, 0.5]);
        assert!(r.concordance.is_nan());
    }

    /// Six records with contact and one without: the last has no force and no impacts, and neither
    /// spread nor order changes by it. Taken as a record without spread it would make it sqrt(6/7)
    /// of what it is, 8.78 % for 9.48 %.
    #[test]
    fn a_record_without_contact_is_no_record_of_zero_force() {
        let low = 1.0 - 0.094_8 / 2.0_f64.sqrt();
        let six = |x: f64| (1..=6).map(|r| x * f64::from(r)).collect::<Vec<_>>();
        let with = |x: f64, seventh: f64| [six(x), vec![seventh]].concat();
        let other = 2.0 - low;
        let alone = spread(&[six(low), six(other)]);
        assert!(
            (alone.between_models - 0.094_8).abs() < 1.0e-12,
            "{alone:?}"
        );
        assert_eq!(alone.records, 6);
        let seven = [with(low, f64::NAN), with(other, f64::NAN)];
        assert_eq!(spread(&seven), alone);
        let zeros = [with(low, 0.0), with(other, 0.0)];
        let found = spread(&zeros);
        assert_eq!(
            (found.between_models, found.records),
            (alone.between_models, 6)
        );
        assert_eq!(ranking(&zeros), ranking(&seven));
        let ranked = ranking(&seven);
        assert_eq!(ranked, ranking(&[six(low), six(other)]));
        assert_eq!(ranked.order, [1, 0]);
        assert_eq!(ranked.concordance, 1.0);
    }

    /// A building that nobody hits: round-off of the ninth digit makes no order, and there is
    /// nothing that records could agree on.
    #[test]
    fn round_off_is_no_order() {
        let third = 0.079_421_898_307_744;
        let values = [
            vec![third * (1.0 + 2.0e-9), third],
            vec![third, third * (1.0 + 1.0e-9)],
            vec![third * (1.0 + 1.0e-9), third],
        ];
        let found = ranking(&values);
        assert_eq!(found.order, [0, 1, 2]);
        assert!(found.concordance.is_nan(), "{found:?}");
        assert!(found.at_the_top().is_empty());
        let some = ranking(&[&values[..], &[vec![0.02, 0.03]]].concat());
        assert_eq!(some.order, [0, 1, 2, 3]);
        assert_eq!(some.at_the_top(), [0, 1, 2]);
        assert!((some.concordance - 1.0).abs() < 1.0e-15, "{some:?}");
    }

    /// A record of zeros is none, and nor is one under which nobody but a model that is left out, as
    /// it has no value under another, is above zero.
    #[test]
    fn nothing_is_ranked_by_who_is_left_out() {
        let found = ranking(&[vec![0.0, 0.0], vec![0.0, 0.0], vec![3.0, f64::NAN]]);
        assert_eq!(found.order, [2, 0, 1]);
        let values = [vec![0.0, 1.0], vec![0.0, 2.0], vec![3.0, f64::NAN]];
        let found = ranking(&values);
        assert_eq!((found.order, found.relative.len()), (vec![1, 0], 2));
    }

    /// No record with a value: no order.
    #[test]
    fn nothing_to_rank() {
        let none = vec![f64::NAN; 2];
        assert!(ranking(&[none.clone(), none.clone()]).order.is_empty());
        assert_eq!(spread(&[none.clone(), none]).records, 0);
    }

    /// Records that agree: 1. Two that contradict one another: 0. Three judges on three
    /// with ranks 123, 132, 213: sums 4, 6, 8, W = 12 * 8 / (9 * 24) = 4/9.
    #[test]
    fn agreement() {
        let values = |columns: [[f64; 3]; 2]| -> Vec<Vec<f64>> {
            (0..3)
                .map(|m| columns.iter().map(|c| c[m]).collect())
                .collect()
        };
        let same = ranking(&values([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]));
        assert!((same.concordance - 1.0).abs() < 1.0e-15);
        let contrary = ranking(&values([[1.0, 2.0, 3.0], [3.0, 2.0, 1.0]]));
        assert!(contrary.concordance.abs() < 1.0e-15);
        let some = concordance(&[
            vec![1.0, 2.0, 3.0],
            vec![1.0, 3.0, 2.0],
            vec![2.0, 1.0, 3.0],
        ]);
        assert!((some - 4.0 / 9.0).abs() < 1.0e-15, "{some}");
        // One record alone tells the models apart.
        let one = concordance(&[vec![1.0, 1.0, 1.0], vec![5.0, 6.0, 9.0]]);
        assert!(one.is_nan(), "{one}");
        let tied = concordance(&[vec![1.0, 1.0, 2.0], vec![5.0, 5.0, 9.0]]);
        assert!((tied - 1.0).abs() < 1.0e-15, "ties that agree: {tied}");
    }
}
