//! The scale of a record.

use toml::de::DeValue;

use crate::error::CaseError;
use crate::parse::ground_motion::path;
use crate::parse::not_negative;
use crate::reader::{Reader, Value};
use crate::schema;
use crate::types::Scale;
use crate::units::Dimension;

/// Damping ratio where none is given.
const DAMPING: f64 = 0.05;

/// A factor, or a table of one of the kinds.
pub(super) fn scale(reader: &Reader<'_>, value: &Value<'_>) -> Result<Scale, CaseError> {
    if !matches!(value.get_ref(), DeValue::Table(_)) {
        return Ok(Scale::Factor(reader.positive(
            value,
            "scale",
            Dimension::NUMBER,
        )?));
    }
    let table = reader.table(value, "scale", schema::SCALE)?;
    let kinds = schema::SCALE_KINDS;
    let given: Vec<_> = kinds.iter().filter(|k| table.get(k[0]).is_some()).collect();
    let [kind] = given.as_slice() else {
        return Err(reader.error(
            value.span(),
            "`scale` needs one of `factor`, `pga`, `pgv`, `psa` and `target`",
            "for example { pga = \"0.35 g\" }",
        ));
    };
    for (key, _) in table.entries() {
        let key_name = key.value.as_str();
        let damped = matches!(kind[0], "psa" | "target") && key_name == "damping";
        if !kind.contains(&key_name) && !damped {
            return Err(reader.error(
                key.span,
                format!("`{key_name}` has no meaning beside `{}`", kind[0]),
                format!("remove `{key_name}`"),
            ));
        }
    }
    let positive = |key: &str, dimension| {
        let v = table.required(key)?;
        reader.positive(v, key, dimension)
    };
    let damping = || {
        table.get("damping").map_or(Ok(DAMPING), |v| {
            not_negative(reader, v, "damping", Dimension::NUMBER)
        })
    };
    Ok(match kind[0] {
        "factor" => Scale::Factor(positive("factor", Dimension::NUMBER)?),
        "pga" => Scale::PeakGroundAcceleration(positive("pga", Dimension::ACCELERATION)?),
        "pgv" => Scale::PeakGroundVelocity(positive("pgv", Dimension::VELOCITY)?),
        "psa" => Scale::SpectralAcceleration {
            acceleration: positive("psa", Dimension::ACCELERATION)?,
            period: positive("period", Dimension::TIME)?,
            damping: damping()?,
        },
        _ => Scale::Band {
            target: path(reader, table.required("target")?, "target")?,
            from: positive("from", Dimension::TIME)?,
            to: positive("to", Dimension::TIME)?,
            damping: damping()?,
        },
    })
}
