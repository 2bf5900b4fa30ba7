//! The table `[separation]`.
use std::path::Path;

use pounding_case::{Case, Separation};

const CASE: &str = r#"
[[building]]
name = "a"
storeys = 1
mass = 1
stiffness = 1
height = 3
damping = { modal = 0.05 }
[[building]]
name = "b"
storeys = 1
mass = 1
stiffness = 1
height = 3
damping = { modal = 0.05 }
[ground_motion]
file = "record.csv"
[separation]
response_modification = [8, 5]
importance = 1.25
structural_system = "frame"
same_owner = true
soil_zone = "II"
design_ground_acceleration = "0.25 g"
provisions = ["asce_7_10_between"]
"#;

#[test]
fn read_and_spread_over_buildings() {
    let s = Case::parse(CASE, Path::new("case.toml"))
        .unwrap()
        .separation;
    assert_eq!(s.response_modification, Some(vec![8.0, 5.0]));
    assert_eq!(s.importance, Some(vec![1.25, 1.25]));
    assert_eq!(s.structural_system.unwrap().len(), 2);
    assert_eq!(s.same_owner, Some(true));
    assert_eq!(s.floors_aligned, None);
    assert_eq!(s.soil_zone.unwrap().value, "II");
    assert!((s.design_ground_acceleration.unwrap() - 0.25 * 9.80665).abs() < 1.0e-12);
    assert_eq!(s.provisions.unwrap()[0].value, "asce_7_10_between");
}

/// Values that no code has: one warning a key, which names value, usual range and what was meant.
#[test]
fn unusual_values_are_warned_of() {
    let warnings = |text: &str| Separation::parse(text, 2).unwrap().warnings();
    for (text, parts) in [
        (
            "importance = 125",
            &["`importance`", "125", "0.5 to 2", "as a factor, 1.25"][..],
        ),
        (
            "importance = [1.0, 12.5]",
            &["12.5 for building 2", "decimal point it is 1.25"],
        ),
        (
            "response_modification = 0.125",
            &["`response_modification`", "1 to 12", "its inverse is 8"],
        ),
        ("displacement_amplification = 55", &["1 to 12", "it is 5.5"]),
        (
            "design_ground_acceleration = 0.25",
            &["0.25 m/s2", "0.05 g to 2 g", "was \"0.25 g\" meant?"],
        ),
        (
            "design_ground_acceleration = 250",
            &["was \"250 cm/s2\" meant?"],
        ),
        (
            "spectral_acceleration_1s = 0.35",
            &["was \"0.35 g\" meant?"],
        ),
        (
            "spectral_acceleration_1s = 0.9",
            &["0.1 g to 4 g", "was \"0.9 g\" meant?"],
        ),
        ("seismic_coefficient = 12", &["at most 1", "a factor, 0.12"]),
        (
            "isolation_damping_coefficient = 150",
            &["0.8 to 2", "a factor, 1.5"],
        ),
        (
            "isolation_period = 2800",
            &["at most 10 s", "was \"2800 ms\" meant?"],
        ),
        (
            "yield_amplification = [1, 1e6]",
            &["is 1000000 for building 2", "in codes 1 to 2"],
        ),
        ("yield_amplification = 0.8", &["its inverse is 1.25"]),
        (
            "plan_length = \"4e7 m\"",
            &["is 4.00000e7 m, and buildings have 1 m to 1000 m"],
        ),
        ("plan_length = 40000", &["was \"40000 mm\" meant?"]),
        ("plan_width = [\"1 mm\", 20]", &["0.001 m for building 1"]),
        (
            "plan_length = 40\nplan_width = 20\nplan_eccentricity = [2, 21]",
            &["21 m for building 2", "half of the plan of 40 m"],
        ),
    ] {
        let found = warnings(text);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        for part in parts {
            assert!(found[0].contains(part), "{text}: {part}: {}", found[0]);
        }
    }
    let ends = "importance = [0.5, 2]\nresponse_modification = [1, 12]\ndisplacement_amplification = [1, 12]\n\
        design_ground_acceleration = \"2 g\"\nspectral_acceleration_1s = \"0.1 g\"\nseismic_coefficient = 1\n\
        isolation_damping_coefficient = [0.8, 2]\nisolation_period = \"10 s\"\nplan_length = [40, 1000]\nplan_eccentricity = 20\n\
        yield_amplification = [1, 2]\nplan_width = [1, 1000]";
    assert_eq!(warnings(ends), [""; 0]);
}

