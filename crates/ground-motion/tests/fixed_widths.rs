//! Damaged values in rows of fixed width, by `layout` and by the format that a header states.
use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_all_bytes};

/// Samples of each file.
const COUNT: usize = 800;

/// Sample `i`.
fn sample(i: usize) -> f64 {
    0.31 * f64::sin(0.37 * i as f64 + 0.1) * f64::exp(-0.004 * i as f64) + 0.001_234_5
}

/// Rows of eight values that are printed so, each in ten columns.
fn of_ten(print: impl Fn(usize) -> String) -> String {
    let values: Vec<String> = (0..COUNT).map(|i| format!("{:>10}", print(i))).collect();
    let rows = values.chunks(8);
    rows.map(|row| row.concat() + "\n").collect()
}

/// As Fortran prints F10.5.
fn in_decimals(i: usize) -> String {
    format!("{:.5}", sample(i))
}

/// Rows of five values of `5E15.7`, of which one is replaced.
fn of_fifteen(place: usize, change: impl Fn(&str) -> String) -> String {
    let value = |i: usize| {
        let text = format!("{:.7e}", sample(i));
        let (mantissa, exponent) = text.split_once('e').unwrap();
        let power: i32 = exponent.parse().unwrap();
        let sign = if power < 0 { '-' } else { '+' };
        let whole = format!("{mantissa}E{sign}{:02}", power.abs());
        match i == place {
            true => format!("{:>15}", change(&whole)),
            false => format!("{whole:>15}"),
        }
    };
    let values: Vec<String> = (0..COUNT).map(value).collect();
    let rows = values.chunks(5);
    rows.map(|row| row.concat() + "\n").collect()
}

/// The samples (m/s2), or what is said.
fn read(layout: &str, text: &str) -> Result<Vec<f64>, String> {
    let options = ReadOptions {
        layout: Some(layout.to_owned()),
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    match read_all_bytes("f", text.as_bytes(), &options) {
        Ok(found) => Ok(found.series[0].samples.clone()),
        Err(e) => Err(format!("{e}; {}", e.help().unwrap_or_default())),
    }
}

#[test]
fn points_that_are_lost() {
    // Row 26, the first of its eight values.
    let damaged = of_ten(|i| match i {
        200 => in_decimals(i).replace('.', "9"),
        i => in_decimals(i),
    });
    let said = read("8F10.5", &damaged).unwrap_err();
    assert!(said.starts_with("f:26:"), "{said}");
    assert!(said.contains("has no decimal point") && said.contains("write it with its point"));
    // Several of them, of which one is of another size, or where the format has other decimals than are printed.
    let some = |lost: fn(&str) -> String| {
        of_ten(move |i| match i {
            16 | 200 | 308 | 640 => lost(&in_decimals(i)),
            i => in_decimals(i),
        })
    };
    let replaced = some(|v| v.replace('.', "9"));
    let dropped = some(|v| v.replace('.', ""));
    for (layout, text) in [
        ("8F10.5", &replaced),
        ("8F10.4", &replaced),
        ("8F10.4", &dropped),
    ] {
        let said = read(layout, text).unwrap_err();
        assert!(said.contains("has no decimal point"), "{layout}: {said}");
    }
    // As many decimals as are printed, and the same sizes.
    let found = read("8F10.5", &dropped).unwrap();
    assert!((found[200] - sample(200)).abs() < 0.6e-5);
    let said = read("5E15.7", &of_fifteen(200, |v| v.replace('.', "0"))).unwrap_err();
    assert!(
        said.starts_with("f:41:") && said.contains("has no decimal point"),
        "{said}"
    );
}

#[test]
fn digits_that_are_lost() {
    let damaged = of_ten(|i| match i {
        200 => format!("{:.4} ", sample(i)),
        i => in_decimals(i),
    });
    let said = read("8F10.5", &damaged).unwrap_err();
    assert!(
        said.starts_with("f:26:") && said.contains("lacks a digit"),
        "{said}"
    );
    let said = read("5E15.7", &of_fifteen(200, |v| v[..v.len() - 1].to_owned())).unwrap_err();
    assert!(
        said.starts_with("f:41:") && said.contains("of its exponent"),
        "{said}"
    );
}

/// Columns count from the start of the line.
#[test]
fn places_behind_columns_that_are_skipped() {
    let damaged = of_ten(|i| match i {
        201 => in_decimals(i).replace('.', "9"),
        i => in_decimals(i),
    });
    let rows: String = damaged.lines().map(|row| format!("abc{row}\n")).collect();
    let options = ReadOptions {
        layout: Some("8F10.5".to_owned()),
        skip_columns: 3,
        unit: Some(AccelerationUnit::Gal),
        time_step: Some(0.01),
        ..ReadOptions::default()
    };
    let error = read_all_bytes("f", rows.as_bytes(), &options).unwrap_err();
    assert!(error.to_string().starts_with("f:26:14:"), "{error}");
}

#[test]
fn values_that_are_right() {
    let near = |found: &[f64]| {
        assert_eq!(found.len(), COUNT);
        let near = |(i, a): (usize, &f64)| (a - sample(i)).abs() < 0.6e-5;
        assert!(found.iter().enumerate().all(near));
    };
    near(&read("8F10.5", &of_ten(in_decimals)).unwrap());
    near(&read("5E15.7", &of_fifteen(COUNT, str::to_owned)).unwrap());
    // Decimals that the format gives, where no value has a point, and where half of them have none.
    let digits = |i: usize| format!("{:.0}", 1.0e5 * sample(i));
    near(&read("8F10.5", &of_ten(digits)).unwrap());
    let half = |i: usize| {
        if i.is_multiple_of(2) {
            digits(i)
        } else {
            in_decimals(i)
        }
    };
    near(&read("8F10.5", &of_ten(half)).unwrap());
    // Zeros in all forms.
    for zero in ["0", "0.", ".0", "0.0", "-0.0"] {
        let zeros = |i: usize| match i % 20 {
            3 => zero.to_owned(),
            _ => in_decimals(i),
        };
        let found = read("8F10.5", &of_ten(zeros)).unwrap_or_else(|e| panic!("{zero}: {e}"));
        assert_eq!(found[3], 0.0, "{zero}");
    }
}
