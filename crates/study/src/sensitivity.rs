//! On which variables the values of runs hang: the parts of their variance that each explains by itself.

use pounding_ground_motion::distributions::beta_quantile;

/// Runs that estimates need at least.
const LEAST_RUNS: usize = 40;
/// Runs for each piece of a mean over a variable, and most pieces.
const RUNS_OF_PIECE: usize = 15;
const MOST_PIECES: usize = 12;
/// Probability with which chance explains less than what is said of it.
const BY_CHANCE: f64 = 0.95;

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
    /// The part (-) of the variance that each input explains by itself; NaN for one that has a single value,
    /// where it has about as many as there are runs, and for all where a grid lacks values.
    pub first_order: Vec<f64>,
    /// What chance alone explains of an estimate at most, with a probability of 95 %; zero where nothing is estimated.
    pub by_chance: Vec<f64>,
    /// Whether runs are all combinations of their inputs.
    pub is_grid: bool,
    /// Whether those of them that have a value are not. Inputs go together in what is left, so that the parts that they
    /// explain overlap, and no part is known.
    pub lacks_values: bool,
    /// Values that are not finite and left out.
    pub left_out: usize,
    /// The part (-) that none explains by itself, where runs with a value are all combinations.
    pub combinations: Option<f64>,
}

/// The sensitivity of values to inputs; values that are not finite are left out. `None` for fewer than 40 others that
/// are not all combinations, for values that are all one, and for a single input, which explains all.
///
/// Runs of all combinations give the indices of their inputs exactly; where some have no value, only if the others are all
/// combinations of what is left of the inputs. Those of samples are estimated from a mean that
/// is linear between quantiles of the input (of an input of few values, from the mean of each), less what chance alone
/// explains (Ezekiel, J. Am. Stat. Assoc. 24 (1929) 99; Kelley, Proc. Natl. Acad. Sci. 21 (1935) 554). Where the same random
/// numbers stand in every combination of other inputs, those of the numbers are estimated from the means over the
/// combinations, of which there must be 40, and those of the others are exact.
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
        .filter(|input| groups(input, &known).len() > 1);
    // Less than round-off is no variance.
    let is_one = (all / count).sqrt() <= 1.0e-12 * size;
    let rows: Vec<usize> = (0..values.len()).collect();
    let is_grid = is_grid(inputs, &rows);
    if !is_grid && known.len() < LEAST_RUNS || is_one || varying.count() < 2 {
        return None;
    }
    if is_grid && known.len() < values.len() && !self::is_grid(inputs, &known) {
        return Some(Sensitivity {
            first_order: vec![f64::NAN; inputs.len()],
            by_chance: vec![0.0; inputs.len()],
            is_grid,
            lacks_values: true,
            left_out: values.len() - known.len(),
            combinations: None,
        });
    }
    let sets = match is_grid {
        true => None,
        false => sets(inputs, &known),
    };
    let explained = inputs.iter().map(|input| {
        let groups = groups(input, &known);
        let is_exact = is_grid || sets.as_ref().is_some_and(|sets| sets.cross(&groups));
        if is_exact && groups.len() > 1 {
            // What the other inputs do is the same in every group.
            return ((1.0 - within_groups(values, &groups) / all).max(0.0), 0.0);
        }
        match sets.as_ref().filter(|sets| sets.fix(input)) {
            Some(sets) => {
                let (means, points) = sets.means(values, input);
                let of_sets = Input {
                    values: &points,
                    are_choices: input.are_choices,
                };
                let rows: Vec<usize> = (0..means.len()).collect();
                let (part, chance) = estimated(&means, &of_sets, &rows);
                let between = 1.0 - within_groups(values, &sets.runs) / all;
                (part * between, chance * between)
            }
            None => estimated(values, input, &known),
        }
    });
    let (first_order, by_chance): (Vec<f64>, Vec<f64>) = explained.unzip();
    let explained: f64 = first_order.iter().filter(|part| part.is_finite()).sum();
    Some(Sensitivity {
        combinations: is_grid.then(|| (1.0 - explained).max(0.0)),
        first_order,
        by_chance,
        is_grid,
        lacks_values: false,
        left_out: values.len() - known.len(),
    })
}

