//! What the names and units of columns mean, in the words of those who write them.

use crate::quantity::{Multiple, Quantity, SeriesUnit};

pub(super) const TIME: [&str; 11] = [
    "t",
    "time",
    "times",
    "elapsed time",
    "zeit",
    "temps",
    "tiempo",
    "tempo",
    "zaman",
    "時間",
    "时间",
];
pub(super) const ACCELERATION: [&str; 18] = [
    "ground acc",
    "acelera\u{e7}\u{e3}o",
    "aceleracao",
    "a",
    "ag",
    "a g",
    "acc",
    "accel",
    "acceleration",
    "accelerations",
    "ground acceleration",
    "ground accel",
    "aceleraci\u{f3}n",
    "aceleracion",
    "acc\u{e9}l\u{e9}ration",
    "accelerazione",
    "beschleunigung",
    "ivme",
];
const VELOCITY: [&str; 13] = [
    "hiz",
    "v",
    "vel",
    "velocity",
    "ground velocity",
    "ground vel",
    "velocidad",
    "velocidade",
    "vitesse",
    "velocit\u{e0}",
    "velocita",
    "geschwindigkeit",
    "h\u{131}z",
];
const DISPLACEMENT: [&str; 12] = [
    "d",
    "disp",
    "displacement",
    "ground displacement",
    "ground disp",
    "desplazamiento",
    "deslocamento",
    "d\u{e9}placement",
    "spostamento",
    "verschiebung",
    "yer de\u{11f}i\u{15f}tirme",
    "deplasman",
];
pub(super) const COUNTER: [&str; 14] = [
    "-",
    "#",
    "n",
    "no",
    "nr",
    "row",
    "index",
    "sample",
    "id",
    "step",
    "point",
    "count",
    "line",
    "record no",
];
/// Words of names of columns that hold no motion.
pub(super) const FOREIGN: [&str; 36] = [
    "force",
    "forces",
    "load",
    "loads",
    "moment",
    "shear",
    "pressure",
    "stress",
    "strain",
    "drift",
    "temp",
    "temperature",
    "humidity",
    "volt",
    "volts",
    "voltage",
    "current",
    "curvature",
    "deflection",
    "gyro",
    "rotation",
    "angle",
    "tilt",
    "flag",
    "status",
    "arias",
    "energy",
    "husid",
    "counts",
    "depth",
    "distance",
    "intensity",
    "magnitude",
    "mass",
    "quality",
    "weight",
];
/// Names of columns of response spectra and Fourier spectra.
const SPECTRAL: [&str; 27] = [
    "periodo",
    "per\u{ed}odo",
    "p\u{e9}riode",
    "periode",
    "schwingzeit",
    "sa",
    "psa",
    "spa",
    "s a",
    "sv",
    "psv",
    "sd",
    "period",
    "periods",
    "natural period",
    "frequency",
    "freq",
    "damping",
    "damping ratio",
    "spectrum",
    "response spectrum",
    "psd",
    "power",
    "response acceleration",
    "tn",
    "per",
    "acceleration response",
];
/// Words that stand in sentences, and in no name of a column between blanks.
pub(super) const PROSE: [&str; 17] = [
    "history",
    "histories",
    "series",
    "of",
    "in",
    "the",
    "and",
    "for",
    "at",
    "with",
    "from",
    "by",
    "record",
    "data",
    "motion",
    "component",
    "is",
];
/// Units that no acceleration has.
const FOREIGN_UNITS: [&str; 23] = [
    "count", "counts", "cts", "lsb", "adc", "v", "mv", "uv", "volt", "volts", "n", "kn", "mn",
    "lbf", "kip", "kips", "pa", "kpa", "mpa", "rad/s", "deg/s", "strain", "deg",
];
/// Names behind which a unit may follow after a blank or an underscore alone. `a_g` is not
/// one: it may be the symbol of the ground's acceleration, or an acceleration in g.
pub(super) const LONG: [&str; 10] = [
    "t",
    "time",
    "times",
    "elapsed time",
    "acc",
    "accel",
    "acceleration",
    "accelerations",
    "ground acceleration",
    "ground accel",
];

/// The velocity or displacement that a name in lower case is.
pub(super) fn motion(known: &str) -> Option<Quantity> {
    match known {
        known if VELOCITY.contains(&known) => Some(Quantity::Velocity),
        known if DISPLACEMENT.contains(&known) => Some(Quantity::Displacement),
        _ => None,
    }
}

/// Whether a name says that a column holds accelerations, and nothing else of it.
pub(super) fn is_acceleration(name: &str) -> bool {
    ACCELERATION.contains(&plain(name).as_str())
}

