//! Bad input: exit code, place, remedy; and nothing half-written.
use std::path::Path;
use std::process::{Command, Output};

use crate::support::part_files::no_part_file;

const CASE: &str = r#"
title = "pair"
[[building]]
name = "a"
storeys = 2
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
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
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#;

fn record() -> String {
    let mut text = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..120 {
        let t = f64::from(i) * 0.02;
        text.push_str(&format!("{t:.2},{:.5}\n", 0.4 * (7.0 * t).sin()));
    }
    text
}

fn run_in(folder: &Path, case: &str, record: &str, arguments: &[&str]) -> Output {
    std::fs::write(folder.join("case.toml"), case).unwrap();
    std::fs::write(folder.join("record.csv"), record).unwrap();
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .args(arguments)
        .output()
        .unwrap()
}

/// The message on one line, as the terminal breaks lines where it likes.
fn message(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn refused(case: &str, record: &str, wanted: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        case,
        record,
        &["run", "case.toml", "-o", "out.h5"],
    );
    let text = message(&output);
    assert_eq!(output.status.code(), Some(2), "{text}");
    for part in wanted {
        assert!(text.contains(part), "\"{part}\" is not in: {text}");
    }
    assert!(!folder.path().join("out.h5").exists());
    no_part_file(folder.path());
}

#[test]
fn the_case_itself_is_sound() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        CASE,
        &record(),
        &["run", "case.toml", "-o", "out.h5"],
    );
    assert!(output.status.success(), "{}", message(&output));
    assert!(folder.path().join("out.h5").exists());
    no_part_file(folder.path());
}

/// What is wrong with the record because of a key stands at that key, with its remedy.
#[test]
fn errors_of_the_record_stand_at_the_key_that_makes_them() {
    let mut two = "# Unit: g\ntime_s,NS_g,EW_g\n".to_owned();
    for i in 0..120 {
        let t = f64::from(i) * 0.02;
        two.push_str(&format!("{t:.2},{:.5},{:.5}\n", t.sin(), t.cos()));
    }
    let with = |keys: &str| {
        let file = "file = \"record.csv\"\n";
        CASE.replacen(file, &format!("{file}{keys}\n"), 1)
    };
    for (keys, wanted) in [
        (
            "component = \"UD\"",
            ["case.toml:25:13: ", "help: correct `component`"],
        ),
        (
            "component = \"NS\"\nsecond_component = \"UD\"\nrotate = 40",
            [
                "case.toml:26:20: record.csv: there is no component \"UD\"",
                "help: correct `second_component`",
            ],
        ),
        (
            "component = \"NS\"\nsecond_component = \"EW\"\nrotate = 400",
            [
                "case.toml:27:10: rotation: angle = 400",
                "correct the number",
            ],
        ),
        (
            "component = \"NS\"\ngravity = 9",
            [
                "case.toml:26:11: reading: gravity = 9",
                "correct the number",
            ],
        ),
        (
            "component = \"NS\"\nunit = \"m/s2\"",
            [
                "case.toml:26:8: record.csv: unit is g",
                "do not give the unit",
            ],
        ),
    ] {
        refused(&with(keys), &two, &wanted);
    }
    let plain = "0.00 0.1 0.2\n0.02 0.2 0.3\n0.04 0.3 0.5\n0.06 0.3 0.5\n";
    for (layout, says) in [
        ("a,b", "3 columns where layout \"a,b\" has 2"),
        ("8Z10", "3 columns where layout \"8Z10\" has 1"),
        ("8Z10.2", "the Fortran format \"8Z10.2\" is not understood"),
    ] {
        let keys = format!("unit = \"g\"\ntime_step = 0.02\nlayout = \"{layout}\"");
        refused(&with(&keys), plain, &["case.toml:27:10: record.csv", says]);
    }
    // That of one building likewise.
    let own = CASE.replacen(
        "height = \"3 m\"\n",
        "height = \"3 m\"\nground = { file = \"two.csv\", component = \"UD\" }\n",
        1,
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("two.csv"), &two).unwrap();
    let output = run_in(folder.path(), &own, &record(), &["check", "case.toml"]);
    let text = message(&output);
    assert!(text.contains("case.toml:9:42: "), "{text}");
}

