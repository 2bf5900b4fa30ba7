//! Base-isolated buildings between the walls of a moat.

use std::path::Path;
use std::sync::Arc;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_shear_building::{
    Damping, DampingMatrix, Isolator, IsolatorKind, PostYield, ShearBuilding, Strength,
};
use pounding_time_history::{
    Floor, MethodChoice, Outcome, RunOptions, System, TimeHistoryError, run,
};
use serde_json::Value;

use super::condensed_stiffness::model;
use super::reference::{Reference, Within, found};
use crate::yielding::setup::el_centro;

const EVENT_DRIVEN: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-12,
};
const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-12,
};

/// The system of a case, under El Centro 1940 NS times 1.5.
fn system_of(buildings_and_gaps: &str) -> System {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = format!(
        "{buildings_and_gaps}\n[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\nscale = 1.5\n"
    );
    let case = Case::parse(&text, &folder.join("case.toml")).unwrap();
    assemble(&case).unwrap().system
}

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn near(what: &str, found: f64, expected: f64, allowed: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(
        error <= allowed,
        "{what}: {found} against {expected} ({error:e})"
    );
}

const WALL: &str =
    "model = \"anagnostopoulos_2004\"\nstiffness = \"250 MN/m\"\nrestitution = 0.5\nlevels = [1]\n";

fn walls(right: &str, left: &str) -> String {
    format!(
        "[[gap]]\nname = \"right\"\nbetween = [\"office\", \"wall\"]\nwidth = \"{right}\"\n{WALL}\n[[gap]]\nname = \"left\"\nbetween = [\"wall\", \"office\"]\nwidth = \"{left}\"\n{WALL}"
    )
}

const LEAD_RUBBER: &str = r#"
[[building]]
name = "office"
mass = ["200 t", "200 t", "200 t", "200 t"]
stiffness = ["400 MN/m", "350 MN/m", "300 MN/m"]
height = "3 m"
damping = { dashpots = ["1.2 MN s/m", "1 MN s/m", "0.8 MN s/m"] }

[building.isolator]
model = "lead_rubber"
post_yield_stiffness = "5.053 MN/m"
yield_force = "471 kN"
damping = "200 kN s/m"
"#;

/// What `data/structures/isolated_two_walls.json` says; floors count from the base slab.
fn lead_rubber_agrees(outcome: &Outcome, allowed: f64, times: f64) {
    let text = include_str!("../../data/structures/isolated_two_walls.json");
    let within = Within {
        approach: 10.0 * allowed,
        peak_times: times,
        force_times: times,
        first_contact: 1e-9,
        impact_times: 1e-8,
        own_loss: 10.0 * allowed,
        ..Within::all(allowed)
    };
    let further = |name: &str| {
        let (what, floor) = name.split_once('_')?;
        let storey = &outcome.buildings[0].storeys[floor.parse::<usize>().ok()?];
        match what {
            "u" => found(storey.displacement, 1.0),
            "a" => found(storey.acceleration_absolute, 1.0),
            "drift" => found(storey.drift_ratio, 3.0),
            _ => None,
        }
    };
    Reference::read(text).agrees_within(outcome, within, &further);
}

#[test]
fn lead_rubber_between_walls_by_events() {
    let system = system_of(&format!("{LEAD_RUBBER}{}", walls("80 mm", "70 mm")));
    lead_rubber_agrees(&go(&system, EVENT_DRIVEN, 25.0), 1e-9, 1e-7);
}

#[test]
fn lead_rubber_between_walls_by_the_adaptive_pair() {
    let system = system_of(&format!("{LEAD_RUBBER}{}", walls("80 mm", "70 mm")));
    lead_rubber_agrees(&go(&system, ADAPTIVE, 25.0), 1e-8, 1e-5);
}

const PENDULUM: &str = r#"
[[building]]
name = "office"
mass = ["800 t"]
height = "1 m"

[building.isolator]
model = "friction_pendulum"
radius = "1.5 m"
friction_fast = 0.08
friction_slow = 0.04
rate = "20 s/m"
yield_displacement = "2.5 mm"
"#;

