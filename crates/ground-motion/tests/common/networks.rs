//! COSMOS and GeoNet.

use pounding_ground_motion::Quantity;

use super::volumes::fixture;
use super::*;

const ACC: Quantity = Quantity::Acceleration;
const VEL: Quantity = Quantity::Velocity;
const DIS: Quantity = Quantity::Displacement;

pub fn cosmos(written: i64) -> Vec<Fixture> {
    let mut text = String::new();
    let mut found = Vec::new();
    for (quantity, code, unit, factor, format, azimuth) in [
        (ACC, 1, "cm/sec2(04)", 0.01, "8F10.5", 90),
        (VEL, 2, "cm/sec(05)", 0.01, "8F10.5", 90),
        (ACC, 1, "g(02)", G, "1D15.6", 400),
    ] {
        let values = signal(if factor == G { 0.2 } else { -900.0 }, azimuth as f64);
        let (data, printed) = if format.starts_with('8') {
            block(&values, 8, 10, 5)
        } else {
            let fields: Vec<String> = values.iter().map(|a| format!("{a:.6e}")).collect();
            let printed = fields.iter().map(|f| f.parse().unwrap()).collect();
            let rows = fields.iter().map(|f| {
                let (m, e) = f.split_once('e').unwrap();
                format!("{:>15}\n", format!("{m}D{:+03}", e.parse::<i32>().unwrap()))
            });
            (rows.collect(), printed)
        };
        let most = peak(&printed);
        text.push_str(&format!(
            "Corrected {:<16}(Format v01.20 with 13 text lines)\n",
            quantity.name()
        ));
        for k in 2..13 {
            text.push_str(&format!("Text line {k}\n"));
        }
        text.push_str("Values used when parameter or data value is unknown/unspecified:   -999, -999.00\n 100 Integer-header values follow on  10 lines, Format= (10I8)\n");
        let unit_code = if factor == G {
            2
        } else if code == 1 {
            4
        } else {
            5
        };
        text.push_str(&integers(
            100,
            10,
            8,
            -999,
            &[(1, 2), (2, code), (3, unit_code), (54, azimuth)],
        ));
        text.push_str(" 100 Real-header values follow on  17 lines, Format= (6F13.6)\n");
        // Reals 34 and 35, step and length of the uncorrected record, are the wrong ones.
        text.push_str(&reals(
            100,
            6,
            13,
            6,
            -999.0,
            &[
                (34, 0.02),
                (35, 0.125),
                (54, 0.03),
                (57, 20.0),
                (62, 5.0),
                (63, 0.115),
                (64, most.0),
                (65, most.1 as f64 * 0.005),
            ],
        ));
        text.push_str(&format!(
            "   1 Comment line(s) follow, each starting with a \"|\":\n| nothing\n{written:>8} {} pts, approx  0 secs, units={unit},Format=({format})\n{data}End-of-data for Chan 1\n",
            quantity.name()
        ));
        let component = if azimuth == 400 { "Up" } else { "90 deg" };
        found.push(truth(quantity, component, &printed, factor, 0.005));
    }
    vec![fixture("cosmos", "cosmos", text, found)]
}

pub fn geo_net(written: i64) -> Vec<Fixture> {
    let mut raw = String::new();
    let mut corrected = String::new();
    let (mut in_raw, mut in_corrected) = (Vec::new(), Vec::new());
    for (k, name) in ["N10E", "N80W", "Up"].into_iter().enumerate() {
        let blocks = [(ACC, 9000.0, 1), (VEL, 900.0, 2), (DIS, 0.5, 5)]
            .map(|(q, s, d)| (q, block(&signal(-s, k as f64), 10, 8, d)));
        let most = peak(&blocks[0].1.1);
        let head = |first: &str, eleven: &str, pad: usize| {
            format!(
                "{first} accelerogram 20000101_000000_XXXX GNS Science\nSite XXXX      42 00 00S  172 00 00E\nNowhere\nInstrument None\nResolution: 24-bit\nAccelerogram\n5 km of nowhere\n2000 January 1 00:00:00 UT\nEpicentre\nNumber of points {written}\n{eleven}\nData\nComponent {name}  Axis\nAcceleration:  Peak {:8.1} mm/s/s at {:6.2} s\nVelocity record\nDisplacement record\n",
                most.0,
                most.1 as f64 * 0.02 - pad as f64 * 0.02
            )
        };
        let numbers = |pad: i64| {
            integers(
                40,
                10,
                8,
                0,
                &[
                    (31, written),
                    (32, pad),
                    (33, pad),
                    (34, written),
                    (35, written),
                    (36, written),
                ],
            ) + &reals(60, 10, 8, 4, 0.0, &[(25, 0.005), (26, 0.02)])
        };
        raw.push_str(&head(
            "Uncorrected",
            "Raw readings in units of 1.00 mm/s/s  at intervals of 0.020 s",
            0,
        ));
        raw.push_str(&numbers(0));
        raw.push_str(&blocks[0].1.0);
        in_raw.push(truth(ACC, name, &blocks[0].1.1, 0.001, 0.02));
        corrected.push_str(&head(
            "Corrected",
            "Instrument corrected data at 0.020 sec intervals",
            2,
        ));
        corrected.push_str(&numbers(2));
        for (quantity, (data, printed)) in &blocks {
            corrected.push_str(data);
            in_corrected.push(truth(*quantity, name, printed, 0.001, 0.02));
        }
    }
    vec![
        fixture("geo_net_v1a", "geo_net", raw, in_raw),
        fixture("geo_net_v2a", "geo_net", corrected, in_corrected),
    ]
}
