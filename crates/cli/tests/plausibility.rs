//! What is possible but more often a mistake is said once, in `check`, in `run`, in the
//! result file and on the page made of it.
use std::path::Path;
use std::process::Command;

use serde_json::Value;

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

/// The warnings of a case: from `check --json`, and from `run --json`. Text and page are
/// compared with them.
struct Said {
    check: Vec<String>,
    run: Vec<String>,
}

fn pounding(folder: &Path, arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .args(arguments)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// Floors are displaced most before the runs end.
fn record() -> String {
    let mut record = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..120 {
        let t = f64::from(i) * 0.02;
        let shakes = if t < 1.6 { 0.1 } else { 0.0 };
        record.push_str(&format!(
            "{t:.2},{:.5}\n",
            shakes * (2.5 * std::f64::consts::PI * t).sin()
        ));
    }
    record
}

fn said(case: &str) -> Said {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("case.toml"), case).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    let zeros = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n0.00,0\n0.02,0\n0.04,0\n";
    std::fs::write(path.join("zeros.csv"), zeros).unwrap();
    let warnings = |text: &str| -> Vec<String> {
        let all: Value = serde_json::from_str(text).unwrap();
        let all = all["warnings"].as_array().unwrap().iter();
        all.map(|w| w.as_str().unwrap().to_owned()).collect()
    };
    let check = warnings(&pounding(path, &["check", "case.toml", "--json"]));
    let run = warnings(&pounding(
        path,
        &["run", "case.toml", "-o", "out.h5", "--json"],
    ));
    let lines = |text: String| -> Vec<String> {
        let lines = text.lines().filter_map(|l| l.strip_prefix("warning: "));
        lines.map(str::to_owned).collect()
    };
    assert_eq!(lines(pounding(path, &["check", "case.toml"])), check);
    assert_eq!(
        lines(pounding(path, &["run", "case.toml", "--no-output"])),
        run
    );
    pounding(path, &["report", "out.h5", "-o", "page.html"]);
    let page = std::fs::read_to_string(path.join("page.html")).unwrap();
    assert_eq!(
        page.matches("class=\"warning\"").count(),
        run.len(),
        "{run:?}"
    );
    for warning in &run {
        let escaped = warning.replace('"', "&quot;").replace('<', "&lt;");
        assert_eq!(page.matches(&escaped).count(), 1, "{warning}");
    }
    Said { check, run }
}

/// Exactly one warning has these words, before the run and after it.
fn one(said: &Said, words: &[&str]) {
    for all in [&said.check, &said.run] {
        let found = all.iter().filter(|w| words.iter().all(|x| w.contains(x)));
        assert_eq!(found.count(), 1, "{words:?} in {all:#?}");
    }
}

#[test]
fn a_plausible_case_has_no_warning() {
    let said = said(CASE);
    assert!(said.check.is_empty(), "{:?}", said.check);
    assert!(said.run.is_empty(), "{:?}", said.run);
}

/// 25 t gives 0.864 s; a thousand times that, or a hundred-thousandth, no building has.
#[test]
fn periods_that_no_building_has() {
    let heavy = said(&CASE.replacen("25 t", "25000 t", 1));
    one(
        &heavy,
        &["a: the fundamental period is 27.3 s", "\"t\"", "0.864 s"],
    );
    assert_eq!(heavy.check.len(), 1, "{:?}", heavy.check);
    let light = said(&CASE.replacen("\"25 t\"", "0.25", 1));
    one(
        &light,
        &["a: the fundamental period is 0.00273 s", "without its unit"],
    );
}

/// 25 kg where 25 t are meant, 0.0273 s instead of 0.864 s; a model on a shaking table has as little
/// with storeys that are lower, or softer.
#[test]
fn masses_that_no_storey_has() {
    let bare = CASE.replacen("\"25 t\"", "[25, 20]", 1);
    let warned = said(&bare);
    one(
        &warned,
        &[
            "a: no storey has a mass of more than 25 kg",
            "write \"25 t\"",
            "0.02",
        ],
    );
    assert_eq!(warned.check.len(), 1, "{:?}", warned.check);
    let model = said(&bare.replace("height = \"3 m\"", "height = \"0.5 m\""));
    assert!(model.check.is_empty(), "{:?}", model.check);
    // Softer, as in another system of units, or one floor alone: what the floor has is said.
    for (from, to) in [("3.46 MN/m", "0.03 MN/m"), ("[25, 20]", "[1500, 20]")] {
        let warned = said(&bare.replace(from, to));
        one(
            &warned,
            &[
                "a: floor 2 has 20 kg, in a storey of 3 m",
                "a mass without one is in kg",
            ],
        );
        assert_eq!(warned.check.len(), 1, "{:?}", warned.check);
    }
}

/// Heights in cm, and a stiffness matrix with its rows from the roof down, of which periods say nothing.
#[test]
fn storeys_in_centimetres_and_matrices_upside_down() {
    let high = CASE.replace("height = \"3 m\"", "height = 300");
    one(
        &said(&high),
        &["a: storey 2 is 300 m high", "\"300 cm\" would be 3 m"],
    );
    let matrix = |rows: &str| {
        let case = CASE.replacen(
            "stiffness = \"3.46 MN/m\"",
            &format!("stiffness_matrix = {rows}"),
            1,
        );
        said(&case.replacen(
            "{ stiffness_proportional = 0.05 }",
            "{ ratio = 0.05, modes = [1, 2] }",
            1,
        ))
    };
    let sound = matrix("[[6.92e6, -3.46e6], [-3.46e6, 3.46e6]]");
    assert!(sound.check.is_empty(), "{:?}", sound.check);
    one(
        &matrix("[[3.46e6, -3.46e6], [-3.46e6, 6.92e6]]"),
        &[
            "a: in its first mode the lowest floor moves 1.62 times as far as the roof",
            "from the lowest floor up",
        ],
    );
}

