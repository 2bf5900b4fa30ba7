//! Our CSV layout: `# Key: value` lines, a header `time_s,acceleration_g`, rows.

use crate::cut_numbers::Forms;
use crate::direction::Orientation;
use crate::draft::{Draft, DraftUnit};
use crate::error::{GroundMotionError, bound};
use crate::format::Format;
use crate::number;
use crate::origin::{Origin, Processing};
use crate::quantity::{Quantity, SeriesUnit};
use crate::recording::Series;
use crate::source::{self, Source};
use crate::text::{Line, Lines};
use crate::time_column::{TimeColumn, Times, starts_at_zero};
use crate::unit::AccelerationUnit;
use crate::writers::pounding_csv::{
    AZIMUTH, DIP, FIRST_TIME, INITIAL_DISPLACEMENT, INITIAL_VELOCITY, SAMPLES, START_TIME,
};

const REMEDY: &str = "the layout is in ground_motions/README.md; decimal commas need semicolons or tabs between the columns, also in the header";
const START: &str = "time_s,acceleration_";
/// Keys that mean something.
const KEYS: [&str; 18] = [
    "Event",
    "Station",
    "Component",
    AZIMUTH,
    DIP,
    START_TIME,
    FIRST_TIME,
    "Source",
    "Step",
    "Read",
    "Note",
    "Stage",
    "Unit",
    "Units",
    "dt",
    SAMPLES,
    INITIAL_VELOCITY,
    INITIAL_DISPLACEMENT,
];

/// Those that hold one value.
const OF_ONE_VALUE: [&str; 9] = [
    "Component",
    AZIMUTH,
    DIP,
    START_TIME,
    FIRST_TIME,
    "dt",
    SAMPLES,
    INITIAL_VELOCITY,
    INITIAL_DISPLACEMENT,
];

/// `# Key: value` lines that mean something.
#[derive(Default)]
pub(super) struct Keys {
    /// Those of one value so far.
    seen: source::Keys,
    title: Vec<String>,
    component: String,
    start_time: String,
    /// Time of the first sample (s) in another column of times.
    first_time: Option<f64>,
    /// Azimuth and dip (degrees).
    azimuth: Option<f64>,
    dip: Option<f64>,
    history: Vec<String>,
    /// Units and their lines.
    units: Vec<(usize, String)>,
    stage: Option<Processing>,
    /// Time step (s) and its line.
    step: Option<(usize, f64)>,
    samples: Option<usize>,
    /// Velocity (m/s) and displacement (m) at the first sample.
    initial_velocity: Option<f64>,
    initial_displacement: Option<f64>,
}

pub(super) static FORMAT: Format = Format {
    name: "pounding_csv",
    title: "CSV of this program: comment header, column header, time and acceleration",
    source: "ground_motions/README.md",
    recognised_by: "a column header that starts with time_s,acceleration_",
};

pub(super) fn matches(source: &Source<'_>) -> bool {
    source
        .lines()
        .find(|l| !l.bytes.starts_with(b"#") && !l.is_blank())
        .and_then(|l| l.bytes.strip_prefix(START.as_bytes()))
        // Velocities and the like behind it are columns of another program.
        .is_some_and(|unit| {
            let mut others = unit.split(|b| *b == b',').skip(1).peekable();
            others.peek().is_none() || others.any(|name| name.starts_with(b"acc"))
        })
}

