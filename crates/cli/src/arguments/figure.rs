//! Files of figures and how wide these are.

use clap::builder::{OsStringValueParser, TypedValueParser};
use clap::{ArgGroup, Args};
use pounding_case::Dimension;
use pounding_report::{PAGE, PictureFormat};

use super::OutputPath;
use super::quantities::of_dimension;

/// Widths (mm) at which text of a fixed size still leaves room for axes, and that a page holds.
const WIDTHS: (f64, f64) = (60.0, 500.0);

/// The arguments of a command that name files of figures.
pub const FIGURES: &str = "figures";

/// How figures are drawn.
#[derive(Args, Clone, Copy, Debug)]
#[command(group = ArgGroup::new(FIGURES).multiple(true))]
pub struct FigureArguments {
    /// Width of the figure, such as "90 mm" for a column of a journal; its text is 8.5 pt
    #[arg(long, value_name = "WIDTH", default_value = "190 mm", value_parser = width, requires = FIGURES)]
    figure_width: Millimetres,
}

/// A width (mm).
#[derive(Clone, Copy, Debug)]
struct Millimetres(f64);

impl FigureArguments {
    /// Width of the figure (mm).
    pub fn millimetres(&self) -> f64 {
        self.figure_width.0
    }
}

fn width(text: &str) -> Result<Millimetres, String> {
    let width = 1.0e3 * of_dimension(text, Dimension::LENGTH)?;
    // A millimetre in metres has no exact value.
    let width = (1.0e6 * width).round() / 1.0e6;
    let (least, most) = WIDTHS;
    match (least..=most).contains(&width) {
        true => Ok(Millimetres(width)),
        false => Err(format!(
            "figures are {least} to {most} mm wide: give 90 mm for a column, {PAGE} mm for a page"
        )),
    }
}

/// A file for a figure, in the form that its ending says.
pub fn figure_file() -> impl TypedValueParser<Value = OutputPath> {
    OsStringValueParser::new().try_map(|name| {
        let path = OutputPath::from(name);
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        match PictureFormat::of_ending(&ending) {
            Some(_) => Ok(path),
            None => Err("figures are written as SVG, PNG or PDF: give a name that ends in .svg, .png or .pdf"),
        }
    })
}

/// A file for a table that is written as CSV alone, whatever its name ends in.
pub fn csv_file() -> impl TypedValueParser<Value = OutputPath> {
    OsStringValueParser::new().try_map(|name| {
        let path = OutputPath::from(name);
        if path.as_os_str().is_empty() {
            return Err("the name of a file is empty");
        }
        let ending = path.extension().unwrap_or_default();
        match ending.eq_ignore_ascii_case("parquet") {
            true => Err("this table is written as CSV: give a name that ends otherwise"),
            false => Ok(path),
        }
    })
}
