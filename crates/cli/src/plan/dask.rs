//! A Python script that hands the shards to a Dask cluster.

use serde_json::json;

use super::Plan;

/// The script that runs and merges.
pub fn script(plan: &Plan) -> String {
    // JSON texts and lists are Python's, too.
    let text = |value: &dyn std::fmt::Display| json!(value.to_string()).to_string();
    let again = format!(
        "python THIS_SCRIPT ADDRESS \"$({})\"",
        crate::command_words::shell_line(&plan.unfinished)
    );
    let time = plan
        .time
        .map_or("None".to_owned(), |t| t.ceil().to_string());
    let at_once = match plan.at_once {
        Some(_) => {
            "# Dask runs as many shards as its workers have threads: --at-once has no meaning here.\n"
        }
        None => "",
    };
    format!(
        r#"{head}# ADDRESS is that of a scheduler; without one a cluster of this machine is begun.
{at_once}import os
import subprocess
import sys

FOLDER = {here}
COMMAND = {command}
AT_THE_END = {at_the_end}
RESULTS = {results}
SHARDS = {shards}
TIME = {time}


def run(shard):
    """Runs a shard; asked to end by the time limit, it stores what has finished."""
    with open(os.path.join(FOLDER, RESULTS, "log", f"{{shard}}.txt"), "ab") as log:
        words = [*COMMAND, "--shard", f"{{shard}}/{{SHARDS}}"]
        process = subprocess.Popen(words, cwd=FOLDER, stdout=log, stderr=log)
        try:
            return process.wait(TIME)
        except subprocess.TimeoutExpired:
            process.terminate()
            return process.wait()


def numbers(text):
    for part in filter(None, map(str.strip, text.split(","))):
        first, dash, last = map(str.strip, part.partition("-"))
        last = last if dash else first
        exist = first.isdecimal() and last.isdecimal() and 1 <= int(first) <= int(last) <= SHARDS
        if not exist:
            sys.exit(f"{{part}}: no such shards; there are 1 to {{SHARDS}}, give a list of their numbers such as {example}")
        yield from range(int(first), int(last) + 1)


def main():
    from dask.distributed import Client, LocalCluster

    os.makedirs(os.path.join(FOLDER, RESULTS, "log"), exist_ok=True)
    address = sys.argv[1] if len(sys.argv) > 1 else ""
    wanted = list(numbers(sys.argv[2] if len(sys.argv) > 2 else f"1-{{SHARDS}}"))
    # Named by its shard and never kept: what has failed is run again when it is asked for.
    with Client(address or LocalCluster(threads_per_worker=1)) as client:
        codes = client.gather(client.map(run, wanted, pure=False))
    failed = [shard for shard, code in zip(wanted, codes) if code != 0]
    if failed:
        sys.exit(f"{{len(failed)}} shards did not come to their end: {{failed}}")
    for words in AT_THE_END:
        subprocess.run(words, cwd=FOLDER, check=True)


if __name__ == "__main__":
    main()
"#,
        head = plan.head("for Dask", &again),
        here = text(&plan.here),
        command = json!(plan.command),
        at_the_end = json!(plan.at_the_end),
        results = text(&plan.folder),
        shards = plan.shards,
        example = plan.example(),
    )
}
