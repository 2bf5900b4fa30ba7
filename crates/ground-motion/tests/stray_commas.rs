//! A comma in one of many rows of numbers with blanks between them: a minus that was damaged.
use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_all_bytes};

const COUNT: usize = 400;

fn value(i: usize) -> f64 {
    0.3 * f64::sin(0.07 * i as f64 + 0.1)
}

/// The number of samples that are read, or what is said.
fn read(text: &str, options: &ReadOptions) -> Result<usize, String> {
    match read_all_bytes("f", text.as_bytes(), options) {
        Ok(found) => Ok(found.series[0].samples.len()),
        Err(e) => Err(format!("{e}; {}", e.help().unwrap_or_default())),
    }
}

fn rows(width: usize, print: impl Fn(usize) -> String) -> String {
    let values: Vec<String> = (0..COUNT).map(print).collect();
    let rows = values.chunks(width);
    rows.map(|row| row.concat() + "\n").collect()
}

#[test]
fn a_minus_that_became_a_comma() {
    let plain = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let at2 = format!(
        "PEER\nQUAKE, STATION, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {COUNT}, DT= .01 SEC\n"
    );
    let dyna = format!(
        "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: {COUNT}\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n"
    );
    let timed = ReadOptions {
        unit: plain.unit,
        ..ReadOptions::default()
    };
    let one = |i: usize| format!("{:12.6}", value(i));
    let at_start = |i: usize| format!("{:.6}", value(i));
    let pair = |i: usize| format!("{:8.2}{:12.6}", 0.01 * i as f64, value(i));
    for (header, body, options) in [
        (&*at2, rows(5, one), &ReadOptions::default()),
        (&*dyna, rows(1, one), &ReadOptions::default()),
        (&*dyna, rows(1, at_start), &ReadOptions::default()),
        ("", rows(1, one), &plain),
        ("", rows(5, one), &plain),
        ("", rows(1, pair), &timed),
    ] {
        let text = format!("{header}{body}");
        assert_eq!(read(&text, options), Ok(COUNT), "{text}");
        // Every tenth minus of the values.
        let from = header.len();
        let places = text[from..].match_indices('-').map(|(at, _)| from + at);
        for at in places.step_by(10) {
            let damaged = format!("{},{}", &text[..at], &text[at + 1..]);
            let said = read(&damaged, options).unwrap_err();
            let line = text[..at].matches('\n').count() + 1;
            let column = at - text[..at].rfind('\n').map_or(0, |end| end + 1) + 1;
            let place = format!("f:{line}:{column}: ");
            assert!(said.starts_with(&place), "{said}");
            assert!(said.contains("may have been a minus"), "{said}");
        }
    }
}

/// Commas between all numbers, also behind blanks, are separators.
#[test]
fn commas_throughout_are_read() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    for between in [",", " ,", ", ", " , "] {
        let text = rows(1, |i| {
            format!("{:.2}{between}{:.6}", 0.01 * i as f64, value(i))
        });
        assert_eq!(read(&text, &options), Ok(COUNT), "{between}");
    }
}

/// Several in one row, and none in lines that are passed over.
#[test]
fn commas_of_a_row_and_of_lines_passed_over() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let text = rows(5, |i| format!("{:12.6}", value(i)));
    let two = format!("{text}   0.12345    ,0.02970    ,0.12345    0.1   0.1\n");
    let said = read(&two, &options).unwrap_err();
    assert!(said.starts_with("f:81:15: "), "{said}");
    let above = format!("1 ,2\n{text}");
    let skipping = ReadOptions {
        skip_lines: 1,
        ..options
    };
    assert_eq!(read(&above, &skipping), Ok(COUNT));
}
