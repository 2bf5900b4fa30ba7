//! Spectra of two horizontal components over all directions.

use std::f64::consts::TAU;

use serde::Serialize;

use crate::accelerogram::{Accelerogram, Peak};
use crate::components::{Together, at_right_angles, together};
use crate::error::GroundMotionError;
use crate::spectra::oscillator::{Oscillator, State};
use crate::spectra::{Evaluation, response};

/// Directions: each degree of half a turn.
const DIRECTIONS: usize = 180;

/// Spectra of two components over all directions: Boore (2010), Bull. Seism. Soc. Am.
/// 100 (4) 1830.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RotatedSpectrum {
    /// Damping ratio (-).
    pub damping: f64,
    /// Periods (s).
    pub periods: Vec<f64>,
    /// Median pseudo-acceleration (m/s2) over directions, RotD50.
    pub median: Vec<f64>,
    /// Maximum pseudo-acceleration (m/s2) over directions, RotD100.
    pub maximum: Vec<f64>,
    /// Direction of the maximum, degrees from the first component towards the second.
    pub direction_of_maximum: Vec<f64>,
    /// What the user should know.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
}

/// States of both components at all samples.
struct Pair<'a> {
    oscillator: Oscillator,
    time_step: f64,
    ground: [&'a [f64]; 2],
    states: [Vec<State>; 2],
}

/// RotD50 and RotD100 for periods (s; zero is the ground itself) and a damping ratio:
/// at each degree from 0 to 179 the peak of `a1 cos + a2 sin`. The median of the 180
/// is the mean of the two in the middle. The shorter component is continued with zeros, with a
/// warning: the maximum is never less than that of either component alone.
///
/// # Errors
/// Components of different time steps, or whose names say directions that are not horizontal or
/// not at right angles, one that still moves strongly where the other has ended, a damping ratio
/// outside [0, 1), or a period that is negative or below a thousandth of the time step.
pub fn rotated_spectrum(
    first: &Accelerogram,
    second: &Accelerogram,
    periods: &[f64],
    damping: f64,
    evaluation: Evaluation,
) -> Result<RotatedSpectrum, GroundMotionError> {
    at_right_angles(first, second)?;
    let Together { samples, warnings } = together(first, second)?;
    let step = first.time_step();
    response::check(periods, damping, step)?;
    let ground = [&*samples[0], &*samples[1]];
    let mut spectrum = RotatedSpectrum {
        damping,
        periods: periods.to_vec(),
        median: Vec::new(),
        maximum: Vec::new(),
        direction_of_maximum: Vec::new(),
        warnings,
    };
    for &period in periods {
        let mut peaks = if period == 0.0 {
            let pairs = ground[0].iter().zip(ground[1]);
            let points: Vec<[f64; 2]> = pairs.map(|(a, b)| [*a, *b]).collect();
            all_directions(|cosine, sine| support(&points, cosine, sine))
        } else {
            let frequency = TAU / period;
            let pair = Pair::new(Oscillator::new(period, damping, step), step, ground);
            let mut peaks = pair.peaks(evaluation);
            for p in &mut peaks {
                *p *= frequency * frequency;
            }
            peaks
        };
        let (mut best, mut most) = (0, 0.0);
        for (i, p) in peaks.iter().enumerate() {
            if *p > most {
                (best, most) = (i, *p);
            }
        }
        spectrum.maximum.push(most);
        spectrum
            .direction_of_maximum
            .push(best as f64 * 180.0 / DIRECTIONS as f64);
        peaks.sort_by(f64::total_cmp);
        let middle = DIRECTIONS / 2;
        spectrum
            .median
            .push(0.5 * (peaks[middle - 1] + peaks[middle]));
    }
    Ok(spectrum)
}

fn all_directions(peak: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    (0..DIRECTIONS)
        .map(|i| {
            let (sine, cosine) = libm::sincos(i as f64 * (TAU / 2.0) / DIRECTIONS as f64);
            peak(cosine, sine)
        })
        .collect()
}

fn support(points: &[[f64; 2]], cosine: f64, sine: f64) -> f64 {
    points
        .iter()
        .fold(0.0, |m: f64, p| m.max((p[0] * cosine + p[1] * sine).abs()))
}

impl<'a> Pair<'a> {
    fn new(oscillator: Oscillator, time_step: f64, ground: [&'a [f64]; 2]) -> Self {
        let states = ground.map(|a| {
            let mut state = State::default();
            let mut states = vec![state];
            for pair in a.windows(2) {
                state = oscillator.advance(state, -pair[0], -pair[1]);
                states.push(state);
            }
            states
        });
        Self {
            oscillator,
            time_step,
            ground,
            states,
        }
    }

    /// Peak displacements (m) in all directions.
    fn peaks(&self, evaluation: Evaluation) -> Vec<f64> {
        let points: Vec<[f64; 2]> = self.states[0]
            .iter()
            .zip(&self.states[1])
            .map(|(a, b)| [a.displacement, b.displacement])
            .collect();
        // Only points beyond the least peak of any direction can be a peak.
        let coarse = all_directions(|c, s| support(&points, c, s));
        if evaluation == Evaluation::AtSamples {
            return coarse;
        }
        let least = coarse.iter().copied().fold(f64::INFINITY, f64::min);
        let steps = self.steps_beyond(least, &points);
        (0..DIRECTIONS)
            .map(|i| {
                let (sine, cosine) = libm::sincos(i as f64 * (TAU / 2.0) / DIRECTIONS as f64);
                let mut peak = Peak {
                    value: coarse[i],
                    time: 0.0,
                };
                for &k in &steps {
                    let states = [k, k + 1].map(|j| self.state(j, cosine, sine));
                    let forces = [k, k + 1]
                        .map(|j| -(self.ground[0][j] * cosine + self.ground[1][j] * sine));
                    let start = k as f64 * self.time_step;
                    self.oscillator
                        .raise_displacement(&mut peak, start, states, forces);
                }
                peak.value
            })
            .collect()
    }

    /// Steps in which the displacement can be further out than `least`.
    fn steps_beyond(&self, least: f64, points: &[[f64; 2]]) -> Vec<usize> {
        let h = self.time_step;
        let radius = |k: usize| libm::hypot(points[k][0], points[k][1]);
        let curvature = |k: usize| {
            let of = |c: usize| {
                let forces = [-self.ground[c][k], -self.ground[c][k + 1]];
                let curvature = self
                    .oscillator
                    .curvature(self.states[c][k], forces[0], forces[1]);
                libm::hypot(curvature.re, curvature.im)
            };
            libm::hypot(of(0), of(1))
        };
        (0..points.len() - 1)
            .filter(|&k| radius(k).max(radius(k + 1)) + h * h / 8.0 * curvature(k) > least)
            .collect()
    }

    fn state(&self, index: usize, cosine: f64, sine: f64) -> State {
        let (a, b) = (self.states[0][index], self.states[1][index]);
        State {
            displacement: a.displacement * cosine + b.displacement * sine,
            velocity: a.velocity * cosine + b.velocity * sine,
        }
    }
}
