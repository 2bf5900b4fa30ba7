//! Values of a variable, tried in the case.

use std::cell::RefCell;
use std::ops::Range;

use pounding_assembly::parameter_dimension;
use pounding_case::document::{Reader, Written};
use pounding_case::{Case, CaseTree, Dimension, Located};
use pounding_catalogue::numbers::six_digits;

use super::bare_numbers;
use super::rows::{self, Refused};
use super::values::unit_of;
use super::varied_entry::{VariedEntry, set_all, set_numbers};
use super::{Target, Value, Values};
use crate::case_text::{Edit, Variant, places_of_keys};

/// Tries values in the case.
pub(super) struct Trial<'r> {
    pub reader: Reader<'r>,
    pub base: &'r Case,
    pub tree: CaseTree<'r>,
    pub entries: Vec<VariedEntry>,
    /// The paths to them, as the study writes them.
    pub paths: String,
    /// Where the study names them.
    pub place: Range<usize>,
    /// Takes values that the case refuses alone, where they go together with others.
    pub refused_alone: Option<&'r RefCell<Vec<Range<usize>>>>,
}

impl Trial<'_> {
    /// What a variable of these values changes.
    pub(super) fn target(self, texts: Vec<String>) -> Target {
        Target::Entries {
            entries: self.entries,
            texts,
        }
    }

    /// Whether the case takes all of these numbers.
    pub(super) fn numbers(&self, numbers: Vec<Located<Written>>) -> Option<()> {
        let relative = self.entries.iter().any(|entry| entry.of_case.is_some());
        self.values(numbers.into_iter().map(|Located { value, span }| {
            // As it is written, so that its unit is checked, and as runs will have it.
            let given = self.reader.source[span.clone()].to_owned();
            let given = (!relative).then(|| set_all(&self.entries, &given));
            let number = value
                .any()
                .map(|quantity| set_numbers(&self.entries, quantity.value));
            (span, given.into_iter().chain(number).collect())
        }))
    }

    /// What the case asks about the greatest of numbers without a unit, and not about its own.
    pub(super) fn question(&self, values: &Values) -> Option<String> {
        let greatest = bare_numbers::greatest(values)?;
        let edits = set_numbers(&self.entries, greatest);
        // Where it is refused the case says why.
        let asked = Variant::new(&self.tree, &edits).asked().ok()?;
        // That of another value may change with this one.
        let number = six_digits(greatest);
        let new = |question: &String| {
            !self.base.asked.contains(question) && question.contains(number.as_str())
        };
        let question = asked.into_iter().find(new)?;
        Some(format!("the greatest of {}: {question}", self.paths))
    }

    /// Whether the case takes numbers within a range, which begins at this place, as it does its ends: it does
    /// not where numbers are to be whole, or floors level.
    pub(super) fn inner(&self, values: &Values, place: Range<usize>) -> Option<()> {
        /// Parts of a range of many values, at whose ends they are tried: a case is read and assembled for each.
        const PARTS: usize = 16;
        let numbers: Vec<Value> = match values {
            Values::Range {
                count: Some(count), ..
            } => {
                let last = count.saturating_sub(1);
                let mut places: Vec<usize> = (0..=PARTS).map(|part| last * part / PARTS).collect();
                places.push(1);
                places.sort_unstable();
                places.dedup();
                let within = places.into_iter().filter(|k| (1..last).contains(k));
                within.map(|k| values.at(k)).collect()
            }
            Values::Range { count: None, .. } | Values::Random(_) => vec![values.sample(0.4)],
            _ => return Some(()),
        };
        let refused = numbers.iter().find_map(|number| {
            let Value::Number(x) = number else {
                return None;
            };
            let refusal = self.refusal(&set_numbers(&self.entries, *x)).err()?;
            Some((*x, refusal))
        });
        let Some((x, refusal)) = refused else {
            return Some(());
        };
        if let Some(refused) = self.refused_alone {
            refused.borrow_mut().push(place);
            return Some(());
        }
        let Refusal { message, help, .. } = refusal;
        let of = match values {
            Values::Random(_) => "distribution",
            _ => "range",
        };
        let message = format!(
            "the case refuses {x} of this {of} for {}: {message}",
            self.paths
        );
        self.reader.refuse(place, message, help.unwrap_or_default())
    }

    /// Whether the case takes all of these texts.
    pub(super) fn texts<'t>(
        &self,
        texts: impl IntoIterator<Item = (Range<usize>, &'t str)>,
    ) -> Option<()> {
        let edits = |(place, text)| (place, vec![set_all(&self.entries, text)]);
        self.values(texts.into_iter().map(edits))
    }

    /// Tries values, each with its edits. What is wrong with the entry itself is said once,
    /// where the study names it.
    fn values(
        &self,
        values: impl IntoIterator<Item = (Range<usize>, Vec<Vec<Edit>>)>,
    ) -> Option<()> {
        let mut sound = true;
        for (place, edits) in values {
            let refused = |edits: &Vec<Edit>| self.refusal(edits).err();
            match edits.iter().find_map(refused) {
                None => {}
                Some(refusal) if refusal.of_key => return self.wrong(refusal, self.place.clone()),
                Some(refusal) => match self.refused_alone {
                    Some(refused) => refused.borrow_mut().push(place),
                    None => {
                        sound = false;
                        self.wrong::<()>(refusal, place);
                    }
                },
            }
        }
        sound.then_some(())
    }

    pub(super) fn wrong<T>(&self, refusal: Refusal, place: Range<usize>) -> Option<T> {
        let Refusal { message, help, .. } = refusal;
        let message = format!("the case refuses this for {}: {message}", self.paths);
        self.reader.refuse(place, message, help.unwrap_or_default())
    }

    /// Reads and assembles the case with these edits.
    pub(super) fn refusal(&self, edits: &[Edit]) -> Result<(), Refusal> {
        rows::tried(&self.tree, edits).map_err(|refused| {
            // An entry that the case leaves out brings its key with it.
            let of_key = match &refused {
                Refused::Text(e) => {
                    let mut keys = places_of_keys(edits).into_iter();
                    keys.any(|key| key.contains(&e.span.start))
                }
                Refused::Whole(_) => false,
            };
            let (message, help) = refused.into_message();
            Refusal {
                message,
                help,
                of_key,
            }
        })
    }
}

