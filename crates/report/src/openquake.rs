//! Fragilities of an incremental dynamic analysis as OpenQuake reads them: a `fragilityModel` of NRML 0.5.
//!
//! OpenQuake takes the states of one fragility function for stages of one damage, each beyond the one before. The states of an
//! analysis are none of each other: every one is a function by itself, with the one limit state [`REACHED`].

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::rounded_up;
use pounding_study::{FragilityFit, IdaReport, IntensityMeasure};
use thiserror::Error;
use xmlwriter::{Indent, Options, XmlWriter};

use crate::page::escaped;

/// The limit state of every function.
pub const REACHED: &str = "reached";

/// Damping ratio of spectral accelerations in OpenQuake.
const DAMPING: f64 = 0.05;

/// Decimals of the least widths (mm), which suffice as they are shown.
const DECIMALS: usize = 2;

/// Characters that the name of a function may have.
const LONGEST: usize = 75;

/// Dispersions from the median to the ends of a function, beyond which OpenQuake goes on with the probability at the end:
/// 1e-9 and one less 1e-9.
const REACH: f64 = 6.0;

/// An intensity measure that OpenQuake does not have.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("OpenQuake has no intensity measure for {measure}")]
pub struct NoMeasure {
    /// The measure of the study, for people.
    pub measure: String,
}

impl NoMeasure {
    /// What to take instead.
    #[must_use]
    pub fn help(&self) -> String {
        format!(
            "take `peak_ground_acceleration`, `peak_ground_velocity`, `spectral_acceleration` with one `period` (or one building) and `damping = {DAMPING}`, or `average_spectral_acceleration` with it"
        )
    }
}

/// Fragilities for OpenQuake.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FragilityModel {
    /// The file.
    pub xml: String,
    /// States without a fragility, which the file does not have.
    pub left_out: Vec<String>,
}

/// An intensity measure as OpenQuake knows it.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    name: String,
    /// Its unit there, in SI.
    unit: f64,
}

impl Measure {
    /// The name of a measure in OpenQuake.
    ///
    /// # Errors
    /// [`NoMeasure`]: the geometric mean of several periods, or another damping ratio than 5 %.
    pub fn of(measure: &IntensityMeasure) -> Result<Self, NoMeasure> {
        let damped = |damping: f64| (damping - DAMPING).abs() < 1.0e-12;
        let (name, unit) = match measure {
            IntensityMeasure::PeakGroundAcceleration => ("PGA".to_owned(), STANDARD_GRAVITY),
            // In cm/s.
            IntensityMeasure::PeakGroundVelocity => ("PGV".to_owned(), 0.01),
            IntensityMeasure::SpectralAcceleration { periods, damping }
                if periods.len() == 1 && damped(*damping) =>
            {
                (format!("SA({:?})", periods[0]), STANDARD_GRAVITY)
            }
            IntensityMeasure::AverageSpectralAcceleration { damping, .. } if damped(*damping) => {
                ("AvgSA".to_owned(), STANDARD_GRAVITY)
            }
            other => {
                return Err(NoMeasure {
                    measure: other.title(),
                });
            }
        };
        Ok(Self { name, unit })
    }
}

