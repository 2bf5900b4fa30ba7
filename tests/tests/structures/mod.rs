//! Structures beyond shear buildings, held against converged references of independent
//! codes and against their limits.
#![allow(clippy::print_stdout)]

mod abutment;
mod base_moments;
mod columns;
mod condensed_stiffness;
mod coupled;
mod equal_periods;
mod forces;
mod general;
mod isolated_collapse;
mod isolation;
mod motions;
mod reference;
mod rigid_beside_dampers;
mod torsion;
mod yielding_frames;
