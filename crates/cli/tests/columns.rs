//! Floors that hit columns on the command line: every command that answers with them.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().unwrap()
}

/// A folder with the case of the example, and one whose columns have no mass.
struct Bench(TempDir);

impl Bench {
    fn new() -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        let case = root().join("examples/slab_hits_column/case.toml");
        let case = std::fs::read_to_string(case).unwrap();
        let case = case.replace("../../ground_motions", "MOTIONS");
        let case = case.replace("duration = \"20 s\"", "duration = \"4 s\"");
        bench.write("case.toml", &case);
        let massless = case.replace("contact_mass = \"2.4 t\"\n", "");
        let massless = massless.replace(
            "model = \"anagnostopoulos_2004\"\nstiffness = \"374 MN/m\"\nrestitution = 0.65\n",
            "model = \"linear_elastic\"\nstiffness = \"374 MN/m\"\n",
        );
        assert_ne!(massless, case);
        bench.write("massless.toml", &massless);
        bench
    }

    fn write(&self, name: &str, text: &str) {
        let motions = root().join("ground_motions");
        let text = text.replace("MOTIONS", motions.to_str().unwrap());
        std::fs::write(self.0.path().join(name), text).unwrap();
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.path().join(name)).unwrap()
    }

    fn output(&self, arguments: &str) -> Output {
        Command::new(env!("CARGO_BIN_EXE_pounding"))
            .env("NO_COLOR", "1")
            .env("COLUMNS", "200")
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .output()
            .unwrap()
    }

    fn ends(&self, arguments: &str, code: i32) -> String {
        let output = self.output(arguments);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments}: {errors}");
        String::from_utf8(output.stdout).unwrap()
    }

    fn text(&self, arguments: &str) -> String {
        self.ends(arguments, 0)
    }

    fn json(&self, arguments: &str, code: i32) -> Value {
        serde_json::from_str(&self.ends(&format!("{arguments} --json"), code)).unwrap()
    }

    fn refused(&self, arguments: &str, words: &[&str]) {
        let output = self.output(arguments);
        let errors = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
        let errors = errors.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(output.status.code(), Some(2), "{errors}");
        for word in words {
            assert!(errors.contains(word), "{errors}");
        }
    }
}

