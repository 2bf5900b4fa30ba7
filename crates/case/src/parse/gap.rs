//! Gaps: neighbours, contact levels, and the model's parameters.

use std::ops::Range;

use pounding_shear_building::ELEVATION_TOLERANCE;
use schemars::JsonSchema;
use serde::Deserialize;

use super::column::ColumnTables;
use super::levels::{Between, Faces, Levels};
use super::parameters::{Values, arrange, not_whole, parameters};
use super::{Row, joined_name, name, spread};
use crate::document::{
    Entry, Field, Force, FreeKeys, Length, NotNegative, OneOrEach, Optional, Positive, Reader,
    Signed,
};
use crate::located::Located;
use crate::types::{ContactLevel, Facing, Gap, HitColumns, Side, bare_gap_width};

/// A gap between neighbours, or to a rigid wall
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename = "[[gap]]")]
pub(super) struct GapTable {
    /// Name of the gap, by default left-right
    name: Optional<String>,
    /// Left and right neighbour; "wall" is a rigid wall that moves with the ground
    between: Field<Between>,
    /// Width at rest (m), one for all levels or a list: in the order of `levels` where that is a
    /// list, otherwise bottom first
    width: Field<Widths>,
    /// Pairs of storey numbers that may touch, [1, { storey = 2 }] where a floor hits columns;
    /// "matching" for the floors at equal elevation only, or "all_floors" for each floor and
    /// the floor or the columns at its elevation
    levels: Optional<Levels<true>>,
    /// Floors this close in elevation are level (m), by default 0.01; named pairs that are
    /// not level are refused
    elevation_tolerance: Optional<Positive<Length>>,
    /// Lets named pairs of floors at different elevations act on each other as if they were
    /// level, with a warning; by default false
    floor_to_floor: Optional<bool>,
    /// Columns that floors of the neighbour hit between floors, or a list of them for both
    /// buildings
    column: Optional<ColumnTables>,
    /// moving, a wall that moves with the ground as by default, or fixed, one that stands still
    /// in space
    wall: Optional<Wall>,
    /// Positions across the row (m) of the contact points of floors that turn in plan, one or a
    /// list; by default both ends of the edge that they share
    points: Optional<OneOrEach<Signed<Length>>>,
    /// Seat width (m) of a deck that spans the joint: how far it opens is then reported, and
    /// whether the deck falls
    seat: Optional<Positive<Length>>,
    /// Impact model, author_year
    model: Field<String>,
    /// zero_penetration, no_tension, no_tension_latched or gap_shift, where the model offers
    /// more than one
    separation: Optional<String>,
    /// Penetrations (m) and forces (N) of the contact's spring, straight lines from the origin over
    /// them: [["0.5 mm", "10 kN"], ["1 mm", "50 kN"], ...], both increasing; in the place of
    /// `stiffness` and `exponent`, where the model holds for any spring
    spring: Optional<Vec<SpringPoint>>,
    /// Parameters of the model: stiffness (N/m^n), restitution, exponent, ..., one for all levels or a
    /// list in the order of `width`
    #[serde(rename = "*")]
    parameters: FreeKeys<Values>,
}

/// A penetration and a force.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(expecting = "a list of a penetration and a force\nfor example [\"0.5 mm\", \"10 kN\"]")]
struct SpringPoint(Positive<Length>, Positive<Force>);

/// How the wall of a gap moves
#[derive(Clone, Copy, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", expecting = "a text in quotes")]
enum Wall {
    /// With the ground
    Moving,
    /// Not at all
    Fixed,
}

type Widths = OneOrEach<Located<NotNegative<Length>>>;

