//! Files of a command: what it reads beside its arguments, and where its outputs have a place.

use std::collections::BTreeSet;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use pounding_files::label::seen_from_here;
use pounding_files::{
    AskedOfTargets, FileUse, LeftOver, PartFile, ask_of_targets, left_over, left_over_in,
    tell_of_replaced,
};
use pounding_ground_motion::responses_beside;
use pounding_report::Answered;
use pounding_results::{Kind, Label};
use pounding_study::gap_check::{self, CheckError};
use pounding_study::{RECORDS_FOLDER, ShardName, is_shard_of_check, written_by_hand};

use crate::arguments::InputPath;
use crate::command_words::is_child;
use crate::failure::Failure;
use crate::heartbeat;
use crate::output::note;

/// Names the part files of an output that a killed process has left behind. They stay: on a
/// file system that several machines share, another one may write them.
pub fn name_left_over(output: &Path) {
    left_over(output).iter().for_each(name_unfinished);
}

/// The same of all files of a folder of shards, and of those in which its shards tell of themselves and share their records.
pub fn name_left_over_in(folder: &Path) {
    for folder in [
        folder.to_owned(),
        folder.join(heartbeat::FOLDER),
        folder.join(RECORDS_FOLDER),
    ] {
        left_over_in(&folder).iter().for_each(name_unfinished);
    }
}

fn name_unfinished(LeftOver { path, process }: &LeftOver) {
    note(&format!(
        "{} is an unfinished file of process {process}, which does not run on this machine: unless another machine is writing it, delete it",
        path.display()
    ));
}

/// The records that arguments name, with those in folders; files in folders that are no records
/// are named.
pub fn record_files(given: &[InputPath]) -> Result<Vec<PathBuf>, CheckError> {
    let given: Vec<PathBuf> = given.iter().map(|p| p.to_path_buf()).collect();
    let found = gap_check::record_files(&given)?;
    for skipped in &found.skipped {
        note(&skipped.to_string());
    }
    Ok(found.files)
}

/// The metadata of stations that lie beside records, which are read where none is named.
pub fn metadata_beside<'r>(
    records: impl IntoIterator<Item = &'r Path>,
) -> Vec<(&'static str, PathBuf)> {
    let beside = records.into_iter().flat_map(responses_beside);
    beside.map(|path| ("station's metadata", path)).collect()
}

