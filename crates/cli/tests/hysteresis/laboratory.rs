//! `pounding hysteresis`: list, descriptors, loops against closed forms, files, bad input.

use crate::support;
use std::path::Path;

use pounding_hysteresis::descriptors;
use pounding_hysteresis::iwan::IwanDensity;
use serde_json::Value;

fn text(arguments: &str) -> String {
    support::text("hysteresis", arguments)
}

fn json(arguments: &str) -> Value {
    let shown = text(&format!("{arguments} --json"));
    assert!(!shown.contains("NaN"), "{shown}");
    serde_json::from_str(&shown).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value}"))
}

fn close(value: &Value, expected: f64, relative: f64) {
    let value = number(value);
    let off = (value - expected).abs();
    assert!(
        off <= relative * expected.abs(),
        "{value} is not {expected}"
    );
}

fn write(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.to_str().unwrap().to_owned()
}

const BILINEAR: &str = "bilinear --set stiffness=20MN/m --set yield_force=200kN";

#[test]
fn the_list_names_every_law_with_its_parameters_and_how_far_it_is_checked() {
    let shown = text("");
    for law in descriptors() {
        let start = shown.find(&format!("| {} ", law.name)).unwrap();
        assert!(shown[start..].contains(law.title), "{}", law.name);
        for parameter in law.parameters {
            assert!(shown[start..].contains(parameter.name), "{}", law.name);
        }
    }
    assert!(shown.contains("secondary sources") && shown.contains("verified"));
    let listed = json("");
    let names: Vec<_> = listed
        .as_array()
        .unwrap()
        .iter()
        .map(|c| &c["name"])
        .collect();
    let known: Vec<_> = descriptors().iter().map(|d| d.name).collect();
    assert_eq!(names, known);
}

#[test]
fn a_descriptor_says_all_under_the_name_and_under_every_alias() {
    for law in descriptors() {
        let shown = text(law.name);
        for part in [law.title, law.citation]
            .into_iter()
            .chain(law.traps.iter().copied())
        {
            assert!(shown.contains(part), "{}: {part}", law.name);
        }
        for parameter in law.parameters {
            assert!(shown.contains(parameter.explanation), "{}", law.name);
        }
        for alias in law.aliases {
            assert_eq!(text(alias.name), shown);
        }
        assert_eq!(json(law.name)["example_amplitude"], law.example_amplitude);
    }
}

