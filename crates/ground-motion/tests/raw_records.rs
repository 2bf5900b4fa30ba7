//! Raw records of UNAM, SMC, USC, COSMOS, BHRC and the network of Turkey: what their headers say
//! and the samples, or another line, contradict is refused with both numbers; so is what is
//! missing or damaged, with its true reason.
use crate::common::{COUNT, Fixture, fixtures};
use pounding_ground_motion::{
    AccelerationUnit, GroundMotionError, Quantity, ReadOptions, Recording, Sampling,
    read_all_bytes, read_bytes,
};

fn named(format: &'static str, name: &str) -> Fixture {
    let mut all = fixtures(format, 0).into_iter();
    all.find(|f| f.name == name).unwrap()
}

/// The file with changes; each must be possible.
fn changed(fixture: &Fixture, changes: &[(&str, &str)]) -> Vec<u8> {
    let mut text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    for (from, to) in changes {
        assert!(text.contains(from), "{from} is not in {}", fixture.name);
        text = text.replace(from, to);
    }
    text.chars().map(|c| c as u8).collect()
}

fn read_changed(
    fixture: &Fixture,
    changes: &[(&str, &str)],
    options: &ReadOptions,
) -> Result<Recording, GroundMotionError> {
    read_all_bytes("file", &changed(fixture, changes), options)
}

/// The error names all the words, and there is a remedy.
fn refused(fixture: &Fixture, changes: &[(&str, &str)], words: &[&str]) {
    let error = read_changed(fixture, changes, &ReadOptions::default()).unwrap_err();
    let shown = format!("{error}; {}", error.help().unwrap());
    for word in words {
        assert!(shown.contains(word), "{word} is not in {shown}");
    }
}

fn lenient() -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    }
}

/// `KEY : value` up to the end of the line, for changes.
fn line_of(fixture: &Fixture, start: &str) -> String {
    let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
    let line = text.lines().find(|l| l.starts_with(start));
    line.unwrap_or_else(|| panic!("{start}")).to_owned()
}

#[test]
fn asa_of_unam() {
    let unam = named("asa", "asa_unam");
    let step = line_of(&unam, "INTERVALO DE MUESTREO, C1");
    let count = line_of(&unam, "NUM. TOTAL DE MUESTRAS, C1");
    let peaks = line_of(&unam, "ACEL. MAX.(Gal), C1");
    let length = line_of(&unam, "DURACION DEL REGISTRO (s), C1");
    let to = |line: &str, from: &str, to: &str| line.replace(from, to);
    let slow = to(&step, "0.004", "0.04");
    refused(&unam, &[(&step, &slow)], &["0.092 s", "0.92 s"]);
    refused(
        &unam,
        &[(&step, &slow), (&length, "")],
        &["0.04 s", "250 samples/s", "0.004 s", "--time-step"],
    );
    refused(
        &unam,
        &[(&count, &to(&count, "/23", "/230"))],
        &["230", "23"],
    );
    refused(
        &unam,
        &[(&count, &to(&count, "/23", "/7"))],
        &["7 samples", "23 stand"],
    );
    refused(
        &unam,
        &[(&length, &to(&length, "0.092", "9.2"))],
        &["9.2 s", "0.092 s"],
    );
    let first = peaks.split('/').nth(1).unwrap().trim().to_owned();
    refused(
        &unam,
        &[(&peaks, &peaks.replacen(&first, "-99.00", 1))],
        &["99.00", "cm/s2", &first[..4]],
    );
    let unit = "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)";
    for wrong in ["cuentas", "Gal (m/s/s)"] {
        refused(&unam, &[(unit, &to(unit, "Gal (cm/s/s)", wrong))], &[wrong]);
    }
    // Accents in keys, in Latin-1 and in UTF-8.
    for letter in ["\u{d3}", "\u{c3}\u{93}"] {
        let accents = [
            ("ORIENTACION", &*format!("ORIENTACI{letter}N")),
            (
                "DATOS DE ACELERACION",
                &*format!("DATOS DE ACELERACI{letter}N"),
            ),
            ("DURACION", &*format!("DURACI{letter}N")),
        ];
        let read = read_changed(&unam, &accents, &ReadOptions::default()).unwrap();
        assert_eq!(read.series.len(), 3);
    }
    // The rate alone.
    let read = read_changed(&unam, &[(&step, "")], &ReadOptions::default()).unwrap();
    assert_eq!(read.series[0].sampling, Sampling::Even { time_step: 0.004 });
    // Not stated: the user must.
    assert!(matches!(
        read_changed(&unam, &[(unit, "")], &ReadOptions::default()),
        Err(GroundMotionError::MissingUnit { .. })
    ));
    assert!(matches!(
        read_changed(
            &unam,
            &[],
            &ReadOptions {
                unit: Some(AccelerationUnit::StandardGravity),
                ..ReadOptions::default()
            }
        ),
        Err(GroundMotionError::Contradiction { .. })
    ));
    refused(
        &unam,
        &[("3F10.3", "4F10.3")],
        &["4 columns", "3 orientations"],
    );
    refused(&unam, &[("3F10.3", "999F10.3")], &["FORMATO DATOS"]);
    refused(
        &unam,
        &[("DATOS DE ACELERACION", "DATOS")],
        &["no rows of numbers"],
    );
    // Every second sample is left: interval and count are those of the recorder.
    let twice = [
        (
            "FACTOR DE DECIMACION                   : 1",
            "FACTOR DE DECIMACION                   : 2",
        ),
        (count.as_str(), &to(&count, "/23", "/46")),
        (length.as_str(), &to(&length, "0.092", "0.184")),
    ];
    let read = read_changed(&unam, &twice, &ReadOptions::default()).unwrap();
    assert_eq!(read.series[0].sampling, Sampling::Even { time_step: 0.008 });
}

