//! Rigid floors that are held together, several at once: which of them let go, and when, in
//! closed form; and random rows by two methods that have nothing in common but the laws.
//!
//! `POUNDING_SYSTEMS=500 cargo test -p verification --test integration rigid_held -- --nocapture`
//! takes more of them.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, FloorForce, ForceHistory, GroundAcceleration, LevelOutcome, MethodChoice, Outcome,
    RunOptions, StoreyPeaks, System, run,
};
use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardUniform};
use verification::{constant_ground, free_bodies, rigid, synthetic_motion};

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

const LOCATING: [MethodChoice; 4] = [
    MethodChoice::EventDriven {
        relative_tolerance: 1e-11,
    },
    MethodChoice::Adaptive {
        relative_tolerance: 1e-12,
    },
    MethodChoice::RungeKutta4 { step: 1e-3 },
    MethodChoice::Newmark {
        step: 1e-3,
        beta: 0.25,
        gamma: 0.5,
    },
];

/// Masses (kg) of A and B, the force (N) that presses A against B, and the part of it that
/// pulls B from the wall behind it.
const MASS: [f64; 2] = [1.0e4, 2.0e4];
const PUSH: f64 = 3.0e4;
const PULL: f64 = 0.6;
/// What is left of the push in the end, as a part of it.
const END: f64 = -0.8;
const DURATION: f64 = 1.0;

/// A, B and a wall that touch, with this push on A (times of its points in s, parts of
/// [`PUSH`]) and the pull on B.
fn pressed(points: &[(f64, f64)], restitution: f64) -> System {
    let ground = constant_ground(0.0, DURATION);
    let system = free_bodies(&MASS, &[0.0, 0.0], restitution, ground);
    let force = |building: usize, points: &[(f64, f64)]| {
        let points: Vec<_> = points.iter().map(|(t, part)| (*t, part * PUSH)).collect();
        FloorForce {
            building,
            storey: 0,
            history: ForceHistory::new(&points, true).unwrap(),
            origin: String::new(),
        }
    };
    let forces = vec![force(0, points), force(1, &[(0.0, -PULL)])];
    system.with_forces(forces).unwrap()
}

fn near(what: &str, computed: f64, expected: f64, tolerance: f64) {
    assert!(
        (computed - expected).abs() <= tolerance * expected.abs().max(1.0),
        "{what}: {computed}, not {expected}"
    );
}

/// Storeys have no resistance, so that all follows from the forces alone. While the push `F` is
/// more than the pull `G`, all is held: by `F` between A and B, by `F - G` at the wall. Then B
/// leaves the wall, A and B go on together with `(F - G) / (m_A + m_B)`, until A is not pushed
/// any more than B is pulled: `F / m_A = -G / m_B`. No acceleration is greater than that of
/// A or B alone in the end.
#[test]
fn a_held_row_lets_go_one_after_the_other() {
    let (from, slope) = (0.3, 5.0);
    let to = from + (1.0 - END) / slope;
    let at = |part: f64| from + (1.0 - part) / slope;
    let (wall, pair) = (at(PULL), at(-PULL * MASS[0] / MASS[1]));
    let both = MASS[0] + MASS[1];
    // Integrals of the push from B's release on, in parts of it.
    let until = |t: f64| (t - from) - 0.5 * slope * (t - from).powi(2);
    let together = PUSH * (until(pair) - until(wall) - PULL * (pair - wall)) / both;
    let alone = together + PUSH / MASS[0] * (until(to) - until(pair) + END * (DURATION - to));
    let other = together - PUSH * PULL / MASS[1] * (DURATION - pair);
    for restitution in [0.0, 0.3, 1.0] {
        let system = pressed(&[(0.0, 1.0), (from, 1.0), (to, END)], restitution);
        for method in LOCATING {
            let outcome = go(&system, method, DURATION);
            let what = format!("{method:?}, e = {restitution}");
            let times: Vec<_> = (outcome.impacts.iter())
                .map(|i| (i.gap, i.time_closed, i.time_opened))
                .collect();
            let &[first, second] = times.as_slice() else {
                panic!("{what}: {:?}", outcome.impacts);
            };
            assert_eq!((first.0, second.0), (0, 1), "{what}");
            for (contact, opened) in [(first, pair), (second, wall)] {
                near(&what, contact.1, 0.0, 0.0);
                near(&what, contact.2, opened, 1e-9);
            }
            near(&what, outcome.final_velocity[0], alone, 1e-8);
            near(&what, outcome.final_velocity[1], other, 1e-8);
            let peaks = peaks(&outcome, |s| s.acceleration_absolute.value);
            near(&what, peaks[0], -END * PUSH / MASS[0], 1e-9);
            near(&what, peaks[1], PULL * PUSH / MASS[1], 1e-9);
            let levels: Vec<_> = outcome.gaps.iter().map(|g| &g.levels[0]).collect();
            near(&what, levels[0].peak_force.value, PUSH, 1e-9);
            near(&what, levels[1].peak_force.value, (1.0 - PULL) * PUSH, 1e-9);
            assert_eq!((levels[0].sticks, levels[1].sticks), (1, 1), "{what}");
            assert!(outcome.energy.residual_ratio < 1e-9, "{what}");
        }
    }
}

