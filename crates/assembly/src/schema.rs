//! The JSON Schema of a case with the words that its keys take.

use pounding_hysteresis::LawDescriptor;
use serde_json::{Value, json};

use crate::assemble::method_names;

/// JSON Schema (2020-12) of a case file: that of [`pounding_case::schema`], which knows keys and
/// units, with the methods, and the impact models and laws, from which editors complete. These
/// stand as examples: other names of theirs are read, too.
#[must_use]
pub fn case_schema() -> Value {
    let mut schema = pounding_case::schema();
    let laws = pounding_hysteresis::registry::descriptors();
    let of_storeys = |law: &&&LawDescriptor| law.link_alone.is_none();
    let of_storeys: Vec<_> = laws.iter().filter(of_storeys).map(|law| law.name).collect();
    let of_links: Vec<_> = laws.iter().map(|law| law.name).collect();
    let models = pounding_gap_element::registry::descriptors().iter();
    let models: Vec<_> = models.map(|model| model.name).collect();
    let methods: Vec<_> = method_names().collect();
    let law = "/properties/building/items/properties/law/anyOf";
    for (path, keyword, words) in [
        ("/properties/analysis/properties/method", "enum", &methods),
        (
            "/properties/gap/items/properties/model",
            "examples",
            &models,
        ),
        (
            "/properties/link/items/properties/model",
            "examples",
            &of_links,
        ),
        (
            &format!("{law}/0/properties/model"),
            "examples",
            &of_storeys,
        ),
        (
            &format!("{law}/1/items/properties/model"),
            "examples",
            &of_storeys,
        ),
    ] {
        if let Some(Value::Object(of_key)) = schema.pointer_mut(path) {
            of_key.insert(keyword.to_owned(), json!(words));
        }
    }
    schema
}
