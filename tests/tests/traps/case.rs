//! One contact level between two chains of storeys, or a chain and a wall, given both
//! to the program and to the exact solution beside it.

use std::sync::Arc;

use pounding_gap_element::{ModelParameters, SeparationRule, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GridRecorder, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, run,
};
use verification::AnyModel;

/// Storeys from the bottom, with `C = alpha M + beta K`.
#[derive(Debug, Clone)]
pub struct Chain {
    /// Floor masses (kg).
    pub mass: Vec<f64>,
    /// Storey stiffnesses (N/m).
    pub stiffness: Vec<f64>,
    /// Mass factor of the damping (1/s).
    pub alpha: f64,
    /// Stiffness factor of the damping (s).
    pub beta: f64,
}

/// Laws that are affine between their own events. `zeta` is `c / (2 sqrt(k m))`.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    /// A spring.
    Spring { k: f64 },
    /// Spring and dashpot until the floors part.
    KelvinVoigt { k: f64, zeta: f64 },
    /// The same, never pulling.
    NoTension { k: f64, zeta: f64 },
    /// The dashpot acts in approach alone.
    ApproachOnly { k: f64, zeta: f64 },
    /// `k delta (1 + friction sgn v)`, any force between at rest.
    DryFriction { k: f64, friction: f64 },
}

/// Everything that a run needs.
#[derive(Debug, Clone)]
pub struct Case {
    /// One or two chains from the left.
    pub chains: Vec<Chain>,
    /// The floors in contact, counted over both chains; no right one is a wall.
    pub floors: (usize, Option<usize>),
    /// Gap (m).
    pub gap: f64,
    /// Law of the contact.
    pub law: Law,
    /// Ground acceleration (m/s2).
    pub ground: Vec<f64>,
    /// Its step (s).
    pub time_step: f64,
    /// Displacements, then velocities at time zero.
    pub start: Vec<f64>,
}

/// The default method and its peer, both tight in contacts.
pub const METHODS: [MethodChoice; 2] = [
    MethodChoice::EventDriven {
        relative_tolerance: 1e-10,
    },
    MethodChoice::Adaptive {
        relative_tolerance: 1e-12,
    },
];

impl Law {
    fn model(self) -> AnyModel {
        let (name, pairs, rule) = match self {
            Self::Spring { k } => ("linear_elastic", vec![("stiffness", k)], None),
            Self::KelvinVoigt { k, zeta } => (
                "anagnostopoulos_2004",
                vec![("stiffness", k), ("damping_ratio", zeta)],
                None,
            ),
            Self::NoTension { k, zeta } => (
                "anagnostopoulos_2004",
                vec![("stiffness", k), ("damping_ratio", zeta)],
                Some(SeparationRule::NoTension),
            ),
            Self::ApproachOnly { k, zeta } => (
                "mahmoud_jankowski_2011",
                vec![("stiffness", k), ("damping_ratio", zeta)],
                None,
            ),
            Self::DryFriction { k, friction } => (
                "borovin_2014",
                vec![("stiffness", k), ("friction", friction), ("exponent", 1.0)],
                None,
            ),
        };
        let mut parameters = ModelParameters::from_pairs(&pairs);
        parameters.separation = rule;
        registry::build(name, &parameters).unwrap().into()
    }
}

impl Chain {
    /// A single storey of this mass (kg), period (s) and damping ratio.
    pub fn single(mass: f64, period: f64, ratio: f64) -> Self {
        let omega = std::f64::consts::TAU / period;
        Self {
            mass: vec![mass],
            stiffness: vec![mass * omega * omega],
            alpha: 2.0 * ratio * omega,
            beta: 0.0,
        }
    }

    /// A body (kg) as good as free.
    pub fn body(mass: f64) -> Self {
        Self {
            mass: vec![mass],
            stiffness: vec![1e-12 * mass],
            alpha: 0.0,
            beta: 0.0,
        }
    }
}

impl Case {
    /// One chain whose floor meets a wall, at rest until the ground moves.
    pub fn wall(chain: Chain, floor: usize, gap: f64, law: Law, ground: (Vec<f64>, f64)) -> Self {
        let start = vec![0.0; 2 * chain.mass.len()];
        Self {
            chains: vec![chain],
            floors: (floor, None),
            gap,
            law,
            ground: ground.0,
            time_step: ground.1,
            start,
        }
    }

