//! `pounding verify hysteresis`: verdicts, headline numbers, exit code.

use crate::support;
use serde_json::Value;

fn comparisons() -> Vec<Vec<Value>> {
    let result: Value =
        serde_json::from_str(&support::text("verify", "hysteresis --json")).unwrap();
    assert_eq!(result["holds"], true);
    let parts = result["parts"].as_array().unwrap();
    assert_eq!(parts.len(), 1);
    let all = parts[0]["comparisons"].as_array().unwrap();
    all.iter()
        .map(|c| c["lines"].as_array().unwrap().clone())
        .collect()
}

/// All lines agree with their references but the measured slope, and it is said so.
#[test]
fn everything_that_is_said_to_agree_does() {
    let all = comparisons();
    let counts: Vec<_> = all.iter().map(Vec::len).collect();
    // Closed forms, curvature, a fitted backbone, special cases, two families, slopes, the joint.
    assert_eq!(counts, [2 + 3 + 5 + 5 + 7, 6, 6, 2, 9, 9, 5, 2]);
    for line in all[..7].iter().flatten() {
        assert_eq!(line["verdict"], "agrees with the reference", "{line}");
    }
    for line in [0, 3, 4, 5].iter().flat_map(|i| &all[*i]) {
        assert!(
            line["largest_difference"].as_f64().unwrap() < 1.0e-12,
            "{line}"
        );
    }
    let slopes: Vec<_> = all[7].iter().map(|l| l["verdict"].clone()).collect();
    assert_eq!(slopes, ["computed only", "not reproduced"]);
}

/// Closed forms by hand: without phi_1 and kappa_2 the dissipation of micro-slip is
/// 4 M^(alpha+3) / ((alpha+2)(alpha+3)), and kappa_2 adds 4 kappa_2 (M - 1) beyond phi_2.
#[test]
fn dissipation_without_dimension() {
    let all = comparisons();
    for (beta, kappa) in all[4].iter().zip(&all[5]) {
        let ratio = beta["amplitude_ratio"].as_f64().unwrap();
        let plain = beta["beta_0"].as_f64().unwrap();
        if ratio <= 1.0 {
            let expected = 4.0 * ratio.powf(2.7) / (1.7 * 2.7);
            assert!((plain / expected - 1.0).abs() < 1.0e-13, "{ratio}");
        }
        assert_eq!(kappa["kappa_2_0"].as_f64().unwrap(), plain);
        let added = kappa["kappa_2_5"].as_f64().unwrap() - plain;
        assert!((added - 20.0 * (ratio - 1.0).max(0.0)).abs() < 1.0e-12 * plain.max(20.0));
    }
}

#[test]
fn headline_numbers_stand_in_the_text() {
    let shown = support::text("verify", "hysteresis");
    for part in [
        "7.624758361269e3",
        "-1.664131109308e-1",
        "2.622897721410e-5",
        "0.871459695",
        "202.047930283",
        "2.700000000",
        "2.83",
        "2.87",
        "everything that is said to reproduce does",
    ] {
        assert!(shown.contains(part), "\"{part}\" is not in: {shown}");
    }
}

#[test]
fn bad_input_is_refused() {
    let output = support::run("verify", "hysteresis --source iwan");
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
}
