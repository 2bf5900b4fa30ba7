//! Tables of an incremental dynamic analysis.

use pounding_catalogue::numbers::{rounded_up, width_in_millimetres};
use pounding_catalogue::wording::counted;
use pounding_study::{
    FitRemark, FragilityFit, FrequencyBounds, IdaReport, IdaSettings, LimitResult, POOR,
    PoundingDemand, bootstrap_sets,
};

use crate::tables::{Table, new_table};

/// The report for people.
pub fn report(report: &IdaReport, settings: &IdaSettings) -> String {
    let mut text = format!(
        "\n{} in {}, {}{}; 16, 50 and 84 % fractiles of demands (SI)\n{}\n",
        report.measure,
        report.shown_intensity().1,
        counted(report.records, "record"),
        match report.structures {
            Some(structures) => format!(", {}", counted(structures, "structure")),
            None => String::new(),
        },
        levels(report)
    );
    for remark in &report.remarks {
        text.push_str(&format!("  {remark}\n"));
    }
    text.push_str(&format!(
        "\nFragility: lognormal, maximum likelihood, medians in {}; bounds at {} % confidence\n{}\n",
        report.shown_intensity().1,
        settings.confidence * 100.0,
        limits(report, settings)
    ));
    text.push_str(&how_frequencies_are_bounded(report, settings));
    text.push_str(&poor_fits(
        report,
        report.limits.iter().map(|l| (l.name.clone(), l)),
    ));
    for gap in &report.gaps {
        let collapsed = report.levels.iter().any(|l| l.collapsed > 0);
        text.push_str(&widths(report, gap, settings, collapsed));
    }
    if report.gaps.iter().filter(|g| !g.widths.is_empty()).count() > 1 {
        text.push_str("Widths of each gap of the row as if the others were wide enough: a building that is hit on one side can close the gap on its other side.\n");
    }
    if let Some(together) = &report.least_gaps_together {
        let frequency = match together.frequency.is_some() {
            true => frequency(together, report.shown_intensity()),
            false => "none that the counts give".to_owned(),
        };
        text.push_str(&format!(
            "All gaps at these least widths: one of them closes with a mean annual frequency of {frequency}. A target for all of them together asks for wider ones.\n"
        ));
    }
    text
}

fn levels(report: &IdaReport) -> Table {
    let unit = report.shown_intensity().1;
    let mut header = vec![format!("intensity ({unit})"), "runs".to_owned()];
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
        let intensity = level.intensity / report.shown_intensity().0;
        let mut cells = vec![digits(intensity), level.runs.to_string()];
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
    states(
        report,
        ["state", "reached of runs, by intensity"],
        limits,
        settings,
    )
}

/// How often states are reached, and their fragilities, below two headings.
fn states<'s>(
    report: &IdaReport,
    [name, reached]: [&str; 2],
    states: impl Iterator<Item = (String, &'s LimitResult)>,
    settings: &IdaSettings,
) -> Table {
    let median = format!("median ({})", report.shown_intensity().1);
    let mut header = vec![name, reached, &median, "dispersion", "fit"];
    if settings.hazard.is_some() {
        header.push("mean annual frequency");
    }
    let mut table = new_table(header);
    for (name, state) in states {
        let mut cells = vec![name, counts(state)];
        let (scale, unit) = report.shown_intensity();
        cells.extend(fitted(state, settings.confidence, scale));
        cells.push(quality(state));
        if settings.hazard.is_some() {
            cells.push(frequency(state, (scale, unit)));
        }
        table.add_row(cells);
    }
    table
}

/// What the bounds of frequencies are.
fn how_frequencies_are_bounded(report: &IdaReport, settings: &IdaSettings) -> String {
    let widths = report.gaps.iter().flat_map(|gap| &gap.widths);
    let mut states = report.limits.iter().chain(widths.map(|w| &w.result));
    let stands = |b: FrequencyBounds| b.low.or(b.high).is_some();
    let sets = bootstrap_sets(settings.confidence);
    let Some(sets) = sets.filter(|_| states.any(|s| s.frequency_bounds.is_some_and(stands))) else {
        return String::new();
    };
    format!(
        "Bounds of mean annual frequencies: percentiles of a bootstrap over records ({sets} sets, fixed seed) at {} % confidence; the hazard is taken as known.\n",
        settings.confidence * 100.0
    )
}

