//! Assembly of cases: records and buildings.
#![allow(clippy::unwrap_used)]

mod across;
mod columns;
mod excitation;
mod forces;
mod given_files;
mod lateral;
mod level_parameters;
mod plan;
mod spring;
mod warnings;