/// A rigid block on a friction pendulum; figures of DOP853 with located events, with which
/// Radau's method agrees to 5e-12.
fn pendulum_agrees(outcome: &Outcome, allowed: f64) {
    let text = include_str!("../../data/structures/friction_pendulum_two_walls.json");
    let file: Value = serde_json::from_str(text).unwrap();
    let reference = &file["reference"];
    let number = |value: &Value| value.as_f64().unwrap();
    let slab = &outcome.buildings[0].storeys[0];
    let expected = number(&reference["peak_displacement"]);
    near("displacement", slab.displacement.value, expected, allowed);
    let forces = outcome.gaps.iter().map(|g| g.levels[0].peak_force.value);
    let force = forces.fold(0.0, f64::max);
    near(
        "wall",
        force,
        number(&reference["peak_wall_force"]),
        allowed,
    );
    for (side, gap) in outcome.gaps.iter().enumerate() {
        let level = &gap.levels[0];
        let counts = &reference["impacts_right_left"];
        assert_eq!(Some(level.impacts as u64), counts[side].as_u64());
        let first = number(&reference["first"][side]);
        let off = (level.first_contact.unwrap() - first).abs();
        assert!(off < allowed, "{off:e}");
    }
    let events = reference["events"].as_array().unwrap();
    assert_eq!(outcome.impacts.len(), events.len());
    for (impact, event) in outcome.impacts.iter().zip(events) {
        let right = number(&event[0]) > 0.0;
        assert_eq!(impact.gap, usize::from(!right));
        assert!((impact.time_closed - number(&event[1])).abs() < 1e-8);
        let speed = number(&event[2]).abs();
        assert!((impact.approach_velocity - speed).abs() < 1e-8);
    }
    let end = &reference["end_state"];
    let displacement = outcome.final_displacement[0];
    near("end", displacement, number(&end[0]), 10.0 * allowed);
    let energy = |name: &str| number(&reference["energy"][name]);
    let input = energy("input");
    // The reference counts the work of the friction, of which this is not lost yet.
    let z = number(&end[2]);
    let held = 0.5 * 0.04 * 8.0e5 * 9.806_65 * 0.0025 * z * z;
    let found = outcome.energy.end;
    for (found, expected) in [
        (found.input, input),
        (found.hysteretic + held, energy("friction")),
        (found.strain - held, energy("gravity")),
        (found.impact, energy("walls")),
        (found.kinetic, energy("kinetic")),
    ] {
        let error = (found - expected).abs() / input;
        assert!(error < allowed, "{found} {expected} ({error:e})");
    }
    assert!(outcome.energy.residual_ratio < 1e-8);
}

#[test]
fn friction_pendulum_between_walls() {
    let system = system_of(&format!("{PENDULUM}{}", walls("70 mm", "60 mm")));
    for method in [EVENT_DRIVEN, ADAPTIVE] {
        pendulum_agrees(&go(&system, method, 20.0), 1e-8);
    }
    // At the tolerance that a user gets.
    let default = MethodChoice::EventDriven {
        relative_tolerance: 1e-10,
    };
    pendulum_agrees(&go(&system, default, 20.0), 1e-7);
}

/// A pendulum that starts displaced was led there slowly: its friction acts from the start. Figures
/// of a Runge-Kutta integration of the equations with steps of 10, 2.5 and 0.6 us, the last two of
/// which agree to 1e-11.
#[test]
fn friction_pendulum_that_starts_displaced() {
    let displaced = PENDULUM.replace(
        "height = \"1 m\"",
        "height = \"1 m\"\ninitial_displacement = \"120 mm\"",
    );
    let system = system_of(&format!("{displaced}{}", walls("5 m", "5 m")));
    let weight = 8.0e5 * 9.806_65;
    let at_start = weight * 0.12 / 1.5 + 0.04 * weight * (0.12_f64 / 0.0025).tanh();
    for method in [EVENT_DRIVEN, ADAPTIVE] {
        let outcome = go(&system, method, 2.0);
        let force = outcome.buildings[0].isolator.as_ref().unwrap().force;
        assert!(force.value >= at_start * (1.0 - 1e-12), "{force:?}");
        let displacement = outcome.final_displacement[0];
        near("displacement", displacement, -0.051_514_601_351_9, 1e-8);
        assert!((outcome.final_velocity[0] + 0.150_566_166_145).abs() < 1e-9);
        assert!(outcome.energy.residual_ratio < 1e-8);
    }
}

