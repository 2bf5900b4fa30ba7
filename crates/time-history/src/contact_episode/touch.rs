//! A closed level while its phase is held.

use crate::contact::{Contact, Contacts};
use crate::system::System;

/// A closed level: its contact, and where it stands.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Touch {
    pub level: usize,
    pub contact: Contact,
    /// Present width of the gap (m).
    pub width: f64,
}

/// Lists the closed ones of these levels. Returns false if one of them is stuck, which the
/// equations of the modes do not cover.
pub(crate) fn list(contacts: &Contacts, levels: &[usize], out: &mut Vec<Touch>) -> bool {
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
        out.push(Touch {
            level,
            contact: *contact,
            width: contacts.width(level),
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
