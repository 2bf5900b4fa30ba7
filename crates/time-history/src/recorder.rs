//! Recorders: sinks that see every accepted step and every finished impact.

use std::ops::Range;

use crate::contact::Contacts;
use crate::dense_output::{AT_ONCE, ModalStep, Workspace};
use crate::dynamics::{Dynamics, Instant, Layout};
use crate::elements::ElementPlace;
use crate::error::TimeHistoryError;
use crate::ledger;
use crate::methods::{Context, Method};
use crate::outcome::{Energy, Impact};
use crate::polynomial::{Polynomial, difference, maximum_above, value};
use crate::system::{SectionPlace, System, Terms};
use pounding_shear_building::ResponseKind;

/// Responses at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Sample {
    /// Time (s).
    pub time: f64,
    /// Ground acceleration (m/s2).
    pub ground_acceleration: f64,
    /// Floor displacements relative to the ground (m), buildings from the left.
    pub displacement: Vec<f64>,
    /// Floor velocities relative to the ground (m/s).
    pub velocity: Vec<f64>,
    /// Absolute floor accelerations (m/s2).
    pub acceleration_absolute: Vec<f64>,
    /// Penetration of every contact level (m), negative while open.
    pub penetration: Vec<f64>,
    /// Contact force of every level (N), zero while open.
    pub force: Vec<f64>,
    /// Storey shears (N), of the law where a storey has one, else elastic; buildings
    /// from the left.
    pub storey_shear: Vec<f64>,
    /// Overturning moment at the base (N m) of every building with a stiffness matrix, from
    /// the left.
    pub base_moment: Vec<f64>,
    /// Drift of every storey (m) of buildings whose drifts are not the differences of their
    /// floors ([`pounding_shear_building::ShearBuilding::drifts`]), from the left.
    pub drift: Vec<f64>,
    /// Responses with names of all buildings, from the left
    /// ([`pounding_shear_building::ShearBuilding::responses`]), then those of all contact levels
    /// in the order in which they were added ([`System::add_level_response`]).
    pub response: Vec<f64>,
    /// Deformation of every element (m), in the order of [`System::elements`].
    pub element_deformation: Vec<f64>,
    /// Force of every element (N).
    pub element_force: Vec<f64>,
    /// Energy that every element has dissipated so far (J).
    pub element_dissipated: Vec<f64>,
    /// Energy ledger.
    pub energy: Energy,
}

/// An accepted step, open to interpolation.
pub struct StepView<'a, 'b, 'c> {
    source: Source<'a, 'b, 'c>,
    last: bool,
}

/// What the step holds.
enum Source<'a, 'b, 'c> {
    /// The polynomials of a method.
    Method(MethodStep<'a, 'b, 'c>),
    /// The motion of the modes.
    Modes(&'a ModalStep<'a>, &'a mut Workspace),
}

/// A step of a method in the coordinates of the floors.
pub(crate) struct MethodStep<'a, 'b, 'c> {
    pub(crate) context: &'a mut Context<'b, 'c>,
    pub(crate) method: &'a dyn Method,
    pub(crate) state: &'a mut [f64],
    pub(crate) tau: f64,
    pub(crate) step: f64,
}

impl<'a, 'b, 'c> StepView<'a, 'b, 'c> {
    pub(crate) fn of_method(step: MethodStep<'a, 'b, 'c>, last: bool) -> Self {
        let source = Source::Method(step);
        Self { source, last }
    }

    pub(crate) fn of_modes(
        step: &'a ModalStep<'a>,
        workspace: &'a mut Workspace,
        last: bool,
    ) -> Self {
        let source = Source::Modes(step, workspace);
        Self { source, last }
    }

    /// Start of the step (s).
    #[must_use]
    pub fn start(&self) -> f64 {
        match &self.source {
            Source::Method(step) => step.start(),
            Source::Modes(step, _) => step.start,
        }
    }

    /// End of the step (s).
    #[must_use]
    pub fn end(&self) -> f64 {
        match &self.source {
            Source::Method(step) => step.start() + step.step,
            Source::Modes(step, _) => step.start + step.length,
        }
    }

    /// Whether the run ends with this step.
    #[must_use]
    pub fn is_last(&self) -> bool {
        self.last
    }

    /// Responses at a time inside the step, by the method's interpolant;
    /// accelerations and forces by the equations of motion there.
    pub fn sample(&mut self, time: f64, out: &mut Sample) {
        self.samples(&[time], std::slice::from_mut(out));
    }

