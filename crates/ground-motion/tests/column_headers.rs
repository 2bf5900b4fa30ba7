//! Names, units and decimal signs of plain columns: read where one reading fits, refused
//! where two do.
use pounding_ground_motion::processing::rotate;
use pounding_ground_motion::{
    AccelerationUnit, Accelerogram, GroundMotionError, ReadOptions, read_bytes,
};

const G: f64 = 9.80665;

fn read(text: &str) -> Result<Accelerogram, GroundMotionError> {
    read_bytes("r.csv", text.as_bytes(), &ReadOptions::default())
}

/// Five samples at 0.02 s.
const TIMES: [f64; 5] = [0.0, 0.02, 0.04, 0.06, 0.08];
const VALUES: [f64; 5] = [0.0, 0.25, -1.5, 0.125, 10.0];

/// Rows of times and values with a decimal sign and a separator.
fn rows(decimal: char, separator: &str) -> String {
    let number = |x: f64, digits| format!("{x:.digits$}").replace('.', &decimal.to_string());
    let row = |(t, a): (&f64, &f64)| format!("{}{separator}{}\n", number(*t, 2), number(*a, 3));
    TIMES.iter().zip(&VALUES).map(row).collect()
}

fn hold(text: &str, unit: f64) {
    let record = read(text).unwrap_or_else(|e| panic!("{text}: {e} ({:?})", e.help()));
    assert_eq!(record.time_step(), 0.02, "{text}");
    assert_eq!(record.samples().len(), VALUES.len(), "{text}");
    for (a, b) in record.samples().iter().zip(&VALUES) {
        assert!(
            (a - b * unit).abs() <= 1e-15 * b.abs() * unit,
            "{text}: {a} {b}"
        );
    }
}

#[test]
fn units_in_column_names() {
    for (header, unit) in [
        ("time_s,acceleration_g", G),
        ("time_s,acceleration_m_s2", 1.0),
        ("Time_s,Acceleration_g", G),
        ("time (s),acceleration (m/s2)", 1.0),
        ("time (s), acceleration (cm/s²)", 0.01),
        ("# time (s), acceleration (g)", G),
        ("a title of the record\n\ntime (s),acceleration (g)", G),
    ] {
        hold(&format!("{header}\n{}", rows('.', ",")), unit);
    }
    for (header, separator, unit) in [
        ("t [s];a [g]", ";", G),
        ("t [s]; a [g];", "; ", G),
        ("t [s]\ta [mm/s^2]", "\t", 1e-3),
        ("t(s) a(g)", "  ", G),
    ] {
        for decimal in ['.', ','] {
            hold(&format!("{header}\n{}", rows(decimal, separator)), unit);
        }
    }
    // Exports often end every row with the separator.
    let closed = rows(',', ";").replace('\n', ";\r\n");
    hold(&format!("t [s];a [g];\r\n{closed}"), G);
    let milliseconds = "time_ms,acceleration_g\n0,0.0\n20,0.25\n40,-1.5\n60,0.125\n80,10.0\n";
    hold(milliseconds, G);
}

#[test]
fn decimal_commas_without_a_header() {
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    for separator in [";", "; ", "\t"] {
        let text = rows(',', separator);
        let record = read_bytes("r", text.as_bytes(), &options).unwrap();
        assert_eq!((record.time_step(), record.samples().len()), (0.02, 5));
        assert!((record.samples()[2] + 1.5 * G).abs() < 1e-14);
    }
}

/// Whole numbers between commas are no decimal commas where a header names them.
#[test]
fn whole_numbers_between_commas() {
    let record = read("time (s),acceleration (cm/s2)\n0,0\n1,5\n2,-3\n").unwrap();
    assert_eq!(record.time_step(), 1.0);
    assert_eq!(record.samples(), [0.0, 0.05, -0.03]);
}

#[test]
fn components_of_a_header() {
    let text = "time (s),NS (g),EW (g),v (m/s)\n0.00,0.1,0.2,9.0\n0.02,0.3,0.4,9.0\n";
    let options = |component: &str| ReadOptions {
        component: Some(component.to_owned()),
        ..ReadOptions::default()
    };
    let record = read_bytes("r", text.as_bytes(), &options("EW")).unwrap();
    assert_eq!(record.samples(), [0.2 * G, 0.4 * G]);
    assert!(matches!(
        read(text),
        Err(GroundMotionError::AmbiguousSeries { .. })
    ));
}

