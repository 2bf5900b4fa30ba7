//! Observers of steps that are taken in the coordinates of the modes.

use crate::dense_output::{ModalStep, Workspace};
use crate::error::TimeHistoryError;
use crate::recorder::{Recorder, StepView, wants};
use crate::system::{CLOSE, System};

/// What observers of a run need beside the step: space, and who they are.
pub(crate) struct Observers<'a, 'b> {
    pub recorders: &'a mut [&'b mut dyn Recorder],
    /// Large, and left out where there is nobody: parts of a row are followed for nobody.
    workspace: Option<Box<Workspace>>,
    /// Whether each wants the step that they were asked about last.
    wanted: Vec<bool>,
    /// End of the run (s).
    end: f64,
}

impl<'a, 'b> Observers<'a, 'b> {
    /// Of a run up to `end` (s).
    pub(crate) fn new(
        system: &System,
        recorders: &'a mut [&'b mut dyn Recorder],
        end: f64,
    ) -> Self {
        Self {
            workspace: (!recorders.is_empty()).then(|| Box::new(Workspace::new(system))),
            wanted: vec![false; recorders.len()],
            recorders,
            end,
        }
    }

    /// Whether there is nobody to serve.
    pub(crate) fn is_empty(&self) -> bool {
        self.recorders.is_empty()
    }

    /// Whether anybody wants to see a time before this one (s).
    pub(crate) fn want_before(&self, end: f64) -> bool {
        let end = end * (1.0 - CLOSE);
        self.recorders.iter().any(|r| r.next_time() < end)
    }

    /// Asks all, once, whether they want a step that ends at this time (s). Returns whether one
    /// does.
    pub(crate) fn ask(&mut self, end: f64) -> bool {
        let last = self.is_last(end * (1.0 + CLOSE));
        for (wanted, recorder) in self.wanted.iter_mut().zip(&*self.recorders) {
            *wanted = wants(&**recorder, end, last);
        }
        self.wanted.contains(&true)
    }

    /// Whether the run ends at this time (s).
    fn is_last(&self, end: f64) -> bool {
        end >= self.end * (1.0 - 1.0e-12)
    }

    /// Shows a step to all that want it.
    pub(crate) fn show(&mut self, step: &ModalStep<'_>) -> Result<(), TimeHistoryError> {
        match self.ask(step.start + step.length) {
            true => self.show_wanted(step),
            false => Ok(()),
        }
    }

    /// Shows a step to those that wanted it when they were asked.
    pub(crate) fn show_wanted(&mut self, step: &ModalStep<'_>) -> Result<(), TimeHistoryError> {
        let last = self.is_last(step.end());
        if let Some(workspace) = &mut self.workspace {
            for (recorder, wanted) in self.recorders.iter_mut().zip(&self.wanted) {
                if *wanted {
                    recorder.step(&mut StepView::of_modes(step, workspace, last))?;
                }
            }
        }
        Ok(())
    }
}
