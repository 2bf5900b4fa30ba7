//! Buildings that turn in plan, and kinds of structure that do not go together.
use std::path::Path;

use pounding_assembly::{AssemblyError, assemble};
use pounding_case::Case;

fn refused(building: &str, gap: &str, motion: &str) -> AssemblyError {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let text = format!(
        "[[building]]\nname = \"a\"\nmass = [1e5, 1e5]\nheight = 3\n{building}\n[[gap]]\nbetween = [\"a\", \"wall\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = 1e8\n{gap}\n[ground_motion]\nfile = \"{record}\"\n{motion}\n"
    );
    assemble(&Case::parse(&text, Path::new("case.toml")).unwrap()).unwrap_err()
}

const DAMPED: &str = "damping = { mass_proportional = 0.05 }\n";
const PLAN: &str = "plan = { length = 12, width = 10, frames_along = [{ at = -5, stiffness = 3e7 }, { at = 5, stiffness = 1e7 }], frames_across = [{ at = 0, stiffness = 2e7 }] }";

/// Columns are hit where floors neither turn nor stand on isolators.
#[test]
fn columns_beside_plans_and_isolators() {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let isolator = "stiffness = 1e8\nisolator = { model = \"lead_rubber\", post_yield_period = 2.5, strength = 0.06 }";
    for (structure, of, what) in [
        (PLAN, "a", "plan"),
        (PLAN, "b", "plan"),
        (isolator, "a", "isolator"),
    ] {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = [1e5, 1e5]\nheight = 3\n{DAMPED}{structure}\n[[building]]\nname = \"b\"\nmass = [1e5, 1e5]\nheight = 2\n{DAMPED}stiffness = 1e8\n[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = 1e8\ncolumn = {{ of = \"{of}\", flexural_rigidity = 1e6 }}\n[ground_motion]\nfile = \"{record}\"\n"
        );
        let error = assemble(&Case::parse(&text, Path::new("case.toml")).unwrap()).unwrap_err();
        let said = error.to_string();
        let expected = format!("columns cannot be hit in gap a-b: building \"a\" has `{what}`");
        assert!(said.contains(&expected), "{said}");
    }
}

#[test]
fn each_with_its_remedy() {
    let sound = format!("{DAMPED}{PLAN}");
    let one_line = "plan = { length = 12, width = 10, frames_along = [{ at = 0, stiffness = 3e7 }], frames_across = [{ at = 0, stiffness = 2e7 }] }";
    for (building, gap, motion, message, remedy) in [
        (
            format!("{DAMPED}{one_line}"),
            "",
            "",
            "its frames do not hold the floors",
            "at least two of one direction",
        ),
        (
            format!("p_delta = true\n{}", sound.replace("3e7", "3e5").replace("1e7", "1e5")),
            "",
            "",
            "gravity acting through the drift takes more off its stiffness matrix",
            "`p_delta = false` leaves gravity out",
        ),
        (
            format!("damping = {{ dashpots = 1e5 }}\n{PLAN}"),
            "",
            "",
            "dashpots",
            "give ratios",
        ),
        (
            format!("{sound}\nfoundation = {{ mass = 1e5, sway = {{ stiffness = 1e9 }} }}"),
            "",
            "",
            "stands on a fixed base",
            "leave `foundation` or `plan` out",
        ),
        (
            "stiffness = 1e8\nisolator = { model = \"lead_rubber\", post_yield_period = 2.5, strength = 0.06 }\ndamping = { mass_proportional = 0.05 }\nfoundation = { mass = 1e5, sway = { stiffness = 1e9 } }".to_owned(),
            "",
            "",
            "stands on isolators and on a foundation",
            "remove `isolator` or `foundation`",
        ),
        (
            sound.clone(),
            "points = [1, 0, 1]",
            "",
            "there are two points at 1 m",
            "give every point once",
        ),
        (
            sound.clone(),
            "points = [-6, 0]",
            "",
            "the point at -6 m is not on the edge",
            "within the plans",
        ),
        (
            format!("{DAMPED}stiffness = 1e8"),
            "points = 0",
            "",
            "`points` have no meaning between buildings that do not turn",
            "give a building a `plan`",
        ),
        (
            format!("{DAMPED}stiffness = 1e8"),
            "",
            "across = { file = \"none.csv\" }",
            "a record across the row has nothing to move",
            "leave `across` out",
        ),
        (
            format!("{DAMPED}stiffness = 1e8\nground = {{ file = \"none.csv\" }}"),
            "",
            "",
            "none.csv",
            "",
        ),
    ] {
        let error = refused(&building, gap, motion);
        let said = error.to_string();
        assert!(said.contains(message), "{building}: {said}");
        if let AssemblyError::Case(error) = &error {
            let help = error.help.clone().unwrap_or_default();
            assert!(help.contains(remedy), "{help}");
        } else {
            assert!(remedy.is_empty(), "{said}");
        }
    }
}

/// A velocity jump at one point of a floor that turns closes the other: the sequence has no end
/// that two methods share. One point is sound, and so is a contact stiffness.
#[test]
fn velocity_jumps_need_a_single_point() {
    let record = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let with = |gap: &str| {
        let text = format!(
            "[[building]]\nname = \"a\"\nmass = [1e5, 1e5]\nheight = 3\n{DAMPED}{PLAN}\n[[gap]]\nbetween = [\"a\", \"wall\"]\nwidth = 0.02\n{gap}\n[ground_motion]\nfile = \"{record}\"\n"
        );
        let case = Case::parse(&text, Path::new("case.toml")).unwrap();
        (assemble(&case).map(|a| a.system.levels().len()), text)
    };
    let rigid = "model = \"stereomechanical\"\nrestitution = 0.6";
    for points in ["", "\npoints = [-2, 1, 3]"] {
        let (refused, text) = with(&format!("{rigid}{points}"));
        let AssemblyError::Case(error) = refused.unwrap_err() else {
            panic!("{points}");
        };
        let said = "model stereomechanical lets velocities jump";
        assert!(error.message.contains(said), "{error}");
        assert!(error.help.as_ref().unwrap().contains("`points = [0]`"));
        assert_eq!(&text[error.span.clone()], "\"stereomechanical\"");
    }
    assert_eq!(with(&format!("{rigid}\npoints = [0]")).0.unwrap(), 2);
    for friction in ["borovin_2014", "lapshin_yurin_2016"] {
        let friction = format!("model = \"{friction}\"\nstiffness = 1e8\nfriction = 0.3");
        assert_eq!(with(&friction).0.unwrap(), 4);
        let (refused, text) = with(&format!("{friction}\npoints = [-4, 0, 4]"));
        let AssemblyError::Case(error) = refused.unwrap_err() else {
            panic!("{friction}");
        };
        let said = "holds floors by friction, which it cannot at 3 points";
        assert!(error.message.contains(said), "{error}");
        assert!(error.help.as_ref().unwrap().contains("two points"));
        assert!(text[error.span.clone()].contains("[-4, 0, 4]"));
    }
    let elastic = "model = \"linear_elastic\"\nstiffness = 1e8";
    assert_eq!(with(elastic).0.unwrap(), 4);
}
