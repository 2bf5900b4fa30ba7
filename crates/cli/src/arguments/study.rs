//! Arguments of `sweep`, `merge` and `ida`.

use super::{InputPath, OutputPath};

use super::figure::{FigureArguments, figure_file};

/// Arguments of `sweep`.
#[derive(Debug, clap::Args)]
pub struct SweepArguments {
    /// Study file (TOML)
    pub study: InputPath,
    /// How it is run
    #[command(flatten)]
    pub running: RunningArguments,
    /// Run only part I of N, into a result that `merge` takes
    #[arg(long, value_name = "I/N")]
    pub shard: Option<String>,
    /// Print the number of runs and lines for HyperQueue and Slurm; run nothing
    #[arg(long)]
    pub plan: bool,
    /// Shards of the plan
    #[arg(long, default_value_t = 8, requires = "plan", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub shards: u32,
    /// Print the case of this run; run nothing
    #[arg(long, value_name = "RUN", conflicts_with = "plan")]
    pub show: Option<usize>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// How the runs of a study are computed.
#[derive(Debug, clap::Args)]
pub struct RunningArguments {
    /// Result (HDF5); by default the study's name with .h5 in the current folder
    #[arg(short, long)]
    pub output: Option<OutputPath>,
    /// Also write the runs as a table: Parquet if the name ends in .parquet, else CSV
    #[arg(long, visible_alias = "export", value_name = "FILE")]
    pub csv: Option<OutputPath>,
    /// Write a page of the result into this HTML file
    #[arg(long, value_name = "FILE")]
    pub report: Option<OutputPath>,
    /// Threads; all cores by default. Results do not depend on it
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=4096))]
    pub threads: Option<u32>,
    /// Go on with the finished runs of an interrupted call
    #[arg(long)]
    pub resume: bool,
    /// Time that a finished run waits at most until it is stored for --resume; the result does
    /// not depend on it
    #[arg(long, value_name = "TIME", default_value = "5 s")]
    pub store_every: String,
    /// Record runs whose record cannot be read as failed, and compute all others
    #[arg(long)]
    pub keep_going: bool,
}

/// Arguments of `merge`.
#[derive(Debug, clap::Args)]
pub struct MergeArguments {
    /// Results of all shards of a study
    #[arg(required = true)]
    pub shards: Vec<InputPath>,
    /// Result of the whole study (HDF5)
    #[arg(short, long)]
    pub output: OutputPath,
    /// Also write the runs as a table: Parquet if the name ends in .parquet, else CSV
    #[arg(long, visible_alias = "export", value_name = "FILE")]
    pub csv: Option<OutputPath>,
    /// Merge shards that different builds of the program computed; the result says which
    #[arg(long)]
    pub allow_mixed_builds: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Read shards without checksum here, not in a process of their own
    #[arg(long, hide = true)]
    pub accept_without_checksum: bool,
}

/// Arguments of `ida`.
#[derive(Debug, clap::Args)]
pub struct IdaArguments {
    /// Study file (TOML) with a part `ida`
    pub study: InputPath,
    /// How it is run
    #[command(flatten)]
    pub running: RunningArguments,
    /// Write the counts of every state at every intensity as a CSV table
    #[arg(long, value_name = "FILE")]
    pub table: Option<OutputPath>,
    /// Draw fragilities and frequencies into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), value_name = "FILE")]
    pub plot: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}
