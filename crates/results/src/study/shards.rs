//! The shards of a study, which make one result.
//!
//! Thousands of them are merged: no more than a few are open at a time, and of the others only
//! their numbers and paths are kept.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use pounding_files::checksum::{Checksum, WithoutChecksum};

use super::{Description, Part, ResultReader, Row, StudyFileError, Value, numbers, ranges};
use crate::{Label, Stamp};

/// How shards are merged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct MergeOptions {
    /// Shards that different builds of the program computed may be mixed; the result says which
    /// build computed which.
    pub mixed_builds: bool,
    /// What to do with shards that have no checksum.
    pub without_checksum: WithoutChecksum,
    /// Shards may be missing: the result is one of several shards, which is merged again.
    pub partial: bool,
}

/// Something wrong with one of the files.
#[derive(Debug)]
pub struct Fault {
    /// The file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub error: StudyFileError,
}

impl Fault {
    /// A file that cannot be read, for a reason that whoever tried has found.
    #[must_use]
    pub fn unreadable(path: &Path, reason: &str) -> Self {
        Self {
            path: path.to_owned(),
            error: StudyFileError::File {
                what: "read",
                path: path.to_owned(),
                reason: reason.to_owned(),
            },
        }
    }
}

/// What the files of a study are.
#[derive(Debug, Default)]
pub struct Survey {
    /// Number of all shards of the study; zero if no file could be read.
    pub count: usize,
    /// Shards that are there, ascending.
    pub present: Vec<usize>,
    /// Those that are not, ascending.
    pub missing: Vec<usize>,
    /// Files that cannot be read, are of another study, or hold what another one holds.
    pub faults: Vec<Fault>,
    /// Builds of the program that computed the shards, each with its shards.
    pub builds: Vec<(String, Vec<usize>)>,
    /// Files without a checksum: damage that does not show in their form was not seen.
    pub unchecked: Vec<PathBuf>,
    /// Files that make the study, in the order of their first shards.
    heads: Vec<Head>,
}

/// What is kept of a file.
#[derive(Debug)]
struct Head {
    path: PathBuf,
    part: Part,
    stamp: Stamp,
    columns: usize,
    /// Identity of its study, and whether its rows fit those of others.
    study: String,
    shape: u64,
    /// Builds and versions by their numbers.
    builds: Vec<(usize, Vec<usize>)>,
    version: usize,
}

/// Values that many files share, each kept once.
#[derive(Debug, Default)]
struct Distinct(Vec<String>);

impl Distinct {
    fn number(&mut self, text: &str) -> usize {
        match self.0.iter().position(|known| known == text) {
            Some(at) => at,
            None => {
                self.0.push(text.to_owned());
                self.0.len() - 1
            }
        }
    }
}

/// Looks at the results of shards one after another, each of which is read to its end and
/// compared with its checksum, and of which all rows are read as a merge reads them. The study is that of
/// most files.
#[must_use]
pub fn survey(files: &[PathBuf], without: WithoutChecksum) -> Survey {
    look(files, without, true).0
}

