//! Models calibrated alike: the same stiffness rule, the same restitution.

use std::sync::Arc;

use pounding_case::Gap;
use pounding_catalogue::Parameters;
use pounding_catalogue::numbers::{all_digits, six_digits};
use pounding_gap_element::{
    AchievedRestitution, GapElementError, ImpactModel, ModelDescriptor, ModelParameters,
    ParameterUnit, SeparationRule, registry,
};

use super::reference_collision::{CRUSHED, OwnLaw, ReferenceCollision, collision};
use super::stiffness::{StiffnessRule, stiffness};
use crate::gap_check::CheckError;

/// What a model is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RestitutionRule {
    /// The restitution, by the model's own relation, whatever that returns.
    AsPublished,
    /// Whatever makes the reference collision return the restitution exactly.
    Exact,
}

impl RestitutionRule {
    /// Name in arguments and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::AsPublished => "published",
            Self::Exact => "exact",
        }
    }
}

/// A model ready for one gap.
#[derive(Debug, Clone)]
pub struct CalibratedModel {
    /// The model's descriptor.
    pub descriptor: &'static ModelDescriptor,
    /// Its parameters (SI).
    pub parameters: ModelParameters,
    /// Restitution that it returns in the reference collision (-).
    pub free_restitution: f64,
    /// What else was done to it.
    pub notes: Vec<String>,
    /// The model.
    pub model: Arc<dyn ImpactModel>,
}

impl CalibratedModel {
    /// Whether it loses no energy: it is elastic whatever its parameters are, or with these.
    #[must_use]
    pub fn is_elastic(&self) -> bool {
        self.descriptor.achieved_restitution == AchievedRestitution::Elastic
            || (self.free_restitution - 1.0).abs() < ELASTIC
    }
}

/// Part of the approach velocity that a collision of an elastic law does not give back, as it was
/// integrated.
const ELASTIC: f64 = 1.0e-9;

/// Restitution of the free collision, by closed form where there is one.
fn achieved(
    model: &dyn ImpactModel,
    reference: &ReferenceCollision,
) -> Result<f64, GapElementError> {
    let (velocity, mass) = (reference.approach_velocity, reference.effective_mass);
    if let Some(closed) = model.closed_form(velocity, mass) {
        return Ok(closed.restitution);
    }
    Ok(collision(model, reference)?.restitution)
}

/// What damping is given by, instead of a restitution.
const RAW_DAMPING: [&str; 3] = ["damping_factor", "damping_ratio", "friction"];

/// Exponent of a law with these parameters; `None` for one without a stiffness.
fn exponent(descriptor: &ModelDescriptor, given: Option<f64>) -> Option<f64> {
    let parameters = descriptor.parameters;
    let stiffness = parameters.iter().find(|p| p.name == "stiffness")?;
    if stiffness.unit == ParameterUnit::NewtonPerMetre {
        return Some(1.0);
    }
    let free = parameters.iter().find(|p| p.name == "exponent");
    Some(free.map_or(1.5, |p| given.or(p.default).unwrap_or(1.5)))
}

/// Stiffness and exponent of the gap's own law at a level of the case.
pub(super) fn own_law(gap: &Gap, level: usize) -> Result<(f64, f64), CheckError> {
    let value = |key: &str| {
        let found = gap.parameters.iter().find(|p| p.key.value == key);
        found.and_then(|p| Some(p.at(level)?.value.value))
    };
    let law = registry::find(&gap.model.value)
        .ok()
        .and_then(|descriptor| {
            Some((
                value("stiffness")?,
                exponent(descriptor, value("exponent"))?,
            ))
        });
    law.ok_or_else(|| CheckError::Calibration {
        reason: format!(
            "{} of gap {} has no stiffness that others could be given",
            gap.model.value, gap.name
        ),
        help: "give the gap a model with a stiffness, such as exact_hunt_crossley",
    })
}

/// The gap's own law with all that the case says of it at a level.
pub(super) fn own_parameters(gap: &Gap, level: usize, gives_restitution: bool) -> Option<OwnLaw> {
    let descriptor = registry::find(&gap.model.value).ok()?;
    let values = gap.parameters.iter();
    let values = values.filter_map(|p| Some((p.key.value.clone(), p.at(level)?.value.value)));
    let rule = gap.separation.as_ref();
    let parameters = ModelParameters {
        parameters: Parameters {
            values: values.collect(),
        },
        separation: rule.and_then(|rule| SeparationRule::from_name(&rule.value)),
        spring: gap.spring.as_ref().map(|table| table.value.clone()),
    };
    Some(OwnLaw {
        model: descriptor.name,
        parameters,
        gives_restitution,
    })
}

