//! Buildings that are no chains of storeys: matrices, walls and frames.
use std::path::Path;

use pounding_case::{Case, CaseError, Lateral, MatrixSource};

fn parse(building: &str) -> Result<Case, CaseError> {
    let text = format!(
        "[[building]]\nname = \"a\"\nmass = \"40 t\"\n{building}\n\n[ground_motion]\nfile = \"r.csv\"\n"
    );
    Case::parse(&text, Path::new("case.toml"))
}

/// What one building says, with three storeys of 3 m and modal damping.
fn lateral(text: &str) -> Lateral {
    let more = "height = 3\nstoreys = 3\ndamping = { modal = 0.05 }";
    let case = parse(&format!("{text}\n{more}")).unwrap();
    assert!(case.buildings[0].stiffness.is_empty());
    case.buildings[0].lateral.clone().unwrap().value
}

#[test]
fn every_form_is_read_in_si_units() {
    let rows = "[[\"300 MN/m\", -1e8, 0], [-1e8, 2e8, -1e8], [0, -1e8, \"100 kN/mm\"]]";
    let expected = vec![
        vec![3e8, -1e8, 0.0],
        vec![-1e8, 2e8, -1e8],
        vec![0.0, -1e8, 1e8],
    ];
    let found = lateral(&format!("stiffness_matrix = {rows}"));
    assert_eq!(found, Lateral::Stiffness(MatrixSource::Rows(expected)));

    let found = lateral("flexibility_matrix = { file = \"F.csv\", unit = \"mm/kN\" }");
    let Lateral::Flexibility(MatrixSource::File { file, unit }) = &found else {
        panic!("{found:?}");
    };
    assert_eq!(file.value, Path::new("F.csv"));
    assert!((unit - 1e-6).abs() < 1e-20);

    let found = lateral(
        "cantilever = { flexural_rigidity = [\"6 GN m2\", 5e9, 4e9], shear_rigidity = \"3 GN\" }",
    );
    let expected = Lateral::Cantilever {
        flexural_rigidity: vec![6e9, 5e9, 4e9],
        shear_rigidity: Some(vec![3e9; 3]),
    };
    assert_eq!(found, expected);

    let found = lateral("fishbone = { columns = \"240 MN m2\", beams = 1.5e8, span = \"6 m\" }");
    let expected = Lateral::Fishbone {
        columns: vec![2.4e8; 3],
        beam_stiffness: vec![3e8; 3],
    };
    assert_eq!(found, expected);
}

#[test]
fn elevations_are_heights_from_the_base() {
    let case =
        parse("stiffness = 1e8\nelevations = [4, \"7 m\", 10.5]\ndamping = { modal = 0.05 }");
    assert_eq!(case.unwrap().buildings[0].height, [4.0, 3.0, 3.5]);
}

#[test]
fn files_of_matrices_are_among_those_of_the_case() {
    let case = parse(
        "stiffness_matrix = { file = \"K.csv\" }\nheight = 3\nstoreys = 3\ndamping = { modal = 0.05 }",
    );
    let files = case.unwrap().files();
    assert!(files.contains(&("matrix", "K.csv".into())), "{files:?}");
}

/// Each with what its one error says, and where.
#[test]
fn what_cannot_be_is_refused_once_at_its_place() {
    let rest = "height = 3\ndamping = { modal = 0.05 }";
    for (building, place, says) in [
        ("", "[[building]]", "has no `stiffness`"),
        (
            "stiffness_matrix = [[2e8, -1e8], [-1e8]]",
            "[[2e8, -1e8], [-1e8]]",
            "row 2 has 1 entry for 2 floors",
        ),
        (
            "storeys = 3\nstiffness_matrix = [[2e8, -1e8], [-1e8, 1e8]]",
            "[[2e8, -1e8], [-1e8, 1e8]]",
            "`stiffness_matrix` has 2 rows, but `storeys` says 3 storeys",
        ),
        (
            "stiffness_matrix = [[\"2 m\"]]",
            "\"2 m\"",
            "must be a stiffness (N/m), but \"2 m\" is a length (m)",
        ),
        (
            "flexibility_matrix = [[\"2 kN/mm\"]]",
            "\"2 kN/mm\"",
            "must be a flexibility (m/N)",
        ),
        (
            "storeys = 1\nstiffness = 1e8\nstiffness_matrix = [[1e8]]",
            "[[1e8]]",
            "either `stiffness` or `stiffness_matrix`, not both",
        ),
        (
            "storeys = 2\nstiffness_matrix = { file = \"K.csv\", unit = \"kN\" }",
            "\"kN\"",
            "`unit` must be a stiffness (N/m), but \"kN\" is a force (N)",
        ),
        (
            "storeys = 2\nstiffness_matrix = { file = \"K.csv\", unit = \"\" }",
            "\"\"",
            "`unit` is empty",
        ),
        (
            "storeys = 2\nstiffness_matrix = [[], []]",
            "[[], []]",
            "row 1 has 0 entries for 2 floors",
        ),
        (
            "storeys = 2\nstiffness_matrix = { file = \"\" }",
            "\"\"",
            "`file` is empty",
        ),
        (
            "storeys = 2\nstiffness_matrix = 3",
            "3",
            "must be a list of rows, or a table",
        ),
        (
            "storeys = 2\ncantilever = { flexural_rigidity = [1e9, 1e9, 1e9] }",
            "[1e9, 1e9, 1e9]",
            "3 values where there are 2 storeys",
        ),
        (
            "storeys = 2\ncantilever = { flexural_rigidity = \"6 GN m\" }",
            "\"6 GN m\"",
            "must be a flexural rigidity (N m2)",
        ),
        (
            "storeys = 2\nfishbone = { columns = 1e8, beams = -1, span = 6 }",
            "-1",
            "must be greater than zero",
        ),
        (
            "storeys = 2\nstiffness_matrix = { file = \"K.csv\" }\nlaw = { model = \"bilinear\" }",
            "{ model = \"bilinear\" }",
            "this building has `stiffness_matrix`",
        ),
    ] {
        let text = format!("{building}\n{rest}");
        let error = parse(&text).unwrap_err();
        assert!(
            error.message.contains(says),
            "{building}: {}",
            error.message
        );
        assert!(error.others.is_empty(), "{building}: {:?}", error.others);
        let whole = format!("[[building]]\nname = \"a\"\nmass = \"40 t\"\n{text}");
        assert_eq!(&whole[error.span.clone()], place, "{building}");
        assert!(error.help.is_some());
    }
    for (heights, says) in [
        ("", "has no `height`"),
        (
            "height = 3\nelevations = [3]",
            "either `height` or `elevations`",
        ),
        (
            "elevations = [3, 6, 5]",
            "floor 3 is at 5 m, not above the one below it at 6 m",
        ),
        ("elevations = [3, 3]", "floor 2 is at 3 m"),
    ] {
        // A list says how many storeys there are.
        let storeys = if heights.contains(',') {
            ""
        } else {
            "storeys = 1\n"
        };
        let rest = "stiffness = 1e8\ndamping = { modal = 0.05 }";
        let error = parse(&format!("{storeys}{rest}\n{heights}"));
        let error = error.unwrap_err();
        assert!(error.message.contains(says), "{heights}: {}", error.message);
        assert!(error.others.is_empty(), "{heights}: {:?}", error.others);
    }
}
