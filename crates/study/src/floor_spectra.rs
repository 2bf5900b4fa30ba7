//! What equipment on floors feels: response spectra of floors, with pounding and of the buildings alone.

use std::ops::ControlFlow;

use pounding_assembly::Assembly;
use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::{FloorMotion, ResponseSpectrum, floor_spectrum};
use pounding_time_history::{
    GridRecorder, History, HistorySink, Outcome, Recorder, StepView, System, TimeHistoryError,
    run as integrate,
};
use serde::Serialize;

/// Rows of the motions of floors in the shortest period: what happens within a row counts 0.07 % low.
const ROWS_OF_A_PERIOD: f64 = 50.0;
/// The shortest period (s): equipment of shorter ones feels the peak acceleration of the floor.
pub const SHORTEST_PERIOD: f64 = 1.0e-3;

/// A floor: building and storey, both from zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FloorPlace {
    /// Number of the building, from the left.
    pub building: usize,
    /// Number of the storey below it.
    pub storey: usize,
}

/// Why there are no spectra.
#[derive(Debug, thiserror::Error)]
pub enum FloorSpectraError {
    /// A floor that the case does not have.
    #[error("{message}")]
    Floor {
        /// What it is.
        message: String,
        /// What there is.
        help: String,
    },
    /// A period that is too short, or none.
    #[error("a period of {period} s is not {SHORTEST_PERIOD} s at least")]
    Period {
        /// The period (s).
        period: f64,
    },
    /// A damping ratio that is none.
    #[error("a damping ratio of {damping} is not between 0 and 1")]
    Damping {
        /// The ratio.
        damping: f64,
    },
    /// The run with pounding.
    #[error(transparent)]
    Run(#[from] TimeHistoryError),
    /// A spectrum.
    #[error(transparent)]
    Spectrum(#[from] GroundMotionError),
    /// Who asked does not want it any more.
    #[error("stopped")]
    Stopped,
}

impl FloorSpectraError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        match self {
            Self::Floor { help, .. } => Some(help.clone()),
            Self::Period { .. } => Some(
                "give longer periods: what is stiffer feels the peak acceleration of the floor"
                    .to_owned(),
            ),
            Self::Damping { .. } => {
                Some("give ratios of the critical damping, such as 0.05".to_owned())
            }
            Self::Spectrum(error) => error.help(),
            Self::Run(_) | Self::Stopped => None,
        }
    }
}

/// Peak absolute acceleration of a floor (m/s2).
#[derive(Debug, Clone, Copy, Serialize)]
pub struct FloorPeaks {
    /// With pounding, without jumps of the velocity.
    pub pounding: f64,
    /// Of the building alone.
    pub alone: Option<f64>,
}

/// Spectra of a floor of one damping ratio.
#[derive(Debug, Clone, Serialize)]
pub struct SpectraOfFloor {
    /// Of the ground under the building.
    pub ground: ResponseSpectrum,
    /// With pounding.
    pub pounding: ResponseSpectrum,
    /// Of the building without gaps and links, if there is such a run.
    pub alone: Option<ResponseSpectrum>,
}

/// A floor with its spectra.
#[derive(Debug, Clone, Serialize)]
pub struct FloorWithSpectra {
    /// Name of its building.
    pub building: String,
    /// Number of the storey below it, from 1 at the bottom.
    pub storey: usize,
    /// Whether it is the uppermost.
    pub is_roof: bool,
    /// Above the ground (m).
    pub elevation: f64,
    /// Peak absolute acceleration of the floor itself.
    pub peak_acceleration: FloorPeaks,
    /// By damping ratio.
    pub spectra: Vec<SpectraOfFloor>,
}

/// What equipment on floors feels.
#[derive(Debug, Clone, Serialize)]
pub struct FloorSpectra {
    /// The floors in the order in which they are asked for.
    pub floors: Vec<FloorWithSpectra>,
    /// Impacts at all gaps.
    pub impacts: usize,
    /// Of the motions of the floors (s).
    pub time_step: f64,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Periods (s), damping ratios and floors of which spectra are wanted.
#[derive(Debug, Clone, Copy)]
pub struct FloorSpectraWanted<'w> {
    /// The floors.
    pub floors: &'w [FloorPlace],
    /// Periods (s), from [`SHORTEST_PERIOD`] on.
    pub periods: &'w [f64],
    /// Damping ratios (-) from 0 to below 1.
    pub dampings: &'w [f64],
}

/// The roofs of all buildings.
#[must_use]
pub fn roofs(system: &System) -> Vec<FloorPlace> {
    let buildings = system.buildings().iter().enumerate();
    let roof = |(building, b): (usize, &std::sync::Arc<_>)| {
        let b: &pounding_shear_building::ShearBuilding = b;
        FloorPlace {
            building,
            storey: b.storeys() - 1,
        }
    };
    buildings.map(roof).collect()
}