/// Whether the test lets a fit stand.
fn quality(state: &LimitResult) -> String {
    match (state.fit, state.goodness) {
        (FragilityFit::Lognormal(_), Some(test)) => {
            let word = if test.p_value < POOR { "POOR, " } else { "" };
            format!("{word}p {}", probability(test.p_value))
        }
        (FragilityFit::Lognormal(_), None) => "not tested".to_owned(),
        _ => "-".to_owned(),
    }
}

fn probability(p: f64) -> String {
    if p < 1e-3 {
        "< 0.001".to_owned()
    } else {
        format!("= {p:.3}")
    }
}

/// What must be said of fits, with the counted fractions beside the fitted ones.
fn poor_fits<'s>(
    report: &IdaReport,
    states: impl Iterator<Item = (String, &'s LimitResult)>,
) -> String {
    let mut text = String::new();
    let (scale, unit) = report.shown_intensity();
    // What holds for most states where it holds for one is said once, with their names.
    let mut together: Vec<(FitRemark, Vec<String>)> = Vec::new();
    let mut at_most = false;
    for (name, state) in states.filter(|(_, s)| !s.remarks.is_empty()) {
        for remark in &state.remarks {
            match remark {
                FitRemark::NotTested(_)
                | FitRemark::FewRecords { .. }
                | FitRemark::NoBoundsSoSure { .. } => {
                    match together.iter_mut().find(|(said, _)| said == remark) {
                        Some((_, names)) => names.push(name.clone()),
                        None => together.push((*remark, vec![name.clone()])),
                    }
                }
                FitRemark::AtMost { .. } => at_most = true,
                remark => text.push_str(&format!("  {name}: {remark}\n")),
            }
        }
        let shows = |r: &FitRemark| {
            let of_counts = matches!(r, FitRemark::NotTested(_) | FitRemark::Returns { .. });
            !of_counts && !r.is_of_frequency()
        };
        let FragilityFit::Lognormal(fit) = state.fit else {
            continue;
        };
        if !state.remarks.iter().any(shows) {
            continue;
        }
        let made = state.counts.iter().filter(|c| c.runs > 0);
        // Where both are none or all there is nothing to see.
        let made = made.filter(|c| {
            let fitted = fit.probability(c.intensity);
            (0.005..0.995).contains(&fitted) || (c.reached > 0 && c.reached < c.runs)
        });
        let pairs = made.map(|c| {
            format!(
                "{} {unit} {:.2}/{:.2}",
                digits(c.intensity / scale),
                c.reached as f64 / c.runs as f64,
                fit.probability(c.intensity)
            )
        });
        let pairs: Vec<String> = pairs.collect();
        text.push_str(&format!("    counted/fitted: {}\n", pairs.join(", ")));
    }
    for (remark, names) in together {
        text.push_str(&format!("  {}: {remark}\n", names.join(", ")));
    }
    if at_most {
        text.push_str(
            "  \"at most\": the counts give no curve; the frequency is that of a state which is reached right above the highest intensity at which no record of the study reaches it\n",
        );
    }
    text
}

