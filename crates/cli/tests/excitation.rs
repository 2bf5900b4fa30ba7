//! What moves and pushes buildings, on the command line: forces on floors, delays, records of
//! buildings and across the row, in every command that answers with them; and floors that turn
//! in studies.
use std::path::Path;

use serde_json::Value;

use crate::support::Bench;

/// A bench with an example, for a shorter time.
fn example(name: &str, duration: &str, shorter: &str) -> Bench {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(name);
    let text = std::fs::read_to_string(folder.join("case.toml")).unwrap();
    assert!(text.contains(duration), "{text}");
    let text = text.replace("../../ground_motions", "MOTIONS");
    let bench = Bench::with(&text.replace(duration, shorter));
    for file in ["at_rest.csv", "blast.csv"] {
        if let Ok(text) = std::fs::read_to_string(folder.join(file)) {
            bench.write(file, &text);
        }
    }
    bench
}

fn has(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "{word}\n{text}");
    }
}

fn history(bench: &Bench, name: &str) -> Vec<f64> {
    let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
    file.dataset(name).unwrap().read_raw().unwrap()
}

#[test]
fn forces_reach_every_command() {
    let bench = example("blast_beside_a_tower", "\"15 s\"", "\"2 s\"");
    let lines = [
        "building low: force on storey 2, blast.csv, column 3, up to 7600 kN at 1 s",
        "building tower: force on storey 6, constant, up to 150 kN at 0 s",
    ];
    let shown = bench.text("run case.toml -o case.h5");
    has(&shown, &lines);
    has(&shown, &["all samples are zero: the ground stands still"]);
    has(&bench.text("check case.toml"), &lines);
    has(
        &bench.json("check case.toml")["ground_motion"]["echo"].to_string(),
        &lines,
    );
    // On the grid of 0.01 s: half of the triangle at 1.04 s, the wind before and after.
    let low = history(&bench, "building/low/applied_force");
    assert!(
        (low[104 * 3 + 1] / 3.8e6 - 1.0).abs() < 1e-9,
        "{}",
        low[104 * 3 + 1]
    );
    assert_eq!((low[99 * 3], low[109 * 3]), (0.0, 0.0));
    let tower = history(&bench, "building/tower/applied_force");
    assert_eq!(
        (tower[5], tower[100 * 6 + 5], tower[100 * 6 + 4]),
        (-150e3, -150e3, 0.0)
    );
    bench.text("report case.h5 -o case.html");
    has(&bench.read("case.html"), &lines);
    has(
        &bench.read("case.html"),
        &["<p>The forces on floors bring "],
    );

    // Each doubles the blast in its own way: a variable, and the case.
    bench.write("study.toml", "case = \"case.toml\"\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [\"15 mm\", \"30 mm\"]\n[[variable]]\nname = \"blast\"\npath = \"building.low.force.0.scale\"\nvalues = [1, 2]\n");
    bench.text("sweep study.toml -o study.h5 --csv study.csv");
    let table = bench.read("study.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let heading = "peak_displacement: low 1 [m]";
    let column = rows[0]
        .iter()
        .position(|c| c.trim_matches('"') == heading)
        .unwrap();
    let case = bench.read("case.toml");
    for (row, change) in [(1, "column = 2"), (2, "column = 2\nscale = 2")] {
        bench.write("changed.toml", &case.replacen("column = 2", change, 1));
        let told = bench.json("run changed.toml --no-output");
        let alone = told["buildings"][0]["storeys"][0]["displacement"]["peak"]
            .as_f64()
            .unwrap();
        let found: f64 = rows[row][column].parse().unwrap();
        assert!((found / alone - 1.0).abs() < 1e-12, "{found} {alone}");
    }
    // A changed file is another study.
    let blast = bench.read("blast.csv");
    bench.write("blast.csv", &blast.replace("9000", "8000"));
    bench.refused("sweep study.toml -o study.h5 --resume", &["study.h5"]);
    bench.write("blast.csv", &blast);

    let output = bench.output("gap case.toml --points 0 --json");
    assert_eq!(output.status.code(), Some(1));
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let demand = told["gaps"][0]["demand"][0].as_f64().unwrap();
    assert!(demand > 0.05, "{demand}");
    let told = bench.json("compare case.toml --models=linear_elastic,jankowski_2005");
    assert_eq!(told["models"].as_array().unwrap().len(), 2);
}

/// Every row of a history is in equilibrium, also where a force jumps: its force and its acceleration are those
/// before the jump, at time zero those after it.
#[test]
fn rows_at_jumps_of_a_force_are_in_equilibrium() {
    for (points, at) in [
        (
            "[0.5, 0], [0.5, 500], [1.5, 500]",
            [0.0, 0.0, 500.0, 500.0, 0.0],
        ),
        (
            "[0, 500], [0.5, 500], [0.5, 200], [3, 200]",
            [500.0, 500.0, 200.0, 200.0, 200.0],
        ),
    ] {
        let bench = Bench::with(&format!(
            "[[building]]\nname = \"a\"\nstoreys = 1\nmass = 1000\nstiffness = 4e4\nheight = 3\ndamping = {{ modal = 0.9 }}\n[[building.force]]\nstorey = 1\npoints = [{points}]\n[ground_motion]\nfile = \"zero.csv\"\n[analysis]\nduration = 2\noutput_step = 0.1\n"
        ));
        bench.write("zero.csv", "time (s),acceleration (m/s2)\n0,0\n0.1,0\n");
        bench.text("run case.toml -o case.h5");
        let [force, u, v, a] = [
            "applied_force",
            "displacement",
            "velocity",
            "acceleration_absolute",
        ]
        .map(|name| history(&bench, &format!("building/a/{name}")));
        let c = 2.0 * 0.9 * f64::sqrt(4e4 * 1000.0);
        for row in 0..force.len() {
            let left = force[row] - c * v[row] - 4e4 * u[row] - 1000.0 * a[row];
            assert!(left.abs() < 0.05, "{points}, row {row}: {left} N");
        }
        assert_eq!([0, 5, 6, 15, 16].map(|row| force[row]), at);
    }
}

#[test]
fn forces_that_cannot_be_have_their_line() {
    let bench = example("blast_beside_a_tower", "\"15 s\"", "\"2 s\"");
    let case = bench.read("case.toml");
    bench.write("case.toml", &case.replacen("blast.csv", "gone.csv", 1));
    bench.refused(
        "run case.toml",
        &[
            "case.toml:14:",
            "cannot read the force history",
            "relative to the folder",
        ],
    );
    bench.write("case.toml", &case.replacen("storey = 1", "storey = 4", 1));
    bench.refused(
        "check case.toml",
        &["case.toml:13:", "no storey 4 in a building of 3 storeys"],
    );
    bench.write(
        "case.toml",
        &case.replacen("unit = \"kN\"", "unit = \"kN/m\"", 1),
    );
    bench.refused("check case.toml", &["case.toml:15:", "must be a force"]);
    let constant = "constant = \"-150 kN\"";
    for (kind, says) in [
        (
            "harmonic = { amplitude = 1e5, frequency = 2, duration = 3, step = 0.5 }",
            "do not draw a wave of 2 Hz",
        ),
        ("points = [[1, 1e5]]", "a force that lasts no time"),
        (
            "points = [[1, 1e5], [1, 2e5]]",
            "a force that lasts no time",
        ),
        (
            "file = \"blast.csv\"\ncolumn = 1",
            "column 1 holds the times",
        ),
    ] {
        bench.write("case.toml", &case.replacen(constant, kind, 1));
        bench.refused("check case.toml", &["case.toml:4", says]);
    }
}

/// A record that ends with a velocity, under one building 13 ms later: from its end on both grounds are as far apart as
/// they have ever been, `v 13 ms` but for what the record does in its last 13 ms, and the first instant counts.
#[test]
fn ground_that_stays_apart_is_at_its_peak_when_it_stops() {
    let building = |name: &str, stiffness: &str, more: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 1\nmass = \"100 t\"\nstiffness = \"{stiffness}\"\nheight = \"3 m\"\ndamping = {{ modal = 0.05 }}\n{more}\n"
        )
    };
    let case = |method: &str| {
        [
            building("a", "50 MN/m", "ground = { delay = \"13 ms\" }"),
            building("b", "90 MN/m", ""),
            "[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = \"50 mm\"\nmodel = \"linear_elastic\"\nstiffness = \"400 MN/m\"\n".to_owned(),
            format!("[ground_motion]\nfile = \"r.csv\"\nunit = \"m/s2\"\n[analysis]\nduration = \"3 s\"\n{method}\n"),
        ]
        .concat()
    };
    let rows = (0..=100).map(|k| {
        let t = 0.01 * f64::from(k);
        format!("{t:.2},{:?}\n", 3.0 * (9.0 * t).sin() + 0.7)
    });
    let rows: String = rows.collect();
    for method in ["", "method = \"adaptive\""] {
        let bench = Bench::with(&case(method));
        bench.write("r.csv", &format!("time_s,acceleration_m/s2\n{rows}"));
        let answer = bench.json("run case.toml --no-output");
        let peak = &answer["gaps"][0]["levels"][0]["responses"][0];
        assert_eq!(peak["name"], "relative_ground_displacement", "{answer}");
        let time = peak["time"].as_f64().unwrap_or_default();
        assert!((time - 1.013).abs() < 1e-9, "{method}: {peak}");
    }
}

