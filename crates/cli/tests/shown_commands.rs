//! What pages show to be typed runs as it stands there.
#![allow(clippy::panic)]

use std::path::{Path, PathBuf};
use std::process::Command;

/// Folders of the repository that commands read.
const READ: [&str; 2] = ["examples", "ground_motions"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

/// Copies a folder without what runs have left in it.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let (path, there) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy(&path, &there);
        } else if path.extension().is_none_or(|e| e != "h5") {
            std::fs::copy(path, there).unwrap();
        }
    }
}

fn pages(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            pages(&path, found);
        } else if path.extension().is_some_and(|e| e == "md") {
            found.push(path);
        }
    }
    found.sort();
}

/// Lines that may be commands, those that end in a backslash with what follows: of blocks of the
/// shell and of indented ones all, of others those with a prompt.
fn typed(page: &str) -> Vec<String> {
    let (mut fenced, mut shell, mut lines) = (false, false, Vec::<String>::new());
    let mut open = false;
    for line in page.lines() {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
            shell = line.trim() == "```sh";
            open = false;
            continue;
        }
        let text = match (fenced, shell) {
            (true, true) => Some(line),
            (true, false) if open => Some(line),
            (true, false) => line.strip_prefix("$ "),
            (false, _) => line.strip_prefix("    "),
        };
        let Some(text) = text else {
            open = false;
            continue;
        };
        let (text, continues) = match text.trim_end().strip_suffix('\\') {
            Some(text) => (text, true),
            None => (text, false),
        };
        match lines.last_mut() {
            Some(last) if open => last.push_str(text),
            _ => lines.push(text.to_owned()),
        }
        open = continues;
    }
    lines
}

/// The commands of `pounding` on a page.
fn commands(page: &str) -> Vec<String> {
    let lines = typed(page).into_iter().map(|line| line.trim().to_owned());
    lines.filter(|line| line.starts_with("pounding ")).collect()
}

/// The first fenced block of a language.
fn block<'p>(page: &'p str, language: &str) -> &'p str {
    let start = format!("```{language}\n");
    let after = page.split_once(start.as_str()).unwrap().1;
    after.split_once("```").unwrap().0
}

/// What the page on clusters takes for granted: a study, a case and a suite.
fn large_study(at: &Path) {
    let case = std::fs::read_to_string(at.join("examples/three_storey_pair/case.toml")).unwrap();
    std::fs::write(at.join("case.toml"), case.replace("../../", "")).unwrap();
    let study = "case = \"case.toml\"\n\n[output]\nchunk = 1\n\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"300 mm\"]\n";
    std::fs::write(at.join("study.toml"), study).unwrap();
    copy(&at.join("ground_motions"), &at.join("suite"));
}

/// What other processes do there.
const SHARDS: &str = "set -e
pounding sweep study.toml --plan=shell --shards 2 --into study.shards -o study.h5 > shell.sh
bash shell.sh
for i in 1 2 3 4 5 6 7 8; do pounding gap case.toml --records suite/ --shard $i/8 --into parts; done";

/// Every command that stands on a page ends with an answer: exit code 0, or 1 where the answer
/// is no. Of long studies a part is run, as their own tests run the whole.
#[test]
fn commands_of_pages_run() {
    let folder = tempfile::tempdir().unwrap();
    for name in READ {
        copy(&root().join(name), &folder.path().join(name));
    }
    let mut all = vec![root().join("README.md")];
    for name in ["docs", "examples", "ground_motions"] {
        pages(&root().join(name), &mut all);
    }
    let program = Path::new(env!("CARGO_BIN_EXE_pounding"));
    let path = format!(
        "{}:{}",
        program.parent().unwrap().display(),
        std::env::var("PATH").unwrap()
    );
    let (mut checked, mut wrong) = (0, Vec::new());
    for page in all {
        let text = std::fs::read_to_string(&page).unwrap();
        let shown = page.strip_prefix(root()).unwrap().to_owned();
        let inside = READ.iter().any(|name| shown.starts_with(name));
        let at = match shown.parent().filter(|_| inside) {
            Some(beside) => folder.path().join(beside),
            None => folder.path().to_owned(),
        };
        // What the reader has or was told to write.
        if shown.starts_with("docs/tutorial") {
            std::fs::write(at.join("pair.toml"), block(&text, "toml")).unwrap();
        }
        for (name, text) in [
            ("history.csv", "time_s,deformation_mm\n0,0\n0.5,10\n1,-10\n"),
            (
                "spring.csv",
                "penetration_mm,force_kN\n0.5,10\n1,50\n20,3000\n",
            ),
        ] {
            std::fs::write(at.join(name), text).unwrap();
        }
        let run = |command: &str| {
            Command::new("bash")
                .args(["-c", command])
                .current_dir(&at)
                .env("PATH", &path)
                .env("NO_COLOR", "1")
                .output()
                .unwrap()
        };
        if shown.ends_with("run-on-a-cluster.md") {
            large_study(&at);
            let made = run(SHARDS);
            assert!(
                made.status.success(),
                "{}",
                String::from_utf8_lossy(&made.stderr)
            );
        }
        for command in commands(&text) {
            let whole = command.starts_with("pounding sweep ") && !command.contains("--plan");
            let part = match whole {
                true => command.replacen("pounding sweep ", "pounding sweep --shard 1/50 ", 1),
                false => command.clone(),
            };
            let output = run(&part);
            checked += 1;
            if part.starts_with("pounding explore ") && !crate::explore::has_module() {
                continue;
            }
            if !matches!(output.status.code(), Some(0 | 1)) {
                let said = String::from_utf8_lossy(&output.stderr);
                wrong.push(format!("{}: {command}\n{said}", shown.display()));
            }
        }
    }
    assert!(checked > 120, "{checked}");
    assert!(
        wrong.is_empty(),
        "{} of {checked}:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}

/// Blocks of TOML and JSON are TOML and JSON; entries of an object may stand without its braces.
#[test]
fn blocks_of_pages_are_what_they_say() {
    let mut all = vec![root().join("README.md")];
    for name in ["docs", "examples", "crates"] {
        pages(&root().join(name), &mut all);
    }
    let (mut checked, mut wrong) = (0, Vec::new());
    for page in all {
        let text = std::fs::read_to_string(&page).unwrap();
        for language in ["toml", "json"] {
            let start = format!("```{language}\n");
            for part in text.split(start.as_str()).skip(1) {
                let block = part.split("```").next().unwrap();
                let error = match language {
                    "toml" => toml::from_str::<toml::Table>(block)
                        .err()
                        .map(|e| e.to_string()),
                    _ => {
                        let whole = match block.trim_start().starts_with('"') {
                            true => format!("{{{block}}}"),
                            false => block.to_owned(),
                        };
                        let read = serde_json::from_str::<serde_json::Value>(&whole);
                        read.err().map(|e| e.to_string())
                    }
                };
                checked += 1;
                wrong.extend(error.map(|e| format!("{}: {e}\n{block}", page.display())));
            }
        }
    }
    assert!(checked > 50, "{checked}");
    assert!(
        wrong.is_empty(),
        "{} of {checked}:\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
