//! Forces on floors.

use std::f64::consts::TAU;

use pounding_case::{
    Case, CaseError, Dimension, Errors, ForceSource, Located, parse_quantity, unit_in,
};
use pounding_catalogue::wording::counted;
use pounding_time_history::{FloorForce, ForceHistory, System, TimeHistoryError};

use crate::error::AssemblyError;
use crate::number_file::{NumberFile, Numbers, Refused};

/// The most lines of a file of forces.
const MOST_LINES: usize = 2_000_000;

/// Lets the forces of a case act on the floors of a system.
pub(super) fn on_floors(case: &Case, system: System) -> Result<System, AssemblyError> {
    let errors = Errors::default();
    let numbered = case.buildings.iter().enumerate();
    let forces = numbered.flat_map(|(b, building)| building.forces.iter().map(move |f| (b, f)));
    let made = errors.all(forces.map(|(building, force)| {
        Ok(FloorForce {
            building,
            storey: force.value.storey,
            history: history(case, force)?,
            origin: origin(&force.value.source),
        })
    }));
    Ok(system.with_forces(errors.finish(made)?)?)
}

/// Where a force comes from, for the user.
fn origin(source: &ForceSource) -> String {
    match source {
        ForceSource::Constant(_) => "constant".to_owned(),
        ForceSource::Points(_) => String::new(),
        ForceSource::Harmonic { frequency, .. } => format!("{frequency} Hz"),
        ForceSource::File {
            file,
            column,
            time_step,
            ..
        } => {
            let column = column.unwrap_or(usize::from(time_step.is_none()));
            format!("{}, column {}", file.value.display(), column + 1)
        }
    }
}

/// One force over time.
fn history(
    case: &Case,
    force: &Located<pounding_case::FloorForce>,
) -> Result<ForceHistory, CaseError> {
    let given = &force.value;
    let (points, place) = match &given.source {
        ForceSource::Constant(constant) => (vec![(0.0, *constant)], &force.span),
        ForceSource::Points(points) => (points.value.clone(), &points.span),
        ForceSource::Harmonic {
            amplitude,
            frequency,
            phase,
            duration,
            step,
        } => {
            let lines = (duration / step).ceil().max(1.0) as usize;
            let point = |k: usize| {
                let t = duration.min(k as f64 * step);
                (t, amplitude * libm::sin(TAU * frequency * t + phase))
            };
            ((0..=lines).map(point).collect(), &force.span)
        }
        ForceSource::File {
            file,
            column,
            time_step,
            unit,
        } => {
            let read = read(case, file, (*column, *time_step), *unit)?;
            // One point, or a jump; what else is wrong with times is told below.
            let single = read.len() < 3 && read.iter().all(|p| p.0 >= 0.0 && p.0 == read[0].0);
            if single && !given.stays {
                return Err(case.error(
                    file.span.clone(),
                    format!(
                        "{}: points at a single time are a force that lasts no time",
                        file.value.display()
                    ),
                    Some("give the time at which the force ends too, or `stays = true`".to_owned()),
                ));
            }
            (read, &file.span)
        }
    };
    let placed = points
        .iter()
        .map(|(t, force)| (given.delay + t, given.scale * force));
    let points: Vec<(f64, f64)> = placed.collect();
    ForceHistory::new(&points, given.stays).map_err(|e| {
        let reason = match e {
            TimeHistoryError::Force { reason } => reason,
            other => other.to_string(),
        };
        let named = given.source.file();
        let named = named.map_or_else(String::new, |f| format!("{}: ", f.value.display()));
        case.error(
            place.clone(),
            format!("{named}{reason}"),
            Some("give times in their order; two points at one time are a jump".to_owned()),
        )
    })
}

