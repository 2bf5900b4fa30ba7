//! An Iwan density from a measured dissipation curve, or from a measured backbone.

use std::path::Path;

use pounding_case::{Dimension, unit_in};
use pounding_catalogue::numbers::significant;
use pounding_catalogue::wording::counted;
use pounding_hysteresis::iwan::{
    DensityFit, Fall, FitOptions, MeasuredCurve, density_of_backbone, fit_from_many,
    unknowns_of_fit,
};
use pounding_hysteresis::{LawDescriptor, LawParameters};
use serde::Serialize;

use super::chosen::given;
use crate::arguments::InputPath;
use crate::columns::{Column, Source};
use crate::failure::Failure;
use crate::tables::{new_table, warning_lines};

/// Law whose parameters can be fitted.
const LAW: &str = "iwan_six_parameter";
/// A fitted density beside what was measured.
pub struct Fitted {
    /// The fit.
    pub fit: DensityFit,
    /// Pairs of amplitude (m) and energy of a cycle (J), or of deformation (m) and force (N).
    pub measured: Vec<(f64, f64)>,
    /// Rows of cycles that dissipate nothing, which are not among them.
    pub left_out: usize,
}

/// Name of a curve in `--fit CURVE FILE`, and a header of its file.
fn named(curve: MeasuredCurve) -> (&'static str, &'static str) {
    match curve {
        MeasuredCurve::Dissipation => ("dissipation", "amplitude_mm,dissipation_J"),
        MeasuredCurve::Backbone => ("backbone", "deformation_mm,force_kN"),
    }
}

/// Curve, if one is named, and file of `--fit [CURVE] FILE`.
fn asked(words: &[InputPath]) -> Result<(Option<MeasuredCurve>, &Path), Failure> {
    let curve = |word: &Path| {
        [MeasuredCurve::Backbone, MeasuredCurve::Dissipation]
            .into_iter()
            .find(|curve| word.as_os_str() == named(*curve).0)
    };
    let help = "for example --fit backbone curve.csv, with a header such as deformation_mm,force_kN, or --fit dissipation curve.csv, with amplitude_mm,dissipation_J";
    match words {
        [file] => match curve(file) {
            Some(curve) if !file.exists() => Err(Failure::input(
                format!("--fit {} names no file", named(curve).0),
                Some(help.to_owned()),
            )),
            _ => Ok((None, file)),
        },
        [word, file, ..] => match curve(word) {
            Some(curve) => Ok((Some(curve), file)),
            None => Err(Failure::input(
                format!("--fit knows no curve \"{}\"", word.display()),
                Some(help.to_owned()),
            )),
        },
        [] => Err(Failure::input("--fit names no file", Some(help.to_owned()))),
    }
}

/// Fits the density to the pairs of a file. Parameters of `--set` are held, but for a `phi_1` above zero,
/// where the fit sets out.
pub fn fit(law: &LawDescriptor, words: &[InputPath], set: &[String]) -> Result<Fitted, Failure> {
    if law.name != LAW {
        return Err(Failure::input(
            format!("--fit does not know law {}", law.name),
            Some(format!(
                "it fits the law {LAW}, of which segalman_2005 and song_2004 are cases"
            )),
        ));
    }
    let start = given(pounding_hysteresis::find(LAW)?, set)?;
    let (curve, path) = asked(words)?;
    let Measured {
        curve,
        pairs: measured,
        left_out,
    } = read(path, curve, &start)?;
    let fit = fit_from_many(curve, &measured, &start, FitOptions::default())?;
    Ok(Fitted {
        fit,
        measured,
        left_out,
    })
}

/// What a file holds.
struct Measured {
    curve: MeasuredCurve,
    pairs: Vec<(f64, f64)>,
    /// Rows of cycles that dissipate nothing.
    left_out: usize,
}

