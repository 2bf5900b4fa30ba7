//! Loops and dissipation curves as files.

use std::path::Path;

use pounding_report::deformation_panel;

use super::{Results, chosen};
use crate::failure::Failure;
use crate::output::comma_separated;
use crate::plot::{self, Curve, Panel, Reference};

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
            .map(|(a, d)| (*a, *d, fitted.fit.density.cycle_dissipation(*a)))
            .collect();
        comma_separated(&["amplitude_m", "measured_j", "fitted_j"], &rows)?
    } else {
        String::new()
    };
    plot::write(path, &format!("{head}{body}"))
}

/// Draws the loop and the dissipation curve below it; a measured curve dashed.
pub fn write_svg(path: &Path, results: &Results) -> Result<(), Failure> {
    let name = results.specimen.descriptor.name;
    let mut panels = Vec::new();
    let mut references = Vec::new();
    if let Some((driven, _)) = &results.driven {
        panels.push(deformation_panel(name, vec![("loop".to_owned(), driven)]));
    }
    let fitted = results.fitted.as_ref();
    let of_fit = fitted.map(|f| {
        let pairs = f.measured.iter();
        pairs
            .map(|(a, _)| (*a, f.fit.density.cycle_dissipation(*a)))
            .collect::<Vec<_>>()
    });
    let pairs = results.curve.as_ref().map(|c| &c.pairs).or(of_fit.as_ref());
    if let Some(pairs) = pairs {
        let unit = pairs.iter().find(|(_, d)| *d > 0.0).copied();
        let unit = unit.unwrap_or((1.0, 1.0));
        if let Some(fitted) = fitted {
            references.push(Reference {
                panel: panels.len(),
                curve: logarithms("measured", &fitted.measured, unit),
            });
        }
        panels.push(Panel {
            caption: format!(
                "{name}: log10 of the dissipation of a cycle over {:.3e} J",
                unit.1
            ),
            horizontal: format!("log10 of the amplitude over {:.4} mm", 1.0e3 * unit.0),
            curves: vec![logarithms("law", pairs, unit)],
        });
    }
    plot::write(path, &plot::figure_with_references(&panels, &references)?)
}

fn logarithms(name: &str, pairs: &[(f64, f64)], unit: (f64, f64)) -> Curve {
    let positive = pairs.iter().filter(|(_, energy)| *energy > 0.0);
    Curve {
        name: name.to_owned(),
        points: positive
            .map(|(a, d)| ((a / unit.0).log10(), (d / unit.1).log10()))
            .collect(),
    }
}
