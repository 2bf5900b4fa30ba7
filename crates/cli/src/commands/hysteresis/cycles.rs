//! A loop: force and dissipated energy along a path, and what its cycles amount to.

use crate::tables::Table;
use comfy_table::CellAlignment;
use pounding_hysteresis::HysteresisLaw;
use serde_json::{Value, json};

use super::motion::Path;
use crate::commands::impact::numbers::significant;

/// One state on the path.
#[derive(Debug, Clone, Copy, Default)]
pub struct State {
    /// Time (s).
    pub time: f64,
    /// Deformation (m).
    pub deformation: f64,
    /// Force (N).
    pub force: f64,
    /// Energy dissipated since the start (J).
    pub dissipated: f64,
}

/// One cycle.
#[derive(Debug, Clone, Copy)]
pub struct Cycle {
    /// Maximum deformation (m).
    pub maximum: f64,
    /// Minimum deformation (m).
    pub minimum: f64,
    /// Maximum absolute force (N).
    pub peak_force: f64,
    /// Energy dissipated (J).
    pub dissipated: f64,
    /// Difference of the forces at the first peak and at the turning point over the range
    /// (N/m).
    pub secant_stiffness: f64,
}

/// What a law did on a path.
pub struct Loop {
    /// All states, the new element first.
    pub states: Vec<State>,
    /// Its cycles.
    pub cycles: Vec<Cycle>,
    description: String,
}

impl Cycle {
    fn of(states: &[State], [before, turn, after]: [usize; 3]) -> Self {
        let (start, far, end) = (states[before], states[turn], states[after]);
        let range = start.deformation - far.deformation;
        let forces = states[before..=after].iter().map(|s| s.force.abs());
        Self {
            maximum: start.deformation.max(far.deformation),
            minimum: start.deformation.min(far.deformation),
            peak_force: forces.fold(0.0, f64::max),
            dissipated: end.dissipated - start.dissipated,
            secant_stiffness: (force_at(states, before) - force_at(states, turn)) / range,
        }
    }

    /// Ratio of the viscous damper that would dissipate as much in a harmonic cycle of a
    /// spring of the secant stiffness at resonance, D / (2 pi k a^2) with half the range
    /// for a (Jacobsen, Transactions of the ASME 52 (1930) 169). None without such a
    /// spring.
    pub fn equivalent_damping_ratio(&self) -> Option<f64> {
        let half = 0.5 * (self.maximum - self.minimum);
        let ratio = self.dissipated / (std::f64::consts::TAU * self.secant_stiffness * half * half);
        // A damper alone has no stiffness but round-off.
        let springs = self.secant_stiffness * half > 1.0e-9 * self.peak_force;
        (springs && ratio.is_finite()).then_some(ratio)
    }
}

/// Force at a turning point: the mean of both where the velocity jumps there.
fn force_at(states: &[State], index: usize) -> f64 {
    let here = states[index];
    let around = &states[index.saturating_sub(1)..(index + 2).min(states.len())];
    let same = around
        .iter()
        .filter(|s| s.deformation == here.deformation && s.time == here.time);
    let (sum, count) = same.fold((0.0, 0.0), |(sum, count), s| (sum + s.force, count + 1.0));
    sum / count
}

impl Loop {
    /// Drives a new element along the path.
    pub fn drive(law: &dyn HysteresisLaw, path: Path) -> Self {
        let mut committed = law.virgin();
        let mut candidate = committed.clone();
        let mut states = vec![State::default()];
        let mut time = 0.0;
        for step in &path.steps {
            let response = law.trial(&committed, &mut candidate, step.motion, step.duration);
            committed.commit(&mut candidate);
            time += step.duration;
            states.push(State {
                time,
                deformation: step.motion.deformation,
                force: response.force,
                dissipated: law.dissipated_energy(&committed, step.motion, committed.variables()),
            });
        }
        let cycles = path.cycles.iter().map(|c| Cycle::of(&states, *c)).collect();
        Self {
            states,
            cycles,
            description: path.description,
        }
    }

    fn dissipated(&self) -> f64 {
        self.states.last().map_or(0.0, |s| s.dissipated)
    }

    /// The cycles in a table, for people.
    pub fn text(&self) -> String {
        let mut table = Table::new();
        table.set_header([
            "cycle",
            "from (mm)",
            "to (mm)",
            "peak force (kN)",
            "dissipated (J)",
            "secant stiffness (kN/m)",
            "equivalent damping (%)",
        ]);
        for column in table.column_iter_mut() {
            column.set_cell_alignment(CellAlignment::Right);
        }
        for (i, cycle) in self.cycles.iter().enumerate() {
            table.add_row(std::iter::once((i + 1).to_string()).chain(cycle.cells(significant)));
        }
        let peak = self.states.iter().map(|s| s.force.abs());
        let total = format!(
            "maximum force {} kN, dissipated in all {} J\n",
            significant(1.0e-3 * peak.fold(0.0, f64::max)),
            significant(self.dissipated())
        );
        if self.cycles.is_empty() {
            return format!("\nThe history closes no cycle.\n{total}");
        }
        format!("\n{}\n{table}\n{total}", self.description)
    }

    /// For machines, SI.
    pub fn json(&self) -> Value {
        let cycles: Vec<_> = self
            .cycles
            .iter()
            .map(|c| {
                json!({
                    "greatest_deformation": c.maximum, "least_deformation": c.minimum,
                    "peak_force": c.peak_force, "dissipated": c.dissipated,
                    "secant_stiffness": c.secant_stiffness,
                    "equivalent_damping_ratio": c.equivalent_damping_ratio(),
                })
            })
            .collect();
        let states: Vec<_> = self
            .states
            .iter()
            .map(|s| json!([s.time, s.deformation, s.force, s.dissipated]))
            .collect();
        json!({
            "cycles": cycles, "dissipated": self.dissipated(),
            "history_columns": ["time", "deformation", "force", "dissipated"],
            "history": states,
        })
    }
}

impl Cycle {
    /// Ends (mm), force (kN), energy (J), stiffness (kN/m) and damping (%), as texts.
    pub fn cells(&self, number: fn(f64) -> String) -> [String; 6] {
        let range = self.maximum - self.minimum;
        // What is round-off beside the work of the peak force is shown as nothing.
        let shown = |value: f64, scale: f64| {
            let value = if value.abs() < 1.0e-11 * scale {
                0.0
            } else {
                value
            };
            number(value)
        };
        [
            number(1.0e3 * self.maximum),
            number(1.0e3 * self.minimum),
            number(1.0e-3 * self.peak_force),
            shown(self.dissipated, self.peak_force * range),
            shown(1.0e-3 * self.secant_stiffness, self.peak_force / range),
            self.equivalent_damping_ratio()
                .map_or_else(|| "-".to_owned(), |ratio| number(100.0 * ratio)),
        ]
    }
}
