//! Several rigid contacts at once whose impacts follow one another ever faster: floors that
//! lie against a wall, restitution exactly one included.
use std::sync::Arc;

use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, TimeHistoryError, run,
};
use verification::rigid;

const ADAPTIVE: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-10,
};

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn event_driven(system: &System, duration: f64) -> Outcome {
    go(system, RunOptions::default().method, duration)
}

fn building(name: &str, mass: Vec<f64>, stiffness: Vec<f64>, beta: f64) -> Arc<ShearBuilding> {
    let height = vec![3.0; mass.len()];
    let damping = Damping::Rayleigh { alpha: 0.0, beta };
    Arc::new(ShearBuilding::new(name.to_owned(), mass, stiffness, height, damping).unwrap())
}

/// Six floors that lie against a wall with restitution one, and a wall with 0.01 behind the
/// first; the ground moves through one period of a sine.
fn six_floors(duration: f64) -> System {
    let sample = |i: i32| match i {
        0..=8 => -2.0 * (std::f64::consts::TAU * f64::from(i) / 8.0).sin(),
        _ => 0.0,
    };
    let ground = GroundAcceleration {
        samples: (0..(duration / 0.1) as i32 + 1)
            .map(sample)
            .collect::<Vec<_>>()
            .into(),
        time_step: 0.1,
    };
    let mass = vec![
        125_132.0, 119_234.0, 126_121.0, 158_510.0, 248_793.0, 240_679.0,
    ];
    let stiffness = vec![
        1.846_91e8, 2.277_43e8, 1.473_45e8, 2.432_68e8, 2.229_56e8, 1.1836e8,
    ];
    let mut system = System::new(vec![building("b", mass, stiffness, 0.26132)], ground);
    let left = (Floor::Wall, Floor::Storey(0, 0), 0.004_426, rigid(0.01));
    let names = ["wall".to_owned(), "b".to_owned()];
    system.add_gap("wall-b", names, vec![left]).unwrap();
    let pairs = (0..6)
        .map(|s| (Floor::Storey(0, s), Floor::Wall, 0.0, rigid(1.0)))
        .collect();
    let names = ["b".to_owned(), "wall".to_owned()];
    system.add_gap("b-wall", names, pairs).unwrap();
    system
}

fn impulses(outcome: &Outcome) -> Vec<f64> {
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    levels.map(|l| l.impulse).collect()
}

fn displacements(outcome: &Outcome) -> Vec<f64> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    storeys.map(|s| s.displacement.value).collect()
}

/// Largest difference as a part of the largest value.
fn difference(a: &[f64], b: &[f64]) -> f64 {
    let size = a.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let pairs = a.iter().zip(b);
    pairs.fold(0.0_f64, |m, (x, y)| m.max((x - y).abs())) / size.max(f64::MIN_POSITIVE)
}

/// Work (J) of contact forces of some MN over the round-off of a displacement, where floors
/// only lie against one another.
const ROUND_OFF: f64 = 1e-9;

/// What must hold of every run: the ledger closes, floors do not overlap, no impact adds
/// energy.
fn is_sound(what: &str, outcome: &Outcome) {
    let residual = outcome.energy.residual_ratio;
    assert!(residual < 1e-10, "{what}: residual {residual:e}");
    for level in outcome.gaps.iter().flat_map(|g| &g.levels) {
        let overlap = level.peak_penetration.value;
        assert!(overlap < 1e-10, "{what}: overlap {overlap:e} m");
    }
    let input = outcome.energy.largest_input;
    for impact in &outcome.impacts {
        let loss = impact.energy_dissipated;
        assert!(
            loss > -1e-10 * input - ROUND_OFF,
            "{what}: {loss:e} J of {input:e} J"
        );
    }
}

