//! The columns of a result: which quantities, of what, in which unit.

use pounding_shear_building::{EDGE_DISPLACEMENTS, OVERTURNING_RATIO};
use pounding_time_history::{
    BuildingOutcome, COLUMN_SHEARS, LevelMotion, LevelOutcome, LevelPlace, LinkLevelOutcome,
    LinkedMotion, NamedPeak, Outcome, StoreyPeaks, System, YieldingStorey,
};

use crate::run::with_base_moment;

/// What a quantity belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// The whole run.
    Run,
    /// Each storey of each building.
    Storey,
    /// Each contact level of each gap.
    Level,
    /// Each building with a stiffness matrix or a foundation.
    Building,
    /// Each level of each link.
    LinkLevel,
}

/// A quantity of the results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Quantity {
    /// Name of its dataset.
    pub name: &'static str,
    /// Unit, SI.
    pub unit: &'static str,
    /// What it is.
    pub long_name: &'static str,
    /// What it belongs to.
    pub axis: Axis,
}

const fn quantity(
    axis: Axis,
    name: &'static str,
    unit: &'static str,
    long_name: &'static str,
) -> Quantity {
    Quantity {
        name,
        unit,
        long_name,
        axis,
    }
}

/// Quantities of every study.
const QUANTITIES: [Quantity; 17] = [
    quantity(
        Axis::Storey,
        "peak_displacement",
        "m",
        "maximum displacement relative to the ground",
    ),
    quantity(
        Axis::Storey,
        "peak_drift_ratio",
        "1",
        "maximum storey drift over storey height",
    ),
    quantity(
        Axis::Storey,
        "peak_storey_shear",
        "N",
        "maximum storey shear",
    ),
    quantity(
        Axis::Storey,
        "peak_acceleration_absolute",
        "m s-2",
        "maximum absolute floor acceleration",
    ),
    quantity(Axis::Level, "impacts", "1", "number of impacts"),
    quantity(
        Axis::Level,
        "first_contact",
        "s",
        "time of the first contact, missing without contact",
    ),
    quantity(
        Axis::Level,
        "peak_force",
        "N",
        "maximum contact force, missing for rigid impacts",
    ),
    quantity(Axis::Level, "peak_penetration", "m", "maximum penetration"),
    quantity(
        Axis::Level,
        "approach_velocity_max",
        "m s-1",
        "maximum velocity at closure",
    ),
    quantity(Axis::Level, "impulse", "N s", "impulse of all impacts"),
    quantity(
        Axis::Level,
        "impulse_max",
        "N s",
        "maximum impulse of one impact",
    ),
    quantity(
        Axis::Level,
        "energy_dissipated",
        "J",
        "energy dissipated in contact",
    ),
    quantity(
        Axis::Run,
        "energy_input",
        "J",
        "energy put in by the ground and by forces on floors at the end of the run",
    ),
    quantity(
        Axis::Run,
        "energy_viscous",
        "J",
        "energy dissipated by viscous damping",
    ),
    quantity(
        Axis::Run,
        "energy_hysteretic",
        "J",
        "energy dissipated by yielding",
    ),
    quantity(
        Axis::Run,
        "energy_impact",
        "J",
        "energy dissipated in contacts",
    ),
    quantity(
        Axis::Run,
        "energy_residual_ratio",
        "1",
        "maximum residual of the energy ledger over the largest input",
    ),
];

/// The quantity of studies that ask for it.
pub const ISOLATED_DEMAND: Quantity = quantity(
    Axis::Level,
    "isolated_demand",
    "m",
    "maximum approach of the isolated buildings: the gap that just keeps them apart, infinite where they collapse",
);

