//! A looser tolerance costs no more steps, and impulse and loss of impacts follow the
//! tolerance: stiff buildings that yield, beside one another without a gap.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_hysteresis::{LawParameters, yield_deformation};
use pounding_shear_building::{Damping, ShearBuilding, StoreyLaw};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run,
};

const TOLERANCES: [f64; 9] = [1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// Part by which events that fall differently into the steps may change their number.
const EVEN: f64 = 0.01;

fn laws(name: &str, stiffness: &[f64], yield_force: &[f64], hardening: f64) -> Vec<StoreyLaw> {
    let storeys = stiffness.iter().zip(yield_force);
    let law = |(k, fy): (&f64, &f64)| {
        let mut values = vec![("stiffness", *k), ("yield_force", *fy)];
        if hardening > 0.0 {
            values.push(("hardening_ratio", hardening));
        }
        let parameters = LawParameters::from_pairs(&values);
        StoreyLaw {
            yield_drift: yield_deformation(
                pounding_hysteresis::find(name).unwrap(),
                &parameters,
                *k,
            ),
            law: pounding_hysteresis::build(name, &parameters)
                .unwrap()
                .into(),
        }
    };
    storeys.map(law).collect()
}

/// A building of ordinary stiffness beside one that is 400,000 times as stiff and damped
/// beyond critical: its fastest mode decays within 0.2 ms.
fn stiff_pair(pulse: f64, model: &str, duration: f64) -> System {
    let stiffness = [2.726_45e8, 1.858_04e8, 2.749_49e8, 2.175_8e8];
    let yield_force = [2.736e6, 7.699_3e5, 5.640_6e5, 5.822_3e5];
    let law = "elastic_perfectly_plastic";
    let light = ShearBuilding::new(
        "light".to_owned(),
        vec![877_001.0, 426_546.0, 1_047_010.0, 404_659.0],
        stiffness.to_vec(),
        vec![3.0; 4],
        Damping::RayleighRatio {
            ratio: 0.0383,
            modes: [2, 3],
        },
    );
    let light = light.unwrap().with_laws(
        laws(law, &stiffness, &yield_force, 0.0)
            .into_iter()
            .map(Some)
            .collect(),
    );
    let stiffness = [1.077_99e14, 1.589_45e14, 1.121_58e14];
    let yield_force = [9.967_6e9, 7.712_1e9, 3.243_7e9];
    let heavy = ShearBuilding::new(
        "heavy".to_owned(),
        vec![4.876e9, 8.782_83e9, 6.465_72e9],
        stiffness.to_vec(),
        vec![3.0; 3],
        Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.084_275,
        },
    );
    let heavy = heavy.unwrap().with_laws(
        laws("bouc_wen", &stiffness, &yield_force, 0.131)
            .into_iter()
            .map(Some)
            .collect(),
    );
    let mut samples = vec![0.0; (duration / 0.02) as usize + 2];
    samples[14] = pulse;
    let ground = GroundAcceleration {
        samples: samples.into(),
        time_step: 0.02,
    };
    let buildings = vec![Arc::new(light.unwrap()), Arc::new(heavy.unwrap())];
    let mut system = System::new(buildings, ground);
    let parameters =
        ModelParameters::from_pairs(&[("stiffness", 3.8168e13), ("restitution", 0.799)]);
    let model = registry::build(model, &parameters).unwrap().into();
    let pair = (Floor::Storey(0, 3), Floor::Storey(1, 0), 0.0, model);
    let names = ["light".to_owned(), "heavy".to_owned()];
    system.add_gap("light-heavy", names, vec![pair]).unwrap();
    system
}

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn adaptive(relative_tolerance: f64) -> MethodChoice {
    MethodChoice::Adaptive { relative_tolerance }
}

/// Work of a run: steps with those that were rejected or taken to locate events.
fn work(outcome: &Outcome) -> f64 {
    let s = &outcome.statistics;
    (s.steps + s.rejected + s.location_steps) as f64
}

fn loss(outcome: &Outcome) -> f64 {
    outcome.gaps[0].levels[0].energy_dissipated
}

