//! Peers: programs of others and plain loops, as child processes.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use verification::Failure;

/// Peaks and the least processor time (s) of a run.
pub(crate) struct PeerRun {
    pub(crate) displacement: Vec<f64>,
    pub(crate) force: Vec<f64>,
    pub(crate) seconds: f64,
}

/// How a peer is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Program {
    /// `peer.c` with this method.
    Compiled(&'static str),
    /// `peers_py.py` with this method.
    Python(&'static str),
    /// `ops_bench.py`.
    OpenSees,
}

/// A peer with parameters from coarse to fine.
pub(crate) struct Peer {
    pub(crate) name: &'static str,
    pub(crate) program: Program,
    pub(crate) parameters: &'static [&'static str],
    /// Models that it knows; empty for all of the compiled peer's.
    pub(crate) models: &'static [&'static str],
}

/// Name of the prototype in tables.
pub(crate) const PROTOTYPE: &str = "peer.c evd P";

/// Models of the compiled peer.
pub(crate) const MODELS: [&str; 11] = [
    "linear",
    "kv",
    "kv_cut",
    "mj",
    "yeli",
    "papi",
    "hertz",
    "hertzdamp",
    "jank",
    "hunt",
    "flores",
];

const SUBSTEPS: &[&str] = &["1", "2", "5", "10", "20", "50", "100", "200", "500"];
const SCRIPTED: &[&str] = &["linear", "kv", "hertz", "hertzdamp", "jank"];

/// All peers.
pub(crate) const PEERS: [Peer; 8] = [
    Peer {
        name: PROTOTYPE,
        program: Program::Compiled("evd"),
        parameters: &[
            "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11",
        ],
        models: &[],
    },
    Peer {
        name: "peer.c rk45",
        program: Program::Compiled("rk45"),
        parameters: &["1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10", "1e-11"],
        models: &[],
    },
    Peer {
        name: "peer.c rk4",
        program: Program::Compiled("rk4"),
        parameters: SUBSTEPS,
        models: &[],
    },
    Peer {
        name: "peer.c newmark",
        program: Program::Compiled("newmark"),
        parameters: SUBSTEPS,
        models: &[],
    },
    Peer {
        name: "Numba RK4",
        program: Program::Python("numba"),
        parameters: &["5", "10", "20", "50", "100"],
        models: SCRIPTED,
    },
    Peer {
        name: "SciPy LSODA",
        program: Program::Python("LSODA"),
        parameters: &["1e-4", "1e-5", "1e-6", "1e-7"],
        models: SCRIPTED,
    },
    Peer {
        name: "SciPy RK45",
        program: Program::Python("RK45"),
        parameters: &["1e-6", "1e-7", "1e-8"],
        models: SCRIPTED,
    },
    Peer {
        name: "OpenSeesPy Newmark",
        program: Program::OpenSees,
        parameters: &["0.001", "0.0005", "0.0002", "0.0001", "0.00005"],
        models: &["linear", "kv", "hertz", "hertzdamp", "hunt", "jank"],
    },
];

/// Where the peers are, and what can be run.
pub(crate) struct Room {
    /// The folder of this crate.
    folder: PathBuf,
    /// Where everything measured goes.
    pub(crate) out: PathBuf,
    compiled: bool,
    scripts: bool,
    open_sees: bool,
}

impl Room {
    /// Looks what is there.
    pub(crate) fn look() -> Result<Self, Failure> {
        let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        let out = folder.join("out");
        std::fs::create_dir_all(&out)?;
        let mut room = Self {
            compiled: out.join("peer").exists(),
            folder,
            out,
            scripts: false,
            open_sees: false,
        };
        let works = |arguments: &[&str]| {
            let mut command = room.python();
            command.args(arguments).stderr(Stdio::null());
            command.status().is_ok_and(|s| s.success())
        };
        let scripts = works(&["-c", "import numpy, scipy.integrate, numba"]);
        let open_sees = works(&[&room.script("ops_bench.py"), "--check"]);
        (room.scripts, room.open_sees) = (scripts, open_sees);
        Ok(room)
    }

