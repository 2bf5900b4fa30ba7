//! Buildings whose floors turn in plan, from case files.

use std::path::Path;

use pounding_assembly::{Assembly, assemble};
use pounding_case::Case;
use pounding_time_history::{MethodChoice, Outcome, RunOptions, run};

use super::reference::Reference;

/// Two buildings of two storeys under both components; the figures of the reference.
pub const PAIR: &str = r#"
[[building]]
name = "A"
mass = ["120 t", "100 t"]
height = "3.5 m"
damping = { ratio = 0.05, modes = [1, 3] }

[building.plan]
length = "12 m"
width = "10 m"
frames_along = [
    { at = "-5 m", stiffness = ["30 MN/m", "26 MN/m"] },
    { at = "4 m", stiffness = ["12 MN/m", "10 MN/m"] },
]
frames_across = [
    { at = "-6 m", stiffness = ["20 MN/m", "18 MN/m"] },
    { at = "6 m", stiffness = ["24 MN/m", "20 MN/m"] },
]

[[building]]
name = "B"
mass = ["150 t", "130 t"]
height = "3.5 m"
damping = { ratio = 0.05, modes = [1, 3] }

[building.plan]
length = "14 m"
width = "12 m"
mass_centre = "0.5 m"
frames_along = [
    { at = "-6 m", stiffness = ["40 MN/m", "34 MN/m"] },
    { at = "6 m", stiffness = ["90 MN/m", "76 MN/m"] },
]
frames_across = [
    { at = "-7 m", stiffness = ["60 MN/m", "50 MN/m"] },
    { at = "7 m", stiffness = ["60 MN/m", "50 MN/m"] },
]

[[gap]]
between = ["A", "B"]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "150 MN/m"
restitution = 0.65

[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"
across = { file = "data/structures/synthetic.csv", scale = 0.7 }

[analysis]
duration = 20
"#;

pub fn assembled(text: &str) -> Assembly {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("pair.toml");
    assemble(&Case::parse(text, &file).unwrap()).unwrap()
}

pub fn go(assembly: &Assembly, method: Option<MethodChoice>) -> Outcome {
    let options = RunOptions {
        method: method.unwrap_or(assembly.options.method),
        ..assembly.options
    };
    run(&assembly.system, &options, &mut [], &mut |_| {}).unwrap()
}

/// The responses of the case by the names of the reference.
pub fn named_as_in_the_reference(mut outcome: Outcome) -> Outcome {
    for building in &mut outcome.buildings {
        let name = building.name.clone();
        let mut all = Vec::new();
        for response in &mut building.responses {
            let (kind, floor) = response.name.rsplit_once('_').unwrap();
            let short = match kind {
                "displacement_across" => "y",
                "rotation" => "theta",
                "acceleration_across" => "ay",
                "rotational_acceleration" => "atheta",
                _ => continue,
            };
            response.name = format!("{short}_{name}{floor}");
            all.push(response.clone());
        }
        assert_eq!(all.len(), 8);
        for (i, storey) in building.storeys.iter().enumerate() {
            for (kind, peak) in [
                ("x", storey.displacement),
                ("ax", storey.acceleration_absolute),
            ] {
                let mut response = all[0].clone();
                response.name = format!("{kind}_{name}{}", i + 1);
                response.peak = peak;
                all.push(response);
            }
        }
        building.responses = all;
    }
    outcome
}

#[test]
fn a_pair_that_turns_gives_the_reference() {
    let text = include_str!("../../data/structures/torsion_pair.json");
    let reference = Reference::read(text);
    let assembly = assembled(PAIR);
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    for method in [None, Some(adaptive)] {
        let outcome = named_as_in_the_reference(go(&assembly, method));
        reference.agrees(&outcome, 1e-8);
    }
}

/// Frames that stand evenly, and points that do: nothing turns, and the pair is the planar one
/// with the stiffness of all points together.
#[test]
fn without_eccentricity_it_is_the_planar_pair() {
    let plan = r#"
[building.plan]
length = "12 m"
width = "10 m"
frames_along = [{ at = -4, stiffness = K }, { at = 4, stiffness = K }]
frames_across = [{ at = 0, stiffness = K }]
"#;
    let building = |name: &str, k: f64, plan: &str, mass: f64| {
        let stiffness = match plan {
            "" => format!("stiffness = {}", 2.0 * k),
            _ => String::new(),
        };
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [{mass}, {mass}]\nheight = 3\n{stiffness}\ndamping = {{ rayleigh = {{ alpha = 0.5, beta = 0.002 }} }}\n{}",
            plan.replace('K', &k.to_string())
        )
    };
    let case = |plan: &str, points: &str, k: f64| {
        format!(
            "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 0.02\nmodel = \"linear_elastic\"\nstiffness = {k}\n{points}\n[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 10\n",
            building("A", 2e7, plan, 1e5),
            building("B", 6e7, plan, 1.4e5),
        )
    };
    let planar = go(&assembled(&case("", "", 2e8)), None);
    let turning = go(&assembled(&case(plan, "points = [-5, 5]", 1e8)), None);
    assert!(planar.impacts.len() > 5);
    assert_eq!(turning.impacts.len(), 2 * planar.impacts.len());
    for (a, b) in planar.buildings.iter().zip(&turning.buildings) {
        for (one, other) in a.storeys.iter().zip(&b.storeys) {
            for (x, y) in [
                (one.displacement, other.displacement),
                (one.storey_shear, other.storey_shear),
                (one.acceleration_absolute, other.acceleration_absolute),
            ] {
                assert!((x.value / y.value - 1.0).abs() < 1e-9, "{x:?} {y:?}");
            }
        }
        for response in &b.responses {
            if response.name.starts_with("rotation") {
                assert!(response.peak.value < 1e-10, "{response:?}");
            }
        }
    }
    let hardest = |o: &Outcome| {
        let forces = o.impacts.iter().map(|i| i.peak_force.value);
        forces.fold(0.0, f64::max)
    };
    let ratio = hardest(&planar) / hardest(&turning);
    assert!((ratio - 2.0).abs() < 1e-8, "{ratio}");
}

