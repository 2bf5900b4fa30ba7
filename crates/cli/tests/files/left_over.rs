//! What a killed process left beside an output is named, and stays.

use std::path::Path;
use std::process::Command;

use super::fixture::Fixture;

/// No process of any system has this number.
const DEAD: &str = "999999999-Ab12cd.part";

#[test]
fn part_files_of_killed_processes_are_named() {
    let fixture = Fixture::new();
    // A result without a name is called after its case.
    std::fs::copy(fixture.path("case.toml"), fixture.path("pair.toml")).unwrap();
    let living = format!("{}-Ab12cd.part", std::process::id());
    for (command, output) in [
        ("run case.toml -o new.h5", "new.h5"),
        ("run pair.toml", "pair.h5"),
        (
            "gap case.toml --codes-csv codes.csv --points 0",
            "codes.csv",
        ),
        ("sweep study.toml -o swept.h5", "swept.h5"),
    ] {
        let [dead, living] = [DEAD, &living].map(|end| format!("{output}.{end}"));
        let other = format!("other.h5.{DEAD}");
        for name in [&dead, &living, &other] {
            std::fs::write(fixture.path(name), "half").unwrap();
        }
        let said = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .current_dir(fixture.path("."))
            .args(command.split_whitespace())
            .output()
            .unwrap();
        let code = said.status.code();
        let said = String::from_utf8_lossy(&said.stderr).into_owned();
        assert!(matches!(code, Some(0 | 1)), "{command}: {said}");
        let note = format!("note: {dead} is an unfinished file of process 999999999");
        assert_eq!(
            said.matches("unfinished file").count(),
            1,
            "{command}: {said}"
        );
        assert!(said.contains(&note), "{command}: {said}");
        assert!(said.contains("delete it"), "{said}");
        for name in [&dead, &living, &other] {
            assert!(Path::new(&fixture.path(name)).exists(), "{command}: {name}");
            std::fs::remove_file(fixture.path(name)).unwrap();
        }
    }
}