fn impulse(outcome: &Outcome) -> f64 {
    outcome.gaps[0].levels[0].impulse
}

/// Errors of loss and impulse are at most so many tolerances, and the work never grows.
fn follows(system: &System, method: fn(f64) -> MethodChoice, duration: f64, factor: f64) {
    let truth = go(system, adaptive(1e-13), duration);
    assert!(truth.impacts.len() > 5, "{}", truth.impacts.len());
    let mut before = f64::INFINITY;
    for tolerance in TOLERANCES {
        let outcome = go(system, method(tolerance), duration);
        assert!(
            work(&outcome) <= before * (1.0 + EVEN),
            "{tolerance:e}: {} after {before}",
            work(&outcome)
        );
        before = before.min(work(&outcome));
        assert_eq!(outcome.impacts.len(), truth.impacts.len(), "{tolerance:e}");
        for (what, one, other) in [
            ("loss", loss(&outcome), loss(&truth)),
            ("impulse", impulse(&outcome), impulse(&truth)),
        ] {
            let error = (one / other - 1.0).abs();
            assert!(
                error <= factor * tolerance.max(1e-13),
                "{what} at {tolerance:e}: off by {error:e}"
            );
        }
    }
}

#[test]
fn a_looser_tolerance_is_not_slower_and_the_loss_follows_it() {
    let system = stiff_pair(0.5, "muthukumar_desroches_2006", 6.66);
    follows(&system, adaptive, 6.66, 20.0);
    let event_driven = |relative_tolerance| MethodChoice::EventDriven { relative_tolerance };
    follows(&system, event_driven, 6.66, 20.0);
}

/// Floors that meet at some millimetres a second: velocities and penetrations far below
/// those of ordinary impacts.
#[test]
fn slow_impacts_follow_the_tolerance_too() {
    let system = stiff_pair(0.005, "muthukumar_desroches_2006", 3.0);
    follows(&system, adaptive, 3.0, 1000.0);
}

/// Numbers that look random, the same in every run.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let mixed = (self.0 ^ (self.0 >> 33)).wrapping_mul(0xff51_afd7_ed55_8ccd);
        ((mixed ^ (mixed >> 33)) >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn below(&mut self, n: usize) -> usize {
        (self.unit() * n as f64) as usize
    }
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }
}

/// Two buildings of any stiffness and law without a gap, under two periods of a sine.
fn random_pair(seed: u64) -> System {
    const LAWS: [&str; 6] = [
        "",
        "elastic_perfectly_plastic",
        "bouc_wen",
        "bilinear",
        "takeda",
        "modified_clough",
    ];
    const MODELS: [&str; 7] = [
        "muthukumar_desroches_2006",
        "jankowski_2005",
        "hertz_1882",
        "anagnostopoulos_2004",
        "linear_elastic",
        "muthukumar_2003",
        "ye_li_2009",
    ];
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 777);
    for _ in 0..5 {
        random.unit();
    }
    let (mut buildings, mut storeys) = (Vec::new(), Vec::new());
    let strength = random.between(0.2, 6.0);
    for index in 0..2 {
        let n = 1 + random.below(5);
        let scale = random.between(2e4, 5e9);
        let mass: Vec<f64> = (0..n).map(|_| scale * (0.5 + random.unit())).collect();
        let omega = random.between(6.0, 300.0);
        let mean = scale * omega * omega;
        let stiffness: Vec<f64> = (0..n).map(|_| mean * (0.5 + random.unit())).collect();
        let beta = [0.1 / omega, random.between(1e-4, 0.3), 0.0][random.below(3)];
        let name = LAWS[random.below(6)];
        let yield_force = scale * strength * (0.1 + random.unit());
        let damping = Damping::Rayleigh { alpha: 0.0, beta };
        let height = vec![3.0; n];
        let title = format!("b{index}");
        let mut building =
            ShearBuilding::new(title, mass, stiffness.clone(), height, damping).unwrap();
        if !name.is_empty() {
            let law = |k: &f64| {
                let descriptor = pounding_hysteresis::find(name).unwrap();
                let mut all = descriptor.example_parameters();
                let own = [("stiffness", *k), ("yield_force", yield_force)];
                all.values.extend(LawParameters::from_pairs(&own).values);
                Some(StoreyLaw {
                    yield_drift: yield_deformation(descriptor, &all, *k),
                    law: pounding_hysteresis::build(name, &all).unwrap().into(),
                })
            };
            let laws = stiffness.iter().map(law).collect();
            building = building.with_laws(laws).unwrap();
        }
        buildings.push(Arc::new(building));
        storeys.push(n);
    }
    let time_step = [0.01, 0.02][random.below(2)];
    let frequency = random.between(0.5, 8.0);
    let sample = |i: usize| {
        let t = i as f64 * time_step;
        let inside = t < 2.0 / frequency;
        let sine = strength * (std::f64::consts::TAU * frequency * t).sin();
        if inside { sine } else { 0.0 }
    };
    let samples: Vec<f64> = (0..(2.0 / time_step) as usize + 1).map(sample).collect();
    let ground = GroundAcceleration {
        samples: samples.into(),
        time_step,
    };
    let mut system = System::new(buildings, ground);
    let name = MODELS[random.below(7)];
    let mut values = vec![("stiffness", random.between(1e8, 1e13))];
    if !["hertz_1882", "linear_elastic"].contains(&name) {
        values.push(("restitution", 0.4 + 0.5 * random.unit()));
    }
    let model: Arc<dyn ImpactModel> = registry::build(name, &ModelParameters::from_pairs(&values))
        .unwrap()
        .into();
    let pair = |s| {
        let (left, right) = (Floor::Storey(0, s), Floor::Storey(1, s));
        (left, right, 0.0, Arc::clone(&model))
    };
    let pairs = (0..storeys[0].min(storeys[1])).map(pair).collect();
    let names = ["b0".to_owned(), "b1".to_owned()];
    system.add_gap("b0-b1", names, pairs).unwrap();
    system
}