/// A building that keeps a record of its own while the others are under another one, and a demand that
/// still grows when the record ends: `gap` and `sweep` say so.
#[test]
fn records_that_stay_and_records_that_end() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let record = |steps: usize, amplitude: f64| {
        let rows = (0..steps).map(|i| {
            let t = 0.01 * i as f64;
            format!("{t:.2},{:.6}\n", amplitude * (6.0 * t).sin())
        });
        format!("time (s),acceleration (m/s2)\n{}", rows.collect::<String>())
    };
    write("record.csv", &record(400, 2.0));
    write("other.csv", &record(40, -2.0));
    let case = CASE.replace("duration = \"2 s\"\n", "");
    let own = case.replacen(
        "name = \"b\"",
        "name = \"b\"\nground = { file = \"record.csv\" }",
        1,
    );
    write("case.toml", &case);
    write("own.toml", &own);
    write(
        "study.toml",
        "case = \"own.toml\"\n[[variable]]\nrecords = [\"other.csv\"]\n",
    );
    let told = |arguments: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(arguments.split(' '))
            .current_dir(folder.path())
            .output()
            .unwrap();
        let both = [output.stdout, output.stderr].concat();
        String::from_utf8(both)
            .unwrap()
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let stays = "\"b\" stays under the record of its own in `ground` while";
    for command in [
        "gap own.toml --points 0 --records other.csv",
        "sweep study.toml -o out.h5",
    ] {
        assert!(
            told(command).contains(stays),
            "{command}: {}",
            told(command)
        );
    }
    assert!(!told("gap own.toml --points 0").contains(stays));
    let ends = "a demand is greatest at the last instant";
    let short = told("gap case.toml --points 0 --records other.csv");
    assert!(short.contains(&format!("other: {ends}")), "{short}");
    assert!(!told("gap case.toml --points 0").contains(ends));
}

/// 40 kN over 3.46 MN/m are 11.6 mm; in N they are 0.0116 mm, with which the run would take steps of
/// microseconds.
#[test]
fn a_yield_force_in_the_wrong_unit() {
    let yielding = |force: &str| {
        let law = format!(
            "law = {{ model = \"bilinear\", yield_force = {force}, hardening_ratio = 0.05 }}"
        );
        said(&CASE.replacen("height = \"3 m\"", &format!("height = \"3 m\"\n{law}"), 1))
    };
    one(
        &yielding("40"),
        &[
            "a, storey 1: it yields at a drift of 0.0116 mm",
            "kN, not N",
        ],
    );
    let meant = yielding("\"40 kN\"");
    assert!(meant.check.is_empty(), "{:?}", meant.check);
}

/// Each is a slip that ran without a word: lengths in mm, swapped factors of Rayleigh damping, densities in t/m3.
#[test]
fn values_as_no_building_has_them() {
    let high = CASE.replace("height = \"3 m\"", "height = 3000");
    let high = said(&high);
    one(
        &high,
        &["a: storey 2 is 3000 m high", "\"3000 mm\" would be 3 m"],
    );
    one(&high, &["b: storey 2 is 3000 m high"]);
    let swapped = CASE.replacen(
        "damping = { ratio = 0.05, modes = [1, 2] }",
        "damping = { rayleigh = { alpha = \"0.002 1/s\", beta = \"0.3 s\" } }",
        1,
    );
    one(
        &said(&swapped),
        &[
            "b: the damping of its fundamental mode is",
            "beta that of the stiffnesses",
        ],
    );
    let weak = CASE.replacen(
        "damping = { ratio = 0.05, modes = [1, 2] }",
        "damping = { dashpots = 50 }",
        1,
    );
    one(
        &said(&weak),
        &[
            "b: the damping of its fundamental mode is",
            "as good as none",
        ],
    );
    let soil = CASE.replacen(
        "damping = { ratio = 0.05, modes = [1, 2] }",
        "damping = { ratio = 0.05, modes = [1, 2] }\nfoundation = { mass = \"250 t\", rotational_inertia = \"14812 t m2\", soil = { shear_wave_speed = \"100 m/s\", density = 1.8, poisson = 0.33, length = \"15 m\", width = \"12 m\" } }",
        1,
    );
    one(
        &said(&soil),
        &["b: the soil makes the fundamental period", "kg/m3"],
    );
    let seat = CASE.replace("width = \"20 mm\"", "width = \"20 mm\"\nseat = 350");
    one(
        &said(&seat),
        &[
            "gap a-b: the seat is 350 m wide",
            "\"350 mm\" would be 0.35 m",
        ],
    );
    let isolated = |isolator: &str| {
        let isolator = format!("stiffness = [\"30 MN/m\"]\nisolator = {{ {isolator} }}");
        let case = CASE.replacen("stiffness = \"30 MN/m\"", &isolator, 1);
        case.replace("{ ratio = 0.05, modes = [1, 2] }", "{ modal = 0.05 }")
    };
    let dish = isolated(
        "model = \"friction_pendulum\", radius = 2000, friction_fast = 0.06, friction_slow = 0.03, rate = \"100 s/m\", yield_displacement = \"0.2 mm\"",
    );
    one(
        &said(&dish),
        &["b: the period of its isolators", "usually 2 to 5 s"],
    );
    let plan = CASE.replacen(
        "stiffness = \"30 MN/m\"",
        "plan = { length = \"12 m\", width = \"10 m\", frames_along = [ { at = -50, stiffness = \"15 MN/m\" }, { at = 50, stiffness = \"15 MN/m\" } ], frames_across = [ { at = 0, stiffness = \"30 MN/m\" } ] }",
        1,
    );
    one(
        &said(&plan),
        &["b: a frame stands -50 m from the mass centre of floors of 10 m"],
    );
}

