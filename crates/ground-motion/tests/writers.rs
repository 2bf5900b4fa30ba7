//! What is written is read back.
use pounding_ground_motion::processing::{OffsetCorrection, ProcessingStep, process};
use pounding_ground_motion::writers::{
    Column, Written, write_peer_at2, write_plain_columns, write_pounding_csv,
};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, Format, Offset, Processing, Quantity, ReadOptions, Recording,
    read_all_bytes, read_bytes,
};
use proptest::prelude::*;

fn any_written() -> impl Strategy<Value = Written> {
    let sample = prop_oneof![
        -20.0..20.0_f64,
        Just(0.0),
        (-1.0..1.0_f64, -30..0_i32).prop_map(|(a, n)| a * 10.0_f64.powi(n)),
        // Exponents of three digits, as in the tail of a pulse.
        (-1.0..1.0_f64, -300..-90_i32).prop_map(|(a, n)| a * 10.0_f64.powi(n)),
    ];
    let samples = proptest::collection::vec(sample, 2..200);
    (samples, 1_u32..400, "[ -~\n\u{e9}]{0,40}").prop_map(|(samples, step, title)| Written {
        quantity: Quantity::Acceleration,
        samples,
        time_step: f64::from(step) * 1.0e-3,
        title,
        component: "N10E".to_owned(),
        initial: None,
        first_time: None,
        start_time: String::new(),
        orientation: None,
        processing: Processing::Unstated,
        remarks: vec!["Step: made up".to_owned()],
    })
}

fn keep() -> ReadOptions {
    ReadOptions {
        offset: Offset::Keep,
        ..ReadOptions::default()
    }
}

proptest! {
    /// Our layout: every bit, whatever the title holds.
    #[test]
    fn pounding_csv_returns_every_bit(written in any_written()) {
        let text = write_pounding_csv(&written).unwrap();
        let read = read_all_bytes("a.csv", text.as_bytes(), &keep()).unwrap();
        prop_assert_eq!(&read.series[0].origin.format, "pounding_csv");
        prop_assert_eq!(&read.series[0].samples, &written.samples);
        prop_assert_eq!(&read.series[0].component, "N10E");
        prop_assert_eq!(&read.series[0].origin.history, &["Step: made up".to_owned()]);
        let record = read_bytes("a.csv", text.as_bytes(), &keep()).unwrap();
        prop_assert_eq!(record.time_step(), written.time_step);
    }

    /// The time of every sample, from the shortest step that a record may have to the longest.
    #[test]
    fn pounding_csv_returns_every_step(written in any_written(), exponent in -9..6_i32, digits in 1_u32..1000) {
        let time_step = f64::from(digits) * 0.01 * 10.0_f64.powi(exponent);
        prop_assume!((1.0e-9..=1.0e6).contains(&time_step));
        let text = write_pounding_csv(&Written { time_step, ..written }).unwrap();
        let record = read_bytes("a.csv", text.as_bytes(), &keep()).unwrap();
        prop_assert_eq!(record.time_step(), time_step);
    }

    /// AT2, VT2 and DT2: eight digits.
    #[test]
    fn peer_returns_eight_digits(written in any_written(), kind in 0..3_usize) {
        let quantity =
            [Quantity::Acceleration, Quantity::Velocity, Quantity::Displacement][kind];
        let written = Written { quantity, title: "A title".to_owned(), ..written };
        let text = write_peer_at2(&written);
        let options = ReadOptions { format: Some(Format::find("peer_at2").unwrap()), ..keep() };
        let read = read_all_bytes("a.at2", text.as_bytes(), &options).unwrap();
        let series = &read.series[0];
        prop_assert_eq!(series.quantity, quantity);
        prop_assert_eq!(series.samples.len(), written.samples.len());
        for (a, b) in series.samples.iter().zip(&written.samples) {
            // What is too small for the field is zero.
            prop_assert!((a - b).abs() <= 6e-8 * b.abs() + 1e-97, "{} {}", a, b);
        }
    }

    /// Plain columns in g: a rounding of the unit.
    #[test]
    fn plain_columns_return(written in any_written()) {
        let g = AccelerationUnit::StandardGravity;
        let columns = [Column::Time, Column::Value];
        let (text, symbol) = write_plain_columns(&written, &columns, Some(g));
        prop_assert_eq!(symbol, "g");
        let options = ReadOptions {
            format: Some(Format::find("plain_columns").unwrap()),
            layout: Some("t,a".to_owned()),
            unit: Some(g),
            ..keep()
        };
        let record = read_bytes("a.txt", text.as_bytes(), &options).unwrap();
        prop_assert!((record.time_step() / written.time_step - 1.0).abs() < 1e-9);
        for (a, b) in record.samples().iter().zip(&written.samples) {
            prop_assert!((a - b).abs() <= 5e-16 * b.abs(), "{} {}", a, b);
        }
    }
}

