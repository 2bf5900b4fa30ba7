//! Buildings on the ground motions that move them.

use std::sync::Arc;

use pounding_case::{BuildingGround, Case, Located, Side};
use pounding_catalogue::numbers::six_digits;
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::processing::{
    ProcessingStep, across_one_another, is_one_series, start_together, starts_later,
    starts_not_compared,
};
use pounding_shear_building::ShearBuilding;
use pounding_time_history::{GroundAcceleration, GroundMotion, LONGEST_DELAY, Support, System};

use super::excitation::further_record;
use super::forces::on_floors;
use super::initial_motion;
use crate::error::AssemblyError;

/// A record as the time history takes it.
pub(super) fn ground(accelerogram: &Accelerogram) -> GroundAcceleration {
    GroundAcceleration {
        samples: accelerogram.shared_samples(),
        time_step: accelerogram.time_step(),
    }
}

/// Sine of the degree by which two components may miss the right angle.
const OFF_RIGHT_ANGLE: f64 = 0.0175;

/// The components of a file that a motion is made of, by the words that choose them, with their parts of it.
fn parts(motion: &pounding_case::GroundMotion) -> Vec<(String, f64)> {
    let first = motion.component.as_deref().unwrap_or_default();
    let chosen = |name: &str| name.trim().to_lowercase();
    match &motion.rotation {
        None => vec![(chosen(first), 1.0)],
        Some(turned) => {
            let (sine, cosine) = libm::sincos(turned.angle.to_radians());
            let second = chosen(&turned.second_component.value);
            vec![(chosen(first), cosine), (second, sine)]
        }
    }
}

/// Refuses motions along and across the row from components of one file that `rotate` does not leave at right angles.
fn refuse_turns_apart(
    case: &Case,
    across: &Located<Box<pounding_case::GroundMotion>>,
    of_one_file: bool,
) -> Result<(), AssemblyError> {
    let along = &case.ground_motion;
    let (message, turned) = match (&along.rotation, &across.value.rotation) {
        _ if !of_one_file => return Ok(()),
        (None, None) => return Ok(()),
        (Some(turned), None) if turned.angle % 90.0 != 0.0 => (
            "`rotate` turns the component along the row, and that across it, of the same file, is not turned",
            turned,
        ),
        (None, Some(turned)) if turned.angle % 90.0 != 0.0 => (
            "`rotate` turns the component across the row, and that along it, of the same file, is not turned",
            turned,
        ),
        (Some(turned), _) | (None, Some(turned)) => (
            "`rotate` turns the components along and across the row, which are of the same file, by angles that do not go together",
            turned,
        ),
    };
    let (own, other) = (parts(along), parts(&across.value));
    let product = |(name, part): &(String, f64)| {
        let same = other.iter().find(|(other, _)| other == name);
        same.map_or(0.0, |(_, other)| part * other)
    };
    let product: f64 = own.iter().map(product).sum();
    let one_alone = along.rotation.is_none() || across.value.rotation.is_none();
    let is_turned = one_alone && turned.angle % 90.0 != 0.0;
    if !is_turned && product.abs() <= OFF_RIGHT_ANGLE {
        return Ok(());
    }
    let help = match &along.rotation {
        Some(turned) => format!(
            "turn both: across = {{ file = ..., component = \"{}\", second_component = \"{}\", rotate = {} }}",
            turned.second_component.value,
            along.component.as_deref().unwrap_or("..."),
            -turned.angle
        ),
        None => format!(
            "turn both: in [ground_motion] component = \"{}\", second_component = \"{}\", rotate = {}",
            turned.second_component.value,
            across.value.component.as_deref().unwrap_or("..."),
            -turned.angle
        ),
    };
    let message = format!("{message}: they are not at right angles");
    Err(case.error(across.span.clone(), message, Some(help)).into())
}

