//! Contacts that last some microseconds, in samples of 5 ms: a series over the rest of a sample overflows, and must not
//! be taken for the motion. Against the pair of order 8(5,3) in physical coordinates.
use std::sync::Arc;

use pounding_gap_element::{ModelParameters, registry};
use pounding_shear_building::ShearBuilding;
use pounding_time_history::{Floor, MethodChoice, Outcome, System, TimeHistoryError};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use verification::{EqualStoreys, outcome_by, single_storey, synthetic_motion};

const DURATION: f64 = 3.0;
/// As long (s) the light frame is held.
const HELD: f64 = 3.0;

/// A building as good as free beside a wall that it touches at rest.
fn beside_a_wall(model: &str, stiffness: f64) -> System {
    let body = single_storey("body", 5.8, 3.2);
    let mut system = System::new(vec![body], synthetic_motion().unwrap());
    let parameters =
        ModelParameters::from_pairs(&[("stiffness", stiffness), ("restitution", 0.65)]);
    let model = registry::build(model, &parameters).unwrap().into();
    let pair = (Floor::Storey(0, 0), Floor::Wall, 0.0, model);
    let names = ["body".to_owned(), "wall".to_owned()];
    system.add_gap("body-wall", names, vec![pair]).unwrap();
    system
}

fn go(system: &System, method: MethodChoice) -> Outcome {
    outcome_by(system, method, DURATION).unwrap()
}

#[test]
fn contacts_of_microseconds_are_followed() {
    let relative_tolerance = 1e-12;
    for model in ["pant_2010", "ye_li_2009", "papi_toopchi_2022"] {
        for stiffness in [1e8, 1e10, 1e12, 1e14] {
            let system = beside_a_wall(model, stiffness);
            let exact = go(&system, MethodChoice::EventDriven { relative_tolerance });
            let other = go(&system, MethodChoice::Adaptive { relative_tolerance });
            let place = format!("{model}, {stiffness:e}");
            assert!(!exact.impacts.is_empty(), "{place}");
            assert_eq!(exact.impacts.len(), other.impacts.len(), "{place}");
            let forces = [&exact, &other].map(|o| o.gaps[0].levels[0].peak_force.value);
            let displacements =
                [&exact, &other].map(|o| o.buildings[0].storeys[0].displacement.value);
            for [a, b] in [forces, displacements] {
                assert!((a / b - 1.0).abs() < 1e-6, "{place}: {a} {b}");
            }
        }
    }
}

/// Steps that are far too long for a contact make motion of their own, which grows with each of them: the run ends where
/// the energy of that is a thousand times what the ground has put in, and not at its end, which runs with steps that
/// are cut at the events of such motion would not reach.
#[test]
fn a_run_that_its_steps_drive_ends_early() {
    for step in [1e-3, 1e-4, 2e-5] {
        let system = beside_a_wall("papi_toopchi_2022", 1e14);
        let method = MethodChoice::RungeKutta4 { step };
        let error = outcome_by(&system, method, DURATION).unwrap_err();
        let TimeHistoryError::EnergyResidual { time, residual, .. } = error else {
            panic!("{step}: {error}");
        };
        assert!(
            time < 0.9 * DURATION && residual > 1e3,
            "{step}: {time} s, {residual}"
        );
        assert!(error.help().unwrap().contains("smaller `step`"));
    }
}

/// Models with laws in powers, damped throughout and in the approach alone, affine, and without closed form.
const MODELS: [&str; 8] = [
    "pant_2010",
    "papi_toopchi_2022",
    "jankowski_2005",
    "exact_linear",
    "muthukumar_desroches_2006",
    "polycarpou_2013",
    "anagnostopoulos_2004",
    "lapshin_yurin_2016",
];

/// Two buildings of any mass and period, from a plate to a tower block.
#[derive(Debug, Clone)]
struct Pair {
    /// Storeys, decimal logarithms of mass (kg) and of the first period (s), and damping ratio.
    buildings: [(usize, f64, f64, f64); 2],
    /// Width of the gap (m).
    width: f64,
    model: usize,
    /// Decimal logarithm of the contact stiffness.
    stiffness: f64,
    restitution: f64,
}

