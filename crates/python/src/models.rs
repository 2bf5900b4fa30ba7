//! Impact models, and the collision of two bodies.

use numpy::IntoPyArray;
use pounding_assembly::parameter_dimension;
use pounding_case::Dimension;
use pounding_cli::Failure;
use pounding_cli::answers::DescribedModel;
use pounding_gap_element::{
    Bodies, CollisionSample, ModelDescriptor, ModelParameters, SeparationRule,
    collide as collision, registry,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::Problem;
use crate::values::{above_zero, json, optional, quantity};

/// Descriptors of all impact models, or of one, as JSON: what `pounding models --json` prints.
#[pyfunction]
#[pyo3(signature = (name=None))]
fn models_json(name: Option<&str>) -> Result<String, Problem> {
    let chosen = match name {
        Some(name) => vec![registry::find(name).map_err(Failure::from)?],
        None => registry::descriptors().to_vec(),
    };
    let described: Vec<_> = chosen.iter().map(|d| DescribedModel::of(d)).collect();
    json(&described)
}

/// Values (SI) of parameters of a model by their names; one that the model does not have is left to it.
fn values<'p>(
    descriptor: &ModelDescriptor,
    parameters: &'p [(String, Bound<'_, PyAny>)],
) -> PyResult<Vec<(&'p str, f64)>> {
    let free = parameters.iter().find(|(name, _)| name == "exponent");
    // The unit of the stiffness depends on it.
    let exponent = optional(free.map(|(_, e)| e), "exponent", Dimension::NUMBER)?;
    let value = |(name, value): &'p (String, Bound<'_, PyAny>)| {
        let mut known = descriptor.parameters.iter();
        let value = match known.find(|parameter| parameter.name == name) {
            Some(parameter) => {
                let wanted = parameter_dimension(descriptor, parameter, exponent);
                quantity(value, name, wanted)?
            }
            // Told below, whatever its unit.
            None => f64::NAN,
        };
        Ok((name.as_str(), value))
    };
    parameters.iter().map(value).collect()
}

/// Two bodies collide: numbers and arrays by name. Without the mass of the right one it is a
/// wall.
#[pyfunction]
#[pyo3(signature = (model, parameters, mass_left, mass_right, velocity_left, velocity_right, separation=None, spring=None))]
#[expect(clippy::too_many_arguments, reason = "keywords of Python")]
fn collide<'py>(
    py: Python<'py>,
    model: &str,
    parameters: Vec<(String, Bound<'py, PyAny>)>,
    mass_left: &Bound<'py, PyAny>,
    mass_right: Option<&Bound<'py, PyAny>>,
    velocity_left: &Bound<'py, PyAny>,
    velocity_right: &Bound<'py, PyAny>,
    separation: Option<&str>,
    spring: Option<Vec<(Bound<'py, PyAny>, Bound<'py, PyAny>)>>,
) -> PyResult<Bound<'py, PyDict>> {
    let refused = |e| Problem::from(Failure::from(e));
    let descriptor = registry::find(model).map_err(refused)?;
    let mass = |value, name| above_zero(value, name, Dimension::MASS);
    let bodies = Bodies {
        mass_left: mass(mass_left, "mass_left")?,
        mass_right: mass_right.map(|m| mass(m, "mass_right")).transpose()?,
        velocity_left: quantity(velocity_left, "velocity_left", Dimension::VELOCITY)?,
        velocity_right: quantity(velocity_right, "velocity_right", Dimension::VELOCITY)?,
    };
    if bodies.mass_right.is_none() && bodies.velocity_right != 0.0 {
        let message = format!(
            "velocity_right is {} m/s, but the right body is a rigid wall",
            bodies.velocity_right
        );
        let help = "leave velocity_right out, or give the right body a mass with mass_right";
        return Err(Problem::from(Failure::input(message, Some(help.to_owned()))).into());
    }
    let values = values(descriptor, &parameters)?;
    let pairs: Vec<_> = values.iter().map(|(n, v)| (*n, *v)).collect();
    let mut given = ModelParameters::from_pairs(&pairs);
    if let Some(name) = separation {
        let rule = SeparationRule::ALL.into_iter().find(|r| r.name() == name);
        let Some(rule) = rule else {
            let names = descriptor.separation_rules.iter().map(|r| r.name());
            let names: Vec<_> = names.collect();
            let message = format!("\"{name}\" is no separation rule");
            let help = format!("{model} has {}", names.join(", "));
            return Err(Problem::from(Failure::input(message, Some(help))).into());
        };
        given = given.with_separation(rule);
    }
    let point = |(d, f): &(Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let d = quantity(d, "a penetration of spring", Dimension::LENGTH)?;
        Ok::<_, PyErr>((d, quantity(f, "a force of spring", Dimension::FORCE)?))
    };
    given.spring = spring
        .map(|points| points.iter().map(point).collect::<PyResult<_>>())
        .transpose()?;
    let model = registry::build(descriptor.name, &given).map_err(refused)?;
    let outcome = collision(model.as_ref(), &bodies).map_err(refused)?;
    let answer = PyDict::new(py);
    for (name, value) in [
        ("restitution", outcome.restitution),
        ("velocity_left", outcome.velocity_left),
        ("velocity_right", outcome.velocity_right),
        ("peak_force", outcome.peak_force),
        ("peak_force_time", outcome.peak_force_time),
        ("peak_penetration", outcome.peak_penetration),
        ("peak_penetration_time", outcome.peak_penetration_time),
        ("duration", outcome.duration),
        ("impulse", outcome.impulse),
        ("energy_dissipated", outcome.energy_dissipated),
    ] {
        answer.set_item(name, value)?;
    }
    type Pick = fn(&CollisionSample) -> f64;
    let columns: [(&str, Pick); 4] = [
        ("time", |s| s.time),
        ("penetration", |s| s.penetration),
        ("velocity", |s| s.velocity),
        ("force", |s| s.force),
    ];
    for (name, column) in columns {
        let values: Vec<f64> = outcome.history.iter().map(column).collect();
        answer.set_item(name, values.into_pyarray(py))?;
    }
    Ok(answer)
}

/// Adds the functions of this file.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_function(wrap_pyfunction!(models_json, module)?)?;
    module.add_function(wrap_pyfunction!(collide, module)?)
}
