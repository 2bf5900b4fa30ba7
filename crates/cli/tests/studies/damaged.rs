//! Files that were damaged, cut or changed after they were written: refused before the HDF5
//! library parses them. What it parses, it parses in a child process: a checksum that matches can
//! be written by anybody. Files without one, as earlier versions wrote them, are read with a
//! warning.

use std::io::Cursor;
use std::path::Path;

use hdf5::types::VarLenUnicode;
use pounding_files::checksum::{LENGTH, append, check_content};
use serde_json::Value;

use super::{Bench, MIXED};
use crate::support::edit;

const SHARDS: &str = "1.h5 2.h5 3.h5";

/// A result, `run.h5`, and three shards of a study.
fn bench() -> Bench {
    let bench = Bench::new(MIXED);
    bench.text("run case.toml -o run.h5");
    for shard in 1..=3 {
        bench.text(&format!("sweep study.toml --shard {shard}/3 -o {shard}.h5"));
    }
    bench
}

/// Knuth's generator: the same damage each time.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % limit
    }

    /// One bit.
    fn flip(&mut self, bytes: &mut [u8]) {
        let at = self.below(bytes.len());
        bytes[at] ^= 1 << self.below(8);
    }

    /// A few runs of bytes with others, zeros or ones.
    fn corrupt(&mut self, bytes: &mut [u8]) {
        let before = bytes.to_vec();
        while bytes == before {
            for _ in 0..=self.below(4) {
                let at = self.below(bytes.len());
                let end = (at + 1 + self.below(24)).min(bytes.len());
                let with = [None, Some(0), Some(0xff)][self.below(3)];
                for byte in &mut bytes[at..end] {
                    *byte = with.unwrap_or_else(|| self.below(256) as u8);
                }
            }
        }
    }
}

/// What an earlier version would have written: no checksum, and nothing that asks for one.
fn without_checksum(path: &Path) {
    edit(path, |file| file.delete_attr("checksum").unwrap());
}

/// The same, with a checksum of what it is now.
fn edit_with_checksum(path: &Path, change: impl FnOnce(&hdf5::File)) {
    edit(path, change);
    append(path).unwrap();
}

/// 2,000 flipped bits and 1,000 runs of other bytes, in a result and in a shard.
#[test]
fn no_damage_passes_the_checksum() {
    let bench = bench();
    let mut random = Random(1);
    for name in ["run.h5", "2.h5"] {
        let whole = bench.bytes(name);
        assert!(check_content(&mut Cursor::new(&whole)).is_ok());
        for number in 0..1500 {
            let mut bytes = whole.clone();
            match number < 1000 {
                true => random.flip(&mut bytes),
                false => random.corrupt(&mut bytes),
            }
            let found = check_content(&mut Cursor::new(&bytes));
            assert!(found.is_err(), "{name} {number}: {found:?}");
        }
    }
}

#[test]
fn damaged_files_are_refused() {
    let bench = bench();
    let mut random = Random(2);
    for number in 0..12 {
        for (name, command) in [
            ("run.h5", "report run.h5 -o out.html".to_owned()),
            ("2.h5", format!("merge {SHARDS} -o out.h5")),
        ] {
            let whole = bench.bytes(name);
            let mut bytes = whole.clone();
            match number {
                0 => bytes.truncate(whole.len() - LENGTH),
                1 => bytes.truncate(whole.len() / 2),
                2 => bytes.push(b'\n'),
                3..8 => random.flip(&mut bytes),
                _ => random.corrupt(&mut bytes),
            }
            std::fs::write(bench.path(name), &bytes).unwrap();
            let told = bench.complaint(&command, 2);
            let word = match number {
                0 => "its checksum is missing",
                _ => "it is damaged",
            };
            assert!(
                told.contains(word) && told.contains(name),
                "{number} {told}"
            );
            assert!(!bench.path("out.html").exists() && !bench.path("out.h5").exists());
            std::fs::write(bench.path(name), &whole).unwrap();
        }
    }
    bench.text("report run.h5 -o out.html");
    bench.text(&format!("merge {SHARDS} -o out.h5"));
}

