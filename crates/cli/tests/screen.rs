//! What the program says of itself and of its work: `--version --json`, `-v`, `RUST_LOG`, `--color`, and the
//! manual pages.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pounding(arguments: &[&str], environment: &[(&str, &str)]) -> Output {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("pounding"));
    command.current_dir(root()).args(arguments);
    for key in ["NO_COLOR", "RUST_LOG", "CLICOLOR_FORCE", "FORCE_COLOR"] {
        command.env_remove(key);
    }
    command.envs(environment.iter().copied()).output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

const CASE: &str = "examples/three_storey_pair/case.toml";
const ESCAPE: &str = "\u{1b}[";

#[test]
fn versions() {
    let plain = pounding(&["--version"], &[]);
    let expected = format!("pounding {}\n", env!("CARGO_PKG_VERSION"));
    assert_eq!(String::from_utf8_lossy(&plain.stdout), expected);
    for words in [["--version", "--json"], ["--json", "-V"]] {
        let output = pounding(&words, &[]);
        assert!(output.status.success(), "{}", told(&output));
        let version: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(version["version"], env!("CARGO_PKG_VERSION"));
        let target = version["target"].as_str().unwrap();
        assert!(target.contains(std::env::consts::ARCH), "{target}");
        // That of the library that these tests are linked with, too.
        let (major, minor, release) = hdf5::library_version();
        assert_eq!(version["hdf5"], format!("{major}.{minor}.{release}"));
        let features = version["features"].as_array().unwrap();
        assert_eq!(
            features.iter().any(|f| f == "static"),
            cfg!(feature = "static")
        );
        // Forty digits, or none outside of a repository.
        match version["commit"].as_str() {
            Some(commit) => {
                assert!(
                    commit.len() == 40 && commit.bytes().all(|b| b.is_ascii_hexdigit()),
                    "{commit}"
                );
            }
            None => assert!(version["commit"].is_null()),
        }
    }
    assert_eq!(pounding(&["--json"], &[]).status.code(), Some(2));
    assert_eq!(pounding(&["--color", "never"], &[]).status.code(), Some(2));
}

/// Help that cannot be written is an output that failed; a reader who has seen enough is none.
#[cfg(target_os = "linux")]
#[test]
fn help_that_cannot_be_written() {
    for words in [&["--help"][..], &["run", "--help"], &["help", "sweep"]] {
        let full = std::fs::File::create("/dev/full").unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(words)
            .stdout(full)
            .output()
            .unwrap();
        assert_eq!(
            output.status.code(),
            Some(4),
            "{words:?}: {}",
            told(&output)
        );
        assert!(
            told(&output).contains("standard output"),
            "{}",
            told(&output)
        );
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let closed = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(words)
            .stdout(writer)
            .status()
            .unwrap();
        assert_eq!(closed.code(), Some(0), "{words:?}");
    }
    assert_eq!(pounding(&["--help"], &[]).status.code(), Some(0));
}

/// Steps of the work with their times go to standard error; the answer is the same to the bit.
#[test]
fn an_account_of_the_work() {
    let words = ["run", CASE, "--no-output", "--json"];
    let quiet = pounding(&words, &[]);
    assert!(quiet.status.success());
    assert_eq!(told(&quiet), "");
    let once = pounding(&[&words[..], &["-v"]].concat(), &[]);
    assert_eq!(once.stdout, quiet.stdout);
    let account = told(&once);
    for step in ["read_record", "assemble", "integrate", "write"] {
        let of_step = |l: &str| l.contains(step) && l.contains("time.busy");
        assert!(account.lines().any(of_step), "{step}: {account}");
    }
    assert!(!account.contains("DEBUG"), "{account}");
    let twice = pounding(&[&["-vv"], &words[..]].concat(), &[]);
    assert_eq!(twice.stdout, quiet.stdout);
    let account = told(&twice);
    assert!(
        account.contains("DEBUG") && account.contains("samples=1559"),
        "{account}"
    );
    // The environment goes before the option.
    let chosen = pounding(
        &[&words[..], &["-vv"]].concat(),
        &[("RUST_LOG", "pounding_assembly=info")],
    );
    let account = told(&chosen);
    assert!(
        account.contains("assemble") && !account.contains("integrate"),
        "{account}"
    );
    let wrong = pounding(&words, &[("RUST_LOG", "a=b=c")]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(told(&wrong).contains("RUST_LOG=a=b=c"), "{}", told(&wrong));
}

/// No stream here is a terminal: colour is there where it is asked for, and nowhere else.
#[test]
fn colour() {
    let bad_case: &[&str] = &["check", "no_such_case.toml"];
    let bad_argument: &[&str] = &["run", "--no-such-option"];
    let help: &[&str] = &["--help"];
    for words in [bad_case, bad_argument, help] {
        let shown = |option: &[&str], environment: &[(&str, &str)]| {
            let output = pounding(&[option, words].concat(), environment);
            format!(
                "{}{}",
                told(&output),
                String::from_utf8_lossy(&output.stdout)
            )
        };
        assert!(!shown(&[], &[]).contains(ESCAPE), "{words:?}");
        assert!(
            shown(&["--color", "always"], &[]).contains(ESCAPE),
            "{words:?}"
        );
        // The option goes before the environment.
        assert!(
            shown(&["--color=always"], &[("NO_COLOR", "1")]).contains(ESCAPE),
            "{words:?}"
        );
        assert!(
            !shown(&["--color=never"], &[("CLICOLOR_FORCE", "1")]).contains(ESCAPE),
            "{words:?}"
        );
    }
    let account = pounding(&["-v", "--color", "always", "check", CASE], &[]);
    assert!(told(&account).contains(ESCAPE));
}

/// A page for the program and for each command, which names all its options.
#[test]
fn manual_pages() {
    fn pages(command: &clap::Command, name: &str, folder: &Path, count: &mut usize) {
        let page = std::fs::read_to_string(folder.join(format!("{name}.1"))).unwrap();
        assert!(page.contains(&format!(".TH {name} 1")), "{name}");
        let plain = page.replace('\\', "");
        let options = command.get_arguments().filter(|a| !a.is_hide_set());
        for option in options.filter_map(clap::Arg::get_long) {
            assert!(plain.contains(&format!("--{option}")), "{name}: {option}");
        }
        *count += 1;
        for sub in command.get_subcommands().filter(|c| !c.is_hide_set()) {
            pages(sub, &format!("{name}-{}", sub.get_name()), folder, count);
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("man");
    let output = pounding(&["man", "--pages", &path.display().to_string()], &[]);
    assert!(output.status.success(), "{}", told(&output));
    let mut count = 0;
    pages(&pounding_cli::command(), "pounding", &path, &mut count);
    assert!(count > 30, "{count}");
    assert_eq!(std::fs::read_dir(&path).unwrap().count(), count);
}

/// Messages are as wide as tables: a path is not cut in two where there is room.
#[test]
fn messages_are_as_wide_as_the_terminal() {
    let path = format!("{}.toml", "long/".repeat(20));
    let whole =
        |columns: &str| told(&pounding(&["check", &path], &[("COLUMNS", columns)])).contains(&path);
    assert!(whole("200") && !whole("80"));
}
