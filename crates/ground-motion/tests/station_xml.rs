//! The sensitivity of miniSEED records by StationXML, named or beside the record: by hand, counts
//! over counts per unit. What the metadata do not say, or say twice, is refused with its reason.
use std::path::{Path, PathBuf};

use crate::common::binary::{Seed, record};
use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, Quantity, ReadOptions, read, read_all, read_all_bytes,
    read_bytes, responses_beside,
};

const COUNTS: [i32; 5] = [100, -250, 400, 0, -50];

fn seed(channel: &'static [u8; 3]) -> Vec<u8> {
    record(&Seed {
        channel,
        encoding: 3,
        big: true,
        start: 5000,
        count: 5,
        data: COUNTS.iter().flat_map(|c| c.to_be_bytes()).collect(),
    })
}

/// One epoch of a channel.
struct Epoch<'a> {
    channel: &'a str,
    attributes: &'a str,
    value: &'a str,
    input: &'a str,
    output: &'a str,
    /// What else stands in the channel, and in its response.
    more: (&'a str, &'a str),
}

const HNE: Epoch<'static> = Epoch {
    channel: "HNE",
    attributes: r#"locationCode="  " startDate="1999-01-01T00:00:00.0000" endDate="2001-01-01T00:00:00Z""#,
    value: "2.5E+05",
    input: "M/S**2",
    output: "COUNTS",
    more: ("<SampleRate>100</SampleRate>", ""),
};

fn station(epochs: &[Epoch<'_>]) -> String {
    let channels: String = epochs
        .iter()
        .map(|e| {
            format!(
                "<Channel code=\"{}\" {}>\n{}<Response><InstrumentSensitivity><Value>{}</Value><Frequency>1.0</Frequency><InputUnits><Name>{}</Name></InputUnits><OutputUnits><Name>{}</Name></OutputUnits></InstrumentSensitivity>{}</Response></Channel>\n",
                e.channel, e.attributes, e.more.0, e.value, e.input, e.output, e.more.1
            )
        })
        .collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<FDSNStationXML xmlns=\"http://www.fdsn.org/xml/station/1\" schemaVersion=\"1.1\">\n<Source>made up</Source>\n<Network code=\"YY\"/><Network code=\"XX\">\n<Station code=\"OTHER\"/><Station code=\"XXXXX\">\n<Site><Name>Nowhere, \u{160}umava</Name></Site>\n{channels}</Station></Network></FDSNStationXML>\n"
    )
}

fn write(folder: &Path, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, content).unwrap();
    path
}

fn with(response: &Path) -> ReadOptions {
    ReadOptions {
        response: Some(response.to_owned()),
        ..ReadOptions::default()
    }
}

/// The error of a record whose metadata are these, in full.
fn refused(metadata: impl AsRef<[u8]>) -> String {
    let (folder, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let response = write(elsewhere.path(), "station.xml", metadata);
    let error = read_all(&record, &with(&response)).unwrap_err();
    let shown = format!("{error}; {}", error.help().unwrap());
    assert!(shown.contains("station.xml"), "{shown}");
    shown
}

#[test]
fn named_and_beside_the_record() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let error = read(&record, &ReadOptions::default()).unwrap_err();
    assert!(
        error.to_string().contains("no StationXML lies beside it"),
        "{error}"
    );
    assert!(error.help().unwrap().contains("--response"));
    let elsewhere = tempfile::tempdir().unwrap();
    let named = write(elsewhere.path(), "metadata.xml", station(&[HNE]));
    let by_name = read_all(&record, &with(&named)).unwrap();
    // Of the folder, what is no StationXML is passed over.
    write(folder.path(), "another.xml", "<a/>");
    let beside = write(folder.path(), "XX.XXXXX.xml", station(&[HNE]));
    assert_eq!(responses_beside(&record), std::slice::from_ref(&beside));
    let found = read_all(&record, &ReadOptions::default()).unwrap();
    for (recording, file) in [(&by_name, &named), (&found, &beside)] {
        let series = &recording.series[0];
        assert_eq!(series.quantity, Quantity::Acceleration);
        for (a, count) in series.samples.iter().zip(COUNTS) {
            assert_eq!(*a, f64::from(count) * (1.0 / 2.5e5));
        }
        let origin = &series.origin;
        assert_eq!(origin.warnings, Vec::<String>::new());
        let unit = format!("250000 per m/s2 at 1 Hz by {}", file.display());
        assert!(origin.unit.contains(&unit), "{}", origin.unit);
        assert_eq!(
            origin.response.as_ref().unwrap().file,
            file.display().to_string()
        );
    }
    // The same numbers as with the sensitivity itself; the hash tells that another file is in it.
    let given = ReadOptions {
        sensitivity: Some(2.5e5),
        ..ReadOptions::default()
    };
    let by_number = read_all(&record, &given).unwrap();
    assert_eq!(by_number.series[0].samples, found.series[0].samples);
    assert_ne!(
        by_number.series[0].origin.sha256,
        found.series[0].origin.sha256
    );
    assert_eq!(
        by_name.series[0].origin.sha256,
        found.series[0].origin.sha256
    );
    write(
        folder.path(),
        "XX.XXXXX.xml",
        station(&[HNE]).replace("made up", "changed"),
    );
    let other = read_all(&record, &ReadOptions::default()).unwrap();
    assert_ne!(other.series[0].origin.sha256, found.series[0].origin.sha256);
    // From bytes, which lie nowhere.
    assert!(matches!(
        read_all_bytes("file", &seed(b"HNE"), &ReadOptions::default()),
        Err(GroundMotionError::MissingSensitivity { .. })
    ));
}

