//! Values in another form than nearly all others of their series, which come from that form by a loss of
//! characters: in every format, wherever they stand, also beside values that are odd and right.
use pounding_ground_motion::{ReadOptions, read_all_bytes};

/// Samples of each file.
const COUNT: usize = 400;

const FORMATS: [&str; 11] = [
    "peer_at2",
    "npts_dt",
    "midas_sgs",
    "slist",
    "tspair",
    "dyna",
    "isesd",
    "jma_csv",
    "nsmn",
    "plain_columns",
    "pounding_csv",
];

/// Rows of so many values.
fn rows(values: &[String], width: usize, separator: &str) -> String {
    let rows = values.chunks(width);
    rows.map(|row| format!("{}\n", row.join(separator)))
        .collect()
}

/// Rows of a time and a value.
fn pairs(values: &[String], print: impl Fn(usize, &str) -> String) -> String {
    let values = values.iter().enumerate();
    values.map(|(i, value)| print(i, value) + "\n").collect()
}

/// A file with these values.
fn file(format: &str, values: &[String]) -> String {
    let n = values.len();
    let time = |i: usize| 0.01 * i as f64;
    match format {
        "peer_at2" => format!(
            "PEER\nQUAKE, STATION, 90\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {n}, DT= .01 SEC\n{}",
            rows(values, 5, "  ")
        ),
        "npts_dt" => format!(
            "EL CENTRO NS ACC IN CM/S2\nNPTS= {n} DT= 0.01 SEC\n{}",
            rows(values, 8, " ")
        ),
        "midas_sgs" => format!(
            "*SGSw\n*TITLE, quake\n*UNIT&TYPE, GRAV, ACCEL\n*DATA\n{}*ENDDATA\n",
            pairs(values, |i, v| format!("{:.4E}, {v}", time(i)))
        ),
        "slist" => format!(
            "TIMESERIES XX_ABC__HNE_D, {n} samples, 100 sps, 2010-02-27T06:50:00.000000, SLIST, FLOAT, M/S**2\n{}",
            rows(values, 5, "\t")
        ),
        "tspair" => format!(
            "TIMESERIES XX_ABC__HNE_D, {n} samples, 100 sps, 2010-02-27T06:50:00.000000, TSPAIR, FLOAT, M/S**2\n{}",
            pairs(values, |i, v| format!(
                "2010-02-27T06:50:{:09.6}  {v}",
                time(i)
            ))
        ),
        "dyna" => format!(
            "EVENT_NAME: quake\nSAMPLING_INTERVAL_S: 0.01\nNDATA: {n}\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n{}",
            rows(values, 1, "")
        ),
        "isesd" => format!(
            "file: 1.cor\nwaveform code: 1\norientation of transducer: NS\nsampling period: 0.01s\nnumber of samples: {n}\nunits: m/s*s\n-> corrected acceleration time histories\n{}",
            rows(values, 5, " ")
        ),
        "jma_csv" => format!(
            "SITE CODE= 1\nSAMPLING RATE= 100Hz\nUNIT = gal(cm/s/s)\nNS,EW,UD\n{}",
            pairs(values, |i, v| format!("{v},{0},{0}", of_c(-sample(i + 5))))
        ),
        "nsmn" => format!(
            "STRONG GROUND MOTION RECORDS OF TURKIYE\nSTATION ID : 0000\nNUMBER OF DATA : {n}\nSAMPLING INTERVAL (sec) : 0.01\nRAW PGA VALUES (gal) :\nN-S E-W U-D\n{}",
            pairs(values, |i, v| format!("{v} {0} {0}", of_c(-sample(i + 5))))
        ),
        "plain_columns" => format!(
            "time (s),NS (cm/s2)\n{}",
            pairs(values, |i, v| format!("{:.2},{v}", time(i)))
        ),
        "pounding_csv" => format!(
            "time_s,acceleration_m_s2\n{}",
            pairs(values, |i, v| format!("{:.2},{v}", time(i)))
        ),
        other => panic!("{other}"),
    }
}

/// Sample `i`, which is never zero.
fn sample(i: usize) -> f64 {
    0.05 * f64::sin(0.07 * i as f64 + 0.1) + 1.234_567_8e-4
}

