//! What a sweep says in a few sentences, on the terminal and on its page.

use pounding_catalogue::wording::{agreeing, counted};
use pounding_study::{Axis, Layout, Quantity, ResultReader, StudyFileError};
use serde::Serialize;

use super::answer::unit_of;
use super::numbers::figures;
use super::sentence::Sentence;

/// Quantities of which a sweep says the greatest value, and has figures: of the run's levels or storeys the greatest.
pub(super) const DRAWN: [&str; 5] = [
    "impacts",
    "peak_force",
    "peak_displacement",
    "peak_acceleration_absolute",
    "peak_ductility",
];

/// What the runs of a sweep, or of a part of it, come to.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepAnswer {
    /// Runs that are stored.
    pub runs: usize,
    /// Runs among them that failed.
    pub failed: usize,
    /// Runs in which a building collapsed.
    pub collapsed: usize,
    /// How many of the others have an impact; `None` without gaps, or where no run stood.
    pub runs_with_contact: Option<usize>,
    /// Maximum number of impacts at one level in a run.
    pub maximum_impacts_at_a_level: Option<f64>,
    /// Whether floors met without a contact force, by a jump of the velocity.
    pub rigid_impacts: bool,
    /// Maxima over the runs.
    pub maxima: Vec<Maximum>,
}

/// The maximum of a quantity over the runs, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Maximum {
    /// Name in the result.
    pub quantity: &'static str,
    /// What it is, for people.
    #[serde(skip)]
    heading: &'static str,
    /// Its value.
    pub value: f64,
    /// Its unit.
    pub unit: &'static str,
    /// Storey or level.
    pub at: String,
    /// The first run that has it.
    pub run: usize,
}

/// The greatest value of a column and its run.
#[derive(Clone, Copy)]
struct Greatest {
    value: f64,
    run: usize,
}

impl SweepAnswer {
    /// Reads what the runs of a result come to, some rows at a time.
    ///
    /// # Errors
    /// A result that cannot be read.
    pub fn of(result: &ResultReader) -> Result<Self, StudyFileError> {
        let layout = &result.description.layout;
        let impacts = columns(layout, "impacts");
        let forces = columns(layout, "peak_force");
        let mut greatest: Vec<Option<Greatest>> = vec![None; layout.columns()];
        let (mut failed, mut collapsed, mut closed) = (0, 0, 0);
        let mut rigid_impacts = false;
        result.each(|row, _| {
            failed += usize::from(row.ending.failed());
            collapsed += usize::from(row.ending.collapsed() && !row.ending.failed());
            closed += usize::from(impacts.iter().any(|c| row.values[*c] > 0.0));
            rigid_impacts |= impacts
                .iter()
                .zip(&forces)
                .any(|(n, force)| row.values[*n] > 0.0 && row.values[*force].is_nan());
            for (greatest, value) in greatest.iter_mut().zip(&row.values) {
                if !value.is_nan() && greatest.is_none_or(|g| *value > g.value) {
                    *greatest = Some(Greatest {
                        value: *value,
                        run: row.run,
                    });
                }
            }
            Ok::<(), StudyFileError>(())
        })?;
        let stood = result.rows > failed + collapsed;
        let over = |columns: &[usize]| {
            let known = columns
                .iter()
                .filter_map(|c| Some((*c, greatest.get(*c).copied()??)));
            // Of equal ones the first.
            known.fold(
                None,
                |most: Option<(usize, Greatest)>, (column, next)| match most
                    .is_some_and(|(_, most)| most.value >= next.value)
                {
                    true => most,
                    false => Some((column, next)),
                },
            )
        };
        let maxima = DRAWN[1..].iter().filter_map(|name| {
            let quantity = layout.quantities.iter().find(|q| q.name == *name)?;
            let (column, most) = over(&drawn_columns(result, name))?;
            // Where velocities jump there is no force: zero is that of levels that nothing hits.
            // Without contact there is none either, and no place of the greatest.
            let none = *name == "peak_force" && (rigid_impacts || closed == 0);
            if !most.value.is_finite() || (none && most.value == 0.0) {
                return None;
            }
            Some(Maximum {
                quantity: quantity.name,
                heading: quantity.long_name,
                value: most.value,
                unit: quantity.unit,
                at: of_column(layout, quantity, column - layout.range(name).start),
                run: most.run,
            })
        });
        Ok(Self {
            runs: result.rows,
            failed,
            collapsed,
            runs_with_contact: (stood && !impacts.is_empty()).then_some(closed),
            maximum_impacts_at_a_level: over(&impacts).map(|(_, most)| most.value),
            rigid_impacts,
            maxima: maxima.collect(),
        })
    }

