//! Values of buildings, joints and links that hardly any has, more likely a slip of the unit or of the key.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_hysteresis::laboratory::{self, Step};
use pounding_hysteresis::{MAXIMUM_INTERNAL_VARIABLES, Motion};
use pounding_shear_building::ShearBuilding;

use crate::short_numbers::{short, stiffness_text};
use crate::system::{Element, LinkedMotion, System};
use crate::warning::Warning;

/// Height (m) that hardly any storey reaches, and hardly any pier.
const HEIGHT: f64 = 100.0;
/// Heights (m) from which on millimetres were meant, and not centimetres or inches.
const HEIGHT_IN_MILLIMETRES: f64 = 1000.0;
/// Mass (kg) of hardly any floor of a building, in storeys of at least this height (m): a square metre of a slab has as
/// much.
const LEAST_FLOOR: (f64, f64) = (500.0, 2.0);
/// A mass (kg) that no floor of a building falls below, the height (m) from which storeys are those of
/// a building and not of a model of one, and a period (s) that models and light buildings exceed:
/// with all masses a thousand times as large a building of 6 s has it.
pub(crate) const SMALL_MASS: (f64, f64, f64) = (1000.0, 2.0, 0.2);

/// Storeys from which a list of heights may be one of elevations, and part by which its steps may differ then.
const ELEVATIONS: (usize, f64) = (3, 0.2);
/// Storeys from which a list of stiffnesses may be written from the roof down, and last over first from which it is.
const ROOF_DOWN: (usize, f64) = (4, 1.5);
/// Damping ratios of the fundamental mode that dampers give at most, and that a structure has at least (-).
const DAMPING: (f64, f64) = (0.5, 1.0e-3);
/// Part of a damping ratio that is no more than its round-off.
const SAME_RATIO: f64 = 1.0e-9;
/// Period on soil over that on a fixed base (-) beyond which no building is left on such soil.
const LENGTHENING: f64 = 6.0;
/// Longest period (s) of isolators after yield or on their dishes.
const ISOLATED_PERIOD: f64 = 15.0;
/// Displacement (m) at which no isolator is still to yield.
const YIELD_DISPLACEMENT: f64 = 0.5;
/// Strength of isolators over the weight on them (-) that none of those that yield or slide is below.
const ISOLATOR_STRENGTH: f64 = 1.0e-3;
/// Width (m) of no seat, and that from which on millimetres were meant, and not centimetres or inches.
const SEAT: (f64, f64) = (5.0, 150.0);

/// Deformations (m) to which a link is drawn and pushed, at a metre a second: beyond the last no floors move.
const DEFORMATIONS: [f64; 9] = [1.0e-5, 1.0e-4, 0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0];
/// Force of a link over the weight of the lightest floor of its buildings (-) below which nobody needs the link.
const LINK_FORCE: f64 = 1.0e-3;

/// Warnings of all buildings, joints and links.
pub(crate) fn of(system: &System) -> Vec<Warning> {
    let buildings = system.buildings().iter();
    let mut found: Vec<Warning> = buildings.flat_map(|b| of_building(b)).collect();
    let seats = system.gaps().iter();
    let seats = seats.filter_map(|gap| Some((gap, gap.seat.filter(|seat| *seat > SEAT.0)?)));
    found.extend(seats.map(|(gap, seat)| Warning::UnusualValue {
        of: format!("gap {}", gap.name),
        says: format!(
            "the seat is {} m wide, as no seat is: {}",
            short(seat),
            in_another_unit(seat, SEAT.1)
        ),
    }));
    let links = (0..system.links().len()).filter_map(|link| weak_link(system, link));
    found.extend(links);
    found
}

/// A link that takes next to no force, whatever its floors do.
fn weak_link(system: &System, index: usize) -> Option<Warning> {
    let link = &system.links()[index];
    if link.joins == LinkedMotion::FoundationRotation {
        return None;
    }
    let buildings = system.buildings().iter();
    let joined = buildings.filter(|b| link.between.iter().any(|name| name == b.name()));
    let weights = joined.flat_map(|b| b.mass().iter().map(|mass| STANDARD_GRAVITY * mass));
    let weight = weights.min_by(f64::total_cmp)?;
    let levels = &system.elements()[link.first_element..link.first_element + link.levels];
    let most = levels.iter().map(greatest_force).fold(0.0, f64::max);
    (most < LINK_FORCE * weight).then(|| {
        let takes = match most > 0.0 {
            true => format!(
                "takes at most {} N within a metre either way at 1 m/s, {} times the weight of the lightest floor",
                short(most),
                short(most / weight)
            ),
            false => "takes no force within a metre either way".to_owned(),
        };
        Warning::UnusualValue {
            of: format!("link {}", link.name),
            says: format!(
                "it {takes}: check the units of its parameters; those without one are in N, N/m, N s/m and m"
            ),
        }
    })
}

