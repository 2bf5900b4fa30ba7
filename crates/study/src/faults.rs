//! All that is wrong in a case, said at once.
//!
//! A case is read in two steps: words, units and places first, then models, parameters,
//! methods and the record. Each step reports all that it finds, but what fails in the first
//! is never seen by the second. Here the second looks at what the first could read.

use std::ops::Range;
use std::path::Path;

use pounding_assembly::{
    AssemblyError, assemble_at_rest, read_record, regap, scale_record, unknown_parameter,
};
use pounding_case::{
    Analysis, Building, BuildingPlaces, Case, CaseError, Damping, Draft, GivenFiles, Located,
    Parameter, Plan, Quantity,
};
use pounding_gap_element::registry;
use pounding_ground_motion::GroundMotionError;
use pounding_hysteresis::help_among_gaps;
use pounding_time_history::TimeHistoryError;
use toml::de::{DeTable, DeValue};

use crate::case_text::root_key;
use crate::gap_check::unknown_words;

/// Buildings of more storeys take too long to be looked at for the sake of a message alone.
const MOST_STOREYS: usize = 200;

/// A case file in which something is wrong.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{error}")]
pub struct FaultyCase {
    /// All that was found.
    pub error: Box<CaseError>,
    /// The text that it points into; empty where the file cannot be read.
    pub source_text: String,
}

/// Reads and validates a case file. With `own_record`, errors of one kind do not hide that
/// its record is missing.
///
/// # Errors
/// All that is wrong in its words, and what can be found wrong behind them.
pub fn read_case(path: &Path, own_record: bool) -> Result<Case, FaultyCase> {
    // Read once: a pipe has nothing to give a second time.
    let source_text = pounding_case::read_text(path, "case").map_err(|error| FaultyCase {
        error: Box::new(error),
        source_text: String::new(),
    })?;
    parse_case(&source_text, path, own_record).map_err(|error| FaultyCase {
        error: Box::new(error),
        source_text,
    })
}

/// The same of a text that was read from a file.
///
/// # Errors
/// As [`read_case`].
pub fn parse_case(source: &str, path: &Path, own_record: bool) -> Result<Case, CaseError> {
    parse_case_of(source, path, own_record, None)
}

/// The same of a text with the files that it names.
///
/// # Errors
/// As [`read_case`].
pub fn parse_case_with(source: &str, path: &Path, files: &GivenFiles) -> Result<Case, CaseError> {
    parse_case_of(source, path, true, Some(files))
}

fn parse_case_of(
    source: &str,
    path: &Path,
    own_record: bool,
    files: Option<&GivenFiles>,
) -> Result<Case, CaseError> {
    if let Some(span) = root_key(
        source,
        &["variable", "case"],
        &["building", "ground_motion"],
    ) {
        let file = path.display().to_string();
        let message = "this is a study, not a case";
        let help = "give it to `pounding sweep`, or with [ida] to `pounding ida`; the case is what it names as `case`";
        return Err(CaseError::new(
            &file,
            source,
            span,
            message,
            Some(help.to_owned()),
        ));
    }
    let mut case = Case::parse_or_draft(source, path).map_err(|refusal| {
        let Some(mut draft) = refusal.draft else {
            return refusal.error;
        };
        draft.case.given_files = files.cloned();
        let known = with_unknown_parameters(refusal.error, &draft);
        joined(known, later(&draft, own_record))
    })?;
    case.given_files = files.cloned();
    // Only the gap check needs these words, but a case in which they are wrong is wrong
    // everywhere.
    match CaseError::of_all(unknown_words(&case)) {
        None => Ok(case),
        Some(error) => Err(joined(error, later(&sound(&case), own_record))),
    }
}

/// A case in which nothing was found wrong by reading it.
fn sound(case: &Case) -> Draft {
    Draft {
        case: case.clone(),
        incomplete: Vec::new(),
        unread: Vec::new(),
        motion_is_known: true,
    }
}

/// What kept a case from being assembled, with all else that is wrong in it. An error that has
/// no place in the case stays as it is.
#[must_use]
pub fn with_all(error: AssemblyError, case: &Case, own_record: bool) -> AssemblyError {
    let error = match error {
        AssemblyError::Case(error) => error,
        AssemblyError::GroundMotion(error) if own_record => of_record(case, &error),
        AssemblyError::System(TimeHistoryError::Option {
            option,
            value,
            reason,
        }) if case.analysis.places.contains_key(option) => of_option(case, option, value, reason),
        error => return error,
    };
    let first = CaseError::of_all(error.clone().each().map(|e| hinted(case, e)).collect());
    joined(first.unwrap_or(error), later(&sound(case), own_record)).into()
}