/// Numbers of a file come back as they stood there where the unit is the same.
#[test]
fn numbers_of_files_come_back() {
    let sign = |i: i32| if i % 2 == 0 { 1.0e-5 } else { -1.0e-5 };
    let numbers: Vec<String> = (10..4000)
        .map(|i| format!("{:.5}", f64::from(i * 7919 % 4001 + 10) * sign(i)))
        .map(|number| number.trim_end_matches('0').to_owned())
        .collect();
    let text = numbers.join("\n") + "\n";
    for unit in [
        AccelerationUnit::StandardGravity,
        AccelerationUnit::MilliGravity,
        AccelerationUnit::Gal,
        AccelerationUnit::FootPerSecondSquared,
        AccelerationUnit::MetrePerSecondSquared,
    ] {
        let options = ReadOptions {
            unit: Some(unit),
            time_step: Some(0.01),
            layout: Some("a".to_owned()),
            ..keep()
        };
        let read = read_all_bytes("a.txt", text.as_bytes(), &options).unwrap();
        let written = Written::of_series(&read.series[0]).unwrap();
        let (again, _) = write_plain_columns(&written, &[Column::Value], Some(unit));
        assert_eq!(again, text, "{unit:?}");
    }
}

/// A record that is written twice tells of both times.
#[test]
fn history_grows() {
    let samples = vec![0.1, 0.2, -0.3, 0.4];
    let record = Accelerogram::new(samples, AccelerationUnit::MetrePerSecondSquared, 0.01).unwrap();
    let steps = [ProcessingStep::Offset(OffsetCorrection::Value(0.05))];
    let once = process(&record, &steps).unwrap().accelerogram;
    let text = write_pounding_csv(&Written::of(&once)).unwrap();
    let read = read_bytes("once.csv", text.as_bytes(), &keep()).unwrap();
    let twice = process(&read, &[ProcessingStep::Sign])
        .unwrap()
        .accelerogram;
    let remarks = Written::of(&twice).remarks;
    let starts: Vec<&str> = remarks
        .iter()
        .map(|r| r.split_once(": ").unwrap().0)
        .collect();
    assert_eq!(starts, ["Step", "Source", "Read", "Note", "Step"]);
    assert!(
        remarks[0].starts_with("Step: offset: offset 0.05 m/s2"),
        "{remarks:?}"
    );
    assert!(remarks[1].starts_with("Source: once.csv (pounding_csv), SHA-256 "));
    assert!(remarks[4].starts_with("Step: sign: "));
}

/// Velocities have no place in our layout, uneven times in none.
#[test]
fn what_cannot_be_written() {
    let velocity = Written {
        quantity: Quantity::Velocity,
        samples: vec![0.0, 1.0],
        time_step: 0.01,
        title: String::new(),
        component: String::new(),
        initial: None,
        first_time: None,
        start_time: String::new(),
        orientation: None,
        processing: Processing::Unstated,
        remarks: Vec::new(),
    };
    let error = write_pounding_csv(&velocity).unwrap_err();
    assert!(error.help().unwrap().contains("peer_at2"));
    let text = "0 1\n0.01 2\n0.03 3\n0.04 1\n0.07 5\n";
    let options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        layout: Some("t,a".to_owned()),
        ..keep()
    };
    let read: Recording = read_all_bytes("a.txt", text.as_bytes(), &options).unwrap();
    let error = Written::of_series(&read.series[0]).unwrap_err();
    assert!(error.to_string().contains("uneven"), "{error}");
}

