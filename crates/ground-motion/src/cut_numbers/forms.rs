//! Forms of the values of a series: one in another form than the large majority, which comes from that
//! of the others by a loss of characters, is damaged. Zeros count for nothing, as many writers print
//! them shorter.

use super::tally::{Kind, Place, Tally};
use crate::error::GroundMotionError;
use crate::fortran::Layout;
use crate::number;
use crate::source::Source;

/// Values among which one in another form is damaged.
const MANY: usize = 20;
/// Values among which one with fewer decimals is damaged: of those that leave out zeros at the end a
/// tenth has fewer.
const MANY_DECIMALS: usize = 200;
/// Values with a decimal point among which one without it is damaged.
const MANY_POINTS: usize = 50;
/// Values without a point that have lost it all the same where a layout gives them a size of their own or other decimals
/// than are printed: so many, and one in so many.
const SOME_LOST: usize = 20;
const SOME_OF: usize = 50;
/// Values whose exponents have a zero before their digit, which show that all have as many digits, and
/// values that end in a zero, which show that none is left out.
const LIKE_IT: usize = 2;
/// Magnitude by way of which values reach exponents of three digits.
const NEARLY_TINY: f64 = 1.0e-60;
/// Times the largest of the others from which on a value is of another size.
const OF_ANOTHER_SIZE: f64 = 10.0;
/// Times the largest of the others from which on a value is no part of any motion with them.
const OF_NO_MOTION: f64 = 1.0e6;
/// Times the largest of the others, and the largest step between them, from which on a whole number does
/// not follow its neighbours where a writer leaves out zeros at the end.
const FAR: f64 = 2.0;

/// One in so many values is a whole number where all values are printed with one decimal; more are of a writer of whole
/// numbers.
const OF_WHOLES: usize = 4;
/// Decimals more than those of the other values that a damage gives; a number that is printed in full has more of them,
/// `0.30000000000000004`, `0.012340001`: round-off.
const FEW_DECIMALS: usize = 3;

/// Magnitude below which `G` formats of Fortran print exponents, and below which `%g` does.
const BELOW_G: f64 = 0.1;
const BELOW_PERCENT_G: f64 = 1.0e-4;
/// Magnitude from which on some writers print exponents.
const LARGE: f64 = 1.0e5;
/// Magnitudes from which on and below which list-directed output of Fortran prints no exponents.
const BELOW_LIST: f64 = 0.1;
const ABOVE_LIST: f64 = 1.0e7;

const REMEDY: &str = "the file is damaged: correct the value, or get the record again";

/// An exponent as it is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Exponent {
    /// Fortran leaves the letter out before three digits.
    has_letter: bool,
    sign: Option<u8>,
    digits: usize,
    /// Whether a zero stands before another digit, `E-02`.
    is_padded: bool,
    /// Whether it is `E0`, which people write for the exponent that a whole number lacks.
    is_bare_zero: bool,
}

/// What stands in a field that is a number.
struct Parts<'f> {
    mantissa: &'f [u8],
    /// Digits behind the decimal point; `None` without a point.
    decimals: Option<usize>,
    exponent: Option<Exponent>,
}

impl<'f> Parts<'f> {
    fn of(field: &'f [u8]) -> Self {
        let is_start =
            |i: &usize| b"eEdD".contains(&field[*i]) || *i > 0 && matches!(field[*i], b'+' | b'-');
        let end = (0..field.len()).find(is_start).unwrap_or(field.len());
        let (mantissa, exponent) = field.split_at(end);
        let point = mantissa.iter().position(|b| *b == b'.');
        Self {
            mantissa,
            decimals: point.map(|point| mantissa.len() - point - 1),
            exponent: Exponent::of(exponent),
        }
    }

    /// Digits of the mantissa but zeros before the first other one.
    fn significant_digits(&self) -> usize {
        let digits = self.mantissa.iter().filter(|b| b.is_ascii_digit());
        digits.skip_while(|b| **b == b'0').count()
    }

    /// The first digit of the mantissa.
    fn first_digit(&self) -> Option<u8> {
        self.mantissa.iter().copied().find(|b| !b"+-".contains(b))
    }
}

