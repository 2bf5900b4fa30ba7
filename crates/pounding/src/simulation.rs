//! A row of buildings under a ground motion.

use pounding_catalogue::{OUTPUT_STEP, suggestion};
use pounding_shear_building::{NAMES, NameFault, WALL, check_names};
use pounding_time_history::{
    Floor, FloorForce, ForceHistory, GroundAcceleration, MethodChoice, Outcome, RunOptions, System,
};

use crate::building::Building;
use crate::error::Error;
use crate::facing::Levels;
use crate::gap::Gap;
use crate::link::Link;
use crate::model::Model;
use crate::record::GroundMotion;
use crate::units::Time;

/// Buildings in a row from the left, the gaps and links between them, a ground motion, and how
/// it is all integrated.
///
/// Everything is checked when it is [built](Self::build) or [run](Self::run). What a second call of a method
/// does is said of [all builders](crate#what-a-second-call-does).
#[derive(Debug, Clone)]
pub struct Simulation {
    buildings: Vec<Building>,
    gaps: Vec<Gap>,
    links: Vec<Link>,
    motion: Option<GroundMotion>,
    /// Building, storey from 1.
    forces: Vec<(String, usize, ForceHistory)>,
    options: RunOptions,
    title: String,
}

impl Simulation {
    /// Buildings from the left to the right.
    #[must_use]
    pub fn of(buildings: impl IntoIterator<Item = Building>) -> Self {
        Self {
            buildings: buildings.into_iter().collect(),
            gaps: Vec::new(),
            links: Vec::new(),
            motion: None,
            forces: Vec::new(),
            options: RunOptions::default(),
            title: String::new(),
        }
    }

    /// Gives its results a title.
    #[must_use]
    pub fn title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Adds a gap.
    #[must_use]
    pub fn gap(mut self, gap: Gap) -> Self {
        self.gaps.push(gap);
        self
    }

    /// Adds a link.
    #[must_use]
    pub fn link(mut self, link: Link) -> Self {
        self.links.push(link);
        self
    }

    /// Shakes the buildings.
    #[must_use]
    pub fn ground_motion(mut self, motion: impl Into<GroundMotion>) -> Self {
        self.motion = Some(motion.into());
        self
    }

    /// Pushes the floor above a storey, from 1, of the building of this name, to the right where
    /// the force is positive; several forces on one floor are added.
    #[must_use]
    pub fn force(mut self, building: &str, storey: usize, history: ForceHistory) -> Self {
        self.forces.push((building.to_owned(), storey, history));
        self
    }

    /// Integrates by another method than the event-driven one.
    #[must_use]
    pub fn method(mut self, method: MethodChoice) -> Self {
        self.options.method = method;
        self
    }

    /// Ends the run at this time, not with the record.
    #[must_use]
    pub fn duration(mut self, duration: Time) -> Self {
        self.options.duration = Some(duration.si());
        self
    }

    /// Allows another residual of the energy ledger, over the largest input energy, than is
    /// usual for the method: a run above it is an error.
    #[must_use]
    pub fn energy_tolerance(mut self, ratio: f64) -> Self {
        self.options.energy_tolerance = Some(ratio);
        self
    }

    /// Checks all parts and builds what the solver takes.
    ///
    /// # Errors
    /// What is missing or cannot be, of which building or gap.
    pub fn build(&self) -> Result<Model, Error> {
        if self.buildings.is_empty() {
            return Err(Error::NoBuildings);
        }
        let motion = self.motion.as_ref().ok_or(Error::NoGroundMotion)?;
        let accelerogram = motion.accelerogram().clone();
        // Before names, which two such gaps share where nobody gave them any.
        self.one_gap_between_two()?;
        self.check_names()?;
        let buildings = self.buildings.iter().map(Building::build);
        let buildings = buildings.collect::<Result<Vec<_>, _>>()?;
        let ground = GroundAcceleration {
            samples: accelerogram.shared_samples(),
            time_step: accelerogram.time_step(),
        };
        let (mut displacement, mut velocity) = (Vec::new(), Vec::new());
        for building in &self.buildings {
            let (u, v) = building.initial_state()?;
            displacement.extend(u);
            velocity.extend(v);
        }
        let system = System::new(buildings, ground);
        let system = system.with_initial_state(&displacement, &velocity)?;
        let mut system = system.with_forces(self.floor_forces()?)?;
        for gap in &self.gaps {
            self.add_gap(gap, &mut system)?;
        }
        for link in &self.links {
            let pairs = link.facing.pairs(&self.buildings, &system)?;
            let between = link.facing.between.clone();
            system.add_link(&link.name(), between, link.build(pairs)?)?;
        }
        self.options.check(&system)?;
        Ok(Model {
            system,
            accelerogram,
            options: self.options,
            output_step: OUTPUT_STEP,
            title: self.title.clone(),
            source: String::new(),
            told: Vec::new(),
            files: motion
                .file()
                .map(|f| ("record", f.to_owned()))
                .into_iter()
                .collect(),
        })
    }

