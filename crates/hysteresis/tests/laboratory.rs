//! The laboratory: loops against closed forms, and tests that cannot be made.
use std::f64::consts::PI;

use pounding_hysteresis::iwan::{
    FitOptions, IwanDensity, MeasuredCurve, fit_from_many, unknowns_of_fit,
};
use pounding_hysteresis::laboratory::{
    Cycling, HistoryRow, LaboratoryError, LoadPath, Loop, Pace, Specimen,
    checked_dissipation_curve, local_slope, log_slope,
};
use pounding_hysteresis::{LawParameters, find};

const STIFFNESS: f64 = 2.0e7;
const YIELD_FORCE: f64 = 2.0e5;
const HARDENING: f64 = 0.05;

fn bilinear() -> Specimen {
    let parameters = LawParameters::from_pairs(&[
        ("stiffness", STIFFNESS),
        ("yield_force", YIELD_FORCE),
        ("hardening_ratio", HARDENING),
    ]);
    Specimen::new(find("bilinear").unwrap(), parameters).unwrap()
}

fn rows(deformations: &[f64]) -> Vec<HistoryRow> {
    let row = |&deformation| HistoryRow {
        time: None,
        deformation,
    };
    deformations.iter().map(row).collect()
}

/// A full cycle of a bilinear law loses 4 (1 - r) Fy (A - Fy / k), and its secant leads through
/// the force at the peak; Jacobsen's ratio follows from both.
#[test]
fn cycles_of_a_bilinear_law_are_those_of_its_closed_form() {
    let specimen = bilinear();
    let amplitude = 0.03;
    for pace in [Pace::Harmonic(1.0), Pace::Steady(0.1)] {
        let path =
            LoadPath::full_cycles(specimen.descriptor, &[amplitude, 0.5 * amplitude], pace, 50);
        let driven = Loop::drive(&specimen, &path).unwrap();
        assert_eq!(driven.cycles.len(), 2);
        let cycle = driven.cycles[0];
        let yields = YIELD_FORCE / STIFFNESS;
        let lost = 4.0 * (1.0 - HARDENING) * YIELD_FORCE * (amplitude - yields);
        let peak = YIELD_FORCE + HARDENING * STIFFNESS * (amplitude - yields);
        assert!((cycle.dissipated / lost - 1.0).abs() < 1e-9, "{cycle:?}");
        assert!((cycle.peak_force / peak - 1.0).abs() < 1e-9);
        let secant = peak / amplitude;
        assert!((cycle.secant_stiffness / secant - 1.0).abs() < 1e-9);
        let ratio = lost / (2.0 * PI * secant * amplitude * amplitude);
        assert!((cycle.equivalent_damping_ratio.unwrap() / ratio - 1.0).abs() < 1e-9);
        assert_eq!((cycle.minimum, cycle.maximum), (-amplitude, amplitude));
        assert!((driven.maximum_force() / peak - 1.0).abs() < 1e-9);
        assert!(driven.dissipated() > cycle.dissipated);
    }
}

/// The cycles of a history lead from a turning point back to its deformation: here on the way
/// from -10 mm to 12 mm, which passes 10 mm.
#[test]
fn cycles_of_a_history_are_found() {
    let specimen = bilinear();
    let history = rows(&[0.010, -0.010, 0.012, -0.003, 0.012]);
    let path = LoadPath::history(specimen.descriptor, &history, None).unwrap();
    assert!((path.length() - (0.010 + 0.020 + 0.022 + 0.015 + 0.015)).abs() < 1e-12);
    let driven = Loop::drive(&specimen, &path).unwrap();
    let ends: Vec<_> = driven
        .cycles
        .iter()
        .map(|c| (c.maximum, c.minimum))
        .collect();
    assert_eq!(ends, [(0.010, -0.010), (0.012, -0.003)]);
}