#[test]
fn delays_are_said_and_stored() {
    let bench = example("three_frame_bridge", "\"25 s\"", "\"3 s\"");
    let lines = [
        "building middle: the ground moves 0.15 s later",
        "building east: the ground moves 0.3 s later",
    ];
    has(&bench.text("run case.toml -o case.h5"), &lines);
    let first = history(&bench, "ground/acceleration");
    let middle = history(&bench, "building/middle/ground_acceleration");
    assert!(middle[..15].iter().all(|a| *a == 0.0));
    for (a, b) in first.iter().zip(&middle[15..]) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
    let told = bench.json("run case.toml --no-output");
    assert_eq!(told["buildings"][2]["ground_delay"], 0.3);
    assert!(told["buildings"][0].get("ground_delay").is_none());
}

#[test]
fn records_of_buildings_and_across_the_row_are_said_and_have_their_line() {
    let bench = example(
        "pair_that_turns",
        "duration = \"20 s\"",
        "duration = \"1 s\"",
    );
    let shown = bench.text("check case.toml");
    has(
        &shown,
        &[
            "building low, across the row: ",
            "kobe_1995_jma_ns.csv",
            "building stiff, across the row: ",
        ],
    );
    bench.text("run case.toml -o case.h5");
    let across = history(&bench, "building/low/ground_acceleration_across");
    assert!(across.iter().any(|a| *a != 0.0));

    let case = bench.read("case.toml");
    let start = case.find("\nacross = ").unwrap() + 1;
    let end = start + case[start..].find('\n').unwrap();
    let line = case[..start].lines().count() + 1;
    for across in ["across = \"gone.csv\"", "across = { file = \"gone.csv\" }"] {
        bench.write("bad.toml", &[&case[..start], across, &case[end..]].concat());
        let output = bench.output("run bad.toml");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2));
        has(&said, &["gone.csv", &format!("bad.toml:{line}:")]);
        assert!(!said.contains("nothing to move"), "{said}");
        assert_eq!(said.matches("── here").count(), 1, "{said}");
    }
    let own = case.replacen(
        "name = \"stiff\"",
        "name = \"stiff\"\nground = { file = \"gone.csv\" }",
        1,
    );
    let line = own[..own.find("ground = ").unwrap()].lines().count() + 1;
    bench.write("bad.toml", &own);
    bench.refused("run bad.toml", &["gone.csv", &format!("bad.toml:{line}:")]);
}

