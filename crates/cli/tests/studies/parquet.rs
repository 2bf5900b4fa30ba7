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
    bench.text("sweep study.toml -o b.h5 --export runs.PARQUET");
    let text = String::from_utf8(bench.bytes("runs.csv")).unwrap();
    let mut csv = csv::Reader::from_reader(text.as_bytes());
    let names: Vec<String> = csv.headers().unwrap().iter().map(str::to_owned).collect();
    let file = std::fs::File::open(bench.path("runs.PARQUET")).unwrap();
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

/// A table that is written as CSV alone does not take such a name.
#[test]
fn tables_of_csv_refuse_the_name() {
    let bench = Bench::new(MIXED);
    for command in [
        "ida study.toml --table t.parquet",
        "gap case.toml --csv t.Parquet",
        "gap case.toml --codes-csv t.parquet",
        "compare case.toml --csv t.parquet",
    ] {
        let told = bench.complaint(command, 2);
        assert!(told.contains("written as CSV"), "{command}: {told}");
    }
}

/// More runs than a row group, chunks small enough that groups are written before the end.
fn many_short_runs() -> Bench {
    let bench = Bench::new(
        &MIXED
            .replace("runs = 60", "runs = 10000")
            .replace("chunk = 4", "chunk = 256"),
    );
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    let short = case.replace("\"6 s\"", "\"0.1 s\"");
    std::fs::write(bench.path("case.toml"), short).unwrap();
    bench
}

/// Bytes of the table that stand beside its place, in the part file of the process at work.
fn written_so_far(bench: &Bench, table: &str) -> u64 {
    let entries = std::fs::read_dir(bench.folder.path()).unwrap();
    let files = entries.map(Result::unwrap).filter(|e| {
        let name = e.file_name().into_string().unwrap();
        name.starts_with(table) && name.ends_with(".part")
    });
    files.map(|e| e.metadata().map_or(0, |m| m.len())).sum()
}

/// Row groups are written while runs are still being made. Killed then, a study leaves no table
/// under its name, and with `--resume` the table has the bytes of an undisturbed call, whatever
/// the threads, and so has the one that is written from the finished result.
#[test]
fn a_killed_study_leaves_no_half_table_and_goes_on_to_the_same() {
    let bench = many_short_runs();
    bench.text("sweep study.toml -o whole.h5 --csv whole.parquet --threads 1");
    let whole = bench.bytes("whole.parquet");
    let call = "sweep study.toml -o killed.h5 --csv killed.parquet --resume --threads 2";
    let mut kills = 0;
    while kills < 2 {
        let mut child = bench
            .command(call)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        // The first four bytes are those of every Parquet file.
        while written_so_far(&bench, "killed.parquet") <= 4 {
            assert!(
                child.try_wait().unwrap().is_none(),
                "no group before the end"
            );
            std::thread::sleep(std::time::Duration::from_micros(200));
        }
        assert!(!bench.path("killed.h5").exists());
        child.kill().unwrap();
        child.wait().unwrap();
        kills += 1;
        assert!(!bench.path("killed.parquet").exists());
        // Half a file is of no use, and named by the next call.
        for entry in std::fs::read_dir(bench.folder.path()).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "part") {
                std::fs::remove_file(path).unwrap();
            }
        }
    }
    bench.text(call);
    assert!(bench.bytes("killed.parquet") == whole);
    assert!(bench.bytes("killed.h5") == bench.bytes("whole.h5"));
    bench.text("sweep study.toml -o whole.h5 --csv again.parquet --resume");
    assert!(bench.bytes("again.parquet") == whole);
    for index in 1..=3 {
        bench.text(&format!("sweep study.toml --shard {index}/3 --into shards"));
    }
    bench.text("merge shards -o merged.h5 --csv merged.parquet");
    assert!(bench.bytes("merged.parquet") == whole);
    bench.no_part_file();
}

/// A table that cannot be written ends the study before all runs are made; none that is stored is
/// lost.
#[cfg(unix)]
#[test]
fn a_table_that_cannot_be_written_ends_the_study_early() {
    let bench = many_short_runs();
    // Room for every piece of 256 runs, not for a row group of 8192.
    let options = "--threads 1 --store-every 1000s";
    let (code, told) = bench.with_limit(
        300,
        &format!("sweep study.toml -o a.h5 --csv a.parquet {options}"),
    );
    assert_eq!(code, Some(4), "{told}");
    assert!(told.contains("cannot write a.parquet"), "{told}");
    assert!(!bench.path("a.parquet").exists() && !bench.path("a.h5").exists());
    bench.no_part_file();
    let said = bench.text("sweep study.toml -o a.h5 --csv a.parquet --resume");
    let before: usize = said
        .split(", ")
        .find_map(|part| part.split_once(" of them stored")?.0.parse().ok())
        .unwrap();
    assert!((8192..10000).contains(&before), "{said}");
}
