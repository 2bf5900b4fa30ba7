//! Files as agencies publish them, where they are at hand (`../shared` beside the
//! repository): counts, steps and peaks as computed from the samples by an
//! independent script and listed in their `PROVENANCE.md`.
use std::path::{Path, PathBuf};

use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, Quantity, ReadOptions, Recording, Sampling, Series, read,
    read_all,
};

fn native(name: &str) -> Option<PathBuf> {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/ground_motions/native");
    let path = folder.join(name);
    path.exists().then_some(path)
}

/// What one series must be: in the unit of the table, to its last digit.
struct Expected {
    quantity: Quantity,
    component: &'static str,
    count: usize,
    /// Zero where uneven.
    step: f64,
    /// Signed peak in the table's unit, and one unit of its last digit.
    peak: (f64, f64),
    /// One unit of the table in SI.
    unit: f64,
}

const G: f64 = 9.80665;
const ACC: Quantity = Quantity::Acceleration;
const VEL: Quantity = Quantity::Velocity;
const DIS: Quantity = Quantity::Displacement;

fn expected(
    quantity: Quantity,
    component: &'static str,
    count: usize,
    step: f64,
    peak: (f64, f64),
    unit: f64,
) -> Expected {
    Expected {
        quantity,
        component,
        count,
        step,
        peak,
        unit,
    }
}

fn signed_peak(series: &Series) -> f64 {
    series
        .samples
        .iter()
        .fold(0.0, |m: f64, a| if a.abs() > m.abs() { *a } else { m })
}

fn hold(recording: &Recording, table: &[Expected]) {
    assert_eq!(recording.series.len(), table.len());
    for (series, row) in recording.series.iter().zip(table) {
        let label = series.label();
        assert_eq!(series.quantity, row.quantity, "{label}");
        assert_eq!(series.component, row.component, "{label}");
        assert_eq!(series.samples.len(), row.count, "{label}");
        match &series.sampling {
            Sampling::Even { time_step } => assert_eq!(*time_step, row.step, "{label}"),
            Sampling::Uneven { times } => assert_eq!((times.len(), 0.0), (row.count, row.step)),
        }
        let peak = signed_peak(series) / row.unit;
        assert!(
            (peak - row.peak.0).abs() <= 0.5000001 * row.peak.1,
            "{label}: {peak} where the table has {}",
            row.peak.0
        );
        assert!(
            !series.origin.warnings.iter().any(|w| w.contains("header")),
            "{label}: {:?}",
            series.origin.warnings
        );
    }
}

fn check(name: &str, format: &str, options: &ReadOptions, table: &[Expected]) {
    let Some(path) = native(name) else {
        return;
    };
    let recording = read_all(&path, options).unwrap();
    assert_eq!(recording.series[0].origin.format, format);
    hold(&recording, table);
}

fn in_g() -> ReadOptions {
    ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    }
}

#[test]
fn text_without_headers() {
    let none = ReadOptions::default();
    check(
        "ElCentro1940_NS_Peknold__elCentro.AT2",
        "peer_at2",
        &none,
        &[expected(ACC, "", 1559, 0.02, (-0.31882, 1e-5), G)],
    );
    check(
        "ElCentro1940_NS_Caltech__elcentro_NS.dat",
        "plain_columns",
        &in_g(),
        &[expected(ACC, "a", 2688, 0.02, (0.34874, 1e-5), G)],
    );
    check(
        "Kobe1995_JMA_NS__KOBE.txt",
        "plain_columns",
        &in_g(),
        &[expected(ACC, "a", 2000, 0.02, (-0.83732, 1e-5), G)],
    );
    let named = ReadOptions {
        layout: Some("t,ns,ew,v".to_owned()),
        ..in_g()
    };
    // The table prints magnitudes; the signs are those of the lines of the file.
    let rows = |names: [&'static str; 3]| {
        [
            expected(ACC, names[0], 8171, 0.02, (0.09953, 1e-5), G),
            expected(ACC, names[1], 8171, 0.02, (0.17117, 1e-5), G),
            expected(ACC, names[2], 8171, 0.02, (-0.03734, 1e-5), G),
        ]
    };
    let file = "MexicoCitySCT1985__sct190985.txt";
    check(file, "plain_columns", &named, &rows(["ns", "ew", "v"]));
    check(
        file,
        "plain_columns",
        &in_g(),
        &rows(["column_2", "column_3", "column_4"]),
    );
    if let Some(path) = native(file) {
        assert!(matches!(
            read(&path, &named),
            Err(GroundMotionError::AmbiguousSeries { available, .. }) if available.len() == 3
        ));
        assert!(matches!(
            read_all(&path, &none),
            Err(GroundMotionError::MissingUnit { .. })
        ));
    }
}