    /// The same at several times, into as many samples: less work than one after another
    /// where buildings are tall.
    pub fn samples(&mut self, times: &[f64], out: &mut [Sample]) {
        match &mut self.source {
            Source::Method(step) => {
                for (time, out) in times.iter().zip(out) {
                    step.sample(*time, out);
                }
            }
            Source::Modes(step, workspace) => step.samples(times, workspace, out),
        }
    }

    /// Maximum value above `floor` (m) that the displacement of the degree of freedom `left`
    /// less that of `right` takes within the step, with its time (s). `None` is the ground.
    pub(crate) fn approach(
        &mut self,
        (left, right): (Option<usize>, Option<usize>),
        terms: &Terms,
        floor: f64,
    ) -> Option<(f64, f64)> {
        match &mut self.source {
            Source::Method(step) => {
                let of = |dof: Option<usize>| {
                    dof.map_or(Polynomial::default(), |i| *step.method.polynomial(i))
                };
                let mut approach = difference(&of(left), &of(right));
                terms.add_polynomials(|i| step.method.polynomial(i), &mut approach);
                let found = maximum_above(&approach, floor);
                found.map(|(theta, top)| (step.start() + theta * step.step, top))
            }
            Source::Modes(step, workspace) => step.approach((left, right), floor, workspace),
        }
    }
}

impl MethodStep<'_, '_, '_> {
    fn start(&self) -> f64 {
        self.context.segment.start + self.tau
    }

    fn sample(&mut self, time: f64, out: &mut Sample) {
        let offset = (time - self.start()).clamp(0.0, self.step);
        let theta = if self.step > 0.0 {
            offset / self.step
        } else {
            0.0
        };
        for (i, y) in self.state.iter_mut().enumerate() {
            *y = value(self.method.polynomial(i), theta);
        }
        let ground = self.context.segment.ground(self.tau + offset);
        let now = Instant::within(ground, self.method.information().implicit, offset);
        fill_sample(self.context, time, now, self.state, out);
    }
}

/// Fills a sample from a full state.
pub(crate) fn fill_sample(
    context: &mut Context<'_, '_>,
    time: f64,
    now: Instant,
    state: &[f64],
    out: &mut Sample,
) {
    let Dynamics { system, layout, .. } = *context.dynamics;
    let mut absolute = std::mem::take(&mut out.acceleration_absolute);
    absolute.resize(layout.dofs, 0.0);
    let ground = now.ground;
    context
        .dynamics
        .accelerations(context.contacts, now, state, &mut absolute);
    for (i, a) in absolute.iter_mut().enumerate() {
        *a += system.ground_on(i, ground);
    }
    let motion = (state, context.dynamics.forces.as_slice());
    fill(system, context.contacts, (time, ground.first), motion, out);
    for row in system.acceleration_rows() {
        let SectionPlace::Named(number) = row.place else {
            continue;
        };
        out.response[number] = row.terms().map(|(i, w)| w * absolute[i]).sum();
    }
    absolute.truncate(system.floors());
    out.acceleration_absolute = absolute;
    if !system.elements().is_empty() {
        elements(context, now.elapsed, state, out);
        out.energy = ledger::energy(system, layout, context.contacts, state, now.elapsed);
    }
}

/// Fills a sample of linear buildings, but for accelerations, from a full state and the contact
/// forces of all levels, of which those that are closed count.
pub(crate) fn fill(
    system: &System,
    contacts: &Contacts,
    (time, ground): (f64, f64),
    (state, forces): (&[f64], &[f64]),
    out: &mut Sample,
) {
    let layout = Layout::of(system);
    let n = layout.dofs;
    let (u, v) = (&state[..n], &state[n..2 * n]);
    (out.time, out.ground_acceleration) = (time, ground);
    out.displacement.clear();
    out.displacement.extend_from_slice(&u[..system.floors()]);
    out.velocity.clear();
    out.velocity.extend_from_slice(&v[..system.floors()]);
    out.penetration.clear();
    let penetration = |l| contacts.penetration(system, l, u);
    out.penetration.extend((0..layout.levels).map(penetration));
    out.force.clear();
    out.force.resize(layout.levels, 0.0);
    for &l in contacts.closed() {
        out.force[l] = forces[l];
    }
    out.storey_shear.clear();
    out.base_moment.clear();
    out.drift.clear();
    out.response.clear();
    out.response.resize(system.named_responses(), 0.0);
    for row in system.level_rows() {
        let sum: f64 = row.terms.iter().map(|(i, w)| w * u[*i]).sum();
        out.response.push(sum + row.by_force * out.force[row.level]);
    }
    let mut sections = system.sections().iter();
    for (building, range) in system.buildings().iter().zip(system.offsets().windows(2)) {
        let mut below = 0.0;
        if building.stiffness().is_empty() {
            let shears = sections.by_ref().take(building.storeys());
            out.storey_shear.extend(shears.map(|s| s.at(u)));
            out.base_moment.extend(sections.next().map(|s| s.at(u)));
            let rows = building.drifts().map_or(0, <[_]>::len);
            let drifts = sections.by_ref().take(rows);
            out.drift.extend(drifts.map(|s| s.at(u)));
            let named = building.responses().iter();
            let named = named
                .filter(|r| r.kind == ResponseKind::Displacement)
                .count();
            for row in sections.by_ref().take(named) {
                if let SectionPlace::Named(number) = row.place {
                    out.response[number] = row.at(u);
                }
            }
            continue;
        }
        for (k, u) in building.stiffness().iter().zip(&u[range[0]..range[1]]) {
            out.storey_shear.push(k * (u - below));
            below = *u;
        }
    }
    if system.elements().is_empty() {
        out.energy = ledger::energy(system, layout, contacts, state, None);
    }
}

