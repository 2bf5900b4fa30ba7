//! What a page takes: memory and time are bounded before they are spent.

use std::time::Duration;

use pounding_assembly::Assembly;
use pounding_case::Case;
use pounding_time_history::StepEstimate;

use crate::fault::Refused;

/// Longest request (bytes): records of agencies have a few megabytes.
pub const LONGEST_REQUEST: usize = 64 << 20;
/// Longest text of a case (bytes): matrices of many floors are files of their own.
pub const LONGEST_CASE: usize = 1 << 18;
/// Most keys of a case, and most tables and lists: each may be wrong, and say so with its place.
pub const MOST_ENTRIES: usize = 5_000;
/// Most bytes of all files together.
pub const MOST_BYTES: usize = 128 << 20;
/// Most floors of all buildings.
pub const MOST_FLOORS: usize = 600;
/// Most contact levels of all gaps.
pub const MOST_LEVELS: usize = 2_000;
/// Most samples of a ground motion.
pub const MOST_SAMPLES: usize = 5_000_000;
/// Most steps of a run without those of contacts.
pub const MOST_STEPS: f64 = 2.0e7;
/// Most numbers of the motion of the buildings in an answer.
pub const MOST_NUMBERS: usize = 4_000_000;
/// Most widths of one request for a sweep.
pub const MOST_WIDTHS: usize = 1_000;
/// Time after which a run is stopped.
pub const LONGEST_RUN: Duration = Duration::from_secs(20);

fn refuse(found: impl std::fmt::Display, most: impl std::fmt::Display, what: &str) -> Refused {
    Refused::new(
        format!("{found} {what} are more than a page takes: {most} at most"),
        Some("run the case with `pounding run`".to_owned()),
    )
}

/// Refuses a request of more bytes, with those that belong to it, than any file has.
pub(crate) fn request(length: usize) -> Result<(), Refused> {
    match length > LONGEST_REQUEST {
        true => Err(refuse(length, LONGEST_REQUEST, "bytes")),
        false => Ok(()),
    }
}

/// Refuses a text that no one wrote.
pub(crate) fn text(bytes: &[u8]) -> Result<(), Refused> {
    if bytes.len() > LONGEST_CASE {
        return Err(refuse(bytes.len(), LONGEST_CASE, "bytes of a case"));
    }
    let count = |signs: &[u8]| bytes.iter().filter(|byte| signs.contains(byte)).count();
    for (signs, what) in [(&b"="[..], "keys"), (&b"[{"[..], "tables and lists")] {
        let found = count(signs);
        if found > MOST_ENTRIES {
            return Err(refuse(found, MOST_ENTRIES, what));
        }
    }
    Ok(())
}

/// Refuses a case whose matrices would be too large, before they are made.
pub(crate) fn case(case: &Case) -> Result<(), Refused> {
    let floors: usize = case.buildings.iter().map(|b| b.mass.len()).sum();
    let levels = |gap: &pounding_case::Gap| {
        let points = gap.points.as_ref().map_or(2, |p| p.value.len().max(1));
        gap.levels.len().saturating_mul(points)
    };
    let levels = case
        .gaps
        .iter()
        .map(levels)
        .fold(0_usize, usize::saturating_add);
    if floors > MOST_FLOORS {
        return Err(refuse(floors, MOST_FLOORS, "floors"));
    }
    match levels > 2 * MOST_LEVELS {
        true => Err(refuse(levels / 2, MOST_LEVELS, "contact levels")),
        false => Ok(()),
    }
}

/// Refuses a run of more steps than anyone waits for.
pub(crate) fn run(assembly: &Assembly) -> Result<(), Refused> {
    let samples = assembly.accelerogram.samples().len();
    if samples > MOST_SAMPLES {
        return Err(
            refuse(samples, MOST_SAMPLES, "samples of the ground motion").of_a_sound_case(),
        );
    }
    let (system, options) = (&assembly.system, &assembly.options);
    let duration = options.duration.unwrap_or(system.record_duration());
    let steps = StepEstimate::new(system, &options.method, duration).steps;
    match steps <= MOST_STEPS {
        true => Ok(()),
        false => Err(
            refuse(format!("{steps:.1e}"), format!("{MOST_STEPS:.0e}"), "steps").of_a_sound_case(),
        ),
    }
}
