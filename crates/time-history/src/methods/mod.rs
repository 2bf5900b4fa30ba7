//! The integration methods behind one seam: compute a trial step, interpolate
//! inside it, accept it; events and their location belong to the driver.

mod adaptive;
mod chain;
mod effective_mass;
mod event_driven;
mod modal_series;
mod moreau_jean;
mod newmark;
mod runge_kutta_4;
mod taylor;

pub(crate) use adaptive::Adaptive;
pub(crate) use event_driven::{EventDriven, SERIES};
pub(crate) use modal_series::LARGE;
pub(crate) use moreau_jean::MoreauJean;
pub(crate) use newmark::Newmark;
pub(crate) use runge_kutta_4::RungeKutta4;

use crate::dynamics::Context;
use crate::polynomial::Polynomial;
use crate::system::Segment;

/// What a method is and can do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Information {
    /// Name in the case file.
    pub name: &'static str,
    /// A title for people.
    pub title: &'static str,
    /// Order of convergence between events.
    pub order: usize,
    /// Whether a step solves equations.
    pub implicit: bool,
    /// Whether the method chooses its steps by an error estimate.
    pub adaptive: bool,
}

/// Judgement of a trial step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// The step may be accepted.
    Accept,
    /// Too inaccurate, or its equations did not converge: try this step (s).
    Retry(f64),
}

/// Work counts of a method.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    pub evaluations: u64,
    pub newton_iterations: u64,
}

/// One integration method with its work space.
pub(crate) trait Method {
    fn information(&self) -> Information;
    /// Step to try from `tau` in the context's segment (s).
    fn propose(&mut self, context: &Context<'_, '_>, tau: f64, state: &[f64]) -> f64;
    /// Computes a trial step from `state` at `tau`.
    fn trial(
        &mut self,
        context: &mut Context<'_, '_>,
        tau: f64,
        state: &[f64],
        step: f64,
        new_state: &mut [f64],
    ) -> Verdict;
    /// Makes [`Method::polynomial`] valid for the last trial step.
    fn prepare_interpolant(&mut self, context: &mut Context<'_, '_>, tau: f64);
    /// Component `i` of the state over the last trial step.
    fn polynomial(&self, i: usize) -> &Polynomial;
    /// The last trial step is taken; `cut` if an event ended it.
    fn accept(&mut self, cut: bool);
    /// The right-hand side changed at the current state. `smooth` is false where
    /// the force starts with a power of time that no polynomial follows.
    fn restart(&mut self, smooth: bool);
    fn counts(&self) -> Counts;
    /// Whether contact-free motion may be left to the exact step of the modes.
    fn flies(&self) -> bool {
        false
    }
    /// Impulse of every level in the last trial step (N s), for a method that treats
    /// contacts itself; `None` where the driver locates them.
    fn step_impulses(&self) -> Option<&[f64]> {
        None
    }
}

/// Next grid point of a fixed step: the segment is divided evenly into steps of
/// at most `step`; after an event the remainder leads back to the grid.
pub(crate) fn step_to_grid(segment: &Segment, tau: f64, step: f64) -> f64 {
    let divisions = (segment.length / step - 1.0e-9).ceil().max(1.0);
    let even = segment.length / divisions;
    // One part in 1e9 of a step away from a grid point counts as on it.
    let next = (tau / even + 1.0e-9).floor() + 1.0;
    let target = if next >= divisions {
        segment.length
    } else {
        next * even
    };
    target - tau
}
