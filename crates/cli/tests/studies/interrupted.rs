//! Studies that are killed.

use std::path::Path;
use std::time::Duration;

use super::{Bench, MIXED};

/// Finished chunks that a study has stored.
fn stored(parts: &Path) -> usize {
    std::fs::read_dir(parts).map_or(0, |files| {
        let names = files.filter_map(Result::ok).map(|f| f.path());
        names
            .filter(|f| f.extension().is_some_and(|e| e == "runs"))
            .count()
    })
}

/// Kills at random instants until there were fifty; whenever a study comes to its end, its
/// file has the bytes of an undisturbed run. The instants follow the progress of the study,
/// not the clock, so that a slow machine sees the same stages.
#[test]
fn a_killed_study_goes_on_where_it_was() {
    let bench = Bench::new(&MIXED.replace("runs = 60", "runs = 120"));
    bench.text("sweep study.toml --threads 2 -o whole.h5");
    let whole = bench.bytes("whole.h5");
    let mut random = 12_345_u64;
    let mut uniform = || {
        // Knuth's generator; the instants are random anyway.
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / (1_u64 << 53) as f64
    };
    let (mut kills, mut finished, mut resumed) = (0, 0, 0);
    while kills < 50 {
        let mut child = bench
            .command("sweep study.toml --threads 2 -o killed.h5 --resume")
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        let parts = bench.path("killed.h5.parts");
        let awaited = stored(&parts) + (5.0 * uniform()) as usize;
        while stored(&parts) < awaited && child.try_wait().unwrap().is_none() {
            std::thread::sleep(Duration::from_micros(200));
        }
        std::thread::sleep(Duration::from_secs_f64(5.0e-3 * uniform()));
        // SIGKILL on Unix: nothing is cleaned up.
        child.kill().unwrap();
        let status = child.wait().unwrap();
        if !status.success() {
            kills += 1;
            resumed += usize::from(stored(&parts) > 0);
        }
        if bench.path("killed.h5").exists() {
            assert!(bench.bytes("killed.h5") == whole, "after {kills} kills");
            // What a kill between renaming and tidying up leaves is tidied up.
            bench.text("sweep study.toml -o killed.h5 --resume");
            finished += 1;
            std::fs::remove_file(bench.path("killed.h5")).unwrap();
        }
    }
    bench.text("sweep study.toml -o killed.h5 --resume");
    assert!(bench.bytes("killed.h5") == whole);
    assert!(!bench.path("killed.h5.parts").exists());
    assert!(
        finished > 0 && resumed > 5,
        "{finished} finished, {resumed} kills with finished runs"
    );
}

/// A whole piece is kept and a damaged one made again.
#[test]
fn damaged_pieces_are_made_again() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o whole.h5");
    // Stored by number alone, four at once.
    bench.without_its_result("sweep study.toml -o again.h5 --store-every 1000s");
    let parts = bench.path("again.h5.parts");
    let told = bench.complaint("sweep study.toml -o again.h5", 2);
    assert!(
        told.contains("60 finished runs of this study from an interrupted call"),
        "{told}"
    );
    assert!(told.contains("--resume"), "{told}");
    let mut pieces: Vec<_> = std::fs::read_dir(&parts)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "runs"))
        .collect();
    pieces.sort();
    assert_eq!(pieces.len(), 15);
    let mut bytes = std::fs::read(&pieces[2]).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 4;
    std::fs::write(&pieces[2], bytes).unwrap();
    let told = bench.text("sweep study.toml -o again.h5 --resume");
    assert!(
        told.contains("56 of them stored by an earlier call"),
        "{told}"
    );
    assert!(bench.bytes("again.h5") == bench.bytes("whole.h5"));
    // And once it is complete there is nothing to do.
    let told = bench.text("sweep study.toml -o again.h5 --resume --csv late.csv");
    assert!(
        told.contains("60 of them stored by an earlier call"),
        "{told}"
    );
    assert_eq!(
        String::from_utf8(bench.bytes("late.csv"))
            .unwrap()
            .lines()
            .count(),
        61
    );
}

/// Finished runs are never mixed with those of a study that was changed since.
#[test]
fn a_changed_study_does_not_go_on() {
    let bench = Bench::new(MIXED);
    bench.without_its_result("sweep study.toml -o a.h5");
    bench.study(&MIXED.replace("\"20 t\"", "\"21 t\""));
    let told = bench.complaint("sweep study.toml -o a.h5 --resume", 2);
    assert!(told.contains("runs of another study"), "{told}");
    // A comment, or other words for the same numbers, change nothing.
    bench.study(
        &MIXED
            .replace("\"20 t\"", "20000")
            .replace("seed = 3", "seed = 3 # as before"),
    );
    bench.without_its_result("sweep study.toml -o a.h5 --resume");
}

/// Two processes never work on the same runs.
#[test]
fn one_process_at_a_time() {
    let bench = Bench::new(MIXED);
    let parts = bench.path("a.h5.parts");
    std::fs::create_dir(&parts).unwrap();
    let held = std::fs::File::create(parts.join("lock")).unwrap();
    held.lock().unwrap();
    let told = bench.complaint("sweep study.toml -o a.h5 --resume", 2);
    assert!(
        told.contains("another process is working in a.h5.parts"),
        "{told}"
    );
    drop(held);
    bench.text("sweep study.toml -o a.h5 --resume");
}

