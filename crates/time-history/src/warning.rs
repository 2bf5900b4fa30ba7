//! A warning: its causes, and what is told of each. Where they are found: [`crate::find_warnings`].

use std::fmt;

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;

use crate::limits::{APPROACH_VELOCITY, StepLimit};
use crate::short_numbers::{short, stiffness_text};
use crate::system::more_pairs;

/// Fundamental periods (s) that buildings have.
pub(crate) const PERIODS: (f64, f64) = (0.005, 20.0);
/// Peak ground acceleration (g) that strong records hardly exceed.
pub(crate) const GROUND_ACCELERATION: f64 = 3.0;
/// Peak ground acceleration (g) that is hardly felt.
pub(crate) const FELT: f64 = 0.005;
/// Drift ratio beyond which buildings are no longer what the case says.
pub(crate) const DRIFT_RATIO: f64 = 0.1;
/// Part by which fixed steps of an implicit method may lengthen a fundamental period, or shorten it.
pub(crate) const LENGTHENING: f64 = 0.01;
/// Steps in a contact with which fixed steps follow it to a per cent or so.
pub(crate) const STEPS_IN_CONTACT: f64 = 20.0;

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
        /// Whether it is the law of a frame in it, of a building that turns in plan.
        of_frame: bool,
    },
    /// A storey, a frame or a link that lost all its strength.
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
            Self::StrengthMayBeLost {
                building,
                storey,
                of_frame: true,
            } => write!(
                f,
                "{building}, storey {storey}: the law of a frame may lose all strength, and without P-Delta nothing then brings the building down: a run in which all frames of a storey do counts as one without collapse, with drifts of floors that nothing but damping holds; give the building `p_delta = true`"
            ),
            Self::StrengthMayBeLost {
                building, storey, ..
            } => write!(
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

/// One significant digit, not above the value.
fn rounded_down(x: f64) -> f64 {
    let unit = libm::pow(10.0, libm::log10(x).floor());
    (x / unit).floor() * unit
}
