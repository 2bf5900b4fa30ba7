//! Paths that cannot be followed in a short time, or not in numbers of double precision.

use super::chosen::Chosen;
use super::cycles::State;
use super::motion::Path;
use crate::commands::impact::numbers::significant;
use crate::failure::Failure;

/// Longest path over the yield deformation for laws that are integrated along it: the
/// work grows with it, for exponents above this one in proportion to them as well.
const LONGEST: f64 = 2.0e6;
const USUAL_EXPONENT: f64 = 2.0;
/// Law whose energy is an integral along its path, without internal variables.
const INTEGRATED_ENERGY: &str = "menegotto_pinto_1973";

/// Refuses a path (m) far beyond yield to a law that has to be integrated along it.
pub fn reachable(chosen: &Chosen, length: f64) -> Result<(), Failure> {
    let value = |name: &str| chosen.parameters.values.get(name).copied();
    let (Some(stiffness), Some(yield_force)) = (value("stiffness"), value("yield_force")) else {
        return Ok(());
    };
    let integrated =
        chosen.law.internal_variables() > 0 || chosen.descriptor.name == INTEGRATED_ENERGY;
    let sharper = value("exponent").map_or(1.0, |n| (n / USUAL_EXPONENT).max(1.0));
    let (ratio, most) = (length * stiffness / yield_force, LONGEST / sharper);
    if !integrated || ratio <= most {
        return Ok(());
    }
    Err(Failure::input(
        format!(
            "a path of {} m in all is {} times the yield deformation of {}, which is integrated along its path up to {} times",
            significant(length),
            significant(ratio),
            chosen.descriptor.name,
            significant(most)
        ),
        Some(
            "check the unit of the deformation, of stiffness and of yield_force; law bilinear takes any"
                .to_owned(),
        ),
    ))
}

/// Length of a path from a new element at rest (m).
pub fn length(path: &Path) -> f64 {
    let mut from = 0.0;
    path.steps
        .iter()
        .map(|step| {
            let to = step.motion.deformation;
            (to - std::mem::replace(&mut from, to)).abs()
        })
        .sum()
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
