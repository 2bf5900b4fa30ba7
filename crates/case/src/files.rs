//! The files that a case names.

use std::path::PathBuf;

use crate::process::ProcessStep;
use crate::types::{Case, GroundMotion, Scale};

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
        let targets = steps.chain(scale.target());
        let mut files = vec![("record", self.resolve(&file.value))];
        files.extend(targets.map(|path| ("target spectrum", self.resolve(path))));
        files
    }
}

impl ProcessStep {
    /// The file of the spectrum that this step scales to, as written.
    #[must_use]
    pub fn target(&self) -> Option<&PathBuf> {
        match self {
            Self::Scale(scale) => scale.target(),
            _ => None,
        }
    }
}

impl Scale {
    fn target(&self) -> Option<&PathBuf> {
        match self {
            Self::Band { target, .. } => Some(&target.value),
            _ => None,
        }
    }
}