/// One mass on a pendulum alone under El Centro: no force is above `W d / R + mu_f W` at the maximum
/// displacement `d`, and fixed steps agree with the adaptive pair as far as their displacements do.
/// They took the friction of the speed at the end of a step, where the motion has turned, for that of
/// the branch before, exp(a |v|) instead of exp(-a |v|): up to 1e77 N.
#[test]
fn friction_pendulum_by_fixed_steps() {
    let weight = 8.0e5 * 9.806_65;
    for rate in [30.0, 100.0, 300.0, 1.0e4] {
        let rated = PENDULUM.replace("20 s/m", &format!("{rate} s/m"));
        let system = system_of(&format!("{rated}{}", walls("5 m", "5 m")));
        let peaks = |method: MethodChoice| {
            let outcome = go(&system, method, 12.0);
            let isolator = outcome.buildings[0].isolator.as_ref().unwrap();
            let slab = &outcome.buildings[0].storeys[0];
            let (force, way) = (isolator.force.value, slab.displacement.value);
            let bound = weight * (way / 1.5 + 0.08);
            assert!(
                force <= bound * (1.0 + 1e-9),
                "{rate}: {force} N, {bound} N"
            );
            let inertia = 8.0e5 * slab.acceleration_absolute.value;
            assert!(inertia <= 1.001 * bound, "{rate}: {inertia} N, {bound} N");
            (force, way)
        };
        let (force, way) = peaks(ADAPTIVE);
        let newmark = |step| MethodChoice::Newmark {
            step,
            beta: 0.25,
            gamma: 0.5,
        };
        let hht = |step| MethodChoice::HhtAlpha { step, alpha: -0.1 };
        for (method, allowed) in [
            (newmark(0.02), 0.03),
            (hht(0.02), 0.03),
            (newmark(0.002), 1.0e-3),
            (hht(0.002), 1.0e-3),
        ] {
            let found = peaks(method);
            near("force", found.0, force, allowed);
            near("displacement", found.1, way, allowed);
        }
    }
}

/// Beyond `|z| = 1` no motion leads the variable of a pendulum: an explicit step of 20 ms, over which
/// the slab goes many times the yield displacement, does.
#[test]
fn explicit_steps_too_long_for_a_pendulum() {
    let system = system_of(&format!("{PENDULUM}{}", walls("5 m", "5 m")));
    let go_by = |step| {
        let options = RunOptions {
            method: MethodChoice::RungeKutta4 { step },
            duration: Some(12.0),
            ..RunOptions::default()
        };
        run(&system, &options, &mut [], &mut |_| {})
    };
    let error = go_by(0.04).unwrap_err();
    let TimeHistoryError::LawNotFollowed {
        place,
        value,
        bound,
        ..
    } = &error
    else {
        panic!("{error}");
    };
    assert!(
        place.contains("office") && *bound == 1.0 && *value > 1.1,
        "{error}"
    );
    assert!(error.help().unwrap().contains("smaller `step`"));
    assert!(go_by(0.001).is_ok());
}

fn isolated(kind: IsolatorKind, dashpot: f64, superstructure: Damping) -> System {
    let building = ShearBuilding::on_isolators(
        "office".into(),
        vec![2.0e5; 4],
        &[4.0e8, 3.5e8, 3.0e8],
        vec![3.0; 4],
        superstructure,
        Isolator { kind, dashpot },
    );
    between_walls(building.unwrap())
}

fn between_walls(building: ShearBuilding) -> System {
    let mut system = System::new(vec![Arc::new(building)], el_centro());
    let [wall, slab] = [Floor::Wall, Floor::Storey(0, 0)];
    let sides = [
        ("office", "wall", slab, wall),
        ("wall", "office", wall, slab),
    ];
    for (left, right, a, b) in sides {
        let names = [left.to_owned(), right.to_owned()];
        let name = format!("{left}-{right}");
        let level = (a, b, 0.05, model());
        system.add_gap(&name, names, vec![level]).unwrap();
    }
    system
}

fn rubber(strength: f64, stiffness_ratio: f64) -> IsolatorKind {
    IsolatorKind::LeadRubber {
        post_yield: PostYield::Period(2.5),
        strength: (strength > 0.0).then_some(Strength::OfWeight(strength)),
        stiffness_ratio,
    }
}

fn peaks(outcome: &Outcome) -> Vec<f64> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let of_storeys = storeys.flat_map(|s| {
        [
            s.displacement.value,
            s.drift_ratio.value,
            s.storey_shear.value,
            s.acceleration_absolute.value,
        ]
    });
    let gaps = outcome.gaps.iter().flat_map(|g| &g.levels);
    of_storeys.chain(gaps.map(|l| l.peak_force.value)).collect()
}

