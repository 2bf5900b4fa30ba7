//! Raw records as their agencies print them: USC and SMC in their other layouts, COSMOS V0, BHRC,
//! the network of Turkey, and ASA with the lines of channels that are not there.

use pounding_ground_motion::Quantity;

use super::volumes::{fixture, one_digit_exponents, pairs, volume_1_text};
use super::*;

const ACC: Quantity = Quantity::Acceleration;

/// Three components with a blank column before the numbers, no line between them; and one with
/// integers of four columns and four pairs a line.
pub fn usc(written: i64) -> Vec<Fixture> {
    let units = "UNITS ARE SEC AND G/10                                                  22";
    let mut three = String::new();
    let mut found = Vec::new();
    for (k, (name, component)) in [("N90E", "N90E"), ("  UP", "UP"), ("S 58 W", "S58W")]
        .into_iter()
        .enumerate()
    {
        let (data, times, values) = pairs(&signal(-9.0, 0.4 * k as f64), 7, 3);
        three.push_str(&volume_1_text(
            &format!(
                "FILE     {k} OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:                  VOL1"
            ),
            &format!("COMP {name:<67}9 VOL1"),
            written,
            units,
        ));
        three.push_str(&integers(100, 16, 5, 0, &[(27, 90), (28, written)]));
        three.push_str(&reals(50, 8, 10, 3, 0.0, &[(3, 0.11), (5, 0.1)]));
        for line in data.lines() {
            three.push_str(&format!(" {line}\n"));
        }
        let mut series = truth(ACC, component, &values, 0.1 * G, 0.0);
        series.times = Some(times);
        found.push(series);
    }
    let mut narrow = volume_1_text(
        "FILE     1 OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I:",
        "COMP N11E                                                               9",
        written,
        units,
    );
    narrow.push_str(&integers(100, 20, 4, 0, &[(27, 11), (28, written)]));
    narrow.push_str(&reals(50, 8, 10, 3, 0.0, &[(3, 0.11), (5, 0.1)]));
    let (_, times, values) = pairs(&signal(-9.0, 1.1), 7, 3);
    let flat: Vec<f64> = times
        .iter()
        .zip(&values)
        .flat_map(|(t, a)| [*t, *a])
        .collect();
    narrow.push_str(&block(&flat, 8, 8, 3).0);
    let mut series = truth(ACC, "N11E", &values, 0.1 * G, 0.0);
    series.times = Some(times);
    vec![
        fixture("usc_three", "caltech_volume_1", three, found),
        fixture("usc_narrow", "caltech_volume_1", narrow, vec![series]),
    ]
}

/// An uncorrected accelerogram with a rate: even steps. And film whose times have too few digits.
pub fn smc_raw(written: i64) -> Vec<Fixture> {
    let header = |numbers: i64, rate: f64, most: Option<(f64, f64)>| {
        let peak = most.map_or(String::new(), |(_, value)| format!("{:.3E}", value.abs()));
        let mut text = format!(
            "1 UNCORRECTED ACCELEROGRAM\n*\n0000\n     2018   5   4    2232 Made up\nMoment Mag= 6.9      Ms=          Ml=\nstation = HI:HI;Nowhere, FS              component= 90\nepicentral dist =     97.9       pk mot = {peak}\ninst type=ETNA-      data source = USGS\n*\n*\n*\n",
        );
        text.push_str(&integers(
            48,
            8,
            10,
            -32_768,
            &[
                (1, -32_768),
                (2, 2018),
                (3, 124),
                (4, 22),
                (5, 32),
                (6, 18),
                (7, 5),
                (13, 90),
                (14, 90),
                (16, 2),
                (17, numbers),
            ],
        ));
        let mut reals = vec![1.7e38; 50];
        reals[1] = rate;
        // Of the maximum and of the minimum.
        if let Some((time, value)) = most {
            let at = if value < 0.0 { 30 } else { 28 };
            reals[at] = time;
            reals[at + 1] = value;
        }
        for row in reals.chunks(5) {
            for value in row {
                let plain = format!("{value:.7e}");
                let (mantissa, exponent) = plain.split_once('e').unwrap();
                text.push_str(&format!(
                    "{:>15}",
                    format!("{mantissa}E{:+03}", exponent.parse::<i32>().unwrap())
                ));
            }
            text.push('\n');
        }
        text.push_str("| a comment\n| Digital counts re-scaled\n");
        text
    };
    // An offset beside which the motion is small: nothing in it looks like a time.
    let values: Vec<f64> = signal(2.0, 0.2).iter().map(|a| a - 16.4).collect();
    let (data, printed) = one_digit_exponents(&values);
    let most = peak(&printed);
    let even = header(written, 200.0, Some((most.1 as f64 * 0.005, most.0))) + &data;
    let steps = truth(ACC, "90", &printed, 0.01, 0.005);

    let values = signal(-220.0, 0.3);
    let times: Vec<f64> = (0..COUNT).map(|i| 20.0 + 0.0012 * i as f64).collect();
    let flat: Vec<f64> = times
        .iter()
        .zip(&values)
        .flat_map(|(t, a)| [*t, *a])
        .collect();
    let (data, printed) = one_digit_exponents(&flat);
    let samples: Vec<f64> = printed.iter().skip(1).step_by(2).copied().collect();
    let film = header(2 * written, 1.7e38, None) + &data;
    let mut uneven = truth(ACC, "90", &samples, 0.01, 0.0);
    uneven.times = Some(printed.iter().step_by(2).copied().collect());
    vec![
        fixture("smc_raw", "usgs_smc", even, vec![steps]),
        fixture("smc_film", "usgs_smc", film, vec![uneven]),
    ]
}

