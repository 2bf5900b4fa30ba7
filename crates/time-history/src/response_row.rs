//! One row of responses from the motion of the floors.

use pounding_shear_building::{ResponseKind, StiffnessMatrix};
use pounding_vectorised::vectorised;

use crate::contact::Contacts;
use crate::history::History;
use crate::layout::Layout;
use crate::ledger::{self, Works};
use crate::system::modes::{BlockMotion, ContactFree, Lane, WIDTH, restore, sum, sums_of_row};
use crate::system::{SectionPlace, System};

/// Appends responses but for accelerations, elements and energies, from a full state and the
/// contact forces of all levels, of which those that are closed count.
#[inline]
pub(crate) fn append_motion(
    (system, layout, contacts): (&System, Layout, &Contacts),
    (time, ground): (f64, f64),
    (state, forces): (&[f64], &[f64]),
    rows: &mut History,
) {
    let n = layout.dofs;
    let (u, v) = (&state[..n], &state[n..2 * n]);
    let force = append_floors_and_levels(
        (system, layout, contacts),
        (time, ground),
        [u, v],
        forces,
        rows,
    );
    let response = rows.response.len();
    rows.response
        .resize(response + system.named_responses(), 0.0);
    for row in system.level_rows() {
        let sum: f64 = row.terms.iter().map(|(i, w)| w * u[*i]).sum();
        let force = rows.force[force + row.level];
        rows.response.push(sum + row.by_force * force);
    }
    let mut sections = system.sections().iter();
    for (building, range) in system.buildings().iter().zip(system.offsets().windows(2)) {
        let stiffness = building.stiffness();
        if !stiffness.is_empty() {
            let mut below = 0.0;
            let shear = stiffness.iter().zip(&u[range[0]..range[1]]).map(|(k, u)| {
                let drift = u - below;
                below = *u;
                k * drift
            });
            rows.storey_shear.extend(shear);
            continue;
        }
        let shears = sections.by_ref().take(building.storeys());
        rows.storey_shear.extend(shears.map(|s| s.at(u)));
        rows.base_moment.extend(sections.next().map(|s| s.at(u)));
        let drifts = building.drifts().map_or(0, <[_]>::len);
        let drifts = sections.by_ref().take(drifts);
        rows.drift.extend(drifts.map(|s| s.at(u)));
        let named = building.responses().iter();
        let named = named
            .filter(|r| r.kind == ResponseKind::Displacement)
            .count();
        for row in sections.by_ref().take(named) {
            if let SectionPlace::Named(number) = row.place {
                rows.response[response + number] = row.at(u);
            }
        }
    }
}

/// Appends what all rows begin with: floors, and penetrations and forces of levels. Returns where
/// the forces of this row begin.
#[inline]
fn append_floors_and_levels(
    (system, layout, contacts): (&System, Layout, &Contacts),
    (time, ground): (f64, f64),
    [u, v]: [&[f64]; 2],
    forces: &[f64],
    rows: &mut History,
) -> usize {
    rows.time.push(time);
    rows.ground_acceleration.push(ground);
    rows.displacement.extend_from_slice(&u[..system.floors()]);
    rows.velocity.extend_from_slice(&v[..system.floors()]);
    let levels = system.levels().iter().zip(contacts.widths());
    let penetration = levels.map(|(level, width)| level.relative(u) - width);
    rows.penetration.extend(penetration);
    let force = rows.force.len();
    rows.force.resize(force + layout.levels, 0.0);
    for &l in contacts.closed() {
        rows.force[force + l] = forces[l];
    }
    force
}

/// Rows of shear buildings on rigid ground without elements and without responses with names, eight
/// floors at once: as those of [`append_motion`] and of the ledger, but for the order of sums in
/// energies.
#[derive(Debug)]
pub(crate) struct ShearRows {
    storeys: Vec<Storeys>,
    /// Left and right floor of every level; beyond all floors for a wall.
    between: Vec<[usize; 2]>,
    /// Space for shears.
    shear: Vec<f64>,
}