/// Metadata that give other numbers are no choice of ours; those of other stations are none.
#[test]
fn several_files_beside_the_record() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    write(
        folder.path(),
        "a.xml",
        station(&[HNE]).replace("XXXXX", "ZZZZZ"),
    );
    let error = read(&record, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("a.xml") && error.contains("no channel XX.XXXXX..HNE"),
        "{error}"
    );
    write(folder.path(), "b.xml", station(&[HNE]));
    read(&record, &ReadOptions::default()).unwrap();
    // The same in two files is one number.
    write(folder.path(), "c.xml", station(&[HNE]));
    read(&record, &ReadOptions::default()).unwrap();
    write(
        folder.path(),
        "d.xml",
        station(&[Epoch {
            value: "300000",
            ..HNE
        }]),
    );
    let error = read(&record, &ReadOptions::default()).unwrap_err();
    let shown = error.to_string();
    assert!(
        shown.contains("250000 per m/s2") && shown.contains("300000 per m/s2"),
        "{shown}"
    );
    assert!(error.help().unwrap().contains("--response"));
    // A file with the name of the station goes before the others.
    write(folder.path(), "xx.xxxxx.xml", station(&[HNE]));
    read(&record, &ReadOptions::default()).unwrap();
}

#[test]
fn velocity_and_other_units() {
    let folder = tempfile::tempdir().unwrap();
    let velocity = Epoch {
        channel: "HHE",
        input: "m/s",
        value: "1e9",
        ..HNE
    };
    let both = [seed(b"HHE"), seed(b"HNE")].concat();
    let record = write(folder.path(), "record.mseed", both);
    let response = write(folder.path(), "station.xml", station(&[HNE, velocity]));
    let recording = read_all(&record, &with(&response)).unwrap();
    let found: Vec<_> = recording
        .series
        .iter()
        .map(|s| (s.quantity, s.samples[0]))
        .collect();
    let expected = [
        (Quantity::Velocity, 100.0 * (1.0 / 1e9)),
        (Quantity::Acceleration, 100.0 * (1.0 / 2.5e5)),
    ];
    assert_eq!(found, expected);
    // A velocity is never taken for an acceleration.
    let chosen = read(&record, &with(&response)).unwrap();
    assert_eq!(chosen.origin().unwrap().component, "HNE");
    let alone = write(folder.path(), "velocity.mseed", seed(b"HHE"));
    assert!(matches!(
        read(&alone, &with(&response)),
        Err(GroundMotionError::NotAcceleration {
            quantity: "velocity",
            ..
        })
    ));
    // What the metadata say goes before what the code of the channel suggests.
    let strange = write(
        folder.path(),
        "strange.xml",
        station(&[Epoch {
            input: "M/S",
            ..HNE
        }]),
    );
    let record = write(folder.path(), "one.mseed", seed(b"HNE"));
    let recording = read_all(&record, &with(&strange)).unwrap();
    assert_eq!(recording.series[0].quantity, Quantity::Velocity);
    for (input, factor) in [
        ("m/s^2", 1.0),
        ("m/(s**2)", 1.0),
        ("cm/s**2", 0.01),
        ("nm/s**2", 1e-9),
    ] {
        let file = write(
            folder.path(),
            "unit.xml",
            station(&[Epoch { input, ..HNE }]),
        );
        let read = read_all(&record, &with(&file)).unwrap();
        let expected = 100.0 / 2.5e5 * factor;
        assert!(
            (read.series[0].samples[0] / expected - 1.0).abs() < 1e-12,
            "{input}"
        );
    }
    let pressure = refused(station(&[Epoch { input: "PA", ..HNE }]));
    assert!(pressure.contains("records \"PA\""), "{pressure}");
    for output in ["V", "count/V", "counts per volt"] {
        let volts = refused(station(&[Epoch { output, ..HNE }]));
        let words = format!("gives \"{output}\", not counts");
        assert!(volts.contains(&words), "{volts}");
    }
}

