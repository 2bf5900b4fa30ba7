//! Peaks within the steps of implicit methods, which do not locate where laws of storeys and links
//! change their branch: forces and accelerations have kinks inside a step, by which maxima of
//! fits miss theirs.

use super::Peaks;
use crate::methods::{Context, Method};

/// Parts of a step at whose ends a function is looked at.
const PARTS: usize = 16;
/// Halvings, by the golden section, of the parts around the largest value.
const SECTIONS: usize = 30;
/// Part of the present peak below which the ends and the middle of a step, or what a fit of it
/// reaches, are too low for a peak inside it.
pub(super) const FAR: f64 = 0.7;
/// Part of the present peak from which the largest value of a grid is looked at closer.
const NEARLY: f64 = 0.9;

/// Where a function of the place in a step (0 to 1) that may have kinks is largest, and its value
/// there.
pub(super) fn largest(mut function: impl FnMut(f64) -> f64) -> (f64, f64) {
    let places = (0..=PARTS).map(|k| k as f64 / PARTS as f64);
    let at = |best: (f64, f64), theta: f64| match function(theta) {
        value if value > best.1 => (theta, value),
        _ => best,
    };
    let best = places.fold((0.0, f64::NEG_INFINITY), at);
    around(best, function)
}

/// The largest value near the place of the largest one of a grid.
fn around(best: (f64, f64), mut function: impl FnMut(f64) -> f64) -> (f64, f64) {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let width = 1.0 / PARTS as f64;
    let (mut left, mut right) = ((best.0 - width).max(0.0), (best.0 + width).min(1.0));
    let mut best = best;
    let mut see = |theta: f64| {
        let value = function(theta);
        if value > best.1 {
            best = (theta, value);
        }
        value
    };
    let mut low = right - golden * (right - left);
    let mut high = left + golden * (right - left);
    let (mut at_low, mut at_high) = (see(low), see(high));
    for _ in 0..SECTIONS {
        if at_low > at_high {
            (right, high, at_high) = (high, low, at_low);
            low = right - golden * (right - left);
            at_low = see(low);
        } else {
            (left, low, at_low) = (low, high, at_high);
            high = left + golden * (right - left);
            at_high = see(high);
        }
    }
    best
}

impl Peaks {
    /// Takes in the absolute accelerations of floors, and the sums of them, all over a step.
    pub(super) fn accelerations_between_branches(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
    ) {
        let count = self.accelerations(context);
        let mut best = std::mem::take(&mut self.largest);
        best.clear();
        best.resize(count, (0.0, f64::NEG_INFINITY));
        self.look_between_branches(context, method, place, &mut best);
        self.largest = best;
    }

    fn look_between_branches(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        place: (f64, f64),
        best: &mut [(f64, f64)],
    ) {
        for theta in [0.0, 1.0, 0.5] {
            self.raise_all(context, method, (theta, place), best);
        }
        if self.nearly(context, FAR, best).is_empty() {
            return;
        }
        for k in 1..PARTS {
            let theta = k as f64 / PARTS as f64;
            self.raise_all(context, method, (theta, place), best);
        }
        for index in self.nearly(context, NEARLY, best) {
            let (theta, top) = around(best[index], |theta| {
                self.acceleration_at(context, method, (index, theta), place)
            });
            self.raise_acceleration(context, index, top, (theta, place));
        }
    }

    /// Takes a place in the step into the largest values, with their places.
    fn raise_all(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        (theta, place): (f64, (f64, f64)),
        best: &mut [(f64, f64)],
    ) {
        for (index, best) in best.iter_mut().enumerate() {
            let value = self.acceleration_at(context, method, (index, theta), place);
            if value > best.1 {
                *best = (theta, value);
            }
        }
    }

    /// Indices of the values that reach so large a part of the present peaks.
    fn nearly(&self, context: &Context<'_, '_>, part: f64, best: &[(f64, f64)]) -> Vec<usize> {
        let present = |index: usize| self.present_acceleration(context, index);
        let reach = |index: &usize| best[*index].1 > part * present(*index);
        (0..best.len()).filter(reach).collect()
    }

    /// The magnitude of an acceleration at a place in the step.
    fn acceleration_at(
        &mut self,
        context: &mut Context<'_, '_>,
        method: &dyn Method,
        at: (usize, f64),
        place: (f64, f64),
    ) -> f64 {
        let signed = self.signed_acceleration_at(context, method, at, place);
        signed.abs()
    }
}