/// Eight floors with the storeys below them.
#[derive(Debug, Clone, Copy, Default)]
struct Storeys {
    /// Halves of the masses (kg).
    half_mass: Lane,
    /// Stiffnesses (N/m), and halves of those with gravity.
    stiffness: Lane,
    half_spring: Lane,
    /// One where a floor has another one below it.
    above: Lane,
}

impl ShearRows {
    /// `None` for systems with anything else.
    pub(crate) fn new(system: &System) -> Option<Self> {
        let mut buildings = system.buildings().iter();
        let is_shear = |matrix: &StiffnessMatrix| !matches!(matrix, StiffnessMatrix::Dense(_));
        let plain = system.is_plain()
            && system.elements().is_empty()
            && system.sections().is_empty()
            && system.named_responses() == 0
            && buildings.all(|b| !b.stiffness().is_empty() && is_shear(b.stiffness_matrix()));
        if !plain {
            return None;
        }
        let mut storeys = vec![Storeys::default(); system.floors().div_ceil(WIDTH)];
        let stiffnesses = system.buildings().iter().flat_map(|b| {
            let stiffness = b.stiffness().iter().enumerate();
            stiffness.map(|(storey, k)| (f64::from(u8::from(storey > 0)), *k))
        });
        let floors = system.mass().iter().zip(system.springs()).zip(stiffnesses);
        for (i, ((mass, spring), (above, stiffness))) in floors.enumerate() {
            let (storeys, l) = (&mut storeys[i / WIDTH], i % WIDTH);
            storeys.half_mass[l] = 0.5 * mass;
            storeys.stiffness[l] = stiffness;
            storeys.half_spring[l] = 0.5 * spring;
            storeys.above[l] = above;
        }
        let wall = storeys.len() * WIDTH;
        let levels = system.levels().iter();
        let between = levels.map(|l| [l.left, l.right].map(|floor| floor.unwrap_or(wall)));
        Some(Self {
            shear: vec![0.0; wall],
            between: between.collect(),
            storeys,
        })
    }

    /// Appends rows at those of the first times that are ends of samples, where all floors make one
    /// lane and nothing touches: as [`Self::append`] does, one after another at a fraction of the
    /// cost. Returns how many they are.
    pub(crate) fn append_free(
        &self,
        motion: &FreeMotion<'_>,
        times: &[f64],
        rows: &mut History,
    ) -> usize {
        match (self.storeys.as_slice(), motion.contacts.closed()) {
            ([storeys], []) => append_free((storeys, &self.between), motion, times, rows),
            _ => 0,
        }
    }

    /// Appends responses but for accelerations, from the displacements and velocities of the
    /// floors, eight after eight with zeros at the end, the works in the state, and the contact
    /// forces of all levels, of which those that are closed count.
    pub(crate) fn append(
        &mut self,
        (system, layout, contacts): (&System, Layout, &Contacts),
        (time, ground): (f64, f64),
        [u, v]: [&[f64]; 2],
        (state, forces): (&[f64], &[f64]),
        rows: &mut History,
    ) {
        append_floors_and_levels(
            (system, layout, contacts),
            (time, ground),
            [u, v],
            forces,
            rows,
        );
        let (kinetic, strain) = shears(&self.storeys, [u, v], &mut self.shear);
        rows.storey_shear
            .extend_from_slice(&self.shear[..system.floors()]);
        let stored = ledger::stored_energies(system, contacts, u);
        let energies = (kinetic, strain + stored, 0.0);
        let works = Works::in_state(layout, state);
        let energy = ledger::balance(works, energies, stored);
        rows.energy.push(energy);
    }
}

/// Motion without contact over some samples.
pub(crate) struct FreeMotion<'a> {
    pub system: &'a System,
    pub layout: Layout,
    pub contacts: &'a Contacts,
    pub constants: &'a ContactFree,
    pub block: &'a BlockMotion<'a>,
    /// Works at the start.
    pub state: &'a [f64],
    /// Times (s) this far apart are one.
    pub close: f64,
}

