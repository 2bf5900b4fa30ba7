//! The command line, by running the program.

mod argument_units;
mod bad_input;
mod bad_laws;
mod calibrate;
mod compare;
mod documents;
mod examples;
mod files;
mod gap;
mod hysteresis;
mod impact;
mod levels;
mod links_and_rows;
mod messages;
mod model_pages;
mod motion;
mod plausibility;
mod report;
mod sizes;
mod stiffness;
mod studies;
mod support;
mod tables;
mod verify;
mod widths;
mod yielding_examples;
