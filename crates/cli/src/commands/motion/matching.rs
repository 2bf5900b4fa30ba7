//! `pounding motion match`: a motion brought to a design spectrum.

use pounding_case::Dimension;
use pounding_ground_motion::matching::{
    MatchOptions, match_by_fourier_amplitudes, match_by_wavelets,
};
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_ground_motion::spectra::design::{
    Asce7Of2016, Eurocode8Of2004, GroundType, SpectrumType,
};
use pounding_report::pictures::motion::matched as picture;

use super::words::Words;
use super::{reading, words, writing};
use crate::arguments::value;
use crate::arguments::{MatchArguments, MatchMethod, OutputArguments};
use crate::failure::Failure;
use crate::plot;

/// Matches, writes, and says how near the result is.
pub fn matching(arguments: &MatchArguments) -> Result<(), Failure> {
    let target = target(arguments)?;
    let options = MatchOptions {
        from: value(&arguments.from, "from", Dimension::TIME)?,
        to: value(&arguments.to, "to", Dimension::TIME)?,
        periods: arguments.periods,
        tolerance: value(&arguments.tolerance, "tolerance", Dimension::NUMBER)?,
        iterations: arguments.iterations,
    };
    words::ascending(("from", options.from), ("to", options.to), "s")?;
    let record = reading::acceleration(&arguments.file, &arguments.read)?;
    let matched = match arguments.method {
        MatchMethod::Wavelets => match_by_wavelets(&record, &target, options)?,
        MatchMethod::FourierAmplitudes => match_by_fourier_amplitudes(&record, &target, options)?,
    };
    let motion = &matched.accelerogram;
    if let Some(path) = &arguments.output.svg {
        let band = (options.from, options.to);
        plot::write_drawn(path, picture(&record, motion, &target, band))?;
    }
    let title = format!("{}, matched to a spectrum", arguments.file.display());
    let without_picture = OutputArguments {
        svg: None,
        ..arguments.output.clone()
    };
    let more = writing::Matched {
        misfit: matched.misfit,
        method: matched.steps.first().map(|s| s.step),
        damping: target.damping(),
        svg: arguments.output.svg.as_deref(),
    };
    writing::finish(&without_picture, motion, &title, Some(more))
}

/// The spectrum of a file or of a code.
fn target(arguments: &MatchArguments) -> Result<TargetSpectrum, Failure> {
    let damping = value(&arguments.damping, "damping", Dimension::NUMBER)?;
    match (&arguments.target, &arguments.code) {
        (Some(path), _) => Ok(TargetSpectrum::read(path, damping)?),
        (None, Some(text)) => code(text, damping),
        (None, None) => Err(Failure::input("no spectrum is given", None)),
    }
}

/// The spectrum of a code from its words.
fn code(text: &str, damping: f64) -> Result<TargetSpectrum, Failure> {
    let words = Words::of("code", text)?;
    let acceleration = |key| words.value(key, Dimension::ACCELERATION);
    match words.word {
        "eurocode_8_2004" => {
            words.only(&["ag", "ground", "type"])?;
            let spectrum = Eurocode8Of2004 {
                ground_acceleration: acceleration("ag")?,
                ground: ground_type(words.text("ground")?)?,
                spectrum: match words.text("type")? {
                    "1" => SpectrumType::Type1,
                    "2" => SpectrumType::Type2,
                    other => return Err(unknown("type", other, "1 or 2")),
                },
                damping,
            };
            Ok(spectrum.target()?)
        }
        "asce_7_2016" => {
            words.only(&["sds", "sd1", "tl"])?;
            if (damping - 0.05).abs() > 1.0e-12 {
                return Err(Failure::input(
                    "the spectrum of asce_7_2016 is for a damping ratio of 5 %",
                    Some("leave --damping out, or give a table with --target".to_owned()),
                ));
            }
            let spectrum = Asce7Of2016 {
                short_period: acceleration("sds")?,
                one_second: acceleration("sd1")?,
                long_transition: words.value("tl", Dimension::TIME)?,
            };
            Ok(spectrum.target()?)
        }
        other => Err(unknown("code", other, "eurocode_8_2004 or asce_7_2016")),
    }
}

fn ground_type(word: &str) -> Result<GroundType, Failure> {
    GroundType::from_name(word).ok_or_else(|| unknown("ground", word, "A, B, C, D or E"))
}

fn unknown(what: &str, word: &str, known: &str) -> Failure {
    Failure::input(
        format!("--code: {what} cannot be \"{word}\""),
        Some(format!("write {known}")),
    )
}