/// Channels may end before one another; what is blank in between is missing.
#[test]
fn blank_fields_of_asa() {
    let unam = named("asa", "asa_unam");
    let text = String::from_utf8(unam.bytes.clone()).unwrap();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let last = lines.len() - 1;
    let blank = " ".repeat(10);
    // The second channel lacks its last two samples.
    for line in &mut lines[last - 1..] {
        line.replace_range(10..20, &blank);
    }
    let counts = "/23/23/23";
    let short = lines
        .join("\n")
        .replace(counts, "/23/21/23")
        .replace("0.092/0.092", "0.092/0.084");
    let read = read_all_bytes("file", short.as_bytes(), &unam.options).unwrap();
    let found: Vec<usize> = read.series.iter().map(|s| s.samples.len()).collect();
    assert_eq!(found, [COUNT, COUNT - 2, COUNT]);
    assert_eq!(read.series[1].samples, unam.truth[1].samples[..COUNT - 2]);
    // With the count of all, two are missing.
    let error = read_all_bytes("file", lines.join("\n").as_bytes(), &unam.options).unwrap_err();
    assert!(
        matches!(
            error,
            GroundMotionError::TooFewSamples {
                expected: 23,
                found: 21,
                ..
            }
        ),
        "{error}"
    );
    // A blank field in the middle of a channel, and a value of which a part is cut off.
    let mut hole: Vec<String> = text.lines().map(str::to_owned).collect();
    hole[last - 3].replace_range(0..10, &blank);
    let error = read_all_bytes("file", hole.join("\n").as_bytes(), &unam.options).unwrap_err();
    assert!(
        error.to_string().contains("channel 1 goes on after"),
        "{error}"
    );
    let mut cut: Vec<String> = text.lines().map(str::to_owned).collect();
    cut[last].truncate(17);
    let error = read_all_bytes("file", cut.join("\n").as_bytes(), &unam.options).unwrap_err();
    assert!(error.to_string().contains("is cut off"), "{error}");
}