pub(super) fn read(source: &Source<'_>) -> Result<Vec<Series>, GroundMotionError> {
    let mut lines = source.lines();
    let mut keys = Keys::default();
    let header = loop {
        let line = source.expect(&mut lines, "the column header")?;
        if line.bytes.starts_with(b"#") {
            keys.take(source, line)?;
        } else if !line.is_blank() {
            break line;
        }
    };
    let text = header.text();
    let Some(suffix) = text.strip_prefix(START) else {
        return Err(source.error(
            header.number,
            0,
            format!("column header \"{text}\" is not \"{START}<unit>\""),
            REMEDY,
        ));
    };
    if suffix.contains(',') {
        return Err(source.error(
            header.number,
            START.len() + suffix.find(',').unwrap_or(0),
            format!("column header \"{text}\" has more columns than time and acceleration"),
            "this layout has one acceleration: give each component a file of its own, or `format = \"plain_columns\"` (`--format plain_columns` with `pounding motion`) and a `component`",
        ));
    }
    let at = |line: usize, column: usize| {
        move |e: GroundMotionError| {
            source.error(line, column, e.to_string(), &e.help().unwrap_or_default())
        }
    };
    let unit = unit_of_header(suffix).map_err(at(header.number, START.len()))?;
    for (line, stated) in &keys.units {
        // A word that is no unit is wrong here, where the key is part of the layout.
        let _: AccelerationUnit = stated.parse().map_err(at(*line, 0))?;
    }
    keys.agree(source, SeriesUnit::from(unit), &text)?;
    let step = keys.step.map(|s| s.1);
    let first = lines.number() + 1;
    let mut times = TimeColumn::with_capacity(0);
    let (samples, as_given) = rows(source, &mut lines, step, &mut times)?;
    let mut draft = Draft::new(
        samples,
        DraftUnit::Stated(SeriesUnit::from(unit)),
        (header.number, first, lines.number()),
    );
    // Those that follow a step were held against it, from zero on.
    draft.first_time = match step.is_some() || as_given {
        true => Some(keys.first_time.unwrap_or(0.0)),
        false => times.first(),
    };
    draft.times = match step.is_some() || as_given {
        true if source.options.prepend_zero => return Err(starts_at_zero(source, first)),
        true => Times::Step(step),
        false => times.finish(source, first, &mut draft.warnings)?,
    };
    draft.header_count = keys.samples;
    draft.row = Some(1);
    draft.component.clone_from(&keys.component);
    draft.initial = keys.initial();
    let mut series = draft.finish(source)?;
    keys.report(&mut series.origin);
    Ok(vec![series])
}