/// Ripples of a measured history hide no cycle: two of 30 mm, each of the closed form of the law, and
/// a loop of nearly nothing at an end of the first. Noise on sines, too: all that is dissipated from the
/// first peak to the last is that of the cycles listed, up to the half cycles that never close.
#[test]
fn ripples_hide_no_cycles() {
    let specimen = bilinear();
    let drive = |deformations: &[f64]| {
        let path = LoadPath::history(specimen.descriptor, &rows(deformations), None).unwrap();
        Loop::drive(&specimen, &path).unwrap()
    };
    let plain = drive(&[0.030, -0.030, 0.030, -0.030, 0.030]);
    let rippled = drive(&[
        0.030, -0.030, -0.0299, -0.02995, 0.030, -0.030, 0.01, 0.005, 0.030,
    ]);
    let ends = |driven: &Loop| -> Vec<_> {
        let cycles = driven.cycles.iter();
        cycles.map(|c| (c.maximum, c.minimum)).collect()
    };
    assert_eq!(ends(&plain), [(0.030, -0.030); 2]);
    let expected = [
        (-0.0299, -0.02995),
        (0.030, -0.030),
        (0.01, 0.005),
        (0.030, -0.030),
    ];
    assert_eq!(ends(&rippled), expected);
    for (cycle, plain) in [1, 3].map(|k| rippled.cycles[k]).iter().zip(&plain.cycles) {
        assert!((cycle.dissipated / plain.dissipated - 1.0).abs() < 1e-9);
        assert_eq!(cycle.secant_stiffness, plain.secant_stiffness);
    }
    assert!((rippled.dissipated() / plain.dissipated() - 1.0).abs() < 1e-9);

    let noisy: Vec<f64> = (0..=500)
        .map(|i| {
            let phase = f64::from(i) * 5.0 * std::f64::consts::TAU / 500.0;
            // Noise of its own, the same in each run.
            let noise = (f64::from(i * 7919 % 104_729) * 12.9898).sin();
            0.030 * phase.sin() + 1.0e-4 * noise
        })
        .collect();
    let driven = drive(&noisy);
    let large = driven
        .cycles
        .iter()
        .filter(|c| c.maximum - c.minimum > 0.05);
    assert_eq!(large.count(), 4);
    let listed: f64 = driven.cycles.iter().map(|c| c.dissipated).sum();
    let one = plain.cycles[0].dissipated;
    let missing = driven.dissipated() - listed;
    assert!(missing > 0.0 && missing < 1.3 * one, "{missing} {one}");
}

/// States have the times of the rows, to the last bit, and begin with the first: here before zero, and with a
/// way back that a cycle divides.
#[test]
fn a_history_keeps_its_times() {
    let specimen = bilinear();
    let rows: Vec<HistoryRow> = [(-1.0, 0.0), (-0.7, 0.01), (0.1, -0.01), (0.3, 0.02)]
        .iter()
        .map(|&(time, deformation)| HistoryRow {
            time: Some(time),
            deformation,
        })
        .collect();
    let path = LoadPath::history(specimen.descriptor, &rows, None).unwrap();
    let states = Loop::drive(&specimen, &path).unwrap().states;
    for row in &rows {
        let state = states.iter().find(|s| Some(s.time) == row.time);
        assert_eq!(state.unwrap().deformation, row.deformation);
    }
    assert_eq!(states[0].time, -1.0);
    assert!(states.windows(2).all(|w| w[0].time < w[1].time));
    // Straight between the rows, where the cycle ends as well.
    let back = states
        .iter()
        .find(|s| s.time > 0.2 && s.deformation >= 0.01);
    assert!((back.unwrap().time - (0.1 + 0.2 * 2.0 / 3.0)).abs() < 1e-12);
}

#[test]
fn histories_that_say_too_little_are_refused() {
    let (plain, damper) = (find("bilinear").unwrap(), find("viscous_damper").unwrap());
    let timed = |rows: &[(f64, f64)]| -> Vec<HistoryRow> {
        let row = |&(time, deformation): &(f64, f64)| HistoryRow {
            time: Some(time),
            deformation,
        };
        rows.iter().map(row).collect()
    };
    let refused =
        |law, rows: &[HistoryRow], speed| LoadPath::history(law, rows, speed).unwrap_err();
    let same_time = timed(&[(0.0, 0.0), (1.0, 0.01), (1.0, 0.02)]);
    assert_eq!(
        refused(plain, &same_time, None),
        LaboratoryError::TimeOrder { row: 2 }
    );
    let displaced = timed(&[(0.0, 0.01), (1.0, 0.02)]);
    assert!(LoadPath::history(plain, &displaced, None).is_ok());
    assert_eq!(
        refused(damper, &displaced, None),
        LaboratoryError::UnknownStart { row: 0 }
    );
    let untimed = rows(&[0.01, 0.0]);
    let law = damper.name;
    assert_eq!(
        refused(damper, &untimed, None),
        LaboratoryError::UnknownRate { law }
    );
    assert!(LoadPath::history(damper, &untimed, Some(0.1)).is_ok());
    assert_eq!(
        refused(plain, &rows(&[0.0, 0.0]), None),
        LaboratoryError::NoMotion
    );
}