fn has(text: &str, lines: &[&str]) {
    for line in lines {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

const LEFT_OUT: &str = "gap low-tall: floor 1 of \"tall\" at 3 m meets columns of \"low\" between floors and hits nothing (the first of 2 such floors in this gap)";

/// What stands on the screen, in the object, in the file and on the page.
#[test]
fn run_and_page_set_the_demand_against_the_capacity() {
    let bench = Bench::new();
    let shown = bench.text("run case.toml -o case.h5");
    has(
        &shown,
        &[
            LEFT_OUT,
            "Level 2-3 (8 m | 8 m): column shear above 2315.7 kN at 2.46 s, exceeds the capacity of 1500.0 kN: demand over capacity 1.54\n",
            "Level 2-3 (8 m | 8 m): column shear below 872.1 kN at 2.46 s, stays below the capacity of 1500.0 kN: demand over capacity 0.58\n",
            "Level 2-3 (8 m | 8 m): column moment top 1378.7 kN m at 2.46 s\n",
            "Level 2-3 (8 m | 8 m): column bow 1.219 mm at 2.46 s\n",
        ],
    );
    let told = bench.json("run case.toml --no-output", 0);
    let level = &told["gaps"][0]["levels"][1];
    let above = &level["responses"][1];
    assert_eq!(above["name"], "column_shear_above");
    assert_eq!(above["capacity"], 1.5e6);
    let file = hdf5::File::open(bench.0.path().join("case.h5")).unwrap();
    let stored = |name: &str| {
        let data = file
            .dataset(&format!("gap/low-tall/response/{name}"))
            .unwrap();
        data.read_raw::<f64>().unwrap()
    };
    assert_eq!(
        stored("peak/column_shear_above")[1],
        above["peak"].as_f64().unwrap()
    );
    assert_eq!(stored("peak/column_shear_above_capacity"), [1.5e6, 1.5e6]);
    // Not below what was sampled of it: a column a level.
    let sampled = stored("column_shear_above");
    let most = |level: usize| {
        let own = sampled.iter().skip(level).step_by(2);
        own.fold(0.0_f64, |m, x| m.max(x.abs()))
    };
    for level in 0..2 {
        let peak = stored("peak/column_shear_above")[level];
        assert!(most(level) <= peak * (1.0 + 1e-12) && most(level) > 0.2 * peak);
    }
    bench.text("report case.h5");
    has(
        &bench.read("case.html"),
        &[
            "column shear above (kN)",
            "1.544 (exceeds it)",
            "the column shear above at",
            "times its capacity",
            "0.5814 (stays below it)",
        ],
    );
    let shown = bench.text("run massless.toml --no-output");
    has(&shown, &["column shear above", "exceeds the capacity"]);
}

#[test]
fn check_says_what_is_hit() {
    let bench = Bench::new();
    has(
        &bench.text("check case.toml"),
        &[
            LEFT_OUT,
            "level 1-2: the floor hits columns of tall in storey 2, from 3 m to 6 m, at a point with mass",
        ],
    );
    has(
        &bench.text("check massless.toml"),
        &[
            "level 2-3: the floor hits columns of tall in storey 3, from 6 m to 9 m, at a point without mass behind which the columns give 2592.0 MN/m",
        ],
    );
}

#[test]
fn a_gap_check_names_the_shear_of_the_columns() {
    let bench = Bench::new();
    let shown = bench.ends("gap case.toml --points 0", 1);
    has(
        &shown,
        &[
            LEFT_OUT,
            "Gap low-tall, level 2-3 (8 m | 8 m): columns that are hit bear a shear above of 2315.7 kN at 2.46 s under el_centro_1940_ns, exceeds the capacity of 1500.0 kN: demand over capacity 1.54\n",
        ],
    );
    let told = bench.json("gap case.toml --points 0", 1);
    let columns = told["gaps"][0]["columns"].as_array().unwrap();
    assert_eq!(columns.len(), 2);
    assert_eq!(columns[1]["level"], 2);
    let ratio = columns[1]["demand_over_capacity"].as_f64().unwrap();
    assert!((ratio - 2315.697 / 1500.0).abs() < 1e-5, "{ratio}");
    // Wide enough: what remains is the shear of the drift.
    bench.write(
        "wide.toml",
        &bench.read("case.toml").replace("\"20 mm\"", "\"120 mm\""),
    );
    let shown = bench.text("gap wide.toml --points 0");
    has(
        &shown,
        &[
            "columns that are hit bear a shear below of",
            "stays below the capacity",
            "WIDE ENOUGH",
        ],
    );
    let told = bench.json("gap massless.toml --points 3", 1);
    assert_eq!(told["gaps"][0]["columns"].as_array().unwrap().len(), 2);
}

#[test]
fn models_are_compared_before_columns() {
    let bench = Bench::new();
    let shown = bench.text("compare case.toml --models anagnostopoulos_2004,jankowski_2005");
    assert!(!shown.contains("failed"), "{shown}");
    let told = bench.json(
        "compare case.toml --models anagnostopoulos_2004,jankowski_2005",
        0,
    );
    has(&told.to_string(), &["\"column_shear\"", "low-tall"]);
    let models = "linear_elastic,hertz_1882,anagnostopoulos_2004";
    let told = bench.json(&format!("compare massless.toml --models {models}"), 0);
    let text = told.to_string();
    assert!(
        text.contains("anagnostopoulos_2004 cannot stand in series with a spring"),
        "{text}"
    );
    assert!(!text.contains("hertz_1882 cannot stand"));
}

#[test]
fn studies_hold_the_shear_of_columns() {
    let bench = Bench::new();
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"1 m\"]\n[output]\nchunk = 1\n",
    );
    bench.text("sweep study.toml -o all.h5 --csv all.csv");
    for shard in 1..=2 {
        bench.text(&format!("sweep study.toml -o {shard}.h5 --shard {shard}/2"));
    }
    bench.text("merge 1.h5 2.h5 -o merged.h5");
    let bytes = |name: &str| std::fs::read(bench.0.path().join(name)).unwrap();
    assert!(bytes("all.h5") == bytes("merged.h5"));
    let table = bench.read("all.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = rows[0]
        .iter()
        .position(|c| c.starts_with("peak_column_shear: low-tall 2-3"));
    let shear: f64 = rows[1][column.unwrap()].parse().unwrap();
    assert!((shear / 2_315_697.205_927 - 1.0).abs() < 1e-8, "{shear}");
    // Nothing is hit, and the drift alone shears the columns.
    let shear: f64 = rows[2][column.unwrap()].parse().unwrap();
    assert!(shear > 1e4 && shear < 1e6, "{shear}");
    let ida = "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nname = \"pga\"\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.3 g\"]\n[ida]\n[[ida.limit]]\nname = \"shear failure\"\ndemand = \"column_shear\"\nexceeds = \"1.5 MN\"\n";
    bench.write("ida.toml", ida);
    let told = bench.json("ida ida.toml -o ida.h5", 0).to_string();
    has(&told, &["shear failure", "peak_column_shear: low-tall"]);
    // Not where no columns are hit.
    let floors = bench.read("case.toml").replace(
        "levels = \"all_floors\"",
        "levels = [[1, 1], [2, 2]]\nfloor_to_floor = true",
    );
    let (start, rest) = floors.split_once("[gap.column]").unwrap();
    let (_, end) = rest.split_once("[ground_motion]").unwrap();
    bench.write("case.toml", &format!("{start}[ground_motion]{end}"));
    bench.refused(
        "ida ida.toml -o no.h5",
        &[
            "no gap of the case lets floors hit columns",
            "contact_force",
        ],
    );
}

#[test]
fn what_cannot_be_is_refused_at_its_place() {
    let bench = Bench::new();
    let case = bench.read("case.toml");
    bench.write("bad.toml", &case.replace("contact_mass = \"2.4 t\"\n", ""));
    bench.refused(
        "run bad.toml --no-output",
        &[
            "bad.toml:22:",
            "anagnostopoulos_2004 cannot stand in series",
            "`contact_mass`",
        ],
    );
    bench.write("bad.toml", &case.replace("\"256 MN m2\"", "\"900 MN m2\""));
    bench.refused(
        "check bad.toml",
        &[
            "stand in storey 2 of \"tall\"",
            "stand in storey 3 of \"tall\"",
        ],
    );
    // A contact without compliance meets the mass of the point.
    let rigid = case
        .replace("anagnostopoulos_2004", "stereomechanical")
        .replace("stiffness = \"374 MN/m\"\n", "");
    bench.write("rigid.toml", &rigid.replace("\"4 s\"", "\"2.6 s\""));
    has(
        &bench.text("run rigid.toml --no-output"),
        &["column shear above", "kN s"],
    );
    bench.write("bad.toml", &case.replace("\"2.4 t\"", "0"));
    bench.refused("check bad.toml", &["`contact_mass`", "greater than zero"]);
}

/// Without mass the penetration reaches to where the column would stand unhit: what deforms the
/// contact, and the bow of the column. With mass it is of the contact alone.
#[test]
fn penetrations_into_columns_without_mass_hold_their_bow() {
    let bench = Bench::new();
    let peaks = |case: &str| {
        let told = bench.json(&format!("run {case} --no-output"), 0);
        let level = told["gaps"][0]["levels"][1].clone();
        let bow = level["responses"].as_array().unwrap().iter();
        let bow = bow.clone().find(|r| r["name"] == "column_bow").unwrap();
        [
            &level["peak_penetration"]["peak"],
            &level["peak_force"]["peak"],
            &bow["peak"],
        ]
        .map(|number| number.as_f64().unwrap())
    };
    let stiffness = 374.0e6;
    let [penetration, force, bow] = peaks("massless.toml");
    assert!((penetration / (force / stiffness + bow) - 1.0).abs() < 1e-9);
    assert!(bow > 0.1 * penetration);
    // The law has a dashpot: its force is a little ahead of the penetration.
    let [penetration, force, _] = peaks("case.toml");
    assert!((penetration / (force / stiffness) - 1.0).abs() < 0.01);
}
