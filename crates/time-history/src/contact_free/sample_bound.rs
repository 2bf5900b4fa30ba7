//! Bounds of floors' functions over one sample, from values and slopes at both ends: what stays
//! below its peak by them needs no closer look.

use super::candidates::Quantity;
use super::constants::ContactFree;
use super::lanes::{Ground, Lane, Modal, WIDTH};
use crate::polynomial::hermite_range;

/// The modes at both ends of a sample: displacement and velocity, absolute acceleration and
/// its rate; and bounds of the fourth derivatives of displacement and absolute acceleration, with
/// what fast decays depart by beside.
#[derive(Debug, Clone)]
pub(super) struct SampleBound {
    start: [Vec<Lane>; 4],
    end: [Vec<Lane>; 4],
    fourth: [Vec<Lane>; 2],
    rest: [Vec<Lane>; 2],
    step: f64,
}

impl SampleBound {
    pub(super) fn new(lanes: usize) -> Self {
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            start: std::array::from_fn(|_| zeros()),
            end: std::array::from_fn(|_| zeros()),
            fourth: std::array::from_fn(|_| zeros()),
            rest: std::array::from_fn(|_| zeros()),
            step: 0.0,
        }
    }

    /// Takes the sample that begins with these modes. A derivative `y` of a mode from the second
    /// on swings freely, so that `y'^2 + omega^2 y^2` never grows, and with it
    /// `|y''| <= omega sqrt(1 + 4 zeta^2)` times its root; beyond critical damping by its decay.
    pub(super) fn take(&mut self, constants: &ContactFree, now: &Modal, ground: Ground) {
        self.step = constants.step;
        for (c, m) in constants.modes.iter().enumerate() {
            for l in 0..WIDTH {
                let (damping, stiffness) = (m.damping[l], m.stiffness[l]);
                let gamma = m.participation[l];
                let (q, p) = (now.displacement[c][l], now.velocity[c][l]);
                let after = |k: &[Lane; 4]| {
                    k[0][l] * q + k[1][l] * p + (k[2][l] * ground.start + k[3][l] * ground.end)
                };
                let ends = [
                    (q, p, ground.start, &mut self.start),
                    (
                        after(&m.displacement),
                        after(&m.velocity),
                        ground.end,
                        &mut self.end,
                    ),
                ];
                for (q, p, ground, out) in ends {
                    let restoring = -(damping * p + stiffness * q);
                    let second = restoring - gamma * ground;
                    out[0][c][l] = q;
                    out[1][c][l] = p;
                    out[2][c][l] = restoring;
                    out[3][c][l] = -(damping * second + stiffness * p);
                }
                let second = self.start[2][c][l] - gamma * ground.start;
                let third = self.start[3][c][l] - gamma * ground.slope;
                let fourth = -(damping * third + stiffness * second);
                let fifth = -(damping * fourth + stiffness * third);
                let factor = (stiffness + damping * damping).sqrt();
                let root = |y: f64, rate: f64| factor * (rate * rate + stiffness * y * y).sqrt();
                let of = [(second, third), (fourth, fifth)];
                for (k, (y, rate)) in of.into_iter().enumerate() {
                    let any = root(y, rate);
                    let decay = constants.decays.get(c);
                    let bound = decay.map_or((any, 0.0), |d| d.bound(l, (y, rate), any));
                    (self.fourth[k][c][l], self.rest[k][c][l]) = bound;
                }
            }
        }
    }

    /// Whether a function is sure not to exceed this value.
    pub(super) fn is_below(
        &self,
        constants: &ContactFree,
        (quantity, floor): (Quantity, usize),
        peak: f64,
    ) -> bool {
        let rows = &constants.rows;
        let (row, of) = match quantity {
            Quantity::Displacement => (&rows.floors[floor], 0),
            Quantity::Drift => (&rows.drifts[floor], 0),
            Quantity::Acceleration => (&rows.floors[floor], 1),
            Quantity::SectionForce => (&rows.sections[floor], 0),
        };
        let ends = [
            &self.start[2 * of],
            &self.start[2 * of + 1],
            &self.end[2 * of],
            &self.end[2 * of + 1],
        ];
        let fourth = row.dot_magnitudes(&self.fourth[of]);
        let rest = if constants.decays.is_empty() {
            0.0
        } else {
            row.dot_magnitudes(&self.rest[of])
        };
        let (least, most) = hermite_range(ends.map(|x| row.dot(x)), fourth, self.step);
        most.max(-least) + rest <= peak && most.is_finite()
    }
}
