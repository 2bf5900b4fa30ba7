//! A published quantity beside ours, and beside a closed form where there is one.

use pounding_catalogue::numbers::all_digits;

use crate::comparison::{Cell, Comparison, Line, Value, Verdict, nothing, power, text};

/// Agreement of ours with a closed form (-, relative).
const CLOSED_FORM: f64 = 1.0e-9;
/// The same of the time of a maximum, about which it is flat.
const TIME_OF_MAXIMUM: f64 = 1.0e-7;

const COLUMNS: [(&str, &str); 6] = [
    ("quantity", "quantity"),
    ("theirs", "theirs"),
    ("closed_form", "closed form"),
    ("ours", "ours"),
    ("difference", "relative difference"),
    ("tolerance", "tolerance"),
];

/// A table of quantities; the title says what went in.
pub(super) fn comparison(inputs: impl Into<String>, lines: Vec<Line>) -> Comparison {
    Comparison {
        title: inputs.into(),
        columns: COLUMNS.to_vec(),
        lines,
    }
}

/// A published quantity beside ours.
pub(super) struct Quantity<'a> {
    /// What it is, with its unit.
    pub(super) name: &'a str,
    /// As published.
    pub(super) theirs: f64,
    /// The closed form, where there is one.
    pub(super) closed_form: Option<f64>,
    /// As computed.
    pub(super) ours: f64,
    /// Relative difference that is allowed (-).
    pub(super) tolerance: f64,
}

impl Quantity<'_> {
    /// A line that is said to reproduce.
    pub(super) fn reproduced(self) -> Line {
        let verdict = self.verdict();
        self.line(verdict, Verdict::Reproduced)
    }

    /// The same of the time of a maximum.
    pub(super) fn time_of_maximum(self) -> Line {
        let verdict = self.verdict_within(TIME_OF_MAXIMUM);
        self.line(verdict, Verdict::Reproduced)
    }

    /// A line whose published value is said to be off.
    pub(super) fn their_error(self) -> Line {
        let verdict = self.verdict();
        self.line(verdict, Verdict::TheirError)
    }

    fn verdict(&self) -> Verdict {
        self.verdict_within(CLOSED_FORM)
    }

    fn verdict_within(&self, precision: f64) -> Verdict {
        let near = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * b.abs();
        let is_exact = self
            .closed_form
            .map(|exact| near(self.ours, exact, precision));
        let meets = near(self.ours, self.theirs, self.tolerance);
        match (is_exact, meets) {
            (Some(true) | None, true) => Verdict::Reproduced,
            (Some(true), false) => Verdict::TheirError,
            _ => Verdict::NotReproduced,
        }
    }

    fn line(self, verdict: Verdict, claimed: Verdict) -> Line {
        Line {
            cells: vec![
                text(self.name),
                as_printed(self.theirs),
                self.closed_form.map_or_else(nothing, digits),
                digits(self.ours),
                power(self.ours / self.theirs - 1.0, 1),
                power(self.tolerance, 0),
            ],
            verdict,
            claimed,
        }
    }
}

/// A published number with the digits that it has.
pub(super) fn as_printed(value: f64) -> Cell {
    Cell {
        shown: all_digits(value),
        value: Value::Number(value),
    }
}

/// Ten significant digits, without an exponent where that is short.
pub(super) fn digits(value: f64) -> Cell {
    let magnitude = value.abs();
    let shown = if value.fract() == 0.0 && magnitude < 1.0e6 {
        format!("{value:.0}")
    } else if !(1.0e-3..1.0e6).contains(&magnitude) {
        format!("{value:.9e}")
    } else {
        // At most 12 decimals.
        let decimals = (9.0 - magnitude.log10().floor()).clamp(0.0, 12.0);
        format!("{value:.0$}", decimals as usize)
    };
    Cell {
        shown,
        value: Value::Number(value),
    }
}
