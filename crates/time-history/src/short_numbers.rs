//! Numbers as messages tell them: to three significant digits.

/// Three significant digits, without zeros at the end.
#[must_use]
pub fn short(x: f64) -> String {
    let text = format!("{x:.2e}");
    text.parse::<f64>().map_or(text, |x| {
        if x != 0.0 && !(1.0e-4..1.0e6).contains(&x.abs()) {
            format!("{x:e}")
        } else {
            x.to_string()
        }
    })
}

/// Three significant digits, not above the value.
pub(crate) fn short_below(x: f64) -> String {
    let unit = libm::pow(10.0, libm::log10(x).floor() - 2.0);
    short((x / unit).floor() * unit)
}

/// A stiffness (N/m) in the unit in which it is short.
pub(crate) fn stiffness_text(stiffness: f64) -> String {
    let (unit, size) = match stiffness {
        k if k < 1.0e4 => ("N/m", 1.0),
        k if k < 1.0e6 => ("kN/m", 1.0e3),
        _ => ("MN/m", 1.0e6),
    };
    format!("{} {unit}", short(stiffness / size))
}
