//! Merging many shards, some of them, and those that are not all well.

use std::process::Command;

use serde_json::Value;

use super::{Bench, MIXED};

/// The shards `1.h5` to `count.h5` of a study.
fn shards(bench: &Bench, count: usize) {
    for index in 1..=count {
        bench.text(&format!(
            "sweep study.toml --shard {index}/{count} -o {index}.h5"
        ));
    }
}

/// More shards than the process may have files open: each is opened for itself.
#[test]
fn more_shards_than_open_files_are_merged() {
    let bench = Bench::new(&MIXED.replace("chunk = 4", "chunk = 2"));
    for index in 1..=30 {
        bench.text(&format!(
            "sweep study.toml --shard {index}/30 --into all --threads 1"
        ));
    }
    bench.text("sweep study.toml -o whole.h5 --csv whole.csv");
    let script = format!(
        "ulimit -n 16; exec {} merge all -o merged.h5 --csv merged.csv",
        env!("CARGO_BIN_EXE_pounding")
    );
    let output = Command::new("bash")
        .args(["-c", &script])
        .current_dir(bench.folder.path())
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
    assert!(bench.bytes("merged.csv") == bench.bytes("whole.csv"));
}

/// A result that cannot be read for want of memory is not called damaged, or none, as if it were to be made again.
#[test]
fn a_lack_of_memory_is_no_damage() {
    let bench = Bench::new(MIXED);
    for index in [1, 2] {
        bench.text(&format!(
            "sweep study.toml --shard {index}/2 --into shards --threads 1"
        ));
    }
    bench.text("sweep study.toml -o whole.h5");
    let run = |kilobytes: usize, words: &str| {
        let program = env!("CARGO_BIN_EXE_pounding");
        let script = format!("ulimit -v {kilobytes}; exec {program} {words}");
        let mut command = Command::new("bash");
        command.args(["-c", &script]).env("NO_COLOR", "1");
        command.current_dir(bench.folder.path()).output().unwrap()
    };
    // What the program itself takes.
    let mut least = 20_000;
    while !run(least, "check case.toml").status.success() {
        least += 2000;
    }
    let (mut done, mut short) = (0, 0);
    for kilobytes in (least - 4000..least + 12_000).step_by(250) {
        for words in [
            "report whole.h5 -o page.html",
            "merge shards -o merged.h5",
            "status shards",
        ] {
            let output = run(kilobytes, words);
            let told = [&output.stderr[..], &output.stdout[..]].concat();
            let told = String::from_utf8_lossy(&told).replace(['\u{2502}', '\n'], " ");
            let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
            match output.status.code() {
                Some(0) => done += 1,
                Some(2) => panic!("{words} {kilobytes}: {told}"),
                // What `status` says of shards that it cannot read is no that they are done.
                code => {
                    let of_memory = told.contains("memory of this process is limited");
                    short += usize::from(of_memory);
                    let damaged = told.contains("damaged") || told.contains("is not the result");
                    assert!(
                        of_memory || !damaged,
                        "{words} {kilobytes}: {code:?} {told}"
                    );
                }
            }
            let _ = std::fs::remove_file(bench.folder.path().join("merged.h5"));
        }
    }
    assert!(done > 10 && short > 0, "{done} {short}");
}

