//! The list of all models.

use crate::tables::Table;
use pounding_gap_element::{ModelDescriptor, Verification};

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
        table.add_row([name.as_str(), d.title, d.class, checked(d)]);
    }
    format!(
        "{table}\n* recommended: returns the restitution asked for\n\n`pounding models NAME` shows formula, parameters, source and traps."
    )
}

/// How far the model has been checked, in a word or two.
pub fn checked(d: &ModelDescriptor) -> &'static str {
    match d.verification {
        Verification::Verified(_) => "verified",
        Verification::SecondarySources(_) => "secondary sources",
    }
}
