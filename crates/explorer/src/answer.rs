//! Answers: a JSON object, and columns of numbers beside it.

use serde_json::{Map, Value, json};
use wasm_bindgen::prelude::wasm_bindgen;

use crate::fault::Refused;

/// The answer to a request.
#[wasm_bindgen]
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Answer {
    object: Map<String, Value>,
    columns: Vec<(String, Vec<f64>)>,
}

impl Answer {
    /// Adds an entry of the object.
    pub(crate) fn say(&mut self, key: &str, value: impl Into<Value>) {
        self.object.insert(key.to_owned(), value.into());
    }

    /// Adds a column of numbers.
    pub(crate) fn add_column(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        let values = values.into_iter().collect();
        self.columns.push((name.to_owned(), values));
    }
}

#[wasm_bindgen]
impl Answer {
    /// The object as a JSON text. If anything is wrong it has `faults` alone, each with `message`,
    /// `help` (or null), the `line` of the case, and whether the case is `sound`: a building collapsed,
    /// or the run takes longer than a page waits.
    #[must_use]
    pub fn text(&self) -> String {
        Value::from(self.object.clone()).to_string()
    }

    /// Names of the columns.
    #[must_use]
    #[wasm_bindgen(js_name = columnNames)]
    pub fn column_names(&self) -> Vec<String> {
        self.columns.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Numbers of the column of this name, in JavaScript a `Float64Array`.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let found = self.columns.iter().find(|(known, _)| known == name);
        found.map(|(_, values)| values.clone())
    }
}

impl From<Refused> for Answer {
    fn from(refused: Refused) -> Self {
        let mut answer = Self::default();
        answer.say("faults", json!(refused.0));
        answer
    }
}