/// What could be read in two ways is refused with its place, and says what to do.
#[test]
fn two_readings_are_refused() {
    for (text, place, word) in [
        // Commas between the columns and within the numbers.
        (
            "time_s,acceleration_g\n0,00,0,5\n0,02,0,6\n",
            "r.csv:2:1: ",
            "within numbers",
        ),
        (
            "time (s),acceleration (g)\n0,00,0,5\n0,02,0,6\n",
            "r.csv:2:2: ",
            "decimal commas",
        ),
        (
            "t [s];a [g]\n0,00,0,5\n0,02,0,6\n",
            "r.csv:2:2: ",
            "decimal commas",
        ),
        ("t [s];a [g]\n0,5\n1,6\n", "r.csv:2:2: ", "decimal commas"),
        // Both signs, or a sign for thousands.
        (
            "t [s];a [g]\n0,00;0,5\n0,02;1.5\n",
            "r.csv:2:2: ",
            "line 3 has a decimal point",
        ),
        (
            "t [s];a [cm/s2]\n0.00;1,234.5\n0.02;0.0\n",
            "r.csv:2:7: ",
            "line 2 has a decimal point",
        ),
        (
            "t [s];a [cm/s2]\n0,00;1,234,5\n0,02;0,0\n",
            "r.csv:2:11: ",
            "decimal commas, or",
        ),
        (
            "0,1 0,2\n0,3 0,4\n",
            "r.csv:1:2: ",
            "decimal commas, or whole numbers",
        ),
        // More or fewer columns than names.
        (
            "time (s),acceleration (g)\n0.0,0.1,0.2\n0.1,0.2,0.3\n",
            "r.csv:2:1: ",
            "names 2 columns",
        ),
        (
            "time (s),NS (g),EW (g)\n0.0,0.1\n0.1,0.2\n",
            "r.csv:2:1: ",
            "names 3 columns",
        ),
    ] {
        let error = read(text).unwrap_err();
        let shown = error.to_string();
        assert!(shown.starts_with(place), "{text}: {shown}");
        assert!(shown.contains(word), "{text}: {shown}");
        assert!(error.help().is_some(), "{text}");
    }
}

