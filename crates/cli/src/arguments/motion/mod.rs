//! Arguments of `motion`.

mod generators;
mod steps;

use super::{InputPath, OutputPath};

use clap::{Subcommand, ValueEnum};

pub use generators::*;
pub use steps::StepArguments;

use super::figure::{FIGURES, FigureArguments, csv_file, figure_file};
use super::quantities::DAMPING;

/// What to do with recorded and synthetic motions.
#[derive(Debug, Subcommand)]
pub enum MotionCommand {
    /// Show every series of record files: header, measures, what disagrees
    Info(InfoArguments),
    /// Response spectra, RotD50 and RotD100 of two components, or Fourier amplitudes
    Spectrum(SpectrumArguments),
    /// Write a series in another format
    Convert(ConvertArguments),
    /// Filter, correct, cut, resample and scale an acceleration, each step if asked for
    Process(ProcessArguments),
    /// Generate a synthetic motion from a formula and a seed
    Synth(SynthArguments),
    /// Bring an acceleration to a design spectrum
    Match(MatchArguments),
}

/// How a record is read: needed where the file does not say it.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Reading the record")]
pub struct ReadArguments {
    /// Format by name, such as peer_at2 [default: found from the content]
    #[arg(long)]
    pub format: Option<String>,
    /// Time step, such as "0.02 s"; uneven samples are resampled to it
    #[arg(long, allow_hyphen_values = true)]
    pub time_step: Option<String>,
    /// Unit of the values, such as g or cm/s2
    #[arg(long)]
    pub unit: Option<String>,
    /// Plain columns: "a", or names such as "t,ns,ew"
    #[arg(long, allow_hyphen_values = true)]
    pub layout: Option<String>,
    /// Component to use: its name in the file, azimuth or channel number
    #[arg(long, allow_hyphen_values = true)]
    pub component: Option<String>,
    /// Plain columns: lines to skip at the start
    #[arg(long, default_value_t = 0)]
    pub skip_lines: usize,
    /// Plain columns: characters to skip at the start of each line
    #[arg(long, default_value_t = 0)]
    pub skip_columns: usize,
    /// The first value is at one time step, after a zero
    #[arg(long)]
    pub prepend_zero: bool,
    /// Use samples that contradict the header's count, duration, step or peak, with a warning
    #[arg(long)]
    pub lenient: bool,
    /// Counts per m/s2 of the whole channel, for records in counts
    #[arg(long, allow_hyphen_values = true)]
    pub sensitivity: Option<String>,
    /// StationXML with the sensitivities of a miniSEED record [default: one that lies beside it]
    #[arg(long, value_name = "FILE")]
    pub response: Option<InputPath>,
    /// The g of records in units of gravity [default: 9.80665 m/s^2]
    #[arg(long, allow_hyphen_values = true)]
    pub gravity: Option<String>,
    /// What becomes of the mean; automatic takes it off raw records [default: automatic, of convert keep]
    #[arg(long, value_enum)]
    pub offset: Option<OffsetWord>,
}

/// What becomes of the mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum OffsetWord {
    /// Taken off raw records, kept in corrected ones
    Automatic,
    /// Kept
    Keep,
    /// Taken off
    Remove,
}

/// Arguments of `motion info`.
#[derive(Debug, clap::Args)]
pub struct InfoArguments {
    /// Record files of any known format
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<InputPath>,
    /// Acceleration of bracketed and uniform duration
    #[arg(long, default_value = "0.05 g", allow_hyphen_values = true)]
    pub duration_threshold: String,
    /// Damping ratio of spectral measures
    #[arg(long, default_value = DAMPING, allow_hyphen_values = true)]
    pub damping: String,
    /// Take peaks at samples alone, and integrals but displacements by the trapezoid rule, as many agencies do
    #[arg(long)]
    pub at_samples: bool,
    /// Write a row of measures for each series into this CSV file, in SI units
    #[arg(long, value_parser = csv_file())]
    pub csv: Option<OutputPath>,
    /// Draw acceleration, velocity, displacement and Husid curve into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES)]
    pub svg: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Write the answer with its inputs and figures into this JSON file, of which `report` makes the page
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<OutputPath>,
    /// Write a page of the series into this HTML file
    #[arg(long, value_name = "FILE")]
    pub report: Option<OutputPath>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Reading
    #[command(flatten)]
    pub read: ReadArguments,
}

