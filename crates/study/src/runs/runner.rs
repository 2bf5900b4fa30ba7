//! One run of a study: from its number to its row.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;

use pounding_assembly::{
    AssemblyError, assemble_at_rest, assemble_without_gaps, methods_that_take, regap, scale_record,
};
use pounding_case::{Case, CaseTree};
use pounding_ground_motion::Accelerogram;
use pounding_time_history::{
    GroundAcceleration, Outcome, RunOptions, System, TimeHistoryError, Warning, isolated_demand,
    run,
};
use sha2::{Digest, Sha256};

use super::cache::Cache;
use super::motion::Motion;
use super::motion_set::Motions;
use super::named_files::named_files;
use super::proportion::{factors_of_further, intensity_of_case};
use super::structures::{looked_at, warnings_of_structures};
use super::varied::leave_out_varied;
use pounding_results::study::isolated_peaks;

use super::{Ending, ID, IsolatedQuantities, IsolatedRun, Layout, Row};
use crate::case_text::{self, Edit, Lines, Variant, apply, canonical};
use crate::error::StudyError;
use crate::gap_check::{Repeated, of_each_record, of_reading};
use crate::study_file::{
    Design, IntensityMeasure, RecordKind, Study, Target, Value, Values, Variable,
    beside_that_across, on_grounds_of_their_own,
};
use pounding_files::checksum::hexadecimal;

/// Buildings and motions kept for runs to come.
const KEPT: usize = 64;

/// Makes runs.
#[derive(Debug)]
pub(crate) struct Runner<'s> {
    pub study: &'s Study,
    pub motions: Motions,
    pub layout: Layout,
    /// The floors that meet at its contact levels.
    levels: Vec<(String, [Option<usize>; 2])>,
    /// The storeys that are joined at the levels of each link.
    joined: Vec<Vec<[Option<usize>; 2]>>,
    /// What the user should know of the case.
    pub warnings: Vec<String>,
    version: &'static str,
    base: CaseTree<'s>,
    /// What the case says.
    lines: Lines,
    /// Hashes of matrices, target spectra, further records and forces, which the case says by the
    /// names of their files alone.
    named_files: Vec<String>,
    /// Intensity (SI) of the record of the case, to which further records keep their proportion.
    intensity_of_case: Option<f64>,
    buildings: Cache<Result<Arc<System>, String>>,
    isolated: Cache<Result<Arc<IsolatedRun>, String>>,
}

/// The version that counts in identities.
const VERSION: &str = env!("CARGO_PKG_VERSION");

