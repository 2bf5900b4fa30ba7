//! Random buildings whose modes are coupled, on foundations that sway and rock, with dashpots of
//! any strength and ground motions of their own: the event-driven method, which leads them by
//! exact steps and series, and the adaptive pair, which has nothing in common with it but the
//! laws, agree; and observers change nothing.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use pounding_gap_element::{ImpactModel, ModelParameters, SeparationRule, registry};
use pounding_shear_building::{
    Coordinate, Damping, Excitation, GeneralBuilding, ResponseKind, ResponseRow, ShearBuilding,
};
use pounding_time_history::{
    BuildingPoint, Floor, GridRecorder, GroundMotion, LevelResponse, MethodChoice, Outcome,
    RelativeDisplacement, RunOptions, Support, System, run,
};
use proptest::prelude::*;
use verification::synthetic_motion;

const DURATION: f64 = 5.0;
const HEIGHT: f64 = 3.0;
const MASS: f64 = 6.0e4;

#[derive(Debug, Clone)]
struct Building {
    storeys: usize,
    period: f64,
    /// Damping ratio of each storey by itself, so that modes are coupled.
    ratios: Vec<f64>,
    /// Stiffness of the soil over that of the storeys, and rate of its dashpots (1/s).
    soil: Option<(f64, f64)>,
}

#[derive(Debug, Clone)]
struct Pair {
    buildings: [Building; 2],
    width: f64,
    restitution: f64,
    rule: SeparationRule,
    /// Delay (s) of the motion under the second building.
    delay: Option<f64>,
    /// Height of the contact points above the floors (m).
    above: f64,
}

fn building() -> impl Strategy<Value = Building> {
    let soil = (2.0..20.0_f64, prop_oneof![5.0..60.0_f64, 200.0..900.0_f64]);
    (
        1_usize..5,
        0.25..1.2_f64,
        prop::collection::vec(0.005..0.12_f64, 5),
        prop::option::of(soil),
    )
        .prop_map(|(storeys, period, ratios, soil)| Building {
            storeys,
            period,
            ratios,
            soil,
        })
}

fn pairs() -> impl Strategy<Value = Pair> {
    let rules = [
        SeparationRule::ZeroPenetration,
        SeparationRule::NoTension,
        SeparationRule::GapShift,
    ];
    (
        [building(), building()],
        0.004..0.03_f64,
        0.3..0.95_f64,
        prop::sample::select(rules.to_vec()),
        prop::option::of(0.01..0.3_f64),
        0.0..1.0_f64,
    )
        .prop_map(|(buildings, width, restitution, rule, delay, above)| Pair {
            buildings,
            width,
            restitution,
            rule,
            delay,
            above,
        })
}

impl Building {
    /// Floors, then sway and rotation of the foundation.
    fn matrices(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let n = self.storeys;
        let all = if self.soil.is_some() { n + 2 } else { n };
        let angle = std::f64::consts::PI / (2.0 * (2.0 * n as f64 + 1.0));
        let omega = std::f64::consts::TAU / self.period;
        let stiffness = MASS * (omega / (2.0 * angle.sin())).powi(2);
        let (mut k, mut c) = (DMatrix::zeros(all, all), DMatrix::zeros(all, all));
        let mut add = |row: DVector<f64>, stiffness: f64, dashpot: f64| {
            k += stiffness * &row * row.transpose();
            c += dashpot * &row * row.transpose();
        };
        for i in 0..n {
            let mut drift = DVector::zeros(all);
            drift[i] = 1.0;
            if i > 0 {
                drift[i - 1] = -1.0;
            } else if self.soil.is_some() {
                drift[n] = -1.0;
            }
            if self.soil.is_some() {
                drift[n + 1] = -HEIGHT;
            }
            let dashpot = 2.0 * self.ratios[i] * (stiffness * MASS).sqrt();
            add(drift, stiffness, dashpot);
        }
        if let Some((ratio, rate)) = self.soil {
            for (place, inertia) in [(n, MASS), (n + 1, 10.0 * MASS)] {
                let mut row = DVector::zeros(all);
                row[place] = 1.0;
                add(row, ratio * stiffness * inertia / MASS, rate * inertia);
            }
        }
        (k, c)
    }

