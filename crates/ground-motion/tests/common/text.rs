//! Free-form text formats.

use pounding_ground_motion::{AccelerationUnit, Quantity, ReadOptions};

use super::*;

const ACC: Quantity = Quantity::Acceleration;

fn fixture(
    name: &'static str,
    format: &'static str,
    text: String,
    truth: Vec<Truth>,
    counted: bool,
) -> Fixture {
    Fixture {
        name,
        format,
        bytes: text.into_bytes(),
        options: ReadOptions::default(),
        truth,
        counted,
    }
}

pub fn pounding_csv() -> Vec<Fixture> {
    let values = signal(3.0, 0.0);
    let mut text =
        "# Event: made up\n# Unit: m/s2\n# dt: 0.01 s\ntime_s,acceleration_m_s2\n".to_owned();
    for (i, a) in values.iter().enumerate() {
        text.push_str(&format!("{:.2},{a:?}\n", i as f64 * 0.01));
    }
    let truth = vec![truth(ACC, "", &values, 1.0, 0.01)];
    vec![fixture("pounding_csv", "pounding_csv", text, truth, false)]
}

/// Values as `E15.7`, some with Fortran's D or without the letter.
fn exponents(values: &[f64], per_line: usize) -> (String, Vec<f64>) {
    let mut text = String::new();
    let mut printed = Vec::new();
    for (i, value) in values.iter().enumerate() {
        let plain = format!("{value:.7e}");
        printed.push(plain.parse().unwrap());
        let (mantissa, exponent) = plain.split_once('e').unwrap();
        let exponent: i32 = exponent.parse().unwrap();
        let field = match i % 3 {
            0 => format!("{mantissa}E{exponent:+03}"),
            1 => format!("{mantissa}D{exponent:+03}"),
            _ => format!("{mantissa}{exponent:+04}"),
        };
        text.push_str(&format!("{field:>16}"));
        if (i + 1) % per_line == 0 || i + 1 == values.len() {
            text.push('\n');
        }
    }
    (text, printed)
}

pub fn peer(written: i64) -> Vec<Fixture> {
    let mut all = Vec::new();
    for (name, quantity, words, unit) in [
        ("at2", ACC, "ACCELERATION TIME SERIES IN UNITS OF G", G),
        (
            "vt2",
            Quantity::Velocity,
            "VELOCITY TIME SERIES IN UNITS OF CM/SEC",
            0.01,
        ),
        (
            "dt2",
            Quantity::Displacement,
            "DISPLACEMENT TIME SERIES IN UNITS OF CM",
            0.01,
        ),
    ] {
        let (data, printed) = exponents(&signal(0.3, 0.1), 5);
        let text = format!(
            "MADE UP DATABASE RECORD\nNOWHERE 01/01/00 00:00, STATION, 000\n{words}\nNPTS= {written:>6}, DT=   .0050 SEC,\n{data}"
        );
        let truth = vec![truth(quantity, "000", &printed, unit, 0.005)];
        all.push(fixture(name, "peer_at2", text, truth, true));
    }
    all
}

/// Values in six columns between tabs, and rows of time and value.
pub fn iris(written: i64) -> Vec<Fixture> {
    let values = signal(2.5, 0.6);
    let fields: Vec<String> = values
        .iter()
        .map(|value| {
            let text = format!("{value:+.10e}");
            let (mantissa, exponent) = text.split_once('e').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            format!("{mantissa}e{exponent:+03}")
        })
        .collect();
    let printed: Vec<f64> = fields.iter().map(|f| f.parse().unwrap()).collect();
    let header = |kind: &str, unit: &str| {
        format!(
            "TIMESERIES XX_ABCD_00_HNE_D, {written} samples, 100 sps, 2020-01-01T23:59:59.900000, {kind}, FLOAT, {unit}\n"
        )
    };
    let rows = fields.chunks(6).map(|row| row.join("\t") + "\n");
    let list = header("SLIST", "M/S**2") + &rows.collect::<String>();
    // Midnight is passed over.
    let time = |i: usize| match i {
        0..10 => format!("2020-01-01T23:59:59.{:06}", 900_000 + 10_000 * i),
        i => format!("2020-01-02T00:00:00.{:06}", 10_000 * (i - 10)),
    };
    let rows = fields.iter().enumerate();
    let rows = rows.map(|(i, field)| format!("{}  {field}\n", time(i)));
    let pairs = header("TSPAIR", "CM/S**2") + &rows.collect::<String>();
    let of = |unit| vec![truth(ACC, "HNE", &printed, unit, 0.01)];
    vec![
        fixture("iris_slist", "iris_ascii", list, of(1.0), true),
        fixture("iris_tspair", "iris_ascii", pairs, of(0.01), true),
    ]
}

