//! A file that is written beside its place.

use std::ffi::OsString;
use std::fs::{File, OpenOptions};
use std::io::{Error, ErrorKind, Read, Result, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::TempPath;

use crate::ends_in_a_file_name;

/// Part files of this process that stand on the disk.
static STANDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn standing() -> MutexGuard<'static, Vec<PathBuf>> {
    STANDING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What is asked of a target right before a file takes its place; why it may not, if so.
type Question = dyn Fn(&Path) -> std::result::Result<(), String> + Send + Sync;

/// All questions that are asked, each with its number.
static QUESTIONS: Mutex<Vec<(u64, Box<Question>)>> = Mutex::new(Vec::new());

fn questions() -> MutexGuard<'static, Vec<(u64, Box<Question>)>> {
    QUESTIONS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A question that is asked of targets until this is dropped.
#[derive(Debug)]
#[must_use = "dropped, the question is asked no more"]
pub struct AskedOfTargets(u64);

impl AskedOfTargets {
    /// Has the question asked as long as the process lives.
    pub fn to_the_end(self) {
        std::mem::forget(self);
    }
}

impl Drop for AskedOfTargets {
    fn drop(&mut self) {
        questions().retain(|(number, _)| *number != self.0);
    }
}

/// Has this process ask something of every target, as it was named, right before a file takes its
/// place: what was found out before the work, another process may have changed since. Where the
/// answer is why it may not, the file gets a name of its own: see [`PlaceTaken`].
pub fn ask_of_targets(
    question: impl Fn(&Path) -> std::result::Result<(), String> + Send + Sync + 'static,
) -> AskedOfTargets {
    let mut all = questions();
    let number = all.last().map_or(0, |(last, _)| last + 1);
    all.push((number, Box::new(question)));
    AskedOfTargets(number)
}

/// What is told of a file that is replaced: its name as it was given, and the new file beside it.
type Told = dyn Fn(&Path, &Path) + Send + Sync;

/// Who is told, if anybody is.
static TOLD: Mutex<Option<Box<Told>>> = Mutex::new(None);

/// Has somebody told of every file of this process that takes the place of another one, right before it does:
/// with the target as it was named, and the whole new file. Of several, the last that asked for it.
pub fn tell_of_replaced(told: impl Fn(&Path, &Path) + Send + Sync + 'static) {
    *TOLD.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(told));
}

/// A file that has not taken its place, and stands whole beside it. [`PartFile::finish`] gives it
/// within the error of the system.
#[derive(Debug, thiserror::Error)]
#[error("{reason}; what was to be written there is in {}", aside.display())]
pub struct PlaceTaken {
    /// Why it may not be there.
    pub reason: String,
    /// Where it is.
    pub aside: PathBuf,
}

impl PlaceTaken {
    /// What an error of the system says of a file that stands beside its place.
    #[must_use]
    pub fn of(error: &Error) -> Option<&Self> {
        error.get_ref()?.downcast_ref()
    }

    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        format!(
            "it is whole: give {} another name, or move away what stands there",
            self.aside.display()
        )
    }
}

/// Bytes of the target's name that stand in that of its part file: with what follows it
/// stays below 255, which is all that most file systems take.
const NAME: usize = 200;

/// A file that is written beside its place under a name of its own, `NAME.PROCESS-RANDOM.part`,
/// and takes its place when it is whole.
///
/// No other process writes into it, whether file locking works or not: of two processes that
/// write the same target both come to their end, and the last one's file stays, unless it may not
/// replace the other's ([`ask_of_targets`]). Dropped
/// without [`finish`](Self::finish), the part file is removed, and what stood in its place
/// before is untouched. A process that is killed without notice (SIGKILL) leaves it behind.
#[derive(Debug)]
pub struct PartFile {
    /// Removes the file when it is dropped; `None` once that is done.
    part: Option<TempPath>,
    path: PathBuf,
    /// The target as it was named, and what it led to.
    named: PathBuf,
    target: PathBuf,
}

