//! Warnings as they are found, of a system, of its options and of a run: one a cause. Their words: [`crate::warning`].

use std::f64::consts::PI;
use std::sync::Arc;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_gap_element::{Bodies, ImpactModel, collide};
use pounding_hysteresis::laboratory;
use pounding_shear_building::{
    Damping, DampingMatrix, Modes, OVERTURNING_RATIO, ShearBuilding, UPLIFT_BEGINS,
};

use crate::estimate::{StepEstimate, step_taken};
use crate::limits::APPROACH_VELOCITY;
use crate::lost_strength;
use crate::method_choice::MethodChoice;
use crate::options::RunOptions;
use crate::outcome::{BuildingOutcome, LevelOutcome};
use crate::peak::Peak;
use crate::soft_contact::{deep_penetrations, soft_contacts};
use crate::system::{ContactLevel, System};
use crate::unusual_values::{self, SMALL_MASS};
use crate::warning::{
    DRIFT_RATIO, FELT, GROUND_ACCELERATION, LENGTHENING, PERIODS, STEPS_IN_CONTACT, Warning,
};

/// Drift ratio at yield that no storey is below: a thousandth of what storeys have at least, as with a
/// yield force in N where kN are meant.
const YIELD_DRIFT_RATIO: f64 = 5.0e-5;
/// Damping (of critical) that fixed steps may add to the fundamental mode of a building.
const ADDED_DAMPING: f64 = 0.005;
/// A first storey with at most this part of the stiffness above it, in which at least
/// that part of the roof's first-mode displacement happens, is taken for an isolator.
const ISOLATOR: (f64, f64) = (0.2, 0.7);
/// Steps times floors from which a run takes long enough to say so.
const LONG_RUN: f64 = 1.0e9;
/// Part of a duration that is no more than its round-off.
const SAME_TIME: f64 = 1.0e-12;
/// Part of the largest input energy up to which what contacts give is the error of a method.
const ROUND_OFF: f64 = 1.0e-4;

/// The warning of a building whose floors are all too light for its storeys.
fn small_mass(building: &ShearBuilding, period: f64) -> Option<Warning> {
    let (least, height, longest) = SMALL_MASS;
    let mass = building.mass().iter().fold(0.0_f64, |most, m| most.max(*m));
    let as_high = building.height().iter().all(|h| *h >= height);
    (mass < least && as_high && period < longest).then(|| Warning::SmallMass {
        building: building.name().to_owned(),
        mass,
        period,
    })
}

/// The warning of a building by the storey that yields, or a frame in which does, at the smallest part of its height.
fn small_yield_drift(building: &ShearBuilding) -> Option<Warning> {
    // Isolators and dampers slide from the start, and their height means nothing.
    let first = usize::from(building.isolator().is_some());
    let storeys = building.laws().iter().enumerate().skip(first);
    let storeys = storeys.filter_map(|(i, law)| Some((i, law.as_ref()?)));
    let frames = building
        .yielding_frames()
        .iter()
        .map(|f| (f.storey, &f.law));
    let drifts = storeys.chain(frames).filter_map(|(i, law)| {
        let (drift, height) = (law.yield_drift?, &building.height()[i]);
        (drift > 0.0 && drift < YIELD_DRIFT_RATIO * height).then_some((i, drift, *height))
    });
    let smallest = drifts.min_by(|a, b| (a.1 / a.2).total_cmp(&(b.1 / b.2)));
    smallest.map(|(storey, drift, height)| Warning::SmallYieldDrift {
        building: building.name().to_owned(),
        storey: storey + 1,
        drift,
        height,
    })
}

impl Warning {
    /// What can be said of a run before it begins, with an assumed approach velocity.
    #[must_use]
    pub fn before(system: &System, options: &RunOptions) -> Vec<Self> {
        let mut warnings = standing(system, options);
        let assumed = |_: usize| Some(APPROACH_VELOCITY);
        warnings.extend(coarse_step(system, &options.method, (assumed, false)));
        warnings
    }

