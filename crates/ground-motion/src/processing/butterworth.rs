//! Butterworth filters.
//!
//! Butterworth (1930), Wireless Engineer 7, 536: one pass has the amplitude
//! `sqrt(r/(1 + r))`, `r = (f/fc)^(2n)` above a high-pass corner, both directions
//! `r/(1 + r)`. Here as second-order sections by the bilinear transform, whose corner
//! is put where it was asked for (pre-warping).

use std::f64::consts::PI;

use crate::accelerogram::Accelerogram;
use crate::error::{GroundMotionError, bound, within};
use crate::processing::window::with_zeros;
use crate::step_record::StepRecord;

const STEP: &str = "filter";

/// In which direction a filter runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Forward: half the power at the corner, phases delayed.
    Causal,
    /// Forward and backward: half the amplitude at the corner, phases kept.
    Zero {
        /// Whether the zeros that are put at both ends stay. Without them, velocity
        /// and displacement do not return to zero.
        keep_pads: bool,
    },
}

/// A Butterworth filter: high-pass, low-pass, or both in turn as a band-pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Butterworth {
    /// Order of each pass and side, 1 to 12.
    pub order: usize,
    /// High-pass (low-cut) corner (Hz).
    pub high_pass: Option<f64>,
    /// Low-pass (high-cut) corner (Hz).
    pub low_pass: Option<f64>,
    /// Direction.
    pub phase: Phase,
}

/// `(b0 + b1/z + b2/z^2) / (1 + a1/z + a2/z^2)`.
#[derive(Debug, Clone, Copy)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

#[derive(Clone, Copy, PartialEq)]
enum Side {
    High,
    Low,
}

impl Section {
    fn run(&self, samples: &mut [f64]) {
        let (mut s1, mut s2) = (0.0, 0.0);
        for x in samples {
            let y = self.b[0] * *x + s1;
            s1 = self.b[1] * *x - self.a[0] * y + s2;
            s2 = self.b[2] * *x - self.a[1] * y;
            *x = y;
        }
    }
}

/// Sections of one side with its corner (Hz).
fn sections(order: usize, corner: f64, time_step: f64, side: Side) -> Vec<Section> {
    let k = libm::tan(PI * corner * time_step);
    let mut sections = Vec::new();
    for i in 0..order / 2 {
        let damping = 2.0 * libm::sin((2 * i + 1) as f64 * PI / (2 * order) as f64);
        let norm = 1.0 + damping * k + k * k;
        let b = match side {
            Side::Low => [k * k / norm, 2.0 * k * k / norm, k * k / norm],
            Side::High => [1.0 / norm, -2.0 / norm, 1.0 / norm],
        };
        let a = [
            2.0 * (k * k - 1.0) / norm,
            (1.0 - damping * k + k * k) / norm,
        ];
        sections.push(Section { b, a });
    }
    if order % 2 == 1 {
        let b = match side {
            Side::Low => [k / (1.0 + k), k / (1.0 + k), 0.0],
            Side::High => [1.0 / (1.0 + k), -1.0 / (1.0 + k), 0.0],
        };
        let a = [(k - 1.0) / (1.0 + k), 0.0];
        sections.push(Section { b, a });
    }
    sections
}

impl Butterworth {
    /// Largest order that is taken: beyond it a corner is sharper than any record needs.
    pub const LARGEST_ORDER: usize = 12;

    /// Zero-phase, order 4, the customary choice.
    #[must_use]
    pub fn zero_phase(high_pass: Option<f64>, low_pass: Option<f64>) -> Self {
        Self {
            order: 4,
            high_pass,
            low_pass,
            phase: Phase::Zero { keep_pads: true },
        }
    }

