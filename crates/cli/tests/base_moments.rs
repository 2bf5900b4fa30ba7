//! Buildings with a stiffness matrix on the command line: what is understood of them, and
//! their overturning moments at the base wherever peaks are shown.
use serde_json::Value;

use crate::support::Bench;

const CASE: &str = r#"
[[building]]
name = "core"
storeys = 4
mass = "40 t"
height = "3 m"
cantilever = { flexural_rigidity = "6 GN m2" }
damping = { modal = 0.05 }

[[building]]
name = "chain"
storeys = 3
mass = "25 t"
stiffness = "34.6 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }

[[building]]
name = "frame"
storeys = 3
mass = ["60 t", "60 t", "50 t"]
height = "3 m"
stiffness_matrix = [
    [1.8e8, -1.0e8, 0.2e8],
    [-1.0e8, 1.4e8, -0.6e8],
    [0.2e8, -0.6e8, 0.5e8],
]
damping = { modal = 0.05 }
p_delta = true

[[gap]]
between = ["core", "chain"]
width = "8 mm"
model = "anagnostopoulos_2004"
stiffness = "200 MN/m"
restitution = 0.65

[[gap]]
between = ["chain", "frame"]
width = "8 mm"
model = "anagnostopoulos_2004"
stiffness = "200 MN/m"
restitution = 0.65

[ground_motion]
file = "MOTIONS/el_centro_1940_ns.csv"

[analysis]
duration = "6 s"
"#;

#[test]
fn check_shows_the_matrix_as_what_it_is() {
    let bench = Bench::with(CASE);
    let told = bench.json("check case.toml");
    let [core, chain, frame] = ["core", "chain", "frame"].map(|name| {
        let buildings = told["buildings"].as_array().unwrap().iter();
        buildings.clone().find(|b| b["name"] == name).unwrap()
    });
    let rows = serde_json::json!([
        [1.8e8, -1.0e8, 0.2e8],
        [-1.0e8, 1.4e8, -0.6e8],
        [0.2e8, -0.6e8, 0.5e8],
    ]);
    // Without what gravity takes off, which stands beside it.
    assert_eq!(frame["stiffness_matrix"], rows);
    assert!(frame["geometric_stiffness"][0].as_f64().unwrap() > 5.0e5);
    assert_eq!(frame["stiffness"], serde_json::json!([]));
    assert!(chain.get("stiffness_matrix").is_none());
    assert_eq!(
        chain["stiffness"],
        serde_json::json!([34.6e6, 34.6e6, 34.6e6])
    );
    // A force of 1 N at the roof bends a cantilever by h^3 / (3 E I).
    let matrix: Vec<Vec<f64>> = serde_json::from_value(core["stiffness_matrix"].clone()).unwrap();
    let bend = |z: f64| z * z * (36.0 - z) / (6.0 * 6.0e9);
    for (i, row) in matrix.iter().enumerate() {
        let force: f64 = row
            .iter()
            .zip([3.0, 6.0, 9.0, 12.0])
            .map(|(k, z)| k * bend(z))
            .sum();
        let expected = f64::from(u8::from(i == 3));
        assert!((force - expected).abs() < 1e-9, "floor {i}: {force}");
    }
    let shown = bench.text("check case.toml");
    let section = |name: &str| {
        let after = shown.split(&format!("\nBuilding {name}\n")).nth(1).unwrap();
        after.split("\n\n").next().unwrap()
    };
    for name in ["core", "frame"] {
        let shown = section(name);
        assert!(shown.contains("K_ii (N/m)") && shown.contains("\nstiffness matrix: every floor"));
    }
    for diagonal in ["1.800000e8", "1.400000e8", "5.000000e7"] {
        assert!(section("frame").contains(diagonal), "{shown}");
    }
    let chain = section("chain");
    assert!(chain.contains("stiffness (N/m)") && !chain.contains("matrix"));
    assert!(!section("core").contains("P-Delta"));
    // The first period without gravity says what gravity takes off.
    let period = |told: &Value| told["buildings"][2]["period"][0].as_f64().unwrap();
    let with = period(&told);
    bench.write("without.toml", &CASE.replace("p_delta = true\n", ""));
    let without = period(&bench.json("check without.toml"));
    let taken = 100.0 * (1.0 - (without / with).powi(2));
    assert!(taken > 0.1);
    let said = section("frame").split("gravity takes ").nth(1).unwrap();
    let (share, rest) = said
        .split_once(" % off the stiffness of the first mode")
        .unwrap();
    assert!(
        (share.parse::<f64>().unwrap() - taken).abs() < 0.011,
        "{share} {taken}"
    );
    assert!(rest.starts_with("; periods include it"));
}

