//! What the user should know of a system, of its options and of a run: one warning a cause.

use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;
use pounding_gap_element::{Bodies, ImpactModel, collide};
use pounding_hysteresis::laboratory;
use pounding_shear_building::{
    Damping, DampingMatrix, Modes, OVERTURNING_RATIO, ShearBuilding, UPLIFT_BEGINS,
};

use crate::estimate::{StepEstimate, StepLimit, short, step_taken};
use crate::lost_strength;
use crate::options::{MethodChoice, RunOptions};
use crate::outcome::{BuildingOutcome, LevelOutcome, Peak};
use crate::soft_contact::{deep_penetrations, soft_contacts, stiffness_text};
use crate::system::{ContactLevel, System, more_pairs};
use crate::unusual_values;

/// Fundamental periods (s) that buildings have.
const PERIODS: (f64, f64) = (0.005, 20.0);
/// A mass (kg) that no floor of a building falls below, the height (m) from which storeys are those of
/// a building and not of a model of one, and a period (s) that models and light buildings exceed:
/// with all masses a thousand times as large a building of 6 s has it.
pub(crate) const SMALL_MASS: (f64, f64, f64) = (1000.0, 2.0, 0.2);
/// Drift ratio at yield that no storey is below: a thousandth of what storeys have at least, as with a
/// yield force in N where kN are meant.
const YIELD_DRIFT_RATIO: f64 = 5.0e-5;
/// Peak ground acceleration (g) that strong records hardly exceed.
const GROUND_ACCELERATION: f64 = 3.0;
/// Peak ground acceleration (g) that is hardly felt.
const FELT: f64 = 0.005;
/// Drift ratio beyond which buildings are no longer what the case says.
const DRIFT_RATIO: f64 = 0.1;
/// Part by which fixed steps of an implicit method may lengthen a fundamental period, or shorten it.
const LENGTHENING: f64 = 0.01;
/// Damping (of critical) that fixed steps may add to the fundamental mode of a building.
const ADDED_DAMPING: f64 = 0.005;
/// Steps in a contact with which fixed steps follow it to a per cent or so.
const STEPS_IN_CONTACT: f64 = 20.0;
/// Approach velocity (m/s) at which a contact is looked at before the run.
pub(crate) const APPROACH_VELOCITY: f64 = 0.5;
/// A first storey with at most this part of the stiffness above it, in which at least
/// that part of the roof's first-mode displacement happens, is taken for an isolator.
const ISOLATOR: (f64, f64) = (0.2, 0.7);
/// Steps times floors from which a run takes long enough to say so.
const LONG_RUN: f64 = 1.0e9;
/// Part of a duration that is no more than its round-off.
const SAME_TIME: f64 = 1.0e-12;
/// Part of the largest input energy up to which what contacts give is the error of a method.
const ROUND_OFF: f64 = 1.0e-4;

