//! The JSON Schema of a file.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use schemars::generate::SchemaSettings;
use schemars::transform::{RecursiveTransform, Transform};
use schemars::{JsonSchema, Schema};
use serde_json::{Map, Value, json};

/// JSON Schema (2020-12) of a file that is read as `T`: the keys that are accepted, with what
/// they are and their units.
#[must_use]
pub fn schema_of<T: JsonSchema>(id: &str) -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true);
    let mut schema = settings.into_generator().into_root_schema_for::<T>();
    RecursiveTransform(as_read).transform(&mut schema);
    schema.insert("$id".to_owned(), json!(id));
    schema.to_value()
}

/// Says what the reader does: there is no null, unknown keys are errors, and free keys stand
/// for any.
fn as_read(schema: &mut Schema) {
    let Some(object) = schema.as_object_mut() else {
        return;
    };
    without_null(object);
    with_one_key(object);
    if let Some(Value::String(text)) = object.get_mut("description") {
        *text = text.replace('\n', " ");
    }
    if let Some(Value::Object(properties)) = object.get_mut("properties") {
        let free = properties.remove("*").unwrap_or(Value::Bool(false));
        object.insert("additionalProperties".to_owned(), free);
        if let Some(Value::Array(required)) = object.get_mut("required") {
            required.retain(|key| key != "*");
        }
    }
}

fn without_null(object: &mut Map<String, Value>) {
    if let Some(Value::Array(types)) = object.get_mut("type") {
        types.retain(|one| one != "null");
        if let [one] = types.as_slice() {
            let one = one.clone();
            object.insert("type".to_owned(), one);
        }
    }
    if let Some(Value::Array(words)) = object.get_mut("enum") {
        words.retain(|word| !word.is_null());
    }
    if let Some(Value::Array(forms)) = object.get_mut("anyOf") {
        forms.retain(|form| form.get("type") != Some(&json!("null")));
        if let [Value::Object(one)] = forms.as_slice() {
            let one = one.clone();
            object.remove("anyOf");
            for (key, value) in one {
                object.entry(key).or_insert(value);
            }
        }
    }
}

/// Makes a table with one of several keys of what derives as one table for each.
fn with_one_key(object: &mut Map<String, Value>) {
    let Some(Value::Array(tables)) = object.get("oneOf") else {
        return;
    };
    let mut properties = Map::new();
    for table in tables {
        match table["properties"].as_object() {
            Some(of_it) if of_it.len() == 1 && table["required"].is_array() => {
                for (key, value) in of_it {
                    let mut value = value.clone();
                    if let (Some(value), Some(what)) =
                        (value.as_object_mut(), table.get("description"))
                    {
                        value.insert("description".to_owned(), what.clone());
                    }
                    properties.insert(key.clone(), value);
                }
            }
            _ => return,
        }
    }
    object.remove("oneOf");
    object.insert("type".to_owned(), json!("object"));
    object.insert("properties".to_owned(), Value::Object(properties));
    object.insert("minProperties".to_owned(), json!(1));
    object.insert("maxProperties".to_owned(), json!(1));
}

thread_local! {
    /// What [`kinds_of`] says, by the name of the type: it is asked for in every case of a study.
    static KINDS: RefCell<HashMap<&'static str, Rc<str>>> = RefCell::default();
}

/// The keys of a table of several kinds that is read as `T`, and in a second line its kinds,
/// each with the keys that it needs and may have.
pub(super) fn kinds_of<T: JsonSchema>() -> Rc<str> {
    let name = std::any::type_name::<T>();
    if let Some(kinds) = KINDS.with_borrow(|known| known.get(name).cloned()) {
        return kinds;
    }
    let schema = schema_of::<T>("");
    let (mut keys, mut kinds): (Vec<&str>, Vec<String>) = (Vec::new(), Vec::new());
    for kind in schema["anyOf"].as_array().into_iter().flatten() {
        let needed = kind["required"].as_array().into_iter().flatten();
        let needed: Vec<&str> = needed.filter_map(Value::as_str).collect();
        let all = kind["properties"].as_object().into_iter().flatten();
        let others = all.map(|(k, _)| k.as_str()).filter(|k| !needed.contains(k));
        let others: Vec<&str> = others.collect();
        let quoted: Vec<String> = needed.iter().map(|k| format!("`{k}`")).collect();
        let mut text = quoted.join(" and ").replacen(" and ", " with ", 1);
        others.iter().for_each(|k| text += &format!(" (and `{k}`)"));
        kinds.push(text);
        for key in needed.into_iter().chain(others) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    let last = kinds.pop().unwrap_or_default();
    let text = format!("{}\n{} or {last}", keys.join(", "), kinds.join(", "));
    let text: Rc<str> = text.into();
    KINDS.with_borrow_mut(|known| known.insert(name, Rc::clone(&text)));
    text
}
