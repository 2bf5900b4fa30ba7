//! `pounding motion info`: all that a file holds.

use std::path::Path;

use pounding_case::Dimension;
use pounding_catalogue::wording::counted;
use pounding_ground_motion::measures::{IntensityMeasures, MeasureOptions};
use pounding_ground_motion::spectra::{
    Evaluation, SMOOTH, USUAL_DAMPING, logarithmic_periods, response_spectrum,
};
use pounding_ground_motion::{
    Offset, Quantity, ReadOptions, Recording, Sampling, Series, read_all,
};
use pounding_report::page::Picture;
use pounding_report::pictures::motion::{Named, histories, over_period};
use pounding_report::{Answered, AnsweredCommand, Chart, Curve, Panel};

use super::info_output::{Files, Shown, ShownFile, as_text, comma_separated};
use super::reading;
use crate::arguments::InfoArguments;
use crate::arguments::value;
use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::progress::Progress;
use crate::tables::G;
use crate::{page, plot};

/// Periods of spectra on the page: first and last (s).
const PERIODS: (f64, f64) = (0.02, 5.0);
/// Files that are named below the title.
const NAMED: usize = 5;

/// Shows every series of the files.
pub fn info(arguments: &InfoArguments) -> Result<(), Failure> {
    let mut read = reading::options(&arguments.read, Offset::Automatic)?;
    let measured = MeasureOptions {
        evaluation: if arguments.at_samples {
            Evaluation::AtSamples
        } else {
            Evaluation::PiecewiseLinear
        },
        duration_threshold: value(
            &arguments.duration_threshold,
            "duration-threshold",
            Dimension::ACCELERATION,
        )?,
        damping: value(&arguments.damping, "damping", Dimension::NUMBER)?,
        ..MeasureOptions::default()
    };
    let component = read.component.take();
    let (mut files, mut wrong) = (Vec::new(), Vec::new());
    let options = ReadOptions {
        component,
        ..read.clone()
    };
    let progress = Progress::working(format!(
        "measuring {}",
        counted(arguments.files.len(), "record")
    ))?;
    for file in &arguments.files {
        let recording = read_all(file, &read).map_err(Failure::from);
        match recording.and_then(|recording| shown(file, recording, &options, measured)) {
            Ok(shown) => files.push(shown),
            // The others are shown nevertheless.
            Err(Failure::Input(report)) => wrong.push(report),
            Err(failure) => return Err(failure),
        }
    }
    if files.is_empty() {
        return Err(Failure::inputs(wrong));
    }
    if let Some(path) = &arguments.csv {
        plot::write(path, &comma_separated(&files))?;
    }
    if let Some(path) = &arguments.svg {
        let named = named(&files);
        if named.is_empty() {
            return Err(Failure::input(
                "there is no acceleration to draw",
                Some("give a file with an acceleration that is not zero".to_owned()),
            ));
        }
        plot::write_drawn(path, plot::of_motion(histories(&named))?, &arguments.figure)?;
    }
    page::write_answered(
        || answered(&files),
        arguments.output.as_deref(),
        arguments.report.as_deref(),
    )?;
    drop(progress);
    print(&if arguments.json {
        pretty(&Files::of(&files))?
    } else {
        as_text(&files)
    })?;
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(Failure::inputs(wrong))
    }
}

fn shown(
    file: &Path,
    recording: Recording,
    options: &ReadOptions,
    measured: MeasureOptions,
) -> Result<ShownFile, Failure> {
    let chosen = match &options.component {
        None => recording.series,
        // One component may have an acceleration, a velocity and a displacement.
        Some(_) => {
            let channel = recording.choose(options)?.channel;
            let all = recording.series.into_iter();
            all.filter(|s| s.channel == channel).collect()
        }
    };
    let series = chosen
        .into_iter()
        .map(|series| one(file, series, options, measured))
        .collect::<Result<_, _>>()?;
    Ok(ShownFile {
        file: file.display().to_string(),
        series,
    })
}

fn one(
    file: &Path,
    series: Series,
    options: &ReadOptions,
    measured: MeasureOptions,
) -> Result<Shown, Failure> {
    if series.quantity != Quantity::Acceleration {
        return Ok(Shown {
            series,
            record: None,
            measures: None,
        });
    }
    let mut options = options.clone();
    if let Sampling::Uneven { .. } = series.sampling {
        options
            .time_step
            .get_or_insert(series.sampling.median_step());
    }
    let record = series.accelerogram(&options)?;
    let start = series.initial.unwrap_or_default();
    let measured = MeasureOptions {
        initial_velocity: start.0,
        initial_displacement: start.1,
        ..measured
    };
    // A record of zeros has no durations.
    let measures = if record.peak().value > 0.0 {
        let of = IntensityMeasures::of(&record, measured);
        Some(of.map_err(|e| Failure::from(e).about(file))?)
    } else {
        None
    };
    Ok(Shown {
        series,
        record: Some(record),
        measures,
    })
}

/// Accelerations with their names in a picture.
fn named(files: &[ShownFile]) -> Vec<Named<'_>> {
    let mut named = Vec::new();
    for file in files {
        for one in &file.series {
            if let Some(record) = one.record.as_ref().filter(|_| one.measures.is_some()) {
                let name = match files.len() {
                    1 => one.series.component.clone(),
                    _ => format!("{} {}", file.file, one.series.component),
                };
                named.push(Named {
                    name,
                    record,
                    initial: one.series.initial.unwrap_or_default(),
                });
            }
        }
    }
    named
}

/// What the page of all series shows.
fn answered(files: &[ShownFile]) -> Result<Answered, Failure> {
    let named = named(files);
    let mut drawn = Vec::new();
    if !named.is_empty() {
        let words = "Acceleration, velocity, displacement and Husid curve over time";
        let histories = plot::of_motion(histories(&named))?;
        drawn.push(Picture::of("histories", words, histories));
        drawn.push(Picture::of("spectra", "Response spectra", spectra(&named)?));
    }
    let names: Vec<&str> = files.iter().map(|f| f.file.as_str()).collect();
    let (names, title) = match names.len() {
        1 => (names[0].to_owned(), String::new()),
        count @ ..=NAMED => (names.join(", "), format!("{count} records")),
        count => (
            format!("{} and {} more", names[..NAMED].join(", "), count - NAMED),
            format!("{count} records"),
        ),
    };
    Ok(Answered {
        command: AnsweredCommand::MotionInfo,
        inputs: page::inputs("motion info", &title, Path::new(&names)),
        answer: page::answer(&Files::of(files))?,
        figures: drawn,
    })
}

/// Pseudo-acceleration of motions over the period.
fn spectra(named: &[Named<'_>]) -> Result<Chart, Failure> {
    let periods = logarithmic_periods(PERIODS.0, PERIODS.1, SMOOTH)?;
    let mut curves = Vec::new();
    for motion in named {
        let linear = Evaluation::PiecewiseLinear;
        let spectrum = response_spectrum(motion.record, &periods, USUAL_DAMPING, linear)?;
        let values = spectrum.pseudo_acceleration.iter().map(|a| a / G);
        curves.push(Curve {
            name: motion.name.clone(),
            points: periods.iter().copied().zip(values).collect(),
        });
    }
    let panel = Panel {
        caption: "Pseudo-acceleration (g), 5 % damping".to_owned(),
        horizontal: "period (s)".to_owned(),
        curves,
    };
    Ok(over_period(&[panel]))
}
