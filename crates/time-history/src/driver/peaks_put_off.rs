//! Peaks between samples of buildings that are no sums of oscillators, put off: while a response
//! grows, every swing tops the last one. What could be a peak is noted with its bound and the state
//! that it is reached from, and looked at only if nothing has topped the bound by then.

use super::Driver;
use super::exact_steps::ExactSteps;
use super::functions::{Begin, Place};
use crate::dynamics::Segment;
use crate::propagation::HALVINGS;
use crate::system::System;

/// States that are kept at most.
const STATES: usize = 64;
/// Notes for every state, in the mean.
const NOTES: usize = 8;

/// A function that may have a peak in a whole interval.
#[derive(Debug, Clone, Copy)]
struct Note {
    function: usize,
    /// Bound of its value.
    upper: f64,
    /// Number of the state at the start.
    state: usize,
}

/// All of them.
#[derive(Debug)]
pub(super) struct PeaksPutOff {
    notes: Vec<Note>,
    capacity: usize,
    functions: usize,
    /// Numbers of the intervals, and states at their starts: displacements, then velocities.
    intervals: Vec<usize>,
    states: Vec<f64>,
    size: usize,
    /// Space for the state inside an interval, and for the functions to be looked at in it.
    inside: Vec<f64>,
    open: Vec<usize>,
}

impl PeaksPutOff {
    pub(super) fn new(system: &System, functions: usize) -> Self {
        let size = 2 * system.degrees_of_freedom();
        let capacity = NOTES * STATES + functions;
        Self {
            notes: Vec::with_capacity(capacity),
            capacity,
            functions,
            intervals: Vec::with_capacity(STATES),
            states: vec![0.0; STATES * size],
            size,
            inside: vec![0.0; size],
            open: Vec::with_capacity(functions),
        }
    }

    /// Whether there is room for another interval.
    fn has_room(&self) -> bool {
        self.notes.len() + self.functions <= self.capacity && self.intervals.len() < STATES
    }

    /// Notes a function in an interval that begins with this state.
    pub(super) fn note(&mut self, interval: usize, state: &[f64], (function, upper): (usize, f64)) {
        if self.intervals.last() != Some(&interval) {
            let place = self.intervals.len() * self.size;
            self.states[place..][..self.size].copy_from_slice(&state[..self.size]);
            self.intervals.push(interval);
        }
        self.notes.push(Note {
            function,
            upper,
            state: self.intervals.len() - 1,
        });
    }

    /// Drops all notes but those that are wanted, and closes the gaps between states.
    fn keep(&mut self, wanted: impl Fn(&Note) -> bool) {
        self.notes.retain(wanted);
        let (mut kept, mut last) = (0, usize::MAX);
        for note in &mut self.notes {
            if note.state != last {
                last = note.state;
                self.intervals[kept] = self.intervals[last];
                let from = last * self.size;
                let range = from..from + self.size;
                self.states.copy_within(range, kept * self.size);
                kept += 1;
            }
            note.state = kept - 1;
        }
        self.intervals.truncate(kept);
    }
}

impl Driver<'_> {
    /// Makes room for the notes of another interval.
    pub(super) fn make_room_for_notes(&mut self, exact: &mut ExactSteps, duration: f64) {
        if exact.put_off.has_room() {
            return;
        }
        let (functions, peaks) = (&exact.functions, &self.peaks);
        let above = |note: &Note| note.upper > functions[note.function].peak(peaks).0;
        exact.put_off.keep(above);
        if !exact.put_off.has_room() || exact.put_off.intervals.len() > STATES / 2 {
            self.settle_notes(exact, duration);
        }
    }

    /// Looks at all that was put off.
    pub(super) fn settle_put_off(&mut self, duration: f64) {
        if let Some(mut exact) = self.exact.take() {
            self.settle_notes(&mut exact, duration);
            self.exact = Some(exact);
        }
    }

    fn settle_notes(&mut self, exact: &mut ExactSteps, duration: f64) {
        let mut notes = std::mem::take(&mut exact.put_off.notes);
        for group in notes.chunk_by(|a, b| a.state == b.state) {
            let interval = exact.put_off.intervals[group[0].state];
            let (functions, peaks) = (&exact.functions, &self.peaks);
            let above = |note: &&Note| note.upper > functions[note.function].peak(peaks).0;
            exact.put_off.open.clear();
            let open = group.iter().filter(above).map(|note| note.function);
            exact.put_off.open.extend(open);
            if exact.put_off.open.is_empty() {
                continue;
            }
            if let Some(segment) = self.system.segment(interval, duration) {
                self.look_inside(exact, &segment, group[0].state);
            }
        }
        notes.clear();
        exact.put_off.notes = notes;
        exact.put_off.intervals.clear();
        exact.stale = true;
        exact.begin = Begin::Unknown;
    }

    /// Takes the peaks of the functions that are open in an interval, in ever shorter parts of
    /// it until their polynomials are exact.
    fn look_inside(&mut self, exact: &mut ExactSteps, segment: &Segment, number: usize) {
        let Some(which) = exact.propagation.known_length(segment.length) else {
            return;
        };
        let ExactSteps {
            propagation,
            series,
            functions,
            levels,
            put_off,
            ..
        } = exact;
        let PeaksPutOff {
            states,
            size,
            inside,
            open,
            ..
        } = put_off;
        for halvings in 0..=HALVINGS {
            inside.copy_from_slice(&states[number * *size..][..*size]);
            let parts = 1_u32 << halvings;
            let mut unsure = false;
            for part in 0..parts {
                let tau = segment.length * f64::from(part) / f64::from(parts);
                let place = (which, halvings);
                let doubted = |b: usize| open.iter().any(|f| functions[*f].is_of(b));
                propagation.advance((self.system, segment), tau, place, inside, doubted);
                propagation.deepen(series, doubted);
                let ends = &propagation.ends;
                let now = Place {
                    system: self.system,
                    segment,
                    tau,
                    contacts: &[],
                    levels,
                    series: None,
                    finest: halvings == HALVINGS,
                };
                for function in open.iter() {
                    unsure |= !functions[*function].takes_peak(&now, ends, &mut self.peaks);
                }
                let (u, v) = inside.split_at_mut(*size / 2);
                u.copy_from_slice(&ends.end[0]);
                v.copy_from_slice(&ends.end[1]);
            }
            if !unsure {
                return;
            }
        }
    }
}
