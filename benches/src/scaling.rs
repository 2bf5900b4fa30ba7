//! Cost against the number of storeys, of buildings and of impacts.

use pounding_time_history::{GroundAcceleration, System};
use verification::{Failure, ReferenceCase, reference_system};

use crate::cases::{impacts, integrate, uniform_row, write_peer_case};
use crate::clock::{least, thread_seconds};
use crate::methods::sweeping;
use crate::peers::{Program, Room};

/// One system, measured by all methods of sweeps and, where it fits, the prototype.
pub(crate) struct Row {
    /// What was varied.
    pub(crate) label: String,
    pub(crate) storeys: usize,
    pub(crate) samples: usize,
    pub(crate) impacts: usize,
    /// Least processor time of each method (s).
    pub(crate) seconds: Vec<f64>,
    /// That of the prototype (s).
    pub(crate) prototype: Option<f64>,
}

/// The model of these measurements.
pub(crate) const MODEL: &str = "jank";
/// Limits of the compiled peer: floors, levels, buildings.
const PEER_LIMITS: (usize, usize, usize) = (64, 32, 8);
/// A gap that never closes (m).
pub(crate) const WIDE: f64 = 1.0e3;

/// Two towers of equal height, without and with contact.
pub(crate) fn storeys(
    room: &Room,
    ground: &GroundAcceleration,
    counts: &[usize],
    rounds: usize,
) -> Result<[Vec<Row>; 2], Failure> {
    let rows = |gap: f64| {
        let rows = counts.iter().map(|n| {
            let case = uniform_row(2, *n, gap);
            row(room, &case, ground, n.to_string(), rounds)
        });
        rows.collect::<Result<Vec<_>, Failure>>()
    };
    Ok([rows(WIDE)?, rows(0.02)?])
}

/// Rows of six-storey buildings.
pub(crate) fn buildings(
    room: &Room,
    ground: &GroundAcceleration,
    counts: &[usize],
    rounds: usize,
) -> Result<Vec<Row>, Failure> {
    let rows = counts.iter().map(|n| {
        let case = uniform_row(*n, 6, 0.02);
        row(room, &case, ground, n.to_string(), rounds)
    });
    rows.collect()
}

/// A case with its gaps multiplied.
pub(crate) fn gaps(
    room: &Room,
    case: &mut ReferenceCase,
    ground: &GroundAcceleration,
    factors: &[f64],
    rounds: usize,
) -> Result<Vec<Row>, Failure> {
    let widths: Vec<f64> = case.links.iter().map(|l| l.gap).collect();
    let mut rows = Vec::new();
    for factor in factors {
        for (link, width) in case.links.iter_mut().zip(&widths) {
            link.gap = width * factor;
        }
        let label = format!("{} mm", 1.0e3 * widths[0] * factor);
        rows.push(row(room, case, ground, label, rounds)?);
    }
    for (link, width) in case.links.iter_mut().zip(&widths) {
        link.gap = *width;
    }
    Ok(rows)
}

fn row(
    room: &Room,
    case: &ReferenceCase,
    ground: &GroundAcceleration,
    label: String,
    rounds: usize,
) -> Result<Row, Failure> {
    let system: System = reference_system(case, MODEL, ground.clone(), 1.0)?;
    let n = system.degrees_of_freedom();
    let (floors, levels, most) = PEER_LIMITS;
    let fits = n <= floors && case.links.len() <= levels && case.buildings.len() <= most;
    let program = Program::Compiled("evd");
    let mut prototype = None;
    if fits && room.has(program) {
        write_peer_case(case, ground, &room.case_file("scaling"))?;
        prototype = Some(f64::INFINITY);
    }
    let methods = sweeping(ground.time_step);
    let mut seconds = vec![Vec::new(); methods.len()];
    let mut count = 0;
    for _ in 0..rounds {
        for (times, (_, method)) in seconds.iter_mut().zip(&methods) {
            let start = thread_seconds();
            count = impacts(&integrate(&system, *method)?);
            times.push(thread_seconds() - start);
        }
        if let Some(best) = &mut prototype {
            let run = room.run(program, ("scaling", MODEL, "1e-8"), 2)?;
            *best = best.min(run.seconds);
        }
    }
    Ok(Row {
        label,
        storeys: n,
        samples: ground.samples.len() - 1,
        impacts: count,
        seconds: seconds.iter().map(|s| least(s)).collect(),
        prototype,
    })
}
