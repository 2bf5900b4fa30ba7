//! From the series of a file to an excitation, and layouts of plain columns.
use crate::common::{self, COUNT};
use pounding_ground_motion::{
    Format, GroundMotionError, Offset, Processing, Quantity, ReadOptions, read_all_bytes,
    read_bytes,
};

#[test]
fn excitation_is_an_acceleration_that_is_chosen() {
    let csmip = &common::fixtures("csmip_v2", 0)[0];
    let pick = |component: Option<&str>, quantity| {
        let options = ReadOptions {
            component: component.map(str::to_owned),
            quantity,
            ..ReadOptions::default()
        };
        read_bytes("file", &csmip.bytes, &options)
    };
    let error = pick(None, None).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("acceleration 180 deg (channel 1), acceleration Up (channel 2)"),
        "{error}"
    );
    assert!(matches!(
        pick(Some("N"), None),
        Err(GroundMotionError::NoSuchSeries { .. })
    ));
    for (name, index) in [("180 deg", 0), ("180", 0), ("up", 3), ("2", 3)] {
        let record = pick(Some(name), None).unwrap();
        for (a, b) in record.samples().iter().zip(&csmip.truth[index].samples) {
            assert!((a - b).abs() <= 1e-14 * b.abs(), "{name}");
        }
    }
    assert!(matches!(
        pick(Some("2"), Some(Quantity::Velocity)),
        Err(GroundMotionError::NotAcceleration {
            quantity: "velocity",
            ..
        })
    ));
    for format in ["peer_at2", "usgs_smc"] {
        for fixture in common::fixtures(format, 0) {
            let record = read_bytes("file", &fixture.bytes, &ReadOptions::default());
            match fixture.truth[0].quantity {
                Quantity::Acceleration if fixture.truth[0].times.is_none() => {
                    assert_eq!(record.unwrap().samples().len(), COUNT);
                }
                Quantity::Acceleration => {
                    assert!(matches!(record, Err(GroundMotionError::Uneven { .. })));
                }
                other => assert!(matches!(
                    record,
                    Err(GroundMotionError::NotAcceleration { quantity, .. }) if quantity == other.name()
                )),
            }
        }
    }
}

/// The offset of raw records is taken off an excitation, and said.
#[test]
fn offsets() {
    let fixture = &common::fixtures("k_net", 0)[0];
    let raw = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
    assert_eq!(raw.series[0].origin.processing, Processing::Raw);
    let mean = raw.series[0].mean();
    assert!(mean.abs() > 1.0);
    let record = read_bytes("file", &fixture.bytes, &fixture.options).unwrap();
    assert!(record.samples().iter().sum::<f64>().abs() < 1e-9);
    assert!(
        record
            .origin()
            .unwrap()
            .warnings
            .iter()
            .any(|w| w.contains("was taken off"))
    );
    let keep = ReadOptions {
        offset: Offset::Keep,
        ..ReadOptions::default()
    };
    let record = read_bytes("file", &fixture.bytes, &keep).unwrap();
    assert!((record.samples().iter().sum::<f64>() / COUNT as f64 - mean).abs() < 1e-12);
}

/// Uneven pairs are resampled by linear interpolation, when a step is given.
#[test]
fn resampling() {
    let fixture = &common::fixtures("caltech_volume_1", 0)[0];
    let options = |step| ReadOptions {
        time_step: Some(step),
        offset: Offset::Keep,
        ..ReadOptions::default()
    };
    let record = read_bytes("file", &fixture.bytes, &options(0.002)).unwrap();
    let truth = &fixture.truth[0];
    let times = truth.times.as_ref().unwrap();
    let length = times[COUNT - 1] - times[0];
    assert_eq!(
        record.samples().len(),
        (length / 0.002 + 1.0 + 1e-9) as usize
    );
    for (i, a) in record.samples().iter().enumerate() {
        let t = i as f64 * 0.002;
        let k = times.iter().rposition(|x| *x <= t).unwrap().min(COUNT - 2);
        let w = (t - times[k]) / (times[k + 1] - times[k]);
        let expected = (1.0 - w) * truth.samples[k] + w * truth.samples[k + 1];
        assert!(
            (a - expected).abs() < 1e-10 * truth.samples[0].abs().max(900.0),
            "{t}"
        );
    }
    for step in [0.02, 0.0002, -1.0] {
        assert!(
            read_bytes("file", &fixture.bytes, &options(step)).is_err(),
            "{step}"
        );
    }
}

#[test]
fn layouts_that_are_found() {
    let read = |text: &str, options: &ReadOptions| {
        read_bytes("file", text.as_bytes(), options).unwrap_or_else(|e| panic!("{text}: {e}"))
    };
    let stepped = ReadOptions {
        time_step: Some(0.01),
        ..common::in_g()
    };
    // Cards with their numbers behind them, apart from the values.
    let record = read(".1 -.2 .3 1\n.4 .5 .6 2\n.7 .8 .9 3\n", &stepped);
    let of_g: Vec<f64> = record.samples().iter().map(|a| a / common::G).collect();
    for (a, b) in of_g
        .iter()
        .zip([0.1, -0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])
    {
        assert!((a - b).abs() < 1e-15);
    }
    assert_eq!(of_g.len(), 9);
    // Times of 1/409.6 s in five decimals keep their step; first value at one step.
    let text: String = (1..200)
        .map(|i| format!("{:.5} {}\n", f64::from(i) / 409.6, i % 7))
        .collect();
    let record = read(&text.replace(" 0", " 0.0"), &common::in_g());
    assert!((record.time_step() * 409.6 - 1.0).abs() < 1e-4);
    assert!(record.origin().unwrap().warnings[0].contains("prepend_zero"));
    // Three decimals of 0.0025 s.
    let text: String = (0..101)
        .map(|i| format!("{:.3} 0.{i}\n", f64::from(i) * 0.0025))
        .collect();
    assert_eq!(read(&text, &common::in_g()).time_step(), 0.0025);
    // A row that is missing is no coarse digit.
    let text: String = (0..1000)
        .filter(|i| *i != 500)
        .map(|i| format!("{:.2} 0.{i}\n", f64::from(i) * 0.01))
        .collect();
    assert!(matches!(
        read_bytes("file", text.as_bytes(), &common::in_g()),
        Err(GroundMotionError::Uneven { count: 999, .. })
    ));
    // Characters before the values, and another g.
    let options = ReadOptions {
        skip_columns: 4,
        gravity: Some(9.81),
        ..stepped
    };
    assert_eq!(
        read("C01 1.0\nC02 2.0\n", &options).samples(),
        [9.81, 19.62]
    );
}

#[test]
fn plain_columns_that_are_refused() {
    for (text, word) in [
        ("0,5\n0,6\n", "decimal comma"),
        ("0,02 0,5\n0,04 0,6\n", "decimal comma"),
        ("1.0 2.0\n1.0\n1.0 2.0\n", "another number of values"),
        ("0.1\n0.2\nend of file\n", "text among the numbers"),
        ("# nothing\n", "no data"),
    ] {
        let options = ReadOptions {
            format: Some(Format::find("plain_columns").unwrap()),
            time_step: Some(0.01),
            ..common::in_g()
        };
        let error = read_all_bytes("file", text.as_bytes(), &options).unwrap_err();
        assert!(error.to_string().contains(word), "{error}");
    }
}
