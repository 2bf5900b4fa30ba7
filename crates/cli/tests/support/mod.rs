//! The program under test, run with arguments that are separated by blanks.
pub mod part_files;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// Runs `pounding COMMAND ARGUMENTS`.
pub fn run(command: &str, arguments: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg(command)
        .args(arguments.split_whitespace())
        .output()
        .unwrap()
}

/// What it prints if all went well.
pub fn text(command: &str, arguments: &str) -> String {
    let output = run(command, arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Changes a file by HDF5, which cuts off what follows the content.
pub fn edit(path: &Path, change: impl FnOnce(&hdf5::File)) {
    let file = hdf5::File::open_rw(path).unwrap();
    change(&file);
    file.close().unwrap();
    // HDF5's lock lives on in a process that another test is just starting: another file takes
    // the place of the one that was locked.
    let bytes = std::fs::read(path).unwrap();
    std::fs::remove_file(path).unwrap();
    std::fs::write(path, bytes).unwrap();
}

/// A folder with the case, and studies of it.
pub struct Bench(TempDir);

impl Bench {
    /// `case.toml` has this text, in which `MOTIONS` is the folder of the records.
    pub fn with(case: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        bench.write("case.toml", case);
        bench
    }

    pub fn folder(&self) -> &Path {
        self.0.path()
    }

    pub fn write(&self, name: &str, text: &str) {
        let motions = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ground_motions");
        let text = text.replace("MOTIONS", motions.to_str().unwrap());
        std::fs::write(self.0.path().join(name), text).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    pub fn output(&self, arguments: &str) -> Output {
        Command::new(env!("CARGO_BIN_EXE_pounding"))
            .env("NO_COLOR", "1")
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .unwrap()
    }

    pub fn text(&self, arguments: &str) -> String {
        let output = self.output(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    pub fn json(&self, arguments: &str) -> Value {
        serde_json::from_str(&self.text(&format!("{arguments} --json"))).unwrap()
    }

    pub fn refused(&self, arguments: &str, words: &[&str]) {
        let output = self.output(arguments);
        let errors = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
        let errors = errors.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{errors}");
        for word in words {
            assert!(errors.contains(word), "{errors}");
        }
    }
}
