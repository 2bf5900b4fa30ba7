//! The equations of motion with the contact phases held, and the energy integrals.
//!
//! Relative to the ground: `M u'' = -K u - C u' + contact - M 1 a_g`. The state
//! carries, beside displacements and velocities, the integrals that the energy
//! ledger needs, so that every method integrates them with its own accuracy.

use pounding_hysteresis::{History, Motion};

use crate::contact::Contacts;
use crate::layout::Layout;
use crate::small_solver::SmallSolver;
use crate::system::{ContactLevel, Element, Grounds, Segment, System};

/// A time at which the equations of motion are looked at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Instant {
    /// Ground accelerations.
    pub ground: Grounds,
    /// Time (s) since the histories of the elements were committed, for a method that
    /// does not locate their events; `None` holds their branches.
    pub elapsed: Option<f64>,
}

impl Instant {
    /// At the state that the histories belong to.
    pub(crate) fn committed(ground: Grounds) -> Self {
        Self {
            ground,
            elapsed: None,
        }
    }

    /// Inside a step, `offset` seconds after its start.
    pub(crate) fn within(ground: Grounds, implicit: bool, offset: f64) -> Self {
        Self {
            ground,
            elapsed: (implicit && offset > 0.0).then_some(offset),
        }
    }
}

/// What a trial step works on.
pub(crate) struct Context<'a, 'b> {
    pub dynamics: &'a mut Dynamics<'b>,
    pub contacts: &'a Contacts,
    pub segment: &'a Segment,
}

/// Space for this many levels that are stuck at one time; more make it grow.
const STUCK_TOGETHER: usize = 32;

/// Right-hand side with its work space.
#[derive(Debug, Clone)]
pub(crate) struct Dynamics<'a> {
    pub system: &'a System,
    pub layout: Layout,
    /// Contact force of every level at the last evaluation (N).
    pub forces: Vec<f64>,
    damping: Vec<f64>,
    net: Vec<f64>,
    stuck: Vec<usize>,
    matrix: Vec<f64>,
    right: Vec<f64>,
    solver: SmallSolver,
    /// The levels whose matrix the solver holds, and whether it is regular.
    prepared: Vec<usize>,
    regular: bool,
    scratch: Option<History>,
}

impl<'a> Dynamics<'a> {
    pub(crate) fn new(system: &'a System) -> Self {
        let layout = Layout::of(system);
        let together = layout.levels.min(STUCK_TOGETHER);
        Self {
            system,
            layout,
            forces: vec![0.0; layout.levels],
            damping: vec![0.0; layout.dofs],
            net: vec![0.0; layout.dofs],
            stuck: Vec::with_capacity(layout.levels),
            matrix: Vec::with_capacity(together * together),
            right: Vec::with_capacity(together),
            solver: SmallSolver::with_capacity(together),
            prepared: Vec::with_capacity(layout.levels),
            regular: false,
            scratch: system.elements().first().map(|e| e.law.virgin()),
        }
    }

    /// Time derivative of the whole state. Leaves the contact forces in
    /// [`Dynamics::forces`].
    pub(crate) fn derivative(
        &mut self,
        contacts: &Contacts,
        ground: Grounds,
        state: &[f64],
        out: &mut [f64],
    ) {
        let n = self.layout.dofs;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        out[..n].copy_from_slice(v);
        let now = Instant::committed(ground);
        let (input, viscous) = self.accelerations(contacts, now, state, &mut out[n..2 * n]);
        out[2 * n..].fill(0.0);
        for (element, history) in self.elements(contacts) {
            let range = element.range(self.layout);
            let (before, rates) = (&state[range.clone()], &mut out[range]);
            element
                .law
                .rates(history, element.motion(u, v), before, rates);
        }
        out[self.layout.input()] = input;
        out[self.layout.viscous()] = viscous;
        for &l in contacts.closed() {
            let rate = self.system.levels()[l].relative(v);
            out[self.layout.work(l)] = self.forces[l] * rate;
            out[self.layout.impulse(l)] = self.forces[l];
        }
    }

