//! Studies from the command line: examples, interruption, failure, shards.
mod checks;
mod collapsing;
mod damaged;
mod errors;
mod examples;
mod failing;
mod figures;
mod interrupted;
mod merging;
mod open_answers;
mod openquake;
mod output;
mod parquet;
mod plans;
mod python;
mod rigid;
mod shards;
mod shared_records;
mod shown;
mod status;
mod structures_and_stripes;
mod yielding_storeys;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

fn pounding() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command.env("NO_COLOR", "1");
    command
}

/// A folder with a study in it.
struct Bench {
    folder: TempDir,
}

impl Bench {
    fn new(study: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let motions = root().join("ground_motions");
        let case = root().join("examples/sweep_three_storey_pair/case.toml");
        let case = std::fs::read_to_string(case).unwrap();
        let case = case.replace("../../ground_motions", motions.to_str().unwrap());
        // Short, so that many runs fit into a test.
        let case = case.replace("duration = \"31 s\"", "duration = \"6 s\"");
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        let bench = Self { folder };
        bench.study(study);
        bench
    }

    fn study(&self, study: &str) {
        let motions = root().join("ground_motions");
        let study = study.replace("MOTIONS", motions.to_str().unwrap());
        std::fs::write(self.path("study.toml"), study).unwrap();
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = pounding();
        command
            .current_dir(self.folder.path())
            .args(arguments.split_whitespace());
        command
    }

    fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// What it prints if all went well.
    fn text(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{arguments}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// What it complains of, with this exit code; line breaks of the frame taken out.
    fn complaint(&self, arguments: &str, code: i32) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments}: {errors}");
        let words: Vec<&str> = errors.split_whitespace().filter(|w| *w != "│").collect();
        words.join(" ")
    }

    /// With no file larger than so many kilobytes, which stands for a full disk; `trap` lets
    /// the write fail instead of the process.
    fn with_limit(&self, kilobytes: usize, arguments: &str) -> (Option<i32>, String) {
        let script = format!(
            "trap '' XFSZ; ulimit -f {kilobytes}; exec {} {arguments}",
            env!("CARGO_BIN_EXE_pounding")
        );
        let output = Command::new("bash")
            .args(["-c", &script])
            .env("NO_COLOR", "1")
            .current_dir(self.folder.path())
            .output()
            .unwrap();
        let errors = String::from_utf8(output.stderr).unwrap();
        let words: Vec<&str> = errors.split_whitespace().filter(|w| *w != "│").collect();
        (output.status.code(), words.join(" "))
    }

    /// There is room for the finished chunks but not for the result: the chunks stay.
    fn without_its_result(&self, arguments: &str) {
        let (code, told) = self.with_limit(20, arguments);
        assert_eq!(code, Some(4), "{told}");
        assert!(told.contains("cannot write the result"), "{told}");
    }

    /// Nobody's part file stands in the folder.
    fn no_part_file(&self) {
        crate::support::part_files::no_part_file(self.folder.path());
    }

    fn bytes(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap()
    }
}

/// Gap, model and record: 60 runs in chunks of four.
const MIXED: &str = r#"
case = "case.toml"

[[variable]]
name = "gap"
path = "gap.0.width"
from = "5 mm"
to = "60 mm"

[[variable]]
path = "gap.0.model"
name = "model"
values = [
    { model = "jankowski_2005", stiffness = "2.75e9 N/m^1.5", restitution = 0.6 },
    { model = "anagnostopoulos_2004", stiffness = "93.5 MN/m", restitution = 0.6 },
]

[[variable]]
records = ["MOTIONS/el_centro_1940_ns.csv", "MOTIONS/kobe_1995_jma_ns.csv"]

[[variable]]
name = "mass"
path = "building.light.mass"
values = ["20 t", "25 t", "30 t"]

[design]
kind = "latin_hypercube"
runs = 60
seed = 3

[output]
chunk = 4
isolated_demand = true
"#;
