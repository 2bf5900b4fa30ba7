//! Dry friction about a spring that is given as a table: `F = f(delta) (1 + D sgn v)`.

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, SeparationRule, Transition,
};

use super::dry_friction::transitions;

/// `F = f(delta) (1 + D sgn v)` with a force f of straight lines between points.
#[derive(Debug)]
pub(crate) struct TabulatedDryFriction {
    descriptor: &'static ModelDescriptor,
    /// Penetration (m), force (N) and its work from zero (J); the first is zero.
    points: Vec<(f64, f64, f64)>,
    /// D (-).
    friction: f64,
}

impl TabulatedDryFriction {
    /// From penetrations (m) and forces (N), both increasing from above zero, and D (-). Beyond
    /// the last point the last line goes on.
    ///
    /// # Errors
    /// No point, points that do not increase, or a friction that is negative or not finite.
    pub(crate) fn new(
        descriptor: &'static ModelDescriptor,
        table: &[(f64, f64)],
        friction: f64,
    ) -> Result<Self, GapElementError> {
        if !(friction.is_finite() && friction >= 0.0) {
            return Err(GapElementError::SpringTable(format!(
                "the friction is {friction}"
            )));
        }
        let mut points = vec![(0.0, 0.0, 0.0)];
        for &(delta, force) in table {
            let (before, from, work) = points[points.len() - 1];
            if !(delta > before && force > from && delta.is_finite() && force.is_finite()) {
                return Err(GapElementError::SpringTable(format!(
                    "{force} N at {delta} m does not lie above {from} N at {before} m"
                )));
            }
            points.push((delta, force, work + 0.5 * (force + from) * (delta - before)));
        }
        if points.len() < 2 {
            return Err(GapElementError::SpringTable("it is empty".to_owned()));
        }
        Ok(Self {
            descriptor,
            points,
            friction,
        })
    }

    /// The point before a penetration, and the slope from there (N/m).
    fn line(&self, delta: f64) -> ((f64, f64, f64), f64) {
        let after = self.points.partition_point(|p| p.0 <= delta);
        let after = after.clamp(1, self.points.len() - 1);
        let (from, to) = (self.points[after - 1], self.points[after]);
        (from, (to.1 - from.1) / (to.0 - from.0))
    }

    /// Force (N) and slope (N/m) of the spring.
    fn spring(&self, delta: f64) -> (f64, f64) {
        let (from, slope) = self.line(delta);
        (from.1 + slope * (delta - from.0), slope)
    }

    /// Work on the spring from zero to a penetration (J).
    fn work(&self, delta: f64) -> f64 {
        let (from, slope) = self.line(delta);
        let way = delta - from.0;
        from.2 + (from.1 + 0.5 * slope * way) * way
    }

    /// Penetration (m) at which the spring has taken this work (J).
    fn penetration(&self, work: f64) -> f64 {
        let after = self.points.partition_point(|p| p.2 <= work);
        let from = self.points[after.clamp(1, self.points.len() - 1) - 1];
        let (_, slope) = self.line(from.0);
        let rest = work - from.2;
        // The positive root of slope x^2 / 2 + f x = rest, without cancellation.
        from.0 + 2.0 * rest / (from.1 + (from.1 * from.1 + 2.0 * slope * rest).sqrt())
    }

    fn dry(&self, phase: Phase) -> Option<f64> {
        match phase {
            Phase::Approach => Some(1.0 + self.friction),
            Phase::Restitution => Some(1.0 - self.friction),
            _ => None,
        }
    }
}

impl ImpactModel for TabulatedDryFriction {
    fn descriptor(&self) -> &'static ModelDescriptor {
        self.descriptor
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let (_, slope) = self.line(0.0);
        Collision {
            approach_velocity,
            effective_mass,
            constants: [slope, self.friction, 1.0, 0.0],
        }
    }
    fn force(&self, _: &Collision, _: &Memory, phase: Phase, delta: f64, _: f64) -> Force {
        let Some(dry) = self.dry(phase) else {
            return Force::default();
        };
        let (spring, slope) = self.spring(delta);
        Force {
            value: spring * dry,
            by_penetration: slope * dry,
            by_velocity: 0.0,
        }
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        self.work(delta.max(0.0))
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        transitions(phase)
    }
    fn stick_range(&self, _: &Collision, _: &Memory, delta: f64) -> (f64, f64) {
        let (spring, _) = self.spring(delta);
        (
            spring * (1.0 - self.friction),
            spring * (1.0 + self.friction),
        )
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let d = self.friction;
        let energy = 0.5 * effective_mass * approach_velocity * approach_velocity;
        let peak = self.penetration(energy / (1.0 + d));
        Some(ClosedForm {
            restitution: ((1.0 - d).max(0.0) / (1.0 + d)).sqrt(),
            peak_penetration: Some(peak),
            peak_force: Some(self.spring(peak).0 * (1.0 + d)),
            duration: None,
        })
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
