//! Runs that ended as gravity overturned a building: an answer, and no failure.

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
    use pounding_time_history::TimeHistoryError;

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
