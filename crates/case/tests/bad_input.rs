//! Bad input: each error points at its place and says what to do.
use std::path::Path;

use pounding_case::{Case, parse_quantity, schema};
use proptest::prelude::*;

const CASE: &str = r#"title = "pair"
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
height = 3.0
damping = { ratio = 0.05, modes = [1, 2] }
[[gap]]
between = ["a", "b"]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
[ground_motion]
file = "record.csv"
[analysis]
duration = "2 s"
"#;

/// Replaced text, its replacement, line, column, what message or help must say.
type Row = (&'static str, &'static str, usize, usize, &'static str);

const ROWS: &[Row] = &[
    ("mass = \"25 t\"", "mass = 25 t", 5, 8, "this is not TOML"),
    ("title", "titel", 1, 1, "did you mean `title`?"),
    ("height", "hieght", 7, 1, "did you mean `height`?"),
    ("width", "wdith", 18, 1, "did you mean `width`?"),
    ("height", "zz = 1\naa = 1\nheight", 7, 1, "unknown key `zz`"),
    ("name = \"a\"\n", "", 2, 1, "[[building]] has no `name`"),
    ("storeys = 2\n", "", 2, 1, "how many storeys"),
    ("\"25 t\"", "[[1, 2]]", 5, 9, "not a list"),
    ("\"25 t\"", "[]", 5, 8, "empty list"),
    ("storeys = 2", "storeys = 0", 4, 11, "whole number from 1"),
    (
        "{ stiffness_proportional = 0.05 }",
        "0.05",
        8,
        11,
        "stiffness_proportional = 0.05",
    ),
    ("\"record.csv\"", "\"\"", 22, 8, "`file` is empty"),
    (
        "\"25 t\"",
        "[\"25 t\", \"-1 t\"]",
        5,
        17,
        "greater than zero",
    ),
    ("\"25 t\"", "nan", 5, 8, "not a finite number"),
    ("\"25 t\"", "1e400", 5, 8, "not a finite number"),
    ("\"25 t\"", "\"1e400 t\"", 5, 8, "not a finite number"),
    ("\"20 mm\"", "[0.02, nan]", 18, 16, "not a finite number"),
    ("\"20 mm\"", "\"-20 mm\"", 18, 9, "zero or more"),
    (
        "duration = \"2 s\"",
        "step = -1",
        24,
        8,
        "greater than zero",
    ),
    (
        "\"25 t\"",
        "\"25 kN\"",
        5,
        8,
        "a weight is a force: divide it by g",
    ),
    ("\"25 t\"", "\"25 g\"", 5, 8, "write the mass in kg or t"),
    ("\"25 t\"", "\"25 T\"", 5, 8, "did you mean \"t\"?"),
    ("\"25 t\"", "\"2,5 t\"", 5, 8, "decimal point"),
    ("\"25 t\"", "[1, 1, 1]", 5, 8, "`storeys` says 2 storeys"),
    ("\"20 mm\"", "[0.1, 0.2, 0.3]", 18, 9, "2 contact levels"),
    (
        "\"20 mm\"",
        "[0.1, 0.2, 0.3, 0.4]",
        18,
        9,
        "a pair of floors that meet",
    ),
    (
        "\"25 t\"",
        "{ first = 25, second = 20 }",
        5,
        8,
        "a list with one for each, in their order",
    ),
    (
        "[ground_motion]\nfile = \"record.csv\"\n",
        "",
        1,
        1,
        "a record of zeros",
    ),
    (
        "[ground_motion]",
        "[separation]\nresponse_modification = { a = 5, b = 8 }\n[ground_motion]",
        22,
        25,
        "a list with one for each",
    ),
    (
        "[ground_motion]",
        "[separation]\nstructural_system = { a = \"frame\" }\n[ground_motion]",
        22,
        21,
        "write a text in quotes, or a list with one for each",
    ),
    (
        "{ stiffness_proportional = 0.05 }",
        "{}",
        8,
        11,
        "needs one of `ratio` with `modes`",
    ),
    (
        "0.05 }",
        "0.05, modes = [1, 2] }",
        8,
        44,
        "no meaning beside",
    ),
    (
        "[1, 2]",
        "[1, 3]",
        15,
        35,
        "two different modes from 1 to 2",
    ),
    ("[1, 2]", "[1, 3]", 15, 35, "write modes = [1, 2]"),
    (
        "storeys = 2",
        "storeys = 4001",
        4,
        11,
        "whole number from 1 to 4000",
    ),
    ("\"b\"", "\"a\"", 10, 8, "given twice, first in line 3"),
    ("\"a\"", "\"wall\"", 3, 8, "rigid wall"),
    ("\"a\"", "\"a/b\"", 3, 8, "cannot name a building"),
    ("\"a\"", "\"..\"", 3, 8, "cannot name a building"),
    (
        "[\"a\", \"b\"]",
        "[\"a\", \"bb\"]",
        17,
        17,
        "did you mean \"b\"?",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"b\", \"a\"]",
        17,
        11,
        "write between = [\"a\", \"b\"]",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"a\", \"a\"]",
        17,
        11,
        "two different neighbours are needed",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"wall\", \"b\"]",
        17,
        11,
        "write between = [\"b\", \"wall\"]",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"ä\", \"bb\"]",
        17,
        12,
        "no building \"ä\"",
    ),
    ("\"3 m\"", "\"3.5 m\"", 17, 11, "floor 1 of \"a\" at 3.5 m"),
    (
        "width",
        "levels = [[1, 3]]\nwidth",
        18,
        15,
        "\"b\" has no storey 3",
    ),
    (
        "width",
        "levels = [[1, 1], [1, 1]]\nwidth",
        18,
        19,
        "given twice",
    ),
    (
        "width",
        "levels = [1, 2]\nwidth",
        18,
        11,
        "pairs of storeys",
    ),
    (
        "width",
        "elevation_tolerance = 1.5\nwidth",
        18,
        23,
        "half of the lowest storey",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"b\", \"wall\"]\nelevation_tolerance = 0.1",
        18,
        23,
        "no meaning",
    ),
    (
        "width",
        "floor_to_floor = true\nwidth",
        18,
        18,
        "no meaning without pairs of floors",
    ),
    (
        "[\"a\", \"b\"]",
        "[\"b\", \"wall\"]\nlevels = [1]\nfloor_to_floor = true",
        19,
        18,
        "no meaning without pairs of floors",
    ),
    (
        "[ground_motion]",
        "[[link]]\nbetween = [\"a\", \"b\"]\nmodel = \"linear\"\nelevation_tolerance = 0.1\nlevels = [[1, 2]]\n[ground_motion]",
        24,
        23,
        "listed `levels` of a link",
    ),
    (
        "\"record.csv\"",
        "\"r\"\nscale = { factor = 2, pga = 1 }",
        23,
        9,
        "one of `factor`, `pga`",
    ),
];

#[test]
fn each_error_points_at_its_place() {
    Case::parse(CASE, Path::new("case.toml")).unwrap();
    let mut wrong = Vec::new();
    for (from, to, line, column, says) in ROWS {
        let source = CASE.replacen(from, to, 1);
        let found = Case::parse(&source, Path::new("case.toml"));
        let Err(error) = found else {
            wrong.push(format!("{to}: accepted"));
            continue;
        };
        let text = format!("{error} | {}", error.help.clone().unwrap_or_default());
        if (error.line, error.column) != (*line, *column) || !text.contains(says) {
            wrong.push(format!("{to} at {line}:{column} \"{says}\": {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A whole number may have a decimal point, as a JSON Schema has it; a fraction may not.
#[test]
fn counts_with_a_decimal_point() {
    let storeys = |text: &str| {
        let source = CASE.replacen("storeys = 2", &format!("storeys = {text}"), 1);
        Case::parse(&source, Path::new("c"))
    };
    for text in ["2.0", "2e0", "0.2e1", "2_0e-1"] {
        assert_eq!(storeys(text).unwrap().buildings[0].mass.len(), 2, "{text}");
    }
    for (text, says) in [
        ("2.5", "not one with a fraction"),
        ("nan", "must be a whole number"),
        ("inf", "must be a whole number"),
        ("-2.0", "from 1"),
        ("1e15", "from 1"),
        ("1e300", "must be a whole number"),
    ] {
        let error = storeys(text).unwrap_err();
        assert!(error.message.contains(says), "{error}");
        assert_eq!((error.line, error.column), (4, 11), "{error}");
    }
    let source = CASE.replacen("[1, 2]", "[1.0, 2.0]", 1);
    Case::parse(&source, Path::new("c")).unwrap();
}

/// What is given already is not suggested once more, and another letter says nothing.
#[test]
fn suggestions_of_what_can_be_meant() {
    let help = |from: &str, to: &str| {
        assert!(CASE.contains(from), "{from}");
        let error = Case::parse(&CASE.replacen(from, to, 1), Path::new("c")).unwrap_err();
        let helps = error.each().filter_map(|e| e.help);
        helps.collect::<Vec<_>>().join(" | ")
    };
    let weight = help("mass = \"25 t\"", "weight = \"245 kN\"");
    assert!(weight.contains("add `mass"), "{weight}");
    assert!(!weight.contains("did you mean"), "{weight}");
    let twice = help("mass = \"25 t\"", "mass = \"25 t\"\nmas = \"25 t\"");
    assert!(twice.contains("did you mean `mass`"), "{twice}");
    let between = |name: &str| help("[\"a\", \"b\"]", &format!("[\"a\", \"{name}\"]"));
    assert!(between("B").starts_with("did you mean \"b\"? "));
    assert!(between("c").starts_with("buildings: a, b"));
}

#[test]
fn numbers_in_all_forms() {
    for text in ["25_000", "2.5e4", "+25000", "0x61A8", "'25Mg'"] {
        let source = CASE.replacen("\"25 t\"", text, 1);
        let case = Case::parse(&source, Path::new("c")).unwrap();
        assert_eq!(case.buildings[0].mass, [25e3; 2], "{text}");
    }
    // 1 in = 0.0254 m, 1 kip = 4448.2216152605 N (1959 pound, standard gravity).
    for (text, value) in [
        ("1 kip", 4_448.221_615_260_5),
        ("2 kgf", 19.6133),
        ("25 tf/m2", 245_166.25),
        ("1 ksi", 6_894_757.293_168_361),
        ("1000 psi", 6_894_757.293_168_361),
        ("3 \u{b5}m", 3.0e-6),
        ("3 \u{3bc}m", 3.0e-6),
        ("1.5 min", 90.0),
        ("25000 kip/in^1.5", 2.747_108_735e10),
        ("25000 kip/in", 4.378_170_881e9),
        ("35 cm", 0.35),
        ("2 m/s/s", 2.0),
        ("5 MN·m\u{207b}¹", 5.0e6),
        ("2 m·s\u{207b}²", 2.0),
        ("3 kN\u{22c5}s/m", 3000.0),
        ("2 kN\u{22c5}m\u{207b}\u{b9}\u{22c5}s", 2000.0),
        ("4 cm\u{2074}", 4.0e-8),
    ] {
        let found = parse_quantity(text).unwrap().value;
        assert!((found / value - 1.0).abs() < 5e-10, "{text}: {found}");
    }
    for text in [
        "5 kN/m s",
        "5 N/",
        "5 1",
        "5 m^nan",
        "1e308 t",
        "3,4 m",
        "- 5 m",
        "inf kg",
        "5 mm.",
        "5 m/s2.",
        "5 m/s^2.",
        "5 m\u{207b}",
        "5 \u{22c5}m",
    ] {
        assert!(parse_quantity(text).is_err(), "{text}");
    }
}

/// Quotes are for units: a text without one is a pure number, which a mass is not.
#[test]
fn texts_without_unit_are_pure_numbers() {
    for (from, to, wanted) in [
        (
            "mass = \"25 t\"",
            "mass = \"25\"",
            "`mass` must be a mass (kg), but \"25\" has no unit",
        ),
        (
            "mass = \"25 t\"",
            "mass = ' 2.5e4 '",
            "\" 2.5e4 \" has no unit",
        ),
        (
            "\"20 mm\"",
            "\"0.02\"",
            "`width` must be a length (m), but \"0.02\" has no unit",
        ),
    ] {
        assert!(CASE.contains(from), "{from}");
        let error = Case::parse(&CASE.replacen(from, to, 1), Path::new("c")).unwrap_err();
        assert!(error.message.contains(wanted), "{error}");
        assert!(error.line > 1 && error.column > 1, "{error}");
        let help = error.help.unwrap();
        assert!(
            help.contains("add a unit, or write") && help.contains("without quotes"),
            "{help}"
        );
    }
    // Pure numbers are as before.
    let source = CASE.replacen(
        "stiffness_proportional = 0.05",
        "stiffness_proportional = \"0.05\"",
        1,
    );
    assert_ne!(source, CASE);
    Case::parse(&source, Path::new("c")).unwrap();
}

#[test]
fn marks_ends_and_depth() {
    for source in [CASE.replace('\n', "\r\n"), format!("\u{feff}{CASE}")] {
        let case = Case::parse(&source, Path::new("c")).unwrap();
        assert_eq!(
            &source[case.gaps[0].model.span.clone()],
            "\"anagnostopoulos_2004\""
        );
    }
    let marked = format!("\u{feff}{}", CASE.replacen("title", "titel", 1));
    let error = Case::parse(&marked, Path::new("c")).unwrap_err();
    assert_eq!((error.line, error.column), (1, 1), "{error}");
    for deep in [
        format!("title = {}{}", "[".repeat(100_000), "]".repeat(100_000)),
        format!("{}a = 1", "a.".repeat(10_000)),
        format!("title = {}1{}", "{a = ".repeat(10_000), "}".repeat(10_000)),
    ] {
        Case::parse(&deep, Path::new("c")).unwrap_err();
    }
    assert!(schema()["properties"]["gap"].is_object());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn damaged_cases_are_answered(
        start in 0..CASE.len(),
        length in 0..40_usize,
        piece in prop::sample::select(vec!["", "\n", "'", "[", "]", "{", "=", "nan", "-1", "1e400",
            "'5 m'", "'5 ^'", "[[1, 2]]", "2020-01-01", "é", "\u{feff}", "[[gap]]\n", "0x"]),
    ) {
        let end = (start + length).min(CASE.len());
        let source = format!("{}{piece}{}", &CASE[..start], &CASE[end..]);
        match Case::parse(&source, Path::new("c")) {
            Err(error) => {
                prop_assert!(error.line >= 1 && error.column >= 1);
                prop_assert!(error.span.end <= source.len() && error.span.start <= error.span.end);
            }
            Ok(case) => for level in case.gaps.iter().flat_map(|g| &g.levels) {
                prop_assert!(level.width >= 0.0 && level.width.is_finite());
            }
        }
    }
}

/// A unit that is not known leads to one of the dimension that is wanted at its key, whether
/// letters or only upper and lower case are wrong.
#[test]
fn units_are_suggested_by_the_dimension_that_is_wanted() {
    use pounding_case::Dimension;
    for (text, wanted, unit) in [
        ("20 mn", Dimension::LENGTH, Some("mm")),
        ("20 mn", Dimension::FORCE, Some("MN")),
        ("20 Mm", Dimension::LENGTH, Some("mm")),
        ("20 MM", Dimension::LENGTH, Some("mm")),
        ("5 M/s", Dimension::VELOCITY, Some("m")),
        ("5 m/S", Dimension::VELOCITY, Some("s")),
        ("5 M/S", Dimension::VELOCITY, Some("m/s")),
        ("5 M/S2", Dimension::ACCELERATION, Some("m/s2")),
        ("3 mn/mm", Dimension::STIFFNESS, Some("MN")),
        ("3 KN/MM", Dimension::STIFFNESS, Some("kN/mm")),
        ("25 KG", Dimension::MASS, Some("kg")),
        ("25 kgs", Dimension::MASS, Some("kg")),
        ("0.3 G", Dimension::ACCELERATION, Some("g")),
        ("2 seconds", Dimension::TIME, None),
        ("2 T", Dimension::TIME, None),
        ("25 x", Dimension::MASS, None),
    ] {
        let help = parse_quantity(text).unwrap_err().help_for(Some(wanted));
        match unit {
            Some(unit) => {
                let said = format!("did you mean \"{unit}\"? ");
                assert!(help.starts_with(&said), "{text}: {help}");
            }
            None => assert!(!help.contains("did you mean"), "{text}: {help}"),
        }
    }
    let help = |text: &str, wanted| parse_quantity(text).unwrap_err().help_for(wanted);
    assert_eq!(
        help("20 mn", Some(Dimension::LENGTH)),
        "did you mean \"mm\"? units of a length (m): m, km, cm, mm, um, in, ft"
    );
    // Without a dimension every unit may be meant.
    assert!(help("20 mn", None).starts_with("did you mean \"MN\"? known units: %, rad, "));
    let help = help("3 x/m", Some(Dimension::STIFFNESS));
    assert!(help.starts_with("known units: %, rad, "), "{help}");
}

/// The key says what is wanted.
#[test]
fn units_of_a_case_are_suggested_for_their_key() {
    for (from, to, unit) in [
        ("\"20 mm\"", "\"20 mn\"", "mm"),
        ("\"25 t\"", "\"25 T\"", "t"),
    ] {
        let text = CASE.replacen(from, to, 1);
        assert_ne!(text, CASE);
        let error = Case::parse(&text, Path::new("case.toml")).unwrap_err();
        let help = error.help.unwrap();
        let said = format!("did you mean \"{unit}\"? units of ");
        assert!(help.starts_with(&said), "{help}");
    }
}

/// Brackets, and other signs than blanks between units, lead to the unit as it can be read, where that is of the
/// dimension that is wanted.
#[test]
fn units_in_other_forms_are_shown_as_they_are_read() {
    use pounding_case::Dimension;
    let help = |text: &str, wanted| parse_quantity(text).unwrap_err().help_for(wanted);
    for (text, wanted, said) in [
        (
            "1500 kN/(m/s)",
            Some(Dimension::DASHPOT),
            "brackets are not read in units: write \"kN s/m\"",
        ),
        (
            "1500 kN (s/m)^0.5",
            None,
            "brackets are not read in units: write \"kN s^0.5/m^0.5\"",
        ),
        (
            "3 kN/(m s^(2))",
            None,
            "brackets are not read in units: write \"kN/m/s^2\"",
        ),
        (
            "3 MN/(m)",
            Some(Dimension::LENGTH),
            "brackets are not read in units: write all factors before `/`",
        ),
        ("1500 kN-s/m", None, "write \"kN s/m\": "),
        (
            "1500 kN.s/m",
            Some(Dimension::DASHPOT),
            "write \"kN s/m\": ",
        ),
        (
            "1500 kN s m-1",
            Some(Dimension::DASHPOT),
            "write \"kN s/m\": ",
        ),
        // Of what is wanted is the one without the second.
        (
            "1500 kN-s/m",
            Some(Dimension::STIFFNESS),
            "did you mean \"kN\"? ",
        ),
        // Two ways to read it.
        ("3 kN/m-s", Some(Dimension::DASHPOT), "known units: "),
        ("20 mm.", Some(Dimension::LENGTH), "did you mean \"mm\"? "),
        (
            "110 ton",
            Some(Dimension::MASS),
            "a metric ton is \"t\"; a US (short) ton is 907.185 kg",
        ),
        (
            "110 ton/in",
            Some(Dimension::STIFFNESS),
            "a metric ton of force is \"tf\"; a US (short) ton of force is 2 \"kip\"",
        ),
    ] {
        let told = help(text, wanted);
        assert!(told.starts_with(said), "{text}: {told}");
    }
    let refused = |text: &str, wanted| {
        let fault = parse_quantity(text).unwrap().of(wanted).unwrap_err();
        format!("{fault:?}")
    };
    let told = refused("20.4 t/cm", Dimension::STIFFNESS);
    assert!(told.contains("is a mass over a length"), "{told}");
    let said = "t is a mass; tonnes of force are tf: \\\"20.4 tf/cm\\\"";
    assert!(told.contains(said), "{told}");
    assert!(refused("3 kg/m", Dimension::STIFFNESS).contains("\"3 kgf/m"));
    assert!(refused("3 t", Dimension::LENGTH).contains("correct the unit"));
}

/// What comes with pasted text is named at its place, in texts and comments it is taken.
#[test]
fn signs_of_pasted_text_are_named() {
    for (from, to, line, column, said) in [
        (
            "name = \"a\"",
            "name = \u{201c}a\u{201d}",
            3,
            8,
            "the quotation mark \u{201c} is a typographic one",
        ),
        (
            "name = \"a\"",
            "name = \"a\u{201d}",
            3,
            10,
            "the quotation mark \u{201d} is a typographic one",
        ),
        (
            "[\"a\", \"b\"]",
            "[\"a\", \u{2018}b\u{2019}]",
            17,
            17,
            "the quotation mark \u{2018} is a typographic one",
        ),
        (
            "width = ",
            "width\u{a0}= ",
            18,
            6,
            "a no-break space (U+00A0) stands here",
        ),
        (
            "width = ",
            "width =\u{200b} ",
            18,
            8,
            "an invisible sign (U+200B) stands here",
        ),
        (
            "height = 3.0",
            "height = 3,0",
            14,
            10,
            "3,0 has a decimal comma",
        ),
        (
            "{ ratio = 0.05,",
            "{ ratio = 0,05,",
            15,
            21,
            "0,05 has a decimal comma",
        ),
        (
            "height = 3.0",
            "height = [3, 3,05]",
            14,
            14,
            "3,05 has a decimal comma",
        ),
        (
            "height = 3.0",
            "height = 3,000",
            14,
            10,
            "3,000 has a comma within the number",
        ),
        (
            "name = \"a\"",
            "```toml\nname = \"a\"",
            3,
            1,
            "``` is a sign of Markdown",
        ),
        ("name = \"a\"", "name = `a`", 3, 8, "` is no quotation mark"),
    ] {
        assert!(CASE.contains(from), "{from}");
        let text = CASE.replacen(from, to, 1);
        let error = Case::parse(&text, Path::new("c")).unwrap_err();
        let told = error.to_string();
        assert!(told.contains(said), "{to}: {told}");
        assert_eq!((error.line, error.column), (line, column), "{to}");
    }
    let error = Case::parse("height = 3,05", Path::new("c")).unwrap_err();
    assert_eq!(
        error.help.as_deref(),
        Some("decimals have a point: 3.05"),
        "{error}"
    );
    // In a list of several lines a missing comma is no decimal one, and the mark of a comment ends no text.
    for (text, sign) in [
        ("height = [ # [\n  100,200 300\n]\n", "comma within"),
        ("height = [ # [\n  100,200 300\n]\n", "decimal comma"),
        ("name = \"a # see \u{201c}plan\u{201d}\n", "typographic"),
    ] {
        let error = Case::parse(text, Path::new("c")).unwrap_err();
        assert!(!error.to_string().contains(sign), "{error}");
    }
    let error = Case::parse("mass = 100,000", Path::new("c")).unwrap_err();
    let help = error.help.unwrap_or_default();
    assert!(
        help.contains("100.000") && help.contains("100000"),
        "{help}"
    );
    // Elsewhere in the line such signs are no fault, and the parser speaks.
    let error = Case::parse("height = 3 m # \u{201c}3,05\u{201d}", Path::new("c")).unwrap_err();
    assert!(!error.to_string().contains("typographic"), "{error}");
    let pasted = CASE.replacen("\"20 mm\"", "\"20\u{a0}mm\" # \u{201c}0,05\u{201d}", 1);
    assert!(Case::parse(&pasted, Path::new("c")).is_ok());
}

/// Widths of a metre and more without a unit are asked about, up to where a warning says the same of any.
#[test]
fn bare_widths_of_gaps_are_asked_about() {
    let asked = |width: &str| {
        let text = CASE.replacen("\"20 mm\"", width, 1);
        Case::parse(&text, Path::new("c")).unwrap().asked
    };
    for (width, meant) in [
        (
            "2",
            "`width` of the gap \"a-b\" is 2 m, wide for a joint; a number without unit is in m: was \"2 cm\" or \"2 in\" meant?",
        ),
        (
            "[0.02, 1]",
            "was \"1 cm\" or \"1 in\" meant? If not, write \"1 m\"",
        ),
    ] {
        let asked = asked(width);
        assert!(asked.len() == 1 && asked[0].contains(meant), "{asked:?}");
    }
    for width in ["0.99", "\"2 m\"", "\"20 mm\"", "[0.02, \"1 m\"]", "20"] {
        assert!(asked(width).is_empty(), "{width}");
    }
}

/// A Rayleigh damping that is a number is shown as it is written.
#[test]
fn rayleigh_damping_is_shown() {
    let text = CASE.replacen("{ stiffness_proportional = 0.05 }", "{ rayleigh = 5 }", 1);
    let error = Case::parse(&text, Path::new("c")).unwrap_err();
    let help = error.help.unwrap();
    assert!(help.contains("rayleigh = { alpha = "), "{help}");
    assert!(help.contains("{ ratio = 0.05, modes = [1, 2] }"), "{help}");
}

/// Names of buildings that are too long together: said where the gap, or link, stands between them, and cured by its name.
#[test]
fn gaps_and_links_without_a_name_have_that_of_both_buildings() {
    let link = "[[link]]\nbetween = [\"a\", \"b\"]\nlevels = [[1, 1]]\nmodel = \"linear_elastic\"\nstiffness = 1e6\nname = \"l\"\n";
    let case = CASE.replace("[ground_motion]", &format!("{link}[ground_motion]"));
    let named = |left: usize, right: usize, text: &str| {
        let (a, b) = ("a".repeat(left), "b".repeat(right));
        let text = text.replace("\"a\"", &format!("{a:?}"));
        let text = text.replace("\"b\"", &format!("{b:?}"));
        Case::parse(&text, Path::new("case.toml"))
    };
    assert!(named(99, 100, &case).is_ok());
    for (what, text) in [
        ("gap", case.clone()),
        (
            "link",
            case.replace("name = \"l\"\n", "")
                .replace("[[gap]]", "[[gap]]\nname = \"g\""),
        ),
    ] {
        let error = named(100, 100, &text).unwrap_err();
        let said = format!("the {what} has no name of its own");
        assert!(error.message.contains(&said), "{error:?}");
        assert!(error.message.contains("201 characters"), "{error:?}");
        let remedy = format!("give the {what} a `name`");
        assert!(error.help.unwrap().contains(&remedy));
        assert!(error.others.is_empty());
    }
    let both = case.replace("[[gap]]", "[[gap]]\nname = \"g\"");
    assert!(named(100, 100, &both).is_ok());
}
