//! Two components that are combined must be at right angles where their names say directions.
use pounding_ground_motion::processing::{fault_components, rotate};
use pounding_ground_motion::spectra::{Evaluation, rotated_spectrum};
use pounding_ground_motion::writers::{Written, write_peer_at2, write_pounding_csv};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, Orientation, ReadOptions, read_bytes,
};

use crate::common::binary::sac_with;

/// A record of a component.
fn component(name: &str) -> Accelerogram {
    let rows: String = (0..50)
        .map(|i| format!("{},{}\n", f64::from(i) * 0.01, f64::from(i % 7) - 3.0))
        .collect();
    let text = format!("# Component: {name}\n# dt: 0.01 s\ntime_s,acceleration_m_s2\n{rows}");
    read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap()
}

#[test]
fn components_that_are_not_at_right_angles_are_refused() {
    for (a, b, words) in [
        (
            "N-S",
            "N-S",
            ["\"N-S\" (azimuth 0 degrees) and", "azimuth 0"],
        ),
        ("N-S", "S00E", ["azimuth 0", "azimuth 180"]),
        ("N-S", "UP", ["azimuth 0", "\"UP\" (vertical)"]),
        (
            "HNE",
            "UP",
            ["\"HNE\" (azimuth 90 degrees) and", "vertical"],
        ),
        (
            "HNE",
            "HNZ",
            ["\"HNE\" (azimuth 90 degrees) and", "vertical"],
        ),
        ("HNE", "HNE", ["azimuth 90", "azimuth 90"]),
        ("10.HNE", "20.HNE", ["azimuth 90", "azimuth 90"]),
        ("HN1", "BHZ", ["\"HN1\" and", "vertical"]),
        ("NS2", "UD2", ["azimuth 0", "vertical"]),
        ("NS2", "NS2", ["azimuth 0", "azimuth 0"]),
        ("N30E", "N60E", ["azimuth 30", "azimuth 60"]),
        ("0", "88", ["azimuth 0", "azimuth 88"]),
    ] {
        let (a, b) = (component(a), component(b));
        for error in [
            rotate(&a, &b, 30.0).unwrap_err(),
            rotated_spectrum(&a, &b, &[0.2], 0.05, Evaluation::AtSamples).unwrap_err(),
        ] {
            let shown = error.to_string();
            assert!(
                words.iter().all(|w| shown.contains(w)),
                "{words:?}: {shown}"
            );
            assert!(error.help().unwrap().contains("N-S and E-W"), "{shown}");
        }
    }
}

#[test]
fn right_angles_and_unknown_directions_are_combined() {
    for (a, b) in [
        ("N-S", "E-W"),
        ("E-W", "N-S"),
        ("N30E", "N60W"),
        ("10", "280"),
        ("360", "91 deg"),
        ("H1", "H2"),
        ("1", "2"),
        ("HNE", "HNN"),
        ("HN1", "HN2"),
        ("HN1", "HN1"),
        ("NS2", "EW2"),
        ("NS1", "EW1"),
        ("", "N-S"),
    ] {
        let (a, b) = (component(a), component(b));
        rotate(&a, &b, 30.0).unwrap();
        rotated_spectrum(&a, &b, &[0.2], 0.05, Evaluation::AtSamples).unwrap();
    }
    // What was turned no longer points where its name said, nor after it was written.
    let (north, east) = (component("N-S"), component("E-W"));
    let once = rotate(&north, &east, 30.0).unwrap();
    rotate(&once.first, &once.second, 10.0).unwrap();
    for text in [
        write_pounding_csv(&Written::of(&once.first)).unwrap(),
        write_peer_at2(&Written::of(&once.first)),
    ] {
        let read = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(read.origin().unwrap().component, "30 deg");
        let said = rotate(&read, &north, 10.0).unwrap_err().to_string();
        assert!(said.contains("azimuth 30 degrees"), "{said}");
        rotate(&read, &once.second, 10.0).unwrap();
    }
    // Azimuths that are given may be at any angle of 30 degrees or more.
    let skew = component("N60E");
    fault_components((&north, 0.0), (&skew, 60.0), 20.0).unwrap();
}

