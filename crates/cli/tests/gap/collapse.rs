//! Buildings that a record or pounding brings to collapse.

use super::{close, example_that_collapses, gap_in, json, root, text};

/// One of two records overturns a building without contact: it has no demand, and is in contact
/// whatever the width; the other one is answered as by itself.
#[test]
fn a_record_that_overturns_a_building_fits_no_gap() {
    let folder = example_that_collapses("\"200 mm\"");
    let motions = root().join("ground_motions");
    let motion = |name: &str| motions.join(name).display().to_string();
    let both = [
        "--records",
        &motion("el_centro_1940_ns.csv"),
        &motion("kobe_1995_jma_ns.csv"),
    ];
    let call = |records: &[&str], others: &[&str]| {
        gap_in(
            folder.path(),
            &[records, &["--points", "3"], others].concat(),
        )
    };
    let alone = json(&call(&both[..2], &["--json"]));
    let alone = &alone["gaps"][0];
    assert_eq!(alone["adequate"], true, "{alone}");

    let output = call(
        &both,
        &["--json", "--report", "page.html", "-o", "answer.json"],
    );
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let found = json(&output);
    let gap = &found["gaps"][0];
    assert_eq!(found["records"].as_array().map(Vec::len), Some(1));
    assert_eq!(found["records"][0]["name"], "el_centro_1940_ns");
    let collapsed = &found["collapsed"][0];
    assert_eq!(found["collapsed"].as_array().map(Vec::len), Some(1));
    assert_eq!(collapsed["name"], "kobe_1995_jma_ns");
    assert_eq!(collapsed["building"], "light");
    let time = collapsed["time"].as_f64().unwrap();
    let diagnosis = collapsed["diagnosis"].as_str().unwrap();
    assert!(
        time > 0.0 && diagnosis.starts_with("light collapsed at t = "),
        "{collapsed}"
    );
    assert_eq!(
        (&gap["adequate"], &found["adequate"]),
        (&false.into(), &false.into())
    );
    assert_eq!(gap["records_in_contact"], 1);
    assert!(gap["required"]["by_count"].is_null() && gap["governing"].is_null());
    // One of two seen, as Clopper and Pearson bound it.
    let bounds = &gap["contact_probability_bounds"];
    close(&bounds[0], 1.0 - 0.95_f64.sqrt(), 1e-9);
    close(&bounds[1], 0.95_f64.sqrt(), 1e-9);
    for key in ["demand", "suite", "levels", "combinations"] {
        assert_eq!(gap[key], alone[key], "{key}");
    }
    assert_eq!(found["spectra"]["records"][1], "kobe_1995_jma_ns");
    assert_eq!(
        found["spectra"]["pseudo_acceleration"]
            .as_array()
            .map(Vec::len),
        Some(2)
    );
    assert_eq!(found["sweep"]["runs"][0].as_array().map(Vec::len), Some(1));
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    for said in [
        "<strong>light collapses without contact</strong> under kobe_1995_jma_ns: light collapsed at t = ",
        "1 of 2 records close it, of which 1 counts as such because a building collapses without contact; none may (probability of contact ",
        "No width is enough: under 1 record a building collapses without contact.",
        "is too small",
    ] {
        assert!(page.contains(said), "{said}");
    }

    let shown = text(&call(&both, &[]).stdout);
    let shown = shown.split_whitespace().collect::<Vec<_>>().join(" ");
    for said in [
        "Collapse without contact under 1 of 2 records, which no gap is wide enough for",
        &format!("kobe_1995_jma_ns: {diagnosis}"),
        "TOO SMALL - 1 of 2 records close it, 0 allowed",
        "no width is required by count: 0 of 2 records may touch, and under 1 a building collapses without contact",
    ] {
        assert!(shown.contains(said), "{said}\n{shown}");
    }

    // Where one of two may touch it is that one.
    let half = call(&both, &["--probability", "0.5", "--json"]);
    assert_eq!(half.status.code(), Some(0), "{}", text(&half.stderr));
    let half = json(&half)["gaps"][0].clone();
    assert_eq!(half["required"]["by_count"], alone["required"]["by_count"]);
    assert_eq!(half["governing"], alone["governing"]);
    assert!(half["required"]["lognormal"].is_null(), "{half}");

    // A code has no statistic of displacements without end.
    let by_code = call(
        &both,
        &["--code", "eurocode_8", "--probability", "0.5", "--json"],
    );
    assert_eq!(by_code.status.code(), Some(1));
    assert!(json(&by_code)["gaps"][0]["code"]["satisfied"].is_null());

    // Shards agree, whoever makes them.
    for shard in ["1/2", "2/2"] {
        let output = call(&both, &["--shard", shard, "--into", "parts"]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    }
    assert_eq!(json(&call(&both, &["--merge", "parts", "--json"])), found);
}

/// Where all records overturn a building there is no demand, and no answer.
#[test]
fn records_that_all_overturn_a_building_leave_no_answer() {
    let folder = example_that_collapses("\"200 mm\"");
    let kobe = root().join("ground_motions/kobe_1995_jma_ns.csv");
    std::fs::copy(&kobe, folder.path().join("other.csv")).unwrap();
    let kobe = kobe.display().to_string();
    for (records, said) in [
        (vec!["--records", &kobe], "record kobe_1995_jma_ns"),
        (
            vec!["--records", &kobe, "other.csv"],
            "under all 2 records a building collapses without contact; record kobe_1995_jma_ns",
        ),
    ] {
        let output = gap_in(folder.path(), &[&records[..], &["--points", "0"]].concat());
        assert_eq!(output.status.code(), Some(3));
        let errors = text(&output.stderr);
        let errors = errors.replace('\u{2502}', " ");
        let errors = errors.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            errors.contains(said) && errors.contains("light collapsed at t ="),
            "{errors}"
        );
    }
}

