//! What a study stores of each run: some quantities, in 32 bits if it says so.

use std::process::Command;

use super::{Bench, MIXED, root};

/// The study with three quantities, one of them of levels, one of storeys, one of runs.
fn chosen(numbers: &str) -> String {
    MIXED.replace(
        "isolated_demand = true",
        &format!(
            "quantities = [\"energy_input\", \"peak_force\", \"peak_displacement\"]\n{numbers}"
        ),
    )
}

fn numbers(bench: &Bench, file: &str, name: &str) -> Vec<f64> {
    let file = hdf5::File::open(bench.path(file)).unwrap();
    file.dataset(name).unwrap().read_raw().unwrap()
}

/// Against the study that stores everything.
#[test]
fn quantities_are_chosen_and_have_the_values_of_all() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o all.h5 --csv all.csv");
    bench.study(&chosen(""));
    bench.text("sweep study.toml -o some.h5 --csv some.csv");
    for name in ["energy_input", "peak_force", "peak_displacement", "gap"] {
        let bits = |file| {
            let numbers = numbers(&bench, file, name).into_iter();
            numbers.map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(bits("some.h5"), bits("all.h5"), "{name}");
    }
    let file = hdf5::File::open(bench.path("some.h5")).unwrap();
    for name in ["impacts", "isolated_demand", "energy_impact"] {
        assert!(!file.link_exists(name), "{name}");
    }
    let table = String::from_utf8(bench.bytes("some.csv")).unwrap();
    let header = table.lines().next().unwrap();
    assert!(
        header.contains("peak_force: ") && !header.contains("impacts"),
        "{header}"
    );
    bench.text("report some.h5 -o some.html");
    // Shards of it merge into the same bytes.
    for index in 1..=3 {
        bench.text(&format!("sweep study.toml --shard {index}/3 --into shards"));
    }
    bench.text("merge shards -o merged.h5 --csv merged.csv");
    assert!(bench.bytes("merged.h5") == bench.bytes("some.h5"));
    assert!(bench.bytes("merged.csv") == bench.bytes("some.csv"));
}

/// What the run without gaps gives is stored where it is asked for, by its key or by names, to the same bytes in shards; and
/// no variable has such a name.
#[test]
fn peaks_without_pounding_are_stored_as_asked() {
    let with = |output: &str| MIXED.replace("isolated_demand = true", output);
    let bench = Bench::new(&with("isolated_demand = true\nisolated_peaks = true"));
    bench.text("sweep study.toml -o all.h5 --csv all.csv --threads 1");
    for index in 1..=3 {
        bench.text(&format!("sweep study.toml --shard {index}/3 --into shards"));
    }
    bench.text("merge shards -o merged.h5 --csv merged.csv");
    assert!(bench.bytes("merged.h5") == bench.bytes("all.h5"));
    assert!(bench.bytes("merged.csv") == bench.bytes("all.csv"));
    bench.text("sweep study.toml -o all.h5 --resume --csv again.csv");
    assert!(bench.bytes("again.csv") == bench.bytes("all.csv"));
    bench.text("report all.h5 -o all.html");
    let (with_pounding, without) = (
        numbers(&bench, "all.h5", "peak_storey_shear"),
        numbers(&bench, "all.h5", "isolated_peak_storey_shear"),
    );
    assert_eq!(without.len(), 60 * 6);
    let raised = with_pounding.iter().zip(&without).filter(|(a, b)| a > b);
    assert!(raised.count() > 60);
    // By the key beside chosen quantities, by a name alone, and by neither.
    for (output, stored) in [
        (
            "quantities = [\"impacts\"]\nisolated_peaks = true",
            [true, true, false],
        ),
        (
            "quantities = [\"isolated_peak_storey_shear\"]",
            [true, false, false],
        ),
        ("", [false; 3]),
    ] {
        bench.study(&with(output));
        bench.text("sweep study.toml -o some.h5");
        let file = hdf5::File::open(bench.path("some.h5")).unwrap();
        let names = [
            "isolated_peak_storey_shear",
            "isolated_peak_displacement",
            "isolated_demand",
        ];
        assert_eq!(names.map(|name| file.link_exists(name)), stored, "{output}");
        drop(file);
        if stored[0] {
            let some = numbers(&bench, "some.h5", names[0]);
            assert!(
                some.iter()
                    .map(|x| x.to_bits())
                    .eq(without.iter().map(|x| x.to_bits()))
            );
        }
        bench.text("report some.h5 -o some.html");
    }
    bench.study(&with("isolated_peaks = \"yes\""));
    let told = bench.complaint("sweep study.toml", 2);
    assert!(told.contains("`isolated_peaks` must"), "{told}");
    bench.study(&with("").replace("name = \"mass\"", "name = \"isolated_peak_drift_ratio\""));
    let told = bench.complaint("sweep study.toml", 2);
    assert!(told.contains("isolated_peak_drift_ratio"), "{told}");
}

