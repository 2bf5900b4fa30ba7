//! Every format from a file in its exact layout, and the traps that files set.
use crate::common::{self, COUNT, Fixture, all};
use pounding_ground_motion::{
    AccelerationUnit, Format, GroundMotionError, Offset, ReadOptions, Sampling, read_all_bytes,
    read_bytes,
};

/// Reads the file and holds everything against the truth.
fn hold(fixture: &Fixture, bytes: &[u8], what: &str) {
    let name = format!("{} {what}", fixture.name);
    let recording = read_all_bytes("file", bytes, &fixture.options)
        .unwrap_or_else(|e| panic!("{name}: {e} ({:?})", e.help()));
    assert_eq!(recording.series.len(), fixture.truth.len(), "{name}");
    for (series, truth) in recording.series.iter().zip(&fixture.truth) {
        assert_eq!(series.origin.format, fixture.format, "{name}");
        assert_eq!(series.quantity, truth.quantity, "{name}");
        assert_eq!(series.component, truth.component, "{name}");
        assert_eq!(series.samples.len(), truth.samples.len(), "{name}");
        for (a, b) in series.samples.iter().zip(&truth.samples) {
            assert!(
                (a - b).abs() <= 4.0 * f64::EPSILON * b.abs(),
                "{name}: {a} {b}"
            );
        }
        match (&series.sampling, &truth.times) {
            (Sampling::Even { time_step }, None) => {
                assert!(
                    (time_step - truth.step).abs() <= 1e-15,
                    "{name}: {time_step}"
                );
            }
            (Sampling::Uneven { times }, Some(expected)) => assert_eq!(times, expected, "{name}"),
            (found, _) => panic!("{name}: {found:?}"),
        }
    }
}

#[test]
fn every_format_reads_and_agrees_with_its_header() {
    for fixture in all(0) {
        hold(&fixture, &fixture.bytes, "as written");
        let recording = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
        for series in &recording.series {
            let of_header = |w: &&String| w.contains("header") || w.contains("peak");
            let found = series.origin.warnings.iter().find(of_header);
            assert_eq!(found, None, "{} {}", fixture.name, series.label());
        }
    }
}

#[test]
fn every_format_is_found_by_its_name() {
    for format in Format::all() {
        assert_eq!(Format::find(format.name).unwrap(), *format);
        for text in [format.title, format.source, format.recognised_by] {
            assert!(!text.is_empty(), "{}", format.name);
        }
    }
    let error = Format::find("peer_at").unwrap_err();
    assert_eq!(error.to_string(), "unknown record format \"peer_at\"");
    let help = error.help().unwrap();
    assert!(help.starts_with("did you mean \"peer_at2\"? known formats are mini_seed_2, sac, "));
    let unlike = Format::find("spreadsheet").unwrap_err().help().unwrap();
    assert!(
        unlike.starts_with("known formats are mini_seed_2"),
        "{unlike}"
    );
}

/// The ends of lines and of the file do not matter, nor does a byte order mark.
#[test]
fn line_ends() {
    for fixture in all(0) {
        if matches!(fixture.format, "mini_seed_2" | "sac") {
            continue;
        }
        let with = |end: &[u8]| -> Vec<u8> {
            let lines: Vec<&[u8]> = fixture.bytes.split(|b| *b == b'\n').collect();
            lines.join(end)
        };
        for (what, end) in [
            ("CRLF", &b"\r\n"[..]),
            ("CR CR LF", b"\r\r\n"),
            ("CR", b"\r"),
        ] {
            hold(&fixture, &with(end), what);
        }
        let mut bytes = fixture.bytes.clone();
        while bytes.last() == Some(&b'\n') {
            bytes.pop();
        }
        hold(&fixture, &bytes, "no last newline");
        let mut marked = b"\xef\xbb\xbf".to_vec();
        marked.extend(&fixture.bytes);
        hold(&fixture, &marked, "byte order mark");
        // Blanks at the ends of lines, as card images have.
        hold(&fixture, &with(b"   \n"), "trailing blanks");
    }
}