    /// Elements with their histories.
    fn elements<'c>(
        &self,
        contacts: &'c Contacts,
    ) -> impl Iterator<Item = (&'a Element, &'c History)> + use<'a, 'c> {
        let elements: &'a [Element] = self.system.elements();
        elements.iter().zip(&contacts.elements.histories)
    }

    /// Force (N) of an element at a state.
    pub(crate) fn element_force(
        &mut self,
        contacts: &Contacts,
        index: usize,
        state: &[f64],
        elapsed: Option<f64>,
    ) -> f64 {
        let n = self.layout.dofs;
        let element = &self.system.elements()[index];
        let motion = element.motion(&state[..n], &state[n..2 * n]);
        let variables = &state[element.range(self.layout)];
        self.element_force_at(contacts, index, (motion, variables), elapsed)
    }

    /// The same from its own motion and internal variables.
    pub(crate) fn element_force_at(
        &mut self,
        contacts: &Contacts,
        index: usize,
        (motion, variables): (Motion, &[f64]),
        elapsed: Option<f64>,
    ) -> f64 {
        let element = &self.system.elements()[index];
        let history = &contacts.elements.histories[index];
        let Some(scratch) = &mut self.scratch else {
            return 0.0;
        };
        element
            .response(history, scratch, (motion, variables), elapsed)
            .force
    }

    /// Accelerations relative to the ground (m/s2) at a state, of which the part that
    /// moves is enough. Returns the power of the ground motion and of the viscous
    /// damping (W).
    pub(crate) fn accelerations(
        &mut self,
        contacts: &Contacts,
        now: Instant,
        state: &[f64],
        out: &mut [f64],
    ) -> (f64, f64) {
        let (n, ground) = (self.layout.dofs, now.ground);
        let system = self.system;
        let (u, v) = (&state[..n], &state[n..2 * n]);
        self.system.internal_forces(u, v, out, &mut self.damping);
        self.net.fill(0.0);
        for index in 0..contacts.elements.histories.len() {
            let force = self.element_force(contacts, index, state, now.elapsed);
            let element = &self.system.elements()[index];
            let carried = element.carried * element.relative(u);
            element.pull(force - carried, &mut self.net);
        }
        self.list_stuck(contacts);
        for &l in contacts.closed() {
            let Some(contact) = contacts.contact(l).filter(|c| !c.is_stuck()) else {
                continue;
            };
            let level = &self.system.levels()[l];
            let force = contact
                .force(
                    level,
                    contacts.penetration(self.system, l, u),
                    level.relative(v),
                )
                .value;
            self.forces[l] = force;
            push_apart(level, force, &mut self.net);
        }
        let (mut input, mut viscous) = (0.0, 0.0);
        let mass = system.mass();
        let with_mass = system.with_mass();
        for i in 0..out.len() {
            let ground = system.load_on(i, ground);
            if i < with_mass {
                input -= mass[i] * v[i] * ground;
            }
            viscous += v[i] * self.damping[i];
            out[i] = (out[i] + self.net[i]) / mass[i] - ground;
        }
        if !self.stuck.is_empty() {
            self.hold(out);
        }
        if with_mass < out.len() {
            input += self.power_of_ground(contacts, now, state);
        }
        (input, viscous)
    }

    /// Power (W) that ground which moves by itself on either side puts into contacts and links.
    fn power_of_ground(&mut self, contacts: &Contacts, now: Instant, state: &[f64]) -> f64 {
        let (n, system) = (self.layout.dofs, self.system);
        let v = &state[n..2 * n];
        let mut power = 0.0;
        for &l in contacts.closed() {
            power += self.forces[l] * system.levels()[l].terms.ground_of(|i| v[i]);
        }
        for (index, element) in system.elements().iter().enumerate() {
            let rate = element.terms.ground_of(|i| v[i]);
            if rate != 0.0 {
                power += rate * self.element_force(contacts, index, state, now.elapsed);
            }
        }
        power
    }

    /// Acceleration of floor `i` alone relative to the ground (m/s2), from the components
    /// `at` of the state; `None` where it depends on more than its neighbours.
    pub(crate) fn acceleration_of(
        &self,
        contacts: &Contacts,
        (i, ground): (usize, Grounds),
        at: impl Fn(usize) -> f64,
    ) -> Option<f64> {
        let (n, system) = (self.layout.dofs, self.system);
        let alone = system.is_plain()
            && system.elements().is_empty()
            && (contacts.closed().iter())
                .all(|&l| contacts.contact(l).is_none_or(|c| !c.is_stuck()));
        if !alone {
            return None;
        }
        let mut force = -system.resistance_of(i, &at, &|j| at(n + j));
        for &l in contacts.closed() {
            let level = &system.levels()[l];
            let sign = match (level.left == Some(i), level.right == Some(i)) {
                (true, _) => -1.0,
                (_, true) => 1.0,
                _ => continue,
            };
            let relative = |offset: usize| {
                let one = |floor: Option<usize>| floor.map_or(0.0, |j| at(offset + j));
                one(level.left) - one(level.right)
            };
            if let Some(contact) = contacts.contact(l) {
                let penetration = relative(0) - contacts.width(l);
                force += sign * contact.force(level, penetration, relative(n)).value;
            }
        }
        Some(force / system.mass()[i] - ground.first)
    }

    /// Contact forces of the levels that are stuck, into [`Dynamics::forces`], from the
    /// components `at` of the state that their own floors call for: the bits of
    /// [`Dynamics::accelerations`] for little of its work where damping couples many floors.
    /// Returns false, and does nothing, where it would not be so.
    pub(crate) fn held_by_itself(
        &mut self,
        contacts: &Contacts,
        ground: Grounds,
        at: &impl Fn(usize) -> f64,
    ) -> bool {
        let system = self.system;
        if !system.is_plain() || !system.elements().is_empty() || system.bands().is_some() {
            return false;
        }
        self.list_stuck(contacts);
        self.solve_holding(|dynamics, level| {
            level.relative_of(|i| dynamics.released_acceleration_of(contacts, (i, ground), at))
        });
        true
    }

    /// Acceleration of floor `i` alone relative to the ground (m/s2) while levels are stuck,
    /// after [`Dynamics::held_by_itself`] at the same place.
    pub(crate) fn held_acceleration_of(
        &self,
        contacts: &Contacts,
        (i, ground): (usize, Grounds),
        at: &impl Fn(usize) -> f64,
    ) -> f64 {
        let mut net = 0.0;
        for &l in &self.stuck {
            push_floor(&self.system.levels()[l], self.forces[l], i, &mut net);
        }
        self.released_acceleration_of(contacts, (i, ground), at) + net / self.system.mass()[i]
    }

    /// Acceleration of floor `i` without the forces that hold stuck levels.
    fn released_acceleration_of(
        &self,
        contacts: &Contacts,
        (i, ground): (usize, Grounds),
        at: &impl Fn(usize) -> f64,
    ) -> f64 {
        let (n, system) = (self.layout.dofs, self.system);
        let rate = |j: usize| at(n + j);
        let mut net = 0.0;
        for &l in contacts.closed() {
            let level = &system.levels()[l];
            if level.left != Some(i) && level.right != Some(i) {
                continue;
            }
            if let Some(contact) = contacts.contact(l).filter(|c| !c.is_stuck()) {
                let penetration = level.relative_of(at) - contacts.width(l);
                let force = contact.force(level, penetration, level.relative_of(rate));
                push_floor(level, force.value, i, &mut net);
            }
        }
        (-system.resistance_of(i, at, &rate) + net) / system.mass()[i] - ground.first
    }

    /// Collects the levels that are stuck.
    fn list_stuck(&mut self, contacts: &Contacts) {
        let stuck = |l: &usize| contacts.contact(*l).is_some_and(|c| c.is_stuck());
        self.stuck.clear();
        let levels = contacts.closed().iter().copied();
        self.stuck.extend(levels.filter(stuck));
    }

    /// Solves for the forces that keep the relative accelerations of stuck levels zero, from
    /// those that they would have without them.
    fn solve_holding(&mut self, relative: impl Fn(&Self, &ContactLevel) -> f64) {
        let (levels, mass) = (self.system.levels(), self.system.mass());
        self.right.clear();
        for k in 0..self.stuck.len() {
            let right = relative(self, &levels[self.stuck[k]]);
            self.right.push(right);
        }
        // The levels that are stuck stay so over many evaluations.
        if self.prepared != self.stuck {
            self.matrix.clear();
            for &l in &self.stuck {
                for &m in &self.stuck {
                    self.matrix.push(coupling(&levels[l], &levels[m], mass));
                }
            }
            self.prepared.clone_from(&self.stuck);
            self.regular = self.solver.prepare(&self.matrix, self.stuck.len());
        }
        // The matrix is positive definite unless floors are wedged between two walls,
        // where contact forces are not unique; that surfaces as a rejected step.
        match self.regular {
            true => self.solver.solve_prepared(&mut self.right),
            false => self.right.fill(f64::NAN),
        }
        for (l, force) in self.stuck.iter().zip(&self.right) {
            self.forces[*l] = *force;
        }
    }

    /// Adds the forces that keep the relative accelerations of stuck levels zero.
    fn hold(&mut self, accelerations: &mut [f64]) {
        self.solve_holding(|_, level| level.relative(accelerations));
        let (levels, mass) = (self.system.levels(), self.system.mass());
        self.net.fill(0.0);
        for &l in &self.stuck {
            push_apart(&levels[l], self.forces[l], &mut self.net);
        }
        for ((a, f), m) in accelerations.iter_mut().zip(&self.net).zip(mass) {
            *a += f / m;
        }
    }
}

