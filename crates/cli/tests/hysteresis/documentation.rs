//! The page `docs/reference/yielding-storeys-and-links.md`: the commands of its laboratory run as printed, in their
//! order.

use std::path::Path;
use std::process::Command;

/// The laws that the page excepts from the exact steps of `event_driven` are those whose branches are not
/// straight, or, as the examples of the registry have it, a damper with a power of the velocity.
#[test]
fn laws_of_event_driven_are_those_of_the_code() {
    let page = include_str!("../../../../docs/reference/yielding-storeys-and-links.md");
    let row = page.lines().find(|l| l.starts_with("| `event_driven` |"));
    let (_, excepted) = row.unwrap().split_once("With a curved law").unwrap();
    for law in pounding_hysteresis::descriptors() {
        let built = pounding_hysteresis::build(law.name, &law.example_parameters()).unwrap();
        assert_eq!(
            excepted.contains(&format!("`{}`", law.name)),
            !built.is_piecewise_linear(),
            "{}",
            law.name
        );
    }
}

/// Runs the indented lines of the page in a shell, with the program at hand first.
#[cfg(unix)]
#[test]
fn commands_of_the_page_run_as_printed() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../docs/reference/yielding-storeys-and-links.md");
    let page = std::fs::read_to_string(page).unwrap();
    let (_, laboratory) = page.split_once("## The laboratory").unwrap();
    let (laboratory, _) = laboratory.split_once("\n## ").unwrap();
    let commands: Vec<_> = laboratory
        .lines()
        .filter_map(|line| line.strip_prefix("    "))
        .collect();
    assert_eq!(commands.len(), 5);
    let folder = tempfile::tempdir().unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_pounding"));
    let mut search = vec![program.parent().unwrap().to_owned()];
    search.extend(std::env::split_paths(&std::env::var_os("PATH").unwrap()));
    for command in commands {
        let output = Command::new("sh")
            .args(["-c", command])
            .env("PATH", std::env::join_paths(&search).unwrap())
            .current_dir(folder.path())
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{command}: {errors}");
    }
    for name in ["loop.svg", "history.csv", "curve.csv"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
}
