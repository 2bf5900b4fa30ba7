//! Threads and shards do not matter.

use super::{Bench, MIXED};

/// One call on 1, 2 and 4 threads, and 1, 3 and 7 shards merged: files of equal bytes.
#[test]
fn threads_and_shards_give_the_same_bytes() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --threads 1 -o whole.h5 --csv whole.csv");
    let (whole, table) = (bench.bytes("whole.h5"), bench.bytes("whole.csv"));
    for threads in [2, 4] {
        bench.text(&format!(
            "sweep study.toml --threads {threads} -o again.h5 --csv again.csv"
        ));
        assert!(bench.bytes("again.h5") == whole, "{threads} threads");
        assert!(bench.bytes("again.csv") == table, "{threads} threads");
    }
    // Of 17 shards two have none of the 15 chunks.
    for count in [1, 3, 7, 17] {
        let mut files = Vec::new();
        // Last first: the order of the files does not matter either.
        for index in (1..=count).rev() {
            let file = format!("shard-{index}-of-{count}.h5");
            bench.text(&format!(
                "sweep study.toml --shard {index}/{count} -o {file}"
            ));
            files.push(file);
        }
        let files = files.join(" ");
        let told = bench.text(&format!("merge {files} -o merged.h5 --csv merged.csv"));
        assert!(told.contains("60 runs, 0 of them failed"), "{told}");
        assert!(bench.bytes("merged.h5") == whole, "{count} shards");
        assert!(bench.bytes("merged.csv") == table, "{count} shards");
    }
    assert!(!bench.path("whole.h5.parts").exists());
}

#[test]
fn only_the_shards_of_one_study_merge() {
    let bench = Bench::new(MIXED);
    for (shard, file) in [
        ("1/3", "a.h5"),
        ("2/3", "b.h5"),
        ("3/3", "c.h5"),
        ("1/2", "d.h5"),
    ] {
        bench.text(&format!("sweep study.toml --shard {shard} -o {file}"));
    }
    bench.study(&MIXED.replace("seed = 3", "seed = 4"));
    bench.text("sweep study.toml --shard 3/3 -o other.h5");
    std::fs::write(bench.path("text.h5"), "no HDF5").unwrap();
    for (files, reason) in [
        ("a.h5 b.h5", "missing 3/3"),
        ("a.h5 b.h5 b.h5 c.h5", "b.h5 is shard 2/3 once more"),
        ("a.h5 b.h5 d.h5", "d.h5 is one of 2 shards"),
        ("a.h5 b.h5 other.h5", "other.h5 is of another study"),
        ("a.h5 text.h5", "it is not the result of a study"),
        ("a.h5 nowhere.h5", "No such file"),
    ] {
        let told = bench.complaint(&format!("merge {files} -o out.h5"), 2);
        assert!(told.contains(reason), "{told}");
        assert!(!bench.path("out.h5").exists());
    }
    let told = bench.complaint("sweep study.toml --shard 4/3", 2);
    assert!(told.contains("\"4/3\" is no shard"), "{told}");
}