/// Lists that begin at the wrong end or hold sums, seats in inches, ratios in percent, forces in kN: each ran without a
/// word.
#[test]
fn lists_and_numbers_as_nobody_means_them() {
    let of_b = "storeys = 2\nmass = \"100 t\"\nstiffness = \"30 MN/m\"\nheight = \"3 m\"";
    assert!(CASE.contains(of_b));
    let listed = |stiffness: &str, height: &str| {
        let lists = format!(
            "storeys = 4\nmass = \"100 t\"\nstiffness = [{stiffness}]\nheight = [{height}]"
        );
        let case = CASE.replace(of_b, &lists);
        said(&case.replace("width", "levels = \"matching\"\nwidth"))
    };
    let elevations = listed("40e6, 38e6, 36e6, 30e6", "3, 6, 9, 12");
    one(
        &elevations,
        &[
            "b: its storeys are 3 m high at the bottom and 12 m at the top",
            "grow by 3 m",
            "were these elevations?",
        ],
    );
    let roof_down = listed("20e6, 22e6, 28e6, 36e6", "3, 3, 3, 3");
    one(
        &roof_down,
        &[
            "b: its storeys are stiffer from one to the next, 20 MN/m at the bottom and 36 MN/m",
            "from the roof down?",
        ],
    );
    for sound in [
        listed("40e6, 38e6, 36e6, 30e6", "3, 3.3, 3.6, 3.9"),
        listed("30e6, 31e6, 32e6, 33e6", "3, 3, 3, 3"),
        // Columns that are alike in storeys that get lower, and a soft storey below others.
        listed("13e6, 31e6, 44e6, 72e6", "6, 4.5, 4, 3.4"),
        listed("30e6, 60e6, 61e6, 62e6", "6, 3, 3, 3"),
        listed("20e6, 60e6, 61e6, 62e6", "3, 3, 3, 3"),
        listed("40e6, 38e6, 36e6, 30e6", "3, 4.5, 6, 7.5"),
    ] {
        assert_eq!(sound.check, [""; 0]);
    }
    let seat = CASE.replace("width = \"20 mm\"", "width = \"20 mm\"\nseat = 12");
    one(
        &said(&seat),
        &["gap a-b: the seat is 12 m wide", "\"12 in\" 0.305 m"],
    );
    let damped = |ratio: &str| {
        let model =
            "model = \"anagnostopoulos_2004\"\nstiffness = \"93.5 MN/m\"\nrestitution = 0.65";
        assert!(CASE.contains(model));
        let given = model.replace("restitution = 0.65", &format!("damping_ratio = {ratio}"));
        said(&CASE.replace(model, &given))
    };
    one(
        &damped("5"),
        &["gap a-b: the `damping_ratio` of its contacts is 5", "0.05"],
    );
    assert_eq!(damped("0.05").check, [""; 0]);
    let modal = |ratio: &str| {
        said(&CASE.replace(
            "{ ratio = 0.05, modes = [1, 2] }",
            &format!("{{ modal = {ratio} }}"),
        ))
    };
    one(
        &modal("0.0005"),
        &["b: the damping of its fundamental mode is 0.05 %"],
    );
    assert_eq!(modal("0.001").check, [""; 0]);
    let isolated = |force: &str| {
        let isolator = format!(
            "stiffness = [\"30 MN/m\"]\nisolator = {{ model = \"lead_rubber\", post_yield_stiffness = \"1.26 MN/m\", yield_force = {force} }}"
        );
        let case = CASE.replacen("stiffness = \"30 MN/m\"", &isolator, 1);
        said(&case.replace("{ ratio = 0.05, modes = [1, 2] }", "{ modal = 0.05 }"))
    };
    one(
        &isolated("100"),
        &["b: the strength of its isolators is", "is in N"],
    );
    assert_eq!(isolated("\"100 kN\"").check, [""; 0]);
}

/// E I in kN m2 and a shear in kN, of columns that floors at 2 and 4 m hit.
#[test]
fn columns_that_are_next_to_nothing() {
    let columns = |given: &str| {
        let case = CASE.replacen("height = \"3 m\"", "height = \"2 m\"", 1);
        let column = format!(
            "restitution = 0.65\nlevels = \"all_floors\"\ncolumn = {{ of = \"b\", contact_mass = \"2.4 t\", {given} }}"
        );
        said(&case.replace("restitution = 0.65", &column))
    };
    let soft = columns("flexural_rigidity = 20000");
    one(
        &soft,
        &[
            "gap a-b: the columns of b that are hit in storey 1 give 0.0296 %",
            "20000 N m2",
        ],
    );
    one(
        &columns("flexural_rigidity = \"20 MN m2\", shear_capacity = 900"),
        &[
            "gap a-b: the columns of b that are hit bear a shear of 900 N",
            "in N",
        ],
    );
    let of_columns = |w: &&String| w.contains("the columns of b that are hit");
    // A slender column in a storey of walls, too.
    for given in [
        "flexural_rigidity = \"20 MN m2\", shear_capacity = \"900 kN\"",
        "flexural_rigidity = \"0.6 MN m2\", shear_capacity = \"20 kN\"",
    ] {
        assert_eq!(columns(given).check.iter().find(of_columns), None);
    }
}

/// A row of three with one gap; a link leaves none to be missed, too.
#[test]
fn neighbours_that_nothing_keeps_apart() {
    let row = |more: &str| {
        let third = "[[building]]\nname = \"c\"\nstoreys = 2\nmass = \"50 t\"\nstiffness = \"30 MN/m\"\nheight = \"3 m\"\ndamping = { modal = 0.05 }\n[[gap]]\nbetween = [\"a\"";
        let case = CASE.replace("[[gap]]\nbetween = [\"a\"", third);
        said(&format!("{case}{more}"))
    };
    one(
        &row(""),
        &[
            "nothing keeps \"b\" and \"c\" apart",
            "is a [[gap]] missing? If they stand far apart, a [[gap]] of that width says so",
        ],
    );
    let gap = "[[gap]]\nbetween = [\"b\", \"c\"]\nwidth = \"20 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"93.5 MN/m\"\n";
    let link = "[[link]]\nbetween = [\"b\", \"c\"]\nmodel = \"linear\"\nstiffness = \"1 MN/m\"\n";
    for joined in [gap, link] {
        assert_eq!(row(joined).check, [""; 0], "{joined}");
    }
}

