//! From the TOML tree to a study.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use pounding_assembly::{AssemblyError, assemble_at_rest};
use pounding_case::document::{Entry, Field, List, Optional, Reader, Table, schema_of};
use pounding_case::{CaseError, Errors, Located};
use pounding_catalogue::suggestion;
use pounding_catalogue::wording::one_line;
use pounding_results::study::{ISOLATED_DEMAND, isolated_peaks, quantity_names};
use schemars::JsonSchema;
use serde::Deserialize;
use toml::de::DeTable;

use crate::case_text::{Path as CasePath, root_key};
use crate::faults::{parse_case, with_all};

use super::context::{Base, Context, LawOfStorey};
use super::design::{Design, SampledGrid, is_random};
use super::ida::IdaTable;
use super::keys::lacks;
use super::readings::readings;
use super::values::{MOST_OF_CHUNK, MOST_RUNS, Whole, all};
use super::variables::VariableTable;
use super::{
    IntensityMeasure, Readings, RecordSource, Study, Target, Values, Variable, records, rows,
};
use crate::error::StudyError;

/// Runs of a chunk unless the study says otherwise: a second or less of work that can be
/// lost, and files that are not too many.
const CHUNK: usize = 256;

/// Many runs of one case
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "the study")]
#[schemars(title = "pounding study")]
struct StudyFile {
    /// Title of the study
    title: Optional<String>,
    /// Case file, relative to the folder of the study
    case: Field<String>,
    /// What varies
    variable: Field<List<VariableTable>>,
    /// How the variables are sampled, by default a grid
    design: Optional<DesignTable>,
    /// What is stored
    output: Optional<OutputTable>,
    /// What an incremental dynamic analysis evaluates
    ida: Optional<IdaTable>,
}

/// How the variables are sampled
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[design]")]
struct DesignTable {
    /// grid (default): every combination; list: the first values of all, then the second;
    /// latin_hypercube, sobol or monte_carlo: so many runs
    kind: Optional<Kind>,
    /// Number of runs of latin_hypercube, sobol and monte_carlo
    runs: Optional<Whole<1, MOST_RUNS>>,
    /// Sets of random numbers of a grid, for each of its combinations: the same for all, but each record has sets of
    /// its own
    samples: Optional<Whole<1, MOST_RUNS>>,
    /// Seed of latin_hypercube, monte_carlo and the samples of a grid, by default 1, and of the random shift of sobol
    seed: Optional<Whole<0>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    rename = "design",
    rename_all = "snake_case",
    expecting = "a text in quotes"
)]
enum Kind {
    Grid,
    List,
    LatinHypercube,
    Sobol,
    MonteCarlo,
}

/// What is stored
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[output]")]
struct OutputTable {
    /// Runs that are stored at once at most, by default 256; shards are dealt in chunks
    chunk: Optional<Whole<1, MOST_OF_CHUNK>>,
    /// Adds the gap that just keeps the isolated buildings apart, by default false
    isolated_demand: Optional<bool>,
    /// Adds the peaks of the storeys without pounding, by default false
    isolated_peaks: Optional<bool>,
    /// Names of the quantities that are stored, by default all
    quantities: Optional<List<String>>,
    /// Type of the numbers of quantities, float64 (default) or float32
    numbers: Optional<Numbers>,
}

#[derive(Debug, Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(
    rename = "type of numbers",
    rename_all = "lowercase",
    expecting = "a text in quotes"
)]
enum Numbers {
    Float64,
    Float32,
}

/// What is stored of each run.
struct Output {
    chunk: usize,
    isolated_demand: bool,
    isolated_peaks: bool,
    quantities: Option<Vec<String>>,
    float32: bool,
}

