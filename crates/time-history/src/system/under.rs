//! The same buildings under another motion.

use std::sync::Arc;

use super::{GroundAcceleration, Motions, System};

impl System {
    /// The same buildings and gaps under another ground motion, which takes the place of the
    /// first one wherever and whenever this moves the ground; other motions stay. With the same
    /// time step, what depends on the buildings alone stays shared with this system.
    #[must_use]
    pub fn under(&self, ground: GroundAcceleration) -> Self {
        // Constants of contact-free motion belong to one time step.
        let same_step = ground.time_step == self.ground.time_step;
        Self {
            contact_free: if same_step {
                Arc::clone(&self.contact_free)
            } else {
                Arc::default()
            },
            loads: Arc::default(),
            motions: (self.motions.as_ref()).map(|m| Arc::new(m.with_first(&self.ground, &ground))),
            propagation: match same_step && self.motions.is_none() {
                true => Arc::clone(&self.propagation),
                false => Arc::default(),
            },
            ground,
            ..self.clone()
        }
    }

    /// Whether something beside the first ground motion, sooner or later, moves the ground.
    #[must_use]
    pub fn has_further_records(&self) -> bool {
        let motions = self.ground_motions().iter();
        let mut others = motions.filter(|m| !m.is_of(&self.ground));
        others.next().is_some()
    }

    /// The same with all ground motions scaled that are not the first one, sooner or later: by the
    /// factor `along`, those across the row by `across`.
    #[must_use]
    pub fn with_further_records_scaled(&self, along: f64, across: f64) -> Self {
        let factors = [along, across];
        let scaled = |m: &Arc<Motions>| Arc::new(m.with_others_scaled(&self.ground, factors));
        Self {
            motions: self.motions.as_ref().map(scaled),
            ..self.clone()
        }
    }
}
