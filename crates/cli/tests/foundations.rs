//! Buildings on foundations that sway and rock, on the command line.
#![allow(clippy::print_stdout)]

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde_json::Value;

use crate::support::Bench;

/// What two independent codes say of the pair, which agree to 1e-12; the file says of which.
#[derive(Deserialize)]
struct File {
    reference: Reference,
}

#[derive(Deserialize)]
struct Reference {
    outputs: BTreeMap<String, Output>,
    contacts: Vec<Contact>,
    energy: BTreeMap<String, f64>,
}

#[derive(Deserialize)]
struct Output {
    peak: f64,
    time: f64,
}

#[derive(Deserialize)]
struct Contact {
    impacts: u64,
    first_contact: f64,
    peak_force: f64,
}

fn reference() -> Reference {
    let text = include_str!("../../../tests/data/structures/ssi_sway_rocking_pair.json");
    serde_json::from_str::<File>(text).unwrap().reference
}

/// The pair by springs and dashpots, as the reference has them.
fn by_springs() -> String {
    let building = |name: &str, mass: f64, stiffness: &str, foundation: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nmass = {:?}\nstiffness = {stiffness}\nheight = [3.2, 3.2, 3.2]\ndamping = {{ ratio = 0.05, modes = [1, 2] }}\n[building.foundation]\n{foundation}\n",
            [mass; 3]
        )
    };
    let a = building(
        "A",
        1.0e5,
        "[60000000.0, 55000000.0, 50000000.0]",
        "mass = 150000.0\nrotational_inertia = 5400000.0\nsway = { stiffness = 1891460781.5571823, dashpot = 46656000.0 }\nrocking = { stiffness = 74567887107.42413, dashpot = 1111480093.6993349 }",
    );
    let b = building(
        "B",
        1.8e5,
        "[350000000.0, 320000000.0, 300000000.0]",
        "mass = 250000.0\nrotational_inertia = 14812500.0\nsway = { stiffness = 2114717442.16837, dashpot = 58320000.0 }\nrocking = { stiffness = 123196782816.98497, dashpot = 2170859558.0065136 }",
    );
    format!(
        "{a}{b}[[gap]]\nbetween = [\"A\", \"B\"]\nwidth = 0.025\nmodel = \"anagnostopoulos_2004\"\nstiffness = 200000000.0\nrestitution = 0.65\n[ground_motion]\nfile = \"MOTIONS/el_centro_1940_ns.csv\"\n[analysis]\nduration = 25\n"
    )
}

/// The pair by its soil, from the example.
fn by_soil() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/soil_pair/case.toml");
    let text = std::fs::read_to_string(path).unwrap();
    text.replace("../../ground_motions", "MOTIONS")
}

/// The largest relative error of all that the reference says of a run.
fn largest_error(told: &Value) -> f64 {
    let reference = reference();
    let mut worst = 0.0_f64;
    let mut compared = 0;
    for name in ["A", "B"] {
        let building = &told["buildings"][usize::from(name == "B")];
        let mut near = |found: &Value, expected: &str, factor: f64| {
            let expected = &reference.outputs[&expected.replace('#', name)];
            let value = found["peak"].as_f64().unwrap() * factor;
            worst = worst.max((value / expected.peak - 1.0).abs());
            // The value is flat around its peak.
            let off = (found["time"].as_f64().unwrap() - expected.time).abs();
            assert!(off < 2e-3, "{off:e} s");
            compared += 1;
        };
        for floor in 0..3 {
            let storey = &building["storeys"][floor];
            let n = floor + 1;
            near(&storey["displacement"], &format!("U_#{n}"), 1.0);
            near(&storey["drift_ratio"], &format!("storey_drift_#{n}"), 3.2);
            near(&storey["acceleration_absolute"], &format!("a_#{n}"), 1.0);
        }
        near(&building["storeys"][0]["storey_shear"], "base_shear_#", 1.0);
        let response = |name: &str| {
            let responses = building["responses"].as_array().unwrap();
            responses
                .iter()
                .find(|r| r["name"] == name)
                .unwrap()
                .clone()
        };
        for (ours, theirs) in [
            ("foundation_sway", "foundation_sway_#"),
            ("foundation_rotation", "foundation_rotation_#"),
            ("foundation_shear", "foundation_spring_force_#"),
            ("foundation_moment", "foundation_spring_moment_#"),
        ] {
            near(&response(ours), theirs, 1.0);
        }
    }
    assert_eq!(compared, reference.outputs.len());
    let levels = told["gaps"][0]["levels"].as_array().unwrap();
    for (level, expected) in levels.iter().zip(&reference.contacts) {
        assert_eq!(level["impacts"].as_u64(), Some(expected.impacts));
        let force = level["peak_force"]["peak"].as_f64().unwrap();
        worst = worst.max((force / expected.peak_force - 1.0).abs());
        let first = level["first_contact"].as_f64().unwrap();
        worst = worst.max((first - expected.first_contact).abs());
    }
    let input = reference.energy["input"];
    for part in ["input", "kinetic", "strain", "viscous", "impact"] {
        let found = told["energy"][part].as_f64().unwrap();
        worst = worst.max((found - reference.energy[part]).abs() / input);
    }
    worst
}

#[test]
fn two_exact_methods_agree_with_two_independent_codes() {
    let adaptive = "duration = 25\nmethod = \"adaptive\"\nrelative_tolerance = 1e-11";
    for case in [
        by_springs(),
        by_springs().replace("duration = 25", adaptive),
        by_soil(),
    ] {
        let bench = Bench::with(&case);
        let error = largest_error(&bench.json("run case.toml --no-output"));
        assert!(error < 1e-8, "{error:e}");
    }
}

