//! Variables: what varies, and every value tried in the case.

use std::ops::Range;

use pounding_case::document::{
    Amount, Entry, Fault, Field, FreeKeys, List, Number, OneOrEach, Optional, Positive, Reader,
    Scalar, TableOr, Time, Written,
};
use pounding_case::{CaseTree, Dimension, Located};
use pounding_catalogue::wording::one_line;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::IgnoredAny;

use super::bare_numbers;
use super::context::{Base, Context};
use super::distribution::DistributionTable;
use super::intensity::{BelowOne, IntensityKeys, Measure};
use super::keys::not_both;
use super::records::{Record, SyntheticTable};
use super::trial::{Trial, unit_of_numbers};
use super::values::{Numbers, Spacing, Values, Whole, all, table_with_range, unit_of};
use super::varied_entry::{VariedEntry, kept, varied_entries};
use super::{IntensityMeasure, RecordSource, Target, Variable, records};
use crate::case_text::{Path, of_impact_model, with_model};
use crate::table::DIAGNOSIS;

table_with_range! {
    /// Something that varies: an entry of the case, the records, or their intensity
    #[derive(Debug, Deserialize, JsonSchema)]
    #[serde(rename = "[[variable]]")]
    VariableTable {
        /// Name of the coordinate in the results
        name: Optional<String>,
        /// Entry of the case that varies, such as gap.0.width; several have the same value in every run: gap.*.width
        /// for each of a list, or a list of paths
        path: Optional<OneOrEach<Located<String>>>,
        /// Whether values are multiples of the numbers that the case has there, by default false: 0.8 to 1.2 of
        /// building.light.stiffness, also of a list with one for each storey
        relative: Optional<bool>,
        /// Values: numbers, texts, or models with all their options
        values: Optional<Listed>,
        /// Distribution of random numbers, of which latin_hypercube, sobol and monte_carlo take samples
        distribution: Optional<DistributionTable>,
        /// Motions from files, relative to the folder of the study
        pub records: Optional<List<Record>>,
        /// Synthetic motions
        pub synthetic: Optional<SyntheticTable>,
        /// Measure of the intensity to which the records are scaled. Spectral accelerations are those of the pseudo-spectrum,
        /// PSA; average_spectral_acceleration is over 30 periods from 0.2 to 3 times one, for several buildings the geometric
        /// mean of their first periods
        intensity: Optional<Measure>,
        /// Buildings whose first periods a spectral acceleration is taken at, by default all
        building: Optional<OneOrEach<Located<String>>>,
        /// Periods (s) that a spectral acceleration is taken at, or the one that a band of
        /// average_spectral_acceleration is around
        period: Optional<OneOrEach<Positive<Time>>>,
        /// Damping ratio of a spectral acceleration, by default 0.05
        damping: Optional<Amount<Number, BelowOne>>,
        /// What it is, for people
        long_name: Optional<String>,
    } => Numbers
}

/// Values one by one.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(
    expecting = "a list\nwrite a list, [1, 2]; a range is `from`, `to` and `count` of the variable itself, in the place of `values`"
)]
#[schemars(transparent)]
struct Listed(List<TableOr<ModelTable, Scalar>>);

/// Impact model of a gap with all its options
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(rename = "a model")]
struct ModelTable {
    /// Name in the results, by default that of the model
    label: Optional<String>,
    /// Impact model, author_year
    model: Field<String>,
    /// Parameters of the model
    #[serde(rename = "*")]
    #[schemars(with = "FreeKeys<Written>")]
    parameters: FreeKeys<IgnoredAny>,
}

/// Names that results use themselves.
const RESERVED: [&str; 6] = ["run", "storey", "level", "status", "run_id", DIAGNOSIS];

/// A variable, with the records if it is the one that names them.
type Read = (Variable, Option<Vec<RecordSource>>);

