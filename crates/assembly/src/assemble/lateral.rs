//! What resists the lateral motion of buildings that are no chains of storeys.

use std::path::Path;

use pounding_case::{Building, Case, CaseError, Lateral, Located, MatrixSource};
use pounding_catalogue::wording::counted;
use pounding_shear_building::{LateralStiffness, MAXIMUM_STOREYS, ShearBuilding};

/// Difference of two entries of a matrix, over the largest one, that is told.
const TOLD: f64 = 1.0e-12;

/// The stiffness that a building of the case has in the place of storey stiffnesses.
pub(super) fn stiffness(
    case: &Case,
    building: &Building,
    lateral: &Located<Lateral>,
) -> Result<LateralStiffness, CaseError> {
    let made = match &lateral.value {
        Lateral::Stiffness(source) => LateralStiffness::from_rows(&rows(case, building, source)?),
        Lateral::Flexibility(source) => {
            LateralStiffness::from_flexibility(&rows(case, building, source)?)
        }
        Lateral::Cantilever {
            flexural_rigidity,
            shear_rigidity,
        } => LateralStiffness::cantilever(
            &building.height,
            flexural_rigidity,
            shear_rigidity.as_deref(),
        ),
        Lateral::Fishbone {
            columns,
            beam_stiffness,
        } => LateralStiffness::fishbone(&building.height, columns, beam_stiffness),
    };
    made.map_err(|e| {
        let file = lateral.value.file();
        let place = file.map_or(&lateral.span, |file| &file.span);
        let named = file.map_or_else(String::new, |f| format!("{}: ", f.value.display()));
        let message = format!("building {}: {named}{e}", building.name.value);
        let help = match lateral.value {
            Lateral::Stiffness(_) | Lateral::Flexibility(_) => {
                "give the matrix of the floors as the frame program exports it: bottom floor first, all other coordinates condensed out"
            }
            _ => "correct the rigidities: they are so far apart that the matrix of the floors is round-off",
        };
        case.error(place.clone(), message, Some(help.to_owned()))
    })
}

/// Rows of a matrix, as written or from its file.
fn rows(
    case: &Case,
    building: &Building,
    source: &MatrixSource,
) -> Result<Vec<Vec<f64>>, CaseError> {
    let (file, unit) = match source {
        MatrixSource::Rows(rows) => return Ok(rows.clone()),
        MatrixSource::File { file, unit } => (file, *unit),
    };
    let refused = |message: String, help: &str| {
        let shown = file.value.display();
        let message = format!("{shown}: {message}");
        case.error(file.span.clone(), message, Some(help.to_owned()))
    };
    let rows =
        read(&case.resolve(&file.value)).map_err(|(message, help)| refused(message, help))?;
    let floors = building.mass.len();
    if rows.len() != floors {
        return Err(refused(
            format!(
                "it has {} for {}",
                counted(rows.len(), "row"),
                counted(floors, "floor")
            ),
            "give one row per floor, bottom first, with one entry per floor and no header",
        ));
    }
    let scaled = |row: Vec<f64>| row.into_iter().map(|x| x * unit).collect();
    Ok(rows.into_iter().map(scaled).collect())
}

/// Numbers of a CSV file without header, row by row; lines that begin with `#` and empty ones
/// are left out. Fails with what is wrong and what to do.
fn read(path: &Path) -> Result<Vec<Vec<f64>>, (String, &'static str)> {
    const CORRECT: &str = "write one row per floor with numbers between commas, and no header";
    const PATH: &str = "name the file relative to the folder of the case file";
    // A device or a pipe may never end.
    match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => {
            return Err(("cannot read the matrix: this is a folder".to_owned(), PATH));
        }
        Ok(found) if !found.is_file() => {
            return Err((
                "cannot read the matrix: this is no regular file".to_owned(),
                PATH,
            ));
        }
        _ => {}
    }
    let reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_path(path);
    let mut reader = reader.map_err(|e| {
        let message = match e.kind() {
            csv::ErrorKind::Io(e) => format!("cannot read the matrix: {e}"),
            _ => e.to_string(),
        };
        (message, PATH)
    })?;
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| (e.to_string(), CORRECT))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |(column, text): (usize, &str)| {
            let value = text.parse::<f64>().ok().filter(|x| x.is_finite());
            value.ok_or_else(|| {
                let message = format!(
                    "line {line}, column {}: \"{text}\" is no number",
                    column + 1
                );
                (message, CORRECT)
            })
        };
        if record.len() > MAXIMUM_STOREYS || rows.len() == MAXIMUM_STOREYS {
            let message = format!(
                "it has more than {MAXIMUM_STOREYS} rows or columns, the most floors of a building"
            );
            return Err((message, CORRECT));
        }
        let entries = record.iter().enumerate();
        rows.push(entries.map(number).collect::<Result<_, _>>()?);
    }
    Ok(rows)
}

/// A warning where entries on both sides of the diagonal differ, and their means are used.
pub(super) fn averaged(building: &ShearBuilding) -> Option<String> {
    let difference = building.asymmetry();
    (difference > TOLD).then(|| {
        format!(
            "building {}: entries on both sides of the diagonal of its matrix differ by up to {difference:.1e} of the largest one; their means are used",
            building.name()
        )
    })
}