impl Exponent {
    fn of(text: &[u8]) -> Option<Self> {
        let first = text.first()?;
        let has_letter = first.is_ascii_alphabetic();
        let rest = &text[usize::from(has_letter)..];
        let sign = rest.first().copied().filter(|b| b"+-".contains(b));
        let digits = &rest[usize::from(sign.is_some())..];
        Some(Self {
            has_letter,
            sign,
            digits: digits.len(),
            is_padded: digits.len() > 1 && digits[0] == b'0',
            is_bare_zero: rest == b"0",
        })
    }
}

/// Values in a form of their own, and the first of them.
#[derive(Debug, Default)]
struct Odd {
    count: usize,
    first: Option<Place>,
}

impl Odd {
    fn see(&mut self, place: Place) {
        self.count += 1;
        self.first.get_or_insert(place);
    }

    /// The first of them, if they are few of so many.
    fn of(&self, all: usize) -> Option<&Place> {
        self.first.as_ref().filter(|_| are_few(self.count, all))
    }
}

/// Forms of all values of a series but zeros, as far as they show one that was damaged among them.
#[derive(Debug, Default)]
pub(crate) struct Forms {
    /// Values by their exponent, and by the decimals of those with one and of those without.
    exponents: Tally<Option<Exponent>>,
    with: Tally<Option<usize>>,
    without: Tally<Option<usize>>,
    /// Whether values of all sizes are printed with an exponent: where a first digit other than
    /// zero stands before the point, or an exponent is zero. `G` formats print values about 1
    /// without one.
    is_always: bool,
    /// Whether one has an exponent that is as large as values of a tenth and more, or of a
    /// ten-thousandth.
    of_tenths: bool,
    of_ten_thousandths: bool,
    /// Whether a zero ends the decimals before an exponent: `%g` leaves those out.
    ends_in_zero: bool,
    /// Largest value whose exponent has a sign.
    largest_signed: f64,
    wholes: Wholes,
    /// Numbers without a point that a zero leads, `0454`, and the first of them.
    led_by_zero: Odd,
    /// Whether numbers without an exponent begin with the point, `.0454`.
    begin_with_point: bool,
    whole_parts: WholeParts,
    /// Mantissas without a point of more than one digit, `79E-03`.
    long_wholes: Odd,
    /// The decimals that the layout gives to numbers without a point.
    implied_decimals: i32,
    /// Columns that the layout has for a number; none where it is no layout.
    columns: Option<usize>,
    /// Smallest value whose exponent has up to two digits.
    least: Option<f64>,
    list: ListDirected,
}

/// What shows that values come from list-directed output of Fortran, of which some compilers print exponents of small
/// and very large values alone, with as many digits of all: `-1.2345678E-02`, `0.1007569`, `1.007569`.
#[derive(Debug, Default)]
struct ListDirected {
    /// Values without an exponent, by their digits before and behind the point; a zero before it is none.
    bare: Tally<(usize, Option<usize>)>,
    /// Whether one of them is of a size that is printed with an exponent.
    is_bare_of_other_size: bool,
    /// Whether a value that has an exponent is of a size that is printed without one, or its mantissa begins with
    /// a zero or the point.
    is_other_with_exponent: bool,
}

impl ListDirected {
    fn see(&mut self, place: Place, parts: &Parts<'_>) {
        let is_of_size = (BELOW_LIST..ABOVE_LIST).contains(&place.value.abs());
        let leads = parts.first_digit();
        if parts.exponent.is_some() {
            let is_led = leads.is_some_and(|b| (b'1'..=b'9').contains(&b));
            self.is_other_with_exponent |= is_of_size || !is_led;
            return;
        }
        self.is_bare_of_other_size |= !is_of_size;
        let digits = parts.mantissa.iter().filter(|b| b.is_ascii_digit()).count();
        let before = digits - parts.decimals.unwrap_or(0);
        let before = match leads {
            Some(b'0') => before.saturating_sub(1),
            _ => before,
        };
        self.bare.see((before, parts.decimals), place);
    }

    /// Whether all values are such, where mantissas have so many decimals. Those from a tenth to 1 begin with a zero, so
    /// that none is a mantissa that lost its exponent; a motion gets to larger ones by way of them.
    fn is_met(&self, decimals: usize) -> bool {
        let is_of_list = |kind: &Kind<(usize, Option<usize>)>| {
            let (before, behind) = kind.key;
            behind.is_some_and(|behind| before + behind == decimals)
        };
        !self.is_bare_of_other_size
            && !self.is_other_with_exponent
            && self.bare.kinds().all(is_of_list)
            && self.bare.kinds().any(|kind| kind.key.0 == 0)
    }
}