/// A parameter that a law or model does not have is said to be unknown, whatever its value is.
#[test]
fn unknown_parameters_are_known_by_their_names() {
    let link = "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"linear\"\nstiffness = \"1 MN/m\"\n";
    let with = |lines: &str| {
        let link = format!("{link}{lines}\n[ground_motion]");
        CASE.replacen("[ground_motion]", &link, 1)
    };
    let folder = tempfile::tempdir().unwrap();
    let said = |case: &str| {
        let output = run_in(folder.path(), case, &record(), &["check", "case.toml"]);
        message(&output)
    };
    let text = said(&with("wall = \"fixed\"\nstoreys = [1]\nother = { a = 1 }"));
    for part in [
        "case.toml:27:1: law linear has no parameter \"wall\"",
        "case.toml:28:1: law linear has no parameter \"storeys\"",
        "case.toml:29:1: law linear has no parameter \"other\"",
        "its parameters are stiffness",
        "3 errors",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    // Of one that it has the value is wrong, and a slip of a key is said once.
    let text = said(&with("").replacen("\"1 MN/m\"", "\"much\"\nmodl = \"x\"", 1));
    for part in [
        "does not start with a number",
        "unknown key `modl`",
        "2 errors",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let gap = CASE.replacen("restitution = 0.65", "restitution = 0.65\nother = [1]", 1);
    let text = said(&gap);
    assert!(text.contains("case.toml:23:1: "), "{text}");
    assert!(text.contains("has no parameter \"other\""), "{text}");
    assert!(!text.contains("errors"), "{text}");
}

/// A day that is none does not hide a code that is none.
#[test]
fn wrong_dates_and_codes_are_said_together() {
    let with = |keys: &str| format!("{CASE}[separation]\n{keys}\n");
    let date = "case.toml:28:8: ";
    for (keys, wanted) in [
        ("code = \"nosuch_2004\"", "case.toml:29:8: "),
        ("country = \"Atlantis\"", "case.toml:29:11: "),
    ] {
        let case = with(&format!("date = \"2018-02-30\"\n{keys}"));
        refused(&case, &record(), &[date, wanted, "2 errors"]);
    }
    let known = with("date = \"2018-02-30\"\ncode = \"ntc\"");
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), &known, &record(), &["check", "case.toml"]);
    let text = message(&output);
    assert!(text.contains(date) && !text.contains("errors"), "{text}");
}

/// Options of the record that say nothing of it, and quantities without unit where parameters of a
/// law are read.
#[test]
fn what_says_nothing_is_refused() {
    let of_motion = |line: &str| {
        CASE.replacen(
            "file = \"record.csv\"",
            &format!("file = \"record.csv\"\n{line}"),
            1,
        )
    };
    for (line, wanted) in [
        ("sensitivity = 1000", "`sensitivity` is given"),
        ("layout = \"t,a\"", "`layout` is given"),
        ("skip_columns = 2", "`skip_columns` is given"),
    ] {
        let wanted = [
            "record.csv: ",
            wanted,
            "format pounding_csv",
            "leave it out",
        ];
        refused(&of_motion(line), &record(), &wanted);
    }
    let metres = record()
        .replace("Unit: g", "Unit: m/s2")
        .replace("_g", "_m_s2");
    refused(
        &of_motion("gravity = 9.81"),
        &metres,
        &["`gravity` is given"],
    );
    refused(
        &CASE.replacen("\"93.5 MN/m\"", "\"93.5e6\"", 1),
        &record(),
        &[
            "case.toml:21:13: ",
            "must be a stiffness (N/m), but \"93.5e6\" has no unit",
            "93.5e6 without quotes",
        ],
    );
}

/// A step of seconds, one wrong digit in a header, is named where the motion is used.
#[test]
fn steps_of_seconds_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let values = "0.01 -0.02 0.03 -0.01 0.02\n".repeat(20);
    let at2 =
        format!("A\nB\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 100, DT= 2 SEC\n{values}");
    std::fs::write(folder.path().join("record.at2"), at2).unwrap();
    let said = "the time step is 2 s, where accelerographs have 0.0001 s to 0.1 s: with it the 100 samples take 198 s";
    for arguments in [
        "motion info record.at2",
        "motion spectrum record.at2",
        "gap case.toml --records record.at2 --points 0",
        "compare case.toml --records record.at2 --models hertz_1882 --approach-velocity 0.2",
    ] {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let output = run_in(folder.path(), CASE, &record(), &arguments);
        let text = String::from_utf8_lossy(&output.stdout);
        let told = format!("{text} {}", message(&output));
        assert_eq!(text.matches(said).count(), 1, "{arguments:?}: {told}");
        assert!(text.contains("line 4: the time step"), "{told}");
    }
}

