//! Arguments of `gap`.

use pounding_study::gap_check::SweepOptions;

use super::{DealArguments, InputPath, OutputFolder, OutputPath};

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};
use super::quantities::number;

/// Arguments of `gap`.
#[derive(Debug, clap::Args)]
pub struct GapArguments {
    /// Case file (TOML)
    #[arg(required_unless_present = "list")]
    pub case: Option<InputPath>,
    /// List the provisions and what each needs, instead of a check
    #[arg(long, conflicts_with_all = [
        "case", "records", "code", "country", "date", "rules", "provisions", "set", "probability", "confidence", "points", "from",
        "to", "gap", "csv", "codes_csv", "plot", "spectra", "output", "report", "threads", "all", "shard", "into", "merge",
    ])]
    pub list: bool,
    /// With --list alone: write the documentation's page of the provisions into this folder, without a case
    #[arg(
        long,
        value_name = "FOLDER",
        requires = "list",
        conflicts_with = "json"
    )]
    pub pages: Option<OutputFolder>,
    /// Records, or folders of them [default: that of the case]
    #[arg(long, num_args = 1.., value_name = "FILE")]
    pub records: Vec<InputPath>,
    /// Code whose answer is the verdict, such as eurocode_8_2004, a family of editions such as ntc, or a rule of your own [default: that of the case; without one the demand decides]
    #[arg(long, value_name = "NAME")]
    pub code: Option<String>,
    /// Country or city whose one code in force is the verdict
    #[arg(long, value_name = "NAME", conflicts_with = "code")]
    pub country: Option<String>,
    /// Day on which editions are in force, such as 2018-03-22, for a family or a country [default: that of the case, or today]
    #[arg(long, value_name = "DATE")]
    pub date: Option<String>,
    /// Rules of your own, a file (TOML) of tables "rule"
    #[arg(long, value_name = "FILE")]
    pub rules: Option<InputPath>,
    /// Provisions to apply [default: those of the case, or all]
    #[arg(long, num_args = 1.., value_delimiter = ',', value_name = "NAME")]
    pub provisions: Vec<String>,
    /// An entry of the table `separation`, such as importance=1.25 or 'soil_zone="II"'
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Part of the records that may bring the buildings into contact, such as 0.1 or "10 %"
    #[arg(long, default_value_t = 0.0, value_name = "P", value_parser = number, allow_hyphen_values = true)]
    pub probability: f64,
    /// Confidence of two-sided bounds, such as 0.9 or "90 %"
    #[arg(long, default_value_t = 0.9, value_name = "C", value_parser = number, allow_hyphen_values = true)]
    pub confidence: f64,
    /// Widths in the sweep; 0 for none
    #[arg(long, default_value_t = SweepOptions::POINTS, value_name = "N")]
    pub points: usize,
    /// First width of the sweep, such as "5 mm" [default: one step]
    #[arg(long, value_name = "WIDTH")]
    pub from: Option<String>,
    /// Last width of the sweep [default: a little more than the maximum demand; of one gap in a row than
    /// its width, and than what its neighbours push closed]
    #[arg(long, value_name = "WIDTH")]
    pub to: Option<String>,
    /// Gap whose width varies in the sweep [default: all, with the same width]
    #[arg(long, value_name = "NAME")]
    pub gap: Option<String>,
    /// Write every width, record, building and storey of the sweep into this CSV file
    #[arg(long, value_parser = csv_file(), value_name = "FILE")]
    pub csv: Option<OutputPath>,
    /// Write demand, code gaps and their ratios for every record and level into this CSV file
    #[arg(long, value_parser = csv_file(), value_name = "FILE")]
    pub codes_csv: Option<OutputPath>,
    /// Draw amplification over the width into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES, value_name = "FILE")]
    pub plot: Option<OutputPath>,
    /// Draw the spectra of the records, their mean and the target of the scale into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES, value_name = "FILE")]
    pub spectra: Option<OutputPath>,
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
    /// Show all tables beside the answer of a code, every rule by itself with what it takes for granted, provisions that lack an input or do not apply, and every record
    #[arg(long)]
    pub all: bool,
    /// How its runs are shared
    #[command(flatten)]
    pub dealing: DealArguments,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}