impl GapTable {
    /// Reads a gap; also returns where its `between` stands. Where neighbours, levels or
    /// widths are wrong there is no such place, and the gap lies between walls: its model can
    /// be judged.
    pub(super) fn read(
        self,
        reader: &Reader<'_>,
        row: &Row,
    ) -> Option<(Gap, Option<Range<usize>>)> {
        let name = name(reader, self.name, "gap");
        let by_default = self.levels.is_none();
        let faces = Faces {
            between: self.between,
            levels: self.levels,
            tolerance: self.elevation_tolerance,
            columns: self.column,
        };
        let stated: Vec<Located<NotNegative<Length>>> = match &self.width {
            Field::Given(widths) => widths.value.clone().into_list(),
            Field::Wrong => Vec::new(),
        };
        let placed = placed(reader, faces, self.width, self.floor_to_floor, row);
        if let (Some((_, placed)), Some(span)) = (&placed, self.wall.span())
            && !placed.between.contains(&Side::Wall)
        {
            reader.refuse::<()>(
                span,
                "`wall` has no meaning in a gap between two buildings",
                "leave it out, or name \"wall\" in `between`",
            );
        }
        let points = self.points.located().map(|points| Located {
            value: points.value.spread(1),
            span: points.span,
        });
        let fixed_wall = self.wall.value() == Some(Wall::Fixed);
        let seat = self.seat.located().map(|seat| Located {
            value: seat.value.into(),
            span: seat.span,
        });
        let spring = self.spring.located().map(|points| Located {
            value: points
                .value
                .into_iter()
                .map(|point| (point.0.into(), point.1.into()))
                .collect(),
            span: points.span,
        });
        let count = placed.as_ref().map(|(_, placed)| placed.levels.len());
        let read = parameters(reader, self.parameters, (count, "contact level"));
        let (mut parameters, unread) = read;
        let model = self.model.located()?;
        not_whole(reader, (&model, true), unread);
        let (place, placed) = placed.unzip();
        if let Some(placed) = &placed {
            arrange(&mut parameters, &placed.order);
        }
        let placed = placed.unwrap_or(Placed {
            between: [Side::Wall; 2],
            names: Default::default(),
            levels: Vec::new(),
            order: Vec::new(),
            tolerance: ELEVATION_TOLERANCE,
            floor_to_floor: false,
            columns: [None, None],
        });
        let joined = || joined_name(reader, &placed.names, place.as_ref(), "gap");
        let name = name.unwrap_or_else(joined);
        ask(reader, &name, &stated, &placed, row);
        let gap = Gap {
            name,
            between: placed.between,
            levels: placed.levels,
            elevation_tolerance: placed.tolerance,
            floor_to_floor: placed.floor_to_floor,
            columns: placed.columns,
            fixed_wall,
            points,
            seat,
            model,
            separation: self.separation.located(),
            spring,
            parameters,
        };
        if by_default {
            ask_of_moat(reader, &gap, row);
        }
        Some((gap, place))
    }
}

/// Asks about the widest of the widths without a unit, unless it is above the height of a storey beside the gap, which a
/// warning says of widths with a unit too.
fn ask(
    reader: &Reader<'_>,
    name: &str,
    stated: &[Located<NotNegative<Length>>],
    placed: &Placed,
    row: &Row,
) {
    let bare = stated.iter().filter(|width| reader.is_bare(&width.span));
    let widest = bare.map(|width| f64::from(width.value)).fold(0.0, f64::max);
    let beside = |level: &ContactLevel| {
        let sides = placed.between.iter().zip([level.left, level.right]);
        let heights = sides.filter_map(|(side, facing)| storey_height(*side, facing, row));
        heights.fold(f64::INFINITY, f64::min)
    };
    let is_told = |level: &ContactLevel| level.width >= widest && level.width > beside(level);
    if placed.levels.iter().any(is_told) {
        return;
    }
    let what = format!("`width` of the gap \"{name}\" is");
    if let Some(question) = bare_gap_width(&what, widest) {
        reader.errors.ask(question);
    }
}

/// Height of the storey (m) that a side of a level belongs to.
fn storey_height(side: Side, facing: Facing, row: &Row) -> Option<f64> {
    let Side::Building(building) = side else {
        return None;
    };
    let storey = match facing {
        Facing::Floor(storey) | Facing::Column { storey, .. } => storey,
        Facing::Wall => return None,
    };
    let floors = row.elevations.get(building)?;
    let below = storey.checked_sub(1).map_or(Some(&0.0), |s| floors.get(s));
    Some(floors.get(storey)? - below?)
}

