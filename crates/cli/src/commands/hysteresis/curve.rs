//! Dissipation of steady cycles over their amplitude.

use crate::tables::Table;
use comfy_table::CellAlignment;
use pounding_case::Dimension;
use pounding_hysteresis::laboratory::{Cycling, dissipation_curve};
use serde_json::{Value, json};

use super::bounds;
use super::chosen::Chosen;
use super::motion::period;
use crate::arguments::HysteresisArguments;
use crate::commands::impact::numbers::significant;
use crate::commands::impact::setting::positive;
use crate::failure::Failure;

/// Pairs of amplitude (m) and energy of a cycle (J).
pub struct DissipationCurve {
    /// The pairs, amplitudes growing.
    pub pairs: Vec<(f64, f64)>,
    /// Period of the cycles (s) where it matters.
    period: Option<f64>,
}

/// The curve of the arguments, if they ask for one.
pub fn curve(
    chosen: &Chosen,
    arguments: &HysteresisArguments,
) -> Result<Option<DissipationCurve>, Failure> {
    if arguments.dissipation.is_empty() {
        return Ok(None);
    }
    let ends = arguments
        .dissipation
        .iter()
        .map(|text| positive(text.trim(), "dissipation", Dimension::LENGTH))
        .collect::<Result<Vec<f64>, Failure>>()?;
    let [from, to] = ends[..] else {
        return Err(not_two());
    };
    if !(from < to) {
        return Err(not_two());
    }
    let last = f64::from(arguments.points - 1);
    let amplitudes: Vec<f64> = (0..arguments.points)
        .map(|i| from * (to / from).powf(f64::from(i) / last))
        .collect();
    let cycling = Cycling {
        steps: 2 * arguments.steps as usize,
        cycles_before: 1,
        period: period(arguments)?,
    };
    // To the first peak, then full cycles.
    let lengths = 1.0 + 4.0 * (cycling.cycles_before + 1) as f64;
    bounds::reachable(chosen, lengths * amplitudes.iter().sum::<f64>())?;
    let pairs = dissipation_curve(chosen.law.as_ref(), &amplitudes, cycling);
    bounds::finite_pairs(&pairs)?;
    Ok(Some(DissipationCurve {
        pairs,
        period: chosen.descriptor.rate_dependent.then_some(cycling.period),
    }))
}

fn not_two() -> Failure {
    Failure::input(
        "--dissipation wants two amplitudes, the smaller first",
        Some("for example --dissipation \"0.1 mm,10 mm\"".to_owned()),
    )
}

/// Slope of the straight line through the logarithms of the pairs that dissipate, by
/// least squares; `None` for fewer than two.
pub fn log_slope(pairs: &[(f64, f64)]) -> Option<f64> {
    let logarithms: Vec<(f64, f64)> = pairs
        .iter()
        .filter(|(_, energy)| *energy > 0.0)
        .map(|(amplitude, energy)| (amplitude.ln(), energy.ln()))
        .collect();
    let count = logarithms.len() as f64;
    let mean = |pick: fn(&(f64, f64)) -> f64| logarithms.iter().map(pick).sum::<f64>() / count;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let along: f64 = logarithms.iter().map(|p| (p.0 - x).powi(2)).sum();
    let across: f64 = logarithms.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    (logarithms.len() > 1).then_some(across / along)
}

impl DissipationCurve {
    /// Log-log slope of the whole curve.
    pub fn slope(&self) -> Option<f64> {
        log_slope(&self.pairs)
    }

    /// The curve in a table, for people.
    pub fn text(&self) -> String {
        let mut table = Table::new();
        table.set_header([
            "amplitude (mm)",
            "dissipated per cycle (J)",
            "log-log slope",
        ]);
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        let dash = || "-".to_owned();
        let shown = |slope: Option<f64>| slope.map_or_else(dash, |s| format!("{s:.4}"));
        for (i, (amplitude, energy)) in self.pairs.iter().enumerate() {
            // From the amplitude before to the one after.
            let near = &self.pairs[i.saturating_sub(1)..(i + 2).min(self.pairs.len())];
            let slope = match near.iter().all(|(_, energy)| *energy > 0.0) {
                true => log_slope(near),
                false => None,
            };
            table.add_row([
                significant(1.0e3 * amplitude),
                significant(*energy),
                shown(slope),
            ]);
        }
        let how = self.period.map_or_else(String::new, |period| {
            format!(", harmonic, {} s each", significant(period))
        });
        format!(
            "\nSteady cycles{how}\n{table}\nslope of all by least squares: {}\n",
            shown(self.slope())
        )
    }

    /// For machines, SI.
    pub fn json(&self) -> Value {
        let pairs: Vec<_> = self.pairs.iter().map(|(a, d)| json!([a, d])).collect();
        json!({
            "columns": ["amplitude", "dissipated"], "curve": pairs,
            "log_log_slope": self.slope(), "period": self.period,
        })
    }
}
