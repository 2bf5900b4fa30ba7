//! Spectra of codes and of files.
use proptest::prelude::*;

use pounding_ground_motion::GroundMotionError;
use pounding_ground_motion::spectra::TargetSpectrum;
use pounding_ground_motion::spectra::design::{
    Asce7Of2016, CodeSpectrum, Eurocode8Of2004, GroundType, SpectrumType,
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

/// EN 1998-1:2004 by hand, ag = 2 m/s2, a period on every branch. Type 1, ground C (S = 1.15,
/// 0.2, 0.6, 2 s): 2.3 (1 + 0.5 * 1.5), 2.3 * 2.5, half of that at twice TC, and
/// 5.75 * 0.6 * 2 / 9 at 3 s. Type 2, ground D (S = 1.8, 0.1, 0.3, 1.2 s) likewise. With 2 %
/// damping eta = sqrt(10/7) on the rising branch as well; with 30 % it is 0.55.
#[test]
fn eurocode_by_hand_on_every_branch() {
    let of = |ground, spectrum, damping| Eurocode8Of2004 {
        ground_acceleration: 2.0,
        ground,
        spectrum,
        damping,
    };
    let first = of(GroundType::C, SpectrumType::Type1, 0.05);
    let second = of(GroundType::D, SpectrumType::Type2, 0.05);
    let light = of(GroundType::C, SpectrumType::Type1, 0.02);
    let heavy = of(GroundType::C, SpectrumType::Type1, 0.3);
    let eta = 1.195_228_609_334_394;
    for (spectrum, period, expected) in [
        (first, 0.0, 2.3),
        (first, 0.1, 4.025),
        (first, 0.2, 5.75),
        (first, 0.4, 5.75),
        (first, 0.6, 5.75),
        (first, 1.2, 2.875),
        (first, 2.0, 1.725),
        (first, 3.0, 5.75 * 0.6 * 2.0 / 9.0),
        (first, 4.0, 0.431_25),
        (second, 0.05, 6.3),
        (second, 0.2, 9.0),
        (second, 0.6, 4.5),
        (second, 2.4, 0.5625),
        (light, 0.1, 2.3 * (1.0 + 0.5 * (2.5 * eta - 1.0))),
        (light, 0.4, 5.75 * eta),
        (light, 3.0, 5.75 * eta * 1.2 / 9.0),
        (heavy, 0.4, 5.75 * 0.55),
    ] {
        let found = spectrum.acceleration(period);
        assert!((found / expected - 1.0).abs() < 1e-12, "{period}: {found}");
        let code = CodeSpectrum::Eurocode8Of2004(spectrum);
        assert_eq!(code.acceleration(period), found);
    }
    // Soil factors and corners of tables 3.2 and 3.3.
    for (kind, rows) in [
        (
            SpectrumType::Type1,
            [
                [1.0, 0.15, 0.4, 2.0],
                [1.2, 0.15, 0.5, 2.0],
                [1.15, 0.2, 0.6, 2.0],
                [1.35, 0.2, 0.8, 2.0],
                [1.4, 0.15, 0.5, 2.0],
            ],
        ),
        (
            SpectrumType::Type2,
            [
                [1.0, 0.05, 0.25, 1.2],
                [1.35, 0.05, 0.25, 1.2],
                [1.5, 0.1, 0.25, 1.2],
                [1.8, 0.1, 0.3, 1.2],
                [1.6, 0.05, 0.25, 1.2],
            ],
        ),
    ] {
        for (ground, row) in GROUNDS.into_iter().zip(rows) {
            let spectrum = of(ground, kind, 0.05);
            assert_eq!(spectrum.acceleration(0.0), 2.0 * row[0]);
            assert_eq!(spectrum.parameters(), row);
        }
    }
    let code = CodeSpectrum::Eurocode8Of2004(second);
    assert_eq!(
        code.title(),
        "eurocode_8_2004, ag 0.203943 g, ground type D, type 2, 5 % damping"
    );
    assert_eq!(code.target().unwrap().name(), code.title());
    assert!(code.check_periods(&[0.01, 4.0]).is_ok());
    assert!(code.check_periods(&[0.01, 4.1]).is_err());
}

/// ASCE/SEI 7-16 by hand with TS = 0.6 s, T0 = 0.12 s: 10 (0.4 + 0.6 * 0.5), the plateau, 6 / T
/// and 6 * 8 / T^2.
#[test]
fn asce_7_by_hand_on_every_branch() {
    let code = CodeSpectrum::Asce7Of2016(Asce7Of2016 {
        short_period: 10.0,
        one_second: 6.0,
        long_transition: 8.0,
    });
    for (period, expected) in [
        (0.06, 7.0),
        (0.12, 10.0),
        (0.3, 10.0),
        (0.6, 10.0),
        (1.2, 5.0),
        (8.0, 0.75),
        (10.0, 0.48),
    ] {
        let found = code.acceleration(period);
        assert!((found / expected - 1.0).abs() < 1e-12, "{period}: {found}");
    }
    assert_eq!(code.damping(), 0.05);
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
