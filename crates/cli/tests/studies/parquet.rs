//! The table of a study as Parquet, read by a reader of its own.

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::{Field, Row};

use super::{Bench, MIXED};

/// A cell as CSV has it.
fn in_csv(field: &Field) -> String {
    match field {
        Field::Long(x) => x.to_string(),
        Field::Double(x) if x.is_nan() => String::new(),
        Field::Double(x) => format!("{x:?}"),
        Field::Str(text) => text.clone(),
        other => panic!("{other:?}"),
    }
}

/// The same names, rows and digits as in CSV.
#[test]
fn parquet_says_what_csv_says() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o a.h5 --csv runs.csv");
    bench.text("sweep study.toml -o b.h5 --export runs.parquet");
    let text = String::from_utf8(bench.bytes("runs.csv")).unwrap();
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    let file = std::fs::File::open(bench.path("runs.parquet")).unwrap();
    let reader = SerializedFileReader::new(file).unwrap();
    let rows: Vec<Row> = reader
        .get_row_iter(None)
        .unwrap()
        .map(Result::unwrap)
        .collect();
    let lines: Vec<csv::StringRecord> = csv.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), lines.len());
    assert!(rows.len() >= 60);
    for (row, line) in rows.iter().zip(&lines) {
        let cells: Vec<(&String, String)> =
            row.get_column_iter().map(|(n, f)| (n, in_csv(f))).collect();
        assert!(cells.iter().map(|c| c.0).eq(names.iter()));
        assert!(
            cells.iter().map(|c| c.1.as_str()).eq(line.iter()),
            "{line:?}"
        );
    }
    bench.no_part_file();
}
