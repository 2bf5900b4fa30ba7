//! A row of buildings under a ground motion, and its run.

use pounding_catalogue::suggestion;
use pounding_ground_motion::Accelerogram;
use pounding_shear_building::{
    ELEVATION_TOLERANCE, NAMES, floor_without_partner, is_name, level_pairs,
};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, Recorder, RunOptions, System,
    TimeHistoryError, run,
};

use crate::building::Building;
use crate::error::Error;
use crate::gap::{Gap, Levels, WALL};
use crate::record::GroundMotion;
use crate::units::Time;

/// Buildings in a row from the left, the gaps between them, a ground motion, and how it is
/// all integrated.
///
/// Everything is checked when it is [built](Self::build) or [run](Self::run).
#[derive(Debug, Clone)]
pub struct Simulation {
    buildings: Vec<Building>,
    gaps: Vec<Gap>,
    motion: Option<GroundMotion>,
    options: RunOptions,
}

/// A simulation whose every part was checked: the system, the record and the options that the
/// solver takes. It may be run many times.
#[derive(Debug, Clone)]
pub struct Model {
    pub(crate) system: System,
    pub(crate) accelerogram: Accelerogram,
    pub(crate) options: RunOptions,
    pub(crate) output_step: f64,
    pub(crate) title: String,
    /// Text of the case file, empty for what was built by code.
    pub(crate) source: String,
    /// Files that it was made of, each with what it is: no result replaces them.
    pub(crate) files: Vec<(&'static str, std::path::PathBuf)>,
}

/// Step of recorded responses unless another is asked for (s).
pub(crate) const OUTPUT_STEP: f64 = 0.01;

impl Simulation {
    /// Buildings from the left to the right.
    #[must_use]
    pub fn of(buildings: impl IntoIterator<Item = Building>) -> Self {
        Self {
            buildings: buildings.into_iter().collect(),
            gaps: Vec::new(),
            motion: None,
            options: RunOptions::default(),
        }
    }

    /// Adds a gap.
    #[must_use]
    pub fn gap(mut self, gap: Gap) -> Self {
        self.gaps.push(gap);
        self
    }

