//! The skeleton that the volumes of Caltech, USC, CDMG and CGS share: lines of
//! text, 100 integers, 50 or 100 reals, blocks of data, a line that starts `/&`.

use crate::direction::Direction;
use crate::draft::{DraftPeak, StatedDuration};
use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::number::{self, Printed};
use crate::quantity::{Quantity, SeriesUnit};
use crate::source::{HeaderNumbers, Source};
use crate::text::{Line, Lines};

const INTEGERS: Layout = Layout::new(16, 5);
const REALS: Layout = Layout::new(8, 10);
/// Integer that holds the azimuth of the component (degrees), or 500 for upwards.
const AZIMUTH: usize = 27;

/// Some volumes of the University of Southern California print 20 integers a line.
const NARROW_INTEGERS: Layout = Layout::new(20, 4);

/// The layout of the hundred integers, which their number of lines tells: seven of 16, or
/// five of 20. The reals after them have decimal points.
fn integer_layout(lines: &Lines<'_>) -> Layout {
    let lines_of = |layout: Layout| 100_usize.div_ceil(layout.per_line);
    let mut ahead = lines.clone().take(lines_of(INTEGERS) + 1);
    // Numbers may be blank, and then so may lines be.
    let rows = ahead.position(|line| line.bytes.contains(&b'.'));
    let touching = |line: &Line<'_>| line.fields().count() > INTEGERS.per_line;
    let narrow = match rows {
        Some(rows) if rows == lines_of(NARROW_INTEGERS) => true,
        Some(rows) if rows == lines_of(INTEGERS) => false,
        _ => lines
            .clone()
            .take(lines_of(NARROW_INTEGERS))
            .any(|l| touching(&l)),
    };
    if narrow { NARROW_INTEGERS } else { INTEGERS }
}

/// The header of one channel.
pub(crate) struct ChannelHeader<'a> {
    pub text: Vec<Line<'a>>,
    pub integers: HeaderNumbers,
    pub reals: HeaderNumbers,
}

impl<'a> ChannelHeader<'a> {
    /// Reads `text` lines of text, 100 integers and `reals` reals; `None` at the
    /// end of the file.
    pub(crate) fn read(
        source: &Source<'a>,
        lines: &mut Lines<'a>,
        text: usize,
        reals: usize,
    ) -> Result<Option<Self>, GroundMotionError> {
        let mut ahead = lines.clone();
        loop {
            match ahead.next() {
                None => return Ok(None),
                Some(line) if line.is_blank() => *lines = ahead.clone(),
                Some(_) => break,
            }
        }
        let mut head = Vec::with_capacity(text);
        for _ in 0..text {
            head.push(source.expect(lines, "the header of a channel")?);
        }
        Ok(Some(Self {
            text: head,
            integers: source.header_numbers(lines, integer_layout(lines), 100)?,
            reals: source.header_numbers(lines, REALS, reals)?,
        }))
    }

    /// Text line `index` (from 1).
    pub(crate) fn line(&self, index: usize) -> String {
        self.text
            .get(index.saturating_sub(1))
            .map(|l| l.text().trim().to_owned())
            .unwrap_or_default()
    }

    /// The first line of text that holds a word, in lower case, with its number.
    pub(crate) fn find_line(&self, word: &str) -> Option<(usize, String)> {
        let lines = self.text.iter().map(|l| (l.number, l.lower()));
        lines.into_iter().find(|(_, l)| l.contains(word))
    }

    /// Number of the first line.
    pub(crate) fn first(&self) -> usize {
        self.text.first().map_or(1, |l| l.number)
    }

    /// Channel and component of `CHAN  1:  90 DEG` or `COMP S90W`.
    pub(crate) fn component(&self, index: usize) -> (Option<usize>, String) {
        let line = self.line(index);
        let lower = line.to_ascii_lowercase();
        let Some((before, after)) = line.split_once(':') else {
            let name = lower
                .find("comp")
                .and_then(|at| line.get(at + 4..))
                .and_then(compass_word)
                .unwrap_or(line);
            return (None, name);
        };
        let channel = number::first_in(before)
            .filter(|n| n.0.fract() == 0.0 && (1.0..1.0e4).contains(&n.0))
            .map(|n| n.0 as usize);
        (channel, name_of_channel(after))
    }

