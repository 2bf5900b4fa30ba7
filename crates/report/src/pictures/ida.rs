//! Incremental dynamic analyses.

use pounding_study::{Counts, FragilityFit, IdaReport, LimitResult};

use super::panel;
use crate::error::ReportError;
use crate::figure::{Curve, figure};

/// Points of a drawn curve.
const POINTS: usize = 200;
/// Curves of one panel that can still be told apart.
const MOST: usize = 7;

/// Fragility curves with the fractions they were fitted to, of the limits and of pounding by
/// width of each gap, and the mean annual frequency of pounding over the width.
///
/// # Errors
/// [`ReportError::Figure`].
pub fn fragility(report: &IdaReport) -> Result<String, ReportError> {
    let highest = last_that_differs(report);
    let horizontal = format!("{} ({})", report.measure, report.unit);
    let states: Vec<&LimitResult> = report.limits.iter().collect();
    let mut panels = vec![panel(
        "Probability of a state: counts (broken lines) and fitted curves",
        &horizontal,
        fragilities(&states, highest),
    )];
    for gap in &report.gaps {
        let widths: Vec<&LimitResult> = gap.widths.iter().map(|w| &w.result).collect();
        if !widths.is_empty() {
            let caption = format!("Probability of pounding, {}, by width of the gap", gap.gap);
            panels.push(panel(&caption, &horizontal, fragilities(&widths, highest)));
        }
        let frequencies: Vec<(f64, f64)> = gap
            .widths
            .iter()
            .filter_map(|w| Some((w.width * 1e3, w.result.frequency?.log10())))
            .collect();
        if frequencies.len() > 1 {
            let caption = format!(
                "Mean annual frequency of pounding, {} (decimal logarithm)",
                gap.gap
            );
            let curve = Curve {
                name: gap.gap.clone(),
                points: frequencies,
            };
            panels.push(panel(&caption, "gap (mm)", vec![curve]));
        }
    }
    figure(&panels)
}

/// The intensity from which on every run reaches every state: there is nothing more to see.
fn last_that_differs(report: &IdaReport) -> f64 {
    let widths = report
        .gaps
        .iter()
        .flat_map(|g| g.widths.iter().map(|w| &w.result));
    let states: Vec<&LimitResult> = report.limits.iter().chain(widths).collect();
    let certain = |level: &usize| {
        states.iter().all(|s| {
            let mut above = s.counts.iter().skip(*level);
            above.all(|c| c.reached == c.runs)
        })
    };
    let levels = &report.levels;
    let first = (0..levels.len()).find(certain);
    let shown = first.map_or(levels.last(), |i| levels.get(i));
    shown.map_or(1.0, |l| l.intensity)
}

/// Fitted curves with the fractions they were fitted to.
fn fragilities(states: &[&LimitResult], highest: f64) -> Vec<Curve> {
    let mut curves = Vec::new();
    for state in states.iter().take(MOST) {
        if let FragilityFit::Lognormal(f) = state.fit {
            let at = |i: usize| highest * i as f64 / POINTS as f64;
            curves.push(Curve {
                name: state.name.clone(),
                points: (0..=POINTS)
                    .map(|i| (at(i), f.probability(at(i))))
                    .collect(),
            });
        }
        let shown = |c: &&Counts| c.runs > 0 && c.intensity <= highest;
        let fractions = state.counts.iter().filter(shown);
        curves.push(Curve {
            name: format!("{}, counts", state.name),
            points: fractions
                .map(|c| (c.intensity, c.reached as f64 / c.runs as f64))
                .collect(),
        });
    }
    curves
}
