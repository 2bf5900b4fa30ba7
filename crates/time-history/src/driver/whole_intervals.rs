//! Whole intervals without contact of buildings that are no sums of oscillators, one after
//! another as long as the bounds exclude events: the steps of [`super::exact_steps`], with no more
//! worked out than the proof takes, and peaks put off. The first interval in which a gap may close is
//! left to those.

use super::exact_steps::ExactSteps;
use super::functions::{Begin, Course};
use super::{Driver, Mute};
use crate::error::TimeHistoryError;
use crate::recorder::Recorder;
use crate::system::Segment;

/// Intervals after which the energy is balanced.
const BALANCED: usize = 32;

impl Driver<'_> {
    /// Advances from the start of an interval. Returns the number of intervals advanced.
    pub(super) fn whole_intervals(
        &mut self,
        first: usize,
        duration: f64,
        recorders: &mut [&mut dyn Recorder],
    ) -> Result<usize, TimeHistoryError> {
        let quiet = self.contacts.closed().is_empty();
        if !quiet || self.mute.iter().any(|mute| *mute != Mute::No) {
            return Ok(0);
        }
        let Some(mut exact) = self.exact.take() else {
            return Ok(0);
        };
        exact.met = false;
        let mut advanced = 0;
        let mut end = 0.0;
        if !exact.propagation.is_pushed() {
            while let Some(segment) = self.system.segment(first + advanced, duration) {
                self.make_room_for_notes(&mut exact, duration);
                if !self.whole_interval(&mut exact, &segment, advanced == 0) {
                    break;
                }
                end = segment.start + segment.length;
                let last = end >= duration * (1.0 - 1e-12);
                self.show(&mut exact, &segment, (0.0, segment.length), last, recorders)?;
                self.take_motion(&exact);
                self.last_ground = Some(segment.ground(segment.length));
                advanced += 1;
                if advanced % BALANCED == 0 {
                    self.balance(end)?;
                }
            }
        }
        if advanced > 0 {
            self.begin_anew();
        }
        exact.begin = Begin::Unknown;
        self.exact = Some(exact);
        if advanced % BALANCED > 0 {
            self.balance(end)?;
        }
        Ok(advanced)
    }

    /// Leads the run over an interval; false if that is no proof that no gap closes in it.
    fn whole_interval(&mut self, exact: &mut ExactSteps, segment: &Segment, fresh: bool) -> bool {
        let system = self.system;
        let jumps = system.jumps_into(segment.ground(0.0), self.last_ground);
        let ExactSteps {
            propagation,
            series,
            functions,
            groups,
            stale,
            levels,
            closings,
            met,
            put_off,
            ..
        } = exact;
        let Some(which) = propagation.known_length(segment.length).filter(|_| !jumps) else {
            return false;
        };
        if *stale {
            for group in groups.iter_mut() {
                group.refresh(functions, &self.peaks);
            }
            *stale = false;
        }
        if fresh {
            series.contacts.clear();
            propagation.begin_whole((system, segment), &self.state);
        }
        propagation.advance_whole((system, segment), which, &self.state);
        let ends = &propagation.ends;
        let n = self.dynamics.layout.dofs;
        let start = [&self.state[..n], &self.state[n..2 * n]];
        if fresh {
            closings.clear();
            closings.extend(levels.iter().map(|row| row.at(start)));
        }
        let mut numbered = levels.iter().zip(closings).enumerate();
        let open = numbered.all(|(l, (row, closing))| {
            let course = row.over(*closing, ends);
            *closing = course.end;
            course.stays_below(self.contacts.width(l))
        });
        if !open {
            *met = true;
            return false;
        }
        let end = segment.start + segment.length;
        let mut take = |number: usize, course: &Course, upper: f64| {
            let (function, peaks) = (&functions[number], &mut self.peaks);
            let (peak, one_sided) = function.peak(peaks);
            let value = course.end[0];
            let value = if one_sided { value } else { value.abs() };
            if value > peak {
                function.raise(peaks, value, end);
            }
            if upper > value.max(peak) && course.may_turn() {
                put_off.note(segment.interval, &self.state, (number, upper));
            }
            function.peak(peaks).0
        };
        let mut grouped = 0;
        for group in groups.iter_mut() {
            let courses = propagation.courses(group.building());
            grouped = group.functions_end();
            if group.stay_below(&courses, ends) {
                continue;
            }
            for own in 0..group.len() {
                let Some(upper) = group.above(own) else {
                    continue;
                };
                if !upper.is_finite() {
                    return false;
                }
                let (number, course) = group.course(own, &courses, ends);
                let peak = take(number, &course, upper);
                group.set_peak(own, peak);
            }
        }
        for number in grouped..functions.len() {
            let course = functions[number].over(start, ends);
            let (least, most) = course.range();
            let upper = functions[number].size_of((least, most));
            if !upper.is_finite() {
                return false;
            }
            take(number, &course, upper);
        }
        true
    }
}
