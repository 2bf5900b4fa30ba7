//! Records beside that of the case, of buildings and across the row: where an intensity scales the
//! motion they keep their proportion to the record of the case.

use pounding_assembly::{AssemblyError, read_record, scale_record};
use pounding_case::{Case, GroundMotion};
use pounding_ground_motion::Accelerogram;

use crate::error::StudyError;
use crate::study_file::{Study, Target};

/// Records beside that of the case, with the places of their scales.
pub(crate) fn further_motions(case: &Case) -> Vec<(String, &GroundMotion)> {
    let across = case.ground_motion.across.as_ref();
    let across = across.map(|a| ("ground_motion.across.scale".to_owned(), &*a.value));
    let buildings = case.buildings.iter().enumerate();
    let own = buildings.filter_map(|(b, building)| {
        let motion = building.ground.as_ref()?.value.motion.as_ref()?;
        Some((format!("building.{b}.ground.scale"), motion))
    });
    own.chain(across).collect()
}

/// The intensity (SI) of the record of the case, scaled as there, if records of the study take its
/// place at an intensity: it is the strength to which further records keep their proportion. That of
/// the records of the study is none: they are recorded as strongly as it happens.
///
/// # Errors
/// A record of the case that cannot be read or has no intensity.
pub(crate) fn intensity_of_case(study: &Study) -> Result<Option<f64>, StudyError> {
    let targets = || study.variables.iter().map(|v| &v.target);
    let measure = targets().find_map(|target| match target {
        Target::Intensity(measure) => Some(measure),
        _ => None,
    });
    let (Some(measure), true) = (measure, targets().any(|t| matches!(t, Target::Record))) else {
        return Ok(None);
    };
    let gives_ground = |target: &Target| match target {
        Target::Entry { path, .. } => path.table() == "building" && path.leads_through("ground"),
        _ => false,
    };
    if further_motions(&study.base).is_empty() && !targets().any(gives_ground) {
        return Ok(None);
    }
    let refused = |reason: String| StudyError::Proportion { reason };
    let record = read_record(&study.base).and_then(|record| scale_record(&study.base, record));
    let record = record.map_err(|e| refused(e.to_string()))?;
    let intensity = measure.of(&record).map_err(|e| refused(e.to_string()))?;
    match intensity > 0.0 {
        true => Ok(Some(intensity)),
        false => Err(refused(format!("its {} is {intensity}", measure.title()))),
    }
}

/// The factor on top of their own scales by which further records are scaled where `record`, as
/// recorded, is brought to `intensity` by `scale`.
///
/// # Errors
/// A scale of the case that the record cannot have.
pub(crate) fn factor_of_further(
    case: &Case,
    of_case: Option<f64>,
    (record, intensity, scale): (&Accelerogram, f64, f64),
) -> Result<f64, AssemblyError> {
    match of_case {
        Some(of_case) => Ok(intensity / of_case),
        // The record is that of the case.
        None => Ok(scale / (scale_record(case, record.clone())?.scale() / record.scale())),
    }
}
