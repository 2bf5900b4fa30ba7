//! The runs of a gap check and of a comparison of models, shared by several processes.

use super::Bench;

/// The same tables, figures and JSON as of one process, to the last byte.
#[test]
fn shards_of_checks_give_what_one_process_gives() {
    let bench = Bench::new("case = \"case.toml\"\n");
    for (check, options, code) in [
        ("gap", "--points 12", 1),
        (
            "compare",
            "--models anagnostopoulos_2004,jankowski_2005,ye_li_2009",
            0,
        ),
    ] {
        let call = format!("{check} case.toml {options} --threads 2");
        let files = |name: &str| format!("--csv {name}.csv --plot {name}.svg --json");
        let whole = bench.run(&format!("{call} {}", files("whole")));
        assert_eq!(whole.status.code(), Some(code), "{whole:?}");
        for index in [3, 1, 2] {
            let told = bench.text(&format!("{call} --shard {index}/3 --into parts"));
            assert!(told.contains("with --merge"), "{told}");
        }
        let merged = bench.run(&format!("{call} --merge parts {}", files("merged")));
        assert_eq!(merged.status.code(), Some(code), "{merged:?}");
        assert!(merged.stdout == whole.stdout, "{check}");
        for ending in ["csv", "svg"] {
            let bytes = |name: &str| bench.bytes(&format!("{name}.{ending}"));
            assert!(bytes("merged") == bytes("whole"), "{check} {ending}");
        }
        // Of other options, and without one of them.
        let other = match check {
            "gap" => "gap case.toml --points 13 --merge parts",
            _ => "compare case.toml --restitution 0.5 --merge parts",
        };
        let told = bench.complaint(other, 2);
        assert!(told.contains("another check"), "{told}");
        let one = format!("parts/case.{check}-shard-2-of-3.runs");
        std::fs::remove_file(bench.path(&one)).unwrap();
        let told = bench.complaint(&format!("{call} --merge parts"), 2);
        assert!(told.contains("of 3 shards these are missing: 2"), "{told}");
    }
    // A shard answers nothing, and so writes no answer.
    for call in [
        "gap case.toml --csv a.csv",
        "gap case.toml --codes-csv a.csv",
        "gap case.toml --report a.html",
        "gap case.toml --json",
        "compare case.toml --plot a.svg",
        "compare case.toml --csv a.csv",
    ] {
        let told = bench.complaint(&format!("{call} --shard 1/2 --into refused"), 2);
        assert!(told.contains("to the call with --merge"), "{told}");
    }
    assert!(!bench.path("refused").exists());
    let told = bench.complaint("gap case.toml --points 0 --shard 1/2 --into parts", 2);
    assert!(told.contains("no runs to share"), "{told}");
    let told = bench.complaint("compare case.toml --merge .", 2);
    assert!(told.contains("holds no shards of a `compare`"), "{told}");
    let told = bench.complaint("status parts", 2);
    for part in ["shards of a `gap` or `compare`", "with --merge"] {
        assert!(told.contains(part), "{part}: {told}");
    }
}

/// A shard that cannot be stored is an output that could not be written.
#[cfg(unix)]
#[test]
fn a_shard_without_room_is_no_bad_input() {
    let bench = Bench::new("case = \"case.toml\"\n");
    for call in [
        "gap case.toml --points 12",
        "compare case.toml --models anagnostopoulos_2004,jankowski_2005",
    ] {
        let (code, told) = bench.with_limit(0, &format!("{call} --shard 1/2 --into parts"));
        assert_eq!(code, Some(4), "{told}");
        for word in ["cannot write parts/case.", "has room", "--into"] {
            assert!(told.contains(word), "{word}: {told}");
        }
        bench.no_part_file();
    }
}