    fn build(&self, name: &str) -> Arc<ShearBuilding> {
        let n = self.storeys;
        let (stiffness, matrix) = self.matrices();
        let all = stiffness.nrows();
        let coordinate = |name: &str, inertia: f64, excitation| Coordinate {
            name: name.to_owned(),
            inertia,
            excitation,
        };
        let further = match self.soil {
            None => Vec::new(),
            Some(_) => vec![
                coordinate("sway", MASS, Excitation::Along),
                coordinate("rotation", 10.0 * MASS, Excitation::None),
            ],
        };
        let row = |kind, what: &str| ResponseRow {
            name: format!("{name} {what}"),
            unit: "m",
            kind,
            weights: (0..all).map(|i| 1.0 - 0.3 * i as f64).collect(),
        };
        let general = GeneralBuilding {
            name: name.to_owned(),
            mass: vec![MASS; n],
            height: vec![HEIGHT; n],
            further,
            stiffness,
            geometric: None,
            damping: Damping::Matrix { matrix },
            drifts: None,
            sections: (0..=n)
                .map(|s| {
                    (0..all)
                        .map(|i| 1.0e6 * ((s + 2 * i) as f64).sin())
                        .collect()
                })
                .collect(),
            responses: vec![
                row(ResponseKind::Displacement, "sum of displacements"),
                row(ResponseKind::Acceleration, "sum of accelerations"),
            ],
        };
        Arc::new(ShearBuilding::with_coordinates(general).unwrap())
    }
}

impl Pair {
    fn system(&self) -> System {
        let acceleration = synthetic_motion().unwrap();
        let motion = |delay: f64| GroundMotion {
            acceleration: acceleration.clone(),
            delay,
            origin: Vec::new(),
        };
        let motions = match self.delay {
            None => vec![motion(0.0)],
            Some(delay) => vec![motion(0.0), motion(delay)],
        };
        let under = |along: usize| Support {
            along,
            across: None,
        };
        let supports = vec![under(0), under(motions.len() - 1)];
        let buildings = vec![self.buildings[0].build("A"), self.buildings[1].build("B")];
        let mut system = System::with_motions(buildings, motions, supports).unwrap();
        let parameters = [("stiffness", 9.0e7), ("restitution", self.restitution)];
        let parameters = ModelParameters::from_pairs(&parameters).with_separation(self.rule);
        let model = registry::build("anagnostopoulos_2004", &parameters).unwrap();
        let model: Arc<dyn ImpactModel> = model.into();
        let point = |system: &mut System, building: usize, storey: usize| -> Floor {
            let own = &self.buildings[building];
            let mut weights = vec![(storey, 1.0)];
            if own.soil.is_some() {
                weights.push((own.storeys + 1, self.above));
            }
            system.add_point(BuildingPoint {
                building,
                storey,
                elevation: HEIGHT * (storey + 1) as f64,
                weights,
            })
        };
        let levels = self.buildings[0].storeys.min(self.buildings[1].storeys);
        let pairs = (0..levels).map(|storey| {
            let left = point(&mut system, 0, storey);
            let right = point(&mut system, 1, storey);
            (left, right, self.width, Arc::clone(&model))
        });
        let pairs = pairs.collect();
        let names = ["A".to_owned(), "B".to_owned()];
        system.add_gap("A-B", names, pairs).unwrap();
        let response = LevelResponse {
            name: "with the contact force".to_owned(),
            unit: "N",
            building: 0,
            weights: vec![(0, 2.0e7)],
            by_force: -0.4,
            capacity: None,
        };
        system.add_level_response(0, response).unwrap();
        system
    }
}

fn options(method: MethodChoice) -> RunOptions {
    RunOptions {
        method,
        duration: Some(DURATION),
        energy_tolerance: None,
    }
}

fn event_driven() -> RunOptions {
    options(MethodChoice::EventDriven {
        relative_tolerance: 1.0e-10,
    })
}