/// Numbers of arguments that mean nothing.
#[test]
fn speeds_and_threads_are_above_zero() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, wanted) in [
        (
            "compare case.toml --approach-velocity 0",
            "greater than zero",
        ),
        (
            "compare case.toml --approach-velocity -0.5m/s",
            "greater than zero",
        ),
        ("compare case.toml --threads 0", "0 is not in 1..=4096"),
        ("gap case.toml --threads 0", "0 is not in 1..=4096"),
        ("gap case.toml --points 1000000000", "at most 100000"),
    ] {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        let output = run_in(folder.path(), CASE, &record(), &arguments);
        let text = message(&output);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {text}");
        assert!(text.contains(wanted), "{arguments:?}: {text}");
    }
}

/// A study of the case under its own record.
const SWEEP: &str = r#"case = "case.toml"
[[variable]]
path = "gap.0.stiffness"
values = ["90 MN/m", "95 MN/m"]
"#;

/// A study of the case under other motions.
const IDA: &str = r#"case = "case.toml"
[[variable]]
synthetic = { model = "rezaeian_der_kiureghian_2010", count = 2, seed = 1, time_step = "0.01 s", duration = "30 s", significant_duration = "12 s", middle_time = "8 s", middle_frequency = "3.5 1/s", frequency_rate = "-0.06 1/s^2", damping = 0.3, high_pass = "0.1 Hz" }
[[variable]]
intensity = "peak_ground_acceleration"
from = "0.1 g"
to = "0.4 g"
count = 3
"#;

/// What a study and its case say wrongly is reported together, first that of the study in
/// the order of its file: a part does not hide another, nor the case the study, and nothing
/// is said that only follows.
#[test]
fn errors_of_a_study_and_its_case_are_reported_together() {
    let reported = |command: &str, study: &str, case: &str, wanted: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("study.toml"), study).unwrap();
        let output = run_in(folder.path(), case, &record(), &[command, "study.toml"]);
        let text = message(&output);
        assert_eq!(output.status.code(), Some(2), "{text}");
        let mut from = 0;
        for part in wanted {
            let at = text[from..].find(part);
            from += at.unwrap_or_else(|| panic!("\"{part}\" after {from} in: {text}"));
        }
        assert_eq!(text.matches("help:").count(), wanted.len(), "{text}");
        let count = format!("{} errors", wanted.len());
        assert!(text.contains(&count), "{text}");
    };
    let faulty = CASE.replacen("25 t", "25 q", 1);
    // An unknown key at the root, of a path and of a variable; values that are none.
    let sweep = r#"titel = "a"
case = "case.toml"
[[variable]]
path = "gap.0.stiffness"
from = "90 MN/m"
to = "95 Mn/m"
count = 0
[[variable]]
path = "building.a.mas"
values = ["20 t", "30 t"]
[[variable]]
path = "gap.0.width"
from = "1 cm"
to = "3 cm"
count = -1
spaceing = "linear"
[[variable]]
path = "gap.3.restitution"
values = [0.5, "0.6 t", "x"]
[design]
kind = "sobol"
runs = 0
[output]
chunk = 0
isolated_demand = "yes"
"#;
    let of_sweep = [
        "study.toml:1:1: unknown key `titel`",
        "study.toml:6:6: `to`",
        "study.toml:7:9: `count` must",
        "study.toml:9:8: the case refuses this for `building.a.mas`: unknown key `mas`",
        "study.toml:15:9: `count` must",
        "study.toml:16:1: unknown key `spaceing`",
        "study.toml:18:8: `gap` has 1 entry",
        "study.toml:19:25: `values`",
        "study.toml:22:8: `runs` must",
        "study.toml:24:9: `chunk` must",
        "study.toml:25:19: `isolated_demand` must",
    ];
    reported("sweep", sweep, CASE, &of_sweep);
    // With a case that is not sound, whether it takes values is not known.
    let mut with_case = of_sweep.to_vec();
    with_case.retain(|part| !part.contains("refuses"));
    with_case.push("case.toml:6:8: `mass`");
    reported("sweep", sweep, &faulty, &with_case);
    let ida = r#"case = "case.toml"
