//! The files of shards.

use std::io::{Error, ErrorKind, Read};
use std::path::{Path, PathBuf};

use pounding_case::Case;
use pounding_files::checksum::hexadecimal;
use pounding_files::input;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::{Made, Numbers, Stored};
use crate::BUILD;
use crate::gap_check::{CaseUnderRecord, CheckError, Ending, Progress, runs_in_parallel};
use crate::shard::Shard;
use crate::stored_runs::{head_and_numbers, whole, with_hash};

/// Makes the runs of a shard and stores them in its file, unless they stand there.
pub(super) fn part<T: Stored>(
    (shard, file): (Shard, &Path),
    identity: &str,
    count: usize,
    (threads, progress): (usize, Progress<'_>),
    make: impl Fn(usize, &mut Ending<'_>) -> Made<T> + Sync,
) -> Result<Vec<Made<T>>, CheckError> {
    let mine: Vec<usize> = (shard.index - 1..count).step_by(shard.count).collect();
    let failed = |e: Error| CheckError::Unwritten {
        path: file.to_owned(),
        reason: e.to_string(),
    };
    let standing = Content::read(file, identity);
    if standing.is_err() || standing.is_ok_and(|found| found.shard != shard) {
        // Anything else in its place is not ours to replace.
        if file.exists() {
            return Err(refused(
                file,
                "it is not this shard of this check, or damaged: move it away",
            ));
        }
        // Found out before the runs, not after them.
        pounding_files::PartFile::own(file).map_err(failed)?;
        let made = runs_in_parallel(mine.len(), threads, progress, |i, ending| {
            make(mine[i], ending)
        })?;
        let content = Content::of(shard, count, &mine, &made).encode(identity);
        pounding_files::write_own(file, &content).map_err(failed)?;
    }
    let elsewhere = |_| Err("it is made by another shard".to_owned());
    Ok((0..count).map(elsewhere).collect())
}

/// Puts the runs of all shards together.
pub(super) fn merged<T: Stored>(
    files: &[PathBuf],
    identity: &str,
    count: usize,
) -> Result<Vec<Made<T>>, CheckError> {
    let mut runs: Vec<Option<Made<T>>> = Vec::new();
    runs.resize_with(count, || None);
    let mut of: Option<(usize, &Path)> = None;
    let mut found = Vec::new();
    for file in files {
        let content = Content::read(file, identity).map_err(|e| refused(file, &e.to_string()))?;
        let shards = content.shard.count;
        let (expected, first) = *of.get_or_insert((shards, file));
        if shards != expected {
            let reason = format!(
                "it is one of {shards} shards, {} one of {expected}",
                first.display()
            );
            return Err(refused(file, &reason));
        }
        if content.count != count {
            return Err(refused(file, "it has not the runs of this check"));
        }
        found.push(content.shard.index);
        for (number, run) in content.runs {
            let run = match run {
                Ok(numbers) => T::from_numbers(&mut Numbers(&numbers)).map(Ok),
                Err(reason) => Some(Err(reason)),
            };
            let (Some(run), Some(place)) = (run, runs.get_mut(number)) else {
                return Err(refused(file, "a run of it is none that can be"));
            };
            if place.replace(run).is_some() {
                let reason = format!("shard {} is there twice", content.shard.index);
                return Err(refused(file, &reason));
            }
        }
    }
    let (shards, first) = of.unwrap_or((0, Path::new("")));
    let missing: Vec<usize> = (1..=shards).filter(|s| !found.contains(s)).collect();
    if !missing.is_empty() {
        let list = pounding_results::study::ranges(&missing);
        return Err(refused(
            first,
            &format!("of {shards} shards these are missing: {list}"),
        ));
    }
    let all: Option<Vec<_>> = runs.into_iter().collect();
    all.ok_or_else(|| refused(first, "runs are missing"))
}

fn refused(file: &Path, reason: &str) -> CheckError {
    CheckError::Shards {
        path: file.to_owned(),
        reason: reason.to_owned(),
    }
}

/// What decides the runs of a check: what it is and is asked for, the case, and every file that
/// both read.
pub(crate) fn identity(
    what: &str,
    asked: &dyn std::fmt::Debug,
    case: &Case,
    records: &[CaseUnderRecord],
) -> String {
    let mut hash = Sha256::new();
    hash.update(format!("{BUILD}\n{what}\n{asked:?}\n"));
    hash.update(&case.source);
    let files = case.files().into_iter().map(|(_, path)| path);
    for path in files.chain(records.iter().map(|r| r.file.clone())) {
        // What cannot be read has no runs either.
        let bytes = input::read(&path).unwrap_or_default();
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    }
    hexadecimal(&hash.finalize())
}

/// What stands in the file of a shard: a line of JSON, the numbers, and a hash of all before it.
struct Content {
    shard: Shard,
    count: usize,
    runs: Vec<(usize, Made<Vec<f64>>)>,
}

/// How the line of JSON begins.
const BEGINS: &[u8] = b"{\"check\":\"";

/// Whether a file is a whole shard of a gap check or a comparison, of whatever case.
#[must_use]
pub fn is_shard_of_check(file: &Path) -> bool {
    let mut begins = [0; BEGINS.len()];
    let first = input::open(file).and_then(|mut file| file.read_exact(&mut begins));
    first.is_ok()
        && begins == BEGINS
        && input::read(file).is_ok_and(|bytes| whole(&bytes).is_some())
}

impl Content {
    fn of<T: Stored>(shard: Shard, count: usize, mine: &[usize], made: &[Made<T>]) -> Self {
        let numbers = |run: &T| {
            let mut numbers = Vec::new();
            run.to_numbers(&mut numbers);
            numbers
        };
        let runs = mine.iter().zip(made);
        Self {
            shard,
            count,
            runs: runs
                .map(|(number, run)| (*number, run.as_ref().map(numbers).map_err(Clone::clone)))
                .collect(),
        }
    }

    fn encode(&self, identity: &str) -> Vec<u8> {
        let head = |(number, run): &(usize, Made<Vec<f64>>)| match run {
            Ok(numbers) => json!([number, numbers.len()]),
            Err(reason) => json!([number, reason]),
        };
        let head = json!({
            "check": identity, "shard": self.shard.index, "shards": self.shard.count,
            "count": self.count, "runs": self.runs.iter().map(head).collect::<Vec<_>>(),
        });
        let mut bytes = format!("{head}\n").into_bytes();
        for x in self.runs.iter().flat_map(|(_, run)| run.iter().flatten()) {
            bytes.extend_from_slice(&x.to_le_bytes());
        }
        with_hash(bytes)
    }

    fn read(file: &Path, identity: &str) -> std::io::Result<Self> {
        let wrong = |reason: &'static str| Error::new(ErrorKind::InvalidData, reason);
        let bytes = input::read(file)?;
        let damaged = || wrong("it is damaged, or no shard of a check");
        let parts = whole(&bytes).and_then(head_and_numbers);
        let (head, numbers) = parts.ok_or_else(damaged)?;
        if head["check"] != identity {
            return Err(wrong(
                "it is of another check: other options, another case or record, or another build of the program",
            ));
        }
        let number = |value: &Value| value.as_u64().and_then(|n| usize::try_from(n).ok());
        let mut numbers = numbers.as_chunks::<8>().0.iter();
        let run = |entry: &Value| {
            let run = match entry[1].as_str() {
                Some(reason) => Err(reason.to_owned()),
                None => {
                    let count = number(&entry[1])?;
                    let own = numbers.by_ref().take(count);
                    let own: Vec<f64> = own.map(|b| f64::from_le_bytes(*b)).collect();
                    Ok((own.len() == count).then_some(own)?)
                }
            };
            Some((number(&entry[0])?, run))
        };
        let runs = head["runs"].as_array().into_iter().flatten().map(run);
        let runs = runs.collect::<Option<Vec<_>>>();
        let numbers = [&head["shard"], &head["shards"], &head["count"]].map(number);
        match (runs, numbers) {
            (Some(runs), [Some(index), Some(of), Some(count)]) => Ok(Self {
                shard: Shard { index, count: of },
                count,
                runs,
            }),
            _ => Err(damaged()),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::Deal;
    use super::*;
    use crate::gap_check::UNWATCHED;

    /// A run of a few numbers.
    #[derive(Debug, Clone, PartialEq)]
    struct Run(Vec<f64>);

    impl Stored for Run {
        fn to_numbers(&self, numbers: &mut Vec<f64>) {
            numbers.push(self.0.len() as f64);
            numbers.extend(&self.0);
        }
        fn from_numbers(numbers: &mut Numbers<'_>) -> Option<Self> {
            numbers.list(Numbers::take).map(Self)
        }
    }

    fn make(number: usize, _: &mut Ending<'_>) -> Made<Run> {
        match number % 5 {
            3 => Err(format!("run {number}\nfailed")),
            few => Ok(Run((0..few).map(|i| (number + i) as f64 / 3.0).collect())),
        }
    }

    fn runs(deal: &Deal, identity: &str, count: usize) -> Result<Vec<Made<Run>>, CheckError> {
        deal.runs(|| identity.to_owned(), count, (2, UNWATCHED), make)
    }

    #[test]
    fn shards_give_what_one_process_gives() {
        let folder = tempfile::tempdir().unwrap();
        let file = |i: usize| folder.path().join(format!("{i}"));
        for (count, shards) in [(23, 4), (2, 5), (0, 2)] {
            let whole = runs(&Deal::All, "a", count).unwrap();
            let mut files = Vec::new();
            for index in (1..=shards).rev() {
                let (shard, file) = (
                    Shard {
                        index,
                        count: shards,
                    },
                    file(index),
                );
                // Twice: the second finds it done.
                for _ in 0..2 {
                    let file = file.clone();
                    runs(&Deal::Part { shard, file }, "a", count).unwrap();
                }
                files.push(file);
            }
            let merged = Deal::Merged {
                files: files.clone(),
            };
            assert_eq!(runs(&merged, "a", count).unwrap(), whole);
            let told = |files: &[PathBuf], identity, count| {
                let deal = Deal::Merged {
                    files: files.to_vec(),
                };
                runs(&deal, identity, count).unwrap_err().to_string()
            };
            assert!(told(&files, "b", count).contains("another check"));
            assert!(told(&files[1..], "a", count).contains("missing"));
            assert!(told(&files, "a", count + 1).contains("not the runs"));
            if count > 0 {
                let twice = [&files[..], &files[shards - 1..]].concat();
                assert!(told(&twice, "a", count).contains("twice"));
                let other = Deal::Part {
                    shard: Shard {
                        index: 1,
                        count: shards + 1,
                    },
                    file: files[0].clone(),
                };
                let refused = runs(&other, "a", count).unwrap_err().to_string();
                assert!(refused.contains("move it away"), "{refused}");
            }
            files.iter().for_each(|f| std::fs::remove_file(f).unwrap());
        }
    }

    /// Any cut, and any changed byte, is seen.
    #[test]
    fn damage_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a");
        let shard = Shard { index: 1, count: 2 };
        let part = Deal::Part {
            shard,
            file: file.clone(),
        };
        runs(&part, "a", 6).unwrap();
        let whole = std::fs::read(&file).unwrap();
        for at in 0..whole.len() {
            std::fs::write(&file, &whole[..at]).unwrap();
            assert!(Content::read(&file, "a").is_err(), "cut at {at}");
            let mut bent = whole.clone();
            bent[at] ^= 1;
            std::fs::write(&file, bent).unwrap();
            assert!(Content::read(&file, "a").is_err(), "bent at {at}");
        }
    }
}