    /// The component of a line (from 1), held against the direction in the other lines and in
    /// integer 27 of CSMIP; where they differ and the user takes the file as it is, the first.
    ///
    /// # Errors
    /// Two directions.
    pub(crate) fn agreed_component(
        &self,
        source: &Source<'_>,
        index: usize,
    ) -> Result<(Option<usize>, String), GroundMotionError> {
        let (channel, name) = self.component(index);
        let stated: Vec<(usize, String)> = self
            .text
            .iter()
            .filter_map(|line| Some((line.number, direction_in(&line.text())?)))
            .collect();
        let Some((first_line, first)) = stated.first() else {
            return Ok((channel, name));
        };
        let mut differs = false;
        for (line, other) in &stated[1..] {
            if Direction::differ(first, other) {
                differs = true;
                source.contradiction(
                    *line,
                    format!(
                        "the component is \"{other}\" here, but \"{first}\" in line {first_line}"
                    ),
                )?;
            }
        }
        // Of lines such as `CHAN  1:  90 DEG`: in older volumes the integer is not known to be the azimuth.
        let in_numbers = channel.and_then(|_| self.integers.get(AZIMUTH));
        if let Some(other) = in_numbers.and_then(|n| Direction::contradicts(first, n)) {
            let message = format!(
                "the component is \"{first}\" here, but {other} by integer {AZIMUTH} in line {}",
                self.integers.line_of(AZIMUTH)
            );
            source.contradiction(*first_line, message)?;
        }
        let name = if differs { first.clone() } else { name };
        Ok((channel, name))
    }

    /// The length of the record in words: `RECORD LENGTH = 59.998 SEC`, `DURATION = 42.145`.
    pub(crate) fn duration_in_words(&self) -> Option<StatedDuration> {
        let keys = ["record length", "duration"];
        let (line, seconds) = keys.into_iter().find_map(|key| {
            let (line, text) = self.find_line(key)?;
            Some((line, number::stated(&text, key)?.0))
        })?;
        let stated = StatedDuration {
            seconds,
            line: Some(line),
        };
        (seconds > 0.0).then_some(stated)
    }

    /// Real `index` as a length of the record (s).
    pub(crate) fn duration_in_numbers(&self, index: usize) -> Option<StatedDuration> {
        let seconds = self.reals.positive(index)?;
        Some(StatedDuration {
            seconds,
            line: Some(self.reals.line_of(index)),
        })
    }

    /// Station and event.
    pub(crate) fn title(&self, station: usize, event: usize) -> String {
        format!("{}; {}", self.line(event), self.line(station))
    }

    /// What follows `time:` on the line that holds it.
    pub(crate) fn start_time(&self) -> String {
        self.text
            .iter()
            .map(Line::text)
            .find_map(|l| {
                let lower = l.to_ascii_lowercase();
                let at = lower
                    .find("start time:")
                    .map(|n| n + 11)
                    .or_else(|| lower.find("trigger time:").map(|n| n + 13))?;
                Some(l.get(at..)?.trim().to_owned())
            })
            .unwrap_or_default()
    }
}

/// The direction behind `CHAN  1:` of a channel, without its number.
fn name_of_channel(after: &str) -> String {
    let mut words = after.split_whitespace();
    match (words.next(), words.next()) {
        (Some(azimuth), Some(unit)) if unit.to_ascii_lowercase().starts_with("deg") => {
            format!("{azimuth} deg")
        }
        (Some(word), _) => word.to_owned(),
        _ => String::new(),
    }
}

/// The direction that a line of text has behind `CHAN  1:` or `COMP`, wherever that stands in it.
fn direction_in(text: &str) -> Option<String> {
    let lower = text.to_ascii_lowercase();
    let behind = |word: &str| {
        let starts = |at: &usize| *at == 0 || lower.as_bytes()[at - 1] == b' ';
        let at = lower.match_indices(word).map(|(at, _)| at).find(starts)?;
        text.get(at + word.len()..)
    };
    let of_channel = || {
        let (number, after) = behind("chan ")?.split_once(':')?;
        let is_number = number.trim().bytes().all(|b| b.is_ascii_digit());
        is_number.then(|| name_of_channel(after))
    };
    let name = of_channel().or_else(|| compass_word(behind("comp ")?))?;
    Direction::parse(&name).map(|_| name)
}

/// The first word, `ONENT` of `COMPONENT` aside; `S 58 W` is one.
fn compass_word(text: &str) -> Option<String> {
    let mut words = text.split_whitespace().filter(|w| !w.starts_with("ONENT"));
    let first = words.next()?;
    let rest: Vec<&str> = words.take(2).collect();
    match (first, &rest[..]) {
        ("N" | "S", [angle, side @ ("E" | "W")]) if angle.parse::<f64>().is_ok() => {
            Some(format!("{first}{angle}{side}"))
        }
        _ => Some(first.to_owned()),
    }
}

/// Passes over the line that ends a channel, if it is there.
pub(crate) fn end_of_channel(source: &Source<'_>, lines: &mut Lines<'_>) {
    let ends = |l: &Line<'_>| l.bytes.trim_ascii_start().starts_with(b"/");
    let mut ahead = lines.clone();
    match ahead.find(|l| !l.is_blank()) {
        Some(line) if ends(&line) => *lines = ahead,
        _ => source.warn("a channel does not end in a line that starts with /&"),
    }
}

