//! What is integrated: buildings in a row, contact levels between them, ground motion.

mod level_place;
mod links;
mod sections;
mod under;
mod unequal_floors;

use nalgebra::DMatrix;
use pounding_gap_element::ImpactModel;
use pounding_shear_building::{
    DampingMatrix, ELEVATION_TOLERANCE, ShearBuilding, StiffnessMatrix, SymmetricTridiagonal,
};
use std::sync::{Arc, OnceLock};

pub use level_place::LevelPlace;
use links::storeys;
pub use links::{Link, LinkedPair};
use sections::section_forces;
pub(crate) use sections::{SectionForce, SectionPlace};
pub use unequal_floors::UnequalFloors;
pub use unequal_floors::more_pairs;

use crate::bands::Bands;
use crate::contact_free::ContactFree;
use crate::elements::Element;
use crate::error::TimeHistoryError;

/// One pair of floors (or a floor and a rigid wall) that may touch.
#[derive(Debug, Clone)]
pub struct ContactLevel {
    /// Degree of freedom of the left floor; `None` is a rigid wall that moves
    /// with the ground.
    pub left: Option<usize>,
    /// Degree of freedom of the right floor; `None` is a rigid wall.
    pub right: Option<usize>,
    /// Storeys and elevations of both floors.
    pub place: LevelPlace,
    /// Width of the gap at rest (m).
    pub width: f64,
    /// `m1 m2 / (m1 + m2)`, the floor's mass against a wall (kg).
    pub effective_mass: f64,
    /// The impact model that acts here.
    pub model: Arc<dyn ImpactModel>,
}

/// A gap: the contact levels between two neighbours.
#[derive(Debug, Clone)]
pub struct Gap {
    /// Name in the case file and the result.
    pub name: String,
    /// Names of the left and right neighbour, `wall` for a rigid wall.
    pub between: [String; 2],
    /// Range of the gap's levels in [`System::levels`].
    pub first_level: usize,
    /// Number of levels.
    pub levels: usize,
    /// Floors whose elevations differ by no more than this are level (m).
    pub elevation_tolerance: f64,
}

/// A ground acceleration, linear between equally spaced samples and zero after
/// the last.
#[derive(Debug, Clone)]
pub struct GroundAcceleration {
    /// Samples (m/s2), the first at time zero.
    pub samples: Arc<[f64]>,
    /// Time step (s).
    pub time_step: f64,
}

/// A floor's place in a contact level, for the definition of a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Floor {
    /// Building index in the row and storey index, both from zero.
    Storey(usize, usize),
    /// A rigid wall that moves with the ground.
    Wall,
}

/// Buildings in a row with the gaps between them under one ground motion.
///
/// Degrees of freedom are floor displacements relative to the ground, positive
/// to the right, one building after another from the left, bottom floor first.
#[derive(Debug, Clone)]
pub struct System {
    buildings: Vec<Arc<ShearBuilding>>,
    offsets: Vec<usize>,
    gaps: Vec<Gap>,
    levels: Vec<ContactLevel>,
    ground: GroundAcceleration,
    mass: Vec<f64>,
    /// Displacements, then velocities at time zero.
    initial: Vec<f64>,
    /// Stiffness of every storey that stores strain energy (N/m): what its law does not.
    spring: Vec<f64>,
    elements: Vec<Element>,
    sections: Vec<SectionForce>,
    links: Vec<Link>,
    bands: Option<Bands>,
    /// What contact-free motion needs, made when it is first asked for; shared by all systems with
    /// these buildings and this step.
    contact_free: Arc<OnceLock<Option<ContactFree>>>,
}

impl System {
    /// Buildings without gaps under a ground motion.
    #[must_use]
    pub fn new(buildings: Vec<Arc<ShearBuilding>>, ground: GroundAcceleration) -> Self {
        let mut offsets = vec![0];
        let mut mass = Vec::new();
        for building in &buildings {
            mass.extend_from_slice(building.mass());
            offsets.push(mass.len());
        }
        let (spring, elements) = storeys(&buildings, &offsets);
        let sections = section_forces(&buildings, &offsets);
        Self {
            offsets,
            gaps: Vec::new(),
            levels: Vec::new(),
            spring,
            elements,
            sections,
            links: Vec::new(),
            ground,
            initial: vec![0.0; 2 * mass.len()],
            bands: Bands::of(&buildings),
            contact_free: Arc::default(),
            buildings,
            mass,
        }
    }

