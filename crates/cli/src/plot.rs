//! Where pictures, tables and pages are written.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

use pounding_report::documentation::DocumentationFile;
use pounding_report::{Chart, PictureFormat, ReportError};

use crate::arguments::FigureArguments;
use crate::failure::Failure;
use crate::files::no_result_stands;
use crate::output::warn;

/// A picture as wide as asked for, written as a file of the form that its ending says.
pub fn write_drawn(path: &Path, picture: Chart, size: &FigureArguments) -> Result<(), Failure> {
    no_result_stands(path)?;
    let picture = picture.of_width(size.millimetres()).svg();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let format = PictureFormat::of_ending(&ending).unwrap_or(PictureFormat::Svg);
    let made = format.of(&picture).map_err(|e| Failure::not_drawn(&e))?;
    say_without_glyph(made.without_glyph);
    pounding_files::write(path, &made.bytes)
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Says once which characters of pictures no font has.
fn say_without_glyph(characters: BTreeSet<char>) {
    static SAID: Mutex<BTreeSet<char>> = Mutex::new(BTreeSet::new());
    // Who panicked while saying it has said it.
    let mut said = SAID.lock().unwrap_or_else(PoisonError::into_inner);
    let new: Vec<String> = characters
        .into_iter()
        .filter(|c| said.insert(*c))
        .map(|c| c.to_string())
        .collect();
    if !new.is_empty() {
        warn(&format!(
            "no font of this machine has a glyph for {}: boxes stand in their places in the figure; write it as SVG, or install a font that has them",
            new.join(" ")
        ));
    }
}

/// A picture of a motion, or why there is none.
pub fn of_motion(picture: Result<Chart, ReportError>) -> Result<Chart, Failure> {
    picture.map_err(|e| match e {
        ReportError::Motion(error) => error.into(),
        error => Failure::not_drawn(&error),
    })
}

/// Writes a text file, whole or not at all.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    no_result_stands(path)?;
    pounding_files::write(path, text.as_bytes())
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Writes pages of the documentation into a folder.
pub fn write_documentation(folder: &Path, files: &[DocumentationFile]) -> Result<(), Failure> {
    let files = files.iter();
    write_all(
        folder,
        files.map(|file| (file.name.as_str(), file.text.as_str())),
    )
}

/// Writes text files into a folder, or none of them where one may not be written.
pub fn write_all<'f>(
    folder: &Path,
    files: impl Iterator<Item = (&'f str, &'f str)> + Clone,
) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::output(&e, &folder.display().to_string()))?;
    let mut names = files.clone().map(|(name, _)| name);
    names.try_for_each(|name| no_result_stands(&folder.join(name)))?;
    let mut files = files;
    files.try_for_each(|(name, text)| write(&folder.join(name), text))
}
