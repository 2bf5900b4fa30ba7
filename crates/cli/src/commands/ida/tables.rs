//! Tables of an incremental dynamic analysis.

use pounding_catalogue::wording::counted;
use pounding_study::{FragilityFit, IdaReport, IdaSettings, LimitResult, PoundingDemand};

use crate::tables::{Table, new_table};

/// The report for people.
pub fn report(report: &IdaReport, settings: &IdaSettings) -> String {
    let mut text = format!(
        "\n{} in {}, {}; 16, 50 and 84 % fractiles (SI)\n{}\n",
        report.measure,
        report.unit,
        counted(report.records, "record"),
        levels(report)
    );
    text.push_str(&format!(
        "\nFragility: lognormal, maximum likelihood; bounds at {} % confidence\n{}\n",
        settings.confidence * 100.0,
        limits(report, settings)
    ));
    for gap in &report.gaps {
        let collapsed = report.levels.iter().any(|l| l.collapsed > 0);
        text.push_str(&widths(gap, settings, collapsed));
    }
    if report.gaps.iter().filter(|g| !g.widths.is_empty()).count() > 1 {
        text.push_str("Widths of each gap of the row as if the others were wide enough: a building that is hit on one side can close the gap on its other side.\n");
    }
    text
}

fn levels(report: &IdaReport) -> Table {
    let mut header = vec!["intensity".to_owned(), "runs".to_owned()];
    let with_failures = report.levels.iter().any(|l| l.failed > 0);
    let with_collapses = report.levels.iter().any(|l| l.collapsed > 0);
    if with_failures {
        header.push("failed".to_owned());
    }
    if with_collapses {
        header.push("collapsed".to_owned());
    }
    header.extend(
        report
            .demands
            .iter()
            .map(|(name, unit)| match unit.as_str() {
                "1" => name.clone(),
                _ => format!("{name} ({unit})"),
            }),
    );
    let mut table = new_table(header);
    for level in &report.levels {
        let mut cells = vec![digits(level.intensity), level.runs.to_string()];
        if with_failures {
            cells.push(level.failed.to_string());
        }
        if with_collapses {
            cells.push(level.collapsed.to_string());
        }
        cells.extend(level.fractiles.iter().map(|f| f.map(digits).join(" ")));
        table.add_row(cells);
    }
    table
}

fn limits(report: &IdaReport, settings: &IdaSettings) -> Table {
    let limits = report
        .limits
        .iter()
        .map(|limit| (limit.name.clone(), limit));
    states(["state", "reached of runs, by intensity"], limits, settings)
}

/// How often states are reached, and their fragilities, below two headings.
fn states<'s>(
    [name, reached]: [&str; 2],
    states: impl Iterator<Item = (String, &'s LimitResult)>,
    settings: &IdaSettings,
) -> Table {
    let mut header = vec![name, reached, "median", "dispersion"];
    if settings.hazard.is_some() {
        header.push("mean annual frequency");
    }
    let mut table = new_table(header);
    for (name, state) in states {
        let mut cells = vec![name, counts(state)];
        cells.extend(fitted(state, settings.confidence));
        if settings.hazard.is_some() {
            cells.push(frequency(state));
        }
        table.add_row(cells);
    }
    table
}

fn widths(gap: &PoundingDemand, settings: &IdaSettings, collapsed: bool) -> String {
    let mut text = String::new();
    if !gap.widths.is_empty() {
        let widths = gap.widths.iter();
        let widths = widths.map(|w| (format!("{:.1}", w.width * 1e3), &w.result));
        let header = ["gap (mm)", "pounding of runs, by intensity"];
        let table = states(header, widths, settings);
        text.push_str(&format!(
            "\nPounding of {} by width of the gap\n{table}\n",
            gap.gap
        ));
    }
    if let (Some(minimum), Some(target)) = (gap.minimum, settings.target_frequency) {
        text.push_str(&match minimum.width {
            Some(width) => format!(
                "Least gap of {} for a mean annual frequency of {}: {:.1} mm, with {}\n",
                gap.gap,
                digits(target),
                width * 1e3,
                digits(minimum.frequency)
            ),
            None => format!(
                "The intensities do not reach far enough{} to find the gap of {} for a mean annual frequency of {}: the least that they can show is {}\n",
                if collapsed {
                    ", or the buildings collapse too often by themselves,"
                } else {
                    ""
                },
                gap.gap,
                digits(target),
                digits(minimum.frequency)
            ),
        });
    }
    text
}

fn counts(limit: &LimitResult) -> String {
    let shown = limit
        .counts
        .iter()
        .map(|c| format!("{}/{}", c.reached, c.runs));
    shown.collect::<Vec<_>>().join(" ")
}

/// The mean annual frequency, or why there is none.
fn frequency(limit: &LimitResult) -> String {
    match (limit.frequency, limit.fit) {
        (Some(frequency), _) => digits(frequency),
        (None, FragilityFit::Always { from }) => {
            format!("- (all reach it already at {})", digits(from))
        }
        (None, _) => "- (no fragility)".to_owned(),
    }
}

/// Median and dispersion with their bounds, or why there are none.
fn fitted(limit: &LimitResult, confidence: f64) -> [String; 2] {
    let with = |value: f64, bounds: [f64; 2]| {
        format!(
            "{} ({}..{})",
            digits(value),
            digits(bounds[0]),
            digits(bounds[1])
        )
    };
    match limit.fit {
        FragilityFit::Lognormal(f) => [
            with(f.median, f.median_bounds(confidence)),
            with(f.dispersion, f.dispersion_bounds(confidence)),
        ],
        FragilityFit::Step { lower, upper } if upper.is_finite() => [
            format!("between {} and {}", digits(lower), digits(upper)),
            "-".to_owned(),
        ],
        FragilityFit::Step { lower, .. } => [format!("above {}", digits(lower)), "-".to_owned()],
        FragilityFit::Never { up_to } => [format!("above {}", digits(up_to)), "-".to_owned()],
        FragilityFit::Always { from } => [format!("below {}", digits(from)), "-".to_owned()],
        FragilityFit::None => ["none".to_owned(), "-".to_owned()],
    }
}

/// Four significant digits.
fn digits(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || !x.is_finite() {
        format!("{x}")
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.3e}")
    }
}
