//! How far a shard is, in a small file in the folder of all shards: `status` reads it on another
//! machine than the one that computes.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use pounding_files::{ELSEWHERE, PartFile, not_own};
use pounding_study::{Progress, ShardName, SweepReport};
use serde::{Deserialize, Serialize};

use crate::command_words::this_command;
use crate::failure::Failure;

/// Time between two beats of a shard that runs.
const BETWEEN: Duration = Duration::from_secs(10);
/// A shard that has not told of itself for this long is taken as ended: clocks of machines, and
/// file systems that several machines share, may lag.
const SILENT: Duration = Duration::from_secs(90);
/// More runs a second, or a time (s), than there can be.
const LONGEST: f64 = 1.0e15;
/// The folder of these files in that of the shards.
pub const FOLDER: &str = "status";

/// What a shard does, or how it ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// It computes, or did when it last told of itself.
    Running,
    /// Its result is complete.
    Done,
    /// A signal ended it.
    Interrupted,
    /// An error ended it.
    Failed,
}

/// What stands in the file.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Beat {
    /// What it does.
    pub state: State,
    /// Its runs.
    pub runs: usize,
    /// Those that have finished, in this call or before.
    pub finished: usize,
    /// Those that are stored.
    pub stored: usize,
    /// Failures among those of this call; once it is done, among all.
    pub failed: usize,
    /// Collapses among them.
    pub collapsed: usize,
    /// Runs a second of this call.
    pub rate: f64,
    /// Time that is left by this rate (s); unknown before the first run.
    pub remaining_seconds: Option<f64>,
    /// When the call began, and when this was written: seconds since 1970.
    pub began: u64,
    /// See `began`.
    pub updated: u64,
    /// Machine and process that compute.
    pub host: String,
    /// See `host`.
    pub process: u32,
    /// Folder in which the command was called, and its words.
    pub folder: PathBuf,
    /// See `folder`.
    pub command: Vec<String>,
    /// How it ended.
    pub message: String,
    /// When the file was written by the file system that all machines share: seconds since 1970.
    #[serde(skip)]
    written: Option<u64>,
}

impl Beat {
    /// Seconds since this was written: since the later of the time that it tells and that of its file, but for one
    /// that lies in the future. The clocks of machines differ: by one that is ahead a shard that has ended would seem to
    /// run, by one that is behind one that runs to have ended.
    pub fn silent(&self) -> u64 {
        let now = now();
        let has_been = |time: &u64| *time <= now + SILENT.as_secs();
        let times = self.written.into_iter().chain([self.updated]);
        let last = times.filter(has_been).max();
        last.map_or(0, |last| now.saturating_sub(last))
    }

    /// Whether its numbers are of one shard: what a program writes that counts runs.
    fn can_be(&self) -> bool {
        let ended = self.failed.checked_add(self.collapsed);
        let is_time = |seconds: &f64| (0.0..=LONGEST).contains(seconds);
        u32::try_from(self.runs).is_ok()
            && self.finished <= self.runs
            && self.stored <= self.runs
            && ended.is_some_and(|ended| ended <= self.finished)
            && (0.0..=LONGEST).contains(&self.rate)
            && self.remaining_seconds.as_ref().is_none_or(is_time)
    }

    /// Whether the shard computes, as far as can be known.
    pub fn is_running(&self) -> bool {
        self.state == State::Running && !self.is_gone()
    }

    /// Whether a shard that ran has ended without a word.
    pub fn is_gone(&self) -> bool {
        let ran_here = self.host == host() && !self.host.is_empty();
        (ran_here && !pounding_files::runs_here(self.process))
            || self.silent() > SILENT.max(3 * BETWEEN).as_secs()
    }
}

/// Writes the file of a shard from time to time.
#[derive(Debug)]
pub struct Heartbeat {
    path: PathBuf,
    /// Whether it has written: not before the shard is its own.
    begun: bool,
    began: Instant,
    last: Instant,
    beat: Beat,
    /// What a call before this one told, if it completed the result.
    done: Option<Beat>,
}

impl Heartbeat {
    /// Finds out whether it can tell how far a shard is. What another process tells of the shard
    /// stays until this one is at work.
    ///
    /// # Errors
    /// A file that cannot be written, or somebody's in its place.
    pub fn begin(folder: &Path, shard: &ShardName) -> Result<Self, Failure> {
        let path = path(folder, shard);
        let failed = |e: std::io::Error| {
            let about = match path.symlink_metadata() {
                Ok(_) => path.as_path(),
                Err(_) => path.parent().unwrap_or(folder),
            };
            Failure::output(&e, &about.display().to_string())
        };
        if let Some((path, reason)) = not_own(&path, is_own) {
            return Err(Failure::unwritten(
                format!("cannot write {}: {reason}", path.display()),
                Some(ELSEWHERE.to_owned()),
            ));
        }
        std::fs::create_dir_all(folder.join(FOLDER)).map_err(failed)?;
        PartFile::own(&path).map_err(failed)?;
        Ok(Self {
            done: read(folder, shard).filter(|beat| beat.state == State::Done),
            path: path.clone(),
            begun: false,
            began: Instant::now(),
            last: Instant::now(),
            beat: Beat {
                state: State::Running,
                runs: 0,
                finished: 0,
                stored: 0,
                failed: 0,
                collapsed: 0,
                rate: 0.0,
                remaining_seconds: None,
                began: now(),
                updated: now(),
                host: host(),
                process: std::process::id(),
                folder: std::env::current_dir().unwrap_or_default(),
                command: this_command(),
                message: String::new(),
                written: None,
            },
        })
    }

