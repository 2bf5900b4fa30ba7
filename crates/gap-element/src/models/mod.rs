//! One published model a file.

pub(crate) mod anagnostopoulos_2004;
pub(crate) mod borovin_2014;
pub(crate) mod hertz_1882;
pub(crate) mod jankowski_2005;
pub(crate) mod linear_elastic;
pub(crate) mod mahmoud_jankowski_2011;
pub(crate) mod muthukumar_desroches_2006;

use crate::model::{Direction, Guard, Phase, Target, Transition};

/// Approach-only damping: it goes off at the turning point and on again if the
/// floors approach once more within the same contact.
pub(crate) fn approach_only(phase: Phase) -> &'static [Transition] {
    const APPROACH: [Transition; 1] = [Transition {
        guard: Guard::Velocity,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Restitution),
    }];
    const RESTITUTION: [Transition; 1] = [Transition {
        guard: Guard::Velocity,
        direction: Direction::Rising,
        target: Target::Phase(Phase::Approach),
    }];
    match phase {
        Phase::Approach => &APPROACH,
        Phase::Restitution => &RESTITUTION,
        Phase::Stuck | Phase::Released => &[],
    }
}
