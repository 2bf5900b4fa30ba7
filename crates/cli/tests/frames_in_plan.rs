//! Frames with laws in buildings that turn in plan: what is understood, told, stored, shown and varied.
use serde_json::Value;

use crate::support::Bench;

/// The example, for eight seconds.
fn bench() -> Bench {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let case = format!("{root}/examples/yielding_pair_that_turns/case.toml");
    let text = std::fs::read_to_string(case).unwrap();
    let text = text.replace("../../ground_motions", "MOTIONS");
    Bench::with(&text.replace("\"20 s\"", "\"8 s\""))
}

fn numbers(file: &hdf5::File, name: &str) -> Vec<f64> {
    file.dataset(name).unwrap().read_raw().unwrap()
}

#[test]
fn check_names_each_with_its_parameters() {
    let bench = bench();
    let text = bench.text("check case.toml");
    for line in [
        "frame along at -5 m, storey 1: law bilinear, yields at a deformation of 12.000 mm: yield_force 360000 N, hardening_ratio 0.03",
        "frame across at -6 m, storey 2: law takeda, yields at a deformation of 10.000 mm: yield_force 180000 N",
        "takeda is from secondary sources",
    ] {
        assert!(text.contains(line), "{text}");
    }
    let json = bench.json("check case.toml");
    let frames = json["buildings"][0]["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 6);
    let places = frames.iter().map(|f| {
        (
            f["direction"].as_str().unwrap(),
            f["at"].as_f64().unwrap(),
            f["storey"].as_u64().unwrap(),
        )
    });
    let expected = [("along", -5.0), ("along", 4.0), ("across", -6.0)];
    let expected = [1, 2]
        .into_iter()
        .flat_map(|storey| expected.map(|(d, at)| (d, at, storey)));
    assert!(places.eq(expected), "{frames:?}");
    assert_eq!(frames[0]["yield_deformation"].as_f64(), Some(0.012));
    assert!(json["buildings"][1].get("frames").is_none());
}

/// Table, JSON, result file and page tell the same; forces of the frames along the row are the shear of their storey, and
/// what they dissipate together is what the storey does.
#[test]
fn a_run_tells_of_every_frame() {
    let bench = bench();
    let json = bench.json("run case.toml -o case.h5");
    let low = &json["buildings"][0];
    let frames = low["frames"].as_array().unwrap();
    assert_eq!(frames.len(), 6);
    let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
    let group = |name: &str| numbers(&file, &format!("building/low/{name}"));
    for (name, of) in [
        ("deformation", ["deformation", "peak"]),
        ("force", ["force", "peak"]),
        ("ductility", ["ductility", "peak"]),
    ] {
        let stored = group(&format!("frames/peak/{name}"));
        let told = frames.iter().map(|f| f[of[0]][of[1]].as_f64().unwrap());
        assert!(told.eq(stored.iter().copied()), "{name}");
    }
    let names = pounding_results::texts(&file, "building/low/frames/frame").unwrap();
    assert_eq!(names[2], "frame across at -6 m, storey 1");
    // Rows of six frames: the first three in storey 1, of which the first two stand along the row.
    let [force, energy] =
        ["force", "hysteretic_energy"].map(|name| group(&format!("frames/{name}")));
    let (shear, together) = (group("storey_shear"), group("hysteretic_energy"));
    let largest = shear.iter().fold(0.0_f64, |m, s| m.max(s.abs()));
    assert!(force.len() > 3 * 700 && force.len() == 3 * shear.len());
    for (row, of) in force.chunks(6).zip(shear.chunks(2)) {
        for storey in 0..2 {
            let sum = row[3 * storey] + row[3 * storey + 1];
            assert!(
                (sum - of[storey]).abs() < 1e-9 * largest,
                "{sum} {}",
                of[storey]
            );
        }
    }
    for (row, of) in energy.chunks(6).zip(together.chunks(2)) {
        for storey in 0..2 {
            let sum: f64 = row[3 * storey..3 * storey + 3].iter().sum();
            assert!((sum - of[storey]).abs() <= 1e-12 * sum.abs());
        }
    }
    for (storey, of) in low["yielding"].as_array().unwrap().iter().enumerate() {
        let own = &frames[3 * storey..3 * storey + 3];
        let ductilities = own.iter().map(|f| f["ductility"]["peak"].as_f64().unwrap());
        let greatest = ductilities.fold(0.0, f64::max);
        assert_eq!(of["ductility"]["peak"].as_f64(), Some(greatest));
        assert_eq!(group("peak/ductility")[storey], greatest);
        let peak = low["storeys"][storey]["storey_shear"]["peak"]
            .as_f64()
            .unwrap();
        let along = own.iter().filter(|f| f["direction"] == "along");
        let most: f64 = along.map(|f| f["force"]["peak"].as_f64().unwrap()).sum();
        assert!(
            peak <= most * (1.0 + 1e-12) && peak > 0.5 * most,
            "{peak} {most}"
        );
    }
    let text = bench.text("run case.toml --no-output");
    assert!(text.contains("along at -5 m"), "{text}");
    bench.text("report case.h5 -o case.html");
    let page = bench.read("case.html");
    for words in [
        "Frames that yield",
        "across at -6 m",
        "building/low/frames/peak/ductility",
    ] {
        assert!(page.contains(words), "{words}");
    }
}

#[test]
fn studies_vary_their_laws_and_ask_for_their_ductility() {
    let bench = bench();
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\nname = \"strength\"\npath = \"building.low.plan.frames_along.*.law.yield_force.*\"\nrelative = true\nvalues = [1, 100]\n",
    );
    bench.text("sweep study.toml -o study.h5 --csv study.csv");
    let json = bench.json("run case.toml --no-output");
    let table = bench.read("study.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|c| *c == name).unwrap();
    let value = |row: usize, name: &str| rows[row][column(name)].parse::<f64>().unwrap();
    let told =
        |storey: usize| json["buildings"][0]["yielding"][storey]["ductility"]["peak"].as_f64();
    for storey in 0..2 {
        let name = format!("peak_ductility: low {}", storey + 1);
        assert_eq!(Some(value(1, &name)), told(storey));
    }
    // Strong frames along the row leave the one across it to yield.
    let across = json["buildings"][0]["frames"][2]["ductility"]["peak"]
        .as_f64()
        .unwrap();
    let left = value(2, "peak_ductility: low 1");
    assert!(
        left > 1.0 && (left / across - 1.0).abs() < 0.5,
        "{left} {across}"
    );
    let ida = |limit: &str| {
        format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.05 g\", \"0.6 g\"]\n[ida]\n[[ida.limit]]\nname = \"yield\"\ndemand = \"ductility\"\n{limit}\nexceeds = 2\n"
        )
    };
    bench.write("ida.toml", &ida("building = \"low\"\nstorey = 2"));
    bench.text("ida ida.toml -o ida.h5");
    bench.write("stiff.toml", &ida("building = \"stiff\""));
    bench.refused("ida stiff.toml -o stiff.h5", &["these stay linear"]);
}