/// All peaks, kind by kind.
fn peaks(outcome: &Outcome) -> Vec<Vec<f64>> {
    let storeys = || outcome.buildings.iter().flat_map(|b| &b.storeys);
    let levels = || outcome.gaps.iter().flat_map(|g| &g.levels);
    let named = |which: usize| {
        let of = outcome.buildings.iter();
        of.map(|b| b.responses[which].peak.value).collect()
    };
    vec![
        storeys().map(|s| s.displacement.value).collect(),
        storeys().map(|s| s.drift_ratio.value).collect(),
        storeys().map(|s| s.storey_shear.value).collect(),
        storeys().map(|s| s.acceleration_absolute.value).collect(),
        (outcome.buildings.iter())
            .filter_map(|b| b.base_moment.map(|m| m.value))
            .collect(),
        named(0),
        named(1),
        levels().map(|l| l.peak_force.value).collect(),
        levels().map(|l| l.peak_penetration.value).collect(),
        levels().map(|l| l.impulse_max).collect(),
        levels()
            .flat_map(|l| l.responses.iter().map(|r| r.peak.value))
            .collect(),
        outcome.impacts.iter().map(|i| i.time_closed).collect(),
        outcome
            .impacts
            .iter()
            .map(|i| i.energy_dissipated)
            .collect(),
        vec![outcome.energy.end.input, outcome.energy.end.viscous],
    ]
}

/// Maximum difference as a part of the maximum of its kind.
fn difference(a: &Outcome, b: &Outcome) -> f64 {
    let kinds = peaks(a).into_iter().zip(peaks(b));
    kinds.fold(0.0, |worst, (a, b)| {
        let size = a.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        let off = a.iter().zip(&b).map(|(x, y)| (x - y).abs() / size);
        off.fold(worst, f64::max)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn exact_steps_and_the_adaptive_pair_agree(pair in pairs()) {
        let system = pair.system();
        let exact = run(&system, &event_driven(), &mut [], &mut |_| {}).unwrap();
        let tight = options(MethodChoice::Adaptive { relative_tolerance: 1.0e-13 });
        let adaptive = run(&system, &tight, &mut [], &mut |_| {}).unwrap();
        prop_assert!(exact.energy.residual_ratio < 1.0e-10, "{:?}", exact.energy);
        prop_assert_eq!(exact.impacts.len(), adaptive.impacts.len());
        let worst = difference(&exact, &adaptive);
        prop_assert!(worst < 1.0e-8, "{worst:e} with {} impacts", exact.impacts.len());
    }

    #[test]
    fn observers_of_coupled_buildings_change_nothing(pair in pairs()) {
        let system = pair.system();
        let alone = run(&system, &event_driven(), &mut [], &mut |_| {}).unwrap();
        let mut grid = GridRecorder::new(0.0037).unwrap();
        let mut approach = RelativeDisplacement::of_levels(&system);
        let watched = run(&system, &event_driven(), &mut [&mut grid, &mut approach], &mut |_| {});
        prop_assert_eq!(format!("{:?}", alone), format!("{:?}", watched.unwrap()));
        // What they see stays within the peaks, and approaches them.
        let floors = system.floors();
        let storeys = alone.buildings.iter().flat_map(|b| &b.storeys);
        for (i, storey) in storeys.enumerate() {
            let rows = grid.responses.displacement.chunks(floors);
            let seen = rows.fold(0.0_f64, |m, row| m.max(row[i].abs()));
            let peak = storey.displacement.value;
            prop_assert!(seen <= peak * (1.0 + 1.0e-9) && seen > 0.9 * peak, "{seen} of {peak}");
        }
        for (approach, level) in approach.peaks().iter().zip(&alone.gaps[0].levels) {
            let reached = level.peak_penetration.value + pair.width;
            if level.impacts > 0 && level.gap_widening == 0.0 {
                let off = (approach.value - reached).abs();
                prop_assert!(off < 1.0e-9, "{} for {reached}", approach.value);
            }
        }
    }
}
