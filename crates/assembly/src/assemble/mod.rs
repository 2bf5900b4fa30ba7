//! Buildings, models, gaps, links and options of a case, put together.

mod again;
mod band;
mod column;
mod excitation;
mod forces;
mod foundation;
mod impact_models;
mod initial_motion;
mod lateral;
mod laws;
mod method;
mod motions;
mod parts;
mod plan;
mod unlikely;

pub use again::{assemble_at_rest, assemble_with_record, assemble_without_gaps, regap};
pub use excitation::{
    RecordFiles, further_record, process_record, read_record, read_target, scale_record,
    scale_target,
};
pub use impact_models::parameters_of_gap;
pub use laws::{parameters_of_frames, parameters_of_link, parameters_of_storeys};
pub(crate) use method::method_names;
pub use method::methods_that_take;
pub use motions::nothing_to_move_across;

use std::sync::Arc;

use pounding_case::{Building, Case, CaseError, Facing, Gap, Side};
use pounding_gap_element::ImpactModel;
use pounding_ground_motion::Accelerogram;
use pounding_shear_building::WALL;
use pounding_time_history::{
    Floor, LevelMotion, RunOptions, System, TimeHistoryError, Warning, more_pairs,
};

use self::column::Hits;
use crate::error::AssemblyError;
use excitation::accelerogram;
use motions::{Whose, on_their_ground};
use parts::Parts;

/// All that a run needs, made from a case.
#[derive(Debug, Clone)]
pub struct Assembly {
    /// Buildings, gaps, ground acceleration.
    pub system: System,
    /// Method, duration, tolerances.
    pub options: RunOptions,
    /// Step of recorded responses (s).
    pub output_step: f64,
    /// The record, scaled, with its origin.
    pub accelerogram: Accelerogram,
    /// What the case gives and nothing uses, and parameters of spectra that no code has, in words.
    pub unused: Vec<String>,
}

impl Assembly {
    /// Warnings of the record, then those of the system, before a run.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        let ours = Warning::before(&self.system, &self.options);
        self.with_those_of_the_record(&ours)
    }

    /// What moves and pushes the buildings, line by line, for the user: the record, then all
    /// else.
    #[must_use]
    pub fn excitation(&self) -> Vec<String> {
        let record = self.accelerogram.echo().into_iter();
        record.chain(self.system.further_excitation()).collect()
    }

    /// Warnings of how the buildings were made, and of what was left over.
    #[must_use]
    pub fn warnings_of_buildings(&self) -> Vec<String> {
        let buildings = self.system.buildings().iter();
        let averaged = buildings.filter_map(|b| lateral::averaged(b));
        averaged.chain(self.unused.iter().cloned()).collect()
    }

    /// The warnings of the record before these.
    #[must_use]
    pub fn with_those_of_the_record(&self, ours: &[Warning]) -> Vec<String> {
        let record = self.accelerogram.origin().map(|o| o.warnings.as_slice());
        let record = record.unwrap_or_default().iter().cloned();
        record
            .chain(self.warnings_of_buildings())
            .chain(ours.iter().map(Warning::to_string))
            .collect()
    }
}

/// Reads the record and builds the system of a case.
///
/// # Errors
/// What the case says of models, methods or the record cannot be: with its place
/// in the case file, or in the record.
pub fn assemble(case: &Case) -> Result<Assembly, AssemblyError> {
    assemble_sharing(case, &RecordFiles::default())
}

/// As [`assemble`], for a case whose record along the row is another one than its author gave: that across it belongs to none
/// of them, and is not held against it.
///
/// # Errors
/// As [`assemble`].
pub fn assemble_under_another_record(case: &Case) -> Result<Assembly, AssemblyError> {
    of_record(case, &RecordFiles::default(), Whose::Another)
}

/// As [`assemble`], for one of many cases: the file of the record is read only if no case before
/// has read it.
///
/// # Errors
/// As [`assemble`].
pub fn assemble_sharing(case: &Case, files: &RecordFiles) -> Result<Assembly, AssemblyError> {
    of_record(case, files, Whose::OfCase)
}

fn of_record(case: &Case, files: &RecordFiles, whose: Whose) -> Result<Assembly, AssemblyError> {
    let _span = tracing::info_span!("assemble").entered();
    let parts = Parts::of(case)?;
    let accelerogram = accelerogram(case, files)?;
    let Parts {
        buildings,
        models,
        options,
    } = parts;
    let (system, out_of_step) = on_their_ground(case, buildings, (&accelerogram, whose))?;
    let system = with_gaps(case, &models, system)?;
    options.check(&system)?;
    Ok(Assembly {
        system,
        options,
        output_step: case.analysis.output_step,
        accelerogram,
        unused: unused(case, out_of_step),
    })
}

/// What a case gives and nothing uses, frames beside their building, columns, rows, contacts and parameters of spectra
/// as none are, in words: each once, with motions that are out of step.
fn unused(case: &Case, out_of_step: Vec<String>) -> Vec<String> {
    let mut told = column::never_hit(case);
    told.extend(column::unlikely(case));
    told.extend(unlikely::unlikely(case));
    told.extend(method::without_effect(case));
    told.extend(plan::frames_outside(case));
    told.extend(out_of_step);
    let own = case.buildings.iter().filter_map(|b| b.ground.as_ref());
    let own = own.filter_map(|ground| ground.value.motion.as_ref());
    for motion in std::iter::once(&case.ground_motion).chain(own) {
        for unusual in motion.unusual_parameters() {
            if !told.contains(&unusual) {
                told.push(unusual);
            }
        }
    }
    for question in &case.asked {
        if !told.contains(question) {
            told.push(question.clone());
        }
    }
    told
}