/// Fixed steps approach the reference with the square of their length.
#[test]
fn newmark_converges() {
    let error = |step: &str| {
        let method = format!("duration = 6\nmethod = \"newmark\"\nstep = \"{step}\"");
        let bench = Bench::with(&by_springs().replace("duration = 25", &method));
        let told = bench.json("run case.toml --no-output");
        let roof = &told["buildings"][0]["storeys"][2]["displacement"]["peak"];
        let expected = reference().outputs["U_A3"].peak;
        (roof.as_f64().unwrap() / expected - 1.0).abs()
    };
    let [coarse, fine] = ["0.4 ms", "0.1 ms"].map(error);
    println!("{coarse:e} {fine:e}");
    assert!(coarse < 1e-3 && fine < coarse / 4.0, "{coarse:e} {fine:e}");
}

/// The roots of `det(s^2 M + s C + K)` nearest to the first mode without damping, by the secant
/// method on the matrices of the reference, apart from the program.
#[test]
fn check_tells_the_first_mode_of_building_and_soil() {
    let bench = Bench::with(&by_soil());
    let told = bench.json("check case.toml");
    for (b, period, damping, fixed) in [
        (
            0,
            0.602_688_838_326_779_3,
            0.050_894_786_699_064_6,
            0.591_695_538_080_479_4,
        ),
        (
            1,
            0.352_433_613_564_793_5,
            0.067_311_076_031_368_1,
            0.328_257_788_345_479_4,
        ),
    ] {
        let found = &told["buildings"][b]["foundation"];
        let near = |name: &str, expected: f64| {
            let value = found[name].as_f64().unwrap();
            assert!((value / expected - 1.0).abs() < 1e-9, "{name}: {value}");
        };
        near("period", period);
        near("damping_ratio", damping);
        near("fixed_base_period", fixed);
        near("period_lengthening", period / fixed);
        near("fixed_base_damping_ratio", 0.05);
    }
    let near = |name: &str, expected: f64| {
        let value = told["buildings"][0]["foundation"][name].as_f64().unwrap();
        assert!((value / expected - 1.0).abs() < 1e-12, "{name}: {value}");
    };
    near("moment_of_uplift", 450.0e3 * 9.80665 * 2.0);
    near("overturning_moment", 450.0e3 * 9.80665 * 6.0);
    near("length", 12.0);
    let rocking = &told["buildings"][0]["foundation"]["rocking"];
    let stiffness = rocking["stiffness"].as_f64().unwrap();
    assert!((stiffness / 74_567_887_107.424_13 - 1.0).abs() < 1e-12);
    // Sway and rotation have modes of their own; effective masses sum to all that moves along.
    let masses = told["buildings"][0]["effective_mass"].as_array().unwrap();
    let sum: f64 = masses.iter().map(|m| m.as_f64().unwrap()).sum();
    assert!(masses.len() == 5 && (sum / 450.0e3 - 1.0).abs() < 1e-12);
    let shown = bench.text("check case.toml");
    for words in [
        "period 0.6027 s, 1.0186 times that on a fixed base (0.5917 s); damping 5.09 % (5.00 % on a fixed base)",
        "lifts off from a moment of some 8826.0 kN m on, a sixth of weight times length",
        "the most that the weight holds is half of weight times length, 26478.0 kN m",
        "rocking 5.40000e6 kg m2, 7.45679e10 N m/rad",
    ] {
        assert!(shown.contains(words), "{shown}");
    }
}

/// The same numbers in the object, the table, the file and the page, and the warning where the
/// foundation lifts off.
#[test]
fn run_shows_and_keeps_responses_of_foundations() {
    let strong = by_soil().replace("_ns.csv\"", "_ns.csv\"\nscale = 2.2");
    assert_ne!(strong, by_soil());
    let bench = Bench::with(&strong);
    let told = bench.json("run case.toml -o case.h5");
    let shown = bench.text("run case.toml -o case.h5");
    bench.text("report case.h5");
    let page = bench.read("case.html");
    let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
    let mut seen = 0;
    for building in told["buildings"].as_array().unwrap() {
        let name = building["name"].as_str().unwrap();
        for (responses, prefix) in [("responses", ""), ("isolated_responses", "isolated_")] {
            for response in building[responses].as_array().unwrap() {
                let own = response["name"].as_str().unwrap();
                let peak = response["peak"].as_f64().unwrap();
                let path = format!("building/{name}/peak/response/{prefix}{own}");
                let stored: f64 = file.dataset(&path).unwrap().read_scalar().unwrap();
                assert!((stored / peak - 1.0).abs() < 1e-14, "{path}");
                let words = own.replace('_', " ");
                assert!(shown.contains(&words) && page.contains(&words), "{words}");
                seen += 1;
            }
        }
        // The moment over half of weight times length, at every instant.
        let history = |own: &str| {
            let path = format!("building/{name}/response/{own}");
            file.dataset(&path).unwrap().read_1d::<f64>().unwrap()
        };
        let (moment, ratio) = (history("foundation_moment"), history("overturning_ratio"));
        let mass = if name == "A" { 450.0e3 } else { 790.0e3 };
        let length = if name == "A" { 12.0 } else { 15.0 };
        let lifts = 0.5 * mass * 9.80665 * length;
        let off = moment.iter().zip(&ratio).map(|(m, r)| m / lifts - r);
        assert!(off.fold(0.0, |a: f64, x| a.max(x.abs())) < 1e-12);
    }
    assert_eq!(seen, 2 * 2 * 5);
    let warnings = told["warnings"].as_array().unwrap();
    let lifts: Vec<_> = warnings
        .iter()
        .filter(|w| w.as_str().unwrap().contains("its edge lifts off the soil"))
        .collect();
    assert_eq!(lifts.len(), 2, "{warnings:?}");
    // Half of what overturns it: the edge lifts off all the same, from a third of that on.
    let as_recorded = Bench::with(&by_soil()).json("run case.toml --no-output");
    let warnings = as_recorded["warnings"].to_string();
    assert_eq!(
        warnings
            .matches("from a third of it on the soil is pulled at")
            .count(),
        2,
        "{warnings}"
    );
    let mild = by_soil().replace("_ns.csv\"", "_ns.csv\"\nscale = 0.5");
    let mild = Bench::with(&mild).json("run case.toml --no-output");
    assert_eq!(mild["warnings"], serde_json::json!([]));
}

