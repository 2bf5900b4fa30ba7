//! What `pounding floor-spectrum` says of several records: in words and tables, and in columns for programs.

use pounding_catalogue::wording::counted;
use pounding_report::pictures::motion::percent;
use pounding_study::floor_spectra::{
    AccelerationsOverRecords, FloorOverRecords, FloorSpectraOverRecords, SpectraOverRecords,
};

use super::answer::{figures, heading, most_raised, place, shown_ratio, warned};
use crate::failure::Failure;
use crate::output::comma_separated;
use crate::tables::{G, new_long_table};

/// Its place in words.
pub fn title(floor: &FloorOverRecords) -> String {
    let storey = (floor.storey, floor.is_roof);
    place(&floor.building, storey, floor.elevation)
}

/// The answer first, then a table for each floor and damping ratio.
pub fn text(answer: &FloorSpectraOverRecords, case: &str) -> String {
    let mut text = heading(case);
    let count = counted(answer.records.len(), "record");
    text.push_str(&match answer.left_out.len() {
        0 => format!("over {count}\n"),
        // Of a building that collapses equipment feels more than any number.
        left_out => format!(
            "over {count} of {}; under the others a run has no end, and means and fractiles leave them out\n",
            answer.records.len() + left_out
        ),
    });
    for floor in &answer.floors {
        for spectra in &floor.spectra {
            text.push_str(&format!("\n{}, {}", title(floor), percent(spectra.damping)));
            let means = (&spectra.pounding.mean[..], &spectra.alone.mean[..]);
            if let Some(said) = most_raised("the mean", &spectra.periods, means) {
                text.push_str(&format!(": {said}"));
            }
        }
        text.push('\n');
        for spectra in &floor.spectra {
            text.push_str(&table(spectra));
        }
    }
    text.push_str(&warned(&answer.warnings));
    text
}

fn table(spectra: &SpectraOverRecords) -> String {
    let mut table = new_long_table(vec![
        "period (s)",
        "ground, mean (g)",
        "alone, mean (g)",
        "with pounding, mean (g)",
        "ratio of means",
        "alone, 84 % (g)",
        "with pounding, 84 % (g)",
    ]);
    let SpectraOverRecords {
        ground,
        alone,
        pounding,
        ..
    } = spectra;
    for (i, period) in spectra.periods.iter().enumerate() {
        table.add_row([
            figures(*period),
            figures(ground.mean[i] / G),
            figures(alone.mean[i] / G),
            figures(pounding.mean[i] / G),
            shown_ratio(pounding.mean[i], alone.mean[i]),
            figures(alone.p84[i] / G),
            figures(pounding.p84[i] / G),
        ]);
    }
    format!("\n{}\n{table}\n", percent(spectra.damping))
}

/// A row for each floor, damping ratio and period.
pub fn csv(answer: &FloorSpectraOverRecords) -> Result<String, Failure> {
    let rows = answer.floors.iter().flat_map(|floor| {
        let spectra = floor.spectra.iter();
        spectra.flat_map(move |spectra| {
            let places = 0..spectra.periods.len();
            places.map(move |i| {
                let of = |a: &AccelerationsOverRecords| (a.mean[i], a.p16[i], a.p50[i], a.p84[i]);
                (
                    (&floor.building, floor.storey, floor.elevation),
                    (spectra.damping, spectra.periods[i]),
                    of(&spectra.ground),
                    of(&spectra.alone),
                    of(&spectra.pounding),
                )
            })
        })
    });
    comma_separated(&COLUMNS, rows)
}

/// Of the table for programs: absolute accelerations.
const COLUMNS: [&str; 17] = [
    "building",
    "storey",
    "elevation_m",
    "damping_ratio",
    "period_s",
    "ground_mean_m_s2",
    "ground_p16_m_s2",
    "ground_p50_m_s2",
    "ground_p84_m_s2",
    "alone_mean_m_s2",
    "alone_p16_m_s2",
    "alone_p50_m_s2",
    "alone_p84_m_s2",
    "pounding_mean_m_s2",
    "pounding_p16_m_s2",
    "pounding_p50_m_s2",
    "pounding_p84_m_s2",
];
