//! Frames with laws in buildings whose floors turn in plan.

use pounding_time_history::{
    FrameOutcome, MethodChoice, Outcome, RunOptions, TimeHistoryError, run,
};

use serde::Deserialize;

use super::reference::Reference;
use super::torsion::{PAIR, assembled, go, named_as_in_the_reference};

/// A pair under El Centro, each building with these lines in the place of its stiffness, which hold `K` and `F`: stiffness
/// and yield force of every storey, or half of both for one of two frames.
fn pair(resists: &str, points: &str, part: f64) -> String {
    let building = |name: &str, (k, f): (f64, f64), mass: f64| {
        let resists = resists
            .replace('K', &(part * k).to_string())
            .replace('F', &(part * f).to_string());
        format!(
            "[[building]]\nname = \"{name}\"\nmass = [{mass}, {mass}]\nheight = 3\ndamping = {{ rayleigh = {{ alpha = 0.5, beta = 0.002 }} }}\n{resists}\n"
        )
    };
    format!(
        "{}{}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 0.01\nmodel = \"linear_elastic\"\nstiffness = {}\n{points}\n[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 10\n",
        building("A", (4e7, 2e5), 1e5),
        building("B", (1.2e8, 5e5), 1.4e5),
        part * 2e8,
    )
}

const LAW: &str = "law = { model = \"bilinear\", yield_force = F, hardening_ratio = 0.04 }";

/// Two equal frames at equal distances are a storey with a bilinear law of twice the stiffness and yield force: closed
/// form, against the planar building.
#[test]
fn even_frames_yield_as_a_storey_does() {
    as_a_storey("", 5);
}

/// The same with gravity, which takes as much off both.
#[test]
fn gravity_acts_on_even_frames_as_on_a_storey() {
    as_a_storey(GRAVITY, 2);
}

const GRAVITY: &str = "p_delta = true\n";

fn as_a_storey(gravity: &str, least_impacts: usize) {
    let planar = format!("{gravity}stiffness = K\n{LAW}");
    let turning = format!(
        "{gravity}[building.plan]\nlength = 12\nwidth = 10\nframes_along = [{{ at = -4, stiffness = K, {LAW} }}, {{ at = 4, stiffness = K, {LAW} }}]\nframes_across = [{{ at = 0, stiffness = K, {LAW} }}]"
    );
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    for method in [None, Some(adaptive)] {
        let planar = go(&assembled(&pair(&planar, "", 1.0)), method);
        let turning = go(&assembled(&pair(&turning, "points = [-5, 5]", 0.5)), method);
        let impacts = planar.impacts.len();
        assert!(impacts >= least_impacts, "{impacts}");
        assert_eq!(turning.impacts.len(), 2 * planar.impacts.len());
        agree(&planar, &turning);
    }
}

fn agree(planar: &Outcome, turning: &Outcome) {
    let near = |x: f64, y: f64, what: &str| {
        assert!((x - y).abs() <= 1e-8 * x.abs(), "{what}: {x:e} {y:e}");
    };
    for (a, b) in planar.buildings.iter().zip(&turning.buildings) {
        for (one, other) in a.storeys.iter().zip(&b.storeys) {
            near(
                one.displacement.value,
                other.displacement.value,
                "displacement",
            );
            near(one.storey_shear.value, other.storey_shear.value, "shear");
            let [x, y] = [one, other].map(|s| s.acceleration_absolute.value);
            near(x, y, "acceleration");
        }
        for (storey, one) in a.yielding.iter().enumerate() {
            let (one, other) = (one.unwrap(), b.yielding[storey].unwrap());
            let ductility = one.ductility.unwrap().value;
            assert!(ductility > 1.2, "{ductility}");
            near(ductility, other.ductility.unwrap().value, "ductility");
            near(one.hysteretic_energy, other.hysteretic_energy, "energy");
            near(
                one.residual_drift_ratio,
                other.residual_drift_ratio,
                "residual drift",
            );
            let frames = b.frames.iter().filter(|f| f.storey == storey + 1);
            let (along, across): (Vec<&FrameOutcome>, Vec<&FrameOutcome>) =
                frames.partition(|f| f.direction == "along");
            assert_eq!((along.len(), across.len()), (2, 1));
            for frame in along {
                near(
                    ductility,
                    frame.ductility.unwrap().value,
                    "ductility of a frame",
                );
                near(
                    one.hysteretic_energy,
                    2.0 * frame.hysteretic_energy,
                    "energy of a frame",
                );
                let shear = a.storeys[storey].storey_shear.value;
                near(shear, 2.0 * frame.force.value, "force of a frame");
            }
            // Nothing moves it.
            assert!(across[0].force.value < 1e-6 * a.storeys[storey].storey_shear.value);
        }
        for response in b
            .responses
            .iter()
            .filter(|r| r.name.starts_with("rotation"))
        {
            assert!(response.peak.value < 1e-10, "{response:?}");
        }
    }
    assert!(turning.energy.residual_ratio < 1e-10);
}

