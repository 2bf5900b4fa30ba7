//! Words of headers that codes, other words or the samples contradict, numbers that are blank, and
//! components by their direction: small files of our own in the layouts of the agencies.
use crate::common::{COUNT, Fixture, fixtures};
use pounding_ground_motion::{
    GroundMotionError, Processing, Quantity, ReadOptions, Recording, Sampling, read_all_bytes,
    read_bytes,
};

fn named(format: &'static str, name: &str) -> Fixture {
    let mut all = fixtures(format, 0).into_iter();
    all.find(|f| f.name == name).unwrap()
}

fn text(fixture: &Fixture) -> String {
    fixture.bytes.iter().map(|b| char::from(*b)).collect()
}

/// The text with changes; each must be possible.
fn changed(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from} is not in {text}");
        text.replace(from, to)
    })
}

fn read(text: &str) -> Result<Recording, GroundMotionError> {
    read_with(text, &ReadOptions::default())
}

fn read_with(text: &str, options: &ReadOptions) -> Result<Recording, GroundMotionError> {
    let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
    read_all_bytes("file", &bytes, options)
}

/// The error starts with its place, names all the words, and there is a remedy.
fn refused(text: &str, place: &str, words: &[&str]) {
    let error = read(text).unwrap_err();
    let shown = format!("{error}; {}", error.help().unwrap());
    assert!(shown.starts_with(place), "{place}: {shown}");
    for word in words {
        assert!(shown.contains(word), "{word} is not in {shown}");
    }
}

/// `file:7:1: ` of the first line that holds some words.
fn at_line(text: &str, words: &str) -> String {
    let line = text.lines().position(|l| l.contains(words)).unwrap() + 1;
    format!("file:{line}:1: ")
}

fn warned(recording: &Recording, words: &str) {
    let warnings = &recording.series[0].origin.warnings;
    assert!(warnings.iter().any(|w| w.contains(words)), "{warnings:?}");
}

fn lenient() -> ReadOptions {
    ReadOptions {
        lenient: true,
        ..ReadOptions::default()
    }
}

fn component(name: &str) -> ReadOptions {
    ReadOptions {
        component: Some(name.to_owned()),
        ..ReadOptions::default()
    }
}

/// Names of the components that these words choose.
fn chosen(fixture: &Fixture, wanted: &[&str]) -> Vec<String> {
    let choose = |wanted: &&str| {
        let options = ReadOptions {
            time_step: fixture.truth[0].times.is_some().then_some(0.004),
            ..component(wanted)
        };
        let read = read_bytes("file", &fixture.bytes, &options);
        let read = read.unwrap_or_else(|e| panic!("{wanted}: {e}"));
        read.origin().unwrap().component.clone()
    };
    wanted.iter().map(choose).collect()
}

