//! `pounding models`: the descriptors of the impact models, and the pages written from them.

mod descriptor;
mod example;
mod index;
mod list;
pub(super) mod loops;
pub(super) mod numbers;
mod page;
mod pages;
mod results;

use std::path::Path;

use pounding_gap_element::{ModelDescriptor, registry};
use serde_json::json;

use super::{pretty, print};
use crate::failure::Failure;

/// Lists all models, shows one, or writes the pages of the documentation.
pub fn models(name: Option<&str>, as_json: bool, folder: Option<&Path>) -> Result<(), Failure> {
    if let Some(folder) = folder {
        return pages::write(folder);
    }
    let chosen: Vec<&ModelDescriptor> = match name {
        Some(name) => vec![registry::find(name)?],
        None => registry::descriptors().to_vec(),
    };
    if as_json {
        let descriptors: Vec<_> = chosen.iter().map(|d| descriptor::json(d)).collect();
        return print(&pretty(&json!(descriptors)));
    }
    if name.is_some() {
        return print(
            &chosen
                .iter()
                .map(|d| descriptor::text(d))
                .collect::<String>(),
        );
    }
    print(&list::table(&chosen))
}