/// One sample fewer than the header says is an error, one more a warning.
#[test]
fn counts_off_by_one() {
    for fixture in all(1).iter().filter(|f| f.counted) {
        let error = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap_err();
        let named = matches!(
            error,
            GroundMotionError::TooFewSamples { expected, found, .. }
                if expected == COUNT + 1 && found == COUNT
        );
        // GeoNet has no labels: the next block stands where the value should, and
        // the error is found where that block ends.
        let later = matches!(error, GroundMotionError::TooFewSamples { line, .. } if line > 26);
        assert!(
            named || later && fixture.format == "geo_net",
            "{}: {error}",
            fixture.name
        );
        if fixture.format != "geo_net" {
            let lenient = ReadOptions {
                lenient: true,
                ..fixture.options.clone()
            };
            let recording = read_all_bytes("file", &fixture.bytes, &lenient).unwrap();
            for series in recording.series {
                assert_eq!(series.samples.len(), COUNT, "{}", fixture.name);
                assert!(
                    series
                        .origin
                        .warnings
                        .iter()
                        .any(|w| w.contains("24 samples, 23 found")),
                    "{}: {:?}",
                    fixture.name,
                    series.origin.warnings
                );
            }
        }
    }
    for fixture in all(-1).iter().filter(|f| f.counted) {
        let recording = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
        for series in recording.series {
            assert_eq!(series.samples.len(), COUNT, "{}", fixture.name);
            assert!(
                series
                    .origin
                    .warnings
                    .iter()
                    .any(|w| w.contains("one more found")),
                "{}: {:?}",
                fixture.name,
                series.origin.warnings
            );
        }
    }
}

/// Fixed fields that are blank, overflown or missing: the place is named.
#[test]
fn damaged_fields() {
    for fixture in all(0) {
        if matches!(fixture.format, "mini_seed_2" | "sac") {
            continue;
        }
        let text = String::from_utf8_lossy(&fixture.bytes).into_owned();
        // The last number of the data of the first block with nine digits or so.
        let lines: Vec<&str> = text.lines().collect();
        let numeric = |l: &&str| {
            l.len() > 6
                && l.contains('.')
                && l.bytes()
                    .all(|b| b.is_ascii_digit() || b" +-.,;\tEDed".contains(&b))
        };
        let Some(at) = lines.iter().rposition(numeric) else {
            continue;
        };
        for bad in ["*", "1.7E+38"] {
            let line = lines[at];
            let damaged = if bad == "*" {
                let end = line.trim_end().len();
                format!("{}****", &line[..end - 4])
            } else if line.len() >= 9 && !line.contains([',', ';']) {
                format!("{}{:>9}", &line[..line.len() - 9], bad)
            } else {
                continue;
            };
            let mut changed: Vec<&str> = lines.clone();
            changed[at] = &damaged;
            let bytes = changed.join("\n");
            match read_all_bytes("file", bytes.as_bytes(), &fixture.options) {
                Err(GroundMotionError::Parse { line, column, .. }) => {
                    assert_eq!(line, at + 1, "{}", fixture.name);
                    assert!(column > 0);
                }
                // Blocks of spectra are passed over.
                Ok(_) if fixture.format == "isesd" => {}
                other => panic!("{} {damaged}: {other:?}", fixture.name),
            }
        }
    }
}

