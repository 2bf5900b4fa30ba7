//! The step of a column of times, whatever its printer: decimals, significant digits, exponents,
//! single and double precision.
use crate::common::fixtures;
use pounding_ground_motion::{
    GroundMotionError, ReadOptions, Sampling, read_all_bytes, read_bytes,
};
use proptest::prelude::*;

fn read(times: &[String]) -> Result<f64, GroundMotionError> {
    let rows = times.iter().map(|time| format!("{time},0.5\n"));
    let text = format!("time_s,acceleration_m_s2\n{}", rows.collect::<String>());
    read_bytes("r.csv", text.as_bytes(), &ReadOptions::default()).map(|r| r.time_step())
}

/// How programs print times.
#[derive(Debug, Clone, Copy)]
enum Printer {
    /// A fixed number of decimals.
    Decimals(i32),
    /// Rounded to decimals and printed as short as possible, with `.0`: Python's `round`.
    Round(i32),
    /// `%.6g`: significant digits, zeros at the end dropped.
    Significant(i32),
    /// `%.6e`.
    Exponent(i32),
    /// As short as reads back the same, `0.0` first: Python, pandas.
    Double,
    /// The same of a time that has grown by additions.
    Sum,
    /// As short as reads back the same in single precision.
    Single,
    /// All digits of times in single precision.
    SingleAsDouble,
}

