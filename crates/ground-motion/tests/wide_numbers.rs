//! Numbers that leave no room for their point: GeoNet prints `-11026` in eight columns of one decimal, with a blank before
//! each number, as in its Volume 1 of Waiau in the Kaikoura earthquake of 2016 (peak -11026.2 mm/s2 by its header).
use pounding_ground_motion::{GroundMotionError, ReadOptions, Recording, read_all_bytes};

const COUNT: usize = 600;

/// Whole numbers in rows of ten, with these at their places (from 1).
fn numbers(rows: usize, at: &[(usize, String)]) -> String {
    let all = (1..=10 * rows).map(|place| {
        let given = at.iter().find(|(given, _)| *given == place);
        format!("{:>8}", given.map_or("0", |(_, text)| text))
    });
    rows_of(&all.collect::<Vec<_>>())
}

fn rows_of(fields: &[String]) -> String {
    let rows = fields.chunks(10);
    rows.map(|row| row.concat() + "\n").collect()
}

/// Two cycles of a motion (mm/s2) that reaches this peak, printed as GeoNet does.
fn printed(peak: f64) -> Vec<String> {
    let values = (0..COUNT).map(|i| -peak * (std::f64::consts::TAU * i as f64 / 300.0).sin());
    let fields = values.map(|value| match format!("{value:.1}") {
        text if text.len() > 7 => format!("{value:.0}"),
        text => text,
    });
    fields.collect()
}

fn read(values: &[String], peak: f64) -> Result<Recording, GroundMotionError> {
    let fields: Vec<String> = values.iter().map(|text| format!("{text:>8}")).collect();
    let head = format!(
        "Uncorrected accelerogram 20161113_110256_XXXX GNS Science\nSite XXXX      42 37 10S  173 03 13E\nNowhere\nInstrument None\nResolution: 18-bit\nAccelerogram\n5 km of nowhere\n2016 November 13 11:02:56 UT\nEpicentre\nNumber of points {COUNT}\nRaw readings in units of 1.00 mm/s/s  at intervals of 0.005 s\nData is unfiltered\nComponent N28W\nAcceleration:  Peak {peak:8.1} mm/s/s\nVelocity record unevaluated\nDisplacement record unevaluated\n"
    );
    let text = head
        + &numbers(4, &[(31, COUNT.to_string())])
        + &numbers(6, &[(25, "0.005".to_owned()), (26, "0.005".to_owned())])
        + &rows_of(&fields);
    read_all_bytes("f", text.as_bytes(), &ReadOptions::default())
}

#[test]
fn whole_numbers_without_room_are_right() {
    let values = printed(11026.2);
    assert_eq!(values[75], "-11026");
    assert_eq!(values[225], "11026.2");
    let found = read(&values, -11026.2).unwrap();
    let samples = &found.series[0].samples;
    for (sample, text) in samples.iter().zip(&values) {
        let value: f64 = text.parse().unwrap();
        assert!((sample - 1e-3 * value).abs() < 1e-12, "{sample} {text}");
    }
}

/// A value that lost its point is refused as before, beside such numbers too: where it has room, and where it leaps.
#[test]
fn a_lost_point_is_refused_all_the_same() {
    for (peak, at) in [(9000.0, 10), (9000.0, 60), (11026.2, 10), (11026.2, 225)] {
        let mut values = printed(peak);
        values[at] = values[at].replace('.', "");
        let error = read(&values, -peak).unwrap_err().to_string();
        let told = format!("\"{}\" has no decimal point", values[at]);
        assert!(error.contains(&told), "{peak} {at}: {error}");
    }
}
