//! Numbers of headers are read by the units beside them, and words by their lines.
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
            first_time: None,
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

/// Axes of a spectrum in a file of midas.
#[test]
fn spectra_of_midas() {
    for (from, to, place) in [
        ("Time(sec)", "Period (sec)", "f:4:1: "),
        ("Time(sec)", "Frequency (Hz)", "f:4:1: "),
        ("Ground Accel. (g)", "Spectral Data (g)", "f:5:1: "),
    ] {
        refused(read("midas_sgs", from, to), &[place, "axis of a spectrum"]);
    }
}

/// The peaks of GeoNet have units of their own, and readings without one are of none.
#[test]
fn units_of_geo_net() {
    refused(
        read("geo_net", " mm/s/s at", " cm/s/s at"),
        &["f:14:1: the header's peak is", "cm/s2"],
    );
    refused(
        read("geo_net", " mm/s/s at", " mm/s at"),
        &["f:14:1: the peak is in mm/s, a unit of velocity"],
    );
    refused(
        read("geo_net", "in units of 1.00 mm/s/s", "        "),
        &["does not state the unit"],
    );
    refused(
        read("geo_net", "Number of points ", "Number of points 1"),
        &["f:10:1: the header says 1", "samples here"],
    );
}

#[test]
fn units_in_brackets() {
    refused(
        read("k_net", "(gal)/", "(m/s2)/"),
        &["f:14:", "\"m/s2\" where the format has gal"],
    );
    refused(
        read("k_net", "Max. Acc. (gal)", "Max. Acc. (m/s)"),
        &["f:15:", "\"m/s\" where the format has gal"],
    );
    read("jma_csv", "gal(cm/s/s)", "gal(cm/s/s)").unwrap();
    refused(
        read("jma_csv", "gal(cm/s/s)", "gal(m/s/s)"),
        &["f:5:1: two units, cm/s2 and m/s2"],
    );
    let nsmn = |unit: &str| read("nsmn", "INTERVAL (sec)", &format!("INTERVAL ({unit})"));
    for unit in ["sec", "s", "SECONDS"] {
        nsmn(unit).unwrap();
    }
    let step = |unit: &str| match nsmn(unit).unwrap().series[0].sampling {
        Sampling::Even { time_step } => time_step,
        Sampling::Uneven { .. } => f64::NAN,
    };
    let seconds = step("sec");
    assert!((step("milliseconds") - 1.0e-3 * seconds).abs() < 1e-15);
    assert!((step("Hz") - 1.0 / seconds).abs() < 1e-12);
    refused(nsmn("fortnights"), &["\"FORTNIGHTS\" is not a unit"]);
}

/// A unit that is not known is not passed over for one that stands elsewhere.
#[test]
fn units_that_are_not_known() {
    refused(
        read("bhrc", "SECONDS AND G/10", "SECONDS AND G/100"),
        &["f:12:1: \"g/100\" is no unit that is known"],
    );
    let volume_1 = |options: &ReadOptions| {
        let (_, text) = text_of("csmip_v1");
        let unit = "SEC AND G/10.";
        assert!(text.contains(unit), "{text}");
        let text = text.replace(unit, "SEC AND G/100.");
        read_all_bytes("f", text.as_bytes(), options).map_err(|e| e.to_string())
    };
    refused(
        volume_1(&ReadOptions::default()),
        &["f:12:1: \"g/100\" is no unit that is known"],
    );
}

/// What the header says that it stands for an unknown value is none of the series.
#[test]
fn values_that_cosmos_marks_as_unknown() {
    let (fixture, text) = text_of("cosmos");
    let data = text.lines().position(|l| l.contains("units=cm/sec2(04)"));
    let row = data.unwrap() + 2;
    let line = text.lines().nth(row - 1).unwrap().to_owned();
    let marked = format!("{}{:>10}{}", &line[..20], "-999.00000", &line[30..]);
    let marked = text.replacen(&line, &marked, 1);
    let found = read_all_bytes("f", marked.as_bytes(), &fixture.options).unwrap_err();
    let told =
        format!("f:{row}:21: sample 3 is -999, by which line 13 marks a value that is unknown");
    assert_eq!(found.to_string(), told);
    let other = marked.replace("-999, -999.00", "-998, -998.00");
    let found = read_all_bytes("f", other.as_bytes(), &fixture.options).unwrap_err();
    assert!(found.to_string().contains("the header's peak"), "{found}");
    let lenient = ReadOptions {
        lenient: true,
        ..fixture.options
    };
    let found = read_all_bytes("f", marked.as_bytes(), &lenient).unwrap();
    let warnings = &found.series[0].origin.warnings;
    assert!(warnings.iter().any(|w| w.contains("-999")), "{warnings:?}");
    let said = |w: &String| w.contains("marks a value that is unknown");
    assert!(warnings.iter().any(said), "{warnings:?}");
    // Another way to end a channel.
    read("cosmos", "End-of-data for Chan 1", "/&   end of data").unwrap();
}

