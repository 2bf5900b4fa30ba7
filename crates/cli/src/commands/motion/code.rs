//! The spectrum of a code from the words of an option.

use pounding_case::SpectrumSource;
use pounding_ground_motion::spectra::design::CodeSpectrum;

use super::words::{Words, quoted};
use crate::failure::Failure;
use crate::output::warn;

/// Says which parameters of a spectrum no code has.
pub fn warn_of_parameters(spectrum: &CodeSpectrum) {
    for unusual in pounding_case::unusual_parameters(spectrum) {
        warn(&unusual);
    }
}

/// The spectrum that `--code` names: the code, then its parameters with the keys of the case
/// file.
pub fn code_spectrum(text: &str, damping: f64) -> Result<CodeSpectrum, Failure> {
    let words = Words::of("code", text)?;
    if words.word.is_empty() {
        return Err(Failure::input(
            format!("--code: \"{text}\" does not start with the name of a code"),
            Some("write \"eurocode_8_2004, ag=0.25 g, ground_type=B\" or \"asce_7_2016, s_ds=1 g, s_d1=0.6 g, t_l=8 s\"".to_owned()),
        ));
    }
    if words.has("damping") {
        return Err(Failure::input(
            format!("--code: \"{text}\" has a damping ratio"),
            Some("give it as --damping, which holds for records and code alike".to_owned()),
        ));
    }
    let mut keys = words.pairs_as_toml();
    keys.insert(0, format!("code = {}", quoted(words.word)));
    keys.push(format!("damping = {damping:?}"));
    let line = format!("process = [{{ scale = {{ {} }} }}]", keys.join(", "));
    let (read, _) = pounding_case::process_steps(&line, "code")
        .map_err(|e| Failure::input(format!("--code: {}", e.message), e.help))?;
    let target = read.first().and_then(|step| step.value.target());
    let target = target.map(|band| &band.spectrum);
    match target {
        Some(SpectrumSource::Code(code)) => Ok(code.value),
        _ => Err(Failure::input(
            format!("--code: \"{text}\" is no code"),
            None,
        )),
    }
}
