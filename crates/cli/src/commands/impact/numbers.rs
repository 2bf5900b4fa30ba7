//! Numbers as a reader wants them.

/// Five significant digits; a dash for what is not defined.
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if (-3.0..6.0).contains(&magnitude) {
        let decimals = (4.0 - magnitude).max(0.0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') {
            return text.trim_end_matches('0').trim_end_matches('.').to_owned();
        }
        return text;
    }
    format!("{value:.4e}")
}

/// Seven significant digits in scientific form; a dash for what is not defined.
pub fn scientific(value: f64, unit: &str) -> String {
    if value.is_finite() {
        format!("{value:.6e} {unit}")
    } else {
        "-".to_owned()
    }
}

/// A percentage with its sign; a dash for what is not defined.
pub fn signed_percent(value: f64) -> String {
    if value.is_finite() {
        format!("{value:+.2}")
    } else {
        "-".to_owned()
    }
}
