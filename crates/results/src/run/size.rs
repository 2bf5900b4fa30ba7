//! How large the result of a run gets.

pub use pounding_time_history::MAXIMUM_RESPONSES;
use pounding_time_history::{System, short};

/// Numbers of one sample of the responses in the file.
pub(super) fn numbers(system: &System) -> usize {
    let floors = 5 * system.floors();
    let bases = super::buildings::with_base_moment(system).count();
    // Time, ground acceleration and the parts of the energy ledger.
    let responses: usize = (system.buildings().iter())
        .map(|b| b.responses().len())
        .sum();
    let buildings = 0..system.buildings().len();
    let grounds = buildings.flat_map(|b| system.motions_under(b)).flatten();
    let pushed = |b: usize| system.forces().iter().any(|f| f.building == b);
    let buildings = system.buildings().iter().enumerate();
    let forces = buildings
        .filter(|(b, _)| pushed(*b))
        .map(|(_, b)| b.storeys());
    let loads = grounds.count() + forces.sum::<usize>();
    // Of storeys what their frames dissipate together.
    let with_frames = system.buildings().iter();
    let with_frames = with_frames.filter(|b| !b.yielding_frames().is_empty());
    let of_frames: usize = with_frames.map(|b| b.storeys()).sum();
    let elements = 3 * system.elements().len() + of_frames;
    floors + bases + responses + loads + 2 * system.levels().len() + elements + 9
}

/// Responses on the output grid that no disk would take.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "{} samples of the responses over {} s would be a result of {} GB; {:.0} GB are the most",
    short(*samples), short(*duration), short(bytes * 1e-9), MAXIMUM_RESPONSES * 1e-9
)]
pub struct ResponsesTooLarge {
    /// Samples.
    pub samples: f64,
    /// Duration (s).
    pub duration: f64,
    /// Size before compression (bytes).
    pub bytes: f64,
}

impl ResponsesTooLarge {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> String {
        "raise `output_step` in [analysis], or shorten `duration`; peaks and impacts do not depend on `output_step`"
            .to_owned()
    }
}

/// Bytes of the responses on a grid of `output_step` (s) over `duration` (s; `None` for that of the
/// record), in memory or before they are compressed.
#[must_use]
pub fn response_bytes(system: &System, duration: Option<f64>, output_step: f64) -> f64 {
    let duration = duration.unwrap_or_else(|| system.record_duration());
    duration / output_step * (size_of::<f64>() * numbers(system)) as f64
}

/// Refuses responses on a grid of `output_step` (s) over `duration` (s; `None` for that of
/// the record) that would not fit into [`MAXIMUM_RESPONSES`], before a run begins.
///
/// # Errors
/// [`ResponsesTooLarge`].
pub fn check_size(
    system: &System,
    duration: Option<f64>,
    output_step: f64,
) -> Result<(), ResponsesTooLarge> {
    let duration = duration.unwrap_or_else(|| system.record_duration());
    let samples = duration / output_step;
    let bytes = response_bytes(system, Some(duration), output_step);
    if bytes <= MAXIMUM_RESPONSES {
        return Ok(());
    }
    Err(ResponsesTooLarge {
        samples,
        duration,
        bytes,
    })
}
