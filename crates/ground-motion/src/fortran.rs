//! Fortran formats such as `(8F10.5)`: how many numbers per line, how wide each, and what a number
//! without a decimal point or without an exponent means.

/// Widest line that a card image has.
const WIDEST_LINE: usize = 512;
/// Largest scale factor: no program prints another than 1 or 2.
const MOST_SCALE: i32 = 20;

/// Numbers of one width.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Layout {
    /// Numbers per line.
    pub per_line: usize,
    /// Columns a number.
    pub width: usize,
    /// Columns before the first number of a line, which are blank.
    pub margin: usize,
    /// Whether anything may stand in them: `X` of a format passes over it.
    pub skips: bool,
    /// Blank columns before each number, which are of its width.
    pub gap: usize,
    /// Whether the format goes on behind the numbers: what stands there is passed over.
    pub more: bool,
    /// Whether every number is printed with an exponent, which those of `G` formats may lack.
    pub exponents: bool,
    /// Whether every number is a whole one: those of `I` formats.
    pub wholes: bool,
    /// Digits that are decimals where a number has no point: `-241` under F10.5 is -0.00241.
    decimals: i32,
    /// Power of ten by which numbers without an exponent are printed larger: `kP`.
    scale: i32,
}

impl Layout {
    /// A layout that is known to be sensible.
    pub(crate) const fn new(per_line: usize, width: usize) -> Self {
        Self {
            per_line,
            width,
            margin: 0,
            skips: false,
            gap: 0,
            more: false,
            exponents: false,
            wholes: false,
            decimals: 0,
            scale: 0,
        }
    }

    /// The same of numbers that all have exponents.
    pub(crate) const fn with_exponents(self) -> Self {
        Self {
            exponents: true,
            ..self
        }
    }

    /// Whether nothing but numbers stands on a line.
    pub(crate) fn is_plain(self) -> bool {
        self.margin == 0 && self.gap == 0
    }

    /// The decimals that a number without a point has all the same.
    pub(crate) const fn implied_decimals(self) -> i32 {
        self.decimals
    }

    /// The fields of a row that are not blank, with their columns (from 0).
    pub(crate) fn fields(self, row: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
        let (margin, fields) = row.split_at(self.margin.min(row.len()));
        let fields = fields.chunks(self.width).enumerate();
        let placed = fields.map(move |(i, field)| (margin.len() + i * self.width, field));
        placed.filter(|(_, field)| !field.trim_ascii().is_empty())
    }

    /// The value of a field that was read as a number with a point behind its digits.
    pub(crate) fn value(self, field: &[u8], number: f64) -> f64 {
        let plain = field.trim_ascii();
        let has_exponent =
            |(i, b): (usize, &u8)| b"eEdD".contains(b) || (i > 0 && matches!(b, b'+' | b'-'));
        let mut power = 0;
        if !plain.contains(&b'.') {
            power += self.decimals;
        }
        if !plain.iter().enumerate().any(has_exponent) {
            power += self.scale;
        }
        match power {
            0 => number,
            // Exact where the power is.
            1.. => number / 10.0_f64.powi(power),
            _ => number * 10.0_f64.powi(-power),
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
            margin,
            ..Self::new(per_line, width)
        })
    }

    /// Parses `8F10.5`, `(10I8)`, `(1PE15.6)`, `1P5E14.6`, `2X,8F9.5`, `5(1X,E14.7)`,
    /// `8(1PE10.4E1)`; `None` for anything else, also for widths that no agency prints and for
    /// groups of two numbers. What follows the numbers is not looked at.
    pub(crate) fn parse(text: &str) -> Option<Self> {
        let upper = text.to_ascii_uppercase();
        let mut rest = upper.trim().trim_start_matches('(').trim_start();
        let mut layout = Self::new(1, 0);
        let mut group = None;
        loop {
            let negative = rest.strip_prefix('-');
            rest = negative.unwrap_or(rest);
            let number = leading_number(&mut rest);
            let mut letters = rest.chars();
            let kind = letters.next()?;
            rest = letters.as_str();
            match (kind, group) {
                ('X', None) => {
                    layout.margin += number.unwrap_or(1).min(WIDEST_LINE);
                    layout.skips = true;
                }
                ('X', Some(_)) => layout.gap += number.unwrap_or(1).min(WIDEST_LINE),
                ('P', _) => {
                    let power = i32::try_from(number?).ok().filter(|k| *k <= MOST_SCALE)?;
                    layout.scale = if negative.is_some() { -power } else { power };
                }
                ('(', None) => group = Some(number.unwrap_or(1)),
                ('I' | 'F' | 'E' | 'D' | 'G', _) if negative.is_none() => {
                    // ES and EN are read as E.
                    rest = match kind {
                        'E' => rest.strip_prefix(['S', 'N']).unwrap_or(rest),
                        _ => rest,
                    };
                    let width = leading_number(&mut rest).filter(|w| *w >= 3)?;
                    if let Some(behind) = rest.strip_prefix('.') {
                        rest = behind;
                        let decimals = leading_number(&mut rest).filter(|d| *d <= width)?;
                        layout.decimals = i32::try_from(decimals).ok()?;
                    }
                    if kind == 'I' {
                        (layout.decimals, layout.scale) = (0, 0);
                        layout.wholes = true;
                    }
                    let other = rest.trim_start().starts_with(',');
                    let uneven = layout.gap > 0 && number.is_some_and(|n| n > 1);
                    if group.is_some() && (other || uneven) {
                        return None;
                    }
                    layout.per_line = group.unwrap_or(1).checked_mul(number.unwrap_or(1))?;
                    layout.width = layout.gap + width;
                    layout.more = other;
                    break;
                }
                _ => return None,
            }
            rest = rest.trim_start_matches([' ', ',']);
        }
        let fits = (1..=WIDEST_LINE).contains(&layout.per_line)
            && layout.width <= WIDEST_LINE
            && layout.margin + layout.per_line * layout.width <= WIDEST_LINE;
        fits.then_some(layout)
    }

    /// The last format in parentheses in a line of text, with what repeats it before them:
    /// `(5(1PE15.6))`.
    pub(crate) fn find(text: &str) -> Option<Self> {
        let formats = text
            .rmatch_indices('(')
            .map(|(at, _)| (at, text.get(at..).and_then(Self::parse)));
        let mut formats = formats.skip_while(|(_, format)| format.is_none());
        let (inner, found) = formats.next()?;
        let repeats = |(at, _): &(usize, Option<Self>)| {
            let between = text[at + 1..inner].trim();
            !between.is_empty() && between.bytes().all(|b| b.is_ascii_digit())
        };
        formats
            .next()
            .filter(repeats)
            .and_then(|(_, format)| format)
            .or(found)
    }
}