/// Four figures of a number, as the page has them.
fn figures(x: f64) -> String {
    let decimals = (3 - x.abs().log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}

/// The same numbers in the object, the table, the file and the page.
#[test]
fn run_and_page_show_the_moment_of_the_file() {
    let bench = Bench::with(CASE);
    let told = bench.json("run case.toml -o case.h5");
    let shown = bench.text("run case.toml -o case.h5");
    bench.text("report case.h5");
    let page = bench.read("case.html");
    let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
    let mut seen = 0;
    for building in told["buildings"].as_array().unwrap() {
        let name = building["name"].as_str().unwrap();
        let peaks = file.group(&format!("building/{name}/peak")).unwrap();
        let table = shown.split(&format!("\nBuilding {name}:")).nth(1).unwrap();
        let table = table.split("\n\n").next().unwrap();
        let section = page
            .split(&format!("<h2>Building {name}</h2>"))
            .nth(1)
            .unwrap();
        let section = section.split("</section>").next().unwrap();
        if name == "chain" {
            assert!(building.get("base_moment").is_none());
            assert!(!peaks.link_exists("base_moment"));
            assert!(!table.contains("moment") && !section.contains("moment"));
            continue;
        }
        let stored = |name: &str| pounding_results::value::<f64>(&peaks, name).unwrap();
        let moment = stored("base_moment");
        let time = stored("base_moment_time");
        let isolated = stored("isolated_base_moment");
        assert_eq!(building["base_moment"]["peak"].as_f64(), Some(moment));
        assert_eq!(building["base_moment"]["time"].as_f64(), Some(time));
        assert_eq!(
            building["isolated_base_moment"]["peak"].as_f64(),
            Some(isolated)
        );
        let ratio = moment / isolated;
        assert!((ratio - 1.0).abs() > 0.02, "pounding changes it");
        let line = format!(
            "overturning moment at the base (kN m): {:.1} @{time:.2} x{ratio:.2}",
            1e-3 * moment
        );
        assert!(table.ends_with(&line), "{line}\n{table}");
        let cells = [1e-3 * moment, time, 1e-3 * isolated].map(figures);
        let cells = format!(
            "<td>{}</td><td>{}</td><td>{}</td><td>{ratio:.2}</td>",
            cells[0], cells[1], cells[2]
        );
        assert!(section.contains(&cells), "{cells}\n{section}");
        // Not below what was sampled of it.
        let history = file
            .dataset(&format!("building/{name}/base_moment"))
            .unwrap();
        let history = history.read_raw::<f64>().unwrap();
        let sampled = history.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(sampled > 0.98 * moment && sampled <= moment * (1.0 + 1e-12));
        seen += 1;
    }
    assert_eq!(seen, 2);
}

#[test]
fn sweep_and_merge_hold_a_column_for_each_building() {
    let bench = Bench::with(CASE);
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"8 mm\", \"1 m\"]\n[output]\nchunk = 1\n",
    );
    bench.text("sweep study.toml -o all.h5 --csv all.csv");
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml -o {shard}.h5 --shard {shard}/2"));
    }
    bench.text("merge 1.h5 2.h5 -o merged.h5");
    let bytes = |name: &str| std::fs::read(bench.folder().join(name)).unwrap();
    assert!(bytes("all.h5") == bytes("merged.h5"));
    let told = bench.json("run case.toml --no-output");
    let table = bench.read("all.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|c| *c == name).unwrap();
    for (b, name) in [(0, "core"), (2, "frame")] {
        let column = column(&format!("peak_base_moment: {name} [N m]"));
        let value = |row: usize| rows[row][column].parse::<f64>().unwrap();
        let peak = |key: &str| told["buildings"][b][key]["peak"].as_f64().unwrap();
        let found = value(1) / peak("base_moment");
        assert!((found - 1.0).abs() < 1e-9, "{name}: {found}");
        if name == "core" {
            // Far from its neighbour it is isolated.
            let found = value(2) / peak("isolated_base_moment");
            assert!((found - 1.0).abs() < 1e-9, "{name}: {found}");
        }
    }
    assert!(!table.contains("peak_base_moment: chain"));
    // The dimension has the names, and no variable can.
    let file = hdf5::File::open(bench.folder().join("all.h5")).unwrap();
    assert_eq!(file.dataset("peak_base_moment").unwrap().shape(), [2, 2]);
    let names = pounding_results::texts(&file, "building").unwrap();
    assert_eq!(names, ["core", "frame"]);
    bench.write(
        "taken.toml",
        "case = \"case.toml\"\n[[variable]]\nname = \"building\"\npath = \"gap.0.width\"\nvalues = [0.01]\n",
    );
    bench.refused(
        "sweep taken.toml",
        &["\"building\" cannot name a coordinate"],
    );
}