/// Another program that opens a file for writing takes the checksum away, even if it
/// changes nothing.
#[test]
fn a_file_that_was_opened_for_writing_is_refused() {
    let bench = bench();
    edit(&bench.path("run.h5"), |_| ());
    let told = bench.complaint("report run.h5", 2);
    assert!(
        told.contains("opened for writing by another program"),
        "{told}"
    );
}

/// What it is of such a file does not say any more: nothing takes its place unasked, no merge does, and in a folder of
/// shards it makes room.
#[test]
fn a_file_that_was_opened_for_writing_stays() {
    let bench = bench();
    for (command, name) in [
        ("run case.toml", "case.h5"),
        ("sweep study.toml", "study.study.h5"),
    ] {
        let found = |bench: &Bench| bench.path(name).exists();
        bench.text(command);
        // Both are called by the folder where they are called `case` and `study`.
        let name = match found(&bench) {
            true => name.to_owned(),
            false => {
                let folder = bench.path("").canonicalize().unwrap();
                let folder = folder.file_name().unwrap().to_str().unwrap().to_owned();
                let ending = name.split_once('.').unwrap().1;
                format!("{folder}.{ending}")
            }
        };
        edit(&bench.path(&name), |_| ());
        let before = bench.bytes(&name);
        let told = bench.complaint(command, 4);
        assert!(told.contains("another program has opened it"), "{told}");
        assert!(bench.bytes(&name) == before, "{name}");
        let output = bench.run(&format!("{command} -o {name}"));
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.success() && said.contains("will be replaced"),
            "{said}"
        );
    }
    edit(&bench.path("1.h5"), |_| ());
    let told = bench.complaint("merge 2.h5 --partial -o 1.h5", 2);
    assert!(told.contains("it may hold a shard"), "{told}");
    bench.text("sweep study.toml --shard 1/3 --into all");
    let shards = std::fs::read_dir(bench.path("all")).unwrap();
    let shard = shards
        .map(|e| e.unwrap().path())
        .find(|p| p.is_file())
        .unwrap();
    let whole = std::fs::read(&shard).unwrap();
    edit(&shard, |_| ());
    let output = bench.run("sweep study.toml --shard 1/3 --into all --resume");
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && said.contains("its runs are made again"),
        "{said}"
    );
    assert!(std::fs::read(&shard).unwrap() == whole);
}

#[test]
fn files_of_earlier_versions_are_read_with_a_warning() {
    let bench = bench();
    bench.text("sweep study.toml -o whole.h5");
    bench.text("report run.h5 -o new.html");
    without_checksum(&bench.path("run.h5"));
    without_checksum(&bench.path("2.h5"));
    let output = bench.run("report run.h5 -o old.html");
    assert_eq!(output.status.code(), Some(0));
    let warning = String::from_utf8(output.stderr).unwrap();
    assert!(
        warning.contains("warning: run.h5 has no checksum"),
        "{warning}"
    );
    let page = String::from_utf8(bench.bytes("old.html")).unwrap();
    assert!(page.contains("no checksum"));
    assert!(
        !String::from_utf8(bench.bytes("new.html"))
            .unwrap()
            .contains("no checksum")
    );
    let output = bench.run(&format!("merge {SHARDS} -o out.h5 --json"));
    assert_eq!(output.status.code(), Some(0));
    let warning = String::from_utf8(output.stderr).unwrap();
    assert!(
        warning.contains("warning: 2.h5 has no checksum"),
        "{warning}"
    );
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let first = told["warnings"][0].as_str().unwrap();
    assert!(first.starts_with("2.h5 has no checksum"), "{first}");
    // What is written has one again.
    assert!(bench.bytes("out.h5") == bench.bytes("whole.h5"));
}

