//! What an incremental dynamic analysis evaluates.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use pounding_case::document::{
    AboveZero, Amount, Entry, Fault, Field, FromZero, List, Number, OneOrEach, Optional, Reader,
    TableOr, Within, Written,
};
use pounding_case::{ContactLevel, Dimension, FoundationMotion, Gap, Link, Located};
use pounding_catalogue::wording::one_line;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, SeqAccess, Visitor};

use super::annual_frequency::AnnualFrequency;
use super::context::{Context, LawOfStorey};
use super::demand_kind::{DemandKind, OfBuilding};
use super::hazard_curve::HazardCurve;
use super::keys::not_both;
use super::values::{Numbers, Values, Whole, all};
use super::{IntensityMeasure, bare_numbers, hazard_file};

/// A state that counts as reached when a demand exceeds a value.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// Name of the state.
    pub name: String,
    /// The demand.
    pub demand: DemandKind,
    /// Index of the building whose storeys count; `None`: all buildings.
    pub building: Option<usize>,
    /// Storeys from zero, of which the worst counts; none: of all. For demands at gaps the levels, from zero, over
    /// the levels of all gaps.
    pub places: Vec<usize>,
    /// Name of the link whose levels count, for demands of links; `None`: all links.
    pub link: Option<String>,
    /// Value that it exceeds (SI).
    pub exceeds: f64,
}

/// The part `[ida]` of a study.
#[derive(Debug, Clone, PartialEq)]
pub struct IdaSettings {
    /// Index of the variable that chooses the record.
    pub record: usize,
    /// Index of the variable that sets the intensity.
    pub intensity: usize,
    /// The measure.
    pub measure: IntensityMeasure,
    /// Gap widths (m) for which the probability of pounding is wanted.
    pub gaps: Vec<f64>,
    /// States beside pounding itself.
    pub limits: Vec<Limit>,
    /// Hazard at the site.
    pub hazard: Option<HazardCurve>,
    /// The file that it stands in, if it has one of its own.
    pub hazard_file: Option<PathBuf>,
    /// Mean annual frequency of pounding that is aimed at (1/year).
    pub target_frequency: Option<f64>,
    /// Confidence of intervals (-).
    pub confidence: f64,
    /// What is asked about limits and intensities of the hazard, which may be meant in another unit.
    pub asked: Vec<String>,
}

/// The range of a confidence.
#[derive(Debug)]
struct BelowOne;

impl Within for BelowOne {
    const SCHEMA: &[(&str, f64)] = &[("exclusiveMinimum", 0.0), ("exclusiveMaximum", 1.0)];
    fn check(value: f64) -> Result<(), Fault> {
        AboveZero::check(value)?;
        match value < 1.0 {
            true => Ok(()),
            false => Err(Fault::new(" lies between 0 and 1", "for example 0.95")),
        }
    }
}

/// What an incremental dynamic analysis evaluates
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[ida]")]
pub(super) struct IdaTable {
    /// Gap widths (m) for which the probability of pounding is wanted: a list or a range
    gaps: Optional<Widths>,
    /// States beside pounding itself
    limit: Optional<List<LimitTable>>,
    /// Hazard at the site: points, or the name of a CSV file
    hazard: Optional<Hazard>,
    /// Mean annual frequency of pounding that is aimed at (1/year)
    target_frequency: Optional<AnnualFrequency>,
    /// Confidence of intervals, by default 0.95
    confidence: Optional<Amount<Number, BelowOne>>,
}

/// A state that counts as reached when a demand exceeds a value
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(rename = "[[ida.limit]]")]
struct LimitTable {
    /// Name of the state
    name: Field<String>,
    /// The demand
    demand: Field<DemandKind>,
    /// Building whose storeys count, by default all
    building: Optional<String>,
    /// Storey from 1 at the bottom, or several, of which the worst counts; by default all
    storey: Optional<OneOrEach<Located<Whole<1>>>>,
    /// Contact level, for demands at gaps: from 1, over the levels of all gaps in the order of
    /// the case and from the bottom; or several, of which the worst counts; by default all
    level: Optional<OneOrEach<Located<Whole<1>>>>,
    /// Link whose levels count, for demands of links, by default all
    link: Optional<String>,
    /// Value that it exceeds (SI, or with a unit)
    exceeds: Field<Written>,
}