/// Peaks of storeys of studies that ask for them, of the run that gives [`ISOLATED_DEMAND`].
const ISOLATED_PEAKS: [Quantity; 4] = [
    quantity(
        Axis::Storey,
        "isolated_peak_displacement",
        "m",
        "maximum displacement relative to the ground without gaps, missing where the isolated buildings collapse",
    ),
    quantity(
        Axis::Storey,
        "isolated_peak_drift_ratio",
        "1",
        "maximum storey drift over storey height without gaps, missing where the isolated buildings collapse",
    ),
    quantity(
        Axis::Storey,
        "isolated_peak_storey_shear",
        "N",
        "maximum storey shear without gaps, missing where the isolated buildings collapse",
    ),
    quantity(
        Axis::Storey,
        "isolated_peak_acceleration_absolute",
        "m s-2",
        "maximum absolute floor acceleration without gaps, missing where the isolated buildings collapse",
    ),
];

/// What storeys with a law went through, in studies where some storey has it.
#[derive(Debug)]
pub(super) struct YieldingQuantity {
    /// It of a storey; `None` of one without a law.
    of: fn(Option<&YieldingStorey>) -> f64,
    /// Whether only laws with a yield force have it.
    of_yield_force: bool,
    /// It in the results, one a storey.
    pub(super) storey: Quantity,
    /// The same without pounding.
    pub(super) isolated: Quantity,
}

static YIELDING: [YieldingQuantity; 2] = [
    YieldingQuantity {
        of: |storey| {
            let ductility = storey.and_then(|storey| storey.ductility);
            ductility.map_or(f64::NAN, |ductility| ductility.value)
        },
        of_yield_force: true,
        storey: quantity(
            Axis::Storey,
            "peak_ductility",
            "1",
            "maximum ductility, the drift over that at first yield, missing of storeys without a yield force",
        ),
        isolated: quantity(
            Axis::Storey,
            "isolated_peak_ductility",
            "1",
            "maximum ductility without gaps, the drift over that at first yield, missing of storeys without a yield force, and where the isolated buildings collapse",
        ),
    },
    YieldingQuantity {
        of: |storey| storey.map_or(0.0, |storey| storey.residual_drift_ratio),
        of_yield_force: false,
        storey: quantity(
            Axis::Storey,
            "residual_drift_ratio",
            "1",
            "residual drift ratio, the drift at the end less what elastic unloading gives back over storey height, signed",
        ),
        isolated: quantity(
            Axis::Storey,
            "isolated_residual_drift_ratio",
            "1",
            "residual drift ratio without gaps, the drift at the end less what elastic unloading gives back over storey height, signed, missing where the isolated buildings collapse",
        ),
    },
];

/// Quantities of studies with links that join displacements.
const OF_LINKS: [Quantity; 2] = [
    quantity(
        Axis::LinkLevel,
        "peak_link_force",
        "N",
        "maximum force of the link, missing between rotations of foundations, which it joins by a moment",
    ),
    quantity(
        Axis::LinkLevel,
        "peak_link_deformation",
        "m",
        "maximum deformation of the link, missing between rotations of foundations",
    ),
];

/// Names of the quantities of storeys without pounding.
pub fn isolated_peaks() -> impl Iterator<Item = &'static str> {
    let yielding = YIELDING.iter().map(|q| &q.isolated);
    ISOLATED_PEAKS.iter().chain(yielding).map(|q| q.name)
}

/// Which quantities of the buildings without pounding a study asks for.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct IsolatedQuantities {
    /// The gap that just keeps them apart, of each level.
    pub demand: bool,
    /// The peaks of each storey.
    pub peaks: bool,
}

/// What a run without gaps says, in which links stay.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IsolatedRun {
    /// The isolated demand of each level (m).
    pub demand: Vec<f64>,
    /// Peaks of the storeys of all buildings, and what those with a law went through; `None` where a building collapses
    /// by itself.
    pub storeys: Option<Vec<(StoreyPeaks, Option<YieldingStorey>)>>,
}

/// The quantity of studies of buildings with a stiffness matrix or a foundation.
const BASE_MOMENT: Quantity = quantity(
    Axis::Building,
    "peak_base_moment",
    "N m",
    "maximum overturning moment at the base",
);

