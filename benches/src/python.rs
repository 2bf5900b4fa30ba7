//! What the Python package's `run_many` costs beside the library.

use std::fmt::Write as _;
use std::process::Command;
use std::time::Instant;

use pounding::Model;
use pounding_time_history::in_parallel;
use verification::Failure;

use crate::clock::{least, process_seconds, thread_seconds};

/// Runs of a batch.
const RUNS: usize = 1000;
/// Interleaved batches of each kind.
const ROUNDS: usize = 5;
/// The README's pair.
const CASE: &str = "examples/three_storey_pair/case.toml";
/// Prints processor and elapsed time (s) of a batch.
const SCRIPT: &str = "
import sys, time, pounding
path, runs, threads, same = sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), sys.argv[4] == 'same'
cases = [pounding.Case.from_file(path)] * runs if same else [pounding.Case.from_file(path) for _ in range(runs)]
pounding.run_many(cases[:10], threads=threads)
processor, elapsed = time.process_time(), time.perf_counter()
pounding.run_many(cases, threads=threads)
print(time.process_time() - processor, time.perf_counter() - elapsed)
";

/// Time of a thousand runs by the library and by `run_many` of this interpreter, in which the
/// package is installed as it is handed out.
pub(crate) fn beside_the_library(interpreter: &str) -> Result<String, Failure> {
    let model = Model::read(CASE)?;
    let python = |threads: &str, same: &str| -> Result<(f64, f64), Failure> {
        let made = Command::new(interpreter)
            .args(["-c", SCRIPT, CASE, &RUNS.to_string(), threads, same])
            .output()?;
        let said = String::from_utf8(made.stdout)?;
        let mut numbers = said.split_whitespace().map(str::parse);
        match (numbers.next(), numbers.next()) {
            (Some(processor), Some(elapsed)) => Ok((processor?, elapsed?)),
            _ => Err(String::from_utf8_lossy(&made.stderr).into_owned().into()),
        }
    };
    // What two processors are to one, of which some share a core or are shared with others.
    let library = |threads: usize| -> Result<f64, Failure> {
        let start = Instant::now();
        let runs = in_parallel(RUNS, threads, |_| model.run().map_err(Box::new));
        runs.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(start.elapsed().as_secs_f64())
    };
    let mut times: [Vec<f64>; 8] = Default::default();
    for _ in 0..ROUNDS {
        let start = thread_seconds();
        for _ in 0..RUNS {
            model.run()?;
        }
        times[0].push(thread_seconds() - start);
        let start = process_seconds();
        for _ in 0..RUNS {
            Model::read(CASE)?.run()?;
        }
        times[1].push(process_seconds() - start);
        times[2].push(python("1", "same")?.0);
        let (processor, elapsed) = python("1", "own")?;
        times[3].push(processor);
        times[4].push(elapsed);
        times[5].push(python("2", "own")?.1);
        times[6].push(library(1)?);
        times[7].push(library(2)?);
    }
    let per_run = times.map(|t| 1.0e3 * least(&t) / RUNS as f64);
    let names = [
        "library, one model",
        "library, case and record read for each run",
        "`run_many`, one case a thousand times",
        "`run_many`, a thousand cases",
    ];
    let mut text = String::from("| processor time of | ms a run | ratio |\n|---|---|---|\n");
    for (name, time) in names.iter().zip(per_run) {
        writeln!(text, "| {name} | {time:.3} | {:.3} |", time / per_run[0])?;
    }
    writeln!(
        text,
        "\nTwo threads are {:.2} times as fast as one, those of the library {:.2} times (elapsed time).",
        per_run[4] / per_run[5],
        per_run[6] / per_run[7]
    )?;
    Ok(text)
}