/// Restitution of the gap's own law: the one asked for in the case, or what the law
/// returns in the reference collision.
pub(super) fn own_restitution(
    gap: &Gap,
    level: usize,
    model: &dyn ImpactModel,
    reference: &ReferenceCollision,
) -> Result<f64, CheckError> {
    let mut parameters = gap.parameters.iter();
    let given = parameters.find(|p| p.key.value == "restitution");
    if let Some(given) = given.and_then(|p| p.at(level)) {
        return Ok(given.value.value);
    }
    let found = achieved(model, reference).map_err(|e| CheckError::Calibration {
        reason: e.to_string(),
        help: "give --restitution",
    })?;
    if found <= 0.0 {
        return Err(CheckError::Calibration {
            reason: format!(
                "the law of gap {} returns nothing in the reference collision, and hardly any other can be asked for a restitution of 0",
                gap.name
            ),
            help: "give --restitution, above 0 and at most 1",
        });
    }
    // Of a law that loses nothing the collision returns 1 but for round-off, which no model could be asked for.
    Ok(match found > 1.0 && found < 1.0 + ROUND_OFF {
        true => 1.0,
        false => found,
    })
}

/// What the integration of a collision adds to a restitution of 1 at most.
const ROUND_OFF: f64 = 1.0e-9;

/// Calibrates a model for one gap.
///
/// # Errors
/// Why it cannot be, in words.
pub fn calibrated(
    descriptor: &'static ModelDescriptor,
    reference: &ReferenceCollision,
    rules: (StiffnessRule, RestitutionRule),
) -> Result<CalibratedModel, String> {
    let own = reference.own.as_ref();
    let own = own.filter(|own| own.model == descriptor.name);
    let as_in_the_case = own.is_some_and(|own| own.gives_restitution);
    let (parameters, notes) = match own {
        Some(own) => of_own_law(descriptor, own, reference),
        None => like_own_law(descriptor, reference, rules.0)?,
    };
    let text = |e: GapElementError| e.to_string();
    let asks = descriptor.takes_restitution();
    let model = registry::build(descriptor.name, &parameters).map_err(text)?;
    let free = achieved(model.as_ref(), reference).map_err(text)?;
    let mut calibrated = CalibratedModel {
        descriptor,
        parameters,
        free_restitution: free,
        notes,
        model: model.into(),
    };
    let wanted = reference.restitution;
    let damping = ["dissipation_time", "damping"]
        .into_iter()
        .find(|name| calibrated.parameters.values.contains_key(*name));
    if asks && rules.1 == RestitutionRule::Exact && (free - wanted).abs() > 1.0e-9 {
        exactly(&mut calibrated, reference)?;
    } else if let (false, Some(name), false) = (asks, damping, as_in_the_case) {
        calibrated.notes.retain(|n| !n.starts_with(name));
        damp(&mut calibrated, reference, name)?;
    } else if !asks && wanted != free {
        let note = format!("cannot be asked for a restitution, returns {free:.3}");
        calibrated.notes.push(note);
    }
    Ok(calibrated)
}

/// Parameters of the gap's own law: those of the case, but for a restitution that replaces its own.
fn of_own_law(
    descriptor: &'static ModelDescriptor,
    own: &OwnLaw,
    reference: &ReferenceCollision,
) -> (ModelParameters, Vec<String>) {
    let mut parameters = own.parameters.clone();
    let mut note = "the gap's own law, with its parameters in the case".to_owned();
    if own.gives_restitution {
        return (parameters, vec![note]);
    }
    let values = &mut parameters.values;
    if descriptor.takes_restitution() {
        values.retain(|name, _| !RAW_DAMPING.contains(&name.as_str()));
        values.insert("restitution".to_owned(), reference.restitution);
        note.push_str(", but for the restitution");
    } else if values.remove("damping_ratio_n_mm_s").is_some() {
        let damping = descriptor
            .example
            .iter()
            .find(|(name, _)| *name == "damping");
        values.extend(damping.map(|(name, value)| ((*name).to_owned(), *value)));
    }
    (parameters, vec![note])
}

