//! The verification ladder of `pounding`: the reference cases and small helpers
//! that the integration tests share.

use std::sync::Arc;

use pounding_gap_element::{ModelParameters, SeparationRule, registry};
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{
    Floor, GroundAcceleration, MethodChoice, Outcome, RunOptions, System, TimeHistoryError, run,
};
use serde::Deserialize;

/// What a method finds over this time (s), with the usual bound of the ledger.
///
/// # Errors
/// Those of the run.
pub fn outcome_by(
    system: &System,
    method: MethodChoice,
    duration: f64,
) -> Result<Outcome, TimeHistoryError> {
    let options = RunOptions {
        method,
        duration: Some(duration),
        energy_tolerance: None,
    };
    run(system, &options, &mut [], &mut |_| {})
}

/// Any failure while a case is built.
pub type Failure = Box<dyn std::error::Error>;

/// `data/reference_cases.json`.
#[derive(Debug, Deserialize)]
pub struct ReferenceCases {
    /// Cases by name.
    pub cases: std::collections::BTreeMap<String, ReferenceCase>,
}

/// One case with converged values for each model.
#[derive(Debug, Deserialize)]
pub struct ReferenceCase {
    /// Buildings from the left.
    pub buildings: Vec<ReferenceBuilding>,
    /// Contact levels.
    pub links: Vec<ReferenceLink>,
    /// Values by short model name.
    pub models: std::collections::BTreeMap<String, ReferenceValues>,
}

/// A building of a reference case (SI).
#[derive(Debug, Deserialize)]
pub struct ReferenceBuilding {
    /// Name.
    pub name: String,
    /// Floor masses.
    pub m: Vec<f64>,
    /// Storey stiffnesses.
    pub k: Vec<f64>,
    /// Mass factor of the damping.
    #[serde(rename = "alphaM")]
    pub alpha: f64,
    /// Stiffness factor of the damping.
    #[serde(rename = "betaK")]
    pub beta: f64,
}

/// A contact level of a reference case (SI).
#[derive(Debug, Deserialize)]
pub struct ReferenceLink {
    /// Left degree of freedom.
    pub a: usize,
    /// Right degree of freedom.
    pub b: usize,
    /// Gap.
    pub gap: f64,
    /// Stiffness of linear laws.
    pub k_lin: f64,
    /// Stiffness of laws with exponent 3/2.
    pub k_hertz: f64,
    /// Restitution.
    pub e: f64,
}

/// Converged values.
#[derive(Debug, Deserialize)]
pub struct ReferenceValues {
    /// Peak displacement of every degree of freedom (m).
    pub peak_u: Vec<f64>,
    /// Peak force of every level (N).
    #[serde(rename = "peak_F")]
    pub peak_force: Vec<f64>,
    /// First contact (s), -1 for none.
    pub t_first: Vec<f64>,
    /// Largest approach velocity (m/s).
    pub max_v0: Vec<f64>,
    /// Displacements at the end (m).
    pub final_u: Vec<f64>,
    /// Impacts of every level.
    pub n_impacts: Vec<usize>,
    /// Times that floors stuck together.
    pub n_stick: usize,
    /// Input energy (J).
    #[serde(rename = "E_input")]
    pub input: f64,
    /// Viscous damping (J).
    #[serde(rename = "E_visc")]
    pub viscous: f64,
    /// Contact work (J).
    #[serde(rename = "E_contact")]
    pub contact: f64,
    /// Contact work of every level (J).
    #[serde(rename = "E_contact_link")]
    pub contact_levels: Vec<f64>,
}

/// Short names of the models in the reference data.
pub const REFERENCE_MODELS: [&str; 13] = [
    "linear",
    "kv",
    "kv_cut",
    "mj",
    "yeli",
    "papi",
    "hertz",
    "hertzdamp",
    "jank",
    "hunt",
    "flores",
    "fricl",
    "frich",
];

/// Reads the reference cases.
///
/// # Errors
/// If the data file is damaged.
pub fn reference_cases() -> Result<ReferenceCases, Failure> {
    Ok(serde_json::from_str(include_str!(
        "../data/reference_cases.json"
    ))?)
}