/// See [`survey`]; a merge reads the `rows` later.
fn look(files: &[PathBuf], without: WithoutChecksum, rows: bool) -> (Survey, Vec<String>) {
    let mut survey = Survey::default();
    let (mut builds, mut versions) = (Distinct::default(), Distinct::default());
    let mut heads = Vec::new();
    for path in files {
        match head(path, (without, rows), &mut builds, &mut versions) {
            Ok(head) => heads.push(head),
            Err(error) => survey.faults.push(Fault {
                path: path.clone(),
                error,
            }),
        }
    }
    let Some(first) = of_most(&heads) else {
        return (survey, versions.0);
    };
    let (study, shape, count) = {
        let first = &heads[first];
        (first.study.clone(), first.shape, first.part.count())
    };
    let reference = heads[first].path.clone();
    survey.count = count;
    let mut owners = vec![false; count];
    // What a file holds is there, also if it cannot be taken beside another one.
    let mut there = vec![false; count];
    for head in heads {
        let (shown, other) = (head.path.display(), reference.display());
        let taken = |s: &&usize| owners[**s - 1];
        let reason = if head.study != study {
            format!("{shown} is of another study, or of another version of it, than {other}")
        } else if head.shape != shape {
            format!("{shown} does not have the runs, variables, storeys and levels of {other}")
        } else if head.part.count() != count {
            format!(
                "{shown} is one of {} shards, {other} one of {count}",
                head.part.count()
            )
        } else if head.part.shards().iter().any(|s| taken(&s)) {
            let shards = head.part.shards();
            shards.iter().for_each(|shard| there[shard - 1] = true);
            let twice: Vec<String> = shards.iter().filter(taken).map(usize::to_string).collect();
            match (twice.as_slice(), shards.len()) {
                ([one], 1) => format!("{shown} is shard {one}/{count} once more"),
                ([one], _) => format!("{shown} holds shard {one}/{count} once more, beside others"),
                (several, _) => format!(
                    "{shown} holds shards {} of {count} once more",
                    several.join(", ")
                ),
            }
        } else {
            for shard in head.part.shards() {
                owners[shard - 1] = true;
                there[shard - 1] = true;
            }
            survey.heads.push(head);
            continue;
        };
        survey.faults.push(Fault {
            path: head.path,
            error: StudyFileError::Merge { reason },
        });
    }
    survey.heads.sort_by_key(|head| head.part.shards()[0]);
    let numbered = |wanted: bool| {
        let all = there.iter().enumerate();
        let chosen = all.filter(move |(_, there)| **there == wanted);
        chosen.map(|(i, _)| i + 1).collect::<Vec<_>>()
    };
    (survey.present, survey.missing) = (numbered(true), numbered(false));
    survey.unchecked = survey
        .heads
        .iter()
        .filter(|head| head.stamp.checksum() == Checksum::Absent)
        .map(|head| head.path.clone())
        .collect();
    let mut by_build: Vec<(usize, Vec<usize>)> = Vec::new();
    for (build, shards) in survey.heads.iter().flat_map(|head| &head.builds) {
        match by_build.iter_mut().find(|(b, _)| b == build) {
            Some((_, all)) => all.extend(shards),
            None => by_build.push((*build, shards.clone())),
        }
    }
    for (build, mut shards) in by_build {
        shards.sort_unstable();
        survey.builds.push((builds.0[build].clone(), shards));
    }
    (survey, versions.0)
}

/// The first file of the study that most files are of.
fn of_most(heads: &[Head]) -> Option<usize> {
    let mut counts: Vec<(usize, usize)> = Vec::new();
    for (i, head) in heads.iter().enumerate() {
        let same = |first: &usize| {
            let first = &heads[*first];
            (&first.study, first.shape, first.part.count())
                == (&head.study, head.shape, head.part.count())
        };
        match counts.iter_mut().find(|(first, _)| same(first)) {
            Some((_, count)) => *count += 1,
            None => counts.push((i, 1)),
        }
    }
    // Of equals the one that was named first: `max_by_key` alone would take the last.
    let most = counts.iter().rev().max_by_key(|(_, count)| *count);
    most.map(|(first, _)| *first)
}

/// What is kept of one file, which is closed again.
fn head(
    path: &Path,
    (without, rows): (WithoutChecksum, bool),
    builds: &mut Distinct,
    versions: &mut Distinct,
) -> Result<Head, StudyFileError> {
    let reader = ResultReader::open(path, without)?;
    let d = &reader.description;
    if let Some(label) = Label::of(path).and_then(|label| label.study)
        && (label.part != d.part || label.sha256 != d.study_sha256)
    {
        return Err(StudyFileError::Merge {
            reason: format!(
                "{} is damaged: its label says that it is {}, its content that it is {}",
                path.display(),
                label.part,
                d.part
            ),
        });
    }
    if rows || reader.checksum == Checksum::Absent {
        // Of a file without a checksum: if reading fails, or brings the HDF5 library down, nothing is
        // written yet.
        for number in 0..d.runs.div_ceil(d.chunk) {
            if d.part.place(number).is_some() {
                rows_of_chunk(&reader, path, number)?;
            }
        }
    }
    let builds = match several(&d.build, &d.part) {
        Some(lines) => lines
            .into_iter()
            .map(|(shards, build)| (builds.number(build), shards))
            .collect(),
        None => vec![(builds.number(&d.build), d.part.shards().to_vec())],
    };
    Ok(Head {
        path: path.to_owned(),
        part: d.part.clone(),
        columns: d.layout.columns() + d.coordinates.len(),
        study: d.study_sha256.clone(),
        shape: shape(d),
        builds,
        version: versions.number(&d.version),
        stamp: reader.stamp.clone(),
    })
}

/// The rows of a chunk of the study, which are those of its runs.
fn rows_of_chunk(
    reader: &ResultReader,
    path: &Path,
    number: usize,
) -> Result<Vec<(Row, Vec<Value>)>, StudyFileError> {
    let d = &reader.description;
    let start = number * d.chunk;
    let expected = d.chunk.min(d.runs - start);
    let from = d.part.place(number).unwrap_or_default() * d.chunk;
    let block = reader.block(from..(from + expected).min(reader.rows))?;
    let found = block.iter().map(|(row, _)| row.run);
    if block.len() == expected && found.eq(start..start + expected) {
        return Ok(block);
    }
    Err(StudyFileError::Merge {
        reason: format!(
            "{} does not have the runs {start} to {}",
            path.display(),
            start + expected - 1
        ),
    })
}

