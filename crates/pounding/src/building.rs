//! Buildings as a library user describes them.

use std::sync::Arc;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_shear_building::{
    Damping, Isolator, LateralStiffness, MAXIMUM_STOREYS, ShearBuilding, ShearBuildingError,
    StoreyLaw,
};

use crate::error::Error;
use crate::law::Law;
use crate::units::{Length, Mass, Stiffness, Velocity};

/// Stiffness (N/m) with which a law is checked that all storeys follow where there are none.
const ANY_STIFFNESS: f64 = 1.0e6;

/// One storey: the floor above it, and what carries that floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Storey {
    /// Mass of the floor.
    pub mass: Mass,
    /// Lateral stiffness of the storey; of a law, that at the start.
    pub stiffness: Stiffness,
    /// Height from floor to floor.
    pub height: Length,
}

/// A floor of a building with a stiffness matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Floor {
    /// Mass of the floor.
    pub mass: Mass,
    /// Height from the floor below.
    pub height: Length,
}

/// A building in the making: storeys from the bottom, or floors on a stiffness matrix;
/// damping, laws. A setting that is given twice is that of
/// [the last call](crate#what-a-second-call-does).
#[derive(Debug, Clone, PartialEq)]
pub struct Building {
    name: String,
    isolator: Option<Isolator>,
    /// Stiffness of all floors together, in the place of those of the storeys.
    matrix: Option<LateralStiffness>,
    floors: Vec<Floor>,
    /// Number of floors: more than there are in the list above the most that a building can have.
    count: usize,
    /// Of each floor that was added as a storey.
    stiffness: Vec<Option<Stiffness>>,
    damping: Option<Damping>,
    p_delta: bool,
    /// Laws, each of some storeys from 1, or of all.
    laws: Vec<(Option<Vec<usize>>, Law)>,
    initial_displacement: Vec<Length>,
    initial_velocity: Vec<Velocity>,
}

