//! What headers state of units, steps and factors in sentences rather than under keys.
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Recording, Sampling, read_all_bytes,
};

/// Samples of each file.
const COUNT: usize = 300;

/// Values of which none is a round number, one in a row.
fn values() -> String {
    let value = |i: usize| 0.3 * (0.37 * i as f64).sin() * (-0.01 * i as f64).exp() + 0.0012;
    (0..COUNT).map(|i| format!("{:.5}\n", value(i))).collect()
}

/// A file of plain columns with these lines before the values.
fn plain(header: &str) -> String {
    format!("{header}\n{}", values())
}

/// A file of AT2 whose values have a step of 0.02 s, with one more line in its header.
fn at2(unit: &str, line: &str) -> String {
    format!(
        "PEER STRONG MOTION DATABASE RECORD\nQUAKE, 180\n{unit}\n{line}\nNPTS= {COUNT}, DT= .02 SEC\n{}",
        values()
    )
}

fn read(text: &str) -> Result<Recording, GroundMotionError> {
    read_all_bytes("file", text.as_bytes(), &ReadOptions::default())
}

/// The largest sample (m/s2).
fn peak(recording: &Recording) -> f64 {
    let samples = &recording.series[0].samples;
    samples.iter().fold(0.0_f64, |most, a| most.max(a.abs()))
}

/// The even step (s).
fn step(recording: &Recording) -> f64 {
    match recording.series[0].sampling {
        Sampling::Even { time_step } => time_step,
        Sampling::Uneven { .. } => f64::NAN,
    }
}

fn is_warned_of(recording: &Recording, words: &str) -> bool {
    let mut warnings = recording.series[0].origin.warnings.iter();
    warnings.any(|warning| warning.contains(words))
}

/// The file is refused at this line, in words that hold these.
fn refused(text: &str, line: usize, words: &[&str]) {
    let error = read(text)
        .err()
        .unwrap_or_else(|| panic!("read: {}", &text[..120]));
    let shown = format!("{error}; {}", error.help().unwrap());
    assert!(
        shown.starts_with(&format!("file:{line}:")),
        "{line}: {shown}"
    );
    for word in words {
        assert!(shown.contains(word), "{word} is not in {shown}");
    }
}

#[test]
fn units_of_the_values_in_sentences() {
    let of_g = peak(&read(&plain("units: g\ndt: 0.02 s")).unwrap());
    for (line, unit) in [
        ("Values in units of g", 1.0),
        ("# Values in units of g.", 1.0),
        ("values in units of g/10", 0.1),
        ("All values are in g", 1.0),
        ("Data are given in units of g", 1.0),
        ("Data are in cm/s2 (gal)", 0.01 / 9.80665),
        ("The acceleration values are in mm/s2.", 0.001 / 9.80665),
        ("% (data expressed in mm/s2)", 0.001 / 9.80665),
        ("in units of g", 1.0),
        ("Units are in cm/s2", 0.01 / 9.80665),
        ("Data in mm/s2 and seconds", 0.001 / 9.80665),
        ("Los valores son en cm/s2", 0.01 / 9.80665),
    ] {
        let recording = read(&plain(&format!("{line}\ndt: 0.02 s")));
        let found = peak(&recording.unwrap_or_else(|e| panic!("{line}: {e}")));
        assert!(
            (found / (unit * of_g) - 1.0).abs() < 1e-9,
            "{line}: {found}"
        );
        // Beside a key with another unit, and against the option.
        refused(
            &plain(&format!("units: in/s2\n{line}\ndt: 0.02 s")),
            2,
            &["in/s2 in line 1"],
        );
        let options = ReadOptions {
            unit: Some(AccelerationUnit::FootPerSecondSquared),
            ..ReadOptions::default()
        };
        let text = plain(&format!("{line}\ndt: 0.02 s"));
        let error = read_all_bytes("file", text.as_bytes(), &options).unwrap_err();
        assert!(
            matches!(error, GroundMotionError::Contradiction { .. }),
            "{error}"
        );
    }
    // Words that state no unit.
    for line in [
        "Data recorded in cm/s2",
        "Data recorded in cm/s2, converted to g",
        "Data recorded in counts, converted to g",
        "Data recorded in N. California",
        "Data measured in gal",
        "Data in N",
        "Data in N, E, Z",
        "Spectral ordinates, values in cm/s2",
        "Before processing, values in gal",
        "Original file, values in cm/s2",
        "PGA 120.5, values in cm/s2",
        "Full scale 2, values in g",
        "PGV 12.3, values in cm/s",
        "Vs30 360; values in m/s",
        "Site depth 30, data in m",
        "Data in columns",
        "Units are in cm and seconds",
        "Units are in m and s",
        "Units in metres and seconds",
        "Units are in cm",
        "Units in counts",
        "Data in m and s",
        "Values in ASCII",
        "Data recorded in Taiwan",
    ] {
        let text = plain(&format!("units: g\n{line}\ndt: 0.02 s"));
        assert!(
            (peak(&read(&text).unwrap()) / of_g - 1.0).abs() < 1e-9,
            "{line}"
        );
    }
    // Alone they state none, either.
    for line in [
        "Data recorded in cm/s2, converted to g",
        "Original file, values in cm/s2",
        "Full scale 2, values in g",
    ] {
        let error = read(&plain(&format!("{line}\ndt: 0.02 s"))).unwrap_err();
        assert!(format!("{error}").contains("unit"), "{line}: {error}");
    }
}

