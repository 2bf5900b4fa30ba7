//! Headers as programs and agencies write them above plain columns: what they state is used, held against the values
//! or told.
use crate::common::fixtures;

use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, ReadOptions, Series, read_all_bytes,
};

fn read_with(text: &str, options: &ReadOptions) -> Result<Vec<Series>, GroundMotionError> {
    read_all_bytes("file.txt", text.as_bytes(), options).map(|recording| recording.series)
}

fn in_g() -> ReadOptions {
    ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    }
}

fn at(step: f64) -> ReadOptions {
    ReadOptions {
        time_step: Some(step),
        ..in_g()
    }
}

fn lenient(options: ReadOptions) -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..options
    }
}

#[track_caller]
fn refused(text: &str, options: &ReadOptions, expected: &str) -> (String, String) {
    let error = read_with(text, options).expect_err(expected);
    let said = error.to_string();
    assert!(said.contains(expected), "{said}");
    (said, error.help().unwrap_or_default())
}

#[track_caller]
fn one(text: &str, options: &ReadOptions) -> Series {
    let mut series = read_with(text, options).unwrap_or_else(|e| panic!("{e}\n{text:.400}"));
    assert_eq!(series.len(), 1);
    series.remove(0)
}

/// So many values, of which the largest is 0.25, in rows of eight.
fn values(count: usize) -> Vec<f64> {
    let value = |i: usize| 0.25 * (0.5 * std::f64::consts::PI * i as f64 / 5.0).sin();
    (0..count).map(value).collect()
}

fn rows_of_eight(values: &[f64]) -> String {
    let row = |row: &[f64]| row.iter().map(|a| format!("{a:10.6}")).collect::<String>() + "\n";
    values.chunks(8).map(row).collect()
}

fn layer(number: usize, count: usize, peak: f64) -> String {
    format!(
        " ACCE. TH AT TOP OF LAYER  {number} OUTCROPPING - PROFILE:   A clay; EQ: one\n N =  {count} DT =  0.020 AMAX=   {peak:.4}    INPUT EQK: one.acc\n"
    )
}

/// Two layers of a site response in one file, as text among the numbers and as comments: no remedy joins them.
#[test]
fn several_records_in_one_file() {
    let rows = rows_of_eight(&values(320));
    let first = layer(1, 320, 0.25) + &rows;
    let series = one(&first, &in_g());
    assert_eq!(series.samples.len(), 320);
    assert!((series.sampling.median_step() - 0.02).abs() < 1e-15);
    assert!(series.origin.warnings.is_empty());

    let both = format!("{first}{}{rows}", layer(7, 320, 0.25));
    let (said, help) = refused(&both, &in_g(), "several records in one file?");
    assert!(
        said.starts_with("file.txt:43:") && said.contains("begins as line 1 does"),
        "{said}"
    );
    assert!(
        help.contains("a file of its own") && !help.contains('#'),
        "{help}"
    );
    let second = layer(7, 320, 0.25);
    let commented: String = second.lines().map(|line| format!("# {line}\n")).collect();
    let joined = format!("{first}{commented}{rows}");
    refused(&joined, &in_g(), "several records in one file?");
    let told = one(&joined, &lenient(in_g()));
    assert_eq!(told.samples.len(), 320);
    let warnings = told.origin.warnings.join("\n");
    assert!(
        warnings.contains("several records") && warnings.contains("640 found"),
        "{warnings}"
    );

    // Other headers: the same quantity once more, another one, a count.
    for header in [
        "SAMPLES/SEC=200 DATA TYPE=VL\n",
        "NPTS: 320\n",
        "dt = 0.01 s\n",
    ] {
        let text = format!("A TITLE\ndt: 0.005\n{rows}{header}{rows}");
        refused(&text, &in_g(), "several records in one file?");
        let text = format!("A TITLE\ndt: 0.005\n{rows}# {header}{rows}");
        refused(&text, &in_g(), "several records in one file?");
    }
    // Remarks among the rows, and a header below them, are none.
    for remark in ["# page 2\n", "# t = 5 s\n", "* A TITLE\n", "# peak here\n"] {
        let text = format!("A TITLE\ndt: 0.005\n{rows}{remark}{rows}");
        assert_eq!(one(&text, &in_g()).samples.len(), 640, "{remark}");
    }
    let text = format!("dt: 0.005\n{rows}# NPTS: 320\n");
    assert_eq!(one(&text, &in_g()).samples.len(), 320);
    let (_, help) = refused(
        &format!("dt: 0.005\n{rows}words here\n{rows}"),
        &in_g(),
        "text among",
    );
    assert!(help.contains("a file of its own"), "{help}");
}