/// Arguments of `motion spectrum`.
#[derive(Debug, clap::Args)]
pub struct SpectrumArguments {
    /// Record file
    #[arg(required_unless_present = "code")]
    pub file: Option<InputPath>,
    /// Spectrum of a code, beside that of the record or alone: "eurocode_8_2004, ag=0.25 g, ground_type=B" (with spectrum_type=2 for type 2) or "asce_7_2016, s_ds=1.0 g, s_d1=0.6 g, t_l=8 s"
    #[arg(long, conflicts_with_all = ["fourier", "rotated"])]
    pub code: Option<String>,
    /// Spectra over all directions of two components: RotD50 and RotD100
    #[arg(long, conflicts_with = "fourier")]
    pub rotated: bool,
    /// The other component, for --rotated
    #[arg(
        long,
        requires = "rotated",
        conflicts_with = "code",
        allow_hyphen_values = true
    )]
    pub second_component: Option<String>,
    /// File of the other component [default: the same file]
    #[arg(long, requires = "rotated", conflicts_with = "code")]
    pub second_file: Option<InputPath>,
    /// Fourier amplitudes instead of responses
    #[arg(long, conflicts_with_all = ["damping", "at_samples"])]
    pub fourier: bool,
    /// Bandwidth coefficient b of Konno and Ohmachi (1998); smaller is smoother
    #[arg(
        long,
        requires = "fourier",
        conflicts_with = "code",
        default_value = "40",
        allow_hyphen_values = true
    )]
    pub smoothing: String,
    /// Fourier amplitudes at every frequency of the transform, not smoothed
    #[arg(long, requires = "fourier", conflicts_with_all = ["smoothing", "at", "from", "to", "count", "code"])]
    pub unsmoothed: bool,
    /// Periods (frequencies for --fourier), such as "0.2 s, 0.5 s, 1 s" [default: --from, --to, --count]
    #[arg(long, conflicts_with_all = ["from", "to", "count"], allow_hyphen_values = true)]
    pub at: Option<String>,
    /// First period or frequency [default: 0.05 s, 0.1 Hz]
    #[arg(long, allow_hyphen_values = true)]
    pub from: Option<String>,
    /// Last period or frequency [default: 4 s, 25 Hz]
    #[arg(long, allow_hyphen_values = true)]
    pub to: Option<String>,
    /// How many, evenly spaced in their logarithm [default: 30]
    #[arg(long)]
    pub count: Option<usize>,
    /// Damping ratios, such as "2 %, 5 %"
    #[arg(
        long,
        default_value = DAMPING,
        conflicts_with = "fourier",
        allow_hyphen_values = true
    )]
    pub damping: String,
    /// Take peaks at samples alone, as most programs do
    #[arg(long, conflicts_with = "fourier")]
    pub at_samples: bool,
    /// Write the spectra into this CSV file, in SI units
    #[arg(long, value_parser = csv_file())]
    pub csv: Option<OutputPath>,
    /// Draw the spectra into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES)]
    pub svg: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Reading
    #[command(flatten)]
    pub read: ReadArguments,
}

/// A format that can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Layout {
    /// Our CSV: m/s2, full precision, a header that says where it came from
    #[value(name = "pounding_csv")]
    PoundingCsv,
    /// PEER AT2 (g), VT2 (cm/s) or DT2 (cm), eight digits
    #[value(name = "peer_at2")]
    PeerAt2,
    /// Numbers alone
    #[value(name = "plain_columns")]
    PlainColumns,
}

