//! The files that a study names.

use std::path::PathBuf;

use pounding_case::Case;

use super::{RecordKind, Study, Target};
use crate::case_text::apply;

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
        for variable in &self.variables {
            // Such as target spectra by name.
            if let Target::Entry { entry, texts, .. } = &variable.target {
                let cases = texts.iter().filter_map(|text| {
                    let text = apply(&self.base.source, vec![entry.with(text)]);
                    Case::parse(&text, &self.base.file).ok()
                });
                files.extend(cases.flat_map(|case| case.files()));
            }
        }
        let hazard = self.ida.iter().filter_map(|ida| ida.hazard_file.clone());
        files.extend(hazard.map(|path| ("hazard curve", path)));
        files
    }
}
