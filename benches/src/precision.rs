//! Error against time on the reference cases.

use pounding_time_history::{MethodChoice, System};
use verification::{Failure, ReferenceValues};

use crate::cases::integrate;
use crate::clock::{least, median, thread_seconds};
use crate::methods::families;
use crate::peers::{PEERS, Program, Room};

/// Relative errors of the peaks.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    pub(crate) displacement: f64,
    pub(crate) force: f64,
}

impl Errors {
    fn of(displacement: &[f64], force: &[f64], reference: &ReferenceValues) -> Self {
        Self {
            displacement: largest(displacement, &reference.peak_u),
            force: largest(force, &reference.peak_force),
        }
    }

    /// Whether both are within these bounds.
    pub(crate) fn within(&self, (displacement, force): (f64, f64)) -> bool {
        self.displacement <= displacement && self.force <= force
    }
}

/// Largest difference relative to each reference value; where that is zero, to the
/// largest.
fn largest(values: &[f64], reference: &[f64]) -> f64 {
    let scale = reference.iter().copied().fold(0.0, f64::max);
    let pairs = values.iter().zip(reference);
    pairs.fold(0.0, |error: f64, (x, r)| {
        let difference = (x - r).abs() / if *r > 0.0 { *r } else { scale };
        // A NaN is no small error.
        if difference <= error {
            error
        } else if difference.is_nan() {
            f64::INFINITY
        } else {
            difference
        }
    })
}

enum Runner {
    Ours(MethodChoice),
    Peer(Program),
}

/// One setting of one method, measured.
pub(crate) struct Point {
    pub(crate) method: String,
    pub(crate) ours: bool,
    pub(crate) parameter: String,
    runner: Runner,
    /// `None` where the run failed.
    pub(crate) errors: Option<Errors>,
    /// Least processor time of each round (s).
    pub(crate) seconds: Vec<f64>,
}

impl Point {
    /// Least time (ms).
    pub(crate) fn milliseconds(&self) -> f64 {
        1.0e3 * least(&self.seconds)
    }

    /// Median over rounds of the least time (ms).
    pub(crate) fn median_milliseconds(&self) -> f64 {
        1.0e3 * median(&self.seconds)
    }
}

/// What is measured.
pub(crate) struct Plan {
    /// Rounds after the first.
    pub(crate) rounds: usize,
    /// Whether to run fixed steps, ours and theirs.
    pub(crate) fixed_steps: bool,
    /// Whether to run peers in Python.
    pub(crate) python: bool,
    /// Whether to leave out runs beyond a few tens of milliseconds.
    pub(crate) short: bool,
}

/// The bounds of "equal error": in peak displacement and in peak force.
pub(crate) const TARGET: (f64, f64) = (1.0e-4, 1.0e-3);
/// A point that costs more than this (s) is repeated only where it is the cheapest.
const SLOW: f64 = 0.1;
/// Processor time that a measurement aims at (s).
const LONG_ENOUGH: f64 = 0.03;

/// Measures all methods on a case, round after round.
pub(crate) fn measure(
    room: &Room,
    system: &System,
    reference: &ReferenceValues,
    (case, model): (&str, &str),
    plan: &Plan,
) -> Result<Vec<Point>, Failure> {
    let mut points = candidates(room, system, model, plan);
    for point in &mut points {
        if let Ok((errors, seconds)) = once(room, system, reference, (case, model), point, 1) {
            point.errors = Some(errors);
            point.seconds.push(seconds);
        }
    }
    let mut repeated: Vec<(usize, usize)> = Vec::new();
    for (i, point) in points.iter().enumerate() {
        let Some(first) = point.seconds.first() else {
            continue;
        };
        let chosen = || {
            let family: Vec<&Point> = points.iter().filter(|p| p.method == point.method).collect();
            cheapest(&family, TARGET).is_some_and(|p| std::ptr::eq(p, point))
        };
        if *first < SLOW || chosen() {
            repeated.push((i, ((LONG_ENOUGH / first) as usize).clamp(1, 40)));
        }
    }
    for _ in 0..plan.rounds {
        for (i, repetitions) in &repeated {
            let run = once(
                room,
                system,
                reference,
                (case, model),
                &points[*i],
                *repetitions,
            );
            points[*i].seconds.push(run?.1);
        }
    }
    Ok(points)
}

