//! Cases that code changes before they are run.

use std::path::PathBuf;

use pounding::case::{Case, Side};
use pounding::prelude::*;

use crate::root;

fn file() -> PathBuf {
    root().join("examples/three_storey_pair/case.toml")
}

fn text() -> String {
    std::fs::read_to_string(file()).unwrap()
}

/// What code changes is what the text would have said, to the last bit; the text says that it does not.
#[test]
fn a_changed_case_is_that_of_its_text() {
    let mut case = Case::parse(&text(), &file()).unwrap();
    let unchanged = Model::of_case(&case).unwrap();
    let read = Model::read(file()).unwrap();
    assert_eq!(unchanged.run().unwrap(), read.run().unwrap());
    assert_eq!(unchanged.source(), text());
    assert_eq!(unchanged.title(), read.title());
    for level in &mut case.gaps[0].levels {
        level.width = 0.03;
    }
    case.title = "Thirty millimetres".to_owned();
    let changed = Model::of_case(&case).unwrap();
    let thirty = text().replace("\"20 mm\"", "\"30 mm\"");
    assert_ne!(thirty, text());
    let thirty = Case::parse(&thirty, &file()).unwrap();
    let written = Model::of_case(&thirty).unwrap();
    let outcome = changed.run().unwrap();
    assert_eq!(outcome, written.run().unwrap());
    assert_ne!(outcome, read.run().unwrap());
    assert_eq!(changed.title(), "Thirty millimetres");
    let source = changed.source();
    assert!(source.starts_with(text().trim_end()), "{source}");
    let end = source.trim_end().lines().last().unwrap();
    assert!(end.starts_with("# A program changed"), "{end}");
    assert!(Case::parse(source, &file()).is_ok());
}

/// What a case file names is not replaced, and what nothing uses is said.
#[test]
fn a_changed_case_keeps_its_files_and_warnings() {
    let unused = format!("{}\nbeta = 0.3\n", text());
    let mut case = Case::parse(&unused, &file()).unwrap();
    case.analysis.duration = Some(2.0);
    let model = Model::of_case(&case).unwrap();
    let outcome = model.run().unwrap();
    assert_eq!(outcome.end_time, 2.0);
    let said = model.warnings(&outcome).join("\n");
    assert!(said.contains("`beta`"), "{said}");
    for path in [file(), root().join("ground_motions/el_centro_1940_ns.csv")] {
        let error = model.run_to_file(&path).unwrap_err();
        assert!(matches!(error, Error::FileUse(_)), "{error}");
    }
}

/// A change that cannot be is an error, as is a text that cannot be read.
#[test]
fn changes_that_cannot_be_are_errors() {
    let refused = |change: fn(&mut Case)| {
        let mut case = Case::parse(&text(), &file()).unwrap();
        change(&mut case);
        let model = Model::of_case(&case);
        model.map(|_| ()).unwrap_err().to_string()
    };
    for (change, said) in [
        (
            (|case| case.gaps[0].levels[1].width = -0.01) as fn(&mut Case),
            "width is -0.01 m",
        ),
        (|case| case.buildings[0].mass[1] = f64::NAN, "mass = NaN"),
        (|case| case.buildings[0].mass.truncate(2), "for 2 storeys"),
        (|case| case.buildings.truncate(1), "does not have"),
        (
            |case| case.gaps[0].between = [Side::Wall, Side::Wall],
            "wall",
        ),
        (|case| case.analysis.duration = Some(-1.0), "duration"),
        (|case| case.gaps[0].model.value.push('x'), "jankowski_2005x"),
    ] {
        let error = refused(change);
        assert!(error.contains(said), "{error}");
    }
    let error = Case::parse("title = 3", &file()).map_err(Error::from);
    assert!(error.unwrap_err().help().is_some());
}
