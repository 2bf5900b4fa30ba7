//! `pounding explore`: the page that computes.

use std::path::{Path, PathBuf};

use pounding_case::Case;
use pounding_explorer_page::{ExplorerPageError, Inputs, page};
use pounding_files::FileUse;
use pounding_ground_motion::read_all_bytes;
use pounding_study::gap_check::distinct;

use crate::arguments::ExploreArguments;
use crate::asked_separation::{Asked, overridden};
use crate::failure::Failure;
use crate::faults::{assembled, read_case};
use crate::files::{
    have_a_place, metadata_beside, name_left_over, page_is_spared, reads_too, record_files,
};
use crate::output::print;
use crate::plot;

/// Writes the page of a case that can be run, says where.
pub fn explore(arguments: &ExploreArguments, mut files: FileUse) -> Result<(), Failure> {
    let path: &Path = &arguments.case;
    let case = read_case(path, true)?;
    let output = match &arguments.output {
        Some(output) => output.to_path_buf(),
        None => {
            let beside = path.with_extension("html");
            files.writes("--output", &beside);
            name_left_over(&beside);
            beside
        }
    };
    reads_too(&mut files, case.files())?;
    let records = record_files(&arguments.records);
    let records = records.map_err(|e| Failure::input(e.to_string(), e.help()))?;
    reads_too(&mut files, records.iter().map(|r| ("record", r.clone())))?;
    reads_too(
        &mut files,
        metadata_beside(records.iter().map(PathBuf::as_path)),
    )?;
    // What cannot be run has no page, and rules that cannot be read neither.
    assembled(&case)?;
    let asked = Asked {
        rules: arguments.rules.as_deref(),
        ..Asked::default()
    };
    let known = case.separation.rules.len();
    let rules = overridden(case.separation.clone(), &asked)?.rules;
    let given = rules.get(known).map(|rule| (&*rule.file, &*rule.source));
    let given = given.map(|(file, text)| (name_of(Path::new(file)), text));
    page_is_spared(&output, arguments.output.is_some())?;
    have_a_place([Some(output.as_path())])?;
    let mut held = named_files(&case)?;
    for record in &records {
        let bytes = bytes_of(record)?;
        read_all_bytes(&record.display().to_string(), &bytes, &Default::default())?;
        let name = name_of(record);
        if held
            .iter()
            .any(|(known, of)| (known, of) == (&name, &bytes))
        {
            continue;
        }
        let (stem, ending) = name.split_at(name.rfind('.').unwrap_or(name.len()));
        let is_held = |name: &str| held.iter().any(|(known, _)| known == name);
        held.push((distinct(stem, ending, is_held), bytes));
    }
    let name = name_of(path);
    let documentation = arguments.documentation.as_deref();
    if let Some(address) = documentation.filter(|address| !is_of_pages(address)) {
        return Err(Failure::input(
            format!("--documentation {address} is no address of pages"),
            Some("give https://..., http://..., file:///... or a folder".to_owned()),
        ));
    }
    let documentation = documentation.map(|address| match address.contains("{page}") {
        true => address.to_owned(),
        false => format!("{}/", address.trim_end_matches('/')),
    });
    let made = page(&Inputs {
        title: &case.title,
        name: &name,
        case: &case.source,
        files: &held,
        rules: given.as_ref().map(|(name, text)| (name.as_str(), *text)),
        documentation: documentation.as_deref(),
    });
    let made = made.map_err(|error| match error {
        ExplorerPageError::NoModule { .. } => Failure::computation(
            error.to_string(),
            Some("docs/how-to/explore-in-the-browser.md says what the build needs".to_owned()),
        ),
        error => Failure::computation(error.to_string(), None),
    })?;
    plot::write(&output, &made)?;
    print(&format!(
        "{:.1} MB: page written to {}",
        made.len() as f64 * 1.0e-6,
        output.display()
    ))
}

fn name_of(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// The files that the case names, by the names that it gives them.
fn named_files(case: &Case) -> Result<Vec<(String, Vec<u8>)>, Failure> {
    let mut held: Vec<(String, Vec<u8>)> = Vec::new();
    for (_, path) in case.named_files() {
        let name = path.display().to_string();
        if !held.iter().any(|(known, _)| *known == name) {
            held.push((name, bytes_of(&case.resolve(path))?));
        }
    }
    Ok(held)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Failure> {
    pounding_files::input::read(path).map_err(|e| {
        let message = format!("cannot read {}: {e}", path.display());
        Failure::input(message, Some("check the path".to_owned()))
    })
}

/// Whether an address is one that a link may lead to: of a folder, or with a scheme of pages.
fn is_of_pages(address: &str) -> bool {
    match address.split_once(':') {
        // One letter is a drive.
        Some((scheme, _)) if scheme.trim().len() > 1 && !scheme.contains(['/', '.', '?', '#']) => {
            ["https", "http", "file"].contains(&scheme.trim().to_ascii_lowercase().as_str())
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lead_to_pages() {
        for address in [
            "https://a.b/docs",
            "C:/docs",
            "C:\\docs",
            "HTTP://a",
            "file:///d",
            "docs",
            "../d",
            "./a:b",
            "a/b:c",
            "/d",
        ] {
            assert!(is_of_pages(address), "{address}");
        }
        for address in [
            "javascript:alert(1)",
            " JavaScript:alert(1)",
            "data:text/html,x",
            "vbscript:x",
        ] {
            assert!(!is_of_pages(address), "{address}");
        }
    }
}