/// On a foundation that does not rock the ratio is of the moment at the base; a law that never yields changes nothing in it.
#[test]
fn the_overturning_ratio_of_storeys_with_laws_is_that_of_elastic_ones() {
    let bench = Bench::with(&by_soil());
    let ratio = |law: &str| {
        bench.write(
            "sway.toml",
            &format!(
                "[[building]]\nname = \"low\"\nstoreys = 3\nmass = \"90 t\"\nstiffness = \"90 MN/m\"\nheight = \"3.2 m\"\ndamping = {{ ratio = 0.05, modes = [1, 3] }}\n{law}\n[building.foundation]\nmass = \"120 t\"\nsway = {{ stiffness = \"500 MN/m\", dashpot = \"1 MN s/m\" }}\nlength = \"12 m\"\n[ground_motion]\nfile = \"MOTIONS/el_centro_1940_ns.csv\"\n[analysis]\nduration = \"10 s\"\n"
            ),
        );
        let told = bench.json("run sway.toml --no-output");
        let responses = told["buildings"][0]["responses"].as_array().unwrap();
        let found = responses.iter().find(|r| r["name"] == "overturning_ratio");
        found.unwrap()["peak"].as_f64().unwrap()
    };
    let elastic = ratio("");
    // Base moment of 16,248 kN m over 390 t times g times 6 m.
    assert!((elastic / 0.708 - 1.0).abs() < 1e-3, "{elastic}");
    let with_law =
        ratio("law = { model = \"bilinear\", yield_force = \"550 MN\", hardening_ratio = 0.05 }");
    assert!(
        (with_law / elastic - 1.0).abs() < 1e-6,
        "{with_law} {elastic}"
    );
}

/// The double difference combination takes of both buildings the mode on the soil that `check` names, with the damping of the
/// soil: its correlation is the formula (Jeng, Kasai and Maison 1992, Earthquake Spectra 8, 201) of these.
#[test]
fn the_correlation_on_soil_is_that_of_the_modes_of_check() {
    let bench = Bench::with(&by_soil());
    let checked = bench.json("check case.toml");
    let [a, b] = [0, 1].map(|k| {
        let soil = &checked["buildings"][k]["foundation"];
        ["period", "damping_ratio"].map(|of| soil[of].as_f64().unwrap())
    });
    let ([ta, xa], [tb, xb]) = (a, b);
    let r = tb / ta;
    let expected = 8.0 * (xa * xb).sqrt() * (xb + xa * r) * r.powf(1.5)
        / ((1.0 - r * r).powi(2)
            + 4.0 * r * xa * xb * (1.0 + r * r)
            + 4.0 * (xa * xa + xb * xb) * r * r);
    let output = bench.output("gap case.toml --points 0 --json");
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let rules = told["gaps"][0]["combinations"].as_array().unwrap();
    let found = rules.iter().find(|r| r["rule"] == "double_difference");
    let correlation = found.unwrap()["correlation"].as_f64().unwrap();
    assert!(
        (correlation / expected - 1.0).abs() < 1e-12,
        "{correlation} {expected}"
    );
}

/// Both buildings with storeys that yield.
fn yielding(analysis: &str) -> String {
    let with_law = |building: &str, force: &str| {
        let law = format!(
            "law = {{ model = \"bilinear\", yield_force = \"{force}\", hardening_ratio = 0.05 }}\ndamping"
        );
        building.replacen("damping", &law, 1)
    };
    let case = by_soil().replace("[analysis]\n", &format!("[analysis]\n{analysis}"));
    let (first, second) = case.split_once("name = \"B\"").unwrap();
    let [first, second] = [with_law(first, "400 kN"), with_law(second, "1.6 MN")];
    format!("{first}name = \"B\"{second}")
}

/// Storeys yield on soil: the base moment of every instant is that of the shears, no peak lies below the
/// history beside it, and `check` and `gap` say what yields.
#[test]
fn storeys_yield_on_soil() {
    let bench = Bench::with(&yielding(""));
    let checked = bench.text("check case.toml");
    let yields = checked.matches("law bilinear, yields at a drift of");
    assert_eq!(yields.count(), 6, "{checked}");
    for method in [
        "",
        "method = \"adaptive\"\n",
        "method = \"newmark\"\nstep = \"1 ms\"\n",
    ] {
        let bench = Bench::with(&yielding(&format!("output_step = \"1 ms\"\n{method}")));
        let told = bench.json("run case.toml -o case.h5");
        assert!(told["energy"]["residual_ratio"].as_f64().unwrap() < 1e-3);
        assert!(told["energy"]["hysteretic"].as_f64().unwrap() > 0.0);
        let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
        for name in ["A", "B"] {
            let history = |own: &str| {
                let path = format!("building/{name}/{own}");
                file.dataset(&path).unwrap().read_dyn::<f64>().unwrap()
            };
            let peak = |own: &str| {
                let path = format!("building/{name}/peak/{own}");
                file.dataset(&path).unwrap().read_dyn::<f64>().unwrap()
            };
            let (shears, moments) = (history("storey_shear"), history("base_moment"));
            let largest = moments.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            let height = 3.2;
            for (row, moment) in shears.outer_iter().zip(&moments) {
                assert!((height * row.sum() - moment).abs() < 1e-12 * largest);
            }
            let bound = peak("base_moment").sum();
            assert!(largest <= bound * (1.0 + 1e-12) && largest > 0.99 * bound);
            for (storey, column) in shears.columns().into_iter().enumerate() {
                let largest = column.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
                let bound = peak("storey_shear")[storey];
                assert!(largest <= bound * (1.0 + 1e-12) && largest > 0.98 * bound);
            }
        }
    }
    let shown = String::from_utf8(bench.output("gap case.toml --points 0").stdout).unwrap();
    assert!(
        shown.contains("count sway and rotation of the foundation"),
        "{shown}"
    );
    // Those of codes that hold for elastic displacements.
    assert!(shown.contains("not judged: elastic only"), "{shown}");
}

