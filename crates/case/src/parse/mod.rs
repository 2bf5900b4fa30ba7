//! The case file: its keys, and from there to a case.

use std::ops::Range;
use std::path::Path;

use pounding_catalogue::wording::{agreeing, counted, one_line};
use pounding_shear_building::{NAMES, is_name};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{self, Entry, Field, OneOrEach, Optional, Reader, Table, Tables};
use crate::error::{CaseError, Errors};
use crate::located::Located;
use crate::types::{Analysis, Building, Case, Draft, Gap, Link, Refusal, read_text};
use analysis::AnalysisTable;
use building::BuildingTable;
use gap::GapTable;
use ground_motion::MotionTable;
use law::LinkTable;
use separation::SeparationTable;

mod analysis;
mod building;
mod changed;
mod column;
mod force;
mod foundation;
mod gap;
mod ground_motion;
mod isolator;
mod lateral;
mod law;
mod levels;
mod parameters;
mod plan;
mod process;
mod rule;
mod scale;
mod separation;
mod tree;

pub use ground_motion::ground_motion_schema;
pub use process::{ProcessSteps, process_steps};
pub use tree::CaseTree;

/// A case of seismic pounding
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "the case")]
#[schemars(title = "pounding case")]
struct CaseFile {
    /// Title of the case
    title: Optional<String>,
    /// Buildings, from the left
    #[schemars(required)]
    building: Optional<Tables<BuildingTable>>,
    /// Gaps between neighbours, or to a rigid wall
    gap: Optional<Tables<GapTable>>,
    /// Joints, dampers and bumpers between floors of neighbours
    link: Optional<Tables<LinkTable>>,
    /// The recorded motion
    ground_motion: Field<Table<MotionTable>>,
    /// Method, duration, output
    analysis: Optional<Table<AnalysisTable>>,
    /// What provisions for the gap need to know
    separation: Optional<SeparationTable>,
}

/// JSON Schema (2020-12) of a case file: the keys that the reader accepts, with
/// what they are and their units.
#[must_use]
pub fn schema() -> serde_json::Value {
    document::schema_of::<CaseFile>("pounding/case.schema.json")
}

/// Where to see how a case file is written.
const EXAMPLE: &str = "see the example in docs/reference/case-file.md";

impl Case {
    /// Reads a case from a file.
    ///
    /// # Errors
    /// A file that cannot be read, or all that is wrong in it: the first error with the
    /// others.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let source = read_text(path, "case")?;
        Self::parse(&source, path)
    }

    /// Reads a case from a text; `file` names it and is the base of its paths.
    ///
    /// # Errors
    /// All that is wrong in it, each with line, column and remedy: the first error with the
    /// others.
    pub fn parse(source: &str, file: &Path) -> Result<Self, CaseError> {
        Self::parse_or_draft(source, file).map_err(|refusal| refusal.error)
    }

    /// The same; what is wrong comes with what could be read all the same.
    ///
    /// # Errors
    /// As [`Case::parse`].
    pub fn parse_or_draft(source: &str, file: &Path) -> Result<Self, Box<Refusal>> {
        case_of(source, file, |reader| {
            let mut tables: CaseFile = reader.read(EXAMPLE)?;
            let row = Row::new(reader, tables.building.take());
            Some(tables.draft(reader, file, &row))
        })
    }
}