    /// The same system, let go at time zero from these floor displacements (m) and
    /// velocities (m/s) relative to the ground, buildings from the left.
    ///
    /// # Errors
    /// Lists of the wrong length or with a value that is not finite, or floors that
    /// overlap across a gap.
    pub fn with_initial_state(
        mut self,
        displacement: &[f64],
        velocity: &[f64],
    ) -> Result<Self, TimeHistoryError> {
        let n = self.mass.len();
        let initial: Vec<f64> = displacement.iter().chain(velocity).copied().collect();
        let wrong = displacement.len() != n || velocity.len() != n;
        if wrong || !initial.iter().all(|x| x.is_finite()) {
            return Err(TimeHistoryError::InitialState {
                reason: format!("it takes {n} finite displacements and as many velocities"),
            });
        }
        for (l, level) in self.levels.iter().enumerate() {
            let overlap = level.relative(displacement) - level.width;
            if overlap > 0.0 {
                return Err(TimeHistoryError::InitialState {
                    reason: format!("gap {} overlaps by {overlap} m", self.name_of_level(l)),
                });
            }
        }
        self.initial = initial;
        Ok(self)
    }

    /// Displacements (m), then velocities (m/s) of all floors at time zero.
    #[must_use]
    pub fn initial_state(&self) -> &[f64] {
        &self.initial
    }

    /// Adds a gap. `pairs` holds left floor, right floor, width (m) and model of
    /// each contact level. Floors are level within [`ELEVATION_TOLERANCE`]; those that are
    /// not act on each other as if they were, with a warning ([`System::unequal_floor_warnings`]).
    ///
    /// # Errors
    /// A floor that does not exist, a level between two walls, a width that is negative or
    /// not finite, or floors that overlap at time zero.
    pub fn add_gap(
        &mut self,
        name: &str,
        between: [String; 2],
        pairs: Vec<(Floor, Floor, f64, Arc<dyn ImpactModel>)>,
    ) -> Result<(), TimeHistoryError> {
        self.add_gap_with_tolerance(name, between, pairs, ELEVATION_TOLERANCE)
    }

    /// The same with an elevation tolerance (m).
    ///
    /// # Errors
    /// As [`System::add_gap`].
    pub fn add_gap_with_tolerance(
        &mut self,
        name: &str,
        between: [String; 2],
        pairs: Vec<(Floor, Floor, f64, Arc<dyn ImpactModel>)>,
        elevation_tolerance: f64,
    ) -> Result<(), TimeHistoryError> {
        let first_level = self.levels.len();
        let count = pairs.len();
        for (left, right, width, model) in pairs {
            let level = self.contact_level(name, left, right, width, model)?;
            let overlap = level.relative(&self.initial[..self.mass.len()]) - level.width;
            if overlap > 0.0 {
                return Err(TimeHistoryError::InitialState {
                    reason: format!("gap {name} overlaps by {overlap} m at time zero"),
                });
            }
            self.levels.push(level);
        }
        self.gaps.push(Gap {
            name: name.to_owned(),
            between,
            first_level,
            levels: count,
            elevation_tolerance,
        });
        Ok(())
    }

    fn contact_level(
        &self,
        name: &str,
        left: Floor,
        right: Floor,
        width: f64,
        model: Arc<dyn ImpactModel>,
    ) -> Result<ContactLevel, TimeHistoryError> {
        let wrong = |reason: String| TimeHistoryError::GapDefinition {
            gap: name.to_owned(),
            reason,
        };
        if !(width.is_finite() && width >= 0.0) {
            return Err(wrong(format!(
                "width is {width} m; it must be zero or more"
            )));
        }
        let place = |floor: Floor| -> Result<Option<(usize, usize, f64, f64)>, TimeHistoryError> {
            let Floor::Storey(b, s) = floor else {
                return Ok(None);
            };
            let building = self.buildings.get(b).filter(|x| s < x.storeys());
            let name = || self.buildings.get(b).map_or("the building", |b| b.name());
            let building =
                building.ok_or_else(|| wrong(format!("{} has no storey {}", name(), s + 1)))?;
            Ok(Some((
                self.offsets[b] + s,
                s + 1,
                building.mass()[s],
                building.elevations()[s],
            )))
        };
        let (l, r) = (place(left)?, place(right)?);
        let effective_mass = match (l, r) {
            (Some(a), Some(b)) => a.2 * b.2 / (a.2 + b.2),
            (Some(a), None) | (None, Some(a)) => a.2,
            (None, None) => return Err(wrong("a level lies between two walls".to_owned())),
        };
        Ok(ContactLevel {
            left: l.map(|x| x.0),
            right: r.map(|x| x.0),
            place: LevelPlace {
                storeys: [l, r].map(|x| x.map(|x| x.1)),
                elevations: [l, r].map(|x| x.map(|x| x.3)),
            },
            width,
            effective_mass,
            model,
        })
    }

