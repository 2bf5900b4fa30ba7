//! A hazard curve from a table: intensity and mean annual frequency.

use std::borrow::Cow;
use std::path::Path;

use pounding_case::document::schema_of;
use pounding_case::{Dimension, parse_quantity, read_regular_text};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};

use super::IntensityMeasure;
use super::annual_frequency::PER_YEAR;
use super::hazard_curve::HAZARD_NUMBERS;

/// Message, with file and line, and remedy.
pub(super) type Refusal = (String, String);
/// Intensity and frequency, with the line that they stand in, from 1.
pub(super) type PointOfLine = (usize, (f64, f64));

/// What a column holds.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Column {
    /// Intensity; one of its unit in SI.
    Intensity(f64),
    /// Mean annual frequency (1/year).
    Frequency,
}

/// Names of any intensity, of those of one measure, and of frequencies.
const ANY_INTENSITY: [&str; 3] = ["intensity", "im", "intensity_measure"];
const GROUND_ACCELERATION: [&str; 2] = ["pga", "peak_ground_acceleration"];
const GROUND_VELOCITY: [&str; 2] = ["pgv", "peak_ground_velocity"];
const SPECTRAL: [&str; 3] = ["sa", "psa", "spectral_acceleration"];
const AVERAGE_SPECTRAL: [&str; 4] = ["sa_avg", "avg_sa", "saavg", "average_spectral_acceleration"];
/// Frequencies that say by their name that they are those of a year.
const ANNUAL: [&str; 5] = [
    "mean_annual_frequency",
    "annual_frequency",
    "mean_annual_rate",
    "annual_rate",
    "mafe",
];
const FREQUENCY: [&str; 3] = ["frequency", "rate", "lambda"];

/// Part by which a period in a header may differ from that of the study: it is rounded.
const PERIOD_TOLERANCE: f64 = 0.01;

/// The points of a hazard curve, as a schema knows them.
pub(super) struct Points;

impl JsonSchema for Points {
    fn schema_name() -> Cow<'static, str> {
        "hazard curve".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "title": "pounding hazard curve",
            "description": "Points of a hazard curve, intensities rising and frequencies falling: a list of pairs in a study, or the rows of a CSV file of two columns whose header has one of `names` for each, with its unit such as `sa (g)` or `sa_g`",
            "type": "array",
            "minItems": 2,
            "items": {
                "type": "array",
                "minItems": 2,
                "maxItems": 2,
                "prefixItems": [
                    {
                        "title": "intensity",
                        "description": "Intensity in the measure of the study (SI, or with a unit); a column states its unit",
                        "type": ["number", "string"],
                        "minimum": HAZARD_NUMBERS.start(),
                        "maximum": HAZARD_NUMBERS.end(),
                        "names": {
                            "of_any_measure": ANY_INTENSITY,
                            "peak_ground_acceleration": GROUND_ACCELERATION,
                            "peak_ground_velocity": GROUND_VELOCITY,
                            "spectral_acceleration": SPECTRAL,
                            "average_spectral_acceleration": AVERAGE_SPECTRAL,
                        },
                    },
                    {
                        "title": "frequency",
                        "description": "Mean annual frequency with which the intensity is exceeded (1/year); a column states its unit unless its name does",
                        "type": ["number", "string"],
                        "minimum": HAZARD_NUMBERS.start(),
                        "maximum": HAZARD_NUMBERS.end(),
                        "names": { "without_unit": ANNUAL, "with_unit": FREQUENCY },
                        "units": PER_YEAR,
                    },
                ],
            },
        })
    }
}

/// JSON Schema (2020-12) of the points of a hazard curve, with the names that a CSV file may
/// have for its columns.
#[must_use]
pub fn hazard_schema() -> serde_json::Value {
    schema_of::<Points>("pounding/hazard.schema.json")
}

/// A file on its way to points.
struct Table<'t> {
    file: String,
    measure: &'t IntensityMeasure,
}

/// The text of a file.
///
/// # Errors
/// A file that cannot be read.
pub(super) fn text(path: &Path) -> Result<String, Vec<Refusal>> {
    read_regular_text(path, "hazard").map_err(|e| {
        let relative = "a path in a study is relative to the folder of the study".to_owned();
        let help = match path.is_file() {
            true => e.help.clone().unwrap_or(relative),
            false => relative,
        };
        vec![(e.to_string(), help)]
    })
}

/// Reads points from a file of two columns; lines that start with `#` are comments. A
/// header names them with their units, in either order; without one the first line is a
/// point already: intensity in SI, frequency in 1/year. Each point has its line, from 1. Also says whether there is a header,
/// which states the unit of intensities.
///
/// # Errors
/// All that is wrong in the file, each with its line.
pub(super) fn points(
    path: &Path,
    text: &str,
    measure: &IntensityMeasure,
) -> Result<(Vec<PointOfLine>, bool), Vec<Refusal>> {
    let file = path.display().to_string();
    Table { file, measure }.points(text.trim_start_matches('\u{feff}'))
}

