//! How far the shards of a study are.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use super::{Bench, MIXED};

/// Of four shards one is done, one was lost with its machine, one has failed, one has not begun:
/// all are named, and the commands that are shown complete them.
#[test]
fn what_is_missing_is_named_and_goes_on() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/4 --into all --keep-going");
    let folder = bench.folder.path().canonicalize().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let of = |index: usize| format!("all/status/{name}.shard-{index}-of-4.json");
    let beat: Value = serde_json::from_slice(&bench.bytes(&of(1))).unwrap();
    assert_eq!(
        (&beat["state"], &beat["runs"], &beat["finished"]),
        (&json!("done"), &json!(16), &json!(16))
    );
    let told_by = |index: usize, changed: Value| {
        let mut beat = beat.clone();
        for (key, value) in changed.as_object().unwrap() {
            beat[key] = value.clone();
        }
        std::fs::write(bench.path(&of(index)), beat.to_string()).unwrap();
    };
    // No process has this number.
    told_by(
        2,
        json!({"state": "running", "finished": 7, "stored": 6, "process": 999_999_999}),
    );
    told_by(
        3,
        json!({"state": "failed", "finished": 0, "message": "no room on the disk"}),
    );
    let output = bench.run("status all");
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8(output.stdout).unwrap();
    for part in [
        "1 of 4 shards done in all",
        "shard 2 ended before its end: 7 of 16 runs, 6 stored when it last told of itself; without a word",
        "shard 3 ended before its end: 0 of 16 runs; no room on the disk",
        "not begun: 4",
        "--shard 2/4 --into all --keep-going --resume",
        "2-4",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    // Another machine that told of itself just now computes.
    let soon = beat["updated"].as_u64().unwrap() + 3600;
    told_by(
        2,
        json!({"state": "running", "host": "another", "updated": soon, "rate": 2.0, "finished": 7}),
    );
    assert_eq!(bench.run("status all --unfinished").stdout, b"3-4\n");
    // Nor is it taken for one that has ended where its clock is behind.
    told_by(
        2,
        json!({"state": "running", "host": "another", "updated": soon - 7200}),
    );
    assert_eq!(bench.run("status all --unfinished").stdout, b"3-4\n");
    // One that has been silent does not compute, whatever its clock or that of the file system says; one that
    // tells of itself does.
    let now = soon - 3600;
    let second = std::time::Duration::from_secs(1);
    let ago = |seconds: u32| std::time::SystemTime::now() - seconds * second;
    for (updated, written, unfinished) in [
        (soon, ago(600), "2-4\n"),
        (1_000_000, ago(600), "2-4\n"),
        (
            now - 1800,
            std::time::SystemTime::now() + 3600 * second,
            "2-4\n",
        ),
        (now, ago(300), "3-4\n"),
    ] {
        told_by(
            2,
            json!({"state": "running", "host": "another", "updated": updated}),
        );
        let file = std::fs::File::options();
        let file = file.clone().append(true).open(bench.path(&of(2))).unwrap();
        file.set_modified(written).unwrap();
        let told = bench.run("status all --unfinished").stdout;
        assert_eq!(String::from_utf8(told).unwrap(), unfinished, "{updated}");
    }
    told_by(
        2,
        json!({"state": "running", "host": "another", "updated": 1_000_000}),
    );
    let file = std::fs::File::options();
    let file = file.clone().append(true).open(bench.path(&of(2))).unwrap();
    file.set_modified(ago(600)).unwrap();
    let output = bench.run("status all --json");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let study = &json["studies"][0];
    assert_eq!(
        (&study["done"], &study["missing"]),
        (&json!([1]), &json!([4]))
    );
    assert_eq!(study["ended"].as_array().unwrap().len(), 2);
    for line in study["commands"].as_array().unwrap() {
        let done = Command::new("sh")
            .args(["-c", line.as_str().unwrap()])
            .current_dir(bench.folder.path())
            .output()
            .unwrap();
        assert!(done.status.success(), "{line}: {done:?}");
    }
    let told = bench.text("status all --watch");
    assert!(told.contains("4 of 4 shards done"), "{told}");
    // The command of the plan, with the name that one call gives the result of a `study.toml`.
    let merged = told.split_once("merge them with\n  ").unwrap().1.trim_end();
    assert!(
        merged.ends_with(&format!("merge all -o {name}.study.h5")),
        "{told}"
    );
    let plan = bench.text("sweep study.toml --plan --into all");
    assert!(plan.lines().any(|line| line == merged), "{plan}\n{told}");
    assert_eq!(bench.run("status all --unfinished").stdout, b"\n");
    bench.text("merge all -o merged.h5");
    bench.text("sweep study.toml -o whole.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
}

#[test]
fn a_folder_without_shards_is_refused() {
    let bench = Bench::new(MIXED);
    for (folder, why) in [(".", "holds no shards"), ("nowhere", "No such file")] {
        let told = bench.complaint(&format!("status {folder}"), 2);
        assert!(told.contains(why), "{told}");
    }
}

/// A signal in a folder of shards leaves word of it.
#[cfg(unix)]
#[test]
fn an_interrupted_shard_says_so() {
    let bench = Bench::new(&MIXED.replace("runs = 60", "runs = 6000"));
    let mut child = bench
        .command("sweep study.toml --shard 2/2 --into all --store-every 10ms --threads 1")
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let parts = || {
        let entries = std::fs::read_dir(bench.path("all")).into_iter().flatten();
        let folders = entries.filter_map(|e| std::fs::read_dir(e.unwrap().path()).ok());
        let mut files = folders.flatten().map(|f| f.unwrap().path());
        files.any(|f| f.extension().is_some_and(|e| e == "runs"))
    };
    while !parts() && child.try_wait().unwrap().is_none() {
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-TERM", &id])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(child.wait().unwrap().code(), Some(5));
    let output = bench.run("status all");
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains("shard 2 ended before its end: "), "{told}");
    assert!(told.contains("stored; interrupted"), "{told}");
    assert!(told.contains("not begun: 1"), "{told}");
}

/// A second process of a shard is refused, and says nothing of it: what the one says that is at work
/// stays.
#[cfg(unix)]
#[test]
fn a_refused_process_leaves_what_the_running_one_says() {
    let bench = Bench::new(&MIXED.replace("runs = 60", "runs = 6000"));
    let shard = "sweep study.toml --shard 1/2 --into all --threads 1";
    let mut child = bench
        .command(shard)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    let running = || {
        let told = bench.run("status all --json").stdout;
        let json: Value = serde_json::from_slice(&told).unwrap_or_default();
        json["studies"][0]["running"][0]["how"].to_string()
    };
    let process = format!("(process {} on ", child.id());
    while !running().contains(&process) {
        assert!(child.try_wait().unwrap().is_none());
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let told = bench.complaint(shard, 2);
    assert!(told.contains("another process is working"), "{told}");
    assert!(running().contains(&process), "{}", running());
    // Nor does one that fails before it looks who is at work.
    let study = String::from_utf8(bench.bytes("study.toml")).unwrap();
    bench.study(&study.replace("kobe_1995_jma_ns.csv", "nowhere.csv"));
    assert_eq!(bench.run(shard).status.code(), Some(2));
    assert!(running().contains(&process), "{}", running());
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(bench.run("status all --unfinished").stdout, b"1-2\n");
}

/// A result that was cut off, or of which the last call said that it does not fit, is not done: the
/// list of what is unfinished has it.
#[test]
fn what_cannot_be_merged_is_not_done() {
    let bench = Bench::new(MIXED);
    for shard in ["1/2", "2/2"] {
        bench.text(&format!(
            "sweep study.toml --shard {shard} --into all --keep-going"
        ));
    }
    assert_eq!(bench.run("status all").status.code(), Some(0));
    let folder = bench.folder.path().canonicalize().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let result = format!("all/{name}.shard-1-of-2.h5");
    let whole = bench.bytes(&result);
    for length in [0, 5000] {
        std::fs::write(bench.path(&result), &whole[..length]).unwrap();
        let output = bench.run("status all --json");
        assert_eq!(output.status.code(), Some(1), "{length}");
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        let study = &json["studies"][0];
        assert_eq!(study["done"], json!([2]));
        // Runs of what is lost are not counted.
        let one = study["ended"][0]["runs"].as_u64().unwrap();
        assert!(study["finished"].as_u64().unwrap() <= one, "{study}");
        assert_eq!(bench.run("status all --unfinished").stdout, b"1\n");
    }
    std::fs::write(bench.path(&result), &whole).unwrap();
    // Another study of the same name finds its places taken, and says so.
    let study = String::from_utf8(bench.bytes("study.toml")).unwrap();
    std::fs::write(bench.path("study.toml"), study.replace("60 mm", "70 mm")).unwrap();
    let before = bench.bytes(&result);
    let refused = bench.run("sweep study.toml --shard 1/2 --into all --keep-going");
    assert_eq!(refused.status.code(), Some(2));
    assert_eq!(bench.bytes(&result), before);
    // What stands there is done all the same, be it told of or not.
    assert!(bench.text("status all").contains("2 of 2 shards done"));
    std::fs::remove_dir_all(bench.path("all/status")).unwrap();
    let refused = bench.run("sweep study.toml --shard 1/2 --into all --keep-going");
    assert_eq!(refused.status.code(), Some(2));
    assert!(bench.text("status all").contains("2 of 2 shards done"));
}

/// What a damaged status file says is not counted, and it is named; runs of finished shards are counted
/// where they stand.
#[test]
fn damaged_status_files_are_named() {
    let bench = Bench::new(MIXED);
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml --shard {shard}/2 --into all"));
    }
    let whole = bench.text("status all");
    assert!(whole.contains("60 runs finished\n"), "{whole}");
    let name = bench.folder.path().canonicalize().unwrap();
    let name = name.file_name().unwrap().to_str().unwrap().to_owned();
    let file = format!("all/status/{name}.shard-1-of-2.json");
    let beat: Value = serde_json::from_slice(&bench.bytes(&file)).unwrap();
    let with = |changes: &[(&str, Value)]| {
        let mut beat = beat.clone();
        for (key, value) in changes {
            beat[*key] = value.clone();
        }
        std::fs::write(bench.path(&file), beat.to_string()).unwrap();
    };
    let most = json!(u64::MAX);
    for changes in [
        &[("finished", most.clone())][..],
        &[("runs", most.clone()), ("finished", most)],
        &[("finished", json!(7)), ("failed", json!(400))],
        &[("failed", json!(99_999))],
        &[("rate", json!(-1.0))],
    ] {
        with(changes);
        let told = bench.text("status all");
        let named = format!("{file} is a damaged status file");
        assert!(told.contains(&named), "{told}");
        assert!(told.contains("60 runs finished\n"), "{told}");
        let json: Value = serde_json::from_str(&bench.text("status all --json")).unwrap();
        assert_eq!(json["studies"][0]["finished"], 60);
        assert_eq!(json["studies"][0]["damaged_status_files"], json!([file]));
    }
    // Numbers that can be, of other runs than stand there.
    with(&[("finished", json!(20)), ("failed", json!(20))]);
    assert_eq!(bench.text("status all"), whole);
}

/// A shard is what its content says: a copy of another one is not done, and neither is one that was changed
/// anywhere.
#[test]
fn a_shard_is_what_stands_in_it() {
    let bench = Bench::new(MIXED);
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml --shard {shard}/2 --into all"));
    }
    let name = bench.folder.path().canonicalize().unwrap();
    let name = name.file_name().unwrap().to_str().unwrap().to_owned();
    let [first, second] = [1, 2].map(|shard| format!("all/{name}.shard-{shard}-of-2.h5"));
    let whole = bench.bytes(&first);
    let told = || {
        let output = bench.run("status all");
        assert_eq!(output.status.code(), Some(1));
        let told = String::from_utf8(output.stdout).unwrap();
        assert!(told.contains("1 of 2 shards done"), "{told}");
        told
    };
    std::fs::copy(bench.path(&second), bench.path(&first)).unwrap();
    let copied = told();
    assert!(
        copied.contains("the file of its result holds shard 2/2"),
        "{copied}"
    );
    assert!(copied.contains("28 runs finished"), "{copied}");
    let mut damaged = whole.clone();
    damaged[whole.len() / 2] ^= 1;
    std::fs::write(bench.path(&first), damaged).unwrap();
    let damaged = told();
    assert!(
        damaged.contains("its result is gone or damaged"),
        "{damaged}"
    );
    goes_on_as_told(&bench);
}

