//! Arguments of `pounding floor-spectrum`.

use clap::Args;

use super::figure::{FIGURES, csv_file, figure_file};
use super::quantities::DAMPING;
use super::{FigureArguments, InputPath, OutputPath};

/// Response spectra of floors.
#[derive(Debug, Args)]
pub struct FloorSpectrumArguments {
    /// Case file (TOML)
    pub case: InputPath,
    /// Records, or folders of them: spectra over all of them [default: that of the case]
    #[arg(long, num_args = 1.., value_name = "FILE")]
    pub records: Vec<InputPath>,
    /// Floors, each a building and a storey from 1 at the bottom, such as light:2 [default: the roof of every building]
    #[arg(long = "floor", num_args = 1.., value_name = "BUILDING:STOREY")]
    pub floors: Vec<String>,
    /// Periods, such as "0.1 s, 0.3 s, 1 s" [default: --from, --to, --count]
    #[arg(long, conflicts_with_all = ["from", "to", "count"], allow_hyphen_values = true)]
    pub at: Option<String>,
    /// First period
    #[arg(long, default_value = "0.05 s", allow_hyphen_values = true)]
    pub from: String,
    /// Last period
    #[arg(long, default_value = "4 s", allow_hyphen_values = true)]
    pub to: String,
    /// How many, evenly spaced in their logarithm [default: 30]
    #[arg(long)]
    pub count: Option<usize>,
    /// Damping ratios of what stands on the floors, such as "2 %, 5 %"
    #[arg(long, default_value = DAMPING, allow_hyphen_values = true)]
    pub damping: String,
    /// Write the spectra into this CSV file, in SI units
    #[arg(long, value_name = "FILE", value_parser = csv_file())]
    pub csv: Option<OutputPath>,
    /// Draw the spectra into this file (.svg, .png, .pdf)
    #[arg(long, value_name = "FILE", value_parser = figure_file(), group = FIGURES)]
    pub plot: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Threads, for several records [default: all cores]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}