impl<'s> Runner<'s> {
    /// Prepares the runs of a study; records are shared with other shards in their folder.
    pub(crate) fn new(
        study: &'s Study,
        keep_failures: bool,
        folder: Option<&Path>,
    ) -> Result<Self, StudyError> {
        let motions = Motions::read(study, keep_failures, folder)?;
        let mut base = study.base.clone();
        if varies(study, "analysis.method") {
            // Keys that one method does not take are for others.
            base.analysis.places.clear();
        }
        let assembly = assemble_at_rest(&base)?;
        let averaged = assembly.warnings_of_buildings();
        let system = assembly.system;
        let isolated = IsolatedQuantities {
            demand: study.isolated_demand,
            peaks: study.isolated_peaks,
        };
        let of_seat = |v: &Variable| v.target.paths().any(case_text::Path::of_seat);
        let brings_seat = study.variables.iter().any(of_seat);
        let mut layout = Layout::of(&system, isolated, brings_seat);
        let levels = floors_that_meet(&system).map(|(gap, sides)| (gap.to_owned(), sides));
        let levels = levels.collect();
        let joined = joined_storeys(&system);
        let mut missing = Vec::new();
        if let Some(names) = &study.quantities {
            let has = |name: &&String| layout.quantities.iter().any(|q| q.name == name.as_str());
            // All that storeys have without pounding are chosen together.
            let without_pounding: Vec<&str> = isolated_peaks().collect();
            let all = without_pounding
                .iter()
                .all(|own| names.iter().any(|name| name == own));
            let chosen = |name: &&String| !(all && without_pounding.contains(&name.as_str()));
            missing.extend(
                names
                    .iter()
                    .filter(|name| !has(name) && chosen(name))
                    .cloned(),
            );
            layout.keep(names);
        }
        let varied = leave_out_varied(&mut layout, study, &system);
        let base =
            CaseTree::parse(&study.base.source, &study.base.file).map_err(AssemblyError::Case)?;
        let mut warnings = warnings_of_structures(study, &base, &system);
        warnings.extend(averaged);
        let meant = study.base.gaps.iter().filter(|g| g.floor_to_floor);
        warnings.extend(meant.filter(|g| varied.contains(&g.name)).map(|gap| {
            format!(
                "gap {}: storey heights vary, and floors act on each other as if they were level at whatever elevations (floor_to_floor); the columns that such floors hit are not modelled",
                gap.name
            )
        }));
        warnings.extend(beside_that_across(study));
        warnings.extend(on_grounds_of_their_own(study));
        let told = || motions.all.iter().zip(&study.records);
        warnings.extend(of_reading(told().filter_map(|(motion, source)| {
            Some((source.name.as_str(), motion.as_ref().ok()?.warnings.clone()))
        })));
        warnings.extend(of_each_record(told().filter_map(|(motion, source)| {
            let (duration, peak) = (shortest_duration(study)?, motion.as_ref().ok()?.peak_time);
            let warning = Warning::ends_before_peak("", duration, peak)?;
            Some((source.name.as_str(), warning))
        })));
        if !missing.is_empty() {
            warnings.push(format!(
                "[output] chooses {}, which no building, gap or link of this study has",
                missing.join(", ")
            ));
        }
        let gridded = matches!(study.design, Design::Grid { .. } | Design::SampledGrid(_));
        let twice = study.variables.iter().filter(|_| gridded);
        warnings.extend(twice.filter_map(|v| {
            let repeated = v.repeated()?;
            Some(format!(
                "variable \"{}\" has the value {repeated} {} more than once: its runs are made, and count, as often",
                v.name, v.unit
            ))
        }));
        warnings.extend(study.variables.iter().filter_map(|v| v.asked.clone()));
        warnings.extend(study.ida.iter().flat_map(|ida| ida.asked.clone()));
        warnings.extend(study.variables.iter().filter_map(without_result));
        let joins = !layout.link_levels.is_empty();
        let varied_levels = study.variables.iter().filter(|_| joins);
        warnings.extend(varied_levels.filter_map(of_other_levels));
        warnings.extend(study.variables.iter().filter_map(model_named_twice));
        warnings.extend(
            study
                .variables
                .iter()
                .filter_map(|v| of_no_method(study, v)),
        );
        let known = |r: usize| Some(&motions.all[r].as_ref().ok()?.first);
        // One file that is read in several ways is no repetition.
        let once = study.reads_one_way();
        // In a list of an analysis a record has a name at each intensity.
        let is_list = matches!(study.design, Design::List { .. }) && study.ida.is_some();
        let named = match is_list {
            true => study.same_records(),
            false => (0..motions.all.len()).collect(),
        };
        let same = |a: usize, b: usize| {
            once && named[a] != named[b] && known(a).is_some() && known(a) == known(b)
        };
        let names: Vec<&str> = study.records.iter().map(|r| r.name.as_str()).collect();
        warnings.extend(Repeated::by(motions.all.len(), same).warnings(&names));
        let stores = |name: &str| layout.quantities.iter().any(|q| q.name == name);
        let rigid_of_case = has_rigid_impacts(&system);
        if stores("peak_acceleration_absolute") && may_be_rigid(study, &base, rigid_of_case) {
            warnings.push(JUMPS.to_owned());
        }
        Ok(Self {
            layout,
            levels,
            joined,
            warnings,
            lines: Lines::of(base.tree()),
            named_files: named_files(study),
            intensity_of_case: intensity_of_case(study)?,
            base,
            study,
            motions,
            version: VERSION,
            buildings: Cache::new(KEPT),
            isolated: Cache::new(KEPT),
        })
    }