/// HDF5 reads such datasets as zeros.
#[test]
fn zeros_are_not_made_of_what_is_missing() {
    let bench = bench();
    let whole = bench.bytes("2.h5");
    let replaced = |file: &hdf5::File, single: bool| {
        let shape = file.dataset("peak_storey_shear").unwrap().shape();
        file.unlink("peak_storey_shear").unwrap();
        let chunk = (shape[0], shape[1]);
        let made = match single {
            true => {
                let values = vec![1.0_f32; shape[0] * shape[1]];
                let builder = file.new_dataset::<f32>().chunk(chunk);
                let data = builder.shape(chunk).create("peak_storey_shear").unwrap();
                data.write_raw(&values).unwrap();
                data
            }
            false => {
                let builder = file.new_dataset::<f64>().chunk(chunk);
                builder.shape(chunk).create("peak_storey_shear").unwrap()
            }
        };
        assert_eq!(made.shape(), shape);
    };
    for (single, word) in [(false, "not in the file"), (true, "its type is not f64")] {
        std::fs::write(bench.path("2.h5"), &whole).unwrap();
        without_checksum(&bench.path("2.h5"));
        edit(&bench.path("2.h5"), |file| replaced(file, single));
        let told = bench.complaint(&format!("merge {SHARDS} -o out.h5"), 2);
        assert!(
            told.contains(word) && told.contains("peak_storey_shear"),
            "{told}"
        );
        assert!(!bench.path("out.h5").exists());
    }
}

/// Whatever the damage does to the HDF5 library, the answer is one of ours.
#[test]
fn damaged_files_of_earlier_versions_end_nothing_but_their_reader() {
    let bench = bench();
    without_checksum(&bench.path("run.h5"));
    without_checksum(&bench.path("2.h5"));
    let mut random = Random(3);
    for (name, command) in [
        ("run.h5", "report run.h5 -o out.html".to_owned()),
        ("2.h5", format!("merge {SHARDS} -o out.h5")),
    ] {
        let whole = bench.bytes(name);
        let mut refused = 0;
        for number in 0..20 {
            let mut bytes = whole.clone();
            // The header of the file and of its objects is where the library gets lost.
            let end = bytes.len().min(8000);
            for _ in 0..=number % 3 {
                random.corrupt(&mut bytes[48..end]);
            }
            std::fs::write(bench.path(name), &bytes).unwrap();
            let output = bench.run(&command);
            let told = String::from_utf8(output.stderr).unwrap();
            match output.status.code() {
                Some(0) => assert!(told.contains("has no checksum"), "{told}"),
                Some(2) => {
                    assert!(told.contains(name), "{told}");
                    refused += 1;
                }
                code => panic!("{name} {number}: {code:?} {told}"),
            }
            assert!(!told.contains("panicked"), "{told}");
            assert!(!told.contains("18446744073709551615"), "{told}");
        }
        assert!(refused > 10, "{refused}");
        std::fs::write(bench.path(name), &whole).unwrap();
    }
}

/// A checksum that was computed anew says nothing of what was damaged before.
#[test]
fn files_whose_checksum_was_computed_anew_end_nothing_but_their_reader() {
    let bench = bench();
    let mut random = Random(5);
    let mut no_answer = 0;
    for (name, command, written, codes) in [
        ("run.h5", "report run.h5 -o out.html", "out.html", [0, 2]),
        ("2.h5", "report 2.h5 -o out.html", "out.html", [0, 2]),
        ("2.h5", "merge 1.h5 2.h5 3.h5 -o out.h5", "out.h5", [0, 2]),
        ("2.h5", "merge --check 1.h5 2.h5 3.h5", "out.h5", [0, 1]),
        (
            "2.h5",
            "sweep study.toml --shard 2/3 -o 2.h5 --resume --csv out.csv",
            "out.csv",
            [0, 2],
        ),
    ] {
        let whole = bench.bytes(name);
        for number in 0..10 {
            let mut bytes = whole[..whole.len() - LENGTH].to_vec();
            let end = bytes.len().min(8000);
            for _ in 0..=number % 3 {
                random.corrupt(&mut bytes[48..end]);
            }
            std::fs::write(bench.path(name), &bytes).unwrap();
            append(&bench.path(name)).unwrap();
            let output = bench.run(command);
            let told = String::from_utf8(output.stderr).unwrap();
            let answer = String::from_utf8(output.stdout).unwrap();
            let code = output.status.code();
            assert!(
                code.is_some_and(|code| codes.contains(&code)),
                "{command} {number}: {code:?} {told}"
            );
            if code != Some(0) {
                let told = format!("{told}{answer}");
                assert!(told.contains(name), "{command} {number}: {told}");
                assert!(!bench.path(written).exists());
                no_answer += usize::from(told.contains("whatever its checksum says"));
            }
            assert!(
                !told.contains("panicked") && !told.contains("reads 0"),
                "{told}"
            );
            let _ = std::fs::remove_file(bench.path(written));
            bench.no_part_file();
        }
        std::fs::write(bench.path(name), &whole).unwrap();
    }
    assert!(no_answer > 2, "the library came to harm {no_answer} times");
}

