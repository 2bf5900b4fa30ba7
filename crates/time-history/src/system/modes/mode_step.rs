//! The exact step of one mode under a ground acceleration that is linear in time.

use crate::polynomial::GAUSS;

/// Step of `q'' + 2 zeta omega q' + omega^2 q = -gamma a_g(t)` over one interval
/// between samples. All members are linear, or for the work quadratic, in
/// `z = (q, q', a, b)`: displacement and velocity of the mode at the start, ground
/// acceleration at the start and at the end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ModeStep {
    /// Displacement at the end.
    pub displacement: [f64; 4],
    /// Velocity at the end.
    pub velocity: [f64; 4],
    /// Integral of the displacement over the step.
    pub integral: [f64; 4],
    /// Work of the damping, `2 zeta omega int q'^2 dt = sum w_ij z_i z_j` over
    /// `i <= j`, row by row.
    pub viscous: [f64; 10],
}

/// What a mode is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Oscillator {
    /// Circular frequency (rad/s).
    pub circular_frequency: f64,
    /// Damping ratio (-), of any size.
    pub damping_ratio: f64,
    /// Participation factor.
    pub participation: f64,
}

/// Maximum product of frequency and sub-step; the series then converges in about
/// twelve terms, and its terms hardly cancel.
const SUB_STEP: f64 = 0.25;
/// Sub-steps beyond which they are put together by doubling.
const MANY: f64 = 1024.0;
/// Terms of the series, enough for round-off.
const TERMS: usize = 18;

impl ModeStep {
    /// For a step of this length (s). Any damping, and any number of periods within
    /// the step: the interval is cut into sub-steps, on each of which the solution is
    /// its Taylor series to round-off.
    pub(crate) fn new(mode: Oscillator, step: f64) -> Self {
        let rate = mode.circular_frequency * (2.0 * mode.damping_ratio).max(1.0);
        let parts = (rate * step / SUB_STEP).ceil().max(1.0);
        if parts > MANY {
            return Doubling::new(mode, step, parts).finish();
        }
        let h = step / parts;
        let mut columns = [
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
        ];
        let mut viscous = [0.0; 10];
        for part in 0..parts as usize {
            let mut speeds = [[0.0; 4]; GAUSS.len()];
            for (i, column) in columns.iter_mut().enumerate() {
                let slope = [0.0, 0.0, -1.0, 1.0][i] / step;
                let ground = [0.0, 0.0, 1.0, 0.0][i] + slope * h * part as f64;
                let series = series(mode, [column[0], column[1]], (ground, slope), h);
                column[2] += series.integral() * h;
                for (node, row) in GAUSS.iter().zip(&mut speeds) {
                    row[i] = series.velocity(node.0);
                }
                column[0] = series.displacement();
                column[1] = series.velocity(1.0);
            }
            let damping = 2.0 * mode.damping_ratio * mode.circular_frequency * h;
            for ((_, weight), row) in GAUSS.iter().zip(&speeds) {
                let mut k = 0;
                for i in 0..4 {
                    for j in i..4 {
                        let both = if i == j { 1.0 } else { 2.0 };
                        viscous[k] += both * damping * weight * row[i] * row[j];
                        k += 1;
                    }
                }
            }
        }
        Self {
            displacement: columns.map(|c| c[0]),
            velocity: columns.map(|c| c[1]),
            integral: columns.map(|c| c[2]),
            viscous,
        }
    }
}

/// A step that is doubled: changes of displacement and velocity over it, so that adding up many of
/// them loses no digits, its integral and its work, in the terms of [`ModeStep`].
struct Doubling {
    times: u32,
    change: [[f64; 4]; 2],
    integral: [f64; 4],
    viscous: [[f64; 4]; 4],
}

