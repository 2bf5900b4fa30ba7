//! What to try after errors and warnings of the crates below, in words of this library: what they say
//! themselves names keys of case files and options of the program.

use pounding_catalogue::DefinitionError;
use pounding_gap_element::{GapElementError, SeparationRule};
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::HysteresisError;
use pounding_shear_building::{IsolatorError, ShearBuildingError};
use pounding_time_history::{StepLimit, TimeHistoryError, Warning};

/// Of a result that would be too large.
#[cfg(feature = "hdf5")]
pub(crate) const OF_SIZE: &str = "take a longer `.output_step(...)`, or a shorter `.duration(...)`; peaks and impacts do not depend on the output step";

/// Of a building.
pub(crate) fn of_building(error: &ShearBuildingError) -> Option<String> {
    match error {
        ShearBuildingError::Isolator { source, .. } => of_isolator(source),
        ShearBuildingError::Value { .. } => Some(
            "correct the value and its unit: `Mass::tonnes(25.0)`, `Stiffness::meganewtons_per_metre(3.46)` and `Length::metres(3.0)` are usual ones"
                .to_owned(),
        ),
        error => error.help(),
    }
}

fn of_isolator(error: &IsolatorError) -> Option<String> {
    let text = match error {
        IsolatorError::PostYield { .. } => {
            "usual is `PostYield::Period` of 2 to 4 (s); `PostYield::Stiffness` is in N/m"
        }
        IsolatorError::Strength { .. } => {
            "usual are 0.03 to 0.10 of the weight: correct `Strength::OfWeight` or `Strength::YieldForce` (N)"
        }
        IsolatorError::Ratio { .. } => "usual are 6.5 to 15; take 10 where nothing is known",
        IsolatorError::PlainWithStrength => "take `strength: None`, or a `stiffness_ratio` above 1",
        IsolatorError::NoStrength => {
            "give a `strength`, such as `Some(Strength::OfWeight(0.06))`; a `stiffness_ratio` of 1 is plain rubber"
        }
        error => return error.help(),
    };
    Some(text.to_owned())
}

/// Of an impact model by name.
pub(crate) fn of_model(error: &GapElementError) -> Option<String> {
    const ALL: &str = "`gap_element::registry::descriptors()` has all";
    match error {
        GapElementError::Definition(DefinitionError::UnknownName { nearest: "", .. }) => {
            Some(ALL.to_owned())
        }
        GapElementError::Definition(error @ DefinitionError::UnknownName { .. }) => {
            Some(format!("{} {ALL}", error.help()))
        }
        GapElementError::Definition(DefinitionError::MissingParameter { parameter, .. }) => Some(
            format!("add {parameter} to the parameters of `.model(...)`"),
        ),
        GapElementError::Separation { offered, .. } => {
            let rules = offered
                .iter()
                .filter_map(|name| SeparationRule::from_name(name));
            let rules: Vec<String> = rules.map(|r| format!("`SeparationRule::{r:?}`")).collect();
            Some(format!("it offers {}", rules.join(", ")))
        }
        error => error.help(),
    }
}

/// Of a law of storeys or links.
pub(crate) fn of_law(error: &HysteresisError) -> Option<String> {
    match error {
        HysteresisError::Definition(DefinitionError::MissingParameter { parameter, .. }) => {
            Some(format!("add {parameter} to the parameters of `.law(...)`"))
        }
        error => error.help(),
    }
}

