//! Studies that say something wrong.

use super::{Bench, MIXED};

/// Each change of a sound study, and what is said of it.
#[test]
fn errors_point_at_their_place() {
    let bench = Bench::new(MIXED);
    for (from, to, reasons) in [
        (
            "seed = 3",
            "sed = 3",
            vec!["study.toml:", "unknown key `sed`", "did you mean `seed`?"],
        ),
        ("[design]", "[desing]", vec!["did you mean `design`?"]),
        (
            "gap.0.width",
            "gap.0.widht",
            vec!["study.toml:", "unknown key `widht`"],
        ),
        (
            "gap.0.width",
            "gap.light-heavi.width",
            vec!["did you mean `light-heavy`?"],
        ),
        (
            "gap.0.width",
            "gap.7.width",
            vec!["`gap` has 1 entry, counted from 0"],
        ),
        (
            "\"5 mm\"",
            "\"5 kg\"",
            vec!["`width` must be a length (m), but \"5 kg\" is a mass (kg)"],
        ),
        (
            "\"5 mm\"",
            "-0.001",
            vec!["the case refuses this for `gap.0.width`", "zero or more"],
        ),
        ("\"25 t\"", "\"-25 t\"", vec!["must be greater than zero"]),
        (
            "restitution = 0.6 }",
            "restitution = 1.6 }",
            vec!["restitution"],
        ),
        ("\"93.5 MN/m\"", "\"93.5 MN\"", vec!["is a force (N)"]),
        (
            "anagnostopoulos_2004",
            "anagnostopulos_2004",
            vec!["anagnostopoulos_2004"],
        ),
        ("runs = 60", "runs = 0", vec!["whole number from 1 on"]),
        (
            "runs = 60",
            "runs = 3_000_000_000",
            vec!["`runs` = 3_000_000_000 is too large", "from 1 to 100000000"],
        ),
        (
            "runs = 60",
            "runs = 99999999999999999999999",
            vec!["is too large", "from 1 to 100000000"],
        ),
        (
            "to = \"60 mm\"",
            "to = \"60 mm\"\ncount = 1_000_001",
            vec!["`count` = 1_000_001 is too large", "from 2 to 1000000"],
        ),
        (
            "chunk = 4",
            "chunk = 1_000_000_000",
            vec!["`chunk` = 1_000_000_000 is too large", "from 1 to 1000000"],
        ),
        (
            "path = \"building.light.mass\"\nvalues = [\"20 t\", \"25 t\", \"30 t\"]",
            "path = \"building.light.storeys\"\nvalues = [2, 3]",
            vec![
                "`building.light.storeys` cannot vary",
                "study.toml:",
                "a case and a study for each number of storeys",
            ],
        ),
        ("latin_hypercube", "latin", vec!["unknown design \"latin\""]),
        (
            "kind = \"latin_hypercube\"\nruns = 60\nseed = 3",
            "kind = \"grid\"",
            vec!["study.toml:4:1: ", "no `count`, which a grid needs"],
        ),
        (
            "name = \"gap\"",
            "name = \"impacts\"",
            vec!["\"impacts\" cannot name a coordinate"],
        ),
        // A column of tables alone.
        (
            "name = \"gap\"",
            "name = \"diagnosis\"",
            vec!["\"diagnosis\" cannot name a coordinate"],
        ),
        (
            "name = \"gap\"",
            "name = \"model\"",
            vec!["two variables have the name \"model\""],
        ),
        (
            "name = \"gap\"",
            "name = \"model\"\nspacing = \"log\"",
            vec![
                "\"linear\" or \"logarithmic\"",
                "two variables have the name \"model\"",
            ],
        ),
        (
            "case.toml",
            "nowhere.toml",
            vec!["nowhere.toml: cannot read the case"],
        ),
        (
            "from = \"5 mm\"",
            "from = \"5 mm\"\nspacing = \"log\"",
            vec!["\"linear\" or \"logarithmic\""],
        ),
        (
            "to = \"60 mm\"",
            "to = \"5 mm\"",
            vec!["the range is empty"],
        ),
        (
            "\"MOTIONS/kobe_1995_jma_ns.csv\"",
            "{ file = \"MOTIONS/kobe_1995_jma_ns.csv\", across = { file = \"MOTIONS/el_centro_1940_ns.csv\" } }",
            vec![
                "study.toml:19:",
                "has nothing to move",
                "give a building a `plan`",
            ],
        ),
    ] {
        assert!(MIXED.contains(from), "{from}");
        bench.study(&MIXED.replacen(from, to, 1));
        let told = bench.complaint("sweep study.toml", 2);
        for reason in reasons {
            assert!(told.contains(reason), "{to}: {told}");
        }
    }
    let told = bench.complaint("sweep nowhere.toml", 2);
    assert!(
        told.contains("nowhere.toml: cannot read")
            && told.contains("give the path of a study file"),
        "{told}"
    );
    bench.study(MIXED);
    bench.complaint("sweep study.toml -o nowhere/out.h5", 4);
    bench.complaint("ida study.toml", 2);
    let told = bench.complaint("sweep study.toml --show 60", 2);
    assert!(told.contains("runs 0 to 59"), "{told}");
}