/// With contacts, with velocity jumps, and under a motion that comes later below one of the buildings.
#[test]
fn both_methods_agree_where_storeys_yield_on_soil() {
    let jumps = |case: String| {
        let contact = "model = \"anagnostopoulos_2004\"\nstiffness = \"200 MN/m\"";
        case.replace(contact, "model = \"stereomechanical\"")
    };
    let later = |case: String| {
        let ground = "name = \"B\"\nground = { delay = \"0.13 s\" }";
        case.replace("name = \"B\"", ground)
    };
    let as_it_is = |case: String| case;
    for change in [as_it_is, jumps, later] {
        let adaptive = "method = \"adaptive\"\nrelative_tolerance = 1e-11\n";
        let told = ["", adaptive].map(|method| {
            let bench = Bench::with(&change(yielding(method)));
            bench.json("run case.toml --no-output")
        });
        let peaks = told.each_ref().map(|told| {
            assert!(told["energy"]["residual_ratio"].as_f64().unwrap() < 1e-9);
            let mut peaks = Vec::new();
            for building in told["buildings"].as_array().unwrap() {
                for storey in building["storeys"].as_array().unwrap() {
                    peaks.extend(storey.as_object().unwrap().values().cloned());
                }
                peaks.push(building["base_moment"].clone());
                peaks.extend(building["responses"].as_array().unwrap().iter().cloned());
            }
            let peaks = peaks.iter().map(|p| p["peak"].as_f64().unwrap());
            peaks.collect::<Vec<_>>()
        });
        assert_eq!(peaks[0].len(), 2 * (3 * 4 + 1 + 5));
        for (a, b) in peaks[0].iter().zip(&peaks[1]) {
            assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        }
        let impacts = told.each_ref().map(|told| {
            let levels = told["gaps"][0]["levels"].as_array().unwrap();
            levels
                .iter()
                .map(|l| l["impacts"].as_u64())
                .collect::<Vec<_>>()
        });
        assert_eq!(impacts[0], impacts[1]);
    }
}

/// Floors move with the foundation: what `gap` demands holds it, and it says so.
#[test]
fn the_demand_counts_the_foundations() {
    let bench = Bench::with(&by_soil());
    let output = bench.output("gap case.toml --points 0");
    assert_eq!(output.status.code(), Some(1), "they touch");
    let shown = String::from_utf8(output.stdout).unwrap();
    let counts = "displacements of A, B count sway and rotation of the foundation, in demand and in widths by rule";
    assert!(shown.contains(counts), "{shown}");
    assert!(shown.contains(
        "warning: the foundation of A bears up to 0.56 of the moment that would overturn it"
    ));
    let output = bench.output("gap case.toml --points 0 --json");
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let demand = told["gaps"][0]["required"]["by_count"].as_f64().unwrap();
    // A gap that wide stays open, one that is a hair narrower closes.
    for (factor, impacts) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 1)] {
        let width = format!("width = {}", demand * factor);
        let bench = Bench::with(&by_soil().replace("width = \"25 mm\"", &width));
        let told = bench.json("run case.toml --no-output");
        assert_eq!(told["gaps"][0]["levels"][2]["impacts"], impacts, "{width}");
    }
}

