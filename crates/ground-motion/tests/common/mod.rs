//! A small file of every format in its exact layout, written here, with what must
//! be read from it.
#![allow(dead_code, clippy::unwrap_used)]

pub mod agencies;
pub mod binary;
pub mod japan;
pub mod networks;
pub mod text;
pub mod volumes;

use pounding_ground_motion::{AccelerationUnit, Accelerogram, Format, Quantity, ReadOptions};

/// Samples of every series: not a multiple of what any format prints on a line.
pub const COUNT: usize = 23;
pub const G: f64 = 9.80665;

/// Two components of these samples, of which the longer one comes to 4 % of the peak where the
/// other has ended: stronger motion there is refused.
pub fn two_components(records: [Accelerogram; 2]) -> [Accelerogram; 2] {
    let [least, most] = {
        let lengths = records.each_ref().map(|r| r.samples().len());
        [lengths[0].min(lengths[1]), lengths[0].max(lengths[1])]
    };
    if least == most {
        return records;
    }
    let head = |r: &Accelerogram| {
        r.samples()[..least]
            .iter()
            .fold(0.0, |m: f64, a| m.max(a.abs()))
    };
    let peak = head(&records[0]).max(head(&records[1]));
    records.map(|record| {
        let quiet = |(i, a): (usize, &f64)| {
            let most = 0.04 * peak;
            if i < least { *a } else { a.clamp(-most, most) }
        };
        let samples = record.samples().iter().enumerate().map(quiet).collect();
        let unit = AccelerationUnit::MetrePerSecondSquared;
        Accelerogram::new(samples, unit, record.time_step()).unwrap()
    })
}

/// A series that must be found: values in SI.
#[derive(Debug, Clone)]
pub struct Truth {
    pub quantity: Quantity,
    pub component: String,
    pub samples: Vec<f64>,
    /// Times, if uneven.
    pub times: Option<Vec<f64>>,
    pub step: f64,
}

/// A file with what must be read from it.
#[derive(Clone)]
pub struct Fixture {
    pub name: &'static str,
    pub format: &'static str,
    pub bytes: Vec<u8>,
    pub options: ReadOptions,
    pub truth: Vec<Truth>,
    /// Whether the header has a count that was changed by the offset.
    pub counted: bool,
}

/// Values with the sign changes and sizes that make fixed fields touch: up to
/// `size`, mostly negative.
pub fn signal(size: f64, phase: f64) -> Vec<f64> {
    (0..COUNT)
        .map(|i| size * (1.7 * i as f64 + phase).sin() - 0.02 * size)
        .collect()
}

/// Fortran's `Fw.d`, without the zero before the point as old compilers print.
pub fn fixed(value: f64, width: usize, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = match text.strip_prefix("0.") {
        Some(rest) => format!(".{rest}"),
        None => match text.strip_prefix("-0.") {
            Some(rest) => format!("-.{rest}"),
            None => text,
        },
    };
    assert!(text.len() <= width, "{text} in {width} columns");
    format!("{text:>width$}")
}

/// Rows of fixed fields, `per_line` each, and the values as printed.
pub fn block(values: &[f64], per_line: usize, width: usize, decimals: usize) -> (String, Vec<f64>) {
    let mut text = String::new();
    let mut printed = Vec::new();
    for row in values.chunks(per_line) {
        for value in row {
            let field = fixed(*value, width, decimals);
            printed.push(field.trim().parse().unwrap());
            text.push_str(&field);
        }
        text.push('\n');
    }
    (text, printed)
}

/// Header integers of one width; `set` are (index from 1, value).
pub fn integers(
    count: usize,
    per_line: usize,
    width: usize,
    fill: i64,
    set: &[(usize, i64)],
) -> String {
    let mut values = vec![fill; count];
    for (index, value) in set {
        values[index - 1] = *value;
    }
    let mut text = String::new();
    for row in values.chunks(per_line) {
        for value in row {
            text.push_str(&format!("{value:>width$}"));
        }
        text.push('\n');
    }
    text
}

/// Header reals of one width.
pub fn reals(
    count: usize,
    per_line: usize,
    width: usize,
    decimals: usize,
    fill: f64,
    set: &[(usize, f64)],
) -> String {
    let mut values = vec![fill; count];
    for (index, value) in set {
        values[index - 1] = *value;
    }
    block(&values, per_line, width, decimals).0
}

/// The maximum absolute value, with its sign, and its index.
pub fn peak(values: &[f64]) -> (f64, usize) {
    let mut best = 0;
    for i in 0..values.len() {
        if values[i].abs() > values[best].abs() {
            best = i;
        }
    }
    (values[best], best)
}

pub fn truth(quantity: Quantity, component: &str, printed: &[f64], unit: f64, step: f64) -> Truth {
    Truth {
        quantity,
        component: component.to_owned(),
        samples: printed.iter().map(|a| a * unit).collect(),
        times: None,
        step,
    }
}

pub fn in_g() -> ReadOptions {
    ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    }
}

/// Files of a format; counts in their headers are off by `offset`.
pub fn fixtures(format: &'static str, offset: i64) -> Vec<Fixture> {
    let written = COUNT as i64 + offset;
    match format {
        "mini_seed_2" => binary::mini_seed(),
        "sac" => binary::sac(written),
        "pounding_csv" => text::pounding_csv(),
        "k_net" => japan::k_net(written),
        "jma_csv" => japan::jma(),
        "dyna" => text::dyna(written),
        "cwa" => japan::cwa(),
        "geo_net" => networks::geo_net(written),
        "cosmos" => [networks::cosmos(written), agencies::cosmos_raw(written)].concat(),
        "caltech_volume_1" => [volumes::caltech_1(written), agencies::usc(written)].concat(),
        "caltech_volume_2" => volumes::caltech_2(written),
        "csmip_v1" => volumes::csmip_1(written),
        "csmip_v2" => volumes::csmip_2(written),
        "usgs_smc" => [volumes::smc(written), agencies::smc_raw(written)].concat(),
        "bhrc" => agencies::bhrc(written),
        "nsmn" => agencies::nsmn(written),
        "asa" => [text::asa(written), agencies::asa(written)].concat(),
        "isesd" => text::isesd(written),
        "peer_at2" => text::peer(written),
        "midas_sgs" => text::midas(),
        "iris_ascii" => text::iris(written),
        "plain_columns" => text::plain(written),
        other => panic!("write a fixture for {other}"),
    }
}

/// All files of all formats.
pub fn all(offset: i64) -> Vec<Fixture> {
    Format::all()
        .iter()
        .flat_map(|f| fixtures(f.name, offset))
        .collect()
}
