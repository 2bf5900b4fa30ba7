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
    /// Blank columns before the first number of a line.
    pub margin: usize,
}

impl Layout {
    /// A layout that is known to be sensible.
    pub(crate) const fn new(per_line: usize, width: usize) -> Self {
        Self {
            per_line,
            width,
            margin: 0,
        }
    }

    /// The layout of a line of numbers that all print as many decimals, from where their
    /// decimal points stand: `1X,10F7.3`, `10F8.3`; `None` where the points are not even.
    pub(crate) fn of_points(line: &[u8]) -> Option<Self> {
        let points: Vec<usize> = (0..line.len()).filter(|i| line[*i] == b'.').collect();
        let (first, last) = (*points.first()?, *points.last()?);
        let width = *points.get(1)? - first;
        let even = points.windows(2).all(|p| p[1] - p[0] == width);
        let decimals = line.len() - 1 - last;
        let margin = (first + 1 + decimals).checked_sub(width)?;
        let plain = line[last + 1..].iter().all(u8::is_ascii_digit);
        let blank = line[..margin].iter().all(|b| *b == b' ');
        let per_line = points.len();
        let fits = decimals + 1 < width && margin + per_line * width <= WIDEST_LINE;
        (even && plain && blank && fits).then_some(Self {
            per_line,
            width,
            margin,
        })
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
            .then_some(Self::new(per_line, width))
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
    fn layouts_from_decimal_points() {
        for (line, per_line, width, margin) in [
            ("    .000  -.066   .009  -.042", 4, 7, 1),
            ("   .000  -.066   .009  -.042", 4, 7, 0),
            ("    .000   -.066    .009   -.042", 4, 8, 0),
            ("  12.000-100.066", 2, 8, 0),
        ] {
            let expected = Layout {
                per_line,
                width,
                margin,
            };
            assert_eq!(Layout::of_points(line.as_bytes()), Some(expected), "{line}");
        }
        // Two widths in turn: not one layout.
        for line in [
            "   .000   -.066   .009   -.042",
            "",
            "1 2 3",
            "   .000",
            "1.0E+0 2.0E+0",
            "x   .000   .001",
        ] {
            assert_eq!(Layout::of_points(line.as_bytes()), None, "{line}");
        }
    }

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
