//! Arguments of `impact calibrate` and `verify`.

use clap::{Subcommand, ValueEnum};

use super::{InputPath, VerifyHysteresisArguments};

/// What `impact` does beside a collision.
#[derive(Debug, Subcommand)]
pub enum ImpactCommand {
    /// Search the factor alpha of papi_toopchi_2022 in a drop test
    Calibrate(CalibrateArguments),
}

/// Arguments of `impact calibrate`. Without any the drop test is that of Papi and
/// Toopchi-Nezhad 2022 as far as it is known.
#[derive(Debug, clap::Args)]
pub struct CalibrateArguments {
    /// Restitution to meet; without it a table over 0.1 to 0.9
    #[arg(long, allow_hyphen_values = true)]
    pub restitution: Option<String>,
    /// Mass of the body [default: 1.763 kg]
    #[arg(long, allow_hyphen_values = true)]
    pub mass: Option<String>,
    /// Velocity at first contact [default: 0.13 m/s]
    #[arg(long, allow_hyphen_values = true)]
    pub velocity: Option<String>,
    /// Gravity during the contact, 0 for a free collision [default: 9.8 m/s^2]
    #[arg(long, allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// Linear contact stiffness [default: 2.32e7 N/m]
    #[arg(long, allow_hyphen_values = true)]
    pub stiffness: Option<String>,
    /// Time after first contact at which the rebound is read, such as "1 ms", or
    /// "separation" [default: 1 ms in the paper's drop test, separation in any other]
    #[arg(long, allow_hyphen_values = true)]
    pub read_at: Option<String>,
    /// Maximum difference between requested and achieved restitution
    #[arg(long, default_value = "1e-10", allow_hyphen_values = true)]
    pub tolerance: String,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `verify`.
#[derive(Debug, clap::Args)]
pub struct VerifyArguments {
    /// What to verify
    #[command(subcommand)]
    pub subject: VerifySubject,
}

/// What can be verified.
#[derive(Debug, Subcommand)]
pub enum VerifySubject {
    /// Compute what the publications on impact models print
    Impact(VerifyImpactArguments),
    /// Compute what the publication on the six-parameter Iwan model prints and draws
    Hysteresis(VerifyHysteresisArguments),
    /// Run structures that others computed
    Structures(VerifyStructuresArguments),
}

/// Arguments of `verify structures`.
#[derive(Debug, clap::Args)]
pub struct VerifyStructuresArguments {
    /// Only this source; may be repeated
    #[arg(long, value_delimiter = ',')]
    pub source: Vec<StructureSource>,
    /// Compare with published numbers that you entered in this file (TOML)
    #[arg(long, value_name = "FILE")]
    pub data: Option<InputPath>,
    /// Print the file for --data, to fill in
    #[arg(long, conflicts_with_all = ["source", "data", "json"])]
    pub template: bool,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// A source of published structures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum StructureSource {
    /// OpenSees: pairs of one and of three storeys, elastic and yielding
    Opensees,
    /// Code_Aster: oscillators and falling bodies at stops
    CodeAster,
    /// Siconos: a bouncing ball and a column of beads
    Siconos,
    /// Modelica Standard Library: a mass between two stops
    Modelica,
    /// Ansys VM65: a ball that falls on a spring
    Ansys,
    /// Chung and Ooi 2011: elastic impacts of spheres
    ChungOoi,
    /// OpenSees: laws of storeys and links along one path
    Laws,
    /// Publications whose numbers are not at hand: enter them
    Entered,
}

/// Arguments of `verify impact`.
#[derive(Debug, clap::Args)]
pub struct VerifyImpactArguments {
    /// Only this source; may be repeated
    #[arg(long, value_delimiter = ',')]
    pub source: Vec<ImpactSource>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// A source of published results.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ImpactSource {
    /// Papi and Toopchi-Nezhad 2022: drop test
    Papi,
    /// Zhou, Wu, Zhang and Xie 2012: two steel balls
    Zhou,
    /// Borovin, Lapshin and Yurin 2014: rubber ball on concrete
    Borovin,
    /// Requested against achieved restitution of every law
    Table,
}
