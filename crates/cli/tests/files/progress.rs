//! How far a command is, where there is no terminal.

use std::io::{BufRead, BufReader};
use std::process::Stdio;

use super::fixture::{Fixture, message};

/// A short command says nothing.
#[test]
fn short_commands_are_silent() {
    let fixture = Fixture::new();
    for words in [
        "run case.toml -o a.h5",
        "gap case.toml --points 3",
        "compare case.toml --models anagnostopoulos_2004",
        "sweep study.toml -o b.h5",
        "ida study.toml -o c.h5",
        "check case.toml",
    ] {
        let silent = fixture.run(&words.split_whitespace().collect::<Vec<_>>());
        assert!(silent.stderr.is_empty(), "{words}: {}", message(&silent));
    }
}

/// `check` cannot say how far it is, but that it works.
#[test]
fn modes_of_tall_buildings_are_computed_aloud() {
    let fixture = Fixture::new();
    let case = std::fs::read_to_string(fixture.path("case.toml")).unwrap();
    let case = case.replace("storeys = 1\n", "storeys = 400\n");
    std::fs::write(fixture.path("tall.toml"), case).unwrap();
    let mut command = fixture.command(&["check", "tall.toml"]);
    command.env("POUNDING_PROGRESS_SECONDS", "0.01");
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", message(&output));
    let said = message(&output);
    assert!(said.starts_with("computing the modes of"), "{said}");
    assert!(said.contains("storeys, 0 s elapsed"), "{said}");
}

/// Every value of a list is tried in the case before the first run, which takes a while where they are many.
#[test]
fn long_studies_are_read_aloud() {
    let fixture = Fixture::new();
    let widths: Vec<String> = (1..500).map(|i| format!("\"{i} mm\"")).collect();
    let study = format!(
        "case = \"case.toml\"\n[[variable]]\nname = \"width\"\npath = \"gap.0.width\"\nvalues = [{}]\n",
        widths.join(", ")
    );
    std::fs::write(fixture.path("study.toml"), study).unwrap();
    let mut command = fixture.command(&["sweep", "study.toml", "--show", "7"]);
    command.env("POUNDING_PROGRESS_SECONDS", "0.01");
    let output = command.output().unwrap();
    let said = message(&output);
    assert!(output.status.success(), "{said}");
    assert!(
        said.starts_with("reading study.toml, 0 s elapsed"),
        "{said}"
    );
}

/// A long one says how far it is, line by line, on the stream of errors; here every
/// hundredth of a second.
#[test]
fn lines_of_progress_come_where_there_is_no_terminal() {
    let fixture = Fixture::new();
    fixture.with_long_case();
    for (words, part) in [
        ("run long.toml -o a.h5", " %, "),
        ("gap long.toml", " runs ("),
        ("compare long.toml", " runs ("),
        (
            "sweep long-study.toml -o b.h5 --threads 1",
            "0 of 8 runs (0 %)",
        ),
        (
            "ida long-study.toml -o c.h5 --threads 1",
            "0 of 8 runs (0 %)",
        ),
    ] {
        let mut child = fixture
            .command(&words.split_whitespace().collect::<Vec<_>>())
            .env("POUNDING_PROGRESS_SECONDS", "0.01")
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut lines = BufReader::new(child.stderr.take().unwrap()).lines();
        for _ in 0..3 {
            let line = lines.next().unwrap().unwrap();
            // Before it is known how many there are, there are none.
            let before = ["no run begun", "reading long-study.toml"];
            let begun = before.iter().any(|b| line.starts_with(b)) || line.contains(part);
            assert!(begun && line.contains(" s elapsed"), "{words}: {line}");
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
}

#[test]
fn a_time_between_lines_is_a_time() {
    let fixture = Fixture::new();
    for text in ["soon", "0", "-1", "nan", "1e300"] {
        let mut command = fixture.command(&["run", "case.toml", "-o", "a.h5"]);
        let refused = command
            .env("POUNDING_PROGRESS_SECONDS", text)
            .output()
            .unwrap();
        let told = message(&refused);
        assert_eq!(refused.status.code(), Some(2), "{told}");
        let wanted = format!("POUNDING_PROGRESS_SECONDS={text} is no time");
        assert!(told.contains(&wanted) && told.contains("300"), "{told}");
    }
}