/// Adds files that a case or a study names to those of the arguments, and holds all against
/// one another: before any work is done.
pub fn reads_too(
    files: &mut FileUse,
    more: impl IntoIterator<Item = (&'static str, PathBuf)>,
) -> Result<(), Failure> {
    for (role, path) in more {
        files.reads(role, path);
    }
    inputs_stay(files)
}

/// Holds the files of a command against one another, and each output once more right before its
/// file takes its place: a link may lead from there to an input by then.
pub fn inputs_stay(files: &FileUse) -> Result<(), Failure> {
    inputs_stay_meanwhile(files)?.to_the_end();
    Ok(())
}

/// The same, for work that ends before the process does.
pub fn inputs_stay_meanwhile(files: &FileUse) -> Result<AskedOfTargets, Failure> {
    files.check()?;
    results_have_names_of_text(files)?;
    no_new_file_is_called_toml(files)?;
    let files = files.clone();
    Ok(ask_of_targets(move |target| {
        files.check_output(target).map_err(|e| e.to_string())
    }))
}

/// HDF5 takes names in UTF-8 alone: this is said before the runs, not after them.
fn results_have_names_of_text(files: &FileUse) -> Result<(), Failure> {
    let results = files
        .outputs()
        .filter(|path| path.extension().is_some_and(|e| e == "h5"));
    let shards = files.folders().filter(|(role, _)| *role == "--into");
    let mut all = results.chain(shards.map(|(_, folder)| folder));
    all.try_for_each(a_result_has_a_name_of_text)
}

/// The same of one result, whatever its ending. HDF5 is given the whole path, that of the current folder too.
fn a_result_has_a_name_of_text(path: &Path) -> Result<(), Failure> {
    let refused = |what: String, help: &str| Err(Failure::input(what, Some(help.to_owned())));
    if path.to_str().is_none() {
        return refused(
            format!("the name of a result is not UTF-8: {}", path.display()),
            "name it in UTF-8, and the folders that lead there: HDF5 opens no other",
        );
    }
    match std::path::absolute(path).unwrap_or_else(|_| path.to_owned()) {
        whole if whole.to_str().is_none() => refused(
            format!(
                "the path of the result {} is not UTF-8: {}",
                path.display(),
                whole.display()
            ),
            "name it in another folder, or work in one whose path is UTF-8: HDF5 opens no other",
        ),
        _ => Ok(()),
    }
}

/// A result with the name of a case could not be replaced by the next one, and would be taken for a case.
fn no_new_file_is_called_toml(files: &FileUse) -> Result<(), Failure> {
    let mut outputs = files.outputs();
    match outputs.find(|path| is_toml(path) && !holds_something(path)) {
        None => Ok(()),
        Some(path) => Err(Failure::input(
            format!(
                "{} has the name of a file in TOML, which no command writes",
                path.display()
            ),
            Some("give it another ending, such as .h5, .json, .csv or .svg".to_owned()),
        )),
    }
}

/// Whether a file has the name of cases, studies and rules.
fn is_toml(name: &Path) -> bool {
    let ending = name.extension().unwrap_or_default();
    ending.eq_ignore_ascii_case("toml")
}

/// Outputs of which it was said already what they take the place of, or that there is nothing to say.
static JUDGED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Notes that it was said of an output what it takes the place of.
pub fn is_judged(output: &Path) {
    let mut judged = JUDGED.lock().unwrap_or_else(PoisonError::into_inner);
    judged.insert(output.to_owned());
}

/// Has it said of every output that arguments name, and of the files of a folder of pages, that it takes the
/// place of a file which is no earlier output of its kind.
pub fn say_what_is_replaced(files: &FileUse) {
    let outputs: BTreeSet<PathBuf> = files.outputs().map(Path::to_owned).collect();
    let folders = files.folders().filter(|(role, _)| *role == "--pages");
    let folders: Vec<PathBuf> = folders.map(|(_, folder)| folder.to_owned()).collect();
    tell_of_replaced(move |target, new| {
        let in_folder = || {
            target
                .parent()
                .is_some_and(|at| folders.iter().any(|f| f == at))
        };
        let is_named = outputs.contains(target) || in_folder();
        let judged = JUDGED.lock().unwrap_or_else(PoisonError::into_inner);
        if !is_named || judged.contains(target) {
            return;
        }
        let what = match kind_of_old(target, new) {
            Old::OfThisKind => return,
            Old::OfAnother => "which was no earlier output of this kind",
            Old::OfAnotherRecord => "which was made of another record",
            Old::Numbers => "whose numbers do not say what wrote them",
        };
        note(&format!("{} is replaced, {what}", target.display()));
    });
}

/// Bytes of files that are compared by how they begin.
const BEGINNING: u64 = 1 << 14;

/// What a file is beside a new one that takes its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Old {
    /// It looks like an earlier output of what made the new one, or holds nothing.
    OfThisKind,
    OfAnother,
    /// It was written by this program, of another record.
    OfAnotherRecord,
    /// Both begin with as many numbers, and nothing tells an earlier output from a file of the user's.
    Numbers,
}

