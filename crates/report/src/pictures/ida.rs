//! Incremental dynamic analyses.

use pounding_catalogue::wording::counted;
use pounding_study::{Counts, FragilityFit, GapResult, IdaReport, LimitResult};

use crate::chart::{Axis, Chart, HEIGHT, Look, Plot, Series};

/// Points of a drawn curve.
const POINTS: usize = 200;
/// Curves of one panel that can still be told apart.
const MOST: usize = 7;
/// Demands whose curves are drawn at most.
const DEMANDS: usize = 4;

/// Curves of the analysis, one line a record with its fractiles; fragility curves with the
/// fractions they were fitted to, of the limits and of pounding by width of each gap; and the
/// mean annual frequency of pounding over the width with its bounds.
pub fn fragility(report: &IdaReport) -> Chart {
    let highest = report.levels.last().map_or(1.0, |l| l.intensity);
    let mut plots = curves(report);
    let states: Vec<(String, &LimitResult)> = report
        .limits
        .iter()
        .map(|state| (state.name.clone(), state))
        .collect();
    // A single curve has no legend to name it.
    let heading = match &states[..] {
        [(name, _)] => format!("Probability of {name}"),
        _ => "Probability of a state".to_owned(),
    };
    plots.extend(panels(report, &heading, &states, highest));
    for gap in &report.gaps {
        let widths: Vec<f64> = gap.widths.iter().map(|w| w.width * 1e3).collect();
        let results = gap.widths.iter().map(|w| &w.result);
        let widths: Vec<(String, &LimitResult)> =
            told_apart(&widths, "mm").into_iter().zip(results).collect();
        if !widths.is_empty() {
            let heading = format!("Probability of pounding, {}, by width of the gap", gap.gap);
            plots.extend(panels(report, &heading, &widths, highest));
        }
        plots.extend(frequencies(&gap.gap, &gap.widths));
    }
    Chart::of_page(plots)
}

/// Intensity over drift ratios of the buildings, a line a record.
fn curves(report: &IdaReport) -> Vec<Plot> {
    let (scale, unit) = report.shown_intensity();
    let demands = report.demands.iter().enumerate();
    let drifts = demands.filter(|(_, (name, _))| name.starts_with("peak_drift_ratio"));
    let plot = |(index, (name, _)): (usize, &(String, String))| {
        let building = name.split_once(": ").map_or("", |(_, building)| building);
        let line = |values: &mut dyn Iterator<Item = f64>| {
            let levels = report.levels.iter().map(|l| l.intensity / scale);
            let points = values.zip(levels).map(|(d, i)| (100.0 * d, i));
            std::iter::once((0.0, 0.0)).chain(points).collect()
        };
        let all = &report.curves[index];
        let made = |values: &Vec<f64>| values.iter().filter(|x| !x.is_nan()).count();
        // Of records that have one intensity each, as in stripes, there are points and no curves.
        let (single, several): (Vec<&Vec<f64>>, Vec<&Vec<f64>>) =
            all.iter().partition(|values| made(values) < 2);
        let sampled = match report.structures {
            Some(_) => "records with a structure",
            None => "records",
        };
        let lines = several.iter().enumerate().map(|(number, values)| Series {
            name: match number {
                0 => format!("{} {sampled}, with pounding", several.len()),
                _ => String::new(),
            },
            points: line(&mut values.iter().copied()),
            look: Look::one_of_many(),
        });
        let mut series: Vec<Series> = lines.collect();
        let points = single
            .iter()
            .flat_map(|values| -> Vec<(f64, f64)> { line(&mut values.iter().copied()) });
        let points = points.filter(|(d, i): &(f64, f64)| *i > 0.0 && !d.is_nan());
        let points: Vec<(f64, f64)> = points.collect();
        if !points.is_empty() {
            series.push(Series {
                name: format!("{} runs, with pounding", points.len()),
                points,
                look: Look::points_of_many(),
            });
        }
        for (fractile, (name, dash)) in [("16 %", "1.5 1.5"), ("median", ""), ("84 %", "6 2")]
            .into_iter()
            .enumerate()
        {
            let values = report.levels.iter().map(|l| l.fractiles[index][fractile]);
            series.push(Series {
                name: name.to_owned(),
                points: line(&mut values.into_iter()),
                look: Look::summary(dash),
            });
        }
        // As far as the fractiles reach, of which those among collapses are not finite: the greatest records are few.
        let finite = |x: &f64| x.is_finite();
        let fractiles = report.levels.iter().flat_map(|l| l.fractiles[index]);
        let upper = fractiles
            .map(|x| 100.0 * x)
            .filter(finite)
            .fold(0.0, f64::max);
        let horizontal = Axis::linear("maximum drift ratio (%)");
        let all = report.curves[index].iter().flatten();
        let largest = all.map(|x| 100.0 * x).filter(finite).fold(0.0, f64::max);
        let end = 1.25 * upper;
        let beyond = upper > 0.0 && largest > end;
        Plot {
            heading: match beyond {
                true => format!(
                    "Maximum drift ratio of {building}: records reach {largest:.1} %, beyond the picture"
                ),
                false => format!("Maximum drift ratio of {building}"),
            },
            horizontal: if upper > 0.0 {
                horizontal.over(0.0, end)
            } else {
                horizontal
            },
            vertical: Axis::linear(&format!("intensity ({unit})")),
            series,
            limits: Vec::new(),
            height: HEIGHT,
        }
    };
    let drifts: Vec<_> = drifts.collect();
    let left_out = drifts.len().saturating_sub(DEMANDS);
    let mut plots: Vec<Plot> = drifts.into_iter().take(DEMANDS).map(plot).collect();
    if let Some(last) = plots.last_mut().filter(|_| left_out > 0) {
        let others = counted(left_out, "more building");
        last.heading.push_str(&format!("; {others} not drawn"));
    }
    plots
}

