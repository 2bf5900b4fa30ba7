//! The form of a label, by which a file without its checksum is known too.

/// Start of the line, in a line of its own; the number is the version of its form.
pub const START: &str = "\npounding-label:1 ";
/// Bytes of the longest line.
pub(crate) const LONGEST: u64 = 1 << 16;
