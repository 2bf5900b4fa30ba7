//! `pounding verify structures`: every case is printed, exit codes, numbers that users enter.
use std::path::Path;

use serde_json::Value;

use crate::support;

fn json(arguments: &str) -> Value {
    serde_json::from_str(&support::text("verify", &format!("{arguments} --json"))).unwrap()
}

#[test]
fn every_case_is_printed_and_comes_out_as_said() {
    let shown = support::text("verify", "structures");
    for part in [
        "single_storey_linear_elastic",
        "single_storey_kelvin_voigt",
        "single_storey_hertzdamp_ye_li_zhu",
        "single_storey_jankowski",
        "single_storey_bilinear",
        "three_storey_hertzdamp",
        "yielding_hertzdamp",
        "yielding_jankowski",
        "SDND101",
        "SDND102f",
        "SDND108a",
        "SDND108b",
        "SDND122a",
        "BouncingBallED",
        "Ten beads",
        "ElastoGap",
        "VM65",
        "Chung and Ooi",
        "menegotto_pinto_1973",
        "jankowski_2008",
        "nees_2008_0571",
        "needs data",
        "reproduced at their step",
        "their error",
        "everything that is said to reproduce does",
    ] {
        assert!(shown.contains(part), "\"{part}\" is not in: {shown}");
    }
    let result = json("structures");
    assert_eq!(result["holds"], true);
    let parts = result["parts"].as_array().unwrap();
    let sources: Vec<_> = parts
        .iter()
        .map(|p| p["source"].as_str().unwrap())
        .collect();
    assert_eq!(
        sources,
        [
            "opensees",
            "code_aster",
            "siconos",
            "modelica",
            "ansys",
            "chung_ooi",
            "laws",
            "entered"
        ]
    );
    // One of each: theirs and ours in full.
    let line = &parts[1]["comparisons"][0]["lines"][1];
    assert_eq!(line["theirs"], 9950.0);
    assert!((line["ours"].as_f64().unwrap() - 9_950.272_843).abs() < 1e-5);
    assert_eq!(line["verdict"], "reproduced");
    let one = json("structures --source siconos");
    assert_eq!(one["parts"].as_array().unwrap().len(), 1);
}

/// The template with a first number entered.
fn entered(folder: &Path, published: &str) -> String {
    let template = support::text("verify", "structures --template");
    let filled = template.replacen(
        "published = \"\"",
        &format!("published = \"{published}\""),
        1,
    );
    let file = folder.join("published.toml");
    std::fs::write(&file, filled).unwrap();
    file.display().to_string()
}

#[test]
fn numbers_that_users_enter_are_compared() {
    let folder = tempfile::tempdir().unwrap();
    let result = json("structures --source entered");
    let ours = &result["parts"][0]["comparisons"][0]["lines"][0]["ours"];
    let ours = ours.as_f64().unwrap();
    let near = entered(folder.path(), &format!("{} mm", 1.04e3 * ours));
    let result = json(&format!("structures --data {near}"));
    let parts = result["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 1);
    let line = &parts[0]["comparisons"][0]["lines"][0];
    assert_eq!(line["verdict"], "reproduced");
    assert!((line["difference"].as_f64().unwrap() + 0.038_46).abs() < 1e-4);
    let far = entered(folder.path(), &format!("{} mm", 1.2e3 * ours));
    let output = support::run("verify", &format!("structures --data {far}"));
    assert_eq!(output.status.code(), Some(1));
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.contains("1 do not come out as said"), "{shown}");
    // Beside a source that is named, too.
    let output = support::run("verify", &format!("structures --data {far} --source laws"));
    assert_eq!(output.status.code(), Some(1));
    let shown = String::from_utf8(output.stdout).unwrap();
    assert!(shown.contains("1 do not come out as said"), "{shown}");
}

/// An entry with a case of the user's, beside the data file.
#[test]
fn a_case_of_the_user_is_run() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("../verification/cases");
    let case = std::fs::read_to_string(cases.join("ansys/vm65.toml")).unwrap();
    write("vm65.toml", &case.replace("../at_rest.csv", "rest.csv"));
    std::fs::copy(cases.join("at_rest.csv"), folder.path().join("rest.csv")).unwrap();
    let data = |case: &str, gap: &str| {
        format!(
            "[[entry]]\nname = \"vm65\"\nsource = \"Ansys\"\ncase = \"{case}\"\n[[entry.value]]\nquantity = \"first_contact\"\nof = \"{gap}\"\nstorey = 1\npublished = \"71.982 ms\"\ntolerance = \"0.001 %\"\n"
        )
    };
    let call = format!(
        "structures --data {}",
        folder.path().join("d.toml").display()
    );
    write("d.toml", &data("vm65.toml", "wall-ball"));
    let result = json(&call);
    let line = &result["parts"][0]["comparisons"][0]["lines"][0];
    assert_eq!(line["verdict"], "reproduced");
    for (text, message) in [
        (data("vm65.toml", "left-right"), "no gap \"left-right\""),
        (data("none.toml", "wall-ball"), "none.toml"),
        (
            data("vm65.toml", "wall-ball").replace("71.982 ms", "71 kN"),
            "line 9",
        ),
        ("[[entry]\n".to_owned(), "line 1"),
    ] {
        write("d.toml", &text);
        let output = support::run("verify", &call);
        let errors = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{errors}");
        assert!(errors.contains(message), "{message} is not in: {errors}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn bad_arguments_are_refused() {
    for arguments in [
        "structures --source abaqus",
        "structures --data no.toml",
        "structures --template --json",
    ] {
        let output = support::run("verify", arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments}");
        assert!(output.stdout.is_empty());
    }
}

/// The counts of docs/theory/credibility.md are those of the registries.
#[test]
fn counts_of_the_credibility_page() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/theory/credibility.md");
    let page = std::fs::read_to_string(page).unwrap();
    let row = |name: &str, all: Vec<&str>| {
        let count = |status: &str| all.iter().filter(|s| **s == status).count();
        let row = format!(
            "| {name}: {} | {} | {} | {} |",
            all.len(),
            count("verified"),
            count("secondary sources"),
            count("unverified")
        );
        assert!(page.contains(&row), "the row must read: {row}");
    };
    let models = pounding_gap_element::registry::descriptors();
    row(
        "impact models",
        models.iter().map(|d| d.verification.name()).collect(),
    );
    let laws = pounding_hysteresis::descriptors();
    row(
        "laws of storeys and links",
        laws.iter().map(|d| d.verification.name()).collect(),
    );
}

/// What nobody has entered is not counted as compared.
#[test]
fn without_numbers_nothing_is_said_to_reproduce() {
    let said = support::text("verify", "structures --source entered");
    let end = "0 lines compared; 6 lines without their numbers; nothing is said to reproduce.";
    assert!(said.trim_end().ends_with(end), "{said}");
}