#[test]
fn cosmos_words_and_codes() {
    let raw = text(&named("cosmos", "cosmos_raw"));
    let first = "Raw acceleration counts";
    refused(
        &raw.replacen(first, "Raw velocity counts    ", 1),
        "file:1:1: ",
        &[
            "velocity here",
            "Raw velocity counts",
            "counts of acceleration",
        ],
    );
    refused(
        &raw.replacen("raw accel. ", "raw displ. ", 1),
        &at_line(&raw, "raw accel."),
        &["displacement here", "acceleration"],
    );
    // The code says velocity, all words acceleration.
    let code = format!("{:>8}{:>8}{:>8}", 0, 1, 50);
    refused(
        &raw.replacen(&code, &format!("{:>8}{:>8}{:>8}", 0, 2, 50), 1),
        "file:1:1: ",
        &["acceleration here", "velocity"],
    );
    refused(
        &raw.replacen(first, "Corrected acceleration ", 1),
        "file:1:1: ",
        &["corrected here", "stage 0", "line 15"],
    );
    let taken = read_with(
        &raw.replacen(first, "Corrected acceleration ", 1),
        &lenient(),
    );
    let taken = taken.unwrap();
    warned(&taken, "stage 0");
    // The first of both is used, as the remedy says.
    assert_eq!(taken.series[0].origin.processing, Processing::Corrected);
    // A sensor of velocity under a record of acceleration.
    let blank = format!("{:>8}{:>8}{:>8}", -999, -999, 90);
    assert!(raw.contains(&blank), "{raw}");
    refused(
        &raw.replacen(&blank, &format!("{:>8}{:>8}{:>8}", 1001, -999, 90), 1),
        "file:20:1: ",
        &["velocity here", "sensor of kind 1001"],
    );
    // Units of corrected values: words and code, and the header's code.
    let corrected = text(&named("cosmos", "cosmos"));
    refused(
        &corrected.replacen("units=cm/sec2(04)", "units=g(04)", 1),
        &at_line(&corrected, "units=cm/sec2(04)"),
        &["g in words", "cm/s2 by its code 4"],
    );
    refused(
        &corrected.replacen("units=cm/sec2(04)", "units=g(02)", 1),
        &at_line(&corrected, "units=cm/sec2(04)"),
        &["unit code is 2 here", "4 in line 15"],
    );
    // A word that is not known beside a code is said; the number of the layout is no code.
    let unknown = corrected.replacen("units=cm/sec2(04)", "units=um/sec2(04)", 1);
    warned(
        &read(&unknown).unwrap(),
        "\"um/sec2\" is not known here; the values are taken as cm/s2",
    );
    let bare = corrected.replacen("units=cm/sec2(04)", "units=cm/sec2", 1);
    assert!(bare.contains("Format=("), "{bare}");
    read(&bare).unwrap();
    // Gal and cm/s2 are one unit.
    read(&corrected.replacen("units=cm/sec2(04)", "units=gal(10)", 1)).unwrap();
    // The component in words and in numbers.
    let line = "Text line 9\n";
    let other = corrected.replacen(line, "Sta Chan   1: 180 Deg (Rcrdr Chan  1)\n", 1);
    refused(&other, "file:9:1: ", &["180 Deg", "90 deg", "integer 54"]);
    let taken = read_with(&other, &lenient()).unwrap();
    warned(&taken, "integer 54");
    assert_eq!(taken.series[0].component, "180 Deg");
    read(&corrected.replacen(line, "Sta Chan   1: 90 Deg (Rcrdr Chan  1)\n", 1)).unwrap();
    // The peak in words.
    let line = "Text line 11\n";
    let peak = "Processed:2019 Max =    -1.234 cm/sec2 at   76.215 sec\n";
    refused(
        &corrected.replacen(line, peak, 1),
        "file:11:1: ",
        &["-1.2340 cm/s2", "that of the samples"],
    );
    // A length that is blank is not the number behind it.
    let line = "Text line 10\n";
    let blank = "Raw record length =         sec, Uncor max =   1033406, at  45.580 sec.\n";
    read(&corrected.replacen(line, blank, 1)).unwrap();
}

#[test]
fn smc_kinds_words_and_peaks() {
    let raw = text(&named("usgs_smc", "smc_raw"));
    let title = "1 UNCORRECTED ACCELEROGRAM";
    // A velocity is read as one, and never excites.
    for (words, quantity) in [
        ("1 UNCORRECTED VELOCITY", Quantity::Velocity),
        ("1 UNCORRECTED DISPLACEMENT", Quantity::Displacement),
    ] {
        let other = raw.replace(title, words);
        let recording = read(&other).unwrap();
        assert_eq!(recording.series[0].quantity, quantity);
        let error = read_bytes("file", other.as_bytes(), &ReadOptions::default());
        assert!(
            matches!(error, Err(GroundMotionError::NotAcceleration { quantity: found, .. }) if found == quantity.name()),
            "{error:?}"
        );
    }
    refused(
        &raw.replace(title, "2 CORRECTED VELOCITY"),
        "file:1:1: ",
        &["kind 2 is acceleration", "say velocity"],
    );
    refused(
        &raw.replace(title, "3 ACCELEROGRAM"),
        "file:1:1: ",
        &["kind 3 is velocity", "say acceleration"],
    );
    refused(
        &raw.replace(title, "1 CORRECTED ACCELEROGRAM"),
        "file:1:1: ",
        &["kind 1 is an uncorrected record", "say corrected"],
    );
    let error = read(&raw.replace(title, "5 RESPONSE SPECTRA")).unwrap_err();
    assert!(
        matches!(error, GroundMotionError::Unsupported { .. }),
        "{error}"
    );
    refused(
        &raw.replace("pk mot", "pk vel"),
        "file:7:1: ",
        &["velocity here", "pk vel", "acceleration"],
    );
    // Line 7 repeats the peak, and the comments the unit of a count.
    let peak = raw.split("pk mot = ").nth(1).unwrap();
    let peak = peak.split_whitespace().next().unwrap();
    refused(
        &raw.replace(peak, "9.999E+1"),
        "file:7:1: ",
        &["99.99", "-18."],
    );
    let comment = "| Digital counts re-scaled";
    refused(
        &raw.replace(comment, "| re-scaled using the factor 4.66E-04 cm/s/count"),
        "file:29:1: ",
        &["velocity here", "cm/s2"],
    );
    read(&raw.replace(
        comment,
        "| re-scaled using the factor 4.66E-04 cm/s/s/count",
    ))
    .unwrap();
    // Neither the kind nor the peak says what it is.
    let unsaid = read(&raw.replace(title, "0 UNKNOWN")).unwrap();
    warned(&unsaid, "does not say what the values are");
    // The component in words and numbers.
    refused(
        &raw.replace("component= 90", "component= 180"),
        "file:6:1: ",
        &["180", "90 by integers 13 and 14 in line 13"],
    );
    read(&raw.replace("component= 90", "component= N90E")).unwrap();
}

