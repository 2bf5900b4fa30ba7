//! Standard 2800 of Iran, fourth edition, and a rule of Tehran.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

/// Importance factor from which a building is of high importance.
const HIGH_IMPORTANCE: f64 = 1.2;

/// Refuses a building for which the width by its height does not do; `rule` is the one that asks for an
/// analysis.
fn needs_no_analysis(
    working: &Working,
    structure: &Structure,
    rule: &str,
) -> Result<(), SeparationError> {
    if structure.storeys > 8 {
        let reason = format!("above 8 storeys it asks for an analysis: see {rule}");
        return Err(working.not_applicable(reason));
    }
    if let Some(factor) = structure.importance.filter(|i| *i >= HIGH_IMPORTANCE) {
        let reason = format!(
            "a building of high or very high importance (I = {factor}, from {HIGH_IMPORTANCE} on) needs an analysis: see {rule}"
        );
        return Err(working.not_applicable(reason));
    }
    Ok(())
}

fn by_height(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    needs_no_analysis(working, structure, BOUNDARY_BY_ANALYSIS.name)?;
    Ok(0.005 * working.elevation(structure))
}

fn between_by_height(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    for structure in [&situation.left, &situation.right] {
        needs_no_analysis(working, structure, BETWEEN.name)?;
    }
    Ok(0.01 * working.common_elevation(situation))
}

fn by_analysis(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    working.displacement(structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    working.root_of_squares(situation, Working::displacement)
}

fn tehran(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    let Situation { left, right, .. } = situation;
    let low = |s: &Structure| s.height <= 12.0 && s.storeys <= 4;
    if low(left) && low(right) {
        return Err(working.not_applicable("it speaks of more than 12 m or 4 storeys"));
    }
    Ok(0.01 * working.common_elevation(situation))
}

static EDITION: Edition = Edition {
    title: "Standard 2800, 4th edition, and Mabhas 6",
    region: "Iran",
    in_force: InForce::recalled("2014", None),
    superseded_by: None,
};

static MUNICIPAL: Edition = Edition {
    title: "municipal rule",
    region: "Tehran",
    in_force: None,
    superseded_by: None,
};

pub(crate) static BOUNDARY_BY_HEIGHT: ProvisionDescriptor = ProvisionDescriptor {
    name: "iran_2800_boundary_by_height",
    edition: &EDITION,
    clause: "1-4-1",
    basis: Basis::Prescriptive,
    height: HeightDatum::Foundation,
    ground: Ground::OwnSide,
    elastic_displacement_factor: None,
    formula: "0.005 h",
    inputs: &[],
    status: Status::SeenInText(
        "an excerpt of the sentences for up to 8 storeys and for high importance; 1/100 of the height between two buildings",
    ),
    remarks: &[
        "Buildings of high or very high importance need the analysis: this width holds for others only, which `importance` below 1.2 says.",
    ],
    worked: "0.005 * 18000",
    rule: Rule::Boundary(by_height),
};

pub(crate) static BOUNDARY_BY_ANALYSIS: ProvisionDescriptor = ProvisionDescriptor {
    name: "iran_2800_boundary_by_analysis",
    basis: Basis::Displacement,
    formula: "u",
    inputs: &[Input::Displacement],
    status: Status::Unverified(
        "that the displacement is that of one side: the excerpt seen speaks of the distance between buildings",
    ),
    remarks: &[
        "Above 8 storeys, and for buildings of high or very high importance (1.2 and more).",
        "Nonlinear displacement with P-delta, which u has to include.",
    ],
    rule: Rule::Boundary(by_analysis),
    worked: "80",
    height: HeightDatum::NotUsed,
    ..BOUNDARY_BY_HEIGHT
};

pub(crate) static BETWEEN_BY_HEIGHT: ProvisionDescriptor = ProvisionDescriptor {
    name: "iran_2800_between_by_height",
    formula: "0.01 h",
    remarks: &[
        "Buildings of high or very high importance need the analysis: this width holds for others only, which `importance` below 1.2 says.",
    ],
    rule: Rule::Between(between_by_height),
    worked: "0.01 * 18000",
    ground: Ground::NotAsked,
    ..BOUNDARY_BY_HEIGHT
};

pub(crate) static BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "iran_2800_between",
    basis: Basis::Displacement,
    formula: "sqrt(u1^2 + u2^2)",
    inputs: &[Input::Displacement],
    status: Status::Unverified("SRSS"),
    remarks: &[
        "Above 8 storeys, and for buildings of high or very high importance (1.2 and more).",
        "Nonlinear displacement with P-delta, which u has to include.",
        "Beside an unknown neighbour a rule of 70 % holds, which is not here.",
    ],
    rule: Rule::Between(between),
    worked: "sqrt(pow(80, 2) + pow(60, 2))",
    height: HeightDatum::NotUsed,
    ground: Ground::NotAsked,
    ..BOUNDARY_BY_HEIGHT
};

pub(crate) static TEHRAN: ProvisionDescriptor = ProvisionDescriptor {
    name: "tehran_between",
    edition: &MUNICIPAL,
    clause: "",
    formula: "h / 100",
    status: Status::SeenInText("a quotation of the rule"),
    remarks: &["Above 12 m or 4 storeys."],
    rule: Rule::Between(tehran),
    worked: "18000 / 100",
    height: HeightDatum::NotSeen,
    ground: Ground::NotAsked,
    ..BOUNDARY_BY_HEIGHT
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn situation(storeys: usize, height: f64) -> Situation {
        let structure = |u| Structure {
            displacement: Some(u),
            storeys,
            height,
            elevation: height,
            ..Structure::default()
        };
        Situation {
            left: structure(0.08),
            right: structure(0.06),
            site: Site::default(),
        }
    }

    /// 18 m: 90 mm on either side, 180 mm between, in Tehran too; 80 and 60 mm: 100 mm.
    #[test]
    fn by_hand() {
        let s = situation(6, 18.0);
        let own = |c: &ProvisionDescriptor| c.boundary(&s.left, &s.site).unwrap().width;
        assert!((own(&BOUNDARY_BY_HEIGHT) - 0.09).abs() < 1.0e-12);
        assert!((own(&BOUNDARY_BY_ANALYSIS) - 0.08).abs() < 1.0e-12);
        assert!((BETWEEN.between(&s).unwrap().width - 0.1).abs() < 1.0e-12);
        assert!((BETWEEN_BY_HEIGHT.between(&s).unwrap().width - 0.18).abs() < 1.0e-12);
        assert!((TEHRAN.between(&s).unwrap().width - 0.18).abs() < 1.0e-12);
    }

    #[test]
    fn limits() {
        let refused = |c: &ProvisionDescriptor, s: &Situation| {
            matches!(c.between(s), Err(SeparationError::NotApplicable { .. }))
        };
        assert!(refused(&BOUNDARY_BY_HEIGHT, &situation(9, 27.0)));
        assert!(refused(&BETWEEN_BY_HEIGHT, &situation(9, 27.0)));
        for (importance, analysis) in [(1.0, false), (1.2, true), (1.4, true)] {
            let mut important = situation(6, 18.0);
            important.right.importance = Some(importance);
            for rule in [&BOUNDARY_BY_HEIGHT, &BETWEEN_BY_HEIGHT] {
                assert_eq!(refused(rule, &important), analysis);
            }
        }
        assert!(refused(&TEHRAN, &situation(4, 12.0)));
        assert!(!refused(&TEHRAN, &situation(5, 12.0)));
    }
}