[[variable]]
synthetic = { model = "nosuch", count = 0, duration = "30 m", significant_duration = "12 s", middle_time = "8 s", middle_frequncy = "3 Hz" }
[[variable]]
intensity = "spectral_accel"
building = "c"
damping = 2
form = "0.1 g"
to = "0.4 q"
count = 1
[ida]
gaps = ["20 mm", "30 kg"]
hazard = "nosuch.csv"
target_frequency = -1
confidence = 2
limits = 3
[[ida.limit]]
name = 3
demand = "acceleration"
building = "lihgt"
storey = 0
exceeds = "2 x"
"#;
    let of_ida = [
        "study.toml:3:23: unknown model of motions",
        "study.toml:3:41: `count` must",
        "study.toml:3:55: `duration` must be",
        "study.toml:3:115: unknown key `middle_frequncy`",
        "study.toml:5:13: unknown intensity measure",
        "study.toml:6:12: the case has no building \"c\"",
        "study.toml:7:11: `damping` = 2",
        "study.toml:8:1: unknown key `form`",
        "study.toml:9:6: `to`",
        "study.toml:10:9: `count` must",
        "study.toml:12:18: `gaps` must be",
        "study.toml:13:10: nosuch.csv",
        "study.toml:14:20: `target_frequency` = -1",
        "study.toml:15:14: `confidence` lies",
        "study.toml:16:1: unknown key `limits`",
        "study.toml:18:8: `name` must be",
        "study.toml:19:10: unknown demand",
        "study.toml:20:12: the case has no building \"lihgt\"",
        "study.toml:21:10: `storey` must be",
        "study.toml:22:11: `exceeds`",
    ];
    reported("ida", ida, CASE, &of_ida);
    // A case that is not TOML has no buildings to compare names with.
    let broken = CASE.replacen("title = ", "title ", 1);
    let mut with_case = of_ida.to_vec();
    with_case.retain(|part| !part.contains("no building"));
    with_case.push("case.toml:2:7: this is not TOML");
    reported("ida", ida, &broken, &with_case);
}

/// What the three parts of the file say wrongly is told at once, in the order of the file:
/// one part does not hide another, and nothing is said that only follows.
#[test]
fn errors_of_all_sections_are_told_together() {
    let told = |changes: &[(&str, &str)], wanted: &[&str]| {
        let mut case = CASE.to_owned();
        for (from, to) in changes {
            assert!(case.contains(from), "{from}");
            case = case.replacen(from, to, 1);
        }
        let folder = tempfile::tempdir().unwrap();
        // Of a study it is the base case; a study of some records does not look at its own.
        std::fs::write(folder.path().join("sweep.toml"), SWEEP).unwrap();
        std::fs::write(folder.path().join("ida.toml"), IDA).unwrap();
        for command in [
            ["check", "case.toml"],
            ["run", "case.toml"],
            ["gap", "case.toml"],
            ["sweep", "sweep.toml"],
            ["ida", "ida.toml"],
        ] {
            let output = run_in(folder.path(), &case, &record(), &command);
            let text = message(&output);
            assert_eq!(output.status.code(), Some(2), "{text}");
            let own_record = |part: &&&str| !part.contains("cannot read the record");
            let all = wanted.iter();
            let wanted: Vec<_> = match command[0] {
                "ida" => all.filter(own_record).collect(),
                _ => all.collect(),
            };
            if wanted.len() < 2 {
                continue;
            }
            let mut from = 0;
            for part in &wanted {
                let at = text[from..].find(**part);
                from += at.unwrap_or_else(|| panic!("\"{part}\" after {from} in: {text}"));
            }
            assert_eq!(text.matches("help:").count(), wanted.len(), "{text}");
            let count = format!("{} errors", wanted.len());
            assert!(text.contains(&count), "{text}");
        }
    };
    let method = (
        "duration = \"2 s\"",
        "duration = \"2 s\"\nmethod = \"adaptif\"",
    );
    let width = ("20 mm", "20 mn");
    told(
        &[width, method],
        &["case.toml:19:9", "case.toml:27:10: unknown method"],
    );
    told(
        &[
            ("duration = \"2 s\"", "duration = \"2 x\""),
            ("anagnostopoulos_2004", "nosuch"),
        ],
        &["case.toml:20:9: unknown impact model", "case.toml:26:12"],
    );
    told(
        &[("record.csv", "no.csv"), method],
        &["case.toml:24:8: cannot read the record", "case.toml:27:10"],
    );
    told(
        &[
            ("25 t", "25 q"),
            width,
            ("anagnostopoulos_2004", "jankowsky_2005"),
            ("restitution = 0.65", "restitution = 1.5"),
            method,
        ],
        &[
            "case.toml:6:8",
            "case.toml:19:9",
            "case.toml:20:9: unknown impact model",
            "case.toml:27:10",
        ],
    );
    told(
        &[
            ("25 t", "25 q"),
            width,
            ("restitution = 0.65", "restitution = 1.5"),
            method,
        ],
        &[
            "case.toml:6:8",
            "case.toml:19:9",
            "case.toml:22:15",
            "case.toml:27:10",
        ],
    );
    // A stiffness whose unit is wrong is not missing, and a step neither.
    told(
        &[
            ("93.5 MN/m", "93.5 MN/x"),
            ("restitution = 0.65", "restitution = 1.5"),
            (
                "duration = \"2 s\"",
                "method = \"newmark\"\nstep = \"1 mn\"",
            ),
        ],
        &["case.toml:21:13", "case.toml:22:15", "case.toml:27:8"],
    );
    // Laws of storeys whose stiffness is wrong, and floors that are not level.
    told(
        &[
            (
                "stiffness = \"3.46 MN/m\"",
                "stiffness = \"3.46 MN\"\nlaw = { model = \"bilinaer\", yield_force = \"1 kN\" }",
            ),
            ("record.csv", "no.csv"),
            ("height = \"3 m\"", "height = \"3.5 m\""),
            ("width = ", "levels = [[1, 1], [2, 2]]\nwidth = "),
        ],
        &[
            "case.toml:7:13",
            "case.toml:8:17: unknown hysteresis law",
            "case.toml:20:11",
            "case.toml:26:8: cannot read the record",
        ],
    );
}