/// Counts that would take all memory, each at its place.
#[test]
fn counts_have_limits() {
    let synthetic = |more: &str| {
        format!(
            "[[variable]]\nsynthetic = {{ model = \"rezaeian_der_kiureghian_2010\", duration = \"30 s\", significant_duration = \"12 s\", middle_time = \"8 s\", middle_frequency = \"3.5 1/s\", {more} }}\n"
        )
    };
    let range = |path: &str, count: &str| {
        format!(
            "[[variable]]\npath = \"{path}\"\nfrom = \"10 mm\"\nto = \"20 mm\"\ncount = {count}\n"
        )
    };
    let bench = Bench::new("");
    for (study, reasons) in [
        (
            synthetic("count = 1_000_000_000"),
            ["study.toml:3:", "is too large", "from 1 to 10000"],
        ),
        (
            synthetic("count = 1_000_000_000_000_000_000"),
            ["study.toml:3:", "is too large", "from 1 to 10000"],
        ),
        (
            synthetic("time_step = \"0.1 ms\", count = 10_000"),
            [
                "study.toml:3:",
                "10000 motions of 300001 samples",
                "make fewer motions",
            ],
        ),
        (
            range("gap.0.width", "1000000")
                + &range("building.light.mass", "1000").replace("mm", "t"),
            [
                "the grid has 1000000 x 1000 runs",
                "100000000 at most",
                "make it coarser",
            ],
        ),
        (
            "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\"]\n[ida]\ngaps = { from = \"1 mm\", to = \"1 m\", count = 1_000_000 }\n".to_owned(),
            ["study.toml:", "1000000 widths", "more than 1000"],
        ),
    ] {
        bench.study(&format!("case = \"case.toml\"\n{study}"));
        let told = bench.complaint("sweep study.toml", 2);
        for reason in reasons {
            assert!(told.contains(reason), "{study}: {told}");
        }
    }
}

/// What a run is asked for beside a case that is shown would not be done.
#[test]
fn a_case_that_is_shown_is_not_run() {
    let bench = Bench::new(MIXED);
    for more in [
        "--csv a.csv",
        "--report a.html",
        "-o a.h5",
        "--shard 1/2",
        "--resume",
    ] {
        let told = bench.complaint(&format!("sweep study.toml --show 1 {more}"), 2);
        assert!(told.contains("cannot be used with"), "{told}");
    }
}