#[test]
fn comparisons_and_studies_take_responses_of_foundations() {
    let bench = Bench::with(&by_soil().replace("\"25 s\"", "\"6 s\""));
    let told = bench.json("compare case.toml --models=linear_elastic,jankowski_2005");
    let run = bench.json("run case.toml --no-output");
    let quantities = told["quantities"].as_array().unwrap();
    let named = |name: &str| quantities.iter().filter(|q| q["name"] == name).count();
    for name in ["foundation_sway", "foundation_moment", "overturning_ratio"] {
        assert_eq!(named(name), 2, "{name}");
    }
    let shown = bench.text("compare case.toml --models=linear_elastic,jankowski_2005");
    assert!(shown.contains("A foundation rotation (mrad)"), "{shown}");

    // The soil varies; every run has the peaks of a run by itself.
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\nname = \"soil\"\npath = \"building.A.foundation.soil.shear_wave_speed\"\nvalues = [120, \"180 m/s\"]\n",
    );
    bench.text("sweep study.toml -o study.h5 --csv study.csv");
    let table = bench.read("study.csv");
    let rows: Vec<Vec<&str>> = table.lines().map(|l| l.split(',').collect()).collect();
    let column = |heading: &str| {
        let found = rows[0].iter().position(|c| c.trim_matches('"') == heading);
        found.unwrap_or_else(|| panic!("{heading}: {:?}", rows[0]))
    };
    assert_eq!(rows[2][column("soil [m s-1]")], "180.0");
    let responses = run["buildings"][0]["responses"].as_array().unwrap();
    for (name, unit) in [
        ("foundation_sway", "m"),
        ("foundation_rotation", "rad"),
        ("foundation_shear", "N"),
        ("foundation_moment", "N m"),
        ("overturning_ratio", "1"),
    ] {
        let of = |b: &str| format!("peak_{name}: {b} [{unit}]").replace(" [1]", "");
        let found: f64 = rows[2][column(&of("A"))].parse().unwrap();
        let alone = responses.iter().find(|r| r["name"] == name).unwrap();
        let alone = alone["peak"].as_f64().unwrap();
        assert!(
            (found / alone - 1.0).abs() < 1e-12,
            "{name}: {found} {alone}"
        );
        // Softer soil: more motion of the foundation.
        if unit == "m" || unit == "rad" {
            let soft: f64 = rows[1][column(&of("A"))].parse().unwrap();
            assert!(soft > 1.5 * found, "{name}: {soft} {found}");
        }
        assert!(rows[1][column(&of("B"))].parse::<f64>().unwrap() > 0.0);
    }
    let again = bench.text("sweep study.toml -o study.h5 --resume");
    assert!(!again.is_empty());

    let ida = |limit: &str| {
        bench.write("ida.toml", &format!(
            "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"1 m/s^2\", \"3 m/s^2\", \"6 m/s^2\"]\n[ida]\n[[ida.limit]]\nname = \"state\"\n{limit}\n"
        ));
    };
    // Some 0.18 mrad and half of the overturning moment under 3.1 m/s2.
    for (limit, expected) in [
        (
            "demand = \"foundation_rotation\"\nbuilding = \"A\"\nexceeds = 1.5e-4",
            [0, 1, 1],
        ),
        ("demand = \"overturning_ratio\"\nexceeds = 0.8", [0, 0, 1]),
        (
            "demand = \"foundation_moment\"\nbuilding = \"A\"\nexceeds = \"20 MN m\"",
            [0, 0, 1],
        ),
        (
            "demand = \"foundation_sway\"\nexceeds = \"1 mm\"",
            [0, 1, 1],
        ),
        (
            "demand = \"foundation_shear\"\nbuilding = \"B\"\nexceeds = \"3 MN\"",
            [0, 1, 1],
        ),
        ("demand = \"base_moment\"\nexceeds = \"20 MN m\"", [0, 1, 1]),
    ] {
        ida(limit);
        let told = bench.json("ida ida.toml -o ida.h5");
        let states = told["limits"].as_array().unwrap();
        let state = states.iter().find(|s| s["name"] == "state").unwrap();
        let counts = state["counts"].as_array().unwrap().iter();
        let reached: Vec<u64> = counts.map(|c| c["reached"].as_u64().unwrap()).collect();
        assert_eq!(reached, expected, "{limit}");
    }
    for (limit, word) in [
        (
            "demand = \"foundation_rotation\"\nbuilding = \"A\"\nstorey = 1\nexceeds = 1",
            "of a building, not of a storey",
        ),
        (
            "demand = \"foundation_rotation\"\nexceeds = \"2 m\"",
            "a pure number",
        ),
    ] {
        ida(limit);
        bench.refused("ida ida.toml -o ida.h5", &[word]);
    }
    let sways = by_springs().replace("rotational_inertia = 5400000.0\n", "");
    let rocking = "rocking = { stiffness = 74567887107.42413, dashpot = 1111480093.6993349 }";
    bench.write("case.toml", &sways.replace(rocking, ""));
    for (demand, words) in [
        (
            "foundation_rotation",
            "known of buildings with a foundation that rocks only",
        ),
        (
            "overturning_ratio",
            "with a foundation whose length is known only",
        ),
    ] {
        ida(&format!(
            "demand = \"{demand}\"\nbuilding = \"A\"\nexceeds = 1"
        ));
        bench.refused("ida ida.toml -o ida.h5", &[words]);
    }
}

