//! Tables of the command line as they are read, by snapshots in `snapshots/`. After a change
//! that is meant: `INSTA_UPDATE=always cargo test -p pounding-cli --test integration tables`, and
//! read the difference.
use std::path::Path;
use std::process::Command;

/// What the program writes on standard output, started at the root of the repository.
fn written(arguments: &[&str], code: i32) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        // By which help is wrapped.
        .env_remove("COLUMNS")
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .output()
        .unwrap();
    let failed = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{failed}");
    String::from_utf8(output.stdout).unwrap()
}

/// Without what changes from one machine, version or run to another: the number between the two
/// texts becomes `...`, wherever they stand in a line.
fn without(text: &str, before: &str, after: &str) -> String {
    let line = |line: &str| -> Option<String> {
        let from = line.find(before)? + before.len();
        let to = from + line[from..].find(after)?;
        Some(format!("{}...{}", &line[..from], &line[to..]))
    };
    let lines = text.lines();
    lines
        .map(|l| line(l).unwrap_or_else(|| l.to_owned()) + "\n")
        .collect()
}

#[test]
fn help() {
    insta::assert_snapshot!(written(&["--help"], 0));
}

#[test]
fn check() {
    insta::assert_snapshot!(written(
        &["check", "examples/three_storey_pair/case.toml"],
        0
    ));
}

#[test]
fn run() {
    let case = "examples/three_storey_pair/case.toml";
    let text = written(&["run", case, "--no-output"], 0);
    let text = without(&text, "residual ", " of the largest input");
    insta::assert_snapshot!(without(&text, " events; ", " s"));
}

#[test]
fn gap() {
    let case = "examples/gap_check/case.toml";
    insta::assert_snapshot!(written(&["gap", case, "--records", "ground_motions"], 1));
}

/// A pair with small masses and stiffnesses under a millionth of a record: nothing of it is shown as
/// a zero that it is not.
#[test]
fn small_numbers_are_no_zeros() {
    let folder = tempfile::tempdir().unwrap();
    let records = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ground_motions");
    let building = |name: &str, mass: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 1\nmass = {mass}\nstiffness = 1e-3\nheight = \"3 m\"\n\
             damping = {{ stiffness_proportional = 0.05 }}\n"
        )
    };
    let case = format!(
        "{}{}[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 1e-9\nmodel = \"linear_elastic\"\nstiffness = 1e2\n\
         [ground_motion]\nfile = '{}'\nscale = 1e-6\n[analysis]\nduration = \"5 s\"\n",
        building("a", "2e-6"),
        building("b", "8e-6"),
        records.join("el_centro_1940_ns.csv").display()
    );
    let path = folder.path().join("case.toml");
    std::fs::write(&path, case).unwrap();
    let text = written(&["run", &path.display().to_string(), "--no-output"], 0);
    assert!(text.contains("peak 3.13e-6 m/s2 = 3.19e-7 g"), "{text}");
    assert!(text.contains(" 1.00e-6 "), "{text}");
    // What round-off leaves of the energy of an elastic law may look like none.
    let buildings = text.split("Gap a-b").next().unwrap();
    let rows = buildings.lines().filter(|line| line.starts_with('|'));
    let numbers = rows.flat_map(|line| line.split(|c: char| c.is_whitespace() || c == '|'));
    let zeros = numbers.filter(|n| n.contains("0.0") && n.bytes().all(|b| b == b'0' || b == b'.'));
    assert_eq!(zeros.count(), 0, "{text}");
}
