//! Records of a study in the folder of its shards: each once, by its hash.
//!
//! The first shard that comes reads all records, copies each under the name of its hash and
//! writes down the hash, the intensity, and by what a changed file is told. The others
//! look these up, and read the records of their own runs alone, from the copies.

use std::fs::Metadata;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::motion::Motion;
use super::named_files::named_files;
use crate::case_text::canonical;
use crate::error::StudyError;
use crate::study_file::{RecordKind, RecordSource, Study};
use pounding_files::checksum::hexadecimal;
use pounding_files::not_own;

/// The folder of the copies in that of the shards.
pub const FOLDER: &str = "records";
/// The list of what is known of them.
const LIST: &str = "list.json";

/// What is known of the records of a study.
#[derive(Debug)]
pub(super) struct SharedRecords {
    folder: PathBuf,
    list: List,
}

/// What stands in the list.
#[derive(Debug, Serialize, Deserialize)]
struct List {
    /// Hash of study and case, which say how records are read and measured, and of the build.
    study: String,
    records: Vec<Known>,
    /// Of both, see [`List::sum`]. A list without one is of another build, and so never of this study.
    #[serde(default)]
    checksum: String,
}

impl List {
    /// The checksum that belongs to what stands in the list.
    fn sum(&self) -> Result<String, serde_json::Error> {
        let text = serde_json::to_vec(&(&self.study, &self.records))?;
        Ok(hexadecimal(&Sha256::digest(text)))
    }

    /// Whether it is as it was written: a record that is believed is not read again.
    fn is_whole(&self) -> bool {
        self.sum().is_ok_and(|sum| sum == self.checksum)
    }
}

/// Whether a file is a list of this or of another version, be it damaged behind its beginning.
fn is_own(text: &[u8]) -> bool {
    const BEGINNING: &[u8] = b"{\"study\":\"";
    const HASH: usize = 64;
    let rest = text.strip_prefix(BEGINNING);
    let hash = rest.map(|rest| &rest[..rest.len().min(HASH)]);
    let is_hash = |hash: &[u8]| hash.iter().all(u8::is_ascii_hexdigit);
    let laid_out = || {
        let value: Result<serde_json::Value, _> = serde_json::from_slice(text);
        let study = value.ok()?;
        Some(is_hash(study["study"].as_str()?.as_bytes()) && study["records"].is_array())
    };
    BEGINNING.starts_with(text) || hash.is_some_and(is_hash) || laid_out() == Some(true)
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Known {
    name: String,
    file: PathBuf,
    stamp: Stamp,
    sha256: String,
    /// See [`Motion::first`].
    first: String,
    /// The bits of the intensity, so that none is lost.
    intensity: Option<u64>,
    /// The bits of the time of the peak.
    peak_time: u64,
    /// See [`Motion::warnings`]: every shard has them, so that the merged result does.
    warnings: Vec<String>,
}

/// By what a file that was changed is told, or another in its place: programs that copy set the time of
/// change of the content, and the size may be the same.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Stamp {
    size: u64,
    /// Nanoseconds since 1970.
    modified: u128,
    /// Of the system: when anything of the file changed last (s, ns), and its number.
    state: Option<(i64, i64, u64)>,
}

impl SharedRecords {
    /// Opens the list in a folder of shards; an empty one if there is none, or one that is damaged or of
    /// another study.
    ///
    /// # Errors
    /// Somebody's file in the place of the list, or a link in that of its folder, where records will be copied.
    pub(super) fn open(folder: &Path, study: &Study) -> Result<Self, StudyError> {
        let folder = folder.join(FOLDER);
        let copies = study.records.iter().any(|source| file(source).is_some());
        let in_the_way = not_own(&folder.join(LIST), is_own).filter(|_| copies);
        if let Some((path, reason)) = in_the_way {
            return Err(StudyError::NotOwn { path, reason });
        }
        let mut hash = Sha256::new();
        hash.update(crate::BUILD);
        for text in [&study.source, &study.base.source] {
            hash.update(canonical(text));
            hash.update([0]);
        }
        // Periods of buildings and target spectra, which records are measured by or fitted to.
        named_files(study).iter().for_each(|f| hash.update(f));
        let study = hexadecimal(&hash.finalize());
        let list = pounding_files::input::read(&folder.join(LIST)).ok();
        let list = list.and_then(|text| serde_json::from_slice::<List>(&text).ok());
        let list = list.filter(|list| list.study == study && list.is_whole());
        Ok(Self {
            folder,
            list: list.unwrap_or(List {
                study,
                records: Vec::new(),
                checksum: String::new(),
            }),
        })
    }

