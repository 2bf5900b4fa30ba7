//! Files without a checksum are read in a process of their own.
//!
//! Versions before the checksum wrote results that look whole when they are damaged. Only
//! the HDF5 library finds out, and may crash, hang or ask for all memory on the way: the
//! program then runs the same command once more as a child, which may do all that, and
//! reports what came of it.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use pounding_files::checksum::{ABSENT, WithoutChecksum, is_absent};

use crate::failure::Failure;

/// The hidden option that tells the child that it is one.
pub const OPTION: &str = "accept-without-checksum";
/// Time that reading takes at most, and what is added for each byte.
const TIME: Duration = Duration::from_secs(30);
const BYTES_PER_SECOND: u64 = 1_000_000;
/// Processor time (s) that reading takes at most, with the same addition: where the library gets
/// lost it keeps a processor busy, while a slow disk only takes time.
#[cfg(unix)]
const PROCESSOR_TIME: u64 = 5;
/// Memory that reading takes at most (bytes), and what is added for each byte: results
/// are compressed.
#[cfg(unix)]
const MEMORY: u64 = 4 << 30;
#[cfg(unix)]
const MEMORY_PER_BYTE: u64 = 16;
/// How a child ends that has reached the limit: what it listens to says so by a signal.
pub const OUT_OF_PROCESSOR_TIME: i32 = 9;
/// How often the child is looked at.
const INTERVAL: Duration = Duration::from_millis(10);
/// Exit codes that say what they say everywhere; a panic has another.
const OWN_CODES: std::ops::RangeInclusive<i32> = 0..=5;

/// Who reads.
pub enum Reading {
    /// This process, with what it may read.
    Here(WithoutChecksum),
    /// A child has done all that was asked.
    Done,
}

/// Decides who reads these files, and lets a child do it if one of them has no checksum.
/// `child` says that this process is that child.
pub fn reading(files: &[PathBuf], child: bool) -> Result<Reading, Failure> {
    if child {
        limit_resources(files);
        return Ok(Reading::Here(WithoutChecksum::Accept));
    }
    // Files that cannot be read are reported by the reader.
    let absent = files.iter().filter(|f| matches!(is_absent(f), Ok(true)));
    let absent: Vec<&PathBuf> = absent.collect();
    if absent.is_empty() {
        return Ok(Reading::Here(WithoutChecksum::Refuse));
    }
    let failed = |e: std::io::Error| Failure::output(&e, "a process that reads");
    let program = std::env::current_exe().map_err(failed)?;
    let mut command = Command::new(program);
    command
        .args(std::env::args_os().skip(1))
        .arg(format!("--{OPTION}"));
    let time = TIME + Duration::from_secs(size(files) / BYTES_PER_SECOND);
    let (ending, said) = run(&mut command, time).map_err(failed)?;
    let how = match ending {
        Ending::Exit(status) => match status.code() {
            Some(code) if OWN_CODES.contains(&code) => {
                // If it cannot be said, the exit code still says it.
                let _ = std::io::stderr().write_all(&said);
                return match u8::try_from(code) {
                    Ok(0) | Err(_) => Ok(Reading::Done),
                    Ok(code) => Err(Failure::Reported(code)),
                };
            }
            Some(OUT_OF_PROCESSOR_TIME) => {
                "reading it took too much time of the processor".to_owned()
            }
            _ => format!("reading it ended without an answer ({status})"),
        },
        Ending::OverTime => format!("reading it took more than {} s", time.as_secs()),
    };
    let names: Vec<String> = absent.iter().map(|f| f.display().to_string()).collect();
    Err(Failure::input(
        format!(
            "{} cannot be read: it has no checksum, and {how}: it is damaged",
            names.join(" or ")
        ),
        Some("copy the file again from where it is whole, or run it again".to_owned()),
    ))
}

/// The warnings of files that were read without a checksum.
pub fn warnings(files: &[PathBuf]) -> Vec<String> {
    let warning = |file: &PathBuf| format!("{} {ABSENT}", file.display());
    files.iter().map(warning).collect()
}

/// Whether this process reads for another one, which says what there is to say.
pub fn is_child() -> bool {
    std::env::args_os().any(|a| {
        a.to_str()
            .is_some_and(|a| a.strip_prefix("--") == Some(OPTION))
    })
}

fn size(files: &[PathBuf]) -> u64 {
    let size = |f: &PathBuf| Path::metadata(f).map_or(0, |m| m.len());
    files.iter().map(size).sum()
}

/// How a child ended.
#[derive(Debug)]
enum Ending {
    Exit(ExitStatus),
    OverTime,
}

/// Runs a command for this long at most; with it what it wrote to standard error.
fn run(command: &mut Command, time: Duration) -> std::io::Result<(Ending, Vec<u8>)> {
    let mut child = command
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let pipe = child.stderr.take();
    let said = std::thread::spawn(move || {
        let mut said = Vec::new();
        // What was read until the pipe broke is all there is.
        let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut said));
        said
    });
    let started = Instant::now();
    let ending = loop {
        if let Some(status) = child.try_wait()? {
            break Ending::Exit(status);
        }
        if started.elapsed() > time {
            child.kill()?;
            child.wait()?;
            break Ending::OverTime;
        }
        std::thread::sleep(INTERVAL);
    };
    Ok((ending, said.join().unwrap_or_default()))
}

/// Keeps a damaged size from taking the memory of the machine or its processor for long, and
/// crashes from leaving their memory on the disk.
#[cfg(unix)]
fn limit_resources(files: &[PathBuf]) {
    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    let size = size(files);
    let bytes = MEMORY.saturating_add(size.saturating_mul(MEMORY_PER_BYTE));
    let seconds = PROCESSOR_TIME + size / BYTES_PER_SECOND;
    let all = [
        (Resource::As, bytes),
        (Resource::Core, 0),
        (Resource::Cpu, seconds),
    ];
    for (resource, most) in all {
        let maximum = getrlimit(resource).maximum;
        let most = Some(maximum.map_or(most, |m| m.min(most)));
        // Without a limit it is read all the same.
        let _ = setrlimit(
            resource,
            Rlimit {
                current: most,
                maximum,
            },
        );
    }
}

#[cfg(not(unix))]
fn limit_resources(_files: &[PathBuf]) {}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn shell(script: &str) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        command
    }

    #[test]
    fn a_child_is_ended_when_its_time_is_over() {
        let (ending, _) = run(&mut shell("exec sleep 600"), Duration::from_millis(50)).unwrap();
        assert!(matches!(ending, Ending::OverTime));
    }

    #[test]
    fn a_child_says_how_it_ended() {
        let long = Duration::from_secs(600);
        let (ending, said) = run(&mut shell("echo told >&2; exit 3"), long).unwrap();
        assert_eq!(said, b"told\n");
        assert!(matches!(ending, Ending::Exit(status) if status.code() == Some(3)));
        let (ending, _) = run(&mut shell("kill -SEGV $$"), long).unwrap();
        assert!(matches!(ending, Ending::Exit(status) if status.code().is_none()));
    }
}