/// A gap has no law that pulls; a storey is named by the number of those that there are.
#[test]
fn laws_of_links_and_storeys_that_are_not_there() {
    refused(
        &CASE.replace("anagnostopoulos_2004", "tension_only"),
        &record(),
        &[
            "unknown impact model \"tension_only\"",
            "[[link]] with model = \"gap_hook\"",
        ],
    );
    for storey in ["0", "-1", "3", "200000"] {
        refused(
            &CASE.replace("width = ", &format!("levels = [[{storey}, 1]]\nwidth = ")),
            &record(),
            &[
                "case.toml:19:12",
                &format!("\"a\" has no storey {storey}"),
                "name one from 1 to 2",
            ],
        );
    }
}

#[test]
fn unknown_key() {
    refused(
        &CASE.replace("height = \"3 m\"", "hieght = \"3 m\""),
        &record(),
        &[
            "case.toml:8:1",
            "unknown key `hieght`",
            "did you mean `height`?",
        ],
    );
}

#[test]
fn unknown_model_parameter() {
    refused(
        &CASE.replace("restitution = 0.65", "restitutoin = 0.65"),
        &record(),
        &["case.toml:22:1", "restitutoin", "restitution"],
    );
}

#[test]
fn wrong_dimension() {
    refused(
        &CASE.replace("mass = \"25 t\"", "mass = \"25 kN\""),
        &record(),
        &["case.toml:6:8", "must be a mass", "a weight is a force"],
    );
    refused(
        &CASE.replace("\"93.5 MN/m\"", "\"93.5 MN/m^1.5\""),
        &record(),
        &[
            "case.toml:21:13",
            "must be a stiffness (N/m)",
            "correct the unit",
        ],
    );
}

#[test]
fn negative_or_zero_mass() {
    refused(
        &CASE.replace("mass = \"25 t\"", "mass = [\"25 t\", \"-1 t\"]"),
        &record(),
        &[
            "case.toml:6:17",
            "must be greater than zero",
            "write a value above zero",
        ],
    );
    refused(
        &CASE.replace("mass = \"25 t\"", "mass = 0"),
        &record(),
        &["case.toml:6:8", "must be greater than zero"],
    );
    refused(
        &CASE.replace("mass = \"25 t\"", "mass = nan"),
        &record(),
        &["case.toml:6:8", "not a finite number"],
    );
}

#[test]
fn lists_of_unequal_length() {
    refused(
        &CASE.replace("mass = \"25 t\"", "mass = [1e3, 1e3, 1e3]"),
        &record(),
        &[
            "case.toml:6:8",
            "`mass` has 3 values",
            "2 storeys",
            "one value per storey",
        ],
    );
}

#[test]
fn unknown_model() {
    refused(
        &CASE.replace("anagnostopoulos_2004", "anagnostopoulos_2014"),
        &record(),
        &[
            "case.toml:20:9",
            "unknown impact model",
            "did you mean \"anagnostopoulos_2004\"",
        ],
    );
}

#[test]
fn restitution_out_of_range() {
    for value in ["0", "1.2", "-0.5"] {
        refused(
            &CASE.replace("restitution = 0.65", &format!("restitution = {value}")),
            &record(),
            &[
                "case.toml:22:15",
                "outside (0, 1]",
                "separation to approach velocity",
            ],
        );
    }
}