fn kind_of_old(old: &Path, new: &Path) -> Old {
    let known = |same: bool| match same {
        true => Old::OfThisKind,
        false => Old::OfAnother,
    };
    let beginning = |path: &Path| {
        let mut bytes = Vec::new();
        let file = pounding_files::input::open(path).ok()?;
        file.take(BEGINNING).read_to_end(&mut bytes).ok()?;
        Some(bytes)
    };
    let (Some(before), Some(after)) = (beginning(old), beginning(new)) else {
        return known(!holds_something(old));
    };
    if before.is_empty() || before == after {
        return Old::OfThisKind;
    }
    // Figures and Parquet do not say what made them; pages do.
    for form in [&b"<svg"[..], b"\x89PNG", b"%PDF-", b"PAR1"] {
        if after.starts_with(form) {
            return known(before.starts_with(form));
        }
    }
    if is_page(new) {
        return known(is_page(old));
    }
    // Tables by their columns; records by the files that they were read from, which follow the names of
    // their events.
    let line = |text: &[u8]| {
        let text = String::from_utf8_lossy(text).into_owned();
        let source = text.lines().find(|line| line.starts_with("# Source: "));
        if let Some(source) = source {
            return Some(source.to_owned());
        }
        let mut lines = text.lines();
        let first = lines.next()?;
        // What the command was asked for may be other; its columns stand below.
        match first
            .strip_prefix("# pounding ")
            .and_then(|of| of.split_once(": "))
        {
            Some((command, _)) => {
                let columns = lines.find(|line| !line.starts_with('#'));
                Some(format!("{command}: {}", columns.unwrap_or_default()))
            }
            None => Some(first.to_owned()),
        }
    };
    let (old_text, new_text) = (before, after);
    let (before, after) = (line(&old_text), line(&new_text));
    match (numbers_of(before.as_deref()), numbers_of(after.as_deref())) {
        (Some(old), Some(new)) if old == new => Old::Numbers,
        _ => {
            let is_record = |line: &Option<String>, text: &[u8]| {
                let source = line
                    .as_deref()
                    .is_some_and(|line| line.starts_with("# Source: "));
                source && String::from_utf8_lossy(text).contains("\n# dt: ")
            };
            match is_record(&before, &old_text) && is_record(&after, &new_text) && before != after {
                true => Old::OfAnotherRecord,
                false => known(before == after),
            }
        }
    }
}

/// Of how many numbers a line is, and of nothing else.
fn numbers_of(line: Option<&str>) -> Option<usize> {
    let separators = |c: char| c.is_whitespace() || c == ',' || c == ';';
    let words = line?.split(separators).filter(|word| !word.is_empty());
    let mut count = 0;
    for word in words {
        word.parse::<f64>().ok()?;
        count += 1;
    }
    (count > 0).then_some(count)
}

/// Refuses outputs that would take the place of what the shards of a study keep beside their results: how far
/// they are, the records that they share, runs that have finished.
pub fn shards_stay(files: &FileUse) -> Result<(), Failure> {
    for output in files.outputs() {
        if let Some(what) = kept_by_shards(output) {
            return Err(stands(output, what));
        }
    }
    Ok(())
}

/// What a file is that shards of a study keep beside their results.
fn kept_by_shards(path: &Path) -> Option<&'static str> {
    let path = path.canonicalize().ok().filter(|path| path.is_file())?;
    let name = path.file_name()?.to_str()?;
    let folder = path.parent()?;
    let is_record = |name: &str| {
        let hash = name.split('.').next().unwrap_or_default();
        hash.len() == 64 && hash.bytes().all(|b| b.is_ascii_hexdigit())
    };
    let has_records = || {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        let mut names = entries.map(|entry| entry.file_name());
        names.any(|name| is_record(&name.to_string_lossy()))
    };
    let folder_name = folder.file_name()?.to_str()?;
    match folder_name {
        "status" => {
            let shard = name.strip_suffix(".json")?;
            ShardName::of(&format!("{shard}.h5"))?;
            Some("what a shard of a study tells of itself")
        }
        "records" if is_record(name) || (name == "list.json" && has_records()) => {
            Some("of the records that shards of a study share")
        }
        parts if parts.ends_with(".parts") => {
            let kept = name == "lock" || name == "study.txt" || name.ends_with(".runs");
            kept.then_some("of the finished runs of a study")
        }
        _ => None,
    }
}