    fn check(&self, record: &Accelerogram) -> Result<(), GroundMotionError> {
        within(
            STEP,
            "order",
            self.order as f64,
            1.0,
            Self::LARGEST_ORDER as f64,
        )?;
        let nyquist = 0.5 / record.time_step();
        // A corner below a thousandth of 1/duration would make pads of hours.
        let least = 1.0e-3 / record.duration();
        for (name, corner) in [
            ("high-pass corner", self.high_pass),
            ("low-pass corner", self.low_pass),
        ] {
            let of_filter = least..=nyquist * (1.0 - 1.0e-9);
            if let Some(value) = corner.filter(|corner| !of_filter.contains(corner)) {
                return Err(GroundMotionError::OutOfRange {
                    step: STEP,
                    name,
                    value,
                    range: format!("[{}, {})", bound(least), bound(nyquist)),
                });
            }
        }
        match (self.high_pass, self.low_pass) {
            (None, None) => Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: "no corner is given".to_owned(),
                remedy: "give a high-pass corner, a low-pass corner or both",
            }),
            (Some(high), Some(low)) if high >= low => Err(GroundMotionError::NotPossible {
                step: STEP,
                reason: format!(
                    "the high-pass corner {high} Hz is not below the low-pass corner {low} Hz"
                ),
                remedy: "exchange the corners",
            }),
            _ => Ok(()),
        }
    }

    pub(crate) fn apply(
        self,
        record: &Accelerogram,
    ) -> Result<(Accelerogram, StepRecord), GroundMotionError> {
        self.check(record)?;
        let h = record.time_step();
        let mut chain = Vec::new();
        let mut step = StepRecord::new(STEP).number("order", self.order as f64, "-");
        if let Some(corner) = self.high_pass {
            chain.extend(sections(self.order, corner, h, Side::High));
            step = step.number("high-pass corner", corner, "Hz").number(
                "longest usable period",
                0.8 / corner,
                "s",
            );
        }
        if let Some(corner) = self.low_pass {
            chain.extend(sections(self.order, corner, h, Side::Low));
            step = step.number("low-pass corner", corner, "Hz");
        }
        let Phase::Zero { keep_pads } = self.phase else {
            let mut samples = record.samples().to_vec();
            chain.iter().for_each(|s| s.run(&mut samples));
            return Ok((
                record.with_samples(samples, h)?,
                step.remark("Butterworth, causal"),
            ));
        };
        let (samples, pad) = self.both_directions(record, &chain);
        let mut step = step
            .number("pad at each end", pad as f64 * h, "s")
            .remark("Butterworth, zero phase, forward and backward");
        let count = record.samples().len();
        let samples = if keep_pads {
            let padded = record.with_samples(samples, h)?;
            return Ok((padded.starting_later(-(pad as f64) * h), step));
        } else {
            step = step
                .remark("the pads were removed: velocity and displacement do not return to zero");
            samples[pad..pad + count].to_vec()
        };
        Ok((record.with_samples(samples, h)?, step))
    }

    /// Length (s) of one pad, rounded up to whole steps of the record: 1.5 n/fc in all for the lowest corner (Converse and
    /// Brady 1992, USGS OFR 92-296A).
    fn pad(&self) -> f64 {
        let lowest = self.high_pass.or(self.low_pass).unwrap_or(f64::INFINITY);
        0.75 * self.order as f64 / lowest
    }

    /// Zeros (s) that it leaves at each end of a record, but for a time step.
    #[must_use]
    pub fn zeros_at_each_end(&self) -> f64 {
        match self.phase {
            Phase::Zero { keep_pads: true } => self.pad(),
            _ => 0.0,
        }
    }

    /// Filtered samples with pads, and the length of one pad.
    fn both_directions(&self, record: &Accelerogram, chain: &[Section]) -> (Vec<f64>, usize) {
        let pad = (self.pad() / record.time_step()).ceil() as usize;
        let mut samples = with_zeros(record.samples(), pad, pad);
        for _ in 0..2 {
            chain.iter().for_each(|s| s.run(&mut samples));
            samples.reverse();
        }
        (samples, pad)
    }
}
