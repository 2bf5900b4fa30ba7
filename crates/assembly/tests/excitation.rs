//! The record of a case as the buildings feel it.
use std::path::Path;

use pounding_assembly::{Assembly, AssemblyError, assemble};
use pounding_case::Case;
use pounding_ground_motion::Accelerogram;
use pounding_ground_motion::measures::GroundMotion;
use pounding_ground_motion::spectra::{Evaluation, logarithmic_periods, response_spectrum};

const START: &str = r#"[[building]]
name = "a"
mass = ["25 t"]
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[ground_motion]
"#;
const TWO: &str = "file = \"two.txt\"\nlayout = \"t,ns,ew\"\nunit = \"m/s2\"\n";
const NORTH: &str = "component = \"ns\"\noffset = \"keep\"\n";

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let rows: String = (0..400)
        .map(|i| 0.02 * f64::from(i))
        .map(|t| (t, 0.05 + (3.0 * t).sin() * t * (8.0 - t) / 16.0))
        .map(|(t, a)| format!("{t:.2} {a} {}\n", -2.0 * a))
        .collect();
    write("two.txt", &rows);
    let head = "a\nb\nVELOCITY TIME SERIES IN UNITS OF CM/SEC\n";
    write(
        "record.vt2",
        &format!("{head}NPTS= 4, DT= 0.01 SEC\n 1 2 3 4\n"),
    );
    write("s.csv", "period_s,psa_g\n0.1,1\n3,1\n");
    folder
}

fn assembled(keys: &str) -> Result<Assembly, AssemblyError> {
    let folder = folder();
    let case = Case::parse(&format!("{START}{keys}"), &folder.path().join("case.toml"))?;
    assemble(&case)
}

fn record(keys: &str) -> Accelerogram {
    assembled(&format!("{TWO}{keys}")).unwrap().accelerogram
}

#[test]
fn components_offset_and_gravity() {
    let north = record(NORTH);
    let east = record("component = \"ew\"\noffset = \"keep\"");
    for (n, e) in north.samples().iter().zip(east.samples()) {
        assert!((e + 2.0 * n).abs() < 1e-14);
    }
    let centred = record("component = \"ns\"\noffset = \"remove\"");
    let mean: f64 = centred.samples().iter().sum::<f64>() / 400.0;
    assert!(mean.abs() < 1e-15, "{mean}");
    let keys = TWO.replace("m/s2", "g");
    let light = assembled(&format!("{keys}{NORTH}gravity = 9.8")).unwrap();
    for (a, b) in light.accelerogram.samples().iter().zip(north.samples()) {
        assert!((a - 9.8 * b).abs() < 1e-13);
    }
}

/// `a1 cos + a2 sin`, here with a2 = -2 a1.
#[test]
fn two_components_are_turned() {
    let north = record(NORTH);
    let turned = record(&format!("{NORTH}second_component = \"ew\"\nrotate = 30"));
    let factor = 30.0_f64.to_radians().cos() - 2.0 * 30.0_f64.to_radians().sin();
    for (t, n) in turned.samples().iter().zip(north.samples()) {
        assert!((t - factor * n).abs() < 1e-14);
    }
    assert_eq!(turned.steps()[0].step, "rotation");
    assert_eq!(turned.steps()[0].get("angle"), Some(30.0));
    let error = refused("second_component = \"ew\"\nrotate = 400");
    assert_eq!((error.line, error.column), (13, 10), "{error}");
    // A component with itself is not at right angles.
    let error = refused("second_component = \"ns\"\nrotate = 30");
    assert_eq!((error.line, error.column), (12, 20), "{error}");
    assert!(error.to_string().contains("azimuth 0 degrees"), "{error}");
}

/// Steps in the order of the list, then the scale; each is told.
#[test]
fn process_then_scale() {
    let plain = record(NORTH);
    let steps = "{ scale = 2 }, { remove_offset = { value = 0.1 } }, { pad = { after = \"2 s\" } }";
    let done = record(&format!("{NORTH}process = [{steps}]\nscale = 3"));
    assert_eq!(done.samples().len(), plain.samples().len() + 100);
    for (a, b) in done.samples().iter().zip(plain.samples()) {
        assert!((a - 3.0 * (2.0 * b - 0.1)).abs() < 1e-13);
    }
    assert!(done.samples()[400..].iter().all(|a| *a == 0.0));
    let steps: Vec<_> = done.steps().iter().map(|s| &*s.step).collect();
    assert_eq!(steps, ["scale", "offset", "pad"]);
    let echo = done.echo().join("\n");
    assert!(echo.contains("offset: offset 0.1 m/s2"), "{echo}");
}

