//! Links and rows of several buildings in `gap` and `compare`: they are the structure that
//! `run` integrates, no other.
use std::path::Path;
use std::process::Command;

use serde_json::Value;

fn building(name: &str, mass: &str, stiffness: &str) -> String {
    format!(
        "[[building]]\nname = \"{name}\"\nstoreys = 1\nmass = \"{mass}\"\nstiffness = \"{stiffness}\"\nheight = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\n"
    )
}

fn gap(between: [&str; 2], width: &str) -> String {
    let [a, b] = between;
    format!(
        "[[gap]]\nbetween = [\"{a}\", \"{b}\"]\nwidth = \"{width}\"\nmodel = \"exact_hunt_crossley\"\nstiffness = \"2.75e9 N/m^1.5\"\nrestitution = 0.65\n"
    )
}

/// Runs a command on a case under El Centro for 30 s; exit code and JSON.
fn answer(case: &str, command: &str, more: &[&str]) -> (Option<i32>, Value) {
    let folder = tempfile::tempdir().unwrap();
    let record = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../ground_motions/el_centro_1940_ns.csv")
        .canonicalize()
        .unwrap();
    let rest = format!("[ground_motion]\nfile = {record:?}\n[analysis]\nduration = \"30 s\"\n");
    std::fs::write(folder.path().join("case.toml"), format!("{case}{rest}")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .current_dir(folder.path())
        .args([command, "case.toml", "--json"])
        .args(more)
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    let json = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{complaint}"));
    (output.status.code(), json)
}

/// Whether a number stands anywhere in an answer.
fn holds(value: &Value, number: f64) -> bool {
    match value {
        Value::Number(x) => x
            .as_f64()
            .is_some_and(|x| (x / number - 1.0).abs() < 1.0e-6),
        Value::Array(items) => items.iter().any(|v| holds(v, number)),
        Value::Object(items) => items.values().any(|v| holds(v, number)),
        _ => false,
    }
}

fn impacts(run: &Value, gap: usize) -> u64 {
    let levels = run["gaps"][gap]["levels"].as_array().unwrap();
    levels.iter().map(|l| l["impacts"].as_u64().unwrap()).sum()
}

const LINK: &str =
    "[[link]]\nbetween = [\"b\", \"c\"]\nmodel = \"linear\"\nstiffness = \"4 MN/m\"\n";

/// Two identical frames of which one is tied to a stiff third: alone they would need no
/// gap, tied they do.
fn tied(width: &str) -> String {
    [
        building("a", "100 t", "4 MN/m"),
        building("b", "100 t", "4 MN/m"),
        building("c", "400 t", "200 MN/m"),
        gap(["a", "b"], width),
        LINK.to_owned(),
    ]
    .concat()
}

#[test]
fn a_link_counts_in_the_demand() {
    let (code, check) = answer(&tied("20 mm"), "gap", &["--points", "0"]);
    assert_eq!(code, Some(1));
    let demand = check["gaps"][0]["demand"][0].as_f64().unwrap();
    assert!(demand > 0.02, "{demand}");
    // What the check says, runs confirm on both sides.
    for (width, touched) in [
        (demand * (1.0 + 1.0e-6), false),
        (demand * (1.0 - 1.0e-6), true),
    ] {
        let (_, run) = answer(&tied(&format!("{width:.12} m")), "run", &["--no-output"]);
        assert_eq!(impacts(&run, 0) > 0, touched, "{width}");
    }
}

/// Amplification compares with the linked buildings that do not touch: one where nothing
/// touches.
#[test]
fn a_link_is_no_pounding() {
    let (code, check) = answer(&tied("500 mm"), "gap", &["--points", "0"]);
    assert_eq!(code, Some(0));
    for building in check["records"][0]["amplification"].as_array().unwrap() {
        for storey in building.as_array().unwrap() {
            assert_eq!(storey["displacement"], 1.0, "{check}");
        }
    }
}

/// The models of a comparison act between the linked buildings.
#[test]
fn a_link_stays_in_the_comparison() {
    let models = ["--models", "exact_hunt_crossley"];
    let (_, compared) = answer(&tied("20 mm"), "compare", &models);
    let (_, run) = answer(&tied("20 mm"), "run", &["--no-output"]);
    let peak = run["buildings"][0]["storeys"][0]["displacement"]["peak"]
        .as_f64()
        .unwrap();
    assert!(holds(&compared, peak), "{peak} is not in {compared}");
}

/// Identical neighbours that a third one drives into each other: their gap alone demands
/// nothing, and still closes.
#[test]
fn a_gap_that_a_neighbour_closes_is_too_small() {
    let row = [
        building("a", "100 t", "16 MN/m"),
        building("b", "100 t", "16 MN/m"),
        building("c", "800 t", "25 MN/m"),
        gap(["a", "b"], "5 mm"),
        gap(["b", "c"], "20 mm"),
    ]
    .concat();
    let (_, run) = answer(&row, "run", &["--no-output"]);
    assert!(impacts(&run, 0) > 0);
    let (code, check) = answer(&row, "gap", &["--points", "0"]);
    assert_eq!(code, Some(1));
    let first = &check["gaps"][0];
    assert!(first["demand"][0].as_f64().unwrap() < 1.0e-9, "{first}");
    assert_eq!(first["adequate"], false);
    assert_eq!(first["records_driven_by_neighbours"], 1);
}

/// The same row in a comparison: the models close a level that the demand leaves open, and
/// the comparison says so.
#[test]
fn a_level_that_a_neighbour_closes_is_reported() {
    let row = [
        building("a", "100 t", "16 MN/m"),
        building("b", "100 t", "16 MN/m"),
        building("c", "800 t", "25 MN/m"),
        gap(["a", "b"], "5 mm"),
        gap(["b", "c"], "20 mm"),
    ]
    .concat();
    let (_, compared) = answer(&row, "compare", &["--models", "exact_hunt_crossley"]);
    let levels = &compared["differences_from_gap"]["levels"];
    assert_eq!(levels.as_array().unwrap().len(), 1, "{levels}");
    let level = &levels[0];
    assert_eq!(level["gap"], "a-b");
    assert_eq!(level["demand_closes"][0], false);
    assert_eq!(level["models_in_contact"][0][0], "exact_hunt_crossley");
    assert!(level["own_law_impacts"][0].as_u64().unwrap() > 0);
}

/// A record that is named twice counts once at most.
#[test]
fn a_record_given_twice_is_refused() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let record = root.join("ground_motions/el_centro_1940_ns.csv");
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("gap")
        .arg(root.join("examples/three_storey_pair/case.toml"))
        .args(["--points", "0", "--records"])
        .args([&record, &record])
        .output()
        .unwrap();
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{complaint}");
    assert!(complaint.contains("given twice"), "{complaint}");
}

