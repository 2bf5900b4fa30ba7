//! Arguments of all commands.

mod compare;
mod deal;
mod explore;
mod figure;
mod floor_spectrum;
mod gap;
mod hysteresis;
mod impact;
mod motion;
mod needed;
mod paths;
mod quantities;
mod study;
mod verification;

use clap::{ArgAction, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

use figure::{FIGURES, figure_file};

pub use compare::{CompareArguments, RestitutionChoice, StiffnessChoice};
pub use deal::DealArguments;
pub use explore::ExploreArguments;
pub use figure::FigureArguments;
pub use floor_spectrum::FloorSpectrumArguments;
pub use gap::GapArguments;
pub use hysteresis::{HysteresisArguments, VerifyHysteresisArguments};
pub use impact::ImpactArguments;
pub use motion::*;
pub use needed::all_is_there;
pub use paths::{InputPath, OutputFolder, OutputPath, PathKind, file_use};
pub use quantities::{
    ascending, frequency, is_bare, list, once, optional, positive, time_limit, value,
    with_units_alike,
};
pub use study::*;
pub use verification::*;

/// Seismic pounding of adjacent buildings: how hard they hit, whether the gap is wide
/// enough, and how sensitive the answer is to the impact model
///
/// A case file (TOML) describes the buildings, the gaps between them, the impact model and
/// the ground motion. Begin with `pounding check CASE`, which prints what was understood;
/// then `pounding run CASE` for the time history, or `pounding gap CASE` for the gap.
#[derive(Debug, Parser)]
#[command(name = "pounding", arg_required_else_help = true)]
pub struct Arguments {
    /// Print the version; with --json commit, target, features and HDF5 library as well
    #[arg(short = 'V', long)]
    pub version: bool,
    /// With --version: print one JSON object
    #[arg(long, requires = "version")]
    pub json: bool,
    /// Say on standard error what is done and how long it takes; -vv also what is found
    #[arg(short, long, global = true, action = ArgAction::Count, help_heading = "Screen")]
    pub verbose: u8,
    /// Colour; auto asks the terminal and NO_COLOR
    #[arg(
        long,
        global = true,
        value_enum,
        default_value = "auto",
        value_name = "WHEN",
        help_heading = "Screen"
    )]
    pub color: ColorChoice,
    /// What to do.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// When there is colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ColorChoice {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Everywhere
    Always,
    /// Nowhere
    Never,
}

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Integrate a case in time: storey responses, impacts, energies
    Run(RunArguments),
    /// Validate a case and print what was understood: periods, modes, contact levels
    Check {
        /// Case file (TOML)
        case: InputPath,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Write one HTML page that computes: gaps, models, masses and the motion move in it
    Explore(ExploreArguments),
    /// Write one HTML page of a result: the answer, tables, figures, buildings in motion
    Report {
        /// Result file of `run`, `sweep`, `merge` or `ida` (.h5), or of --output of `gap`, `compare` or `motion info` (.json)
        result: InputPath,
        /// Page; by default the result's name with .html beside it
        #[arg(short, long)]
        output: Option<OutputPath>,
        /// Study file of a result of `ida`, for the page of its fragilities
        #[arg(long, value_name = "FILE")]
        study: Option<InputPath>,
        /// Read the result here, not in a process of its own
        #[arg(long, hide = true)]
        read_in_this_process: bool,
    },
    /// Is the gap wide enough? Demand by simulation, SRSS, DDC and code; effects of pounding
    Gap(Box<GapArguments>),
    /// What does equipment on the floors feel? Floor response spectra with pounding and without
    FloorSpectrum(Box<FloorSpectrumArguments>),
    /// Is the answer sensitive to the impact model? Every model on every record
    Compare(Box<CompareArguments>),
    /// Run a case many times with varying values, models or records
    Sweep(Box<SweepArguments>),
    /// Merge the results of all shards of a study
    Merge(MergeArguments),
    /// How far the shards of a study are, and which command goes on
    Status(StatusArguments),
    /// Incremental dynamic analysis (IDA): fragility, and the gap for a target frequency
    Ida(Box<IdaArguments>),
    /// Ground motions: read, measure, convert, process, generate and match
    #[command(subcommand)]
    Motion(Box<MotionCommand>),
    /// List the impact models, or show one
    Models {
        /// Model or alias
        name: Option<String>,
        /// Print JSON, a list of descriptors
        #[arg(long)]
        json: bool,
        /// Write the documentation's page of every model into this folder
        #[arg(long, value_name = "FOLDER", conflicts_with_all = ["name", "json"])]
        pages: Option<OutputFolder>,
    },
    /// List the hysteresis laws of storeys and links, show one, or compute its loops
    Hysteresis(Box<HysteresisArguments>),
    /// Let two bodies collide: force, achieved restitution and energy lost by impact models
    Impact(Box<ImpactArguments>),
    /// Find a contact stiffness, with its source and limits
    Stiffness(StiffnessArguments),
    /// Compute published results and compare
    Verify(VerifyArguments),
    /// Print the JSON Schema of an input file
    Schema {
        /// Which file
        #[arg(default_value = "case")]
        file: SchemaOf,
    },
    /// Write the manual pages of the program and of its commands
    Man {
        /// Folder in which the pages are written
        #[arg(long, value_name = "FOLDER")]
        pages: OutputFolder,
    },
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
    pub case: InputPath,
    /// Result file (HDF5); by default the case's name with .h5 in the current folder, and for
    /// FOLDER/case.toml FOLDER.h5
    #[arg(short, long)]
    pub output: Option<OutputPath>,
    /// Do not write a result file
    #[arg(long, conflicts_with = "output")]
    pub no_output: bool,
    /// Draw roof displacements and contact forces into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES)]
    pub plot: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Write the page of the result into this HTML file
    #[arg(long, value_name = "FILE", conflicts_with = "no_output")]
    pub report: Option<OutputPath>,
    /// Print one JSON object instead of tables
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `stiffness`.
#[derive(Debug, clap::Args)]
pub struct StiffnessArguments {
    /// Where the stiffness comes from
    #[command(subcommand)]
    pub method: StiffnessMethod,
    /// Print one JSON object
    #[arg(long, global = true)]
    pub json: bool,
}

/// Where a contact stiffness comes from.
#[derive(Debug, Subcommand)]
pub enum StiffnessMethod {
    /// Two elastic spheres, N/m^1.5 (Hertz 1882)
    Hertz(HertzArguments),
    /// Axial stiffness EA/L of two floor slabs in series, N/m
    Slab(SlabArguments),
    /// Stiffness that gives a wanted contact time
    Duration(DurationArguments),
    /// Stiffness that gives a wanted maximum penetration
    Penetration(PenetrationArguments),
    /// Multiple of the storey stiffness of the stiffer building, N/m
    Multiple(MultipleArguments),
}

/// Arguments of `stiffness hertz`. The right body equals the left one
/// unless said otherwise.
#[derive(Debug, clap::Args)]
pub struct HertzArguments {
    /// Radius of the left body, such as "25 mm", or "flat"
    #[arg(long, allow_hyphen_values = true)]
    pub radius_left: String,
    /// Radius of the right body, or "flat"
    #[arg(long, allow_hyphen_values = true)]
    pub radius_right: String,
    /// Young's modulus of the left body, such as "206 GPa"
    #[arg(long, allow_hyphen_values = true)]
    pub elastic_modulus_left: String,
    /// Young's modulus of the right body [default: as left]
    #[arg(long, allow_hyphen_values = true)]
    pub elastic_modulus_right: Option<String>,
    /// Poisson's ratio of the left body
    #[arg(long, allow_hyphen_values = true)]
    pub poisson_ratio_left: String,
    /// Poisson's ratio of the right body [default: as left]
    #[arg(long, allow_hyphen_values = true)]
    pub poisson_ratio_right: Option<String>,
    /// Density of the left body, such as "7850 kg/m^3", for the check of waves
    #[arg(long, requires = "velocity", allow_hyphen_values = true)]
    pub density_left: Option<String>,
    /// Density of the right body [default: as left, if its modulus is not given]
    #[arg(long, requires = "velocity", allow_hyphen_values = true)]
    pub density_right: Option<String>,
    /// Approach velocity, for the checks of contact time and radius
    #[arg(long, requires_all = ["mass_left", "mass_right"], allow_hyphen_values = true)]
    pub velocity: Option<String>,
    /// Mass of the left body
    #[arg(long, requires = "velocity", allow_hyphen_values = true)]
    pub mass_left: Option<String>,
    /// Mass of the right body, or "wall"
    #[arg(long, requires = "velocity", allow_hyphen_values = true)]
    pub mass_right: Option<String>,
}

/// Arguments of `stiffness slab`. The right slab is like the left one unless said
/// otherwise.
#[derive(Debug, clap::Args)]
pub struct SlabArguments {
    /// Young's modulus of the left slab, such as "30 GPa"
    #[arg(long, allow_hyphen_values = true)]
    pub elastic_modulus_left: String,
    /// Young's modulus of the right slab [default: as left]
    #[arg(long, allow_hyphen_values = true)]
    pub elastic_modulus_right: Option<String>,
    /// Cross-section of the left slab, such as "1.8 m^2"
    #[arg(long, conflicts_with_all = ["width_left", "thickness_left"], allow_hyphen_values = true)]
    pub area_left: Option<String>,
    /// Width of the left slab across the impact, instead of its area
    #[arg(long, allow_hyphen_values = true)]
    pub width_left: Option<String>,
    /// Thickness of the left slab, instead of its area
    #[arg(long, allow_hyphen_values = true)]
    pub thickness_left: Option<String>,
    /// Cross-section of the right slab, such as "1.8 m^2" [default: as left]
    #[arg(long, conflicts_with_all = ["width_right", "thickness_right"], allow_hyphen_values = true)]
    pub area_right: Option<String>,
    /// Width of the right slab across the impact, instead of its area
    #[arg(long, allow_hyphen_values = true)]
    pub width_right: Option<String>,
    /// Thickness of the right slab, instead of its area
    #[arg(long, allow_hyphen_values = true)]
    pub thickness_right: Option<String>,
    /// Length of the left slab in the direction of impact
    #[arg(long, allow_hyphen_values = true)]
    pub length_left: String,
    /// Length of the right slab [default: as left]
    #[arg(long, allow_hyphen_values = true)]
    pub length_right: Option<String>,
    /// Lateral storey stiffness of the stiffer building, to compare with
    #[arg(long, allow_hyphen_values = true)]
    pub storey_stiffness: Option<String>,
}

/// The collision that a wanted contact time or penetration belongs to.
#[derive(Debug, clap::Args)]
pub struct ApproachArguments {
    /// Exponent n of the force law: 1 linear, 1.5 Hertz
    #[arg(long, allow_hyphen_values = true)]
    pub exponent: String,
    /// Approach velocity, such as "0.8 m/s"
    #[arg(long, allow_hyphen_values = true)]
    pub velocity: String,
    /// Mass of the left floor, such as "25 t"
    #[arg(long, allow_hyphen_values = true)]
    pub mass_left: String,
    /// Mass of the right floor, or "wall"
    #[arg(long, allow_hyphen_values = true)]
    pub mass_right: String,
    /// Restitution of the law; below 1 it is damped
    #[arg(long, allow_hyphen_values = true)]
    pub restitution: Option<String>,
}

/// Arguments of `stiffness duration`.
#[derive(Debug, clap::Args)]
pub struct DurationArguments {
    /// Wanted contact time, such as "20 ms"
    #[arg(long, allow_hyphen_values = true)]
    pub duration: String,
    /// The collision
    #[command(flatten)]
    pub approach: ApproachArguments,
}

/// Arguments of `stiffness penetration`.
#[derive(Debug, clap::Args)]
pub struct PenetrationArguments {
    /// Wanted maximum penetration, such as "5 mm"
    #[arg(long, allow_hyphen_values = true)]
    pub penetration: String,
    /// Width of the gap, to compare with
    #[arg(long, allow_hyphen_values = true)]
    pub gap_width: Option<String>,
    /// The collision
    #[command(flatten)]
    pub approach: ApproachArguments,
}

/// Arguments of `stiffness multiple`.
#[derive(Debug, clap::Args)]
pub struct MultipleArguments {
    /// Lateral storey stiffness of the stiffer building, such as "3.46 MN/m"
    #[arg(long, allow_hyphen_values = true)]
    pub storey_stiffness: String,
    /// How many times that; 10 to 100 are in use
    #[arg(long, default_value = "20", allow_hyphen_values = true)]
    pub factor: String,
}

/// A file that has a schema.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum SchemaOf {
    /// What stands in a case
    Case,
    /// What stands in a study of `sweep` and `ida`
    Study,
    /// The hazard curve of an incremental dynamic analysis: points, and the columns of its CSV file
    Hazard,
}
