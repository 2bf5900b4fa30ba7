//! The motion over a block of samples without contact, for who looks at it.

use super::block::{self, Block};
use super::constants::ContactFree;
use super::lanes::{Lane, ModalState};

/// The motion over samples without contact, for observers.
#[derive(Clone, Copy)]
pub(crate) struct BlockMotion<'a> {
    /// Number of the first sample, and time from one to the next (s).
    pub first: usize,
    pub step: f64,
    /// Ground accelerations (m/s2), one more than steps.
    pub ground: &'a [f64],
    /// Motion at the start; works count from those of the run's state.
    pub start: ModalState<'a>,
    pub block: &'a Block,
}

/// One of these samples.
#[derive(Clone, Copy)]
pub(crate) struct SampleMotion<'a> {
    /// Its start (s), and the motion there and at its end.
    pub time: f64,
    pub ends: [ModalState<'a>; 2],
    /// Ground acceleration at the start (m/s2) and its slope (m/s3).
    pub ground: (f64, f64),
}

impl<'a> BlockMotion<'a> {
    /// Number of samples.
    pub(crate) fn len(&self) -> usize {
        self.ground.len() - 1
    }

    /// The sample of this number, from zero.
    pub(crate) fn sample(&self, number: usize) -> SampleMotion<'a> {
        let after = |samples: usize| match samples {
            0 => self.start,
            _ => self.block.motion_after(samples).unwrap_or(self.start),
        };
        let (a, b) = (self.ground[number], self.ground[number + 1]);
        SampleMotion {
            time: (self.first + number) as f64 * self.step,
            ends: [after(number), after(number + 1)],
            ground: (a, (b - a) / self.step),
        }
    }

    /// The motion at a time (s) if that is the end of a sample but for `close` (s), with the
    /// ground acceleration (m/s2) then.
    pub(crate) fn at_end_of_sample(&self, time: f64, close: f64) -> Option<(ModalState<'a>, f64)> {
        // Signed numbers become floating-point ones in one instruction.
        let ended = (time / self.step + 0.5) as i64;
        let number = usize::try_from(ended - self.first as i64).ok()?;
        let end = (ended - 1) as f64 * self.step + self.step;
        if (end - time).abs() > close || number == 0 || number > self.len() {
            return None;
        }
        Some((self.block.motion_after(number)?, self.ground[number]))
    }

    /// Number of the sample that holds a time (s): at an instant between two, that before it.
    pub(crate) fn number_at(&self, time: f64) -> usize {
        let end = |number: usize| (self.first + number) as f64 * self.step + self.step;
        let last = self.len() - 1;
        let guess = (time / self.step) as usize;
        let mut number = guess.saturating_sub(self.first).min(last);
        while number > 0 && time <= end(number - 1) {
            number -= 1;
        }
        while number < last && time > end(number) {
            number += 1;
        }
        number
    }

    /// Bounds what the displacement of every floor may exceed its values at samples by (m); beside
    /// it stands space for the modes.
    pub(crate) fn bound_displacements(&self, constants: &ContactFree, over: [&mut [Lane]; 3]) {
        block::bound_displacements(constants, self.start, self.ground, over);
    }
}