    /// What is known of a record whose file is as it was, or gone.
    pub(super) fn known(&self, source: &RecordSource) -> Option<Motion> {
        let file = file(source)?;
        let mut known = self.list.records.iter();
        let known = known.find(|k| k.name == source.name && k.file == file)?;
        // Of a file that is gone the copy is left.
        if stamp(&file).is_some_and(|now| now != known.stamp) {
            return None;
        }
        Some(Motion {
            record: None,
            sha256: known.sha256.clone(),
            first: known.first.clone(),
            intensity: known.intensity.map(f64::from_bits),
            peak_time: f64::from_bits(known.peak_time),
            warnings: known.warnings.clone(),
        })
    }

    /// Copies the records that were read, and writes down what is known of them.
    ///
    /// # Errors
    /// A folder that cannot be written to.
    pub(super) fn add(
        &mut self,
        sources: &[RecordSource],
        motions: &[Result<Motion, String>],
    ) -> Result<(), StudyError> {
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |source| StudyError::File {
                what: "write",
                path,
                source,
            }
        };
        let before = self.list.records.clone();
        for (source, motion) in sources.iter().zip(motions) {
            let (Some(file), Ok(motion)) = (file(source), motion) else {
                continue;
            };
            // Synthetic motions are made anew; those without a record are known.
            let (Some(_), Some(stamp)) = (&motion.record, stamp(&file)) else {
                continue;
            };
            let Ok(bytes) = std::fs::read(&file) else {
                continue;
            };
            // Changed since it was read: nothing of it is written down.
            if hexadecimal(&Sha256::digest(&bytes)) != motion.sha256 {
                continue;
            }
            std::fs::create_dir_all(&self.folder).map_err(failed(&self.folder))?;
            let copy = self.folder.join(name(&file, &motion.sha256));
            if !copy.is_file() {
                pounding_files::write_own(&copy, &bytes).map_err(failed(&copy))?;
            }
            self.list.records.retain(|k| k.name != source.name);
            self.list.records.push(Known {
                name: source.name.clone(),
                file,
                stamp,
                sha256: motion.sha256.clone(),
                first: motion.first.clone(),
                intensity: motion.intensity.map(f64::to_bits),
                peak_time: motion.peak_time.to_bits(),
                warnings: motion.warnings.clone(),
            });
        }
        if self.list.records == before {
            return Ok(());
        }
        let path = self.folder.join(LIST);
        let sum = self.list.sum().map(|sum| self.list.checksum = sum);
        let text = sum.and_then(|()| serde_json::to_string(&self.list));
        let text = text.map_err(std::io::Error::from);
        let written = text.and_then(|text| pounding_files::write_own(&path, text.as_bytes()));
        written.map_err(failed(&path))
    }
}

/// A record read from its copy; `None` if there is none that is whole.
pub(super) fn copy(folder: &Path, source: &RecordSource, sha256: &str) -> Option<RecordKind> {
    let RecordKind::File { case, edits } = &source.kind else {
        return None;
    };
    let path = folder.join(FOLDER).join(name(&file(source)?, sha256));
    let path = std::path::absolute(path).ok()?;
    let bytes = pounding_files::input::read(&path).ok()?;
    if hexadecimal(&Sha256::digest(bytes)) != sha256 {
        return None;
    }
    let mut case = case.clone();
    case.ground_motion.file.value = path;
    Some(RecordKind::File {
        case,
        edits: edits.clone(),
    })
}

/// The name of a copy: its hash, and the ending of the file, which may tell its format.
fn name(file: &Path, sha256: &str) -> String {
    match file.extension().and_then(|e| e.to_str()) {
        Some(ending) => format!("{sha256}.{ending}"),
        None => sha256.to_owned(),
    }
}

/// The file of a record; `None` of a synthetic one.
fn file(source: &RecordSource) -> Option<PathBuf> {
    let RecordKind::File { case, .. } = &source.kind else {
        return None;
    };
    let file = case.resolve(&case.ground_motion.file.value);
    std::path::absolute(file).ok()
}

fn stamp(file: &Path) -> Option<Stamp> {
    let found = std::fs::metadata(file).ok()?;
    let modified = found.modified().ok()?.duration_since(UNIX_EPOCH).ok()?;
    Some(Stamp {
        size: found.len(),
        modified: modified.as_nanos(),
        state: state(&found),
    })
}

#[cfg(unix)]
fn state(found: &Metadata) -> Option<(i64, i64, u64)> {
    use std::os::unix::fs::MetadataExt;
    Some((found.ctime(), found.ctime_nsec(), found.ino()))
}

#[cfg(not(unix))]
fn state(_: &Metadata) -> Option<(i64, i64, u64)> {
    None
}
