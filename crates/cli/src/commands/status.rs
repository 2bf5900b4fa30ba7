//! `pounding status`: how far the shards of a study are, and which command goes on.

use std::collections::{BTreeMap, HashMap};
use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use pounding_case::Dimension;
use pounding_catalogue::wording::counted;
use pounding_files::checksum::{ChecksumError, WithoutChecksum};
use pounding_files::{free_name, same_file};
use pounding_results::study::{Part, ResultReader, StudyFileError};
use pounding_results::{Label, OpenError};
use pounding_study::{ShardName, default_result_of, ranges};
use serde::Serialize;

use crate::arguments::{StatusArguments, value};
use crate::command_words::{resumed, shell_line};
use crate::deal::is_shard;
use crate::failure::Failure;
use crate::files::name_left_over_in;
use crate::heartbeat::{Beat, State, damaged, read, shards_with_status};
use crate::output::{note, pretty, print, print_as_it_is};
use crate::plan::{path_word, program};
use crate::progress::time;
use crate::separate::limited_memory;

/// The shortest time between two looks: each reads a file of every shard.
const LEAST: Duration = Duration::from_millis(100);
/// Shards of a kind that are shown one by one.
const SHOWN: usize = 20;

/// Prints how far all shards are; exit code 1 if some are not done.
pub fn status(arguments: &StatusArguments) -> Result<(), Failure> {
    let every = value(&arguments.every, "every", Dimension::TIME)?;
    let wait = Duration::try_from_secs_f64(every).ok();
    let every = wait.filter(|wait| *wait >= LEAST).ok_or_else(|| {
        let help = format!(
            "give a time such as \"10 s\", of at least {} s",
            LEAST.as_secs_f64()
        );
        Failure::input(
            format!("--every: {:?} is no time to wait", arguments.every),
            Some(help),
        )
    })?;
    let mut known = Known::new();
    loop {
        let studies = look(&arguments.folder, &mut known)?;
        let done = studies.iter().all(Progress::is_done);
        if arguments.unfinished {
            return print_as_it_is(&list_of_one(&arguments.folder, &studies)?);
        }
        if arguments.json {
            print(&pretty(&Told {
                folder: &arguments.folder,
                studies: &studies,
            })?)?;
        } else {
            if arguments.watch && std::io::stdout().is_terminal() {
                // To the beginning of a screen that is empty from there on.
                let _ = write!(std::io::stdout(), "\x1b[H\x1b[J");
            }
            let summaries: Vec<String> = (studies.iter())
                .map(|study| study.summary(&arguments.folder, &studies))
                .collect();
            print(&summaries.join("\n"))?;
        }
        // What running shards write, perhaps on other machines, is not left over.
        let are_ended = studies.iter().all(|study| study.running.is_empty());
        if are_ended && (done || !arguments.watch) {
            name_left_over_in(&arguments.folder);
        }
        match (done, arguments.watch) {
            (true, _) => return Ok(()),
            (false, false) => return Err(Failure::No),
            (false, true) => std::thread::sleep(every),
        }
    }
}

/// The list of shards that are unfinished, as the plan of the one study takes it that has some. Those in
/// whose places other results stand, which the plan refuses to replace, are named beside it.
fn list_of_one(folder: &Path, studies: &[Progress]) -> Result<String, Failure> {
    let has_some = |study: &&Progress| !study.unfinished().is_empty();
    let unfinished: Vec<&Progress> = studies.iter().filter(has_some).collect();
    match unfinished[..] {
        [] => Ok(String::new()),
        [one] => {
            let (in_the_way, for_the_plan) = one.divided();
            if !in_the_way.is_empty() {
                note(&format!(
                    "shards {} are not in the list: what stands in their places has to be moved away first, as `pounding status {}` shows",
                    ranges(&in_the_way),
                    shell_line(&[path_word(folder)])
                ));
            }
            Ok(ranges(&for_the_plan))
        }
        _ => {
            let named = unfinished
                .iter()
                .map(|study| format!("{} ({})", study.name, counted(study.shards, "shard")));
            Err(Failure::input(
                format!(
                    "{} holds unfinished shards of several studies: {}",
                    folder.display(),
                    named.collect::<Vec<_>>().join(", ")
                ),
                Some(
                    "a plan takes the list of one: give each study a folder of its own".to_owned(),
                ),
            ))
        }
    }
}

