//! What the program is built of and for, as far as the results of runs may hang on it: the
//! sources of the crates that compute, with their dependencies, and the target. The same
//! sources give the same text on every machine: neither git nor the clock is asked.
//!
//! In a package from a registry the other crates are not beside this one. There the version
//! names the sources: it never changes its content, and packages ask for one another by their
//! exact version.

use std::env::{var, vars};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// Crates whose sources decide the numbers of a run.
const COMPUTING: [&str; 12] = [
    "assembly",
    "case",
    "catalogue",
    "gap-element",
    "ground-motion",
    "hysteresis",
    "results",
    "runge-kutta",
    "shear-building",
    "study",
    "time-history",
    "vectorised",
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let own = PathBuf::from(var("CARGO_MANIFEST_DIR")?);
    // Cargo adds this file to what it packages.
    let sources = match own.join("Cargo.toml.orig").is_file() {
        true => "packaged".to_owned(),
        false => format!("sources {}", digits(&own.join(".."))?),
    };
    let mut features: Vec<String> = vars()
        .filter_map(|(name, _)| Some(name.strip_prefix("CARGO_FEATURE_")?.to_lowercase()))
        .collect();
    features.sort();
    let features = match features.is_empty() {
        true => String::new(),
        false => format!(", features {}", features.join(",")),
    };
    println!(
        "cargo::rustc-env=POUNDING_BUILD=version {}, {sources}, target {}, instructions {}{features}",
        var("CARGO_PKG_VERSION")?,
        var("TARGET")?,
        var("CARGO_CFG_TARGET_FEATURE").unwrap_or_default(),
    );
    Ok(())
}

/// The beginning of a checksum of all that computes, in the folder of the crates.
fn digits(crates: &Path) -> std::io::Result<String> {
    let mut files = Vec::new();
    for name in COMPUTING {
        let folder = crates.join(name).join("src");
        println!("cargo::rerun-if-changed={}", folder.display());
        collect(&folder, &mut files)?;
    }
    // The versions of what the crates depend on.
    let lock = crates.join("../Cargo.lock");
    if lock.is_file() {
        println!("cargo::rerun-if-changed={}", lock.display());
        files.push(lock);
    }
    // By names that do not hang on the machine.
    let mut files: Vec<_> = files
        .into_iter()
        .map(|path| (name(crates, &path), path))
        .collect();
    files.sort();
    let mut hash = Sha256::new();
    for (name, path) in files {
        let mut content = std::fs::read(path)?;
        // Git may have written the line ends of another system.
        content.retain(|byte| *byte != b'\r');
        hash.update(name);
        hash.update((content.len() as u64).to_le_bytes());
        hash.update(content);
    }
    Ok(hash.finalize()[..8]
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect())
}

/// All files below a folder.
fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> std::io::Result<()> {
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        match path.is_dir() {
            true => collect(&path, files)?,
            false => files.push(path),
        }
    }
    Ok(())
}

/// The path of a file from the folder of the crates on.
fn name(crates: &Path, path: &Path) -> String {
    let path = path.strip_prefix(crates).unwrap_or(path);
    path.to_string_lossy().replace('\\', "/")
}
