//! Arguments of `sweep`, `merge` and `ida`.

use clap::ValueEnum;

use super::{InputPath, OutputFolder, OutputPath};

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};

/// Arguments of `sweep`.
#[derive(Debug, clap::Args)]
pub struct SweepArguments {
    /// Study file (TOML)
    pub study: InputPath,
    /// How it is run
    #[command(flatten)]
    pub running: RunningArguments,
    /// Which part is run
    #[command(flatten)]
    pub sharing: ShardArguments,
    /// How all parts are handed out
    #[command(flatten)]
    pub planning: PlanArguments,
    /// Print the case of this run; run nothing
    #[arg(long, value_name = "RUN", conflicts_with_all = ["plan", "output", "csv", "report", "shard", "into", "resume", "keep_going", "json"])]
    pub show: Option<usize>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// The part of a study that is run.
#[derive(Debug, clap::Args)]
pub struct ShardArguments {
    /// Run only part I of N, into a result that `merge` takes
    #[arg(long, value_name = "I/N", conflicts_with = "plan")]
    pub shard: Option<String>,
    /// Folder of the results of all shards: a shard goes there under a name of its own, and
    /// says how far it is, for `status` and `merge`
    #[arg(long, value_name = "FOLDER")]
    pub into: Option<OutputFolder>,
}

/// How the shards of a study are handed out.
#[derive(Debug, clap::Args)]
pub struct PlanArguments {
    /// Print how the study is dealt in shards, or the script that has them run and merged; run
    /// nothing
    #[arg(
        long,
        value_name = "WHERE",
        value_enum,
        num_args = 0..=1,
        require_equals = true
    )]
    pub plan: Option<Option<Scheduler>>,
    /// Shards of the plan
    #[arg(long, default_value_t = 8, requires = "plan", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub shards: u32,
    /// Time limit of a task, such as "2 h"
    #[arg(long, value_name = "TIME", requires = "plan")]
    pub time: Option<String>,
    /// Tasks that run at the same time at most
    #[arg(long, value_name = "N", requires = "plan", value_parser = clap::value_parser!(u32).range(1..))]
    pub at_once: Option<u32>,
    /// MaxArraySize of the Slurm cluster, one more than the tasks that an array can have [default: 1001]
    #[arg(long, value_name = "N", requires = "plan", value_parser = clap::value_parser!(u32).range(2..))]
    pub array_limit: Option<u32>,
}

/// What hands out the shards of a study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Scheduler {
    /// Slurm, by an array of tasks and a job that merges
    Slurm,
    /// HyperQueue, by an array of tasks
    HyperQueue,
    /// Dask, by a Python script
    Dask,
    /// A plain shell with xargs, on one machine
    Shell,
}

/// How the runs of a study are computed.
#[derive(Debug, clap::Args)]
pub struct RunningArguments {
    /// Result (HDF5); by default the study's name with .h5 in the current folder, and for
    /// FOLDER/study.toml FOLDER.study.h5
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
    /// Go on with the finished runs of an interrupted call, as --into does of itself
    #[arg(long)]
    pub resume: bool,
    /// Time that a finished run waits at most until it is stored for --resume; the result does
    /// not depend on it
    #[arg(long, value_name = "TIME", default_value = "5 s")]
    pub store_every: String,
    /// Record runs whose record cannot be read as failed, and compute all others
    #[arg(long)]
    pub keep_going: bool,
    /// Read a result that stands complete here, not in a process of its own
    #[arg(long, hide = true)]
    pub read_in_this_process: bool,
}

/// Arguments of `merge`.
#[derive(Debug, clap::Args)]
#[command(
    override_usage = "pounding merge [OPTIONS] --output <OUTPUT> <SHARDS>...\n       pounding merge [OPTIONS] --check <SHARDS>..."
)]
pub struct MergeArguments {
    /// Results of all shards of a study, or folders of them
    #[arg(required = true)]
    pub shards: Vec<InputPath>,
    /// Result of the whole study (HDF5)
    #[arg(short, long, required_unless_present = "check")]
    pub output: Option<OutputPath>,
    /// Also write the runs as a table: Parquet if the name ends in .parquet, else CSV
    #[arg(
        long,
        visible_alias = "export",
        value_name = "FILE",
        conflicts_with = "check"
    )]
    pub csv: Option<OutputPath>,
    /// Say which shards are there and whether they make one result; write nothing
    #[arg(long, conflicts_with = "output")]
    pub check: bool,
    /// Merge the shards that are there, though others are missing, into a result that is merged
    /// again
    #[arg(long)]
    pub partial: bool,
    /// Merge shards that different builds of the program computed; the result says which
    #[arg(long)]
    pub allow_mixed_builds: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Read the shards here, not in a process of their own
    #[arg(long, hide = true)]
    pub read_in_this_process: bool,
    /// Shards by their numbers among all files, from 0, that another process could not read
    #[arg(long, hide = true, value_name = "NUMBER")]
    pub unreadable: Vec<usize>,
    /// Why not, for each of them
    #[arg(long, hide = true, value_name = "TEXT")]
    pub because: Vec<String>,
}

/// Arguments of `status`.
#[derive(Debug, clap::Args)]
pub struct StatusArguments {
    /// Folder of the results of shards, as `--into` or a plan named it
    pub folder: InputPath,
    /// Print it anew until all shards are done
    #[arg(long)]
    pub watch: bool,
    /// Time between two looks of `--watch`
    #[arg(long, value_name = "TIME", default_value = "10 s", requires = "watch")]
    pub every: String,
    /// Print the numbers of the shards that are neither done nor running, as plans take them,
    /// such as 3,7-9
    #[arg(long, conflicts_with_all = ["watch", "json"])]
    pub unfinished: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `ida`.
#[derive(Debug, clap::Args)]
pub struct IdaArguments {
    /// Study file (TOML) with a part `ida`; `sweep STUDY --show RUN` prints the case of a run
    pub study: InputPath,
    /// How it is run
    #[command(flatten)]
    pub running: RunningArguments,
    /// Which part is run
    #[command(flatten)]
    pub sharing: ShardArguments,
    /// How all parts are handed out
    #[command(flatten)]
    pub planning: PlanArguments,
    /// Write the counts of every state at every intensity as a CSV table
    #[arg(long, value_name = "FILE", value_parser = csv_file(), conflicts_with = "shard")]
    pub table: Option<OutputPath>,
    /// Write the fragilities as a fragility model of OpenQuake (NRML 0.5)
    #[arg(long, value_name = "FILE", conflicts_with = "shard")]
    pub openquake: Option<OutputPath>,
    /// Draw fragilities and frequencies into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES, value_name = "FILE", conflicts_with = "shard")]
    pub plot: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}
