//! Dicts of Python as the TOML text of a case.

use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyFrozenSet, PyInt, PySet, PyString};
use toml::{Table, Value};

/// Tables in one another at most: more than any case has, and less than a dict that holds
/// itself.
const DEEPEST: usize = 32;

/// The text of a dict.
///
/// # Errors
/// A value that no case file can hold, with its keys.
pub fn text_of(dict: &Bound<'_, PyDict>) -> PyResult<String> {
    let table = table(dict, "", 0)?;
    toml::to_string(&table).map_err(|e| PyValueError::new_err(e.to_string()))
}

fn table(dict: &Bound<'_, PyDict>, path: &str, depth: usize) -> PyResult<Table> {
    let mut table = Table::new();
    for (key, value) in dict {
        let Ok(key) = key.extract::<String>() else {
            return Err(PyTypeError::new_err(format!(
                "{}: the key {key} is no string",
                named(path)
            )));
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
        return Err(PyValueError::new_err(format!(
            "{path}: tables in tables without end"
        )));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_str()?.to_owned()));
    }
    if value.is_instance_of::<PyBool>() {
        return Ok(Value::Boolean(value.extract()?));
    }
    if value.is_instance_of::<PyInt>() {
        let number = value.extract::<i64>();
        return number.map(Value::Integer).map_err(|_| {
            PyValueError::new_err(format!("{path}: {value} is beyond what a case can hold"))
        });
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(dict) = value.cast::<PyDict>() {
        return Ok(Value::Table(table(dict, path, depth)?));
    }
    if value.hasattr("__fspath__")? {
        let text = value.call_method0("__fspath__")?;
        return Ok(Value::String(text.extract()?));
    }
    if value.hasattr("tolist")? {
        // Arrays and numbers of NumPy.
        return of(&value.call_method0("tolist")?, path, depth + 1);
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
    if value.hasattr("__index__")? || value.hasattr("__float__")? {
        return Ok(Value::Float(value.call_method0("__float__")?.extract()?));
    }
    Err(PyTypeError::new_err(format!(
        "{path}: a {} cannot stand in a case; give a number in SI units, a text with a unit, a list or a dict",
        value.get_type().name()?
    )))
}

fn named(path: &str) -> &str {
    if path.is_empty() { "the case" } else { path }
}
