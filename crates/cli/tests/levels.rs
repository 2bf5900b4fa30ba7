//! Levels: floors at different elevations are refused unless they are meant, and every output
//! says which floors, at which elevations, a level is.
use std::path::PathBuf;
use std::process::{Command, Output};

use crate::support::edit;
use hdf5::types::VarLenUnicode;
use serde_json::Value;
use tempfile::TempDir;

/// Five storeys of 3.06 m beside two of 3 m and a wall.
const CASE: &str = r#"
title = "pair"
[[building]]
name = "a"
storeys = 5
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3060 mm"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "b"
storeys = 2
mass = "100 t"
stiffness = "30 MN/m"
height = "3 m"
damping = { ratio = 0.05, modes = [1, 2] }
[[gap]]
between = ["a", "b"]
levels = [
    [4, 1],
    [5, 2],
]
width = "5 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[[gap]]
between = ["b", "wall"]
levels = [2]
width = "5 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[[link]]
between = ["a", "b"]
levels = [[1, 1]]
model = "linear"
stiffness = "1 MN/m"
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#;

const SWEEP: &str = r#"
case = "case.toml"
[[variable]]
name = "stiffness"
path = "building.b.stiffness"
values = ["30 MN/m", "40 MN/m"]
"#;

const IDA: &str = r#"
case = "case.toml"
[[variable]]
records = ["record.csv"]
[[variable]]
intensity = "peak_ground_acceleration"
values = ["0.1 g", "0.4 g"]
[ida]
"#;

struct Bench(TempDir);

impl Bench {
    fn new(case: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let mut record = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
        for i in 0..120 {
            let t = f64::from(i) * 0.02;
            record.push_str(&format!("{t:.2},{:.5}\n", 0.4 * (7.0 * t).sin()));
        }
        std::fs::write(folder.path().join("record.csv"), record).unwrap();
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        std::fs::write(folder.path().join("sweep.toml"), SWEEP).unwrap();
        std::fs::write(folder.path().join("ida.toml"), IDA).unwrap();
        Self(folder)
    }