/// A frame of the reference.
#[derive(Deserialize)]
struct Frame {
    building: String,
    direction: String,
    at: f64,
    storey: usize,
    peak_deformation: f64,
    ductility: f64,
    peak_force: f64,
    residual_deformation: f64,
    hysteretic_energy: f64,
}

/// The pair of the elastic reference with the frames of the other one that yield.
fn yielding_pair() -> String {
    let laws = [
        (
            "-5 m\", stiffness = [\"30 MN/m\", \"26 MN/m\"]",
            "bilinear",
            [150, 100],
            "0.05",
        ),
        (
            "4 m\", stiffness = [\"12 MN/m\", \"10 MN/m\"]",
            "bilinear",
            [70, 45],
            "0.02",
        ),
        (
            "-6 m\", stiffness = [\"20 MN/m\", \"18 MN/m\"]",
            "elastic_perfectly_plastic",
            [110, 80],
            "",
        ),
        (
            "-6 m\", stiffness = [\"40 MN/m\", \"34 MN/m\"]",
            "bilinear",
            [330, 220],
            "0.03",
        ),
    ];
    laws.iter().fold(PAIR.to_owned(), |text, (frame, law, force, hardening)| {
        assert_eq!(text.matches(frame).count(), 1, "{frame}");
        let hardening = match *hardening {
            "" => String::new(),
            ratio => format!(", hardening_ratio = {ratio}"),
        };
        let [first, second] = force;
        let law = format!(
            "{frame}, law = {{ model = \"{law}\", yield_force = [\"{first} kN\", \"{second} kN\"]{hardening} }}"
        );
        text.replace(frame, &law)
    })
}

/// The same under gravity.
fn pair_under_gravity() -> String {
    yielding_pair().replace("[building.plan]", &format!("{GRAVITY}[building.plan]"))
}

/// Every peak, impact and energy, and what every frame went through, against the independent solution.
#[test]
fn a_yielding_pair_that_turns_gives_the_reference() {
    let text = include_str!("../../data/structures/yielding_torsion_pair.json");
    gives(&yielding_pair(), text);
}

/// The same under gravity, against a solution in which weights lean at four points of every floor, not by a moment of inertia.
#[test]
fn a_yielding_pair_under_gravity_gives_the_reference() {
    let text = include_str!("../../data/structures/gravity_torsion_pair.json");
    gives(&pair_under_gravity(), text);
}

