//! A simulation that is ready to run, and its runs.

use std::ops::ControlFlow;

#[cfg(feature = "toml")]
use pounding_case::Case;
use pounding_catalogue::OUTPUT_STEP;
use pounding_ground_motion::{AccelerationUnit, Accelerogram};
#[cfg(feature = "toml")]
use pounding_shear_building::{NAMES, NameFault};
use pounding_time_history::{Outcome, Recorder, RunOptions, System, run};

use crate::error::Error;
use crate::help;
use crate::progress::Progress;
use crate::record::GroundMotion;
#[cfg(feature = "toml")]
use crate::record::wherever;
use crate::units::Time;

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
    pub(crate) told: Vec<String>,
    /// Files that it was made of, each with what it is: no result replaces them.
    #[cfg_attr(not(feature = "hdf5"), expect(dead_code))]
    pub(crate) files: Vec<(&'static str, std::path::PathBuf)>,
}

/// Comment at the end of the text of a case.
#[cfg(feature = "toml")]
const CHANGED: &str =
    "# A program changed the case after this text was read: it does not say all of what was run.";

impl Model {
    /// A model of a system that was made by [`time_history`](pounding_time_history) itself, as one with
    /// several ground motions or foundations on soil: it runs, warns and is written like any other. Its
    /// record is the ground motion that the system begins with ([`System::ground`]); files that the
    /// system was made of are not known, and not kept from being replaced.
    ///
    /// # Errors
    /// What [`RunOptions::check`] refuses, or a ground motion of fewer than two samples.
    pub fn of_system(system: System, options: RunOptions) -> Result<Self, Error> {
        options.check(&system)?;
        let ground = system.ground();
        let (samples, unit) = (
            ground.samples.to_vec(),
            AccelerationUnit::MetrePerSecondSquared,
        );
        let motion = Accelerogram::new(samples, unit, ground.time_step)?;
        Ok(Self {
            accelerogram: GroundMotion::from(motion).accelerogram().clone(),
            system,
            options,
            output_step: OUTPUT_STEP,
            title: String::new(),
            source: String::new(),
            told: Vec::new(),
            files: Vec::new(),
        })
    }

    /// Gives its results this title.
    #[must_use]
    pub fn with_title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Title of its results: that of the case file, or the one it was given by code; else empty.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Text of the case file, with a comment where [code has changed](Self::of_case) what it says; empty for
    /// what was built by code.
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
    /// the warnings of its outcome: what `pounding run` says, with the words of this library in the place
    /// of keys where the model was built by code.
    #[must_use]
    pub fn warnings(&self, outcome: &Outcome) -> Vec<String> {
        let record = self.accelerogram.origin().map(|o| o.warnings.as_slice());
        let before = record.unwrap_or_default().iter().chain(&self.told).cloned();
        let by_code = self.source.is_empty();
        let of_run = outcome.warnings.iter().map(|warning| match by_code {
            true => help::warning(warning),
            false => warning.to_string(),
        });
        before.chain(of_run).collect()
    }

    /// The system: buildings with their modes, gaps with their contact levels.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// The same buildings alone: without gaps, and without the links that join them.
    #[must_use]
    pub fn isolated(&self) -> Self {
        Self {
            system: self.system.isolated(),
            ..self.clone()
        }
    }

