//! Seismically isolated structures in chapter 17 of ASCE/SEI 7.

use std::f64::consts::PI;

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Structure};
use crate::provisions::asce_7;
use crate::status::Status;
use crate::working::Working;

/// Least total maximum displacement over the maximum displacement, by edition.
const LEAST_7_10: f64 = 1.1;
const LEAST_7_16: f64 = 1.15;

/// `D_TM`, the total maximum displacement, at the far corner of the plan.
fn total_maximum(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
    least: f64,
) -> Result<f64, SeparationError> {
    let name = &structure.name;
    let mut of = |value: Option<f64>, input, symbol: &str, unit| {
        let value = working.need(value, input, name)?;
        Ok::<_, SeparationError>(working.note(format!("{symbol}({name})"), value, unit))
    };
    let period = of(
        structure.isolation_period,
        Input::IsolationPeriod,
        "T_M",
        "s",
    )?;
    let damping = of(
        structure.isolation_damping_coefficient,
        Input::IsolationDampingCoefficient,
        "B_M",
        "-",
    )?;
    let length = of(structure.plan_length, Input::PlanLength, "d", "m")?;
    let width = of(structure.plan_width, Input::PlanWidth, "b", "m")?;
    if !(width <= length) {
        return Err(SeparationError::OutOfRange {
            quantity: "plan_width",
            value: width,
            range: "(0, plan_length]",
        });
    }
    let eccentricity = of(
        structure.plan_eccentricity,
        Input::PlanEccentricity,
        "e",
        "m",
    )?;
    let given = site.spectral_acceleration_1s;
    let spectral = working.need(given, Input::SpectralAccelerationAtOneSecond, "")?;
    let spectral = working.note("S_M1", spectral, "m/s2");
    let maximum = spectral * period / (4.0 * PI * PI * damping);
    let maximum = working.note(format!("D_M({name})"), maximum, "m");
    let diagonal = width * width + length * length;
    let torsion = 1.0 + 0.5 * length * 12.0 * eccentricity / diagonal;
    let factor = working.note(format!("D_TM / D_M({name})"), torsion.max(least), "-");
    Ok(factor * maximum)
}

fn by_7_10(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    total_maximum(working, structure, site, LEAST_7_10)
}

fn by_7_16(
    working: &mut Working,
    structure: &Structure,
    site: &Site,
) -> Result<f64, SeparationError> {
    total_maximum(working, structure, site, LEAST_7_16)
}

const REMARKS: &[&str] = &[
    "From the isolated structure to retaining walls and other fixed obstructions, by the equivalent lateral force procedure.",
    "The distance y of the corner is half the longest dimension; P_T of 7-16 and later is taken as 1, which is on the safe side.",
    "A neighbour that is not isolated moves, too: its own displacement is to be added.",
];

pub(crate) static ASCE_7_10: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_10_isolation_boundary",
    edition: &asce_7::ASCE_7_10,
    clause: "17.2.5.2 and 17.5.3",
    basis: Basis::Prescriptive,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "D_TM = D_M max(1 + 12 e y / (b^2 + d^2), 1.1), D_M = S_M1 T_M / (4 pi^2 B_M), y = d / 2",
    inputs: &[
        Input::SpectralAccelerationAtOneSecond,
        Input::IsolationPeriod,
        Input::IsolationDampingCoefficient,
        Input::PlanLength,
        Input::PlanWidth,
        Input::PlanEccentricity,
    ],
    status: Status::Unverified("the clause, its formulas and the least factor of 1.1"),
    remarks: REMARKS,
    worked: "8000 * 3 / (4 * pow(3.141592653589793, 2) * 1.5) * max(1 + 12 * 2 * 20 / (pow(20, 2) + pow(40, 2)), 1.1)",
    rule: Rule::Boundary(by_7_10),
};

pub(crate) static ASCE_7_16: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_16_isolation_boundary",
    edition: &asce_7::ASCE_7_16,
    clause: "17.2.5.2 and 17.5.3",
    formula: "D_TM = D_M max(1 + 12 e y / (b^2 + d^2), 1.15), D_M = S_M1 T_M / (4 pi^2 B_M), y = d / 2",
    status: Status::Unverified("the clause, its formulas and the least factor of 1.15"),
    rule: Rule::Boundary(by_7_16),
    worked: "8000 * 3 / (4 * pow(3.141592653589793, 2) * 1.5) * max(1 + 12 * 2 * 20 / (pow(20, 2) + pow(40, 2)), 1.15)",
    ..ASCE_7_10
};

pub(crate) static ASCE_7_22: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_22_isolation_boundary",
    edition: &asce_7::ASCE_7_22,
    status: Status::Unverified("that 7-22 left the formulas of 7-16 unchanged"),
    ..ASCE_7_16
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use pounding_catalogue::STANDARD_GRAVITY;

    use super::*;

    /// S_M1 = 0.9 g, T_M = 3 s, B_M = 1.5: D_M = 0.9 * 9.80665 * 3 / (39.4784 * 1.5) =
    /// 447.13 mm. Plan 20 m by 40 m, e = 2 m (5 % of 40 m), y = 20 m: 1 + 20 * 24 / 2000 =
    /// 1.24, D_TM = 554.44 mm. With e = 0.5 m 1.06: the least factor rules.
    #[test]
    fn by_hand() {
        let structure = |eccentricity| Structure {
            isolation_period: Some(3.0),
            isolation_damping_coefficient: Some(1.5),
            plan_length: Some(40.0),
            plan_width: Some(20.0),
            plan_eccentricity: Some(eccentricity),
            ..Structure::default()
        };
        let site = Site {
            spectral_acceleration_1s: Some(0.9 * STANDARD_GRAVITY),
            ..Site::default()
        };
        let width = |provision: &ProvisionDescriptor, eccentricity| {
            let own = provision.boundary(&structure(eccentricity), &site);
            own.unwrap().width
        };
        for provision in [&ASCE_7_10, &ASCE_7_16, &ASCE_7_22] {
            assert!((width(provision, 2.0) - 0.554_44).abs() < 1.0e-5);
        }
        assert!((width(&ASCE_7_10, 0.5) - 1.1 * 0.447_131).abs() < 1.0e-5);
        assert!((width(&ASCE_7_16, 0.5) - 1.15 * 0.447_131).abs() < 1.0e-5);
        let swapped = Structure {
            plan_length: Some(20.0),
            plan_width: Some(40.0),
            ..structure(2.0)
        };
        assert!(matches!(
            ASCE_7_10.boundary(&swapped, &site),
            Err(SeparationError::OutOfRange { .. })
        ));
    }
}
