//! Card images: Caltech, CSMIP, SMC.

use pounding_ground_motion::{Quantity, ReadOptions};

use super::*;

const ACC: Quantity = Quantity::Acceleration;
const VEL: Quantity = Quantity::Velocity;
const DIS: Quantity = Quantity::Displacement;

pub fn fixture(
    name: &'static str,
    format: &'static str,
    text: String,
    truth: Vec<Truth>,
) -> Fixture {
    Fixture {
        name,
        format,
        bytes: text.into_bytes(),
        options: ReadOptions::default(),
        truth,
        counted: true,
    }
}

/// Pairs of time and value at steps that vary by a fifth.
pub fn pairs(values: &[f64], width: usize, decimals: usize) -> (String, Vec<f64>, Vec<f64>) {
    let flat: Vec<f64> = values
        .iter()
        .enumerate()
        .flat_map(|(i, a)| [i as f64 * 0.005 + 0.001 * f64::from(i % 2 == 1), *a])
        .collect();
    let (text, printed) = block(&flat, 10, width, decimals);
    let times = printed.iter().step_by(2).copied().collect();
    (
        text,
        times,
        printed.iter().skip(1).step_by(2).copied().collect(),
    )
}

pub fn volume_1_text(first: &str, component: &str, written: i64, units: &str) -> String {
    format!(
        "{first}\nMADE UP EARTHQUAKE\nJANUARY 1, 2000 00:00 PST\n00000-S0000-00000.00               TRIGGER TIME: 01/01/00, 08:00:00.0 UTC\nSTATION NO. 00000   34.000N, 118.000W     SMA-1  S/N 0000\nNOWHERE\n{component}\nMADE UP EARTHQUAKE     JANUARY 1, 2000 00:00 PST\nHYPOCENTER: NONE\nINSTR PERIOD =  .0400 SEC,  DAMPING =  .600,  SENSITIVITY = 1.80 CM/G.\nNO. OF POINTS = {written:>6}  RECORD LENGTH =   .110 SEC\n{units}\nRMS ACCEL OF COMPLETE RECORD =  .021 G.\n"
    )
}

pub fn csmip_1(written: i64) -> Vec<Fixture> {
    let mut old = String::new();
    let mut found = Vec::new();
    for (k, (name, component)) in [("90 DEG", "90 deg"), ("UP", "UP")].into_iter().enumerate() {
        let (data, times, values) = pairs(&signal(-95.0, k as f64), 7, 3);
        let most = peak(&values);
        let units = format!(
            "UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {:.3} G, AT {:.3} SEC.",
            most.0 / 10.0,
            times[most.1]
        );
        old.push_str(&volume_1_text(
            "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/01/00, CDMG QN00A000",
            &format!("CHAN  {}:  {name}", k + 1),
            written,
            &units,
        ));
        // Integer 28 touches integer 27, the azimuth.
        old.push_str(
            &integers(100, 16, 5, 0, &[(27, 90), (28, 10_000 + written)]).replace(
                &format!("{:>5}", 10_000 + written),
                &format!("{written:>5}"),
            ),
        );
        old.push_str(&reals(50, 8, 10, 3, 0.0, &[(3, 0.11), (5, 1.0)]));
        old.push_str(&data);
        old.push_str(&format!(
            "/&  ----------  END OF DATA FOR CHANNEL  {}  ----------\n",
            k + 1
        ));
        let mut series = truth(ACC, component, &values, 0.1 * G, 0.0);
        series.times = Some(times);
        found.push(series);
    }
    vec![
        fixture("csmip_v1_pairs", "csmip_v1", old, found),
        csmip_1_even(written),
        csmip_1_spaced(written),
    ]
}

