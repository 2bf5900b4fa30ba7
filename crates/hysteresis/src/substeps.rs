//! Small systems of ordinary differential equations over a given interval: the pair
//! of order 5(4) of Dormand and Prince (Journal of Computational and Applied
//! Mathematics 6 (1980) 19) with error control.

const ROWS: [&[f64]; 6] = [
    &[1.0 / 5.0],
    &[3.0 / 40.0, 9.0 / 40.0],
    &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
    &[
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
    ],
    &[
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
    ],
    &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
const NODES: [f64; 6] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
/// Solution of order 5 less that of order 4.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

/// Solution of order 5 less one of order 3 on the same stages, whose weights 7/72, 4/9 and
/// 11/24 solve the conditions of order 3.
const LOWER_ERROR: [f64; 7] = [
    35.0 / 384.0 - 7.0 / 72.0,
    0.0,
    500.0 / 1113.0 - 4.0 / 9.0,
    125.0 / 192.0 - 11.0 / 24.0,
    -2187.0 / 6784.0,
    11.0 / 84.0,
    0.0,
];

/// Maximum local error of a substep, absolute and relative.
const TOLERANCE: f64 = 1e-12;
/// Maximum of the estimate of order 3. Any one estimate changes sign somewhere as a
/// substep grows and vanishes there by chance, however wrong the end is; a substep that
/// passes both is as short as the first of them says.
const LOWER_TOLERANCE: f64 = 2e-8;
/// Shortest substep, as a share of the interval: shorter ones gain nothing.
const SHORTEST: f64 = 1e-12;

/// Integrates `slope(t, y)` from `start` over `[from, to]`. Numbers that are not
/// finite come back as such.
pub(crate) fn integrate<const N: usize>(
    slope: impl Fn(f64, &[f64; N]) -> [f64; N],
    start: [f64; N],
    from: f64,
    to: f64,
) -> [f64; N] {
    let span = to - from;
    if span == 0.0 || !span.is_finite() {
        return if span == 0.0 { start } else { [f64::NAN; N] };
    }
    let (mut done, mut share, mut state) = (0.0, 1.0_f64, start);
    let mut stages = [[0.0; N]; 7];
    stages[0] = slope(from, &state);
    while done < 1.0 {
        let last = done + share >= 1.0;
        let step = if last { 1.0 - done } else { share } * span;
        let mut end = state;
        for (i, row) in ROWS.iter().enumerate() {
            end = state;
            for (weight, stage) in row.iter().zip(&stages) {
                for (e, k) in end.iter_mut().zip(stage) {
                    *e += step * weight * k;
                }
            }
            stages[i + 1] = slope(from + done * span + NODES[i] * step, &end);
        }
        let error = error(&stages, &state, &end, step);
        if error.is_nan() {
            // Far too long a substep overflows.
            if share <= SHORTEST {
                return [f64::NAN; N];
            }
            share = (0.1 * share).max(SHORTEST);
            continue;
        }
        if error <= 1.0 || share <= SHORTEST {
            done = if last { 1.0 } else { done + share };
            state = end;
            stages[0] = stages[6];
        }
        let factor = if error > 0.0 {
            0.9 * libm::pow(error, -0.2)
        } else {
            5.0
        };
        share = (share * factor.clamp(0.2, 5.0)).max(SHORTEST);
    }
    state
}

/// Maximum error of a substep over what is allowed; not a number where it overflows.
fn error<const N: usize>(
    stages: &[[f64; N]; 7],
    state: &[f64; N],
    end: &[f64; N],
    step: f64,
) -> f64 {
    let mut maximum = 0.0_f64;
    for i in 0..N {
        let size = 1.0 + state[i].abs().max(end[i].abs());
        for (weights, tolerance) in [(&ERROR, TOLERANCE), (&LOWER_ERROR, LOWER_TOLERANCE)] {
            let sum: f64 = weights.iter().zip(stages).map(|(w, k)| w * k[i]).sum();
            let ratio = (step * sum).abs() / (tolerance * size);
            if !ratio.is_finite() {
                return f64::NAN;
            }
            maximum = maximum.max(ratio);
        }
    }
    maximum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_oscillator_and_its_reverse_meet_the_closed_form() {
        let slope = |_: f64, y: &[f64; 2]| [y[1], -y[0]];
        let end = integrate(slope, [0.0, 1.0], 0.0, 10.0);
        assert!((end[0] - libm::sin(10.0)).abs() < 1e-10, "{end:?}");
        assert!((end[1] - libm::cos(10.0)).abs() < 1e-10, "{end:?}");
        let start = integrate(slope, end, 10.0, 0.0);
        assert!(start[0].abs() < 2e-10 && (start[1] - 1.0).abs() < 2e-10);
    }

    /// Spans at which one estimate vanishes by chance lie among these: with the estimate of
    /// order 4 alone, errors pass the bound.
    #[test]
    fn no_span_passes_by_chance() {
        // A curve with a knee, as of Menegotto and Pinto; in three parts the same chance
        // does not come again.
        for exponent in [1.6, 2.5, 4.0, 9.0] {
            let slope = |t: f64, _: &[f64; 1]| {
                [t * libm::pow(1.0 + libm::pow(t, exponent), -1.0 / exponent)]
            };
            for i in 1..5_000 {
                let span = f64::from(i) * 8.0e-4;
                let got = integrate(slope, [0.0], 0.0, span)[0];
                let (near, far) = (0.41 * span, 0.77 * span);
                let parts = [(0.0, near), (near, far), (far, span)];
                let parts = parts.map(|(from, to)| integrate(slope, [0.0], from, to)[0]);
                let wrong = (got - parts.iter().sum::<f64>()).abs();
                assert!(
                    wrong < 1.0e-10,
                    "{exponent} {span}: {got}, wrong by {wrong:e}"
                );
            }
        }
    }

    #[test]
    fn what_is_not_finite_ends_the_integration() {
        let value = integrate(|_, y: &[f64; 1]| [y[0] * y[0]], [1.0], 0.0, 2.0);
        assert!(!value[0].is_finite());
        let nan = integrate(|_, _: &[f64; 1]| [1.0], [0.0], 0.0, f64::NAN);
        assert!(nan[0].is_nan());
    }
}