/// What `status --json` prints.
#[derive(Serialize)]
struct Told<'s> {
    folder: &'s Path,
    studies: &'s [Progress],
}

/// How far a study is.
#[derive(Debug, Serialize)]
struct Progress {
    name: String,
    shards: usize,
    done: Vec<usize>,
    running: Vec<Of>,
    /// Those that an error, a signal or the end of their machine has ended.
    ended: Vec<Of>,
    /// Those of which nothing is known.
    missing: Vec<usize>,
    /// Runs in shards that have written their status: finished, failed, collapsed.
    finished: usize,
    failed: usize,
    collapsed: usize,
    /// The command that goes on with a shard, and the folder that it is called in; unknown
    /// before the first has written its status.
    #[serde(skip)]
    command: Option<(PathBuf, Vec<String>)>,
    /// Commands that go on with shards that are neither done nor running.
    commands: Vec<String>,
    /// Shards in whose places results stand that are of no use and that no call replaces.
    #[serde(skip)]
    no_use: Vec<usize>,
    /// Files in which shards wrote their status, and which are no such files any more.
    #[serde(rename = "damaged_status_files")]
    damaged: Vec<PathBuf>,
}

/// How far a shard is.
#[derive(Debug, Serialize)]
struct Of {
    shard: usize,
    how: String,
    runs: usize,
    finished: usize,
    rate: f64,
    remaining_seconds: Option<f64>,
    host: String,
    seconds_since_word: u64,
}

/// Looks at a folder of shards. Results are read to their ends, and not again as long as they are as they were.
fn look(folder: &Path, known: &mut Known) -> Result<Vec<Progress>, Failure> {
    let failed = |e: std::io::Error| {
        let help = "give the folder that --into named, or that the plan of the study names";
        Failure::input(
            format!("cannot read {}: {e}", folder.display()),
            Some(help.to_owned()),
        )
    };
    let mut studies: BTreeMap<(String, usize), Vec<Found>> = BTreeMap::new();
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name();
        let name = name.to_string_lossy();
        if let Some(shard) = ShardName::of(&name) {
            let found = Found::known_at(&folder.join(&*name), &shard, known);
            let shards = studies.entry((shard.study, shard.count)).or_default();
            shards.push(found);
        }
    }
    for shard in shards_with_status(folder) {
        studies.entry((shard.study, shard.count)).or_default();
    }
    if studies.is_empty() {
        return Err(match shards_of_checks(folder) {
            0 => Failure::input(
                format!("{} holds no shards", folder.display()),
                Some(
                    "no shard has begun: run the plan, or a shard with --into and this folder"
                        .to_owned(),
                ),
            ),
            some => Failure::input(
                format!(
                    "{} holds {} of a `gap` or `compare`, which `status` does not follow: each is written when its runs are done",
                    folder.display(),
                    counted(some, "shard")
                ),
                Some(
                    "the same command with --merge and the folder says which are missing"
                        .to_owned(),
                ),
            ),
        });
    }
    let studies = studies.into_iter();
    Ok(studies
        .map(|((study, count), found)| Progress::of(folder, &study, count, &standing(&found)))
        .collect())
}

/// How many files of shards of a `gap` or a `compare` a folder holds.
fn shards_of_checks(folder: &Path) -> usize {
    let inside = std::fs::read_dir(folder).into_iter().flatten().flatten();
    inside
        .filter(|entry| is_shard(&entry.file_name().to_string_lossy()))
        .count()
}