    /// Reads the records that these runs use, as far as they are not read yet.
    pub(crate) fn need(
        &mut self,
        runs: &[usize],
        keep_failures: bool,
        folder: Option<&Path>,
    ) -> Result<(), StudyError> {
        let study = self.study;
        let wanted = runs.iter().map(|run| study.motion_of(&study.point(*run)));
        let wanted = wanted.collect();
        self.motions.need(study, &wanted, keep_failures, folder)
    }

    /// The text of the case of a run.
    pub(crate) fn text(study: &Study, point: &[Value]) -> String {
        apply(&study.base.source, &edits(study, point))
    }

    /// Makes a run. Whatever goes wrong is in the row.
    pub(crate) fn row(&self, number: usize) -> Row {
        let point = self.study.point(number);
        let edits = edits(self.study, &point);
        let variant = Variant::new(&self.base, &edits);
        let motion = self.motion(&point);
        let intensity = wanted(self.study, &point).map(|(_, x)| x);
        let factor = factor(intensity, motion);
        let mut row = Row {
            run: number,
            id: self.identity(
                &variant,
                self.source(&point),
                motion,
                factor.as_ref().ok().copied().flatten().or(intensity),
            ),
            values: Vec::new(),
            ending: Ending::Complete,
        };
        let made = catch_unwind(AssertUnwindSafe(|| {
            let motion = motion.map_err(Clone::clone)?;
            self.values(&point, &variant, motion, factor?)
        }));
        let values = made.unwrap_or_else(|panic| {
            Err(format!("the program broke off: {}", panic_message(&*panic)))
        });
        match values {
            Ok((values, ending)) => (row.values, row.ending) = (values, ending),
            Err(reason) => {
                row.ending = Ending::Failed(reason);
                row.values = vec![f64::NAN; self.layout.columns()];
            }
        }
        if self.study.float32 {
            // Here, so that every file and table of the run says the same.
            for value in &mut row.values {
                *value = f64::from(*value as f32);
            }
        }
        row
    }

    fn motion(&self, point: &[Value]) -> Result<&Motion, &String> {
        self.motions.all[self.study.motion_of(point)].as_ref()
    }

    fn source(&self, point: &[Value]) -> &str {
        &self.study.records[self.study.motion_of(point)].name
    }

