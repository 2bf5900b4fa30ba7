//! Explicit Runge-Kutta steps of order 8(5,3) with dense output, on flat state vectors.
//!
//! The crate knows no structure, no contact and no events: it computes one trial
//! step, an error estimate and, on request, an interpolating polynomial inside the
//! step. Accepting, rejecting and cutting steps is the caller's business.

// The same bits on every machine: see clippy.toml.
#![warn(clippy::disallowed_methods)]

pub mod tableau;

use tableau::{DENSE, ERROR_3, ERROR_5, NODES, ROWS, STAGES, STAGES_DENSE, WEIGHTS};

/// Number of power-basis coefficients of the dense output (degree 7).
pub const DENSE_COEFFICIENTS: usize = 8;

/// Order of the solution that is carried on.
pub const ORDER: usize = 8;

/// Work space of the pair of order 8(5,3) of Dormand and Prince (Hairer, Norsett
/// and Wanner 1993, section II.5). All memory is taken at construction; a step
/// allocates nothing.
#[derive(Debug, Clone)]
pub struct Dop853 {
    dimension: usize,
    stages: Vec<f64>,
    trial: Vec<f64>,
    start: Vec<f64>,
    end: Vec<f64>,
    dense: Vec<[f64; DENSE_COEFFICIENTS]>,
    step: f64,
    first_is_known: bool,
    end_is_known: bool,
    evaluations: u64,
}

impl Dop853 {
    /// Work space for states of `dimension` components.
    #[must_use]
    pub fn new(dimension: usize) -> Self {
        Self {
            dimension,
            stages: vec![0.0; dimension * STAGES_DENSE],
            trial: vec![0.0; dimension],
            start: vec![0.0; dimension],
            end: vec![0.0; dimension],
            dense: vec![[0.0; DENSE_COEFFICIENTS]; dimension],
            step: 0.0,
            first_is_known: false,
            end_is_known: false,
            evaluations: 0,
        }
    }

    /// Number of derivative evaluations so far.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Forgets the derivative at the start of the step: call it whenever the
    /// right-hand side or the state changed other than by [`Dop853::advance`].
    pub fn invalidate(&mut self) {
        self.first_is_known = false;
        self.end_is_known = false;
    }

    /// Declares the last trial step accepted, so that its derivative at the end,
    /// if it is known, serves as the first stage of the next step.
    pub fn advance(&mut self) {
        let n = self.dimension;
        if self.end_is_known {
            self.stages.copy_within(STAGES * n..(STAGES + 1) * n, 0);
        }
        self.first_is_known = self.end_is_known;
        self.end_is_known = false;
    }

    /// Computes a trial step of length `step` from `state` into `new_state`.
    /// `derivative(offset, state, out)` gives the derivative at `offset` from the
    /// start of the step.
    pub fn step<F>(&mut self, derivative: &mut F, state: &[f64], step: f64, new_state: &mut [f64])
    where
        F: FnMut(f64, &[f64], &mut [f64]),
    {
        let n = self.dimension;
        self.step = step;
        self.end_is_known = false;
        self.start.copy_from_slice(state);
        if !self.first_is_known {
            derivative(0.0, state, &mut self.stages[..n]);
            self.evaluations += 1;
            self.first_is_known = true;
        }
        for stage in 1..STAGES {
            self.stage(derivative, stage);
        }
        combine(&self.stages, n, &WEIGHTS, state, step, new_state);
        self.end.copy_from_slice(new_state);
    }

    /// Largest weighted error of the last trial step: above one, the step is too
    /// long. `scale(i)` is the error allowed in component `i`; an infinite scale
    /// leaves the component out. The estimate blends the fifth- and third-order
    /// estimates as Hairer, Norsett and Wanner (1993, equation II.10.17) do, per
    /// component, and takes the maximum.
    #[must_use]
    pub fn error_norm(&self, scale: impl Fn(usize) -> f64) -> f64 {
        let n = self.dimension;
        let mut largest = 0.0_f64;
        for i in 0..n {
            let allowed = scale(i);
            if allowed == f64::INFINITY {
                continue;
            }
            let fifth: f64 = ERROR_5
                .iter()
                .map(|(j, w)| w * self.stages[j * n + i])
                .sum();
            let third: f64 = ERROR_3
                .iter()
                .map(|(j, w)| w * self.stages[j * n + i])
                .sum();
            let blend = (fifth * fifth + 0.01 * third * third).sqrt();
            let error = if blend == 0.0 {
                0.0
            } else {
                self.step.abs() * fifth * fifth / blend
            };
            let ratio = error / allowed;
            // A NaN must not be lost in the comparison: it rejects the step.
            if ratio.is_nan() {
                return f64::INFINITY;
            }
            largest = largest.max(ratio);
        }
        largest
    }

