//! Buildings on the ground motions that move them.

use std::sync::Arc;

use pounding_case::{Case, Located};
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::processing::ProcessingStep;
use pounding_shear_building::ShearBuilding;
use pounding_time_history::{GroundAcceleration, GroundMotion, Support, System};

use super::forces::on_floors;
use super::initial_motion;
use crate::error::AssemblyError;
use crate::excitation::further_record;

/// A record as the time history takes it.
pub(super) fn ground(accelerogram: &Accelerogram) -> GroundAcceleration {
    GroundAcceleration {
        samples: accelerogram.shared_samples(),
        time_step: accelerogram.time_step(),
    }
}

/// Refuses components of one file of which only that along the row is turned: they are not at right
/// angles, but for quarters of a turn.
fn refuse_one_turned_component(
    case: &Case,
    across: &Located<Box<pounding_case::GroundMotion>>,
) -> Result<(), AssemblyError> {
    let along = &case.ground_motion;
    let of_one_file = across.value.file.value == along.file.value;
    match (&along.rotation, &across.value.rotation) {
        (Some(turned), None) if of_one_file && turned.angle % 90.0 != 0.0 => {
            let first = along.component.as_deref().unwrap_or("...");
            let (second, angle) = (&turned.second_component.value, turned.angle);
            let message = "`rotate` turns the component along the row, and that across it, of the same file, is not turned: they are not at right angles";
            let help = format!(
                "turn both: across = {{ file = ..., component = \"{second}\", second_component = \"{first}\", rotate = {} }}",
                -angle
            );
            let error = case.error(across.span.clone(), message.to_owned(), Some(help));
            Err(error.into())
        }
        _ => Ok(()),
    }
}

/// What is wrong with a record across the row, and what to do, where no building turns in plan.
#[must_use]
pub fn nothing_to_move_across(case: &Case) -> Option<(&'static str, &'static str)> {
    let turns = case
        .buildings
        .iter()
        .any(|building| building.plan.is_some());
    let across = case.ground_motion.across.is_some();
    (across && !turns).then_some((
        "a record across the row has nothing to move: no building turns in plan",
        "leave `across` out, or give a building a `plan`",
    ))
}

/// The buildings of a case without gaps, each on its ground, that of the record given, now or
/// later, or of a record of its own, with the forces on its floors.
pub(super) fn on_their_ground(
    case: &Case,
    buildings: Vec<Arc<ShearBuilding>>,
    accelerogram: &Accelerogram,
) -> Result<(System, Vec<String>), AssemblyError> {
    let first = ground(accelerogram);
    let mut records = vec![("of the case".to_owned(), accelerogram.clone())];
    let mut motions = vec![GroundMotion {
        acceleration: first.clone(),
        delay: 0.0,
        origin: Vec::new(),
    }];
    let across = match &case.ground_motion.across {
        None => None,
        Some(given) => {
            if let Some((message, help)) = nothing_to_move_across(case) {
                let error = case.error(
                    given.span.clone(),
                    message.to_owned(),
                    Some(help.to_owned()),
                );
                return Err(error.into());
            }
            refuse_one_turned_component(case, given)?;
            let record = further_record(case, &given.value)?;
            Some((ground(&record), record.echo()))
        }
    };
    let mut supports = Vec::new();
    for building in &case.buildings {
        let mut along = 0;
        if let Some(given) = &building.ground {
            let (delay, own) = (given.value.delay, &given.value.motion);
            let same = |m: &GroundMotion| {
                m.delay == delay && Arc::ptr_eq(&m.acceleration.samples, &first.samples)
            };
            let known = motions.iter().position(same).filter(|_| own.is_none());
            along = match (known, own) {
                (Some(known), _) => known,
                (None, own) => {
                    let (acceleration, origin) = match own {
                        None => (first.clone(), Vec::new()),
                        Some(motion) => {
                            let record = further_record(case, motion)?;
                            let found = (ground(&record), record.echo());
                            records.push((format!("of {}", building.name.value), record));
                            found
                        }
                    };
                    motions.push(GroundMotion {
                        acceleration,
                        delay,
                        origin,
                    });
                    motions.len() - 1
                }
            };
        }
        let across =
            across
                .as_ref()
                .filter(|_| building.plan.is_some())
                .map(|(acceleration, origin)| {
                    let delay = motions[along].delay;
                    let same = |m: &GroundMotion| {
                        m.delay == delay
                            && Arc::ptr_eq(&m.acceleration.samples, &acceleration.samples)
                    };
                    motions.iter().position(same).unwrap_or_else(|| {
                        motions.push(GroundMotion {
                            acceleration: acceleration.clone(),
                            delay,
                            origin: origin.clone(),
                        });
                        motions.len() - 1
                    })
                });
        supports.push(Support { along, across });
    }
    let system = match motions.len() {
        1 => System::new(buildings, first),
        _ => System::with_motions(buildings, motions, supports)?,
    };
    Ok((on_floors(case, system)?, initial_motion::left_out(&records)))
}

/// Seconds by which times of motions may differ and be the same to people.
const SAME_TIME: f64 = 0.05;

/// Zeros (s) that the filters of a record put before it.
fn zeros_before(motion: &pounding_case::GroundMotion) -> f64 {
    let mut zeros = 0.0_f64;
    for step in &motion.process {
        match &step.value {
            ProcessingStep::Filter(filter) => zeros += filter.zeros_at_each_end(),
            // Whoever cuts a record knows where it begins.
            ProcessingStep::Trim(_) => zeros = 0.0,
            _ => {}
        }
    }
    zeros
}

/// Motions and forces that were in step with one another before filters put zeros before some of them, in words.
pub(super) fn out_of_step(case: &Case) -> Vec<String> {
    let own = zeros_before(&case.ground_motion);
    let remedy = "in the filters `keep_pads = false` leaves the zeros out";
    let differs = |zeros: f64| (zeros - own).abs() > SAME_TIME;
    let mut told = Vec::new();
    let mut tell = |what: &str, zeros: f64| {
        told.push(format!(
            "filters put {own:.2} s of zeros before the record of the case, and {zeros:.2} s before {what}: they do not begin together; {remedy}"
        ));
    };
    for building in &case.buildings {
        let motion = building
            .ground
            .as_ref()
            .and_then(|g| g.value.motion.as_ref());
        if let Some(zeros) = motion.map(zeros_before).filter(|zeros| differs(*zeros)) {
            tell(&format!("that of {}", building.name.value), zeros);
        }
    }
    if let Some(across) = &case.ground_motion.across {
        let zeros = zeros_before(&across.value);
        if differs(zeros) {
            tell("that across the row", zeros);
        }
    }
    if own > SAME_TIME && case.buildings.iter().any(|b| !b.forces.is_empty()) {
        told.push(format!(
            "filters put {own:.2} s of zeros before the record, and forces on floors begin with them: {remedy}, or let forces begin later"
        ));
    }
    told
}
