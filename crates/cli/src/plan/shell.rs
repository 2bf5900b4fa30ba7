//! All shards on one machine, by a shell and xargs.

use super::Plan;
use crate::command_words::{quoted, shell_line};

/// The script that runs and merges.
pub fn script(plan: &Plan) -> String {
    let again = format!("bash THIS_SCRIPT \"$({})\"", shell_line(&plan.unfinished));
    let at_once = match plan.at_once {
        Some(n) => n.to_string(),
        // At least one, however few cores there are.
        None => format!(
            "$(( ($(getconf _NPROCESSORS_ONLN) + {0} - 1) / {0} ))",
            plan.threads
        ),
    };
    let limit = plan.time.map_or_else(String::new, |seconds| {
        // Asked to end, a shard stores what has finished.
        format!("timeout --kill-after=60 {} ", seconds.ceil())
    });
    let log = quoted(&format!("{}/log", plan.folder));
    let shards = plan.shards;
    format!(
        "#!/bin/bash\n{}{}{}# With GNU parallel: the same with `parallel -j` in the place of `xargs -P`.\necho \"$shards\" | xargs -r -n 1 -P {at_once} bash -c {} || {{ code=$?; echo \"some shards did not come to their end: see \"{log}\", and \"{} >&2; exit \"$code\"; }}\n{}\n",
        plan.head("on one machine", &again),
        plan.begin(),
        plan.list_of_shards(),
        quoted(&format!(
            "{limit}{} >> {log}/\"$0\".txt 2>&1",
            plan.of_shard(&format!("\"$0/{shards}\""))
        )),
        quoted(&shell_line(&plan.unfinished[..plan.unfinished.len() - 1])),
        plan.last_lines()
    )
}