#[test]
fn gap_given_twice() {
    let gap = CASE
        .split("[[gap]]")
        .nth(1)
        .unwrap()
        .split("[ground_motion]")
        .next()
        .unwrap();
    refused(
        &CASE.replace("[ground_motion]", &format!("[[gap]]{gap}[ground_motion]")),
        &record(),
        &[
            "case.toml:24:11",
            "gap given twice",
            "line 18",
            "remove one",
        ],
    );
}

#[test]
fn floors_at_unequal_elevation() {
    let case = CASE.replacen("height = \"3 m\"", "height = \"3.5 m\"", 1);
    refused(
        &case,
        &record(),
        &[
            "case.toml:18:11",
            "floor 1 of \"a\" at 3.5 m",
            "levels = [[1, 1], ...]",
        ],
    );
    let folder = tempfile::tempdir().unwrap();
    let said = case.replace(
        "width = ",
        "levels = [[1, 1], [2, 2]]\nfloor_to_floor = true\nwidth = ",
    );
    let output = run_in(folder.path(), &said, &record(), &["check", "case.toml"]);
    assert!(output.status.success(), "{}", message(&output));
}

#[test]
fn neighbours_in_the_wrong_order_and_overlap() {
    refused(
        &CASE.replace("[\"a\", \"b\"]", "[\"b\", \"a\"]"),
        &record(),
        &["case.toml:18:11", "wrong order"],
    );
    refused(
        &CASE.replace("\"20 mm\"", "\"-20 mm\""),
        &record(),
        &["case.toml:19:9", "zero or more"],
    );
}

#[test]
fn record_without_time_step() {
    let plain: String = (0..100)
        .map(|i| format!("{}\n", f64::from(i % 7) * 0.1))
        .collect();
    refused(
        &CASE.replace("file = ", "unit = \"g\"\nfile = "),
        &plain,
        &[
            "record.csv:1",
            "does not state its time step",
            "time_step = ",
        ],
    );
    refused(
        &CASE.replace("file = ", "time_step = 0.01\nfile = "),
        &plain,
        &["record.csv:1", "does not state the unit", "unit = "],
    );
    // Our layout without its key: the times say it, if they are even.
    let keyless = record().replace("# dt: 0.02 s\n", "");
    let gone = keyless.lines().find(|l| l.starts_with("0.40,")).unwrap();
    refused(
        CASE,
        &keyless.replace(&format!("{gone}\n"), ""),
        &["record.csv", "the time column is not even", "time_step"],
    );
}

#[test]
fn record_shorter_than_its_header_says() {
    let at2 = "PEER\nevent\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS=  12, DT= .0100 SEC\n .1 .2 .3 .4 .5\n .6 .7 .8 .9 1.0\n";
    refused(
        CASE,
        at2,
        &["record.csv", "12 samples", "after 10", "lenient = true"],
    );
}

#[test]
fn damaged_record() {
    refused(
        CASE,
        &record().replacen("0.40,", "0.40,NaN", 1),
        &["record.csv:24:6", "is not a number", "get the record again"],
    );
    refused(
        CASE,
        &record().replacen("0.40,", "0.40,****", 1),
        &["record.csv:24:6", "overflow"],
    );
    refused(
        CASE,
        "",
        &["record.csv: the file is empty", "get the file again"],
    );
    refused(
        CASE,
        "nothing that a reader knows\n",
        &["record.csv", "format of this record is not known"],
    );
}

#[test]
fn missing_files() {
    refused(
        &CASE.replace("record.csv", "absent.csv"),
        &record(),
        &[
            "absent.csv",
            "cannot read the record",
            "relative to the folder of the case",
        ],
    );
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(folder.path(), CASE, &record(), &["run", "absent.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("absent.toml"));
}

#[test]
fn output_that_cannot_be_written() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        CASE,
        &record(),
        &["run", "case.toml", "-o", "no/such/folder/out.h5"],
    );
    assert_eq!(output.status.code(), Some(4), "{}", message(&output));
    assert!(message(&output).contains("out.h5"), "{}", message(&output));
    // A folder under a name that could be that of a file, and names that are those of folders.
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    for (name, code) in [("folder", 4), ("folder/", 2), (".", 2)] {
        let words = ["run", "case.toml", "-o", name];
        let output = run_in(folder.path(), CASE, &record(), &words);
        assert_eq!(output.status.code(), Some(code), "{}", message(&output));
    }
}