/// Every value is that of 64 bits, rounded once; coordinates stay as they are.
#[test]
fn numbers_of_32_bits_are_those_of_64_rounded() {
    let bench = Bench::new(&chosen(""));
    bench.text("sweep study.toml -o long.h5");
    bench.study(&chosen("numbers = \"float32\""));
    bench.text("sweep study.toml -o short.h5 --csv short.csv --threads 1");
    let file = hdf5::File::open(bench.path("short.h5")).unwrap();
    for name in ["energy_input", "peak_force", "peak_displacement"] {
        let data = file.dataset(name).unwrap();
        assert!(data.dtype().unwrap().is::<f32>(), "{name}");
        let short: Vec<f32> = data.read_raw().unwrap();
        let long = numbers(&bench, "long.h5", name);
        let rounded: Vec<u32> = long.iter().map(|x| (*x as f32).to_bits()).collect();
        assert!(short.iter().map(|x| x.to_bits()).eq(rounded), "{name}");
    }
    assert!(file.dataset("gap").unwrap().dtype().unwrap().is::<f64>());
    drop(file);
    for index in 1..=4 {
        bench.text(&format!("sweep study.toml --shard {index}/4 --into shards"));
    }
    bench.text("merge shards -o merged.h5 --csv merged.csv");
    assert!(bench.bytes("merged.h5") == bench.bytes("short.h5"));
    assert!(bench.bytes("merged.csv") == bench.bytes("short.csv"));
    // Interrupted and resumed: from the stored runs, too.
    bench.text("sweep study.toml -o short.h5 --resume --csv again.csv");
    assert!(bench.bytes("again.csv") == bench.bytes("short.csv"));
    bench.text("sweep study.toml -o short.h5 --resume --csv short.parquet");
    let table = bench.path("short.parquet");
    use parquet::file::reader::{FileReader, SerializedFileReader};
    let reader = SerializedFileReader::new(std::fs::File::open(table).unwrap()).unwrap();
    let schema = reader.metadata().file_metadata().schema_descr();
    let types = schema
        .columns()
        .iter()
        .map(|c| (c.name(), c.physical_type()));
    let forces: Vec<_> = types
        .filter(|(name, _)| name.starts_with("peak_force"))
        .collect();
    assert!(!forces.is_empty());
    assert!(
        forces
            .iter()
            .all(|(_, t)| *t == parquet::basic::Type::FLOAT),
        "{forces:?}"
    );
}

#[test]
fn quantities_that_cannot_be_chosen_are_refused() {
    let bench =
        Bench::new(&MIXED.replace("isolated_demand = true", "quantities = [\"peak_forse\"]"));
    let told = bench.complaint("sweep study.toml", 2);
    assert!(told.contains("did you mean peak_force?"), "{told}");
    bench.study(&MIXED.replace("isolated_demand = true", "quantities = []"));
    let told = bench.complaint("sweep study.toml", 2);
    assert!(told.contains("not empty"), "{told}");
    bench.study(&MIXED.replace("isolated_demand = true", "numbers = \"float16\""));
    let told = bench.complaint("sweep study.toml", 2);
    assert!(told.contains("float32"), "{told}");
    // Of quantities that exist, but not here, it is said.
    bench.study(&MIXED.replace(
        "isolated_demand = true",
        "quantities = [\"impacts\", \"peak_rotation\"]",
    ));
    let told = bench.text("sweep study.toml -o some.h5");
    assert!(
        told.contains("peak_rotation, which no building, gap or link"),
        "{told}"
    );
}

/// xarray reads what is asked for alone, and DuckDB the columns and rows of a query, from a
/// Parquet table of several row groups.
#[test]
fn large_results_are_read_in_parts_by_python() {
    let Some(python) = std::env::var_os("POUNDING_PYTHON") else {
        return;
    };
    let bench = Bench::new(&chosen("numbers = \"float32\""));
    // Short, so that there can be more runs than in a row group.
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    std::fs::write(
        bench.path("case.toml"),
        case.replace("\"6 s\"", "\"0.1 s\""),
    )
    .unwrap();
    bench.study(
        &chosen("numbers = \"float32\"")
            .replace("runs = 60", "runs = 9000")
            .replace("chunk = 4", "chunk = 256"),
    );
    bench.text("sweep study.toml -o out.h5 --csv out.parquet");
    let output = Command::new(python)
        .arg(root().join("tests/python/read_in_parts.py"))
        .args([bench.path("out.h5"), bench.path("out.parquet")])
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
}