/// The floor above a storey, from 1 at the bottom, of the building of this name.
///
/// # Errors
/// [`FloorSpectraError::Floor`].
pub fn floor_above(
    system: &System,
    building: &str,
    storey: &str,
) -> Result<FloorPlace, FloorSpectraError> {
    let refused = |message: String, help: String| Err(FloorSpectraError::Floor { message, help });
    let buildings = system.buildings();
    let Some(index) = buildings.iter().position(|b| b.name() == building) else {
        let names: Vec<&str> = buildings.iter().map(|b| b.name()).collect();
        let help = format!("its buildings are {}", names.join(", "));
        return refused(format!("the case has no building \"{building}\""), help);
    };
    let storeys = buildings[index].storeys();
    match storey.parse::<usize>() {
        Ok(number) if (1..=storeys).contains(&number) => Ok(FloorPlace {
            building: index,
            storey: number - 1,
        }),
        _ => refused(
            format!("{building} has no storey \"{storey}\""),
            format!("its storeys are 1, at the bottom, to {storeys}"),
        ),
    }
}

/// Runs of a case with its gaps and links and without them, with the motions of some floors.
#[derive(Debug)]
pub struct FloorMotions<'a> {
    assembly: &'a Assembly,
    floors: &'a [FloorPlace],
    dampings: &'a [f64],
    time_step: f64,
    with: (Outcome, Motions),
    alone: Option<(Outcome, Motions)>,
    warnings: Vec<String>,
}

impl<'a> FloorMotions<'a> {
    /// Runs the case; `progress` is told how far it is, from 0 to 1, and says whether to go on.
    ///
    /// # Errors
    /// Periods and damping ratios that no spectrum has, and those of the run with pounding.
    pub fn new(
        assembly: &'a Assembly,
        wanted: FloorSpectraWanted<'a>,
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Self, FloorSpectraError> {
        let FloorSpectraWanted {
            floors,
            periods,
            dampings,
        } = wanted;
        let is_short = |period: &&f64| !(**period >= SHORTEST_PERIOD) || period.is_infinite();
        if let Some(period) = periods.iter().find(is_short) {
            return Err(FloorSpectraError::Period { period: *period });
        }
        if let Some(damping) = dampings.iter().find(|d| !(0.0..1.0).contains(*d)) {
            return Err(FloorSpectraError::Damping { damping: *damping });
        }
        // A part of the step of the record, so that rows have all that the ground does.
        let shortest = periods.iter().copied().fold(f64::INFINITY, f64::min);
        let step = assembly.accelerogram.time_step();
        let time_step = step / (step * ROWS_OF_A_PERIOD / shortest).ceil().max(1.0);
        let system = &assembly.system;
        let mut run = |from: f64, system: &System| {
            recorded(assembly, system, (floors, time_step), &mut |part| {
                progress(from + 0.5 * part)
            })
        };
        let with = run(0.0, system)?;
        let alone = run(0.5, &system.isolated());
        let mut warnings = assembly.with_those_of_the_record(&with.0.warnings);
        let alone = match alone {
            Ok(alone) => Some(alone),
            Err(FloorSpectraError::Stopped) => return Err(FloorSpectraError::Stopped),
            Err(error) => {
                warnings.push(format!(
                    "the buildings without gaps and links have no run, and so no spectrum to compare with: {error}"
                ));
                None
            }
        };
        let mut levels = system.gaps().iter().flat_map(|gap| system.levels_of(gap));
        if impacts(&with.0) > 0 && levels.any(|l| l.model.rigid_restitution().is_some()) {
            warnings.push("rigid impacts are jumps of the velocity: spectra hold what they do to equipment, peak accelerations of floors leave them out".to_owned());
        }
        Ok(Self {
            assembly,
            floors,
            dampings,
            time_step,
            with,
            alone,
            warnings,
        })
    }

    /// The spectra at these periods (s), none of which should be shorter than the shortest that the motions were made for.
    ///
    /// # Errors
    /// Periods that no spectrum has.
    pub fn spectra(&self, periods: &[f64]) -> Result<FloorSpectra, FloorSpectraError> {
        let numbered = self.floors.iter().enumerate();
        let floors = numbered.map(|(number, place)| self.of_floor(number, *place, periods));
        Ok(FloorSpectra {
            floors: floors.collect::<Result<_, _>>()?,
            impacts: impacts(&self.with.0),
            time_step: self.time_step,
            warnings: self.warnings.clone(),
        })
    }

    fn of_floor(
        &self,
        number: usize,
        place: FloorPlace,
        periods: &[f64],
    ) -> Result<FloorWithSpectra, FloorSpectraError> {
        let building = &self.assembly.system.buildings()[place.building];
        let peak = |(outcome, _): &(Outcome, Motions)| {
            let storeys = &outcome.buildings[place.building].storeys;
            storeys[place.storey].acceleration_absolute.value
        };
        let spectra = self.dampings.iter().map(|damping| {
            let of = (self.time_step, periods, *damping);
            let (_, with) = &self.with;
            Ok(SpectraOfFloor {
                ground: with.floors[number].of_ground(of)?,
                pounding: with.floors[number].spectrum(of)?,
                alone: match &self.alone {
                    Some((_, motions)) => Some(motions.floors[number].spectrum(of)?),
                    None => None,
                },
            })
        });
        Ok(FloorWithSpectra {
            building: building.name().to_owned(),
            storey: place.storey + 1,
            is_roof: place.storey + 1 == building.storeys(),
            elevation: building.elevations()[place.storey],
            peak_acceleration: FloorPeaks {
                pounding: peak(&self.with),
                alone: self.alone.as_ref().map(peak),
            },
            spectra: spectra.collect::<Result<_, FloorSpectraError>>()?,
        })
    }
}

fn impacts(outcome: &Outcome) -> usize {
    let levels = outcome.gaps.iter().flat_map(|gap| &gap.levels);
    levels.map(|level| level.impacts).sum()
}

/// Ends a run whose progress nobody wants to see any more.
struct Stop<'p> {
    stopped: &'p std::cell::Cell<bool>,
}