/// `merge --check` names every file that the library gets lost in, and looks at all others.
#[test]
fn all_files_that_cannot_be_read_are_named() {
    let bench = bench();
    let mut random = Random(7);
    for name in ["1.h5", "3.h5"] {
        let whole = bench.bytes(name);
        // Until one is found in which the library gets lost.
        loop {
            let mut bytes = whole[..whole.len() - LENGTH].to_vec();
            random.corrupt(&mut bytes[48..8000]);
            std::fs::write(bench.path(name), &bytes).unwrap();
            append(&bench.path(name)).unwrap();
            let told = bench.run(&format!("report {name} -o out.html")).stderr;
            let told = String::from_utf8(told).unwrap();
            if told.contains("whatever its checksum says") {
                break;
            }
        }
    }
    let output = bench.run("merge --check 1.h5 2.h5 3.h5 --json");
    assert_eq!(output.status.code(), Some(1));
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(told["present"], serde_json::json!([2]));
    let mut faulty: Vec<&str> = told["faults"]
        .as_array()
        .unwrap()
        .iter()
        .map(|fault| fault["file"].as_str().unwrap())
        .collect();
    faulty.sort_unstable();
    assert_eq!(faulty, ["1.h5", "3.h5"]);
}

/// Numbers that cannot be, with a checksum that matches them.
#[test]
fn impossible_numbers_are_refused() {
    let bench = bench();
    let whole = bench.bytes("2.h5");
    for (attribute, value) in [
        ("chunk", 0),
        ("chunk", u64::MAX),
        ("runs", 0),
        ("runs", u64::MAX),
        ("shard", 0),
        ("shard", u64::MAX),
        ("shards", 0),
        ("shards", u64::MAX),
        ("shards", u64::from(u32::MAX)),
    ] {
        for first in ["1.h5 2.h5", "2.h5 1.h5"] {
            std::fs::write(bench.path("2.h5"), &whole).unwrap();
            edit_with_checksum(&bench.path("2.h5"), |file| {
                file.attr(attribute).unwrap().write_scalar(&value).unwrap();
            });
            let told = bench.complaint(&format!("merge {first} 3.h5 -o out.h5"), 2);
            assert!(!told.contains(&u64::MAX.to_string()), "{told}");
            assert!(!told.contains("panicked"), "{attribute} {value}: {told}");
        }
    }
    for (name, value) in [("run", -1_i64), ("run", i64::MAX)] {
        std::fs::write(bench.path("2.h5"), &whole).unwrap();
        edit_with_checksum(&bench.path("2.h5"), |file| {
            let data = file.dataset(name).unwrap();
            data.write_slice(&[value], 0..1).unwrap();
        });
        let told = bench.complaint(&format!("merge {SHARDS} -o out.h5"), 2);
        assert!(!told.contains(&u64::MAX.to_string()), "{told}");
    }
    std::fs::write(bench.path("2.h5"), &whole).unwrap();
    edit_with_checksum(&bench.path("2.h5"), |file| {
        let data = file.dataset("status").unwrap();
        data.write_slice(&[3_i8], 0..1).unwrap();
    });
    let told = bench.complaint(&format!("merge {SHARDS} -o out.h5"), 2);
    assert!(told.contains("no status that we know"), "{told}");
}

