//! The envelope of one side, mirrored to the positive side.

use crate::history::Point;

/// The straight stretches of an envelope, in the order in which they are met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stretch {
    /// The hardening line lies still below the residual strength.
    Floor,
    Hardening,
    /// The maximum force that is left (bilinear rule).
    Limit,
    Softening,
    Residual,
}

impl Stretch {
    /// The stretch after the one of this number.
    pub fn after(number: u8, envelope: &Envelope) -> Self {
        match number {
            0 if envelope.hardening_at(envelope.residual)
                < envelope.softening_at(envelope.residual) =>
            {
                Self::Hardening
            }
            1 if envelope.limit_at() < envelope.cap_at() => Self::Limit,
            1 | 2 => Self::Softening,
            _ => Self::Residual,
        }
    }
}

/// `max(min(start + hardening x, cap - softening x, limit), residual)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Envelope {
    /// Force of the hardening line at zero deformation (N).
    pub start: f64,
    /// Slope of the hardening line (N/m), not negative.
    pub hardening: f64,
    /// Force of the falling line at zero deformation (N).
    pub cap: f64,
    /// Fall of the falling line (N/m), positive.
    pub softening: f64,
    /// Maximum force (N), infinite for none.
    pub limit: f64,
    /// Residual force (N), not negative.
    pub residual: f64,
}

impl Envelope {
    /// Where the hardening line meets a force.
    fn hardening_at(&self, force: f64) -> f64 {
        if self.start >= force {
            // Not needed exactly: the line is at or above the force from here on.
            return if self.hardening > 0.0 {
                (force - self.start) / self.hardening
            } else {
                f64::NEG_INFINITY
            };
        }
        if self.hardening > 0.0 {
            (force - self.start) / self.hardening
        } else {
            f64::INFINITY
        }
    }

    /// Where hardening ends at the falling line.
    fn cap_at(&self) -> f64 {
        (self.cap - self.start) / (self.hardening + self.softening)
    }

    /// Where hardening ends at the maximum force.
    fn limit_at(&self) -> f64 {
        self.hardening_at(self.limit)
    }

    /// Where the falling line meets a force.
    fn softening_at(&self, force: f64) -> f64 {
        (self.cap - force) / self.softening
    }

    /// The force at a deformation on its side: the least of the hardening line, the falling one and the limit, and not below
    /// what is left in the end.
    pub fn force(&self, deformation: f64) -> f64 {
        let hardening = self.start + self.hardening * deformation;
        let falling = self.cap - self.softening * deformation;
        hardening.min(falling).min(self.limit).max(self.residual)
    }

    /// The stretch at a deformation; at a corner the one that begins there.
    pub fn stretch(&self, deformation: f64) -> Stretch {
        let falling = self.softening_at(self.limit).max(self.cap_at());
        let begin = if self.limit < f64::INFINITY {
            falling
        } else {
            self.cap_at()
        };
        if deformation >= self.softening_at(self.residual) {
            Stretch::Residual
        } else if deformation >= begin {
            Stretch::Softening
        } else if deformation >= self.limit_at() {
            Stretch::Limit
        } else if deformation >= self.hardening_at(self.residual) {
            Stretch::Hardening
        } else {
            Stretch::Floor
        }
    }

    /// Force at a deformation and slope of a stretch.
    pub fn line(&self, stretch: Stretch, deformation: f64) -> (f64, f64) {
        match stretch {
            Stretch::Hardening => (self.start + self.hardening * deformation, self.hardening),
            Stretch::Softening => (self.cap - self.softening * deformation, -self.softening),
            Stretch::Limit => (self.limit, 0.0),
            Stretch::Floor | Stretch::Residual => (self.residual, 0.0),
        }
    }

    /// Deformation at which a stretch ends.
    pub fn end(&self, stretch: Stretch) -> f64 {
        match stretch {
            Stretch::Floor => self
                .hardening_at(self.residual)
                .min(self.softening_at(self.residual)),
            Stretch::Hardening => self.cap_at().min(self.limit_at()),
            Stretch::Limit => self.softening_at(self.limit),
            Stretch::Softening => self.softening_at(self.residual),
            Stretch::Residual => f64::INFINITY,
        }
    }

    /// Where a rising line from a point below meets the envelope: at the residual force where no more is left there, which
    /// a line that is flatter than the hardening one passes before it meets the falling one.
    pub fn meets(&self, from: Point, slope: f64) -> f64 {
        let ahead = |force: f64, relative: f64| {
            if relative > 0.0 {
                from.deformation + (force - from.force) / relative
            } else {
                f64::INFINITY
            }
        };
        let at = from.deformation;
        let residual = ahead(self.residual, slope).max(at);
        let hardening_there = self.start + self.hardening * residual;
        let falling_there = self.cap - self.softening * residual;
        if hardening_there.min(falling_there).min(self.limit) <= self.residual {
            return residual;
        }
        let hardening = ahead(self.start + self.hardening * at, slope - self.hardening);
        let falling = ahead(self.cap - self.softening * at, slope + self.softening);
        let limit = ahead(self.limit, slope);
        hardening.min(falling).min(limit).max(residual)
    }
}