/// The same of the parameters of spectra to which records are scaled: the case's and its steps'.
#[test]
fn unusual_spectra_are_warned_of() {
    let warnings = |keys: &str| {
        let scale = format!("[ground_motion]\nscale = {{ {keys} }}\n");
        let text = CASE.replace("[ground_motion]\n", &scale);
        assert_ne!(text, CASE);
        let case = Case::parse(&text, Path::new("case.toml")).unwrap();
        case.ground_motion.unusual_parameters()
    };
    let eurocode = |ag: &str| {
        warnings(&format!(
            "code = \"eurocode_8_2004\", ground_type = \"C\", ag = {ag}"
        ))
    };
    let asce = |s_ds: &str, s_d1: &str| {
        warnings(&format!(
            "code = \"asce_7_2016\", s_ds = {s_ds}, s_d1 = {s_d1}, t_l = \"8 s\""
        ))
    };
    assert_eq!(
        eurocode("0.25"),
        [
            "`ag` of the spectrum of eurocode_8_2004 is 0.25 m/s2 (0.0254929 g), and in codes 0.05 g to 2 g; if it has no unit, which is m/s2, was \"0.25 g\" meant?"
        ]
    );
    assert!(eurocode("250")[0].contains("was \"250 cm/s2\" meant?"));
    let both = asce("1", "0.6");
    assert!(both[0].contains("`s_ds`") && both[0].contains("was \"1 g\" meant?"));
    assert!(both[1].contains("`s_d1`") && both[1].contains("was \"0.6 g\" meant?"));
    assert_eq!(both.len(), 2);
    for usual in [
        eurocode("\"0.25 g\""),
        eurocode("2.5"),
        asce("\"1 g\"", "\"0.6 g\""),
        asce("9.8", "5.9"),
        warnings("pga = 0.25"),
    ] {
        assert_eq!(usual, [""; 0]);
    }
}

/// Peaks and ordinates to which records are scaled, without a unit: as small as none, and usual in g.
#[test]
fn bare_scales_are_asked_about() {
    let asked = |keys: &str| {
        let scale = format!("[ground_motion]\n{keys}\n");
        let text = CASE.replace("[ground_motion]\n", &scale);
        assert_ne!(text, CASE);
        Case::parse(&text, Path::new("case.toml")).unwrap().asked
    };
    for (keys, number) in [
        ("scale = { pga = 0.3 }", "0.3"),
        ("scale = { psa = 0.5, period = 0.6 }", "0.5"),
        ("scale.pga = 0.02", "0.02"),
        ("process = [{ scale = { pga = 0.9 } }]", "0.9"),
        (
            "across = { file = \"b.csv\", scale = { pga = 0.4 } }",
            "0.4",
        ),
    ] {
        let found = asked(keys);
        assert_eq!(found.len(), 1, "{keys}: {found:?}");
        let question = format!("was \"{number} g\" meant?");
        assert!(found[0].contains(&question), "{keys}: {found:?}");
        assert!(
            found[0].contains(&format!("write \"{number} m/s2\"")),
            "{found:?}"
        );
    }
    for usual in [
        "scale = { pga = \"0.3 m/s2\" }",
        "scale = { pga = \"0.03 g\" }",
        "scale = { pga = 3 }",
        "scale = { pga = 0.001 }",
        "scale = { pgv = 0.3 }",
        "scale = { psa = 0.5, period = 3 }",
        "scale = 0.3",
    ] {
        assert_eq!(asked(usual), [""; 0], "{usual}");
    }
}

#[test]
fn absent_table_gives_nothing() {
    let text = CASE.split("[separation]").next().unwrap();
    let case = Case::parse(text, Path::new("case.toml")).unwrap();
    assert_eq!(case.separation, Separation::default());
}

#[test]
fn arguments_override_the_table() {
    let case = Case::parse(CASE, Path::new("case.toml")).unwrap();
    let argument = Separation::parse("importance = 1.5", 2).unwrap();
    let both = case.separation.clone().overridden_by(argument);
    assert_eq!(both.importance, Some(vec![1.5, 1.5]));
    assert_eq!(both.response_modification, Some(vec![8.0, 5.0]));
}

