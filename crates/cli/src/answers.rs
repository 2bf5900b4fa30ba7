//! What commands read and answer, without printing: for the Python package, whose objects say
//! the same.

pub use crate::commands::check::Understood;
pub use crate::commands::compare::numbers::Compared;
pub use crate::commands::gap::numbers::Check;
pub use crate::commands::ida::numbers::Analysis;
pub use crate::commands::models::descriptor::Described as DescribedModel;
pub use crate::faults::{assembled, of_check};
pub use crate::study::Finished;