/// Where a hazard curve stands.
#[derive(Debug)]
enum Hazard {
    /// In a CSV file of two columns.
    File(String),
    /// Here: intensities and frequencies.
    Points(Vec<Field<Vec<Field<Written>>>>),
}

impl<'de> Deserialize<'de> for Hazard {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Given;
        impl<'de> Visitor<'de> for Given {
            type Value = Hazard;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list of points [intensity, frequency], or the name of a CSV file")
            }
            fn visit_str<E>(self, name: &str) -> Result<Hazard, E> {
                Ok(Hazard::File(name.to_owned()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Hazard, A::Error> {
                let mut points = Vec::new();
                while let Some(point) = items.next_element()? {
                    points.push(point);
                }
                Ok(Hazard::Points(points))
            }
        }
        deserializer.deserialize_any(Given)
    }
}

impl JsonSchema for Hazard {
    fn schema_name() -> Cow<'static, str> {
        "hazard".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({"anyOf": [
            {"type": "string", "description": "CSV file, relative to the folder of the study"},
            hazard_file::Points::json_schema(generator)
        ]})
    }
}

impl IdaTable {
    /// What an analysis evaluates; `variables` are the indices of record and intensity, whose
    /// measure this is.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        context: &Context,
        variables: Option<(usize, usize)>,
        intensity: Option<(IntensityMeasure, &Values)>,
    ) -> Option<IdaSettings> {
        let (measure, values) = intensity.unzip();
        let mut asked = Vec::new();
        let gaps = self.gaps.stated().and_then(|gaps| match gaps {
            None => Some(Vec::new()),
            Some(gaps) => {
                let is_bare = are_bare(&gaps.value);
                let widths = widths(reader, gaps)?;
                let greatest = widths.iter().copied().fold(0.0, f64::max);
                asked.extend(bare_numbers::of_widths(greatest).filter(|_| is_bare));
                Some(widths)
            }
        });
        let limits = self.limit.stated().and_then(|limits| {
            let limits = limits.map_or_else(Vec::new, |limits| limits.value.0);
            let mut names = vec![POUNDING.to_owned()];
            for gap in context.base.iter().flat_map(|base| &base.case.gaps) {
                let widths = gaps.iter().flatten();
                names.extend(widths.map(|width| pounding_at(&gap.name, *width)));
            }
            let own = names.len();
            let read = |limit: Field<LimitTable>| {
                let limit = limit.value()?;
                let name = limit.name(reader, &mut names, own);
                let is_bare = is_plain(&limit.exceeds);
                let limit = limit.read(reader, context);
                let (name, limit) = (name?, limit?);
                asked.extend(bare_numbers::of_limit(
                    &name,
                    limit.demand,
                    limit.exceeds,
                    is_bare,
                ));
                Some(Limit { name, ..limit })
            };
            all(limits.into_iter().map(read).collect::<Vec<_>>())
        });
        if let (Some(target), None) = (self.target_frequency.span(), &self.hazard) {
            let message = "a target frequency needs a hazard curve";
            let help = "add `hazard = [[intensity, frequency], ...]` or the name of a CSV file";
            reader.refuse::<()>(target, message, help);
        }
        let hazard = self.hazard.stated().and_then(|hazard| match hazard {
            None => Some((None, None)),
            Some(hazard) => {
                let file = match &hazard.value {
                    Hazard::File(name) => Some(context.folder.join(name)),
                    Hazard::Points(_) => None,
                };
                let read = hazard_curve(reader, hazard, measure.as_ref(), file.as_deref())?;
                let (curve, is_bare) = read;
                let known = measure.as_ref().zip(values).filter(|_| is_bare);
                asked.extend(known.and_then(|(measure, values)| {
                    bare_numbers::of_hazard(measure, &curve.points, values)
                }));
                Some((Some(curve), file))
            }
        });
        let place = self.target_frequency.span();
        let target_frequency = self.target_frequency.number();
        if let (Some((Some(curve), _)), Some(target), Some(place)) =
            (&hazard, target_frequency, place)
        {
            let most = curve.points[0].1;
            if target >= most {
                let message = format!(
                    "the target frequency is not below {most} 1/year, with which the hazard curve begins: no gap could pass it"
                );
                let help = "begin the curve at lower intensities, or lower the target";
                reader.refuse::<()>(place, message, help)?;
            }
        }
        let (record, intensity) = variables?;
        let (hazard, hazard_file) = hazard?;
        Some(IdaSettings {
            record,
            intensity,
            measure: measure?,
            gaps: gaps?,
            limits: limits?,
            hazard,
            hazard_file,
            target_frequency,
            confidence: self.confidence.number_or(0.95)?,
            asked,
        })
    }
}