    /// The case with the simplification that it needs.
    fn meant() -> Self {
        Self::new(&meant())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn run(&self, arguments: &str) -> Output {
        Command::new(env!("CARGO_BIN_EXE_pounding"))
            .current_dir(self.0.path())
            .env("NO_COLOR", "1")
            .env("COLUMNS", "400")
            .args(arguments.split_whitespace())
            .output()
            .unwrap()
    }

    /// What it prints, whether or not a gap is wide enough.
    fn text(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        let done = matches!(output.status.code(), Some(0 | 1));
        assert!(done, "{arguments}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    fn json(&self, arguments: &str) -> Value {
        serde_json::from_str(&self.text(arguments)).unwrap()
    }

    /// What it says of bad input, on one line.
    fn refusal(&self, arguments: &str) -> String {
        let output = self.run(arguments);
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments}: {errors}");
        let words = errors.split_whitespace().filter(|w| *w != "│");
        words.collect::<Vec<_>>().join(" ")
    }

    fn file(&self, name: &str) -> hdf5::File {
        hdf5::File::open(self.path(name)).unwrap()
    }
}

fn meant() -> String {
    CASE.replacen("width = ", "floor_to_floor = true\nwidth = ", 1)
}

/// Commands that read a case, its results to places that do not clash.
const COMMANDS: [&str; 6] = [
    "check case.toml",
    "run case.toml -o run.h5",
    "gap case.toml --points 0",
    "compare case.toml --models anagnostopoulos_2004,hunt_crossley_1975",
    "sweep sweep.toml -o sweep.h5 --threads 1",
    "ida ida.toml -o ida.h5 --threads 1",
];

#[test]
fn floors_at_different_elevations_are_refused_by_every_command() {
    let bench = Bench::new(CASE);
    for command in COMMANDS {
        let said = bench.refusal(command);
        for word in [
            "storey 4 of \"a\" at 12.24 m and storey 1 of \"b\" at 3 m",
            "differ in elevation by 9.24 m",
            "tolerance of 0.01 m",
            "the first of 2 such pairs",
            "`floor_to_floor = true`",
        ] {
            assert!(said.contains(word), "{command}: {word}: {said}");
        }
        assert!(said.contains("case.toml:20:5"), "{command}: {said}");
    }
    for output in ["run.h5", "sweep.h5", "ida.h5"] {
        assert!(!bench.path(output).exists());
    }
}

#[test]
fn every_output_warns_of_floors_that_are_meant_to_act_on_each_other() {
    let bench = Bench::meant();
    let warned = |said: &str, whence: &str| {
        for word in [
            "gap a-b: floors at different elevations act on each other as if they were level",
            "storey 4 of \"a\" at 12.24 m and storey 1 of \"b\" at 3 m, 9.24 m apart",
            "the first of 2 such pairs",
        ] {
            assert!(said.contains(word), "{whence}: {said}");
        }
        assert!(!said.contains("gap b-wall: floors"), "{said}");
    };
    for command in COMMANDS {
        let again = match command.starts_with("sweep") || command.starts_with("ida") {
            true => format!("{command} --resume"),
            false => command.to_owned(),
        };
        warned(&bench.text(command), command);
        let told = bench.json(&format!("{again} --json"));
        let warnings = match command.starts_with("ida") {
            true => &told["sweep"]["warnings"],
            false => &told["warnings"],
        };
        let list = warnings.as_array().unwrap().iter();
        let texts: Vec<_> = list.map(|w| w.as_str().unwrap()).collect();
        warned(&texts.join("\n"), command);
    }
    bench.text("report run.h5 -o run.html");
    let page = std::fs::read_to_string(bench.path("run.html")).unwrap();
    warned(&page.replace("&quot;", "\""), "page");
    let attribute = |file: &str, group: &str| {
        let group = bench.file(file).group(group).unwrap();
        let text = group.attr("warnings").unwrap();
        text.read_scalar::<VarLenUnicode>().unwrap().to_string()
    };
    warned(&attribute("run.h5", "run"), "run.h5");
    warned(&attribute("sweep.h5", "/"), "sweep.h5");
    warned(&attribute("ida.h5", "/"), "ida.h5");
}

/// The tolerance is the user's to set, and what it allows needs no word more; floors that
/// differ by just the tolerance are level.
#[test]
fn the_elevation_tolerance_can_be_set() {
    let near = CASE
        .replace("\"3060 mm\"", "\"3010 mm\"")
        .replace("[4, 1],\n    [5, 2],", "[1, 1]");
    let bench = Bench::new(&near);
    assert!(!bench.text("check case.toml").contains("warning: gap"));
    let far = near.replace("\"3010 mm\"", "\"3300 mm\"");
    std::fs::write(bench.path("case.toml"), &far).unwrap();
    let said = bench.refusal("check case.toml");
    assert!(
        said.contains("by 0.3 m, more than the tolerance of 0.01 m"),
        "{said}"
    );
    let allowed = far.replacen("width", "elevation_tolerance = \"0.3 m\"\nwidth", 1);
    std::fs::write(bench.path("case.toml"), &allowed).unwrap();
    assert!(
        !bench
            .text("run case.toml --no-output")
            .contains("warning: gap")
    );
    // Not so far that any floor is level with any other.
    let wide = allowed.replace("\"0.3 m\"", "\"20 m\"");
    std::fs::write(bench.path("case.toml"), wide).unwrap();
    let said = bench.refusal("check case.toml");
    assert!(
        said.contains("not less than half of the lowest storey"),
        "{said}"
    );
}

/// `levels = "matching"` is advice where some floors match, and never an answer to itself.
#[test]
fn matching_is_advised_only_where_it_helps() {
    let listed = "levels = [\n    [4, 1],\n    [5, 2],\n]";
    let help = |levels: &str, height: &str| {
        let case = CASE.replace(listed, levels).replace("\"3060 mm\"", height);
        Bench::new(&case).refusal("check case.toml")
    };
    let advice = "levels = \"matching\"` to let";
    let said = help("", "[\"3 m\", \"2 m\", \"3 m\", \"3 m\", \"3 m\"]");
    assert!(
        said.contains("floor 2 of \"a\" at 5 m") && said.contains(advice),
        "{said}"
    );
    for levels in ["", "levels = \"matching\""] {
        let said = help(levels, "\"3060 mm\"");
        assert!(!said.contains(advice), "{said}");
        assert!(said.contains("`floor_to_floor = true`"), "{said}");
    }
    let said = help("levels = \"matching\"", "\"3060 mm\"");
    assert!(said.contains("case.toml:19:10"), "{said}");
    assert!(
        said.contains("no floor of \"a\" (3.06, 6.12, 9.18, 12.24, ... m) is level with a floor of \"b\" (3, 6 m; tolerance 0.01 m)"),
        "{said}"
    );
}

/// A variable may move floors: values are tried when the study is read, and combinations of
/// them fail as runs.
#[test]
fn storey_heights_that_a_study_varies() {
    let level = CASE
        .replace("\"3060 mm\"", "\"3 m\"")
        .replace("[4, 1],\n    [5, 2],", "[1, 1], [2, 2]");
    let bench = Bench::new(&level);
    let study = |values: &str| {
        let study = format!(
            "case = \"case.toml\"\n[[variable]]\nname = \"height\"\npath = \"building.a.height\"\n{values}"
        );
        std::fs::write(bench.path("sweep.toml"), study).unwrap();
    };
    study("values = [\"3 m\", \"3.5 m\"]\n");
    let said = bench.refusal("sweep sweep.toml -o out.h5");
    assert!(
        said.contains("sweep.toml:5:") && said.contains("differ in elevation by 0.5 m"),
        "{said}"
    );
    let meant = level.replacen("width", "floor_to_floor = true\nwidth", 1);
    std::fs::write(bench.path("case.toml"), meant).unwrap();
    let said = bench.text("sweep sweep.toml -o out.h5 --csv out.csv");
    assert!(said.contains("gap a-b: storey heights vary"), "{said}");
    let file = bench.file("out.h5");
    let column = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    // What varies is in the coordinate of its variable; the rest stands fast.
    let storeys = column("storey_elevation");
    assert!(storeys[..5].iter().all(|z| z.is_nan()));
    assert_eq!(storeys[5..], [3.0, 6.0]);
    assert!(
        column("level_left_elevation")[..2]
            .iter()
            .all(|z| z.is_nan())
    );
    assert_eq!(column("level_right_elevation")[..2], [3.0, 6.0]);
    let table = std::fs::read_to_string(bench.path("out.csv")).unwrap();
    assert!(table.contains("peak_force: a-b 1-1 [N]"));
    assert!(table.contains("peak_force: b-wall 2-wall (6 m | wall) [N]"));
}

/// Both storeys and both elevations, in every table and file; elevations are the decimal
/// sums of what the case says.
#[test]
fn a_level_is_known_by_its_storeys_and_elevations() {
    let bench = Bench::meant();
    let run = bench.json("run case.toml -o run.h5 --json");
    let check = bench.json("check case.toml --json");
    let gap = bench.json("gap case.toml --points 0 --json");
    for told in [&run, &check, &gap] {
        let pair = &told["gaps"][0]["levels"][1];
        assert_eq!(pair["level"], "5-2");
        assert_eq!(
            (&pair["left_storey"], &pair["right_storey"]),
            (&5.into(), &2.into())
        );
        assert_eq!(pair["left_elevation"], 15.3);
        assert_eq!(pair["right_elevation"], 6.0);
        assert_eq!(pair["width"], 0.005);
        let wall = &told["gaps"][1]["levels"][0];
        assert_eq!(wall["level"], "2-wall");
        assert!(wall["right_storey"].is_null() && wall["right_elevation"].is_null());
    }
    for told in [&run, &check] {
        assert_eq!(told["buildings"][0]["elevation"][4], 15.3);
        let link = &told["links"][0]["levels"][0];
        assert_eq!(
            (&link["level"], &link["left_elevation"]),
            (&"1-1".into(), &3.06.into())
        );
    }
    for command in [
        "run case.toml --no-output",
        "check case.toml",
        "gap case.toml --points 0",
    ] {
        let said = bench.text(command);
        let row = |label: &str| said.lines().find(|l| l.contains(label)).unwrap_or(&said);
        assert!(row(" 5-2 ").contains("15.3 / 6"), "{command}: {said}");
        assert!(row(" 2-wall ").contains("6 / wall"), "{command}: {said}");
    }
    bench.text("report run.h5 -o run.html");
    let page = std::fs::read_to_string(bench.path("run.html")).unwrap();
    assert!(
        page.contains("<th scope=\"row\">5-2</th><td>15.30</td><td>6.000</td>"),
        "table"
    );
    assert!(
        page.contains("level 5-2 (15.30 m | 6.000 m)"),
        "words or figures"
    );
    assert!(page.contains("level 2-wall (6.000 m | wall)"), "wall");
    bench.text("run case.toml --no-output --plot run.svg");
    let plot = std::fs::read_to_string(bench.path("run.svg")).unwrap();
    assert!(plot.contains("a-b level 5-2 (15.3 m | 6 m)"));

    bench.text("gap case.toml --points 0 --codes-csv codes.csv");
    let mut table = csv::Reader::from_path(bench.path("codes.csv")).unwrap();
    let header = table.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|h| h == name).unwrap();
    let columns = [
        "gap",
        "left_storey",
        "right_storey",
        "left_elevation_m",
        "right_elevation_m",
    ]
    .map(column);
    let rows: Vec<_> = table.records().map(Result::unwrap).collect();
    let places = rows.iter().map(|r| columns.map(|c| r[c].to_owned()));
    let places: Vec<_> = places.collect();
    for place in [["a-b", "5", "2", "15.3", "6"], ["b-wall", "2", "", "6", ""]] {
        assert!(places.contains(&place.map(str::to_owned)), "{place:?}");
    }

