//! Responses at many times.

use std::ops::Range;

use crate::outcome::Energy;

/// Responses at many times: one list per quantity, row after row in order of time. A row of
/// floors holds the buildings from the left, one of levels or elements their order in the
/// [`System`](crate::System).
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct History {
    /// Times (s).
    pub time: Vec<f64>,
    /// Ground acceleration (m/s2).
    pub ground_acceleration: Vec<f64>,
    /// Floor displacements relative to the ground (m).
    pub displacement: Vec<f64>,
    /// Floor velocities relative to the ground (m/s).
    pub velocity: Vec<f64>,
    /// Absolute floor accelerations (m/s2).
    pub acceleration_absolute: Vec<f64>,
    /// Penetration of every contact level (m), negative while open.
    pub penetration: Vec<f64>,
    /// Contact force of every level (N), zero while open.
    pub force: Vec<f64>,
    /// Storey shears (N), of the law where a storey has one, else elastic.
    pub storey_shear: Vec<f64>,
    /// Overturning moment at the base (N m) of every building with a stiffness matrix, from
    /// the left.
    pub base_moment: Vec<f64>,
    /// Drift of every storey (m) of buildings whose drifts are not the differences of their
    /// floors ([`pounding_shear_building::ShearBuilding::drifts`]), from the left.
    pub drift: Vec<f64>,
    /// Responses with names of all buildings, from the left
    /// ([`pounding_shear_building::ShearBuilding::responses`]), then those of all contact levels
    /// in the order in which they were added ([`System::add_level_response`](crate::System::add_level_response)).
    pub response: Vec<f64>,
    /// Deformation of every element (m).
    pub element_deformation: Vec<f64>,
    /// Force of every element (N).
    pub element_force: Vec<f64>,
    /// Energy that every element has dissipated so far (J).
    pub element_dissipated: Vec<f64>,
    /// Energy ledger.
    pub energy: Vec<Energy>,
}

impl History {
    /// Number of times.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// All lists of numbers.
    fn lists(&mut self) -> [&mut Vec<f64>; 14] {
        [
            &mut self.time,
            &mut self.ground_acceleration,
            &mut self.displacement,
            &mut self.velocity,
            &mut self.acceleration_absolute,
            &mut self.penetration,
            &mut self.force,
            &mut self.storey_shear,
            &mut self.base_moment,
            &mut self.drift,
            &mut self.response,
            &mut self.element_deformation,
            &mut self.element_force,
            &mut self.element_dissipated,
        ]
    }

    /// Removes all rows; what they took of memory is kept for others.
    pub fn clear(&mut self) {
        for list in self.lists() {
            list.clear();
        }
        self.energy.clear();
    }

    /// Moves all rows of another history behind these.
    pub fn append(&mut self, other: &mut Self) {
        for (list, rows) in self.lists().into_iter().zip(other.lists()) {
            list.append(rows);
        }
        self.energy.append(&mut other.energy);
    }

    /// Bytes of its rows.
    pub(crate) fn bytes(&mut self) -> usize {
        let numbers: usize = self.lists().iter().map(|list| list.len()).sum();
        numbers * size_of::<f64>() + self.energy.len() * size_of::<Energy>()
    }

    /// Makes room for so many times the rows that it has.
    pub(crate) fn reserve(&mut self, times: usize) {
        for list in self.lists() {
            list.reserve_exact(times * list.len());
        }
        self.energy.reserve_exact(times * self.energy.len());
    }

    /// Some columns of one of the lists, row after row.
    ///
    /// # Panics
    /// A column that the list does not have.
    #[must_use]
    pub fn columns(&self, values: &[f64], range: Range<usize>) -> Vec<f64> {
        let width = values.len() / self.len().max(1);
        if width == 0 {
            return Vec::new();
        }
        let rows = values.chunks_exact(width);
        let chosen = rows.flat_map(|row| row[range.clone()].iter().copied());
        chosen.collect()
    }

    /// One column of one of the lists.
    ///
    /// # Panics
    /// A column that the list does not have.
    #[must_use]
    pub fn column(&self, values: &[f64], index: usize) -> Vec<f64> {
        self.columns(values, index..index + 1)
    }
}
