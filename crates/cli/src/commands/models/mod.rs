//! `pounding models`: the descriptors of the impact models, and the pages written from them.

pub mod descriptor;

use std::path::Path;

use pounding_gap_element::{ModelDescriptor, registry};
use pounding_report::documentation::models as documentation;

use crate::failure::Failure;
use crate::output::{pretty, print};
use crate::plot::write_documentation;
use crate::tables::Table;

/// Lists all models, shows one, or writes the pages of the documentation.
pub fn models(name: Option<&str>, as_json: bool, folder: Option<&Path>) -> Result<(), Failure> {
    if let Some(folder) = folder {
        write_documentation(folder, &documentation::files()?)?;
        return print(&format!(
            "{} models in {}",
            registry::descriptors().len(),
            folder.display()
        ));
    }
    let chosen: Vec<&ModelDescriptor> = match name {
        Some(name) => vec![registry::find(name)?],
        None => registry::descriptors().to_vec(),
    };
    if as_json {
        let chosen = chosen.iter();
        let described: Vec<_> = chosen.map(|d| descriptor::Described::of(d)).collect();
        return print(&pretty(&described)?);
    }
    if name.is_some() {
        return print(
            &chosen
                .iter()
                .map(|d| descriptor::text(d))
                .collect::<String>(),
        );
    }
    print(&list(&chosen))
}

/// One line per model.
fn list(chosen: &[&ModelDescriptor]) -> String {
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