impl Table<'_> {
    fn points(&self, text: &str) -> Result<(Vec<PointOfLine>, bool), Vec<Refusal>> {
        let (mut columns, mut has_header) = (None, false);
        let (mut points, mut wrong) = (Vec::new(), Vec::new());
        for (line, content) in text.lines().enumerate() {
            if content.trim().is_empty() || content.trim_start().starts_with('#') {
                continue;
            }
            match self.line(line, content, &mut columns) {
                Ok(Some(point)) => points.push((line + 1, point)),
                Ok(None) => has_header = true,
                Err(refusal) => wrong.push(refusal),
            }
            // Without its header no line can be read.
            if columns.is_none() {
                break;
            }
        }
        if wrong.is_empty() {
            Ok((points, has_header))
        } else {
            Err(wrong)
        }
    }

    /// A line: a point, or the header, which says what the columns are.
    fn line(
        &self,
        line: usize,
        content: &str,
        columns: &mut Option<[Column; 2]>,
    ) -> Result<Option<(f64, f64)>, Refusal> {
        let separator = ['\t', ';', ','].into_iter().find(|s| content.contains(*s));
        let fields: Vec<&str> = match separator {
            Some(separator) => content.split(separator).collect(),
            None => content.split_whitespace().collect(),
        };
        let [a, b] = fields[..] else {
            let message = format!("there are {} columns here", fields.len());
            let help = "give two columns, intensity and mean annual frequency, separated by commas, with decimal points";
            return Err(self.wrong(line, &message, help));
        };
        let cells = [a, b].map(|f| f.trim().trim_matches('"').trim());
        let known = match *columns {
            Some(known) => known,
            // A damaged number is still none of a header's words.
            None if cells.iter().any(|c| looks_numeric(c)) => {
                *columns.insert([Column::Intensity(1.0), Column::Frequency])
            }
            None => {
                *columns = Some(self.header(line, cells)?);
                return Ok(None);
            }
        };
        self.point(line, cells, known).map(Some)
    }

    fn wrong(&self, line: usize, message: &str, help: &str) -> Refusal {
        let place = format!("{}:{}: {message}", self.file, line + 1);
        (place, help.to_owned())
    }

    fn header(&self, line: usize, cells: [&str; 2]) -> Result<[Column; 2], Refusal> {
        let columns = [self.column(line, cells[0])?, self.column(line, cells[1])?];
        match columns {
            [Column::Intensity(_), Column::Frequency]
            | [Column::Frequency, Column::Intensity(_)] => Ok(columns),
            _ => Err(self.wrong(
                line,
                &format!("\"{},{}\" names one quantity twice", cells[0], cells[1]),
                &self.example(),
            )),
        }
    }

    /// A column by its name and unit: `sa (g)`, `sa [g]`, `sa_g`, `intensity_m_s2`.
    fn column(&self, line: usize, cell: &str) -> Result<Column, Refusal> {
        let (name, unit) = self.name_and_unit(line, cell)?;
        if is_frequency(&name) {
            return match unit {
                Some(unit) if PER_YEAR.contains(&unit.to_lowercase().as_str()) => {
                    Ok(Column::Frequency)
                }
                None if ANNUAL.contains(&name.as_str()) => Ok(Column::Frequency),
                _ => Err(self.wrong(
                    line,
                    &format!("frequencies are taken in 1/year, which \"{cell}\" does not say"),
                    &self.example(),
                )),
            };
        }
        let Some(unit) = unit else {
            return Err(self.wrong(
                line,
                &format!("\"{cell}\" does not say its unit"),
                &self.example(),
            ));
        };
        let wanted = self.measure.dimension();
        match parse_quantity(&format!("1 {unit}")) {
            Ok(q) if q.dimension == Some(wanted) => Ok(Column::Intensity(q.value)),
            Ok(q) => {
                let found = q.dimension.unwrap_or(Dimension::NUMBER);
                let message = format!("the intensity must be {wanted}, but \"{unit}\" is {found}");
                Err(self.wrong(line, &message, &self.example()))
            }
            Err(e) => Err(self.wrong(line, &format!("\"{cell}\": {e}"), &e.help())),
        }
    }

    /// Both in one cell; the name is known.
    fn name_and_unit(&self, line: usize, cell: &str) -> Result<(String, Option<String>), Refusal> {
        let plain = |text: &str| {
            let words: Vec<String> = text
                .to_lowercase()
                .split([' ', '_', '-'])
                .filter(|w| !w.is_empty())
                .map(str::to_owned)
                .collect();
            let name = words.join("_");
            name.strip_suffix("_of_exceedance")
                .unwrap_or(&name)
                .to_owned()
        };
        let known = |name: &str| is_frequency(name) || self.names().any(|n| n == name);
        if let Some((name, rest)) = cell.split_once(['(', '[']) {
            // `Sa(1.0 s) (g)`: a period, then the unit.
            let (period, unit) = match rest.split_once([')', ']']) {
                Some((period, unit)) if !unit.trim().is_empty() => (Some(period), unit),
                _ => (None, rest),
            };
            let brackets = ['(', '[', ')', ']', ' ', '_', ','];
            let unit = unit.trim_matches(brackets).to_owned();
            if known(&plain(name)) {
                if let Some(period) = period {
                    self.at_period(line, cell, period)?;
                }
                return Ok((plain(name), Some(unit)));
            }
        } else {
            if known(&plain(cell)) {
                return Ok((plain(cell), None));
            }
            // The longest name that leaves a unit behind.
            let cuts = cell.rmatch_indices(['_', ' ']).map(|(at, _)| at);
            for at in cuts {
                if known(&plain(&cell[..at])) {
                    return Ok((plain(&cell[..at]), Some(with_slash(&cell[at + 1..]))));
                }
            }
        }
        let names: Vec<&str> = self.names().collect();
        let help = format!(
            "name the intensity one of {}, the frequency one of {}, {}; {}",
            names.join(", "),
            ANNUAL.join(", "),
            FREQUENCY.join(", "),
            self.example()
        );
        Err(self.wrong(
            line,
            &format!("\"{cell}\" names neither the intensity of this study ({}) nor a mean annual frequency", self.measure.title()),
            &help,
        ))
    }

    /// Whether a period in a name is that of the study's intensity.
    fn at_period(&self, line: usize, cell: &str, period: &str) -> Result<(), Refusal> {
        let stated = parse_quantity(period).ok();
        let stated = stated.filter(|q| q.dimension.is_none_or(|d| d == Dimension::TIME));
        let own = match self.measure {
            IntensityMeasure::SpectralAcceleration { periods, .. } => periods.as_slice(),
            _ => &[],
        };
        let near = |own: f64, stated: f64| (own - stated).abs() <= PERIOD_TOLERANCE * own;
        match (stated, own) {
            (Some(stated), [own]) if near(*own, stated.value) => Ok(()),
            _ => Err(self.wrong(
                line,
                &format!(
                    "the intensity of this study is {}, which \"{cell}\" is not",
                    self.measure.title()
                ),
                &self.example(),
            )),
        }
    }

    /// Names of the intensity that the study has.
    fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        let (own, more): (&[&str], &[&str]) = match self.measure {
            IntensityMeasure::PeakGroundAcceleration => (&GROUND_ACCELERATION, &[]),
            IntensityMeasure::PeakGroundVelocity => (&GROUND_VELOCITY, &[]),
            // The mean at several periods is an average.
            IntensityMeasure::SpectralAcceleration { periods, .. } if periods.len() > 1 => {
                (&SPECTRAL, &AVERAGE_SPECTRAL)
            }
            IntensityMeasure::SpectralAcceleration { .. } => (&SPECTRAL, &[]),
            IntensityMeasure::AverageSpectralAcceleration { .. } => (&AVERAGE_SPECTRAL, &[]),
        };
        ANY_INTENSITY.iter().chain(own).chain(more).copied()
    }

    fn example(&self) -> String {
        let unit = match self.measure {
            IntensityMeasure::PeakGroundVelocity => "m/s",
            _ => "g",
        };
        format!("write a header such as `intensity ({unit}),frequency (1/year)`")
    }

    fn point(
        &self,
        line: usize,
        cells: [&str; 2],
        columns: [Column; 2],
    ) -> Result<(f64, f64), Refusal> {
        let (mut intensity, mut frequency) = (0.0, 0.0);
        for (cell, column) in cells.into_iter().zip(columns) {
            let number = match cell.parse::<f64>() {
                Ok(x) if x.is_finite() => x,
                _ => {
                    let message = format!("\"{cell}\" is not a finite number");
                    let help = "write numbers such as 0.5 or 1.2e-3; units stand in the header";
                    return Err(self.wrong(line, &message, help));
                }
            };
            match column {
                Column::Intensity(unit) => intensity = number * unit,
                Column::Frequency => frequency = number,
            }
        }
        Ok((intensity, frequency))
    }
}