/// As C prints `%.7E`.
fn whole(i: usize) -> String {
    of_c(sample(i))
}

fn of_c(x: f64) -> String {
    let text = format!("{x:.7e}");
    let (mantissa, exponent) = text.split_once('e').unwrap();
    let power: i32 = exponent.parse().unwrap();
    let sign = if power < 0 { '-' } else { '+' };
    format!("{mantissa}E{sign}{:02}", power.abs())
}

fn of_exponents() -> Vec<String> {
    (0..COUNT).map(whole).collect()
}

/// The samples of the first series, or what is said.
fn read(format: &str, values: &[String]) -> Result<Vec<f64>, String> {
    let text = file(format, values);
    let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
    match found {
        Ok(found) => Ok(found.series[0].samples.clone()),
        Err(e) => Err(format!("{e}; {}", e.help().unwrap_or_default())),
    }
}

/// The values with one at each place in another form, wherever it can have that form.
fn damaged(
    values: &[String],
    damage: impl Fn(&str) -> Option<String>,
) -> impl Iterator<Item = (String, Vec<String>)> {
    let places = [0, 1, values.len() / 2, values.len() - 1];
    places.into_iter().filter_map(move |place| {
        let mut values = values.to_vec();
        let damaged = damage(&values[place])?;
        values[place].clone_from(&damaged);
        Some((damaged, values))
    })
}

/// Values that are odd and right at the start: forms of zero, and a decimal more in the middle.
fn odd_beside(values: &[String]) -> Vec<Vec<String>> {
    let mut all = vec![values.to_vec()];
    for zero in ["0", "0.0", ".0", "0.", "0.0000000E+00", "0.00", "-0.0"] {
        let zero = vec![zero.to_owned()];
        all.push([zero.clone(), values.to_vec()].concat());
        all.push([vec![zero[0].clone(); 30], values.to_vec()].concat());
    }
    let mut surplus = values.to_vec();
    let place = surplus.len() / 3;
    let (end, rest) = match surplus[place].find('E') {
        Some(end) => surplus[place].split_at(end),
        None => (surplus[place].as_str(), ""),
    };
    surplus[place] = format!("{end}0{rest}");
    all.push(surplus);
    all
}

/// Every damage at every place of a file in every format is refused, at its value.
fn refuses(values: &[String], damage: impl Fn(&str) -> Option<String> + Copy, told: &str) {
    for format in FORMATS {
        for beside in odd_beside(values) {
            let right = read(format, &beside).unwrap();
            assert_eq!(right.len(), beside.len(), "{format}");
            let mut tried = 0;
            for (value, values) in damaged(&beside, damage) {
                let said = read(format, &values).unwrap_err();
                let is_right = said.contains(&format!("\"{value}\"")) && said.contains(told);
                assert!(is_right, "{format}, {value}: {said}");
                let row = file(format, &values)
                    .lines()
                    .position(|row| row.split([' ', ',', '\t']).any(|field| field == value));
                let place = format!("f:{}:", row.unwrap() + 1);
                assert!(said.starts_with(&place), "{format}, {value}: {said}");
                tried += 1;
            }
            assert!(tried > 1, "{format}");
        }
    }
}

/// As many bits as the numbers have.
fn reads(values: &[String]) {
    for format in FORMATS {
        let found = read(format, values).unwrap_or_else(|e| panic!("{format}: {e}"));
        assert_eq!(found.len(), values.len(), "{format}");
        let text: f64 = values[values.len() / 2].parse().unwrap();
        let ratio = found[values.len() / 2] / text;
        for (found, value) in found.iter().zip(values) {
            let value: f64 = value.parse().unwrap();
            assert!((found - ratio * value).abs() <= 1e-12 * found.abs());
        }
    }
}

/// Nonzero values alone: a damaged zero is a zero.
fn of_value(text: &str) -> Option<&str> {
    text.bytes()
        .any(|b| (b'1'..=b'9').contains(&b))
        .then_some(text)
}

