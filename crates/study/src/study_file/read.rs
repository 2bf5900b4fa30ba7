//! From the TOML tree to a study.

use std::cell::RefCell;
use std::path::Path;

use pounding_assembly::{AssemblyError, assemble_with_record};
use pounding_case::{CaseError, Errors};
use pounding_ground_motion::{AccelerationUnit, Accelerogram};
use toml::de::DeTable;

use crate::faults::{parse_case, with_all};

use super::context::{Base, Context};
use super::reader::{Reader, Result, Table, Value, Wrong};
use super::variables::variable;
use super::{IntensityMeasure, RecordSource, Study, Target, Values, Variable, ida, records};
use crate::design::Design;
use crate::error::StudyError;

const STUDY: [&str; 6] = ["title", "case", "variable", "design", "output", "ida"];
const DESIGN: [&str; 3] = ["kind", "runs", "seed"];
const OUTPUT: [&str; 2] = ["chunk", "isolated_demand"];
/// Runs of a chunk unless the study says otherwise: a second or less of work that can be
/// lost, and files that are not too many.
const CHUNK: usize = 256;

pub(super) fn study(source: &str, file: &Path) -> std::result::Result<Study, StudyError> {
    let name = file.display().to_string();
    let (errors, elsewhere) = (Errors::default(), RefCell::default());
    let reader = Reader {
        file: &name,
        source,
        errors: &errors,
        elsewhere: &elsewhere,
    };
    let study = reader.keep(whole(&reader, file));
    let text = |error| StudyError::Text {
        error: Box::new(error),
        source_text: source.to_owned(),
    };
    let here = errors.finish(Ok(())).map_err(text).err();
    let mut wrong: Vec<_> = here.into_iter().chain(elsewhere.into_inner()).collect();
    match study {
        Some(study) if wrong.is_empty() => return Ok(study),
        None if wrong.is_empty() => {
            let nothing = CaseError::new(&name, source, 0..0, "the study cannot be read", None);
            wrong.push(text(nothing));
        }
        _ => {}
    }
    Err(StudyError::of_all(wrong))
}

/// The study, if it is whole; all that is wrong is recorded.
fn whole(reader: &Reader<'_>, file: &Path) -> Result<Study> {
    let (tree, wrong) = DeTable::parse_recoverable(reader.source);
    let mut starts: Vec<usize> = Vec::new();
    for e in wrong {
        let span = e.span().unwrap_or(0..0);
        let line = reader.source[..span.start].matches('\n').count();
        // What follows in the same line is mostly of the parser's own making.
        if !starts.contains(&line) {
            starts.push(line);
            let message = format!("this is not TOML: {}", e.message());
            reader.check(Err(reader.error(
                span,
                message,
                "see docs/reference/studies.md",
            )));
        }
    }
    if !starts.is_empty() {
        return Err(Wrong::Recorded);
    }
    let root = Table::new(*reader, tree.get_ref(), 0..0, "the study", &STUDY);
    let title = root.optional("title", |v| reader.text(v, "title"));
    let output = reader.keep(output(&root));
    let folder = file.parent().unwrap_or(Path::new(""));
    let context = reader
        .keep(context(&root, folder))
        .unwrap_or_else(|| Context::unknown(folder));
    let read = reader.keep(variables(&root, &context));
    let whole = read.as_ref().filter(|v| v.whole);
    let design = reader.keep(design(&root, whole.map(|v| &*v.variables)));
    let ida = root.optional("ida", |value| {
        let measure = read
            .as_ref()
            .and_then(|v| v.variables.iter().find_map(intensity_of));
        let both = whole.map(|v| ida_variables(reader, value, &v.variables));
        let both = both.and_then(|b| reader.keep(b));
        ida::settings(reader, value, &context, both, measure)
    });
    let (Some(base), Some(read), Some((chunk, demand)), Some(design)) =
        (context.base, read, output, design)
    else {
        return Err(Wrong::Recorded);
    };
    Ok(Study {
        title: title.unwrap_or_default(),
        file: file.to_owned(),
        source: reader.source.to_owned(),
        variables: read.variables,
        design,
        chunk,
        isolated_demand: demand || ida.is_some(),
        ida,
        records: read
            .records
            .unwrap_or_else(|| vec![records::of_case(&base.case)]),
        base: base.case,
    })
}

/// The case and what can be known of it.
fn context<'c>(root: &Table<'_, '_>, folder: &'c Path) -> Result<Context<'c>> {
    let reader = root.reader;
    let value = root.required("case")?;
    let path = folder.join(reader.text(value, "case")?);
    let source = pounding_case::read_text(&path, "case").map_err(|e| {
        let relative = "`case` is relative to the folder of the study".to_owned();
        let help = match path.is_file() {
            true => e.help.clone().unwrap_or(relative),
            false => relative,
        };
        reader.error(value.span(), e.to_string(), help)
    })?;
    // Without records of its own the study takes that of the case.
    let variables = root.get("variable").and_then(|v| v.get_ref().as_array());
    let names_records = |v: &Value<'_>| {
        let table = v.get_ref().as_table();
        table.is_some_and(|t| {
            t.keys()
                .any(|k| matches!(&**k.get_ref(), "records" | "synthetic"))
        })
    };
    let own_record = !variables.into_iter().flatten().any(names_records);
    let base = base(&source, &path, own_record).map_err(|e| reader.elsewhere(e));
    Ok(Context {
        base: base.ok(),
        text: Some(source).filter(|text| DeTable::parse(text).is_ok()),
        folder,
    })
}