/// Cycles of 4 (1-r) Fy (A - Fy / k), peaks of Fy + r k (A - Fy / k).
#[test]
fn bilinear_cycles_have_their_closed_form() {
    let result = json(&format!(
        "{BILINEAR} --set hardening_ratio=0.05 --cycles 8mm,12.5mm,50mm,30mm"
    ));
    assert_eq!(result["filled_from_example"], Value::Array(Vec::new()));
    let cycles = result["loop"]["cycles"].as_array().unwrap();
    assert_eq!(cycles.len(), 4);
    for (cycle, amplitude) in cycles.iter().zip([0.008, 0.0125, 0.05, 0.03_f64]) {
        let (stiffness, force, ratio) = (2.0e7, 2.0e5, 0.05);
        let beyond = (amplitude - force / stiffness).max(0.0);
        let lost = 4.0 * (1.0 - ratio) * force * beyond;
        let peak = stiffness * (amplitude - beyond) + ratio * stiffness * beyond;
        close(&cycle["dissipated"], lost, 1.0e-12);
        close(&cycle["peak_force"], peak, 1.0e-12);
        close(&cycle["greatest_deformation"], amplitude, 1.0e-15);
        close(&cycle["least_deformation"], -amplitude, 1.0e-15);
        let secant = peak / amplitude;
        close(&cycle["secant_stiffness"], secant, 1.0e-12);
        let damping = lost / (std::f64::consts::TAU * secant * amplitude.powi(2));
        close(&cycle["equivalent_damping_ratio"], damping, 1.0e-12);
    }
    let shown = text(&format!(
        "{BILINEAR} --set hardening_ratio=0.05 --cycles 50mm"
    ));
    for part in [
        "peak force (kN)",
        "30400",
        "240",
        "4800",
        "40.319",
        "dissipated (J)",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
}

/// Without `--set` the example holds, with it only what is missing and has no default; both
/// are said.
#[test]
fn values_of_the_example_are_named() {
    let shown = text("bilinear --cycles 50mm");
    let all = "from the example of its descriptor: stiffness = 2e7 N/m, yield_force = 2e5 N, hardening_ratio = 0.05";
    assert!(shown.contains(all), "{shown}");
    let result = json("bilinear --set yield_force=137kN --cycles 50mm");
    assert_eq!(
        result["filled_from_example"],
        serde_json::json!(["stiffness"])
    );
    // Perfectly plastic: the default of the hardening ratio, not the example's.
    close(&result["loop"]["cycles"][0]["peak_force"], 137.0e3, 1.0e-12);
}

/// Dampers: pi c omega A^2 of a linear one in harmonic cycles, 4 A c v^a at constant speed;
/// a Maxwell element pi c omega A^2 / (1 + (omega c / k)^2) once it is steady.
#[test]
fn dampers_answer_to_period_and_rate() {
    let omega = std::f64::consts::PI;
    let linear = json("viscous_damper --set damping=100kN*s/m --cycles 20mm --period 2s");
    let cycle = &linear["loop"]["cycles"][0];
    // The law takes trapezoids over its steps, here sin(h) / h of the integral.
    let h = std::f64::consts::PI / 500.0;
    let lost = omega * 1.0e5 * omega * 4.0e-4 * h.sin() / h;
    close(&cycle["dissipated"], lost, 1.0e-12);
    assert_eq!(cycle["equivalent_damping_ratio"], Value::Null);
    let steady = json("viscous_damper --cycles 20mm --rate 40mm/s");
    let lost = 4.0 * 0.02 * 3.0e5 * 0.04_f64.sqrt();
    close(&steady["loop"]["cycles"][0]["dissipated"], lost, 1.0e-12);
    let maxwell = json(
        "maxwell --set stiffness=20MN/m --set damping=1MN*s/m --dissipation 5mm,20mm --points 2 --period 2s",
    );
    let factor = omega * 1.0e6 * omega / (1.0 + (omega * 1.0e6 / 2.0e7).powi(2));
    for pair in maxwell["dissipation"]["curve"].as_array().unwrap() {
        close(&pair[1], factor * number(&pair[0]).powi(2), 2.0e-5);
    }
    close(&maxwell["dissipation"]["log_log_slope"], 2.0, 1.0e-9);
}

/// Small cycles of the Iwan law with phi_1 = 0 dissipate like a power of alpha + 3:
/// 4 R A^(alpha+3) / ((alpha+2)(alpha+3)).
#[test]
fn the_dissipation_curve_of_micro_slip_is_a_power() {
    let result = json(
        "iwan_six_parameter --set density=2e6N/m^1.7 --set phi_2=0.1mm --dissipation 0.0001mm,0.09mm --points 9",
    );
    let curve = &result["dissipation"];
    close(&curve["log_log_slope"], 2.7, 1.0e-10);
    let pairs = curve["curve"].as_array().unwrap();
    assert_eq!(pairs.len(), 9);
    for pair in pairs {
        let expected = 4.0 * 2.0e6 * number(&pair[0]).powf(2.7) / (1.7 * 2.7);
        close(&pair[1], expected, 1.0e-10);
    }
    close(&pairs[0][0], 1.0e-7, 1.0e-12);
    close(&pairs[8][0], 9.0e-5, 1.0e-12);
}

/// Cycles of a law that deteriorates are not steady: the second and the third are those of a loop that
/// stays at the amplitude.
#[test]
fn cycles_that_are_not_steady_are_said_to_be_none() {
    let law = "ibarra_medina_krawinkler_2005_bilinear";
    let asked = format!("{law} --dissipation 40mm,50mm --points 2");
    let result = json(&asked);
    let found = &result["dissipation"]["unsteady"];
    close(&found["amplitude"], 0.05, 1.0e-12);
    let cycles = json(&format!("{law} --cycles 50mm,50mm,50mm --steps 1000"));
    let cycles = &cycles["loop"]["cycles"];
    close(
        &found["second_cycle"],
        number(&cycles[1]["dissipated"]),
        1.0e-9,
    );
    close(
        &found["third_cycle"],
        number(&cycles[2]["dissipated"]),
        1.0e-9,
    );
    assert!(number(&found["third_cycle"]) < 0.9 * number(&found["second_cycle"]));
    let shown = text(&asked);
    assert!(
        shown.contains("not steady") && !shown.contains("Steady cycles"),
        "{shown}"
    );
    let steady = format!("{BILINEAR} --dissipation 20mm,50mm --points 2");
    assert!(text(&steady).contains("Steady cycles"));
    assert_eq!(json(&steady)["dissipation"]["unsteady"], Value::Null);
}

#[test]
fn a_history_is_followed_row_by_row() {
    let folder = tempfile::tempdir().unwrap();
    let file = write(
        folder.path(),
        "history.csv",
        "# a test\ndeformation (mm)\n0\n20\n-20\n20\n15\n",
    );
    let table = folder.path().join("loop.csv");
    let figure = folder.path().join("loop.svg");
    let arguments = format!(
        "elastic_perfectly_plastic --set stiffness=20MN/m --set yield_force=200kN --history {file} --csv {} --svg {}",
        table.display(),
        figure.display()
    );
    let result = json(&arguments);
    let cycles = result["loop"]["cycles"].as_array().unwrap();
    assert_eq!(cycles.len(), 1);
    close(&cycles[0]["dissipated"], 4.0 * 2.0e5 * 0.01, 1.0e-12);
    close(&result["loop"]["dissipated"], 5.0 * 2.0e5 * 0.01, 1.0e-12);
    let csv = std::fs::read_to_string(&table).unwrap();
    let mut lines = csv.lines();
    assert_eq!(
        lines.next().unwrap(),
        "# pounding hysteresis: law=elastic_perfectly_plastic stiffness=2e7 yield_force=2e5"
    );
    assert_eq!(
        lines.next(),
        Some("time_s,deformation_m,force_n,dissipated_j")
    );
    let rows: Vec<Vec<f64>> = lines
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    let states = result["loop"]["history"].as_array().unwrap();
    assert_eq!(rows.len(), states.len());
    for (row, state) in rows.iter().zip(states) {
        for (a, b) in row.iter().zip(state.as_array().unwrap()) {
            close(b, *a, 1.0e-15);
        }
        assert!(row[2].abs() <= 2.0e5 * (1.0 + 1.0e-12));
    }
    // Unloading by 5 mm from yield: 200 kN - 20 MN/m * 5 mm.
    let last = rows.last().unwrap();
    assert!(
        (last[2] - 1.0e5).abs() < 1.0e-6 && last[1] == 0.015,
        "{last:?}"
    );
    assert!(std::fs::read_to_string(&figure).unwrap().contains("</svg>"));
}

/// A cycle of a history is closed: of a growing one it ends where it passes its start, of a
/// dying one there is none, a measured one may miss by a little.
#[test]
fn cycles_of_a_history_are_closed() {
    let folder = tempfile::tempdir().unwrap();
    let cycles = |rows: &str| {
        let rows = rows.replace(' ', "\n");
        let file = write(
            folder.path(),
            "rows.csv",
            &format!("deformation_mm\n{rows}\n"),
        );
        let law = "elastic_perfectly_plastic --set stiffness=20MN/m --set yield_force=200kN";
        let result = json(&format!("{law} --history {file}"));
        result["loop"]["cycles"].as_array().unwrap().clone()
    };
    let growing = cycles("0 20 -20 43.21 -43.21 50 48");
    assert_eq!(growing.len(), 2);
    for (cycle, amplitude) in growing.iter().zip([0.02, 0.04321]) {
        close(&cycle["greatest_deformation"], amplitude, 1.0e-12);
        close(
            &cycle["dissipated"],
            4.0 * 2.0e5 * (amplitude - 0.01),
            1.0e-9,
        );
        close(&cycle["secant_stiffness"], 2.0e5 / amplitude, 1.0e-9);
    }
    assert!(cycles("0 30 -25 20 -15 10 -5").is_empty());
    let measured = cycles("0 30 -30 29.9 -30");
    assert_eq!(measured.len(), 1);
    close(&measured[0]["dissipated"], 2.0e5 * (0.04 + 0.0399), 1.0e-9);
}

#[test]
fn times_of_a_history_give_its_rate() {
    let folder = tempfile::tempdir().unwrap();
    let timed = write(
        folder.path(),
        "timed.csv",
        "time_s,deformation_mm\n0,0\n0.5,20\n1.5,-20\n2.5,20\n",
    );
    let plain = write(
        folder.path(),
        "plain.csv",
        "deformation_m\n0\n0.02\n-0.02\n0.02\n",
    );
    let a = json(&format!("viscous_damper --history {timed}"));
    let b = json(&format!("viscous_damper --history {plain} --rate 40mm/s"));
    let lost = 5.0 * 0.02 * 3.0e5 * 0.04_f64.sqrt();
    for result in [a, b] {
        close(&result["loop"]["dissipated"], lost, 1.0e-12);
        let cycle = &result["loop"]["cycles"][0];
        close(&cycle["dissipated"], 0.8 * lost, 1.0e-12);
        close(&cycle["peak_force"], 3.0e5 * 0.2, 1.0e-12);
    }
}

/// The fit finds the density that made the curve, here all but phi_1.
#[test]
fn a_fit_finds_the_density_that_made_the_curve() {
    let truth = IwanDensity {
        density: 2.0e6,
        exponent: -0.3,
        phi_1: 0.0,
        phi_2: 1.0e-4,
        slider_stiffness: 3.0e3,
        residual_stiffness: 1.0e3,
    };
    let mut rows = "amplitude (mm); dissipation (mJ)\n".to_owned();
    for i in 0..30 {
        let amplitude = 5.0e-6 * 1.15_f64.powi(i);
        let energy = truth.cycle_dissipation(amplitude);
        rows.push_str(&format!("{:e}; {:e}\n", 1.0e3 * amplitude, 1.0e3 * energy));
    }
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "measured.csv", &rows);
    let figure = folder.path().join("fit.svg");
    let table = folder.path().join("fit.csv");
    let result = json(&format!(
        "iwan_six_parameter --fit {file} --set residual_stiffness=1kN/m --cycles 0.2mm --svg {}",
        figure.display()
    ));
    let found = &result["parameters"];
    close(&found["density"], truth.density, 1.0e-5);
    close(&found["exponent"], truth.exponent, 1.0e-5);
    close(&found["phi_2"], truth.phi_2, 1.0e-5);
    close(&found["slider_stiffness"], truth.slider_stiffness, 1.0e-5);
    assert_eq!(found["residual_stiffness"], 1.0e3);
    assert!(number(&result["fit"]["relative_error"]) < 1.0e-8);
    // The fitted law is the one that is driven.
    let cycle = &result["loop"]["cycles"][0];
    close(
        &cycle["dissipated"],
        truth.cycle_dissipation(2.0e-4),
        1.0e-6,
    );
    let shown = text(&format!(
        "iwan_six_parameter --fit {file} --csv {}",
        table.display()
    ));
    for part in [
        "Fitted to 30 measured cycles",
        "a spring does not dissipate",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
    let csv = std::fs::read_to_string(&table).unwrap();
    assert!(csv.contains("amplitude_m,measured_j,fitted_j"));
    assert_eq!(csv.lines().count(), 32);
}

/// A backbone gives all but phi_1 back, with the density that its curvature means.
#[test]
fn a_backbone_is_fitted_too() {
    let truth = IwanDensity {
        density: 2.0e6,
        exponent: -0.3,
        phi_1: 0.0,
        phi_2: 1.0e-4,
        slider_stiffness: 3.0e3,
        residual_stiffness: 1.0e3,
    };
    let mut rows = "deformation (mm); force (N)\n0; 0\n".to_owned();
    for i in 1..=40 {
        let deformation = 5.0e-6 * f64::from(i);
        let force = truth.backbone(deformation).0;
        rows.push_str(&format!("{:e}; {force:e}\n", 1.0e3 * deformation));
    }
    let folder = tempfile::tempdir().unwrap();
    let file = write(folder.path(), "backbone.csv", &rows);
    let (table, figure) = (folder.path().join("b.csv"), folder.path().join("b.svg"));
    let command = format!(
        "iwan_six_parameter --fit {file} --csv {} --svg {}",
        table.display(),
        figure.display()
    );
    let result = json(&command);
    for (name, expected) in [
        ("density", truth.density),
        ("exponent", truth.exponent),
        ("phi_2", truth.phi_2),
        ("slider_stiffness", truth.slider_stiffness),
        ("residual_stiffness", truth.residual_stiffness),
    ] {
        close(&result["parameters"][name], expected, 1.0e-4);
    }
    // -F'' = R phi^alpha at 0.05 mm.
    let curvature = result["fit"]["density_by_curvature"].as_array().unwrap();
    assert_eq!(curvature.len(), 39);
    close(&curvature[9][0], 5.0e-5, 1.0e-9);
    close(&curvature[9][1], 2.0e6 * 5.0e-5_f64.powf(-0.3), 3.0e-3);
    // Asked for by name it is the same.
    let named = json(&format!("iwan_six_parameter --fit backbone {file}"));
    assert_eq!(named["parameters"], result["parameters"]);
    let shown = text(&format!("iwan_six_parameter --fit backbone {file}"));
    for part in [
        "Fitted to 40 points of the backbone",
        "never slips",
        "Density of sliders, -F''",
    ] {
        assert!(shown.contains(part), "{shown}");
    }
    let csv = std::fs::read_to_string(&table).unwrap();
    assert!(csv.contains("deformation_m,measured_n,fitted_n"));
    let picture = std::fs::read_to_string(&figure).unwrap();
    assert!(picture.contains("force of the backbone"));
}

/// What `--set` gives is held, and said, whatever the number of rows; a lump of `slider_stiffness=0` came back as
/// 3 MN/m.
#[test]
fn values_that_are_set_are_held_in_a_fit() {
    let truth = IwanDensity {
        density: 2.0e8,
        exponent: -0.3,
        phi_1: 0.0,
        phi_2: 1.0e-2,
        slider_stiffness: 3.0e6,
        residual_stiffness: 1.0e6,
    };
    let folder = tempfile::tempdir().unwrap();
    let table = |name: &str, header: &str, value: &dyn Fn(f64) -> f64| {
        let mut rows = format!("{header}\n");
        for i in 0..12 {
            let reach = 2.0e-4 * 1.6_f64.powi(i);
            rows.push_str(&format!("{:e},{:e}\n", 1.0e3 * reach, value(reach)));
        }
        write(folder.path(), name, &rows)
    };
    let backbone = table("b.csv", "deformation_mm,force_N", &|x| truth.backbone(x).0);
    let cycles = table("d.csv", "amplitude_mm,dissipation_J", &|x| {
        truth.cycle_dissipation(x)
    });
    for (name, set, held) in [
        ("slider_stiffness", "0", 0.0),
        ("slider_stiffness", "\"5 MN/m\"", 5.0e6),
        ("residual_stiffness", "\"5 MN/m\"", 5.0e6),
        ("exponent", "0.5", 0.5),
        ("phi_2", "\"5 mm\"", 5.0e-3),
    ] {
        let set = set.trim_matches('"').replace(' ', "");
        for (curve, file) in [("backbone", &backbone), ("dissipation", &cycles)] {
            let command = format!("iwan_six_parameter --fit {curve} {file} --set {name}={set}");
            let result = json(&command);
            let found = number(&result["parameters"][name]);
            assert_eq!(found, held, "{command}");
            let shown = text(&command);
            if curve == "backbone" {
                assert_eq!(result["fit"]["held"], serde_json::json!([name]));
                assert!(shown.contains(&format!("held as given: {name}")), "{shown}");
            }
        }
    }
}

/// What `--dissipation` writes of laws with a threshold is fitted: cycles below it, which dissipate nothing, are
/// left out and counted. They were refused.
#[test]
fn cycles_that_dissipate_nothing_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    for law in ["song_2004", "iwan_six_parameter", "bilinear"] {
        let file = folder.path().join(format!("{law}.csv"));
        let file = file.display();
        text(&format!(
            "{law} --dissipation 0.01mm,20mm --points 40 --csv {file}"
        ));
        let rows = std::fs::read_to_string(file.to_string()).unwrap();
        let nothing = rows.lines().filter(|line| line.ends_with(",0.0")).count();
        assert!(nothing > 0, "{rows}");
        let command = format!("iwan_six_parameter --fit dissipation {file}");
        let result = json(&command);
        assert_eq!(result["fit"]["rows_left_out"], nothing, "{law}");
        let shown = text(&command);
        let said = match nothing {
            1 => "without 1 row of cycles that dissipate nothing".to_owned(),
            n => format!("without {n} rows of cycles that dissipate nothing"),
        };
        assert!(shown.contains(&said), "{shown}");
    }
}
