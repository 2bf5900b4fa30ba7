//! Impact counts and first contacts do not depend on the method: four methods that share
//! the laws alone, on random systems with gaps of zero and nearly zero width, at rest and
//! moving, with all separation rules.
//!
//! `POUNDING_SYSTEMS=5000 cargo test --release -p verification --test integration impact_counts -- --nocapture`
//! takes more of them.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use pounding_gap_element::registry;
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, Impact, MethodChoice, Outcome, RunOptions, System, run,
};
use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardUniform};

/// Systems that every run of the tests takes.
const SYSTEMS: u64 = 60;
const DURATION: f64 = 0.6;

/// Systems that came out differently once: terms that a longer series had left hid the end of
/// a contact (3957), and round-off let phases change back and forth without progress.
const ONCE_DIFFERENT: [u64; 3] = [2139, 2512, 3957];

/// Random numbers of one system.
struct Chance(ChaCha20Rng);

impl Chance {
    fn number(&mut self) -> f64 {
        StandardUniform.sample(&mut self.0)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.number()
    }

    fn logarithmic(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.number())
    }

    fn below(&mut self, count: usize) -> usize {
        (self.number() * count as f64) as usize
    }
}

fn building(chance: &mut Chance, name: &str, storeys: usize) -> Arc<ShearBuilding> {
    let period = chance.between(0.15, 1.2);
    let mass = chance.logarithmic(5e3, 5e5);
    let angle = std::f64::consts::PI / (2.0 * (2.0 * storeys as f64 + 1.0));
    let omega = std::f64::consts::TAU / period;
    let stiffness = mass * (omega / (2.0 * angle.sin())).powi(2);
    let vary = |chance: &mut Chance, x: f64| x * chance.between(0.7, 1.4);
    let masses = (0..storeys).map(|_| vary(chance, mass)).collect();
    let stiffnesses = (0..storeys).map(|_| vary(chance, stiffness)).collect();
    let ratio = [0.0, 0.02, 0.05][chance.below(3)];
    let damping = Damping::StiffnessProportional { ratio };
    let height = vec![3.0; storeys];
    Arc::new(ShearBuilding::new(name.into(), masses, stiffnesses, height, damping).unwrap())
}

fn ground(chance: &mut Chance) -> GroundAcceleration {
    let time_step = [0.005, 0.01, 0.02][chance.below(3)];
    let count = (DURATION / time_step) as usize + 2;
    let pushes: Vec<f64> = (0..count).map(|_| chance.between(-4.0, 4.0)).collect();
    let quiet = chance.below(8);
    let steady = chance.number() < 0.25;
    let sample = |i: usize| match i {
        i if i < quiet && quiet < 5 => 0.0,
        _ if steady => pushes[0],
        i => pushes[i],
    };
    GroundAcceleration {
        samples: (0..count).map(sample).collect::<Vec<_>>().into(),
        time_step,
    }
}

/// A system, and what it is in words.
fn system(seed: u64) -> (System, String) {
    let mut chance = Chance(ChaCha20Rng::seed_from_u64(seed));
    let storeys = [1 + chance.below(4), 1 + chance.below(4)];
    let wall = chance.number() < 0.2;
    let mut buildings = vec![building(&mut chance, "a", storeys[0])];
    if !wall {
        buildings.push(building(&mut chance, "b", storeys[1]));
    }
    let ground = ground(&mut chance);
    let mut system = System::new(buildings, ground);
    let levels = if wall {
        storeys[0]
    } else {
        storeys[0].min(storeys[1])
    };
    let width = match chance.below(4) {
        0 | 1 => 0.0,
        2 => chance.logarithmic(1e-13, 1e-6),
        _ => chance.logarithmic(1e-6, 1e-3),
    };
    let descriptors: Vec<_> = registry::descriptors()
        .iter()
        .filter(|d| d.name != "stereomechanical")
        .collect();
    let descriptor = descriptors[chance.below(descriptors.len())];
    let rules = descriptor.separation_rules;
    let restitution = chance.between(0.3, 0.95);
    let mut parameters = descriptor.example_parameters(restitution);
    let rule = (!rules.is_empty()).then(|| rules[chance.below(rules.len())]);
    if let Some(rule) = rule {
        parameters = parameters.with_separation(rule);
    }
    if chance.number() < 0.4 {
        let total: usize = if wall {
            storeys[0]
        } else {
            storeys.iter().sum()
        };
        let speed = chance.logarithmic(1e-6, 0.3);
        let velocity: Vec<f64> = (0..total).map(|_| chance.between(-speed, speed)).collect();
        system = system
            .with_initial_state(&vec![0.0; total], &velocity)
            .unwrap();
    }
    let pairs = (0..levels)
        .map(|s| {
            let right = if wall {
                Floor::Wall
            } else {
                Floor::Storey(1, s)
            };
            let model = registry::build(descriptor.name, &parameters).unwrap();
            (Floor::Storey(0, s), right, width, model.into())
        })
        .collect();
    let names = ["a".to_owned(), "b".to_owned()];
    system.add_gap("gap", names, pairs).unwrap();
    let what = format!(
        "seed {seed}: {} {rule:?} {storeys:?} wall {wall} width {width:e}",
        descriptor.name
    );
    (system, what)
}

fn go(system: &System, method: MethodChoice) -> Result<Outcome, String> {
    let options = RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: Some(1e-3),
    };
    run(system, &options, &mut [], &mut |_| {}).map_err(|e| e.to_string())
}

const REFERENCE: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-11,
};

/// The other methods, each with the difference (s) that its first contacts may have.
fn others() -> [(MethodChoice, f64); 3] {
    let step = 2e-5;
    let relative_tolerance = 1e-11;
    let (beta, gamma) = (0.25, 0.5);
    [
        (MethodChoice::Adaptive { relative_tolerance }, 1e-7),
        (MethodChoice::RungeKutta4 { step }, 1e-6),
        (MethodChoice::Newmark { step, beta, gamma }, 1e-5),
    ]
}

