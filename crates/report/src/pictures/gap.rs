//! Gaps of several widths, and the spectra of their records.

use pounding_catalogue::STANDARD_GRAVITY as G;
use pounding_catalogue::numbers::width_in_millimetres;
use pounding_study::gap_check::{Amplification, GapCheck};

use crate::chart::{Axis, Chart, HEIGHT, Limit, LimitPlace, Look, Plot, Series};
use crate::page::figures_that_suffice;

/// Maximum amplification over storeys and records, over the width of a gap, a panel for each
/// quantity with a curve for each building; values that are not finite are left out. The
/// provided and the required widths and the amplification 1.0 are marked. Quantities of which no
/// building has a value have no panel. `None` for a check that tried no widths, or without any value.
#[must_use]
pub fn amplifications(check: &GapCheck) -> Option<Chart> {
    let (sweep, first) = (check.sweep.as_ref()?, check.records.first()?);
    let of_records = match check.records.len() {
        1 => "",
        _ => " and records",
    };
    let limits = limits(check, sweep.gap.as_deref());
    let plots = Amplification::QUANTITIES.map(|(quantity, of)| {
        let curves = first.isolated.iter().enumerate().map(|(index, building)| {
            let points = sweep.widths.iter().enumerate().filter_map(|(i, width)| {
                let value = sweep.over_records(i, index, of)?;
                value.is_finite().then_some((width * 1e3, value))
            });
            Series {
                name: format!("{}, with pounding", building.name),
                points: points.collect(),
                look: Look::line(index),
            }
        });
        Plot {
            heading: format!("Amplification of {quantity} (-), maximum over storeys{of_records}"),
            horizontal: Axis::linear("width of the gap (mm)"),
            vertical: Axis::linear(""),
            series: curves.filter(|c: &Series| !c.points.is_empty()).collect(),
            limits: limits.clone(),
            height: HEIGHT,
        }
    });
    let mut plots = Vec::from(plots);
    plots.retain(|plot| !plot.series.is_empty());
    (!plots.is_empty()).then(|| Chart::of_page(plots))
}

/// What stands in the place of [`amplifications`] where there are none.
#[must_use]
pub fn no_amplification() -> Chart {
    Chart::of_page(vec![Plot {
        heading: "No amplification is known: no building moves, or no width was tried".to_owned(),
        horizontal: Axis::linear("width of the gap (mm)"),
        vertical: Axis::linear(""),
        series: Vec::new(),
        limits: Vec::new(),
        height: HEIGHT,
    }])
}

/// The isolated buildings, and the widths that are provided and required of the gaps that vary.
fn limits(check: &GapCheck, varied: Option<&str>) -> Vec<Limit> {
    let mut limits = vec![Limit {
        name: "1.0: isolated".to_owned(),
        at: LimitPlace::Vertical(1.0),
        look: Look::limit("1 1.5"),
    }];
    let mut gaps = check.gaps.iter();
    // Widths of several gaps that vary together are those of the widest demand.
    let by_demand = |a: &&pounding_study::gap_check::GapReport,
                     b: &&pounding_study::gap_check::GapReport| {
        a.suite.maximum.total_cmp(&b.suite.maximum)
    };
    let gap = match varied {
        Some(name) => gaps.find(|g| g.name == name),
        None => gaps.max_by(by_demand),
    };
    let Some(gap) = gap else {
        return limits;
    };
    let mut add = |name: String, width: f64, dash| {
        limits.push(Limit {
            name,
            at: LimitPlace::Horizontal(width * 1e3),
            look: Look::limit(dash),
        });
    };
    let level = &gap.levels[gap.governing.level];
    // A width of the sweep is that of all levels.
    let provided = match gap.of_one_width() {
        true => "provided".to_owned(),
        false => format!("provided at level {}:", level.place.label()),
    };
    add(
        format!("{provided} {} mm", width_in_millimetres(level.width)),
        level.width,
        "",
    );
    // As the sentences of the page have it.
    let required = |by: &str, width: f64| {
        let shown = figures_that_suffice(width * 1e3);
        format!("required by {by} {shown} mm")
    };
    let by_code = gap.code.as_ref().map(|code| {
        let widths = code.deciding().filter_map(|case| case.governing());
        // Readings of a disputed rule are no required width.
        let requirements = widths.map(|(_, level)| &level.width.requirement);
        let widths = requirements
            .filter(|r| r.readings.is_empty())
            .map(|r| r.width);
        (code.code.name.as_str(), widths.reduce(f64::max))
    });
    match by_code {
        Some((code, Some(width))) => add(required(code, width), width, "7 3"),
        Some((_, None)) => {}
        None => {
            if let Some(width) = gap.required.by_count {
                add(required("the records", width), width, "7 3");
            }
        }
    }
    limits
}

/// Pseudo-accelerations of the records of a check as they are used, their mean, and the target
/// to which the case scales them, over 200 periods.
pub fn spectra(check: &GapCheck) -> Chart {
    let spectra = &check.spectra;
    let over = |values: &[f64]| -> Vec<(f64, f64)> {
        let pairs = spectra.periods.iter().zip(values);
        pairs.map(|(t, a)| (*t, a / G)).collect()
    };
    let suite = spectra.records.len() > 1;
    let mut series: Vec<Series> = Vec::new();
    for (number, record) in spectra.records.iter().enumerate() {
        series.push(Series {
            name: match (suite, number) {
                (true, 0) => format!("{} records", spectra.records.len()),
                (true, _) => String::new(),
                (false, _) => spectra.names[number].clone(),
            },
            points: over(record),
            look: if suite {
                Look::one_of_many()
            } else {
                Look::line(0)
            },
        });
    }
    if suite {
        series.push(Series {
            name: "mean".to_owned(),
            points: over(&spectra.mean),
            look: Look::summary(""),
        });
    }
    let mut limits = Vec::new();
    if let Some(target) = &spectra.target {
        let known = spectra.periods.iter().zip(&target.values);
        series.push(Series {
            name: format!("target: {}", target.name),
            points: known.filter_map(|(t, a)| Some((*t, (*a)? / G))).collect(),
            look: Look::reference(0),
        });
        for (name, period) in [("band of the scale", target.band.0), ("", target.band.1)] {
            limits.push(Limit {
                name: name.to_owned(),
                at: LimitPlace::Horizontal(period),
                look: Look::limit("1 1.5"),
            });
        }
    }
    let damping = spectra.damping * 100.0;
    let plot = Plot {
        heading: String::new(),
        horizontal: Axis::logarithmic("period (s)"),
        vertical: Axis::linear(&format!("pseudo-acceleration (g), {damping:.0} % damping")),
        series,
        limits,
        height: 1.5 * HEIGHT,
    };
    Chart::of_page(vec![plot])
}