fn candidates(room: &Room, system: &System, model: &str, plan: &Plan) -> Vec<Point> {
    let mut points = Vec::new();
    let mut add = |method: &str, parameter: &str, runner| {
        points.push(Point {
            method: method.to_owned(),
            ours: matches!(runner, Runner::Ours(_)),
            parameter: parameter.to_owned(),
            runner,
            errors: None,
            seconds: Vec::new(),
        });
    };
    for family in families(system.ground().time_step) {
        if family.sweeping.is_none() && !plan.fixed_steps {
            continue;
        }
        for (parameter, choice) in &family.settings {
            if !(plan.short && parameter == "dt/200") {
                add(family.name, parameter, Runner::Ours(*choice));
            }
        }
    }
    for peer in &PEERS {
        let compiled = matches!(peer.program, Program::Compiled(_));
        let knows = peer.models.is_empty() || peer.models.contains(&model);
        let fixed = peer.program != Program::Compiled("evd");
        if !room.has(peer.program)
            || !knows
            || (!compiled && !plan.python)
            || (fixed && !plan.fixed_steps)
        {
            continue;
        }
        for parameter in peer.parameters {
            if !(plan.short && ["200", "500"].contains(parameter)) {
                add(peer.name, parameter, Runner::Peer(peer.program));
            }
        }
    }
    points
}

/// Errors and least time (s) of some repetitions.
fn once(
    room: &Room,
    system: &System,
    reference: &ReferenceValues,
    (case, model): (&str, &str),
    point: &Point,
    repetitions: usize,
) -> Result<(Errors, f64), Failure> {
    match point.runner {
        Runner::Peer(program) => {
            let run = room.run(program, (case, model, &point.parameter), repetitions)?;
            let errors = Errors::of(&run.displacement, &run.force, reference);
            Ok((errors, run.seconds))
        }
        Runner::Ours(method) => {
            let mut seconds = f64::INFINITY;
            let mut errors = None;
            for _ in 0..repetitions {
                let start = thread_seconds();
                let outcome = integrate(system, method)?;
                seconds = seconds.min(thread_seconds() - start);
                let storeys = outcome.buildings.iter().flat_map(|b| &b.storeys);
                let levels = outcome.gaps.iter().flat_map(|g| &g.levels);
                let displacement: Vec<f64> = storeys.map(|s| s.displacement.value).collect();
                let force: Vec<f64> = levels.map(|l| l.peak_force.value).collect();
                errors = Some(Errors::of(&displacement, &force, reference));
            }
            Ok((errors.ok_or("no run")?, seconds))
        }
    }
}

/// The cheapest of a method's settings, given from coarse to fine, from which all
/// finer ones meet the bounds as well.
pub(crate) fn cheapest<'a>(family: &[&'a Point], bounds: (f64, f64)) -> Option<&'a Point> {
    let meets = |p: &&&Point| p.errors.is_some_and(|e| e.within(bounds));
    let good = family.iter().rev().take_while(meets);
    good.min_by(|a, b| a.milliseconds().total_cmp(&b.milliseconds()))
        .copied()
}

/// Methods in order of appearance, with their points.
pub(crate) fn by_method(points: &[Point]) -> Vec<(&str, Vec<&Point>)> {
    let mut families: Vec<(&str, Vec<&Point>)> = Vec::new();
    for point in points {
        match families.last_mut() {
            Some((name, list)) if *name == point.method => list.push(point),
            _ => families.push((&point.method, vec![point])),
        }
    }
    families
}