/// Whether a number stands here without a unit.
fn is_plain(written: &Field<Written>) -> bool {
    matches!(written, Field::Given(given) if given.value.is_plain())
}

/// Widths of gaps: a list, or a range.
type Widths = TableOr<Numbers, List<Written>>;

/// Whether all of them have no unit.
fn are_bare(widths: &Widths) -> bool {
    match widths {
        TableOr::Table(keys) => {
            let ends = [&keys.from, &keys.to];
            let listed = keys.values.iter().all(|list| match list {
                Field::Given(list) => list.value.0.iter().all(is_plain),
                Field::Wrong => false,
            });
            listed && ends.into_iter().flatten().all(is_plain)
        }
        TableOr::Value(List(list)) => list.iter().all(is_plain),
    }
}

/// Most widths of a range: every one has a fragility and a bootstrap of its own.
const MOST_WIDTHS: usize = 1000;

/// A list of widths, or a table with a range and a count.
fn widths(reader: &Reader<'_>, gaps: Located<Widths>) -> Option<Vec<f64>> {
    let Located { value, span } = gaps;
    let keys = match value {
        TableOr::Table(keys) => keys,
        TableOr::Value(List(list)) => {
            let mut widths: Vec<f64> = Vec::new();
            let width = |item: Field<Written>| {
                let Located { value, span } = item.located()?;
                let width = reader.keep(&span, "gaps", value.above_zero(Dimension::LENGTH))?;
                if widths.contains(&width) {
                    let message = format!("the width {width} m stands twice");
                    return reader.refuse(span, message, "leave one of them out");
                }
                widths.push(width);
                Some(width)
            };
            return all(list.into_iter().map(width));
        }
    };
    let width = |written: Written| written.above_zero(Dimension::LENGTH);
    let (values, _) = keys.read(reader, ("gaps", span.clone()), &width)?;
    let Some(count) = values.count() else {
        return reader.refuse(
            span,
            "the range of gaps has no `count`",
            "add `count = ...`",
        );
    };
    if count > MOST_WIDTHS {
        return reader.refuse(
            span,
            format!("{count} widths of the gap are more than {MOST_WIDTHS}"),
            "give a smaller `count`: curves are straight between widths",
        );
    }
    Some(values.numbers())
}

/// The state that every analysis has.
pub(crate) const POUNDING: &str = "pounding at the gaps of the case";

/// The state of a gap at a width (m).
pub(crate) fn pounding_at(gap: &str, width: f64) -> String {
    format!("{gap} {width} m")
}