/// What stands in the files that a case names belongs to the study as its text does.
#[test]
fn a_changed_file_is_another_study() {
    let (start, rest) = CASE.split_once("stiffness_matrix = [").unwrap();
    let (_, end) = rest.split_once("\n]\n").unwrap();
    let by_matrix = format!("{start}stiffness_matrix = {{ file = \"K.csv\" }}\n{end}");
    let matrix = "1.8e8,-1.0e8,0.2e8\n-1.0e8,1.4e8,-0.6e8\n0.2e8,-0.6e8,0.5e8\n";
    let scale = "[ground_motion]\nscale = { target = \"S.csv\", from = 0.2, to = 1 }\n";
    let by_spectrum = CASE.replace("[ground_motion]\n", scale);
    assert_ne!(by_spectrum, CASE);
    let spectrum = "period_s,psa_g\n0.1,0.5\n0.5,0.7\n2,0.2\n";
    for (case, file, contents, changed) in [
        (by_matrix, "K.csv", matrix, ("1.8e8", "1.9e8")),
        (by_spectrum, "S.csv", spectrum, ("0.7", "0.9")),
    ] {
        let bench = Bench::with(CASE);
        bench.write("case.toml", &case);
        bench.write(file, contents);
        let study =
            "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"8 mm\"]\n";
        bench.write("study.toml", study);
        bench.text("sweep study.toml -o a.h5 --csv a.csv");
        bench.text("sweep study.toml -o a.h5 --resume --csv again.csv");
        assert_eq!(bench.read("again.csv"), bench.read("a.csv"));
        bench.write(file, &contents.replace(changed.0, changed.1));
        bench.refused(
            "sweep study.toml -o a.h5 --resume",
            &["it is the result of another study"],
        );
        bench.text("sweep study.toml -o b.h5 --csv b.csv");
        let id = |name: &str| {
            let table = bench.read(name);
            let rows: Vec<Vec<String>> = table
                .lines()
                .map(|l| l.split(',').map(str::to_owned).collect())
                .collect();
            let column = rows[0].iter().position(|c| c == "run_id").unwrap();
            rows[1][column].clone()
        };
        assert_ne!(id("a.csv"), id("b.csv"), "{file}");
    }
}