#[test]
fn epochs() {
    let before = r#"startDate="1990-01-01T00:00:00" endDate="2000-01-01T00:00:00""#;
    let after = r#"startDate="2000-01-01T00:00:00" endDate="2599-12-31T23:59:59""#;
    let first = Epoch {
        attributes: before,
        value: "1",
        ..HNE
    };
    let second = || Epoch {
        attributes: after,
        value: "4",
        ..HNE
    };
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let file = write(folder.path(), "station.xml", station(&[first, second()]));
    // The record starts half a second after the change.
    assert_eq!(
        read_all(&record, &with(&file)).unwrap().series[0].samples[0],
        25.0
    );
    let gone = refused(station(&[Epoch {
        attributes: before,
        ..HNE
    }]));
    assert!(
        gone.contains("no epoch of channel XX.XXXXX..HNE covers 2000 day 1"),
        "{gone}"
    );
    let other = Epoch {
        value: "5",
        ..second()
    };
    let twice = refused(station(&[second(), other]));
    assert!(twice.contains("a second epoch"), "{twice}");
    let other = refused(station(&[Epoch {
        attributes: r#"locationCode="10""#,
        ..HNE
    }]));
    assert!(other.contains("no channel XX.XXXXX..HNE"), "{other}");
}

/// A change of the sensitivity within the record is said; the epoch of the first sample counts.
#[test]
fn epochs_that_begin_within_the_record() {
    let (first_seconds, record_seconds) = ("00:00:00.52", "2000-01-01T00:00:00.52");
    let until = format!(r#"startDate="1990-01-01T00:00:00" endDate="{record_seconds}""#);
    let from = format!(r#"startDate="2000-01-01T{first_seconds}""#);
    let later = format!(r#"startDate="{}""#, record_seconds.replace(".52", ".56"));
    let short = format!(
        r#"{from} endDate="{}""#,
        record_seconds.replace(".52", ".53")
    );
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for (attributes, value, input, is_said) in [
        (&from, "4", "M/S**2", true),
        (&from, "1", "CM/S**2", true),
        (&from, "1", "M/S**2", false),
        // It ends before the last sample, at 0.54 s.
        (&short, "4", "M/S**2", true),
        // Behind the last sample.
        (&later, "4", "M/S**2", false),
    ] {
        let first = Epoch {
            attributes: &until,
            value: "1",
            ..HNE
        };
        let second = Epoch {
            attributes,
            value,
            input,
            ..HNE
        };
        let file = write(folder.path(), "station.xml", station(&[first, second]));
        let found = read_all(&record, &with(&file)).unwrap();
        let one = &found.series[0];
        assert_eq!(one.samples[0], 100.0);
        let said = |w: &String| w.contains("begins within the record");
        let warnings = &one.origin.warnings;
        assert_eq!(warnings.iter().any(said), is_said, "{value}: {warnings:?}");
    }
}

/// Where the metadata end within the record, or have dates that are none, the record is read and it is said.
#[test]
fn dates_of_epochs_that_bound_nothing_or_too_much() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let began = r#"startDate="1990-01-01T00:00:00""#;
    for (end, words) in [
        (
            r#"endDate="2000-01-01T00:00:00.52""#,
            "and none covers the last sample",
        ),
        (r#"endDate="2599-12-31T23:59:59""#, ""),
        ("", ""),
        (
            r#"endDate="open""#,
            "endDate \"open\" of XX.XXXXX..HNE is no date, and bounds nothing",
        ),
        (r#"endDate="2000-13-01""#, "is no date, and bounds nothing"),
    ] {
        let attributes = format!("{began} {end}");
        let epoch = Epoch {
            attributes: &attributes,
            ..HNE
        };
        let file = write(folder.path(), "station.xml", station(&[epoch]));
        let found = read_all(&record, &with(&file)).unwrap();
        let warnings = &found.series[0].origin.warnings;
        let said = |w: &&String| w.contains("covers the last") || w.contains("bounds nothing");
        let said: Vec<&String> = warnings.iter().filter(said).collect();
        match words {
            "" => assert!(said.is_empty(), "{end}: {said:?}"),
            _ => assert!(
                said.len() == 1 && said[0].contains(words),
                "{end}: {said:?}"
            ),
        }
        assert!(
            said.iter().all(|w| w.contains("station.xml: line ")),
            "{said:?}"
        );
    }
}

#[test]
fn angles_that_are_no_direction() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for (azimuth, dip, is_one) in [
        ("90", "0", true),
        ("400", "0", false),
        ("90", "-120", false),
    ] {
        let more =
            format!("<Azimuth>{azimuth}</Azimuth><Dip>{dip}</Dip><SampleRate>100</SampleRate>");
        let epoch = Epoch {
            more: (&more, ""),
            ..HNE
        };
        let file = write(folder.path(), "station.xml", station(&[epoch]));
        let found = read_all(&record, &with(&file)).unwrap();
        let origin = &found.series[0].origin;
        assert_eq!(origin.orientation.is_some(), is_one);
        let said = |w: &String| w.contains("are no direction");
        assert_eq!(
            !origin.warnings.iter().any(said),
            is_one,
            "{:?}",
            origin.warnings
        );
    }
}

/// Statements that contradict one another are named with both numbers.
#[test]
fn doubts() {
    let stage = |gain: &str| {
        format!(
            "<Stage number=\"1\"><StageGain><Value>{gain}</Value><Frequency>1</Frequency></StageGain></Stage><Stage number=\"2\"><StageGain><Value>1000</Value><Frequency>0</Frequency></StageGain></Stage>"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for (gain, rate, words) in [
        ("250", "100", &[][..]),
        ("25", "100", &["250000", "25000"][..]),
        ("250", "200", &["200 samples/s", "100"][..]),
    ] {
        let stages = stage(gain);
        let rate = format!("<SampleRate>{rate}</SampleRate>");
        let epoch = Epoch {
            more: (&rate, &stages),
            ..HNE
        };
        let file = write(folder.path(), "station.xml", station(&[epoch]));
        let recording = read_all(&record, &with(&file)).unwrap();
        let warnings = &recording.series[0].origin.warnings;
        assert_eq!(
            warnings.len(),
            usize::from(!words.is_empty()),
            "{warnings:?}"
        );
        assert!(
            words.iter().all(|w| warnings[0].contains(w)),
            "{warnings:?}"
        );
    }
}

/// Gains of stages by their signs, and at the frequencies at which they hold.
#[test]
fn gains_of_stages() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for (gains, words) in [
        (["250", "1000"], &[][..]),
        (
            ["-250", "1000"],
            &["at 1 and 5 Hz", "signs are opposite"][..],
        ),
        (["-250", "-1000"], &[][..]),
        (
            ["280", "1000"],
            &["250000 at 1 Hz", "280000 at 1 and 5 Hz"][..],
        ),
        (["-280", "1000"], &["250000 at 1 Hz", "-280000"][..]),
    ] {
        let stages: String = gains
            .iter()
            .zip(["1", "5"])
            .map(|(gain, at)| {
                format!("<Stage><StageGain><Value>{gain}</Value><Frequency>{at}</Frequency></StageGain></Stage>")
            })
            .collect();
        let epoch = Epoch {
            more: ("", &stages),
            ..HNE
        };
        let file = write(folder.path(), "station.xml", station(&[epoch]));
        let recording = read_all(&record, &with(&file)).unwrap();
        let warnings = recording.series[0].origin.warnings.join("; ");
        assert_eq!(warnings.is_empty(), words.is_empty(), "{warnings}");
        assert!(words.iter().all(|w| warnings.contains(w)), "{warnings}");
    }
}

/// A negative sensitivity turns the sign, and that is said.
#[test]
fn negative_sensitivities() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let epoch = Epoch {
        value: "-2.5E+05",
        ..HNE
    };
    let file = write(folder.path(), "station.xml", station(&[epoch]));
    let recording = read_all(&record, &with(&file)).unwrap();
    let warnings = recording.series[0].origin.warnings.join("; ");
    assert!(
        warnings.contains("is negative, -250000: the samples have the opposite sign"),
        "{warnings}"
    );
}

/// Azimuth and dip go before the code of the channel.
#[test]
fn directions_of_channels() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(
        folder.path(),
        "record.mseed",
        [seed(b"HN1"), seed(b"HN2"), seed(b"HNE"), seed(b"HNZ")].concat(),
    );
    let angles = |azimuth: f64, dip: f64| {
        format!("<Azimuth>{azimuth}</Azimuth><Dip>{dip}</Dip><SampleRate>100</SampleRate>")
    };
    let all = [
        ("HN1", angles(30.0, 0.0)),
        ("HN2", angles(90.0, 0.0)),
        ("HNE", angles(270.0, 0.0)),
        ("HNZ", angles(0.0, 90.0)),
    ];
    let epochs: Vec<Epoch<'_>> = all
        .iter()
        .map(|(channel, more)| Epoch {
            channel,
            more: (more, ""),
            ..HNE
        })
        .collect();
    let file = write(folder.path(), "station.xml", station(&epochs));
    let chosen = |component: &str| {
        let options = ReadOptions {
            component: Some(component.to_owned()),
            ..with(&file)
        };
        read(&record, &options).unwrap()
    };
    let error = rotate(&chosen("HN1"), &chosen("HN2"), 10.0).unwrap_err();
    let shown = error.to_string();
    assert!(
        shown.contains("azimuth 30") && shown.contains("azimuth 90"),
        "{shown}"
    );
    assert_eq!(chosen("90").origin().unwrap().component, "HN2");
    for name in ["HNE", "HNZ"] {
        let taken = chosen(name);
        let warnings = &taken.origin().unwrap().warnings;
        let words = format!("component {name} has azimuth");
        assert!(
            warnings
                .iter()
                .any(|w| w.contains(&words) && w.contains("the other way")),
            "{warnings:?}"
        );
    }
}

/// Channels without metadata stand in no one's way, unless they are meant.
#[test]
fn channels_without_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let both = [seed(b"HNE"), seed(b"HNN")].concat();
    let record = write(folder.path(), "record.mseed", both);
    let file = write(folder.path(), "station.xml", station(&[HNE]));
    for options in [with(&file), ReadOptions::default()] {
        let recording = read_all(&record, &options).unwrap();
        assert_eq!(recording.series.len(), 1);
        assert_eq!(recording.without[0].component, "HNN");
        let warnings = &recording.series[0].origin.warnings;
        assert!(
            warnings.iter().any(|w| w.contains("HNN was passed over")),
            "{warnings:?}"
        );
        let of = |component: &str| ReadOptions {
            component: Some(component.to_owned()),
            ..options.clone()
        };
        read(&record, &of("HNE")).unwrap();
        let error = read(&record, &of("HNN")).unwrap_err().to_string();
        assert!(error.contains("component HNN is not known"), "{error}");
        assert!(error.contains("no channel XX.XXXXX..HNN"), "{error}");
        // Which one is meant is not known.
        let error = read(&record, &options).unwrap_err().to_string();
        assert!(error.contains("HNN (without sensitivity)"), "{error}");
    }
}

/// Channels that differ by their location alone have it in their names.
#[test]
fn locations_of_channels() {
    let at = |location: &[u8; 2]| {
        let mut bytes = seed(b"HNE");
        bytes[13..15].copy_from_slice(location);
        bytes
    };
    let options = |component: &str| ReadOptions {
        sensitivity: Some(1.0),
        component: Some(component.to_owned()),
        ..ReadOptions::default()
    };
    let file = [at(b"10"), at(b"20"), seed(b"HNN")].concat();
    for name in ["10.HNE", "20.HNE", "HNN"] {
        let read = read_bytes("f", &file, &options(name)).unwrap();
        assert_eq!(read.origin().unwrap().component, name);
    }
    let error = read_bytes("f", &file, &options("HNE"))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("10.HNE") && error.contains("20.HNE"),
        "{error}"
    );
    let plain = [at(b"10"), seed(b"HNE")].concat();
    read_bytes("f", &plain, &options(".HNE")).unwrap();
}