/// Two variables of one entry, and what an analysis of intensities asks for.
#[test]
fn contradictions_are_told() {
    let records = "[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n";
    let intensity =
        "[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\"]\n";
    let scale = "[[variable]]\nname = \"scale\"\npath = \"ground_motion.scale\"\nvalues = [2]\n";
    let restitution = "[[variable]]\nname = \"e\"\npath = \"gap.0.restitution\"\nvalues = [0.5]\n";
    let model = "[[variable]]\nname = \"m\"\npath = \"gap.0.model\"\nvalues = [{ model = \"hertz_1882\", stiffness = 1e9 }]\n";
    let step = "[[variable]]\nname = \"dt\"\npath = \"ground_motion.time_step\"\nvalues = [0.02]\n";
    let with_ida = |lines: &str| format!("{records}{intensity}[ida]\n{lines}\n");
    let limit = |lines: &str| {
        with_ida(&format!(
            "[[ida.limit]]\nname = \"x\"\nexceeds = 1\n{lines}"
        ))
    };
    let named = |name: &str| {
        format!("[[ida.limit]]\nname = \"{name}\"\ndemand = \"impacts\"\nlevel = 3\nexceeds = 1")
    };
    let same = "vary the same entry";
    let bench = Bench::new("");
    for (study, reason) in [
        (format!("{scale}{intensity}"), same),
        (
            format!("{restitution}{}", restitution.replace("\"e\"", "\"f\"")),
            same,
        ),
        (format!("{restitution}{model}"), same),
        (
            format!("{records}{step}"),
            "\"dt\" changes the motion of the case, in whose place \"",
        ),
        (
            format!(
                "{records}{}",
                records.replace("records", "name = \"r\"\nrecords")
            ),
            "records are given twice",
        ),
        (
            format!("{records}[ida]\n"),
            "two variables: `records` and `intensity`",
        ),
        (
            intensity.replace("0.2 g", "0.2 m"),
            "must be an acceleration",
        ),
        (
            intensity.replace("peak_ground_acceleration", "pga"),
            "unknown intensity measure",
        ),
        (
            intensity.replace(
                "peak_ground_acceleration\"",
                "spectral_acceleration\"\ndamping = 5",
            ),
            "5 % is 0.05",
        ),
        (
            intensity.replace("values", "period = 1\nvalues"),
            "`period` has no meaning",
        ),
        (
            intensity.replace(
                "peak_ground_acceleration\"",
                "spectral_acceleration\"\nbuilding = \"ligt\"",
            ),
            "no building \"ligt\"",
        ),
        (with_ida("target_frequency = 1e-3"), "needs a hazard curve"),
        (
            with_ida("target_frequency = \"1e-3 Hz\""),
            "plain numbers are in 1/year: write 1e-3, or \"1e-3 1/year\"",
        ),
        (
            with_ida("target_frequency = \"-1e-3 1/year\""),
            "must be greater than zero",
        ),
        (
            with_ida("hazard = [[1, \"1e-2 1/s\"], [2, 1e-3]]"),
            "must be a mean annual frequency (1/year), but \"1e-2 1/s\" is a frequency",
        ),
        (
            with_ida("hazard = [[1, 1e-3], [2, 1e-2]]"),
            "frequencies fall",
        ),
        (with_ida("hazard = \"nowhere.csv\""), "nowhere.csv"),
        (with_ida("confidence = 1.5"), "between 0 and 1"),
        (with_ida("gaps = [\"20 kg\"]"), "must be a length"),
        (
            with_ida("gaps = [\"20 mm\", 0.03, 0.02]"),
            "the width 0.02 m stands twice",
        ),
        (
            with_ida("[[ida.limit]]\nname = \"x\"\ndemand = \"drift\"\nexceeds = 1"),
            "unknown demand",
        ),
        (
            with_ida(
                "[[ida.limit]]\nname = \"x\"\ndemand = \"drift_ratio\"\nstorey = 1\nexceeds = 1",
            ),
            "a storey of which building?",
        ),
        (
            with_ida(
                "[[ida.limit]]\nname = \"x\"\ndemand = \"drift_ratio\"\nbuilding = \"light\"\nstorey = 4\nexceeds = 1",
            ),
            "no storey 4",
        ),
        (
            limit("demand = \"drift_ratio\"\nbuilding = \"light\"\nstorey = [2, 5]"),
            "no storey 5",
        ),
        (
            limit("demand = \"drift_ratio\"\nbuilding = \"light\"\nstorey = []"),
            "`storey` is an empty list",
        ),
        (
            limit("demand = \"ductility\"\nbuilding = \"light\""),
            "these stay linear",
        ),
        (
            limit("demand = \"residual_drift_ratio\""),
            "these stay linear",
        ),
        (limit("demand = \"impacts\"\nlevel = [1, 8]"), "no level 8"),
        (limit("demand = \"impacts\"\nlevel = 7"), "no level 7"),
        (
            limit("demand = \"impacts\"\nlevel = 4"),
            "it has 3 (1 is light-heavy 1-1,",
        ),
        (
            limit("demand = \"drift_ratio\"\nlevel = 2"),
            "it is of storeys, not of a level",
        ),
        (
            limit("demand = \"impacts\"\nbuilding = \"light\"\nstorey = 1"),
            "it has no `building`",
        ),
        (
            limit("demand = \"contact_force\"\nbuilding = \"light\""),
            "name a `level` in its place",
        ),
        (
            limit(&format!("demand = \"impacts\"\n{}", named("x"))),
            "two limits have the name \"x\"",
        ),
        (with_ida(&named(" ")), "the name is empty"),
        (
            limit("demand = \"impacts\"").replace("exceeds = 1", "exceeds = -1"),
            "must be zero or more",
        ),
        (
            with_ida(&named("pounding at the gaps of the case")),
            "the analysis has a state \"pounding at the gaps of the case\" of its own",
        ),
        (
            with_ida(&format!(
                "gaps = [\"20 mm\"]\n{}",
                named("light-heavy 0.02 m")
            )),
            "the analysis has a state \"light-heavy 0.02 m\" of its own",
        ),
    ] {
        bench.study(&format!("case = \"case.toml\"\n{study}"));
        let told = bench.complaint("sweep study.toml", 2);
        assert!(told.contains(reason), "{study}: {told}");
    }
    // Any impact at all is a state; a scale beside records is no record.
    bench.study(&format!(
        "case = \"case.toml\"\n{}",
        limit("demand = \"impacts\"").replace("exceeds = 1", "exceeds = 0")
    ));
    bench.text("sweep study.toml -o any.h5");
    bench.study(&format!("case = \"case.toml\"\n{records}{scale}"));
    bench.text("sweep study.toml -o out.h5");
}

