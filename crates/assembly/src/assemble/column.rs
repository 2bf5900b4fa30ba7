//! Columns of a case that floors of the neighbour hit.

use pounding_case::{Building, Case, CaseError, ContactLevel, Facing, Gap, Located, Side};
use pounding_shear_building::{ColumnError, HitColumn, decimal};

/// The column of a level of a gap, if it has one.
pub(super) fn column(
    case: &Case,
    gap: &Gap,
    level: &ContactLevel,
) -> Result<Option<HitColumn>, CaseError> {
    let sides = [level.left, level.right];
    let Some(side) = sides.iter().position(|facing| facing.is_column()) else {
        return Ok(None);
    };
    let (
        Facing::Column {
            storey,
            above_floor,
        },
        Side::Building(building),
        Some(given),
    ) = (sides[side], gap.between[side], &gap.columns[side])
    else {
        return Ok(None);
    };
    let b = &case.buildings[building];
    let columns = &given.value;
    let made = HitColumn::new(
        columns.flexural_rigidity,
        columns.shear_rigidity,
        columns.ends,
        b.height[storey],
        above_floor,
    );
    let column = made.map_err(|e| {
        let place = match e {
            ColumnError::NearFloor { .. } => level.place.clone(),
            _ => given.span.clone(),
        };
        let help = match e {
            ColumnError::NearFloor { .. } => format!(
                "let these floors touch: raise `elevation_tolerance` above their difference of {} m, or name the pair of floors with `floor_to_floor = true`",
                decimal(above_floor.min(b.height[storey] - above_floor))
            ),
            _ => "correct the value".to_owned(),
        };
        let message = format!("storey {} of \"{}\": {e}", storey + 1, b.name.value);
        case.error(place, message, Some(help))
    })?;
    within_storey(case, b, storey, (given, &column))?;
    Ok(Some(column))
}

/// Refuses columns that are stiffer than the storey in which they stand.
fn within_storey<T>(
    case: &Case,
    b: &Building,
    storey: usize,
    (given, column): (&Located<T>, &HitColumn),
) -> Result<(), CaseError> {
    let own = column.storey_stiffness();
    // A matrix does not say what a storey is.
    let Some(stiffness) = b.stiffness.get(storey).filter(|k| own > **k) else {
        return Ok(());
    };
    Err(case.error(
        given.span.clone(),
        format!(
            "columns of {own} N/m stand in storey {} of \"{}\", which has a stiffness of {stiffness} N/m with them",
            storey + 1,
            b.name.value
        ),
        Some("give E I of the columns that face the neighbour alone, cracked, or correct the storey stiffness, which has them in it".to_owned()),
    ))
}
