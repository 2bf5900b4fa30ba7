//! Why a line that names columns is not the header of an acceleration.

use super::column_name::{Kind, Role, divided, kind, quantity, role};
use super::header::Cells;
use super::names::{
    ACCELERATION, TIME, are_of_spectrum, has_factor, is_abscissa, is_channel, is_component,
    is_of_no_motion, is_spectral, motion, motion_unit, plain, time_unit, unquoted,
};
use crate::header_keys::{Entry, keyed};
use crate::quantity::{Multiple, NamedWithUnit, Quantity, named_with_unit, of_something_else};

/// Why a line that names columns is not the header of an acceleration.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fault {
    /// Its columns are known, and none is an acceleration: the name of one that is not.
    NoAcceleration(Quantity, String),
    /// The columns of a spectrum: the name of one.
    Spectrum(String),
    /// Names of columns of which none is a motion: that of one.
    Foreign(String),
    /// A column of times in a unit that is not known: name of the column, unit.
    TimeUnit(String, String),
    /// A column of motion in a unit that is not known: name of the column, unit.
    MotionUnit(String, String),
    /// A column of accelerations whose name has a factor or a sign.
    Factor(String),
    /// Two columns of times.
    TwoTimes,
    /// A column of which nothing is known: its number from 1, its name.
    Column(usize, String),
}

/// What is wrong with a line that names columns but is no header; `None` for prose, which
/// names no column with a unit.
pub(super) fn fault_of(cells: &Cells) -> Option<(String, Fault)> {
    let said = |fault| Some((cells.text.clone(), fault));
    let other = of_values(cells).or_else(|| of_spectrum(cells));
    if let Some(fault) = other.or_else(|| of_factor(cells)) {
        return said(fault);
    }
    let names = &cells.names;
    let roles: Vec<Option<Role>> = names.iter().map(|c| role(c)).collect();
    let unknown_unit = names.iter().zip(&roles).find_map(|(name, role)| {
        let (known, unit) = divided(name).filter(|_| role.is_none())?;
        // What follows a blank is a word of a sentence unless it is known as a unit.
        if !name.contains(['(', '[', '_']) {
            return None;
        }
        let name = name.trim().to_owned();
        if TIME.contains(&known.as_str()) {
            return time_unit(&unit)
                .is_none()
                .then_some(Fault::TimeUnit(name, unit));
        }
        let moves = ACCELERATION.contains(&known.as_str())
            || motion(&known).is_some()
            || name.contains(['(', '[']) && is_channel(&known);
        (moves && motion_unit(&unit).is_none()).then_some(Fault::MotionUnit(name, unit))
    });
    let bare = |name: &String| {
        let known = plain(name);
        TIME.contains(&known.as_str()) || motion(&known).is_some()
    };
    // Names between blanks that have no unit may be words of a sentence, as may one alone.
    let with_unit = names.iter().zip(&roles).any(|(name, role)| {
        role.is_some() && (divided(name).is_some() || cells.separator.is_some() && bare(name))
    });
    // Unless all are names of columns, of which one is the time.
    let all_named = roles.iter().all(Option::is_some)
        && roles.iter().any(|r| matches!(r, Some(Role::Time(_))))
        && !roles
            .iter()
            .any(|r| matches!(r, Some(Role::Acceleration(..))));
    // `Acceleration (g x 1000)`: the unit is stated, and why it is not used is what to say.
    if let ([_], Some(Fault::MotionUnit(_, unit))) = (names.as_slice(), &unknown_unit)
        && Multiple::parse(unit).is_some_and(|m| !m.may_be_level)
    {
        return unknown_unit.and_then(said);
    }
    if names.len() < 2 || !(with_unit || all_named || unknown_unit.is_some()) {
        return None;
    }
    let fault = if let Some(fault) = unknown_unit {
        fault
    } else if let Some(k) = roles.iter().position(Option::is_none) {
        Fault::Column(k + 1, names[k].trim().to_owned())
    } else if roles
        .iter()
        .any(|r| matches!(r, Some(Role::Acceleration(..))))
    {
        // The header is wrong in that alone, or it is right.
        let times = roles.iter().filter(|r| matches!(r, Some(Role::Time(_))));
        (times.count() > 1).then_some(Fault::TwoTimes)?
    } else {
        let moving = |name: &String| Some((quantity(name)?, name.trim().to_owned()));
        let (quantity, name) = names.iter().find_map(moving)?;
        Fault::NoAcceleration(quantity, name)
    };
    said(fault)
}