impl Doubling {
    /// A sub-step, and how often it is to be doubled.
    fn new(mode: Oscillator, step: f64, parts: f64) -> Self {
        let times = libm::log2(parts).ceil() as u32;
        let h = step / libm::exp2(f64::from(times));
        let mut this = Self {
            times,
            change: [[0.0; 4]; 2],
            integral: [0.0; 4],
            viscous: [[0.0; 4]; 4],
        };
        let mut speeds = [[0.0; 4]; GAUSS.len()];
        for i in 0..4 {
            let start = [[1.0, 0.0], [0.0, 1.0], [0.0; 2], [0.0; 2]][i];
            let (ground, slope) = ([0.0, 0.0, 1.0, 0.0][i], [0.0, 0.0, -1.0, 1.0][i] / h);
            let series = series(mode, start, (ground, slope), h);
            let change = |terms: &[f64; TERMS]| terms[1..].iter().rev().sum();
            this.change[0][i] = change(&series.displacement);
            this.change[1][i] = change(&series.velocity);
            this.integral[i] = series.integral() * h;
            for (node, row) in GAUSS.iter().zip(&mut speeds) {
                row[i] = series.velocity(node.0);
            }
        }
        let damping = 2.0 * mode.damping_ratio * mode.circular_frequency * h;
        for ((_, weight), row) in GAUSS.iter().zip(&speeds) {
            for i in 0..4 {
                for j in 0..4 {
                    this.viscous[i][j] += damping * weight * row[i] * row[j];
                }
            }
        }
        this
    }

    /// What `(q, q', a, b)` of the whole is at the start of its halves: the ground is half way in
    /// between.
    fn halves(&self) -> [[[f64; 4]; 4]; 2] {
        let middle = [0.0, 0.0, 0.5, 0.5];
        let unit = |i: usize| std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        let first = [unit(0), unit(1), unit(2), middle];
        let then = |row: usize| {
            let change = through(&self.change[row], &first);
            std::array::from_fn(|j| unit(row)[j] + change[j])
        };
        [first, [then(0), then(1), middle, unit(3)]]
    }

    fn double(&mut self) {
        let halves = self.halves();
        let both = |row: &[f64; 4]| -> [f64; 4] {
            let [a, b] = halves.each_ref().map(|half| through(row, half));
            std::array::from_fn(|j| a[j] + b[j])
        };
        let mut viscous = [[0.0; 4]; 4];
        for half in &halves {
            let rows = self.viscous.map(|row| through(&row, half));
            for i in 0..4 {
                for j in 0..4 {
                    viscous[i][j] += (0..4).map(|k| half[k][i] * rows[k][j]).sum::<f64>();
                }
            }
        }
        (self.change, self.integral) = (self.change.each_ref().map(both), both(&self.integral));
        self.viscous = viscous;
    }

    fn finish(mut self) -> ModeStep {
        for _ in 0..self.times {
            self.double();
        }
        let [mut displacement, mut velocity] = self.change;
        displacement[0] += 1.0;
        velocity[1] += 1.0;
        let mut viscous = [0.0; 10];
        let mut k = 0;
        for i in 0..4 {
            for j in i..4 {
                viscous[k] = match i == j {
                    true => self.viscous[i][j],
                    false => self.viscous[i][j] + self.viscous[j][i],
                };
                k += 1;
            }
        }
        ModeStep {
            displacement,
            velocity,
            integral: self.integral,
            viscous,
        }
    }
}

/// A row over what another one is made of.
fn through(row: &[f64; 4], of: &[[f64; 4]; 4]) -> [f64; 4] {
    std::array::from_fn(|j| (0..4).map(|k| row[k] * of[k][j]).sum())
}

/// Terms of the Taylor series of one sub-step, for `theta` in (0, 1).
struct Series {
    displacement: [f64; TERMS],
    velocity: [f64; TERMS],
}

fn series(mode: Oscillator, start: [f64; 2], (ground, slope): (f64, f64), h: f64) -> Series {
    let (omega, zeta) = (mode.circular_frequency, mode.damping_ratio);
    let mut terms = Series {
        displacement: [0.0; TERMS],
        velocity: [0.0; TERMS],
    };
    (terms.displacement[0], terms.velocity[0]) = (start[0], start[1]);
    for k in 0..TERMS - 1 {
        let (q, p) = (terms.displacement[k], terms.velocity[k]);
        let load = match k {
            0 => ground,
            1 => slope * h,
            _ => 0.0,
        };
        let scale = h / (k + 1) as f64;
        terms.displacement[k + 1] = scale * p;
        terms.velocity[k + 1] =
            scale * (-2.0 * zeta * omega * p - omega * omega * q - mode.participation * load);
    }
    terms
}