#[test]
fn last_digits_of_exponents_that_are_lost() {
    refuses(
        &of_exponents(),
        |text| {
            let text = of_value(text)?;
            text.ends_with(|c: char| c.is_ascii_digit())
                .then(|| text[..text.len() - 1].to_owned())
        },
        "lacks a digit or the sign of its exponent",
    );
    // As Fortran prints them, with a zero before the point.
    let of_fortran = |i: usize| {
        let x = sample(i);
        let power = x.abs().log10().floor() as i32 + 1;
        format!("{:.7}E-{:02}", x / 10.0_f64.powi(power), power.abs())
    };
    let values: Vec<String> = (0..COUNT).map(of_fortran).collect();
    refuses(
        &values,
        |text| Some(of_value(text)?.replace("E-0", "E-")),
        "lacks a digit or the sign of its exponent",
    );
}

#[test]
fn exponents_that_are_lost() {
    refuses(
        &of_exponents(),
        |text| Some(of_value(text)?.split_once('E')?.0.to_owned()),
        "has no exponent",
    );
}

#[test]
fn decimals_before_an_exponent_that_are_lost() {
    refuses(
        &of_exponents(),
        |text| {
            let (mantissa, exponent) = of_value(text)?.split_once('E')?;
            Some(format!("{}E{exponent}", &mantissa[..mantissa.len() - 1]))
        },
        "lacks a digit: the other values have 7 decimals",
    );
}

/// Signs of exponents that are lost, where the others have them.
#[test]
fn signs_of_exponents_that_are_lost() {
    refuses(
        &of_exponents(),
        |text| Some(of_value(text)?.replace("E-", "E")),
        "lacks a digit or the sign of its exponent",
    );
}

/// Writers whose exponents are as short as they can be, that print values about 1 without one, or no plus.
#[test]
fn exponents_of_other_writers() {
    let shortest = |i: usize| format!("{:e}", sample(i));
    reads(&(0..COUNT).map(shortest).collect::<Vec<_>>());
    // Most exponents have two digits, and a few have one.
    let tiny = |i: usize| format!("{:e}", 2.005e-8 * sample(i));
    let values: Vec<String> = (0..COUNT).map(tiny).collect();
    let of_one_digit = values.iter().filter(|text| text.ends_with("e-9"));
    assert!((1..COUNT).contains(&of_one_digit.count()));
    reads(&values);
    let general = |i: usize| match 20.0 * sample(i) {
        x if x.abs() >= 0.1 => format!("{x:.7}"),
        x => of_c(x),
    };
    reads(&(0..COUNT).map(general).collect::<Vec<_>>());
    let without_plus = |i: usize| of_c(20.0 * sample(i)).replace('+', "");
    reads(&(0..COUNT).map(without_plus).collect::<Vec<_>>());
    // Values below 1e-99 have three digits.
    let mut values = of_exponents();
    for (i, value) in values.iter_mut().take(8).enumerate() {
        *value = format!("1.2345678E-{}", 130 - 10 * i);
    }
    reads(&values);
}

/// Values with three decimals, which no writer that leaves out zeros prints.
fn of_three_decimals() -> Vec<String> {
    let value = |i: usize| 50.0 * f64::sin(0.07 * i as f64 + 0.1) + 0.1;
    (0..COUNT).map(|i| format!("{:.3}", value(i))).collect()
}

/// Values as `%.5g` prints them, and as MATLAB does: without zeros at the end, whole numbers without a point.
fn without_zeros(x: f64) -> String {
    let digits = 4 - x.abs().log10().floor() as i32;
    match digits {
        ..9 => {
            let text = format!("{x:.*}", digits.max(0) as usize);
            let cut = text.trim_end_matches('0').trim_end_matches('.');
            if text.contains('.') {
                cut.to_owned()
            } else {
                text
            }
        }
        _ => of_c(x).replace('E', "e"),
    }
}

fn of_five_digits() -> Vec<String> {
    let value = |i: usize| 40.0 * f64::sin(0.07 * i as f64 + 0.1) + 0.0123;
    (0..COUNT).map(|i| without_zeros(value(i))).collect()
}

#[test]
fn points_that_are_lost() {
    let lost = |text: &str| Some(of_value(text)?.replace('.', ""));
    let told = "has no decimal point, which the other values have";
    refuses(&of_three_decimals(), lost, told);
    // A file of 60 values.
    refuses(&of_three_decimals()[..60], lost, told);
    // Decimals differ, and a zero leads the digits.
    let small = |i: usize| without_zeros(0.04 * f64::sin(0.07 * i as f64 + 0.1));
    let values: Vec<String> = (0..COUNT).map(small).collect();
    refuses(&values, lost, told);
    // Or the number is far from its neighbours.
    let values = of_five_digits();
    refuses(&values, lost, told);
}

