//! Answers: a JSON object, and columns of numbers behind it.

use serde_json::{Map, Value, json};

use crate::fault::Refused;

/// An answer that is being made.
#[derive(Debug, Default)]
pub(crate) struct Answer {
    object: Map<String, Value>,
    columns: Map<String, Value>,
    numbers: Vec<f64>,
}

impl Answer {
    /// Adds an entry of the object.
    pub(crate) fn say(&mut self, key: &str, value: impl Into<Value>) {
        self.object.insert(key.to_owned(), value.into());
    }

    /// Adds a column of numbers.
    pub(crate) fn column(&mut self, name: &str, values: impl IntoIterator<Item = f64>) {
        let first = self.numbers.len();
        self.numbers.extend(values);
        let place = json!([first, self.numbers.len() - first]);
        self.columns.insert(name.to_owned(), place);
    }

    /// The answer as bytes: the length of the JSON text and the place of the numbers, each in
    /// four bytes, lowest first; the text; the numbers, of eight bytes each.
    pub(crate) fn bytes(mut self) -> Vec<u8> {
        self.object
            .insert("columns".to_owned(), Value::Object(self.columns));
        let text = Value::Object(self.object).to_string();
        let numbers_at = (8 + text.len()).next_multiple_of(8);
        let mut bytes = Vec::with_capacity(numbers_at + 8 * self.numbers.len());
        // Texts and columns are far below four gigabytes: the requests are.
        bytes.extend((text.len() as u32).to_le_bytes());
        bytes.extend((numbers_at as u32).to_le_bytes());
        bytes.extend(text.as_bytes());
        bytes.resize(numbers_at, b' ');
        bytes.extend(self.numbers.iter().flat_map(|x| x.to_le_bytes()));
        bytes
    }
}

impl From<Refused> for Answer {
    fn from(refused: Refused) -> Self {
        let mut answer = Self::default();
        answer.say("faults", json!(refused.0));
        answer
    }
}
