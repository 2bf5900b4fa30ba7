//! Every building by itself, for comparison with what its neighbours do to it.

use std::sync::Arc;

use pounding_shear_building::ShearBuilding;

use crate::driver::run;
use crate::error::TimeHistoryError;
use crate::options::RunOptions;
use crate::outcome::Outcome;
use crate::recorder::Recorder;
use crate::system::{GroundAcceleration, GroundMotion, Support, System};

/// The run of all buildings without gaps and links.
#[derive(Debug)]
pub struct IsolatedRun {
    /// What they do; the peaks of those that collapse are not numbers.
    pub outcome: Outcome,
    /// The collapses, [`TimeHistoryError::Collapse`], in the order in which they were found.
    pub collapses: Vec<TimeHistoryError>,
}

impl IsolatedRun {
    /// What stands beside the outcome of a run, whatever became of the buildings by themselves, and
    /// what is to be said of it: where they have no end, the run still has one.
    #[must_use]
    pub fn beside(
        outcome: &Outcome,
        isolated: Result<Self, TimeHistoryError>,
    ) -> (Outcome, Vec<String>) {
        let alone = "without gaps and links";
        match isolated {
            Ok(Self { outcome, collapses }) => {
                let told = collapses.iter().map(|collapse| {
                    format!("{alone}: {collapse}; there is nothing to compare this building with")
                });
                (outcome, told.collect())
            }
            Err(error) => (
                outcome.with_unknown_peaks(),
                vec![format!(
                    "{alone}: {error}; there is nothing to compare with"
                )],
            ),
        }
    }
}

/// Runs every building of a system by itself. One that collapses has no peaks, and takes those of
/// the others, with which it has nothing to do, not away.
///
/// # Errors
/// Those of [`run`]; a collapse where it is that of the last building.
pub fn run_isolated(
    system: &System,
    options: &RunOptions,
    recorders: &mut [&mut dyn Recorder],
    progress: &mut dyn FnMut(f64),
) -> Result<IsolatedRun, TimeHistoryError> {
    let mut isolated = system.isolated();
    let (mut fallen, mut collapses) = (Vec::new(), Vec::new());
    let mut told = 0.0_f64;
    loop {
        // From the beginning again, which shows nobody less than before.
        let mut further = |part: f64| {
            told = told.max(part);
            progress(told);
        };
        let error = match run(&isolated, options, recorders, &mut further) {
            Ok(outcome) => {
                return Ok(IsolatedRun {
                    outcome: outcome.with_unknown_peaks_of(&fallen),
                    collapses,
                });
            }
            Err(error) => error,
        };
        let TimeHistoryError::Collapse { building, .. } = &error else {
            return Err(error);
        };
        let mut buildings = system.buildings().iter();
        let found = buildings.position(|b| b.name() == building);
        let Some(index) =
            found.filter(|i| fallen.len() + 1 < system.buildings().len() && !fallen.contains(i))
        else {
            return Err(error);
        };
        fallen.push(index);
        isolated = at_rest(system, &fallen)?;
        collapses.push(error);
    }
}

/// The buildings without gaps and links, of which some stay at rest: the ground under them does not
/// move, and nothing pushes them.
fn at_rest(system: &System, fallen: &[usize]) -> Result<System, TimeHistoryError> {
    let stands = |building: usize| !fallen.contains(&building);
    let first = || GroundMotion {
        acceleration: system.ground().clone(),
        delay: 0.0,
        origin: Vec::new(),
    };
    let mut motions = match system.ground_motions() {
        [] => vec![first()],
        all => all.to_vec(),
    };
    let still = GroundMotion {
        acceleration: GroundAcceleration {
            samples: Arc::new(vec![0.0; 2]),
            time_step: system.ground().time_step,
        },
        delay: 0.0,
        origin: Vec::new(),
    };
    let under = |building| match stands(building) {
        true => system.support(building),
        false => Support {
            along: motions.len(),
            across: None,
        },
    };
    let supports = (0..system.buildings().len()).map(under).collect();
    motions.push(still);
    let buildings: Vec<Arc<ShearBuilding>> = system.buildings().to_vec();
    let mut alone = System::with_motions(buildings, motions, supports)?;
    let forces = system
        .forces()
        .iter()
        .filter(|force| stands(force.building));
    alone = alone.with_forces(forces.cloned().collect())?;
    let floors = system.floors();
    let of_floors = |values: &[f64]| {
        let mut values = values[..floors].to_vec();
        for building in fallen {
            values[system.offsets()[*building]..system.offsets()[building + 1]].fill(0.0);
        }
        values
    };
    let (u, v) = system
        .initial_state()
        .split_at(system.initial_state().len() / 2);
    let (u, v) = (of_floors(u), of_floors(v));
    match u.iter().chain(&v).all(|x| *x == 0.0) {
        true => Ok(alone),
        false => alone.with_initial_state(&u, &v),
    }
}