/// Whether a name is that of a column of times; they may be numbered, `t1` and `t2`.
pub(super) fn is_time(known: &str) -> bool {
    TIME.contains(
        &known
            .trim_end_matches(|c: char| c.is_ascii_digit())
            .trim_end(),
    )
}

/// A unit without the word before it: `cm/s2` of `in cm/s2`. An inch has none behind it.
fn without_in(unit: &str) -> &str {
    let unit = unit.trim();
    let behind = unit
        .get(..3)
        .filter(|start| start.eq_ignore_ascii_case("in "))
        .map(|_| &unit[3..]);
    behind.map_or(unit, str::trim)
}

/// Units of time (s).
pub(super) fn time_unit(text: &str) -> Option<f64> {
    match without_in(text)
        .trim_end_matches('.')
        .to_lowercase()
        .as_str()
    {
        "s" | "sec" | "secs" | "second" | "seconds" | "seg" | "segs" | "segundos" | "saniye"
        | "sn" => Some(1.0),
        "ms" | "msec" | "millisecond" | "milliseconds" => Some(1.0e-3),
        _ => None,
    }
}

/// A unit of motion in any of its spellings: `m/s²`, `m/s^2`, `m s-2`, `m_s2`, `m/s**2`.
pub(in crate::formats) fn motion_unit(text: &str) -> Option<SeriesUnit> {
    let plain = without_in(text)
        .to_lowercase()
        .replace('²', "2")
        .replace(['−', '⁻'], "-");
    let spaced = ["s-2", "s^-2", "sec-2", "sec^-2"].iter().find_map(|end| {
        let length = plain.strip_suffix(end)?;
        let length = length.strip_suffix([' ', '.', '·', '*', '_'])?;
        Some(format!("{length}/s2"))
    });
    let plain = symbols(&plain);
    match plain.as_str() {
        "gs" | "gravity" => return Some(SeriesUnit::G),
        _ => {}
    }
    // `ms2`, `mps2`, `ms-2`, as names of variables have them.
    let bare = plain.replace(['^', '-'], "");
    let joined = bare.strip_suffix("ps2").or(bare.strip_suffix("s2"));
    if let Some(length) = joined.filter(|l| ["m", "cm", "mm"].contains(l)) {
        return SeriesUnit::parse(&format!("{length}/s2"));
    }
    // SeriesUnit takes stops out, which are none of a unit of a header.
    let known = |text: &str| SeriesUnit::parse(text).filter(|_| !text.contains('.'));
    known(&spaced.unwrap_or_else(|| plain.clone()))
        .or_else(|| known(&plain.replacen('_', "/", 1)))
        .or_else(|| {
            let multiple = Multiple::parse(without_in(text));
            multiple.filter(|m| !m.may_be_level)?.unit
        })
}

/// A unit in lower case with symbols for its words, `cm/s2` of `centimeters per second squared`, and for the
/// seconds of other languages.
fn symbols(plain: &str) -> String {
    const WORDS: [(&str, &str); 22] = [
        ("centimeters", "cm"),
        ("centimetres", "cm"),
        ("centimeter", "cm"),
        ("centimetre", "cm"),
        ("millimeters", "mm"),
        ("millimetres", "mm"),
        ("millimeter", "mm"),
        ("millimetre", "mm"),
        ("meters", "m"),
        ("metres", "m"),
        ("meter", "m"),
        ("metre", "m"),
        ("inches", "in"),
        ("inch", "in"),
        ("feet", "ft"),
        ("foot", "ft"),
        (" per ", "/"),
        ("seconds", "s"),
        ("second", "s"),
        ("s squared", "s2"),
        ("sec squared", "s2"),
        ("/sn", "/s"),
    ];
    WORDS.iter().fold(plain.to_owned(), |text, (word, symbol)| {
        text.replace(word, symbol)
    })
}

/// Whether a name is that of a component or of one of several instruments: `ns`, `acc1`, `ch 3`.
pub(super) fn is_channel(known: &str) -> bool {
    let base = known.trim_end_matches(|c: char| c.is_ascii_digit());
    let numbered = base.len() < known.len() && !base.is_empty();
    let base = base.trim_end_matches([' ', '#', '-']);
    let instrument = ["ch", "chan", "channel", "sensor", "rsn", "rec"].contains(&base);
    is_component(known)
        || numbered && (instrument || ACCELERATION.contains(&base) || is_component(base))
}