/// What stands before the points of values.
#[derive(Debug, Default)]
struct WholeParts {
    /// Values with one digit there, and those with a zero and another one, `01.43`.
    of_one_digit: usize,
    led_by_zero: Odd,
    /// Values below 1 without a sign or with plus, and those with minus: with the zero there, `-0.43`, and without it.
    with_zero: [usize; 2],
    without: [Odd; 2],
}

impl WholeParts {
    fn see(&mut self, place: Place, parts: &Parts<'_>) {
        if parts.decimals.is_none() {
            return;
        }
        let sign = usize::from(parts.mantissa.starts_with(b"-"));
        let digits = parts.mantissa.trim_ascii();
        let digits = digits
            .strip_prefix(b"-")
            .or(digits.strip_prefix(b"+"))
            .unwrap_or(digits);
        match digits {
            [b'.', ..] if parts.exponent.is_none() => self.without[sign].see(place),
            [b'0', b'0'..=b'9', ..] => self.led_by_zero.see(place),
            [first, b'.', ..] => {
                self.of_one_digit += 1;
                self.with_zero[sign] += usize::from(*first == b'0' && parts.exponent.is_none());
            }
            _ => {}
        }
    }

    /// The first value with a zero before its digits, of many that have none.
    fn is_led(&self) -> Option<&Place> {
        let odd = self.led_by_zero.of(self.of_one_digit);
        odd.filter(|_| self.of_one_digit > MANY)
    }

    /// The first value below 1 that lacks the zero before its point, which many of its sign have.
    fn lacks_zero(&self) -> Option<&Place> {
        let values = self.without.iter().zip(self.with_zero);
        let mut odd = values.filter(|(_, others)| *others > MANY);
        odd.find_map(|(without, others)| without.of(others))
    }
}

/// Whole numbers without a point, as `%d` of MATLAB writes them where a value is whole, and how far they
/// are from their neighbours.
#[derive(Debug, Default)]
struct Wholes {
    count: usize,
    /// Characters of the shortest one.
    shortest: Option<usize>,
    before: Option<(f64, bool)>,
    /// Sizes of the two largest.
    largest: [f64; 2],
    /// Largest difference between neighbours, of which one is such a number, and of which none is.
    far: f64,
    usual: f64,
}

impl Wholes {
    fn see(&mut self, value: f64, is_whole: bool, width: usize) {
        self.count += usize::from(is_whole);
        if is_whole {
            self.shortest = Some(self.shortest.map_or(width, |least| least.min(width)));
            let [first, second] = self.largest;
            let size = value.abs();
            self.largest = [first.max(size), second.max(size.min(first))];
        }
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

/// What to do about a value without an exponent that may be right in another form.
fn or_as_others(at: &Place, decimals: usize) -> String {
    format!(
        "{REMEDY}; if it is right, write it as the others, {:.decimals$}",
        at.value
    )
}

/// Whether so many of some values are no more than damaged ones.
fn are_few(odd: usize, all: usize) -> bool {
    odd <= all / 1000 + 1
}

/// Whether a zero stands before the digits of a whole part, `01.43`, as no writer prints it.
fn is_led_by_zero(field: &[u8]) -> bool {
    let digits = field.strip_prefix(b"-").or(field.strip_prefix(b"+"));
    matches!(digits.unwrap_or(field), [b'0', b'0'..=b'9', ..])
}

/// Whether zeros at the end are printed, of which a tenth of the values has one.
fn keeps_zeros(usual: &Kind<Option<usize>>) -> bool {
    usual.end_in_zero >= LIKE_IT
}

/// The first value with fewer decimals than nearly all others, of so many that no writer leaves out zeros,
/// and the decimals of the others.
fn lacks_decimals<'t>(
    tally: &'t Tally<Option<usize>>,
    have_exponents: bool,
) -> Option<(&'t Place, usize)> {
    let most = tally.usual()?;
    let usual = most.key?;
    let fewer = |decimals: Option<usize>| decimals.is_some_and(|decimals| decimals < usual);
    let odd = tally.number(fewer);
    let others = tally.count - most.count - odd;
    let few = |number| are_few(number, tally.count);
    if tally.count <= MANY_DECIMALS || !few(odd) || !few(others) {
        return None;
    }
    // Values of less than ten units of the last decimal, as of quiet ground, have no zeros to leave out.
    let with_zeros = most.of_two_digits + odd;
    let shows = with_zeros >= MANY_DECIMALS && are_few(odd, with_zeros);
    if !keeps_zeros(most) && !shows {
        return None;
    }
    // Where digits or characters are as many in all, a value with a digit more before the point has one
    // less behind it. With an exponent it has not, and a point that moved changes the value as much.
    let lost = |kind: &'t Kind<Option<usize>>| {
        let is_large = kind.largest.value.abs() > FAR * most.largest.value.abs();
        let is_short = kind.shortest.digits < most.most_digits;
        match is_short || is_led_by_zero(kind.shortest.field()) {
            _ if have_exponents => Some(&kind.first),
            true => Some(&kind.shortest),
            false => is_large.then_some(&kind.largest),
        }
    };
    let mut odd = tally.kinds().filter(|kind| fewer(kind.key));
    Some((odd.find_map(lost)?, usual))
}

