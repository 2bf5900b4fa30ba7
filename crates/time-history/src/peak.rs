//! A maximum absolute value and when it happened.

/// A maximum absolute value and when it happened. One that is not known (NaN) equals another such.
#[derive(Debug, Clone, Copy, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Peak {
    /// Maximum absolute value, in the unit of the quantity.
    #[cfg_attr(feature = "serde", serde(rename = "peak"))]
    pub value: f64,
    /// Time (s); zero if the quantity never left zero.
    pub time: f64,
}

/// Whether two numbers are equal, or both none: what there is not in two equal runs is equal.
pub(crate) fn same(a: f64, b: f64) -> bool {
    a == b || (a.is_nan() && b.is_nan())
}

impl PartialEq for Peak {
    fn eq(&self, other: &Self) -> bool {
        same(self.value, other.value) && same(self.time, other.time)
    }
}

impl Peak {
    pub(crate) fn raise(&mut self, value: f64, time: f64) {
        if value > self.value {
            *self = Self { value, time };
        }
    }
}
