//! Expressions right and wrong, with message and place.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use pounding_case::{CaseError, RuleText};

use super::OwnRule;
use crate::error::SeparationError;
use crate::inputs::{Input, Situation};
use crate::worked_example::worked_example;
use crate::working::Requirement;

/// A file with one rule of this kind and these further keys.
fn file(kind: &str, expression: &str, more: &str) -> String {
    format!("[[rule]]\nname = \"mine\"\nkind = \"{kind}\"\nexpression = '''{expression}'''\n{more}")
}

fn compiled(file: &str) -> Result<OwnRule, CaseError> {
    let rules = RuleText::parse_all(file, "rules.toml")?;
    OwnRule::compile(&rules[0])
}

fn between(expression: &str, more: &str) -> Result<Requirement, SeparationError> {
    let rule = compiled(&file("between", expression, more));
    let rule = rule.unwrap_or_else(|e| panic!("{expression}: {e}"));
    rule.between(&worked_example())
}

/// By hand for the worked example: u 80 and 60 mm, h 18 m, 7 and 6 storeys of 21 and 18 m, R 8 and
/// 5, Cd 4 and 4.5, I 1.1, floors not aligned, one owner, zone II, a_g S = 0.25 g.
#[test]
fn twenty_right_ones() {
    const NONE: &str = "";
    for (expression, more, millimetres) in [
        ("u_left + u_right", NONE, 140.0),
        ("sqrt(pow(u_left, 2) + pow(u_right, 2))", NONE, 100.0),
        (
            "max(u_left, u_right) - min(u_left, u_right, 1 * height)",
            NONE,
            20.0,
        ),
        ("0.006 * height", NONE, 108.0),
        (
            "max(least, 0.001 * height)",
            "inputs = { least = \"30 mm\" }",
            30.0,
        ),
        ("2 / 3 * (u_left + u_right)", NONE, 280.0 / 3.0),
        ("floors_aligned ? 0.25 * u_left : 0.5 * u_left", NONE, 40.0),
        ("same_owner && !floors_aligned ? u_left : 0", NONE, 80.0),
        ("importance * (u_left / R_left * Cd_left)", NONE, 44.0),
        ("height * design_ground_acceleration / g / 100", NONE, 45.0),
        ("storeys_left <= 3 ? 0 : 0.02 * height", NONE, 360.0),
        // Begun steps of 3 m above 6 m: four.
        (
            "first + step * ceil((height - low) / rise)",
            "inputs = { first = \"30 mm\", step = \"10 mm\", low = \"6 m\", rise = \"3 m\" }",
            70.0,
        ),
        (
            "part(min(storeys_left, storeys_right)) * height",
            "tables = { part = { points = [[1, 0], [3, 0.01], [4, 0.02]], interpolation = \"steps\" } }",
            360.0,
        ),
        // Between 15 and 21 m, half way: 100 mm.
        (
            "width(building_height_right)",
            "tables = { width = { points = [[\"15 m\", \"80 mm\"], [\"21 m\", \"120 mm\"]], interpolation = \"linear\" } }",
            100.0,
        ),
        // s / 2 on either side, of 108 mm.
        (
            "s / 2 + s / 2",
            "inputs = { least = \"30 mm\" }\ndefinitions = { s = \"max(least, 0.006 * height)\" }",
            108.0,
        ),
        (
            "a + b",
            "definitions = { a = \"b + u_left\", b = \"u_right\" }",
            200.0,
        ),
        (
            "structural_system_left == \"frame\" && structural_system_right != \"wall\" ? u_left : u_right",
            NONE,
            80.0,
        ),
        (
            "soil_zone == 2 || false ? 0.003 * height : 0.006 * height",
            NONE,
            54.0,
        ),
        (
            "abs(-u_left) + floor(2.5) * u_right - 7 % 4 * u_right",
            NONE,
            20.0,
        ),
        (
            "sqrt(u_left * u_right / 12) * 1e0 + .5 * u_left",
            NONE,
            60.0,
        ),
        // The dimension of g T^2 is a length: 9.80665 * 9 / 1000.
        ("g * pow(isolation_period, 2) / 1000", NONE, 88.259_85),
    ] {
        let found = between(expression, more).unwrap();
        assert!(
            (1.0e3 * found.width - millimetres).abs() < 1.0e-9,
            "{expression}: {} mm",
            1.0e3 * found.width
        );
        let asked = pounding_catalogue::numbers::rounded_up(millimetres, 1);
        let shown = format!("{asked} mm");
        assert!(found.explanation.ends_with(&shown), "{}", found.explanation);
    }
}