/// Seen in a mirror across the row: the same motion, turned the other way.
#[test]
fn a_mirrored_pair_turns_the_other_way() {
    let mirrored = PAIR
        .replace("at = \"-5 m\"", "at = \"X m\"")
        .replace("at = \"4 m\"", "at = \"-4 m\"")
        .replace("at = \"X m\"", "at = \"5 m\"")
        .replace(
            "at = \"-6 m\", stiffness = [\"40",
            "at = \"X m\", stiffness = [\"40",
        )
        .replace(
            "at = \"6 m\", stiffness = [\"90",
            "at = \"-6 m\", stiffness = [\"90",
        )
        .replace("at = \"X m\"", "at = \"6 m\"")
        .replace("mass_centre = \"0.5 m\"", "mass_centre = \"-0.5 m\"");
    // Without the component across the row, whose sign a mirror turns.
    let along = |text: &str| {
        let lines = text.lines().filter(|line| !line.starts_with("across"));
        lines.collect::<Vec<_>>().join("\n")
    };
    let a = go(&assembled(&along(PAIR)), None);
    let b = go(&assembled(&along(&mirrored)), None);
    assert!(a.impacts.len() > 10);
    assert_eq!(a.impacts.len(), b.impacts.len());
    for (one, other) in a.buildings.iter().zip(&b.buildings) {
        for (x, y) in one.storeys.iter().zip(&other.storeys) {
            let off = x.displacement.value / y.displacement.value - 1.0;
            assert!(off.abs() < 1e-9, "{off:e}");
        }
        let find = |o: &pounding_time_history::BuildingOutcome, name: &str| {
            o.responses
                .iter()
                .find(|r| r.name == name)
                .unwrap()
                .peak
                .value
        };
        let lower = find(one, "displacement_of_lower_edge_2");
        let upper = find(other, "displacement_of_upper_edge_2");
        assert!((lower / upper - 1.0).abs() < 1e-9, "{lower} {upper}");
    }
}