/// N beside DT counts the samples, and AMAX is their largest.
#[test]
fn count_and_peak_beside_a_step() {
    let rows = rows_of_eight(&values(80));
    let of = |count, peak| layer(1, count, peak) + &rows;
    refused(
        &of(60, 0.25),
        &in_g(),
        "the header says 60 samples, but 80 stand",
    );
    assert!(read_with(&of(96, 0.25), &in_g()).is_err());
    refused(
        &of(80, 0.5),
        &in_g(),
        "a peak of 0.5 without a unit, that of the samples is 0.25 g",
    );
    // In m/s2 and in cm/s2.
    for peak in [2.4517, 245.17] {
        assert!(
            one(&of(80, peak), &in_g()).origin.warnings.is_empty(),
            "{peak}"
        );
    }
    let told = one(&of(80, 0.5), &lenient(in_g()));
    assert!(
        told.origin.warnings[0].contains("peak"),
        "{:?}",
        told.origin.warnings
    );
    // N of storeys, and a peak without a unit that may be of something else.
    let text = format!("N = 5 DT = 0.02\nPGA: 0.4\n{rows}");
    let warnings = one(&text, &in_g()).origin.warnings;
    assert!(
        warnings.len() == 1 && warnings[0].starts_with("line 2: the header says a peak of 0.4")
    );
    let text = format!("DT = 0.02\nPGA: 245.2\n{rows}");
    assert!(one(&text, &in_g()).origin.warnings.is_empty());
}

