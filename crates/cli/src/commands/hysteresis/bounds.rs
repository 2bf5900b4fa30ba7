//! Deformations that cannot be followed, or not in numbers of double precision.

use super::chosen::Chosen;
use super::cycles::State;
use super::motion::Path;
use crate::commands::impact::numbers::significant;
use crate::failure::Failure;

/// Greatest deformation over the yield deformation for laws that are integrated along
/// their path: the work grows with it.
const FARTHEST: f64 = 1.0e5;
/// Law whose energy is an integral along its path, without internal variables.
const INTEGRATED_ENERGY: &str = "menegotto_pinto_1973";

/// Refuses deformations (m) far beyond yield to a law that has to be integrated along
/// them.
pub fn reachable(chosen: &Chosen, greatest: f64) -> Result<(), Failure> {
    let value = |name: &str| chosen.parameters.values.get(name).copied();
    let (Some(stiffness), Some(yield_force)) = (value("stiffness"), value("yield_force")) else {
        return Ok(());
    };
    let integrated = chosen.law.internal_variables() > 0 || chosen.card.name == INTEGRATED_ENERGY;
    let ratio = greatest * stiffness / yield_force;
    if !integrated || ratio <= FARTHEST {
        return Ok(());
    }
    Err(Failure::input(
        format!(
            "a deformation of {} m is {} times the yield deformation of {}, which is integrated along its path up to {FARTHEST} times",
            significant(greatest),
            significant(ratio),
            chosen.card.name
        ),
        Some(
            "check the unit of the deformation, of stiffness and of yield_force; law bilinear takes any"
                .to_owned(),
        ),
    ))
}

/// Greatest absolute deformation of a path (m).
pub fn greatest(path: &Path) -> f64 {
    let deformations = path.steps.iter().map(|s| s.motion.deformation.abs());
    deformations.fold(0.0, f64::max)
}

/// Refuses a loop whose force or energy overflows.
pub fn finite(states: &[State]) -> Result<(), Failure> {
    let overflowing = |s: &&State| !(s.force.is_finite() && s.dissipated.is_finite());
    states
        .iter()
        .find(overflowing)
        .map_or(Ok(()), |s| Err(overflow(s.deformation)))
}

/// Refuses pairs of amplitude and energy where the energy overflows.
pub fn finite_pairs(pairs: &[(f64, f64)]) -> Result<(), Failure> {
    pairs
        .iter()
        .find(|(_, energy)| !energy.is_finite())
        .map_or(Ok(()), |(amplitude, _)| Err(overflow(*amplitude)))
}

fn overflow(deformation: f64) -> Failure {
    Failure::input(
        format!(
            "force or energy overflow at a deformation of {} m",
            significant(deformation)
        ),
        Some("check the unit of the deformations".to_owned()),
    )
}
