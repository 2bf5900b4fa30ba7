//! Rows of anything: plates beside tower blocks, walls, every impact model, gaps that are closed from the start. The
//! event-driven method and the adaptive pair agree wherever each agrees with itself at another tolerance.
//!
//! `POUNDING_ANY=2000 cargo test --release -p verification --test integration any_rows -- --nocapture` takes as many
//! rows at random; without it they are always the same.
#![allow(clippy::print_stdout)]

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, registry};
use pounding_shear_building::ShearBuilding;
use pounding_time_history::{Floor, MethodChoice, Outcome, System};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{RngSeed, TestRunner};
use verification::{EqualStoreys, outcome_by, synthetic_motion};

const DURATION: f64 = 3.0;
/// Rows of every test, and the part of them that has to be compared.
const ROWS: usize = 40;
const COMPARED: f64 = 0.8;
/// Differences of one method with itself, and with the other, as parts of each number.
const ITSELF: f64 = 1.0e-6;
const OTHER: f64 = 1.0e-4;

#[derive(Debug, Clone)]
struct Building {
    storeys: usize,
    /// Decimal logarithms of the mass (kg) and of the first period (s).
    mass: f64,
    period: f64,
    ratio: f64,
}

#[derive(Debug, Clone)]
struct Row {
    buildings: Vec<Building>,
    /// Model, restitution and decimal logarithm of the width (m) of each gap.
    gaps: Vec<(usize, f64, f64)>,
    closed: bool,
    wall: bool,
    scale: f64,
}

fn rows() -> impl Strategy<Value = Row> {
    let models = registry::descriptors().len();
    let building = (1_usize..7, 3.0..7.0_f64, -1.3..0.6_f64, 0.0..0.3_f64);
    let building = building.prop_map(|(storeys, mass, period, ratio)| Building {
        storeys,
        mass,
        period,
        ratio,
    });
    (
        prop::collection::vec(building, 1..4),
        prop::collection::vec((0..models, 0.1..0.95_f64, -4.0..-1.0_f64), 3),
        prop::bool::weighted(0.15),
        prop::bool::weighted(0.3),
        0.3..3.0_f64,
    )
        .prop_map(|(buildings, gaps, closed, wall, scale)| Row {
            buildings,
            gaps,
            closed,
            wall,
            scale,
        })
}

impl Row {
    fn system(&self) -> System {
        let mut ground = synthetic_motion().unwrap();
        ground.samples = Arc::new(ground.samples.iter().map(|a| self.scale * a).collect());
        let made = |(i, b): (usize, &Building)| -> Arc<ShearBuilding> {
            let equal = EqualStoreys {
                storeys: b.storeys,
                mass: 10_f64.powf(b.mass),
                period: 10_f64.powf(b.period),
                ratio: b.ratio,
            };
            Arc::new(equal.building(&format!("b{i}")))
        };
        let buildings: Vec<_> = self.buildings.iter().enumerate().map(made).collect();
        let count = buildings.len();
        let mut system = System::new(buildings, ground);
        let wall = self.wall || count == 1;
        for (left, gap) in (0..count - 1 + usize::from(wall)).zip(&self.gaps) {
            let descriptor = registry::descriptors()[gap.0];
            let parameters = descriptor.example_parameters(gap.1);
            let model = registry::build(descriptor.name, &parameters).unwrap();
            let model: Arc<dyn ImpactModel> = model.into();
            let width = if self.closed { 0.0 } else { 10_f64.powf(gap.2) };
            let own = self.buildings[left].storeys;
            let other = self.buildings.get(left + 1).map(|b| b.storeys);
            let levels = (0..own.min(other.unwrap_or(own))).map(|s| {
                let right = match other {
                    Some(_) => Floor::Storey(left + 1, s),
                    None => Floor::Wall,
                };
                (Floor::Storey(left, s), right, width, Arc::clone(&model))
            });
            let names = [
                format!("b{left}"),
                other.map_or("wall".to_owned(), |_| format!("b{}", left + 1)),
            ];
            system
                .add_gap(&names.join("-"), names, levels.collect())
                .unwrap();
        }
        system
    }
}

fn go(system: &System, method: MethodChoice) -> Outcome {
    outcome_by(system, method, DURATION).unwrap()
}

/// Peaks of all storeys and levels.
fn peaks(outcome: &Outcome) -> Vec<f64> {
    let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
    let storeys = storeys.flat_map(|s| {
        [s.displacement, s.storey_shear, s.acceleration_absolute].map(|peak| peak.value)
    });
    let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
    let levels = levels.flat_map(|l| [l.peak_force.value, l.peak_penetration.value, l.impulse]);
    storeys.chain(levels).collect()
}

/// Largest difference as a part of the number; infinite if impacts are not as many.
fn difference(a: &Outcome, b: &Outcome) -> f64 {
    if a.impacts.len() != b.impacts.len() {
        return f64::INFINITY;
    }
    let pairs = peaks(a).into_iter().zip(peaks(b));
    pairs.fold(0.0, |most, (x, y)| {
        let part = (x - y).abs() / f64::max(y.abs(), 1.0e-9);
        // A NaN is a difference too.
        if part <= most { most } else { part }
    })
}

#[test]
fn two_methods_agree_on_anything() {
    let wanted = std::env::var("POUNDING_ANY").ok();
    let wanted: Option<usize> = wanted.and_then(|rows| rows.parse().ok());
    let mut runner = TestRunner::new(ProptestConfig {
        rng_seed: wanted.map_or(RngSeed::Fixed(1985), |_| RngSeed::Random),
        ..ProptestConfig::default()
    });
    let all = wanted.unwrap_or(ROWS);
    let mut compared = 0;
    for _ in 0..all {
        let row = rows().new_tree(&mut runner).unwrap().current();
        let system = row.system();
        let exact =
            |relative_tolerance| go(&system, MethodChoice::EventDriven { relative_tolerance });
        let pair = |relative_tolerance| go(&system, MethodChoice::Adaptive { relative_tolerance });
        let (found, finer) = (exact(1e-9), exact(1e-11));
        assert!(finer.energy.residual_ratio < 1e-6, "{row:?}");
        if difference(&found, &finer) > ITSELF {
            continue;
        }
        let other = pair(1e-11);
        let apart = difference(&other, &finer);
        if apart > OTHER {
            let itself = difference(&pair(1e-13), &other);
            assert!(itself > ITSELF, "{apart:e} with {itself:e}: {row:?}");
            continue;
        }
        compared += 1;
    }
    println!("{compared} of {all} rows compared");
    assert!(
        compared as f64 >= COMPARED * all as f64,
        "{compared} of {all}"
    );
}
