//! Numbers as texts for people: tables, pages, messages.

/// Five significant digits; a dash for what is not defined.
#[must_use]
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = libm::log10(value.abs()).floor();
    if (-3.0..6.0).contains(&magnitude) {
        return trimmed(value, (4.0 - magnitude).max(0.0) as usize);
    }
    format!("{value:.4e}")
}

/// Six digits, without an exponent where there is no need.
#[must_use]
pub fn six_digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || (1.0e-3..1.0e7).contains(&size) {
        let digits = (5 - libm::log10(size.max(1.0e-3)).floor() as i32).clamp(0, 8) as usize;
        return trimmed(value, digits);
    }
    format!("{value:.5e}")
}

/// With this many decimals at most: zeros at the end are left out.
fn trimmed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Seven significant digits in scientific form; a dash for what is not defined.
#[must_use]
pub fn scientific(value: f64, unit: &str) -> String {
    if value.is_finite() {
        format!("{value:.6e} {unit}")
    } else {
        "-".to_owned()
    }
}

/// A percentage with its sign; a dash for what is not defined.
#[must_use]
pub fn signed_percent(value: f64) -> String {
    if value.is_finite() {
        format!("{value:+.2}")
    } else {
        "-".to_owned()
    }
}

/// With this many decimals, and never as minus zero.
#[must_use]
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    if zero {
        text.trim_start_matches('-').to_owned()
    } else {
        text
    }
}

/// With this many decimals, rounded up: what suffices suffices as it is shown. What is above the digits shown by less
/// than a millionth of their last is round-off.
#[must_use]
pub fn rounded_up(value: f64, decimals: usize) -> String {
    fixed(up(value, decimals), decimals)
}

/// A width that is provided (m) in mm: one decimal, or as many as it has up to six digits.
#[must_use]
pub fn width_in_millimetres(provided: f64) -> String {
    let (shown, all) = (format!("{:.1}", provided * 1e3), six_digits(provided * 1e3));
    match all.len() > shown.len() || shown.len() > MOST_SIGNS {
        true => all,
        false => shown,
    }
}

/// Signs of a width with one decimal, before it is written with an exponent.
const MOST_SIGNS: usize = 10;

/// Decimals more with which a width that is wide enough is told from one that is not.
const MORE_DECIMALS: usize = 6;

/// A width that is asked for, rounded up as by [`rounded_up`] beside what is provided in the same unit: with as many decimals
/// more as it takes for a width that is wide enough not to look too small.
#[must_use]
pub fn rounded_up_beside(required: f64, provided: f64, decimals: usize) -> String {
    let looks_too_small =
        |decimals: &usize| required <= provided && up(required, *decimals) > provided;
    let most = decimals + MORE_DECIMALS;
    let enough = (decimals..most).find(|decimals| !looks_too_small(decimals));
    rounded_up(required, enough.unwrap_or(most))
}

/// What is missing of a width that is asked for, with this many decimals, where `rounded_up` shows the width with as
/// many: together with what is provided, as `provided` shows it, no less than the width that is shown.
#[must_use]
pub fn missing(required: f64, provided: &str, decimals: usize) -> String {
    let provided: f64 = provided.parse().unwrap_or(0.0);
    rounded_up(up(required, decimals) - provided, decimals)
}

/// The least number of so many decimals that suffices; itself where there is none.
fn up(value: f64, decimals: usize) -> f64 {
    let scale = libm::pow(10.0, decimals as f64);
    let up = (value * scale - 1.0e-6).ceil() / scale;
    match up.is_finite() {
        true => up,
        false => value,
    }
}

/// With this many decimals, or with three digits and an exponent where the decimals would make a
/// zero of what is none.
#[must_use]
pub fn fixed_or_small(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    let looks_zero = text.bytes().all(|b| matches!(b, b'0' | b'.'));
    match looks_zero && value != 0.0 {
        true => format!("{value:.2e}"),
        false => text,
    }
}