    /// The same buildings with their links but without gaps: what would happen if the floors never
    /// touched.
    #[must_use]
    pub fn without_gaps(&self) -> Self {
        Self {
            system: self.system.without_gaps(),
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
    /// What [`RunOptions::check`] refuses.
    pub fn with_options(mut self, options: RunOptions) -> Result<Self, Error> {
        options.check(&self.system)?;
        self.options = options;
        Ok(self)
    }

    /// Records responses in result files at another step than 0.01 s, or than that of the case file. It
    /// is checked when one is written.
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

    /// The same, asked whether to go on: `progress` is given the part of the duration that is done, each
    /// time that another 250th of it is, after every 10,000 steps in between, and once, with 1, at the end
    /// of a run that came to one. It ends the run by [`ControlFlow::Break`]; at the end there is nothing
    /// left to be ended. Recorders then hold what they have recorded.
    ///
    /// What a run makes before its first step, such as the modes of tall buildings, is made without asking.
    ///
    /// # Errors
    /// As [`run_with`](Self::run_with); [`Error::Stopped`] where `progress` ended it.
    pub fn run_while(
        &self,
        recorders: &mut [&mut dyn Recorder],
        mut progress: impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Outcome, Error> {
        let duration = self.options.check(&self.system)?;
        let mut asked = Progress::new(duration, &mut progress);
        let mut all: Vec<&mut dyn Recorder> = Vec::with_capacity(recorders.len() + 1);
        for recorder in recorders {
            all.push(&mut **recorder);
        }
        // Last, so that the others have the step after which the run ends.
        all.push(&mut asked);
        let outcome = run(&self.system, &self.options, &mut all, &mut |_| {});
        if let Some(done) = asked.stopped() {
            return Err(Error::Stopped { done });
        }
        let outcome = outcome?;
        let _ = progress(1.0);
        Ok(outcome)
    }
}

#[cfg(feature = "toml")]
impl Model {
    /// Reads a case file, and the record that it names.
    ///
    /// # Errors
    /// What is wrong in the file, with line and column.
    pub fn read(path: impl AsRef<std::path::Path>) -> Result<Self, Error> {
        Self::assembled(&Case::read(path.as_ref())?)
    }

    /// A model of a case in memory, as it was read ([`Case::read`], [`Case::parse`]) or as code has
    /// [changed it since](crate#a-case-file-changed-by-code), with its title, its text and the files that
    /// it names. Its record is read, relative to the file that the case names as its own.
    ///
    /// What code has changed does not stand in the text of the case, which results hold: a comment at its
    /// end then says so.
    ///
    /// # Errors
    /// What cannot be, with line and column of the text where it stands, or stood before it was changed.
    pub fn of_case(case: &Case) -> Result<Self, Error> {
        case.check_gaps()?;
        let mut model = Self::assembled(case)?;
        model.system.check_names().map_err(|error| Error::Name {
            reason: match error.fault {
                NameFault::Form => NAMES,
                NameFault::Taken => "another one has it",
            },
            name: error.name,
            what: error.what,
        })?;
        let read = Case::parse(&case.source, &case.file).map(|read| Case {
            given_files: case.given_files.clone(),
            ..read
        });
        if read.as_ref() != Ok(case) {
            model.source = format!("{}\n\n{CHANGED}\n", case.source.trim_end());
        }
        Ok(model)
    }

    /// A model of a case whose text says all of it.
    fn assembled(case: &Case) -> Result<Self, Error> {
        let assembly = pounding_assembly::assemble(case)?;
        let told = assembly.warnings_of_buildings();
        let mut files = vec![("case", case.file.clone())];
        files.extend(case.files());
        let files = files.into_iter().map(|(role, file)| (role, wherever(file)));
        Ok(Self {
            files: files.collect(),
            system: assembly.system,
            accelerogram: assembly.accelerogram,
            options: assembly.options,
            output_step: assembly.output_step,
            told,
            title: case.title.clone(),
            source: case.source.clone(),
        })
    }
}

#[cfg(feature = "hdf5")]
impl Model {
    /// Runs it, and the same buildings [isolated](Self::isolated), and writes responses, peaks, impacts and
    /// ledger to a result file: what `pounding run` writes.
    ///
    /// # Errors
    /// As [`run`](Self::run); an output step that is not positive and finite; a file that cannot be written, or that is the case file or the
    /// record. What stood under its name is untouched then.
    pub fn run_to_file(&self, path: impl AsRef<std::path::Path>) -> Result<Outcome, Error> {
        use pounding_results::{RunEnding, RunHead, RunWriter};
        use pounding_time_history::{GridRecorder, IsolatedRun, run_isolated};

        // What no recorder takes, before the size that it would give is asked for.
        GridRecorder::new(self.output_step)?;
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
        let isolated = run_isolated(&self.system, &self.options, &mut [], &mut |_| {});
        let mut warnings = self.warnings(&outcome);
        let (isolated, told) = IsolatedRun::beside(&outcome, isolated);
        warnings.extend(told);
        writer.responses.finish(&RunEnding {
            outcome: &outcome,
            isolated: &isolated,
            warnings: &warnings,
            wall_time: started.elapsed().as_secs_f64(),
        })?;
        Ok(outcome)
    }
}
