//! Arguments of `motion synth`.

use clap::{Subcommand, ValueEnum};
use pounding_ground_motion::generators::{
    self, Boore2003, CloughPenzien1975, KanaiTajimi1960, MakrisRoussos2000,
    MavroeidisPapageorgiou2003, RezaeianDerKiureghian2010, Ricker1953, Sine,
};

use super::OutputArguments;

/// Arguments of `motion synth`.
#[derive(Debug, clap::Args)]
pub struct SynthArguments {
    /// What makes the motion
    #[command(subcommand)]
    pub generator: Generator,
}

/// Time step, length and output of a motion to make.
#[derive(Debug, Clone, clap::Args)]
pub struct GridArguments {
    /// Time step [default: 0.01 s]
    #[arg(long, allow_hyphen_values = true)]
    pub time_step: Option<String>,
    /// Time of the last sample
    #[arg(long, allow_hyphen_values = true)]
    pub duration: String,
    /// Output
    #[command(flatten)]
    pub output: OutputArguments,
}

/// The same with the seed of a random motion.
#[derive(Debug, Clone, clap::Args)]
pub struct SeededArguments {
    /// Seed: the same seed gives the same motion
    #[arg(long)]
    pub seed: u64,
    /// Grid
    #[command(flatten)]
    pub grid: GridArguments,
}

/// A generator, named by author and year.
#[derive(Debug, Subcommand)]
pub enum Generator {
    /// [`Sine`]
    #[command(name = Sine::GENERATOR.name, about = Sine::GENERATOR.title, after_help = source(&Sine::GENERATOR))]
    Sine(SineArguments),
    /// [`Ricker1953`]
    #[command(name = Ricker1953::GENERATOR.name, about = Ricker1953::GENERATOR.title, after_help = source(&Ricker1953::GENERATOR))]
    Ricker(RickerArguments),
    /// [`MavroeidisPapageorgiou2003`]
    #[command(name = MavroeidisPapageorgiou2003::GENERATOR.name, about = MavroeidisPapageorgiou2003::GENERATOR.title, after_help = source(&MavroeidisPapageorgiou2003::GENERATOR))]
    MavroeidisPapageorgiou(MavroeidisPapageorgiouArguments),
    /// [`MakrisRoussos2000`]
    #[command(name = MakrisRoussos2000::GENERATOR.name, about = MakrisRoussos2000::GENERATOR.title, after_help = source(&MakrisRoussos2000::GENERATOR))]
    MakrisRoussos(MakrisRoussosArguments),
    /// [`KanaiTajimi1960`]
    #[command(name = KanaiTajimi1960::GENERATOR.name, about = KanaiTajimi1960::GENERATOR.title, after_help = source(&KanaiTajimi1960::GENERATOR))]
    KanaiTajimi(KanaiTajimiArguments),
    /// [`CloughPenzien1975`]
    #[command(name = CloughPenzien1975::GENERATOR.name, about = CloughPenzien1975::GENERATOR.title, after_help = source(&CloughPenzien1975::GENERATOR))]
    CloughPenzien(CloughPenzienArguments),
    /// [`RezaeianDerKiureghian2010`]
    #[command(name = RezaeianDerKiureghian2010::GENERATOR.name, about = RezaeianDerKiureghian2010::GENERATOR.title, after_help = source(&RezaeianDerKiureghian2010::GENERATOR))]
    RezaeianDerKiureghian(RezaeianDerKiureghianArguments),
    /// [`Boore2003`]
    #[command(name = Boore2003::GENERATOR.name, about = Boore2003::GENERATOR.title, after_help = source(&Boore2003::GENERATOR))]
    Boore(BooreArguments),
}

fn source(generator: &generators::Generator) -> String {
    format!("Source: {}", generator.source)
}

