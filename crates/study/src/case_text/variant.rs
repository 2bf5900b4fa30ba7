//! A case with some of its entries replaced.

use pounding_assembly::AssemblyError;
use pounding_case::{Case, CaseError, CaseTree};
use toml::de::DeTable;

use super::edits::{Edit, apply, changed};
use super::identity::{Lines, canonical};

/// A case with edits, made in its tree. Only where something is wrong with it is it written,
/// and read: messages have their places in that text.
#[derive(Debug)]
pub(crate) struct Variant<'v, 's> {
    base: &'v CaseTree<'s>,
    edits: &'v [Edit],
    /// What the edits change; `None` where they cannot be made in the tree.
    changed: Option<DeTable<'v>>,
}

impl<'v, 's> Variant<'v, 's> {
    pub(crate) fn new(base: &'v CaseTree<'s>, edits: &'v [Edit]) -> Self {
        Self {
            base,
            edits,
            changed: changed(base.tree(), edits),
        }
    }

    /// What [`canonical`] says of its text; `lines` are those of the case.
    pub(crate) fn canonical(&self, lines: &Lines) -> String {
        match &self.changed {
            Some(changed) => lines.with(changed),
            None => canonical(&self.text()),
        }
    }

    pub(crate) fn case(&self) -> Result<Case, CaseError> {
        let made = self.changed.as_ref();
        made.and_then(|changed| self.base.with(changed))
            .map_or_else(|| self.written(), Ok)
    }

    /// What is made of its case.
    pub(crate) fn make<T>(
        &self,
        case: &Case,
        make: impl Fn(&Case) -> Result<T, AssemblyError>,
    ) -> Result<T, AssemblyError> {
        match make(case) {
            Err(AssemblyError::Case(_)) => make(&self.written()?),
            made => made,
        }
    }

    /// What is asked about values that have no unit in the text.
    pub(crate) fn asked(&self) -> Result<Vec<String>, CaseError> {
        // The tree has its places in the text before the edits, where units may stand.
        Ok(self.written()?.asked)
    }

    fn text(&self) -> String {
        apply(self.base.source(), self.edits)
    }