/// Pairs of amplitude (m) and energy of a cycle (J), or of deformation (m) and force (N) on first
/// loading, all positive: the unit of the second column says which, and is that of the curve asked
/// for. Cycles that dissipate nothing, below a threshold, are left out and counted.
fn read(
    path: &Path,
    asked: Option<MeasuredCurve>,
    start: &LawParameters,
) -> Result<Measured, Failure> {
    let column = |name, dimension| Column { name, dimension };
    let force = column("force", Dimension::FORCE);
    let energy = column("dissipation", Dimension::ENERGY);
    let example = named(asked.unwrap_or(MeasuredCurve::Dissipation)).1;
    let source = Source::of_option(path, "--fit", example)?;
    let header = source.lines().next();
    let second = header
        .as_ref()
        .and_then(|(_, fields)| unit_in(fields.get(1)?));
    let is = |column: &Column| second.is_some_and(|unit| column.size(unit).is_ok());
    let found = match (is(&force), is(&energy)) {
        (true, _) => Some(MeasuredCurve::Backbone),
        (_, true) => Some(MeasuredCurve::Dissipation),
        _ => None,
    };
    if let (Some(asked), Some(found), Some((place, _))) = (asked, found, &header)
        && asked != found
    {
        return Err(source.error(
            place.clone(),
            format!(
                "--fit {} asks for a {}, but the second column is in \"{}\", as of a {}",
                named(asked).0,
                named(asked).0,
                second.unwrap_or_default(),
                named(found).0
            ),
            &format!(
                "give --fit {}, or a file with a header such as {}",
                named(found).0,
                named(asked).1
            ),
        ));
    }
    // Another unit is none of the curve asked for.
    let is_backbone = asked.or(found) == Some(MeasuredCurve::Backbone);
    let (curve, columns) = match is_backbone {
        true => (
            MeasuredCurve::Backbone,
            [column("deformation", Dimension::LENGTH), force],
        ),
        false => (
            MeasuredCurve::Dissipation,
            [column("amplitude", Dimension::LENGTH), energy],
        ),
    };
    let mut pairs: Vec<(f64, f64)> = Vec::new();
    let (mut places, mut zeros) = (Vec::new(), Vec::new());
    for (place, row) in source.rows(&[&columns])? {
        let (reach, value) = (row[0], row[1]);
        let before = pairs.last().map_or(0.0, |(reach, _)| *reach);
        // A backbone begins at zero.
        if is_backbone && reach == 0.0 && value == 0.0 && pairs.is_empty() {
            continue;
        }
        // Laws with a threshold dissipate nothing below it, and relative errors of nothing are none.
        if !is_backbone && reach > 0.0 && value == 0.0 {
            zeros.push((reach, place));
            continue;
        }
        if !(reach > 0.0 && value > 0.0) {
            let (what, help) = match is_backbone {
                true => (
                    "deformation and force",
                    "give the first loading, from zero on",
                ),
                false => (
                    "amplitude and dissipation",
                    "give the energy that a cycle dissipates over its amplitude, both above zero; cycles that dissipate nothing are left out",
                ),
            };
            let message = format!("{what} must be greater than zero");
            return Err(source.error(place, message, help));
        }
        if is_backbone && !(reach > before) {
            return Err(source.error(
                place,
                "the deformation does not grow here".to_owned(),
                "give the first loading alone, without unloading",
            ));
        }
        pairs.push((reach, value));
        places.push(place);
    }
    let least = pairs.iter().map(|(reach, _)| *reach);
    let least = least.fold(f64::INFINITY, f64::min);
    let left_out = zeros.len();
    if let Some((_, place)) = zeros.into_iter().find(|(reach, _)| *reach > least) {
        return Err(source.error(
            place,
            format!(
                "this cycle dissipates nothing, but one of {} mm does",
                significant(1.0e3 * least)
            ),
            "correct the row or leave it out: below a threshold alone a cycle dissipates nothing",
        ));
    }
    if let Some(fall) = Fall::of(curve, &pairs) {
        let place = places.swap_remove(fall.place);
        return Err(source.error(place, fall.to_string(), fall.remedy()));
    }
    let unknowns = unknowns_of_fit(curve, start)?;
    if pairs.len() < unknowns {
        return Err(source.error(
            0..0,
            format!(
                "{} of numbers above zero for {}{}",
                counted(pairs.len(), "row"),
                counted(unknowns, "unknown"),
                without(left_out)
            ),
            "measure more amplitudes, or hold with --set what is known, such as slider_stiffness=0",
        ));
    }
    Ok(Measured {
        curve,
        pairs,
        left_out,
    })
}

/// Rows that are left out, in words.
fn without(rows: usize) -> String {
    match rows {
        0 => String::new(),
        n => format!(
            ", without {} of cycles that dissipate nothing",
            counted(n, "row")
        ),
    }
}

impl Fitted {
    /// What the fit has at a deformation (m).
    pub fn fitted(&self, deformation: f64) -> f64 {
        self.fit.curve.value(&self.fit.density, deformation)
    }

