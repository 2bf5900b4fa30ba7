//! From the TOML tree to a study.

use std::path::Path;

use pounding_assembly::{AssemblyError, assemble_with_record};
use pounding_case::{Case, CaseError, Errors};
use pounding_ground_motion::{AccelerationUnit, Accelerogram};
use toml::de::DeTable;

use crate::faults::{parse_case, with_all};

use super::reader::{Reader, Result, Table, Value};
use super::variables::{Context, variable};
use super::{RecordSource, Study, Target, Values, Variable, ida, records};
use crate::design::Design;
use crate::error::StudyError;

const STUDY: [&str; 6] = ["title", "case", "variable", "design", "output", "ida"];
const DESIGN: [&str; 3] = ["kind", "runs", "seed"];
const OUTPUT: [&str; 2] = ["chunk", "isolated_demand"];
/// Runs of a chunk unless the study says otherwise: a second or less of work that can be
/// lost, and files that are not too many.
const CHUNK: usize = 256;

pub(super) fn study(source: &str, file: &Path) -> Result<Study> {
    let name = file.display().to_string();
    let errors = Errors::default();
    let reader = Reader {
        file: &name,
        source,
        errors: &errors,
    };
    // What is wrong elsewhere, such as in the case, comes after all that is wrong here.
    let (study, elsewhere) = match whole(&reader, file).map(|s| reader.keep(Ok(s))) {
        Ok(study) => (study?, None),
        Err(e) => match reader.keep(Err(e)) {
            Ok(study) => (study, None),
            Err(e) => (None, Some(e)),
        },
    };
    let text = |error| StudyError::Text {
        error: Box::new(error),
        source_text: source.to_owned(),
    };
    errors.finish(Ok(())).map_err(text)?;
    match (study, elsewhere) {
        (Some(study), _) => Ok(study),
        (None, Some(e)) => Err(e),
        (None, None) => {
            let error = CaseError::new(&name, source, 0..0, "the study cannot be read", None);
            Err(text(error))
        }
    }
}

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
            reader.keep(Err::<(), _>(reader.error(
                span,
                message,
                "see docs/reference/studies.md",
            )))?;
        }
    }
    if !starts.is_empty() {
        return Err(reader.lost());
    }
    let root = Table::open(*reader, tree.get_ref(), 0..0, "the study", &STUDY);
    let title = reader.keep(
        root.get("title")
            .map(|v| reader.text(v, "title"))
            .transpose(),
    )?;
    let output = reader.keep(output(&root))?;
    let folder = file.parent().unwrap_or(Path::new(""));
    let base = base(&root, folder)?;
    let first_periods = first_periods(&base)?;
    let context = Context {
        base: &base,
        folder,
        first_periods: &first_periods,
    };
    let (variables, records) = variables(&root, &context)?;
    if root.lacks("variable") {
        return Err(reader.lost());
    }
    let design = reader.keep(design(&root, &variables))?;
    let ida = match root.get("ida") {
        Some(value) => {
            let chosen = ida_variables(reader, value, &variables)?;
            Some(ida::settings(reader, value, &base, folder, chosen)?)
        }
        None => None,
    };
    let (Some(title), Some((chunk, demand)), Some(design)) = (title, output, design) else {
        return Err(reader.lost());
    };
    Ok(Study {
        title: title.unwrap_or_default(),
        file: file.to_owned(),
        source: reader.source.to_owned(),
        variables,
        design,
        chunk,
        isolated_demand: demand || ida.is_some(),
        ida,
        records: records.unwrap_or_else(|| vec![records::of_case(&base)]),
        base,
    })
}

fn base(root: &Table<'_, '_>, folder: &Path) -> Result<Case> {
    let value = root.required("case")?;
    let path = folder.join(root.reader.text(value, "case")?);
    let source = pounding_case::read_text(&path, "case").map_err(|e| {
        let relative = "`case` is relative to the folder of the study".to_owned();
        let help = match path.is_file() {
            true => e.help.clone().unwrap_or(relative),
            false => relative,
        };
        root.reader.error(value.span(), e.to_string(), help)
    })?;
    let error = |e| StudyError::Text {
        error: Box::new(e),
        source_text: source.clone(),
    };
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
    let case = parse_case(&source, &path, own_record).map_err(error)?;
    match assemble_with_record(&case, &two_samples()?) {
        Err(e) => match with_all(e, &case, own_record) {
            AssemblyError::Case(e) => Err(error(e)),
            e => Err(e.into()),
        },
        Ok(_) => Ok(case),
    }
}

fn two_samples() -> Result<Accelerogram> {
    let unit = AccelerationUnit::MetrePerSecondSquared;
    Ok(Accelerogram::new(vec![0.0; 2], unit, 1.0)?)
}

/// First period of each building.
fn first_periods(base: &Case) -> Result<Vec<f64>> {
    let system = assemble_with_record(base, &two_samples()?)?.system;
    let first = |b: &std::sync::Arc<_>| {
        let building: &pounding_shear_building::ShearBuilding = b;
        building.modes().period.iter().copied().fold(0.0, f64::max)
    };
    Ok(system.buildings().iter().map(first).collect())
}

