//! Two horizontal components.

use std::borrow::Cow;

use crate::accelerogram::Accelerogram;
use crate::direction::{Direction, Orientation};
use crate::error::{GroundMotionError, bound, within};
use crate::start_times;
use crate::step_record::StepRecord;

const STEP: &str = "rotation";
const OF_FAULT: &str = "fault components";
/// Sine of the least angle between two components that determine the motion well.
const LEAST_SINE: f64 = 0.5;
/// Degrees by which two components may miss the right angle: agencies print whole degrees.
const OFF_RIGHT_ANGLE: f64 = 1.0;
/// Part of the larger peak that a component may reach where the other one has ended: ends of
/// records, cut where instruments stop on their own, are below it.
const STILL_MOVES: f64 = 0.05;

/// What to do about components that do not start together.
const CUT_BOTH: &str = "cut both to the time that they have in common, `pounding motion process FILE --trim \"start=3 s, end=60 s\" -o FILE.csv`, where times count from the first sample of each file, and use these files";
/// The same where the times may count from anything.
const CUT_OR_COUNT_ANEW: &str = "cut both to the time that they have in common, `pounding motion process FILE --trim \"start=3 s, end=60 s\" -o FILE.csv`, where times count from the first sample of each file, and use these files; if they do start together and their times alone count otherwise, write both anew from zero, `pounding motion convert FILE -o FILE.csv`";

/// Two components in other directions.
#[derive(Debug, Clone, PartialEq)]
pub struct RotatedPair {
    /// Along the direction asked for.
    pub first: Accelerogram,
    /// A quarter turn further.
    pub second: Accelerogram,
    /// What was done.
    pub step: StepRecord,
}

/// Two components sample by sample, which start together and end together.
pub(crate) struct Together<'a> {
    /// Samples (m/s2), as many of the first as of the second.
    pub samples: [Cow<'a, [f64]>; 2],
    /// What is to be said where one of them had ended before the other, or where their starts cannot be compared.
    pub warnings: Vec<String>,
}

/// The samples of both components, which must start together. The ground is taken to stand still
/// after the end of the shorter one: that one is continued with zeros, so that nothing of the
/// longer one is lost.
///
/// # Errors
/// Different time steps or starts, or a longer component that still moves strongly where the other
/// has ended: what the other did there is not known.
pub(crate) fn together<'a>(
    first: &'a Accelerogram,
    second: &'a Accelerogram,
) -> Result<Together<'a>, GroundMotionError> {
    let (a, b) = (first.time_step(), second.time_step());
    let count = first.samples().len().max(second.samples().len());
    // Over the whole length they must not part by a hundredth of a step.
    if !((a - b).abs() * count as f64 <= 0.01 * a) {
        return Err(GroundMotionError::Mismatch(format!(
            "their time steps are {a} s and {b} s"
        )));
    }
    starts_together(first, second)?;
    let samples = [first, second].map(|of| {
        let mut samples = Cow::Borrowed(of.samples());
        if samples.len() < count {
            samples.to_mut().resize(count, 0.0);
        }
        samples
    });
    Ok(Together {
        samples,
        warnings: starts_not_compared(first, second)
            .into_iter()
            .chain(ends_together(first, second)?)
            .collect(),
    })
}

/// What is to be said where one component ends before the other.
fn ends_together(
    first: &Accelerogram,
    second: &Accelerogram,
) -> Result<Option<String>, GroundMotionError> {
    let least = first.samples().len().min(second.samples().len());
    let behind = [first, second].map(|of| &of.samples()[least..]).concat();
    if behind.is_empty() {
        return Ok(None);
    }
    let reached = behind.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let peak = first.peak().value.max(second.peak().value);
    let of = |of: &Accelerogram| {
        let name = of.origin().map_or("", |o| o.component.as_str());
        let name = if name.is_empty() {
            String::new()
        } else {
            format!(" (\"{name}\")")
        };
        (name, of.samples().len(), bound(of.duration()))
    };
    let ((first, n, long), (second, m, wide)) = (of(first), of(second));
    let lengths = format!(
        "the first component{first} has {n} samples in {long} s, the second{second} {m} samples in {wide} s"
    );
    let still = format!(
        "{} m/s2, {:.1} % of the larger peak",
        bound(reached),
        100.0 * reached / peak.max(f64::MIN_POSITIVE)
    );
    if reached > STILL_MOVES * peak {
        return Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!(
                "{lengths}: behind the end of the shorter one the other still reaches {still}, and what the shorter one did there is not known"
            ),
            remedy: "get the shorter one whole; or, if the motion behind its end is not wanted, cut the longer one to its length, `pounding motion process FILE --trim \"start=0 s, end=30 s\" -o FILE.csv`, and use that file",
        });
    }
    Ok(Some(format!(
        "{lengths}: the shorter one is continued with zeros, where the other reaches {still}"
    )))
}