/// Runs of a result: all, and those that failed and collapsed.
type Runs = (usize, [usize; 2]);

/// What was found out of results: again only where size or time of a file are others.
type Known = HashMap<PathBuf, ((u64, Option<SystemTime>), Found)>;

/// A file under the name of the result of a shard.
#[derive(Debug, Clone)]
struct Found {
    shard: usize,
    standing: Standing,
    /// Identity of its study, and when it was written.
    version: Option<(SystemTime, String)>,
}

impl Found {
    fn known_at(path: &Path, shard: &ShardName, known: &mut Known) -> Self {
        let Ok(file) = path.metadata() else {
            return Self::at(path, shard);
        };
        let stamp = (file.len(), file.modified().ok());
        match known.get(path) {
            Some((before, found)) if *before == stamp => found.clone(),
            _ => {
                let found = Self::at(path, shard);
                known.insert(path.to_owned(), (stamp, found.clone()));
                found
            }
        }
    }

    /// Compares a file with its checksum, and counts what stands in it.
    fn at(path: &Path, shard: &ShardName) -> Self {
        let of = |standing, version| Self {
            shard: shard.index,
            standing,
            version,
        };
        let result = match ResultReader::open(path, WithoutChecksum::Refuse) {
            Ok(result) => result,
            Err(StudyFileError::Checksum {
                source: OpenError::Checksum(ChecksumError::Read(reason)),
                ..
            }) => return of(Standing::Unreadable(reason.to_string()), None),
            Err(_) => {
                let standing = limited_memory().map_or(Standing::Damaged, Standing::Unreadable);
                return of(standing, None);
            }
        };
        let found = &result.description.part;
        if Part::of(vec![shard.index], shard.count).as_ref() != Some(found) {
            return of(Standing::OtherShard(found.to_string()), None);
        }
        let Ok(ended) = result.failed_and_collapsed() else {
            return of(Standing::Damaged, None);
        };
        let written = path.metadata().and_then(|file| file.modified());
        let identity = &result.description.study_sha256;
        let version = written.ok().map(|written| (written, identity.clone()));
        of(Standing::Result((result.rows, ended)), version)
    }
}

/// What stands under the name of the result of a shard.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Standing {
    /// A part of the result, with its runs.
    Result(Runs),
    /// The result of another version of the study than that of the last shard that was written.
    OtherVersion,
    /// The result of other shards than its name says.
    OtherShard(String),
    /// What is not as it was written, or no result.
    Damaged,
    /// What cannot be read here, and why.
    Unreadable(String),
}

impl Standing {
    /// Why a result that is whole, as far as is known, is of no use.
    fn of_no_use(&self) -> Option<String> {
        match self {
            Self::OtherVersion => Some("its result is of another version of the study".to_owned()),
            Self::OtherShard(part) => Some(format!("the file of its result holds {part}")),
            Self::Unreadable(reason) => Some(format!("its result cannot be read here: {reason}")),
            Self::Result(_) | Self::Damaged => None,
        }
    }

    /// The runs of a result that can be merged.
    fn runs(&self) -> Option<Runs> {
        match self {
            Self::Result(runs) => Some(*runs),
            _ => None,
        }
    }
}

/// What stands for each shard that something stands for.
fn standing(found: &[Found]) -> BTreeMap<usize, Standing> {
    let versions = found.iter().filter_map(|file| file.version.as_ref());
    let last = versions.max().map(|(_, identity)| identity);
    let standing = |file: &Found| match &file.version {
        Some((_, identity)) if Some(identity) != last => Standing::OtherVersion,
        _ => file.standing.clone(),
    };
    found
        .iter()
        .map(|file| (file.shard, standing(file)))
        .collect()
}