impl Keys {
    /// The keys in the comments of lines, for a file whose comments need not be of this layout:
    /// what is none of its keys means nothing, and what does not stand behind its key as here is
    /// said not to be used. Steps are those of other keys.
    pub(super) fn before<'a>(source: &Source<'a>, lines: impl Iterator<Item = Line<'a>>) -> Self {
        let mut keys = Self::default();
        for comment in lines {
            let start = comment.bytes.iter().position(|b| !b" \t\"".contains(b));
            let bytes = &comment.bytes[start.unwrap_or(0)..];
            let line = Line { bytes, ..comment };
            if !bytes.starts_with(b"#") || line.lower()[1..].trim_start().starts_with("dt") {
                continue;
            }
            if let Err(error) = keys.take(source, line) {
                source.warn(&format!("{error}; the line is not used"));
            }
        }
        keys
    }

    /// Velocity (m/s) and displacement (m) of the first sample.
    pub(super) fn initial(&self) -> Option<(f64, f64)> {
        let stated = self.initial_velocity.is_some() || self.initial_displacement.is_some();
        stated.then(|| {
            (
                self.initial_velocity.unwrap_or(0.0),
                self.initial_displacement.unwrap_or(0.0),
            )
        })
    }

    /// Time of the first sample (s) in another column of times.
    pub(super) fn first_time(&self) -> Option<f64> {
        self.first_time
    }

    /// The component of a file that holds one.
    pub(super) fn component(&self) -> Option<&str> {
        Some(self.component.as_str()).filter(|name| !name.is_empty())
    }

    /// Refuses units in the keys other than that of the column header.
    pub(super) fn agree(
        &self,
        source: &Source<'_>,
        unit: SeriesUnit,
        header: &str,
    ) -> Result<(), GroundMotionError> {
        let differs =
            |(_, stated): &&(usize, String)| SeriesUnit::parse(stated).is_some_and(|s| s != unit);
        match self.units.iter().find(differs) {
            Some((line, stated)) => Err(source.error(
                *line,
                0,
                format!("unit \"{stated}\" contradicts the column header \"{header}\""),
                "make both the same",
            )),
            None => Ok(()),
        }
    }

    /// What they say of the record's origin.
    pub(super) fn report(&self, origin: &mut Origin) {
        origin.title = self.title.join("; ");
        origin.history.clone_from(&self.history);
        origin.start_time.clone_from(&self.start_time);
        origin.orientation = self
            .azimuth
            .zip(self.dip)
            .and_then(|(azimuth, dip)| Orientation::of(azimuth, dip));
        if let Some(stage) = self.stage {
            origin.processing = stage;
        }
    }

    fn take(&mut self, source: &Source<'_>, line: Line<'_>) -> Result<(), GroundMotionError> {
        let text = line.columns(1, line.bytes.len());
        let Some((key, value)) = text.split_once(':') else {
            return Ok(());
        };
        // Spreadsheets put quotes around a line, and separators behind it.
        let value = value.trim_matches([' ', '\t', ',', ';', '"']);
        let unused = |what: &str, remedy: &str| {
            source.warn(&format!(
                "line {}: {what} \"{}\" is not used: {remedy}",
                line.number,
                number::shown(value.as_bytes())
            ));
        };
        // Other programs write the keys in other letters.
        let key = key.trim();
        let key = KEYS.into_iter().find(|k| k.eq_ignore_ascii_case(key));
        if let Some(key) = key.filter(|key| OF_ONE_VALUE.contains(key))
            && !self.seen.is_new(source, line, key, value)?
        {
            return Ok(());
        }
        match key.unwrap_or_default() {
            "Event" | "Station" => self.title.push(value.to_owned()),
            "Component" => value.clone_into(&mut self.component),
            AZIMUTH => {
                self.azimuth = degrees(value, 360.0);
                if self.azimuth.is_none() {
                    unused(
                        "the azimuth",
                        "write it as `# Azimuth: 120 degrees`, from -360 to 360",
                    );
                }
            }
            DIP => {
                self.dip = degrees(value, 90.0);
                if self.dip.is_none() {
                    unused(
                        "the dip",
                        "write it as `# Dip: -90 degrees`, from -90 to 90",
                    );
                }
            }
            START_TIME => {
                if !value.contains(|c: char| c.is_ascii_digit()) {
                    unused("the time", "write it as `# Start: 2011/03/11 14:46:15 JST`");
                }
                value.clone_into(&mut self.start_time);
            }
            FIRST_TIME => {
                self.first_time = seconds(value);
                if self.first_time.is_none() {
                    unused("the time", "write it as `# First time: 5 s`");
                }
            }
            "Source" | "Step" | "Read" | "Note" => self.history.push(text.trim().to_owned()),
            "Stage" => {
                let stage = match value.to_ascii_lowercase().as_str() {
                    "raw" => Processing::Raw,
                    "corrected" => Processing::Corrected,
                    _ => {
                        return Err(source.error(
                            line.number,
                            0,
                            format!("the stage \"{value}\" is neither raw nor corrected"),
                            "write `# Stage: raw` for a record with the instrument's offset, `# Stage: corrected` for one that its agency corrected, or leave the line out",
                        ));
                    }
                };
                if self.stage.is_some_and(|before| before != stage) {
                    return Err(source.error(
                        line.number,
                        0,
                        "the record is both raw and corrected",
                        "leave one of the lines out",
                    ));
                }
                self.stage = Some(stage);
            }
            "Unit" => self.units.push((line.number, value.to_owned())),
            // Not of this layout: it may speak of the units of both columns.
            "Units" if SeriesUnit::parse(value).is_some() => {
                self.units.push((line.number, value.to_owned()));
            }
            "dt" => {
                let number = value.strip_suffix('s').unwrap_or(value);
                let step = number::parse(number.as_bytes()).map_err(|_| {
                    source.error(
                        line.number,
                        0,
                        format!("the time step \"{}\" is not a number of seconds", number::shown(value.as_bytes())),
                        "write it as `# dt: 0.01 s`, or leave the line out: the column of times has the step",
                    )
                })?;
                self.step = Some((line.number, step));
            }
            SAMPLES => {
                let count = value.split([' ', '\t']).next().unwrap_or_default();
                self.samples = count.parse().ok();
                if self.samples.is_none() {
                    unused("the number of samples", "write it as `# Samples: 4000`");
                }
            }
            INITIAL_VELOCITY => {
                self.initial_velocity = Some(initial(source, line, value, Quantity::Velocity)?);
            }
            INITIAL_DISPLACEMENT => {
                let found = initial(source, line, value, Quantity::Displacement)?;
                self.initial_displacement = Some(found);
            }
            _ => {}
        }
        Ok(())
    }
}