/// The push turns round at once: no force crosses zero, both contacts end at the jump.
#[test]
fn a_held_row_lets_go_where_the_force_jumps() {
    let jump = 0.31;
    let system = pressed(&[(0.0, 1.0), (jump, 1.0), (jump, END)], 0.0);
    for method in LOCATING {
        let outcome = go(&system, method, DURATION);
        let what = format!("{method:?}");
        assert_eq!(outcome.impacts.len(), 2, "{what}: {:?}", outcome.impacts);
        for impact in &outcome.impacts {
            near(&what, impact.time_opened, jump, 1e-12);
        }
        let peaks = peaks(&outcome, |s| s.acceleration_absolute.value);
        near(&what, peaks[0], -END * PUSH / MASS[0], 1e-9);
        near(&what, peaks[1], PULL * PUSH / MASS[1], 1e-9);
        let left = DURATION - jump;
        let expected = [END * PUSH / MASS[0] * left, -PULL * PUSH / MASS[1] * left];
        near(&what, outcome.final_velocity[0], expected[0], 1e-9);
        near(&what, outcome.final_velocity[1], expected[1], 1e-9);
    }
}

/// Systems that every run of the tests takes.
const SYSTEMS: u64 = 60;
const SHAKEN: f64 = 5.0;

struct Chance(ChaCha20Rng);

impl Chance {
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let number: f64 = StandardUniform.sample(&mut self.0);
        low + (high - low) * number
    }

    fn below(&mut self, count: usize) -> usize {
        self.between(0.0, count as f64) as usize
    }
}

fn building(chance: &mut Chance, index: usize) -> ShearBuilding {
    let storeys = 1 + chance.below(4);
    // Every other building is much stiffer: it presses, and is hit while it is held.
    let hard = if index % 2 == 1 {
        chance.between(1.0, 12.0)
    } else {
        chance.between(0.3, 1.0)
    };
    let mass = (0..storeys).map(|_| chance.between(5e4, 2e5)).collect();
    let stiffness = (0..storeys).map(|_| hard * chance.between(4e7, 9e7));
    let stiffness = stiffness.collect();
    let damping = [
        Damping::StiffnessProportional { ratio: 0.03 },
        Damping::Modal { ratios: vec![0.04] },
    ];
    let damping = damping[chance.below(2)].clone();
    let name = format!("b{index}");
    ShearBuilding::new(name, mass, stiffness, vec![3.0; storeys], damping).unwrap()
}

/// Two or three buildings, most of them behind a wall, with no restitution or little.
fn row(seed: u64, ground: &GroundAcceleration) -> System {
    let mut chance = Chance(ChaCha20Rng::seed_from_u64(seed));
    let count = 2 + chance.below(2);
    let buildings: Vec<_> = (0..count)
        .map(|i| Arc::new(building(&mut chance, i)))
        .collect();
    let storeys: Vec<usize> = buildings.iter().map(|b| b.storeys()).collect();
    let restitution = match chance.below(3) {
        0 => chance.between(0.02, 0.3),
        _ => 0.0,
    };
    let scale = chance.between(0.5, 2.0);
    let mut ground = ground.clone();
    ground.samples = Arc::new(ground.samples.iter().map(|a| scale * a).collect());
    let mut system = System::new(buildings, ground);
    let mut add = |chance: &mut Chance, left: Option<usize>, right: usize| {
        let width = chance.between(0.001, 0.02);
        let levels = left.map_or(storeys[right], |l| storeys[l].min(storeys[right]));
        let pair = |s| {
            let left = left.map_or(Floor::Wall, |l| Floor::Storey(l, s));
            (left, Floor::Storey(right, s), width, rigid(restitution))
        };
        let name = |b: Option<usize>| b.map_or("wall".to_owned(), |b| format!("b{b}"));
        let names = [name(left), name(Some(right))];
        let title = names.join("-");
        let pairs = (0..levels).map(pair).collect();
        system.add_gap(&title, names, pairs).unwrap();
    };
    if chance.below(3) > 0 {
        add(&mut chance, None, 0);
    }
    for left in 0..count - 1 {
        add(&mut chance, Some(left), left + 1);
    }
    system
}