/// Something that is possible, but more often a mistake.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize),
    serde(rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum Warning {
    /// A fundamental period that no building has.
    FundamentalPeriod {
        /// Name of the building.
        building: String,
        /// Period (s).
        period: f64,
    },
    /// Floors as light as no building's, which is as stiff as one.
    SmallMass {
        /// Name of the building.
        building: String,
        /// Mass of its heaviest floor (kg).
        mass: f64,
        /// Fundamental period (s).
        period: f64,
    },
    /// A storey that yields as soon as it moves.
    SmallYieldDrift {
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Drift at yield (m).
        drift: f64,
        /// Storey height (m).
        height: f64,
    },
    /// A value that hardly any building or joint has, more likely a slip of the unit or the key.
    UnusualValue {
        /// Building, gap or link.
        of: String,
        /// The value, and what may be meant.
        says: String,
    },
    /// Soil that is as good as a fixed base.
    StiffSoil {
        /// Name of the building.
        building: String,
        /// Period on the soil over that on a fixed base, less one (-).
        lengthening: f64,
    },
    /// A gap wider than a storey beside it is high.
    WideGap {
        /// Name of the gap.
        gap: String,
        /// Width (m).
        width: f64,
        /// Storey height (m).
        height: f64,
    },
    /// A joint that opens further than its seat is wide.
    Unseating {
        /// Gap and level, in words.
        place: String,
        /// Greatest opening (m).
        opening: f64,
        /// Seat width (m).
        seat: f64,
        /// When the joint opens most (s).
        time: f64,
    },
    /// Ground on both sides of a gap that ends far from where it began.
    GroundOffset {
        /// Name of the gap.
        gap: String,
        /// Displacement of the ground at the left less that at the right when the motions
        /// end (m).
        offset: f64,
        /// Width of the gap at rest (m).
        width: f64,
    },
    /// Floors at different elevations that act on each other, as the case asks for.
    UnequalFloors {
        /// Name of the gap.
        gap: String,
        /// The first pair of them: storeys, buildings and elevations.
        floors: String,
        /// Difference of its elevations (m).
        difference: f64,
        /// Number of such pairs in the gap.
        pairs: usize,
    },
    /// Floors that meet columns of the neighbour and hit nothing, beside others that do hit
    /// columns.
    ColumnsLeftOut {
        /// Name of the gap.
        gap: String,
        /// The first floor: storey, building and elevation.
        floor: String,
        /// Name of the building whose columns it meets.
        hit: String,
        /// Number of such floors in the gap.
        floors: usize,
    },
    /// A ground acceleration that hardly any record has.
    GroundAcceleration {
        /// Peak (m/s2).
        peak: f64,
    },
    /// A ground acceleration that is hardly felt, where nothing else moves the buildings.
    WeakGroundAcceleration {
        /// Peak (m/s2).
        peak: f64,
    },
    /// A run that ends before the ground shakes most.
    EndsBeforePeak {
        /// Whose ground motion it is, in words; empty for the one under all buildings.
        place: String,
        /// Duration of the run (s).
        duration: f64,
        /// When the peak ground acceleration comes (s).
        peak: f64,
    },
    /// A run that ends while a floor is displaced most.
    EndsAtPeak {
        /// Name of the building.
        building: String,
        /// Storey below the floor, from 1.
        storey: usize,
        /// Duration of the run (s).
        duration: f64,
    },
    /// A run that ends before a force is largest.
    EndsBeforeForce {
        /// Building.
        building: String,
        /// Storey below the floor, from 1.
        storey: usize,
        /// Duration of the run (s).
        duration: f64,
        /// When the force is largest (s).
        time: f64,
    },
    /// Contacts of a level have lost less than nothing.
    EnergyFromContacts {
        /// Gap and level.
        place: String,
        /// What they gave (J).
        energy: f64,
    },
    /// No ground motion, no force and no initial state.
    NothingMoves,
    /// Damping in proportion to mass and stiffness that brakes an isolator.
    DampingInIsolator {
        /// Name of the building.
        building: String,
        /// Damping ratio of the first mode (-).
        ratio: f64,
        /// Part of it that acts on the motion of the first storey (-).
        share: f64,
        /// Stiffness (N/m) of that storey after yield, if it is soft only then.
        after_yield: Option<f64>,
    },
    /// Fixed steps that a contact is too short for.
    CoarseStep {
        /// Name of the gap with the shortest contact.
        gap: String,
        /// Step (s).
        step: f64,
        /// Duration of the contact (s).
        contact: f64,
        /// Approach velocity that it belongs to (m/s).
        approach_velocity: f64,
        /// Whether that velocity is taken from the run, not assumed.
        met: bool,
    },
    /// Fixed steps of an implicit method by whose parameters a building is damped.
    AddedDamping {
        /// Name of the building.
        building: String,
        /// Fundamental period (s).
        period: f64,
        /// Step (s).
        step: f64,
        /// Parameter of the method that makes it.
        parameter: &'static str,
        /// Damping of the fundamental mode by these steps, of critical (-).
        ratio: f64,
        /// Step (s) that adds as much as is said of none.
        shorter: f64,
    },
    /// Fixed steps of an implicit method that a building is too fast for.
    LongerPeriod {
        /// Name of the building.
        building: String,
        /// Fundamental period (s).
        period: f64,
        /// Step (s).
        step: f64,
        /// Period by these steps over its own, less one (-).
        lengthening: f64,
    },
    /// A run of very many steps.
    ManySteps {
        /// Steps at least.
        steps: f64,
        /// What makes them so many.
        limit: StepLimit,
    },
    /// A peak drift ratio beyond what the model of the building covers.
    Drift {
        /// Name of the building.
        building: String,
        /// Storey with the maximum one, from 1.
        storey: usize,
        /// Drift ratio (-).
        ratio: f64,
        /// Whether gravity acts through the drift.
        second_order: bool,
        /// Rotation of the foundation (rad), which gravity follows too; zero without P-Delta or
        /// on a base that does not rotate.
        rotation: f64,
    },
    /// A storey whose law may lose all its strength, where gravity does not act through the drift.
    StrengthMayBeLost {
        /// Name of the building.
        building: String,
        /// The lowest such storey, from 1.
        storey: usize,
    },
    /// A storey or a link that lost all its strength.
    StrengthLost {
        /// Storey or level of a link, in words.
        place: String,
        /// When it did (s).
        time: f64,
        /// Whether it is a storey through whose drift gravity does not act.
        stands: bool,
    },
    /// A moment on a foundation that lifts its edge off the soil.
    Uplift {
        /// Name of the building.
        building: String,
        /// The moment over half of weight times length of the foundation (-).
        ratio: f64,
    },
    /// The event-driven method left a run to the adaptive pair.
    AdaptiveInPlace {
        /// The first storey or link whose law is not linear between changes of branch.
        place: String,
    },
    /// A contact of floors that is softer than the storeys beside it.
    SoftContact {
        /// Name of the gap.
        gap: String,
        /// Force over penetration in an approach of 0.5 m/s (N/m).
        stiffness: f64,
        /// The softest storey of the floors that meet, in words.
        storey: String,
        /// Its stiffness (N/m).
        storey_stiffness: f64,
        /// A thousand or a million, with the stiffness (N/m) of a contact of so many times the
        /// force, if that is as stiff as contacts are.
        meant: Option<(f64, f64)>,
    },
    /// Floors that overlap by more than the gap is wide, in a contact that is hardly stiffer than a storey.
    DeepPenetration {
        /// Gap and level, in words.
        place: String,
        /// Maximum penetration (m).
        penetration: f64,
        /// Width of the gap at rest (m).
        width: f64,
        /// When the floors overlap most (s).
        time: f64,
        /// Maximum force over maximum penetration, over the stiffness of the storey (-).
        ratio: f64,
        /// The softest storey of the floors that meet, in words.
        storey: String,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::FundamentalPeriod { building, period } => period_text(f, building, *period),
            Self::SmallMass {
                building,
                mass,
                period,
            } => write!(
                f,
                "{building}: no storey has a mass of more than {0} kg, which with a fundamental period of {1} s no building has: write \"{0} t\" if tonnes are meant, which makes it {2} s",
                short(*mass),
                short(*period),
                short(period * 1000.0_f64.sqrt())
            ),
            Self::SmallYieldDrift {
                building,
                storey,
                drift,
                height,
            } => write!(
                f,
                "{building}, storey {storey}: it yields at a drift of {} mm, {} % of its height, where storeys yield at some 0.2 to 1 %: is the unit of its yield force right (kN, not N)?",
                short(1e3 * drift),
                short(100.0 * drift / height)
            ),
            Self::WideGap { gap, width, height } => write!(
                f,
                "gap {gap}: a width of {} m is more than the {} m of a storey beside it: is its unit right (mm, not m)?",
                short(*width),
                short(*height)
            ),
            Self::Unseating {
                place,
                opening,
                seat,
                time,
            } => write!(
                f,
                "gap {place}: the joint opens by {} m at {} s, more than its seat of {} m: the deck falls",
                short(*opening),
                short(*time),
                short(*seat)
            ),
            Self::GroundOffset { gap, offset, width } => write!(
                f,
                "gap {gap}: when the ground motions end, the ground on both sides has moved {} m apart, {} % of the width of {} m: where the records have no baseline correction, that is an error of the records; correct them with `process`",
                short(offset.abs()),
                short(100.0 * offset.abs() / width),
                short(*width)
            ),
            Self::UnequalFloors {
                gap,
                floors,
                difference,
                pairs,
            } => write!(
                f,
                "gap {gap}: floors at different elevations act on each other as if they were level (floor_to_floor): {floors}, {difference} m apart{}; the columns that such floors hit are not modelled",
                more_pairs(*pairs)
            ),
            Self::ColumnsLeftOut {
                gap,
                floor,
                hit,
                floors,
            } => write!(
                f,
                "gap {gap}: {floor} meets columns of \"{hit}\" between floors and hits nothing{}: `column` gives none of \"{hit}\", or `levels` leaves them out",
                match floors {
                    1 => String::new(),
                    n => format!(" (the first of {n} such floors in this gap)"),
                }
            ),
            Self::GroundAcceleration { peak } => write!(
                f,
                "the peak ground acceleration is {} g, more than the {GROUND_ACCELERATION} g that the strongest records reach: are unit and scale of the record right?",
                short(peak / STANDARD_GRAVITY)
            ),
            Self::WeakGroundAcceleration { peak } => write!(
                f,
                "the peak ground acceleration is {} g, less than the {FELT} g that are felt: are unit and scale of the record right?",
                short(peak / STANDARD_GRAVITY)
            ),
            Self::EndsBeforePeak {
                place,
                duration,
                peak,
            } => write!(
                f,
                "the run ends at {} s, before the peak ground acceleration at {} s{place}, and what follows is left out: take a longer `duration`, or leave it out; where a filter puts zeros before the record, `keep_pads = false` in the filter leaves them out",
                six_digits(*duration),
                six_digits(*peak)
            ),
            Self::EndsAtPeak {
                building,
                storey,
                duration,
            } => write!(
                f,
                "{building}, floor above storey {storey}: the displacement is greatest where the run ends, at {} s, and may grow on: take a longer `duration`; a record that is too short goes on with `process = [{{ pad = {{ after = \"10 s\" }} }}]`",
                six_digits(*duration)
            ),
            Self::EndsBeforeForce {
                building,
                storey,
                duration,
                time,
            } => write!(
                f,
                "the run ends at {} s, before the force on storey {storey} of {building} is largest, at {} s: take a longer `duration`, or a shorter `delay`",
                six_digits(*duration),
                six_digits(*time)
            ),
            Self::EnergyFromContacts { place, energy } => write!(
                f,
                "gap {place}: its contacts gave {} J to the buildings, which no law of contacts does: the result is not to be used; take method = \"adaptive\", and report the case",
                short(*energy)
            ),
            Self::NothingMoves => f.write_str(
                "nothing moves: the ground motion is zero throughout, no force acts, and the buildings start at rest in place; correct the record or its `process`, or add [[building.force]] or an initial displacement or velocity"
            ),
            Self::DampingInIsolator {
                building,
                ratio,
                share,
                after_yield,
            } => {
                let (soft, mode) = after_yield.map_or_else(
                    || ("soft first storey".to_owned(), "mode 1"),
                    |k| {
                        let k = short(1e-6 * k);
                        let soft = format!("first storey that is soft after yield ({k} MN/m)");
                        (soft, "mode 1 with that stiffness")
                    },
                );
                write!(
                    f,
                    "{building} stands on a {soft}, as on isolators, and its damping is in proportion to mass and stiffness: of the {:.1} % of critical in {mode}, {:.0} % act on the motion of that storey, where they brake the isolators; use `modal` or `dashpots`",
                    100.0 * ratio,
                    100.0 * share
                )
            }
            Self::CoarseStep {
                gap,
                step,
                contact,
                approach_velocity,
                met,
            } => write!(
                f,
                "a step of {} ms is too coarse for the contact of gap {gap}, which lasts {} ms at {} of {} m/s: {:.1} steps, where {STEPS_IN_CONTACT} are needed; use a step of {} ms, or method = \"event_driven\"",
                short(1e3 * step),
                short(1e3 * contact),
                if *met {
                    "the approach velocity"
                } else {
                    "an approach velocity"
                },
                short(*approach_velocity),
                contact / step,
                short(1e3 * rounded_down(contact / STEPS_IN_CONTACT)),
            ),
            Self::AddedDamping {
                building,
                period,
                step,
                parameter,
                ratio,
                shorter,
            } => write!(
                f,
                "{building}: with this {parameter}, steps of {} ms damp its fundamental mode of {} s by {:.1} % of critical beside the damping of the building; use a step of {} ms, or method = \"event_driven\"",
                short(1e3 * step),
                short(*period),
                100.0 * ratio,
                short(1e3 * rounded_down(*shorter)),
            ),
            Self::LongerPeriod {
                building,
                period,
                step,
                lengthening,
            } => write!(
                f,
                "{building}: steps of {} ms make its fundamental period of {} s {:.1} % {} than it should; use a step of {} ms, or method = \"event_driven\"",
                short(1e3 * step),
                short(*period),
                100.0 * lengthening.abs(),
                if *lengthening > 0.0 {
                    "longer, so that it swings ever later"
                } else {
                    "shorter, so that it swings ever earlier"
                },
                short(1e3 * rounded_down(step * (LENGTHENING / lengthening.abs()).sqrt())),
            ),
            Self::ManySteps { steps, limit } => write!(
                f,
                "the run may take {steps:.1e} steps, or parts of steps in which peaks are looked for, as {limit}: {}",
                limit.remedy()
            ),
            Self::Drift {
                building,
                storey,
                ratio,
                second_order,
                rotation,
            } => write!(
                f,
                "{building}, storey {storey}: the peak drift{} is {:.1} % of the height; beyond {:.0} % storeys are damaged or gone, and the model of small displacements{} does not hold",
                if *rotation > 0.0 {
                    ", with the rotation of the foundation at most,"
                } else {
                    ""
                },
                100.0 * (ratio + rotation),
                100.0 * DRIFT_RATIO,
                if *second_order {
                    ", P-Delta by the straight-line approximation included,"
                } else {
                    ""
                }
            ),
            Self::StrengthMayBeLost { building, storey } => write!(
                f,
                "{building}, storey {storey}: its law may lose all strength, and without P-Delta nothing then brings the building down: a run in which it does counts as one without collapse, with drifts of floors that nothing but damping holds; give the building `p_delta = true`"
            ),
            Self::StrengthLost {
                place,
                time,
                stands,
            } => write!(
                f,
                "{place}: it has lost all its strength at t = {} s, and bears no force from then on{}",
                short(*time),
                if *stands {
                    "; the building has collapsed, but without P-Delta nothing brings it down: its peaks and residual drifts thereafter are those of floors that nothing but damping holds; give it `p_delta = true`"
                } else {
                    ""
                }
            ),
            Self::UnusualValue { of, says } => write!(f, "{of}: {says}"),
            Self::StiffSoil {
                building,
                lengthening,
            } => write!(
                f,
                "{building}: the soil makes the fundamental period longer by {} % only, as good as a fixed base, and contacts take short steps to follow the foundation on its stiff springs; leave the foundation out, or check the units of the soil",
                short(100.0 * lengthening.max(0.0))
            ),
            Self::Uplift { building, ratio } => write!(
                f,
                "{building}: the moment on the foundation is {ratio:.2} of half of weight times length, {}: its edge lifts off the soil, which is not modelled; springs that hold it down make the rotation, and with it the displacement of floors, too small, and the moment too large",
                match *ratio > 1.0 {
                    true => "more than the weight holds at all",
                    false => "and from a third of it on the soil is pulled at",
                }
            ),
            Self::AdaptiveInPlace { place } => write!(
                f,
                "{place} follows a law that is not linear between changes of branch: in place of exact steps the whole run was made by the adaptive pair 8(5,3), which locates every event as well"
            ),
            Self::SoftContact {
                gap,
                stiffness,
                storey,
                storey_stiffness,
                meant,
            } => {
                write!(
                    f,
                    "gap {gap}: the contact is softer than the storeys beside it: {} at an approach velocity of {APPROACH_VELOCITY} m/s, {} times the {} of {storey}, where contacts have some 10 to 100 times as much",
                    stiffness_text(*stiffness),
                    short(stiffness / storey_stiffness),
                    stiffness_text(*storey_stiffness)
                )?;
                match meant {
                    None => f.write_str("; correct its parameters, or take")?,
                    Some((factor, meant)) => write!(
                        f,
                        "; {} would be {}: write the unit that is meant, or take",
                        if *factor > 1.0e3 {
                            "a million times as much (MN for N, in which a number without unit is)"
                        } else {
                            "a thousand times as much (MN for kN)"
                        },
                        stiffness_text(*meant)
                    )?,
                }
                f.write_str(" a stiffness that `pounding stiffness` derives")
            }
            Self::DeepPenetration {
                place,
                penetration,
                width,
                time,
                ratio,
                storey,
            } => write!(
                f,
                "gap {place}: the floors overlap by {} mm at {} s, more than the {} mm of the gap, in a contact that is {} times as stiff as {storey} alone; contacts have some 10 to 100 times as much: stiffen it, or take a model of a bumper (polycarpou_2013) if it is one",
                short(1e3 * penetration),
                short(*time),
                short(1e3 * width),
                short(*ratio)
            ),
        }
    }
}

