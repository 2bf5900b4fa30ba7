//! Excerpts of files beside errors.

use miette::{
    LabeledSpan, MietteDiagnostic, MietteError, MietteSpanContents, NamedSource, Report,
    SourceCode, SourceSpan, SpanContents,
};

use crate::terminal;

/// Bytes of an excerpt that is shown whole: some lines, but none of megabytes.
const LONGEST: usize = 2000;
/// Bytes that are shown on either side of a place in an excerpt that is cut.
const AROUND: usize = 60;

/// What may stand before a text in UTF-8.
const MARK: char = '\u{feff}';

/// An error at a place (byte range) in a file, with the lines around it.
pub fn report(
    diagnostic: MietteDiagnostic,
    file: &str,
    source: &str,
    place: std::ops::Range<usize>,
) -> Report {
    // A byte order mark is no column that an editor would show.
    let (source, place) = match source.strip_prefix(MARK) {
        Some(rest) => {
            let moved = |at: usize| at.saturating_sub(MARK.len_utf8());
            (rest, moved(place.start)..moved(place.end))
        }
        None => (source, place),
    };
    let end = place.end.min(source.len());
    let shown = match end.saturating_sub(place.start) > LONGEST {
        true => boundary_before(source, place.start + AROUND),
        false => end,
    };
    let length = shown.saturating_sub(place.start);
    let diagnostic = diagnostic.with_label(LabeledSpan::at((place.start, length), "here"));
    let source = Excerpt(terminal::source(source));
    Report::new(diagnostic).with_source_code(NamedSource::new(terminal::shown(file), source))
}

/// A text of which an excerpt is no longer than people read.
#[derive(Debug)]
struct Excerpt(String);

impl SourceCode for Excerpt {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        context_lines_before: usize,
        context_lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let whole = self
            .0
            .read_span(span, context_lines_before, context_lines_after)?;
        if whole.data().len() <= LONGEST {
            return Ok(whole);
        }
        let first = whole.span().offset();
        let last = first + whole.span().len();
        let start = boundary_before(&self.0, span.offset().saturating_sub(AROUND)).max(first);
        let end = boundary_before(&self.0, span.offset() + span.len() + AROUND).min(last);
        let before = self.0[first..start].matches('\n').count();
        Ok(Box::new(MietteSpanContents::new(
            &self.0.as_bytes()[start..end],
            (start, end - start).into(),
            whole.line() + before,
            whole.column(),
            whole.line_count(),
        )))
    }
}

/// The last place at which a character begins, up to one.
fn boundary_before(text: &str, place: usize) -> usize {
    let mut place = place.min(text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(source: &str, place: std::ops::Range<usize>) -> String {
        let diagnostic = MietteDiagnostic::new("it is wrong");
        format!("{:?}", report(diagnostic, "a.toml", source, place))
    }

    #[test]
    fn of_a_long_line_the_place_is_shown() {
        let long = "\u{e4}".repeat(1_000_000);
        let source = format!("first = 1\nsecond = \"{long}\" wrong \"{long}\"\nthird = 3\n");
        let at = source.find("wrong").unwrap_or_default();
        for (place, column) in [
            (at..at + 5, "2000013"),
            (18..source.len() - 20, "9"),
            (at..at, ""),
        ] {
            let told = shown(&source, place);
            assert!(told.len() < 3 * LONGEST, "{}", told.len());
            assert!(told.contains(&format!("a.toml:2:{column}")), "{told}");
            assert!(told.contains("here"), "{told}");
        }
        // Lines beside it are cut, too, and its number stays.
        let source = format!("{long}\n{long}\nwrong\n{long}");
        let at = source.find("wrong").unwrap_or_default();
        let told = shown(&source, at..at + 5);
        assert!(
            told.len() < 3 * LONGEST && told.contains(" 3 \u{2502} wrong"),
            "{told}"
        );
    }

    #[test]
    fn a_byte_order_mark_is_no_column() {
        let told = shown("\u{feff}first = 1\n", 3..8);
        assert!(told.contains("a.toml:1:1"), "{told}");
    }

    #[test]
    fn a_short_excerpt_is_whole() {
        let told = shown("first = 1\nsecond = 2\nthird = 3\n", 10..16);
        for part in ["a.toml:2:1", "first = 1", "second = 2", "third = 3"] {
            assert!(told.contains(part), "{told}");
        }
    }
}