/// What is known of the times of the first samples of two components.
struct Starts {
    /// Seconds from the first to the second, below zero where the second is earlier; days are infinite.
    later: f64,
    /// The times as they are printed, and what to do about those of two times.
    shown: [String; 2],
    remedy: &'static str,
}

impl Starts {
    /// By the printed dates and times, else by the columns of times.
    fn of(first: &Accelerogram, second: &Accelerogram) -> Option<Self> {
        let (a, b) = (first.origin()?, second.origin()?);
        if let Some(later) = start_times::from_to(&a.start_time, &b.start_time) {
            return Some(Self {
                later,
                shown: [a.start_time.clone(), b.start_time.clone()],
                remedy: CUT_BOTH,
            });
        }
        let (a, b) = (a.first_time?, b.first_time?);
        let shown = |time: f64| format!("{} s of their times", bound(time));
        Some(Self {
            later: b - a,
            shown: [shown(a), shown(b)],
            remedy: CUT_OR_COUNT_ANEW,
        })
    }
}

/// How far apart the first samples of two records are (s), where their dates and times or columns of times say it;
/// records of different days are infinitely far apart. Half a time step is nothing.
#[must_use]
pub fn starts_apart(first: &Accelerogram, second: &Accelerogram) -> Option<f64> {
    starts_later(first, second).map(f64::abs)
}

/// By how much (s) the first sample of the second record is later than that of the first, below zero where it is
/// earlier; otherwise as [`starts_apart`].
#[must_use]
pub fn starts_later(first: &Accelerogram, second: &Accelerogram) -> Option<f64> {
    // A millionth: half a step is none, whatever the round-off of the times.
    let most = 0.5 * first.time_step() * (1.0 + 1.0e-6);
    let later = Starts::of(first, second)?.later;
    Some(if later.abs() > most { later } else { 0.0 })
}

/// What is to be said where both records state the time of their first sample, and the two cannot be compared.
#[must_use]
pub fn starts_not_compared(first: &Accelerogram, second: &Accelerogram) -> Option<String> {
    let (a, b) = (first.origin()?, second.origin()?);
    let [a, b] = [&a.start_time, &b.start_time].map(|text| text.trim());
    let is_known = a == b || a.is_empty() || b.is_empty();
    let differ = !is_known && start_times::from_to(a, b).is_none();
    differ.then(|| {
        let [a, b] = [a, b].map(|text| text.chars().take(48).collect::<String>());
        format!(
            "the times of the first samples, \"{a}\" and \"{b}\", cannot be compared with one another, and do not tell whether both start together: correct the one that is not written like `2011/03/11 14:46:15 UTC`, in our CSV `# Start: ...`"
        )
    })
}

/// Refuses components with first samples at different times, as those of instruments
/// that trigger on their own do.
fn starts_together(first: &Accelerogram, second: &Accelerogram) -> Result<(), GroundMotionError> {
    let Some(apart) = starts_apart(first, second).filter(|apart| *apart > 0.0) else {
        return Ok(());
    };
    let Some(Starts { shown, remedy, .. }) = Starts::of(first, second) else {
        return Ok(());
    };
    let [a, b] = shown;
    let apart = match apart.is_finite() {
        true => format!(", {} s apart", bound(apart)),
        false => String::new(),
    };
    Err(GroundMotionError::NotPossible {
        step: STEP,
        reason: format!(
            "the components do not start together: their first samples are at {a} and {b}{apart}"
        ),
        remedy,
    })
}

/// Refuses a record across a row of buildings that cannot be the other component of that along it: a vertical one, and of the
/// same file one that is not at right angles; the same series as that along it is [known by itself](is_one_series). Whether both
/// [start together](start_together) is asked by itself too.
///
/// # Errors
/// One of these.
pub fn across_one_another(
    along: &Accelerogram,
    across: &Accelerogram,
) -> Result<(), GroundMotionError> {
    let of_one_file = of_one_file(along, across) && !is_one_series(along, across);
    if of_one_file || is_vertical(along) || is_vertical(across) {
        at_right_angles(along, across).map_err(of_across)?;
    }
    Ok(())
}