/// Whether the mantissa of a field ends in so many zeros.
fn ends_in_zeros(field: &[u8], number: usize) -> bool {
    let digits = Parts::of(field).mantissa.iter().rev();
    digits.take_while(|b| **b == b'0').count() >= number
}

/// The first value with more decimals than nearly all others, of so many that all are printed with as many, and the
/// decimals of the others: a digit came in, or the point moved.
fn has_surplus_decimals(
    tally: &Tally<Option<usize>>,
    have_exponents: bool,
) -> Option<(&Place, usize)> {
    let most = tally.usual()?;
    let usual = most.key.filter(|usual| *usual > 0)?;
    let surplus = |decimals: Option<usize>| decimals.map_or(0, |n| n.saturating_sub(usual));
    let odd = tally.number(|decimals| surplus(decimals) > 0);
    let others = tally.count - most.count - odd;
    let few = |number| are_few(number, tally.count);
    if tally.count <= MANY_DECIMALS || !few(odd) || !few(others) {
        return None;
    }
    // As where decimals are lacking: values of which a tenth would have lost a zero at the end have all.
    if !keeps_zeros(most) && most.of_two_digits < MANY_DECIMALS {
        return None;
    }
    // Writers of the fewest digits print whole numbers with one zero.
    if usual == 1 && OF_WHOLES * most.end_in_zero > most.count {
        return None;
    }
    // Where digits or characters are as many in all, a value with a digit less before the point has one more behind
    // it. A mantissa has one digit before it, or none, but in engineering notation.
    let is_scientific = have_exponents && most.most_digits <= usual + 1;
    let is_other = |at: &&Place| {
        let is_of_digits = at.digits <= most.shortest.digits && !is_scientific;
        let is_of_width =
            most.widths.0 == most.widths.1 && at.width() <= most.widths.1 && !is_scientific;
        let surplus = surplus(Parts::of(at.field()).decimals);
        let is_round_off = surplus > FEW_DECIMALS;
        // A zero that follows the last digit changes nothing; behind a point that moved it is one of the others' digits.
        let is_of_size = at.value.abs() <= FAR * most.largest.value.abs();
        let has_more = !have_exponents || at.digits > most.most_digits;
        let is_same = ends_in_zeros(at.field(), surplus) && is_of_size && has_more;
        !is_of_digits && !is_of_width && !is_round_off && !is_same
    };
    let odd = tally.kinds().filter(|kind| surplus(kind.key) > 0);
    let mut values = odd.flat_map(|kind| [&kind.first, &kind.largest]);
    Some((values.find(is_other)?, usual))
}

impl Forms {
    /// Of numbers that are printed in a layout.
    pub(crate) fn of(layout: Layout) -> Self {
        Self {
            is_always: layout.exponents,
            implied_decimals: layout.implied_decimals(),
            columns: Some(layout.width),
            ..Self::default()
        }
    }

