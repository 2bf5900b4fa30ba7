//! Dense output of the steps that are taken in the coordinates of the modes: observers read
//! the exact step of contact-free motion, the series, or the polynomials of the pair, and so
//! never change which steps are taken.

use crate::contact::Contacts;
use crate::contact_episode::{Pair, Scene, Series, SeriesEnd, SeriesStep, Span, Touch};
use crate::history::History;
use crate::layout::Layout;
use crate::ledger;
use crate::polynomial::{GAUSS, Polynomial, difference, maximum_above, value};
use crate::response_row::{FreeMotion, ShearRows, append_motion};
use crate::system::modes::{
    BlockMotion, ContactFree, Floors, Four, Ground, Lane, LevelRows, ModalRow, ModeLanes, STRIP,
    SampleMotion, WIDTH, at as lane_at, gather, restoring, step_over, sum, transform_fours,
    transform_free, transform_three,
};
use crate::system::{CLOSE, System};

/// Lengths of parts of a sample whose exact steps are kept.
const PARTS: usize = 64;

/// Times whose floors are worked out together.
pub(crate) const AT_ONCE: usize = 4;
/// Displacement, velocity and absolute acceleration.
const QUANTITIES: usize = 3;

/// Work space.
#[derive(Debug)]
pub(crate) struct Workspace {
    layout: Layout,
    /// Whether mode shapes of all buildings stay in the cache by themselves.
    small: bool,
    /// The motion at the times asked for, and that of the floors then.
    places: [Place; AT_ONCE],
    floors: [[Vec<Lane>; 4]; QUANTITIES],
    all: Vec<bool>,
    flat: Floors,
    /// Rows of shear buildings alone.
    shear_rows: Option<ShearRows>,
    /// The whole state.
    state: Vec<f64>,
    /// Contact forces of all levels (N).
    forces: Vec<f64>,
    /// A series cut short, and that of contact-free motion.
    series: Series,
    free: Series,
    polynomials: Polynomials,
    overshoots: Overshoots,
    /// Exact steps over parts of a sample: length (s) and constants of the modes.
    parts: Vec<(f64, Vec<ModeLanes>)>,
    /// Place of the part that is replaced next.
    oldest: usize,
}

/// What displacements of floors may exceed their values at samples by (m), in the contact-free step
/// that starts at this time (s), with space for the modes.
#[derive(Debug)]
struct Overshoots {
    start: Option<f64>,
    floors: Vec<Lane>,
    modes: [Vec<Lane>; 2],
}

/// Displacements and velocities of the modes over a step of the pair.
#[derive(Debug)]
struct Polynomials {
    displacement: Vec<[Polynomial; WIDTH]>,
    velocity: Vec<[Polynomial; WIDTH]>,
}

/// The motion of the modes at one time.
#[derive(Debug)]
struct Place {
    displacement: Vec<Lane>,
    velocity: Vec<Lane>,
    absolute: Vec<Lane>,
    /// Ground acceleration (m/s2).
    ground: f64,
    /// Works of ground motion and damping (J) from those of the run's state on.
    works: (f64, f64),
    contacts: Vec<ContactPlace>,
}

/// A closed level at one time.
#[derive(Debug, Clone, Copy)]
struct ContactPlace {
    level: usize,
    /// Force (N).
    force: f64,
    /// Work (J) from that of the run's state on.
    work: f64,
}

