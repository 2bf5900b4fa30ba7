//! Assembly of cases: records and buildings.

mod columns;
mod excitation;
mod lateral;
mod plan;
