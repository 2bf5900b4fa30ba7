//! Buildings whose floors turn in plan: rigid floors on frames along and across the row.

use nalgebra::DMatrix;
use pounding_case::{Building, Case, CaseError, Errors, Frame, Gap, Located, Plan, Side};
use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;
use pounding_shear_building::{
    Coordinate, EDGE_DISPLACEMENTS, Excitation, FrameDirection, GeneralBuilding,
    GeometricStiffness, ResponseKind, ResponseRow, ShearBuilding, ShearBuildingError,
    YieldingFrame,
};
use pounding_time_history::{BuildingPoint, Floor, System};

use super::laws;

/// Parts of the floor by which a frame may stand beyond its edge.
const BEYOND_EDGE: f64 = 1.5;

/// Frames that stand far beside the floors of their building, one of each in words.
pub(super) fn frames_outside(case: &Case) -> Vec<String> {
    let outside = |b: &Building| {
        let plan = &b.plan.as_ref()?.value;
        // Positions are from the mass centre, around which the floor lies.
        let of = |frames: &[Frame], size: f64| {
            let beyond = |f: &&Frame| f.at.abs() > (0.5 + BEYOND_EDGE) * size;
            Some((frames.iter().find(beyond)?.at, size))
        };
        let (at, size) = of(&plan.along, plan.width).or_else(|| of(&plan.across, plan.length))?;
        let at = six_digits(at);
        Some(format!(
            "{}: a frame stands {at} m from the mass centre of floors of {} m: check the unit",
            b.name.value,
            six_digits(size)
        ))
    };
    case.buildings.iter().filter_map(outside).collect()
}

/// Coordinates of a floor: along the row, across it, rotation anticlockwise; those of all floors
/// along come first.
const OF_A_FLOOR: usize = 3;

/// The building with its floors, masses and damping.
pub(super) fn building(
    case: &Case,
    b: &Building,
    given: &Located<Plan>,
) -> Result<ShearBuilding, CaseError> {
    let refused = |message: &str, help: &str| {
        let message = format!("building {}: {message}", b.name.value);
        case.error(given.span.clone(), message, Some(help.to_owned()))
    };
    if b.foundation.is_some() {
        return Err(refused(
            "a building that turns in plan stands on a fixed base",
            "leave `foundation` or `plan` out",
        ));
    }
    let general = general(b, &given.value);
    if general.stiffness.clone().cholesky().is_none() {
        return Err(refused(
            "its frames do not hold the floors",
            "give frames in both directions, at least two of one direction apart from one another: a single line in each cannot resist rotation",
        ));
    }
    let made = ShearBuilding::with_coordinates(general).map_err(|e| {
        let (place, help) = match e {
            ShearBuildingError::Damping { .. } => (&b.damping.span, RATIOS),
            ShearBuildingError::UnstableMatrix { .. } => (&given.span, OVERTURNED),
            _ => (&given.span, RATIOS),
        };
        case.error(place.clone(), e.to_string(), Some(help.to_owned()))
    })?;
    made.with_yielding_frames(yielding_frames(case, b, &given.value)?)
        .map_err(|e| case.error(given.span.clone(), e.to_string(), e.help()))
}

/// What to do about a building that gravity overturns.
pub(super) const OVERTURNED: &str =
    "correct stiffness, masses and heights, with their units; `p_delta = false` leaves gravity out";

/// What to do about a damping that cannot be.
const RATIOS: &str = "give ratios, such as { ratio = 0.05, modes = [1, 3] }, with modes of all three coordinates of a floor";

/// Frames along and across the row, with the direction of each.
fn frames(plan: &Plan) -> impl Iterator<Item = (FrameDirection, &Frame)> {
    let along = plan.along.iter().map(|f| (FrameDirection::Along, f));
    let across = plan.across.iter().map(|f| (FrameDirection::Across, f));
    along.chain(across)
}

