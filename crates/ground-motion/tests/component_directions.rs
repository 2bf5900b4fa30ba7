//! Two components that are combined must be at right angles where their names say directions.
#![allow(clippy::unwrap_used)]

use pounding_ground_motion::processing::{fault_components, rotate};
use pounding_ground_motion::spectra::{Evaluation, rotated_spectrum};
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{Accelerogram, ReadOptions, read_bytes};

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
        ("HNE", "UP", ["\"HNE\" and", "vertical"]),
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
        ("HNE", "HNE"),
        ("", "N-S"),
    ] {
        let (a, b) = (component(a), component(b));
        rotate(&a, &b, 30.0).unwrap();
        rotated_spectrum(&a, &b, &[0.2], 0.05, Evaluation::AtSamples).unwrap();
    }
    // What was turned no longer points where its name says, nor after it was written.
    let (north, east) = (component("N-S"), component("E-W"));
    let once = rotate(&north, &east, 30.0).unwrap();
    rotate(&once.first, &once.second, 10.0).unwrap();
    let text = write_pounding_csv(&Written::of(&once.first)).unwrap();
    let read = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    rotate(&read, &north, 10.0).unwrap();
    // Azimuths that are given may be at any angle of 30 degrees or more.
    let skew = component("N60E");
    fault_components((&north, 0.0), (&skew, 60.0), 20.0).unwrap();
}
