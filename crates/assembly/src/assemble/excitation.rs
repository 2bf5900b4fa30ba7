//! The record of a case: read, processed and scaled as the case says.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use pounding_case::{
    BandSource, Case, CaseError, GivenFiles, GroundMotion, Located, SpectrumSource,
};
use pounding_ground_motion::processing::{
    BandTarget, ProcessingStep, Scale, along_a_row, distinct, process, rotate,
};
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, Format, GroundMotionError, Quantity, ReadOptions,
};

use super::band::{band_of_case, band_without_case};
use crate::error::AssemblyError;

/// The ground acceleration of a case.
pub(super) fn accelerogram(
    case: &Case,
    files: &RecordFiles,
) -> Result<Accelerogram, AssemblyError> {
    scale_record(case, read(case, &case.ground_motion, files)?)
}

/// A record beside that of the case, as one building has it for itself: read, processed and
/// scaled.
///
/// # Errors
/// An unknown unit or format, with its place in the case, or a record that cannot be read,
/// processed or scaled.
pub fn further_record(case: &Case, motion: &GroundMotion) -> Result<Accelerogram, AssemblyError> {
    let made =
        read(case, motion, &RecordFiles::default()).and_then(|record| scaled(case, motion, record));
    made.map_err(|e| match e {
        // The case names several files: the place says which.
        AssemblyError::GroundMotion(e) => {
            let place = motion.span_of(e.option().unwrap_or("file"));
            case.error(place, e.to_string(), e.help()).into()
        }
        e => e,
    })
}

/// Reads and processes the record of a case; its scale is not applied.
///
/// # Errors
/// An unknown unit or format, with its place in the case, or a record that cannot be
/// read or processed.
pub fn read_record(case: &Case) -> Result<Accelerogram, AssemblyError> {
    read(case, &case.ground_motion, &RecordFiles::default())
}

/// Record files as they were read, for many cases that name the same: a file is read once
/// with the same options, and processed and scaled for each case.
#[derive(Debug, Default)]
pub struct RecordFiles(Mutex<Vec<(PathBuf, ReadOptions, Accelerogram)>>);

impl RecordFiles {
    /// The record of a file that a case names, which is read if it was not yet.
    fn read(
        &self,
        case: &Case,
        path: &Path,
        options: &ReadOptions,
    ) -> Result<Accelerogram, AssemblyError> {
        // Files that were given with a case are those of that case alone.
        if case.given(path).is_some() {
            return Ok(read_file(case, path, options)?);
        }
        let file = case.resolve(path);
        // Who panicked while reading left what was read before.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same = known.iter().find(|(f, o, _)| *f == file && o == options);
        if let Some((_, _, record)) = same {
            return Ok(record.clone());
        }
        let record = read_file(case, path, options)?;
        known.push((file, options.clone(), record.clone()));
        Ok(record)
    }
}

fn read(
    case: &Case,
    motion: &GroundMotion,
    files: &RecordFiles,
) -> Result<Accelerogram, AssemblyError> {
    let options = read_options(case, motion)?;
    let mut record = files.read(case, &motion.file.value, &options)?;
    if let Some(rotation) = &motion.rotation {
        let second = ReadOptions {
            component: Some(rotation.second_component.value.clone()),
            ..options
        };
        let other = files.read(case, &motion.file.value, &second);
        let other = other.map_err(of_second)?;
        let place = |e: &GroundMotionError| match e {
            // What the angle is, not what the components are.
            GroundMotionError::OutOfRange { .. } => motion.span_of("rotate"),
            _ => rotation.second_component.span.clone(),
        };
        record = rotate(&record, &other, rotation.angle)
            .and_then(|pair| distinct(&record, &other).map(|()| pair))
            .map_err(|e| case.error(place(&e), e.to_string(), e.help()))?
            .first;
    }
    processed(case, motion, record)
}