/// A boundary rule knows one building and is summed over both sides.
#[test]
fn a_boundary_rule() {
    let rule = compiled(&file("boundary", "max(u, 0.001 * height)", "")).unwrap();
    let Situation { left, site, .. } = &worked_example();
    let own = rule.boundary(left, site).unwrap();
    assert!((own.width - 0.08).abs() < 1.0e-12);
    let both = rule.between(&worked_example()).unwrap();
    assert!((both.width - 0.14).abs() < 1.0e-12);
    for part in ["u(left) = 0.080000 m", "u(right)", "summed over both sides"] {
        assert!(both.explanation.contains(part), "{}", both.explanation);
    }
    let between = compiled(&file("between", "u_left", "")).unwrap();
    let refused = between.boundary(left, site);
    assert!(matches!(
        refused,
        Err(SeparationError::NotApplicable { .. })
    ));
}

/// A begun step of nothing is zero, without a sign, also summed over both sides.
#[test]
fn a_negative_zero_is_zero() {
    let more = "inputs = { step = \"3 m\", base = \"18 m\", w = \"10 mm\" }\ndefinitions = { s = \"ceil((height - base) / step) * w\" }";
    for kind in ["between", "boundary"] {
        let rule = compiled(&file(kind, "s", more)).unwrap();
        let found = rule.between(&worked_example()).unwrap();
        assert_eq!(found.width.to_bits(), 0.0_f64.to_bits(), "{kind}");
        assert!(!found.explanation.contains("-0"), "{}", found.explanation);
    }
}

/// Floors at 22 and 19.2 m: a boundary rule takes each building's own, 110 and 96 mm; one between
/// two says which, and nothing where it does not.
#[test]
fn the_height_is_that_of_either_floor() {
    let mut situation = worked_example();
    (situation.left.elevation, situation.right.elevation) = (22.0, 19.2);
    let rule = |kind, expression| compiled(&file(kind, expression, "")).unwrap();
    let found = |kind, expression| rule(kind, expression).between(&situation);
    for (kind, expression, width) in [
        ("boundary", "0.005 * height", 0.206),
        ("between", "max(height_left, height_right) / 100", 0.22),
        ("between", "height_right / 100", 0.192),
    ] {
        let width_found = found(kind, expression).unwrap().width;
        assert!((width_found - width).abs() < 1e-12, "{width_found}");
    }
    let refused = found("between", "height / 100").unwrap_err().to_string();
    let says = "`height` is not the same for both buildings: write height_left and height_right";
    assert!(refused.contains(says), "{refused}");
}