/// A call that is refused since a record has changed leaves the finished shard, and what was told of
/// it: no list of unfinished shards has it for ever.
#[test]
fn a_refused_call_leaves_a_shard_done() {
    let bench = Bench::new(&MIXED.replace("MOTIONS/el_centro_1940_ns.csv", "own.csv"));
    let record = super::root().join("ground_motions/el_centro_1940_ns.csv");
    let mut text = std::fs::read_to_string(record).unwrap();
    std::fs::write(bench.path("own.csv"), &text).unwrap();
    for shard in 1..=3 {
        bench.text(&format!(
            "sweep study.toml --shard {shard}/3 --into all --keep-going"
        ));
    }
    let before = bench.text("status all");
    assert!(before.contains("3 of 3 shards done"), "{before}");
    text.insert_str(0, "# Another event\n");
    std::fs::write(bench.path("own.csv"), &text).unwrap();
    let told = bench.complaint("sweep study.toml --shard 3/3 --into all --keep-going", 2);
    assert!(told.contains("another version of this one"), "{told}");
    assert_eq!(bench.text("status all"), before);
    assert_eq!(bench.run("status all --unfinished").stdout, b"\n");
}

/// Shards of two versions of a study make no result: the second says so, and so does `status`, which
/// names those of the earlier version and commands that make them again.
#[test]
fn shards_of_two_versions_are_not_done() {
    let bench = Bench::new(MIXED);
    let shard = |index: usize| format!("sweep study.toml --shard {index}/3 --into all");
    bench.text(&shard(1));
    bench.text(&shard(2));
    bench.study(&MIXED.replace("60 mm", "70 mm"));
    let told = bench.text(&shard(3));
    assert!(told.contains("of another version of the study"), "{told}");
    let output = bench.run("status all");
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8(output.stdout).unwrap();
    for part in [
        "1 of 3 shards done",
        "shard 1 ended before its end: 20 of 20 runs; its result is of another version",
        "shard 2 ended before its end",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    assert!(
        !told.contains("merge them") && !told.contains("script of the plan"),
        "{told}"
    );
    // A plan does not replace them: they are not in its list.
    let output = bench.run("status all --unfinished");
    assert_eq!(output.stdout, b"\n");
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("shards 1-2 are not in the list"), "{told}");
    goes_on_as_told(&bench);
    bench.text("merge all -o merged.h5");
    bench.text("sweep study.toml -o whole.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
}

/// Does what `status` says, and finds all shards done.
fn goes_on_as_told(bench: &Bench) {
    goes_on_as_told_in(bench.folder.path(), "all");
}

/// The same, of the folder of shards of this name in another folder.
fn goes_on_as_told_in(folder: &Path, shards: &str) {
    let status = |option: &str| {
        let mut command = super::pounding();
        command.current_dir(folder).args(["status", shards]);
        command.args((!option.is_empty()).then_some(option));
        command.output().unwrap()
    };
    let output = status("--json");
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    for line in json["studies"][0]["commands"].as_array().unwrap() {
        let done = Command::new("sh")
            .args(["-c", line.as_str().unwrap()])
            .current_dir(folder)
            .output()
            .unwrap();
        assert!(done.status.success(), "{line}: {done:?}");
    }
    assert_eq!(status("").status.code(), Some(0));
}

/// What `status` says of a damaged shard makes it again, and so does the list that a plan takes; the
/// damaged file is kept.
#[test]
fn a_damaged_shard_is_made_again_as_told() {
    let bench = Bench::new(MIXED);
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml --shard {shard}/2 --into all"));
    }
    let folder = bench.folder.path().canonicalize().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let result = format!("all/{name}.shard-1-of-2.h5");
    let whole = bench.bytes(&result);
    // Cut off, emptied, and with a byte that has changed within.
    let mut changed = whole.clone();
    changed[whole.len() / 2] ^= 1;
    for (number, damaged) in [(2, &whole[..5000]), (3, &[]), (4, &changed)] {
        std::fs::write(bench.path(&result), damaged).unwrap();
        match number {
            // A look from far away does not read it all.
            4 => drop(bench.text("sweep study.toml --shard 1/2 --into all")),
            _ => goes_on_as_told(&bench),
        }
        assert!(bench.bytes(&result) == whole);
        let aside = format!("all/{name}.shard-1-of-2-{number}.h5");
        assert!(bench.bytes(&aside) == damaged, "{number}");
    }
    bench.text("merge all -o merged.h5");
}