/// The azimuth of what is turned, or a name that says none.
#[test]
fn names_of_turned_components() {
    let names = |a: &str, b: &str, angle: f64| {
        let pair = rotate(&component(a), &component(b), angle).unwrap();
        [pair.first, pair.second].map(|one| one.origin().unwrap().component.clone())
    };
    // A quarter turn clockwise, or the other way.
    assert_eq!(names("N00E", "N90E", 90.0), ["90 deg", "180 deg"]);
    assert_eq!(names("N90E", "N00E", 30.0), ["60 deg", "330 deg"]);
    assert_eq!(names("HNN", "HNE", -30.5), ["329.5 deg", "59.5 deg"]);
    assert_eq!(names("N00E", "N90E", 0.0), ["N00E", "N90E"]);
    assert_eq!(
        names("H1", "10.HNE", 30.0),
        [
            "H1 turned by 30 degrees towards 10.HNE",
            "10.HNE turned by 30 degrees away from H1"
        ]
    );
    // No reader takes such a name for that of a direction.
    let pair = rotate(&component("H1"), &component("10.HNE"), 30.0).unwrap();
    let text = write_peer_at2(&Written::of(&pair.first));
    let read = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    for other in ["N00E", "N30E", "N90E"] {
        rotate(&read, &component(other), 10.0).unwrap();
    }
    let fault = fault_components((&component("N-S"), 0.0), (&component("E-W"), 90.0), 40.0);
    let fault = fault.unwrap();
    assert_eq!(fault.first.origin().unwrap().component, "40 deg");
    assert_eq!(fault.second.origin().unwrap().component, "130 deg");
}

/// The instruments of KiK-net in the borehole and at the surface.
#[test]
fn components_of_two_depths_are_refused() {
    let (down, up) = (component("NS1"), component("EW2"));
    for error in [
        rotate(&down, &up, 30.0).unwrap_err(),
        rotated_spectrum(&down, &up, &[0.2], 0.05, Evaluation::AtSamples).unwrap_err(),
    ] {
        let shown = error.to_string();
        assert!(shown.contains("two depths"), "{shown}");
    }
}

fn sac(
    name: &str,
    angles: Option<(f32, f32)>,
    kind: i32,
) -> Result<Accelerogram, GroundMotionError> {
    let (azimuth, incidence) = angles.unwrap_or((-12345.0, -12345.0));
    let floats = [(57, azimuth), (58, incidence)];
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    read_bytes("f", &sac_with(&floats, &[(86, kind)], name), &options)
}

/// The angles of a SAC header go before its name.
#[test]
fn directions_of_sac() {
    let read = |name: &str, angles| sac(name, Some(angles), 8).unwrap();
    let (one, two) = (read("1", (30.0, 90.0)), read("2", (120.0, 90.0)));
    rotate(&one, &two, 30.0).unwrap();
    for (other, words) in [
        (read("2", (60.0, 90.0)), "azimuth 60"),
        (read("3", (0.0, 0.0)), "dip -90"),
        (read("3", (0.0, 180.0)), "dip 90"),
    ] {
        let error = rotate(&one, &other, 30.0).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    // Our CSV keeps them.
    let text = write_pounding_csv(&Written::of(&two)).unwrap();
    let back = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    let expected = Some(Orientation {
        azimuth: 120.0,
        dip: 0.0,
    });
    assert_eq!(back.origin().unwrap().orientation, expected);
    let turned = rotate(&one, &two, 30.0).unwrap().first;
    let expected = Some(Orientation {
        azimuth: 60.0,
        dip: 0.0,
    });
    assert_eq!(turned.origin().unwrap().orientation, expected);
    let warns = |record: &Accelerogram, words: &str| {
        let warnings = &record.origin().unwrap().warnings;
        warnings.iter().any(|w| w.contains(words))
    };
    assert!(!warns(&read("HNE", (94.0, 90.0)), "component HNE"));
    assert!(warns(
        &read("HNE", (120.0, 90.0)),
        "points elsewhere than its name"
    ));
    assert!(warns(
        &read("HNE", (270.0, 90.0)),
        "the other way than its name"
    ));
    assert!(warns(
        &read("HNZ", (0.0, 180.0)),
        "the other way than its name"
    ));
    assert!(!warns(&sac("HNZ", None, 8).unwrap(), "component HNZ"));
}

/// What SAC files hold besides accelerations.
#[test]
fn kinds_of_sac() {
    for (name, kind, words) in [
        ("HNE", 50, "IVOLTS"),
        ("HNE", 51, "of kind 51"),
        ("HNE", 7, "velocity"),
        ("HHZ", 5, "HHZ is that of a seismometer"),
        ("BLE", -12345, "BLE is that of a seismometer"),
    ] {
        let error = sac(name, None, kind).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    for (name, kind) in [("HHZ", 8), ("HNZ", 5), ("HNZ", -12345), ("", -12345)] {
        sac(name, None, kind).unwrap();
    }
}
