//! How the record of the case is read in runs whose variables say so: with each set of their
//! values it is another motion.

use std::collections::BTreeMap;
use std::ops::Range;

use pounding_case::document::Reader;
use pounding_case::{Case, CaseTree};

use super::{Design, RecordKind, RecordSource, Study, Target, Value, Variable};
use crate::case_text::{Path, Variant};
use crate::gap_check::name_of_record;

/// Most ways in which a study reads the record of the case: each is kept as long as it runs.
const MOST_READINGS: usize = 10_000;

/// Which motion a run has, by the bits of the values that say how it is read; empty where none
/// of them varies.
pub(crate) type Readings = BTreeMap<Vec<u64>, usize>;

impl Variable {
    /// Whether it says how the record of the case is read.
    pub(super) fn of_reading(&self) -> bool {
        self.target.paths().any(Path::of_reading)
    }
}

impl Study {
    /// Whether its motions differ by their files alone.
    pub(crate) fn reads_one_way(&self) -> bool {
        let mut reading = self.variables.iter().filter(|v| v.of_reading());
        reading.all(|v| v.target.paths().all(Path::of_motion_file))
    }

    /// Which motion a run of these values has.
    pub(crate) fn motion_of(&self, point: &[Value]) -> usize {
        if !self.readings.is_empty() {
            return self.readings[&bits(&self.variables, point)];
        }
        let mut values = self.variables.iter().zip(point);
        let chosen = values.find_map(|(v, x)| match (&v.target, x) {
            (Target::Record, Value::Choice(i)) => Some(*i),
            _ => None,
        });
        chosen.unwrap_or(0)
    }
}

/// The values that say how the record is read.
fn read_by<'v>(
    variables: &'v [Variable],
    point: &'v [Value],
) -> impl Iterator<Item = (&'v Variable, &'v Value)> {
    let values = variables.iter().zip(point);
    values.filter(|(variable, _)| variable.of_reading())
}

fn bits(variables: &[Variable], point: &[Value]) -> Vec<u64> {
    read_by(variables, point).map(|(_, x)| x.bits()).collect()
}

/// The motions of a study without records of its own, and which of them runs have; `place` is
/// that of a variable that says how the record is read.
pub(super) fn readings(
    reader: &Reader<'_>,
    place: Range<usize>,
    (variables, design): (&[Variable], &Design),
    base: &Case,
) -> Option<(Vec<RecordSource>, Readings)> {
    let varied: Vec<Variable> = variables
        .iter()
        .filter(|v| v.of_reading())
        .cloned()
        .collect();
    // Those of a grid without its other variables; of samples that are more than these, too.
    let sizes: Option<Vec<usize>> = varied.iter().map(|v| v.values.count()).collect();
    let product = sizes.and_then(|sizes| {
        let runs = sizes
            .iter()
            .try_fold(1_usize, |n, size| n.checked_mul(*size));
        Some((Design::Grid { sizes }, runs?))
    });
    let (design, variables) = match product {
        Some((grid, runs)) if matches!(design, Design::Grid { .. }) || runs < design.runs() => {
            (grid, &*varied)
        }
        _ => (design.clone(), variables),
    };
    let tree = CaseTree::parse(&base.source, &base.file).ok()?;
    let mut readings = Readings::new();
    let mut sources = Vec::new();
    for run in 0..design.runs() {
        let point = design.point(run, variables);
        let bits = bits(variables, &point);
        if readings.contains_key(&bits) {
            continue;
        }
        if sources.len() == MOST_READINGS {
            let message = format!(
                "the record of the case would be read in more than {MOST_READINGS} ways, each of which is kept in memory"
            );
            let help = "give such variables fewer values: by `values`, or in a grid by `count`";
            return reader.refuse(place, message, help);
        }
        readings.insert(bits, sources.len());
        sources.push(source(variables, &point, &tree, base));
    }
    Some((sources, readings))
}

/// The record of the case, read with these values.
fn source(
    variables: &[Variable],
    point: &[Value],
    tree: &CaseTree<'_>,
    base: &Case,
) -> RecordSource {
    let values = || read_by(variables, point);
    let edits: Vec<_> = values().flat_map(|(v, x)| v.target.edits(x)).collect();
    let case = Variant::new(tree, &edits).case();
    let file = &case.as_ref().unwrap_or(base).ground_motion.file.value;
    let said: Vec<String> = values().map(|(v, x)| v.without_unit(x)).collect();
    RecordSource {
        name: format!("{} ({})", name_of_record(file), said.join(", ")),
        kind: match case {
            Ok(case) => RecordKind::File {
                case: Box::new(case),
                edits: Vec::new(),
            },
            Err(error) => RecordKind::Refused(Box::new(error)),
        },
        missing: None,
    }
}
