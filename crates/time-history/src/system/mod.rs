//! What is integrated: buildings in a row, contact levels between them, ground motion.

mod at_rest;
mod element;
mod level_place;
mod level_response;
mod links;
pub(crate) mod modes;
mod motions;
mod names;
mod place;
pub(crate) mod propagation;
mod sections;
mod segment;
mod terms;
mod under;
mod unequal_floors;

use nalgebra::DMatrix;
use pounding_gap_element::{ImpactModel, Phase, Target};
use pounding_shear_building::{
    DampingMatrix, ELEVATION_TOLERANCE, ShearBuilding, StiffnessMatrix, SymmetricTridiagonal,
};
use std::sync::{Arc, OnceLock};

pub(crate) use at_rest::TOUCH;
pub use element::{Element, ElementPlace};
pub use level_place::{LevelPlace, LinkedMotion};
use level_response::LevelRow;
pub use level_response::{LevelMotion, LevelResponse};
use links::storeys;
pub use links::{Link, LinkedPair};
use motions::Motions;
pub use motions::{FloorForce, ForceHistory, GroundMotion, LONGEST_DELAY, Support};
pub use place::{BuildingPoint, Floor};
use place::{Row, no_storey};
pub(crate) use sections::{SectionForce, SectionPlace};
use sections::{acceleration_responses, section_forces};
pub(crate) use segment::{CLOSE, Grounds, Segment};
pub(crate) use terms::Terms;
pub use unequal_floors::UnequalFloors;
pub use unequal_floors::more_pairs;

use crate::bands::Bands;
use crate::error::TimeHistoryError;
use modes::{ContactFree, Loads};
use propagation::Propagation;

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
    /// `m1 m2 / (m1 + m2)`, the floor's mass against a wall (kg); `1 / (w' M^-1 w)` where the
    /// penetration `w' q` is a sum over several coordinates.
    pub effective_mass: f64,
    /// The impact model that acts here.
    pub model: Arc<dyn ImpactModel>,
    /// What it lies between.
    pub between: [Floor; 2],
    /// What the relative displacement holds beside both floors.
    pub(crate) terms: Terms,
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
    /// Seat width (m) of what spans the joint, which an opening must not exceed.
    pub seat: Option<f64>,
}

/// A ground acceleration, linear between equally spaced samples and zero after
/// the last.
#[derive(Debug, Clone)]
pub struct GroundAcceleration {
    /// Samples (m/s2), the first at time zero; a vector, as those who read records have one, which
    /// systems then share.
    pub samples: Arc<Vec<f64>>,
    /// Time step (s).
    pub time_step: f64,
}

/// Buildings in a row with the gaps between them under one ground motion.
///
/// Degrees of freedom are floor displacements relative to the ground, positive
/// to the right, one building after another from the left, bottom floor first; then the
/// coordinates of buildings that are no floors, one building after another; then
/// displacements of the ground, where a gap or a link lies between two ground motions.
#[derive(Debug, Clone)]
pub struct System {
    buildings: Vec<Arc<ShearBuilding>>,
    offsets: Vec<usize>,
    gaps: Vec<Gap>,
    levels: Vec<ContactLevel>,
    /// Whether a level is no difference of two floors.
    weighted_levels: bool,
    ground: GroundAcceleration,
    /// Where there is more than that under all coordinates, or forces act on floors.
    motions: Option<Arc<Motions>>,
    /// First of the coordinates of each building that are no floors, and the total at the end.
    further_offsets: Vec<usize>,
    /// Motions whose displacement is a degree of freedom.
    moving_ground: Vec<usize>,
    /// Of every degree of freedom; one for displacements of the ground.
    mass: Vec<f64>,
    /// Displacements, then velocities at time zero.
    initial: Vec<f64>,
    /// Stiffness of every storey that stores strain energy (N/m): what its law does not.
    spring: Vec<f64>,
    elements: Vec<Element>,
    sections: Vec<SectionForce>,
    /// Responses that are sums of absolute accelerations.
    acceleration_rows: Vec<SectionForce>,
    links: Vec<Link>,
    /// Points of buildings, with positions across the row (m) where these matter.
    points: Vec<(BuildingPoint, Option<f64>)>,
    level_rows: Vec<LevelRow>,
    bands: Option<Bands>,
    /// What contact-free motion needs, made when it is first asked for; shared by all systems with
    /// these buildings and this step.
    contact_free: Arc<OnceLock<Option<ContactFree>>>,
    /// Loads of contact-free blocks, shared by all systems with these buildings and this record.
    loads: Arc<Loads>,
    /// The same of exact steps of buildings that are no sums of oscillators.
    propagation: Arc<OnceLock<Option<Propagation>>>,
}

