//! A contact with an elastic spring behind it, such as a column that is hit.
//!
//! Contact and spring carry the same force `F`, and their deformations add up to the
//! penetration `x` that the floors have by themselves: `x = delta + F / K`, `F = k delta^n`.
//! That grows with `delta`, so that it has one solution. The linear law is one of
//! `1 / (1/k + 1/K)`; for others Newton's iteration from above finds `delta`, on a convex
//! function and hence without overshoot. Laws that dissipate would need the rate of `delta`,
//! which is a state of its own: they are refused.

use std::sync::Arc;

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::{
    ClosedForm, Collision, Force, ImpactModel, Memory, Phase, PowerLaw, SeparationRule, Target,
    Transition,
};

/// An elastic law `k delta^n` in series with a spring (N/m).
#[derive(Debug)]
struct InSeries {
    model: Arc<dyn ImpactModel>,
    contact: PowerLaw,
    spring: f64,
}

/// Newton's steps at most: the number of correct digits doubles in each.
const STEPS: usize = 60;

/// The law with a spring of this stiffness (N/m) behind it. Penetrations are then those of
/// both together.
///
/// # Errors
/// A law that is not elastic, and a stiffness that is not above zero.
pub fn in_series(
    model: Arc<dyn ImpactModel>,
    spring: f64,
) -> Result<Arc<dyn ImpactModel>, GapElementError> {
    let name = model.descriptor().name;
    if !(spring.is_finite() && spring > 0.0) {
        return Err(GapElementError::Series {
            model: name,
            reason: format!("the spring has a stiffness of {spring} N/m"),
        });
    }
    let law = match model.rigid_restitution() {
        None => one_law(model.as_ref()),
        Some(_) => None,
    };
    match law {
        Some(contact) if contact.dashpot == 0.0 && contact.exponent >= 1.0 => {
            Ok(Arc::new(InSeries {
                model,
                contact,
                spring,
            }))
        }
        _ => Err(GapElementError::Series {
            model: name,
            reason: "it is not elastic, and a point without mass between contact and spring would have a motion of its own".to_owned(),
        }),
    }
}

/// The law in powers that a model has in all phases in which floors act on one another; dry friction,
/// and branches that unload otherwise than they load, are other laws.
fn one_law(model: &dyn ImpactModel) -> Option<PowerLaw> {
    let collision = model.begin(1.0, 1.0);
    let law = model.power_law(&collision, Phase::Approach)?;
    let mut phases = vec![Phase::Approach, Phase::Restitution];
    let mut seen = 0;
    while let Some(phase) = phases.get(seen).copied() {
        seen += 1;
        if model.power_law(&collision, phase) != Some(law) {
            return None;
        }
        for transition in model.transitions(phase) {
            match transition.target {
                Target::Phase(Phase::Released | Phase::Stuck) => {}
                Target::Phase(next) if !phases.contains(&next) => phases.push(next),
                _ => {}
            }
        }
    }
    Some(law)
}

impl InSeries {
    fn is_linear(&self) -> bool {
        self.contact.exponent == 1.0
    }

    /// Stiffness (N/m) of contact and spring, of a linear law.
    fn linear_stiffness(&self) -> f64 {
        1.0 / (1.0 / self.contact.stiffness + 1.0 / self.spring)
    }

    /// Deformation of the contact alone (m) at a positive penetration of both (m).
    fn of_contact(&self, penetration: f64) -> f64 {
        let PowerLaw {
            stiffness,
            exponent: n,
            ..
        } = self.contact;
        let ratio = stiffness / self.spring;
        // Each term alone bounds the root from above.
        let mut delta = penetration.min(libm::pow(penetration / ratio, 1.0 / n));
        for _ in 0..STEPS {
            let power = ratio * libm::pow(delta, n - 1.0);
            let step = (delta + power * delta - penetration) / (1.0 + n * power);
            let next = delta - step;
            if !(next < delta) {
                break;
            }
            delta = next;
        }
        delta
    }