/// Times (s) and forces (N), in the units that the file's names of columns, or else the case, say.
fn read(
    case: &Case,
    file: &Located<std::path::PathBuf>,
    (column, time_step): (Option<usize>, Option<f64>),
    unit: Option<f64>,
) -> Result<Vec<(f64, f64)>, CaseError> {
    let layout = NumberFile {
        what: "force history",
        rows: if time_step.is_some() {
            "one line per time step with numbers between commas, semicolons or tabs"
        } else {
            "one line per point with numbers between commas, semicolons or tabs, the time (s) first; forces at equal steps take `time_step`"
        },
        header: true,
        most: (MOST_LINES, "the most points of a force"),
    };
    let refused = |message: String, help: String| {
        let message = format!("{}: {message}", file.value.display());
        case.error(file.span.clone(), message, Some(help))
    };
    let numbers = layout.read(case, &file.value);
    let Numbers { names, rows } = numbers.map_err(|(message, help)| refused(message, help))?;
    if rows.is_empty() {
        let help = format!("write {}", layout.rows);
        return Err(refused("it holds no numbers".to_owned(), help));
    }
    let columns = rows[0].len();
    if time_step.is_some() && column.is_none() && columns > 1 {
        return Err(refused(
            format!("it has {columns} columns, and `time_step` is for forces without times"),
            "name the column of the force by `column`, or leave `time_step` out where the first column holds the times".to_owned(),
        ));
    }
    let column = column.unwrap_or(usize::from(time_step.is_none()));
    let named = |place: usize, dimension: Dimension| {
        let name = names.as_ref().and_then(|names| names.get(place));
        let unit = name.and_then(|name| unit_of_name(name, dimension).transpose());
        unit.transpose()
            .map_err(|(message, help)| refused(message, help))
    };
    let force_unit = match (named(column, Dimension::FORCE)?, unit) {
        (Some(named), Some(unit)) if named != unit => {
            return Err(refused(
                "the unit in the name of the column is another one than `unit`".to_owned(),
                "leave `unit` out, or correct the name of the column".to_owned(),
            ));
        }
        (named, unit) => named.or(unit).unwrap_or(1.0),
    };
    let time_unit = match time_step {
        None => named(0, Dimension::TIME)?.unwrap_or(1.0),
        Some(_) => 1.0,
    };
    let point = |(k, row): (usize, Vec<f64>)| {
        let force = row.get(column).ok_or_else(|| {
            refused(
                format!(
                    "row {} of its numbers has {}, and the force is in column {}",
                    k + 1,
                    counted(row.len(), "column"),
                    column + 1
                ),
                "name the column of the force, from 1, by `column`; forces at equal steps without times take `time_step`".to_owned(),
            )
        })?;
        let time = match time_step {
            Some(step) => k as f64 * step,
            None => time_unit * row[0],
        };
        Ok((time, force_unit * force))
    };
    rows.into_iter().enumerate().map(point).collect()
}

/// The longest ending of a name, `_ms` in `time_ms`, that must be a unit; longer ones may be words.
const UNIT: usize = 3;

/// Size in SI of the unit in the name of a column, `kN` in `force_kN`, `force (kN)`, `force kN`, `F/kN` and
/// `force in kN`; none where it names no unit.
fn unit_of_name(name: &str, dimension: Dimension) -> Result<Option<f64>, Refused> {
    let base = if dimension == Dimension::TIME {
        "s"
    } else {
        "N"
    };
    let help = || {
        format!("name the column with its unit, such as `{base}` in brackets: `column ({base})`")
    };
    let no_unit = |unit: &str| {
        let message = format!("\"{unit}\" in the column \"{name}\" is no unit of {dimension}");
        Err((message, help()))
    };
    if let Some(factor) = factor_in(name) {
        let message = format!(
            "the name of the column \"{name}\" has a factor, {factor}, which is not applied"
        );
        let help = "write the forces themselves or give the factor as `scale`, and leave it out of the name, as a number that is no factor".to_owned();
        return Err((message, help));
    }
    let (unit, marked) = match (unit_in(name), name.rsplit_once('/')) {
        // What stands behind a stroke, `F/kN`, can be nothing else.
        (None, Some((_, unit))) => (unit.trim(), true),
        (Some(unit), _) => (unit, name.contains(['(', '[']) || unit.len() <= UNIT),
        (None, None) => (last_word(name), false),
    };
    match parse_quantity(&format!("1 {unit}")) {
        Ok(found) if found.dimension == Some(dimension) => return Ok(Some(found.value)),
        // A word that is not marked may be a symbol: `t` of a time is a tonne too.
        Ok(found) if marked => {
            let found = found.dimension.unwrap_or(Dimension::NUMBER);
            let message = format!(
                "the column \"{name}\" is in \"{unit}\", which is {found}, not {dimension}"
            );
            return Err((message, help()));
        }
        Err(_) if marked => return no_unit(unit),
        _ => {}
    }
    let spelled: &[&str] = match dimension == Dimension::TIME {
        true => &["second", "seconds", "sec"],
        false => &["newton", "newtons"],
    };
    if spelled.iter().any(|word| word.eq_ignore_ascii_case(unit)) {
        return Ok(Some(1.0));
    }
    // A unit elsewhere in the name, spelled out or in other letters is not passed over for the SI.
    match words(name).find(|word| is_nearly_unit(word, dimension)) {
        Some(word) => no_unit(word),
        None => Ok(None),
    }
}

