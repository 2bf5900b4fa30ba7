//! Loops and dissipation curves of laws.

use pounding_hysteresis::iwan::{DensityFit, MeasuredCurve};
use pounding_hysteresis::laboratory::Loop;

use super::panel;
use crate::chart::Chart;
use crate::figure::{Curve, Reference, figure_with_references};
use crate::loops::deformation_panel;

/// Pairs of amplitude (m) and dissipation of a cycle (J).
type Pairs = [(f64, f64)];

/// What a picture of a law shows.
#[derive(Debug, Clone, Copy)]
pub struct LawPicture<'a> {
    /// Name of the law.
    pub law: &'a str,
    /// A loop.
    pub driven: Option<&'a Loop>,
    /// Amplitudes (m) of steady cycles with what each dissipates (J).
    pub dissipation: Option<&'a Pairs>,
    /// A fit, and the amplitudes (m) and dissipations (J), or deformations (m) and forces (N), that
    /// it was fitted to.
    pub fitted: Option<(&'a DensityFit, &'a Pairs)>,
}

impl LawPicture<'_> {
    /// The loop, and below it the dissipation curve, or that of the fit; a measured curve dashed.
    pub fn draw(&self) -> Chart {
        let law = self.law;
        let mut panels = Vec::new();
        let mut references = Vec::new();
        if let Some(driven) = self.driven {
            panels.push(deformation_panel(law, vec![("loop".to_owned(), driven)]));
        }
        let of_fit = self.fitted.map(|(fit, measured)| {
            let pair = |(a, _): &(f64, f64)| (*a, fit.curve.value(&fit.density, *a));
            measured.iter().map(pair).collect::<Vec<_>>()
        });
        if let Some(pairs) = self.dissipation.or(of_fit.as_deref()) {
            let unit = pairs.iter().find(|(_, d)| *d > 0.0).copied();
            let unit = unit.unwrap_or((1.0, 1.0));
            if let Some((_, measured)) = self.fitted {
                references.push(Reference {
                    panel: panels.len(),
                    curve: logarithms("measured", measured, unit),
                });
            }
            let curve = self.fitted.map(|(fit, _)| fit.curve);
            let (what, of, over) = match curve.filter(|_| self.dissipation.is_none()) {
                Some(MeasuredCurve::Backbone) => ("force of the backbone", "N", "deformation"),
                _ => ("dissipation of a cycle", "J", "amplitude"),
            };
            panels.push(panel(
                &format!("{law}: log10 of the {what} over {:.3e} {of}", unit.1),
                &format!("log10 of the {over} over {:.4} mm", 1.0e3 * unit.0),
                vec![logarithms("law", pairs, unit)],
            ));
        }
        figure_with_references(&panels, &references)
    }
}

fn logarithms(name: &str, pairs: &Pairs, unit: (f64, f64)) -> Curve {
    let positive = pairs.iter().filter(|(_, energy)| *energy > 0.0);
    Curve {
        name: name.to_owned(),
        points: positive
            .map(|(a, d)| ((a / unit.0).log10(), (d / unit.1).log10()))
            .collect(),
    }
}
