//! Runs that ended as gravity overturned a building: an answer, and no failure.

use pounding_assembly::AssemblyError;
use pounding_time_history::TimeHistoryError;

use super::error::CheckError;
use super::records::CaseUnderRecord;

/// A record under which a building collapses without contact: it has no demand, and no gap is wide
/// enough for it.
#[derive(Debug, Clone, PartialEq)]
pub struct CollapsedRecord {
    /// Number of the record among those that were given, from zero.
    pub number: usize,
    /// Name.
    pub name: String,
    /// What the recorded values were multiplied by (-).
    pub factor: f64,
    /// Peak ground acceleration as used (m/s2).
    pub peak_ground_acceleration: f64,
    /// The building.
    pub building: String,
    /// When it collapsed (s).
    pub time: f64,
    /// All of it in words.
    pub diagnosis: String,
}

impl CollapsedRecord {
    /// What kept a record from a demand, if it is a collapse.
    pub(super) fn of(
        (number, record): (usize, &CaseUnderRecord),
        error: &CheckError,
    ) -> Option<Self> {
        let CheckError::Record { source, .. } = error else {
            return None;
        };
        let AssemblyError::System(collapse @ TimeHistoryError::Collapse { time, building, .. }) =
            &**source
        else {
            return None;
        };
        Some(Self {
            number,
            name: record.name.clone(),
            factor: record.assembly.accelerogram.scale(),
            peak_ground_acceleration: record.assembly.accelerogram.peak().value.abs(),
            building: building.clone(),
            time: *time,
            diagnosis: collapse.to_string(),
        })
    }
}

/// What stands between the building and the time in the message of a collapse.
const COLLAPSED: &str = " collapsed at t = ";

/// The building that collapsed in a run with this diagnosis; `None` if the run failed. Runs that
/// several processes share are stored with the words of their diagnosis.
#[must_use]
pub fn collapsed_building(diagnosis: &str) -> Option<&str> {
    diagnosis
        .split_once(COLLAPSED)
        .map(|(building, _)| building)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_of_a_collapse_names_the_building() {
        let collapse = TimeHistoryError::Collapse {
            time: 7.25,
            building: "light frame".to_owned(),
            storey: 1,
            height: 3.0,
        };
        let message = collapse.to_string();
        assert_eq!(collapsed_building(&message), Some("light frame"));
        let failure = TimeHistoryError::ContactTooShort {
            gap: "light-heavy".to_owned(),
        };
        assert_eq!(collapsed_building(&failure.to_string()), None);
    }
}
