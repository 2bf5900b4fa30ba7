//! Impact counts and first contacts do not depend on the method: four methods that share
//! the laws alone, on random systems with gaps of zero and nearly zero width, at rest and
//! moving, with all separation rules.
//!
//! `POUNDING_SYSTEMS=5000 cargo test --release -p verification --test impact_counts -- --nocapture`
//! takes more of them.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use pounding_gap_element::registry;
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, LevelOutcome, MethodChoice, Outcome, RunOptions, System, run,
};
use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardUniform};

/// Systems that every run of the tests takes.
const SYSTEMS: u64 = 60;
const DURATION: f64 = 0.6;

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
    let cards: Vec<_> = registry::descriptors()
        .iter()
        .filter(|d| d.name != "stereomechanical")
        .collect();
    let card = cards[chance.below(cards.len())];
    let rules = card.separation_rules;
    let restitution = chance.between(0.3, 0.95);
    let mut parameters = card.example_parameters(restitution);
    let rule = (!rules.is_empty()).then(|| rules[chance.below(rules.len())]);
    if let Some(rule) = rule {
        parameters = parameters.with_separation(rule);
    }
    if chance.number() < 0.4 {
        let total: usize = if wall { storeys[0] } else { storeys.iter().sum() };
        let speed = chance.logarithmic(1e-6, 0.3);
        let velocity: Vec<f64> = (0..total).map(|_| chance.between(-speed, speed)).collect();
        system = system
            .with_initial_state(&vec![0.0; total], &velocity)
            .unwrap();
    }
    let pairs = (0..levels)
        .map(|s| {
            let right = if wall { Floor::Wall } else { Floor::Storey(1, s) };
            let model = registry::build(card.name, &parameters).unwrap();
            (Floor::Storey(0, s), right, width, model.into())
        })
        .collect();
    let names = ["a".to_owned(), "b".to_owned()];
    system.add_gap("gap", names, pairs).unwrap();
    let what = format!("seed {seed}: {} {rule:?} {storeys:?} wall {wall} width {width:e}", card.name);
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

fn methods() -> [(MethodChoice, f64); 3] {
    let step = 2e-5;
    [
        (MethodChoice::Adaptive { relative_tolerance: 1e-11 }, 1e-9),
        (MethodChoice::RungeKutta4 { step }, 1e-8),
        (MethodChoice::Newmark { step, beta: 0.25, gamma: 0.5 }, 1e-7),
    ]
}

fn levels(outcome: &Outcome) -> &[LevelOutcome] {
    &outcome.gaps[0].levels
}

/// Counts and first contacts of all levels.
fn contacts(outcome: &Outcome) -> Vec<(usize, Option<f64>)> {
    let of = |l: &LevelOutcome| (l.impacts, l.first_contact);
    levels(outcome).iter().map(of).collect()
}

#[test]
fn counts_do_not_depend_on_the_method() {
    let count = std::env::var("POUNDING_SYSTEMS").map_or(SYSTEMS, |n| n.parse().unwrap());
    let first = std::env::var("POUNDING_FIRST").map_or(0, |n| n.parse().unwrap());
    let (mut differing, mut impacts) = (0, 0);
    for seed in first..first + count {
        let (system, what) = system(seed);
        let reference = match go(&system, REFERENCE) {
            Ok(o) => o,
            Err(e) => { println!("{what}: reference: {e}"); differing += 1; continue; }
        };
        impacts += reference.impacts.len();
        for (method, size) in methods() {
            let other = match go(&system, method) {
                Ok(o) => o,
                Err(e) => { println!("{what}: {method:?}: {e}"); differing += 1; continue; }
            };
            let (a, b) = (contacts(&reference), contacts(&other));
            let same = a.iter().zip(&b).all(|(a, b)| {
                a.0 == b.0 && match (a.1, b.1) {
                    (Some(s), Some(t)) => (s - t).abs() < 1e-5,
                    (None, None) => true,
                    _ => false,
                }
            });
            if !same {
                differing += 1;
                println!("{what}\n  {method:?} {size}: {a:?}\n  {b:?}");
                for l in 0..levels(&reference).len() {
                    let list = |o: &Outcome| o.impacts.iter().filter(|i| i.level == l).map(|i| format!("[{:.7}..{:.7} v {:.1e} p {:.1e}]", i.time_closed, i.time_opened, i.approach_velocity, i.peak_penetration.value)).collect::<Vec<_>>().join(" ");
                    if a[l].0 != b[l].0 { println!("   {l}: {}\n      {}", list(&reference), list(&other)); }
                }
            }
        }
    }
    println!("{count} systems, {impacts} impacts, {differing} differ");
    assert_eq!(differing, 0);
}
