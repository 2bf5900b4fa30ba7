//! Answers of codes, and the provisions that they are made of.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::{close, gap, json, motions, named, root, seven, text};

const BEHAVIOUR: [&str; 6] = [
    "--set",
    "response_modification=5",
    "--set",
    "displacement_amplification=4.5",
    "--set",
    "importance=1",
];

/// A code that multiplies elastic displacements says so, and decides nothing where the
/// buildings yield: in the table, the JSON object and the CSV file.
#[test]
fn codes_are_marked_where_buildings_yield() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("codes.csv");
    let answers = |example: &str| {
        let mut arguments = BEHAVIOUR.to_vec();
        arguments.extend([
            "--points",
            "0",
            "--all",
            "--codes-csv",
            csv.to_str().unwrap(),
        ]);
        let shown = text(&gap(example, &arguments).stdout);
        arguments.push("--json");
        let result = json(&gap(example, &arguments));
        (shown, result, std::fs::read_to_string(&csv).unwrap())
    };
    let line = |shown: &str, rule: &str| {
        let line = shown.lines().find(|l| l.contains(rule));
        line.unwrap_or_else(|| panic!("{shown}")).to_owned()
    };
    let (shown, result, codes) = answers("yielding_pair");
    let provisions = &result["gaps"][0]["provisions"];
    for (rule, factor) in [
        ("asce_7_10_between", "Cd / Ie"),
        ("ubc_1997_between", "0.7 R"),
    ] {
        let provision = named(provisions, "name", rule);
        assert_eq!(provision["elastic_displacement_factor"], factor);
        assert!(provision["satisfied"].is_null());
        let caution = provision["caution"].as_str().unwrap();
        assert!(
            caution.contains("light and heavy is inelastic"),
            "{caution}"
        );
        let level = &provision["records"][0]["levels"][2];
        assert!(level["width"].as_f64().unwrap() > 0.0);
        assert_eq!(level["caution"], caution);
        let row = line(&shown, rule);
        assert!(
            row.contains(factor) && row.contains("not judged: elastic only"),
            "{row}"
        );
        let row = line(&codes, rule);
        assert!(row.contains(factor) && row.contains("inelastic"), "{row}");
    }
    let sum = named(provisions, "name", "asce_41_between");
    assert!(sum["caution"].is_null() && sum["satisfied"].is_boolean());
    let storeys = &result["records"][0]["isolated"][0]["inelastic_storeys"];
    assert_eq!(storeys[0]["storey"], 1);
    let ductility = storeys[0]["ductility"].as_f64().unwrap();
    assert!(ductility > 1.2, "{ductility}");
    let said = format!("light under 1 of 1 record (maximum ductility {ductility:.2}, storey 1");
    assert!(shown.contains(&said), "{said}: {shown}");
    assert!(shown.contains("these widths decide nothing"), "{shown}");

    let (shown, result, codes) = answers("three_storey_pair");
    let provisions = &result["gaps"][0]["provisions"];
    let asce = named(provisions, "name", "asce_7_10_between");
    assert!(asce["caution"].is_null() && asce["satisfied"].is_boolean());
    assert!(
        line(&shown, "asce_7_10_between").contains("Cd / Ie"),
        "{shown}"
    );
    for text in [&shown, &codes] {
        assert!(
            !text.contains("not judged: elastic only") && !text.contains("inelastic"),
            "{text}"
        );
    }
}

#[test]
fn a_list_takes_no_option_of_a_check() {
    for more in [
        "--points=5",
        "--code=ntc",
        "--probability=0.1",
        "--csv=a.csv",
        "--all",
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(["gap", "--list", more])
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(2), "{more}");
        let said = text(&output.stderr);
        assert!(said.contains("cannot be used with"), "{more}: {said}");
    }
}