fn pairs() -> impl Strategy<Value = Pair> {
    let building = || (1_usize..5, 3.0..8.0_f64, -1.7..1.0_f64, 0.0..0.3_f64);
    let width = prop_oneof![Just(0.0), 1e-5..0.1_f64];
    let contact = (0..MODELS.len(), 6.0..13.0_f64, 0.05..0.95_f64);
    (building(), building(), width, contact).prop_map(|(a, b, width, contact)| Pair {
        buildings: [a, b],
        width,
        model: contact.0,
        stiffness: contact.1,
        restitution: contact.2,
    })
}

fn building(name: &str, (storeys, mass, period, ratio): (usize, f64, f64, f64)) -> ShearBuilding {
    let equal = EqualStoreys {
        storeys,
        mass: 10_f64.powf(mass),
        period: 10_f64.powf(period),
        ratio,
    };
    equal.building(name)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 48,
        rng_seed: RngSeed::Fixed(1940),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Whatever stands beside whatever is followed to the end, with a ledger that closes.
    #[test]
    fn pairs_of_any_mass_and_period_are_followed(pair in pairs()) {
        let buildings = [building("a", pair.buildings[0]), building("b", pair.buildings[1])];
        let levels = pair.buildings[0].0.min(pair.buildings[1].0);
        let mut system =
            System::new(buildings.map(Arc::new).into(), synthetic_motion().unwrap());
        let parameters = ModelParameters::from_pairs(&[
            ("stiffness", 10_f64.powf(pair.stiffness)),
            ("restitution", pair.restitution),
        ]);
        let model = registry::build(MODELS[pair.model], &parameters).unwrap();
        let model: Arc<dyn pounding_gap_element::ImpactModel> = model.into();
        let levels = (0..levels).map(|s| {
            (Floor::Storey(0, s), Floor::Storey(1, s), pair.width, Arc::clone(&model))
        });
        let names = ["a".to_owned(), "b".to_owned()];
        system.add_gap("a-b", names, levels.collect()).unwrap();
        let outcome = go(&system, MethodChoice::EventDriven { relative_tolerance: 1e-10 });
        prop_assert!(outcome.energy.residual_ratio.abs() < 1e-6);
    }
}

/// A light frame between two heavy buildings that hold it: stability, not accuracy, limits the steps. The step control
/// must find that limit, and neither run into it before every step nor try a series that reaches a thousandth of a sample.
#[test]
fn steps_that_stability_limits_are_seldom_rejected() {
    let heavy = building("a", (3, 6.477, -0.678, 0.18));
    let light = building("b", (2, 2.494, -1.013, 0.22));
    let other = building("c", (4, 6.968, -0.214, 0.0));
    let buildings = [heavy, light, other].map(Arc::new);
    let mut system = System::new(buildings.into(), synthetic_motion().unwrap());
    for (left, name, restitution) in [(0, "hu_guo_2015", 0.24), (1, "hertz_1882", 0.91)] {
        let descriptor = registry::find(name).unwrap();
        let parameters = descriptor.example_parameters(restitution);
        let model = registry::build(name, &parameters).unwrap();
        let model: Arc<dyn pounding_gap_element::ImpactModel> = model.into();
        let level = |s| {
            (
                Floor::Storey(left, s),
                Floor::Storey(left + 1, s),
                0.0,
                Arc::clone(&model),
            )
        };
        let names = [left, left + 1].map(|b| ["a", "b", "c"][b].to_owned());
        system
            .add_gap(&names.join("-"), names, vec![level(0), level(1)])
            .unwrap();
    }
    let method = MethodChoice::EventDriven {
        relative_tolerance: 1e-9,
    };
    let outcome = outcome_by(&system, method, HELD).unwrap();
    let statistics = outcome.statistics;
    // One step is a thousandth of a sample.
    assert!(statistics.steps > 100_000, "{statistics:?}");
    assert!(
        statistics.rejected < statistics.steps / 20,
        "{statistics:?}"
    );
    // Twelve evaluations a step, and what is rejected.
    assert!(
        statistics.evaluations < 14 * statistics.steps,
        "{statistics:?}"
    );
}
