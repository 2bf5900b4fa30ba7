//! Files of answers: `gap`, `compare` and `motion info` write them, `report` makes the same page of
//! them as the command itself.
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{run, text};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn calls() -> [(&'static str, String); 3] {
    let case = root().join("examples/three_storey_pair/case.toml");
    let records = ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"];
    let records = records.map(|name| root().join("ground_motions").join(name));
    let records = records.map(|path| path.display().to_string()).join(" ");
    let case = case.display();
    [
        (
            "gap",
            format!("{case} --points 6 --code eurocode_8_2004 --records {records}"),
        ),
        (
            "compare",
            format!("{case} --models jankowski_2005,stereomechanical --records {records}"),
        ),
        ("motion", format!("info {records}")),
    ]
}

#[test]
fn report_makes_the_page_of_the_command() {
    let folder = tempfile::tempdir().unwrap();
    for (command, arguments) in calls() {
        let at = |ending: &str| folder.path().join(format!("{command}{ending}"));
        let (file, page) = (at(".json"), at(".page.html"));
        let outputs = format!("-o {} --report {} --json", file.display(), page.display());
        let output = run(command, &format!("{arguments} {outputs}"));
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(matches!(output.status.code(), Some(0 | 1)), "{told}");
        let read = |path: &Path| std::fs::read_to_string(path).unwrap();
        let stored: Value = serde_json::from_str(&read(&file)).unwrap();
        let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(stored["answer"], printed, "{command}");
        // Without a name the page stands beside the file.
        let said = text("report", &file.display().to_string());
        assert!(said.starts_with("answer of `pounding "), "{said}");
        assert!(read(&at(".html")) == read(&page), "{command}");
        let mut files = std::fs::read_dir(folder.path()).unwrap();
        let left = files.any(|f| f.unwrap().path().to_string_lossy().contains(".part"));
        assert!(!left, "an unfinished file was left");
        // A file of its own suffices: neither case nor records are read again.
        let alone = tempfile::tempdir().unwrap();
        let moved = alone.path().join("moved.json");
        std::fs::rename(&file, &moved).unwrap();
        text("report", &moved.display().to_string());
        assert!(read(&moved.with_extension("html")) == read(&page));
    }
}

#[test]
fn files_that_are_no_answers() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("answer.json");
    let [_, _, (_, info)] = calls();
    text("motion", &format!("{info} -o {}", file.display()));
    let whole = std::fs::read_to_string(&file).unwrap();
    let refused = |content: &str, options: &str, words: &[&str]| {
        std::fs::write(&file, content).unwrap();
        let output = run("report", &format!("{} {options}", file.display()));
        let told = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", " ");
        assert_eq!(output.status.code(), Some(2), "{told}");
        for word in words {
            assert!(told.contains(word), "{word}: {told}");
        }
        assert!(!folder.path().join("answer.html").exists(), "{told}");
        assert_eq!(std::fs::read_to_string(&file).unwrap(), content);
    };
    refused(
        &whole[..whole.len() / 2],
        "",
        &["is cut off", "line 1", "--output"],
    );
    refused("{}", "", &["is not the result of `pounding`", "--output"]);
    refused(
        &whole.replacen("\"schema_version\":1", "\"schema_version\":7", 1),
        "",
        &["version 7", "or later"],
    );
    refused(
        &whole.replacen("acceleration", "accelaration", 1),
        "",
        &["was changed", "sha256"],
    );
    let study = root().join("examples/sweep_three_storey_pair/study.toml");
    refused(
        &whole,
        &format!("--study {}", study.display()),
        &["not of a study", "leave --study away"],
    );
}

/// A shard has no answer: an output of it would be a file that never comes.
#[test]
fn shards_take_no_outputs() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let [(gap, arguments), (compare, others), _] = calls();
    for (command, arguments) in [(gap, arguments), (compare, others)] {
        for option in ["-o", "--report", "--csv"] {
            let shard = format!("--shard 1/2 --into {}", at("parts"));
            let output = run(
                command,
                &format!("{arguments} {shard} {option} {}", at("new")),
            );
            let told = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", " ");
            assert_eq!(output.status.code(), Some(2), "{told}");
            assert!(
                told.contains("--shard makes a part of the runs and no answer"),
                "{told}"
            );
            assert!(told.contains("with --merge"), "{told}");
        }
    }
}
