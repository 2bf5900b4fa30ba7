//! Rezaeian and Der Kiureghian (2008, 2010), Earthq. Eng. Struct. Dyn. 37, 1591 and 39,
//! 1155: white noise through a filter whose frequency changes, under an envelope.

mod scenario;

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

pub use scenario::{FaultMechanism, RezaeianDerKiureghianScenario};

use crate::distributions::{gamma_exceedance, gamma_quantile, ln_gamma};
use crate::error::{GroundMotionError, bound, positive, within};
use crate::generators::noise::Noise;
use crate::generators::{Generated, Generator, TimeGrid, WARNING};
use crate::measures::GRAVITY;
use crate::spectra::exponential;
use crate::step_record::StepRecord;

const STEP: &str = RezaeianDerKiureghian2010::GENERATOR.name;
/// The filter's frequency does not fall below this (Hz).
const LEAST_FREQUENCY: f64 = 0.3;
/// A pulse's response is followed down to this part of its start.
const NEGLIGIBLE: f64 = 1.0e-9;
/// Shapes of the gamma density q^2: from a vertical start to nearly symmetric.
const LEAST_SHAPE: f64 = 1.0;
const GREATEST_SHAPE: f64 = 1.0e3;

/// A motion by its six parameters and the high-pass at the end.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RezaeianDerKiureghian2010 {
    /// Expected Arias intensity (m/s) before the high-pass.
    pub arias_intensity: f64,
    /// Duration from 5 to 95 % of it (s).
    pub significant_duration: f64,
    /// Time at which 45 % of it is reached (s), the middle of the strong motion.
    pub middle_time: f64,
    /// Frequency of the filter at the middle (Hz).
    pub middle_frequency: f64,
    /// Change of that frequency (Hz/s), mostly below zero.
    pub frequency_rate: f64,
    /// Damping ratio of the filter (-), the bandwidth.
    pub damping: f64,
    /// Corner of the critically damped high-pass (Hz), 0.1 to 0.2.
    pub high_pass: f64,
}

/// `q = a1 t^(a2 - 1) exp(-a3 t)`; q^2 is a gamma density of shape 2 a2 - 1 and rate
/// 2 a3 times `int a^2 dt`.
#[derive(Debug, Clone, Copy)]
struct Modulation {
    shape: f64,
    rate: f64,
    ln_factor: f64,
}

impl Modulation {
    fn at(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return if self.shape > 1.0 {
                0.0
            } else {
                libm::exp(self.ln_factor)
            };
        }
        libm::exp(
            self.ln_factor + 0.5 * (self.shape - 1.0) * libm::log(time) - 0.5 * self.rate * time,
        )
    }
}

/// Part of the Arias intensity beyond D5-95, which a motion may lose at its end.
const BEYOND: f64 = 0.05;
/// Part up to which a motion is said to hold the Arias intensity.
const NEARLY_ALL: f64 = 0.999;
/// Part of the Arias intensity that the high-pass leaves, below which it is said.
const LITTLE_LOST: f64 = 0.9;
/// Part of the Arias intensity beyond which a filter that is held at a bound is said.
const HELD: f64 = 0.01;

impl Modulation {
    /// What is to be said of a duration (s) that ends the motion before 95 % of the Arias intensity
    /// are expected.
    fn cut_off(&self, duration: f64) -> Option<String> {
        let lost = gamma_exceedance(self.shape, self.rate * duration);
        (lost > BEYOND).then(|| {
            let whole = gamma_quantile(self.shape, NEARLY_ALL) / self.rate;
            format!(
                "{WARNING}the duration of {duration} s cuts {:.1} % of the expected Arias intensity off, more than the 5 % beyond D5-95; {:.0} s hold 99.9 % of it",
                100.0 * lost,
                whole.ceil()
            )
        })
    }
}

/// Ratio of D5-95 to t45 of a gamma density; falls as the shape grows.
fn ratio(shape: f64) -> f64 {
    let at = |part| gamma_quantile(shape, part);
    (at(0.95) - at(0.05)) / at(0.45)
}

impl RezaeianDerKiureghian2010 {
    /// Name, title and source.
    pub const GENERATOR: Generator = Generator {
        name: "rezaeian_der_kiureghian_2010",
        title: "Noise through a filter that changes, from its parameters or from an earthquake",
        source: "Rezaeian and Der Kiureghian, Earthquake Engineering and Structural Dynamics 37 (2008) 1591 and 39 (2010) 1155",
    };

    /// Corner of the high-pass (Hz) unless another is asked for.
    pub const USUAL_HIGH_PASS: f64 = 0.15;

