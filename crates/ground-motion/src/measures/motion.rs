//! Velocity and displacement of the ground.

use serde::Serialize;

use crate::accelerogram::{Accelerogram, Peak};
use crate::spectra::{Evaluation, zero};

/// Acceleration, velocity and displacement at the samples: the exact integrals of an
/// acceleration that is linear between them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GroundMotion {
    /// Time step (s).
    pub time_step: f64,
    /// m/s2.
    pub acceleration: Vec<f64>,
    /// m/s.
    pub velocity: Vec<f64>,
    /// m.
    pub displacement: Vec<f64>,
}

impl GroundMotion {
    /// Integrates a record from a velocity (m/s) and a displacement (m) at its first
    /// sample.
    #[must_use]
    pub fn of(record: &Accelerogram, initial_velocity: f64, initial_displacement: f64) -> Self {
        let samples = record.samples();
        let (velocity, displacement) = integrate(
            samples,
            record.time_step(),
            initial_velocity,
            initial_displacement,
        );
        Self {
            time_step: record.time_step(),
            acceleration: samples.to_vec(),
            velocity,
            displacement,
        }
    }

    /// Velocity at the last sample (m/s).
    #[must_use]
    pub fn end_velocity(&self) -> f64 {
        self.velocity.last().copied().unwrap_or(0.0)
    }

    /// Displacement at the last sample (m).
    #[must_use]
    pub fn end_displacement(&self) -> f64 {
        self.displacement.last().copied().unwrap_or(0.0)
    }

    /// Peak velocity (m/s) and its time (s).
    #[must_use]
    pub fn peak_velocity(&self, evaluation: Evaluation) -> Peak {
        let mut peak = at_samples(&self.velocity, self.time_step);
        if evaluation == Evaluation::AtSamples {
            return peak;
        }
        let h = self.time_step;
        for (i, a) in self.acceleration.windows(2).enumerate() {
            if a[0] * a[1] < 0.0 {
                let time = h * a[0] / (a[0] - a[1]);
                raise(
                    &mut peak,
                    self.velocity[i] + 0.5 * a[0] * time,
                    i as f64 * h + time,
                );
            }
        }
        peak
    }

    /// Peak displacement (m) and its time (s).
    #[must_use]
    pub fn peak_displacement(&self, evaluation: Evaluation) -> Peak {
        let mut peak = at_samples(&self.displacement, self.time_step);
        if evaluation == Evaluation::AtSamples {
            return peak;
        }
        let h = self.time_step;
        for i in 0..self.acceleration.len() - 1 {
            let (a, slope) = (
                self.acceleration[i],
                (self.acceleration[i + 1] - self.acceleration[i]) / h,
            );
            let velocity = |t: f64| self.velocity[i] + t * (a + 0.5 * slope * t);
            // The velocity is monotonic to both sides of where the acceleration is 0.
            let turn = if a * self.acceleration[i + 1] < 0.0 {
                -a / slope
            } else {
                h
            };
            for (from, to) in [(0.0, turn), (turn, h)] {
                let (v0, v1) = (velocity(from), velocity(to));
                if v0 * v1 < 0.0 {
                    let time = zero(from, to, v0, v1, 1.0e-12 * h, velocity);
                    let value = self.displacement[i]
                        + time * (self.velocity[i] + time * (a / 2.0 + slope * time / 6.0));
                    raise(&mut peak, value, i as f64 * h + time);
                }
            }
        }
        peak
    }

    /// `int v^2 dt` (m2/s).
    pub(crate) fn specific_energy_density(&self, evaluation: Evaluation) -> f64 {
        let h = self.time_step;
        let mut sum = 0.0;
        for (i, v) in self.velocity.windows(2).enumerate() {
            sum += match evaluation {
                Evaluation::AtSamples => 0.5 * h * (v[0] * v[0] + v[1] * v[1]),
                Evaluation::PiecewiseLinear => {
                    let (a0, a1) = (self.acceleration[i], self.acceleration[i + 1]);
                    square_of_parabola(v[0], a0 * h, 0.5 * (a1 - a0) * h) * h
                }
            };
        }
        sum
    }
}

/// `int_0^1 (c + b x + a x^2)^2 dx`.
fn square_of_parabola(c: f64, b: f64, a: f64) -> f64 {
    c * c + c * b + (b * b + 2.0 * a * c) / 3.0 + a * b / 2.0 + a * a / 5.0
}

/// Velocity and displacement at the samples of an acceleration that is linear between
/// them.
pub(crate) fn integrate(
    acceleration: &[f64],
    h: f64,
    initial_velocity: f64,
    initial_displacement: f64,
) -> (Vec<f64>, Vec<f64>) {
    let (mut v, mut d) = (initial_velocity, initial_displacement);
    let mut velocity = vec![v];
    let mut displacement = vec![d];
    for a in acceleration.windows(2) {
        d += h * v + h * h * (2.0 * a[0] + a[1]) / 6.0;
        v += 0.5 * h * (a[0] + a[1]);
        velocity.push(v);
        displacement.push(d);
    }
    (velocity, displacement)
}

fn at_samples(values: &[f64], h: f64) -> Peak {
    let mut peak = Peak::default();
    for (i, v) in values.iter().enumerate() {
        raise(&mut peak, *v, i as f64 * h);
    }
    peak
}

fn raise(peak: &mut Peak, value: f64, time: f64) {
    if value.abs() > peak.value {
        *peak = Peak {
            value: value.abs(),
            time,
        };
    }
}
