//! What is known of a record format without reading it.

use pounding_catalogue::Descriptor;

/// A record format.
#[derive(Debug)]
#[non_exhaustive]
pub struct Format {
    /// Name in the case file.
    pub name: &'static str,
    /// A title for people.
    pub title: &'static str,
    /// Who defines it, or publishes records in it.
    pub source: &'static str,
    /// What in a file tells it from others; formats are tried in their order.
    pub recognised_by: &'static str,
}

impl Descriptor for Format {
    const KIND: &'static str = "record format";
    const NOUN: &'static str = "format";

    fn name(&self) -> &'static str {
        self.name
    }
}

/// Names are unique.
impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