fn peaks(outcome: &Outcome, pick: fn(&StoreyPeaks) -> f64) -> Vec<f64> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    storeys.map(pick).collect()
}

fn of_levels<T>(outcome: &Outcome, pick: fn(&LevelOutcome) -> T) -> Vec<T> {
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    levels.map(pick).collect()
}

/// What two runs have not in common, in words.
fn differences(a: &Outcome, b: &Outcome) -> Vec<String> {
    let mut found = Vec::new();
    let counts = |o| of_levels(o, |l| (l.impacts, l.sticks));
    if counts(a) != counts(b) {
        found.push(format!("counts {:?} and {:?}", counts(a), counts(b)));
    }
    let mut compare = |what: &str, x: Vec<f64>, y: Vec<f64>, size: f64| {
        let size = x.iter().fold(size, |m, x| m.max(x.abs()));
        for (place, (x, y)) in x.iter().zip(&y).enumerate() {
            // A level without a lasting contact has no force, in both runs.
            if !((x - y).abs() <= 1e-6 * size || (x.is_nan() && y.is_nan())) {
                found.push(format!("{what} {place}: {x} and {y}"));
            }
        }
    };
    let input = a.energy.largest_input;
    let acceleration = |o| peaks(o, |s| s.acceleration_absolute.value);
    compare("acceleration", acceleration(a), acceleration(b), 0.0);
    let drift = |o| peaks(o, |s| s.displacement.value);
    compare("displacement", drift(a), drift(b), 0.0);
    let impulse = |o| of_levels(o, |l| l.impulse);
    compare("impulse", impulse(a), impulse(b), 0.0);
    let force = |o| of_levels(o, |l| l.peak_force.value);
    compare("force", force(a), force(b), 0.0);
    let loss = |o| of_levels(o, |l| l.energy_dissipated);
    compare("loss", loss(a), loss(b), input);
    let energy = |o: &Outcome| {
        vec![
            o.energy.end.input,
            o.energy.end.impact,
            o.energy.end.viscous,
        ]
    };
    compare("energy", energy(a), energy(b), input);
    found
}

/// Counts of impacts and of lasting contacts, peaks of acceleration, forces, impulses and
/// energies of the event-driven method are those of the adaptive pair.
#[test]
fn held_rows_do_not_depend_on_the_method() {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).map_or(otherwise, |text| text.parse().unwrap())
    };
    let (first, count) = (
        number("POUNDING_FIRST", 0),
        number("POUNDING_SYSTEMS", SYSTEMS),
    );
    let ground = synthetic_motion().unwrap();
    let (mut held, mut differing) = (0, Vec::new());
    for seed in first..first + count {
        let system = row(seed, &ground);
        let [exact, pair] = [LOCATING[0], LOCATING[1]].map(|m| go(&system, m, SHAKEN));
        for outcome in [&exact, &pair] {
            let residual = outcome.energy.residual_ratio;
            assert!(residual < 1e-10, "{seed}: residual {residual:e}");
            for overlap in of_levels(outcome, |l| l.peak_penetration.value) {
                assert!(overlap < 1e-10, "{seed}: overlap {overlap:e} m");
            }
        }
        held += of_levels(&exact, |l| l.sticks).iter().sum::<usize>();
        let found = differences(&exact, &pair);
        if !found.is_empty() {
            differing.push(format!("{seed}: {}", found.join(", ")));
            println!("{}", differing[differing.len() - 1]);
        }
    }
    println!(
        "{count} rows, {held} lasting contacts, {} differ",
        differing.len()
    );
    assert!(held as u64 > 10 * count, "{held} lasting contacts");
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}