impl LimitTable {
    /// Its name, by which answers and tables tell it from those before it, of which the first are
    /// the analysis' own.
    fn name(&self, reader: &Reader<'_>, before: &mut Vec<String>, own: usize) -> Option<String> {
        let Field::Given(Located { value: name, span }) = &self.name else {
            return None;
        };
        let name = &one_line(name.clone());
        if name.trim().is_empty() {
            let help = "give the state a name, by which answers and tables tell it from others";
            return reader.refuse(span.clone(), "the name is empty", help);
        }
        if let Some(at) = before.iter().position(|other| other == name) {
            let message = match at < own {
                true => format!("the analysis has a state \"{name}\" of its own"),
                false => format!("two limits have the name \"{name}\""),
            };
            return reader.refuse(span.clone(), message, "give each limit its own `name`");
        }
        before.push(name.clone());
        Some(name.clone())
    }

    /// Refuses places that the demand does not have, and numbers of levels that the case does
    /// not have.
    fn place(
        reader: &Reader<'_>,
        context: &Context,
        demand: DemandKind,
        [building, storey, level]: [Option<Range<usize>>; 3],
        numbers: &[Located<Whole<1>>],
    ) -> Option<()> {
        if demand.of_building().is_some() {
            return Some(());
        }
        if !demand.of_levels() {
            return match level {
                None => Some(()),
                Some(span) => reader.refuse(
                    span,
                    "it is of storeys, not of a level",
                    "name `building` and `storey`",
                ),
            };
        }
        let wrong = building.map(|span| ("building", span));
        if let Some((key, span)) = wrong.or(storey.map(|span| ("storey", span))) {
            let message = format!("the demand is of contact levels of gaps: it has no `{key}`");
            let help = "name a `level` in its place, or leave it out: then the worst level counts";
            return reader.refuse(span, message, help);
        }
        let levels = &context.base.as_ref()?.levels;
        let mut missing = numbers
            .iter()
            .filter(|number| number.value.0 > levels.len());
        let Some(Located {
            value: Whole(number),
            span,
        }) = missing.next()
        else {
            return Some(());
        };
        let message = format!("the case has no level {number}");
        let mut named = levels.iter().enumerate().take(SHOWN).map(|(i, name)| {
            let number = i + 1;
            format!("{number} is {name}")
        });
        let list: Vec<String> = named.by_ref().collect();
        let more = if levels.len() > SHOWN { ", ..." } else { "" };
        let help = format!(
            "levels count from 1, over all gaps of the case and from the bottom: it has {} ({}{more})",
            levels.len(),
            list.join(", ")
        );
        reader.refuse(span.clone(), message, help)
    }

    /// Refuses a link beside demands of anything else, other places beside those of links, and links
    /// that the case does not have or that join rotations.
    fn link(
        reader: &Reader<'_>,
        context: &Context,
        demand: Located<DemandKind>,
        places: [Option<Range<usize>>; 3],
        link: Option<Located<String>>,
    ) -> Option<Option<String>> {
        if !demand.value.of_links() {
            let Some(Located { span, .. }) = link else {
                return Some(None);
            };
            let help = "leave it out, or ask for `link_force` or `link_deformation`";
            return reader.refuse(span, "the demand is not of links: it has no `link`", help);
        }
        let keys = ["building", "storey", "level"].into_iter().zip(places);
        let mut wrong = keys.filter_map(|(key, span)| Some((key, span?)));
        if let Some((key, span)) = wrong.next() {
            let message = format!("the demand is of links: it has no `{key}`");
            let help = "name a `link` in its place, or leave it out: then all links count";
            return reader.refuse(span, message, help);
        }
        let links = &context.base.as_ref()?.case.links;
        if links.is_empty() {
            let help = "add a `[[link]]` to the case, or ask for another demand";
            return reader.refuse(demand.span, "the case has no link", help);
        }
        let rocks = |link: &Link| {
            let joined = link.foundations.as_ref();
            joined.is_some_and(|joined| joined.value == FoundationMotion::Rocking)
        };
        let (name, span) = match link {
            None => (None, demand.span),
            Some(Located { value, span }) => (Some(value), span),
        };
        if let Some(name) = &name
            && !links.iter().any(|link| link.name == *name)
        {
            let message = format!("the case has no link \"{name}\"");
            let names: Vec<&str> = links.iter().map(|link| link.name.as_str()).collect();
            return reader.refuse(span, message, format!("its links are {}", names.join(", ")));
        }
        let mut asked = links
            .iter()
            .filter(|link| name.as_ref().is_none_or(|n| link.name == *n));
        if asked.all(rocks) {
            let message = "the link joins rotations of foundations, by a moment: it has neither force nor displacement";
            let help = "ask for another link, or for `foundation_rotation` or `foundation_moment`";
            return reader.refuse(span, message, help);
        }
        Some(name)
    }

