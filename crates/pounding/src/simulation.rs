//! A row of buildings under a ground motion, and its run.

use std::cell::Cell;
use std::ops::ControlFlow;

use pounding_catalogue::suggestion;
use pounding_ground_motion::Accelerogram;
use pounding_shear_building::{NAMES, is_name};
use pounding_time_history::{
    Floor, FloorForce, ForceHistory, GroundAcceleration, History, MethodChoice, Outcome, Recorder,
    RunOptions, StepView, System, TimeHistoryError, run,
};

use crate::building::Building;
use crate::error::Error;
use crate::facing::WALL;
use crate::gap::Gap;
use crate::link::Link;
use crate::record::GroundMotion;
use crate::units::Time;

/// Buildings in a row from the left, the gaps and links between them, a ground motion, and how
/// it is all integrated.
///
/// Everything is checked when it is [built](Self::build) or [run](Self::run).
#[derive(Debug, Clone)]
pub struct Simulation {
    buildings: Vec<Building>,
    gaps: Vec<Gap>,
    links: Vec<Link>,
    motion: Option<GroundMotion>,
    /// Building, storey from 1.
    forces: Vec<(String, usize, ForceHistory)>,
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
    /// What is to be said of how the buildings were made, and of what the case file gives and nothing uses.
    told: Vec<String>,
    /// Files that it was made of, each with what it is: no result replaces them.
    #[cfg_attr(not(feature = "hdf5"), expect(dead_code))]
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
            links: Vec::new(),
            motion: None,
            forces: Vec::new(),
            options: RunOptions::default(),
        }
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
        let motion = self.motion.as_ref().ok_or(Error::NoGroundMotion)?;
        let accelerogram = motion.accelerogram().clone();
        self.check_names()?;
        self.one_gap_between_two()?;
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
            title: String::new(),
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
            let building = names.position(|n| n == name);
            let building = building.ok_or_else(|| Error::UnknownBuilding {
                of: "a force".to_owned(),
                building: name.clone(),
                nearest: suggestion::misspelt(name, self.buildings.iter().map(Building::name))
                    .map(str::to_owned),
            })?;
            let storey = storey.checked_sub(1).ok_or_else(|| Error::StoreyZero {
                of: format!("a force on \"{name}\""),
            })?;
            Ok(FloorForce {
                building,
                storey,
                history: history.clone(),
                origin: String::new(),
            })
        };
        self.forces.iter().map(force).collect()
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
        let gaps: Vec<String> = self.gaps.iter().map(Gap::name).collect();
        let links: Vec<String> = self.links.iter().map(Link::name).collect();
        for (what, names, taken) in [
            ("gap", gaps, "another gap has it: call one by `.named(...)`"),
            (
                "link",
                links,
                "another link has it: call one by `.named(...)`",
            ),
        ] {
            let mut seen = std::collections::BTreeSet::new();
            for name in names {
                let reason = match seen.insert(name.clone()) {
                    true if is_name(&name) => continue,
                    true => NAMES,
                    false => taken,
                };
                return Err(Error::Name { name, what, reason });
            }
        }
        Ok(())
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

    /// All that is to be said of a run: of its record, of what the case file gives and nothing uses, and
    /// the warnings of its outcome, as `pounding run` says it.
    #[must_use]
    pub fn warnings(&self, outcome: &Outcome) -> Vec<String> {
        let record = self.accelerogram.origin().map(|o| o.warnings.as_slice());
        let before = record.unwrap_or_default().iter().chain(&self.told).cloned();
        let of_run = outcome.warnings.iter().map(ToString::to_string);
        before.chain(of_run).collect()
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

    /// How it is integrated: method, duration, bound of the energy residual.
    #[must_use]
    pub fn options(&self) -> &RunOptions {
        &self.options
    }

    /// Integrates otherwise than the simulation or the case file says.
    ///
    /// # Errors
    /// An option out of range.
    pub fn with_options(mut self, options: RunOptions) -> Result<Self, Error> {
        options.check(&self.system)?;
        self.options = options;
        Ok(self)
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

    /// The same, asked whether to go on: `progress` is given the part of the duration that is done, at most
    /// some hundred times a run, as what has no contact is taken at once, and ends it by
    /// [`ControlFlow::Break`]. Recorders then hold what they have recorded.
    ///
    /// # Errors
    /// As [`run_with`](Self::run_with); [`Error::Stopped`] where `progress` ended it.
    pub fn run_while(
        &self,
        recorders: &mut [&mut dyn Recorder],
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Outcome, Error> {
        let stopped = Cell::new(None);
        let mut stop = Stop(&stopped);
        let mut all: Vec<&mut dyn Recorder> = vec![&mut stop];
        for recorder in recorders {
            all.push(&mut **recorder);
        }
        let outcome = run(&self.system, &self.options, &mut all, &mut |done| {
            // What is asked at the end cannot end it any more.
            if progress(done).is_break() && done < 1.0 && stopped.get().is_none() {
                stopped.set(Some(done));
            }
        });
        match stopped.get() {
            Some(done) => Err(Error::Stopped { done }),
            None => Ok(outcome?),
        }
    }
}

/// Ends the run once it is told so. It is shown no step until then.
struct Stop<'s>(&'s Cell<Option<f64>>);

impl Recorder for Stop<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        Ok(())
    }

    fn next_time(&self) -> f64 {
        match self.0.get() {
            None => f64::INFINITY,
            Some(_) => f64::NEG_INFINITY,
        }
    }

    fn step(&mut self, _step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        match self.0.get() {
            None => Ok(()),
            Some(_) => Err(TimeHistoryError::Recorder("stopped".to_owned())),
        }
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
        let told = assembly.warnings_of_buildings();
        let mut files = vec![("case", path.as_ref().to_owned())];
        files.extend(case.files());
        Ok(Self {
            files,
            system: assembly.system,
            accelerogram: assembly.accelerogram,
            options: assembly.options,
            output_step: assembly.output_step,
            told,
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
        let mut warnings = self.warnings(&outcome);
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