/// Writes the states of an analysis that have a fragility as a fragility model with the name and the title of the study.
#[must_use]
pub fn fragility_model(
    report: &IdaReport,
    measure: &Measure,
    (name, title): (&str, &str),
) -> FragilityModel {
    let limits = report.limits.iter().chain(&report.least_gaps_together);
    let limits = limits.map(|state| (state.name.clone(), state));
    let widths = report.gaps.iter().flat_map(|gap| {
        let least = gap.minimum.iter().filter_map(|minimum| {
            let width = rounded_up(1.0e3 * minimum.width?, DECIMALS);
            Some((of_width(&gap.gap, &width), &minimum.result))
        });
        let asked = gap.widths.iter();
        let asked = asked.map(|width| {
            // Hundredths of a millimetre.
            let shown = (1.0e5 * width.width).round() / 100.0;
            (of_width(&gap.gap, &shown.to_string()), &width.result)
        });
        asked.chain(least)
    });
    let mut taken: Vec<String> = Vec::new();
    let mut functions = Vec::new();
    let mut left_out: Vec<String> = Vec::new();
    for (name, state) in limits.chain(widths) {
        match state.fit {
            FragilityFit::Lognormal(fit) => {
                let id = identifier(&name, &taken);
                taken.push(id.clone());
                functions.push((id, name, [fit.median, fit.dispersion]));
            }
            _ => left_out.push(name),
        }
    }
    let options = Options {
        indent: Indent::Spaces(2),
        ..Options::default()
    };
    let mut xml = XmlWriter::new(options);
    xml.write_declaration();
    xml.start_element("nrml");
    xml.write_attribute("xmlns", "http://openquake.org/xmlns/nrml/0.5");
    xml.start_element("fragilityModel");
    xml.write_attribute("id", &identifier(name, &[]));
    xml.write_attribute("assetCategory", "buildings");
    xml.write_attribute("lossCategory", "structural");
    xml.start_element("description");
    // The writer escapes no ampersands.
    xml.write_text(&escaped(&description(report, title, &functions)));
    xml.end_element();
    xml.start_element("limitStates");
    xml.write_text(REACHED);
    xml.end_element();
    for (id, _, [median, dispersion]) in &functions {
        let median = median / measure.unit;
        xml.start_element("fragilityFunction");
        xml.write_attribute("id", id);
        xml.write_attribute("format", "continuous");
        xml.write_attribute("shape", "logncdf");
        xml.start_element("imls");
        xml.write_attribute("imt", &measure.name);
        let end = |side: f64| median * (side * REACH * dispersion).exp();
        xml.write_attribute("minIML", &digits(end(-1.0)));
        xml.write_attribute("maxIML", &digits(end(1.0)));
        xml.end_element();
        // Mean and deviation of the intensity, not of its logarithm.
        let variance = dispersion * dispersion;
        let mean = median * (0.5 * variance).exp();
        xml.start_element("params");
        xml.write_attribute("ls", REACHED);
        xml.write_attribute("mean", &digits(mean));
        xml.write_attribute("stddev", &digits(mean * variance.exp_m1().sqrt()));
        xml.end_element();
        xml.end_element();
    }
    FragilityModel {
        xml: xml.end_document(),
        left_out,
    }
}

/// Pounding at a width of a gap (mm).
fn of_width(gap: &str, width: &str) -> String {
    format!("pounding of {gap} at {width} mm")
}

/// All digits of a number.
fn digits(x: f64) -> String {
    format!("{x:e}")
}

/// What the functions are of.
fn description(
    report: &IdaReport,
    title: &str,
    functions: &[(String, String, [f64; 2])],
) -> String {
    let mut text = match title {
        "" => String::new(),
        title => format!("{title}. "),
    };
    text.push_str(&format!("Intensity: {}. Functions: ", report.measure));
    let of = functions.iter().map(|(id, name, _)| match id == name {
        true => id.clone(),
        false => format!("{id} is {name}"),
    });
    let of: Vec<String> = of.collect();
    text.push_str(&of.join("; "));
    text.push('.');
    text
}

/// A name of the characters that OpenQuake takes, other than those that are taken.
fn identifier(name: &str, taken: &[String]) -> String {
    let mut id = String::new();
    for c in name.chars() {
        let c = match c {
            c if c.is_ascii_alphanumeric() || c == '-' => c,
            _ => '_',
        };
        // One for several.
        if !(c == '_' && id.ends_with('_')) {
            id.push(c);
        }
    }
    id.truncate(LONGEST - 5);
    let id = match id.trim_matches('_') {
        "" => "state".to_owned(),
        id => id.to_owned(),
    };
    let numbered = (2..).map(|n: usize| format!("{id}_{n}"));
    let mut tried = std::iter::once(id.clone()).chain(numbered);
    tried.find(|id| !taken.contains(id)).unwrap_or(id)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_of_few_characters_and_differ() {
        let first = identifier("light roof above 2 g", &[]);
        assert_eq!(first, "light_roof_above_2_g");
        let second = identifier("light roof above 2 g!", std::slice::from_ref(&first));
        assert_eq!(second, "light_roof_above_2_g_2");
        assert_eq!(identifier("\u{52a0}", &[]), "state");
        assert!(identifier(&"x".repeat(300), &[]).len() <= LONGEST);
    }
}