#[test]
fn provisions_are_listed_with_their_status() {
    let list = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .args(["gap", "--list"])
            .args(more)
            .output()
            .unwrap();
        assert!(output.status.success());
        text(&output.stdout)
    };
    let shown = list(&[]);
    assert!(shown.contains("unverified: the clause"), "{shown}");
    assert!(
        shown.contains("NTC-Sismo 2017 and 2023"),
        "codes without a formula"
    );
    let result: Value = serde_json::from_str(&list(&["--json"])).unwrap();
    let provisions = result["provisions"].as_array().unwrap();
    assert!(provisions.len() > 50);
    for p in provisions {
        let statuses = ["seen in a secondary text", "unverified", "disputed"];
        assert!(statuses.contains(&p["status"].as_str().unwrap()));
        for said in ["displacement", "height", "ownership", "alignment"] {
            assert!(
                p["assumptions"][said]
                    .as_str()
                    .is_some_and(|s| !s.is_empty()),
                "{p}"
            );
        }
        assert!(p["source"].as_str().is_some_and(|s| !s.is_empty()), "{p}");
    }
    let factor =
        |name| named(&result["provisions"], "name", name)["elastic_displacement_factor"].clone();
    assert_eq!(factor("is_1893_2016_between"), "R");
    assert_eq!(factor("ntc_2018_between"), "mu_d");
    assert!(factor("asce_41_between").is_null());
    let line = shown.lines().find(|l| l.contains("is_1893_2016_between"));
    assert!(shown.contains("elastic displacement times"), "{shown}");
    assert!(line.unwrap().contains(" R "), "{shown}");
}

/// The numbers of `docs/how-to/seven-records-one-code.md`.
#[test]
fn seven_records_one_code() {
    let motions = (1..=7).map(|i| format!("examples/synthetic_suite/motion_{i}.csv"));
    let motions: Vec<String> = motions.collect();
    let mut arguments = vec!["--records"];
    arguments.extend(motions.iter().map(String::as_str));
    let provisions = [
        "--provisions",
        "en_1998_1_2004_between",
        "nbcc_2015_between",
    ];
    arguments.extend(provisions);
    arguments.extend(["--probability", "0.1", "--points", "0"]);
    let output = gap("gap_check", &arguments);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let page = root().join("docs/how-to/seven-records-one-code.md");
    let page = std::fs::read_to_string(page).unwrap();
    for (rule, numbers) in [
        ("absolute_sum", ["155.3 to 161.8", "1.072", "0 of 7"]),
        (
            "square_root_of_sum_of_squares (SRSS)",
            ["136.7 to 143.0", "0.942", "4 of 7"],
        ),
        (
            "double_difference (DDC)",
            ["136.7 to 142.9", "0.942", "4 of 7"],
        ),
        (
            "en_1998_1_2004_between",
            ["95.7 to 100.1", "0.660", "7 of 7"],
        ),
        ("nbcc_2015_between", ["136.7 to 143.0", "0.942", "4 of 7"]),
    ] {
        for text in [&shown, &page] {
            let row = text
                .lines()
                .find(|l| l.starts_with('|') && l.contains(rule));
            let row = row.unwrap_or_else(|| panic!("{rule} is not in {text}"));
            let cells: Vec<&str> = row.split('|').map(str::trim).collect();
            for number in numbers {
                assert!(cells.contains(&number), "{number} is not in {row}");
            }
        }
    }
    for number in [
        "148.95 mm by count",
        "152.97 mm",
        "144.77 to 172.89 mm",
        "TOO SMALL",
    ] {
        assert!(shown.contains(number), "{number} is not in {shown}");
    }
}