/// What elements do, and shears of storeys that follow a law.
fn elements(context: &mut Context<'_, '_>, elapsed: Option<f64>, state: &[f64], out: &mut Sample) {
    let Dynamics { system, layout, .. } = *context.dynamics;
    out.element_deformation.clear();
    out.element_force.clear();
    out.element_dissipated.clear();
    for (index, element) in system.elements().iter().enumerate() {
        let force = context
            .dynamics
            .element_force(context.contacts, index, state, elapsed);
        let memory = &context.contacts.elements;
        let (_, dissipated) = memory.energy_of(index, (system, layout), state, elapsed);
        out.element_deformation.push(element.relative(state));
        out.element_force.push(force);
        out.element_dissipated.push(dissipated);
        if let (ElementPlace::Storey { .. }, Some(dof)) = (element.place, element.far) {
            out.storey_shear[dof] = force;
        }
    }
}

/// A sink for responses.
pub trait Recorder {
    /// Called once with the state at time zero.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; it ends the run.
    fn begin(&mut self, system: &System, start: &Sample) -> Result<(), TimeHistoryError>;

    /// Time (s) up to which steps need not be shown: those that end before it are left out.
    fn next_time(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// Called for accepted steps in order of time; what needs no contact may be some samples
    /// of the ground motion at once.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; it ends the run.
    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError>;

    /// Called for every impact once its floors have parted and closed again, or at the end
    /// of the run: until then the next contact may belong to it.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; it ends the run.
    fn impact(&mut self, impact: &Impact) -> Result<(), TimeHistoryError> {
        let _ = impact;
        Ok(())
    }
}

/// Responses at many times: one list per quantity, row after row in order of time. A row of
/// floors holds the buildings from the left, one of levels or elements their order in the
/// [`System`]. Units are those of [`Sample`].
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct History {
    /// Times (s).
    pub time: Vec<f64>,
    /// Ground acceleration (m/s2).
    pub ground_acceleration: Vec<f64>,
    /// Floor displacements relative to the ground (m).
    pub displacement: Vec<f64>,
    /// Floor velocities relative to the ground (m/s).
    pub velocity: Vec<f64>,
    /// Absolute floor accelerations (m/s2).
    pub acceleration_absolute: Vec<f64>,
    /// Penetration of every contact level (m), negative while open.
    pub penetration: Vec<f64>,
    /// Contact force of every level (N).
    pub force: Vec<f64>,
    /// Storey shears (N).
    pub storey_shear: Vec<f64>,
    /// Overturning moment at the base (N m) of every building with a stiffness matrix, from
    /// the left.
    pub base_moment: Vec<f64>,
    /// Drift of every storey (m) of buildings whose drifts are rows of their own.
    pub drift: Vec<f64>,
    /// Responses with names of all buildings, then of all contact levels.
    pub response: Vec<f64>,
    /// Deformation of every element (m).
    pub element_deformation: Vec<f64>,
    /// Force of every element (N).
    pub element_force: Vec<f64>,
    /// Energy that every element has dissipated so far (J).
    pub element_dissipated: Vec<f64>,
    /// Energy ledger.
    pub energy: Vec<Energy>,
}

impl History {
    /// Number of times.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time.is_empty()
    }

    /// Removes all rows; what they took of memory is kept for others.
    pub fn clear(&mut self) {
        for list in [
            &mut self.time,
            &mut self.ground_acceleration,
            &mut self.displacement,
            &mut self.velocity,
            &mut self.acceleration_absolute,
            &mut self.penetration,
            &mut self.force,
            &mut self.storey_shear,
            &mut self.base_moment,
            &mut self.drift,
            &mut self.response,
            &mut self.element_deformation,
            &mut self.element_force,
            &mut self.element_dissipated,
        ] {
            list.clear();
        }
        self.energy.clear();
    }

