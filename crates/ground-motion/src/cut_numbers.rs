//! Numbers that lost their end: `1.494E-02` cut after `1.494` or `1.494E-0` is a number too.

use std::collections::VecDeque;

use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::number;
use crate::source::Source;
use crate::text::Line;

/// Values that show how a file writes its values.
const LIKE_IT: usize = 3;
/// Values without exponents that show how many decimals a file prints: one that leaves out zeros
/// at the end prints as many in all of them by chance only.
const LIKE_IT_IN_DECIMALS: usize = 30;
/// Last lines of values in which the form of a number is looked for.
const LAST_LINES: usize = 60;
/// Values among which one in another form is damaged.
const MANY: usize = 20;

/// Values with exponents among which one with fewer decimals is damaged: of those that leave out zeros at
/// the end a tenth has fewer.
const MANY_DECIMALS: usize = 200;

/// What a printed number has behind its decimal point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Form {
    decimals: usize,
    /// Characters of the exponent, with its letter.
    exponent: usize,
}

impl Form {
    /// The form of a field; `None` of a number without a point or an exponent without a letter.
    fn of(field: &[u8]) -> Option<Self> {
        let end = field.iter().position(|b| b"eEdD".contains(b));
        let mantissa = &field[..end.unwrap_or(field.len())];
        let point = mantissa.iter().position(|b| *b == b'.')?;
        let decimals = &mantissa[point + 1..];
        decimals.iter().all(u8::is_ascii_digit).then_some(Self {
            decimals: decimals.len(),
            exponent: field.len() - mantissa.len(),
        })
    }
}

/// Forms of all values of a series, as far as they show one that was cut off among them.
#[derive(Debug, Default)]
pub(crate) struct Forms {
    count: usize,
    usual: Option<Form>,
    /// Values with another exponent, and the first of them: line, column, field.
    others: usize,
    first: Option<(usize, usize, String)>,
    /// Whether values of all sizes are printed with an exponent: where a first digit other than
    /// zero stands before the point, or an exponent is zero. `G` formats print values about 1
    /// without one.
    is_always: bool,
    /// Whether the values show no form: decimals differ, or points are missing.
    none: bool,
    exponents: Exponents,
    decimals: Decimals,
    /// Whether one program prints all files of the format, so that fewer decimals are lost ones without exponents, too.
    of_one_program: bool,
}

/// Values by their decimals: one that alone has fewer lost a digit.
#[derive(Debug, Default)]
struct Decimals {
    count: usize,
    usual: usize,
    /// Values with fewer, and the first of them: line, column, field.
    fewer: usize,
    first: Option<(usize, usize, String)>,
    /// Whether some have more.
    more: bool,
}

impl Decimals {
    fn see(&mut self, decimals: usize, place: impl FnOnce() -> (usize, usize, String)) {
        self.count += 1;
        if self.count == 1 {
            self.usual = decimals;
        } else if decimals < self.usual {
            self.fewer += 1;
            self.first.get_or_insert_with(place);
        } else if decimals > self.usual {
            self.more = true;
        }
    }

    /// The first value with fewer decimals than all others, of so many that no writer leaves out zeros.
    fn lost(&self) -> Option<&(usize, usize, String)> {
        let few = self.count > MANY_DECIMALS && self.fewer <= self.count / 1000 + 1;
        self.first.as_ref().filter(|_| few && !self.more)
    }
}

/// Which values of a series have exponents.
#[derive(Debug, Default)]
struct Exponents {
    with: usize,
    /// Values other than zero without one, and the first of them.
    without: usize,
    first: Option<Bare>,
    /// Whether one has an exponent that is as large as values of a tenth and more, or of a
    /// ten-thousandth.
    of_tenths: bool,
    of_ten_thousandths: bool,
    /// Decimals of all of those with an exponent, if they are the same, and whether a zero ends
    /// them: `%g` leaves those out.
    decimals: Option<usize>,
    decimals_differ: bool,
    ends_in_zero: bool,
    wholes: Wholes,
}

/// Whole numbers without a point among numbers with exponents, as `%d` of MATLAB writes them where a value is whole,
/// and how far they are from their neighbours.
#[derive(Debug, Default)]
struct Wholes {
    count: usize,
    before: Option<(f64, bool)>,
    /// Largest difference between neighbours, of which one is such a number, and of which none is.
    far: f64,
    usual: f64,
}

impl Wholes {
    fn see(&mut self, value: f64, is_whole: bool) {
        self.count += usize::from(is_whole);
        if let Some((before, was_whole)) = self.before.replace((value, is_whole)) {
            let step = (value - before).abs();
            let largest = match is_whole || was_whole {
                true => &mut self.far,
                false => &mut self.usual,
            };
            *largest = largest.max(step);
        }
    }

    /// Whether all lie as near their neighbours as other values do.
    fn follow(&self) -> bool {
        self.far <= self.usual
    }
}

