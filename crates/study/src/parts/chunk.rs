//! The file of a chunk: a line of JSON, the rows, a hash of all before it.

use std::fs::File;
use std::io::{Error, ErrorKind, Result, Write};
use std::ops::Range;
use std::path::Path;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use crate::runs::{Ending, Row};

/// Bytes of a run's identity, and of the hash at the end.
const ID: usize = 16;
const HASH: usize = 32;

/// Writes the rows of a chunk of a study beside its place and renames the file.
pub(crate) fn write_chunk(path: &Path, study: &str, rows: &[Row]) -> Result<()> {
    let mut endings = serde_json::Map::new();
    for row in rows {
        if let Some(reason) = row.ending.diagnosis() {
            let (status, _) = row.ending.status();
            endings.insert(row.run.to_string(), json!([status, reason]));
        }
    }
    let columns = rows.first().map_or(0, |r| r.values.len());
    let first = rows.first().map_or(0, |r| r.run);
    let head = json!({
        "study": study, "first": first, "runs": rows.len(), "columns": columns,
        "endings": endings,
    });
    let mut bytes = format!("{head}\n").into_bytes();
    bytes.reserve(rows.len() * (ID + 8 * columns) + HASH);
    for row in rows {
        bytes.extend_from_slice(&row.id);
        for value in &row.values {
            bytes.extend_from_slice(&value.to_le_bytes());
        }
    }
    let hash = Sha256::digest(&bytes);
    bytes.extend_from_slice(&hash);
    let part = path.with_extension("writing");
    let written = File::create(&part).and_then(|mut file| {
        file.write_all(&bytes)?;
        file.sync_all()
    });
    let done = written.and_then(|()| std::fs::rename(&part, path));
    if done.is_err() {
        // Half a file is worthless; if it cannot be removed, nobody reads it.
        let _ = std::fs::remove_file(&part);
    }
    done
}

/// Reads the rows of a chunk.
///
/// # Errors
/// [`ErrorKind::InvalidData`] if the file is not whole or not that of this chunk.
pub(crate) fn read_chunk(path: &Path, study: &str, runs: &Range<usize>) -> Result<Vec<Row>> {
    let damaged = || Error::new(ErrorKind::InvalidData, "the file is damaged");
    let bytes = std::fs::read(path)?;
    let body = bytes.len().checked_sub(HASH).ok_or_else(damaged)?;
    let (content, hash) = bytes.split_at(body);
    if Sha256::digest(content).as_slice() != hash {
        return Err(damaged());
    }
    let line = content
        .iter()
        .position(|b| *b == b'\n')
        .ok_or_else(damaged)?;
    let head: Value = serde_json::from_slice(&content[..line]).map_err(|_| damaged())?;
    let number = |key: &str| head[key].as_u64().and_then(|n| usize::try_from(n).ok());
    let (Some(first), Some(count), Some(columns)) =
        (number("first"), number("runs"), number("columns"))
    else {
        return Err(damaged());
    };
    if head["study"] != study || first != runs.start || count != runs.len() {
        return Err(Error::new(
            ErrorKind::InvalidData,
            "the file is of another study",
        ));
    }
    let width = ID + 8 * columns;
    let rows = &content[line + 1..];
    if rows.len() != count * width {
        return Err(damaged());
    }
    let row = |(i, bytes): (usize, &[u8])| {
        let (id, values) = bytes.split_first_chunk::<ID>()?;
        let values = values.as_chunks::<8>().0;
        let run = first + i;
        Some(Row {
            run,
            id: *id,
            values: values.iter().map(|b| f64::from_le_bytes(*b)).collect(),
            ending: ending(&head["endings"][run.to_string()])?,
        })
    };
    let rows = rows.chunks_exact(width).enumerate().map(row);
    rows.collect::<Option<Vec<_>>>().ok_or_else(damaged)
}

/// How a run ended, from the head of its chunk; `None` if this cannot be.
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
        (7..10)
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
                    9 => Ending::Collapsed("storey 1".to_owned()),
                    _ => Ending::Complete,
                },
            })
            .collect()
    }

    #[test]
    fn rows_come_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chunk");
        write_chunk(&path, "study", &rows()).unwrap();
        let back = read_chunk(&path, "study", &(7..10)).unwrap();
        for (a, b) in back.iter().zip(rows()) {
            let bits = |r: &Row| r.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(
                (a.run, a.id, &a.ending, bits(a)),
                (b.run, b.id, &b.ending, bits(&b))
            );
        }
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    /// Any cut, and any changed byte, is seen.
    #[test]
    fn damage_is_seen() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("chunk");
        write_chunk(&path, "study", &rows()).unwrap();
        let whole = std::fs::read(&path).unwrap();
        for cut in 0..whole.len() {
            std::fs::write(&path, &whole[..cut]).unwrap();
            assert!(
                read_chunk(&path, "study", &(7..10)).is_err(),
                "cut at {cut}"
            );
            let mut bent = whole.clone();
            bent[cut] ^= 1;
            std::fs::write(&path, &bent).unwrap();
            assert!(
                read_chunk(&path, "study", &(7..10)).is_err(),
                "bent at {cut}"
            );
        }
        std::fs::write(&path, &whole).unwrap();
        assert!(read_chunk(&path, "other", &(7..10)).is_err());
        assert!(read_chunk(&path, "study", &(6..9)).is_err());
    }
}