/// Finds out before the work, not after it, that outputs have no place: tables, pages and figures.
pub fn have_a_place<'p>(
    outputs: impl IntoIterator<Item = Option<&'p Path>>,
) -> Result<(), Failure> {
    for path in outputs.into_iter().flatten() {
        no_result_comes(path)?;
        has_a_place(path)?;
    }
    Ok(())
}

/// Finds out before the work that an output has no place.
pub fn has_a_place(path: &Path) -> Result<(), Failure> {
    let part = PartFile::beside(path);
    part.map_err(|e| Failure::output(&e, &path.display().to_string()))?;
    Ok(())
}

/// Refuses to put a table, a page or a figure into the place of a result, which may be the work of
/// days, or of the answer of a command.
pub fn no_result_stands(path: &Path) -> Result<(), Failure> {
    match answer_in(path) {
        Some(found) => Err(stands(
            path,
            &format!("the answer of `pounding {}`", found.command.name()),
        )),
        None => no_run_stands(path),
    }
}

/// Refuses to put anything into the place of a file in TOML, which no command writes: a case, a study or rules that somebody
/// wrote, whether or not this call reads it, by its name, by one that a link leads to, or by what it holds.
fn nothing_written_by_hand_stands(path: &Path) -> Result<(), Failure> {
    if !holds_something(path) {
        return Ok(());
    }
    let what = match names_of(path).into_iter().find(|name| is_toml(name)) {
        Some(_) => "in TOML, as cases, studies and rules are".to_owned(),
        None => match text_of(path).as_deref().and_then(written_by_hand) {
            Some(kind) => format!("{kind}, whatever its name"),
            None => return Ok(()),
        },
    };
    match path.is_symlink() {
        true => {
            let real = seen_from_here(path);
            Err(stands(path, &format!("a link to {real}, which is {what}")))
        }
        false => Err(stands(path, &what)),
    }
}

/// The names of a file: that by which it is given, those that links lead to one after another, and its own.
fn names_of(path: &Path) -> Vec<PathBuf> {
    /// Links that are followed, as many as Linux follows.
    const LINKS: usize = 40;
    let mut names = vec![path.to_owned()];
    let mut at = path.to_owned();
    for _ in 0..LINKS {
        let Ok(next) = std::fs::read_link(&at) else {
            break;
        };
        at = at.parent().unwrap_or(Path::new("")).join(next);
        names.push(at.clone());
    }
    names.extend(path.canonicalize());
    names
}

/// The text of a file that may be written by hand.
fn text_of(path: &Path) -> Option<String> {
    /// Bytes of the longest one.
    const LONGEST: u64 = 4 << 20;
    let file = pounding_files::input::open(path).ok()?;
    if file.metadata().ok()?.len() > LONGEST {
        return None;
    }
    let mut bytes = Vec::new();
    file.take(LONGEST).read_to_end(&mut bytes).ok()?;
    String::from_utf8(bytes).ok()
}

/// Refuses to put anything but a result into the place of one, or of a shard of a check.
fn no_run_stands(path: &Path) -> Result<(), Failure> {
    nothing_written_by_hand_stands(path)?;
    match Label::of(path) {
        Some(found) => Err(stands(path, &format!("the result of {}", found.kind))),
        None if is_shard_of_check(path) => {
            Err(stands(path, "a finished shard of `gap` or `compare`"))
        }
        None => Ok(()),
    }
}

/// What stands there does not go.
fn stands(path: &Path, what: &str) -> Failure {
    Failure::unwritten(
        format!(
            "{} is {what}: what is to be written there does not take its place",
            path.display()
        ),
        Some("name another file, or move it away".to_owned()),
    )
}

/// The answer that a file holds.
fn answer_in(path: &Path) -> Option<Answered> {
    let read = || Answered::read(path).ok();
    Answered::may_be(path).then(read).flatten()
}

