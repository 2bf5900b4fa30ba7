//! Where pictures, tables and pages are written.

use std::path::Path;

use pounding_report::documentation::DocumentationFile;
use pounding_report::{Chart, PictureFormat, ReportError};

use crate::arguments::FigureArguments;
use crate::failure::Failure;

/// A picture as wide as asked for, written as a file of the form that its ending says.
pub fn write_drawn(path: &Path, picture: Chart, size: &FigureArguments) -> Result<(), Failure> {
    let picture = picture.of_width(size.millimetres()).svg();
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let format = PictureFormat::of_ending(&ending).unwrap_or(PictureFormat::Svg);
    let bytes = format.of(&picture).map_err(|e| not_drawn(&e))?;
    pounding_files::write(path, &bytes)
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// A picture of a motion, or why there is none.
pub fn of_motion(picture: Result<Chart, ReportError>) -> Result<Chart, Failure> {
    picture.map_err(|e| match e {
        ReportError::Motion(error) => error.into(),
        error => not_drawn(&error),
    })
}

/// A picture that could not be drawn.
pub fn not_drawn(e: &impl std::error::Error) -> Failure {
    Failure::output(&std::io::Error::other(e.to_string()), "the picture")
}

/// Writes a text file, whole or not at all.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    pounding_files::write(path, text.as_bytes())
        .map_err(|e| Failure::output(&e, &path.display().to_string()))
}

/// Writes pages of the documentation into a folder.
pub fn write_documentation(folder: &Path, files: &[DocumentationFile]) -> Result<(), Failure> {
    std::fs::create_dir_all(folder)
        .map_err(|e| Failure::output(&e, &folder.display().to_string()))?;
    let mut files = files.iter();
    files.try_for_each(|file| write(&folder.join(&file.name), &file.text))
}