    /// What can be said of buildings and gaps, whatever moves them.
    #[must_use]
    pub fn of_structure(system: &System) -> Vec<Self> {
        let mut warnings = Vec::new();
        for building in system.buildings() {
            let period = building.modes().period[0];
            if !(PERIODS.0..=PERIODS.1).contains(&period) {
                warnings.push(Self::FundamentalPeriod {
                    building: building.name().to_owned(),
                    period,
                });
            } else {
                warnings.extend(small_mass(building, period));
            }
        }
        warnings.extend(
            system
                .buildings()
                .iter()
                .filter_map(|b| small_yield_drift(b)),
        );
        warnings.extend(lost_strength::before(system));
        warnings.extend(unusual_values::of(system));
        warnings.extend(system.buildings().iter().filter_map(|b| stiff_soil(b)));
        let fixed = system.buildings().iter().map(|b| b.without_foundation());
        warnings.extend(fixed.filter_map(braked_isolator));
        for gap in system.gaps() {
            let levels = &system.levels()[gap.first_level..gap.first_level + gap.levels];
            let wide = levels.iter().filter_map(|level| {
                let height = lower_storey(system, level)?;
                (level.width > height).then_some((level.width, height))
            });
            if let Some((width, height)) = wide.max_by(|a, b| a.0.total_cmp(&b.0)) {
                warnings.push(Self::WideGap {
                    gap: gap.name.clone(),
                    width,
                    height,
                });
            }
        }
        warnings.extend(system.unequal_floor_warnings());
        warnings.extend(soft_contacts(system));
        warnings
    }

    /// That the ground shakes as hardly any record does, by its peak acceleration (m/s2).
    #[must_use]
    pub fn of_peak_ground_acceleration(peak: f64) -> Option<Self> {
        let is_beyond = peak > GROUND_ACCELERATION * STANDARD_GRAVITY;
        is_beyond.then_some(Self::GroundAcceleration { peak })
    }

    /// What can be said of ground motions, forces and initial state: that the ground shakes as no
    /// record does, hardly shakes or stays apart, that all is left at rest, or that the run ends before the
    /// ground shakes most, or before a force is largest.
    #[must_use]
    pub fn of_excitation(system: &System, options: &RunOptions) -> Vec<Self> {
        let mut warnings: Vec<_> = ground_offsets(system).collect();
        let further = system.ground_motions().iter().map(|m| &m.acceleration);
        let samples = [system.ground()]
            .into_iter()
            .chain(further)
            .flat_map(|g| g.samples.iter());
        let peak = samples.fold(0.0_f64, |m, a| m.max(a.abs()));
        warnings.extend(Self::of_peak_ground_acceleration(peak));
        let is_weak = peak > 0.0 && peak < FELT * STANDARD_GRAVITY;
        if is_weak && !is_pushed_or_released(system) {
            warnings.push(Self::WeakGroundAcceleration { peak });
        }
        warnings.extend(Self::of_rest(system, options));
        let duration = options.duration.unwrap_or_else(|| system.record_duration());
        warnings.extend(system.forces().iter().filter_map(|force| {
            let time = force.history.peak().time;
            (time > duration).then(|| Self::EndsBeforeForce {
                building: system.buildings()[force.building].name().to_owned(),
                storey: force.storey + 1,
                duration,
                time,
            })
        }));
        warnings
    }

    /// That nothing moves, or that the run ends before the peak ground acceleration.
    fn of_rest(system: &System, options: &RunOptions) -> Option<Self> {
        let mut in_use = system.motions_in_use();
        in_use.retain(|(_, motion, _)| motion.samples.iter().any(|a| *a != 0.0));
        if in_use.is_empty() && !is_pushed_or_released(system) {
            return Some(Self::NothingMoves);
        }
        let duration = options.duration?;
        let peaks = in_use.iter().map(|(place, motion, delay)| {
            let mut peak = Peak::default();
            for (i, a) in motion.samples.iter().enumerate() {
                peak.raise(a.abs(), delay + motion.time_step * i as f64);
            }
            (place, peak)
        });
        let (place, peak) = peaks.max_by(|a, b| a.1.time.total_cmp(&b.1.time))?;
        Self::ends_before_peak(place, duration, peak.time)
    }

    /// The warning of a run of this duration (s) where the peak ground acceleration comes later (s).
    #[must_use]
    pub fn ends_before_peak(place: &str, duration: f64, peak: f64) -> Option<Self> {
        (duration < peak).then(|| Self::EndsBeforePeak {
            place: place.to_owned(),
            duration,
            peak,
        })
    }