/// Arguments of `motion convert`.
#[derive(Debug, clap::Args)]
pub struct ConvertArguments {
    /// Record file
    pub file: InputPath,
    /// File to write
    #[arg(short, long)]
    pub output: OutputPath,
    /// Its format
    #[arg(long, value_enum, default_value = "pounding_csv")]
    pub to: Layout,
    /// Quantity to write: acceleration, velocity or displacement
    #[arg(long, default_value = "acceleration")]
    pub quantity: String,
    /// Plain columns to write: "a" or "t,a" [default: t,a]
    #[arg(long)]
    pub columns: Option<String>,
    /// Unit of accelerations in plain columns, such as g [default: m/s2]
    #[arg(long)]
    pub output_unit: Option<String>,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
    /// Reading
    #[command(flatten)]
    pub read: ReadArguments,
}

/// Where a synthetic or processed motion goes.
#[derive(Debug, Clone, clap::Args)]
pub struct OutputArguments {
    /// File to write, in our CSV layout with a header that says what was done
    #[arg(short, long)]
    pub output: OutputPath,
    /// Draw acceleration, velocity, displacement and Husid curve into this file (.svg, .png, .pdf)
    #[arg(long, value_parser = figure_file(), group = FIGURES)]
    pub svg: Option<OutputPath>,
    #[command(flatten)]
    pub figure: FigureArguments,
    /// Print one JSON object
    #[arg(long)]
    pub json: bool,
}

/// Arguments of `motion process`.
#[derive(Debug, clap::Args)]
pub struct ProcessArguments {
    /// Record file
    pub file: InputPath,
    /// Output
    #[command(flatten)]
    pub output: OutputArguments,
    /// Turn two components at right angles by this angle (degrees), first towards second, before all steps
    #[arg(long, requires = "second_component", allow_hyphen_values = true)]
    pub rotate: Option<f64>,
    /// The other component, for --rotate
    #[arg(long, requires = "rotate", allow_hyphen_values = true)]
    pub second_component: Option<String>,
    /// Steps
    #[command(flatten)]
    pub steps: StepArguments,
    /// Reading
    #[command(flatten)]
    pub read: ReadArguments,
}

/// How a motion is brought to a spectrum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MatchMethod {
    /// Wavelets added in time (Al Atik and Abrahamson 2010)
    Wavelets,
    /// Fourier amplitudes, phases kept (Gasparini and Vanmarcke 1976)
    #[value(name = "fourier_amplitudes")]
    FourierAmplitudes,
}

/// Arguments of `motion match`.
#[derive(Debug, clap::Args)]
pub struct MatchArguments {
    /// Record file
    pub file: InputPath,
    /// Output
    #[command(flatten)]
    pub output: OutputArguments,
    /// Table of the spectrum to reach: header period_s,psa_g (or psa_m_s2, psa_cm_s2), straight lines in logarithms between its rows
    #[arg(long, required_unless_present = "code", conflicts_with = "code")]
    pub target: Option<InputPath>,
    /// Spectrum of a code: "eurocode_8_2004, ag=0.25 g, ground_type=B" (with spectrum_type=2 for type 2) or "asce_7_2016, s_ds=1.0 g, s_d1=0.6 g, t_l=8 s"
    #[arg(long)]
    pub code: Option<String>,
    /// Damping ratio of the spectrum
    #[arg(long, default_value = DAMPING, allow_hyphen_values = true)]
    pub damping: String,
    /// First period of the band
    #[arg(long, default_value = "0.1 s", allow_hyphen_values = true)]
    pub from: String,
    /// Last period of the band
    #[arg(long, default_value = "3 s", allow_hyphen_values = true)]
    pub to: String,
    /// Periods that are matched from the start; the result is held against all of the band
    #[arg(long, default_value_t = 80)]
    pub periods: usize,
    /// Maximum deviation from the target
    #[arg(long, default_value = "5 %", allow_hyphen_values = true)]
    pub tolerance: String,
    /// Iterations at most
    #[arg(long, default_value_t = 150)]
    pub iterations: usize,
    /// Method
    #[arg(long, value_enum, default_value = "wavelets")]
    pub method: MatchMethod,
    /// Reading
    #[command(flatten)]
    pub read: ReadArguments,
}