/// The part of the variance of values that an input explains by estimation, and what chance alone explains at most; of
/// these rows. NaN for an input of one value or about as many as rows, and of too few rows.
fn estimated(values: &[f64], input: &Input<'_>, rows: &[usize]) -> (f64, f64) {
    let groups = groups(input, rows);
    let count = rows.len() as f64;
    let pieces = (rows.len() / RUNS_OF_PIECE).clamp(2, MOST_PIECES);
    let few = input.are_choices || groups.len() <= pieces + 1;
    if groups.len() < 2 || rows.len() < LEAST_RUNS {
        return (f64::NAN, 0.0);
    }
    let (rest, parameters) = match few {
        true => (within_groups(values, &groups), groups.len()),
        false => beside_pieces(values, input.values, &groups, pieces),
    };
    if 2 * parameters > rows.len() {
        return (f64::NAN, 0.0);
    }
    let all = within_groups(values, &[rows.to_vec()]);
    let free = count - parameters as f64;
    let corrected = |rest: f64| (1.0 - rest * (count - 1.0) / free).max(0.0);
    let parts = [0.5 * (parameters as f64 - 1.0), 0.5 * free];
    let chance = corrected(1.0 - beta_quantile(parts[0], parts[1], BY_CHANCE));
    // Values that are all one are explained by nothing.
    let part = if all > 0.0 {
        corrected(rest / all)
    } else {
        0.0
    };
    (part, chance)
}

/// Runs of the same random numbers: those of a grid with samples are made in every combination of the other variables,
/// and tell of these numbers no more than one of them would.
struct Sets {
    runs: Vec<Vec<usize>>,
}