/// A response of buildings with a name, such as the rotation of a foundation or of floors, that
/// studies keep.
#[derive(Debug, PartialEq, Eq)]
pub struct Response {
    /// What it is called.
    pub name: &'static str,
    /// Names among the responses of a building, of which the maximum counts; of a quantity of
    /// storeys they end there with the number of the storey, as in `rotation_2`.
    parts: &'static [&'static str],
    /// Its peaks in the results, one a storey or a building in [`Layout::buildings`]; NaN where a
    /// building has no such response.
    pub peak: Quantity,
}

impl Response {
    /// Whether a response of this name belongs to it.
    #[must_use]
    pub fn is(&self, name: &str) -> bool {
        self.parts.iter().any(|part| match self.peak.axis {
            Axis::Storey => {
                let storey = name.strip_prefix(part).and_then(|n| n.strip_prefix('_'));
                storey.is_some_and(|n| n.parse::<usize>().is_ok())
            }
            _ => name == *part,
        })
    }

    /// Its peak in the outcome of a building, the maximum over the storeys where each has one.
    #[must_use]
    pub fn of(&self, building: &BuildingOutcome) -> Option<f64> {
        let responses = building.responses.iter();
        let own = responses.filter(|r| self.is(&r.name));
        own.map(|r| r.peak.value).reduce(f64::max)
    }

    /// The same of one storey, from 1.
    fn of_storey(&self, building: &BuildingOutcome, storey: usize) -> Option<f64> {
        let named = |name: &str| {
            let mut parts = self.parts.iter();
            parts.any(|part| name == format!("{part}_{storey}"))
        };
        let responses = building.responses.iter();
        let own = responses.filter(|r| named(&r.name));
        own.map(|r| r.peak.value).reduce(f64::max)
    }
}

