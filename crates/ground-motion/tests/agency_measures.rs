//! Measures of files as agencies publish them, where they are at hand (`../shared`
//! beside the repository), against the table of their `PROVENANCE.md`: an independent
//! program's values with the trapezoid rule and spectra at samples, to the last digit
//! printed.
use std::path::Path;

use pounding_ground_motion::measures::{IntensityMeasures, MeasureOptions};
use pounding_ground_motion::spectra::{Evaluation, response_spectrum};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, Offset, ReadOptions, read};

const G: f64 = 9.80665;
const EL_CENTRO: &str = "ElCentro1940_NS_Peknold__elCentro.AT2";
const CALTECH: &str = "ElCentro1940_NS_Caltech__elcentro_NS.dat";
const S90W: &str = "ElCentro1940_S90W_CaltechVol2__USACA47.035.txt";
const SCT: &str = "MexicoCitySCT1985__sct190985.txt";
const KOBE: &str = "Kobe1995_JMA_NS__KOBE.txt";
const FERNDALE: &str = "Ferndale2022_Fortuna_CE89486__ce89486SampleInput.v2";
const CHINA_LAKE: &str = "Ridgecrest2019_ChinaLake_CICLC__CICLC.v1";
const APEEL: &str = "LomaPrieta1989_APEEL2_NP1002__np01002p_4225a_a.smc";
const KAIKOURA: &str = "Kaikoura2016_HSES__20161113_110300_HSES_20.V1A";
const PAZARCIK: &str = "Kahramanmaras2023_TK3116_E__20230206011732_3116_mp_Acc_E.asc";

/// File, component, whether the mean is removed, count and step; then as printed PGA
/// (g), PGV (cm/s), Ia (m/s), D5-95 (s), CAV (m/s), PSA (g) at 0.2, 0.5, 1 and 2 s.
type Row = (
    &'static str,
    &'static str,
    bool,
    usize,
    f64,
    [&'static str; 9],
);

#[rustfmt::skip]
const TABLE: [Row; 13] = [
    (EL_CENTRO, "", false, 1559, 0.02, ["0.31882", "36.142", "1.8010", "23.843", "12.613", "0.7925", "0.9162", "0.4541", "0.1374"]),
    (CALTECH, "a", false, 2688, 0.02, ["0.34874", "38.097", "1.8231", "24.435", "14.302", "0.6487", "0.8251", "0.5148", "0.1777"]),
    (S90W, "S90W", false, 2674, 0.02, ["0.21429", "48.723", "1.2921", "24.546", "13.245", "0.4954", "0.6349", "0.2770", "0.2168"]),
    (SCT, "ns", false, 8171, 0.02, ["0.09953", "37.992", "1.3072", "70.847", "23.001", "0.1150", "0.1347", "0.1835", "0.6008"]),
    (SCT, "ew", false, 8171, 0.02, ["0.17117", "60.675", "2.4320", "36.853", "27.110", "0.1839", "0.2553", "0.2396", "0.9901"]),
    (KOBE, "a", false, 2000, 0.02, ["0.83732", "92.360", "8.4551", "8.300", "20.913", "1.0545", "2.1293", "1.5296", "0.3832"]),
    (FERNDALE, "1", false, 10100, 0.01, ["0.39582", "34.663", "0.9354", "6.987", "6.791", "0.9609", "0.5492", "0.4408", "0.0836"]),
    (FERNDALE, "2", false, 10100, 0.01, ["0.26697", "15.675", "0.4363", "11.397", "5.533", "0.5801", "0.2988", "0.1790", "0.0399"]),
    (CHINA_LAKE, "1", true, 31932, 0.01, ["0.34425", "29.601", "1.6131", "16.503", "13.576", "0.7114", "0.3571", "0.0961", "0.0989"]),
    (CHINA_LAKE, "2", true, 32080, 0.01, ["0.51080", "53.072", "3.2897", "15.607", "18.164", "1.5514", "0.7615", "0.1873", "0.1803"]),
    (APEEL, "133", false, 7183, 0.005, ["0.22691", "35.193", "0.7432", "11.857", "7.310", "0.2385", "0.4432", "0.5560", "0.0974"]),
    (KAIKOURA, "N10E", true, 65536, 0.005, ["0.24420", "32.001", "2.3123", "95.913", "30.308", "0.5388", "0.5291", "0.4197", "0.1186"]),
    (PAZARCIK, "HNE", false, 12500, 0.01, ["0.16498", "36.506", "0.8454", "34.109", "12.635", "0.5855", "0.3436", "0.2869", "0.1632"]),
];

fn record(row: &Row) -> Option<Accelerogram> {
    let folder =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/ground_motions/native");
    let path = folder.join(row.0);
    let plain = [CALTECH, SCT, KOBE].contains(&row.0);
    let options = ReadOptions {
        unit: plain.then_some(AccelerationUnit::StandardGravity),
        layout: (row.0 == SCT).then(|| "t,ns,ew,v".to_owned()),
        component: (!row.1.is_empty()).then(|| row.1.to_owned()),
        offset: if row.2 { Offset::Remove } else { Offset::Keep },
        ..ReadOptions::default()
    };
    path.exists().then(|| read(&path, &options).unwrap())
}

#[test]
fn the_table_of_measures() {
    let names = [
        "PGA", "PGV", "Ia", "D5-95", "CAV", "0.2 s", "0.5 s", "1 s", "2 s",
    ];
    let mut wrong = Vec::new();
    for row in &TABLE {
        let Some(record) = record(row) else {
            return;
        };
        assert_eq!((record.samples().len(), record.time_step()), (row.3, row.4));
        let options = MeasureOptions {
            evaluation: Evaluation::AtSamples,
            ..MeasureOptions::default()
        };
        let measures = IntensityMeasures::of(&record, options).unwrap();
        let periods = [0.2, 0.5, 1.0, 2.0];
        let spectrum = response_spectrum(&record, &periods, 0.05, Evaluation::AtSamples).unwrap();
        let mut values = vec![
            measures.peak_acceleration.value / G,
            measures.peak_velocity.value * 100.0,
            measures.arias_intensity,
            measures.significant_5_95.duration(),
            measures.cumulative_absolute_velocity,
        ];
        values.extend(spectrum.pseudo_acceleration.iter().map(|a| a / G));
        for (i, value) in values.iter().enumerate() {
            let digits = row.5[i].split('.').nth(1).unwrap().len();
            let printed: f64 = row.5[i].parse().unwrap();
            if (value - printed).abs() > 0.500_001 * 10.0_f64.powi(-(digits as i32)) {
                wrong.push(format!(
                    "{} {} {}: {value} for {printed}",
                    row.0, row.1, names[i]
                ));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