pub fn midas() -> Vec<Fixture> {
    let mut text = "*SGSw\n*TITLE, made up\n*TITLE,\n*X-AXIS, Time(sec)\n*Y-AXIS, Ground Accel. (g)\n*UNIT&TYPE, GRAV, ACCEL\n*FLAGS, 0, 0\n*DATA\n".to_owned();
    let mut printed = Vec::new();
    for (i, a) in signal(0.4, 0.3).iter().enumerate() {
        let field = format!("{a:.6E}");
        printed.push(field.parse().unwrap());
        text.push_str(&format!("{:.4E}, {field}\n", i as f64 * 0.02));
    }
    text.push_str("*ENDDATA\n");
    let truth = vec![truth(ACC, "", &printed, G, 0.02)];
    vec![fixture("sgs", "midas_sgs", text, truth, false)]
}

/// Every layout of plain columns.
pub fn plain(written: i64) -> Vec<Fixture> {
    let mut all = Vec::new();
    let mut add = |name, text: String, step: Option<f64>, layout: Option<&str>, truth, counted| {
        let mut f = fixture(name, "plain_columns", text, truth, counted);
        f.options = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            time_step: step,
            layout: layout.map(str::to_owned),
            ..ReadOptions::default()
        };
        all.push(f);
    };
    let values = signal(90.0, 0.2);
    let one = |component: &str, step: f64, printed: &[f64]| {
        vec![truth(ACC, component, printed, 0.01, step)]
    };

    let (column, printed) = block(&values, 1, 9, 4);
    add(
        "column",
        format!("# made up\n{column}"),
        Some(0.005),
        None,
        one("", 0.005, &printed),
        false,
    );
    let text = format!("some label\n{written} 0.005\n{column}");
    add(
        "count_and_step",
        text,
        None,
        None,
        one("", 0.005, &printed),
        true,
    );
    let (rows, printed) = block(&values, 8, 10, 4);
    add(
        "wrapped",
        format!("% made up\n{rows}"),
        Some(0.02),
        None,
        one("", 0.02, &printed),
        false,
    );

    // Values that fill their columns, and the number of each card behind them.
    let (cards, touching) = block(&values, 8, 9, 5);
    let cards: String = cards
        .lines()
        .enumerate()
        .map(|(i, l)| {
            if l.len() == 72 {
                format!("{l}{:>7}\n", i + 1)
            } else {
                format!("{l}\n")
            }
        })
        .collect();
    add(
        "cards",
        cards,
        Some(0.02),
        Some("8F9.5,I7"),
        one("", 0.02, &touching),
        false,
    );

    let times = |i: usize| i as f64 * 0.02;
    let pairs: String = printed
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:.7e} {a}\n", times(i)))
        .collect();
    add("pairs", pairs, None, None, one("a", 0.02, &printed), false);
    let mut wrapped = String::new();
    for (i, a) in printed.iter().enumerate() {
        wrapped.push_str(&format!(
            "{:8.3}{a:10.4}{}",
            times(i),
            if i % 4 == 3 { "\n" } else { "" }
        ));
    }
    wrapped.push('\n');
    add(
        "wrapped_pairs",
        wrapped,
        None,
        Some("t,a"),
        one("a", 0.02, &printed),
        false,
    );

    let semicolons: String = printed
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:.3};{a};{};7.5\n", times(i), -a))
        .collect();
    let opposite: Vec<f64> = printed.iter().map(|a| -a).collect();
    let mut two = one("a", 0.02, &printed);
    two.push(truth(ACC, "b", &opposite, 0.01, 0.02));
    add(
        "named",
        semicolons.clone(),
        None,
        Some("t,a,b,-"),
        two,
        false,
    );
    let text = semicolons.replace(';', "\t");
    add(
        "velocity_beside",
        text,
        None,
        Some("t,a,v,d"),
        one("a", 0.02, &printed),
        false,
    );
    let text: String = printed
        .iter()
        .enumerate()
        .map(|(i, a)| format!("{:.3},{a},{}\n", times(i), -a))
        .collect();
    let mut found = one("ns", 0.02, &printed);
    found.push(truth(ACC, "ew", &opposite, 0.01, 0.02));
    add(
        "found",
        format!("time,ns,ew\n{text}"),
        None,
        None,
        found,
        false,
    );
    all
}

