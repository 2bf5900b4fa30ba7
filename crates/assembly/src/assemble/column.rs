//! Columns of a case that floors of the neighbour hit.

use std::sync::Arc;

use pounding_case::{
    Building, Case, CaseError, ContactLevel, Errors, Facing, Gap, HitColumns, Located, Side,
};
use pounding_gap_element::{GapElementError, ImpactModel, in_series};
use pounding_shear_building::{ColumnError, ContactLine, HitColumn, HitLine, decimal};
use pounding_time_history::{BuildingPoint, Floor, LevelResponse, System, short};

use crate::error::AssemblyError;

/// Flexural rigidity (N m2) below which no columns of a building are (a steel section of 100 mm has twice as much), where they
/// give their storey less than this part of its stiffness (-), too.
const LEAST_RIGIDITY: (f64, f64) = (5.0e5, 0.01);
/// Shear (N) below which no columns bear.
const LEAST_CAPACITY: f64 = 5.0e3;

/// A level of a gap at which columns are hit.
#[derive(Debug, Clone, Copy)]
struct Hit<'c> {
    /// The gap, from zero, and the level in it.
    gap: (usize, &'c Gap),
    level: (usize, &'c ContactLevel),
    /// 0 where the columns are those of the left neighbour, 1 of the right one.
    side: usize,
    /// Building and storey, from zero.
    building: usize,
    storey: usize,
    column: HitColumn,
    given: &'c Located<HitColumns>,
}

/// A column with its points, from the bottom.
struct Line<'c> {
    hits: Vec<Hit<'c>>,
    line: HitLine,
}

/// All levels of a case at which columns are hit.
pub(super) struct Hits<'c> {
    case: &'c Case,
    lines: Vec<Line<'c>>,
}

/// What a level of a gap is made of where columns are hit.
pub(super) struct HitLevel {
    /// The point of the column.
    pub point: Floor,
    /// 0 on the left, 1 on the right.
    pub side: usize,
    /// The law of contact and column.
    pub model: Arc<dyn ImpactModel>,
    /// Forces in the column.
    pub responses: Vec<LevelResponse>,
}

/// Columns that a gap gives and no floor hits, in words.
pub(super) fn never_hit(case: &Case) -> Vec<String> {
    let mut told = Vec::new();
    for gap in &case.gaps {
        for (k, (side, columns)) in gap.between.iter().zip(&gap.columns).enumerate() {
            let facing = |l: &ContactLevel| [l.left, l.right][k].is_column();
            let (Side::Building(b), Some(_)) = (side, columns) else {
                continue;
            };
            if gap.levels.iter().any(facing) {
                continue;
            }
            told.push(format!(
                "gap {}: no floor hits columns of {}, and `column` does nothing: the levels of this gap are floors at equal elevation; `levels = \"all_floors\"` lets the others hit columns",
                gap.name, case.buildings[*b].name.value
            ));
        }
    }
    told
}

/// Columns of each gap that are as soft or as weak as none are, in words: of a case whose columns can be hit.
pub(super) fn unlikely(case: &Case) -> Vec<String> {
    let hits = Hits::of(case);
    let lines = hits.as_ref().map_or(&[][..], |hits| &hits.lines);
    let mut told: Vec<String> = Vec::new();
    let mut gaps: Vec<(usize, usize)> = Vec::new();
    for hit in lines.iter().filter_map(|line| line.hits.first()) {
        let gap = (hit.gap.0, hit.side);
        let of_hit: Vec<String> = [soft(case, hit), weak(case, hit)]
            .into_iter()
            .flatten()
            .collect();
        if !of_hit.is_empty() && !gaps.contains(&gap) {
            gaps.push(gap);
            told.extend(of_hit);
        }
    }
    told
}

