//! Arithmetic on lanes: eight degrees of freedom, or modes, side by side.
//!
//! The functions are compiled for several instruction sets and chosen at run time
//! (`multiversion`); without fused operations their bits are the same on all.

use multiversion::multiversion;

/// Eight values side by side.
pub(crate) type Lane = [f64; 8];

/// Number of values in a lane.
pub(crate) const WIDTH: usize = 8;

/// Constants of eight modes.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ModeLanes {
    pub displacement: [Lane; 4],
    pub velocity: [Lane; 4],
    pub integral: [Lane; 4],
    pub viscous: [Lane; 10],
    pub participation: Lane,
    pub circular_frequency: Lane,
    /// `2 zeta omega`.
    pub damping: Lane,
    /// Weights of `|q'| + omega |q|` in the bounds of floor acceleration and of the
    /// second derivative of absolute floor acceleration.
    pub acceleration_bound: Lane,
    pub snap_bound: Lane,
}

/// Modal state of a system, and what it has worked since take-off.
#[derive(Debug, Clone, Default)]
pub(crate) struct Modal {
    pub displacement: Vec<Lane>,
    pub velocity: Vec<Lane>,
    pub input: Vec<Lane>,
    pub viscous: Vec<Lane>,
}

/// Ground acceleration over a step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ground {
    pub start: f64,
    pub end: f64,
    pub slope: f64,
}

/// One building's part of the transformation from modes to floors: columns of the
/// mode shapes, spread over the lanes that hold its floors.
#[derive(Debug, Clone)]
pub(crate) struct Shapes {
    pub first_lane: usize,
    pub lanes: usize,
    pub first_mode: usize,
    pub modes: usize,
    /// `lanes` times `modes` lanes.
    pub columns: Vec<Lane>,
}

/// Bounds of a step: of the floor accelerations, and of the second derivatives of
/// absolute floor accelerations, mode by mode without the part of the ground.
#[derive(Debug, Clone, Default)]
pub(crate) struct Bounds {
    pub acceleration: Vec<Lane>,
    pub snap: Vec<Lane>,
}

/// Advances all modes by a step and transforms to floor displacements.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(crate) fn advance(
    modes: &[ModeLanes],
    shapes: &[Shapes],
    now: &Modal,
    ground: Ground,
    next: &mut Modal,
    bounds: &mut Bounds,
    floors: &mut [Lane],
) {
    let (a, b, slope) = (ground.start, ground.end, ground.slope);
    let count = modes.len();
    let (q0, p0) = (&now.displacement[..count], &now.velocity[..count]);
    let (i0, w0) = (&now.input[..count], &now.viscous[..count]);
    let (q1, p1) = (&mut next.displacement[..count], &mut next.velocity[..count]);
    let (i1, w1) = (&mut next.input[..count], &mut next.viscous[..count]);
    let (acceleration, snap) = (&mut bounds.acceleration[..count], &mut bounds.snap[..count]);
    for c in 0..count {
        let m = &modes[c];
        let (q, p) = (&q0[c], &p0[c]);
        for l in 0..WIDTH {
            let (x, v) = (q[l], p[l]);
            let linear = |k: &[Lane; 4]| k[0][l] * x + k[1][l] * v + (k[2][l] * a + k[3][l] * b);
            let end = linear(&m.displacement);
            q1[c][l] = end;
            p1[c][l] = linear(&m.velocity);
            let moved = end * b - x * a - slope * linear(&m.integral);
            i1[c][l] = i0[c][l] - m.participation[l] * moved;
            let k = &m.viscous;
            let work = x * (k[0][l] * x + k[1][l] * v + (k[2][l] * a + k[3][l] * b))
                + v * (k[4][l] * v + (k[5][l] * a + k[6][l] * b))
                + (a * (k[7][l] * a + k[8][l] * b) + k[9][l] * (b * b));
            w1[c][l] = w0[c][l] + work;
            let size = v.abs() + m.circular_frequency[l] * x.abs();
            acceleration[c][l] = m.acceleration_bound[l] * size;
            snap[c][l] = m.snap_bound[l] * size;
        }
    }
    transform(shapes, &next.displacement, floors);
}

/// Floors from modes: `u = Phi q`.
#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq",
    "x86_64+avx2",
    "x86_64+avx",
    "aarch64+neon"
))]
pub(crate) fn transform(shapes: &[Shapes], modal: &[Lane], floors: &mut [Lane]) {
    for lane in floors.iter_mut() {
        *lane = [0.0; WIDTH];
    }
    let modal = modal.as_flattened();
    for building in shapes {
        let coordinates = &modal[building.first_mode..building.first_mode + building.modes];
        for k in 0..building.lanes {
            let columns = &building.columns[k * building.modes..(k + 1) * building.modes];
            let floor = &mut floors[building.first_lane + k];
            let mut sum = *floor;
            for (column, x) in columns.iter().zip(coordinates) {
                for l in 0..WIDTH {
                    sum[l] += column[l] * x;
                }
            }
            *floor = sum;
        }
    }
}

/// Modal absolute accelerations, `-(2 zeta omega q' + omega^2 q)`.
pub(crate) fn restoring(modes: &[ModeLanes], modal: &Modal, out: &mut [Lane]) {
    for (c, m) in modes.iter().enumerate() {
        for l in 0..WIDTH {
            let omega = m.circular_frequency[l];
            out[c][l] =
                -(m.damping[l] * modal.velocity[c][l] + omega * omega * modal.displacement[c][l]);
        }
    }
}