/// Two components of one file, turned by 30 degrees: `a cos + b sin` along the row and `b cos - a sin` across it.
/// That of one of them alone is refused.
#[test]
fn both_components_of_a_file_turn() {
    let bench = example(
        "pair_that_turns",
        "duration = \"20 s\"",
        "duration = \"1 s\"",
    );
    // Without a mean, which would be taken off.
    let sample = |i: usize| [0.3, 0.5].map(|rate| (rate * (i as f64 - 50.0)).sin());
    let lines = (0..101).map(|i| {
        let [a, b] = sample(i);
        format!("{:.3},{a:.12},{b:.12}\n", 0.02 * i as f64)
    });
    let lines: String = lines.collect();
    bench.write("two.csv", &format!("time (s),NS (m/s2),EW (m/s2)\n{lines}"));
    let case = bench.read("case.toml");
    let start = case.find("[ground_motion]").unwrap();
    let end = start + case[start..].find("\n\n").unwrap();
    let along = "[ground_motion]\nfile = \"two.csv\"\ncomponent = \"NS\"\nsecond_component = \"EW\"\nrotate = 30\n";
    let with = |across: &str| [&case[..start], along, across, &case[end..]].concat();
    bench.write(
        "one.toml",
        &with("across = { file = \"two.csv\", component = \"EW\" }"),
    );
    bench.refused(
        "check one.toml",
        &["not at right angles", "one.toml:", "rotate = -30"],
    );
    bench.write(
        "both.toml",
        &with("across = { file = \"two.csv\", component = \"EW\", second_component = \"NS\", rotate = -30 }"),
    );
    bench.text("run both.toml -o case.h5");
    let along = history(&bench, "ground/acceleration");
    let across = history(&bench, "building/low/ground_acceleration_across");
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let times = history(&bench, "time");
    assert!(times.len() > 40, "{}", times.len());
    // Every second row is at a sample.
    for ((time, along), across) in times.iter().zip(along).zip(across).step_by(2) {
        let [a, b] = sample((time / 0.02).round() as usize);
        assert!((along - (a * cosine + b * sine)).abs() < 1e-9, "{time}");
        assert!((across - (b * cosine - a * sine)).abs() < 1e-9, "{time}");
    }
}

