//! K-NET, KiK-net, JMA and, from Taiwan, CWA.

use pounding_ground_motion::{Quantity, ReadOptions};

use super::*;

const ACC: Quantity = Quantity::Acceleration;

pub fn k_net(written: i64) -> Vec<Fixture> {
    [("E-W", "EW"), ("6", "UD2")]
        .into_iter()
        .map(|(direction, component)| {
            // Counts that fill their eight columns beside the offset of the instrument.
            let counts: Vec<i64> = signal(4.0e6, 0.5)
                .iter()
                .map(|a| *a as i64 - 2_000_000)
                .collect();
            let factor = 3920.0 / 6_182_761.0;
            let gal: Vec<f64> = counts.iter().map(|c| *c as f64 * factor).collect();
            let mean = gal.iter().sum::<f64>() / gal.len() as f64;
            let most = gal.iter().fold(0.0_f64, |m, a| m.max((a - mean).abs()));
            let mut text = String::new();
            for (name, value) in [
                ("Origin Time", "2000/01/01 00:00:00".to_owned()),
                ("Lat.", "40.0".to_owned()),
                ("Long.", "140.0".to_owned()),
                ("Depth. (km)", "10".to_owned()),
                ("Mag.", "6.0".to_owned()),
                ("Station Code", "XXX001".to_owned()),
                ("Station Lat.", "40.1".to_owned()),
                ("Station Long.", "140.1".to_owned()),
                ("Station Height(m)", "5".to_owned()),
                ("Record Time", "2000/01/01 00:00:20".to_owned()),
                ("Sampling Freq(Hz)", "100Hz".to_owned()),
                ("Duration Time(s)", format!("{:.2}", written as f64 / 100.0)),
                ("Dir.", direction.to_owned()),
                ("Scale Factor", "3920(gal)/6182761".to_owned()),
                ("Max. Acc. (gal)", format!("{most:.3}")),
                ("Last Correction", "2000/01/01 00:00:00".to_owned()),
                ("Memo.", String::new()),
            ] {
                text.push_str(&format!("{name:<18}{value}\n"));
            }
            for row in counts.chunks(8) {
                for count in row {
                    text.push_str(&format!("{count:>8} "));
                }
                text.push('\n');
            }
            Fixture {
                name: "k_net",
                format: "k_net",
                bytes: text.into_bytes(),
                options: ReadOptions::default(),
                truth: vec![truth(ACC, component, &gal, 0.01, 0.01)],
                counted: true,
            }
        })
        .collect()
}

pub fn jma() -> Vec<Fixture> {
    let three: Vec<Vec<f64>> = [0.0, 1.0, 2.0]
        .iter()
        .map(|p| block(&signal(80.0, *p), 1, 10, 3).1)
        .collect();
    // The name of the site in Shift_JIS; runs of commas as spreadsheets leave them.
    let mut bytes = b"SITE CODE= 41000\x8b\x9e\x93s,,\n LAT.=  35.0000,,\n LON.= 135.0000,,\n SAMPLING RATE= 100Hz,,\n UNIT  = gal(cm/s/s),,\n INITIAL TIME = 2000 01 01 00 00 00,,\nNS,EW,UD\n".to_vec();
    for i in 0..COUNT {
        bytes.extend(format!("{:.3},{:.3},{:.3}\n", three[0][i], three[1][i], three[2][i]).bytes());
    }
    let truth = three
        .iter()
        .zip(["NS", "EW", "UD"])
        .map(|(p, name)| truth(ACC, name, p, 0.01, 0.01))
        .collect();
    vec![Fixture {
        name: "jma",
        format: "jma_csv",
        bytes,
        options: ReadOptions::default(),
        truth,
        counted: false,
    }]
}

pub fn cwa() -> Vec<Fixture> {
    // Negative values of ten columns: they touch.
    let three: Vec<Vec<f64>> = [0.0, 1.0, 2.0]
        .iter()
        .map(|p| block(&signal(-20_000.0, *p), 1, 10, 3).1)
        .collect();
    let mut text = "#Earthquake Information\n#Origin Time(GMT+08): 2000/01/01-00:00:00\n#StationCode: XXX\n#StartTime: 2000/01/01-00:00:00\n#SampleRate(Hz): 50\n#AmplitudeUnit:  gal. DCoffset(corr)\n#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n".to_owned();
    for i in 0..COUNT {
        text.push_str(&format!("{:10.3}", i as f64 * 0.02));
        for series in &three {
            text.push_str(&format!("{:10.3}", series[i]));
        }
        text.push('\n');
    }
    let truth = three
        .iter()
        .zip(["U", "N", "E"])
        .map(|(p, name)| truth(ACC, name, p, 0.01, 0.02))
        .collect();
    vec![Fixture {
        name: "cwa",
        format: "cwa",
        bytes: text.into_bytes(),
        options: ReadOptions::default(),
        truth,
        counted: false,
    }]
}