    /// Force (N) and its derivative (N/m).
    fn elastic(&self, penetration: f64) -> (f64, f64) {
        if self.is_linear() {
            let stiffness = self.linear_stiffness();
            return (stiffness * penetration, stiffness);
        }
        if penetration <= 0.0 {
            return (0.0, 0.0);
        }
        let delta = self.of_contact(penetration);
        let slope = self.contact.stiffness * libm::pow(delta, self.contact.exponent - 1.0);
        let own = self.contact.exponent * slope;
        (slope * delta, own * self.spring / (own + self.spring))
    }

    /// Energy (J) in contact and spring.
    fn energy(&self, penetration: f64) -> f64 {
        let (force, _) = self.elastic(penetration);
        if self.is_linear() {
            return 0.5 * force * penetration;
        }
        if penetration <= 0.0 {
            return 0.0;
        }
        let delta = self.of_contact(penetration);
        force * delta / (self.contact.exponent + 1.0) + 0.5 * force * force / self.spring
    }

    /// Penetration (m) at which it holds so much energy (J): the root of a convex function.
    fn penetration_of(&self, energy: f64) -> f64 {
        // All of it in the contact, or all in the spring.
        let n = self.contact.exponent;
        let contact = libm::pow((n + 1.0) * energy / self.contact.stiffness, 1.0 / (n + 1.0));
        let mut x = contact + (2.0 * energy / self.spring).sqrt();
        for _ in 0..STEPS {
            let next = x - (self.energy(x) - energy) / self.elastic(x).0;
            if !(next < x) {
                break;
            }
            x = next;
        }
        x
    }
}