/// A sweep that may open too few files is no fault of the study: it says what is short, and with more
/// it goes on to the same bytes.
#[test]
fn a_lack_of_open_files_is_named_as_such() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o whole.h5 --csv whole.csv");
    let mut short = 0;
    for limit in 4..=20 {
        let script = format!(
            "ulimit -n {limit}; exec {} sweep study.toml -o few.h5 --csv few.csv --threads 1 --resume",
            env!("CARGO_BIN_EXE_pounding")
        );
        let output = Command::new("bash")
            .args(["-c", &script])
            .env("NO_COLOR", "1")
            .current_dir(bench.folder.path())
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        if output.status.success() {
            continue;
        }
        // With fewer still not even the study can be read.
        assert!(told.contains("open files"), "{told}");
        assert!(matches!(output.status.code(), Some(3 | 4)), "{told}");
        assert!(!told.contains("check the path"), "{told}");
        if told.contains("finished runs") || told.contains("store runs") {
            short += 1;
            assert!(told.contains("allow more open files"), "{told}");
        }
    }
    assert!(short > 0);
    // A case is read by all commands: the study, where it is not the case, is in the same words.
    for words in [
        "run case.toml --no-output",
        "sweep study.toml -o no.h5 --resume",
    ] {
        let limited = |limit: usize| {
            let program = env!("CARGO_BIN_EXE_pounding");
            let script = format!("ulimit -n {limit}; exec {program} {words}");
            let mut command = Command::new("bash");
            command.args(["-c", &script]).env("NO_COLOR", "1");
            command.current_dir(bench.folder.path()).output().unwrap()
        };
        let told: Vec<String> = (4..=8)
            .map(limited)
            .filter(|o| !o.status.success())
            .map(|o| {
                assert!(matches!(o.status.code(), Some(3 | 4)), "{o:?}");
                String::from_utf8(o.stderr).unwrap()
            })
            .collect();
        let is_unread = |told: &String| {
            told.contains("allow more open files (`ulimit -n`)") && told.contains(" file: ")
        };
        assert!(told.iter().any(is_unread), "{words}: {told:?}");
    }
    assert!(bench.bytes("few.h5") == bench.bytes("whole.h5"));
    assert!(bench.bytes("few.csv") == bench.bytes("whole.csv"));
}

/// In any tree of partial merges the result has the bytes of one call.
#[test]
fn partial_merges_are_merged_again() {
    let bench = Bench::new(MIXED);
    shards(&bench, 7);
    bench.text("sweep study.toml -o whole.h5 --csv whole.csv");
    let told = bench.text("merge 5.h5 1.h5 3.h5 -o odd.h5 --partial");
    assert!(
        told.contains("4 of 7 shards are still missing: 2,4,6-7"),
        "{told}"
    );
    bench.text("merge 2.h5 7.h5 -o some.h5 --partial");
    let told = bench.complaint("merge odd.h5 some.h5 -o out.h5", 2);
    assert!(told.contains("missing 2 of 7 shards: 4,6"), "{told}");
    let told = bench.complaint("merge odd.h5 3.h5 -o out.h5 --partial", 2);
    assert!(told.contains("3.h5 is shard 3/7 once more"), "{told}");
    assert!(!bench.path("out.h5").exists());
    bench.text("merge some.h5 odd.h5 6.h5 -o more.h5 --partial");
    let told = bench.text("merge 4.h5 more.h5 -o merged.h5 --csv merged.csv");
    assert!(told.contains("merged from 7 shards into"), "{told}");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
    assert!(bench.bytes("merged.csv") == bench.bytes("whole.csv"));
    // A part is a result of its own: in order, and refused where the whole is wanted.
    let file = hdf5::File::open(bench.path("odd.h5")).unwrap();
    let runs: Vec<i64> = file.dataset("run").unwrap().read_raw().unwrap();
    let expected = (0..60).filter(|run| [0, 2, 4].contains(&(run / 4 % 7)));
    assert_eq!(runs, expected.collect::<Vec<_>>());
    drop(file);
    let told = bench.complaint("sweep study.toml -o odd.h5 --resume", 2);
    assert!(told.contains("shards 1,3,5 of 7"), "{told}");
    bench.text("report odd.h5 -o odd.html");
}

/// Everything that is wrong is named at once, and nothing is written.
#[test]
fn a_check_names_all_that_is_wrong() {
    let bench = Bench::new(MIXED);
    shards(&bench, 5);
    let told = bench.text("merge 1.h5 2.h5 3.h5 4.h5 5.h5 --check");
    assert!(told.contains("5 of 5 shards are there"), "{told}");
    let mut damaged = bench.bytes("2.h5");
    damaged[5000] ^= 1;
    std::fs::write(bench.path("2.h5"), damaged).unwrap();
    std::fs::write(bench.path("text.h5"), "no HDF5").unwrap();
    bench.study(&MIXED.replace("seed = 3", "seed = 4"));
    bench.text("sweep study.toml --shard 4/5 -o other.h5");
    // First: what most files are of is the study.
    let files = "other.h5 1.h5 2.h5 3.h5 text.h5 nowhere.h5 3.h5 5.h5";
    let output = bench.run(&format!("merge {files} --check"));
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8(output.stdout).unwrap();
    for part in [
        "3 of 5 shards are there; missing: 2,4",
        "cannot read the result 2.h5: it is damaged",
        "text.h5: it is not the result of a study",
        "nowhere.h5: No such file",
        "3.h5 is shard 3/5 once more",
        "other.h5 is of another study, or of another version of it, than 1.h5",
        "They cannot be merged",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let output = bench.run(&format!("merge {files} --check --json"));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["merges"], false);
    assert_eq!(json["missing"], serde_json::json!([2, 4]));
    assert_eq!(json["faults"].as_array().unwrap().len(), 5);
    let told = bench.complaint(&format!("merge {files} -o out.h5"), 2);
    assert!(
        told.contains("4 more of the files") && told.contains("--check"),
        "{told}"
    );
    assert!(!bench.path("out.h5").exists());
}

