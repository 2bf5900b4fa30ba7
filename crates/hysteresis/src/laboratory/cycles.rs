//! A loop: force and dissipated energy along a path, and what its cycles amount to.

use super::{LaboratoryError, LaboratoryPoint, LoadPath, Specimen, drive_steps};

/// One cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Cycle {
    /// Maximum deformation (m).
    #[cfg_attr(feature = "serde", serde(rename = "greatest_deformation"))]
    pub maximum: f64,
    /// Minimum deformation (m).
    #[cfg_attr(feature = "serde", serde(rename = "least_deformation"))]
    pub minimum: f64,
    /// Maximum absolute force (N).
    pub peak_force: f64,
    /// Energy dissipated (J), without that of cycles within this one.
    pub dissipated: f64,
    /// Difference of the forces at the first peak and at the turning point over the range
    /// (N/m).
    pub secant_stiffness: f64,
    /// Ratio of the viscous damper that would dissipate as much in a harmonic cycle of a
    /// spring of the secant stiffness at resonance, D / (2 pi k a^2) with half the range
    /// for a (Jacobsen, Transactions of the ASME 52 (1930) 169). None without such a
    /// spring.
    pub equivalent_damping_ratio: Option<f64>,
}

/// What a law did on a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Loop {
    /// All states, the new element first.
    pub states: Vec<LaboratoryPoint>,
    /// Its cycles.
    pub cycles: Vec<Cycle>,
}

impl Cycle {
    fn of(states: &[LaboratoryPoint], [before, turn, after]: [usize; 3], dissipated: f64) -> Self {
        let (start, far) = (states[before], states[turn]);
        let range = start.deformation - far.deformation;
        let forces = states[before..=after].iter().map(|s| s.force.abs());
        let mut cycle = Self {
            maximum: start.deformation.max(far.deformation),
            minimum: start.deformation.min(far.deformation),
            peak_force: forces.fold(0.0, f64::max),
            dissipated,
            secant_stiffness: (force_at(states, before) - force_at(states, turn)) / range,
            equivalent_damping_ratio: None,
        };
        cycle.equivalent_damping_ratio = cycle.damping_ratio();
        cycle
    }

    fn damping_ratio(&self) -> Option<f64> {
        let half = 0.5 * (self.maximum - self.minimum);
        let ratio = self.dissipated / (std::f64::consts::TAU * self.secant_stiffness * half * half);
        // A damper alone has no stiffness but round-off.
        let springs = self.secant_stiffness * half > 1.0e-9 * self.peak_force;
        (springs && ratio.is_finite()).then_some(ratio)
    }
}

/// Force at a turning point: the mean of both where the velocity jumps there.
fn force_at(states: &[LaboratoryPoint], index: usize) -> f64 {
    let here = states[index];
    let around = &states[index.saturating_sub(1)..(index + 2).min(states.len())];
    let same = around
        .iter()
        .filter(|s| s.deformation == here.deformation && s.time == here.time);
    let (sum, count) = same.fold((0.0, 0.0), |(sum, count), s| (sum + s.force, count + 1.0));
    sum / count
}

impl Loop {
    /// Drives a new element along a path.
    ///
    /// # Errors
    /// [`LaboratoryError::TooLong`] before the work, [`LaboratoryError::Overflow`] after it.
    pub fn drive(specimen: &Specimen, path: &LoadPath) -> Result<Self, LaboratoryError> {
        specimen.reaches(path.length())?;
        let mut states = vec![LaboratoryPoint {
            time: path.start,
            ..LaboratoryPoint::default()
        }];
        let driven = drive_steps(specimen.law.as_ref(), path.steps.iter().copied());
        let timed = driven.into_iter().zip(&path.times);
        states.extend(timed.map(|(state, &time)| LaboratoryPoint { time, ..state }));
        let overflows = |s: &&LaboratoryPoint| !(s.force.is_finite() && s.dissipated.is_finite());
        if let Some(s) = states.iter().find(overflows) {
            let deformation = s.deformation;
            return Err(LaboratoryError::Overflow { deformation });
        }
        // Those that no later one contains so far: where they begin, and their energy with that of all within.
        let mut outermost: Vec<(usize, f64)> = Vec::new();
        let cycle_without_inner = |&[before, turn, after]: &[usize; 3]| {
            let first_within = outermost.partition_point(|(begin, _)| *begin < before);
            let within = outermost.drain(first_within..).map(|(_, energy)| energy);
            let within: f64 = within.sum();
            let all = states[after].dissipated - states[before].dissipated;
            outermost.push((before, all));
            Cycle::of(&states, [before, turn, after], all - within)
        };
        let cycles = path.cycles.iter().map(cycle_without_inner).collect();
        Ok(Self { states, cycles })
    }

    /// Energy dissipated on the whole path (J).
    #[must_use]
    pub fn dissipated(&self) -> f64 {
        self.states.last().map_or(0.0, |s| s.dissipated)
    }

    /// Maximum absolute force (N).
    #[must_use]
    pub fn maximum_force(&self) -> f64 {
        let forces = self.states.iter().map(|s| s.force.abs());
        forces.fold(0.0, f64::max)
    }
}

/// The history in rows, whose columns are named.
#[cfg(feature = "serde")]
impl serde::Serialize for Loop {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let rows: Vec<_> = self
            .states
            .iter()
            .map(|s| (s.time, s.deformation, s.force, s.dissipated))
            .collect();
        let mut object = serializer.serialize_struct("Loop", 4)?;
        object.serialize_field("cycles", &self.cycles)?;
        object.serialize_field("dissipated", &self.dissipated())?;
        object.serialize_field(
            "history_columns",
            &["time", "deformation", "force", "dissipated"],
        )?;
        object.serialize_field("history", &rows)?;
        object.end()
    }
}
