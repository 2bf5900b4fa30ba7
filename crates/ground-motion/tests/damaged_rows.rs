//! Rows that stand in another order, twice or not at all, or have another number of values than
//! their neighbours, and values that lost their exponent: errors that name the row.
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, read_all_bytes, read_bytes,
};

use crate::common::fixtures;

fn options(layout: Option<&str>, time_step: Option<f64>) -> ReadOptions {
    ReadOptions {
        layout: layout.map(str::to_owned),
        unit: Some(AccelerationUnit::StandardGravity),
        time_step,
        ..ReadOptions::default()
    }
}

fn value(i: usize) -> f64 {
    0.1 * (1.7 * i as f64 + 1.0).sin()
}

fn count(rows: &[String], options: &ReadOptions) -> Result<usize, GroundMotionError> {
    let record = read_bytes("f", (rows.join("\n") + "\n").as_bytes(), options)?;
    Ok(record.samples().len())
}

/// Holds that the error names this line.
fn refused_at(rows: &[String], options: &ReadOptions, at: usize, words: &str) {
    let error = count(rows, options).unwrap_err();
    let GroundMotionError::Parse { line, message, .. } = &error else {
        panic!("{error}: {rows:?}");
    };
    assert_eq!(*line, at, "{error}");
    assert!(message.contains(words), "{error}");
    let help = error.help().unwrap_or_default();
    assert!(!help.contains("layout"), "{help}");
}

/// What can be wrong with rows that count themselves, and the row (from 0) that is named.
fn damages(rows: &[String], head: usize) -> Vec<(Vec<String>, usize)> {
    let at = head + (rows.len() - head) / 2;
    let mut dropped = rows.to_vec();
    dropped.remove(at);
    let mut exchanged = rows.to_vec();
    exchanged.swap(at, at + 1);
    let mut doubled = rows.to_vec();
    doubled.insert(at, rows[at].clone());
    vec![(dropped, at), (exchanged, at), (doubled, at + 1)]
}

/// Cards end in their own number: they were samples, or a row was missing.
#[test]
fn cards_that_do_not_count_on() {
    for all in [9, 15, 30] {
        let row = |i: usize| {
            let values: String = (0..8)
                .map(|k| format!("{:9.5}", value(8 * i + k)))
                .collect();
            format!("{values}{:7}", i + 1)
        };
        let rows: Vec<String> = (0..all).map(row).collect();
        for layout in [None, Some("8F9.5"), Some("8F9.5,I7")] {
            let options = options(layout, Some(0.01));
            assert_eq!(count(&rows, &options).unwrap(), 8 * all);
            for (damaged, at) in damages(&rows, 0) {
                refused_at(&damaged, &options, at + 1, "counts the rows");
            }
            let mut digit = rows.clone();
            digit[4] = digit[4].replace("      5", "      8");
            refused_at(&digit, &options, 5, "8 follows 4");
        }
    }
}

#[test]
fn row_numbers_of_a_header() {
    for names in ["No,Acc (g)", "id,Acc (g)", ",acc"] {
        let rows = (0..40).map(|i| format!("{},{:.5}", i + 1, value(i)));
        let rows: Vec<String> = std::iter::once(names.to_owned()).chain(rows).collect();
        let options = options(None, Some(0.01));
        if names.starts_with(char::is_alphabetic) {
            assert_eq!(count(&rows, &options).unwrap(), 40);
        }
        for (damaged, at) in damages(&rows, 1) {
            refused_at(&damaged, &options, at + 1, "counts the rows");
        }
    }
}

#[test]
fn a_damaged_time_beside_row_numbers() {
    let row = |i: usize| format!("{} {:.2} {:.5}", i + 1, 0.01 * i as f64, value(i));
    for all in [10, 60] {
        let rows: Vec<String> = (0..all).map(row).collect();
        assert_eq!(count(&rows, &options(None, None)).unwrap(), all);
        let mut damaged = rows.clone();
        damaged[5] = damaged[5].replace(" 0.05 ", " 0.50 ");
        refused_at(&damaged, &options(None, None), 6, "increase by 0.01");
        for (damaged, at) in damages(&rows, 0) {
            refused_at(&damaged, &options(None, None), at + 1, "counts the rows");
        }
    }
}

