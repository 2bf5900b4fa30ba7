//! Time as a function of the variable that a step is taken in.
//!
//! Where a force starts like a power of the penetration, `t^(1/4)` at worst, it is a
//! smooth function of `s` with `t = s^4`; where it ends like `(T - t)^(3/2)` or
//! `(T - t)^(1/2)`, of `s` with `t = T - s^2`.

/// How time runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Pace {
    /// Evenly.
    Plain,
    /// Like the fourth power, from a closure on.
    Start,
    /// Like a square towards an end, this long (s) after the start of the step.
    End(f64),
}

/// A step in the variable `s`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clock {
    pace: Pace,
    from: f64,
    to: f64,
}

impl Clock {
    /// A step of `length` (s); `since` is the time since closure at its start (s).
    pub(crate) fn new(pace: Pace, since: f64, length: f64) -> Self {
        let (from, to) = match pace {
            Pace::Plain => (0.0, length),
            Pace::Start => (fourth_root(since), fourth_root(since + length)),
            Pace::End(left) => (left.sqrt(), (left - length).max(0.0).sqrt()),
        };
        Self { pace, from, to }
    }

    /// The same step ended at another time (s) from its start.
    pub(crate) fn until(self, offset: f64) -> Self {
        let square = self.from * self.from;
        let to = match self.pace {
            Pace::Plain => offset,
            Pace::Start => fourth_root(square * square + offset),
            Pace::End(_) => (square - offset).max(0.0).sqrt(),
        };
        Self { to, ..self }
    }

    /// Length in `s`, negative towards an end.
    pub(crate) fn span(&self) -> f64 {
        self.to - self.from
    }

    /// Time from the start of the step (s) at `theta`.
    pub(crate) fn offset(&self, theta: f64) -> f64 {
        let s = self.from + theta * self.span();
        match self.pace {
            Pace::Plain => s,
            Pace::Start => {
                // s^4 - from^4 without cancellation.
                let (x, sum) = (theta * self.span(), s + self.from);
                x * sum * (s * s + self.from * self.from)
            }
            Pace::End(_) => (self.from - s) * (self.from + s),
        }
    }

    /// The `theta` of a time (s) from the start of the step.
    pub(crate) fn place_of(&self, offset: f64) -> f64 {
        let span = self.span();
        if span == 0.0 {
            return 0.0;
        }
        ((self.until(offset).to - self.from) / span).clamp(0.0, 1.0)
    }

    /// Derivative of time with respect to `s` at `theta`.
    pub(crate) fn rate(&self, theta: f64) -> f64 {
        let s = self.from + theta * self.span();
        match self.pace {
            Pace::Plain => 1.0,
            Pace::Start => 4.0 * s * s * s,
            Pace::End(_) => -2.0 * s,
        }
    }

    /// Three derivatives of time with respect to theta at one end of the step.
    pub(crate) fn derivatives(&self, end: bool) -> [f64; 3] {
        let (s, d) = (if end { self.to } else { self.from }, self.span());
        match self.pace {
            Pace::Plain => [d, 0.0, 0.0],
            Pace::Start => [
                4.0 * s * s * s * d,
                12.0 * s * s * d * d,
                24.0 * s * d * d * d,
            ],
            Pace::End(_) => [-2.0 * s * d, -2.0 * d * d, 0.0],
        }
    }
}

fn fourth_root(x: f64) -> f64 {
    x.max(0.0).sqrt().sqrt()
}
