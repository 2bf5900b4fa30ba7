//! The exact response of a linear oscillator to an acceleration that is linear
//! between samples.
//!
//! Nigam, N. C. and Jennings, P. C. (1969), Bull. Seism. Soc. Am. 59 (2) 909: state
//! transition over a time step. Its coefficients are written here with the functions
//! `phi_1(z) = (e^z - 1)/z` and `phi_2(z) = (e^z - 1 - z)/z^2` of `z = lambda t`,
//! `lambda = -zeta w + i w sqrt(1 - zeta^2)`, which keep all digits where the step is
//! a small part of the period; the printed coefficients of the paper lose them.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use crate::accelerogram::Peak;
use crate::spectra::Evaluation;

/// Below this modulus `phi` is summed as a series.
const SERIES_BELOW: f64 = 1.0;
/// Terms of the series: 1/22! is below rounding.
const TERMS: usize = 20;
/// Part of a step to which the time of a peak is found: the peak's error is the
/// square of it.
const TIME_TOLERANCE: f64 = 1.0e-9;
/// What round-off may add to a bound.
const ROUNDING: f64 = 1.0 + 1.0e-9;

/// `u' = a u + b v + c p0 + d p1`, `v' = a1 u + b1 v + c1 p0 + d1 p1`.
#[derive(Debug, Clone, Copy)]
struct Transition {
    displacement: [f64; 4],
    velocity: [f64; 4],
}

/// An oscillator of unit mass under the force `p = -a_ground`.
#[derive(Debug, Clone)]
pub(crate) struct Oscillator {
    frequency: f64,
    damping: f64,
    damped_frequency: f64,
    eigenvalue: Complex64,
    time_step: f64,
    step: Transition,
    /// `e^(lambda t)` of a step.
    growth: Complex64,
}

/// Displacement and velocity relative to the ground.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct State {
    /// m.
    pub displacement: f64,
    /// m/s.
    pub velocity: f64,
}

/// Peaks of one oscillator.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct OscillatorPeaks {
    /// Relative displacement (m).
    pub displacement: Peak,
    /// Relative velocity (m/s).
    pub velocity: Peak,
    /// Absolute acceleration (m/s2).
    pub acceleration: Peak,
}

/// `exp(z)`, the same on every machine.
pub(crate) fn exponential(z: Complex64) -> Complex64 {
    let (sine, cosine) = libm::sincos(z.im);
    Complex64::new(cosine, sine).scale(libm::exp(z.re))
}

/// `phi_1` and `phi_2`.
fn phi(z: Complex64) -> (Complex64, Complex64) {
    if libm::hypot(z.re, z.im) >= SERIES_BELOW {
        let first = (exponential(z) - 1.0) / z;
        return (first, (first - 1.0) / z);
    }
    let mut second = Complex64::new(0.0, 0.0);
    // Horner: phi_2 = 1/2 (1 + z/3 (1 + z/4 (...))).
    for k in (3..TERMS + 3).rev() {
        second = (second + 1.0) * z / k as f64;
    }
    second = (second + 1.0) / 2.0;
    (second * z + 1.0, second)
}

/// What one quantity does within a step: its second derivative is
/// `Re(curvature e^(lambda t))`, and what is left beside such a swing goes straight between two
/// values.
struct Quantity {
    curvature: Complex64,
    straight: [f64; 2],
    value: fn(&Oscillator, State, f64) -> f64,
    rate: fn(&Oscillator, State, f64) -> f64,
}

impl Oscillator {
    /// An oscillator of period (s) above zero and damping ratio in [0, 1), stepped by
    /// `time_step` (s).
    pub(crate) fn new(period: f64, damping: f64, time_step: f64) -> Self {
        let frequency = TAU / period;
        let damped_frequency = frequency * (1.0 - damping * damping).sqrt();
        let mut oscillator = Self {
            frequency,
            damping,
            damped_frequency,
            eigenvalue: Complex64::new(-damping * frequency, damped_frequency),
            time_step,
            step: Transition {
                displacement: [0.0; 4],
                velocity: [0.0; 4],
            },
            growth: Complex64::new(1.0, 0.0),
        };
        oscillator.step = oscillator.transition(time_step);
        oscillator.growth = exponential(oscillator.eigenvalue * time_step);
        oscillator
    }