    /// Shakes the buildings.
    #[must_use]
    pub fn ground_motion(mut self, motion: impl Into<GroundMotion>) -> Self {
        self.motion = Some(motion.into());
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

    /// Checks all parts and builds what the solver takes.
    ///
    /// # Errors
    /// What is missing or cannot be, of which building or gap.
    pub fn build(&self) -> Result<Model, Error> {
        let motion = self.motion.as_ref().ok_or(Error::NoGroundMotion)?;
        let accelerogram = motion.accelerogram().clone();
        self.check_names()?;
        let buildings = self.buildings.iter().map(Building::build);
        let buildings = buildings.collect::<Result<Vec<_>, _>>()?;
        let ground = GroundAcceleration {
            samples: accelerogram.samples().into(),
            time_step: accelerogram.time_step(),
        };
        let mut system = System::new(buildings, ground);
        for gap in &self.gaps {
            self.add(gap, &mut system)?;
        }
        self.options.check(&system)?;
        Ok(Model {
            system,
            accelerogram,
            options: self.options,
            output_step: OUTPUT_STEP,
            title: String::new(),
            source: String::new(),
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

    /// Buildings and gaps are called by their names, and stand under them in results.
    fn check_names(&self) -> Result<(), Error> {
        let mut seen = std::collections::BTreeSet::new();
        for name in self.buildings.iter().map(Building::name) {
            let reason = match name {
                WALL => Some("it is that of the rigid wall"),
                _ if !is_name(name) => Some(NAMES),
                _ if !seen.insert(name) => Some("another building has it"),
                _ => None,
            };
            if let Some(reason) = reason {
                return Err(Error::Name {
                    name: name.to_owned(),
                    what: "building",
                    reason,
                });
            }
        }
        let mut seen = std::collections::BTreeSet::new();
        for gap in &self.gaps {
            if !seen.insert(gap.name()) {
                return Err(Error::Name {
                    name: gap.name(),
                    what: "gap",
                    reason: "another gap is between the same buildings",
                });
            }
        }
        Ok(())
    }

    fn add(&self, gap: &Gap, system: &mut System) -> Result<(), Error> {
        let sides = [self.side(gap, 0)?, self.side(gap, 1)?];
        let beside = match sides {
            [Some(left), Some(right)] => right == left + 1,
            [Some(left), None] => left + 1 == self.buildings.len(),
            [None, Some(right)] => right == 0,
            [None, None] => false,
        };
        if !beside {
            return Err(Error::NotNeighbours { gap: gap.name() });
        }
        let pairs = pairs(gap, sides, system)?;
        if pairs.is_empty() {
            return Err(Error::NoLevel { gap: gap.name() });
        }
        let (width, model) = (gap.built_width()?, gap.built_model()?);
        let pairs = pairs
            .into_iter()
            .map(|(left, right)| (left, right, width, model.clone()));
        system.add_gap(&gap.name(), gap.between.clone(), pairs.collect())?;
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

    /// The building on a side of a gap; `None` is a wall.
    fn side(&self, gap: &Gap, side: usize) -> Result<Option<usize>, Error> {
        let name = gap.between[side].as_str();
        let mut names = self.buildings.iter().map(Building::name);
        match names.position(|n| n == name) {
            None if name == WALL => Ok(None),
            None => Err(Error::UnknownBuilding {
                gap: gap.name(),
                building: name.to_owned(),
                nearest: suggestion::nearest(name, self.buildings.iter().map(Building::name))
                    .map(str::to_owned),
            }),
            found => Ok(found),
        }
    }
}

/// Floors of a gap that may touch.
fn pairs(
    gap: &Gap,
    sides: [Option<usize>; 2],
    system: &System,
) -> Result<Vec<(Floor, Floor)>, Error> {
    let floor = |side: Option<usize>, storey: usize| {
        side.map_or(Floor::Wall, |building| Floor::Storey(building, storey))
    };
    let faced = |pairs: Vec<(usize, usize)>| {
        let both = |(l, r)| (floor(sides[0], l), floor(sides[1], r));
        pairs.into_iter().map(both).collect()
    };
    if let Levels::Pairs(pairs) = &gap.levels {
        // Storeys count from 1; those above the roof are refused by the system.
        let below = |side: usize, storey: usize| match (sides[side], storey.checked_sub(1)) {
            (None, _) => Ok(0),
            (Some(_), Some(floor)) => Ok(floor),
            (Some(_), None) => Err(TimeHistoryError::GapDefinition {
                gap: gap.name(),
                reason: "there is no storey 0: they are numbered from 1".to_owned(),
            }),
        };
        let pairs = pairs
            .iter()
            .map(|(l, r)| Ok((below(0, *l)?, below(1, *r)?)));
        return Ok(faced(pairs.collect::<Result<_, TimeHistoryError>>()?));
    }
    let [Some(left), Some(right)] = sides else {
        let building = sides[0].or(sides[1]).unwrap_or_default();
        let storeys = system.buildings()[building].storeys();
        return Ok(faced((0..storeys).map(|s| (s, s)).collect()));
    };
    let buildings = [left, right].map(|b| &system.buildings()[b]);
    let elevations = buildings.map(|b| b.elevations());
    let pairs = level_pairs(elevations[0], elevations[1], ELEVATION_TOLERANCE);
    let lonely = floor_without_partner(elevations, &pairs, ELEVATION_TOLERANCE);
    match (lonely, &gap.levels) {
        (Some((side, storey)), Levels::All) => Err(Error::UnequalFloors {
            gap: gap.name(),
            building: buildings[side].name().to_owned(),
            floor: storey + 1,
            elevation: elevations[side][storey],
        }),
        _ => Ok(faced(pairs)),
    }
}

impl Model {
    /// Title of the case file, empty for what was built by code.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Text of the case file, empty for what was built by code.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The record, scaled, with its origin.
    #[must_use]
    pub fn accelerogram(&self) -> &Accelerogram {
        &self.accelerogram
    }

    /// The system: buildings with their modes, gaps with their contact levels.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The same buildings without gaps.
    #[must_use]
    pub fn isolated(&self) -> Self {
        Self {
            system: self.system.isolated(),
            ..self.clone()
        }
    }

    /// Records responses at another step than 0.01 s, or than that of the case file.
    #[must_use]
    pub fn output_step(mut self, step: Time) -> Self {
        self.output_step = step.si();
        self
    }

    /// Integrates the time history.
    ///
    /// # Errors
    /// A run that comes to no result, with time and place.
    pub fn run(&self) -> Result<Outcome, Error> {
        self.run_with(&mut [])
    }

    /// The same, watched by recorders, which change no bit of it: a
    /// [`GridRecorder`](pounding_time_history::GridRecorder) keeps the responses on a grid of
    /// times.
    ///
    /// # Errors
    /// As [`run`](Self::run), and what keeps a recorder from recording.
    pub fn run_with(&self, recorders: &mut [&mut dyn Recorder]) -> Result<Outcome, Error> {
        Ok(run(&self.system, &self.options, recorders, &mut |_| {})?)
    }
}

#[cfg(feature = "toml")]
impl Model {
    /// Reads a case file, and the record that it names.
    ///
    /// # Errors
    /// What is wrong in the file, with line and column.
    pub fn read(path: impl AsRef<std::path::Path>) -> Result<Self, Error> {
        let case = pounding_case::Case::read(path.as_ref());
        let case = case.map_err(pounding_assembly::AssemblyError::from)?;
        let assembly = pounding_assembly::assemble(&case)?;
        let mut files = vec![("case", path.as_ref().to_owned())];
        files.extend(case.files());
        Ok(Self {
            files,
            system: assembly.system,
            accelerogram: assembly.accelerogram,
            options: assembly.options,
            output_step: assembly.output_step,
            title: case.title,
            source: case.source,
        })
    }
}

#[cfg(feature = "hdf5")]
impl Model {
    /// Runs it, and the same buildings without gaps, and writes responses, peaks, impacts and
    /// ledger to a result file: what `pounding run` writes.
    ///
    /// # Errors
    /// As [`run`](Self::run); a file that cannot be written, or that is the case file or the
    /// record. What stood under its name is untouched then.
    pub fn run_to_file(&self, path: impl AsRef<std::path::Path>) -> Result<Outcome, Error> {
        use pounding_results::{RunEnding, RunHead, RunWriter};
        use pounding_time_history::GridRecorder;

        let mut files = pounding_files::FileUse::new();
        for (role, file) in &self.files {
            files.reads(*role, file);
        }
        files.writes("result", path.as_ref());
        files.check()?;
        pounding_results::check_size(&self.system, self.options.duration, self.output_step)?;
        let started = std::time::Instant::now();
        let head = RunHead {
            title: &self.title,
            case: &self.source,
            version: env!("CARGO_PKG_VERSION"),
            build: "library",
            system: &self.system,
            accelerogram: &self.accelerogram,
        };
        let writer = RunWriter::begin(path.as_ref(), &head)?;
        let mut writer = GridRecorder::into_sink(self.output_step, writer)?;
        let outcome = self.run_with(&mut [&mut writer]);
        if let Some(failure) = writer.responses.failure() {
            return Err(failure.into());
        }
        let outcome = outcome?;
        let isolated = self.isolated().run();
        let record = self.accelerogram.origin().map(|o| o.warnings.clone());
        let mut warnings = record.unwrap_or_default();
        warnings.extend(outcome.warnings.iter().map(ToString::to_string));
        // What is there for comparison does not take the result away.
        let isolated = isolated.unwrap_or_else(|error| {
            warnings.push(format!("without gaps and links: {error}"));
            outcome.with_unknown_peaks()
        });
        writer.responses.finish(&RunEnding {
            outcome: &outcome,
            isolated: &isolated,
            warnings: &warnings,
            wall_time: started.elapsed().as_secs_f64(),
        })?;
        Ok(outcome)
    }
}
