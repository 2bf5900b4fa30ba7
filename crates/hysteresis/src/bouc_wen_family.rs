//! The smooth law of Bouc and Wen with the degradation and pinching of Baber and
//! Noori.
//!
//! Without dimension: `zeta = z / xy`, `xi = x / xy` and the hysteretic work
//! `e = int zeta dxi`. Along a path in one direction the internal variables depend on
//! the deformation alone, so a trial integrates them along its path and its tangent
//! is their slope at the end.

use crate::descriptor::LawDescriptor;
use crate::error::HysteresisError;
use crate::history::{Branch, History, MAXIMUM_INTERNAL_VARIABLES, Point};
use crate::law::{Guard, Guards, HysteresisLaw, Motion, Response};
use crate::parameters::LawParameters;
use crate::substeps::integrate;

/// `zeta` has the sign of the motion.
pub(crate) const LOADING: u8 = 0;
/// `zeta` has the other sign.
const UNLOADING: u8 = 1;

/// How strength, stiffness and the slope near zero force change with the work.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Degradation {
    /// `nu = 1 + strength e`.
    pub strength: f64,
    /// `eta = 1 + stiffness e`.
    pub stiffness: f64,
    /// Maximum pinching `zeta_s`, below 1.
    pub pinching: f64,
    /// Rate `p` at which pinching grows with the work.
    pub pinching_rate: f64,
    /// Position `q` of the pinch as a share of the ultimate force.
    pub pinching_position: f64,
    /// Spread `psi_0` of the pinch.
    pub pinching_spread: f64,
    /// Rate `delta_psi` at which the spread grows.
    pub pinching_spread_rate: f64,
    /// Coupling `lambda` of the spread with the amount of pinching.
    pub pinching_coupling: f64,
}

/// A law of the family.
#[derive(Debug)]
pub(crate) struct BoucWen {
    pub descriptor: &'static LawDescriptor,
    pub stiffness: f64,
    pub yield_force: f64,
    pub hardening_ratio: f64,
    pub exponent: f64,
    pub beta: f64,
    pub gamma: f64,
    pub degradation: Degradation,
}

impl BoucWen {
    /// The parameters that both laws share.
    pub fn from_parameters(
        descriptor: &'static LawDescriptor,
        parameters: &LawParameters,
        degradation: Degradation,
    ) -> Result<Self, HysteresisError> {
        let get = |name| parameters.get(descriptor, name);
        let (beta, gamma) = (get("beta")?, get("gamma")?);
        if !(gamma > -beta && gamma <= beta) {
            return Err(HysteresisError::Inconsistent {
                law: descriptor.name,
                reason: format!(
                    "gamma = {gamma} is outside (-beta, beta] with beta = {beta}: the element would create energy, or never yield"
                ),
                remedy: "take -beta < gamma <= beta; both 0.5 give straight unloading",
            });
        }
        Ok(Self {
            descriptor,
            stiffness: get("stiffness")?,
            yield_force: get("yield_force")?,
            hardening_ratio: get("hardening_ratio")?,
            exponent: get("exponent")?,
            beta,
            gamma,
            degradation,
        })
    }

    fn yield_deformation(&self) -> f64 {
        self.yield_force / self.stiffness
    }

    /// Energy (J) of one unit of `e`.
    fn unit_of_energy(&self) -> f64 {
        (1.0 - self.hardening_ratio) * self.yield_force * self.yield_deformation()
    }

    /// Slope `dzeta / dxi` for motion in `direction` with `zeta` on `side`.
    fn slope(&self, zeta: f64, work: f64, direction: f64, side: f64) -> f64 {
        let d = &self.degradation;
        let weakening = 1.0 + d.strength * work;
        let softening = 1.0 + d.stiffness * work;
        let reached = side * zeta;
        let power = libm::pow(reached.abs(), self.exponent);
        let power = if reached < 0.0 { -power } else { power };
        let bend = self.beta * direction * side + self.gamma;
        self.pinch(zeta, work, direction, weakening) * (1.0 - weakening * power * bend) / softening
    }