/// An error of the component that was chosen, as one of the second component.
fn of_second(error: AssemblyError) -> AssemblyError {
    match error {
        AssemblyError::GroundMotion(error) if error.option() == Some("component") => {
            error.of_option("second_component").into()
        }
        error => error,
    }
}

/// Does the steps that a case asks for on every record without steps of its own.
///
/// # Errors
/// A target spectrum that cannot be read, or a step that the record does not allow.
pub fn process_record(case: &Case, record: Accelerogram) -> Result<Accelerogram, AssemblyError> {
    processed(case, &case.ground_motion, record)
}

fn processed(
    case: &Case,
    motion: &GroundMotion,
    mut record: Accelerogram,
) -> Result<Accelerogram, AssemblyError> {
    for step in &motion.process {
        let refused = |e: GroundMotionError| case.error(step.span.clone(), e.to_string(), e.help());
        let made = step.value.with_target(|band| target(case, band))?;
        record = process(&record, &[made]).map_err(refused)?.accelerogram;
    }
    Ok(along_a_row(record))
}

/// Reads a record that the case names.
fn read_file(
    case: &Case,
    path: &Path,
    options: &ReadOptions,
) -> Result<Accelerogram, GroundMotionError> {
    let file = case.resolve(path);
    let Some(given) = case.given(path) else {
        return pounding_ground_motion::read(&file, options);
    };
    let file = file.display().to_string();
    match given {
        Ok(bytes) => pounding_ground_motion::read_bytes(&file, bytes, options),
        Err(source) => Err(GroundMotionError::Io { file, source }),
    }
}

/// Applies the scale of a case to a record.
///
/// # Errors
/// A target spectrum that cannot be read, or a scale that the record does not allow.
pub fn scale_record(case: &Case, record: Accelerogram) -> Result<Accelerogram, AssemblyError> {
    scaled(case, &case.ground_motion, record)
}

fn scaled(
    case: &Case,
    motion: &GroundMotion,
    record: Accelerogram,
) -> Result<Accelerogram, AssemblyError> {
    let Some(scale) = &motion.scale else {
        return Ok(record);
    };
    let made = scale.value.with_target(|band| target(case, band))?;
    let refused = |e| match e {
        // What the scale asks for, not what the record is.
        GroundMotionError::OutOfRange { .. } => {
            let place = scale.span.clone();
            AssemblyError::Case(case.error(place, e.to_string(), e.help()))
        }
        error => error.into(),
    };
    // Nobody could tell the factor of a band from the case: it is noted.
    if made.target().is_some() {
        let scaled = process(&record, &[ProcessingStep::Scale(made)]);
        return Ok(scaled.map_err(refused)?.accelerogram);
    }
    let factor = made.factor(&record).map_err(refused)?;
    Ok(record.scaled_by(factor)?)
}

/// The spectrum to which a case scales its record, with the band of periods; `None` if it does
/// not scale to one.
///
/// # Errors
/// A file that cannot be read or is no spectrum, or parameters out of range: with the place in
/// the case.
pub fn scale_target(case: &Case) -> Result<Option<BandTarget>, CaseError> {
    match case.ground_motion.scale.as_ref().map(|s| &s.value) {
        Some(Scale::Band(band)) => Ok(Some(target(case, band)?)),
        _ => Ok(None),
    }
}

/// The band that a scale of the case names, with its spectrum.
fn target(case: &Case, band: &BandSource) -> Result<BandTarget, CaseError> {
    let place = match &band.spectrum {
        SpectrumSource::File(spectrum) => spectrum.file.span.clone(),
        SpectrumSource::Code(code) => code.span.clone(),
    };
    let made = match (&band.spectrum, case.given_files.as_ref()) {
        (SpectrumSource::File(spectrum), Some(given)) => {
            given_target(case, given, &spectrum.file.value, spectrum.damping)
        }
        (spectrum, _) => read_spectrum(spectrum, |path| case.resolve(path)),
    };
    let spectrum = made.map_err(|e| case.error(place.clone(), e.to_string(), e.help()))?;
    band_of_case(case, band, spectrum, place)
}

