//! Dense output of the steps that are taken in the coordinates of the modes: observers read
//! the exact step of contact-free motion, the series, or the polynomials of the pair, and so
//! never change which steps are taken.

use crate::contact::Contacts;
use crate::contact_episode::{LevelRows, ModalRow, Scene, Series, SeriesStep, Span, Touch};
use crate::contact_free::{
    BlockMotion, ContactFree, Four, Ground, Lane, ModeLanes, SampleMotion, WIDTH, at as lane_at,
    gather, restoring, step_over, transform_fours,
};
use crate::dynamics::Layout;
use crate::error::TimeHistoryError;
use crate::polynomial::{GAUSS, Polynomial, difference, maximum_above, value};
use crate::recorder::{Recorder, Sample, StepView, fill};
use crate::system::System;

/// Lengths of parts of a sample whose exact steps are kept.
const PARTS: usize = 64;

/// Times whose floors are worked out together.
pub(crate) const AT_ONCE: usize = 4;
/// Displacement, velocity and absolute acceleration.
const QUANTITIES: usize = 3;

/// What observers of a run need beside the step: space, and who they are.
pub(crate) struct Observers<'a, 'b> {
    pub recorders: &'a mut [&'b mut dyn Recorder],
    workspace: Option<Workspace>,
    /// End of the run (s).
    end: f64,
}

/// Work space.
#[derive(Debug)]
pub(crate) struct Workspace {
    /// Modal displacements, velocities and absolute accelerations at the time asked for.
    displacement: Vec<Lane>,
    velocity: Vec<Lane>,
    absolute: Vec<Lane>,
    /// What is to be filled in for the times asked for, and the floors' motion then.
    kept: [Kept; AT_ONCE],
    floors: [[Vec<Lane>; 4]; QUANTITIES],
    all: Vec<bool>,
    /// The whole state.
    state: Vec<f64>,
    /// Contact forces of all levels (N).
    forces: Vec<f64>,
    /// A series cut short, and that of contact-free motion.
    series: Series,
    free: Series,
    /// Exact steps over parts of a sample: length (s) and constants of the modes.
    parts: Vec<(f64, Vec<ModeLanes>)>,
    /// Place of the part that is replaced next.
    oldest: usize,
}

/// Motion of the modes, works and contact forces at one time.
#[derive(Debug)]
struct Kept {
    modal: [Vec<Lane>; QUANTITIES],
    works: Vec<f64>,
    forces: Vec<f64>,
    ground: f64,
}

impl Workspace {
    pub(crate) fn new(system: &System) -> Self {
        let layout = Layout::of(system);
        let lanes = layout.dofs.div_ceil(WIDTH);
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            displacement: zeros(),
            velocity: zeros(),
            absolute: zeros(),
            kept: std::array::from_fn(|_| Kept {
                modal: std::array::from_fn(|_| zeros()),
                works: vec![0.0; layout.dimension() - 2 * layout.dofs],
                forces: vec![0.0; layout.levels],
                ground: 0.0,
            }),
            floors: std::array::from_fn(|_| std::array::from_fn(|_| zeros())),
            all: vec![true; lanes],
            state: vec![0.0; layout.dimension()],
            forces: vec![0.0; layout.levels],
            series: Series::new(lanes, layout.levels),
            free: Series::new(lanes, 0),
            parts: Vec::with_capacity(PARTS),
            oldest: 0,
        }
    }
}

/// How the modes move within a step.
#[derive(Clone, Copy)]
pub(crate) enum Motion<'a> {
    /// Without contact, over some samples.
    Free(BlockMotion<'a>),
    /// As a series.
    Series(&'a Series),
    /// Between two points of the pair.
    Pair(&'a Scene<'a>, &'a Span<'a>),
}

/// A step in the coordinates of the modes.
pub(crate) struct ModalStep<'a> {
    pub system: &'a System,
    pub constants: &'a ContactFree,
    pub rows: &'a LevelRows,
    /// Contacts during the step.
    pub contacts: &'a Contacts,
    /// The state of the run, of which the works are read.
    pub state: &'a [f64],
    /// Start and length of the step (s).
    pub start: f64,
    pub length: f64,
    pub motion: Motion<'a>,
}