/// Among counts it may be one of them: it is none where it leaps out of the record. A count is a whole number.
#[test]
fn counts_that_cosmos_marks_as_unknown() {
    let fixture = fixtures("cosmos", 0).remove(1);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    let (channel, _) = text.split_once("End-of-data").unwrap();
    let at = channel.find("raw accel. ").unwrap();
    let (header, rest) = channel.split_at(channel[..at].rfind('\n').unwrap() + 1);
    let (_, announcement) = rest.lines().next().unwrap().split_once("raw").unwrap();
    let data: Vec<f64> = rest
        .lines()
        .skip(1)
        .map(|l| l.trim().parse().unwrap())
        .collect();
    // A record of 60 counts, as large as the header says and where it says.
    let place = (0..data.len())
        .max_by(|a, b| data[*a].abs().total_cmp(&data[*b].abs()))
        .unwrap();
    let smooth = |i: usize, spread: f64| {
        let from = (i as f64 - place as f64) / spread;
        (data[place] * f64::exp(-from * from)).round()
    };
    let read = |spread: f64, changed: &[(usize, &str)], lenient: bool| {
        let mut counts: Vec<String> = (0..60).map(|i| format!("{}", smooth(i, spread))).collect();
        for (at, value) in changed {
            (*value).clone_into(&mut counts[*at]);
        }
        let counts: String = counts.iter().map(|c| format!("{c:>8}\n")).collect();
        let header = header.replace(".115000", ".300000");
        let text = format!("{header}      60 raw{announcement}\n{counts}End-of-data\n");
        let options = ReadOptions {
            lenient,
            ..fixture.options.clone()
        };
        read_all_bytes("f", text.as_bytes(), &options).map_err(|e| e.to_string())
    };
    let row = header.lines().count() + 2;
    assert_eq!(read(15.0, &[], false).unwrap().series[0].samples.len(), 60);
    let told = "is -999, by which line 13 marks a value that is unknown";
    for changed in [
        &[(25, "-999")][..],
        &[(25, "-999"), (26, "-999"), (27, "-999")],
        &[(25, "-999"), (27, "-999"), (35, "-999")],
    ] {
        let said = read(15.0, changed, false).unwrap_err();
        assert_eq!(said, format!("f:{}:1: sample 26 {told}", row + 25));
        let found = read(15.0, changed, true).unwrap();
        let warnings = &found.series[0].origin.warnings;
        assert!(warnings.iter().any(|w| w.contains(told)), "{warnings:?}");
    }
    // Also at an end, and behind the motion.
    for (spread, at) in [(15.0, 0), (8.0, 58), (8.0, 59)] {
        assert!(
            read(spread, &[(at, "-999")], false).is_err(),
            "{spread} {at}"
        );
    }
    // It follows its neighbours.
    let along = [(57, "-930"), (58, "-960"), (59, "-999")];
    assert!(read(8.0, &along, false).is_ok());
    let around = [(24, "400000"), (25, "-999"), (26, "-300000")];
    assert!(read(15.0, &around, false).is_ok());
    // A million of them are looked at once.
    let counts = "    -999\n".repeat(1_000_000);
    let header_of_many = header.replace(".115000", "5000.000000");
    let many = format!("{header_of_many} 1000000 raw{announcement}\n{counts}End-of-data\n");
    let found = read_all_bytes("f", many.as_bytes(), &fixture.options).unwrap();
    assert_eq!(found.series[0].samples.len(), 1_000_000);
    for (value, column) in [("-999.00", 2), ("-16088.", 2), ("-1.6E+5", 2)] {
        let said = read(15.0, &[(25, value)], false).unwrap_err();
        let told = format!(
            "f:{}:{column}: \"{value}\" is no whole number, as all are in the format of the values",
            row + 25
        );
        assert_eq!(said, told);
    }
}

/// A second record in a file of a format that holds one is not dropped.
#[test]
fn second_records() {
    for format in ["usgs_smc", "midas_sgs"] {
        let (fixture, text) = text_of(format);
        let lines = text.lines().count();
        let twice = text.clone() + &text;
        let error = read_all_bytes("f", twice.as_bytes(), &fixture.options).unwrap_err();
        let told = format!("f:{}:1: text behind the series", lines + 1);
        assert!(error.to_string().starts_with(&told), "{error}");
        read_all_bytes("f", (text + "\n \n").as_bytes(), &fixture.options).unwrap();
    }
}

/// The peak in the real numbers of GeoNet: unit and peak in the text may have been changed alone.
#[test]
fn peaks_of_geo_net_in_numbers() {
    for (name, index) in [("geo_net_v1a", 31), ("geo_net_v2a", 36)] {
        let fixture = fixtures("geo_net", 0)
            .into_iter()
            .find(|f| f.name == name)
            .unwrap();
        let text = String::from_utf8(fixture.bytes.clone()).unwrap();
        let printed = text.split("Peak").nth(1).unwrap();
        let peak: f64 = printed.split_whitespace().next().unwrap().parse().unwrap();
        let with = |value: f64, lenient: bool| {
            let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
            let (row, column) = (20 + (index - 1) / 10, 8 * ((index - 1) % 10));
            lines[row].replace_range(column..column + 8, &format!("{value:8.1}"));
            let options = ReadOptions {
                lenient,
                ..ReadOptions::default()
            };
            let text = lines.join("\n") + "\n";
            read_all_bytes("f", text.as_bytes(), &options).map_err(|e| e.to_string())
        };
        let found = with(peak, false).unwrap();
        let differs = |w: &String| w.contains("the header's peak");
        assert!(!found.series[0].origin.warnings.iter().any(differs));
        let line = 21 + (index - 1) / 10;
        refused(
            with(0.1 * peak, false),
            &[&format!("f:{line}:1: the header's peak is")],
        );
        let left = with(0.1 * peak, true).unwrap();
        assert!(left.series[0].origin.warnings.iter().any(differs));
    }
}