/// Two equal buildings far apart, let go in opposite directions: a spring between their
/// foundations acts on each as one of twice its stiffness between foundation and ground.
#[test]
fn a_link_between_foundations_is_a_spring_of_each() {
    let building = |name: &str, start: &str, foundation: &str| {
        format!(
            "[[building]]\nname = \"{name}\"\nstoreys = 2\nmass = \"100 t\"\nstiffness = \"50 MN/m\"\nheight = 3\ndamping = {{ modal = 0.05 }}\ninitial_displacement = [\"{start}10 mm\", \"{start}20 mm\"]\n[building.foundation]\nmass = \"150 t\"\nrotational_inertia = \"3000 t m2\"\n{foundation}\n"
        )
    };
    let case = |foundation: &str, link: &str| {
        let (a, b) = (
            building("a", "-", foundation),
            building("b", "", foundation),
        );
        let rest = "[[gap]]\nbetween = [\"a\", \"b\"]\nwidth = \"200 mm\"\nmodel = \"linear_elastic\"\nstiffness = 1e8\n[ground_motion]\nfile = \"rest.csv\"\n[analysis]\nduration = 2\n";
        let bench = Bench::with(&format!("{a}{b}{link}{rest}"));
        bench.write("rest.csv", "time_s,acceleration_g\n0,0\n1,0\n2,0\n3,0\n");
        bench.json("run case.toml --no-output")
    };
    let springs = |sway: f64, rocking: f64| {
        format!(
            "sway = {{ stiffness = {sway:e}, dashpot = 1e6 }}\nrocking = {{ stiffness = {rocking:e}, dashpot = 1e7 }}"
        )
    };
    let peaks = |told: &Value| -> Vec<f64> {
        let mut peaks = Vec::new();
        for building in told["buildings"].as_array().unwrap() {
            let mut responses = building["responses"].as_array().unwrap().iter();
            for name in ["foundation_sway", "foundation_rotation"] {
                let found = responses.clone().find(|r| r["name"] == name).unwrap();
                peaks.push(found["peak"].as_f64().unwrap());
            }
            assert!(responses.next().is_some());
            let roof = &building["storeys"][1];
            peaks.push(roof["acceleration_absolute"]["peak"].as_f64().unwrap());
            peaks.push(roof["drift_ratio"]["peak"].as_f64().unwrap());
        }
        peaks
    };
    let without = peaks(&case(&springs(3e8, 2e9), ""));
    for (motion, unit, stiffer, joins) in [
        ("sway", "1e8", springs(5e8, 2e9), "foundation_sway"),
        (
            "rocking",
            "\"1 GN m/rad\"",
            springs(3e8, 4e9),
            "foundation_rotation",
        ),
    ] {
        let link = format!(
            "[[link]]\nbetween = [\"a\", \"b\"]\nfoundations = \"{motion}\"\nmodel = \"linear\"\nstiffness = {unit}\n"
        );
        let told = case(&springs(3e8, 2e9), &link);
        assert_eq!(told["links"][0]["joins"], joins);
        let label = match motion {
            "sway" => "sway of foundations",
            _ => "rotation of foundations",
        };
        assert_eq!(told["links"][0]["levels"][0]["level"], label);
        let (joined, stiff) = (peaks(&told), peaks(&case(&stiffer, "")));
        for (joined, stiff) in joined.iter().zip(&stiff) {
            assert!(
                (joined / stiff - 1.0).abs() < 1e-9,
                "{motion}: {joined} {stiff}"
            );
        }
        // Without it the foundations move otherwise.
        let changed = joined[..2]
            .iter()
            .zip(&without)
            .map(|(a, b)| (a / b - 1.0).abs());
        assert!(changed.fold(f64::INFINITY, f64::min) > 1e-3, "{motion}");
        let deformation = told["links"][0]["levels"][0]["deformation"]["peak"].as_f64();
        let own = joined[usize::from(motion == "rocking")];
        assert!((deformation.unwrap() / (2.0 * own) - 1.0).abs() < 1e-9);
    }
}

/// Angles and moments stand in tables, file and page as such.
#[test]
fn a_link_between_rotations_has_units_of_its_own() {
    let link = "[[link]]\nname = \"soil\"\nbetween = [\"A\", \"B\"]\nfoundations = \"rocking\"\nmodel = \"bilinear\"\nstiffness = \"5 GN m/rad\"\nyield_force = \"1 MN m\"\n";
    let case = by_soil().replace("\"25 s\"", "\"6 s\"");
    let delayed = format!("{case}{link}").replacen(
        "name = \"B\"",
        "name = \"B\"\nground = { delay = \"0.13 s\" }",
        1,
    );
    let bench = Bench::with(&format!("{case}{link}"));
    let understood = bench.text("check case.toml");
    for words in [
        "rotation of foundations",
        "initial stiffness (N m/rad)",
        "yields at (mrad)",
        "0.200",
    ] {
        assert!(understood.contains(words), "{understood}");
    }
    // Of studies the peaks of links are forces and displacements, which it has not.
    bench.write(
        "study.toml",
        "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [0.02, 0.03]\n",
    );
    bench.text("sweep study.toml -o study.h5");
    let study = hdf5::File::open(bench.folder().join("study.h5")).unwrap();
    assert!(study.link_exists("link_level") && !study.link_exists("peak_link_force"));
    let limited = "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [2, 4]\n[ida]\n[[ida.limit]]\nname = \"A\"\ndemand = \"link_force\"\nexceeds = 1\n";
    bench.write("study.toml", &format!("{limited}link = \"soil\"\n"));
    bench.refused(
        "ida study.toml -o ida.h5",
        &["study.toml:12:8", "by a moment"],
    );
    // Beside one between displacements it has no value, and is shown of neither.
    let sway = link.replace("soil", "base").replace("rocking", "sway");
    let sway = sway
        .replace("5 GN m/rad", "5 MN/m")
        .replace("1 MN m", "1 MN");
    bench.write("case.toml", &format!("{case}{link}{sway}"));
    bench.write("study.toml", limited);
    let told = bench.text("ida study.toml -o ida.h5");
    assert!(told.contains("peak_link_force: base"), "{told}");
    assert!(!told.contains("peak_link_force: soil"), "{told}");
    let study = hdf5::File::open(bench.folder().join("ida.h5")).unwrap();
    let forces = study.dataset("peak_link_force").unwrap().read_raw::<f64>();
    let forces = forces.unwrap();
    assert!(
        forces.len() == 4 && forces.chunks(2).all(|run| run[0].is_nan() && run[1] > 0.0),
        "{forces:?}"
    );
    bench.write("case.toml", &format!("{case}{link}"));
    let shown = bench.text("run case.toml -o case.h5");
    let link = shown.split("\nLink soil (bilinear)").nth(1).unwrap();
    for words in [
        "deformation (mrad)",
        "moment (kN m)",
        "rotation of foundations",
    ] {
        assert!(link.contains(words), "{link}");
    }
    bench.text("report case.h5");
    let page = bench.read("case.html");
    for words in [
        "peak deformation (mrad)",
        "peak moment (kN m)",
        "rotation of foundations",
    ] {
        assert!(page.contains(words), "{words}");
    }
    let file = hdf5::File::open(bench.folder().join("case.h5")).unwrap();
    for (name, unit) in [
        ("deformation", "rad"),
        ("force", "N m"),
        ("peak/deformation", "rad"),
        ("peak/force", "N m"),
        ("energy_dissipated", "J"),
    ] {
        let data = file.dataset(&format!("link/soil/{name}")).unwrap();
        let units = data.attr("units").unwrap();
        let units: hdf5::types::VarLenUnicode = units.read_scalar().unwrap();
        assert_eq!(units.as_str(), unit, "{name}");
    }
    // The rotation of the right foundation less that of the left: also where the ground moves
    // otherwise under one of them, which turns nothing.
    bench.write("delayed.toml", &delayed);
    bench.text("run delayed.toml -o delayed.h5");
    for name in ["case.h5", "delayed.h5"] {
        let file = hdf5::File::open(bench.folder().join(name)).unwrap();
        let history = |name: &str| file.dataset(name).unwrap().read_1d::<f64>().unwrap();
        let [left, right] =
            ["A", "B"].map(|b| history(&format!("building/{b}/response/foundation_rotation")));
        let deformation = file.dataset("link/soil/deformation").unwrap();
        let deformation = deformation.read_2d::<f64>().unwrap();
        for ((l, r), d) in left.iter().zip(&right).zip(deformation.column(0)) {
            assert!((r - l - d).abs() < 1e-15, "{name}: {r} - {l} is not {d}");
        }
        assert!(left.iter().any(|l| l.abs() > 1e-5), "{name}");
    }
}

