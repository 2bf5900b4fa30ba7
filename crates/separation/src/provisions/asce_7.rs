//! ASCE/SEI 7 and the codes that follow it.

use crate::assumptions::{Ground, HeightDatum};
use crate::descriptor::{Basis, ProvisionDescriptor, Rule};
use crate::edition::{Edition, InForce};
use crate::error::SeparationError;
use crate::inputs::{Input, Site, Situation, Structure};
use crate::status::Status;
use crate::working::Working;

const INPUTS: &[Input] = &[
    Input::Displacement,
    Input::DisplacementAmplification,
    Input::ResponseModification,
];
const OPEN_QUESTION: &str = "Whether SRSS may be used across a property line is an open question: the neighbour is not known there.";

/// `Cd d / Ie`; with `d = Ie u / R` that is `Cd u / R`.
fn maximum_displacement(
    working: &mut Working,
    structure: &Structure,
) -> Result<f64, SeparationError> {
    let amplification = working.displacement_amplification(structure)?;
    let reduced = match structure.elastic_displacement {
        Some(d) => {
            let d = working.note(format!("d({})", structure.name), d, "m");
            d / working.importance(structure)?
        }
        None => working.displacement(structure)? / working.response_modification(structure)?,
    };
    Ok(amplification * reduced)
}

fn boundary(
    working: &mut Working,
    structure: &Structure,
    _: &Site,
) -> Result<f64, SeparationError> {
    maximum_displacement(working, structure)
}

fn between(working: &mut Working, situation: &Situation) -> Result<f64, SeparationError> {
    working.root_of_squares(situation, maximum_displacement)
}

pub(crate) static ASCE_7_10: Edition = Edition {
    title: "ASCE/SEI 7-10",
    region: "United States",
    in_force: InForce::recalled("2010", Some("2017")),
    superseded_by: Some("ASCE/SEI 7-16"),
};

pub(crate) static ASCE_7_16: Edition = Edition {
    title: "ASCE/SEI 7-16",
    region: "United States",
    in_force: InForce::recalled("2017", Some("2022")),
    superseded_by: Some("ASCE/SEI 7-22"),
};

pub(crate) static ASCE_7_22: Edition = Edition {
    title: "ASCE/SEI 7-22",
    region: "United States",
    in_force: InForce::recalled("2022", None),
    superseded_by: None,
};

static IBC_2009: Edition = Edition {
    title: "IBC 2009",
    region: "United States",
    in_force: InForce::recalled("2009", Some("2012")),
    superseded_by: Some("IBC 2012, which takes the clause of ASCE/SEI 7-10"),
};

static KDS: Edition = Edition {
    title: "KBC and KDS",
    region: "Korea",
    in_force: None,
    superseded_by: None,
};

static SNI_1726: Edition = Edition {
    title: "SNI 1726:2019",
    region: "Indonesia",
    in_force: InForce::recalled("2019", None),
    superseded_by: None,
};

pub(crate) static ASCE_7_10_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_10_boundary",
    edition: &ASCE_7_10,
    clause: "12.12.3",
    basis: Basis::Displacement,
    height: HeightDatum::NotUsed,
    ground: Ground::OwnSide,
    elastic_displacement_factor: Some("Cd / Ie"),
    formula: "deltaM = Cd d / Ie (d = Ie u / R)",
    inputs: INPUTS,
    status: Status::SeenInText("an excerpt of ASCE/SEI 7-10 with equations 12.12-1 and 12.12-2"),
    remarks: &["Measured from the property line."],
    worked: "4 * 80 / 8",
    rule: Rule::Boundary(boundary),
};

pub(crate) static ASCE_7_10_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_10_between",
    formula: "sqrt(deltaM1^2 + deltaM2^2), deltaM = Cd d / Ie (d = Ie u / R)",
    remarks: &[OPEN_QUESTION],
    rule: Rule::Between(between),
    worked: "sqrt(pow(4 * 80 / 8, 2) + pow(4.5 * 60 / 5, 2))",
    ground: Ground::OneProperty,
    ..ASCE_7_10_BOUNDARY
};

const UNCHANGED: Status = Status::Unverified("that 7-16 left the clause of 7-10 unchanged");

