//! Arguments of `compare`.

use super::{DealArguments, InputPath, OutputPath};

use clap::ValueEnum;

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};
use super::quantities::{number, positive_velocity};

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub struct CompareArguments {
    /// Case file (TOML); its first law gives stiffness and restitution
    pub case: InputPath,
    /// Models, separated by commas [default: all]
    #[arg(long, num_args = 1.., value_delimiter = ',', value_name = "MODEL")]
    pub models: Vec<String>,
    /// Records, or folders of them [default: that of the case]
    #[arg(long, num_args = 1.., value_name = "FILE")]
    pub records: Vec<InputPath>,
    /// What elastic laws of different exponents share in the reference collision
    #[arg(long, value_enum, default_value_t = StiffnessChoice::Penetration)]
    pub stiffness_rule: StiffnessChoice,
    /// Ask for the restitution by each model's relation, or have it returned exactly
    #[arg(long, value_enum, default_value_t = RestitutionChoice::Published)]
    pub restitution_rule: RestitutionChoice,
    /// Restitution of all models [default: that of the case's law]
    #[arg(long, value_name = "E", value_parser = number, allow_hyphen_values = true)]
    pub restitution: Option<f64>,
    /// Approach velocity of the reference collision, such as "0.5 m/s" [default: the maximum of the case's law]
    #[arg(long, value_name = "V", value_parser = positive_velocity, allow_hyphen_values = true)]
    pub approach_velocity: Option<f64>,
    /// Write every value, of storeys and levels too, into this CSV file
    #[arg(long, value_parser = csv_file(), value_name = "FILE")]
    pub csv: Option<OutputPath>,
    /// Draw peaks over the models into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES, value_name = "FILE")]
    pub plot: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Write the answer with its inputs and figures into this JSON file, of which `report` makes the page
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<OutputPath>,
    /// Write a page of the answer into this HTML file
    #[arg(long, value_name = "FILE")]
    pub report: Option<OutputPath>,
    /// Threads [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// How its runs are shared
    #[command(flatten)]
    pub dealing: DealArguments,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// What laws of different exponents share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum StiffnessChoice {
    /// Maximum penetration
    Penetration,
    /// Contact time
    Duration,
}

/// What a model is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RestitutionChoice {
    /// The restitution, by the model's own relation
    Published,
    /// Whatever returns the restitution exactly
    Exact,
}