const fn response(name: &'static str, parts: &'static [&'static str], peak: Quantity) -> Response {
    Response { name, parts, peak }
}

/// The responses that studies keep, where a building has them.
pub static RESPONSES: [Response; 9] = [
    response(
        "foundation_sway",
        &["foundation_sway"],
        quantity(
            Axis::Building,
            "peak_foundation_sway",
            "m",
            "maximum displacement of the foundation relative to the ground",
        ),
    ),
    response(
        "foundation_rotation",
        &["foundation_rotation"],
        quantity(
            Axis::Building,
            "peak_foundation_rotation",
            "rad",
            "maximum rotation of the foundation",
        ),
    ),
    response(
        "foundation_shear",
        &["foundation_shear"],
        quantity(
            Axis::Building,
            "peak_foundation_shear",
            "N",
            "maximum force of the sway spring of the soil",
        ),
    ),
    response(
        "foundation_moment",
        &["foundation_moment"],
        quantity(
            Axis::Building,
            "peak_foundation_moment",
            "N m",
            "maximum moment of the rocking spring of the soil",
        ),
    ),
    response(
        OVERTURNING_RATIO,
        &[OVERTURNING_RATIO],
        quantity(
            Axis::Building,
            "peak_overturning_ratio",
            "1",
            "maximum moment on the foundation over half of weight times length",
        ),
    ),
    response(
        "rotation",
        &["rotation"],
        quantity(
            Axis::Storey,
            "peak_rotation",
            "rad",
            "maximum rotation of a floor that turns in plan",
        ),
    ),
    response(
        "edge_displacement",
        &EDGE_DISPLACEMENTS,
        quantity(
            Axis::Storey,
            "peak_edge_displacement",
            "m",
            "maximum displacement along the row of both ends of a floor that turns in plan",
        ),
    ),
    response(
        "displacement_across",
        &["displacement_across"],
        quantity(
            Axis::Storey,
            "peak_displacement_across",
            "m",
            "maximum displacement across the row of a floor that turns in plan",
        ),
    ),
    response(
        "acceleration_across",
        &["acceleration_across"],
        quantity(
            Axis::Storey,
            "peak_acceleration_across",
            "m s-2",
            "maximum absolute acceleration across the row of a floor that turns in plan",
        ),
    ),
];

/// A response of contact levels that studies keep, where some level has it.
#[derive(Debug)]
pub struct LevelQuantity {
    /// Whether a response of this name belongs to it.
    pub is: fn(&str) -> bool,
    /// It in the outcome of a level, if the level has it.
    pub of: fn(&LevelOutcome) -> Option<&NamedPeak>,
    /// Its peaks in the results, one a level; NaN where a level has no such response.
    pub peak: Quantity,
}

/// The responses of levels that studies keep.
pub static LEVEL_QUANTITIES: [LevelQuantity; 2] = [COLUMN_SHEAR, OPENING];

/// The larger of the shears of a column that is hit, below and above the hit.
pub const COLUMN_SHEAR: LevelQuantity = LevelQuantity {
    is: |name| COLUMN_SHEARS.contains(&name),
    of: LevelOutcome::column_shear,
    peak: quantity(
        Axis::Level,
        "peak_column_shear",
        "N",
        "maximum shear of the columns that are hit, below or above the hit, missing where floors hit floors",
    ),
};

/// How far a joint with a seat opens.
pub const OPENING: LevelQuantity = LevelQuantity {
    is: |name| name == LevelMotion::Opening.name(),
    of: LevelOutcome::joint_opening,
    peak: quantity(
        Axis::Level,
        "peak_opening",
        "m",
        "maximum opening of the joint beyond its width at rest, missing where gaps have no seat",
    ),
};

/// The peak of a storey that a quantity of this name holds.
fn storey_peak(name: &str) -> Option<fn(&StoreyPeaks) -> f64> {
    match name {
        "peak_displacement" => Some(|s| s.displacement.value),
        "peak_drift_ratio" => Some(|s| s.drift_ratio.value),
        "peak_storey_shear" => Some(|s| s.storey_shear.value),
        "peak_acceleration_absolute" => Some(|s| s.acceleration_absolute.value),
        _ => None,
    }
}

/// Names of all quantities that results may have.
pub fn quantity_names() -> impl Iterator<Item = &'static str> {
    QUANTITIES
        .iter()
        .chain([&BASE_MOMENT, &ISOLATED_DEMAND])
        .chain(&ISOLATED_PEAKS)
        .chain(YIELDING.iter().flat_map(|q| [&q.storey, &q.isolated]))
        .chain(&OF_LINKS)
        .chain(LEVEL_QUANTITIES.iter().map(|q| &q.peak))
        .chain(RESPONSES.iter().map(|r| &r.peak))
        .map(|q| q.name)
}

/// Whether a name is taken by the results.
#[must_use]
pub fn is_result(name: &str) -> bool {
    let labels = [
        "building",
        "storey_building",
        "storey_number",
        "level_gap",
        "level_left_storey",
        "level_right_storey",
        "storey_elevation",
        "level_left_elevation",
        "level_right_elevation",
        "level_width",
        "link_level",
        "link_level_link",
        "link_level_left_storey",
        "link_level_right_storey",
        "link_level_left_elevation",
        "link_level_right_elevation",
        "failures",
    ];
    quantity_names().any(|q| q == name) || labels.contains(&name)
}

/// A storey, a contact level or a level of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Place {
    /// Label, unique along its axis.
    pub label: String,
    /// Building, gap or link.
    pub of: String,
    /// Storeys from 1: of the building, or left and right of the gap or link; 0 is a wall or a foundation.
    pub storeys: Vec<usize>,
    /// Elevations (m) of these storeys; `None` for a wall, and where a variable of the study
    /// changes a storey height below.
    pub elevations: Vec<Option<f64>>,
    /// Width of a contact level at rest (m); `None` for others, and where a variable changes it.
    pub width: Option<f64>,
}

impl Place {
    /// Whether a link joins rotations here, by a moment in the place of a force.
    #[must_use]
    pub fn joins_rotations(&self) -> bool {
        let joined = LinkedMotion::FoundationRotation.label();
        joined.is_some_and(|label| self.label == format!("{} {label}", self.of))
    }

