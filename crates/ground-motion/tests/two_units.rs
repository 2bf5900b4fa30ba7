//! Headers that state two units of one quantity.
use pounding_ground_motion::{AccelerationUnit, Accelerogram, ReadOptions, read_bytes};

fn read(text: &str, unit: Option<AccelerationUnit>) -> Result<Accelerogram, String> {
    let options = ReadOptions {
        unit,
        ..ReadOptions::default()
    };
    read_bytes("f", text.as_bytes(), &options)
        .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

fn columns(header: &str) -> String {
    let separator = if header.contains(',') { "," } else { "  " };
    let rows: String = (0..40)
        .map(|i| {
            let value = 0.3 * f64::sin(0.7 * f64::from(i));
            format!("{:.2}{separator}{value:.6}\n", 0.01 * f64::from(i))
        })
        .collect();
    format!("{header}\n{rows}")
}

/// The largest sample as it stands in the rows.
const PEAK: f64 = 0.298_393;

fn holds(record: &Accelerogram, unit: f64, header: &str) {
    let peak = record.peak().value / unit;
    assert!((peak - PEAK).abs() < 1e-3, "{header}: {peak}");
}

#[test]
fn two_units_of_a_column_are_refused() {
    for header in [
        "Time[s] Acc[g] (original record in cm/s2)",
        "Acc in g (original record in cm/s2)",
        "Time[s] Acc[g] (cm/s2)",
        "time [s],acc [g] (cm/s2)",
        "time (s),acc (g) [cm/s2]",
        "time_s,acc_g (gal)",
        "# time (s), acc (g) [gal]",
        "Time (s)  Roof acc (g) (cm/s2)",
    ] {
        let text = columns(header);
        let said = read(&text, None).unwrap_err();
        assert!(
            said.starts_with("f:1:1: two units, g and cm/s2,") && said.contains("--unit"),
            "{header}: {said}"
        );
        assert!(read(&text, Some(AccelerationUnit::MilliGravity)).is_err());
        // Whoever says which one is right knows it.
        let unit = AccelerationUnit::StandardGravity;
        let record = read(&text, Some(unit)).unwrap_or_else(|e| panic!("{header}: {e}"));
        holds(&record, unit.in_si(), header);
        let record = read(&text, Some(AccelerationUnit::Gal)).unwrap();
        holds(&record, 0.01, header);
    }
}

#[test]
fn one_unit_twice_and_units_of_others_are_read() {
    for (header, unit) in [
        ("Time [s] Acc [g] (g)", 9.80665),
        ("time_s,acc_gal (cm/s2)", 0.01),
        ("time (s),a_g (cm/s2)", 0.01),
        ("# PGA [g] (cm/s2): 0.3 (294)\nTime (s),Acc (g)", 9.80665),
        (
            "# velocity (m/s), acceleration (g)\ntime (s),acc (g)",
            9.80665,
        ),
    ] {
        let record = read(&columns(header), None).unwrap_or_else(|e| panic!("{header}: {e}"));
        holds(&record, unit, header);
    }
}

#[test]
fn two_units_of_at2_are_refused() {
    let at2 = |line: &str| {
        format!(
            "PEER STRONG MOTION DATABASE RECORD\nA, B\n{line}\nNPTS= 3, DT= .01 SEC\n 0.0 0.1 -0.3\n"
        )
    };
    for line in [
        "ACCELERATION (G) TIME SERIES (CM/S2)",
        "ACCELERATION (G) TIME SERIES IN UNITS OF CM/S2",
    ] {
        let said = read(&at2(line), None).unwrap_err();
        assert!(
            said.starts_with("f:3:1: two units, g and cm/s2,") && said.contains("--unit"),
            "{said}"
        );
        let record = read(&at2(line), Some(AccelerationUnit::StandardGravity)).unwrap();
        assert!((record.peak().value - 0.3 * 9.80665).abs() < 1e-12);
    }
    for line in [
        "ACCELERATION (G) TIME SERIES (G)",
        "ACCELERATION (CM/S2) TIME SERIES IN UNITS OF GAL",
    ] {
        read(&at2(line), None).unwrap_or_else(|e| panic!("{line}: {e}"));
    }
}