/// `NO. OF POINTS: .. EQUALLY SPACED INTERVALS OF: ..` of China's network.
#[test]
fn equally_spaced_intervals() {
    let of = |count: usize, peak: f64, duration: f64| {
        format!(
            "COMP. EW\nUNCORRECTED ACCELERATION          UNIT: CM/SEC/SEC\nNO. OF POINTS:  {count}  EQUALLY SPACED INTERVALS OF:  0.005  SEC\nPEAK VALUE:     {peak:.3}   AT   0.025 SEC    DURATION:  {duration} SEC\n\n{}",
            rows_of_eight(&values(80))
        )
    };
    let plain = ReadOptions::default();
    let series = one(&of(80, 0.25, 0.4), &plain);
    assert_eq!((series.unit, series.samples.len()), ("cm/s2", 80));
    assert!((series.sampling.median_step() - 0.005).abs() < 1e-15);
    assert!(
        series.origin.warnings.is_empty(),
        "{:?}",
        series.origin.warnings
    );
    refused(&of(120, 0.25, 0.4), &plain, "the header says 120 samples");
    refused(&of(40, 0.25, 0.4), &plain, "the header says 40 samples");
    refused(&of(80, -0.4, 0.4), &plain, "a peak of -0.4 without a unit");
    let told = one(&of(80, 0.25, 0.9), &plain).origin.warnings;
    assert!(told[0].contains("a duration of 0.9 s"), "{told:?}");
    let given = ReadOptions {
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    refused(
        &of(80, 0.25, 0.4),
        &given,
        "time_step is 0.005 s (line 3) in the file but 0.01 s was given",
    );
    let late = of(80, 0.25, 0.4).replace("0.025 SEC", "0.300 SEC");
    let told = one(&late, &plain).origin.warnings;
    assert!(told[0].contains("puts the peak at 0.3 s"), "{told:?}");
}

/// Keys and values in cells of their own, as BASIC writes them; zeros that fill the last row.
#[test]
fn keys_in_quotes() {
    let of = |count: usize, peak: &str, more: usize, filling: f64| {
        let mut all = values(80);
        all.extend(vec![filling; more]);
        format!(
            "\"A Quake\",\"A Site\",\"H1_90\",\"init. vel:\",\" .307 c/s\"\n\"Total No. of Points :\",{count},\"@ DT =\",.02\n\"Peak Acceleration (g) =\",{peak},\"@ Time (sec) :\",.1\n{}",
            rows_of_eight(&all)
        )
    };
    let plain = ReadOptions::default();
    for more in [0, 3, 8] {
        let series = one(&of(80, ".2500001", more, 0.0), &plain);
        assert_eq!((series.unit, series.samples.len()), ("g", 80), "{more}");
        assert!((series.sampling.median_step() - 0.02).abs() < 1e-15);
        let told = series.origin.warnings.join("\n");
        assert!(told.contains("that of the peak"), "{told}");
        assert_eq!(
            more > 0,
            told.contains("zeros that fill the last row"),
            "{told}"
        );
    }
    // More than a row, other values than zeros, another count.
    for text in [
        of(80, ".25", 9, 0.0),
        of(80, ".25", 8, 0.001),
        of(60, ".25", 0, 0.0),
        of(90, ".25", 0, 0.0),
    ] {
        refused(&text, &plain, "samples");
    }
    // A peak that is not that of the values says nothing of their unit.
    refused(&of(80, ".5", 0, 0.0), &plain, "does not state the unit");
    refused(&of(80, ".3", 0, 0.0), &plain, "does not state the unit");
    let text = of(80, ".5", 0, 0.0) + "# end\n";
    let told = one(&text, &in_g()).origin.warnings.join("\n");
    assert!(told.contains("the header's peak is 0.50000 g"), "{told}");
}

/// Count and step in lines of their own, written as all numbers are.
#[test]
fn count_and_step_with_exponents() {
    let column = |values: &[f64]| -> String {
        values
            .iter()
            .map(|a| format!("{}\n", exponent(*a)))
            .collect()
    };
    let all = values(60);
    let text = column(&[60.0, 0.005]) + &column(&all);
    let series = one(&text, &in_g());
    assert_eq!(series.samples.len(), 60);
    assert!((series.sampling.median_step() - 0.005).abs() < 1e-15);
    refused(
        &text,
        &at(0.01),
        "are count and step of the 60 values behind them",
    );
    let series = one(&(column(&[60.0]) + &column(&all)), &at(0.01));
    assert_eq!(series.samples.len(), 60);
    let text = format!("{} {}\n{}", exponent(60.0), exponent(0.005), column(&all));
    assert_eq!(one(&text, &in_g()).samples.len(), 60);

    // A factor, or a count that is wrong, and a step; the remedy reads the samples.
    for first in [980.665, 59.0] {
        let text = column(&[first, 0.01]) + &column(&all);
        let (said, help) = refused(&text, &at(0.01), "a factor or a count, and a time step");
        assert!(said.starts_with("file.txt:1:"), "{said}");
        assert!(help.contains("`skip_lines = 2`"), "{help}");
        let skipped = ReadOptions {
            skip_lines: 2,
            ..at(0.01)
        };
        assert_eq!(one(&text, &skipped).samples.len(), 60);
        let declared = ReadOptions {
            layout: Some("a".to_owned()),
            ..at(0.01)
        };
        assert_eq!(one(&text, &declared).samples.len(), 62);
    }
    let text = column(&[1.0, 0.005]) + &column(&all);
    refused(&text, &at(0.005), "a factor or a count, and a time step");
    let text = format!("1\n{}", column(&[0.005]) + &column(&all));
    let (_, help) = refused(&text, &at(0.02), "a factor or a count, and a time step");
    assert!(help.contains("`skip_lines = 2`"), "{help}");
    // An impulse, and a strong first sample.
    let mut pulse = vec![0.0; 60];
    pulse[0] = 1.0;
    assert_eq!(one(&column(&pulse), &at(0.01)).samples.len(), 60);
    let mut strong = all;
    strong[0] = 2.0;
    strong[1] = 0.013;
    assert_eq!(one(&column(&strong), &at(0.01)).samples.len(), 60);
}

/// A number as C prints it.
fn exponent(value: f64) -> String {
    let text = format!("{value:.7e}");
    let (digits, power) = text.split_once('e').unwrap();
    let power: i32 = power.parse().unwrap();
    let sign = if power < 0 { '-' } else { '+' };
    format!("{digits}e{sign}{:02}", power.abs())
}

/// A sentence behind brackets states step and unit.
#[test]
fn sentences_behind_brackets() {
    let pairs: String = values(60)
        .iter()
        .map(|a| format!("{a:.5}\t{:.5}\n", 0.5 * a))
        .collect();
    let options = ReadOptions {
        layout: Some("ns,ew".to_owned()),
        ..ReadOptions::default()
    };
    for header in [
        "%1999 quake, station T068. First column is the record (N-S)\n% and second that of (E-W). Acc. in cm/sec^2 and dt=0.005 sec.",
        "% Ch 9 FN component and Ch 9 FP component. Acc. in cm/sec^2 and dt=0.005 sec.",
    ] {
        let text = format!("{header}\n{pairs}");
        let series = read_with(&text, &options).unwrap();
        assert_eq!((series.len(), series[0].unit), (2, "cm/s2"), "{header}");
        assert!((series[0].sampling.median_step() - 0.005).abs() < 1e-15);
        let given = ReadOptions {
            layout: options.layout.clone(),
            ..in_g()
        };
        refused(&text, &given, "unit is cm/s2");
    }
}

/// A length without a unit is a count, or a time.
#[test]
fn lengths_without_units() {
    let column: String = values(40).iter().map(|a| format!("{a:.5}\n")).collect();
    let of = |length: usize| {
        one(
            &format!("#DELTA: 0.0133\n#LENGTH: {length}\n{column}"),
            &at(0.0133),
        )
    };
    let told = of(3890).origin.warnings;
    assert_eq!(
        told,
        ["line 2: the length is 3890 here, but 40 samples are read"]
    );
    assert!(of(40).origin.warnings.is_empty());
    let text = format!("dt: 0.5\n# Length: 20\n{column}");
    let told = one(&text, &in_g()).origin.warnings.join(" ");
    assert!(!told.contains("length"), "{told}");
}

/// Whole numbers as MATLAB prints them among numbers with exponents: values where they lie between their neighbours.
#[test]
fn whole_numbers_without_exponents() {
    let write = |value: f64| match value.fract() == 0.0 {
        true => format!("{value}\n"),
        false => exponent(value) + "\n",
    };
    let all: Vec<f64> = (0..120)
        .map(|i| match i {
            60 => -2.0,
            i => 2.2 * (0.02 * f64::from(i - 60) - 1.141).sin(),
        })
        .collect();
    let text: String = all.iter().map(|a| write(*a)).collect();
    let series = one(&text, &at(0.01));
    assert_eq!(series.samples[60] / 9.806_65, -2.0);
    // The same digit far from its neighbours lost what stood behind it.
    let (place, whole) = (20, exponent(all[20]));
    let cut = whole.split('.').next().unwrap();
    let damaged: String = (0..120)
        .map(|i| {
            if i == place {
                format!("{cut}\n")
            } else {
                write(all[i])
            }
        })
        .collect();
    let far = damaged.replacen(&format!("{cut}\n"), "9\n", 1);
    let (_, help) = refused(&far, &at(0.01), "\"9\" has no exponent");
    assert!(
        help.contains("9.0000000e0") && help.contains("skip_lines"),
        "{help}"
    );
    let mended = far.replacen("9\n", "9.0000000e0\n", 1);
    assert_eq!(one(&mended, &at(0.01)).samples.len(), 120);
}

/// What a name says of the sign of its values is no part of the unit.
#[test]
fn signs_behind_units() {
    let table: String = values(60)
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:.2}\t{a:.5}\t{:.5}\n", 0.01 * i as f64, 0.5 * a))
        .collect();
    let header = "# Column 1: Time (s)\n# Column 2: North-south acceleration (cm/s/s) (+ is northward)\n# Column 3: Up-down acceleration (cm/s/s) (+ is upward)\n#";
    let series = read_with(&format!("{header}\n{table}"), &ReadOptions::default()).unwrap();
    assert_eq!((series.len(), series[0].unit), (2, "cm/s2"));
    let other = format!(
        "{}\n{table}",
        header.replace("Up-down acceleration (cm/s/s)", "Up-down acceleration (g)")
    );
    refused(
        &other,
        &ReadOptions::default(),
        "the unit is g here, but cm/s2 in line 2",
    );
}