/// Asks about a wall that meets all floors of a building on isolators because nobody said which: moats end at the slab
/// above the isolators.
fn ask_of_moat(reader: &Reader<'_>, gap: &Gap, row: &Row) {
    let building = match gap.between {
        [Side::Building(b), Side::Wall] | [Side::Wall, Side::Building(b)] => row.readable.get(b),
        _ => None,
    };
    let Some(building) = building.filter(|b| b.isolator.is_some()) else {
        return;
    };
    if gap.levels.len() > 1 {
        reader.errors.ask(format!(
            "gap {}: its wall meets all {} floors of \"{}\", which stands on isolators, up to the roof: the wall of a moat meets the slab above the isolators alone, `levels = [1]`; `levels = \"matching\"` says that this wall is as high as the building",
            gap.name,
            gap.levels.len(),
            building.name.value
        ));
    }
}

/// Where a gap lies, and how wide it is.
struct Placed {
    between: [Side; 2],
    names: [String; 2],
    /// From the bottom.
    levels: Vec<ContactLevel>,
    /// The places of these levels among the named ones.
    order: Vec<usize>,
    tolerance: f64,
    floor_to_floor: bool,
    columns: [Option<Located<HitColumns>>; 2],
}

/// Where a gap lies, with the place of its `between`.
fn placed(
    reader: &Reader<'_>,
    faces: Faces<true>,
    width: Field<Widths>,
    floor_to_floor: Optional<bool>,
    row: &Row,
) -> Option<(Range<usize>, Placed)> {
    let faced = faces.read(reader, row)?;
    // The key must not look as if it paired floors by their numbers.
    let pairs = faced.listed && !faced.between.contains(&Side::Wall);
    let floor_to_floor = match floor_to_floor {
        None => false,
        Some(given) => {
            let given = given.located()?;
            if given.value && !pairs {
                return reader.refuse(
                    given.span,
                    "`floor_to_floor` has no meaning without pairs of floors in `levels`",
                    "name the pairs of storeys that may touch with `levels = [[1, 1], ...]`, or remove it",
                );
            }
            given.value
        }
    };
    let widths: Vec<Located<NotNegative<Length>>> =
        spread(reader, width.located()?, faced.pairs.len(), "contact level")?;
    let widths = widths.into_iter().map(|width| f64::from(width.value));
    let pairs = faced.pairs.into_iter().zip(widths);
    let levels = pairs.map(|(([left, right], place), width)| ContactLevel {
        left,
        right,
        width,
        place,
    });
    let mut levels: Vec<(usize, ContactLevel)> = levels.enumerate().collect();
    let elevations = faced.between.map(|side| match side {
        Side::Building(building) => row.elevations[building].as_slice(),
        Side::Wall => &[],
    });
    levels.sort_by(|(_, one), (_, other)| {
        let [one, other] = [one, other].map(|l| elevations_of([l.left, l.right], elevations));
        one[0]
            .total_cmp(&other[0])
            .then(one[1].total_cmp(&other[1]))
    });
    let (order, levels) = levels.into_iter().unzip();
    let placed = Placed {
        between: faced.between,
        names: faced.names,
        levels,
        order,
        tolerance: faced.tolerance,
        floor_to_floor,
        columns: faced.columns,
    };
    Some((faced.place, placed))
}

/// Elevations of both sides of a level (m).
fn elevations_of(sides: [Facing; 2], floors: [&[f64]; 2]) -> [f64; 2] {
    let of = |side: usize| match sides[side] {
        Facing::Floor(storey) => floors[side][storey],
        Facing::Column {
            storey,
            above_floor,
        } => {
            above_floor
                + if storey == 0 {
                    0.0
                } else {
                    floors[side][storey - 1]
                }
        }
        Facing::Wall => 0.0,
    };
    [of(0), of(1)]
}
