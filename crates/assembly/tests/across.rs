//! The record across the row against that along it.
use pounding_assembly::{AssemblyError, assemble};
use pounding_case::Case;

const BUILDING: &str = "[[building]]\nname = \"a\"\nmass = [1e5]\nheight = 3\ndamping = { modal = 0.05 }\nplan = { length = 12, width = 10, frames_along = [{ at = -5, stiffness = 3e7 }, { at = 5, stiffness = 1e7 }], frames_across = [{ at = 0, stiffness = 2e7 }] }\n[ground_motion]\n";

/// Components of one record, a copy of it, and its vertical one in a file of its own.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let value = |i: u32, rate: f64| (rate * (f64::from(i) - 50.0)).sin();
    let rows: String = (0..101)
        .map(|i| {
            let [a, b, c] = [0.3, 0.5, 0.7].map(|rate| value(i, rate));
            format!("{:.2},{a:.6},{b:.6},{c:.6}\n", 0.02 * f64::from(i))
        })
        .collect();
    let all = format!("time (s),NS (m/s2),EW (m/s2),UP (m/s2)\n{rows}");
    write("two.csv", &all);
    write("copy.csv", &all);
    let own = |name: &str, more: &str, rate: f64| {
        let rows: String = (0..101)
            .map(|i| format!("{},{:.6}\n", 0.02 * f64::from(i), value(i, rate)))
            .collect();
        format!("# Component: {name}\n{more}time_s,acceleration_m_s2\n{rows}")
    };
    write("up.csv", &own("UP", "", 0.7));
    let long = own("NS", "# Start: 2011/03/11 14:46:30 JST\n", 0.5);
    let later: String = (101..300)
        .map(|i| format!("{},0.0\n", 0.02 * f64::from(i)))
        .collect();
    write("early_long.csv", &format!("{long}{later}"));
    for (name, seconds) in [("early.csv", "30"), ("late.csv", "33")] {
        let start = format!("# Start: 2011/03/11 14:46:{seconds} JST\n");
        write(
            name,
            &own(if name == "early.csv" { "NS" } else { "EW" }, &start, 0.5),
        );
    }
    for (name, start) in [
        ("instant.csv", "2011/03/11 05:46:30 UTC"),
        ("odd.csv", "in the afternoon"),
    ] {
        write(name, &own("EW", &format!("# Start: {start}\n"), 0.5));
    }
    folder
}

fn assembled(motion: &str) -> Result<Vec<String>, (String, String)> {
    let folder = folder();
    let text = format!("{BUILDING}{motion}\n");
    let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
    match assemble(&case) {
        Ok(made) => Ok(made.warnings()),
        Err(AssemblyError::Case(e)) => Err((e.message.clone(), e.help.clone().unwrap_or_default())),
        Err(e) => panic!("{e}"),
    }
}

const NORTH: &str = "file = \"two.csv\"\ncomponent = \"NS\"\n";

#[test]
fn a_record_that_is_no_other_component_is_refused() {
    // The one record that there is may stand for both directions.
    for across in [
        "{ file = \"two.csv\", component = \"NS\" }",
        "{ file = \"copy.csv\", component = \"NS\", scale = 2 }",
    ] {
        let told = assembled(&format!("{NORTH}across = {across}")).unwrap();
        assert!(
            told.len() == 1 && told[0].contains("one series of one file"),
            "{told:?}"
        );
    }
    for (motion, message) in [
        (
            format!("{NORTH}across = {{ file = \"two.csv\", component = \"UP\" }}"),
            "\"UP\" (vertical)",
        ),
        (format!("{NORTH}across = \"up.csv\""), "\"UP\" (vertical)"),
        (
            "file = \"up.csv\"\nacross = { file = \"two.csv\", component = \"EW\" }".to_owned(),
            "\"UP\" (vertical)",
        ),
    ] {
        let (said, help) = assembled(&motion).unwrap_err();
        assert!(said.contains(message), "{motion}: {said}");
        assert!(help.contains("horizontal component"), "{help}");
    }
    for across in [
        "{ file = \"two.csv\", component = \"EW\" }",
        "{ file = \"copy.csv\", component = \"EW\" }",
    ] {
        let motion = format!("{NORTH}across = {across}");
        assert_eq!(assembled(&motion), Ok(Vec::new()), "{motion}");
    }
}

