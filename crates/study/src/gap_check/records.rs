//! One case under many records.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

use pounding_assembly::{Assembly, AssemblyError, assemble, assemble_under_another_record};
use pounding_case::{Case, GroundMotion, Located};
use pounding_catalogue::wording::one_line;
use pounding_ground_motion::Offset;

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

/// Puts a case under each record: files, or folders of records as [`record_files`] lists
/// them. Without any, the case keeps its own record.
///
/// Records that are named here are read by their own headers (`time_step`, `unit` and
/// the other keys of `[ground_motion]` belong to the record of the case), keep the
/// `scale` of the case, and run for their own durations.
///
/// # Errors
/// A folder without records, a case or a record that cannot be used.
pub fn under_records(case: &Case, records: &[PathBuf]) -> Result<Vec<CaseUnderRecord>, CheckError> {
    if records.is_empty() {
        let file = case.resolve(&case.ground_motion.file.value);
        let assembly = assembled(case, &file, assemble)?;
        return Ok(vec![CaseUnderRecord {
            name: name_of_record(&file),
            file,
            assembly,
        }]);
    }
    let files = record_files(records)?.files;
    let names = distinct_names(files.iter().map(|file| name_of_record(file)));
    let cases = files.into_iter().zip(names);
    cases
        .map(|(file, name)| under_record(case, file, name))
        .collect()
}

/// Puts a case under a record of this name, as [`under_records`] does.
///
/// # Errors
/// A case or a record that cannot be used.
pub fn under_record(
    case: &Case,
    file: PathBuf,
    name: String,
) -> Result<CaseUnderRecord, CheckError> {
    let own = case.resolve(&case.ground_motion.file.value);
    let mut other = case.clone();
    other.ground_motion = motion(case, &file);
    other.analysis.duration = None;
    let assembly = match file == own {
        true => assembled(&other, &file, assemble),
        false => assembled(&other, &file, assemble_under_another_record),
    }?;
    Ok(CaseUnderRecord {
        name,
        file,
        assembly,
    })
}

/// Record files, and what lies beside them in folders.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecordFiles {
    /// The records, those of a folder in the order of their names.
    pub files: Vec<PathBuf>,
    /// Files of folders that are no records.
    pub skipped: Vec<SkippedFile>,
}

/// A file that lies among records and is none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SkippedFile {
    /// The file.
    pub path: PathBuf,
    /// What it is, such as "a script".
    pub what: &'static str,
}

impl std::fmt::Display for SkippedFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { path, what } = self;
        write!(
            f,
            "{} is {what}, not a record: it is left out",
            path.display()
        )
    }
}

/// Replaces folders by the records in them. Of a folder all files are taken but those that
/// plainly are none, by their name or their first bytes; folders in it are not looked into. A
/// file that is named itself is taken whatever it is.
///
/// # Errors
/// A folder that cannot be listed or holds no record, or a record that is given twice.
pub fn record_files(records: &[PathBuf]) -> Result<RecordFiles, CheckError> {
    let mut found = RecordFiles::default();
    for path in records {
        if !path.is_dir() {
            found.files.push(path.clone());
            continue;
        }
        let refused = |reason: String| CheckError::NoRecords {
            path: path.clone(),
            reason,
        };
        let entries = std::fs::read_dir(path).map_err(|e| refused(e.to_string()))?;
        let inside = entries.filter_map(|entry| entry.ok().map(|e| e.path()));
        let mut inside: Vec<PathBuf> = inside.filter(|p| p.is_file()).collect();
        inside.sort();
        let (mut taken, mut skipped) = (Vec::new(), Vec::new());
        for path in inside {
            match no_record(&path) {
                Some(what) => skipped.push(SkippedFile { path, what }),
                None => taken.push(path),
            }
        }
        if taken.is_empty() {
            let each = skipped.iter().map(|s| {
                let name = s.path.file_name().unwrap_or_default();
                format!("{} is {}", name.to_string_lossy(), s.what)
            });
            let each: Vec<_> = each.collect();
            return Err(refused(if each.is_empty() {
                "it holds no files; folders inside it are not looked into".to_owned()
            } else {
                format!("{}; folders inside it are not looked into", each.join(", "))
            }));
        }
        found.files.extend(taken);
        found.skipped.extend(skipped);
    }
    given_once(&found.files)?;
    Ok(found)
}