    /// Two chains whose roofs meet, at rest until the ground moves.
    pub fn pair(chains: [Chain; 2], gap: f64, law: Law, ground: (Vec<f64>, f64)) -> Self {
        let left = chains[0].mass.len();
        let all = left + chains[1].mass.len();
        Self {
            chains: chains.into(),
            floors: (left - 1, Some(all - 1)),
            gap,
            law,
            ground: ground.0,
            time_step: ground.1,
            start: vec![0.0; 2 * all],
        }
    }

    /// The same, let go from these displacements and velocities.
    pub fn from(mut self, start: &[f64]) -> Self {
        self.start = start.to_vec();
        self
    }

    /// The same with another gap.
    pub fn with_gap(&self, gap: f64) -> Self {
        Self {
            gap,
            ..self.clone()
        }
    }

    /// All floors.
    pub fn floor_count(&self) -> usize {
        self.chains.iter().map(|c| c.mass.len()).sum()
    }

    /// The case as the program takes it.
    pub fn system(&self) -> System {
        self.system_with(self.law.model())
    }

    /// The case with any impact model in place of its law.
    pub fn system_with(&self, model: AnyModel) -> System {
        let mut places = Vec::new();
        let mut buildings = Vec::new();
        for (i, chain) in self.chains.iter().enumerate() {
            places.extend((0..chain.mass.len()).map(|s| Floor::Storey(i, s)));
            let damping = Damping::Rayleigh {
                alpha: chain.alpha,
                beta: chain.beta,
            };
            let (m, k) = (chain.mass.clone(), chain.stiffness.clone());
            let heights = vec![3.0; m.len()];
            let building = ShearBuilding::new(format!("chain{i}"), m, k, heights, damping);
            buildings.push(Arc::new(building.unwrap()));
        }
        let ground = GroundAcceleration {
            samples: self.ground.clone().into(),
            time_step: self.time_step,
        };
        let mut system = System::new(buildings, ground);
        let right = self.floors.1.map_or(Floor::Wall, |r| places[r]);
        let names = ["left".to_owned(), "right".to_owned()];
        let level = (places[self.floors.0], right, self.gap, model);
        system.add_gap("gap", names, vec![level]).unwrap();
        let (u, v) = self.start.split_at(self.floor_count());
        system.with_initial_state(u, v).unwrap()
    }

    /// The program's answer.
    pub fn run(&self, method: MethodChoice) -> Outcome {
        go(&self.system(), method)
    }

    /// The program's answer with a recorder that looks at the record's own samples, and
    /// the maximum penetration that it saw there (m), negative for none.
    pub fn run_sampled(&self, method: MethodChoice) -> (Outcome, f64) {
        let options = RunOptions {
            method,
            ..RunOptions::default()
        };
        let mut grid = GridRecorder::new(self.time_step).unwrap();
        let outcome = run(&self.system(), &options, &mut [&mut grid], &mut |_| {}).unwrap();
        assert!(grid.responses.len() >= self.ground.len());
        let seen = grid.responses.column(&grid.responses.penetration, 0);
        let maximum = seen.into_iter().fold(f64::NEG_INFINITY, f64::max);
        (outcome, maximum)
    }
}

/// A run without recorders.
pub fn go(system: &System, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        ..RunOptions::default()
    };
    run(system, &options, &mut [], &mut |_| {}).unwrap()
}

/// A record that changes its mind at every sample: sines whose periods have nothing to
/// do with its step (s), of this amplitude (m/s2).
pub fn restless(samples: usize, time_step: f64, seed: f64, amplitude: f64) -> (Vec<f64>, f64) {
    let value = |i: usize| {
        let x = i as f64;
        amplitude * ((1.7 * x + seed).sin() + 0.6 * (0.9 * x + 2.1 * seed).cos())
    };
    ((0..samples).map(value).collect(), time_step)
}

/// A ground acceleration (m/s2) that does not change, over some samples.
pub fn steady(acceleration: f64, samples: usize, time_step: f64) -> (Vec<f64>, f64) {
    (vec![acceleration; samples], time_step)
}
