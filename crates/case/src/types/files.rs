//! The files that a case names, and where their bytes come from.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use pounding_ground_motion::responses_beside;

use super::{Case, GroundMotion};

/// Files whose bytes are at hand, for a case that has no folder: by their paths as the case
/// gives them.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct GivenFiles(BTreeMap<PathBuf, Arc<[u8]>>);

impl GivenFiles {
    /// Adds a file, or replaces that of the same path.
    pub fn insert(&mut self, path: impl Into<PathBuf>, bytes: impl Into<Arc<[u8]>>) {
        self.0.insert(path.into(), bytes.into());
    }

    /// The bytes of the file of this path. A case also finds a file that was given by its name
    /// alone, without folders.
    ///
    /// # Errors
    /// A file that was not given.
    pub fn read(&self, path: &Path) -> io::Result<&[u8]> {
        let by_name = || self.0.get(Path::new(path.file_name()?));
        let found = self.0.get(path).or_else(by_name);
        let missing = || io::Error::new(io::ErrorKind::NotFound, "this file was not given");
        found.map(|bytes| &**bytes).ok_or_else(missing)
    }

    /// Paths and lengths (bytes) of all files.
    pub fn lengths(&self) -> impl Iterator<Item = (&Path, usize)> {
        self.0
            .iter()
            .map(|(path, bytes)| (path.as_path(), bytes.len()))
    }
}

impl Case {
    /// The bytes of a file that the case names; `None` where its files lie on a disk.
    ///
    /// # Errors
    /// A file that was not given.
    #[must_use]
    pub fn given(&self, path: &Path) -> Option<io::Result<&[u8]>> {
        self.given_files.as_ref().map(|files| files.read(path))
    }

    /// The files that a run of this case reads beside the case file itself: what each is, and
    /// its path resolved against the folder of the case file. They are not looked for, but for
    /// the metadata of stations that may lie beside the records.
    #[must_use]
    pub fn files(&self) -> Vec<(&'static str, PathBuf)> {
        let named = self.named_files().into_iter();
        let mut files: Vec<_> = named
            .map(|(what, path)| (what, self.resolve(path)))
            .collect();
        for (what, motion) in self.motions().filter(|(_, m)| m.response.is_none()) {
            let beside = responses_beside(&self.resolve(&motion.file.value));
            files.extend(beside.into_iter().map(|path| (of_response(what), path)));
        }
        files
    }

    /// The record of the case and further ones, each with what it is.
    fn motions(&self) -> impl Iterator<Item = (&'static str, &GroundMotion)> {
        let across = self.ground_motion.across.iter().map(|m| &*m.value);
        let grounds = self.buildings.iter().filter_map(|b| b.ground.as_ref());
        let own = grounds.filter_map(|ground| ground.value.motion.as_ref());
        let further = across.chain(own.map(std::borrow::Borrow::borrow));
        std::iter::once(("record", &self.ground_motion))
            .chain(further.map(|motion| ("further record", motion)))
    }

    /// The same with paths as they stand in the case.
    #[must_use]
    pub fn named_files(&self) -> Vec<(&'static str, &Path)> {
        let mut files: Vec<(&'static str, &Path)> = Vec::new();
        for (what, motion) in self.motions() {
            files.push((what, &*motion.file.value));
            let response = motion.response.as_ref();
            files.extend(response.map(|r| (of_response(what), &*r.value)));
            let steps = motion.process.iter().filter_map(|step| step.value.target());
            let scale = motion.scale.as_ref();
            let targets = steps.chain(scale.and_then(|scale| scale.value.target()));
            let targets = targets.filter_map(|t| t.spectrum.file());
            files.extend(targets.map(|t| ("target spectrum", &*t.file.value)));
        }
        let lateral = self.buildings.iter().filter_map(|b| b.lateral.as_ref());
        let matrices = lateral.filter_map(|l| l.value.file());
        files.extend(matrices.map(|f| ("matrix", &*f.value)));
        let forces = self.buildings.iter().flat_map(|b| &b.forces);
        let histories = forces.filter_map(|f| f.value.source.file());
        files.extend(histories.map(|f| ("force history", &*f.value)));
        files
    }
}

/// What the metadata of a station are: of the record itself its own hash tells, a further one is
/// known by its files.
fn of_response(record: &'static str) -> &'static str {
    match record {
        "record" => "station's metadata",
        further => further,
    }
}