/// The scaled record has what was asked for.
#[test]
fn scales_reach_their_targets() {
    let linear = Evaluation::PiecewiseLinear;
    let of = |scale: &str| record(&format!("component = \"ns\"\nscale = {scale}"));
    let psa = of("{ psa = \"0.5 g\", period = \"0.7 s\", damping = 0.02 }");
    let found = response_spectrum(&psa, &[0.7], 0.02, linear).unwrap();
    assert!((found.pseudo_acceleration[0] / (0.5 * 9.80665) - 1.0).abs() < 1e-12);
    let ground = GroundMotion::of(&of("{ pgv = \"40 cm/s\" }"), 0.0, 0.0);
    assert!((ground.peak_velocity(linear).value / 0.4 - 1.0).abs() < 1e-12);
    // The geometric mean of PSA over the band is that of the target, 1 g.
    let band = of("{ target = \"s.csv\", from = \"0.2 s\", to = \"2 s\" }");
    let periods = logarithmic_periods(0.2, 2.0, 100).unwrap();
    let found = response_spectrum(&band, &periods, 0.05, linear).unwrap();
    let logarithms = found.pseudo_acceleration.iter().map(|a| (a / 9.80665).ln());
    assert!((logarithms.sum::<f64>() / 100.0).abs() < 1e-12);
}

fn refused(keys: &str) -> pounding_case::CaseError {
    match assembled(&format!("{TWO}component = \"ns\"\n{keys}")).unwrap_err() {
        AssemblyError::Case(error) => error,
        error => panic!("{error}"),
    }
}

/// Only an acceleration excites buildings, whoever says what the file holds.
#[test]
fn velocities_are_refused() {
    let error = assembled("file = \"record.vt2\"").unwrap_err();
    let text = error.to_string();
    assert!(
        text.contains("is a velocity, not an acceleration"),
        "{text}"
    );
    assert!(error.help().unwrap().contains("AT2"));
    for (word, part) in [
        ("velocity", "a velocity cannot excite"),
        ("jerk", "unknown quantity"),
    ] {
        let error = refused(&format!("quantity = \"{word}\""));
        assert_eq!((error.line, error.column), (12, 12), "{error}");
        assert!(error.message.contains(part), "{error}");
        assert!(error.help.is_some());
    }
}

/// A step that the record does not allow points at its place in the case file.
#[test]
fn refused_steps_point_at_themselves() {
    for (step, column, part) in [
        (
            "{ filter = { low_pass = \"25 Hz\" } }",
            12,
            "low-pass corner = 25",
        ),
        (
            "{ sign = \"reversed\" }, { trim = { end = \"9 s\" } }",
            35,
            "end = 9",
        ),
        ("{ true_unit = \"cm/s\" }", 12, "velocity"),
        (
            "{ scale = { target = \"none.csv\", from = 1, to = 2 } }",
            33,
            "none.csv",
        ),
        (
            "{ resample = { time_step = \"0.05 s\" } }",
            12,
            "longer than the record's",
        ),
    ] {
        let error = refused(&format!("process = [{step}]"));
        assert_eq!((error.line, error.column), (12, column), "{error}");
        assert!(error.message.contains(part), "{error}");
        assert!(error.help.is_some());
    }
    let path = Path::new("nowhere/case.toml");
    let case = Case::parse(&format!("{START}file = \"record.at2\""), path).unwrap();
    let text = assemble(&case).unwrap_err().to_string();
    assert!(text.contains("cannot read"), "{text}");
}

/// A scale that cannot be reached points at what asks for it, not at the record.
#[test]
fn refused_scales_point_at_themselves() {
    for (scale, column, part) in [
        (
            "{ target = \"none.csv\", from = 1, to = 2 }",
            20,
            "none.csv",
        ),
        (
            "{ target = \"two.txt\", from = 1, to = 2 }",
            20,
            "two columns",
        ),
        (
            "{ target = \"s.csv\", from = 1, to = 4 }",
            9,
            "last period of the band = 4",
        ),
        ("{ psa = 1, period = 1e-9 }", 9, "period = 1e-9"),
    ] {
        let error = refused(&format!("scale = {scale}"));
        assert_eq!((error.line, error.column), (12, column), "{error}");
        assert!(error.message.contains(part), "{error}");
        assert!(error.help.is_some());
    }
}