    /// The same buildings and ground motion without gaps and links: the isolated run.
    /// What depends on them alone is computed once for all systems made this way from one another, so that
    /// a sweep over gaps should make its systems by this and [`System::add_gap`].
    #[must_use]
    pub fn isolated(&self) -> Self {
        Self {
            gaps: Vec::new(),
            levels: Vec::new(),
            elements: storeys(&self.buildings, &self.offsets).1,
            links: Vec::new(),
            ..self.clone()
        }
    }

    /// The same buildings, links and ground motion without gaps: what would happen if the
    /// floors never touched. Shares as [`System::isolated`] does.
    #[must_use]
    pub fn without_gaps(&self) -> Self {
        Self {
            gaps: Vec::new(),
            levels: Vec::new(),
            ..self.clone()
        }
    }

    /// Constants of contact-free motion; `None` if the damping of a building couples its modes,
    /// or where elements have a memory.
    pub(crate) fn contact_free(&self) -> Option<&ContactFree> {
        if !self.elements.is_empty() {
            return None;
        }
        let step = self.ground.time_step;
        let constants = self
            .contact_free
            .get_or_init(|| ContactFree::new(self, step));
        constants.as_ref()
    }

    /// Buildings from the left.
    #[must_use]
    pub fn buildings(&self) -> &[Arc<ShearBuilding>] {
        &self.buildings
    }

    /// First degree of freedom of each building, and the total at the end.
    #[must_use]
    pub fn offsets(&self) -> &[usize] {
        &self.offsets
    }

    /// Gaps in the order of the case file.
    #[must_use]
    pub fn gaps(&self) -> &[Gap] {
        &self.gaps
    }

    /// Contact levels of all gaps, gap after gap, from the bottom.
    #[must_use]
    pub fn levels(&self) -> &[ContactLevel] {
        &self.levels
    }

    /// Contact levels of one gap, from the bottom.
    #[must_use]
    pub fn levels_of(&self, gap: &Gap) -> &[ContactLevel] {
        &self.levels[gap.first_level..gap.first_level + gap.levels]
    }

    /// The building on isolators beside a contact level, the left one of two.
    #[must_use]
    pub fn isolated_beside(&self, level: &ContactLevel) -> Option<&ShearBuilding> {
        let sides = [level.left, level.right].into_iter().flatten();
        let buildings = sides.map(|floor| {
            let index = self.offsets.partition_point(|first| *first <= floor) - 1;
            self.buildings[index].as_ref()
        });
        buildings.into_iter().find(|b| b.isolator().is_some())
    }

    /// Gap, storeys and elevations of a contact level, in words: the level of that number
    /// in [`System::levels`].
    #[must_use]
    pub fn name_of_level(&self, level: usize) -> String {
        let mut gaps = self.gaps.iter();
        let gap = gaps.find(|g| (g.first_level..g.first_level + g.levels).contains(&level));
        let gap = gap.map_or("", |g| g.name.as_str());
        format!("{gap} level {}", self.levels[level].place)
    }

    /// Ground acceleration.
    #[must_use]
    pub fn ground(&self) -> &GroundAcceleration {
        &self.ground
    }

