//! A study from its file to its result: resume, shards, failures.

mod growing_table;

use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::time::Duration;

use pounding_files::PartFile;
use pounding_files::checksum::WithoutChecksum;
use pounding_results::Label;
use pounding_results::study::{
    Coordinate, Description, ResultReader, ResultWriter, StudyFileError,
};

use growing_table::GrowingTable;

use crate::BUILD;
use crate::error::StudyError;
use crate::parts::{Parts, Store};
use crate::result_name::{ShardName, has_default_name, refuse_name_of_shard};
use crate::runs::{Ending, OPENING, RecordReport, Row, Runner, run_all};
use crate::shard::{Shard, of_this_study};
use crate::study_file::{Study, Value, Values, Variable, VariedEntry};
use crate::table::RunTable;

/// How a study is run.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepOptions {
    /// The result.
    pub output: PathBuf,
    /// A table of the same rows.
    pub csv: Option<PathBuf>,
    /// Threads; the results do not depend on it.
    pub threads: usize,
    /// Which part of the study.
    pub shard: Shard,
    /// Goes on with the finished runs of an interrupted call.
    pub resume: bool,
    /// How long a finished run waits at most until it is stored; the results do not
    /// depend on it.
    pub store_every: Duration,
    /// Records runs whose motion cannot be read as failed, instead of refusing the study.
    pub keep_going: bool,
    /// Folder of all shards, in which they share records: each is kept there once, and a shard
    /// reads those of its own runs alone.
    pub shared: Option<PathBuf>,
}

/// What is known while a study runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Progress {
    /// Runs of this call.
    pub total: usize,
    /// Runs that were stored before.
    pub stored_before: usize,
    /// Runs computed by this call.
    pub made: usize,
    /// Those of this call and of earlier ones that are on the disk.
    pub stored: usize,
    /// Failures among those computed.
    pub failed: usize,
    /// Collapses among them.
    pub collapsed: usize,
}

impl Progress {
    /// Whether every finished run is on the disk.
    #[must_use]
    pub fn all_stored(&self) -> bool {
        self.stored == self.stored_before + self.made
    }
}

/// A finished study.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepReport {
    /// Runs in the result.
    pub runs: usize,
    /// Runs computed by this call; the others were stored before.
    pub made: usize,
    /// Failed runs in the result.
    pub failed: usize,
    /// The first few of them: number and diagnosis.
    pub failures: Vec<(usize, String)>,
    /// Runs in the result in which a building collapsed; these are no failures.
    pub collapsed: usize,
    /// The first few of them: number, and what collapsed when.
    pub collapses: Vec<(usize, String)>,
    /// Runs in the result in which a joint opens further than its seat is wide; none of a study
    /// that does not keep openings.
    pub unseated: usize,
    /// Columns of openings, with the seats of their gaps.
    seats: Vec<(usize, Seat)>,
    /// Identity of the study.
    pub study_sha256: String,
    /// Its motions; those that could be read.
    pub records: Vec<RecordReport>,
    /// What the user should know of the case.
    pub warnings: Vec<String>,
}

/// Failures that are shown.
const SHOWN: usize = 5;

