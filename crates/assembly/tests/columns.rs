//! Columns that floors of the neighbour hit: what cannot be.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use pounding_assembly::{AssemblyError, assemble};
use pounding_case::{Case, CaseError};

/// A floor at an elevation beside storeys of 3 m and 100 MN/m, of which some columns are hit.
fn text(elevation: f64, column: &str) -> String {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let rest = "mass = \"40 t\"\nstiffness = \"100 MN/m\"\ndamping = { modal = 0.05 }\n";
    format!(
        "[[building]]\nname = \"a\"\nstoreys = 1\nheight = {elevation}\n{rest}[[building]]\nname = \"b\"\nstoreys = 2\nheight = 3\n{rest}[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 0.01\nmodel = \"linear_elastic\"\nstiffness = 1e8\nlevels = \"all_floors\"\ncolumn = {column}\n\n[ground_motion]\nfile = \"{record}\"\n"
    )
}

fn refused(text: &str) -> CaseError {
    let case = Case::parse(text, Path::new("case.toml")).unwrap();
    match assemble(&case) {
        Err(AssemblyError::Case(error)) => error,
        other => panic!("{other:?}"),
    }
}

#[test]
fn columns_that_cannot_be_hit_are_refused_at_their_place() {
    // 12 EI / h^3 = 111 MN/m.
    let stiff = "{ of = \"b\", flexural_rigidity = \"250 MN m2\" }";
    for (elevation, column, place, says, remedy) in [
        (
            4.0,
            stiff,
            stiff,
            "stand in storey 2 of \"b\", which has a stiffness of 100000000 N/m with them",
            "cracked",
        ),
        (
            3.1,
            "{ of = \"b\", flexural_rigidity = 1e8 }",
            "\"all_floors\"",
            "storey 2 of \"b\": the column is hit 0.1 m above",
            "`elevation_tolerance` above their difference of 0.1 m",
        ),
        (
            2.9,
            "{ of = \"b\", flexural_rigidity = 1e8 }",
            "\"all_floors\"",
            "storey 1 of \"b\": the column is hit 2.9 m above the floor below in a storey of 3 m: within 5 %",
            "`elevation_tolerance` above their difference of 0.1 m",
        ),
    ] {
        let text = text(elevation, column);
        let error = refused(&text);
        assert!(error.message.contains(says), "{}", error.message);
        assert_eq!(&text[error.span.clone()], place, "{}", error.message);
        let help = error.help.unwrap();
        assert!(help.contains(remedy), "{help}");
    }
    // A hinge at the upper floor leaves a quarter: 12 becomes 3.
    let hinged = stiff.replace(" }", ", ends = \"pinned\" }");
    let case = Case::parse(&text(4.0, &hinged), Path::new("case.toml")).unwrap();
    if let Err(AssemblyError::Case(error)) = assemble(&case) {
        assert!(!error.message.contains("with them"), "{}", error.message);
    }
}