/// However long a study takes and however often it is stored, its files are no more than its
/// chunks and the small ones of one chunk; and none of it shows in the result.
#[test]
fn small_pieces_become_large_ones() {
    let bench = Bench::new(&MIXED.replace("chunk = 4", "chunk = 20"));
    bench.text("sweep study.toml -o whole.h5");
    bench.without_its_result("sweep study.toml -o often.h5 --store-every 0s --threads 1");
    let pieces = stored(&bench.path("often.h5.parts"));
    assert!((3..3 + 20).contains(&pieces), "{pieces}");
    let told = bench.text("sweep study.toml -o often.h5 --resume");
    assert!(
        told.contains("60 of them stored by an earlier call"),
        "{told}"
    );
    assert!(bench.bytes("often.h5") == bench.bytes("whole.h5"));
}

/// Begun again beside its finished result and interrupted, a study that is resumed finds
/// nothing to do: the runs of the interrupted call are removed, unless they are of another
/// study.
#[test]
fn runs_beside_a_finished_result_are_removed() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml -o whole.h5");
    let whole = bench.bytes("whole.h5");
    let parts = bench.path("again.h5.parts");
    let begin = || {
        bench.without_its_result("sweep study.toml -o again.h5 --store-every 1000s");
        std::fs::write(bench.path("again.h5"), &whole).unwrap();
        assert_eq!(stored(&parts), 15);
    };
    begin();
    let told = bench.text("sweep study.toml -o again.h5 --resume");
    assert!(
        told.contains("60 of them stored by an earlier call"),
        "{told}"
    );
    assert!(!parts.exists());
    assert!(bench.bytes("again.h5") == whole);
    // Runs of another study that lie there are not touched.
    begin();
    let name = parts.join("study.txt");
    let text = std::fs::read_to_string(&name).unwrap();
    std::fs::write(&name, text.replacen(&text[..4], "0000", 1)).unwrap();
    std::fs::remove_file(parts.join("lock")).unwrap();
    bench.text("sweep study.toml -o again.h5 --resume");
    assert_eq!(stored(&parts), 15);
    assert!(!parts.join("lock").exists());
}

/// A finished result of another shard, or of another study, is never taken for one that is to
/// be resumed.
#[test]
fn a_finished_shard_is_not_replaced_by_another() {
    let bench = Bench::new(MIXED);
    bench.text("sweep study.toml --shard 1/3 -o x.h5");
    let first = bench.bytes("x.h5");
    let wanted = "x.h5 is not the result that --resume goes on with: it is shard 1/3 of this study";
    for shard in ["--shard 2/3", "--shard 1/2", ""] {
        let told = bench.complaint(&format!("sweep study.toml {shard} -o x.h5 --resume"), 2);
        assert!(told.contains(wanted), "{told}");
        assert!(told.contains("name another result with -o"), "{told}");
        assert!(bench.bytes("x.h5") == first);
        assert!(!bench.path("x.h5.parts").exists());
    }
    bench.text("sweep study.toml --shard 1/3 -o x.h5 --resume");
    assert!(bench.bytes("x.h5") == first);
    bench.study(&MIXED.replace("seed = 3", "seed = 4"));
    let told = bench.complaint("sweep study.toml --shard 1/3 -o x.h5 --resume", 2);
    assert!(told.contains("another version of this one"), "{told}");
    assert!(bench.bytes("x.h5") == first);
    // Asked for anew, it is replaced, as all results are.
    bench.text("sweep study.toml --shard 2/3 -o x.h5");
    assert!(bench.bytes("x.h5") != first);
}

/// What a plain call replaces, the call that goes on with it replaces too.
#[cfg(unix)]
#[test]
fn the_command_that_an_interrupted_study_names_goes_on() {
    let bench = Bench::new(&MIXED.replace("runs = 60", "runs = 8"));
    bench.text("sweep study.toml -o a.h5");
    let older = bench.bytes("a.h5");
    bench.study(&MIXED.replace("runs = 60", "runs = 400"));
    let child = bench
        .command("sweep study.toml -o a.h5 --threads 1 --store-every 10ms")
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    while stored(&bench.path("a.h5.parts")) == 0 {
        std::thread::sleep(Duration::from_millis(1));
    }
    let process = child.id().to_string();
    let kill = std::process::Command::new("kill")
        .args(["-INT", &process])
        .status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(5), "{told}");
    assert!(bench.bytes("a.h5") == older);
    let command = told.lines().skip_while(|line| *line != "go on with").nth(1);
    let words: Vec<&str> = command.unwrap().split_whitespace().skip(1).collect();
    assert!(words.contains(&"--resume"), "{told}");
    let told = bench.text(&words.join(" "));
    assert!(told.contains("stored by an earlier call"), "{told}");
    assert!(!bench.path("a.h5.parts").exists());
    bench.text("sweep study.toml -o whole.h5");
    assert!(bench.bytes("a.h5") == bench.bytes("whole.h5"));
}