/// Springs far stiffer than the building leave the building on a fixed base.
#[test]
fn a_stiff_soil_is_a_fixed_base() {
    let case = by_springs();
    let (mut fixed, mut stiff) = (String::new(), String::new());
    for line in case.lines() {
        let key = line.split(' ').next().unwrap_or_default();
        let line = format!("{line}\n");
        match key {
            "[building.foundation]" => stiff.push_str(&line),
            // Heavy foundations vibrate slowly, and need fewer steps.
            "rotational_inertia" => stiff.push_str("rotational_inertia = 5e7\n"),
            "sway" => stiff.push_str("sway = { stiffness = 1.5e15 }\n"),
            "rocking" => stiff.push_str("rocking = { stiffness = 1.5e17 }\n"),
            _ if line.starts_with("mass = 150000") || line.starts_with("mass = 250000") => {
                stiff.push_str("mass = 1e6\n");
            }
            _ => {
                stiff.push_str(&line);
                fixed.push_str(&line);
            }
        }
    }
    let run = |case: &str| {
        let case = case.replace("duration = 25", "duration = 1.5");
        let case = case.replace("width = 0.025", "width = 0.005");
        Bench::with(&case).json("run case.toml --no-output")
    };
    let (fixed, stiff) = (run(&fixed), run(&stiff));
    let near = |a: &Value, b: &Value| {
        let (a, b) = (a.as_f64().unwrap(), b.as_f64().unwrap());
        assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    };
    for building in 0..2 {
        for storey in 0..3 {
            let of = |told: &Value, name: &str| {
                told["buildings"][building]["storeys"][storey][name]["peak"].clone()
            };
            for name in [
                "displacement",
                "drift_ratio",
                "storey_shear",
                "acceleration_absolute",
            ] {
                near(&of(&stiff, name), &of(&fixed, name));
            }
        }
    }
    let mut met = 0;
    for level in 0..3 {
        let of = |told: &Value| told["gaps"][0]["levels"][level].clone();
        let (stiff, fixed) = (of(&stiff), of(&fixed));
        assert_eq!(stiff["impacts"], fixed["impacts"]);
        if fixed["impacts"] == 0 {
            continue;
        }
        met += 1;
        near(&stiff["peak_force"]["peak"], &fixed["peak_force"]["peak"]);
        near(&stiff["first_contact"], &fixed["first_contact"]);
    }
    assert!(met > 0);
}

/// Rigid storeys on a rocking spring turn as one pendulum, which the mass of the foundation
/// has no part in.
#[test]
fn rigid_storeys_that_rock_are_a_pendulum() {
    let case = "[[building]]\nname = \"a\"\nmass = [\"30 t\", \"20 t\"]\nstiffness = 2e13\nheight = [3, 4]\ndamping = { modal = 0 }\n[building.foundation]\nrotational_inertia = 1e5\nrocking = { stiffness = 2e8, dashpot = 1e6 }\n[[gap]]\nbetween = [\"a\", \"wall\"]\nwidth = 1\nmodel = \"linear_elastic\"\nstiffness = 1e8\n[ground_motion]\nfile = \"MOTIONS/el_centro_1940_ns.csv\"\n[analysis]\nduration = 3\n";
    let inertia = 1e5 + 3e4 * 9.0 + 2e4 * 49.0;
    let bench = Bench::with(case);
    let told = bench.json("check case.toml");
    let period = told["buildings"][0]["foundation"]["period"]
        .as_f64()
        .unwrap();
    let expected = std::f64::consts::TAU * (inertia / 2e8_f64).sqrt();
    assert!(
        (period / expected - 1.0).abs() < 1e-6,
        "{period} {expected}"
    );
    let mode = &told["buildings"][0]["foundation"]["damping_ratio"];
    let damping = 1e6 / (2.0 * (2e8_f64 * inertia).sqrt());
    assert!((mode.as_f64().unwrap() / damping - 1.0).abs() < 1e-6);
    // An oscillator of that inertia under the moment of the ground: m at height h with
    // m h^2 = I and m h = 30 t 3 m + 20 t 7 m.
    let moment: f64 = 3e4 * 3.0 + 2e4 * 7.0;
    let height = inertia / moment;
    let oscillator = format!(
        "[[building]]\nname = \"a\"\nmass = {}\nstiffness = {}\nstoreys = 1\nheight = {height}\ndamping = {{ dashpots = {} }}\n",
        inertia / (height * height),
        2e8 / (height * height),
        1e6 / (height * height)
    );
    let rest = case.split_once("[[gap]]").unwrap().1;
    let other = Bench::with(&format!("{oscillator}[[gap]]{rest}"));
    let of = |bench: &Bench, storey: usize, elevation: f64| {
        let told = bench.json("run case.toml --no-output");
        let peak = &told["buildings"][0]["storeys"][storey]["displacement"]["peak"];
        peak.as_f64().unwrap() / elevation
    };
    let (rotation, expected) = (of(&bench, 1, 7.0), of(&other, 0, height));
    assert!(
        (rotation / expected - 1.0).abs() < 1e-6,
        "{rotation} {expected}"
    );
}

