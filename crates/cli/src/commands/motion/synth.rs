//! `pounding motion synth`: a motion from a formula and a seed.

use pounding_case::Dimension;
use pounding_ground_motion::generators::{Envelope, Generated, TimeGrid};
use pounding_time_history::Warning;

use super::words::Words;
use super::{generators, writing};
use crate::arguments::value;
use crate::arguments::{Generator, GridArguments, SynthArguments};
use crate::failure::Failure;
use crate::output::warn;
use crate::progress::Progress;

/// Makes a motion and writes it.
pub fn synth(arguments: &SynthArguments) -> Result<(), Failure> {
    let progress = Progress::working("generating the motion".to_owned())?;
    let (made, grid) = match &arguments.generator {
        Generator::Sine(a) => (generators::sine(a)?, &a.grid),
        Generator::Ricker(a) => (generators::ricker(a)?, &a.grid),
        Generator::MavroeidisPapageorgiou(a) => (generators::velocity_pulse(a)?, &a.grid),
        Generator::MakrisRoussos(a) => (generators::trigonometric_pulse(a)?, &a.grid),
        Generator::KanaiTajimi(a) => (generators::kanai_tajimi(a)?, &a.seeded.grid),
        Generator::CloughPenzien(a) => (generators::clough_penzien(a)?, &a.seeded.grid),
        Generator::RezaeianDerKiureghian(a) => (generators::rezaeian(a)?, &a.seeded.grid),
        Generator::Boore(a) => (generators::boore(a)?, &a.seeded.grid),
    };
    drop(progress);
    finish(&made, grid)
}

fn finish(made: &Generated, grid: &GridArguments) -> Result<(), Failure> {
    let peak = made.accelerogram.peak().value.abs();
    if let Some(warning) = Warning::of_peak_ground_acceleration(peak) {
        warn(&warning.to_string());
    }
    let name = made.steps.first().map_or("motion", |s| &*s.step);
    let title = format!("Synthetic motion, {name}");
    writing::finish(&grid.output, &made.accelerogram, &title, None)
}

/// Time step and duration.
pub fn grid(arguments: &GridArguments) -> Result<TimeGrid, Failure> {
    Ok(TimeGrid {
        time_step: match &arguments.time_step {
            Some(text) => value(text, "time-step", Dimension::TIME)?,
            None => TimeGrid::USUAL_TIME_STEP,
        },
        duration: value(&arguments.duration, "duration", Dimension::TIME)?,
    })
}

/// An envelope from its words.
pub fn envelope(text: &str) -> Result<Envelope, Failure> {
    let words = Words::of("envelope", text)?;
    let time = |key| words.value(key, Dimension::TIME);
    let rate = |key| words.value(key, Dimension::FREQUENCY);
    let (known, envelope): (&[&str], _) = match words.word {
        "constant" => (&[], Envelope::Constant),
        "half_sine" => (&[], Envelope::HalfSine),
        "ramped" => (
            &["rise", "fall"],
            Envelope::Ramped {
                rise: time("rise")?,
                fall: time("fall")?,
            },
        ),
        "decay" => (
            &["rate"],
            Envelope::Decay {
                rate: rate("rate")?,
            },
        ),
        "jennings_housner_tsai_1968" => (
            &["rise", "strong_end", "decay"],
            Envelope::JenningsHousnerTsai1968 {
                rise: time("rise")?,
                strong_end: time("strong_end")?,
                decay: rate("decay")?,
            },
        ),
        "saragoni_hart_1974" => (
            &["power", "rate"],
            Envelope::SaragoniHart1974 {
                power: words.value("power", Dimension::NUMBER)?,
                rate: rate("rate")?,
            },
        ),
        "shinozuka_sato_1967" => (
            &["slow", "fast"],
            Envelope::ShinozukaSato1967 {
                slow: rate("slow")?,
                fast: rate("fast")?,
            },
        ),
        other => {
            return Err(Failure::input(
                format!("--envelope: \"{other}\" is not known"),
                Some(
                    "known: constant, half_sine, ramped, decay, jennings_housner_tsai_1968, saragoni_hart_1974, shinozuka_sato_1967"
                        .to_owned(),
                ),
            ));
        }
    };
    words.only(known)?;
    Ok(envelope)
}