/// The format of a row of numbers that all have as many decimals, from where their decimal points stand:
/// `5E14.7`, `1X,8F9.5`; `None` where the points are not even.
pub(crate) fn format_of(row: &[u8]) -> Option<String> {
    let points: Vec<usize> = (0..row.len()).filter(|i| row[*i] == b'.').collect();
    let (first, second) = (*points.first()?, *points.get(1)?);
    let width = second - first;
    let behind = &row[*points.last()? + 1..];
    let decimals = behind.iter().take_while(|b| b.is_ascii_digit()).count();
    let exponent = &behind[decimals..];
    let of_exponent = |b: &u8| b.is_ascii_digit() || b"eEdD+-".contains(b);
    let margin = (first + 1 + behind.len()).checked_sub(width)?;
    let is_even = points.windows(2).all(|p| p[1] - p[0] == width)
        && exponent.iter().all(of_exponent)
        && row[..margin].iter().all(|b| *b == b' ');
    let kind = if exponent.is_empty() { 'F' } else { 'E' };
    let format = format!("{}{kind}{width}.{decimals}", points.len());
    let format = match margin {
        0 => format,
        margin => format!("{margin}X,{format}"),
    };
    Layout::parse(&format).filter(|_| is_even).map(|_| format)
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
    #![allow(clippy::unwrap_used)]
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
                margin,
                ..Layout::new(per_line, width)
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
            ("(1PE15.6)", 1, 15),
            ("(1P5E14.6)", 5, 14),
            ("1P,5E14.6", 5, 14),
            ("5(1X,E14.7)", 5, 15),
            ("2X,8F9.5", 8, 9),
            ("6ES12.4", 6, 12),
        ] {
            let found = Layout::parse(text).map(|l| (l.per_line, l.width));
            assert_eq!(found, Some((per_line, width)), "{text}");
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
            "4(F8.3,F10.4)",
            "5(1X,2E14.7)",
            "F10.99",
        ] {
            assert_eq!(Layout::parse(text), None, "{text}");
        }
        assert_eq!(
            Layout::find(" 42000 acceleration pts, units=cm/sec2(04),Format=(1E15.6)"),
            Layout::parse("1E15.6")
        );
        let nested = Layout::find("units=cm/sec2(04), Format=(5(1PE15.6))").map(|l| l.per_line);
        assert_eq!(nested, Some(5));
    }

    /// Fortran's rules for input: decimals are implied without a point, and a scale factor
    /// counts without an exponent alone.
    #[test]
    fn numbers_without_point_or_exponent() {
        for (format, field, value) in [
            ("4F10.5", "      -241", -0.00241),
            ("4F10.5", "   -0.0241", -0.0241),
            ("4F10.0", "      -241", -241.0),
            ("10I8", "    -241", -241.0),
            ("(1PE15.6)", "   1.500000E-01", 0.15),
            ("(1PE15.6)", "       1.500000", 0.15),
            ("(1PE15.6)", "     1.500000-1", 1.5e-1),
            ("2P8F9.3", "   12.500", 0.125),
            ("-2P8F9.3", "   12.500", 1250.0),
            ("(E12.4)", "     15000E2", 150.0),
        ] {
            let layout = Layout::parse(format).unwrap();
            let read = match field.trim() {
                "1.500000-1" => 0.15,
                plain => plain.parse().unwrap(),
            };
            let found = layout.value(field.as_bytes(), read);
            assert!((found / value - 1.0).abs() < 1e-15, "{format}: {found}");
        }
    }
}
