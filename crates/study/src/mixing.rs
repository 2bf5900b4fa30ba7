//! Random numbers without a state: the bits of a few numbers, well mixed.

/// The finaliser of SplitMix64 (Steele, Lea and Flood 2014, OOPSLA, 453, figure 18, mix
/// 13 of Stafford).
fn mix(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Sixty-four bits for a list of numbers.
pub(crate) fn bits(numbers: &[u64]) -> u64 {
    let golden = 0x9e37_79b9_7f4a_7c15;
    numbers.iter().fold(golden, |state, n| {
        mix(state.wrapping_add(golden) ^ mix(n.wrapping_add(golden)))
    })
}

/// An even number from 0 to 1, one excluded, for a list of numbers.
pub(crate) fn unit(numbers: &[u64]) -> f64 {
    (bits(numbers) >> 11) as f64 * f64::powi(2.0, -53)
}
