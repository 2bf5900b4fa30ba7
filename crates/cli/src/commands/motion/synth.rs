//! `pounding motion synth`: a motion from a formula and a seed.

use pounding_ground_motion::generators::Generated;
use pounding_time_history::Warning;

use super::{generators, writing};
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