#[test]
fn what_is_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for value in ["0", "many", ""] {
        let shown = refused(station(&[Epoch { value, ..HNE }]));
        assert!(shown.contains("no number above zero"), "{shown}");
    }
    let none = refused(station(&[HNE]).replace("InstrumentSensitivity", "InstrumentPolynomial"));
    assert!(none.contains("has no InstrumentSensitivity"), "{none}");
    let xml = refused("<a/>");
    assert!(xml.contains("no StationXML"), "{xml}");
    assert!(matches!(
        read(&record, &with(&folder.path().join("none.xml"))),
        Err(GroundMotionError::Io { .. })
    ));
    let file = write(folder.path(), "station.xml", station(&[HNE]));
    let both = ReadOptions {
        sensitivity: Some(1.0),
        ..with(&file)
    };
    let error = read(&record, &both).unwrap_err().to_string();
    assert!(error.contains("both a sensitivity and a file"), "{error}");
    // A record that states its unit needs none.
    let table = write(
        folder.path(),
        "plain.at2",
        "a\nb\nUNITS OF G\nNPTS= 3, DT= .01\n.1 .2 .3\n",
    );
    let error = read(&table, &with(&file)).unwrap_err().to_string();
    assert!(
        error.contains("peer_at2 state their unit themselves"),
        "{error}"
    );
}