#[test]
fn smc_at_even_steps_and_film() {
    let raw = named("usgs_smc", "smc_raw");
    let numbers = format!("{:>10}", COUNT);
    refused(&raw, &[(&numbers, "       230")], &["230", "23"]);
    refused(
        &raw,
        &[(&numbers, "         4")],
        &["4 samples", "23 stand"],
    );
    // Neither a rate nor times.
    let rate = "2.0000000E+02";
    refused(&raw, &[(rate, "1.7000000E+38")], &["time", "is not after"]);
    // Rates that some headers hold.
    refused(&raw, &[(rate, "2.7360000E+26")], &["is not after"]);
    refused(&raw, &[(numbers.as_str(), "    -32768")], &["integer 17"]);
    let text = String::from_utf8(raw.bytes.clone()).unwrap();
    let truth = raw.truth[0]
        .samples
        .iter()
        .fold(0.0_f64, |m, a| m.max(a.abs()))
        * 100.0;
    let exponent = format!("-{:.7e}", truth).replace("e1", "E+01");
    assert!(text.contains(&exponent), "{exponent}");
    refused(
        &raw,
        &[(&exponent, "-2.9000000E+01")],
        &["-29.000 cm/s2", "-18."],
    );
    assert_eq!(
        read_changed(&raw, &[], &ReadOptions::default())
            .unwrap()
            .series[0]
            .origin
            .start_time,
        "2018 day 124 22:32:18.005"
    );
    // The times are the data, whatever rate stands beside them.
    let film = named("usgs_smc", "smc_film");
    let null = "1.7000000E+38";
    let text = String::from_utf8(film.bytes.clone()).unwrap();
    let second = text.match_indices(null).nth(1).unwrap().0;
    let mut rated = text.clone();
    rated.replace_range(second..second + null.len(), "6.0000000E+02");
    let read = read_all_bytes("file", rated.as_bytes(), &ReadOptions::default()).unwrap();
    assert!(matches!(&read.series[0].sampling, Sampling::Uneven { .. }));
    assert!(read.series[0].origin.warnings[0].contains("600 samples/s"));
    // Times with too few digits are parted within them; those that stand still are none.
    let tied = text.replace("2.0005E+1", "2.0004E+1");
    let read = read_all_bytes("file", tied.as_bytes(), &ReadOptions::default()).unwrap();
    let Sampling::Uneven { times } = &read.series[0].sampling else {
        panic!()
    };
    assert!(times.windows(2).all(|t| t[1] > t[0]), "{times:?}");
    assert!(
        times
            .iter()
            .any(|t| (t - 20.004).abs() < 1e-3 && (t - 20.004).abs() > 1e-5)
    );
    let mut still = text;
    for i in 0..7 {
        still = still.replace(&format!("2.000{i}E+1"), "2.0007E+1");
    }
    let error = read_all_bytes("file", still.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("is not after"), "{error}");
}

#[test]
fn usc() {
    let three = named("caltech_volume_1", "usc_three");
    let points = format!("NO. OF POINTS = {:>6}", COUNT);
    refused(
        &three,
        &[(&points, "NO. OF POINTS =    230")],
        &["230 samples", "23 stand"],
    );
    refused(
        &three,
        &[("RECORD LENGTH =   .110", "RECORD LENGTH =  1.110")],
        &["1.11 s", "0.11 s"],
    );
    refused(
        &three,
        &[("SEC AND G/10", "SEC AND G   ")],
        &["g ", "g/10", "line"],
    );
    // A column that must be blank, a row that is longer than the first.
    let text = String::from_utf8(three.bytes.clone()).unwrap();
    let row = text.lines().find(|l| l.starts_with("    .000")).unwrap();
    let next = text.lines().skip_while(|l| *l != row).nth(1).unwrap();
    refused(
        &three,
        &[(next, &format!("9{}", &next[1..]))],
        &["first 1 columns"],
    );
    refused(
        &three,
        &[(next, &format!("{next}   .001"))],
        &["more than 10 numbers of 7 columns"],
    );
    let options = ReadOptions {
        component: Some("UP".to_owned()),
        time_step: Some(0.004),
        ..ReadOptions::default()
    };
    let record = read_bytes("file", &three.bytes, &options).unwrap();
    assert_eq!(record.origin().unwrap().component, "UP");
}

#[test]
fn cosmos_v0() {
    let raw = named("cosmos", "cosmos_raw");
    let read = read_changed(&raw, &[], &ReadOptions::default()).unwrap();
    let quantities: Vec<Quantity> = read.series.iter().map(|s| s.quantity).collect();
    use Quantity::{Acceleration, Velocity};
    assert_eq!(quantities, [Acceleration, Velocity, Acceleration]);
    refused(
        &raw,
        &[("        .298000", "    -999.000000")],
        &["real 22", "sensitivity"],
    );
    refused(
        &raw,
        &[("       1.250000", "    -999.000000")],
        &["real 42"],
    );
    refused(
        &raw,
        &[("       2.000000", "       0.000000")],
        &["gain", "zero"],
    );
    refused(
        &raw,
        &[(" counts(50)", " cm/sec2(04)")],
        &["4 here", "50 in line"],
    );
    refused(
        &raw,
        &[("        .005000", "        .050000")],
        &["0.005 s here", "0.05 s in line"],
    );
    // Without a gain it is one.
    let read = read_changed(
        &raw,
        &[("       2.000000", "    -999.000000")],
        &ReadOptions::default(),
    );
    let each = read.unwrap().series[0].unit_in_si;
    assert!((each / (0.298e-6 / 1.25 * 9.80665) - 1.0).abs() < 1e-12);
    // The user's sensitivity takes the place of the header's.
    let options = ReadOptions {
        sensitivity: Some(1000.0),
        ..ReadOptions::default()
    };
    let read = read_changed(&raw, &[], &options).unwrap();
    assert_eq!(read.series[0].unit_in_si, 0.001);
}

