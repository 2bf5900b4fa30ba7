//! What can go wrong with a study.

use std::path::PathBuf;

use pounding_assembly::AssemblyError;
use pounding_case::{CaseError, MORE_FILES, is_short_of_files};
use pounding_catalogue::wording::{agreeing, counted};
use pounding_files::{ELSEWHERE, PlaceTaken};
use pounding_ground_motion::GroundMotionError;
use pounding_results::study::StudyFileError;

/// A study that cannot be read, run, written or evaluated. A run that fails is none: it
/// is recorded with its diagnosis.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// Something wrong in the study file or in its case, with its place.
    #[error("{error}")]
    Text {
        /// What and where.
        error: Box<CaseError>,
        /// The text that it points into.
        source_text: String,
    },
    /// Things wrong in several files that were read together.
    #[error("{}", lines(errors))]
    Several {
        /// Each file's.
        errors: Vec<StudyError>,
    },
    /// The case of the study cannot be assembled.
    #[error(transparent)]
    Base(#[from] AssemblyError),
    /// A motion cannot be made or measured.
    #[error(transparent)]
    GroundMotion(#[from] GroundMotionError),
    /// Records that cannot be read.
    #[error("{} cannot be read:\n{list}", unread(*count, *of))]
    Records {
        /// How many.
        count: usize,
        /// Records of the study.
        of: usize,
        /// Each with its reason, a line each.
        list: String,
    },
    /// A study whose path is no text: its files could not be named in a case.
    #[error("the path of the study is not UTF-8: {path}")]
    NotUtf8 {
        /// The whole path.
        path: PathBuf,
    },
    /// A file cannot be read or written.
    #[error("cannot {what} {path}: {source}")]
    File {
        /// What was tried.
        what: &'static str,
        /// File or folder.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// Somebody's file or link in the place of what the shards of a study keep beside their results.
    #[error("cannot write {path}: {reason}")]
    NotOwn {
        /// The file or the link.
        path: PathBuf,
        /// What it is.
        reason: &'static str,
    },
    /// The table of runs cannot be written.
    #[error("cannot write {path}, the table of the runs: {source}")]
    Table {
        /// The table.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
        /// Whether runs of this call are stored, with which another one goes on.
        stored: bool,
    },
    /// A finished chunk cannot be stored; what was stored before stays.
    #[error(
        "cannot store runs in {folder}: {source}; {stored} of {} {} stored there and intact",
        counted(*of, "run"),
        agreeing(of, "is", "are")
    )]
    Store {
        /// Folder of the finished chunks.
        folder: PathBuf,
        /// What the system said.
        source: std::io::Error,
        /// Runs stored.
        stored: usize,
        /// Runs asked for.
        of: usize,
    },
    /// Finished runs of an earlier, interrupted call.
    #[error("{folder} holds {stored} finished runs of this study from an interrupted call")]
    Unfinished {
        /// Folder of the finished chunks.
        folder: PathBuf,
        /// Runs stored.
        stored: usize,
    },
    /// Finished runs of another study, or of another version of this one.
    #[error("{folder} holds runs of another study, of another version of it, or of another shard")]
    OtherStudy {
        /// Folder of the finished chunks.
        folder: PathBuf,
    },
    /// Finished runs of this study that another build of the program computed.
    #[error("{folder} holds runs of another build of the program ({build}); this one is {this}")]
    OtherBuild {
        /// Folder of the finished chunks.
        folder: PathBuf,
        /// Build that computed them.
        build: String,
        /// Build that is running.
        this: String,
    },
    /// A file in the place of a result that is to go on, which is not that result.
    #[error("{path} is not the result that --resume goes on with: {reason}")]
    Standing {
        /// The file.
        path: PathBuf,
        /// What it is.
        reason: String,
    },
    /// The result of another shard in the place of that of this one.
    #[error("{path} is not replaced: {reason}")]
    OtherShard {
        /// The file.
        path: PathBuf,
        /// What it is.
        reason: String,
    },
    /// A result in the place of a merged one that does not hold all of its shards.
    #[error("{path} is not replaced: {reason}, which is not among what is merged")]
    NotMerged {
        /// The file.
        path: PathBuf,
        /// What it is.
        reason: String,
    },
    /// An output in the place of a file that the result was made of.
    #[error("{path} is not replaced: it is a {what} that this study was made of")]
    Input {
        /// The file.
        path: PathBuf,
        /// What it is.
        what: &'static str,
    },
    /// The name of a shard for another result, by which commands would take it for that shard.
    #[error("{path} has the name of a shard, {shard}, which the result is not")]
    NamedAsShard {
        /// The file.
        path: PathBuf,
        /// Number of the shard and of all, as I of N.
        shard: String,
    },
    /// Another process works on the same runs.
    #[error("another process is working in {folder}")]
    Busy {
        /// Folder of the finished chunks.
        folder: PathBuf,
    },
    /// A result that cannot be written, read or merged.
    #[error(transparent)]
    ResultFile(#[from] StudyFileError),
    /// An output that is an input, or another output.
    #[error(transparent)]
    FileUse(#[from] pounding_files::FileUseError),
    /// The study was stopped; what had finished is stored.
    #[error(
        "interrupted: {stored} of {} {} stored",
        counted(*of, "run"),
        agreeing(of, "is", "are")
    )]
    Interrupted {
        /// Runs stored.
        stored: usize,
        /// Runs asked for.
        of: usize,
    },
    /// A shard that does not exist.
    #[error("\"{text}\" is no shard")]
    Shard {
        /// As given.
        text: String,
    },
    /// A run that does not exist.
    #[error("run {run} does not exist; the study has runs 0 to {last}")]
    NoSuchRun {
        /// Number asked for.
        run: usize,
        /// Last number.
        last: usize,
    },
    /// A run whose case cannot be written out alone.
    #[error("the case of run {run} cannot be shown: {reason}")]
    NotShown {
        /// Number of the run.
        run: usize,
        /// Why.
        reason: String,
    },
    /// A state of an incremental dynamic analysis that some run has no demand for.
    #[error("{state}: {reason}")]
    NoDemand {
        /// Name of the state.
        state: String,
        /// Why there is none.
        reason: &'static str,
        /// What to ask for instead.
        help: &'static str,
    },
    /// Records of buildings or across the row that keep no proportion, for want of the record of
    /// the case.
    #[error(
        "records of buildings and across the row keep their proportion to the record of the case, and that has no intensity: {reason}"
    )]
    Proportion {
        /// Why it has none.
        reason: String,
    },
    /// Counts or a hazard curve that allow no answer.
    #[error("{what}: {reason}")]
    Evaluation {
        /// What was to be computed.
        what: &'static str,
        /// Why it cannot be.
        reason: String,
    },
}

