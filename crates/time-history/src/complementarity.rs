//! The linear complementarity problem of rigid contacts: `w = A z + q`, `w >= 0`, `z >= 0`,
//! `w z = 0`. At an impact `z` are impulses and `w` velocities at which floors part, in touch
//! and at rest `z` are forces and `w` accelerations.
//!
//! `A` is positive definite if it is `G M^-1 G'` of independent contacts; the
//! solution then exists and is unique. Solved by principal pivoting with the least index
//! (Murty, Linear Complementarity, 1988, section 4.1), which ends for every such
//! matrix.

use crate::small_solver::SmallSolver;

/// Work space.
#[derive(Debug, Default)]
pub(crate) struct Complementarity {
    active: Vec<bool>,
    indices: Vec<usize>,
    matrix: Vec<f64>,
    right: Vec<f64>,
    solution: Vec<f64>,
    solver: SmallSolver,
}

/// Signs of `w` smaller than this part of the terms that it is the sum of, and of the largest
/// of the right-hand side, are round-off.
const ROUND_OFF: f64 = 1.0e-14;

impl Complementarity {
    /// Solves for `z`; `a` row by row. `None` if the contacts are not independent, as
    /// those of floors without clearance between two walls, and no solution is found.
    pub(crate) fn solve(&mut self, a: &[f64], q: &[f64]) -> Option<&[f64]> {
        self.solve_mixed(a, q, q.len())
    }

    /// The same where only the first `signed` unknowns have a sign: of the others `w` is zero
    /// whatever `z`, as of floors that friction holds.
    pub(crate) fn solve_mixed(&mut self, a: &[f64], q: &[f64], signed: usize) -> Option<&[f64]> {
        let n = q.len();
        let scale = q.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        self.active.clear();
        self.active.extend((0..n).map(|i| i >= signed));
        // 2^n pivots suffice in theory, a few in practice.
        for _ in 0..(1_usize << n.min(16)) {
            if !self.solve_active(a, q) {
                return None;
            }
            let violated = (0..signed).find(|&i| {
                if self.active[i] {
                    self.solution[i] < 0.0
                } else {
                    let (w, size) = row(&a[i * n..(i + 1) * n], &self.solution, q[i]);
                    w < -ROUND_OFF * scale.max(size)
                }
            });
            let Some(i) = violated else {
                return Some(&self.solution);
            };
            self.active[i] = !self.active[i];
        }
        None
    }

    /// Whether `w` of this unknown is zero in the last solution, whatever its `z`.
    pub(crate) fn is_active(&self, i: usize) -> bool {
        self.active[i]
    }

    /// Solves for the active unknowns; false if their matrix is singular.
    fn solve_active(&mut self, a: &[f64], q: &[f64]) -> bool {
        let n = q.len();
        self.indices.clear();
        self.indices.extend((0..n).filter(|i| self.active[*i]));
        self.matrix.clear();
        self.right.clear();
        for &i in &self.indices {
            self.right.push(-q[i]);
            for &j in &self.indices {
                self.matrix.push(a[i * n + j]);
            }
        }
        self.solution.clear();
        self.solution.resize(n, 0.0);
        if !self.right.is_empty() && !self.solver.solve(&self.matrix, &mut self.right) {
            return false;
        }
        for (&i, x) in self.indices.iter().zip(&self.right) {
            self.solution[i] = *x;
        }
        true
    }
}

/// One row of `w = A z + q`, and the sum of the sizes of its terms.
pub(crate) fn row(a: &[f64], z: &[f64], q: f64) -> (f64, f64) {
    let terms = a.iter().zip(z).map(|(a, z)| a * z);
    terms.fold((q, q.abs()), |(sum, size), term| {
        (sum + term, size + term.abs())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A floor between two walls that ask for different restitutions.
    #[test]
    fn dependent_contacts_without_a_solution_are_told() {
        let a = [1.0, -1.0, -1.0, 1.0];
        assert!(Complementarity::default().solve(&a, &[-2.0, 1.3]).is_none());
        // With equal restitutions one of the solutions is found.
        let mut problem = Complementarity::default();
        assert_eq!(problem.solve(&a, &[-1.5, 1.5]), Some(&[1.5, 0.0][..]));
    }

    /// Brute force over all index sets: the unique solution of a positive definite
    /// problem.
    fn enumerate(a: &[f64], q: &[f64]) -> Vec<f64> {
        let n = q.len();
        for set in 0..1_usize << n {
            let mut problem = Complementarity {
                active: (0..n).map(|i| set >> i & 1 == 1).collect(),
                ..Complementarity::default()
            };
            assert!(problem.solve_active(a, q));
            let z = &problem.solution;
            let fits = (0..n).all(|i| {
                let w: f64 = (0..n).map(|j| a[i * n + j] * z[j]).sum::<f64>() + q[i];
                z[i] >= 0.0 && w >= -1e-12
            });
            if fits {
                return z.clone();
            }
        }
        panic!("no solution");
    }

    /// Two floors that a third presses on: the second contact pulls, as friction may.
    #[test]
    fn unknowns_without_a_sign_may_be_negative() {
        let a = [2.0, -1.0, -1.0, 2.0];
        let mut problem = Complementarity::default();
        let z = problem.solve_mixed(&a, &[-0.5, 2.0], 1).unwrap().to_vec();
        assert_eq!(z, [0.0, -1.0]);
        assert!(!problem.is_active(0) && problem.is_active(1));
        // With a sign it would part, and the first would be pressed.
        assert_eq!(problem.solve(&a, &[-0.5, 2.0]), Some(&[0.25, 0.0][..]));
    }

    #[test]
    fn agrees_with_enumeration() {
        // Chains of floors of random mass: a tridiagonal positive definite matrix.
        let mut seed = 12345_u64;
        let mut random = || {
            seed = seed
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for n in 1..=6 {
            for _ in 0..200 {
                let inverse: Vec<f64> = (0..=n).map(|_| 0.1 + random()).collect();
                let mut a = vec![0.0; n * n];
                for i in 0..n {
                    a[i * n + i] = inverse[i] + inverse[i + 1];
                    if i + 1 < n {
                        a[i * n + i + 1] = -inverse[i + 1];
                        a[(i + 1) * n + i] = -inverse[i + 1];
                    }
                }
                let q: Vec<f64> = (0..n).map(|_| random() - 0.6).collect();
                let mut problem = Complementarity::default();
                let z = problem.solve(&a, &q).unwrap().to_vec();
                for (x, y) in z.iter().zip(enumerate(&a, &q)) {
                    assert!((x - y).abs() < 1e-11, "{z:?}");
                }
            }
        }
    }
}