impl OutputTable {
    fn read(self, reader: &Reader<'_>, with_ida: bool) -> Option<Output> {
        let chunk = self.chunk.value_or(Whole(CHUNK));
        let demand = self.isolated_demand.value_or(false);
        let peaks = self.isolated_peaks.value_or(false);
        let numbers = self.numbers.value_or(Numbers::Float64);
        let mut quantities = match self.quantities.stated()? {
            None => None,
            Some(list) if with_ida => {
                let message = "an incremental dynamic analysis is evaluated from all quantities";
                return reader.refuse(list.span, message, "remove `quantities`, or [ida]");
            }
            Some(list) => Some(all(list.value.0.into_iter().map(|name| {
                let Located { value: name, span } = name.located()?;
                if quantity_names().any(|known| known == name) {
                    return Some(name);
                }
                let nearest = suggestion::misspelt(&name, quantity_names());
                let guess = nearest.map_or_else(String::new, |n| format!("did you mean {n}? "));
                let known: Vec<&str> = quantity_names().collect();
                let help = format!("{guess}known quantities: {}", known.join(", "));
                reader.refuse(span, format!("no quantity is called {name:?}"), help)
            }))?),
        };
        let (demand, peaks) = (demand?, peaks?);
        let asked = |name: &str| match name {
            _ if name == ISOLATED_DEMAND.name => demand,
            name => peaks && isolated_peaks().any(|peak| peak == name),
        };
        if let Some(names) = &mut quantities {
            names.extend(
                quantity_names()
                    .filter(|name| asked(name))
                    .map(str::to_owned),
            );
        }
        let chosen = |name: &str| {
            let mut names = quantities.iter().flatten();
            names.any(|chosen| chosen == name)
        };
        Some(Output {
            chunk: chunk?.0,
            isolated_demand: demand || chosen(ISOLATED_DEMAND.name),
            isolated_peaks: peaks || isolated_peaks().any(chosen),
            quantities,
            float32: numbers? == Numbers::Float32,
        })
    }
}

/// JSON Schema (2020-12) of a study file: the keys that the reader accepts, with what they
/// are and their units.
#[must_use]
pub fn study_schema() -> serde_json::Value {
    schema_of::<StudyFile>("pounding/study.schema.json")
}

/// Cases of a study are text, and name their files by whole paths.
fn in_a_folder_of_text(file: &Path) -> Result<(), StudyError> {
    let path = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    match path.to_str() {
        Some(_) => Ok(()),
        None => Err(StudyError::NotUtf8 { path }),
    }
}

pub(super) fn study(source: &str, file: &Path) -> Result<Study, StudyError> {
    in_a_folder_of_text(file)?;
    let name = file.display().to_string();
    if let Some(span) = root_key(
        source,
        &["building", "ground_motion"],
        &["variable", "case"],
    ) {
        let message = "this is a case, not a study";
        let help = "give it to `pounding run`, `gap` or `compare`; a study names a case and what varies in it, see docs/reference/studies.md";
        let error = CaseError::new(&name, source, span, message, Some(help.to_owned()));
        return Err(StudyError::Text {
            error: Box::new(error),
            source_text: source.to_owned(),
        });
    }
    let errors = Errors::default();
    let reader = Reader {
        file: &name,
        source,
        errors: &errors,
    };
    let mut context = Context {
        folder: file.parent().unwrap_or(Path::new("")).to_owned(),
        ..Context::default()
    };
    let table = reader.read::<Table<StudyFile>>("see docs/reference/studies.md");
    let study = table.and_then(|table| table.value.read(&reader, file, &mut context, table.places));
    let text = |error| StudyError::Text {
        error: Box::new(error),
        source_text: source.to_owned(),
    };
    // Without a study there is an error, here or in the case.
    match (errors.finish(Ok(())), context.wrong, study) {
        (Ok(()), None, Some(study)) => Ok(study),
        (Ok(()), Some(wrong), _) => Err(wrong),
        (Err(error), wrong, _) => {
            let all = error.clone().each().chain(context.missing.take());
            let error = CaseError::of_all(all.collect()).unwrap_or(error);
            let wrong = std::iter::once(text(error)).chain(wrong);
            Err(StudyError::of_all(wrong.collect()))
        }
        (Ok(()), None, None) => {
            let message = "the study cannot be read";
            Err(text(CaseError::new(&name, source, 0..0, message, None)))
        }
    }
}

