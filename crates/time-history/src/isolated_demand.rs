//! The gap that a ground motion demands: how far floors come towards one another where none can close.

use crate::driver::run;
use crate::error::TimeHistoryError;
use crate::options::RunOptions;
use crate::outcome::Outcome;
use crate::peak::Peak;
use crate::recorder::Recorder;
use crate::relative_displacement::RelativeDisplacement;
use crate::system::{System, TOUCH};

/// Runs a system as if no gap could close, with its links, and returns that run with the
/// gap (m) that it demands at every contact level, in the order of [`System::levels`]: a
/// gap of this width would just be touched; 1e-14 m and less is none. In a row this holds for the first contact
/// anywhere: a building that was hit may close another gap that it would not have closed.
///
/// # Errors
/// Those of [`run`].
pub fn isolated_demand(
    system: &System,
    options: &RunOptions,
) -> Result<(Outcome, Vec<Peak>), TimeHistoryError> {
    isolated_demand_beside(system, options, &mut [])
}

/// The same with recorders of that run, which may end it.
///
/// # Errors
/// As [`isolated_demand`].
pub fn isolated_demand_beside(
    system: &System,
    options: &RunOptions,
    recorders: &mut [&mut dyn Recorder],
) -> Result<(Outcome, Vec<Peak>), TimeHistoryError> {
    let mut demand = RelativeDisplacement::of_levels(system);
    let mut all: Vec<&mut dyn Recorder> = vec![&mut demand];
    for recorder in recorders {
        all.push(&mut **recorder);
    }
    let outcome = run(&system.without_gaps(), options, &mut all, &mut |_| {})?;
    // Of floors that move alike, such as those of equal buildings, round-off is left; a run with gaps counts no
    // impact of it either.
    for peak in demand.peaks.iter_mut().filter(|peak| peak.value <= TOUCH) {
        *peak = Peak::default();
    }
    Ok((outcome, demand.peaks))
}