/// Found when the rule is read: message, line and column.
#[test]
fn wrong_ones_are_refused_with_their_place() {
    let long = format!("u_left{}", " + u_left".repeat(1200));
    let brackets = format!("{}u_left{}", "(".repeat(5000), ")".repeat(5000));
    let signs = "-".repeat(10_000);
    let chain = format!("u_left{}", "+u_left".repeat(200));
    let choices = format!("{}u_left", "true?u_left:".repeat(60));
    let quoted = format!("{}u_left", "true?\",\":".repeat(60));
    let deep = (0..40).map(|i| format!("d{i} = \"d{} + u_left + u_left + u_left\"\n", i + 1));
    let deep = format!(
        "[rule.definitions]\n{}d40 = \"u_left\"",
        deep.collect::<String>()
    );
    const NONE: &str = "";
    let limit = format!("u_left{}", "+u_left".repeat(100));
    assert!(compiled(&file("between", &limit, NONE)).is_ok());
    let limit = format!("{limit}+u_left");
    for (expression, more, column, says) in [
        ("u_lefd + u_right", NONE, 17, "did you mean `u_left`?"),
        ("2 * u", NONE, 21, "write u_left or u_right"),
        (
            "u_left + R_left",
            NONE,
            17,
            "a length (m) and a pure number cannot be added",
        ),
        ("u_left * u_right", NONE, 17, "must be a length"),
        ("u_left > 0.08 ? u_left : 0", NONE, 17, "cannot be compared"),
        (
            "u_left + 30",
            NONE,
            17,
            "give numbers with a unit as `inputs`",
        ),
        (
            "sqrt(u_left)",
            NONE,
            17,
            "the result is a quantity in m^0.5",
        ),
        ("u_left / 0", NONE, 26, "this divides by zero"),
        ("mine + u_left", NONE, 17, "a rule cannot need itself"),
        ("u_left +", NONE, 25, "it ends too early"),
        (
            "u_left * 12345678901234567890123456789",
            NONE,
            26,
            "the whole number has too many digits",
        ),
        ("max(u_left, u_right", NONE, 36, "it ends too early"),
        (
            "pow(u_left, R_left)",
            NONE,
            29,
            "must be a number that is written out",
        ),
        ("u_left ^ 2", NONE, 24, "pow(x, 2)"),
        ("max(u_left)", NONE, 17, "two quantities or more"),
        (
            "maximum(u_left, u_right)",
            NONE,
            17,
            "this function is not known",
        ),
        (
            "u_left == true ? u_left : 0",
            NONE,
            17,
            "cannot be compared",
        ),
        (
            "floors_aligned + u_left",
            NONE,
            17,
            "does not go with true or false",
        ),
        (
            "structural_system_left == \"castle\" ? u_left : 0",
            NONE,
            43,
            "no structural system",
        ),
        (
            "storeys_left == \"3\" ? u_left : 0",
            NONE,
            33,
            "write a number without quotes, as 3",
        ),
        ("[u_left]", NONE, 17, "cannot stand in an expression"),
        ("u_left // + u_right", NONE, 24, "`//` is no operator"),
        ("u_left * 10u", NONE, 26, "`10u` is no number"),
        ("u_left * 0x10", NONE, 26, "`0x10` is no number"),
        ("u_left.x", NONE, 23, "cannot stand in an expression"),
        ("ceil(height)", NONE, 22, "rounds pure numbers"),
        ("u_left > u_right", NONE, 17, "the result is true or false"),
        ("sqrt + u_left", NONE, 17, "write sqrt(...)"),
        ("h\u{f6}he", NONE, 18, "cannot stand in an expression"),
        (&long, NONE, 17, "10806 characters are too many"),
        (&brackets, NONE, 17, "characters are too many"),
        (&brackets[4900..5110], NONE, 49, "nest in one another"),
        (&signs, NONE, 17, "characters are too many"),
        (&signs[..1999], NONE, 17, "this is no expression"),
        (&chain, NONE, 709, "more than 100 operations nest"),
        (&choices, NONE, 405, "nest in one another"),
        (&quoted, NONE, 309, "brackets or `?` nest in one another"),
        (&limit, NONE, 17, "more than 100 operations nest"),
        ("d0", &deep, 0, "more than 100 operations nest"),
    ] {
        let error = compiled(&file("between", expression, more)).unwrap_err();
        let all = format!("{error} {}", error.help.clone().unwrap_or_default());
        assert!(all.contains(says), "{expression:.60}: {all}");
        assert_eq!(error.file, "rules.toml");
        if column > 0 {
            assert_eq!(
                (error.line, error.column),
                (4, column),
                "{expression:.60}: {all}"
            );
        }
    }
}

/// All that is wrong in a rule is told, each once: in the expression, in definitions that it takes, and in those that it
/// does not.
#[test]
fn all_that_is_wrong_in_a_rule_is_told() {
    let definitions =
        "definitions = { b = \"baz * u_left\", c = \"1 +\", d = \"bar(1)\", e = \"u_left\" }";
    let error = compiled(&file(
        "between",
        "foo + u_left * b + b + d + e",
        definitions,
    ))
    .unwrap_err();
    let told: Vec<String> = error.each().map(|e| e.to_string()).collect();
    for part in ["foo", "baz", "it ends too early", "bar"] {
        let count = told.iter().filter(|t| t.contains(part)).count();
        assert_eq!(count, 1, "{part}: {told:#?}");
    }
    assert_eq!(told.len(), 4, "{told:#?}");
}

