//! What equipment on floors feels: response spectra of floors, with pounding and of the buildings alone.

#[cfg(feature = "results")]
mod suite;

#[cfg(feature = "results")]
pub use suite::{
    AccelerationsOverRecords, FloorOverRecords, FloorSpectraOfRecord, FloorSpectraOverRecords,
    RecordWithoutSpectra, SpectraOverRecords, floor_spectra_under,
};

use std::cell::Cell;
use std::ops::ControlFlow;

use pounding_assembly::Assembly;
use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::{FloorMotion, ResponseSpectrum, floor_spectrum};
use pounding_time_history::{
    History, Outcome, Recorder, StepView, System, TimeHistoryError, run as integrate,
};
use serde::Serialize;

use crate::gap_check::CheckError;

/// What is to be known of rigid impacts.
const RIGID: &str = "rigid impacts are jumps of the velocity: spectra hold what they do to equipment, peak accelerations of floors leave them out";
/// Pieces of the motions of floors in the shortest period, at least.
const PIECES_OF_A_PERIOD: f64 = 50.0;
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
    /// The run with pounding under one of several records.
    #[error("record {record}: {error}")]
    Record {
        /// Name of the record.
        record: String,
        /// Why it has no end.
        error: Box<TimeHistoryError>,
    },
    /// Records of which none counts.
    #[error("no record has spectra; {}", reasons.join("; "))]
    NoRecord {
        /// Why each has none, by its name.
        reasons: Vec<String>,
    },
    /// Work under several records.
    #[error(transparent)]
    Records(Box<CheckError>),
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
            Self::Records(error) => error.help(),
            Self::NoRecord { .. } => Some("take weaker records, or a smaller `scale`".to_owned()),
            Self::Run(_) | Self::Record { .. } | Self::Stopped => None,
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
    /// Longest piece of the motions of the floors (s).
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

/// Part of the time that runs take, about; spectra take the rest.
const RUNS: f64 = 0.1;

/// Runs a case with its gaps and links and without them, and gives the spectra of its floors for each list of periods (s), of
/// which none should be shorter than the shortest that is wanted; `progress` is told how far all of it is, from 0 to 1, and
/// says whether to go on. Beside them stands why there is no run of the buildings alone, if so.
///
/// # Errors
/// Periods and damping ratios that no spectrum has, those of the run with pounding, and [`FloorSpectraError::Stopped`].
pub fn floor_spectra(
    assembly: &Assembly,
    wanted: FloorSpectraWanted<'_>,
    lists: &[&[f64]],
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Vec<FloorSpectra>, Option<String>), FloorSpectraError> {
    let motions = FloorMotions::new(assembly, wanted, &mut |part| progress(RUNS * part))?;
    let all: usize = lists.iter().map(|periods| periods.len()).sum();
    let share = |periods: usize| (1.0 - RUNS) * periods as f64 / all.max(1) as f64;
    let (mut from, mut answers) = (RUNS, Vec::new());
    for periods in lists {
        let own = share(periods.len());
        answers.push(motions.spectra(periods, &mut |part| progress(from + own * part))?);
        from += own;
    }
    Ok((answers, motions.alone_fails))
}

/// Runs of a case with its gaps and links and without them, with the motions of some floors.
#[derive(Debug)]
struct FloorMotions<'a> {
    assembly: &'a Assembly,
    floors: &'a [FloorPlace],
    dampings: &'a [f64],
    time_step: f64,
    with: (Outcome, Motions),
    alone: Option<(Outcome, Motions)>,
    /// Why there is no run of the buildings alone.
    alone_fails: Option<String>,
    warnings: Vec<String>,
}

impl<'a> FloorMotions<'a> {
    /// Runs the case; `progress` is told how far it is, from 0 to 1, and says whether to go on.
    ///
    /// # Errors
    /// Periods and damping ratios that no spectrum has, and those of the run with pounding.
    fn new(
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
        // A part of the step of the record, whose samples are among the ends of pieces.
        let shortest = periods.iter().copied().fold(f64::INFINITY, f64::min);
        let step = assembly.accelerogram.time_step();
        let time_step = step / (step * PIECES_OF_A_PERIOD / shortest).ceil().max(1.0);
        let system = &assembly.system;
        let mut run = |from: f64, system: &System| {
            recorded(assembly, system, (floors, time_step), &mut |part| {
                progress(from + 0.5 * part)
            })
        };
        let with = run(0.0, system)?;
        let alone = run(0.5, &system.isolated());
        let mut warnings = assembly.with_those_of_the_record(&with.0.warnings);
        let (alone, alone_fails) = match alone {
            Ok(alone) => (Some(alone), None),
            Err(FloorSpectraError::Stopped) => return Err(FloorSpectraError::Stopped),
            Err(error) => (
                None,
                Some(format!(
                    "the buildings without gaps and links have no run, and so no spectrum to compare with: {error}"
                )),
            ),
        };
        warnings.extend(alone_fails.clone());
        let mut levels = system.gaps().iter().flat_map(|gap| system.levels_of(gap));
        if impacts(&with.0) > 0 && levels.any(|l| l.model.rigid_restitution().is_some()) {
            warnings.push(RIGID.to_owned());
        }
        Ok(Self {
            assembly,
            floors,
            dampings,
            time_step,
            with,
            alone,
            alone_fails,
            warnings,
        })
    }