/// Of a ground motion.
pub(crate) fn of_motion(error: &GroundMotionError) -> String {
    let read = |options: &str| format!("read it by `ground_motion::read` with {options}");
    match error {
        GroundMotionError::Io { .. } => "check the path".to_owned(),
        GroundMotionError::UnknownFormat { .. } => {
            let known = error.help().unwrap_or_default();
            let known = known.split(';').next().unwrap_or_default();
            format!(
                "{known}; or, of columns of numbers, {}",
                read("`unit` and `time_step` of `ReadOptions`")
            )
        }
        GroundMotionError::MissingUnit { .. } => read(
            "`unit` of `ReadOptions`, such as `Some(AccelerationUnit::StandardGravity)`; units are never guessed",
        ),
        GroundMotionError::MissingTimeStep { .. } => {
            read("`time_step` of `ReadOptions`, such as `Some(0.02)` (s)")
        }
        GroundMotionError::TooFewSamples { .. } => format!(
            "the file is probably truncated: get it again, or {}",
            read("`lenient: true` in `ReadOptions` to use what is there")
        ),
        GroundMotionError::AmbiguousSeries { .. } => {
            read("`component` of `ReadOptions`: its name, azimuth or channel number")
        }
        GroundMotionError::OfOption { error, .. } => of_motion(error),
        GroundMotionError::NoSuchSeries { .. } => "correct `component` of `ReadOptions`".to_owned(),
        GroundMotionError::Uneven { mean, .. } => read(&format!(
            "`time_step` of `ReadOptions`, at most {mean:.6} s, to have it resampled to even steps by linear interpolation"
        )),
        GroundMotionError::MissingSensitivity { .. } => read(
            "`response`, the station's StationXML, or `sensitivity` in counts per m/s2 of `ReadOptions`; or, of floats that are no counts, with `unit`",
        ),
        error => without_options(&error.help().unwrap_or_default()),
    }
}

/// What is said of an option of a reader, without how a case file and the program call it.
fn without_options(text: &str) -> String {
    const END: &str = "with `pounding motion`";
    let mut rest = text;
    let mut said = String::new();
    while let Some(end) = rest.find(END) {
        let (before, after) = (&rest[..end], &rest[end + END.len()..]);
        let cut = |from: &str| before.rfind(from).map(|start| &before[..start]);
        let (kept, of, after) = if let Some(kept) = cut(" in [ground_motion] of a case, `--") {
            (kept, " of `ReadOptions`", after)
        } else if let Some(kept) = cut(" (`--") {
            (
                kept,
                " of `ReadOptions`",
                after.strip_prefix(')').unwrap_or(after),
            )
        } else if let Some(kept) = cut(", `--") {
            (kept, " of `ReadOptions`", after)
        } else {
            (&rest[..end + END.len()], "", after)
        };
        said.push_str(kept);
        said.push_str(of);
        rest = after;
    }
    said + rest
}

/// Of a system or a run.
pub(crate) fn of_run(error: &TimeHistoryError) -> Option<String> {
    let text = match error {
        TimeHistoryError::TooManySteps { limit, .. } => of_limit(limit),
        TimeHistoryError::UnstableStep { .. } => {
            "choose a smaller `step`, or take `MethodChoice::EventDriven`, `Adaptive` or `Newmark` with beta 0.25 and gamma 0.5; check stiffness, damping and masses there for a wrong unit"
        }
        TimeHistoryError::StepTooSmall { .. } => {
            "check stiffness and masses at that level for a wrong unit; with a fixed-step method choose a smaller `step`, or take `MethodChoice::Adaptive`; floors that hold together without any clearance between two walls have no unique contact forces: leave some; a `relative_tolerance` below 1e-10, or a restitution of almost zero, may ask for more than numbers hold: take larger ones"
        }
        TimeHistoryError::NotFinite { .. } => {
            "check stiffness, masses and gap widths; with a fixed-step method choose a smaller `step`, or take `MethodChoice::Adaptive`"
        }
        TimeHistoryError::LawNotFollowed { .. } => {
            "choose a smaller `step`, or take `MethodChoice::EventDriven`, `Adaptive` or `Newmark`"
        }
        TimeHistoryError::Collapse { .. } => {
            "that is an answer, not a fault of the method: what the storeys can carry after yield falls with their drift, by gravity (`.p_delta()`) or by a law whose force falls; check yield force, hardening, heights and mass"
        }
        TimeHistoryError::NotLinear { .. } => {
            "take `MethodChoice::Adaptive`, `EventDriven` or `Newmark`, or linear storeys and no links"
        }
        TimeHistoryError::CompliantModel { .. } => {
            "give every gap the model \"stereomechanical\", or take another method, as `MethodChoice::Adaptive`"
        }
        TimeHistoryError::InitialState { .. } => {
            "correct `.initial_displacement(...)` and `.initial_velocity(...)` of the buildings"
        }
        TimeHistoryError::Force { .. } => {
            "`ForceHistory::new` takes points of time (s) and force (N) in order of time"
        }
        TimeHistoryError::GapDefinition { reason, .. } if reason.starts_with("width") => {
            "`.width(...)` and `.widths(...)` take clear widths at rest, zero or more"
        }
        TimeHistoryError::GapDefinition { reason, .. } if reason.contains("restitution") => {
            "let `ImpactModel::rigid_restitution` give the ratio of separation to approach velocity"
        }
        TimeHistoryError::Option { option, .. } => return Some(of_option(option).to_owned()),
        error => return error.help(),
    };
    Some(text.to_owned())
}