    /// Factor `h` of the slope; 1 without pinching.
    fn pinch(&self, zeta: f64, work: f64, direction: f64, weakening: f64) -> f64 {
        let d = &self.degradation;
        if d.pinching == 0.0 {
            return 1.0;
        }
        let amount = -d.pinching * libm::expm1(-d.pinching_rate * work);
        let spread =
            (d.pinching_spread + d.pinching_spread_rate * work) * (d.pinching_coupling + amount);
        let ultimate = self.ultimate(weakening);
        let off = (zeta * direction - d.pinching_position * ultimate) / spread;
        1.0 - amount * libm::exp(-off * off)
    }

    /// Magnitude of `zeta` at which its slope is zero under loading.
    fn ultimate(&self, weakening: f64) -> f64 {
        libm::pow(weakening * (self.beta + self.gamma), -1.0 / self.exponent)
    }

    /// Follows a path in one direction; the committed variables are those of the
    /// history.
    fn walk(&self, history: &mut History, deformation: f64) {
        let scale = self.yield_deformation();
        let mut at = history.deformation / scale;
        let to = deformation / scale;
        let direction = (to - at).signum();
        let [mut zeta, mut work] = history.variables;
        let mut side = if zeta == 0.0 {
            direction
        } else {
            zeta.signum()
        };
        if side != direction {
            let path = |_: f64, y: &[f64; 2]| [self.slope(y[0], y[1], direction, side), y[0]];
            let end = integrate(path, [zeta, work], at, to);
            if side * end[0] >= 0.0 {
                self.settle(history, end, direction, side);
                return;
            }
            // Up to the zero of zeta, with zeta as the running variable.
            let inverse = |z: f64, y: &[f64; 2]| {
                let slope = self.slope(z, y[1], direction, side);
                [1.0 / slope, z / slope]
            };
            [at, work] = integrate(inverse, [at, work], zeta, 0.0);
            zeta = 0.0;
            side = direction;
        }
        let path = |_: f64, y: &[f64; 2]| [self.slope(y[0], y[1], direction, side), y[0]];
        let end = integrate(path, [zeta, work], at, to);
        self.settle(history, end, direction, side);
    }

    fn settle(&self, history: &mut History, variables: [f64; 2], direction: f64, side: f64) {
        history.variables = variables;
        history.branch.direction = direction;
        history.branch.side = side;
        history.branch.kind = kind(direction, side);
    }
}

/// The branch of a motion in this direction while `zeta` is on this side.
pub(crate) fn kind(direction: f64, side: f64) -> u8 {
    if direction == side {
        LOADING
    } else {
        UNLOADING
    }
}

/// The internal variables given, or those of the history.
pub(crate) fn variables(history: &History, given: &[f64]) -> [f64; 2] {
    match given {
        [zeta, work, ..] => [*zeta, *work],
        _ => history.variables,
    }
}

/// A branch ends where the motion turns, and unloading where `zeta` changes its sign.
pub(crate) fn guards(history: &History) -> Guards {
    let unloading = history.branch.kind == UNLOADING;
    [
        Some(Guard::Turning),
        unloading.then_some(Guard::Variable(0)),
        None,
    ]
}

/// Goes over to the branch beyond a guard.
pub(crate) fn pass(history: &mut History, guard: Guard) {
    let branch = &mut history.branch;
    match guard {
        Guard::Turning => branch.direction = -branch.direction,
        Guard::Variable(_) => branch.side = -branch.side,
        _ => {}
    }
    branch.kind = kind(branch.direction, branch.side);
}

