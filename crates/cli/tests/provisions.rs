//! Provisions: their page, editions by date, users' rules, and what a disputed one does.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use pounding_separation::{arithmetic, descriptors};
use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pounding(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .current_dir(root())
        .output()
        .unwrap()
}

const CASE: &str = "examples/gap_check/case.toml";
const RULES: &str = "examples/gap_check/rules.toml";

fn gap(more: &[&str]) -> Output {
    pounding(&[&["gap", CASE, "--points", "0"][..], more].concat())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A text in one line, without the frames of errors.
fn plain(text: &str) -> String {
    let words = text.replace('\u{2502}', " ");
    words.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

fn named<'a>(list: &'a Value, name: &str) -> &'a Value {
    let mut list = list.as_array().unwrap().iter();
    list.find(|x| x["name"] == name)
        .unwrap_or_else(|| panic!("{name}"))
}

const REMEDY: &str = "run `cargo run --bin pounding -- gap --list --pages docs/reference`, look at the difference and commit it";

#[test]
fn the_committed_page_is_what_the_code_says() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_str().unwrap();
    let output = pounding(&["gap", "--list", "--pages", place]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let fresh = std::fs::read_to_string(folder.path().join("provisions.md")).unwrap();
    let committed = std::fs::read_to_string(root().join("docs/reference/provisions.md")).unwrap();
    let line = fresh
        .lines()
        .zip(committed.lines())
        .position(|(a, b)| a != b);
    assert!(
        fresh == committed,
        "docs/reference/provisions.md differs from line {:?} on; {REMEDY}",
        line.map(|l| l + 1)
    );
}

/// Every number of a worked example on the page is that of the arithmetic before it.
#[test]
fn worked_examples_of_the_page_are_right() {
    let page = std::fs::read_to_string(root().join("docs/reference/provisions.md")).unwrap();
    let mut worked = 0;
    for part in page.split("\nWorked example").skip(1) {
        let block = part.split("```").nth(1).unwrap();
        for line in block.lines().skip(1) {
            let (by_hand, result) = line.rsplit_once(" = ").unwrap();
            let (width, _) = result.split_once(" mm").unwrap();
            let expected = format!("{:.1}", arithmetic(by_hand).unwrap());
            assert_eq!(width, expected, "{line}");
            worked += 1;
        }
    }
    // Two readings of either disputed provision.
    assert_eq!(worked, descriptors().len() + 2);
}

/// The page offers the name of a family with a date for editions alone that have dates.
#[test]
fn the_page_offers_dates_where_they_choose() {
    let page = std::fs::read_to_string(root().join("docs/reference/provisions.md")).unwrap();
    let offered: Vec<_> = page.lines().filter(|l| l.contains("with a date")).collect();
    assert!(
        offered
            .iter()
            .any(|l| l.contains("`--code tdy_2007`, or `turkey`"))
    );
    for line in offered {
        assert!(line.starts_with("In force from"), "{line}");
    }
    let output = gap(&["--code", "japan_practice", "--date", "2020-01-01"]);
    let said = plain(&text(&output.stderr));
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("leave it out") && !said.contains("name \"japan\""),
        "{said}"
    );
}

