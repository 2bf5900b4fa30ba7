//! A synthetic or processed motion: its file, its figure, its report.

use std::path::Path;

use pounding_catalogue::numbers::six_digits;
use pounding_catalogue::wording::counted;
use pounding_ground_motion::matching::Misfit;
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{Accelerogram, Peak, StepRecord};
use pounding_report::pictures::motion::{Named, histories};
use serde::Serialize;

use crate::arguments::OutputArguments;
use crate::failure::Failure;
use crate::files::have_a_place;
use crate::output::{pretty, print};
use crate::plot;
use crate::tables::G;

/// Writes a motion in our layout; its title stands in for that of a record.
pub fn write(path: &Path, motion: &Accelerogram, title: &str) -> Result<(), Failure> {
    let mut written = Written::of(motion);
    if written.title.is_empty() {
        // The folder is that of one machine.
        let of_file = title.rsplit(['/', '\\']).next().unwrap_or(title);
        of_file.clone_into(&mut written.title);
    }
    plot::write(path, &write_pounding_csv(&written)?)
}

/// What `--json` prints of a motion that was made.
#[derive(Serialize)]
struct Made<'m> {
    output: &'m Path,
    samples: usize,
    time_step: f64,
    peak_acceleration: Peak,
    scale: f64,
    steps: &'m [StepRecord],
    warnings: &'m [String],
    #[serde(flatten)]
    matched: Option<Matched<'m>>,
}

/// How near a motion came to a spectrum.
#[derive(Serialize)]
pub struct Matched<'m> {
    /// Largest misfit.
    pub misfit: Misfit,
    /// What made it.
    pub method: Option<&'m str>,
    /// Damping ratio of the spectrum.
    pub damping: f64,
    /// Picture.
    pub svg: Option<&'m Path>,
}

/// Writes file and picture of a motion and says what was done.
pub fn finish(
    output: &OutputArguments,
    motion: &Accelerogram,
    title: &str,
    more: Option<Matched<'_>>,
) -> Result<(), Failure> {
    // Neither file without a place for the other.
    have_a_place([Some(&*output.output), output.svg.as_deref()])?;
    write(&output.output, motion, title)?;
    if let Some(path) = &output.svg {
        let drawn = plot::of_motion(histories(&[Named::at_rest(title, motion)]))?;
        plot::write_drawn(path, drawn, &output.figure)?;
    }
    if output.json {
        return print(&pretty(&Made {
            output: &output.output,
            samples: motion.samples().len(),
            time_step: motion.time_step(),
            peak_acceleration: motion.peak(),
            scale: motion.scale(),
            steps: motion.steps(),
            warnings: motion.origin().map_or(&[], |o| &o.warnings),
            matched: more,
        })?);
    }
    let mut text = format!("{title}\n");
    if let Some(origin) = motion.origin() {
        text.push_str(&format!(
            "read: unit {}, time step {}\n",
            origin.unit, origin.time_step
        ));
        for warning in &origin.warnings {
            text.push_str(&format!("warning: {warning}\n"));
        }
    }
    for step in motion.steps() {
        text.push_str(&step_text(step));
    }
    let peak = motion.peak();
    text.push_str(&format!(
        "\n{} at {} s, peak acceleration {:.5} g at {:.4} s, written to {}\n",
        counted(motion.samples().len(), "sample"),
        motion.time_step(),
        peak.value / G,
        peak.time,
        output.output.display()
    ));
    print(&text)
}

/// A step with a line a number.
pub fn step_text(step: &StepRecord) -> String {
    let mut text = format!("\n{}\n", step.step);
    for number in &step.numbers {
        let unit = match &*number.unit {
            "-" => "",
            unit => unit,
        };
        let value = six_digits(number.value);
        text.push_str(&format!("  {:34} {value:>14} {unit}\n", number.name).replace(" \n", "\n"));
    }
    for remark in &step.remarks {
        text.push_str(&format!("  {remark}\n"));
    }
    text
}