/// Choices beside one another nest in nothing: 50 of them are as many terms.
#[test]
fn many_choices_beside_one_another() {
    let terms = vec!["(R_left > 1 ? u_left : u_right)"; 50].join(" + ");
    assert!(compiled(&file("between", &terms, "")).is_ok());
    let arguments = vec!["R_left > 1 ? u_left : u_right"; 50].join(", ");
    assert!(compiled(&file("between", &format!("max({arguments})"), "")).is_ok());
}

/// A difference of equal lengths is zero, whichever sign its round-off has.
#[test]
fn a_width_of_round_off_is_none() {
    for expression in [
        "0.3 * u_left - 0.1 * u_left * 3",
        "0.1 * u_left * 3 - 0.3 * u_left",
    ] {
        assert!(between(expression, "").unwrap().width.abs() < 1e-15);
    }
    assert!(between("0.3 * u_left - 0.31 * u_left", "").is_err());
}

/// Words of the language are refused where they are to be names, and names that break a line.
#[test]
fn names_that_cannot_stand_in_an_expression() {
    for word in ["in", "true", "null", "as", "for"] {
        let inputs = format!("inputs = {{ {word} = \"3 mm\" }}");
        let error = compiled(&file("between", "u_left", &inputs)).unwrap_err();
        assert!(
            error.to_string().contains("a word of the language"),
            "{error}"
        );
    }
    let edition = "edition = \"one\\ntwo\"";
    let text = file("between", "u_left", edition);
    let error = RuleText::parse_all(&text, "rules.toml").unwrap_err();
    assert!(error.to_string().contains("breaks a line"), "{error}");
}

/// What the errors of a width without its unit propose is right: 100 mm, and 180 mm at 18 m.
#[test]
fn a_number_for_a_width_is_told_how_it_is_written() {
    for (wrong, expression, width) in [
        ("0.1", "w", 0.1),
        ("height * height", "max(0.01 * height, w)", 0.18),
    ] {
        let error = compiled(&file("between", wrong, "")).unwrap_err();
        let help = error.help.unwrap();
        let inputs = "inputs = { w = \"100 mm\" }";
        for part in [&format!("expression = \"{expression}\""), inputs] {
            assert!(help.contains(part), "{part}: {help}");
        }
        let found = between(expression, inputs).unwrap().width;
        assert!((found - width).abs() < 1e-12, "{expression}: {found}");
    }
    let error = compiled(&file("between", "100 mm", "")).unwrap_err();
    assert!(
        error
            .help
            .unwrap()
            .contains("stand in `inputs`, such as w = \"100 mm\"")
    );
}

/// Wrong tables, definitions and names, each with its line.
#[test]
fn wrong_parts_are_refused_with_their_place() {
    for (more, line, says) in [
        (
            "definitions = { a = \"b\", b = \"a + u_left\" }",
            5,
            "needs itself",
        ),
        ("definitions = { a = \"a\" }", 5, "needs itself"),
        (
            "inputs = { a = \"1 m\" }\ndefinitions = { b = \"1 +\" }",
            6,
            "it ends too early",
        ),
        (
            "inputs = { a = \"1 m\" }\ndefinitions = { b = \"u_left + 30\" }",
            6,
            "cannot be added",
        ),
        ("definitions = { a = \"u_left +\" }", 5, "it ends too early"),
        ("definitions = { a = \"x\" }", 5, "this name is not known"),
        (
            "inputs = { u_left = 3, a = \"1 m\" }",
            5,
            "has a meaning already",
        ),
        ("inputs = { a = \"3 parsec\" }", 5, "is not a known unit"),
        (
            "inputs = { a = \"1 m\" }\ndefinitions = { a = \"u_left\" }",
            6,
            "stands twice",
        ),
        (
            "inputs = { \"a b\" = 1, a = \"1 m\" }",
            5,
            "cannot be a name",
        ),
        (
            "tables = { a = { points = [[1, 2]], interpolation = \"steps\" } }",
            5,
            "has 1 points",
        ),
        (
            "tables = { a = { points = [[1, 2], [1, 3]], interpolation = \"steps\" } }",
            5,
            "do not rise",
        ),
        (
            "tables = { a = { points = [[1, \"2 m\"], [2, \"3 s\"]], interpolation = \"steps\" } }",
            5,
            "in one column",
        ),
        (
            "tables = { a = { points = [[1, 2, 3], [2, 3, 4]], interpolation = \"steps\" } }",
            5,
            "has 3 values",
        ),
        (
            "tables = { a = { points = [[1, 2], [2, 3]], interpolation = \"cubic\" } }",
            5,
            "cubic",
        ),
        (
            "tables = { a = { points = [[1, 2], [2, 3]], interpolation = \"steps\" } }",
            4,
            "write a(...)",
        ),
    ] {
        let error = compiled(&file("between", "a", more)).unwrap_err();
        let all = format!("{error} {}", error.help.clone().unwrap_or_default());
        assert!(all.contains(says), "{more}: {all}");
        assert_eq!(error.line, line, "{all}");
    }
}