fn csmip_1_even(written: i64) -> Fixture {
    let (data, printed) = block(&signal(-1.9, 0.3), 8, 9, 6);
    let most = peak(&printed);
    let mut text = volume_1_text(
        "Uncorrected Accelerogram Data             Processed: 01/01/00, CGS  made--up",
        "Chan  1: 360 Deg",
        written,
        &format!(
            "Units of uncor data are sec and g.         Max  = {:.3} g, at {:.3} sec.",
            most.0,
            most.1 as f64 * 0.01
        ),
    )
    .replace(".110 SEC", ".230 SEC   at 100 Samples/sec");
    // Integer 28 holds nonsense, as where six digits do not fit five columns.
    text.push_str(&integers(
        100,
        16,
        5,
        -999,
        &[(27, 360), (28, 31_999), (33, written)],
    ));
    text.push_str(&reals(50, 8, 10, 5, -999.0, &[(3, 0.23), (5, 1.0)]));
    text.push_str(&format!(
        "{written:>6} Accelerogram points at 100 pts/sec in units of g.       Format: (8f9.6)\n{data}/&  ----------  End of Data for Station Channel   1  ----------\n"
    ));
    let found = vec![truth(ACC, "360 deg", &printed, G, 0.01)];
    fixture("csmip_v1_even", "csmip_v1", text, found)
}

/// The line before the data states the step, not the rate.
fn csmip_1_spaced(written: i64) -> Fixture {
    let (data, printed) = block(&signal(-1.9, 0.6), 8, 9, 6);
    let most = peak(&printed);
    let mut text = volume_1_text(
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 01/01/00, CDMG 00000",
        "CHAN  1:  90 DEG",
        written,
        &format!(
            "UNITS OF UNCOR ACCEL IS G.                 MAX  = {:.3} G, AT {:.3} SEC.",
            most.0,
            most.1 as f64 * 0.005
        ),
    )
    .replace(".110 SEC", ".110 SEC   AT 200 SAMPLES/SEC");
    text.push_str(&integers(100, 16, 5, 0, &[(27, 90), (28, written)]));
    text.push_str(&reals(50, 8, 10, 3, 0.0, &[(3, 0.11), (5, 1.0)]));
    text.push_str(&format!(
        "{written:>5} POINTS OF ACCEL DATA EQUALLY SPACED AT .005 SEC.  (UNITS: G)\n{data}/&  ----------  END OF DATA FOR CHANNEL  1  ----------\n"
    ));
    let found = vec![truth(ACC, "90 deg", &printed, G, 0.005)];
    fixture("csmip_v1_spaced", "csmip_v1", text, found)
}

pub fn caltech_1(written: i64) -> Vec<Fixture> {
    let (data, times, values) = pairs(&signal(-900.0, 0.7), 8, 3);
    let mut text = volume_1_text(
        "UNCORRECTED ACCELEROGRAM DATA OF VOL. I-A, EERL 00-00",
        "COMP S90W                                                               9",
        written,
        "UNITS ARE SEC AND G/10.                                                 23",
    );
    text.push_str(&integers(100, 16, 5, 0, &[(28, written)]));
    text.push_str(&reals(50, 8, 10, 3, 0.0, &[(3, 0.11)]));
    text.push_str(&data);
    text.push_str("/&\n");
    let mut series = truth(ACC, "S90W", &values, 0.1 * G, 0.0);
    series.times = Some(times);
    vec![fixture(
        "caltech_volume_1",
        "caltech_volume_1",
        text,
        vec![series],
    )]
}

/// Header integers and reals of Volume 2.
fn volume_2_numbers(written: i64, step: f64) -> String {
    integers(100, 16, 5, -999, &[(53, written)])
        + &reals(
            100,
            8,
            10,
            4,
            -999.0,
            &[
                // The record before it was processed, and the series.
                (3, 1.1 * COUNT as f64 * step),
                (60, COUNT as f64 * step),
                (61, step),
                (62, 0.07),
                (73, 40.0),
            ],
        )
}

