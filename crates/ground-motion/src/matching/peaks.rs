//! The highest peaks of oscillators under a motion: what a match works on.

use std::f64::consts::TAU;

use crate::spectra::{Oscillator, State, TargetSpectrum, zero};

/// Peaks of an oscillator from this part of the highest on are looked after, at most
/// so many.
const PEAKS_FROM: f64 = 0.75;
const MOST_PEAKS: usize = 5;
/// Samples below this part of the highest have no such peak beside them, where there
/// are five to a period.
const SAMPLES_FROM: f64 = 0.5;

/// One peak of an oscillator.
#[derive(Clone, Copy)]
pub(crate) struct AtPeak {
    /// Sample before it.
    pub index: usize,
    /// Time from there to it (s), at most a step.
    pub after: f64,
    /// Pseudo-acceleration there as a part of the target, with its sign.
    pub part: f64,
}

/// One oscillator with its highest peaks, the largest first.
pub(crate) struct Row {
    oscillator: Oscillator,
    pub frequency: f64,
    target: f64,
    pub peaks: Vec<AtPeak>,
}

/// A change of the motion: samples from a first one; zero elsewhere.
pub(crate) struct Change {
    pub first: usize,
    pub samples: Vec<f64>,
}

impl Row {
    /// The oscillator of a period (s) under samples of a step `h` (s).
    pub(crate) fn of(samples: &[f64], period: f64, target: &TargetSpectrum, h: f64) -> Self {
        let oscillator = Oscillator::new(period, target.damping(), h);
        let frequency = TAU / period;
        let wanted = target.nearest(period);
        let mut states = vec![State::default()];
        let mut highest = 0.0_f64;
        for pair in samples.windows(2) {
            let next = oscillator.advance(states[states.len() - 1], -pair[0], -pair[1]);
            highest = highest.max(next.displacement.abs());
            states.push(next);
        }
        let mut peaks: Vec<AtPeak> = Vec::new();
        for (index, pair) in states.windows(2).enumerate() {
            // The displacement turns where its velocity is zero.
            let near = pair[0].displacement.abs().max(pair[1].displacement.abs());
            if near < SAMPLES_FROM * highest || pair[0].velocity * pair[1].velocity >= 0.0 {
                continue;
            }
            let forces = [-samples[index], -samples[index + 1]];
            let at = |t| oscillator.within_step(pair[0], forces[0], forces[1], t);
            let ends = [pair[0].velocity, pair[1].velocity];
            let after = zero(0.0, h, ends[0], ends[1], 1.0e-6 * h, |t| at(t).velocity);
            peaks.push(AtPeak {
                index,
                after,
                part: frequency * frequency * at(after).displacement / wanted,
            });
        }
        let most = peaks.iter().fold(0.0_f64, |m, p| m.max(p.part.abs()));
        peaks.retain(|p| p.part.abs() >= PEAKS_FROM * most);
        peaks.sort_by(|a, b| b.part.abs().total_cmp(&a.part.abs()));
        peaks.truncate(MOST_PEAKS);
        Self {
            oscillator,
            frequency,
            target: wanted,
            peaks,
        }
    }

    /// What each peak is too far out, with its sign, as a part of the target: the
    /// maximum must reach one, the others must not exceed it and rise with it.
    pub(crate) fn deviations(&self) -> impl Iterator<Item = f64> {
        let maximum = self.peaks.first().map_or(1.0, |p| p.part.abs());
        let lift = (1.0 - 1.0 / maximum).min(0.0);
        self.peaks.iter().enumerate().map(move |(k, peak)| {
            let part = peak.part.abs();
            let out = if k == 0 || part > 1.0 {
                part - 1.0
            } else {
                part * lift
            };
            out * peak.part.signum()
        })
    }
}

/// `w^2 u` of rows at the times of their peaks under a change, as parts of the targets. The
/// oscillators go through the change together: each alone would wait at every sample for its own
/// last state.
pub(crate) fn responses_to<const N: usize>(rows: [&Row; N], change: &Change) -> [Vec<f64>; N] {
    let mut found = rows.map(|row| vec![0.0; row.peaks.len()]);
    let force = |i: usize| match i.checked_sub(change.first) {
        Some(k) => -change.samples.get(k).copied().unwrap_or(0.0),
        None => 0.0,
    };
    let start = change.first.saturating_sub(1);
    // All peaks behind the start of the change in the order of their times: sample, row, number.
    let mut ahead: Vec<(usize, usize, usize)> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let peaks = row.peaks.iter().enumerate();
        ahead.extend(peaks.map(|(n, peak)| (peak.index, k, n)));
    }
    ahead.retain(|(index, ..)| *index >= start);
    ahead.sort_unstable();
    let mut states = [State::default(); N];
    let (mut at, mut before) = (start, force(start));
    for (index, k, n) in ahead {
        while at < index {
            let after = force(at + 1);
            for (row, state) in rows.iter().zip(&mut states) {
                *state = row.oscillator.advance(*state, before, after);
            }
            (before, at) = (after, at + 1);
        }
        let (row, peak) = (rows[k], &rows[k].peaks[n]);
        let there = row
            .oscillator
            .within_step(states[k], before, force(at + 1), peak.after);
        found[k][n] = row.frequency * row.frequency / row.target * there.displacement;
    }
    found
}