impl HysteresisLaw for BoucWen {
    fn descriptor(&self) -> &'static LawDescriptor {
        self.descriptor
    }
    fn initial_stiffness(&self) -> f64 {
        self.stiffness
    }
    /// The slope is `h (1 -+ r bend) / eta`, where `h <= 1 <= eta`, and `r`, the power of `zeta` as a part of the ultimate
    /// one, is at most 1 but for what the strength has lost since: twice what it is leaves room for the loss of a step.
    fn slope_bound(&self, committed: &History) -> Option<f64> {
        let [zeta, work] = committed.variables;
        let weakening = 1.0 + self.degradation.strength * work;
        let power = libm::pow(zeta.abs(), self.exponent);
        let reached = 2.0 * (weakening * power * (self.beta + self.gamma)).max(1.0);
        let unloading = 1.0 + reached * (self.beta - self.gamma) / (self.beta + self.gamma);
        let slope = unloading.max(reached - 1.0);
        let parallel = self.hardening_ratio;
        Some(self.stiffness * (parallel + (1.0 - parallel) * slope))
    }
    fn internal_variables(&self) -> usize {
        2
    }
    fn variable_sizes(&self) -> [f64; MAXIMUM_INTERNAL_VARIABLES] {
        [0.1, 1.0]
    }
    fn variable_bound(&self) -> f64 {
        self.ultimate(1.0)
    }
    fn virgin(&self) -> History {
        let branch = Branch::line(LOADING, 1.0, Point::default(), 0.0).towards(1.0);
        let mut history = History::new(branch);
        history.internal_variables = 2;
        history
    }
    fn trial(
        &self,
        committed: &History,
        candidate: &mut History,
        end: Motion,
        _step: f64,
    ) -> Response {
        candidate.clone_from(committed);
        if end.deformation != committed.deformation {
            self.walk(candidate, end.deformation);
        }
        candidate.deformation = end.deformation;
        candidate.velocity = end.velocity;
        let [zeta, work] = candidate.variables;
        let branch = &candidate.branch;
        let slope = self.slope(zeta, work, branch.direction, branch.side);
        let mut response = HysteresisLaw::force(self, candidate, end, &[zeta, work]);
        response.by_deformation += (1.0 - self.hardening_ratio) * self.stiffness * slope;
        response
    }
    fn force(&self, history: &History, motion: Motion, given: &[f64]) -> Response {
        let [zeta, _] = variables(history, given);
        let parallel = self.hardening_ratio * self.stiffness;
        Response {
            force: parallel * motion.deformation
                + (1.0 - self.hardening_ratio) * self.yield_force * zeta,
            by_deformation: parallel,
            by_velocity: 0.0,
        }
    }
    fn rates(&self, history: &History, motion: Motion, given: &[f64], rates: &mut [f64]) {
        let [zeta, work] = variables(history, given);
        let branch = &history.branch;
        let speed = motion.velocity / self.yield_deformation();
        if let [zeta_rate, work_rate, ..] = rates {
            *zeta_rate = self.slope(zeta, work, branch.direction, branch.side) * speed;
            *work_rate = zeta * speed;
        }
    }
    fn guards(&self, history: &History) -> Guards {
        guards(history)
    }
    fn pass(&self, history: &mut History, guard: Guard, motion: Motion, given: &[f64]) {
        self.accept(history, motion, given);
        pass(history, guard);
    }
    fn stored_energy(&self, history: &History, motion: Motion, given: &[f64]) -> f64 {
        let [zeta, work] = variables(history, given);
        let softening = 1.0 + self.degradation.stiffness * work;
        let x = motion.deformation;
        0.5 * self.hardening_ratio * self.stiffness * x * x
            + 0.5 * self.unit_of_energy() * softening * zeta * zeta
    }
    fn dissipated_energy(&self, history: &History, _: Motion, given: &[f64]) -> f64 {
        let [zeta, work] = variables(history, given);
        let softening = 1.0 + self.degradation.stiffness * work;
        self.unit_of_energy() * (work - 0.5 * softening * zeta * zeta)
    }
}
