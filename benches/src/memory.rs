//! Peak memory of runs, each in a process of its own.

use std::process::Command;

use pounding_time_history::GroundAcceleration;
use verification::{Failure, ReferenceCase};

use crate::methods::sweeping;
use crate::sweep::{Grid, sweep};

/// Peak resident memory of this process (kB), where the system tells it.
fn peak() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|l| l.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// What the child does: so many runs (none for the program itself) of the method with
/// this number; returns the peak (kB) as text.
pub(crate) fn child(
    (case, model): (&ReferenceCase, &str),
    ground: &GroundAcceleration,
    method: &str,
    runs: &str,
) -> Result<String, Failure> {
    let runs: usize = runs.parse()?;
    let methods = sweeping(ground.time_step);
    let (_, choice) = methods.get(method.parse::<usize>()?).ok_or("no method")?;
    if runs > 0 {
        sweep((case, model), ground, *choice, Grid::of(runs), 1)?;
    }
    Ok(peak().ok_or("peak memory is not told here")?.to_string())
}

/// Peak memory (kB) of a child that does so many runs of method number `method`.
pub(crate) fn measure(
    case: &str,
    model: &str,
    method: usize,
    runs: usize,
) -> Result<usize, Failure> {
    let mut command = Command::new(std::env::current_exe()?);
    let numbers = [method.to_string(), runs.to_string()];
    command.args(["memory", case, model, &numbers[0], &numbers[1]]);
    let output = command.output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().parse()?)
}
