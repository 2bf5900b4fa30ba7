//! What a case gives and nothing feels is told before a run.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::Case;

fn warnings(building: &str, gap: &str) -> Vec<String> {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let common = "mass = [1e5, 1e5]\nheight = 3\nstiffness = 1e8\ndamping = { modal = 0.05 }";
    let text = format!(
        "[[building]]\nname = \"a\"\n{common}\n{building}\n[[building]]\nname = \"b\"\n{common}\n[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = 1e8\n{gap}\n[ground_motion]\nfile = \"{record}\"\nscale = 2\n"
    );
    let case = Case::parse(&text, Path::new("case.toml")).unwrap();
    assemble(&case).unwrap().warnings()
}

#[test]
fn soil_as_stiff_as_a_fixed_base_is_told() {
    let soil = |speed: &str| {
        format!(
            "foundation = {{ mass = 5e4, rotational_inertia = 3e6, soil = {{ shear_wave_speed = {speed}, density = 1800, poisson = 0.33, length = 12, width = 12 }} }}"
        )
    };
    let told = warnings(&soil("1e5"), "");
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("a: the soil makes the fundamental period longer by"),
        "{told:?}"
    );
    assert!(told[0].contains("leave the foundation out"), "{told:?}");
    assert_eq!(warnings(&soil("180"), ""), [""; 0]);
    assert_eq!(warnings(&soil("1500"), ""), [""; 0]);
}

#[test]
fn columns_that_no_floor_hits_are_told() {
    let column = "column = { of = \"b\", flexural_rigidity = 1e6 }";
    let told = warnings("", column);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("gap a-b: no floor hits columns of b"),
        "{told:?}"
    );
    assert!(told[0].contains("`levels = \"all_floors\"`"), "{told:?}");
    assert_eq!(warnings("", ""), [""; 0]);
}

/// Zeros that filters put before records: 0.75 times 4 over the corner, 30 s at 0.1 Hz and 15 s at 0.2 Hz.
#[test]
fn motions_that_filters_put_out_of_step_are_told() {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let filter = |corner: &str, more: &str| {
        format!("process = [{{ filter = {{ high_pass = \"{corner}\", order = 4{more} }} }}]")
    };
    let case = |of_case: &str, building: &str| {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = [1e5, 1e5]\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n{building}\n[ground_motion]\nfile = \"{record}\"\n{of_case}\n"
        );
        let case = Case::parse(&text, Path::new("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        told.into_iter()
            .filter(|w| w.contains("zeros"))
            .collect::<Vec<_>>()
    };
    let own = |steps: &str| format!("ground = {{ file = \"{record}\", {steps} }}");
    let (low, high) = (filter("0.1 Hz", ""), filter("0.2 Hz", ""));
    let told = case(&low, &own(&high));
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains(
            "30.00 s of zeros before the record of the case, and 15.00 s before that of a"
        ),
        "{told:?}"
    );
    assert_eq!(case(&low, &own(&low)), [""; 0]);
    let without = filter("0.1 Hz", ", keep_pads = false");
    assert_eq!(case(&without, &own("process = []")), [""; 0]);
    assert_eq!(case(&low, &own("process = []")).len(), 1);
    let force = "[[building.force]]\nstorey = 1\npoints = [[0, 0], [1, 1e3], [2, 0]]";
    let told = case(&low, force);
    assert!(
        told.len() == 1 && told[0].contains("forces on floors begin with them"),
        "{told:?}"
    );
    assert_eq!(case(&without, force), [""; 0]);
}

/// A sine whose velocity at the first sample is stated moves nowhere; displacements of the ground from rest have it drift by
/// that velocity.
#[test]
fn initial_motions_that_displacements_of_the_ground_leave_out_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let rate = 2.0 * std::f64::consts::PI;
    let write = |name: &str, head: &str, amplitude: f64| {
        let mut text = format!("{head}time_s,acceleration_m_s2\n");
        for i in 0..=1000 {
            let t = 0.01 * f64::from(i);
            text.push_str(&format!("{t:.2},{:.9}\n", -amplitude * (rate * t).sin()));
        }
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    let stated = format!("# Initial velocity: {:.9} m/s\n", 1.0 / rate);
    write("moving.csv", &stated, 1.0);
    write("still.csv", "", 1.0);
    write("again.csv", &stated, 0.5);
    let told = |of_case: &str, of_building: &str| {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = 1e5\nstoreys = 1\nheight = 3\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\nground = {{ file = \"{of_building}\" }}\n[ground_motion]\nfile = \"{of_case}\"\n"
        );
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let told = assemble(&case).unwrap().warnings();
        let of_them = told.into_iter().filter(|w| w.contains("states an initial"));
        of_them.collect::<Vec<_>>()
    };
    let said = told("moving.csv", "still.csv");
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].contains("the record of the case states"),
        "{said:?}"
    );
    assert!(
        said[0].contains("leave them out, 1.592 m at the end"),
        "{said:?}"
    );
    let said = told("still.csv", "moving.csv");
    assert!(
        said.len() == 1 && said[0].contains("the record of a states"),
        "{said:?}"
    );
    assert_eq!(told("moving.csv", "again.csv"), [""; 0]);
    assert_eq!(told("still.csv", "still.csv"), [""; 0]);
}