    /// Label with the elevations of both sides of a level, as far as all runs share them.
    #[must_use]
    pub fn heading(&self) -> String {
        let (&[left, right], &[z_left, z_right]) = (&self.storeys[..], &self.elevations[..]) else {
            return self.label.clone();
        };
        let varies = |storey: usize, z: Option<f64>| storey > 0 && z.is_none();
        if varies(left, z_left) || varies(right, z_right) {
            return self.label.clone();
        }
        let place = LevelPlace {
            across: None,
            joins: LinkedMotion::Floors,
            storeys: [left, right].map(|n| (n > 0).then_some(n)),
            elevations: [z_left, z_right],
        };
        // One of several points of these floors.
        if self.label != format!("{} {}", self.of, place.label()) {
            return self.label.clone();
        }
        format!("{} {place}", self.of)
    }
}

/// The shape of the results of a study: the same for all its runs.
#[derive(Debug, Clone, PartialEq)]
pub struct Layout {
    /// Storeys of all buildings, from the left and from the bottom.
    pub storeys: Vec<Place>,
    /// Contact levels of all gaps, in the order of the case and from the bottom.
    pub levels: Vec<Place>,
    /// Levels of all links, in the order of the case and from the bottom.
    pub link_levels: Vec<Place>,
    /// Names of the buildings with a stiffness matrix or a foundation, from the left.
    pub buildings: Vec<String>,
    /// Quantities in the order of the columns.
    pub quantities: Vec<Quantity>,
}

impl Layout {
    /// The shape of the results of a system, with openings of joints also where some run alone has a seat.
    #[must_use]
    pub fn of(system: &System, isolated: IsolatedQuantities, brings_seat: bool) -> Self {
        let storeys = system.buildings().iter().flat_map(|b| {
            (1..=b.storeys()).map(|n| Place {
                label: format!("{} {n}", b.name()),
                of: b.name().to_owned(),
                storeys: vec![n],
                elevations: vec![Some(b.elevations()[n - 1])],
                width: None,
            })
        });
        let levels = system.gaps().iter().flat_map(|gap| {
            system.levels_of(gap).iter().map(|l| Place {
                label: format!("{} {}", gap.name, l.place.label()),
                of: gap.name.clone(),
                storeys: l.place.storeys.map(|n| n.unwrap_or(0)).to_vec(),
                elevations: l.place.elevations.to_vec(),
                width: Some(l.width),
            })
        });
        let links = system.links().iter().enumerate();
        let link_levels = links.flat_map(|(index, link)| {
            let places = system.link_levels(index).into_iter();
            places.map(|place| Place {
                label: format!("{} {}", link.name, place.label()),
                of: link.name.clone(),
                storeys: place.storeys.map(|n| n.unwrap_or(0)).to_vec(),
                elevations: place.elevations.to_vec(),
                width: None,
            })
        });
        let buildings = with_base_moment(system).map(str::to_owned);
        Self::from_places(
            [storeys.collect(), levels.collect(), link_levels.collect()],
            buildings.collect(),
            |response| {
                let mut rows = system.buildings().iter().flat_map(|b| b.responses());
                rows.any(|row| response.is(&row.name))
            },
            |own| {
                let brought = brings_seat && own.peak == OPENING.peak;
                brought || system.level_responses().any(|(_, r)| (own.is)(&r.name))
            },
            |own| {
                let elements = system.elements().iter();
                let mut elements = elements.filter(|e| system.storey_of_element(e.place).is_some());
                elements.any(|e| e.yield_deformation.is_some() || !own.of_yield_force)
            },
            isolated,
        )
    }