    /// The warning of the first building whose displacement is greatest at the end of a run under moving ground alone,
    /// unless it is `told` already that more is to come: what is pushed or was released may come to rest there.
    fn ends_at_peak(
        system: &System,
        options: &RunOptions,
        buildings: &[BuildingOutcome],
        told: &[Self],
    ) -> Option<Self> {
        let is_short = |w: &Self| {
            matches!(
                w,
                Self::EndsBeforePeak { .. } | Self::EndsBeforeForce { .. } | Self::NothingMoves
            )
        };
        if is_pushed_or_released(system) || told.iter().any(is_short) {
            return None;
        }
        let duration = options.duration.unwrap_or_else(|| system.record_duration());
        let last = duration * (1.0 - SAME_TIME);
        buildings.iter().find_map(|building| {
            let at_end = |peak: &Peak| peak.value > 0.0 && peak.time >= last;
            let mut storeys = building.storeys.iter();
            let storey = storeys.rposition(|s| at_end(&s.displacement))?;
            Some(Self::EndsAtPeak {
                building: building.name.clone(),
                storey: storey + 1,
                duration,
            })
        })
    }

    /// What can be said of it afterwards.
    pub(crate) fn after(
        system: &System,
        options: &RunOptions,
        (buildings, levels, lost): (&[BuildingOutcome], &[LevelOutcome], &[Option<f64>]),
        largest_input: f64,
    ) -> Vec<Self> {
        let mut warnings = standing(system, options);
        // Now it is known.
        warnings.retain(|warning| !matches!(warning, Self::StrengthMayBeLost { .. }));
        warnings.extend(lost_strength::after(system, lost));
        warnings.extend(Self::ends_at_peak(system, options, buildings, &warnings));
        let event_driven = matches!(options.method, MethodChoice::EventDriven { .. });
        if let (true, Some(curved)) = (event_driven, system.first_curved_element()) {
            let place = system.place_of_element(curved);
            warnings.push(Self::AdaptiveInPlace { place });
        }
        let met = |l: usize| {
            let velocity = levels[l].approach_velocity_max;
            (velocity > 0.0).then_some(velocity)
        };
        warnings.extend(coarse_step(system, &options.method, (met, true)));
        warnings.extend(unseated(system, levels));
        warnings.extend(deep_penetrations(system, levels));
        for (l, level) in levels.iter().enumerate() {
            let given = -level.energy_dissipated;
            if given > ROUND_OFF * largest_input {
                warnings.push(Self::EnergyFromContacts {
                    place: system.name_of_level(l),
                    energy: given,
                });
            }
        }
        for (outcome, building) in buildings.iter().zip(system.buildings()) {
            let ratios = outcome.storeys.iter().enumerate().map(|(i, storey)| {
                // Of floors that turn the drift is that of their mass centre along the row.
                let frames = outcome.frames.iter().filter(|f| f.storey == i + 1);
                let of_frames = frames.map(|f| f.deformation.value / building.height()[i]);
                of_frames.fold(storey.drift_ratio.value, f64::max)
            });
            // Isolators are there to be displaced, and have a height that means nothing.
            let isolators = usize::from(building.isolator().is_some());
            let most = ratios
                .enumerate()
                .skip(isolators)
                .max_by(|a, b| a.1.total_cmp(&b.1));
            let second_order = building.geometric_stiffness().iter().any(|k| *k > 0.0);
            // Gravity acts through the drift with what the foundation turns.
            let turned = outcome
                .responses
                .iter()
                .find(|r| r.name == "foundation_rotation");
            let rotation = turned
                .filter(|_| second_order)
                .map_or(0.0, |r| r.peak.value);
            if let Some((storey, ratio)) = most.filter(|m| m.1 + rotation > DRIFT_RATIO) {
                warnings.push(Self::Drift {
                    building: outcome.name.clone(),
                    storey: storey + 1,
                    ratio,
                    second_order,
                    rotation,
                });
            }
            let mut responses = outcome.responses.iter();
            let overturning = responses.find(|r| r.name == OVERTURNING_RATIO);
            if let Some(found) = overturning.filter(|r| r.peak.value > UPLIFT_BEGINS) {
                warnings.push(Self::Uplift {
                    building: outcome.name.clone(),
                    ratio: found.peak.value,
                });
            }
        }
        warnings
    }
}

