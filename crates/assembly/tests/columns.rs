//! Columns that floors of the neighbour hit: what cannot be.
use std::path::Path;

use pounding_assembly::{AssemblyError, assemble};
use pounding_case::{Case, CaseError};
use pounding_time_history::System;

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
    let system = assembled(&text(4.0, &hinged));
    assert_eq!(system.level_responses().count(), 4);
    // No moment at a hinge.
    let mut names = system.level_responses().map(|(_, r)| r.name.as_str());
    assert!(names.all(|name| name != "column_moment_top"));
}

fn assembled(text: &str) -> System {
    let case = Case::parse(text, Path::new("case.toml")).unwrap();
    assemble(&case).unwrap().system
}

/// What stands in the matrices: the storey stays as it is, the column is added.
#[test]
fn a_contact_mass_is_a_coordinate_of_the_building() {
    let column = "{ of = \"b\", flexural_rigidity = 1e8, contact_mass = \"2 t\" }";
    let plain = assembled(&text(4.0, "{ of = \"b\", flexural_rigidity = 1e8 }"));
    let system = assembled(&text(4.0, column));
    let hit = &system.buildings()[1];
    assert_eq!((hit.storeys(), hit.coordinates()), (2, 3));
    assert_eq!(plain.buildings()[1].coordinates(), 2);
    let (a, b, h) = (1.0_f64, 2.0_f64, 3.0_f64);
    let k_c = 3.0 * 1e8 * h.powi(3) / (a * b).powi(3);
    let upper = 3.0 / 9.0 - 2.0 / 27.0;
    let t = [-(1.0 - upper), -upper, 1.0];
    let k = hit.stiffness_matrix();
    for i in 0..3 {
        for j in 0..3 {
            let storeys = match (i, j) {
                (0, 0) => 2e8,
                (1, 1) => 1e8,
                (0, 1) | (1, 0) => -1e8,
                _ => 0.0,
            };
            let expected = storeys + k_c * t[i] * t[j];
            let error = (k.entry(i, j) - expected).abs();
            assert!(error < 1e-12 * k_c, "{i} {j}: {error:e}");
        }
    }
    assert_eq!(hit.stiffness(), plain.buildings()[1].stiffness());
    // The mass of the point against the floor, and without it that of all three floors.
    let light = system.levels()[0].effective_mass;
    assert!((light - 1.0 / (1.0 / 2e3 + 1.0 / 4e4)).abs() < 1e-9);
    let [lower, upper] = [1.0 - upper, upper];
    let expected = 1.0 / (1.0 + lower * lower + upper * upper) * 4e4;
    assert!((plain.levels()[0].effective_mass / expected - 1.0).abs() < 1e-12);
    let behind = plain.levels()[0].model.spring_behind().unwrap();
    assert!((behind / k_c - 1.0).abs() < 1e-12);
}

/// Gravity, and a matrix in the place of storeys, stay what they are without the point.
#[test]
fn buildings_of_all_kinds_have_points() {
    let with_mass = "{ of = \"b\", flexural_rigidity = 1e8, contact_mass = \"2 t\" }";
    let without = "{ of = \"b\", flexural_rigidity = 1e8 }";
    let matrix = "name = \"b\"\nstiffness_matrix = [[2e8, -1e8], [-1e8, 1e8]]";
    let by_matrix = |column: &str| {
        let (before, after) = text(4.0, column)
            .split_once("name = \"b\"")
            .map(|(a, b)| (a.to_owned(), b.to_owned()))
            .unwrap();
        format!(
            "{before}{matrix}{}",
            after.replacen("stiffness = \"100 MN/m\"\n", "", 1)
        )
    };
    let under_gravity =
        |column: &str| text(4.0, column).replace("name = \"b\"", "name = \"b\"\np_delta = true");
    let bow = {
        let plain = assembled(&text(4.0, without));
        let hit = assembled(&text(4.0, with_mass));
        let [plain, hit] = [&plain, &hit].map(|s| s.buildings()[1].stiffness_matrix().clone());
        move |i: usize, j: usize| hit.entry(i, j) - plain.entry(i, j)
    };
    for (plain, hit) in [
        (by_matrix(without), by_matrix(with_mass)),
        (under_gravity(without), under_gravity(with_mass)),
    ] {
        let [plain, hit] = [plain, hit].map(|text| assembled(&text));
        let [plain, hit] = [&plain, &hit].map(|s| &s.buildings()[1]);
        for i in 0..2 {
            for j in 0..2 {
                let added =
                    hit.stiffness_matrix().entry(i, j) - plain.stiffness_matrix().entry(i, j);
                assert!((added - bow(i, j)).abs() < 1e-6 * bow(0, 0).abs());
            }
        }
        assert_eq!(hit.geometric_stiffness(), plain.geometric_stiffness());
        assert_eq!(hit.stiffness(), plain.stiffness());
        assert_eq!(
            hit.elastic_stiffness_matrix(),
            plain.elastic_stiffness_matrix()
        );
        match (plain.section_forces(), hit.section_forces()) {
            (None, None) => assert!(!hit.stiffness().is_empty()),
            (Some(plain), Some(hit)) => {
                for (plain, hit) in plain.iter().zip(&hit) {
                    assert_eq!([plain.as_slice(), &[0.0]].concat(), *hit);
                }
            }
            other => panic!("{other:?}"),
        }
    }
}