/// The record across the row belongs to the case's own record: beside others it is said.
#[test]
fn records_beside_that_across_the_row_are_said() {
    let bench = example("pair_that_turns", "\"20 s\"", "\"5 s\"");
    let said = "record kobe_1995_jma_ns along the row with the record across it of the case, ";
    let motions = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ground_motions");
    let other = format!(
        "--records {}",
        motions.join("kobe_1995_jma_ns.csv").display()
    );
    for command in [
        "gap case.toml --points 0",
        "compare case.toml --models linear_elastic",
    ] {
        let warned = |more: &str| {
            // A gap that is too small ends with exit code 1.
            let output = bench.output(&format!("{command} {more} --json"));
            let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
            let warnings = answer["warnings"].as_array().unwrap().iter();
            warnings
                .filter(|w| w.as_str().unwrap().starts_with(said))
                .count()
        };
        assert_eq!((warned(""), warned(&other)), (0, 1), "{command}");
    }
}

/// Rotations and edges of floors that turn, in sweeps, comparisons and limits.
#[test]
fn studies_take_floors_that_turn() {
    let bench = example("pair_that_turns", "\"20 s\"", "\"5 s\"");
    bench.write("study.toml", "case = \"case.toml\"\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"60 mm\"]\n");
    bench.text("sweep study.toml -o study.h5 --csv study.csv");
    let table = bench.read("study.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let run = bench.json("run case.toml --no-output");
    for (b, building) in ["low", "stiff"].into_iter().enumerate() {
        let responses = run["buildings"][b]["responses"].as_array().unwrap();
        let peak = |name: &str| {
            let found = responses.iter().find(|r| r["name"] == name).unwrap();
            found["peak"].as_f64().unwrap()
        };
        for storey in 1..=2 {
            let edges =
                ["lower", "upper"].map(|e| peak(&format!("displacement_of_{e}_edge_{storey}")));
            for (name, unit, expected) in [
                ("peak_rotation", "rad", peak(&format!("rotation_{storey}"))),
                ("peak_edge_displacement", "m", edges[0].max(edges[1])),
                (
                    "peak_displacement_across",
                    "m",
                    peak(&format!("displacement_across_{storey}")),
                ),
                (
                    "peak_acceleration_across",
                    "m s-2",
                    peak(&format!("acceleration_across_{storey}")),
                ),
            ] {
                let heading = format!("{name}: {building} {storey} [{unit}]");
                let column = rows[0].iter().position(|c| c.trim_matches('"') == heading);
                let column = column.unwrap_or_else(|| panic!("{heading}: {:?}", rows[0]));
                let found: f64 = rows[1][column].parse().unwrap();
                assert!(
                    (found / expected - 1.0).abs() < 1e-12,
                    "{heading}: {found} {expected}"
                );
            }
        }
    }
    bench.text("sweep study.toml -o study.h5 --resume");
    let told = bench.json("compare case.toml --models=linear_elastic,jankowski_2005");
    let quantities = told["quantities"].as_array().unwrap();
    let named = |name: &str| quantities.iter().filter(|q| q["name"] == name).count();
    assert_eq!((named("rotation"), named("edge_displacement")), (2, 2));

    let ida = |limit: &str| {
        bench.write("ida.toml", &format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.3 m/s^2\", \"3 m/s^2\"]\n[ida]\n[[ida.limit]]\nname = \"state\"\n{limit}\n"
        ));
    };
    for (limit, expected) in [
        (
            "demand = \"rotation\"\nbuilding = \"low\"\nstorey = 2\nexceeds = \"0.001 rad\"",
            [0, 1],
        ),
        (
            "demand = \"edge_displacement\"\nexceeds = \"30 mm\"",
            [0, 1],
        ),
        (
            "demand = \"acceleration_across\"\nexceeds = \"1 km/s^2\"",
            [0, 0],
        ),
    ] {
        ida(limit);
        let told = bench.json("ida ida.toml -o ida.h5");
        let states = told["limits"].as_array().unwrap();
        let state = states.iter().find(|s| s["name"] == "state").unwrap();
        let counts = state["counts"].as_array().unwrap().iter();
        let reached: Vec<u64> = counts.map(|c| c["reached"].as_u64().unwrap()).collect();
        assert_eq!(reached, expected, "{limit}");
    }
    ida("demand = \"rotation\"\nlevel = 1\nexceeds = 0.1");
    bench.refused("ida ida.toml -o ida.h5", &["of storeys, not of a level"]);
    ida("demand = \"rotation\"\nexceeds = \"2 m\"");
    bench.refused("ida ida.toml -o ida.h5", &["a pure number"]);
    let planar = example("three_storey_pair", "20 mm", "21 mm");
    planar.write("ida.toml", &bench.read("ida.toml").replace("2 m", "0.1"));
    planar.refused(
        "ida ida.toml -o ida.h5",
        &["known of buildings with a plan only"],
    );
}