#[test]
fn paths_out_of_reach_are_refused() {
    let wen = find("bouc_wen").unwrap();
    let specimen = Specimen::new(wen, LawParameters::default()).unwrap();
    let far = LoadPath::history(wen, &rows(&[1.0e6]), None).unwrap();
    let refused = Loop::drive(&specimen, &far).unwrap_err();
    assert!(
        matches!(refused, LaboratoryError::TooLong { .. }),
        "{refused}"
    );
    let curve = checked_dissipation_curve(&specimen, &[1.0e6], Cycling::default());
    assert!(matches!(curve, Err(LaboratoryError::TooLong { .. })));
    let bilinear = bilinear();
    let beyond = LoadPath::history(bilinear.descriptor, &rows(&[1.0e302]), None).unwrap();
    let refused = Loop::drive(&bilinear, &beyond).unwrap_err();
    assert!(
        matches!(refused, LaboratoryError::Overflow { .. }),
        "{refused}"
    );
}

/// What is not given comes from the example, but for coefficients that belong to another
/// exponent.
#[test]
fn specimens_are_filled_from_the_example() {
    let law = find("bilinear").unwrap();
    let own = LawParameters::from_pairs(&[("stiffness", STIFFNESS)]);
    let specimen = Specimen::new(law, own).unwrap();
    assert!(!specimen.filled.contains(&"stiffness".to_owned()));
    assert!(specimen.filled.contains(&"yield_force".to_owned()));
    assert_eq!(
        specimen.with_unit("stiffness", STIFFNESS),
        ("2e7 N/m".to_owned(), true)
    );
    let iwan = find("iwan_six_parameter").unwrap();
    let other = LawParameters::from_pairs(&[("exponent", -0.5)]);
    let refused = Specimen::new(iwan, other).map(|_| ()).unwrap_err();
    assert!(refused.to_string().contains("needs density"), "{refused}");
    assert!(
        refused.help().contains("belongs to another exponent"),
        "{}",
        refused.help()
    );
}

/// The slope of a power is its exponent, and a fit finds the density that made a curve.
#[test]
fn slopes_and_fits_give_back_what_was_put_in() {
    let power: Vec<_> = (1..6)
        .map(f64::from)
        .map(|a| (a, 3.0 * a.powf(2.7)))
        .collect();
    assert!((log_slope(&power).unwrap() - 2.7).abs() < 1e-12);
    assert!((0..5).all(|i| (local_slope(&power, i).unwrap() - 2.7).abs() < 1e-12));
    assert_eq!(
        (
            log_slope(&power[..1]),
            local_slope(&[(1.0, 0.0), (2.0, 1.0)], 1)
        ),
        (None, None)
    );

    let density = IwanDensity {
        density: 2.0e6,
        exponent: -0.3,
        phi_1: 0.0,
        phi_2: 1.0e-3,
        slider_stiffness: 4.0e5,
        residual_stiffness: 0.0,
    };
    let amplitudes = (0..12).map(|i| 1.0e-5 * 2.0_f64.powi(i));
    let measured: Vec<_> = amplitudes
        .map(|a| (a, density.cycle_dissipation(a)))
        .collect();
    let start = LawParameters::default();
    assert_eq!(unknowns_of_fit(MeasuredCurve::Dissipation, &start), Ok(4));
    let fit = fit_from_many(
        MeasuredCurve::Dissipation,
        &measured,
        &start,
        FitOptions::default(),
    )
    .unwrap();
    assert!(fit.relative_error < 1e-6, "{fit:?}");
    assert!(
        (fit.density.exponent - density.exponent).abs() < 1e-5,
        "{fit:?}"
    );
    assert!(
        (fit.density.phi_2 / density.phi_2 - 1.0).abs() < 1e-5,
        "{fit:?}"
    );
}