impl<'a, 'b> Observers<'a, 'b> {
    /// Of a run up to `end` (s).
    pub(crate) fn new(
        system: &System,
        recorders: &'a mut [&'b mut dyn Recorder],
        end: f64,
    ) -> Self {
        Self {
            workspace: (!recorders.is_empty()).then(|| Workspace::new(system)),
            recorders,
            end,
        }
    }

    /// Whether there is nobody to serve.
    pub(crate) fn is_empty(&self) -> bool {
        self.recorders.is_empty()
    }

    /// Whether anybody wants to see a time up to this one (s).
    pub(crate) fn want(&self, end: f64) -> bool {
        self.recorders.iter().any(|r| r.next_time() <= end)
    }

    /// Shows a step to all.
    pub(crate) fn show(&mut self, step: &ModalStep<'_>) -> Result<(), TimeHistoryError> {
        let last = step.start + step.length >= self.end * (1.0 - 1.0e-12);
        if let Some(workspace) = &mut self.workspace {
            let end = step.start + step.length;
            let wanting = self.recorders.iter_mut().filter(|r| r.next_time() <= end);
            for recorder in wanting {
                recorder.step(&mut StepView::of_modes(step, workspace, last))?;
            }
        }
        Ok(())
    }
}

impl ModalStep<'_> {
    /// Responses at times inside the step.
    pub(crate) fn samples(&self, times: &[f64], workspace: &mut Workspace, out: &mut [Sample]) {
        let groups = times.chunks(AT_ONCE).zip(out.chunks_mut(AT_ONCE));
        for (times, out) in groups {
            self.few_samples(times, workspace, out);
        }
    }

    /// The same at [`AT_ONCE`] times at most, with one pass over the mode shapes.
    fn few_samples(&self, times: &[f64], workspace: &mut Workspace, out: &mut [Sample]) {
        let n = Layout::of(self.system).dofs;
        for (k, time) in times.iter().enumerate() {
            let ground = self.move_to(*time, workspace);
            let kept = &mut workspace.kept[k];
            let [q, p, a] = &mut kept.modal;
            std::mem::swap(q, &mut workspace.displacement);
            std::mem::swap(p, &mut workspace.velocity);
            std::mem::swap(a, &mut workspace.absolute);
            kept.works.copy_from_slice(&workspace.state[2 * n..]);
            kept.forces.copy_from_slice(&workspace.forces);
            kept.ground = ground;
        }
        self.to_floors(times.len(), workspace);
        for (k, (time, out)) in times.iter().zip(out).enumerate() {
            let [displacement, velocity, absolute] = std::array::from_fn(|quantity| {
                let column = k * QUANTITIES + quantity;
                &workspace.floors[column / 4][column % 4]
            });
            gather(displacement, &mut workspace.state[..n]);
            gather(velocity, &mut workspace.state[n..2 * n]);
            out.acceleration_absolute.resize(n, 0.0);
            gather(absolute, &mut out.acceleration_absolute);
            let kept = &workspace.kept[k];
            workspace.state[2 * n..].copy_from_slice(&kept.works);
            let ground = kept.ground;
            let motion = (workspace.state.as_slice(), kept.forces.as_slice());
            fill(self.system, self.contacts, (*time, ground), motion, out);
        }
    }

    fn offset(&self, time: f64) -> f64 {
        (time - self.start).clamp(0.0, self.length)
    }

    /// The floors' motion at so many of the times that are kept.
    fn to_floors(&self, times: usize, workspace: &mut Workspace) {
        let Workspace {
            kept, floors, all, ..
        } = workspace;
        let last = times * QUANTITIES - 1;
        let [first, second, third] = floors;
        let four = |number: usize, floors| Four {
            modal: std::array::from_fn(|v| {
                // What is left of the last four repeats the last column.
                let column = (4 * number + v).min(last);
                kept[column / QUANTITIES].modal[column % QUANTITIES].as_slice()
            }),
            floors,
            wanted: all,
        };
        let mut fours = [four(0, first), four(1, second), four(2, third)];
        transform_fours(&self.constants.shapes, &mut fours[..=last / 4]);
    }

    /// Motion of the modes, works and contact forces at a time (s). Returns the ground
    /// acceleration then (m/s2).
    fn move_to(&self, time: f64, workspace: &mut Workspace) -> f64 {
        let layout = Layout::of(self.system);
        let n = layout.dofs;
        workspace.state[2 * n..].copy_from_slice(&self.state[2 * n..]);
        workspace.forces.fill(0.0);
        let offset = self.offset(time);
        let at = |ground: (f64, f64), offset: f64| ground.0 + ground.1 * offset;
        let (works, ground) = match self.motion {
            Motion::Free(block) => {
                let sample = block.sample_at(time);
                let offset = (time - sample.time).clamp(0.0, self.constants.step);
                let works = self.free(&sample, offset, workspace);
                (works, at(sample.ground, offset))
            }
            Motion::Series(series) => {
                let works = self.series(series, offset, workspace);
                (works, at(series.ground(), offset))
            }
            Motion::Pair(scene, span) => {
                let works = self.pair(scene, span, offset, workspace);
                (works, at(scene.ground, offset))
            }
        };
        workspace.state[layout.input()] += works.0;
        workspace.state[layout.viscous()] += works.1;
        ground
    }

    /// Maximum value above `floor` that the displacement of the left floor less that of the
    /// right one takes, with its time (s).
    pub(crate) fn approach(
        &self,
        floors: (Option<usize>, Option<usize>),
        floor: f64,
        workspace: &mut Workspace,
    ) -> Option<(f64, f64)> {
        let rows = &self.constants.rows.floors;
        let [left, right] = [floors.0, floors.1].map(|i| i.map(|i| &rows[i]));
        match self.motion {
            Motion::Series(series) => {
                let found = series.maximum_of_difference((left, right), floor);
                found.map(|(theta, top)| (self.start + theta * self.length, top))
            }
            Motion::Free(block) => {
                let dot = |row: Option<&ModalRow>, q: &[Lane]| row.map_or(0.0, |r| r.dot(q));
                let at = |q: &[Lane]| dot(left, q) - dot(right, q);
                let over = |i: Option<usize>| i.map_or(0.0, |i| lane_at(block.over(), i));
                let over = over(floors.0) + over(floors.1);
                let (mut best, mut floor) = (None, floor);
                let mut before = at(block.sample(0).ends[0].displacement);
                for number in 0..block.len() {
                    let sample = block.sample(number);
                    let after = at(sample.ends[1].displacement);
                    if before.max(after) + over > floor
                        && let Some(found) =
                            self.approach_of_free(&sample, (left, right), floor, workspace)
                    {
                        (best, floor) = (Some(found), found.1);
                    }
                    before = after;
                }
                best
            }
            Motion::Pair(_, span) => {
                let of = |row: Option<&ModalRow>| {
                    row.map_or(Polynomial::default(), |row| {
                        let (a, b) = span.row(row, 0.0);
                        span.displacement(a, b)
                    })
                };
                let (theta, top) = maximum_above(&difference(&of(left), &of(right)), floor)?;
                Some((self.start + span.clock.offset(theta), top))
            }
        }
    }

    /// The same without contact, in series over parts of the step.
    fn approach_of_free(
        &self,
        sample: &SampleMotion<'_>,
        rows: (Option<&ModalRow>, Option<&ModalRow>),
        floor: f64,
        workspace: &mut Workspace,
    ) -> Option<(f64, f64)> {
        let (rate, length) = (self.constants.fastest, self.constants.step);
        let parts = (length / Series::longest(rate)).ceil().max(1.0);
        let step = length / parts;
        let [start, _] = sample.ends;
        workspace.displacement.copy_from_slice(start.displacement);
        workspace.velocity.copy_from_slice(start.velocity);
        let (mut best, mut above) = (None, floor);
        for part in 0..parts as usize {
            let offset = part as f64 * step;
            let from = SeriesStep {
                displacement: &workspace.displacement,
                velocity: &workspace.velocity,
                ground: (sample.ground.0 + sample.ground.1 * offset, sample.ground.1),
                step,
                rate,
                terms: 0,
            };
            workspace.free.expand(self.constants, self.rows, &[], &from);
            if let Some((theta, top)) = workspace.free.maximum_of_difference(rows, above) {
                above = top;
                best = Some((sample.time + offset + theta * step, top));
            }
            let modes = &self.constants.modes;
            let (q, p) = (&mut workspace.displacement, &mut workspace.velocity);
            workspace.free.end(modes, q, p, &mut workspace.absolute);
        }
        best
    }

    /// Motion without contact after `offset` (s). Returns the works of ground motion and
    /// damping (J) from those of the run's state on.
    fn free(
        &self,
        sample: &SampleMotion<'_>,
        offset: f64,
        workspace: &mut Workspace,
    ) -> (f64, f64) {
        let modes = &self.constants.modes;
        let Workspace {
            displacement,
            velocity,
            absolute,
            parts,
            oldest,
            ..
        } = workspace;
        // Times this close are one, but for round-off.
        let length = self.constants.step;
        let close = 8.0 * f64::EPSILON * (sample.time + length);
        let at_end = length - offset <= close;
        let from = sample.ends[usize::from(at_end)];
        displacement.copy_from_slice(from.displacement);
        velocity.copy_from_slice(from.velocity);
        let works = [from.input, from.viscous].map(sum);
        let works = if at_end || offset <= close {
            works
        } else {
            let part = self.kept((offset, close), (parts, oldest));
            let ground = Ground {
                start: sample.ground.0,
                end: sample.ground.0 + sample.ground.1 * offset,
                slope: sample.ground.1,
            };
            let done = step_over(part, ground, displacement, velocity);
            [works[0] + done.0, works[1] + done.1]
        };
        restoring(modes, displacement, velocity, absolute);
        (works[0], works[1])
    }

    fn series(&self, series: &Series, offset: f64, workspace: &mut Workspace) -> (f64, f64) {
        let layout = Layout::of(self.system);
        let theta = (offset / self.length).clamp(0.0, 1.0);
        let cut = &mut workspace.series;
        cut.copy_from(series);
        if theta < 1.0 && theta > 0.0 {
            cut.shorten(theta);
        }
        let modes = &self.constants.modes;
        let mut works = (0.0, 0.0);
        if theta > 0.0 {
            let (q, p) = (&mut workspace.displacement, &mut workspace.velocity);
            cut.end(modes, q, p, &mut workspace.absolute);
            let done = cut.works(modes);
            works = (done.input, done.viscous);
            cut.contact_works();
        } else {
            let (q, p) = (&mut workspace.displacement, &mut workspace.velocity);
            cut.start(q, p);
            cut.start_acceleration(modes, &mut workspace.absolute);
        }
        for touch in &workspace.series.touches {
            if theta > 0.0 {
                workspace.state[layout.work(touch.level)] += touch.works.0;
                workspace.forces[touch.level] = workspace.series.at(&touch.force, 1.0).0;
            } else {
                workspace.forces[touch.level] = touch.force[0];
            }
        }
        works
    }

    fn pair(
        &self,
        scene: &Scene<'_>,
        span: &Span<'_>,
        offset: f64,
        workspace: &mut Workspace,
    ) -> (f64, f64) {
        let layout = Layout::of(self.system);
        let theta = span.clock.place_of(offset);
        let (mut input, mut viscous) = (0.0, 0.0);
        // Works by Gauss's rule in the variable of the step.
        for (node, weight) in GAUSS {
            let place = node * theta;
            let time = weight * theta * span.clock.span() * span.clock.rate(place);
            self.within(span, place, workspace);
            let ground = scene.ground.0 + scene.ground.1 * span.clock.offset(place);
            for (c, m) in self.constants.modes.iter().enumerate() {
                for l in 0..WIDTH {
                    let p = workspace.velocity[c][l];
                    input -= time * m.participation[l] * ground * p;
                    viscous += time * m.damping[l] * p * p;
                }
            }
            for touch in scene.touches {
                let (force, rate) = self.force(touch, workspace);
                workspace.state[layout.work(touch.level)] += time * force * rate;
            }
        }
        self.within(span, theta, workspace);
        let (q, p) = (&workspace.displacement, &workspace.velocity);
        restoring(&self.constants.modes, q, p, &mut workspace.absolute);
        for touch in scene.touches {
            let (force, _) = self.force(touch, workspace);
            self.rows.levels[touch.level].add(-force, &mut workspace.absolute);
            workspace.forces[touch.level] = force;
        }
        (input, viscous)
    }

    /// Force (N) and rate of penetration (m/s) of a closed level at the motion in `workspace`.
    fn force(&self, touch: &Touch, workspace: &Workspace) -> (f64, f64) {
        let row = &self.rows.levels[touch.level];
        let delta = row.dot(&workspace.displacement) - touch.width;
        let rate = row.dot(&workspace.velocity);
        let level = &self.system.levels()[touch.level];
        (touch.contact.force(level, delta, rate).value, rate)
    }

    /// Constants of the exact step over a part of a sample.
    fn kept<'r>(
        &self,
        (length, close): (f64, f64),
        (parts, oldest): (&'r mut Vec<(f64, Vec<ModeLanes>)>, &mut usize),
    ) -> &'r [ModeLanes] {
        let known = parts.iter().position(|p| (p.0 - length).abs() <= close);
        let place = known.unwrap_or_else(|| {
            let made = (length, self.constants.modes_over(self.system, length));
            if parts.len() < PARTS {
                parts.push(made);
                return parts.len() - 1;
            }
            *oldest = (*oldest + 1) % PARTS;
            parts[*oldest] = made;
            *oldest
        });
        &parts[place].1
    }

    /// Displacements and velocities of the modes at `theta` of a step of the pair.
    fn within(&self, span: &Span<'_>, theta: f64, workspace: &mut Workspace) {
        for c in 0..self.constants.modes.len() {
            for l in 0..WIDTH {
                let at = |motion: &[Vec<Lane>; 4]| -> [f64; 4] {
                    std::array::from_fn(|k| motion[k][c][l])
                };
                let (a, b) = (at(&span.start.motion), at(&span.end.motion));
                workspace.displacement[c][l] = value(&span.displacement(a, b), theta);
                workspace.velocity[c][l] = value(&span.velocity(a, b), theta);
            }
        }
    }
}

/// Sum over all lanes.
fn sum(lanes: &[Lane]) -> f64 {
    lanes.iter().flat_map(|l| l.0).sum()
}