impl Series {
    fn displacement(&self) -> f64 {
        self.displacement.iter().rev().sum()
    }
    fn velocity(&self, theta: f64) -> f64 {
        let terms = self.velocity.iter().rev();
        terms.fold(0.0, |sum, c| sum * theta + c)
    }
    /// Integral of the displacement over theta.
    fn integral(&self) -> f64 {
        let terms = self.displacement.iter().enumerate().rev();
        terms.map(|(k, c)| c / (k + 1) as f64).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Closed forms of the damped oscillator, under-, critically and overdamped, under
    /// a ground acceleration that rises from `a` to `b` (Chopra, Dynamics of
    /// Structures, section 5.2, for the underdamped one).
    #[test]
    fn agrees_with_closed_forms() {
        for (omega, zeta) in [
            (3.0, 0.05),
            (60.0, 0.2),
            (400.0, 0.01),
            (90.0, 1.0),
            (500.0, 4.0),
            // By doubling.
            (2.0e4, 0.02),
            (5.0e3, 20.0),
            (2.6e4, 100.0),
            (2.6e5, 1000.0),
        ] {
            let (step, gamma) = (0.02_f64, 1.7_f64);
            let mode = Oscillator {
                circular_frequency: omega,
                damping_ratio: zeta,
                participation: gamma,
            };
            let computed = ModeStep::new(mode, step);
            let (q0, p0, a, b) = (0.02, -0.3, 1.1, -0.4);
            // Particular solution c0 + c1 t, and the homogeneous rest.
            let slope = (b - a) / step;
            let c1 = -gamma * slope / (omega * omega);
            let c0 = (-gamma * a - 2.0 * zeta * omega * c1) / (omega * omega);
            let (x, v) = (q0 - c0, p0 - c1);
            let decay = libm::exp(-zeta * omega * step);
            let homogeneous = match zeta {
                z if z < 1.0 => {
                    let wd = omega * (1.0 - z * z).sqrt();
                    let s = (v + z * omega * x) / wd;
                    decay * (x * libm::cos(wd * step) + s * libm::sin(wd * step))
                }
                1.0 => decay * (x + (v + omega * x) * step),
                z => {
                    let wd = omega * (z * z - 1.0).sqrt();
                    let (up, down) = (-omega * omega / (z * omega + wd), -z * omega - wd);
                    let first = (v - down * x) / (up - down);
                    first * libm::exp(up * step) + (x - first) * libm::exp(down * step)
                }
            };
            let expected = homogeneous + c0 + c1 * step;
            let z = [q0, p0, a, b];
            let dot = |w: &[f64; 4]| w.iter().zip(z).map(|(w, z)| w * z).sum::<f64>();
            let error = (dot(&computed.displacement) - expected).abs();
            assert!(error < 1e-14, "{omega} {zeta}: {error:e}");
            // The balance of energy ties velocity, integral and work together.
            let (q1, p1) = (dot(&computed.displacement), dot(&computed.velocity));
            let stored = |q: f64, p: f64| 0.5 * p * p + 0.5 * omega * omega * q * q;
            let input = -gamma * (q1 * b - q0 * a - slope * dot(&computed.integral));
            let mut work = 0.0;
            let mut k = 0;
            for i in 0..4 {
                for j in i..4 {
                    work += computed.viscous[k] * z[i] * z[j];
                    k += 1;
                }
            }
            let residual = stored(q1, p1) - stored(q0, p0) + work - input;
            let scale = stored(q0, p0) + stored(q1, p1) + input.abs();
            assert!(
                residual.abs() < 1e-13 * scale,
                "{omega} {zeta}: {residual:e}"
            );
        }
    }
}