    /// Step length factor for the next trial after an error norm, with the usual
    /// safety factor 0.9 and bounds 0.2 and 6.
    #[must_use]
    pub fn step_factor(error_norm: f64) -> f64 {
        if error_norm <= 0.0 {
            6.0
        } else {
            // One over the root of the order, which is 8.
            (0.9 / error_norm.sqrt().sqrt().sqrt()).clamp(0.2, 6.0)
        }
    }

    /// Computes the dense output of the last trial step: four more evaluations.
    pub fn prepare_dense<F>(&mut self, derivative: &mut F)
    where
        F: FnMut(f64, &[f64], &mut [f64]),
    {
        let n = self.dimension;
        derivative(
            self.step,
            &self.end,
            &mut self.stages[STAGES * n..(STAGES + 1) * n],
        );
        self.evaluations += 1;
        self.end_is_known = true;
        for stage in STAGES + 1..STAGES_DENSE {
            self.stage(derivative, stage);
        }
        for i in 0..n {
            self.dense[i] = self.dense_polynomial(i);
        }
    }

    /// Power-basis coefficients of component `i` over the last trial step, in
    /// `theta = offset / step`. Only valid after [`Dop853::prepare_dense`].
    #[must_use]
    pub fn polynomial(&self, i: usize) -> &[f64; DENSE_COEFFICIENTS] {
        &self.dense[i]
    }

    fn stage<F>(&mut self, derivative: &mut F, stage: usize)
    where
        F: FnMut(f64, &[f64], &mut [f64]),
    {
        let n = self.dimension;
        combine(
            &self.stages,
            n,
            ROWS[stage],
            &self.start,
            self.step,
            &mut self.trial,
        );
        derivative(
            NODES[stage] * self.step,
            &self.trial,
            &mut self.stages[stage * n..(stage + 1) * n],
        );
        self.evaluations += 1;
    }

    /// The dense output in powers of theta. Hairer's nested form is
    /// `y0 + t (F0 + s (F1 + t (F2 + s (F3 + t (F4 + s (F5 + t F6))))))` with
    /// `t = theta`, `s = 1 - theta`.
    fn dense_polynomial(&self, i: usize) -> [f64; DENSE_COEFFICIENTS] {
        let n = self.dimension;
        let h = self.step;
        let change = self.end[i] - self.start[i];
        let first = h * self.stages[i];
        let last = h * self.stages[STAGES * n + i];
        let term = |row: &[(usize, f64)]| -> f64 {
            h * row
                .iter()
                .map(|(j, w)| w * self.stages[j * n + i])
                .sum::<f64>()
        };
        let nested = [
            change,
            first - change,
            2.0 * change - (last + first),
            term(DENSE[0]),
            term(DENSE[1]),
            term(DENSE[2]),
            term(DENSE[3]),
        ];
        let mut p = [0.0; DENSE_COEFFICIENTS];
        for (level, f) in nested.iter().enumerate().rev() {
            p[0] += f;
            // Multiply by theta where `level` is even, by (1 - theta) where odd.
            for k in (1..DENSE_COEFFICIENTS).rev() {
                p[k] = if level % 2 == 0 {
                    p[k - 1]
                } else {
                    p[k] - p[k - 1]
                };
            }
            if level % 2 == 0 {
                p[0] = 0.0;
            }
        }
        p[0] += self.start[i];
        p
    }
}

/// `out = base + step * sum(weight * stage)`.
fn combine(
    stages: &[f64],
    n: usize,
    weights: &[(usize, f64)],
    base: &[f64],
    step: f64,
    out: &mut [f64],
) {
    out.fill(0.0);
    for (j, w) in weights {
        for (o, k) in out.iter_mut().zip(&stages[j * n..(j + 1) * n]) {
            *o += w * k;
        }
    }
    for (o, b) in out.iter_mut().zip(base) {
        *o = b + step * *o;
    }
}