/// Whether a name is that of an ordinate or abscissa of a spectrum, with or without a unit.
pub(super) fn is_spectral(cell: &str) -> bool {
    let cell = unquoted(cell);
    let name = cell.split(['(', '[']).next().unwrap_or(cell);
    let known = plain(&name.replace('-', " "));
    let words: Vec<&str> = known.split(' ').collect();
    let is_unit = |unit: &str| {
        motion_unit(unit).is_some()
            || time_unit(unit).is_some()
            || ["hz", "ft", "in"].contains(&unit)
    };
    let named = |count: usize| SPECTRAL.contains(&words[..count].join(" ").as_str());
    let with_unit = |count: usize| named(count) && is_unit(&words[count..].join("_"));
    let starts = ["spectral", "pseudo", "rotd", "fourier", "gmrot"];
    let motions = [
        "acceleration",
        "acc",
        "velocity",
        "displacement",
        "amplitude",
        "sa",
        "psa",
    ];
    // `Psa5_N`: of so many per cent of damping.
    let of_damping = ["psa", "psv"].iter().any(|name| {
        let behind = words[0].strip_prefix(name).unwrap_or_default();
        let digits = behind.bytes().take_while(u8::is_ascii_digit).count();
        digits > 0 && !behind[digits..].starts_with(char::is_alphanumeric)
    });
    // `Sa_X_ft_s2`, `PSA_5pct_g`, `Sa_geomean`, `SaX_g`: of a component, a damping or a mean.
    let joined = name.split(['_', ' ']).next().is_some_and(has_component);
    let of_one = (joined || ORDINATES.contains(&words[0]) && words.len() > 1)
        && are_of_ordinate(&words[1..], &is_unit);
    named(words.len())
        || of_damping
        || of_one
        || (1..words.len()).any(with_unit)
        || starts.iter().any(|start| known.starts_with(start))
            && (words.len() == 1 || motions.iter().any(|motion| words.contains(motion)))
}

/// Ordinates of spectra that have a component, a damping or a mean behind them.
const ORDINATES: [&str; 6] = ["sa", "spa", "psa", "sv", "psv", "sd"];

/// Whether a component stands behind an ordinate without a sign between them, told by its capitals: `SaX`, `PSaNS`.
fn has_component(word: &str) -> bool {
    let ordinates = ["PSa", "Sa", "Sv", "Sd"];
    let component = ordinates.iter().find_map(|name| word.strip_prefix(name));
    let known = ["X", "Y", "Z", "H", "V", "H1", "H2", "NS", "EW", "UD"];
    component.is_some_and(|component| known.contains(&component))
}

/// Whether words behind an ordinate of a spectrum are components, dampings, means and units alone.
fn are_of_ordinate(words: &[&str], is_unit: &dyn Fn(&str) -> bool) -> bool {
    const PARTS: [&str; 21] = [
        "avg", "mean", "median", "geomean", "gm", "srss", "max", "larger", "env", "envelope",
        "target", "design", "elastic", "h", "v", "x", "y", "z", "n", "e", "u",
    ];
    let [first, rest @ ..] = words else {
        return true;
    };
    let is_of_unit = |count: usize| {
        is_unit(&words[..count].join("_")) && are_of_ordinate(&words[count..], is_unit)
    };
    if (1..=words.len().min(3)).any(is_of_unit) {
        return true;
    }
    // `5pct`, `xi5`, `rotd50`.
    let marks = [
        "damp", "xi", "zeta", "rotd", "rotdn", "gmroti", "gmrotd", "",
    ];
    let ends = ["", "%", "pct", "percent"];
    let is_numbered = marks.iter().any(|mark| {
        let behind = first.strip_prefix(mark).unwrap_or_default();
        let end = behind.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
        end.len() < behind.len() && ends.contains(&end)
    });
    // `5_pct`.
    let is_part =
        is_numbered || ends[1..].contains(first) || PARTS.contains(first) || is_component(first);
    is_part && are_of_ordinate(rest, is_unit)
}

/// A cell without quotes and blanks around it.
pub(super) fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches(['"', '\'']).trim()
}

/// A unit without quotes and brackets around it.
pub(super) fn bare_unit(text: &str) -> String {
    let unit = unquoted(text);
    let inner = unit
        .strip_prefix(['(', '['])
        .and_then(|u| u.strip_suffix([')', ']']));
    inner.unwrap_or(unit).trim().to_owned()
}

/// Whether a column is what the ordinates of a spectrum stand over.
pub(super) fn is_abscissa(name: &str) -> bool {
    is_spectral(name)
        && [
            "period",
            "natural period",
            "p\u{e9}riode",
            "per\u{ed}odo",
            "schwingzeit",
            "freq",
            "per",
            "tn",
        ]
        .iter()
        .any(|n| plain(name).starts_with(n))
        || is_frequency(name)
}

