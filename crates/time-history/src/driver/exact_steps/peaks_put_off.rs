//! Peaks between samples of buildings that are no sums of oscillators, put off: while a response
//! grows, every swing tops the last one. What could be a peak is noted with its bound and the state
//! that it is reached from, and looked at only if nothing has topped the bound by then.

use super::ExactSteps;
use crate::driver::Driver;
use crate::driver::functions::{Begin, Place, Values};
use crate::system::propagation::{HALVINGS, part_of};
use crate::system::{Segment, System};

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

/// A function that is looked at in a part of an interval.
#[derive(Debug, Clone, Copy)]
struct Open {
    function: usize,
    /// Over the part of twice the length in which its polynomial was not exact, if this is a half of one.
    over: Values,
}

/// All of them.
#[derive(Debug)]
pub(crate) struct PeaksPutOff {
    notes: Vec<Note>,
    capacity: usize,
    functions: usize,
    /// Numbers of the intervals, and states at their starts: displacements, then velocities.
    intervals: Vec<usize>,
    states: Vec<f64>,
    size: usize,
    /// Space for the states at both ends of a part of an interval, one pair for each further halving.
    inside: Vec<f64>,
    /// The functions to be looked at in it: after those of an interval those of a half of a part and so on, from these places on.
    open: Vec<Open>,
    open_from: Vec<usize>,
}

impl PeaksPutOff {
    /// With room for this many halvings of an interval.
    pub(super) fn new(system: &System, functions: usize, halvings: usize) -> Self {
        let size = 2 * system.degrees_of_freedom();
        let capacity = NOTES * STATES + functions;
        let depths = halvings.saturating_sub(HALVINGS) + 1;
        Self {
            notes: Vec::with_capacity(capacity),
            capacity,
            functions,
            intervals: Vec::with_capacity(STATES),
            states: vec![0.0; STATES * size],
            size,
            inside: vec![0.0; depths * 2 * size],
            open: Vec::with_capacity(depths * functions),
            open_from: vec![0; depths],
        }
    }

    /// Whether there is room for another interval.
    fn has_room(&self) -> bool {
        self.notes.len() + self.functions <= self.capacity && self.intervals.len() < STATES
    }

    /// Notes a function in an interval that begins with this state.
    pub(crate) fn note(&mut self, interval: usize, state: &[f64], (function, upper): (usize, f64)) {
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
    pub(crate) fn make_room_for_notes(&mut self, exact: &mut ExactSteps, duration: f64) {
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
    pub(crate) fn settle_put_off(&mut self, duration: f64) {
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
            let open = group.iter().filter(above).map(|note| Open {
                function: note.function,
                over: Values::default(),
            });
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
        let size = exact.put_off.size;
        for halvings in 0..=HALVINGS {
            let put_off = &mut exact.put_off;
            put_off.inside[..size].copy_from_slice(&put_off.states[number * size..][..size]);
            let mut unsure = false;
            for part in 0..1_u32 << halvings {
                let tau = f64::from(part) * part_of(segment.length, halvings);
                unsure |= self.look_at_part(exact, segment, (which, halvings), tau);
            }
            if !unsure {
                return;
            }
        }
    }

    /// Takes the peaks of the functions that are open in a part of an interval, from the state at its start to that at its
    /// end. Whether some polynomials are not exact: from the last of the [`HALVINGS`] on only that part is halved further.
    /// There a part of the motion dies out within it, which ends of steps leave behind them.
    fn look_at_part(
        &mut self,
        exact: &mut ExactSteps,
        segment: &Segment,
        (which, halvings): (usize, usize),
        tau: f64,
    ) -> bool {
        let ExactSteps {
            propagation,
            series,
            functions,
            levels,
            put_off,
            ..
        } = exact;
        let PeaksPutOff {
            size, inside, open, ..
        } = put_off;
        let depth = halvings.saturating_sub(HALVINGS);
        let first = put_off.open_from[depth];
        let (asked, place) = (first..open.len(), depth * 2 * *size);
        let (state, end) = inside[place..][..2 * *size].split_at_mut(*size);
        let of = |open: &[Open], b| open.iter().any(|o| functions[o.function].is_of(b));
        let doubted = |b: usize| of(&open[asked.clone()], b);
        propagation.advance(
            (self.system, segment),
            tau,
            (which, halvings),
            state,
            doubted,
        );
        propagation.deepen(series, doubted);
        let ends = &propagation.ends;
        let (u, v) = end.split_at_mut(*size / 2);
        u.copy_from_slice(&ends.end[0]);
        v.copy_from_slice(&ends.end[1]);
        let place_in = |finest: bool| Place {
            system: self.system,
            segment,
            tau,
            contacts: &[],
            levels,
            series: None,
            finest,
        };
        let mut unsure = false;
        for k in asked.clone() {
            let number = open[k].function;
            let function = &functions[number];
            let most = function.buildings().map(|b| propagation.halvings(which, b));
            let now = place_in(halvings >= most.min().unwrap_or(HALVINGS));
            if !function.takes_peak(&now, ends, &mut self.peaks) {
                unsure = true;
                if halvings >= HALVINGS {
                    open.push(Open {
                        function: number,
                        over: function.values(ends),
                    });
                }
            }
        }
        if open.len() > asked.end {
            // Where they are met halfway after all there is nothing more to look at.
            let doubted = |b: usize| of(&open[asked.end..], b);
            let half = (which, halvings + 1);
            propagation.advance((self.system, segment), tau, half, state, doubted);
            let (now, length) = (place_in(true), part_of(segment.length, halvings));
            let mut kept = asked.end;
            for k in asked.end..open.len() {
                let Open { function, over } = open[k];
                let function = &functions[function];
                if function.is_met_halfway(&over, &propagation.ends, &self.peaks) {
                    function.takes_exact_peak(&now, (&over, length), &mut self.peaks);
                } else {
                    open[kept] = open[k];
                    kept += 1;
                }
            }
            open.truncate(kept);
        }
        if open.len() > asked.end {
            let (this, below) = inside.split_at_mut(place + 2 * *size);
            below[..*size].copy_from_slice(&this[place..][..*size]);
            put_off.open_from[depth + 1] = asked.end;
            let half = part_of(segment.length, halvings + 1);
            for tau in [tau, tau + half] {
                self.look_at_part(exact, segment, (which, halvings + 1), tau);
            }
            exact.put_off.open.truncate(asked.end);
        }
        let PeaksPutOff { size, inside, .. } = &mut exact.put_off;
        inside.copy_within(place + *size..place + 2 * *size, place);
        unsure
    }
}