/// Columns that are next to nothing of their storey.
fn soft(case: &Case, hit: &Hit<'_>) -> Option<String> {
    let b = &case.buildings[hit.building];
    // A matrix does not say what a storey is.
    let stiffness = *b.stiffness.get(hit.storey)?;
    let own = hit.column.storey_stiffness();
    let rigidity = hit.given.value.flexural_rigidity;
    (rigidity < LEAST_RIGIDITY.0 && own < LEAST_RIGIDITY.1 * stiffness).then(|| {
        format!(
            "gap {}: the columns of {} that are hit in storey {} give {} % of its stiffness, {} of {} N/m: check the unit of `flexural_rigidity`, {} N m2; a number without one is in N m2",
            hit.gap.1.name,
            b.name.value,
            hit.storey + 1,
            short(100.0 * own / stiffness),
            short(own),
            short(stiffness),
            short(rigidity)
        )
    })
}

/// Columns that bear next to nothing.
fn weak(case: &Case, hit: &Hit<'_>) -> Option<String> {
    let capacity = hit.given.value.shear_capacity?;
    (capacity < LEAST_CAPACITY).then(|| {
        format!(
            "gap {}: the columns of {} that are hit bear a shear of {} N: check the unit of `shear_capacity`; a number without one is in N",
            hit.gap.1.name,
            case.buildings[hit.building].name.value,
            short(capacity)
        )
    })
}

impl<'c> Hits<'c> {
    /// Those of a case.
    ///
    /// # Errors
    /// All columns that cannot be hit.
    pub(super) fn of(case: &'c Case) -> Result<Self, CaseError> {
        let errors = Errors::default();
        let levels = case.gaps.iter().enumerate().flat_map(|(g, gap)| {
            let levels = gap.levels.iter().enumerate();
            levels.map(move |(l, level)| hit(case, (g, gap), (l, level)))
        });
        let hits = errors.all(levels.filter_map(Result::transpose));
        let lines = hits.and_then(|hits| {
            stiff_as_their_storeys(case, &hits)?;
            let mut lines: Vec<Vec<Hit<'c>>> = Vec::new();
            for hit in hits {
                let place = |h: &Hit<'_>| (h.gap.0, h.side, h.storey);
                match lines.iter_mut().find(|l| place(&l[0]) == place(&hit)) {
                    Some(line) => line.push(hit),
                    None => lines.push(vec![hit]),
                }
            }
            errors.all(lines.into_iter().map(|hits| line(case, hits)))
        });
        let lines = errors.finish(lines)?;
        Ok(Self { case, lines })
    }

    /// Columns of a building whose points have a mass, in the order of its coordinates.
    pub(super) fn with_mass(&self, building: usize) -> Vec<ContactLine> {
        let own = self.lines_with_mass(building);
        own.map(|(line, mass)| ContactLine {
            storey: line.hits[0].storey,
            line: line.line.clone(),
            mass,
        })
        .collect()
    }

    fn lines_with_mass(&self, building: usize) -> impl Iterator<Item = (&Line<'c>, f64)> {
        let own = self
            .lines
            .iter()
            .filter(move |l| l.hits[0].building == building);
        own.filter_map(|l| Some((l, l.hits[0].given.value.contact_mass?)))
    }

    /// Refuses laws of gaps that a column without mass cannot stand behind.
    pub(super) fn check_models(
        &self,
        models: &[Vec<Arc<dyn ImpactModel>>],
    ) -> Result<(), CaseError> {
        let errors = Errors::default();
        let levels = self.lines.iter().flat_map(|l| &l.hits);
        let checked =
            errors.all(levels.map(|hit| self.model(hit, &models[hit.gap.0][hit.level.0])));
        errors.finish(checked.map(|_| ()))
    }

    /// The law of contact and column.
    fn model(
        &self,
        hit: &Hit<'_>,
        model: &Arc<dyn ImpactModel>,
    ) -> Result<Arc<dyn ImpactModel>, CaseError> {
        if hit.given.value.contact_mass.is_some() {
            return Ok(Arc::clone(model));
        }
        in_series(Arc::clone(model), hit.column.point_stiffness()).map_err(|e: GapElementError| {
            let message = format!("the columns that are hit have no mass: {e}");
            let help = "add `contact_mass` to `column`, the mass of columns and facade that a hit sets in motion; or take linear_elastic or hertz_1882".to_owned();
            self.case.error(hit.gap.1.model.span.clone(), message, Some(help))
        })
    }