/// A record under which buildings of a row move along it: with a warning where it is a vertical component.
#[must_use]
pub fn along_a_row(record: Accelerogram) -> Accelerogram {
    let component = record.origin().map(|origin| origin.component.as_str());
    let said = is_vertical(&record).then(|| {
        format!(
            "component \"{}\" is vertical, and the buildings are shaken by it along their row: was a horizontal one meant?",
            component.unwrap_or_default()
        )
    });
    record.warned(said.as_deref())
}

/// Whether a component is known to point up or down.
fn is_vertical(of: &Accelerogram) -> bool {
    matches!(direction(of), Some(Direction::Up | Direction::Down))
}

/// Whether two records are the same component of one file, or of a copy of it, as the one record that there is may stand for
/// both directions; neither is turned.
#[must_use]
pub fn is_one_series(along: &Accelerogram, across: &Accelerogram) -> bool {
    let component = |of: &Accelerogram| of.origin().map(|origin| origin.component.clone());
    let [a, b] = [component(along), component(across)].map(Option::unwrap_or_default);
    let same = a == b && (!a.is_empty() || along.samples() == across.samples());
    same && of_one_file(along, across) && !is_turned(along) && !is_turned(across)
}

fn of_one_file(along: &Accelerogram, across: &Accelerogram) -> bool {
    let bytes = |of: &Accelerogram| of.origin().map(|origin| origin.sha256.clone());
    let both = bytes(along).zip(bytes(across));
    both.is_some_and(|(a, b)| a == b)
}

/// Refuses a record across a row of buildings that starts at another time than that along it.
///
/// # Errors
/// Starts that both records state, or their columns of times, and that are apart.
pub fn start_together(
    along: &Accelerogram,
    across: &Accelerogram,
) -> Result<(), GroundMotionError> {
    starts_together(along, across).map_err(of_across)
}

/// What is said of a record across the row.
const ACROSS: &str = "across";

fn of_across(error: GroundMotionError) -> GroundMotionError {
    match error {
        GroundMotionError::NotPossible { reason, remedy, .. } => GroundMotionError::NotPossible {
            step: ACROSS,
            reason,
            remedy,
        },
        other => other,
    }
}

/// Refuses a component beside itself, which has no second direction. Two files with the same
/// samples are two components where their names say two directions.
///
/// # Errors
/// The same samples in both.
pub fn distinct(first: &Accelerogram, second: &Accelerogram) -> Result<(), GroundMotionError> {
    let sha = |of: &Accelerogram| of.origin().map(|o| o.sha256.clone());
    let in_two_directions = || match (direction(first), direction(second)) {
        (Some(a), Some(b)) => !a.is(b),
        _ => false,
    };
    let of_two_files = sha(first) != sha(second);
    if first.samples() != second.samples() || (of_two_files && in_two_directions()) {
        return Ok(());
    }
    let name = first.origin().map_or("", |o| o.component.as_str());
    Err(GroundMotionError::NotPossible {
        step: STEP,
        reason: format!("both components are the same series, \"{name}\""),
        remedy: "name two components of the record, `component` and `second_component`, or give the file of the other one",
    })
}

/// Whether a component was turned, now or before it was written.
fn is_turned(of: &Accelerogram) -> bool {
    let turns = |step: &str| step == STEP || step == OF_FAULT;
    let before = |line: &String| {
        let step = line.strip_prefix("Step:").map(str::trim_start);
        step.is_some_and(|s| turns(s.split(':').next().unwrap_or(s)))
    };
    let history = of.origin().is_some_and(|o| o.history.iter().any(before));
    of.steps().iter().any(|s| turns(&s.step)) || history
}

/// The direction of a component, where its name says one and it was not turned since.
fn direction(of: &Accelerogram) -> Option<Direction> {
    let origin = of.origin()?;
    // What turns a component states the new direction where it is known.
    let stated = origin.orientation.map(Orientation::direction);
    let named = || Direction::of_name(&origin.component).filter(|_| !is_turned(of));
    stated.or_else(named)
}

