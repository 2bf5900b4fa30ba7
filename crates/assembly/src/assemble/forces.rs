//! Forces on floors.

use std::f64::consts::TAU;

use pounding_case::{Case, CaseError, Errors, ForceSource, Located};
use pounding_catalogue::wording::counted;
use pounding_time_history::{FloorForce, ForceHistory, System, TimeHistoryError};

use crate::error::AssemblyError;
use crate::number_file::NumberFile;

/// The most lines of a file of forces.
const MOST_LINES: usize = 2_000_000;

/// Lets the forces of a case act on the floors of a system.
pub(super) fn on_floors(case: &Case, system: System) -> Result<System, AssemblyError> {
    let errors = Errors::default();
    let numbered = case.buildings.iter().enumerate();
    let forces = numbered.flat_map(|(b, building)| building.forces.iter().map(move |f| (b, f)));
    let made = errors.all(forces.map(|(building, force)| {
        Ok(FloorForce {
            building,
            storey: force.value.storey,
            history: history(case, force)?,
            origin: origin(&force.value.source),
        })
    }));
    Ok(system.with_forces(errors.finish(made)?)?)
}

/// Where a force comes from, for the user.
fn origin(source: &ForceSource) -> String {
    match source {
        ForceSource::Constant(_) => "constant".to_owned(),
        ForceSource::Points(_) => String::new(),
        ForceSource::Harmonic { frequency, .. } => format!("{frequency} Hz"),
        ForceSource::File { file, column, .. } => {
            format!("{}, column {}", file.value.display(), column + 1)
        }
    }
}

/// One force over time.
fn history(
    case: &Case,
    force: &Located<pounding_case::FloorForce>,
) -> Result<ForceHistory, CaseError> {
    let given = &force.value;
    let (points, place) = match &given.source {
        ForceSource::Constant(constant) => (vec![(0.0, *constant)], &force.span),
        ForceSource::Points(points) => (points.value.clone(), &points.span),
        ForceSource::Harmonic {
            amplitude,
            frequency,
            phase,
            duration,
            step,
        } => {
            let lines = (duration / step).ceil().max(1.0) as usize;
            let point = |k: usize| {
                let t = duration.min(k as f64 * step);
                (t, amplitude * libm::sin(TAU * frequency * t + phase))
            };
            ((0..=lines).map(point).collect(), &force.span)
        }
        ForceSource::File {
            file,
            column,
            time_step,
            unit,
        } => {
            let read = read(case, file, (*column, *time_step))?;
            let scaled = read.into_iter().map(|(t, force)| (t, unit * force));
            (scaled.collect(), &file.span)
        }
    };
    let placed = points
        .iter()
        .map(|(t, force)| (given.delay + t, given.scale * force));
    let points: Vec<(f64, f64)> = placed.collect();
    ForceHistory::new(&points, given.stays).map_err(|e| {
        let reason = match e {
            TimeHistoryError::Force { reason } => reason,
            other => other.to_string(),
        };
        let named = given.source.file();
        let named = named.map_or_else(String::new, |f| format!("{}: ", f.value.display()));
        case.error(
            place.clone(),
            format!("{named}{reason}"),
            Some("give times in their order; two points at one time are a jump".to_owned()),
        )
    })
}

/// Times (s) and forces, in the unit of the file.
fn read(
    case: &Case,
    file: &Located<std::path::PathBuf>,
    (column, time_step): (usize, Option<f64>),
) -> Result<Vec<(f64, f64)>, CaseError> {
    let layout = NumberFile {
        what: "force history",
        rows: if time_step.is_some() {
            "one line per time step with numbers between commas"
        } else {
            "one line per point with numbers between commas, the time (s) first; forces at equal steps take `time_step`"
        },
        header: true,
        most: (MOST_LINES, "the most points of a force"),
    };
    let refused = |message: String, help: String| {
        let message = format!("{}: {message}", file.value.display());
        case.error(file.span.clone(), message, Some(help))
    };
    let rows = layout.read(case, &file.value);
    let rows = rows.map_err(|(message, help)| refused(message, help))?;
    if rows.is_empty() {
        let help = format!("write {}", layout.rows);
        return Err(refused("it holds no numbers".to_owned(), help));
    }
    let point = |(k, row): (usize, Vec<f64>)| {
        let force = row.get(column).ok_or_else(|| {
            refused(
                format!(
                    "row {} of its numbers has {}, and the force is in column {}",
                    k + 1,
                    counted(row.len(), "column"),
                    column + 1
                ),
                "name the column of the force, from 1, by `column`; forces at equal steps without times take `time_step`".to_owned(),
            )
        })?;
        let time = match time_step {
            Some(step) => k as f64 * step,
            None => row[0],
        };
        Ok((time, *force))
    };
    rows.into_iter().enumerate().map(point).collect()
}