/// `-vv` tells of every run with its number and the time it took, in any order; no bit changes.
#[test]
fn an_account_of_every_run() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o quiet.h5");
    let output = bench.run("-vv sweep study.toml -o told.h5 --threads 2");
    let account = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{account}");
    for run in 0..60 {
        let of_run = |line: &str| {
            line.contains(&format!("study_run{{number={run}}}: "))
                && line.contains("close time.busy=")
        };
        assert_eq!(account.lines().filter(|l| of_run(l)).count(), 1, "{run}");
    }
    assert!(bench.bytes("told.h5") == bench.bytes("quiet.h5"));
}

/// A case and a study in one folder leave a result each, and neither takes the other's place, by
/// whatever name.
#[test]
fn results_of_runs_and_of_studies_stay_apart() {
    let bench = Bench::new(&MIXED.replace("runs = 60", "runs = 8"));
    let folder = bench.path("").canonicalize().unwrap();
    let folder = folder.file_name().unwrap().to_str().unwrap();
    let (of_run, of_study) = (format!("{folder}.h5"), format!("{folder}.study.h5"));
    // The same again takes the place of its own, also after a change of the file.
    for _ in 0..2 {
        bench.text("run case.toml");
        bench.text("sweep study.toml");
        bench.study(&MIXED.replace("runs = 60", "runs = 9"));
    }
    let (run, study) = (bench.bytes(&of_run), bench.bytes(&of_study));
    for (command, standing, word) in [
        (
            format!("run case.toml -o {of_study}"),
            &of_study,
            "result of a study (study.toml)",
        ),
        (
            format!("sweep study.toml -o {of_run}"),
            &of_run,
            "result of a run (case.toml)",
        ),
        (
            format!("sweep study.toml -o {of_run} --resume"),
            &of_run,
            "result of a run",
        ),
        (
            format!("merge {of_study} -o {of_run}"),
            &of_run,
            "result of a run",
        ),
    ] {
        let told = bench.complaint(&command, 4);
        for word in [word, standing.as_str(), "--output", "move it away"] {
            assert!(told.contains(word), "{command}: {told}");
        }
    }
    // Files of other folders whose results have the same name.
    for (file, other) in [("case.toml", &of_run), ("study.toml", &of_study)] {
        let inside = bench.path("inside").join(folder);
        std::fs::create_dir_all(&inside).unwrap();
        for name in ["case.toml", "study.toml"] {
            std::fs::copy(bench.path(name), inside.join(name)).unwrap();
        }
        let verb = if file == "case.toml" { "run" } else { "sweep" };
        let command = format!("{verb} inside/{folder}/{file}");
        let told = bench.complaint(&command, 4);
        assert!(
            told.contains(&format!("({file})")) && told.contains("--output"),
            "{told}"
        );
        // What the user has named is replaced, but not without a word.
        std::fs::copy(bench.path(other), bench.path("named.h5")).unwrap();
        let output = bench.run(&format!("{command} -o named.h5"));
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{told}");
        assert!(
            told.contains("note: named.h5") && told.contains("will be replaced"),
            "{told}"
        );
        std::fs::remove_file(bench.path("named.h5")).unwrap();
    }
    assert!(bench.bytes(&of_run) == run && bench.bytes(&of_study) == study);
    bench.no_part_file();
}

/// A name that a spreadsheet would compute is a text in tables, and is found again.
#[test]
fn names_in_tables_are_no_formulas() {
    let bench = Bench::new(
        r#"
case = "case.toml"
[[variable]]
name = "record"
records = ["=1+1.csv", "-2.csv"]
"#,
    );
    let case = std::fs::read_to_string(bench.path("case.toml")).unwrap();
    std::fs::write(
        bench.path("case.toml"),
        case.replace("\"light\"", "\"=light\""),
    )
    .unwrap();
    let record = root().join("ground_motions/el_centro_1940_ns.csv");
    for name in ["=1+1.csv", "-2.csv"] {
        std::fs::copy(&record, bench.path(name)).unwrap();
    }
    bench.text("sweep study.toml --csv runs.csv -o out.h5");
    bench.run("gap case.toml --points 3 --csv gap.csv");
    bench.text("motion info ./=1+1.csv --csv info.csv");
    let mut texts = 0;
    for name in ["runs.csv", "gap.csv", "info.csv"] {
        let text = String::from_utf8(bench.bytes(name)).unwrap();
        for cell in text.lines().flat_map(|line| line.split(',')) {
            assert!(!cell.starts_with(['=', '+', '@']), "{name}: {cell}");
            let negative = cell.starts_with('-');
            assert!(!negative || cell.parse::<f64>().is_ok(), "{name}: {cell}");
            texts += usize::from(cell.starts_with('\''));
        }
    }
    assert!(texts > 2, "{texts}");
}
