//! What the reader of a case file refuses of gaps, asked of a case that code has changed since.

use super::levels::row_problem;
use crate::error::CaseError;
use crate::types::{Case, Gap};

impl Case {
    /// Refuses gaps that no case file may have: between sides that are no neighbours, a second one between the same two, one without levels, and a level
    /// that is given twice, which would act twice.
    ///
    /// # Errors
    /// The first of them, at the gap or level as it stood in the text.
    pub fn check_gaps(&self) -> Result<(), CaseError> {
        let Some(last) = self.buildings.len().checked_sub(1) else {
            return Ok(());
        };
        for (place, gap) in self.gaps.iter().enumerate() {
            let refused = |message: &str, help: &str| {
                let message = format!("gap {}: {message}", gap.name);
                Err(self.error(gap.model.span.clone(), message, Some(help.to_owned())))
            };
            let [left, right] = gap.between;
            if let Some((message, _)) = row_problem(left, right, last) {
                return refused(message, "correct `between`");
            }
            let same = |other: &&Gap| other.between == gap.between;
            if let Some(first) = self.gaps[..place].iter().find(same) {
                let message = format!("gap {} is between the same two", first.name);
                return refused(&message, "give one of them all `levels`");
            }
            if gap.levels.is_empty() {
                return refused("`levels` is empty", "name at least one pair of storeys");
            }
            for (number, level) in gap.levels.iter().enumerate() {
                let before = &gap.levels[..number];
                if before
                    .iter()
                    .any(|l| (l.left, l.right) == (level.left, level.right))
                {
                    let message = format!("gap {}: this level is given twice", gap.name);
                    return Err(self.error(
                        level.place.clone(),
                        message,
                        Some("remove one".to_owned()),
                    ));
                }
            }
        }
        Ok(())
    }
}
