//! Velocity at the first sample, and the time of the first value.
use pounding_ground_motion::processing::{ProcessingStep, Scale, process};
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, ReadOptions, read_all_bytes, read_bytes,
};

use crate::common::fixtures;

/// The initial velocity of a velocity block goes with the record, into our CSV and back.
#[test]
fn initial_velocities_are_kept() {
    let fixture = fixtures("csmip_v2", 0).remove(0);
    let recording = read_all_bytes("f", &fixture.bytes, &fixture.options).unwrap();
    let series = &recording.series[0];
    let initial = series.initial.unwrap();
    assert!(initial.0 != 0.0);
    let record = series.accelerogram(&fixture.options).unwrap();
    assert_eq!(record.initial(), Some(initial));
    let half = record.scaled_by(0.5).unwrap();
    assert_eq!(half.initial(), Some((0.5 * initial.0, 0.5 * initial.1)));
    let text = write_pounding_csv(&Written::of(&record)).unwrap();
    assert!(text.contains("# Initial velocity: "), "{text}");
    let back = read_all_bytes("f.csv", text.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(back.series[0].initial, Some(initial));
    let wrong = text.replace(" m/s\n# Initial d", " m\n# Initial d");
    let error = read_bytes("f.csv", wrong.as_bytes(), &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("is not a velocity"), "{error}");
}

/// Scaling to a peak velocity starts from it, as the measures do.
#[test]
fn scaling_to_a_peak_velocity_starts_from_the_initial_one() {
    // The velocity falls in a line from 0.5 m/s to -0.1 m/s.
    let text = "# Initial velocity: 50 cm/s\n# dt: 0.1 s\ntime_s,acceleration_m_s2\n0,-3\n0.1,-3\n0.2,-3\n";
    let record = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
    let steps = [ProcessingStep::Scale(Scale::PeakVelocity(1.0))];
    let scaled = process(&record, &steps).unwrap().accelerogram;
    assert!((scaled.scale() - 2.0).abs() < 1e-12);
    assert_eq!(scaled.initial(), Some((1.0, 0.0)));
    // The end that is reported is that of the measures of what is written, from the initial velocity: -0.2 m/s after
    // twice a parabola from 0.5 m/s to -0.1 m/s.
    let report = &process(&record, &steps).unwrap().steps[0];
    let ends = [report.get("end velocity"), report.get("end displacement")];
    assert!((ends[0].unwrap() + 0.2).abs() < 1e-12, "{ends:?}");
    assert!((ends[1].unwrap() - 0.08).abs() < 1e-12, "{ends:?}");
    // Steps that leave it out start from rest.
    let pad = ProcessingStep::Pad {
        before: 0.0,
        after: 0.1,
    };
    let padded = process(&record, &[pad]).unwrap();
    assert_eq!(padded.accelerogram.initial(), None);
    let end = padded.steps[0].get("end velocity").unwrap();
    assert!((end + 0.75).abs() < 1e-12, "{end}");
    // The zero before the first value is one step earlier.
    let columns = "0.1 -3\n0.2 -3\n0.3 -3\n";
    let read = |text: &str| read_with_zero(text).unwrap();
    assert_eq!(read(columns).samples(), [0.0, -3.0, -3.0, -3.0]);
}

fn read_with_zero(text: &str) -> Result<Accelerogram, GroundMotionError> {
    let options = ReadOptions {
        prepend_zero: true,
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        ..ReadOptions::default()
    };
    read_bytes("f", text.as_bytes(), &options)
}

/// A zero is put before a first value at one step, not before one at zero.
#[test]
fn zeros_before_the_first_value() {
    let rows = |start: f64, separator: &str| -> String {
        let row = |i: i32| {
            format!(
                "{:.2}{separator}{:.1}\n",
                start + 0.02 * f64::from(i),
                (-0.9_f64).powi(i)
            )
        };
        (0..30).map(row).collect()
    };
    let header = "time_s,acceleration_m_s2\n";
    for text in [
        rows(0.0, " "),
        header.to_owned() + &rows(0.0, ","),
        "# dt: 0.02 s\n".to_owned() + header + &rows(0.0, ","),
    ] {
        let error = read_with_zero(&text).unwrap_err();
        assert!(
            error.to_string().contains("would shift the motion"),
            "{error}"
        );
        assert!(error.help().unwrap().contains("--prepend-zero"));
    }
    let warnings = |record: &Accelerogram| record.origin().unwrap().warnings.join("; ");
    let at_one_step = read_with_zero(&rows(0.02, " ")).unwrap();
    assert_eq!(at_one_step.samples().len(), 31);
    assert!(
        !warnings(&at_one_step).contains("is taken at"),
        "{}",
        warnings(&at_one_step)
    );
    let later = read_with_zero(&rows(5.0, " ")).unwrap();
    assert!(warnings(&later).contains("5 s in the file and is taken at 0.02 s, after a zero"));
    let options = ReadOptions {
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        ..ReadOptions::default()
    };
    for (start, advised) in [(0.02, true), (5.0, false)] {
        let record = read_bytes("f", rows(start, " ").as_bytes(), &options).unwrap();
        let said = warnings(&record);
        assert!(said.contains("is taken at 0"), "{said}");
        assert_eq!(said.contains("prepend_zero"), advised, "{said}");
    }
}
