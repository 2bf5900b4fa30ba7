//! What several tests share: smooth paths and an explicit, event-located driver.
#![allow(dead_code)]
use pounding_hysteresis::{Guard, History, HysteresisLaw, LawDescriptor, Motion, build};
use pounding_runge_kutta::Dop853;

/// The example of a descriptor.
pub fn example(descriptor: &LawDescriptor) -> Box<dyn HysteresisLaw> {
    build(descriptor.name, &descriptor.example_parameters()).unwrap()
}

/// A smooth path with cycles inside cycles, growing at first: its amplitude is
/// about 1.
pub fn path(time: f64) -> (f64, f64) {
    let terms = [(0.62, 1.0, 0.0), (0.33, 3.1, 0.4), (0.19, 7.7, 1.3)];
    let (mut position, mut speed) = (0.0, 0.0);
    for (size, rate, phase) in terms {
        let angle: f64 = rate * time + phase;
        position += size * (angle.sin() - f64::sin(phase));
        speed += size * rate * angle.cos();
    }
    let growth = 1.0 - (-0.3 * time).exp();
    let growth_rate = 0.3 * (-0.3 * time).exp();
    (growth * position, growth * speed + growth_rate * position)
}

/// Times on `[0, end]` about `step` apart that contain every turning point of
/// [`path`], located to rounding.
pub fn times(end: f64, step: f64) -> Vec<f64> {
    let count = (end / step).round() as usize;
    let mut times = vec![0.0];
    for i in 0..count {
        let (mut low, mut high) = (
            end * i as f64 / count as f64,
            end * (i + 1) as f64 / count as f64,
        );
        let after = high;
        if path(low).1 * path(high).1 < 0.0 {
            let sign = path(low).1.signum();
            while high - low > 1e-15 * high {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if path(middle).1 * sign > 0.0 {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            times.push(high);
        }
        times.push(after);
    }
    times
}

/// The motion at a time of the path, with this amplitude.
pub fn motion(amplitude: f64, time: f64) -> Motion {
    let (position, speed) = path(time);
    Motion {
        deformation: amplitude * position,
        velocity: amplitude * speed,
    }
}

/// Drives a law explicitly along a path: the branch is held within a step, internal
/// variables and the work go by a method of order 8, guards are located by bisection.
pub struct Explicit<'a> {
    pub law: &'a dyn HysteresisLaw,
    pub amplitude: f64,
    pub history: History,
    pub time: f64,
    pub variables: Vec<f64>,
    pub passed: usize,
    /// Work of the force.
    pub work: f64,
}

impl<'a> Explicit<'a> {
    pub fn new(law: &'a dyn HysteresisLaw, amplitude: f64) -> Self {
        let history = law.virgin();
        let variables = history.variables().to_vec();
        assert_eq!(variables.len(), law.internal_variables());
        let mut driver = Self {
            law,
            amplitude,
            history,
            time: 0.0,
            variables,
            passed: 0,
            work: 0.0,
        };
        driver.pass_all(0.0);
        driver
    }

    fn motion(&self, time: f64) -> Motion {
        motion(self.amplitude, time)
    }

    /// Internal variables and work after a step from the present time.
    fn trial(&self, to: f64) -> (Vec<f64>, f64) {
        let n = self.variables.len();
        let mut start = self.variables.clone();
        start.push(self.work);
        let mut end = vec![0.0; n + 1];
        let mut slope = |offset: f64, state: &[f64], out: &mut [f64]| {
            let motion = self.motion(self.time + offset);
            let held = &self.history;
            self.law.rates(held, motion, &state[..n], &mut out[..n]);
            out[n] = self.law.force(held, motion, &state[..n]).force * motion.velocity;
        };
        Dop853::new(n + 1).step(&mut slope, &start, to - self.time, &mut end);
        let work = end.pop().unwrap();
        (end, work)
    }

    fn fired(&self, time: f64, variables: &[f64]) -> Option<Guard> {
        let motion = self.motion(time);
        let mut guards = self.law.guards(&self.history).into_iter().flatten();
        guards.find(|g| self.law.guard(&self.history, *g, motion, variables) > 0.0)
    }

    fn pass_all(&mut self, time: f64) {
        let motion = self.motion(time);
        for _ in 0..100 {
            let Some(guard) = self.fired(time, &self.variables) else {
                return;
            };
            let variables = self.variables.clone();
            self.law.pass(&mut self.history, guard, motion, &variables);
            self.passed += 1;
        }
        panic!("{}: guards without end", self.law.descriptor().name);
    }

    /// Advances to a time, through all guards on the way.
    pub fn advance(&mut self, to: f64) {
        while self.time < to {
            let after = self.trial(to);
            if self.fired(to, &after.0).is_none() {
                self.accept(to, after);
                return;
            }
            let (mut low, mut high) = (self.time, to);
            loop {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if self.fired(middle, &self.trial(middle).0).is_some() {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            let after = self.trial(high);
            self.accept(high, after);
            self.pass_all(high);
        }
    }

    fn accept(&mut self, time: f64, (variables, work): (Vec<f64>, f64)) {
        self.work = work;
        self.time = time;
        self.variables = variables;
        let motion = self.motion(time);
        self.law.accept(&mut self.history, motion, &self.variables);
    }

    pub fn force(&self) -> f64 {
        let motion = self.motion(self.time);
        self.law.force(&self.history, motion, &self.variables).force
    }

    pub fn energies(&self) -> (f64, f64) {
        let motion = self.motion(self.time);
        (
            self.law
                .stored_energy(&self.history, motion, &self.variables),
            self.law
                .dissipated_energy(&self.history, motion, &self.variables),
        )
    }
}