impl PartFile {
    /// Creates an empty part file beside `target`. A link is followed: the file that it
    /// names will be replaced, not the link.
    ///
    /// # Errors
    /// If the target is a folder or is named as one, a device, what a process has opened (`/dev/stdout`, `/proc/self/fd/1`) or
    /// read-only, or the folder does not exist or cannot be written to.
    pub fn beside(target: &Path) -> Result<Self> {
        Self::at(target, place_of(target)?)
    }

    /// The same for a file that the program names by itself, as it does what it keeps beside results: nobody has asked
    /// for the file that a link in its place leads to to be replaced. A link that comes meanwhile is replaced itself.
    ///
    /// # Errors
    /// As [`beside`](Self::beside), and any link.
    pub fn own(target: &Path) -> Result<Self> {
        match target.symlink_metadata() {
            Ok(found) if found.is_symlink() => Err(Error::other(
                "it is a link, which is not followed there; remove it",
            )),
            Ok(found) if !found.is_file() => Err(Error::other("it is not a regular file")),
            _ => Self::at(target, target.to_owned()),
        }
    }

    fn at(named: &Path, target: PathBuf) -> Result<Self> {
        let named = named.to_owned();
        // Renaming asks the folder alone: who takes away the right to write means the file.
        if target.metadata().is_ok_and(|m| m.permissions().readonly()) {
            return Err(Error::other("it is read-only"));
        }
        let folder = folder_of(&target);
        let prefix = format!("{}{}-", start_of_name(&target), std::process::id());
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix).suffix(ENDING);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What any new file gets, less what the user's mask takes away; of one's own file that is replaced, no more
            // than it has, so that nobody else reads the new one before it is whole.
            let mode = own_mode(&target).map_or(0o666, |mode| mode & 0o666);
            builder.permissions(std::fs::Permissions::from_mode(mode));
        }
        let mut all = standing();
        let part = builder
            .tempfile_in(folder)
            .map_err(|e| made_beside(folder, &e))?;
        let part = part.into_temp_path();
        let path = part.to_path_buf();
        all.push(path.clone());
        Ok(Self {
            part: Some(part),
            path,
            named,
            target,
        })
    }

    /// Where to write. The file is there, and empty at first; it may be opened by name and
    /// truncated, but not replaced.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The file in whose place it will be.
    #[must_use]
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Brings the file to the disk, puts it in its place, and brings that to the disk.
    ///
    /// # Errors
    /// What the system said; the target is as it was then, and the part file is removed. Or
    /// [`PlaceTaken`]: the target is as it was as well, and the file stands beside it.
    pub fn finish(self) -> Result<()> {
        let all = questions();
        self.finish_if(|target| all.iter().try_for_each(|(_, question)| question(target)))
    }

    fn finish_if(mut self, may: impl Fn(&Path) -> std::result::Result<(), String>) -> Result<()> {
        OpenOptions::new()
            .write(true)
            .open(&self.path)?
            .sync_all()?;
        keep_permissions(&self.path, &self.target);
        if let Some(part) = self.part.take() {
            let placed = place(part, (&self.named, &self.target), may);
            standing().retain(|p| *p != self.path);
            placed?;
        }
        // The file stands whole in its place. A folder that cannot be opened or brought to the
        // disk, as on some file systems, takes nothing from that.
        if let Some(folder) = self.target.parent() {
            let _ = File::open(folder).and_then(|f| f.sync_all());
        }
        Ok(())
    }
}

impl Drop for PartFile {
    fn drop(&mut self) {
        if let Some(part) = self.part.take() {
            let mut all = standing();
            // Half a file is worthless; one that cannot be removed is in nobody's way.
            let _ = part.close();
            all.retain(|p| *p != self.path);
        }
    }
}

/// What to do about [`not_own`].
pub const ELSEWHERE: &str =
    "move it away, or give the shards a folder of their own with another --into";