/// The synthetic motion of the reference cases.
///
/// # Errors
/// If the data file is damaged.
pub fn synthetic_motion() -> Result<GroundAcceleration, Failure> {
    let samples = include_str!("../data/synthetic_005.csv")
        .lines()
        .map(|line| line.trim().parse::<f64>())
        .collect::<Result<Vec<_>, _>>()?;
    Ok(GroundAcceleration {
        samples: samples.into(),
        time_step: 0.005,
    })
}

/// A ground acceleration (m/s2) that does not change over a duration (s).
#[must_use]
pub fn constant_ground(acceleration: f64, duration: f64) -> GroundAcceleration {
    let samples = 101;
    GroundAcceleration {
        samples: vec![acceleration; samples].into(),
        time_step: duration / (samples - 1) as f64,
    }
}

/// An undamped single storey of this mass (kg) and stiffness (N/m).
///
/// # Panics
/// If they are not positive.
#[must_use]
pub fn single_storey(name: &str, mass: f64, stiffness: f64) -> Arc<ShearBuilding> {
    let none = Damping::Rayleigh {
        alpha: 0.0,
        beta: 0.0,
    };
    let (mass, stiffness) = (vec![mass], vec![stiffness]);
    match ShearBuilding::new(name.to_owned(), mass, stiffness, vec![3.0], none) {
        Ok(building) => Arc::new(building),
        Err(error) => panic!("{error}"),
    }
}

/// A building of equal storeys with this first period (s), and this damping ratio of it.
#[derive(Debug, Clone, Copy)]
pub struct EqualStoreys {
    /// Number of storeys.
    pub storeys: usize,
    /// Mass of each (kg).
    pub mass: f64,
    /// First period (s).
    pub period: f64,
    /// Damping ratio of the first mode, half of it from the masses.
    pub ratio: f64,
}

impl EqualStoreys {
    /// The building.
    ///
    /// # Panics
    /// If the numbers are not possible.
    #[must_use]
    pub fn building(self, name: &str) -> ShearBuilding {
        let angle = std::f64::consts::PI / (2.0 * (2.0 * self.storeys as f64 + 1.0));
        let omega = std::f64::consts::TAU / self.period;
        let stiffness = self.mass * (omega / (2.0 * angle.sin())).powi(2);
        let damping = Damping::Rayleigh {
            alpha: self.ratio * omega,
            beta: self.ratio / omega,
        };
        let all = |x: f64| vec![x; self.storeys];
        let [mass, stiffness, height] = [self.mass, stiffness, 3.0].map(all);
        match ShearBuilding::new(name.to_owned(), mass, stiffness, height, damping) {
            Ok(building) => building,
            Err(error) => panic!("{error}"),
        }
    }
}

/// The rigid impact model with this restitution.
///
/// # Panics
/// If the restitution is not in 0..1.
#[must_use]
pub fn rigid(restitution: f64) -> AnyModel {
    let parameters = ModelParameters::from_pairs(&[("restitution", restitution)]);
    match registry::build("stereomechanical", &parameters) {
        Ok(model) => model.into(),
        Err(error) => panic!("{error}"),
    }
}

/// Bodies (kg) in a row, as good as free, with rigid impacts across gaps (m) between
/// them, and a wall at the right if there is a gap for it.
///
/// # Panics
/// If masses or gaps are not possible.
#[must_use]
pub fn free_bodies(
    masses: &[f64],
    gaps: &[f64],
    restitution: f64,
    ground: GroundAcceleration,
) -> System {
    let name = |i: usize| format!("body{i}");
    let bodies = masses.iter().enumerate();
    let bodies = bodies.map(|(i, m)| single_storey(&name(i), *m, 1.0e-12 * m));
    let mut system = System::new(bodies.collect(), ground);
    for (i, gap) in gaps.iter().enumerate() {
        let (right, next) = if i + 1 == masses.len() {
            (Floor::Wall, "wall".to_owned())
        } else {
            (Floor::Storey(i + 1, 0), name(i + 1))
        };
        let pair = (Floor::Storey(i, 0), right, *gap, rigid(restitution));
        if let Err(error) = system.add_gap(&format!("gap{i}"), [name(i), next], vec![pair]) {
            panic!("{error}");
        }
    }
    system
}

