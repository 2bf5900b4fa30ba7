//! Matrices of buildings from files: what is read, and what is refused where.
use std::path::PathBuf;

use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::Case;

fn text(building: &str) -> String {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    format!(
        "[[building]]\nname = \"a\"\nstoreys = 2\nmass = \"40 t\"\nheight = \"3 m\"\ndamping = {{ modal = 0.05 }}\n{building}\n\n[ground_motion]\nfile = \"{record}\"\n"
    )
}

fn assembled(building: &str, csv: &str) -> Result<Assembly, AssemblyError> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("K.csv"), csv).unwrap();
    let file: PathBuf = folder.path().join("case.toml");
    assemble(&Case::parse(&text(building), &file).unwrap())
}

fn periods(assembly: &Assembly) -> Vec<f64> {
    assembly.system.buildings()[0].modes().period.clone()
}

#[test]
fn a_file_is_the_matrix_that_stands_in_it() {
    let typed = assembled("stiffness_matrix = [[2e8, -1e8], [-1e8, 1e8]]", "").unwrap();
    let csv = "# kN/mm\n200, -100\n\n-100,1e2\n";
    let file = "stiffness_matrix = { file = \"K.csv\", unit = \"kN/mm\" }";
    let read = assembled(file, csv).unwrap();
    assert_eq!(periods(&typed), periods(&read));
    // The inverse of this matrix.
    let file = "flexibility_matrix = { file = \"K.csv\", unit = \"mm/kN\" }";
    let flexible = assembled(file, "0.01,0.01\n0.01,0.02\n").unwrap();
    for (a, b) in periods(&typed).iter().zip(periods(&flexible)) {
        assert!((a / b - 1.0).abs() < 1e-13);
    }
    assert!(typed.warnings().is_empty());
}

#[test]
fn entries_that_are_averaged_are_told() {
    let slightly = "stiffness_matrix = [[2e8, -1e8], [-1.000001e8, 1e8]]";
    let warnings = assembled(slightly, "").unwrap().warnings();
    assert!(
        warnings[0].contains("differ by up to 5.0e-6") || warnings[0].contains("means are used")
    );
}

#[test]
fn wrong_matrices_are_refused_at_their_place() {
    let file = "stiffness_matrix = { file = \"K.csv\" }";
    for (building, csv, place, says) in [
        (
            file,
            "1,2\n",
            "\"K.csv\"",
            "K.csv: it has 1 row for 2 floors",
        ),
        (
            file,
            "2e8,-1e8\n-1e8,a\n",
            "\"K.csv\"",
            "line 2, column 2: \"a\" is no number",
        ),
        (
            file,
            "2e8,-1e8\n-1e8,inf\n",
            "\"K.csv\"",
            "\"inf\" is no number",
        ),
        (
            file,
            "2e8,-1e8\n-1e8\n",
            "\"K.csv\"",
            "not square: row 2 has 1 of 2 entries",
        ),
        (
            file,
            "2e8,-1e8\n-1.1e8,1e8\n",
            "\"K.csv\"",
            "not symmetric: row 2, column 1",
        ),
        (
            "stiffness_matrix = { file = \"other.csv\" }",
            "",
            "\"other.csv\"",
            "cannot read the matrix",
        ),
        (
            "stiffness_matrix = { file = \".\" }",
            "",
            "\".\"",
            "this is a folder",
        ),
        (
            "stiffness_matrix = { file = \"/dev/zero\" }",
            "",
            "\"/dev/zero\"",
            "this is no regular file",
        ),
        (
            "stiffness_matrix = [[1e8, -1e8], [-1e8, 1e8]]",
            "",
            "[[1e8, -1e8], [-1e8, 1e8]]",
            "is a support missing",
        ),
        (
            "flexibility_matrix = [[1e-8, 1e-8], [1e-8, 1.00000000000001e-8]]",
            "",
            "[[1e-8, 1e-8], [1e-8, 1.00000000000001e-8]]",
            "round-off",
        ),
        (
            "p_delta = true\nstiffness_matrix = [[2e5, -1e5], [-1e5, 1e5]]",
            "",
            "[[2e5, -1e5], [-1e5, 1e5]]",
            "it cannot stand",
        ),
    ] {
        let AssemblyError::Case(error) = assembled(building, csv).unwrap_err() else {
            panic!("{building}");
        };
        assert!(
            error.message.contains(says),
            "{building}: {}",
            error.message
        );
        assert_eq!(&text(building)[error.span.clone()], place, "{building}");
    }
}

#[test]
fn dashpots_need_storeys() {
    let building = "stiffness_matrix = [[2e8, -1e8], [-1e8, 1e8]]";
    let text = text(building).replace("{ modal = 0.05 }", "{ dashpots = 1e5 }");
    let case = Case::parse(&text, "case.toml".as_ref()).unwrap();
    let AssemblyError::Case(error) = assemble(&case).unwrap_err() else {
        panic!();
    };
    assert!(
        error
            .message
            .contains("with a stiffness matrix or a plan give ratios")
    );
    assert_eq!(&text[error.span.clone()], "{ dashpots = 1e5 }");
}