/// A list of two studies is none that a plan could use; a time of zero would never wait; and a name
/// with more shards than there are is no shard.
#[test]
fn lists_are_of_one_study() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/2 --into all");
    bench.text("sweep study.toml --shard 1/3 --into all");
    let told = bench.complaint("status all --unfinished", 2);
    assert!(told.contains("several studies"), "{told}");
    bench.text("sweep study.toml --shard 2/2 --into all");
    assert_eq!(bench.run("status all --unfinished").stdout, b"2-3\n");
    let told = bench.complaint("status all --watch --every 0s", 2);
    assert!(told.contains("no time to wait"), "{told}");
    std::fs::write(bench.path("all/x.shard-1-of-400000000.h5"), "").unwrap();
    assert_eq!(bench.run("status all --unfinished").stdout, b"2-3\n");
    let told = bench.complaint("sweep study.toml --shard 1/400000000 --into all", 2);
    assert!(told.contains("is no shard"), "{told}");
}

/// A command whose names stand behind `--` goes on as it is shown.
#[test]
fn names_behind_two_dashes_stay_names() {
    let bench = Bench::new(MIXED);
    std::fs::rename(bench.path("study.toml"), bench.path("-s.toml")).unwrap();
    bench.text("sweep --shard 1/2 --into all -- -s.toml");
    goes_on_as_told(&bench);
    bench.text("merge -o m.h5 all");
    std::fs::rename(bench.path("m.h5"), bench.path("-m.h5")).unwrap();
    bench.text("report -o page.html -- -m.h5");
    bench.text("sweep --shard 1/2 --into all -- -s.toml");
}