/// Greatest force (N) of a new element: where it yields, and over [`DEFORMATIONS`] either way.
fn greatest_force(element: &Element) -> f64 {
    let law = &*element.law;
    let at_yield = element
        .yield_deformation
        .map(|x| x * law.initial_stiffness());
    let at_yield = at_yield.filter(|force| force.is_finite()).unwrap_or(0.0);
    let bound = law.variable_bound();
    if bound.is_finite() {
        // Such a variable would be integrated along the path, which every run of a study would pay for. It is at its
        // bound on a long way in one direction.
        let history = law.virgin();
        let [.., furthest] = DEFORMATIONS;
        let motion = Motion {
            deformation: furthest,
            velocity: 1.0,
        };
        let mut variables = [0.0; MAXIMUM_INTERNAL_VARIABLES];
        for (variable, virgin) in variables.iter_mut().zip(history.variables()) {
            *variable = *virgin;
        }
        variables[0] = bound;
        return law.force(&history, motion, &variables).force.abs();
    }
    let forces = [1.0, -1.0].into_iter().flat_map(|side| {
        let mut from = 0.0;
        let steps = DEFORMATIONS.iter().map(|to| {
            let motion = Motion {
                deformation: side * to,
                velocity: side,
            };
            let duration = to - from;
            from = *to;
            Step { motion, duration }
        });
        laboratory::drive_steps(law, steps)
    });
    forces.fold(at_yield, |most, point| most.max(point.force.abs()))
}

/// What a length in metres would be if millimetres were meant, as beyond this number of them, or centimetres or inches.
fn in_another_unit(length: f64, in_millimetres: f64) -> String {
    let number = short(length);
    match length > in_millimetres {
        true => format!(
            "check the unit; \"{number} mm\" would be {} m",
            short(length / 1000.0)
        ),
        false => format!(
            "check the unit; \"{number} cm\" would be {} m, and \"{number} in\" {} m",
            short(0.01 * length),
            short(0.0254 * length)
        ),
    }
}

fn of_building(building: &ShearBuilding) -> Vec<Warning> {
    let said = [
        height(building),
        elevations(building),
        roof_down(building),
        light_floor(building),
        upside_down(building),
        damping(building),
        soft_soil(building),
    ];
    let said = said.into_iter().flatten().chain(isolators(building));
    said.map(|says| Warning::UnusualValue {
        of: building.name().to_owned(),
        says,
    })
    .collect()
}

fn height(building: &ShearBuilding) -> Option<String> {
    let storeys = building.height().iter().enumerate();
    let (storey, height) = storeys.max_by(|a, b| a.1.total_cmp(b.1))?;
    (*height > HEIGHT).then(|| {
        format!(
            "storey {} is {} m high: {}",
            storey + 1,
            short(*height),
            in_another_unit(*height, HEIGHT_IN_MILLIMETRES)
        )
    })
}

/// Heights that grow from storey to storey by as much as the first, as elevations do.
fn elevations(building: &ShearBuilding) -> Option<String> {
    let (storeys, part) = ELEVATIONS;
    // That of isolators stands before them.
    let isolators = usize::from(building.isolator().is_some());
    let heights = building.height().get(isolators..)?;
    if heights.len() < storeys {
        return None;
    }
    let (first, last) = (heights.first()?, heights.last()?);
    let step = (last - first) / (heights.len() - 1) as f64;
    let like_others = |x: f64, part: f64| ((1.0 - part) * step..=(1.0 + part) * step).contains(&x);
    let even = heights.windows(2).all(|h| like_others(h[1] - h[0], part));
    // The lowest storey is often higher than others; one of twice the step, as of 3, 4.5 and 6 m, is no first elevation.
    let from_ground = (0.5 * step..=1.6 * step).contains(first);
    (step > 0.0 && even && from_ground).then(|| {
        format!(
            "its storeys are {} m high at the bottom and {} m at the top, and grow by {} m from one to the next: heights are of each storey, from the bottom up; were these elevations?",
            short(*first),
            short(*last),
            short(step)
        )
    })
}

/// Stiffnesses of storeys that grow towards the roof, as in a list that begins there. Columns that are alike are stiffer in
/// lower storeys of less height, by its third power, and the lowest storey may be a soft one.
fn roof_down(building: &ShearBuilding) -> Option<String> {
    let (storeys, times) = ROOF_DOWN;
    let own = building.without_foundation();
    if own.elastic_stiffness_matrix().is_some() {
        return None;
    }
    let isolators = usize::from(own.isolator().is_some());
    let stiffness = own.stiffness().get(isolators..)?;
    let (first, last) = (stiffness.first()?, stiffness.last()?);
    let heights = own.height().get(isolators..)?;
    let columns = stiffness.iter().zip(heights).map(|(k, h)| k * h.powi(3));
    let columns: Vec<f64> = columns.collect();
    let grow = [stiffness, &columns].map(|of| of.windows(2).all(|k| k[1] > k[0]));
    let [.., highest] = columns.as_slice() else {
        return None;
    };
    let are_many = columns.len() >= storeys && *highest >= times * columns[1];
    (are_many && grow == [true; 2]).then(|| {
        format!(
            "its storeys are stiffer from one to the next, {} at the bottom and {} at the top: lists begin at the bottom; was this one written from the roof down?",
            stiffness_text(*first),
            stiffness_text(*last)
        )
    })
}

