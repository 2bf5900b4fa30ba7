//! The gap check on the three-storey pair of the examples.
#![allow(clippy::unwrap_used)]

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use pounding_case::{Case, Separation};
use pounding_study::gap_check::{
    CheckError, GapCheck, GapCheckOptions, SweepOptions, gap_check, under_records,
};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn pair(width: &str) -> Case {
    let file = root().join("examples/three_storey_pair/case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    Case::parse(&text.replace("\"20 mm\"", width), &file).unwrap()
}

fn options() -> GapCheckOptions {
    GapCheckOptions {
        target_probability: 0.0,
        confidence: 0.9,
        sweep: None,
        threads: 2,
    }
}

fn check(case: &Case, records: &[PathBuf], options: &GapCheckOptions) -> GapCheck {
    let records = under_records(case, records).unwrap();
    gap_check(case, &case.separation, &records, options, &|_, _| {}).unwrap()
}

fn both() -> [PathBuf; 2] {
    ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"].map(|n| root().join("ground_motions").join(n))
}

/// Demand and square root of an independent solution (0.117207 m and 0.116112 m with g =
/// 9.81 m/s2), times 9.80665 / 9.81; the first value of the record at time zero changes
/// the fifth digit.
#[test]
fn the_square_root_is_unsafe_under_el_centro() {
    let check = check(&pair("\"20 mm\""), &[], &options());
    let gap = &check.gaps[0];
    let scale = 9.80665 / 9.81;
    assert!((gap.demand[0] / (0.117_207 * scale) - 1.0).abs() < 2.0e-4);
    assert_eq!(gap.governing_level, 2);
    let nbcc = gap
        .codes
        .iter()
        .find(|c| c.provision.name == "nbcc_2015_between");
    let root = nbcc.unwrap().width(0).unwrap();
    assert!((root / (0.116_112 * scale) - 1.0).abs() < 2.0e-4);
    assert!(root < gap.demand[0], "the square root is on the safe side");
    let difference = gap.combinations.last().unwrap();
    assert!((difference.correlation.unwrap() - 0.003_540).abs() < 5.0e-6);
    assert!((difference.records[0][2].width / (0.116_040 * scale) - 1.0).abs() < 2.0e-4);
    assert!(!check.adequate());
    assert_eq!(gap.records_in_contact, 1);
}

/// The verdict turns where contact begins, and so do the impacts of the run.
#[test]
fn the_verdict_turns_at_the_demand() {
    let demand = check(&pair("\"20 mm\""), &[], &options()).gaps[0].demand[0];
    for (factor, adequate) in [(1.0 + 1.0e-7, true), (1.0 - 1.0e-7, false)] {
        let check = check(&pair(&format!("{}", demand * factor)), &[], &options());
        assert_eq!(check.adequate(), adequate);
        let (_, gaps) = check.records[0].pounding.as_ref().unwrap();
        let touched = gaps[0].levels.iter().any(|l| l.impacts > 0);
        assert_eq!(touched, !adequate);
    }
}

/// Half of the records may touch: the gap of the lesser demand is then enough.
#[test]
fn target_probability() {
    let asked = GapCheckOptions {
        target_probability: 0.5,
        ..options()
    };
    let first = check(&pair("\"20 mm\""), &both(), &asked);
    let gap = &first.gaps[0];
    assert_eq!(gap.demand.len(), 2);
    let lesser = gap.demand[0].min(gap.demand[1]);
    assert_eq!(gap.required.by_count, lesser);
    let fit = gap.required.lognormal.as_ref().unwrap();
    let mean = (gap.demand[0] * gap.demand[1]).sqrt();
    assert!((fit.width / mean - 1.0).abs() < 1.0e-9, "median of two");
    let wide = check(&pair(&format!("{}", lesser * 1.001)), &both(), &asked);
    assert!(wide.adequate() && wide.gaps[0].records_in_contact == 1);
}

