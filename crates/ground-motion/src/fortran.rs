//! Fortran formats such as `(8F10.5)`: how many numbers per line, how wide each.

/// Widest line that a card image has.
const WIDEST_LINE: usize = 512;

/// Numbers of one width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Numbers per line.
    pub per_line: usize,
    /// Columns a number.
    pub width: usize,
}

impl Layout {
    /// A layout that is known to be sensible.
    pub(crate) const fn new(per_line: usize, width: usize) -> Self {
        Self { per_line, width }
    }

    /// Parses `8F10.5`, `(10I8)`, `(1E15.6)`, `8(1PE10.4E1)`; `None` for anything
    /// else, also for widths that no agency prints.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let mut rest = text.trim().trim_start_matches('(').trim_start();
        let per_line = leading_number(&mut rest).unwrap_or(1);
        rest = rest.trim_start_matches(['(', ' ']);
        let scaled = rest.to_ascii_uppercase();
        if let Some(after) = scaled.strip_prefix("1P") {
            rest = &rest[rest.len() - after.len()..];
        }
        let kind = rest.chars().next()?.to_ascii_uppercase();
        if !matches!(kind, 'I' | 'F' | 'E' | 'D' | 'G') {
            return None;
        }
        rest = rest.get(1..)?;
        let width = leading_number(&mut rest)?;
        (width >= 3 && (1..=WIDEST_LINE).contains(&per_line) && per_line * width <= WIDEST_LINE)
            .then_some(Self { per_line, width })
    }

    /// The last format in parentheses in a line of text.
    pub(crate) fn find(text: &str) -> Option<Self> {
        text.rmatch_indices('(')
            .find_map(|(at, _)| Self::parse(text.get(at..)?))
    }
}

fn leading_number(rest: &mut &str) -> Option<usize> {
    let end = rest
        .bytes()
        .position(|b| !b.is_ascii_digit())
        .unwrap_or(rest.len());
    let number = rest.get(..end)?.parse().ok()?;
    *rest = &rest[end..];
    Some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_that_agencies_print() {
        for (text, per_line, width) in [
            ("(8f9.6)", 8, 9),
            ("(10I8)", 10, 8),
            ("(1E15.6)", 1, 15),
            ("8(1PE10.4E1)", 8, 10),
            ("8F9.6,I7", 8, 9),
            ("(E13.6)", 1, 13),
        ] {
            assert_eq!(
                Layout::parse(text),
                Some(Layout::new(per_line, width)),
                "{text}"
            );
        }
        for text in [
            "",
            "(",
            "a",
            "t,a",
            "0F10.5",
            "8F1.0",
            "99999999999999999999F10",
            "8A10",
        ] {
            assert_eq!(Layout::parse(text), None, "{text}");
        }
        assert_eq!(
            Layout::find(" 42000 acceleration pts, units=cm/sec2(04),Format=(1E15.6)"),
            Some(Layout::new(1, 15))
        );
    }
}