#[test]
fn six_floors_come_to_rest_against_a_wall_without_loss() {
    let system = six_floors(4.3);
    let outcome = event_driven(&system, 4.3);
    is_sound("six floors", &outcome);
    let pair = go(&system, ADAPTIVE, 4.3);
    is_sound("six floors, adaptive", &pair);
    assert!(difference(&impulses(&outcome), &impulses(&pair)) < 1e-9);
    assert!(difference(&displacements(&outcome), &displacements(&pair)) < 1e-9);
    // Impacts without loss take nothing but the last hops; those with loss all.
    let levels = &outcome.gaps[1].levels;
    let loss: f64 = levels.iter().map(|l| l.energy_dissipated).sum();
    assert!(loss.abs() < 1e-6, "{loss:e} J");
    assert!(outcome.gaps[0].levels[0].energy_dissipated > 30.0);
    // Where nothing is located at all, the motion is the same.
    let stepped = go(
        &six_floors(1.5),
        MethodChoice::MoreauJean {
            step: 2e-5,
            theta: 0.5,
        },
        1.5,
    );
    let located = event_driven(&six_floors(1.5), 1.5);
    assert!(difference(&impulses(&located), &impulses(&stepped)) < 5e-3);
    assert!(difference(&displacements(&located), &displacements(&stepped)) < 5e-3);
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

/// Up to three buildings of up to four storeys, most of them in touch, between walls.
fn random_row(seed: u64, duration: f64) -> System {
    let mut random = Random(seed);
    random.unit();
    let count = 1 + random.below(3);
    let mut storeys = Vec::new();
    let mut buildings = Vec::new();
    for index in 0..count {
        let n = 1 + random.below(4);
        let scale = random.between(2e4, 5e6);
        let omega = random.between(6.0, 120.0);
        let mut around = |mean: f64| -> Vec<f64> {
            let one = |_| mean * (0.5 + random.unit());
            (0..n).map(one).collect()
        };
        let (mass, stiffness) = (around(scale), around(scale * omega * omega));
        let beta = [0.1 / omega, random.between(1e-3, 0.3)][random.below(2)];
        buildings.push(building(&format!("b{index}"), mass, stiffness, beta));
        storeys.push(n);
    }
    let time_step = [0.02, 0.05, 0.1][random.below(3)];
    let strength = random.between(0.5, 8.0);
    let samples: Vec<f64> = (0..(duration / time_step) as usize + 2)
        .map(|_| strength * (2.0 * random.unit() - 1.0))
        .collect();
    let ground = GroundAcceleration {
        samples: samples.into(),
        time_step,
    };
    let mut system = System::new(buildings, ground);
    let mut held_on_the_left = false;
    for gap in 0..=count {
        let (left, right) = (gap.checked_sub(1), (gap < count).then_some(gap));
        if (left.is_none() || right.is_none()) && random.unit() < 0.3 {
            continue;
        }
        let restitution = [0.0, 1.0, random.unit(), 0.01, 0.99][random.below(5)];
        // Without clearance between two walls floors could not move.
        let wide = random.unit() < 0.4 || (right.is_none() && held_on_the_left);
        held_on_the_left |= left.is_none() && !wide;
        let width = if wide {
            random.between(1e-4, 0.02)
        } else {
            0.0
        };
        let at = |building: Option<usize>, s: usize| {
            building.map_or(Floor::Wall, |b| Floor::Storey(b, s))
        };
        let levels = [left, right]
            .into_iter()
            .flatten()
            .map(|b| storeys[b])
            .min();
        let pairs = (0..levels.unwrap_or(0))
            .map(|s| (at(left, s), at(right, s), width, rigid(restitution)))
            .collect();
        let name = |b: Option<usize>| b.map_or("wall".to_owned(), |b| format!("b{b}"));
        let names = [name(left), name(right)];
        system.add_gap(&format!("gap{gap}"), names, pairs).unwrap();
    }
    system
}

/// 200 rows with restitutions of 0 to 1, both ends included.
#[test]
fn every_row_of_rigid_floors_is_followed_to_its_end() {
    const DURATION: f64 = 0.4;
    let mut impacts = 0;
    for seed in 0..200 {
        let outcome = event_driven(&random_row(seed, DURATION), DURATION);
        is_sound(&format!("row {seed}"), &outcome);
        impacts += outcome.impacts.len();
    }
    assert!(impacts > 2000, "{impacts}");
}

/// Floors without clearance between two walls have no unique contact forces; they are
/// refused before any step, with their place.
#[test]
fn floors_without_clearance_between_walls_are_refused() {
    let row = |widths: [f64; 3]| {
        let body = |name: &str| building(name, vec![1e5], vec![1e7], 0.0);
        let ground = verification::constant_ground(1.0, 0.1);
        let mut system = System::new(vec![body("a"), body("b")], ground);
        let floors = [
            (Floor::Wall, Floor::Storey(0, 0)),
            (Floor::Storey(0, 0), Floor::Storey(1, 0)),
            (Floor::Storey(1, 0), Floor::Wall),
        ];
        let names = [["wall", "a"], ["a", "b"], ["b", "wall"]];
        for ((floors, names), width) in floors.into_iter().zip(names).zip(widths) {
            let pair = (floors.0, floors.1, width, rigid(0.5));
            let name = names.join("-");
            system
                .add_gap(&name, names.map(str::to_owned), vec![pair])
                .unwrap();
        }
        system
    };
    let options = RunOptions::default();
    let error = options.check(&row([0.0; 3])).unwrap_err();
    assert!(
        matches!(error, TimeHistoryError::NoClearance { .. }),
        "{error}"
    );
    let text = error.to_string();
    for level in [
        "wall-a level wall-1 (",
        "a-b level 1-1 (",
        "b-wall level 1-wall (",
    ] {
        assert!(text.contains(level), "{level}: {text}");
    }
    assert!(options.check(&row([0.0, 1e-3, 0.0])).is_ok());
    assert!(options.check(&row([0.0, 0.0, 1e-6])).is_ok());
}
