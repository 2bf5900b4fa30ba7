//! Files that a study names beside its records: cases say their names alone.

use std::path::PathBuf;

use pounding_files::checksum::hexadecimal;
use sha2::{Digest, Sha256};

use crate::study_file::Study;

/// Hashes of the files that a study names beside its records, each file once.
pub(super) fn named_files(study: &Study) -> Vec<String> {
    let mut paths: Vec<PathBuf> = Vec::new();
    for (what, path) in study.files() {
        let named = [
            "matrix",
            "target spectrum",
            "further record",
            "force history",
        ];
        if named.contains(&what) && !paths.contains(&path) {
            paths.push(path);
        }
    }
    // A device or a pipe may never end.
    let read = |path: PathBuf| match path.is_file() {
        true => std::fs::read(path).ok(),
        false => None,
    };
    let hash = |path: PathBuf| match read(path) {
        Some(bytes) => hexadecimal(&Sha256::digest(bytes)),
        None => "unreadable".to_owned(),
    };
    paths.into_iter().map(hash).collect()
}
