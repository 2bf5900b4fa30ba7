//! Ground motions and their spectra.

use pounding_catalogue::STANDARD_GRAVITY as G;
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::{GroundMotion, Husid};
use pounding_ground_motion::spectra::design::CodeSpectrum;
use pounding_ground_motion::spectra::{
    Evaluation, ResponseSpectrum, RotatedSpectrum, SMOOTH, TargetSpectrum, logarithmic_periods,
    response_spectrum,
};

use super::{over, panel};
use crate::chart::{Axis, Chart, Plot};
use crate::error::ReportError;
use crate::figure::{Curve, Panel, Reference, plots};

/// Points of a curve: as many as a picture can show; peaks of each stretch are kept.
const POINTS: usize = 4000;
/// Height of the axes of one of several accelerations (pt).
const LOW: f64 = 80.0;

/// A motion with its name in the picture.
#[derive(Debug, Clone)]
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
    #[must_use]
    pub fn at_rest(name: &str, record: &'a Accelerogram) -> Self {
        Self {
            name: name.to_owned(),
            record,
            initial: (0.0, 0.0),
        }
    }
}

/// Accelerations that have axes of their own: together they would hide one another.
const APART: usize = 7;

/// Acceleration, velocity, displacement and Husid curve of motions over time.
///
/// # Errors
/// A record of zeros, which has no Husid curve.
pub fn histories(motions: &[Named<'_>]) -> Result<Chart, ReportError> {
    let mut all = plots(&history_panels(motions)?, &[]);
    if (2..=APART).contains(&motions.len()) {
        let together = all.remove(0);
        let points = together.series.iter().flat_map(|s| &s.points);
        let most = 1.05 * points.fold(0.0_f64, |m, p| m.max(p.1.abs()));
        let apart = together.series.iter().map(|series| Plot {
            heading: format!("{}, {}", together.heading, series.name),
            series: vec![series.clone()],
            vertical: together.vertical.clone().over(-most, most),
            height: LOW,
            ..together.clone()
        });
        all.splice(0..0, apart);
    }
    Ok(Chart::of_page(all))
}

/// Panels over the period.
pub fn over_period(panels: &[Panel]) -> Chart {
    over_periods(panels, &[], false)
}

fn history_panels(motions: &[Named<'_>]) -> Result<[Panel; 4], ReportError> {
    let mut panels = [
        "Ground acceleration (g)",
        "Ground velocity (m/s)",
        "Ground displacement (mm)",
        "Husid curve: part of the Arias intensity (-)",
    ]
    .map(|caption| panel(caption, "time (s)", Vec::new()));
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
            thinned(name, &motion.acceleration, step, 1.0 / G),
            thinned(name, &motion.velocity, step, 1.0),
            thinned(name, &motion.displacement, step, 1.0e3),
            thinned(name, husid.intensity(), step, 1.0 / whole),
        ];
        for (panel, curve) in panels.iter_mut().zip(curves) {
            panel.curves.push(curve);
        }
    }
    Ok(panels)
}

/// Samples at even steps; of long records the minimum and maximum of each stretch.
fn thinned(name: &str, samples: &[f64], step: f64, factor: f64) -> Curve {
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

/// `5 % damping`.
#[must_use]
pub fn percent(damping: f64) -> String {
    format!("{} % damping", (damping * 1.0e8).round() / 1.0e6)
}

/// Pseudo-acceleration, pseudo-velocity and displacement over the period, a curve for each
/// damping ratio.
pub fn responses(spectra: &[ResponseSpectrum]) -> Chart {
    responses_and_codes(spectra, &[])
}

/// The same with spectra of a code beside the pseudo-acceleration.
pub fn responses_and_codes(spectra: &[ResponseSpectrum], codes: &[CodeSpectrum]) -> Chart {
    type Values = for<'s> fn(&'s ResponseSpectrum) -> &'s [f64];
    let panel_of = |caption: &str, values: Values, factor: f64| {
        let curves = spectra.iter();
        let curves = curves.map(|s| over(&percent(s.damping), &s.periods, values(s), factor));
        panel(caption, "period (s)", curves.collect())
    };
    let mut panels = [
        panel_of(
            "Pseudo-acceleration PSA (g)",
            |s| &s.pseudo_acceleration,
            1.0 / G,
        ),
        panel_of("Pseudo-velocity PSV (m/s)", |s| &s.pseudo_velocity, 1.0),
        panel_of("Displacement SD (mm)", |s| &s.displacement, 1.0e3),
    ];
    let mut references = Vec::new();
    if let Some(first) = spectra.first() {
        for code in codes {
            let values = first.periods.iter();
            let values = values.map(|t| (*t, code.acceleration(*t) / G));
            references.push(Reference {
                panel: 0,
                curve: Curve {
                    name: code.title(),
                    points: values.collect(),
                },
            });
        }
        if panels[0].curves.len() == 1 && !codes.is_empty() {
            panels[0].curves[0].name = format!("record, {}", percent(first.damping));
        }
    }
    over_periods(&panels, &references, false)
}

