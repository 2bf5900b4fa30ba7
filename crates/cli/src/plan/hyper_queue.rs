//! An array of tasks for HyperQueue.

use super::Plan;
use crate::command_words::{quoted, shell_line};

/// The script that submits, waits and merges.
pub fn script(plan: &Plan) -> String {
    let again = format!("bash THIS_SCRIPT \"$({})\"", shell_line(&plan.unfinished));
    let mut options = vec![
        "--wait".to_owned(),
        "--array \"$list\"".to_owned(),
        format!("--name={}", quoted(&plan.name)),
        format!("--cpus {}", plan.threads),
    ];
    if let Some(seconds) = plan.time {
        options.push(format!("--time-limit {}s", seconds.ceil()));
    }
    let log = |kind: &str| quoted(&format!("{}/log/%{{TASK_ID}}.{kind}.txt", plan.folder));
    options.push(format!("--stdout {}", log("out")));
    options.push(format!("--stderr {}", log("err")));
    let shard = plan.of_shard(&format!("\"$HQ_TASK_ID/{}\"", plan.shards));
    let at_once = match plan.at_once {
        Some(_) => {
            "# HyperQueue runs as many tasks as its workers have processors for: --at-once has no meaning here.\n"
        }
        None => "",
    };
    format!(
        "#!/bin/bash\n{}{at_once}{}{}if [ -n \"$list\" ]; then\nhq submit {} \\\n  -- bash -c {}\nfi\n{}\n",
        plan.head("for HyperQueue", &again),
        plan.begin(),
        plan.list(),
        options.join(" \\\n  "),
        quoted(&shard),
        plan.last_lines()
    )
}
