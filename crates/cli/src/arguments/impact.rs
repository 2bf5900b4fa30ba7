//! Arguments of `impact`.

use super::{InputPath, OutputPath};

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};

use super::ImpactCommand;

/// Arguments of `impact`. A subcommand beside the models needs none of them.
#[derive(Debug, clap::Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct ImpactArguments {
    /// What to do instead of a collision
    #[command(subcommand)]
    pub command: Option<ImpactCommand>,
    /// Impact models, by name or alias
    #[arg(value_name = "MODEL", required_unless_present = "all")]
    pub models: Vec<String>,
    /// Every registered model
    #[arg(long, conflicts_with = "models")]
    pub all: bool,
    /// Fill missing parameters with those of the model's example, and say which
    #[arg(long)]
    pub example: bool,
    /// Parameter as key=value, such as stiffness="93.5 MN/m", or MODEL.key=value; may be repeated
    #[arg(short, long = "parameter", value_name = "[MODEL.]KEY=VALUE")]
    pub parameters: Vec<String>,
    /// A spring of your own for the contact, in the place of stiffness and exponent, for models that
    /// hold for any: a text file of penetrations and forces, both increasing, units in the header,
    /// such as penetration_mm,force_kN
    #[arg(long, value_name = "FILE", conflicts_with = "example")]
    pub spring: Option<InputPath>,
    /// Separation rule, for the models that offer it
    #[arg(long)]
    pub separation: Option<String>,

    /// Mass of the left body, such as "25 t"
    #[arg(long, default_value = "25 t", allow_hyphen_values = true)]
    pub mass_left: String,
    /// Mass of the right body, or "wall" [default: 40 t; with --drop a rigid slab]
    #[arg(long, allow_hyphen_values = true)]
    pub mass_right: Option<String>,
    /// Velocity of the left body towards the right one [default: 0.8 m/s]
    #[arg(long, allow_hyphen_values = true)]
    pub velocity: Option<String>,
    /// Velocity of the right body, positive away from the left one
    #[arg(long, default_value = "0 m/s", allow_hyphen_values = true)]
    pub velocity_right: String,
    /// The left body falls on a slab; gravity acts during the contact
    #[arg(long, conflicts_with = "velocity_right")]
    pub drop: bool,
    /// Height of the fall, such as "0.2 m", instead of --velocity
    #[arg(
        long,
        requires = "drop",
        conflicts_with = "velocity",
        allow_hyphen_values = true
    )]
    pub height: Option<String>,
    /// Acceleration of gravity
    #[arg(
        long,
        requires = "drop",
        default_value = "9.80665 m/s^2",
        allow_hyphen_values = true
    )]
    pub gravity: String,
    /// Read the restitution at this time after first contact, as a sensor would
    #[arg(long, conflicts_with = "table", allow_hyphen_values = true)]
    pub read_at: Option<String>,

    /// Table of requested against achieved restitution
    #[arg(long)]
    pub table: bool,
    /// Write the histories, or the table, into this CSV file
    #[arg(long, value_parser = csv_file())]
    pub csv: Option<OutputPath>,
    /// Draw the histories, or the table, into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES)]
    pub svg: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Compare with a measured force history: columns time, force with units in the header
    #[arg(long, value_name = "FILE", conflicts_with = "table")]
    pub against: Option<InputPath>,
    /// Units of the measured columns if the file does not say, such as "ms,kN"
    #[arg(long, value_name = "TIME,FORCE", requires = "against")]
    pub against_units: Option<String>,
    /// Time of first contact in the measured history [default: found by --threshold]
    #[arg(long, requires = "against", allow_hyphen_values = true)]
    pub shift: Option<String>,
    /// Part of the measured peak above which there is contact
    #[arg(
        long,
        requires = "against",
        default_value = "1 %",
        allow_hyphen_values = true
    )]
    pub threshold: String,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}
