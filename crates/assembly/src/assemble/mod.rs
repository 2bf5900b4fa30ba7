//! Buildings, models, gaps, links and options of a case, put together.

mod again;
mod column;
mod forces;
mod foundation;
mod initial_motion;
mod lateral;
mod laws;
mod method;
mod motions;
mod plan;
mod unlikely;

pub use again::{assemble_with_record, assemble_without_gaps, regap};
pub use laws::{parameters_of_link, parameters_of_storeys};
pub(crate) use method::method_names;
pub use method::methods_that_take;
pub use motions::nothing_to_move_across;

use std::sync::Arc;

use pounding_case::{Building, Case, CaseError, Errors, Facing, Gap, Located, Parameter, Side};
use pounding_catalogue::STANDARD_GRAVITY;
use pounding_gap_element::{
    GapElementError, ImpactModel, ModelDescriptor, ModelParameters, SeparationRule, registry,
};
use pounding_ground_motion::Accelerogram;
use pounding_shear_building::{ContactLine, ShearBuilding, ShearBuildingError, WALL};
use pounding_time_history::{
    Floor, LevelMotion, RunOptions, System, TimeHistoryError, Warning, more_pairs,
};

use self::column::Hits;
use crate::dimension::parameter_value;
use crate::error::AssemblyError;
use crate::excitation::{RecordFiles, accelerogram};
use crate::used_parameters::UsedParameters;
use method::options;
use motions::{Whose, on_their_ground};

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

/// The impact model of every contact level of every gap.
type Models = Vec<Vec<Arc<dyn ImpactModel>>>;

/// What a case says of buildings, models and options.
struct Parts {
    buildings: Vec<Arc<ShearBuilding>>,
    models: Models,
    options: RunOptions,
}

/// Refuses gaps and links of buildings that the case does not have, as programs that take buildings out of it may
/// leave them.
fn names_its_buildings(case: &Case) -> Result<(), CaseError> {
    let of_gaps = case.gaps.iter().map(|gap| ("gap", &gap.name, gap.between));
    let of_links = case
        .links
        .iter()
        .map(|link| ("link", &link.name, link.between));
    let lost = of_gaps.chain(of_links).find(|(_, _, between)| {
        let known = |side: &Side| match side {
            Side::Building(b) => *b < case.buildings.len(),
            Side::Wall => true,
        };
        !between.iter().all(known)
    });
    match lost {
        None => Ok(()),
        Some((what, name, _)) => Err(case.error(
            0..0,
            format!("{what} {name} joins a building that the case does not have"),
            Some(format!("take the {what} out with its building")),
        )),
    }
}

impl Parts {
    /// Makes all of it, and reports all that is wrong in it.
    fn of(case: &Case) -> Result<Self, CaseError> {
        Self::with_columns(case, case)
    }

    /// The same with columns that the gaps of another case, with the same buildings, let
    /// floors hit.
    fn with_columns(case: &Case, gaps: &Case) -> Result<Self, CaseError> {
        names_its_buildings(case)?;
        let errors = Errors::default();
        let hits = errors.keep(Hits::of(gaps));
        let points = |b: usize| {
            hits.as_ref()
                .map_or_else(Vec::new, |hits| hits.with_mass(b))
        };
        let buildings = case.buildings.iter().enumerate();
        let buildings =
            errors.all(buildings.map(|(i, b)| building(case, b, &points(i)).map(Arc::new)));
        let models = errors.all(case.gaps.iter().map(|gap| models_of(case, gap)));
        if let (Ok(models), Some(hits), false) = (&models, &hits, case.gaps.is_empty()) {
            errors.or_default(hits.check_models(models));
        }
        let options = errors.all([options(case)]);
        errors.or_default(errors.all(case.links.iter().map(|l| laws::check_link(case, l))));
        errors.or_default(errors.all(columns_of_rigid_floors(case).into_iter().map(Err::<(), _>)));
        let parts = buildings.and_then(|buildings| {
            Ok(Self {
                buildings,
                models: models?,
                options: options?.remove(0),
            })
        });
        errors.finish(parts)
    }
}

