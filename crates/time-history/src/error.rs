//! What can go wrong, with where and when.

use crate::limits::{APPROACH_VELOCITY, MAXIMUM_STEPS, SHORTEST_CONTACT, StepLimit};
use crate::short_numbers::{short, short_below};

/// Failure of a system's definition or of a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TimeHistoryError {
    /// Ground motions that cannot be.
    #[error("ground motions: {reason}")]
    Motions {
        /// What is wrong.
        reason: String,
    },
    /// A model of velocity jumps at several points of one floor. A jump at one of them turns the
    /// floor and closes another; the jumps follow one another ever faster, and where the
    /// sequence ends depends on the order in which they are taken.
    #[error(
        "gap {gap}: model {model} lets velocities jump, which it cannot at several points of a floor that turns: a jump at one turns the floor against the other, and no rule says how that sequence ends"
    )]
    JumpsAtPoints {
        /// Name of the gap.
        gap: String,
        /// Name of the model.
        model: &'static str,
    },
    /// A model of dry friction at more than two points of one floor. Two forces decide how a rigid
    /// floor is held; those at further points are not unique.
    #[error(
        "gap {gap}: model {model} holds floors by friction, which it cannot at {points} points of a floor that turns: two of the forces decide how the floor is held, and no rule says how they are shared"
    )]
    FrictionAtPoints {
        /// Name of the gap.
        gap: String,
        /// Name of the model.
        model: &'static str,
        /// Points of the floor.
        points: usize,
    },
    /// A force on a floor that cannot be.
    #[error("force on a floor: {reason}")]
    Force {
        /// What is wrong.
        reason: String,
    },
    /// A gap of the system is not well defined.
    #[error("gap {gap}: {reason}")]
    GapDefinition {
        /// Name of the gap.
        gap: String,
        /// What is wrong.
        reason: String,
    },
    /// A link of the system is not well defined.
    #[error("link {link}: {reason}")]
    LinkDefinition {
        /// Name of the link.
        link: String,
        /// What is wrong.
        reason: String,
    },
    /// A method that cannot integrate links, or storeys that follow a law.
    #[error(
        "method {method} takes linear storeys without a law, and no links: it cannot integrate {place}"
    )]
    NotLinear {
        /// Name of the method.
        method: &'static str,
        /// The first storey or link with a law.
        place: String,
    },
    /// The buildings cannot start from where they were put.
    #[error("initial state: {reason}")]
    InitialState {
        /// What is wrong.
        reason: String,
    },
    /// An option of the analysis is out of range.
    #[error("analysis: {option} = {value} is out of range: {reason}")]
    Option {
        /// Key of the option.
        option: &'static str,
        /// Its value (SI).
        value: f64,
        /// What is allowed.
        reason: &'static str,
    },
    /// A run that would not end.
    #[error(
        "the run may take {steps:.1e} steps over {} s, as {limit}; {:.0e} are the most", short(*duration),
        MAXIMUM_STEPS
    )]
    TooManySteps {
        /// Steps needed.
        steps: f64,
        /// Duration (s).
        duration: f64,
        /// What makes them so many.
        limit: StepLimit,
    },
    /// A step with which an explicit method is unstable.
    #[error(
        "steps of {} s are unstable with {scheme}: {limit}, with which they may be {} s at most",
        short(*step), short_below(*longest)
    )]
    UnstableStep {
        /// The method, in words, with its parameters.
        scheme: String,
        /// Step (s), after the division of the time steps of ground motions.
        step: f64,
        /// Longest stable step (s).
        longest: f64,
        /// What makes it so short.
        limit: StepLimit,
    },
    /// The method treats rigid impacts only.
    #[error("method moreau_jean treats rigid impacts only, but gap {gap} has model {model}")]
    CompliantModel {
        /// Name of the gap.
        gap: String,
        /// Its model.
        model: &'static str,
    },
    /// The step had to be cut below what time can resolve.
    #[error(
        "the step at t = {} s fell below {step:e} s ({method}); buildings in touch there: {place}",
        seconds(*time)
    )]
    StepTooSmall {
        /// Time (s).
        time: f64,
        /// Last step tried (s).
        step: f64,
        /// Method.
        method: &'static str,
        /// Gap levels in contact, or "none".
        place: String,
    },
    /// The motion is no longer a number.
    #[error(
        "the motion is not finite at t = {} s ({method}); buildings in touch there: {place}",
        seconds(*time)
    )]
    NotFinite {
        /// Time (s).
        time: f64,
        /// Method.
        method: &'static str,
        /// Gap levels in contact, or "none".
        place: String,
    },
    /// A fixed step too long for a law.
    #[error(
        "the steps are too long for {place} at t = {} s ({method}): an internal variable of its law is {} there, and no motion leads beyond {}",
        seconds(*time), short(*value), short(*bound)
    )]
    LawNotFollowed {
        /// Time (s).
        time: f64,
        /// Method.
        method: &'static str,
        /// Storey or link.
        place: String,
        /// Magnitude of the variable (-).
        value: f64,
        /// Its bound (-).
        bound: f64,
    },
    /// Contacts put more energy into the motion than all else, by orders of magnitude.
    #[error(
        "the motion runs away at t = {} s: impact model {model} has put {} J into it at {place}, and all that moves the buildings {} J at most",
        seconds(*time), short(*given), short(*input)
    )]
    ContactGivesEnergy {
        /// Time (s).
        time: f64,
        /// Gap and level that gave most.
        place: String,
        /// Its impact model.
        model: &'static str,
        /// Work of that contact on the buildings (J).
        given: f64,
        /// Largest input energy so far (J).
        input: f64,
    },
    /// A building fell: gravity overturned it (P-Delta), or the force of a storey's law falls.
    #[error(
        "{building} collapsed at t = {} s: storey {storey} drifted by more than its height of {height} m",
        seconds(*time)
    )]
    Collapse {
        /// Time (s).
        time: f64,
        /// Name of the building.
        building: String,
        /// Storey, from 1.
        storey: usize,
        /// Storey height (m).
        height: f64,
    },
    /// A contact too short for the digits of the time.
    #[error(
        "gap {gap}: its impact model stops a floor with {APPROACH_VELOCITY} m/s within {SHORTEST_CONTACT:e} s, which the digits of the time do not tell apart"
    )]
    ContactTooShort {
        /// Name of the gap.
        gap: String,
    },
    /// The same of a storey or link whose law is that stiff once its play is taken up.
    #[error(
        "{place} stops a floor with {APPROACH_VELOCITY} m/s within {SHORTEST_CONTACT:e} s once its play is taken up, which the digits of the time do not tell apart"
    )]
    ClosureTooShort {
        /// The storey or link.
        place: String,
    },
    /// Rigid floors that no impact could move: contact forces between them and the walls
    /// would not be unique.
    #[error(
        "the floors of {place} are rigid and lie between two walls with a clearance of {clearance:e} m: their contact forces are not unique"
    )]
    NoClearance {
        /// Gap levels from wall to wall.
        place: String,
        /// Sum of their widths (m).
        clearance: f64,
    },
    /// Rigid floors that cannot give way.
    #[error(
        "the rigid impact at t = {} s has no solution; buildings in touch there: {place}",
        seconds(*time)
    )]
    Wedged {
        /// Time (s).
        time: f64,
        /// Gap levels in contact.
        place: String,
    },
    /// The same events came back over and over at one time.
    #[error(
        "{count} events at t = {} s without progress, the last at {place}",
        seconds(*time)
    )]
    Chatter {
        /// Time (s).
        time: f64,
        /// Events counted.
        count: usize,
        /// Gap and level, storey or link of the last one.
        place: String,
        /// Whether the method chooses its steps.
        adaptive: bool,
    },
    /// The energy ledger did not close.
    #[error(
        "the energy ledger does not close: residual {residual:.2e} of the largest input energy at t = {} s, allowed {allowed:e} ({method})",
        seconds(*time)
    )]
    EnergyResidual {
        /// Residual over the largest input energy so far (-).
        residual: f64,
        /// Bound (-).
        allowed: f64,
        /// Time (s).
        time: f64,
        /// Method.
        method: &'static str,
        /// Its name in cases.
        name: &'static str,
    },
    /// Responses on a grid of times that nothing would hold.
    #[error(
        "responses every {} s over {} s would take {} GB; {} GB are the most",
        short(*step), short(*duration), short(bytes * 1e-9), short(most * 1e-9)
    )]
    ResponsesTooLarge {
        /// Step of the grid (s).
        step: f64,
        /// Duration of the run (s).
        duration: f64,
        /// Their size (bytes).
        bytes: f64,
        /// What it may be (bytes).
        most: f64,
    },
    /// A recorder refused a step.
    #[error("recorder: {0}")]
    Recorder(String),
}

