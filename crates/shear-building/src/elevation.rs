//! Elevations of floors, and when two floors are level.

/// Floors whose elevations differ by no more than this are level, unless a case says
/// otherwise (m).
pub const ELEVATION_TOLERANCE: f64 = 0.01;

/// Part of the tolerance by which round-off may exceed it: floors at 3.01 m and 3 m differ
/// by a centimetre, not by more.
const ROUND_OFF: f64 = 1.0e-9;

/// Elevations of floors above the ground (m), bottom first, from storey heights (m).
///
/// They are the decimal sums of the heights: three storeys of 5.1 m end at 15.3 m, not at
/// 15.299999999999999 m, so that a floor is found by the number that a person would write.
/// The sum is compensated (Neumaier, Z. Angew. Math. Mech. 54 (1974) 39), which leaves no
/// more error than the heights themselves have, and rounded by [`decimal`], which removes
/// that too.
#[must_use]
pub fn elevations(height: &[f64]) -> Vec<f64> {
    let (mut sum, mut lost) = (0.0_f64, 0.0);
    let above = height.iter().map(|h| {
        let next = sum + h;
        lost += if sum >= *h {
            (sum - next) + h
        } else {
            (h - next) + sum
        };
        sum = next;
        decimal(sum + lost)
    });
    above.collect()
}

/// The number of 15 significant decimal digits next to `x`. Every double keeps that many
/// digits, so that a decimal number with no more of them comes back as it was written, also
/// from a result with a few units of round-off.
#[must_use]
pub fn decimal(x: f64) -> f64 {
    format!("{x:.14e}").parse().unwrap_or(x)
}

/// Whether two floors are level: their elevations (m) differ by no more than the tolerance
/// (m).
#[must_use]
pub fn are_level(one: f64, other: f64, tolerance: f64) -> bool {
    (one - other).abs() <= tolerance * (1.0 + ROUND_OFF)
}

/// Pairs of floors (from zero) of two buildings that are level, from their elevations (m),
/// bottom first.
#[must_use]
pub fn level_pairs(left: &[f64], right: &[f64], tolerance: f64) -> Vec<(usize, usize)> {
    // Elevations rise, so the first that is not below the band is the only candidate.
    let near = |x: f64| {
        let at = right.partition_point(|y| *y < x && !are_level(*y, x, tolerance));
        right
            .get(at)
            .is_some_and(|y| are_level(*y, x, tolerance))
            .then_some(at)
    };
    let floors = left.iter().enumerate();
    floors
        .filter_map(|(i, x)| near(*x).map(|j| (i, j)))
        .collect()
}

/// A floor below the roof of the lower building that none of these pairs holds: its side (0
/// left, 1 right) and its number, from zero.
#[must_use]
pub fn floor_without_partner(
    elevations: [&[f64]; 2],
    pairs: &[(usize, usize)],
    tolerance: f64,
) -> Option<(usize, usize)> {
    let roofs = elevations.map(|z| z.last().copied().unwrap_or(0.0));
    let top = roofs[0].min(roofs[1]) + tolerance;
    (0..2).find_map(|side| {
        // Both floors of the pairs rise.
        let paired = |floor| {
            let found = pairs.binary_search_by_key(&floor, |p| [p.0, p.1][side]);
            found.is_ok()
        };
        let mut floors = elevations[side].iter().enumerate();
        let floor = floors.position(|(floor, z)| *z <= top && !paired(floor));
        Some((side, floor?))
    })
}

#[cfg(test)]
mod tests {
    use super::{are_level, decimal, elevations};

    /// The double next to a decimal number of millimetres, by the parser of the standard
    /// library, which rounds correctly.
    fn metres(thousandths: u64) -> f64 {
        let text = format!("{}.{:03}", thousandths / 1000, thousandths % 1000);
        text.parse().unwrap_or(f64::NAN)
    }

    #[test]
    fn elevations_are_the_decimal_sums_of_the_heights() {
        assert_eq!(
            elevations(&[3.06; 5]),
            [3.06, 6.12, 9.18, 12.24, 15.3],
            "as a person writes them"
        );
        // Plain sums do not.
        let plain: f64 = [5.1; 3].iter().sum();
        assert!(plain != 15.3 && elevations(&[5.1; 3])[2] == 15.3);
        // Every height of a whole number of millimetres, up to 200 storeys.
        for height in (101..12_000_u64).step_by(7) {
            let up = elevations(&[metres(height); 200]);
            for (i, z) in up.iter().enumerate() {
                assert_eq!(*z, metres(height * (i as u64 + 1)), "{height} mm, {i}");
            }
        }
        let mixed: Vec<u64> = (0..3000).map(|i| 2100 + 977 * i % 4001).collect();
        let up = elevations(&mixed.iter().map(|h| metres(*h)).collect::<Vec<_>>());
        let mut sum = 0;
        for (h, z) in mixed.iter().zip(up) {
            sum += h;
            assert_eq!(z, metres(sum));
        }
    }

    /// 10.04 ft are 3.060192 m exactly; a product and a quotient of doubles may miss the
    /// double next to it.
    #[test]
    fn heights_converted_from_another_unit_lose_their_noise() {
        for storeys in [1, 7, 60] {
            let up = elevations(&vec![10.04 * 3048.0 / 1e4; storeys]);
            let exact = 3_060_192 * storeys as u64;
            let text = format!("{}.{:06}", exact / 1_000_000, exact % 1_000_000);
            assert_eq!(up.last().copied(), text.parse().ok());
        }
        assert_eq!(decimal(0.0), 0.0);
        assert_eq!(decimal(15.299999999999999), 15.3);
    }

    #[test]
    fn a_difference_equal_to_the_tolerance_is_level() {
        assert!(are_level(15.3, 15.29, 0.01) && are_level(3.0, 3.01, 0.01));
        assert!(!are_level(3.0, 3.0101, 0.01));
        assert!(!are_level(f64::NAN, 3.0, 0.01));
    }
}
