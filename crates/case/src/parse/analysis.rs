//! How to compute.

use pounding_catalogue::OUTPUT_STEP;
use schemars::JsonSchema;
use serde::Deserialize;

use crate::document::{Entry, Number, Optional, Positive, Signed, Table, Time};
use crate::located::Located;
use crate::types::Analysis;

/// Method, duration, output
#[derive(Clone, Default, Deserialize, JsonSchema)]
#[serde(rename = "[analysis]")]
pub(super) struct AnalysisTable {
    /// event_driven (default), adaptive, newmark, hht_alpha, runge_kutta_4, or moreau_jean
    /// for rigid impacts
    method: Optional<String>,
    /// Duration (s), by default that of the record
    duration: Optional<Positive<Time>>,
    /// Step of the responses in the result (s), by default 0.01
    output_step: Optional<Positive<Time>>,
    /// Step of fixed-step methods (s)
    step: Optional<Positive<Time>>,
    /// Newmark's beta, by default 1/4
    beta: Optional<Signed<Number>>,
    /// Newmark's gamma, by default 1/2
    gamma: Optional<Signed<Number>>,
    /// Alpha of HHT, -1/3 to 0, by default -0.05
    alpha: Optional<Signed<Number>>,
    /// Theta of Moreau and Jean, 1/2 to 1, by default 1/2
    theta: Optional<Signed<Number>>,
    /// Relative tolerance of the adaptive method, and of the event-driven one inside
    /// contacts, by default 1e-10
    relative_tolerance: Optional<Positive<Number>>,
    /// Allowed energy residual over the largest input energy
    energy_tolerance: Optional<Positive<Number>>,
}

/// A step (s) in place of one that could not be read: a method that needs one has it.
const STEP: f64 = 1.0e-3;

impl From<Table<AnalysisTable>> for Analysis {
    fn from(Table { value, places, .. }: Table<AnalysisTable>) -> Self {
        Self {
            method: value.method.located().unwrap_or_else(|| Located {
                value: "event_driven".to_owned(),
                span: 0..0,
            }),
            duration: value.duration.number(),
            output_step: value.output_step.number().unwrap_or(OUTPUT_STEP),
            step: match value.step.is_wrong() {
                true => Some(STEP),
                false => value.step.number(),
            },
            beta: value.beta.number(),
            gamma: value.gamma.number(),
            alpha: value.alpha.number(),
            theta: value.theta.number(),
            relative_tolerance: value.relative_tolerance.number(),
            energy_tolerance: value.energy_tolerance.number(),
            places,
        }
    }
}