    /// Some columns of one of the lists, row after row.
    #[must_use]
    pub fn columns(&self, values: &[f64], range: Range<usize>) -> Vec<f64> {
        let width = values.len() / self.len().max(1);
        if width == 0 {
            return Vec::new();
        }
        let rows = values.chunks_exact(width);
        let chosen = rows.flat_map(|row| row[range.clone()].iter().copied());
        chosen.collect()
    }

    /// One column of one of the lists.
    #[must_use]
    pub fn column(&self, values: &[f64], index: usize) -> Vec<f64> {
        self.columns(values, index..index + 1)
    }

    /// Appends a row to every list.
    pub fn push(&mut self, sample: &Sample) {
        self.time.push(sample.time);
        self.ground_acceleration.push(sample.ground_acceleration);
        for (list, row) in [
            (&mut self.displacement, &sample.displacement),
            (&mut self.velocity, &sample.velocity),
            (
                &mut self.acceleration_absolute,
                &sample.acceleration_absolute,
            ),
            (&mut self.penetration, &sample.penetration),
            (&mut self.force, &sample.force),
            (&mut self.storey_shear, &sample.storey_shear),
            (&mut self.base_moment, &sample.base_moment),
            (&mut self.drift, &sample.drift),
            (&mut self.response, &sample.response),
            (&mut self.element_deformation, &sample.element_deformation),
            (&mut self.element_force, &sample.element_force),
            (&mut self.element_dissipated, &sample.element_dissipated),
        ] {
            list.extend_from_slice(row);
        }
        self.energy.push(sample.energy);
    }
}

/// What takes responses one after another, in order of time.
pub trait SampleSink {
    /// Takes the next one.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking it; it ends the run.
    fn take(&mut self, sample: &Sample) -> Result<(), TimeHistoryError>;
}

impl SampleSink for History {
    fn take(&mut self, sample: &Sample) -> Result<(), TimeHistoryError> {
        self.push(sample);
        Ok(())
    }
}

impl<S: SampleSink + ?Sized> SampleSink for &mut S {
    fn take(&mut self, sample: &Sample) -> Result<(), TimeHistoryError> {
        (**self).take(sample)
    }
}

/// Gives responses on an even grid of times, from zero to the end of the run, to a sink: to a
/// [`History`] in memory, or to what writes them to a file.
#[derive(Debug, Clone)]
pub struct GridRecorder<S = History> {
    step: f64,
    /// Responses taken.
    count: usize,
    /// What takes them.
    pub responses: S,
    /// Work space for a few of them.
    samples: [Sample; AT_ONCE],
}

impl GridRecorder {
    /// A recorder into memory with this output step (s).
    ///
    /// # Errors
    /// If the step is not positive and finite.
    pub fn new(step: f64) -> Result<Self, TimeHistoryError> {
        Self::into_sink(step, History::default())
    }
}

impl<S: SampleSink> GridRecorder<S> {
    /// A recorder with this output step (s) into a sink.
    ///
    /// # Errors
    /// If the step is not positive and finite.
    pub fn into_sink(step: f64, sink: S) -> Result<Self, TimeHistoryError> {
        if step.is_finite() && step > 0.0 {
            Ok(Self {
                step,
                count: 0,
                responses: sink,
                samples: Default::default(),
            })
        } else {
            Err(TimeHistoryError::Option {
                option: "output_step",
                value: step,
                reason: "it must be greater than zero",
            })
        }
    }
}

impl<S: SampleSink> Recorder for GridRecorder<S> {
    fn begin(&mut self, _system: &System, start: &Sample) -> Result<(), TimeHistoryError> {
        self.count = 1;
        self.responses.take(start)
    }

    fn next_time(&self) -> f64 {
        // The end of the run is met but for round-off.
        (self.count as f64 - 1.0e-9) * self.step
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        // A grid time within a billionth of the grid beyond the end of the run
        // belongs to it: duration over step is rarely a whole number in binary.
        let slack = if step.is_last() {
            1.0e-9 * self.step
        } else {
            0.0
        };
        let end = step.end() + slack;
        loop {
            let next = self.count;
            let times: [f64; AT_ONCE] = std::array::from_fn(|k| (next + k) as f64 * self.step);
            let within = times.iter().take_while(|time| !(**time > end)).count();
            if within == 0 {
                return Ok(());
            }
            let samples = &mut self.samples[..within];
            step.samples(&times[..within], samples);
            self.count += within;
            for sample in samples {
                self.responses.take(sample)?;
            }
        }
    }
}