/// Ordinates of a spectrum by the damping in their names.
#[test]
fn spectra_of_rotated_components() {
    let rows: String = (1..60)
        .map(|i| {
            format!(
                "  {:.4} .6274E+00 .5{i:03}E+00 .6300E+00 .6400E+00\n",
                0.01 * f64::from(i)
            )
        })
        .collect();
    let text =
        format!("#  Psa5_N Psa5_E RotD50 RotD100\n#  site.peer_e.acc\n#     59    0.0500\n{rows}");
    refused(&text, &in_g(), "is that of a spectrum");
}

/// El Centro with its header as comments, and with a count that is not that of its values.
#[test]
fn points_at_equal_spacing() {
    let rows = rows_of_eight(&values(80));
    let of = |sign: &str, more: &str| {
        format!(
            "{sign}Data for a quake\n{sign}80 points at equal spacing of 0.02 sec\n{sign}The units are (g){more}\n{sign}*** Begin data ***\n{rows}"
        )
    };
    for sign in ["", "#"] {
        let series = one(&of(sign, ""), &ReadOptions::default());
        assert_eq!((series.unit, series.samples.len()), ("g", 80), "{sign}");
        assert!((series.sampling.median_step() - 0.02).abs() < 1e-15);
        assert!(
            !series.origin.title.contains('#'),
            "{}",
            series.origin.title
        );
    }
    let text = of("", " NPTS=  400, DT= .0200 SEC");
    let (_, help) = refused(
        &text,
        &ReadOptions::default(),
        "400 samples here, but 80 in line 2",
    );
    assert!(help.contains("lenient"), "{help}");
    let told = one(&text, &lenient(ReadOptions::default()));
    assert_eq!(told.samples.len(), 80);
}

