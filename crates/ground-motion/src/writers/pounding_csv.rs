//! Our CSV layout, in m/s2 and at full precision.

use std::fmt::Write as _;

use crate::error::GroundMotionError;
use crate::origin::Processing;
use crate::writers::{Written, acceleration_only, line, number, readable, time};

/// Keys of the direction of positive values.
pub(crate) const AZIMUTH: &str = "Azimuth";
pub(crate) const DIP: &str = "Dip";
/// Key of the time of the first sample.
pub(crate) const START_TIME: &str = "Start";
/// Key of the time of the first sample (s) in the column of times of the record that was processed.
pub(crate) const FIRST_TIME: &str = "First time";
/// Key of the number of samples.
pub(crate) const SAMPLES: &str = "Samples";
/// Keys of velocity and displacement at the first sample.
pub(crate) const INITIAL_VELOCITY: &str = "Initial velocity";
pub(crate) const INITIAL_DISPLACEMENT: &str = "Initial displacement";

/// The text of a file in our CSV layout: a comment header that says where the motion
/// came from and what was done to it, a column header, times (s) and accelerations
/// (m/s2) at full precision. Reading it gives the same samples, bit for bit.
///
/// # Errors
/// A velocity or a displacement, which the layout does not hold, and samples beyond 1e37 m/s2.
pub fn write_pounding_csv(series: &Written) -> Result<String, GroundMotionError> {
    acceleration_only(series, "pounding_csv")?;
    readable(series)?;
    let mut text = String::with_capacity(28 * series.samples.len() + 1000);
    if !series.title.is_empty() {
        let _ = writeln!(text, "# Event: {}", line(&series.title));
    }
    if !series.component.is_empty() {
        let _ = writeln!(text, "# Component: {}", line(&series.component));
    }
    if let Some(to) = series.orientation {
        let _ = writeln!(text, "# {AZIMUTH}: {} degrees", number(to.azimuth));
        let _ = writeln!(text, "# {DIP}: {} degrees", number(to.dip));
    }
    if !series.start_time.is_empty() {
        let _ = writeln!(text, "# {START_TIME}: {}", line(&series.start_time));
    }
    if let Some(first) = series.first_time.filter(|first| *first != 0.0) {
        let _ = writeln!(text, "# {FIRST_TIME}: {} s", number(first));
    }
    match series.processing {
        Processing::Raw => text.push_str("# Stage: raw\n"),
        Processing::Corrected => text.push_str("# Stage: corrected\n"),
        Processing::Unstated => {}
    }
    if let Some((velocity, displacement)) = series.initial {
        let _ = writeln!(text, "# {INITIAL_VELOCITY}: {} m/s", number(velocity));
        let _ = writeln!(text, "# {INITIAL_DISPLACEMENT}: {} m", number(displacement));
    }
    for remark in &series.remarks {
        let _ = writeln!(text, "# {}", line(remark));
    }
    let _ = writeln!(text, "# Unit: m/s2");
    let _ = writeln!(text, "# dt: {} s", series.time_step);
    let _ = writeln!(text, "# {SAMPLES}: {}", series.samples.len());
    let _ = writeln!(text, "time_s,acceleration_m_s2");
    for (i, a) in series.samples.iter().enumerate() {
        let _ = writeln!(text, "{},{}", time(i, series.time_step), number(*a));
    }
    Ok(text)
}