/// Raw counts and millivolts, in two channels: 0.298 microvolts a count, 1.25 V/g, gain 2; and a
/// sensor of velocity, 0.04 V per cm/s.
pub fn cosmos_raw(written: i64) -> Vec<Fixture> {
    let mut text = String::new();
    let mut found = Vec::new();
    for (k, (unit, layout, quantity)) in [
        ("counts(50)", "1I8", ACC),
        ("counts(50)", "8I10", Quantity::Velocity),
        ("mV(52)", "8F10.5", ACC),
    ]
    .into_iter()
    .enumerate()
    {
        let counts = unit.starts_with("counts");
        let size = if counts { 1.0e6 } else { 500.0 };
        let values: Vec<f64> = signal(size, 0.5 * k as f64)
            .iter()
            .map(|a| a - 0.2 * size)
            .collect();
        let (data, printed) = if layout == "1I8" {
            let rounded: Vec<f64> = values.iter().map(|a| a.round()).collect();
            (
                rounded.iter().map(|a| format!("{a:>8}\n")).collect(),
                rounded,
            )
        } else if counts {
            let rounded: Vec<f64> = values.iter().map(|a| a.round()).collect();
            let rows = rounded
                .chunks(8)
                .map(|row| row.iter().map(|a| format!("{a:>10}")).collect::<String>() + "\n");
            (rows.collect::<String>(), rounded)
        } else {
            block(&values, 8, 10, 5)
        };
        let most = peak(&printed);
        let velocity = quantity == Quantity::Velocity;
        let sensitivity = if velocity { 0.04 } else { 1.25 };
        text.push_str(&format!(
            "Raw {:<22}(Format v01.20 with 13 text lines)\n",
            format!("{} counts", quantity.name())
        ));
        for line in 2..13 {
            text.push_str(&format!("Text line {line}\n"));
        }
        text.push_str("Values used when parameter or data value is unknown/unspecified:   -999, -999.00\n 100 Integer-header values follow on  10 lines, Format= (10I8)\n");
        text.push_str(&integers(
            100,
            10,
            8,
            -999,
            &[
                (1, 0),
                (2, if velocity { 2 } else { 1 }),
                (3, if counts { 50 } else { 52 }),
                (54, 90 + k as i64),
            ],
        ));
        text.push_str(" 100 Real-header values follow on  20 lines, Format= (5F15.6)\n");
        text.push_str(&reals(
            100,
            5,
            15,
            6,
            -999.0,
            &[
                (22, 0.298),
                (34, 0.005),
                (35, 0.115),
                (42, sensitivity),
                (47, 2.0),
                (62, 5.0),
                (63, 0.115),
                (64, most.0),
                (65, most.1 as f64 * 0.005),
            ],
        ));
        let what = if velocity {
            "raw veloc. "
        } else {
            "raw accel. "
        };
        text.push_str(&format!(
            "   1 Comment line(s) follow, each starting with a \"|\":\n| nothing\n{written:>8} {what} pts, approx  0 secs, units= {unit},Format=({layout})\n{data}End-of-data for Chan 1\n"
        ));
        let volts = if counts { 0.298e-6 } else { 1.0e-3 };
        let each = volts / sensitivity / 2.0 * if velocity { 0.01 } else { G };
        found.push(truth(
            quantity,
            &format!("{} deg", 90 + k),
            &printed,
            each,
            0.005,
        ));
    }
    vec![fixture("cosmos_raw", "cosmos", text, found)]
}