/// A number that differs where runs, variables, storeys or levels do.
fn shape(d: &Description) -> u64 {
    use std::hash::{DefaultHasher, Hash, Hasher};
    let mut hash = DefaultHasher::new();
    format!("{} {} {:?} {:?}", d.runs, d.chunk, d.layout, d.coordinates).hash(&mut hash);
    hash.finish()
}

/// Builds of a result of several shards that several of them computed, with their shards, as
/// [`with_shards`] wrote them; `None` if one did.
fn several<'b>(build: &'b str, part: &Part) -> Option<Vec<(Vec<usize>, &'b str)>> {
    let line = |line: &'b str| {
        let (shards, rest) = line.strip_prefix(SHARDS)?.split_once(" of ")?;
        let (count, build) = rest.split_once(": ")?;
        (count.parse() == Ok(part.count())).then_some(())?;
        let build = if build == UNKNOWN_BUILD { "" } else { build };
        Some((numbers(shards, part.count())?, build))
    };
    let found = build.lines().map(line).collect::<Option<Vec<_>>>();
    found.filter(|lines| !lines.is_empty())
}

/// All shards of a study, or some of them, in their order.
#[derive(Debug)]
pub struct Shards {
    heads: Vec<Head>,
    /// Number of the file that holds each shard.
    owners: Vec<Option<usize>>,
    description: Description,
    unchecked: Vec<PathBuf>,
    builds: Vec<String>,
    missing: Vec<usize>,
}

impl Shards {
    /// Looks at the results of all shards of a study, one after another.
    ///
    /// # Errors
    /// [`StudyFileError::Checksum`] if a file is not as it was written,
    /// [`StudyFileError::Merge`] if the files are not all shards of one study,
    /// [`StudyFileError::MixedBuilds`], or [`StudyFileError::File`].
    pub fn open(files: &[PathBuf], options: MergeOptions) -> Result<Self, StudyFileError> {
        let (survey, versions) = look(files, options.without_checksum, false);
        let wrong = |reason: String| StudyFileError::Merge { reason };
        let others = survey.faults.len().saturating_sub(1);
        if let Some(fault) = survey.faults.into_iter().next() {
            return Err(match others {
                0 => fault.error,
                others => StudyFileError::Several {
                    first: Box::new(fault.error),
                    others,
                },
            });
        }
        let Some(first) = survey.heads.first() else {
            return Err(wrong("no files are given".to_owned()));
        };
        let count = survey.count;
        if !survey.missing.is_empty() && !options.partial {
            return Err(wrong(missing(&survey.missing, count)));
        }
        if survey.builds.len() > 1 && !options.mixed_builds {
            return Err(mixed(&survey.heads, &survey.builds));
        }
        let mut description = ResultReader::open_again(&first.path, &first.stamp)?.description;
        let part = Part::of(survey.present, count);
        description.part = part.ok_or_else(|| wrong("a shard is there twice".to_owned()))?;
        let mut listed = Vec::new();
        if survey.builds.len() > 1 {
            listed = with_shards(&survey.builds, count);
            description.build = listed.join("\n");
            let mut known: Vec<&str> = Vec::new();
            for head in &survey.heads {
                for version in versions[head.version].split(", ") {
                    if !known.contains(&version) {
                        known.push(version);
                    }
                }
            }
            description.version = known.join(", ");
        }
        let mut owners = vec![None; count];
        for (number, head) in survey.heads.iter().enumerate() {
            for shard in head.part.shards() {
                owners[shard - 1] = Some(number);
            }
        }
        Ok(Self {
            heads: survey.heads,
            owners,
            description,
            unchecked: survey.unchecked,
            builds: listed,
            missing: survey.missing,
        })
    }

    /// What the merged result says beside its rows.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// In how many shards the study is dealt, also where all of them are here.
    #[must_use]
    pub fn dealing(&self) -> usize {
        self.owners.len()
    }

    /// Number of rows of the merged result.
    ///
    /// # Errors
    /// [`StudyFileError::Merge`] if there cannot be so many.
    pub fn count(&self) -> Result<usize, StudyFileError> {
        let d = &self.description;
        let rows = d.part.rows(d.runs, d.chunk);
        rows.ok_or_else(|| StudyFileError::Merge {
            reason: "a study has more runs than can be counted".to_owned(),
        })
    }