/// Plain rubber is a linear first storey, to the last bit; lead rubber of hardly any strength
/// comes close to one.
#[test]
fn without_strength_the_isolator_is_a_linear_storey() {
    let above = vec![1.2e6, 1.0e6, 8.0e5];
    let superstructure = || Damping::Dashpots {
        coefficients: above.clone(),
    };
    let plain = isolated(rubber(0.0, 1.0), 4.0e5, superstructure());
    let stiffness = plain.buildings()[0].stiffness()[0];
    near("stiffness", stiffness, 5.053_237e6, 1e-6);
    let chain = ShearBuilding::new(
        "office".into(),
        vec![2.0e5; 4],
        vec![stiffness, 4.0e8, 3.5e8, 3.0e8],
        vec![3.0; 4],
        Damping::Dashpots {
            coefficients: [vec![4.0e5], above.clone()].concat(),
        },
    );
    let chain = between_walls(chain.unwrap());
    let (plain, chain) = (
        go(&plain, EVENT_DRIVEN, 20.0),
        go(&chain, EVENT_DRIVEN, 20.0),
    );
    assert!(plain.impacts.len() > 2);
    assert_eq!(plain.buildings[0].storeys, chain.buildings[0].storeys);
    assert!(
        plain.buildings[0]
            .isolator
            .is_some_and(|i| i.effective_damping_ratio == 0.0)
    );
    assert_eq!(plain.impacts, chain.impacts);
    assert_eq!(plain.energy.end.hysteretic, 0.0);
    let weak = |strength| {
        let weak = isolated(rubber(strength, 10.0), 4.0e5, superstructure());
        let weak = go(&weak, EVENT_DRIVEN, 20.0);
        assert_eq!(weak.impacts.len(), plain.impacts.len());
        let pairs = peaks(&weak).into_iter().zip(peaks(&plain));
        let off = pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        println!("strength {strength}: off by {off:e}");
        off
    };
    let (one, other) = (weak(1e-6), weak(1e-8));
    assert!(one < 1e-3 && other < 0.05 * one, "{one:e} {other:e}");
}

/// Walls that are out of reach change nothing.
#[test]
fn without_walls_the_isolated_run() {
    let far = system_of(&format!("{LEAD_RUBBER}{}", walls("1 m", "1 m")));
    let none = system_of(LEAD_RUBBER);
    let (far, none) = (go(&far, EVENT_DRIVEN, 25.0), go(&none, EVENT_DRIVEN, 25.0));
    assert!(far.impacts.is_empty());
    assert_eq!(far.buildings, none.buildings);
    assert_eq!(far.energy.end, none.energy.end);
}

/// Ratios of the storeys above the slab couple all floors with it: a full matrix beside
/// tridiagonal stiffnesses, by every method.
#[test]
fn full_damping_matrices_run_by_every_method() {
    let superstructure = Damping::Modal {
        ratios: vec![0.03, 0.03, 0.05],
    };
    let system = isolated(rubber(0.03, 10.0), 2.0e5, superstructure);
    let matrix = system.buildings()[0].damping_matrix();
    assert!(matches!(matrix, DampingMatrix::Dense(_)));
    let exact = go(&system, EVENT_DRIVEN, 10.0);
    assert!(exact.impacts.len() > 1);
    let off = |method| {
        let outcome = go(&system, method, 10.0);
        assert_eq!(outcome.impacts.len(), exact.impacts.len());
        let pairs = peaks(&outcome).into_iter().zip(peaks(&exact));
        pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    };
    let adaptive = off(ADAPTIVE);
    assert!(adaptive < 1e-8, "{adaptive:e}");
    let step = 5.0e-5;
    let (beta, gamma) = (0.25, 0.5);
    for method in [
        MethodChoice::Newmark { step, beta, gamma },
        MethodChoice::HhtAlpha { step, alpha: -0.05 },
        MethodChoice::RungeKutta4 { step },
    ] {
        let stepped = off(method);
        assert!(stepped < 1e-3, "{method:?}: {stepped:e}");
    }
    // Linear isolators: exact steps of dense matrices against the pair.
    let superstructure = Damping::RayleighRatio {
        ratio: 0.05,
        modes: [1, 3],
    };
    let linear = isolated(rubber(0.0, 1.0), 3.0e5, superstructure);
    let (exact, pair) = (go(&linear, EVENT_DRIVEN, 10.0), go(&linear, ADAPTIVE, 10.0));
    assert_eq!(exact.impacts.len(), pair.impacts.len());
    for (a, b) in peaks(&exact).into_iter().zip(peaks(&pair)) {
        near("peak", a, b, 1e-8);
    }
    assert!(exact.energy.residual_ratio < 1e-10);
}