    bench.text("sweep sweep.toml -o sweep.h5 --csv sweep.csv");
    let table = std::fs::read_to_string(bench.path("sweep.csv")).unwrap();
    assert!(table.contains("peak_force: a-b 5-2 (15.3 m | 6 m) [N]"));
    let file = bench.file("sweep.h5");
    let column = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    assert_eq!(column("storey_elevation")[4], 15.3);
    assert_eq!(column("level_left_elevation"), [12.24, 15.3, 6.0]);
    assert!(column("level_right_elevation")[2].is_nan());
    assert_eq!(column("level_width"), [0.005; 3]);
}

/// The coordinates in a result, and `time` in every group that has histories: the same
/// dataset under another name.
#[test]
fn coordinates_of_a_result() {
    let bench = Bench::meant();
    bench.text("run case.toml -o run.h5");
    let file = bench.file("run.h5");
    let numbers = |name: &str| file.dataset(name).unwrap().read_raw::<f64>().unwrap();
    let units = |name: &str| {
        let data = file.dataset(name).unwrap();
        let read = |a: &str| {
            let text = data.attr(a).unwrap().read_scalar::<VarLenUnicode>();
            text.unwrap().to_string()
        };
        assert!(!read("long_name").is_empty());
        read("units")
    };
    assert_eq!(
        numbers("building/a/storey"),
        [3.06, 6.12, 9.18, 12.24, 15.3]
    );
    assert_eq!(numbers("building/a/peak/storey")[4], 15.3);
    let labels = file.dataset("gap/a-b/level").unwrap();
    let labels = labels.read_raw::<VarLenUnicode>().unwrap();
    let labels: Vec<&str> = labels.iter().map(|l| l.as_str()).collect();
    assert_eq!(labels, ["4-1", "5-2"]);
    assert_eq!(numbers("gap/a-b/left_elevation"), [12.24, 15.3]);
    assert_eq!(numbers("gap/a-b/right_elevation"), [3.0, 6.0]);
    assert_eq!(numbers("gap/a-b/width"), [0.005, 0.005]);
    assert_eq!(numbers("link/a-b/left_elevation"), [3.06]);
    let storeys = |name: &str| file.dataset(name).unwrap().read_raw::<i32>().unwrap();
    assert_eq!(storeys("gap/a-b/left_storey"), [4, 5]);
    assert_eq!(storeys("gap/b-wall/right_storey"), [0]);
    assert!(numbers("gap/b-wall/right_elevation")[0].is_nan());
    assert_eq!(units("gap/a-b/left_elevation"), "m");
    assert_eq!(units("gap/a-b/left_storey"), "1");
    let peak = file.dataset("building/a/peak/acceleration_absolute");
    let said = peak.unwrap().attr("long_name").unwrap();
    let said = said.read_scalar::<VarLenUnicode>().unwrap();
    assert_eq!(said.as_str(), "peak absolute acceleration");
    let time = file.dataset("time").unwrap().loc_info().unwrap();
    for group in [
        "ground",
        "building/a",
        "building/b",
        "gap/a-b",
        "gap/b-wall",
        "link/a-b",
        "energy",
    ] {
        let own = file.dataset(&format!("{group}/time")).unwrap();
        assert_eq!(own.loc_info().unwrap().token, time.token, "{group}");
    }
}

/// Results of versions that named levels by their left elevation alone still have a page.
#[test]
fn a_result_of_an_older_version_has_a_page() {
    let bench = Bench::meant();
    bench.text("run case.toml -o run.h5");
    edit(&bench.path("run.h5"), |file| {
        for (group, elevations) in [
            ("gap/a-b", &[12.24, 15.3][..]),
            ("gap/b-wall", &[6.0]),
            ("link/a-b", &[3.06]),
        ] {
            let group = file.group(group).unwrap();
            for name in [
                "left_storey",
                "right_storey",
                "left_elevation",
                "right_elevation",
                "level",
            ] {
                group.unlink(name).unwrap();
            }
            let data = group.new_dataset::<f64>().shape(elevations.len());
            data.create("level").unwrap().write_raw(elevations).unwrap();
        }
        file.delete_attr("checksum").unwrap();
    });
    bench.text("report run.h5 -o run.html");
    let page = std::fs::read_to_string(bench.path("run.html")).unwrap();
    assert!(page.contains("<th scope=\"row\">2</th><td>15.30</td><td>\u{2013}</td>"));
}