    fn values(
        &self,
        point: &[Value],
        variant: &Variant<'_, '_>,
        motion: &Motion,
        factor: Option<f64>,
    ) -> Result<(Vec<f64>, Ending), String> {
        let said = |e: AssemblyError| e.to_string();
        let case = variant.case().map_err(|e| e.to_string())?;
        let read = motion.record.as_ref().ok_or_else(unread)?;
        let scaled = |case: &Case| scaled(case, read, factor);
        let record = variant.make(&case, scaled).map_err(said)?;
        let key = key(self.study, point);
        let base = self.buildings.get(&key.buildings, || {
            // Without gaps, which are those of this run alone.
            let assembled = |case: &Case| assemble_without_gaps(case, &record);
            let system = variant.make(&case, assembled).map_err(said)?;
            Ok(Arc::new(system))
        })?;
        let base = if key.motion.is_empty() {
            base
        } else {
            Arc::new(base.under(GroundAcceleration {
                samples: record.shared_samples(),
                time_step: record.time_step(),
            }))
        };
        let base = match factor {
            // All that moves the ground is scaled as its first motion is.
            Some(scale) if base.has_further_records() => {
                let (_, intensity) = wanted(self.study, point).ok_or_else(unread)?;
                let brought = (&**read, intensity, scale);
                let brings = self.study.records[self.study.motion_of(point)]
                    .kind
                    .brings_across();
                let factors =
                    |case: &Case| factors_of_further(case, self.intensity_of_case, brings, brought);
                let by = variant.make(&case, factors).map_err(said)?;
                Arc::new(base.with_further_records_scaled(by.of_buildings, by.across))
            }
            _ => base,
        };
        let regapped = |case: &Case| regap(case, &base);
        let (system, options) = variant.make(&case, regapped).map_err(said)?;
        let (found, expected) = (system.floors(), self.layout.storeys.len());
        if found != expected {
            return Err(format!("the run has {found} storeys, the study {expected}"));
        }
        let expected = || self.levels.iter().map(|(gap, sides)| (&**gap, *sides));
        if !floors_that_meet(&system).eq(expected()) {
            return Err(format!(
                "other floors meet in the run than in the case of the study, whose contact levels all results have: {} for {}; make a study of its own for each set of levels",
                listed(floors_that_meet(&system)),
                listed(expected())
            ));
        }
        let matrices = system
            .buildings()
            .iter()
            .filter(|b| b.stiffness().is_empty());
        let (found, expected) = (matrices.count(), self.layout.buildings.len());
        if found != expected {
            return Err(format!(
                "{found} buildings of the run have a stiffness matrix or a foundation, {expected} of the study"
            ));
        }
        let outcome = match run(&system, &options, &mut [], &mut |_| {}) {
            Ok(mut outcome) => {
                self.keep_levels_of_links(&system, &mut outcome);
                Ok(outcome)
            }
            Err(e @ TimeHistoryError::Collapse { .. }) => Err(e.to_string()),
            Err(e) => return Err(e.to_string()),
        };
        let isolated = if self.study.isolated_demand || self.study.isolated_peaks {
            let all: Vec<u64> = key.buildings.iter().chain(&key.motion).copied().collect();
            self.isolated
                .get(&all, || apart(&system, &options).map(Arc::new))?
        } else {
            Arc::default()
        };
        let mut values = Vec::with_capacity(self.layout.columns());
        match outcome {
            Ok(outcome) => {
                self.layout.fill(&outcome, &isolated, &mut values);
                Ok((values, Ending::Complete))
            }
            Err(collapse) => {
                self.layout.fill_collapsed(&isolated, &mut values);
                Ok((values, Ending::Collapsed(collapse)))
            }
        }
    }

    /// Gives the links of a run the levels that they have in the case of the study. What a run does
    /// not have is missing.
    fn keep_levels_of_links(&self, system: &System, outcome: &mut Outcome) {
        let found = joined_storeys(system);
        if found == self.joined {
            return;
        }
        let pairs = self.joined.iter().zip(&found);
        for (link, (expected, found)) in outcome.links.iter_mut().zip(pairs) {
            let Some(mut missing) = link.levels.first().copied() else {
                continue;
            };
            missing.force.value = f64::NAN;
            missing.deformation.value = f64::NAN;
            let mut own = found.iter().zip(&link.levels).peekable();
            // Both from the bottom.
            let level = |storeys: &[Option<usize>; 2]| {
                while own
                    .next_if(|(found, _)| found != &storeys && !expected.contains(found))
                    .is_some()
                {}
                own.next_if(|(found, _)| found == &storeys)
                    .map_or(missing, |(_, level)| *level)
            };
            link.levels = expected.iter().map(level).collect();
        }
    }

    /// Identity of a run; that of a motion which cannot be read depends on its name, and the
    /// factor on the intensity wanted.
    fn identity(
        &self,
        variant: &Variant<'_, '_>,
        name: &str,
        motion: Result<&Motion, &String>,
        factor: Option<f64>,
    ) -> [u8; ID] {
        let mut hash = Sha256::new();
        hash.update(variant.canonical(&self.lines));
        hash.update([0]);
        match motion {
            Ok(motion) => hash.update(&motion.sha256),
            Err(_) => hash.update(format!("unreadable {name}")),
        }
        hash.update(factor.map_or([0; 8], f64::to_le_bytes));
        if let Some(of_case) = self.intensity_of_case {
            hash.update(of_case.to_le_bytes());
        }
        hash.update(self.version);
        self.named_files.iter().for_each(|f| hash.update(f));
        let mut id = [0; ID];
        id.copy_from_slice(&hash.finalize()[..ID]);
        id
    }