/// A device must not be replaced by a file.
#[test]
#[cfg(unix)]
fn an_output_that_is_no_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        CASE,
        &record(),
        &["run", "case.toml", "-o", "/dev/null"],
    );
    assert_eq!(output.status.code(), Some(4), "{}", message(&output));
    assert!(
        message(&output).contains("not a regular file"),
        "{}",
        message(&output)
    );
}

/// The old result stays until the new one is complete.
#[test]
fn an_interrupted_run_leaves_no_half_written_file() {
    let folder = tempfile::tempdir().unwrap();
    let long = CASE.replace("duration = \"2 s\"", "duration = \"4000 s\"");
    std::fs::write(folder.path().join("case.toml"), long).unwrap();
    std::fs::write(folder.path().join("record.csv"), record()).unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder.path())
        .args(["run", "case.toml", "-o", "out.h5"])
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(150));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(!folder.path().join("out.h5").exists());
}

#[test]
#[cfg(unix)]
fn a_case_file_without_end_is_refused() {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(["check", "/dev/zero"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(message(&output).contains("larger than 16 MB"));
}

/// A device without end, and a pipe that nobody writes into, are no inputs of any command.
#[cfg(unix)]
#[test]
fn devices_and_pipes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("case.toml"), CASE).unwrap();
    std::fs::write(folder.path().join("record.csv"), record()).unwrap();
    let made = Command::new("mkfifo")
        .arg(folder.path().join("pipe"))
        .status();
    assert!(made.unwrap().success());
    for call in [
        "verify structures --data INPUT",
        "impact jankowski_2005 --example --against INPUT",
        "gap case.toml --merge INPUT",
        "compare case.toml --merge INPUT",
        "report INPUT",
        "merge INPUT -o out.h5",
        "merge --check INPUT",
        "gap case.toml --rules INPUT",
        "sweep study.toml -o out.h5",
        "ida hazard.toml -o out.h5",
        "report case.toml --study INPUT",
    ] {
        for input in ["/dev/zero", "pipe"] {
            let variable =
                "[[variable]]\nname = \"gap\"\npath = \"gap.width\"\nvalues = [\"20 mm\"]\n";
            let study = format!("case = \"{input}\"\n{variable}");
            std::fs::write(folder.path().join("study.toml"), study).unwrap();
            let hazard = format!(
                "case = \"case.toml\"\n[ida]\nmeasure = \"pga\"\nlevels = [\"0.1 g\", \"0.2 g\"]\nhazard = \"{input}\"\n"
            );
            std::fs::write(folder.path().join("hazard.toml"), hazard).unwrap();
            let call = call.replace("INPUT", input);
            let mut child = Command::new(env!("CARGO_BIN_EXE_pounding"))
                .current_dir(folder.path())
                .env("NO_COLOR", "1")
                .args(call.split(' '))
                .stdout(std::process::Stdio::piped())
                .stderr(std::process::Stdio::piped())
                .spawn()
                .unwrap();
            let began = std::time::Instant::now();
            while child.try_wait().unwrap().is_none() {
                if began.elapsed().as_secs() > 30 {
                    child.kill().unwrap();
                    panic!("{call} has no end");
                }
                std::thread::sleep(std::time::Duration::from_millis(5));
            }
            let output = child.wait_with_output().unwrap();
            let answer = String::from_utf8_lossy(&output.stdout).into_owned();
            let told = answer + &message(&output);
            let refused = if call.contains("--check") { 1 } else { 2 };
            assert_eq!(output.status.code(), Some(refused), "{call}: {told}");
            let words: Vec<&str> = told.split_whitespace().filter(|w| *w != "│").collect();
            let told = words.join(" ");
            assert!(told.contains("no regular file"), "{call}: {told}");
        }
    }
}

#[test]
fn responses_that_no_disk_has_room_for_are_refused() {
    let endless = CASE.replace(
        "duration = \"2 s\"",
        "duration = \"1e6 s\"\noutput_step = \"1e-4 s\"",
    );
    refused(&endless, &record(), &["a result of", "GB", "output_step"]);
}

#[test]
fn a_coarse_step_fails_with_a_diagnosis() {
    let coarse = CASE.replace(
        "duration = \"2 s\"",
        "method = \"runge_kutta_4\"\nstep = \"20 ms\"\nenergy_tolerance = 1e-9",
    );
    let folder = tempfile::tempdir().unwrap();
    let output = run_in(
        folder.path(),
        &coarse,
        &record(),
        &["run", "case.toml", "--no-output"],
    );
    assert_eq!(output.status.code(), Some(3), "{}", message(&output));
    assert!(
        message(&output).contains("energy ledger does not close"),
        "{}",
        message(&output)
    );
    assert!(
        message(&output).contains("smaller `step`"),
        "{}",
        message(&output)
    );
}