/// The fundamental period (s) along the row of each building of a case, as it is before anything yields.
pub(crate) fn fundamental_periods(case: &Case) -> Result<Vec<f64>, CaseError> {
    let buildings = Parts::of(case)?.buildings;
    let period = |b: &Arc<ShearBuilding>| b.modes().period[b.fundamental_mode()];
    Ok(buildings.iter().map(period).collect())
}

/// Columns that are hit beside floors that turn, or in buildings on isolators.
fn columns_of_rigid_floors(case: &Case) -> Vec<CaseError> {
    let mut found = Vec::new();
    for gap in &case.gaps {
        let Some(place) = gap.columns.iter().flatten().next() else {
            continue;
        };
        for (side, own) in gap.between.iter().zip(&gap.columns) {
            let Side::Building(b) = side else {
                continue;
            };
            let building = &case.buildings[*b];
            let what = match (&building.plan, &building.isolator, own) {
                (Some(_), ..) => "plan",
                (_, Some(_), Some(_)) => "isolator",
                _ => continue,
            };
            let message = format!(
                "columns cannot be hit in gap {}: building \"{}\" has `{what}`",
                gap.name, building.name.value
            );
            let help = format!("remove `column`, or `{what}` of the building");
            found.push(case.error(place.span.clone(), message, Some(help)));
        }
    }
    found
}

/// The impact models of all gaps.
fn models(case: &Case) -> Result<Models, CaseError> {
    case.gaps.iter().map(|gap| models_of(case, gap)).collect()
}

