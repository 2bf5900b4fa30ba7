//! Pictures of motions and spectra.

use std::path::Path;

use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::{GroundMotion, Husid};
use pounding_ground_motion::spectra::{Evaluation, ResponseSpectrum};

use crate::failure::Failure;
use crate::plot::{self, Curve, Panel};
use crate::tables::G;

/// Points of a curve: as many as a picture can show; peaks of each stretch are kept.
const POINTS: usize = 4000;

/// A motion with its name in the picture.
pub struct Named<'a> {
    /// Name.
    pub name: String,
    /// Motion.
    pub record: &'a Accelerogram,
    /// Velocity (m/s) and displacement (m) at the first sample.
    pub initial: (f64, f64),
}

impl<'a> Named<'a> {
    /// A motion that starts at rest.
    pub fn at_rest(name: &str, record: &'a Accelerogram) -> Self {
        Self {
            name: name.to_owned(),
            record,
            initial: (0.0, 0.0),
        }
    }
}

/// Draws acceleration, velocity, displacement and Husid curve of motions.
pub fn histories(path: &Path, motions: &[Named<'_>]) -> Result<(), Failure> {
    plot::write(path, &plot::figure(&history_panels(motions)?)?)
}

/// The panels of that picture.
pub fn history_panels(motions: &[Named<'_>]) -> Result<[Panel; 4], Failure> {
    let mut panels = [
        panel("Ground acceleration (g)", "time (s)"),
        panel("Ground velocity (m/s)", "time (s)"),
        panel("Ground displacement (mm)", "time (s)"),
        panel("Husid curve: part of the Arias intensity (-)", "time (s)"),
    ];
    for Named {
        name,
        record,
        initial,
    } in motions
    {
        let motion = GroundMotion::of(record, initial.0, initial.1);
        let husid = Husid::of(record, Evaluation::PiecewiseLinear)?;
        let step = record.time_step();
        let whole = husid.arias_intensity();
        let curves = [
            curve(name, &motion.acceleration, step, 1.0 / G),
            curve(name, &motion.velocity, step, 1.0),
            curve(name, &motion.displacement, step, 1.0e3),
            curve(name, husid.intensity(), step, 1.0 / whole),
        ];
        for (panel, curve) in panels.iter_mut().zip(curves) {
            panel.curves.push(curve);
        }
    }
    Ok(panels)
}

/// Draws pseudo-acceleration, pseudo-velocity and displacement over the period.
pub fn responses(path: &Path, named: &[(String, &ResponseSpectrum)]) -> Result<(), Failure> {
    let mut panels = [
        panel("Pseudo-acceleration PSA (g)", "period (s)"),
        panel("Pseudo-velocity PSV (m/s)", "period (s)"),
        panel("Displacement SD (mm)", "period (s)"),
    ];
    for (name, s) in named {
        let curves = [
            over(name, &s.periods, &s.pseudo_acceleration, 1.0 / G),
            over(name, &s.periods, &s.pseudo_velocity, 1.0),
            over(name, &s.periods, &s.displacement, 1.0e3),
        ];
        for (panel, curve) in panels.iter_mut().zip(curves) {
            panel.curves.push(curve);
        }
    }
    plot::write(path, &plot::figure(&panels)?)
}

/// Empty axes.
pub fn panel(caption: &str, horizontal: &str) -> Panel {
    Panel {
        caption: caption.to_owned(),
        horizontal: horizontal.to_owned(),
        curves: Vec::new(),
    }
}

/// A curve over given places.
pub fn over(name: &str, x: &[f64], y: &[f64], factor: f64) -> Curve {
    Curve {
        name: name.to_owned(),
        points: x.iter().zip(y).map(|(x, y)| (*x, y * factor)).collect(),
    }
}

/// Samples at even steps; of long records the minimum and maximum of each stretch.
fn curve(name: &str, samples: &[f64], step: f64, factor: f64) -> Curve {
    let point = |i: usize| (i as f64 * step, samples[i] * factor);
    let stretch = samples.len().div_ceil(POINTS / 2);
    let points = if stretch <= 2 {
        (0..samples.len()).map(point).collect()
    } else {
        let starts = (0..samples.len()).step_by(stretch);
        starts
            .flat_map(|start| {
                let all = start..(start + stretch).min(samples.len());
                let by = |a: &usize, b: &usize| samples[*a].total_cmp(&samples[*b]);
                let least = all.clone().min_by(by).unwrap_or(start);
                let most = all.max_by(by).unwrap_or(start);
                [least.min(most), least.max(most)]
            })
            .map(point)
            .collect()
    };
    Curve {
        name: name.to_owned(),
        points,
    }
}
