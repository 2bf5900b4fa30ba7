//! Iwan's model with a truncated power density, a lump of sliders and a residual spring.

use crate::descriptor::{LawDescriptor, ParameterUnit, Verification};
use crate::error::HysteresisError;
use crate::iwan::IwanDensity;
use crate::law::HysteresisLaw;
use crate::masing::{Backbone, Masing};
use crate::parameters::{LawParameters, non_negative, positive};

pub(crate) static DESCRIPTOR: LawDescriptor = LawDescriptor {
    name: "iwan_six_parameter",
    aliases: &[],
    title: "Iwan model with six parameters",
    formula: "rho(phi) = R phi^alpha on [phi_1, phi_2] + K2 delta(phi - phi_2), beside a spring Kinf; F(x) = int_0^x phi rho dphi + x int_x^inf rho dphi, loops by Masing's rule",
    citation: "Iwan, Journal of Applied Mechanics 33 (1966) 893; the truncated power density with a lump and a residual spring after Segalman (2005) and Song et al. (2004)",
    parameters: &[
        non_negative(
            "density",
            ParameterUnit::NewtonPerMetreToTwoPlusExponent,
            "Factor R of the power density of sliders",
        ),
        positive(
            "exponent",
            ParameterUnit::One,
            "Exponent alpha of the density, above -1",
        )
        .within((-1.0, false), (f64::INFINITY, false)),
        non_negative(
            "phi_1",
            ParameterUnit::Metre,
            "Deformation at which the first slider slips, below phi_2",
        )
        .default_to(0.0),
        positive(
            "phi_2",
            ParameterUnit::Metre,
            "Deformation at which the last slider slips",
        ),
        non_negative(
            "slider_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Stiffness K2 of the sliders that slip together at phi_2",
        )
        .default_to(0.0),
        non_negative(
            "residual_stiffness",
            ParameterUnit::NewtonPerMetre,
            "Stiffness Kinf that never slips",
        )
        .default_to(0.0),
    ],
    rate_dependent: false,
    link_alone: None,
    verification: Verification::Verified(
        "closed forms against quadrature of the density and the tabulated example; 20 000 discrete sliders",
    ),
    example: &[
        ("density", 2.0e6),
        ("exponent", -0.3),
        ("phi_1", 1.0e-5),
        ("phi_2", 1.0e-4),
        ("slider_stiffness", 3.0e3),
        ("residual_stiffness", 1.0e3),
    ],
    example_amplitude: 2.5e-4,
    traps: &[
        "The unit of the density depends on the exponent.",
        "The slope drops by the slider stiffness at phi_2.",
    ],
    build,
};

/// A density with the descriptor under which it was built.
#[derive(Debug)]
pub(super) struct IwanBackbone {
    descriptor: &'static LawDescriptor,
    density: IwanDensity,
    corners: [f64; 2],
}

/// The law of a density.
pub(super) fn law(
    descriptor: &'static LawDescriptor,
    density: IwanDensity,
) -> Box<dyn HysteresisLaw> {
    Box::new(Masing {
        backbone: IwanBackbone {
            descriptor,
            density,
            corners: [density.phi_1, density.phi_2],
        },
    })
}

fn build(parameters: &LawParameters) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    let get = |name| parameters.get(&DESCRIPTOR, name);
    let density = IwanDensity {
        density: get("density")?,
        exponent: get("exponent")?,
        phi_1: get("phi_1")?,
        phi_2: get("phi_2")?,
        slider_stiffness: get("slider_stiffness")?,
        residual_stiffness: get("residual_stiffness")?,
    };
    Ok(law(&DESCRIPTOR, density.checked()?))
}

impl Backbone for IwanBackbone {
    fn law_descriptor(&self) -> &'static LawDescriptor {
        self.descriptor
    }
    fn corners(&self) -> &[f64] {
        &self.corners
    }
    fn force(&self, segment: usize, deformation: f64) -> (f64, f64) {
        self.density.segment(segment, deformation)
    }
    fn slip_work(&self, deformation: f64) -> f64 {
        self.density.slip_work(deformation)
    }
    fn stored(&self, deformation: f64) -> f64 {
        self.density.stored(deformation)
    }
}