#[test]
fn exponents_that_are_not_of_the_value() {
    let told = "has an exponent, which the other values do not have";
    for values in [of_three_decimals(), of_five_digits()] {
        for exponent in ["E3", "E+03", "e2", "D02"] {
            refuses(
                &values,
                |text| Some(of_value(text)?.to_owned() + exponent),
                told,
            );
        }
    }
    for exponent in ["E-3", "E-10"] {
        let stray = |text: &str| Some(of_value(text)?.to_owned() + exponent);
        refuses(&of_three_decimals(), stray, told);
    }
}

/// What is wrong is told with what to write if it is right.
#[test]
fn remedies_of_values_that_may_be_right() {
    let mut values = of_three_decimals();
    values[224] = "1498".to_owned();
    let said = read("plain_columns", &values).unwrap_err();
    assert!(
        said.contains("\"1498\"") && said.ends_with("write it as the others, 1498.000"),
        "{said}"
    );
    values[224] = "1498.000".to_owned();
    reads(&values);
}

/// Writers without a fixed form.
#[test]
fn values_of_other_writers_without_exponents() {
    // Zeros at the end that are left out, whole numbers that follow their neighbours, and small values.
    let values = of_five_digits();
    reads(&values);
    let mut whole = values.clone();
    whole[21] = "40".to_owned();
    whole[150] = without_zeros(values[150].parse::<f64>().unwrap().round());
    reads(&whole);
    for text in ["1.2e-05", "-3.4567e-06", "0.00123"] {
        let mut small = values.clone();
        small[5] = text.to_owned();
        reads(&small);
    }
    // Whole numbers alone, of which a few are in exponents as they are large, and halves between them.
    let counts = |i: usize| (9e5 * f64::sin(0.07 * i as f64 + 0.1)).round();
    reads(
        &(0..COUNT)
            .map(|i| format!("{}", counts(i)))
            .collect::<Vec<_>>(),
    );
    let mut values: Vec<String> = (0..COUNT).map(|i| format!("{}", counts(i))).collect();
    values[21] = "1.0001e+06".to_owned();
    values[300] = "1.2345000e+02".to_owned();
    reads(&values);
    // Steps of a half and of a quarter.
    for step in [0.5, 0.25] {
        let value = |i: usize| step * (40.0 * f64::sin(0.07 * i as f64 + 0.1)).round();
        reads(
            &(0..COUNT)
                .map(|i| format!("{}", value(i)))
                .collect::<Vec<_>>(),
        );
    }
    // As short as they can be.
    reads(
        &(0..COUNT)
            .map(|i| format!("{}", sample(i)))
            .collect::<Vec<_>>(),
    );
}

/// A decimal that is lost, anywhere behind the point, and a point that moved by a place.
#[test]
fn decimals_that_are_lost() {
    let told = "lacks a digit: the other values have 3 decimals";
    let values = of_three_decimals();
    for from_end in 1..=3 {
        let lost = |text: &str| {
            let mut text = of_value(text)?.to_owned();
            text.remove(text.len() - from_end);
            Some(text)
        };
        refuses(&values, lost, told);
    }
    let moved = |text: &str| {
        let (whole, decimals) = of_value(text)?.split_once('.')?;
        Some(format!("{whole}{}.{}", &decimals[..1], &decimals[1..]))
    };
    refuses(&values, moved, told);
    let cut = |text: &str| Some(of_value(text)?.split_once('.')?.0.to_owned() + ".");
    refuses(&values, cut, told);
}