/// The frames that follow laws in some storeys.
fn yielding_frames(
    case: &Case,
    b: &Building,
    plan: &Plan,
) -> Result<Vec<YieldingFrame>, CaseError> {
    let errors = Errors::default();
    let read = errors.all(frames(plan).map(|(direction, frame)| {
        let at = six_digits(frame.at);
        let of = format!(
            "the frame {direction} the row at {at} m of \"{}\"",
            b.name.value
        );
        let laws = laws::of_storeys(case, &frame.laws, (&frame.stiffness, &of))?;
        let with_law = |(storey, law)| YieldingFrame {
            direction,
            at: frame.at,
            storey,
            deformation: deformation(b.mass.len(), storey, direction, frame.at),
            law,
        };
        Ok(laws.into_iter().map(with_law).collect::<Vec<_>>())
    }));
    let mut all = errors.finish(read)?.concat();
    all.sort_by_key(|frame| frame.storey);
    Ok(all)
}

fn general(b: &Building, plan: &Plan) -> GeneralBuilding {
    let n = b.mass.len();
    let all = OF_A_FLOOR * n;
    let mut stiffness = DMatrix::zeros(all, all);
    let mut shears = vec![vec![0.0; all]; n];
    for direction in [FrameDirection::Along, FrameDirection::Across] {
        for (storey, shear) in shears.iter_mut().enumerate() {
            for (_, frame) in frames(plan).filter(|(of, _)| *of == direction) {
                let (row, k) = (
                    deformation(n, storey, direction, frame.at),
                    frame.stiffness[storey],
                );
                for (i, x) in &row {
                    for (j, y) in &row {
                        stiffness[(*i, *j)] += k * x * y;
                    }
                    if direction == FrameDirection::Along {
                        shear[*i] += k * x;
                    }
                }
            }
        }
    }
    let mut moment = vec![0.0; all];
    for (shear, height) in shears.iter().zip(&b.height) {
        for (sum, k) in moment.iter_mut().zip(shear) {
            *sum += height * k;
        }
    }
    let rectangle = (plan.length.powi(2) + plan.width.powi(2)) / 12.0;
    let inertia = |i: usize| match &plan.rotational_inertia {
        Some(given) => given[i],
        None => b.mass[i] * rectangle,
    };
    let coordinate = |kind: &str, i: usize, inertia: f64, excitation| Coordinate {
        name: format!("{kind} of floor {}", i + 1),
        inertia,
        excitation,
    };
    let inertia: Vec<f64> = (0..n).map(inertia).collect();
    let across = (0..n).map(|i| coordinate("motion across", i, b.mass[i], Excitation::Across));
    let rotation = (0..n).map(|i| coordinate("rotation", i, inertia[i], Excitation::None));
    GeneralBuilding {
        name: b.name.value.clone(),
        mass: b.mass.clone(),
        height: b.height.clone(),
        further: across.chain(rotation).collect(),
        stiffness,
        geometric: b.p_delta.then(|| {
            let of_a_floor: [&[f64]; OF_A_FLOOR] = [&b.mass, &b.mass, &inertia];
            GeometricStiffness::of_floors(&of_a_floor, &b.height, STANDARD_GRAVITY)
        }),
        damping: b.damping.value.clone(),
        drifts: None,
        sections: shears.into_iter().chain([moment]).collect(),
        responses: (0..n).flat_map(|i| responses(plan, n, i)).collect(),
    }
}

/// Deformation of a frame in a storey, as a sum over the coordinates: of one `at` a distance from
/// the mass centre.
fn deformation(n: usize, storey: usize, direction: FrameDirection, at: f64) -> Vec<(usize, f64)> {
    let (first, arm) = match direction {
        FrameDirection::Across => (n, at),
        _ => (0, -at),
    };
    let floor = |i: usize, sign: f64| [(first + i, sign), (2 * n + i, sign * arm)];
    let mut row = floor(storey, 1.0).to_vec();
    if storey > 0 {
        row.extend(floor(storey - 1, -1.0));
    }
    row
}