#[test]
fn a_ground_acceleration_that_nobody_feels() {
    let scaled = |pga: &str, building: &str| {
        let case = CASE.replace(
            "file = \"record.csv\"",
            &format!("file = \"record.csv\"\nscale = {{ pga = \"{pga}\" }}"),
        );
        said(&case.replacen("height", &format!("{building}height"), 1))
    };
    one(
        &scaled("0.001 g", ""),
        &[
            "the peak ground acceleration is 0.001 g",
            "unit and scale of the record",
        ],
    );
    assert_eq!(scaled("0.006 g", "").check, [""; 0]);
    let released = scaled("0.001 g", "initial_displacement = \"1 mm\"\n");
    assert_eq!(released.check, [""; 0]);
}

/// Of the case, and of every record that takes its place.
#[test]
fn a_vertical_component_along_the_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let mut record = "SITE CODE= 41000\n LAT.=  35.0000\n LON.= 135.0000\n SAMPLING RATE= 100Hz\n UNIT  = gal(cm/s/s)\n INITIAL TIME = 2000 01 01 00 00 00\nNS,EW,UD\n".to_owned();
    for i in 0..300 {
        let a = 100.0 * (0.1 * f64::from(i)).sin();
        record.push_str(&format!("{a:.3},{:.3},{:.3}\n", 0.5 * a, -0.7 * a));
    }
    std::fs::write(path.join("jma.csv"), record).unwrap();
    let told = |component: &str| {
        let motion = format!("file = \"jma.csv\"\ncomponent = \"{component}\"");
        let case = CASE.replace("file = \"record.csv\"", &motion);
        let case = case.replace("20 mm", "1 m");
        std::fs::write(path.join("case.toml"), case).unwrap();
        let commands = [
            &["check", "case.toml"][..],
            &["run", "case.toml", "--no-output"],
            &["gap", "case.toml", "--points", "0"],
        ];
        commands.map(|arguments| {
            let words = pounding(path, arguments);
            words
                .matches("component \"UD\" is vertical, and the buildings")
                .count()
        })
    };
    assert_eq!(told("UD"), [1; 3]);
    assert_eq!(told("NS"), [0; 3]);
}

#[test]
fn a_gap_wider_than_a_storey_is_high() {
    let said = said(&CASE.replace("20 mm", "20 m"));
    one(&said, &["gap a-b", "20 m is more than the 3 m"]);
    assert_eq!(said.run.len(), 1, "{:?}", said.run);
}

/// 93.5 N/m and kN/m where MN/m are meant, beside storeys of 3.46 MN/m: 2.70e-5 and 0.0270 of them. Of Hertz's law
/// the stiffness at 0.5 m/s is less by its power 0.8.
#[test]
fn a_contact_that_is_softer_than_storeys() {
    let stiff = |stiffness: &str| said(&CASE.replace("\"93.5 MN/m\"", stiffness));
    for (stiffness, words) in [
        (
            "93.5",
            ["93.5 N/m", "2.7e-5 times the 3.46 MN/m", "a million times"],
        ),
        (
            "\"93.5 kN/m\"",
            ["93.5 kN/m", "0.027 times the 3.46 MN/m", "a thousand times"],
        ),
    ] {
        let told = stiff(stiffness);
        one(&told, &words);
        one(
            &told,
            &[
                "gap a-b: the contact is softer than the storeys",
                "of storey 1 of \"a\"",
                "would be 93.5 MN/m",
            ],
        );
        assert_eq!(told.check.len(), 1, "{:?}", told.check);
        let overlap = ["gap a-b level 2-2", "more than the 20 mm"];
        let found = told
            .run
            .iter()
            .filter(|w| overlap.iter().all(|x| w.contains(x)));
        assert_eq!(found.count(), 1, "{:?}", told.run);
    }
    let power = |model: &str, stiffness: &str| {
        let model = CASE.replace("anagnostopoulos_2004", model);
        said(&model.replace("93.5 MN/m", stiffness))
    };
    let hertz = power("jankowski_2005", "2.75e3 N/m^1.5");
    one(
        &hertz,
        &["gap a-b: the contact is softer", "a million times"],
    );
    // As stiff as is usual, softer than usual, and soft by intention.
    for sound in [
        power("jankowski_2005", "2.75e9 N/m^1.5"),
        stiff("\"5 MN/m\""),
        power("polycarpou_2013", "1e6 N/m^2.65"),
    ] {
        assert_eq!(sound.check, [""; 0]);
    }
    // On soil the storeys are as stiff as on a fixed base; where one of both has none, nothing is known.
    let soil = "height = \"3 m\"\n[building.foundation]\nmass = \"150 t\"\nrotational_inertia = \"5400 t m2\"\nsoil = { shear_wave_speed = \"180 m/s\", density = \"1.8 t/m3\", poisson = 0.33, length = \"12 m\", width = \"12 m\" }";
    let on_soil = |case: &str| {
        let (first, others) = case.split_once("[[gap]]").unwrap();
        let (a, b) = first.rsplit_once("[[building]]").unwrap();
        let a = a
            .replace("height = \"3 m\"", "height = \"3 m\"\n")
            .trim_end()
            .to_owned();
        let table = soil.trim_start_matches("height = \"3 m\"\n");
        format!("{a}\n{table}\n[[building]]{b}[[gap]]{others}")
    };
    one(
        &said(&on_soil(&CASE.replace("93.5 MN/m", "93.5 kN/m"))),
        &[
            "93.5 kN/m",
            "0.027 times the 3.46 MN/m",
            "of storey 1 of \"a\"",
        ],
    );
    let stiff_beside_soft = |a: &str| {
        CASE.replace("stiffness = \"3.46 MN/m\"", a)
            .replace("\"30 MN/m\"", "\"2215 MN/m\"")
            .replace("\"100 t\"", "\"1000 t\"")
    };
    for sound in [
        on_soil(&stiff_beside_soft("stiffness = \"3.46 MN/m\"")),
        stiff_beside_soft("cantilever = { flexural_rigidity = \"6 GN m2\" }").replacen(
            "{ stiffness_proportional = 0.05 }",
            "{ ratio = 0.05, modes = [1, 2] }",
            1,
        ),
    ] {
        assert_eq!(said(&sound).check, [""; 0], "{sound}");
    }
    // Walls have no storeys, and hold as well.
    let wall = CASE
        .replace("[\"a\", \"b\"]", "[\"b\", \"wall\"]\nlevels = [1, 2]")
        .replace("93.5 MN/m", "1 MN/m");
    one(
        &said(&wall),
        &["1 MN/m", "the 30 MN/m of storey 1 of \"b\""],
    );
}

