//! The files that a study names.

use std::path::PathBuf;

use pounding_case::CaseTree;

use super::{RecordKind, Study, Target, Value};
use crate::case_text::Variant;

impl Study {
    /// Every file that the study reads: what each is, and its path.
    #[must_use]
    pub fn files(&self) -> Vec<(&'static str, PathBuf)> {
        let mut files = vec![
            ("study", self.file.clone()),
            ("case of the study", self.base.file.clone()),
        ];
        files.extend(self.base.files());
        for record in &self.records {
            if let RecordKind::File { case, .. } = &record.kind {
                files.extend(case.files());
            }
        }
        let tree = CaseTree::parse(&self.base.source, &self.base.file).ok();
        for variable in &self.variables {
            // Such as target spectra by name.
            if let Target::Entries { texts, .. } = &variable.target {
                let cases = (0..texts.len()).filter_map(|choice| {
                    let edits = variable.target.edits(&Value::Choice(choice));
                    Variant::new(tree.as_ref()?, &edits).case().ok()
                });
                files.extend(cases.flat_map(|case| case.files()));
            }
        }
        let hazard = self.ida.iter().filter_map(|ida| ida.hazard_file.clone());
        files.extend(hazard.map(|path| ("hazard curve", path)));
        files
    }
}