    fn transition(&self, time: f64) -> Transition {
        let z = self.eigenvalue * time;
        let growth = exponential(z);
        let (first, second) = phi(z);
        let decay = self.damping * self.frequency;
        let impulse = growth.im / self.damped_frequency;
        let ramp = time * second.im / self.damped_frequency;
        let ramp_rate = first.im / self.damped_frequency;
        let constant = time * first.im / self.damped_frequency;
        Transition {
            displacement: [growth.re + decay * impulse, impulse, constant - ramp, ramp],
            velocity: [
                -self.frequency * self.frequency * impulse,
                growth.re - decay * impulse,
                impulse - ramp_rate,
                ramp_rate,
            ],
        }
    }

    /// The state a step later, the force going from `p0` to `p1` (m/s2).
    pub(crate) fn advance(&self, state: State, p0: f64, p1: f64) -> State {
        self.step.apply(state, p0, p1)
    }

    /// The state at a time (s) within a step.
    pub(crate) fn within_step(&self, state: State, p0: f64, p1: f64, time: f64) -> State {
        let force = p0 + (p1 - p0) * time / self.time_step;
        self.transition(time).apply(state, p0, force)
    }

    /// Absolute acceleration (m/s2) with its sign turned: `w^2 u + 2 zeta w v`.
    fn absolute_acceleration(&self, state: State) -> f64 {
        self.frequency * (self.frequency * state.displacement + 2.0 * self.damping * state.velocity)
    }

    fn relative_acceleration(&self, state: State, force: f64) -> f64 {
        force - self.absolute_acceleration(state)
    }

    /// `E` of `u'' = Re(E e^(lambda t))` within a step: from the acceleration and the
    /// jerk at its start.
    pub(crate) fn curvature(&self, state: State, p0: f64, p1: f64) -> Complex64 {
        let decay = self.damping * self.frequency;
        let acceleration = self.relative_acceleration(state, p0);
        let jerk = (p1 - p0) / self.time_step
            - 2.0 * decay * acceleration
            - self.frequency * self.frequency * state.velocity;
        Complex64::new(
            acceleration,
            -(jerk + decay * acceleration) / self.damped_frequency,
        )
    }

    /// The displacement (m) without the swing at both ends of a step: `p/w^2 - 2 zeta p'/w^3`.
    fn straight_displacement(&self, forces: [f64; 2]) -> [f64; 2] {
        let rate = (forces[1] - forces[0]) / self.time_step;
        let behind = 2.0 * self.damping * rate / self.frequency;
        forces.map(|p| (p - behind) / self.frequency.powi(2))
    }

    /// Raises a displacement peak by what happens within the step that starts in
    /// `state` at `start` (s) and ends in `end`.
    pub(crate) fn raise_displacement(
        &self,
        peak: &mut Peak,
        start: f64,
        states: [State; 2],
        forces: [f64; 2],
    ) {
        let quantity = Quantity {
            curvature: self.curvature(states[0], forces[0], forces[1]),
            straight: self.straight_displacement(forces),
            value: |_, s, _| s.displacement,
            rate: |_, s, _| s.velocity,
        };
        self.raise(peak, start, states, forces, &quantity);
    }

    /// The largest that `|Re(curvature e^(lambda t))|` may be within a step: `|curvature|`, the amplitude, or where a step
    /// is a small part of a period what it is at both ends, and what it may be above its chord.
    fn most_within(&self, curvature: Complex64, amplitude: f64) -> f64 {
        let at_ends = curvature.re.abs().max((curvature * self.growth).re.abs());
        let above = (self.time_step * self.frequency).powi(2) / 8.0 * amplitude;
        amplitude.min(at_ends + above)
    }