/// Widths of gaps and peaks of records that a study varies are asked about as those of a case.
#[test]
fn bare_values_of_paths() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let scaled = CASE.replace("file =", "scale = { pga = \"0.3 g\" }\nfile =");
    std::fs::write(path.join("case.toml"), scaled).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    for (entry, values, meant) in [
        (
            "ground_motion.scale.pga",
            "values = [0.2, 0.6, 0.4]",
            "the greatest of `ground_motion.scale.pga`: `pga` of `scale` is 0.6 m/s2 (0.061183 g)",
        ),
        (
            "ground_motion.scale.pga",
            "from = 0.2\nto = 0.6\ncount = 2",
            "was \"0.6 g\" meant?",
        ),
        ("ground_motion.scale.pga", "values = [0.2, 5]", ""),
        ("ground_motion.scale.pga", "values = [\"0.02 g\"]", ""),
        (
            "gap.a-b.width",
            "values = [1, 2]",
            "was \"2 cm\" or \"2 in\" meant?",
        ),
        ("gap.a-b.width", "values = [\"1 m\", \"2 m\"]", ""),
        ("gap.a-b.width", "values = [0.1, 0.2]", ""),
    ] {
        let text = format!("case = \"case.toml\"\n[[variable]]\npath = \"{entry}\"\n{values}\n");
        std::fs::write(path.join("study.toml"), text).unwrap();
        let told = pounding(path, &["sweep", "study.toml", "-o", "out.h5"]);
        match meant {
            "" => assert!(!told.contains("meant?"), "{values}: {told}"),
            meant => assert!(told.contains(meant), "{values}: {told}"),
        }
    }
}

/// Peaks and intensities in m/s2 that are usual in g, in every command that scales records.
#[test]
fn accelerations_without_a_unit() {
    let bare = CASE
        .replace("file =", "scale = { pga = 0.3 }\nfile =")
        .replace("20 mm", "2.9 m");
    let question = "`pga` of `scale` is 0.3 m/s2 (0.0305915 g)";
    one(&said(&bare), &[question, "was \"0.3 g\" meant?"]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("bare.toml"), &bare).unwrap();
    std::fs::write(path.join("case.toml"), CASE).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    let study = |case: &str, variable: &str| {
        format!(
            "case = \"{case}\"\n[[variable]]\nrecords = [\"record.csv\"]\n[[variable]]\n{variable}"
        )
    };
    let widths = "path = \"gap.0.width\"\nvalues = [0.02]\n";
    let intensity = |values: &str| format!("intensity = \"peak_ground_acceleration\"\n{values}\n");
    for (name, text) in [
        ("widths.toml", study("bare.toml", widths)),
        (
            "list.toml",
            study("case.toml", &intensity("values = [0.1, 0.2]")),
        ),
        (
            "range.toml",
            study("case.toml", &intensity("from = 0.05\nto = 0.2\ncount = 2")),
        ),
        (
            "unit.toml",
            study(
                "case.toml",
                &intensity("values = [\"0.1 m/s2\", \"0.2 m/s2\"]"),
            ),
        ),
        (
            "strong.toml",
            study("case.toml", &intensity("values = [1, 3]")),
        ),
    ] {
        std::fs::write(path.join(name), text).unwrap();
    }
    let of_intensity = "the greatest `intensity`, peak ground acceleration, is 0.2 m/s2";
    let models = [
        "--models",
        "linear_elastic",
        "--approach-velocity",
        "0.5 m/s",
    ];
    let compare = [&["compare", "bare.toml"][..], &models].concat();
    for (arguments, words, count) in [
        (&["gap", "bare.toml", "--points", "0"][..], question, 1),
        (&compare, question, 1),
        (&["sweep", "widths.toml", "-o", "a.h5"], question, 1),
        (&["sweep", "list.toml", "-o", "b.h5"], of_intensity, 1),
        (&["sweep", "range.toml", "-o", "c.h5"], of_intensity, 1),
        (
            &["sweep", "unit.toml", "-o", "d.h5"],
            "greatest `intensity`",
            0,
        ),
        (
            &["sweep", "strong.toml", "-o", "e.h5"],
            "greatest `intensity`",
            0,
        ),
    ] {
        let told = pounding(path, arguments);
        let told: Vec<&str> = told.split_whitespace().collect();
        let told = told.join(" ");
        assert_eq!(told.matches(words).count(), count, "{arguments:?}: {told}");
    }
}

#[test]
fn a_ground_acceleration_that_no_record_has() {
    let said = said(&CASE.replace(
        "file = \"record.csv\"",
        "file = \"record.csv\"\nscale = { pga = \"3.5 g\" }",
    ));
    one(&said, &["peak ground acceleration is 3.5 g"]);
}