#[test]
fn contradictions_name_both() {
    let given = |text: &str, options: ReadOptions| {
        read_bytes("r.csv", text.as_bytes(), &options)
            .unwrap_err()
            .to_string()
    };
    let rows = rows('.', ",");
    for header in ["time_s,acceleration_g", "time (s),acceleration (g)"] {
        let text = format!("{header}\n{rows}");
        let unit = ReadOptions {
            unit: Some(AccelerationUnit::MetrePerSecondSquared),
            ..ReadOptions::default()
        };
        let shown = given(&text, unit);
        assert!(
            shown.contains("is g in the file but m/s2 was given"),
            "{shown}"
        );
        let keyed = format!("# Unit: m/s2\n{text}");
        let shown = given(&keyed, ReadOptions::default());
        assert!(shown.starts_with("r.csv:1:1: unit \"m/s2\""), "{shown}");
        assert!(shown.contains(header), "{shown}");
        let stepped = format!("# dt: 0.01 s\n{text}");
        let shown = given(&stepped, ReadOptions::default());
        assert!(shown.contains("0.01") && shown.contains("0.02"), "{shown}");
    }
    let step = ReadOptions {
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let shown = given(&format!("time (s),acceleration (g)\n{rows}"), step);
    assert!(
        shown.contains("0.02 s in the file but 0.01 s was given"),
        "{shown}"
    );
}

/// A unit is never guessed from a name.
#[test]
fn names_without_units() {
    for header in [
        "time,acceleration",
        "t,a",
        "t;a_g",
        "time (s),ground acceleration",
    ] {
        let error = read(&format!("{header}\n{}", rows('.', ";"))).unwrap_err();
        assert!(
            matches!(error, GroundMotionError::MissingUnit { .. }),
            "{header}: {error}"
        );
    }
}

/// A name of a component with its unit behind an underscore is one in brackets.
#[test]
fn components_behind_underscores() {
    let text = "time_s,ns_g,ew_g\n0.00,0.1,0.2\n0.02,0.3,0.4\n";
    let error = read(text).unwrap_err();
    let shown = error.to_string();
    assert!(shown.starts_with("r.csv:1: 2 series"), "{shown}");
    assert!(
        shown.contains("acceleration ns") && shown.contains("acceleration ew"),
        "{shown}"
    );
    let help = error.help().unwrap();
    assert!(
        help.contains("`component`") && help.contains("`--component`"),
        "{help}"
    );
    let options = ReadOptions {
        component: Some("ew".to_owned()),
        ..ReadOptions::default()
    };
    let record = read_bytes("r", text.as_bytes(), &options).unwrap();
    assert_eq!(record.samples(), [0.2 * G, 0.4 * G]);
}

/// A header that cannot be used is the reason, not a unit that stands there.
#[test]
fn headers_that_cannot_be_used_say_why() {
    let rows = rows('.', ",");
    let unit = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    for (header, words, remedy, whatever_unit) in [
        (
            "time (min),acceleration (m/s2)",
            ["unit \"min\"", "\"time (min)\""],
            "s or ms",
            true,
        ),
        // Its unit is another one than that which is given.
        (
            "dt=0.02 s;a [m/s2]",
            ["column 1, \"dt=0.02 s\"", "not understood"],
            "# dt: 0.01 s",
            true,
        ),
        (
            "time_s;t (s);acceleration_g",
            ["names two columns of times", "time_s;t (s)"],
            "name one of them otherwise",
            false,
        ),
        // A component with its unit makes a header of the line, though one name is none.
        (
            "ns_g;foo",
            ["column 2, \"foo\"", "not understood"],
            "name every column",
            false,
        ),
        (
            "time_s;displacement_m",
            [
                "names no acceleration",
                "\"displacement_m\" is a displacement",
            ],
            "no unit makes",
            true,
        ),
        (
            "# t (s), v (cm/s)",
            ["names no acceleration", "is a velocity"],
            "no unit makes",
            true,
        ),
        (
            "time_s,acceleration_(furlongs)",
            ["unit \"furlongs\"", "not known"],
            "cm/s2",
            false,
        ),
    ] {
        let text = format!("a title\n{header}\n{rows}");
        let error = read(&text).unwrap_err();
        let shown = error.to_string();
        assert!(shown.starts_with("r.csv:2:1: "), "{header}: {shown}");
        for word in words {
            assert!(shown.contains(word), "{header}: {shown}");
        }
        let help = error.help().unwrap();
        assert!(help.contains(remedy), "{header}: {help}");
        let given = read_bytes("r.csv", text.as_bytes(), &unit);
        assert_eq!(given.is_err(), whatever_unit, "{header}");
    }
    // A layout says what the columns are, but makes no acceleration of a displacement.
    let layout = |header: &str| {
        let options = ReadOptions {
            layout: Some("-,a".to_owned()),
            time_step: Some(0.02),
            ..unit.clone()
        };
        let text = format!("{header}\n{rows}");
        read_bytes("r.csv", text.as_bytes(), &options).map(|r| r.time_step())
    };
    assert_eq!(layout("time (min),acceleration (g)").unwrap(), 0.02);
    assert!(layout("time_s;displacement_m").is_err());
    // Prose before the rows says nothing of columns.
    let prose = format!("Kobe, velocity and displacement of 1995\n{rows}");
    assert!(read_bytes("r.csv", prose.as_bytes(), &unit).is_ok());
    assert!(matches!(
        read(&prose),
        Err(GroundMotionError::MissingUnit { .. })
    ));
}

/// One column keeps its name as two do; a name that says no more than that it is an acceleration
/// is none.
#[test]
fn the_name_of_a_single_column_is_kept() {
    let of = |header: &str, component: Option<&str>| {
        let options = ReadOptions {
            component: component.map(str::to_owned),
            ..ReadOptions::default()
        };
        let text = format!("{header}\n{}", rows('.', ","));
        read_bytes("r.csv", text.as_bytes(), &options)
    };
    let name = |of: &Accelerogram| of.origin().unwrap().component.clone();
    for (header, component) in [
        ("t (s),NS (g)", "NS"),
        ("time_s,ns_g", "ns"),
        ("t (s),UD (g)", "UD"),
        ("t (s),v (g)", "v"),
        ("time_s,acc_x_g", "acc_x"),
        ("time (s),Acceleration (g)", "a"),
        ("t [s],acc [g]", "a"),
        ("t [s],a [g]", "a"),
        ("t [s],Ground acceleration [g]", "a"),
        ("t [s],row [g]", "a"),
    ] {
        let read = of(header, None).unwrap_or_else(|e| panic!("{header}: {e}"));
        assert_eq!(name(&read), component, "{header}");
        assert_eq!(name(&of(header, Some(component)).unwrap()), component);
    }
    // A series along the rows, without times.
    let options = ReadOptions {
        time_step: Some(0.02),
        ..ReadOptions::default()
    };
    for (header, component) in [("NS (g)", "NS"), ("acceleration (g)", "a")] {
        let text = format!("{header}\n0.1 0.2 0.3\n0.4 0.5 0.1\n");
        let read = read_bytes("r.csv", text.as_bytes(), &options).unwrap();
        assert_eq!((name(&read).as_str(), read.samples().len()), (component, 6));
    }
    // The names say directions.
    let north = of("t (s),NS (g)", None).unwrap();
    let east = of("t (s),EW (g)", None).unwrap();
    rotate(&north, &east, 30.0).unwrap();
    let up = of("t (s),UD (g)", None).unwrap();
    let error = rotate(&north, &up, 30.0).unwrap_err().to_string();
    assert!(error.contains("\"UD\" (vertical)"), "{error}");
}

/// A velocity or a displacement that a line before the rows names was taken for an acceleration
/// where a unit was given.
#[test]
fn lines_that_name_another_quantity() {
    let read = |text: &str, layout: Option<&str>, time_step: Option<f64>| {
        let options = ReadOptions {
            unit: Some(AccelerationUnit::Gal),
            layout: layout.map(str::to_owned),
            time_step,
            ..ReadOptions::default()
        };
        read_bytes("f", text.as_bytes(), &options)
    };
    let one: String = (0..12)
        .map(|i| format!("{:.4}\n", (f64::from(i)).sin()))
        .collect();
    for line in [
        "Velocity (cm/s)",
        "# Velocity [cm/s]",
        "vel [m/s]",
        "velocity_m_s",
        "Displacement (cm)",
        "Velocity",
        "NS (cm/s)",
        "Velocity, cm/s",
        "EL CENTRO NS VELOCITY CM/SEC",
        "EL CENTRO NS VELOCITY, IN CM/SEC, DT = 0.01",
        "Velocity (cm/s2)",
        "Acceleration (cm/s)",
        "CORRECTED VELOCITY TIME HISTORY",
    ] {
        for layout in [None, Some("a")] {
            let text = format!("El Centro\n{line}\n{one}");
            let Err(error) = read(&text, layout, Some(0.01)) else {
                panic!("{line}");
            };
            let start = format!("f:2:1: the header \"{line}\" names no acceleration");
            assert!(error.to_string().starts_with(&start), "{line}: {error}");
        }
    }
    let two: String = (0..12)
        .map(|i| format!("{:.2} {:.4}\n", 0.01 * f64::from(i), (f64::from(i)).sin()))
        .collect();
    for line in ["time velocity", "t vel"] {
        let error = read(&format!("{line}\n{two}"), None, None).unwrap_err();
        assert!(
            error.to_string().contains("names no acceleration"),
            "{error}"
        );
    }
    // Titles that speak of another velocity, or of all three, name nothing of the values.
    for line in [
        "El Centro, shear wave velocity 200 m/s",
        "Station on rock, velocity of 800 m/s",
        "average shear-wave velocity (m/s)",
        "peak velocity (cm/s)",
        "Vs30 = 309 m/s",
        "Acceleration, velocity and displacement: cm, s",
        "the velocity at the end is zero",
        "Velocity Street, Building 5",
        "Acceleration (cm/s2)",
        "EL CENTRO NS ACCELERATION CM/SEC2",
    ] {
        let record = read(&format!("{line}\n{one}"), None, Some(0.01)).unwrap();
        assert_eq!(record.samples().len(), 12, "{line}");
    }
}

/// Bars part the cells of rows, with blanks beside them or without.
#[test]
fn bars_between_numbers() {
    let rows = |separator: &str, edge: &str| -> String {
        (0..40)
            .map(|i| {
                let value = 0.3 * f64::sin(0.7 * f64::from(i));
                format!(
                    "{edge}{:.2}{separator}{value:.6}{edge}\n",
                    0.01 * f64::from(i)
                )
            })
            .collect()
    };
    for text in [
        format!("time (s)|acc (g)\n{}", rows("|", "")),
        format!("|time (s)|acc (g)|\n{}", rows("|", "|")),
        format!("|time (s)|acc (g)|\n|---|---|\n{}", rows("|", "|")),
        format!("| time (s) | acc (g) |\n|---|---|\n{}", rows(" | ", "| ")),
        format!("# unit: g\n{}", rows("|", "")),
    ] {
        let record = read(&text).unwrap_or_else(|e| panic!("{text:.60}: {e}"));
        assert_eq!(record.samples().len(), 40, "{text:.60}");
        assert!((record.peak().value / 9.806_65 - 0.298_393).abs() < 1.0e-9);
        assert!((record.time_step() - 0.01).abs() < 1.0e-12);
    }
}
