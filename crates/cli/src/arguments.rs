//! Arguments of all commands.

use std::path::PathBuf;

use clap::{Parser, Subcommand};
use clap_complete::Shell;

/// Seismic pounding of adjacent buildings: how hard do they hit, and is the gap
/// wide enough?
#[derive(Debug, Parser)]
#[command(version, about, arg_required_else_help = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Integrate a case and write storey responses, impacts and energies
    Run(RunArguments),
    /// Validate a case and print what was understood
    Check {
        /// Case file (TOML)
        case: PathBuf,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// List the impact models, or show one
    Models {
        /// Model or alias
        name: Option<String>,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Let two bodies collide: what a model really returns
    Impact(ImpactArguments),
    /// Print the JSON Schema of the case file
    Schema,
    /// Print shell completions
    Completions {
        /// Shell
        shell: Shell,
    },
}

/// Arguments of `run`.
#[derive(Debug, clap::Args)]
pub struct RunArguments {
    /// Case file (TOML)
    pub case: PathBuf,
    /// Result file (HDF5); by default the case's name with .h5 in the current folder
    #[arg(short, long)]
    pub output: Option<PathBuf>,
    /// Do not write a result file
    #[arg(long, conflicts_with = "output")]
    pub no_output: bool,
    /// Draw roof displacements and contact forces into this SVG file
    #[arg(long)]
    pub plot: Option<PathBuf>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `impact`.
#[derive(Debug, clap::Args)]
pub struct ImpactArguments {
    /// Impact model
    pub model: String,
    /// Mass of the left body, such as "25 t"
    #[arg(long, default_value = "25 t")]
    pub mass_left: String,
    /// Mass of the right body, or "wall"
    #[arg(long, default_value = "40 t")]
    pub mass_right: String,
    /// Approach velocity, such as "0.8 m/s"
    #[arg(long, default_value = "0.8 m/s", allow_hyphen_values = true)]
    pub velocity: String,
    /// Parameter of the model as key=value, such as stiffness="93.5 MN/m"; may be repeated
    #[arg(short, long = "parameter", value_name = "KEY=VALUE")]
    pub parameters: Vec<String>,
    /// Separation rule: zero_penetration or no_tension
    #[arg(long)]
    pub separation: Option<String>,
    /// Table of requested against achieved restitution
    #[arg(long)]
    pub table: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}
