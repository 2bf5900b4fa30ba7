//! The verification ladder.
#![allow(clippy::unwrap_used)]

mod any_rows;
mod batch;
mod convergence;
mod event_driven;
mod every_model;
mod floors_in_touch;
mod free_motion;
mod high_exponents;
mod impact_counts;
mod isolated_demand;
mod long_rows;
mod loose_tolerance;
mod moreau_jean;
mod observers;
mod periods_of_steps;
mod properties;
mod random_rows;
mod reference_cases;
mod rigid_accumulation;
mod rigid_held;
mod rigid_impacts;
mod separation_rules;
mod simultaneous_rigid_impacts;
mod sine_case;
mod stiff_contacts;
mod stiff_storeys;
mod structures;
mod towers;
mod traps;
mod yielding;