    /// Number of degrees of freedom.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        self.mass.len()
    }

    /// Shears and moments that are rows on the floors.
    pub(crate) fn sections(&self) -> &[SectionForce] {
        &self.sections
    }

    /// Matrices of all buildings, if they are all tridiagonal.
    pub(crate) fn bands(&self) -> Option<&Bands> {
        self.bands.as_ref()
    }

    /// Floor masses of all buildings (kg).
    #[must_use]
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Duration of the ground motion (s).
    #[must_use]
    pub fn record_duration(&self) -> f64 {
        self.ground.time_step * self.ground.samples.len().saturating_sub(1) as f64
    }

    /// Storey forces, restoring and damping: `out = -(K u + C v)` (N), with the damping
    /// part `C v` in `scratch`. Neighbours enter with zeros at most, so that a
    /// building's bits do not depend on them.
    pub(crate) fn internal_forces(
        &self,
        u: &[f64],
        v: &[f64],
        out: &mut [f64],
        scratch: &mut [f64],
    ) {
        if let Some(bands) = &self.bands {
            bands.internal_forces(u, v, out, scratch);
            return;
        }
        for (building, range) in self.buildings.iter().zip(self.offsets.windows(2)) {
            let (a, b) = (range[0], range[1]);
            building
                .stiffness_matrix()
                .multiply(&u[a..b], &mut out[a..b]);
            building.apply_damping(&v[a..b], &mut scratch[a..b]);
        }
        for (o, s) in out.iter_mut().zip(scratch.iter()) {
            *o = -(*o + *s);
        }
    }

    /// Row `i` of `K u + C v` alone, which calls for no more of `u` and `v` than it needs.
    pub(crate) fn resistance_of(
        &self,
        i: usize,
        u: &impl Fn(usize) -> f64,
        v: &impl Fn(usize) -> f64,
    ) -> f64 {
        let index = self.offsets.partition_point(|first| *first <= i) - 1;
        let (building, first) = (&self.buildings[index], self.offsets[index]);
        // The matrices are symmetric, and their columns stand together in memory.
        let dense = |matrix: &DMatrix<f64>, x: &dyn Fn(usize) -> f64| -> f64 {
            let column = matrix.column(i - first);
            let entries = column.iter().enumerate();
            entries.map(|(j, c)| c * x(first + j)).sum()
        };
        let band = |matrix: &SymmetricTridiagonal, x: &dyn Fn(usize) -> f64| {
            let row = i - first;
            let mut sum = matrix.diagonal[row] * x(i);
            if row > 0 {
                sum += matrix.off_diagonal[row - 1] * x(i - 1);
            }
            if let Some(k) = matrix.off_diagonal.get(row) {
                sum += k * x(i + 1);
            }
            sum
        };
        let damping = match building.damping_matrix() {
            DampingMatrix::Tridiagonal(c) => band(c, v),
            DampingMatrix::Dense(c) => dense(c, v),
        };
        let restoring = match building.stiffness_matrix() {
            StiffnessMatrix::Tridiagonal(k) => band(k, u),
            StiffnessMatrix::Dense(k) => dense(k, u),
        };
        restoring + damping
    }

    /// Recoverable energy in the linear storeys, and of gravity through P-Delta (J).
    pub(crate) fn strain_energy(&self, u: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (building, range) in self.buildings.iter().zip(self.offsets.windows(2)) {
            let mut below = 0.0;
            let range = range[0]..range[1];
            if let StiffnessMatrix::Dense(k) = building.stiffness_matrix() {
                let u = &u[range];
                for (column, x) in k.column_iter().zip(u) {
                    let force: f64 = column.iter().zip(u).map(|(k, u)| k * u).sum();
                    sum += 0.5 * force * x;
                }
                continue;
            }
            for (k, x) in self.spring[range.clone()].iter().zip(&u[range]) {
                let drift = x - below;
                sum += 0.5 * k * drift * drift;
                below = *x;
            }
        }
        sum
    }

    /// Kinetic energy relative to the ground (J).
    pub(crate) fn kinetic_energy(&self, v: &[f64]) -> f64 {
        self.mass.iter().zip(v).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

impl ContactLevel {
    /// Left minus right of any quantity given per degree of freedom.
    pub(crate) fn relative(&self, x: &[f64]) -> f64 {
        self.relative_of(|i| x[i])
    }

    /// The same, which calls for no more of the quantity than it needs.
    pub(crate) fn relative_of(&self, x: impl Fn(usize) -> f64) -> f64 {
        match (self.left, self.right) {
            (Some(l), Some(r)) => x(l) - x(r),
            (Some(l), None) => x(l),
            (None, Some(r)) => -x(r),
            (None, None) => 0.0,
        }
    }
}