/// A case in the place of a study, and a study in that of a case, are one mistake each; what is
/// wrong with a hazard curve is said once.
#[test]
fn the_other_kind_of_file_leads_to_its_command() {
    let bench =
        Bench::new("case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [1]\n");
    for (command, place, said) in [
        ("sweep case.toml", "case.toml:", "give it to `pounding run`"),
        ("ida case.toml", "case.toml:", "this is a case, not a study"),
        (
            "run study.toml --no-output",
            "study.toml:",
            "`pounding sweep`",
        ),
        (
            "check study.toml",
            "study.toml:",
            "this is a study, not a case",
        ),
    ] {
        let told = bench.complaint(command, 2);
        assert!(told.contains(said) && told.contains(place), "{told}");
        assert!(!told.contains("unknown key"), "{told}");
    }
    bench.study("case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\"]\n[ida]\nhazard = [[1, 1e-3], [2, 1e-2]]\n");
    let told = bench.complaint("ida study.toml", 2);
    assert!(
        told.contains("the hazard curve: point 2: intensities must rise"),
        "{told}"
    );
}

/// Of a hazard curve in a list the point is named and pointed at, as that of a file with its line.
#[test]
fn points_of_a_hazard_list_are_named() {
    let bench = Bench::new(MIXED);
    for (points, column, said) in [
        (
            "[[0.5, 0.3], [1, 0.06], [2, 0.06], [4, 0.002]]",
            34,
            "point 3: intensities must rise and frequencies fall",
        ),
        (
            "[[0.5, 0.3], [0.4, 0.06]]",
            23,
            "point 2: intensities must rise",
        ),
        (
            "[[0.5, 0.3], [1, 1e-200]]",
            23,
            "point 2: intensities and frequencies must be from 1e-100",
        ),
        ("[[0.5, 0.3], [1]]", 23, "point 2: a point is a pair"),
        ("[[0.5, 0.3]]", 10, "it has fewer than two points"),
    ] {
        bench.study(&format!("case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.2 g\"]\n[ida]\nhazard = {points}\n"));
        let told = bench.complaint("ida study.toml", 2);
        assert!(
            told.contains(&format!("the hazard curve: {said}")),
            "{told}"
        );
        assert!(told.contains(&format!("study.toml:8:{column}")), "{told}");
    }
    // The limits of the numbers are those of the schema.
    let schema: serde_json::Value = serde_json::from_str(&bench.text("schema hazard")).unwrap();
    for column in schema["items"]["prefixItems"].as_array().unwrap() {
        assert_eq!(
            (&column["minimum"], &column["maximum"]),
            (&1.0e-100.into(), &1.0e100.into())
        );
    }
}

