//! What is asked about bare numbers, without a unit, that would be usual in another one.

use pounding_case::{Dimension, bare_acceleration, bare_gap_width, bare_ground_velocity};
use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;

use super::demand_kind::DemandKind;
use super::intensity::IntensityMeasure;
use super::values::Values;

/// What the greatest intensity of a study is at least (g), of long periods over the period (s).
const GREATEST_AT_LEAST: f64 = 0.2;
/// What sites whose earthquakes are studied have at least (g) once in 475 years, of long periods over the
/// period (s).
const HAZARD_AT_LEAST: f64 = 0.05;
/// Mean annual frequency (1/year) of what codes design for: 10 % in 50 years.
const DESIGN_FREQUENCY: f64 = 1.0 / 475.0;
/// What hardly a site has (g) once in 475 years.
const STRONGEST_HAZARD: f64 = 1.5;
/// What a limit on accelerations of floors is at least (g).
const LIMIT_AT_LEAST: f64 = 0.25;
/// Drift ratio from which on no limit lies.
const NO_DRIFT_LIMIT: f64 = 0.2;
/// Displacement (m) from which on no limit lies.
const NO_LENGTH: f64 = 5.0;
/// Force (N) up to which no limit lies.
const NO_FORCE: f64 = 1000.0;

/// The greatest number among values.
pub(super) fn greatest(values: &Values) -> Option<f64> {
    match values {
        Values::Numbers(numbers) => Some(numbers.iter().copied().fold(0.0, f64::max)),
        Values::Range { from, to, .. } => Some(from.max(*to)),
        // More than that are one of a hundred.
        Values::Random(distribution) => Some(distribution.quantile(0.99)),
        Values::Choices(_) => None,
    }
}

/// What is said of intensities without a unit, where the greatest is as small as in no study of records that are
/// scaled, or a velocity that no ground has.
pub(super) fn of_intensities(measure: &IntensityMeasure, values: &Values) -> Option<String> {
    if *measure == IntensityMeasure::PeakGroundVelocity {
        let what = format!("the greatest `intensity`, {},", measure.title());
        return bare_ground_velocity(&what, greatest(values)?);
    }
    if measure.dimension() != Dimension::ACCELERATION {
        return None;
    }
    let what = format!("the greatest `intensity`, {},", measure.title());
    let least = GREATEST_AT_LEAST / measure.long_period();
    bare_acceleration(&what, greatest(values)?, least)
}

/// The intensity of a hazard curve at the frequency of what codes design for, with that frequency, or its nearer end.
fn of_design(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let (first, last) = (points.first()?, points.last()?);
    let around = points
        .windows(2)
        .find(|p| p[0].1 >= DESIGN_FREQUENCY && p[1].1 <= DESIGN_FREQUENCY);
    Some(match around {
        Some([(x, f), (y, g)]) => {
            let part = libm::log(f / DESIGN_FREQUENCY) / libm::log(f / g);
            (x * libm::exp(part * libm::log(y / x)), DESIGN_FREQUENCY)
        }
        _ if first.1 < DESIGN_FREQUENCY => *first,
        _ => *last,
    })
}

/// What is said of a hazard curve whose intensities have no unit: where what codes design for is less than sites
/// have whose earthquakes are studied, or the curve ends below the intensities of the study, as it would not in g.
pub(super) fn of_hazard(
    measure: &IntensityMeasure,
    points: &[(f64, f64)],
    values: &Values,
) -> Option<String> {
    if measure.dimension() != Dimension::ACCELERATION {
        return None;
    }
    let ((design, frequency), end) = (of_design(points)?, points.last()?.0);
    let in_gravity = |x: f64| six_digits(x / STANDARD_GRAVITY);
    let why = match greatest(values) {
        _ if design < HAZARD_AT_LEAST / measure.long_period() * STANDARD_GRAVITY => format!(
            "it has {} m/s2 ({} g) once in {:.0} years, little for a site whose earthquakes are studied",
            six_digits(design),
            in_gravity(design),
            1.0 / frequency
        ),
        // And is one that sites have in g.
        Some(most) if end < most && most <= end * STANDARD_GRAVITY && design < STRONGEST_HAZARD => {
            format!(
                "it ends at {} m/s2 ({} g), below the greatest intensity of the study, {} g",
                six_digits(end),
                in_gravity(end),
                in_gravity(most)
            )
        }
        _ => return None,
    };
    let number = six_digits(points[0].0);
    Some(format!(
        "the intensities of the hazard curve have no unit and are in m/s2: {why}; were numbers of g meant? Then write \"{number} g\" and so on, in a file a header with its unit, such as `sa (g),mean_annual_frequency`; if not, \"{number} m/s2\""
    ))
}

/// What is said of widths of gaps without a unit, of which the greatest is this (m).
pub(super) fn of_widths(greatest: f64) -> Option<String> {
    bare_gap_width("`gaps` go up to", greatest)
}

