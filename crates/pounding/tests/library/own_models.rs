//! Impact models of one's own that cannot be.

use std::sync::Arc;

use pounding::gap_element::{
    ClosedForm, Collision, Force, ImpactModel, Memory, ModelDescriptor, Phase, SeparationRule,
    Transition, registry,
};
use pounding::prelude::*;
use pounding::time_history::TimeHistoryError;

use crate::refused;

/// A spring and a dashpot, with a factor of the force, or jumps of the velocity.
#[derive(Debug)]
struct Own {
    sign: f64,
    restitution: Option<f64>,
}

impl ImpactModel for Own {
    fn descriptor(&self) -> &'static ModelDescriptor {
        registry::find("anagnostopoulos_2004").unwrap()
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        Collision {
            approach_velocity,
            effective_mass,
            ..Collision::default()
        }
    }
    fn force(&self, _: &Collision, _: &Memory, _: Phase, delta: f64, velocity: f64) -> Force {
        let (k, c) = (9.35e7, 3e5);
        Force {
            value: self.sign * (k * delta + c * velocity),
            by_penetration: self.sign * k,
            by_velocity: self.sign * c,
        }
    }
    fn stored_energy(&self, _: &Collision, _: &Memory, _: Phase, delta: f64) -> f64 {
        0.5 * 9.35e7 * delta * delta
    }
    fn transitions(&self, _: Phase) -> &'static [Transition] {
        &[]
    }
    fn rigid_restitution(&self) -> Option<f64> {
        self.restitution
    }
    fn closed_form(&self, _: f64, _: f64) -> Option<ClosedForm> {
        None
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}

fn pair(model: Own) -> Simulation {
    let of = |name, mass, stiffness| {
        Building::shear(name)
            .storey(crate::storey(mass, stiffness))
            .damping(Damping::StiffnessProportional { ratio: 0.05 })
    };
    let gap = Gap::between("a", "b")
        .width(Length::millimetres(10.0))
        .impact_model(Arc::new(model));
    let sine = (0..600).map(|i| {
        let phase = std::f64::consts::TAU * 1.2 * 0.01 * f64::from(i);
        Acceleration::metres_per_second_squared(3.0 * phase.sin())
    });
    let motion = GroundMotion::of(sine, Time::seconds(0.01)).unwrap();
    Simulation::of([of("a", 25.0, 1.5), of("b", 40.0, 6.0)])
        .gap(gap)
        .ground_motion(motion)
        .duration(Time::seconds(6.0))
}

#[test]
fn a_restitution_that_is_none_is_refused() {
    for e in [f64::NAN, f64::INFINITY, -0.5, 1.5] {
        let own = Own {
            sign: 1.0,
            restitution: Some(e),
        };
        let (said, help) = refused(&pair(own));
        assert!(help.contains("rigid_restitution"), "{help}");
        assert!(
            said.contains("gap a-b") && said.contains(&format!("is {e};")),
            "{said}"
        );
    }
    for e in [0.0, 0.6, 1.0] {
        let own = Own {
            sign: 1.0,
            restitution: Some(e),
        };
        assert!(pair(own).build().is_ok());
    }
}

/// A force that pulls where it should push ends the run with its place, soon after the contact.
#[test]
fn a_wrong_sign_ends_the_run() {
    let relative_tolerance = 1e-10;
    for method in [
        MethodChoice::EventDriven { relative_tolerance },
        MethodChoice::Adaptive { relative_tolerance },
        MethodChoice::RungeKutta4 { step: 1e-4 },
        MethodChoice::Newmark {
            step: 1e-4,
            beta: 0.25,
            gamma: 0.5,
        },
    ] {
        let own = |sign| Own {
            sign,
            restitution: None,
        };
        let error = pair(own(-1.0)).method(method).run().unwrap_err();
        let honest = pair(own(1.0)).method(method).run().unwrap();
        assert!(honest.gaps[0].levels[0].impacts > 0);
        if matches!(
            method,
            MethodChoice::RungeKutta4 { .. } | MethodChoice::Newmark { .. }
        ) {
            // A fixed step that is too long drives the motion, too: it is not said of the model.
            continue;
        }
        let Error::Run(TimeHistoryError::ContactGivesEnergy { time, place, .. }) = &error else {
            panic!("{method:?}: {error}");
        };
        assert!(place.starts_with("a-b level 1-1"), "{place}");
        assert!((0.0..3.0).contains(time), "{time}");
        assert!(error.help().is_some_and(|help| help.contains("signs")));
    }
}
