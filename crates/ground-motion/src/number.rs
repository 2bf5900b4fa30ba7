//! Numbers as agencies print them.

/// Parses `.5`, `5.`, `1.0D-03`, `1.234-103`; refuses NaN, infinities, Fortran
/// overflow and decimal commas with the reason.
pub(crate) fn parse(text: &str) -> Result<f64, String> {
    let plain = text.trim();
    if plain.contains('*') {
        return Err(format!(
            "\"{plain}\" is a Fortran overflow: the value did not fit its field"
        ));
    }
    if plain.contains(',') {
        return Err(format!("\"{plain}\" has a decimal comma"));
    }
    let lower = plain.to_ascii_lowercase();
    if lower.contains("nan") || lower.contains("inf") {
        return Err(format!("\"{plain}\" is not a number"));
    }
    let mut normal = lower.replace('d', "e");
    if !normal.contains('e')
        && let Some(at) = normal.rfind(['+', '-']).filter(|at| *at > 0)
    {
        normal.insert(at, 'e');
    }
    match normal.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(format!("\"{plain}\" is too large")),
        Err(_) => Err(format!("\"{plain}\" is not a number")),
    }
}