#[test]
fn units_of_the_values_in_sentences_of_at2() {
    let in_g = "ACCELERATION TIME HISTORY IN UNITS OF G";
    let of_g = peak(&read(&at2(in_g, "Values in g")).unwrap());
    refused(
        &at2(in_g, "Values in units of cm/s2"),
        4,
        &["cm/s2 here", "g in line 3"],
    );
    refused(
        &at2(in_g, "DATA ARE IN CM/S2"),
        4,
        &["cm/s2 here", "g in line 3"],
    );
    for line in [
        "DATA RECORDED IN CM/S2, CONVERTED TO G",
        "PGA 120.5, VALUES IN CM/S2",
        "ORIGINAL FILE, VALUES IN CM/S2",
    ] {
        let found = peak(&read(&at2(in_g, line)).unwrap());
        assert!((found / of_g - 1.0).abs() < 1e-9, "{line}: {found}");
    }
    let alone = peak(&read(&at2("QUAKE OF A DAY", "Values in cm/s2")).unwrap());
    assert!((alone / of_g * 980.665 - 1.0).abs() < 1e-9, "{alone}");
}

#[test]
fn rates_beside_other_steps() {
    let given = ReadOptions {
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let alone = plain("units: g\nRate: 100 Hz");
    assert_eq!(step(&read(&alone).unwrap()), 0.01);
    let error = read_all_bytes("file", alone.as_bytes(), &given).unwrap_err();
    assert!(
        matches!(error, GroundMotionError::Contradiction { .. }),
        "{error}"
    );
    for (header, line) in [
        ("units: g\nRate: 100 Hz\ndt: 0.02 s", 3),
        ("units: g\nRate (Hz): 100\ndt: 0.02 s", 3),
        ("units: g\nSampling rate 200 Hz, 0.02 s", 2),
        ("units: g\nSampling rate: 200 Hz (0.02 s)", 2),
        ("units: g\nSampling rate: 200 Hz; 20 ms", 2),
        ("units: g\nSampling rate: 200 Hz = 0.02 s", 2),
    ] {
        refused(&plain(header), line, &["0.02 s here", "--time-step"]);
    }
    for (header, seconds) in [
        ("units: g\nRate: 50 Hz\ndt: 0.02 s", 0.02),
        ("units: g\nRate: 5\ndt: 0.02 s", 0.02),
        ("units: g\nSampling rate 200 Hz, 0.005 s", 0.005),
        ("units: g\nSampling rate: 200 Hz = 0.005 s", 0.005),
        ("units: g\nSampling rate = 50 Hz", 0.02),
        ("units: g\nSampling rate 50 Hz, 6 s", 0.02),
        ("units: g\nSampling rate: 50 Hz, taper (0.1 s)", 0.02),
        ("units: g\nSampling rate: 50 Hz, delay, 0.05 s", 0.02),
        (
            "units: g\nSampling rate: 50 Hz, low-pass 25 Hz, 0.05 s",
            0.02,
        ),
        (
            "units: g\nSampling rate: 50 Hz, high cut 25 Hz (0.04 s)",
            0.02,
        ),
        ("units: g\nSampling rate 50 Hz, 0.1 s, taper", 0.02),
        ("units: g\nLow-pass filter, rate: 100 Hz\ndt: 0.02 s", 0.02),
    ] {
        let recording = read(&plain(header)).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(step(&recording), seconds, "{header}");
        assert!(!is_warned_of(&recording, "frequency"), "{header}");
    }
    let unit = "ACCELERATION TIME HISTORY IN UNITS OF G";
    refused(
        &at2(unit, "Rate: 100 Hz"),
        5,
        &["0.02 s", "0.01 s", "in line 4"],
    );
    assert_eq!(step(&read(&at2(unit, "Rate: 50 Hz")).unwrap()), 0.02);
}

/// A frequency alone is that of sampling; beside a step it may be of a filter or an instrument.
#[test]
fn frequencies_beside_other_steps() {
    let words = "a frequency of 100 Hz is stated, but the samples are 0.02 s apart";
    let given = ReadOptions {
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let alone = plain("units: g\nFrequency: 100 Hz");
    assert_eq!(step(&read(&alone).unwrap()), 0.01);
    let recording = read_all_bytes("file", alone.as_bytes(), &given).unwrap();
    assert_eq!(step(&recording), 0.02);
    assert!(is_warned_of(&recording, words));
    let unit = "ACCELERATION TIME HISTORY IN UNITS OF G";
    for text in [
        plain("units: g\nFrequency: 100 Hz\ndt: 0.02 s"),
        at2(unit, "Frequency: 100 Hz"),
    ] {
        let recording = read(&text).unwrap();
        assert_eq!(step(&recording), 0.02);
        assert!(is_warned_of(&recording, words));
    }
    for text in [
        plain("units: g\nFrequency: 50 Hz\ndt: 0.02 s"),
        plain("units: g\nNatural frequency: 100 Hz\ndt: 0.02 s"),
        // As low as a filter's.
        plain("units: g\nFrequency: 25 Hz\ndt: 0.005 s"),
        at2(unit, "Frequency: 50 Hz"),
    ] {
        assert!(!is_warned_of(&read(&text).unwrap(), "frequency of"));
    }
}

#[test]
fn factors_in_sentences() {
    let unit = "ACCELERATION TIME HISTORY IN UNITS OF G";
    for (line, factor) in [
        ("Divide values by 10 to get g", "0.1"),
        ("Multiply values by 0.1 to get g", "0.1"),
        ("Divide by 10", "0.1"),
        ("Scale the values by 0.1", "0.1"),
        ("# All accelerations scaled by 2.", "2"),
        ("Amplification 10", "10"),
        ("# Amplification: 10", "10"),
        ("Amplification factor: 10", "10"),
        ("Multiply by 10^-3", "0.001"),
        ("Multiply values by 10**-3 to get g", "0.001"),
        ("Scale factor = 10^(2)", "100"),
        ("Multiply by 10**3", "1000"),
        ("Scale factor = 10**(2)", "100"),
        ("Multiply by 10**5\u{e9}", "100000"),
        ("Scale factor: 2*10^-3", "0.002"),
        ("Scale factor: 2 x 10**2", "200"),
        ("Multiply by 10^400", "10"),
        ("Escala: 0.1", "0.1"),
        ("Multiply by 0.1", "0.1"),
    ] {
        let words = format!("a factor of {factor} is stated, which is not applied");
        for text in [
            plain(&format!("units: g\ndt: 0.02 s\n{line}")),
            at2(unit, line),
        ] {
            let recording = read(&text).unwrap_or_else(|e| panic!("{line}: {e}"));
            let warnings = &recording.series[0].origin.warnings;
            assert!(is_warned_of(&recording, &words), "{line}: {warnings:?}");
            assert_eq!(warnings.len(), 1, "{line}: {warnings:?}");
        }
    }
    for line in [
        "Divided into 10 parts",
        "Magnification: 1000 (instrument)",
        "Instrument magnification: 1000",
        "Amplification factor S: 1.15",
        "Amplification 10 at 5 Hz",
        "Scale by 2 the time",
        "Scale by hand",
        "Recorded by 2 instruments",
        "Scale the values by 1",
        "Note 10**2",
        "Notes 10**3 10^4 10**(5) 110^2",
    ] {
        let recording = read(&plain(&format!("units: g\ndt: 0.02 s\n{line}"))).unwrap();
        assert!(!is_warned_of(&recording, "factor"), "{line}");
    }
}

#[test]
fn gravities_that_are_stated() {
    let unit = "ACCELERATION TIME HISTORY IN UNITS OF G";
    let told = "a g of 9.81 m/s2 is stated, but 9.80665 m/s2 is used";
    for text in [
        plain("units: g (1 g = 9.81 m/s2)\ndt: 0.02 s"),
        plain("units: g\ng = 9.81\ndt: 0.02 s"),
        plain("# gravity: 9.81 m/s2\nunits: g\ndt: 0.02 s"),
        plain("units: g\nAcceleration of gravity = 981 cm/s^2\ndt: 0.02 s"),
        at2(unit, "1 G = 9.81 M/S2"),
        at2(&format!("{unit} (G = 9.81 M/S2)"), "QUAKE"),
    ] {
        let recording = read(&text).unwrap_or_else(|e| panic!("{}: {e}", &text[..40]));
        assert!(is_warned_of(&recording, told), "{}", &text[..40]);
        assert!(is_warned_of(&recording, "--gravity \"9.81 m/s2\""));
        let options = ReadOptions {
            gravity: Some(9.81),
            ..ReadOptions::default()
        };
        let recording = read_all_bytes("file", text.as_bytes(), &options).unwrap();
        assert!(!is_warned_of(&recording, "a g of"));
    }
    for header in [
        "units: g\ng = 9.80665 m/s2",
        "units: g\ng = 9.807",
        "units: m/s2\ng = 9.81",
        "units: g\nVs30 g 9.81",
        "units: g\nMax value in g: 9.75",
        "units: g\nDistance g: 9.75",
        "units: g\nNumber of values above g: 980",
        "units: g\nN of samples above 0.1 g: 981",
        "units: g\nRange +-2 g (980 gal)",
        "units: g\nUnit weight of soil: g = 9.8",
        "units: g\nUnit weight of soil (g = 9.8)",
    ] {
        let recording = read(&plain(&format!("{header}\ndt: 0.02 s")));
        let recording = recording.unwrap_or_else(|e| panic!("{header}: {e}"));
        assert!(!is_warned_of(&recording, "a g of"), "{header}");
    }
}