    /// What the level of this number of a gap is made of; `None` where no column is hit.
    pub(super) fn level(
        &self,
        system: &mut System,
        (gap, level): (usize, usize),
        model: &Arc<dyn ImpactModel>,
    ) -> Result<Option<HitLevel>, AssemblyError> {
        let within = |h: &Hit<'_>| h.gap.0 == gap && h.level.0 == level;
        let found = self.lines.iter().find_map(|line| {
            let point = line.hits.iter().position(within)?;
            Some((line, point))
        });
        let Some((line, point)) = found else {
            return Ok(None);
        };
        let hit = &line.hits[point];
        let building = hit.building;
        let ends = [hit.storey.checked_sub(1), Some(hit.storey)];
        let on_ends = |parts: [f64; 2]| -> Vec<(usize, f64)> {
            let ends = ends.into_iter().zip(parts);
            ends.filter_map(|(floor, part)| Some((floor?, part)))
                .collect()
        };
        let named = |name: &str, unit, weights, by_force| LevelResponse {
            name: name.to_owned(),
            unit,
            building,
            weights,
            by_force,
            capacity: hit.given.value.shear_capacity.filter(|_| unit == "N"),
        };
        let (weights, responses) = match hit.given.value.contact_mass {
            None => {
                // A contact pushes the right neighbour to the right.
                let pushed = [-1.0, 1.0][hit.side];
                let responses = hit.column.responses().into_iter().map(|r| {
                    let weights = on_ends([-r.by_drift, r.by_drift]);
                    named(r.name, r.unit, weights, pushed * r.by_force)
                });
                (on_ends(hit.column.shares()), responses.collect())
            }
            Some(_) => {
                let floors = system.buildings()[building].storeys();
                let before = self.lines_with_mass(building).map(|(line, _)| line);
                let before = before.take_while(|other| !std::ptr::eq(*other, line));
                let first = floors + before.map(|l| l.hits.len()).sum::<usize>();
                let responses = line.line.responses(point).into_iter().map(|r| {
                    let mut weights = on_ends([r.lower, r.upper]);
                    weights.extend((first..).zip(r.points));
                    named(r.name, r.unit, weights, 0.0)
                });
                (vec![(first + point, 1.0)], responses.collect())
            }
        };
        let point = system.add_point(BuildingPoint {
            building,
            storey: hit.storey,
            elevation: elevation(self.case, hit),
            weights,
        });
        Ok(Some(HitLevel {
            point,
            side: hit.side,
            model: self.model(hit, model)?,
            responses,
        }))
    }
}

/// Elevation of a hit (m): that of the floor that hits.
fn elevation(case: &Case, hit: &Hit<'_>) -> f64 {
    let (_, level) = hit.level;
    let other = [level.left, level.right][1 - hit.side].floor();
    match (hit.gap.1.between[1 - hit.side], other) {
        (Side::Building(b), Some(storey)) => case.buildings[b].elevations()[storey],
        _ => 0.0,
    }
}

/// The column of a level of a gap, if it has one.
fn hit<'c>(
    case: &'c Case,
    (gap_number, gap): (usize, &'c Gap),
    (level_number, level): (usize, &'c ContactLevel),
) -> Result<Option<Hit<'c>>, CaseError> {
    let sides = [level.left, level.right];
    let Some(side) = sides.iter().position(|facing| facing.is_column()) else {
        return Ok(None);
    };
    let (
        Facing::Column {
            storey,
            above_floor,
        },
        Side::Building(building),
        Some(given),
    ) = (sides[side], gap.between[side], &gap.columns[side])
    else {
        return Ok(None);
    };
    let b = &case.buildings[building];
    let columns = &given.value;
    let made = HitColumn::new(
        columns.flexural_rigidity,
        columns.shear_rigidity,
        columns.ends,
        b.height[storey],
        above_floor,
    );
    let column = made.map_err(|e| {
        let place = match e {
            ColumnError::NearFloor { .. } => level.place.clone(),
            _ => given.span.clone(),
        };
        let help = match e {
            ColumnError::NearFloor { .. } => format!(
                "let these floors touch: raise `elevation_tolerance` above their difference of {} m, or name the pair of floors with `floor_to_floor = true`",
                decimal(above_floor.min(b.height[storey] - above_floor))
            ),
            _ => "correct the value".to_owned(),
        };
        let message = format!("storey {} of \"{}\": {e}", storey + 1, b.name.value);
        case.error(place, message, Some(help))
    })?;
    remains_elastic(case, b, storey, given)?;
    Ok(Some(Hit {
        gap: (gap_number, gap),
        level: (level_number, level),
        side,
        building,
        storey,
        column,
        given,
    }))
}

