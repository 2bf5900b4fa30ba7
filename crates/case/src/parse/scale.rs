//! The scale of a record.

use std::path::PathBuf;

use pounding_ground_motion::processing::Scale;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Acceleration, Fault, Kinds, Number, Positive, Ratio, TableOr, Time, Velocity,
};
use crate::types::{Located, SpectrumFile};

/// Damping ratio where none is given.
const DAMPING: f64 = 0.05;

/// A factor, or a table of one of the kinds.
pub(super) type ScaleValue = TableOr<Kinds<ScaleTable>, Positive<Number>>;

/// Scale
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[schemars(untagged)]
pub(super) enum ScaleTable {
    Factor {
        /// Factor (-)
        factor: Positive<Number>,
    },
    Pga {
        /// Peak ground acceleration (m/s2)
        pga: Positive<Acceleration>,
    },
    Pgv {
        /// Peak ground velocity (m/s)
        pgv: Positive<Velocity>,
    },
    Psa {
        /// Pseudo-acceleration (m/s2) at `period`
        psa: Positive<Acceleration>,
        /// Period of `psa` (s)
        period: Positive<Time>,
        /// Damping ratio, by default 0.05
        damping: Option<Ratio>,
    },
    Target {
        /// File of a spectrum (header period_s,psa_g) to come near to from `from` to `to`
        target: Located<FilePath>,
        /// First period of the band (s)
        from: Positive<Time>,
        /// Last period of the band (s)
        to: Positive<Time>,
        /// Damping ratio, by default 0.05
        damping: Option<Ratio>,
    },
}

/// The name of a file.
#[derive(Clone, Deserialize, JsonSchema)]
#[serde(try_from = "String")]
pub(super) struct FilePath(PathBuf);

impl TryFrom<String> for FilePath {
    type Error = Fault;
    fn try_from(name: String) -> Result<Self, Fault> {
        match name.is_empty() {
            false => Ok(Self(PathBuf::from(name))),
            true => Err(Fault::new(
                " is empty",
                "name the file, relative to the folder of the case file",
            )),
        }
    }
}

impl From<Located<FilePath>> for Located<PathBuf> {
    fn from(path: Located<FilePath>) -> Self {
        Self {
            value: path.value.0,
            span: path.span,
        }
    }
}

/// The scale that a value says.
pub(super) fn scale_of(value: ScaleValue) -> Scale<SpectrumFile> {
    let table = match value {
        TableOr::Value(factor) => return Scale::Factor(factor.into()),
        TableOr::Table(Kinds(table)) => table,
    };
    let or_default = |damping: Option<Ratio>| damping.map_or(DAMPING, f64::from);
    match table {
        ScaleTable::Factor { factor } => Scale::Factor(factor.into()),
        ScaleTable::Pga { pga } => Scale::PeakAcceleration(pga.into()),
        ScaleTable::Pgv { pgv } => Scale::PeakVelocity(pgv.into()),
        ScaleTable::Psa {
            psa,
            period,
            damping,
        } => Scale::SpectralAcceleration {
            period: period.into(),
            damping: or_default(damping),
            target: psa.into(),
        },
        ScaleTable::Target {
            target,
            from,
            to,
            damping,
        } => Scale::Band {
            target: SpectrumFile {
                file: target.into(),
                damping: or_default(damping),
            },
            from: from.into(),
            to: to.into(),
        },
    }
}