/// A file of several shards, of which another file holds one: what it holds beside is there.
#[test]
fn shards_beside_one_that_is_there_twice_are_not_missing() {
    let bench = Bench::new(MIXED);
    shards(&bench, 4);
    bench.text("merge 1.h5 3.h5 -o odd.h5 --partial");
    bench.text("merge 1.h5 2.h5 3.h5 -o three.h5 --partial");
    bench.text("merge 1.h5 2.h5 -o two.h5 --partial");
    let told = |files: &str| {
        let output = bench.run(&format!("merge {files} --check"));
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8(output.stdout).unwrap()
    };
    let both = told("odd.h5 three.h5");
    assert!(
        both.contains("3 of 4 shards are there; missing: 4"),
        "{both}"
    );
    assert!(
        both.contains("three.h5 holds shards 1, 3 of 4 once more"),
        "{both}"
    );
    let one = told("3.h5 1.h5 two.h5 4.h5");
    assert!(one.contains("4 of 4 shards are there"), "{one}");
    assert!(
        one.contains("two.h5 holds shard 1/4 once more, beside others"),
        "{one}"
    );
    assert!(one.contains("They cannot be merged"), "{one}");
}

/// A name given to all shards by mistake loses nothing.
#[test]
fn a_shard_replaces_no_other_one() {
    let bench = Bench::new(MIXED);
    shards(&bench, 3);
    bench.text("sweep study.toml -o whole.h5");
    for (output, is) in [
        ("2.h5", "it is shard 2/3 of this study"),
        ("whole.h5", "it is the result of the whole study"),
    ] {
        let before = bench.bytes(output);
        for resume in ["", "--resume"] {
            let told = bench.complaint(
                &format!("sweep study.toml --shard 3/3 -o {output} {resume}"),
                2,
            );
            assert!(told.contains(is), "{told}");
        }
        assert!(bench.bytes(output) == before);
        assert!(!bench.path(&format!("{output}.parts")).exists());
    }
    // Its own result it replaces, as any command does.
    bench.text("sweep study.toml --shard 2/3 -o 2.h5");
    let told = bench.complaint("sweep study.toml --shard 2/3 --into all -o 4.h5", 2);
    assert!(told.contains("a name of its own"), "{told}");
    let told = bench.complaint("sweep study.toml --into all", 2);
    assert!(told.contains("--shard"), "{told}");
}

