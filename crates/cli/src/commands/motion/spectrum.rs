//! `pounding motion spectrum`: responses, all directions, Fourier amplitudes.

use std::path::Path;

use pounding_case::Dimension;
use pounding_catalogue::numbers::six_digits;
use pounding_catalogue::wording::counted;
use pounding_ground_motion::processing::distinct;
use pounding_ground_motion::spectra::{
    Evaluation, ResponseSpectrum, RotatedSpectrum, SMOOTH, fourier_spectrum, logarithmic_periods,
    response_spectra, rotated_spectrum,
};
use pounding_report::pictures::motion;
use serde::Serialize;

use super::code::warn_of_parameters;
use super::reading;
use super::spectrum_of_code::{self, OfCode};
use super::spectrum_places::{named, places};
use super::spectrum_tables as tables;
use crate::arguments::{SpectrumArguments, list, once, value};
use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::plot;
use crate::progress::Progress;

/// Periods (s) or frequencies (Hz) where none are given: first, last, how many.
const PERIODS: (f64, f64, usize) = (0.05, 4.0, 30);
const FREQUENCIES: (f64, f64, usize) = (0.1, 25.0, 30);

/// What `--json` prints of one record.
#[derive(Serialize)]
struct OfRecord<T> {
    #[serde(flatten)]
    results: T,
    record: Vec<String>,
}

/// Response spectra, by damping ratio.
#[derive(Serialize)]
struct Spectra {
    spectra: Vec<ResponseSpectrum>,
    /// Of the code, for each damping ratio.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    codes: Vec<OfCode>,
}

/// A spectrum of Fourier amplitudes.
#[derive(Serialize)]
struct Fourier {
    frequencies: Vec<f64>,
    amplitudes: Vec<f64>,
    smoothing: String,
    length: f64,
}

/// What `--json` prints of two components.
#[derive(Serialize)]
struct OfTwo {
    spectra: Vec<RotatedSpectrum>,
    records: [Vec<String>; 2],
}

/// One kind of spectrum.
pub fn spectrum(arguments: &SpectrumArguments) -> Result<(), Failure> {
    let Some(file) = &arguments.file else {
        return spectrum_of_code::alone(arguments);
    };
    let progress = Progress::working(format!("computing the spectrum of {}", file.display()))?;
    let text = if arguments.fourier {
        fourier(arguments, file)
    } else if arguments.rotated {
        rotated(arguments, file)
    } else {
        responses(arguments, file)
    }?;
    drop(progress);
    print(&text)
}

fn evaluation(arguments: &SpectrumArguments) -> Evaluation {
    if arguments.at_samples {
        Evaluation::AtSamples
    } else {
        Evaluation::PiecewiseLinear
    }
}

fn responses(arguments: &SpectrumArguments, file: &Path) -> Result<String, Failure> {
    let periods = places(arguments, PERIODS, Dimension::TIME)?;
    let dampings = list(&arguments.damping, "damping", Dimension::NUMBER)?;
    once("damping", &dampings, "")?;
    let record = reading::acceleration(file, &arguments.read)?;
    let spectra = response_spectra(&record, &periods, &dampings, evaluation(arguments))
        .map_err(|e| named(e, arguments))?;
    let codes = spectrum_of_code::beside(arguments, &periods, &dampings)?;
    codes.iter().take(1).for_each(warn_of_parameters);
    if let Some(path) = &arguments.csv {
        plot::write(path, &tables::response_csv(&spectra, &codes))?;
    }
    if let Some(path) = &arguments.svg {
        // A picture is smooth unless its places are given.
        let smooth = arguments.at.is_none() && arguments.count.is_none();
        let drawn = if smooth {
            let ends = (periods[0], periods[periods.len() - 1]);
            let many =
                logarithmic_periods(ends.0, ends.1, SMOOTH).map_err(|e| named(e, arguments))?;
            response_spectra(&record, &many, &dampings, evaluation(arguments))
                .map_err(|e| named(e, arguments))?
        } else {
            spectra.clone()
        };
        let drawn = motion::responses_and_codes(&drawn, &codes);
        plot::write_drawn(path, drawn, &arguments.figure)?;
    }
    Ok(if arguments.json {
        pretty(&OfRecord {
            results: Spectra {
                spectra,
                codes: codes
                    .iter()
                    .map(|code| OfCode::of(code, &periods))
                    .collect(),
            },
            record: record.echo(),
        })?
    } else {
        format!(
            "{}{}",
            reading::reported(&record),
            tables::response_text(&spectra, &codes)
        )
    })
}