/// Where a turned component points, and its name.
struct Turned {
    name: String,
    orientation: Option<Orientation>,
}

impl Turned {
    /// Of an azimuth (degrees).
    fn to(azimuth: f64) -> Self {
        let azimuth = (libm::round(azimuth * 1.0e6) / 1.0e6).rem_euclid(360.0);
        Self {
            name: format!("{azimuth} deg"),
            orientation: Orientation::of(azimuth, 0.0),
        }
    }

    /// Of both components turned by an angle (degrees), the first towards the second: by their azimuths, where both are
    /// known; else by a name that says none.
    fn by(angle: f64, first: &Accelerogram, second: &Accelerogram) -> [Self; 2] {
        let name = |of: &Accelerogram| of.origin().map_or(String::new(), |o| o.component.clone());
        let names = [name(first), name(second)];
        if angle == 0.0 {
            return [first, second].map(|of| Self {
                name: name(of),
                orientation: match direction(of) {
                    Some(Direction::Azimuth(azimuth)) => Orientation::of(azimuth, 0.0),
                    _ => of.origin().and_then(|o| o.orientation),
                },
            });
        }
        if let (Some(Direction::Azimuth(a)), Some(Direction::Azimuth(b))) =
            (direction(first), direction(second))
        {
            // The second may lie a quarter turn on either side.
            let sense = libm::copysign(1.0, libm::sin((b - a).to_radians()));
            return [angle, angle + 90.0].map(|angle| Self::to(a + sense * angle));
        }
        let [first, second] = names.map(|name| match name.as_str() {
            "" => None,
            _ => Some(name),
        });
        let shown =
            |name: &Option<String>, other: &str| name.clone().unwrap_or_else(|| other.into());
        let (first, second) = (
            shown(&first, "first component"),
            shown(&second, "second component"),
        );
        let unknown = |name| Self {
            name,
            orientation: None,
        };
        [
            unknown(format!(
                "{first} turned by {angle} degrees towards {second}"
            )),
            unknown(format!(
                "{second} turned by {angle} degrees away from {first}"
            )),
        ]
    }
}

/// Refuses components of two instruments, one in the borehole and one at the surface.
fn at_one_depth(first: &Accelerogram, second: &Accelerogram) -> Result<(), GroundMotionError> {
    let name = |of: &Accelerogram| of.origin().map_or(String::new(), |o| o.component.clone());
    let (first, second) = (name(first), name(second));
    let instrument = |name: &str| Direction::of_borehole(name).map(|(_, number)| number);
    match (instrument(&first), instrument(&second)) {
        (Some(a), Some(b)) if a != b => Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!(
                "the components \"{first}\" and \"{second}\" are of two depths: 1 is in the borehole, 2 at the surface"
            ),
            remedy: "give the two horizontal components of one depth, NS2 and EW2 at the surface",
        }),
        _ => Ok(()),
    }
}

/// Refuses components whose names say that they are not horizontal, or not at right angles.
pub(crate) fn at_right_angles(
    first: &Accelerogram,
    second: &Accelerogram,
) -> Result<(), GroundMotionError> {
    at_one_depth(first, second)?;
    let directions = [direction(first), direction(second)];
    let is_vertical = |d: &Option<Direction>| matches!(d, Some(Direction::Up | Direction::Down));
    let apart = match directions {
        [Some(Direction::Azimuth(a)), Some(Direction::Azimuth(b))] => (a - b).rem_euclid(180.0),
        _ => 90.0,
    };
    if !directions.iter().any(is_vertical) && (apart - 90.0).abs() <= OFF_RIGHT_ANGLE + 1.0e-9 {
        return Ok(());
    }
    let shown = |of: &Accelerogram, direction: Option<Direction>| {
        let name = of.origin().map_or("", |o| o.component.as_str());
        match direction {
            Some(Direction::Azimuth(azimuth)) => {
                format!("\"{name}\" (azimuth {} degrees)", bound(azimuth))
            }
            Some(_) => match of.origin().and_then(|o| o.orientation) {
                Some(stated) => format!("\"{name}\" (dip {} degrees)", bound(stated.dip)),
                None => format!("\"{name}\" (vertical)"),
            },
            None => format!("\"{name}\""),
        }
    };
    Err(GroundMotionError::NotPossible {
        step: STEP,
        reason: format!(
            "the components {} and {} are not two horizontal ones at right angles",
            shown(first, directions[0]),
            shown(second, directions[1])
        ),
        remedy: "give the two horizontal components of the record, such as 0 and 90, or N-S and E-W",
    })
}