    /// Identity of the whole study: all that decides what its runs are and in which
    /// columns their results stand. What computes them is told apart by [`crate::BUILD`].
    pub(crate) fn study_identity(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(canonical(&self.study.base.source));
        hash.update([0]);
        // What is made of the results afterwards changes none of them.
        for line in canonical(&self.study.source)
            .lines()
            .filter(|l| !l.starts_with("ida."))
        {
            hash.update(line);
            hash.update([0]);
        }
        for motion in &self.motions.all {
            hash.update(motion.as_ref().map_or("unreadable", |m| m.sha256.as_str()));
        }
        hash.update(self.layout.signature());
        if let Some(of_case) = self.intensity_of_case {
            hash.update(of_case.to_le_bytes());
        }
        self.named_files.iter().for_each(|f| hash.update(f));
        hexadecimal(&hash.finalize())
    }
}

/// The warning of a variable that has a model or law under two of its names.
fn model_named_twice(variable: &Variable) -> Option<String> {
    let Values::Choices(names) = &variable.values else {
        return None;
    };
    let path = variable.target.paths().find(|path| path.of_model())?;
    let known = |name: &String| match pounding_gap_element::registry::find(name) {
        Ok(model) if path.of_gap() => model.name,
        _ => pounding_hysteresis::find(name).map_or("", |law| law.name),
    };
    names.iter().enumerate().find_map(|(i, name)| {
        let own = known(name);
        let before = &names[..i];
        let first = before.iter().find(|other| !own.is_empty() && known(other) == own)?;
        Some(format!(
            "variable \"{}\" has the model {own} more than once, as \"{first}\" and \"{name}\": its runs are made, and count, as often",
            variable.name
        ))
    })
}

/// What to say of a key of `[analysis]` that varies and that no method of the study takes.
fn of_no_method(study: &Study, variable: &Variable) -> Option<String> {
    let keys = variable.target.paths();
    let (path, key) = keys
        .into_iter()
        .find_map(|path| Some((path, path.of_method_key()?)))?;
    let takers = methods_that_take(key);
    let of_methods = |v: &&Variable| {
        let mut keys = v.target.paths().filter_map(|path| path.of_method_key());
        keys.any(|key| key == "method")
    };
    let methods = study.variables.iter().find(of_methods).map(|v| &v.values);
    let used: Vec<&str> = match methods {
        Some(Values::Choices(names)) => names.iter().map(|n| n.trim_matches(['"', '\''])).collect(),
        _ => vec![&study.base.analysis.method.value],
    };
    // A key that the case itself gives is said of the case.
    if methods.is_none() && study.base.analysis.places.contains_key(key) {
        return None;
    }
    let is_idle = !takers.is_empty() && !used.iter().any(|method| takers.contains(method));
    is_idle.then(|| {
        format!(
            "variable \"{}\": `{path}` (of {}) does nothing with method {}: runs that differ in it alone are equal",
            variable.name,
            takers.join(", "),
            used.join(", ")
        )
    })
}

/// What to say of a variable that changes, or may change, which floors a link joins.
fn of_other_levels(variable: &Variable) -> Option<String> {
    let keys = ["levels", "elevation_tolerance"];
    let of_link = |path: &case_text::Path| {
        path.table() == "link" && keys.iter().any(|key| path.leads_through(key))
    };
    let changes = variable.target.paths().any(of_link);
    let may = if changes { "changes" } else { "may change" };
    let of_elevations = || variable.target.paths().any(case_text::Path::of_elevations);
    (changes || of_elevations()).then(|| {
        format!(
            "variable \"{}\" {may} which floors a link joins: peaks of links are of the levels that they have in the case, and missing in runs without these",
            variable.name
        )
    })
}

/// What to say of a variable of which no result of a study tells.
fn without_result(variable: &Variable) -> Option<String> {
    let mut paths = variable.target.paths();
    if let Some(path) = paths.clone().find(|path| path.of_seat()) {
        return Some(format!(
            "variable \"{}\": `{path}` moves nothing: runs that differ in it alone are equal; `peak_opening` is to be held against it, as the count of decks that fall is, and `pounding gap` says more",
            variable.name
        ));
    }
    paths.find(|path| path.without_result()).map(|path| {
        format!(
            "variable \"{}\": no result of a study tells of `{path}`: runs that differ in it alone are equal; `pounding gap` asks for it",
            variable.name
        )
    })
}