/// Results that were copied without what told of them are counted all the same, with those that failed.
#[test]
fn results_without_a_word_are_counted() {
    let bench = Bench::new(MIXED);
    let study = String::from_utf8(bench.bytes("study.toml")).unwrap();
    bench.study(&study.replace("kobe_1995_jma_ns.csv", "nowhere.csv"));
    for shard in 1..=2 {
        bench.run(&format!(
            "sweep study.toml --shard {shard}/2 --into all --keep-going"
        ));
    }
    let before = bench.text("status all");
    assert!(before.contains("60 runs finished, 30 failed"), "{before}");
    std::fs::remove_dir_all(bench.path("all/status")).unwrap();
    assert_eq!(bench.text("status all"), before);
    // What cannot be counted is not done.
    let name = bench.folder.path().canonicalize().unwrap();
    let name = name.file_name().unwrap().to_str().unwrap().to_owned();
    let result = format!("all/{name}.shard-1-of-2.h5");
    let mut damaged = bench.bytes(&result);
    let middle = damaged.len() / 2;
    damaged[middle] ^= 1;
    std::fs::write(bench.path(&result), damaged).unwrap();
    let told = String::from_utf8(bench.run("status all").stdout).unwrap();
    assert!(told.contains("1 of 2 shards done"), "{told}");
    assert!(told.contains("28 runs finished, 14 failed"), "{told}");
    assert!(
        told.contains("shard 1 ended before its end: its result is damaged"),
        "{told}"
    );
}

