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
    /// Largest of a peak displacement, relative to the largest peak displacement.
    pub(crate) displacement: f64,
    /// Largest of a peak force, relative to the largest peak force.
    pub(crate) force: f64,
    /// Largest of any peak, relative to its own value.
    pub(crate) own: f64,
}

impl Errors {
    fn of(displacement: &[f64], force: &[f64], reference: &ReferenceValues) -> Self {
        let u = largest(displacement, &reference.peak_u);
        let f = largest(force, &reference.peak_force);
        Self {
            displacement: u.0,
            force: f.0,
            own: u.1.max(f.1),
        }
    }
}

/// What a run has to keep.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Bound {
    /// Errors of displacement and force, relative to the largest.
    OfLargest(f64, f64),
    /// Error of every peak, relative to its own value.
    OfOwn(f64),
}

impl Bound {
    fn kept(self, errors: Errors) -> bool {
        match self {
            Self::OfLargest(u, f) => errors.displacement <= u && errors.force <= f,
            Self::OfOwn(any) => errors.own <= any,
        }
    }
}

/// Largest difference relative to the largest reference value, and relative to each
/// one's own. Where that is zero, the largest takes its place.
fn largest(values: &[f64], reference: &[f64]) -> (f64, f64) {
    let scale = reference.iter().copied().fold(0.0, f64::max);
    // A NaN is no small error.
    let worse = |a: f64, b: f64| if a.is_nan() || b <= a { a } else { b };
    let pairs = values.iter().zip(reference);
    let errors = pairs.fold((0.0, 0.0), |(all, own), (x, r)| {
        let difference = (x - r).abs();
        let value = if *r > 0.0 { *r } else { scale };
        (
            worse(all, difference / scale),
            worse(own, difference / value),
        )
    });
    let known = |x: f64| if x.is_nan() { f64::INFINITY } else { x };
    (known(errors.0), known(errors.1))
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

/// "Equal error".
pub(crate) const TARGET: Bound = Bound::OfLargest(1.0e-4, 1.0e-3);
/// A point that costs more than this (s) is repeated only where it is the cheapest.
const SLOW: f64 = 0.1;
/// Times in this ratio are the same.
const EQUALLY_CHEAP: f64 = 1.05;
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
/// finer ones keep the bound as well; of equally cheap ones the coarsest.
pub(crate) fn cheapest<'a>(family: &[&'a Point], bound: Bound) -> Option<&'a Point> {
    let keeps = |p: &&&Point| p.errors.is_some_and(|e| bound.kept(e));
    let good: Vec<&Point> = family.iter().rev().take_while(keeps).copied().collect();
    let least = good
        .iter()
        .map(|p| p.milliseconds())
        .fold(f64::INFINITY, f64::min);
    good.into_iter()
        .rfind(|p| p.milliseconds() <= least * EQUALLY_CHEAP)
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
