//! How far floors come towards one another in a run.

use crate::error::TimeHistoryError;
use crate::history::History;
use crate::peak::Peak;
use crate::recorder::{Recorder, StepView};
use crate::system::{System, Terms};

/// Maximum approach of each pair of floors, left displacement minus right displacement
/// (m), with its time. The extremum is that of the method's own interpolant inside each
/// step: no output grid lies between the motion and the number. Never negative: floors
/// that never come closer than at rest have zero.
#[derive(Debug, Clone)]
pub struct RelativeDisplacement {
    /// Degrees of freedom of the left and the right floor, `None` is a rigid wall; and what the
    /// relative displacement holds beside them.
    pairs: Vec<(Option<usize>, Option<usize>, Terms)>,
    /// Displacements of all degrees of freedom at time zero (m).
    start: Vec<f64>,
    pub(crate) peaks: Vec<Peak>,
}

impl RelativeDisplacement {
    /// A recorder for the contact levels of a system. The system that is run may be
    /// another one with the same buildings, such as [`System::without_gaps`].
    #[must_use]
    pub fn of_levels(system: &System) -> Self {
        let levels = system.levels().iter();
        let pairs: Vec<_> = levels.map(|l| (l.left, l.right, l.terms.clone())).collect();
        Self {
            start: system.initial_state()[..system.degrees_of_freedom()].to_vec(),
            peaks: vec![Peak::default(); pairs.len()],
            pairs,
        }
    }

    /// Maximum approach so far, in the order of [`System::levels`].
    #[must_use]
    pub fn peaks(&self) -> &[Peak] {
        &self.peaks
    }
}

impl Recorder for RelativeDisplacement {
    fn begin(&mut self, system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        let (own, of_run) = (self.start.len(), system.degrees_of_freedom());
        if own != of_run {
            return Err(TimeHistoryError::Option {
                option: "degrees of freedom of the system whose relative displacements are recorded",
                value: own as f64,
                reason: "as many as the system that is run has: make the recorder of a system with the same buildings",
            });
        }
        let at = |floor: Option<usize>| floor.map_or(0.0, |i| self.start[i]);
        for ((left, right, terms), peak) in self.pairs.iter().zip(&mut self.peaks) {
            let further = terms.sum_of(|i| self.start[i]);
            peak.raise(at(*left) - at(*right) + further, 0.0);
        }
        Ok(())
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        for ((left, right, terms), peak) in self.pairs.iter().zip(&mut self.peaks) {
            if let Some((time, top)) = step.approach((*left, *right), terms, peak.value) {
                peak.raise(top, time);
            }
        }
        Ok(())
    }
}