    /// Takes one more value of a line into account, which starts at a column (from 0).
    pub(crate) fn see(&mut self, line: usize, column: usize, field: &[u8]) {
        let field = field.trim_ascii();
        let Ok(value) = number::parse(field) else {
            return;
        };
        let parts = Parts::of(field);
        let is_whole = parts.exponent.is_none() && parts.decimals.is_none() && value != 0.0;
        self.wholes.see(value, is_whole, field.len());
        if value == 0.0 {
            return;
        }
        let digits = parts.significant_digits();
        let ends_in_zero = parts.mantissa.ends_with(b"0");
        let place = Place::new(line, column, value, digits, ends_in_zero, field);
        self.exponents.see(parts.exponent, place);
        self.list.see(place, &parts);
        self.whole_parts.see(place, &parts);
        let Some(exponent) = parts.exponent else {
            self.without.see(parts.decimals, place);
            self.begin_with_point |= parts.first_digit() == Some(b'.');
            if is_whole && parts.first_digit() == Some(b'0') {
                self.led_by_zero.see(place);
            }
            return;
        };
        self.with.see(parts.decimals, place);
        if parts.decimals.is_none() && digits > 1 {
            self.long_wholes.see(place);
        }
        let size = value.abs();
        self.of_tenths |= (BELOW_G..LARGE).contains(&size);
        self.of_ten_thousandths |= (BELOW_PERCENT_G..LARGE).contains(&size);
        self.ends_in_zero |= parts.decimals.is_some_and(|n| n > 0) && ends_in_zero;
        let is_of_one = exponent.digits > 1 && field.ends_with(b"00");
        let leads = parts.first_digit();
        self.is_always |= is_of_one || leads.is_some_and(|b| (b'1'..=b'9').contains(&b));
        if exponent.digits <= 2 {
            self.least = Some(self.least.map_or(size, |least| least.min(size)));
        }
        if exponent.sign.is_some() {
            self.largest_signed = self.largest_signed.max(size);
        }
    }

    /// The first value that lacks a digit or the sign of its exponent, which all but a few values have.
    fn lacks_digits_of_exponent(&self) -> Option<&Place> {
        let usual = self.exponents.usual()?.key?;
        let is_such = |e: Option<Exponent>, such: fn(Exponent, Exponent) -> bool| {
            e.is_some_and(|e| e.has_letter && such(e, usual))
        };
        let padded = |e| is_such(e, |e, usual| e.digits == usual.digits && e.is_padded);
        let plus = |e| is_such(e, |e, _| e.sign == Some(b'+'));
        let short = |e| is_such(e, |e, usual| e.digits < usual.digits && !e.is_bare_zero);
        let unsigned = |e| {
            is_such(e, |e, usual| {
                e.digits == usual.digits && e.sign.is_none() && usual.sign.is_some()
            })
        };
        let all = self.with.count;
        let odd = self.exponents.number(short) + self.exponents.number(unsigned);
        if all <= MANY || odd > all / 100 + 1 {
            return None;
        }
        if self.exponents.number(padded) < LIKE_IT {
            // Exponents may be as short as they can be: then one value alone has no place in the motion.
            let like = |e: Option<Exponent>| e.is_some_and(|e| e.digits == usual.digits);
            let is_odd = |e| short(e) || unsigned(e);
            let alike = self.exponents.number(|e| like(e) && !is_odd(e));
            let mut others = self.exponents.kinds().filter(|kind| !is_odd(kind.key));
            let lost = self.exponents.first(is_odd)?;
            let is_large =
                others.all(|kind| lost.value.abs() > OF_NO_MOTION * kind.largest.value.abs());
            return Some(lost).filter(|_| odd == 1 && alike + 1 == all && is_large);
        }
        // Some programs print no plus.
        let is_lost = |at: &&Place| {
            self.exponents.number(plus) > 0
                || at.value.abs() > OF_ANOTHER_SIZE * self.largest_signed
        };
        let unsigned = self.exponents.first(unsigned).filter(is_lost);
        self.exponents.first(short).or(unsigned)
    }

