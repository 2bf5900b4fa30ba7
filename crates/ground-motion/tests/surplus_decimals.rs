//! Values with more decimals than all others: a digit came in, or the point moved to the left.
use pounding_ground_motion::{ReadOptions, read_all_bytes, read_bytes};

/// 240 values of a decaying motion as `print` writes them; that of `at` is damaged by `change`.
fn values(
    print: impl Fn(f64) -> String,
    at: usize,
    change: impl Fn(&str) -> String,
) -> Vec<String> {
    let value = |i: usize| {
        let t = 0.02 * i as f64;
        0.3 * f64::exp(-0.2 * t) * f64::sin(7.0 * t + 0.1) + 0.04 * f64::cos(31.0 * t)
    };
    let printed = |i: usize| {
        let printed = print(value(i));
        if i == at { change(&printed) } else { printed }
    };
    (0..240).map(printed).collect()
}

fn at2(values: &[String]) -> String {
    let rows: String = values
        .chunks(8)
        .map(|row| row.iter().map(|v| format!(" {v:>15}")).collect::<String>() + "\n")
        .collect();
    format!(
        "PEER\nQUAKE, STATION, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {}, DT= .02 SEC\n{rows}",
        values.len()
    )
}

fn columns(values: &[String]) -> String {
    let rows = values.iter().enumerate();
    let rows: String = rows
        .map(|(i, value)| format!("{:.2},{value}\n", 0.02 * i as f64))
        .collect();
    format!("time (s),acceleration (g)\n{rows}")
}

fn read(text: &str) -> Result<usize, String> {
    let found = read_bytes("f", text.as_bytes(), &ReadOptions::default());
    let found = found.map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()));
    found.map(|record| record.samples().len())
}

fn with_exponent(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$e}");
    let (mantissa, power) = text.split_once('e').unwrap();
    let power: i32 = power.parse().unwrap();
    let sign = if power < 0 { '-' } else { '+' };
    format!("{mantissa}E{sign}{:02}", power.abs())
}

#[test]
fn a_digit_more_is_refused() {
    let stray = |text: &str| text.replacen("0.", "0.9", 1);
    let moved = |text: &str| {
        let at = text.find('.').unwrap();
        format!(
            "{}.{}{}",
            &text[..at - 1],
            &text[at - 1..at],
            &text[at + 1..]
        )
    };
    let fixed = |x: f64| format!("{x:.5}");
    let large = |x: f64| format!("{:.6}", 981.0 * x);
    for write in [at2, columns] {
        let (first, line) = match write(&[]).starts_with("PEER") {
            true => (5, 12),
            false => (2, 61),
        };
        for text in [
            write(&values(fixed, 59, stray)),
            write(&values(large, 59, moved)),
            write(&values(|x| with_exponent(x, 2), 59, moved)),
            write(&values(|x| with_exponent(x, 7), 59, moved)),
        ] {
            let said = read(&text).unwrap_err();
            assert!(
                said.starts_with(&format!("f:{line}:"))
                    && said.contains("but the other values have"),
                "{said}"
            );
            assert!(said.contains("correct the value"), "{said}");
        }
        // The first value, too.
        let said = read(&write(&values(fixed, 0, stray))).unwrap_err();
        assert!(said.starts_with(&format!("f:{first}:")), "{said}");
        assert!(
            said.contains("has 6 decimals, but the other values have 5"),
            "{said}"
        );
        assert!(
            said.contains("if it is right, write it as the others"),
            "{said}"
        );
    }
    let dyna = |values: &[String]| {
        format!(
            "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.02\nNDATA: 240\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n{}\n",
            values.join("\n")
        )
    };
    let read = |text: String| read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
    read(dyna(&values(large, 999, moved))).unwrap();
    let said = read(dyna(&values(large, 59, moved)))
        .unwrap_err()
        .to_string();
    assert!(
        said.starts_with("f:66:") && said.contains("7 decimals"),
        "{said}"
    );
}

/// `%.5g` with zeros at the end, and without.
fn general(x: f64, digits: i32, keeps_zeros: bool) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let power = x.abs().log10().floor() as i32;
    let decimals = (digits - 1 - power).max(0) as usize;
    let text = format!("{x:.decimals$}");
    match keeps_zeros || !text.contains('.') {
        true => text,
        false => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
    }
}

/// Writers of other numbers of decimals, in which one value alone may have more than the others.
#[test]
fn other_writers_are_read() {
    let same = |text: &str| text.to_owned();
    let printers: Vec<Box<dyn Fn(f64) -> String>> = vec![
        Box::new(|x| format!("{x:.5}")),
        Box::new(|x| format!("{:.1}", 981.0 * x)),
        Box::new(|x| format!("{x}")),
        Box::new(|x| format!("{}", x as f32)),
        Box::new(|x| format!("{x:e}")),
        Box::new(|x| with_exponent(x, 6)),
        Box::new(|x| general(x, 5, false)),
        Box::new(|x| general(x, 5, true)),
        // Nearly all from 1 to 10, one below: as many digits or characters.
        Box::new(|x| general(2.0 + x, 6, true)),
        Box::new(|x| general(-2.0 - 5.0 * x.abs(), 6, true)),
        Box::new(|x| format!("{:.1}", (981.0 * x).round())),
    ];
    for (k, print) in printers.iter().enumerate() {
        for write in [at2, columns] {
            for first in ["", "0", "0.0", "0.000"] {
                let mut text = values(print, 999, same);
                if !first.is_empty() {
                    text.insert(0, first.to_owned());
                    text.push(first.to_owned());
                }
                let read = read(&write(&text));
                assert_eq!(read.as_ref(), Ok(&text.len()), "{k}: {read:?}");
            }
        }
    }
    let odd = [
        // As many digits, as many characters, round-off, a mean of whole numbers.
        ("0.987654", values(|x| general(2.0 + x, 6, true), 999, same)),
        (
            "0.30000000000000004",
            values(|x| format!("{x:.2}"), 999, same),
        ),
        (
            "12.25",
            values(|x| format!("{:.1}", (981.0 * x).round()), 999, same),
        ),
    ];
    for (value, mut text) in odd {
        text[100] = value.to_owned();
        assert_eq!(read(&columns(&text)), Ok(240), "{value}");
    }
}