/// Finds out before the work that an answer has no place, and once more at its end. It takes that of
/// an earlier one, and of any file but a result.
pub fn an_answer_has_a_place(output: Option<&Path>) -> Result<(), Failure> {
    let Some(path) = output else {
        return Ok(());
    };
    no_run_stands(path)?;
    let output = path.to_owned();
    asked_again(path, move || no_run_stands(&output)).to_the_end();
    has_a_place(path)
}

/// Says what an answer takes the place of, unless that is an answer of the same command on the same
/// file.
///
/// # Errors
/// A result of a run or a study, which stays.
pub fn say_what_goes(output: &Path, new: &Answered) -> Result<(), Failure> {
    no_run_stands(output)?;
    is_judged(output);
    let file = |answered: &Answered| answered.inputs.origin.get(1).cloned();
    match answer_in(output) {
        Some(found) if found.command == new.command && file(&found) == file(new) => {}
        Some(found) => note(
            &Going::of(
                output,
                format!(
                    "the answer of `pounding {}` ({})",
                    found.command.name(),
                    file(&found).unwrap_or_default()
                ),
            )
            .ahead(),
        ),
        None if holds_something(output) => note(&Going::foreign(output, "answer").ahead()),
        None => {}
    }
    Ok(())
}

/// The same now, and once more right before the file takes its place.
pub fn no_result_comes(path: &Path) -> Result<(), Failure> {
    no_result_stands(path)?;
    let output = path.to_owned();
    asked_again(path, move || no_result_stands(&output)).to_the_end();
    Ok(())
}

/// Has a check of an output made once more right before its file takes its place: another process
/// may have been there.
fn asked_again(
    output: &Path,
    check: impl Fn() -> Result<(), Failure> + Send + Sync + 'static,
) -> AskedOfTargets {
    let output = output.to_owned();
    ask_of_targets(move |target| match target == output {
        true => check().map_err(|failure| failure.reason()),
        false => Ok(()),
    })
}

/// Whether a file has bytes that would be lost. Devices and pipes have none.
fn holds_something(path: &Path) -> bool {
    std::fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() > 0)
}

/// Refuses to replace a file of somebody else under a name that the user has not given; what there
/// is to say where the user has.
fn foreign(path: &Path, named: bool, what: &str) -> Result<Option<Going>, Failure> {
    match named {
        true => Ok(Some(Going::foreign(path, what))),
        false => Err(Failure::unwritten(
            format!(
                "{} is no {what} of this program: nothing takes its place unasked",
                path.display()
            ),
            Some("name another file with --output, or remove it".to_owned()),
        )),
    }
}

/// What another file takes the place of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Going {
    output: String,
    what: String,
}

impl Going {
    fn of(output: &Path, what: String) -> Self {
        Self {
            output: output.display().to_string(),
            what,
        }
    }

    fn foreign(output: &Path, what: &str) -> Self {
        Self::of(output, format!("which is no {what} of this program"))
    }

    /// Said before the work, which may still be refused or end without a result.
    #[must_use]
    pub fn ahead(&self) -> String {
        format!("{} will be replaced, {}", self.output, self.what)
    }
}

/// What stands where a page is to be written: one of ours is replaced, any other file only under a
/// name that the user has given, which is said when it happens: the page may still be refused.
///
/// # Errors
/// A file of somebody else under a default name, or one that cannot be read.
pub fn page_is_spared(path: &Path, named: bool) -> Result<(), Failure> {
    no_result_comes(path)?;
    let before = page_judged(path, named)?;
    let output = path.to_owned();
    asked_again(path, move || {
        as_before(&output, &before, page_judged(&output, named))
    })
    .to_the_end();
    Ok(())
}

/// What `page_is_spared` refuses now, or is to be said of the file that a page takes the place of.
///
/// # Errors
/// As `page_is_spared`.
pub fn page_judged(path: &Path, named: bool) -> Result<Option<Going>, Failure> {
    no_result_stands(path)?;
    match holds_something(path) && !is_page(path) {
        true => foreign(path, named, "page"),
        false => Ok(None),
    }
}