/// The runs of an incremental dynamic analysis are dealt out, merged and evaluated.
#[test]
fn an_incremental_dynamic_analysis_is_dealt_out() {
    let bench = Bench::new(IDA);
    let whole = bench.text("ida study.toml -o whole.h5 --table whole.csv");
    for index in 1..=3 {
        let told = bench.text(&format!("ida study.toml --shard {index}/3 --into all"));
        assert!(told.contains("-o ALL.h5 --resume"), "{told}");
    }
    bench.text("merge all -o merged.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
    let merged = bench.text("ida study.toml -o merged.h5 --resume --table merged.csv");
    assert!(bench.bytes("merged.csv") == bench.bytes("whole.csv"));
    let answer = |text: &str| text.split_once("none failed").unwrap().1.to_owned();
    assert_eq!(answer(&merged), answer(&whole));
    let told = bench.complaint("ida study.toml --shard 1/3 --table part.csv", 2);
    assert!(told.contains("cannot be used with"), "{told}");
}

/// Two records at six intensities, twelve runs in chunks of two.
const IDA: &str = r#"
case = "case.toml"
[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", "MOTIONS/kobe_1995_jma_ns.csv"]
[[variable]]
intensity = "peak_ground_acceleration"
from = "0.05 g"
to = "0.6 g"
count = 6
[output]
chunk = 2
[ida]
gaps = ["10 mm", "20 mm"]
"#;

/// What a merge does not hold stays, whatever name it is given: another shard, the whole, and more
/// shards than are merged. What it holds is replaced, and a result of another study with a note.
#[test]
fn a_merge_replaces_no_runs_that_it_does_not_hold() {
    let bench = Bench::new(MIXED);
    shards(&bench, 3);
    bench.text("sweep study.toml -o whole.h5");
    bench.text("merge 2.h5 3.h5 --partial -o some.h5");
    for (merged, stands, what) in [
        ("1.h5 2.h5", "3.h5", "it is shard 3/3 of this study"),
        ("1.h5", "whole.h5", "it is the result of the whole study"),
        (
            "1.h5 2.h5",
            "some.h5",
            "it is shards 2-3 of 3 of this study",
        ),
    ] {
        let before = bench.bytes(stands);
        let told = bench.complaint(&format!("merge {merged} --partial -o {stands}"), 2);
        for part in [
            stands,
            "is not replaced",
            what,
            "name another result with -o",
        ] {
            assert!(told.contains(part), "{part}: {told}");
        }
        assert!(bench.bytes(stands) == before, "{stands}");
    }
    let whole = bench.bytes("whole.h5");
    for stands in ["some.h5", "whole.h5"] {
        let output = bench.run(&format!("merge 1.h5 2.h5 3.h5 -o {stands}"));
        assert!(
            output.status.success() && output.stderr.is_empty(),
            "{output:?}"
        );
        assert!(bench.bytes(stands) == whole);
    }
    bench.study(&MIXED.replace("60 mm", "70 mm"));
    bench.text("sweep study.toml -o other.h5");
    let output = bench.run("merge 1.h5 2.h5 3.h5 -o other.h5");
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success());
    assert_eq!(
        told.matches("other.h5 will be replaced, the result of another study")
            .count(),
        1,
        "{told}"
    );
    assert!(bench.bytes("other.h5") == whole);
}

/// Two dealings of a study in one folder are two sets of shards: no merge of one takes a shard, or a
/// name, of the other.
#[test]
fn a_merge_takes_no_place_of_another_dealing() {
    let bench = Bench::new(MIXED);
    shards(&bench, 3);
    bench.text("sweep study.toml --shard 1/7 -o other.h5");
    let before = bench.bytes("other.h5");
    let named = "folder/s.shard-2-of-7.h5";
    std::fs::create_dir(bench.path("folder")).unwrap();
    for (output, says) in [
        ("other.h5", "it is shard 1/7 of this study"),
        (named, "has the name of a shard, 2 of 7"),
    ] {
        for merged in ["1.h5 2.h5 3.h5", "1.h5 --partial"] {
            let told = bench.complaint(&format!("merge {merged} -o {output}"), 2);
            for part in [output, says, "name another result with -o"] {
                assert!(told.contains(part), "{part}: {told}");
            }
        }
    }
    assert!(bench.bytes("other.h5") == before && !bench.path(named).exists());
}

/// One of the two has to be there.
#[test]
fn the_help_of_a_merge_shows_what_it_needs() {
    let output = super::pounding().args(["merge", "-h"]).output().unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    for usage in [
        "pounding merge [OPTIONS] --output <OUTPUT> <SHARDS>...",
        "pounding merge [OPTIONS] --check <SHARDS>...",
    ] {
        assert!(help.contains(usage), "{help}");
    }
}

/// A merged result under the default name is, to the last byte, that of one call: it says of which
/// study file it is, and no study of another folder takes its place.
#[test]
fn a_merged_result_says_of_which_study_it_is() {
    let bench = Bench::new(MIXED);
    let folder = bench.folder.path().canonicalize().unwrap();
    let name = folder.file_name().unwrap().to_str().unwrap().to_owned();
    let result = format!("{name}.study.h5");
    bench.text("sweep study.toml");
    let whole = bench.bytes(&result);
    std::fs::remove_file(bench.path(&result)).unwrap();
    for shard in 1..=3 {
        bench.text(&format!("sweep study.toml --shard {shard}/3 --into all"));
    }
    bench.text(&format!("merge all -o {result}"));
    assert!(bench.bytes(&result) == whole);
    // By way of a partial merge, too.
    std::fs::remove_file(bench.path(&result)).unwrap();
    let shard = |index: usize| format!("all/{name}.shard-{index}-of-3.h5");
    let (first, second, third) = (shard(1), shard(2), shard(3));
    bench.text(&format!("merge --partial {first} {third} -o some.h5"));
    bench.text(&format!("merge some.h5 {second} -o {result}"));
    assert!(bench.bytes(&result) == whole);
    let other = bench.path("other").join(&name);
    std::fs::create_dir_all(&other).unwrap();
    std::fs::copy(bench.path("case.toml"), other.join("case.toml")).unwrap();
    let study = String::from_utf8(bench.bytes("study.toml")).unwrap();
    std::fs::write(other.join("study.toml"), study).unwrap();
    let told = bench.complaint(&format!("sweep other/{name}/study.toml"), 4);
    assert!(told.contains("does not take its place unasked"), "{told}");
    assert!(bench.bytes(&result) == whole);
    // Under a name that was given a result has the same bytes wherever it was made.
    bench.text("merge all -o given.h5");
    bench.text("sweep study.toml -o whole.h5");
    assert!(bench.bytes("given.h5") == bench.bytes("whole.h5"));
}

/// The table of a merge takes the place of no result, shard or answer, and nothing does of what the shards
/// keep beside their results.
#[test]
fn the_table_of_a_merge_spares_what_a_study_has_made() {
    let bench = Bench::new(&MIXED.replace("MOTIONS/el_centro_1940_ns.csv", "own.csv"));
    let record = super::root().join("ground_motions/el_centro_1940_ns.csv");
    std::fs::copy(record, bench.path("own.csv")).unwrap();
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml --shard {shard}/2 --into all"));
    }
    bench.text("sweep study.toml --shard 1/2 -o other.h5");
    bench.text("run case.toml -o run.h5");
    bench.run("gap case.toml --points 0 -o answer.json");
    assert!(bench.path("answer.json").is_file());
    bench.text("gap case.toml --points 2 --shard 1/2 --into checks");
    let store = |folder: &str, list: bool| {
        let mut files: Vec<String> = std::fs::read_dir(bench.path(folder))
            .unwrap()
            .map(|e| format!("{folder}/{}", e.unwrap().file_name().to_str().unwrap()))
            .filter(|name| name.ends_with("list.json") == list)
            .collect();
        files.sort();
        files
    };
    let mut kept = vec![
        "run.h5".to_owned(),
        "other.h5".to_owned(),
        "answer.json".to_owned(),
        "checks/case.gap-shard-1-of-2.runs".to_owned(),
    ];
    kept.extend(store("all/records", false));
    kept.extend(store("all/records", true));
    kept.extend(store("all/status", false));
    for file in &kept {
        let before = bench.bytes(file);
        for command in [
            "merge all -o merged.h5 --csv",
            "gap case.toml --points 0 --csv",
            "motion convert own.csv -o",
            "run case.toml -o",
        ] {
            // A result is replaced by one of its kind.
            let replaces = command.starts_with("run") && file == "run.h5";
            // The ending of a table may be refused before.
            if !replaces {
                let output = bench.run(&format!("{command} {file}"));
                assert_ne!(output.status.code(), Some(0), "{command} {file}");
                assert!(bench.bytes(file) == before, "{command} {file}");
            }
        }
        let told = bench.run(&format!("merge all -o merged.h5 --csv {file}"));
        assert_eq!(told.status.code(), Some(4), "{file}");
    }
    bench.text("merge all -o merged.h5 --csv table.csv");
}

