//! From arguments to the generators of the library.

use std::f64::consts::TAU;

use pounding_case::{Dimension, bare_acceleration, bare_ground_velocity};
use pounding_ground_motion::generators::{
    Boore2003, CloughPenzien1975, Diminution, Envelope, FaultMechanism, Generated, KanaiTajimi1960,
    MakrisRoussos2000, MavroeidisPapageorgiou2003, PulseType, RezaeianDerKiureghian2010,
    RezaeianDerKiureghianScenario, Ricker1953, Sine, StationaryMotion, TimeGrid,
};

use super::words::Words;
use crate::arguments::{
    BooreArguments, CloughPenzienArguments, GridArguments, GroundArguments, KanaiTajimiArguments,
    MakrisRoussosArguments, MavroeidisPapageorgiouArguments, MechanismWord, PulseWord,
    RezaeianDerKiureghianArguments, RickerArguments, SineArguments, frequency, is_bare, value,
};
use crate::failure::Failure;
use crate::output::warn;

/// Frequency of Kanai's firm ground (rad/s).
const FIRM_GROUND: f64 = 15.6;

fn number(text: &str, name: &str) -> Result<f64, Failure> {
    value(text, name, Dimension::NUMBER)
}

/// An angle (rad): a plain number or "0.5 rad", or degrees, "30 deg".
fn angle(text: &str, name: &str) -> Result<f64, Failure> {
    let bare = text.trim();
    let degrees = ["degrees", "deg", "\u{b0}"]
        .iter()
        .find_map(|unit| bare.strip_suffix(unit));
    Ok(match degrees {
        Some(degrees) => number(degrees.trim_end(), name)?.to_radians(),
        None => number(bare, name)?,
    })
}

fn time(text: &str, name: &str) -> Result<f64, Failure> {
    value(text, name, Dimension::TIME)
}

/// In Hz/s, as plain numbers are: an angle, such as "-0.4 rad/s^2", is a circular one.
fn frequency_rate(text: &str) -> Result<f64, Failure> {
    const HERTZ_PER_SECOND: Dimension = Dimension {
        mass: 0.0,
        length: 0.0,
        time: -2.0,
    };
    let found = value(text, "frequency-rate", HERTZ_PER_SECOND)?;
    Ok(if text.contains("rad") {
        found / TAU
    } else {
        found
    })
}

/// Least peak acceleration (g) that is usual.
const LEAST_PEAK: f64 = 0.1;
/// Least distance (m) that is usual.
const LEAST_DISTANCE: f64 = 1.0e3;
/// Least stress parameter (Pa) that earthquakes have.
const LEAST_STRESS: f64 = 1.0e5;

/// An acceleration, with a question where a number without a unit is as small as none that is asked for.
fn acceleration(text: &str, name: &str) -> Result<f64, Failure> {
    let found = value(text, name, Dimension::ACCELERATION)?;
    let question = bare_acceleration(&format!("--{name}"), found, LEAST_PEAK);
    if let Some(question) = question.filter(|_| is_bare(text)) {
        warn(&question);
    }
    Ok(found)
}

/// A velocity of the ground, with a question where a number without a unit is one that no ground reaches.
fn ground_velocity(text: &str, name: &str) -> Result<f64, Failure> {
    let found = value(text, name, Dimension::VELOCITY)?;
    let question = bare_ground_velocity(&format!("--{name}"), found);
    if let Some(question) = question.filter(|_| is_bare(text)) {
        warn(&question);
    }
    Ok(found)
}

/// Time step and duration.
fn grid(arguments: &GridArguments) -> Result<TimeGrid, Failure> {
    Ok(TimeGrid {
        time_step: match &arguments.time_step {
            Some(text) => value(text, "time-step", Dimension::TIME)?,
            None => TimeGrid::USUAL_TIME_STEP,
        },
        duration: value(&arguments.duration, "duration", Dimension::TIME)?,
    })
}

/// An envelope from its words.
fn envelope(text: &str) -> Result<Envelope, Failure> {
    let words = Words::of("envelope", text)?;
    let time = |key| words.value(key, Dimension::TIME);
    let rate = |key| words.value(key, Dimension::FREQUENCY);
    let (known, envelope): (&[&str], _) = match words.word {
        "constant" => (&[], Envelope::Constant),
        "half_sine" => (&[], Envelope::HalfSine),
        "ramped" => (
            &["rise", "fall"],
            Envelope::Ramped {
                rise: time("rise")?,
                fall: time("fall")?,
            },
        ),
        "decay" => (
            &["rate"],
            Envelope::Decay {
                rate: rate("rate")?,
            },
        ),
        "jennings_housner_tsai_1968" => (
            &["rise", "strong_end", "decay"],
            Envelope::JenningsHousnerTsai1968 {
                rise: time("rise")?,
                strong_end: time("strong_end")?,
                decay: rate("decay")?,
            },
        ),
        "saragoni_hart_1974" => (
            &["power", "rate"],
            Envelope::SaragoniHart1974 {
                power: words.value("power", Dimension::NUMBER)?,
                rate: rate("rate")?,
            },
        ),
        "shinozuka_sato_1967" => (
            &["slow", "fast"],
            Envelope::ShinozukaSato1967 {
                slow: rate("slow")?,
                fast: rate("fast")?,
            },
        ),
        other => {
            return Err(Failure::input(
                format!("--envelope: \"{other}\" is not known"),
                Some(
                    "known: constant, half_sine, ramped, decay, jennings_housner_tsai_1968, saragoni_hart_1974, shinozuka_sato_1967"
                        .to_owned(),
                ),
            ));
        }
    };
    words.only(known)?;
    Ok(envelope)
}