impl TimeHistoryError {
    /// What to try.
    #[must_use]
    pub fn help(&self) -> Option<String> {
        let text = match self {
            Self::TooManySteps { limit, .. } => limit.remedy(),
            Self::UnstableStep { .. } => {
                "choose a smaller `step`, or use method = \"event_driven\", \"adaptive\" or \"newmark\" with beta = 0.25 and gamma = 0.5; check stiffness, damping and masses there for a wrong unit"
            }
            Self::StepTooSmall { .. } => {
                "check stiffness and masses at that level for a wrong unit; with a fixed-step method choose a smaller `step`, or use method = \"adaptive\"; floors that hold together without any clearance between two walls have no unique contact forces: leave some; a `relative_tolerance` below 1e-10, or a restitution of almost zero, may ask for more than numbers hold: take larger ones"
            }
            Self::NotFinite { .. } => {
                "check stiffness, masses and gap widths; with a fixed-step method choose a smaller `step`, or use method = \"adaptive\""
            }
            Self::LawNotFollowed { .. } => {
                "choose a smaller `step`, or use method = \"event_driven\", \"adaptive\" or \"newmark\""
            }
            Self::ContactGivesEnergy { .. } => {
                "a contact takes energy from the motion: a positive force pushes the floors apart, so that of a spring and a dashpot is k delta + c v; check the signs of that model"
            }
            Self::Collapse { .. } => {
                "that is an answer, not a fault of the method: what the storeys can carry after yield falls with their drift, by gravity (`p_delta`) or by a law whose force falls; check yield force, hardening, heights and mass, or leave out p_delta"
            }
            Self::NotLinear { .. } => {
                "use method = \"adaptive\", \"event_driven\" or \"newmark\", or linear storeys and no links"
            }
            Self::NoClearance { .. } | Self::Wedged { .. } => {
                "rigid floors without clearance between two walls cannot move: give a gap a width, or its model a stiffness"
            }
            Self::ContactTooShort { .. } => {
                "correct the stiffness of the impact model and the masses beside it (units?), or take the rigid model \"stereomechanical\""
            }
            Self::ClosureTooShort { .. } => {
                "correct the stiffness of the law and the masses beside it (units?)"
            }
            Self::CompliantModel { .. } => {
                "use model = \"stereomechanical\" in every gap, or method = \"adaptive\""
            }
            Self::InitialState { .. } => {
                "correct `initial_displacement` and `initial_velocity` of the buildings"
            }
            Self::Chatter {
                adaptive: false, ..
            } => {
                "choose a smaller `step`, or use method = \"event_driven\"; or at a gap try another separation rule, at a storey or a link another law; and report the case"
            }
            Self::Chatter { .. } => {
                "at a gap try another separation rule, at a storey or a link another law, or a method of fixed steps such as `newmark` or `runge_kutta_4`; and report the case"
            }
            Self::EnergyResidual { name, .. } => match *name {
                "adaptive" | "event_driven" => "use a smaller `relative_tolerance`",
                "newmark" => {
                    "use a smaller `step`; `gamma` below 1/2 adds energy to the motion, and above 1/2 it takes energy from it, which a larger `energy_tolerance` allows"
                }
                "hht_alpha" => {
                    "use a smaller `step`; the method takes energy from the motion, which a larger `energy_tolerance` allows"
                }
                _ => "use a smaller `step`, or method = \"event_driven\"",
            },
            Self::ResponsesTooLarge { .. } => {
                "record at longer steps, or shorten the run; peaks and impacts do not depend on the step of a recorder"
            }
            _ => return None,
        };
        Some(text.to_owned())
    }
}

/// A time for people: to the nanosecond, without the noise of sums.
fn seconds(time: f64) -> f64 {
    (time * 1.0e9).round() / 1.0e9
}
