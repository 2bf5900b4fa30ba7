//! Numbers as engineers write them.

use pounding_catalogue::numbers::rounded_up;

/// Parts of the names of numbers that may be as small as they like: round-off leaves none of them.
const SMALL: [&str; 4] = ["mean_annual_frequency", "/hazard/", "residual", "p_value"];

/// Parts of the names of widths that are asked for, by records, rules, codes and target frequencies, and how these end.
const REQUIRED: [(&str, &str); 9] = [
    ("", "/required"),
    ("", "/required/by_count"),
    ("", "/required/lognormal/width"),
    ("", "/minimum/width"),
    ("/provisions/", "/records/+/width"),
    ("/combinations/", "/width/+/+"),
    ("/readings/", "/width"),
    ("maximum /gaps/", "/demand/+/peak"),
    ("/gaps/", "/suite/maximum"),
];

/// Four figures of the number of this name or path, of a width that is asked for at least those; a dash for what is
/// not known.
pub(super) fn figures_of(name: &str, x: f64) -> String {
    let mut required = REQUIRED.iter();
    // What is divided by such a width is none.
    let is_ratio = name.contains(" / ");
    if !is_ratio && required.any(|(part, end)| name.contains(part) && name.ends_with(end)) {
        return figures_that_suffice(x);
    }
    match SMALL.iter().any(|part| name.contains(part)) {
        true => figures_above(0.0, x),
        false => figures(x),
    }
}

/// Four figures of a width that is asked for: as they are shown they suffice.
pub(crate) fn figures_that_suffice(x: f64) -> String {
    let shown = figures(x);
    let decimals = shown.split_once('.').map_or(0, |(_, after)| after.len());
    match x.is_finite() && x > 0.0 && !shown.contains('e') {
        true => rounded_up(x, decimals),
        false => shown,
    }
}

/// Four figures; a dash for what is not known.
pub(super) fn figures(x: f64) -> String {
    // What is smaller may be what round-off leaves of millimetres and kilojoules.
    figures_above(1.0e-12, x)
}

/// Four figures of a number however small: one whose ratio to another is shown, and of which it is
/// known that round-off does not leave it.
pub(super) fn all_figures(x: f64) -> String {
    figures_above(0.0, x)
}

/// The same, where what is below `least` is none.
fn figures_above(least: f64, x: f64) -> String {
    if !x.is_finite() {
        return "\u{2013}".to_owned();
    }
    let size = x.abs();
    if size < least || size == 0.0 {
        return "0".to_owned();
    }
    if !(1.0e-4..1.0e7).contains(&size) {
        return format!("{x:.3e}");
    }
    // Of the number as four figures leave it: they may take it to the next power of ten.
    let rounded = format!("{size:.3e}");
    let before = rounded.split_once('e').and_then(|(_, e)| e.parse().ok());
    let decimals = (3 - before.unwrap_or(0_i32)).max(0) as usize;
    format!("{x:.decimals$}")
}

/// Part of the energy that the ground puts in below which what impacts and links dissipate may be round-off.
const ROUND_OFF: f64 = 1.0e-9;

/// Energy (J) that something dissipated in a run with this input energy, without the round-off of elastic laws, of
/// either sign.
pub(super) fn without_round_off(energy: f64, input: f64) -> f64 {
    match energy.abs() <= ROUND_OFF * input.abs() {
        true => 0.0,
        false => energy,
    }
}

/// A ratio with two decimals; a dash where it has none.
pub(super) fn ratio(with: f64, without: f64) -> String {
    if !(without > 0.0) || !with.is_finite() {
        return "\u{2013}".to_owned();
    }
    match with / without {
        // Beside almost nothing.
        ratio if ratio >= 1.0e4 => format!("{ratio:.1e}"),
        ratio => format!("{ratio:.2}"),
    }
}

/// Part of a whole in percent.
pub(super) fn percent(part: f64, whole: f64) -> String {
    if !(whole > 0.0) || !part.is_finite() {
        return "\u{2013}".to_owned();
    }
    let shown = format!("{:.1} %", 100.0 * part / whole);
    // What round-off leaves has no sign.
    match shown.as_str() {
        "-0.0 %" => "0.0 %".to_owned(),
        _ => shown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_figures() {
        for (x, text) in [
            (0.0, "0"),
            (117.208_1, "117.2"),
            (-0.012_345, "-0.01235"),
            (9.999_96, "10.00"),
            (0.999_999_18, "1.000"),
            (0.099_999_6, "0.1000"),
            (123_456.0, "123456"),
            (1.0e9, "1.000e9"),
            (2.0e-7, "2.000e-7"),
            (f64::NAN, "\u{2013}"),
        ] {
            assert_eq!(figures(x), text);
        }
        assert_eq!(ratio(3.0, 2.0), "1.50");
        assert_eq!(ratio(3.0, 0.0), "\u{2013}");
        assert_eq!(ratio(3.0, 1.0e-28), "3.0e28");
        // Hertz's law in a run with an input of 112.59 kJ.
        assert_eq!(without_round_off(8.913e-6, 1.1259e5), 0.0);
        assert_eq!(without_round_off(-2.0e-4, 1.1259e5), -2.0e-4);
        assert_eq!(without_round_off(3.0, f64::NAN), 3.0);
        assert_eq!(figures(-1.8e-15), "0");
        assert_eq!(all_figures(-1.8e-15), "-1.800e-15");
        assert_eq!(figures_of("energy_residual", 2.8e-15), "2.800e-15");
        assert_eq!(figures_of("/limits/*/mean_annual_frequency", 0.0), "0");
        assert_eq!(figures_of("peak_force", 2.8e-15), "0");
        for (name, text) in [
            ("/gaps/0/governing/required", "160.2"),
            ("maximum /gaps/0/provisions/*/records/+/width", "160.2"),
            ("maximum /gaps/0/combinations/*/width/+/+", "160.2"),
            ("/gaps/0/code/cases/0/levels/1/readings/0/width", "160.2"),
            ("/gaps/0/minimum/width", "160.2"),
            ("maximum /gaps/0/levels/*/demand/+/peak", "160.2"),
            ("/gaps/0/suite/maximum", "160.2"),
            ("/gaps/0/suite/mean", "160.1"),
            (
                "/gaps/0/levels/*/width / maximum /gaps/0/levels/*/demand/+/peak",
                "160.1",
            ),
            // What is provided, and what was tried.
            ("/gaps/0/levels/*/width", "160.1"),
            ("/sweep/widths/*", "160.1"),
        ] {
            assert_eq!(figures_of(name, 160.112_87), text, "{name}");
        }
        assert_eq!(figures_that_suffice(f64::NAN), "\u{2013}");
        assert_eq!(percent(1.0, 8.0), "12.5 %");
        assert_eq!(percent(-2.3e-8, 5.0e7), "0.0 %");
    }
}