#[test]
fn volumes() {
    let none = ReadOptions::default();
    check(
        "ElCentro1940_S90W_CaltechVol2__USACA47.035.txt",
        "caltech_volume_2",
        &none,
        &[
            expected(ACC, "S90W", 2674, 0.02, (-210.142, 1e-3), 0.01),
            expected(VEL, "S90W", 2674, 0.02, (36.929, 1e-3), 0.01),
            expected(DIS, "S90W", 2674, 0.02, (19.344, 1e-3), 0.01),
        ],
    );
    check(
        "Ferndale2022_Fortuna_CE89486__ce89486SampleInput.v2",
        "csmip_v2",
        &none,
        &[
            expected(ACC, "180 deg", 10100, 0.01, (-388.166, 1e-3), 0.01),
            expected(VEL, "180 deg", 10100, 0.01, (34.735, 1e-3), 0.01),
            expected(DIS, "180 deg", 10100, 0.01, (8.2282, 1e-4), 0.01),
            expected(ACC, "90 deg", 10100, 0.01, (-261.805, 1e-3), 0.01),
            expected(VEL, "90 deg", 10100, 0.01, (15.740, 1e-3), 0.01),
            expected(DIS, "90 deg", 10100, 0.01, (-3.0693, 1e-4), 0.01),
            expected(ACC, "Up", 10100, 0.01, (-108.852, 1e-3), 0.01),
            expected(VEL, "Up", 10100, 0.01, (3.583, 1e-3), 0.01),
            expected(DIS, "Up", 10100, 0.01, (-0.9487, 1e-4), 0.01),
        ],
    );
    check(
        "Northridge1994_LA116thSt_CE14403__LA116TH.RAW",
        "csmip_v1",
        &none,
        &[
            expected(ACC, "90 deg", 11999, 0.0, (-0.2003, 1e-4), G),
            expected(ACC, "UP", 11998, 0.0, (0.0604, 1e-4), G),
            expected(ACC, "360 deg", 11998, 0.0, (-0.1428, 1e-4), G),
        ],
    );
    check(
        "Ridgecrest2019_ChinaLake_CICLC__CICLC.v1",
        "csmip_v1",
        &none,
        &[
            expected(ACC, "90 deg", 31932, 0.01, (0.34425, 1e-5), G),
            expected(ACC, "360 deg", 32080, 0.01, (0.51080, 1e-5), G),
            expected(ACC, "Up", 32190, 0.01, (0.34709, 1e-5), G),
        ],
    );
}

/// The trapezoid rule from the file's first velocity keeps within 0.144 cm/s of the
/// agency's velocity and ends within 1e-6 cm/s of it; from velocity to displacement
/// it keeps within 0.0033 cm.
#[test]
fn velocity_and_displacement_of_the_agency() {
    let Some(path) = native("Ferndale2022_Fortuna_CE89486__ce89486SampleInput.v2") else {
        return;
    };
    let recording = read_all(&path, &ReadOptions::default()).unwrap();
    let [acceleration, velocity, displacement] = &recording.series[..3] else {
        panic!("nine series");
    };
    let (v0, d0) = acceleration.initial.unwrap();
    let apart = |from: &[f64], start: f64, to: &[f64]| {
        let mut sum = start;
        let (mut most, mut last) = (0.0_f64, 0.0_f64);
        for i in 0..to.len() {
            if i > 0 {
                sum += 0.005 * (from[i - 1] + from[i]);
            }
            last = (sum - to[i]).abs();
            most = most.max(last);
        }
        (most, last)
    };
    let (most, last) = apart(&acceleration.samples, v0, &velocity.samples);
    assert!(most < 0.1445e-2 && last < 1e-8, "{most} {last}");
    let (most, _) = apart(&velocity.samples, d0, &displacement.samples);
    assert!(most < 0.00335e-2, "{most}");
}