/// A value without an exponent.
#[derive(Debug)]
struct Bare {
    line: usize,
    column: usize,
    field: String,
    value: f64,
    /// Digits but zeros before the first other one.
    digits: usize,
}

/// Magnitude below which `G` formats of Fortran print exponents, and below which `%g` does.
const BELOW_G: f64 = 0.1;
const BELOW_PERCENT_G: f64 = 1.0e-4;
/// Magnitude from which on some writers print exponents.
const LARGE: f64 = 1.0e5;

impl Exponents {
    fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        let Ok(value) = number::parse(field) else {
            return;
        };
        let end = (1..field.len())
            .find(|i| b"eEdD".contains(&field[*i]) || matches!(field[*i], b'+' | b'-'));
        let is_whole = end.is_none() && !field.contains(&b'.');
        self.wholes.see(value, is_whole);
        let Some(end) = end else {
            if value != 0.0 {
                self.without += 1;
                let digits = field.iter().filter(|b| b.is_ascii_digit());
                self.first.get_or_insert_with(|| Bare {
                    line,
                    column,
                    field: number::shown(field),
                    value: value.abs(),
                    digits: digits.skip_while(|b| **b == b'0').count(),
                });
            }
            return;
        };
        self.with += 1;
        let size = value.abs();
        self.of_tenths |= (BELOW_G..LARGE).contains(&size);
        self.of_ten_thousandths |= (BELOW_PERCENT_G..LARGE).contains(&size);
        let mantissa = &field[..end];
        let point = mantissa.iter().position(|b| *b == b'.');
        let decimals = point.map_or(0, |point| mantissa.len() - point - 1);
        self.decimals_differ |= *self.decimals.get_or_insert(decimals) != decimals;
        self.ends_in_zero |= decimals > 0 && value != 0.0 && mantissa.ends_with(b"0");
    }

    /// The first value that lost its exponent among many others, which no writer leaves out there.
    fn lost(&self) -> Option<&Bare> {
        let few = self.with + self.without > MANY && self.without <= self.with / 100 + 1;
        let bare = self.first.as_ref().filter(|_| few)?;
        // Of a writer that has whole numbers without a point; one that was cut off is far from its neighbours.
        let all_whole = self.wholes.count >= self.without && !self.decimals_differ;
        if all_whole && self.wholes.follow() {
            return None;
        }
        // As many digits as with an exponent: printed by a `G` format.
        let of_g = bare.value >= BELOW_G && Some(bare.digits) == self.decimals;
        let always = self.of_tenths
            || self.of_ten_thousandths && !of_g
            || !self.decimals_differ && self.ends_in_zero && !of_g;
        always.then_some(bare)
    }
}

impl Forms {
    /// Of numbers that are printed in a layout.
    pub(crate) fn of(layout: Layout) -> Self {
        Self {
            is_always: layout.exponents,
            ..Self::default()
        }
    }

    /// Of numbers that one program prints in all files.
    pub(crate) fn of_one_program() -> Self {
        Self {
            of_one_program: true,
            ..Self::default()
        }
    }

    /// Takes one more value of a line into account, which starts at a column (from 0).
    pub(crate) fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        self.count += 1;
        self.exponents.see(line, column, field);
        let form = Form::of(field);
        let place = || (line, column, number::shown(field));
        match form.filter(|form| form.exponent > 0) {
            Some(form) => self.decimals.see(form.decimals, place),
            None if self.of_one_program => {
                let decimals = form.map_or(0, |form| form.decimals);
                self.decimals.see(decimals, place);
            }
            None => {}
        }
        let Some(form) = Form::of(field).filter(|_| !self.none) else {
            self.none = true;
            return;
        };
        let usual = *self.usual.get_or_insert(form);
        if form.decimals != usual.decimals {
            self.none = true;
            return;
        }
        if form.exponent < usual.exponent {
            self.others += 1;
            let place = || (line, column, number::shown(field));
            self.first.get_or_insert_with(place);
        } else if form.exponent > usual.exponent {
            // The values before this one were the others, or the file has two forms.
            self.none = self.count > 2 || self.others > 0;
            self.usual = Some(form);
            self.others = self.count - 1;
        }
        if form.exponent > 0 && form.exponent >= usual.exponent {
            let digits = field.strip_prefix(b"-").unwrap_or(field);
            let zero = |field: &[u8]| field.ends_with(b"00");
            self.is_always |= digits.first().is_some_and(|b| (b'1'..=b'9').contains(b))
                || zero(field) && number::parse(field).is_ok_and(|value| value != 0.0);
        }
    }

    /// Refuses a value that alone lacks the exponent, or a digit of it, of the many others.
    ///
    /// # Errors
    /// At that value.
    pub(crate) fn are_whole(&self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let has_exponent = self.usual.is_some_and(|form| form.exponent > 0);
        let few = self.others <= self.count / 100 + 1;
        if let Some(bare) = self.exponents.lost() {
            let whole = !bare.field.contains('.');
            let decimals = self.exponents.decimals.filter(|_| whole).unwrap_or(0);
            let remedy = match number::parse(bare.field.as_bytes()) {
                Ok(value) if whole => format!(
                    "some programs write whole numbers so: if it is one, write it as the others, {value:.decimals$e}; if it is no value, pass it over by `skip_lines`; else the file is damaged: correct the value, or get the record again"
                ),
                _ => "the file is damaged: correct the value, or get the record again".to_owned(),
            };
            return Err(source.error(
                bare.line,
                bare.column,
                format!(
                    "\"{}\" has no exponent, which the other values have",
                    bare.field
                ),
                &remedy,
            ));
        }
        if let Some((line, column, field)) = self.decimals.lost() {
            return Err(source.error(
                *line,
                *column,
                format!(
                    "\"{field}\" lacks a digit: the other values have {} decimals",
                    self.decimals.usual
                ),
                "the file is damaged: correct the value, or get the record again",
            ));
        }
        match &self.first {
            Some((line, column, field))
                if has_exponent && self.is_always && !self.none && self.count > MANY && few =>
            {
                Err(source.error(
                    *line,
                    *column,
                    format!("\"{field}\" has no exponent, or lacks a digit of it, which the other values have"),
                    "the file is damaged: correct the value, or get the record again",
                ))
            }
            _ => Ok(()),
        }
    }
}