    /// The first value with a digit more in its exponent than all but a few of the values.
    fn has_surplus_digit_of_exponent(&self) -> Option<&Place> {
        let usual = self.exponents.usual()?.key?;
        let all = self.with.count;
        let padded = |e: Option<Exponent>| {
            e.is_some_and(|e| e.has_letter && e.digits == usual.digits && e.is_padded)
        };
        let long = |e: Option<Exponent>| {
            e.is_some_and(|e| e.has_letter && e.digits > usual.digits && e.digits > 2)
        };
        let number = self.exponents.number(long);
        if all <= MANY || number > all / 100 + 1 || self.exponents.number(padded) < LIKE_IT {
            return None;
        }
        // Three digits are right below 1e-99, which a record reaches by way of other small values.
        let no_zero = |e| long(e) && e.is_some_and(|e| !e.is_padded);
        let is_alone = self.exponents.number(no_zero) == 1 && self.least > Some(NEARLY_TINY);
        let is_surplus =
            |e: Option<Exponent>| long(e) && (is_alone || e.is_some_and(|e| e.is_padded));
        self.exponents.first(is_surplus)
    }

    /// The first value that lost the point of its mantissa, which all but a few of those with exponents have.
    fn lacks_point_of_mantissa(&self) -> Option<&Place> {
        let usual = self.with.usual()?.key.filter(|usual| *usual > 0)?;
        let all = self.with.count;
        if all <= MANY {
            return None;
        }
        // A layout gives decimals to those without a point, which is right where many have none.
        if self.implied_decimals != 0 {
            return self.long_wholes.of(all);
        }
        // Writers that leave out zeros, and with them the point, have one digit before it.
        if let Some(first) = self.long_wholes.of(all) {
            return Some(first);
        }
        let is_whole = |decimals: Option<usize>| decimals.is_none();
        let wholes = self.with.number(is_whole);
        let alike = self.with.number(|decimals| decimals == Some(usual));
        let few = are_few(wholes, all) && are_few(all - wholes - alike, all);
        let first = self.with.first(is_whole);
        first.filter(|_| few && all > MANY_DECIMALS)
    }

    /// Whether some values have an exponent, and others none, as list-directed output prints them.
    fn is_list_directed(&self) -> bool {
        let usual = self.with.usual().and_then(|kind| kind.key);
        usual.is_some_and(|decimals| self.list.is_met(decimals))
    }

    /// The first value that lost its exponent among many others, which no writer leaves out there.
    fn lacks_exponent(&self) -> Option<&Place> {
        let (with, without) = (self.with.count, self.without.count);
        let few = with + without > MANY && without <= with / 100 + 1;
        let usual = self.with.usual()?;
        if self.is_list_directed() {
            return None;
        }
        // Values from a tenth to 1 with a decimal more than the mantissas, and as many digits: no mantissa of
        // these lost its exponent, and list-directed output of Fortran prints such values so.
        let most_digits = self.with.kinds().map(|kind| kind.most_digits).max();
        let is_of_list = |kind: &&Kind<Option<usize>>| {
            kind.key > usual.key
                && kind.key == Some(kind.shortest.digits)
                && Some(kind.shortest.digits) >= most_digits
                && kind.largest.value.abs() < 1.0
        };
        let mut others = self.without.kinds().filter(|kind| !is_of_list(kind));
        let bare = others.next().map(|kind| &kind.first).filter(|_| few)?;
        let is_constant = are_few(with - usual.count, with);
        // Of a writer that has whole numbers without a point; one that was cut off is far from its neighbours.
        let all_whole = self.wholes.count >= without && is_constant;
        if all_whole && self.wholes.follow() {
            return None;
        }
        // As many digits as with an exponent: printed by a `G` format.
        let parts = Parts::of(bare.field());
        let digits = parts.significant_digits();
        let of_g = bare.value.abs() >= BELOW_G && digits == usual.key.unwrap_or(0);
        let alike = usual.key.is_some() && parts.decimals == usual.key;
        let always = self.of_tenths
            || self.of_ten_thousandths && !of_g
            || is_constant && self.ends_in_zero && !of_g
            || is_constant && self.is_always && alike;
        always.then_some(bare)
    }

    /// Whether all but a few of the values with a point and without an exponent have as many decimals.
    fn has_constant_decimals(&self) -> bool {
        let usual = self.without.usual().map_or(0, |kind| kind.count);
        let pointed = self.without.number(|decimals| decimals.is_some());
        are_few(pointed.saturating_sub(usual), pointed)
    }