fn variables(
    root: &Table<'_, '_>,
    context: &Context<'_>,
) -> Result<(Vec<Variable>, Option<Vec<RecordSource>>)> {
    let reader = root.reader;
    let value = root.required("variable")?;
    let mut variables: Vec<Variable> = Vec::new();
    let mut records = None;
    let items = reader.list(value, "variable")?;
    let read = reader.all(items.iter().map(|item| variable(&reader, item, context)))?;
    for (item, (variable, named)) in items.iter().zip(read) {
        if let Some(named) = named {
            if records.is_some() {
                return Err(reader.error(
                    item.span(),
                    "records are given twice",
                    "put them into one list",
                ));
            }
            records = Some(named);
        }
        if let Some(other) = variables.iter().find(|v| collide(v, &variable)) {
            return Err(reader.error(
                item.span(),
                format!(
                    "\"{}\" and \"{}\" vary the same entry",
                    other.name, variable.name
                ),
                "remove one of them",
            ));
        }
        if variables.iter().any(|v| v.name == variable.name) {
            return Err(reader.error(
                item.span(),
                format!("two variables have the name \"{}\"", variable.name),
                "give each its own `name`",
            ));
        }
        variables.push(variable);
    }
    Ok((variables, records))
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

fn design(root: &Table<'_, '_>, variables: &[Variable]) -> Result<Design> {
    let reader = root.reader;
    let Some(value) = root.get("design") else {
        return grid(root, root.span.clone(), variables);
    };
    let table = reader.table(value, "[design]", &DESIGN)?;
    let (kind, place) = match table.get("kind") {
        Some(v) => (reader.text(v, "kind")?, v.span()),
        None => ("grid".to_owned(), value.span()),
    };
    if !KINDS.contains(&kind.as_str()) {
        let help = format!("known are {}", KINDS.join(", "));
        return Err(reader.error(place, format!("unknown design \"{kind}\""), help));
    }
    let counted = matches!(kind.as_str(), "grid" | "list");
    for key in ["runs", "seed"] {
        if let (Some(v), true) = (table.get(key), counted) {
            let message = format!("`{key}` has no meaning for {kind}");
            return Err(reader.error(v.span(), message, "remove it"));
        }
    }
    match kind.as_str() {
        "grid" => return grid(root, place, variables),
        "list" => return list(&reader, &place, variables),
        _ => {}
    }
    let runs = reader.count(table.required("runs")?, "runs", 1)?;
    let seed = table.get("seed").map(|v| reader.count(v, "seed", 0));
    let seed = seed.transpose()?.map(|s| s as u64);
    if kind == "sobol" {
        return Design::sobol(runs, seed, variables.len())
            .map_err(|reason| reader.error(place, reason, "use latin_hypercube"));
    }
    Ok(Design::LatinHypercube {
        runs,
        seed: seed.unwrap_or(1),
    })
}

fn grid(
    root: &Table<'_, '_>,
    place: std::ops::Range<usize>,
    variables: &[Variable],
) -> Result<Design> {
    let sizes = variables.iter().map(|v| {
        v.values.count().ok_or_else(|| {
            root.reader.error(
                place.clone(),
                format!(
                    "the range of \"{}\" has no `count`, which a grid needs",
                    v.name
                ),
                "add `count = ...` to the variable",
            )
        })
    });
    let sizes = sizes.collect::<Result<Vec<_>>>()?;
    let runs = sizes.iter().try_fold(1_usize, |n, s| n.checked_mul(*s));
    // Numbers of runs stay exact in the results.
    match runs.filter(|n| *n <= 1 << 48) {
        Some(_) => Ok(Design::Grid { sizes }),
        None => Err(root.reader.error(
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
    let chunk = table
        .get("chunk")
        .map_or(Ok(CHUNK), |v| reader.count(v, "chunk", 1))?;
    let demand = table
        .get("isolated_demand")
        .map_or(Ok(false), |v| reader.flag(v, "isolated_demand"))?;
    Ok((chunk, demand))
}

/// The variables that an incremental dynamic analysis is made of.
fn ida_variables(
    reader: &Reader<'_>,
    place: &Value<'_>,
    variables: &[Variable],
) -> Result<(usize, usize, super::IntensityMeasure)> {
    let record = variables
        .iter()
        .position(|v| matches!(v.target, Target::Record));
    let intensity = variables
        .iter()
        .enumerate()
        .find_map(|(i, v)| match &v.target {
            Target::Intensity(measure) => Some((i, measure.clone())),
            _ => None,
        });
    match (record, intensity) {
        (Some(record), Some((intensity, measure))) if variables.len() == 2 => {
            match variables[intensity].values {
                Values::Range { count: None, .. } => {}
                _ => return Ok((record, intensity, measure)),
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