/// The case, if it is sound.
fn base(source: &str, path: &Path, own_record: bool) -> std::result::Result<Base, StudyError> {
    let error = |e| StudyError::Text {
        error: Box::new(e),
        source_text: source.to_owned(),
    };
    let case = parse_case(source, path, own_record).map_err(error)?;
    let unit = AccelerationUnit::MetrePerSecondSquared;
    let at_rest = Accelerogram::new(vec![0.0; 2], unit, 1.0)?;
    let system = match assemble_with_record(&case, &at_rest) {
        Ok(assembly) => assembly.system,
        Err(e) => match with_all(e, &case, own_record) {
            AssemblyError::Case(e) => return Err(error(e)),
            e => return Err(e.into()),
        },
    };
    let first = |b: &std::sync::Arc<_>| {
        let building: &pounding_shear_building::ShearBuilding = b;
        building.modes().period.iter().copied().fold(0.0, f64::max)
    };
    let first_periods = system.buildings().iter().map(first).collect();
    Ok(Base {
        case,
        first_periods,
    })
}

/// The variables that could be read.
struct Variables {
    variables: Vec<Variable>,
    /// Whether these are all.
    whole: bool,
    records: Option<Vec<RecordSource>>,
}

fn variables(root: &Table<'_, '_>, context: &Context<'_>) -> Result<Variables> {
    let reader = root.reader;
    let items = reader.list(root.required("variable")?, "variable")?;
    let mut read = Variables {
        variables: Vec::new(),
        whole: !root.misspelt("variable"),
        records: None,
    };
    for item in items {
        let sound = variable(&reader, item, context).and_then(|(variable, named)| {
            if named.is_some() && read.records.is_some() {
                return Err(reader.error(
                    item.span(),
                    "records are given twice",
                    "put them into one list",
                ));
            }
            if let Some(other) = read.variables.iter().find(|v| collide(v, &variable)) {
                let both = format!(
                    "\"{}\" and \"{}\" vary the same entry",
                    other.name, variable.name
                );
                return Err(reader.error(item.span(), both, "remove one of them"));
            }
            if read.variables.iter().any(|v| v.name == variable.name) {
                return Err(reader.error(
                    item.span(),
                    format!("two variables have the name \"{}\"", variable.name),
                    "give each its own `name`",
                ));
            }
            Ok((variable, named))
        });
        match reader.keep(sound) {
            Some((variable, named)) => {
                read.variables.push(variable);
                read.records = read.records.or(named);
            }
            None => read.whole = false,
        }
    }
    Ok(read)
}

/// Whether two variables change the same bytes of the case, or the same property of the
/// motion.
fn collide(a: &Variable, b: &Variable) -> bool {
    let overlap = |a: &std::ops::Range<usize>, b: &std::ops::Range<usize>| {
        a == b || (a.start < b.end && b.start < a.end)
    };
    let spans = |v: &Variable| match &v.target {
        Target::Entry { entry, .. } => vec![(entry.span.clone(), entry.before.clone())],
        Target::Model { edits } => edits.first().map_or_else(Vec::new, |edits| {
            // A model puts new lines where another absent key might go: no collision.
            let old = edits.iter().filter(|(_, new)| new.is_empty());
            old.map(|(span, _)| (span.clone(), String::new())).collect()
        }),
        _ => Vec::new(),
    };
    match (&a.target, &b.target) {
        (Target::Intensity(_), Target::Intensity(_)) => true,
        // An intensity sets the scale, and a record all other keys of the motion.
        (Target::Entry { path, .. }, Target::Intensity(_))
        | (Target::Intensity(_), Target::Entry { path, .. }) => path.of_scale(),
        (Target::Entry { path, .. }, Target::Record)
        | (Target::Record, Target::Entry { path, .. }) => {
            path.table() == "ground_motion" && !path.of_scale()
        }
        _ => spans(a).iter().any(|(s, before)| {
            spans(b)
                .iter()
                .any(|(t, other)| overlap(s, t) && before == other)
        }),
    }
}

/// Kinds of designs.
const KINDS: [&str; 4] = ["grid", "list", "latin_hypercube", "sobol"];