fn rotated(arguments: &SpectrumArguments, file: &Path) -> Result<String, Failure> {
    let periods = places(arguments, PERIODS, Dimension::TIME)?;
    let dampings = list(&arguments.damping, "damping", Dimension::NUMBER)?;
    once("damping", &dampings, "")?;
    if arguments.second_file.is_none() && arguments.second_component.is_none() {
        return Err(Failure::input(
            "--rotated needs two components",
            Some("give --component with --second-component, or --second-file".to_owned()),
        ));
    }
    let first = reading::acceleration(file, &arguments.read)?;
    let mut read = arguments.read.clone();
    read.component.clone_from(&arguments.second_component);
    let second = arguments.second_file.as_deref().unwrap_or(file);
    let second = reading::acceleration(second, &read)?;
    distinct(&first, &second)?;
    let spectra = dampings
        .iter()
        .map(|d| rotated_spectrum(&first, &second, &periods, *d, evaluation(arguments)))
        .collect::<Result<Vec<RotatedSpectrum>, _>>()
        .map_err(|e| named(e, arguments))?;
    if let Some(path) = &arguments.csv {
        plot::write(path, &tables::rotated_csv(&spectra))?;
    }
    if let Some(path) = &arguments.svg {
        plot::write_drawn(path, motion::rotated(&spectra), &arguments.figure)?;
    }
    Ok(if arguments.json {
        pretty(&OfTwo {
            spectra,
            records: [first.echo(), second.echo()],
        })?
    } else {
        // Of the components, whatever the damping.
        let warnings = spectra.first().map_or(&[][..], |s| &s.warnings);
        format!(
            "{}{}{}{}",
            reading::reported(&first),
            reading::reported(&second),
            reading::warned(warnings),
            tables::rotated_text(&spectra)
        )
    })
}

fn fourier(arguments: &SpectrumArguments, file: &Path) -> Result<String, Failure> {
    let record = reading::acceleration(file, &arguments.read)?;
    let whole = fourier_spectrum(&record, 0);
    let (frequencies, amplitudes, how) = if arguments.unsmoothed {
        let how = "not smoothed".to_owned();
        (whole.frequencies, whole.amplitudes, how)
    } else {
        let bandwidth = value(&arguments.smoothing, "smoothing", Dimension::NUMBER)?;
        let (first, highest) = whole.range();
        let is_chosen =
            arguments.at.is_some() || arguments.from.is_some() || arguments.to.is_some();
        if !is_chosen && first >= FREQUENCIES.1.min(highest) {
            return Err(Failure::input(
                format!(
                    "the record of {} is too short for a smoothed spectrum: its frequencies start at {} Hz, one over the number of samples times the step of {} s",
                    counted(record.samples().len(), "sample"),
                    six_digits(first),
                    six_digits(record.time_step())
                ),
                Some("put zeros behind it, `pounding motion process FILE --pad \"after=10 s\" -o FILE.csv`, or give --unsmoothed".to_owned()),
            ));
        }
        let default = (
            FREQUENCIES.0.max(first),
            FREQUENCIES.1.min(highest),
            FREQUENCIES.2,
        );
        let centres = places(arguments, default, Dimension::FREQUENCY)?;
        let amplitudes = whole
            .konno_ohmachi(&centres, bandwidth)
            .map_err(|e| named(e, arguments))?;
        (
            centres,
            amplitudes,
            format!("Konno and Ohmachi (1998), b = {bandwidth}"),
        )
    };
    if let Some(path) = &arguments.csv {
        plot::write(path, &tables::fourier_csv(&frequencies, &amplitudes))?;
    }
    if let Some(path) = &arguments.svg {
        let picture = motion::fourier(&how, &frequencies, &amplitudes);
        plot::write_drawn(path, picture, &arguments.figure)?;
    }
    Ok(if arguments.json {
        pretty(&OfRecord {
            results: Fourier {
                frequencies,
                amplitudes,
                smoothing: how,
                length: whole.length,
            },
            record: record.echo(),
        })?
    } else {
        let table = tables::fourier_text(&frequencies, &amplitudes, &how);
        format!("{}{table}", reading::reported(&record))
    })
}