    /// Measured beside fitted, for people.
    pub fn text(&self) -> String {
        let (over, unit) = match self.fit.curve {
            MeasuredCurve::Dissipation => ("amplitude (mm)", "J"),
            MeasuredCurve::Backbone => ("deformation (mm)", "N"),
        };
        let measured = format!("measured ({unit})");
        let fitted = format!("fitted ({unit})");
        let mut table = new_table([over, measured.as_str(), fitted.as_str(), "error (%)"]);
        for (reach, value) in &self.measured {
            let fitted = self.fitted(*reach);
            table.add_row([
                significant(1.0e3 * reach),
                significant(*value),
                significant(fitted),
                format!("{:+.2}", 100.0 * (fitted / value - 1.0)),
            ]);
        }
        let count = match self.fit.curve {
            MeasuredCurve::Dissipation => counted(self.measured.len(), "measured cycle"),
            MeasuredCurve::Backbone => format!("{} points of the backbone", self.measured.len()),
        };
        let held = match &self.held()[..] {
            [] => String::new(),
            held => format!("held as given: {}\n", held.join(", ")),
        };
        let mut text = format!(
            "\nFitted to {count}{}\n{held}{table}\nroot mean square of the relative errors {:.3} %, {}\ninitial stiffness {} N/m, of which residual_stiffness = {} N/m ",
            without(self.left_out),
            100.0 * self.fit.relative_error,
            counted(self.fit.iterations, "iteration"),
            significant(self.fit.density.initial_stiffness()),
            significant(self.fit.density.residual_stiffness),
        );
        text.push_str(match self.fit.curve {
            MeasuredCurve::Dissipation => "is taken as given: a spring does not dissipate\n",
            MeasuredCurve::Backbone => "never slips\n",
        });
        text.push_str(&self.density_text());
        text.push_str(&warning_lines(&self.fit.doubts(&self.measured)));
        text
    }

    /// Names of the parameters that were not fitted but given.
    fn held(&self) -> Vec<&'static str> {
        let held = self.fit.held;
        // That of cycles is held even where nobody gave it, and is said in its own words.
        let is_backbone = self.fit.curve == MeasuredCurve::Backbone;
        let all = [
            ("exponent", held.exponent),
            ("phi_2", held.phi_2),
            ("slider_stiffness", held.slider_stiffness),
            ("residual_stiffness", held.residual_stiffness && is_backbone),
        ];
        let held = all.into_iter().filter(|(_, is_held)| *is_held);
        held.map(|(name, _)| name).collect()
    }

    /// The density by the curvature of a backbone, for people.
    fn density_text(&self) -> String {
        let curvature = self.curvature();
        if curvature.is_empty() {
            return String::new();
        }
        let mut table = new_table(["phi (mm)", "density by curvature (N/m2)", "fitted (N/m2)"]);
        for (phi, density) in &curvature {
            let of = &self.fit.density;
            let inside = (of.phi_1..of.phi_2).contains(phi);
            let fitted = if inside {
                of.density * phi.powf(of.exponent)
            } else {
                0.0
            };
            table.add_row([
                significant(1.0e3 * phi),
                significant(*density),
                significant(fitted),
            ]);
        }
        format!(
            "\nDensity of sliders, -F'': by differences, and of the fit without its lump\n{table}\n"
        )
    }

    /// The density (N/m2) at deformations (m) by the curvature of a backbone; nothing of other
    /// curves.
    fn curvature(&self) -> Vec<(f64, f64)> {
        match self.fit.curve {
            MeasuredCurve::Backbone => density_of_backbone(&self.measured).unwrap_or_default(),
            MeasuredCurve::Dissipation => Vec::new(),
        }
    }

    /// For machines, SI.
    pub fn shown(&self) -> ShownFit {
        let measured = self.measured.iter();
        let over = match self.fit.curve {
            MeasuredCurve::Dissipation => "amplitude",
            MeasuredCurve::Backbone => "deformation",
        };
        ShownFit {
            columns: [over, "measured", "fitted"],
            curve: measured.map(|(a, d)| (*a, *d, self.fitted(*a))).collect(),
            density_by_curvature: self.curvature(),
            held: self.held(),
            rows_left_out: self.left_out,
            relative_error: self.fit.relative_error,
            warnings: self
                .fit
                .doubts(&self.measured)
                .iter()
                .map(ToString::to_string)
                .collect(),
            iterations: self.fit.iterations,
        }
    }
}

/// A fit for machines.
#[derive(Serialize)]
pub struct ShownFit {
    columns: [&'static str; 3],
    curve: Vec<(f64, f64, f64)>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    density_by_curvature: Vec<(f64, f64)>,
    held: Vec<&'static str>,
    rows_left_out: usize,
    relative_error: f64,
    warnings: Vec<String>,
    iterations: usize,
}
