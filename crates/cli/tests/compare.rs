//! `pounding compare`: headline numbers of the example, files, mistakes.
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn compare(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("compare")
        .arg(root().join("examples/three_storey_pair/case.toml"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn quantity<'a>(result: &'a Value, of: &str, name: &str) -> &'a Value {
    let all = result["quantities"].as_array().unwrap();
    all.iter()
        .find(|q| q["of"] == of && q["name"] == name)
        .unwrap_or_else(|| panic!("{of} {name}"))
}

/// All models under both records. The heavy building hardly notices whichever model
/// acts; the spread between records is three times that between models.
#[test]
fn all_models_under_both_records() {
    let output = compare(&["--records", "ground_motions", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let models = result["models"].as_array().unwrap();
    assert!(models.len() >= 35);
    for model in models {
        assert_eq!(
            model["failures"],
            serde_json::json!([]),
            "{}",
            model["name"]
        );
    }
    let spread = |of: &str, name: &str| {
        let spread = &quantity(&result, of, name)["spread"];
        let value = |key: &str| spread[key].as_f64().unwrap();
        (value("between_models"), value("between_records"))
    };
    let (models, records) = spread("light", "displacement");
    assert!((models - 0.195).abs() < 0.01 && (records - 0.68).abs() < 0.01);
    let (models, records) = spread("light", "acceleration_absolute");
    assert!((models - 0.219).abs() < 0.01 && (records - 0.817).abs() < 0.01);
    let (models, _) = spread("heavy", "displacement");
    assert!(models < 0.01, "{models}");
    let conclusions = result["conclusions"].as_array().unwrap();
    let holds = |statement: &str| {
        let found = conclusions.iter().find(|c| c["statement"] == statement);
        found.unwrap_or_else(|| panic!("{statement}"))["holds"].clone()
    };
    let raises = "pounding raises the peak absolute acceleration of light";
    assert_eq!(holds(raises), "holds for all models");
    assert_eq!(
        holds("pounding raises the peak displacement of light"),
        "depends on the model"
    );
}

/// Exact: every model that can be asked returns what the case's law returns.
#[test]
fn calibrated_exactly() {
    let output = compare(&[
        "--models",
        "jankowski_2005,hunt_crossley_1975,anagnostopoulos_2004",
        "--restitution-rule",
        "exact",
        "--restitution",
        "0.65",
        "--json",
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    for model in result["models"].as_array().unwrap() {
        let free = model["gaps"][0]["free_restitution"].as_f64().unwrap();
        assert!((free - 0.65).abs() < 1e-6, "{}: {free}", model["name"]);
    }
}

#[test]
fn tables_and_files() {
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("models.csv");
    let svg = folder.path().join("models.svg");
    let output = compare(&[
        "--models",
        "exact_hunt_crossley,stereomechanical",
        "--csv",
        csv.to_str().unwrap(),
        "--plot",
        svg.to_str().unwrap(),
    ]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    for part in [
        "calibrated alike",
        "Spread",
        "Ranking",
        "Conclusions",
        "(no pounding)",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let table = std::fs::read_to_string(csv).unwrap();
    // Quantities of two buildings and a gap, then six storeys and three levels.
    assert_eq!(table.lines().count(), 1 + 2 * (2 * 4 + 6 + 6 * 4 + 3));
    assert!(table.contains("stereomechanical,el_centro_1940_ns,light-heavy,peak_force,N,NaN"));
    // What has no unit is no formula of a spreadsheet.
    assert!(table.contains("light-heavy,impacts,-,") && !table.contains("'-"));
    assert!(std::fs::read_to_string(svg).unwrap().contains("<svg"));
}

/// A model that cannot be calibrated is told with its reason; alone it leaves nothing.
#[test]
fn models_that_fail() {
    let impossible = ["--restitution", "0.001", "--restitution-rule", "exact"];
    let with = |models: &'static str| {
        let mut arguments = vec!["--models", models];
        arguments.extend(impossible);
        compare(&arguments)
    };
    let two = with("muthukumar_2003,exact_hunt_crossley");
    assert!(two.status.success(), "{}", text(&two.stderr));
    assert!(text(&two.stdout).contains("muthukumar_2003: no restitution returns 0.001"));
    let one = with("muthukumar_2003");
    assert_eq!(one.status.code(), Some(3));
    let unknown = compare(&["--models", "jankowsky_2005"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(text(&unknown.stderr).contains("jankowski_2005"));
}

/// Runs a command on a case file; exit code and JSON.
fn answer(command: &str, case: &Path, more: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg(command)
        .arg(case)
        .args(more)
        .arg("--json")
        .output()
        .unwrap();
    serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text(&output.stderr)))
}

/// The example with storeys that yield under gravity, so that a strong motion overturns the light
/// building, with more of it replaced.
fn example_that_collapses(from: &str, to: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let example = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let law = "height = \"3 m\"\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"110 kN\" }";
    let records = root().join("ground_motions").display().to_string();
    let case = example
        .unwrap()
        .replacen("height = \"3 m\"", law, 1)
        .replace("damping_ratio = 0.35", "restitution = 0.65")
        .replace("../../ground_motions", &records)
        .replace(from, to);
    let file = folder.path().join("case.toml");
    std::fs::write(&file, case).unwrap();
    (folder, file)
}

/// One of two records overturns a building without contact, whatever the model: the other one is compared
/// as by itself.
#[test]
fn a_record_that_overturns_a_building_is_left_out() {
    let (folder, file) = example_that_collapses("", "");
    let motions = root().join("ground_motions");
    let motion = |name: &str| motions.join(name).display().to_string();
    let (standing, falling) = (
        motion("el_centro_1940_ns.csv"),
        motion("kobe_1995_jma_ns.csv"),
    );
    let models = "jankowski_2005,hertz_1882";
    let alone = answer(
        "compare",
        &file,
        &["--models", models, "--records", &standing],
    );
    let page = folder.path().join("page.html").display().to_string();
    let both = ["--models", models, "--records", &falling, &standing];
    let found = answer(
        "compare",
        &file,
        &[&both[..], &["--report", &page]].concat(),
    );
    assert_eq!(found["records"], serde_json::json!(["el_centro_1940_ns"]));
    let collapsed = &found["collapsed"];
    assert_eq!(collapsed.as_array().map(Vec::len), Some(1));
    assert_eq!(collapsed[0]["name"], "kobe_1995_jma_ns");
    assert_eq!(collapsed[0]["building"], "light");
    for key in [
        "references",
        "models",
        "quantities",
        "gaps",
        "conclusions",
        "differences_from_gap",
    ] {
        assert_eq!(found[key], alone[key], "{key}");
    }
    let page = std::fs::read_to_string(page).unwrap();
    assert!(
        page.contains("<strong>light collapses without contact</strong> under kobe_1995_jma_ns")
    );
    let call = |records: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .arg("compare")
            .arg(&file)
            .args(records)
            .output();
        output.unwrap()
    };
    let shown = text(&call(&both).stdout);
    assert!(
        shown.contains("Collapse without contact under 1 of 2 records, whatever the model;"),
        "{shown}"
    );
    // Under it alone there is nothing to compare.
    let output = call(&both[..4]);
    assert_eq!(output.status.code(), Some(3), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("light collapsed at t = "));
}

/// One model of two overturns the building: the conclusions say so, and are those of the other.
#[test]
fn a_model_that_brings_a_building_to_collapse_is_named() {
    let (folder, file) = example_that_collapses("[ground_motion]", "[ground_motion]\nscale = 1.25");
    let page = folder.path().join("page.html");
    let models = ["--models", "jankowski_2005,gharib_hurmuzlu_2012,hertz_1882"];
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("compare")
        .arg(&file)
        .args(models)
        .arg("--report")
        .arg(&page)
        .output()
        .unwrap();
    let shown = text(&output.stdout);
    let conclusions = shown.split_once("\nConclusions\n").unwrap().1;
    assert!(
        conclusions.starts_with(
            "  pounding brings light to collapse: with gharib_hurmuzlu_2012 under el_centro_1940_ns"
        ),
        "{conclusions}"
    );
    assert!(
        conclusions.contains("holds for all other models"),
        "{shown}"
    );
    assert!(!conclusions.contains("for all models"), "{shown}");
    let found = answer("compare", &file, &models);
    let models = found["models"].as_array().unwrap();
    let fallen = models
        .iter()
        .filter(|m| m["failures"][0]["collapsed"] == "light");
    let names: Vec<_> = fallen.map(|m| m["name"].clone()).collect();
    assert_eq!(names, ["gharib_hurmuzlu_2012"]);
    let page = std::fs::read_to_string(page).unwrap();
    assert!(page.contains(
        "<strong>Pounding brings a building to collapse with gharib_hurmuzlu_2012</strong>: 1 of 3 models."
    ));
}

/// Seven motions of which one does not close the gap: it has no force, and the spread and
/// order of forces are those of the other six, exactly. Counts and energy of that record are
/// zero.
#[test]
fn a_record_without_contact_is_left_out_of_the_spread_of_force() {
    let suite = root()
        .join("examples/synthetic_suite")
        .canonicalize()
        .unwrap();
    let motions: Vec<String> = (1..=7)
        .map(|i| suite.join(format!("motion_{i}.csv")).display().to_string())
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let with_width = |width: &str| {
        let case = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
        let own = root().join("ground_motions").canonicalize().unwrap();
        let case = case.unwrap().replace("\"20 mm\"", width);
        let case = case.replace("../../ground_motions", own.to_str().unwrap());
        std::fs::write(&file, case).unwrap();
    };
    let under = |motions: &[&String], more: &[&'static str]| -> Vec<String> {
        let records = motions.iter().map(|m| (*m).clone());
        let start = more.iter().map(|m| (*m).to_owned());
        start
            .chain(["--records".to_owned()])
            .chain(records)
            .collect()
    };
    let call = |command: &str, arguments: &[String]| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        answer(command, &file, &arguments)
    };
    with_width("\"20 mm\"");
    let all: Vec<&String> = motions.iter().collect();
    let check = call("gap", &under(&all, &["--points", "0"]));
    let demand: Vec<f64> = check["gaps"][0]["demand"]
        .as_array()
        .unwrap()
        .iter()
        .map(|d| d.as_f64().unwrap())
        .collect();
    let mut sorted = demand.clone();
    sorted.sort_by(f64::total_cmp);
    with_width(&format!("{}", 0.5 * (sorted[0] + sorted[1])));
    let without = demand.iter().position(|d| *d == sorted[0]).unwrap();
    let six: Vec<&String> = (0..7)
        .filter(|i| *i != without)
        .map(|i| &motions[i])
        .collect();
    let models = "--models=jankowski_2005,anagnostopoulos_2004,linear_elastic";
    let seven = call("compare", &under(&all, &[models]));
    let six = call("compare", &under(&six, &[models]));
    let name = format!("motion_{}", without + 1);
    let gap = &seven["gaps"][0];
    assert_eq!(gap["records_without_contact"], serde_json::json!([name]));
    assert_eq!(gap["models_in_contact"][without], 0);
    for kind in [
        "peak_force",
        "impulse",
        "approach_velocity",
        "achieved_restitution",
    ] {
        let (of_seven, of_six) = (
            quantity(&seven, "light-heavy", kind),
            quantity(&six, "light-heavy", kind),
        );
        assert_eq!(of_seven["ranking"], of_six["ranking"], "{kind}");
        for key in [
            "between_models",
            "between_records",
            "greatest_ratio",
            "records",
        ] {
            assert_eq!(
                of_seven["spread"][key], of_six["spread"][key],
                "{kind} {key}"
            );
        }
        assert_eq!(of_seven["spread"]["records"], 6);
        assert_eq!(of_seven["spread"]["records_left_out"], 1);
        assert!(of_seven["values"][0][without].is_null(), "{kind}");
        assert!(!of_seven["ranking"]["models"].as_array().unwrap().is_empty());
    }
    // Nor do its buildings, which move there as they do without pounding.
    for kind in ["displacement", "acceleration_absolute"] {
        let (of_seven, of_six) = (
            quantity(&seven, "light", kind),
            quantity(&six, "light", kind),
        );
        assert_eq!(of_seven["ranking"], of_six["ranking"], "{kind}");
        for key in ["between_models", "greatest_ratio", "records"] {
            let (of_seven, of_six) = (&of_seven["spread"][key], &of_six["spread"][key]);
            assert_eq!(of_seven, of_six, "{kind} {key}");
        }
        assert_eq!(of_seven["spread"]["records_left_out"], 1);
        let isolated = &of_seven["isolated"][without];
        assert_eq!(&of_seven["values"][0][without], isolated, "{kind}");
    }
    for building in seven["buildings"].as_array().unwrap() {
        assert_eq!(
            building["records_without_contact"],
            serde_json::json!([name])
        );
    }
    for kind in ["impacts", "impact_energy"] {
        let values = &quantity(&seven, "light-heavy", kind)["values"];
        assert_eq!(values[0][without], 0.0, "{kind}");
    }
    let mut arguments = under(&all, &[models]);
    arguments.insert(0, file.display().to_string());
    arguments.insert(0, "compare".to_owned());
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .args(arguments)
        .output()
        .unwrap();
    let shown = text(&output.stdout);
    let said = "light-heavy: no contact with any model under 1 of 7 records";
    assert!(shown.contains(said) && shown.contains("6 of 7"), "{shown}");
    let said = "light, heavy: reached by no contact with any model under 1 of 7 records";
    assert!(shown.contains(said), "{shown}");
}

/// A row of three, of which the right gap never closes: nothing reaches the right building, unless a link
/// joins it with its neighbour, which is hit.
#[test]
fn contacts_reach_buildings_beside_them_and_those_linked_to_these() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let records = root().join("ground_motions").display().to_string();
    let example = std::fs::read_to_string(root().join("examples/three_storey_pair/case.toml"));
    let example = example.unwrap().replace("../../ground_motions", &records);
    let (buildings, rest) = example.split_once("[[gap]]").unwrap();
    let third = "[[building]]\nname = \"third\"\nstoreys = 3\nmass = \"1000 t\"\nstiffness = \"2000 MN/m\"\nheight = \"3 m\"\ndamping = { stiffness_proportional = 0.05 }\n";
    let wide = "[[gap]]\nbetween = [\"heavy\", \"third\"]\nwidth = \"5 m\"\nmodel = \"exact_hunt_crossley\"\nstiffness = \"2.75e9 N/m^1.5\"\nrestitution = 0.65\n";
    let link = "[[link]]\nbetween = [\"heavy\", \"third\"]\nmodel = \"linear\"\nstiffness = \"100 MN/m\"\n";
    for (links, reached) in [("", 0), (link, 1)] {
        let case = format!("{buildings}{third}\n[[gap]]{rest}\n{wide}\n{links}");
        std::fs::write(&file, case).unwrap();
        let models = ["--models", "anagnostopoulos_2004,linear_elastic"];
        let found = answer("compare", &file, &models);
        let records = |of: &str| quantity(&found, of, "displacement")["spread"]["records"].clone();
        assert_eq!([records("light"), records("heavy")], [1, 1]);
        assert_eq!(records("third"), reached, "{links}");
        let order = &quantity(&found, "third", "displacement")["ranking"];
        let same = order["maximum_by"].as_array().unwrap().is_empty();
        assert_eq!(same, reached == 0, "{order}");
    }
}

/// At 20 mm pounding lowers the maximum over the storeys of the light building's
/// displacement, that of its roof, and raises that of its first storey: the comparison says
/// both, with the number of `gap`, in the table, the object and the file.
#[test]
fn storeys_that_answer_otherwise_are_reported() {
    let case = root().join("examples/three_storey_pair/case.toml");
    let check = answer("gap", &case, &["--points", "0"]);
    let folder = tempfile::tempdir().unwrap();
    let csv = folder.path().join("models.csv");
    let models = ["--models", "jankowski_2005,anagnostopoulos_2004"];
    let mut arguments = models.to_vec();
    arguments.extend(["--csv", csv.to_str().unwrap()]);
    let result = answer("compare", &case, &arguments);
    let conclusions = result["conclusions"].as_array().unwrap();
    let raised = conclusions
        .iter()
        .find(|c| c["statement"] == "pounding raises the peak displacement of light")
        .unwrap();
    assert_eq!(raised["statistic"], "maximum over storeys");
    assert_eq!(raised["counts"][0], serde_json::json!([0, 2]));
    assert_eq!(raised["by_storey"]["counts"][0], serde_json::json!([2, 2]));
    let storeys = result["differences_from_gap"]["storeys"]
        .as_array()
        .unwrap();
    let found = |building: &str, storey: usize, kind: &str| {
        storeys
            .iter()
            .find(|d| d["building"] == building && d["storey"] == storey && d["quantity"] == kind)
    };
    let first = found("light", 1, "displacement").unwrap();
    let both = serde_json::json!(["jankowski_2005", "anagnostopoulos_2004"]);
    assert_eq!(first["models"][0], both);
    assert_eq!(first["own_law"]["differs"][0], true);
    let own = first["own_law"]["amplification_at_storey"][0]
        .as_f64()
        .unwrap();
    // What the page says of both.
    let of_maxima = &first["own_law"]["ratio_of_maxima"][0];
    let of_maxima = of_maxima.as_f64().unwrap();
    // How far apart the two models are: the case's own law is the first of them.
    let ratios = |judgement: &Value| {
        let of_record = judgement["ratios"][0].as_array().unwrap();
        [0, 1].map(|end| of_record[end].as_f64().unwrap())
    };
    let [least, most] = ratios(raised);
    assert!(least < most && most < 1.0, "{least} {most}");
    assert!([least, most].contains(&of_maxima), "{of_maxima}");
    let [least, most] = ratios(&raised["by_storey"]);
    assert!(1.0 < least && least < most, "{least} {most}");
    assert!([least, most].contains(&own), "{own}");
    let page = std::fs::read_to_string(root().join("docs/reference/model-comparison.md")).unwrap();
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let said = format!(
        "first storey to {own:.3} of its displacement and the roof, where the maximum is, to {of_maxima:.3}."
    );
    assert!(
        own > 1.0 && of_maxima < 1.0 && page.contains(&said),
        "{said}"
    );
    // Every storey at which `gap` answers differently is there, with the number of `gap`:
    // where its storeys do not agree with each other, some must differ from the maximum.
    let raises = |x: &Value| x.as_f64().unwrap() > 1.0 + 1e-6;
    for (b, building) in ["light", "heavy"].iter().enumerate() {
        for kind in ["displacement", "storey_shear", "acceleration_absolute"] {
            let of_gap = |s: usize| &check["records"][0]["amplification"][b][s][kind];
            let maxima = (1..=3).find_map(|s| found(building, s, kind));
            let maxima = maxima.map(|d| &d["own_law"]["ratio_of_maxima"][0]);
            let Some(maxima) = maxima else {
                let first = raises(of_gap(0));
                assert!(
                    (1..3).all(|s| raises(of_gap(s)) == first),
                    "{building} {kind}"
                );
                continue;
            };
            for s in 0..3 {
                let differs = raises(of_gap(s)) != raises(maxima);
                let Some(d) = found(building, s + 1, kind) else {
                    assert!(!differs, "{building} {kind}: storey {}", s + 1);
                    continue;
                };
                assert_eq!(d["own_law"]["amplification_at_storey"][0], *of_gap(s));
                assert_eq!(d["own_law"]["differs"][0], differs);
            }
        }
    }
    let table = std::fs::read_to_string(&csv).unwrap();
    let row = |model: &str| {
        let start = format!("{model},el_centro_1940_ns,light,displacement,m,");
        let rows = table.lines().filter(|l| l.starts_with(&start));
        rows.map(str::to_owned).collect::<Vec<_>>()
    };
    let rows = row("jankowski_2005");
    assert_eq!(rows.len(), 4, "the maximum and three storeys");
    assert!(rows[0].ends_with(",maximum over storeys,,"), "{rows:?}");
    assert!(
        rows[1].ends_with(",peak of the storey,storey 1,true"),
        "{rows:?}"
    );
    assert!(
        rows[3].ends_with(",peak of the storey,storey 3,false"),
        "{rows:?}"
    );
    let shown = text(&compare(&models).stdout);
    for part in [
        "pounding raises the peak displacement of light (maximum over storeys): fails for all models",
        "storey by storey, as `pounding gap` answers: holds for all models",
        "Storeys where `pounding gap` answers differently",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
}

/// Values that are found for one gap alone are said with its name, and so is a gap that nothing
/// touches, whose reference collision is that of others.
#[test]
fn what_is_of_one_gap_names_it() {
    let run = |case: &Path| {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .arg("compare")
            .arg(case)
            .args(["--models", "adams_impact"])
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    };
    let example = root().join("examples/row_of_five/case.toml");
    let shown = run(&example);
    for gap in ["R1-R2", "R4-R5"] {
        assert!(
            shown.contains(&format!("adams_impact, gap {gap}: damping = ")),
            "{shown}"
        );
    }
    assert!(!shown.contains("nothing touches it"), "{shown}");
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(example).unwrap();
    let case = case.replace(
        "../../ground_motions",
        root().join("ground_motions").to_str().unwrap(),
    );
    let at = case.rfind("width = ").unwrap();
    let end = at + case[at..].find('\n').unwrap();
    let wide = format!("{}width = \"3 m\"{}", &case[..at], &case[end..]);
    let file = folder.path().join("case.toml");
    std::fs::write(&file, wide).unwrap();
    let shown = run(&file);
    assert!(
        shown.contains("gap R4-R5: nothing touches it with the own law"),
        "{shown}"
    );
}

/// Rigid impacts have no accelerations: alone they say nothing of them, and what none of the models can say holds for
/// none.
#[test]
fn what_no_model_can_say() {
    let output = compare(&["--models", "stereomechanical", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let conclusions = result["conclusions"].as_array().unwrap();
    let (of_accelerations, others): (Vec<&Value>, Vec<&Value>) = conclusions
        .iter()
        .partition(|c| c["statement"].as_str().unwrap().contains("acceleration"));
    assert_eq!(of_accelerations.len(), 3);
    for conclusion in of_accelerations {
        assert_eq!(conclusion["holds"], "no model can say");
        assert_eq!(conclusion["counts"], serde_json::json!([[0, 0]]));
    }
    assert!(others.iter().all(|c| c["holds"] != "no model can say"));
    // Where no model ran, no record is one without contact.
    let output = compare(&[
        "--models",
        "lapshin_yurin_2016",
        "--restitution",
        "1",
        "--restitution-rule",
        "exact",
        "--json",
    ]);
    assert_eq!(output.status.code(), Some(3));
    let result: Value = serde_json::from_slice(&output.stdout).unwrap();
    let conclusions = result["conclusions"].as_array().unwrap();
    assert!(conclusions.iter().all(|c| c["holds"] == "no model can say"));
    let none = serde_json::json!([]);
    assert_eq!(result["gaps"][0]["records_without_contact"], none);
    assert_eq!(result["buildings"][0]["records_without_contact"], none);
}

/// A law that returns nothing has no restitution that others could be asked for.
#[test]
fn a_law_that_returns_nothing() {
    let place = tempfile::tempdir().unwrap();
    let example = root().join("examples/three_storey_pair/case.toml");
    let case = std::fs::read_to_string(example).unwrap();
    let gap = case.find("model = ").unwrap();
    let after = case[gap..].find("\n\n").unwrap();
    let motions = root().join("ground_motions").canonicalize().unwrap();
    let case = format!(
        "{}model = \"borovin_2014\"\nstiffness = 1e9\nfriction = 1.5\n{}",
        &case[..gap],
        case[gap + after..].replace("../../ground_motions", motions.to_str().unwrap())
    );
    let file = place.path().join("case.toml");
    std::fs::write(&file, case).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
        .arg("compare")
        .arg(file)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = text(&output.stderr).replace(['│', '\n'], " ");
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        said.contains("returns nothing in the reference collision"),
        "{said}"
    );
    assert!(said.contains("give --restitution"), "{said}");
}
