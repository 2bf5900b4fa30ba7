//! Sobol sequence in the order of the Gray code (Antonov and Saleev 1979), with the
//! primitive polynomials and first direction numbers of Joe and Kuo (2008), their table
//! `new-joe-kuo-6`.

use crate::mixing::bits;

/// Bits of a coordinate.
pub(super) const BITS: u32 = 32;

/// Degree, coefficients between the first and the last, and first odd numbers m of each
/// dimension from the second on.
const POLYNOMIALS: [(u32, u32, &[u32]); 20] = [
    (1, 0, &[1]),
    (2, 1, &[1, 3]),
    (3, 1, &[1, 3, 1]),
    (3, 2, &[1, 1, 1]),
    (4, 1, &[1, 1, 3, 3]),
    (4, 4, &[1, 3, 5, 13]),
    (5, 2, &[1, 1, 5, 5, 17]),
    (5, 4, &[1, 1, 5, 5, 5]),
    (5, 7, &[1, 1, 7, 11, 19]),
    (5, 11, &[1, 1, 5, 1, 1]),
    (5, 13, &[1, 1, 1, 3, 11]),
    (5, 14, &[1, 3, 5, 5, 31]),
    (6, 1, &[1, 3, 3, 9, 7, 49]),
    (6, 13, &[1, 1, 1, 15, 21, 21]),
    (6, 16, &[1, 3, 1, 13, 27, 49]),
    (6, 19, &[1, 1, 1, 15, 7, 5]),
    (6, 22, &[1, 3, 1, 15, 13, 25]),
    (6, 25, &[1, 1, 5, 5, 19, 61]),
    (7, 1, &[1, 3, 7, 11, 23, 15, 103]),
    (7, 4, &[1, 3, 7, 13, 13, 15, 69]),
];

/// Maximum number of variables of a Sobol design.
pub const MOST_DIMENSIONS: usize = POLYNOMIALS.len() + 1;

/// Coordinate, 0 to 1, of a run in a dimension: the middle of the finest interval if
/// shifted by a seed, its lower end otherwise.
pub(super) fn coordinate(run: u64, dimension: usize, seed: Option<u64>) -> f64 {
    let fine = f64::powi(2.0, -(BITS as i32));
    let x = digits(run, dimension);
    match seed {
        None => f64::from(x) * fine,
        Some(seed) => {
            let shift = (bits(&[seed, dimension as u64, 2]) >> 32) as u32;
            (f64::from(x ^ shift) + 0.5) * fine
        }
    }
}

/// Binary digits of a coordinate.
fn digits(run: u64, dimension: usize) -> u32 {
    let gray = run ^ (run >> 1);
    let directions = directions(dimension);
    (0..BITS)
        .filter(|bit| gray >> bit & 1 == 1)
        .fold(0, |x, bit| x ^ directions[bit as usize])
}

/// Direction numbers of a dimension.
fn directions(dimension: usize) -> [u32; BITS as usize] {
    let mut v = [0_u32; BITS as usize];
    let Some(index) = dimension.checked_sub(1) else {
        for (i, v) in v.iter_mut().enumerate() {
            *v = 1 << (31 - i);
        }
        return v;
    };
    let (degree, coefficients, first) = POLYNOMIALS[index];
    let s = degree as usize;
    for (i, m) in first.iter().enumerate() {
        v[i] = m << (31 - i);
    }
    for i in s..BITS as usize {
        v[i] = v[i - s] ^ (v[i - s] >> s);
        for k in 1..s {
            if coefficients >> (s - 1 - k) & 1 == 1 {
                v[i] ^= v[i - k];
            }
        }
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points number 1000 of the sequence in every dimension, by SciPy 1.17
    /// (`scipy.stats.qmc.Sobol(21, scramble=False, bits=32)`), whose direction numbers are
    /// those of Joe and Kuo.
    #[test]
    fn coordinates_are_those_of_an_independent_program() {
        for (dimension, expected) in POINT_1000.iter().enumerate() {
            assert_eq!(coordinate(1000, dimension, None), *expected, "{dimension}");
        }
        let third: Vec<f64> = (0..8).map(|run| coordinate(run, 2, None)).collect();
        assert_eq!(third, [0.0, 0.5, 0.25, 0.75, 0.625, 0.125, 0.875, 0.375]);
    }

    /// The first 2^k points have one in each of 2^k equal shares of every dimension, also
    /// when shifted, and any aligned block of them too.
    #[test]
    fn every_share_has_one_point() {
        for seed in [None, Some(5)] {
            for dimension in 0..MOST_DIMENSIONS {
                for (from, count) in [(0, 256), (256, 256), (1024, 64)] {
                    let mut seen = vec![false; count as usize];
                    for run in from..from + count {
                        let x = coordinate(run, dimension, seed);
                        let share = (x * count as f64) as usize;
                        assert!(!seen[share], "dimension {dimension}, seed {seed:?}");
                        seen[share] = true;
                    }
                }
            }
        }
    }

    /// In the first two dimensions the first 2^k points are a (0, k, 2)-net: one in each
    /// of the elementary boxes of every shape.
    #[test]
    fn the_plane_is_a_net() {
        for seed in [None, Some(9)] {
            for wide in 0..=6 {
                let (columns, rows) = (1_usize << wide, 1_usize << (6 - wide));
                let mut seen = [false; 64];
                for run in 0..64 {
                    let x = (coordinate(run, 0, seed) * columns as f64) as usize;
                    let y = (coordinate(run, 1, seed) * rows as f64) as usize;
                    assert!(!seen[x * rows + y]);
                    seen[x * rows + y] = true;
                }
            }
        }
    }

    const POINT_1000: [f64; MOST_DIMENSIONS] = [
        0.2197265625,
        0.0966796875,
        0.5185546875,
        0.6767578125,
        0.2802734375,
        0.9072265625,
        0.0458984375,
        0.8994140625,
        0.5009765625,
        0.0693359375,
        0.0849609375,
        0.2548828125,
        0.1611328125,
        0.3837890625,
        0.1435546875,
        0.3701171875,
        0.7197265625,
        0.3447265625,
        0.9912109375,
        0.7255859375,
        0.5224609375,
    ];
}
