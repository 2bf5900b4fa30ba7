//! An array of tasks for Slurm, and a job that merges.

use super::Plan;
use crate::command_words::{quoted, shell_line};

/// Exit code of a task that is to go on where it is: see `commands.md`.
const RESUME: u8 = crate::exit_code::INTERRUPTED;
/// Time before the limit at which a task stores what has finished (s).
const BEFORE_LIMIT: u32 = 60;
/// How often a task that reaches its time limit is put back into the queue.
const MOST_RESTARTS: u32 = 100;

/// The script that submits both.
pub fn script(plan: &Plan) -> String {
    let (shards, tasks) = (plan.shards, plan.tasks);
    let again = format!("bash THIS_SCRIPT \"$({})\"", shell_line(&plan.unfinished));
    let mut text = format!(
        "#!/bin/bash\n{}# Partition, account and the like: SBATCH_PARTITION, SBATCH_ACCOUNT, ... in the environment.\n",
        plan.head("for Slurm", &again)
    );
    text.push_str(&plan.begin());
    text.push_str(&plan.list_of_shards());
    // Of each task once, however many of its shards are in the list.
    text.push_str(&format!(
        "tasks=$(for shard in $shards; do echo $(( (shard - 1) % {tasks} + 1 )); done | sort -nu | paste -sd, -)\n"
    ));
    let at_once = plan.at_once.map_or_else(String::new, |n| format!("%{n}"));
    // A % in the name of a file begins what Slurm replaces, two of them are one.
    let folder = plan.folder.replace('%', "%%");
    let log = |name: &str| quoted(&format!("{folder}/log/{name}.txt"));
    let mut options = vec![
        "--parsable".to_owned(),
        format!("--array=\"$tasks{at_once}\""),
        format!("--job-name={}", quoted(&plan.name)),
        "--nodes=1".to_owned(),
        "--ntasks=1".to_owned(),
        format!("--cpus-per-task={}", plan.threads),
        "--requeue".to_owned(),
        "--open-mode=append".to_owned(),
        format!("--output={}", log("%a")),
    ];
    if let Some(seconds) = plan.time {
        options.push(format!("--time={}", clock(seconds)));
        options.push(format!("--signal=B:USR1@{BEFORE_LIMIT}"));
    }
    let task = task(plan);
    let end = end_of_document("ARRAY", &task);
    text.push_str(&format!(
        "after=\nif [ -n \"$tasks\" ]; then\narray=$(sbatch {} <<'{end}'\n{task}{end}\n)\nafter=--dependency=afterok:$array\nfi\n",
        options.join(" \\\n  ")
    ));
    let merge = [
        "--parsable".to_owned(),
        "$after".to_owned(),
        "--kill-on-invalid-dep=yes".to_owned(),
        format!("--job-name={}", quoted(&format!("{}-merge", plan.name))),
        "--nodes=1".to_owned(),
        "--ntasks=1".to_owned(),
        format!("--output={}", log("merge")),
    ];
    let last = plan.last_lines();
    let end = end_of_document("MERGE", &last);
    text.push_str(&format!(
        "merge=$(sbatch {} <<'{end}'\n#!/bin/bash\nset -e\n{last}\n{end}\n)\necho \"array ${{array:-none}}, merge $merge; {shards} shards: see \"{}\n",
        merge.join(" \\\n  "),
        quoted(&shell_line(&plan.unfinished[..plan.unfinished.len() - 1]))
    ));
    text
}

/// The line at which a document within a script ends: none of its own, which a name of several lines may have.
fn end_of_document(word: &str, document: &str) -> String {
    let mut end = word.to_owned();
    while document.lines().any(|line| line == end) {
        end.push('_');
    }
    end
}

/// What a task of the array does. A signal before the time limit goes to this shell alone, which
/// has the shard store what has finished, and goes back into the queue; a task that is cancelled
/// does not.
fn task(plan: &Plan) -> String {
    let (shards, tasks) = (plan.shards, plan.tasks);
    let shard = plan.of_shard(&format!("\"$shard/{shards}\""));
    format!(
        r#"#!/bin/bash
code=0 limit=0 child=
trap 'limit=1; kill -TERM "$child" 2>/dev/null' USR1
trap 'kill -TERM "$child" 2>/dev/null' TERM INT
for shard in $(seq "$SLURM_ARRAY_TASK_ID" {tasks} {shards}); do
  {shard} &
  child=$!
  wait "$child"
  ended=$?
  # A signal ends the first wait, before the shard has stored what has finished.
  while kill -0 "$child" 2>/dev/null; do wait "$child"; ended=$?; done
  if [ "$ended" -ne 0 ]; then code=$ended; fi
  if [ "$ended" -eq {RESUME} ]; then break; fi
done
if [ "$limit" -eq 1 ] && [ "$code" -eq {RESUME} ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt {MOST_RESTARTS} ]; then
  scontrol requeue "${{SLURM_ARRAY_JOB_ID}}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
"#
    )
}

/// A time as Slurm reads it, days-hours:minutes:seconds.
fn clock(seconds: f64) -> String {
    let seconds = seconds.ceil() as u64;
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    format!(
        "{days}-{:02}:{:02}:{:02}",
        rest / 3600,
        rest / 60 % 60,
        rest % 60
    )
}

#[cfg(test)]
mod tests {
    use super::{clock, end_of_document};

    /// A document in a script ends at its own end, whatever names stand in it.
    #[test]
    fn no_line_of_a_document_ends_it() {
        assert_eq!(end_of_document("MERGE", "a\nb"), "MERGE");
        assert_eq!(
            end_of_document("MERGE", "a -o 'o\nMERGE\n)\nMERGE_\n.h5'"),
            "MERGE__"
        );
    }

    /// The forms of `sbatch --time`.
    #[test]
    fn times_are_written_as_slurm_reads_them() {
        assert_eq!(clock(90.0), "0-00:01:30");
        assert_eq!(clock(7200.0), "0-02:00:00");
        assert_eq!(clock(2.5 * 86_400.0 + 0.2), "2-12:00:01");
    }
}
