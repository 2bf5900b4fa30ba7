//! What a run will need, before it begins: steps.

use std::f64::consts::TAU;
use std::sync::Arc;

use pounding_gap_element::{Memory, Phase};
use pounding_shear_building::ShearBuilding;

use crate::building_rates::fastest_rate;
use crate::error::TimeHistoryError;
use crate::limits::{APPROACH_VELOCITY, MAXIMUM_STEPS, SHORTEST_CONTACT, StepLimit};
use crate::method_choice::MethodChoice;
use crate::methods::SERIES;
use crate::system::{Element, System};

/// Product of rate and step up to which the pair of order 8 is stable, about.
const STABLE: f64 = 6.0;

/// Product of rate and step up to which the classical method of order 4 is stable whatever the damping: on the
/// imaginary axis, of what swings without it, it is 2.83, on the real one, of what only creeps, 2.79, and least, 2.615,
/// of what is damped to about half of critical.
const STABLE_CLASSICAL: f64 = 2.615;

/// Duration (s) longer than that of any ground motion: eleven days.
const LONGEST_DURATION: f64 = 1.0e6;

/// Steps that a run takes at least, without those of contacts.
#[derive(Debug, Clone, PartialEq)]
pub struct StepEstimate {
    /// Number of steps.
    pub steps: f64,
    /// What makes them so many.
    pub limit: StepLimit,
}

impl StepEstimate {
    /// For a run of this method over a duration (s) whose responses are recorded.
    #[must_use]
    pub fn new(system: &System, method: &MethodChoice, duration: f64) -> Self {
        let ground = system.ground().time_step;
        let exact = system.first_curved_element().is_none();
        let (step, limit) = match *method {
            MethodChoice::EventDriven { .. } | MethodChoice::Adaptive { .. } => {
                let series = exact && matches!(method, MethodChoice::EventDriven { .. });
                let longest = if series { SERIES } else { STABLE };
                shortest(system, system.buildings().iter(), (longest, FROM_REST))
            }
            MethodChoice::Newmark { step, .. }
            | MethodChoice::HhtAlpha { step, .. }
            | MethodChoice::RungeKutta4 { step }
            | MethodChoice::MoreauJean { step, .. } => (step, StepLimit::Step(step)),
        };
        let (step, limit) = if duration > LONGEST_DURATION {
            (step.min(ground), StepLimit::Duration(duration))
        } else if step < ground {
            (step, limit)
        } else {
            (ground, StepLimit::GroundMotion(ground))
        };
        Self {
            steps: (duration / step).ceil(),
            limit,
        }
    }

    /// Refuses what would never end.
    pub(crate) fn check(self, duration: f64) -> Result<(), TimeHistoryError> {
        // A number of steps that is none must end here too.
        if self.steps <= MAXIMUM_STEPS {
            return Ok(());
        }
        Err(TimeHistoryError::TooManySteps {
            steps: self.steps,
            duration,
            limit: self.limit,
        })
    }
}

/// Rates (1/s) of a building, and of a storey or link that follows a law.
type RatesOf = (fn(&Arc<ShearBuilding>) -> f64, fn(&System, &Element) -> f64);

/// What laws ask for from rest, damping included.
const FROM_REST: RatesOf = (|b| fastest_rate(std::slice::from_ref(b)), rate_from_rest);
/// The most that laws may ask for, damping included.
const AT_MOST: RatesOf = (|b| fastest_rate(std::slice::from_ref(b)), rate_at_most);
/// What swings, without damping, of which implicit methods may have any.
const FREQUENCIES: RatesOf = (
    |b| {
        let frequencies = b.modes().circular_frequency.iter();
        frequencies.copied().fold(0.0, f64::max)
    },
    |system, element| swinging(system, element, element.law.steepest_stiffness()),
);

/// Steps whose product with the fastest rate, of a building or of a storey or link that follows a law,
/// is `longest`.
fn shortest<'s>(
    system: &System,
    buildings: impl Iterator<Item = &'s Arc<ShearBuilding>>,
    (longest, (of_building, of_law)): (f64, RatesOf),
) -> (f64, StepLimit) {
    let rates = buildings.map(|b| (of_building(b), b.name()));
    let fastest = rates.max_by(|a, b| a.0.total_cmp(&b.0));
    let (rate, building) = fastest.unwrap_or((0.0, ""));
    let limit = StepLimit::Period {
        building: building.to_owned(),
        period: TAU / rate,
    };
    match by_element(system, longest, |element| of_law(system, element)) {
        Some(elements) if elements.0 < longest / rate => elements,
        _ => (longest / rate, limit),
    }
}

/// The fixed step (s) that is taken where this one is asked for: steps divide the samples of all ground
/// motions evenly.
pub(crate) fn step_taken(system: &System, step: f64) -> f64 {
    let further = system.ground_motions().iter();
    let samples = further.map(|m| m.acceleration.time_step);
    let samples = samples.chain([system.ground().time_step]);
    samples.fold(step, |step, sample| {
        sample / (sample / step - 1.0e-9).ceil().max(1.0)
    })
}

