//! Options of a run.

use crate::error::TimeHistoryError;
use crate::estimate::{StepEstimate, contacts_last, is_stable};
use crate::layout::Layout;
use crate::method_choice::{DEFAULT_RELATIVE_TOLERANCE, MethodChoice};
use crate::methods::{Adaptive, EventDriven, Method, MoreauJean, Newmark, RungeKutta4};
use crate::system::{GroundAcceleration, System};

/// Options of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunOptions {
    /// Integration method.
    pub method: MethodChoice,
    /// Duration (s); `None`: that of the ground motion.
    pub duration: Option<f64>,
    /// Bound of the energy residual over the largest input energy (-); `None`:
    /// [`RunOptions::energy_tolerance`] gives the method's default.
    pub energy_tolerance: Option<f64>,
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            method: MethodChoice::EventDriven {
                relative_tolerance: DEFAULT_RELATIVE_TOLERANCE,
            },
            duration: None,
            energy_tolerance: None,
        }
    }
}

impl RunOptions {
    /// Bound of the energy residual that makes a run an error: as asked, or 1e-6
    /// for the event-driven method and the adaptive pair, and 0.05 for fixed steps, whose residual tells how
    /// coarse the step is and, for HHT-alpha and gamma above 1/2, how much the
    /// method itself damps.
    #[must_use]
    pub fn energy_tolerance(&self) -> f64 {
        self.energy_tolerance.unwrap_or(match self.method {
            MethodChoice::Adaptive { .. } | MethodChoice::EventDriven { .. } => 1.0e-6,
            _ => 0.05,
        })
    }

    /// Checks the options against a system and returns the duration (s).
    ///
    /// # Errors
    /// An option out of range, a run of more than [`crate::MAXIMUM_STEPS`] steps, samples of the ground that are not finite, or
    /// what the method does not integrate: steps too long for it to be stable, and by method contacts or elements with laws of a
    /// kind, rigid contacts whose floors begin beyond their gap, contacts shorter than the digits of the time.
    pub fn check(&self, system: &System) -> Result<f64, TimeHistoryError> {
        require(
            system.degrees_of_freedom() > 0,
            "buildings",
            0.0,
            "a system needs at least one",
        )?;
        let positive = |option, value: f64| {
            require(
                value.is_finite() && value > 0.0,
                option,
                value,
                "it must be greater than zero, and finite",
            )
        };
        let GroundAcceleration { samples, time_step } = system.ground();
        positive("time step of the ground motion", *time_step)?;
        if let Some(at) = samples.iter().position(|a| !a.is_finite()) {
            return Err(TimeHistoryError::Motions {
                reason: format!(
                    "sample {} of {} is {}; they must all be finite",
                    at + 1,
                    samples.len(),
                    samples[at]
                ),
            });
        }
        match self.method {
            MethodChoice::Adaptive { relative_tolerance }
            | MethodChoice::EventDriven { relative_tolerance } => require(
                (1.0e-14..=1.0e-2).contains(&relative_tolerance),
                "relative_tolerance",
                relative_tolerance,
                "it must lie between 1e-14 and 1e-2",
            )?,
            MethodChoice::Newmark { step, beta, gamma } => {
                positive("step", step)?;
                require(
                    (0.0..=1.0).contains(&beta),
                    "beta",
                    beta,
                    "it must lie in 0..1",
                )?;
                require(
                    gamma > 0.0 && gamma <= 1.0,
                    "gamma",
                    gamma,
                    "it must be greater than 0 and at most 1",
                )?;
            }
            MethodChoice::HhtAlpha { step, alpha } => {
                positive("step", step)?;
                require(
                    (-1.0 / 3.0 - 1.0e-12..=0.0).contains(&alpha),
                    "alpha",
                    alpha,
                    "it must lie between -1/3 and 0",
                )?;
            }
            MethodChoice::RungeKutta4 { step } => positive("step", step)?,
            MethodChoice::MoreauJean { step, theta } => {
                positive("step", step)?;
                require(
                    (0.5..=1.0).contains(&theta),
                    "theta",
                    theta,
                    "it must lie between 1/2 and 1",
                )?;
                rigid_throughout(system)?;
                if !system.elements().is_empty() {
                    return Err(TimeHistoryError::NotLinear {
                        method: "moreau_jean",
                        place: system.place_of_element(0),
                    });
                }
            }
        }
        rigid_rows_have_clearance(system)?;
        contacts_last(system)?;
        if let Some(tolerance) = self.energy_tolerance {
            positive("energy_tolerance", tolerance)?;
        }
        let duration = self.duration.unwrap_or_else(|| system.record_duration());
        positive("duration", duration)?;
        StepEstimate::new(system, &self.method, duration).check(duration)?;
        is_stable(system, &self.method)?;
        Ok(duration)
    }