/// Where the folder of the shards was moved, alone or with the study, the command that is shown goes on
/// there.
#[test]
fn a_moved_folder_goes_on_where_it_is() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/2 --into all");
    std::fs::rename(bench.path("all"), bench.path("moved")).unwrap();
    goes_on_as_told_in(&bench.path(""), "moved");
    assert!(!bench.path("all").exists());
    // All of it; a study that has not the name of its folder keeps its own.
    let bench = Bench::new(MIXED);
    std::fs::create_dir(bench.path("old")).unwrap();
    for (from, to) in [
        ("case.toml", "old/case.toml"),
        ("study.toml", "old/own.toml"),
    ] {
        std::fs::rename(bench.path(from), bench.path(to)).unwrap();
    }
    let mut begun = bench.command("sweep own.toml --shard 1/2 --into all");
    let begun = begun.current_dir(bench.path("old")).output().unwrap();
    assert!(begun.status.success());
    std::fs::rename(bench.path("old"), bench.path("new")).unwrap();
    goes_on_as_told_in(&bench.path("new"), "all");
    assert!(!bench.path("old").exists());
}

/// A result that this user may not read is said to be that, not gone.
#[cfg(unix)]
#[test]
fn a_result_that_may_not_be_read_is_not_called_gone() {
    use std::os::unix::fs::PermissionsExt;
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/2 --into all");
    let name = bench.folder.path().canonicalize().unwrap();
    let name = name.file_name().unwrap().to_str().unwrap().to_owned();
    let result = bench.path(&format!("all/{name}.shard-1-of-2.h5"));
    std::fs::set_permissions(&result, std::fs::Permissions::from_mode(0o000)).unwrap();
    if std::fs::File::open(&result).is_ok() {
        // Root may read everything.
        return;
    }
    let told = String::from_utf8(bench.run("status all").stdout).unwrap();
    assert!(
        told.contains("cannot be read here: Permission denied"),
        "{told}"
    );
}