/// Storeys that yield under gravity: pounding overturns the building at some widths, at which
/// nothing is said of ratios of peaks, and which are the worst.
#[test]
fn widths_at_which_a_building_collapses_are_the_worst() {
    let folder = example_that_collapses("\"20 mm\"");
    let file = folder.path().join("case.toml");
    let case = std::fs::read_to_string(&file).unwrap();
    let case = case.replace("[ground_motion]", "[ground_motion]\nscale = 1.2");
    std::fs::write(&file, case).unwrap();
    let sweep = ["--points", "3", "--from", "5 mm", "--to", "65 mm"];
    let shown = text(&gap_in(folder.path(), &sweep).stdout);
    assert!(shown.contains("to collapse"), "{shown}");
    let worst = shown.lines().find(|l| l.starts_with("light: worst at "));
    assert!(
        worst
            .unwrap()
            .ends_with("where pounding brings it to collapse")
    );
    assert!(shown.contains("pounding brings light to collapse: light collapsed at t = "));
    assert!(shown.contains("light: otherwise "), "{shown}");
    assert!(
        shown.contains("|       5.00 |            collapse |"),
        "{shown}"
    );
    assert!(!shown.contains("of the sweep failed"), "{shown}");
    let mut arguments = sweep.to_vec();
    arguments.extend(["--json", "--report", "page.html"]);
    let found = json(&gap_in(folder.path(), &arguments));
    assert_eq!(found["records"][0]["collapsed"], "light");
    assert_eq!(found["sweep"]["runs"][0][0]["collapsed"], "light");
    let page = std::fs::read_to_string(folder.path().join("page.html")).unwrap();
    assert!(page.contains("<strong>Pounding brings light to collapse</strong> at "));
    assert!(page.contains("<strong>Pounding brings light to collapse</strong> under el_centro"));
    // Nothing is known of the impacts of a run without an end.
    assert!(found["records"][0]["impacts"].is_null());
    let (_, records) = page
        .split_once("data-from=\"sum /records/*/impacts/+/+\"")
        .unwrap();
    let (row, _) = records.split_once("</tbody>").unwrap();
    assert!(row.contains("<td>\u{2013}</td></tr>"), "{row}");
}
