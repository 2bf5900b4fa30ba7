//! Arguments of checks whose runs several processes share.

use super::{InputPath, OutputFolder};

/// How the runs of a check are shared.
#[derive(Debug, clap::Args)]
pub struct DealArguments {
    /// Make only part I of N of the runs, into a file in the folder --into that --merge takes
    #[arg(long, value_name = "I/N", requires = "into")]
    pub shard: Option<String>,
    /// Folder of the shards
    #[arg(long, value_name = "FOLDER", requires = "shard")]
    pub into: Option<OutputFolder>,
    /// Take the runs from these shards, or folders of them, instead of making them
    #[arg(long, num_args = 1.., value_name = "FOLDER", conflicts_with = "shard")]
    pub merge: Vec<InputPath>,
}
