//! Recorders: sinks that see every accepted step and every finished impact.

use crate::dense_output::{AT_ONCE, ModalStep, Workspace};
use crate::dynamics::{Context, Dynamics, Instant};
use crate::error::TimeHistoryError;
use crate::history::History;
use crate::ledger;
use crate::methods::Method;
use crate::outcome::Impact;
use crate::polynomial::{Polynomial, difference, maximum_above, value};
use crate::response_row::append_motion;
use crate::system::{CLOSE, ElementPlace, SectionPlace, System, Terms};

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

    /// End of the step (s). Times that are the end but for round-off count as the end.
    #[must_use]
    pub fn end(&self) -> f64 {
        match &self.source {
            Source::Method(step) => step.start() + step.step,
            Source::Modes(step, _) => step.end(),
        }
    }

    /// Whether the run ends with this step.
    #[must_use]
    pub fn is_last(&self) -> bool {
        self.last
    }

    /// Appends responses at times inside the step, a row each, by the method's interpolant;
    /// accelerations and forces by the equations of motion there. Several times at once are less
    /// work than one after another where buildings are tall.
    pub fn append(&mut self, times: &[f64], rows: &mut History) {
        match &mut self.source {
            Source::Method(step) => {
                for time in times {
                    step.append(*time, rows);
                }
            }
            Source::Modes(step, workspace) => step.append(times, workspace, rows),
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

    fn append(&mut self, time: f64, rows: &mut History) {
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
        append_state(self.context, time, now, self.state, rows);
    }
}

/// Appends the responses of a full state.
pub(crate) fn append_state(
    context: &mut Context<'_, '_>,
    time: f64,
    now: Instant,
    state: &[f64],
    rows: &mut History,
) {
    let Dynamics { system, layout, .. } = *context.dynamics;
    let ground = now.ground;
    let first = rows.acceleration_absolute.len();
    let mut absolute = std::mem::take(&mut rows.acceleration_absolute);
    absolute.resize(first + layout.dofs, 0.0);
    let own = &mut absolute[first..];
    context
        .dynamics
        .accelerations(context.contacts, now, state, own);
    for (i, a) in own.iter_mut().enumerate() {
        *a += system.ground_on(i, ground);
    }
    let response = rows.response.len();
    let motion = (state, context.dynamics.forces.as_slice());
    let place = (system, layout, context.contacts);
    append_motion(place, (time, ground.first), motion, rows);
    for row in system.acceleration_rows() {
        let SectionPlace::Named(number) = row.place else {
            continue;
        };
        rows.response[response + number] = row.terms().map(|(i, w)| w * own[i]).sum();
    }
    absolute.truncate(first + system.floors());
    rows.acceleration_absolute = absolute;
    if !system.elements().is_empty() {
        append_elements(context, now.elapsed, state, rows);
    }
    let energy = ledger::energy(system, layout, context.contacts, state, now.elapsed);
    rows.energy.push(energy);
}

/// Appends what elements do, and replaces shears of storeys that follow a law.
fn append_elements(
    context: &mut Context<'_, '_>,
    elapsed: Option<f64>,
    state: &[f64],
    rows: &mut History,
) {
    let Dynamics { system, layout, .. } = *context.dynamics;
    let shear = rows.storey_shear.len() - system.floors();
    for (index, element) in system.elements().iter().enumerate() {
        let force = context
            .dynamics
            .element_force(context.contacts, index, state, elapsed);
        let memory = &context.contacts.elements;
        let (_, dissipated) = memory.energy_of(index, (system, layout), state, elapsed);
        rows.element_deformation.push(element.relative(state));
        rows.element_force.push(force);
        rows.element_dissipated.push(dissipated);
        if let (ElementPlace::Storey { .. }, Some(dof)) = (element.place, element.far) {
            rows.storey_shear[shear + dof] = force;
        }
    }
    let forces = &rows.element_force[rows.element_force.len() - system.elements().len()..];
    let response = rows.response.len() - system.named_responses() - system.level_rows().len();
    let moment = rows.base_moment.len() - system.base_moments_before(system.buildings().len());
    for section in system.sections() {
        let sum: f64 = section.elements.iter().map(|(e, w)| w * forces[*e]).sum();
        if section.elements.is_empty() {
            continue;
        }
        match section.place {
            SectionPlace::BaseMoment(building) => {
                rows.base_moment[moment + system.base_moments_before(building)] += sum;
            }
            SectionPlace::Named(number) => rows.response[response + number] += sum,
            SectionPlace::StoreyShear(floor) => rows.storey_shear[shear + floor] += sum,
            SectionPlace::Drift(_) => {}
        }
    }
}

/// A sink for responses.
pub trait Recorder {
    /// Called once before all else with the duration of the run (s).
    ///
    /// # Errors
    /// A run that the recorder could not record; it does not begin.
    fn prepare(&mut self, duration: f64) -> Result<(), TimeHistoryError> {
        let _ = duration;
        Ok(())
    }

    /// Called once with the responses at time zero, a single row.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; it ends the run.
    fn begin(&mut self, system: &System, start: &History) -> Result<(), TimeHistoryError>;

    /// First time (s) at which the motion is wanted: steps that end before it are left out, but
    /// for the last one of the run.
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

    /// Called once after the last step and the last impact, also of a run that failed.
    ///
    /// # Errors
    /// Whatever keeps the recorder from recording; it is the error of a run that had none.
    fn end(&mut self) -> Result<(), TimeHistoryError> {
        Ok(())
    }
}

/// Whether a recorder wants something of a step that ends at this time (s), but for round-off.
pub(crate) fn wants(recorder: &dyn Recorder, end: f64, last: bool) -> bool {
    last || recorder.next_time() <= end * (1.0 + CLOSE)
}

/// Responses of a run at most (bytes before compression): what a disk may have room for.
pub const MAXIMUM_RESPONSES: f64 = 1.0e11;

/// The same in memory: a grid that asks for more is one of a wrong step.
const MOST_IN_MEMORY: f64 = 1.0e10;

/// What takes responses some rows at a time, in order of time.
pub trait HistorySink {
    /// Bytes of rows that it takes of one run at most: [`GridRecorder`] refuses a run that would have
    /// more of them. [`MAXIMUM_RESPONSES`] unless a sink says otherwise, as one may that keeps none.
    fn most_bytes(&self) -> f64 {
        MAXIMUM_RESPONSES
    }

    /// Takes the next rows, at least one. What it leaves of them is dropped.
    ///
    /// # Errors
    /// Whatever keeps the sink from taking them; it ends the run.
    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError>;
}

impl HistorySink for History {
    fn most_bytes(&self) -> f64 {
        MOST_IN_MEMORY
    }

    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        self.append(rows);
        Ok(())
    }
}