/// What is told of a floor beside its motion along the row.
fn responses(plan: &Plan, n: usize, floor: usize) -> Vec<ResponseRow> {
    let row = |name: &str, unit, kind, terms: &[(usize, f64)]| {
        let mut weights = vec![0.0; OF_A_FLOOR * n];
        for (i, w) in terms {
            weights[*i] = *w;
        }
        ResponseRow {
            name: format!("{name}_{}", floor + 1),
            unit,
            kind,
            weights,
        }
    };
    let (across, rotation) = (n + floor, 2 * n + floor);
    let edge = |y: f64| [(floor, 1.0), (rotation, -y)];
    let half = 0.5 * plan.width;
    vec![
        row(
            "displacement_across",
            "m",
            ResponseKind::Displacement,
            &[(across, 1.0)],
        ),
        row(
            "rotation",
            "rad",
            ResponseKind::Displacement,
            &[(rotation, 1.0)],
        ),
        row(
            EDGE_DISPLACEMENTS[0],
            "m",
            ResponseKind::Displacement,
            &edge(-half),
        ),
        row(
            EDGE_DISPLACEMENTS[1],
            "m",
            ResponseKind::Displacement,
            &edge(half),
        ),
        row(
            "acceleration_across",
            "m s-2",
            ResponseKind::Acceleration,
            &[(across, 1.0)],
        ),
        row(
            "rotational_acceleration",
            "rad s-2",
            ResponseKind::Acceleration,
            &[(rotation, 1.0)],
        ),
    ]
}

/// Positions across the row (m) at which a level of the gap touches; `None` where neither side
/// turns.
pub(super) fn points(case: &Case, gap: &Gap) -> Result<Option<Vec<f64>>, CaseError> {
    let plans = gap.between.map(|side| match side {
        Side::Building(b) => case.buildings[b].plan.as_ref(),
        Side::Wall => None,
    });
    let edges = || {
        plans.iter().flatten().map(|plan| {
            let (centre, half) = (plan.value.mass_centre, 0.5 * plan.value.width);
            (centre - half, centre + half)
        })
    };
    let shared = edges().reduce(|a, b| (a.0.max(b.0), a.1.min(b.1)));
    match (shared, &gap.points) {
        (None, None) => Ok(None),
        (None, Some(given)) => Err(case.error(
            given.span.clone(),
            format!(
                "gap {}: `points` have no meaning between buildings that do not turn",
                gap.name
            ),
            Some("leave `points` out, or give a building a `plan`".to_owned()),
        )),
        (Some((low, high)), None) if low < high => Ok(Some(vec![low, high])),
        (Some(_), None) => Err(case.error(
            gap.model.span.clone(),
            format!(
                "gap {}: both buildings have no edge in common across the row",
                gap.name
            ),
            Some("correct `mass_centre` or `width` of a plan, or give `points`".to_owned()),
        )),
        (Some((low, high)), Some(given)) => {
            let mut points = given.value.clone();
            points.sort_by(f64::total_cmp);
            let twice = points.windows(2).find(|pair| pair[0] == pair[1]);
            if let Some(pair) = twice {
                return Err(case.error(
                    given.span.clone(),
                    format!("gap {}: there are two points at {} m", gap.name, pair[0]),
                    Some("give every point once; its stiffness is that of the model".to_owned()),
                ));
            }
            let beyond = points.iter().find(|y| !(low..=high).contains(*y));
            match beyond {
                None => Ok(Some(points)),
                Some(y) => Err(case.error(
                    given.span.clone(),
                    format!(
                        "gap {}: the point at {y} m is not on the edge that both sides share, from {low} m to {high} m",
                        gap.name
                    ),
                    Some("give positions across the row within the plans of both sides".to_owned()),
                )),
            }
        }
    }
}

/// The place of a floor at a position across the row (m).
pub(super) fn point(case: &Case, system: &mut System, floor: Floor, across: f64) -> Floor {
    let Floor::Storey(b, storey) = floor else {
        return floor;
    };
    let Some(plan) = &case.buildings[b].plan else {
        return floor;
    };
    let building = &case.buildings[b];
    let n = building.mass.len();
    let point = BuildingPoint {
        building: b,
        storey,
        elevation: building.elevations()[storey],
        weights: vec![
            (storey, 1.0),
            (2 * n + storey, plan.value.mass_centre - across),
        ],
    };
    system.add_point_across(point, across)
}