    /// The limit, without its name.
    fn read(self, reader: &Reader<'_>, context: &Context) -> Option<Limit> {
        let demand_at = self.demand.span();
        let demand = self.demand.value();
        let exceeds = self.exceeds.located().and_then(|exceeds| {
            let value = match demand {
                // More than none is one.
                Some(DemandKind::Impacts) => exceeds
                    .value
                    .of(Dimension::NUMBER)
                    .and_then(|number| FromZero::check(number).map(|()| number)),
                Some(demand) => exceeds.value.above_zero(demand.dimension()),
                None => exceeds.value.any().map(|quantity| quantity.value),
            };
            reader.keep(&exceeds.span, "exceeds", value)
        });
        let places = (self.building.span(), self.storey.span(), self.level.span());
        let has_building = self.building.is_some();
        let building = self.building.stated().and_then(|name| match name {
            None => Some(None),
            Some(name) => context.building(reader, &name).map(Some),
        });
        let excluded = |key, place: &Option<Range<usize>>| {
            let level = ("level", places.2.clone());
            not_both(reader, "[[ida.limit]]", (key, place.clone()), level)
        };
        excluded("building", &places.0)?;
        excluded("storey", &places.1)?;
        type Places = Option<Located<OneOrEach<Located<Whole<1>>>>>;
        let list = |places: Places| places.map_or(Vec::new(), |places| places.value.into_list());
        let storeys = self.storey.stated().map(list);
        let levels = self.level.stated().map(list);
        let link = self.link.stated();
        let (building, storeys, levels, link) = (building?, storeys?, levels?, link?);
        for places in [&storeys, &levels] {
            let twice = |(i, place): &(usize, &Located<Whole<1>>)| {
                places[..*i]
                    .iter()
                    .any(|other| other.value.0 == place.value.0)
            };
            if let Some((_, place)) = places.iter().enumerate().find(twice) {
                let message = format!("{} stands twice", place.value.0);
                return reader.refuse(place.span.clone(), message, "name it once");
            }
        }
        let link = match (demand, demand_at.clone()) {
            (Some(value), Some(span)) => {
                let at = [places.0.clone(), places.1.clone(), places.2.clone()];
                Self::link(reader, context, Located { value, span }, at, link)?
            }
            _ => None,
        };
        if let Some(demand) = demand {
            let at = [places.0.clone(), places.1.clone(), places.2.clone()];
            Self::place(reader, context, demand, at, &levels)?;
        }
        for Located {
            value: Whole(n),
            span,
        } in &storeys
        {
            if !has_building {
                let message = "a storey of which building?";
                return reader.refuse(span.clone(), message, "add `building = \"...\"`");
            }
            let count = context.base.as_ref()?.case.buildings[building?].mass.len();
            if *n > count {
                let message = format!("the building has no storey {n}");
                return reader.refuse(span.clone(), message, format!("it has {count}"));
            }
        }
        let demand = demand?;
        if let Some(OfBuilding { name, has, of }) = demand.of_building() {
            if let Some(span) = places.1.clone().or(places.2.clone()) {
                let message = format!("{name} is of a building, not of a storey or a level");
                return reader.refuse(span, message, "leave it out");
            }
            let buildings = &context.base.as_ref()?.case.buildings;
            let mut asked = match building {
                Some(index) => buildings[index..=index].iter(),
                None => buildings.iter(),
            };
            if !asked.any(has) {
                let span = places.0.clone().unwrap_or(demand_at?);
                let message = format!("{name} is known of buildings {of} only");
                let help = format!("ask for `storey_shear`, or for a building {of}");
                return reader.refuse(span, message, help);
            }
        }
        if demand.of_floors_that_turn() {
            let buildings = &context.base.as_ref()?.case.buildings;
            let mut asked = match building {
                Some(index) => buildings[index..=index].iter(),
                None => buildings.iter(),
            };
            if !asked.any(|b| b.plan.is_some()) {
                let span = places.0.unwrap_or(demand_at?);
                let message = "it is known of buildings with a plan only, whose floors turn";
                let help = "ask for `displacement` or `acceleration_absolute`, or for a building with a `plan`";
                return reader.refuse(span, message, help);
            }
        }
        if demand == DemandKind::ContactForce {
            let rigid = &context.base.as_ref()?.rigid;
            let mut asked = (1..=rigid.len()).filter(|level| asked_of(&levels, *level));
            if !rigid.is_empty() && asked.all(|level| rigid[level - 1]) {
                let message = "rigid impacts have no contact force";
                let help = "ask for the impulse instead: demand = \"impulse\"";
                return reader.refuse(demand_at?, message, help);
            }
        }
        if demand.of_laws() {
            let base = context.base.as_ref()?;
            let isolated = |law: &LawOfStorey| {
                law.storey == 0 && base.case.buildings[law.building].isolator.is_some()
            };
            let asked = |law: &&LawOfStorey| match storeys.as_slice() {
                [] => building.is_none_or(|b| b == law.building) && !isolated(law),
                storeys => building == Some(law.building) && asked_of(storeys, law.storey + 1),
            };
            let laws: Vec<&LawOfStorey> = base.laws.iter().filter(asked).collect();
            let without = match demand {
                _ if laws.is_empty() => Some((
                    "only storeys with a `law` have it: these stay linear",
                    "ask for `drift_ratio`, or give storeys a law that yields",
                )),
                DemandKind::Ductility if laws.iter().all(|law| !law.yields) => Some((
                    "only laws with a yield force have it",
                    "ask for `drift_ratio` or `residual_drift_ratio`",
                )),
                _ => None,
            };
            if let Some((message, help)) = without {
                let span = places.1.or(places.0).unwrap_or(demand_at?);
                return reader.refuse(span, message, help);
            }
            let has = |storey: usize| {
                let own = |law: &&LawOfStorey| law.storey + 1 == storey;
                let mut own = laws.iter().copied().filter(own);
                own.any(|law| law.yields || demand != DemandKind::Ductility)
            };
            if let Some(storey) = storeys.iter().find(|storey| !has(storey.value.0)) {
                let message =
                    "this storey has none: it stays linear, or its law has no yield force";
                return reader.refuse(storey.span.clone(), message, "leave it out");
            }
        }
        // What not all levels have, and what to do where the asked ones have it not.
        type Has = fn(&Gap, &ContactLevel) -> bool;
        let rare: Option<(Has, _, _, _)> = match demand {
            DemandKind::ColumnShear => Some((
                |_, l| l.left.is_column() || l.right.is_column(),
                "no gap of the case lets floors hit columns",
                "no columns are hit at this level",
                "ask for `contact_force`, or add `column` to a gap of the case",
            )),
            DemandKind::Opening => Some((
                |gap, _| gap.seat.is_some(),
                "no gap of the case is a joint with a seat",
                "this level is of a gap without a seat",
                "add `seat`, its width, to a gap of the case",
            )),
            _ => None,
        };
        if let Some((has, nowhere, not_here, help)) = rare {
            let gaps = &context.base.as_ref()?.case.gaps;
            let have = gaps
                .iter()
                .flat_map(|gap| gap.levels.iter().map(move |l| has(gap, l)));
            let have: Vec<bool> = have.collect();
            if !have.contains(&true) {
                return reader.refuse(demand_at?, nowhere, help);
            }
            let has_not = |level: &&Located<Whole<1>>| have.get(level.value.0 - 1) == Some(&false);
            if let Some(level) = levels.iter().find(has_not) {
                return reader.refuse(
                    level.span.clone(),
                    not_here,
                    "leave it out, or ask for another level",
                );
            }
        }
        Some(Limit {
            name: String::new(),
            demand,
            building,
            places: storeys
                .iter()
                .chain(&levels)
                .map(|number| number.value.0 - 1)
                .collect(),
            link,
            exceeds: exceeds?,
        })
    }
}