#[test]
fn mistakes_are_placed() {
    for (from, to, line, says) in [
        ("importance", "importanse", 20, "did you mean `importance`?"),
        ("[8, 5]", "[8, 5, 3]", 19, "one value per building"),
        ("[8, 5]", "[8, -5]", 19, "write a value above zero"),
        ("\"frame\"", "[\"frame\"]", 21, "one value per building"),
        ("\"0.25 g\"", "\"0.25 m\"", 24, "correct the unit"),
        ("same_owner = true", "same_owner = 1", 22, "true or false"),
        ("same_owner = true", "ductility = 0.5", 22, "between 1"),
        ("same_owner = true", "ductility = [4, 2000]", 22, "and 1000"),
        (
            "same_owner = true",
            "fortification_intensity = 10",
            22,
            "from 6 to 9",
        ),
        (
            "[\"asce_7_10_between\"]",
            "[\"asce_7_10_between\", \"asce_7_10_between\"]",
            25,
            "names \"asce_7_10_between\" twice",
        ),
    ] {
        let error = Case::parse(&CASE.replace(from, to), Path::new("case.toml")).unwrap_err();
        assert_eq!(error.line, line, "{error}");
        let all = format!("{error} {}", error.help.clone().unwrap_or_default());
        assert!(all.contains(says), "{all}");
    }
    let error = Separation::parse("soil_zone = II", 2).unwrap_err();
    assert!(error.help.unwrap().contains("texts in quotes"));
}

/// Rules of the user, each with its file and the places of its texts; a country stands for its
/// code.
#[test]
fn rules_country_and_date() {
    let rule = "country = \"Italy\"\ndate = \"2020-01-01\"\n[[separation.rule]]\nname = \"mine\"\nkind = \"boundary\"\nexpression = \"max(least, u)\"\ninputs = { least = \"30 mm\" }\n[separation.rule.tables]\nt = { points = [[1, \"2 m\"], [2, \"3 m\"]], interpolation = \"steps\" }\n";
    let text = format!("{CASE}{rule}");
    let s = Case::parse(&text, Path::new("case.toml"))
        .unwrap()
        .separation;
    assert_eq!(s.country.unwrap().value, "Italy");
    assert_eq!(s.date.unwrap().value, "2020-01-01");
    let rule = &s.rules[0];
    assert!(!rule.between && &*rule.file == "case.toml");
    assert_eq!(&text[rule.expression.span.clone()], "\"max(least, u)\"");
    assert_eq!(rule.inputs[0].1.value, 0.03);
    assert!(rule.tables[0].1.steps);
    assert_eq!(rule.tables[0].1.points[1][1].value, 3.0);
    let mut case = Case::parse(&text, Path::new("case.toml"))
        .unwrap()
        .separation;
    let argument = Separation::parse("code = \"ntc_2018\"", 2).unwrap();
    case = case.overridden_by(argument);
    assert_eq!(
        (case.country, case.code.unwrap().value.as_str()),
        (None, "ntc_2018")
    );
    for (from, to, says) in [
        (
            "country",
            "code = \"ntc_2018\"\ncountry",
            "`country` and `code` are both given",
        ),
        ("\"boundary\"", "\"beside\"", "beside"),
        ("expression =", "expresion =", "did you mean `expression`?"),
        ("\"30 mm\"", "\"30 furlongs\"", "is not a known unit"),
        ("[2, \"3 m\"]", "[2]", "a point of a table has 1 values"),
        ("name = \"mine\"", "name = \"\"", "a rule needs a name"),
    ] {
        let error = Case::parse(&text.replace(from, to), Path::new("case.toml")).unwrap_err();
        let all = error
            .each()
            .map(|e| format!("{e} {} ", e.help.clone().unwrap_or_default()));
        let all: String = all.collect();
        assert!(all.contains(says), "{says}: {all}");
    }
}

/// At its place, also where the other side is that of a single building.
#[test]
fn plans_that_are_wider_than_long_are_refused() {
    for (keys, says) in [
        (
            "plan_length = \"20 m\"\nplan_width = \"50 m\"\n",
            "`plan_width`, 50 m for building 1, is greater than `plan_length`, 20 m",
        ),
        (
            "plan_length = 20\nplan_width = [10, 21]\n",
            "`plan_width`, 21 m for building 2, is greater",
        ),
    ] {
        let text = format!("{CASE}{keys}");
        let error = Case::parse(&text, Path::new("case.toml")).unwrap_err();
        assert!(error.message.contains(says), "{error:?}");
        assert!(
            text[error.span.clone()].starts_with(['"', '[']),
            "{error:?}"
        );
        assert!(error.help.unwrap().contains("the longer side"));
    }
    let square = format!("{CASE}plan_length = 20\nplan_width = 20\n");
    assert!(Case::parse(&square, Path::new("case.toml")).is_ok());
}