/// What stands in the way of a file that the program keeps in a folder which a user has named, and why: a link in the
/// place of the file's folder, which would have it written elsewhere, or a file that does not begin as one of the
/// program. An empty one, or one of zeros, holds nothing, and of a link in its own place [`PartFile::own`] tells.
#[must_use]
pub fn not_own(path: &Path, is_own: impl Fn(&[u8]) -> bool) -> Option<(PathBuf, &'static str)> {
    /// Bytes that are looked at.
    const BEGINNING: u64 = 1 << 20;
    let folder = folder_of(path);
    if folder.is_symlink() {
        return Some((
            folder.to_owned(),
            "it is a link, which is not followed there",
        ));
    }
    if !path.symlink_metadata().is_ok_and(|found| found.is_file()) {
        return None;
    }
    let mut bytes = Vec::new();
    let read =
        crate::input::open(path).and_then(|file| file.take(BEGINNING).read_to_end(&mut bytes));
    // What a loss of power leaves is zeros.
    let blank = |byte: &u8| *byte == 0 || byte.is_ascii_whitespace();
    // Of a file that cannot be read, as of another user who shares the folder, nothing is known.
    let foreign = read.is_ok() && !bytes.iter().all(blank) && !is_own(&bytes);
    foreign.then(|| {
        (
            path.to_owned(),
            "a file stands there that is not of this program",
        )
    })
}

/// Gives a new file the permissions of the one that it replaces, where both belong to the same user and group: to others
/// the same permissions are other ones. A file system that has none keeps those of a new file.
#[cfg(unix)]
fn keep_permissions(part: &Path, target: &Path) {
    use std::os::unix::fs::{MetadataExt, PermissionsExt};
    let (Ok(new), Ok(before)) = (part.metadata(), target.metadata()) else {
        return;
    };
    if let Some(mode) = own_mode(target).filter(|_| new.gid() == before.gid()) {
        let _ = std::fs::set_permissions(part, std::fs::Permissions::from_mode(mode));
    }
}

/// The permissions of a file of this process's user. What its owner cannot read and write is meant for nobody.
#[cfg(unix)]
fn own_mode(path: &Path) -> Option<u32> {
    use std::os::unix::fs::MetadataExt;
    let found = path.metadata().ok()?;
    let mode = found.mode() & 0o777;
    let is_own = found.uid() == rustix::process::geteuid().as_raw();
    (is_own && mode & 0o600 == 0o600).then_some(mode)
}

#[cfg(not(unix))]
fn keep_permissions(_: &Path, _: &Path) {}

/// How often a place is looked at anew in which something comes and goes.
const ROUNDS: usize = 100;
/// Names beside a place that are tried.
const NAMES: usize = 10_000;

/// Puts a whole file in its place, or beside it where it may not be there.
///
/// Part files are held only while the file is renamed: a process that is asked to end does not wait for questions, nor
/// for who is told.
fn place(
    mut part: TempPath,
    (named, target): (&Path, &Path),
    may: impl Fn(&Path) -> std::result::Result<(), String>,
) -> Result<()> {
    let aside = |part: TempPath, reason: String| -> Result<()> {
        let aside = put_aside(part, named)?;
        Err(Error::other(PlaceTaken { reason, aside }))
    };
    for _ in 0..ROUNDS {
        let stands = target.symlink_metadata().is_ok();
        if let Err(reason) = may(named) {
            return aside(part, reason);
        }
        if stands {
            if let Some(told) = &*TOLD.lock().unwrap_or_else(PoisonError::into_inner) {
                told(named, &part);
            }
            let _all = standing();
            // The error holds the part file and removes it.
            return part.persist(target).map_err(|e| e.error);
        }
        // What came there since is asked about, too.
        match put_where_nothing_is(part, target)? {
            None => return Ok(()),
            Some(again) => part = again,
        }
    }
    let reason = format!(
        "something comes to {} and goes again and again",
        named.display()
    );
    aside(part, reason)
}

/// Puts a file where nothing stands; gives it back where something does.
fn put_where_nothing_is(part: TempPath, target: &Path) -> Result<Option<TempPath>> {
    let _all = standing();
    match part.persist_noclobber(target) {
        Ok(()) => Ok(None),
        Err(e) if e.error.kind() == ErrorKind::AlreadyExists => Ok(Some(e.path)),
        Err(e) if target.symlink_metadata().is_ok() => Ok(Some(e.path)),
        // A file system that can rename, but not in this way.
        Err(e) => e.path.persist(target).map(|()| None).map_err(|e| e.error),
    }
}