/// Gravity through the whole drift lengthens the period by what `check` says, with a stiffness
/// matrix as with storeys, and the ledger closes.
#[test]
fn gravity_acts_on_buildings_on_soil() {
    let chain = by_soil().replace("damping = {", "p_delta = true\ndamping = {");
    let rows = "stiffness_matrix = [[115e6, -55e6, 0], [-55e6, 105e6, -50e6], [0, -50e6, 50e6]]";
    let storeys = "stiffness = [\"60 MN/m\", \"55 MN/m\", \"50 MN/m\"]";
    let matrix = chain.replace(storeys, rows);
    assert_ne!(matrix, chain);
    let period = |case: &str| {
        let told = Bench::with(case).json("check case.toml");
        told["buildings"][0]["period"][0].as_f64().unwrap()
    };
    let (with, without) = (period(&chain), period(&by_soil()));
    let taken = 100.0 * (1.0 - (without / with).powi(2));
    assert!(taken > 0.1, "{taken}");
    let shown = Bench::with(&chain).text("check case.toml");
    let said = shown.split("gravity takes ").nth(1).unwrap();
    let share = said.split(" % off the stiffness of the first mode").next();
    assert!(
        (share.unwrap().parse::<f64>().unwrap() - taken).abs() < 0.011,
        "{said} {taken}"
    );
    let run = |case: &str| {
        let told = Bench::with(case).json("run case.toml --no-output");
        assert!(told["energy"]["residual_ratio"].as_f64().unwrap() < 1e-9);
        let roof = &told["buildings"][0]["storeys"][2]["displacement"]["peak"];
        (
            roof.as_f64().unwrap(),
            told["gaps"][0]["levels"][2]["impacts"].clone(),
        )
    };
    let ((chain, hits), (matrix, same)) = (run(&chain), run(&matrix));
    assert_eq!(hits, same);
    assert!((chain / matrix - 1.0).abs() < 1e-9, "{chain} {matrix}");
    assert!((chain / reference().outputs["U_A3"].peak - 1.0).abs() > 1e-4);
}

/// Each with what its message says, and the remedy.
#[test]
fn what_cannot_stand_on_soil_is_refused_at_its_place() {
    let isolator = "isolator = { model = \"friction_pendulum\", radius = 2, friction_fast = 0.08, friction_slow = 0.04, rate = 30, yield_displacement = 0.001 }\n";
    let after_damping = |line: &str, more: &str| {
        let three = "stiffness = [\"60 MN/m\", \"55 MN/m\", \"50 MN/m\"]";
        let two = "stiffness = [\"55 MN/m\", \"50 MN/m\"]";
        let isolated = by_soil().replacen(three, two, 1);
        isolated.replacen(line, &format!("{more}{line}"), 1)
    };
    let link = |keys: &str| {
        format!(
            "{}[[link]]\nbetween = [\"A\", \"B\"]\nmodel = \"linear\"\n{keys}\n",
            by_soil()
        )
    };
    let heavy = by_springs()
        .replacen("damping =", "p_delta = true\ndamping =", 1)
        .replace("74567887107.42413", "1e7");
    let overlapping =
        by_soil().replacen("mass = \"150 t\"", "mass = \"150 t\"\nlength = \"12 m\"", 1);
    let hit = by_soil()
        .replacen("height = \"3.2 m\"", "height = \"3 m\"", 1)
        .replace(
            "restitution = 0.65",
            "restitution = 0.65\nlevels = \"all_floors\"\ncolumn = { of = \"B\", flexural_rigidity = \"256 MN m2\", contact_mass = \"2.4 t\" }",
        );
    for (case, words) in [
        (
            after_damping("[building.foundation]", isolator),
            [
                "\"A\" stands on isolators and on a foundation that sways or rocks",
                "remove `isolator` or `foundation`",
            ],
        ),
        (
            heavy,
            [
                "gravity acting through the drift and the rotation of its foundation",
                "`p_delta = false` leaves gravity out",
            ],
        ),
        (
            link("foundations = \"rocking\"\nstiffness = \"1 MN/m\""),
            [
                "must be a moment, an energy or a rotational stiffness (N m), but \"1 MN/m\" is a stiffness (N/m)",
                "correct the unit",
            ],
        ),
        (
            link("foundations = \"sway\"\nstiffness = \"1 GN m/rad\""),
            ["must be a stiffness (N/m)", "correct the unit"],
        ),
        (overlapping, ["`length` stands in `soil`", "remove it here"]),
        (
            hit,
            [
                "\"B\" stands on a foundation that moves, and its columns would lean with it",
                "leave out `foundation`",
            ],
        ),
    ] {
        Bench::with(&case).refused("check case.toml", &words);
    }
}