/// Fortran's E13.6 with the digits behind the point and no zero before it: ` -.559989E-03`.
fn e13(value: f64) -> (String, f64) {
    let exponent = if value == 0.0 {
        0
    } else {
        value.abs().log10().floor() as i32 + 1
    };
    let mut digits = (value.abs() / 10.0_f64.powi(exponent) * 1.0e6).round() as i64;
    let mut exponent = exponent;
    if digits == 1_000_000 {
        digits = 100_000;
        exponent += 1;
    }
    let sign = if value < 0.0 { "-" } else { "" };
    let field = format!("{sign}.{digits:06}E{exponent:+03}");
    let printed = field.replace("-.", "-0.").parse().unwrap();
    (format!("{field:>13}"), printed)
}

/// Three channels; header lines cut at 72 columns, as they are.
pub fn bhrc(written: i64) -> Vec<Fixture> {
    let cut = |text: &str| -> String {
        text.lines()
            .map(|l| format!("{}\n", l.get(..72).unwrap_or(l)))
            .collect()
    };
    let mut text = String::new();
    let mut found = Vec::new();
    for (k, letter) in ["L", "V", "T"].into_iter().enumerate() {
        text.push_str(&format!(
            "* VOL1DS FILE:  0000/01\nInst Type = SSA-2\nOrigin Time : 2000/01/01   00:00:00\n\n{letter}\n\nCOMP {letter}{}\nNowhere                   Station   37.734 N 47.801 E   Altitude 2026m   Azimuth L 50    T 140\nEpicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (BHRC   )\nINSTR PERIOD =  .020 SEC   DAMPING =  .640\nNO. OF POINTS = {written:>6}      DURATION =    .115\nUNITS ARE SECONDS AND G/10\n\n",
            k + 1
        ));
        text.push_str(&cut(&integers(100, 16, 5, 0, &[(28, written)])));
        let mut reals = vec![0.0; 50];
        (reals[0], reals[1], reals[2], reals[4], reals[8]) = (0.02, 0.64, 0.115, 0.1, 200.0);
        let rows: String = reals
            .chunks(8)
            .map(|row| row.iter().map(|v| e13(*v).0).collect::<String>() + "\n")
            .collect();
        text.push_str(&cut(&rows));
        let mut printed = Vec::new();
        for row in signal(0.6, 0.7 * k as f64).chunks(10) {
            for value in row {
                let (field, value) = e13(*value);
                text.push_str(&field);
                printed.push(value);
            }
            text.push('\n');
        }
        text.push_str("/&\n");
        let name = ["L 50 deg", "V", "T 140 deg"][k];
        found.push(truth(ACC, name, &printed, 0.1 * G, 0.005));
    }
    vec![fixture("bhrc", "bhrc", text, found)]
}

/// Three columns, with a letter of Latin-5 in the name of the place.
pub fn nsmn(written: i64) -> Vec<Fixture> {
    let columns: Vec<Vec<f64>> = [0.0, 0.8, 1.9].map(|p| signal(13.0, p)).into();
    let printed: Vec<Vec<f64>> = columns
        .iter()
        .map(|c| {
            c.iter()
                .map(|a| format!("{a:.6}").parse().unwrap())
                .collect()
        })
        .collect();
    // The peaks are printed without their sign.
    let peaks: Vec<String> = printed
        .iter()
        .map(|p| format!("{:.6}", peak(p).0.abs()))
        .collect();
    let mut text = format!(
        "STRONG GROUND MOTION RECORDS OF TURKIYE\nPLACE                   : HICBIRYER\nEARTHQUAKE DATE         : 2000/01/01 00:00:00 (GMT)\nEPICENTER COORDINATES   : 36.91980N-27.44350E\nEARTHQUAKE DEPTH (km)   : 19.44\nEARTHQUAKE MAGNITUDE    : 6.5 Mw\nSTATION ID              : 0000\nSTATION COORDINATES     : 37.87470N-27.59223E\nSTATION ALTITUDE (m)    :\nRECORDER TYPE           : none\nRECORDER SERIAL NO      : 0\nRECORD TIME             : 01/01/2000 00:00:00.000000 (GMT)\nNUMBER OF DATA          : {written}\nSAMPLING INTERVAL (sec) : 0.01\nRAW PGA VALUES (gal)    : (N-S) {} (E-W) {} (U-D) {}\nCopyright EARTHQUAKE DEPARTMENT\nDISASTER AND EMERGENCY MANAGEMENT PRESIDENCY\n       N-S          E-W          U-D\n",
        peaks[0], peaks[1], peaks[2]
    );
    for i in 0..COUNT {
        text.push_str(&format!(
            "{:>12.6}{:>15.6}{:>13.6}\n",
            printed[0][i], printed[1][i], printed[2][i]
        ));
    }
    let mut bytes = text.into_bytes();
    let at = bytes.windows(9).position(|w| w == b"HICBIRYER").unwrap();
    bytes[at + 1] = 0xdd;
    let truth = ["N-S", "E-W", "U-D"]
        .iter()
        .zip(&printed)
        .map(|(name, p)| truth(ACC, name, p, 0.01, 0.01))
        .collect();
    vec![Fixture {
        bytes,
        ..fixture("nsmn", "nsmn", String::new(), truth)
    }]
}

