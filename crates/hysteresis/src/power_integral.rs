//! Integrals of powers between two limits that lose no digits near the exponent -1.

/// Nodes (positive half) and weights of the Gauss-Legendre rule with 12 points on
/// [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
const NODES: [(f64, f64); 6] = [
    (0.125_233_408_511_468_9, 0.249_147_045_813_402_8),
    (0.367_831_498_998_180_2, 0.233_492_536_538_354_8),
    (0.587_317_954_286_617_5, 0.203_167_426_723_065_92),
    (0.769_902_674_194_304_7, 0.160_078_328_543_346_22),
    (0.904_117_256_370_474_9, 0.106_939_325_995_318_43),
    (0.981_560_634_246_719_2, 0.047_175_336_386_511_83),
];

/// Integral of `phi^exponent` from `low` to `high`, `0 <= low <= high`; zero for an
/// empty range. With `low = 0` the exponent must be above -1.
pub(crate) fn power(exponent: f64, low: f64, high: f64) -> f64 {
    if high <= low {
        return 0.0;
    }
    let order = exponent + 1.0;
    // ln(high / low), accurate where the limits nearly agree; infinite for low = 0.
    let span = libm::log1p((high - low) / low);
    let relative = if order == 0.0 {
        span
    } else {
        -libm::expm1(-order * span) / order
    };
    libm::pow(high, order) * relative
}

/// Integral of `(reach - phi) phi^exponent` from `low` to `high`, `high <= reach`.
pub(crate) fn power_moment(exponent: f64, low: f64, high: f64, reach: f64) -> f64 {
    if high <= low {
        return 0.0;
    }
    if high < 2.0 * low {
        // The two integrals below would cancel; the integrand is smooth here.
        let (middle, half) = (0.5 * (high + low), 0.5 * (high - low));
        let value = |phi: f64| (reach - phi) * libm::pow(phi, exponent);
        let sum: f64 = NODES
            .iter()
            .map(|(node, weight)| {
                weight * (value(middle - half * node) + value(middle + half * node))
            })
            .sum();
        return half * sum;
    }
    reach * power(exponent, low, high) - power(exponent + 1.0, low, high)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn exponents_next_to_minus_one_follow_the_series() {
        // (h^o - l^o) / o = L + o (H^2 - l^2) / 2 + ..., H = ln h, l = ln l.
        let (low, high) = (1e-5_f64, 1e-4_f64);
        for order in [1e-5, 1e-8, 1e-12, 1e-16, 0.0, -1e-9] {
            let (h, l) = (libm::log(high), libm::log(low));
            let series = (h - l)
                + order / 2.0 * (h * h - l * l)
                + order * order / 6.0 * (h.powi(3) - l.powi(3))
                + order.powi(3) / 24.0 * (h.powi(4) - l.powi(4));
            let value = power(order - 1.0, low, high);
            // The order itself is rounded to 1e-16 when one is subtracted.
            assert!((value / series - 1.0).abs() < 4e-15, "{order}: {value}");
        }
    }

    #[test]
    fn the_moment_is_the_same_on_both_sides_of_the_switch() {
        // Splitting the range must not change the value; the halves use the rule,
        // the whole the closed form.
        for exponent in [-0.9, -0.3, 0.0, 1.7] {
            let whole = power_moment(exponent, 1.0, 3.0, 3.5);
            let halves =
                power_moment(exponent, 1.0, 1.7, 3.5) + power_moment(exponent, 1.7, 3.0, 3.5);
            assert!((whole / halves - 1.0).abs() < 1e-14, "{exponent}");
        }
        // Just past the lower limit: s^2 / 2 to first order, here to 1e-9.
        let small = power_moment(-0.3, 1.0, 1.0 + 1e-9, 1.0 + 1e-9);
        assert!((small / 0.5e-18 - 1.0).abs() < 1e-6);
    }
}
