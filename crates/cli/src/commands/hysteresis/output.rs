//! Loops and dissipation curves as files.

use std::path::Path;

use pounding_hysteresis::iwan::MeasuredCurve;
use pounding_report::pictures::hysteresis::LawPicture;

use super::{Results, chosen};
use crate::arguments::FigureArguments;
use crate::failure::Failure;
use crate::output::comma_separated;
use crate::plot;

/// Writes the loop, or without one the dissipation curve, or the fit, in SI units and full
/// precision.
pub fn write_csv(path: &Path, results: &Results) -> Result<(), Failure> {
    let head = format!(
        "# pounding hysteresis: {}\n",
        chosen::pairs(&results.specimen)
    );
    let body = if let Some((driven, _)) = &results.driven {
        let rows: Vec<_> = driven
            .states
            .iter()
            .map(|s| (s.time, s.deformation, s.force, s.dissipated))
            .collect();
        comma_separated(
            &["time_s", "deformation_m", "force_n", "dissipated_j"],
            &rows,
        )?
    } else if let Some(curve) = &results.curve {
        comma_separated(&["amplitude_m", "dissipated_j"], &curve.pairs)?
    } else if let Some(fitted) = &results.fitted {
        let rows: Vec<_> = fitted
            .measured
            .iter()
            .map(|(a, d)| (*a, *d, fitted.fitted(*a)))
            .collect();
        let names = match fitted.fit.curve {
            MeasuredCurve::Dissipation => ["amplitude_m", "measured_j", "fitted_j"],
            MeasuredCurve::Backbone => ["deformation_m", "measured_n", "fitted_n"],
        };
        comma_separated(&names, &rows)?
    } else {
        String::new()
    };
    plot::write(path, &format!("{head}{body}"))
}

/// Draws the loop and the dissipation curve below it.
pub fn write_svg(path: &Path, results: &Results, size: &FigureArguments) -> Result<(), Failure> {
    let picture = LawPicture {
        law: results.specimen.descriptor.name,
        driven: results.driven.as_ref().map(|(driven, _)| driven),
        dissipation: results.curve.as_ref().map(|c| c.pairs.as_slice()),
        fitted: results.fitted.as_ref().map(|f| (&f.fit, &f.measured[..])),
    };
    plot::write_drawn(path, picture.draw(), size)
}
