//! Numbers of a page as base64: small, and read at once.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// With all digits.
    Float64,
    /// With seven digits.
    Float32,
    /// To a part in 65,534 of the range from the largest magnitude down and up.
    Int16,
}

impl Kind {
    /// Characters of a number on the page.
    pub(super) fn size(self) -> f64 {
        let bytes = match self {
            Self::Float64 => 8.0,
            Self::Float32 => 4.0,
            Self::Int16 => 2.0,
        };
        bytes * 4.0 / 3.0
    }
}

/// Numbers with what it takes to read them; in JavaScript `numbers` of `run.js`.
pub(super) fn packed(values: &[f64], kind: Kind) -> Value {
    match kind {
        Kind::Float64 => {
            let bytes = values.iter().flat_map(|x| x.to_le_bytes());
            json!({ "type": "float64", "data": STANDARD.encode(bytes.collect::<Vec<u8>>()) })
        }
        Kind::Float32 => {
            let bytes = values.iter().flat_map(|x| (*x as f32).to_le_bytes());
            json!({ "type": "float32", "data": STANDARD.encode(bytes.collect::<Vec<u8>>()) })
        }
        Kind::Int16 => {
            let finite = values.iter().filter(|x| x.is_finite());
            let most = finite.fold(0.0_f64, |m, x| m.max(x.abs()));
            let scale = if most > 0.0 { most / 32767.0 } else { 1.0 };
            let word = |x: &f64| match x.is_finite() {
                true => (x / scale).round() as i16,
                false => i16::MIN,
            };
            let bytes = values.iter().flat_map(|x| word(x).to_le_bytes());
            let data = STANDARD.encode(bytes.collect::<Vec<u8>>());
            json!({ "type": "int16", "scale": scale, "data": data })
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn bytes(value: &Value) -> Vec<u8> {
        STANDARD.decode(value["data"].as_str().unwrap()).unwrap()
    }

    #[test]
    fn numbers_come_back() {
        let values = [0.0, -0.25, 1.0, f64::NAN, 0.333_333];
        let all = packed(&values, Kind::Float64);
        let back: Vec<f64> = bytes(&all)
            .chunks(8)
            .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
            .collect();
        assert_eq!(back[..3], values[..3]);
        assert!(back[3].is_nan());
        let few = packed(&values, Kind::Int16);
        let scale = few["scale"].as_f64().unwrap();
        for (word, value) in bytes(&few).chunks(2).zip(values) {
            let word = i16::from_le_bytes(word.try_into().unwrap());
            match value.is_finite() {
                true => assert!((f64::from(word) * scale - value).abs() <= 0.5 / 32767.0),
                false => assert_eq!(word, i16::MIN),
            }
        }
        assert_eq!(bytes(&packed(&values, Kind::Float32)).len(), 20);
    }
}