/// Among them pairs whose storeys turn while they yield, and pairs whose contact begins at
/// rest: an interpolant of a long step would have them leave their branch again at once.
#[test]
fn random_pairs_take_no_more_steps_at_loose_tolerances() {
    let total = |o: &Outcome| -> f64 {
        let levels = &o.gaps[0].levels;
        levels.iter().map(|l| l.energy_dissipated).sum()
    };
    for seed in 1..=16 {
        let system = random_pair(seed);
        let truth = go(&system, adaptive(1e-12), 2.0);
        for tolerance in [1e-9, 1e-7, 1e-5, 1e-4] {
            let options = RunOptions {
                method: adaptive(tolerance),
                duration: Some(2.0),
                energy_tolerance: Some(tolerance.max(1e-6)),
            };
            let outcome = run(&system, &options, &mut [], &mut |_| {}).unwrap();
            let (loose, tight) = (work(&outcome), work(&truth));
            assert!(
                loose <= tight,
                "pair {seed} at {tolerance:e}: {loose}, not {tight}"
            );
            let error = (total(&outcome) - total(&truth)).abs() / truth.energy.largest_input;
            assert!(
                error <= tolerance,
                "pair {seed} at {tolerance:e}: loss off by {error:e} of the input"
            );
        }
    }
}

/// Fixed steps meet the same events: a cubic through a step of 0.2 ms does not follow the
/// fastest mode, and its turning points are not those of the motion.
#[test]
fn fixed_steps_have_the_same_events() {
    let system = stiff_pair(0.5, "muthukumar_desroches_2006", 1.5);
    let truth = go(&system, adaptive(1e-12), 1.5);
    let fixed = go(&system, MethodChoice::RungeKutta4 { step: 2e-4 }, 1.5);
    let collisions = |o: &Outcome| o.impacts.iter().filter(|i| i.impulse > 0.0).count();
    assert_eq!(collisions(&fixed), collisions(&truth));
    let (events, expected) = (fixed.statistics.events, truth.statistics.events);
    assert!(events <= expected + 10, "{events} events, not {expected}");
    assert!((loss(&fixed) / loss(&truth) - 1.0).abs() < 1e-4);
    assert!((impulse(&fixed) / impulse(&truth) - 1.0).abs() < 1e-5);
}