impl StudyFile {
    /// The study, if it is whole; all that is wrong is recorded.
    fn read(
        self,
        reader: &Reader<'_>,
        file: &Path,
        context: &mut Context,
        places: BTreeMap<String, Range<usize>>,
    ) -> Option<Study> {
        // One that is called nearly so holds more variables.
        let is_one =
            |key: &String| key != "variable" && suggestion::misspelt(key, ["variable"]).is_some();
        let all_known = !places.keys().any(is_one);
        let list = self.variable.value().map(|list| list.0);
        let names_records = list.iter().flatten().any(|table| match table {
            Field::Given(table) => table.value.records.is_some() || table.value.synthetic.is_some(),
            Field::Wrong => false,
        });
        // An incremental dynamic analysis needs them.
        let counts: Vec<Range<usize>> = match self.ida {
            None => list.iter().flatten().filter_map(count_of).collect(),
            Some(_) => Vec::new(),
        };
        // Without records of its own the study takes that of the case.
        read_case(reader, self.case, context, !names_records);
        context.in_rows = list.as_ref().is_some_and(|list| list.len() > 1) && is_list(&self.design);
        let tables: Vec<Range<usize>> = list.iter().flatten().filter_map(Entry::span).collect();
        let read = list.map(|list| variables(reader, list, context));
        let whole = read.as_ref().filter(|read| read.whole && all_known);
        let with_ida = self.ida.is_some();
        let design_place = self.design.span();
        let design = design(
            reader,
            self.design,
            whole.map(|read| (&*read.variables, &*tables)),
            (counts, with_ida),
        );
        let rows = match (whole, &design) {
            (Some(read), Some(design)) => {
                let rows = rows::taken(reader, context, (&read.variables, design));
                let samples = design.samples();
                rows.and(rows::ends_taken(
                    reader,
                    context,
                    (&read.variables, &tables),
                    samples,
                ))
            }
            // What else is wrong comes first.
            _ => Some(()),
        };
        let measure = read
            .as_ref()
            .and_then(|read| read.variables.iter().find_map(intensity_of));
        let ida = self.ida.stated().and_then(|ida| match ida {
            None => Some(None),
            Some(Located { value, span }) => {
                let place = design_place.unwrap_or_else(|| span.clone());
                let both = whole.and_then(|read| {
                    let is_list = matches!(design, Some(Design::List { .. }));
                    let both = ida_variables(reader, span, &read.variables, is_list)?;
                    each_once(reader, place, design.as_ref()?, (&read.variables, &tables))?;
                    Some(both)
                });
                value.read(reader, context, both, measure).map(Some)
            }
        });
        let output = match self.output.stated()? {
            None => Some(Output {
                chunk: CHUNK,
                isolated_demand: false,
                isolated_peaks: false,
                quantities: None,
                float32: false,
            }),
            Some(Located { value, .. }) => value.read(reader, with_ida),
        };
        let (ida, output, read) = (ida?, output?, read?);
        rows?;
        let base = context.base.take()?.case;
        let design = design?;
        let (records, readings) = match (read.records, read.reading) {
            (Some(records), _) => (records, Readings::new()),
            (None, Some(place)) => readings(reader, place, (&read.variables, &design), &base)?,
            (None, None) => (vec![records::of_case(&base)], Readings::new()),
        };
        Some(Study {
            title: one_line(self.title.value().unwrap_or_default()),
            file: file.to_owned(),
            source: reader.source.to_owned(),
            variables: read.variables,
            design,
            chunk: output.chunk,
            isolated_demand: output.isolated_demand || ida.is_some(),
            isolated_peaks: output.isolated_peaks,
            quantities: output.quantities,
            float32: output.float32,
            ida,
            records,
            readings,
            base,
        })
    }
}

/// Whether a design takes the values of its variables in rows.
fn is_list(design: &Optional<DesignTable>) -> bool {
    let kind = match design {
        Some(Field::Given(table)) => &table.value.kind,
        _ => return false,
    };
    matches!(kind, Some(Field::Given(kind)) if kind.value == Kind::List)
}

/// Where a variable says how many numbers its range has.
fn count_of(table: &Field<VariableTable>) -> Option<Range<usize>> {
    match table {
        Field::Given(table) => table.value.count_of_range(),
        Field::Wrong => None,
    }
}