pub fn caltech_2(written: i64) -> Vec<Fixture> {
    let sizes = [(ACC, 9.0e4, "ACC"), (VEL, 90.0, "VEL"), (DIS, 9.0, "DIS")];
    let blocks: Vec<_> = sizes
        .map(|(_, s, _)| block(&signal(-s, 0.4), 8, 10, 3))
        .into();
    let peaks: Vec<_> = blocks.iter().map(|(_, p)| peak(p)).collect();
    // Peaks and initial values with the opposite sign.
    let line = |k: usize, what: &str, unit: &str| {
        format!(
            "PEAK {what} = {:10.5} {unit} AT {:8.3} SEC.",
            -peaks[k].0,
            peaks[k].1 as f64 * 0.02
        )
    };
    let text = [
        "CORRECTED ACCELEROGRAM  IIX001  00.001.0    COMP S90W   FILE  2 DERIVED FROM:",
        "FILE   2  OF UNCORRECTED ACCELEROGRAM DATA OF VOL. I-A, EERL 00-00",
        "MADE UP EARTHQUAKE",
        "JANUARY 1, 1940 - 0000 PST",
        "IX001   00.001.0 S",
        "STATION NO. 000   32 00 00N,115 00 00W",
        "NOWHERE SITE",
        "COMP S90W                                                               9",
        "MADE UP EARTHQUAKE   JANUARY 1, 1940 - 0000 PST",
        "EPICENTER  32 00 00N,115 00 00W",
        "INSTR PERIOD = 0.1000 SEC  DAMPING = 0.528",
        "NO. OF POINTS = 1105  DURATION =  0.46 SEC",
        "UNITS ARE SEC AND G/10.",
        "RMS ACCLN OF COMPLETE RECORD = 0.4126 G/10.",
        " ACCELEROGRAM IS BAND-PASS FILTERED BETWEEN  .050- .070 AND 25.00-27.00 HZ",
        "    23  INSTRUMENT AND BASELINE CORRECTED DATA",
        "AT EQUALLY-SPACED INTERVALS OF    .020  SEC.",
        &line(0, "ACCELERATION", "CMS/SEC/SEC"),
        &line(1, "VELOCITY    ", "CMS/SEC"),
        &line(2, "DISPLACEMENT", "CMS"),
        "INITIAL VELOCITY  =    12.08807  CMS/SEC        INITIAL DISP. =      .74222  CMS",
        "MADE UP EARTHQUAKE   JANUARY 1, 1940 - 0000 PST",
        "",
        "IIX001  00.001.0   NOWHERE SITE                                           COMP S90",
        "W",
    ]
    .join("\n");
    let mut text = text + "\n" + &volume_2_numbers(written, 0.02);
    let mut found = Vec::new();
    for ((quantity, _, word), (data, printed)) in sizes.iter().zip(&blocks) {
        text.push_str(&format!(
            "{written:>6} POINTS OF {word} DATA EQUALLY SPACED AT   .020 SEC.\n{data}"
        ));
        found.push(truth(*quantity, "S90W", printed, 0.01, 0.02));
    }
    text.push_str(" /&\n");
    vec![fixture("caltech_volume_2", "caltech_volume_2", text, found)]
}

pub fn csmip_2(written: i64) -> Vec<Fixture> {
    csmip_2_of(written, |channel| {
        [900.0, 90.0, 9.0].map(|size| signal(-size, f64::from(channel)))
    })
}

/// Acceleration, velocity and displacement (cm, s) of each channel at steps of 0.01 s.
pub fn csmip_2_of(written: i64, series: impl Fn(i32) -> [Vec<f64>; 3]) -> Vec<Fixture> {
    let mut text = String::new();
    let mut found = Vec::new();
    for (channel, name) in [(1, "180 Deg"), (2, "Up")] {
        let component = name.replace("Deg", "deg");
        let kinds = [
            (ACC, 5, "accel", "cm/sec2."),
            (VEL, 6, "veloc", "cm/sec."),
            (DIS, 7, "displ", "cm."),
        ];
        let [acceleration, velocity, displacement] = series(channel);
        let blocks = [
            block(&acceleration, 8, 10, 5),
            block(&velocity, 8, 10, 6),
            block(&displacement, 8, 10, 7),
        ];
        let line = |k: usize, what: &str, unit: &str| {
            let most = peak(&blocks[k].1);
            format!(
                "Peak {what} = {:10.3}    {unit}  at {:8.3}   sec.",
                most.0,
                most.1 as f64 * 0.01
            )
        };
        let chan = format!("Chan  {channel}: {name}");
        text.push_str(&format!(
            "Corrected accelerogram   00000-N0000-00000.00       {chan}     from\nUncorrected Accelerogram Data             Processed: 01/01/00, CGS  madeup\nRcrd of made up earthquake\nCSMIP Preliminary Processing\n00000-N0000-00000.00                 Start time: 01/01/00, 00:00: 1.0 UTC (GPS)\nStation No. 00000   40.000N, 124.000W    Etna2   s/n 0000  (2 Chns of  2 at Sta)\nNowhere - 1 Blvd.                         CGS   Data: Acceleration\n{chan}\n\n\n\n\n\n\nAccelerogram bandpass filtered with 3 dB pts at  0.07 and 40.00 cyc/sec\n    23 points of instrument- and baseline-corrected accel, veloc and displ data\nAt equally-spaced intervals of   0.010  sec.\n{}\n{}\n{}\nInitial velocity  =    -0.000   cm/sec;   Initial displacement =    0.002   cm\n\n\n\n\n",
            line(0, "acceleration", "cm/sec/sec"),
            line(1, "  velocity  ", "cm/sec"),
            line(2, "displacement", "cm"),
        ));
        text.push_str(&volume_2_numbers(written, 0.01));
        for ((quantity, decimals, word, unit), (data, printed)) in kinds.iter().zip(&blocks) {
            text.push_str(&format!(
                "{written:>6} points of {word} data equally spaced at 0.010 sec, in {unit} (8f10.{decimals})\n{data}"
            ));
            found.push(truth(*quantity, &component, printed, 0.01, 0.01));
        }
        text.push_str(&format!(
            "/&  ----------  End of data for channel  {channel}  ----------\n"
        ));
    }
    vec![fixture("csmip_v2", "csmip_v2", text, found)]
}

