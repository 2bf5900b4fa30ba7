//! `pounding motion match`: a motion brought to a design spectrum.

use pounding_case::Dimension;
use pounding_ground_motion::matching::{
    MatchOptions, match_by_fourier_amplitudes, match_by_wavelets,
};
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_report::pictures::motion::matched as picture;

use super::code::{code_spectrum, warn_of_parameters};
use super::{reading, writing};
use crate::arguments::{MatchArguments, MatchMethod, OutputArguments};
use crate::arguments::{ascending, value};
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::plot;
use crate::progress::Progress;

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
    ascending(("from", options.from), ("to", options.to), "s")?;
    let record = reading::acceleration(&arguments.file, &arguments.read)?;
    let progress = Progress::working(format!("matching {}", arguments.file.display()))?;
    let matched = match arguments.method {
        MatchMethod::Wavelets => match_by_wavelets(&record, &target, options)?,
        MatchMethod::FourierAmplitudes => match_by_fourier_amplitudes(&record, &target, options)?,
    };
    drop(progress);
    let motion = &matched.accelerogram;
    have_a_place([Some(&*arguments.output.output)])?;
    if let Some(path) = &arguments.output.svg {
        let band = (options.from, options.to);
        let drawn = plot::of_motion(picture(&record, motion, &target, band))?;
        plot::write_drawn(path, drawn, &arguments.output.figure)?;
    }
    let title = format!("{}, matched to a spectrum", arguments.file.display());
    let without_picture = OutputArguments {
        svg: None,
        ..arguments.output.clone()
    };
    let more = writing::Matched {
        misfit: matched.misfit,
        method: matched.steps.first().map(|s| &*s.step),
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
        (None, Some(text)) => {
            let spectrum = code_spectrum(text, damping)?;
            warn_of_parameters(&spectrum);
            Ok(spectrum.target()?)
        }
        (None, None) => Err(Failure::input("no spectrum is given", None)),
    }
}