impl VariableTable {
    /// Reads a table that stands here.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        context: &Context,
    ) -> Option<Read> {
        let kinds = [
            ("path", self.path.span(), self.path.is_wrong()),
            ("records", self.records.span(), self.records.is_wrong()),
            ("records", self.synthetic.span(), self.synthetic.is_wrong()),
            (
                "intensity",
                self.intensity.span(),
                self.intensity.is_wrong(),
            ),
        ];
        let given = kinds.iter().filter(|(_, place, _)| place.is_some());
        let mut kinds: Vec<&str> = match given.clone().next() {
            Some(_) => given.map(|(kind, ..)| *kind).collect(),
            // What it is of is not known, but the rest can be looked at.
            None => kinds
                .iter()
                .filter(|(.., wrong)| *wrong)
                .map(|(kind, ..)| *kind)
                .collect(),
        };
        kinds.dedup();
        if let [kind] = kinds.as_slice() {
            self.refuse_others(reader, kind);
        }
        match kinds.as_slice() {
            ["path"] => Some((self.of_path(reader, span, context)?, None)),
            ["intensity"] => Some((self.of_intensity(reader, span, context)?, None)),
            ["records"] => self.of_records(reader, span, context),
            _ => {
                let message =
                    "a variable is one of `path`, `records` with `synthetic`, and `intensity`";
                reader.refuse(span.clone(), message, "for example path = \"gap.0.width\"")
            }
        }
    }

    /// Where the numbers of its range are counted.
    pub(super) fn count_of_range(&self) -> Option<Range<usize>> {
        let is_range = self.records.is_none() && self.synthetic.is_none();
        self.count.span().filter(|_| is_range)
    }

    /// Refuses keys that another kind of variable has.
    fn refuse_others(&self, reader: &Reader<'_>, kind: &str) {
        let numbers = [
            ("values", self.values.span()),
            ("distribution", self.distribution.span()),
            ("from", self.from.span()),
            ("to", self.to.span()),
            ("count", self.count.span()),
            ("spacing", self.spacing.span()),
        ];
        let spectrum = [
            ("building", self.building.span()),
            ("period", self.period.span()),
            ("damping", self.damping.span()),
        ];
        let relative = [("relative", self.relative.span(), "`path`")];
        let numbers = numbers.map(|(key, place)| (key, place, "`path` or `intensity`"));
        let spectrum = spectrum.map(|(key, place)| (key, place, "`intensity`"));
        let others = match kind {
            "records" => [&numbers[..], &spectrum, &relative].concat(),
            "path" => spectrum.to_vec(),
            _ => relative.to_vec(),
        };
        for (key, place, owner) in others {
            place.and_then(|place| {
                let message = format!("`{key}` has no meaning for a variable of {kind}");
                let help = format!("remove it; it stands beside {owner}");
                reader.refuse::<()>(place, message, help)
            });
        }
    }

    /// The name that the table states, whether or not it is sound.
    pub(super) fn stated_name(&self) -> Option<String> {
        self.name.clone().value()
    }

    /// The name of the variable, by default as given, and how people call it.
    fn names(
        &self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        default: &str,
        title: &str,
    ) -> Option<(String, String)> {
        let long = self.long_name.clone().value_or(title.to_owned());
        let place = self.name.span().unwrap_or_else(|| span.clone());
        let name = self.name.clone().value_or(default.to_owned())?;
        let plain = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        let begins = name.chars().next().is_some_and(|c| c.is_ascii_alphabetic());
        let taken = RESERVED.contains(&name.as_str()) || crate::runs::is_result(&name);
        if !plain || !begins || taken {
            let message = format!("\"{name}\" cannot name a coordinate of the results");
            let help = "a name begins with a letter, has letters, digits and underscores, and is not that of a result; write `name = ...`";
            return reader.refuse(place, message, help);
        }
        Some((name, one_line(long?)))
    }

    fn of_records(
        self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        context: &Context,
    ) -> Option<Read> {
        let names = self.names(reader, span, "record", "ground motion");
        let records = records::records(reader, self.records, self.synthetic, context)?;
        let (name, long_name) = names?;
        let labels = records.iter().map(|r| r.name.clone()).collect();
        let variable = Variable {
            name,
            long_name,
            unit: String::new(),
            values: Values::Choices(labels),
            target: Target::Record,
            asked: None,
        };
        Some((variable, Some(records)))
    }

    fn of_intensity(
        mut self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        context: &Context,
    ) -> Option<Variable> {
        let self_titled = self.long_name.is_none();
        let distribution_place = self.distribution.span();
        let keys = IntensityKeys {
            intensity: self.intensity.take(),
            building: self.building.take(),
            period: self.period.take(),
            damping: self.damping.take(),
        };
        let measure = keys.read(reader, context);
        let title = measure
            .as_ref()
            .map_or_else(String::new, IntensityMeasure::title);
        let names = self.names(reader, span, "intensity", &title);
        let read = |written: Written| match &measure {
            Some(measure) => written.above_zero(measure.dimension()),
            None => written.any().map(|quantity| quantity.value),
        };
        let values = self.numbers(reader).read(reader, span, &read);
        let (name, long_name) = names?;
        let (values, places) = values?;
        let long_name = with_distribution(long_name, self_titled, &values);
        if let Values::Random(distribution) = &values
            && distribution.quantile(0.0) <= 0.0
        {
            let message =
                "intensities lie above zero, which not all numbers of this distribution do";
            let help = "add `lower = ...`, or write kind = \"lognormal\"";
            return reader.refuse(distribution_place?, message, help);
        }
        let measure = measure?;
        let is_bare = places.iter().all(|written| written.value.is_plain());
        let asked = bare_numbers::of_intensities(&measure, &values).filter(|_| is_bare);
        Some(Variable {
            name,
            long_name,
            unit: unit_of(measure.dimension()),
            values,
            target: Target::Intensity(measure),
            asked,
        })
    }

    /// What says which numbers it takes.
    fn numbers(mut self, reader: &Reader<'_>) -> NumbersOrRandom {
        let number = |item: Field<_>| match item {
            Field::Given(Located { value, span }) => match value {
                TableOr::Value(Scalar::Written(value)) => Field::Given(Located { value, span }),
                _ => {
                    let message = "`values` must be numbers, or texts with a unit";
                    reader.refuse::<()>(span, message, "write a number, or a text with a unit");
                    Field::Wrong
                }
            },
            Field::Wrong => Field::Wrong,
        };
        let numbers = |list: Field<Listed>| match list {
            Field::Given(Located {
                value: Listed(List(items)),
                span,
            }) => Field::Given(Located {
                value: List(items.into_iter().map(number).collect()),
                span,
            }),
            Field::Wrong => Field::Wrong,
        };
        let values = self.values.take().map(numbers);
        NumbersOrRandom {
            distribution: self.distribution.take(),
            numbers: self.range_or(values),
        }
    }

    fn of_path(
        self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        context: &Context,
    ) -> Option<Variable> {
        let self_titled = self.long_name.is_none();
        let place = self.path.span().unwrap_or_else(|| span.clone());
        let relative = self.relative.clone().value_or(false)?;
        let paths = self.path.clone().value().and_then(|paths| {
            let read = |text: Located<String>| Some((path(reader, &text)?, text.span));
            all(paths.into_list().into_iter().map(read))
        });
        let names = match (&paths, &self.name) {
            // What it would be called is not known, which is no fault of its name.
            (None, None) => None,
            _ => {
                let paths = paths.as_deref().unwrap_or_default();
                let default = default_name(paths, reader, &place, &self.name);
                default.and_then(|name| self.names(reader, span, &name, &title(paths, relative)))
            }
        };
        let entries = paths.as_ref().and_then(|paths| {
            let case = context.text.as_deref()?;
            varied_entries(reader, case, paths, relative)
        });
        let tried = context.base.as_ref().zip(paths.as_ref().zip(entries));
        let tried = tried.and_then(|(Base { case: base, .. }, (paths, entries))| {
            Some(Trial {
                reader: *reader,
                tree: CaseTree::parse(&base.source, &base.file).ok()?,
                base,
                entries,
                paths: listed(paths, |path| format!("`{path}`")),
                place: place.clone(),
                refused_alone: context.in_rows.then_some(&context.refused_alone),
            })
        });
        let first = match &self.values {
            Some(Field::Given(list)) => list.value.0.0.first().cloned().and_then(Entry::value),
            _ => None,
        };
        let is_named = match &first {
            Some(TableOr::Value(Scalar::Flag(_))) => true,
            Some(TableOr::Value(Scalar::Written(written))) => {
                !written.is_plain() && written.clone().any().is_err()
            }
            _ => false,
        };
        let (mut unit, mut asked) = (String::new(), None);
        let (values, target) = match (first, self.values) {
            (Some(TableOr::Table(_)), Some(Field::Given(list))) if !relative => {
                models(reader, list, paths.as_deref(), tried)?
            }
            (_, Some(Field::Given(list))) if is_named && !relative => {
                named(reader, list.value.0, tried)?
            }
            (_, values) => {
                let numbers = Self { values, ..self }.numbers(reader);
                let number = |written: Written| match relative {
                    true => written.of(Dimension::NUMBER),
                    false => written.any().map(|quantity| quantity.value),
                };
                let sound = sound(&numbers.numbers);
                let Some((values, places)) = numbers.read(reader, span, &number) else {
                    // Beside wrong ones the case may refuse others.
                    tried.as_ref().and_then(|tried| tried.numbers(sound));
                    return None;
                };
                let tried = tried?;
                unit = unit_of_numbers(&places, &tried);
                let first = places.first().map(|place| place.span.clone());
                let is_bare = !relative && places.iter().all(|written| written.value.is_plain());
                tried.numbers(places)?;
                if is_bare {
                    asked = tried.question(&values);
                }
                tried.inner(&values, first.unwrap_or(place))?;
                (values, tried.target(Vec::new()))
            }
        };
        let (name, long_name) = names?;
        Some(Variable {
            name,
            long_name: with_distribution(long_name, self_titled, &values),
            unit,
            values,
            target,
            asked,
        })
    }
}