/// `-0.25 s`.
fn seconds(value: &str) -> Option<f64> {
    let time: f64 = value.strip_suffix('s')?.trim().parse().ok()?;
    time.is_finite().then_some(time)
}

/// `120 degrees`, up to `most` of them.
fn degrees(value: &str, most: f64) -> Option<f64> {
    let angle: f64 = value.strip_suffix("degrees")?.trim().parse().ok()?;
    (angle.abs() <= most).then_some(angle)
}

/// A velocity (m/s) or a displacement (m) of a key line: a number and its unit.
fn initial(
    source: &Source<'_>,
    line: Line<'_>,
    value: &str,
    quantity: Quantity,
) -> Result<f64, GroundMotionError> {
    let (number, unit) = value.split_once(' ').unwrap_or((value, ""));
    let Some(unit) = SeriesUnit::parse(unit).filter(|unit| unit.quantity == quantity) else {
        return Err(source.error(
            line.number,
            0,
            format!("\"{value}\" is not a {quantity} with its unit"),
            "write it as in `# Initial velocity: -0.0123 m/s` and `# Initial displacement: 0.002 m`",
        ));
    };
    let gravity = AccelerationUnit::StandardGravity.in_si();
    Ok(source.number(line, 0, number.as_bytes())? * unit.in_si(gravity))
}

fn unit_of_header(suffix: &str) -> Result<AccelerationUnit, GroundMotionError> {
    suffix.replacen('_', "/", 1).parse()
}

/// The samples, and whether their times are those of the step that the user gives. A step of the
/// file must be that of its times; one of the user is what others are resampled to.
fn rows(
    source: &Source<'_>,
    lines: &mut Lines<'_>,
    step: Option<f64>,
    times: &mut TimeColumn,
) -> Result<(Vec<f64>, bool), GroundMotionError> {
    let given = source.options.time_step;
    let mut as_given = given.is_some();
    let mut samples = Vec::with_capacity(lines.remaining() / 4 + 1);
    let mut forms = Forms::default();
    for line in lines {
        if line.is_blank() || line.bytes.starts_with(b"#") {
            continue;
        }
        let mut row = line.bytes.split(|b| *b == b',');
        let (Some(time), Some(value), None) = (row.next(), row.next(), row.next()) else {
            let message = if line.bytes.contains(&b'.') {
                "there must be two columns, time and acceleration, with a comma between them"
            } else {
                "there must be two columns, time and acceleration: is the comma both between them and within numbers?"
            };
            return Err(source.error(line.number, 0, message, REMEDY));
        };
        let found = source.number(line, 0, time)?;
        let expected = |step: f64| samples.len() as f64 * step;
        let follows = |step: f64| {
            // Half the step, or what the time's digits leave open.
            let open = (0.51 * step).min(1.01 * number::resolution(time) + 1e-9);
            (found - expected(step)).abs() <= open
        };
        match step {
            Some(step) if !follows(step) => {
                return Err(source.error(
                    line.number,
                    0,
                    format!(
                        "time {found} s where {} s follows from dt = {step} s",
                        bound(expected(step))
                    ),
                    "a row is missing or dt is wrong",
                ));
            }
            Some(_) => {}
            None => {
                as_given &= given.is_some_and(follows);
                times.push(line, found, time);
            }
        }
        samples.push(source.number(line, time.len() + 1, value)?);
        forms.see(line.number, time.len() + 1, value);
    }
    forms.are_whole(source)?;
    Ok((samples, as_given))
}