/// Parameters of another model: a stiffness like that of the gap's own law, its restitution, and
/// what more the model needs from its example.
fn like_own_law(
    descriptor: &'static ModelDescriptor,
    reference: &ReferenceCollision,
    rule: StiffnessRule,
) -> Result<(ModelParameters, Vec<String>), String> {
    let mut parameters = ModelParameters::default();
    let mut notes = Vec::new();
    if let Some(n) = exponent(descriptor, None) {
        let value = stiffness(reference, rule, n)?;
        parameters.values.insert("stiffness".to_owned(), value);
    }
    if descriptor.takes_restitution() {
        let key = "restitution".to_owned();
        parameters.values.insert(key, reference.restitution);
    }
    for (name, value) in descriptor.example {
        let known = *name == "stiffness" || parameters.values.contains_key(*name);
        if !known && !CRUSHED.contains(name) {
            parameters.values.insert((*name).to_owned(), *value);
            notes.push(format!(
                "{name} = {} of the model's example",
                all_digits(*value)
            ));
        }
    }
    if descriptor
        .example
        .iter()
        .any(|(name, _)| CRUSHED.contains(name))
    {
        notes.push(format!(
            "without {}: those of the model's example belong to the stiffness of that bumper",
            CRUSHED.join(" and ")
        ));
    }
    if let Some(rule) = reference.separation {
        if descriptor.separation_rules.contains(&rule) {
            parameters.separation = Some(rule);
        } else {
            notes.push(format!(
                "does not offer the separation {} of the gap, ends contacts by {}",
                rule.name(),
                parameters.separation(descriptor).name()
            ));
        }
    }
    Ok((parameters, notes))
}

/// Finds the damping of a model that cannot be asked for a restitution: none for an elastic
/// collision, else about that of its example, or much less.
fn damp(
    calibrated: &mut CalibratedModel,
    reference: &ReferenceCollision,
    name: &str,
) -> Result<(), String> {
    if reference.restitution >= 1.0 {
        return undamped(calibrated, reference, name);
    }
    let example = calibrated.descriptor.example.iter();
    let example = example.filter(|(known, _)| *known == name);
    let about = example.map(|(_, value)| *value).next();
    let about = about.unwrap_or(calibrated.parameters.values[name]);
    solve(calibrated, reference, name, (1.0e-3 * about, 1.0e3 * about)).or_else(|reason| {
        let wide = (1.0e-12 * about, 1.0e6 * about);
        solve(calibrated, reference, name, wide).map_err(|_| reason)
    })
}

/// Takes the damping of a model that is to lose nothing.
fn undamped(
    calibrated: &mut CalibratedModel,
    reference: &ReferenceCollision,
    name: &str,
) -> Result<(), String> {
    calibrated.parameters.values.insert(name.to_owned(), 0.0);
    let model = registry::build(calibrated.descriptor.name, &calibrated.parameters)
        .map_err(|e| e.to_string())?;
    let returned = achieved(model.as_ref(), reference).map_err(|e| e.to_string())?;
    if (returned - 1.0).abs() > ELASTIC {
        return Err(format!(
            "no {name} returns 1: the reference collision returns {returned:.4} with {name} = 0"
        ));
    }
    calibrated.free_restitution = returned;
    calibrated.model = model.into();
    let note = format!("{name} = 0, so that the reference collision returns 1");
    calibrated.notes.push(note);
    Ok(())
}

/// Makes the reference collision return what is wanted: by asking for another
/// restitution, or, where the model's relation never leads there, by its damping.
fn exactly(calibrated: &mut CalibratedModel, reference: &ReferenceCollision) -> Result<(), String> {
    let Err(reason) = solve(calibrated, reference, "restitution", (1.0e-3, 1.0)) else {
        return Ok(());
    };
    let parameters = calibrated.descriptor.parameters;
    let known = |name: &&str| parameters.iter().any(|p| p.name == *name);
    let Some(raw) = RAW_DAMPING.into_iter().find(known) else {
        return Err(reason);
    };
    for replaced in ["restitution", "alpha"] {
        calibrated.parameters.values.remove(replaced);
    }
    if reference.restitution >= 1.0 {
        return undamped(calibrated, reference, raw).map_err(|other| format!("{reason}; {other}"));
    }
    let maximum = if raw == "friction" { 0.999 } else { 1.0e3 };
    solve(calibrated, reference, raw, (1.0e-6, maximum))
        .map_err(|other| format!("{reason}; {other}"))
}

