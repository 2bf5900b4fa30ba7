//! Numbers of headers are read by the units beside them, and words by their lines.
#![allow(clippy::unwrap_used)]

use pounding_ground_motion::writers::{Written, write_peer_at2};
use pounding_ground_motion::{
    Processing, Quantity, ReadOptions, Recording, Sampling, read_all_bytes, read_bytes,
};

use crate::common::{Fixture, fixtures};

fn text_of(format: &'static str) -> (Fixture, String) {
    let fixture = fixtures(format, 0).remove(0);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    (fixture, text)
}

/// Reads a fixture with a part of its text replaced.
fn read(format: &'static str, from: &str, to: &str) -> Result<Recording, String> {
    let (fixture, text) = text_of(format);
    assert!(text.contains(from), "{from}: {text}");
    let bytes: Vec<u8> = text.replace(from, to).chars().map(|c| c as u8).collect();
    read_all_bytes("f", &bytes, &fixture.options)
        .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

fn refused(read: Result<Recording, String>, words: &[&str]) {
    let error = read.unwrap_err();
    assert!(
        words.iter().all(|w| error.contains(w)),
        "{words:?}: {error}"
    );
}

/// The peak of a DYNA header is in the unit of its key.
#[test]
fn dyna_peaks_by_the_unit_of_their_key() {
    let (fixture, text) = text_of("dyna");
    let values = text.split_once("USER5: \n").unwrap().1;
    let metres: String = values
        .lines()
        .map(|l| format!("{:.8}\n", 0.01 * l.parse::<f64>().unwrap()))
        .collect();
    let text = text
        .replace(values, &metres)
        .replace("UNITS: cm/s^2", "UNITS: m/s^2");
    let found = read_all_bytes("f", text.as_bytes(), &fixture.options).unwrap();
    assert!(found.series[0].origin.warnings.is_empty());
    assert_eq!(found.series[0].header_peak.unwrap().unit, "cm/s2");
    let wrong = read("dyna", "UNITS: cm/s^2", "UNITS: mg");
    refused(
        wrong,
        &["f:11:1: the samples have the peak of the header in cm/s2"],
    );
}

#[test]
fn isesd_record_lengths_and_steps() {
    let step = |to: &str| {
        let found = read("isesd", "0.010000s", to)?;
        match found.series[0].sampling {
            Sampling::Even { time_step } => Ok(time_step),
            Sampling::Uneven { .. } => Err("uneven".to_owned()),
        }
    };
    for text in ["0.010000s", "0.01", "100 Hz", "10 ms"] {
        assert!((step(text).unwrap() - 0.01).abs() < 1e-15, "{text}");
    }
    let error = step("0.01 min").unwrap_err();
    assert!(
        error.contains("f:8:1: \"MIN\" is not a unit of a time step"),
        "{error}"
    );
    let length = |text: &str| {
        let to = format!("record length: {text}\nnumber of samples");
        read("isesd", "number of samples", &to)
    };
    length("0.22 s").unwrap();
    refused(
        length("40.0 s"),
        &["f:9:1: the header says a duration of 40 s", "lenient"],
    );
}

#[test]
fn jma_rates_and_steps() {
    for text in ["100Hz", "100", "10 msec", "0.01s", "10ms"] {
        let found = read("jma_csv", "100Hz", text).unwrap();
        let Sampling::Even { time_step } = found.series[0].sampling else {
            panic!("{text}");
        };
        assert!((time_step - 0.01).abs() < 1e-15, "{text}: {time_step}");
    }
    refused(
        read("jma_csv", "100Hz", "100 furlongs"),
        &["f:4:1", "\"FURLONGS\""],
    );
}

#[test]
fn asa_channels_with_a_minus() {
    read("asa", "/N00E;/", "/N00E;+/").unwrap();
    refused(
        read("asa", "/N00E;/", "/N00E;-/"),
        &["f:6:1: the sense of \"N00E;-\" is minus", "ask the agency"],
    );
}

/// Key words in capitals or not.
#[test]
fn components_in_any_case() {
    let (_, text) = text_of("geo_net");
    let plain = read("geo_net", "Component ", "Component ").unwrap();
    let capitals = read("geo_net", "Component ", "COMPONENT ").unwrap();
    assert_eq!(
        plain.series[0].component, capitals.series[0].component,
        "{text}"
    );
    assert_ne!(plain.series[0].component, "");
    let plain = read("bhrc", "Azimuth L", "Azimuth L").unwrap();
    let capitals = read("bhrc", "Azimuth L", "AZIMUTH L").unwrap();
    assert_eq!(plain.series[0].component, capitals.series[0].component);
    assert!(plain.series[0].component.ends_with("deg"));
}

fn at2(title: &str, unit: &str, counts: &str) -> String {
    format!("PEER STRONG MOTION DATABASE RECORD\n{title}\n{unit}\n{counts}\n 0.0 0.1 -0.2\n")
}

#[test]
fn units_of_at2_are_those_of_the_line_on_the_values() {
    let counts = "NPTS= 3, DT= .01 SEC";
    let read = |text: &str| read_bytes("f", text.as_bytes(), &ReadOptions::default());
    let series = "ACCELERATION TIME SERIES IN UNITS OF G";
    for title in ["UNITS OF CM/S2 BEFORE SCALING", "UNITS OF G", "A, B"] {
        let record = read(&at2(title, series, counts)).unwrap();
        assert!(
            (record.peak().value - 0.2 * 9.80665).abs() < 1e-12,
            "{title}"
        );
    }
    let error = read(&at2("UNITS OF CM/S2", "UNITS OF G", counts)).unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("f:3:1: the unit is g here, but cm/s2 in line 2"),
        "{error}"
    );
    let comma = read(&at2("A, B", series, "NPTS= 3, DT= 0,0100 SEC")).unwrap_err();
    assert!(
        comma
            .to_string()
            .contains("f:4:1: the time step \"0,0100\" has a decimal comma"),
        "{comma}"
    );
}