/// Arguments of `motion synth sine`.
#[derive(Debug, clap::Args)]
pub struct SineArguments {
    /// Amplitude, such as "0.3 g"
    #[arg(long)]
    pub amplitude: String,
    /// Frequency, such as "1.5 Hz"
    #[arg(long)]
    pub frequency: String,
    /// Phase (rad), or in degrees, "30 deg"
    #[arg(long, default_value = "0", allow_hyphen_values = true)]
    pub phase: String,
    /// Length of the sine [default: the duration]
    #[arg(long)]
    pub length: Option<String>,
    /// Envelope: constant, half_sine, "ramped, rise=2 s, fall=2 s", "decay, rate=0.2"
    #[arg(long, default_value = "constant")]
    pub envelope: String,
    /// Grid
    #[command(flatten)]
    pub grid: GridArguments,
}

/// Arguments of `motion synth ricker_1953`.
#[derive(Debug, clap::Args)]
pub struct RickerArguments {
    /// Peak acceleration, such as "0.3 g"
    #[arg(long)]
    pub amplitude: String,
    /// Period of the maximum Fourier amplitude
    #[arg(long)]
    pub period: String,
    /// Time of the peak [default: 1.5 periods]
    #[arg(long)]
    pub centre: Option<String>,
    /// Grid
    #[command(flatten)]
    pub grid: GridArguments,
}

/// Arguments of `motion synth mavroeidis_papageorgiou_2003`.
#[derive(Debug, clap::Args)]
pub struct MavroeidisPapageorgiouArguments {
    /// Amplitude of the velocity, such as "0.8 m/s"
    #[arg(long)]
    pub amplitude: String,
    /// Frequency fp, such as "0.5 Hz"
    #[arg(long)]
    pub frequency: String,
    /// Oscillatory character gamma, above 1
    #[arg(long)]
    pub gamma: String,
    /// Phase nu (rad), or in degrees, "30 deg"
    #[arg(long, default_value = "0", allow_hyphen_values = true)]
    pub phase: String,
    /// Time of the envelope's peak [default: half the pulse's length]
    #[arg(long)]
    pub centre: Option<String>,
    /// Grid
    #[command(flatten)]
    pub grid: GridArguments,
}

/// Shape of a trigonometric pulse.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum PulseWord {
    /// One-sided velocity
    A,
    /// One cycle of velocity
    B,
    /// Several cycles
    C,
}

/// Arguments of `motion synth makris_roussos_2000`.
#[derive(Debug, clap::Args)]
pub struct MakrisRoussosArguments {
    /// Type of the pulse
    #[arg(long = "type", value_enum, ignore_case = true)]
    pub pulse: PulseWord,
    /// Cycles of type C [default: 1]
    #[arg(long)]
    pub cycles: Option<u32>,
    /// Amplitude of the velocity, such as "0.8 m/s"
    #[arg(long)]
    pub amplitude: String,
    /// Period
    #[arg(long)]
    pub period: String,
    /// Start
    #[arg(long, default_value = "0 s", allow_hyphen_values = true)]
    pub start: String,
    /// Grid
    #[command(flatten)]
    pub grid: GridArguments,
}

/// White noise, its ground and its envelope.
#[derive(Debug, Clone, clap::Args)]
pub struct GroundArguments {
    /// Peak acceleration to aim at, such as "0.3 g"; a motion of a seed comes near it
    #[arg(long)]
    pub peak_acceleration: String,
    /// Peak over standard deviation of the strong part
    #[arg(long, default_value = "3")]
    pub peak_factor: String,
    /// Frequency of the ground, such as "2.5 Hz" or "15.6 rad/s"; a plain number is in Hz [default: 15.6 rad/s, of firm ground]
    #[arg(long)]
    pub ground_frequency: Option<String>,
    /// Damping ratio of the ground
    #[arg(long, default_value = "0.6")]
    pub ground_damping: String,
    /// Envelope: "jennings_housner_tsai_1968, rise=4 s, strong_end=15 s, decay=0.0992", "saragoni_hart_1974, power=2, rate=0.4", "shinozuka_sato_1967, slow=0.1, fast=0.5", "ramped, rise=2 s, fall=5 s" or constant
    #[arg(
        long,
        default_value = "jennings_housner_tsai_1968, rise=2 s, strong_end=10 s, decay=0.25"
    )]
    pub envelope: String,
}

/// Arguments of `motion synth kanai_tajimi_1960`.
#[derive(Debug, clap::Args)]
pub struct KanaiTajimiArguments {
    /// Ground
    #[command(flatten)]
    pub ground: GroundArguments,
    /// Seed
    #[command(flatten)]
    pub seeded: SeededArguments,
}