#[test]
fn fragilities_ask_for_the_moment() {
    let bench = Bench::with(CASE);
    let ida = |limit: &str| {
        let text = format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"1 m/s^2\", \"3 m/s^2\", \"5 m/s^2\"]\n[ida]\n[[ida.limit]]\nname = \"state\"\ndemand = \"base_moment\"\n{limit}\n"
        );
        bench.write("ida.toml", &text);
    };
    let reached = |limit: &str| -> Vec<u64> {
        ida(limit);
        let told = bench.json("ida ida.toml -o ida.h5");
        let states = told["limits"].as_array().unwrap();
        let state = states.iter().find(|s| s["name"] == "state").unwrap();
        let counts = state["counts"].as_array().unwrap().iter();
        counts.map(|c| c["reached"].as_u64().unwrap()).collect()
    };
    // Some 10 and 6.5 MN m under 3.1 m/s2.
    assert_eq!(
        reached("building = \"core\"\nexceeds = \"8 MN m\""),
        [0, 1, 1]
    );
    assert_eq!(
        reached("building = \"frame\"\nexceeds = \"8 MN m\""),
        [0, 0, 1]
    );
    assert_eq!(reached("exceeds = 8e6"), [0, 1, 1]);
    for (limit, word) in [
        (
            "building = \"chain\"\nexceeds = 8e6",
            "stiffness matrix only",
        ),
        (
            "building = \"core\"\nstorey = 2\nexceeds = 8e6",
            "of a building, not of a storey",
        ),
        ("level = 1\nexceeds = 8e6", "of a building, not of a storey"),
        ("exceeds = \"8 MN\"", "exceeds"),
    ] {
        ida(limit);
        bench.refused("ida ida.toml -o ida.h5", &[word]);
    }
}

/// Gap checks and comparisons take such buildings as any other; comparisons show the moment.
#[test]
fn gap_and_compare() {
    let bench = Bench::with(CASE);
    let output = bench.output("gap case.toml --points 0 --json");
    assert_eq!(output.status.code(), Some(1), "they touch");
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let amplification = &told["records"][0]["amplification"];
    assert_eq!(amplification[0].as_array().unwrap().len(), 4);
    assert!(amplification[0][0]["storey_shear"].as_f64().unwrap() > 1.0);

    let arguments = "compare case.toml --models=linear_elastic,jankowski_2005";
    let told = bench.json(arguments);
    let run = bench.json("run case.toml --no-output");
    let quantities = told["quantities"].as_array().unwrap();
    let moments: Vec<&Value> = quantities
        .iter()
        .filter(|q| q["name"] == "base_moment")
        .collect();
    let of: Vec<&str> = moments.iter().map(|q| q["of"].as_str().unwrap()).collect();
    assert_eq!(of, ["core", "frame"]);
    for q in moments {
        assert_eq!(
            (&q["unit"], &q["statistic"]),
            (&"N m".into(), &"at the base".into())
        );
    }
    let conclusions = told["conclusions"].as_array().unwrap();
    let statement = "pounding raises the peak overturning moment of core";
    assert!(
        conclusions.iter().any(|c| c["statement"] == statement),
        "{conclusions:?}"
    );
    let shown = bench.text(&format!("{arguments} --csv compared.csv"));
    assert!(shown.contains("core base moment (kN m)") && !shown.contains("chain base moment"));
    let isolated = run["buildings"][0]["isolated_base_moment"]["peak"].as_f64();
    let isolated = format!("{:.1}", 1e-3 * isolated.unwrap());
    assert!(shown.contains(&isolated), "{isolated}");
    // One line a model, and none of storeys.
    let table = bench.read("compared.csv");
    let lines = table
        .lines()
        .filter(|l| l.contains(",core,base_moment,N m,"));
    assert_eq!(lines.clone().count(), 2, "{table}");
    assert!(lines.clone().all(|l| l.contains("at the base")));
    assert!(!table.contains("chain,base_moment"));
}