#[test]
fn smc_numbers_that_are_missing() {
    let raw = named("usgs_smc", "smc_raw");
    let raw = text(&raw);
    let count = format!("{COUNT:>10}");
    refused(
        &raw.replace(&count, "          "),
        "file:14:1: ",
        &["integer 17", "is blank"],
    );
    refused(
        &raw.replace(&count, "**********"),
        "file:14:1: ",
        &["integer 17", "\"**********\""],
    );
    // Comments are known by their bars, whatever their number says.
    let comments = format!("{:>10}\n{count}", 2);
    for stated in ["          ", "         1", "         9"] {
        let other = changed(&raw, &[(&comments, &format!("{stated}\n{count}"))]);
        let read = read(&other).unwrap();
        assert_eq!(read.series[0].samples.len(), COUNT, "{stated}");
        warned(&read, "the number of comment lines (integer 16)");
    }
    // No rate: said of the rate, with the way to give it.
    let unrated = raw.replace("2.0000000E+02", "1.7000000E+38");
    refused(
        &unrated,
        "file:18:1: ",
        &[
            "no sampling rate (real 2)",
            "every other number is no time",
            "--time-step",
        ],
    );
    let options = ReadOptions {
        time_step: Some(0.005),
        ..ReadOptions::default()
    };
    let given = read_with(&unrated, &options).unwrap();
    assert_eq!(
        given.series[0].sampling,
        Sampling::Even { time_step: 0.005 }
    );
    assert_eq!(given.series[0].samples.len(), COUNT);
}

/// The count of film is that of numbers, or that of samples.
#[test]
fn smc_counts_of_pairs() {
    let film = named("usgs_smc", "smc_film");
    let numbers = format!("{:>10}", 2 * COUNT);
    let text = text(&film);
    for stated in [2 * COUNT, COUNT] {
        let recording = read(&changed(&text, &[(&numbers, &format!("{stated:>10}"))])).unwrap();
        assert_eq!(
            recording.series[0].samples, film.truth[0].samples,
            "{stated}"
        );
        assert!(recording.series[0].origin.warnings.is_empty(), "{stated}");
    }
    let long = changed(&text, &[(&numbers, &format!("{:>10}", 2 * COUNT + 20))]);
    refused(
        &long,
        "file:",
        &["33 samples (66 numbers in integer 17", "after 23"],
    );
    let short = changed(&text, &[(&numbers, &format!("{:>10}", 8))]);
    refused(
        &short,
        "file:14:1: ",
        &["8 values", "8 or 16 numbers", "46 stand"],
    );
}

