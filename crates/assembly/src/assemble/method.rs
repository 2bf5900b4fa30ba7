//! The method of a case and the keys of `[analysis]` that it takes.

use pounding_case::{Case, CaseError};
use pounding_catalogue::suggestion;
use pounding_catalogue::wording::agreeing;
use pounding_time_history::{DEFAULT_RELATIVE_TOLERANCE, MethodChoice, RunOptions};

/// Names of the methods, each with the keys that are of methods and have an effect on it.
const METHODS: [(&str, &[&str]); 6] = [
    ("adaptive", &["relative_tolerance"]),
    ("event_driven", &["relative_tolerance"]),
    ("newmark", &["step", "beta", "gamma"]),
    ("hht_alpha", &["step", "alpha"]),
    ("runge_kutta_4", &["step"]),
    ("moreau_jean", &["step", "theta"]),
];

/// Names of the methods.
pub(crate) fn method_names() -> impl Iterator<Item = &'static str> {
    METHODS.iter().map(|(name, _)| *name)
}

pub(super) fn options(case: &Case) -> Result<RunOptions, CaseError> {
    let analysis = &case.analysis;
    let step = || {
        analysis.step.ok_or_else(|| {
            case.error(
                analysis.method.span.clone(),
                format!("method \"{}\" needs a step", analysis.method.value),
                Some("add `step = \"0.1 ms\"` to [analysis]; halve it until peaks stay".to_owned()),
            )
        })
    };
    let relative_tolerance = analysis
        .relative_tolerance
        .unwrap_or(DEFAULT_RELATIVE_TOLERANCE);
    let method = match analysis.method.value.as_str() {
        "adaptive" => MethodChoice::Adaptive { relative_tolerance },
        "event_driven" => MethodChoice::EventDriven { relative_tolerance },
        "newmark" => MethodChoice::Newmark {
            step: step()?,
            beta: analysis.beta.unwrap_or(0.25),
            gamma: analysis.gamma.unwrap_or(0.5),
        },
        "hht_alpha" => MethodChoice::HhtAlpha {
            step: step()?,
            alpha: analysis.alpha.unwrap_or(-0.05),
        },
        "runge_kutta_4" => MethodChoice::RungeKutta4 { step: step()? },
        "moreau_jean" => MethodChoice::MoreauJean {
            step: step()?,
            theta: analysis.theta.unwrap_or(0.5),
        },
        other => {
            let names = METHODS.map(|(name, _)| name);
            return Err(case.error(
                analysis.method.span.clone(),
                format!("unknown method \"{other}\""),
                Some(match suggestion::misspelt(other, names) {
                    Some(name) => format!("did you mean \"{name}\"?"),
                    None => format!("methods are {}", names.join(", ")),
                }),
            ));
        }
    };
    Ok(RunOptions {
        method,
        duration: analysis.duration,
        energy_tolerance: analysis.energy_tolerance,
    })
}

/// The methods that take a key of `[analysis]`; none of a key that all take, or none.
#[must_use]
pub fn methods_that_take(key: &str) -> Vec<&'static str> {
    let takes = METHODS.iter().filter(|(_, keys)| keys.contains(&key));
    takes.map(|(name, _)| *name).collect()
}

/// Keys that the case gives and its method does not take, in words. They are no errors: a study
/// may vary the method.
pub(super) fn without_effect(case: &Case) -> Option<String> {
    let method = case.analysis.method.value.as_str();
    let (_, taken) = METHODS.iter().find(|(name, _)| *name == method)?;
    let given = |key: &str| case.analysis.places.contains_key(key);
    let mut keys: Vec<&str> = Vec::new();
    for key in METHODS.iter().flat_map(|(_, keys)| keys.iter().copied()) {
        if given(key) && !taken.contains(&key) && !keys.contains(&key) {
            keys.push(key);
        }
    }
    let takers = |key: &str| methods_that_take(key).join(", ");
    let told = keys
        .iter()
        .map(|key| format!("`{key}` (of {})", takers(key)));
    let told = told.collect::<Vec<_>>().join(", ");
    (!keys.is_empty()).then(|| {
        let does = agreeing(&keys.len(), "does", "do");
        format!("[analysis]: {told} {does} nothing with method {method}: remove what is not meant, or give a `method` that takes it")
    })
}