    /// A motion of these times (s) and middle frequency (Hz), with usual values of all
    /// else, which every program that leaves them out shares: an Arias intensity of 1 m/s,
    /// a frequency that falls by 0.1 Hz/s, a damping ratio of 0.3 and a high-pass at
    /// [`Self::USUAL_HIGH_PASS`].
    #[must_use]
    pub fn usual(significant_duration: f64, middle_time: f64, middle_frequency: f64) -> Self {
        Self {
            arias_intensity: 1.0,
            significant_duration,
            middle_time,
            middle_frequency,
            frequency_rate: -0.1,
            damping: 0.3,
            high_pass: Self::USUAL_HIGH_PASS,
        }
    }

    fn check(&self, grid: TimeGrid) -> Result<(), GroundMotionError> {
        positive(STEP, "Arias intensity", self.arias_intensity)?;
        positive(STEP, "significant duration", self.significant_duration)?;
        positive(STEP, "middle time", self.middle_time)?;
        let nyquist = 0.5 / grid.time_step;
        within(
            STEP,
            "middle frequency",
            self.middle_frequency,
            LEAST_FREQUENCY,
            nyquist,
        )?;
        within(
            STEP,
            "frequency rate",
            self.frequency_rate,
            -nyquist,
            nyquist,
        )?;
        within(STEP, "damping", self.damping, 1.0e-3, 0.999)?;
        within(STEP, "high-pass corner", self.high_pass, 1.0e-3, nyquist)?;
        Ok(())
    }

    fn modulation(&self) -> Result<Modulation, GroundMotionError> {
        let wanted = self.significant_duration / self.middle_time;
        let (widest, narrowest) = (ratio(LEAST_SHAPE), ratio(GREATEST_SHAPE));
        within(STEP, "duration over middle time", wanted, narrowest, widest)?;
        let (mut low, mut high) = (LEAST_SHAPE, GREATEST_SHAPE);
        for _ in 0..60 {
            let middle = (low * high).sqrt();
            if ratio(middle) > wanted {
                low = middle;
            } else {
                high = middle;
            }
        }
        let shape = (low * high).sqrt();
        let rate = gamma_quantile(shape, 0.45) / self.middle_time;
        let square = self.arias_intensity * 2.0 * GRAVITY / PI;
        Ok(Modulation {
            shape,
            rate,
            ln_factor: 0.5 * (libm::log(square) + shape * libm::log(rate) - ln_gamma(shape)),
        })
    }

    /// Whether the envelope exists: the ratio of duration to middle time must be one
    /// that a gamma density has.
    pub(crate) fn feasible(&self) -> bool {
        self.modulation().is_ok()
    }

    /// The filter's frequency (Hz) at a time, by its line.
    fn line_of_frequency(&self, time: f64) -> f64 {
        self.middle_frequency + self.frequency_rate * (time - self.middle_time)
    }

    /// The filter's frequency (rad/s) at a time, held within bounds.
    fn filter_frequency(&self, time: f64, highest: f64) -> f64 {
        TAU * self.line_of_frequency(time).clamp(LEAST_FREQUENCY, highest)
    }

    /// What is to be said of a high-pass that takes much of the expected Arias intensity off, and of a
    /// filter that is held at a bound where more than a trifle of it lies.
    fn expected_warnings(
        &self,
        grid: TimeGrid,
        count: usize,
        modulation: &Modulation,
    ) -> Vec<String> {
        let nyquist = 0.5 / grid.time_step;
        let corner = TAU * self.high_pass;
        let [mut whole, mut kept, mut below, mut above] = [0.0; 4];
        for i in 0..count {
            let time = i as f64 * grid.time_step;
            let square = modulation.at(time).powi(2);
            let w = self.filter_frequency(time, nyquist);
            whole += square;
            kept += square * part_above(corner, w, self.damping);
            let f = self.line_of_frequency(time);
            below += if f < LEAST_FREQUENCY { square } else { 0.0 };
            above += if f > nyquist { square } else { 0.0 };
        }
        let mut warnings = Vec::new();
        if kept < LITTLE_LOST * whole {
            warnings.push(format!(
                "{WARNING}the high-pass of {} Hz, which comes after the motion is scaled, takes {:.0} % of the expected Arias intensity off, and more of a motion that is short beside the periods of its filter; a lower corner takes less",
                bound(self.high_pass),
                100.0 * (1.0 - kept / whole),
            ));
        }
        // A frequency that falls is too low after a time, one that rises before it.
        let held = |is_below: bool, part: f64, at: f64, what: &str| {
            (part > HELD * whole).then(|| {
                let time = self.middle_time + (at - self.middle_frequency) / self.frequency_rate;
                let when = match is_below == (self.frequency_rate < 0.0) {
                    true => "from",
                    false => "until",
                };
                format!(
                    "{WARNING}the frequency of the filter, {} Hz at {} s and {:+} Hz/s, is held at {what}, {when} {} s, where {:.0} % of the expected Arias intensity lie; a frequency rate nearer to zero, or of another seed where it is drawn, keeps it within its bounds",
                    bound(self.middle_frequency),
                    bound(self.middle_time),
                    self.frequency_rate,
                    bound(time),
                    100.0 * part / whole
                )
            })
        };
        let least = format!("{LEAST_FREQUENCY} Hz, the lowest of the model");
        let most = format!("{} Hz, half the sampling rate", bound(nyquist));
        warnings.extend(held(true, below, LEAST_FREQUENCY, &least));
        warnings.extend(held(false, above, nyquist, &most));
        warnings
    }