/// A sine.
pub fn sine(a: &SineArguments) -> Result<Generated, Failure> {
    let grid = grid(&a.grid)?;
    let motion = Sine {
        amplitude: acceleration(&a.amplitude, "amplitude")?,
        frequency: frequency(&a.frequency, "frequency")?,
        phase: angle(&a.phase, "phase")?,
        length: match &a.length {
            Some(text) => time(text, "length")?,
            None => grid.duration,
        },
        envelope: envelope(&a.envelope)?,
    };
    Ok(motion.generate(grid)?)
}

/// Ricker's wavelet.
pub fn ricker(a: &RickerArguments) -> Result<Generated, Failure> {
    let period = time(&a.period, "period")?;
    let motion = Ricker1953 {
        amplitude: acceleration(&a.amplitude, "amplitude")?,
        period,
        centre: match &a.centre {
            Some(text) => time(text, "centre")?,
            None => 1.5 * period,
        },
    };
    Ok(motion.generate(grid(&a.grid)?)?)
}

/// The pulse of Mavroeidis and Papageorgiou.
pub fn velocity_pulse(a: &MavroeidisPapageorgiouArguments) -> Result<Generated, Failure> {
    let frequency = frequency(&a.frequency, "frequency")?;
    let oscillation = number(&a.gamma, "gamma")?;
    let motion = MavroeidisPapageorgiou2003 {
        amplitude: ground_velocity(&a.amplitude, "amplitude")?,
        frequency,
        oscillation,
        phase: angle(&a.phase, "phase")?,
        centre: match &a.centre {
            Some(text) => time(text, "centre")?,
            None => 0.5 * oscillation / frequency,
        },
    };
    Ok(motion.generate(grid(&a.grid)?)?)
}

/// A pulse of Makris and Roussos.
pub fn trigonometric_pulse(a: &MakrisRoussosArguments) -> Result<Generated, Failure> {
    if a.cycles.is_some() && a.pulse != PulseWord::C {
        return Err(Failure::input(
            "--cycles is of pulses of type C: those of types A and B have one",
            Some("leave it out, or give --type c".to_owned()),
        ));
    }
    let motion = MakrisRoussos2000 {
        pulse: match a.pulse {
            PulseWord::A => PulseType::A,
            PulseWord::B => PulseType::B,
            PulseWord::C => PulseType::C {
                cycles: a.cycles.unwrap_or(1),
            },
        },
        amplitude: ground_velocity(&a.amplitude, "amplitude")?,
        period: time(&a.period, "period")?,
        start: time(&a.start, "start")?,
    };
    Ok(motion.generate(grid(&a.grid)?)?)
}

/// Peak acceleration and peak factor, frequency and damping ratio of the ground.
struct Ground {
    peak: f64,
    factor: f64,
    frequency: f64,
    damping: f64,
}

impl Ground {
    fn of(a: &GroundArguments) -> Result<Self, Failure> {
        Ok(Self {
            peak: acceleration(&a.peak_acceleration, "peak-acceleration")?,
            factor: number(&a.peak_factor, "peak-factor")?,
            frequency: match &a.ground_frequency {
                Some(text) => TAU * frequency(text, "ground-frequency")?,
                None => FIRM_GROUND,
            },
            damping: number(&a.ground_damping, "ground-damping")?,
        })
    }
}

/// Noise through the ground.
pub fn kanai_tajimi(a: &KanaiTajimiArguments) -> Result<Generated, Failure> {
    let ground = Ground::of(&a.ground)?;
    let motion = StationaryMotion {
        spectrum: KanaiTajimi1960::for_peak(
            ground.peak,
            ground.factor,
            ground.frequency,
            ground.damping,
        )?,
        envelope: envelope(&a.ground.envelope)?,
    };
    Ok(motion.generate(grid(&a.seeded.grid)?, a.seeded.seed)?)
}