/// Runs of two builds are one result only if that is asked for, and then it says so.
#[test]
fn builds_are_not_mixed_unasked() {
    let bench = bench();
    edit_with_checksum(&bench.path("2.h5"), |file| {
        let other: VarLenUnicode = "version 0.0.9, other sources".parse().unwrap();
        file.attr("build").unwrap().write_scalar(&other).unwrap();
    });
    let told = bench.complaint(&format!("merge {SHARDS} -o out.h5"), 2);
    for word in [
        "different builds of the program",
        "version 0.0.9, other sources: 2.h5",
        "1.h5, 3.h5",
        "sources",
        "--allow-mixed-builds",
    ] {
        assert!(told.contains(word), "{word}: {told}");
    }
    assert!(!bench.path("out.h5").exists());
    let output = bench.run(&format!(
        "merge {SHARDS} -o out.h5 --allow-mixed-builds --json"
    ));
    assert_eq!(output.status.code(), Some(0));
    let told: Value = serde_json::from_slice(&output.stdout).unwrap();
    let warning = told["warnings"][0].as_str().unwrap();
    assert!(
        warning.contains("shards 2 of 3: version 0.0.9"),
        "{warning}"
    );
    let file = hdf5::File::open(bench.path("out.h5")).unwrap();
    let build: VarLenUnicode = file.attr("build").unwrap().read_scalar().unwrap();
    let lines: Vec<&str> = build.lines().collect();
    assert_eq!(lines.len(), 2, "{build}");
    assert!(
        lines[0].starts_with("shards 1, 3 of 3: version "),
        "{build}"
    );
    assert_eq!(lines[1], "shards 2 of 3: version 0.0.9, other sources");
    // The builds of a whole that was made by one are those of its shards.
    drop(file);
    bench.text("sweep study.toml -o whole.h5");
    let file = hdf5::File::open(bench.path("whole.h5")).unwrap();
    let build: VarLenUnicode = file.attr("build").unwrap().read_scalar().unwrap();
    assert!(
        build.starts_with("version ") && build.contains("target "),
        "{build}"
    );
}

/// Going on replaces nothing but what it has begun itself.
#[test]
fn resume_never_replaces_another_result() {
    let bench = bench();
    let whole = bench.bytes("1.h5");
    let told = bench.complaint("sweep study.toml --shard 2/3 -o 1.h5 --resume", 2);
    assert!(told.contains("it is shard 1/3 of this study"), "{told}");
    let told = bench.complaint("sweep study.toml -o 1.h5 --resume", 2);
    assert!(told.contains("it is shard 1/3 of this study"), "{told}");
    bench.study(&MIXED.replace("seed = 3", "seed = 4"));
    let told = bench.complaint("sweep study.toml --shard 1/3 -o 1.h5 --resume", 2);
    assert!(told.contains("another study"), "{told}");
    bench.study(MIXED);
    assert!(bench.bytes("1.h5") == whole && !bench.path("1.h5.parts").exists());
    let told = bench.text("sweep study.toml --shard 1/3 -o 1.h5 --resume");
    assert!(
        told.contains("20 of them stored by an earlier call"),
        "{told}"
    );
    let mut damaged = whole.clone();
    damaged[5000] ^= 1;
    std::fs::write(bench.path("1.h5"), &damaged).unwrap();
    let told = bench.complaint("sweep study.toml --shard 1/3 -o 1.h5 --resume", 2);
    assert!(told.contains("it is damaged"), "{told}");
    assert!(bench.bytes("1.h5") == damaged);
    edit_with_checksum(&bench.path("2.h5"), |file| {
        let other: VarLenUnicode = "version 0.0.9".parse().unwrap();
        file.attr("build").unwrap().write_scalar(&other).unwrap();
    });
    let told = bench.complaint("sweep study.toml --shard 2/3 -o 2.h5 --resume", 2);
    assert!(
        told.contains("another build of the program (version 0.0.9;"),
        "{told}"
    );
}

/// Finished runs of another build are not mixed with those of this one either.
#[test]
fn runs_of_another_build_do_not_go_on() {
    let bench = Bench::new(MIXED);
    bench.without_its_result("sweep study.toml -o a.h5");
    let study = bench.path("a.h5.parts").join("study.txt");
    let text = std::fs::read_to_string(&study).unwrap();
    let (identity, build) = text.split_once('\n').unwrap();
    assert!(build.starts_with("version "), "{build}");
    std::fs::write(&study, format!("{identity}\nversion 0.0.9")).unwrap();
    let told = bench.complaint("sweep study.toml -o a.h5 --resume", 2);
    assert!(
        told.contains("runs of another build of the program (version 0.0.9)"),
        "{told}"
    );
    std::fs::write(&study, text).unwrap();
    bench.text("sweep study.toml -o a.h5 --resume");
}