/// The form of UNAM with both lines of every key: three channels, of which the lines for the
/// seventh to the twelfth are blank; and eight channels, three of them in those lines.
pub fn asa(written: i64) -> Vec<Fixture> {
    let of = |names: &[&str]| {
        let count = names.len();
        let columns: Vec<(String, Vec<f64>)> = (0..count)
            .map(|k| block(&signal(-35.0, 0.3 * k as f64), 1, 10, 3))
            .collect();
        let list = |entry: &dyn Fn(usize) -> String, from: usize| -> String {
            (from..count.min(from + 6))
                .map(|k| format!("/{}", entry(k)))
                .collect()
        };
        let both = |key: &str, unit: &str, entry: &dyn Fn(usize) -> String| {
            format!(
                "{:<39}: {}                      \n{:<39}: {}\n",
                format!("{key}, C1-C6{unit}"),
                list(entry, 0),
                format!("{key}, C7-C12{unit}"),
                list(entry, 6)
            )
        };
        let mut text = format!(
            "{0}\n                       INSTITUTO DE INGENIERIA, UNAM\n{0}\nARCHIVO ESTANDAR DE ACELERACION:\nVERSION DEL FORMATO                    : 2.0\n\n{1}\nDATOS DE LA ESTACION:\nNOMBRE DE LA ESTACION                  : INVENTADA\nLOCALIZACION DE LA ESTACION            : CALLE\n                                       :\nNUMERO DE CANALES                      : {count}\n",
            "*".repeat(86),
            "=".repeat(80)
        );
        text.push_str(
            &both("ORIENTACION", " (rumbo;orientacion)", &|k| {
                names[k].to_owned()
            })
            .replace("ORIENTACION, C", "ORIENTACION C"),
        );
        text.push_str(&both("VEL. DE MUESTREO", " (muestras/s)", &|_| {
            "250".to_owned()
        }));
        text.push_str(&both("FREC. NAT. DE SENSORES", ", (Hz)", &|_| {
            " ".to_owned()
        }));
        text.push_str(&both("INTERVALO DE MUESTREO", " (s)", &|_| {
            "0.004".to_owned()
        }));
        text.push_str("HORA DE LA PRIMERA MUESTRA (GMT)       : 00:00:01    \n");
        text.push_str(&both("DURACION DEL REGISTRO (s)", "", &|_| {
            "0.092".to_owned()
        }));
        text.push_str(&both("NUM. TOTAL DE MUESTRAS", "", &|_| {
            written.to_string()
        }));
        let most = |k: usize| format!("{:.2}", peak(&columns[k].1).0);
        let at = |k: usize| peak(&columns[k].1).1.to_string();
        text.push_str(&format!(
            "ACEL. MAX.(Gal), C1-C6                 : {}\nACEL. MAX., C1-C6, EN LA MUESTRA       : {}\nACEL. MAX.(Gal), C7-C12                : {}\nACEL. MAX., C7-C12,EN LA MUESTRA       : {}\n",
            list(&most, 0),
            list(&at, 0),
            list(&most, 6),
            list(&at, 6)
        ));
        text.push_str(&format!(
            "UNIDADES DE LOS DATOS                  : Gal (cm/s/s)\nFACTOR DE DECIMACION                   : 1\nFORMATO DATOS (FORTRAN,10 campos/dato) : {count}F10.3\n\nCOMENTARIOS:\n\n{}\nDATOS DE ACELERACION:\n{}\n",
            "=".repeat(80),
            "---------+".repeat(8)
        ));
        for k in 1..=count {
            text.push_str(&format!("{:>10}", format!("CANAL-{k}")));
        }
        text.push('\n');
        for name in names {
            text.push_str(&format!("{name:>10}"));
        }
        text.push_str(&format!("\n{}\n", "---------+".repeat(8)));
        for i in 0..COUNT {
            for (column, _) in &columns {
                text.push_str(column.lines().nth(i).unwrap());
            }
            text.push('\n');
        }
        let truth = names
            .iter()
            .zip(&columns)
            .map(|(name, (_, p))| truth(ACC, name, p, 0.01, 0.004))
            .collect();
        fixture("asa_unam", "asa", text, truth)
    };
    vec![
        of(&["V", "N90E", "N00E"]),
        of(&[
            "V", "N90E", "N00E", "V-AZOTEA", "N90E-2", "N00E-2", "V-3", "N90E-3",
        ]),
    ]
}