/// A floor as light as none, in a storey as high as a building's: one in t without its unit, or all of a system of
/// units that is not that of SI, in which periods are right and forces are not.
fn light_floor(building: &ShearBuilding) -> Option<String> {
    let (least, height) = LEAST_FLOOR;
    let floors = building.mass().iter().zip(building.height()).enumerate();
    let light = floors.filter(|(_, (mass, high))| **mass < least && **high >= height);
    // All of them light and stiff: that is said by itself.
    let (small, _, stiff) = SMALL_MASS;
    let modes = building.modes();
    let all_small = building.mass().iter().all(|mass| *mass < small);
    if all_small
        && modes
            .period
            .get(modes.fundamental())
            .is_some_and(|period| *period < stiff)
    {
        return None;
    }
    let (floor, (mass, _)) = light.min_by(|a, b| a.1.0.total_cmp(b.1.0))?;
    Some(format!(
        "floor {} has {} kg, in a storey of {} m: check the unit; a mass without one is in kg, a stiffness in N/m, a length in m",
        floor + 1,
        short(*mass),
        short(building.height()[floor])
    ))
}

/// A stiffness matrix whose first mode is greatest at the lowest floor: rows from the roof down.
fn upside_down(building: &ShearBuilding) -> Option<String> {
    let own = building.without_foundation();
    if own.isolator().is_some() || own.elastic_stiffness_matrix().is_none() {
        return None;
    }
    let modes = own.modes();
    let shape = modes.shape.column(modes.fundamental());
    let floors = own.mass().len();
    let (lowest, roof) = (shape[0].abs(), shape[floors - 1].abs());
    (lowest > roof).then(|| {
        format!(
            "in its first mode the lowest floor moves {} times as far as the roof: rows and columns of a stiffness matrix stand from the lowest floor up",
            short(lowest / roof)
        )
    })
}

/// That of the structure itself: isolators and soil have dashpots of their own.
fn damping(building: &ShearBuilding) -> Option<String> {
    if building.isolator().is_some() {
        return None;
    }
    let own = building.foundation().map_or(building, |on| on.fixed_base());
    let ratio = *own.modes().damping_ratio.get(own.modes().fundamental())?;
    let percent = short(100.0 * ratio);
    if ratio > DAMPING.0 {
        return Some(format!(
            "the damping of its fundamental mode is {percent} % of the critical one, more than dampers give: of `rayleigh` alpha is the factor of the masses (1/s), beta that of the stiffnesses (s); of dashpots check the unit"
        ));
    }
    (ratio > 0.0 && ratio < (1.0 - SAME_RATIO) * DAMPING.1).then(|| {
        format!(
            "the damping of its fundamental mode is {percent} % of the critical one, as good as none: check the unit; a ratio of 5 % is 0.05, and dashpots without a unit are in N s/m"
        )
    })
}

fn soft_soil(building: &ShearBuilding) -> Option<String> {
    let times = building.foundation()?.period_lengthening()?;
    (times > LENGTHENING).then(|| {
        format!(
            "the soil makes the fundamental period {} times that on a fixed base, as no soil does that a building is left on: check the units of its stiffness, or of density and shear wave speed; a density without unit is in kg/m3",
            short(times)
        )
    })
}

fn isolators(building: &ShearBuilding) -> Vec<String> {
    let Some((_, made)) = building.isolator() else {
        return Vec::new();
    };
    let mut said = Vec::new();
    let period = made.post_yield_period();
    // Without any stiffness they slide on flat plates.
    if period > ISOLATED_PERIOD && period.is_finite() {
        said.push(format!(
            "the period of its isolators after they yield or slide is {} s, usually 2 to 5 s: check the unit of their stiffness or radius, unless they slide on flat plates",
            short(period)
        ));
    }
    if made.yield_displacement > YIELD_DISPLACEMENT {
        said.push(format!(
            "its isolators yield at {} m, further than any moves: they never do",
            short(made.yield_displacement)
        ));
    }
    // Plain rubber has none.
    if made.strength > 0.0 && made.strength < ISOLATOR_STRENGTH * made.weight {
        said.push(format!(
            "the strength of its isolators is {} N, {} % of the weight on them, as good as none: check its unit; a `yield_force` without one is in N, and a `strength` or friction of 5 % is 0.05",
            short(made.strength),
            short(100.0 * made.strength / made.weight)
        ));
    }
    said
}