fn significant(time: f64, digits: i32) -> String {
    let text = format!("{time:.*e}", digits as usize - 1);
    let exponent: i32 = text.split_once('e').unwrap().1.parse().unwrap();
    let text = format!("{time:.*}", (digits - 1 - exponent).max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

impl Printer {
    fn print(self, start: f64, step: f64, count: usize) -> Vec<String> {
        let mut sum = start;
        (0..count)
            .map(|i| {
                let time = start + i as f64 * step;
                match self {
                    Self::Decimals(n) => format!("{time:.*}", n as usize),
                    Self::Round(n) => {
                        let rounded: f64 = format!("{time:.*}", n as usize).parse().unwrap();
                        format!("{rounded:?}")
                    }
                    Self::Significant(n) => significant(time, n),
                    Self::Exponent(n) => format!("{time:.*e}", n as usize),
                    Self::Double => format!("{time:?}"),
                    Self::Sum => {
                        let text = format!("{sum:?}");
                        sum += step;
                        text
                    }
                    Self::Single => format!("{:?}", time as f32),
                    Self::SingleAsDouble => format!("{:?}", f64::from(time as f32)),
                }
            })
            .collect()
    }

    /// One unit of the last digit at a time, with round-off.
    fn unit(self, time: f64) -> f64 {
        let digits = |n: i32| 10.0_f64.powi(time.log10().floor() as i32 - n);
        match self {
            Self::Decimals(n) | Self::Round(n) => 10.0_f64.powi(-n) + 2e-7 * time,
            Self::Significant(n) => digits(n - 1) + 2e-7 * time,
            Self::Exponent(n) => digits(n) + 2e-7 * time,
            Self::Double | Self::Sum => 1e-10 * time,
            Self::Single | Self::SingleAsDouble => 2e-7 * time,
        }
    }
}

const RATES: [f64; 14] = [
    50.0, 62.5, 100.0, 120.0, 128.0, 200.0, 250.0, 256.0, 300.0, 400.0, 409.6, 500.0, 512.0, 1000.0,
];

fn printer() -> impl Strategy<Value = Printer> {
    prop_oneof![
        (3..9).prop_map(Printer::Decimals),
        (3..9).prop_map(Printer::Round),
        (5..12).prop_map(Printer::Significant),
        (4..12).prop_map(Printer::Exponent),
        Just(Printer::Double),
        Just(Printer::Sum),
        Just(Printer::Single),
        Just(Printer::SingleAsDouble),
    ]
}

/// Rates, printers, numbers of samples (few and many alike) and first samples.
fn columns() -> impl Strategy<Value = (f64, Printer, usize, f64)> {
    (
        prop::sample::select(&RATES[..]),
        printer(),
        0.7..4.3_f64,
        prop_oneof![Just(0.0), Just(1.0), 0.0..3000.0_f64],
    )
        .prop_map(|(rate, printer, count, first)| {
            let count = 10.0_f64.powf(count) as usize;
            (1.0 / rate, printer, count.max(2), first.floor() / rate)
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, max_global_rejects: 10_000, failure_persistence: None, ..ProptestConfig::default() })]

    /// No even column is refused where its digits are finer than half a step, and its step is
    /// within what the digits leave open of the time between first and last sample.
    #[test]
    fn even_columns((step, printer, count, start) in columns()) {
        let end = start + (count - 1) as f64 * step;
        let unit = printer.unit(end);
        prop_assume!(unit < 0.4 * step);
        let times = printer.print(start, step, count);
        let found = read(&times);
        prop_assert!(found.is_ok(), "{}: {}", times[times.len() - 1], found.unwrap_err());
        let error = (found.unwrap() - step).abs();
        prop_assert!(
            error <= 2.1 * unit / (count - 1) as f64,
            "{} {error:e}", times[times.len() - 1]
        );
        // Among hundreds of steps no other round number is as near.
        if count > 600 && unit < 0.01 * step && step != 1.0 / 409.6 {
            prop_assert!(error < 1e-9 * step, "{} {error:e}", times[times.len() - 1]);
        }
    }

    /// Times off by more than their digits are not even.
    #[test]
    fn jitter((step, printer, count, start) in columns(), seed in 0..1000_usize) {
        let end = start + (count - 1) as f64 * step;
        let off = 3.0 * printer.unit(end);
        prop_assume!(count > 20 && off < 0.35 * step && !matches!(printer, Printer::Sum));
        let jittered: Vec<_> = (0..count)
            .flat_map(|i| {
                // To and fro at random, and never back in time.
                let sign = if (i * i + seed * i + seed / 7) % 3 == 0 { 1.0 } else { -1.0 };
                let much = 1.0 + 0.013 * ((7 * i + seed) % 23) as f64;
                let time = start + i as f64 * step + sign * much * off;
                printer.print(if i == 0 { start } else { time }, step, 1)
            })
            .collect();
        let found = read(&jittered);
        prop_assert!(
            matches!(found, Err(GroundMotionError::Uneven { .. })),
            "{:?} {found:?}", &jittered[..9]
        );
    }
}

/// The last of these times has lost a zero at its end, and seems to be coarser than all others: they jitter by three
/// of their digits all the same.
#[test]
fn one_short_time_excuses_none_before_it() {
    let signs = [1.0, -1.0, -1.0];
    let time = |i: usize| match i {
        0 => 1.0 / 300.0,
        30 => 0.10333,
        _ => (i + 1) as f64 / 300.0 + signs[(i + 2) % 3] * 3.4e-6,
    };
    let times: Vec<String> = (0..31)
        .map(|i| format!("{:?}", (time(i) * 1e6).round() / 1e6))
        .collect();
    assert!(times[..30].iter().any(|t| t.len() == 8) && times[30] == "0.10333");
    let found = read(&times);
    assert!(
        matches!(found, Err(GroundMotionError::Uneven { .. })),
        "{found:?}"
    );
}

/// Digits of a quarter of a step and more, of which ties are rounded to even digits: 1/256 s from 10.8125 s on. A row that
/// is missing is none of them, wherever it is.
#[test]
fn digits_of_nearly_half_a_step() {
    for (rate, count) in [(256.0, 5769), (400.0, 3000), (440.0, 3000)] {
        let time = |i: usize| format!("{:.3}", 10.8125 + i as f64 / rate);
        let times: Vec<String> = (0..count).map(time).collect();
        let found = read(&times).unwrap();
        assert!((found * rate - 1.0).abs() < 1e-12, "{found}");
        let places = [1, 2, 5, 8, count / 2, count - 3, count - 2];
        for missing in places {
            let mut fewer = times.clone();
            fewer.remove(missing);
            let found = read(&fewer);
            assert!(
                matches!(found, Err(GroundMotionError::Uneven { .. })),
                "{rate} {count} {missing}: {found:?}"
            );
        }
    }
}

/// Times of a day in seconds, of which round-off in single precision would be a step: the step is none that they
/// exclude, and four digits to and fro are not even.
#[test]
fn times_of_a_day() {
    for (start, rate, count) in [
        (67_122.95, 300.0, 30),
        (62_219.19, 256.0, 200),
        (74_280.34, 128.0, 200),
        (55_249.31, 400.0, 60),
    ] {
        let time = |i: usize| format!("{:.4}", start + i as f64 / rate);
        let times: Vec<String> = (0..count).map(time).collect();
        let found = read(&times).unwrap();
        assert!((found * rate - 1.0).abs() < 1e-9, "{start} {rate}: {found}");
    }
    let time = |i: usize| 50_000.0 + 0.01 * i as f64 + [0.0, 0.004, -0.004][(i * i) % 3];
    let times: Vec<String> = (0..200).map(|i| format!("{:.3}", time(i))).collect();
    assert!(matches!(
        read(&times),
        Err(GroundMotionError::Uneven { .. })
    ));
}

/// As Python and pandas write multiples of 1/128 s and 1/300 s: `0.0` says nothing of the digits.
#[test]
fn a_short_zero_is_no_coarse_digit() {
    for (step, count) in [
        (1.0 / 128.0, 2),
        (1.0 / 128.0, 3),
        (1.0 / 128.0, 600),
        (1.0 / 128.0, 3000),
        (1.0 / 300.0, 3),
        (1.0 / 300.0, 80),
        (1.0 / 300.0, 503),
    ] {
        let times = Printer::Double.print(0.0, step, count);
        assert_eq!(times[0], "0.0");
        assert!((read(&times).unwrap() / step - 1.0).abs() < 1e-12);
    }
}

/// Few digits, many samples: the step has more digits than any of the times.
#[test]
fn steps_are_finer_than_their_digits() {
    for (printer, step, count) in [
        (Printer::Decimals(4), 1.0 / 128.0, 600),
        (Printer::Round(4), 1.0 / 128.0, 600),
        (Printer::Decimals(3), 1.0 / 128.0, 2000),
        (Printer::Significant(6), 1.0 / 128.0, 20_000),
        (Printer::Significant(6), 1.0 / 300.0, 20_000),
        (Printer::Decimals(3), 1.0 / 300.0, 10_000),
        (Printer::Decimals(4), 0.002_44, 10_000),
        (Printer::Exponent(5), 1.0 / 256.0, 10_000),
    ] {
        let found = read(&printer.print(0.0, step, count)).unwrap();
        assert!((found / step - 1.0).abs() < 1e-12, "{printer:?} {found}");
    }
    // So few samples say no more than is printed.
    let short = |times: [&str; 3]| read(&times.map(str::to_owned)).unwrap();
    assert_eq!(short(["0.0000", "0.0078", "0.0156"]), 0.0078);
    assert_eq!(short(["1e-2", "2e-2", "3e-2"]), 0.01);
}

/// A time column with errors of a quarter of a step, printed in full but for `0.0`.
#[test]
fn a_short_zero_hides_no_jitter() {
    let times: Vec<_> = (0..1000_u32)
        .map(|i| f64::from(i) * 0.01 + 0.0024 * (f64::from(i * i) * 0.7).sin())
        .map(|time| format!("{time:?}"))
        .collect();
    assert_eq!(times[0], "0.0");
    let error = read(&times).unwrap_err();
    assert!(matches!(error, GroundMotionError::Uneven { .. }), "{error}");
}

/// The message shows by how much the steps differ.
#[test]
fn uneven_steps_are_shown_apart() {
    let mut times = Printer::Double.print(0.0, 1.0 / 300.0, 100);
    times[50] = format!("{:?}", 50.0 / 300.0 + 3e-8);
    let error = read(&times).unwrap_err().to_string();
    assert!(error.contains("0.00333330 s to 0.00333336 s"), "{error}");
}

/// A time that is there twice, or goes back, is said with its own line.
#[test]
fn a_time_that_does_not_increase_has_its_line() {
    let options = ReadOptions::default();
    for time in ["0.02", "0.01"] {
        let text = format!(
            "time_s,acceleration_m_s2\n0.00,1\n0.02,2\n# a comment\n{time},3\n0.04,4\n0.06,5\n"
        );
        let refused = read_bytes("r.csv", text.as_bytes(), &options).unwrap_err();
        let told = refused.to_string();
        let expected = format!("r.csv:5:1: time {time} s of value 3 is not after 0.02 s");
        assert!(told.contains(&expected), "{told}");
    }
}

/// `--time-step` resamples uneven times of our own layout along straight lines, as those of plain
/// columns: a line through the samples stays one. Without it, the message asks for it.
#[test]
fn uneven_times_are_resampled_in_our_layout_too() {
    let times = [0.0, 0.013, 0.02, 0.031, 0.045, 0.05, 0.06];
    let rows = times.iter().map(|t| format!("{t},{}\n", 2.0 * t + 0.1));
    let text = format!("time_s,acceleration_m_s2\n{}", rows.collect::<String>());
    let read = |time_step| {
        let options = ReadOptions {
            time_step,
            ..ReadOptions::default()
        };
        read_bytes("r.csv", text.as_bytes(), &options)
    };
    let error = read(None).unwrap_err();
    assert!(matches!(error, GroundMotionError::Uneven { .. }), "{error}");
    assert!(error.help().unwrap().contains("time_step"));
    let resampled = read(Some(0.01)).unwrap();
    assert_eq!(resampled.samples().len(), 7);
    for (i, a) in resampled.samples().iter().enumerate() {
        assert!((a - (0.02 * i as f64 + 0.1)).abs() < 1e-12, "{i}: {a}");
    }
    // Even times have the step that they have; a step of the file is that of its times.
    let even = "time_s,acceleration_m_s2\n0,0.1\n0.01,0.2\n0.02,0.3\n0.03,0.1\n";
    let other = ReadOptions {
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    let error = read_bytes("r.csv", even.as_bytes(), &other).unwrap_err();
    assert!(
        matches!(error, GroundMotionError::Contradiction { .. }),
        "{error}"
    );
    let error = read_bytes(
        "r.csv",
        format!("# dt: 0.01 s\n{text}").as_bytes(),
        &ReadOptions::default(),
    );
    let error = error.unwrap_err().to_string();
    assert!(error.contains("follows from dt"), "{error}");
}

/// The longest of uneven steps is named with its place; one that is a gap is refused, which no line
/// can bridge. Steps of digitised film, of which one is 27 times the median, are none.
#[test]
fn a_gap_between_uneven_times_is_refused() {
    let read = |step: f64, longest: f64, time_step: Option<f64>| {
        let mut time = 0.0;
        let mut text = "time (s),acceleration (g)\n".to_owned();
        for i in 0..200 {
            text.push_str(&format!("{time:.4},{:.4}\n", f64::from(i).sin()));
            let jitter = if i % 3 == 0 { 0.1 * step } else { 0.0 };
            time += if i == 99 { longest } else { step + jitter };
        }
        let options = ReadOptions {
            time_step,
            ..ReadOptions::default()
        };
        read_bytes("r.csv", text.as_bytes(), &options)
    };
    for (step, longest) in [(0.0014, 0.0375), (0.01, 0.1), (0.02, 0.2), (0.05, 0.5)] {
        let record = read(step, longest, Some(step)).unwrap();
        let warnings = &record.origin().unwrap().warnings;
        let named = format!("the longest step between them is {longest} s, from ");
        assert!(warnings.iter().any(|w| w.contains(&named)), "{warnings:?}");
    }
    for (step, longest) in [(0.01, 10.0), (0.0014, 0.11), (0.02, 0.22)] {
        // Also where no step is given, which would not help.
        for given in [Some(step), None] {
            let error = read(step, longest, given).unwrap_err();
            let told = error.to_string();
            let named = format!("a gap of {longest} s, from ");
            assert!(
                told.contains(&named) && told.contains("continuous"),
                "{told}"
            );
            assert!(error.help().is_some());
        }
    }
}

/// Pairs of a digital recorder are even within half the last digit of their times; those of film,
/// a digit off here and there, are not.
#[test]
fn pairs_of_volume_1_at_even_times() {
    let fixture = fixtures("csmip_v1", 0).remove(0);
    let text = String::from_utf8(fixture.bytes).unwrap();
    let with_times = |time: &dyn Fn(usize) -> f64| {
        let mut at = 0;
        let row = |line: &str| {
            let is_data = line.contains('.') && !line.contains(|c: char| c.is_ascii_alphabetic());
            if !is_data || !line.len().is_multiple_of(14) {
                at = 0;
                return format!("{line}\n");
            }
            let pairs = line.as_bytes().chunks(14).map(|pair| {
                at += 1;
                let value = std::str::from_utf8(&pair[7..]).unwrap();
                format!("{:7.3}{value}", time(at - 1))
            });
            pairs.collect::<String>() + "\n"
        };
        let text: String = text.lines().map(row).collect();
        let options = ReadOptions {
            lenient: true,
            ..fixture.options.clone()
        };
        read_all_bytes("f", text.as_bytes(), &options).unwrap()
    };
    for step in [0.005, 1.0 / 64.0] {
        let even = with_times(&|i| i as f64 * step);
        for series in &even.series {
            let Sampling::Even { time_step } = series.sampling else {
                panic!("{step}: {:?}", series.sampling);
            };
            assert!((time_step - step).abs() < 3e-5, "{time_step}");
        }
    }
    let film = with_times(&|i| i as f64 * 0.005 + 0.001 * f64::from(u8::from(i == 7)));
    assert!(matches!(film.series[0].sampling, Sampling::Uneven { .. }));
}

/// Times and values of rows of these numbers, with two decimals of the times.
fn coarse(step: f64, rows: impl Iterator<Item = usize>) -> Result<Sampling, String> {
    let row = |i: usize| {
        format!(
            "{:.2},{:.5}\n",
            step * i as f64,
            0.2 * f64::sin(0.37 * i as f64)
        )
    };
    let text = "time (s),acc (g)\n".to_owned() + &rows.map(row).collect::<String>();
    let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
    match found {
        Ok(found) => Ok(found.series[0].sampling.clone()),
        Err(error) => Err(error.to_string()),
    }
}

#[test]
fn steps_of_about_one_digit() {
    const ROWS: usize = 1200;
    for step in [
        0.015,
        1.0 / 60.0,
        1.0 / 75.0,
        0.0125,
        0.018,
        0.0165,
        0.011,
        0.008,
        1.0 / 150.0,
    ] {
        match coarse(step, 0..ROWS) {
            Ok(Sampling::Even { time_step }) => assert!((time_step / step - 1.0).abs() < 1e-12),
            other => panic!("{step}: {other:?}"),
        }
        // A row that is missing or doubled, anywhere, is not within any rounding.
        for at in [3, ROWS / 3, ROWS - 4] {
            let missing = coarse(step, (0..ROWS).filter(|i| *i != at));
            assert!(
                !matches!(missing, Ok(Sampling::Even { .. })),
                "{step}: {at}"
            );
            let doubled = coarse(
                step,
                (0..ROWS).flat_map(|i| vec![i; 1 + usize::from(i == at)]),
            );
            assert!(doubled.is_err(), "{step}: {at}");
        }
    }
    // One near an end, of steps below one digit.
    for (step, at) in [(0.006, 1), (0.008, ROWS - 2)] {
        let missing = coarse(step, (0..ROWS).filter(|i| *i != at));
        assert!(
            !matches!(missing, Ok(Sampling::Even { .. })),
            "{step}: {missing:?}"
        );
    }
    // Too short for one round step, a row missing among whole numbers of digits, and every eighth of them missing.
    for sampling in [
        coarse(0.015, 0..200),
        coarse(0.01, (0..ROWS).filter(|i| *i != 400)),
        coarse(0.01, (0..ROWS).filter(|i| i % 8 != 5)),
        coarse(0.02, (0..ROWS).filter(|i| *i != 400)),
    ] {
        assert!(
            matches!(sampling, Ok(Sampling::Uneven { .. })),
            "{sampling:?}"
        );
    }
    // Half a digit: a row that is missing would be within the rounding.
    assert!(coarse(0.005, 0..ROWS).unwrap_err().contains("is not after"));
}