/// Numbers with a unit, of as many digits as tell them apart, four at least.
fn told_apart(values: &[f64], unit: &str) -> Vec<String> {
    let with = |digits: usize| -> Vec<String> {
        let shown = |value: &f64| {
            let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(*value);
            format!("{rounded} {unit}")
        };
        values.iter().map(shown).collect()
    };
    let distinct = |shown: &Vec<String>| {
        let all: std::collections::BTreeSet<&String> = shown.iter().collect();
        all.len() == shown.len()
    };
    (4..12).map(with).find(distinct).unwrap_or_else(|| with(12))
}

/// As many panels as the curves need to be told apart in each.
fn panels(
    report: &IdaReport,
    heading: &str,
    states: &[(String, &LimitResult)],
    highest: f64,
) -> Vec<Plot> {
    let count = states.len().div_ceil(MOST).max(1);
    let each = states.len().div_ceil(count).max(1);
    let parts = states.chunks(each).enumerate();
    let panel = |(number, part): (usize, &[(String, &LimitResult)])| {
        let heading = match count {
            1 => heading.to_owned(),
            count => format!("{heading} ({} of {count})", number + 1),
        };
        fragilities(report, &heading, part, highest)
    };
    parts.map(panel).collect()
}

/// Fitted curves, and as markers the fractions they were fitted to.
fn fragilities(
    report: &IdaReport,
    heading: &str,
    states: &[(String, &LimitResult)],
    highest: f64,
) -> Plot {
    let (scale, unit) = report.shown_intensity();
    let mut series = Vec::new();
    for (number, (name, state)) in states.iter().enumerate() {
        let fitted = match state.fit {
            FragilityFit::Lognormal(f) => {
                let at = |i: usize| highest * i as f64 / POINTS as f64;
                let points = (0..=POINTS).map(|i| (at(i) / scale, f.probability(at(i))));
                series.push(Series {
                    name: name.clone(),
                    points: points.collect(),
                    look: Look::fitted(number),
                });
                true
            }
            _ => false,
        };
        let fractions = state.counts.iter().filter(|c: &&Counts| c.runs > 0);
        series.push(Series {
            name: if fitted { String::new() } else { name.clone() },
            points: fractions
                .map(|c| (c.intensity / scale, c.reached as f64 / c.runs as f64))
                .collect(),
            look: Look::points(number),
        });
    }
    let fitted = series.iter().any(|s| s.look.dash.is_some());
    Plot {
        heading: match fitted {
            true => format!("{heading}: counted fractions as markers, fitted curves"),
            false => format!("{heading}: counted fractions as markers"),
        },
        horizontal: Axis::linear(&format!("{} ({unit})", report.measure)),
        vertical: Axis::linear("probability (-)").over(-0.03, 1.03),
        series,
        limits: Vec::new(),
        height: HEIGHT,
    }
}

/// Frequency of pounding over the width of a gap, with bounds; nothing of a single width.
fn frequencies(gap: &str, widths: &[GapResult]) -> Option<Plot> {
    let points = |at_most: bool| -> Vec<(f64, f64)> {
        let widths = widths.iter();
        let such = widths.filter(|w| w.result.frequency_is_at_most() == at_most);
        let points = such.filter_map(|w| Some((w.width * 1e3, w.result.frequency?)));
        points.collect()
    };
    let of = |name: &str, points: Vec<(f64, f64)>, look: usize| Series {
        name: name.to_owned(),
        points,
        look: Look {
            few_markers: false,
            ..Look::points(look)
        },
    };
    let (estimates, bounds) = (points(false), points(true));
    // A single series has no legend.
    let what = match estimates.is_empty() {
        true => "Upper bound of the mean annual frequency",
        false => "Mean annual frequency",
    };
    if estimates.len() + bounds.len() < 2 {
        return None;
    }
    let mut series = vec![
        of("estimate", estimates, 0),
        of("upper bound, as the counts give no curve", bounds, 1),
    ];
    series.retain(|s| !s.points.is_empty());
    let bounds = widths.iter().filter_map(|w| {
        let bounds = w.result.frequency_bounds?;
        Some((w.width * 1e3, bounds.low?, bounds.high?))
    });
    for (number, (width, low, high)) in bounds.enumerate() {
        series.push(Series {
            name: match number {
                0 => "bounds, bootstrap over records".to_owned(),
                _ => String::new(),
            },
            points: vec![(width, low), (width, high)],
            look: Look {
                dash: Some("".into()),
                ..Look::line(0)
            },
        });
    }
    Some(Plot {
        heading: format!("{what} of pounding, {gap}"),
        horizontal: Axis::linear("width of the gap (mm)"),
        vertical: Axis::logarithmic("frequency (1/year)"),
        series,
        limits: Vec::new(),
        height: HEIGHT,
    })
}

#[cfg(test)]
mod tests {
    use super::told_apart;

    #[test]
    fn widths_are_told_apart() {
        assert_eq!(
            told_apart(&[20.0, 20.3, 16.68], "mm"),
            ["20 mm", "20.3 mm", "16.68 mm"]
        );
        assert_eq!(told_apart(&[77.459_666_9], "mm"), ["77.46 mm"]);
        assert_eq!(
            told_apart(&[100.001, 100.002], "mm"),
            ["100.001 mm", "100.002 mm"]
        );
        assert_eq!(told_apart(&[], "mm"), Vec::<String>::new());
    }
}
