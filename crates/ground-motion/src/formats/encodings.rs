//! Files that hold no text in bytes, by how they start: packed, or in characters of two or four bytes.

use crate::error::GroundMotionError;

/// Bytes that show of how many each character is.
const SAMPLE: usize = 4096;
const SAVE: &str = "save it as UTF-8";

/// Refuses what is packed or text in other characters than bytes, and says what it is.
pub(super) fn is_plain_text(file: &str, start: &[u8]) -> Result<(), GroundMotionError> {
    // Longer marks go before those that they start with.
    let starts: [(&[u8], &str, &'static str); 7] = [
        (
            b"MS\x03",
            "the file is miniSEED 3, of which records of version 2 alone are read",
            "convert it to miniSEED 2, or to SAC or text, by the tools of whoever gives it out",
        ),
        (
            b"\x1f\x8b",
            "the file is compressed by gzip",
            "unpack it, `gunzip FILE`, and give what is in it",
        ),
        (
            b"PK\x03\x04",
            "the file is a zip archive",
            "unpack it, and give the file of one record",
        ),
        (b"\xff\xfe\0\0", "the text is UTF-32", SAVE),
        (b"\0\0\xfe\xff", "the text is UTF-32", SAVE),
        (b"\xff\xfe", "the text is UTF-16", SAVE),
        (b"\xfe\xff", "the text is UTF-16", SAVE),
    ];
    let marked = starts.iter().find(|(first, ..)| start.starts_with(first));
    match marked.map(|(_, what, remedy)| (*what, *remedy)) {
        Some((what, remedy)) => Err(unsupported(file, what, remedy)),
        None => match of_wide_characters(start) {
            Some(what) => Err(unsupported(file, what, SAVE)),
            None => Ok(()),
        },
    }
}

/// Text of ASCII letters in two or four bytes each, without a mark at its start: all bytes of a
/// character but one are zero.
fn of_wide_characters(start: &[u8]) -> Option<&'static str> {
    let sample = &start[..start.len().min(SAMPLE) / 4 * 4];
    let mut zeros = [0; 4];
    for four in sample.chunks_exact(4) {
        for (count, byte) in zeros.iter_mut().zip(four) {
            *count += usize::from(*byte == 0);
        }
    }
    let all = sample.len() / 4;
    let pattern = zeros.map(|count| 10 * count > 9 * all);
    let few = |count: usize| 10 * count < all;
    let filled: Vec<usize> = (0..4).filter(|i| !pattern[*i]).collect();
    if all == 0 || !filled.iter().all(|i| few(zeros[*i])) {
        return None;
    }
    match filled[..] {
        [0, 2] | [1, 3] => Some("the text is UTF-16"),
        [0] | [3] => Some("the text is UTF-32"),
        _ => None,
    }
}

/// Refuses an alphanumeric SAC file: fourteen lines of five numbers of 15
/// characters, of which those that nobody knows are -12345.
pub(super) fn is_no_alphanumeric_sac(file: &str, start: &[u8]) -> Result<(), GroundMotionError> {
    const UNDEFINED: &[u8] = b"-12345.0";
    let mut lines = start.split(|b| *b == b'\n').map(<[u8]>::trim_ascii_end);
    let rows: Vec<&[u8]> = lines.by_ref().take(14).collect();
    let is_row = |row: &&[u8]| row.len() == 75 && row.is_ascii();
    let undefined = rows
        .iter()
        .filter(|row| row.windows(UNDEFINED.len()).any(|w| w == UNDEFINED));
    if rows.len() < 14 || !rows.iter().all(is_row) || undefined.count() < 7 {
        return Ok(());
    }
    Err(unsupported(
        file,
        "the file is an alphanumeric SAC file, of which the binary ones alone are read",
        "write it as binary SAC, `convert from alpha FILE to sac FILE` in SAC, or give its values as plain columns",
    ))
}

/// Refuses a file of no known format whose numbers have a dash for the minus, as word processors write it.
pub(super) fn has_hyphens(file: &str, start: &[u8]) -> Result<(), GroundMotionError> {
    let dashes = [("\u{2212}", "U+2212"), ("\u{2013}", "U+2013")];
    for (dash, name) in dashes {
        let of_number = |four: &[u8]| {
            let (first, last) = four.split_at(dash.len());
            first == dash.as_bytes() && last.iter().all(|b| b.is_ascii_digit() || *b == b'.')
        };
        if let Some(at) = start.windows(dash.len() + 1).position(of_number) {
            let line = 1 + start[..at].iter().filter(|b| **b == b'\n').count();
            let what = format!(
                "the numbers have the sign {name} (\"{dash}\") for a minus, first in line {line}"
            );
            return Err(unsupported(
                file,
                &what,
                "write the hyphen, `-`, before negative numbers",
            ));
        }
    }
    Ok(())
}

fn unsupported(file: &str, what: &str, remedy: &'static str) -> GroundMotionError {
    GroundMotionError::Unsupported {
        file: file.to_owned(),
        what: what.to_owned(),
        remedy,
    }
}