/// Noise through the ground and a second filter.
pub fn clough_penzien(a: &CloughPenzienArguments) -> Result<Generated, Failure> {
    let ground = Ground::of(&a.ground)?;
    let motion = StationaryMotion {
        spectrum: CloughPenzien1975::for_peak(
            ground.peak,
            ground.factor,
            KanaiTajimi1960 {
                // Chosen by the peak, behind both filters.
                intensity: 1.0,
                ground_frequency: ground.frequency,
                ground_damping: ground.damping,
            },
            match &a.filter_frequency {
                Some(text) => TAU * frequency(text, "filter-frequency")?,
                None => 0.1 * ground.frequency,
            },
            number(&a.filter_damping, "filter-damping")?,
        )?,
        envelope: envelope(&a.ground.envelope)?,
    };
    Ok(motion.generate(grid(&a.seeded.grid)?, a.seeded.seed)?)
}

/// The motion of an earthquake, or of six parameters.
pub fn rezaeian(a: &RezaeianDerKiureghianArguments) -> Result<Generated, Failure> {
    if a.magnitude.is_none() && a.significant_duration.is_none() {
        return Err(Failure::input(
            "rezaeian_der_kiureghian_2010 needs one of --magnitude and --significant-duration",
            Some("give an earthquake by --magnitude, --distance and --shear-velocity, or the motion by --significant-duration, --middle-time and --middle-frequency".to_owned()),
        ));
    }
    let high_pass = match &a.high_pass {
        Some(text) => frequency(text, "high-pass")?,
        None => RezaeianDerKiureghian2010::USUAL_HIGH_PASS,
    };
    let seed = a.seeded.seed;
    let given = |text: &Option<String>, name: &str, dimension| {
        let text = text
            .as_ref()
            .ok_or_else(|| Failure::input(format!("--{name} is missing"), None))?;
        value(text, name, dimension)
    };
    let motion = if a.magnitude.is_some() {
        let scenario = RezaeianDerKiureghianScenario {
            magnitude: given(&a.magnitude, "magnitude", Dimension::NUMBER)?,
            distance: given(&a.distance, "distance", Dimension::LENGTH)?,
            shear_velocity: given(&a.shear_velocity, "shear-velocity", Dimension::VELOCITY)?,
            mechanism: match a.mechanism {
                MechanismWord::StrikeSlip => FaultMechanism::StrikeSlip,
                MechanismWord::Reverse => FaultMechanism::Reverse,
            },
        };
        if a.median {
            scenario.median(high_pass)?
        } else {
            scenario.draw(high_pass, seed)?
        }
    } else {
        let middle_frequency = match &a.middle_frequency {
            Some(text) => frequency(text, "middle-frequency")?,
            None => return Err(Failure::input("--middle-frequency is missing", None)),
        };
        let usual = RezaeianDerKiureghian2010::usual(
            given(
                &a.significant_duration,
                "significant-duration",
                Dimension::TIME,
            )?,
            given(&a.middle_time, "middle-time", Dimension::TIME)?,
            middle_frequency,
        );
        let or = |text: &Option<String>, name: &str, dimension, usual| match text {
            Some(text) => value(text, name, dimension),
            None => Ok(usual),
        };
        RezaeianDerKiureghian2010 {
            arias_intensity: or(
                &a.arias_intensity,
                "arias-intensity",
                Dimension::VELOCITY,
                usual.arias_intensity,
            )?,
            frequency_rate: match &a.frequency_rate {
                Some(text) => frequency_rate(text)?,
                None => usual.frequency_rate,
            },
            damping: or(
                &a.filter_damping,
                "filter-damping",
                Dimension::NUMBER,
                usual.damping,
            )?,
            high_pass,
            ..usual
        }
    };
    Ok(motion.generate(grid(&a.seeded.grid)?, seed)?)
}

/// The motion of a point source.
pub fn boore(a: &BooreArguments) -> Result<Generated, Failure> {
    let distance = value(&a.distance, "distance", Dimension::LENGTH)?;
    if is_bare(&a.distance) && (0.0..LEAST_DISTANCE).contains(&distance) {
        let given = a.distance.trim();
        warn(&format!(
            "--distance is {given} m, near for an earthquake; a number without unit is in m: was \"{given} km\" meant? If not, write \"{given} m\""
        ));
    }
    let stress = value(&a.stress_parameter, "stress-parameter", Dimension::PRESSURE)?;
    if is_bare(&a.stress_parameter) && (0.0..LEAST_STRESS).contains(&stress) {
        let given = a.stress_parameter.trim();
        warn(&format!(
            "--stress-parameter is {given} Pa, which no earthquake has; a number without unit is in Pa: write a usual one as \"8 MPa\", which is 80 bar"
        ));
    }
    let mut source = Boore2003::western_north_america(number(&a.magnitude, "magnitude")?, distance);
    source.stress_parameter = stress;
    source.diminution = Diminution::Kappa(time(&a.kappa, "kappa")?);
    if a.hard_rock {
        source.amplification.clear();
    }
    Ok(source.generate(grid(&a.seeded.grid)?, a.seeded.seed)?)
}