    fn written(&self) -> Result<Case, CaseError> {
        Case::parse(&self.text(), self.base.file())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use std::cell::RefCell;
    use std::collections::BTreeMap;

    use pounding_assembly::assemble_at_rest;
    use pounding_case::{Parameter, Plan};
    use proptest::prelude::*;
    use proptest::sample::{Index, select};
    use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
    use toml::de::DeValue;

    use super::super::edits::{entry, with_model, with_motion};
    use super::super::path::{Path, Step};
    use super::*;

    /// Texts of sound cases, in many ways of writing.
    fn cases() -> impl Strategy<Value = String> {
        let mass = select(vec![
            "mass = \"25 t\"",
            "mass = 2.5e4 # each",
            "mass = [25_000, \"20 t\"]",
        ]);
        let damping = select(vec![
            "damping = { stiffness_proportional = 0.05 }",
            "damping = { ratio = \"5 %\", modes = [1, 2] }",
            "damping.rayleigh = { alpha = 0.1, beta = 0 }",
            "[building.damping]\nmodal = [0.05, 0.02]",
        ]);
        let more = select(vec![
            "",
            "p_delta = true",
            "initial_displacement = [0, '1 mm']",
            "law = [{ model = \"elastic_perfectly_plastic\", yield_force = \"1 MN\" }]",
            "# nothing\n\"storeys\" = 2",
        ]);
        let building = (mass, damping, more);
        let gap = select(vec![
            "model = \"jankowski_2005\"\nstiffness = \"2.75e9 N/m^1.5\"\nrestitution = 0.65",
            "name = \"the joint\"\nmodel = 'linear_elastic'\nstiffness = 93.5e6",
            "levels = [[1, 1],\n  [2, 2]]\nmodel = \"hertz_1882\" # no damping\nstiffness = 1e9",
            "levels = [[2, 2], [1, 1]]\nmodel = \"hertz_1882\"\nstiffness = [\"1e9 N/m^1.5\", 2e9]",
            "levels = \"matching\"\nelevation_tolerance = 0.02\nmodel = \"anagnostopoulos_2004\"\nstiffness = \"2000 MN/m\"\nrestitution = 0.65\nseparation = \"no_tension\"",
        ]);
        let motion = select(vec![
            "[ground_motion]\nfile = \"a.csv\"",
            "[ground_motion] # recorded\nfile = \"a.csv\"\nscale = { pga = \"0.3 g\" }\nprocess = [{ remove_offset = \"mean\" }]",
            "[ground_motion]\nscale.psa = 3\nscale.period = 0.5\nfile = 'a.csv'\nlenient = true",
            "[ground_motion.scale]\nfactor = 2\n[ground_motion]\nfile = \"a.csv\"\nunit = \"g\"",
            "ground_motion = { file = \"a.csv\", scale = 1.5 }",
        ]);
        let end = select(vec![
            "",
            "title = \"x\"\n",
            "[analysis]\nduration = \"2 s\"\noutput_step = 0.01",
            "[analysis]\nmethod = \"newmark\"\nstep = 1e-3",
            "[separation]\nimportance = 1.2\n[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"viscous_damper\"\ndashpot = 1e5",
        ]);
        let parts = (building.clone(), building, gap, motion, end);
        (parts, any::<bool>(), any::<bool>()).prop_map(|((a, b, gap, motion, end), back, crlf)| {
            let building = |name: &str, (mass, damping, more): (&str, &str, &str)| {
                let height = "height = \"3 m\"\nstiffness = [3.46e6, 3e6]";
                format!("[[building]]\nname = \"{name}\"\n{mass}\n{height}\n{more}\n{damping}\n")
            };
            let gap = format!("[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = \"20 mm\"\n{gap}\n");
            let both = building("a", a) + &building("b", b);
            let mut blocks = [both, gap, format!("{motion}\n"), format!("{end}\n")];
            if back {
                blocks.reverse();
            }
            // What has no header of its own stands before all others.
            blocks.sort_by_key(|block| block.starts_with('['));
            let text = blocks.concat();
            match crlf {
                true => text.replace('\n', "\r\n"),
                false => text,
            }
        })
    }

    /// Values that fit somewhere, and some that fit nowhere.
    const VALUES: [&str; 26] = [
        "0.03",
        "3",
        "1",
        "2",
        "-1",
        "1e-2",
        "1e400",
        "nan",
        "0x10",
        "true",
        "false",
        "\"20 mm\"",
        "\"2 t\"",
        "'3 MN/m'",
        "\"0.2 g\"",
        "\"5 %\"",
        "\"hertz_1882\"",
        "\"adaptive\"",
        "\"matching\"",
        "\"a\"",
        "\"\"",
        "\"5 furlongs\"",
        "[1, 2]",
        "[[1, 1]]",
        "[]",
        "{ mass_proportional = 0.02 }",
    ];

    /// Keys that cases may leave out, and some that they may not have.
    const KEYS: [&str; 14] = [
        "storeys",
        "p_delta",
        "initial_velocity",
        "restitution",
        "exponent",
        "floor_to_floor",
        "time_step",
        "scale",
        "factor",
        "step",
        "duration",
        "widht",
        "name",
        "a b.c",
    ];

    /// Keys of tables that cases may leave out.
    const PUT_IN: [&str; 5] = [
        "analysis.duration",
        "analysis.output_step",
        "separation.importance",
        "ground_motion.scale.factor",
        "building.b.damping.ratio",
    ];

    /// All paths into a case, and to some keys that it leaves out.
    fn paths(way: &[Step], value: &DeValue<'_>, left_out: &[&str], paths: &mut Vec<Path>) {
        let mut into = |step: Step, inner: Option<&DeValue<'_>>| {
            let way = [way, &[step]].concat();
            if let Some(inner) = inner {
                self::paths(&way, inner, left_out, paths);
            }
            paths.push(Path(way));
        };
        match value {
            DeValue::Table(table) => {
                for (key, inner) in table {
                    into(Step::Key(key.get_ref().to_string()), Some(inner.get_ref()));
                }
                let absent = left_out.iter().filter(|key| !table.contains_key(**key));
                absent.for_each(|key| into(Step::Key((*key).to_owned()), None));
            }
            DeValue::Array(items) => {
                for (i, inner) in items.iter().enumerate() {
                    into(Step::Index(i), Some(inner.get_ref()));
                }
            }
            _ => {}
        }
    }

    /// Debug's text without places, which are those of another text, and in the order of keys.
    fn without_places(case: &Case) -> String {
        let mut case = case.clone();
        case.source.clear();
        // What is asked is of places in the text before the edits: of values that a study varies it asks the whole text.
        case.asked.clear();
        let sort = |parameters: &mut Vec<Parameter>| {
            parameters.sort_by(|a, b| a.key.value.cmp(&b.key.value));
        };
        case.gaps.iter_mut().for_each(|g| sort(&mut g.parameters));
        case.links.iter_mut().for_each(|l| sort(&mut l.parameters));
        for building in &mut case.buildings {
            let plan = building.plan.iter_mut().map(|plan| &mut plan.value);
            let of_frames = plan.flat_map(Plan::frames_mut).flat_map(|f| &mut f.laws);
            let laws = building.laws.iter_mut().chain(of_frames);
            laws.for_each(|law| sort(&mut law.parameters));
        }
        let is_digit = |c: char| c.is_ascii_digit();
        let text = format!("{case:?}");
        let mut parts = text.split("..");
        let mut out = parts.next().unwrap().to_owned();
        for part in parts {
            let before = out.trim_end_matches(is_digit).len();
            out.truncate(before);
            out.push_str("..");
            out.push_str(part.trim_start_matches(is_digit));
        }
        out
    }

