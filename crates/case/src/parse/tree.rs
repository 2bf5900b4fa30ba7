//! Cases that differ from one another in a few entries.

use std::fmt;
use std::path::Path;

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{CaseFile, EXAMPLE, Row, case_of};
use crate::document::Reader;
use crate::error::CaseError;
use crate::types::Case;

/// A case file as a TOML tree and as the types of its tables, read once: of cases that differ
/// in a table, only that is read again.
pub struct CaseTree<'s> {
    source: &'s str,
    file: &'s Path,
    tree: DeTable<'s>,
    /// All but the buildings.
    tables: CaseFile,
    row: Row,
}

impl<'s> CaseTree<'s> {
    /// Reads a text as [`Case::parse`] does.
    ///
    /// # Errors
    /// All that is wrong in it: the first error with the others.
    pub fn parse(source: &'s str, file: &'s Path) -> Result<Self, CaseError> {
        let mut read = None;
        let case = case_of(source, file, |reader| {
            let mut tables: CaseFile = reader.read(EXAMPLE)?;
            let row = Row::new(reader, tables.building.take());
            let (tables, row) = read.insert((tables, row));
            Some(tables.clone().draft(reader, file, row))
        });
        let case = case.map_err(|refusal| refusal.error)?;
        match (DeTable::parse(source), read) {
            (Ok(tree), Some((tables, row))) => Ok(Self {
                source,
                file,
                tree: tree.into_inner(),
                tables,
                row,
            }),
            // It was read before.
            _ => Err(case.error(0..0, "the file cannot be read", None)),
        }
    }

    /// The tree, with the places of its values in the text.
    #[must_use]
    pub fn tree(&self) -> &DeTable<'s> {
        &self.tree
    }

    /// The text.
    #[must_use]
    pub fn source(&self) -> &'s str {
        self.source
    }

    /// The file that the text stands for.
    #[must_use]
    pub fn file(&self) -> &'s Path {
        self.file
    }

    /// The case with these values of root keys in the place of its own. Its places are those of
    /// the text before the change, as is its text. `None` where something is wrong with it:
    /// written and read, it says what and where.
    #[must_use]
    pub fn with(&self, changed: &DeTable<'_>) -> Option<Case> {
        let case = case_of(self.source, self.file, |reader| {
            let mut tables = self.tables.clone();
            tables.read_again(reader, changed);
            let row = tables.building.take().map(|of| Row::new(reader, Some(of)));
            Some(tables.draft(reader, self.file, row.as_ref().unwrap_or(&self.row)))
        });
        case.ok()
    }
}

impl fmt::Debug for CaseTree<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CaseTree")
            .field("file", &self.file)
            .field("tree", &self.tree)
            .finish_non_exhaustive()
    }
}

impl CaseFile {
    /// Replaces the tables that are given; what is wrong in them is recorded.
    fn read_again(&mut self, reader: &Reader<'_>, changed: &DeTable<'_>) {
        let Self {
            title,
            building,
            gap,
            link,
            ground_motion,
            analysis,
            separation,
        } = self;
        let of = |key| changed.get(key);
        again(reader, "title", of("title"), title);
        again(reader, "building", of("building"), building);
        again(reader, "gap", of("gap"), gap);
        again(reader, "link", of("link"), link);
        again(reader, "ground_motion", of("ground_motion"), ground_motion);
        again(reader, "analysis", of("analysis"), analysis);
        again(reader, "separation", of("separation"), separation);
    }
}

/// Reads the value of a key anew, if one is given.
fn again<T: DeserializeOwned>(
    reader: &Reader<'_>,
    key: &str,
    given: Option<&Spanned<DeValue<'_>>>,
    value: &mut T,
) {
    if let Some(read) = given.and_then(|given| reader.value(key, given)) {
        *value = read;
    }
}