/// Values of eight digits in columns of 14, which integer 47 announces.
#[test]
fn smc_of_eight_digits() {
    let raw = text(&named("usgs_smc", "smc_raw"));
    let data = raw.find("| Digital counts re-scaled\n").unwrap() + 27;
    let rows: Vec<f64> = (0..COUNT)
        .map(|i| -18.0 * (0.31 * i as f64).sin())
        .collect();
    let most = rows.iter().fold(0.0_f64, |m, a| m.max(a.abs()));
    let row = |row: &[f64]| {
        let field = |a: &f64| {
            let plain = format!("{a:.7e}");
            let (mantissa, exponent) = plain.split_once('e').unwrap();
            format!(
                "{:>14}",
                format!("{mantissa}E{:+}", exponent.parse::<i32>().unwrap())
            )
        };
        row.iter().map(field).collect::<String>() + "\n"
    };
    let rows: String = rows.chunks(5).map(row).collect();
    let lines: Vec<&str> = raw[..data].lines().collect();
    let mut header: Vec<String> = lines.iter().map(|l| (*l).to_owned()).collect();
    header[16].replace_range(60..70, "         8");
    // Peaks of another series.
    let reals = &mut header[17..27];
    for line in reals.iter_mut().skip(5).take(2) {
        *line = "  1.7000000E+38".repeat(5);
    }
    header[6] = format!("epicentral dist =     97.9       pk mtn = {most:.3E}");
    let read = read(&(header.join("\n") + "\n" + &rows)).unwrap();
    assert_eq!(read.series[0].samples.len(), COUNT);
    let first = -18.0 * 0.31_f64.sin() * 0.01;
    assert!((read.series[0].samples[1] - first).abs() < 1e-9);
}

#[test]
fn asa_columns_and_units() {
    let unam = text(&named("asa", "asa_unam"));
    let line = unam
        .lines()
        .find(|l| l.starts_with("ORIENTACION C1"))
        .unwrap();
    let names = line.split_once(": /").unwrap().1;
    let [a, b, c] = names.split('/').collect::<Vec<_>>()[..] else {
        panic!("{names}")
    };
    let (a, b, c) = (a.trim(), b.trim(), c.trim());
    let above = |x: &str, y: &str, z: &str| format!("{x:>10}{y:>10}{z:>10}\n");
    let (channels, orientations) = (above("CANAL-1", "CANAL-2", "CANAL-3"), above(a, b, c));
    let swapped = changed(&unam, &[(&orientations, &above(a, c, b))]);
    refused(
        &swapped,
        "file:",
        &[
            &format!("{a}, {c}, {b} here"),
            &format!("{a}, {b}, {c} in line"),
        ],
    );
    warned(
        &read_with(&swapped, &lenient()).unwrap(),
        "orientations are",
    );
    refused(
        &changed(
            &unam,
            &[(&channels, &above("CANAL-2", "CANAL-1", "CANAL-3"))],
        ),
        "file:",
        &["CANAL-2, CANAL-1, CANAL-3", "not in the order"],
    );
    // The unit of the peaks.
    let key = "ACEL. MAX.(Gal), C1";
    refused(
        &changed(&unam, &[(key, "ACEL. MAX.(g), C1")]),
        "file:",
        &["the header's peak", " g, that of the samples"],
    );
    refused(
        &changed(&unam, &[(key, "ACEL. MAX.(cuentas), C1")]),
        "file:",
        &["\"CUENTAS\" is not a unit"],
    );
    let peaks = unam.lines().find(|l| l.starts_with(key)).unwrap();
    let in_g: Vec<String> = peaks
        .split('/')
        .skip(1)
        .map(|gal| format!("{:.7}", gal.trim().parse::<f64>().unwrap() / 980.665))
        .collect();
    let line = format!("ACEL. MAX.(g), C1-C6 : /{}", in_g.join("/"));
    read(&changed(&unam, &[(peaks, &line)])).unwrap();
}

#[test]
fn volume_1_words() {
    let spaced = text(&named("csmip_v1", "csmip_v1_spaced"));
    // The peak has its own unit.
    let unit = spaced.lines().find(|l| l.contains("MAX")).unwrap();
    assert!(unit.contains(" G, AT"), "{unit}");
    refused(
        &spaced.replace(" G, AT", " CM/S/S, AT"),
        "file:12:1: ",
        &["the header's peak", "cm/s2, that of the samples"],
    );
    refused(
        &changed(&spaced, &[("POINTS OF ACCEL", "POINTS OF VELOC")]),
        "file:28:1: ",
        &["velocity here", "in g, which is acceleration"],
    );
    refused(
        &changed(&spaced, &[("UNITS OF UNCOR ACCEL", "UNITS OF UNCOR VELOC")]),
        "file:12:1: ",
        &["velocity here", "in g, which is acceleration"],
    );
    // Numbers that are blank are none, and not the next ones.
    for (stated, blank) in [
        (
            &*format!("NO. OF POINTS = {COUNT:>6}"),
            "NO. OF POINTS =       ",
        ),
        ("RECORD LENGTH =   .110 SEC", "RECORD LENGTH =        SEC"),
    ] {
        let recording = read(&changed(&spaced, &[(stated, blank)])).unwrap();
        assert_eq!(recording.series[0].samples.len(), COUNT);
    }
    let three = text(&named("caltech_volume_1", "usc_three"));
    let points = format!("NO. OF POINTS = {COUNT:>6}");
    let blank = changed(&three, &[(&points, "NO. OF POINTS =       ")]);
    let recording = read(&blank).unwrap();
    assert_eq!(recording.series[0].samples.len(), COUNT);
}

