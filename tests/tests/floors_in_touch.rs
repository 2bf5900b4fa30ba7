//! Gaps of zero width: floors that lie against one another from the start. Truth is the
//! adaptive pair at 1e-12, which goes another way through the program.
use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, SeparationRule, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, FloorForce, ForceHistory, GroundAcceleration, MethodChoice, Outcome, RunOptions, System,
    TimeHistoryError, run,
};
use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardUniform};

const FAST: MethodChoice = MethodChoice::EventDriven {
    relative_tolerance: 1e-10,
};
const TRUTH: MethodChoice = MethodChoice::Adaptive {
    relative_tolerance: 1e-12,
};

fn law(name: &str, restitution: f64, rule: Option<SeparationRule>) -> Arc<dyn ImpactModel> {
    let descriptor = registry::find(name).unwrap();
    let mut parameters = descriptor.example_parameters(restitution);
    if let Some(rule) = rule {
        parameters = parameters.with_separation(rule);
    }
    registry::build(name, &parameters).unwrap().into()
}

fn go(system: &System, method: MethodChoice, duration: f64) -> Outcome {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

fn building(storeys: usize, factor: f64) -> Arc<ShearBuilding> {
    let damping = Damping::StiffnessProportional { ratio: 0.05 };
    let (mass, stiffness) = (vec![3e4 * factor; storeys], vec![5e7 * factor; storeys]);
    let height = vec![3.0; storeys];
    Arc::new(ShearBuilding::new("b".into(), mass, stiffness, height, damping).unwrap())
}

/// Two buildings that move alike when alone: masses and stiffnesses in proportion.
fn alike(storeys: usize, factor: f64, law: &Arc<dyn ImpactModel>) -> System {
    let sample = |i: i32| {
        let t = f64::from(i) * 0.01;
        3.0 * (7.3 * t).sin() + 2.0 * (23.0 * t).sin()
    };
    let ground = GroundAcceleration {
        samples: (0..401).map(sample).collect::<Vec<_>>().into(),
        time_step: 0.01,
    };
    let buildings = vec![building(storeys, 1.0), building(storeys, factor)];
    let mut system = System::new(buildings, ground);
    let pair = |i| {
        let (left, right) = (Floor::Storey(0, i), Floor::Storey(1, i));
        (left, right, 0.0, Arc::clone(law))
    };
    let names = ["a".to_owned(), "b".to_owned()];
    let pairs = (0..storeys).map(pair).collect();
    system.add_gap("gap", names, pairs).unwrap();
    system
}

/// A floor that the ground presses against a wall stays there; one that it pulls off does
/// not come back too late.
#[test]
fn a_resting_contact_is_not_lost() {
    let laws = [
        ("hunt_crossley_1975", Some(SeparationRule::NoTension)),
        ("hertz_1882", None),
        ("jankowski_2005", None),
        ("anagnostopoulos_2004", None),
    ];
    for (name, rule) in laws {
        for case in 0..36 {
            let time_step = [0.005, 0.01, 0.02][case % 3];
            let jump = [-2.3, 2.3][case / 3 % 2];
            let storeys = 1 + case / 6 % 3;
            let sample = |i: i32| match i {
                0 => 0.0,
                _ => jump * (1.0 + 0.1 * f64::from(i).sin()),
            };
            let ground = GroundAcceleration {
                samples: (0..50).map(sample).collect::<Vec<_>>().into(),
                time_step,
            };
            let mut system = System::new(vec![building(storeys, 1.0)], ground);
            let floors = match case / 18 {
                0 => (Floor::Wall, Floor::Storey(0, 0)),
                _ => (Floor::Storey(0, 0), Floor::Wall),
            };
            let names = ["a".to_owned(), "b".to_owned()];
            let pair = (floors.0, floors.1, 0.0, law(name, 0.5, rule));
            system.add_gap("gap", names, vec![pair]).unwrap();
            let (fast, truth) = (go(&system, FAST, 0.1), go(&system, TRUTH, 0.1));
            let impulse = |o: &Outcome| o.gaps[0].levels[0].impulse;
            let error = (impulse(&fast) - impulse(&truth)).abs();
            assert!(
                error <= 1e-6 * impulse(&truth).max(1.0),
                "{name} {case}: {error}"
            );
        }
    }
}

/// Equal buildings move alike, whatever lies between them.
#[test]
fn twins_do_not_collide() {
    for name in ["anagnostopoulos_2004", "jankowski_2005", "linear_elastic"] {
        for storeys in [1, 3, 5, 9] {
            let system = alike(storeys, 1.0, &law(name, 0.65, None));
            let outcome = go(&system, FAST, 4.0);
            assert_eq!(outcome.impacts.len(), 0, "{name}, {storeys} storeys");
        }
    }
}

/// So do buildings in proportion, which touch by round-off at most.
#[test]
fn buildings_in_proportion_do_not_push_one_another() {
    for (storeys, factor) in [(2, 1.7), (3, 1.7), (4, 1.3), (3, 2.0)] {
        for name in ["hertz_1882", "jankowski_2005"] {
            let system = alike(storeys, factor, &law(name, 0.65, None));
            let (together, alone) = (go(&system, FAST, 4.0), go(&system.isolated(), FAST, 4.0));
            assert!(together.energy.residual_ratio < 1e-9, "{name} x{factor}");
            for (a, b) in together.buildings.iter().zip(&alone.buildings) {
                for (a, b) in a.storeys.iter().zip(&b.storeys) {
                    let error = a.displacement.value / b.displacement.value - 1.0;
                    assert!(error.abs() < 1e-9, "{name} x{factor}: {error:e}");
                }
            }
        }
    }
}

/// Nor do they where the ground begins to move so little that their penetrations are far below what series of powers
/// end in: one that did not converge threw a pair apart at 8e-9 m/s, into 34 impacts.
#[test]
fn buildings_in_proportion_that_hardly_move_do_not_part() {
    for name in ["hertz_1882", "jankowski_2005"] {
        let law = law(name, 0.65, None);
        for seed in 0..600 {
            let mut random = ChaCha20Rng::seed_from_u64(seed);
            let swell = |i: i32| 1e-3 * f64::from(i).exp().min(3e3);
            let mut random = || -> f64 { StandardUniform.sample(&mut random) };
            let samples: Vec<f64> = (0..60)
                .map(|i| swell(i - 3) * (2.0 * random() - 1.0))
                .collect();
            let ground = GroundAcceleration {
                samples: samples.into(),
                time_step: 0.01,
            };
            let factor = [2.0, 1.7, 3.0][seed as usize % 3];
            let buildings = vec![building(1, 1.0), building(1, factor)];
            let mut system = System::new(buildings, ground);
            let names = ["a".to_owned(), "b".to_owned()];
            let level = (
                Floor::Storey(0, 0),
                Floor::Storey(1, 0),
                0.0,
                Arc::clone(&law),
            );
            system.add_gap("gap", names, vec![level]).unwrap();
            let outcome = go(&system, FAST, 0.6);
            assert_eq!(outcome.impacts.len(), 0, "{name}, seed {seed}");
        }
    }
}

/// Floors that overlap from the start are refused, also where the gap comes last.
#[test]
fn floors_that_overlap_at_time_zero_are_refused() {
    let ground = GroundAcceleration {
        samples: vec![0.0; 3].into(),
        time_step: 0.01,
    };
    let system = System::new(vec![building(1, 1.0)], ground);
    let mut system = system.with_initial_state(&[0.02], &[0.0]).unwrap();
    let pair = (
        Floor::Storey(0, 0),
        Floor::Wall,
        0.005,
        law("hertz_1882", 1.0, None),
    );
    let names = ["b".to_owned(), "wall".to_owned()];
    let error = system.add_gap("gap", names, vec![pair]).unwrap_err();
    assert!(
        matches!(error, TimeHistoryError::InitialState { .. }),
        "{error}"
    );
    assert!(error.to_string().contains("0.015"), "{error}");
}

/// Three single storeys without a gap. A rigid impact of the first two throws the second on the
/// third, with which it has a compliant contact, and against which its dashpot presses it at the same
/// instant: the contact begins with the velocity after the jump, that of momentum and restitution, as
/// it does a picometre apart.
#[test]
fn a_contact_that_closes_at_a_jump_begins_after_it() {
    let storey = |name: &str, dashpot: f64| {
        let damping = Damping::Dashpots {
            coefficients: vec![dashpot],
        };
        let parts = (vec![1e5], vec![4e6], vec![3.0]);
        Arc::new(ShearBuilding::new(name.into(), parts.0, parts.1, parts.2, damping).unwrap())
    };
    let rigid = ModelParameters::from_pairs(&[("restitution", 0.3)]);
    let rigid: Arc<dyn ImpactModel> = registry::build("stereomechanical", &rigid).unwrap().into();
    let velocities = [0.1, -0.3, -0.3];
    let after = 0.5 * (velocities[0] + velocities[1]) + 0.3 * 0.5 * (velocities[0] - velocities[1]);
    let fixed = 1e-4;
    for name in ["exact_hunt_crossley", "jankowski_2005", "hertz_1882"] {
        for dashpot in [1e-6, 1e4] {
            for method in [FAST, TRUTH, MethodChoice::RungeKutta4 { step: fixed }] {
                let at = |width: f64| {
                    let buildings = vec![storey("a", 0.0), storey("b", dashpot), storey("c", 0.0)];
                    let ground = GroundAcceleration {
                        samples: vec![0.0; 2].into(),
                        time_step: 1.0,
                    };
                    let mut system = System::new(buildings, ground);
                    let laws = [(0.0, Arc::clone(&rigid)), (width, law(name, 0.5, None))];
                    for (left, (width, law)) in laws.into_iter().enumerate() {
                        let sides = [left, left + 1].map(|b| Floor::Storey(b, 0));
                        let names = [left, left + 1].map(|b| ["a", "b", "c"][b].to_owned());
                        let pair = vec![(sides[0], sides[1], width, law)];
                        system.add_gap(&left.to_string(), names, pair).unwrap();
                    }
                    let system = system.with_initial_state(&[0.0; 3], &velocities).unwrap();
                    go(&system, method, 0.1).gaps[1].levels[0].clone()
                };
                let (touching, apart) = (at(0.0), at(1e-12));
                let velocity = touching.approach_velocity_max;
                assert!(
                    (velocity - (after - velocities[2])).abs() < 1e-12,
                    "{name} {velocity}"
                );
                assert_eq!(touching.impacts, 1);
                assert_eq!(touching.first_contact, Some(0.0));
                let [a, b] = [&touching, &apart].map(|level| level.peak_force.value);
                assert!((a / b - 1.0).abs() < 1e-6, "{name} {dashpot}: {a} {b}");
            }
        }
    }
}

/// Floors that touch at rest are in contact since they begin to move: what moves a building that
/// nothing joins to them does not count.
#[test]
fn floors_at_rest_are_in_contact_since_they_move() {
    let law = law("linear_elastic", 1.0, None);
    let ground = GroundAcceleration {
        samples: vec![0.0; 2].into(),
        time_step: 1.0,
    };
    let mut system = System::new(
        vec![building(1, 1.0), building(1, 3.0), building(1, 1.0)],
        ground,
    );
    let pair = (Floor::Storey(0, 0), Floor::Storey(1, 0), 0.0, law);
    let names = ["a".to_owned(), "b".to_owned()];
    system.add_gap("gap", names, vec![pair]).unwrap();
    let push = |building: usize, begin: f64| FloorForce {
        building,
        storey: 0,
        history: ForceHistory::new(&[(begin, 0.0), (begin + 0.1, 1e5)], true).unwrap(),
        origin: String::new(),
    };
    for method in [FAST, TRUTH] {
        let pushed = system
            .clone()
            .with_forces(vec![push(0, 0.2), push(2, 0.05)]);
        let pushed = pushed.unwrap();
        for (velocity, name) in [(0.0, "pushed"), (0.3, "let go")] {
            let begun = pushed
                .clone()
                .with_initial_state(&[0.0; 3], &[0.0, 0.0, velocity]);
            let outcome = go(&begun.unwrap(), method, 0.5);
            let level = &outcome.gaps[0].levels[0];
            assert_eq!(level.first_contact, Some(0.2), "{name}");
            assert_eq!(level.impacts, 1);
        }
    }
}

/// Touching floors stand still until their own motion begins or something hits them, whatever else
/// moves: a building that is let go far from them, or nearer than it swings.
#[test]
fn floors_at_rest_wait_for_what_moves_them() {
    let law = law("linear_elastic", 1.0, None);
    let ground = GroundAcceleration {
        samples: vec![0.0; 2].into(),
        time_step: 1.0,
    };
    let row = |width: f64, velocity: f64, push: Option<f64>| {
        let buildings = vec![building(1, 2.0), building(1, 1.0), building(1, 3.0)];
        let mut system = System::new(buildings, ground.clone());
        for (left, width) in [(0, width), (1, 0.0)] {
            let [a, b] = [left, left + 1].map(|k| Floor::Storey(k, 0));
            let names = [left, left + 1].map(|k| system.buildings()[k].name().to_owned());
            let pair = (a, b, width, Arc::clone(&law));
            system
                .add_gap(&format!("gap {left}"), names, vec![pair])
                .unwrap();
        }
        let pushed = push.map(|begin| FloorForce {
            building: 1,
            storey: 0,
            history: ForceHistory::new(&[(begin, 0.0), (begin + 0.1, 1e5)], true).unwrap(),
            origin: String::new(),
        });
        let system = system.with_forces(pushed.into_iter().collect()).unwrap();
        system
            .with_initial_state(&[0.0; 3], &[velocity, 0.0, 0.0])
            .unwrap()
    };
    for method in [FAST, TRUTH] {
        let first = |system: &System| {
            let outcome = go(system, method, 0.5);
            [0, 1].map(|gap| outcome.gaps[gap].levels[0].first_contact)
        };
        // The first one is let go 5 m away, the second is pushed.
        assert_eq!(first(&row(5.0, 0.05, Some(0.3))), [None, Some(0.3)]);
        // The first one hits it: both gaps close at that instant.
        for push in [None, Some(0.4)] {
            let [hit, behind] = first(&row(0.01, 0.5, push)).map(Option::unwrap);
            assert!(hit > 0.01 && hit < 0.1, "{hit}");
            assert_eq!(hit, behind);
        }
    }
}

/// A floor that pulses of force press against a rigid wall, where it lies: an impact that goes on
/// from one pulse to another has closed at its first, and the impulses are those of the pulses.
#[test]
fn pulses_against_a_rigid_wall() {
    let law = law("stereomechanical", 0.5, None);
    let ground = GroundAcceleration {
        samples: vec![0.0; 2].into(),
        time_step: 1.0,
    };
    let mut system = System::new(vec![building(1, 1.0)], ground);
    let pair = (Floor::Storey(0, 0), Floor::Wall, 0.0, law);
    let names = ["b".to_owned(), "wall".to_owned()];
    system.add_gap("gap", names, vec![pair]).unwrap();
    let begins = [0.25, 0.30, 0.42, 0.55, 0.70];
    let pulse = |begin: f64| [(begin, 0.0), (begin + 0.005, 2e5), (begin + 0.01, 0.0)];
    let pulses: Vec<(f64, f64)> = begins.into_iter().flat_map(pulse).collect();
    let push = FloorForce {
        building: 0,
        storey: 0,
        history: ForceHistory::new(&pulses, true).unwrap(),
        origin: String::new(),
    };
    let system = system.with_forces(vec![push]).unwrap();
    for method in [FAST, TRUTH] {
        let outcome = go(&system, method, 0.9);
        let level = &outcome.gaps[0].levels[0];
        assert_eq!(level.first_contact, Some(0.25));
        assert!(
            (level.impulse / 5e3 - 1.0).abs() < 1e-9,
            "{}",
            level.impulse
        );
        let mut before = 0.0;
        for impact in &outcome.impacts {
            // As many pulses as it holds begin at its closure.
            let at = begins
                .iter()
                .position(|begin| (begin - impact.time_closed).abs() < 1e-5);
            let pulses = before / 1e3;
            assert!((at.unwrap() as f64 - pulses).abs() < 1e-6, "{impact:?}");
            before += impact.impulse;
        }
    }
}

/// Floors that touch in decimal numbers touch, though 0.1 + 0.2 is more than 0.3 in binary ones; what
/// overlaps by more is refused.
#[test]
fn floors_that_touch_in_decimals_are_let_go() {
    let law = law("linear_elastic", 1.0, None);
    let ground = GroundAcceleration {
        samples: vec![0.0; 2].into(),
        time_step: 1.0,
    };
    let mut system = System::new(vec![building(1, 1.0), building(1, 3.0)], ground);
    let pair = (Floor::Storey(0, 0), Floor::Storey(1, 0), 0.3, law);
    let names = ["a".to_owned(), "b".to_owned()];
    system.add_gap("gap", names, vec![pair]).unwrap();
    let let_go = |right: f64| {
        let system = system.clone();
        system.with_initial_state(&[0.1, right], &[0.5, 0.0])
    };
    let level = |right: f64| {
        let outcome = go(&let_go(right).unwrap(), FAST, 0.1);
        outcome.gaps[0].levels[0].clone()
    };
    let (touching, apart) = (level(-0.2), level(-0.2 + 1e-12));
    assert!(touching.approach_velocity_max > 0.49);
    assert_eq!(touching.impacts, apart.impacts);
    let [a, b] = [&touching, &apart].map(|level| level.peak_force.value);
    assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    assert!(let_go(-0.2 - 1e-14).is_err());
}

/// Two equal buildings behind one that presses them: what they do to one another begins like a high
/// power of time, and its first terms alone tell on which branch of its law a contact is. An
/// interpolant of the step told otherwise, and branches changed 370,000 times in 0.01 s.
#[test]
fn branches_of_contacts_that_begin_at_rest_do_not_change_for_ever() {
    for name in ["muthukumar_2003", "modelica_elasto_gap"] {
        for count in [3, 5] {
            let stiffness = |i: usize| if i == 0 { 1e8 } else { 5e7 };
            let building = |i: usize| {
                let damping = Damping::Modal { ratios: vec![0.05] };
                let (mass, stiffness, height) = (vec![1e5], vec![stiffness(i)], vec![3.0]);
                let building =
                    ShearBuilding::new(format!("b{i}"), mass, stiffness, height, damping);
                Arc::new(building.unwrap())
            };
            let samples = vec![0.0, 3.0, 0.0];
            let ground = GroundAcceleration {
                samples: samples.into(),
                time_step: 0.15,
            };
            let mut system = System::new((0..count).map(building).collect(), ground);
            for i in 1..count {
                let floors = (Floor::Storey(i - 1, 0), Floor::Storey(i, 0));
                let names = [i - 1, i].map(|b| format!("b{b}"));
                let pair = (floors.0, floors.1, 0.0, law(name, 0.65, None));
                system.add_gap("gap", names, vec![pair]).unwrap();
            }
            let (fast, truth) = (go(&system, FAST, 0.3), go(&system, TRUTH, 0.3));
            let events = fast.statistics.events;
            assert!(events < 1000, "{name}, {count}: {events} events");
            for (fast, truth) in fast.gaps.iter().zip(&truth.gaps) {
                let [fast, truth] = [fast, truth].map(|gap| &gap.levels[0]);
                assert_eq!(fast.impacts, truth.impacts, "{name}, {count}");
                let error = (fast.impulse - truth.impulse).abs();
                let allowed = 1e-6 * truth.impulse.max(1.0);
                assert!(error <= allowed, "{name}, {count}: {error:e}");
            }
        }
    }
}
