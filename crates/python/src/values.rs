//! Dicts of Python as the TOML text of a case.

use pounding_case::{Dimension, parse_quantity};
use pounding_cli::Failure;
use pyo3::prelude::*;
use pyo3::types::{
    PyBool, PyByteArray, PyBytes, PyDict, PyFloat, PyFrozenSet, PyInt, PyMemoryView, PySet,
    PyString, PyType,
};
use toml::{Table, Value};

use crate::errors::Problem;

/// Tables in one another at most: more than any case has, and less than a dict that holds
/// itself.
const DEEPEST: usize = 32;

/// The text of a dict.
///
/// # Errors
/// A value that no case file can hold, with its keys.
pub fn text_of(dict: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = table(dict, "", 0)?;
    toml::to_string(&table)
        .map_err(|e| out_of_range(format!("the case: {e}"), "give what a case file can hold"))
}

fn table(dict: &Bound<'_, PyDict>, path: &str, depth: usize) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, value) in dict {
        let Ok(key) = key.extract::<String>() else {
            return Err(refused(
                format!("{}: the key {key} is no string", named(path)),
                "keys are those of the case file",
            ));
        };
        let path = match path.is_empty() {
            true => key.clone(),
            false => format!("{path}.{key}"),
        };
        // A keyword that was not given.
        if !value.is_none() {
            let value = of(&value, &path, depth + 1)?;
            table.insert(key, value);
        }
    }
    Ok(table)
}

fn of(value: &Bound<'_, PyAny>, path: &str, depth: usize) -> PyResult<Value> {
    if depth > DEEPEST {
        return Err(out_of_range(
            format!("{path}: tables in tables without end"),
            "a case has a few",
        ));
    }
    if let Ok(text) = value.cast::<PyString>() {
        let text = text.to_str().map_err(|_| {
            out_of_range(
                format!("{path}: the text has characters that no file can hold"),
                "write it anew",
            )
        })?;
        return Ok(Value::String(text.to_owned()));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        return value.extract::<i64>().map(Value::Integer).map_err(|_| {
            out_of_range(
                format!("{path}: an integer of more than 64 bits is beyond what a case can hold"),
                "give a float, such as 1e30",
            )
        });
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(table(dict, path, depth)?));
    }
    // Their entries are the codes of characters.
    if value.is_instance_of::<PyBytes>()
        || value.is_instance_of::<PyByteArray>()
        || value.is_instance_of::<PyMemoryView>()
    {
        return Err(no_value(value, path));
    }
    if value.hasattr("__fspath__")? {
        let text = value.call_method0("__fspath__")?;
        return text
            .extract()
            .map(Value::String)
            .map_err(|_| no_value(value, path));
    }
    for method in ["tolist", "isoformat"] {
        // Arrays and numbers of NumPy; days. A class of such has the method without a value.
        if value.hasattr(method)? && !value.is_instance_of::<PyType>() {
            return of(&value.call_method0(method)?, path, depth + 1);
        }
    }
    // The order of a set is none.
    let ordered = !value.is_instance_of::<PySet>() && !value.is_instance_of::<PyFrozenSet>();
    if let Some(entries) = value.try_iter().ok().filter(|_| ordered) {
        let entries = entries.enumerate().map(|(i, entry)| {
            let path = format!("{path}[{i}]");
            of(&entry?, &path, depth + 1)
        });
        return Ok(Value::Array(entries.collect::<PyResult<_>>()?));
    }
    let number = value.call_method0("__float__");
    let number = number.and_then(|number| number.extract());
    number.map(Value::Float).map_err(|_| no_value(value, path))
}

/// The value (SI) of an argument: a number, or a text with a unit of this dimension.
///
/// # Errors
/// Anything else, with the name of the argument.
pub fn quantity(value: &Bound<'_, PyAny>, name: &str, wanted: Dimension) -> PyResult<f64> {
    if let Ok(text) = value.cast::<PyString>() {
        let text = text.to_string_lossy();
        let quantity = parse_quantity(&text)
            .map_err(|e| out_of_range(format!("{name}: {e}"), &e.help_for(Some(wanted))))?;
        return match quantity.dimension {
            Some(found) if found != wanted => Err(out_of_range(
                format!("{name} must be {wanted}, but \"{text}\" is {found}"),
                "correct the unit; plain numbers are SI",
            )),
            _ => Ok(quantity.value),
        };
    }
    let is_flag = value.is_instance_of::<PyBool>();
    let number = value.extract::<f64>().ok().filter(|_| !is_flag);
    number.ok_or_else(|| {
        let kind = value.get_type().name();
        let kind = kind.map_or_else(|_| "value".to_owned(), |kind| kind.to_string());
        refused(
            format!("{name} must be {wanted}, but it is a {kind}"),
            "give a number in SI units, or a text with a unit",
        )
    })
}

/// The same of one that may be left out.
///
/// # Errors
/// As [`quantity`].
pub fn optional(
    value: Option<&Bound<'_, PyAny>>,
    name: &str,
    wanted: Dimension,
) -> PyResult<Option<f64>> {
    value.map(|value| quantity(value, name, wanted)).transpose()
}

/// A value of a kind that no case has.
fn no_value(value: &Bound<'_, PyAny>, path: &str) -> PyErr {
    let name = value.get_type().name();
    let name = name.map_or_else(|_| "value".to_owned(), |name| name.to_string());
    refused(
        format!("{path}: a {name} cannot stand in a case"),
        "give a number in SI units, a text with a unit, a list or a dict",
    )
}

fn refused(message: String, help: &str) -> PyErr {
    Problem::of_type(Failure::input(message, Some(help.to_owned()))).into()
}

fn out_of_range(message: String, help: &str) -> PyErr {
    Problem::from(Failure::input(message, Some(help.to_owned()))).into()
}

fn named(path: &str) -> &str {
    if path.is_empty() { "the case" } else { path }
}