fn combine(
    first: &Accelerogram,
    second: &Accelerogram,
    weights: [[f64; 2]; 2],
    turned: [Turned; 2],
    step: StepRecord,
) -> Result<RotatedPair, GroundMotionError> {
    let Together { samples, warnings } = together(first, second)?;
    let component = |of: &Accelerogram, w: [f64; 2], to: Turned| {
        let pairs = samples[0].iter().zip(samples[1].iter());
        let sum = pairs.map(|(a, b)| w[0] * a + w[1] * b).collect();
        let turned = of.with_samples(sum, first.time_step())?;
        let turned = turned.pointing(to.orientation).called(to.name);
        Ok::<_, GroundMotionError>(
            warnings
                .iter()
                .fold(turned, |of, said| of.warned(Some(said))),
        )
    };
    let counts = [first, second].map(|of| of.samples().len() as f64);
    let step = match counts[0] == counts[1] {
        true => step,
        false => step.number("samples of the first", counts[0], "-").number(
            "samples of the second",
            counts[1],
            "-",
        ),
    };
    let step = step.number("samples used", samples[0].len() as f64, "-");
    let [to_first, to_second] = turned;
    let mut pair = RotatedPair {
        first: component(first, weights[0], to_first)?,
        second: component(second, weights[1], to_second)?,
        step,
    };
    for one in [&mut pair.first, &mut pair.second] {
        one.note(std::slice::from_ref(&pair.step));
    }
    Ok(pair)
}

/// Two components at right angles, turned by an angle (degrees) from the first
/// towards the second: `a1 cos + a2 sin` and `-a1 sin + a2 cos`. Both must start at
/// the same time; the shorter one is continued with zeros, with a warning.
///
/// # Errors
/// Different time steps, an angle that is not finite, components whose names say directions
/// that are not horizontal or not at right angles, or one that still moves strongly where the
/// other has ended.
pub fn rotate(
    first: &Accelerogram,
    second: &Accelerogram,
    angle: f64,
) -> Result<RotatedPair, GroundMotionError> {
    within(STEP, "angle", angle, -360.0, 360.0)?;
    at_right_angles(first, second)?;
    let (sine, cosine) = libm::sincos(angle.to_radians());
    let step = StepRecord::new(STEP).number("angle", angle, "degrees");
    let weights = [[cosine, sine], [-sine, cosine]];
    let turned = Turned::by(angle, first, second);
    combine(first, second, weights, turned, step)
}

/// The components parallel to a fault (first) and normal to it (second, a quarter
/// turn clockwise from the strike), from two components and their azimuths; azimuths
/// and strike in degrees clockwise from north. The components need not be at right
/// angles; the shorter one is continued with zeros, with a warning.
///
/// # Errors
/// Different time steps, azimuths out of range, or components less than 30 degrees
/// apart; a component that still moves strongly where the other has ended.
pub fn fault_components(
    first: (&Accelerogram, f64),
    second: (&Accelerogram, f64),
    strike: f64,
) -> Result<RotatedPair, GroundMotionError> {
    for (name, angle) in [
        ("first azimuth", first.1),
        ("second azimuth", second.1),
        ("strike", strike),
    ] {
        within(STEP, name, angle, -360.0, 360.0)?;
    }
    let between = libm::sin((second.1 - first.1).to_radians());
    if between.abs() < LEAST_SINE {
        return Err(GroundMotionError::Mismatch(format!(
            "their azimuths {} and {} degrees are too near one line",
            first.1, second.1
        )));
    }
    // a(b) = (a1 sin(b2 - b) + a2 sin(b - b1)) / sin(b2 - b1).
    let weights = |azimuth: f64| {
        [
            libm::sin((second.1 - azimuth).to_radians()) / between,
            libm::sin((azimuth - first.1).to_radians()) / between,
        ]
    };
    let step = StepRecord::new(OF_FAULT)
        .number("first azimuth", first.1, "degrees")
        .number("second azimuth", second.1, "degrees")
        .number("strike", strike, "degrees");
    combine(
        first.0,
        second.0,
        [weights(strike), weights(strike + 90.0)],
        [strike, strike + 90.0].map(Turned::to),
        step,
    )
}