/// The impact model of each contact level of a gap. Levels with the parameters of the first share its
/// model; there is one for a gap whose levels are not known.
fn models_of(case: &Case, gap: &Gap) -> Result<Vec<Arc<dyn ImpactModel>>, CaseError> {
    let first = model(case, gap, 0)?;
    let is_first = |place: usize| {
        let value = |p: &Parameter, place| p.at(place).map(|given| given.value.value);
        let mut parameters = gap.parameters.iter();
        parameters.all(|p| value(p, place) == value(p, 0))
    };
    let errors = Errors::default();
    let further = errors.all((1..gap.levels.len()).map(|place| match is_first(place) {
        true => Ok(Arc::clone(&first)),
        false => model(case, gap, place),
    }));
    let further = errors.finish(further)?;
    Ok(std::iter::once(first).chain(further).collect())
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

fn building(case: &Case, b: &Building, points: &[ContactLine]) -> Result<ShearBuilding, CaseError> {
    let gravity = if b.p_delta { STANDARD_GRAVITY } else { 0.0 };
    let (name, mass, height) = (b.name.value.clone(), b.mass.clone(), b.height.clone());
    if let Some(given) = &b.plan {
        return plan::building(case, b, given);
    }
    let damping = b.damping.value.clone();
    let made = match (&b.lateral, &b.isolator) {
        (None, Some(isolator)) => {
            ShearBuilding::on_isolators(name, mass, &b.stiffness, height, damping, isolator.value)
        }
        (None, None) => {
            let stiffness = b.stiffness.clone();
            ShearBuilding::under_gravity(name, mass, stiffness, height, damping, gravity)
        }
        (Some(lateral), _) => {
            let stiffness = lateral::stiffness(case, b, lateral)?;
            ShearBuilding::with_stiffness_matrix(name, mass, stiffness, height, damping, gravity)
        }
    };
    let building = made.map_err(|e| {
        let at_matrix = b.lateral.as_ref().map_or(&b.name.span, |l| &l.span);
        let at_isolator = b.isolator.as_ref().map_or(&b.name.span, |i| &i.span);
        let (place, help) = match &e {
            ShearBuildingError::Unstable { .. } => (&b.name.span, Some(OVERTURNED.to_owned())),
            ShearBuildingError::UnstableMatrix { .. } => (at_matrix, Some(OVERTURNED.to_owned())),
            ShearBuildingError::Length { .. } => (at_matrix, e.help()),
            ShearBuildingError::TooManyStoreys { .. } => (&b.name.span, e.help()),
            ShearBuildingError::Value { quantity, .. } => {
                let place = b.span_of(quantity);
                return case.error(place, e.to_string(), Some(WITH_UNIT.to_owned()));
            }
            ShearBuildingError::Damping { .. } if b.lateral.is_some() => (
                &b.damping.span,
                Some("give ratios, such as { modal = 0.05 }".to_owned()),
            ),
            ShearBuildingError::Isolator { .. } => (at_isolator, e.help()),
            _ => (&b.damping.span, e.help()),
        };
        case.error(place.clone(), e.to_string(), help)
    })?;
    let building = laws::with_storey_laws(case, b, building)?;
    if points.is_empty() {
        return foundation::on_foundation(case, b, building);
    }
    let made = building.with_contact_points(points);
    made.map_err(|e| case.error(b.name.span.clone(), e.to_string(), None))
}

/// What to do about a mass, a stiffness or a height that cannot be.
const WITH_UNIT: &str =
    "correct the value, with its unit, such as \"25 t\" of a mass; plain numbers are SI";

/// What to do about a building that gravity overturns.
const OVERTURNED: &str =
    "correct stiffness, masses and heights, with their units; `p_delta = false` leaves gravity out";

/// The parameters of the impact model of a contact level of a gap, from zero.
///
/// # Errors
/// As of a case that cannot be assembled.
pub fn parameters_of_gap(
    case: &Case,
    gap: &Gap,
    level: usize,
) -> Result<UsedParameters, CaseError> {
    let descriptor = registry::find(&gap.model.value).map_err(at_model(case, gap))?;
    let values = values_of_model(case, gap, descriptor, level)?;
    Ok(UsedParameters::of(descriptor, values, false))
}

fn at_model<'c>(case: &'c Case, gap: &'c Gap) -> impl Fn(GapElementError) -> CaseError + use<'c> {
    move |e| case.error(gap.model.span.clone(), e.to_string(), e.help())
}

/// The values (SI) that are given for the model of a contact level, from zero.
fn values_of_model(
    case: &Case,
    gap: &Gap,
    descriptor: &'static ModelDescriptor,
    level: usize,
) -> Result<Vec<(String, f64)>, CaseError> {
    let exponent = gap
        .parameters
        .iter()
        .find(|p| p.key.value == "exponent")
        .and_then(|p| Some(p.at(level)?.value.value));
    let errors = Errors::default();
    let given = gap.parameters.iter();
    let given = given.filter_map(|p| Some((&p.key, p.at(level)?)));
    let read = errors.all(given.map(|given| {
        let value = parameter_value(case, descriptor, given, exponent, |e| {
            GapElementError::from(e).help()
        })?;
        Ok((given.0.value.clone(), value))
    }));
    errors.finish(read)
}

/// The impact model of a contact level, from zero.
fn model(case: &Case, gap: &Gap, level: usize) -> Result<Arc<dyn ImpactModel>, CaseError> {
    let at_model = at_model(case, gap);
    let descriptor = registry::find(&gap.model.value).map_err(&at_model)?;
    let mut parameters = ModelParameters::default();
    let errors = Errors::default();
    let read = values_of_model(case, gap, descriptor, level);
    if let Some(separation) = &gap.separation {
        parameters.separation = errors.keep(separation_rule(case, descriptor, separation));
    }
    parameters.spring = gap.spring.as_ref().map(|table| table.value.clone());
    // TOML keys are unique.
    parameters.values = errors.finish(read)?.into_iter().collect();
    // What is wrong with a table is said where it stands.
    let wrong = |e: GapElementError| match (&e, &gap.spring) {
        (GapElementError::SpringTable(_), Some(table)) => {
            case.error(table.span.clone(), e.to_string(), e.help())
        }
        _ => at_model(e),
    };
    Ok(registry::build(descriptor.name, &parameters)
        .map_err(wrong)?
        .into())
}

fn separation_rule(
    case: &Case,
    descriptor: &'static ModelDescriptor,
    separation: &Located<String>,
) -> Result<SeparationRule, CaseError> {
    SeparationRule::from_name(&separation.value)
        .filter(|rule| descriptor.separation_rules.contains(rule))
        .ok_or_else(|| {
            let offered: Vec<_> = descriptor
                .separation_rules
                .iter()
                .map(|r| r.name())
                .collect();
            case.error(
                separation.span.clone(),
                format!(
                    "model {} does not offer separation \"{}\"",
                    descriptor.name, separation.value
                ),
                Some(format!("it offers {}", offered.join(", "))),
            )
        })
}