#[test]
fn wrong_laws_stand_where_they_are() {
    let bench = bench();
    let sound = bench.read("case.toml");
    let wrong = |from: &str, to: &str, words: &[&str]| {
        assert!(sound.contains(from));
        bench.write("wrong.toml", &sound.replacen(from, to, 1));
        bench.refused("check wrong.toml", words);
    };
    wrong(
        "height = \"3.5 m\"\n",
        "height = \"3.5 m\"\nlaw = { model = \"bilinear\", yield_force = 1e5, hardening_ratio = 0 }\n",
        &[
            "this building has `plan`",
            "give the frames of the plan their laws",
        ],
    );
    wrong(
        "{ model = \"bilinear\", yield",
        "{ model = \"bilinear\", stiffness = 1e7, yield",
        &[
            "starts with 10000000 N/m, but storey 1 of the frame along the row at -5 m of \"low\" has a stiffness of 30000000 N/m",
            "wrong.toml:18:17",
        ],
    );
    wrong(
        "model = \"takeda\"",
        "model = \"takedo\"",
        &["did you mean \"takeda\"?"],
    );
    wrong(
        "{ model = \"bilinear\", yield",
        "{ model = \"bilinear\", storeys = [3], yield",
        &["storey 3 is not one of 2"],
    );
    wrong(
        "model = \"takeda\", yield_force = [\"260 kN\", \"180 kN\"]",
        "model = \"viscous_damper\", damping = 1e6, exponent = 0.5",
        &["cannot carry a storey"],
    );
}

/// What a reader of JSON finds of a frame.
#[test]
fn keys_of_a_frame() {
    let json = bench().json("run case.toml --no-output");
    let frame = json["buildings"][0]["frames"][0].as_object().unwrap();
    let mut keys: Vec<&str> = frame.keys().map(String::as_str).collect();
    keys.sort_unstable();
    let expected = [
        "at",
        "deformation",
        "direction",
        "ductility",
        "force",
        "hysteretic_energy",
        "law",
        "residual_deformation",
        "storey",
        "strength_lost",
    ];
    assert_eq!(keys, expected);
    assert_eq!(frame["strength_lost"], Value::Null);
}

/// A frame that may lose all its strength where no gravity brings the building down is told of before a run, in studies
/// too, and each that did after it.
#[test]
fn strength_that_frames_lose() {
    let bench = bench();
    let law = "law = { model = \"ibarra_medina_krawinkler_2005_bilinear\", yield_force = [\"150 kN\", \"300 kN\"], hardening_ratio = 0.02, capping_deformation = \"20 mm\", softening_ratio = 0.2, strength_capacity = 10, capping_capacity = 10, unloading_capacity = 20 }";
    let text = bench.read("case.toml");
    let start = text.find("law = { model = \"bilinear\"").unwrap();
    let end = start + text[start..].find('\n').unwrap();
    let under_gravity = format!("{}{law}{}", &text[..start], &text[end..]);
    bench.write("case.toml", &under_gravity);
    let before = "low, storey 1: the law of a frame may lose all strength";
    let checked = bench.text("check case.toml");
    assert!(!checked.contains(before), "{checked}");
    let gravity = "p_delta = true";
    assert_eq!(under_gravity.matches(gravity).count(), 1);
    bench.write("case.toml", &under_gravity.replace(gravity, ""));
    let checked = bench.text("check case.toml");
    assert!(checked.contains(before), "{checked}");
    let told = bench.text("run case.toml --no-output");
    let after = "low, frame along at -5 m, storey 1: it has lost all its strength at t = ";
    assert!(told.contains(after) && !told.contains(before), "{told}");
    assert!(!told.contains("p_delta"), "{told}");
    let json = bench.json("run case.toml --no-output");
    let low = &json["buildings"][0];
    assert!(low["frames"][0]["strength_lost"].as_f64().unwrap() > 0.0);
    assert_eq!(low["frames"][1]["strength_lost"], Value::Null);
    assert_eq!(low["yielding"][0]["strength_lost"], Value::Null);
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"40 mm\"]\n",
    );
    let output = bench.output("sweep study.toml -o study.h5");
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    assert!(said.contains(before), "{said}");
}
