//! Thousands of shards are merged in little memory and with few open files, into the bytes that
//! one writer gives. `POUNDING_SHARDS=10000 POUNDING_RUNS=100 cargo test --release -p
//! pounding-study --test many_shards -- --nocapture` measures by hand.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use pounding_files::checksum::WithoutChecksum;
use pounding_results::study::{Description, ResultWriter, Row, Value};
use pounding_study::{MergeOptions, Part, ResultReader, Shard, Study, SweepOptions, merge, sweep};
use rustix::process::{Resource, Rlimit, setrlimit};

/// Files that the process may have open.
const FILES: u64 = 64;
/// Memory that merging may take (MB).
const MEMORY: usize = 200;

/// What a study of the three-storey pair says of itself.
fn description(folder: &Path) -> Description {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let root = root.canonicalize().unwrap();
    let case = root.join("examples/sweep_three_storey_pair/case.toml");
    let case = std::fs::read_to_string(case).unwrap();
    let motions = root.join("ground_motions");
    let case = case
        .replace("../../ground_motions", motions.to_str().unwrap())
        .replace("31 s", "0.1 s");
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let text = "case = \"case.toml\"\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [\"20 mm\"]\n";
    let study = Study::parse(text, &folder.join("study.toml")).unwrap();
    let output = folder.join("one.h5");
    let options = SweepOptions {
        output: output.clone(),
        csv: None,
        threads: 1,
        shard: Shard::WHOLE,
        resume: false,
        store_every: Duration::from_secs(5),
        keep_going: false,
        shared: None,
    };
    sweep(&study, &options, &mut |_| ControlFlow::Continue(())).unwrap();
    let reader = ResultReader::open(&output, WithoutChecksum::Refuse).unwrap();
    reader.description.clone()
}

/// A row that tells its run.
fn row(run: usize, columns: usize) -> (Row, Vec<Value>) {
    let row = Row {
        run,
        id: (run as u128).to_le_bytes(),
        values: (0..columns).map(|c| (run * 31 + c) as f64 / 7.0).collect(),
        ending: pounding_study::Ending::Complete,
    };
    (row, vec![Value::Number(run as f64)])
}

/// Writes runs as the result that holds this part.
fn write(path: &Path, whole: &Description, part: Part, runs: impl Iterator<Item = usize>) {
    let rows = part.rows(whole.runs, whole.chunk).unwrap();
    let description = Description {
        part,
        ..whole.clone()
    };
    let mut writer = ResultWriter::create(path, &description, rows).unwrap();
    for run in runs {
        let (row, point) = row(run, whole.layout.columns());
        writer.push(row, point).unwrap();
    }
    writer.finish().unwrap();
}

/// Most memory that the process has had since it was last forgotten (MB).
fn peak() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|l| l.starts_with("VmHWM")).unwrap();
    let number = line.split_whitespace().nth(1).unwrap();
    number.parse::<usize>().unwrap() / 1024
}

fn of_environment(key: &str, usual: usize) -> usize {
    std::env::var(key).map_or(usual, |text| text.parse().unwrap())
}

#[test]
fn memory_and_open_files_do_not_grow_with_the_shards() {
    let shards = of_environment("POUNDING_SHARDS", 300);
    let each = of_environment("POUNDING_RUNS", 10);
    let folder = tempfile::tempdir().unwrap();
    let mut whole = description(folder.path());
    // Two chunks a shard, but for the last one, which is short.
    (whole.runs, whole.chunk) = (shards * each - 1, each.div_ceil(2));
    let file = |name: String| folder.path().join(name);
    let began = Instant::now();
    let mut files: Vec<PathBuf> = Vec::new();
    for shard in 1..=shards {
        let path = file(format!("{shard}.h5"));
        let chunk = whole.chunk;
        let runs = (0..whole.runs).filter(|run| run / chunk % shards == shard - 1);
        // Not by looking at every run where there are a million.
        let starts = ((shard - 1) * chunk..whole.runs).step_by(shards * chunk);
        let dealt = starts.flat_map(|start| start..(start + chunk).min(whole.runs));
        if shard < 4 {
            assert!(runs.eq(dealt.clone()));
        }
        write(&path, &whole, Part::of(vec![shard], shards).unwrap(), dealt);
        files.push(path);
    }
    println!("{shards} shards written in {:.1?}", began.elapsed());
    let one = file("one writer.h5".to_owned());
    write(&one, &whole, Part::whole(), 0..whole.runs);
    setrlimit(
        Resource::Nofile,
        Rlimit {
            current: Some(FILES),
            maximum: Some(FILES),
        },
    )
    .unwrap();
    // Forgets the most that there was.
    std::fs::write("/proc/self/clear_refs", "5").unwrap();
    let (before, began) = (peak(), Instant::now());
    let merged = file("merged.h5".to_owned());
    let report = merge(&files, &merged, None, MergeOptions::default()).unwrap();
    let after = peak();
    println!(
        "{} runs merged in {:.1?}: {after} MB at most, {before} MB before, {FILES} open files allowed",
        report.runs,
        began.elapsed()
    );
    assert_eq!(report.runs, whole.runs);
    assert!(after < MEMORY, "{after} MB");
    // In a tree: halves first.
    let partial = MergeOptions {
        partial: true,
        ..MergeOptions::default()
    };
    let (left, right) = files.split_at(shards / 3);
    let halves = [file("left.h5".to_owned()), file("right.h5".to_owned())];
    for (half, files) in halves.iter().zip([left, right]) {
        merge(files, half, None, partial).unwrap();
    }
    let tree = file("tree.h5".to_owned());
    merge(&halves, &tree, None, MergeOptions::default()).unwrap();
    let bytes = |path: &Path| std::fs::read(path).unwrap();
    assert!(bytes(&merged) == bytes(&one));
    assert!(bytes(&tree) == bytes(&one));
}