/// Impacts and first contacts of all levels.
fn contacts(outcome: &Outcome) -> Vec<(usize, Option<f64>)> {
    let levels = &outcome.gaps[0].levels;
    levels
        .iter()
        .map(|l| (l.impacts, l.first_contact))
        .collect()
}

fn agree(a: &[(usize, Option<f64>)], b: &[(usize, Option<f64>)], tolerance: f64) -> bool {
    a.iter().zip(b).all(|(a, b)| {
        let first = match (a.1, b.1) {
            (Some(s), Some(t)) => (s - t).abs() < tolerance,
            (None, None) => true,
            _ => false,
        };
        a.0 == b.0 && first
    })
}

/// What differs between two methods on one system, in words.
fn differences(seed: u64) -> (usize, Vec<String>) {
    let (system, what) = system(seed);
    let reference = match go(&system, REFERENCE) {
        Ok(outcome) => outcome,
        Err(reason) => return (0, vec![format!("{what}: {reason}")]),
    };
    let counted = contacts(&reference);
    let mut found = Vec::new();
    for (method, tolerance) in others() {
        match go(&system, method) {
            Ok(outcome) if agree(&counted, &contacts(&outcome), tolerance) => {}
            Ok(outcome) => found.push(format!(
                "{what}: {method:?}\n  {counted:?}\n  {:?}\n{}",
                contacts(&outcome),
                listed(&reference, &outcome)
            )),
            Err(reason) => found.push(format!("{what}: {method:?}: {reason}")),
        }
    }
    (reference.impacts.len(), found)
}

/// Impacts of two runs, those of a level in a line.
fn listed(a: &Outcome, b: &Outcome) -> String {
    let impact = |i: &Impact| {
        let (v, p) = (i.approach_velocity, i.peak_penetration.value);
        format!(
            "[{:.7}..{:.7} {v:.1e} m/s {p:.1e} m]",
            i.time_closed, i.time_opened
        )
    };
    let level = |o: &Outcome, l: usize| {
        let of_level = o.impacts.iter().filter(|i| i.level == l);
        of_level.map(impact).collect::<Vec<_>>().join(" ")
    };
    let levels = 0..a.gaps[0].levels.len();
    let lines = levels.map(|l| format!("  {l}: {}\n     {}\n", level(a, l), level(b, l)));
    lines.collect()
}

#[test]
fn counts_do_not_depend_on_the_method() {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
    };
    let (first, count) = (
        number("POUNDING_FIRST", 0),
        number("POUNDING_SYSTEMS", SYSTEMS),
    );
    let seeds: Vec<u64> = (first..first + count).chain(ONCE_DIFFERENT).collect();
    // One test takes as long as half of the others: its systems go to all cores.
    let cores = std::thread::available_parallelism().unwrap().get();
    let (mut impacts, mut differing) = (0, Vec::new());
    std::thread::scope(|scope| {
        let share = |core| seeds.iter().skip(core).step_by(cores);
        let work = |core| move || share(core).map(|seed| differences(*seed)).collect();
        let running: Vec<_> = (0..cores).map(|core| scope.spawn(work(core))).collect();
        for one in running {
            let counted: Vec<(usize, Vec<String>)> = one.join().unwrap();
            for (counted, found) in counted {
                impacts += counted;
                differing.extend(found);
            }
        }
    });
    for text in &differing {
        println!("{text}");
    }
    println!(
        "{count} systems, {impacts} impacts, {} differences",
        differing.len()
    );
    assert!(impacts as u64 > count, "{impacts} impacts");
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

/// A gap of floors that set out together crosses zero by round-off in every long step from there, and in no short one:
/// 22 million steps were cut there once, of a run that has 15,000 without events.
#[test]
fn floors_that_set_out_together_are_stepped_on() {
    let step = 4e-5;
    let outcome = go(&system(236).0, MethodChoice::RungeKutta4 { step }).unwrap();
    let steps = outcome.statistics.steps;
    assert!(steps < 50_000, "{steps}");
}

/// Floors that touch, and approach by less than counts as motion, meet at rest: over such a speed, that of parting would be
/// a restitution of any number up to 1e9 and more.
#[test]
fn floors_that_meet_at_rest_have_no_restitution() {
    let mut met = 0;
    for seed in 0..SYSTEMS {
        let (system, what) = system(seed);
        let storeys = system.degrees_of_freedom();
        let mut velocity = vec![0.0; storeys];
        velocity[..system.buildings()[0].storeys()].fill(3e-10);
        let crept = system.with_initial_state(&vec![0.0; storeys], &velocity);
        let outcome = go(&crept.unwrap(), REFERENCE).unwrap();
        for impact in &outcome.impacts {
            let ratio = impact.separation_velocity / impact.approach_velocity;
            if impact.approach_velocity > 1e-9 {
                let found = impact.achieved_restitution;
                assert!(
                    found == ratio || (found.is_nan() && ratio.is_nan()),
                    "{what}"
                );
            } else {
                met += usize::from(impact.approach_velocity > 1e-10 && ratio > 1e3);
                assert!(impact.achieved_restitution.is_nan(), "{what}: {impact:?}");
            }
        }
        for (l, level) in outcome.gaps[0].levels.iter().enumerate() {
            let mut of_level = outcome.impacts.iter().filter(|i| i.level == l);
            let any = of_level.any(|i| i.achieved_restitution.is_finite());
            assert_eq!(level.achieved_restitution.is_some(), any, "{what}");
        }
    }
    assert!(met > 0, "{met}");
}