#[vectorised]
fn append_free(
    (storeys, between): (&Storeys, &[[usize; 2]]),
    motion: &FreeMotion<'_>,
    times: &[f64],
    rows: &mut History,
) -> usize {
    let [shapes] = motion.constants.floor_rows.as_slice() else {
        return 0;
    };
    let (modes, floors) = (&motion.constants.modes[..1], motion.system.floors());
    let start = Works::in_state(motion.layout, motion.state);
    for (served, time) in times.iter().enumerate() {
        let Some((modal, ground)) = motion.block.at_end_of_sample(*time, motion.close) else {
            return served;
        };
        let (q, p) = (&modal.displacement[..1], &modal.velocity[..1]);
        let mut absolute = [Lane::ZERO];
        restore(modes, q, p, &mut absolute);
        let [u, v, absolute] = sums_of_row(shapes, [q, p, &absolute]);
        let mut energies = [Lane::ZERO; 2];
        let shear = storeys.shear((0.0, &u.0, &v.0), &mut energies);
        // Eight places at once, of which those that are no floors go again.
        for (list, lane) in [
            (&mut rows.displacement, u),
            (&mut rows.velocity, v),
            (&mut rows.acceleration_absolute, absolute),
            (&mut rows.storey_shear, shear),
        ] {
            let end = list.len() + floors;
            list.extend_from_slice(&lane.0);
            list.truncate(end);
        }
        rows.time.push(*time);
        rows.ground_acceleration.push(ground);
        let at = |floor: usize| u.0.get(floor).copied().unwrap_or(0.0);
        for ([left, right], width) in between.iter().zip(motion.contacts.widths()) {
            rows.penetration.push(at(*left) - at(*right) - width);
            rows.force.push(0.0);
        }
        let works = Works {
            input: start.input + sum(modal.input),
            viscous: start.viscous + sum(modal.viscous),
            ..start
        };
        let [kinetic, strain] = energies.map(|lane| sum(&[lane]));
        let energy = ledger::balance(works, (kinetic, strain, 0.0), 0.0);
        rows.energy.push(energy);
    }
    times.len()
}

impl Storeys {
    /// Shears of eight storeys from the displacement of the floor below them, and displacements
    /// and velocities of the floors above each. Adds kinetic energy and that of strain (J).
    #[inline(always)]
    fn shear(
        &self,
        (last, u, v): (f64, &[f64; WIDTH], &[f64; WIDTH]),
        [kinetic, strain]: &mut [Lane; 2],
    ) -> Lane {
        let mut below = [last; WIDTH];
        below[1..].copy_from_slice(&u[..WIDTH - 1]);
        let mut shear = Lane::ZERO;
        for l in 0..WIDTH {
            let drift = u[l] - self.above[l] * below[l];
            kinetic[l] += self.half_mass[l] * v[l] * v[l];
            strain[l] += self.half_spring[l] * drift * drift;
            shear[l] = self.stiffness[l] * drift;
        }
        shear
    }
}

/// Works out storey shears. Returns kinetic energy and that of strain (J).
#[vectorised]
fn shears(storeys: &[Storeys], [u, v]: [&[f64]; 2], shear: &mut [f64]) -> (f64, f64) {
    let mut energies = [Lane::ZERO; 2];
    let mut last = 0.0;
    let motion = u
        .as_chunks::<WIDTH>()
        .0
        .iter()
        .zip(v.as_chunks::<WIDTH>().0);
    let shear = shear.as_chunks_mut::<WIDTH>().0;
    for ((storeys, (u, v)), shear) in storeys.iter().zip(motion).zip(shear) {
        *shear = storeys.shear((last, u, v), &mut energies).0;
        last = u[WIDTH - 1];
    }
    let [kinetic, strain] = energies.map(|lane| sum(&[lane]));
    (kinetic, strain)
}