fn is_frequency(name: &str) -> bool {
    ANNUAL.contains(&name) || FREQUENCY.contains(&name)
}

/// `m/s2` out of `m_s2`, `1/year` out of `1_year`.
fn with_slash(unit: &str) -> String {
    if unit.eq_ignore_ascii_case("per_year") {
        return "1/year".to_owned();
    }
    unit.replacen('_', "/", 1)
}

fn looks_numeric(cell: &str) -> bool {
    cell.parse::<f64>().is_ok()
        || cell
            .trim_start_matches(['+', '-', '.'])
            .starts_with(|c: char| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const G: f64 = 9.80665;

    fn spectral() -> IntensityMeasure {
        IntensityMeasure::SpectralAcceleration {
            periods: vec![1.0],
            damping: 0.05,
        }
    }

    fn of(measure: &IntensityMeasure, text: &str) -> Result<Vec<(f64, f64)>, Vec<Refusal>> {
        let file = "hazard.csv".to_owned();
        let (points, _) = Table { file, measure }.points(text)?;
        Ok(points.into_iter().map(|(_, point)| point).collect())
    }

    /// The same two points in every way of writing a header, and without one.
    #[test]
    fn headers_say_units() {
        let si = [(0.5 * G, 1e-2), (2.0 * G, 1e-4)];
        let text = |header: &str| format!("# made up\n{header}\n0.5,1e-2\n\n2.0,1e-4\n");
        for header in [
            "intensity (g),mean_annual_frequency",
            "intensity_g,mean annual frequency of exceedance",
            "Intensity [g], Frequency (1/year)",
            "sa (g),lambda (1/yr)",
            "Sa_g,frequency_per_year",
            "\"spectral acceleration (g)\",rate [1/year]",
            "Sa(1.0 s) (g),mafe",
            "sa(1 s)_g,mafe",
        ] {
            assert_eq!(of(&spectral(), &text(header)).unwrap(), si, "{header}");
        }
        let swapped = "frequency (1/year);intensity (g)\n1e-2;0.5\n1e-4;2.0\n";
        assert_eq!(of(&spectral(), swapped).unwrap(), si);
        for (header, unit) in [
            ("intensity_m_s2", 1.0),
            ("psa (cm/s2)", 0.01),
            ("im [cm/s^2]", 0.01),
            ("sa_gal", 0.01),
        ] {
            let found = of(&spectral(), &text(&format!("{header},annual_rate"))).unwrap();
            assert_eq!(found, [(0.5 * unit, 1e-2), (2.0 * unit, 1e-4)], "{header}");
        }
        let average = IntensityMeasure::AverageSpectralAcceleration {
            periods: vec![0.5, 1.0],
            damping: 0.05,
        };
        assert_eq!(of(&average, &text("sa_avg (g),mafe")).unwrap(), si);
        assert!(of(&average, &text("sa (g),mafe")).is_err());
        let velocity = IntensityMeasure::PeakGroundVelocity;
        let found = of(&velocity, "pgv_cm_s,mafe\n50,1e-2\n").unwrap();
        assert_eq!(found, [(0.5, 1e-2)]);
        // Without a header no point is lost, and numbers are SI.
        let found = of(
            &spectral(),
            "\u{feff}0.5,1e-2\n2.0,1e-4\n".trim_start_matches('\u{feff}'),
        );
        assert_eq!(found.unwrap(), [(0.5, 1e-2), (2.0, 1e-4)]);
    }

    #[test]
    fn what_is_not_understood_is_refused_with_its_line() {
        for (text, line, reason) in [
            (
                "intensity,mean_annual_frequency\n1,2\n",
                1,
                "does not say its unit",
            ),
            ("# x\n\nintensity (g),frequency\n1,2\n", 3, "1/year"),
            ("intensity (g),frequency (1/s)\n1,2\n", 1, "1/year"),
            ("intensity (m),mafe\n1,2\n", 1, "is a length (m)"),
            ("intensity (bananas),mafe\n1,2\n", 1, "bananas"),
            ("pga (g),mafe\n1,2\n", 1, "neither the intensity"),
            (
                "intensity (g),return period (years)\n1,2\n",
                1,
                "neither the intensity",
            ),
            ("intensity (g),sa (g)\n1,2\n", 1, "twice"),
            ("sa_avg (g),mafe\n1,2\n", 1, "neither the intensity"),
            (
                "Sa(0.5 s) (g),mafe\n1,2\n",
                1,
                "of this study is PSA(1.0000 s)",
            ),
            ("0.5,1e-2\n1.0,x\n", 2, "\"x\" is not a finite number"),
            (
                "0.5g,1e-2\n1.0,1e-3\n",
                1,
                "\"0.5g\" is not a finite number",
            ),
            ("0.5,1e-2,3\n", 1, "3 columns"),
            ("0.5,nan\n", 1, "not a finite number"),
        ] {
            let refusals = of(&spectral(), text).unwrap_err();
            let [(message, help)] = refusals.as_slice() else {
                panic!("{text}: {refusals:?}");
            };
            assert!(
                message.starts_with(&format!("hazard.csv:{line}: ")),
                "{message}"
            );
            assert!(message.contains(reason) && !help.is_empty(), "{message}");
        }
    }
}