/// The case that is read from a text, unless anything is wrong with it.
fn case_of(
    source: &str,
    file: &Path,
    draft: impl FnOnce(&Reader<'_>) -> Option<Draft>,
) -> Result<Case, Box<Refusal>> {
    let name = file.display().to_string();
    let errors = Errors::default();
    let reader = Reader {
        file: &name,
        source,
        errors: &errors,
    };
    let draft = draft(&reader);
    match (errors.finish(Ok(())), draft) {
        (Ok(()), Some(draft)) => Ok(draft.case),
        (Err(error), draft) => Err(Box::new(Refusal { error, draft })),
        // Without a draft there is an error, which was recorded.
        (Ok(()), None) => {
            let error = CaseError::new(&name, source, 0..0, "the file cannot be read", None);
            Err(Box::new(Refusal { error, draft: None }))
        }
    }
}

impl CaseFile {
    /// The case as far as it could be read, with these buildings.
    fn draft(self, reader: &Reader<'_>, file: &Path, row: &Row) -> Draft {
        let gaps = gaps(reader, self.gap, row);
        let links = links(reader, self.link, row);
        let before = reader.errors.count();
        let motion = self.ground_motion.value().unwrap_or_default();
        let ground_motion = motion.value.read(reader);
        let motion_is_known = motion.whole && reader.errors.count() == before;
        let separation = self.separation.value().filter(|_| row.count > 0);
        let separation = separation.map(|table| table.read(reader, row.count));
        Draft {
            case: Case {
                title: one_line(self.title.value().unwrap_or_default()),
                buildings: row.readable.clone(),
                gaps,
                links,
                ground_motion,
                analysis: Analysis::from(self.analysis.value().unwrap_or_default()),
                separation: separation.unwrap_or_default(),
                asked: reader.errors.all_asked(),
                source: reader.source.to_owned(),
                file: file.to_owned(),
                given_files: None,
            },
            incomplete: reader.errors.all_incomplete(),
            unread: reader.errors.all_unread(),
            motion_is_known,
        }
    }
}

/// The row of buildings as far as it could be read.
struct Row {
    /// How many there are.
    count: usize,
    /// Their names, if all are sound.
    names: Option<Vec<String>>,
    /// The buildings that could be read, with stand-ins for values that are wrong.
    readable: Vec<Building>,
    /// Elevations of their floors (m).
    elevations: Vec<Vec<f64>>,
    /// Whether these are all, and their storey heights sound.
    heights: bool,
}

impl Row {
    fn new(reader: &Reader<'_>, tables: Optional<Tables<BuildingTable>>) -> Self {
        let wrong = tables.is_wrong();
        let tables = tables.value().map_or_else(Vec::new, |tables| tables.0);
        if tables.is_empty() && !wrong {
            reader.refuse::<()>(0..0, "the case has no building", "add a [[building]]");
        }
        let mut row = Self {
            count: tables.len(),
            names: None,
            readable: Vec::new(),
            elevations: Vec::new(),
            heights: !tables.is_empty(),
        };
        let mut names: Vec<Option<Located<String>>> = Vec::new();
        for table in tables {
            let Some(Located { value, span }) = table.located() else {
                names.push(None);
                row.heights = false;
                continue;
            };
            let name = value.name(reader);
            let twice = name.as_ref().and_then(|name| {
                let first = names.iter().flatten().find(|n| n.value == name.value)?;
                let message = format!(
                    "building \"{}\" is given twice, first in line {}",
                    name.value,
                    reader.line(&first.span)
                );
                Some(reader.error(
                    name.span.clone(),
                    message,
                    "give every building its own name",
                ))
            });
            let unique = twice.map(|e| reader.errors.record(e)).is_none();
            let building = value.read(reader, span, name.clone());
            names.push(name.filter(|_| unique));
            row.heights &= building.as_ref().is_some_and(|(_, heights)| *heights);
            row.readable.extend(building.map(|(building, _)| building));
        }
        row.elevations = row.readable.iter().map(Building::elevations).collect();
        if row.count > 0 {
            row.names = names.into_iter().map(|n| Some(n?.value)).collect();
        }
        row
    }

    /// The buildings, if they are sound as far as storey heights go.
    fn buildings(&self) -> Option<&[Building]> {
        self.heights.then_some(&self.readable)
    }
}

/// Gaps and links with the places of their `between`; without one of those where that is
/// wrong.
fn read<T, U>(
    tables: Optional<Tables<T>>,
    one: impl Fn(T) -> Option<(U, Option<Range<usize>>)>,
) -> (Vec<(U, Range<usize>)>, Vec<U>) {
    let tables = tables.value().map_or_else(Vec::new, |tables| tables.0);
    let (mut placed, mut without_place) = (Vec::new(), Vec::new());
    for (read, place) in tables.into_iter().filter_map(|t| one(t.value()?)) {
        match place {
            Some(place) => placed.push((read, place)),
            None => without_place.push(read),
        }
    }
    (placed, without_place)
}

fn gaps(reader: &Reader<'_>, tables: Optional<Tables<GapTable>>, row: &Row) -> Vec<Gap> {
    let (placed, without_place) = read(tables, |table: GapTable| table.read(reader, row));
    let mut gaps: Vec<(Gap, Range<usize>)> = Vec::new();
    for (gap, span) in placed {
        if let Some((_, first)) = gaps.iter().find(|(g, _)| g.between == gap.between) {
            let message = format!(
                "gap given twice: the first is in line {}",
                reader.line(first)
            );
            let help = "remove one; several levels of one gap go into its `levels` and `width`";
            reader.refuse::<()>(span, message, help);
        } else if let Some((_, first)) = gaps.iter().find(|(g, _)| g.name == gap.name) {
            same_name(reader, "gap", &gap.name, span, first);
        } else {
            gaps.push((gap, span));
        }
    }
    let gaps = gaps.into_iter().map(|(gap, _)| gap);
    gaps.chain(without_place).collect()
}

fn links(reader: &Reader<'_>, tables: Optional<Tables<LinkTable>>, row: &Row) -> Vec<Link> {
    let (placed, without_place) = read(tables, |table: LinkTable| table.read(reader, row));
    let mut links: Vec<(Link, Range<usize>)> = Vec::new();
    for (link, span) in placed {
        match links.iter().find(|(l, _)| l.name == link.name) {
            Some((_, first)) => same_name(reader, "link", &link.name, span, first),
            None => links.push((link, span)),
        }
    }
    let links = links.into_iter().map(|(link, _)| link);
    links.chain(without_place).collect()
}

fn same_name(
    reader: &Reader<'_>,
    what: &str,
    name: &str,
    span: Range<usize>,
    first: &Range<usize>,
) {
    let line = reader.line(first);
    let message = format!("two {what}s have the name \"{name}\", the first in line {line}");
    let help = format!("give every {what} its own `name`");
    reader.refuse::<()>(span, message, help);
}

/// The name of a gap or link, if it states one.
fn name(reader: &Reader<'_>, given: Optional<String>, what: &str) -> Option<String> {
    Some(check_name(reader, given.located()?, what)?.value)
}

/// The name of a gap or link that states none: those of what it lies between, which stand here.
fn joined_name(
    reader: &Reader<'_>,
    names: &[String; 2],
    place: Option<&Range<usize>>,
    what: &str,
) -> String {
    let joined = names.join("-");
    if let Some(place) = place
        && names.iter().all(|name| is_name(name))
        && !is_name(&joined)
    {
        let length = joined.chars().count();
        let message = format!(
            "the {what} has no name of its own, and that of both buildings together has {length} characters, which cannot name it"
        );
        reader.refuse::<()>(
            place.clone(),
            message,
            format!("give the {what} a `name`; {NAMES}"),
        );
    }
    joined
}

/// Characters that are shown of what cannot be a name.
const SHOWN_OF_A_NAME: usize = 80;

/// Refuses names that cannot stand in messages or as a group of the result file.
fn check_name(reader: &Reader<'_>, name: Located<String>, what: &str) -> Option<Located<String>> {
    if is_name(&name.value) {
        return Some(name);
    }
    let mut shown: String = name.value.chars().take(SHOWN_OF_A_NAME).collect();
    if shown.len() < name.value.len() {
        shown.push('\u{2026}');
    }
    let message = format!("{shown:?} cannot name a {what}");
    reader.refuse(name.span, message, NAMES)
}

/// One value for each of `count` places. A list that holds one value is more likely short
/// than meant for all.
fn spread<T: Into<U>, U: Clone, const LEAST: usize>(
    reader: &Reader<'_>,
    list: Located<OneOrEach<T, LEAST>>,
    count: usize,
    place: &str,
) -> Option<Vec<U>> {
    match list.value.length() {
        Some(length) if length != count => reader.refuse(
            list.span,
            format!(
                "{} where there {} {}",
                counted(length, "value"),
                agreeing(&count, "is", "are"),
                counted(count, place)
            ),
            match place {
                "place" => "give one value per storey or level of this law, or a single value without brackets for all".to_owned(),
                "contact level" => "give one value per contact level, which is a pair of floors that meet, from the bottom, or a single value for all; all points of a level along an edge, where floors turn in plan, share it".to_owned(),
                _ => format!("give one value per {place}, or a single value for all"),
            },
        ),
        _ => Some(list.value.spread(count)),
    }
}