impl Progress {
    fn of(folder: &Path, study: &str, count: usize, standing: &BTreeMap<usize, Standing>) -> Self {
        let mut progress = Self {
            name: study.to_owned(),
            shards: count,
            done: Vec::new(),
            running: Vec::new(),
            ended: Vec::new(),
            missing: Vec::new(),
            finished: 0,
            failed: 0,
            collapsed: 0,
            command: None,
            commands: Vec::new(),
            no_use: Vec::new(),
            damaged: Vec::new(),
        };
        for index in 1..=count {
            let shard = progress.shard(index);
            let beat = read(folder, &shard);
            progress.damaged.extend(damaged(folder, &shard));
            // A call that was refused or failed leaves what stood there, which may be no part of
            // this study.
            let failed = beat.as_ref().is_some_and(|b| b.state == State::Failed);
            let found = standing.get(&index);
            if found.is_some_and(|found| found.of_no_use().is_some()) {
                progress.no_use.push(index);
            }
            // Runs of a result that is gone are gone; those of one that stands are counted there, whatever was
            // told of them.
            let counted = found.and_then(Standing::runs).filter(|_| !failed);
            let stands = counted.is_some();
            if let Some((finished, ended)) = counted {
                progress.count(finished, ended);
            } else if let Some(beat) = beat.as_ref().filter(|beat| beat.state != State::Done) {
                progress.count(beat.finished, [beat.failed, beat.collapsed]);
            }
            if let Some(beat) = &beat {
                let command = || (beat.folder.clone(), beat.command.clone());
                progress.command.get_or_insert_with(command);
            }
            match beat {
                _ if stands => progress.done.push(index),
                None => match found {
                    Some(found) => {
                        let damaged = || "its result is damaged".to_owned();
                        let why = found.of_no_use().unwrap_or_else(damaged);
                        progress.ended.push(Of::without_status(index, why));
                    }
                    None => progress.missing.push(index),
                },
                Some(beat) => {
                    let running = beat.is_running();
                    let of = Of {
                        shard: index,
                        how: how(&beat, found),
                        runs: beat.runs,
                        finished: match beat.state {
                            State::Done => 0,
                            _ => beat.finished,
                        },
                        rate: beat.rate,
                        remaining_seconds: beat.remaining_seconds,
                        seconds_since_word: beat.silent(),
                        host: beat.host,
                    };
                    match running {
                        true => progress.running.push(of),
                        false => progress.ended.push(of),
                    }
                }
            }
        }
        let unfinished = progress.unfinished();
        let commands = unfinished.iter().filter_map(|shard| {
            let command = progress.goes_on(folder, *shard)?;
            // A call moves what is damaged out of its way, and refuses to replace anything else.
            let moved = match standing.get(shard) {
                None | Some(Standing::Damaged) => String::new(),
                Some(Standing::Unreadable(_)) => return None,
                Some(_) => moved(&folder.join(progress.shard(*shard).result())),
            };
            Some(format!("{moved}{command}"))
        });
        progress.commands = commands.collect();
        progress
    }

    fn shard(&self, index: usize) -> ShardName {
        ShardName {
            study: self.name.clone(),
            count: self.shards,
            index,
        }
    }

    fn count(&mut self, finished: usize, [failed, collapsed]: [usize; 2]) {
        for (sum, count) in [
            (&mut self.finished, finished),
            (&mut self.failed, failed),
            (&mut self.collapsed, collapsed),
        ] {
            *sum = sum.saturating_add(count);
        }
    }

    fn is_done(&self) -> bool {
        self.done.len() == self.shards
    }

    /// Unfinished shards in whose places results stand that a plan does not replace, and those that it makes.
    fn divided(&self) -> (Vec<usize>, Vec<usize>) {
        let unfinished = self.unfinished().into_iter();
        unfinished.partition(|shard| self.no_use.contains(shard))
    }

    /// Shards that are neither done nor running.
    fn unfinished(&self) -> Vec<usize> {
        let ended = self.ended.iter().map(|of| of.shard);
        let mut all: Vec<usize> = self.missing.iter().copied().chain(ended).collect();
        all.sort_unstable();
        all
    }