/// Writers that leave out zeros at the end have more than a few values with fewer decimals.
#[test]
fn decimals_of_other_writers() {
    let values = of_three_decimals();
    let trimmed = |text: &String| text.trim_end_matches('0').trim_end_matches('.').to_owned();
    reads(&values.iter().map(trimmed).collect::<Vec<_>>());
    // Too few values to tell.
    let mut few = values[..150].to_vec();
    few[70].pop();
    reads(&few);
    // A zero more is no change; another digit more may have come in anywhere.
    let mut more = values.clone();
    more[70] += "0";
    reads(&more);
    let mut more = values.clone();
    more[70] += "4";
    for format in FORMATS {
        let said = read(format, &more).unwrap_err();
        let told = "has 4 decimals, but the other values have 3";
        assert!(said.contains(told), "{format}: {said}");
    }
    // In a column of fixed width the larger values have fewer.
    let of_width = |text: &String| text[..text.len().min(5)].to_owned();
    reads(&values.iter().map(of_width).collect::<Vec<_>>());
}

#[test]
fn digits_of_exponents_too_many() {
    let told = "has a digit more in its exponent than the other values";
    for surplus in ["0", "2"] {
        refuses(
            &of_exponents(),
            |text| Some(of_value(text)?.to_owned() + surplus),
            told,
        );
        refuses(
            &of_exponents(),
            |text| Some(of_value(text)?.replace("E-", &format!("E-{surplus}"))),
            told,
        );
    }
    // Exponents of three digits throughout.
    let of_three: Vec<String> = of_exponents()
        .iter()
        .map(|v| v.replace('-', "-0"))
        .collect();
    let of_three: Vec<String> = of_three
        .iter()
        .map(|v| {
            v.strip_prefix("-0")
                .map_or(v.clone(), |rest| format!("-{rest}"))
        })
        .collect();
    reads(&of_three);
    refuses(
        &of_three,
        |text| Some(of_value(text)?.replace("E-0", "E-")),
        "lacks a digit or the sign of its exponent",
    );
}

#[test]
fn points_of_mantissas_that_are_lost() {
    let told = "has no decimal point, which the other values have";
    let lost = |text: &str| Some(of_value(text)?.replace('.', ""));
    refuses(&of_exponents(), lost, told);
    // As short as they can be, where a mantissa of one digit has none.
    let mut values: Vec<String> = (0..COUNT).map(|i| format!("{:e}", sample(i))).collect();
    values[7] = "2e-2".to_owned();
    reads(&values);
    values[9] = values[9].replace('.', "");
    let said = read("plain_columns", &values).unwrap_err();
    assert!(said.contains(told), "{said}");
}

/// Components in fixed columns, whose layout gives decimals to numbers without a point.
#[test]
fn decimals_in_columns_that_are_lost() {
    let values = of_three_decimals();
    let cwa = |values: &[String]| {
        let row = |i: usize, v: &str| format!("{:10.3}{v:>10}{v:>10}{v:>10}", 0.01 * i as f64);
        format!(
            "#Earthquake Information\n#StationCode: HWA014\n#StartTime: 2018/02/06-23:50:39.000\n#RecordLength(sec): {:.2}\n#SampleRate(Hz): 100\n#AmplitudeUnit:  gal. DCoffset(corr)\n#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n{}",
            0.01 * values.len() as f64,
            pairs(values, row)
        )
    };
    let asa = |values: &[String]| {
        let list = |entry: &str| format!("/{entry}/{entry}");
        format!(
            "ARCHIVO ESTANDAR DE ACELERACION:\nVERSION DEL FORMATO                    : 2.0\nNUMERO DE CANALES                      : 2\nORIENTACION C1-C6 (rumbo;orientacion)  : /V/N90E\nINTERVALO DE MUESTREO, C1-C6 (s)       : {}\nNUM. TOTAL DE MUESTRAS, C1-C6          : {}\nUNIDADES DE LOS DATOS                  : Gal (cm/s/s)\nFACTOR DE DECIMACION                   : 1\nFORMATO DATOS (FORTRAN,10 campos/dato) : 2F10.3\n\nDATOS DE ACELERACION:\n{}\n   CANAL-1   CANAL-2\n         V      N90E\n{}\n{}",
            list("0.01"),
            list(&values.len().to_string()),
            "---------+".repeat(2),
            "---------+".repeat(2),
            pairs(values, |_, v| format!("{:>10}{v:>10}", "1.234"))
        )
    };
    for file in [&cwa as &dyn Fn(&[String]) -> String, &asa] {
        let read = |values: &[String]| {
            let text = file(values);
            let found = read_all_bytes("f", text.as_bytes(), &ReadOptions::default());
            found.map_err(|e| e.to_string())
        };
        let whole = read(&values).unwrap();
        assert_eq!(whole.series[1].samples.len(), COUNT);
        let moved = |text: &str| {
            let (whole, decimals) = text.split_once('.')?;
            Some(format!("{whole}{}.{}", &decimals[..1], &decimals[1..]))
        };
        for (value, values) in damaged(&values, moved) {
            let said = read(&values).unwrap_err();
            assert!(
                said.contains(&format!("\"{value}\" lacks a digit")),
                "{said}"
            );
        }
        // The layout gives as many decimals to some of these, but to a value that lost a digit for its point too.
        for (value, values) in damaged(&values, |text| Some(text.replace('.', ""))) {
            let said = read(&values).unwrap_err();
            assert!(
                said.contains(&format!("\"{value}\" has no decimal point")),
                "{said}"
            );
        }
    }
}