/// A period beside what a factor of 1000 in mass or stiffness would make of it.
fn period_text(f: &mut fmt::Formatter<'_>, building: &str, period: f64) -> fmt::Result {
    let factor = 1000.0_f64.sqrt();
    let (than, likely, other) = if period > PERIODS.1 {
        (
            format!("longer than {} s", PERIODS.1),
            "a mass in kg written as \"t\", or a stiffness in kN/m without its unit",
            period / factor,
        )
    } else {
        (
            format!("shorter than {} s", PERIODS.0),
            "a mass in t without its unit, which is taken as kg, or a stiffness in N/m written as \"kN/m\"",
            period * factor,
        )
    };
    write!(
        f,
        "{building}: the fundamental period is {} s, {than}: {likely}, would make it {} s",
        short(period),
        short(other)
    )
}

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

/// The warning of a building by the storey that yields at the smallest part of its height.
fn small_yield_drift(building: &ShearBuilding) -> Option<Warning> {
    // Isolators and dampers slide from the start, and their height means nothing.
    let first = usize::from(building.isolator().is_some());
    let storeys = building.laws().iter().zip(building.height()).enumerate();
    let drifts = storeys.skip(first).filter_map(|(i, (law, height))| {
        let drift = law.as_ref()?.yield_drift?;
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

/// One significant digit, not above the value.
fn rounded_down(x: f64) -> f64 {
    let unit = libm::pow(10.0, libm::log10(x).floor());
    (x / unit).floor() * unit
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
            let ratios = outcome.storeys.iter().map(|s| s.drift_ratio.value);
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
