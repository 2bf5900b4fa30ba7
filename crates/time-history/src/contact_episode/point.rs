//! The motion at one time with two derivatives more than the state.

use pounding_vectorised::vectorised;

use super::touch::Touch;
use crate::system::System;
use crate::system::modes::{ContactFree, Lane, LevelRows, ModeLanes, WIDTH, lane_by_lane};

/// A closed level at one time: penetration (m) and three derivatives, force (N) and its
/// rate of change (N/s).
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct TouchPoint {
    pub motion: [f64; 4],
    pub force: f64,
    pub force_rate: f64,
}

/// Modal displacement, velocity, acceleration relative to the ground and jerk.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub motion: [Vec<Lane>; 4],
    pub touches: Vec<TouchPoint>,
}

impl Point {
    pub(crate) fn new(lanes: usize, levels: usize) -> Self {
        Self {
            motion: std::array::from_fn(|_| vec![Lane::ZERO; lanes]),
            touches: Vec::with_capacity(levels),
        }
    }

    /// Accelerations and jerks from displacements and velocities; `ground` is the
    /// ground acceleration with its slope.
    pub(crate) fn derive(
        &mut self,
        constants: &ContactFree,
        rows: &LevelRows,
        (system, touches): (&System, &[Touch]),
        ground: (f64, f64),
    ) {
        derive(self, constants, rows, (system, touches), ground);
    }

    /// Moves the point by a time so short that four terms of its series are exact.
    pub(crate) fn shift(&mut self, time: f64) {
        let [q, p, a, j] = &mut self.motion;
        for c in 0..q.len() {
            for l in 0..WIDTH {
                let half = 0.5 * time * time;
                q[c][l] += time * p[c][l] + half * a[c][l] + time * half / 3.0 * j[c][l];
                p[c][l] += time * a[c][l] + half * j[c][l];
            }
        }
    }
}

/// The next derivative of the motion of the modes without contacts, from two derivatives, the lower
/// one first, and that of the ground.
#[inline(always)]
fn differentiate(modes: &[ModeLanes], (q, p): (&[Lane], &[Lane]), ground: f64, out: &mut [Lane]) {
    for (((out, q), p), m) in out.iter_mut().zip(q).zip(p).zip(modes) {
        lane_by_lane();
        let (q, p) = (*q, *p);
        let mut next = Lane::ZERO;
        for l in 0..WIDTH {
            let omega = m.circular_frequency[l];
            next[l] = -(m.damping[l] * p[l] + omega * omega * q[l]) - m.participation[l] * ground;
        }
        *out = next;
    }
}

#[vectorised]
fn derive(
    point: &mut Point,
    constants: &ContactFree,
    rows: &LevelRows,
    (system, touches): (&System, &[Touch]),
    ground: (f64, f64),
) {
    let [q, p, a, j] = &mut point.motion;
    differentiate(&constants.modes, (q, p), ground.0, a);
    point.touches.clear();
    let mut laws = [(0.0, 0.0); 16];
    for (k, touch) in touches.iter().enumerate() {
        let row = &rows.levels[touch.level];
        let (delta, rate) = (row.dot(q) - touch.width, row.dot(p));
        let law = touch
            .contact
            .force(&system.levels()[touch.level], delta, rate);
        row.add(-law.value, a);
        if k < laws.len() {
            laws[k] = (law.by_penetration, law.by_velocity);
        }
        point.touches.push(TouchPoint {
            motion: [delta, rate, 0.0, 0.0],
            force: law.value,
            force_rate: 0.0,
        });
    }
    differentiate(&constants.modes, (p, a), ground.1, j);
    for (k, touch) in touches.iter().enumerate() {
        let row = &rows.levels[touch.level];
        let now = &mut point.touches[k];
        now.motion[2] = row.dot(a);
        let (by_penetration, by_velocity) = match laws.get(k) {
            Some(law) => *law,
            None => {
                let [delta, rate, ..] = now.motion;
                let law = touch
                    .contact
                    .force(&system.levels()[touch.level], delta, rate);
                (law.by_penetration, law.by_velocity)
            }
        };
        let change = by_penetration * now.motion[1] + by_velocity * now.motion[2];
        now.force_rate = change;
        row.add(-change, j);
    }
    for (now, touch) in point.touches.iter_mut().zip(touches) {
        now.motion[3] = rows.levels[touch.level].dot(j);
    }
}
