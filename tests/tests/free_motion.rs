//! Rung 4 of the ladder: buildings let go from an initial state, against closed forms.
//!
//! Two undamped single storeys: piecewise-linear motion by matrix exponentials in 30
//! digits. The bouncing ball: `t_n = t_1 (1 + 2 (e + ... + e^n))`, heights `e^(2 n) h`,
//! accumulation at `t_1 (1 + e) / (1 - e)`.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, SeparationRule, registry};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, TimeHistoryError, run,
};
use verification::{constant_ground, single_storey};

fn model(name: &str, pairs: &[(&str, f64)], rule: SeparationRule) -> Arc<dyn ImpactModel> {
    let parameters = ModelParameters::from_pairs(pairs).with_separation(rule);
    registry::build(name, &parameters).unwrap().into()
}

fn go(system: &System, duration: f64) -> Outcome {
    let options = RunOptions {
        duration: Some(duration),
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn near(what: &str, computed: f64, expected: f64, scale: f64) {
    let error = (computed - expected).abs() / scale;
    assert!(
        error <= 1e-9,
        "{what} = {computed}, not {expected}: {error:e}"
    );
}

/// Two single storeys released from rest at -0.06 m and 0.01 m.
fn two_storeys(model: Arc<dyn ImpactModel>) -> System {
    let buildings = vec![
        single_storey("left", 1.0e5, 4.0e6),
        single_storey("right", 1.5e5, 1.35e7),
    ];
    let mut system = System::new(buildings, constant_ground(0.0, 0.5));
    let names = ["left".to_owned(), "right".to_owned()];
    let pair = (Floor::Storey(0, 0), Floor::Storey(1, 0), 0.02, model);
    system.add_gap("gap", names, vec![pair]).unwrap();
    system
        .with_initial_state(&[-0.06, 0.01], &[0.0, 0.0])
        .unwrap()
}

#[test]
fn two_single_storeys_with_a_gap() {
    let linear = model(
        "linear_elastic",
        &[("stiffness", 9.35e7)],
        SeparationRule::ZeroPenetration,
    );
    let kelvin_voigt = |rule| {
        model(
            "anagnostopoulos_2004",
            &[("stiffness", 9.35e7), ("restitution", 0.65)],
            rule,
        )
    };
    let start = go(&two_storeys(Arc::clone(&linear)), 0.278_154_263_102_045_05);
    for (i, u) in [0.011_237_582_645_306_226, -0.008_762_417_354_693_772]
        .iter()
        .enumerate()
    {
        near(
            "displacement at closure",
            start.final_displacement[i],
            *u,
            0.01,
        );
    }
    for (i, v) in [0.372_758_191_662_633_35, -0.045_714_371_801_376_91]
        .iter()
        .enumerate()
    {
        near("velocity at closure", start.final_velocity[i], *v, 0.3);
    }
    // Contact law, end of contact, displacements and velocities then, peak force.
    let cases: [(_, f64, [f64; 2], [f64; 2], f64); 3] = [
        (
            linear,
            0.353_270_556_122_958_43,
            [0.020_793_304_859_847_348, 0.000_793_304_859_847_347_6],
            [-0.122_452_360_213_757_81, 0.288_820_588_482_664_9],
            908_213.609_642_592_6,
        ),
        (
            kelvin_voigt(SeparationRule::ZeroPenetration),
            0.353_291_498_876_470_77,
            [0.020_765_860_606_909_32, 0.000_765_860_606_909_320_2],
            [-0.043_859_131_995_617_896, 0.234_840_502_306_190_55],
            783_354.258_210_039_1,
        ),
        (
            kelvin_voigt(SeparationRule::NoTension),
            0.346_396_031_692_624_06,
            [0.021_077_216_103_303_716, -0.000_873_130_757_624_035_5],
            [-0.044_370_124_572_488_394, 0.238_996_343_384_080_92],
            783_354.258_210_039_1,
        ),
    ];
    for (law, end, displacement, velocity, force) in cases {
        let name = format!("{:?}", law.separation());
        let cuts_tension = law.separation() == SeparationRule::NoTension;
        let system = two_storeys(law);
        let at_end = go(&system, end);
        for i in 0..2 {
            near(&name, at_end.final_displacement[i], displacement[i], 0.02);
            near(&name, at_end.final_velocity[i], velocity[i], 0.1);
        }
        let impact = &go(&system, 0.5).impacts[0];
        near(&name, impact.time_closed, 0.278_154_263_102_045_05, 0.27);
        near(
            &name,
            impact.approach_velocity,
            0.418_472_563_464_010_24,
            0.4,
        );
        near(&name, impact.peak_force.value, force, force);
        if cuts_tension {
            // Without force the floors still overlap; they part a little later.
            assert!(impact.time_opened > end);
        } else {
            near(&name, impact.time_opened, end, end);
            let parting = velocity[1] - velocity[0];
            near(&name, impact.separation_velocity, parting, parting);
        }
    }
}

/// A ball on the slab: a storey as good as without stiffness, pressed to a wall 1 m
/// away by a constant ground acceleration.
fn ball() -> System {
    let mut system = System::new(
        vec![single_storey("ball", 1.0, 1.0e-13)],
        constant_ground(-9.81, 6.0),
    );
    let law: Arc<dyn ImpactModel> = registry::build(
        "stereomechanical",
        &ModelParameters::from_pairs(&[("restitution", 0.8)]),
    )
    .unwrap()
    .into();
    let pair = (Floor::Storey(0, 0), Floor::Wall, 1.0, law);
    let names = ["ball".to_owned(), "wall".to_owned()];
    system.add_gap("slab", names, vec![pair]).unwrap();
    system
}

#[test]
fn bouncing_ball_with_its_accumulation() {
    let outcome = go(&ball(), 6.0);
    let expected = [
        0.451_523_640_985_730_9,
        1.173_961_466_562_900_3,
        1.751_911_727_024_635_8,
        2.214_271_935_394_024_6,
        2.584_160_102_089_535_3,
    ];
    for (impact, time) in outcome.impacts.iter().zip(expected) {
        near("impact", impact.time_closed, time, 1.0);
        near("restitution", impact.achieved_restitution, 0.8, 1.0);
    }
    near(
        "approach",
        outcome.impacts[0].approach_velocity,
        4.429_446_918_070_020_4,
        1.0,
    );
    // The heights of the hops, from the speeds they end with.
    for (n, impact) in outcome.impacts.iter().take(30).enumerate() {
        let height = impact.approach_velocity.powi(2) / (2.0 * 9.81);
        near("height", height, 0.64_f64.powi(n as i32), 1.0);
    }
    let last = outcome.impacts.last().unwrap();
    near("accumulation", last.time_closed, 4.063_712_768_871_578, 1.0);
    assert!(last.time_opened.is_nan(), "the ball stays on the slab");
    assert!(outcome.impacts.len() > 50, "{}", outcome.impacts.len());
    let level = &outcome.gaps[0].levels[0];
    assert_eq!(level.sticks, 1);
    near("weight", level.peak_force.value, 9.81, 1.0);
    near("rest", outcome.final_displacement[0], 1.0, 1.0);
    near("rest", outcome.final_velocity[0], 0.0, 1.0);
    // All that gravity put in went into the impacts.
    let energy = outcome.energy.end;
    near("loss", energy.impact, 9.81, 9.81);
    near("input", energy.input, 9.81, 9.81);
    assert!(outcome.energy.residual_ratio < 1e-12);
}

#[test]
fn free_vibration_carries_its_initial_energy() {
    let stiffness = 4.0e6;
    let system = System::new(
        vec![single_storey("one", 1.0e5, stiffness)],
        constant_ground(0.0, 3.0),
    );
    let system = system.with_initial_state(&[0.06], &[-0.2]).unwrap();
    let outcome = go(&system, 3.0);
    let brought = 0.5 * stiffness * 0.06_f64.powi(2) + 0.5 * 1.0e5 * 0.2_f64.powi(2);
    near("input", outcome.energy.end.input, brought, brought);
    let amplitude = (2.0 * brought / stiffness).sqrt();
    let peak = outcome.buildings[0].storeys[0].displacement;
    near("amplitude", peak.value, amplitude, amplitude);
    assert!(outcome.energy.residual_ratio < 1e-9);
}

#[test]
fn impossible_initial_states_are_refused() {
    let linear = model(
        "linear_elastic",
        &[("stiffness", 9.35e7)],
        SeparationRule::ZeroPenetration,
    );
    let system = two_storeys(linear);
    for (u, v) in [
        (vec![0.02, -0.01], vec![0.0, 0.0]),
        (vec![0.0], vec![0.0, 0.0]),
        (vec![0.0, f64::NAN], vec![0.0, 0.0]),
    ] {
        let error = system.clone().with_initial_state(&u, &v).unwrap_err();
        assert!(error.to_string().contains("initial state"), "{error}");
    }
}

/// A step beyond the limit of stability blows the motion up: an error, whatever the
/// allowance of the energy ledger, and no result.
#[test]
fn a_motion_that_is_not_finite_is_an_error() {
    let mut buildings = vec![single_storey("stiff", 1.0, 1.0e12)];
    buildings.push(single_storey("soft", 1.0, 1.0));
    let system = System::new(buildings, constant_ground(1.0, 2.0));
    let options = RunOptions {
        method: MethodChoice::RungeKutta4 { step: 1e-3 },
        duration: Some(1.0),
        energy_tolerance: Some(f64::MAX),
    };
    let error = run(&system, &options, &mut [], &mut |_| {}).unwrap_err();
    assert!(
        matches!(error, TimeHistoryError::NotFinite { .. }),
        "{error}"
    );
}

/// A floor that swings to 0.5 m at 0.157 s comes a part of 1e-12 and more beyond a wall, or as much
/// short of it, whatever the samples: a polynomial of degree 7 over a sample of 0.1 s errs by 1e-9.
#[test]
fn a_wall_is_grazed_or_not_as_the_closed_form_says() {
    let (mass, stiffness, velocity) = (1e5_f64, 1e7, 5.0_f64);
    let circular_frequency = (stiffness / mass).sqrt();
    let farthest = velocity / circular_frequency;
    for time_step in [0.01, 0.03, 0.1, 0.13, 0.5] {
        for part in [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6] {
            for beyond in [part, -part] {
                let ground = GroundAcceleration {
                    samples: vec![0.0; 60].into(),
                    time_step,
                };
                let building = single_storey("a", mass, stiffness);
                let system = System::new(vec![building], ground);
                let mut system = system.with_initial_state(&[0.0], &[velocity]).unwrap();
                let parameters = ModelParameters::from_pairs(&[("stiffness", 1e9)]);
                let law = registry::build("linear_elastic", &parameters).unwrap();
                let width = farthest * (1.0 - beyond);
                let pair = (Floor::Storey(0, 0), Floor::Wall, width, law.into());
                let names = ["a".to_owned(), "wall".to_owned()];
                system.add_gap("gap", names, vec![pair]).unwrap();
                let options = RunOptions {
                    method: MethodChoice::EventDriven {
                        relative_tolerance: 1e-10,
                    },
                    duration: Some(0.2),
                    energy_tolerance: None,
                };
                let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
                let expected = usize::from(beyond > 0.0);
                let place = format!("{beyond:e} of samples of {time_step} s");
                assert_eq!(outcome.impacts.len(), expected, "{place}");
                for impact in &outcome.impacts {
                    let approach = (velocity.powi(2) - (circular_frequency * width).powi(2)).sqrt();
                    let error = (impact.approach_velocity - approach).abs();
                    // That velocity is of a place that is known to some 1e-15 m.
                    let slope = circular_frequency.powi(2) * width / approach;
                    let allowed = 4e-15 * slope + 1e-9 * approach;
                    assert!(error <= allowed, "{place}: {error:e} of {approach:e}");
                }
            }
        }
    }
}
