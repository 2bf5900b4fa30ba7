//! Runs that ended as gravity overturned a building: an answer, and no failure.

use std::borrow::Cow;

use pounding_assembly::AssemblyError;
use pounding_time_history::TimeHistoryError;
use serde::Serialize;

use super::demand::{RecordDemand, by_record};
use super::error::CheckError;
use super::parallel::Progress;
use super::records::CaseUnderRecord;

/// A record under which a building collapses without contact: it has no demand, and no gap is wide
/// enough for it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CollapsedRecord {
    /// Number of the record among those that were given, from zero.
    #[serde(skip)]
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

/// The records that have a demand, and those under which a building collapses without contact.
///
/// # Errors
/// As [`super::demands`], and where no record has a demand.
pub(crate) fn stand_or_collapse(
    records: &[CaseUnderRecord],
    threads: usize,
    progress: Progress<'_>,
) -> Result<(Vec<RecordDemand>, Vec<CollapsedRecord>), CheckError> {
    let (mut standing, mut collapsed, mut first) = (Vec::new(), Vec::new(), None);
    let results = by_record(records, threads, progress)?;
    for (record, result) in records.iter().enumerate().zip(results) {
        match result {
            Ok(demand) => standing.push(demand),
            Err(error) => {
                let Some(found) = CollapsedRecord::of(record, &error) else {
                    return Err(error);
                };
                collapsed.push(found);
                first = first.or(Some(error));
            }
        }
    }
    match first {
        Some(CheckError::Record { record, source }) if standing.is_empty() && records.len() > 1 => {
            Err(CheckError::AllCollapse {
                records: records.len(),
                record,
                source,
            })
        }
        Some(error) if standing.is_empty() => Err(error),
        _ => Ok((standing, collapsed)),
    }
}

/// The records that have a demand.
pub(crate) fn without_collapsed<'r>(
    records: &'r [CaseUnderRecord],
    collapsed: &[CollapsedRecord],
) -> Cow<'r, [CaseUnderRecord]> {
    if collapsed.is_empty() {
        return Cow::Borrowed(records);
    }
    let stands = |number: &usize| !collapsed.iter().any(|c| c.number == *number);
    let standing = (0..records.len()).filter(stands);
    standing.map(|number| records[number].clone()).collect()
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