impl Building {
    /// A shear building without storeys as yet. Whether it is damped must be said.
    #[must_use]
    pub fn shear(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            isolator: None,
            matrix: None,
            floors: Vec::new(),
            count: 0,
            stiffness: Vec::new(),
            damping: None,
            p_delta: false,
            laws: Vec::new(),
            initial_displacement: Vec::new(),
            initial_velocity: Vec::new(),
        }
    }

    /// A building whose floors all act on one another, without floors as yet: a wall, a frame
    /// with flexible beams, the matrix of another program. Its overturning moment at the base
    /// is among the results.
    #[must_use]
    pub fn stiffness_matrix(name: impl Into<String>, matrix: LateralStiffness) -> Self {
        Self {
            matrix: Some(matrix),
            ..Self::shear(name)
        }
    }

    /// Adds a floor on top of a building with a stiffness matrix.
    #[must_use]
    pub fn floor(self, floor: Floor) -> Self {
        self.floors(1, floor)
    }

    /// Adds equal floors on top of a building with a stiffness matrix.
    #[must_use]
    pub fn floors(self, count: usize, floor: Floor) -> Self {
        self.add(count, floor, None)
    }

    /// Adds equal floors with the stiffness below each, if it has one of its own. Of more than a building
    /// can have only their number is kept.
    fn add(mut self, count: usize, floor: Floor, stiffness: Option<Stiffness>) -> Self {
        let total = self.count.saturating_add(count);
        if total <= MAXIMUM_STOREYS {
            self.floors.resize(total, floor);
            self.stiffness.resize(total, stiffness);
        }
        self.count = total;
        self
    }

    /// A building on isolators, which are its first storey, below its base slab, the first
    /// floor; storeys come on top. [`Building::damping`] then damps those as if the slab were
    /// fixed. A slab without storeys needs none.
    #[must_use]
    pub fn isolated(name: impl Into<String>, slab: Floor, isolator: Isolator) -> Self {
        Self {
            isolator: Some(isolator),
            ..Self::shear(name)
        }
        .floor(slab)
    }

    /// Adds a storey on top.
    #[must_use]
    pub fn storey(self, storey: Storey) -> Self {
        self.storeys(1, storey)
    }

    /// Adds equal storeys on top.
    #[must_use]
    pub fn storeys(self, count: usize, storey: Storey) -> Self {
        let Storey {
            mass,
            stiffness,
            height,
        } = storey;
        self.add(count, Floor { mass, height }, Some(stiffness))
    }

    /// Damps the building.
    #[must_use]
    pub fn damping(mut self, damping: Damping) -> Self {
        self.damping = Some(damping);
        self
    }

    /// Leaves the building without damping.
    #[must_use]
    pub fn undamped(self) -> Self {
        self.damping(Damping::MassProportional { ratio: 0.0 })
    }

    /// Lets gravity act through the drifts.
    #[must_use]
    pub fn p_delta(mut self) -> Self {
        self.p_delta = true;
        self
    }

    /// Lets all storeys follow a hysteresis law, by its name and its parameters in SI units;
    /// a `stiffness` that the law has and that is not given is that of the storey.
    #[must_use]
    pub fn law<'p>(
        mut self,
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        self.laws.push((None, Law::new(name, parameters)));
        self
    }

    /// The same for some storeys, numbered from 1; those without a law stay elastic.
    #[must_use]
    pub fn law_of_storeys<'p>(
        mut self,
        storeys: impl IntoIterator<Item = usize>,
        name: impl Into<String>,
        parameters: impl IntoIterator<Item = (&'p str, f64)>,
    ) -> Self {
        let storeys = Some(storeys.into_iter().collect());
        self.laws.push((storeys, Law::new(name, parameters)));
        self
    }

    /// Lets the floors go at time zero from these displacements relative to the ground, the
    /// lowest first.
    #[must_use]
    pub fn initial_displacement(mut self, floors: impl IntoIterator<Item = Length>) -> Self {
        self.initial_displacement = floors.into_iter().collect();
        self
    }

    /// The same with these velocities.
    #[must_use]
    pub fn initial_velocity(mut self, floors: impl IntoIterator<Item = Velocity>) -> Self {
        self.initial_velocity = floors.into_iter().collect();
        self
    }

    /// Name, as gaps call it.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Storey, from zero, of this number, from 1, which `of` names.
    pub(crate) fn storey_index(&self, of: &str, number: usize) -> Result<usize, Error> {
        match number.checked_sub(1) {
            None => Err(Error::StoreyZero { of: of.to_owned() }),
            Some(storey) if storey < self.floors.len() => Ok(storey),
            Some(_) => Err(Error::UnknownStorey {
                of: of.to_owned(),
                building: self.name.clone(),
                storey: number,
                highest: self.floors.len(),
            }),
        }
    }

    pub(crate) fn build(&self) -> Result<Arc<ShearBuilding>, Error> {
        if self.count > MAXIMUM_STOREYS {
            return Err(Error::Building(ShearBuildingError::TooManyStoreys {
                building: self.name.clone(),
                storeys: self.count,
                largest: MAXIMUM_STOREYS,
            }));
        }
        let each = |of: fn(&Floor) -> f64| self.floors.iter().map(of).collect();
        let bare = self.isolator.is_some() && self.floors.len() == 1;
        let none = || bare.then_some(Damping::MassProportional { ratio: 0.0 });
        let damping = self.damping.clone().or_else(none);
        let damping = damping.ok_or_else(|| Error::NoDamping {
            building: self.name.clone(),
        })?;
        if self.isolator.is_none() && matches!(damping, Damping::Isolated { .. }) {
            return Err(Error::DampingOfIsolators {
                building: self.name.clone(),
            });
        }
        let gravity = if self.p_delta { STANDARD_GRAVITY } else { 0.0 };
        let name = self.name.clone();
        let (mass, height) = (each(|f| f.mass.si()), each(|f| f.height.si()));
        let building = match &self.matrix {
            Some(matrix) => {
                if let Some(storey) = self.stiffness.iter().position(Option::is_some) {
                    return Err(self.stiffness_of(storey, true));
                }
                let matrix = matrix.clone();
                ShearBuilding::with_stiffness_matrix(name, mass, matrix, height, damping, gravity)?
            }
            None => {
                let known = |(storey, k): (usize, &Option<Stiffness>)| {
                    k.map(|k| k.si())
                        .ok_or_else(|| self.stiffness_of(storey, false))
                };
                let slab = usize::from(self.isolator.is_some());
                let stiffness = self.stiffness.iter().enumerate().skip(slab).map(known);
                let stiffness: Vec<f64> = stiffness.collect::<Result<_, _>>()?;
                match self.isolator {
                    Some(_) if self.p_delta => {
                        return Err(Error::GravityOnIsolators {
                            building: self.name.clone(),
                        });
                    }
                    Some(isolator) => ShearBuilding::on_isolators(
                        name, mass, &stiffness, height, damping, isolator,
                    )?,
                    None => ShearBuilding::under_gravity(
                        name, mass, stiffness, height, damping, gravity,
                    )?,
                }
            }
        };
        if self.laws.is_empty() {
            return Ok(Arc::new(building));
        }
        let laws = self.storey_laws(building.laws().to_vec())?;
        Ok(Arc::new(building.with_laws(laws)?))
    }

    /// A storey, from zero, with a stiffness beside a matrix, or with neither.
    fn stiffness_of(&self, storey: usize, matrix: bool) -> Error {
        Error::StiffnessOfStorey {
            building: self.name.clone(),
            storey: storey + 1,
            matrix,
        }
    }

    /// The law of each storey, if it has one, beside those that are there already.
    fn storey_laws(
        &self,
        mut laws: Vec<Option<StoreyLaw>>,
    ) -> Result<Vec<Option<StoreyLaw>>, Error> {
        let of = format!("building {}", self.name);
        let count = self.floors.len();
        let isolators = usize::from(self.isolator.is_some());
        for (storeys, law) in &self.laws {
            // One that no storey has is to be one all the same.
            match storeys {
                Some(storeys) if storeys.is_empty() => drop(law.build(&of, None)?),
                None if count == isolators => drop(law.build(&of, Some(ANY_STIFFNESS))?),
                _ => {}
            }
            let all = || (1 + isolators..=count).collect();
            for storey in storeys.clone().unwrap_or_else(all) {
                let refused = |reason| Error::LawOfStorey {
                    building: self.name.clone(),
                    storey,
                    reason,
                };
                let index = storey.checked_sub(1).filter(|i| *i < count);
                let index = index.ok_or_else(|| refused("there is no such storey"))?;
                if self.matrix.is_some() {
                    return Err(refused("a stiffness matrix has no storeys of its own"));
                }
                if index < isolators {
                    return Err(refused("the isolators have their own"));
                }
                if laws[index].is_some() {
                    return Err(refused("it has a law already"));
                }
                let stiffness = self.stiffness[index].map(|k| k.si());
                laws[index] = Some(law.build(&of, stiffness)?);
            }
        }
        Ok(laws)
    }

    /// Displacements (m) and velocities (m/s) of the floors at time zero.
    pub(crate) fn initial_state(&self) -> Result<(Vec<f64>, Vec<f64>), Error> {
        let displacement = self.initial_displacement.iter().map(|u| u.si()).collect();
        let velocity = self.initial_velocity.iter().map(|v| v.si()).collect();
        Ok((self.each_floor(displacement)?, self.each_floor(velocity)?))
    }

    /// A value of each floor, at rest where none are given.
    fn each_floor(&self, values: Vec<f64>) -> Result<Vec<f64>, Error> {
        let storeys = self.floors.len();
        match values.len() {
            0 => Ok(vec![0.0; storeys]),
            given if given == storeys => Ok(values),
            given => Err(Error::InitialState {
                building: self.name.clone(),
                given,
                storeys,
            }),
        }
    }
}
