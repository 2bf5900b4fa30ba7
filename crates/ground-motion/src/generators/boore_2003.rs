//! Boore (2003), Pure Appl. Geophys. 160, 635: the stochastic motion of a point source.
//!
//! White noise under a window gets the Fourier amplitudes of the source, the path and
//! the site. Not for the near field of large faults.

use std::f64::consts::{E, PI};
use std::fmt;

use crate::error::{GroundMotionError, positive, within};
use crate::generators::noise::Noise;
use crate::generators::{Generated, Generator, TimeGrid};
use crate::spectra::{inverse_transform, transform};
use crate::step_record::StepRecord;

const STEP: &str = Boore2003::GENERATOR.name;
/// Radiation pattern, part of one horizontal component, free surface.
const RADIATION: f64 = 0.55;
const PARTITION: f64 = 0.707;
const FREE_SURFACE: f64 = 2.0;
/// Distance that geometrical spreading refers to (m).
const REFERENCE_DISTANCE: f64 = 1.0e3;
/// Distance (m) where spreading goes from 1/R to R^-1/2.
const SPREADING_BREAK: f64 = 4.0e4;
/// Window: its peak is at this part of its length, and its value at the end.
const PEAK_AT: f64 = 0.2;
const AT_END: f64 = 0.05;
/// Length of the window over the duration of the motion.
const WINDOW_LENGTH: f64 = 2.0;
/// Time that the motion is given before the window, and at least after it, in periods of the corner
/// frequency: the amplitudes are given to the noise without a shift of phase, so that each sample
/// spreads to both sides by `exp(-2 pi fc t)`, and without what lies before the window the ground
/// would keep a velocity. SMSIM shifts its windows alike.
const BEFORE: f64 = 1.5;
const AFTER: f64 = 0.5;
/// Duration from the path (s/m).
const PATH_DURATION: f64 = 0.05e-3;
/// Amplification of generic rock at frequencies (Hz): Boore and Joyner (1997), Bull.
/// Seism. Soc. Am. 87 (2) 327 (values unverified).
const GENERIC_ROCK: [(f64, f64); 11] = [
    (0.01, 1.0),
    (0.09, 1.10),
    (0.16, 1.18),
    (0.51, 1.42),
    (0.84, 1.58),
    (1.25, 1.74),
    (2.26, 2.06),
    (3.17, 2.25),
    (6.05, 2.58),
    (16.6, 3.13),
    (61.2, 4.00),
];

/// What takes high frequencies away near the site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Diminution {
    /// `exp(-pi kappa f)` with kappa (s).
    Kappa(f64),
    /// `(1 + (f/fmax)^8)^(-1/2)` with fmax (Hz).
    HighestFrequency(f64),
}

impl fmt::Display for Diminution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kappa(kappa) => write!(f, "kappa {kappa} s"),
            Self::HighestFrequency(frequency) => write!(f, "fmax {frequency} Hz"),
        }
    }
}

/// A point source of a moment magnitude at a distance.
#[derive(Debug, Clone, PartialEq)]
pub struct Boore2003 {
    /// Moment magnitude M.
    pub magnitude: f64,
    /// Distance R to the source (m).
    pub distance: f64,
    /// Stress parameter (Pa).
    pub stress_parameter: f64,
    /// Shear-wave velocity at the source (m/s).
    pub shear_velocity: f64,
    /// Density at the source (kg/m3).
    pub density: f64,
    /// Q0 and eta of the quality factor `Q = Q0 f^eta`, f in Hz.
    pub quality: (f64, f64),
    /// Loss at the site.
    pub diminution: Diminution,
    /// Amplification at increasing frequencies (Hz), logarithms of amplification
    /// linear in those of frequency, the end values beyond; empty: none.
    pub amplification: Vec<(f64, f64)>,
}

