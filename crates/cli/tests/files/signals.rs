//! Commands that are asked to end.

use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

use super::fixture::{Fixture, message};
use crate::support::part_files::no_part_file;

fn send(signal: &str, child: &Child) {
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status().unwrap();
    assert!(sent.success());
}

/// Begins a command and sends a signal as soon as it tells of its first progress: it listens
/// by then, and is far from its end.
fn interrupted(fixture: &Fixture, words: &str, signal: &str) -> Output {
    let mut child = fixture
        .command(&words.split_whitespace().collect::<Vec<_>>())
        .env("POUNDING_PROGRESS_SECONDS", "0.01")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0];
    let errors = child.stderr.as_mut().unwrap();
    std::io::Read::read_exact(errors, &mut first).unwrap();
    send(signal, &child);
    child.wait_with_output().unwrap()
}

/// Whether these tests run under `nohup`, which the program inherits and heeds.
fn hangups_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let ignored = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    ignored.is_some_and(|mask| mask & 1 == 1)
}

#[test]
fn a_run_ends_at_once_and_loses_nothing() {
    let fixture = Fixture::new();
    fixture.with_long_case();
    let folder = fixture.path("").canonicalize().unwrap();
    for (name, text) in [("old.h5", "old result"), ("old.svg", "old picture")] {
        std::fs::write(fixture.path(name), text).unwrap();
    }
    for (words, signal) in [
        ("run long.toml -o old.h5 --plot old.svg", "-TERM"),
        ("run long.toml -o old.h5", "-INT"),
        ("run long.toml -o new.h5", "-TERM"),
        ("run long.toml -o old.h5", "-HUP"),
        ("run long.toml -o new.h5", "-XCPU"),
        ("gap long.toml --csv old.svg", "-TERM"),
        ("compare long.toml --csv old.svg", "-INT"),
    ] {
        if signal == "-HUP" && hangups_are_ignored() {
            continue;
        }
        let before = fixture.content();
        let output = interrupted(&fixture, words, signal);
        let told = message(&output);
        assert_eq!(output.status.code(), Some(5), "{words}: {told}");
        assert!(
            told.contains("interrupted; every output is as it was before, or complete"),
            "{told}"
        );
        assert!(output.stdout.is_empty(), "{words}");
        assert!(fixture.content() == before, "{words}");
        no_part_file(&folder);
    }
}

/// What has finished is stored, and the command that is shown goes on with it.
#[test]
fn a_sweep_stores_what_has_finished() {
    let fixture = Fixture::new();
    let study = "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nfrom = \"5 mm\"\nto = \"60 mm\"\ncount = 1500\n";
    std::fs::write(fixture.path("long study.toml"), study).unwrap();
    for signal in ["-TERM", "-INT"] {
        let mut child = fixture
            .command(&[
                "sweep",
                "long study.toml",
                "-o",
                "new.h5",
                "--store-every",
                "10 ms",
            ])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        // Chunks have 256 runs: time alone has these stored.
        let parts = fixture.path("new.h5.parts");
        let stored = || {
            let files = std::fs::read_dir(&parts).into_iter().flatten();
            let mut names = files.map(|f| f.unwrap().path());
            names.any(|path| path.extension().is_some_and(|e| e == "runs"))
        };
        while !stored() && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        send(signal, &child);
        let output = child.wait_with_output().unwrap();
        let told = message(&output);
        assert_eq!(output.status.code(), Some(5), "{told}");
        let words: Vec<&str> = told.split(' ').collect();
        assert_eq!(&words[..1], ["interrupted;"], "{told}");
        let kept: usize = words[1].parse().unwrap();
        assert!(kept > 0 && kept < 1500, "{told}");
        assert!(
            told.contains("of 1500 runs are stored go on with"),
            "{told}"
        );
        assert!(!fixture.path("new.h5").exists());
        // The line as a shell takes it.
        let errors = String::from_utf8(output.stderr).unwrap();
        let line = errors.lines().last().unwrap().trim();
        assert!(line.ends_with("--store-every '10 ms' --resume"), "{line}");
        let resumed = Command::new("sh")
            .args(["-c", line])
            .current_dir(fixture.path(""))
            .output()
            .unwrap();
        let said = String::from_utf8(resumed.stdout.clone()).unwrap();
        assert!(resumed.status.success(), "{}", message(&resumed));
        assert!(
            said.contains(&format!(
                "1500 runs in new.h5, {kept} of them stored by an earlier call"
            )),
            "{said}"
        );
        assert!(!parts.exists());
        // The same bytes as without an interruption.
        let whole = fixture.run(&["sweep", "long study.toml", "-o", "whole.h5"]);
        assert!(whole.status.success(), "{}", message(&whole));
        let bytes = |name: &str| std::fs::read(fixture.path(name)).unwrap();
        assert!(bytes("new.h5") == bytes("whole.h5"));
        std::fs::remove_file(fixture.path("new.h5")).unwrap();
    }
}

/// Batch systems send a signal to a task and to the shell above it, which hands it on: the second
/// loses nothing.
#[test]
fn signals_that_come_together_are_one() {
    let fixture = Fixture::new();
    let study = "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nfrom = \"5 mm\"\nto = \"60 mm\"\ncount = 1500\n";
    std::fs::write(fixture.path("study.toml"), study).unwrap();
    let words = "sweep study.toml -o new.h5 --store-every 1000s --threads 1 --resume";
    let mut child = fixture
        .command(&words.split_whitespace().collect::<Vec<_>>())
        .env("POUNDING_PROGRESS_SECONDS", "0.05")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // Some runs have finished, and none is stored: neither time nor a whole chunk asked for it.
    let mut line = String::new();
    let mut errors = std::io::BufReader::new(child.stderr.take().unwrap());
    while line.is_empty() || line.starts_with("0 of") {
        line.clear();
        assert!(std::io::BufRead::read_line(&mut errors, &mut line).unwrap() > 0);
    }
    let both = format!("kill -TERM {0}; kill -TERM {0}", child.id());
    assert!(
        Command::new("sh")
            .args(["-c", &both])
            .status()
            .unwrap()
            .success()
    );
    let mut told = String::new();
    std::io::Read::read_to_string(&mut errors, &mut told).unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(5), "{told}");
    let stored = told.split("interrupted; ").nth(1).unwrap();
    let stored: usize = stored.split(' ').next().unwrap().parse().unwrap();
    assert!((1..1500).contains(&stored), "{told}");
}