/// Puts the gaps of a case between buildings that have none, and lets them go from
/// where the case says.
fn with_gaps(
    case: &Case,
    models: &[Vec<Arc<dyn ImpactModel>>],
    mut system: System,
) -> Result<System, AssemblyError> {
    let hits = Hits::of(case)?;
    for (number, (gap, models)) in case.gaps.iter().zip(models).enumerate() {
        let floor = |side: Side, facing: Facing| match (side, facing) {
            (Side::Building(b), Facing::Floor(s)) => Floor::Storey(b, s),
            _ if gap.fixed_wall => Floor::FixedWall,
            _ => Floor::Wall,
        };
        let points = plan::points(case, gap)?;
        let (mut pairs, mut responses) = (Vec::new(), Vec::new());
        let first = system.levels().len();
        for (place, (l, model)) in gap.levels.iter().zip(models).enumerate() {
            let mut sides = [
                floor(gap.between[0], l.left),
                floor(gap.between[1], l.right),
            ];
            let mut model = Arc::clone(model);
            if let Some(hit) = hits.level(&mut system, (number, place), &model)? {
                sides[hit.side] = hit.point;
                model = hit.model;
                responses.extend(hit.responses.into_iter().map(|r| (first + place, r)));
            }
            let mut add = |[left, right]: [Floor; 2]| {
                pairs.push((left, right, l.width, Arc::clone(&model)));
            };
            match &points {
                None => add(sides),
                Some(points) => {
                    for y in points {
                        add(sides.map(|side| plan::point(case, &mut system, side, *y)));
                    }
                }
            }
        }
        let names = gap.between.map(|side| match side {
            Side::Building(b) => case.buildings[b].name.value.clone(),
            Side::Wall => WALL.to_owned(),
        });
        let first = system.levels().len();
        let added = system.add_gap_with_tolerance(&gap.name, names, pairs, gap.elevation_tolerance);
        added.map_err(|e| match e {
            TimeHistoryError::JumpsAtPoints { .. } => {
                let help = "give one point, such as `points = [0]`, or a model with a contact stiffness, such as anagnostopoulos_2004".to_owned();
                case.error(gap.model.span.clone(), e.to_string(), Some(help)).into()
            }
            TimeHistoryError::FrictionAtPoints { .. } => {
                let place = gap.points.as_ref().map_or(&gap.model.span, |p| &p.span);
                let help = "give two points, or a model without dry friction, such as jankowski_2005".to_owned();
                case.error(place.clone(), e.to_string(), Some(help)).into()
            }
            e => AssemblyError::from(e),
        })?;
        if let Some(seat) = &gap.seat {
            system.seat(seat.value)?;
        }
        for level in first..system.levels().len() {
            if system.ground_offset_at_end(level).is_some() {
                system.add_level_motion(level, LevelMotion::RelativeGroundDisplacement)?;
            }
        }
        for (level, response) in responses {
            system.add_level_response(level, response)?;
        }
        if !gap.floor_to_floor {
            refuse_unequal_floors(case, gap, &system)?;
        }
    }
    for link in &case.links {
        laws::add_link(case, link, &mut system)?;
    }
    Ok(released(case, system)?)
}

/// Refuses a gap, the last of the system, whose floors are not level where the case does
/// not say that this is meant.
fn refuse_unequal_floors(case: &Case, gap: &Gap, system: &System) -> Result<(), CaseError> {
    let unequal = system.gaps().last().map(|g| system.unequal_floors(g));
    let unequal = unequal.unwrap_or_default();
    let Some(first) = unequal.first() else {
        return Ok(());
    };
    let same = |l: &&pounding_case::ContactLevel| {
        [l.left, l.right].map(|side| side.floor().map(|s| s + 1)) == first.place.storeys
    };
    let place = gap.levels.iter().find(same);
    let place = place.map_or(gap.model.span.clone(), |l| l.place.clone());
    Err(case.error(
        place,
        format!(
            "{} differ in elevation by {} m, more than the tolerance of {} m{}",
            first.floors(),
            first.difference,
            gap.elevation_tolerance,
            more_pairs(unequal.len())
        ),
        Some("name floors at equal elevation, or correct the storey heights; `floor_to_floor = true` in this gap lets these floors act on each other as if they were level, a simplification that leaves out the columns which they hit".to_owned()),
    ))
}

/// Puts the buildings where the case lets them go.
fn released(case: &Case, system: System) -> Result<System, CaseError> {
    let all = |pick: fn(&Building) -> &[f64]| -> Vec<f64> {
        case.buildings.iter().flat_map(pick).copied().collect()
    };
    let displacement = all(|b| &b.initial_displacement.value);
    let velocity = all(|b| &b.initial_velocity);
    let moved = case.buildings.iter().find(|b| {
        let away = |x: &f64| *x != 0.0;
        b.initial_displacement.value.iter().any(away)
    });
    let place = moved.or(case.buildings.first());
    let span = place.map_or(0..0, |b| b.initial_displacement.span.clone());
    system
        .with_initial_state(&displacement, &velocity)
        .map_err(|e| {
            let help = "choose initial displacements that leave every gap open".to_owned();
            case.error(span, e.to_string(), Some(help))
        })
}
