//! An Iwan density from a measured dissipation curve.

use std::path::Path;

use pounding_case::Dimension;
use pounding_catalogue::numbers::significant;
use pounding_catalogue::wording::counted;
use pounding_hysteresis::LawDescriptor;
use pounding_hysteresis::iwan::{DissipationFit, FitOptions, fit_from_many, unknowns_of_fit};
use serde::Serialize;

use super::chosen::given;
use crate::columns::{Column, Source};
use crate::failure::Failure;
use crate::tables::new_table;

/// Law whose parameters can be fitted.
const LAW: &str = "iwan_six_parameter";
/// A fitted density beside what was measured.
pub struct Fitted {
    /// The fit.
    pub fit: DissipationFit,
    /// Pairs of amplitude (m) and energy of a cycle (J).
    pub measured: Vec<(f64, f64)>,
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
    let measured = read(path, unknowns_of_fit(&start))?;
    let fit = fit_from_many(&measured, &start, FitOptions::default())?;
    Ok(Fitted { fit, measured })
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
    let source = Source::open_regular(path, "--fit", "amplitude_mm,dissipation_J")?;
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

impl Fitted {
    /// Measured beside fitted, for people.
    pub fn text(&self) -> String {
        let mut table = new_table(["amplitude (mm)", "measured (J)", "fitted (J)", "error (%)"]);
        for (amplitude, energy) in &self.measured {
            let fitted = self.fit.density.cycle_dissipation(*amplitude);
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
            100.0 * self.fit.relative_error,
            counted(self.fit.iterations, "iteration"),
            significant(self.fit.density.initial_stiffness()),
            significant(self.fit.density.residual_stiffness),
        )
    }

    /// For machines, SI.
    pub fn shown(&self) -> ShownFit {
        let fitted = |a: f64| self.fit.density.cycle_dissipation(a);
        let measured = self.measured.iter();
        ShownFit {
            columns: ["amplitude", "measured", "fitted"],
            curve: measured.map(|(a, d)| (*a, *d, fitted(*a))).collect(),
            relative_error: self.fit.relative_error,
            iterations: self.fit.iterations,
        }
    }
}

/// A fit for machines.
#[derive(Serialize)]
pub struct ShownFit {
    columns: [&'static str; 3],
    curve: Vec<(f64, f64, f64)>,
    relative_error: f64,
    iterations: usize,
}
