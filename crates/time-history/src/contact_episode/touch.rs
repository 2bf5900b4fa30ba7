//! A closed level while its phase is held.

use crate::contact::{Contact, Contacts};
use crate::system::System;
use crate::system::modes::{Lane, LevelRows};

/// A closed level: its contact, and where it stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    pub level: usize,
    pub contact: Contact,
    /// Present width of the gap (m).
    pub width: f64,
    /// Penetration (m) and its rate of change (m/s) at the start of the next step, as the modes
    /// have them.
    pub motion: (f64, f64),
}

/// Lists the closed ones of these levels at these displacements and velocities of the modes. Returns
/// false if one of them is stuck, which the equations of the modes do not cover.
pub(crate) fn list(
    contacts: &Contacts,
    levels: &[usize],
    (rows, motion): (&LevelRows, [&[Lane]; 2]),
    out: &mut Vec<Touch>,
) -> bool {
    out.clear();
    for &level in contacts.closed() {
        if levels.binary_search(&level).is_err() {
            continue;
        }
        let Some(contact) = contacts.contact(level) else {
            continue;
        };
        if contact.is_stuck() {
            return false;
        }
        let ([closing, rate], width) = (rows.levels[level].dot_two(motion), contacts.width(level));
        out.push(Touch {
            level,
            contact: *contact,
            width,
            motion: (closing - width, rate),
        });
    }
    true
}

/// Takes over what the models remember by now.
pub(crate) fn refresh(contacts: &Contacts, touches: &mut [Touch]) {
    for touch in touches {
        if let Some(contact) = contacts.contact(touch.level) {
            touch.contact.memory = contact.memory;
        }
    }
}

/// Whether all of them are affine or powers of the penetration in their phase.
pub(crate) fn are_powers(touches: &[Touch], system: &System) -> bool {
    touches.iter().all(|t| {
        let model = &system.levels()[t.level].model;
        let (collision, phase) = (&t.contact.collision, t.contact.phase);
        model.is_affine(collision, phase) || model.power_law(collision, phase).is_some()
    })
}

/// Whether all of them are affine in their phase.
pub(crate) fn are_affine(touches: &[Touch], system: &System) -> bool {
    touches.iter().all(|t| {
        let model = &system.levels()[t.level].model;
        model.is_affine(&t.contact.collision, t.contact.phase)
    })
}
