//! Numbers of headers that are damaged: what they are held against is said not to be; and errors name their own line.
use crate::common::fixtures;
use pounding_ground_motion::{ReadOptions, Recording, read_all_bytes};

/// The first fixture of a format with a change of its text, for which the place of the change is looked up.
fn changed(format: &'static str, from: &str, to: &str) -> (Result<Recording, String>, usize) {
    let fixture = fixtures(format, 0).remove(0);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    assert!(text.contains(from), "{from} is not in {text}");
    let text = text.replacen(from, to, 1);
    let line = text.lines().position(|line| line.contains(to)).unwrap() + 1;
    let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
    let options = ReadOptions {
        component: None,
        ..fixture.options
    };
    let found = read_all_bytes("f", &bytes, &options);
    (found.map_err(|e| e.to_string()), line)
}

fn warns(format: &'static str, from: &str, to: &str, words: &[&str]) {
    let (found, line) = changed(format, from, to);
    let found = found.unwrap();
    let warnings: Vec<&String> = found
        .series
        .iter()
        .flat_map(|s| &s.origin.warnings)
        .collect();
    let place = format!("line {line}: ");
    let says = |w: &&String| w.contains(&place) && words.iter().all(|word| w.contains(word));
    assert!(warnings.iter().any(says), "{format}, {to}: {warnings:?}");
}

/// Replaces the first digits behind a key by others that are damaged.
fn damaged(format: &'static str, key: &str) -> (String, String, String) {
    let fixture = fixtures(format, 0).remove(0);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    let from = text.find(key).unwrap() + key.len();
    let number = text[from..].trim_start();
    let number = number.split([' ', '\n']).next().unwrap();
    let point = number.find('.').unwrap();
    let wrong = format!("{}.x{}", &number[..point], &number[point + 1..]);
    let end = from + text[from..].find(number).unwrap();
    let found = format!("{key}{}", &text[from..end + number.len()]);
    let put = format!("{key}{}{wrong}", &text[from..end]);
    (found, put, wrong)
}

#[test]
fn numbers_that_cannot_be_read_are_named() {
    for (format, key) in [
        ("dyna", "PGA_CM/S^2:"),
        ("dyna", "TIME_PGA_S:"),
        ("nsmn", "(N-S)"),
        ("geo_net", "at intervals of"),
        ("geo_net", "Acceleration:  Peak"),
    ] {
        let (from, to, wrong) = damaged(format, key);
        warns(format, &from, &to, &[&wrong, "is not held against"]);
    }
    warns(
        "dyna",
        "DURATION_S: ",
        "DURATION_S: 0.2x",
        &["DURATION_S", "0.2x"],
    );
}

#[test]
fn errors_of_dyna_name_their_line() {
    for (from, to, word) in [
        (
            "SAMPLING_INTERVAL_S: 0.01",
            "SAMPLING_INTERVAL_S: 0",
            "time step",
        ),
        (
            "DATA_TYPE: ACCELERATION",
            "DATA_TYPE: VELOCITY",
            "DATA_TYPE",
        ),
        ("DURATION_S: ", "DURATION_S: 17.5", "a duration of 17.5 s"),
    ] {
        let (found, line) = changed("dyna", from, to);
        let error = found.unwrap_err();
        assert!(error.starts_with(&format!("f:{line}:")), "{error}");
        assert!(error.contains(word), "{error}");
    }
}

/// A date of SMC that is damaged leaves out the start, which is said.
#[test]
fn damaged_dates_of_smc() {
    let fixture = fixtures("usgs_smc", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    // Integers of ten characters, from line 12 on; year and day of the year are the second and third.
    let read = |index: usize, field: &str| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let values = ["1989", "291", "0", "4", "0"];
        for (k, value) in values.into_iter().enumerate() {
            lines[11].replace_range(10 * (k + 1)..10 * (k + 2), &format!("{value:>10}"));
        }
        if index > 0 {
            lines[11].replace_range(10 * (index - 1)..10 * index, &format!("{field:>10}"));
        }
        let text = lines.join("\n") + "\n";
        let found = read_all_bytes("f", text.as_bytes(), &fixture.options).unwrap();
        found.series[0].origin.clone()
    };
    assert_eq!(read(0, "").start_time, "1989 day 291 00:04:00.000");
    for (index, field) in [(2, "19-9"), (3, "2x1"), (4, "0x"), (6, "1-2")] {
        let origin = read(index, field);
        assert_eq!(origin.start_time, "", "{field}");
        let says = |w: &String| w.contains(field) && w.contains("line 12:");
        assert!(origin.warnings.iter().any(says), "{:?}", origin.warnings);
    }
}

/// Keys of our CSV that contradict one another, and a step that is not in seconds.
#[test]
fn keys_of_our_csv() {
    let read = |keys: &str| {
        let rows: String = (0..50)
            .map(|i| format!("{:.2},{:.3}\n", 0.01 * f64::from(i), f64::from(i % 7) - 3.0))
            .collect();
        let text = format!("{keys}\ntime_s,acceleration_m_s2\n{rows}");
        let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
        found.map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
    };
    for (key, first, second) in [
        (
            "Start",
            "2011/03/11 14:46:15 JST",
            "2011/03/11 14:46:30 JST",
        ),
        ("Component", "EW", "HNE"),
        ("Azimuth", "90 degrees", "91 degrees"),
        ("Samples", "50", "51"),
        ("First time", "1 s", "2 s"),
    ] {
        let error = read(&format!("# {key}: {first}\n# {key}: {second}")).unwrap_err();
        assert!(error.starts_with("f:2:"), "{error}");
        let words = [first, second, "in line 1"];
        assert!(words.iter().all(|word| error.contains(word)), "{error}");
        read(&format!("# {key}: {first}\n# {key}: {first}")).unwrap();
    }
    let error = read("# dt: 10 ms").unwrap_err();
    let words = [
        "f:1:",
        "\"10 ms\" is not a number of seconds",
        "`# dt: 0.01 s`",
    ];
    assert!(words.iter().all(|word| error.contains(word)), "{error}");
}