/// Runs a study, or what is left of it, and writes its result.
///
/// A run that fails is recorded with its diagnosis. Finished runs are stored in
/// `<output>.parts` until the result is complete, at least every
/// [`store_every`](SweepOptions::store_every). `progress` is given every run, and asked
/// several times a second; if it breaks off, no more runs are begun, what has finished is
/// stored, and it is informed before the runs in flight are awaited.
///
/// # Errors
/// A motion that cannot be read, a disk that is full, [`StudyError::Interrupted`] if
/// `progress` broke off: see [`StudyError`]. Runs finished until then stay stored.
pub fn sweep(
    study: &Study,
    options: &SweepOptions,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<SweepReport, StudyError> {
    if !options.shard.exists() {
        return Err(StudyError::Shard {
            text: format!("{}/{}", options.shard.index, options.shard.count),
        });
    }
    refuse_name_of_shard(&options.output, Some(options.shard))?;
    let shared = options.shared.as_deref();
    let mut runner = Runner::new(study, options.keep_going, shared)?;
    let description = describe(&runner, options.shard);
    if let Some(report) = complete(&runner, &description, options)? {
        // What an interrupted call made of these runs stands in the result as well.
        Parts::discard(&options.output, &signature(&description));
        return Ok(report);
    }
    spare_other_shards(&description, &options.output)?;
    let chunks = chunks(study.runs(), study.chunk, options.shard);
    let total = chunks.iter().map(Range::len).sum();
    let mut parts = Parts::open(
        &options.output,
        &signature(&description),
        chunks,
        options.resume,
    )?;
    runner.need(&parts.left(), options.keep_going, shared)?;
    let mut table = options
        .csv
        .as_ref()
        .map(|path| GrowingTable::create(study, path, &description))
        .transpose()?;
    let now = make(&runner, (&mut parts, total), &mut table, options, progress)?;
    let mut report = assemble(&runner, &description, (&parts, table), options);
    let written = match &report {
        Ok(_) | Err(StudyError::ResultFile(StudyFileError::Aside { .. })) => true,
        Err(_) => false,
    };
    if written {
        // Its runs are in the result; a folder that stays does no harm.
        let _ = parts.remove();
    }
    if let Ok(report) = &mut report {
        report.made = now.made;
        report.warnings.extend(other_version(&description, options));
    }
    report
}

/// Makes the runs that are left, stores them, and has the table follow.
fn make(
    runner: &Runner<'_>,
    (parts, total): (&mut Parts, usize),
    table: &mut Option<GrowingTable<'_>>,
    options: &SweepOptions,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Progress, StudyError> {
    let left = parts.left();
    let stored_before = total - left.len();
    let mut now = Progress {
        total,
        stored_before,
        stored: stored_before,
        ..Progress::default()
    };
    if progress(&now).is_break() {
        return Err(StudyError::Interrupted {
            stored: now.stored,
            of: total,
        });
    }
    let mut stopped = false;
    let mut store = Store::new(parts, runner.study.chunk, options.store_every);
    let mut take = |row: Option<Row>| {
        if let Some(row) = row {
            now.made += 1;
            now.failed += usize::from(row.ending.failed());
            now.collapsed += usize::from(row.ending.collapsed());
            store.take(row);
        }
        let last = now.stored_before + now.made == total;
        loop {
            let written = if stopped || last {
                store.store().map(|()| true)
            } else {
                store.store_if_due()
            };
            let written = written.map_err(|source| StudyError::Store {
                folder: store.folder(),
                source,
                // What another process has removed meanwhile is not.
                stored: store.parts().standing(),
                of: total,
            })?;
            now.stored = now.stored_before + now.made - store.waiting();
            // Not while somebody waits for this to end: the table is not finished by this call.
            if let Some(table) = table.as_mut().filter(|_| written && !stopped) {
                table.follow(store.parts())?;
            }
            let asked = progress(&now);
            if stopped {
                return Ok(ControlFlow::Break(()));
            }
            if asked.is_continue() {
                return Ok(asked);
            }
            // Once more: what has finished is stored, and it is informed.
            stopped = true;
        }
    };
    run_all(runner, &left, options.threads, &mut take)?;
    if stopped {
        return Err(StudyError::Interrupted {
            stored: now.stored,
            of: total,
        });
    }
    Ok(now)
}

/// Runs of each chunk of a shard: chunks are dealt out in turn.
fn chunks(runs: usize, chunk: usize, shard: Shard) -> Vec<Range<usize>> {
    let all = (0..runs)
        .step_by(chunk)
        .map(|start| start..(start + chunk).min(runs));
    all.skip(shard.index - 1).step_by(shard.count).collect()
}

/// What chunks of a result must share: study, shard, and on a line of its own the build.
fn signature(d: &Description) -> String {
    format!(
        "{} {}/{}\n{}",
        d.study_sha256,
        d.part.shards()[0],
        d.part.count(),
        d.build
    )
}

fn describe(runner: &Runner<'_>, shard: Shard) -> Description {
    let study = runner.study;
    let records = runner.motions.all.iter().zip(&study.records);
    let lines: Vec<String> = records
        .map(|(m, s)| {
            format!(
                "{} {}",
                m.as_ref().map_or("unreadable", |m| m.sha256.as_str()),
                s.name
            )
        })
        .collect();
    Description {
        title: study.title.clone(),
        study_sha256: runner.study_identity(),
        study: study.source.clone(),
        case: study.base.source.clone(),
        records: lines.join("\n"),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        build: BUILD.to_owned(),
        runs: study.runs(),
        chunk: study.chunk,
        part: shard.part(),
        warnings: runner.warnings.clone(),
        quantities: study.quantities.as_ref().map(|_| {
            let kept = runner.layout.quantities.iter();
            kept.map(|q| q.name.to_owned()).collect()
        }),
        float32: study.float32,
        layout: runner.layout.clone(),
        coordinates: coordinates(study),
    }
}

fn empty_report(runner: &Runner<'_>, description: &Description) -> SweepReport {
    let records = runner.motions.all.iter().zip(&runner.study.records);
    let records = records.filter_map(|(m, s)| {
        let m = m.as_ref().ok()?;
        Some(RecordReport {
            name: s.name.clone(),
            sha256: m.sha256.clone(),
            intensity: m.intensity,
        })
    });
    SweepReport {
        runs: 0,
        made: 0,
        failed: 0,
        failures: Vec::new(),
        collapsed: 0,
        collapses: Vec::new(),
        unseated: 0,
        seats: seats(runner),
        study_sha256: description.study_sha256.clone(),
        records: records.collect(),
        warnings: description.warnings.clone(),
    }
}

/// The seat of a gap in the runs of a study.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Seat {
    /// That of the case (m).
    OfCase(f64),
    /// The value of a variable, by its number, as a multiple of one (m).
    Varied { variable: usize, unit: f64 },
}

/// Columns of openings, with the seats of their gaps.
fn seats(runner: &Runner<'_>) -> Vec<(usize, Seat)> {
    let study = runner.study;
    let names = || study.base.gaps.iter().map(|gap| gap.name.as_str());
    let seat = |of: &str| {
        let of_gap = |varied: &&VariedEntry| {
            let path = &varied.path;
            path.of_seat() && path.second(names()).is_some_and(|gap| gap == of)
        };
        let mut variables = study.variables.iter().enumerate();
        let varied = variables.find_map(|(variable, v)| {
            let entry = v.target.entries().iter().find(of_gap)?;
            let unit = entry.number(1.0);
            Some(Seat::Varied { variable, unit })
        });
        let gap = study.base.gaps.iter().find(|gap| gap.name == of)?;
        let of_case = gap.seat.as_ref().map(|seat| Seat::OfCase(seat.value));
        varied.or(of_case)
    };
    let layout = &runner.layout;
    let columns = layout.range(OPENING.peak.name).zip(&layout.levels);
    columns
        .filter_map(|(column, level)| Some((column, seat(&level.of)?)))
        .collect()
}

impl SweepReport {
    /// Counts a run with these values of the variables.
    fn count(&mut self, row: &Row, point: &[Value]) {
        self.runs += 1;
        let width = |seat: &Seat| match seat {
            Seat::OfCase(width) => Some(*width),
            Seat::Varied { variable, unit } => match point.get(*variable) {
                Some(Value::Number(width)) => Some(*width * unit),
                _ => None,
            },
        };
        let beyond = |(column, seat): &(usize, Seat)| {
            let opening = row.values.get(*column).copied();
            width(seat)
                .zip(opening)
                .is_some_and(|(width, opening)| opening > width)
        };
        self.unseated += usize::from(self.seats.iter().any(beyond));
        let (count, first, reason) = match &row.ending {
            Ending::Complete => return,
            Ending::Failed(reason) => (&mut self.failed, &mut self.failures, reason),
            Ending::Collapsed(reason) => (&mut self.collapsed, &mut self.collapses, reason),
        };
        *count += 1;
        if first.len() < SHOWN {
            first.push((row.run, reason.clone()));
        }
    }
}

/// When going on finds the result of this very study, there is nothing left to do but the
/// table. Any other file in its place is not ours to replace, as it may be the finished result
/// of another shard, unless an interrupted call of this very study was to replace it.
fn complete(
    runner: &Runner<'_>,
    description: &Description,
    options: &SweepOptions,
) -> Result<Option<SweepReport>, StudyError> {
    if !options.resume || !options.output.is_file() {
        return Ok(None);
    }
    // What an interrupted call of this study was to replace is replaced by the one that goes on;
    // it is not read.
    let label = Label::of(&options.output).and_then(|label| label.study);
    let says_ours = label.is_some_and(|found| {
        found.sha256 == description.study_sha256
            && found.part == description.part
            && found.build == description.build
    });
    if !says_ours && Parts::hold(&options.output, &signature(description)) {
        return Ok(None);
    }
    let standing = |reason: String| StudyError::Standing {
        path: options.output.clone(),
        reason,
    };
    let reader = ResultReader::open(&options.output, WithoutChecksum::Refuse)
        .map_err(|e| standing(e.reason()))?;
    if let Some(other) = other(&reader.description, description) {
        return Err(standing(other));
    }
    let mut report = empty_report(runner, description);
    let mut table = options
        .csv
        .as_ref()
        .map(|path| RunTable::create(path, description))
        .transpose()?;
    reader.each(|row, point| {
        report.count(&row, &point);
        match &mut table {
            Some(table) => table.push(&row, &point),
            None => Ok(()),
        }
    })?;
    table.map_or(Ok(()), RunTable::finish)?;
    Ok(Some(report))
}

/// A shard never takes the place of another one of its study, or of the whole: where all are given
/// one name by mistake, what has been computed stays.
fn spare_other_shards(description: &Description, output: &Path) -> Result<(), StudyError> {
    if description.part.is_whole() || !output.is_file() {
        return Ok(());
    }
    // Not read: its label is enough, whatever its content may be. Anything else is replaced, as
    // the output of any command is.
    match Label::of(output).and_then(|label| label.study) {
        Some(found)
            if found.sha256 == description.study_sha256 && found.part != description.part =>
        {
            Err(StudyError::OtherShard {
                path: output.to_owned(),
                reason: of_this_study(&found.part),
            })
        }
        _ => Ok(()),
    }
}

/// Results of other shards that a shard looks at: of thousands each would look at all others, and one of either version is
/// found soon.
const LOOKED_AT: usize = 16;

/// What the user should know of a folder of shards that holds another version of the study.
fn other_version(description: &Description, options: &SweepOptions) -> Option<String> {
    let folder = options.shared.as_deref()?;
    let own = ShardName::of(&options.output.file_name()?.to_string_lossy())?;
    let names = std::fs::read_dir(folder).ok()?.filter_map(|entry| {
        let name = ShardName::of(&entry.ok()?.file_name().to_string_lossy())?;
        let is_other = name.study == own.study && name.count == own.count && name != own;
        is_other.then_some(name)
    });
    let studies = names.filter_map(|name| {
        let path = folder.join(name.result());
        let study = Label::of(&path)?.study?;
        Some((path, study))
    });
    let mut looked_at = studies.take(LOOKED_AT);
    let (path, _) = looked_at.find(|(_, study)| study.sha256 != description.study_sha256)?;
    Some(format!(
        "{} is of another version of the study, and is not merged with this shard: move it away and make it again, or give each version a folder of its own",
        path.display()
    ))
}

/// What a result is that is not this one.
fn other(found: &Description, wanted: &Description) -> Option<String> {
    if found.study_sha256 != wanted.study_sha256 {
        Some("it is the result of another study, or of another version of this one".to_owned())
    } else if found.part != wanted.part {
        Some(of_this_study(&found.part))
    } else if found.build != wanted.build {
        Some(format!(
            "it was computed by another build of the program ({}; this one is {})",
            found.build, wanted.build
        ))
    } else {
        None
    }
}

/// Writes the result from the stored runs, one after another.
fn assemble(
    runner: &Runner<'_>,
    description: &Description,
    (parts, table): (&Parts, Option<GrowingTable<'_>>),
    options: &SweepOptions,
) -> Result<SweepReport, StudyError> {
    let rows = parts.chunks.iter().map(Range::len).sum();
    // Another process may have written there since the runs were begun.
    spare_other_shards(description, &options.output)?;
    let mut report = empty_report(runner, description);
    let mut writer = ResultWriter::create(&options.output, description, rows)?;
    let study = runner.study.file.as_path();
    let own = ShardName::of_study_file(study, options.shard).result();
    // A shard says it for the result that is merged from it.
    let is_shard = !description.part.is_whole() || options.output.ends_with(own);
    if is_shard || has_default_name(&options.output, study) {
        writer = writer.of_study_file(description, study);
    }
    parts.rows(&mut |row| {
        let point: Vec<Value> = runner.study.point(row.run);
        report.count(&row, &point);
        writer.push(row, point).map_err(StudyError::from)
    })?;
    table.map_or(Ok(()), |table| table.finish(parts))?;
    writer.finish()?;
    Ok(report)
}

/// Finds out before the runs, not after them, whether a path can be the place of a result.
///
/// # Errors
/// [`StudyError::ResultFile`] if it is a folder or a device, or its folder is not there or
/// cannot be written to.
pub fn writable(path: &Path) -> Result<(), StudyError> {
    let failed = |e: std::io::Error| StudyFileError::NoPlace {
        path: path.to_owned(),
        reason: e.to_string(),
    };
    PartFile::beside(path).map(drop).map_err(failed)?;
    Ok(())
}

/// The folder in which the finished runs of a result are kept until it is complete.
#[must_use]
pub fn parts_folder(output: &Path) -> PathBuf {
    Parts::folder(output)
}

/// The coordinates of a study.
fn coordinates(study: &Study) -> Vec<Coordinate> {
    let coordinate = |v: &Variable| Coordinate {
        name: v.name.clone(),
        long_name: v.long_name.clone(),
        unit: v.unit.clone(),
        choices: match &v.values {
            Values::Choices(labels) => Some(labels.clone()),
            _ => None,
        },
    };
    study.variables.iter().map(coordinate).collect()
}