/// Whether a name is that of a frequency by its unit alone: `f (Hz)`.
fn is_frequency(name: &str) -> bool {
    let name = unquoted(name).to_lowercase();
    let unit = name.split_once(['(', '[', '_', '/']);
    unit.is_some_and(|(name, unit)| {
        ["f", "fr", "freq", "frequency"].contains(&plain(name).as_str())
            && unit.trim_end_matches([')', ']', ' ']) == "hz"
    })
}

/// Whether the name of a column has a factor, a sign or a function of its values: `1000*a`, `10 Acc`, `Acc x10^-2`,
/// `a/9.81`, `-a`, `log10 acc`, `acc squared`, `Scaled time`. What stands in brackets is a unit.
pub(super) fn has_factor(cell: &str) -> bool {
    let cell = unquoted(cell);
    let name = cell.split(['(', '[']).next().unwrap_or(cell);
    let name = name
        .trim()
        .to_lowercase()
        .replace(['\u{2212}', '\u{2013}'], "-");
    let is_superscript = |c: char| {
        "\u{b9}\u{b2}\u{b3}\u{2070}\u{207b}".contains(c) || ('\u{2074}'..='\u{2079}').contains(&c)
    };
    let signed = name
        .strip_prefix('-')
        .is_some_and(|rest| rest.trim_start().starts_with(char::is_alphabetic));
    let powers = name.match_indices("10").any(|(at, ten)| {
        let behind = &name[at + ten.len()..];
        behind.starts_with(['^', '*']) || behind.starts_with(is_superscript)
    });
    // Numbers of instruments stand beside no times.
    let words: Vec<&str> = name
        .split([' ', '_', '*', '/', '\u{b7}', '\u{d7}'])
        .filter(|word| !word.is_empty())
        .collect();
    let is_of_times = words
        .iter()
        .any(|word| word.len() > 1 && TIME.contains(word));
    let scales = |number: f64| scales(number) || is_of_times;
    let times = name.char_indices().any(|(at, sign)| {
        let before = name[..at].chars().next_back();
        let behind = name[at + sign.len_utf8()..].trim_start();
        let number = leading_number(behind);
        match sign {
            '*' | '\u{b7}' | '\u{d7}' => {
                let factor_before = name[..at]
                    .trim_end()
                    .ends_with(|c: char| c.is_ascii_digit());
                number.is_some() || factor_before && !behind.is_empty()
            }
            // `3/10` is a name.
            '/' => number.is_some_and(scales) && !before.is_some_and(|c| c.is_ascii_digit()),
            // `acc x 12` may be one of several in that direction.
            'x' => {
                let apart = before.is_none_or(|c| !c.is_alphanumeric() && c != '_');
                apart && number.is_some_and(scales)
            }
            _ => false,
        }
    });
    signed || powers || times || is_multiple(&name) || is_function(&words, is_of_times)
}

/// Whether a name in lower case is that of accelerations or times behind a number that is none of an instrument:
/// `10 acc`. `010 acc` has an azimuth.
fn is_multiple(name: &str) -> bool {
    let Some((number, rest)) = name.split_once(' ') else {
        return false;
    };
    let known = plain(rest);
    let is_azimuth = number.starts_with('0') && !number.contains('.');
    let is_factor = leading_number(number).is_some_and(scales) && number.parse::<f64>().is_ok();
    let is_named = ACCELERATION.contains(&known.as_str()) || TIME.contains(&known.as_str());
    is_factor && is_named && !is_azimuth
}

/// Whether the words of a name in lower case are those of a function of accelerations or times, or of times of
/// another scale.
fn is_function(words: &[&str], is_of_times: bool) -> bool {
    let named = |words: &[&str]| {
        let known = words.join(" ");
        ACCELERATION.contains(&known.as_str()) || TIME.contains(&known.as_str())
    };
    let [first, rest @ ..] = words else {
        return false;
    };
    let scaled = ["scaled", "normalised", "normalized", "compressed"];
    let is_scaled = is_of_times && words.iter().any(|word| scaled.contains(word));
    let logarithm = ["log", "log10", "ln", "lg", "square", "sqrt"].contains(first) && named(rest);
    let power = match words {
        [name @ .., "squared" | "cubed"] => named(name),
        [name] => ["^2", "^3", "\u{b2}", "\u{b3}"]
            .iter()
            .any(|power| name.strip_suffix(power).is_some_and(|name| named(&[name]))),
        _ => false,
    };
    is_scaled || logarithm || power
}