/// What is said of a limit without a unit that hardly any demand has in SI units.
pub(super) fn of_limit(
    name: &str,
    demand: DemandKind,
    exceeds: f64,
    is_bare: bool,
) -> Option<String> {
    let number = six_digits(exceeds);
    match demand {
        DemandKind::AccelerationAbsolute | DemandKind::AccelerationAcross if is_bare => {
            bare_acceleration(&format!("the limit \"{name}\""), exceeds, LIMIT_AT_LEAST)
        }
        DemandKind::DriftRatio | DemandKind::ResidualDriftRatio
            if is_bare && exceeds > NO_DRIFT_LIMIT =>
        {
            Some(format!(
                "the limit \"{name}\" is a drift ratio of {} %, which few buildings reach: was \"{number} %\" meant?",
                six_digits(100.0 * exceeds)
            ))
        }
        _ if !is_bare => None,
        _ if demand.dimension() == Dimension::LENGTH && exceeds > NO_LENGTH => Some(format!(
            "the limit \"{name}\" is {number} m, which buildings do not reach: was \"{number} mm\" meant?"
        )),
        _ if demand.dimension() == Dimension::FORCE && exceeds > 0.0 && exceeds < NO_FORCE => {
            Some(format!(
                "the limit \"{name}\" is {number} N, next to nothing: was \"{number} kN\" meant?"
            ))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const POINTS: [(f64, f64); 5] = [
        (0.01, 0.1),
        (0.05, 0.02),
        (0.2, 1e-3),
        (1.0, 2e-5),
        (3.0, 1e-6),
    ];

    fn times(factor: f64) -> Vec<(f64, f64)> {
        POINTS.map(|(x, f)| (x * factor, f)).to_vec()
    }

    /// By hand: straight in logarithms from 0.05 at 0.02 to 0.2 at 0.001, 1/475 lies ln(9.5) / ln(20) of the way:
    /// 0.05 * 4^0.7515 = 0.1417.
    #[test]
    fn design_intensities_are_read_off_the_curve() {
        assert!((of_design(&POINTS).unwrap().0 - 0.1417).abs() < 1e-4);
        assert_eq!(of_design(&POINTS[..2]), Some((0.05, 0.02)));
        assert_eq!(of_design(&POINTS[3..]), Some((1.0, 2e-5)));
    }

    /// Lengths in mm, forces in kN and velocities in cm/s without a unit are asked about, with one they are not; and usual
    /// ones neither.
    #[test]
    fn usual_numbers_of_other_units_are_asked_about() {
        let limit = |demand, x, is_bare| of_limit("a", demand, x, is_bare);
        let said = |demand, x| limit(demand, x, true).unwrap();
        assert!(said(DemandKind::Opening, 350.0).contains("\"350 mm\""));
        assert!(said(DemandKind::ContactForce, 500.0).contains("\"500 kN\""));
        assert_eq!(limit(DemandKind::Opening, 350.0, false), None);
        assert_eq!(limit(DemandKind::Opening, 0.35, true), None);
        assert_eq!(limit(DemandKind::ContactForce, 0.0, true), None);
        assert_eq!(limit(DemandKind::ContactForce, 5e5, true), None);
        assert!(of_widths(40.0).unwrap().contains("\"40 mm\""));
        assert!(of_widths(2.0).unwrap().contains("\"2 cm\""));
        assert_eq!(of_widths(0.4), None);
        let velocity = IntensityMeasure::PeakGroundVelocity;
        let greatest = |x: f64| of_intensities(&velocity, &Values::Numbers(vec![0.1, x]));
        assert!(greatest(80.0).unwrap().contains("\"80 cm/s\""));
        assert_eq!(greatest(1.5), None);
    }

    #[test]
    fn curves_in_gravity_are_asked_about() {
        let measure = IntensityMeasure::PeakGroundAcceleration;
        let study = Values::Numbers(vec![1.0, 8.0]);
        let said = of_hazard(&measure, &POINTS, &study).unwrap();
        assert!(said.contains("0.0144"), "{said}");
        assert!(said.contains("\"0.01 g\""), "{said}");
        // Four times as strong the site is plausible, and the curve ends at 12 m/s2, above 8.
        assert_eq!(of_hazard(&measure, &times(4.0), &study), None);
        // As strong, and the study goes on to 15 m/s2.
        let stronger = Values::Numbers(vec![1.0, 15.0]);
        let said = of_hazard(&measure, &times(4.0), &stronger).unwrap();
        assert!(said.contains("it ends at 12 m/s2"), "{said}");
        assert_eq!(of_hazard(&measure, &times(9.806_65), &study), None);
        // 3 g once in 475 years is none.
        let beyond = Values::Numbers(vec![1.0, 80.0]);
        assert_eq!(of_hazard(&measure, &times(21.0), &beyond), None);
        let velocity = IntensityMeasure::PeakGroundVelocity;
        assert_eq!(of_hazard(&velocity, &POINTS, &study), None);
    }
}