/// The name of the table in messages.
const TABLE: &str = "[[variable]]";

/// What a variable says of its numbers.
struct NumbersOrRandom {
    distribution: Optional<DistributionTable>,
    numbers: Numbers,
}

impl NumbersOrRandom {
    /// The numbers, and the places from which they were read.
    fn read(
        self,
        reader: &Reader<'_>,
        span: &Range<usize>,
        number: &dyn Fn(Written) -> Result<f64, Fault>,
    ) -> Option<(Values, Vec<Located<Written>>)> {
        let place = ("distribution", self.distribution.span());
        let Some(distribution) = self.distribution.stated()? else {
            return self.numbers.read(reader, (TABLE, span.clone()), number);
        };
        for other in self.numbers.keys() {
            not_both(reader, TABLE, other, place.clone())?;
        }
        let Located { value, span } = distribution;
        let (distribution, places) = value.read(reader, span, number)?;
        Some((Values::Random(distribution), places))
    }
}

fn path(reader: &Reader<'_>, text: &Located<String>) -> Option<Path> {
    let wrong = |reason| {
        (
            format!("\"{}\" is not a path: {reason}", text.value),
            "write paths such as gap.0.width or building.light.mass.2".to_owned(),
        )
    };
    let path = kept(reader, &text.span, Path::parse(&text.value).map_err(wrong))?;
    if path.of_storey_count() {
        let message = format!(
            "`{}` cannot vary: it makes other storeys, and so other results, of every run",
            text.value
        );
        let help = "make a case and a study for each number of storeys";
        return reader.refuse(text.span.clone(), message, help);
    }
    if path.without_effect() {
        let message = format!("`{}` changes no result of a study", text.value);
        let help = "remove the variable";
        return reader.refuse(text.span.clone(), message, help);
    }
    Some(path)
}