/// `1PE10.4E1`: an exponent of one digit, no room before a minus.
pub fn one_digit_exponents(values: &[f64]) -> (String, Vec<f64>) {
    let mut text = String::new();
    let mut printed = Vec::new();
    for row in values.chunks(8) {
        for value in row {
            let plain = format!("{value:.4e}");
            printed.push(plain.parse().unwrap());
            let (mantissa, exponent) = plain.split_once('e').unwrap();
            let exponent: i32 = exponent.parse().unwrap();
            text.push_str(&format!("{:>10}", format!("{mantissa}E{exponent:+}")));
        }
        text.push('\n');
    }
    (text, printed)
}

pub fn smc(written: i64) -> Vec<Fixture> {
    let kinds = [
        ("2 CORRECTED ACCELEROGRAM", ACC),
        ("3 VELOCITY", VEL),
        ("4 DISPLACEMENT", DIS),
        ("1 UNCORRECTED ACCELEROGRAM", ACC),
    ];
    kinds
        .into_iter()
        .map(|(title, quantity)| {
            let uneven = title.starts_with('1');
            let values = signal(-220.0, 0.8);
            let times: Vec<f64> = (0..COUNT).map(|i| (50 * i + 7 * (i % 2)) as f64 * 1.0e-4).collect();
            let flat: Vec<f64> = if uneven {
                times.iter().zip(&values).flat_map(|(t, a)| [*t, *a]).collect()
            } else {
                values
            };
            let (data, printed) = one_digit_exponents(&flat);
            let samples: Vec<f64> = if uneven {
                printed.iter().skip(1).step_by(2).copied().collect()
            } else {
                printed.clone()
            };
            let numbers = if uneven { 2 * written } else { written };
            let mut text = format!(
                "{title}\n*\nX000X\n     2000   1   1    0000 Made up\nMoment Mag=      7.0\nstation = A name that is long enough to be c  component=    133\nepicentral dist =     63.0\ninst type=SMA-1\n*\n*\n*\n"
            );
            text.push_str(&integers(48, 8, 10, -32_768, &[(1, -32_768), (2, 2000), (13, 90), (14, 133), (16, 2), (17, numbers)]));
            let most = peak(&samples);
            let at = if most.0 < 0.0 { 31 } else { 29 };
            let mut reals = vec![1.7e38; 50];
            if !uneven {
                reals[1] = 200.0;
                reals[at - 1] = most.1 as f64 * 0.005;
                reals[at] = most.0;
            }
            for row in reals.chunks(5) {
                for value in row {
                    let plain = format!("{value:.6e}");
                    let (mantissa, exponent) = plain.split_once('e').unwrap();
                    text.push_str(&format!("{:>15}", format!("{mantissa}E{:+03}", exponent.parse::<i32>().unwrap())));
                }
                text.push('\n');
            }
            text.push_str(&format!("| a comment\n|\n{data}"));
            let mut series = truth(quantity, "133", &samples, 0.01, 0.005);
            if uneven {
                series.times = Some(printed.iter().step_by(2).copied().collect());
            }
            fixture("smc", "usgs_smc", text, vec![series])
        })
        .collect()
}