#[test]
fn nsmn_with_decimal_commas() {
    let file = named("nsmn", "nsmn");
    let plain = text(&file);
    let names = plain.find("       N-S").unwrap();
    let (head, rows) = plain.split_at(names);
    let peaks = head.lines().find(|l| l.starts_with("RAW PGA")).unwrap();
    let step = head.lines().find(|l| l.starts_with("SAMPLING")).unwrap();
    let commas = |text: &str| text.replace('.', ",");
    let head = changed(head, &[(peaks, &commas(peaks)), (step, &commas(step))]);
    let recording = read(&format!("{head}{}", commas(rows))).unwrap();
    warned(&recording, "decimal commas");
    for (series, truth) in recording.series.iter().zip(&file.truth) {
        assert_eq!(series.samples, truth.samples);
    }
    // Commas between numbers, and numbers that have both signs.
    let last = rows.lines().last().unwrap();
    let divided = last.split_whitespace().collect::<Vec<_>>().join(",");
    read(&plain.replace(last, &divided)).unwrap();
    refused(
        &plain.replace(last, &commas(&divided)),
        "file:",
        &["decimal commas, or commas between the numbers?"],
    );
    let both = last.replacen('.', ".5,", 1);
    refused(
        &plain.replace(last, &both),
        "file:",
        &["has both a decimal point and a comma"],
    );
}

/// `--component 90`, however the file writes it.
#[test]
fn components_by_azimuth() {
    let unam = named("asa", "asa_unam");
    let names: Vec<String> = {
        let read = read_all_bytes("file", &unam.bytes, &unam.options).unwrap();
        read.series.iter().map(|s| s.component.clone()).collect()
    };
    assert!(names.contains(&"N90E".to_owned()), "{names:?}");
    assert_eq!(
        chosen(&unam, &["90", "90 deg", "UP"]),
        ["N90E", "N90E", "V"]
    );
    assert_eq!(chosen(&unam, &["0", "360", "NS"]), ["N00E", "N00E", "N00E"]);
    let nsmn = named("nsmn", "nsmn");
    assert_eq!(
        chosen(&nsmn, &["0", "90", "N90E", "V", "E-W"]),
        ["N-S", "E-W", "E-W", "U-D", "E-W"]
    );
    let missing = read_bytes("file", &nsmn.bytes, &component("180"));
    assert!(matches!(
        missing,
        Err(GroundMotionError::NoSuchSeries { .. })
    ));
    let usc = named("caltech_volume_1", "usc_three");
    let all = read_all_bytes("file", &usc.bytes, &usc.options).unwrap();
    let names: Vec<&str> = all.series.iter().map(|s| s.component.as_str()).collect();
    assert!(names.contains(&"S58W"), "{names:?}");
    assert_eq!(chosen(&usc, &["238", "V"]), ["S58W", "UP"]);
}

