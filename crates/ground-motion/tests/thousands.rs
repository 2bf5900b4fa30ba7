//! Separators of thousands in plain columns, which would pass for decimal signs.
use pounding_ground_motion::{ReadOptions, Recording, read_all_bytes};

fn read(text: &str) -> Result<Recording, String> {
    let options = ReadOptions::default();
    let found = read_all_bytes("f", text.as_bytes(), &options);
    found.map_err(|e| format!("{e}; {}", e.help().unwrap_or_default()))
}

/// 60 whole numbers up to some 2700, as a spreadsheet prints them with a separator.
fn printed(separator: &str) -> Vec<String> {
    (0..60)
        .map(|i| {
            let value = (2700.0 * f64::sin(0.1 * f64::from(i))) as i64;
            let (sign, size) = (if value < 0 { "-" } else { "" }, value.abs());
            match size {
                1000.. => format!("{sign}{}{separator}{:03}", size / 1000, size % 1000),
                _ => format!("{sign}{size}"),
            }
        })
        .collect()
}

fn table(header: &str, values: &[String], row: impl Fn(usize, &str) -> String) -> String {
    let rows = values.iter().enumerate().map(|(i, v)| row(i, v) + "\n");
    format!("{header}\n{}", rows.collect::<String>())
}

#[test]
fn whole_numbers_with_separators_are_refused() {
    let (comma, point) = (printed(","), printed("."));
    for text in [
        table("t (ms),a (mm/s2)", &comma, |i, v| {
            format!("{},\"{v}\"", 10 * i)
        }),
        table("t (ms);a (mm/s2)", &comma, |i, v| format!("{};{v}", 10 * i)),
        table("t (ms)\ta (mm/s2)", &comma, |i, v| {
            format!("{}\t{v}", 10 * i)
        }),
        table("\"t (ms)\",\"a (mm/s2)\"", &comma, |i, v| {
            format!("\"{}\",\"{v}\"", 10 * i)
        }),
        table("t (ms);a (mm/s2)", &point, |i, v| format!("{};{v}", 10 * i)),
        table("t (s);a (mm/s2)", &point, |i, v| {
            format!("{:.2};{v}", 0.01 * i as f64)
        }),
        table("dt: 0.01 s\na (mm/s2)", &point, |_, v| v.to_owned()),
        table("dt: 0.01 s\nunits: mm/s2", &point, |_, v| v.to_owned()),
    ] {
        let said = read(&text).unwrap_err();
        let is_ambiguous = said.contains("\"1.051\" may be 1051") && said.contains("separators");
        // The fifth value is the first above a thousand.
        let line = text
            .lines()
            .position(|l| l.contains("1,051") || l.contains("1.051"));
        let place = format!("f:{}:", line.unwrap() + 1);
        assert!(is_ambiguous && said.starts_with(&place), "{text}: {said}");
    }
}

#[test]
fn decimals_are_read() {
    let of = |print: &dyn Fn(f64) -> String| {
        let values: Vec<String> = (0..60)
            .map(|i| print(270.0 * f64::sin(0.1 * f64::from(i))))
            .collect();
        table("t (s);a (mm/s2)", &values, |i, v| {
            format!("{:.2};{v}", 0.01 * i as f64)
        })
    };
    let prints: [&dyn Fn(f64) -> String; 5] = [
        // All have the sign.
        &|x| format!("{x:.3}"),
        // Zeros at the end, and the sign with them, are left out.
        &|x| (x * 1000.0).round().to_string() + "e-3",
        &|x| ((x * 1000.0).round() / 1000.0).to_string(),
        &|x| ((x * 20.0).round() / 1000.0).to_string(),
        &|x| format!("{x:.0}"),
    ];
    for print in prints {
        let text = of(print);
        let recording = read(&text).unwrap_or_else(|e| panic!("{text}: {e}"));
        assert_eq!(recording.series[0].samples.len(), 60);
    }
    // Few whole numbers among others show nothing.
    let pulse: Vec<String> = ["0", "0", "1.125", "2.250", "1.125", "0", "0", "0"]
        .map(str::to_owned)
        .into();
    assert!(read(&table("dt: 0.01 s\na (m/s2)", &pulse, |_, v| v.to_owned())).is_ok());
    // Larger ones without a separator.
    let mut values = printed(".");
    values[30] = "1500".to_owned();
    let text = table("dt: 0.01 s\na (mm/s2)", &values, |_, v| v.to_owned());
    assert!(read(&text).is_ok());
}