/// Refuses steps that are unstable. With the classical method of order 4 those of laws: where their force is
/// bounded they keep their motion bounded, and forces beyond what they can carry pass for an answer; elastic
/// motion grows beyond all bounds, and the run ends with an error by itself. With Newmark's, where its parameters
/// set a limit (Hughes, The Finite Element Method, 1987, section 9.1), any.
pub(crate) fn is_stable(system: &System, method: &MethodChoice) -> Result<(), TimeHistoryError> {
    let (step, scheme, laws_alone, limit) = match *method {
        MethodChoice::RungeKutta4 { step } => (
            step,
            "the classical Runge-Kutta method".to_owned(),
            true,
            (STABLE_CLASSICAL, AT_MOST),
        ),
        MethodChoice::Newmark { step, beta, gamma } if 2.0 * beta < gamma - 1.0e-12 => (
            step,
            format!("Newmark's method of beta {beta} and gamma {gamma}"),
            false,
            ((0.5 * gamma - beta).sqrt().recip(), FREQUENCIES),
        ),
        _ => return Ok(()),
    };
    let step = step_taken(system, step);
    let asked = |b: &&Arc<ShearBuilding>| !laws_alone || b.all_laws().next().is_some();
    let buildings = system.buildings().iter().filter(asked);
    let (longest, limit) = shortest(system, buildings, limit);
    if step <= longest {
        return Ok(());
    }
    Err(TimeHistoryError::UnstableStep {
        scheme,
        step,
        longest,
        limit,
    })
}

/// Steps on the storey or link with a law that is the fastest by this rate (1/s), whose product with it is
/// `longest`.
fn by_element(
    system: &System,
    longest: f64,
    rate: impl Fn(&Element) -> f64,
) -> Option<(f64, StepLimit)> {
    let rates = system.elements().iter().map(rate).enumerate();
    let (index, rate) = rates.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let limit = StepLimit::Element {
        place: system.place_of_element(index),
        period: TAU / rate,
    };
    (rate > 0.0).then(|| (longest / rate, limit))
}

/// What a law asks for from rest.
fn rate_from_rest(system: &System, element: &Element) -> f64 {
    rate_with(system, element, element.law.initial_stiffness())
}

/// The most that a law may ask for: a bumper where it is closed.
fn rate_at_most(system: &System, element: &Element) -> f64 {
    rate_with(system, element, element.law.steepest_stiffness())
}

/// A damper whose force is a power of the velocity counts as steep as it is at rest, where floors that it holds
/// come to every time they turn.
fn rate_with(system: &System, element: &Element, stiffness: f64) -> f64 {
    let damping = element.law.initial_damping();
    let own = (damping * yielding(system, element)).max(element.law.relaxation_rate());
    swinging(system, element, stiffness).max(own)
}

/// The circular frequency of a floor on a storey or link of this stiffness (N/m) beyond what the matrices have.
fn swinging(system: &System, element: &Element, stiffness: f64) -> f64 {
    let added = (stiffness - element.carried).max(0.0);
    (added * yielding(system, element)).sqrt()
}

/// Acceleration of the deformation of a storey or link by a unit of its force (1/kg).
fn yielding(system: &System, element: &Element) -> f64 {
    let ends = [element.far, element.near].into_iter().flatten();
    let of_ends: f64 = ends.map(|i| 1.0 / system.mass()[i]).sum();
    let further = element.terms.pushed.iter();
    let further = further.map(|(i, w)| w * w / system.mass()[*i]);
    of_ends + further.sum::<f64>()
}

/// Refuses contacts that round-off of the time would lose: those that would stop a floor
/// with [`APPROACH_VELOCITY`] within [`SHORTEST_CONTACT`], in a gap or where the play of a storey or
/// link is taken up.
pub(crate) fn contacts_last(system: &System) -> Result<(), TimeHistoryError> {
    let gaps = system.gaps().iter();
    for (gap, level) in gaps.flat_map(|g| system.levels_of(g).iter().map(move |l| (g, l))) {
        if level.model.rigid_restitution().is_some() {
            continue;
        }
        let (velocity, mass) = (APPROACH_VELOCITY, level.effective_mass);
        let collision = level.model.begin(velocity, mass);
        let (memory, depth) = (Memory::default(), velocity * SHORTEST_CONTACT);
        let force = level
            .model
            .force(&collision, &memory, Phase::Approach, depth, velocity)
            .value;
        if force * SHORTEST_CONTACT > mass * velocity {
            return Err(TimeHistoryError::ContactTooShort {
                gap: gap.name.clone(),
            });
        }
    }
    for (index, element) in system.elements().iter().enumerate() {
        let steepest = element.law.steepest_stiffness();
        let rate = steepest * yielding(system, element) * SHORTEST_CONTACT * SHORTEST_CONTACT;
        if steepest > element.law.initial_stiffness() && rate > 1.0 {
            return Err(TimeHistoryError::ClosureTooShort {
                place: system.place_of_element(index),
            });
        }
    }
    Ok(())
}
