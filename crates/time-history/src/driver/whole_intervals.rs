//! Whole intervals without contact of buildings that are no sums of oscillators, one after
//! another as long as the bounds exclude events and peaks: the steps of [`super::exact_steps`],
//! with no more worked out than the proof takes. The first interval that it fails for is left to
//! those.

use super::exact_steps::ExactSteps;
use super::functions::Begin;
use super::{Driver, Mute};
use crate::dynamics::Segment;
use crate::error::TimeHistoryError;
use crate::recorder::Recorder;

/// Intervals after which the energy is balanced.
const BALANCED: usize = 8;

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
        let mut advanced = 0;
        let mut end = 0.0;
        if !exact.propagation.is_pushed() {
            while let Some(segment) = self.system.segment(first + advanced, duration) {
                if !self.whole_interval(&mut exact, &segment, advanced == 0) {
                    break;
                }
                end = segment.start + segment.length;
                let last = end >= duration * (1.0 - 1e-12);
                self.show(
                    &mut exact,
                    &segment,
                    (0.0, segment.length),
                    last,
                    recorders,
                )?;
                self.take(&exact, &segment, segment.length);
                advanced += 1;
                if advanced % BALANCED == 0 {
                    self.balance(end)?;
                }
            }
        }
        exact.begin = Begin::Unknown;
        self.exact = Some(exact);
        if advanced % BALANCED > 0 {
            self.balance(end)?;
        }
        Ok(advanced)
    }

    /// Leads the run over an interval; false if that is no proof that nothing happens in it.
    fn whole_interval(&mut self, exact: &mut ExactSteps, segment: &Segment, fresh: bool) -> bool {
        let (system, ground) = (self.system, segment.ground(0.0));
        let jumps = !(self.last_ground).is_some_and(|last| system.same_ground(ground, last));
        let ExactSteps {
            propagation,
            series,
            functions,
            groups,
            stale,
            levels,
            ..
        } = exact;
        let Some(which) = propagation.known_length(segment.length).filter(|_| !jumps) else {
            return false;
        };
        if fresh {
            series.contacts.clear();
            propagation.end_at((system, segment), &self.state);
            for group in groups.iter_mut() {
                if *stale {
                    group.refresh(functions, &self.peaks);
                }
                group.begin_at(&propagation.end_motion(group.building()));
            }
            *stale = false;
        }
        propagation.advance_whole((system, segment), which, &self.state);
        let ends = &propagation.ends;
        let n = self.dynamics.layout.dofs;
        let start = (&self.state[..n], &self.state[n..2 * n]);
        // What is not a number is no proof.
        let open = levels.iter().enumerate().all(|(l, row)| {
            let (_, most) = row.range_over(start, ends);
            most < self.contacts.width(l)
        });
        let mut grouped = 0;
        for group in groups.iter_mut().filter(|_| open) {
            if !group.stay_below(&propagation.end_motion(group.building()), ends) {
                return false;
            }
            grouped = group.functions_end();
        }
        let mut others = functions[grouped..].iter();
        open && others.all(|f| f.stays_below_over(start, ends, &self.peaks))
    }
}