/// Options that could do nothing are errors, not silence.
#[test]
fn options_without_use_are_refused() {
    let bench = Bench::new(MIXED);
    for call in [
        "ida study.toml --figure-width 90mm",
        "compare case.toml --figure-width 90mm",
        "gap case.toml --figure-width 90mm",
        "run case.toml --no-output --figure-width 90mm",
    ] {
        let told = bench.complaint(call, 2);
        assert!(
            told.contains("--plot <FILE>") || told.contains("--plot <PLOT>"),
            "{call}: {told}"
        );
    }
    for (option, value) in [("--from", "5mm"), ("--to", "5mm"), ("--gap", "light-heavy")] {
        let told = bench.complaint(&format!("gap case.toml --points 0 {option} {value}"), 2);
        let said = format!("without a sweep there is nothing that {option} could say");
        assert!(told.contains(&said), "{told}");
    }
    bench.text("sweep study.toml -o out.h5");
    let told = bench.complaint("report out.h5 --study study.toml -o out.html", 2);
    assert!(
        told.contains("study.toml has no [ida], of which --study makes the page"),
        "{told}"
    );
    assert!(told.contains("leave --study away"), "{told}");
}

/// HDF5 and the cases of a study take names of text alone, which is said before the runs.
#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_refused() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let bench = Bench::new(MIXED);
    let name = |bytes: &[u8]| OsStr::from_bytes(bytes).to_owned();
    let refused = |command: &mut std::process::Command| {
        let output = command.output().unwrap();
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(
            told.contains("not UTF-8") && told.contains("ame it") || told.contains("rename"),
            "{told}"
        );
    };
    for (option, given) in [("-o", name(b"r\xfc.h5")), ("--into", name(b"r\xfc"))] {
        let mut command = bench.command("sweep study.toml --shard 1/2");
        refused(command.arg(option).arg(&given));
        assert!(!bench.folder.path().join(&given).exists());
    }
    let folder = bench.folder.path().join(name(b"n\xfc"));
    std::fs::create_dir(&folder).unwrap();
    for file in ["case.toml", "study.toml"] {
        std::fs::copy(bench.path(file), folder.join(file)).unwrap();
    }
    refused(bench.command("sweep study.toml").current_dir(&folder));
    // The path of the folder belongs to that of a result in it.
    let case = bench.path("case.toml");
    for call in ["run -o out.h5", "run -o out.dat", "run"] {
        let mut command = bench.command(call);
        refused(command.arg(&case).current_dir(&folder));
    }
    let elsewhere = bench.path("out.h5");
    let mut command = bench.command("run");
    command.arg(&case).arg("-o").arg(&elsewhere);
    let output = command.current_dir(&folder).output().unwrap();
    assert!(output.status.success() && elsewhere.exists());
}

/// Storeys of both buildings 3.5 m high are level, where either alone is not: values of a list are
/// tried in their rows.
#[test]
fn rows_of_a_list_hold_together() {
    let study = |heavy: &str, kind: &str| {
        Bench::new(&format!(
            "case = \"case.toml\"\n[[variable]]\npath = \"building.light.height\"\nvalues = [\"3 m\", \"3.5 m\"]\n[[variable]]\npath = \"building.heavy.height\"\nvalues = {heavy}\n[design]\nkind = \"{kind}\"\n"
        ))
    };
    let bench = study("[\"3 m\", \"3.5 m\"]", "list");
    bench.text("sweep study.toml -o out.h5 --csv out.csv");
    let table = String::from_utf8(bench.bytes("out.csv")).unwrap();
    let rows: Vec<&str> = table.lines().filter(|l| l.contains("complete")).collect();
    assert_eq!(rows.len(), 2, "{table}");
    let said = study("[\"3 m\", \"3.6 m\"]", "list").complaint("sweep study.toml -o out.h5", 2);
    for part in [
        "study.toml:4:",
        "the case refuses run 1 of the list (building_light_height = 3.5, building_heavy_height = 3.6)",
        "equal elevation",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    // A grid has rows in which one of them is alone.
    let said = study("[\"3 m\", \"3.5 m\"]", "grid").complaint("sweep study.toml -o out.h5", 2);
    assert!(
        said.contains("refuses this for `building.light.height`"),
        "{said}"
    );
}