    /// Builds and runs it.
    ///
    /// # Errors
    /// Those of [`build`](Self::build) and of [`Model::run`].
    pub fn run(&self) -> Result<Outcome, Error> {
        self.build()?.run()
    }

    fn floor_forces(&self) -> Result<Vec<FloorForce>, Error> {
        let force = |(name, storey, history): &(String, usize, ForceHistory)| {
            let mut names = self.buildings.iter().map(Building::name);
            let found = names.position(|n| n == name);
            let building = found.ok_or_else(|| match name.as_str() {
                WALL => Error::ForceOnWall,
                _ => Error::UnknownBuilding {
                    of: "a force".to_owned(),
                    building: name.clone(),
                    nearest: suggestion::misspelt(name, self.buildings.iter().map(Building::name))
                        .map(str::to_owned),
                },
            })?;
            Ok(FloorForce {
                building,
                storey: self.buildings[building]
                    .storey_index(&format!("a force on \"{name}\""), *storey)?,
                history: history.clone(),
                origin: String::new(),
            })
        };
        self.forces.iter().map(force).collect()
    }

    /// Buildings and gaps are called by their names, and stand under them in results.
    fn check_names(&self) -> Result<(), Error> {
        if self.buildings.iter().any(|b| b.name() == WALL) {
            return Err(Error::Name {
                reason: "it is that of the rigid wall",
                name: WALL.to_owned(),
                what: "building",
            });
        }
        let gaps: Vec<String> = self.gaps.iter().map(Gap::name).collect();
        let links: Vec<String> = self.links.iter().map(Link::name).collect();
        check_names("building", self.buildings.iter().map(Building::name))
            .and_then(|()| check_names("gap", gaps.iter().map(String::as_str)))
            .and_then(|()| check_names("link", links.iter().map(String::as_str)))
            .map_err(|error| Error::Name {
                reason: match (error.fault, error.what) {
                    (NameFault::Form, _) => NAMES,
                    (NameFault::Taken, "gap") => "another gap has it: call one by `.named(...)`",
                    (NameFault::Taken, "link") => "another link has it: call one by `.named(...)`",
                    (NameFault::Taken, _) => "another building has it",
                },
                name: error.name,
                what: error.what,
            })
    }

    /// Refuses a second gap between the same neighbours.
    fn one_gap_between_two(&self) -> Result<(), Error> {
        for (place, gap) in self.gaps.iter().enumerate() {
            let same = |other: &&Gap| other.facing.between == gap.facing.between;
            if let Some(first) = self.gaps[..place].iter().find(same) {
                return Err(Error::SecondGap {
                    gap: gap.name(),
                    first: first.name(),
                });
            }
        }
        Ok(())
    }

    fn add_gap(&self, gap: &Gap, system: &mut System) -> Result<(), Error> {
        if gap.floor_to_floor && !matches!(gap.facing.levels, Levels::Pairs(_)) {
            return Err(Error::FloorToFloor { gap: gap.name() });
        }
        let pairs = gap.facing.pairs(&self.buildings, system)?;
        let (widths, model) = (gap.built_widths(pairs.len())?, gap.built_model()?);
        let levels = pairs.into_iter().zip(widths);
        let mut levels: Vec<_> = levels
            .map(|((left, right), width)| (left, right, width, model.clone()))
            .collect();
        // From the bottom, as results show them.
        let storey = |floor: &Floor| match floor {
            Floor::Storey(_, storey) => Some(*storey),
            _ => None,
        };
        levels.sort_by_key(|(left, right, ..)| (storey(left), storey(right)));
        system.add_gap(&gap.name(), gap.facing.between.clone(), levels)?;
        let unequal = system.gaps().last().map(|g| system.unequal_floors(g));
        match unequal.unwrap_or_default().first() {
            Some(first) if !gap.floor_to_floor => Err(Error::NotLevel {
                gap: gap.name(),
                floors: first.floors(),
                difference: first.difference,
            }),
            _ => Ok(()),
        }
    }
}
