//! The energy ledger, relative to the ground.
//!
//! `input = kinetic + strain + viscous + hysteretic + impact + residual` at all
//! times; `impact` is the work done on the contacts less what their springs still
//! store. Relative formulation: Uang and Bertero, Evaluation of seismic energy in
//! structures, Earthquake Engineering and Structural Dynamics 19 (1990) 77,
//! equation 8.

use crate::contact::Contacts;
use crate::layout::Layout;
use crate::outcome::Energy;
use crate::system::System;

/// Ledger at a state; `elapsed` is the time since the histories of the elements were
/// committed, inside a step of a method that does not locate their events.
pub(crate) fn energy(
    system: &System,
    layout: Layout,
    contacts: &Contacts,
    state: &[f64],
    elapsed: Option<f64>,
) -> Energy {
    let n = layout.dofs;
    let (u, v) = (&state[..n], &state[n..2 * n]);
    let (elastic, hysteretic) = contacts.elements.energy((system, layout), state, elapsed);
    let stored = stored_energies(system, contacts, u);
    let kinetic = system.kinetic_energy(v);
    let strain = system.strain_energy(u) + stored + elastic;
    let works = Works::in_state(layout, state);
    balance(works, (kinetic, strain, hysteretic), stored)
}

/// Works until now (J).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Works {
    /// Of the ground motion, of damping, and on all contacts.
    pub input: f64,
    pub viscous: f64,
    pub contacts: f64,
}

impl Works {
    /// Those that stand in a state.
    #[inline]
    pub(crate) fn in_state(layout: Layout, state: &[f64]) -> Self {
        Self {
            input: state[layout.input()],
            viscous: state[layout.viscous()],
            contacts: (0..layout.levels).map(|l| state[layout.work(l)]).sum(),
        }
    }
}

/// The ledger of works, and of kinetic energy, energy of strain and hysteresis; what contacts store
/// counts as strain, not as impact.
#[inline]
pub(crate) fn balance(
    works: Works,
    (kinetic, strain, hysteretic): (f64, f64, f64),
    stored: f64,
) -> Energy {
    let mut energy = Energy {
        input: works.input,
        kinetic,
        strain,
        viscous: works.viscous,
        hysteretic,
        impact: works.contacts - stored,
        residual: 0.0,
    };
    energy.residual =
        energy.kinetic + energy.strain + energy.viscous + energy.hysteretic + energy.impact
            - energy.input;
    energy
}

/// Recoverable energy of all closed levels (J).
#[inline]
pub(crate) fn stored_energies(system: &System, contacts: &Contacts, u: &[f64]) -> f64 {
    let closed = contacts.closed().iter();
    closed.map(|l| stored_energy(system, contacts, *l, u)).sum()
}

/// Recoverable energy of one level (J).
pub(crate) fn stored_energy(system: &System, contacts: &Contacts, l: usize, u: &[f64]) -> f64 {
    contacts.contact(l).map_or(0.0, |contact| {
        let level = &system.levels()[l];
        contact.stored_energy(level, contacts.penetration(system, l, u))
    })
}
