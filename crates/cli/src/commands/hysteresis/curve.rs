//! Dissipation of cycles over their amplitude, each the second one of a new element.

use pounding_case::Dimension;
use pounding_catalogue::numbers::significant;
use pounding_hysteresis::laboratory::{
    Cycling, Specimen, checked_dissipation_curve, local_slope, log_slope,
};
use serde::Serialize;

use super::motion::period;
use crate::arguments::{HysteresisArguments, positive, with_units_alike};
use crate::failure::Failure;
use crate::tables::new_table;

/// Pairs of amplitude (m) and energy of a cycle (J).
pub struct DissipationCurve {
    /// The pairs, amplitudes growing.
    pub pairs: Vec<(f64, f64)>,
    /// Period of the cycles (s) where it matters.
    period: Option<f64>,
    /// Where the third cycle differs most from the second: its amplitude (m) and energies (J); `None`
    /// where cycles are steady.
    unsteady: Option<Unsteady>,
}

/// Two cycles of one amplitude that differ.
#[derive(Debug, Clone, Copy, Serialize)]
struct Unsteady {
    /// Amplitude (m).
    amplitude: f64,
    /// Energy of the second cycle (J).
    second_cycle: f64,
    /// Energy of the third (J).
    third_cycle: f64,
}

impl Unsteady {
    fn difference(&self) -> f64 {
        (self.third_cycle - self.second_cycle).abs()
            / self.second_cycle.abs().max(self.third_cycle.abs())
    }
}

/// Part of its energy by which a steady cycle differs at most from the one before it.
const STEADY: f64 = 1.0e-3;

/// The curve of the arguments, if they ask for one.
pub fn curve(
    specimen: &Specimen,
    arguments: &HysteresisArguments,
) -> Result<Option<DissipationCurve>, Failure> {
    if arguments.dissipation.is_empty() {
        return Ok(None);
    }
    with_units_alike(
        "dissipation",
        arguments.dissipation.iter().map(String::as_str),
    )?;
    let ends = arguments
        .dissipation
        .iter()
        .map(|text| {
            positive(
                text.trim(),
                ("dissipation", "0.1 mm,10 mm"),
                Dimension::LENGTH,
            )
        })
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
        steps: 2 * arguments.steps(),
        cycles_before: 1,
        period: period(arguments)?,
    };
    let pairs = checked_dissipation_curve(specimen, &amplitudes, cycling)?;
    let later = Cycling {
        cycles_before: cycling.cycles_before + 1,
        ..cycling
    };
    let third = checked_dissipation_curve(specimen, &amplitudes, later)?;
    let both = pairs.iter().zip(&third);
    let both = both.map(|((amplitude, second), (_, third))| Unsteady {
        amplitude: *amplitude,
        second_cycle: *second,
        third_cycle: *third,
    });
    let unsteady = both
        .filter(|cycles| cycles.difference() > STEADY)
        .max_by(|a, b| a.difference().total_cmp(&b.difference()));
    Ok(Some(DissipationCurve {
        pairs,
        unsteady,
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
        let (which, remark) = match &self.unsteady {
            None => ("Steady cycles", String::new()),
            Some(cycles) => (
                "Second cycle of each amplitude",
                format!(
                    "Cycles of this law are not steady: at {0} mm the third dissipates {1} J after {2} J of the second; --cycles \"{0} mm, {0} mm, {0} mm\" follows them\n",
                    significant(1.0e3 * cycles.amplitude),
                    significant(cycles.third_cycle),
                    significant(cycles.second_cycle)
                ),
            ),
        };
        format!(
            "\n{which}{how}\n{table}\nslope of all by least squares: {}\n{remark}",
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
            unsteady: self.unsteady,
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
    /// Where the third cycle differs most from the second; `null` where cycles are steady.
    unsteady: Option<Unsteady>,
}
