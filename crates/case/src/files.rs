//! The files that a case names.

use std::path::PathBuf;

use pounding_ground_motion::responses_beside;

use crate::types::{Case, GroundMotion};

impl Case {
    /// The files that a run of this case reads beside the case file itself: what each is, and
    /// its path resolved against the folder of the case file. They are not looked for, but for
    /// the metadata of stations that may lie beside the records.
    #[must_use]
    pub fn files(&self) -> Vec<(&'static str, PathBuf)> {
        let mut files = Vec::new();
        let mut add = |what, motion: &GroundMotion| {
            let record = self.resolve(&motion.file.value);
            let given = motion.response.as_ref().map(|r| self.resolve(&r.value));
            let beside = || responses_beside(&record);
            let responses = given.map_or_else(beside, |given| vec![given]);
            files.push((what, record));
            // Of the record itself its own hash tells; a further one is known by its files.
            let role = if what == "record" {
                "station's metadata"
            } else {
                what
            };
            files.extend(responses.into_iter().map(|path| (role, path)));
            let steps = motion.process.iter().filter_map(|step| step.value.target());
            let scale = motion.scale.as_ref();
            let targets = steps.chain(scale.and_then(|scale| scale.value.target()));
            let targets = targets.filter_map(|t| t.file());
            files.extend(targets.map(|t| ("target spectrum", self.resolve(&t.file.value))));
        };
        add("record", &self.ground_motion);
        if let Some(across) = &self.ground_motion.across {
            add("further record", &across.value);
        }
        for ground in self.buildings.iter().filter_map(|b| b.ground.as_ref()) {
            if let Some(motion) = &ground.value.motion {
                add("further record", motion);
            }
        }
        let lateral = self.buildings.iter().filter_map(|b| b.lateral.as_ref());
        let matrices = lateral.filter_map(|l| l.value.file());
        files.extend(matrices.map(|f| ("matrix", self.resolve(&f.value))));
        let forces = self.buildings.iter().flat_map(|b| &b.forces);
        let histories = forces.filter_map(|f| f.value.source.file());
        files.extend(histories.map(|f| ("force history", self.resolve(&f.value))));
        files
    }
}
