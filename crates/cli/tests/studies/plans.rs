//! Plans for clusters: what they print does what it says. No cluster is begun here: Slurm itself
//! is tried by `scripts/slurm`.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

use super::{Bench, MIXED};

fn bash(bench: &Bench, words: &[&str]) -> Output {
    let mut command = Command::new("bash");
    command.args(words).current_dir(bench.folder.path());
    let stubs = bench.path("stubs");
    if stubs.exists() {
        let path = std::env::var("PATH").unwrap();
        command.env("PATH", format!("{}:{path}", stubs.display()));
    }
    command.output().unwrap()
}

fn succeeded(output: &Output) -> String {
    let told = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}{errors}");
    told
}

/// A folder whose names have blanks, and what one process makes there.
fn bench() -> Bench {
    let bench = Bench::new(MIXED);
    std::fs::rename(bench.path("study.toml"), bench.path("my study.toml")).unwrap();
    let mut whole = bench.command("sweep -o whole.h5 --csv whole.csv");
    let done = whole.arg("my study.toml").output().unwrap();
    assert!(done.status.success());
    bench
}

/// Prints a plan of the study with blanks in every name.
fn plan(bench: &Bench, scheduler: &str, more: &str) -> Output {
    bench
        .command(&format!(
            "sweep --plan={scheduler} --shards 7 --keep-going --threads 1 {more}"
        ))
        .args([
            "my study.toml",
            "--into",
            "all results",
            "-o",
            "my result.h5",
        ])
        .args(["--csv", "my table.csv"])
        .output()
        .unwrap()
}

fn script(bench: &Bench, scheduler: &str, more: &str) -> String {
    let script = succeeded(&plan(bench, scheduler, more));
    std::fs::write(bench.path("plan.sh"), &script).unwrap();
    script
}

fn same_as_whole(bench: &Bench) {
    assert!(bench.bytes("my result.h5") == bench.bytes("whole.h5"));
    assert!(bench.bytes("my table.csv") == bench.bytes("whole.csv"));
}