/// Whether what stands under a name may be replaced as it was before the work: nobody was asked
/// about what came there since.
fn as_before(
    output: &Path,
    before: &Option<Going>,
    now: Result<Option<Going>, Failure>,
) -> Result<(), Failure> {
    match now? {
        Some(going) if before.as_ref() != Some(&going) => Err(Failure::unwritten(
            format!("another file has come to {} since", output.display()),
            None,
        )),
        _ => Ok(()),
    }
}

/// Whether a file is a page of this program, by its mark; pages of versions without one by their head.
fn is_page(path: &Path) -> bool {
    /// Bytes within which head and title stand.
    const HEAD: u64 = 1 << 18;
    let mut head = Vec::new();
    let read = pounding_files::input::open(path).map(|file| file.take(HEAD).read_to_end(&mut head));
    if !matches!(read, Ok(Ok(_))) {
        return false;
    }
    let head = String::from_utf8_lossy(&head);
    let begins = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"default-src &#39;none&#39;";
    head.contains(pounding_report::page::MARK)
        || (head.starts_with(begins) && head.contains("<p class=\"what\">"))
}

/// What is to be said before the work of what a result takes the place of, if anything.
#[must_use = "it is to be said once nothing refuses the output any more"]
pub struct Ahead(Option<Going>);

impl Ahead {
    /// Says it.
    pub fn say(self) {
        self.0.iter().for_each(|going| note(&going.ahead()));
    }
}

/// What stands where a result is to be written, which takes the place of an earlier one of the same
/// case or study, and of no other one unasked.
pub struct Replaced<'r> {
    /// Where.
    pub output: &'r Path,
    /// What the new result is of.
    pub kind: Kind,
    /// The case or study file, if it is known.
    pub file: Option<&'r Path>,
    /// SHA-256 of the text of the study, if it is one, or of a case that was read from no file.
    pub text_sha256: Option<String>,
    /// Whether the user has named the output.
    pub named: bool,
}

impl Replaced<'_> {
    /// Refuses to replace a result of another kind, and one of another file under a name that the
    /// user has not given; what is to be said where one that the user has named is replaced, once nothing else
    /// refuses that. `goes_on` with a result that stands says nothing. What comes there before the result takes
    /// its place is judged then.
    ///
    /// # Errors
    /// With the file and what to do.
    pub fn spared(&self, goes_on: bool) -> Result<Ahead, Failure> {
        is_judged(self.output);
        let going = self.judged(goes_on)?;
        self.judged_again().to_the_end();
        Ok(Ahead(going))
    }

    /// Has what comes there before the result takes its place judged then.
    pub fn judged_again(&self) -> AskedOfTargets {
        let before = self.judged(false).unwrap_or_default();
        let (output, file) = (self.output.to_owned(), self.file.map(Path::to_owned));
        let (kind, named, text_sha256) = (self.kind, self.named, self.text_sha256.clone());
        asked_again(self.output, move || {
            let now = Replaced {
                output: &output,
                kind,
                file: file.as_deref(),
                text_sha256: text_sha256.clone(),
                named,
            };
            as_before(&output, &before, now.judged(false))
        })
    }

    /// What [`spared`](Self::spared) refuses now, or says of the one that is replaced.
    ///
    /// # Errors
    /// As [`spared`](Self::spared).
    pub fn judged(&self, goes_on: bool) -> Result<Option<Going>, Failure> {
        a_result_has_a_name_of_text(self.output)?;
        nothing_written_by_hand_stands(self.output)?;
        // Looked at before the label: a result that comes meanwhile is none of somebody else.
        let stood = holds_something(self.output);
        let Some(found) = Label::of(self.output) else {
            if !stood {
                return Ok(None);
            }
            no_result_stands(self.output)?;
            return match goes_on {
                true => Ok(None),
                false => foreign(self.output, self.named, "result"),
            };
        };
        let (output, kind) = (self.output.display(), found.kind);
        let of = match found.file.as_str() {
            "" => String::new(),
            file => format!(" ({file})"),
        };
        let going = |what: String| Ok(Some(Going::of(self.output, what)));
        let refused = |why: &str| {
            Err(Failure::unwritten(
                format!("{output} is the result of {kind}{of}: {why}"),
                Some("name another file with --output, or move it away".to_owned()),
            ))
        };
        if kind != self.kind {
            return refused(&format!("that of {} does not take its place", self.kind));
        }
        let here = self.file.map(seen_from_here);
        let other = here.filter(|here| !found.file.is_empty() && found.file != *here);
        let other_text = match (&found.study, &self.text_sha256) {
            (Some(study), Some(text)) => study.text_sha256 != *text,
            _ => false,
        };
        match &other {
            Some(here) if !self.named => {
                refused(&format!("that of {here} does not take its place unasked"))
            }
            _ if goes_on => Ok(None),
            None if !found.is_labelled && !self.named => refused(
                "another program has opened it for writing since, or it is of an early version, so that it does not say of which file it is, and nothing takes its place unasked",
            ),
            None if !found.is_labelled => going(format!(
                "the result of {kind} that does not say of which file it is"
            )),
            Some(_) if other_text => going(format!("the result of another study{of}")),
            Some(_) => going(format!("the result of {kind}{of}")),
            None if other_text && (self.named || found.file.is_empty()) => {
                going("the result of another study, or of another version of this one".to_owned())
            }
            None if other_text => going("the result of another version of this study".to_owned()),
            None if self.kind == Kind::Study => Ok(None),
            None => match (self.file.is_some(), found.file.is_empty()) {
                (true, true) => going(
                    "the result of a run that does not say of which case file it is".to_owned(),
                ),
                (false, false) => going(format!("the result of {kind}{of}")),
                (false, true) if found.case_sha256 != self.text_sha256 => {
                    going("the result of a run of another case without a file".to_owned())
                }
                _ => Ok(None),
            },
        }
    }
}