/// Names of columns without times, `Displacement Force`, of which each is that of a velocity, a displacement, the
/// number of a row or no motion at all.
pub(super) fn of_no_acceleration(cells: &Cells) -> Option<Fault> {
    let names = &cells.names;
    // `Distance (km)=35` is a key with its value.
    if cells.separator.is_none() && has_value(cells) {
        return None;
    }
    // A letter alone may be a direction.
    let moves = |name: &&String| {
        let is_word = unquoted(name).chars().count() > 1;
        is_word && role(name) == Some(Role::Other)
    };
    if !names
        .iter()
        .all(|name| is_of_no_motion(name) || moves(&name))
    {
        return None;
    }
    let other = names.iter().find(|name| is_of_no_motion(name));
    if let Some(name) = other {
        return Some(Fault::Foreign(unquoted(name).to_owned()));
    }
    let moving = |name: &String| Some((quantity(name)?, unquoted(name).to_owned()));
    let (quantity, name) = names.iter().filter(|_| names.len() > 1).find_map(moving)?;
    Some(Fault::NoAcceleration(quantity, name))
}

/// An acceleration, or times, whose name has a factor or a sign: with its unit in brackets, or beside times. Names may
/// have several words.
fn of_factor(cells: &Cells) -> Option<Fault> {
    let mut apart = cells.several_words();
    of_factor_in(cells).or_else(|| apart.find_map(|cells| of_factor_in(&cells)))
}

fn of_factor_in(cells: &Cells) -> Option<Fault> {
    let is_time = |name: &String| matches!(role(name), Some(Role::Time(_)));
    let beside_times = cells.separator.is_some() && cells.names.iter().any(is_time);
    let accelerates = |name: &str| {
        let has_brackets = name.contains(['(', '[']);
        let unit = divided(name).filter(|_| has_brackets).map(|(_, unit)| unit);
        if unit
            .as_deref()
            .is_some_and(|unit| time_unit(unit).is_some())
        {
            return true;
        }
        match unit.and_then(|unit| motion_unit(&unit)) {
            Some(unit) => unit.quantity == Quantity::Acceleration,
            None => beside_times && !has_brackets,
        }
    };
    let mut found = cells.names.iter().map(|name| unquoted(name));
    found
        .find(|name| accelerates(name) && has_factor(name))
        .map(|name| Fault::Factor(name.to_owned()))
}

/// Whether a number stands under a key of the line.
fn has_value(cells: &Cells) -> bool {
    let lower = cells.text.to_lowercase();
    keyed(&lower).iter().any(Entry::has_number)
}

/// The columns of a spectrum, or of times beside what is no motion.
fn of_spectrum(cells: &Cells) -> Option<Fault> {
    let names = &cells.names;
    // `Frequency (Hz): 200` is a key with its value.
    if has_value(cells) {
        return None;
    }
    if are_of_spectrum(names, cells.separator) {
        let named = names.iter().find(|n| is_spectral(n)).unwrap_or(&names[0]);
        return Some(Fault::Spectrum(unquoted(named).to_owned()));
    }
    let kinds: Vec<Kind> = names.iter().map(|c| kind(c)).collect::<Option<_>>()?;
    let accelerates = |k: &Kind| matches!(k, Kind::Known(Role::Acceleration(..)) | Kind::Component);
    if kinds.iter().any(accelerates) && !names.iter().any(|n| is_abscissa(n)) {
        return None;
    }
    // Words of a sentence are none of these.
    if kinds.iter().any(|k| matches!(k, Kind::Unknown)) {
        return None;
    }
    if let Some(name) = names.iter().find(|n| is_spectral(n)) {
        let with_unit = names.len() > 1 || name.contains(['(', '[', '_']);
        return with_unit.then(|| Fault::Spectrum(unquoted(name).to_owned()));
    }
    let timed = kinds
        .iter()
        .any(|k| matches!(k, Kind::Known(Role::Time(_))));
    let other = |k: &Kind| matches!(k, Kind::Known(Role::Time(_)) | Kind::Foreign);
    if !timed || !kinds.iter().all(other) {
        return None;
    }
    let (name, _) = names
        .iter()
        .zip(&kinds)
        .find(|(_, k)| matches!(k, Kind::Foreign))?;
    Some(Fault::Foreign(unquoted(name).to_owned()))
}