/// The name of a variable of these paths that states none.
fn default_name(
    paths: &[(Path, Range<usize>)],
    reader: &Reader<'_>,
    place: &Range<usize>,
    stated: &Optional<String>,
) -> Option<String> {
    if paths.len() > 1 && stated.is_none() {
        let message = "a variable of several paths has no name by itself";
        return reader.refuse(place.clone(), message, "add `name = \"...\"`");
    }
    let text = paths.first().map(|(path, _)| path.to_string())?;
    let parts = text.split(['.', '[', ']', '"', '-', ' ', '*']);
    let parts: Vec<&str> = parts.filter(|p| !p.is_empty()).collect();
    Some(parts.join("_"))
}

/// What people call a variable of these paths.
fn title(paths: &[(Path, Range<usize>)], relative: bool) -> String {
    let of = if relative { "multiple of " } else { "" };
    format!("{of}{}", listed(paths, |path| path.to_string()))
}

/// A title that is no person's, with the distribution of random numbers.
fn with_distribution(title: String, self_titled: bool, values: &Values) -> String {
    match values {
        Values::Random(distribution) if self_titled => format!("{title}, {distribution}"),
        _ => title,
    }
}

/// Most paths that are listed.
const MOST_LISTED: usize = 4;

/// Paths, shown in this way, or the first of many.
fn listed(paths: &[(Path, Range<usize>)], shown: impl Fn(&Path) -> String) -> String {
    let some = match paths.len() {
        0..=MOST_LISTED => paths,
        _ => &paths[..MOST_LISTED - 1],
    };
    let mut listed: Vec<String> = some.iter().map(|(path, _)| shown(path)).collect();
    if some.len() < paths.len() {
        listed.push(format!("{} more", paths.len() - some.len()));
    }
    listed.join(", ")
}