    /// The motion of a seed.
    ///
    /// # Errors
    /// Parameters out of range, or a duration and a middle time that no gamma density
    /// has together.
    pub fn generate(&self, grid: TimeGrid, seed: u64) -> Result<Generated, GroundMotionError> {
        self.check(grid)?;
        let count = grid.count()?;
        let modulation = self.modulation()?;
        let samples = self.filtered_noise(grid.time_step, count, &mut Noise::new(seed));
        let modulated: Vec<f64> = samples
            .iter()
            .enumerate()
            .map(|(i, x)| x * modulation.at(i as f64 * grid.time_step))
            .collect();
        let samples = high_pass(&modulated, grid.time_step, TAU * self.high_pass);
        let step = StepRecord::new(STEP)
            .number("Arias intensity", self.arias_intensity, "m/s")
            .number("5-95 % duration", self.significant_duration, "s")
            .number("middle time", self.middle_time, "s")
            .number("middle frequency", self.middle_frequency, "Hz")
            .number("frequency rate", self.frequency_rate, "Hz/s")
            .number("filter damping", self.damping, "-")
            .number("high-pass corner", self.high_pass, "Hz")
            .number("a2", 0.5 * (modulation.shape + 1.0), "-")
            .number("a3", 0.5 * modulation.rate, "1/s")
            .remark(format!("seed {seed}"));
        let warnings = modulation.cut_off(grid.duration).into_iter();
        let expected = self.expected_warnings(grid, count, &modulation);
        let step = warnings.chain(expected).fold(step, StepRecord::remark);
        grid.finish(samples, step)
    }

    /// Noise of unit variance at each time: pulses `u_j` through the filter of their
    /// own time, `sum h u / sqrt(sum h^2)`.
    fn filtered_noise(&self, step: f64, count: usize, noise: &mut Noise) -> Vec<f64> {
        let mut sum = vec![0.0; count];
        let mut square = vec![0.0; count];
        let root = (1.0 - self.damping * self.damping).sqrt();
        for j in 0..count {
            let pulse = noise.normal();
            let w = self.filter_frequency(j as f64 * step, 0.5 / step);
            let turn = exponential(Complex64::new(-self.damping * w * step, root * w * step));
            // h(s) = w/root exp(-damping w s) sin(root w s), half a step after the pulse
            // so that the first sample is not zero.
            let mut state =
                exponential(Complex64::new(-self.damping * w, root * w).scale(0.5 * step));
            state *= w / root;
            let least = NEGLIGIBLE * w / root;
            for i in j..count {
                sum[i] += pulse * state.im;
                square[i] += state.im * state.im;
                state *= turn;
                if state.re.abs() + state.im.abs() < least {
                    break;
                }
            }
        }
        for (x, s) in sum.iter_mut().zip(&square) {
            *x /= s.sqrt();
        }
        sum
    }
}

/// Part of the variance of white noise through the filter of frequency `w` and damping ratio `zeta` that the
/// high-pass of corner `c` (rad/s) leaves: the integral of `|H|^2`,
/// `H = s^2/((s + c)^2 (s^2 + 2 zeta w s + w^2))`, by Newland (An Introduction to Random Vibrations, 1975,
/// appendix 1, n = 4), over that without it, `pi/(2 zeta w^3)`.
fn part_above(c: f64, w: f64, zeta: f64) -> f64 {
    // In units of the frequency of the filter.
    let c = c / w;
    let [a0, a1, a2, a3] = [
        c * c,
        2.0 * c * (1.0 + zeta * c),
        1.0 + 4.0 * zeta * c + c * c,
        2.0 * (zeta + c),
    ];
    2.0 * zeta * a1 / (a1 * a2 * a3 - a0 * a3 * a3 - a1 * a1)
}

/// The acceleration z'' of `z'' + 2 w z' + w^2 z = x` from rest, exact for an input
/// that is linear between samples.
fn high_pass(input: &[f64], step: f64, w: f64) -> Vec<f64> {
    let decay = libm::exp(-w * step);
    let (mut z, mut v) = (0.0, 0.0);
    let mut output = vec![input[0]];
    for x in input.windows(2) {
        let slope = (x[1] - x[0]) / step / (w * w);
        let start = x[0] / (w * w) - 2.0 * slope / w;
        let c1 = z - start;
        let c2 = v - slope + w * c1;
        let free = (c1 + c2 * step) * decay;
        z = free + start + slope * step;
        v = c2 * decay - w * free + slope;
        output.push(x[1] - 2.0 * w * v - w * w * z);
    }
    output
}