/// Refuses a record across the row that is not the other horizontal component of that along it.
fn refuse_no_pair(
    case: &Case,
    across: &Located<Box<pounding_case::GroundMotion>>,
    ([along, record], whose): ([&Accelerogram; 2], Whose),
) -> Result<(), AssemblyError> {
    let sha256 = |of: &Accelerogram| of.origin().map(|origin| origin.sha256.clone());
    let bytes = sha256(along);
    let of_one_file = across.value.file.value == case.ground_motion.file.value
        || bytes.is_some() && bytes == sha256(record);
    refuse_turns_apart(case, across, of_one_file)?;
    if whose == Whose::Another {
        return Ok(());
    }
    let mut pair = across_one_another(along, record);
    // Starts that steps of the case have moved are told of.
    let moved = start_moved(&case.ground_motion, along) - start_moved(&across.value, record);
    if moved.abs() <= SAME_TIME {
        pair = pair.and_then(|()| start_together(along, record));
    }
    pair.map_err(|e| {
        let error = case.error(across.span.clone(), e.to_string(), e.help());
        error.into()
    })
}

/// Whose the record along the row is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Whose {
    /// That which the case names, of which the records beside it are other components or places.
    OfCase,
    /// One that takes its place, mostly of another earthquake: who gives it says so.
    Another,
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
/// later, or of a record of its own, with the forces on its floors; and what is to be said of motions that do not begin
/// together.
pub(super) fn on_their_ground(
    case: &Case,
    buildings: Vec<Arc<ShearBuilding>>,
    (accelerogram, whose): (&Accelerogram, Whose),
) -> Result<(System, Vec<String>), AssemblyError> {
    let mut further = Further::default();
    let first = ground(accelerogram);
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
            let record = further_record(case, &given.value)?;
            refuse_no_pair(case, given, ([accelerogram, &record], whose))?;
            let made = (ground(&record), record.echo());
            further.across = Some(record);
            Some(made)
        }
    };
    let mut supports = Vec::new();
    for (number, building) in case.buildings.iter().enumerate() {
        let mut along = 0;
        if let Some(given) = &building.ground {
            let (delay, own) = (given.value.delay, &given.value.motion);
            if delay > LONGEST_DELAY {
                let message = format!(
                    "the ground under \"{}\" moves {} s later than the record, and at most {LONGEST_DELAY} s are taken",
                    building.name.value,
                    six_digits(delay)
                );
                let help = "give the delay in s, or distance and wave speed with their units";
                let error = case.error(given.span.clone(), message, Some(help.to_owned()));
                return Err(error.into());
            }
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
                            let made = (ground(&record), record.echo());
                            further.own.push((number, record));
                            made
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
    let mut told = out_of_step(case, (accelerogram, whose), &further);
    told.extend(initial_motion::left_out(case, accelerogram, &further.own));
    Ok((on_floors(case, system)?, told))
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

/// By how much (s) the steps of a record moved its start: zeros put before it, less what was cut off there.
fn start_moved(motion: &pounding_case::GroundMotion, record: &Accelerogram) -> f64 {
    let of = |name: &str, number: &str| -> f64 {
        let steps = record.steps().iter().filter(|step| step.step == name);
        let numbers = steps.filter_map(|step| step.get(number));
        numbers.fold(0.0, |sum, number| sum + number)
    };
    let filters = motion.process.iter().map(|step| match &step.value {
        ProcessingStep::Filter(filter) => filter.zeros_at_each_end(),
        _ => 0.0,
    });
    // The sum of no numbers would be printed with a minus.
    filters.fold(0.0, |sum, zeros| sum + zeros) + of("pad", "before") - of("trim", "start")
}

/// Whether steps of a record other than filters move its start.
fn is_cut_or_padded(record: &Accelerogram) -> bool {
    let moves = |name: &str| ["pad", "trim"].contains(&name);
    record.steps().iter().any(|step| moves(&step.step))
}

/// A building on a record of its own, as its motion is moved in time.
struct OnItsOwn<'c> {
    name: &'c str,
    ground: &'c BuildingGround,
    /// Delays (s) of the buildings that the record of the case moves: of those beside this one where there are such, else
    /// of all.
    of_case: &'c [f64],
}

/// What is to be said of a motion that does not begin with that of the case, as both were recorded and processed.
/// A record across the row has no building of its own, and no delay.
fn begins_apart(
    what: &str,
    ([own, other], whose): ([(&pounding_case::GroundMotion, &Accelerogram); 2], Whose),
    under: Option<&OnItsOwn<'_>>,
) -> Option<String> {
    let known = match whose {
        Whose::OfCase => starts_later(own.1, other.1),
        Whose::Another => None,
    };
    // Whoever cuts both to the time that they have in common knows where they begin: a delay is then that of a wave.
    if known == Some(0.0) {
        return None;
    }
    let moved = [own, other].map(|(motion, record)| start_moved(motion, record));
    let apart = moved[1] - moved[0];
    let delay = under.map_or(0.0, |under| under.ground.delay);
    // Of other days nothing is known, and the time of a wave makes up for nothing.
    let by_wave = under.is_some_and(|under| under.ground.by_wave_speed && delay != 0.0);
    let known = known.filter(|later| later.is_finite() && !by_wave);
    let left = match known {
        Some(later) => Some(Remainder::of(later, under)?),
        None if apart.abs() <= SAME_TIME || (apart + delay).abs() <= SAME_TIME => return None,
        None => None,
    };
    let seconds = left.as_ref().map_or(String::new(), Remainder::seconds);
    let remedy = left.as_ref().and_then(|left| left.delay(under));
    let or_delay = remedy.map_or(String::new(), |remedy| format!(", or {remedy}"));
    // What is apart by steps of the case alone is put right there.
    if let Some(left) = &left
        && (apart.abs() <= SAME_TIME || (left.later + apart).abs() > SAME_TIME)
    {
        let processed = match apart.abs() <= SAME_TIME {
            true => "",
            false => ", with what `process` moved,",
        };
        return Some(format!(
            "the record of the case and {what} do not begin together: the times of their first samples{processed} are {:.3} s apart{seconds}; cut both to the time that they have in common by `trim`, beside which a delay is that of a wave{or_delay}",
            left.later.abs()
        ));
    }
    Some(match is_cut_or_padded(own.1) || is_cut_or_padded(other.1) {
        false => format!(
            "filters put {:.2} s of zeros before the record of the case, and {:.2} s before {what}: they do not begin together{seconds}; in the filters `keep_pads = false` leaves the zeros out{or_delay}",
            moved[0], moved[1]
        ),
        true => format!(
            "`process` moves the start of the record of the case by {:.2} s, and {what} by {:.2} s (less than zero: earlier): they do not begin together{seconds}; give both the same `pad`, `trim` and zeros of filters{or_delay}",
            0.0 - moved[0],
            0.0 - moved[1]
        ),
    })
}

/// What delays leave of the seconds between first samples.
struct Remainder {
    /// Seconds by which the first sample of a record is later than that of the record of the case.
    later: f64,
    /// Delay of the record of the case, under the building that comes nearest.
    beside: f64,
    /// Seconds that are left, below zero where the motion comes too late; `None` where nothing is delayed.
    left: Option<f64>,
}

impl Remainder {
    /// `None` where delays make up for them.
    fn of(later: f64, under: Option<&OnItsOwn<'_>>) -> Option<Self> {
        let (delay, of_case) = under.map_or((0.0, &[][..]), |u| (u.ground.delay, u.of_case));
        if delay == 0.0 && of_case.iter().all(|beside| *beside == 0.0) {
            return Some(Self {
                later,
                beside: 0.0,
                left: None,
            });
        }
        let left = |beside: f64| later + beside - delay;
        let beside = of_case.iter().copied();
        let nearest = beside.min_by(|a, b| left(*a).abs().total_cmp(&left(*b).abs()));
        let nearest = nearest.unwrap_or(0.0);
        // A delay of the record of the case may be that of a wave, and records that begin together for people may have any.
        let made_up = [later, left(nearest), left(0.0)];
        let made_up = made_up.iter().any(|left| left.abs() <= SAME_TIME);
        (!made_up).then_some(Self {
            later,
            beside: nearest,
            left: Some(left(nearest)),
        })
    }

    fn seconds(&self) -> String {
        let Some(left) = self.left else {
            return String::new();
        };
        let how = if left > 0.0 { "early" } else { "late" };
        format!(
            ", and with the delays that are given the second one comes {} s too {how}",
            six_digits(left.abs())
        )
    }

    /// The delay that makes up for what is left.
    fn delay(&self, under: Option<&OnItsOwn<'_>>) -> Option<String> {
        let under = under?;
        let name = under.name;
        let wanted = self.later + self.beside;
        if wanted > ROUND_OFF {
            return Some(format!(
                "give `delay = \"{} s\"` in `ground` of {name}",
                six_digits(wanted)
            ));
        }
        if wanted >= -ROUND_OFF {
            return Some(format!("leave `delay` of {name} out"));
        }
        // A motion cannot come sooner: the others come later.
        let of_others = under.ground.delay - self.later;
        (!under.of_case.is_empty()).then(|| {
            format!(
                "give `ground = {{ delay = \"{} s\" }}` to the buildings that the record of the case moves",
                six_digits(of_others)
            )
        })
    }
}

/// Seconds that are round-off of times.
const ROUND_OFF: f64 = 1.0e-6;

/// Delays (s) of the buildings that the record of the case moves: of those that a gap parts from this one, else of all.
fn delays_of_case(case: &Case, building: usize) -> Vec<f64> {
    let beside = |other: usize| {
        let pair = [building, other].map(Side::Building);
        let mut gaps = case.gaps.iter();
        gaps.any(|gap| pair.iter().all(|side| gap.between.contains(side)))
    };
    let delays = case.buildings.iter().enumerate().filter_map(|(i, b)| {
        let delay = match &b.ground {
            None => 0.0,
            Some(ground) if ground.value.motion.is_none() => ground.value.delay,
            Some(_) => return None,
        };
        Some((beside(i), delay))
    });
    let all: Vec<(bool, f64)> = delays.collect();
    let any_beside = all.iter().any(|(beside, _)| *beside);
    let chosen = all.iter().filter(|(beside, _)| *beside || !any_beside);
    chosen.map(|(_, delay)| *delay).collect()
}

/// The record across the row beside that of the case, in words.
const ACROSS: &str = "that across the row";

/// What is to be said of a motion whose stated start cannot be compared with that of the case.
fn not_compared(
    what: &str,
    (along, record): (&Accelerogram, &Accelerogram),
    whose: Whose,
) -> Option<String> {
    let said = starts_not_compared(along, record).filter(|_| whose == Whose::OfCase)?;
    Some(format!("the record of the case and {what}: {said}"))
}

/// Motions and forces that are not in step with one another, as they were recorded or since they were processed, in
/// words.
fn out_of_step(
    case: &Case,
    (along, whose): (&Accelerogram, Whose),
    further: &Further,
) -> Vec<String> {
    let mut told = Vec::new();
    let own = (&case.ground_motion, along);
    for (index, record) in &further.own {
        let building = &case.buildings[*index];
        let of_case = delays_of_case(case, *index);
        if let Some(ground) = &building.ground
            && let Some(motion) = &ground.value.motion
        {
            let name = &building.name.value;
            let pair = [own, (motion, record)];
            let under = OnItsOwn {
                name,
                ground: &ground.value,
                of_case: &of_case,
            };
            let what = format!("that of {name}");
            told.extend(begins_apart(&what, (pair, whose), Some(&under)));
            told.extend(not_compared(&what, (along, record), whose));
        }
    }
    if let (Some(across), Some(record)) = (&case.ground_motion.across, &further.across) {
        let pair = [own, (&*across.value, record)];
        told.extend(begins_apart(ACROSS, (pair, whose), None));
        told.extend(not_compared(ACROSS, (along, record), whose));
        if whose == Whose::OfCase && is_one_series(along, record) {
            told.push(
                "the record along the row and that across it are one series of one file: the ground moves along one line between both directions; the other horizontal component of the record is chosen by `component` if it is in the same file"
                    .to_owned(),
            );
        }
    }
    let zeros = zeros_before(&case.ground_motion);
    if zeros > SAME_TIME && case.buildings.iter().any(|b| !b.forces.is_empty()) {
        told.push(format!(
            "filters put {zeros:.2} s of zeros before the record, and forces on floors begin with them: in the filters `keep_pads = false` leaves the zeros out, or let forces begin later"
        ));
    }
    told
}

/// Records beside that of the case, as they were read and processed.
#[derive(Default)]
struct Further {
    across: Option<Accelerogram>,
    /// Those of buildings, from zero.
    own: Vec<(usize, Accelerogram)>,
}
