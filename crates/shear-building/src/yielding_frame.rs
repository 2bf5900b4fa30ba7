//! A frame of a building that turns in plan, with a law in the place of its stiffness in a storey.

use std::fmt;

use crate::storey_law::StoreyLaw;

/// The direction in which a frame resists motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FrameDirection {
    /// Along the row of buildings.
    Along,
    /// Across it.
    Across,
}

impl FrameDirection {
    /// Name in results: `along` or `across`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Along => "along",
            Self::Across => "across",
        }
    }
}

impl fmt::Display for FrameDirection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A frame with a law in the place of its stiffness in one storey, see
/// [`crate::ShearBuilding::with_yielding_frames`].
#[derive(Debug, Clone)]
pub struct YieldingFrame {
    /// Direction in which it resists motion. The shear of its storey holds its force where that is along the row.
    pub direction: FrameDirection,
    /// Distance from the mass centre (m), across the row for a frame along it, along the row for one across it.
    pub at: f64,
    /// Storey, from zero.
    pub storey: usize,
    /// Its deformation (m) as a sum over the coordinates of the building, by their numbers, floors first, and
    /// weights.
    pub deformation: Vec<(usize, f64)>,
    /// The law: force (N) of that deformation.
    pub law: StoreyLaw,
}

impl fmt::Display for YieldingFrame {
    /// `frame along at -5 m, storey 1`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (direction, at, storey) = (self.direction, self.at, self.storey + 1);
        write!(f, "frame {direction} at {at} m, storey {storey}")
    }
}