#[test]
fn the_overview_says_how_the_study_is_dealt() {
    let bench = Bench::new(MIXED);
    let output = bench.run("sweep study.toml --plan --shards 40");
    let told = succeeded(&output);
    for part in [
        "60 runs in 15 shards, dealt out in chunks of 4",
        "--shard 1/15",
        "--plan=slurm",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let noted = String::from_utf8(output.stderr).unwrap();
    assert!(noted.contains("15 shards instead of 40"), "{noted}");
    // Nothing is run and nothing is made.
    assert_eq!(std::fs::read_dir(bench.folder.path()).unwrap().count(), 2);
    let json: Value =
        serde_json::from_str(&bench.text("sweep study.toml --plan --shards 9 --json")).unwrap();
    assert_eq!((&json["shards"], &json["runs"]), (&9.into(), &60.into()));
    for key in ["slurm", "hyper_queue", "dask", "shell"] {
        assert!(json[key].as_str().unwrap().contains("my result") || json[key].is_string());
    }
    for (words, why) in [
        ("--plan --time 10s", "no time limit"),
        ("--plan --shard 1/2", "cannot be used with"),
        ("--time 2h", "--plan"),
        ("--plan --time 2h", "--time has no meaning"),
        ("--plan --at-once 3", "--at-once has no meaning"),
        (
            "--plan=shell --array-limit 9",
            "--array-limit has no meaning",
        ),
        (
            "--plan=dask --array-limit 9",
            "--array-limit has no meaning",
        ),
        (
            "--plan=hyper-queue --array-limit 9",
            "--array-limit has no meaning",
        ),
    ] {
        let told = bench.complaint(&format!("sweep study.toml {words}"), 2);
        assert!(told.contains(why), "{words}: {told}");
    }
    // All scripts at once carry all.
    bench.text("sweep study.toml --plan --time 2h --at-once 3 --array-limit 9 --json");
}

#[test]
fn the_script_for_a_shell_runs_merges_and_completes() {
    let bench = bench();
    script(&bench, "shell", "--at-once 2");
    succeeded(&bash(&bench, &["plan.sh"]));
    same_as_whole(&bench);
    // One shard is lost: only it is run again.
    let shards = || {
        let entries = std::fs::read_dir(bench.path("all results")).unwrap();
        let mut files: Vec<_> = entries
            .map(|e| e.unwrap().path())
            .filter(|p| p.is_file())
            .collect();
        files.sort();
        files
    };
    let all = shards();
    assert_eq!(all.len(), 7, "{all:?}");
    let untouched = |path: &Path| path.metadata().unwrap().modified().unwrap();
    let before = untouched(&all[0]);
    std::fs::remove_file(&all[3]).unwrap();
    std::fs::remove_file(bench.path("my result.h5")).unwrap();
    let unfinished = bench
        .command("status --unfinished")
        .arg("all results")
        .output()
        .unwrap();
    let unfinished = succeeded(&unfinished);
    assert_eq!(unfinished, "4\n");
    succeeded(&bash(&bench, &["plan.sh", unfinished.trim()]));
    same_as_whole(&bench);
    assert_eq!(untouched(&all[0]), before);
    let log = std::fs::read_to_string(bench.path("all results/log/4.txt")).unwrap();
    assert_eq!(log.matches("none failed").count(), 2, "{log}");
}

/// `sbatch`, as far as the plan uses it: it writes down its options, and runs the script of each
/// task at once, or the merge.
const SBATCH: &str = r#"#!/bin/bash
printf '%s\n' "$@" >> sbatch.options
script=$(mktemp); cat > "$script"
tasks=$(printf '%s\n' "$@" | sed -n 's/^--array=\([^%]*\).*/\1/p')
if [ -z "$tasks" ]; then bash "$script" >> merge.log || exit 1; echo 2; exit; fi
for task in ${tasks//,/ }; do SLURM_ARRAY_TASK_ID=$task bash "$script" >> tasks.log 2>&1 || exit 1; done
echo 1
"#;

/// Seven shards in three tasks, as more do not fit into an array: said, and nothing is left out.
#[cfg(unix)]
#[test]
fn the_script_for_slurm_regroups_shards_and_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let bench = bench();
    std::fs::create_dir(bench.path("stubs")).unwrap();
    let stub = bench.path("stubs/sbatch");
    std::fs::write(&stub, SBATCH).unwrap();
    std::fs::set_permissions(&stub, std::fs::Permissions::from_mode(0o755)).unwrap();
    let options = "--array-limit 4 --at-once 2 --time 90min";
    let output = plan(&bench, "slurm", options);
    let noted = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(
        noted.contains("7 shards in 3 tasks of 3 or fewer"),
        "{noted}"
    );
    let text = script(&bench, "slurm", options);
    assert!(
        text.contains("# Note: for Slurm, 7 shards in 3 tasks"),
        "{text}"
    );
    let told = succeeded(&bash(&bench, &["plan.sh"]));
    assert!(told.contains("array 1, merge 2"), "{told}");
    same_as_whole(&bench);
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    let given: Vec<&str> = given.lines().collect();
    for option in [
        "--array=1,2,3%2",
        "--time=0-01:30:00",
        "--signal=B:USR1@60",
        "--cpus-per-task=1",
        "--requeue",
        "--output=all results/log/%a.txt",
        "--dependency=afterok:1",
    ] {
        assert!(given.contains(&option), "{option}: {given:?}");
    }
    let log = std::fs::read_to_string(bench.path("tasks.log")).unwrap();
    assert_eq!(log.matches("none failed").count(), 7, "{log}");
    // Shards 2, 5 and 7 are of the tasks 2 and 1.
    std::fs::remove_file(bench.path("sbatch.options")).unwrap();
    succeeded(&bash(&bench, &["plan.sh", "2,5,7"]));
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    assert!(given.lines().any(|o| o == "--array=1,2%2"), "{given}");
    // Nothing is missing: the merge alone, which waits for nothing.
    std::fs::remove_file(bench.path("sbatch.options")).unwrap();
    succeeded(&bash(&bench, &["plan.sh", ""]));
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    assert!(
        !given.contains("--array") && !given.contains("--dependency"),
        "{given}"
    );
}

/// Numbers of shards that do not exist end every script before anything is submitted or merged.
#[cfg(unix)]
#[test]
fn shards_that_do_not_exist_are_refused() {
    use std::os::unix::fs::PermissionsExt;
    let bench = bench();
    std::fs::create_dir(bench.path("stubs")).unwrap();
    for (name, text) in [("sbatch", SBATCH), ("hq", HQ)] {
        let stub = bench.path(&format!("stubs/{name}"));
        std::fs::write(&stub, text).unwrap();
        std::fs::set_permissions(&stub, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    for scheduler in ["slurm", "hyper-queue", "shell"] {
        script(&bench, scheduler, "");
        for list in [
            "8",
            "100",
            "0",
            "5-3",
            "1,9",
            "2-8",
            "-1",
            "1-",
            "one",
            "1-2-3",
            "*",
            "2;4",
            "1,0-3",
            "99999999999999999999",
            "-n",
        ] {
            let output = bash(&bench, &["plan.sh", list]);
            let told = String::from_utf8_lossy(&output.stderr).into_owned();
            assert_eq!(output.status.code(), Some(1), "{scheduler}, {list}: {told}");
            let range = list.rsplit(',').next().unwrap();
            let said = format!(
                "{range}: no such shards; there are 1 to 7, give a list of their numbers such as 1,6-7\n"
            );
            assert_eq!(told, said, "{scheduler}, {list}");
            for made in ["sbatch.options", "hq.options", "my result.h5"] {
                assert!(!bench.path(made).exists(), "{scheduler}, {list}: {made}");
            }
        }
    }
    script(&bench, "slurm", "");
    // The merge, which lacks the others, is submitted behind them.
    bash(&bench, &["plan.sh", "1,6-7"]);
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    assert!(given.lines().any(|o| o == "--array=1,6,7"), "{given}");
    std::fs::remove_file(bench.path("sbatch.options")).unwrap();
    bash(&bench, &["plan.sh", "05-06"]);
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    assert!(given.lines().any(|o| o == "--array=5,6"), "{given}");
}

/// Names that begin as options do, and that Slurm and shells would replace.
#[cfg(unix)]
#[test]
fn names_are_taken_as_they_are() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o whole.h5 --csv whole.csv");
    std::fs::rename(
        bench.path("study.toml"),
        bench.path("-50% $(touch no) \"'.toml"),
    )
    .unwrap();
    std::fs::create_dir(bench.path("stubs")).unwrap();
    for (name, text) in [("sbatch", SBATCH), ("hq", HQ)] {
        let stub = bench.path("stubs").join(name);
        std::fs::write(&stub, text).unwrap();
        std::fs::set_permissions(&stub, std::fs::Permissions::from_mode(0o755)).unwrap();
    }
    for scheduler in ["shell", "slurm", "hyper-queue"] {
        let output = bench
            .command(&format!("sweep --plan={scheduler} --shards 3 --csv=-t.csv"))
            .arg("./-50% $(touch no) \"'.toml")
            .output()
            .unwrap();
        std::fs::write(bench.path("plan.sh"), succeeded(&output)).unwrap();
        let told = succeeded(&bash(&bench, &["plan.sh"]));
        assert!(!bench.path("no").exists(), "{told}");
        let result = "-50% $(touch no) \"'.h5";
        assert!(
            bench.bytes(result) == bench.bytes("whole.h5"),
            "{scheduler}"
        );
        assert!(
            bench.bytes("-t.csv") == bench.bytes("whole.csv"),
            "{scheduler}"
        );
        std::fs::remove_file(bench.path(result)).unwrap();
        std::fs::remove_dir_all(bench.path("-50% $(touch no) \"'.shards")).unwrap();
    }
    let given = std::fs::read_to_string(bench.path("sbatch.options")).unwrap();
    let log = "--output=./-50%% $(touch no) \"'.shards/log/%a.txt";
    assert!(given.lines().any(|o| o == log), "{given}");
}

/// `hq`, as far as the plan uses it.
const HQ: &str = r#"#!/bin/bash
printf '%s\n' "$@" > hq.options
list=; while [ "$1" != -- ]; do [ "$1" = --array ] && list=$2; shift; done; shift
for range in ${list//,/ }; do for task in $(seq "${range%-*}" "${range#*-}"); do HQ_TASK_ID=$task "$@" || exit 1; done; done
"#;

#[cfg(unix)]
#[test]
fn the_script_for_hyper_queue_runs_and_merges() {
    use std::os::unix::fs::PermissionsExt;
    let bench = bench();
    std::fs::create_dir(bench.path("stubs")).unwrap();
    let stub = bench.path("stubs/hq");
    std::fs::write(&stub, HQ).unwrap();
    std::fs::set_permissions(&stub, std::fs::Permissions::from_mode(0o755)).unwrap();
    script(&bench, "hyper-queue", "--time 1d");
    succeeded(&bash(&bench, &["plan.sh"]));
    same_as_whole(&bench);
    let given = std::fs::read_to_string(bench.path("hq.options")).unwrap();
    for part in [
        "--wait",
        "1-7",
        "86400s",
        "all results/log/%{TASK_ID}.out.txt",
    ] {
        assert!(given.lines().any(|o| o == part), "{part}: {given}");
    }
}

/// The script for Dask with a cluster that runs every shard at once, here.
#[test]
fn the_script_for_dask_runs_and_merges() {
    let python = std::env::var("POUNDING_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let found = Command::new(&python).arg("--version").output();
    if !found.is_ok_and(|o| o.status.success()) {
        return;
    }
    let bench = bench();
    std::fs::create_dir(bench.path("dask")).unwrap();
    std::fs::write(bench.path("dask/__init__.py"), "").unwrap();
    let stub = "class LocalCluster:\n    def __init__(self, **options): pass\nclass Client:\n    def __init__(self, address): pass\n    def __enter__(self): return self\n    def __exit__(self, *_): pass\n    def map(self, function, values, pure): return [function(v) for v in values]\n    def gather(self, values): return values\n";
    std::fs::write(bench.path("dask/distributed.py"), stub).unwrap();
    script(&bench, "dask", "--time 1h");
    let call = |words: &[&str]| {
        let mut command = Command::new(&python);
        command.arg("plan.sh").args(words);
        command.current_dir(bench.folder.path());
        command.env("PYTHONPATH", bench.folder.path());
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        command.output().unwrap()
    };
    for list in ["8", "0", "5-3", "1,9", "-1", "one"] {
        let output = call(&["", list]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(1), "{list}: {told}");
        let said = "no such shards; there are 1 to 7, give a list of their numbers such as 1,6-7\n";
        assert!(told.ends_with(said), "{list}: {told}");
        assert!(!bench.path("my result.h5").exists(), "{list}");
    }
    succeeded(&call(&[]));
    same_as_whole(&bench);
}

/// Few runs make one chunk, and so one shard, however many are asked for: it has the name of a shard,
/// is merged, and is done for `status`.
#[test]
fn a_plan_of_one_shard_merges_it() {
    let bench = Bench::new(&MIXED.replace("chunk = 4", "chunk = 64"));
    bench.text("sweep study.toml -o whole.h5");
    let output = bench.run("sweep study.toml --plan=shell --shards 8 --into all -o out.h5");
    let noted = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(noted.contains("1 shard instead of 8"), "{noted}");
    std::fs::write(bench.path("plan.sh"), succeeded(&output)).unwrap();
    succeeded(&bash(&bench, &["plan.sh"]));
    assert!(bench.bytes("out.h5") == bench.bytes("whole.h5"));
    let told = bench.text("status all");
    assert!(told.contains("1 of 1 shard done"), "{told}");
    assert_eq!(bench.run("status all --unfinished").stdout, b"\n");
}

/// The same of an incremental dynamic analysis, which is evaluated at the end.
#[test]
fn a_plan_of_one_shard_is_evaluated_at_the_end() {
    let bench = Bench::new(FRAGILITY);
    bench.text("ida study.toml -o whole.h5 --table whole.csv");
    let plan = "ida study.toml --plan=shell --shards 8 --into all -o out.h5 --table out.csv";
    std::fs::write(bench.path("plan.sh"), succeeded(&bench.run(plan))).unwrap();
    let told = succeeded(&bash(&bench, &["plan.sh"]));
    assert!(bench.bytes("out.h5") == bench.bytes("whole.h5"));
    assert!(bench.bytes("out.csv") == bench.bytes("whole.csv"));
    let folder = bench.folder.path().canonicalize().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    assert!(bench.path(&format!("all/{name}.shard-1-of-1.h5")).is_file());
    // The shard is a part of the runs, and the answer that of the merged ones.
    let log = std::fs::read_to_string(bench.path("all/log/1.txt")).unwrap();
    assert!(log.contains("When all shards are done"), "{log}");
    assert!(told.contains("Pounding of light-heavy by width"), "{told}");
}

/// Two records at four intensities.
const FRAGILITY: &str = r#"
case = "case.toml"

[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", "MOTIONS/kobe_1995_jma_ns.csv"]

[[variable]]
intensity = "peak_ground_acceleration"
values = ["0.05 g", "0.2 g", "0.4 g", "0.8 g"]

[ida]
gaps = ["20 mm"]
"#;

/// That a result has no place is said by the plan, not after its runs.
#[test]
fn a_plan_whose_result_has_no_place_is_refused() {
    let bench = Bench::new(MIXED);
    std::fs::write(bench.path("file"), "x").unwrap();
    for (outputs, code, why) in [
        ("-o case.toml", 2, "case.toml"),
        ("-o a.shard-1-of-3.h5", 2, "has the name of a shard"),
        ("-o none/x.h5", 4, "none"),
        ("-o x.h5 --csv none/x.csv", 4, "none"),
        ("-o x.h5 --into file", 2, "--into file is no folder"),
        ("-o x.h5 --into file/deeper", 2, "is no folder"),
        ("-o x.h5 --report none/x.html", 4, "none"),
    ] {
        for planned in ["", "=shell", "=slurm"] {
            let told =
                bench.complaint(&format!("sweep study.toml --plan{planned} {outputs}"), code);
            assert!(told.contains(why), "{outputs}: {told}");
        }
    }
    std::fs::copy(bench.path("study.toml"), bench.path("own.h5")).unwrap();
    bench.complaint("sweep own.h5 --plan", 2);
    bench.text("sweep study.toml --plan -o x.h5");
}