/// Reads the case and what can be known of it into the context.
fn read_case(reader: &Reader<'_>, name: Field<String>, context: &mut Context, own_record: bool) {
    let Some(Located { value: name, span }) = name.located() else {
        return;
    };
    let path = context.folder.join(name);
    let source = match pounding_case::read_regular_text(&path, "case") {
        Ok(source) => source,
        Err(e) => {
            let relative = "`case` is relative to the folder of the study".to_owned();
            let help = match path.is_file() {
                true => e.help.clone().unwrap_or(relative),
                false => relative,
            };
            reader.refuse::<()>(span, e.to_string(), help);
            return;
        }
    };
    match base(&source, &path, own_record) {
        Ok(base) => context.base = Some(base),
        Err(wrong) => context.wrong = Some(wrong),
    }
    context.text = Some(source).filter(|text| DeTable::parse(text).is_ok());
}

/// The case, if it is sound.
fn base(source: &str, path: &Path, own_record: bool) -> Result<Base, StudyError> {
    let error = |e| StudyError::Text {
        error: Box::new(e),
        source_text: source.to_owned(),
    };
    let case = parse_case(source, path, own_record).map_err(error)?;
    let system = match assemble_at_rest(&case) {
        Ok(assembly) => assembly.system,
        Err(e) => match with_all(e, &case, own_record) {
            AssemblyError::Case(e) => return Err(error(e)),
            e => return Err(e.into()),
        },
    };
    let first = |b: &Arc<_>| {
        let building: &pounding_shear_building::ShearBuilding = b;
        building.modes().period[building.fundamental_mode()]
    };
    let fundamental_periods = system.buildings().iter().map(first).collect();
    let levels = system.gaps().iter().flat_map(|gap| {
        let levels = system.levels_of(gap).iter();
        levels.map(|level| format!("{} {}", gap.name, level.place.label()))
    });
    let levels = levels.collect();
    let of_gaps = system.gaps().iter().flat_map(|gap| system.levels_of(gap));
    let rigid = of_gaps.map(|level| level.model.rigid_restitution().is_some());
    let laws = system.elements().iter().filter_map(|element| {
        let (building, storey) = system.storey_of_element(element.place)?;
        Some(LawOfStorey {
            building,
            storey,
            yields: element.yield_deformation.is_some(),
        })
    });
    Ok(Base {
        rigid: rigid.collect(),
        laws: laws.collect(),
        case,
        fundamental_periods,
        levels,
    })
}

/// The variables that could be read.
struct Variables {
    variables: Vec<Variable>,
    /// Whether these are all.
    whole: bool,
    records: Option<Vec<RecordSource>>,
    /// Where one says how the record of the case is read.
    reading: Option<Range<usize>>,
}

fn variables(
    reader: &Reader<'_>,
    tables: Vec<Field<VariableTable>>,
    context: &Context,
) -> Variables {
    let mut read = Variables {
        variables: Vec::new(),
        whole: true,
        records: None,
        reading: None,
    };
    // Stated names of variables in which something else is wrong.
    let mut names: Vec<String> = Vec::new();
    for table in tables {
        let Some(Located { value, span }) = table.located() else {
            read.whole = false;
            continue;
        };
        let twice = |names: &[String], known: &[Variable], name: &String| {
            let is_known = names.contains(name) || known.iter().any(|v| v.name == *name);
            is_known.then(|| {
                let message = format!("two variables have the name \"{name}\"");
                reader.refuse::<()>(span.clone(), message, "give each its own `name`");
            })
        };
        let stated = value.stated_name();
        let Some((variable, named)) = value.read(reader, &span, context) else {
            read.whole = false;
            if let Some(name) = stated {
                twice(&names, &read.variables, &name);
                names.push(name);
            }
            continue;
        };
        let compared = || {
            if named.is_some() && read.records.is_some() {
                let help = "put them into one list";
                return reader.refuse(span.clone(), "records are given twice", help);
            }
            if let Some(other) = read.variables.iter().find(|v| collide(v, &variable)) {
                let pair = [other, &variable];
                let [a, b] = pair.map(|v| &v.name);
                if !pair.into_iter().any(Variable::is_record) {
                    let both = format!("\"{a}\" and \"{b}\" vary the same entry");
                    return reader.refuse(span.clone(), both, "remove one of them");
                }
                let (records, entry) = if other.is_record() { (a, b) } else { (b, a) };
                let both = format!(
                    "\"{entry}\" changes the motion of the case, in whose place \"{records}\" puts records"
                );
                let help =
                    "remove one of them: beside records `ground_motion.scale` alone can vary";
                return reader.refuse(span.clone(), both, help);
            }
            match twice(&names, &read.variables, &variable.name) {
                Some(()) => None,
                None => Some(()),
            }
        };
        if compared().is_none() {
            read.whole = false;
            continue;
        }
        if variable.of_reading() {
            read.reading.get_or_insert(span);
        }
        read.variables.push(variable);
        read.records = read.records.or(named);
    }
    read
}