/// The answer of Eurocode 8 from the displacements of each record in the same object, by hand:
/// the mean of seven records, the maximum of six, root or sum, times 0.7 for floors that are
/// aligned.
#[test]
fn one_code_decides_by_its_statistic() {
    for (count, statistic) in [(7, "mean"), (6, "maximum")] {
        let files = motions(count);
        let answer = |more: &[&str]| {
            let arguments = seven(&files, &["--code", "eurocode_8_2004", "--json"]);
            let output = gap("gap_check", &[&arguments[..], more].concat());
            (output.status.code(), json(&output))
        };
        let (exit, result) = answer(&[]);
        assert_eq!(exit, Some(0));
        assert_eq!(result["adequate"], true);
        assert_eq!(result["decided_by_code"], "eurocode_8_2004");
        let roof = |building: usize| {
            let records = result["records"].as_array().unwrap().iter();
            let peaks = records.map(|r| &r["isolated"][building]["displacement"][2]["peak"]);
            let peaks: Vec<f64> = peaks.map(|p| p.as_f64().unwrap()).collect();
            match count {
                7 => peaks.iter().sum::<f64>() / 7.0,
                _ => peaks.iter().copied().fold(0.0, f64::max),
            }
        };
        let (light, heavy) = (roof(0), roof(1));
        let code = &result["gaps"][0]["code"];
        assert_eq!(code["statistic"], statistic);
        assert_eq!(code["enough_records"], true);
        let [same, different] = [0, 1].map(|i: usize| &code["cases"][i]);
        assert_eq!(same["ownership"], "same property");
        close(&same["required"], 0.7 * light.hypot(heavy), 1e-12);
        assert_eq!(different["ownership"], "different properties");
        close(&different["required"], 0.7 * (light + heavy), 1e-12);
        assert_eq!(same["governing_level"], 3);
        assert_eq!(same["levels"][2]["provision"]["status"], "unverified");
        // Each of these records closes the gap that the code accepts, and the program says so.
        assert_eq!(result["gaps"][0]["adequate"], false);
        let suite = &result["gaps"][0]["suite"];
        let demand: Vec<f64> = result["gaps"][0]["demand"]
            .as_array()
            .unwrap()
            .iter()
            .map(|d| d.as_f64().unwrap())
            .collect();
        close(
            &suite["mean"],
            demand.iter().sum::<f64>() / count as f64,
            1e-12,
        );
        close(
            &suite["maximum"],
            demand.iter().copied().fold(0.0, f64::max),
            1e-15,
        );
    }
    let files = motions(7);
    let arguments = seven(&files, &["--code", "eurocode_8_2004"]);
    let output = gap("gap_check", &arguments);
    let shown = text(&output.stdout);
    let headline = "Gap light-heavy by eurocode_8_2004 (EN 1998-1:2004): WIDE ENOUGH";
    assert_eq!(shown.lines().nth(2), Some(headline), "{shown}");
    assert!(shown.contains("decided by the mean of the displacements under 7 records"));
    assert!(shown.contains("a width that the code accepts"), "{shown}");
    assert!(
        !shown.contains("nzs_1170_5"),
        "other rules are folded: {shown}"
    );
    let all = [&arguments[..], &["--all"]].concat();
    assert!(text(&gap("gap_check", &all).stdout).contains("nzs_1170_5"));
}