/// A factor in the name of a column: `x 1000`, `*1e3`, `1000*F`, `/1000` or `10^3`. A number beside a direction or a place,
/// `Fx 2`, `X1`, `grid A x 100`, `node 10 x`, is none.
fn factor_in(name: &str) -> Option<String> {
    const POWERS: [(&str, &str); 6] = [
        ("\u{207b}\u{b2}", "^-2"),
        ("\u{207b}\u{b3}", "^-3"),
        ("\u{207b}\u{2076}", "^-6"),
        ("\u{b2}", "^2"),
        ("\u{b3}", "^3"),
        ("\u{2076}", "^6"),
    ];
    let mut text = name.to_lowercase().replace("10**", "10^");
    for (raised, power) in POWERS {
        text = text.replace(raised, power);
    }
    // A power of ten multiplies whatever stands before it.
    text = text.replace("10^", "*1e");
    for sign in ['*', '\u{d7}', '\u{b7}', '\u{22c5}', '\u{2219}'] {
        text = text.replace(sign, " * ");
    }
    let text = text.replace('/', " / ").replace(['(', ')', '[', ']'], " ");
    let words = text.split_whitespace();
    let words: Vec<&str> = words.map(|w| if w == "times" { "*" } else { w }).collect();
    let word_at = |place: Option<usize>| place.and_then(|k| words.get(k)).copied();
    for (place, word) in words.iter().enumerate() {
        let (by, number) = match word.strip_prefix('x') {
            Some(number) if !number.is_empty() => (Some("x"), number),
            _ => (word_at(place.checked_sub(1)), *word),
        };
        let Ok(value) = number.parse::<f64>() else {
            continue;
        };
        let [behind, next] = [1, 2].map(|more| word_at(Some(place + more)));
        let power = libm::log10(value.abs());
        let tens = (power - libm::round(power)).abs() < 1.0e-9;
        let is_size = next.is_some_and(|word| word.parse::<f64>().is_ok());
        let is_factor = match (by, behind) {
            (Some("*"), _) | (_, Some("*")) => value != 1.0,
            (Some("x" | "/"), _) => tens && !(0.011..999.0).contains(&value),
            (None, Some("x")) => tens && value != 1.0 && !is_size,
            _ => tens && number.starts_with("10e"),
        };
        if is_factor {
            return Some(number.to_owned());
        }
    }
    None
}

/// The words of a name of a column.
fn words(name: &str) -> impl Iterator<Item = &str> {
    name.split(|c: char| !c.is_alphanumeric())
        .filter(|word| !word.is_empty())
}

fn last_word(name: &str) -> &str {
    words(name).last().unwrap_or_default()
}

/// Whether a word is a unit of a dimension, also spelled out or with other capitals.
fn is_nearly_unit(word: &str, dimension: Dimension) -> bool {
    // The number before a unit, as in `1000N`, belongs to it.
    let word = word.trim_start_matches(|c: char| c.is_ascii_digit());
    let symbols: &[&str] = match dimension == Dimension::TIME {
        true => &["s", "ms", "us", "ns", "min", "msec", "h", "hr"],
        false => &[
            "N", "kN", "MN", "GN", "lbf", "lb", "klbf", "klb", "kip", "kgf", "kg", "tf", "tonf",
            "ton", "dyn", "gf",
        ],
    };
    let names: &[&str] = match dimension == Dimension::TIME {
        true => &["second", "sec", "minute", "hour", "day"],
        false => &["newton", "pound", "kilopond", "tonne", "dyne"],
    };
    let lower = word.to_lowercase();
    let singular = lower.strip_suffix('s').unwrap_or(&lower);
    symbols
        .iter()
        .any(|symbol| symbol.to_lowercase() == lower || symbol.to_lowercase() == singular)
        || names.iter().any(|name| singular.ends_with(name))
}