#[test]
fn other_agencies() {
    let none = ReadOptions::default();
    check(
        "LomaPrieta1989_APEEL2_NP1002__np01002p_4225a_a.smc",
        "usgs_smc",
        &none,
        // The table has -222.519 from the header; the sample is printed -2.2252E+2.
        &[expected(ACC, "133", 7183, 0.005, (-222.52, 1e-2), 0.01)],
    );
    check(
        "Kaikoura2016_HSES__20161113_110300_HSES_20.V1A",
        "geo_net",
        &none,
        &[
            expected(ACC, "N10E", 65536, 0.005, (2394.8, 0.1), 0.001),
            expected(ACC, "N80W", 65536, 0.005, (2584.4, 0.1), 0.001),
            expected(ACC, "Up", 65536, 0.005, (-1589.9, 0.1), 0.001),
        ],
    );
    check(
        "Anchorage2018_AKBMR_BNZ__akbmrp.acc.V2c",
        "cosmos",
        &none,
        &[expected(ACC, "Other", 42000, 0.005, (-6.85151, 1e-5), 0.01)],
    );
    check(
        "Kahramanmaras2023_TK3116_E__20230206011732_3116_mp_Acc_E.asc",
        "dyna",
        &none,
        &[expected(ACC, "HNE", 12500, 0.01, (-161.787, 1e-3), 0.01)],
    );
}

#[test]
fn pads_of_geo_net() {
    let Some(path) = native("Waipukurau2018_WPWS__20180212_211557_WPWS_20.V2A") else {
        return;
    };
    let recording = read_all(&path, &ReadOptions::default()).unwrap();
    assert_eq!(recording.series.len(), 9);
    let accelerations: Vec<&Series> = recording
        .series
        .iter()
        .filter(|s| s.quantity == ACC)
        .collect();
    for (series, (name, peak)) in
        accelerations
            .iter()
            .zip([("S16W", -41.6), ("S74E", -194.0), ("Up", -27.3)])
    {
        assert_eq!(series.component, name);
        assert_eq!(series.samples.len(), 5800);
        assert_eq!(series.sampling, Sampling::Even { time_step: 0.02 });
        assert!((signed_peak(series) - peak * 0.001).abs() < 1e-12);
        assert_eq!(
            series.origin.warnings.len(),
            1,
            "{:?}",
            series.origin.warnings
        );
        assert!(series.origin.warnings[0].contains("5.000 s of zeros"));
    }
    // Printed at 43.68 s, sample 2434 x 0.02 s, 5 s of pad.
    assert!((accelerations[0].peak().time - 48.68).abs() < 1e-9);
}

/// One instrument, one event, two formats: 0.34425 g against 336.68 cm/s2.
#[test]
fn one_record_in_two_formats() {
    let Some(counts) = native("Ridgecrest2019_ChinaLake_CICLC__CI.CLC..HNE.mseed") else {
        return;
    };
    assert!(matches!(
        read(&counts, &ReadOptions::default()),
        Err(GroundMotionError::MissingSensitivity { .. })
    ));
    let options = ReadOptions {
        sensitivity: Some(213_945.0),
        ..ReadOptions::default()
    };
    let recording = read_all(&counts, &options).unwrap();
    assert_eq!(recording.series.len(), 1);
    let series = &recording.series[0];
    assert_eq!(
        (series.samples.len(), series.component.as_str()),
        (39001, "HNE")
    );
    // The mean in counts as the table has it.
    assert!((series.mean() * 213_945.0 + 38_071.67).abs() < 0.005);
    let seed = read(&counts, &options).unwrap();
    assert_eq!(seed.time_step(), 0.01);
    assert!((seed.peak().value * 100.0 - 336.68).abs() <= 0.005);
    let path = native("Ridgecrest2019_ChinaLake_CICLC__CICLC.v1").unwrap();
    let volume = read(
        &path,
        &ReadOptions {
            component: Some("90".to_owned()),
            ..ReadOptions::default()
        },
    )
    .unwrap();
    let ratio = seed.peak().value / volume.peak().value;
    assert!((ratio - 0.34332 / 0.34425).abs() < 5e-5, "{ratio}");
}

/// Uneven pairs are refused without a step and resampled with one.
#[test]
fn uneven_pairs() {
    let Some(path) = native("Northridge1994_LA116thSt_CE14403__LA116TH.RAW") else {
        return;
    };
    let options = |step| ReadOptions {
        component: Some("1".to_owned()),
        time_step: step,
        ..ReadOptions::default()
    };
    assert!(matches!(
        read(&path, &options(None)),
        Err(GroundMotionError::Uneven { count: 11999, .. })
    ));
    assert!(matches!(
        read(&path, &options(Some(0.02))),
        Err(GroundMotionError::Uneven { .. })
    ));
    let record = read(&path, &options(Some(0.005))).unwrap();
    assert_eq!(record.samples().len(), 12000);
    assert!((record.peak().value / G - 0.2003).abs() < 0.002);
}
