//! What `pounding floor-spectrum` says: in words and tables, and in columns for programs.

use pounding_ground_motion::spectra::ResponseSpectrum;
use pounding_report::pictures::motion::percent;
use serde::Serialize;

use crate::failure::Failure;
use crate::output::comma_separated;
use crate::tables::{G, new_long_table};

/// Spectra in which the two differ by less are equal (-).
const EQUAL: f64 = 1.0e-9;

/// Peak absolute acceleration of a floor (m/s2), with pounding and of the building alone.
#[derive(Debug, Serialize)]
pub struct Peaks {
    pub pounding: f64,
    pub alone: Option<f64>,
}

/// Spectra of one damping ratio.
#[derive(Debug, Serialize)]
pub struct Spectra {
    pub ground: ResponseSpectrum,
    pub pounding: ResponseSpectrum,
    /// Of the building without gaps and links, if it stands by itself.
    pub alone: Option<ResponseSpectrum>,
}

/// What equipment on a floor feels.
#[derive(Debug, Serialize)]
pub struct Floor {
    pub building: String,
    /// From 1 at the bottom.
    pub storey: usize,
    pub is_roof: bool,
    /// Above the ground (m).
    pub elevation: f64,
    pub peak_acceleration: Peaks,
    /// By damping ratio.
    pub spectra: Vec<Spectra>,
}

/// What `--json` prints.
#[derive(Debug, Serialize)]
pub struct Answer {
    pub floors: Vec<Floor>,
    /// Impacts at all gaps.
    pub impacts: usize,
    /// Of the motions of the floors (s).
    pub time_step: f64,
    pub warnings: Vec<String>,
}

impl Floor {
    /// Its place in words.
    pub fn title(&self) -> String {
        let storey = match self.is_roof {
            true => "roof".to_owned(),
            false => format!("floor above storey {}", self.storey),
        };
        format!("{}, {storey} at {} m", self.building, self.elevation)
    }

    /// Where pounding raises the spectrum of the first damping ratio most, as numbers of a sentence.
    fn most_raised(&self) -> Option<String> {
        let spectra = self.spectra.first()?;
        let alone = spectra.alone.as_ref()?;
        let with = &spectra.pounding;
        let ratios = with.acceleration.iter().zip(&alone.acceleration);
        let ratios: Vec<f64> = ratios.map(|(with, alone)| with / alone).collect();
        let differs = |ratio: &f64| (ratio - 1.0).abs() > EQUAL;
        if !ratios.iter().any(differs) {
            return Some("pounding changes nothing on it".to_owned());
        }
        let most = (0..ratios.len()).max_by(|a, b| ratios[*a].total_cmp(&ratios[*b]))?;
        let (period, ratio) = (with.periods[most], ratios[most]);
        let accelerations = format!(
            "from {} g to {} g, at a period of {period:.3} s",
            figures(alone.acceleration[most] / G),
            figures(with.acceleration[most] / G)
        );
        Some(match ratio > 1.0 {
            true => format!(
                "pounding raises it up to {} times, {accelerations}",
                figures(ratio)
            ),
            false => format!("pounding lowers it at all periods, least {accelerations}"),
        })
    }
}

impl Answer {
    /// The answer first, then a table for each floor and damping ratio.
    pub fn text(&self, title: &str) -> String {
        let mut text = String::new();
        if !title.is_empty() {
            text.push_str(&format!("{title}\n"));
        }
        text.push_str("Floor response spectra: peak absolute accelerations of equipment on the floors, by its period\n");
        for floor in &self.floors {
            text.push_str(&format!("\n{}", floor.title()));
            if let Some(first) = floor.spectra.first() {
                text.push_str(&format!(", {}", percent(first.pounding.damping)));
            }
            if let Some(said) = floor.most_raised() {
                text.push_str(&format!(": {said}"));
            }
            let Peaks { pounding, alone } = floor.peak_acceleration;
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
        for warning in &self.warnings {
            text.push_str(&format!("\nwarning: {warning}"));
        }
        if !self.warnings.is_empty() {
            text.push('\n');
        }
        text
    }

    /// A row for each floor, damping ratio and period.
    pub fn csv(&self) -> Result<String, Failure> {
        let rows = self.floors.iter().flat_map(|floor| {
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

fn table(spectra: &Spectra) -> String {
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
            format!("{period:.4}"),
            figures(spectra.ground.acceleration[i] / G),
        ];
        let alone = spectra.alone.as_ref().map(|s| s.acceleration[i]);
        row.extend(alone.map(|alone| figures(alone / G)));
        row.push(figures(with / G));
        row.extend(alone.map(|alone| format!("{:.3}", with / alone)));
        table.add_row(row);
    }
    format!("\n{}\n{table}\n", percent(spectra.pounding.damping))
}

/// Four significant figures.
fn figures(x: f64) -> String {
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