/// Whether two variables change the same bytes of the case, or the same property of the
/// motion.
fn collide(a: &Variable, b: &Variable) -> bool {
    let entries = |v: &Variable| match &v.target {
        Target::Entries { entries, .. } => {
            let entries = entries.iter().map(|varied| Arc::clone(&varied.entry));
            entries.collect()
        }
        // A model puts new lines where another absent key might go: no collision.
        Target::Model { edits } => {
            let old = edits.iter().take(1).flatten().filter(|e| e.value.is_none());
            old.map(|edit| Arc::clone(&edit.entry)).collect()
        }
        _ => Vec::new(),
    };
    match (&a.target, &b.target) {
        (Target::Intensity(_), Target::Intensity(_)) => true,
        // An intensity sets the scale, and a record all other keys of the motion.
        (of_case @ Target::Entries { .. }, Target::Intensity(_))
        | (Target::Intensity(_), of_case @ Target::Entries { .. }) => {
            of_case.paths().any(CasePath::of_scale)
        }
        (of_case @ Target::Entries { .. }, Target::Record)
        | (Target::Record, of_case @ Target::Entries { .. }) => of_case
            .paths()
            .any(|path| path.table() == "ground_motion" && !path.of_scale()),
        _ => entries(a)
            .iter()
            .any(|a| entries(b).iter().any(|b| a.overlaps(b))),
    }
}

fn design(
    reader: &Reader<'_>,
    table: Optional<DesignTable>,
    variables: Option<(&[Variable], &[Range<usize>])>,
    (counts, with_ida): (Vec<Range<usize>>, bool),
) -> Option<Design> {
    let Some(Located { value: table, span }) = table.stated()? else {
        return grid(reader, 0..0, variables?, None, with_ida);
    };
    let place = table.kind.span().unwrap_or_else(|| span.clone());
    let kind = table.kind.value_or(Kind::Grid)?;
    let meaningless = |name: &str, keys: &[(&str, Option<Range<usize>>)]| {
        for (key, extra) in keys {
            extra.clone().and_then(|extra| {
                let message = format!("`{key}` has no meaning for {name}");
                reader.refuse::<()>(extra, message, "remove it")
            });
        }
    };
    let (runs, samples, seed) = (
        ("runs", table.runs.span()),
        ("samples", table.samples.span()),
        ("seed", table.seed.span()),
    );
    match kind {
        Kind::Grid if table.samples.is_some() => {
            meaningless("grid", &[runs]);
            let samples = table.samples.value()?.0;
            let seed = table.seed.value_or(Whole(1))?.0 as u64;
            return grid(reader, place, variables?, Some((samples, seed)), with_ida);
        }
        Kind::Grid => {
            meaningless("grid", &[runs]);
            let is_sampled = variables.is_some_and(|(v, _)| v.iter().any(|v| v.values.is_random()));
            if !is_sampled {
                meaningless("a grid without `samples`", &[seed]);
            }
            return grid(reader, place, variables?, None, with_ida);
        }
        Kind::List => {
            meaningless("list", &[runs, samples, seed]);
            return list(reader, place, variables?.0);
        }
        _ => {}
    }
    let name = match kind {
        Kind::Sobol => "sobol",
        Kind::MonteCarlo => "monte_carlo",
        _ => "latin_hypercube",
    };
    meaningless(name, &[samples]);
    for place in counts {
        let message = format!("`count` has no meaning for {name}");
        let help = "remove it: `runs` in [design] says how many values are taken";
        reader.refuse::<()>(place, message, help);
    }
    if table.runs.is_none() {
        return lacks(reader, "[design]", span, "runs");
    }
    let runs = table.runs.value()?.0;
    let seed = table.seed.stated()?.map(|seed| seed.value.0 as u64);
    let seed_or_one = seed.unwrap_or(1);
    match kind {
        Kind::LatinHypercube => {
            let seed = seed_or_one;
            return Some(Design::LatinHypercube { runs, seed });
        }
        Kind::MonteCarlo => {
            let seed = seed_or_one;
            return Some(Design::MonteCarlo { runs, seed });
        }
        _ => {}
    }
    let variables = variables?.0;
    let has_no_least = |v: &&Variable| match &v.values {
        Values::Random(distribution) => distribution.lower().is_none(),
        _ => false,
    };
    if let Some(random) = variables.iter().find(has_no_least)
        && seed.is_none()
    {
        let message = format!(
            "the first run of sobol without `seed` is at the least of all numbers, of which the distribution of \"{}\" has none",
            random.name
        );
        return reader.refuse(
            place,
            message,
            "add `seed = 1` to [design], or `lower = ...` to the distribution",
        );
    }
    match Design::sobol(runs, seed, variables.len()) {
        Ok(design) => Some(design),
        Err(reason) => reader.refuse(place, reason, "use latin_hypercube"),
    }
}

