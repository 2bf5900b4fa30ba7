//! Raw records of seven agencies as they publish them, where they are at hand (`../shared` beside
//! the repository). Counts, steps, times and peaks are those of a script of its own that knows
//! the layouts and nothing of this library; peaks of headers are met to their last digit.
use std::path::{Path, PathBuf};

use pounding_ground_motion::{
    GroundMotionError, Quantity, ReadOptions, Recording, Sampling, read, read_all,
};

const G: f64 = 9.80665;
const ACAC: [f64; 3] = [-0.1108, 0.5501, 0.0628];
const CUP5: [f64; 3] = [0.036, 0.098, -0.057];
/// Peak, last and first value.
const BHRC: [(f64, f64, f64); 3] = [
    (-0.0591538, -0.0054428, 0.00921041),
    (-0.0650066, 0.00794424, -0.00178245),
    (-0.131972, -0.0245355, 0.0047757),
];
/// Peak with its time, first and last value.
const HESPERIA: [((f64, f64), f64, f64); 3] = [
    ((0.057921, 9.425), -0.000116, -0.00205),
    ((0.04203, 10.235), -0.000196, -0.000196),
    ((-0.090583, 9.615), -0.000233, -0.002198),
];

fn file(name: &str) -> Option<PathBuf> {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/ground_motions/agency_more");
    let path = folder.join(name);
    path.exists().then_some(path)
}

/// What a series must be, in the unit of the file.
struct Expected {
    component: &'static str,
    count: usize,
    /// Step (s), or the last time of uneven ones.
    step: Result<f64, f64>,
    /// Signed peak of the samples and its time (s).
    peak: (f64, f64),
    first: f64,
    last: f64,
    /// Peak in the header as printed, and one unit of its last digit.
    header: Option<(f64, f64)>,
}

fn check(name: &str, format: &str, unit: f64, table: &[Expected]) -> Option<Recording> {
    let recording = read_all(&file(name)?, &ReadOptions::default()).unwrap();
    assert_eq!(recording.series.len(), table.len(), "{name}");
    for (series, row) in recording.series.iter().zip(table) {
        let label = format!("{name} {}", series.label());
        assert_eq!(series.origin.format, format, "{label}");
        assert_eq!(series.quantity, Quantity::Acceleration, "{label}");
        assert_eq!(series.component, row.component, "{label}");
        assert_eq!(series.samples.len(), row.count, "{label}");
        match (&series.sampling, row.step) {
            (Sampling::Even { time_step }, Ok(step)) => {
                assert!(
                    (time_step - step).abs() < 1e-12 * step,
                    "{label}: {time_step}"
                );
            }
            (Sampling::Uneven { times }, Err(end)) => {
                assert_eq!(times.last(), Some(&end), "{label}");
            }
            (found, _) => panic!("{label}: {found:?}"),
        }
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs().max(1.0e-3);
        let (value, time) = series.signed_peak();
        assert!(near(value / unit, row.peak.0), "{label}: {}", value / unit);
        assert!((time - row.peak.1).abs() < 1e-9, "{label}: {time}");
        assert!(near(series.samples[0] / unit, row.first), "{label}");
        let last = series.samples[row.count - 1] / unit;
        assert!(near(last, row.last), "{label}: {last}");
        match (series.header_peak, row.header) {
            (None, None) => {}
            (Some(found), Some((printed, digit))) => {
                let found = found.value / found.unit_in_si;
                assert!(near(found, printed), "{label}: {found}");
                // Rounded to the digits of the header, or of the samples where these have
                // fewer, both are the same number.
                let rounded = |value: f64| (value.abs() / digit).round();
                assert_eq!(rounded(row.peak.0), rounded(printed), "{label}");
            }
            (found, wanted) => panic!("{label}: {found:?} {wanted:?}"),
        }
        let contradicts = |w: &&String| w.contains("peak");
        assert_eq!(
            series.origin.warnings.iter().find(contradicts),
            None,
            "{label}"
        );
    }
    Some(recording)
}