#[test]
fn bhrc() {
    let file = named("bhrc", "bhrc");
    let points = format!("NO. OF POINTS = {:>6}", COUNT);
    let number = format!("{:>5}", COUNT);
    refused(
        &file,
        &[(&points, "NO. OF POINTS =    230")],
        &["230", "23"],
    );
    refused(&file, &[(&number, "    7")], &["7 samples", "23 stand"]);
    refused(&file, &[(&number, "99999")], &["99999"]);
    refused(
        &file,
        &[("DURATION =    .115", "DURATION =   1.115")],
        &["1.115 s", "0.115 s"],
    );
    refused(&file, &[("AND G/10", "AND G")], &["g here", "g/10 in line"]);
    refused(
        &file,
        &[("AND G/10", "AND COUNTS"), (".100000E+00", ".000000E+00")],
        &["\"counts\" is no unit that is known"],
    );
    refused(&file, &[("VOL1DS", "VOL2DS")], &["only Volume 1"]);
    refused(
        &file,
        &[("/&\n* VOL1DS", "/&\nVOL1DS")],
        &["text where a channel"],
    );
    // A rate that the duration contradicts, and none: the duration gives it.
    refused(
        &file,
        &[(".200000E+03", ".100000E+03")],
        &["0.115 s", "0.23 s"],
    );
    let read = read_changed(
        &file,
        &[(".200000E+03", ".000000E+00")],
        &ReadOptions::default(),
    )
    .unwrap();
    assert_eq!(read.series[0].sampling, Sampling::Even { time_step: 0.005 });
    let unclear = [
        (".200000E+03", ".000000E+00"),
        ("DURATION =    .115", "DURATION =    .117"),
        (".115000E+00", ".117000E+00"),
    ];
    refused(
        &file,
        &unclear,
        &["real 9", "23 points in 0.117 s", "--time-step"],
    );
    // As many times as values: the other layout of the volume, never taken for a motion.
    let mut pairs = String::new();
    let text = String::from_utf8(file.bytes.clone()).unwrap();
    let mut index = 0;
    for line in text.lines() {
        let fields = line.len() > 65 && line.len() % 13 == 0;
        let data = fields || line.len() == 39 && line.contains('E');
        if !data {
            index = 0;
            pairs.push_str(&format!("{line}\n"));
            continue;
        }
        for field in line.as_bytes().chunks(13) {
            let time = 0.005 * f64::from(index) + 0.001 * f64::from(index % 2);
            index += 1;
            pairs.push_str(&format!(
                "{time:>13.6}{}\n",
                std::str::from_utf8(field).unwrap()
            ));
        }
    }
    let read = read_all_bytes("file", pairs.as_bytes(), &ReadOptions::default()).unwrap();
    let Sampling::Uneven { times } = &read.series[2].sampling else {
        panic!()
    };
    assert_eq!((times.len(), times[1]), (COUNT, 0.006));
    assert!((read.series[2].samples[5] / file.truth[2].samples[5] - 1.0).abs() < 1e-12);
}