/// Results of shards that arguments name, with those in folders: files there that are called as
/// shards are, or as results that were merged from some of them.
pub fn shard_files(given: &[InputPath]) -> Result<Vec<PathBuf>, Failure> {
    // One that is missing among others is a shard that is not there; where none is, the names are wrong.
    if let (Some(first), true) = (given.first(), given.iter().all(|path| !path.exists())) {
        return Err(Failure::input(
            format!("{} does not exist", first.display()),
            Some("name results of shards, or the folder that --into named".to_owned()),
        ));
    }
    let mut files = Vec::new();
    for path in given {
        if !path.is_dir() {
            files.push(path.to_path_buf());
            continue;
        }
        let failed = |e: std::io::Error| {
            Failure::input(format!("cannot read {}: {e}", path.display()), None)
        };
        let mut found = Vec::new();
        for entry in std::fs::read_dir(path).map_err(failed)? {
            let file = entry.map_err(failed)?.path();
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            if ShardName::of(&name).is_some() {
                found.push(file);
            }
        }
        if found.is_empty() {
            return Err(Failure::input(
                format!("{} holds no results of shards", path.display()),
                Some(
                    "they are called NAME.shard-I-of-N.h5; name files of other names one by one"
                        .to_owned(),
                ),
            ));
        }
        if !is_child() {
            other_shards(path, &found);
        }
        found.sort();
        files.append(&mut found);
    }
    Ok(files)
}

/// Names the results of shards in a folder that are not called as shards are: they are not merged.
fn other_shards(folder: &Path, found: &[PathBuf]) {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut others: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    others.sort();
    for path in others
        .iter()
        .filter(|path| path.is_file() && !found.contains(path))
    {
        let study = Label::of(path).and_then(|label| label.study);
        if let Some(study) = study.filter(|study| !study.part.is_whole()) {
            note(&format!(
                "{} holds {} of a study and is not called as a shard is: it is left out",
                path.display(),
                study.part
            ));
        }
    }
}