/// Whether a storey or a level, from 1, is among those asked for, or all are.
fn asked_of(places: &[Located<Whole<1>>], number: usize) -> bool {
    places.is_empty() || places.iter().any(|place| place.value.0 == number)
}

/// Levels that are named where there are more.
const SHOWN: usize = 12;

/// The curve through points, or from a file, and whether its intensities have no unit.
fn hazard_curve(
    reader: &Reader<'_>,
    hazard: Located<Hazard>,
    measure: Option<&IntensityMeasure>,
    file: Option<&Path>,
) -> Option<(HazardCurve, bool)> {
    let Located { value, span } = hazard;
    let mut is_bare = true;
    let wrong = |span: Range<usize>, reason: &str| {
        let help = "give intensities (SI, or with a unit) and mean annual frequencies (1/year), intensities rising, frequencies falling";
        reader.error(span, format!("the hazard curve: {reason}"), help)
    };
    // With the place of each point, here or in a file, and that of the whole curve.
    let (points, places, whole) = match (value, file) {
        (Hazard::Points(points), _) => {
            let points = all(points.into_iter().zip(1..).map(|(item, number)| {
                let item = item.located()?;
                let place = (item.span, format!("point {number}: "));
                let Ok([intensity, frequency]) = <[_; 2]>::try_from(item.value) else {
                    let (span, name) = place;
                    let reason = format!("{name}a point is a pair");
                    reader.errors.record(wrong(span, &reason));
                    return None;
                };
                let mut number = |item: Field<Written>, wanted: Option<Dimension>| {
                    let item = item.located()?;
                    is_bare &= item.value.is_plain();
                    let value = match wanted {
                        Some(wanted) => item.value.above_zero(wanted),
                        None => item.value.any().map(|quantity| quantity.value),
                    };
                    reader.keep(&item.span, "hazard", value)
                };
                let intensity = number(intensity, measure.map(IntensityMeasure::dimension));
                let frequency = frequency.located().and_then(|item| {
                    let value = AnnualFrequency::try_from(item.value).map(f64::from);
                    reader.keep(&item.span, "hazard", value)
                });
                Some((intensity.zip(frequency)?, place))
            }))?;
            let (points, places): (Vec<_>, Vec<_>) = points.into_iter().unzip();
            (points, places, (span, String::new()))
        }
        (Hazard::File(_), file) => {
            let refused = |refusals: Vec<hazard_file::Refusal>| {
                for (message, help) in refusals {
                    reader.refuse::<()>(span.clone(), message, help);
                }
            };
            let text = hazard_file::text(file?).map_err(refused).ok()?;
            let points = hazard_file::points(file?, &text, measure?);
            let (points, has_header) = points.map_err(refused).ok()?;
            is_bare = !has_header;
            let file = file?.display();
            let place = |line| (span.clone(), format!("{file}:{line}: "));
            let points = points.into_iter().map(|(line, point)| (point, place(line)));
            let (points, places): (Vec<_>, Vec<_>) = points.unzip();
            (points, places, (span.clone(), format!("{file}: ")))
        }
    };
    measure?;
    let Some((point, reason)) = HazardCurve::fault(&points) else {
        return Some((HazardCurve { points }, is_bare));
    };
    let (span, name) = places.into_iter().nth(point).unwrap_or(whole);
    reader.errors.record(wrong(span, &(name + reason)));
    None
}