#[test]
fn unam() {
    let row = |component, count, step, peak, first, last, header| Expected {
        component,
        count,
        step: Ok(step),
        peak,
        first,
        last,
        header: Some(header),
    };
    check(
        "ACAC1709.191",
        "asa",
        0.01,
        &[
            row(
                "V",
                35_600,
                0.005,
                (25.6114, 53.455),
                -0.0083,
                ACAC[0],
                (25.6114, 1e-4),
            ),
            row(
                "N00E",
                35_600,
                0.005,
                (58.7394, 80.555),
                -0.0214,
                ACAC[1],
                (58.7394, 1e-4),
            ),
            row(
                "N90E",
                35_600,
                0.005,
                (-42.3377, 81.47),
                0.0,
                ACAC[2],
                (-42.3377, 1e-4),
            ),
        ],
    );
    // The file holds two rows more than the header says.
    check(
        "CUP50401.012",
        "asa",
        0.01,
        &[
            row(
                "V",
                17_500,
                0.004,
                (0.47, 42.36),
                -0.084,
                CUP5[0],
                (0.47, 1e-2),
            ),
            row(
                "N90E",
                17_500,
                0.004,
                (-1.189, 38.052),
                -0.052,
                CUP5[1],
                (-1.19, 1e-2),
            ),
            row(
                "N00E",
                17_500,
                0.004,
                (1.216, 40.204),
                0.108,
                CUP5[2],
                (1.22, 1e-2),
            ),
        ],
    );
}

#[test]
fn smc() {
    let even = |count, peak, first, last, header| Expected {
        component: "90",
        count,
        step: Ok(0.005),
        peak,
        first,
        last,
        header: Some(header),
    };
    check(
        "2825.HNE.NP.--_u.smc",
        "usgs_smc",
        0.01,
        &[even(
            44_800,
            (-35.339, 80.76),
            -16.419,
            -16.625,
            (-35.339_299, 1e-3),
        )],
    );
    check(
        "0165a_u.smc",
        "usgs_smc",
        0.01,
        &[even(6012, (-263.49, 3.4), 1.054, 5.7966, (-263.4864, 1e-2))],
    );
    // Digitised film: the header counts numbers, and a row that it does not count goes back in
    // time. Two values have the printed time of the value before.
    let film = Expected {
        component: "43",
        count: 24_784,
        step: Err(35.969),
        peak: (290.86, 6.8603),
        first: -0.060_758,
        last: 7.929,
        header: Some((290.8617, 1e-2)),
    };
    if let Some(recording) = check("np01002r_4225c_u.smc", "usgs_smc", 0.01, &[film]) {
        let series = &recording.series[0];
        let Sampling::Uneven { times } = &series.sampling else {
            panic!()
        };
        assert!(times.windows(2).all(|t| t[1] > t[0]));
        let tied = |w: &String| w.starts_with("2 values are printed with the time");
        assert!(series.origin.warnings.iter().any(tied));
        let path = file("np01002r_4225c_u.smc").unwrap();
        assert!(matches!(
            read(&path, &ReadOptions::default()),
            Err(GroundMotionError::Uneven { count: 24_784, .. })
        ));
        let options = ReadOptions {
            time_step: Some(0.001),
            ..ReadOptions::default()
        };
        assert_eq!(read(&path, &options).unwrap().samples().len(), 35_970);
    }
}

#[test]
fn usc() {
    for (name, component, count, end, peak, first, last) in [
        (
            "274o42pv.s0a",
            "S58W",
            2275,
            11.435,
            (0.071, 0.625),
            -0.026,
            -0.012,
        ),
        (
            "017m30ah.m0a",
            "N90E",
            4960,
            42.145,
            (0.673, 12.217),
            -0.066,
            0.073,
        ),
        (
            "017m30lw.e0b",
            "UP",
            7070,
            30.034,
            (-1.113, 5.543),
            0.099,
            0.004,
        ),
    ] {
        let row = Expected {
            component,
            count,
            step: Err(end),
            peak,
            first,
            last,
            header: None,
        };
        check(name, "caltech_volume_1", 0.1 * G, &[row]);
    }
}