/// The sets of random numbers in runs, if these are repeated: runs in which one of the numbers is the same, where others
/// are the same then, too, the other numbers or the record.
fn sets(inputs: &[Input<'_>], runs: &[usize]) -> Option<Sets> {
    let is_set = |(i, input): (usize, &Input<'_>)| {
        let sets = Sets {
            runs: groups(input, runs),
        };
        let count = sets.runs.len();
        let varies = |other: &Input<'_>| groups(other, runs).len() > 1;
        let others = inputs.iter().enumerate().filter(|(j, _)| *j != i);
        let mut fixed = others.filter(|(_, other)| varies(other) && sets.fix(other));
        let is_repeated = !input.are_choices && count > 1 && count < runs.len();
        (is_repeated && fixed.next().is_some()).then_some(sets)
    };
    let found = inputs.iter().enumerate().filter_map(is_set);
    found.max_by_key(|sets| sets.runs.len())
}

impl Sets {
    /// Whether an input has one value in each set.
    fn fix(&self, input: &Input<'_>) -> bool {
        let same = |set: &Vec<usize>| {
            set.windows(2)
                .all(|pair| input.values[pair[0]] == input.values[pair[1]])
        };
        self.runs.iter().all(same)
    }

    /// Whether each group has as many runs of every set as its size asks for.
    fn cross(&self, groups: &[Vec<usize>]) -> bool {
        let last = groups.iter().flatten().copied().max().unwrap_or(0);
        let mut set_of = vec![0; last + 1];
        for (number, set) in self.runs.iter().enumerate() {
            set.iter().for_each(|run| set_of[*run] = number);
        }
        let size = |group: &Vec<usize>| group.len() / self.runs.len();
        groups.iter().all(|group| {
            let mut counts = vec![0; self.runs.len()];
            group.iter().for_each(|run| counts[set_of[*run]] += 1);
            counts.iter().all(|count| *count == size(group))
        })
    }

    /// The mean of the values in each set, and what the input is there.
    fn means(&self, values: &[f64], input: &Input<'_>) -> (Vec<f64>, Vec<f64>) {
        let of_set = |set: &Vec<usize>| {
            let mean = set.iter().map(|run| values[*run]).sum::<f64>() / set.len() as f64;
            (mean, input.values[set[0]])
        };
        self.runs.iter().map(of_set).unzip()
    }
}

/// Whether runs are all combinations of the values of their inputs, each as often as its values: a value may stand
/// twice.
fn is_grid(inputs: &[Input<'_>], runs: &[usize]) -> bool {
    let groups: Vec<Vec<Vec<usize>>> = inputs.iter().map(|input| groups(input, runs)).collect();
    let mut sizes = groups.iter().map(Vec::len);
    let Some(product) = sizes.try_fold(1_usize, usize::checked_mul) else {
        return false;
    };
    if product > runs.len() {
        return false;
    }
    let last = runs.iter().copied().max().unwrap_or(0);
    // Runs with the same value, for every input and run.
    let equal: Vec<Vec<usize>> = groups
        .iter()
        .map(|groups| {
            let mut equal = vec![0; last + 1];
            for group in groups {
                group.iter().for_each(|run| equal[*run] = group.len());
            }
            equal
        })
        .collect();
    let bits = |run: &usize| -> Vec<u64> {
        // Zero has two signs.
        let values = inputs.iter().map(|input| input.values[*run] + 0.0);
        values.map(f64::to_bits).collect()
    };
    let mut points: Vec<(Vec<u64>, usize)> = runs.iter().map(|run| (bits(run), *run)).collect();
    points.sort_unstable();
    let same: Vec<&[(Vec<u64>, usize)]> = points.chunk_by(|a, b| a.0 == b.0).collect();
    let count = runs.len() as f64;
    let as_often = |point: &&[(Vec<u64>, usize)]| {
        let shares = equal.iter().map(|equal| equal[point[0].1] as f64 / count);
        let expected = count * shares.product::<f64>();
        (expected - point.len() as f64).abs() < 1.0e-6 * expected
    };
    same.len() == product && same.iter().all(as_often)
}

/// Runs with the same value of an input, in its order.
fn groups(input: &Input<'_>, runs: &[usize]) -> Vec<Vec<usize>> {
    let mut order = runs.to_vec();
    order.sort_by(|a, b| input.values[*a].total_cmp(&input.values[*b]));
    let same = order.chunk_by(|a, b| input.values[*a] == input.values[*b]);
    same.map(<[usize]>::to_vec).collect()
}

/// The sum of squares of what lies beside the means of groups.
fn within_groups(values: &[f64], groups: &[Vec<usize>]) -> f64 {
    let within = groups.iter().map(|rows| {
        let mean = rows.iter().map(|i| values[*i]).sum::<f64>() / rows.len() as f64;
        let squares = rows
            .iter()
            .map(|i| (values[*i] - mean) * (values[*i] - mean));
        squares.sum::<f64>()
    });
    within.sum()
}

/// The sum of squares of what lies beside a mean over an input that is linear between so many of its quantiles, fitted
/// by least squares, and the number of its parameters.
fn beside_pieces(
    values: &[f64],
    input: &[f64],
    groups: &[Vec<usize>],
    pieces: usize,
) -> (f64, usize) {
    let order: Vec<usize> = groups.concat();
    let last = order.len() - 1;
    let mut knots: Vec<f64> = (0..=pieces)
        .map(|k| input[order[k * last / pieces]])
        .collect();
    knots.dedup();
    let size = knots.len();
    // Of a run the knot before it, and the part of the way to the next.
    let place = |x: f64| {
        let next = knots.partition_point(|knot| *knot <= x).clamp(1, size - 1);
        let (from, to) = (knots[next - 1], knots[next]);
        (next - 1, (x - from) / (to - from))
    };
    // Normal equations of hat functions, of which two overlap at most.
    let (mut diagonal, mut beside, mut right) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
    for run in &order {
        let (k, part) = place(input[*run]);
        let (here, next) = (1.0 - part, part);
        diagonal[k] += here * here;
        diagonal[k + 1] += next * next;
        beside[k] += here * next;
        right[k] += here * values[*run];
        right[k + 1] += next * values[*run];
    }
    for k in 1..size {
        let factor = beside[k - 1] / diagonal[k - 1];
        diagonal[k] -= factor * beside[k - 1];
        right[k] -= factor * right[k - 1];
    }
    let mut at_knots = vec![0.0; size];
    for k in (0..size).rev() {
        let after = if k + 1 < size {
            beside[k] * at_knots[k + 1]
        } else {
            0.0
        };
        at_knots[k] = (right[k] - after) / diagonal[k];
    }
    let squares = order.iter().map(|run| {
        let (k, part) = place(input[*run]);
        let rest = values[*run] - at_knots[k] - part * (at_knots[k + 1] - at_knots[k]);
        rest * rest
    });
    (squares.sum(), size)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    /// Random numbers that are repeated in each of twenty combinations tell no more than they do once: 10 sets give no
    /// estimate, 200 the indices of `x` (3/4 of its variance with `y`, 1/4) beside a third number that does nothing, and what is
    /// crossed with them is exact. With records of 100 sets each the record is told from chance, too.
    #[test]
    fn repeated_numbers_count_once() {
        let unit = |set: usize, of: u64| crate::mixing::unit(&[11, set as u64, of]) - 0.5;
        for records in [1, 2] {
            for sets in [10, 200] {
                let (mut x, mut y, mut z, mut gap, mut record, mut values) =
                    (vec![], vec![], vec![], vec![], vec![], vec![]);
                for of in 0..records {
                    for set in of * sets / records..(of + 1) * sets / records {
                        for width in 0..20 {
                            x.push(unit(set, 0));
                            y.push(unit(set, 1));
                            z.push(unit(set, 2));
                            gap.push(f64::from(width));
                            record.push(of as f64);
                            values.push(3.0_f64.sqrt() * unit(set, 0) + unit(set, 1));
                        }
                    }
                }
                let inputs = [
                    number(&x),
                    number(&y),
                    number(&z),
                    number(&gap),
                    Input {
                        values: &record,
                        are_choices: true,
                    },
                ];
                let found = sensitivity(&values, &inputs).unwrap();
                let [of_x, of_y, of_z] = [0, 1, 2].map(|i| found.first_order[i]);
                if sets == 10 {
                    assert!(of_x.is_nan() && of_y.is_nan() && of_z.is_nan(), "{found:?}");
                } else {
                    assert!((of_x - 0.75).abs() < 0.08, "{found:?}");
                    assert!((of_y - 0.25).abs() < 0.12, "{found:?}");
                    assert!(of_z < found.by_chance[2].max(0.05), "{found:?}");
                }
                assert!(found.first_order[3] < 1e-12 && found.by_chance[3] == 0.0);
                if records == 2 && sets == 200 {
                    let by_chance = found.by_chance[4];
                    assert!(
                        found.first_order[4] < by_chance && by_chance > 0.005,
                        "{found:?}"
                    );
                }
            }
        }
    }

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

    /// Pure chance explains no more than is said of it.
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
        for (part, chance) in found.first_order.iter().zip(&found.by_chance) {
            assert!(part < chance && (0.03..0.06).contains(chance), "{found:?}");
        }
    }
    const PI_PART: f64 = 0.141_592_653_589_793;

    /// What one input alone decides is all its own, however few runs there are, skewed as it may be: in proportion to
    /// it to round-off, with a kink or a bend but for what lies between the quantiles.
    #[test]
    fn one_input_alone_explains_all() {
        for count in [40, 50, 100, 1000] {
            let column = |k: f64| -> Vec<f64> {
                (0..count)
                    .map(|i| (0.5 / f64::from(count) + f64::from(i) * k).fract())
                    .collect()
            };
            let even = column(0.618_033_988_749_894_9);
            let useless = column(2.0_f64.sqrt());
            let skewed: Vec<f64> = even.iter().map(|x| libm::exp(6.0 * (x - 0.5))).collect();
            let part = |values: &[f64], input: &[f64]| {
                let found = sensitivity(values, &[number(input), number(&useless)]).unwrap();
                assert!(
                    found.first_order[1] <= found.by_chance[1] + 0.05,
                    "{count}: {found:?}"
                );
                assert_eq!(found.combinations, None);
                found.first_order[0]
            };
            let of = |function: &dyn Fn(f64) -> f64, input: &[f64]| {
                let values: Vec<f64> = input.iter().map(|x| function(*x)).collect();
                part(&values, input)
            };
            assert!((of(&|x| 3.0 - 2.0 * x, &even) - 1.0).abs() < 1e-12);
            assert!((of(&|x| 5.0 * x, &skewed) - 1.0).abs() < 1e-12);
            assert!(of(&|x| (x - 0.5).abs(), &even) > 0.9, "{count}");
            // Few pieces do not follow a peak of resonance.
            let least = if count < 100 { 0.5 } else { 0.9 };
            let peak = of(&|x| 1.0 / (0.02 + (x - 0.6) * (x - 0.6)), &even);
            assert!(peak > least, "{count}: {peak}");
        }
    }

    /// A value that stands twice counts twice, and a grid without all runs of one value is a grid.
    #[test]
    fn grids_with_a_value_twice_and_with_gaps() {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for x in [1.0, 3.0, 1.0, 2.0] {
            for y in 0..10 {
                a.push(x);
                b.push(f64::from(y));
            }
        }
        let values: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + 0.5 * b).collect();
        let inputs = [number(&a), number(&b)];
        let found = sensitivity(&values, &inputs).unwrap();
        // Variances by hand: 11/16 of 1, 3, 1, 2 and 33/16 of 0 to 4.5.
        assert!((found.first_order[0] - 0.25).abs() < 1e-14, "{found:?}");
        assert!((found.first_order[1] - 0.75).abs() < 1e-14, "{found:?}");
        assert!(found.combinations.unwrap() < 1e-14);
        // A whole value of `a` fails: what is left is in proportion to `b` alone.
        let mut gaps: Vec<f64> = b.clone();
        for (value, x) in gaps.iter_mut().zip(&a) {
            if *x == 3.0 {
                *value = f64::NAN;
            }
        }
        let found = sensitivity(&gaps, &inputs).unwrap();
        assert!(found.is_grid && !found.lacks_values && found.left_out == 10);
        assert!((found.first_order[1] - 1.0).abs() < 1e-14, "{found:?}");
        assert!(found.combinations.unwrap() < 1e-14);
    }

    /// Three of nine runs stand: greatest and least of one input at the greatest of the other. Means over what is left would
    /// explain 96 and 44 % of the variance, more than there is.
    #[test]
    fn a_grid_that_lacks_values_tells_no_parts() {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for x in 0..3 {
            for y in 0..3 {
                a.push(f64::from(x));
                b.push(f64::from(y));
            }
        }
        let mut values = vec![f64::NAN; 9];
        (values[3], values[6], values[7]) = (824.4, 1040.0, 1867.0);
        let inputs = [number(&a), number(&b)];
        let found = sensitivity(&values, &inputs).unwrap();
        assert!(found.is_grid && found.lacks_values);
        assert!(
            found.first_order.iter().all(|part| part.is_nan()),
            "{found:?}"
        );
        assert_eq!((found.left_out, found.combinations), (6, None));
        // With one run missing among many as well.
        let mut most: Vec<f64> = a.iter().zip(&b).map(|(a, b)| a + 2.0 * b).collect();
        most[4] = f64::INFINITY;
        assert!(sensitivity(&most, &inputs).unwrap().lacks_values);
    }

    #[test]
    fn what_has_no_sensitivity() {
        let count: Vec<f64> = (0..60).map(f64::from).collect();
        let ones = vec![1.0; 60];
        let half: Vec<f64> = (0..60).map(|i| f64::from(i % 2)).collect();
        let two = [number(&count), number(&half)];
        assert_eq!(sensitivity(&ones, &two), None);
        assert_eq!(
            sensitivity(&count[..39], &[number(&half[..39]), number(&count[..39])]),
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