/// Metadata cut off anywhere, noise, elements without end: an error, soon, in little memory.
#[test]
fn damaged_metadata() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let whole = station(&[HNE]).into_bytes();
    for at in 0..whole.len() - 1 {
        let file = write(folder.path(), "cut.xml", &whole[..at]);
        assert!(read_all(&record, &with(&file)).is_err(), "cut at {at}");
    }
    let head = &whole[..180];
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let noise = std::iter::repeat_with(|| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state as u8
    });
    let ten = 10 << 20;
    for (what, tail) in [
        ("noise", noise.take(ten).collect()),
        ("deep", b"<a>".repeat(ten / 3)),
        ("many", b"<a/>".repeat(ten / 4)),
        (
            "document type",
            b"<!DOCTYPE a [<!ENTITY b \"b\">]>".to_vec(),
        ),
    ] {
        let file = write(folder.path(), "noise.xml", [head, &tail].concat());
        let error = read_all(&record, &with(&file)).unwrap_err().to_string();
        assert!(error.contains("noise.xml"), "{what}: {error}");
    }
    // Well formed, and deeper than the stack: named, and lying beside the record.
    for depth in [201, 20_000] {
        let deep = [
            "<FDSNStationXML>".to_owned(),
            "<a>".repeat(depth),
            "</a>".repeat(depth),
        ]
        .concat();
        let file = write(folder.path(), "deep.xml", deep + "</FDSNStationXML>");
        let error = read_all(&record, &with(&file)).unwrap_err().to_string();
        assert!(
            error.contains("deep.xml") && error.contains("200 deep"),
            "{error}"
        );
        assert!(read_all(&record, &ReadOptions::default()).is_err());
        std::fs::remove_file(file).unwrap();
    }
    // Names in another encoding than the file says.
    let latin = station(&[HNE]).replace('\u{160}', "S").into_bytes();
    let at = latin.windows(5).position(|w| w == b"umava").unwrap();
    let mut latin = latin;
    latin[at] = 0xfc;
    let file = write(folder.path(), "latin.xml", latin);
    read_all(&record, &with(&file)).unwrap();
}

