//! Headers among the rows: several records in one file, which would be read as one.

use super::{COMMENTS, before, is_comment, rows, stated};
use crate::error::GroundMotionError;
use crate::number;
use crate::source::Source;
use crate::text::Line;

/// What to do about several records in one file.
const REMEDY: &str = "give each record a file of its own, the lines of its header with the rows below them; the values of two records must not follow one another. If all values are of one record, the line is wrong there: take it out";
/// First words of two lines by which they are the same line of two headers.
const WORDS: usize = 2;

/// Words of a line, in lower case, without the signs of a comment.
fn words(line: &Line<'_>) -> Vec<String> {
    let lower = line.lower();
    let words = lower.split(|c: char| !c.is_alphabetic());
    words
        .filter(|w| !w.is_empty())
        .take(WORDS)
        .map(str::to_owned)
        .collect()
}

/// The line before the rows that has the same first words as another one, one of them of more than two letters.
fn like<'a>(source: &Source<'a>, line: &Line<'_>) -> Option<Line<'a>> {
    let own = words(line);
    if !own.iter().any(|word| word.chars().count() > 2) {
        return None;
    }
    before(source).find(|l| words(l) == own)
}

/// What a line among the rows has of a header.
fn of_header(source: &Source<'_>, line: &Line<'_>) -> Option<String> {
    if let Some(first) = like(source, line) {
        return Some(format!("it begins as line {} does", first.number));
    }
    let states = stated::states_a_record(line);
    states.then(|| "it says what a header says".to_owned())
}

/// The first word of a row of numbers that stands for one that is missing.
fn missing_value(line: Line<'_>) -> Option<(usize, &[u8])> {
    const WORDS: [&[u8]; 5] = [b"na", b"n/a", b"null", b"none", b"missing"];
    let is_missing = |field: &[u8]| WORDS.iter().any(|word| field.eq_ignore_ascii_case(word));
    let is_row = line
        .fields()
        .all(|(_, field)| is_missing(field) || number::parse(field).is_ok());
    line.fields().find(|(_, field)| is_row && is_missing(field))
}

/// The error of a line of text among the rows.
pub(super) fn text_among_numbers(source: &Source<'_>, line: Line<'_>) -> GroundMotionError {
    if let Some((column, word)) = missing_value(line) {
        return source.error(
            line.number,
            column,
            format!("\"{}\" stands for a value that is missing", number::shown(word)),
            "no sample may be missing: write the value there, get the record again, or put in one between those before and behind it",
        );
    }
    match of_header(source, &line) {
        Some(why) => several(source, line, &why),
        None => source.error(
            line.number,
            0,
            "text among the numbers",
            "if the values above and below it are of one record, remove the line, or start it with #; else give each record a file of its own",
        ),
    }
}

fn several(source: &Source<'_>, line: Line<'_>, why: &str) -> GroundMotionError {
    let shown: String = line.text().trim().chars().take(60).collect();
    source.error(
        line.number,
        0,
        format!("\"{shown}\" stands among the numbers, and {why}: several records in one file?"),
        REMEDY,
    )
}

/// Whether the first numbers of the rows around a line are times that go on by the step before it: rows of one record.
fn times_go_on(source: &Source<'_>, line: usize) -> bool {
    let time = |row: &Line<'_>| {
        let mut fields = row.fields();
        let (_, first) = fields.next()?;
        // Values along rows are no times.
        fields.next()?;
        number::parse(first).ok()
    };
    let mut before = [None; 2];
    for row in rows(source) {
        if row.number < line {
            before = [before[1], time(&row)];
            continue;
        }
        let ([Some(a), Some(b)], Some(c)) = (before, time(&row)) else {
            return false;
        };
        let step = b - a;
        return step > 0.0 && (c - b - step).abs() <= 0.01 * step;
    }
    false
}

/// Refuses comments among the rows that state a count, a time step or what the values are, or that repeat a line of
/// the header which does.
///
/// # Errors
/// At the first such line, unless the user takes the file as it is.
pub(super) fn are_of_one_record(source: &Source<'_>) -> Result<(), GroundMotionError> {
    let mut numbers = rows(source).map(|line| line.number);
    let (Some(first), Some(last)) = (numbers.next(), numbers.last()) else {
        return Ok(());
    };
    let comments = source
        .all_lines()
        .skip(first)
        .take_while(|line| line.number < last)
        .filter(is_comment);
    for line in comments {
        let text = line.bytes.trim_ascii_start();
        let signs = COMMENTS.iter().find_map(|sign| text.strip_prefix(*sign));
        let bare = Line {
            bytes: signs.unwrap_or(text),
            ..line
        };
        let repeats = || like(source, &bare).is_some_and(|l| stated::states_a_record(&l));
        if !(stated::states_a_record(&bare) || repeats()) || times_go_on(source, line.number) {
            continue;
        }
        let why = of_header(source, &bare).unwrap_or_default();
        let error = several(source, line, &why);
        if !source.options.lenient {
            return Err(error);
        }
        source.warn(&error.to_string());
    }
    Ok(())
}
