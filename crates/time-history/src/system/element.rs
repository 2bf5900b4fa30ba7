//! A storey, a frame or a level of a link whose force follows a law with memory.
//!
//! An element pulls together two places, the *far* one, whose displacement makes its
//! deformation greater, and the *near* one. The matrices of the buildings carry the
//! initial stiffness of a storey or frame already, so that an element adds only what its law
//! departs from that.

use std::sync::Arc;

use pounding_hysteresis::{History, HysteresisLaw, Motion, Response};

use super::{LevelPlace, Terms};
use crate::polynomial::{COEFFICIENTS, Polynomial, difference};

/// Round-off of a coefficient over the largest of the motions that it is made from.
const ROUND_OFF: f64 = 32.0 * f64::EPSILON;

/// Where an element sits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ElementPlace {
    /// The storey of a building, both from zero.
    Storey {
        /// Index in [`System::buildings`](super::System::buildings).
        building: usize,
        /// Storey from the bottom.
        storey: usize,
    },
    /// A frame of a building that turns in plan, in one storey.
    Frame {
        /// Index in [`System::buildings`](super::System::buildings).
        building: usize,
        /// Index in [`ShearBuilding::yielding_frames`](pounding_shear_building::ShearBuilding::yielding_frames).
        frame: usize,
    },
    /// A level of a link, both from zero.
    Link {
        /// Index in [`System::links`](super::System::links).
        link: usize,
        /// Level within the link, from the bottom.
        level: usize,
    },
}

impl ElementPlace {
    /// Whether it is a storey or a frame of this building.
    pub(crate) fn is_in(self, of: usize) -> bool {
        match self {
            Self::Storey { building, .. } | Self::Frame { building, .. } => building == of,
            Self::Link { .. } => false,
        }
    }
}

/// A storey, a frame or a level of a link whose force follows a law with memory.
#[derive(Debug, Clone)]
pub struct Element {
    /// Where it sits.
    pub place: ElementPlace,
    /// Degree of freedom whose displacement deforms the element positively; `None`
    /// moves with the ground.
    pub far: Option<usize>,
    /// Degree of freedom at the other end; `None` moves with the ground.
    pub near: Option<usize>,
    /// What the deformation holds beside both ends: of a storey the motion of a foundation, of a frame
    /// rotations and the floor below.
    pub(crate) terms: Terms,
    /// Storeys and elevations of both ends of a level of a link.
    pub(crate) level_place: Option<LevelPlace>,
    /// The law: force (N) of the deformation far minus near (m).
    pub law: Arc<dyn HysteresisLaw>,
    /// Deformation (m) at which it begins to yield, if its law has one.
    pub yield_deformation: Option<f64>,
    /// Part of its stiffness that the matrices carry (N/m).
    pub(crate) carried: f64,
    /// Place of its first internal variable among all.
    pub(crate) first_variable: usize,
}

impl Element {
    /// Far minus near of any quantity given per degree of freedom.
    pub(crate) fn relative(&self, x: &[f64]) -> f64 {
        let at = |dof: Option<usize>| dof.map_or(0.0, |i| x[i]);
        let of_ends = at(self.far) - at(self.near);
        if self.terms.is_empty() {
            return of_ends;
        }
        of_ends + self.terms.sum_of(|i| x[i])
    }

    pub(crate) fn motion(&self, u: &[f64], v: &[f64]) -> Motion {
        Motion {
            deformation: self.relative(u),
            velocity: self.relative(v),
        }
    }

    /// Adds a force that pulls its ends together.
    pub(crate) fn pull(&self, force: f64, net: &mut [f64]) {
        if let Some(i) = self.far {
            net[i] -= force;
        }
        if let Some(i) = self.near {
            net[i] += force;
        }
        self.terms.push(force, net);
    }

    /// Its deformation (offset zero) or the rate of it (offset of the velocities). What is
    /// round-off of the motions of its ends, which may be far greater, is left out.
    pub(crate) fn polynomial(
        &self,
        component: impl Fn(usize) -> Polynomial,
        offset: usize,
    ) -> Polynomial {
        let at = |dof: Option<usize>| dof.map_or([0.0; COEFFICIENTS], |i| component(offset + i));
        let (far, near) = (at(self.far), at(self.near));
        let mut largest = far.iter().chain(&near).fold(0.0_f64, |m, c| m.max(c.abs()));
        let mut p = difference(&far, &near);
        for (i, w) in self.terms.pushed.iter().chain(&self.terms.ground) {
            for (sum, c) in p.iter_mut().zip(component(offset + i)) {
                *sum += w * c;
                largest = largest.max((w * c).abs());
            }
        }
        for c in &mut p[1..] {
            if c.abs() < ROUND_OFF * largest {
                *c = 0.0;
            }
        }
        p
    }

    /// Law of the element at a state. Within a step of a method that locates events,
    /// and at its ends, the branch in the history is held (`elapsed` is `None`);
    /// within a step of one that does not, the law is followed over the `elapsed`
    /// seconds since the history was committed.
    pub(crate) fn response(
        &self,
        history: &History,
        scratch: &mut History,
        (motion, variables): (Motion, &[f64]),
        elapsed: Option<f64>,
    ) -> Response {
        match elapsed {
            Some(step) => self.law.trial(history, scratch, motion, step),
            None => self.law.force(history, motion, variables),
        }
    }
}