/// A check reads what a merge reads: rows of other runs, and damage below a checksum that matches.
#[test]
fn a_check_reads_all_rows() {
    let bench = Bench::new(MIXED);
    shards(&bench, 2);
    std::fs::create_dir(bench.path("all")).unwrap();
    for shard in 1..=2 {
        let to = bench.path(&format!("all/study.shard-{shard}-of-2.h5"));
        std::fs::copy(bench.path(&format!("{shard}.h5")), to).unwrap();
    }
    // A file of another name is not merged, which is said.
    std::fs::copy(bench.path("2.h5"), bench.path("all/copy.h5")).unwrap();
    for command in ["merge all --check", "merge all -o merged.h5"] {
        let output = bench.run(command);
        assert_eq!(output.status.code(), Some(0));
        let told = String::from_utf8(output.stderr).unwrap();
        let note = "all/copy.h5 holds shard 2/2 of a study and is not called as a shard is";
        assert_eq!(told.matches(note).count(), 1, "{told}");
    }
    // Runs that are not those of the shard.
    let path = bench.path("1.h5");
    let file = hdf5::File::open_rw(&path).unwrap();
    let run = file.dataset("run").unwrap();
    let mut runs: Vec<i64> = run.read_raw().unwrap();
    runs[0] += 1;
    run.write_raw(&runs).unwrap();
    drop((run, file));
    pounding_files::checksum::append(&path).unwrap();
    let told = bench.complaint("merge 1.h5 2.h5 -o out.h5", 2);
    assert!(told.contains("1.h5 does not have the runs 0 to"), "{told}");
    let output = bench.run("merge 1.h5 2.h5 --check");
    assert_eq!(output.status.code(), Some(1));
    let told = String::from_utf8(output.stdout).unwrap();
    assert!(told.contains("1.h5 does not have the runs 0 to"), "{told}");
}

