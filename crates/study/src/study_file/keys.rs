//! Keys of a table that are missing, or exclude one another.

use std::ops::Range;

use pounding_case::document::Reader;

/// Refuses a table in which a key is missing.
pub(super) fn lacks<T>(
    reader: &Reader<'_>,
    table: &str,
    span: Range<usize>,
    key: &str,
) -> Option<T> {
    let message = format!("{table} has no `{key}`");
    reader.refuse(span, message, format!("add `{key} = ...`"))
}

/// A key and where its value stands, if it is given.
pub(super) type Place<'k> = (&'k str, Option<Range<usize>>);

/// Refuses a table that has both keys, which exclude one another.
pub(super) fn not_both(
    reader: &Reader<'_>,
    table: &str,
    (a, first): Place<'_>,
    (b, second): Place<'_>,
) -> Option<()> {
    let Some((_, second)) = first.zip(second) else {
        return Some(());
    };
    let message = format!("{table} has `{a}` and `{b}`, which exclude one another");
    reader.refuse(second, message, "remove one of them")
}