/// So many records of all.
fn unread(count: usize, of: usize) -> String {
    match of {
        1 => "the record".to_owned(),
        _ => format!("{count} of the {of} records"),
    }
}

/// Errors, a line each.
fn lines(errors: &[StudyError]) -> String {
    let lines: Vec<String> = errors.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

impl StudyError {
    /// One error of some, of which there is at least one.
    pub(crate) fn of_all(mut errors: Vec<Self>) -> Self {
        match errors.pop() {
            Some(only) if errors.is_empty() => only,
            last => {
                errors.extend(last);
                Self::Several { errors }
            }
        }
    }

    /// Whether the system allows this process, or all of them, no more open files: no fault of the
    /// input.
    #[must_use]
    pub fn is_short_of_files(&self) -> bool {
        match self {
            Self::File { source, .. } | Self::Store { source, .. } => is_short_of_files(source),
            Self::GroundMotion(GroundMotionError::Io { source, .. }) => is_short_of_files(source),
            Self::Text { error, .. } => error.is_short_of_files(),
            _ => false,
        }
    }

    /// What to try.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let text = match self {
            Self::Text { error, .. } => return error.help.clone(),
            Self::Several { errors } => return errors.first().and_then(Self::help),
            Self::Base(error) => return error.help(),
            Self::GroundMotion(_) if self.is_short_of_files() => MORE_FILES,
            Self::GroundMotion(error) => return error.help(),
            Self::Records { count, of, .. } if count == of => "correct the paths or the files",
            Self::Records { .. } => {
                "correct the paths or the files; with --keep-going their runs are recorded as failed and all others are computed"
            }
            Self::File { .. } | Self::Store { .. } if self.is_short_of_files() => {
                "allow more open files (`ulimit -n`), or name no table beside the result; runs that have finished are stored, and --resume goes on with them"
            }
            Self::File { .. } => {
                "check that the folder exists, may be written to and has room, or name another file with -o"
            }
            Self::NotOwn { .. } => ELSEWHERE,
            Self::Table { source, stored, .. } => match (PlaceTaken::of(source), stored) {
                (Some(taken), _) => return Some(taken.help()),
                (None, false) => {
                    "check that its folder exists, may be written to and has room, or name another table with --csv"
                }
                (None, true) => {
                    "make room, or name another table with --csv; the runs that have finished are stored, and --resume goes on with them and writes the table"
                }
            },
            Self::Store { .. } => {
                "make room, then go on with --resume: only the runs that are not stored are computed"
            }
            Self::Unfinished { .. } => "go on with --resume, or remove the folder to begin anew",
            Self::OtherStudy { .. } => {
                "name another result with -o, give all shards one folder with --into, where each has a name of its own, or remove the folder if its runs are of no use"
            }
            Self::OtherBuild { .. } => {
                "go on with the build that began, name another result with -o, or remove the folder to make all runs anew"
            }
            Self::Standing { .. } => {
                "name another result with -o, or move the file away if it is of no use"
            }
            Self::OtherShard { .. } => {
                "name another result with -o, or give all shards one folder with --into, where each has a name of its own; move the file away if it is of no use"
            }
            Self::NotMerged { .. } => {
                "name another result with -o, merge this one with the others, or move it away if it is of no use"
            }
            Self::Input { .. } => "give the output another name",
            Self::NotUtf8 { .. } => "rename the file, or the folder, in UTF-8",
            Self::NamedAsShard { .. } => "name another result with -o",
            Self::Busy { .. } => "wait for it, or name another result with -o",
            Self::ResultFile(error) => return Some(error.help()),
            Self::FileUse(error) => return Some(error.help()),
            Self::Interrupted { .. } => "go on with --resume",
            Self::Shard { .. } => {
                "write i/n with i from 1 to n, such as 2/8, and n up to 1,000,000"
            }
            Self::NoSuchRun { .. } => return None,
            Self::NotShown { .. } => {
                "write the record of the case under a header [ground_motion], with `scale` as one entry of it"
            }
            Self::NoDemand { help, .. } => help,
            Self::Proportion { .. } => {
                "give [ground_motion] of the case the record that the others belong to, in `file`"
            }
            Self::Evaluation { .. } => {
                "choose levels of intensity from where no record pounds to where all do, and more records"
            }
        };
        Some(text.to_owned())
    }
}