/// Arguments of `motion synth clough_penzien_1975`.
#[derive(Debug, clap::Args)]
pub struct CloughPenzienArguments {
    /// Ground
    #[command(flatten)]
    pub ground: GroundArguments,
    /// Frequency of the second filter, such as "0.25 Hz" or "1.56 rad/s"; a plain number is in Hz [default: a tenth of that of the ground]
    #[arg(long)]
    pub filter_frequency: Option<String>,
    /// Damping ratio of the second filter
    #[arg(long, default_value = "0.6")]
    pub filter_damping: String,
    /// Seed
    #[command(flatten)]
    pub seeded: SeededArguments,
}

/// How a fault moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum MechanismWord {
    /// Strike-slip
    #[value(name = "strike_slip")]
    StrikeSlip,
    /// Reverse
    Reverse,
}

/// Arguments of `motion synth rezaeian_der_kiureghian_2010`: an earthquake, or the six
/// parameters of the motion.
#[derive(Debug, clap::Args)]
pub struct RezaeianDerKiureghianArguments {
    /// Magnitude of the earthquake, 6 to 8
    #[arg(long, requires_all = ["distance", "shear_velocity"])]
    pub magnitude: Option<String>,
    /// Distance from the rupture, 10 to 100 km
    #[arg(long, requires = "magnitude")]
    pub distance: Option<String>,
    /// Mean shear-wave velocity of the upper 30 m, 600 m/s and more
    #[arg(long, requires = "magnitude")]
    pub shear_velocity: Option<String>,
    /// Mechanism
    #[arg(
        long,
        value_enum,
        default_value = "strike_slip",
        conflicts_with = "significant_duration"
    )]
    pub mechanism: MechanismWord,
    /// Take the median parameters of the earthquake, not random ones of the seed
    #[arg(long, requires = "magnitude")]
    pub median: bool,
    /// Arias intensity, such as "0.5 m/s" [default: 1 m/s]
    #[arg(long, requires = "significant_duration", conflicts_with = "magnitude")]
    pub arias_intensity: Option<String>,
    /// Duration from 5 to 95 % of the Arias intensity, instead of an earthquake
    #[arg(long, conflicts_with = "magnitude", requires_all = ["middle_time", "middle_frequency"])]
    pub significant_duration: Option<String>,
    /// Time at which 45 % of it is reached
    #[arg(long, requires = "significant_duration", conflicts_with = "magnitude")]
    pub middle_time: Option<String>,
    /// Frequency of the filter at that time
    #[arg(long, requires = "significant_duration", conflicts_with = "magnitude")]
    pub middle_frequency: Option<String>,
    /// Change of that frequency, such as "-0.06 1/s^2"; a plain number is in Hz/s [default: -0.1]
    #[arg(
        long,
        requires = "significant_duration",
        conflicts_with = "magnitude",
        allow_hyphen_values = true
    )]
    pub frequency_rate: Option<String>,
    /// Damping ratio of the filter [default: 0.3]
    #[arg(long, requires = "significant_duration", conflicts_with = "magnitude")]
    pub filter_damping: Option<String>,
    /// Corner of the high-pass at the end [default: 0.15 Hz]
    #[arg(long)]
    pub high_pass: Option<String>,
    /// Seed
    #[command(flatten)]
    pub seeded: SeededArguments,
}

/// Arguments of `motion synth boore_2003`.
#[derive(Debug, clap::Args)]
pub struct BooreArguments {
    /// Moment magnitude
    #[arg(long)]
    pub magnitude: String,
    /// Distance to the source, such as "20 km"
    #[arg(long)]
    pub distance: String,
    /// Stress parameter
    #[arg(long, default_value = "8 MPa")]
    pub stress_parameter: String,
    /// Loss of high frequencies at the site, kappa
    #[arg(long, default_value = "0.035 s")]
    pub kappa: String,
    /// Leave the amplification of generic rock out
    #[arg(long)]
    pub hard_rock: bool,
    /// Seed
    #[command(flatten)]
    pub seeded: SeededArguments,
}