/// Found when the rule is applied: what divides by zero, leaves its table, has no root, is
/// negative, is not given, or differs between the buildings.
/// A misspelled least width is none, which is said beside the width.
#[test]
fn names_that_are_not_taken_are_said() {
    let more =
        "inputs = { laest = \"30 mm\", w = \"10 mm\" }\ndefinitions = { s = \"R_left * u_left\" }";
    let mut rules =
        RuleText::parse_all(&file("between", "u_left + u_right + w", more), "rules.toml").unwrap();
    let rule = OwnRule::compile(&rules.remove(0)).unwrap();
    let said = rule.assumptions().others;
    assert_eq!(said.len(), 2, "{said:?}");
    for (sentence, name) in said.iter().zip(["\"s\"", "\"laest\""]) {
        assert!(
            sentence.contains("does not take") && sentence.contains(name),
            "{sentence}"
        );
    }
    // It asks the case for what it takes alone.
    assert_eq!(rule.inputs(), [Input::Displacement]);
}

#[test]
fn values_that_are_none_are_refused_with_their_place() {
    let table =
        "tables = { a = { points = [[1, \"1 m\"], [2, \"2 m\"]], interpolation = \"linear\" } }";
    for (expression, more, says) in [
        (
            "u_left / (storeys_left - 7)",
            "",
            "mine: this is zero, and divides, at `storeys_left - 7`, character 11 of its expression",
        ),
        (
            "u_left % (u_left - u_left)",
            "",
            "this is zero, and divides",
        ),
        (
            "a(storeys_left)",
            table,
            "7 lies outside the table a, which goes from 1 to 2",
        ),
        (
            "sqrt(u_right - u_left) * sqrt(height)",
            "",
            "the root of a negative value",
        ),
        ("u_right - u_left", "", "the width is negative (-20.000 mm)"),
        ("R * height", "", "write R_left and R_right"),
        ("pow(10, 400) * height", "", "the power has no finite value"),
        (
            "d",
            "definitions = { d = \"u_left / (R_left - 8)\" }",
            "at `R_left - 8`, character 11 of its definition \"d\"",
        ),
    ] {
        let error = between(expression, more).unwrap_err().to_string();
        assert!(error.contains(says), "{expression}: {error}");
    }
    let rule = compiled(&file("between", "importance * u_left", "")).unwrap();
    let mut situation = worked_example();
    situation.left.importance = None;
    let error = rule.between(&situation).unwrap_err();
    assert_eq!(
        error.to_string(),
        "mine needs importance (importance factor I) of left"
    );
    // What is not computed needs nothing.
    let rule = compiled(&file(
        "between",
        "same_owner ? u_left : importance * u_left",
        "",
    ))
    .unwrap();
    assert!(rule.between(&situation).is_ok());
}