/// Where an option is set.
fn of_option(option: &str) -> &'static str {
    match option {
        "buildings" => "give the system at least one building",
        "duration" => "correct `.duration(...)`, or `duration` of `RunOptions`",
        "energy_tolerance" => "correct `.energy_tolerance(...)`, or that of `RunOptions`",
        "output_step" => "correct `.output_step(...)`, or the step of the recorder",
        "time step of the ground motion" => "correct the step of the record",
        _ => "correct it in the `MethodChoice`",
    }
}

/// What makes steps longer, or fewer.
fn of_limit(limit: &StepLimit) -> &'static str {
    match limit {
        StepLimit::Duration(_) => "take a shorter `.duration(...)`",
        StepLimit::GroundMotion(_) => {
            "take a shorter `.duration(...)`, or correct the time step of the record"
        }
        StepLimit::Step(_) => {
            "give the `MethodChoice` a longer `step`, or take a shorter `.duration(...)`"
        }
        StepLimit::Element { .. } => {
            "correct stiffness and damping of the law and the masses beside it (units?); else take a shorter `.duration(...)`"
        }
        _ => {
            "correct masses, stiffnesses and damping (units?), or join storeys that are much lighter or stiffer than their neighbours; else take a shorter `.duration(...)`"
        }
    }
}

/// Of a result that cannot be written.
#[cfg(feature = "hdf5")]
pub(crate) fn of_result(error: &pounding_results::WriteError) -> String {
    error
        .help()
        .replace("name another file with -o", "give another path")
}

/// A warning of a model that was built by code.
pub(crate) fn warning(warning: &Warning) -> String {
    let text = warning.to_string();
    match warning {
        Warning::NothingMoves => "nothing moves: the ground motion is zero throughout, no force acts, and the buildings start at rest in place; correct the record, or add `Simulation::force`, `Building::initial_displacement` or `Building::initial_velocity`".to_owned(),
        Warning::ManySteps { steps, limit } => format!(
            "the run may take {steps:.1e} steps, or parts of steps in which peaks are looked for, as {limit}: {}",
            of_limit(limit)
        ),
        Warning::EnergyFromContacts { .. } => {
            text.replace("method = \"adaptive\"", "`MethodChoice::Adaptive`")
        }
        Warning::CoarseStep { .. }
        | Warning::LongerPeriod { .. }
        | Warning::AddedDamping { .. } => {
            text.replace("method = \"event_driven\"", "`MethodChoice::EventDriven`")
        }
        Warning::DampingInIsolator { .. } => {
            text.replace("use `modal` or `dashpots`", "use `Damping::Modal` or `Damping::Dashpots`")
        }
        Warning::EndsBeforePeak { .. } => text.replace(
            "take a longer `duration`, or leave it out; where a filter puts zeros before the record, `keep_pads = false` in the filter leaves them out",
            "take a longer `.duration(...)`, or leave it out",
        ),
        Warning::EndsAtPeak { .. } => text.split("; a record that is too short").next().unwrap_or(&text).replace(
            "take a longer `duration`",
            "take a longer `.duration(...)`, beyond the end of the record where that is too short",
        ),
        Warning::EndsBeforeForce { .. } => text.replace(
            "take a longer `duration`, or a shorter `delay`",
            "take a longer `.duration(...)`, or an earlier force",
        ),
        Warning::GroundOffset { .. } => text.replace(
            "correct them with `process`",
            "correct them by `ground_motion::processing`",
        ),
        Warning::StrengthMayBeLost { .. } | Warning::StrengthLost { .. } => {
            text.replace("`p_delta = true`", "`.p_delta()`")
        }
        Warning::SoftContact { .. } => text.replace(
            "that `pounding stiffness` derives",
            "from `gap_element::contact_stiffness`",
        ),
        _ => text,
    }
}