/// Values that are texts of the case, such as methods.
fn named(
    reader: &Reader<'_>,
    list: List<TableOr<ModelTable, Scalar>>,
    tried: Option<Trial<'_>>,
) -> Option<(Values, Target)> {
    let choices = all(list.0.into_iter().map(|item| {
        let Located { value, span } = item.located()?;
        let text = reader.source[span.clone()].to_owned();
        match value {
            TableOr::Value(Scalar::Flag(flag)) => Some((flag.to_string(), text, span)),
            TableOr::Value(Scalar::Written(written)) if !written.is_plain() => {
                Some((written.as_written().to_owned(), text, span))
            }
            _ => {
                let wanted = "a text in quotes";
                let message = format!("`values` must be {wanted}");
                reader.refuse(span, message, format!("write {wanted}"))
            }
        }
    }))?;
    let tried = tried?;
    let texts = choices
        .iter()
        .map(|(_, text, span)| (span.clone(), text.as_str()));
    tried.texts(texts)?;
    let (labels, texts) = choices
        .into_iter()
        .map(|(label, text, _)| (label, text))
        .unzip();
    Some((Values::Choices(labels), tried.target(texts)))
}

/// Those of listed values that are numbers.
fn sound(numbers: &Numbers) -> Vec<Located<Written>> {
    let Some(Field::Given(list)) = &numbers.values else {
        return Vec::new();
    };
    let items = list.value.0.iter().cloned();
    let items = items.filter_map(Field::located);
    items
        .filter(|item| item.value.clone().any().is_ok())
        .collect()
}

/// Models with all their options.
fn models(
    reader: &Reader<'_>,
    list: Located<Listed>,
    paths: Option<&[(Path, Range<usize>)]>,
    tried: Option<Trial<'_>>,
) -> Option<(Values, Target)> {
    let of_gap = |path: &Path| path.table() == "gap" && path.to_string().ends_with(".model");
    if paths.is_some_and(|paths| paths.iter().any(|(path, _)| !of_gap(path))) {
        return reader.refuse(
            list.span,
            "tables are values of the models of gaps only",
            "write path = \"gap.0.model\" or \"gap.*.model\" alone; other entries take numbers or texts, by variables of their own",
        );
    }
    let mut labels: Vec<String> = Vec::new();
    let models = all(list.value.0.0.into_iter().map(|item| {
        let Located { value, span } = item.located()?;
        let TableOr::Table(model) = value else {
            let message = "give all models as tables, or none";
            return reader.refuse(span, message, "write { model = \"...\", ... }");
        };
        let (label, options) = model.read(reader)?;
        if labels.contains(&label) {
            let message = format!("two values are called \"{label}\"");
            return reader.refuse(span, message, "add label = \"...\"");
        }
        labels.push(label);
        Some((span, options))
    }))?;
    let tried = tried?;
    let edits = all(models.into_iter().map(|(span, options)| {
        let of_gap = |varied: &VariedEntry| {
            let (_, gap) = varied.path.0.split_last()?;
            let edits = with_model(&tried.base.source, &Path(gap.to_vec()), options.clone());
            kept(reader, &list.span, edits)
        };
        let edits = all(tried.entries.iter().map(of_gap))?.concat();
        match tried.refusal(&edits) {
            Ok(()) => Some(edits),
            Err(refusal) => tried.wrong(refusal, span),
        }
    }))?;
    Some((Values::Choices(labels), Target::Model { edits }))
}

/// Whether a gap of a case has this key, whatever its model.
fn is_gap_key(key: &str) -> bool {
    let schema = pounding_case::schema();
    let gap = &schema["properties"]["gap"]["items"]["properties"];
    gap.get(key).is_some()
}

impl ModelTable {
    /// The label of a model, and its keys in a case, which knows those of its gaps.
    fn read(self, reader: &Reader<'_>) -> Option<(String, Vec<(String, String)>)> {
        let text = |place: Range<usize>| reader.source[place].to_owned();
        let mut options = vec![("model".to_owned(), text(self.model.span()?))];
        for (key, value) in self.parameters.0 {
            if !of_impact_model(&key.value) && is_gap_key(&key.value) {
                let message = format!("`{}` is of the gap, and not of its model", key.value);
                let help = "leave it out: the gap keeps its own; a variable of its own changes it";
                return reader.refuse(key.span, message, help);
            }
            options.push((key.value, text(value.span()?)));
        }
        let label = self.label.value_or(self.model.value()?)?;
        Some((label, options))
    }
}
