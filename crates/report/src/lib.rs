//! Figures and pages: layer 4.
//!
//! [`RunResult`] reads what a run has written (`docs/reference/result-file.md`); [`page`] makes one
//! HTML file of it, and of what studies answer, that needs nothing else: words, tables, figures. [`figure()`] draws
//! panels of curves for the command line as well. Values are SI as in the result
//! file; [`Answered`] is the file of what other commands answer; the page shows them in the units that engineers write. [`documentation`] has the
//! reference pages of impact models and laws, [`openquake`] the fragilities for another program, and [`pictures`] draws what runs, studies,
//! laboratories and motions show.

pub mod documentation;
pub mod openquake;
pub mod page;
pub mod pictures;

mod answer_file;
mod chart;
mod conversion;
mod decimation;
mod error;
mod figure;
mod loops;
mod reading;
mod result;

pub use answer_file::{AnswerFileError, Answered, AnsweredCommand, SCHEMA_VERSION};
pub use chart::{Chart, DASHES, PAGE};
pub use conversion::{Converted, PictureFormat};
pub use error::ReportError;
pub use figure::{Curve, Panel, Reference, figure, figure_with_references};
pub use loops::{CYCLE_COLUMNS, cycle_cells};
pub use result::{
    BaseMoment, BuildingResult, EnergyHistory, GapResult, ImpactResult, LevelResponses,
    LevelResult, LinkResult, NamedResponse, RunResult, StoreyPeaks, Table,
};
