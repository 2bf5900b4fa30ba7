//! The page of the file of an answer.

use super::{comparison, gap, motion};
use crate::answer_file::{Answered, AnsweredCommand};

impl Answered {
    /// The page.
    #[must_use]
    pub fn page(&self) -> String {
        let (answer, figures, inputs) = (&self.answer, &self.figures, &self.inputs);
        match self.command {
            AnsweredCommand::Gap => gap(answer, figures, inputs),
            AnsweredCommand::Compare => comparison(answer, figures, inputs),
            AnsweredCommand::MotionInfo => motion(answer, figures, inputs),
        }
    }
}