fn gives(case: &str, text: &str) {
    let reference = Reference::read(text);
    let file: serde_json::Value = serde_json::from_str(text).unwrap();
    let frames: Vec<Frame> = serde_json::from_value(file["reference"]["frames"].clone()).unwrap();
    let assembly = assembled(case);
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    for (method, allowed) in [(None, 1e-10), (Some(adaptive), 1e-8)] {
        let outcome = go(&assembly, method);
        let found = outcome.buildings.iter();
        let found = found.flat_map(|b| b.frames.iter().map(|f| (b.name.as_str(), f)));
        let found: Vec<_> = found.collect();
        assert_eq!((found.len(), frames.len()), (8, 8));
        for expected in &frames {
            let own = found.iter().find(|(building, f)| {
                *building == expected.building
                    && f.direction == expected.direction
                    && f.at == expected.at
                    && f.storey == expected.storey
            });
            let (_, own) = own.unwrap();
            for (what, x, y, size) in [
                (
                    "deformation",
                    own.deformation.value,
                    expected.peak_deformation,
                    1.0,
                ),
                (
                    "ductility",
                    own.ductility.unwrap().value,
                    expected.ductility,
                    1.0,
                ),
                ("force", own.force.value, expected.peak_force, 1.0),
                (
                    "energy",
                    own.hysteretic_energy,
                    expected.hysteretic_energy,
                    1.0,
                ),
                (
                    "residual",
                    own.residual_deformation,
                    expected.residual_deformation,
                    expected.peak_deformation / expected.residual_deformation,
                ),
            ] {
                let off = ((x - y) / (y * size)).abs();
                assert!(off < allowed, "{what} of a frame: {off:e}");
            }
        }
        reference.agrees(&named_as_in_the_reference(outcome), allowed);
    }
}

/// Where a frame drifts by more than the height of its storey, the building has fallen: the instant by the same independent
/// program as the reference, with twice the motion.
#[test]
fn a_building_that_turns_collapses_where_a_frame_drifts_by_its_height() {
    let assembly = assembled(&twice(&pair_under_gravity()));
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    let exact = assembly.options.method;
    for (method, allowed) in [(exact, 1e-9), (adaptive, 1e-7)] {
        let options = RunOptions {
            method,
            ..assembly.options
        };
        let outcome = run(&assembly.system, &options, &mut [], &mut |_| {});
        let Err(TimeHistoryError::Collapse {
            time,
            building,
            storey,
            height,
        }) = outcome
        else {
            panic!("{outcome:?}");
        };
        assert_eq!((building.as_str(), storey, height), ("A", 1, 3.5));
        let off = time - 12.926_730_850_377_513;
        assert!(off.abs() < allowed, "{off:e}");
    }
    // Without gravity the hardening of other frames holds the building.
    go(&assembled(&twice(&yielding_pair())), None);
}

/// A case of the pair with twice the motion.
fn twice(case: &str) -> String {
    let record = "file = \"../ground_motions/el_centro_1940_ns.csv\"";
    let twice = case.replace(record, &format!("{record}\nscale = 2"));
    twice.replace("scale = 0.7", "scale = 1.4")
}

/// Newmark's method with its own trials of the laws comes to the same at second order.
#[test]
fn newmark_converges_at_second_order() {
    let assembly = assembled(&yielding_pair().replace("duration = 20", "duration = 4"));
    let values = |method| {
        let outcome = go(&assembly, method);
        assert!(outcome.impacts.len() >= 3);
        let frames = outcome.buildings.iter().flat_map(|b| b.frames.clone());
        let frames = frames.flat_map(|f| [f.deformation.value, f.hysteretic_energy]);
        let floors = outcome.buildings.iter().flat_map(|b| b.storeys.clone());
        let floors = floors.map(|s| s.displacement.value);
        frames.chain(floors).collect::<Vec<f64>>()
    };
    let exact = values(None);
    let error = |step: f64| {
        let method = MethodChoice::Newmark {
            step,
            beta: 0.25,
            gamma: 0.5,
        };
        let values = values(Some(method));
        let errors = values.iter().zip(&exact).map(|(x, y)| (x / y - 1.0).abs());
        errors.fold(0.0, f64::max)
    };
    let [coarse, fine] = [1e-3, 2.5e-4].map(error);
    let order = (coarse / fine).log2() / 2.0;
    assert!((1.8..2.3).contains(&order), "{order}: {coarse:e} {fine:e}");
}
