//! The list of all models.

use crate::tables::Table;
use pounding_gap_element::ModelDescriptor;

/// One line per model.
pub fn table(chosen: &[&ModelDescriptor]) -> String {
    let mut table = Table::new();
    table.set_header(["name", "law", "class", "checked"]);
    for d in chosen {
        let name = if d.recommended {
            format!("{} *", d.name)
        } else {
            d.name.to_owned()
        };
        table.add_row([name.as_str(), d.title, d.class, d.verification.name()]);
    }
    format!(
        "{table}\n* recommended: returns the restitution asked for\n\n`pounding models NAME` shows formula, parameters, source and traps."
    )
}
