//! What a study would run, and how to hand it to a cluster.

use pounding_catalogue::wording::counted;
use pounding_study::{Study, Value};
use serde::Serialize;

use crate::arguments::SweepArguments;
use crate::failure::Failure;
use crate::interruption::quoted;
use crate::output::{pretty, print};

/// What `sweep --plan --json` prints.
#[derive(Serialize)]
struct Plan {
    runs: usize,
    chunk: usize,
    shards: usize,
    hyper_queue: String,
    slurm: String,
}

/// Prints the number of runs, and lines for HyperQueue and Slurm.
pub fn plan(study: &Study, arguments: &SweepArguments) -> Result<(), Failure> {
    let runs = study.runs();
    // More shards than chunks would leave some empty.
    let shards = (arguments.shards as usize).min(runs.div_ceil(study.chunk));
    let file = quoted(&arguments.study.display().to_string());
    let shard = |task: &str| format!("pounding sweep {file} --shard \"{task}/{shards}\" --resume");
    let hyper_queue = format!(
        "hq submit --array 1-{shards} --cpus 1 -- bash -c {}",
        quoted(&format!("{} --threads 1", shard("$HQ_TASK_ID")))
    );
    let slurm = format!(
        "#!/bin/bash\n#SBATCH --job-name=pounding\n#SBATCH --array=1-{shards}\n#SBATCH --cpus-per-task=1\n{} --threads \"$SLURM_CPUS_PER_TASK\"\n",
        shard("$SLURM_ARRAY_TASK_ID")
    );
    if arguments.json {
        return print(&pretty(&Plan {
            runs,
            chunk: study.chunk,
            shards,
            hyper_queue,
            slurm,
        })?);
    }
    let mut text = String::new();
    for (i, variable) in study.variables.iter().enumerate() {
        let shown = |run: usize| match study.point(run)[i] {
            Value::Number(x) => format!("{x} {}", variable.unit),
            Value::Choice(c) => study.label(i, c).to_owned(),
        };
        text.push_str(&format!(
            "{}: {} ... {}\n",
            variable.name,
            shown(0).trim_end(),
            shown(runs - 1).trim_end()
        ));
    }
    text.push_str(&format!(
        "{}, stored {} at a time\n\nHyperQueue:\n{hyper_queue}\n\nSlurm (a failed task may be submitted again: it goes on where it was):\n{slurm}\nThen: pounding merge *.shard-*-of-{shards}.h5 -o OUT.h5\n",
        counted(runs, "run"),
        study.chunk
    ));
    print(&text)
}
