//! What `pounding floor-spectrum` says: in words and tables, and in columns for programs.

use pounding_ground_motion::spectra::ResponseSpectrum;
use pounding_report::pictures::motion::percent;
use pounding_study::floor_spectra::{FloorPeaks, FloorSpectra, FloorWithSpectra, SpectraOfFloor};

use crate::failure::Failure;
use crate::output::comma_separated;
use crate::tables::{G, new_long_table};

/// Spectra in which the two differ by less are equal (-).
const EQUAL: f64 = 1.0e-9;

/// Its place in words.
pub fn title(floor: &FloorWithSpectra) -> String {
    place(
        &floor.building,
        (floor.storey, floor.is_roof),
        floor.elevation,
    )
}

/// That of the floor above a storey, which may be the roof, at an elevation (m).
pub(super) fn place(building: &str, (storey, is_roof): (usize, bool), elevation: f64) -> String {
    let storey = match is_roof {
        true => "roof".to_owned(),
        false => format!("floor above storey {storey}"),
    };
    format!("{building}, {storey} at {elevation} m")
}

/// One where both are zero, as on a floor that nothing moves.
fn ratio(with: f64, alone: f64) -> f64 {
    if with == alone { 1.0 } else { with / alone }
}

/// Where pounding raises accelerations (m/s2) of these periods (s) most, in words; `it` is what it raises.
pub(super) fn most_raised(
    it: &str,
    periods: &[f64],
    (with, alone): (&[f64], &[f64]),
) -> Option<String> {
    let ratios: Vec<f64> = with.iter().zip(alone).map(|(w, a)| ratio(*w, *a)).collect();
    let differs = |ratio: &f64| (ratio - 1.0).abs() > EQUAL;
    if !ratios.iter().any(differs) {
        return Some("pounding changes none of its peaks".to_owned());
    }
    let most = (0..ratios.len()).max_by(|a, b| ratios[*a].total_cmp(&ratios[*b]))?;
    let ratio = ratios[most];
    if ratio.is_infinite() {
        return Some("the building alone does not move".to_owned());
    }
    let accelerations = format!(
        "from {} g to {} g, at a period of {} s",
        figures(alone[most] / G),
        figures(with[most] / G),
        figures(periods[most])
    );
    Some(match ratio > 1.0 {
        true => format!(
            "pounding raises {it} up to {} times, {accelerations}",
            figures(ratio)
        ),
        false => format!("pounding lowers {it} at all periods, least {accelerations}"),
    })
}

/// That of a floor, where there is something to compare with.
fn most_raised_of(spectra: &SpectraOfFloor) -> Option<String> {
    let alone = spectra.alone.as_ref()?;
    let with = &spectra.pounding;
    let accelerations = (&with.acceleration[..], &alone.acceleration[..]);
    most_raised("it", &with.periods, accelerations)
}

/// The answer first, then a table for each floor and damping ratio.
pub fn text(answer: &FloorSpectra, case: &str) -> String {
    let mut text = heading(case);
    for floor in &answer.floors {
        for spectra in &floor.spectra {
            let damping = percent(spectra.pounding.damping);
            text.push_str(&format!("\n{}, {damping}", title(floor)));
            if let Some(said) = most_raised_of(spectra) {
                text.push_str(&format!(": {said}"));
            }
        }
        let FloorPeaks { pounding, alone } = floor.peak_acceleration;
        let pounding = figures(pounding / G);
        text.push_str(&match alone {
            Some(alone) => format!(
                "\nPeak acceleration of the floor: {pounding} g, alone {} g\n",
                figures(alone / G)
            ),
            None => format!("\nPeak acceleration of the floor: {pounding} g\n"),
        });
        for spectra in &floor.spectra {
            text.push_str(&table(spectra));
        }
    }
    text.push_str(&warned(&answer.warnings));
    text
}

/// Title of the case, and what follows.
pub(super) fn heading(case: &str) -> String {
    let title = match case {
        "" => String::new(),
        case => format!("{case}\n"),
    };
    format!(
        "{title}Floor response spectra: peak absolute accelerations of equipment on the floors, by its period\n"
    )
}

/// What the user should know, below the answer.
pub(super) fn warned(warnings: &[String]) -> String {
    let lines = warnings
        .iter()
        .map(|warning| format!("\nwarning: {warning}"));
    let mut text: String = lines.collect();
    if !text.is_empty() {
        text.push('\n');
    }
    text
}

/// A row for each floor, damping ratio and period.
pub fn csv(answer: &FloorSpectra) -> Result<String, Failure> {
    let rows = answer.floors.iter().flat_map(|floor| {
        let spectra = floor.spectra.iter();
        spectra.flat_map(move |spectra| {
            let places = 0..spectra.pounding.periods.len();
            places.map(move |i| {
                let of = |s: &ResponseSpectrum| (s.acceleration[i], s.pseudo_acceleration[i]);
                let alone = spectra.alone.as_ref().map(of).unzip();
                let place = (&floor.building, floor.storey, floor.elevation);
                let oscillator = (spectra.pounding.damping, spectra.pounding.periods[i]);
                (
                    place,
                    oscillator,
                    of(&spectra.ground),
                    alone,
                    of(&spectra.pounding),
                )
            })
        })
    });
    comma_separated(&COLUMNS, rows)
}

/// Of the table for programs.
const COLUMNS: [&str; 11] = [
    "building",
    "storey",
    "elevation_m",
    "damping_ratio",
    "period_s",
    "ground_sa_m_s2",
    "ground_psa_m_s2",
    "alone_sa_m_s2",
    "alone_psa_m_s2",
    "pounding_sa_m_s2",
    "pounding_psa_m_s2",
];

fn table(spectra: &SpectraOfFloor) -> String {
    let mut header = vec!["period (s)", "ground (g)"];
    if spectra.alone.is_some() {
        header.push("alone (g)");
    }
    header.push("with pounding (g)");
    if spectra.alone.is_some() {
        header.push("ratio");
    }
    let mut table = new_long_table(header);
    for (i, period) in spectra.pounding.periods.iter().enumerate() {
        let with = spectra.pounding.acceleration[i];
        let mut row = vec![
            figures(*period),
            figures(spectra.ground.acceleration[i] / G),
        ];
        let alone = spectra.alone.as_ref().map(|s| s.acceleration[i]);
        row.extend(alone.map(|alone| figures(alone / G)));
        row.push(figures(with / G));
        row.extend(alone.map(|alone| shown_ratio(with, alone)));
        table.add_row(row);
    }
    format!("\n{}\n{table}\n", percent(spectra.pounding.damping))
}

/// A ratio in a table.
pub(super) fn shown_ratio(with: f64, alone: f64) -> String {
    match ratio(with, alone) {
        ratio if ratio.is_finite() => format!("{ratio:.3}"),
        _ => "-".to_owned(),
    }
}

/// Four significant figures.
pub(super) fn figures(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() {
        return format!("{x}");
    }
    if !(1e-3..1e4).contains(&size) {
        return format!("{x:.3e}");
    }
    let decimals = (3.0 - size.log10().floor()).max(0.0) as usize;
    format!("{x:.decimals$}")
}
