//! The record of a case: read, processed and scaled as the case says.

use std::path::Path;

use pounding_case::{BaselineKind, Case, CaseError, Located, ProcessStep, RemovedOffset, Scale};
use pounding_ground_motion::processing::{
    Baseline, Butterworth, Interpolation, OffsetCorrection, Phase, ProcessingStep, SegmentWindow,
    Trim, process, rotate,
};
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, Format, GroundMotionError, Offset, Quantity, ReadOptions,
    processing,
};

use crate::error::AssemblyError;

/// The ground acceleration of a case.
pub(crate) fn accelerogram(case: &Case) -> Result<Accelerogram, AssemblyError> {
    scale_record(case, read_record(case)?)
}

/// Reads and processes the record of a case; its scale is not applied.
///
/// # Errors
/// An unknown unit or format, with its place in the case, or a record that cannot be
/// read or processed.
pub fn read_record(case: &Case) -> Result<Accelerogram, AssemblyError> {
    let motion = &case.ground_motion;
    let options = read_options(case)?;
    let file = case.resolve(&motion.file.value);
    let mut record = pounding_ground_motion::read(&file, &options)?;
    if let Some(rotation) = &motion.rotation {
        let second = ReadOptions {
            component: Some(rotation.second_component.value.clone()),
            ..options
        };
        let other = pounding_ground_motion::read(&file, &second)?;
        let span = rotation.second_component.span.clone();
        record = rotate(&record, &other, rotation.angle)
            .map_err(|e| case.error(span, e.to_string(), e.help()))?
            .first;
    }
    for step in &motion.process {
        let refused = |e: GroundMotionError| case.error(step.span.clone(), e.to_string(), e.help());
        let made = processing_step(&step.value, &|path| case.resolve(path)).map_err(refused)?;
        record = process(&record, &[made]).map_err(refused)?.accelerogram;
    }
    Ok(record)
}

/// Applies the scale of a case to a record.
///
/// # Errors
/// A target spectrum that cannot be read, or a scale that the record does not allow.
pub fn scale_record(case: &Case, record: Accelerogram) -> Result<Accelerogram, AssemblyError> {
    let folder = |path: &Path| case.resolve(path);
    match scale_of(&case.ground_motion.scale, &folder)? {
        None => Ok(record),
        Some(scale) => {
            let factor = scale.factor(&record)?;
            Ok(record.scaled_by(factor)?)
        }
    }
}

/// A step of processing from its words. `resolve` finds files that it names.
///
/// # Errors
/// An unknown unit, or a target spectrum that cannot be read.
pub fn processing_step(
    step: &ProcessStep,
    resolve: &dyn Fn(&Path) -> std::path::PathBuf,
) -> Result<ProcessingStep, GroundMotionError> {
    Ok(match step {
        ProcessStep::Unit(unit) => ProcessingStep::Unit(unit.value.parse()?),
        ProcessStep::ReverseSign => ProcessingStep::Sign,
        ProcessStep::RemoveOffset(offset) => ProcessingStep::Offset(match offset {
            RemovedOffset::Mean => OffsetCorrection::Mean,
            RemovedOffset::PreEventMean(length) => OffsetCorrection::PreEventMean(*length),
            RemovedOffset::Value(value) => OffsetCorrection::Value(*value),
        }),
        ProcessStep::Filter {
            order,
            high_pass,
            low_pass,
            causal,
            keep_pads,
        } => ProcessingStep::Filter(Butterworth {
            order: *order,
            high_pass: *high_pass,
            low_pass: *low_pass,
            phase: if *causal {
                Phase::Causal
            } else {
                Phase::Zero {
                    keep_pads: *keep_pads,
                }
            },
        }),
        ProcessStep::Baseline(kind) => ProcessingStep::Baseline(baseline(*kind)),
        ProcessStep::TrimTimes { start, end } => ProcessingStep::Trim(Trim::Times {
            start: *start,
            end: *end,
        }),
        ProcessStep::TrimArias { from, to } => ProcessingStep::Trim(Trim::Arias {
            from: *from,
            to: *to,
        }),
        ProcessStep::Taper { start, end } => ProcessingStep::Taper {
            start: *start,
            end: *end,
        },
        ProcessStep::Pad { before, after } => ProcessingStep::Pad {
            before: *before,
            after: *after,
        },
        ProcessStep::Resample {
            time_step,
            band_limited,
        } => ProcessingStep::Resample {
            time_step: *time_step,
            interpolation: if *band_limited {
                Interpolation::BandLimited
            } else {
                Interpolation::Linear
            },
        },
        ProcessStep::Scale(scale) => ProcessingStep::Scale(
            scale_of(scale, resolve)?.unwrap_or(processing::Scale::Factor(1.0)),
        ),
    })
}

fn baseline(kind: BaselineKind) -> Baseline {
    match kind {
        BaselineKind::Acceleration(degree) => Baseline::Acceleration { degree },
        BaselineKind::Velocity(degree) => Baseline::Velocity { degree },
        BaselineKind::Segments {
            start,
            end,
            fit_from,
        } => Baseline::TwoSegments {
            window: SegmentWindow::Times { start, end },
            fit_from,
        },
        BaselineKind::Threshold {
            threshold,
            fit_from,
        } => Baseline::TwoSegments {
            window: SegmentWindow::Threshold(threshold),
            fit_from,
        },
    }
}

fn scale_of(
    scale: &Scale,
    resolve: &dyn Fn(&Path) -> std::path::PathBuf,
) -> Result<Option<processing::Scale>, GroundMotionError> {
    Ok(Some(match scale {
        Scale::None => return Ok(None),
        Scale::Factor(factor) => processing::Scale::Factor(*factor),
        Scale::PeakGroundAcceleration(peak) => processing::Scale::PeakAcceleration(*peak),
        Scale::PeakGroundVelocity(peak) => processing::Scale::PeakVelocity(*peak),
        Scale::SpectralAcceleration {
            acceleration,
            period,
            damping,
        } => processing::Scale::SpectralAcceleration {
            period: *period,
            damping: *damping,
            target: *acceleration,
        },
        Scale::Band {
            target,
            from,
            to,
            damping,
        } => processing::Scale::Band {
            target: TargetSpectrum::read(&resolve(&target.value), *damping)?,
            from: *from,
            to: *to,
        },
    }))
}

fn read_options(case: &Case) -> Result<ReadOptions, CaseError> {
    let motion = &case.ground_motion;
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
        gravity: motion.gravity,
        offset: match motion.offset {
            pounding_case::Offset::Automatic => Offset::Automatic,
            pounding_case::Offset::Keep => Offset::Keep,
            pounding_case::Offset::Remove => Offset::Remove,
        },
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