pub(crate) static ASCE_7_16_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_16_boundary",
    edition: &ASCE_7_16,
    status: UNCHANGED,
    ..ASCE_7_10_BOUNDARY
};

pub(crate) static ASCE_7_16_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_16_between",
    edition: &ASCE_7_16,
    status: UNCHANGED,
    ..ASCE_7_10_BETWEEN
};

const REVISED: Status = Status::Unverified(
    "7-22 writes the displacement in its revised notation of drifts; diaphragm deformation is to be added to u",
);

pub(crate) static ASCE_7_22_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_22_boundary",
    edition: &ASCE_7_22,
    status: REVISED,
    ..ASCE_7_10_BOUNDARY
};

pub(crate) static ASCE_7_22_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "asce_7_22_between",
    edition: &ASCE_7_22,
    status: REVISED,
    ..ASCE_7_10_BETWEEN
};

const IBC: Status = Status::SeenInText("an excerpt of IBC 2009, 1613.6.7, with equation 16-64");

pub(crate) static IBC_2009_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "ibc_2009_boundary",
    edition: &IBC_2009,
    clause: "1613.6.7",
    status: IBC,
    remarks: &["IBC 2009 restricts the clause to high design categories."],
    ..ASCE_7_10_BOUNDARY
};

pub(crate) static IBC_2009_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "ibc_2009_between",
    edition: &IBC_2009,
    clause: "1613.6.7",
    status: IBC,
    remarks: &[
        OPEN_QUESTION,
        "IBC 2009 restricts the clause to high design categories.",
    ],
    ..ASCE_7_10_BETWEEN
};

const FOLLOWS: Status = Status::Unverified("that the code follows ASCE 7");

pub(crate) static KDS_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "kds_boundary",
    edition: &KDS,
    clause: "",
    status: FOLLOWS,
    ..ASCE_7_10_BOUNDARY
};

pub(crate) static KDS_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "kds_between",
    edition: &KDS,
    clause: "",
    status: FOLLOWS,
    ..ASCE_7_10_BETWEEN
};

pub(crate) static SNI_1726_BOUNDARY: ProvisionDescriptor = ProvisionDescriptor {
    name: "sni_1726_2019_boundary",
    edition: &SNI_1726,
    clause: "",
    status: FOLLOWS,
    ..ASCE_7_10_BOUNDARY
};

pub(crate) static SNI_1726_BETWEEN: ProvisionDescriptor = ProvisionDescriptor {
    name: "sni_1726_2019_between",
    edition: &SNI_1726,
    clause: "",
    status: FOLLOWS,
    ..ASCE_7_10_BETWEEN
};

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::registry::find;

    /// Cd = 5.5, R = 8, Ie = 1.25; u = 80 and 60 mm: 5.5 / 8 of them is 55 and 41.25 mm,
    /// in root 68.75 mm.
    #[test]
    fn by_hand() {
        let structure = |name: &str, u| Structure {
            name: name.to_owned(),
            displacement: Some(u),
            response_modification: Some(8.0),
            displacement_amplification: Some(5.5),
            importance: Some(1.25),
            ..Structure::default()
        };
        let mut situation = Situation {
            left: structure("a", 0.08),
            right: structure("b", 0.06),
            ..Situation::default()
        };
        let families = [
            "asce_7_10",
            "asce_7_16",
            "asce_7_22",
            "ibc_2009",
            "kds",
            "sni_1726_2019",
        ];
        for family in families {
            let descriptor = |place: &str| find(&format!("{family}_{place}")).unwrap();
            let between = descriptor("between").between(&situation).unwrap();
            assert!((between.width - 0.068_75).abs() < 1.0e-12, "{family}");
            let own = descriptor("boundary").boundary(&situation.left, &Site::default());
            assert!((own.unwrap().width - 0.055).abs() < 1.0e-12, "{family}");
        }
        // The same displacement given under reduced forces: d = Ie u / R = 12.5 mm.
        situation.left.elastic_displacement = Some(0.012_5);
        let between = ASCE_7_10_BETWEEN.between(&situation).unwrap();
        assert!((between.width - 0.068_75).abs() < 1.0e-12);
    }
}