#[test]
fn other_peaks_and_units_are_reported() {
    let fixture = &common::fixtures("dyna", 0)[0];
    let text = String::from_utf8(fixture.bytes.clone()).unwrap();
    let line = text.lines().find(|l| l.starts_with("PGA_")).unwrap();
    let wrong = text.replace(line, "PGA_CM/S^2: 99.000");
    let error = read_all_bytes("file", wrong.as_bytes(), &fixture.options).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("the header's peak is 99.000 cm/s2"),
        "{error}"
    );
    let zero = text.replace(line, "PGA_CM/S^2: 0");
    let recording = read_all_bytes("file", zero.as_bytes(), &fixture.options).unwrap();
    assert!(recording.series[0].origin.warnings[0].contains("the header's peak is 0"));
    let late = text.replace("TIME_PGA_S: 0", "TIME_PGA_S: 7");
    let recording = read_all_bytes("file", late.as_bytes(), &fixture.options).unwrap();
    assert!(recording.series[0].origin.warnings[0].contains("the header puts the peak at 7"));
    let velocity = text.replace("UNITS: cm/s^2", "UNITS: cm/s");
    assert!(read_all_bytes("file", velocity.as_bytes(), &fixture.options).is_err());
    let none = text.replace("UNITS: cm/s^2", "UNITS: ");
    assert!(matches!(
        read_all_bytes("file", none.as_bytes(), &fixture.options),
        Err(GroundMotionError::MissingUnit { .. })
    ));
    assert!(matches!(
        read_all_bytes("file", &fixture.bytes, &common::in_g()),
        Err(GroundMotionError::Contradiction { .. })
    ));
}

/// Caltech's headers print signs that are opposite to those of the samples, CSMIP's the same.
#[test]
fn signs_of_header_peaks() {
    for (format, opposite) in [("csmip_v2", false), ("caltech_volume_2", true)] {
        let fixture = &common::fixtures(format, 0)[0];
        let recording = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
        for series in &recording.series {
            let header = series.header_peak.unwrap();
            let (value, time) = series.signed_peak();
            assert_eq!(header.opposite_sign, opposite, "{}", series.label());
            assert_eq!(header.value * value < 0.0, opposite, "{}", series.label());
            assert!((header.value.abs() - value.abs()).abs() <= 1e-4 * value.abs());
            assert_eq!(series.peak().time, time);
            assert_eq!(header.unit, series.unit);
            assert_eq!(header.unit_in_si, series.unit_in_si);
        }
    }
}

/// First values of velocity and displacement, whatever sign the header prints.
#[test]
fn initial_values() {
    for format in ["csmip_v2", "caltech_volume_2"] {
        let fixture = &common::fixtures(format, 0)[0];
        let recording = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
        for channel in recording.series.chunks(3) {
            let first = (channel[1].samples[0], channel[2].samples[0]);
            assert_eq!(channel[0].initial, Some(first));
            assert_eq!(channel[0].origin.low_corner, Some(0.07));
            assert_eq!(channel[0].origin.high_corner, Some(40.0));
        }
    }
}

#[test]
fn values_that_may_stand_for_missing_are_named() {
    let options = ReadOptions {
        time_step: Some(0.01),
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    let record = read_bytes("file", b"0.1\n-999.0\n0.3\n", &options).unwrap();
    assert!(record.origin().unwrap().warnings[0].contains("sample 2 is exactly -999"));
}

#[test]
fn filters_and_peaks_in_headers_of_peer() {
    let text = |pga: &str| {
        format!(
            "TITLE\nEVENT, STATION\nACCELERATION TIME SERIES IN UNITS OF G  PGA= {pga} HP=0.2 Hz LP=12.5 Hz\nNPTS=  3, DT= .0050 SEC\n .1 -.3 .2\n"
        )
    };
    let read = |pga, options: &ReadOptions| read_all_bytes("file", text(pga).as_bytes(), options);
    let series = &read("0.300", &ReadOptions::default()).unwrap().series[0];
    assert_eq!(
        (series.origin.low_corner, series.origin.high_corner),
        (Some(0.2), Some(12.5))
    );
    assert!(series.origin.warnings.is_empty());
    // Another stage of the processing, and another record.
    let near = read("0.310", &ReadOptions::default()).unwrap();
    assert_eq!(near.series[0].origin.warnings.len(), 1);
    let error = read("0.400", &ReadOptions::default()).unwrap_err();
    let said = error.to_string();
    assert!(
        said.contains("0.40000 g") && said.contains("-0.30000 g"),
        "{said}"
    );
    assert!(error.help().unwrap().contains("lenient"));
    let lenient = ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    };
    assert_eq!(
        read("0.400", &lenient).unwrap().series[0]
            .origin
            .warnings
            .len(),
        1
    );
}