/// Values of a fixed-step solution at 20 and 60 mm: the wider gap is the worse one.
/// Results are the same on one thread and on three.
#[test]
fn a_wider_gap_can_be_worse() {
    let mut asked = GapCheckOptions {
        sweep: Some(SweepOptions {
            gap: None,
            from: Some(0.02),
            to: Some(0.12),
            points: 6,
        }),
        ..options()
    };
    let told = Mutex::new(0);
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let tell = |done: usize, total: usize| {
        assert!(done <= total && total == 7);
        *told.lock().unwrap() += 1;
    };
    let three = gap_check(&case, &case.separation, &records, &asked, &tell).unwrap();
    assert_eq!(*told.lock().unwrap(), 7);
    asked.threads = 1;
    let one = check(&case, &[], &asked).sweep.unwrap();
    let sweep = three.sweep.unwrap();
    assert_eq!(sweep, one);
    let alone = three.records[0].isolated[0].storeys[2].displacement.value;
    let roof = |i: usize| sweep.runs[i][0].as_ref().unwrap().amplification[0][2].displacement;
    assert!((roof(0) * alone / 0.105_3 - 1.0).abs() < 3.0e-3);
    assert!((roof(2) * alone / 0.132_3 - 1.0).abs() < 3.0e-3);
    let last = sweep.runs[5][0].as_ref().unwrap();
    assert!(last.impacts == 0 && last.amplification[0][2].displacement == 1.0);
    let worst = sweep.worst(0, |a| a.displacement).unwrap();
    assert!(worst.width > 0.02, "the narrowest gap is not the worst");
}

/// Every provision either computes or says what is missing; with all inputs only those
/// that do not apply are left.
#[test]
fn inputs_from_the_case() {
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let refused = |separation: &Separation| -> Vec<(&str, String)> {
        let check = gap_check(&case, separation, &records, &options(), &|_, _| {}).unwrap();
        let codes = check.gaps[0].codes.iter();
        codes
            .filter_map(|c| Some((c.provision.name, c.refusal()?.to_string())))
            .collect()
    };
    let without = refused(&Separation::default());
    let missing = |name: &str| &without.iter().find(|r| r.0 == name).unwrap().1;
    assert!(missing("asce_7_10_between").contains("displacement_amplification"));
    assert!(missing("gb_50011_2010_between").contains("fortification_intensity"));
    let text = "response_modification = [8, 5]\ndisplacement_amplification = 5.5\nimportance = 1\n\
        yield_amplification = 1\nstructural_system = \"frame\"\nsame_owner = true\n\
        fortification_intensity = 8\nsoil_zone = \"II\"\ndesign_ground_acceleration = 2.5\n\
        seismic_coefficient = 0.12\nductility = [4, 1]";
    let all = Separation::parse(text, 2).unwrap();
    let names: Vec<_> = refused(&all).into_iter().map(|r| r.0).collect();
    assert_eq!(
        names,
        ["as_1170_4_boundary", "tehran_between"],
        "9 m is too low"
    );
}

#[test]
fn mistakes() {
    let case = pair("\"20 mm\"");
    let records = under_records(&case, &[]).unwrap();
    let refuse = |options: GapCheckOptions| {
        gap_check(&case, &case.separation, &records, &options, &|_, _| {}).unwrap_err()
    };
    let error = refuse(GapCheckOptions {
        target_probability: 1.0,
        ..options()
    });
    assert!(matches!(error, CheckError::Option { .. }) && error.help().is_some());
    let sweep = |gap: Option<&str>, from, to, points| GapCheckOptions {
        sweep: Some(SweepOptions {
            gap: gap.map(str::to_owned),
            from: Some(from),
            to,
            points,
        }),
        ..options()
    };
    let error = refuse(sweep(Some("light"), 0.0, None, 5));
    assert!(error.help().unwrap().contains("light-heavy"));
    assert!(matches!(
        refuse(sweep(None, 0.0, None, 1)),
        CheckError::Option { .. }
    ));
    assert!(matches!(
        refuse(sweep(None, 0.5, None, 5)),
        CheckError::Option { .. }
    ));
    let nowhere = under_records(&case, &[root().join("nowhere.csv")]).unwrap_err();
    assert!(nowhere.to_string().contains("nowhere.csv"), "{nowhere}");
    let named = Separation::parse("provisions = \"nbcc\"", 2).unwrap();
    let error = gap_check(&case, &named, &records, &options(), &|_, _| {}).unwrap_err();
    assert!(
        error.help().unwrap().contains("nbcc_2015_between"),
        "{error}"
    );
}
