//! A shear building.

use crate::damping::{Damping, DampingMatrix};
use crate::error::ShearBuildingError;
use crate::modes::{Modes, undamped};
use crate::tridiagonal::SymmetricTridiagonal;

/// A chain of storeys with everything that follows from it, computed once.
#[derive(Debug, Clone, PartialEq)]
pub struct ShearBuilding {
    name: String,
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    height: Vec<f64>,
    elevations: Vec<f64>,
    damping: Damping,
    stiffness_matrix: SymmetricTridiagonal,
    damping_matrix: DampingMatrix,
    modes: Modes,
}

impl ShearBuilding {
    /// A building from floor masses (kg), storey stiffnesses (N/m) and storey
    /// heights (m), one a storey, bottom first.
    ///
    /// # Errors
    /// No storeys, lists of unequal length, a value that is not positive and
    /// finite, values so far apart that the modes cannot be resolved, or damping out
    /// of range.
    pub fn new(
        name: String,
        mass: Vec<f64>,
        stiffness: Vec<f64>,
        height: Vec<f64>,
        damping: Damping,
    ) -> Result<Self, ShearBuildingError> {
        if mass.is_empty() {
            return Err(ShearBuildingError::NoStoreys { building: name });
        }
        for (quantity, values) in [
            ("mass", &mass),
            ("stiffness", &stiffness),
            ("height", &height),
        ] {
            check(&name, quantity, values, mass.len())?;
        }
        let stiffness_matrix = SymmetricTridiagonal::chain(&stiffness);
        let undamped = undamped(&mass, &stiffness, &stiffness_matrix);
        if let Some(j) = undamped
            .circular_frequency
            .iter()
            .position(|w| !(w.is_finite() && *w > 0.0))
        {
            return Err(ShearBuildingError::Modes {
                building: name,
                mode: j + 1,
                frequency: undamped.circular_frequency[j],
            });
        }
        let damping_matrix = damping
            .matrix(&mass, &stiffness_matrix, &undamped)
            .map_err(|reason| ShearBuildingError::Damping {
                building: name.clone(),
                reason,
            })?;
        let modes = Modes::new(undamped, &mass, &damping_matrix);
        let elevations = height
            .iter()
            .scan(0.0, |sum, h| {
                *sum += h;
                Some(*sum)
            })
            .collect();
        Ok(Self {
            name,
            mass,
            stiffness,
            height,
            elevations,
            damping,
            stiffness_matrix,
            damping_matrix,
            modes,
        })
    }

    /// Name of the building.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of storeys.
    #[must_use]
    pub fn storeys(&self) -> usize {
        self.mass.len()
    }

    /// Floor masses (kg), bottom first.
    #[must_use]
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Storey stiffnesses (N/m), bottom first.
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Storey heights (m), bottom first.
    #[must_use]
    pub fn height(&self) -> &[f64] {
        &self.height
    }

    /// Floor elevations above the ground (m), bottom first.
    #[must_use]
    pub fn elevations(&self) -> &[f64] {
        &self.elevations
    }

    /// Damping as it was asked for.
    #[must_use]
    pub fn damping(&self) -> &Damping {
        &self.damping
    }

    /// Stiffness matrix (N/m).
    #[must_use]
    pub fn stiffness_matrix(&self) -> &SymmetricTridiagonal {
        &self.stiffness_matrix
    }

    /// Damping matrix (N s/m).
    #[must_use]
    pub fn damping_matrix(&self) -> &DampingMatrix {
        &self.damping_matrix
    }

    /// Modal properties.
    #[must_use]
    pub fn modes(&self) -> &Modes {
        &self.modes
    }

    /// `out = C v` (N); one value a storey.
    pub fn apply_damping(&self, v: &[f64], out: &mut [f64]) {
        self.damping_matrix.multiply(v, out);
    }
}

fn check(
    building: &str,
    quantity: &'static str,
    values: &[f64],
    storeys: usize,
) -> Result<(), ShearBuildingError> {
    if values.len() != storeys {
        return Err(ShearBuildingError::Length {
            building: building.to_owned(),
            quantity,
            found: values.len(),
            expected: storeys,
        });
    }
    match values.iter().position(|x| !(x.is_finite() && *x > 0.0)) {
        None => Ok(()),
        Some(i) => Err(ShearBuildingError::Value {
            building: building.to_owned(),
            quantity,
            storey: i + 1,
            value: values[i],
            required: "greater than zero",
        }),
    }
}