    /// A random edit of a sound case, if it has room for it; several for models and records.
    fn edits(source: &str, (kind, place, value): &(u8, Index, Vec<Index>)) -> Option<Vec<Edit>> {
        let value = |i: usize| (*value[i].get(&VALUES)).to_owned();
        let option = |key: &str, i| (key.to_owned(), value(i));
        match kind {
            0 => {
                let options = vec![
                    option("model", 0),
                    ("stiffness".to_owned(), "1e9".to_owned()),
                    option("restitution", 1),
                ];
                with_model(source, &Path::parse("gap.0").unwrap(), options).ok()
            }
            1 => {
                let model = "\"hertz_1882\"".to_owned();
                let options = vec![("model".to_owned(), model), option("stiffness", 0)];
                with_model(source, &Path::parse("gap.a-b").unwrap(), options).ok()
            }
            2 => {
                let file = ("file".to_owned(), "\"b.csv\"".to_owned());
                with_motion(source, &["scale"], vec![file, option("lenient", 0)]).ok()
            }
            3 => {
                let put_in: &&str = place.get(&PUT_IN);
                let path = Path::parse(put_in).unwrap();
                let entry = entry(source, &path).ok()?;
                Some(vec![Edit::new(&entry, value(0))])
            }
            _ => {
                let tree = DeTable::parse(source).unwrap().into_inner();
                let mut all = Vec::new();
                let left_out = if kind % 2 == 0 { &[] } else { KEYS.as_slice() };
                paths(&[], &DeValue::Table(tree), left_out, &mut all);
                let entry = entry(source, place.get(&all)).ok()?;
                let written = source[entry.span.clone()].to_owned();
                // Half of all values are as those that are given, but larger if they are numbers.
                let digit = written.find(|c: char| c.is_ascii_digit());
                let value = match (kind % 2, digit) {
                    (0, Some(digit)) => {
                        let (before, after) = written.split_at(digit);
                        format!("{before}1{after}")
                    }
                    (0, None) => written,
                    _ => value(0),
                };
                Some(vec![Edit::new(&entry, value)])
            }
        }
    }

    /// Whatever is edited, the case made in the tree is that of the written text: as types, as
    /// a system with its options, in its identity, and in what is wrong with it.
    #[test]
    fn variants_are_what_their_texts_say() {
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[14; 32]);
        let config = Config {
            failure_persistence: None,
            ..Config::with_cases(1500)
        };
        let mut runner = TestRunner::new_with_rng(config, rng);
        let one = (
            0_u8..12,
            any::<Index>(),
            prop::collection::vec(any::<Index>(), 2),
        );
        let strategy = (cases(), prop::collection::vec(one, 1..3));
        let assembled = |case: &Case| {
            let assembly = assemble_at_rest(case)?;
            Ok(format!("{:?} {:?}", assembly.system, assembly.options))
        };
        let seen = RefCell::new(BTreeMap::new());
        let count = |what: &'static str| *seen.borrow_mut().entry(what).or_insert(0) += 1;
        let checked = runner.run(&strategy, |(source, picks)| {
            let file = std::path::Path::new("case.toml");
            let base = CaseTree::parse(&source, file)
                .map_err(|e| TestCaseError::fail(format!("{e}\n{source}")))?;
            let lines = Lines::of(base.tree());
            prop_assert_eq!(lines.with(&DeTable::new()), canonical(&source));
            let mut all: Vec<Edit> = Vec::new();
            for pick in &picks {
                let Some(new) = edits(&source, pick) else {
                    count("no room");
                    continue;
                };
                // Of what overlaps, a study varies one alone.
                if !new
                    .iter()
                    .any(|a| all.iter().any(|b| a.entry.overlaps(&b.entry)))
                {
                    all.extend(new);
                }
            }
            let variant = Variant::new(&base, &all);
            let text = apply(&source, &all);
            let written = Case::parse(&text, file);
            prop_assert_eq!(variant.canonical(&lines), canonical(&text), "{}", text);
            prop_assert_eq!(variant.text(), text.clone());
            let made = variant.changed.as_ref();
            let made = made.and_then(|changed| base.with(changed));
            let (case, written) = match (made, written) {
                (Some(made), Ok(written)) => {
                    prop_assert_eq!(without_places(&made), without_places(&written), "{}", text);
                    (made, written)
                }
                (None, Err(error)) => {
                    count("refused by the case");
                    prop_assert_eq!(variant.case(), Err(error));
                    return Ok(());
                }
                (made, written) => {
                    let made = made.map(|_| "made");
                    return Err(TestCaseError::fail(format!("{made:?} {written:?}\n{text}")));
                }
            };
            let said = |e: AssemblyError| (e.to_string(), e.help());
            let made = variant.make(&case, assembled).map_err(said);
            count(match made {
                Ok(_) => "assembled",
                Err(_) => "refused by the assembly",
            });
            prop_assert_eq!(made, assembled(&written).map_err(said), "{}", text);
            Ok(())
        });
        checked.unwrap();
        let seen = seen.into_inner();
        let least = [
            ("assembled", 200),
            ("refused by the assembly", 80),
            ("refused by the case", 400),
            ("no room", 150),
        ];
        for (what, least) in least {
            assert!(seen.get(what).is_some_and(|n| *n >= least), "{seen:?}");
        }
    }
}