    /// Whether a quantity may exceed its peak within a step. A function is at most `h^2/8 |f''|` above its
    /// chord, and at most `h^4/384 |f''''|` above the cubic that has its values and rates at both ends: of a
    /// steady motion the peaks of all steps are alike, and the first bound would exclude none.
    fn may_reach(
        &self,
        peak: &Peak,
        states: [State; 2],
        forces: [f64; 2],
        quantity: &Quantity,
    ) -> bool {
        let h = self.time_step;
        let values = [0, 1].map(|i| (quantity.value)(self, states[i], forces[i]));
        let end = values[0].abs().max(values[1].abs());
        let amplitude = quantity.curvature.norm_sqr().sqrt();
        if !(end + h * h / 8.0 * amplitude > peak.value) {
            return false;
        }
        let rates = [0, 1].map(|i| h * (quantity.rate)(self, states[i], forces[i]));
        let fourth = quantity.curvature * self.eigenvalue * self.eigenvalue;
        let above = self.most_within(fourth, amplitude * self.frequency.powi(2));
        let most = most_of_cubic(values, rates) + h.powi(4) / 384.0 * above;
        most * ROUNDING > peak.value
    }

    fn raise(
        &self,
        peak: &mut Peak,
        start: f64,
        states: [State; 2],
        forces: [f64; 2],
        quantity: &Quantity,
    ) {
        if !self.may_reach(peak, states, forces, quantity) {
            return;
        }
        let amplitude = quantity.curvature.norm_sqr().sqrt();
        let h = self.time_step;
        // A step of many half cycles would take an evaluation and more for each: those in which
        // the straight part and the swing together do not reach the peak are passed over.
        let apart = PI / self.damped_frequency;
        let decay = self.damping * self.frequency;
        let swing = amplitude / self.frequency.powi(2);
        let straight = |time: f64| {
            let [from, to] = quantity.straight;
            (from + (to - from) * time / h).abs()
        };
        let reaches =
            |peak: &Peak, straight: f64, swing: f64| (straight + swing) * ROUNDING > peak.value;
        if h > apart && !reaches(peak, straight(0.0).max(straight(h)), swing) {
            return;
        }
        let at = |time: f64| {
            let force = forces[0] + (forces[1] - forces[0]) * time / h;
            let state = self.transition(time).apply(states[0], forces[0], force);
            (state, force)
        };
        let rate = |time: f64| {
            let (state, force) = at(time);
            (quantity.rate)(self, state, force)
        };
        // Between zeros of the second derivative the rate is monotonic.
        let first = (PI / 2.0 - libm::atan2(quantity.curvature.im, quantity.curvature.re))
            .rem_euclid(PI)
            / self.damped_frequency;
        let (mut from, mut rate_from) = (0.0, Some((quantity.rate)(self, states[0], forces[0])));
        let mut k = 0;
        while from < h {
            let to = (first + k as f64 * apart).min(h);
            k += 1;
            if h > apart {
                let left = swing * libm::exp(-decay * from);
                if !reaches(peak, straight(from).max(straight(to)), left) {
                    (from, rate_from) = (to, None);
                    continue;
                }
            }
            let rate_from_here = rate_from.unwrap_or_else(|| rate(from));
            let rate_to = rate(to);
            if rate_from_here * rate_to < 0.0 {
                let time = zero(from, to, rate_from_here, rate_to, TIME_TOLERANCE * h, rate);
                let (state, force) = at(time);
                let value = (quantity.value)(self, state, force).abs();
                if value > peak.value {
                    *peak = Peak {
                        value,
                        time: start + time,
                    };
                }
            }
            (from, rate_from) = (to, Some(rate_to));
        }
    }

    /// Peaks under a ground acceleration (m/s2) that starts with the oscillator at
    /// rest. Ends with the last sample: free vibration beyond it is not looked at.
    pub(crate) fn peaks(&self, ground: &[f64], evaluation: Evaluation) -> OscillatorPeaks {
        let [peaks] = peaks_of([self], ground, evaluation);
        peaks
    }

    /// Whether peaks may lie higher between two states than at them: known peaks at samples leave
    /// few steps to look into.
    fn may_rise(&self, peaks: &OscillatorPeaks, states: [State; 2], forces: [f64; 2]) -> bool {
        // The second derivatives are w^0, w^1 and w^2 times this at most.
        let amplitude = self
            .curvature(states[0], forces[0], forces[1])
            .norm_sqr()
            .sqrt();
        let rise = self.time_step * self.time_step / 8.0 * amplitude;
        let most = |of: fn(&Self, State) -> f64| {
            let [from, to] = states.map(|state| of(self, state).abs());
            from.max(to)
        };
        let w = self.frequency;
        most(|_, state| state.displacement) + rise > peaks.displacement.value
            || most(|_, state| state.velocity) + w * rise > peaks.velocity.value
            || most(Self::absolute_acceleration) + w * w * rise > peaks.acceleration.value
    }

