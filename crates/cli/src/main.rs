//! The pounding command line.
fn main() {}