impl Recorder for Stop<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        Ok(())
    }

    fn step(&mut self, _step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        match self.stopped.get() {
            false => Ok(()),
            true => Err(TimeHistoryError::Recorder("stopped".to_owned())),
        }
    }
}

/// A run with the motions of these floors.
fn recorded(
    assembly: &Assembly,
    system: &System,
    (floors, time_step): (&[FloorPlace], f64),
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Outcome, Motions), FloorSpectraError> {
    let sink = Sink {
        system,
        places: floors,
        motions: Motions {
            floors: vec![MotionOfFloor::default(); floors.len()],
        },
    };
    let stopped = std::cell::Cell::new(false);
    let mut stop = Stop { stopped: &stopped };
    let mut recorder = GridRecorder::into_sink(time_step, sink)?;
    let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder, &mut stop];
    let outcome = integrate(system, &assembly.options, recorders, &mut |part| {
        stopped.set(progress(part).is_break());
    });
    match outcome {
        Err(_) if stopped.get() => Err(FloorSpectraError::Stopped),
        outcome => Ok((outcome?, recorder.responses.motions)),
    }
}

/// Motion of one floor at even times.
#[derive(Debug, Clone, Default)]
struct MotionOfFloor {
    ground: Vec<f64>,
    displacement: Vec<f64>,
    velocity: Vec<f64>,
}

impl MotionOfFloor {
    fn spectrum(
        &self,
        (time_step, periods, damping): (f64, &[f64], f64),
    ) -> Result<ResponseSpectrum, GroundMotionError> {
        let motion = FloorMotion {
            time_step,
            ground: &self.ground,
            displacement: &self.displacement,
            velocity: &self.velocity,
        };
        floor_spectrum(&motion, periods, damping)
    }

    /// That of the ground under it.
    fn of_ground(
        &self,
        (time_step, periods, damping): (f64, &[f64], f64),
    ) -> Result<ResponseSpectrum, GroundMotionError> {
        let still = vec![0.0; self.ground.len()];
        let motion = FloorMotion {
            time_step,
            ground: &self.ground,
            displacement: &still,
            velocity: &still,
        };
        floor_spectrum(&motion, periods, damping)
    }
}

/// Motions of floors of a run.
#[derive(Debug)]
struct Motions {
    floors: Vec<MotionOfFloor>,
}

/// Keeps them of the rows of a recorder, and nothing else.
struct Sink<'s> {
    system: &'s System,
    places: &'s [FloorPlace],
    motions: Motions,
}

impl HistorySink for Sink<'_> {
    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        for (motion, place) in self.motions.floors.iter_mut().zip(self.places) {
            let column = self.system.offsets()[place.building] + place.storey;
            let of_floor = |list: &[f64]| rows.column(list, column);
            motion.displacement.extend(of_floor(&rows.displacement));
            motion.velocity.extend(of_floor(&rows.velocity));
            match self.system.motions_under(place.building)[0] {
                None => motion.ground.extend(&rows.ground_acceleration),
                Some(own) => motion.ground.extend(rows.time.iter().map(|t| own.at(*t))),
            }
        }
        Ok(())
    }
}
