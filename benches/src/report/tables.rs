//! Tables of the report.

use std::fmt::Write as _;

use pounding_time_history::GroundAcceleration;
use verification::Failure;

use super::Block;
use crate::methods::sweeping;
use crate::peers::PROTOTYPE;
use crate::precision::{Bound, Point, TARGET, by_method, cheapest};
use crate::scaling::Row;

/// Bounds at which ours is held against the prototype.
const BOUNDS: [Bound; 2] = [TARGET, Bound::OfOwn(1.0e-6)];
/// Columns of the work-precision tables: the larger of both errors.
const LEVELS: [f64; 8] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];

/// Time to reach each level of error.
pub(super) fn work_precision(blocks: &[Block]) -> Result<String, Failure> {
    let mut text = "\n## Time against error\n\nLeast processor time (ms) of a run by a method's \
                    cheapest setting from which all finer ones keep both errors, of peak \
                    displacements and of peak forces, at or below the heading. Empty: not reached.\n"
        .to_owned();
    for b in blocks {
        let families = by_method(&b.points);
        if families.len() < 3 {
            continue;
        }
        write!(text, "\n**{} {}**\n\n| method |", b.case, b.model)?;
        for level in LEVELS {
            write!(text, " {level:e} |")?;
        }
        text += "\n|---|";
        text += &"---|".repeat(LEVELS.len());
        for (name, family) in families {
            write!(text, "\n| {} |", title(name, family[0].ours))?;
            for level in LEVELS {
                match cheapest(&family, Bound::OfLargest(level, level)) {
                    Some(point) => write!(text, " {} |", three(point.milliseconds()))?,
                    None => text += "  |",
                }
            }
        }
        text.push('\n');
    }
    Ok(text)
}

/// The table at equal error.
pub(super) fn equal_error(blocks: &[Block]) -> Result<String, Failure> {
    let mut text = "\n## At equal error\n\nEach method at its cheapest setting from which all \
                    finer ones have errors of at most 1e-4 of the largest peak displacement and \
                    1e-3 of the largest peak force, at every floor and level. \"Times ours\" is against the fastest of ours on that \
                    case, from least times (from medians over the rounds).\n"
        .to_owned();
    for b in blocks {
        let families = by_method(&b.points);
        if families.len() < 3 {
            continue;
        }
        write!(
            text,
            "\n**{} {}**\n\n| method | setting | error of displacement | of force | ms | times ours |\n\
             |---|---|---|---|---|---|\n",
            b.case, b.model
        )?;
        let best = fastest(b, TARGET);
        for (name, family) in families {
            let title = title(name, family[0].ours);
            match (cheapest(&family, TARGET), best) {
                (Some(p), Some(best)) => {
                    let errors = p.errors.ok_or("a point without errors was chosen")?;
                    writeln!(
                        text,
                        "| {title} | {} | {:.0e} | {:.0e} | {} | {} ({}) |",
                        p.parameter,
                        errors.displacement,
                        errors.force,
                        three(p.milliseconds()),
                        three(p.milliseconds() / best.milliseconds()),
                        three(p.median_milliseconds() / best.median_milliseconds()),
                    )?;
                }
                _ => {
                    let finest = family.last().map_or("", |p| p.parameter.as_str());
                    writeln!(text, "| {title} | not met down to {finest} | | | | |")?;
                }
            }
        }
    }
    Ok(text)
}

/// The fastest of ours that keeps the bound.
pub(super) fn fastest(block: &Block, bound: Bound) -> Option<&Point> {
    let ours = by_method(&block.points)
        .into_iter()
        .filter(|(_, family)| family[0].ours);
    ours.filter_map(|(_, family)| cheapest(&family, bound))
        .min_by(|a, b| a.milliseconds().total_cmp(&b.milliseconds()))
}

/// Ours over the prototype.
pub(super) fn prototype_ratios(blocks: &[Block]) -> Result<String, Failure> {
    let mut text = "\n## Ours over the event-driven prototype\n\nTime of the fastest of ours over \
                    that of `peer.c evd -o P`, each at its cheapest setting for the error \
                    named: first that of the tables above, then 1e-6 in every single peak, \
                    relative to its own value. The prototype keeps its propagators from an \
                    earlier run.\n\n\
                    | case | model | 1e-4 and 1e-3: ours (ms) | prototype (ms) | ratio | 1e-6: ours (ms) | prototype (ms) | ratio |\n\
                    |---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for b in blocks {
        write!(text, "| {} | {} |", b.case, b.model)?;
        let families = by_method(&b.points);
        let prototype = families.iter().find(|(name, _)| *name == PROTOTYPE);
        for bound in BOUNDS {
            let ours = fastest(b, bound);
            let other = prototype.and_then(|(_, family)| cheapest(family, bound));
            let cell = |p: Option<&Point>| match p {
                Some(p) => format!("{} ({} {})", three(p.milliseconds()), p.method, p.parameter),
                None => "not met".to_owned(),
            };
            let theirs = other.map_or("not met".to_owned(), |p| three(p.milliseconds()));
            let ratio = match (ours, other) {
                (Some(a), Some(b)) => three(a.milliseconds() / b.milliseconds()),
                _ => String::new(),
            };
            write!(text, " {} | {theirs} | {ratio} |", cell(ours))?;
        }
        text.push('\n');
    }
    Ok(text)
}

pub(super) fn table(
    label: &str,
    ground: &GroundAcceleration,
    rows: &[Row],
) -> Result<String, Failure> {
    let mut text = format!("| {label} | floors | impacts |");
    let methods = sweeping(ground.time_step);
    for (name, _) in &methods {
        write!(text, " **{name}** |")?;
    }
    writeln!(text, " {PROTOTYPE} 1e-8 |")?;
    writeln!(text, "|---|---|---|---|{}", "---|".repeat(methods.len()))?;
    for row in rows {
        let each = (row.storeys * row.samples) as f64;
        let cell = |s: f64| format!("{} ({})", three(1.0e3 * s), three(1.0e9 * s / each));
        write!(
            text,
            "| {} | {} | {} |",
            row.label, row.storeys, row.impacts
        )?;
        for seconds in &row.seconds {
            write!(text, " {} |", cell(*seconds))?;
        }
        writeln!(text, " {} |", row.prototype.map_or(String::new(), cell))?;
    }
    Ok(text)
}

pub(super) fn title(name: &str, ours: bool) -> String {
    if ours {
        format!("**{name}**")
    } else {
        name.to_owned()
    }
}

/// Three digits, as a number and not with an exponent.
pub(super) fn three(value: f64) -> String {
    if !value.is_finite() {
        return "?".to_owned();
    }
    let digits = if value >= 100.0 {
        0
    } else if value >= 10.0 {
        1
    } else if value >= 1.0 {
        2
    } else {
        3
    };
    format!("{value:.digits$}")
}