/// Records that the case scales to a code: the mean spectrum beside the target, and each
/// factor. The factor of a record is that of `motion process` to the same spectrum.
#[test]
fn a_suite_scaled_to_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let file = root().join("examples/gap_check/case.toml");
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(file).unwrap();
    let case = case.replace("../../ground_motions", records.to_str().unwrap());
    let scale = "scale = { code = \"eurocode_8_2004\", ground_type = \"C\", ag = \"0.25 g\", from = \"0.2 s\", to = \"2 s\" }";
    let case = case.replace("[ground_motion]", &format!("[ground_motion]\n{scale}"));
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let place = folder.path().to_str().unwrap();
    let arguments = ["--records", "ground_motions", "--points", "0"];
    let result = json(&gap(place, &[&arguments[..], &["--json"]].concat()));
    let target = &result["spectra"]["target"];
    assert!(
        target["name"]
            .as_str()
            .unwrap()
            .starts_with("eurocode_8_2004, ag 0.25 g")
    );
    assert_eq!((&target["from"], &target["to"]), (&0.2.into(), &2.0.into()));
    let spectra = &result["spectra"];
    assert_eq!(spectra["periods"].as_array().unwrap().len(), 200);
    let at = |list: &Value| list[100].as_f64().unwrap();
    let both = &spectra["pseudo_acceleration"];
    close(
        &spectra["mean"][100],
        0.5 * (at(&both[0]) + at(&both[1])),
        1e-14,
    );
    let least = target["least_ratio_of_mean"].as_f64().unwrap();
    assert!(least < 1.0 && least > 0.3, "{least}");
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args([
            "motion",
            "process",
            "ground_motions/kobe_1995_jma_ns.csv",
            "--json",
            "-o",
        ])
        .arg(folder.path().join("o.csv"))
        .args([
            "--scale",
            "code=eurocode_8_2004, ground_type=C, ag=0.25 g, from=0.2 s, to=2 s",
        ])
        .current_dir(root())
        .output()
        .unwrap();
    let numbers = json(&output)["steps"][0]["numbers"].clone();
    let factor = named(&numbers, "name", "factor")["value"].as_f64().unwrap();
    close(&result["records"][1]["factor"], factor, 1e-15);
    let shown = text(&gap(place, &arguments).stdout);
    assert!(
        shown.contains("by least squares of the logarithm"),
        "{shown}"
    );
    assert!(shown.contains(&format!("{factor:.4}")), "{factor} {shown}");
}

/// Another property needs a sum: 0.7 (137.3 + 20.4) is 110.4 mm, above 105 mm; one property
/// 97.2 mm. Two records are fewer than the code asks for, and a code without its inputs gives
/// no answer, which is not a yes.
#[test]
fn ownership_and_missing_inputs_decide() {
    let folder = tempfile::tempdir().unwrap();
    let file = root().join("examples/gap_check/case.toml");
    let records = root().join("ground_motions").canonicalize().unwrap();
    let case = std::fs::read_to_string(file).unwrap();
    let case = case
        .replace("116.1 mm", "105 mm")
        .replace("../../ground_motions", records.to_str().unwrap())
        .replace("[separation]", "[separation]\ncode = \"eurocode_8_2004\"");
    assert!(case.contains("code = "));
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let folder = folder.path().to_str().unwrap();
    let files = motions(7);
    let page = Path::new(folder).join("page.html");
    let page = page.to_str().unwrap();
    for (owner, exit, verdict) in [("true", 0, "is wide enough"), ("false", 1, "is too small")] {
        let set = format!("same_owner={owner}");
        let output = gap(folder, &seven(&files, &["--set", &set, "--report", page]));
        assert_eq!(output.status.code(), Some(exit), "{}", text(&output.stdout));
        // The page gives the verdict of the code, not that of the records: all of them close it.
        let said = std::fs::read_to_string(page).unwrap();
        let headline = format!("By EN 1998-1:2004 gap light-heavy {verdict}.");
        assert!(said.contains(&headline), "{headline}");
    }
    let few = gap(folder, &seven(&files[..2], &["--report", page]));
    assert_eq!(few.status.code(), Some(1));
    let told = text(&few.stdout);
    assert!(
        told.contains("NO ANSWER") && told.contains("the code asks for 3 records at least"),
        "{told}"
    );
    let said = std::fs::read_to_string(page).unwrap();
    assert!(said.contains("gives no answer for gap light-heavy."));
    let undecided = gap(
        "three_storey_pair",
        &["--points", "0", "--code", "asce_7_2016"],
    );
    assert_eq!(undecided.status.code(), Some(1));
    let said = text(&undecided.stdout);
    assert!(
        said.contains("NO ANSWER") && said.contains("add `response_modification`")
            || said.contains("add `displacement_amplification`"),
        "{said}"
    );
}