/// Puts a file beside its place under a name of its own, which it returns.
fn put_aside(mut part: TempPath, target: &Path) -> Result<PathBuf> {
    for number in 2..NAMES {
        let path = numbered(target, number);
        match put_where_nothing_is(part, &path)? {
            None => return Ok(path),
            Some(again) => part = again,
        }
    }
    Err(Error::other("no name is free beside it"))
}

/// A name beside a file under which nothing stands.
#[must_use]
pub fn free_name(path: &Path) -> PathBuf {
    let mut names = (2..).map(|number| numbered(path, number));
    let free = names.find(|path| path.symlink_metadata().is_err());
    free.unwrap_or_else(|| path.to_owned())
}

/// A file's name with a number before its ending.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{number}"));
    if let Some(ending) = path.extension() {
        name.push(".");
        name.push(ending);
    }
    path.with_file_name(name)
}

/// Ending of part files.
const ENDING: &str = ".part";

/// What a path leads to, through links.
fn behind_links(target: &Path) -> PathBuf {
    target.canonicalize().unwrap_or_else(|_| target.to_owned())
}

/// Links that are followed one after another, as many as Linux follows.
const LINKS: usize = 40;

/// The file that a target names through links, be it there or not.
///
/// # Errors
/// A name that ends as that of a folder; a folder or a device, in whose place renaming would put a file; a descriptor of a process, which
/// leads to a file that somebody writes by its number, and would go on to write where nobody looks; a link
/// to what is not there any more.
fn place_of(target: &Path) -> Result<PathBuf> {
    if !ends_in_a_file_name(target) {
        return Err(Error::other(format!(
            "its name ends as that of a folder; {GIVE_A_FILE}"
        )));
    }
    let mut at = target.to_owned();
    for _ in 0..LINKS {
        if is_descriptor(&at) {
            return Err(Error::other(format!(
                "it is not a regular file, but one that a process has opened; {GIVE_A_FILE}"
            )));
        }
        match std::fs::read_link(&at) {
            Ok(next) => at = folder_of(&at).join(next),
            Err(_) => break,
        }
    }
    match target.canonicalize() {
        Ok(file) if !file.is_file() => Err(Error::other(format!(
            "it is not a regular file; {GIVE_A_FILE}"
        ))),
        Ok(file) => Ok(file),
        Err(_) if target.is_symlink() => Err(Error::other(format!(
            "it is a link to what is not there; {GIVE_A_FILE}"
        ))),
        Err(_) => Ok(target.to_owned()),
    }
}

/// What is to be done where a target is no file.
const GIVE_A_FILE: &str = "give the name of a file";

/// Whether a path is that of a descriptor of a process, such as `/proc/self/fd/1`, or `/dev/fd/1` where that
/// is no link to there.
fn is_descriptor(path: &Path) -> bool {
    let Ok(folder) = folder_of(path).canonicalize() else {
        return false;
    };
    folder == Path::new("/dev/fd") || (folder.starts_with("/proc") && folder.ends_with("fd"))
}

/// Why no part file can be made in a folder: without the name of that file, which nobody has asked for.
fn made_beside(folder: &Path, error: &Error) -> Error {
    let kind = error.kind();
    if kind == ErrorKind::NotFound && !folder.exists() {
        let text = format!("the folder {} does not exist", folder.display());
        return Error::new(kind, text);
    }
    let text = error.to_string();
    // The system's words, behind which the name of the part file stands in the error of the crate; it
    // keeps the system's number in these words alone.
    let reason = text.split(" at path ").next().unwrap_or(&text);
    let number = reason.rsplit_once("(os error ");
    let number = number.and_then(|(_, rest)| rest.trim_end_matches(')').parse().ok());
    match error.raw_os_error().or(number) {
        Some(code) => Error::from_raw_os_error(code),
        None => Error::new(kind, reason.to_owned()),
    }
}

