//! How fast buildings, contacts and elements can move together.

use pounding_hysteresis::History;

use crate::building_rates::{damping_rate, fastest_rate};
use crate::dynamics::Context;
use crate::layout::Layout;
use crate::system::{System, Terms};

/// Bound of the eigenvalues of the motion at a state: of the buildings, of the contacts
/// that are closed, and of what elements are stiffer than the matrices carry.
#[derive(Debug, Clone)]
pub(crate) struct Rates {
    /// Bound for the buildings without contact (1/s).
    buildings: f64,
    /// Maximum eigenvalues of `M^-1 K` (1/s2) and `M^-1 C` (1/s) of the buildings.
    stiffness: f64,
    damping: f64,
    /// Stiffness (1/s2) and damping (1/s) that contacts and elements add at every degree
    /// of freedom, over its mass.
    added: Vec<(f64, f64)>,
    /// Whether elements count with their stiffness on the branch that they hold alone.
    held: bool,
    scratch: Option<History>,
}

impl Rates {
    pub(crate) fn new(system: &System) -> Self {
        let buildings = system.buildings();
        let omega = buildings.iter().map(|b| {
            let frequencies = b.modes().circular_frequency.iter();
            frequencies.copied().fold(0.0, f64::max)
        });
        let damping = buildings.iter().map(|b| {
            if b.damping().couples_modes() {
                return damping_rate(b);
            }
            let modes = b.modes();
            let pairs = modes.circular_frequency.iter().zip(&modes.damping_ratio);
            pairs.map(|(w, zeta)| 2.0 * w * zeta).fold(0.0, f64::max)
        });
        Self {
            buildings: fastest_rate(buildings),
            stiffness: omega.fold(0.0, f64::max).powi(2),
            damping: damping.fold(0.0, f64::max),
            added: vec![(0.0, 0.0); system.degrees_of_freedom()],
            held: false,
            scratch: system.elements().first().map(|e| e.law.virgin()),
        }
    }

    /// The same for steps that end where a branch does: what an element was before, or will
    /// be, does not matter.
    pub(crate) fn of_branches(system: &System) -> Self {
        Self {
            held: true,
            ..Self::new(system)
        }
    }

    /// The bound (1/s) with the tangents at this state. What is added is bounded by
    /// Gershgorin's discs on its places: an eigenvalue `s` solves `s^2 + c s + w = 0` with
    /// the Rayleigh quotients of its vector, so that `|s|` is at most `sqrt(w)` or `c`.
    pub(crate) fn at(&mut self, context: &Context<'_, '_>, state: &[f64]) -> f64 {
        let system = context.dynamics.system;
        let contacts = context.contacts;
        if contacts.closed().is_empty() && system.elements().is_empty() {
            return self.buildings;
        }
        let n = system.degrees_of_freedom();
        let (u, v) = (&state[..n], &state[n..2 * n]);
        let layout = Layout::of(system);
        self.added.fill((0.0, 0.0));
        // A row `w` over several coordinates adds `w w'` times its stiffness, whose norm is
        // the stiffness times `w' M^-1 w`.
        let (mut of_rows, mass) = ((0.0, 0.0), system.mass());
        let mut add = |ends: [Option<usize>; 2], terms: &Terms, stiffness: f64, damping: f64| {
            if !terms.pushed.is_empty() {
                let of_ends = ends.into_iter().flatten().map(|i| 1.0 / mass[i]);
                let further = terms.pushed.iter().map(|(i, w)| w * w / mass[*i]);
                let mobility: f64 = of_ends.chain(further).sum();
                of_rows.0 += stiffness.max(0.0) * mobility;
                of_rows.1 += damping.abs() * mobility;
                return;
            }
            for i in ends.into_iter().flatten() {
                self.added[i].0 += stiffness.max(0.0) / mass[i];
                self.added[i].1 += damping.abs() / mass[i];
            }
        };
        for &l in contacts.closed() {
            let level = &system.levels()[l];
            if let Some(contact) = contacts.contact(l)
                && !contact.is_stuck()
            {
                let delta = contacts.penetration(system, l, u);
                let law = contact.force(level, delta, level.relative(v));
                let ends = [level.left, level.right];
                add(
                    ends,
                    &level.terms,
                    law.by_penetration.abs(),
                    law.by_velocity,
                );
            }
        }
        for (element, history) in system.elements().iter().zip(&contacts.elements.histories) {
            let Some(scratch) = &mut self.scratch else {
                break;
            };
            let at = (element.motion(u, v), &state[element.range(layout)]);
            let tangent = element.response(history, scratch, at, None);
            let tangent_stiffness = tangent.by_deformation.abs();
            let stiffness = if self.held {
                tangent_stiffness
            } else {
                tangent_stiffness.max(element.law.initial_stiffness())
            };
            let ends = [element.far, element.near];
            let added = stiffness - element.carried;
            add(ends, &element.terms, added, tangent.by_velocity);
        }
        let (mut stiffness, mut damping) = (0.0_f64, 0.0_f64);
        let mut look = |ends: [Option<usize>; 2]| {
            let ends = || ends.into_iter().flatten();
            stiffness = stiffness.max(ends().map(|i| self.added[i].0).sum());
            damping = damping.max(ends().map(|i| self.added[i].1).sum());
        };
        for &l in contacts.closed() {
            let level = &system.levels()[l];
            look([level.left, level.right]);
        }
        for element in system.elements() {
            look([element.far, element.near]);
        }
        (stiffness, damping) = (stiffness + of_rows.0, damping + of_rows.1);
        if stiffness == 0.0 && damping == 0.0 {
            return self.buildings;
        }
        let together = (self.stiffness + stiffness).sqrt();
        together.max(self.damping + damping).max(self.buildings)
    }
}
