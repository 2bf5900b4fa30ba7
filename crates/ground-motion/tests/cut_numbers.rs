//! Numbers that lost their end, rows that stand twice, and headers of AT2 in forms that agencies and
//! colleagues write.
use std::fmt::Write as _;

use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{Accelerogram, ReadOptions, Recording, read_all_bytes, read_bytes};

use crate::common::fixtures;

fn lenient() -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    }
}

fn read(text: &str, options: &ReadOptions) -> Result<Accelerogram, String> {
    let found = read_bytes("f", text.as_bytes(), options);
    found.map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

/// 40 values (g) of an AT2 file, as `print` writes them, five to a row.
fn at2(header: &str, print: fn(f64) -> String) -> String {
    let mut text = format!("PEER\nQUAKE, STATION, 90\n{header}\n");
    for i in 0..40 {
        let value = 0.2 * f64::sin(0.7 * f64::from(i) + 0.1);
        text += &print(value);
        text += if i % 5 == 4 { "\n" } else { "" };
    }
    text
}

const HEADER: &str = "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 40, DT= .01 SEC";

/// As C prints `%15.7E`, and as Fortran prints `E15.7`, with a zero before the point.
fn of_c(x: f64) -> String {
    let text = format!("{x:.7e}");
    let (mantissa, exponent) = text.split_once('e').unwrap();
    let power: i32 = exponent.parse().unwrap();
    let sign = if power < 0 { '-' } else { '+' };
    format!("{:>15}", format!("{mantissa}E{sign}{:02}", power.abs()))
}

fn of_fortran(x: f64) -> String {
    let power = x.abs().log10().floor() as i32 + 1;
    let sign = if power < 0 { '-' } else { '+' };
    let mantissa = x / 10.0_f64.powi(power);
    format!("{:>15}", format!("{mantissa:.7}E{sign}{:02}", power.abs()))
}

fn plain(x: f64) -> String {
    format!("{x:10.5}")
}

/// So it is in the rows of midas, and among many values with as many decimals one with fewer.
#[test]
fn digits_lost_within_a_file() {
    let rows: String = (0..40)
        .map(|i| {
            let value = 0.2 * f64::sin(0.7 * f64::from(i) + 0.1);
            format!("{:.4E}, {}\n", 0.01 * f64::from(i), of_c(value).trim())
        })
        .collect();
    let text = format!("*SGSw\n*TITLE, quake\n*UNIT&TYPE, GRAV, ACCEL\n*DATA\n{rows}*ENDDATA\n");
    assert_eq!(
        read(&text, &ReadOptions::default())
            .unwrap()
            .samples()
            .len(),
        40
    );
    let line = text.lines().nth(12).unwrap();
    let cut = &line[..line.len() - 4];
    let said = read(&text.replace(line, cut), &ReadOptions::default()).unwrap_err();
    assert!(
        said.starts_with("f:13:") && said.contains("no exponent"),
        "{said}"
    );

    let mut long = at2(HEADER, of_fortran).replace("NPTS= 40", "NPTS= 240");
    let rows: String = long.lines().skip(4).map(|l| format!("{l}\n")).collect();
    for _ in 0..5 {
        long += &rows;
    }
    assert_eq!(
        read(&long, &ReadOptions::default())
            .unwrap()
            .samples()
            .len(),
        240
    );
    let place = long.rfind("0.1").unwrap();
    let damaged = format!("{}{}", &long[..place + 3], &long[place + 4..]);
    let said = read(&damaged, &ReadOptions::default()).unwrap_err();
    assert!(
        said.contains("lacks a digit: the other values have 7 decimals"),
        "{said}"
    );
    // Another writer leaves out zeros at the end.
    let of_fewer = long.replace("00E", "E").replace("0E", "E");
    assert!(of_fewer.len() < long.len());
    assert_eq!(
        read(&of_fewer, &ReadOptions::default())
            .unwrap()
            .samples()
            .len(),
        240
    );
}

/// A value within the file that alone lacks its exponent, or a digit of it, is no value.
#[test]
fn exponents_lost_within_a_file() {
    for print in [of_c, of_fortran] {
        let text = at2(HEADER, print);
        let whole = read(&text, &ReadOptions::default()).unwrap();
        assert_eq!(whole.samples().len(), 40);
        let line = text.lines().nth(7).unwrap();
        for lost in ["-02", "E-02", "2"] {
            let cut = line.strip_suffix(lost);
            let Some(cut) = cut.or_else(|| line.strip_suffix(&lost.replace('2', "1"))) else {
                continue;
            };
            let damaged = text.replace(line, cut);
            for options in [ReadOptions::default(), lenient()] {
                let said = read(&damaged, &options).unwrap_err();
                let whole = said.starts_with("f:8:") || said.contains("is not a number");
                assert!(whole, "{lost}: {said}");
            }
        }
    }
    // Formats that print no exponent of values about 1, as `%G` of Fortran.
    let general = |x: f64| {
        if x.abs() >= 0.1 {
            format!("{x:15.7}")
        } else {
            of_fortran(x)
        }
    };
    assert!(read(&at2(HEADER, general), &ReadOptions::default()).is_ok());
    // As short as they can be.
    assert!(read(&at2(HEADER, |x| format!(" {x:e}")), &ReadOptions::default()).is_ok());
}

/// A value of DYNA, ISESD and BHRC without its exponent, in columns or not, and one that the end of a
/// file cuts off.
/// Of 400 values with six decimals one with fewer was cut off; a program that leaves out zeros has many of those.
#[test]
fn decimals_lost_in_the_middle_of_dyna() {
    let value = |i: u32| format!("{:.6}", 30.0 * f64::sin(0.07 * f64::from(i) + 0.1));
    let file = |value: &dyn Fn(u32) -> String| {
        let values: Vec<String> = (0..400).map(value).collect();
        format!(
            "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 400\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n{}\n",
            values.join("\n")
        )
    };
    let read = |text: String| read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
    read(file(&value)).unwrap();
    for (length, told) in [
        (2, "has no decimal point"),
        (3, "lacks a digit"),
        (5, "lacks a digit"),
    ] {
        let cut = |i: u32| {
            let whole = value(i);
            let end = if i == 300 { length } else { whole.len() };
            whole[..end].to_owned()
        };
        let said = read(file(&cut)).unwrap_err().to_string();
        assert!(
            said.starts_with("f:307:1: ") && said.contains(told),
            "{said}"
        );
    }
    let without_zeros = |i: u32| value(i).trim_end_matches('0').to_owned();
    read(file(&without_zeros)).unwrap();
}

#[test]
fn exponents_lost_in_files_of_agencies() {
    let all = |text: &str, options: &ReadOptions| {
        read_all_bytes("f", text.as_bytes(), options).map_err(|e| e.to_string())
    };
    let strict = ReadOptions::default();
    let values = || (0..40).map(|i| 0.2 * f64::sin(0.7 * f64::from(i) + 0.1));
    let mut dyna = String::from(
        "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 40\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n",
    );
    let mut isesd = String::from(
        "file: 1.cor\nwaveform code: 1\norientation of transducer: NS\nsampling period: 0.01s\nnumber of samples: 40\nunits: m/s*s\n-> corrected acceleration time histories\n",
    );
    for (i, value) in values().enumerate() {
        writeln!(dyna, "{}", of_c(value).trim()).unwrap();
        isesd += &format!("{:>16}{}", of_c(value), if i % 5 == 4 { "\n" } else { "" });
    }
    for text in [&dyna, &isesd] {
        assert_eq!(all(text, &strict).unwrap().series[0].samples.len(), 40);
        let place = text.rfind("E-01").unwrap();
        for blank in ["    ", ""] {
            let damaged = format!("{}{blank}{}", &text[..place], &text[place + 4..]);
            let said = all(&damaged, &strict).unwrap_err();
            assert!(said.contains("has no exponent"), "{said}");
        }
        let whole = text.trim_end();
        assert!(all(whole, &strict).is_ok());
        for cut in [1, 4, 7] {
            let cut = &whole[..whole.len() - cut];
            let said = all(cut, &strict).unwrap_err();
            assert!(said.contains("ends within its last value"), "{said}");
            let left = all(cut, &lenient()).unwrap();
            assert_eq!(left.series[0].samples.len(), 39);
        }
    }
    // `G` formats print none from a tenth on: the format of this agency has one always.
    let fixture = fixtures("bhrc", 0).remove(0);
    let bhrc: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    assert!(all(&bhrc, &fixture.options).is_ok());
    let place = bhrc.rfind("E-01").unwrap();
    let damaged = format!("{}    {}", &bhrc[..place], &bhrc[place + 4..]);
    let said = all(&damaged, &fixture.options).unwrap_err();
    assert!(said.contains("has no exponent"), "{said}");
}

/// A file that ends within its last value is refused; taken as it is, that value is left out.
#[test]
fn files_that_end_within_a_number() {
    for (print, cuts) in [
        (of_c as fn(f64) -> String, [1, 4, 7]),
        (plain as fn(f64) -> String, [1, 2, 5]),
    ] {
        let text = at2(HEADER, print);
        let text = text.trim_end();
        assert!(read(text, &ReadOptions::default()).is_ok());
        for cut in cuts {
            let cut = &text[..text.len() - cut];
            let said = read(cut, &ReadOptions::default()).unwrap_err();
            assert!(
                said.starts_with("f:12:") && said.contains("get it again"),
                "{said}"
            );
            let record = read(cut, &lenient()).unwrap();
            assert_eq!(record.samples().len(), 39);
            let warnings = &record.origin().unwrap().warnings;
            assert!(
                warnings.iter().any(|w| w.contains("not used")),
                "{warnings:?}"
            );
        }
    }
}

/// So is a file with a column for each component, whose last row is left out.
#[test]
fn components_that_end_within_a_number() {
    let value = |i: u32| 20.0 * f64::sin(0.7 * f64::from(i) + 0.1);
    let rows: String = (0..70)
        .map(|i| format!("{0:.6} {0:.6} {0:.6}\n", value(i)))
        .collect();
    let header = "STRONG GROUND MOTION RECORDS OF TURKIYE\nSTATION ID : 0000\nSAMPLING INTERVAL (sec) : 0.01\nRAW PGA VALUES (gal) :\nN-S E-W U-D\n";
    let read = |last: &str, options: &ReadOptions| {
        let text = format!("{header}{rows}1.000000 1.000000 {last}");
        read_all_bytes("f", text.as_bytes(), options).map_err(|e| e.to_string())
    };
    for last in ["0.00010", "0.0001", "0.00", "0."] {
        let said = read(last, &ReadOptions::default()).unwrap_err();
        let told = "the file ends within its last value: \"0.";
        assert!(said.starts_with("f:76:") && said.contains(told), "{said}");
        let found = read(last, &lenient()).unwrap();
        for series in &found.series {
            assert_eq!(series.samples.len(), 70);
        }
    }
    let found = read("0.000108", &ReadOptions::default()).unwrap();
    assert_eq!(found.series[2].samples.len(), 71);
}

/// So are plain columns, whose last row is left out.
#[test]
fn columns_that_end_within_a_number() {
    let row = |i: u32, separator: &str| {
        let value = 0.2 * f64::sin(0.7 * f64::from(i) + 0.1);
        format!("{:.2}{separator}{value:.5}\n", 0.01 * f64::from(i))
    };
    for separator in [",", " ", ";", "\t"] {
        let rows: String = (0..44).map(|i| row(i, separator)).collect();
        let header = format!("time (s){separator}acc (g)");
        for last in ["-0.", "-0", "0.1", "-0.1234"] {
            let text = format!("{header}\n{rows}0.44{separator}{last}");
            let said = read(&text, &ReadOptions::default()).unwrap_err();
            let told = format!("the file ends within its last value: \"{last}");
            let told = told.trim_end_matches('.');
            assert!(said.contains(told) && said.starts_with("f:46:"), "{said}");
            let record = read(&text, &lenient()).unwrap();
            assert_eq!(record.samples().len(), 44);
            let warnings = &record.origin().unwrap().warnings;
            assert!(warnings.iter().any(|w| w.contains("not used")));
            // An end of the line or of the cell, and a remark, stand behind whole numbers.
            for end in ["\n", " ", "\n# 5"] {
                if last.ends_with(|c: char| c.is_ascii_digit()) {
                    let record = read(&format!("{text}{end}"), &ReadOptions::default());
                    assert_eq!(record.unwrap().samples().len(), 45, "{end:?}");
                }
            }
        }
        let whole = format!("{header}\n{rows}0.44{separator}-0.12345");
        assert_eq!(read(&whole, &lenient()).unwrap().samples().len(), 45);
    }
    // Values along the rows, and writers that leave out zeros.
    let along: String = (0..40)
        .map(|i| plain(0.2 * f64::sin(0.7 * f64::from(i))))
        .collect();
    let along = format!("# dt: 0.01 s\n# unit: g\n{along}\n{along}   0.1");
    let options = ReadOptions {
        layout: Some("a".to_owned()),
        ..ReadOptions::default()
    };
    assert!(read(&along, &options).unwrap_err().contains("last value"));
    let shortest: String = (0..44)
        .map(|i| format!("{:.2},{}\n", 0.01 * f64::from(i), 0.125 * f64::from(i % 7)))
        .collect();
    let shortest = format!("time (s),acc (g)\n{shortest}0.44,-0.1");
    assert_eq!(
        read(&shortest, &ReadOptions::default())
            .unwrap()
            .samples()
            .len(),
        45
    );
}

/// K-NET: integers of eight columns, of which the last one lost digits.
#[test]
fn counts_of_k_net_that_are_cut_off() {
    let fixture = fixtures("k_net", 0).remove(0);
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    let text = text.trim_end();
    let all = |text: &str, options: &ReadOptions| -> Result<Recording, String> {
        let found = read_all_bytes("f", text.as_bytes(), options);
        found.map_err(|e| e.to_string())
    };
    let whole = all(text, &fixture.options).unwrap().series[0].samples.len();
    let cut = &text[..text.len() - 1];
    let said = all(cut, &fixture.options).unwrap_err();
    assert!(said.contains("ends within its last value"), "{said}");
    let lenient = ReadOptions {
        lenient: true,
        ..fixture.options
    };
    let left = all(cut, &lenient).unwrap();
    assert_eq!(left.series[0].samples.len(), whole - 1);
}

/// JMA: three columns, of which the last one lost its end, or a value its exponent.
#[test]
fn values_of_jma_that_are_cut_off() {
    let fixture = fixtures("jma_csv", 0).remove(0);
    let text = fixture.bytes.trim_ascii_end();
    let all = |text: &[u8], options: &ReadOptions| -> Result<Recording, String> {
        let found = read_all_bytes("f", text, options);
        found.map_err(|e| e.to_string())
    };
    let whole = all(text, &ReadOptions::default()).unwrap().series[0]
        .samples
        .len();
    for cut in [1, 2, 3] {
        let cut = &text[..text.len() - cut];
        let said = all(cut, &ReadOptions::default()).unwrap_err();
        assert!(said.contains("ends within its last value"), "{said}");
        let left = all(cut, &lenient()).unwrap();
        for series in &left.series {
            assert_eq!(series.samples.len(), whole - 1);
        }
        let said = |w: &String| w.contains("not used");
        let warnings = &left.series[0].origin.warnings;
        assert!(warnings.iter().any(said), "{warnings:?}");
    }
    let rows = |lost: usize| {
        let mut text =
            String::from("SITE CODE= 1\nSAMPLING RATE= 100Hz\nUNIT = gal(cm/s/s)\nNS,EW,UD\n");
        for i in 0..40_usize {
            let value = |k: usize| of_c(0.2 * f64::sin(0.7 * (i + k) as f64 + 0.1));
            let mut row = [value(0), value(1), value(2)];
            if i == lost {
                let end = row[1].len() - 4;
                row[1].truncate(end);
            }
            text += &(row.join(",") + "\n");
        }
        text
    };
    all(rows(99).as_bytes(), &ReadOptions::default()).unwrap();
    let said = all(rows(20).as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(
        said.starts_with("f:25:") && said.contains("has no exponent"),
        "{said}"
    );
}

/// A row of numbers that stands twice shifts all that follow: it is no filling of the last row.
#[test]
fn rows_that_stand_twice_are_refused() {
    let mut tried = 0;
    for format in [
        "csmip_v2",
        "csmip_v1",
        "k_net",
        "usgs_smc",
        "bhrc",
        "caltech_volume_2",
    ] {
        for fixture in fixtures(format, 0) {
            let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
            let lines: Vec<&str> = text.lines().collect();
            // The last full row of numbers: its length is the most common one at the end.
            let is_row = |line: &str| {
                line.len() > 40 && line.bytes().all(|b| b" .-+0123456789eE".contains(&b))
            };
            let Some(last) = lines.iter().rposition(|l| is_row(l)) else {
                continue;
            };
            let Some(row) = (0..last).rev().find(|i| {
                is_row(lines[*i]) && i + 1 < last && lines[*i].len() == lines[i + 1].len()
            }) else {
                continue;
            };
            let mut doubled = lines.clone();
            doubled.insert(row, lines[row]);
            let doubled: String = doubled.join("\n") + "\n";
            let bytes: Vec<u8> = doubled.chars().map(|c| c as u8).collect();
            let found = read_all_bytes("f", &bytes, &fixture.options);
            if let Ok(found) = &found {
                // Pairs of time and value, of which the agency adds rows.
                let pairs = format == "usgs_smc";
                assert!(pairs, "{format}: {:?}", found.series[0].origin.warnings);
            }
            tried += usize::from(found.is_err());
        }
    }
    assert!(tried >= 5, "{tried}");
}

/// Of ISESD and DYNA, too: the right samples at the end would be left out.
#[test]
fn rows_that_stand_twice_in_isesd_and_dyna() {
    let values: Vec<String> = (0..40)
        .map(|i| of_c(0.2 * f64::sin(0.7 * f64::from(i) + 0.1)))
        .collect();
    let dyna = "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 40\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n";
    let isesd = "file: 1.cor\nwaveform code: 1\norientation of transducer: NS\nsampling period: 0.01s\nnumber of samples: 40\nunits: m/s*s\n-> corrected acceleration time histories\n";
    let uneven = "file: 1.raw\nwaveform code: 1\norientation of transducer: NS\nnumber of samples: 40\nunits: m/s*s\n-> uncorrected acceleration time histories\n";
    let pairs: Vec<String> = (0..40)
        .map(|i| format!("{}{:>15}", values[i], format!("{:.4}", 0.01 * i as f64)))
        .collect();
    for (header, values, per_row) in [
        (dyna, &values, 1),
        (dyna, &values, 5),
        (isesd, &values, 5),
        (isesd, &values, 8),
        (uneven, &pairs, 4),
    ] {
        let mut rows: Vec<String> = values.chunks(per_row).map(|row| row.concat()).collect();
        let all = |rows: &[String], options: &ReadOptions| {
            let text = header.to_owned() + &rows.join("\n") + "\n";
            read_all_bytes("f", text.as_bytes(), options).map_err(|e| e.to_string())
        };
        let strict = ReadOptions::default();
        assert_eq!(all(&rows, &strict).unwrap().series[0].samples.len(), 40);
        // A last row that is filled.
        if per_row > 2 && header != uneven {
            let filled = values[..40 - 2].chunks(per_row).map(|row| row.concat());
            let mut filled: Vec<String> = filled.collect();
            let header = header.replace("40", "38");
            let last = filled.len() - 1;
            filled[last] = values[last * per_row..40].concat();
            let text = header + &filled.join("\n") + "\n";
            let found = read_all_bytes("f", text.as_bytes(), &strict).unwrap();
            assert_eq!(found.series[0].samples.len(), 38);
        }
        rows.insert(3, rows[3].clone());
        if per_row == 1 {
            rows.insert(3, rows[3].clone());
        }
        let said = all(&rows, &strict).unwrap_err();
        let is_said = said.contains("stand in the file") || said.contains("is not after");
        assert!(is_said, "{said}");
    }
}

#[test]
fn headers_of_at2_in_other_forms() {
    let of = |header: &str| read(&at2(header, plain), &ReadOptions::default());
    for header in [
        HEADER,
        "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS=40\nDT=.0100 SEC",
        "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS: 40, DT: .0100",
        "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS,DT= 40, 0.0100",
        "ACCELERATION TIME SERIES IN UNITS OF G\nNPTS, DT: 40 0.0100",
        "ACCELERATION TIME SERIES (G)\nNPTS= 40, DT= .01 SEC",
        "ACCELERATION TIME HISTORY IN G\nNPTS= 40, DT= .01 SEC",
        "ACCELERATION TIME SERIES IN UNITS OF G ROTATED TO FAULT NORMAL\nNPTS= 40, DT= .01 SEC",
    ] {
        let record = of(header).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(record.samples().len(), 40, "{header}");
        assert!((record.time_step() - 0.01).abs() < 1e-15, "{header}");
        let peak = record.samples().iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        assert!((peak / 9.806_65 - 0.2).abs() < 1e-3, "{header}: {peak}");
    }
    // A decimal comma within one number is no separator.
    let said = read(
        &at2(HEADER, plain).replacen("0.01997", "0,01997", 1),
        &ReadOptions::default(),
    )
    .unwrap_err();
    assert!(said.starts_with("f:5:") && said.contains("comma"), "{said}");
    // Rows of time and value below the header of this format are plain columns.
    let mut pairs = format!("PEER\nQUAKE, STATION, 90\n{HEADER}\n");
    for i in 0..40 {
        let value = 0.2 * f64::sin(0.7 * f64::from(i));
        writeln!(pairs, "{:8.3} {value:10.5}", 0.01 * f64::from(i)).unwrap();
    }
    for options in [ReadOptions::default(), lenient()] {
        let record = read(&pairs, &options).unwrap();
        assert_eq!(record.samples().len(), 40);
        assert!((record.time_step() - 0.01).abs() < 1.0e-15);
        let peak = record.samples().iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        assert!((peak / 9.806_65 - 0.2).abs() < 2.0e-3, "{peak}");
    }
}

/// Times of `--trim` count from the first sample of each file. Components that do not start together
/// stay so in what is written of them.
#[test]
fn components_that_were_cut_at_other_times_are_known() {
    let table = |from: f64| {
        let mut text = String::from("time (s),acc (m/s2)\n");
        for i in 0..400 {
            let time = from + 0.01 * f64::from(i);
            writeln!(text, "{time:.2},{:.4}", f64::sin(3.0 * time)).unwrap();
        }
        text
    };
    let [first, second] =
        [0.0, 1.0].map(|from| read(&table(from), &ReadOptions::default()).unwrap());
    let said = rotate(&first, &second, 30.0).unwrap_err().to_string();
    assert!(said.contains("1 s apart"), "{said}");
    let cut = |record: &Accelerogram, start: f64, end: f64| {
        let trim = pounding_ground_motion::processing::Trim::Times { start, end };
        let steps = [pounding_ground_motion::processing::ProcessingStep::Trim(
            trim,
        )];
        let cut = pounding_ground_motion::processing::process(record, &steps).unwrap();
        let text = write_pounding_csv(&Written::of(&cut.accelerogram)).unwrap();
        read(&text, &ReadOptions::default()).unwrap()
    };
    // As if the times were those of the files: one second of the common time is cut off twice.
    let wrong = (cut(&first, 1.0, 3.0), cut(&second, 1.0, 3.0));
    assert!(rotate(&wrong.0, &wrong.1, 30.0).is_err());
    let right = (cut(&first, 1.0, 3.0), cut(&second, 0.0, 2.0));
    let turned = rotate(&right.0, &right.1, 45.0).unwrap().first;
    let root = f64::sqrt(2.0);
    for (a, b) in turned.samples().iter().zip(right.0.samples()) {
        assert!((a - root * b).abs() < 2e-4 || (a.abs() < 2e-4), "{a} {b}");
    }
}