/// Whether forces act, or buildings do not start at rest in place.
fn is_pushed_or_released(system: &System) -> bool {
    let pushed = system.forces().iter().any(|f| f.history.peak().value > 0.0);
    pushed || system.initial_state().iter().any(|x| *x != 0.0)
}

/// What does not depend on the response.
fn standing(system: &System, options: &RunOptions) -> Vec<Warning> {
    let mut warnings = Warning::of_structure(system);
    warnings.extend(Warning::of_excitation(system, options));
    let duration = options.duration.unwrap_or_else(|| system.record_duration());
    let StepEstimate { steps, limit } = StepEstimate::new(system, &options.method, duration);
    if steps * system.degrees_of_freedom() as f64 > LONG_RUN {
        warnings.push(Warning::ManySteps { steps, limit });
    }
    warnings.extend(of_fundamental_modes(system, &options.method));
    warnings
}

/// What the steps of an implicit method do to the fundamental modes of buildings, for the building to which they do it
/// most, if it is much: what the eigenvalues of the method say of an undamped mode, to the leading order of the angle
/// `x` by which it turns in a step (Hughes, The Finite Element Method, 1987, section 9.3, draws them for both methods;
/// those of the theta method are `(1 + (1 - theta) i x) / (1 - theta i x)`).
fn of_fundamental_modes(system: &System, method: &MethodChoice) -> Vec<Warning> {
    let Some(ImplicitSteps {
        step,
        lengthening,
        damping: (parameter, damping, power),
    }) = ImplicitSteps::of(method)
    else {
        return Vec::new();
    };
    let step = step_taken(system, step);
    let periods = system
        .buildings()
        .iter()
        .map(|b| (b.modes().period[0], b.name()));
    let Some((period, building)) = periods.min_by(|a, b| a.0.total_cmp(&b.0)) else {
        return Vec::new();
    };
    let angle = 2.0 * PI * step / period;
    let lengthening = lengthening * angle * angle;
    let ratio = damping * libm::pow(angle, power);
    let building = building.to_owned();
    let longer = (lengthening.abs() > LENGTHENING).then(|| Warning::LongerPeriod {
        building: building.clone(),
        period,
        step,
        lengthening,
    });
    let damped = (ratio > ADDED_DAMPING).then(|| Warning::AddedDamping {
        building: building.clone(),
        period,
        step,
        parameter,
        ratio,
        shorter: step * libm::pow(ADDED_DAMPING / ratio, 1.0 / power),
    });
    longer.into_iter().chain(damped).collect()
}