/// Endings of files that lie beside records, in lower case, with what they are.
const NO_RECORD: [(&str, &[&str]); 7] = [
    (
        "a text",
        &["md", "markdown", "rst", "html", "pdf", "doc", "docx", "odt"],
    ),
    (
        "a settings file",
        &["toml", "json", "yaml", "yml", "ini", "cfg"],
    ),
    (
        "a script",
        &["sh", "py", "m", "r", "jl", "ipynb", "bat", "ps1"],
    ),
    ("a picture", &["svg", "png", "jpg", "jpeg", "gif"]),
    ("a result", &["h5", "hdf5", "nc", "parquet"]),
    (
        "an archive",
        &["zip", "gz", "tgz", "tar", "7z", "xz", "bz2"],
    ),
    ("an unfinished file", &["part", "tmp", "bak", "swp"]),
];

/// What a file is that plainly is no record. One that cannot be opened may be a record: reading
/// it says what is wrong.
fn no_record(file: &Path) -> Option<&'static str> {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    if name.starts_with('.') {
        return Some("a hidden file");
    }
    let stem = name.split('.').next().unwrap_or_default().to_lowercase();
    if ["readme", "license", "licence", "provenance", "makefile"].contains(&stem.as_str()) {
        return Some("a text");
    }
    let ending = file.extension().unwrap_or_default().to_string_lossy();
    let ending = ending.to_lowercase();
    let by_ending = NO_RECORD
        .iter()
        .find(|(_, endings)| endings.contains(&ending.as_str()));
    if let Some((what, _)) = by_ending {
        return Some(what);
    }
    let mut first = [0; 2];
    // A pipe may never begin.
    let open = || std::fs::File::open(file);
    let read = file.is_file() && open().is_ok_and(|mut f| f.read_exact(&mut first).is_ok());
    (read && first == *b"#!").then_some("a script")
}

/// A record that counts twice would make the answer look surer than it is.
///
/// # Errors
/// The first one that does.
pub fn given_once(files: &[PathBuf]) -> Result<(), CheckError> {
    let mut seen = Vec::new();
    for file in files {
        let place = file.canonicalize().unwrap_or_else(|_| file.clone());
        if seen.contains(&place) {
            return Err(CheckError::record_given_twice(&file.display()));
        }
        seen.push(place);
    }
    Ok(())
}

/// Names of records in their order, made distinct by numbers where two are alike: `x`, `x (2)`.
pub fn distinct_names(names: impl IntoIterator<Item = String>) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for name in names {
        let name = distinct(&name, "", |name| all.iter().any(|n| n == name));
        all.push(name);
    }
    all
}

/// A name with an ending, with a number between them where one is known: `x (2).csv`.
pub fn distinct(name: &str, ending: &str, is_known: impl Fn(&str) -> bool) -> String {
    let mut distinct = format!("{name}{ending}");
    let mut number = 2;
    while is_known(&distinct) {
        distinct = format!("{name} ({number}){ending}");
        number += 1;
    }
    distinct
}

/// What a record is called: its file without folder and ending.
#[must_use]
pub fn name_of_record(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or(file.as_os_str());
    one_line(stem.to_string_lossy().into_owned())
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
        // A suite exchanges the record along the row.
        across: case.ground_motion.across.clone(),
        rotation: None,
        skip_lines: 0,
        skip_columns: 0,
        prepend_zero: false,
        lenient: false,
        sensitivity: None,
        response: None,
        gravity: None,
        offset: Offset::default(),
        // What the case does to its own record it does to all.
        process: case.ground_motion.process.clone(),
        scale: case.ground_motion.scale.clone(),
        places: BTreeMap::new(),
    }
}

fn assembled(
    case: &Case,
    file: &Path,
    assemble: fn(&Case) -> Result<Assembly, AssemblyError>,
) -> Result<Assembly, CheckError> {
    assemble(case).map_err(|e| match e {
        AssemblyError::Case(error) => CheckError::Case(error),
        source => CheckError::Record {
            record: file.display().to_string(),
            source: Box::new(source),
        },
    })
}