/// Velocities that jump have impulses and no force: of none is it said that it stays below a
/// limit.
#[test]
fn rigid_impacts_have_no_force_in_an_incremental_analysis() {
    let bench = example("rigid_impacts", "\"31 s\"", "\"10 s\"");
    let study = |demand: &str| {
        format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.3 m/s^2\", \"3 m/s^2\"]\n[ida]\n[[ida.limit]]\nname = \"state\"\n{demand}\n"
        )
    };
    bench.write(
        "ida.toml",
        &study("demand = \"contact_force\"\nexceeds = \"1 kN\""),
    );
    let output = bench.output("ida ida.toml -o ida.h5");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    // Before any run, at its place.
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("ida.toml:10:10"), "{said}");
    assert!(said.contains("demand = \"impulse\""), "{said}");
    bench.write(
        "ida.toml",
        &study("demand = \"impulse\"\nexceeds = \"1 kN s\""),
    );
    let told = bench.json("ida ida.toml -o impulse.h5");
    let demands = told["levels"][0]["demands"].as_array().unwrap();
    let named = |name: &str| {
        demands
            .iter()
            .any(|d| d["name"].as_str().unwrap().starts_with(name))
    };
    assert!(named("impulse_max") && !named("peak_force"), "{demands:?}");
}

/// Columns without mass take elastic laws: models with damping are compared without it, which is
/// said.
#[test]
fn comparisons_say_where_columns_take_no_damping() {
    let bench = example("slab_hits_column", "\"20 s\"", "\"3 s\"");
    let case = bench.read("case.toml");
    let massless = case.replace("contact_mass = \"2.4 t\"\n", "").replace(
        "model = \"anagnostopoulos_2004\"\nstiffness = \"374 MN/m\"\nrestitution = 0.65\n",
        "model = \"linear_elastic\"\nstiffness = \"374 MN/m\"\n",
    );
    assert_ne!(massless, case);
    bench.write("case.toml", &massless);
    let told = bench.json("compare case.toml --models=linear_elastic,anagnostopoulos_2004");
    has(
        &told["warnings"].to_string(),
        &[
            "gap low-tall: the columns that are hit have no mass",
            "at restitution 1",
        ],
    );
}