    /// The first value that lost its decimal point among many others without exponents, and the decimals of those.
    /// Writers that leave out zeros at the end print whole numbers without one, which are about as large as others.
    fn lacks_point(&self) -> Option<(&Place, usize)> {
        let is_pointed = |decimals: Option<usize>| decimals.is_some();
        let most = self.without.usual()?;
        let usual = most.key.filter(|usual| *usual > 0)?;
        let pointed = self.without.number(is_pointed);
        if pointed < MANY_POINTS {
            return None;
        }
        if let Some(first) = self.led_by_zero.of(pointed) {
            return Some((first, usual));
        }
        let wholes = self.without.kinds().find(|kind| !is_pointed(kind.key))?;
        // A layout would read it as many times smaller than it stands there, which is right where many have no point.
        if self.implied_decimals != 0 {
            if are_few(wholes.count, pointed) {
                return Some((&wholes.first, usual));
            }
            // More of them are right where all the digits are as they were printed.
            let others = self.without.kinds().filter(|kind| is_pointed(kind.key));
            let largest = others.fold(0.0_f64, |most, kind| most.max(kind.largest.value.abs()));
            let read = wholes.largest.value.abs() / 10.0_f64.powi(self.implied_decimals);
            let is_other =
                usize::try_from(self.implied_decimals) != Ok(usual) || read > FAR * largest;
            let are_some = wholes.count <= SOME_LOST.min(pointed / SOME_OF);
            return (is_other && are_some).then_some((&wholes.largest, usual));
        }
        if usual == 1 && self.has_no_room() {
            let is_far = self.wholes.far > FAR * self.wholes.usual;
            return is_far.then_some((&wholes.largest, usual));
        }
        let has_zeros = keeps_zeros(most);
        let is_fixed = has_zeros && self.has_constant_decimals() && are_few(wholes.count, pointed);
        if is_fixed && (pointed > MANY_DECIMALS || !self.wholes.follow()) {
            return Some((&wholes.first, usual));
        }
        let others = || self.without.kinds().filter(|kind| is_pointed(kind.key));
        let largest = others().fold(0.0_f64, |most, kind| most.max(kind.largest.value.abs()));
        let most_digits = others().map(|kind| kind.most_digits).max().unwrap_or(0);
        let at = &wholes.largest;
        let size = at.value.abs();
        let is_far = wholes.count <= pointed / 100 + 1
            && size > FAR * largest
            && self.wholes.far > FAR * self.wholes.usual;
        // A number as long as the others have digits is what `%.5g` prints of large values, next to which there
        // are other large ones, with one decimal or without.
        let is_alone = self.wholes.largest[1] <= FAR * largest;
        let is_of_size = at.digits < most_digits || is_alone && size > OF_ANOTHER_SIZE * largest;
        (is_far && is_of_size && self.may_have_had_point(at, has_zeros, largest))
            .then_some((at, usual))
    }

    /// Whether no whole number has room for its point and a decimal with a blank before it: GeoNet prints `-11026` in eight
    /// columns among numbers such as `-9865.4`.
    fn has_no_room(&self) -> bool {
        let shortest = self.wholes.shortest.zip(self.columns);
        shortest.is_some_and(|(shortest, columns)| 1 + shortest + 2 > columns)
    }

    /// Whether a whole number may be one of the others without its point, by its digits: with the point behind the
    /// first one, or before it, it is about as large as they are, and it ends in no zero where none is printed.
    fn may_have_had_point(&self, at: &Place, has_zeros: bool, largest: f64) -> bool {
        let behind = at
            .digits
            .saturating_sub(usize::from(!self.begin_with_point));
        let least = at.value.abs() / 10.0_f64.powi(behind as i32);
        behind > 0 && (has_zeros || !at.ends_in_zero) && least <= FAR * largest
    }

    /// The first value with an exponent among many others without one that no writer prints with it, and the decimals
    /// of the others: the formats that print exponents of some values do so of very small and very large ones.
    fn has_stray_exponent(&self) -> Option<(&Place, usize)> {
        let all = self.without.count;
        if all < MANY_POINTS || !are_few(self.with.count, all) || self.is_list_directed() {
            return None;
        }
        let others = self.without.kinds();
        let largest = others.fold(0.0_f64, |most, kind| most.max(kind.largest.value.abs()));
        let decimals = self.without.usual()?.key;
        let is_fixed = decimals.is_some() && all > MANY_DECIMALS && self.has_constant_decimals();
        let is_stray = |at: &&Place| {
            let size = at.value.abs();
            let has_none = decimals.is_some() && (BELOW_G..LARGE).contains(&size);
            is_fixed || has_none || size >= OF_ANOTHER_SIZE * largest
        };
        let values = self
            .with
            .kinds()
            .flat_map(|kind| [&kind.first, &kind.largest]);
        Some((values.into_iter().find(is_stray)?, decimals.unwrap_or(0)))
    }

