//! One case under many records.

use std::path::{Path, PathBuf};

use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::{Case, GroundMotion, Located, Offset};

use super::error::CheckError;

/// A record with the case put under it.
#[derive(Debug, Clone)]
pub struct CaseUnderRecord {
    /// Name: the file without its folder and ending.
    pub name: String,
    /// File.
    pub file: PathBuf,
    /// The system, its options, and the record as used.
    pub assembly: Assembly,
}

/// Puts a case under each record: files, or folders of files in the order of their
/// names. Without any, the case keeps its own record.
///
/// Records that are named here are read by their own headers (`time_step`, `unit` and
/// the other keys of `[ground_motion]` belong to the record of the case), keep the
/// `scale` of the case, and run for their own durations.
///
/// # Errors
/// A folder without files, a case or a record that cannot be used.
pub fn under_records(case: &Case, records: &[PathBuf]) -> Result<Vec<CaseUnderRecord>, CheckError> {
    if records.is_empty() {
        let file = case.resolve(&case.ground_motion.file.value);
        let assembly = assembled(case, &file)?;
        return Ok(vec![CaseUnderRecord {
            name: name_of(&file),
            file,
            assembly,
        }]);
    }
    let files = files(records)?;
    let names = distinct_names(&files);
    let cases = files.into_iter().zip(names).map(|(file, name)| {
        let mut other = case.clone();
        other.ground_motion = motion(case, &file);
        other.analysis.duration = None;
        let assembly = assembled(&other, &file)?;
        Ok(CaseUnderRecord {
            name,
            file,
            assembly,
        })
    });
    cases.collect()
}

/// Folders replaced by the files in them.
fn files(records: &[PathBuf]) -> Result<Vec<PathBuf>, CheckError> {
    let mut files = Vec::new();
    for path in records {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let refused = |reason: String| CheckError::NoRecords {
            path: path.clone(),
            reason,
        };
        let entries = std::fs::read_dir(path).map_err(|e| refused(e.to_string()))?;
        let mut inside: Vec<PathBuf> = entries
            .filter_map(|entry| entry.ok().map(|e| e.path()))
            .filter(|p| p.is_file() && !is_beside_records(p))
            .collect();
        if inside.is_empty() {
            let reason = "it holds no files but hidden ones and descriptions (.md); folders inside it are not looked into";
            return Err(refused(reason.to_owned()));
        }
        inside.sort();
        files.extend(inside);
    }
    given_once(&files)?;
    Ok(files)
}

/// Hidden files, and descriptions of records.
fn is_beside_records(file: &Path) -> bool {
    let hidden = file
        .file_name()
        .is_some_and(|n| n.to_string_lossy().starts_with('.'));
    hidden || file.extension().is_some_and(|e| e == "md")
}

/// A record that counts twice would make the answer look surer than it is.
fn given_once(files: &[PathBuf]) -> Result<(), CheckError> {
    let mut seen = Vec::new();
    for file in files {
        let place = file.canonicalize().unwrap_or_else(|_| file.clone());
        if seen.contains(&place) {
            return Err(CheckError::Word {
                message: format!("record {} is given twice", file.display()),
                help: Some("name each record once: it would count twice".to_owned()),
            });
        }
        seen.push(place);
    }
    Ok(())
}

/// Names of files, made distinct by numbers where two are alike.
fn distinct_names(files: &[PathBuf]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for file in files {
        let name = name_of(file);
        let mut distinct = name.clone();
        let mut number = 2;
        while names.contains(&distinct) {
            distinct = format!("{name} ({number})");
            number += 1;
        }
        names.push(distinct);
    }
    names
}

fn name_of(file: &Path) -> String {
    file.file_stem()
        .unwrap_or(file.as_os_str())
        .to_string_lossy()
        .into_owned()
}

fn motion(case: &Case, file: &Path) -> GroundMotion {
    // Paths of arguments are relative to the working folder, not to the case.
    let absolute = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    GroundMotion {
        file: Located {
            value: absolute,
            span: case.ground_motion.file.span.clone(),
        },
        format: None,
        time_step: None,
        unit: None,
        layout: None,
        component: None,
        quantity: None,
        rotation: None,
        skip_lines: 0,
        skip_columns: 0,
        prepend_zero: false,
        lenient: false,
        sensitivity: None,
        gravity: None,
        offset: Offset::default(),
        // What the case does to its own record it does to all.
        process: case.ground_motion.process.clone(),
        scale: case.ground_motion.scale.clone(),
    }
}

fn assembled(case: &Case, file: &Path) -> Result<Assembly, CheckError> {
    assemble(case).map_err(|e| match e {
        AssemblyError::Case(error) => CheckError::Case(error),
        source => CheckError::Record {
            record: file.display().to_string(),
            source: Box::new(source),
        },
    })
}