/// What a title says of units, counts and peaks is not taken for the header's.
#[test]
fn titles_of_at2_say_nothing_of_the_values() {
    for title in [
        "in units of cm/s2",
        "Velocity time history of the roof",
        "velocity TIME SERIES",
        "NPTS and DT of old file",
        "A; pga=0.3",
        "A; HP=0.1 and LP = 3",
        "12 points at equal spacing of 3 sec",
    ] {
        let written = Written {
            quantity: Quantity::Acceleration,
            samples: vec![0.0, 1.0, -2.0],
            time_step: 0.01,
            title: title.to_owned(),
            component: "N10E".to_owned(),
            initial: None,
            start_time: String::new(),
            orientation: None,
            processing: Processing::Unstated,
            remarks: Vec::new(),
        };
        let text = write_peer_at2(&written);
        let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(
            (record.samples().len(), record.time_step()),
            (3, 0.01),
            "{title}"
        );
        assert!((record.peak().value - 2.0).abs() < 1e-6, "{title}");
        let origin = record.origin().unwrap();
        assert!(
            !origin.warnings.iter().any(|w| w.contains("header")) && origin.low_corner.is_none(),
            "{title}"
        );
    }
}

/// Only what fills the last row is surplus: a row that stands twice is an error.
#[test]
fn rows_of_at2_that_stand_twice() {
    let row = "  0.1  0.2 -0.3  0.4  0.5 -0.1  0.3 -0.2\n";
    let file = |rows: usize, last: &str| {
        let counts = "NPTS= 27, DT= .01 SEC";
        let head = format!("R\nA, B\nACCELERATION TIME SERIES IN UNITS OF G\n{counts}\n");
        head + &row.repeat(rows) + last
    };
    let read = |text: String| read_bytes("f", text.as_bytes(), &ReadOptions::default());
    for last in ["  0.1  0.2 -0.3\n", "  0.1  0.2 -0.3  0  0  0  0  0\n"] {
        assert_eq!(read(file(3, last)).unwrap().samples().len(), 27);
        let error = read(file(4, last)).unwrap_err().to_string();
        assert!(error.contains("the header says 27 samples"), "{error}");
    }
}

/// The line before a block of Volume 2 may state another unit than cm and s.
#[test]
fn units_of_volume_2_blocks() {
    let (fixture, text) = text_of("csmip_v2");
    let no_peak = text.replace("Peak acceleration", "Most acceleration");
    let label = "points of accel data equally spaced at 0.010 sec, in cm/sec2. (8f10.5)";
    assert!(no_peak.contains(label));
    let read = |words: &str| {
        let text = no_peak.replace(label, &label.replace(", in cm/sec2.", words));
        read_all_bytes("f", text.as_bytes(), &fixture.options)
            .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
    };
    for (words, symbol) in [
        (", in cm/sec2.", "cm/s2"),
        (" in units of g.", "g"),
        (", in units of g.", "g"),
        (" (units: mm/sec2)", "mm/s2"),
        (" units=g,", "g"),
        ("", "cm/s2"),
    ] {
        assert_eq!(read(words).unwrap().series[0].unit, symbol, "{words}");
    }
    refused(
        read(", in cm/sec2. in units of g."),
        &["two units, cm/s2 and g"],
    );
    refused(read(" in units of furlongs"), &["\"furlongs\" is no unit"]);
    refused(read(" in units of cm"), &["acceleration in cm"]);
}

/// Units of midas files in words and in the labels of the axes.
#[test]
fn units_of_midas() {
    let line = "*UNIT&TYPE, GRAV, ACCEL";
    for unit in ["CM", "M"] {
        let to = format!("*UNIT&TYPE, {unit}, ACCEL");
        refused(
            read("midas_sgs", line, &to),
            &["f:6:1: ", "a unit of displacement"],
        );
    }
    let label = "Ground Accel. (g)";
    let other = read("midas_sgs", label, "Ground Accel. (gal)");
    refused(other, &["f:5:1: ", "cm/s2", "*UNIT&TYPE g"]);
    for times in ["msec", "ms"] {
        let other = read("midas_sgs", "Time(sec)", &format!("Time ({times})"));
        refused(other, &["f:4:1: ", times, "seconds"]);
    }
    for to in ["Ground Accel.", "Ground Accel. (whatever)"] {
        assert_eq!(read("midas_sgs", label, to).unwrap().series[0].unit, "g");
    }
}