#[test]
fn network_of_turkey() {
    let file = named("nsmn", "nsmn");
    let count = line_of(&file, "NUMBER OF DATA");
    let peaks = line_of(&file, "RAW PGA");
    refused(
        &file,
        &[(&count, &count.replace("23", "230"))],
        &["230", "23"],
    );
    refused(
        &file,
        &[(&count, &count.replace("23", "7"))],
        &["7 samples", "23 stand"],
    );
    refused(
        &file,
        &[(&count, &count.replace("23", "many"))],
        &["many", "not a number of samples"],
    );
    refused(
        &file,
        &[(&peaks, &peaks.replace("(N-S) ", "(N-S) 9"))],
        &["the header's peak is 9", "cm/s2"],
    );
    refused(&file, &[("(gal)", "(volt)")], &["volt"]);
    // Another unit of the peaks is that of the samples: both change together.
    let read = read_changed(&file, &[("(gal)", "(mg)")], &ReadOptions::default()).unwrap();
    assert_eq!(read.series[0].unit, "mg");
    assert!(matches!(
        read_changed(&file, &[(&peaks, "")], &ReadOptions::default()),
        Err(GroundMotionError::MissingUnit { .. })
    ));
    assert!(matches!(
        read_changed(
            &file,
            &[(&line_of(&file, "SAMPLING INTERVAL"), "")],
            &ReadOptions::default()
        ),
        Err(GroundMotionError::MissingTimeStep { .. })
    ));
    let names = line_of(&file, "       N-S");
    refused(
        &file,
        &[(&names, "       N-S          E-W")],
        &["more than 2 numbers"],
    );
    refused(
        &file,
        &[(&names, &format!("{names}   U-D"))],
        &["fewer than 4 numbers"],
    );
    refused(&file, &[(&names, "")], &["N-S E-W U-D"]);
    // Lenient: the samples as they are, with both numbers in a warning.
    let wrong = peaks.replace("(N-S) ", "(N-S) 9");
    let read = read_changed(&file, &[(&peaks, &wrong)], &lenient()).unwrap();
    assert!(
        read.series[0]
            .origin
            .warnings
            .iter()
            .any(|w| w.contains("the header's peak is 9"))
    );
}

/// Pairs of which a row is missing, doubled, out of place or short of a number were read as
/// accelerations at even steps, times among them, where a step was given or the header has a rate.
#[test]
fn smc_pairs_that_are_damaged_are_never_even() {
    let film = named("usgs_smc", "smc_film");
    let text = String::from_utf8(film.bytes.clone()).unwrap();
    let pair = |i: usize| {
        let time = 20.0 + 0.0015 * i as f64 + 0.0005 * (1.3 * i as f64).sin();
        [time, 30.0 * (0.7 * i as f64).sin() + 0.01]
    };
    let field = |value: f64| {
        let plain = format!("{value:.4e}");
        let (mantissa, exponent) = plain.split_once('e').unwrap();
        format!("{mantissa}E{:+}", exponent.parse::<i32>().unwrap())
    };
    let numbers: Vec<String> = (0..400).flat_map(pair).map(field).collect();
    let rows = |numbers: &[String]| -> Vec<String> {
        let row = |row: &[String]| row.iter().map(|n| format!("{n:>10}")).collect();
        numbers.chunks(8).map(row).collect()
    };
    let whole = rows(&numbers);
    let old = format!("{:>10}", 2 * COUNT);
    let head = &text[..text.rfind('|').unwrap()];
    let head = format!("{head}| film\n");
    let first = head.lines().count() + 1;
    let file = |rows: &[String], count: usize| {
        let head = head.replacen(&old, &format!("{count:>10}"), 1);
        head + &rows.join("\n") + "\n"
    };
    let read = |text: &str, time_step: Option<f64>| {
        let options = ReadOptions {
            time_step,
            lenient: true,
            ..ReadOptions::default()
        };
        read_all_bytes("f", text.as_bytes(), &options)
    };
    let sound = read(&file(&whole, 800), None).unwrap();
    assert_eq!(sound.series[0].samples.len(), 400);

    let mut swapped = whole.clone();
    swapped.swap(50, 51);
    let mut doubled = whole.clone();
    doubled.insert(30, whole[20].clone());
    let mut without = numbers.clone();
    without.remove(301);
    for (damaged, count, row) in [
        (&swapped, 800, 51),
        (&doubled, 808, 30),
        (&rows(&without), 799, 37),
    ] {
        for (rate, step) in [
            ("1.7000000E+38", None),
            ("1.7000000E+38", Some(0.005)),
            ("2.0000000E+02", None),
        ] {
            let mut text = file(damaged, count);
            let second = text.match_indices("1.7000000E+38").nth(1).unwrap().0;
            text.replace_range(second..second + rate.len(), rate);
            let error = read(&text, step).unwrap_err();
            let place = format!("f:{}:1: nearly every other number is a time", first + row);
            assert!(error.to_string().starts_with(&place), "{place}: {error}");
            assert!(!error.help().unwrap().contains("time_step"));
        }
    }
    // A slow motion that rises is no time.
    let slow: Vec<String> = (0..400)
        .map(|i| field(1.0 + (0.01 * f64::from(i)).sin()))
        .collect();
    let even = read(&file(&rows(&slow), 400), Some(0.005)).unwrap();
    assert_eq!(even.series[0].samples.len(), 400);
}