    /// What a sweep says of impacts and maxima.
    #[must_use]
    pub fn sentences(&self) -> Vec<Sentence> {
        let mut told = Vec::new();
        let ended = self.failed + self.collapsed;
        if ended == self.runs {
            told.push(
                Sentence::default().words(match (self.failed, self.collapsed) {
                    (0, 0) => "There is no run.",
                    (0, _) => "No run stood: peaks and impacts are not known.",
                    _ => {
                        "No run was completed without a collapse: peaks and impacts are not known."
                    }
                }),
            );
        } else if let Some(closed) = self.runs_with_contact {
            told.push(self.of_contact(closed, self.runs - ended));
        }
        told.extend(self.maxima.iter().map(|maximum| self.of_maximum(maximum)));
        told
    }

    fn of_contact(&self, closed: usize, stood: usize) -> Sentence {
        let of = match stood == self.runs {
            true => String::new(),
            false => format!(" of the {stood} that neither failed nor collapsed"),
        };
        let most = self.maximum_impacts_at_a_level.unwrap_or(0.0);
        Sentence::default()
            .words(format!(
                "In {}{of} a gap closes ({:.1}\u{a0}%), with up to ",
                counted(closed, "run"),
                100.0 * closed as f64 / stood as f64
            ))
            .number("maximum impacts", 1.0, most.to_string())
            .words(format!(
                " {} at a level.",
                agreeing(&most, "impact", "impacts")
            ))
    }

    fn of_maximum(&self, maximum: &Maximum) -> Sentence {
        let (factor, unit) = unit_of(maximum.unit);
        let heading = maximum.heading.replace("maximum ", "peak ");
        let heading = heading.split(',').next().unwrap_or_default();
        let mut sentence = Sentence::default()
            .words(format!("The {heading} is at most "))
            .number(
                format!("maximum {}", maximum.quantity),
                factor,
                figures(factor * maximum.value),
            );
        if !unit.is_empty() {
            sentence = sentence.words(format!(" {unit}"));
        }
        let jumps = maximum.quantity == "peak_force" && self.rigid_impacts;
        sentence
            .words(", at ")
            .name(&maximum.at)
            .words(format!(" in run {}", maximum.run))
            .words(match (self.collapsed, jumps) {
                (0, false) => ".",
                (0, true) => "; rigid impacts have none.",
                (_, false) => "; of runs that collapsed it is not known.",
                (_, true) => {
                    "; rigid impacts have none, and of runs that collapsed it is not known."
                }
            })
    }
}

/// Columns of a quantity that has figures. Isolators go through many times the displacement at which they yield, for which
/// they are there: their ductility is none of a storey.
pub(super) fn drawn_columns(result: &ResultReader, name: &str) -> Vec<usize> {
    let d = &result.description;
    let all = columns(&d.layout, name);
    if name != "peak_ductility" {
        return all;
    }
    let case = d.case.parse::<toml::Table>().unwrap_or_default();
    let buildings = case.get("building").and_then(toml::Value::as_array);
    let on_isolators = buildings.into_iter().flatten().filter_map(|building| {
        building.get("isolator")?;
        building.get("name")?.as_str()
    });
    let on_isolators: Vec<&str> = on_isolators.collect();
    let storeys = all.into_iter().zip(&d.layout.storeys);
    let above = storeys
        .filter(|(_, storey)| storey.storeys != [1] || !on_isolators.contains(&storey.of.as_str()));
    above.map(|(column, _)| column).collect()
}

/// Columns of a quantity among the values of a row.
pub(super) fn columns(layout: &Layout, name: &str) -> Vec<usize> {
    match layout.quantities.iter().any(|q| q.name == name) {
        true => layout.range(name).collect(),
        false => Vec::new(),
    }
}

/// What a column of a quantity is of.
pub(super) fn of_column(layout: &Layout, quantity: &Quantity, index: usize) -> String {
    let labels = match quantity.axis {
        Axis::Run => return "the run".to_owned(),
        Axis::Storey => &layout.storeys,
        Axis::Level => &layout.levels,
        Axis::LinkLevel => &layout.link_levels,
        Axis::Building => return layout.buildings.get(index).cloned().unwrap_or_default(),
    };
    let place = labels.get(index);
    place.map_or(String::new(), |p| p.label.clone())
}