    pub(crate) fn build_method(&self, system: &System) -> Box<dyn Method> {
        let layout = Layout::of(system);
        match self.method {
            MethodChoice::Adaptive { relative_tolerance } => {
                Box::new(Adaptive::new(system, relative_tolerance))
            }
            MethodChoice::EventDriven { relative_tolerance } => {
                Box::new(EventDriven::new(system, relative_tolerance))
            }
            MethodChoice::Newmark { step, beta, gamma } => {
                Box::new(Newmark::with_beta_gamma(system, step, beta, gamma))
            }
            MethodChoice::HhtAlpha { step, alpha } => {
                Box::new(Newmark::hht_alpha(system, step, alpha))
            }
            MethodChoice::RungeKutta4 { step } => Box::new(RungeKutta4::new(layout, step)),
            MethodChoice::MoreauJean { step, theta } => {
                Box::new(MoreauJean::new(system, step, theta))
            }
        }
    }
}

/// Moreau-Jean stepping knows impulses only.
fn rigid_throughout(system: &System) -> Result<(), TimeHistoryError> {
    for gap in system.gaps() {
        for level in &system.levels()[gap.first_level..gap.first_level + gap.levels] {
            if level.model.rigid_restitution().is_none() {
                return Err(TimeHistoryError::CompliantModel {
                    gap: gap.name.clone(),
                    model: level.model.descriptor().name,
                });
            }
        }
    }
    Ok(())
}

/// Clearance (m) below which rigid floors between two walls count as held.
const LEAST_CLEARANCE: f64 = 1.0e-9;

/// Rigid floors in a row from wall to wall need clearance: without it they cannot move, and
/// a prestress between the walls is as good a solution as none.
fn rigid_rows_have_clearance(system: &System) -> Result<(), TimeHistoryError> {
    let levels = system.levels();
    let rigid = |l: &usize| levels[*l].model.rigid_restitution().is_some();
    let mut to_the_right = vec![None; system.degrees_of_freedom()];
    for l in (0..levels.len()).filter(rigid) {
        if let Some(floor) = levels[l].left {
            to_the_right[floor] = Some(l);
        }
    }
    for first in (0..levels.len()).filter(rigid) {
        if system.storey_of(levels[first].between[0]).is_some() {
            continue;
        }
        let next = |l: &usize| levels[*l].right.and_then(|floor| to_the_right[floor]);
        let row = || std::iter::successors(Some(first), next);
        let clearance: f64 = row().map(|l| levels[l].width).sum();
        let reaches_a_wall = row()
            .last()
            .is_some_and(|l| system.storey_of(levels[l].between[1]).is_none());
        if reaches_a_wall && clearance <= LEAST_CLEARANCE {
            let places: Vec<_> = row().map(|l| system.name_of_level(l)).collect();
            return Err(TimeHistoryError::NoClearance {
                place: places.join(", "),
                clearance,
            });
        }
    }
    Ok(())
}

fn require(
    holds: bool,
    option: &'static str,
    value: f64,
    reason: &'static str,
) -> Result<(), TimeHistoryError> {
    if holds {
        Ok(())
    } else {
        Err(TimeHistoryError::Option {
            option,
            value,
            reason,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pounding_shear_building::{Damping, ShearBuilding};

    use super::*;
    use crate::system::GroundAcceleration;

    /// Time does not go back: the run would not end.
    #[test]
    fn ground_motions_go_forward() {
        for time_step in [-0.02, 0.0, f64::NAN, f64::INFINITY] {
            let damping = Damping::Modal { ratios: vec![0.05] };
            let floor = |value: f64| vec![value];
            let building = ShearBuilding::new(
                "a".to_owned(),
                floor(2.5e4),
                floor(3.46e6),
                floor(3.0),
                damping,
            )
            .unwrap();
            let ground = GroundAcceleration {
                samples: Arc::new(vec![0.0, 1.0, 0.0]),
                time_step,
            };
            let options = RunOptions {
                duration: Some(1.0),
                ..RunOptions::default()
            };
            let checked = options.check(&System::new(vec![Arc::new(building)], ground));
            let said = checked.unwrap_err().to_string();
            assert!(said.contains("time step of the ground motion"), "{said}");
        }
    }
}