#[test]
fn gaps_and_velocities_of_mini_seed() {
    use crate::common::binary::{SENSITIVITY, Seed, record};
    let seed = |channel: &'static [u8; 3], start: u32| {
        record(&Seed {
            channel,
            encoding: 3,
            big: true,
            start,
            count: 3,
            data: [1_i32, -5, 9]
                .iter()
                .flat_map(|c| c.to_be_bytes())
                .collect(),
        })
    };
    let options = ReadOptions {
        sensitivity: Some(SENSITIVITY),
        ..ReadOptions::default()
    };
    let read = |records: &[Vec<u8>]| read_bytes("file", &records.concat(), &options);
    assert_eq!(
        read(&[seed(b"HNE", 0), seed(b"HNE", 300)])
            .unwrap()
            .samples()
            .len(),
        6
    );
    for (start, word) in [(500, "a gap of 0.0200 s"), (100, "an overlap of 0.0200 s")] {
        let error = read(&[seed(b"HNE", 0), seed(b"HNE", start)]).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
        assert!(error.to_string().starts_with("file: byte 512:"), "{error}");
    }
    let seismometer = read(&[seed(b"HHE", 0)]).unwrap_err().to_string();
    assert!(seismometer.contains("records velocity"), "{seismometer}");
    let barometer = read(&[seed(b"HDF", 0)]).unwrap_err().to_string();
    assert!(barometer.contains("records pressure"), "{barometer}");
    let beside = read(&[seed(b"HDF", 0), seed(b"HNE", 0)]).unwrap();
    assert_eq!(beside.samples().len(), 3);
    assert!(matches!(
        read(&[seed(b"HNE", 0), seed(b"HNN", 0)]),
        Err(GroundMotionError::AmbiguousSeries { .. })
    ));
}

#[test]
fn spectra_are_refused() {
    let volume_3 = b"Response and Fourier Amplitude Spectra\nCorrected accelerogram\n";
    let smc = b"5 RESPONSE SPECTRA\n*\n1\n2\n3\n4\n5\n6\n7\n8\n9\n";
    for bytes in [&volume_3[..], smc] {
        assert!(matches!(
            read_all_bytes("file", bytes, &ReadOptions::default()),
            Err(GroundMotionError::Unsupported { .. })
        ));
    }
}

/// Floats in a unit that the user names; integers are counts whatever he says, and a sensitivity
/// makes counts of floats too.
#[test]
fn floats_of_mini_seed_in_a_unit() {
    use crate::common::binary::{Seed, record};
    let values = [1.5_f32, -0.25, 0.75];
    let seed = |encoding: u8, data: Vec<u8>| {
        record(&Seed {
            channel: b"HNE",
            encoding,
            big: true,
            start: 0,
            count: 3,
            data,
        })
    };
    let floats = seed(4, values.iter().flat_map(|v| v.to_be_bytes()).collect());
    let integers = seed(
        3,
        [1_i32, -5, 9]
            .iter()
            .flat_map(|c| c.to_be_bytes())
            .collect(),
    );
    let read = |bytes: &[u8], unit: Option<AccelerationUnit>, sensitivity: Option<f64>| {
        let options = ReadOptions {
            unit,
            sensitivity,
            offset: Offset::Keep,
            ..ReadOptions::default()
        };
        read_bytes("file", bytes, &options)
    };
    let gal = Some(AccelerationUnit::Gal);
    let read_in_gal = read(&floats, gal, None).unwrap();
    for (sample, value) in read_in_gal.samples().iter().zip(values) {
        assert!((sample - 0.01 * f64::from(value)).abs() < 1.0e-15);
    }
    let counted = read(&floats, None, Some(10.0)).unwrap();
    assert!((counted.samples()[0] - 0.15).abs() < 1.0e-15);
    for (bytes, unit, sensitivity) in [
        (&floats, None, None),
        (&integers, gal, None),
        (&floats, gal, Some(10.0)),
    ] {
        assert!(read(bytes, unit, sensitivity).is_err());
    }
}