/// Commands that take many records say of the case what `run` says, and of the records what was said
/// when they were read: once for each kind. A study whose variables change entries of the case says
/// nothing of values that may be in no run.
#[test]
fn commands_of_many_records_say_what_run_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let bare = CASE
        .replacen("\"25 t\"", "[25, 20]", 1)
        .replace("20 mm", "2.9 m");
    std::fs::write(path.join("case.toml"), &bare).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    // Accelerations in cm/s2 that are called g, the second a tenth larger.
    for (name, peak) in [("first.csv", 98.1), ("second.csv", 107.9)] {
        let rows = (0..120).map(|i| {
            let t = f64::from(i) * 0.02;
            format!("{t:.2},{}\n", if i == 60 { peak } else { 0.0 })
        });
        let header = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n";
        std::fs::write(
            path.join(name),
            header.to_owned() + &rows.collect::<String>(),
        )
        .unwrap();
    }
    let mass = "a: no storey has a mass of more than 25 kg";
    let unit = "first: peak acceleration 962.032 m/s2 is larger than any recorded; check the unit; one more of the records is like it";
    let records = ["--records", "record.csv", "first.csv", "second.csv"];
    let gap = [&["gap", "case.toml", "--points", "0"][..], &records].concat();
    let compare = [
        &[
            "compare",
            "case.toml",
            "--models",
            "linear_elastic",
            "--approach-velocity",
            "0.5 m/s",
        ][..],
        &records,
    ]
    .concat();
    let study = |variable: &str| {
        format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"record.csv\", \"first.csv\", \"second.csv\"]\n{variable}"
        )
    };
    std::fs::write(path.join("study.toml"), study("")).unwrap();
    let widths = "[[variable]]\npath = \"gap.0.width\"\nvalues = [2.8]\n";
    std::fs::write(path.join("widths.toml"), study(widths)).unwrap();
    let sweep = ["sweep", "study.toml", "-o", "out.h5"];
    let varied = ["sweep", "widths.toml", "-o", "widths.h5"];
    for (arguments, of_case) in [(&gap[..], 1), (&compare, 1), (&sweep, 1), (&varied, 1)] {
        let told = pounding(path, arguments);
        assert_eq!(told.matches(mass).count(), of_case, "{arguments:?}: {told}");
        assert_eq!(told.matches(unit).count(), 1, "{arguments:?}: {told}");
        assert_eq!(
            told.matches("larger than any").count(),
            1,
            "{arguments:?}: {told}"
        );
    }
}