/// All digits, with an exponent where that is shorter.
#[must_use]
pub fn all_digits(value: f64) -> String {
    let size = value.abs();
    if size != 0.0 && !(1.0e-3..1.0e5).contains(&size) {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

/// Factor and unit in which a quantity with this SI unit is shown to an engineer; the SI unit
/// itself where there is no other.
#[must_use]
pub fn shown_unit(si: &str) -> (f64, &str) {
    match si {
        "m" => (1.0e3, "mm"),
        "N" => (1.0e-3, "kN"),
        "N m" => (1.0e-3, "kN m"),
        "rad" => (1.0e3, "mrad"),
        "m s-2" => (1.0, "m/s2"),
        "rad s-2" => (1.0, "rad/s2"),
        "1" => (1.0, "-"),
        other => (1.0, other),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_have_the_digits_that_they_need() {
        for (metres, shown) in [
            (0.02, "20.0"),
            (0.0351, "35.1"),
            (0.035_06, "35.06"),
            (0.000_04, "0.04"),
            (0.0, "0.0"),
            (1.234_567_8, "1234.57"),
            (123.456_7, "123456.7"),
            (1e6, "1.00000e9"),
        ] {
            assert_eq!(width_in_millimetres(metres), shown);
        }
    }

    #[test]
    fn digits_are_as_many_as_are_asked_for() {
        for (value, five, six) in [
            (0.0, "0", "0"),
            (12.0, "12", "12"),
            (-1234.5678, "-1234.6", "-1234.57"),
            (0.001_234_567, "0.0012346", "0.00123457"),
            (123_456.7, "123457", "123457"),
            (2.5e9, "2.5000e9", "2.50000e9"),
            (1.0e-4, "1.0000e-4", "1.00000e-4"),
        ] {
            assert_eq!(
                (significant(value), six_digits(value)),
                (five.into(), six.into())
            );
        }
        assert_eq!(significant(f64::NAN), "-");
        assert_eq!(scientific(0.5, "N"), "5.000000e-1 N");
        assert_eq!(scientific(f64::INFINITY, "N"), "-");
        assert_eq!(
            (signed_percent(1.0), signed_percent(f64::NAN)),
            ("+1.00".into(), "-".into())
        );
        assert_eq!(
            (all_digits(93.5e6), all_digits(0.65)),
            ("9.35e7".into(), "0.65".into())
        );
    }

    /// 207.943 mm do not suffice where 207.94 are shown; round-off of 117.2 mm asks for no more.
    #[test]
    fn what_suffices_suffices_as_it_is_shown() {
        for (value, decimals, text) in [
            (207.943_117, 2, "207.95"),
            (207.943_117, 1, "208.0"),
            (117.200_000_000_000_02, 1, "117.2"),
            (20.0, 2, "20.00"),
            (0.0, 2, "0.00"),
            (1234.1, 0, "1235"),
        ] {
            assert_eq!(rounded_up(value, decimals), text);
        }
    }

    /// 117.17 mm would be more than the 117.163 mm that are provided, and do suffice.
    #[test]
    fn what_is_wide_enough_does_not_look_too_small() {
        for (required, provided, text) in [
            (117.162_9, 117.163, "117.163"),
            (117.162_912_3, 117.162_913, "117.162913"),
            (117.163, 117.163, "117.163"),
            (117.163, 117.162_9, "117.17"),
            (117.163, 120.0, "117.17"),
            (117.17, 117.17, "117.17"),
            (0.0, 0.0, "0.00"),
        ] {
            assert_eq!(rounded_up_beside(required, provided, 2), text);
        }
    }

    /// 10.0 mm and 150.11 mm are less than the 160.12 mm that are shown of 160.11287 mm.
    #[test]
    fn what_is_provided_and_what_is_missing_suffice() {
        for (required, provided, text) in [
            (160.112_87, "10.0", "150.12"),
            (160.113, "10.119", "150.01"),
            (160.12, "10.0", "150.12"),
            (117.208_067, "116.125", "1.09"),
        ] {
            assert_eq!(missing(required, provided, 2), text);
        }
    }

    #[test]
    fn small_numbers_are_no_zeros() {
        for (value, text) in [
            (0.0, "0.000"),
            (-0.0, "0.000"),
            (0.000_6, "0.001"),
            (0.000_4, "4.00e-4"),
            (-1.234e-9, "-1.23e-9"),
            (12.345_6, "12.346"),
            (f64::NAN, "NaN"),
        ] {
            assert_eq!(fixed_or_small(value, 3), text);
        }
    }

    #[test]
    fn zero_has_no_sign() {
        for (value, decimals, text) in [(-1e-12, 3, "0.000"), (-2e-3, 3, "-0.002")] {
            assert_eq!(fixed(value, decimals), text);
        }
        assert_eq!(
            (fixed(-0.001, 2), fixed(-0.01, 2)),
            ("0.00".into(), "-0.01".into())
        );
        assert_eq!(fixed(f64::NEG_INFINITY, 2), "-inf");
    }
}