fn folder_of(target: &Path) -> &Path {
    let folder = target.parent().filter(|f| !f.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// How the names of all part files of a target begin: with its own, which is cut where it is
/// long, and a point.
fn start_of_name(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    let mut end = name.len().min(NAME);
    while !name.is_char_boundary(end) {
        end -= 1;
    }
    format!("{}.", &name[..end])
}

/// A part file whose process does not run on this machine.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LeftOver {
    /// The file.
    pub path: PathBuf,
    /// Number of the process that made it.
    pub process: u32,
}

/// Part files beside a target that a killed process has probably left behind: no process of
/// their number runs on this machine. They are named and never removed, as on a file system
/// that several machines share the process may run on another one.
#[must_use]
pub fn left_over(target: &Path) -> Vec<LeftOver> {
    let target = behind_links(target);
    let start = start_of_name(&target);
    let mut left = left_in(folder_of(&target), |name| name.strip_prefix(&start));
    for part in &mut left {
        // As the target is named.
        part.path = target.with_file_name(part.path.file_name().unwrap_or_default());
    }
    left
}

/// The same of all targets in a folder.
#[must_use]
pub fn left_over_in(folder: &Path) -> Vec<LeftOver> {
    left_in(folder, |name| {
        // Neither the process nor what follows it holds a dot.
        let part = name.strip_suffix(ENDING)?.rsplit_once('.')?.1;
        Some(&name[name.len() - ENDING.len() - part.len()..])
    })
}

/// The part files in a folder, of whose names this is left behind the target's.
fn left_in(folder: &Path, behind: impl Fn(&str) -> Option<&str>) -> Vec<LeftOver> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let names = entries.filter_map(|entry| entry.ok().map(|e| e.file_name()));
    let left = |name: OsString| {
        let path = folder.join(&name);
        let middle = behind(name.to_str()?)?.strip_suffix(ENDING)?;
        let (process, random) = middle.split_once('-')?;
        let random = !random.is_empty() && random.bytes().all(|b| b.is_ascii_alphanumeric());
        let process = process.parse().ok().filter(|_| random)?;
        (!runs_here(process)).then_some(LeftOver { path, process })
    };
    let mut found: Vec<LeftOver> = names.filter_map(left).collect();
    found.sort_by(|a, b| a.path.cmp(&b.path));
    found
}

/// Removes the part files of a target that a process has left behind, which ran on this machine
/// and has ended.
pub fn remove_left_by(target: &Path, process: u32) {
    let left = left_over(target).into_iter();
    for part in left.filter(|part| part.process == process) {
        // One that cannot be removed is named by the next command.
        let _ = std::fs::remove_file(part.path);
    }
}

/// Whether a process of this number runs on this machine, whoever owns it. One that has ended keeps its number until
/// its parent asks how, which some launchers and containers never do.
#[cfg(unix)]
#[must_use]
pub fn runs_here(process: u32) -> bool {
    use rustix::process::{Pid, test_kill_process};
    let number = i32::try_from(process).ok().and_then(Pid::from_raw);
    let is_there =
        number.is_some_and(|number| test_kill_process(number) != Err(rustix::io::Errno::SRCH));
    is_there && !has_ended(process)
}

/// Whether the system says that a process has ended; false where it says nothing. The state stands behind the name of the
/// program, which may hold brackets itself.
#[cfg(unix)]
fn has_ended(process: u32) -> bool {
    let stat = std::fs::read(format!("/proc/{process}/stat")).unwrap_or_default();
    let behind = stat.iter().rposition(|byte| *byte == b')');
    let state = behind.and_then(|at| stat.get(at + 2));
    matches!(state, Some(b'Z' | b'X'))
}

/// Where this cannot be found out, any may run.
#[cfg(not(unix))]
#[must_use]
pub fn runs_here(_: u32) -> bool {
    true
}

/// Writes a whole file by a [`PartFile`].
///
/// # Errors
/// What the system said; what stood there before is untouched then.
pub fn write(target: &Path, content: &[u8]) -> Result<()> {
    filled(PartFile::beside(target)?, content)
}

/// Writes a whole file that the program names by itself: see [`PartFile::own`].
///
/// # Errors
/// As [`write()`], and a link.
pub fn write_own(target: &Path, content: &[u8]) -> Result<()> {
    filled(PartFile::own(target)?, content)
}

fn filled(part: PartFile, content: &[u8]) -> Result<()> {
    OpenOptions::new()
        .write(true)
        .open(part.path())?
        .write_all(content)?;
    part.finish()
}