#[test]
fn cwa_states_length_extremes_and_signs() {
    let plain = text(&named("cwa", "cwa"));
    let sequence = "#DataSequence: Time U(+); N(+); E(+)";
    let north = read(&plain).unwrap().series.swap_remove(1);
    assert_eq!(north.component, "N");
    let extreme = |largest: fn(f64, f64) -> f64| {
        let values = north.samples.iter().map(|a| a * 100.0);
        values.reduce(largest).unwrap()
    };
    let (most, least) = (extreme(f64::max), extreme(f64::min));
    let stated = |length: f64, most: f64, least: f64, sequence: &str| {
        let more = format!(
            "#RecordLength(sec):{length:9.3}\n#AmplitudeMAX. N:{most:9.3}~{least:9.3}\n{sequence}"
        );
        changed(&plain, &[("#DataSequence: Time U(+); N(+); E(+)", &more)])
    };
    let length = COUNT as f64 * 0.02;
    let good = read(&stated(length, most, least, sequence)).unwrap();
    assert_eq!(good.series[1].samples, north.samples);
    let peak = good.series[1].header_peak.unwrap();
    assert!((peak.value.abs() - north.peak().value).abs() < 1e-4);
    assert!(good.series[0].header_peak.is_none());

    let long = stated(2.0 * length, most, least, sequence);
    refused(
        &long,
        &at_line(&long, "#RecordLength"),
        &["duration", "lenient"],
    );
    let options = lenient();
    warned(&read_with(&long, &options).unwrap(), "duration");
    for (most, least) in [
        (10.0 * most, 10.0 * least),
        (2.0 * most, least),
        (most, 2.0 * least),
    ] {
        let high = stated(length, most, least, sequence);
        refused(&high, &at_line(&high, "#AmplitudeMAX"), &["peak", "cm/s2"]);
    }
    let minus = stated(length, most, least, "#DataSequence: Time U(+); N(-); E(+)");
    refused(
        &minus,
        &at_line(&minus, "#DataSequence"),
        &["\"N(-)\"", "sign"],
    );
}

#[test]
fn words_of_another_quantity_are_refused() {
    let at2 = |words: &str, step: &str| {
        format!("PEER\nQUAKE, STATION\n{words}\nNPTS=   4, DT= {step}\n .1 .2 -.3 .4\n")
    };
    let acceleration = "ACCELERATION TIME HISTORY IN UNITS OF G";
    for step in [
        ".01",
        ".01 SEC",
        ".01SEC",
        "10 MSEC",
        "100 HZ",
        ".01 SEC, X= 1",
        ".01 X= 1",
    ] {
        let read = read(&at2(acceleration, step)).unwrap();
        let Sampling::Even { time_step } = read.series[0].sampling else {
            panic!()
        };
        assert!((time_step - 0.01).abs() < 1e-15, "{step}");
    }
    read(&at2("VELOCITY TIME HISTORY IN UNITS OF CM/S", ".01")).unwrap();
    for words in [
        "VELOCITY TIME HISTORY IN UNITS OF G",
        "VELOCITY TIME SERIES\nIN UNITS OF G",
        "ACCELERATION TIME HISTORY IN UNITS OF CM/S",
    ] {
        let text = at2(words, ".01");
        refused(&text, "file:3:1: ", &["but the values are in"]);
    }
    for step in [".01 MIN", ".01MIN", "10 KHZ", ".01 G"] {
        let text = at2(acceleration, step);
        refused(
            &text,
            "file:4:1: ",
            &["is not a unit of a time step", "DT= .01000 SEC"],
        );
    }

    let dyna = text(&fixtures("dyna", 0).swap_remove(0));
    for words in [
        "ACCELERATION RESPONSE SPECTRUM",
        "SA",
        "VELOCITY AND DISPLACEMENT",
    ] {
        let line = dyna.lines().find(|l| l.starts_with("DATA_TYPE:")).unwrap();
        let wrong = changed(&dyna, &[(line, &format!("DATA_TYPE: {words}"))]);
        let number = dyna.lines().position(|l| l == line).unwrap() + 1;
        refused(
            &wrong,
            &format!("file:{number}:12: "),
            &[words, "time history"],
        );
    }

    let csv =
        |units: &str| format!("{units}# dt: 0.1 s\ntime_s,acceleration_g\n0,1\n0.1,2\n0.2,3\n");
    read(&csv("# Unit: g\n# Unit: g\n")).unwrap();
    refused(
        &csv("# Unit: m/s2\n# Unit: g\n"),
        "file:1:1: ",
        &["m/s2", "acceleration_g"],
    );
    refused(
        &csv("# Unit: g\n# Unit: m/s2\n"),
        "file:2:1: ",
        &["m/s2", "acceleration_g"],
    );
    refused(
        &csv("# Unit: furlong\n# Unit: g\n"),
        "file:1:1: ",
        &["furlong"],
    );
}
