//! Units of quantities.
use pounding_case::{UnitError, parse_quantity};

/// Radians and per cent are numbers, and yet no factor of any quantity.
#[test]
fn radians_and_per_cent_beside_other_units() {
    for sound in [
        "0.4 rad",
        "3 rad/s",
        "2 rad/s2",
        "75 GN m/rad",
        "1.1 GN m s/rad",
        "1e6 kg m2/rad",
        "5 %",
        "1e-3 1/m",
    ] {
        assert!(parse_quantity(sound).is_ok(), "{sound}");
    }
    for wrong in ["25 t rad", "3 m rad", "25 t %", "5 % rad", "2 kN m rad"] {
        let error = parse_quantity(wrong).unwrap_err();
        assert!(matches!(error, UnitError::BesideOthers { .. }), "{error}");
        assert!(error.help().contains("leave it out"));
    }
}
