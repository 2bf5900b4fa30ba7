//! Spectra of codes and of files.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;

use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_ground_motion::spectra::design::{
    Asce7Of2016, Eurocode8Of2004, GroundType, SpectrumType,
};

const GROUNDS: [GroundType; 5] = [
    GroundType::A,
    GroundType::B,
    GroundType::C,
    GroundType::D,
    GroundType::E,
];

/// EN 1998-1:2004: ag S at period zero, 2.5 eta ag S on the plateau, continuous at the
/// corners, eta = 1 at 5 % and 0.55 at least (eq. 3.2 to 3.6).
#[test]
fn eurocode() {
    for ground in GROUNDS {
        for kind in [SpectrumType::Type1, SpectrumType::Type2] {
            let spectrum = Eurocode8Of2004 {
                ground_acceleration: 2.0,
                ground,
                spectrum: kind,
                damping: 0.05,
            };
            let [s, b, c, d] = spectrum.parameters();
            assert_eq!(spectrum.acceleration(0.0), 2.0 * s);
            assert!((spectrum.acceleration(0.5 * (b + c)) / (5.0 * s) - 1.0).abs() < 1e-14);
            for corner in [b, c, d] {
                let (before, after) = (corner * (1.0 - 1e-9), corner * (1.0 + 1e-9));
                let ratio = spectrum.acceleration(before) / spectrum.acceleration(after);
                assert!((ratio - 1.0).abs() < 1e-8, "{ground:?} {kind:?} {corner}");
            }
            let target = spectrum.target().unwrap();
            for i in 1..400 {
                let period = 0.01 * f64::from(i);
                let ratio = target.at(period).unwrap() / spectrum.acceleration(period);
                assert!((ratio - 1.0).abs() < 1e-4, "{period} {ratio}");
            }
        }
    }
    let of = |damping| Eurocode8Of2004 {
        ground_acceleration: 1.0,
        ground: GroundType::A,
        spectrum: SpectrumType::Type1,
        damping,
    };
    // sqrt(10/7) at 2 %.
    assert!((of(0.02).acceleration(0.3) / (2.5 * 1.195_228_609_334_394) - 1.0).abs() < 1e-14);
    assert_eq!(of(0.3).acceleration(0.3), 2.5 * 0.55);
    assert!(of(0.5).target().is_err());
}

/// ASCE/SEI 7-16: 0.4 SDS at zero, SDS on the plateau, SD1/T, SD1 TL/T^2, continuous.
#[test]
fn asce_7() {
    let spectrum = Asce7Of2016 {
        short_period: 10.0,
        one_second: 6.0,
        long_transition: 8.0,
    };
    assert_eq!(spectrum.acceleration(0.0), 4.0);
    assert_eq!(spectrum.acceleration(0.3), 10.0);
    assert_eq!(spectrum.acceleration(1.0), 6.0);
    assert_eq!(spectrum.acceleration(16.0), 6.0 * 8.0 / 256.0);
    let target = spectrum.target().unwrap();
    for i in 1..1000 {
        let period = 0.01 * f64::from(i);
        let ratio = target.at(period).unwrap() / spectrum.acceleration(period);
        assert!((ratio - 1.0).abs() < 1e-4, "{period} {ratio}");
    }
    for wrong in [
        Asce7Of2016 {
            one_second: 40.0,
            ..spectrum
        },
        Asce7Of2016 {
            short_period: -1.0,
            ..spectrum
        },
        Asce7Of2016 {
            long_transition: 40.0,
            ..spectrum
        },
    ] {
        assert!(wrong.target().is_err());
    }
}

#[test]
fn a_table() {
    let text = "\u{feff}# from a code\nperiod_s,psa_cm_s2\n0.1, 200\n\n1,100\n";
    let target = TargetSpectrum::parse("t.csv", text, 0.05).unwrap();
    assert_eq!(target.range(), (0.1, 1.0));
    assert!((target.at(0.1).unwrap() - 2.0).abs() < 1e-15);
    // Straight in the logarithms: the geometric mean half way.
    let middle = target.at(0.1_f64.sqrt()).unwrap();
    assert!((middle - 2.0_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn tables_that_are_none() {
    for (text, place, part) in [
        ("", "t.csv:1:1", "no header"),
        ("0.1,2\n", "t.csv:1:1", "not a header with units"),
        ("period_s,psa\n", "t.csv:1:1", "not a header with units"),
        ("period_s,psa_g\n0.1\n", "t.csv:2:1", "two columns"),
        (
            "period_s,psa_g\n0.1,2\n0.2,\u{e9}\n",
            "t.csv:3:5",
            "is not a number",
        ),
        ("period_s,psa_g\nnan,2\n", "t.csv:2:1", "is not a number"),
    ] {
        let error = TargetSpectrum::parse("t.csv", text, 0.05).unwrap_err();
        let message = error.to_string();
        assert!(message.starts_with(place), "{message}");
        assert!(message.contains(part), "{message}");
        assert!(error.help().unwrap().contains("psa_UNIT"));
    }
    let falling = TargetSpectrum::parse("t.csv", "period_s,psa_g\n1,1\n0.5,1\n", 0.05);
    assert!(matches!(
        falling,
        Err(GroundMotionError::NotPossible { .. })
    ));
}

proptest! {
    /// Whatever a table holds: a spectrum, or an error with a remedy.
    #[test]
    fn damaged_tables(text in "(period_s,psa_(g|m_s2)\n)?([0-9.,e# \n-]|\\PC){0,200}") {
        match TargetSpectrum::parse("t.csv", &text, 0.05) {
            Ok(target) => prop_assert!(target.range().0 < target.range().1),
            Err(error) => prop_assert!(error.help().is_some(), "{}", error),
        }
    }
}
