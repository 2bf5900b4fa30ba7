//! Latin hypercube: a permutation of the shares for every variable.

use crate::mixing::{bits, unit};

/// Rounds of the Feistel network: four make a permutation that polynomially many looks
/// cannot tell from a random one (Luby and Rackoff 1988); a few more cost nothing.
const ROUNDS: u64 = 8;

/// Coordinate, from 0 to 1, of a run in a dimension: somewhere in the share that the
/// permutation of that dimension gives the run.
pub(super) fn coordinate(run: u64, dimension: u64, runs: u64, seed: u64) -> f64 {
    let share = permuted(run, runs, &[seed, dimension]);
    let inside = unit(&[seed, dimension, run, 1]);
    // Rounding must not reach the next share.
    ((share as f64 + inside) / runs as f64).min(next_down((share + 1) as f64 / runs as f64))
}

/// Coordinate of a sample of one of several slices: the samples of each slice are a Latin hypercube, and so are those of
/// all slices together (Qian 2012, J. Am. Stat. Assoc. 107, 393). Numbers from zero.
pub(super) fn sliced_coordinate(
    (slice, slices): (u64, u64),
    (sample, samples): (u64, u64),
    dimension: u64,
    seed: u64,
) -> f64 {
    let coarse = permuted(sample, samples, &[seed, bits(&[dimension, slice, 4])]);
    // Each slice has one of the fine shares in a coarse one.
    let fine = permuted(slice, slices, &[seed, bits(&[dimension, coarse, 5])]);
    let share = coarse * slices + fine;
    let inside = unit(&[seed, dimension, slice, sample, 6]);
    let runs = (slices * samples) as f64;
    ((share as f64 + inside) / runs).min(next_down((share + 1) as f64 / runs))
}

fn next_down(x: f64) -> f64 {
    f64::from_bits(x.to_bits() - 1)
}

/// Where a permutation of 0 to `count - 1` takes `index`: a Feistel network on the next
/// even number of bits, walked along its cycle until it is back in range (Black and
/// Rogaway 2002).
fn permuted(index: u64, count: u64, key: &[u64; 2]) -> u64 {
    let width = (64 - count.saturating_sub(1).leading_zeros()).max(2);
    let half = width.div_ceil(2);
    let mask = (1_u64 << half) - 1;
    let mut x = index;
    loop {
        let (mut left, mut right) = (x >> half, x & mask);
        for round in 0..ROUNDS {
            let next = left ^ (bits(&[key[0], key[1], round, right]) & mask);
            (left, right) = (right, next);
        }
        x = (left << half) | right;
        if x < count {
            return x;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What makes a Latin hypercube: one run in every share of every dimension.
        #[test]
        fn every_share_has_one_run(runs in 1_u64..600, seed: u64, dimension in 0_u64..9) {
            let mut seen = vec![false; runs as usize];
            for run in 0..runs {
                let x = coordinate(run, dimension, runs, seed);
                prop_assert!((0.0..1.0).contains(&x));
                let share = (x * runs as f64).floor() as usize;
                // A product of rounded numbers may round across an edge: look at edges.
                let share = if (share as f64) / runs as f64 > x { share - 1 } else { share };
                prop_assert!(!seen[share], "share {share} has two runs");
                seen[share] = true;
            }
        }
    }

    /// Dimensions and seeds are independent: correlations of 4096 runs stay within five
    /// standard deviations, 5/sqrt(4096).
    #[test]
    fn dimensions_do_not_know_one_another() {
        let column = |dimension, seed| -> Vec<f64> {
            (0..4096)
                .map(|run| coordinate(run, dimension, 4096, seed) - 0.5)
                .collect()
        };
        let columns = [column(0, 1), column(1, 1), column(2, 1), column(0, 2)];
        for i in 0..columns.len() {
            for j in 0..i {
                let product: f64 = columns[i].iter().zip(&columns[j]).map(|(a, b)| a * b).sum();
                let correlation = product / (4096.0 / 12.0);
                assert!(correlation.abs() < 5.0 / 64.0, "{i} and {j}: {correlation}");
            }
        }
    }

    /// Neighbouring runs are not neighbours: the mean distance of the shares of
    /// consecutive runs of a random permutation is a third of the range.
    #[test]
    fn the_order_is_shuffled() {
        let runs = 10_000;
        let x: Vec<f64> = (0..runs).map(|r| coordinate(r, 0, runs, 7)).collect();
        let mean = x.windows(2).map(|p| (p[1] - p[0]).abs()).sum::<f64>() / (runs - 1) as f64;
        assert!((mean - 1.0 / 3.0).abs() < 0.01, "{mean}");
    }
}
