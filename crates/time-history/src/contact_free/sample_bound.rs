//! Bounds of floors' functions over one sample, from values and slopes at both ends: what stays
//! below its peak by them needs no closer look.

use std::ops::Range;

use pounding_vectorised::vectorised;

use crate::polynomial::hermite_range;
use crate::system::modes::{
    ContactFree, Decay, Ground, Lane, Modal, ModalRow, Quantity, WIDTH, derive,
};

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

    /// Takes the sample that begins with these lanes of modes. A derivative `y` of a mode from the second
    /// on swings freely, so that `y'^2 + omega^2 y^2` never grows, and with it
    /// `|y''| <= omega sqrt(1 + 4 zeta^2)` times its root; beyond critical damping by its decay.
    pub(super) fn take(
        &mut self,
        constants: &ContactFree,
        now: (Range<usize>, &Modal),
        ground: Ground,
    ) {
        take(constants, now, ground, self);
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
        let (ends, fourth, rest) = values(self, (row, of), constants.decays.is_empty());
        let (least, most) = hermite_range(ends, fourth, self.step);
        most.max(-least) + rest <= peak && most.is_finite()
    }
}

/// Values and rates of a function at both ends, bound of its fourth derivative, and what fast decays
/// depart by, if there are any.
#[vectorised]
fn values(bound: &SampleBound, (row, of): (&ModalRow, usize), slow: bool) -> ([f64; 4], f64, f64) {
    let ends = [
        &bound.start[2 * of],
        &bound.start[2 * of + 1],
        &bound.end[2 * of],
        &bound.end[2 * of + 1],
    ];
    let fourth = row.dot_magnitudes(&bound.fourth[of]);
    let rest = if slow {
        0.0
    } else {
        row.dot_magnitudes(&bound.rest[of])
    };
    (ends.map(|x| row.dot(x)), fourth, rest)
}

#[vectorised]
fn take(
    constants: &ContactFree,
    (lanes, now): (Range<usize>, &Modal),
    ground: Ground,
    bound: &mut SampleBound,
) {
    bound.step = constants.step;
    let at_end = Ground {
        start: ground.end,
        ..ground
    };
    for c in lanes {
        let m = &constants.modes[c];
        let (q, p) = (&now.displacement[c], &now.velocity[c]);
        let after = |k: &[Lane; 4]| {
            let mut out = Lane::ZERO;
            for l in 0..WIDTH {
                out[l] = k[0][l] * q[l]
                    + k[1][l] * p[l]
                    + (k[2][l] * ground.start + k[3][l] * ground.end);
            }
            out
        };
        let (q_end, p_end) = (after(&m.displacement), after(&m.velocity));
        let (absolute, derivatives) = derive(m, (q, p), ground);
        let (absolute_end, _) = derive(m, (&q_end, &p_end), at_end);
        for (out, [x, y]) in [
            (&mut bound.start, [(q, p), (&absolute[0], &absolute[1])]),
            (
                &mut bound.end,
                [(&q_end, &p_end), (&absolute_end[0], &absolute_end[1])],
            ),
        ] {
            (out[0][c], out[1][c], out[2][c], out[3][c]) = (*x.0, *x.1, *y.0, *y.1);
        }
        let decay = Decay::of_lane(&constants.decays, c);
        for (k, [y, rate]) in derivatives.iter().enumerate() {
            let mut any = Lane::ZERO;
            for l in 0..WIDTH {
                let (damping, stiffness) = (m.damping[l], m.stiffness[l]);
                let factor = (stiffness + damping * damping).sqrt();
                any[l] = factor * (rate[l] * rate[l] + stiffness * y[l] * y[l]).sqrt();
            }
            let [fourth, rest] = match decay {
                Some(decay) => decay.bound([y, rate, &any]),
                None => [any, Lane::ZERO],
            };
            (bound.fourth[k][c], bound.rest[k][c]) = (fourth, rest);
        }
    }
}
