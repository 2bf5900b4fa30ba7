//! Tests of this crate, one program.

mod structures;