    /// Tells how far it is, if it is time to.
    pub fn beat(&mut self, progress: &Progress) {
        let beat = &mut self.beat;
        beat.runs = progress.total;
        beat.finished = progress.stored_before + progress.made;
        beat.stored = progress.stored;
        (beat.failed, beat.collapsed) = (progress.failed, progress.collapsed);
        let seconds = self.began.elapsed().as_secs_f64();
        beat.rate = progress.made as f64 / seconds.max(1.0e-3);
        let left = beat.runs - beat.finished;
        beat.remaining_seconds = (beat.rate > 0.0).then_some(left as f64 / beat.rate);
        if !self.begun || self.last.elapsed() >= BETWEEN {
            self.report();
        }
    }

    /// Tells that the result is complete.
    pub fn done(&mut self, report: &SweepReport) {
        let beat = &mut self.beat;
        (beat.runs, beat.finished, beat.stored) = (report.runs, report.runs, report.runs);
        (beat.failed, beat.collapsed) = (report.failed, report.collapsed);
        beat.remaining_seconds = Some(0.0);
        self.end(State::Done, "");
    }

    /// Tells that an error has ended it. A call that was refused before it made a run says nothing where
    /// the result of the shard stands, whichever version of the study it is of, or another process is at
    /// work there; where the same result stands after work, what was told of it stays true.
    pub fn failed(&mut self, message: &str, (stands, result_stands): (bool, bool)) {
        let at_work = || read_at(&self.path).is_some_and(|beat| beat.is_running());
        if !self.begun && (stands || at_work()) {
            return;
        }
        match self.done.take().filter(|_| result_stands) {
            Some(done) => {
                self.beat = done;
                // As in `told`.
                let _ = self.write();
            }
            None => self.end(State::Failed, message),
        }
    }

    /// Tells how it ended.
    pub fn end(&mut self, state: State, message: &str) {
        self.beat.state = state;
        message.clone_into(&mut self.beat.message);
        self.report();
    }

    fn report(&mut self) {
        self.begun = true;
        self.last = Instant::now();
        self.beat.updated = now();
        // Runs are worth more than word of them: a full disk is reported where they are stored.
        let _ = self.write();
    }

    fn write(&self) -> std::io::Result<()> {
        let text = serde_json::to_string(&self.beat)?;
        pounding_files::write_own(&self.path, text.as_bytes())
    }
}

/// Reads what a shard last told of itself; `None` if it told nothing.
pub fn read(folder: &Path, shard: &ShardName) -> Option<Beat> {
    read_at(&path(folder, shard))
}

fn read_at(path: &Path) -> Option<Beat> {
    let text = pounding_files::input::read(path).ok()?;
    let beat: Option<Beat> = serde_json::from_slice(&text).ok();
    let written = path.metadata().and_then(|file| file.modified()).ok();
    let written = written.map(seconds);
    beat.filter(Beat::can_be)
        .map(|beat| Beat { written, ..beat })
}

/// Whether a file is what a shard of this or of another version tells of itself, be it damaged behind its beginning.
fn is_own(text: &[u8]) -> bool {
    let has = |keys: [&str; 3]| {
        let value: Result<serde_json::Value, _> = serde_json::from_slice(text);
        value.is_ok_and(|value| keys.iter().all(|key| value.get(key).is_some()))
    };
    const BEGINNING: &[u8] = b"{\"state\":\"";
    let rest = text.strip_prefix(BEGINNING);
    let word = rest.and_then(|rest| rest.split(|byte| *byte == b'"').next());
    let states: [&[u8]; 4] = [b"running", b"done", b"interrupted", b"failed"];
    let is_cut = BEGINNING.starts_with(text)
        || word.is_some_and(|word| states.iter().any(|state| state.starts_with(word)));
    is_cut || has(["state", "runs", "finished"])
}

/// The file in which a shard writes its status, if it is not what a shard writes.
pub fn damaged(folder: &Path, shard: &ShardName) -> Option<PathBuf> {
    let path = path(folder, shard);
    (path.symlink_metadata().is_ok() && read_at(&path).is_none()).then_some(path)
}

/// The shards that have written their status.
pub fn shards_with_status(folder: &Path) -> Vec<ShardName> {
    let entries = std::fs::read_dir(folder.join(FOLDER)).into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let shard = |name: String| ShardName::of(&format!("{}.h5", name.strip_suffix(".json")?));
    names.filter_map(shard).collect()
}

fn path(folder: &Path, shard: &ShardName) -> PathBuf {
    folder.join(FOLDER).join(format!("{shard}.json"))
}

/// Seconds since 1970, now.
fn now() -> u64 {
    seconds(SystemTime::now())
}

/// Seconds since 1970.
fn seconds(time: SystemTime) -> u64 {
    let since = time.duration_since(UNIX_EPOCH);
    since.map_or(0, |time| time.as_secs())
}

/// Name of this machine; empty where it is not known.
fn host() -> String {
    #[cfg(unix)]
    return rustix::system::uname()
        .nodename()
        .to_string_lossy()
        .into_owned();
    #[cfg(not(unix))]
    std::env::var("COMPUTERNAME").unwrap_or_default()
}