/// The grid of these variables, whose tables stand at these places, with so many sets of random numbers from a seed.
fn grid(
    reader: &Reader<'_>,
    place: Range<usize>,
    (variables, tables): (&[Variable], &[Range<usize>]),
    samples: Option<(usize, u64)>,
    with_ida: bool,
) -> Option<Design> {
    let sizes = all(variables.iter().zip(tables).map(|(v, table)| {
        v.values.count().or_else(|| {
            if samples.is_some() {
                return Some(1);
            }
            if v.values.is_random() {
                return refuse_random(reader, table.clone(), v, (OF_GRID, with_ida));
            }
            let message = format!(
                "the range of \"{}\" has no `count`, which a grid needs",
                v.name
            );
            let help = "add `count = ...` to the variable; or `samples = ...` to [design], so many sets of random numbers from such ranges in each combination";
            reader.refuse(table.clone(), message, help)
        })
    }))?;
    let sampled = samples.map(|(samples, seed)| SampledGrid::new(variables, samples, seed));
    let (design, sizes) = match sampled {
        Some(None) => {
            let message = "no variable has a `distribution`, or `from` and `to` without `count`, of which `samples` are taken";
            return reader.refuse(place, message, "remove `samples`");
        }
        Some(Some(grid)) => {
            let sizes = grid.sizes().to_vec();
            (Design::SampledGrid(grid), sizes)
        }
        None => (
            Design::Grid {
                sizes: sizes.clone(),
            },
            sizes,
        ),
    };
    let runs = sizes.iter().try_fold(1_usize, |n, s| n.checked_mul(*s));
    match runs.filter(|n| *n as u64 <= MOST_RUNS.unsigned_abs()) {
        Some(_) => Some(design),
        None => {
            let sizes: Vec<String> = sizes.iter().map(ToString::to_string).collect();
            let message = format!(
                "the grid has {} runs, and a study has {MOST_RUNS} at most",
                sizes.join(" x ")
            );
            reader.refuse(place, message, "make it coarser, or use latin_hypercube")
        }
    }
}

/// What takes every record at every intensity.
const OF_IDA: &str = "an incremental dynamic analysis";
/// What takes random numbers if it is told how many.
const OF_GRID: &str = "a grid without `samples`";

/// Refuses random numbers in a design that takes no samples.
fn refuse_random<T>(
    reader: &Reader<'_>,
    place: Range<usize>,
    variable: &Variable,
    (design, with_ida): (&str, bool),
) -> Option<T> {
    let message = format!(
        "\"{}\" has a `distribution`, of which {design} takes no samples",
        variable.name
    );
    let values = "write `values`, or `from`, `to` and `count`, in its place";
    let samples =
        "add `samples = ...` to [design], so many sets of random numbers in each combination";
    let sampled = "write [design] with kind = \"latin_hypercube\", or monte_carlo, and runs = ...";
    let help = match design {
        OF_IDA => values.to_owned(),
        OF_GRID if with_ida => format!("{samples}, such as 1"),
        OF_GRID => format!("{samples}; or {sampled}; or {values}"),
        _ => format!("{sampled}; or {values}"),
    };
    reader.refuse(place, message, help)
}

