//! Kelvin-Voigt without tension: what is left of the penetration at zero force is
//! taken as a plastic deformation that widens the gap.

use crate::classes::DampingPhases;
use crate::classes::linear::damping_ratio_zero_penetration;
use crate::classes::linear::{self, LinearClass};
use crate::descriptor::{ModelDescriptor, Verification};
use crate::error::GapElementError;
use crate::model::{ImpactModel, SeparationRule};
use crate::parameters::ModelParameters;

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "komodromos_2007",
    title: "Kelvin-Voigt without tension, gap widened",
    formula: "F = k delta + c v until F = 0, then the gap is wider by the penetration left;  zeta = -ln e / sqrt(pi^2 + ln^2 e)",
    citation: "Komodromos, Polycarpou, Papaloizou and Phocas, Earthquake Engineering and Structural Dynamics 36 (2007) 1605",
    separation_rules: &[SeparationRule::GapShift, SeparationRule::NoTensionLatched],
    verification: Verification::SecondarySources(
        "separation rule as described in later papers; behaviour verified against the closed form e = exp(-2 g(zeta))",
    ),
    traps: &[
        "The damping ratio is the one that is exact with tension: returns 0.5503 for 0.5, 0.6748 for 0.65.",
        "The gap grows with every impact; the result says by how much. The energy left in the spring at separation is counted as dissipated.",
        "The force jumps to c v0 at closure.",
    ],
    build,
    ..linear::LINEAR_DESCRIPTOR
};

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    LinearClass::build(
        &DESCRIPTOR,
        parameters,
        DampingPhases::Both,
        damping_ratio_zero_penetration,
    )
}