/// Microvolts a count and volts per g of the header: 0.298024e-6 / 1.2553 g.
#[test]
fn cosmos_v0() {
    let row = Expected {
        component: "90 Deg",
        count: 42_000,
        step: Ok(0.005),
        peak: (-1_033_406.0, 45.58),
        first: -160_876.0,
        last: -163_466.0,
        header: Some((1_033_406.0, 1.0)),
    };
    let each = 0.298_024e-6 / 1.2553 * G;
    if let Some(recording) = check("NP8040-n.1000hyfh.HNE.01.V0c", "cosmos", each, &[row]) {
        assert_eq!(recording.series[0].unit, "counts");
    }
}

#[test]
fn bhrc() {
    let row = |component, peak, first, last| Expected {
        component,
        count: 9472,
        step: Ok(0.005),
        peak,
        first,
        last,
        header: None,
    };
    check(
        "5526-1.V1",
        "bhrc",
        0.1 * G,
        &[
            row("L 50 deg", (BHRC[0].0, 16.37), 0.921_041e-2, BHRC[0].1),
            row("V", (BHRC[1].0, 0.785), BHRC[1].2, BHRC[1].1),
            row("T 140 deg", (BHRC[2].0, 15.615), BHRC[2].2, -0.245_355e-1),
        ],
    );
    if let Some(path) = file("5526-1.V1") {
        for (component, name) in [("T", "T 140 deg"), ("140", "T 140 deg"), ("2", "V")] {
            let options = ReadOptions {
                component: Some(component.to_owned()),
                ..ReadOptions::default()
            };
            let record = read(&path, &options).unwrap();
            assert_eq!(record.origin().unwrap().component, name);
        }
        assert!(matches!(
            read(&path, &ReadOptions::default()),
            Err(GroundMotionError::AmbiguousSeries { available, .. }) if available.len() == 3
        ));
    }
}

#[test]
fn nsmn() {
    let row = |component, peak: (f64, f64), first, last, header| Expected {
        component,
        count: 28_683,
        step: Ok(0.01),
        peak,
        first,
        last,
        header: Some((header, 1e-6)),
    };
    check(
        "20170720223109_0921.txt",
        "nsmn",
        0.01,
        &[
            row(
                "N-S",
                (13.200_332, 54.39),
                0.000_909,
                -0.001_613,
                13.200_332,
            ),
            row(
                "E-W",
                (12.163_827, 60.25),
                -0.000_191,
                0.001_041,
                12.163_827,
            ),
            row("U-D", (-9.840_572, 38.95), -0.000_092, 0.000_108, 9.840_572),
        ],
    );
}

#[test]
fn csmip() {
    let row = |component, peak, first, last, header| Expected {
        component,
        count: 12_001,
        step: Ok(0.005),
        peak,
        first,
        last,
        header: Some(header),
    };
    check(
        "ce23583r_HESPERIA.RAW",
        "csmip_v1",
        G,
        &[
            row(
                "90 deg",
                HESPERIA[0].0,
                HESPERIA[0].1,
                HESPERIA[0].2,
                (0.058, 1e-3),
            ),
            row(
                "UP",
                HESPERIA[1].0,
                HESPERIA[1].1,
                HESPERIA[1].2,
                (0.042, 1e-3),
            ),
            row(
                "180 deg",
                HESPERIA[2].0,
                HESPERIA[2].1,
                HESPERIA[2].2,
                (-0.091, 1e-3),
            ),
        ],
    );
    if let Some(path) = file("CE89146.V3") {
        assert!(matches!(
            read_all(&path, &ReadOptions::default()),
            Err(GroundMotionError::Unsupported { what, .. }) if what.contains("spectra")
        ));
    }
}