/// Refuses columns of buildings whose floors or storeys move as those of no shear building.
fn remains_elastic(
    case: &Case,
    b: &Building,
    storey: usize,
    given: &Located<HitColumns>,
) -> Result<(), CaseError> {
    let refuse = |problem: String, help: &str| {
        Err(case.error(given.span.clone(), problem, Some(help.to_owned())))
    };
    if b.foundation.is_some() {
        return refuse(
            format!(
                "\"{}\" stands on a foundation that moves, and its columns would lean with it: columns that are hit are not modelled there",
                b.name.value
            ),
            "leave out `foundation` of this building, or `column`",
        );
    }
    let law = b.laws.iter().find(|law| match given.value.contact_mass {
        Some(_) => !law.storeys.is_empty(),
        None => law.storeys.contains(&storey),
    });
    let Some(law) = law else { return Ok(()) };
    match given.value.contact_mass {
        Some(_) => refuse(
            format!(
                "storeys of \"{}\" follow the law {}, which a building with a `contact_mass` on its columns cannot",
                b.name.value, law.model.value
            ),
            "leave out `contact_mass` where other storeys than the one that is hit yield, or let the building stay linear",
        ),
        None => refuse(
            format!(
                "storey {} of \"{}\" follows the law {}, and its columns, which are hit, stay elastic",
                storey + 1,
                b.name.value,
                law.model.value
            ),
            "let this storey stay linear; the forces in its columns then say whether it does",
        ),
    }
}

/// One column with all its points.
fn line<'c>(case: &Case, mut hits: Vec<Hit<'c>>) -> Result<Line<'c>, CaseError> {
    hits.sort_by(|a, b| elevation(case, a).total_cmp(&elevation(case, b)));
    let b = &case.buildings[hits[0].building];
    let several = |remedy: &str| {
        case.error(
            hits[1].level.1.place.clone(),
            format!(
                "{} floors hit the columns of storey {} of \"{}\", and each bows them for the others",
                hits.len(),
                hits[0].storey + 1,
                b.name.value
            ),
            Some(remedy.to_owned()),
        )
    };
    if hits.len() > 1 && hits[0].given.value.contact_mass.is_none() {
        return Err(several(
            "add `contact_mass` to `column`; points without mass stand for themselves",
        ));
    }
    let made = HitLine::new(hits.iter().map(|h| h.column).collect());
    let line = made.ok_or_else(|| several("name one of them alone in `levels`"))?;
    Ok(Line { hits, line })
}

/// Refuses columns that are stiffer than the storey in which they stand, those that face both
/// neighbours together.
fn stiff_as_their_storeys(case: &Case, hits: &[Hit<'_>]) -> Result<(), CaseError> {
    let errors = Errors::default();
    let checked = errors.all(hits.iter().map(|hit| {
        let b = &case.buildings[hit.building];
        // A matrix does not say what a storey is.
        let Some(stiffness) = b.stiffness.get(hit.storey) else {
            return Ok(());
        };
        let mut faced: Vec<(usize, usize)> = Vec::new();
        let same = hits.iter().filter(|h| (h.building, h.storey) == (hit.building, hit.storey));
        let own: f64 = same
            .filter(|h| {
                let place = (h.gap.0, h.side);
                let new = !faced.contains(&place);
                faced.push(place);
                new
            })
            .map(|h| h.column.storey_stiffness())
            .sum();
        if own <= *stiffness {
            return Ok(());
        }
        Err(case.error(
            hit.given.span.clone(),
            format!(
                "columns of {own} N/m stand in storey {} of \"{}\", which has a stiffness of {stiffness} N/m with them",
                hit.storey + 1,
                b.name.value
            ),
            Some("give E I of the columns that face the neighbour alone, cracked, or correct the storey stiffness, which has them in it".to_owned()),
        ))
    }));
    errors.finish(checked.map(|_| ()))
}