/// The rules of the example: 0.8 of the sum of the peaks, and setbacks of 0.005 h on either side
/// for three storeys and aligned floors.
#[test]
fn rules_of_a_file() {
    let output = gap(&["--rules", RULES, "--code", "office_sum", "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let result = json(&output);
    assert_eq!(result["decided_by_code"], "office_sum");
    assert!(result["date"].is_null());
    let peak = |b: usize| {
        let peaks = &result["records"][0]["isolated"][b]["displacement"];
        peaks[2]["peak"].as_f64().unwrap()
    };
    let answer = &result["gaps"][0]["code"]["cases"][0];
    let width = answer["required"].as_f64().unwrap();
    assert!((width - 0.8 * (peak(0) + peak(1))).abs() < 1.0e-15);
    assert!((width - 0.1079).abs() < 1.0e-4, "{width}");
    let rule = &answer["levels"][2]["provision"];
    assert_eq!(rule["status"], "yours");
    assert_eq!(rule["source"], RULES);
    assert_eq!(rule["edition"], "Office standard 2026");
    assert_eq!(
        rule["assumptions"]["others"][0],
        "torsion is in the displacements"
    );
    let provisions = &result["gaps"][0]["provisions"];
    let setback = named(provisions, "office_setback");
    let width = setback["records"][0]["width"].as_f64().unwrap();
    assert!((width - 2.0 * 0.005 * 9.0).abs() < 1.0e-15, "{width}");
    let shown = text(&gap(&["--rules", RULES]).stdout);
    assert!(shown.contains("office_setback"), "{shown}");
    assert!(shown.contains("yours"), "{shown}");
    let chosen = gap(&["--rules", RULES, "--provisions", "office_setback", "--json"]);
    let chosen = json(&chosen);
    assert_eq!(chosen["gaps"][0]["provisions"].as_array().unwrap().len(), 1);
}

/// The same rules in the case; wrong ones have their place there, in `gap` and in `check`.
#[test]
fn rules_of_the_case() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let file_name = file.to_str().unwrap();
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(root().join(CASE)).unwrap();
    let case = case.replace("../../ground_motions", records.to_str().unwrap());
    let rules = std::fs::read_to_string(root().join(RULES)).unwrap();
    let rules = rules
        .replace("[[rule]]", "[[separation.rule]]")
        .replace("[rule.", "[separation.rule.");
    std::fs::write(&file, format!("{case}\n{rules}")).unwrap();
    let output = pounding(&["gap", file_name, "--points", "0", "--code", "office_sum"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let wrong = format!("{case}\n{}", rules.replace("u_right", "u_rihgt"));
    std::fs::write(&file, &wrong).unwrap();
    let line = wrong.lines().position(|l| l.contains("u_rihgt")).unwrap() + 1;
    for command in [&["check"][..], &["gap"]] {
        let output = pounding(&[command, &[file_name]].concat());
        let said = plain(&text(&output.stderr));
        assert_eq!(output.status.code(), Some(2), "{said}");
        for part in [
            &format!("case.toml:{line}:"),
            "this name is not known, at `u_rihgt`",
            "did you mean `u_right`?",
        ] {
            assert!(said.contains(part), "{command:?} {part}: {said}");
        }
    }
}

#[test]
fn wrong_rules_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rules.toml");
    let place = file.to_str().unwrap();
    let rule = |name: &str, expression: &str| {
        format!("[[rule]]\nname = {name:?}\nkind = \"between\"\nexpression = {expression:?}\n")
    };
    for (rules, says) in [
        (
            rule("mine", "u_left + 30"),
            "rules.toml:4:15: rule \"mine\", expression: a length (m) and a pure number cannot be added",
        ),
        (
            rule("nbcc_2015_between", "u_left"),
            "is a provision, a code or a combination rule already",
        ),
        (
            rule("eurocode_8", "u_left"),
            "is a provision, a code or a combination rule already",
        ),
        (rule("a", "u_left").repeat(2), "two rules are called \"a\""),
        (rule("a", "u_lef") + &rule("b", "u_righ"), "rules.toml:8:15"),
        (
            rule("a", "u_left").replace("kind", "king"),
            "did you mean `kind`?",
        ),
        ("rule = 3".to_owned(), "a list of tables"),
        (String::new(), "rule"),
        ("[[rule]".to_owned(), "this is not TOML"),
    ] {
        std::fs::write(&file, &rules).unwrap();
        let output = gap(&["--rules", place]);
        let said = plain(&text(&output.stderr));
        assert_eq!(output.status.code(), Some(2), "{rules}: {said}");
        assert!(said.contains(says), "{rules}: {said}");
    }
    let output = gap(&["--rules", "nowhere.toml"]);
    assert!(text(&output.stderr).contains("nowhere.toml"));
    assert_eq!(output.status.code(), Some(2));
    // A rule without a value is no answer, and says where.
    std::fs::write(
        &file,
        rule("mine", "u_left / (storeys_left - storeys_right)"),
    )
    .unwrap();
    let output = gap(&["--rules", place, "--code", "mine"]);
    assert_eq!(output.status.code(), Some(1));
    let said = plain(&text(&output.stdout));
    assert!(said.contains("NO ANSWER"), "{said}");
    assert!(
        said.contains("this is zero, and divides, at `storeys_left - storeys_right`, character 11"),
        "{said}"
    );
}

/// The day decides between editions, is printed and stored; without one it is today.
#[test]
fn editions_by_date() {
    let result = |more: &[&str]| json(&gap(&[more, &["--json"]].concat()));
    for (arguments, code, date) in [
        (
            &["--code", "turkey", "--date", "2018-12-31"][..],
            "tdy_2007",
            Some("2018-12-31"),
        ),
        (
            &["--code", "turkey", "--date", "2019-01-01"],
            "tbdy_2018",
            Some("2019-01-01"),
        ),
        (
            &["--country", "Turkey", "--date", "2010-01-01"],
            "tdy_2007",
            Some("2010-01-01"),
        ),
        (
            &["--set", "country=\"Italy\"", "--set", "date=\"2020-01-01\""],
            "ntc_2018",
            Some("2020-01-01"),
        ),
        (&["--code", "tdy_2007"], "tdy_2007", None),
    ] {
        let result = result(arguments);
        assert_eq!(result["decided_by_code"], code, "{arguments:?}");
        assert_eq!(result["date"].as_str(), date, "{arguments:?}");
    }
    let today = result(&["--code", "ntc"]);
    assert_eq!(today["date"].as_str().map(str::len), Some(10));
    let shown = text(&gap(&["--code", "turkey", "--date", "2018-12-31"]).stdout);
    assert!(
        shown.contains("the edition in force on 2018-12-31"),
        "{shown}"
    );
    assert!(shown.contains("superseded by TBDY 2018"), "{shown}");
    for (arguments, says) in [
        (
            &["--date", "31.12.2018", "--code", "ntc"][..],
            "write year, month and day",
        ),
        (
            &["--code", "ntc", "--date", "2000-01-01"],
            "in force on 2000-01-01",
        ),
        (
            &["--code", "asce_7", "--date", "2017-06-01"],
            "name the edition, with --code or `code` in [separation]: asce_7_2010 or asce_7_2016",
        ),
        // A date that nothing asks for.
        (
            &["--code", "tdy_2007", "--date", "2018-12-31"],
            "\"tdy_2007\" is one edition",
        ),
        (
            &["--code", "tdy_2007", "--date", "2018-12-31"],
            "name \"turkey\"",
        ),
        (
            &["--set", "code=\"tdy_2007\"", "--set", "date=\"2018-12-31\""],
            "decides nothing",
        ),
        (&["--date", "2018-12-31"], "no code is asked for"),
        (&["--country", "Itly"], "did you mean \"Italy\"?"),
        (
            &["--country", "United States", "--date", "2020-01-01"],
            "several codes in force",
        ),
        (
            &["--country", "Italy", "--code", "ntc"],
            "cannot be used with",
        ),
        (
            &["--set", "country=\"Atlantis\""],
            "no code of \"Atlantis\"",
        ),
        (
            &["--set", "code=\"ntc\"", "--set", "country=\"Italy\""],
            "`code` and `country` are both given",
        ),
        (
            &["--code", "ntc_2018, damping=0.03"],
            "unknown code \"ntc_2018, damping=0.03\"",
        ),
    ] {
        let output = gap(arguments);
        let said = plain(&text(&output.stderr));
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(says), "{arguments:?}: {said}");
        assert!(!said.contains("TOML"), "{arguments:?}: {said}");
    }
}

#[test]
fn an_entry_is_set_once() {
    let output = gap(&["--set", "importance=1", "--set", "importance = 2"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(text.contains("importance is given twice"), "{text}");
    // All that is wrong is told at once.
    let output = gap(&[
        "--set",
        "importance=-1",
        "--set",
        "soil=2",
        "--set",
        "date=7",
        "--set",
        "soil=3",
    ]);
    assert_eq!(output.status.code(), Some(2));
    let told = plain(&String::from_utf8_lossy(&output.stderr));
    for part in [
        "importance",
        "unknown key `soil`",
        "`date`",
        "soil is given twice",
        "4 errors",
    ] {
        assert!(told.contains(part), "{part}: {told}");
    }
}

/// Standard 2800 by height across a property line for ordinary buildings, with what is to be known of
/// it; by analysis for important ones.
#[test]
fn a_code_says_what_is_to_be_known_of_its_rule() {
    for (importance, rule, remark) in [
        (
            "1.0",
            "iran_2800_boundary_by_height",
            "this width holds for others only",
        ),
        (
            "1.4",
            "iran_2800_boundary_by_analysis",
            "Above 8 storeys, and for buildings of high or very high importance",
        ),
    ] {
        let set = format!("importance={importance}");
        let arguments = ["--set", &set, "--code", "iran_2800"];
        let shown = plain(&text(&gap(&arguments).stdout));
        assert!(shown.contains(remark), "{shown}");
        let answer = json(&gap(&[&arguments[..], &["--json"]].concat()));
        let cases = answer["gaps"][0]["code"]["cases"].as_array().unwrap();
        let across = cases
            .iter()
            .find(|c| c["ownership"] == "different properties");
        let across = across.unwrap();
        assert_eq!(
            across["levels"][2]["provision"]["name"], rule,
            "{importance}"
        );
        let remarks = across["remarks"].as_array().unwrap();
        let said = remarks.iter().any(|r| r.as_str().unwrap().contains(remark));
        assert!(said, "{remarks:?}");
    }
}

/// Across a property line each building goes by its own rule: table, `--json` and page name both.
#[test]
fn both_rules_of_a_property_line_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"))
        .unwrap()
        .replace(
            "name = \"heavy\"\nstoreys = 3",
            "name = \"heavy\"\nstoreys = 9",
        )
        .replace("../..", root().to_str().unwrap())
        .replace("31 s", "5 s");
    let file = folder.path().join("case.toml");
    std::fs::write(&file, case).unwrap();
    let file = file.to_str().unwrap();
    let page = folder.path().join("page.html");
    let arguments = [
        "gap",
        file,
        "--points",
        "0",
        "--set",
        "importance=1.0",
        "--code",
        "iran_2800",
    ];
    let shown = plain(&text(&pounding(&arguments).stdout));
    let rules = [
        "iran_2800_boundary_by_height",
        "iran_2800_boundary_by_analysis",
    ];
    for rule in rules {
        assert!(shown.contains(&format!("by: {rule}")), "{shown}");
    }
    let more = ["--json", "--report", page.to_str().unwrap()];
    let output = pounding(&[&arguments[..], &more].concat());
    let answer = json(&output);
    let cases = answer["gaps"][0]["code"]["cases"].as_array().unwrap();
    let across = |c: &&Value| c["ownership"] == "different properties";
    let across = cases.iter().find(across).unwrap();
    let level = &across["levels"][2];
    let mut found =
        ["provision", "other_provision"].map(|key| level[key]["name"].as_str().unwrap());
    found.sort_unstable();
    assert_eq!(
        found,
        [
            "iran_2800_boundary_by_analysis",
            "iran_2800_boundary_by_height"
        ]
    );
    let remarks: Vec<_> = across["remarks"].as_array().unwrap().iter().collect();
    let has = |part: &str| remarks.iter().any(|r| r.as_str().unwrap().contains(part));
    assert!(
        has("this width holds for others only") && has("Above 8 storeys"),
        "{remarks:?}"
    );
    let page = std::fs::read_to_string(page).unwrap();
    for rule in rules {
        assert!(
            page.contains(&format!("what {rule} takes for granted")),
            "{rule}"
        );
    }
}

/// Where a code has no rule for a gap the answer says what there is beside it.
#[test]
fn a_code_without_a_rule_for_the_gap_says_what_else_there_is() {
    let low = gap(&["--code", "as_1170_4"]);
    let wall = ["gap", "examples/rigid_wall/case.toml", "--points", "0"];
    let wall = pounding(&[&wall[..], &["--code", "nbcc_2015"]].concat());
    for (output, says) in [
        (
            low,
            "the code has no other rule: --all shows the combination rules absolute_sum",
        ),
        (wall, "the code has no rule for one building beside a wall"),
    ] {
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        let said = plain(&text(&output.stdout));
        assert!(said.contains(says), "{said}");
        assert!(said.contains("[[separation.rule]]"), "{said}");
        assert!(!said.contains("choose the rule"), "{said}");
    }
}

/// A value that no code has is warned of by `gap`, in text and JSON, also of an argument, which counts
/// in the place of the case; by `check` where it stands in the case.
#[test]
fn values_that_no_code_has_are_warned_of() {
    let says = "`importance` of [separation] is 125, and in codes 0.5 to 2; a percentage is written as a factor, 1.25";
    let shown = text(&gap(&["--set", "importance=125"]).stdout);
    assert_eq!(
        shown.matches(&format!("warning: {says}")).count(),
        1,
        "{shown}"
    );
    let of_json = |output: &Output| -> Vec<String> {
        let all = json(output)["warnings"].clone();
        let all = all.as_array().unwrap().iter();
        all.map(|w| w.as_str().unwrap().to_owned()).collect()
    };
    let said = of_json(&gap(&["--set", "importance=125", "--json"]));
    assert!(said.iter().any(|w| w == says), "{said:?}");
    assert!(
        !of_json(&gap(&["--json"]))
            .iter()
            .any(|w| w.contains("importance"))
    );
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(root().join(CASE)).unwrap();
    let case = case
        .replace("../../ground_motions", records.to_str().unwrap())
        .replace("importance = 1.0", "importance = 125");
    std::fs::write(&file, case).unwrap();
    let name = file.to_str().unwrap();
    let shown = text(&pounding(&["check", name]).stdout);
    assert_eq!(shown.matches(says).count(), 1, "{shown}");
    let said = of_json(&pounding(&["check", name, "--json"]));
    assert!(said.iter().any(|w| w == says), "{said:?}");
    let set = [
        "gap",
        name,
        "--points",
        "0",
        "--set",
        "importance=1",
        "--json",
    ];
    let said = of_json(&pounding(&set));
    assert!(!said.iter().any(|w| w == says), "{said:?}");
}

/// A disputed rule shows both widths, judges no gap and gives no verdict: by hand, of the sum of
/// peaks with I = 1, a third and two thirds; across a property line those of the light building, and of the heavy one
/// 2 per mil of its 9 m, which are more than two thirds of its peak.
#[test]
fn a_disputed_rule_decides_nothing() {
    let set = ["--set", "importance=1"];
    let output = gap(&[&set[..], &["--code", "nch_433", "--json"]].concat());
    assert_eq!(output.status.code(), Some(1));
    let result = json(&output);
    let peak = |b: usize| {
        let peaks = &result["records"][0]["isolated"][b]["displacement"];
        peaks[2]["peak"].as_f64().unwrap()
    };
    assert!(2.0 * peak(1) / 3.0 < 0.018 && peak(0) / 3.0 > 0.018);
    let code = &result["gaps"][0]["code"];
    assert!(code["satisfied"].is_null());
    for case in code["cases"].as_array().unwrap() {
        assert!(case["required"].is_null() && case["satisfied"].is_null());
        let readings = &case["levels"][2]["readings"];
        let is_same = case["ownership"] == "same property";
        for (reading, thirds) in [(0, 1.0), (1, 2.0)] {
            let heavy = match is_same {
                true => thirds * peak(1) / 3.0,
                false => 0.018,
            };
            let width = thirds * peak(0) / 3.0 + heavy;
            let found = readings[reading]["width"].as_f64().unwrap();
            assert!((found / width - 1.0).abs() < 1.0e-12, "{found} {width}");
        }
    }
    let rule = named(&result["gaps"][0]["provisions"], "nch_433_between");
    assert_eq!(rule["status"], "disputed");
    assert!(rule["satisfied"].is_null());
    assert!(rule["records"][0]["width"].is_null());
    assert!(rule["records"][0]["levels"][2]["width"].is_null());
    let shown = text(&gap(&[&set[..], &["--code", "nch_433"]].concat()).stdout);
    assert!(
        shown.contains("NO ANSWER") && shown.contains("none is chosen"),
        "{shown}"
    );
    let shown = text(&gap(&set).stdout);
    assert!(shown.contains("not judged: disputed"), "{shown}");
}

/// With a code its answer stands alone; all else is there with `--all`.
#[test]
fn other_tables_are_folded_beside_the_answer_of_a_code() {
    const OTHERS: [&str; 3] = [
        "widths by rule under",
        "At the provided gaps",
        "demand, the maximum approach",
    ];
    let arguments = ["--set", "same_owner=true", "--code", "asce_41"];
    let folded = text(&gap(&arguments).stdout);
    let all = text(&gap(&[&arguments[..], &["--all"]].concat()).stdout);
    for table in OTHERS {
        assert!(!folded.contains(table), "{table}: {folded}");
        assert!(all.contains(table), "{table}: {all}");
    }
    assert!(
        folded.contains("--all also shows demand by level"),
        "{folded}"
    );
    assert!(all.contains("What rules take for granted"), "{all}");
    assert!(
        folded.contains("height: what it is measured from was not seen"),
        "{folded}"
    );
}

/// A rule that has no value at a level where it applies judges nothing, and says why: what it asks
/// at other levels would be no answer. The roofs of the case stand at 9 m.
#[test]
fn a_rule_without_a_value_at_a_level_decides_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, rule: &str| {
        let path = folder.path().join(name);
        let head = "[[rule]]\nkind = \"between\"\n";
        std::fs::write(&path, format!("{head}{rule}")).unwrap();
        path.display().to_string()
    };
    for (expression, reason) in [
        ("p(height)", "p(height)"),
        ("0.01 * height / max(0, 8 - height / one)", ""),
    ] {
        let table = "[rule.tables]\np = { points = [[\"0 m\", \"10 mm\"], [\"8.999 m\", \"100 mm\"]], interpolation = \"linear\" }\n";
        let rule = format!(
            "name = \"office\"\nexpression = {expression:?}\ninputs = {{ one = \"1 m\" }}\n{table}"
        );
        let rules = write("rules.toml", &rule);
        let answer = json(&gap(&["--rules", &rules, "--json"]));
        let office = named(&answer["gaps"][0]["provisions"], "office");
        assert!(office["satisfied"].is_null(), "{office}");
        assert!(
            office["refusal"].as_str().unwrap().contains(reason),
            "{office}"
        );
        let said = text(&gap(&["--rules", &rules, "--provisions", "office", "--all"]).stdout);
        assert!(!said.contains("| yes"), "{said}");
    }
    // Names of combination rules are taken.
    for name in [
        "SRSS",
        "DDC",
        "absolute_sum",
        "square_root_of_sum_of_squares (SRSS)",
    ] {
        let rules = write(
            "taken.toml",
            &format!("name = {name:?}\nexpression = \"0.01 * height\"\n"),
        );
        let output = gap(&["--rules", &rules]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(
            plain(&text(&output.stderr)).contains("combination rule already"),
            "{name}"
        );
    }
}