impl ImpactModel for InSeries {
    fn descriptor(&self) -> &'static ModelDescriptor {
        self.model.descriptor()
    }

    fn separation(&self) -> SeparationRule {
        self.model.separation()
    }

    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        self.model.begin(approach_velocity, effective_mass)
    }

    fn force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, _: f64) -> Force {
        let (value, by_penetration) = self.elastic(delta);
        Force {
            value,
            by_penetration,
            by_velocity: 0.0,
        }
    }

    fn is_affine(&self, _: &Collision, _: Phase) -> bool {
        self.is_linear()
    }

    fn power_law(&self, _: &Collision, _: Phase) -> Option<PowerLaw> {
        self.is_linear().then(|| PowerLaw {
            stiffness: self.linear_stiffness(),
            ..self.contact
        })
    }

    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        self.energy(delta)
    }

    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        self.model.transitions(phase)
    }

    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let energy = 0.5 * effective_mass * approach_velocity * approach_velocity;
        let peak = self.penetration_of(energy);
        let half_wave = || std::f64::consts::PI * (effective_mass / self.linear_stiffness()).sqrt();
        Some(ClosedForm {
            restitution: 1.0,
            peak_penetration: Some(peak),
            peak_force: Some(self.elastic(peak).0),
            duration: self.is_linear().then(half_wave),
        })
    }

    fn smooth_at_closure(&self) -> bool {
        self.model.smooth_at_closure()
    }

    fn spring_behind(&self) -> Option<f64> {
        Some(self.spring)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bodies, ModelParameters, collide, registry};

    fn model(name: &str, given: &[(&str, f64)]) -> Arc<dyn ImpactModel> {
        let built = registry::build(name, &ModelParameters::from_pairs(given));
        built.unwrap().into()
    }

    fn force(law: &dyn ImpactModel, x: f64) -> Force {
        let collision = law.begin(1.0, 1.0);
        law.force(&collision, &Memory::default(), Phase::Approach, x, 0.0)
    }

    /// Both deformations add up, the derivative is that of the force, and the energy its
    /// integral, from contacts far stiffer than the spring to far softer ones.
    #[test]
    fn contact_and_spring_carry_one_force() {
        for (name, stiffness, exponent) in [
            ("linear_elastic", 3.74e8, 1.0),
            ("hertz_1882", 2.75e9, 1.5),
            ("hertz_1882", 1.0e15, 1.5),
            ("hertz_1882", 1.0e5, 1.5),
        ] {
            let spring = 1.8e9;
            let law = in_series(model(name, &[("stiffness", stiffness)]), spring).unwrap();
            let collision = law.begin(1.0, 1.0);
            let energy =
                |x: f64| law.stored_energy(&collision, &Memory::default(), Phase::Approach, x);
            for x in [1e-12, 1e-6, 1e-3, 0.02, 0.5] {
                let Force {
                    value,
                    by_penetration,
                    ..
                } = force(law.as_ref(), x);
                let delta = libm::pow(value / stiffness, 1.0 / exponent);
                let error = (delta + value / spring - x).abs();
                assert!(error < 2e-15 * x, "{name} {stiffness} {x}: {error:e}");
                let h = 1e-4 * x;
                let [up, down] = [x + h, x - h].map(|x| force(law.as_ref(), x).value);
                let slope = (up - down) / (2.0 * h);
                assert!((by_penetration / slope - 1.0).abs() < 1e-7, "{name} {x}");
                let power = (energy(x + h) - energy(x - h)) / (2.0 * h);
                assert!((value / power - 1.0).abs() < 1e-7, "{name} {x}");
            }
            assert_eq!(law.spring_behind(), Some(spring));
        }
    }

    #[test]
    fn a_rigid_spring_leaves_the_contact_as_it_is() {
        for (name, stiffness) in [("linear_elastic", 3.74e8), ("hertz_1882", 2.75e9)] {
            let alone = model(name, &[("stiffness", stiffness)]);
            let law = in_series(Arc::clone(&alone), 1e22).unwrap();
            for x in [1e-5, 1e-3, 0.02] {
                let (found, expected) = (force(law.as_ref(), x), force(alone.as_ref(), x));
                assert!((found.value / expected.value - 1.0).abs() < 1e-10);
                assert!((found.by_penetration / expected.by_penetration - 1.0).abs() < 1e-10);
            }
        }
    }

    /// The free collision, integrated, has the closed form.
    #[test]
    fn a_free_collision_keeps_its_energy() {
        for (name, stiffness) in [("linear_elastic", 3.74e8), ("hertz_1882", 2.75e9)] {
            let law = in_series(model(name, &[("stiffness", stiffness)]), 6e8).unwrap();
            let bodies = Bodies {
                mass_left: 40_000.0,
                mass_right: None,
                velocity_left: 0.7,
                velocity_right: 0.0,
            };
            let found = collide(law.as_ref(), &bodies).unwrap();
            let expected = law.closed_form(0.7, 40_000.0).unwrap();
            let peak = expected.peak_penetration.unwrap();
            assert!((found.peak_penetration / peak - 1.0).abs() < 1e-8, "{name}");
            assert!((found.restitution - 1.0).abs() < 1e-8, "{name}");
            if let Some(duration) = expected.duration {
                assert!((found.duration / duration - 1.0).abs() < 1e-8, "{name}");
            }
        }
    }

    #[test]
    fn laws_that_dissipate_are_refused() {
        for (name, stiffness) in [
            ("anagnostopoulos_2004", 9.35e7),
            ("jankowski_2005", 2.75e9),
            ("lankarani_nikravesh_1990", 2.75e9),
        ] {
            let given = [("stiffness", stiffness), ("restitution", 0.65)];
            let refused = in_series(model(name, &given), 1e9).unwrap_err();
            assert!(refused.to_string().contains("not elastic"), "{refused}");
            assert!(refused.help().unwrap().contains("linear_elastic"));
        }
        // Dry friction alone, in powers or linear.
        for (name, exponent) in [
            ("borovin_2014", 1.0),
            ("borovin_2014", 1.5),
            ("lapshin_yurin_2016", 1.5),
        ] {
            let given = [
                ("stiffness", 3e8),
                ("exponent", exponent),
                ("restitution", 0.6),
            ];
            let known = registry::find(name).unwrap().parameters;
            let given: Vec<_> = given
                .into_iter()
                .filter(|(key, _)| known.iter().any(|p| p.name == *key))
                .collect();
            let law = model(name, &given);
            assert_eq!(
                law.power_law(&law.begin(1.0, 1.0), Phase::Approach)
                    .unwrap()
                    .dashpot,
                0.0
            );
            let refused = in_series(law, 1e9).unwrap_err();
            assert!(refused.to_string().contains("not elastic"), "{refused}");
        }
        let rigid = model("stereomechanical", &[("restitution", 1.0)]);
        assert!(in_series(rigid, 1e9).is_err());
        let elastic = model("linear_elastic", &[("stiffness", 1e8)]);
        for spring in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(in_series(Arc::clone(&elastic), spring).is_err());
        }
    }
}
