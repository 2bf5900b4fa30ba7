//! Exit codes of the program, and of its children beside.

/// The answer is "no".
pub const NO: u8 = 1;
/// Bad input.
pub const INPUT: u8 = 2;
/// The computation failed.
pub const COMPUTATION: u8 = 3;
/// Output could not be written.
pub const OUTPUT: u8 = 4;
/// A signal ended the command.
pub const INTERRUPTED: u8 = 5;
/// How a child ends that was to read the result of a study, and finds runs that are to be made.
pub const RUNS_ARE_LEFT: u8 = 6;
/// Exit codes that say what they say everywhere, and that one; a panic has another.
pub const OWN_CODES: std::ops::RangeInclusive<i32> = 0..=6;
/// How a child ends that has reached the limit: what it listens to says so by a signal.
pub const OUT_OF_PROCESSOR_TIME: i32 = 9;
