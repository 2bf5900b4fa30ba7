//! What resists the lateral motion of buildings that are no chains of storeys.

use pounding_case::{Building, Case, CaseError, Lateral, Located, MatrixSource};
use pounding_catalogue::wording::counted;
use pounding_shear_building::{LateralStiffness, MAXIMUM_STOREYS, ShearBuilding};

use crate::number_file::NumberFile;

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
            Lateral::Stiffness(_) | Lateral::Flexibility(_) => e.help(),
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
    let layout = NumberFile {
        what: "matrix",
        rows: "one row per floor with numbers between commas, semicolons or tabs, and no header",
        header: false,
        most: (MAXIMUM_STOREYS, "the most floors of a building"),
    };
    let rows = layout.read(case, &file.value);
    let rows = rows
        .map_err(|(message, help)| refused(message, &help))?
        .rows;
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
