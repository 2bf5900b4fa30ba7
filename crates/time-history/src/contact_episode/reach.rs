//! Ending a step of the pair at an event.

use super::clock::Clock;
use super::pair::{Pair, Scene};
use super::search::event_guard;
use crate::contact::Contacts;
use crate::events::EventKind;
use crate::system::modes::{Lane, WIDTH, total};

/// An event this close to the end of a trial step, as a part of it, needs no other one:
/// the state is moved there by its own derivatives.
pub(crate) const NEAR: f64 = 2.0e-3;
/// Trials at most.
const TRIALS: u64 = 6;
/// Corrections of a root at most.
const CORRECTIONS: usize = 16;

impl Pair {
    /// Ends the present step at an event that is expected `time` (s) after its start, and
    /// comes at `limit` (s) at the latest.
    /// Returns when it was reached (s from the start), and how many trial steps it took.
    pub(crate) fn reach(
        &mut self,
        scene: &Scene<'_>,
        contacts: &Contacts,
        (level, kind): (usize, EventKind),
        clock: &mut Clock,
        (time, limit): (f64, f64),
    ) -> (f64, u64) {
        let whole = clock.offset(1.0);
        let (mut wanted, mut trials) = (time, 0);
        loop {
            if (wanted - clock.offset(1.0)).abs() > NEAR * whole && trials < TRIALS {
                *clock = clock.until(wanted);
                self.step(scene, clock);
                self.derive_end(scene, clock.offset(1.0));
                trials += 1;
            }
            let now = clock.offset(1.0);
            let shift = self.time_to_root(scene, contacts, (level, kind));
            wanted = (now + shift).clamp(0.1 * now, limit);
            if (wanted - now).abs() > NEAR * whole {
                if trials < TRIALS {
                    continue;
                }
                // Derivatives do not reach that far: the last trial is the place.
                wanted = now;
            }
            self.shift_end(scene, clock, wanted - now);
            return (wanted, trials);
        }
    }

    /// Accelerations and jerks at the start of a step.
    pub(crate) fn derive_start(&mut self, scene: &Scene<'_>) {
        let system = (scene.system, scene.touches);
        let (constants, rows) = (scene.constants, scene.rows);
        self.start.derive(constants, rows, system, scene.ground);
    }

    /// Accelerations and jerks at the end of a step, `offset` (s) after its start.
    pub(crate) fn derive_end(&mut self, scene: &Scene<'_>, offset: f64) {
        let ground = (scene.ground.0 + scene.ground.1 * offset, scene.ground.1);
        let system = (scene.system, scene.touches);
        self.end.derive(scene.constants, scene.rows, system, ground);
    }

    /// Time (s) from the end of the step to the root of an event's guard, by the
    /// derivatives there.
    fn time_to_root(
        &self,
        scene: &Scene<'_>,
        contacts: &Contacts,
        (level, kind): (usize, EventKind),
    ) -> f64 {
        let place = scene.touches.iter().position(|t| t.level == level);
        let motion = match place {
            Some(k) => self.end.touches[k].motion,
            None => {
                let row = &scene.rows.levels[level];
                let mut motion = row.dot_motion(&self.end.motion);
                motion[0] -= contacts.width(level);
                motion
            }
        };
        let [d, v, a, j] = motion;
        let guard = |t: f64| {
            let delta = d + t * (v + t * (0.5 * a + t * j / 6.0));
            let rate = v + t * (a + 0.5 * t * j);
            match place {
                Some(k) => event_guard(scene.system, &scene.touches[k], kind, delta, rate),
                None => delta,
            }
        };
        root(guard, 1.0e-6 * v.abs().max(1.0e-9) / a.abs().max(1.0e-3))
    }

    /// Moves the end of the step by a short time (s).
    fn shift_end(&mut self, scene: &Scene<'_>, clock: &mut Clock, time: f64) {
        let before = self.powers(scene, clock.offset(1.0));
        let forces: [f64; 2] = [0.5 * time, 0.5 * time];
        for (works, now) in self.contact_works.iter_mut().zip(&self.end.touches) {
            works.0 += forces[0] * now.force * now.motion[1];
            works.1 += forces[0] * now.force;
        }
        let wanted = clock.offset(1.0) + time;
        *clock = clock.until(wanted);
        self.end.shift(time);
        self.derive_end(scene, wanted);
        let after = self.powers(scene, wanted);
        for (works, now) in self.contact_works.iter_mut().zip(&self.end.touches) {
            works.0 += forces[1] * now.force * now.motion[1];
            works.1 += forces[1] * now.force;
        }
        self.works.input += 0.5 * time * (before.0 + after.0);
        self.works.viscous += 0.5 * time * (before.1 + after.1);
    }

    /// Powers of ground motion and damping at the end (W).
    fn powers(&self, scene: &Scene<'_>, offset: f64) -> (f64, f64) {
        let ground = scene.ground.0 + scene.ground.1 * offset;
        let (mut input, mut viscous): (Lane, Lane) = (Lane::ZERO, Lane::ZERO);
        for (p, m) in self.end.motion[1].iter().zip(&scene.constants.modes) {
            for l in 0..WIDTH {
                input[l] -= m.participation[l] * ground * p[l];
                viscous[l] += m.damping[l] * p[l] * p[l];
            }
        }
        (total(&input), total(&viscous))
    }
}

/// Root near zero by the secant method, with a first probe of this size.
fn root(function: impl Fn(f64) -> f64, probe: f64) -> f64 {
    let (mut x, mut f) = (probe, function(probe));
    let (mut y, mut g) = (0.0, function(0.0));
    if f.abs() < g.abs() {
        (x, f, y, g) = (y, g, x, f);
    }
    for _ in 0..CORRECTIONS {
        let next = y - g * (y - x) / (g - f);
        if !next.is_finite() || (next - y).abs() <= 1.0e-18 + 1.0e-15 * y.abs() {
            return y;
        }
        let value = function(next);
        if value.abs() >= g.abs() {
            // Down to round-off, which must not throw the root away.
            return y;
        }
        (x, f) = (y, g);
        (y, g) = (next, value);
    }
    y
}