    /// Where the merged result of the study is written by default: as one call names it, which takes
    /// the name of the folder of a `study.toml`. What shards are of their commands or results say.
    fn merged(&self, folder: &Path) -> PathBuf {
        let words = self.command.iter().flat_map(|(_, words)| words);
        let mut files: Vec<PathBuf> = words.map(PathBuf::from).collect();
        let shard = self.done.first().map(|shard| self.shard(*shard).result());
        let label = shard.and_then(|result| Label::of(&folder.join(result)));
        files.extend(label.map(|label| PathBuf::from(label.file)));
        let generic = files.iter().find(|file| file.ends_with("study.toml"));
        let own = PathBuf::from(format!("{}.toml", self.name));
        default_result_of((&self.name).into(), generic.unwrap_or(&own))
    }

    /// The command that goes on with a shard in a folder: that of another one, with this number. The
    /// folder may have been moved or copied since.
    fn goes_on(&self, into: &Path, shard: usize) -> Option<String> {
        let (called_in, words) = self.command.as_ref()?;
        let (mut called_in, mut words) = (called_in.clone(), words.clone());
        let into = std::path::absolute(into).ok()?;
        set(&mut words, "--shard", |_| {
            format!("{shard}/{}", self.shards)
        })?;
        set(&mut words, "--into", |named| {
            if !called_in.is_dir() && into.ends_with(named) {
                // All has moved, the study with the results of its shards.
                let above = into.ancestors().nth(Path::new(named).components().count());
                called_in = above.map_or(called_in.clone(), Path::to_owned);
            }
            match same_file(&called_in.join(named), &into) {
                true => named.to_owned(),
                false => into.display().to_string(),
            }
        })?;
        let line = shell_line(&resumed(words));
        let here = std::env::current_dir().is_ok_and(|here| here == called_in);
        Some(match here {
            true => line,
            false => format!(
                "cd {} && {line}",
                shell_line(&[called_in.to_string_lossy()])
            ),
        })
    }

    /// The command that merges all shards, beside those of other studies that the folder may hold.
    fn merging(&self, folder: &Path, all: &[Self]) -> String {
        let head = shell_line(&[program(), "merge".to_owned()]);
        let own = self.merged(folder);
        let shards = match all.len() {
            1 => shell_line(&[path_word(folder)]),
            // What a shell makes of it: files of this study, dealt in so many shards.
            _ => {
                let start = format!("{}.shard-", self.name);
                let start = shell_line(&[path_word(&folder.join(start))]);
                format!("{start}*-of-{}.h5", self.shards)
            }
        };
        let as_well = all.iter().filter(|other| other.merged(folder) == own);
        let output = match as_well.count() > 1 || ShardName::of(&own.to_string_lossy()).is_some() {
            true => PathBuf::from(format!("{}.of-{}.merged.h5", self.name, self.shards)),
            false => own,
        };
        let last = shell_line(&["-o".to_owned(), path_word(&output)]);
        format!("{head} {shards} {last}")
    }

