//! Storeys that lose all their strength.
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// A weak building of one storey far from its neighbour, with these lines more for it and for the analysis.
fn case(folder: &Path, of_building: &str, analysis: &str) {
    let record = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../ground_motions/el_centro_1940_ns.csv")
        .canonicalize()
        .unwrap();
    let text = format!(
        r#"
[[building]]
name = "left"
storeys = 1
mass = "60 t"
stiffness = "20 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}
{of_building}

[building.law]
model = "ibarra_medina_krawinkler_2005_peak_oriented"
yield_force = "150 kN"
hardening_ratio = 0.02
capping_deformation = "25 mm"
softening_ratio = 0.1
strength_capacity = 10
capping_capacity = 10
unloading_capacity = 20
reloading_capacity = 10

[[building]]
name = "right"
storeys = 1
mass = "60 t"
stiffness = "200 MN/m"
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}

[[gap]]
between = ["left", "right"]
width = "400 mm"
model = "exact_kelvin_voigt"
stiffness = "93.5 MN/m"
restitution = 0.65

[ground_motion]
file = '{}'

[analysis]
{analysis}
"#,
        record.display()
    );
    std::fs::write(folder.join("case.toml"), text).unwrap();
}

fn pounding(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn answer(output: &Output) -> Value {
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn warned(answer: &Value, part: &str) -> bool {
    let warnings = answer["warnings"].as_array().unwrap();
    let mut texts = warnings.iter().filter_map(Value::as_str);
    texts.any(|text| text.contains(part))
}

const MAY: &str = "left, storey 1: its law may lose all strength, and without P-Delta nothing";

/// All methods lose it at the same time, and the storey bears nothing from then on. Times by two independent methods;
/// the force by the history in the file.
#[test]
fn a_run_tells_when_a_storey_lost_all_its_strength() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let lost = |analysis: &str| {
        case(folder, "", analysis);
        let answer = answer(&pounding(
            folder,
            &["run", "case.toml", "--json", "-o", "r.h5"],
        ));
        let text = "left, storey 1: it has lost all its strength at t = 5.1";
        assert!(warned(&answer, text), "{:#}", answer["warnings"]);
        assert!(!warned(&answer, MAY));
        assert!(answer["buildings"][1]["yielding"][0].is_null());
        let time = &answer["buildings"][0]["yielding"][0]["strength_lost"];
        time.as_f64().unwrap()
    };
    let time = lost("");
    let file = hdf5::File::open(folder.join("r.h5")).unwrap();
    let group = file.group("building/left").unwrap();
    let stored = group.dataset("peak/strength_lost").unwrap();
    assert_eq!(stored.read_raw::<f64>().unwrap(), [time]);
    assert!(
        file.group("building/right/peak")
            .unwrap()
            .dataset("strength_lost")
            .is_err()
    );
    let times = file.dataset("time").unwrap().read_raw::<f64>().unwrap();
    let shear = group
        .dataset("storey_shear")
        .unwrap()
        .read_raw::<f64>()
        .unwrap();
    let after = |(t, force): (&f64, &f64)| if *t > time { force.abs() } else { 0.0 };
    let most = times.iter().zip(&shear).map(after).fold(0.0, f64::max);
    assert_eq!(most, 0.0);
    let before = |(t, _): &(&f64, &f64)| (time - 0.05..time).contains(*t);
    assert!(
        times
            .iter()
            .zip(&shear)
            .filter(before)
            .any(|(_, force)| force.abs() > 1.0)
    );
    drop(file);
    let adaptive = lost("method = \"adaptive\"\nrelative_tolerance = 1e-11");
    assert!((adaptive - time).abs() < 1e-6, "{adaptive} {time}");
    let newmark = lost("method = \"newmark\"\nstep = \"0.2 ms\"");
    assert!((newmark - time).abs() < 5e-3, "{newmark} {time}");
}

/// What an initial displacement leads beyond all strength never had any.
#[test]
fn strength_may_be_lost_before_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for method in ["", "method = \"newmark\"\nstep = \"2 ms\""] {
        case(folder, "initial_displacement = \"-300 mm\"", method);
        let answer = answer(&pounding(
            folder,
            &["run", "case.toml", "--json", "--no-output"],
        ));
        let lost = &answer["buildings"][0]["yielding"][0]["strength_lost"];
        assert_eq!(lost.as_f64(), Some(0.0), "{method}");
    }
}

/// Where nothing can tell afterwards, it is said before; with gravity the building falls, and is counted.
#[test]
fn studies_warn_of_strength_that_may_be_lost() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    case(folder, "", "");
    let study = "case = \"case.toml\"\n[[variable]]\nname = \"mass\"\npath = \"building.left.mass\"\nvalues = [\"60 t\", \"61 t\"]\n";
    std::fs::write(folder.join("study.toml"), study).unwrap();
    let text = |output: Output| {
        let [out, err] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
        out + &err
    };
    for arguments in [
        &["check", "case.toml"][..],
        &["gap", "case.toml"],
        &["sweep", "study.toml", "-o", "s.h5"],
    ] {
        let said = text(pounding(folder, arguments));
        assert!(said.contains(MAY), "{said}");
    }
    case(folder, "p_delta = true", "");
    let output = pounding(folder, &["gap", "case.toml"]);
    assert_eq!(output.status.code(), Some(3));
    let said = text(output);
    assert!(said.contains("left collapsed at t = 8.6"), "{said}");
    assert!(!said.contains("lose all strength"), "{said}");
}