/// What a study with rigid impacts must know of its accelerations.
const JUMPS: &str = "rigid impacts are jumps of the velocity, which floor accelerations leave out: peak_acceleration_absolute is that between the impacts";

fn has_rigid_impacts(system: &System) -> bool {
    let mut levels = system.levels().iter();
    levels.any(|level| level.model.rigid_restitution().is_some())
}

/// Whether impacts are rigid in some run, as those of the case are or as a value of a variable
/// makes them.
fn may_be_rigid(study: &Study, base: &CaseTree<'_>, rigid_of_case: bool) -> bool {
    let of_value = |variable: &Variable, choice: usize| {
        let edits = variable.target.edits(&Value::Choice(choice));
        let variant = Variant::new(base, &edits);
        let case = variant.case().ok()?;
        let assembly = variant.make(&case, assemble_at_rest).ok()?;
        Some(has_rigid_impacts(&assembly.system))
    };
    let chosen = study
        .variables
        .iter()
        .filter_map(|variable| match &variable.values {
            Values::Choices(names) if variable.target.changes_case() => {
                Some((variable, names.len()))
            }
            _ => None,
        });
    let mut found = chosen.map(|(variable, count)| {
        let mut of_values = (0..count).filter_map(|choice| of_value(variable, choice));
        of_values.any(|rigid| rigid)
    });
    match rigid_of_case {
        // Unless a variable has other models in every run.
        true => found.all(|rigid| rigid),
        false => found.any(|rigid| rigid),
    }
}

/// The shortest duration (s) of runs that case and variables give; `None` where it is the record's.
fn shortest_duration(study: &Study) -> Option<f64> {
    let at = case_text::Path::parse("analysis.duration").ok()?;
    let varied = study.variables.iter().find_map(|v| {
        let mut entries = v.target.entries().iter();
        let entry = entries.find(|entry| entry.path == at)?;
        let numbers = looked_at(&v.values)
            .into_iter()
            .filter_map(|value| match value {
                Value::Number(x) => Some(entry.number(x)),
                Value::Choice(_) => None,
            });
        numbers.reduce(f64::min)
    });
    varied.or(study.base.analysis.duration)
}

/// Whether a study varies the entry of its case at a path.
fn varies(study: &Study, at: &str) -> bool {
    let at = case_text::Path::parse(at);
    let mut paths = study.variables.iter().flat_map(|v| v.target.paths());
    paths.any(|path| at.as_ref().is_ok_and(|at| at == path))
}

/// A gap and the storeys on its left and right, from 1; `None` is a wall.
type FloorsThatMeet<'s> = (&'s str, [Option<usize>; 2]);

/// The floors that meet at each contact level.
fn floors_that_meet(system: &System) -> impl Iterator<Item = FloorsThatMeet<'_>> {
    let gaps = system.gaps().iter();
    gaps.flat_map(|gap| {
        let levels = system.levels_of(gap).iter();
        levels.map(|level| (&*gap.name, level.place.storeys))
    })
}

/// The storeys that are joined at the levels of each link.
fn joined_storeys(system: &System) -> Vec<Vec<[Option<usize>; 2]>> {
    let places = (0..system.links().len()).map(|link| system.link_levels(link));
    let storeys = places.map(|places| places.iter().map(|place| place.storeys).collect());
    storeys.collect()
}

fn listed<'s>(levels: impl Iterator<Item = FloorsThatMeet<'s>>) -> String {
    let storey = |n: Option<usize>| n.map_or_else(|| "wall".to_owned(), |n| n.to_string());
    let label = |(gap, sides): FloorsThatMeet<'_>| format!("{gap} {}", sides.map(storey).join("-"));
    let mut labels: Vec<String> = levels.map(label).collect();
    // Points of floors that turn in plan are levels of their own.
    labels.dedup();
    match labels.is_empty() {
        true => "none".to_owned(),
        false => labels.join(", "),
    }
}