    /// The spectra at these periods (s), none of which should be shorter than the shortest that the motions were made for;
    /// `progress` is told how far it is, from 0 to 1, and says whether to go on.
    ///
    /// # Errors
    /// Periods that no spectrum has, and [`FloorSpectraError::Stopped`].
    fn spectra(
        &self,
        periods: &[f64],
        progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
    ) -> Result<FloorSpectra, FloorSpectraError> {
        let numbered = self.floors.iter().enumerate();
        let of_motion = 2 + usize::from(self.alone.is_some());
        let mut work = Work {
            done: 0,
            total: self.floors.len() * self.dampings.len() * of_motion * periods.len(),
            progress,
        };
        let floors =
            numbered.map(|(number, place)| self.of_floor(number, *place, (periods, &mut work)));
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
        (periods, work): (&[f64], &mut Work<'_>),
    ) -> Result<FloorWithSpectra, FloorSpectraError> {
        let building = &self.assembly.system.buildings()[place.building];
        let peak = |(outcome, _): &(Outcome, Motions)| {
            let storeys = &outcome.buildings[place.building].storeys;
            storeys[place.storey].acceleration_absolute.value
        };
        let spectra = self.dampings.iter().map(|damping| {
            let (_, with) = &self.with;
            let mut spectrum = |motion: &[FloorMotion]| work.spectrum(motion, periods, *damping);
            Ok(SpectraOfFloor {
                ground: spectrum(&of_ground(&with[number]))?,
                pounding: spectrum(&with[number])?,
                alone: match &self.alone {
                    Some((_, motions)) => Some(spectrum(&motions[number])?),
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

/// A run with the motions of these floors, in pieces of at most this time (s).
fn recorded(
    assembly: &Assembly,
    system: &System,
    (floors, time_step): (&[FloorPlace], f64),
    progress: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(Outcome, Motions), FloorSpectraError> {
    let stopped = Cell::new(false);
    let mut recorder = PieceRecorder {
        system,
        places: floors,
        grid: Grid { time_step, next: 1 },
        stopped: &stopped,
        rows: History::default(),
        motions: vec![Vec::new(); floors.len()],
    };
    let recorders: &mut [&mut dyn Recorder] = &mut [&mut recorder];
    let outcome = integrate(system, &assembly.options, recorders, &mut |part| {
        stopped.set(progress(part).is_break());
    });
    match outcome {
        Err(_) if stopped.get() => Err(FloorSpectraError::Stopped),
        outcome => Ok((outcome?, recorder.motions)),
    }
}

/// Motions of floors of a run.
type Motions = Vec<Vec<FloorMotion>>;

/// Records the motions of floors from one time of an even grid to the next, and from there to the ends of steps, which are
/// where contacts begin and end and velocities jump.
struct PieceRecorder<'s> {
    system: &'s System,
    places: &'s [FloorPlace],
    grid: Grid,
    /// Whether the run has to end.
    stopped: &'s Cell<bool>,
    /// Those of the step that is taken.
    rows: History,
    motions: Motions,
}

/// An even grid of times, beside which steps end.
struct Grid {
    /// Step (s).
    time_step: f64,
    /// Number of its next time.
    next: usize,
}

/// A time this near to one of the grid is that one, in parts of its step: steps end beside samples by round-off.
const ON_GRID: f64 = 1.0e-9;
/// The same in parts of the time, of which ends of steps have a few times the round-off: what is longer than a hundred
/// thousand steps of the grid has more of it than the part of a step. A piece of round-off would have accelerations of none.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

impl Grid {
    /// The times in a step, its start and end among them; and whether each is one of the grid.
    fn times(&mut self, start: f64, end: f64) -> (Vec<f64>, Vec<bool>) {
        let close = (ON_GRID * self.time_step).max(ROUND_OFF * end);
        let before = (self.next - 1) as f64 * self.time_step;
        let (mut times, mut on_grid) = (vec![start], vec![(start - before).abs() <= close]);
        loop {
            let time = self.next as f64 * self.time_step;
            if time > end + close {
                break;
            }
            times.push(time.min(end));
            on_grid.push(true);
            self.next += 1;
        }
        if end - times[times.len() - 1] > close {
            times.push(end);
            on_grid.push(false);
        }
        (times, on_grid)
    }
}

impl Recorder for PieceRecorder<'_> {
    fn begin(&mut self, _system: &System, _start: &History) -> Result<(), TimeHistoryError> {
        Ok(())
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        if self.stopped.get() {
            return Err(TimeHistoryError::Recorder("stopped".to_owned()));
        }
        let (times, on_grid) = self.grid.times(step.start(), step.end());
        self.rows.clear();
        step.append(&times, &mut self.rows);
        let rows = &self.rows;
        for (motions, place) in self.motions.iter_mut().zip(self.places) {
            let column = self.system.offsets()[place.building] + place.storey;
            let displacement = rows.column(&rows.displacement, column);
            let velocity = rows.column(&rows.velocity, column);
            let ground = match self.system.motions_under(place.building)[0] {
                None => rows.ground_acceleration.clone(),
                Some(own) => rows.time.iter().map(|time| own.at(*time)).collect(),
            };
            for i in 1..times.len() {
                // Lengths that are equal but for round-off are: steps of oscillators are made for each length.
                let length = match on_grid[i - 1] && on_grid[i] {
                    true => self.grid.time_step,
                    false => times[i] - times[i - 1],
                };
                let both = |values: &[f64]| [values[i - 1], values[i]];
                motions.push(FloorMotion {
                    length,
                    ground: both(&ground),
                    displacement: both(&displacement),
                    velocity: both(&velocity),
                });
            }
        }
        Ok(())
    }
}

/// The motion of the ground below a floor, as of one that does not move on it.
fn of_ground(motion: &[FloorMotion]) -> Vec<FloorMotion> {
    let still = |piece: &FloorMotion| FloorMotion {
        displacement: [0.0; 2],
        velocity: [0.0; 2],
        ..*piece
    };
    motion.iter().map(still).collect()
}

/// Periods between two questions whether to go on.
const PERIODS_AT_ONCE: usize = 16;

/// How far the spectra are.
struct Work<'p> {
    /// Periods of all spectra: done, and in all.
    done: usize,
    total: usize,
    progress: &'p mut dyn FnMut(f64) -> ControlFlow<()>,
}

impl Work<'_> {
    fn spectrum(
        &mut self,
        motion: &[FloorMotion],
        periods: &[f64],
        damping: f64,
    ) -> Result<ResponseSpectrum, FloorSpectraError> {
        let (first, rest) = periods.split_at(periods.len().min(PERIODS_AT_ONCE));
        let mut all = self.part(motion, first, damping)?;
        for part in rest.chunks(PERIODS_AT_ONCE) {
            all.append(self.part(motion, part, damping)?);
        }
        Ok(all)
    }

    fn part(
        &mut self,
        motion: &[FloorMotion],
        periods: &[f64],
        damping: f64,
    ) -> Result<ResponseSpectrum, FloorSpectraError> {
        let spectrum = floor_spectrum(motion, periods, damping)?;
        self.done += periods.len();
        match (self.progress)(self.done as f64 / self.total.max(1) as f64) {
            ControlFlow::Continue(()) => Ok(spectrum),
            ControlFlow::Break(()) => Err(FloorSpectraError::Stopped),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps over samples of 0.02 s that end by round-off beside them, for an hour, with an event now and then: every piece is
    /// a whole one, or ends at an event.
    #[test]
    fn steps_end_on_the_grid_however_late() {
        let time_step = 0.02 / 94.0;
        for round_off in [0.0, 8.0 * f64::EPSILON, -8.0 * f64::EPSILON] {
            let mut grid = Grid { time_step, next: 1 };
            let (mut whole, mut others) = (0, 0);
            let mut step = |start: f64, end: f64| {
                let (times, on_grid) = grid.times(start, end * (1.0 + round_off));
                for i in 1..times.len() {
                    match on_grid[i - 1] && on_grid[i] {
                        true => whole += 1,
                        false => others += 1,
                    }
                    let length = times[i] - times[i - 1];
                    assert!(length > 0.01 * time_step, "{start}: {length:e}");
                }
            };
            for sample in 0..180_000 {
                let (start, end) = (0.02 * f64::from(sample), 0.02 * f64::from(sample + 1));
                match sample % 1000 {
                    999 => {
                        step(start, start + 0.003_3);
                        step(start + 0.003_3, end);
                    }
                    _ => step(start, end),
                }
            }
            assert_eq!((whole, others), (180_000 * 94 - 180, 360), "{round_off:e}");
        }
    }
}