impl Workspace {
    pub(crate) fn new(system: &System) -> Self {
        let layout = Layout::of(system);
        let lanes = layout.dofs.div_ceil(WIDTH);
        let zeros = || vec![Lane::ZERO; lanes];
        Self {
            layout,
            small: system.buildings().iter().all(|b| b.storeys() <= STRIP),
            places: std::array::from_fn(|_| Place {
                displacement: zeros(),
                velocity: zeros(),
                absolute: zeros(),
                ground: 0.0,
                works: (0.0, 0.0),
                contacts: Vec::with_capacity(layout.levels),
            }),
            floors: std::array::from_fn(|_| std::array::from_fn(|_| zeros())),
            all: vec![true; lanes],
            flat: std::array::from_fn(|_| vec![0.0; lanes * WIDTH]),
            shear_rows: ShearRows::new(system),
            state: vec![0.0; layout.dimension()],
            forces: vec![0.0; layout.levels],
            series: Series::new(lanes, layout.levels),
            free: Series::new(lanes, 0),
            polynomials: Polynomials {
                displacement: vec![[Polynomial::default(); WIDTH]; lanes],
                velocity: vec![[Polynomial::default(); WIDTH]; lanes],
            },
            overshoots: Overshoots {
                start: None,
                floors: zeros(),
                modes: [zeros(), zeros()],
            },
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
    /// As a series, with its end.
    Series(&'a Series, SeriesEnd<'a>),
    /// Between two points of the pair, whose works are over the whole step.
    Pair(&'a Scene<'a>, &'a Span<'a>, &'a Pair),
    /// A single instant: displacements and velocities of the modes, and the ground
    /// acceleration (m/s2).
    Instant([&'a [Lane]; 2], f64),
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

impl ModalStep<'_> {
    /// End of the step (s), with what round-off may add.
    pub(crate) fn end(&self) -> f64 {
        (self.start + self.length) * (1.0 + CLOSE)
    }

    /// Appends responses at times inside the step.
    pub(crate) fn append(&self, times: &[f64], workspace: &mut Workspace, rows: &mut History) {
        let works = workspace.layout.motion();
        workspace.state[works..].copy_from_slice(&self.state[works..]);
        if workspace.small {
            for time in &times[self.append_free(times, workspace, rows)..] {
                self.append_small(*time, workspace, rows);
            }
            return;
        }
        for times in times.chunks(AT_ONCE) {
            for (number, time) in times.iter().enumerate() {
                self.move_to(*time, number, workspace);
            }
            self.to_floors(times.len(), workspace);
            for (number, time) in times.iter().enumerate() {
                for (quantity, flat) in workspace.flat.iter_mut().enumerate() {
                    let column = number * QUANTITIES + quantity;
                    gather(&workspace.floors[column / 4][column % 4], flat);
                }
                self.append_row((*time, number), workspace, rows);
            }
        }
    }

    /// Appends rows at those of the first times that are ends of samples without contact, where that
    /// is shorter. Returns how many they are.
    fn append_free(&self, times: &[f64], workspace: &Workspace, rows: &mut History) -> usize {
        let (Some(shear_rows), Motion::Free(block)) = (&workspace.shear_rows, &self.motion) else {
            return 0;
        };
        let motion = FreeMotion {
            system: self.system,
            layout: workspace.layout,
            contacts: self.contacts,
            constants: self.constants,
            block,
            state: self.state,
            close: CLOSE * (self.start + self.length),
        };
        shear_rows.append_free(&motion, times, rows)
    }

    /// The same of one time, where mode shapes stay in the cache by themselves.
    fn append_small(&self, time: f64, workspace: &mut Workspace, rows: &mut History) {
        let shapes = &self.constants.floor_rows;
        let close = CLOSE * (self.start + self.length);
        if let Motion::Free(block) = &self.motion
            && let Some((motion, ground)) = block.at_end_of_sample(time, close)
        {
            let place = &mut workspace.places[0];
            place.contacts.clear();
            place.ground = ground;
            place.works = (sum(motion.input), sum(motion.viscous));
            let constants = (self.constants.modes.as_slice(), shapes.as_slice());
            let modal = [motion.displacement, motion.velocity];
            transform_free(constants, modal, &mut place.absolute, &mut workspace.flat);
        } else {
            self.move_to(time, 0, workspace);
            let place = &workspace.places[0];
            let modal: [&[Lane]; QUANTITIES] =
                [&place.displacement, &place.velocity, &place.absolute];
            transform_three(shapes, modal, &mut workspace.flat);
        }
        self.append_row((time, 0), workspace, rows);
    }

    /// Appends the row of a time from its place, and from the motion of the floors then.
    fn append_row(
        &self,
        (time, number): (f64, usize),
        workspace: &mut Workspace,
        rows: &mut History,
    ) {
        let Workspace {
            layout,
            places,
            flat,
            state,
            forces,
            shear_rows,
            ..
        } = workspace;
        let (layout, n, place) = (*layout, layout.dofs, &places[number]);
        let [u, v, absolute] = flat;
        state[layout.input()] = self.state[layout.input()] + place.works.0;
        state[layout.viscous()] = self.state[layout.viscous()] + place.works.1;
        for contact in &place.contacts {
            let work = layout.work(contact.level);
            state[work] = self.state[work] + contact.work;
            forces[contact.level] = contact.force;
        }
        // Buildings with modes have no degrees of freedom but their floors.
        rows.acceleration_absolute.extend_from_slice(&absolute[..n]);
        let (row, now) = ((self.system, layout, self.contacts), (time, place.ground));
        if let Some(shear_rows) = shear_rows {
            shear_rows.append(row, now, [u, v], (state, forces), rows);
            return;
        }
        state[..n].copy_from_slice(&u[..n]);
        state[n..2 * n].copy_from_slice(&v[..n]);
        append_motion(row, now, (state, forces), rows);
        let energy = ledger::energy(self.system, layout, self.contacts, state, None);
        rows.energy.push(energy);
    }

    fn offset(&self, time: f64) -> f64 {
        (time - self.start).clamp(0.0, self.length)
    }

    /// Whether an offset (s) into the step is its end.
    fn is_end(&self, offset: f64) -> bool {
        self.length - offset <= CLOSE * (self.start + self.length)
    }

    /// The floors' motion at so many of the times.
    fn to_floors(&self, times: usize, workspace: &mut Workspace) {
        let Workspace {
            places,
            floors,
            all,
            ..
        } = workspace;
        let last = times * QUANTITIES - 1;
        let [first, second, third] = floors;
        let four = |number: usize, floors| Four {
            modal: std::array::from_fn(|v| {
                // What is left of the last four repeats the last column.
                let column = (4 * number + v).min(last);
                let place = &places[column / QUANTITIES];
                [&place.displacement, &place.velocity, &place.absolute][column % QUANTITIES]
                    .as_slice()
            }),
            floors,
            wanted: all,
        };
        let mut fours = [four(0, first), four(1, second), four(2, third)];
        transform_fours(&self.constants.shapes, &mut fours[..=last / 4]);
    }

    /// Moves a place of the work space to a time (s).
    fn move_to(&self, time: f64, number: usize, workspace: &mut Workspace) {
        let place = &mut workspace.places[number];
        place.contacts.clear();
        match self.motion {
            Motion::Free(block) => {
                let kept = (&mut workspace.parts, &mut workspace.oldest);
                self.free(&block, time, place, kept);
            }
            Motion::Series(series, end) => {
                let offset = self.offset(time);
                if self.is_end(offset) {
                    place.displacement.copy_from_slice(end.displacement);
                    place.velocity.copy_from_slice(end.velocity);
                    place.absolute.copy_from_slice(end.absolute);
                    place.works = (end.works.input, end.works.viscous);
                    for touch in &series.touches {
                        place.contacts.push(ContactPlace {
                            level: touch.level,
                            force: series.at(&touch.force, 1.0).0,
                            work: touch.works.0,
                        });
                    }
                } else {
                    self.series(series, offset, place, &mut workspace.series);
                }
                let ground = series.ground();
                place.ground = ground.0 + ground.1 * offset;
            }
            Motion::Pair(scene, span, pair) => {
                let offset = self.offset(time);
                place.ground = scene.ground.0 + scene.ground.1 * offset;
                if self.is_end(offset) {
                    self.end_of_pair(scene, pair, place);
                } else {
                    self.pair(scene, span, offset, (place, &mut workspace.polynomials));
                }
            }
            Motion::Instant(motion, ground) => self.instant(motion, ground, place),
        }
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
            Motion::Series(series, _) => {
                let found = series.maximum_of_difference((left, right), floor);
                found.map(|(theta, top)| (self.start + theta * self.length, top))
            }
            Motion::Free(block) => {
                let dot = |row: Option<&ModalRow>, q: &[Lane]| row.map_or(0.0, |r| r.dot(q));
                let at = |q: &[Lane]| dot(left, q) - dot(right, q);
                let Overshoots {
                    start,
                    floors: all,
                    modes: [size, modal],
                } = &mut workspace.overshoots;
                if *start != Some(self.start) {
                    *start = Some(self.start);
                    block.bound_displacements(self.constants, [all, size, modal]);
                }
                let over = |i: Option<usize>| i.map_or(0.0, |i| lane_at(all, i));
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
            Motion::Instant([q, _], _) => {
                let at = |row: Option<&ModalRow>| row.map_or(0.0, |r| r.dot(q));
                let value = at(left) - at(right);
                (value > floor).then_some((self.start, value))
            }
            Motion::Pair(_, span, _) => {
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
        let parts = (length * rate / Series::LONGEST).ceil().max(1.0);
        let step = length / parts;
        let [start, _] = sample.ends;
        let Workspace {
            places: [place, ..],
            free: series,
            ..
        } = workspace;
        place.displacement.copy_from_slice(start.displacement);
        place.velocity.copy_from_slice(start.velocity);
        let (mut best, mut above) = (None, floor);
        for part in 0..parts as usize {
            let offset = part as f64 * step;
            let from = SeriesStep {
                displacement: &place.displacement,
                velocity: &place.velocity,
                ground: (sample.ground.0 + sample.ground.1 * offset, sample.ground.1),
                step,
                rate,
                terms: 0,
                negligible: Series::ROUND_OFF,
            };
            series.expand(self.constants, self.rows, &[], &from);
            if let Some((theta, top)) = series.maximum_of_difference(rows, above) {
                above = top;
                best = Some((sample.time + offset + theta * step, top));
            }
            let modes = &self.constants.modes;
            let (q, p) = (&mut place.displacement, &mut place.velocity);
            series.end(modes, q, p, &mut place.absolute);
        }
        best
    }

    /// Motion without contact.
    fn free(
        &self,
        block: &BlockMotion<'_>,
        time: f64,
        place: &mut Place,
        kept: (&mut Vec<(f64, Vec<ModeLanes>)>, &mut usize),
    ) {
        let sample = block.sample(block.number_at(time));
        let length = self.constants.step;
        let offset = (time - sample.time).clamp(0.0, length);
        let close = CLOSE * (sample.time + length);
        let at_end = length - offset <= close;
        let from = sample.ends[usize::from(at_end)];
        let (q, p) = (&mut place.displacement, &mut place.velocity);
        q.copy_from_slice(from.displacement);
        p.copy_from_slice(from.velocity);
        place.works = (sum(from.input), sum(from.viscous));
        place.ground = sample.ground.0 + sample.ground.1 * offset;
        if !at_end && offset > close {
            let part = self.kept((offset, close), kept);
            let ground = Ground {
                start: sample.ground.0,
                end: place.ground,
                slope: sample.ground.1,
            };
            let done = step_over(part, ground, q, p);
            place.works = (place.works.0 + done.0, place.works.1 + done.1);
        }
        restoring(&self.constants.modes, q, p, &mut place.absolute);
    }

    /// Motion of a series before its end; `cut` is space for a part of it.
    fn series(&self, series: &Series, offset: f64, place: &mut Place, cut: &mut Series) {
        let theta = (offset / self.length).clamp(0.0, 1.0);
        let modes = &self.constants.modes;
        let (q, p, absolute) = (
            &mut place.displacement,
            &mut place.velocity,
            &mut place.absolute,
        );
        place.works = (0.0, 0.0);
        if !(theta > 0.0) {
            series.start(q, p);
            series.start_acceleration(modes, absolute);
            for touch in &series.touches {
                let (level, force) = (touch.level, touch.force[0]);
                let work = 0.0;
                place.contacts.push(ContactPlace { level, force, work });
            }
            return;
        }
        cut.copy_from(series);
        if theta < 1.0 {
            cut.shorten(theta);
        }
        cut.end(modes, q, p, absolute);
        let done = cut.account(modes);
        place.works = (done.input, done.viscous);
        for touch in &cut.touches {
            place.contacts.push(ContactPlace {
                level: touch.level,
                force: cut.at(&touch.force, 1.0).0,
                work: touch.works.0,
            });
        }
    }

    /// Motion at the end of a step of the pair.
    fn end_of_pair(&self, scene: &Scene<'_>, pair: &Pair, place: &mut Place) {
        let [q, p, ..] = &pair.end.motion;
        place.displacement.copy_from_slice(q);
        place.velocity.copy_from_slice(p);
        place.works = (pair.works.input, pair.works.viscous);
        restoring(&self.constants.modes, q, p, &mut place.absolute);
        let ends = pair.end.touches.iter().zip(&pair.contact_works);
        for (touch, (end, (work, _))) in scene.touches.iter().zip(ends) {
            let row = &self.rows.levels[touch.level];
            row.add(-end.force, &mut place.absolute);
            place.contacts.push(ContactPlace {
                level: touch.level,
                force: end.force,
                work: *work,
            });
        }
    }

    /// Motion of the pair before the end of the step; the polynomials are space for those of the
    /// modes.
    fn pair(
        &self,
        scene: &Scene<'_>,
        span: &Span<'_>,
        offset: f64,
        (place, polynomials): (&mut Place, &mut Polynomials),
    ) {
        polynomials.take(span);
        let theta = span.clock.place_of(offset);
        let contacts = scene.touches.iter().map(|touch| ContactPlace {
            level: touch.level,
            force: 0.0,
            work: 0.0,
        });
        place.contacts.extend(contacts);
        let (mut input, mut viscous) = (0.0, 0.0);
        // Works by Gauss's rule in the variable of the step.
        for (node, weight) in GAUSS {
            let at = node * theta;
            let time = weight * theta * span.clock.span() * span.clock.rate(at);
            polynomials.at(at, place);
            let ground = scene.ground.0 + scene.ground.1 * span.clock.offset(at);
            for (p, m) in place.velocity.iter().zip(&self.constants.modes) {
                for l in 0..WIDTH {
                    input -= time * m.participation[l] * ground * p[l];
                    viscous += time * m.damping[l] * p[l] * p[l];
                }
            }
            for (k, touch) in scene.touches.iter().enumerate() {
                let (force, rate) = self.force(touch, place);
                place.contacts[k].work += time * force * rate;
            }
        }
        place.works = (input, viscous);
        polynomials.at(theta, place);
        let (q, p) = (&place.displacement, &place.velocity);
        restoring(&self.constants.modes, q, p, &mut place.absolute);
        for (k, touch) in scene.touches.iter().enumerate() {
            let (force, _) = self.force(touch, place);
            self.rows.levels[touch.level].add(-force, &mut place.absolute);
            place.contacts[k].force = force;
        }
    }

    /// Motion at an instant, with the forces of all closed levels by their laws.
    fn instant(&self, [q, p]: [&[Lane]; 2], ground: f64, place: &mut Place) {
        place.displacement.copy_from_slice(q);
        place.velocity.copy_from_slice(p);
        (place.works, place.ground) = ((0.0, 0.0), ground);
        restoring(&self.constants.modes, q, p, &mut place.absolute);
        for &level in self.contacts.closed() {
            let Some(contact) = self.contacts.contact(level) else {
                continue;
            };
            let width = self.contacts.width(level);
            let row = &self.rows.levels[level];
            let [closing, rate] = row.dot_two([q, p]);
            let of_level = &self.system.levels()[level];
            let force = contact.force(of_level, closing - width, rate).value;
            row.add(-force, &mut place.absolute);
            let work = 0.0;
            place.contacts.push(ContactPlace { level, force, work });
        }
    }

    /// Force (N) and rate of penetration (m/s) of a closed level.
    fn force(&self, touch: &Touch, place: &Place) -> (f64, f64) {
        let row = &self.rows.levels[touch.level];
        let delta = row.dot(&place.displacement) - touch.width;
        let rate = row.dot(&place.velocity);
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
}

impl Polynomials {
    /// Those of a step.
    fn take(&mut self, span: &Span<'_>) {
        for c in 0..self.displacement.len() {
            for l in 0..WIDTH {
                let at = |motion: &[Vec<Lane>; 4]| -> [f64; 4] {
                    std::array::from_fn(|k| motion[k][c][l])
                };
                let (a, b) = (at(&span.start.motion), at(&span.end.motion));
                self.displacement[c][l] = span.displacement(a, b);
                self.velocity[c][l] = span.velocity(a, b);
            }
        }
    }

    /// Displacements and velocities of the modes at `theta`.
    fn at(&self, theta: f64, place: &mut Place) {
        for (lane, polynomials) in place.displacement.iter_mut().zip(&self.displacement) {
            *lane = Lane::from_fn(|l| value(&polynomials[l], theta));
        }
        for (lane, polynomials) in place.velocity.iter_mut().zip(&self.velocity) {
            *lane = Lane::from_fn(|l| value(&polynomials[l], theta));
        }
    }
}
