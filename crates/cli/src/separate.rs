//! Results that are read back are read in a process of their own.
//!
//! Anybody can write a file that looks like a result, with a checksum that matches. Only the
//! HDF5 library finds out, and may crash, hang or ask for all memory on the way: the program
//! runs the same command once more as a child, which may do all that, and reports what came of
//! it. The child limits itself while the library is at work, and tells which file it reads.

use std::ffi::OsString;
use std::io::{IsTerminal, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{ChildStdout, Command, ExitStatus, Stdio};
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread::JoinHandle;
#[cfg(not(unix))]
use std::time::{Duration, Instant};

use pounding_case::{MORE_FILES, is_short_of_files};
use pounding_files::checksum::{ABSENT, WithoutChecksum, is_absent};
use pounding_files::{FileUse, remove_left_by};
use pounding_results::watch::{Watcher, watch};

use crate::arguments::ColorChoice;
use crate::command_words::{OPTION_OF_CHILD, end_of_options};
use crate::exit_code::{self, OUT_OF_PROCESSOR_TIME, OWN_CODES, RUNS_ARE_LEFT};
use crate::failure::Failure;

/// How the line begins by which a child tells the number of the file that it reads.
const MARK: &[u8] = b"\0reads ";
/// Time that a command takes at most where processor time has no limits, and what is added for
/// each byte.
#[cfg(not(unix))]
const TIME: Duration = Duration::from_secs(600);
/// Bytes that are read in a second by the slowest machine.
const BYTES_PER_SECOND: u64 = 1_000_000;
/// Processor time (s) that reading a file, or a part of it, takes at most, with the same
/// addition: where the library gets lost it keeps a processor busy, while a slow disk only takes
/// time.
#[cfg(unix)]
const PROCESSOR_TIME: u64 = 2;
/// Memory that reading takes at most (bytes), and what is added for each byte: results
/// are compressed.
#[cfg(unix)]
const MEMORY: u64 = 4 << 30;
#[cfg(unix)]
const MEMORY_PER_BYTE: u64 = 16;
/// Files that this process reads for another one, in the order of its arguments.
static FILES: OnceLock<Vec<PathBuf>> = OnceLock::new();
/// The program that a child is, where it is not the file of this process.
static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
/// The child of this process.
static CHILD: Mutex<Option<u32>> = Mutex::new(None);

/// Makes children of this program, which takes the arguments of this process: an interpreter, whose file
/// may be a link that says where its packages are.
pub fn take_program(program: PathBuf) {
    let _ = PROGRAM.set(program);
}

/// Who reads.
pub enum Reading {
    /// This process, with what it may read.
    Here(WithoutChecksum),
    /// A child has done all that was asked.
    Done,
}

/// A child has ended without an answer.
pub struct NoAnswer {
    /// The file that it was reading, by its number; not known if it had read none.
    pub file: Option<usize>,
    how: String,
}

impl NoAnswer {
    /// What this says of the file.
    pub fn reason(&self) -> String {
        format!("it is damaged, whatever its checksum says: {}", self.how)
    }

    /// What this says of the files that were to be read.
    pub fn failure(&self, files: &[PathBuf]) -> Failure {
        if let Some(limit) = limited_memory() {
            return Failure::computation(
                format!("results cannot be read here: {}; {limit}", self.how),
                Some(MORE_MEMORY.to_owned()),
            );
        }
        let about = match (self.file.and_then(|number| files.get(number)), files) {
            (Some(file), _) | (None, [file]) => file.display().to_string(),
            (None, files) => format!("one of {} files", files.len()),
        };
        Failure::input(
            format!("{about} cannot be read: {}", self.reason()),
            Some("copy the file again from where it is whole, or run it again".to_owned()),
        )
    }
}

/// Memory (bytes) with which any result of ours can be read, but those of millions of runs: three times what the program
/// itself takes.
const ENOUGH_MEMORY: u64 = 1 << 28;
/// What to do where there is less.
pub const MORE_MEMORY: &str = "allow more memory (`ulimit -v`)";

/// That the memory of this process is so limited that a file may be whole where it cannot be read.
pub fn limited_memory() -> Option<String> {
    #[cfg(unix)]
    {
        use rustix::process::{Resource, getrlimit};
        let limit = getrlimit(Resource::As).current?;
        (limit < ENOUGH_MEMORY).then(|| {
            let megabytes = limit / 1_000_000;
            format!("the memory of this process is limited to {megabytes} MB, which may be why")
        })
    }
    #[cfg(not(unix))]
    None
}

/// Has a child do what this process was asked for, as it reads these files; `child` says that
/// this process is that child. What the child leaves unfinished beside the outputs of `used` is
/// removed.
pub fn reading(files: &[PathBuf], used: &FileUse, child: bool) -> Result<Reading, Failure> {
    by_child(files, used, child, &[])?.map_err(|none| none.failure(files))
}

/// The same with more arguments for the child; also says that it came to no answer.
pub fn by_child(
    files: &[PathBuf],
    used: &FileUse,
    child: bool,
    more: &[OsString],
) -> Result<Result<Reading, NoAnswer>, Failure> {
    if child {
        prepare(files);
        return Ok(Ok(Reading::Here(WithoutChecksum::Accept)));
    }
    // What does not even begin and end as results do is refused without the library.
    if files.iter().all(|file| is_absent(file).is_err()) {
        return Ok(Ok(Reading::Here(WithoutChecksum::Refuse)));
    }
    let program = match PROGRAM.get() {
        Some(program) => program.clone(),
        None => std::env::current_exe().map_err(no_process)?,
    };
    let given: Vec<OsString> = std::env::args_os().skip(1).collect();
    let (options, names) = given.split_at(end_of_options(&given));
    let mut command = Command::new(program);
    command
        .args(options)
        .arg(format!("--{OPTION_OF_CHILD}"))
        .args(more);
    // Its errors are shown by this process, as the terminal of this one can.
    let colored = |a: &OsString| a.to_string_lossy().starts_with("--color");
    if !given.iter().any(colored) && ColorChoice::Auto.is_on(std::io::stderr().is_terminal()) {
        command.arg("--color=always");
    }
    command.args(names);
    match ended(&mut command, files, used).map_err(no_process)? {
        Ok(answer) => {
            // If it cannot be said, the exit code still says it.
            let _ = std::io::stderr().write_all(&answer.said);
            match answer.code {
                0 => Ok(Ok(Reading::Done)),
                code => Err(Failure::Reported(code)),
            }
        }
        Err(none) => Ok(Err(none)),
    }
}

/// What a child answers that another program than this one has made.
#[derive(Debug)]
pub struct Answer {
    /// Its exit code.
    pub code: u8,
    /// What it printed.
    pub printed: Vec<u8>,
    /// What it said to people.
    said: Vec<u8>,
}

impl Answer {
    /// Whether it found runs that are to be made, which is not its work.
    #[must_use]
    pub fn leaves_runs(&self) -> bool {
        self.code == RUNS_ARE_LEFT
    }

    /// What kept it from printing an answer.
    #[must_use]
    pub fn failure(&self) -> Failure {
        let said = String::from_utf8_lossy(&self.said);
        let words = said
            .lines()
            .map(|line| line.trim().trim_start_matches(['\u{d7}', '\u{2502}', ' ']));
        let words = words
            .filter(|line| !line.is_empty())
            .collect::<Vec<_>>()
            .join(" ");
        let (message, help) = match words.split_once(" help: ") {
            Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
            None => (words, None),
        };
        match self.code {
            exit_code::COMPUTATION => Failure::computation(message, help),
            exit_code::OUTPUT => Failure::unwritten(message, help),
            exit_code::INTERRUPTED => Failure::interrupted(message, help),
            _ => Failure::input(message, help),
        }
    }
}

/// Has a child read files for a program that is no command: this one, called with these arguments as
/// the command line is.
///
/// # Errors
/// It cannot be started, or ends without an answer.
pub fn answered(
    program: &Path,
    arguments: &[OsString],
    files: &[PathBuf],
    used: &FileUse,
) -> Result<Answer, Failure> {
    let mut command = Command::new(program);
    command.args(arguments).arg(format!("--{OPTION_OF_CHILD}"));
    command.env("NO_COLOR", "1").stdout(Stdio::piped());
    let ended = ended(&mut command, files, used);
    let ended = ended.map_err(no_process)?;
    ended.map_err(|none| none.failure(files))
}

/// Runs a child that reads files. What it leaves unfinished beside outputs without coming to an
/// answer is removed.
fn ended(
    command: &mut Command,
    files: &[PathBuf],
    used: &FileUse,
) -> std::io::Result<Result<Answer, NoAnswer>> {
    let Ended {
        ending,
        printed,
        said,
        process,
    } = run(command, size(files))?;
    let (said, file) = unmarked(&said);
    let how = match ending {
        Ending::Exit(status) => match (status.code(), limited_memory()) {
            // What is told of a file as if it were damaged, or none of ours.
            (Some(code), Some(limit)) if code == i32::from(exit_code::INPUT) => {
                let mut said = said;
                said.extend_from_slice(format!("note: {limit}: {MORE_MEMORY}\n").as_bytes());
                return Ok(Ok(Answer {
                    code: exit_code::COMPUTATION,
                    printed,
                    said,
                }));
            }
            (Some(code), _) if OWN_CODES.contains(&code) => {
                return Ok(Ok(Answer {
                    code: u8::try_from(code).unwrap_or_default(),
                    printed,
                    said,
                }));
            }
            (Some(OUT_OF_PROCESSOR_TIME), _) => {
                "reading it took too much time of the processor".to_owned()
            }
            _ => format!("reading it ended without an answer ({status})"),
        },
        #[cfg(not(unix))]
        Ending::OverTime => "reading it took too much time".to_owned(),
    };
    tracing::debug!(said = %String::from_utf8_lossy(&said), "a child ended without an answer");
    used.outputs()
        .for_each(|output| remove_left_by(output, process));
    Ok(Err(NoAnswer { file, how }))
}

/// What a child said for people, and the number of the file that it read last.
fn unmarked(said: &[u8]) -> (Vec<u8>, Option<usize>) {
    let mut text = Vec::new();
    let mut file = None;
    for line in said.split_inclusive(|byte| *byte == b'\n') {
        match line.strip_prefix(MARK) {
            Some(number) => {
                let number = String::from_utf8_lossy(number);
                file = number.trim().parse().ok().or(file);
            }
            None => text.extend_from_slice(line),
        }
    }
    (text, file)
}

/// The warnings of files that were read without a checksum.
pub fn warnings(files: &[PathBuf]) -> Vec<String> {
    let warning = |file: &PathBuf| format!("{} {ABSENT}", file.display());
    files.iter().map(warning).collect()
}

/// Has the child of this process end, before this one does.
pub fn end_child() {
    #[cfg(unix)]
    {
        use rustix::process::{Pid, Signal, kill_process};
        let child = *CHILD.lock().unwrap_or_else(PoisonError::into_inner);
        let number = child.and_then(|number| i32::try_from(number).ok());
        if let Some(child) = number.and_then(Pid::from_raw) {
            // It may have ended by itself.
            let _ = kill_process(child, Signal::TERM);
        }
    }
}

fn size(files: &[PathBuf]) -> u64 {
    let size = |f: &PathBuf| Path::metadata(f).map_or(0, |m| m.len());
    files.iter().map(size).sum()
}

/// How a child ended.
#[derive(Debug)]
enum Ending {
    Exit(ExitStatus),
    #[cfg(not(unix))]
    OverTime,
}

/// A child that has ended.
struct Ended {
    ending: Ending,
    /// What it wrote to standard output, if that is a pipe.
    printed: Vec<u8>,
    /// What it wrote to standard error.
    said: Vec<u8>,
    process: u32,
}

/// Reads what a child prints.
fn printed_by(mut pipe: ChildStdout) -> std::io::Result<JoinHandle<Vec<u8>>> {
    std::thread::Builder::new().spawn(move || {
        let mut printed = Vec::new();
        let _ = pipe.read_to_end(&mut printed);
        printed
    })
}

/// Why there is no process that reads.
fn no_process(error: std::io::Error) -> Failure {
    let help = match is_short_of_files(&error) {
        true => MORE_FILES,
        false => {
            "end other programs, or raise the limits of processes and memory (`ulimit -u`, `ulimit -v`)"
        }
    };
    Failure::computation(
        format!("results are read by a process of their own, which the system refuses: {error}"),
        Some(help.to_owned()),
    )
}

/// Runs a command that reads so many bytes.
#[cfg_attr(unix, expect(unused_variables))]
fn run(command: &mut Command, bytes: u64) -> std::io::Result<Ended> {
    let mut child = command
        .stdin(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()?;
    let process = child.id();
    let known = |child| *CHILD.lock().unwrap_or_else(PoisonError::into_inner) = child;
    known(Some(process));
    let printing = match child.stdout.take().map(printed_by).transpose() {
        Ok(printing) => printing,
        Err(error) => {
            let _ = child.kill();
            let _ = child.wait();
            known(None);
            return Err(error);
        }
    };
    let pipe = child.stderr.take();
    #[cfg(unix)]
    let (ending, said) = {
        let mut said = Vec::new();
        // What was read until the pipe broke is all there is.
        let _ = pipe.map(|mut pipe| pipe.read_to_end(&mut said));
        (Ending::Exit(child.wait()?), said)
    };
    #[cfg(not(unix))]
    let (ending, said) = {
        let time = TIME + Duration::from_secs(bytes / BYTES_PER_SECOND);
        let reader = std::thread::spawn(move || {
            let mut said = Vec::new();
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
            std::thread::sleep(Duration::from_millis(10));
        };
        (ending, reader.join().unwrap_or_default())
    };
    known(None);
    let printed = printing.and_then(|thread| thread.join().ok());
    Ok(Ended {
        ending,
        printed: printed.unwrap_or_default(),
        said,
        process,
    })
}

/// Prepares this process for reading files that may be anything.
fn prepare(files: &[PathBuf]) {
    if FILES.set(files.to_vec()).is_err() {
        return;
    }
    #[cfg(unix)]
    limits::prepare();
    watch(Watcher {
        begins: |path| {
            tell(path);
            #[cfg(unix)]
            limits::set(path);
        },
        ends: || {
            #[cfg(unix)]
            limits::lift();
        },
    });
}

/// Tells the parent which file is read, if it is another one than before.
fn tell(path: &Path) {
    static LAST: Mutex<Option<usize>> = Mutex::new(None);
    let Some(files) = FILES.get() else { return };
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    if last
        .and_then(|number| files.get(number))
        .is_some_and(|file| file == path)
    {
        return;
    }
    *last = files.iter().position(|file| file == path);
    if let Some(number) = *last {
        let line = [MARK, format!("{number}\n").as_bytes()].concat();
        // A parent that is gone asks for nothing any more.
        let _ = std::io::stderr().write_all(&line);
    }
}

/// Keeps a damaged size from taking the memory of the machine or its processor for long, and
/// crashes from leaving their memory on the disk.
#[cfg(unix)]
mod limits {
    use std::path::Path;
    use std::sync::OnceLock;

    use rustix::process::{Resource, Rlimit, getrlimit, setrlimit};
    use rustix::time::{ClockId, clock_gettime};

    use super::{BYTES_PER_SECOND, MEMORY, MEMORY_PER_BYTE, PROCESSOR_TIME};

    const LIMITED: [Resource; 2] = [Resource::As, Resource::Cpu];
    /// What the limits were before.
    static BEFORE: OnceLock<[Rlimit; 2]> = OnceLock::new();

    /// Remembers the limits that there are.
    pub fn prepare() {
        let _ = BEFORE.set(LIMITED.map(getrlimit));
        let maximum = getrlimit(Resource::Core).maximum;
        limit(Resource::Core, Some(0), maximum);
        // Whoever asked for this is gone: nobody reads the answer.
        #[cfg(target_os = "linux")]
        let _ =
            rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::TERM));
    }

    /// Limits what reading a file may take from here on.
    pub fn set(path: &Path) {
        let Some(before) = BEFORE.get() else { return };
        let size = Path::metadata(path).map_or(0, |m| m.len());
        let spent = clock_gettime(ClockId::ProcessCPUTime).tv_sec;
        let seconds = u64::try_from(spent).unwrap_or(0) + 1 + PROCESSOR_TIME;
        let most = [
            MEMORY.saturating_add(size.saturating_mul(MEMORY_PER_BYTE)),
            seconds + size / BYTES_PER_SECOND,
        ];
        for ((resource, before), most) in LIMITED.into_iter().zip(before).zip(most) {
            let most = before.current.map_or(most, |current| current.min(most));
            limit(resource, Some(most), before.maximum);
        }
    }

    /// Limits no more than before.
    pub fn lift() {
        let Some(before) = BEFORE.get() else { return };
        for (resource, before) in LIMITED.into_iter().zip(before) {
            limit(resource, before.current, before.maximum);
        }
    }

    fn limit(resource: Resource, current: Option<u64>, maximum: Option<u64>) {
        // Without a limit it is read all the same.
        let _ = setrlimit(resource, Rlimit { current, maximum });
    }
}

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
    fn a_child_says_how_it_ended() {
        let ended = run(&mut shell("echo told >&2; exit 3"), 0).unwrap();
        assert_eq!(ended.said, b"told\n");
        assert!(matches!(ended.ending, Ending::Exit(status) if status.code() == Some(3)));
        let ended = run(&mut shell("kill -SEGV $$"), 0).unwrap();
        assert!(matches!(ended.ending, Ending::Exit(status) if status.code().is_none()));
    }

    #[test]
    fn what_keeps_a_child_from_an_answer_is_a_failure_in_its_words() {
        let script = "echo '{}'; printf '\\0reads 0\\n  \\303\\227 it is\\n  \\342\\224\\202 damaged\\n  help: copy\\n        it\\n\\n' >&2; exit 4";
        let arguments = ["-c", script].map(OsString::from);
        let answer = answered(Path::new("sh"), &arguments, &[], &FileUse::new()).unwrap();
        assert_eq!((answer.code, &answer.printed[..]), (4, &b"{}\n"[..]));
        let Failure::Output(report) = answer.failure() else {
            panic!("another kind");
        };
        assert_eq!(report.to_string(), "it is damaged");
        assert_eq!(
            report.help().map(|h| h.to_string()),
            Some("copy it".to_owned())
        );
        let arguments = ["-c", "kill -SEGV $$"].map(OsString::from);
        let file = [PathBuf::from("result.h5")];
        let failure = answered(Path::new("sh"), &arguments, &file, &FileUse::new()).unwrap_err();
        let Failure::Input(report) = failure else {
            panic!("another kind");
        };
        assert!(
            report
                .to_string()
                .starts_with("result.h5 cannot be read: it is damaged")
        );
    }

    #[test]
    fn what_a_child_reads_is_told_apart_from_what_it_says() {
        let (text, file) = unmarked(b"\0reads 0\nwarning\n\0reads 12\nlast");
        assert_eq!((&text[..], file), (&b"warning\nlast"[..], Some(12)));
        assert_eq!(unmarked(b"no mark\n"), (b"no mark\n".to_vec(), None));
    }
}
