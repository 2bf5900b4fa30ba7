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
    field: [u8; KEPT],
    length: usize,
}

impl Place {
    pub(super) fn new(line: usize, column: usize, value: f64, bytes: &[u8]) -> Self {
        let mut field = [0; KEPT];
        let length = bytes.len().min(KEPT);
        field[..length].copy_from_slice(&bytes[..length]);
        Self {
            line,
            column,
            value,
            field,
            length,
        }
    }

    pub(super) fn field(&self) -> &[u8] {
        &self.field[..self.length]
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
        if let Some(kind) = self.kinds.iter_mut().find(|kind| kind.key == key) {
            kind.count += 1;
            if place.value.abs() > kind.largest.value.abs() {
                kind.largest = place;
            }
        } else if self.kinds.len() < KINDS {
            self.kinds.push(Kind {
                key,
                count: 1,
                first: place,
                largest: place,
            });
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
