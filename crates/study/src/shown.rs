//! One run of a study as a case of its own.

use pounding_assembly::{AssemblyError, further_record};
use pounding_case::{Case, GroundMotion};
use pounding_ground_motion::processing::Scale;

use crate::case_text::{Edit, Path, apply, entry, with_motion, written};
use crate::error::StudyError;
use crate::runs::{
    FurtherFactors, Runner, factor, factors_of_further, further_motions, intensity_of_case, motion,
    wanted,
};
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
    let source = &study.records[study.motion_of(&point)];
    let mut comments = String::new();
    if let RecordKind::Made { command, .. } = &source.kind {
        let file = format!("{}.csv", source.name);
        text = with_file(&text, &file).map_err(not_shown)?;
        comments.push_str(&format!(
            "# Its record is synthetic, written in the folder of this case by\n# {command} -o {file}\n"
        ));
    }
    let mut scales: Vec<(String, f64)> = Vec::new();
    if let Some((measure, intensity)) = wanted(study, &point) {
        let motion = motion(&source.kind, Some(measure))?;
        if let Some(scale) = factor(Some(intensity), Ok(&motion)).map_err(not_shown)? {
            let case = Case::parse(&text, &study.base.file);
            let case = case.map_err(|e| not_shown(e.to_string()))?;
            if let Some(record) = &motion.record
                && !further_motions(&case).is_empty()
            {
                let brought = (&**record, intensity, scale);
                let brings = source.kind.brings_across();
                let of_further =
                    factors_of_further(&case, intensity_of_case(study)?, brings, brought)
                        .and_then(|factors| further_scales(&case, factors));
                scales = of_further.map_err(|e| not_shown(e.to_string()))?;
            }
            scales.push(("ground_motion.scale".to_owned(), scale));
        }
        let title = measure.title();
        comments.push_str(&format!(
            "# `scale` gives it, in SI: {title} = {intensity}\n"
        ));
    }
    for (place, scale) in &scales {
        text = with_scale(&text, place, *scale).map_err(not_shown)?;
    }
    let text = format!("{comments}{text}");
    // Replaced tables with headers of their own would leave their entries behind.
    let case = Case::parse(&text, &study.base.file).map_err(|e| not_shown(e.to_string()))?;
    match scales.is_empty() || scales_of(&case) == scales {
        true => Ok(text),
        false => Err(not_shown("its `scale` cannot be replaced".to_owned())),
    }
}

/// Places of the scales of records beside that of the case, with their own scales times these
/// factors.
fn further_scales(
    case: &Case,
    factors: FurtherFactors,
) -> Result<Vec<(String, f64)>, AssemblyError> {
    let scaled = further_motions(case).into_iter().map(|(place, motion)| {
        let factor = match place.starts_with("ground_motion") {
            true => factors.across,
            false => factors.of_buildings,
        };
        let own = further_record(case, motion)?.scale();
        Ok((place, own * factor))
    });
    scaled.collect()
}

/// The scales of a case that are plain factors, with their places.
fn scales_of(case: &Case) -> Vec<(String, f64)> {
    let own = ("ground_motion.scale".to_owned(), &case.ground_motion);
    let all = further_motions(case).into_iter().chain([own]);
    let factor = |(place, motion): (String, &GroundMotion)| match &motion.scale.as_ref()?.value {
        Scale::Factor(factor) => Some((place, *factor)),
        _ => None,
    };
    all.filter_map(factor).collect()
}

/// The case with a record in our own layout, and no word of its former one along the row.
fn with_file(text: &str, file: &str) -> Result<String, String> {
    let file = toml::Value::String(file.to_owned()).to_string();
    let edits = with_motion(text, &["scale", "across"], vec![("file".to_owned(), file)]);
    Ok(apply(text, &edits.map_err(|(reason, _)| reason)?))
}

/// The case with this factor as the scale of the record at this place.
fn with_scale(text: &str, place: &str, scale: f64) -> Result<String, String> {
    let (place, value) = match file_alone(text, place) {
        Some((place, file)) => {
            let file = toml::Value::String(file);
            let value = format!("{{ file = {file}, scale = {} }}", written(scale));
            (place, value)
        }
        None => (place, written(scale)),
    };
    let path = Path::parse(place)?.counted();
    let entry = entry(text, &path).map_err(|(reason, _)| reason)?;
    Ok(apply(text, &[Edit::new(&entry, value)]))
}

/// The place and the name of a record that the case gives by its file alone, where its scale would have no room.
fn file_alone<'a>(text: &str, place: &'a str) -> Option<(&'a str, String)> {
    let motion = place.strip_suffix(".scale")?;
    let table: toml::Table = text.parse().ok()?;
    let mut keys = motion.split('.');
    let first = table.get(keys.next()?)?;
    let at = keys.try_fold(first, |value, key| match key.parse::<usize>() {
        Ok(index) => value.get(index),
        Err(_) => value.get(key),
    })?;
    Some((motion, at.as_str()?.to_owned()))
}