/// Numbers about zero, of which most are small, the same ones each time.
fn noise(count: usize) -> impl Iterator<Item = f64> {
    let mut state = 12_345_u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005);
        state = state.wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..count).map(move |_| (0..6).map(|_| uniform()).sum())
}

/// A number as `%g` and the like print it with so many significant digits, or in decimals.
fn trimmed(x: f64, digits: i32) -> String {
    let decimals = digits - 1 - x.abs().log10().floor() as i32;
    let text = format!("{x:.*}", decimals.max(0) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

fn in_decimals(x: f64) -> String {
    let text = format!("{x:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Large values of `%.5g`, `%g` and `%.3g` in much smaller ones are whole as they have all digits.
#[test]
fn whole_numbers_with_all_digits() {
    for (digits, peak, quiet) in [(3, 300.0, 0.3), (5, 60_000.0, 30.0), (6, 400_000.0, 80.0)] {
        let value = |(i, x): (usize, f64)| {
            let late = i.saturating_sub(2000) as f64;
            let burst = late / 8.0 * f64::exp(1.0 - late / 8.0) * f64::sin(0.9 * late);
            trimmed(peak * burst + quiet * x + 0.01, digits)
        };
        let values: Vec<String> = noise(6000).enumerate().map(value).collect();
        let whole = values.iter().filter(|text| !text.contains('.')).count();
        assert!((10..60).contains(&whole), "{whole}");
        reads(&values);
    }
}

/// Pulses and impulses that are whole, by writers that leave out zeros at the end.
#[test]
fn whole_numbers_of_pulses() {
    let half = vec!["0.5".to_owned(); 300];
    reads(&[half.clone(), vec!["1".to_owned()], half].concat());
    for count in [60, 150, 250, 1000] {
        for text in ["1", "30", "800"] {
            let mut values: Vec<String> = noise(count).map(|x| trimmed(0.01 * x, 6)).collect();
            values[count / 2] = text.to_owned();
            reads(&values);
            let mut values: Vec<String> = noise(count).map(|x| in_decimals(0.01 * x)).collect();
            values[count / 2] = text.to_owned();
            values.push("0.25".to_owned());
            reads(&values);
        }
    }
    // Two large ones beside one another, with all digits.
    let mut values: Vec<String> = noise(250).map(|x| trimmed(8.0 * x, 4)).collect();
    (values[100], values[101]) = ("1452".to_owned(), "-649".to_owned());
    reads(&values);
    // Whole numbers that a lost point may have made.
    let mut values: Vec<String> = noise(1000).map(|x| trimmed(x, 6)).collect();
    values[500] = "1498".to_owned();
    let said = read("plain_columns", &values).unwrap_err();
    assert!(said.contains("\"1498\" has no decimal point"), "{said}");
}

/// Quiet ground in few units of the last decimal has no zeros that could be left out.
#[test]
fn decimals_of_quiet_ground() {
    for (unit, loud) in [(0.001, "369.56"), (0.002, "-12.4")] {
        let value = |x: f64| in_decimals((1.5 * x).round() * unit);
        let mut values: Vec<String> = noise(1000).map(value).collect();
        values[500] = loud.to_owned();
        reads(&values);
    }
    // A burst of 60 values, of which a tenth has fewer decimals, in 5,900 of some units.
    let value = |(i, x): (usize, f64)| {
        let burst = if (3000..3060).contains(&i) { 20.0 } else { 0.0 };
        in_decimals(0.002 * x + burst * f64::sin(0.3 * i as f64))
    };
    let values: Vec<String> = noise(5900).enumerate().map(value).collect();
    let has_fewer = |text: &&String| {
        text.split_once('.')
            .is_some_and(|(_, decimals)| decimals.len() < 3)
    };
    let fewer = values.iter().filter(has_fewer).count();
    assert!((2..7).contains(&fewer), "{fewer}");
    reads(&values);
    // With zeros at the end one with fewer decimals is damaged as before.
    let mut values: Vec<String> = noise(1000).map(|x| format!("{:.3}", 0.02 * x)).collect();
    values[500] = "0.03".to_owned();
    let said = read("plain_columns", &values).unwrap_err();
    assert!(said.contains("\"0.03\" lacks a digit"), "{said}");
}

/// Numbers of as many digits, or as many characters, have a decimal less from 10 on.
#[test]
fn decimals_of_constant_digits() {
    let value = |i: usize| 5.4 + 4.4 * f64::sin(0.07 * i as f64);
    for (usual, fewer, large) in [(8, 7, 10.005_382_9), (5, 4, 10.5), (6, 5, 10.5)] {
        let mut values: Vec<String> = (0..COUNT)
            .map(|i| format!("{:.usual$}", value(i)))
            .collect();
        values[23] = format!("{large:.fewer$}");
        reads(&values);
        // Not with fewer digits, or where it is much larger than the others.
        for odd in [&values[23][1..], &values[23].replace("10.", "70.")] {
            let mut values = values.clone();
            values[23] = odd.to_owned();
            let said = read("plain_columns", &values).unwrap_err();
            assert!(said.contains(&format!("\"{odd}\" lacks a digit")), "{said}");
        }
    }
}

/// A point that moved by a place in a small number, which is less than twice the largest of the others.
#[test]
fn points_of_small_numbers_that_moved() {
    let value = |i: usize| format!("{:.5}", 0.9 * f64::sin(0.07 * i as f64 + 0.1));
    let mut values: Vec<String> = (0..COUNT).map(value).collect();
    values[95] = "01.4311".to_owned();
    let said = read("pounding_csv", &values).unwrap_err();
    assert!(said.contains("\"01.4311\" lacks a digit"), "{said}");
}

/// Exponents of two digits without a zero do not tell whether one of a single digit is right, but its size does.
#[test]
fn exponents_without_zeros_that_are_lost() {
    let value = |i: usize| {
        let x = 4.0 * f64::sin(0.07 * i as f64 + 0.1);
        format!("{:.6}E-10", x + 1.1_f64.copysign(x))
    };
    let values: Vec<String> = (0..COUNT).map(value).collect();
    reads(&values);
    let told = "lacks a digit or the sign of its exponent";
    refuses(
        &values,
        |text| Some(of_value(text)?.replace("E-10", "E-1")),
        told,
    );
    refuses(
        &values,
        |text| Some(of_value(text)?.replace("E-10", "E10")),
        told,
    );
    // One that is about as large as the others.
    let mut values = values;
    values[200] = "1.000001E-9".to_owned();
    reads(&values);
}

/// List-directed output of gfortran has exponents below a tenth alone, and nine digits.
#[test]
fn values_of_list_directed_output() {
    let mut values: Vec<String> = (0..COUNT).map(|i| of_c(1.9 * sample(i))).collect();
    for value in &mut values {
        let (mantissa, exponent) = value.split_once('E').unwrap();
        *value = format!("{mantissa}7E{exponent}");
    }
    values[21] = "0.100037411".to_owned();
    reads(&values);
    values[22] = "-0.100437462".to_owned();
    reads(&values);
    // Beside them the mantissa of another is none.
    values[22] = values[23].split_once('E').unwrap().0.to_owned();
    let said = read("plain_columns", &values).unwrap_err();
    assert!(
        said.contains(&format!("\"{}\" has no exponent", values[22])),
        "{said}"
    );
}

/// As list-directed output of Intel Fortran prints: exponents below a tenth, and eight digits with them.
fn of_intel(x: f64) -> String {
    match x.abs() {
        x_abs if x_abs < 0.1 => of_c(x),
        x_abs if x_abs < 1.0 => format!("{x:.7}"),
        _ => format!("{x:.6}"),
    }
}

/// However many values have an exponent.
#[test]
fn values_of_list_directed_output_of_intel() {
    for largest in [0.1003, 0.102, 0.11, 0.13, 0.2, 0.4, 0.9, 1.1, 6.0] {
        let values: Vec<String> = (0..COUNT)
            .map(|i| of_intel(largest / 0.05 * (sample(i) - 1.234_567_8e-4)))
            .collect();
        reads(&values);
    }
    // A few small values among large ones, and a few larger ones.
    let values = |few: &dyn Fn(usize) -> bool, small: f64, large: f64| -> Vec<String> {
        let value =
            |i: usize| if few(i) { small } else { large } * (1.0 + 0.3 * f64::sin(i as f64));
        (0..COUNT).map(|i| of_intel(value(i))).collect()
    };
    reads(&values(&|i| i == 200, 0.03, 0.4));
    reads(&values(&|i| i != 200, 0.03, 0.4));
    // A mantissa that lost its exponent is no such value.
    let mut damaged: Vec<String> = (0..COUNT).map(|i| of_intel(1.9 * sample(i))).collect();
    let place = damaged
        .iter()
        .position(|value| value.ends_with("E-02"))
        .unwrap();
    damaged[place] = damaged[place].replace("E-02", "");
    let said = read("plain_columns", &damaged).unwrap_err();
    assert!(
        said.contains(&damaged[place]) && said.contains("has no exponent"),
        "{said}"
    );
}

/// A value whose exponent makes it zero, which it is not, is refused, also among values without exponents.
#[test]
fn values_that_become_zero() {
    let told = "is not zero";
    refuses(
        &of_exponents(),
        |value| Some(value.replace("E-0", "E-40")).filter(|small| small != value),
        told,
    );
    let fixed: Vec<String> = (0..COUNT).map(|i| format!("{:.6}", sample(i))).collect();
    let tiny = |value: &str| {
        let is_other = value.bytes().any(|b| (b'1'..=b'9').contains(&b));
        (is_other && value.contains('.')).then(|| format!("{value}-959"))
    };
    refuses(&fixed, tiny, told);
}

/// A stray zero before the digits of a value, and one that lacks the digit before its point, are refused among values
/// that have one digit there; where all have more zeros, or none, they are read.
#[test]
fn digits_before_the_point_that_are_odd() {
    let fixed: Vec<String> = (0..COUNT).map(|i| format!("{:.6}", sample(i))).collect();
    let with_zero = |value: &str| {
        let (before, behind) = value.split_once("0.")?;
        (behind.len() == 6).then(|| format!("{before}01.{behind}"))
    };
    refuses(&fixed, with_zero, "has a zero before its digits");
    let bare = |value: &str| {
        let (before, behind) = value.split_once("0.")?;
        (behind.len() == 6).then(|| format!("{before}.{behind}"))
    };
    refuses(&fixed, bare, "has no digit before its point");
    let exponents = of_exponents();
    let led = |value: &str| {
        let (before, behind) = value.split_once('.')?;
        let digits = before.trim_start_matches('-');
        let sign = &before[..before.len() - digits.len()];
        value
            .contains('E')
            .then(|| format!("{sign}0{digits}.{behind}"))
    };
    for format in ["peer_at2", "dyna", "plain_columns"] {
        for (_, values) in damaged(&exponents, led) {
            let said = read(format, &values).unwrap_err();
            assert!(said.contains("has a zero before its digits"), "{said}");
        }
        // Writers of other forms.
        for print in [
            |x: f64| format!("{:+09.5}", 20.0 * x),
            |x: f64| format!("{:08.4}", 300.0 * x),
            |x: f64| format!("{x:.6}").replacen("0.", ".", 1),
            |x: f64| {
                let plain = format!("{x:.6}");
                if x < 0.0 {
                    plain.replacen("0.", ".", 1)
                } else {
                    plain
                }
            },
        ] {
            let values: Vec<String> = (0..COUNT).map(|i| print(sample(i))).collect();
            assert_eq!(read(format, &values).unwrap().len(), COUNT, "{}", values[0]);
        }
    }
}
