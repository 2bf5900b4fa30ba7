//! Readers against synthetic files of each form, the records of the repository,
//! and, where they are at hand, real agency files.
use std::path::Path;

use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, ReadOptions, read, read_bytes,
};
use proptest::prelude::*;

fn at2(text: &str) -> Result<Accelerogram, GroundMotionError> {
    read_bytes("record.at2", text.as_bytes(), &ReadOptions::default())
}

const VALUES: &str =
    "  .1000000E-01 -.2000000E-01  .3000000E-01  .4000000E-01 -.5000000E-01\n  .6000000E-01\n";

#[test]
fn every_at2_header() {
    for (counts, dt) in [
        ("NPTS=     6, DT= .01000 SEC", 0.01),
        ("NPTS=     6, dt=  .00244", 0.00244),
        ("NPTS=     6, dt=   .0100 SEC", 0.01),
        ("    6    0.0040    NPTS, DT", 0.004),
        ("NPTS=      6, DT=   .0050 SEC,        ", 0.005),
        (
            "NPTS=      6, DT=   .0050 SEC,   0 POLE @    40.00000 HZ,  -5 POLE @      .05000 HZ, ACAUSAL",
            0.005,
        ),
    ] {
        for end in ["\n", "\r\n", "\r\r\n"] {
            let text = format!("TITLE\nEVENT, STATION, 000\nACCELERATION TIME SERIES IN UNITS OF G\n{counts}\n{VALUES}").replace('\n', end);
            let record = at2(&text).unwrap();
            assert_eq!(record.samples().len(), 6, "{counts}");
            assert_eq!(record.time_step(), dt, "{counts}");
            assert!((record.samples()[1] + 0.02 * 9.80665).abs() < 1e-15);
        }
    }
    let seven = format!("a\nb\nc\nd UNITS OF G\ne\nf\n6 0.0050 NPTS, DT\n{VALUES}");
    assert_eq!(at2(&seven).unwrap().time_step(), 0.005);
    let one_a_line = "t\ne\nIN UNITS OF G\nNPTS=  3, DT= .0050\n.1\n-.2\n.3";
    assert_eq!(at2(one_a_line).unwrap().samples().len(), 3);
    let free = format!(
        "El Centro\n6 points at equal spacing of 0.02 sec\nunits of G\n*** Begin data ***\n{VALUES}*** End Data ***\n\n\n"
    );
    let record = at2(&free).unwrap();
    assert_eq!((record.samples().len(), record.time_step()), (6, 0.02));
}

#[test]
fn velocities_and_displacements_are_refused() {
    for unit in [
        "VELOCITY TIME SERIES IN UNITS OF CM/SEC",
        "VELOCITY IN UNITS OF CM/S",
        "DISPLACEMENT TIME SERIES IN UNITS OF CM",
    ] {
        let text = format!("t\ne\n{unit}\nNPTS=     6, DT= .01000 SEC\n{VALUES}");
        assert!(
            matches!(at2(&text), Err(GroundMotionError::NotAcceleration { .. })),
            "{unit}"
        );
    }
}

#[test]
fn counts_are_held_against_the_header() {
    let text = |n: usize| format!("t\ne\nUNITS OF G\nNPTS=  {n}, DT= .01 SEC\n{VALUES}");
    assert!(matches!(
        at2(&text(7)),
        Err(GroundMotionError::TooFewSamples {
            expected: 7,
            found: 6,
            ..
        })
    ));
    let lenient = ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    };
    let record = read_bytes("r", text(7).as_bytes(), &lenient).unwrap();
    assert!(record.origin().unwrap().warnings[0].contains("7 samples, 6 found and used"));
    assert_eq!(at2(&text(5)).unwrap().samples().len(), 6);
    assert_eq!(at2(&text(3)).unwrap().samples().len(), 3);
}

#[test]
fn fortran_numbers_and_damage() {
    let plain = |text: &str| {
        let options = ReadOptions {
            layout: Some("a".to_owned()),
            unit: Some(AccelerationUnit::MetrePerSecondSquared),
            time_step: Some(0.01),
            ..ReadOptions::default()
        };
        read_bytes("r.txt", text.as_bytes(), &options)
    };
    let record = plain("1.0D-03 1.5-102\n.5 5. +1E0 -0.0\n").unwrap();
    assert_eq!(record.samples(), [1e-3, 1.5e-102, 0.5, 5.0, 1.0, -0.0]);
    for (text, place) in [
        ("0.1 0.2\n0.3 ****\n", "r.txt:2:5"),
        ("0.1\nNaN\n", "r.txt:2:1"),
        ("0.1\ninf\n", "r.txt:2:1"),
    ] {
        let error = plain(text).unwrap_err();
        assert!(error.to_string().starts_with(place), "{error}");
        assert!(error.help().unwrap().contains("get the record again"));
    }
}

#[test]
fn columns_need_a_declared_component() {
    let text = "0.00 1 2\n0.01 3 4\n0.02 5 6\n";
    let options = |component: Option<&str>| ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        layout: Some("t,ns,ew".to_owned()),
        component: component.map(str::to_owned),
        ..ReadOptions::default()
    };
    let record = read_bytes("r", text.as_bytes(), &options(Some("ew"))).unwrap();
    assert_eq!(record.samples(), [0.02, 0.04, 0.06]);
    assert_eq!(record.time_step(), 0.01);
    assert!(read_bytes("r", text.as_bytes(), &options(None)).is_err());
    let uneven = text.replace("0.02 5", "0.03 5");
    assert!(
        read_bytes("r", uneven.as_bytes(), &options(Some("ew")))
            .unwrap_err()
            .to_string()
            .contains("not even")
    );
}

fn repository(name: &str) -> Accelerogram {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../ground_motions")
        .join(name);
    read(&path, &ReadOptions::default()).unwrap()
}

/// Counts and peaks as in ground_motions/README.md.
#[test]
fn records_of_the_repository() {
    let el_centro = repository("el_centro_1940_ns.csv");
    assert_eq!(
        (el_centro.samples().len(), el_centro.time_step()),
        (1559, 0.02)
    );
    assert!((el_centro.peak().value / 9.80665 - 0.31882).abs() < 1e-9);
    assert!((el_centro.peak().time - 2.02).abs() < 1e-12);
    let kobe = repository("kobe_1995_jma_ns.csv");
    assert_eq!((kobe.samples().len(), kobe.time_step()), (2000, 0.02));
    assert!((kobe.peak().value / 9.80665 - 0.837316326531).abs() < 1e-9);
    assert!((kobe.peak().time - 5.52).abs() < 1e-12);
    let scaled = el_centro.scaled_to_peak(1.0).unwrap();
    assert!((scaled.peak().value - 1.0).abs() < 1e-15);
}

proptest! {
    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_bytes("r", &bytes, &ReadOptions::default());
    }

    #[test]
    fn what_is_written_is_read(values in prop::collection::vec(-9.0..9.0_f64, 2..50)) {
        let mut text = "# Unit: m/s2\n# dt: 0.01 s\ntime_s,acceleration_m_s2\n".to_owned();
        for (i, a) in values.iter().enumerate() {
            text.push_str(&format!("{:.2},{a:?}\n", i as f64 * 0.01));
        }
        let record = read_bytes("r.csv", text.as_bytes(), &ReadOptions::default()).unwrap();
        prop_assert_eq!(record.samples(), &values[..]);
    }
}