/// The errors of a case with those of parameters that their model or law does not have, in the
/// place of what is wrong with the values of these.
fn with_unknown_parameters(error: CaseError, draft: &Draft) -> CaseError {
    let mut all: Vec<CaseError> = error.clone().each().collect();
    for parameter in &draft.unread {
        let start = parameter.key.span.start;
        // A slip of another key was found by reading.
        if all.iter().any(|e| e.span.start == start) {
            continue;
        }
        let unknown = unknown_parameter(&draft.case, parameter);
        if let Some((unknown, value)) = unknown.zip(value_of(&draft.case.source, start)) {
            all.retain(|e| !value.contains(&e.span.start));
            all.push(unknown);
        }
    }
    CaseError::of_all(all).unwrap_or(error)
}

/// Where the value of the key that begins at a place stands.
fn value_of(source: &str, key: usize) -> Option<Range<usize>> {
    fn within(table: &DeTable<'_>, at: usize) -> Option<Range<usize>> {
        table.iter().find_map(|(key, value)| {
            let found = (key.span().start == at).then(|| value.span());
            found.or_else(|| inside(value.get_ref(), at))
        })
    }
    fn inside(value: &DeValue<'_>, at: usize) -> Option<Range<usize>> {
        match value {
            DeValue::Table(table) => within(table, at),
            DeValue::Array(items) => items.iter().find_map(|item| inside(item.get_ref(), at)),
            _ => None,
        }
    }
    let tree = DeTable::parse(source).ok()?;
    within(tree.get_ref(), key)
}

/// One error of an error and others, in the order of the file.
fn joined(error: CaseError, more: Vec<CaseError>) -> CaseError {
    let all = error.clone().each().chain(more).collect();
    CaseError::of_all(all).unwrap_or(error)
}

/// What the second step finds wrong in what could be read.
fn later(draft: &Draft, own_record: bool) -> Vec<CaseError> {
    let mut errors = words(draft);
    errors.extend(options(&draft.case));
    errors.extend(floors(&draft.case));
    errors.extend(unknown_words(&draft.case));
    if own_record {
        errors.extend(record(draft));
    }
    errors
}

/// Buildings, models, laws and their parameters.
fn words(draft: &Draft) -> Vec<CaseError> {
    // A method that is none keeps the case from being put together after its words were
    // looked at, which stand-ins would not bear.
    let nowhere = draft.case.source.len() + 1;
    let mut case = draft.case.clone();
    case.analysis.method = Located {
        value: String::new(),
        span: nowhere..nowhere,
    };
    let small = |b: &Building| b.mass.len() <= MOST_STOREYS;
    if !case.buildings.iter().all(small) {
        // Gaps and links are not looked at beyond their models.
        case.buildings.retain(small);
        if case.buildings.iter().all(|b| b.plan.is_none()) {
            case.ground_motion.across = None;
        }
    }
    let found = of_case(assemble_at_rest(&case));
    let found = found.into_iter().filter(|e| e.span.start != nowhere);
    let follows = |e: &CaseError| draft.incomplete.contains(&e.span) && !is_unknown(&case, e);
    let found = found.filter(|e| !follows(e));
    found.map(|e| hinted(&case, e)).collect()
}

/// Whether the error stands at a model or law that is not known: what its parameters are
/// does not matter then.
fn is_unknown(case: &Case, error: &CaseError) -> bool {
    let at = |name: &Located<String>| name.span == error.span;
    let laws = case.buildings.iter().flat_map(Building::all_laws);
    let mut laws = laws
        .map(|l| &l.model)
        .chain(case.links.iter().map(|l| &l.model));
    unknown_model(case, error).is_some()
        || laws.any(|l| at(l) && pounding_hysteresis::find(&l.value).is_err())
}

/// The name at the place of an error, if it is that of no impact model.
fn unknown_model<'c>(case: &'c Case, error: &CaseError) -> Option<&'c str> {
    let mut gaps = case.gaps.iter();
    let gap = gaps.find(|g| g.model.span == error.span)?;
    let name = gap.model.value.as_str();
    registry::find(name).is_err().then_some(name)
}

/// Help for who looks for a law of links among the models of gaps.
fn hinted(case: &Case, mut error: CaseError) -> CaseError {
    let Some(name) = unknown_model(case, &error) else {
        return error;
    };
    error.help = help_among_gaps(name).or(error.help);
    error
}

/// The method and its numbers.
fn options(case: &Case) -> Vec<CaseError> {
    let mut alone = case.clone();
    alone.gaps.clear();
    alone.links.clear();
    // Which moves floors of a plan alone.
    alone.ground_motion.across = None;
    alone.buildings = vec![plain_building()];
    match assemble_at_rest(&alone) {
        Err(AssemblyError::System(TimeHistoryError::Option {
            option,
            value,
            reason,
        })) => vec![of_option(case, option, value, reason)],
        other => of_case(other),
    }
}

