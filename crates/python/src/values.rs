//! Values of Python and ours: dicts as the TOML text of a case, arguments, paths, and answers as JSON.

use std::path::PathBuf;

use pounding_case::document::{AboveZero, Within};
use pounding_case::{Dimension, Quantity, parse_quantity};
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
                "give a number that a case can hold",
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
        if !names_a_file(path) {
            return Err(no_value(value, path));
        }
        let text = value.call_method0("__fspath__")?;
        return text
            .extract()
            .map(Value::String)
            .map_err(|_| no_value(value, path));
    }
    let is_class = value.is_instance_of::<PyType>();
    // Of a time, which Pandas has for a day too, the day that it is on.
    if value.hasattr("isoformat")? && value.hasattr("date")? && !is_class {
        let day = value
            .call_method0("date")
            .map_err(|_| no_value(value, path))?;
        // The time of Pandas that is none is on no day.
        if day.is(value) {
            return Err(no_value(value, path));
        }
        return of(&day, path, depth + 1);
    }
    for method in ["tolist", "isoformat"] {
        // Arrays and numbers of NumPy; days. A class of such has the method without a value.
        if value.hasattr(method)? && !is_class {
            let made = value.call_method0(method)?;
            // A number of NumPy that Python has no type for comes back as it is.
            if made.get_type().is(value.get_type()) {
                break;
            }
            return of(&made, path, depth + 1);
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

/// Keys whose values are names of files, as which paths count there alone.
const OF_FILES: [&str; 4] = ["across", "file", "response", "target"];

/// Whether the last of these keys takes the name of a file.
fn names_a_file(path: &str) -> bool {
    let key = path.rsplit('.').next().unwrap_or(path);
    OF_FILES.contains(&key)
}

/// The value (SI) of an argument: a number, or a text with a unit of this dimension.
///
/// # Errors
/// Anything else, a text that needs a unit and has none among it, with the name of the argument.
pub fn quantity(value: &Bound<'_, PyAny>, name: &str, wanted: Dimension) -> PyResult<f64> {
    if let Ok(text) = value.cast::<PyString>() {
        let text = text.to_string_lossy();
        let read = parse_quantity(&text)
            .map_err(|e| out_of_range(format!("{name}: {e}"), &e.help_for(Some(wanted))))?;
        // As in a case: who writes quotes means to write a unit.
        let read = Quantity {
            dimension: read.dimension.or(Some(Dimension::NUMBER)),
            ..read
        };
        return read
            .of(wanted)
            .map_err(|fault| out_of_range(format!("{name}{}", fault.message), &fault.help));
    }
    let is_flag = value.is_instance_of::<PyBool>();
    let number = value.extract::<f64>().ok().filter(|_| !is_flag);
    number.ok_or_else(|| {
        if value.is_instance_of::<PyInt>() && !is_flag {
            let message = format!("{name} is an integer beyond what a number can hold");
            return out_of_range(message, "correct the number");
        }
        let kind = value.get_type().name();
        let kind = kind.map_or_else(|_| "value".to_owned(), |kind| kind.to_string());
        refused(
            format!("{name} must be {wanted}, but it is a {kind}"),
            "give a number in SI units, or a text with a unit",
        )
    })
}

/// The same of one that is above zero, as a case asks of it.
///
/// # Errors
/// As [`quantity`], and what is not finite or not above zero.
pub fn above_zero(value: &Bound<'_, PyAny>, name: &str, wanted: Dimension) -> PyResult<f64> {
    let value = quantity(value, name, wanted)?;
    if !value.is_finite() {
        let message = format!("{name} = {value} is not a finite number");
        return Err(out_of_range(message, "correct the number"));
    }
    AboveZero::check(value)
        .map_err(|fault| out_of_range(format!("{name}{}", fault.message), &fault.help))?;
    Ok(value)
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

/// A path as it is meant now: the working folder may be another one when it is used.
pub fn here(path: PathBuf) -> PathBuf {
    std::path::absolute(&path).unwrap_or(path)
}

/// A value as JSON.
pub fn json(value: &impl serde::Serialize) -> Result<String, Problem> {
    serde_json::to_string(value)
        .map_err(|e| Failure::computation(format!("no JSON: {e}"), None).into())
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