    /// Displacement, velocity and acceleration within a step.
    fn quantities(&self, states: [State; 2], forces: [f64; 2]) -> [Quantity; 3] {
        let curvature = self.curvature(states[0], forces[0], forces[1]);
        let displacement = Quantity {
            curvature,
            straight: self.straight_displacement(forces),
            value: |_, s, _| s.displacement,
            rate: |_, s, _| s.velocity,
        };
        let velocity = Quantity {
            curvature: curvature * self.eigenvalue,
            straight: [(forces[1] - forces[0]) / (self.time_step * self.frequency.powi(2)); 2],
            value: |_, s, _| s.velocity,
            rate: Self::relative_acceleration,
        };
        // lambda^2 = -w^2 - 2 zeta w lambda.
        let acceleration = Quantity {
            curvature: -curvature * self.eigenvalue * self.eigenvalue,
            straight: forces,
            value: |o, s, _| o.absolute_acceleration(s),
            rate: |o, s, p| {
                let turned = State {
                    displacement: s.velocity,
                    velocity: o.relative_acceleration(s, p),
                };
                o.absolute_acceleration(turned)
            },
        };
        [displacement, velocity, acceleration]
    }

    fn between(
        &self,
        peaks: &mut OscillatorPeaks,
        start: f64,
        states: [State; 2],
        forces: [f64; 2],
    ) {
        let [displacement, velocity, acceleration] = self.quantities(states, forces);
        self.raise(
            &mut peaks.displacement,
            start,
            states,
            forces,
            &displacement,
        );
        self.raise(&mut peaks.velocity, start, states, forces, &velocity);
        self.raise(
            &mut peaks.acceleration,
            start,
            states,
            forces,
            &acceleration,
        );
    }
}

/// Oscillators that go through samples together.
pub(crate) const TOGETHER: usize = 4;

/// Peaks of oscillators of one time step, which go through the samples together: each alone would
/// wait at every sample for its own last state.
pub(crate) fn peaks_of<const N: usize>(
    oscillators: [&Oscillator; N],
    ground: &[f64],
    evaluation: Evaluation,
) -> [OscillatorPeaks; N] {
    let time_step = oscillators.first().map_or(0.0, |o| o.time_step);
    let mut peaks = [OscillatorPeaks::default(); N];
    let mut states = [State::default(); N];
    for (i, pair) in ground.windows(2).enumerate() {
        let time = (i + 1) as f64 * time_step;
        for k in 0..N {
            states[k] = oscillators[k].advance(states[k], -pair[0], -pair[1]);
            keep(&mut peaks[k].displacement, states[k].displacement, time);
            keep(&mut peaks[k].velocity, states[k].velocity, time);
            let acceleration = oscillators[k].absolute_acceleration(states[k]);
            keep(&mut peaks[k].acceleration, acceleration, time);
        }
    }
    if evaluation == Evaluation::AtSamples {
        return peaks;
    }
    states = [State::default(); N];
    for (i, pair) in ground.windows(2).enumerate() {
        let forces = [-pair[0], -pair[1]];
        for k in 0..N {
            let next = oscillators[k].advance(states[k], forces[0], forces[1]);
            let ends = [states[k], next];
            if oscillators[k].may_rise(&peaks[k], ends, forces) {
                oscillators[k].between(&mut peaks[k], i as f64 * time_step, ends, forces);
            }
            states[k] = next;
        }
    }
    peaks
}

/// Force (m/s2) on an oscillator that goes straight from one value to another, and what its velocity (m/s) jumps by at the
/// start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Piece {
    /// s.
    pub length: f64,
    pub forces: [f64; 2],
    pub jump: f64,
}