/// Why the case is wrong with a value.
pub(super) struct Refusal {
    message: String,
    help: Option<String>,
    /// Whether the key of the entry is what is wrong.
    of_key: bool,
}

/// Unit of the numbers of a variable: that of its texts, or that of the entries in the
/// case; empty if neither states one, or these have several.
pub(super) fn unit_of_numbers(places: &[Located<Written>], tried: &Trial<'_>) -> String {
    let mut stated = places
        .iter()
        .filter_map(|p| p.value.clone().any().ok()?.dimension);
    let dimension = stated.next().or_else(|| {
        let mut known = tried
            .entries
            .iter()
            .map(|entry| known_dimension(tried, entry));
        let first = known.next()??;
        known.all(|other| other == Some(first)).then_some(first)
    });
    dimension.map_or_else(String::new, unit_of)
}

/// Dimension of a key of a foundation, by the words of its path.
fn dimension_in_foundation(words: &[&str]) -> Dimension {
    let rocking = words.contains(&"rocking");
    match words.last().copied().unwrap_or_default() {
        "mass" => Dimension::MASS,
        "rotational_inertia" => Dimension::ROTATIONAL_INERTIA,
        "shear_wave_speed" => Dimension::VELOCITY,
        "density" => Dimension::DENSITY,
        "length" | "width" => Dimension::LENGTH,
        "stiffness" if rocking => Dimension::ROTATIONAL_STIFFNESS,
        "stiffness" => Dimension::STIFFNESS,
        "dashpot" if rocking => Dimension::ROTATIONAL_DASHPOT,
        "dashpot" => Dimension::DASHPOT,
        _ => Dimension::NUMBER,
    }
}

/// Dimension of an entry by its key, for the entries that studies vary most.
fn known_dimension(tried: &Trial<'_>, varied: &VariedEntry) -> Option<Dimension> {
    if varied.of_case.is_some() {
        return Some(Dimension::NUMBER);
    }
    let path = &varied.path;
    let text = path.to_string();
    let words: Vec<&str> = text
        .split(['.', '[', ']'])
        .filter(|w| !w.is_empty() && w.parse::<usize>().is_err())
        .collect();
    let key = *words.last()?;
    if path.table() == "gap" && !matches!(key, "width" | "elevation_tolerance" | "seat" | "points")
    {
        let mut gaps = tried.base.gaps.iter();
        let name = path.second(gaps.clone().map(|g| g.name.as_str()))?;
        let gap = gaps.find(|g| g.name.as_str() == name)?;
        let model = pounding_gap_element::registry::find(&gap.model.value).ok()?;
        let known = model.parameters.iter().find(|p| p.name == key)?;
        let exponent = gap.parameters.iter().find(|p| p.key.value == "exponent");
        return Some(parameter_dimension(
            model,
            known,
            exponent.and_then(|p| Some(p.at(0)?.value.value)),
        ));
    }
    if path.table() == "building" && words.contains(&"foundation") {
        return Some(dimension_in_foundation(&words));
    }
    Some(match key {
        "mass" => Dimension::MASS,
        "stiffness" => Dimension::STIFFNESS,
        "width"
        | "height"
        | "initial_displacement"
        | "elevation_tolerance"
        | "seat"
        | "points"
        | "distance"
        | "length"
        | "mass_centre"
        | "at" => Dimension::LENGTH,
        "initial_velocity" | "wave_speed" => Dimension::VELOCITY,
        "pga" => Dimension::ACCELERATION,
        "duration" | "step" | "output_step" | "time_step" | "delay" => Dimension::TIME,
        _ => Dimension::NUMBER,
    })
}