/// An option out of range, where the case gives it.
fn of_option(case: &Case, option: &str, value: f64, reason: &str) -> CaseError {
    let message = format!("`{option}` = {value} is out of range: {reason}");
    let help = format!("correct `{option}` in [analysis]");
    case.error(case.analysis.span_of(option), message, Some(help))
}

/// Floors that face one another.
fn floors(case: &Case) -> Vec<CaseError> {
    if case.buildings.iter().any(|b| b.mass.len() > MOST_STOREYS) {
        return Vec::new();
    }
    let mut base = case.clone();
    base.links.clear();
    base.analysis = Analysis {
        method: Located {
            value: "event_driven".to_owned(),
            span: 0..0,
        },
        ..base.analysis
    };
    for building in &mut base.buildings {
        building.laws.clear();
        let plan = building.plan.as_mut().map(|plan| &mut plan.value);
        for frame in plan.into_iter().flat_map(Plan::frames_mut) {
            frame.laws.clear();
        }
    }
    let mut gaps = std::mem::take(&mut base.gaps);
    gaps.retain(|gap| !gap.levels.is_empty());
    if gaps.is_empty() {
        return Vec::new();
    }
    let Ok(alone) = assemble_at_rest(&base) else {
        return Vec::new();
    };
    let stiffness = Parameter {
        key: Located {
            value: "stiffness".to_owned(),
            span: 0..0,
        },
        values: vec![Located {
            value: Quantity {
                value: 1.0e8,
                dimension: None,
                text: String::new(),
            },
            span: 0..0,
        }],
    };
    let mut errors = Vec::new();
    for mut gap in gaps {
        // Any model that is known.
        gap.model.value = "linear_elastic".to_owned();
        gap.separation = None;
        gap.spring = None;
        gap.parameters = vec![stiffness.clone()];
        let hits_columns = gap.columns.iter().any(Option::is_some);
        base.gaps = vec![gap];
        // Columns that are hit belong to buildings, which are then others.
        errors.extend(match hits_columns {
            true => of_case(assemble_at_rest(&base)),
            false => of_case(regap(&base, &alone.system)),
        });
    }
    errors
}

/// The record and the words that say how to read it.
fn record(draft: &Draft) -> Vec<CaseError> {
    let mut case = draft.case.clone();
    let file = &case.ground_motion.file;
    let path = case.resolve(&file.value);
    // What is neither missing nor a file, such as a pipe, gives its text once.
    let on_disk = case.given_files.is_none();
    let readable = !on_disk || std::fs::metadata(&path).map_or(true, |m| m.is_file());
    if file.value.as_os_str().is_empty() || !readable {
        return Vec::new();
    }
    let mut errors = Vec::new();
    let mut known = draft.motion_is_known;
    loop {
        let error = match read_record(&case) {
            Ok(record) if known => scale_record(&case, record).err(),
            Ok(_) => None,
            Err(error) => Some(error),
        };
        match error {
            Some(AssemblyError::Case(error)) => {
                let motion = &mut case.ground_motion;
                let words = [&mut motion.format, &mut motion.unit, &mut motion.quantity];
                let at = |w: &&mut Option<Located<String>>| {
                    w.as_ref().is_some_and(|w| w.span == error.span)
                };
                let Some(word) = words.into_iter().find(at) else {
                    errors.extend(known.then_some(error));
                    return errors;
                };
                // Without it the others are looked at; the record cannot be.
                *word = None;
                known = false;
                errors.push(error);
            }
            Some(AssemblyError::GroundMotion(error)) => {
                if known || matches!(error, GroundMotionError::Io { .. }) {
                    errors.push(of_record(&case, &error));
                }
                return errors;
            }
            _ => return errors,
        }
    }
}

/// An error of the record, at the key that makes it, or else where the case names the record.
fn of_record(case: &Case, error: &GroundMotionError) -> CaseError {
    let place = case.ground_motion.span_of(error.option().unwrap_or("file"));
    case.error(place, error.to_string(), error.help())
}

fn of_case<T>(result: Result<T, AssemblyError>) -> Vec<CaseError> {
    match result {
        Err(AssemblyError::Case(error)) => error.each().collect(),
        _ => Vec::new(),
    }
}

/// One storey without anything to find fault with.
fn plain_building() -> Building {
    let nowhere = 0..0;
    Building {
        name: Located {
            value: "building".to_owned(),
            span: nowhere.clone(),
        },
        mass: vec![1.0],
        stiffness: vec![1.0e3],
        lateral: None,
        isolator: None,
        height: vec![3.0],
        initial_displacement: Located {
            value: vec![0.0],
            span: nowhere.clone(),
        },
        initial_velocity: vec![0.0],
        laws: Vec::new(),
        p_delta: false,
        damping: Located {
            value: Damping::MassProportional { ratio: 0.0 },
            span: nowhere,
        },
        foundation: None,
        ground: None,
        plan: None,
        forces: Vec::new(),
        places: BuildingPlaces::default(),
    }
}
