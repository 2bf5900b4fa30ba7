//! Records beside that of the case, of buildings and across the row: where an intensity scales the
//! motion they keep their proportion to the record of the case.

use pounding_assembly::{AssemblyError, read_record, scale_record};
use pounding_case::{Building, Case, GroundMotion};
use pounding_ground_motion::Accelerogram;

use crate::error::StudyError;
use crate::study_file::{Study, Variable};

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
/// place at an intensity, and other records stay: these keep their proportion to it. That of the
/// study's records would not do: they were recorded strong or weak, as it happened.
///
/// # Errors
/// A record of the case that cannot be read or has no intensity.
pub(crate) fn intensity_of_case(study: &Study) -> Result<Option<f64>, StudyError> {
    let (Some(measure), true) = (study.measure(), study.has_records()) else {
        return Ok(None);
    };
    let gives_ground = |variable: &Variable| {
        let mut paths = variable.target.paths();
        paths.any(|path| path.table() == "building" && path.leads_through("ground"))
    };
    let base = &study.base;
    let own = |b: &Building| b.ground.as_ref().is_some_and(|g| g.value.motion.is_some());
    let kept = || study.records.iter().any(|r| !r.kind.brings_across());
    let along = base.buildings.iter().any(own) || study.variables.iter().any(gives_ground);
    if !(along || base.ground_motion.across.is_some() && kept()) {
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

/// Factors of further records, on top of their own scales.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FurtherFactors {
    /// Of those of buildings.
    pub of_buildings: f64,
    /// Of that across the row.
    pub across: f64,
}

/// By what further records are scaled where `record`, as recorded, is brought to `intensity` by
/// `scale`. With `brings_across` the one across the row came with `record`, and keeps its proportion
/// to that.
///
/// # Errors
/// A scale of the case that the record cannot have.
pub(crate) fn factors_of_further(
    case: &Case,
    of_case: Option<f64>,
    brings_across: bool,
    (record, intensity, scale): (&Accelerogram, f64, f64),
) -> Result<FurtherFactors, AssemblyError> {
    let by_case = scale_record(case, record.clone())?.scale() / record.scale();
    let by_record = scale / by_case;
    let kept = of_case.map_or(by_record, |of_case| intensity / of_case);
    Ok(FurtherFactors {
        of_buildings: kept,
        across: if brings_across { by_record } else { kept },
    })
}