/// What each contact and link got, with units: given values apart from defaults.
#[test]
fn check_tells_the_parameters_of_gaps_and_links() {
    let links = [
        "name = \"bar\"\nmodel = \"gap_hook\"\ntension_gap = \"20 mm\"\ntension_stiffness = \"24 MN/m\"\n",
        "name = \"damper\"\nmodel = \"viscous_damper\"\ndamping = \"120 kN s^0.4/m^0.4\"\nexponent = 0.4\n",
    ];
    let links = links.map(|law| format!("[[link]]\nbetween = [\"b\", \"c\"]\n{law}"));
    let case = format!("{}{}", tied("20 mm"), links.concat());
    let (code, told) = answer(&case, "check", &[]);
    assert_eq!(code, Some(0));
    let parameter = |place: &Value, name: &str| {
        let all = place.as_array().unwrap();
        let found = all.iter().find(|p| p["name"] == name);
        let found = found.unwrap_or_else(|| panic!("{name}: {place}"));
        let value = found["value"].as_f64().unwrap();
        let unit = found["unit"].as_str().unwrap().to_owned();
        (value, unit, found["is_given"].as_bool().unwrap())
    };
    let contact = &told["gaps"][0]["levels"][0]["parameters"];
    let expected = (2.75e9, "N/m^1.5".to_owned(), true);
    assert_eq!(parameter(contact, "stiffness"), expected);
    assert_eq!(
        parameter(contact, "restitution"),
        (0.65, String::new(), true)
    );
    let [bar, damper] = [1, 2].map(|link| &told["links"][link]["parameters"][0]);
    assert_eq!(parameter(bar, "tension_gap"), (0.02, "m".to_owned(), true));
    let compression = parameter(bar, "compression_stiffness");
    assert_eq!(compression, (0.0, "N/m".to_owned(), false));
    let damping = (1.2e5, "N s^0.4/m^0.4".to_owned(), true);
    assert_eq!(parameter(damper, "damping"), damping);
    // Values with their units are what a case takes.
    let echoed = case.replace("\"120 kN s^0.4/m^0.4\"", "\"1.2e5 N s^0.4/m^0.4\"");
    assert_eq!(answer(&echoed, "check", &[]).1["links"], told["links"]);
}
