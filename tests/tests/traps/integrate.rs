//! The pair of order 8(5,3) driven to the end of an interval, for laws without a closed
//! form: at a tight tolerance from a located closure it is the truth, at a loose one
//! across a closure it is naive.

use pounding_runge_kutta::Dop853;

/// Integrates from time zero to `end` (s), at first with this step, errors held below
/// `tolerance` times the value or its `scale`. `None` if the state is not finite.
pub fn integrate(
    mut derivative: impl FnMut(f64, &[f64], &mut [f64]),
    start: &[f64],
    (first, end): (f64, f64),
    (tolerance, scale): (f64, &[f64]),
) -> Option<Vec<f64>> {
    let mut pair = Dop853::new(start.len());
    let (mut y, mut new) = (start.to_vec(), start.to_vec());
    let (mut time, mut step) = (0.0, first);
    while time < end {
        let last = time + step >= end;
        let taken = if last { end - time } else { step };
        let mut here = |offset: f64, y: &[f64], out: &mut [f64]| derivative(time + offset, y, out);
        pair.step(&mut here, &y, taken, &mut new);
        if !new.iter().all(|x| x.is_finite()) {
            return None;
        }
        let allowed = |i: usize| tolerance * scale[i].max(y[i].abs());
        let error = pair.error_norm(allowed);
        step = taken * Dop853::step_factor(error);
        if error <= 1.0 {
            pair.invalidate();
            std::mem::swap(&mut y, &mut new);
            time = if last { end } else { time + taken };
        }
        if step < 1e-16 {
            return None;
        }
    }
    Some(y)
}