impl Source<'_> {
    /// Whether the file ends as a line does, or with the mark of its end.
    pub(crate) fn ends_in_a_line_end(&self) -> bool {
        matches!(self.bytes.last(), Some(b'\n' | b'\r' | 0x1a) | None)
    }

    /// Whether the last value of the file is whole. It is not where the file ends without an end of
    /// line in a number without the exponent, or a digit of it, or with fewer decimals than all
    /// values of the lines before it have.
    ///
    /// # Errors
    /// It is cut off, unless the user takes what is there: without it, which is said.
    pub(crate) fn ends_whole(&self) -> Result<bool, GroundMotionError> {
        if self.ends_in_a_line_end() {
            return Ok(true);
        }
        let mut ends = VecDeque::with_capacity(LAST_LINES);
        for line in self.lines().filter(|line| !line.is_blank()) {
            if line.is_text() {
                ends.clear();
                continue;
            }
            if ends.len() == LAST_LINES {
                ends.pop_front();
            }
            ends.push_back(line);
        }
        // One value at a time: a line may be as long as the file.
        let values = ends.into_iter().flat_map(|line| {
            let fields = line.fields();
            fields.map(move |(column, field)| (line, column, field))
        });
        self.is_last_whole(values)
    }

    /// Whether the last of these values, with their lines and columns, in which a file ends without an end of line is
    /// whole: it has the exponent, and as many decimals, as all others.
    ///
    /// # Errors
    /// It is cut off, unless the user takes what is there: without it, which is said.
    pub(crate) fn is_last_whole<'a>(
        &self,
        values: impl Iterator<Item = (Line<'a>, usize, &'a [u8])>,
    ) -> Result<bool, GroundMotionError> {
        if self.ends_in_a_line_end() {
            return Ok(true);
        }
        let (mut last, mut before, mut of_first, mut alike) = (None, 0_usize, None, true);
        for value in values {
            if let Some((_, _, earlier)) = last.replace(value) {
                let found = Form::of(earlier);
                if before == 0 {
                    of_first = found;
                }
                alike &= found.is_some() && found == of_first;
                before += 1;
            }
        }
        let (Some((line, column, field)), Some(usual)) = (last, of_first.filter(|_| alike)) else {
            return Ok(true);
        };
        let form = Form::of(field);
        let lacks = if form.map_or(0, |form| form.exponent) < usual.exponent && before >= LIKE_IT {
            "the exponent"
        } else if usual.exponent == 0
            && form.map_or(0, |form| form.decimals) < usual.decimals
            && before >= LIKE_IT_IN_DECIMALS
        {
            "decimals"
        } else {
            return Ok(true);
        };
        self.is_cut_off(line, column, field, lacks)?;
        Ok(false)
    }

    /// Says that the last value of the file is cut off.
    ///
    /// # Errors
    /// Unless the user takes what is there, without it.
    pub(crate) fn is_cut_off(
        &self,
        line: Line<'_>,
        column: usize,
        field: &[u8],
        lacks: &str,
    ) -> Result<(), GroundMotionError> {
        let shown = number::shown(field.trim_ascii());
        if self.options.lenient {
            self.warn(&format!(
                "line {}: the file ends within its last value, \"{shown}\", which is not used",
                line.number
            ));
            return Ok(());
        }
        Err(self.error(
            line.number,
            column,
            format!(
                "the file ends within its last value: \"{shown}\" lacks {lacks} of the values before it, and no end of line follows"
            ),
            "the file is probably truncated: get it again, or set `lenient = true` to use what is there before it",
        ))
    }
}