/// The spectrum in a file that was given with the case.
fn given_target(
    case: &Case,
    given: &GivenFiles,
    path: &Path,
    damping: f64,
) -> Result<TargetSpectrum, GroundMotionError> {
    let file = case.resolve(path).display().to_string();
    // As a file on a disk is read.
    let unreadable = |source| GroundMotionError::Io {
        file: file.clone(),
        source,
    };
    let bytes = given.read(path).map_err(unreadable)?;
    let text = std::str::from_utf8(bytes)
        .map_err(|_| unreadable(io::Error::new(io::ErrorKind::InvalidData, NOT_TEXT)))?;
    TargetSpectrum::parse(&file, text, damping)
}

/// What the standard library says of a file that is no text.
const NOT_TEXT: &str = "stream did not contain valid UTF-8";

/// Makes or reads the spectrum that a step names beside no case, with its band of periods, which
/// without buildings is fixed. `resolve` finds its file.
///
/// # Errors
/// A file that cannot be read, or is no spectrum; parameters of a code out of range.
pub fn read_target(
    band: &BandSource,
    resolve: impl Fn(&Path) -> PathBuf,
) -> Result<BandTarget, GroundMotionError> {
    Ok(band_without_case(
        band,
        read_spectrum(&band.spectrum, resolve)?,
    ))
}

/// Makes or reads a spectrum.
fn read_spectrum(
    spectrum: &SpectrumSource,
    resolve: impl Fn(&Path) -> PathBuf,
) -> Result<TargetSpectrum, GroundMotionError> {
    match spectrum {
        SpectrumSource::File(spectrum) => {
            TargetSpectrum::read(&resolve(&spectrum.file.value), spectrum.damping)
        }
        SpectrumSource::Code(code) => code.value.target(),
    }
}

fn read_options(case: &Case, motion: &GroundMotion) -> Result<ReadOptions, CaseError> {
    Ok(ReadOptions {
        format: known(case, motion.format.as_ref(), format)?,
        time_step: motion.time_step,
        unit: known(case, motion.unit.as_ref(), |text| {
            text.parse::<AccelerationUnit>()
                .map_err(|e| (e.to_string(), e.help()))
        })?,
        layout: motion.layout.clone(),
        component: motion.component.clone(),
        quantity: known(case, motion.quantity.as_ref(), acceleration)?,
        skip_lines: motion.skip_lines,
        skip_columns: motion.skip_columns,
        prepend_zero: motion.prepend_zero,
        lenient: motion.lenient,
        sensitivity: motion.sensitivity,
        response: motion.response.as_ref().map(|r| case.resolve(&r.value)),
        gravity: motion.gravity,
        offset: motion.offset,
    })
}

type Refused = (String, Option<String>);

/// The meaning of a word, or an error at its place.
fn known<T>(
    case: &Case,
    word: Option<&Located<String>>,
    meaning: impl Fn(&str) -> Result<T, Refused>,
) -> Result<Option<T>, CaseError> {
    word.map(|w| {
        meaning(&w.value).map_err(|(message, help)| case.error(w.span.clone(), message, help))
    })
    .transpose()
}

fn format(name: &str) -> Result<&'static Format, Refused> {
    Format::find(name).map_err(|e| (e.to_string(), e.help()))
}

/// Buildings are excited by an acceleration and by nothing else.
fn acceleration(name: &str) -> Result<Quantity, Refused> {
    match Quantity::from_name(name) {
        Some(Quantity::Acceleration) => Ok(Quantity::Acceleration),
        Some(other) => Err((
            format!("a {other} cannot excite the buildings"),
            Some("use the acceleration of the same record".to_owned()),
        )),
        None => Err((
            format!("unknown quantity \"{name}\""),
            Some("the quantity of an excitation is acceleration".to_owned()),
        )),
    }
}