/// In a folder of shards the result of the whole would be taken for a shard, and another shard for
/// this one.
#[test]
fn no_result_has_the_name_of_another_shard() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/3 --into all");
    let shard = std::fs::read_dir(bench.path("all")).unwrap();
    let mut names = shard.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let name = names.find(|name| name.ends_with(".h5")).unwrap();
    let before = bench.bytes(&format!("all/{name}"));
    for call in ["sweep study.toml", "sweep study.toml --shard 2/3"] {
        let told = bench.complaint(&format!("{call} -o all/{name}"), 2);
        assert!(told.contains("name of a shard, 1 of 3"), "{told}");
    }
    assert!(bench.bytes(&format!("all/{name}")) == before);
    bench.text(&format!("sweep study.toml --shard 1/3 -o {name}"));
}

/// Where a call does not find the study of its shards, as from another folder, the files that it was made of stay all
/// the same: they are known by what they hold. So they do under the page of a result.
#[test]
fn inputs_stay_wherever_shards_are_merged() {
    let bench = Bench::new(MIXED);
    let motions = super::root().join("ground_motions");
    for record in ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"] {
        std::fs::copy(motions.join(record), bench.path(record)).unwrap();
    }
    for index in 1..=2 {
        bench.text(&format!("sweep study.toml --shard {index}/2 --into all"));
    }
    bench.text("run case.toml -o run.h5");
    bench.text("sweep study.toml -o whole.h5");
    std::fs::rename(bench.path("study.toml"), bench.path("renamed.toml")).unwrap();
    std::fs::copy(bench.path("case.toml"), bench.path("copy.toml")).unwrap();
    std::fs::copy(bench.path("el_centro_1940_ns.csv"), bench.path("copy.dat")).unwrap();
    let before = |name: &str| bench.bytes(name);
    let records = ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv", "copy.dat"]
        .map(|name| (name, before(name)));
    let elsewhere = tempfile::tempdir().unwrap();
    let at = |name: &str| bench.path(name).display().to_string();
    let calls = [
        format!("merge {} -o {}", at("all"), at("el_centro_1940_ns.csv")),
        format!(
            "merge {} -o m.h5 --csv {}",
            at("all"),
            at("kobe_1995_jma_ns.csv")
        ),
        format!(
            "merge {} -o {}",
            at("whole.h5"),
            at("el_centro_1940_ns.csv")
        ),
        format!(
            "report {} -o {}",
            at("whole.h5"),
            at("kobe_1995_jma_ns.csv")
        ),
        format!("report {} -o {}", at("run.h5"), at("el_centro_1940_ns.csv")),
        format!("merge {} -o {}", at("all"), at("copy.dat")),
        format!("report {} -o {}", at("run.h5"), at("copy.dat")),
        format!("report {} -o {}", at("whole.h5"), at("copy.dat")),
    ];
    for call in &calls {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(call.split(' '))
            .current_dir(elsewhere.path())
            .output()
            .unwrap();
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{call}: {told}");
        assert!(
            told.contains("is not replaced: it is a record that"),
            "{call}: {told}"
        );
        // Nor is it said before that it will be.
        assert!(!told.contains("note:"), "{call}: {told}");
        for (name, content) in &records {
            assert!(before(name) == *content, "{call}: {name}");
        }
    }
    assert!(!elsewhere.path().join("m.h5").exists());
}
