//! The two universal classes that carry most published laws.

pub(crate) mod hunt_crossley;
pub(crate) mod linear;

/// `I_n` of the elastic power law: half the contact time is `I_n delta_max / v0`.
/// `I_n = integral_0^1 dx / sqrt(1 - x^(n+1))`, a Beta function; evaluated with
/// `x = 1 - s^2`, which removes the singularity, by Gauss-Legendre panels.
pub(crate) fn elastic_time_factor(exponent: f64) -> f64 {
    // 10-point Gauss-Legendre on [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
    const NODES: [(f64, f64); 5] = [
        (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    const PANELS: usize = 16;
    let power = exponent + 1.0;
    let integrand = |s: f64| {
        let gap = -f64::exp_m1(power * f64::ln_1p(-s * s));
        2.0 * s / gap.sqrt()
    };
    let half = 0.5 / PANELS as f64;
    (0..PANELS)
        .map(|panel| {
            let middle = (panel as f64 + 0.5) / PANELS as f64;
            NODES
                .iter()
                .map(|(x, w)| {
                    w * half * (integrand(middle - half * x) + integrand(middle + half * x))
                })
                .sum::<f64>()
        })
        .sum()
}