    /// Refuses a value that alone lacks the exponent, or a digit of it, of the many others.
    ///
    /// # Errors
    /// At that value.
    pub(crate) fn are_whole(&self, source: &Source<'_>) -> Result<(), GroundMotionError> {
        let refused = |at: &Place, message: String, remedy: &str| {
            Err(source.error(at.line, at.column, message, remedy))
        };
        if let Some(at) = self.lacks_digits_of_exponent() {
            let message = format!(
                "\"{}\" lacks a digit or the sign of its exponent, which the other values have",
                at.shown()
            );
            return refused(at, message, REMEDY);
        }
        if let Some(at) = self.has_surplus_digit_of_exponent() {
            let message = format!(
                "\"{}\" has a digit more in its exponent than the other values",
                at.shown()
            );
            return refused(at, message, REMEDY);
        }
        if let Some(at) = self.lacks_point_of_mantissa() {
            let message = format!(
                "\"{}\" has no decimal point, which the other values have",
                at.shown()
            );
            return refused(at, message, REMEDY);
        }
        if let Some(at) = self.lacks_exponent() {
            let usual = self.with.usual().and_then(|kind| kind.key);
            let decimals = usual.unwrap_or(0);
            let remedy = match at.field().contains(&b'.') {
                true => REMEDY.to_owned(),
                false => format!(
                    "some programs write whole numbers so: if it is one, write it as the others, {:.decimals$e}; if it is no value, pass it over by `skip_lines`; else the file is damaged: correct the value, or get the record again",
                    at.value
                ),
            };
            let message = format!(
                "\"{}\" has no exponent, which the other values have",
                at.shown()
            );
            return refused(at, message, &remedy);
        }
        if let Some((at, decimals)) = self.lacks_point() {
            let message = format!(
                "\"{}\" has no decimal point, which the other values have",
                at.shown()
            );
            let remedy = match self.implied_decimals != 0 {
                true => format!(
                    "{REMEDY}; if its decimals are those of the format, write it with its point, as the others"
                ),
                false => or_as_others(at, decimals),
            };
            return refused(at, message, &remedy);
        }
        if let Some((at, decimals)) = self.has_stray_exponent() {
            let message = format!(
                "\"{}\" has an exponent, which the other values do not have",
                at.shown()
            );
            return refused(at, message, &or_as_others(at, decimals));
        }
        for (tally, have_exponents) in [(&self.with, true), (&self.without, false)] {
            if let Some((at, usual)) = lacks_decimals(tally, have_exponents) {
                let message = format!(
                    "\"{}\" lacks a digit: the other values have {usual} decimals",
                    at.shown()
                );
                let remedy = match at.field().iter().any(u8::is_ascii_alphabetic) {
                    true => REMEDY.to_owned(),
                    false => or_as_others(at, usual),
                };
                return refused(at, message, &remedy);
            }
            if let Some((at, usual)) = has_surplus_decimals(tally, have_exponents) {
                let decimals = Parts::of(at.field()).decimals.unwrap_or(0);
                let has = match decimals {
                    1 => "1 decimal".to_owned(),
                    _ => format!("{decimals} decimals"),
                };
                let message = format!(
                    "\"{}\" has {has}, but the other values have {usual}: a digit came in, or the point moved",
                    at.shown()
                );
                let remedy = match have_exponents {
                    true => REMEDY.to_owned(),
                    false => or_as_others(at, usual),
                };
                return refused(at, message, &remedy);
            }
        }
        if let Some(at) = self.whole_parts.is_led() {
            let message = format!(
                "\"{}\" has a zero before its digits, which the other values do not have",
                at.shown()
            );
            return refused(at, message, REMEDY);
        }
        if let Some(at) = self.whole_parts.lacks_zero() {
            let message = format!(
                "\"{}\" has no digit before its point, which the other values have",
                at.shown()
            );
            return refused(at, message, REMEDY);
        }
        Ok(())
    }
}
