//! Factors and signs in the names of plain columns.
use pounding_ground_motion::{AccelerationUnit, ReadOptions, Recording, read_all_bytes};

fn read(header: &str, separator: &str, options: &ReadOptions) -> Result<Recording, String> {
    let rows: String = (0..40)
        .map(|i| {
            let value = 0.3 * f64::sin(0.7 * f64::from(i));
            format!("{:.2}{separator}{value:.6}\n", 0.01 * f64::from(i))
        })
        .collect();
    let text = format!("{header}\n{rows}");
    read_all_bytes("f", text.as_bytes(), options)
        .map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

#[test]
fn factors_are_refused() {
    let in_g = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    let declared = ReadOptions {
        layout: Some("t,a".to_owned()),
        ..in_g.clone()
    };
    for name in [
        "Acc x10^-2 (g)",
        "Acc \u{d7} 10\u{207b}\u{b2} (g)",
        "1000*a (g)",
        "a x 1000 (g)",
        "-a (g)",
        "\u{2212}a (g)",
        "a\u{b7}10\u{b3} (g)",
        "a*-1 (g)",
        "a/9.81 (g)",
        "a/1000 (g)",
        "a x 981 (g)",
        "10 Acc (g)",
        "0.5 acc (g)",
        "log10 Acc (g)",
        "Acc squared (g)",
        "acc^2 (g)",
        "10 acc",
        "1000*a",
        "a x 1000",
        "-acc",
    ] {
        for separator in ["\t", ";"] {
            let header = format!("Time (s){separator}{name}");
            let strict = ReadOptions::default();
            for options in [&strict, &in_g] {
                let said = read(&header, separator, options).unwrap_err();
                let told =
                    format!("f:1:1: the name of the column \"{name}\" has a factor or a sign");
                assert!(said.starts_with(&told) && said.contains("layout"), "{said}");
            }
            // Who says what the columns are, and their unit, knows them.
            assert!(read(&header, separator, &declared).is_ok(), "{header}");
        }
    }
}

#[test]
fn names_without_factors_are_read() {
    for name in [
        "a (g)",
        "acc x (g)",
        "Acc x 1 (g)",
        "Acc X 101 (g)",
        "NS/2 (g)",
        "NS-1 (g)",
        "Roof 3/10 (g)",
        "Station 12 (g)",
        "max10 (g)",
        "a-b (g)",
        "H10 (g)",
        "Acc 1 (g)",
        "CH 10 Acc (g)",
        "Sensor 2 Acc (g)",
        "Acc_10 (g)",
        "010 Acc (g)",
        "2 Acc (g)",
        "Scaled acc (g)",
    ] {
        let header = format!("Time (s);{name}");
        let found = read(&header, ";", &ReadOptions::default());
        let found = found.unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(found.series[0].unit, "g", "{name}");
    }
}

#[test]
fn factors_of_times_are_refused() {
    for name in [
        "Time x 2 (s)",
        "2*Time (s)",
        "Scaled time (s)",
        "Time/2 (s)",
        "10 time (s)",
    ] {
        for separator in ["\t", ";"] {
            let header = format!("{name}{separator}Acc (g)");
            let said = read(&header, separator, &ReadOptions::default()).unwrap_err();
            let told = format!("f:1:1: the name of the column \"{name}\" has a factor or a sign");
            assert!(said.starts_with(&told) && said.contains("layout"), "{said}");
        }
    }
    // Names between blanks have several words.
    for header in ["Time (s)   10 Acc (g)", "Scaled time (s)   Acc (g)"] {
        let said = read(header, "   ", &ReadOptions::default()).unwrap_err();
        assert!(said.contains("has a factor or a sign"), "{said}");
    }
    for name in ["Time (s)", "Elapsed time (s)", "t1 (s)", "Time 1 (s)"] {
        let found = read(&format!("{name};Acc (g)"), ";", &ReadOptions::default());
        found.unwrap_or_else(|e| panic!("{name}: {e}"));
    }
}