fn rows_of(widths: &[usize], print: &dyn Fn(f64) -> String) -> Vec<String> {
    let mut i = 0;
    let mut row = |width: &usize| -> String {
        i += width;
        (i - width..i).map(|k| print(value(k))).collect()
    };
    widths.iter().map(&mut row).collect()
}

/// A row with another number of values is damaged whatever the layout says; rows that all have
/// other ones follow one another.
#[test]
fn rows_of_another_number_of_values() {
    let print = |a: f64| format!("{a:9.5}");
    for (widths, at) in [
        (vec![4, 4, 3, 4, 4], 3),
        (vec![8, 8, 8, 3, 8], 4),
        (vec![5, 5, 5, 4, 6, 5, 5], 4),
        (vec![4, 4, 4, 5], 4),
    ] {
        let rows = rows_of(&widths, &print);
        let fixed = format!("{}F9.5", widths[0]);
        for layout in [None, Some("a")] {
            refused_at(&rows, &options(layout, Some(0.01)), at, "number of values");
        }
        let error = count(&rows, &options(Some(&fixed), Some(0.01))).unwrap_err();
        assert!(matches!(error, GroundMotionError::Parse { .. }), "{error}");
    }
    let rows = rows_of(&[8, 8, 8, 3], &print);
    for layout in [None, Some("a"), Some("8F9.5")] {
        assert_eq!(count(&rows, &options(layout, Some(0.01))).unwrap(), 27);
    }
    let rows = rows_of(&[5, 3, 6, 2, 4, 5, 3, 6, 5, 1], &print);
    let error = count(&rows, &options(None, Some(0.01))).unwrap_err();
    assert!(error.help().unwrap().contains("layout = \"a\""), "{error}");
    assert_eq!(count(&rows, &options(Some("a"), Some(0.01))).unwrap(), 40);
}

fn at2(widths: &[usize]) -> Vec<String> {
    let head = format!(
        "PEER\nQUAKE, STATION, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {}, DT= .01 SEC",
        widths.iter().sum::<usize>()
    );
    let mut rows: Vec<String> = head.lines().map(str::to_owned).collect();
    rows.extend(rows_of(widths, &|a| format!("  {a:.7e}")));
    rows
}

/// Rows of AT2 have one width, unless they are free throughout.
#[test]
fn rows_of_agencies() {
    let plain = ReadOptions::default();
    for (widths, at) in [
        (vec![5, 5, 5, 4, 6, 5, 5, 2], 8),
        (vec![5, 5, 5, 5, 2, 5], 9),
        (vec![5, 5, 6, 5, 2], 7),
    ] {
        refused_at(&at2(&widths), &plain, at, "number of values");
    }
    assert_eq!(count(&at2(&[5, 5, 5, 5, 2]), &plain).unwrap(), 22);
    assert_eq!(count(&at2(&[5, 4, 5, 4, 4, 5, 1]), &plain).unwrap(), 28);
}

/// A digit parted by a blank, and rows that are exchanged, in files of K-NET and of ISESD.
#[test]
fn rows_of_other_agencies() {
    for name in ["k_net", "isesd"] {
        for fixture in fixtures(name, 0) {
            let text = String::from_utf8(fixture.bytes.clone()).unwrap();
            let options = ReadOptions::default();
            let lines: Vec<&str> = text.lines().collect();
            let is_row = |l: &&str| {
                let mut fields = l.split_whitespace();
                fields.clone().count() > 3 && fields.all(|f| f.parse::<f64>().is_ok())
            };
            let Some(first) = lines.iter().position(&is_row) else {
                continue;
            };
            // Rows before the last one, which may be shorter.
            let rows = lines[first..].iter().take_while(|l| is_row(l)).count();
            if rows < 4 {
                continue;
            }
            let mut other: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
            other[first + 1] = other[first + 1].trim_end().to_owned() + " 1";
            let all = |text: &str| read_all_bytes("f", text.as_bytes(), &options);
            assert!(all(&text).is_ok(), "{}", fixture.name);
            let error = all(&(other.join("\n") + "\n")).unwrap_err().to_string();
            assert!(error.contains("number of values"), "{name}: {error}");
        }
    }
}

