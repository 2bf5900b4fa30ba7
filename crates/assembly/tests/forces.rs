//! Files of forces: what is refused where. What they do is held against closed forms in
//! `tests/tests/structures/forces.rs`.
#![allow(clippy::unwrap_used)]

use pounding_assembly::{AssemblyError, assemble};
use pounding_case::Case;

fn refused(force: &str, csv: &str) -> (String, String, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("f.csv"), csv).unwrap();
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let text = format!(
        "[[building]]\nname = \"a\"\nstoreys = 2\nmass = \"40 t\"\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n[[building.force]]\nstorey = 1\n{force}\n[ground_motion]\nfile = \"{record}\"\n"
    );
    let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
    match assemble(&case) {
        Err(AssemblyError::Case(e)) => {
            let place = text[e.span.clone()].to_owned();
            (e.message.clone(), e.help.clone().unwrap_or_default(), place)
        }
        other => panic!("{force}: {other:?}"),
    }
}

#[test]
fn forces_that_cannot_be_read_are_refused_at_their_place() {
    let file = "file = \"f.csv\"";
    for (force, csv, says, remedy) in [
        (file, "", "it holds no numbers", "one line per point"),
        (
            file,
            "t,F\n0,1\nx,2\n",
            "line 3, column 1: \"x\" is no number",
            "the time (s) first",
        ),
        (
            file,
            "0,1\n1\n",
            "row 2 of its numbers has 1 column",
            "`time_step`",
        ),
        (
            file,
            "0,1\n2,3\n1,4\n",
            "the time 1 s stands after 2 s",
            "in their order",
        ),
        (file, "0,1\n0,3\n0,4\n", "three points at 0 s", "a jump"),
        (file, "-1,1\n", "a point at -1 s", ""),
        (file, "0,inf\n", "\"inf\" is no number", ""),
        (
            "file = \"g.csv\"",
            "",
            "cannot read the force history",
            "relative to the folder",
        ),
        (
            "file = \".\"",
            "",
            "this is a folder",
            "relative to the folder",
        ),
        (
            "file = \"f.csv\"\ncolumn = 4",
            "0,1\n",
            "has 2 columns, and the force is in column 4",
            "`column`",
        ),
    ] {
        let (message, help, place) = refused(force, csv);
        assert!(message.contains(says), "{csv}: {message}");
        assert!(help.contains(remedy), "{csv}: {help}");
        assert!(force.contains(&place), "{place}");
    }
    let points = "points = [[2, 1], [1, 1]]";
    let (message, _, place) = refused(points, "");
    assert!(
        message.contains("the time 1 s stands after 2 s"),
        "{message}"
    );
    assert_eq!(place, "[[2, 1], [1, 1]]");
}