/// With fewer records than a code asks for no width decides: the row of the table and every answer
/// of the object say so, as the headline does. TBDY 2018 has one rule whoever owns the ground, and
/// EN 1998-1 two: only of the latter the page says that ownership decides.
#[test]
fn rows_have_the_answer_of_the_headline() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page.html").display().to_string();
    let files = motions(6);
    let wide = ["--set", "same_owner=true", "--report", &page];
    let decides = "The case states who owns the ground: same property decides.";
    let told = |code: &str, asked: bool| {
        let mut arguments = wide.to_vec();
        arguments.extend(["--code", code]);
        let shown = text(&gap("gap_check", &seven(&files, &arguments)).stdout);
        let said = std::fs::read_to_string(&page).unwrap();
        assert_eq!(said.contains(decides), asked, "{code}");
        arguments.push("--json");
        let found = json(&gap("gap_check", &seven(&files, &arguments)));
        let found = found["gaps"][0]["code"].clone();
        assert_eq!(found["ownership"].is_string(), asked, "{code}: {found}");
        (shown, found)
    };
    let (shown, found) = told("tbdy_2018", false);
    assert!(shown.contains("the code asks for 11 records at least"));
    assert!(shown.contains("NO ANSWER"), "{shown}");
    let row = shown.lines().find(|l| l.contains("| tbdy_2018_"));
    assert!(row.unwrap().contains("no answer"), "{shown}");
    assert!(found["satisfied"].is_null());
    let answer = &found["cases"][0];
    assert!(answer["satisfied"].is_null(), "{answer}");
    // The width by the maximum is shown all the same.
    assert!(answer["required"].as_f64().unwrap() > 0.0);
    for level in answer["levels"].as_array().unwrap() {
        assert!(level["satisfied"].is_null(), "{level}");
    }
    let (shown, found) = told("eurocode_8_2004", true);
    assert!(!shown.contains("no answer"), "{shown}");
    assert!(found["satisfied"].is_boolean());
    assert!(found["cases"][0]["satisfied"].is_boolean());
}

/// By hand: TBDY 2018 asks for 30 mm and 10 mm more for the one step of 3 m above 6 m, whatever the displacements
/// are, so that 20 mm are too small under two records, where it asks for eleven, and 45 mm have no answer.
#[test]
fn a_minimum_by_height_decides_under_any_records() {
    let files = motions(2);
    for (width, short) in [("20 mm", true), ("45 mm", false)] {
        let folder = super::example_with(&format!("\"{width}\""));
        let path = folder.path().to_str().unwrap();
        let page = folder.path().join("page.html").display().to_string();
        let mut arguments = BEHAVIOUR.to_vec();
        arguments.extend(["--code", "tbdy_2018", "--report", &page]);
        let arguments = seven(&files, &arguments);
        let output = gap(path, &arguments);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        let shown = text(&output.stdout);
        let said = std::fs::read_to_string(&page).unwrap();
        let why = "too small under any records: tbdy_2018_minimum asks for 40.0 mm at level 3-3, whatever the displacements are";
        assert_eq!(shown.contains("TOO SMALL"), short, "{shown}");
        assert_eq!(shown.contains("NO ANSWER"), !short, "{shown}");
        assert_eq!(shown.contains(why), short, "{shown}");
        assert_eq!(said.contains("too small under any records"), short);
        assert_eq!(said.contains("gives no answer"), !short);
        let json = json(&gap(path, &[&arguments[..], &["--json"]].concat()));
        let code = &json["gaps"][0]["code"];
        assert_eq!(code["satisfied"].as_bool(), short.then_some(false));
        let anyway = &code["cases"][0]["short_anyway"];
        assert_eq!(anyway.is_object(), short, "{code}");
        if short {
            close(&anyway["required"], 0.04, 1e-12);
            assert_eq!(anyway["provision"], "tbdy_2018_minimum");
        }
    }
}