/// Steps of an implicit method.
struct ImplicitSteps {
    /// Step (s).
    step: f64,
    /// Lengthening of a period over the square of the angle.
    lengthening: f64,
    /// Damping of critical over a power of the angle: by which parameter, how much, which power.
    damping: (&'static str, f64, f64),
}

impl ImplicitSteps {
    fn of(method: &MethodChoice) -> Option<Self> {
        Some(match *method {
            MethodChoice::Newmark { step, beta, gamma } => {
                let over = gamma - 0.5;
                Self {
                    step,
                    lengthening: 0.5 * beta - 1.0 / 24.0 - 0.25 * over + 0.125 * over * over,
                    damping: ("gamma", 0.5 * over, 1.0),
                }
            }
            MethodChoice::HhtAlpha { step, alpha } => Self {
                step,
                lengthening: 1.0 / 12.0 - 0.25 * alpha - 0.375 * alpha * alpha,
                damping: ("alpha", -0.125 * alpha * (1.0 + alpha) * (1.0 + alpha), 3.0),
            },
            MethodChoice::MoreauJean { step, theta } => {
                let other = 1.0 - theta;
                Self {
                    step,
                    lengthening: (other * other * other + theta * theta * theta) / 3.0,
                    damping: ("theta", theta - 0.5, 1.0),
                }
            }
            _ => return None,
        })
    }
}

/// Period lengthening, less one, below which soil is as good as a fixed base.
const STIFF_SOIL: f64 = 1.0e-5;

/// A foundation on soil that gives a fixed base.
fn stiff_soil(building: &ShearBuilding) -> Option<Warning> {
    let lengthening = building.foundation()?.period_lengthening()? - 1.0;
    (lengthening < STIFF_SOIL).then(|| Warning::StiffSoil {
        building: building.name().to_owned(),
        lengthening,
    })
}

/// Joints that opened further than their seats are wide.
fn unseated(system: &System, levels: &[LevelOutcome]) -> Vec<Warning> {
    let mut found = Vec::new();
    for gap in system.gaps() {
        let Some(seat) = gap.seat else { continue };
        for level in gap.first_level..gap.first_level + gap.levels {
            let opening = levels[level].joint_opening();
            found.extend(
                opening
                    .filter(|r| r.peak.value > seat)
                    .map(|r| Warning::Unseating {
                        place: system.name_of_level(level),
                        opening: r.peak.value,
                        seat,
                        time: r.peak.time,
                    }),
            );
        }
    }
    found
}

/// Part of the width of a gap from which an offset of the ground is told.
const OFFSET: f64 = 0.1;

/// Gaps between two ground motions that end far from where they began.
fn ground_offsets(system: &System) -> impl Iterator<Item = Warning> {
    system.gaps().iter().filter_map(|gap| {
        let levels = gap.first_level..gap.first_level + gap.levels;
        let found = levels.filter_map(|l| {
            let width = system.levels()[l].width;
            let offset = system.ground_offset_at_end(l)?;
            (width > 0.0 && offset.abs() > OFFSET * width).then(|| Warning::GroundOffset {
                gap: gap.name.clone(),
                offset,
                width,
            })
        });
        found.take(1).next()
    })
}

/// Height (m) of the lower of the storeys on both sides.
fn lower_storey(system: &System, level: &ContactLevel) -> Option<f64> {
    let height = |(building, storey): (usize, usize)| system.buildings()[building].height()[storey];
    let heights = level
        .between
        .iter()
        .filter_map(|f| system.storey_of(*f))
        .map(height);
    heights.min_by(f64::total_cmp)
}

/// Damping that brakes the isolators below a building: those that are soft from the start,
/// or that a law of the first storey makes soft when it yields.
fn braked_isolator(building: &ShearBuilding) -> Option<Warning> {
    let proportional = !matches!(
        building.damping(),
        Damping::Modal { .. } | Damping::Dashpots { .. } | Damping::Isolated { .. }
    );
    let above = *building.stiffness().get(1)?;
    let soft = |stiffness: f64| stiffness <= ISOLATOR.0 * above;
    if !proportional {
        return None;
    }
    let from_start = || damping_of_isolator(building, building.modes());
    let from_start = soft(building.stiffness()[0]).then(from_start).flatten();
    let after_yield = || {
        let after = stiffness_after_yield(building).filter(|k| soft(*k))?;
        let mut stiffness = building.stiffness().to_vec();
        // A storey without any has no mode that vibrates: one far softer than all others.
        stiffness[0] = after.max(ISOLATOR.0 * 1e-3 * above);
        let (mass, height) = (building.mass().to_vec(), building.height().to_vec());
        let undamped = Damping::MassProportional { ratio: 0.0 };
        let name = building.name().to_owned();
        let yielded = ShearBuilding::new(name, mass, stiffness, height, undamped).ok()?;
        Some((damping_of_isolator(building, yielded.modes())?, Some(after)))
    };
    let braked = from_start.map(|d| (d, None)).or_else(after_yield);
    braked.map(|((ratio, share), after_yield)| Warning::DampingInIsolator {
        building: building.name().to_owned(),
        ratio,
        share,
        after_yield,
    })
}

/// Damping ratio of the first of these modes, and the part of it that acts on the motion of
/// the first storey, if most of the motion is there: what the storeys above do not take.
/// Dashpots in proportion to the masses stand between the floors and the ground, so that
/// the isolators move them, too.
fn damping_of_isolator(building: &ShearBuilding, modes: &Modes) -> Option<(f64, f64)> {
    let DampingMatrix::Tridiagonal(matrix) = building.damping_matrix() else {
        return None;
    };
    let shape: Vec<f64> = modes.shape.column(0).iter().copied().collect();
    if shape.first()?.abs() < ISOLATOR.1 * shape.last()?.abs() {
        return None;
    }
    let mut forces = vec![0.0; shape.len()];
    matrix.multiply(&shape, &mut forces);
    let whole: f64 = shape.iter().zip(&forces).map(|(x, f)| x * f).sum();
    let storeys = matrix
        .off_diagonal
        .iter()
        .zip(shape.windows(2))
        .map(|(c, x)| {
            let drift = x[1] - x[0];
            -c * drift * drift
        });
    let share = (1.0 - storeys.sum::<f64>() / whole).clamp(0.0, 1.0);
    // Shapes are normalised to the masses.
    let ratio = whole / (2.0 * modes.circular_frequency[0]);
    (whole > 0.0).then_some((ratio, share))
}

/// Slope of the first storey's law (N/m) well beyond its yield, where it is the only storey
/// that yields: in a frame whose other storeys yield too it is no isolator.
fn stiffness_after_yield(building: &ShearBuilding) -> Option<f64> {
    let (first, others) = building.laws().split_first()?;
    let first = first.as_ref()?;
    let far = 10.0 * first.yield_drift?;
    if others.iter().flatten().any(|l| !l.law.is_linear()) {
        return None;
    }
    const STEPS: u32 = 100;
    let path: Vec<f64> = (1..=STEPS)
        .map(|i| far * f64::from(i) / f64::from(STEPS))
        .collect();
    // The slope over the last yield drift; each step lasts a second, that is: slowly.
    let points = laboratory::history(first.law.as_ref(), &path, 1.0);
    let (a, b) = (points.get(points.len() - 11)?, points.last()?);
    Some(((b.force - a.force) / (b.deformation - a.deformation)).max(0.0))
}

/// The shortest contact, if fixed steps are too coarse for it. `velocity` gives the
/// approach velocity at a level (m/s), `None` where there was no contact.
fn coarse_step(
    system: &System,
    method: &MethodChoice,
    (velocity, met): (impl Fn(usize) -> Option<f64>, bool),
) -> Option<Warning> {
    let step = match *method {
        MethodChoice::Newmark { step, .. }
        | MethodChoice::HhtAlpha { step, .. }
        | MethodChoice::RungeKutta4 { step } => step_taken(system, step),
        // The others follow contacts with steps of their own, or have none to follow.
        _ => return None,
    };
    let mut shortest: Option<(f64, &str, f64)> = None;
    for gap in system.gaps() {
        let range = gap.first_level..gap.first_level + gap.levels;
        let touched = range.filter_map(|l| Some((&system.levels()[l], velocity(l)?)));
        let touched: Vec<_> = touched.collect();
        // Light floors and fast ones have short contacts.
        let mass = |a: &&(&ContactLevel, f64), b: &&(&ContactLevel, f64)| {
            a.0.effective_mass.total_cmp(&b.0.effective_mass)
        };
        let lightest = touched.iter().min_by(mass);
        let fastest = touched.iter().max_by(|a, b| a.1.total_cmp(&b.1));
        for (level, velocity) in lightest.into_iter().chain(fastest) {
            let contact = contact_duration(&level.model, *velocity, level.effective_mass);
            if let Some(contact) = contact
                && shortest.is_none_or(|s| contact < s.0)
            {
                shortest = Some((contact, &gap.name, *velocity));
            }
        }
    }
    let (contact, gap, approach_velocity) = shortest?;
    (contact < STEPS_IN_CONTACT * step).then(|| Warning::CoarseStep {
        gap: gap.to_owned(),
        step,
        contact,
        approach_velocity,
        met,
    })
}

/// Duration (s) of a free collision: in closed form where the law has one, else integrated.
fn contact_duration(model: &Arc<dyn ImpactModel>, velocity: f64, mass: f64) -> Option<f64> {
    if model.rigid_restitution().is_some() {
        return None;
    }
    let closed = model.closed_form(velocity, mass).and_then(|c| c.duration);
    let duration = closed.or_else(|| {
        let bodies = Bodies {
            mass_left: mass,
            mass_right: None,
            velocity_left: velocity,
            velocity_right: 0.0,
        };
        collide(model.as_ref(), &bodies).ok().map(|o| o.duration)
    });
    // A spring alone, for a law whose free collision does not end.
    let spring = || {
        let collision = model.begin(velocity, mass);
        let force = model.force(
            &collision,
            &pounding_gap_element::Memory::default(),
            pounding_gap_element::Phase::Approach,
            0.0,
            0.0,
        );
        PI * (mass / force.by_penetration).sqrt()
    };
    let duration = duration.unwrap_or_else(spring);
    (duration > 0.0 && duration.is_finite()).then_some(duration)
}