    /// How far all shards are, and what to do; `all` are the studies in the folder.
    fn summary(&self, folder: &Path, all: &[Self]) -> String {
        let mut text = format!(
            "{}: {} of {} done in {}, {} finished",
            self.name,
            self.done.len(),
            counted(self.shards, "shard"),
            folder.display(),
            counted(self.finished, "run")
        );
        for (count, what) in [(self.failed, "failed"), (self.collapsed, "collapsed")] {
            if count > 0 {
                text.push_str(&format!(", {count} {what}"));
            }
        }
        text.push('\n');
        for (what, shards) in [
            ("running", &self.running),
            ("ended before its end", &self.ended),
        ] {
            for of in shards.iter().take(SHOWN) {
                text.push_str(&format!("  shard {} {what}: {}\n", of.shard, of.how));
            }
            if shards.len() > SHOWN {
                let numbers: Vec<usize> = shards.iter().skip(SHOWN).map(|of| of.shard).collect();
                text.push_str(&format!("  {what}, too: {}\n", ranges(&numbers)));
            }
        }
        if !self.missing.is_empty() {
            text.push_str(&format!("  not begun: {}\n", ranges(&self.missing)));
        }
        for path in self.damaged.iter().take(SHOWN) {
            text.push_str(&format!(
                "  {} is a damaged status file, which is left out: delete it\n",
                path.display()
            ));
        }
        let rate: f64 = self.running.iter().map(|of| of.rate).sum();
        if rate > 0.0 {
            let left = self.running.iter().filter_map(|of| of.remaining_seconds);
            text.push_str(&format!(
                "  {rate:.1} runs/s; those that run are done in about {}\n",
                time(left.fold(0.0, f64::max))
            ));
        }
        let unfinished = self.unfinished();
        if let Some(first) = self.commands.first() {
            text.push_str(&format!("go on with\n  {first}\n"));
            if unfinished.len() > 1 {
                let (_, listed) = self.divided();
                text.push_str("and likewise with the others");
                if !listed.is_empty() {
                    text.push_str(&format!(
                        ", or give the script of the plan this list: {}",
                        ranges(&listed)
                    ));
                }
                text.push('\n');
            }
        }
        if self.is_done() {
            text.push_str(&format!(
                "merge them with\n  {}\n",
                self.merging(folder, all)
            ));
        }
        text
    }
}

/// Sets the value of an option among the words of a command; `None` if it is not among them.
fn set(words: &mut [String], option: &str, value: impl FnOnce(&str) -> String) -> Option<()> {
    if let Some(at) = words.iter().position(|word| word == option) {
        let word = words.get_mut(at + 1)?;
        *word = value(word);
        return Some(());
    }
    let joined = format!("{option}=");
    let word = words.iter_mut().find(|word| word.starts_with(&joined))?;
    *word = format!("{joined}{}", value(&word[joined.len()..]));
    Some(())
}

/// What moves a file out of the way of a command that follows.
fn moved(path: &Path) -> String {
    let words = [path_word(path), path_word(&free_name(path))];
    format!("mv {} && ", shell_line(&words))
}

impl Of {
    /// One that has written no status.
    fn without_status(shard: usize, how: String) -> Self {
        Self {
            shard,
            how,
            runs: 0,
            finished: 0,
            rate: 0.0,
            remaining_seconds: None,
            host: String::new(),
            seconds_since_word: 0,
        }
    }
}

fn how(beat: &Beat, found: Option<&Standing>) -> String {
    let mut text = match beat.runs {
        0 => "no run begun".to_owned(),
        runs => format!("{} of {}", beat.finished, counted(runs, "run")),
    };
    if beat.failed > 0 {
        text.push_str(&format!(", {} failed", beat.failed));
    }
    match beat.state {
        State::Running if beat.is_gone() => text.push_str(&format!(
            ", {} stored when it last told of itself; without a word for {} (process {} on {})",
            beat.stored,
            time(beat.silent() as f64),
            beat.process,
            beat.host
        )),
        State::Running => {
            text.push_str(&format!(", {:.1} runs/s", beat.rate));
            if let Some(left) = beat.remaining_seconds {
                text.push_str(&format!(", about {} left", time(left)));
            }
            text.push_str(&format!(" (process {} on {})", beat.process, beat.host));
        }
        State::Done => text.push_str(&match found.and_then(Standing::of_no_use) {
            Some(why) => format!("; {why}"),
            None => "; it was done, but its result is gone or damaged".to_owned(),
        }),
        State::Interrupted => text.push_str(&format!(", {} stored; interrupted", beat.stored)),
        State::Failed => text.push_str(&format!("; {}", beat.message)),
    }
    text
}
