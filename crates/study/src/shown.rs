//! One run of a study as a case of its own.

use pounding_case::Case;
use pounding_ground_motion::processing::Scale;

use crate::case_text::{Edit, Path, apply, entry, with_motion};
use crate::error::StudyError;
use crate::runs::{Runner, chosen, factor, motion, wanted, written};
use crate::study_file::{RecordKind, Study};

/// The case of one run as a text that `pounding run` takes, if it lies in the folder of
/// the study's case. Where the study sets the intensity, the factor is its `scale`; a
/// motion that the study makes is read from a file, and a comment says how to make that.
///
/// # Errors
/// [`StudyError::NoSuchRun`]; a motion that cannot be read where it is scaled;
/// [`StudyError::NotShown`] if the text of the case leaves no room for the factor or the
/// file.
pub fn case_of_run(study: &Study, run: usize) -> Result<String, StudyError> {
    if run >= study.runs() {
        return Err(StudyError::NoSuchRun {
            run,
            last: study.runs().saturating_sub(1),
        });
    }
    let not_shown = |reason: String| StudyError::NotShown { run, reason };
    let point = study.point(run);
    let mut text = Runner::text(study, &point);
    let source = &study.records[chosen(study, &point)];
    let mut comments = String::new();
    if let RecordKind::Made { command, .. } = &source.kind {
        let file = format!("{}.csv", source.name);
        text = with_file(&text, &file).map_err(not_shown)?;
        comments.push_str(&format!(
            "# Its record is synthetic, written in the folder of this case by\n# {command} -o {file}\n"
        ));
    }
    let mut scale = None;
    if let Some((measure, intensity)) = wanted(study, &point) {
        let motion = motion(&source.kind, Some(measure))?;
        scale = factor(Some(intensity), Ok(&motion)).map_err(not_shown)?;
        let title = measure.title();
        comments.push_str(&format!(
            "# `scale` gives it, in SI: {title} = {intensity}\n"
        ));
    }
    if let Some(scale) = scale {
        text = with_scale(&text, scale).map_err(not_shown)?;
    }
    let text = format!("{comments}{text}");
    // Replaced tables with headers of their own would leave their entries behind.
    let case = Case::parse(&text, &study.base.file).map_err(|e| not_shown(e.to_string()))?;
    match scale {
        Some(scale) if !scaled_by(&case, scale) => {
            Err(not_shown("its `scale` cannot be replaced".to_owned()))
        }
        _ => Ok(text),
    }
}

/// Whether this is the scale of the case.
fn scaled_by(case: &Case, factor: f64) -> bool {
    let scale = case.ground_motion.scale.as_ref();
    scale.is_some_and(|scale| scale.value == Scale::Factor(factor))
}

/// The case with a record in our own layout, and no word of its former one.
fn with_file(text: &str, file: &str) -> Result<String, String> {
    let file = toml::Value::String(file.to_owned()).to_string();
    let edits = with_motion(text, &["scale"], vec![("file".to_owned(), file)]);
    Ok(apply(text, &edits.map_err(|(reason, _)| reason)?))
}

/// The case with this factor as the scale of its record.
fn with_scale(text: &str, scale: f64) -> Result<String, String> {
    let path = Path::parse("ground_motion.scale")?;
    let entry = entry(text, &path).map_err(|(reason, _)| reason)?;
    Ok(apply(text, &[Edit::new(&entry, written(scale))]))
}
