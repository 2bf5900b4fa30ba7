//! Assembly of cases: records and buildings.

mod excitation;
mod lateral;