/// Of a line of megabytes the place is shown, not all of it.
#[test]
fn a_long_line_is_not_printed() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.toml");
    let masses = "25000.0,".repeat(300_000);
    std::fs::write(
        &case,
        format!("[[building]]\nname = \"light\"\nstoreys = 3\nmass = [{masses}]\n"),
    )
    .unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg("check")
        .arg(&case)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(
        told.contains("`mass` has 300000 values"),
        "{}",
        &told[..500]
    );
    assert!(told.contains("case.toml:4:8"), "{}", &told[..500]);
    assert!(told.len() < 20_000, "{}", told.len());
}

/// A file whose lines end by carriage returns alone: its place is the same in words and beside the
/// excerpt.
#[test]
fn a_place_among_carriage_returns_is_one() {
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.toml");
    std::fs::write(&case, "title = \"a\"\r[[building]]\rname = \"x\"\r").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .env("NO_COLOR", "1")
        .arg("check")
        .arg(&case)
        .output()
        .unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(told.matches("case.toml:1:13").count(), 2, "{told}");
}

/// What is said of files that editors and systems write in other ways, and of names and numbers beyond reason.
#[test]
fn messages_say_what_stands_there() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("record.csv"), record()).unwrap();
    let told = |case: &str, words: &[&str]| {
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .current_dir(folder.path())
            .env("NO_COLOR", "1")
            .args(words)
            .output()
            .unwrap();
        let told = message(&output);
        let words: Vec<&str> = told.split_whitespace().filter(|w| *w != "│").collect();
        words.join(" ")
    };
    let check = |case: &str| told(case, &["check", "case.toml"]);
    let marked = check(&format!("\u{feff}titel = \"t\"\n{CASE}"));
    assert_eq!(marked.matches("case.toml:1:1").count(), 2, "{marked}");
    let returns = check(&CASE.replace('\n', "\r"));
    assert!(returns.contains("save it with line ends of"), "{returns}");
    let micro = check(&format!(
        "[[building]]\nname = \"A\"\nmass = \"25 \u{b5}t\"\n{CASE}"
    ));
    assert!(micro.contains("\"\u{b5}t\" in \"25 \u{b5}t\""), "{micro}");
    let name = "a".repeat(201);
    let long = check(&format!("[[building]]\nname = \"{name}\"\n{CASE}"));
    assert!(long.contains("cannot name a building"), "{long}");
    assert!(long.contains("at most 200 characters"), "{long}");
    let nowhere = told(CASE, &["run", "case.toml", "-o", "nowhere/x.h5"]);
    assert!(
        nowhere.contains("cannot write nowhere/x.h5: the folder nowhere does not exist"),
        "{nowhere}"
    );
    std::fs::create_dir(folder.path().join("shards")).unwrap();
    let every = told(CASE, &["status", "shards", "--watch", "--every", "1e300 s"]);
    assert!(every.contains("--every: \"1e300 s\" is no time"), "{every}");
}

/// What is far out of range is pointed at itself, not at the name of its building or at the file alone.
#[test]
fn values_out_of_range_are_pointed_at() {
    for (from, to, place, said) in [
        ("\"25 t\"", "\"1e300 kg\"", "case.toml:6:8", "mass = 1e300"),
        (
            "\"3.46 MN/m\"",
            "\"1e-300 N/m\"",
            "case.toml:7:13",
            "stiffness = 1e-300",
        ),
        (
            "height = \"3 m\"",
            "height = \"1e300 m\"",
            "case.toml:8:10",
            "height = 1e300",
        ),
        (
            "\"93.5 MN/m\"",
            "\"1e300 N/m\"",
            "case.toml:20:9",
            "stops a floor",
        ),
        ("\"2 s\"", "\"1e300 s\"", "case.toml:26:12", "steps over"),
        (
            "\"2 s\"",
            "\"1e8 s\"\noutput_step = \"0.01 s\"",
            "case.toml:26:12",
            "100 GB are the most",
        ),
        (
            "\"2 s\"",
            "\"2 s\"\noutput_step = \"1e-300 s\"",
            "case.toml:27:15",
            "100 GB are the most",
        ),
    ] {
        let case = CASE.replacen(from, to, 1);
        assert_ne!(case, CASE, "{from}");
        refused(&case, &record(), &[place, said]);
    }
}