/// By what the floors of a level overlap in a state (m). Floors that touch may overlap by what
/// round-off makes of decimal numbers, as of 0.1 m and 0.2 m beside 0.3 m: their gap is then the
/// distance of their places, to the last bit.
fn overlap(level: &mut ContactLevel, state: &[f64]) -> Option<f64> {
    let distance = level.relative(state);
    let overlap = distance - level.width;
    let largest = state.iter().fold(level.width, |m, x| m.max(x.abs()));
    if overlap > 4.0 * f64::EPSILON * largest {
        return Some(overlap);
    }
    if overlap > 0.0 {
        level.width = distance;
    }
    None
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
        let mut further_offsets = vec![mass.len()];
        for building in &buildings {
            mass.extend_from_slice(&building.inertia()[building.storeys()..]);
            further_offsets.push(mass.len());
        }
        let (spring, elements) = storeys(&buildings, &offsets, &further_offsets);
        let sections = section_forces(&buildings, &offsets, &further_offsets, &elements);
        let acceleration_rows = acceleration_responses(&buildings, &offsets, &further_offsets);
        let mut this = Self {
            offsets,
            gaps: Vec::new(),
            levels: Vec::new(),
            weighted_levels: false,
            spring,
            elements,
            sections,
            acceleration_rows,
            links: Vec::new(),
            points: Vec::new(),
            level_rows: Vec::new(),
            ground,
            motions: None,
            further_offsets,
            moving_ground: Vec::new(),
            initial: vec![0.0; 2 * mass.len()],
            bands: Bands::of(&buildings),
            contact_free: Arc::default(),
            loads: Arc::default(),
            propagation: Arc::default(),
            buildings,
            mass,
        };
        if this.floors() < this.mass.len() {
            this.motions = this.under_one_motion().map(Arc::new);
        }
        this
    }

    /// Buildings without gaps, each under ground motions of its own.
    ///
    /// # Errors
    /// No motion, supports that are not one a building or name no motion, a delay that is
    /// negative or not finite, or a motion whose time step is not positive, or whose samples are none or not
    /// finite.
    pub fn with_motions(
        buildings: Vec<Arc<ShearBuilding>>,
        motions: Vec<GroundMotion>,
        supports: Vec<Support>,
    ) -> Result<Self, TimeHistoryError> {
        for (m, motion) in motions.iter().enumerate() {
            let GroundAcceleration { samples, time_step } = &motion.acceleration;
            let finite = samples.iter().all(|a| a.is_finite());
            if !(*time_step > 0.0 && time_step.is_finite() && finite && !samples.is_empty()) {
                let count = samples.len();
                return Err(TimeHistoryError::Motions {
                    reason: format!(
                        "motion {} has {count} samples at a time step of {time_step} s{}; it takes finite samples, and a step above zero",
                        m + 1,
                        if finite {
                            ""
                        } else {
                            ", not all of them finite"
                        }
                    ),
                });
            }
        }
        let made = Motions::new(motions, supports, &buildings)?;
        let first = made.motions[0].acceleration.clone();
        let plain = made.motions.len() == 1 && made.motions[0].delay == 0.0;
        let mut this = Self::new(buildings, first);
        if !plain || this.motions.is_some() {
            this.motions = Some(Arc::new(made));
        }
        Ok(this)
    }

    /// The motion there is under all buildings, for coordinates that do not follow it.
    fn under_one_motion(&self) -> Option<Motions> {
        let motion = GroundMotion {
            acceleration: self.ground.clone(),
            delay: 0.0,
            origin: Vec::new(),
        };
        let support = Support {
            along: 0,
            across: None,
        };
        let supports = vec![support; self.buildings.len()];
        Motions::new(vec![motion], supports, &self.buildings).ok()
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
        let n = self.floors();
        let mut initial: Vec<f64> = displacement.iter().chain(velocity).copied().collect();
        let wrong = displacement.len() != n || velocity.len() != n;
        if wrong || !initial.iter().all(|x| x.is_finite()) {
            return Err(TimeHistoryError::InitialState {
                reason: format!("it takes {n} finite displacements and as many velocities"),
            });
        }
        // What is no floor starts at rest, or as floors carry it along.
        let [u, v] = [displacement, velocity].map(|floors| self.carried_along(floors));
        initial.splice(n..n, u);
        initial.extend(v);
        let overlaps = |level: &mut ContactLevel| overlap(level, &initial);
        let found = self.levels.iter_mut().map(overlaps).enumerate();
        let found = found.filter_map(|(l, overlap)| Some((l, overlap?))).next();
        if let Some((l, overlap)) = found {
            return Err(TimeHistoryError::InitialState {
                reason: format!("gap {} overlaps by {overlap} m", self.name_of_level(l)),
            });
        }
        self.initial = initial;
        Ok(self)
    }

    /// Values of what is no floor that go with these of the floors.
    fn carried_along(&self, floors: &[f64]) -> Vec<f64> {
        let of = |(b, building): (usize, &Arc<ShearBuilding>)| {
            let own = &floors[self.offsets[b]..self.offsets[b + 1]];
            let further = 0..building.further_coordinates().len();
            further
                .map(|j| building.carried_along(j, own))
                .collect::<Vec<_>>()
        };
        let mut all: Vec<f64> = self.buildings.iter().enumerate().flat_map(of).collect();
        all.resize(self.mass.len() - floors.len(), 0.0);
        all
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
    /// No level, a floor that does not exist, a level between two walls, a width that is negative or
    /// not finite, floors that overlap at time zero, a restitution of velocity jumps that is not
    /// from 0 to 1, or velocity jumps at several points of a floor that turns.
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
        if !(elevation_tolerance.is_finite() && elevation_tolerance >= 0.0) {
            return Err(TimeHistoryError::GapDefinition {
                gap: name.to_owned(),
                reason: format!(
                    "the elevation tolerance is {elevation_tolerance} m; it must be zero or more"
                ),
            });
        }
        let first_level = self.levels.len();
        let count = pairs.len();
        if count == 0 {
            return Err(TimeHistoryError::GapDefinition {
                gap: name.to_owned(),
                reason: "it has no levels at which floors could meet".to_owned(),
            });
        }
        for (left, right, width, model) in pairs {
            let mut level = self.contact_level(name, left, right, width, model)?;
            if let Some(overlap) = overlap(&mut level, &self.initial[..self.mass.len()]) {
                return Err(TimeHistoryError::InitialState {
                    reason: format!("gap {name} overlaps by {overlap} m at time zero"),
                });
            }
            self.weighted_levels |= !level.terms.is_empty();
            self.levels.push(level);
        }
        let own = &self.levels[first_level..];
        for level in own.iter().filter(|l| l.place.across.is_some()) {
            let same = |other: &&ContactLevel| other.place.storeys == level.place.storeys;
            let points = own.iter().filter(same).count();
            let gap = name.to_owned();
            let model = level.model.descriptor().name;
            let mut transitions = level.model.transitions(Phase::Approach).iter();
            if level.model.rigid_restitution().is_some() && points > 1 {
                return Err(TimeHistoryError::JumpsAtPoints { gap, model });
            }
            if transitions.any(|t| matches!(t.target, Target::StickOrSlip)) && points > 2 {
                return Err(TimeHistoryError::FrictionAtPoints { gap, model, points });
            }
        }
        self.gaps.push(Gap {
            name: name.to_owned(),
            between,
            first_level,
            levels: count,
            elevation_tolerance,
            seat: None,
        });
        Ok(())
    }

    fn contact_level(
        &mut self,
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
        if let (Floor::Storey(b, i), Floor::Storey(c, j)) = (left, right)
            && b == c
        {
            return Err(wrong(format!(
                "floors {} and {} are both of building {}: what touches are neighbours",
                i + 1,
                j + 1,
                b + 1
            )));
        }
        let restitution = model.rigid_restitution();
        if let Some(e) = restitution.filter(|e| !(0.0..=1.0).contains(e)) {
            let name = model.descriptor().name;
            return Err(wrong(format!(
                "the restitution of its impact model {name} is {e}; it must be from 0 to 1"
            )));
        }
        let between = [left, right];
        let row = self.row_between(left, right).map_err(wrong)?;
        let Row {
            left,
            right,
            terms,
            place,
        } = row;
        let effective_mass = match (left, right) {
            (Some(a), Some(b)) if terms.pushed.is_empty() => {
                self.mass[a] * self.mass[b] / (self.mass[a] + self.mass[b])
            }
            (Some(a), None) | (None, Some(a)) if terms.pushed.is_empty() => self.mass[a],
            _ => {
                let ends = [(left, 1.0), (right, -1.0)].into_iter();
                let ends = ends.filter_map(|(i, w)| i.map(|i| (i, w)));
                let all = ends.chain(terms.pushed.iter().copied());
                1.0 / all.map(|(i, w)| w * w / self.mass[i]).sum::<f64>()
            }
        };
        Ok(ContactLevel {
            left,
            right,
            place,
            width,
            effective_mass,
            model,
            between,
            terms,
        })
    }

    /// The same buildings and ground motion without gaps and links: the isolated run.
    /// What depends on them alone is computed once for all systems made this way from one another, so that
    /// a sweep over gaps should make its systems by this and [`System::add_gap`].
    #[must_use]
    pub fn isolated(&self) -> Self {
        let mut this = Self {
            gaps: Vec::new(),
            levels: Vec::new(),
            weighted_levels: false,
            level_rows: Vec::new(),
            elements: storeys(&self.buildings, &self.offsets, &self.further_offsets).1,
            links: Vec::new(),
            ..self.clone()
        };
        this.forget_moving_ground();
        this
    }

    /// Removes the displacements of the ground, on which nothing depends.
    fn forget_moving_ground(&mut self) {
        let (kept, n) = (self.with_mass(), self.mass.len());
        if kept == n {
            return;
        }
        self.initial.truncate(n + kept);
        self.initial.drain(kept..n);
        self.mass.truncate(kept);
        self.moving_ground.clear();
        if let Some(motions) = &mut self.motions {
            Arc::make_mut(motions).keep(kept);
        }
    }

    /// The same buildings, links and ground motion without gaps: what would happen if the
    /// floors never touched. Shares as [`System::isolated`] does.
    #[must_use]
    pub fn without_gaps(&self) -> Self {
        Self {
            gaps: Vec::new(),
            levels: Vec::new(),
            level_rows: Vec::new(),
            ..self.clone()
        }
    }

    /// Gives up the tables that runs of this system have left in it, some 20 kB of two small
    /// buildings: for who keeps many systems after their runs. Another run makes them again.
    pub fn release_tables(&mut self) {
        self.contact_free = Arc::default();
        self.propagation = Arc::default();
    }

    /// Constants of contact-free motion; `None` if the damping of a building couples its modes,
    /// or where elements have a memory.
    pub(crate) fn contact_free(&self) -> Option<&ContactFree> {
        if !self.elements.is_empty() || !self.is_plain() {
            return None;
        }
        let step = self.ground.time_step;
        let constants = self
            .contact_free
            .get_or_init(|| ContactFree::new(self, step));
        constants.as_ref()
    }

    /// What the record does to the modes over blocks of samples without contact.
    pub(crate) fn loads(&self) -> &Loads {
        &self.loads
    }

    /// Exact steps over whole intervals; `None` for large buildings, and where elements have a
    /// memory.
    pub(crate) fn propagation(&self) -> Option<&Propagation> {
        if !self.elements.is_empty() {
            return None;
        }
        let made = self.propagation.get_or_init(|| Propagation::new(self));
        made.as_ref()
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
        let sides = level
            .between
            .iter()
            .filter_map(|floor| self.storey_of(*floor));
        let mut buildings = sides.map(|(index, _)| self.buildings[index].as_ref());
        buildings.find(|b| b.isolator().is_some())
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

    /// Number of floors of all buildings: the first degrees of freedom.
    #[must_use]
    pub fn floors(&self) -> usize {
        self.offsets.last().copied().unwrap_or(0)
    }

    /// Degrees of freedom of a building that are no floors.
    #[must_use]
    pub fn further_coordinates(&self, building: usize) -> std::ops::Range<usize> {
        self.further_offsets[building]..self.further_offsets[building + 1]
    }

    /// Number of degrees of freedom with mass: all but displacements of the ground.
    pub(crate) fn with_mass(&self) -> usize {
        self.mass.len() - self.moving_ground.len()
    }

    /// Whether all degrees of freedom are floors under one ground motion, and all contacts
    /// between two of them or a floor and a wall.
    pub(crate) fn is_plain(&self) -> bool {
        self.motions.is_none()
            && self.mass.len() == self.floors()
            && !self.weighted_levels
            && self.level_rows.is_empty()
    }

    /// Shears and moments that are rows on the floors.
    pub(crate) fn sections(&self) -> &[SectionForce] {
        &self.sections
    }

    /// Responses that are sums of absolute accelerations.
    pub(crate) fn acceleration_rows(&self) -> &[SectionForce] {
        &self.acceleration_rows
    }

    /// Number of responses with names of all buildings.
    pub(crate) fn named_responses(&self) -> usize {
        self.buildings.iter().map(|b| b.responses().len()).sum()
    }

    /// Number of buildings from the left, before this one, whose base moment is followed.
    pub(crate) fn base_moments_before(&self, building: usize) -> usize {
        let before = self.buildings[..building].iter();
        before.filter(|b| b.stiffness().is_empty()).count()
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

    /// Duration of the ground motion (s), of the one that ends last if there are several.
    #[must_use]
    pub fn record_duration(&self) -> f64 {
        let motions = self.motions.as_ref();
        motions.map_or_else(|| self.ground.duration(), |m| m.duration())
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
            let floors = self.floors();
            let (out, moving) = out.split_at_mut(floors);
            let (scratch, still) = scratch.split_at_mut(floors);
            bands.internal_forces(&u[..floors], &v[..floors], out, scratch);
            moving.fill(0.0);
            still.fill(0.0);
            return;
        }
        for (index, building) in self.buildings.iter().enumerate() {
            let parts = self.parts(index);
            match (building.stiffness_matrix(), parts[1].is_empty()) {
                (StiffnessMatrix::Dense(k), false) => multiply_parts(k, &parts, u, out),
                (matrix, _) => matrix.multiply(&u[parts[0].clone()], &mut out[parts[0].clone()]),
            }
        }
        self.damping_forces(v, scratch);
        out[self.with_mass()..].fill(0.0);
        for (o, s) in out.iter_mut().zip(scratch.iter()) {
            *o = -(*o + *s);
        }
    }

    /// Damping forces (N) at these velocities.
    pub(crate) fn damping_forces(&self, v: &[f64], out: &mut [f64]) {
        for (index, building) in self.buildings.iter().enumerate() {
            let parts = self.parts(index);
            match (building.damping_matrix(), parts[1].is_empty()) {
                (DampingMatrix::Dense(c), false) => multiply_parts(c, &parts, v, out),
                (_, _) => {
                    let floors = parts[0].clone();
                    building.apply_damping(&v[floors.clone()], &mut out[floors]);
                }
            }
        }
        out[self.with_mass()..].fill(0.0);
    }

    /// Degrees of freedom of a building: its floors, and its other coordinates.
    pub(crate) fn parts(&self, building: usize) -> [std::ops::Range<usize>; 2] {
        let floors = self.offsets[building]..self.offsets[building + 1];
        [floors, self.further_coordinates(building)]
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
        for (index, building) in self.buildings.iter().enumerate() {
            let mut below = 0.0;
            let [range, further] = self.parts(index);
            if let StiffnessMatrix::Dense(k) = building.stiffness_matrix() {
                let (floors, others) = (&u[range], &u[further]);
                let columns = k.as_slice().chunks_exact(k.nrows());
                for (column, x) in columns.zip(floors.iter().chain(others)) {
                    let (of_floors, of_others) = column.split_at(floors.len());
                    sum += 0.5 * (product(of_floors, floors) + product(of_others, others)) * x;
                }
                for element in &self.elements {
                    if element.place.is_in(index) {
                        let drift = element.relative(u);
                        sum -= 0.5 * element.carried * drift * drift;
                    }
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

    /// Stiffness of the storey below every floor, with that of gravity (N/m).
    pub(crate) fn springs(&self) -> &[f64] {
        &self.spring
    }

    /// Kinetic energy relative to the ground (J).
    pub(crate) fn kinetic_energy(&self, v: &[f64]) -> f64 {
        let mass = &self.mass[..self.with_mass()];
        mass.iter().zip(v).map(|(m, v)| 0.5 * m * v * v).sum()
    }
}

impl ContactLevel {
    /// Left minus right of any quantity given per degree of freedom.
    pub(crate) fn relative(&self, x: &[f64]) -> f64 {
        self.relative_of(|i| x[i])
    }

    /// The same, which calls for no more of the quantity than it needs.
    pub(crate) fn relative_of(&self, x: impl Fn(usize) -> f64) -> f64 {
        let of_floors = match (self.left, self.right) {
            (Some(l), Some(r)) => x(l) - x(r),
            (Some(l), None) => x(l),
            (None, Some(r)) => -x(r),
            (None, None) => 0.0,
        };
        if self.terms.is_empty() {
            return of_floors;
        }
        of_floors + self.terms.sum_of(x)
    }
}

/// Product of two vectors.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let ((a, rest_of_a), (b, rest_of_b)) = (a.as_chunks::<2>(), b.as_chunks::<2>());
    let mut sums = [0.0; 2];
    for (a, b) in a.iter().zip(b) {
        sums[0] += a[0] * b[0];
        sums[1] += a[1] * b[1];
    }
    let rest: f64 = rest_of_a.iter().zip(rest_of_b).map(|(a, b)| a * b).sum();
    sums[0] + sums[1] + rest
}

/// Product of a building's matrix with its floors and its other coordinates.
fn multiply_parts(
    matrix: &DMatrix<f64>,
    [floors, further]: &[std::ops::Range<usize>; 2],
    x: &[f64],
    out: &mut [f64],
) {
    let count = floors.len();
    out[floors.clone()].fill(0.0);
    out[further.clone()].fill(0.0);
    let all = floors.clone().chain(further.clone());
    for (column, i) in matrix.column_iter().zip(all) {
        let (x, entries) = (x[i], column.as_slice());
        for (o, c) in out[floors.clone()].iter_mut().zip(&entries[..count]) {
            *o += c * x;
        }
        for (o, c) in out[further.clone()].iter_mut().zip(&entries[count..]) {
            *o += c * x;
        }
    }
}