impl<S: HistorySink + ?Sized> HistorySink for &mut S {
    fn most_bytes(&self) -> f64 {
        (**self).most_bytes()
    }

    fn take(&mut self, rows: &mut History) -> Result<(), TimeHistoryError> {
        (**self).take(rows)
    }
}

/// Rows that a sink is given at once, at most, and their bytes. Numbers of rows are powers of two,
/// so that blocks are whole chunks of a file.
const BLOCK_ROWS: usize = 1024;
const BLOCK_BYTES: usize = 4 << 20;

/// Gives responses on an even grid of times, from zero to the end of the run, to a sink: to a
/// [`History`] in memory, or to what writes them to a file. One records one run: rows of a second
/// would come behind those of the first.
///
/// A run with so many times that its rows would be more than the sink takes
/// ([`HistorySink::most_bytes`]: 10 GB in memory) ends before its first step with
/// [`TimeHistoryError::ResponsesTooLarge`].
#[derive(Debug, Clone)]
pub struct GridRecorder<S = History> {
    step: f64,
    /// Of the run (s), once it is known.
    duration: f64,
    /// Responses taken.
    count: usize,
    /// What takes them: of the last rows not before the run has ended.
    pub responses: S,
    /// Rows that it has not been given yet, and how many it is given at once.
    block: History,
    rows: usize,
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

impl<S: HistorySink> GridRecorder<S> {
    /// A recorder with this output step (s) into a sink.
    ///
    /// # Errors
    /// If the step is not positive and finite.
    pub fn into_sink(step: f64, sink: S) -> Result<Self, TimeHistoryError> {
        if step.is_finite() && step > 0.0 {
            Ok(Self {
                step,
                duration: 0.0,
                count: 0,
                responses: sink,
                block: History::default(),
                rows: BLOCK_ROWS,
            })
        } else {
            Err(TimeHistoryError::Option {
                option: "output_step",
                value: step,
                reason: "it must be greater than zero, and finite",
            })
        }
    }

    /// Refuses a run whose rows, of so many bytes each, the sink does not take.
    fn check_size(&self, row: usize) -> Result<(), TimeHistoryError> {
        let bytes = self.duration / self.step * row as f64;
        let most = self.responses.most_bytes();
        if bytes <= most {
            return Ok(());
        }
        Err(TimeHistoryError::ResponsesTooLarge {
            step: self.step,
            duration: self.duration,
            bytes,
            most,
        })
    }

    /// Gives the sink what it has not been given yet.
    fn flush(&mut self) -> Result<(), TimeHistoryError> {
        if self.block.is_empty() {
            return Ok(());
        }
        let taken = self.responses.take(&mut self.block);
        self.block.clear();
        taken
    }
}

impl<S: HistorySink> Recorder for GridRecorder<S> {
    fn prepare(&mut self, duration: f64) -> Result<(), TimeHistoryError> {
        self.duration = duration;
        Ok(())
    }

    fn begin(&mut self, _system: &System, start: &History) -> Result<(), TimeHistoryError> {
        let mut first = start.clone();
        let bytes = first.bytes();
        self.check_size(bytes)?;
        self.count = 1;
        self.block.append(&mut first);
        self.rows = BLOCK_ROWS;
        while self.rows > 1 && self.rows * bytes > BLOCK_BYTES {
            self.rows /= 2;
        }
        self.block.reserve(self.rows - 1);
        if self.rows == 1 {
            return self.flush();
        }
        Ok(())
    }

    fn next_time(&self) -> f64 {
        self.count as f64 * self.step
    }

    fn step(&mut self, step: &mut StepView<'_, '_, '_>) -> Result<(), TimeHistoryError> {
        // A grid time within a billionth of the grid beyond the end of the run
        // belongs to it: duration over step is rarely a whole number in binary.
        let slack = if step.is_last() {
            1.0e-9 * self.step
        } else {
            0.0
        };
        // A row at the end of a step belongs to it whatever round-off its time has: what jumps there
        // has not jumped yet.
        let end = step.end() * (1.0 + CLOSE) + slack;
        loop {
            let room = (self.rows - self.block.len()).min(AT_ONCE);
            let mut times = [0.0; AT_ONCE];
            let mut within = 0;
            while within < room {
                let time = (self.count + within) as f64 * self.step;
                // What is not a number is never reached.
                if !(time <= end) {
                    break;
                }
                times[within] = time;
                within += 1;
            }
            if within == 0 {
                return Ok(());
            }
            step.append(&times[..within], &mut self.block);
            self.count += within;
            if self.block.len() == self.rows {
                self.flush()?;
            }
            if within < room {
                return Ok(());
            }
        }
    }

    fn end(&mut self) -> Result<(), TimeHistoryError> {
        self.flush()
    }
}