/// `2674 POINTS OF ACC DATA EQUALLY SPACED AT .020 SEC.`
pub(crate) struct Label {
    pub count: usize,
    pub quantity: Quantity,
    pub unit: SeriesUnit,
    pub step: Printed,
    pub layout: Layout,
}

impl Label {
    /// Parses the line before a block of a Volume 2 file; units are those of the
    /// format, cm and s, unless the line states others.
    pub(crate) fn parse(source: &Source<'_>, line: Line<'_>) -> Result<Self, GroundMotionError> {
        let lower = line.lower();
        let count = number::first_in(&lower)
            .map(|n| n.0)
            .filter(|n| n.fract() == 0.0 && (1.0..1.0e9).contains(n));
        let quantity = lower
            .split(|c: char| !c.is_ascii_alphabetic())
            .find_map(|w| match w.get(..3)? {
                "acc" => Some((Quantity::Acceleration, SeriesUnit::CM_S2)),
                "vel" => Some((Quantity::Velocity, SeriesUnit::CM_S)),
                "dis" => Some((Quantity::Displacement, SeriesUnit::CM)),
                _ => None,
            });
        let step = number::time_step(&lower)
            // Without a unit it is that of the format, seconds.
            .or_else(|| number::after(&lower, " at ").filter(|s| s.0 > 0.0));
        let (Some(count), Some((quantity, usual)), Some(step)) = (count, quantity, step) else {
            return Err(source.error(
                line.number,
                0,
                format!(
                    "\"{}\" is not like \"2674 points of accel data equally spaced at .020 sec\"",
                    number::shown(line.bytes)
                ),
                "the header has lines too many or too few: get the record again",
            ));
        };
        let unit = unit_of_label(source, line, &lower)?.unwrap_or(usual);
        if unit.quantity != quantity {
            return Err(source.error(
                line.number,
                0,
                format!("{quantity} in {}", unit.symbol),
                "the label contradicts itself: get the record again",
            ));
        }
        Ok(Self {
            count: count as usize,
            quantity,
            unit,
            step,
            layout: Layout::find(&lower).unwrap_or(REALS),
        })
    }
}

/// What to do about a unit that is not known.
pub(crate) const REMEDY_UNIT: &str = "the unit of the values must be certain: get the record again";

/// Words before the unit of a block.
const BEFORE_UNIT: [&str; 6] = [
    "units: ",
    "units = ",
    "units=",
    "units of ",
    "unit of ",
    ", in ",
];

/// The unit that the line before a block states: `, in cm/sec2.`, `in units of g.`,
/// `units: cm/sec2`. Two that differ are refused, and words that are no unit.
fn unit_of_label(
    source: &Source<'_>,
    line: Line<'_>,
    lower: &str,
) -> Result<Option<SeriesUnit>, GroundMotionError> {
    let mut found: Option<SeriesUnit> = None;
    for key in BEFORE_UNIT {
        let Some((_, rest)) = lower.rsplit_once(key) else {
            continue;
        };
        let rest = rest.trim_start();
        // What follows `, in ` is looked at under its own key.
        if key == ", in " && rest.starts_with("unit") {
            continue;
        }
        let word = rest
            .split([' ', ')', '(', ',', ';'])
            .next()
            .unwrap_or_default();
        let Some(unit) = SeriesUnit::parse(word) else {
            if key == ", in " {
                continue;
            }
            return Err(source.unknown_unit(line.number, word, REMEDY_UNIT));
        };
        if let Some(other) = found.filter(|other| *other != unit) {
            return Err(source.two_units(line, unit, other));
        }
        found = Some(unit);
    }
    Ok(found)
}

/// The unit behind the number under a key: `cm/s/s` of `= 210.1 cm/s/s at 11.4 sec`.
pub(crate) fn unit_of_number(text: &str, key: &str) -> Option<SeriesUnit> {
    let (_, rest) = text.split_once(key)?;
    let rest = rest.trim_start_matches([' ', '=', ':']);
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let word = after.split([',', ' ']).find(|word| !word.is_empty())?;
    SeriesUnit::parse(word.trim_end_matches('.'))
}

/// `PEAK ACCELERATION = 210.14200 CMS/SEC/SEC AT 11.440 SEC` of the right quantity.
pub(crate) fn peak_line(header: &ChannelHeader<'_>, quantity: Quantity) -> Option<DraftPeak> {
    let is_peak =
        |l: &String| l.trim_start().starts_with("peak") && l.contains(&quantity.name()[..5]);
    let lines = header.text.iter().map(|l| (l.number, l.lower()));
    let (number, line) = lines.into_iter().find(|(_, l)| is_peak(l))?;
    Some(DraftPeak {
        value: number::stated(&line, "=")?,
        time: number::stated(&line, " at "),
        unit: unit_of_number(&line, "="),
        shift: 0.0,
        line: Some(number),
        of_sign: false,
    })
}