/// Whether a number is a factor between units rather than that of an instrument: a power of ten, one with
/// decimals, or cm/s2 in g.
fn scales(number: f64) -> bool {
    let power = (1..=9).any(|n| number == 10.0_f64.powi(n));
    power || number.fract() != 0.0 || number == 981.0
}

/// The number that a text starts with.
fn leading_number(text: &str) -> Option<f64> {
    let number = |c: char| c.is_ascii_digit() || ".-+".contains(c);
    let end = text.find(|c| !number(c)).unwrap_or(text.len());
    text[..end].trim_end_matches('.').parse().ok()
}

/// Whether names are those of a spectrum by the first of them, which a spectrum stands over: with
/// its unit in brackets, or apart from the next one by more than a blank or a comma.
pub(super) fn are_of_spectrum(names: &[String], separator: Option<char>) -> bool {
    let [first, second, ..] = names else {
        return false;
    };
    let apart = matches!(separator, Some(';' | '\t' | '|')) || first.contains(['(', '[']);
    // Letters of codes, in which capitals tell them from directions.
    let letters = ["Sa", "Se", "Sae", "Sde", "Sd", "Sv"].contains(&before_unit(second));
    is_abscissa(first) && apart && !unquoted(second).is_empty()
        || names.len() == 2 && letters && is_time(&plain(before_unit(first)))
}

/// A name without the unit in brackets behind it.
pub(super) fn before_unit(name: &str) -> &str {
    let name = unquoted(name);
    name.split(['(', '[']).next().unwrap_or(name).trim_end()
}

/// Whether a name is that of something else than motion by a word of it or by its unit: `force`, `load (kN)`.
pub(super) fn is_of_no_motion(cell: &str) -> bool {
    let name = before_unit(cell).to_lowercase();
    let unit = unquoted(cell)
        .split_once(['(', '['])
        .map(|(_, unit)| unit.trim_end_matches([')', ']']));
    let mut words = name.split(|c: char| !c.is_alphabetic());
    words.any(|word| FOREIGN.contains(&word)) || unit.is_some_and(is_foreign_unit)
}

/// Whether a unit is that of something else than motion: counts, volts, forces.
pub(super) fn is_foreign_unit(unit: &str) -> bool {
    FOREIGN_UNITS.contains(&unit.trim().to_lowercase().as_str())
}

/// Whether a name is one of a component and of nothing else, so that what follows an
/// underscore is its unit: `ns_g`, `up_m_s2`, `hne_gal`, `acc_x_g`. Single letters are not:
/// `x_g` and `z_g` may be symbols of the ground's displacement.
pub(super) fn is_component(known: &str) -> bool {
    const DIRECTIONS: [&str; 22] = [
        "ns",
        "ew",
        "ud",
        "sn",
        "we",
        "n-s",
        "e-w",
        "u-d",
        "north",
        "east",
        "south",
        "west",
        "up",
        "vert",
        "vertical",
        "north south",
        "east west",
        "h1",
        "h2",
        "longitudinal",
        "transverse",
        "radial",
    ];
    let code = |name: &str| {
        // Band, instrument and orientation of SEED.
        let [band, instrument, orientation] = name.as_bytes() else {
            return false;
        };
        b"hbesc".contains(band) && b"nlg".contains(instrument) && b"enz123".contains(orientation)
    };
    let azimuth = |name: &str| {
        let digits = name.strip_suffix(" deg").unwrap_or(name);
        (2..=3).contains(&digits.len()) && digits.parse().is_ok_and(|a: u16| a <= 360)
    };
    let own = |name: &str| DIRECTIONS.contains(&name) || code(name) || azimuth(name);
    let single = |name: &str| ["x", "y", "z", "n", "e", "s", "w", "1", "2", "3"].contains(&name);
    let of_motion = known
        .split_once(' ')
        .filter(|(motion, _)| ["a", "acc", "accel", "acceleration"].contains(motion))
        .is_some_and(|(_, rest)| own(rest) || single(rest));
    own(known) || of_motion
}

/// Lower case, blanks for underscores, without a stop at the end.
pub(super) fn plain(name: &str) -> String {
    // The small letter of a Turkish capital has a dot of its own.
    let lower = name
        .trim()
        .trim_end_matches(['.', ':', '_'])
        .to_lowercase()
        .replace("i\u{307}", "i");
    let words: Vec<&str> = lower.split(['_', ' ']).filter(|w| !w.is_empty()).collect();
    words.join(" ")
}