/// Panels over periods or frequencies, whose axis is logarithmic; with `both` the vertical one
/// too.
fn over_periods(panels: &[Panel], references: &[Reference], both: bool) -> Chart {
    let mut plots: Vec<Plot> = plots(panels, references);
    for plot in &mut plots {
        plot.horizontal = Axis::logarithmic(&plot.horizontal.label);
        if both {
            plot.vertical = Axis::logarithmic("");
        }
    }
    Chart::of_page(plots)
}

/// Spectra of a code at these periods (s), one for each damping ratio.
pub fn codes(spectra: &[CodeSpectrum], periods: &[f64]) -> Chart {
    let curves = spectra.iter().map(|spectrum| {
        let values: Vec<f64> = periods.iter().map(|t| spectrum.acceleration(*t)).collect();
        over(&spectrum.title(), periods, &values, 1.0 / G)
    });
    let caption = "Pseudo-acceleration PSA (g)";
    let panel = panel(caption, "period (s)", curves.collect());
    over_periods(&[panel], &[], false)
}

/// Median and maximum over all directions, for each damping ratio.
pub fn rotated(spectra: &[RotatedSpectrum]) -> Chart {
    let mut curves = Vec::new();
    for s in spectra {
        for (name, values) in [("RotD50", &s.median), ("RotD100", &s.maximum)] {
            let name = format!("{name}, {}", percent(s.damping));
            curves.push(over(&name, &s.periods, values, 1.0 / G));
        }
    }
    let caption = "Pseudo-acceleration over all directions (g)";
    over_periods(&[panel(caption, "period (s)", curves)], &[], false)
}

/// Fourier amplitudes (m/s) over the frequency (Hz); `name` says how they are smoothed.
pub fn fourier(name: &str, frequencies: &[f64], amplitudes: &[f64]) -> Chart {
    let caption = "Fourier amplitude of acceleration (m/s)";
    let curve = over(name, frequencies, amplitudes, 1.0);
    let panel = panel(caption, "frequency (Hz)", vec![curve]);
    over_periods(&[panel], &[], true)
}

/// Spectra from one period (s) to another before and after a motion was brought to a target,
/// with the target, and the motions below.
///
/// # Errors
/// Periods that the target or the records do not cover.
pub fn matched(
    before: &Accelerogram,
    after: &Accelerogram,
    target: &TargetSpectrum,
    (from, to): (f64, f64),
) -> Result<Chart, ReportError> {
    let periods = logarithmic_periods(from, to, SMOOTH)?;
    let mut spectra = panel("Pseudo-acceleration PSA (g)", "period (s)", Vec::new());
    for (name, record) in [("as read", before), ("matched", after)] {
        let linear = Evaluation::PiecewiseLinear;
        let s = response_spectrum(record, &periods, target.damping(), linear)?;
        let curve = over(name, &periods, &s.pseudo_acceleration, 1.0 / G);
        spectra.curves.push(curve);
    }
    let mut wanted = Vec::with_capacity(periods.len());
    for period in &periods {
        wanted.push((*period, target.at(*period)? / G));
    }
    let reference = Reference {
        panel: 0,
        curve: Curve {
            name: "target".to_owned(),
            points: wanted,
        },
    };
    let mut all = plots(&[spectra], &[reference]);
    for plot in &mut all {
        plot.horizontal = Axis::logarithmic(&plot.horizontal.label);
    }
    let named = [
        Named::at_rest("as read", before),
        Named::at_rest("matched", after),
    ];
    all.extend(plots(&history_panels(&named)?, &[]));
    Ok(Chart::of_page(all))
}
