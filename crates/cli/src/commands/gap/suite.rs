//! The records of a gap check, one by one and together.

use pounding_catalogue::numbers::{rounded_up, rounded_up_beside, six_digits};
use pounding_study::gap_check::GapCheck;

use crate::tables::{G, decimal, new_table};

/// More records than this are listed on demand only.
const LISTED: usize = 20;

/// How near the mean spectrum of the records comes to the target of the case's scale, if it has
/// one.
pub fn target(check: &GapCheck) -> String {
    let Some(target) = &check.spectra.target else {
        return String::new();
    };
    let (ratio, period) = target.least;
    let (most, at) = target.greatest;
    let reason = match target.band_reason.as_str() {
        "" => String::new(),
        reason => format!(" ({reason})"),
    };
    let times = match target.times {
        1.0 => String::new(),
        times => format!(" and times {}", six_digits(times)),
    };
    format!(
        "  records are scaled to {} from {} to {} s{reason}, by least squares of the logarithm{times}: their mean spectrum is {ratio:.2} (at {period:.2} s) to {most:.2} (at {at:.2} s) of it\n",
        target.name,
        six_digits(target.band.0),
        six_digits(target.band.1)
    )
}

/// Statistics of the demand, and the demand of each record with factor, peak ground acceleration
/// and time; nothing of a single record.
pub fn suite(check: &GapCheck, index: usize, all: bool) -> String {
    let gap = &check.gaps[index];
    if check.records.len() < 2 {
        return String::new();
    }
    let s = gap.suite;
    let mm = |x: f64| format!("{:.1}", x * 1e3);
    let mut text = format!(
        "\nGap {}: demand of {} records: mean {} mm, median {}, fractiles 16 % {} and 84 % {}, maximum {}, standard deviation {}\n",
        gap.name,
        check.records.len(),
        mm(s.mean),
        mm(s.median),
        mm(s.p16),
        mm(s.p84),
        rounded_up(s.maximum * 1e3, 1),
        mm(s.standard_deviation),
    );
    if check.records.len() > LISTED && !all {
        text.push_str("  --all lists the records\n");
        return text;
    }
    let mut table = new_table([
        "record",
        "factor",
        "PGA (g)",
        "demand (mm)",
        "level",
        "time (s)",
        "closes",
    ]);
    for (r, record) in check.records.iter().enumerate() {
        // Of equals the lowest level.
        let levels = record.demand[index].iter().enumerate().rev();
        let Some((level, peak)) = levels.max_by(|a, b| a.1.value.total_cmp(&b.1.value)) else {
            continue;
        };
        let mut levels = gap.levels.iter().enumerate();
        let closes = levels.any(|(l, level)| record.demand_exceeds(index, l, level.width));
        table.add_row([
            record.name.clone(),
            decimal(record.factor, 4),
            format!("{:.3}", record.peak_ground_acceleration / G),
            rounded_up_beside(gap.demand[r] * 1e3, gap.levels[level].width * 1e3, 2),
            gap.levels[level].place.label(),
            format!("{:.3}", peak.time),
            if closes || record.closed(index) {
                "yes"
            } else {
                "no"
            }
            .to_owned(),
        ]);
    }
    text.push_str(&format!("{table}\n"));
    text
}