    fn python(&self) -> Command {
        Command::new(self.folder.join("peers/.venv/bin/python"))
    }

    fn script(&self, name: &str) -> String {
        let path = self.folder.join("peers").join(name);
        path.to_string_lossy().into_owned()
    }

    /// Whether a program can be run.
    pub(crate) fn has(&self, program: Program) -> bool {
        match program {
            Program::Compiled(_) => self.compiled,
            Program::Python(_) => self.scripts,
            Program::OpenSees => self.open_sees,
        }
    }

    /// What is there and what is not, in words.
    pub(crate) fn availability(&self) -> String {
        let entries = [
            ("peer.c", self.compiled),
            ("SciPy and Numba", self.scripts),
            ("OpenSeesPy", self.open_sees),
        ];
        let words = entries.map(|(name, there)| {
            let state = if there {
                "available"
            } else {
                "**not available**"
            };
            format!("{name} {state}")
        });
        words.join(", ")
    }

    /// The file of a case for the compiled peer.
    pub(crate) fn case_file(&self, name: &str) -> PathBuf {
        self.out.join(format!("{name}.txt"))
    }

    /// Runs a peer once, `repetitions` times inside if it is a compiled one.
    pub(crate) fn run(
        &self,
        program: Program,
        (case, model, parameter): (&str, &str, &str),
        repetitions: usize,
    ) -> Result<PeerRun, Failure> {
        let (command, time) = match program {
            Program::Compiled(method) => {
                let mut command = Command::new(self.out.join("peer"));
                command.arg(self.case_file(case));
                command.args([model, method, parameter, &repetitions.to_string()]);
                command.args(["-o", "P"]);
                (command, "wall_min")
            }
            Program::Python(method) => {
                let mut command = self.python();
                command.args([&self.script("peers_py.py"), case, model, method, parameter]);
                (command, "wall")
            }
            Program::OpenSees => {
                let mut command = self.python();
                command.args([&self.script("ops_bench.py"), case, model, parameter]);
                (command, "wall")
            }
        };
        let answer = ask(command)?;
        if answer.get("ok") == Some(&Value::Bool(false)) {
            return Err("stopped before the end".into());
        }
        Ok(PeerRun {
            displacement: numbers(&answer["peak_u"])?,
            force: numbers(&answer["peak_F"])?,
            seconds: answer[time].as_f64().ok_or("no time")?,
        })
    }

    /// The compiled peer's own sweep of 1,000 runs: processor time (s), sum of the
    /// largest forces (N).
    pub(crate) fn sweep(
        &self,
        method: &str,
        (case, model, parameter): (&str, &str, &str),
    ) -> Result<(f64, f64), Failure> {
        let mut command = Command::new(self.out.join("peer"));
        command.arg(self.case_file(case));
        command.args([model, method, parameter, "1", "-o", "P", "-s"]);
        let answer = ask(command)?;
        let number = |key: &str| answer[key].as_f64().ok_or_else(|| format!("no {key}"));
        Ok((number("wall")?, number("sumF")?))
    }
}

/// The JSON that a program prints last.
fn ask(mut command: Command) -> Result<Value, Failure> {
    let output = command.stderr(Stdio::null()).output()?;
    let text = String::from_utf8_lossy(&output.stdout);
    let line = text.lines().rev().find(|l| l.starts_with('{'));
    match line {
        Some(line) if output.status.success() => Ok(serde_json::from_str(line)?),
        _ => {
            let program = Path::new(command.get_program()).display().to_string();
            Err(format!("{program} ended with {}", output.status).into())
        }
    }
}

fn numbers(value: &Value) -> Result<Vec<f64>, Failure> {
    let list = value.as_array().ok_or("no list of peaks")?;
    let numbers = list.iter().map(|x| x.as_f64().ok_or("no number".into()));
    numbers.collect()
}