/// Of two studies in one folder each is merged by what is shown for it, and so are two dealings of one, under names of
/// their own.
#[test]
fn each_study_of_a_folder_is_merged_as_told() {
    let bench = Bench::new(MIXED);
    std::fs::copy(bench.path("study.toml"), bench.path("one of it.toml")).unwrap();
    let other = std::fs::read_to_string(bench.path("study.toml")).unwrap();
    std::fs::write(bench.path("other.toml"), format!("{other}\n# another\n")).unwrap();
    let shard = |study: &str, shard: &str| {
        let mut call = bench.command(&format!("sweep --shard {shard} --into mix"));
        assert!(call.arg(study).output().unwrap().status.success());
    };
    for (study, count) in [("one of it.toml", 2), ("other.toml", 2), ("other.toml", 3)] {
        (1..=count).for_each(|index| shard(study, &format!("{index}/{count}")));
    }
    let told = bench.text("status mix");
    let merges: Vec<&str> = told
        .lines()
        .filter(|line| line.contains(" merge "))
        .collect();
    assert_eq!(merges.len(), 3, "{told}");
    for line in merges {
        let done = Command::new("sh")
            .args(["-c", line])
            .current_dir(bench.folder.path())
            .output()
            .unwrap();
        assert!(done.status.success(), "{line}: {done:?}");
    }
    for result in [
        "one of it.h5",
        "other.of-2.merged.h5",
        "other.of-3.merged.h5",
    ] {
        assert!(bench.path(result).exists(), "{result}: {told}");
    }
}

/// What killed processes leave behind where shards tell of themselves and share records is named.
#[test]
fn part_files_beside_those_of_shards_are_named() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/2 --into all");
    let left = [
        "all/x.shard-1-of-2.h5.999999999-abCdeF.part",
        "all/status/x.shard-1-of-2.json.999999999-abCdeF.part",
        "all/records/list.json.999999999-abCdeF.part",
    ];
    for name in left {
        std::fs::write(bench.path(name), "half").unwrap();
    }
    std::fs::write(bench.path("all/notes.part"), "a file of somebody").unwrap();
    let output = bench.run("status all");
    let told = String::from_utf8(output.stderr).unwrap();
    for name in left {
        assert!(
            told.contains(&format!("{name} is an unfinished file")),
            "{told}"
        );
    }
    assert!(!told.contains("notes.part"), "{told}");
}
