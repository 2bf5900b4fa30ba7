//! Values of a series by the kind of their form: how many, where the first of each stands, and how large they are.

use crate::number;

/// Most kinds that are told apart: no writer has as many.
const KINDS: usize = 24;
/// Bytes of a field that are kept: no writer prints longer ones.
const KEPT: usize = 32;

/// A value with its place. It keeps no more than a few bytes, as one is held for each kind.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub line: usize,
    /// From 0.
    pub column: usize,
    pub value: f64,
    /// Significant digits of the mantissa.
    pub digits: usize,
    /// Whether a zero ends the mantissa.
    pub ends_in_zero: bool,
    field: [u8; KEPT],
    length: usize,
    whole_width: usize,
}

impl Place {
    pub(super) fn new(
        line: usize,
        column: usize,
        value: f64,
        digits: usize,
        ends_in_zero: bool,
        bytes: &[u8],
    ) -> Self {
        let mut field = [0; KEPT];
        let length = bytes.len().min(KEPT);
        field[..length].copy_from_slice(&bytes[..length]);
        Self {
            line,
            column,
            value,
            digits,
            ends_in_zero,
            field,
            length,
            whole_width: bytes.len(),
        }
    }

    pub(super) fn field(&self) -> &[u8] {
        &self.field[..self.length]
    }

    /// Characters of the whole field.
    pub(super) fn width(&self) -> usize {
        self.whole_width
    }

    pub(super) fn shown(&self) -> String {
        number::shown(self.field())
    }
}

/// Values of one kind.
#[derive(Debug)]
pub(super) struct Kind<K> {
    pub key: K,
    pub count: usize,
    pub first: Place,
    pub largest: Place,
    /// The first one with the fewest significant digits, and how many digits others have at most.
    pub shortest: Place,
    pub most_digits: usize,
    /// Values with two significant digits and more, and values whose mantissa ends in a zero.
    pub of_two_digits: usize,
    pub end_in_zero: usize,
    /// Characters of the shortest and the longest field.
    pub widths: (usize, usize),
}

impl<K> Kind<K> {
    fn of(key: K, place: Place) -> Self {
        Self {
            key,
            count: 0,
            first: place,
            largest: place,
            shortest: place,
            most_digits: 0,
            of_two_digits: 0,
            end_in_zero: 0,
            widths: (place.width(), place.width()),
        }
    }

    fn see(&mut self, place: Place) {
        self.count += 1;
        if place.value.abs() > self.largest.value.abs() {
            self.largest = place;
        }
        if place.digits < self.shortest.digits {
            self.shortest = place;
        }
        self.most_digits = self.most_digits.max(place.digits);
        self.of_two_digits += usize::from(place.digits >= 2);
        self.end_in_zero += usize::from(place.ends_in_zero);
        self.widths = (
            self.widths.0.min(place.width()),
            self.widths.1.max(place.width()),
        );
    }
}

/// Values by their kind.
#[derive(Debug)]
pub(super) struct Tally<K> {
    kinds: Vec<Kind<K>>,
    pub count: usize,
}

impl<K> Default for Tally<K> {
    fn default() -> Self {
        Self {
            kinds: Vec::new(),
            count: 0,
        }
    }
}

impl<K: Copy + PartialEq> Tally<K> {
    pub(super) fn see(&mut self, key: K, place: Place) {
        self.count += 1;
        let known = self.kinds.iter().position(|kind| kind.key == key);
        if known.is_none() && self.kinds.len() < KINDS {
            self.kinds.push(Kind::of(key, place));
        }
        let at = known.unwrap_or(self.kinds.len() - 1);
        if let Some(kind) = self.kinds.get_mut(at).filter(|kind| kind.key == key) {
            kind.see(place);
        }
    }

    /// The kind of most values.
    pub(super) fn usual(&self) -> Option<&Kind<K>> {
        // The first one of those with as many.
        let kinds = self.kinds.iter().rev();
        kinds.max_by_key(|kind| kind.count)
    }

    /// Those of each kind, in the order of their first values.
    pub(super) fn kinds(&self) -> impl Iterator<Item = &Kind<K>> {
        self.kinds.iter()
    }

    /// How many values are of such a kind.
    pub(super) fn number(&self, is_such: impl Fn(K) -> bool) -> usize {
        let such = self.kinds.iter().filter(|kind| is_such(kind.key));
        such.map(|kind| kind.count).sum()
    }

    /// The first value of such a kind.
    pub(super) fn first(&self, is_such: impl Fn(K) -> bool) -> Option<&Place> {
        let first = self.kinds().find(|kind| is_such(kind.key));
        first.map(|kind| &kind.first)
    }
}