/// What the formulation cannot do, each with a remedy.
#[test]
fn combinations_that_cannot_be_are_refused() {
    let column = "{ of = \"b\", flexural_rigidity = 1e8 }";
    let with_mass = "{ of = \"b\", flexural_rigidity = 1e8, contact_mass = \"2 t\" }";
    let elastic = "model = \"linear_elastic\"\nstiffness = 1e8";
    let dissipative = "model = \"anagnostopoulos_2004\"\nstiffness = 1e8\nrestitution = 0.65";
    let yielding = "name = \"b\"\nlaw = [{ model = \"elastic_perfectly_plastic\", storeys = [STOREY], yield_force = \"1 MN\" }]";
    let yields = |storey: &str| yielding.replace("STOREY", storey);
    let founded = "name = \"b\"\nfoundation = { mass = \"50 t\", rotational_inertia = 1e6, soil = { shear_wave_speed = 200, density = 1800, poisson = 0.3, length = 10, width = 10 } }";
    let name = "name = \"b\"";
    for (column, from, to, says, remedy) in [
        (
            column,
            elastic,
            dissipative.to_owned(),
            "the columns that are hit have no mass: model anagnostopoulos_2004 cannot stand in series",
            "add `contact_mass`",
        ),
        (
            column,
            elastic,
            "model = \"stereomechanical\"\nrestitution = 0.65".to_owned(),
            "model stereomechanical cannot stand in series",
            "linear_elastic",
        ),
        (
            column,
            name,
            yields("2"),
            "storey 2 of \"b\" follows the law",
            "stay linear",
        ),
        (
            with_mass,
            name,
            yields("1"),
            "which a building with a `contact_mass`",
            "leave out `contact_mass`",
        ),
        (
            column,
            name,
            founded.to_owned(),
            "stands on a foundation",
            "leave out `foundation`",
        ),
    ] {
        let text = text(4.0, column).replace(from, to.as_str());
        let error = refused(&text);
        let told = format!("{error:?}");
        let mut all = error.each();
        let found = all.find(|e| e.message.contains(says));
        let help = found.unwrap_or_else(|| panic!("{told}")).help.unwrap();
        assert!(help.contains(remedy), "{help}");
    }
    // Where another storey yields, or with a mass, these can be.
    assembled(&text(4.0, column).replace(name, &yields("1")));
    assembled(&text(4.0, with_mass).replace(elastic, dissipative));
}

/// Two floors in one storey of the neighbour: one column with two points.
#[test]
fn two_floors_hit_one_column() {
    let two = |column: &str| {
        text(3.9, column).replace(
            "storeys = 1\nheight = 3.9",
            "storeys = 2\nheight = [3.9, 1.2]",
        )
    };
    let error = refused(&two("{ of = \"b\", flexural_rigidity = 1e8 }"));
    assert!(
        error
            .message
            .contains("2 floors hit the columns of storey 2 of \"b\"")
    );
    assert!(error.help.unwrap().contains("`contact_mass`"));
    let system = assembled(&two(
        "{ of = \"b\", flexural_rigidity = 1e8, contact_mass = 2000 }",
    ));
    assert_eq!(system.buildings()[1].coordinates(), 4);
    assert_eq!(system.level_responses().count(), 10);
}

/// Columns that face both neighbours stand in one storey together.
#[test]
fn columns_of_both_sides_are_part_of_their_storey() {
    let column = "{ of = \"b\", flexural_rigidity = 1.3e8 }";
    let one = text(4.0, column);
    assembled(&one);
    let right = one.replace("[ground_motion]", &format!(
        "[[building]]\nname = \"c\"\nstoreys = 1\nheight = 4.5\nmass = \"40 t\"\nstiffness = \"100 MN/m\"\ndamping = {{ modal = 0.05 }}\n[[gap]]\nbetween = [\"b\", \"c\"]\nwidth = 0.01\nmodel = \"linear_elastic\"\nstiffness = 1e8\nlevels = \"all_floors\"\ncolumn = {column}\n[ground_motion]"
    ));
    // 2 x 57.8 MN/m of 100 MN/m.
    let error = refused(&right);
    assert!(
        error.message.contains("stand in storey 2 of \"b\""),
        "{}",
        error.message
    );
    assert!(!error.others.is_empty());
    assembled(&right.replace("1.3e8", "1e8"));
}

/// Floors of the building whose columns are hit meet columns of the other.
#[test]
fn columns_that_are_left_out_are_named() {
    let column = "{ of = \"b\", flexural_rigidity = 1e8 }";
    let system = assembled(&text(4.0, column));
    let warnings = system.unequal_floor_warnings();
    assert_eq!(warnings.len(), 1);
    let told = warnings[0].to_string();
    assert!(
        told.contains("floor 1 of \"b\" at 3 m meets columns of \"a\""),
        "{told}"
    );
    let both = "[{ of = \"b\", flexural_rigidity = 1e8 }, { of = \"a\", flexural_rigidity = 1e8 }]";
    let system = assembled(&text(4.0, both));
    assert_eq!(system.levels().len(), 2);
    assert!(system.unequal_floor_warnings().is_empty());
}
