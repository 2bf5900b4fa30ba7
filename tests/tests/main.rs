//! The verification ladder.

mod any_rows;
mod batch;
mod convergence;
mod event_driven;
mod every_model;
mod floors_in_touch;
mod free_motion;
mod impact_counts;
mod isolated_demand;
mod long_rows;
mod loose_tolerance;
mod moreau_jean;
mod observers;
mod properties;
mod random_rows;
mod reference_cases;
mod rigid_accumulation;
mod rigid_held;
mod rigid_impacts;
mod separation_rules;
mod sine_case;
mod stiff_contacts;
mod structures;
mod towers;
mod traps;
mod yielding;