/// Peaks of an oscillator of this period (s) and damping ratio that goes through pieces of any length from rest.
pub(crate) fn peaks_over(
    (period, damping): (f64, f64),
    pieces: impl Iterator<Item = Piece> + Clone,
) -> OscillatorPeaks {
    let usual = pieces.clone().next().map_or(1.0, |piece| piece.length);
    let usual = Oscillator::new(period, damping, usual);
    let mut peaks = OscillatorPeaks::default();
    // First the ends alone, which leaves few pieces to look into.
    for inside in [false, true] {
        let (mut state, mut time) = (State::default(), 0.0);
        let mut other = usual.clone();
        for piece in pieces.clone() {
            // Most pieces have one length.
            let oscillator = if piece.length == usual.time_step {
                &usual
            } else {
                if piece.length != other.time_step {
                    other = Oscillator::new(period, damping, piece.length);
                }
                &other
            };
            state.velocity += piece.jump;
            let [p0, p1] = piece.forces;
            let next = oscillator.advance(state, p0, p1);
            if !inside {
                for (state, time) in [(state, time), (next, time + piece.length)] {
                    keep(&mut peaks.displacement, state.displacement, time);
                    keep(&mut peaks.velocity, state.velocity, time);
                    let acceleration = oscillator.absolute_acceleration(state);
                    keep(&mut peaks.acceleration, acceleration, time);
                }
            } else if oscillator.may_rise(&peaks, [state, next], piece.forces) {
                oscillator.between(&mut peaks, time, [state, next], piece.forces);
            }
            (state, time) = (next, time + piece.length);
        }
    }
    peaks
}

impl Transition {
    fn apply(&self, state: State, p0: f64, p1: f64) -> State {
        let sum = |c: &[f64; 4]| {
            c[0] * state.displacement + c[1] * state.velocity + c[2] * p0 + c[3] * p1
        };
        State {
            displacement: sum(&self.displacement),
            velocity: sum(&self.velocity),
        }
    }
}

/// The largest magnitude that the cubic of these values and rates at 0 and 1 has between them.
fn most_of_cubic([v0, v1]: [f64; 2], [r0, r1]: [f64; 2]) -> f64 {
    let rise = v1 - v0;
    let square = 3.0 * rise - 2.0 * r0 - r1;
    let cube = r0 + r1 - 2.0 * rise;
    let ends = v0.abs().max(v1.abs());
    // Zeros of `r0 + 2 square x + 3 cube x^2`, without a difference of numbers that are nearly the same.
    let root = (square * square - 3.0 * cube * r0).sqrt();
    let sum = -(square + root.copysign(square));
    let at = |x: f64| match 0.0 < x && x < 1.0 {
        true => (v0 + x * (r0 + x * (square + x * cube))).abs(),
        false => 0.0,
    };
    ends.max(at(sum / (3.0 * cube))).max(at(r0 / sum))
}

fn keep(peak: &mut Peak, value: f64, time: f64) {
    if value.abs() > peak.value {
        *peak = Peak {
            value: value.abs(),
            time,
        };
    }
}