fn widths(
    report: &IdaReport,
    gap: &PoundingDemand,
    settings: &IdaSettings,
    collapsed: bool,
) -> String {
    let mut text = String::new();
    if !gap.widths.is_empty() {
        let widths = gap.widths.iter();
        let widths = widths.map(|w| (width_in_millimetres(w.width), &w.result));
        let header = ["gap (mm)", "pounding of runs, by intensity"];
        let table = states(report, header, widths, settings);
        text.push_str(&format!(
            "\nPounding of {} by width of the gap\n{table}\n",
            gap.gap
        ));
        let named = gap.widths.iter();
        let named = named.map(|w| (format!("{} mm", width_in_millimetres(w.width)), &w.result));
        text.push_str(&poor_fits(report, named));
    }
    if let (Some(minimum), Some(target)) = (&gap.minimum, settings.target_frequency) {
        let frequency = match minimum.frequency().is_finite() {
            true => frequency(&minimum.result, report.shown_intensity()),
            false => "none that the counts give".to_owned(),
        };
        text.push_str(&match minimum.width {
            Some(width) => format!(
                "Least gap of {} for a mean annual frequency of {}: {}{} mm, with {frequency}\n",
                gap.gap,
                digits(target),
                if minimum.is_at_most() { "at most " } else { "" },
                rounded_up(width * 1e3, 1),
            ),
            None => format!(
                "The {} not reach far enough{} to find the gap of {} for a mean annual frequency of {}: even a gap as wide as the maximum demand has {frequency}\n",
                match minimum.hazard_begins {
                    Some(_) => "hazard curve does",
                    None => "intensities do",
                },
                if collapsed {
                    ", or the buildings collapse too often by themselves,"
                } else {
                    ""
                },
                gap.gap,
                digits(target),
            ),
        });
        let remarks = minimum.remarks();
        text.extend(remarks.iter().map(|said| format!("  {said}\n")));
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
fn frequency(limit: &LimitResult, (scale, unit): (f64, &str)) -> String {
    match (limit.frequency, limit.fit) {
        (Some(frequency), _) if limit.frequency_is_at_most() => {
            format!("at most {}", digits(frequency))
        }
        (Some(frequency), _) => match limit.frequency_bounds {
            Some(bounds) if bounds.low.or(bounds.high).is_some() => {
                let shown = |bound: Option<f64>| bound.map_or("?".to_owned(), digits);
                let (low, high) = (shown(bounds.low), shown(bounds.high));
                format!("{} ({low}..{high})", digits(frequency))
            }
            _ => digits(frequency),
        },
        (None, FragilityFit::Always { from }) => {
            format!(
                "- (all reach it already at {} {unit})",
                digits(from / scale)
            )
        }
        (None, FragilityFit::Step { .. }) => {
            "- (some reach it already at the lowest intensity)".to_owned()
        }
        (None, _) => "- (no fragility)".to_owned(),
    }
}

/// Median and dispersion with their bounds, or why there are none.
fn fitted(limit: &LimitResult, confidence: f64, scale: f64) -> [String; 2] {
    let intensity = |x: f64| digits(x / scale);
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
            with(
                f.median / scale,
                f.median_bounds(confidence).map(|b| b / scale),
            ),
            with(f.dispersion, f.dispersion_bounds(confidence)),
        ],
        FragilityFit::Step { lower, upper } if lower <= 0.0 => [
            match upper.is_finite() {
                true => format!("below {}", intensity(upper)),
                false => "not known: one intensity".to_owned(),
            },
            "-".to_owned(),
        ],
        FragilityFit::Step { lower, upper } if upper.is_finite() => [
            format!("between {} and {}", intensity(lower), intensity(upper)),
            "-".to_owned(),
        ],
        FragilityFit::Step { lower, .. } => [format!("above {}", intensity(lower)), "-".to_owned()],
        FragilityFit::Never { up_to } => [format!("above {}", intensity(up_to)), "-".to_owned()],
        FragilityFit::Always { from } => [format!("below {}", intensity(from)), "-".to_owned()],
        FragilityFit::None => ["none".to_owned(), "-".to_owned()],
    }
}

/// Four significant digits.
fn digits(x: f64) -> String {
    let size = x.abs();
    if x.is_nan() {
        "-".to_owned()
    } else if x == 0.0 || !x.is_finite() {
        format!("{x}")
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (3 - size.log10().floor() as i32).clamp(0, 6) as usize;
        format!("{x:.decimals$}")
    } else {
        format!("{x:.3e}")
    }
}
