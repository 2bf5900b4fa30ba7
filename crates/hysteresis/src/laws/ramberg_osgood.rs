//! Ramberg and Osgood's rounded backbone with Masing's rule.

use crate::descriptor::{LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::law::HysteresisLaw;
use crate::masing::{Backbone, Masing};
use crate::parameters::{LawParameters, STIFFNESS, YIELD_FORCE, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "ramberg_osgood",
    aliases: &[],
    title: "Ramberg-Osgood",
    formula: "x / xy = F / Fy + alpha (F / Fy)^n,  xy = Fy / k; loops by Masing's rule",
    citation: "Ramberg and Osgood, NACA Technical Note 902 (1943); Jennings, Journal of the Engineering Mechanics Division 90 (1964) 131: loops by Masing's rule",
    parameters: &[
        STIFFNESS,
        YIELD_FORCE,
        positive(
            "alpha",
            ParameterUnit::One,
            "Plastic over yield deformation at the yield force",
        )
        .default_to(1.0),
        positive(
            "exponent",
            ParameterUnit::One,
            "Exponent n, above 1: the greater, the sharper the knee",
        )
        .within((1.0, false), (100.0, true)),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified(
        "backbone inverted; closed form of the cycle dissipation; quadrature of the loop",
    ),
    example: &[
        ("stiffness", 2.0e7),
        ("yield_force", 2.0e5),
        ("alpha", 0.5),
        ("exponent", 7.0),
    ],
    example_amplitude: 0.03,
    traps: &["The stiffness is never zero: the yield force is not a bound."],
    build,
};

#[derive(Debug)]
struct RambergOsgood {
    yield_force: f64,
    yield_deformation: f64,
    alpha: f64,
    exponent: f64,
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let yield_force = get("yield_force")?;
    Ok(Box::new(Masing {
        backbone: RambergOsgood {
            yield_force,
            yield_deformation: yield_force / get("stiffness")?,
            alpha: get("alpha")?,
            exponent: get("exponent")?,
        },
    }))
}

impl RambergOsgood {
    /// Force over yield force. Newton's iteration from above on a convex function
    /// falls monotonically onto the root; it ends where it no longer falls.
    fn force_ratio(&self, deformation: f64) -> f64 {
        let target = deformation / self.yield_deformation;
        let mut ratio = target.min(libm::pow(target / self.alpha, 1.0 / self.exponent));
        if !(ratio > 0.0) {
            return ratio;
        }
        loop {
            let plastic = self.alpha * libm::pow(ratio, self.exponent - 1.0);
            let next = ratio - (ratio + plastic * ratio - target) / (1.0 + self.exponent * plastic);
            if !(next < ratio) {
                return ratio;
            }
            ratio = next;
        }
    }

    fn energy(&self) -> f64 {
        self.yield_force * self.yield_deformation
    }
}

impl Backbone for RambergOsgood {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        &DESCRIPTOR
    }
    fn corners(&self) -> &[f64] {
        &[]
    }
    fn force(&self, _: usize, deformation: f64) -> (f64, f64) {
        let ratio = self.force_ratio(deformation);
        let plastic = self.alpha * libm::pow(ratio, self.exponent - 1.0);
        let stiffness = self.yield_force / self.yield_deformation;
        (
            self.yield_force * ratio,
            stiffness / (1.0 + self.exponent * plastic),
        )
    }
    fn slip_work(&self, deformation: f64) -> f64 {
        let n = self.exponent;
        let ratio = self.force_ratio(deformation);
        self.energy() * self.alpha * libm::pow(ratio, n + 1.0) * (n - 1.0) / (n + 1.0)
    }
    fn stored(&self, deformation: f64) -> f64 {
        // int F dx less the slip work.
        let n = self.exponent;
        let ratio = self.force_ratio(deformation);
        self.energy() * (0.5 * ratio * ratio + self.alpha * libm::pow(ratio, n + 1.0) / (n + 1.0))
    }
}
