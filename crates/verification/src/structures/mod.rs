//! Structures that others computed, beside ours: plain case files of this crate, run.

mod ansys;
mod case_file;
mod chung_ooi;
mod code_aster;
mod entered;
mod laws;
mod modelica;
mod opensees;
mod quantity;
mod reference_table;
mod siconos;

use crate::comparison::Part;
use crate::error::VerificationError;

pub use entered::{Entered, TEMPLATE};

/// A source of published structures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Structures {
    /// Pairs of buildings by OpenSees.
    OpenSees,
    /// Oscillators and falling bodies at stops.
    CodeAster,
    /// A bouncing ball and a column of beads.
    Siconos,
    /// A mass between two stops of spring and dashpot.
    Modelica,
    /// A ball that falls on a spring.
    Ansys,
    /// Elastic impacts of spheres.
    ChungOoi,
    /// Laws of storeys and links along one path.
    Laws,
    /// Publications whose numbers are not at hand.
    Entered,
}

impl Structures {
    /// Computes what the source publishes, and compares; `entered` are the numbers of those
    /// whose own are not at hand.
    ///
    /// # Errors
    /// A case that cannot be run, or entered numbers that do not fit their case.
    pub fn compare(self, entered: &Entered) -> Result<Part, VerificationError> {
        match self {
            Self::OpenSees => opensees::opensees(),
            Self::CodeAster => code_aster::code_aster(),
            Self::Siconos => siconos::siconos(),
            Self::Modelica => modelica::modelica(),
            Self::Ansys => ansys::ansys(),
            Self::ChungOoi => chung_ooi::chung_ooi(),
            Self::Laws => laws::laws(),
            Self::Entered => entered::entered(entered),
        }
    }
}