/// What an old computer wrote behind the last channel is no header; one that was cut off is.
#[test]
fn remarks_behind_volumes() {
    for fixture in fixtures("caltech_volume_1", 0) {
        let read = |more: &str| {
            let mut bytes = fixture.bytes.clone();
            bytes.extend(more.as_bytes());
            read_all_bytes("f", &bytes, &fixture.options)
        };
        let whole = read("").unwrap().series;
        let found = read("VLEE $\r\r\n\u{1a}").unwrap().series;
        assert_eq!(found.len(), whole.len(), "{}", fixture.name);
        let told = found[0].origin.warnings.join("\n");
        assert!(
            told.contains("\"VLEE $\" behind the last channel"),
            "{told}"
        );
        let text = String::from_utf8_lossy(&fixture.bytes);
        let header: String = text.split_inclusive('\n').take(2).collect();
        let said = read(&header).unwrap_err().to_string();
        assert!(said.contains("ends where"), "{}: {said}", fixture.name);
        // A line that is long is one of a header.
        assert!(
            read("AN EARTHQUAKE WITH A LONG NAME\r\n").is_err(),
            "{}",
            fixture.name
        );
    }
}

/// A peak without a unit may be of another quantity, component or stage: what a line names so is held against nothing.
#[test]
fn peaks_of_something_else() {
    let rows = rows_of_eight(&values(400));
    let above = |line: &str| format!("{line}\ndt = 0.02 s\nunits: g\n{rows}");
    for line in [
        "Acceleration: peak value: 0.25 at 0.1 sec\nVelocity: peak value: 24.3 at 3.20 sec",
        "Peak value: 24.3 at 2.58 sec (velocity)",
        "Vertical: Peak value: 90.3 at 3.2 sec",
        "Raw record, peak value: 260.1 at 2.6 sec",
        "Sa, peak value: 612.1 at 0.3 sec, 5 %",
        "Peak value: 1.0 at 2.58 sec (normalised)",
        "Peak value: 0.25 at 0.1 sec (NS), peak value: 0.3 at 3.1 sec (EW)",
    ] {
        assert_eq!(
            one(&above(line), &ReadOptions::default()).samples.len(),
            400
        );
    }
    refused(
        &above("Peak value: 24.3 at 2.58 sec"),
        &ReadOptions::default(),
        "a peak of 24.3",
    );
}

/// Times that go on across a comment are those of one record; a range counts nothing; a heading of another quantity
/// among rows without times begins another record.
#[test]
fn comments_among_the_rows() {
    let values = values(400);
    let line = |(i, a): (usize, &f64)| format!("{:.2} {a:.6}\n", 0.02 * i as f64);
    let times: Vec<String> = values.iter().enumerate().map(line).collect();
    let (first, second) = times.split_at(200);
    let head = "# dt = 0.02 s\n# units: g\n";
    for comment in [
        "# count: 200",
        "# dt = 0.02 s",
        "# npts 400",
        "# time step 201",
        "# Velocity (cm/s)",
    ] {
        let text = format!("{head}{}{comment}\n{}", first.concat(), second.concat());
        assert_eq!(one(&text, &ReadOptions::default()).samples.len(), 400);
    }
    let rows = rows_of_eight(&values);
    let rows: Vec<&str> = rows.split_inclusive('\n').collect();
    let (first, second) = rows.split_at(25);
    let with = |comment: &str| format!("{head}{}{comment}\n{}", first.concat(), second.concat());
    for comment in ["# samples 201 to 400", "# points 201-400"] {
        assert_eq!(
            one(&with(comment), &ReadOptions::default()).samples.len(),
            400
        );
    }
    for comment in [
        "# Velocity (cm/s)",
        "# Acceleration (cm/s2)",
        "# displacement",
        "# dt = 0.01 s",
    ] {
        refused(
            &with(comment),
            &ReadOptions::default(),
            "several records in one file",
        );
    }
}