/// The run without gaps. The isolated demand is infinite where the buildings collapse by
/// themselves, which no gap keeps apart.
fn apart(system: &System, options: &RunOptions) -> Result<IsolatedRun, String> {
    match isolated_demand(system, options) {
        Ok((outcome, peaks)) => {
            let buildings = outcome.buildings.into_iter();
            let storeys = buildings.flat_map(|b| b.storeys.into_iter().zip(b.yielding));
            Ok(IsolatedRun {
                demand: peaks.iter().map(|p| p.value).collect(),
                storeys: Some(storeys.collect()),
            })
        }
        Err(TimeHistoryError::Collapse { .. }) => Ok(IsolatedRun {
            demand: vec![f64::INFINITY; system.levels().len()],
            storeys: None,
        }),
        Err(e) => Err(e.to_string()),
    }
}

/// Edits that make the case of a run.
fn edits(study: &Study, point: &[Value]) -> Vec<Edit> {
    let values = study.variables.iter().zip(point);
    let edits = values.flat_map(|(variable, value)| match (&variable.target, value) {
        (Target::Record, Value::Choice(i)) => match &study.records[*i].kind {
            RecordKind::File { edits, .. } => edits.clone(),
            _ => Vec::new(),
        },
        (target, value) => target.edits(value),
    });
    edits.collect()
}

/// The measure and the intensity that a run wants; `None` if the study leaves scaling to
/// the case.
pub(crate) fn wanted<'s>(study: &'s Study, point: &[Value]) -> Option<(&'s IntensityMeasure, f64)> {
    let mut values = study.variables.iter().zip(point);
    values.find_map(|(v, x)| match (v.target.measure(), x) {
        (Some(measure), Value::Number(x)) => Some((measure, *x)),
        _ => None,
    })
}

/// The factor that brings a motion to a wanted intensity.
pub(crate) fn factor(
    wanted: Option<f64>,
    motion: Result<&Motion, &String>,
) -> Result<Option<f64>, String> {
    let (Some(wanted), Ok(motion)) = (wanted, motion) else {
        return Ok(None);
    };
    match motion.intensity {
        Some(as_recorded) if as_recorded > 0.0 => Ok(Some(wanted / as_recorded)),
        _ => Err("the record has no intensity that could be scaled".to_owned()),
    }
}

/// A record that a run needs and that was not read: a defect of the program.
fn unread() -> String {
    "its record was not read".to_owned()
}

/// The motion as this run has it.
fn scaled(
    case: &Case,
    record: &Arc<Accelerogram>,
    factor: Option<f64>,
) -> Result<Arc<Accelerogram>, AssemblyError> {
    Ok(match (factor, &case.ground_motion.scale) {
        (Some(factor), _) => Arc::new(record.scaled_by(factor)?),
        (None, None) => Arc::clone(record),
        (None, _) => Arc::new(scale_record(case, Accelerogram::clone(record))?),
    })
}

/// What tells runs apart for sharing: runs with equal numbers have equal buildings, or
/// equal motions.
struct Key {
    buildings: Vec<u64>,
    motion: Vec<u64>,
}

fn key(study: &Study, point: &[Value]) -> Key {
    let mut key = Key {
        buildings: Vec::new(),
        motion: Vec::new(),
    };
    let across = study.records.iter().any(|record| match &record.kind {
        RecordKind::File { case, .. } => case.ground_motion.across.is_some(),
        _ => false,
    });
    for (variable, value) in study.variables.iter().zip(point) {
        let bits = value.bits();
        match &variable.target {
            Target::Model { .. } => {}
            target @ Target::Entries { .. } if target.paths().all(case_text::Path::of_gap) => {}
            Target::Entries { .. } => key.buildings.push(bits),
            Target::Record | Target::Intensity(_) => {
                // The motions of buildings across the row go with them.
                if matches!(variable.target, Target::Record) && across {
                    key.buildings.push(bits);
                }
                key.motion.push(bits);
            }
        }
    }
    key
}

/// The message of a panic.
fn panic_message(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "without a reason".to_owned())
}