/// Floats that a program has brought to a unit are not divided by a sensitivity that happens to lie
/// beside the record, where the user says their unit; where nobody does, that is said.
#[test]
fn floats_beside_metadata() {
    let values = [1.5_f32, -0.25, 0.75];
    let floats = record(&Seed {
        channel: b"HNE",
        encoding: 4,
        big: true,
        start: 5000,
        count: 3,
        data: values.iter().flat_map(|v| v.to_be_bytes()).collect(),
    });
    let folder = tempfile::tempdir().unwrap();
    let path = write(folder.path(), "floats.mseed", floats);
    let file = write(folder.path(), "XX.XXXXX.xml", station(&[HNE]));
    for (unit, factor) in [
        (AccelerationUnit::Gal, 0.01),
        (AccelerationUnit::MetrePerSecondSquared, 1.0),
    ] {
        let in_unit = ReadOptions {
            unit: Some(unit),
            ..ReadOptions::default()
        };
        let found = read_all(&path, &in_unit).unwrap();
        let series = &found.series[0];
        for (a, value) in series.samples.iter().zip(values) {
            assert!((a - factor * f64::from(value)).abs() < 1.0e-15, "{a}");
        }
        assert_eq!(series.origin.response, None);
        let said = |w: &String| w.contains("XX.XXXXX.xml is not applied");
        let warnings = &series.origin.warnings;
        assert!(warnings.iter().any(said), "{warnings:?}");
        // Integers are counts, and so is what a named file gives the sensitivity of.
        let counts = write(folder.path(), "counts.mseed", seed(b"HNE"));
        let named = ReadOptions {
            unit: Some(unit),
            ..with(&file)
        };
        for (record, options, words) in [
            (&counts, &in_unit, "they are integers, which are counts"),
            (&counts, &named, "they are integers, which are counts"),
            (
                &path,
                &named,
                "by the file of response that is given they are counts",
            ),
        ] {
            let error = read_all(record, options).unwrap_err();
            let shown = error.to_string();
            assert!(shown.contains(words), "{shown}");
            assert_eq!(error.option(), Some("unit"));
        }
    }
    // Files that contradict one another are of no matter to values in a unit.
    let other = Epoch {
        value: "300000",
        ..HNE
    };
    let other = write(folder.path(), "other.XXXXX.xml", station(&[other]));
    let in_gal = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        ..ReadOptions::default()
    };
    read_all(&path, &in_gal).unwrap();
    std::fs::remove_file(other).unwrap();
    let counted = read_all(&path, &ReadOptions::default()).unwrap();
    let series = &counted.series[0];
    assert_eq!(series.samples[0], 1.5 * (1.0 / 2.5e5));
    let said = |w: &String| w.contains("XX.XXXXX.xml") && w.contains("`unit` says which");
    let warnings = &series.origin.warnings;
    assert!(warnings.iter().any(said), "{warnings:?}");
    // A file that is named says by itself that there are counts.
    let named = read_all(&path, &with(&file)).unwrap();
    assert_eq!(named.series[0].origin.warnings, Vec::<String>::new());
}

