//! Columns that floors of the neighbour hit.

use pounding_shear_building::ColumnEnds;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Entry, Field, FlexuralRigidity, Force, Mass, OneOrEach, Optional, Positive, Reader,
};
use crate::located::Located;
use crate::types::{HitColumns, Side};

/// Columns that floors of the neighbour hit between floors, as one line
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(
    rename = "column",
    expecting = "a table\nfor example { of = \"B\", flexural_rigidity = \"256 MN m2\", ends = \"fixed\", contact_mass = \"2.4 t\" }"
)]
pub(super) struct ColumnTable {
    /// The building whose columns are hit
    of: Field<String>,
    /// Flexural rigidity E I of all columns together that are hit (N m2), the same in all
    /// storeys
    flexural_rigidity: Field<Positive<FlexuralRigidity>>,
    /// Shear rigidity kappa G A of the same (N); by default rigid in shear
    shear_rigidity: Optional<Positive<Force>>,
    /// "fixed", the default: neither end rotates; "pinned": a hinge at the upper floor
    ends: Optional<Ends>,
    /// Mass of column and facade that a hit sets in motion (kg); by default none
    contact_mass: Optional<Positive<Mass>>,
    /// Shear capacity V_Rd of the columns (N), to compare the demand with
    shear_capacity: Optional<Positive<Force>>,
}

#[derive(Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Ends {
    Fixed,
    Pinned,
}

/// One table of columns, or one for each of both buildings.
pub(super) type ColumnTables = OneOrEach<Field<ColumnTable>>;

/// The columns of the left and of the right building, as far as they are hit; `None` where
/// something is wrong.
pub(super) fn columns(
    reader: &Reader<'_>,
    tables: Optional<ColumnTables>,
    between: [Side; 2],
    names: &[String; 2],
) -> Option<[Option<Located<HitColumns>>; 2]> {
    let mut found = [None, None];
    let Some(tables) = tables else {
        return Some(found);
    };
    let given = tables.located()?;
    if between.contains(&Side::Wall) {
        return reader.refuse(
            given.span,
            "`column` has no meaning beside a wall",
            "remove it: all floors hit the wall",
        );
    }
    let mut whole = true;
    for table in given.value.into_list() {
        let read = table.located().and_then(|Located { value, span }| {
            let of = value.of.clone().located();
            let columns = value.read();
            let of = of?;
            let Some(side) = names.iter().position(|name| *name == of.value) else {
                return reader.refuse(
                    of.span,
                    format!("\"{}\" is not one of the neighbours of this gap", of.value),
                    format!("name \"{}\" or \"{}\"", names[0], names[1]),
                );
            };
            let value = columns?;
            Some((side, Located { value, span }))
        });
        match read {
            Some((side, columns)) if found[side].is_none() => found[side] = Some(columns),
            Some((side, columns)) => {
                return reader.refuse(
                    columns.span,
                    format!("the columns of \"{}\" are given twice", names[side]),
                    "leave one of them out, or name the other building",
                );
            }
            None => whole = false,
        }
    }
    whole.then_some(found)
}

impl ColumnTable {
    fn read(self) -> Option<HitColumns> {
        let ends = match self.ends.value_or(Ends::Fixed)? {
            Ends::Fixed => ColumnEnds::Fixed,
            Ends::Pinned => ColumnEnds::Pinned,
        };
        let shear_rigidity = self.shear_rigidity.stated()?;
        let contact_mass = self.contact_mass.stated()?;
        let shear_capacity = self.shear_capacity.stated()?;
        let number = |given: Located<Positive<Force>>| f64::from(given.value);
        Some(HitColumns {
            flexural_rigidity: self.flexural_rigidity.number()?,
            shear_rigidity: shear_rigidity.map(number),
            ends,
            contact_mass: contact_mass.map(|given| given.value.into()),
            shear_capacity: shear_capacity.map(number),
        })
    }
}