/// Finds the parameter with which the reference collision returns what is wanted, by
/// bisection of its logarithm.
fn solve(
    calibrated: &mut CalibratedModel,
    reference: &ReferenceCollision,
    parameter: &str,
    range: (f64, f64),
) -> Result<(), String> {
    let descriptor = calibrated.descriptor;
    let at = |value: f64| -> Result<(ModelParameters, Arc<dyn ImpactModel>, f64), String> {
        let mut parameters = calibrated.parameters.clone();
        parameters.values.insert(parameter.to_owned(), value);
        let model = registry::build(descriptor.name, &parameters).map_err(|e| e.to_string())?;
        let free = achieved(model.as_ref(), reference).map_err(|e| e.to_string())?;
        Ok((parameters, model.into(), free))
    };
    let wanted = reference.restitution;
    // An end where the collision never ends is as good as one that returns nothing.
    let returned = |value: f64| at(value).map_or(0.0, |r| r.2);
    let (mut low, mut high) = range;
    let (first, last) = (returned(low), returned(high));
    if (first - wanted) * (last - wanted) > 0.0 {
        let (least, most) = (first.min(last), first.max(last));
        return Err(format!(
            "no {parameter} returns {wanted}: the reference collision returns {least:.4} to {most:.4}"
        ));
    }
    let rising = last > first;
    for _ in 0..60 {
        let middle = (low * high).sqrt();
        if (returned(middle) < wanted) == rising {
            low = middle;
        } else {
            high = middle;
        }
    }
    let (parameters, model, free) = at((low * high).sqrt())?;
    if (free - wanted).abs() > 1.0e-6 {
        return Err(format!(
            "no {parameter} returns {wanted}: the restitution jumps to {free:.4} at {}",
            six_digits((low * high).sqrt())
        ));
    }
    calibrated.notes.push(format!(
        "{parameter} = {} found so that the reference collision returns {wanted}",
        six_digits(parameters.values[parameter])
    ));
    calibrated.parameters = parameters;
    calibrated.model = model;
    calibrated.free_restitution = free;
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn reference(exponent: f64, stiffness: f64) -> ReferenceCollision {
        ReferenceCollision {
            approach_velocity: 0.6,
            of_other_gaps: false,
            effective_mass: 24_390.0,
            stiffness,
            exponent,
            restitution: 0.65,
            separation: None,
            own: None,
        }
    }

    /// Exact: what the reference collision returns is what was asked for, checked by
    /// integrating it. As published: the numbers of the papers' relations.
    #[test]
    fn exact_and_published() {
        let from = reference(1.5, 2.75e9);
        let rules = |r| (StiffnessRule::Penetration, r);
        for (name, published) in [("jankowski_2005", 0.6470), ("anagnostopoulos_2004", 0.65)] {
            let descriptor = registry::find(name).unwrap();
            let as_published =
                calibrated(descriptor, &from, rules(RestitutionRule::AsPublished)).unwrap();
            assert!(
                (as_published.free_restitution - published).abs() < 5.0e-5,
                "{name}"
            );
            let exact = calibrated(descriptor, &from, rules(RestitutionRule::Exact)).unwrap();
            let collided = collision(exact.model.as_ref(), &from).unwrap();
            assert!((collided.restitution - 0.65).abs() < 1.0e-6, "{name}");
        }
    }

    /// Where the relation never leads to an elastic collision, the damping is left out.
    #[test]
    fn nothing_is_lost_without_damping() {
        let from = ReferenceCollision {
            restitution: 1.0,
            ..reference(1.5, 2.75e9)
        };
        let rules = (StiffnessRule::Penetration, RestitutionRule::Exact);
        let descriptor = registry::find("gharib_hurmuzlu_2012").unwrap();
        let elastic = calibrated(descriptor, &from, rules).unwrap();
        assert_eq!(elastic.parameters.values["damping_factor"], 0.0);
        assert!(!elastic.parameters.values.contains_key("restitution"));
        let collided = collision(elastic.model.as_ref(), &from).unwrap();
        assert!((collided.restitution - 1.0).abs() < 1.0e-9);
        // Its friction is not all that it loses by.
        let descriptor = registry::find("lapshin_yurin_2016").unwrap();
        let refused = calibrated(descriptor, &from, rules).unwrap_err();
        assert!(refused.contains("no friction returns 1"), "{refused}");
    }

    /// Every model of the registry returns exactly what is asked for, but those without
    /// damping, and the bilinear element: asked for e it returns sqrt((1 - c) / (1 + c)) with
    /// c = (1 - e^2) / 2.5, at least sqrt(0.6 / 1.4) = 0.6547.
    #[test]
    fn every_model() {
        let from = reference(1.5, 2.75e9);
        let mut others = Vec::new();
        for descriptor in registry::descriptors() {
            let rules = (StiffnessRule::Penetration, RestitutionRule::Exact);
            let calibrated = calibrated(descriptor, &from, rules);
            match calibrated {
                Ok(c) if (c.free_restitution - 0.65).abs() < 1.0e-6 => {}
                Ok(c) => others.push(format!("{} {:.3}", descriptor.name, c.free_restitution)),
                Err(reason) => others.push(format!("{}: {reason}", descriptor.name)),
            }
        }
        let bilinear = "muthukumar_2003: no restitution returns 0.65: the reference collision returns 0.6547 to 1.0000";
        assert_eq!(
            others,
            ["linear_elastic 1.000", "hertz_1882 1.000", bilinear]
        );
    }
}
