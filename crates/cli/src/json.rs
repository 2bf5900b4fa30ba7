//! Parts of results for machines: SI units, full precision.

use pounding_time_history::LevelPlace;
use serde_json::{Value, json};

/// Adds label, storeys and elevations of a level; a wall has neither storey nor elevation.
pub fn add_place(value: &mut Value, place: &LevelPlace) {
    if let (Value::Object(value), Value::Object(place)) = (value, json!(place)) {
        value.extend(place);
    }
}
