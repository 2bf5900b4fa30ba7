//! Dissipation of steady cycles over their amplitude.

use pounding_case::Dimension;
use pounding_catalogue::numbers::significant;
use pounding_hysteresis::laboratory::{
    Cycling, Specimen, checked_dissipation_curve, local_slope, log_slope,
};
use serde::Serialize;

use super::motion::period;
use crate::arguments::{HysteresisArguments, positive};
use crate::failure::Failure;
use crate::tables::new_table;

/// Pairs of amplitude (m) and energy of a cycle (J).
pub struct DissipationCurve {
    /// The pairs, amplitudes growing.
    pub pairs: Vec<(f64, f64)>,
    /// Period of the cycles (s) where it matters.
    period: Option<f64>,
}

/// The curve of the arguments, if they ask for one.
pub fn curve(
    specimen: &Specimen,
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
    let pairs = checked_dissipation_curve(specimen, &amplitudes, cycling)?;
    Ok(Some(DissipationCurve {
        pairs,
        period: specimen.descriptor.rate_dependent.then_some(cycling.period),
    }))
}

fn not_two() -> Failure {
    Failure::input(
        "--dissipation wants two amplitudes, the smaller first",
        Some("for example --dissipation \"0.1 mm,10 mm\"".to_owned()),
    )
}

impl DissipationCurve {
    /// Log-log slope of the whole curve.
    pub fn slope(&self) -> Option<f64> {
        log_slope(&self.pairs)
    }

    /// The curve in a table, for people.
    pub fn text(&self) -> String {
        let mut table = new_table([
            "amplitude (mm)",
            "dissipated per cycle (J)",
            "log-log slope",
        ]);
        let dash = || "-".to_owned();
        let shown = |slope: Option<f64>| slope.map_or_else(dash, |s| format!("{s:.4}"));
        for (i, (amplitude, energy)) in self.pairs.iter().enumerate() {
            table.add_row([
                significant(1.0e3 * amplitude),
                significant(*energy),
                shown(local_slope(&self.pairs, i)),
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
    pub fn shown(&self) -> ShownCurve<'_> {
        ShownCurve {
            columns: ["amplitude", "dissipated"],
            curve: &self.pairs,
            log_log_slope: self.slope(),
            period: self.period,
        }
    }
}

/// A dissipation curve for machines.
#[derive(Serialize)]
pub struct ShownCurve<'c> {
    columns: [&'static str; 2],
    curve: &'c [(f64, f64)],
    log_log_slope: Option<f64>,
    period: Option<f64>,
}