/// Removes all part files of this process, before it ends without their being dropped. None
/// is begun or finished from here on: whoever tries to waits for the end.
pub fn remove_part_files() {
    let all = standing();
    for path in all.iter() {
        // Nothing can be done about one that stays.
        let _ = std::fs::remove_file(path);
    }
    std::mem::forget(all);
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::same_file;

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// A file that begins otherwise is in the way, and so is a link in the place of its folder; an empty one is not.
    #[test]
    fn what_is_not_of_the_program_is_told() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("status/a.json");
        let told = |path: &Path| not_own(path, |text| text.starts_with(b"own")).map(|(at, _)| at);
        assert_eq!(told(&path), None);
        std::fs::create_dir(folder.path().join("status")).unwrap();
        for (text, is_told) in [
            ("", false),
            ("\0\0\0 \n", false),
            ("own, more", false),
            ("mine", true),
            ("\0mine", true),
        ] {
            std::fs::write(&path, text).unwrap();
            assert_eq!(told(&path), is_told.then(|| path.clone()), "{text}");
        }
        #[cfg(unix)]
        {
            let link = folder.path().join("link");
            std::os::unix::fs::symlink("status", &link).unwrap();
            assert_eq!(told(&link.join("b.json")), Some(link));
        }
    }

    /// A process that was killed and that its parent has not asked after runs no more.
    #[test]
    #[cfg(target_os = "linux")]
    fn a_process_that_nobody_waits_for_has_ended() {
        let mut child = std::process::Command::new("sleep")
            .arg("60")
            .spawn()
            .unwrap();
        assert!(runs_here(child.id()));
        child.kill().unwrap();
        let begun = std::time::Instant::now();
        while runs_here(child.id()) && begun.elapsed().as_secs() < 30 {
            std::thread::yield_now();
        }
        assert!(!runs_here(child.id()));
        // Its number is still taken.
        assert!(Path::new(&format!("/proc/{}", child.id())).exists());
        child.wait().unwrap();
    }

    #[test]
    fn the_target_changes_when_the_part_file_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.txt");
        std::fs::write(&target, "before").unwrap();
        let dropped = PartFile::beside(&target).unwrap();
        let finished = PartFile::beside(&target).unwrap();
        assert_ne!(dropped.path(), finished.path());
        for part in [&dropped, &finished] {
            assert!(part.path().exists());
            assert_eq!(
                part.path().parent(),
                target.canonicalize().unwrap().parent()
            );
            std::fs::write(part.path(), "after").unwrap();
        }
        assert_eq!(std::fs::read(&target).unwrap(), b"before");
        drop(dropped);
        assert!(finished.path().exists());
        assert_eq!(std::fs::read(&target).unwrap(), b"before");
        finished.finish().unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"after");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    /// Whatever comes into the place while the file is written is asked about, be it after the
    /// question; what may not be replaced stays, and the file stands beside it.
    #[test]
    fn what_may_not_be_replaced_stays_and_so_does_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.h5");
        let part = || {
            let part = PartFile::beside(&target).unwrap();
            std::fs::write(part.path(), "new").unwrap();
            part
        };
        let asked = std::cell::Cell::new(0);
        let absent = |named: &Path| {
            asked.set(asked.get() + 1);
            if named.exists() {
                return Err("it is another's".to_owned());
            }
            // Another process is faster.
            std::fs::write(named, "another's").unwrap();
            Ok(())
        };
        let refused = part().finish_if(absent).unwrap_err();
        let taken = PlaceTaken::of(&refused).unwrap();
        assert_eq!(taken.aside, folder.path().join("a-2.h5"));
        assert!(refused.to_string().starts_with("it is another's; "));
        assert_eq!(asked.get(), 2);
        assert!(part().finish_if(absent).is_err());
        assert_eq!(std::fs::read(&target).unwrap(), b"another's");
        for aside in ["a-2.h5", "a-3.h5"] {
            assert_eq!(std::fs::read(folder.path().join(aside)).unwrap(), b"new");
        }
        part().finish_if(|_| Ok(())).unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["a-2.h5", "a-3.h5", "a.h5"]);
    }

    /// Under `a.h5/` the system finds nothing and puts nothing where the file `a.h5` stands.
    #[test]
    fn names_of_folders_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("a.h5"), "before").unwrap();
        for name in ["a.h5/", "a.h5//", "a.h5/.", "new.h5/", "."] {
            let refused = write(&at(name), b"x").unwrap_err().to_string();
            assert!(refused.contains("as that of a folder"), "{name}: {refused}");
        }
        assert_eq!(names(folder.path()), ["a.h5"]);
        assert_eq!(std::fs::read(at("a.h5")).unwrap(), b"before");
    }

    /// A place at which something is never seen, and yet nothing can be put, is given up, and the file is kept.
    #[cfg(unix)]
    #[test]
    fn a_place_that_is_never_free_is_given_up() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.h5");
        let mut part = PartFile::beside(&target).unwrap();
        std::fs::write(part.path(), "new").unwrap();
        std::fs::write(&target, "another's").unwrap();
        part.target = folder.path().join("a.h5/");
        let asked = std::cell::Cell::new(0);
        let refused = part.finish_if(|_| {
            asked.set(asked.get() + 1);
            Ok(())
        });
        let refused = refused.unwrap_err();
        let taken = PlaceTaken::of(&refused).unwrap();
        assert!(taken.reason.contains("again and again"), "{}", taken.reason);
        assert_eq!(asked.get(), ROUNDS);
        assert_eq!(std::fs::read(&taken.aside).unwrap(), b"new");
        assert_eq!(std::fs::read(&target).unwrap(), b"another's");
        assert_eq!(names(folder.path()), ["a-2.h5", "a.h5"]);
    }

    /// Who is asked to end takes hold of the part files, and waits for no question.
    #[test]
    fn part_files_are_free_while_questions_are_asked() {
        let folder = tempfile::tempdir().unwrap();
        let part = PartFile::beside(&folder.path().join("a.h5")).unwrap();
        let asked = part.finish_if(|_| {
            let (free, is_free) = std::sync::mpsc::channel();
            std::thread::spawn(move || {
                drop(standing());
                free.send(())
            });
            let waited = is_free.recv_timeout(std::time::Duration::from_secs(60));
            waited.map_err(|_| "they are held".to_owned())
        });
        asked.unwrap();
    }

    /// Numbers of processes are below 2^22 on any system.
    #[cfg(unix)]
    #[test]
    fn what_a_killed_process_left_is_found_and_stays() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let target = at("a.h5");
        let living = PartFile::beside(&target).unwrap();
        for name in [
            "a.h5.999999999-Ab12cd.part",
            "b.h5.999999999-Ab12cd.part",
            "a.h5.999999999-.part",
            "a.h5.999999999-Ab12cd",
            "a.h5.mine-Ab12cd.part",
            "a.h5.part",
        ] {
            std::fs::write(at(name), "half").unwrap();
        }
        // The first process of the system, which is another user's, and this test.
        std::fs::write(at("a.h5.1-Ab12cd.part"), "").unwrap();
        let dead = at("a.h5.999999999-Ab12cd.part");
        let found = left_over(&target);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].process, 999_999_999);
        assert!(same_file(&found[0].path, &dead) && dead.exists());
        drop(living);
        let long = "a".repeat(255);
        let part = format!("{}.999999999-Ab12cd.part", "a".repeat(200));
        std::fs::write(at(&part), "half").unwrap();
        assert_eq!(left_over(&at(&long)).len(), 1);
        assert!(left_over(&at("none/a.h5")).is_empty());
    }

    #[test]
    fn names_of_any_length_are_taken() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a".repeat(255), "\u{20ac}".repeat(85)] {
            write(&folder.path().join(&name), b"x").unwrap();
            assert_eq!(names(folder.path()).as_slice(), std::slice::from_ref(&name));
            std::fs::remove_file(folder.path().join(name)).unwrap();
        }
    }

    #[test]
    fn folders_are_refused_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a");
        std::fs::create_dir(&target).unwrap();
        let refused = write(&target, b"x").unwrap_err();
        assert!(refused.to_string().contains("not a regular file"));
        assert!(write(&folder.path().join("missing/a"), b"x").is_err());
        assert_eq!(names(folder.path()), ["a"]);
    }

    /// What the shell has opened stays what it is, and so does a link to it.
    #[cfg(target_os = "linux")]
    #[test]
    fn descriptors_are_no_files() {
        use std::os::fd::AsRawFd;
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("log"), "precious").unwrap();
        let opened = File::open(at("log")).unwrap();
        let number = opened.as_raw_fd();
        symlink(format!("/proc/self/fd/{number}"), at("link")).unwrap();
        symlink("link", at("farther")).unwrap();
        let named = [
            at("link"),
            at("farther"),
            PathBuf::from(format!("/proc/self/fd/{number}")),
            PathBuf::from(format!("/proc/{}/fd/{number}", std::process::id())),
            PathBuf::from(format!("/dev/fd/{number}")),
        ];
        let refused = |path: &Path| {
            let refused = write(path, b"x").unwrap_err().to_string();
            assert!(refused.contains("not a regular file"), "{refused}");
            assert!(refused.contains("give the name of a file"), "{refused}");
        };
        named.iter().for_each(|path| refused(path));
        assert_eq!(std::fs::read(at("log")).unwrap(), b"precious");
        // A file that is gone, and is open all the same.
        std::fs::remove_file(at("log")).unwrap();
        named.iter().for_each(|path| refused(path));
        assert!(at("link").is_symlink() && at("farther").is_symlink());
        symlink("nothing", at("nowhere")).unwrap();
        assert!(write(&at("nowhere"), b"x").is_err());
        assert_eq!(names(folder.path()), ["farther", "link", "nowhere"]);
    }

    #[cfg(unix)]
    #[test]
    fn permissions_of_what_is_replaced_stay() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a");
        write(&target, b"before").unwrap();
        let mode = || target.metadata().unwrap().permissions().mode() & 0o777;
        let new = mode();
        for own in [0o600, 0o640, 0o666] {
            std::fs::set_permissions(&target, std::fs::Permissions::from_mode(own)).unwrap();
            let part = PartFile::beside(&target).unwrap();
            let before = part.path().metadata().unwrap().permissions().mode() & 0o777;
            assert_eq!(before & !own, 0, "{before:o} while it is written");
            std::fs::write(part.path(), "after").unwrap();
            part.finish().unwrap();
            assert_eq!(mode(), own);
        }
        std::fs::remove_file(&target).unwrap();
        write(&target, b"new").unwrap();
        assert_eq!(mode(), new);
    }

    #[test]
    fn a_folder_that_is_not_there_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let refused = write(&folder.path().join("none/a"), b"x").unwrap_err();
        let told = refused.to_string();
        assert!(told.contains("none does not exist"), "{told}");
        assert!(!told.contains(ENDING), "{told}");
    }

    /// What a link leads to stays, whether the link was there before or has come since.
    #[cfg(unix)]
    #[test]
    fn files_that_the_program_names_go_through_no_link() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::write(at("mine"), "mine").unwrap();
        symlink("mine", at("link")).unwrap();
        symlink("nothing", at("dangling")).unwrap();
        for name in ["link", "dangling"] {
            let refused = write_own(&at(name), b"x").unwrap_err().to_string();
            assert!(refused.contains("it is a link"), "{refused}");
        }
        std::fs::hard_link(at("mine"), at("hard")).unwrap();
        write_own(&at("hard"), b"x").unwrap();
        let part = PartFile::own(&at("late")).unwrap();
        symlink("mine", at("late")).unwrap();
        part.finish().unwrap();
        assert!(!at("late").is_symlink());
        assert_eq!(std::fs::read(at("mine")).unwrap(), b"mine");
        assert_eq!(
            names(folder.path()),
            ["dangling", "hard", "late", "link", "mine"]
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (target, link) = (folder.path().join("a"), folder.path().join("b"));
        std::fs::write(&target, "before").unwrap();
        symlink("a", &link).unwrap();
        write(&link, b"after").unwrap();
        assert!(link.is_symlink());
        assert_eq!(std::fs::read(&target).unwrap(), b"after");
        // Others may read it if the mask lets them: not the 0600 of temporary files.
        let plain = folder.path().join("c");
        std::fs::write(&plain, "").unwrap();
        let mode = |path: &Path| std::fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&target), mode(&plain));
    }
}