/// `a cos w + b sin w` along the row is at right angles to `b cos w - a sin w`.
#[test]
fn both_turns_go_together() {
    let turned = |first: &str, second: &str, angle: f64| {
        format!("component = \"{first}\", second_component = \"{second}\", rotate = {angle}")
    };
    let with = |along: f64, file: &str, across: &str| {
        format!(
            "{NORTH}second_component = \"EW\"\nrotate = {along}\nacross = {{ file = \"{file}\", {across} }}"
        )
    };
    for file in ["two.csv", "copy.csv"] {
        for (angle, across) in [
            (30.0, turned("EW", "NS", -30.0)),
            (30.0, turned("EW", "NS", 150.0)),
            (30.0, turned("NS", "EW", 120.0)),
            (90.0, "component = \"NS\"".to_owned()),
        ] {
            let motion = with(angle, file, &across);
            assert_eq!(assembled(&motion), Ok(Vec::new()), "{motion}");
        }
        for (angle, across) in [
            (30.0, turned("EW", "NS", 30.0)),
            (30.0, turned("NS", "EW", 30.0)),
            (30.0, turned("EW", "NS", -40.0)),
            (30.0, "component = \"EW\"".to_owned()),
            (90.0, "component = \"EW\"".to_owned()),
        ] {
            let (said, help) = assembled(&with(angle, file, &across)).unwrap_err();
            assert!(said.contains("not at right angles"), "{across}: {said}");
            assert!(help.contains(&format!("rotate = -{angle}")), "{help}");
        }
        let across = turned("EW", "NS", 30.0);
        let motion = format!("{NORTH}across = {{ file = \"{file}\", {across} }}");
        let (said, help) = assembled(&motion).unwrap_err();
        assert!(said.contains("that along it"), "{said}");
        assert!(
            help.contains("component = \"NS\", second_component = \"EW\", rotate = -30"),
            "{help}"
        );
    }
}

/// Two instruments that start 3 s apart, and what is cut off or put before one of them.
#[test]
fn records_that_start_apart_are_refused_or_said() {
    let (said, help) = assembled("file = \"early.csv\"\nacross = \"late.csv\"").unwrap_err();
    assert!(
        said.contains("do not start together") && said.contains("3 s apart"),
        "{said}"
    );
    assert!(help.contains("--trim"), "{help}");
    // One instant by two zones, and a start that cannot be compared.
    let early_across = |other: &str| format!("file = \"early.csv\"\nacross = \"{other}\"");
    assert_eq!(assembled(&early_across("instant.csv")), Ok(Vec::new()));
    let told = assembled(&early_across("odd.csv")).unwrap();
    assert!(
        told.len() == 1 && told[0].contains("in the afternoon"),
        "{told:?}"
    );
    // Cut to the time that they have in common.
    let cut =
        "file = \"early_long.csv\"\nprocess = [{ trim = { start = \"3 s\", end = \"5 s\" } }]\n";
    let motion = format!("{cut}across = \"late.csv\"");
    assert_eq!(assembled(&motion), Ok(Vec::new()));
    let own = |keys: &str, motion: &str| {
        let folder = folder();
        let building = BUILDING.replace(
            "[ground_motion]",
            &format!("ground = {{ {keys} }}\n[ground_motion]"),
        );
        let case = Case::parse(
            &format!("{building}{motion}\n"),
            &folder.path().join("case.toml"),
        );
        assemble(&case.unwrap()).unwrap().warnings()
    };
    let early = "file = \"early.csv\"";
    let told = own("file = \"late.csv\"", early);
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("3.000 s apart") && told[0].contains("that of a"),
        "{told:?}"
    );
    // A delay is the user's.
    assert_eq!(own("file = \"late.csv\", delay = 3", early), [""; 0]);
    assert_eq!(own("file = \"late.csv\"", cut), [""; 0]);
    // Zeros before one of two records, or a part cut off.
    for (process, words) in [
        (
            "pad = { before = \"2 s\" }",
            "by 0.00 s, and that of a by -2.00 s",
        ),
        (
            "trim = { start = \"1 s\", end = \"2 s\" }",
            "by 0.00 s, and that of a by 1.00 s",
        ),
    ] {
        let keys = format!("file = \"copy.csv\", component = \"EW\", process = [{{ {process} }}]");
        let told = own(&keys, NORTH);
        assert_eq!(told.len(), 1, "{told:?}");
        assert!(told[0].contains(words), "{words}: {told:?}");
        let same = format!("{NORTH}process = [{{ {process} }}]\n");
        assert_eq!(own(&keys, &same), [""; 0]);
    }
}
