//! On which variables the values of runs hang: the parts of their variance that each explains by itself.

/// Runs that are needed at least.
const LEAST_RUNS: usize = 20;
/// Runs in a part of the range of a variable, and most parts: fewer would be chance.
const RUNS_OF_PART: usize = 20;
const MOST_PARTS: usize = 24;

/// What a variable was in every run.
#[derive(Debug, Clone, Copy)]
pub struct Input<'r> {
    /// Its numbers, or those of its choices.
    pub values: &'r [f64],
    /// Whether they are choices, between which nothing lies.
    pub are_choices: bool,
}

/// First-order sensitivity indices `V(E(y | x_i)) / V(y)` of values over runs (Saltelli et al., Global Sensitivity
/// Analysis, 2008, eq. 1.10), which are Pearson's correlation ratios (1905).
#[derive(Debug, Clone, PartialEq)]
pub struct Sensitivity {
    /// The part (-) of the variance that each input explains by itself; NaN for one that has a single value, and
    /// where it has about as many as there are runs.
    pub first_order: Vec<f64>,
    /// The part (-) that none explains by itself, of runs that are all combinations of their inputs.
    pub combinations: Option<f64>,
}

/// The sensitivity of values to inputs; values that are not finite are left out. `None` for fewer than 20 others,
/// for values that are all one, and for a single input, which explains all.
///
/// Runs of all combinations give the indices of their inputs exactly. Those of samples are estimated from the
/// means in parts of equal count of each range, less what chance alone puts between them (Kelley, Proc. Natl.
/// Acad. Sci. 21 (1935) 554).
#[must_use]
pub fn sensitivity(values: &[f64], inputs: &[Input<'_>]) -> Option<Sensitivity> {
    let known: Vec<usize> = (0..values.len())
        .filter(|i| values[*i].is_finite())
        .collect();
    let count = known.len() as f64;
    let mean = known.iter().map(|i| values[*i]).sum::<f64>() / count;
    let size = known
        .iter()
        .fold(0.0_f64, |most, i| most.max(values[*i].abs()));
    let square = |x: f64| (x - mean) * (x - mean);
    let all: f64 = known.iter().map(|i| square(values[*i])).sum();
    let varying = inputs
        .iter()
        .filter(|input| groups(input, &known, usize::MAX).len() > 1);
    // Less than round-off is no variance.
    let is_one = (all / count).sqrt() <= 1.0e-12 * size;
    if known.len() < LEAST_RUNS || is_one || varying.count() < 2 {
        return None;
    }
    let is_grid = known.len() == values.len() && is_grid(inputs, &known);
    let parts = match is_grid {
        true => usize::MAX,
        false => (known.len() / RUNS_OF_PART).clamp(2, MOST_PARTS),
    };
    let first_order = inputs.iter().map(|input| {
        let groups = groups(input, &known, parts);
        if groups.len() < 2 || (!is_grid && 2 * groups.len() > known.len()) {
            return f64::NAN;
        }
        let between = groups.iter().map(|rows| {
            let count = rows.len() as f64;
            let of_group = rows.iter().map(|i| values[*i]).sum::<f64>() / count;
            count * square(of_group)
        });
        let between: f64 = between.sum();
        if is_grid {
            return between / all;
        }
        let free = (groups.len() - 1) as f64;
        let within = (all - between) / (count - groups.len() as f64);
        ((between - free * within) / all).max(0.0)
    });
    let first_order: Vec<f64> = first_order.collect();
    let explained: f64 = first_order.iter().filter(|part| part.is_finite()).sum();
    Some(Sensitivity {
        combinations: is_grid.then(|| (1.0 - explained).max(0.0)),
        first_order,
    })
}

/// Whether runs are all combinations of the values of their inputs, each once.
fn is_grid(inputs: &[Input<'_>], runs: &[usize]) -> bool {
    let mut sizes = inputs
        .iter()
        .map(|input| groups(input, runs, usize::MAX).len());
    let product = sizes.try_fold(1_usize, usize::checked_mul);
    if product != Some(runs.len()) {
        return false;
    }
    let bits = |run: &usize| -> Vec<u64> {
        inputs
            .iter()
            .map(|input| input.values[*run].to_bits())
            .collect()
    };
    let mut points: Vec<Vec<u64>> = runs.iter().map(bits).collect();
    points.sort_unstable();
    points.dedup();
    points.len() == runs.len()
}

/// Runs with the same value of an input, or in the same part of its range, if it has more values than so many.
fn groups(input: &Input<'_>, runs: &[usize], parts: usize) -> Vec<Vec<usize>> {
    let mut order = runs.to_vec();
    order.sort_by(|a, b| input.values[*a].total_cmp(&input.values[*b]));
    let same = order.chunk_by(|a, b| input.values[*a] == input.values[*b]);
    let same: Vec<Vec<usize>> = same.map(<[usize]>::to_vec).collect();
    if input.are_choices || same.len() <= parts {
        return same;
    }
    // Of equal values none goes to another part than the others.
    let size = order.len().div_ceil(parts);
    let mut groups: Vec<Vec<usize>> = vec![Vec::new()];
    for equal in same {
        match groups.last_mut() {
            Some(group) if group.len() < size => group.extend(equal),
            _ => groups.push(equal),
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn number(values: &[f64]) -> Input<'_> {
        Input {
            values,
            are_choices: false,
        }
    }

    /// By hand: `3 a + b + a b` on -1, 0, 1 times -1, 0, 1 has the variances 6, 2/3 and 4/9, together 64/9.
    #[test]
    fn all_combinations_are_exact() {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        // Thrice, told apart by an input that does nothing.
        let mut c = Vec::new();
        for third in [0.0, 1.0, 2.0] {
            for x in [-1.0, 0.0, 1.0] {
                for y in [-1.0, 0.0, 1.0] {
                    a.push(x);
                    b.push(y);
                    c.push(third);
                }
            }
        }
        let values: Vec<f64> = a.iter().zip(&b).map(|(a, b)| 3.0 * a + b + a * b).collect();
        let inputs = [&a, &b, &c].map(|values| number(values));
        let found = sensitivity(&values, &inputs).unwrap();
        let expected = [54.0 / 64.0, 6.0 / 64.0, 0.0];
        for (x, y) in found.first_order.iter().zip(expected) {
            assert!((x - y).abs() < 1e-14, "{found:?}");
        }
        assert!((found.combinations.unwrap() - 4.0 / 64.0).abs() < 1e-14);
    }

    /// The function of Ishigami and Homma (1990) with a = 7 and b = 0.1: 0.3139, 0.4424 and 0 (Saltelli et al.
    /// 2008, section 4.9), estimated from 4096 points of a Kronecker sequence.
    #[test]
    fn samples_are_near_the_published_indices() {
        use std::f64::consts::PI;
        let count = 4096;
        // Fractional parts of multiples of powers of the inverse plastic number in three dimensions.
        let root = 1.220_744_084_605_759_5_f64;
        let columns = [1, 2, 3].map(|power| {
            let step = root.powi(-power);
            let points = (0..count).map(|i| 2.0 * PI * (i as f64 * step).fract() - PI);
            points.collect::<Vec<f64>>()
        });
        let [x, y, z] = &columns;
        let value = |i: usize| {
            let (a, b) = (libm::sin(x[i]), libm::sin(y[i]));
            a + 7.0 * b * b + 0.1 * z[i].powi(4) * a
        };
        let values: Vec<f64> = (0..count).map(value).collect();
        let inputs = columns.each_ref().map(|values| number(values));
        let found = sensitivity(&values, &inputs).unwrap();
        for (x, y) in found.first_order.iter().zip([0.3139, 0.4424, 0.0]) {
            assert!((x - y).abs() < 0.02, "{found:?}");
        }
        assert_eq!(found.combinations, None);
    }

    /// Pure chance explains nothing: without its correction ten parts would explain 5 % of 200 runs.
    #[test]
    fn chance_explains_nothing() {
        let step = 0.618_033_988_749_894_9_f64;
        let column =
            |k: f64| -> Vec<f64> { (0..200).map(|i| (f64::from(i) * k).fract()).collect() };
        let (a, b) = (column(step), column(2.0_f64.sqrt()));
        // A sequence that neither follows.
        let values: Vec<f64> = (0..200)
            .map(|i| (f64::from(i * i) * PI_PART).fract())
            .collect();
        let found = sensitivity(&values, &[number(&a), number(&b)]).unwrap();
        assert!(found.first_order.iter().all(|x| *x < 0.06), "{found:?}");
    }
    const PI_PART: f64 = 0.141_592_653_589_793;

    #[test]
    fn what_has_no_sensitivity() {
        let count: Vec<f64> = (0..30).map(f64::from).collect();
        let ones = vec![1.0; 30];
        let half: Vec<f64> = (0..30).map(|i| f64::from(i % 2)).collect();
        let two = [number(&count), number(&half)];
        assert_eq!(sensitivity(&ones, &two), None);
        assert_eq!(
            sensitivity(&count[..10], &[number(&half[..10]), number(&count[..10])]),
            None
        );
        assert_eq!(sensitivity(&count, &[number(&half), number(&ones)]), None);
        // As many choices as runs say nothing.
        let choices = Input {
            values: &count,
            are_choices: true,
        };
        let found = sensitivity(&count, &[choices, number(&half)]).unwrap();
        assert!(found.first_order[0].is_nan() && found.first_order[1] < 0.1);
        // Values that are not known are left out.
        let mut gaps = half.clone();
        gaps[3] = f64::NAN;
        gaps[4] = f64::INFINITY;
        let found = sensitivity(&gaps, &two).unwrap();
        assert!((found.first_order[1] - 1.0).abs() < 1e-12, "{found:?}");
    }
}