impl Boore2003 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "boore_2003",
        title: "Stochastic motion of a point source",
        source: "Boore, Pure and Applied Geophysics 160 (2003) 635",
    };

    /// Western North America, generic rock: 2800 kg/m3, 3500 m/s, 8 MPa, kappa 0.035 s,
    /// Q = 180 f^0.45.
    #[must_use]
    pub fn western_north_america(magnitude: f64, distance: f64) -> Self {
        Self {
            magnitude,
            distance,
            stress_parameter: 8.0e6,
            shear_velocity: 3500.0,
            density: 2800.0,
            quality: (180.0, 0.45),
            diminution: Diminution::Kappa(0.035),
            amplification: GENERIC_ROCK.to_vec(),
        }
    }

    /// Seismic moment (N m): `10^(1.5 M + 9.05)` (Hanks and Kanamori 1979).
    #[must_use]
    pub fn moment(&self) -> f64 {
        libm::pow(10.0, 1.5 * self.magnitude + 9.05)
    }

    /// Corner frequency (Hz): `0.4906 b (stress/M0)^(1/3)` (Brune 1970).
    #[must_use]
    pub fn corner_frequency(&self) -> f64 {
        0.4906 * self.shear_velocity * libm::cbrt(self.stress_parameter / self.moment())
    }

    /// Duration of the motion (s): `1/fc + 0.05 s/km R`.
    #[must_use]
    pub fn duration(&self) -> f64 {
        1.0 / self.corner_frequency() + PATH_DURATION * self.distance
    }

    /// Expected Fourier amplitude (m/s) of the acceleration at a frequency (Hz).
    #[must_use]
    pub fn fourier_amplitude(&self, frequency: f64) -> f64 {
        if frequency <= 0.0 {
            return 0.0;
        }
        let constant = RADIATION * PARTITION * FREE_SURFACE
            / (4.0 * PI * self.density * self.shear_velocity.powi(3) * REFERENCE_DISTANCE);
        let source = constant * self.moment() * (2.0 * PI * frequency).powi(2)
            / (1.0 + (frequency / self.corner_frequency()).powi(2));
        let quality = self.quality.0 * libm::pow(frequency, self.quality.1);
        let path = libm::exp(-PI * frequency * self.distance / (quality * self.shear_velocity));
        source * self.spreading() * path * self.amplify(frequency) * self.diminish(frequency)
    }

    fn spreading(&self) -> f64 {
        let near = REFERENCE_DISTANCE / self.distance.min(SPREADING_BREAK);
        near * (SPREADING_BREAK / self.distance.max(SPREADING_BREAK)).sqrt()
    }

    fn diminish(&self, frequency: f64) -> f64 {
        match self.diminution {
            Diminution::Kappa(kappa) => libm::exp(-PI * kappa * frequency),
            Diminution::HighestFrequency(highest) => {
                libm::pow(1.0 + (frequency / highest).powi(8), -0.5)
            }
        }
    }

    fn amplify(&self, frequency: f64) -> f64 {
        let table = &self.amplification;
        let (Some(first), Some(last)) = (table.first(), table.last()) else {
            return 1.0;
        };
        let after = table.partition_point(|(f, _)| *f <= frequency);
        if after == 0 {
            return first.1;
        }
        if after == table.len() {
            return last.1;
        }
        let ((f0, a0), (f1, a1)) = (table[after - 1], table[after]);
        a0 * libm::pow(a1 / a0, libm::log(frequency / f0) / libm::log(f1 / f0))
    }

    /// Window (-) at a time (s), Saragoni and Hart's form: one at a fifth of its
    /// length, 0.05 at its end, zero after it.
    #[must_use]
    pub fn window(&self, time: f64) -> f64 {
        let part = time / (WINDOW_LENGTH * self.duration());
        if !(0.0..=1.0).contains(&part) {
            return 0.0;
        }
        let b = -PEAK_AT * libm::log(AT_END) / (1.0 + PEAK_AT * (libm::log(PEAK_AT) - 1.0));
        libm::pow(E / PEAK_AT * part, b) * libm::exp(-b / PEAK_AT * part)
    }

    fn check(&self) -> Result<(), GroundMotionError> {
        within(STEP, "magnitude", self.magnitude, 0.0, 10.0)?;
        within(STEP, "distance", self.distance, 1.0, 1.0e7)?;
        positive(STEP, "stress parameter", self.stress_parameter)?;
        positive(STEP, "shear-wave velocity", self.shear_velocity)?;
        positive(STEP, "density", self.density)?;
        positive(STEP, "quality factor", self.quality.0)?;
        within(
            STEP,
            "exponent of the quality factor",
            self.quality.1,
            -1.0,
            2.0,
        )?;
        match self.diminution {
            Diminution::Kappa(kappa) => within(STEP, "kappa", kappa, 0.0, 1.0)?,
            Diminution::HighestFrequency(highest) => positive(STEP, "highest frequency", highest)?,
        };
        for (i, (frequency, factor)) in self.amplification.iter().enumerate() {
            let before = if i == 0 {
                0.0
            } else {
                self.amplification[i - 1].0
            };
            let least = before.max(f64::MIN_POSITIVE) * (1.0 + 1.0e-12);
            within(
                STEP,
                "frequency of amplification",
                *frequency,
                least,
                f64::MAX,
            )?;
            positive(STEP, "amplification", *factor)?;
        }
        Ok(())
    }

    /// Time (s) before the window: one and a half periods of the corner frequency, in which the motion
    /// sets in.
    #[must_use]
    pub fn time_before_window(&self) -> f64 {
        BEFORE / self.corner_frequency()
    }

    /// The motion of a seed. The transform is taken over twice the duration at least;
    /// the window, twice the motion's duration long, starts after
    /// [`Self::time_before_window`].
    ///
    /// # Errors
    /// Parameters out of range, or a duration that has no room for the window, the time before it,
    /// and half a period of the corner frequency after it.
    pub fn generate(&self, grid: TimeGrid, seed: u64) -> Result<Generated, GroundMotionError> {
        self.check()?;
        let count = grid.count()?;
        let window = WINDOW_LENGTH * self.duration();
        let longest = grid.time_step * 1.0e7;
        let least = self.time_before_window() + window + AFTER / self.corner_frequency();
        within(STEP, "duration", grid.duration, least, longest)?;
        let h = grid.time_step;
        let length = (2 * count).next_power_of_two();
        let mut noise = Noise::new(seed);
        let before = (self.time_before_window() / h).ceil() as usize;
        let filled = ((window / h) as usize + 1).min(count.saturating_sub(before));
        let mut windowed = vec![0.0; before];
        windowed.extend((0..filled).map(|i| noise.normal() * self.window(i as f64 * h)));
        let mut coefficients = transform(&windowed, length);
        let inner = 1..length / 2;
        let square = coefficients[inner.clone()]
            .iter()
            .map(num_complex::Complex::norm_sqr)
            .sum::<f64>()
            / inner.len() as f64;
        let root_mean_square = square.sqrt();
        for (k, c) in coefficients.iter_mut().enumerate() {
            let frequency = k as f64 / (length as f64 * h);
            // The transform is 1/h times the continuous one.
            *c *= self.fourier_amplitude(frequency) / (root_mean_square * h);
        }
        let mut samples = inverse_transform(coefficients, length);
        samples.truncate(count);
        let step = StepRecord::new(STEP)
            .number("magnitude", self.magnitude, "-")
            .number("distance", self.distance, "m")
            .number("stress parameter", self.stress_parameter, "Pa")
            .number("shear-wave velocity", self.shear_velocity, "m/s")
            .number("density", self.density, "kg/m3")
            .number("moment", self.moment(), "N m")
            .number("corner frequency", self.corner_frequency(), "Hz")
            .number("duration of the motion", self.duration(), "s")
            .number("time before the window", before as f64 * h, "s")
            .remark(format!("seed {seed}, {}", self.diminution));
        grid.finish(samples, step)
    }
}