pub fn dyna(written: i64) -> Vec<Fixture> {
    let values = signal(120.0, 0.4);
    let (data, printed) = block(&values, 1, 11, 6);
    let data: String = data.lines().map(|l| format!("{}\n", l.trim())).collect();
    let most = peak(&printed);
    // The sign is lost, as in files of AFAD.
    let text = format!(
        "EVENT_NAME: made up\nEVENT_ID: 1\nSTATION_CODE: XX01\nLOCATION: \u{c7}ank\u{131}r\u{131}\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: 20000101_000000.000\nSAMPLING_INTERVAL_S: 0.01\nNDATA: {written}\nDURATION_S: \nSTREAM: HNE\nUNITS: cm/s^2\nPGA_CM/S^2: {:.3}\nTIME_PGA_S: {:.2}\nBASELINE_CORRECTION: BASELINE REMOVED\nLOW_CUT_FREQUENCY_HZ: 0.05\nLATE/NORMAL_TRIGGERED: NT\nHEADER_FORMAT: DYNA 1.2\nDATA_TYPE: ACCELERATION\nUSER5: \n{data}",
        most.0.abs(),
        most.1 as f64 * 0.01
    );
    let truth = vec![truth(ACC, "HNE", &printed, 0.01, 0.01)];
    vec![fixture("dyna", "dyna", text, truth, true)]
}

pub fn asa(written: i64) -> Vec<Fixture> {
    let three: Vec<_> = [0.1, 0.9, 2.0]
        .map(|p| block(&signal(-3500.0, p), 1, 10, 4))
        .into();
    let mut data = String::new();
    let columns: Vec<Vec<&str>> = three.iter().map(|(t, _)| t.lines().collect()).collect();
    for i in 0..COUNT {
        for column in &columns {
            data.push_str(column[i]);
        }
        data.push('\n');
    }
    let peaks: Vec<String> = three
        .iter()
        .map(|(_, p)| format!("{:.4}", peak(p).0))
        .collect();
    let text = format!(
        "{}\nARCHIVO ESTANDAR DE ACELERACION (ASA)\nVERSION 2.0\n{}\nNOMBRE DE LA ESTACION                    : Inventada\nORIENTACION C1-C6 (rumbo;orientacion)    : /V;/N00E;/N90E;+\nINTERVALO DE MUESTREO, C1-C6 (s)         : /0.005/0.005/0.005\nNUM. TOTAL DE MUESTRAS, C1-C6            : /{written}/{written}/{written}\nACEL. MAX.(Gal), C1-C6                   : /{}\nHORA DE LA PRIMERA MUESTRA (GMT)         : 00:00:00.00\nUNIDADES DE LOS DATOS                    : Gal\nFORMATO DATOS                            : 3F10.4\nDATOS DE ACELERACION:\n{}\n  CANAL-1   CANAL-2   CANAL-3\n     V         N00E      N90E\n------------------------------\n{data}",
        "=".repeat(80),
        "-".repeat(80),
        peaks.join("/"),
        "-".repeat(30)
    );
    let truth = three
        .iter()
        .zip(["V", "N00E", "N90E"])
        .map(|((_, p), name)| truth(ACC, name, p, 0.01, 0.005))
        .collect();
    vec![fixture("asa", "asa", text, truth, true)]
}

pub fn isesd(written: i64) -> Vec<Fixture> {
    let mut text = format!(
        "file: 000001xa.cor\nearthquake code: 1\nstation code: ST1\nwaveform code: 1\nnumber of channels: 3\norientation of transducer: NS\ntime of first sample: 00:00:00\nsampling period: 0.010000s\nnumber of samples: {written}\nunits: m/s*s, m/s & s\ncomments & processing history:\n% corrected by nobody\n"
    );
    let mut all = Vec::new();
    for (quantity, size) in [(ACC, 2.5), (Quantity::Velocity, 0.3)] {
        text.push_str(&format!(
            "-> corrected {} time histories\n",
            quantity.name()
        ));
        let mut printed: Vec<f64> = Vec::new();
        for row in signal(size, 0.6).chunks(5) {
            for value in row {
                // E13.5 as Fortran prints it, the mantissa below one.
                let exponent = value.abs().log10().floor() as i32 + 1;
                let field = format!("{:.5}E{exponent:+03}", value / 10.0_f64.powi(exponent));
                printed.push(field.parse().unwrap());
                text.push_str(&format!("{field:>13}"));
            }
            text.push('\n');
        }
        all.push(truth(quantity, "NS", &printed, 1.0, 0.01));
    }
    text.push_str("-> response spectra\nperiod, damping 5%\n 0.1 0.2 0.3\n");
    vec![fixture("isesd", "isesd", text, all, true)]
}