/// Files with the code of the station in their name go before others, which are looked into where
/// those do not have the channel.
#[test]
fn names_of_files_beside_the_record() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    // Of a station whose code holds that of the record's.
    let other = station(&[HNE]).replace("XXXXX", "AXXXXX");
    write(folder.path(), "AXXXXXB.xml", &other);
    write(folder.path(), "inventory.xml", station(&[HNE]));
    read(&record, &ReadOptions::default()).unwrap();
    std::fs::remove_file(folder.path().join("inventory.xml")).unwrap();
    // More files than are looked into, and those that are not named one by one.
    for i in 0..300 {
        write(folder.path(), &format!("a{i:03}.xml"), &other);
    }
    let error = read(&record, &ReadOptions::default())
        .unwrap_err()
        .to_string();
    for words in [
        "AXXXXXB.xml",
        "253 more files",
        "45 more files that end in .xml were not opened",
    ] {
        assert!(error.contains(words), "{error}");
    }
    assert!(error.len() < 1500, "{error}");
    // Of those the ones with the station's code are opened first; what writes files keeps off them.
    let named = write(folder.path(), "z_xxxxx.xml", station(&[HNE]));
    read(&record, &ReadOptions::default()).unwrap();
    assert!(responses_beside(&record).contains(&named));
}

/// Inventories that were merged state an epoch twice: it is one where both say the same.
#[test]
fn epochs_that_stand_twice() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    let once = station(&[HNE]);
    let from = once.find("<Network code=\"XX\">").unwrap();
    let to = once.find("</FDSNStationXML>").unwrap();
    let merged = format!("{}{}{}", &once[..to], &once[from..to], &once[to..]);
    let file = write(folder.path(), "XX.XXXXX.xml", &merged);
    for options in [with(&file), ReadOptions::default()] {
        let found = read_all(&record, &options).unwrap();
        assert_eq!(found.series[0].samples[0], 100.0 * (1.0 / 2.5e5));
        assert_eq!(found.series[0].origin.warnings, Vec::<String>::new());
    }
    for (same, other) in [
        ("2.5E+05", "2.6E+05"),
        ("M/S**2", "CM/S**2"),
        (
            "<SampleRate>",
            "<Azimuth>90</Azimuth><Dip>0</Dip><SampleRate>",
        ),
    ] {
        let last = merged.rfind(same).unwrap();
        let changed = format!("{}{other}{}", &merged[..last], &merged[last + same.len()..]);
        let shown = refused(changed);
        assert!(shown.contains("a second epoch"), "{shown}");
    }
}