fn design(root: &Table<'_, '_>, variables: Option<&[Variable]>) -> Result<Design> {
    let reader = root.reader;
    let variables = variables.ok_or(Wrong::Recorded);
    let Some(value) = root.get("design") else {
        return match root.lacks("design") {
            true => Err(Wrong::Recorded),
            false => grid(&reader, root.span.clone(), variables?),
        };
    };
    let table = reader.table(value, "[design]", &DESIGN)?;
    let runs = table.optional("runs", |v| reader.count(v, "runs", 1));
    let seed = table.optional("seed", |v| reader.count(v, "seed", 0));
    let kind = table.or("kind", "grid".to_owned(), |v| reader.text(v, "kind"))?;
    let place = table.get("kind").unwrap_or(value).span();
    if !KINDS.contains(&kind.as_str()) {
        let help = format!("known are {}", KINDS.join(", "));
        return Err(reader.error(place, format!("unknown design \"{kind}\""), help));
    }
    if matches!(kind.as_str(), "grid" | "list") {
        for key in ["runs", "seed"] {
            if let Some(v) = table.get(key) {
                let message = format!("`{key}` has no meaning for {kind}");
                reader.check(Err(reader.error(v.span(), message, "remove it")));
            }
        }
        return match kind.as_str() {
            "grid" => grid(&reader, place, variables?),
            _ => list(&reader, &place, variables?),
        };
    }
    table.required("runs")?;
    let runs = runs.ok_or(Wrong::Recorded)?;
    let seed = seed.map(|s| s as u64);
    if kind == "sobol" {
        return Design::sobol(runs, seed, variables?.len())
            .map_err(|reason| reader.error(place, reason, "use latin_hypercube"));
    }
    Ok(Design::LatinHypercube {
        runs,
        seed: seed.unwrap_or(1),
    })
}

fn grid(
    reader: &Reader<'_>,
    place: std::ops::Range<usize>,
    variables: &[Variable],
) -> Result<Design> {
    let sizes = reader.all(variables.iter().map(|v| {
        v.values.count().ok_or_else(|| {
            reader.error(
                place.clone(),
                format!(
                    "the range of \"{}\" has no `count`, which a grid needs",
                    v.name
                ),
                "add `count = ...` to the variable",
            )
        })
    }))?;
    let runs = sizes.iter().try_fold(1_usize, |n, s| n.checked_mul(*s));
    // Numbers of runs stay exact in the results.
    match runs.filter(|n| *n <= 1 << 48) {
        Some(_) => Ok(Design::Grid { sizes }),
        None => Err(reader.error(
            place,
            "the grid has more runs than can be counted",
            "make it coarser",
        )),
    }
}

fn list(
    reader: &Reader<'_>,
    place: &std::ops::Range<usize>,
    variables: &[Variable],
) -> Result<Design> {
    let mut counts = variables.iter().map(|v| (&v.name, v.values.count()));
    let first = counts.next().and_then(|(_, n)| n);
    match (first, counts.find(|(_, n)| *n != first)) {
        (Some(runs), None) => Ok(Design::List { runs }),
        (None, _) => Err(reader.error(place.clone(), "a range without `count` is no list", "add `count = ...`, or give `values`")),
        (_, Some((name, _))) => Err(reader.error(
            place.clone(),
            format!("a list takes one value of each variable for every run, but \"{name}\" has another number of them than the first"),
            "give all variables as many values, or use kind = \"grid\"",
        )),
    }
}

fn output(root: &Table<'_, '_>) -> Result<(usize, bool)> {
    let Some(value) = root.get("output") else {
        return Ok((CHUNK, false));
    };
    let reader = root.reader;
    let table = reader.table(value, "[output]", &OUTPUT)?;
    let chunk = table.or("chunk", CHUNK, |v| reader.count(v, "chunk", 1));
    let demand = table.or("isolated_demand", false, |v| {
        reader.flag(v, "isolated_demand")
    });
    let (chunk, demand) = (reader.keep(chunk), reader.keep(demand));
    chunk.zip(demand).ok_or(Wrong::Recorded)
}

/// The measure of a variable that is an intensity.
fn intensity_of(variable: &Variable) -> Option<IntensityMeasure> {
    match &variable.target {
        Target::Intensity(measure) => Some(measure.clone()),
        _ => None,
    }
}

/// Indices of the two variables that an incremental dynamic analysis is made of: the record
/// and the intensity.
fn ida_variables(
    reader: &Reader<'_>,
    place: &Value<'_>,
    variables: &[Variable],
) -> Result<(usize, usize)> {
    let at = |is: &dyn Fn(&Variable) -> bool| variables.iter().position(is);
    let record = at(&|v| matches!(v.target, Target::Record));
    let intensity = at(&|v| intensity_of(v).is_some());
    match (record, intensity) {
        (Some(record), Some(intensity)) if variables.len() == 2 => {
            match variables[intensity].values {
                Values::Range { count: None, .. } => {}
                _ => return Ok((record, intensity)),
            }
            Err(reader.error(
                place.span(),
                "the range of intensities has no `count`",
                "add `count = ...`",
            ))
        }
        _ => Err(reader.error(
            place.span(),
            "an incremental dynamic analysis has two variables: `records` and `intensity`",
            "give these two, or remove [ida]",
        )),
    }
}
