//! A piece: a line of JSON, the rows, a hash of all before it.

use std::io::{Error, ErrorKind, Result};
use std::path::Path;

use serde_json::{Value, json};

use crate::runs::{Ending, ID, Row};
use crate::stored_runs::{HASH, head_and_numbers, whole, with_hash};
use pounding_files::checksum::hexadecimal;

/// The content of a piece: rows of a study, in the order of their runs.
pub(super) fn encode(study: &str, rows: &[Row]) -> Vec<u8> {
    let mut endings = serde_json::Map::new();
    for row in rows {
        if let Some(reason) = row.ending.diagnosis() {
            let (status, _) = row.ending.status();
            endings.insert(row.run.to_string(), json!([status, reason]));
        }
    }
    let columns = rows.first().map_or(0, |r| r.values.len());
    let runs: Vec<usize> = rows.iter().map(|r| r.run).collect();
    let head = json!({
        "study": study, "runs": runs, "columns": columns, "endings": endings,
    });
    let mut bytes = format!("{head}\n").into_bytes();
    bytes.reserve(rows.len() * (ID + 8 * columns) + HASH);
    for row in rows {
        bytes.extend_from_slice(&row.id);
        for value in &row.values {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
    }
    with_hash(bytes)
}

/// The name of a piece: its first run, and the beginning of its hash. Two pieces of one name
/// hold the same rows, whoever wrote them.
pub(super) fn name(content: &[u8], rows: &[Row]) -> String {
    let hash = &content[content.len().saturating_sub(HASH)..];
    let first = rows.first().map_or(0, |r| r.run);
    format!("{first:012}-{}.runs", &hexadecimal(hash)[..16])
}

/// Reads the rows of a piece of a study.
///
/// # Errors
/// [`ErrorKind::InvalidData`] if the file is not whole or not of this study.
pub(super) fn read(path: &Path, study: &str) -> Result<Vec<Row>> {
    let damaged = || Error::new(ErrorKind::InvalidData, "the file is damaged");
    let bytes = pounding_files::input::read(path)?;
    let parts = whole(&bytes).and_then(head_and_numbers);
    let (head, rows) = parts.ok_or_else(damaged)?;
    if head["study"] != study {
        return Err(Error::new(
            ErrorKind::InvalidData,
            "the file is of another study",
        ));
    }
    let number = |value: &Value| value.as_u64().and_then(|n| usize::try_from(n).ok());
    let runs: Option<Vec<usize>> = head["runs"]
        .as_array()
        .and_then(|runs| runs.iter().map(number).collect());
    let (Some(runs), Some(columns)) = (runs, number(&head["columns"])) else {
        return Err(damaged());
    };
    let width = ID + 8 * columns;
    if rows.len() != runs.len() * width {
        return Err(damaged());
    }
    let row = |(run, bytes): (&usize, &[u8])| {
        let (id, values) = bytes.split_first_chunk::<ID>()?;
        let values = values.as_chunks::<8>().0;
        Some(Row {
            run: *run,
            id: *id,
            values: values.iter().map(|b| f64::from_le_bytes(*b)).collect(),
            ending: ending(&head["endings"][run.to_string()])?,
        })
    };
    let rows = runs.iter().zip(rows.chunks_exact(width)).map(row);
    rows.collect::<Option<Vec<_>>>().ok_or_else(damaged)
}

/// How a run ended, from the head of its piece; `None` if this cannot be.
fn ending(value: &Value) -> Option<Ending> {
    if value.is_null() {
        return Some(Ending::Complete);
    }
    let reason = value[1].as_str()?.to_owned();
    match value[0].as_i64()? {
        1 => Some(Ending::Failed(reason)),
        2 => Some(Ending::Collapsed(reason)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn rows() -> Vec<Row> {
        [7, 8, 31]
            .into_iter()
            .map(|run| Row {
                run,
                id: [run as u8; ID],
                values: if run == 8 {
                    vec![f64::NAN; 2]
                } else {
                    vec![run as f64 / 3.0, -0.0]
                },
                ending: match run {
                    8 => Ending::Failed("it did not\nconverge".to_owned()),
                    31 => Ending::Collapsed("storey 1".to_owned()),
                    _ => Ending::Complete,
                },
            })
            .collect()
    }

    #[test]
    fn rows_come_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let content = encode("study", &rows());
        let path = folder.path().join(name(&content, &rows()));
        std::fs::write(&path, content).unwrap();
        let back = read(&path, "study").unwrap();
        assert_eq!(back.len(), rows().len());
        for (a, b) in back.iter().zip(rows()) {
            let bits = |r: &Row| r.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(
                (a.run, a.id, &a.ending, bits(a)),
                (b.run, b.id, &b.ending, bits(&b))
            );
        }
    }

    /// Any cut, and any changed byte, is seen.
    #[test]
    fn damage_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("piece");
        let whole = encode("study", &rows());
        for cut in 0..whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            assert!(read(&path, "study").is_err(), "cut at {cut}");
            let mut bent = whole.clone();
            bent[cut] ^= 1;
            std::fs::write(&path, &bent).unwrap();
            assert!(read(&path, "study").is_err(), "bent at {cut}");
        }
        std::fs::write(&path, &whole).unwrap();
        assert!(read(&path, "study").is_ok());
        assert!(read(&path, "other").is_err());
    }
}
