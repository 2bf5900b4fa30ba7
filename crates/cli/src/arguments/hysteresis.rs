//! Arguments of `hysteresis` and `verify hysteresis`.

use super::{InputPath, OutputFolder, OutputPath};

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};

/// Arguments of `hysteresis`.
#[derive(Debug, clap::Args)]
pub struct HysteresisArguments {
    /// Law, by name or alias; without one all are listed, and with nothing else its descriptor is shown
    pub law: Option<String>,
    /// Parameter, such as yield_force="137 kN"; may be repeated. Without any, those of the law's
    /// example hold; else those that are missing and have no default, and it is said which
    #[arg(short, long = "set", value_name = "KEY=VALUE", requires = "law")]
    pub set: Vec<String>,

    /// Full cycles between plus and minus these deformations, such as "10 mm,20 mm,20 mm"
    #[arg(
        long,
        value_name = "AMPLITUDES",
        value_delimiter = ',',
        requires = "law",
        conflicts_with = "history",
        allow_hyphen_values = true
    )]
    pub cycles: Vec<String>,
    /// Deformations in a text file: one column with its unit in the header, such as
    /// deformation_mm, or time and deformation
    #[arg(long, value_name = "FILE", requires = "law")]
    pub history: Option<InputPath>,
    /// Duration of a harmonic cycle, for laws that depend on the rate [default: 1 s]
    #[arg(long, requires = "law", allow_hyphen_values = true)]
    pub period: Option<String>,
    /// Constant speed of the deformation instead of harmonic cycles, such as "20 mm/s"
    #[arg(
        long,
        requires = "law",
        conflicts_with = "period",
        allow_hyphen_values = true
    )]
    pub rate: Option<String>,
    /// Steps of half a cycle: speeds, energies and laws that are rates are worse with few
    /// [default: 500]
    #[arg(long, requires = "law", value_parser = clap::value_parser!(u32).range(20..=100_000))]
    pub steps: Option<u32>,

    /// Dissipation of cycles over amplitudes from the first to the second, such as
    /// "0.1 mm,10 mm", and its log-log slope
    #[arg(
        long,
        value_name = "FROM,TO",
        value_delimiter = ',',
        requires = "law",
        conflicts_with = "rate",
        allow_hyphen_values = true
    )]
    pub dissipation: Vec<String>,
    /// Number of its amplitudes, evenly spaced on a logarithmic scale
    #[arg(long, default_value = "25", requires = "dissipation", value_parser = clap::value_parser!(u32).range(2..=10_000))]
    pub points: u32,
    /// Fit iwan_six_parameter to a measured curve. CURVE is `backbone`, for a text file with the
    /// columns deformation and force on first loading, units in the header, such as
    /// deformation_mm,force_kN; or `dissipation`, for amplitude and dissipation of a cycle, such as
    /// amplitude_mm,dissipation_J. Without it the unit of the second column says which
    #[arg(
        long,
        value_names = ["CURVE", "FILE"],
        num_args = 1..=2,
        action = clap::ArgAction::Set,
        requires = "law"
    )]
    pub fit: Vec<InputPath>,

    /// Write the loop, or else the dissipation curve or the fit, into this CSV file
    #[arg(long, value_parser = csv_file(), requires = "law")]
    pub csv: Option<OutputPath>,
    /// Draw the loop and the dissipation curve into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES, requires = "law")]
    pub svg: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Print JSON: one object of a laboratory, a list of descriptors
    #[arg(long)]
    pub json: bool,
    /// Write the documentation's page of every law into this folder
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["law", "json"])]
    pub pages: Option<OutputFolder>,
}

impl HysteresisArguments {
    /// Steps of half a cycle.
    pub fn steps(&self) -> usize {
        self.steps.unwrap_or(500) as usize
    }
}

/// Arguments of `verify hysteresis`.
#[derive(Debug, clap::Args)]
pub struct VerifyHysteresisArguments {
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}