/// A zero of `f` between two places where its signs differ: false position with
/// halved end values (Illinois), to a tolerance in the argument.
pub(crate) fn zero(
    mut a: f64,
    mut b: f64,
    mut fa: f64,
    mut fb: f64,
    tolerance: f64,
    f: impl Fn(f64) -> f64,
) -> f64 {
    for i in 0..100 {
        // Bisection now and then: an end that never moves must not stall.
        let c = if i % 8 == 7 {
            0.5 * (a + b)
        } else {
            (a * fb - b * fa) / (fb - fa)
        };
        let fc = f(c);
        if fc == 0.0 || (b - c).abs() <= tolerance {
            return c;
        }
        if fc * fb < 0.0 {
            (a, fa) = (b, fb);
        } else {
            fa *= 0.5;
        }
        (b, fb) = (c, fc);
        if (b - a).abs() <= tolerance {
            break;
        }
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubics_by_their_ends() {
        for (values, rates) in [
            ([0.0, 0.0], [1.0, -1.0]),
            ([1.0, -1.0], [0.0, 0.0]),
            ([0.0, 1.0], [1.0, 1.0]),
            ([0.3, 0.2], [-4.0, 5.0]),
            ([0.3, 0.2], [-4.0, -5.0]),
            ([1.0, 1.0], [1.0e-9, -1.0e-9]),
            ([0.0, 0.0], [0.0, 0.0]),
        ] {
            let ([v0, v1], [r0, r1]) = (values, rates);
            let on = |x: f64| {
                let y = 1.0 - x;
                let ends = v0 * y * y * (1.0 + 2.0 * x) + v1 * x * x * (1.0 + 2.0 * y);
                ends + x * y * (r0 * y - r1 * x)
            };
            let most = (0..=1000).map(|i| on(f64::from(i) / 1000.0).abs());
            let most = most.fold(0.0, f64::max);
            let found = most_of_cubic(values, rates);
            assert!(found >= most * (1.0 - 1.0e-15), "{found} {most}");
            assert!(found <= most * (1.0 + 1.0e-5), "{found} {most}");
        }
    }

    /// No step is passed over in which a quantity exceeds what is taken for its peak, however little.
    #[test]
    fn bounds_hold_within_steps() {
        let mut state = 1_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        };
        for i in 0..20_000 {
            let damping = [0.0, 0.02, 0.05, 0.3, 0.9][i % 5];
            let period = 0.01 * libm::exp(3.5 * random() + 3.0);
            let oscillator = Oscillator::new(period, damping, 0.01);
            let forces = [random(), random()];
            let w = oscillator.frequency;
            // Near rest, as of motions whose frequency is far above that of the oscillator.
            let size = libm::exp(4.0 * random() - 4.0);
            let start = State {
                displacement: size * random() / (w * w),
                velocity: size * random() / w,
            };
            let end = oscillator.advance(start, forces[0], forces[1]);
            for quantity in oscillator.quantities([start, end], forces) {
                let inside = (0..=64).map(|k| {
                    let part = f64::from(k) / 64.0;
                    let force = forces[0] + (forces[1] - forces[0]) * part;
                    let state = oscillator.within_step(start, forces[0], forces[1], 0.01 * part);
                    (quantity.value)(&oscillator, state, force).abs()
                });
                let peak = Peak {
                    value: inside.fold(0.0, f64::max) * (1.0 - 1.0e-6),
                    time: 0.0,
                };
                let may = oscillator.may_reach(&peak, [start, end], forces, &quantity);
                assert!(may, "{period} {damping} {start:?} {forces:?}");
            }
        }
    }

    /// Of a steady motion near half the sampling rate few steps are looked into: the others cannot
    /// exceed the peaks that are known. Values between samples do not exceed what is found.
    #[test]
    fn few_steps_of_steady_motion_are_looked_into() {
        let samples = |of: &dyn Fn(f64) -> f64| (0..2000).map(|i| of(f64::from(i))).collect();
        let alternating: Vec<f64> = samples(&|i| 0.1 * libm::cos(PI * i));
        let of_40_hz: Vec<f64> = samples(&|i| libm::sin(0.8 * PI * i));
        let of_2_hz: Vec<f64> = samples(&|i| libm::sin(0.04 * PI * i));
        for ground in [alternating, of_40_hz, of_2_hz] {
            let (mut steps, mut looked_into) = (0, 0);
            for period in [0.1, 0.137, 0.3, 0.77, 1.9, 2.5, 7.3] {
                let oscillator = Oscillator::new(period, 0.05, 0.01);
                let peaks = oscillator.peaks(&ground, Evaluation::PiecewiseLinear);
                let mut state = State::default();
                for pair in ground.windows(2) {
                    let forces = [-pair[0], -pair[1]];
                    let next = oscillator.advance(state, forces[0], forces[1]);
                    let ends = [state, next];
                    let [displacement, velocity, acceleration] =
                        oscillator.quantities(ends, forces);
                    let pairs = [
                        (&peaks.displacement, displacement),
                        (&peaks.velocity, velocity),
                        (&peaks.acceleration, acceleration),
                    ];
                    steps += pairs.len();
                    for (peak, quantity) in pairs {
                        let may = oscillator.may_reach(peak, ends, forces, &quantity);
                        looked_into += usize::from(may);
                        for k in 0..=8 {
                            let part = f64::from(k) / 8.0;
                            let force = forces[0] + (forces[1] - forces[0]) * part;
                            let time = 0.01 * part;
                            let inside = oscillator.within_step(state, forces[0], forces[1], time);
                            let value = (quantity.value)(&oscillator, inside, force).abs();
                            assert!(value <= peak.value * ROUNDING, "{period}: {value}");
                        }
                    }
                    state = next;
                }
            }
            assert!(50 * looked_into < steps, "{looked_into} of {steps}");
        }
    }
}
