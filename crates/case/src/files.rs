//! The files that a case names.

use std::path::PathBuf;

use crate::types::{Case, GroundMotion};

impl Case {
    /// The files that a run of this case reads beside the case file itself: what each is, and
    /// its path resolved against the folder of the case file. They are not looked for.
    #[must_use]
    pub fn files(&self) -> Vec<(&'static str, PathBuf)> {
        let GroundMotion {
            file,
            process,
            scale,
            ..
        } = &self.ground_motion;
        let steps = process.iter().filter_map(|step| step.value.target());
        let targets = steps.chain(scale.as_ref().and_then(|scale| scale.value.target()));
        let mut files = vec![("record", self.resolve(&file.value))];
        files.extend(targets.map(|t| ("target spectrum", self.resolve(&t.file.value))));
        let lateral = self.buildings.iter().filter_map(|b| b.lateral.as_ref());
        let matrices = lateral.filter_map(|l| l.value.file());
        files.extend(matrices.map(|f| ("matrix", self.resolve(&f.value))));
        files
    }
}
