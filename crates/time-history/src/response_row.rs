//! One row of responses from the motion of the floors.

use pounding_shear_building::{ResponseKind, StiffnessMatrix};

use crate::contact::Contacts;
use crate::dynamics::Layout;
use crate::ledger;
use crate::recorder::History;
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

/// Rows of shear buildings on rigid ground without elements and without responses with names, in one
/// pass over the floors. The bits are those of [`append_motion`] and of the ledger.
#[derive(Debug)]
pub(crate) struct ShearRows {
    floors: Vec<Storey>,
}

/// A floor with the storey below it.
#[derive(Debug, Clone, Copy)]
struct Storey {
    /// Half of the mass (kg).
    half_mass: f64,
    /// Stiffness (N/m), and half of that with gravity.
    stiffness: f64,
    half_spring: f64,
    /// Whether it is the first of its building.
    is_first: bool,
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
        let stiffnesses = system.buildings().iter().flat_map(|b| {
            let stiffness = b.stiffness().iter().enumerate();
            stiffness.map(|(storey, k)| (storey == 0, *k))
        });
        let floors = system.mass().iter().zip(system.springs()).zip(stiffnesses);
        let floors = floors.map(|((mass, spring), (is_first, stiffness))| Storey {
            half_mass: 0.5 * mass,
            stiffness,
            half_spring: 0.5 * spring,
            is_first,
        });
        Some(Self {
            floors: floors.collect(),
        })
    }

    /// Appends responses but for accelerations, from the displacements and velocities of the
    /// floors, the works in the state, and the contact forces of all levels, of which those that
    /// are closed count.
    pub(crate) fn append(
        &self,
        (system, layout, contacts): (&System, Layout, &Contacts),
        (time, ground): (f64, f64),
        [u, v]: [&[f64]; 2],
        (state, forces): (&[f64], &[f64]),
        rows: &mut History,
    ) {
        let (u, v) = (&u[..self.floors.len()], &v[..self.floors.len()]);
        append_floors_and_levels(
            (system, layout, contacts),
            (time, ground),
            [u, v],
            forces,
            rows,
        );
        let (mut kinetic, mut strain, mut last) = (0.0, 0.0, 0.0);
        for (floor, (u, v)) in self.floors.iter().zip(u.iter().zip(v)) {
            let below = if floor.is_first { 0.0 } else { last };
            last = *u;
            let drift = u - below;
            kinetic += floor.half_mass * v * v;
            strain += floor.half_spring * drift * drift;
            rows.storey_shear.push(floor.stiffness * drift);
        }
        let stored = ledger::stored_energies(system, contacts, u);
        let energies = (kinetic, strain + stored, 0.0);
        let energy = ledger::balance(layout, state, energies, stored);
        rows.energy.push(energy);
    }
}