/// What a rule says of itself.
#[test]
fn a_rule_describes_itself() {
    let text = file(
        "between",
        "floors_aligned\n  ? d : height / 100",
        "edition = \"Office 2026\"\nclause = \"4.2\"\ndefinitions = { d = \"u_left + u_right\" }\nassumptions = \"torsion is in u\"\n",
    );
    let rule = compiled(&text).unwrap();
    assert_eq!(
        rule.formula(),
        "floors_aligned ? d : height / 100, d = u_left + u_right"
    );
    assert!(rule.depends_on_displacement());
    let keys: Vec<_> = rule.inputs().iter().map(|i| i.key()).collect();
    assert_eq!(keys, ["floors_aligned", "displacement"]);
    let taken = rule.assumptions();
    assert_eq!(taken.others, ["torsion is in u"]);
    assert!(taken.height.starts_with("above ground"));
    assert!(taken.alignment.starts_with("asks"));
}

/// Texts made of parts of expressions, texts of any characters, and right expressions with a few
/// characters changed: each is compiled or refused, and what is compiled has a value or says why
/// not. `POUNDING_EXPRESSIONS` sets how many of each.
#[test]
fn random_texts_are_answered() {
    const PARTS: [&str; 40] = [
        "u_left",
        "u_right",
        "height",
        "storeys",
        "storeys_left",
        "R_left",
        "R",
        "importance",
        "floors_aligned",
        "same_owner",
        "g",
        "0",
        "1",
        "2.5",
        "1e308",
        "least",
        "part",
        "s",
        "(",
        ")",
        "(",
        ")",
        "+",
        "-",
        "*",
        "/",
        "%",
        "<",
        ">=",
        "==",
        "&&",
        "||",
        "!",
        "?",
        ":",
        ",",
        "max(",
        "sqrt(",
        "pow(",
        "\"frame\"",
    ];
    let count: usize = std::env::var("POUNDING_EXPRESSIONS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(1000);
    let more = "inputs = { least = \"30 mm\" }\ndefinitions = { s = \"max(least, u_left)\" }\n[rule.tables]\npart = { points = [[1, 0], [9, 1]], interpolation = \"linear\" }\n";
    let mut rules = RuleText::parse_all(&file("between", "1", more), "rules.toml").unwrap();
    let mut text = rules.remove(0);
    // Any sequence of numbers does: that of Lehmer, 1951, as by Park and Miller, 1988.
    let mut state: u64 = 20_261_123;
    let mut random = |below: usize| {
        state = state * 16_807 % 2_147_483_647;
        (state as usize) % below
    };
    let (mut read, mut valued) = (0_usize, 0_usize);
    const RIGHT: [&str; 5] = [
        "max(least, 2 / 3 * (u_left + u_right))",
        "sqrt(pow(u_left, 2) + pow(u_right, 2))",
        "floors_aligned ? 0.25 * u_left : 0.5 * s",
        "part(min(storeys_left, 5)) * height / R_left",
        "storeys_left <= 3 && !same_owner ? 0 : 0.02 * height",
    ];
    for number in 0..3 * count {
        let length = 1 + random(if number % 50 == 0 { 600 } else { 12 });
        let mut expression: String = (0..length)
            .map(|_| match number % 3 {
                0 => format!("{} ", PARTS[random(PARTS.len())]),
                _ => char::from_u32(random(200) as u32 + 9)
                    .unwrap_or(' ')
                    .to_string(),
            })
            .collect();
        if number % 3 == 2 {
            let mut letters: Vec<char> = RIGHT[random(RIGHT.len())].chars().collect();
            for _ in 0..random(3) {
                const OTHERS: &[u8] = b"0123.+-*/()<>=!?:,_ auRes";
                let place = random(letters.len());
                letters[place] = char::from(OTHERS[random(OTHERS.len())]);
            }
            expression = letters.into_iter().collect();
        }
        text.expression.value = expression;
        let Ok(rule) = OwnRule::compile(&text) else {
            continue;
        };
        read += 1;
        match rule.between(&worked_example()) {
            Ok(required) => {
                assert!(required.width.is_finite() && required.width >= 0.0);
                valued += 1;
            }
            Err(e) => assert!(!e.to_string().is_empty()),
        }
    }
    println!(
        "of {} texts {read} were rules, {valued} had a value",
        3 * count
    );
    assert!(read > 0 && valued > 0, "{read} {valued}");
}
