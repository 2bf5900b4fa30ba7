//! What the user should know of a case under records.

use std::collections::BTreeSet;
use std::mem::discriminant;
use std::path::Path;

use pounding_case::{Building, Case};
use pounding_catalogue::wording::agreeing;
use pounding_ground_motion::Accelerogram;
use pounding_time_history::Warning;

use super::demand::RecordDemand;
use super::records::CaseUnderRecord;

/// What the user should know of a case under records: of its buildings and gaps, then of the
/// records, one by one.
pub(crate) fn warnings(case: &Case, records: &[CaseUnderRecord]) -> Vec<String> {
    let Some(first) = records.first() else {
        return Vec::new();
    };
    let structure = Warning::of_structure(&first.assembly.system);
    let read = records.iter().map(|record| {
        let said = said_in_reading(&record.assembly.accelerogram);
        (record.name.as_str(), said)
    });
    let excitation = records.iter().flat_map(|record| {
        let assembly = &record.assembly;
        let found = Warning::of_excitation(&assembly.system, &assembly.options);
        found.into_iter().map(|w| (record.name.as_str(), w))
    });
    let mut told = first.assembly.warnings_of_buildings();
    told.extend(structure.iter().map(ToString::to_string));
    told.extend(of_reading(read));
    told.extend(of_each_record(excitation));
    told.extend(beside_that_across(case, records));
    let own = case.resolve(&case.ground_motion.file.value);
    let others = records.iter().filter(|r| r.file != own).count();
    told.extend(on_grounds_of_their_own(case, others));
    told
}

/// What was said when a record was read.
pub(crate) fn said_in_reading(record: &Accelerogram) -> Vec<String> {
    match record.origin() {
        Some(origin) => origin.warnings.clone(),
        // A motion that comes from no file was held against nothing.
        None => record.unusual_time_step().into_iter().collect(),
    }
}

/// What was said when records were read, by their names: the first of each kind, with how many
/// are like it.
pub(crate) fn of_reading<'r>(records: impl Iterator<Item = (&'r str, Vec<String>)>) -> Vec<String> {
    let mut kinds: Vec<(String, String, BTreeSet<&str>)> = Vec::new();
    for (name, said) in records {
        for text in said {
            let kind = text.replace(|c: char| c.is_ascii_digit() || "+-.".contains(c), "");
            match kinds.iter_mut().find(|known| known.0 == kind) {
                Some((_, _, others)) => drop(others.insert(name)),
                None => kinds.push((kind, format!("{name}: {text}"), BTreeSet::from([name]))),
            }
        }
    }
    let told = kinds.into_iter();
    told.map(|(_, text, of)| and_more(text, of.len() - 1))
        .collect()
}

/// A text on one record, and how many more it is true of.
fn and_more(text: String, more: usize) -> String {
    match more {
        0 => text,
        1 => format!("{text}; one more of the records is like it"),
        _ => format!("{text}; {more} more of the records are like it"),
    }
}

/// Warnings of one kind about records by their names: the first record of each kind, with how many are like it.
pub(crate) fn of_each_record<'r>(found: impl Iterator<Item = (&'r str, Warning)>) -> Vec<String> {
    let mut kinds: Vec<(&str, Warning, BTreeSet<&str>)> = Vec::new();
    for (name, warning) in found {
        let known = kinds
            .iter_mut()
            .find(|known| discriminant(&known.1) == discriminant(&warning));
        match known {
            Some((_, _, of)) => drop(of.insert(name)),
            None => kinds.push((name, warning, BTreeSet::from([name]))),
        }
    }
    let told = kinds.into_iter();
    told.map(|(name, warning, of)| and_more(format!("{name}: {warning}"), of.len() - 1))
        .collect()
}

/// What the user should know of records at whose end a gap would have to be widest: the buildings go on.
pub(crate) fn greatest_at_the_end(
    records: &[CaseUnderRecord],
    demands: &[RecordDemand],
) -> Option<String> {
    let ends = |demand: &&RecordDemand| {
        let of = records.iter().find(|record| record.name == demand.name);
        let end = of.map(|record| {
            let assembly = &record.assembly;
            let whole = assembly.system.record_duration();
            assembly.options.duration.unwrap_or(whole)
        });
        let mut gaps = demand.demand.iter().map(|levels| {
            let greatest = levels.iter().max_by(|a, b| a.value.total_cmp(&b.value));
            greatest.map(|peak| (peak.value, peak.time))
        });
        gaps.any(|peak| match (peak, end) {
            (Some((value, time)), Some(end)) => value > 0.0 && time >= end * (1.0 - 1.0e-9),
            _ => false,
        })
    };
    let mut named = demands.iter().filter(ends).map(|d| d.name.as_str());
    let first = named.next()?;
    Some(and_more(
        format!(
            "{first}: a demand is greatest at the last instant, and may grow on: let the run go on after the record by `process = [{{ pad = {{ after = \"10 s\" }} }}]`, or by `duration` in [analysis] for the record of the case"
        ),
        named.count(),
    ))
}

/// What the user should know of records that stand beside the record across the row that the case
/// names, which its own record alone belongs to.
fn beside_that_across(case: &Case, records: &[CaseUnderRecord]) -> Option<String> {
    let across = &case.ground_motion.across.as_ref()?.value.file.value;
    let own = case.resolve(&case.ground_motion.file.value);
    let named: Vec<&str> = (records.iter().filter(|r| r.file != own))
        .map(|r| r.name.as_str())
        .collect();
    let remedy = "records of a study have their own";
    across_of_another(&named, records.len(), (across, remedy))
}

/// What the user should know of buildings that have a record of their own, which they keep under so many
/// other records than that of the case.
pub(crate) fn on_grounds_of_their_own(case: &Case, records: usize) -> Option<String> {
    let has_own = |b: &&Building| b.ground.as_ref().is_some_and(|g| g.value.motion.is_some());
    let names = case.buildings.iter().filter(has_own);
    let names: Vec<String> = names.map(|b| format!("\"{}\"", b.name.value)).collect();
    if records == 0 || names.is_empty() {
        return None;
    }
    Some(format!(
        "{} {} under the record of {} own in `ground` while {} the place of that of the case: neighbours move with different earthquakes; leave `file` out of `ground`, or give a `delay` there",
        names.join(", "),
        agreeing(&names.len(), "stays", "stay"),
        agreeing(&names.len(), "its", "their"),
        match records {
            1 => "another record takes".to_owned(),
            some => format!("{some} records take"),
        },
    ))
}

/// The warning of these of so many records.
pub(crate) fn across_of_another(
    named: &[&str],
    of: usize,
    (across, remedy): (&Path, &str),
) -> Option<String> {
    let which = match named {
        [] => return None,
        [one] => format!("record {one}"),
        _ if named.len() == of => format!("all {of} records"),
        some => format!("{} of {of} records", some.len()),
    };
    Some(format!(
        "{which} along the row with the record across it of the case, {}: components of different earthquakes are no motion of one; {remedy}, such as {{ file = \"ns.csv\", across = {{ file = \"ew.csv\" }} }}",
        across.display()
    ))
}