/// A value that lost its exponent is none, however much of its mantissa is left.
#[test]
fn exponents_lost_with_a_part_of_the_mantissa() {
    let c = |a: f64| format!("{a:.7e}");
    let time = |i: usize| format!("{:.7e} ", 0.02 * i as f64);
    let read = |text: &str, options: &ReadOptions| {
        read_bytes("f", text.as_bytes(), options).map(|r| r.samples().len())
    };
    for columns in [1, 2, 5] {
        let make = |bad: Option<&str>| -> String {
            let mut text = String::new();
            for i in 0..200 {
                let start = if columns == 2 { time(i) } else { String::new() };
                let printed = match bad.filter(|_| i == 77) {
                    Some(bad) => bad.to_owned(),
                    None => c(value(i)),
                };
                let ends = columns < 5 || i % 5 == 4;
                text += &format!("{start}{printed}{}", if ends { "\n" } else { "  " });
            }
            text
        };
        let options = options(None, (columns != 2).then_some(0.02));
        assert_eq!(read(&make(None), &options).unwrap(), 200);
        for zero in ["0", "0.0"] {
            assert_eq!(read(&make(Some(zero)), &options).unwrap(), 200, "{zero}");
        }
        for bad in ["-3.667", "-3.6", "-3", "-3.6679000"] {
            let error = read(&make(Some(bad)), &options).unwrap_err().to_string();
            assert!(error.contains("exponent"), "{columns} {bad}: {error}");
        }
    }
}

/// Writers that print exponents of small values alone, as `%g` and `G` formats of Fortran do.
#[test]
fn mixed_forms_are_read() {
    let g = |a: f64| match a.abs() {
        small if small < 1.0e-4 => format!("{a:e}"),
        _ => format!("{a}"),
    };
    let fortran = |a: f64| match a.abs() {
        small if small < 0.1 => format!("{:.6}E-01", a * 10.0),
        _ => format!("{a:.6}"),
    };
    for size in [1.0e-3, 9.0e-5] {
        let text: String = (0..200).map(|i| g(10.0 * size * value(i)) + "\n").collect();
        read_bytes("f", text.as_bytes(), &options(None, Some(0.01))).unwrap();
        // All but one are so small.
        let text = text + "0.00012\n";
        read_bytes("f", text.as_bytes(), &options(None, Some(0.01))).unwrap();
    }
    let text: String = (0..200).map(|i| fortran(0.9 * value(i)) + "\n").collect();
    let text = text + "0.123456\n";
    read_bytes("f", text.as_bytes(), &options(None, Some(0.01))).unwrap();
}

/// A word for a value that is missing: a row less would make the times uneven.
#[test]
fn words_for_missing_values() {
    for word in ["NA", "N/A", "null"] {
        let row = |i: i32| match i {
            120 => format!("1.20,{word}\n"),
            i => format!("{:.2},{:.4}\n", 0.01 * f64::from(i), f64::from(i % 7) - 3.0),
        };
        let text = format!("time (s),NS (g)\n{}", (0..200).map(row).collect::<String>());
        let error = read_bytes("f", text.as_bytes(), &options(None, None)).unwrap_err();
        let said = error.to_string();
        assert!(
            said.starts_with("f:122:6: ") && said.contains(word),
            "{said}"
        );
        let help = error.help().unwrap();
        assert!(
            help.contains("no sample may be missing") && !help.contains("remove"),
            "{help}"
        );
    }
}
