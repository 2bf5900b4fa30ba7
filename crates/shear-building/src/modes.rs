//! Modes of a building.

use nalgebra::DMatrix;

use crate::damping::{Damping, DampingMatrix};
use crate::undamped::{LARGE, Undamped};

/// Modal properties of a building.
#[derive(Debug, Clone, PartialEq)]
pub struct Modes {
    /// Circular frequencies (rad/s), ascending.
    pub circular_frequency: Vec<f64>,
    /// Periods (s), descending.
    pub period: Vec<f64>,
    /// Shapes, storey by mode, normalised to the mass matrix (1/sqrt(kg)), the
    /// roof positive.
    pub shape: DMatrix<f64>,
    /// Participation factors `phi' M 1` (sqrt(kg)).
    pub participation_factor: Vec<f64>,
    /// Effective modal masses (kg); they sum to the building's mass.
    pub effective_mass: Vec<f64>,
    /// Damping ratios `phi' C phi / (2 omega)` (-). For dashpots the modes are
    /// coupled, and this is the diagonal part.
    pub damping_ratio: Vec<f64>,
}

impl Modes {
    /// Number of the fundamental mode along the row: that with the largest effective mass. Of a building that turns in
    /// plan the longest period may be one across the row, of which motion along it knows nothing.
    #[must_use]
    pub fn fundamental(&self) -> usize {
        let masses = self.effective_mass.iter().enumerate();
        let largest = masses.fold(
            (0, 0.0),
            |best: (usize, f64), (mode, mass)| {
                if *mass > best.1 { (mode, *mass) } else { best }
            },
        );
        largest.0
    }

    pub(crate) fn new(
        undamped: Undamped,
        mass: &[f64],
        (damping, matrix): (&Damping, &DampingMatrix),
    ) -> Self {
        let n = mass.len();
        let Undamped {
            circular_frequency,
            shape,
        } = undamped;
        let participation_factor: Vec<f64> = (0..n)
            .map(|j| (0..n).map(|i| shape[(i, j)] * mass[i]).sum())
            .collect();
        let mut product = vec![0.0; n];
        let damping_ratio = (0..n)
            .map(|j| {
                // The product below would take the cube of the storeys to come to this.
                if let (Damping::Modal { ratios }, true) = (damping, n > LARGE) {
                    return ratios[if ratios.len() == 1 { 0 } else { j }];
                }
                let phi: Vec<f64> = shape.column(j).iter().copied().collect();
                matrix.multiply(&phi, &mut product);
                let generalised: f64 = phi.iter().zip(&product).map(|(a, b)| a * b).sum();
                generalised / (2.0 * circular_frequency[j])
            })
            .collect();
        Self {
            period: circular_frequency
                .iter()
                .map(|w| std::f64::consts::TAU / w)
                .collect(),
            effective_mass: participation_factor.iter().map(|g| g * g).collect(),
            circular_frequency,
            shape,
            participation_factor,
            damping_ratio,
        }
    }
}