/// The series that a quantity and a component name.
#[test]
fn series_are_chosen() {
    let text = "0 1 4\n0.01 2 5\n0.02 3 6\n";
    let options = ReadOptions {
        unit: Some(AccelerationUnit::Gal),
        layout: Some("t,ns,ew".to_owned()),
        ..keep()
    };
    let read = read_all_bytes("a.txt", text.as_bytes(), &options).unwrap();
    assert!(read.choose(&options).is_err());
    let east = ReadOptions {
        component: Some("ew".to_owned()),
        ..options.clone()
    };
    assert_eq!(read.choose(&east).unwrap().samples, [0.04, 0.05, 0.06]);
    let velocity = ReadOptions {
        quantity: Some(Quantity::Velocity),
        ..east
    };
    let error = read.choose(&velocity).unwrap_err();
    assert!(error.to_string().contains("velocity"), "{error}");
}

/// A raw record of an agency is used in the same way after it was written in another format.
#[test]
fn raw_records_stay_raw() {
    let fixture = crate::common::fixtures("k_net", 0).swap_remove(0);
    let original = read_bytes("a.NS", &fixture.bytes, &fixture.options).unwrap();
    assert!(original.origin().unwrap().mean_removed);
    let options = ReadOptions {
        offset: Offset::Keep,
        ..fixture.options.clone()
    };
    let kept = read_bytes("a.NS", &fixture.bytes, &options).unwrap();
    let written = Written::of(&kept);
    assert_eq!(written.processing, Processing::Raw);
    let csv = write_pounding_csv(&written).unwrap();
    for text in [csv.clone(), write_peer_at2(&written)] {
        let read = read_all_bytes("a", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(read.series[0].origin.processing, Processing::Raw, "{text}");
        let record = read_bytes("a", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert!(record.origin().unwrap().mean_removed);
        let peak = original.peak().value;
        for (a, b) in record.samples().iter().zip(original.samples()) {
            assert!((a - b).abs() < 1e-6 * peak, "{a} {b}");
        }
    }
    // Nor is what nobody knows taken for corrected.
    for stage in [Processing::Unstated, Processing::Corrected] {
        let written = Written {
            processing: stage,
            ..written.clone()
        };
        for text in [
            write_pounding_csv(&written).unwrap(),
            write_peer_at2(&written),
        ] {
            let read = read_all_bytes("a", text.as_bytes(), &ReadOptions::default()).unwrap();
            assert_eq!(read.series[0].origin.processing, stage, "{text:.200}");
        }
    }
    // Without its mean it is raw no longer, nor after a step.
    assert_eq!(Written::of(&original).processing, Processing::Unstated);
    let step = ProcessingStep::Offset(OffsetCorrection::Mean);
    let changed = process(&kept, &[step]).unwrap().accelerogram;
    assert_eq!(Written::of(&changed).processing, Processing::Unstated);

    for (from, to, words) in [
        (
            "# Stage: raw",
            "# Stage: rough",
            "neither raw nor corrected",
        ),
        (
            "# Stage: raw",
            "# Stage: raw\n# Stage: corrected",
            "both raw and corrected",
        ),
    ] {
        let text = csv.replace(from, to);
        let error = read_all_bytes("a", text.as_bytes(), &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().contains(words), "{error}");
        assert!(error.help().is_some());
    }
    // Columns of another program, with our keys before their header.
    let text = csv.replace("time_s,acceleration_m_s2", "time (s),a (m/s2)");
    let read = read_all_bytes("a", text.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(read.series[0].origin.format, "plain_columns");
    assert_eq!(read.series[0].origin.processing, Processing::Raw);
}