    /// Shards without a checksum: damage that does not show in their form was not seen.
    #[must_use]
    pub fn unchecked(&self) -> &[PathBuf] {
        &self.unchecked
    }

    /// Builds that computed the shards, each with them, if there are several.
    #[must_use]
    pub fn builds(&self) -> &[String] {
        &self.builds
    }

    /// Shards that are missing, ascending; none unless the merge is partial.
    #[must_use]
    pub fn missing(&self) -> &[usize] {
        &self.missing
    }

    /// Number of shards of the whole study, those that are missing among them.
    #[must_use]
    pub fn shards(&self) -> usize {
        self.owners.len()
    }

    /// Hands out all rows with the values of their variables, in the order of the runs.
    ///
    /// Runs of a shard lie far apart in the whole: so many rows are held that each file is
    /// opened once for them, within some tens of megabytes.
    ///
    /// # Errors
    /// [`StudyFileError::File`], [`StudyFileError::Merge`] if a shard lacks a run, and what
    /// `take` returns.
    pub fn rows<E: From<StudyFileError>>(
        &self,
        mut take: impl FnMut(Row, Vec<Value>) -> Result<(), E>,
    ) -> Result<(), E> {
        let (runs, chunk) = (self.description.runs, self.description.chunk);
        let columns = self.heads.iter().map(|head| head.columns).max();
        let held = HELD / (16 * columns.unwrap_or(1) + ROW) / chunk;
        let mut chunks = (0..runs.div_ceil(chunk))
            .filter_map(|number| Some((number, self.owners[number % self.owners.len()]?)))
            .peekable();
        while chunks.peek().is_some() {
            let window: Vec<(usize, usize)> = chunks.by_ref().take(held.max(1)).collect();
            let mut of_files: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
            for (at, (_, owner)) in window.iter().enumerate() {
                of_files.entry(*owner).or_default().push(at);
            }
            let mut rows: Vec<Vec<(Row, Vec<Value>)>> = Vec::new();
            rows.resize_with(window.len(), Vec::new);
            for (owner, places) in of_files {
                let head = &self.heads[owner];
                let reader = ResultReader::open_again(&head.path, &head.stamp)?;
                for at in places {
                    rows[at] = rows_of_chunk(&reader, &head.path, window[at].0)?;
                }
            }
            for (row, point) in rows.into_iter().flatten() {
                take(row, point)?;
            }
        }
        Ok(())
    }
}

/// Memory of the rows that are held at once (bytes).
const HELD: usize = 32 << 20;
/// Memory of a row beside its values (bytes).
const ROW: usize = 160;

/// Says which shards are missing, as far as a list helps anybody.
fn missing(missing: &[usize], count: usize) -> String {
    let list = ranges(missing);
    match missing {
        [one] => format!("missing {one}/{count}"),
        _ if list.len() > MOST_NAMED => {
            format!("{} of {count} shards are missing", missing.len())
        }
        _ => format!("missing {} of {count} shards: {list}", missing.len()),
    }
}

/// Characters of a list of missing shards.
const MOST_NAMED: usize = 2000;
/// Files of a build that are named.
const MOST_FILES: usize = 5;
/// How the line of a build begins.
const SHARDS: &str = "shards ";
/// A build of a version that did not record it.
const UNKNOWN_BUILD: &str = "a version that did not record its build";

/// A build as people read it.
fn named(build: &str) -> &str {
    match build {
        "" => UNKNOWN_BUILD,
        build => build,
    }
}

/// Refuses builds that differ, with files of each.
fn mixed(heads: &[Head], builds: &[(String, Vec<usize>)]) -> StudyFileError {
    let line = |(build, shards): &(String, Vec<usize>)| {
        let holds = |head: &&Head| {
            let mut its = head.part.shards().iter();
            its.any(|shard| shards.binary_search(shard).is_ok())
        };
        let its: Vec<&Head> = heads.iter().filter(holds).collect();
        let mut files: Vec<String> = its
            .iter()
            .take(MOST_FILES)
            .map(|head| head.path.display().to_string())
            .collect();
        if its.len() > MOST_FILES {
            files.push(format!("{} more", its.len() - MOST_FILES));
        }
        format!("{}: {}", named(build), files.join(", "))
    };
    StudyFileError::MixedBuilds {
        list: builds.iter().map(line).collect::<Vec<_>>().join("\n"),
    }
}

/// Each build with its shards, as the result says it.
fn with_shards(builds: &[(String, Vec<usize>)], count: usize) -> Vec<String> {
    let line = |(build, shards): &(String, Vec<usize>)| {
        let shards = ranges(shards).replace(',', ", ");
        format!("{SHARDS}{shards} of {count}: {}", named(build))
    };
    builds.iter().map(line).collect()
}