/// A zero-phase filter puts 3.375 s of zeros before the record, which a `duration` chosen for the record
/// takes for the shaking.
#[test]
fn a_run_that_ends_before_the_peak_of_its_record() {
    let filtered = CASE.replace(
        "file = \"record.csv\"",
        "file = \"record.csv\"\nprocess = [{ filter = { high_pass = \"1 Hz\" } }]",
    );
    let words = [
        "the run ends at 2 s, before the peak ground acceleration at",
        "`keep_pads = false`",
    ];
    one(&said(&filtered), &words);
    for sound in ["duration = \"2 s\"", "duration = \"5.5 s\""] {
        let text = match sound.contains("5.5") {
            true => filtered.replace("duration = \"2 s\"", sound),
            false => CASE.to_owned(),
        };
        assert_eq!(said(&text).check, [""; 0], "{sound}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("case.toml"), &filtered).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    let study =
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\"]\n";
    std::fs::write(path.join("study.toml"), study).unwrap();
    let at = "record: the run ends at 2 s, before the peak ground acceleration";
    let gap = ["gap", "case.toml"];
    let compare = [
        "compare",
        "case.toml",
        "--models",
        "linear_elastic",
        "--approach-velocity",
        "0.5 m/s",
    ];
    let sweep = ["sweep", "study.toml", "-o", "out.h5"];
    for arguments in [&gap[..], &compare, &sweep] {
        let told = pounding(path, arguments);
        assert_eq!(told.matches(at).count(), 1, "{arguments:?}: {told}");
    }
}

#[test]
fn keys_of_another_method() {
    let with =
        |keys: &str| CASE.replace("duration = \"2 s\"", &format!("duration = \"2 s\"\n{keys}"));
    let both = with("step = \"1 ms\"\nbeta = 0.25");
    one(
        &said(&both),
        &[
            "`step` (of newmark, hht_alpha, runge_kutta_4, moreau_jean), `beta` (of newmark) do nothing with method event_driven",
            "give a `method` that takes it",
        ],
    );
    let taken = with("step = \"1 ms\"\nbeta = 0.25\nmethod = \"newmark\"");
    assert_eq!(said(&taken).check, [""; 0]);
    let tolerance = with("step = \"1 ms\"\nrelative_tolerance = 1e-9\nmethod = \"newmark\"");
    one(
        &said(&tolerance),
        &["`relative_tolerance` (of adaptive, event_driven) does nothing with method newmark"],
    );

    // A study of methods gives the keys of all of them.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    std::fs::write(path.join("case.toml"), &both).unwrap();
    std::fs::write(path.join("record.csv"), record()).unwrap();
    for (varied, values, count) in [
        ("analysis.method", "[\"event_driven\", \"newmark\"]", 0),
        ("analysis.step", "[1e-3, 2e-3]", 1),
    ] {
        let study =
            format!("case = \"case.toml\"\n[[variable]]\npath = \"{varied}\"\nvalues = {values}\n");
        std::fs::write(path.join("study.toml"), study).unwrap();
        let told = pounding(path, &["sweep", "study.toml", "-o", &format!("{count}.h5")]);
        assert_eq!(told.matches("nothing with method").count(), count, "{told}");
    }
    // A key that stands in the study alone, and what no result of a study tells of.
    std::fs::write(path.join("case.toml"), CASE).unwrap();
    for (varied, values, words) in [
        (
            "analysis.step",
            "[1e-3, 2e-3]",
            "`analysis.step` (of newmark, hht_alpha, runge_kutta_4, moreau_jean) does nothing with method event_driven",
        ),
        (
            "separation.importance",
            "[1.0, 1.5]",
            "no result of a study tells of `separation.importance`",
        ),
        (
            "gap.0.seat",
            "[0.1, 0.2]",
            "`gap.0.seat` moves nothing: runs that differ in it alone are equal",
        ),
        ("gap.0.width", "[0.1, 0.2]", ""),
    ] {
        let study =
            format!("case = \"case.toml\"\n[[variable]]\npath = \"{varied}\"\nvalues = {values}\n");
        std::fs::write(path.join("study.toml"), study).unwrap();
        let told = pounding(
            path,
            &["sweep", "study.toml", "-o", &format!("{varied}.h5")],
        );
        let told: Vec<&str> = told.split_whitespace().collect();
        let told = told.join(" ");
        assert_eq!(
            told.contains("runs that differ in it alone are equal"),
            !words.is_empty(),
            "{told}"
        );
        assert!(told.contains(words), "{told}");
    }
}

/// A force that the run does not reach, or whose largest value it does not.
#[test]
fn a_run_that_ends_before_a_force() {
    for (points, delay, words) in [
        (
            "[[0, 0], [1, 1e5]]",
            100,
            "before the force on storey 2 of b is largest, at 101 s",
        ),
        ("[[0, 1e4], [5, 1e5]]", 0, "the run ends at 2 s"),
        ("[[0, 1e5], [5, 1e4]]", 0, ""),
    ] {
        let force =
            format!("[[building.force]]\nstorey = 2\npoints = {points}\ndelay = {delay}\n[[gap]]");
        let told = said(&CASE.replacen("[[gap]]", &force, 1));
        match words {
            "" => assert!(told.check.is_empty(), "{:?}", told.check),
            words => one(&told, &[words]),
        }
    }
}

#[test]
fn a_case_in_which_nothing_moves() {
    let still = CASE.replace("record.csv", "zeros.csv");
    one(&said(&still), &["nothing moves", "[[building.force]]"]);
    let released = still.replace(
        "name = \"a\"\n",
        "name = \"a\"\ninitial_displacement = -0.01\n",
    );
    let pushed = still.replace(
        "[[building]]\nname = \"b\"",
        "[[building.force]]\nstorey = 1\nconstant = \"10 kN\"\n[[building]]\nname = \"b\"",
    );
    for text in [released, pushed] {
        let told = said(&text);
        // That of the record, which says its samples are zero, alone.
        assert_eq!(told.check.len(), 1, "{:?}", told.check);
        assert!(!told.check[0].contains("nothing moves"), "{:?}", told.check);
    }
}

/// Known after the run alone; with P-Delta the same cause is still one warning.
#[test]
fn a_drift_of_more_than_a_tenth_of_the_height() {
    for gravity in ["", "p_delta = true\n"] {
        let strong = CASE
            .replace("name = \"a\"\n", &format!("name = \"a\"\n{gravity}"))
            .replace("file =", "scale = { pga = \"1 g\" }\nfile =")
            .replace("20 mm", "900 mm");
        let said = said(&strong);
        assert!(said.check.is_empty(), "{:?}", said.check);
        assert_eq!(said.run.len(), 1, "{:?}", said.run);
        assert!(said.run[0].starts_with("a, storey 1: the peak drift is"));
        assert_eq!(said.run[0].contains("P-Delta"), !gravity.is_empty());
    }
}

/// By hand, two floors of 25 t on 0.1 MN/m and 30 MN/m: the upper storey takes
/// `k2 d2^2 / (k1 d1^2 + k2 d2^2)` of the damping in proportion to the stiffness, with
/// `d2 / d1 = k1 / (2 k2)` for two equal masses that move together: 0.08 %.
/// By an independent integration of this building: floors move up to 0.226 of the storey height beside one another, of
/// which the storeys themselves drift by 2.6 % only.
#[test]
fn gravity_through_the_rotation_of_a_foundation() {
    let case = r#"
[[building]]
name = "A"
storeys = 2
mass = ["20 t", "15 t"]
stiffness = ["12 MN/m", "9 MN/m"]
height = "3 m"
damping = { stiffness_proportional = 0.05 }
p_delta = true
law = { model = "bilinear", yield_force = ["150 kN", "90 kN"], hardening_ratio = 0.05 }
foundation = { rotational_inertia = "200 t m2", rocking = { stiffness = "2.5 MN m/rad", dashpot = "0.1 MN m s/rad" }, length = "8 m" }
[ground_motion]
file = "record.csv"
scale = 12
[analysis]
duration = "2 s"
"#;
    let run = said(case).run;
    let drift = "storey 1: the peak drift, with the rotation of the foundation at most, is";
    assert!(run.iter().any(|w| w.contains(drift)), "{run:?}");
    let run = said(&case.replace("p_delta = true", "p_delta = false")).run;
    assert!(!run.iter().any(|w| w.contains("the peak drift")), "{run:?}");
}

#[test]
fn damping_that_brakes_the_isolators() {
    let isolated = CASE.replace("stiffness = \"3.46 MN/m\"", "stiffness = [1e5, 3e7]");
    let proportional = said(&isolated);
    one(
        &proportional,
        &[
            "a stands on a soft first storey",
            "5.0 % of critical",
            "100 % act",
        ],
    );
    let rayleigh = isolated.replace(
        "{ stiffness_proportional = 0.05 }",
        "{ ratio = 0.05, modes = [1, 2] }",
    );
    one(&said(&rayleigh), &["a stands on a soft first storey"]);
    let modal = isolated.replace("{ stiffness_proportional = 0.05 }", "{ modal = 0.05 }");
    let modal = said(&modal);
    assert!(modal.check.is_empty(), "{:?}", modal.check);
}

/// A layer of isolators is given by its law, too: 40 MN/m that yield and leave 4 MN/m below
/// storeys of 100 MN/m. With the damping `C = 0.3 M + 0.004 K` of the elastic stiffness and
/// floors of 100 t that move as one on 4 MN/m, the ratio is
/// `(0.3 M + 0.004 * 40e6) / (2 sqrt(4e6 M))` for `M = 400 t`: 11.1 %, of which storeys above
/// that are not rigid leave 10.8 %.
#[test]
fn damping_that_brakes_isolators_after_yield() {
    let law = |stiffness: &str, law: &str, damping: &str| {
        CASE.replacen("storeys = 2", "storeys = 4", 1)
            .replacen("25 t", "100 t", 1)
            .replacen(
                "\"3.46 MN/m\"",
                &format!("{stiffness}\np_delta = false\nlaw = {law}"),
                1,
            )
            .replacen("{ stiffness_proportional = 0.05 }", damping, 1)
    };
    const LAYER: &str = "[\"40 MN/m\", \"100 MN/m\", \"100 MN/m\", \"100 MN/m\"]";
    const RAYLEIGH: &str = "{ rayleigh = { alpha = 0.3, beta = 0.004 } }";
    let below = |law: &str| format!("{{ model = {law}, storeys = [1], yield_force = \"200 kN\" }}");
    let told = said(&law(
        LAYER,
        &below("\"bilinear\", hardening_ratio = 0.1"),
        RAYLEIGH,
    ));
    assert_eq!(told.check.len(), 1, "{:?}", told.check);
    for part in [
        "a stands on a first storey that is soft after yield (4 MN/m)",
        "of the 10.8 %",
        "with that stiffness",
    ] {
        assert!(told.check[0].contains(part), "{:?}", told.check);
    }
    let slider = said(&law(
        LAYER,
        &below("\"elastic_perfectly_plastic\""),
        RAYLEIGH,
    ));
    assert!(
        slider.check[0].contains("soft after yield (0 MN/m)"),
        "{:?}",
        slider.check
    );
    // A frame that yields everywhere is none, and neither is one that stays stiff.
    let all = "{ model = \"bilinear\", yield_force = \"200 kN\", hardening_ratio = 0.1 }";
    let stiff = below("\"bilinear\", hardening_ratio = 0.6");
    let modal = "{ modal = 0.05 }";
    let layer = below("\"bilinear\", hardening_ratio = 0.1");
    for case in [
        law(LAYER, all, RAYLEIGH),
        law(LAYER, &stiff, RAYLEIGH),
        law(LAYER, &layer, modal),
    ] {
        let told = said(&case);
        assert!(told.check.is_empty(), "{:?}", told.check);
    }
}

/// `pi sqrt(m / k) = 45.9 ms` for 20 t and 93.5 MN/m, elastic in approach.
#[test]
fn fixed_steps_that_are_too_coarse_for_the_contact() {
    let stepped = |method: &str, step: &str| {
        let analysis = format!(
            "duration = \"2 s\"\nmethod = \"{method}\"\nstep = \"{step}\"\nenergy_tolerance = 10"
        );
        CASE.replace("duration = \"2 s\"", &analysis)
    };
    for method in ["newmark", "hht_alpha", "runge_kutta_4"] {
        let coarse = said(&stepped(method, "10 ms"));
        one(&coarse, &["a step of 10 ms is too coarse", "gap a-b"]);
        assert!(coarse.check[0].contains("an approach velocity of 0.5 m/s"));
        assert!(coarse.run[0].contains("the approach velocity of"));
        let fine = said(&stepped(method, "1 ms"));
        assert!(fine.check.is_empty() && fine.run.is_empty());
    }
    let hertz = stepped("newmark", "10 ms")
        .replace("anagnostopoulos_2004", "jankowski_2005")
        .replace("93.5 MN/m", "2.75e9 N/m^1.5");
    one(&said(&hertz), &["a step of 10 ms is too coarse"]);
    // Floors that never touch need no steps in contact: the run knows.
    let apart = said(&stepped("newmark", "10 ms").replace("20 mm", "2 m"));
    assert_eq!(apart.check.len(), 1);
    assert!(apart.run.is_empty(), "{:?}", apart.run);
}

/// Of links that ran without a word: a stiffness in N/m that was meant in MN/m, a damper in N s/m, a slack in m.
#[test]
fn links_that_take_no_force() {
    let linked = |law: &str| {
        said(&format!(
            "{CASE}\n[[link]]\nname = \"tie\"\nbetween = [\"a\", \"b\"]\n{law}\n"
        ))
    };
    let none = "link tie: it takes";
    let weak = [
        "model = \"linear\"\nstiffness = 24",
        "model = \"viscous_damper\"\ndamping = 120",
        "model = \"bouc_wen\"\nstiffness = 2\nyield_force = \"1 N\"\nhardening_ratio = 0.1",
        "model = \"bouc_wen\"\nstiffness = \"24 MN/m\"\nyield_force = 100\nhardening_ratio = 0",
        "model = \"elastoplastic_gap\"\ngap = \"20 m\"\nstiffness = \"24 MN/m\"\nyield_force = \"100 kN\"",
    ];
    for law in weak {
        one(&linked(law), &[none, "check the units of its parameters"]);
    }
    let sound = [
        "model = \"linear\"\nstiffness = \"24 kN/m\"",
        "model = \"viscous_damper\"\ndamping = \"12 kN s/m\"",
        "model = \"viscous_damper\"\ndamping = \"120 kN s^0.4/m^0.4\"\nexponent = 0.4",
        "model = \"elastic_perfectly_plastic\"\nstiffness = \"24 MN/m\"\nyield_force = \"10 kN\"",
        "model = \"bouc_wen\"\nstiffness = \"24 MN/m\"\nyield_force = \"10 kN\"\nhardening_ratio = 0",
        // It has lost its strength before it is deformed by a millimetre.
        "model = \"ibarra_medina_krawinkler_2005_bilinear\"\nstiffness = \"50 MN/m\"\nyield_force = \"20 kN\"\ncapping_deformation = \"0.5 mm\"\nsoftening_ratio = 1",
    ];
    for law in sound {
        let check = linked(law).check;
        assert!(check.is_empty(), "{law}: {check:?}");
    }
}

/// At resonance each swing is larger than the one before.
#[test]
fn a_run_that_ends_while_floors_still_go_further() {
    let short = CASE.replace("duration = \"2 s\"", "duration = \"1.05 s\"");
    let told = said(&short);
    assert!(told.check.is_empty(), "{:?}", told.check);
    let ends = "the displacement is greatest where the run ends, at 1.05 s";
    let found = told.run.iter().filter(|w| w.contains(ends)).count();
    assert_eq!(found, 1, "{:?}", told.run);
    assert!(said(CASE).run.is_empty());
}