/// Channels of low gain are accelerographs in older codes: where the user says so, by a sensitivity or a
/// unit, they are read with a warning; those of seismometers are not.
#[test]
fn channels_of_low_gain() {
    let floats = |channel: &'static [u8; 3]| {
        record(&Seed {
            channel,
            encoding: 4,
            big: true,
            start: 5000,
            count: 3,
            data: [1.5_f32, -0.25, 0.75]
                .iter()
                .flat_map(|v| v.to_be_bytes())
                .collect(),
        })
    };
    let by_sensitivity = ReadOptions {
        sensitivity: Some(10.0),
        ..ReadOptions::default()
    };
    let by_unit = ReadOptions {
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        ..ReadOptions::default()
    };
    for (bytes, options, first) in [
        (seed(b"HLE"), &by_sensitivity, 10.0),
        (floats(b"HLZ"), &by_sensitivity, 0.15),
        (floats(b"HL1"), &by_unit, 1.5),
    ] {
        let found = read_all_bytes("f", &bytes, options).unwrap();
        let series = &found.series[0];
        assert_eq!(series.quantity, Quantity::Acceleration);
        assert!((series.samples[0] - first).abs() < 1.0e-12);
        let said = |w: &String| w.contains("an accelerograph in older codes");
        let warnings = &series.origin.warnings;
        assert!(warnings.iter().any(said), "{warnings:?}");
    }
    for (bytes, options, words) in [
        (seed(b"HLE"), &ReadOptions::default(), "of low gain"),
        (seed(b"HLE"), &by_unit, "of low gain"),
        (seed(b"HHE"), &by_sensitivity, "records velocity"),
        (floats(b"HHE"), &by_unit, "records velocity"),
        (seed(b"BLE"), &by_sensitivity, "records velocity"),
    ] {
        let error = read_all_bytes("f", &bytes, options).unwrap_err();
        let help = error.help().unwrap();
        assert!(error.to_string().contains(words), "{error}");
        assert!(
            help.contains("`response`") && !help.contains("AT2"),
            "{help}"
        );
    }
}

/// Networks write "None" for the unit of the whole sensitivity, where the last stage gives counts (NP of 2017); without that
/// it stays refused.
#[test]
fn an_output_of_no_unit_is_that_of_the_last_stage() {
    let stage = |unit: &str| {
        format!(
            "<Stage number=\"1\"><PolesZeros><InputUnits><Name>m/s**2</Name></InputUnits><OutputUnits><Name>V</Name></OutputUnits></PolesZeros></Stage><Stage number=\"2\"><Coefficients><InputUnits><Name>V</Name></InputUnits><OutputUnits><Name>{unit}</Name></OutputUnits></Coefficients></Stage>"
        )
    };
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    for output in ["None", ""] {
        let (counts, volts) = (stage("count"), stage("V"));
        let of = |more| Epoch {
            output,
            more: ("<SampleRate>100</SampleRate>", more),
            ..HNE
        };
        write(folder.path(), "station.xml", station(&[of(&counts)]));
        let found = read_all(&record, &ReadOptions::default()).unwrap();
        let series = &found.series[0];
        for (a, count) in series.samples.iter().zip(COUNTS) {
            assert_eq!(*a, f64::from(count) * (1.0 / 2.5e5));
        }
        let told = "names no unit of its output: count of the last stage are taken";
        assert!(series.origin.warnings.iter().any(|w| w.contains(told)));
        for stages in ["", &volts] {
            assert!(refused(station(&[of(stages)])).contains("not counts"));
        }
    }
}

/// An accelerograph whose metadata say displacement (UU of 2020) is asked about: a sensitivity to that holds at one frequency.
#[test]
fn an_accelerograph_that_records_no_acceleration_is_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let record = write(folder.path(), "record.mseed", seed(b"HNE"));
    write(
        folder.path(),
        "station.xml",
        station(&[Epoch { input: "m", ..HNE }]),
    );
    let found = read_all(&record, &ReadOptions::default()).unwrap();
    assert_eq!(found.series[0].quantity, Quantity::Displacement);
    let told = "is that of an accelerograph by its code, but its sensitivity is one to displacement (\"m\"), which for an accelerograph holds at 1 Hz alone";
    let warnings = &found.series[0].origin.warnings;
    assert!(warnings.iter().any(|w| w.contains(told)), "{warnings:?}");
}