    /// The shape with these storeys, levels and levels of links, these buildings with a base moment, the
    /// responses that some of them and some of the levels have, and what storeys with a law have; and what is known
    /// without pounding.
    pub(super) fn from_places(
        [storeys, levels, link_levels]: [Vec<Place>; 3],
        buildings: Vec<String>,
        has: impl Fn(&Response) -> bool,
        levels_have: impl Fn(&LevelQuantity) -> bool,
        storeys_have: impl Fn(&YieldingQuantity) -> bool,
        isolated: IsolatedQuantities,
    ) -> Self {
        let mut quantities = QUANTITIES.to_vec();
        if !buildings.is_empty() {
            quantities.push(BASE_MOMENT);
            let responses = RESPONSES.iter().filter(|r| has(r));
            quantities.extend(responses.map(|r| r.peak));
        }
        let of_levels = LEVEL_QUANTITIES.iter().filter(|q| levels_have(q));
        quantities.extend(of_levels.map(|q| q.peak));
        if link_levels.iter().any(|level| !level.joins_rotations()) {
            quantities.extend(OF_LINKS);
        }
        let yielding: Vec<_> = YIELDING.iter().filter(|q| storeys_have(q)).collect();
        quantities.extend(yielding.iter().map(|q| q.storey));
        if isolated.demand {
            quantities.push(ISOLATED_DEMAND);
        }
        if isolated.peaks {
            quantities.extend(ISOLATED_PEAKS);
            quantities.extend(yielding.iter().map(|q| q.isolated));
        }
        Self {
            storeys,
            levels,
            link_levels,
            buildings,
            quantities,
        }
    }

    /// Keeps the quantities of these names alone, in the order that all have.
    pub fn keep<N: AsRef<str>>(&mut self, names: &[N]) {
        let kept = |q: &Quantity| names.iter().any(|name| name.as_ref() == q.name);
        self.quantities.retain(kept);
    }

    /// Number of values of a quantity.
    #[must_use]
    pub fn width(&self, axis: Axis) -> usize {
        match axis {
            Axis::Run => 1,
            Axis::Storey => self.storeys.len(),
            Axis::Level => self.levels.len(),
            Axis::Building => self.buildings.len(),
            Axis::LinkLevel => self.link_levels.len(),
        }
    }