/// The system of a reference case with one of the short-named models; `scale`
/// multiplies all gaps.
///
/// # Errors
/// If the case is not well defined.
pub fn reference_system(
    case: &ReferenceCase,
    model: &str,
    ground: GroundAcceleration,
    scale: f64,
) -> Result<System, Failure> {
    reference_system_with(case, &|link| reference_model(link, model), ground, scale)
}

/// Any impact model.
pub type AnyModel = Arc<dyn pounding_gap_element::ImpactModel>;

/// The system of a reference case with the impact model that `model` gives each
/// level; `scale` multiplies all gaps.
///
/// # Errors
/// If the case is not well defined.
pub fn reference_system_with(
    case: &ReferenceCase,
    model: &dyn Fn(&ReferenceLink) -> Result<AnyModel, Failure>,
    ground: GroundAcceleration,
    scale: f64,
) -> Result<System, Failure> {
    let mut buildings = Vec::new();
    let mut place = Vec::new();
    for (index, b) in case.buildings.iter().enumerate() {
        place.extend((0..b.m.len()).map(|storey| (index, storey)));
        buildings.push(Arc::new(ShearBuilding::new(
            b.name.clone(),
            b.m.clone(),
            b.k.clone(),
            vec![3.0; b.m.len()],
            Damping::Rayleigh {
                alpha: b.alpha,
                beta: b.beta,
            },
        )?));
    }
    let mut system = System::new(buildings, ground);
    for left in 0..case.buildings.len().saturating_sub(1) {
        let mut pairs = Vec::new();
        for link in case.links.iter().filter(|l| place[l.a].0 == left) {
            let (a, b) = (place[link.a], place[link.b]);
            pairs.push((
                Floor::Storey(a.0, a.1),
                Floor::Storey(b.0, b.1),
                link.gap * scale,
                model(link)?,
            ));
        }
        let between = [
            case.buildings[left].name.clone(),
            case.buildings[left + 1].name.clone(),
        ];
        system.add_gap(&between.join("-"), between, pairs)?;
    }
    Ok(system)
}

/// The model of a level by its short name in the reference data.
///
/// # Errors
/// If there is no such name, or the level's parameters do not suit the model.
pub fn reference_model(link: &ReferenceLink, model: &str) -> Result<AnyModel, Failure> {
    let linear = ("stiffness", link.k_lin);
    let hertz = ("stiffness", link.k_hertz);
    let e = ("restitution", link.e);
    let (name, parameters) = match model {
        "linear" => ("linear_elastic", vec![linear]),
        "kv" | "kv_cut" => ("anagnostopoulos_2004", vec![linear, e]),
        "mj" => ("mahmoud_jankowski_2011", vec![linear, e]),
        "hertz" => ("hertz_1882", vec![hertz]),
        "hertzdamp" => ("muthukumar_desroches_2006", vec![hertz, e]),
        "jank" => ("jankowski_2005", vec![hertz, e]),
        "yeli" => ("ye_li_2009", vec![linear, e]),
        "papi" => ("papi_toopchi_2022", vec![linear, e]),
        "hunt" => ("hunt_crossley_1975", vec![hertz, e]),
        "flores" => ("flores_2011", vec![hertz, e]),
        "fricl" => ("borovin_2014", vec![linear, e, ("exponent", 1.0)]),
        "frich" => ("borovin_2014", vec![hertz, e, ("exponent", 1.5)]),
        other => return Err(format!("no model {other} in the reference data").into()),
    };
    let mut parameters = ModelParameters::from_pairs(&parameters);
    if model == "kv_cut" {
        parameters = parameters.with_separation(SeparationRule::NoTension);
    }
    Ok(registry::build(name, &parameters)?.into())
}
