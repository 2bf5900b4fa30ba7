//! The scale of a record.

use std::path::PathBuf;

use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{
    Acceleration, Fault, Kinds, NotNegative, Number, Positive, TableOr, Time, Velocity,
};
use crate::types::{Located, Scale};

/// Damping ratio where none is given.
const DAMPING: f64 = 0.05;

/// A factor, or a table of one of the kinds.
pub(super) type ScaleValue = TableOr<Kinds<ScaleTable>, Positive<Number>>;

/// Scale
#[derive(Deserialize, JsonSchema)]
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
        damping: Option<NotNegative<Number>>,
    },
    Target {
        /// File of a spectrum (header period_s,psa_g) to come near to from `from` to `to`
        target: Located<FilePath>,
        /// First period of the band (s)
        from: Positive<Time>,
        /// Last period of the band (s)
        to: Positive<Time>,
        /// Damping ratio, by default 0.05
        damping: Option<NotNegative<Number>>,
    },
}

/// The name of a file.
#[derive(Deserialize, JsonSchema)]
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

impl From<ScaleValue> for Scale {
    fn from(value: ScaleValue) -> Self {
        let table = match value {
            TableOr::Value(factor) => return Self::Factor(factor.into()),
            TableOr::Table(Kinds(table)) => table,
        };
        let or_default = |damping: Option<NotNegative<_>>| damping.map_or(DAMPING, f64::from);
        match table {
            ScaleTable::Factor { factor } => Self::Factor(factor.into()),
            ScaleTable::Pga { pga } => Self::PeakGroundAcceleration(pga.into()),
            ScaleTable::Pgv { pgv } => Self::PeakGroundVelocity(pgv.into()),
            ScaleTable::Psa {
                psa,
                period,
                damping,
            } => Self::SpectralAcceleration {
                acceleration: psa.into(),
                period: period.into(),
                damping: or_default(damping),
            },
            ScaleTable::Target {
                target,
                from,
                to,
                damping,
            } => Self::Band {
                target: target.into(),
                from: from.into(),
                to: to.into(),
                damping: or_default(damping),
            },
        }
    }
}
