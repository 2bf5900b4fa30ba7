//! Our methods: the one place to list them.

use pounding_time_history::MethodChoice;

/// A method with settings from coarse to fine.
pub(crate) struct Family {
    /// Name in the case file.
    pub(crate) name: &'static str,
    /// Parameter as it is printed, and the choice.
    pub(crate) settings: Vec<(String, MethodChoice)>,
    /// The setting for sweeps and scaling; `None` keeps the method out of them.
    pub(crate) sweeping: Option<usize>,
}

/// Relative tolerances.
const TOLERANCES: [f64; 8] = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11];
/// The tolerance of sweeps and scaling.
const SWEEPING: f64 = 1e-8;
/// Steps per sample of the record.
const SUBSTEPS: [u32; 8] = [1, 2, 5, 10, 20, 50, 100, 200];

/// All of ours. `sample` is the time step of the record (s).
pub(crate) fn families(sample: f64) -> Vec<Family> {
    vec![
        toleranced("event_driven", |relative_tolerance| {
            MethodChoice::EventDriven { relative_tolerance }
        }),
        toleranced("adaptive", |relative_tolerance| MethodChoice::Adaptive {
            relative_tolerance,
        }),
        stepped("newmark", sample, |step| MethodChoice::Newmark {
            step,
            beta: 0.25,
            gamma: 0.5,
        }),
        stepped("runge_kutta_4", sample, |step| MethodChoice::RungeKutta4 {
            step,
        }),
    ]
}

/// A method whose parameter is a tolerance; takes part in sweeps and scaling.
fn toleranced(name: &'static str, choice: fn(f64) -> MethodChoice) -> Family {
    let settings = TOLERANCES.iter().map(|t| (format!("{t:e}"), choice(*t)));
    Family {
        name,
        settings: settings.collect(),
        sweeping: TOLERANCES.iter().position(|t| *t == SWEEPING),
    }
}

/// A method whose parameter is a step.
fn stepped(name: &'static str, sample: f64, choice: fn(f64) -> MethodChoice) -> Family {
    let settings = SUBSTEPS
        .iter()
        .map(|n| (format!("dt/{n}"), choice(sample / f64::from(*n))));
    Family {
        name,
        settings: settings.collect(),
        sweeping: None,
    }
}

/// Methods that take part in sweeps and scaling, with the setting there.
pub(crate) fn sweeping(sample: f64) -> Vec<(String, MethodChoice)> {
    families(sample)
        .into_iter()
        .filter_map(|family| {
            let (parameter, choice) = family.settings.get(family.sweeping?)?;
            Some((format!("{} {parameter}", family.name), *choice))
        })
        .collect()
}