/// The velocity or displacement that a line names as the quantity of the values below it: alone,
/// `Velocity (cm/s)`, at the end of a title, `EL CENTRO NS VELOCITY CM/SEC`, or as a series,
/// `VELOCITY TIME HISTORY`. Titles of accelerations may speak of velocities, too: `shear wave
/// velocity 200 m/s`.
fn of_values(cells: &Cells) -> Option<Fault> {
    if let [name] = cells.names.as_slice() {
        let (known, unit) = divided(name).unwrap_or_else(|| (plain(name), String::new()));
        let moves = motion(&known).is_some() || is_component(&known);
        // A letter alone is no name of a quantity.
        let says = moves && !unit.is_empty() || motion(&known).is_some() && known.len() > 1;
        if let Some(quantity) = quantity(name).filter(|_| says) {
            return Some(Fault::NoAcceleration(quantity, name.trim().to_owned()));
        }
    }
    let lower = cells.text.to_ascii_lowercase();
    let series = ["time history", "time series"];
    let of_series = || {
        let found = Quantity::in_words(&lower)?;
        series
            .iter()
            .any(|words| lower.contains(words))
            .then_some(found)
    };
    let by_unit = || {
        let NamedWithUnit {
            quantity,
            unit,
            rest,
        } = named_with_unit(&lower)?;
        let rest = rest.trim_matches([' ', '\t', '.', ',', ';']);
        let key = rest.trim_start_matches(|c: char| c.is_ascii_alphabetic());
        let ends = rest.is_empty() || key.len() < rest.len() && key.trim_start().starts_with('=');
        let both = [quantity, unit.quantity];
        let other = both.into_iter().find(|q| *q != Quantity::Acceleration);
        other.filter(|_| ends)
    };
    // An acceleration may stand beside it under a name of its own.
    let beside = |name: &String| matches!(role(name), Some(Role::Acceleration(..)));
    let columns = cells.names.len() > 1 && cells.names.iter().any(beside);
    let found = of_series()
        .or_else(|| by_unit().filter(|_| !columns))
        .or_else(|| {
            // Names of columns are looked at one by one.
            let times = |name: &String| matches!(role(name), Some(Role::Time(_)));
            let title = cells.separator.is_none() || cells.names.len() < 3;
            ends_a_title(&lower).filter(|_| title && !cells.names.iter().any(times))
        });
    let other = found.filter(|quantity| *quantity != Quantity::Acceleration)?;
    Some(Fault::NoAcceleration(other, cells.text.clone()))
}

/// The quantity that a title in lower case ends in: `corrected velocity`, `type: velocity`.
fn ends_a_title(lower: &str) -> Option<Quantity> {
    let named = Quantity::in_words(lower)?;
    let words = || {
        lower
            .split(|c: char| !c.is_alphanumeric())
            .filter(|w| !w.is_empty())
    };
    let last = words().next_back()?;
    let ends = ["velocity", "velocities", "displacement", "displacements"].contains(&last);
    let of_else = words().any(|w| of_something_else(w) || NO_TITLE.contains(&w));
    (ends && !of_else).then_some(named)
}

/// Words of titles that speak of a velocity or a displacement of something else, or of none.
const NO_TITLE: [&str; 14] = [
    "no", "not", "without", "with", "of", "and", "or", "high", "low", "soil", "rock", "layer",
    "pulse", "site",
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::plain_columns::header::cells;
    use crate::text::Line;

    #[test]
    fn what_is_wrong_with_a_header() {
        let fault_of = |text: &str| {
            let bytes = text.as_bytes();
            fault_of(&cells(&Line { number: 1, bytes })?).map(|f| f.1)
        };
        let unit = |name: &str, unit: &str| (name.to_owned(), unit.to_owned());
        let (name, min) = unit("time (min)", "min");
        let time = Some(Fault::TimeUnit(name, min));
        assert_eq!(fault_of("time (min),acceleration (m/s2)"), time);
        let (name, furlongs) = unit("acceleration_furlongs", "furlongs");
        let motion = Some(Fault::MotionUnit(name, furlongs));
        assert_eq!(fault_of("time_s,acceleration_furlongs"), motion);
        let column = Some(Fault::Column(1, "dt=0.01 s".to_owned()));
        assert_eq!(fault_of("dt=0.01 s;a [m/s2]"), column);
        for (text, quantity, name) in [
            (
                "time_s;displacement_m",
                Quantity::Displacement,
                "displacement_m",
            ),
            ("# t [s], u [mm]", Quantity::Displacement, "u [mm]"),
            ("time,velocity", Quantity::Velocity, "velocity"),
            ("t (s)  v (cm/s)", Quantity::Velocity, "v (cm/s)"),
        ] {
            let expected = Fault::NoAcceleration(quantity, name.to_owned());
            assert_eq!(fault_of(text), Some(expected), "{text}");
        }
        assert_eq!(fault_of("t (s),t (s),a (g)"), Some(Fault::TwoTimes));
        for text in [
            "El Centro 1940, north-south",
            "the velocity and the displacement at a time t",
            "Unit: g",
            "time_s,acceleration_g",
            "t,a",
            "0.0,0.1",
        ] {
            assert_eq!(fault_of(text), None, "{text}");
        }
    }
}