/// Adds a contact force to the floors of a level. A floor has at most one
/// neighbour on either side, so its sum has two terms and commutes: a mirrored
/// case gives the same bits.
pub(crate) fn push_apart(level: &ContactLevel, force: f64, net: &mut [f64]) {
    if let Some(l) = level.left {
        net[l] -= force;
    }
    if let Some(r) = level.right {
        net[r] += force;
    }
    level.terms.push(force, net);
}

/// The same for floor `i` alone.
fn push_floor(level: &ContactLevel, force: f64, i: usize, net: &mut f64) {
    if level.left == Some(i) {
        *net -= force;
    }
    if level.right == Some(i) {
        *net += force;
    }
}

/// Relative acceleration at level `a` caused by a unit force that pulls the
/// floors of level `b` together: `g_a' M^-1 g_b`.
pub(crate) fn coupling(a: &ContactLevel, b: &ContactLevel, mass: &[f64]) -> f64 {
    let term = |x: Option<usize>, y: Option<usize>, sign: f64| match (x, y) {
        (Some(i), Some(j)) if i == j => sign / mass[i],
        _ => 0.0,
    };
    let of_floors = (term(a.left, b.left, 1.0) + term(a.right, b.right, 1.0))
        + (term(a.left, b.right, -1.0) + term(a.right, b.left, -1.0));
    if a.terms.is_empty() && b.terms.is_empty() {
        return of_floors;
    }
    let weights = |level: &ContactLevel| -> Vec<(usize, f64)> {
        let ends = [(level.left, 1.0), (level.right, -1.0)].into_iter();
        let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
        ends.chain(level.terms.pushed.iter().copied()).collect()
    };
    let of_b = weights(b);
    let products = weights(a).into_iter().map(|(i, w)| {
        let same = of_b.iter().filter(|(j, _)| *j == i);
        same.map(|(_, other)| w * other / mass[i]).sum::<f64>()
    });
    products.sum()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::sync::Arc;

    use pounding_gap_element::{Memory, ModelParameters, Phase, registry};
    use pounding_shear_building::{Damping, ShearBuilding};

    use super::*;
    use crate::contact::Contact;
    use crate::system::{Floor, GroundAcceleration};

    /// Two buildings with modal damping and a wall on the right: levels 0 and 2 of the gap
    /// and that of the wall are stuck, level 1 of the gap is in approach, level 3 is open.
    fn held(storeys: [usize; 2]) -> (System, Contacts) {
        let building = |name: &str, n: usize| {
            let of = |base: f64, step: f64| (0..n).map(|i| base + step * i as f64).collect();
            let damping = Damping::Modal { ratios: vec![0.05] };
            let (mass, stiffness) = (of(45.0e3, 117.0), of(5.482e6, -3019.0));
            let heights = vec![3.0; n];
            Arc::new(ShearBuilding::new(name.into(), mass, stiffness, heights, damping).unwrap())
        };
        let buildings = vec![building("left", storeys[0]), building("right", storeys[1])];
        let ground = GroundAcceleration {
            samples: vec![0.0; 2].into(),
            time_step: 0.01,
        };
        let mut system = System::new(buildings, ground);
        let parameters =
            ModelParameters::from_pairs(&[("stiffness", 93.5e6), ("restitution", 0.65)]);
        let model: Arc<dyn pounding_gap_element::ImpactModel> =
            registry::build("anagnostopoulos_1988", &parameters)
                .unwrap()
                .into();
        let pair = |left, right| (left, right, 0.01, Arc::clone(&model));
        let across = (0..4).map(|s| pair(Floor::Storey(0, s), Floor::Storey(1, s)));
        let names = |a: &str, b: &str| [a.to_owned(), b.to_owned()];
        system
            .add_gap("gap", names("left", "right"), across.collect())
            .unwrap();
        let last = vec![pair(Floor::Storey(1, 2), Floor::Wall)];
        system.add_gap("end", names("right", "wall"), last).unwrap();
        let mut contacts = Contacts::all_open(&system);
        for (level, phase) in [
            (0, Phase::Stuck),
            (1, Phase::Approach),
            (2, Phase::Stuck),
            (4, Phase::Stuck),
        ] {
            let mass = system.levels()[level].effective_mass;
            let contact = Contact {
                phase,
                collision: model.begin(0.3, mass),
                memory: Memory::default(),
            };
            contacts.close(level, contact);
        }
        (system, contacts)
    }

    #[test]
    fn floors_that_are_held_have_the_same_bits_each_alone_as_together() {
        for storeys in [[13, 9], [150, 37]] {
            let (system, contacts) = held(storeys);
            let mut dynamics = Dynamics::new(&system);
            let n = dynamics.layout.dofs;
            let state: Vec<f64> = (0..dynamics.layout.dimension())
                .map(|k| 0.02 * libm::sin((3 * k) as f64))
                .collect();
            let ground = Grounds {
                first: -1.37,
                interval: 0,
                tau: 0.0,
            };
            let mut together = vec![0.0; n];
            let now = Instant::committed(ground);
            dynamics.accelerations(&contacts, now, &state, &mut together);
            let forces = dynamics.forces.clone();
            assert!(forces[0].abs() > 1.0 && forces[4].abs() > 1.0, "{forces:?}");
            dynamics.forces.fill(f64::NAN);
            let at = |k: usize| state[k];
            assert!(dynamics.held_by_itself(&contacts, ground, &at));
            for l in [0, 2, 4] {
                assert_eq!(dynamics.forces[l].to_bits(), forces[l].to_bits(), "{l}");
            }
            for (i, together) in together.iter().enumerate() {
                let alone = dynamics.held_acceleration_of(&contacts, (i, ground), &at);
                assert_eq!(alone.to_bits(), together.to_bits(), "floor {i}");
            }
        }
    }
}