    /// Number of all values of a run.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.quantities.iter().map(|q| self.width(q.axis)).sum()
    }

    /// Columns of a quantity; empty if the study has none of that name.
    #[must_use]
    pub fn range(&self, name: &str) -> std::ops::Range<usize> {
        let mut at = 0;
        for q in &self.quantities {
            let width = self.width(q.axis);
            if q.name == name {
                return at..at + width;
            }
            at += width;
        }
        at..at
    }

    /// Puts an outcome into columns, with what the run without gaps says.
    pub fn fill(&self, outcome: &Outcome, isolated: &IsolatedRun, out: &mut Vec<f64>) {
        out.clear();
        let storeys = || outcome.buildings.iter().flat_map(|b| &b.storeys);
        let levels = || outcome.gaps.iter().flat_map(|g| &g.levels);
        let end = outcome.energy.end;
        for quantity in &self.quantities {
            if self.add_isolated(quantity, isolated, out) {
                continue;
            }
            if let Some(peak) = storey_peak(quantity.name) {
                out.extend(storeys().map(peak));
                continue;
            }
            if let Some(own) = YIELDING.iter().find(|q| q.storey == *quantity) {
                let storeys = outcome.buildings.iter().flat_map(|b| &b.yielding);
                out.extend(storeys.map(|storey| (own.of)(storey.as_ref())));
                continue;
            }
            match quantity.name {
                "impacts" => out.extend(levels().map(|l| l.impacts as f64)),
                "first_contact" => {
                    out.extend(levels().map(|l| l.first_contact.unwrap_or(f64::NAN)));
                }
                "peak_force" => out.extend(levels().map(|l| l.peak_force.value)),
                "peak_penetration" => out.extend(levels().map(|l| l.peak_penetration.value)),
                "approach_velocity_max" => out.extend(levels().map(|l| l.approach_velocity_max)),
                "impulse" => out.extend(levels().map(|l| l.impulse)),
                "impulse_max" => out.extend(levels().map(|l| l.impulse_max)),
                "energy_dissipated" => out.extend(levels().map(|l| l.energy_dissipated)),
                "peak_link_force" => out.extend(self.of_links(outcome, |l| l.force.value)),
                "peak_link_deformation" => {
                    out.extend(self.of_links(outcome, |l| l.deformation.value));
                }
                "energy_input" => out.push(end.input),
                "energy_viscous" => out.push(end.viscous),
                "energy_hysteretic" => out.push(end.hysteretic),
                "energy_impact" => out.push(end.impact),
                "energy_residual_ratio" => out.push(outcome.energy.residual_ratio),
                "peak_base_moment" => {
                    let moments = outcome.buildings.iter().filter_map(|b| b.base_moment);
                    out.extend(moments.map(|m| m.value));
                }
                _ => {
                    if let Some(own) = LEVEL_QUANTITIES.iter().find(|q| q.peak == *quantity) {
                        out.extend(
                            levels().map(|l| (own.of)(l).map_or(f64::NAN, |r| r.peak.value)),
                        );
                        continue;
                    }
                    let own = RESPONSES.iter().find(|r| r.peak == *quantity);
                    out.extend(own.into_iter().flat_map(|r| Self::response(r, outcome)));
                }
            }
        }
    }

    /// A peak of each level of the links; NaN where rotations are joined.
    fn of_links(
        &self,
        outcome: &Outcome,
        peak: fn(&LinkLevelOutcome) -> f64,
    ) -> impl Iterator<Item = f64> {
        let levels = outcome.links.iter().flat_map(|link| &link.levels);
        let places = self.link_levels.iter().zip(levels);
        places.map(move |(place, level)| match place.joins_rotations() {
            true => f64::NAN,
            false => peak(level),
        })
    }

    /// Peaks of a response, of each storey or of each building with a base moment; NaN where a
    /// building has none.
    fn response(response: &Response, outcome: &Outcome) -> Vec<f64> {
        let mut peaks = Vec::new();
        for building in &outcome.buildings {
            if response.peak.axis == Axis::Storey {
                let storeys = 1..=building.storeys.len();
                let of = |n| response.of_storey(building, n).unwrap_or(f64::NAN);
                peaks.extend(storeys.map(of));
            } else if building.base_moment.is_some() {
                peaks.push(response.of(building).unwrap_or(f64::NAN));
            }
        }
        peaks
    }

    /// Puts a collapse into columns: nothing is known but what the run without gaps says.
    pub fn fill_collapsed(&self, isolated: &IsolatedRun, out: &mut Vec<f64>) {
        out.clear();
        for quantity in &self.quantities {
            if !self.add_isolated(quantity, isolated, out) {
                out.resize(out.len() + self.width(quantity.axis), f64::NAN);
            }
        }
    }

    /// Adds the values of a quantity of the buildings without pounding; whether it is one.
    fn add_isolated(&self, quantity: &Quantity, run: &IsolatedRun, out: &mut Vec<f64>) -> bool {
        if *quantity == ISOLATED_DEMAND {
            out.extend(&run.demand);
            return true;
        }
        let name = quantity.name.strip_prefix("isolated_");
        let peak = name.and_then(storey_peak);
        let of_law = YIELDING.iter().find(|q| q.isolated == *quantity);
        if peak.is_none() && of_law.is_none() {
            return false;
        }
        let Some(storeys) = &run.storeys else {
            out.resize(out.len() + self.width(quantity.axis), f64::NAN);
            return true;
        };
        out.extend(
            peak.iter()
                .flat_map(|of| storeys.iter().map(|(peaks, _)| of(peaks))),
        );
        let laws = || storeys.iter().map(|(_, law)| law.as_ref());
        out.extend(of_law.iter().flat_map(|own| laws().map(own.of)));
        true
    }

    /// A text that two layouts share if and only if they are equal.
    #[must_use]
    pub fn signature(&self) -> String {
        let labels = self
            .storeys
            .iter()
            .chain(&self.levels)
            .chain(&self.link_levels)
            .map(|p| p.label.as_str());
        let labels = labels.chain(self.buildings.iter().map(String::as_str));
        let names = self.quantities.iter().map(|q| q.name);
        labels.chain(names).collect::<Vec<_>>().join("\n")
    }
}
