//! A case with some of its entries replaced.

use pounding_assembly::AssemblyError;
use pounding_case::{Case, CaseError, CaseTree};
use toml::de::DeTable;

use super::edits::{Edit, apply, changed};
use super::identity::{Lines, canonical};

/// A case with edits, made in its tree. Only where something is wrong with it is it written,
/// and read: messages have their places in that text.
#[derive(Debug)]
pub(crate) struct Variant<'v, 's> {
    base: &'v CaseTree<'s>,
    edits: &'v [Edit],
    /// What the edits change; `None` where they cannot be made in the tree.
    changed: Option<DeTable<'v>>,
}

impl<'v, 's> Variant<'v, 's> {
    pub(crate) fn new(base: &'v CaseTree<'s>, edits: &'v [Edit]) -> Self {
        Self {
            base,
            edits,
            changed: changed(base.tree(), edits),
        }
    }

    /// What [`canonical`] says of its text; `lines` are those of the case.
    pub(crate) fn canonical(&self, lines: &Lines) -> String {
        match &self.changed {
            Some(changed) => lines.with(changed),
            None => canonical(&self.text()),
        }
    }

    pub(crate) fn case(&self) -> Result<Case, CaseError> {
        let made = self.changed.as_ref();
        made.and_then(|changed| self.base.with(changed))
            .map_or_else(|| self.written(), Ok)
    }

    /// What is made of its case.
    pub(crate) fn make<T>(
        &self,
        case: &Case,
        make: impl Fn(&Case) -> Result<T, AssemblyError>,
    ) -> Result<T, AssemblyError> {
        match make(case) {
            Err(AssemblyError::Case(_)) => make(&self.written()?),
            made => made,
        }
    }

    fn text(&self) -> String {
        apply(self.base.source(), self.edits)
    }

    fn written(&self) -> Result<Case, CaseError> {
        Case::parse(&self.text(), self.base.file())
    }
}
