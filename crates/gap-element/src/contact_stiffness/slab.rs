//! Axial stiffness of floor slabs.

use super::{ContactStiffness, ContactStiffnessError, positive, quantity};
use crate::descriptor::Verification;

/// Least ratio of contact to storey stiffness that is customary.
const LEAST_STOREY_RATIO: f64 = 5.0;
/// A floor slab in the direction of impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slab {
    /// Young's modulus (Pa).
    pub elastic_modulus: f64,
    /// Area of the cross-section that takes the impact (m^2).
    pub area: f64,
    /// Length in the direction of impact (m).
    pub length: f64,
}

/// Axial stiffness of two slabs in series, `1/k = L1/(E1 A1) + L2/(E2 A2)` in N/m
/// (Maison and Kasai 1990, 1992). The storey stiffness (N/m) of the stiffer
/// building, if given, is compared with it.
///
/// # Errors
/// Quantities that are not positive.
pub fn slab(
    left: &Slab,
    right: &Slab,
    storey_stiffness: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let (first, second) = (axial_stiffness(left)?, axial_stiffness(right)?);
    let value = 1.0 / (1.0 / first + 1.0 / second);
    let mut warnings =
        vec!["a stiffness for linear laws only (n = 1), such as linear_elastic".to_owned()];
    if let Some(storey) = storey_stiffness {
        positive("storey stiffness", storey, "N/m")?;
        if value < LEAST_STOREY_RATIO * storey {
            warnings.push(format!(
                "only {:.3} times the storey stiffness, softer than customary ({LEAST_STOREY_RATIO} times and more): penetration will not be small",
                value / storey
            ));
        }
    }
    ContactStiffness {
        value,
        exponent: 1.0,
        source: "Axial stiffness of the floors: Maison and Kasai, Earthquake Spectra 6 (1990) 711; EESD 21 (1992) 771",
        status: Verification::SecondarySources("EA/L is textbook statics; its use for pounding is not checked against the papers"),
        intermediate: vec![
            quantity("left slab stiffness", first, "N/m"),
            quantity("right slab stiffness", second, "N/m"),
        ],
        warnings,
    }
    .checked()
}

fn axial_stiffness(slab: &Slab) -> Result<f64, ContactStiffnessError> {
    positive("elastic modulus", slab.elastic_modulus, "Pa")?;
    positive("cross-section area", slab.area, "m^2")?;
    positive("slab length", slab.length, "m")?;
    Ok(slab.elastic_modulus * slab.area / slab.length)
}