fn list(reader: &Reader<'_>, place: Range<usize>, variables: &[Variable]) -> Option<Design> {
    if let Some(random) = variables.iter().find(|v| v.values.is_random()) {
        return refuse_random(reader, place, random, ("a list", false));
    }
    let mut counts = variables.iter().map(|v| (&v.name, v.values.count()));
    let first = counts.next().and_then(|(_, n)| n);
    match (first, counts.find(|(_, n)| *n != first)) {
        (Some(runs), None) => Some(Design::List { runs }),
        (None, _) => {
            let message = "a range without `count` is no list";
            reader.refuse(place, message, "add `count = ...`, or give `values`")
        }
        (_, Some((name, _))) => reader.refuse(
            place,
            format!(
                "a list takes one value of each variable for every run, but \"{name}\" has another number of them than the first"
            ),
            "give all variables as many values, or use kind = \"grid\"",
        ),
    }
}

/// The measure of a variable that is an intensity.
fn intensity_of(variable: &Variable) -> Option<(IntensityMeasure, &Values)> {
    let measure = variable.target.measure()?;
    Some((measure.clone(), &variable.values))
}

/// Whether the runs of a design are those of an incremental dynamic analysis, each record once at
/// an intensity, and several at each: sampled designs have as many intensities as runs, and take the
/// values of lists several times. With the variables goes where each stands.
fn each_once(
    reader: &Reader<'_>,
    place: Range<usize>,
    design: &Design,
    (variables, tables): (&[Variable], &[Range<usize>]),
) -> Option<()> {
    let help =
        "remove [design], or use kind = \"grid\", which with `samples` has random numbers, too";
    let sampled = match design {
        Design::Grid { .. } | Design::SampledGrid(_) => {
            let all = variables.iter().zip(tables);
            let mut intensities = all.filter(|(v, _)| intensity_of(v).is_some());
            let twice = intensities.find_map(|(v, at)| Some((v.repeated()?, &v.unit, at)));
            let Some((repeated, unit, at)) = twice else {
                return Some(());
            };
            let message = format!(
                "the intensity {repeated} {unit} stands twice, and the same runs would count as more records"
            );
            return reader.refuse(at.clone(), message, "give each intensity once");
        }
        // Each record once, at an intensity of its own.
        Design::List { .. } => return Some(()),
        Design::LatinHypercube { .. } => "latin_hypercube",
        Design::Sobol { .. } => "sobol",
        Design::MonteCarlo { .. } => "monte_carlo",
    };
    let message = format!(
        "an incremental dynamic analysis takes every record at every intensity, which {sampled} does not"
    );
    reader.refuse(place, message, help)
}

/// Indices of the two variables that an incremental dynamic analysis is made of: the record
/// and the intensity. Others are random, unless rows of a list say what they are with each.
fn ida_variables(
    reader: &Reader<'_>,
    place: Range<usize>,
    variables: &[Variable],
    is_list: bool,
) -> Option<(usize, usize)> {
    let at = |is: &dyn Fn(&Variable) -> bool| variables.iter().position(is);
    let record = at(&Variable::is_record);
    let intensity = at(&|v| intensity_of(v).is_some());
    match (record, intensity) {
        (Some(record), Some(intensity)) => {
            let others = variables.iter().enumerate();
            let mut others =
                others.filter(|(i, v)| ![record, intensity].contains(i) && !is_random(&v.values));
            if !is_list && let Some((_, other)) = others.next() {
                let message = format!(
                    "beside `records` and `intensity` an incremental dynamic analysis has random variables, and \"{}\" has values, for each of which there is a fragility of its own",
                    other.name
                );
                let help = "make a study of each value; or write a `distribution`, and `samples` in [design]";
                return reader.refuse(place, message, help);
            }
            let variable = &variables[intensity];
            if let Values::Range { count: None, .. } = variable.values {
                let message = "the range of intensities has no `count`";
                return reader.refuse(place, message, "add `count = ...`");
            }
            if variable.values.is_random() {
                return refuse_random(reader, place, variable, (OF_IDA, true));
            }
            Some((record, intensity))
        }
        _ => reader.refuse(
            place,
            "an incremental dynamic analysis has two variables: `records` and `intensity`",
            "give both, or remove [ida]",
        ),
    }
}
