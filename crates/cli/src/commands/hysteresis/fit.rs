//! An Iwan density from a measured dissipation curve.

use std::path::Path;

use crate::tables::Table;
use comfy_table::CellAlignment;
use pounding_case::Dimension;
use pounding_catalogue::wording::counted;
use pounding_hysteresis::iwan::{DissipationFit, FitOptions, IwanDensity, fit_dissipation};
use pounding_hysteresis::{HysteresisError, LawDescriptor, LawParameters};
use serde_json::{Value, json};

use super::chosen::given;
use super::columns::{Column, Source};
use crate::commands::impact::numbers::significant;
use crate::failure::Failure;

/// Law whose parameters can be fitted.
const LAW: &str = "iwan_six_parameter";
/// Exponents from which a fit sets out where none is given.
const EXPONENTS: [f64; 3] = [-0.7, -0.3, 0.2];
/// Shares of the maximum amplitude from which phi_2 sets out where none is given.
const SHARES: [f64; 3] = [0.1, 0.5, 2.0];

/// A fitted density beside what was measured.
pub struct Fitted {
    /// The density.
    pub density: IwanDensity,
    /// Pairs of amplitude (m) and energy of a cycle (J).
    pub measured: Vec<(f64, f64)>,
    relative_error: f64,
    iterations: usize,
}

/// Fits the density to the pairs of a file. Parameters of `--set` are where the fit sets
/// out; `phi_1 = 0` and `slider_stiffness = 0` are kept.
pub fn fit(law: &LawDescriptor, path: &Path, set: &[String]) -> Result<Fitted, Failure> {
    if law.name != LAW {
        return Err(Failure::input(
            format!("--fit does not know law {}", law.name),
            Some(format!(
                "it fits the law {LAW}, of which segalman_2005 and song_2004 are cases"
            )),
        ));
    }
    let start = given(pounding_hysteresis::find(LAW)?, set)?;
    let free = |name: &str| start.values.get(name).copied();
    // Density, exponent and phi_2 are always unknown.
    let lump = usize::from(free("slider_stiffness") != Some(0.0));
    let unknowns = 3 + lump + usize::from(free("phi_1").is_some_and(|x| x > 0.0));
    let measured = read(path, unknowns)?;
    let mut best: Option<DissipationFit> = None;
    let mut refusal = None;
    for guess in guesses(&start, &measured) {
        match fit_dissipation(&measured, guess, FitOptions::default()) {
            Ok(fit) => {
                if best.is_none_or(|b| fit.relative_error < b.relative_error) {
                    best = Some(fit);
                }
            }
            Err(error) => refusal = Some(error),
        }
    }
    match (best, refusal) {
        (Some(fit), _) => Ok(Fitted {
            density: fit.density,
            measured,
            relative_error: fit.relative_error,
            iterations: fit.iterations,
        }),
        (None, Some(error)) => Err(Failure::from(error)),
        (None, None) => Err(Failure::from(HysteresisError::Fit {
            reason: "no start".to_owned(),
            remedy: "give a start with --set",
        })),
    }
}

/// Pairs of amplitude (m) and energy of a cycle (J), all positive.
fn read(path: &Path, unknowns: usize) -> Result<Vec<(f64, f64)>, Failure> {
    let columns = [
        Column {
            name: "amplitude",
            dimension: Dimension::LENGTH,
        },
        Column {
            name: "dissipation",
            dimension: Dimension::ENERGY,
        },
    ];
    let source = Source::open(path, "--fit", "amplitude_mm,dissipation_J")?;
    let mut pairs = Vec::new();
    for (place, row) in source.rows(&[&columns])? {
        let (amplitude, energy) = (row[0], row[1]);
        if !(amplitude > 0.0 && energy > 0.0) {
            return Err(source.error(
                place,
                "amplitude and dissipation must be greater than zero".to_owned(),
                "leave out cycles without dissipation",
            ));
        }
        pairs.push((amplitude, energy));
    }
    if pairs.len() < unknowns {
        return Err(source.error(
            0..0,
            format!(
                "{} of numbers for {}",
                counted(pairs.len(), "row"),
                counted(unknowns, "unknown")
            ),
            "measure more amplitudes, or set slider_stiffness=0, and phi_1=0",
        ));
    }
    Ok(pairs)
}

/// Where the fit sets out: every combination of what is not given.
fn guesses(start: &LawParameters, measured: &[(f64, f64)]) -> Vec<IwanDensity> {
    let get = |name: &str| start.values.get(name).copied();
    let maximum = measured.iter().map(|(a, _)| *a).fold(0.0, f64::max);
    let exponents = get("exponent").map_or_else(|| EXPONENTS.to_vec(), |e| vec![e]);
    let ends = get("phi_2").map_or_else(
        || SHARES.iter().map(|s| s * maximum).collect(),
        |end| vec![end],
    );
    let mut guesses = Vec::new();
    for &exponent in &exponents {
        for &phi_2 in &ends {
            guesses.push(IwanDensity {
                density: get("density").unwrap_or(1.0),
                exponent,
                phi_1: get("phi_1").unwrap_or(0.0),
                phi_2,
                slider_stiffness: get("slider_stiffness").unwrap_or(1.0),
                residual_stiffness: get("residual_stiffness").unwrap_or(0.0),
            });
        }
    }
    guesses
}

impl Fitted {
    /// Measured beside fitted, for people.
    pub fn text(&self) -> String {
        let mut table = Table::new();
        table.set_header(["amplitude (mm)", "measured (J)", "fitted (J)", "error (%)"]);
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        for (amplitude, energy) in &self.measured {
            let fitted = self.density.cycle_dissipation(*amplitude);
            table.add_row([
                significant(1.0e3 * amplitude),
                significant(*energy),
                significant(fitted),
                format!("{:+.2}", 100.0 * (fitted / energy - 1.0)),
            ]);
        }
        format!(
            "\nFitted to {}\n{table}\nroot mean square of the relative errors {:.3} %, {}\ninitial stiffness {} N/m, of which residual_stiffness = {} N/m is taken as given: a spring does not dissipate\n",
            counted(self.measured.len(), "measured cycle"),
            100.0 * self.relative_error,
            counted(self.iterations, "iteration"),
            significant(self.density.initial_stiffness()),
            significant(self.density.residual_stiffness),
        )
    }

    /// For machines, SI.
    pub fn json(&self) -> Value {
        let pairs: Vec<_> = self
            .measured
            .iter()
            .map(|(a, d)| json!([a, d, self.density.cycle_dissipation(*a)]))
            .collect();
        json!({
            "columns": ["amplitude", "measured", "fitted"], "curve": pairs,
            "relative_error": self.relative_error, "iterations": self.iterations,
        })
    }
}
