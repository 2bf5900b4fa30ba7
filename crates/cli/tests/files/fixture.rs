//! A folder with one of every kind of file that commands read.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const BUILDINGS: &str = r#"
[[building]]
name = "a"
storeys = 1
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "b"
storeys = 1
mass = "100 t"
stiffness = "30 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[gap]]
between = ["a", "b"]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
"#;

/// A case whose record is scaled to a spectrum in a step and once more at the end.
const MOTION: &str = r#"
[ground_motion]
file = "record.csv"
process = [{ scale = { target = "step.csv", from = "0.2 s", to = "0.5 s" } }]
scale = { target = "target.csv", from = "0.2 s", to = "0.5 s" }
[analysis]
duration = "2 s"
"#;

/// Records, a target spectrum as a value, intensities, a hazard curve.
const STUDY: &str = r#"
case = "case.toml"
[[variable]]
name = "record"
records = ["record.csv", { name = "second", file = "second.csv", process = [{ scale = { target = "other_step.csv", from = "0.2 s", to = "0.5 s" } }] }]
[[variable]]
intensity = "peak_ground_acceleration"
values = ["0.1 g", "0.2 g", "0.4 g", "0.8 g"]
[ida]
gaps = ["20 mm"]
hazard = "hazard.csv"
"#;

/// Metadata of the station that recorded `counts.mseed`: 1000 counts per m/s2.
const STATION: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1">
 <Network code="XX"><Station code="NONE">
  <Channel code="HNE" locationCode="" startDate="2000-01-01T00:00:00"><SampleRate>50</SampleRate>
   <Response><InstrumentSensitivity><Value>1000</Value><Frequency>1</Frequency>
    <InputUnits><Name>M/S**2</Name></InputUnits><OutputUnits><Name>counts</Name></OutputUnits>
   </InstrumentSensitivity></Response>
  </Channel>
 </Station></Network>
</FDSNStationXML>
"#;

/// One record of miniSEED, 112 whole numbers at 50 Hz.
fn counts() -> Vec<u8> {
    let mut bytes = b"000001D NONE   HNEXX".to_vec();
    let header: [u16; 6] = [2001, 1, 0, 0, 0, 112];
    bytes.extend(header.iter().flat_map(|n| n.to_be_bytes()));
    bytes.extend([0, 50, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 64, 0, 48]);
    // Blockette 1000: integers of four bytes, the high one first, in 512 bytes.
    bytes.extend([3, 232, 0, 0, 3, 1, 9, 0]);
    bytes.resize(64, 0);
    for i in 0..112 {
        let count = (3000.0 * (0.14 * f64::from(i)).sin()) as i32;
        bytes.extend(count.to_be_bytes());
    }
    bytes
}

/// The folder.
pub struct Fixture {
    folder: TempDir,
}

impl Fixture {
    pub fn new() -> Self {
        let fixture = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        let record = |strength: f64| {
            let mut text = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
            for i in 0..120 {
                let t = f64::from(i) * 0.02;
                text.push_str(&format!("{t:.2},{:.5}\n", strength * (7.0 * t).sin()));
            }
            text
        };
        let spectrum = "# 5 %\nperiod_s,psa_g\n0.1,0.8\n1,0.8\n3,0.2\n".to_owned();
        let mut dissipation = "amplitude (mm); dissipation (mJ)\n".to_owned();
        for i in 0..30 {
            let amplitude = 5.0e-3 * 1.15_f64.powi(i);
            dissipation.push_str(&format!("{amplitude:e}; {:e}\n", amplitude.powf(2.6)));
        }
        let files = [
            ("case.toml", format!("{BUILDINGS}{MOTION}")),
            ("study.toml", STUDY.to_owned()),
            (
                "targets.toml",
                "case = \"case.toml\"\n[[variable]]\nname = \"target\"\npath = \"ground_motion.scale.target\"\nvalues = [\"target.csv\", \"other_target.csv\"]\n".to_owned(),
            ),
            ("record.csv", record(0.4)),
            ("second.csv", record(0.3)),
            ("step.csv", spectrum.clone()),
            ("other_step.csv", spectrum.clone()),
            ("target.csv", spectrum.clone()),
            ("other_target.csv", spectrum),
            (
                "hazard.csv",
                "intensity_g,mean_annual_frequency\n0.01,1\n4,1e-6\n".to_owned(),
            ),
            (
                "measured.csv",
                "time_ms,force_kN\n0,0\n5,100\n10,150\n15,80\n20,0\n".to_owned(),
            ),
            (
                "history.csv",
                "deformation_mm\n0\n5\n-5\n0\n".to_owned(),
            ),
            ("dissipation.csv", dissipation),
            (
                "spring.csv",
                "penetration_mm,force_kN\n0,0\n0.5,10\n1,50\n20,3000\n".to_owned(),
            ),
            (
                "rules.toml",
                "[[rule]]\nname = \"mine\"\nkind = \"between\"\nexpression = \"u_left + u_right\"\n"
                    .to_owned(),
            ),
        ];
        for (name, text) in files {
            std::fs::write(fixture.path(name), text).unwrap();
        }
        std::fs::write(fixture.path("counts.mseed"), counts()).unwrap();
        std::fs::write(fixture.path("station.xml"), STATION).unwrap();
        std::fs::create_dir(fixture.path("inside")).unwrap();
        fixture
    }

    /// Adds a case that takes minutes, and studies of it.
    pub fn with_long_case(&self) {
        let case = std::fs::read_to_string(self.path("case.toml")).unwrap();
        let long = "duration = \"5000 s\"\noutput_step = \"1 s\"\nmethod = \"runge_kutta_4\"\nstep = \"0.1 ms\"";
        let case = case.replace("duration = \"2 s\"", long);
        std::fs::write(self.path("long.toml"), case).unwrap();
        let study = STUDY.replace("case.toml", "long.toml");
        std::fs::write(self.path("long-study.toml"), study).unwrap();
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn command(&self, words: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
        command
            .env("NO_COLOR", "1")
            .stdin(Stdio::null())
            .current_dir(self.folder.path())
            .args(words);
        command
    }

    pub fn run(&self, words: &[&str]) -> Output {
        self.command(words).output().unwrap()
    }

    /// Every file with its bytes.
    pub fn content(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let entries = std::fs::read_dir(self.folder.path()).unwrap();
        let paths = entries.map(|e| e.unwrap().path()).filter(|p| p.is_file());
        paths
            .map(|path| {
                let bytes = std::fs::read(&path).unwrap();
                (path, bytes)
            })
            .collect()
    }
}

/// What it complains of on one line.
pub fn message(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}