/// Two readings of NCh 433 differ by a factor of two: a gap is too small where it reaches neither, and has no answer else.
#[test]
fn what_every_reading_asks_for_decides() {
    let widths = |width: &str| {
        let folder = super::example_with(&format!("\"{width}\""));
        let mut arguments = BEHAVIOUR.to_vec();
        arguments.extend(["--code", "nch_433", "--points", "0"]);
        let shown = text(&super::gap_in(folder.path(), &arguments).stdout);
        arguments.push("--json");
        let json = json(&super::gap_in(folder.path(), &arguments));
        let code = json["gaps"][0]["code"].clone();
        (shown, code)
    };
    let (shown, code) = widths("5 mm");
    assert!(
        shown.contains("TOO SMALL")
            && shown.contains("every reading: asks for more than is provided"),
        "{shown}"
    );
    assert_eq!(code["satisfied"], false);
    let level = &code["cases"][0]["levels"][2];
    let readings = level["readings"].as_array().unwrap();
    let mut readings: Vec<f64> = readings
        .iter()
        .map(|r| r["width"].as_f64().unwrap())
        .collect();
    readings.sort_by(f64::total_cmp);
    close(&(readings[1] / readings[0]).into(), 2.0, 1e-9);
    // Across a property line, where the heavy building keeps its 18 mm, both readings are less apart.
    let between = format!("{} mm", 1.4e3 * readings[0]);
    let (shown, code) = widths(&between);
    assert!(
        shown.contains("NO ANSWER") && shown.contains("none is chosen"),
        "{shown}"
    );
    assert!(code["satisfied"].is_null());
}

/// A rule that takes no displacement needs no records: that for isolated buildings by equivalent
/// lateral forces asks for 140.0 mm (its worked numbers are those of the isolated building's page), and
/// answers under one record, where the code asks for eleven. One that takes displacements does not.
#[test]
fn rules_without_displacements_decide_under_any_records() {
    let inputs = [
        "spectral_acceleration_1s=\"0.35 g\"",
        "isolation_period=\"2 s\"",
        "isolation_damping_coefficient=1.5",
        "plan_length=\"24 m\"",
        "plan_width=\"16 m\"",
        "plan_eccentricity=\"1.2 m\"",
    ];
    let mut arguments = vec!["--points", "0", "--code", "asce_7_2016"];
    for input in inputs {
        arguments.extend(["--set", input]);
    }
    // A moat of 70 mm is too small, which is an answer.
    let shown = text(&gap("isolated_building", &arguments).stdout);
    assert!(
        shown.contains("TOO SMALL") && !shown.contains("NO ANSWER"),
        "{shown}"
    );
    assert!(shown.contains("decided without the records"), "{shown}");
    assert!(!shown.contains("records at least"), "{shown}");
    arguments.push("--json");
    let code = &json(&gap("isolated_building", &arguments))["gaps"][0]["code"];
    assert_eq!(
        (&code["satisfied"], &code["takes_records"]),
        (&false.into(), &false.into())
    );
    close(&code["cases"][0]["required"], 0.140, 1e-3);
    let mut arguments = BEHAVIOUR.to_vec();
    arguments.extend(["--points", "0", "--code", "asce_7_2016", "--json"]);
    let code = &json(&gap("gap_check", &arguments))["gaps"][0]["code"];
    assert_eq!(
        (&code["satisfied"], &code["takes_records"]),
        (&Value::Null, &true.into())
    );
}

/// Arguments are held to what a case is: a rule stands there once.
#[test]
fn a_provision_is_named_once() {
    let twice = ["--provisions", "nbcc_2015_between", "nbcc_2015_between"];
    let output = gap("gap_check", &twice);
    assert_eq!(output.status.code(), Some(2));
    let told = text(&output.stderr);
    assert!(told.contains("names \"nbcc_2015_between\" twice"), "{told}");
}
