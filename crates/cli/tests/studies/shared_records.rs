//! Records in the folder of all shards: each once, and read by those that need it.

use super::{Bench, root};

/// Three records, of which each of three shards uses one.
const STUDY: &str = r#"
case = "case.toml"
[[variable]]
records = ["a.csv", "b.csv", "c.csv"]
[[variable]]
intensity = "peak_ground_velocity"
from = "0.1 m/s"
to = "0.4 m/s"
count = 4
[output]
chunk = 4
"#;

fn bench() -> Bench {
    let bench = Bench::new(STUDY);
    for (file, record) in [
        ("a.csv", "el_centro_1940_ns.csv"),
        ("b.csv", "kobe_1995_jma_ns.csv"),
        ("c.csv", "el_centro_1940_ns.csv"),
    ] {
        let text = std::fs::read(root().join("ground_motions").join(record)).unwrap();
        std::fs::write(bench.path(file), text).unwrap();
    }
    bench
}

/// The files of the shared records, without their list.
fn copies(bench: &Bench) -> Vec<String> {
    let entries = std::fs::read_dir(bench.path("all/records")).unwrap();
    let names = entries.map(|e| e.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.filter(|name| name != "list.json").collect();
    names.sort();
    names
}

/// What the first shard has read is enough for the others, though the files are gone, and of what
/// is kept each needs its own record alone.
#[test]
fn a_shard_needs_the_records_of_its_runs_alone() {
    let bench = bench();
    bench.text("sweep study.toml -o whole.h5");
    bench.text("sweep study.toml --shard 1/3 --into all");
    // Two files of the same bytes are one.
    let kept = copies(&bench);
    assert_eq!(kept.len(), 2, "{kept:?}");
    for file in ["a.csv", "b.csv", "c.csv"] {
        std::fs::remove_file(bench.path(file)).unwrap();
    }
    // That of b, by its content.
    let bytes = std::fs::read(root().join("ground_motions/kobe_1995_jma_ns.csv")).unwrap();
    let of = |name: &&String| bench.bytes(&format!("all/records/{name}")) == bytes;
    let b = kept.iter().find(of).unwrap();
    let moved = |from: &str, to: &str| std::fs::rename(bench.path(from), bench.path(to)).unwrap();
    moved(&format!("all/records/{b}"), "elsewhere.csv");
    bench.text("sweep study.toml --shard 3/3 --into all");
    // Without its copy and its file, the second shard has nothing to read.
    let told = bench.complaint("sweep study.toml --shard 2/3 --into all", 2);
    assert!(told.contains("record b: cannot read"), "{told}");
    assert!(
        !told.contains("record a:") && !told.contains("record c:"),
        "{told}"
    );
    moved("elsewhere.csv", &format!("all/records/{b}"));
    bench.text("sweep study.toml --shard 2/3 --into all");
    bench.text("merge all -o merged.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
    // Nothing is left to do: no record is needed at all.
    std::fs::remove_file(bench.path(&format!("all/records/{b}"))).unwrap();
    bench.text("sweep study.toml --shard 2/3 --into all --resume");
}

/// A file that was changed is another record, and its shards are of another study.
#[test]
fn a_changed_record_is_read_anew() {
    let bench = bench();
    bench.text("sweep study.toml --shard 1/3 --into all");
    let text = String::from_utf8(bench.bytes("b.csv")).unwrap();
    std::fs::write(bench.path("b.csv"), format!("{text}# changed\n")).unwrap();
    bench.text("sweep study.toml --shard 2/3 --into all");
    assert_eq!(copies(&bench).len(), 3);
    let told = bench.complaint("merge all -o merged.h5 --partial", 2);
    assert!(told.contains("another study"), "{told}");
    // A damaged copy is not read where the file is there.
    for name in copies(&bench) {
        std::fs::write(bench.path(&format!("all/records/{name}")), "damaged").unwrap();
    }
    bench.text("sweep study.toml --shard 3/3 --into all");
}

/// A record that was changed is read anew, though it has the size and the time that it had: of the
/// other version of the study that it makes, the shard says so.
#[cfg(unix)]
#[test]
fn a_record_of_the_same_size_and_time_is_read_anew() {
    let bench = bench();
    bench.text("sweep study.toml --shard 1/3 --into all");
    let modified = bench.path("c.csv").metadata().unwrap().modified().unwrap();
    let text = String::from_utf8(bench.bytes("c.csv")).unwrap();
    let changed = text.replacen("Imperial", "imperial", 1);
    assert!(changed != text && changed.len() == text.len());
    std::fs::write(bench.path("c.csv"), changed).unwrap();
    let file = std::fs::File::options()
        .write(true)
        .open(bench.path("c.csv"))
        .unwrap();
    file.set_modified(modified).unwrap();
    drop(file);
    let told = bench.text("sweep study.toml --shard 3/3 --into all");
    assert!(told.contains("of another version of the study"), "{told}");
    assert_eq!(copies(&bench).len(), 3);
}

/// What is said of a record when it is read stands in every shard, whichever came first, and in one
/// that goes on: the merged file is that of one call.
#[test]
fn what_is_said_of_a_record_does_not_depend_on_the_order_of_shards() {
    let bench = bench();
    let text = String::from_utf8(bench.bytes("b.csv")).unwrap();
    // Six times as strong: larger than any recorded.
    let mut scaled = String::new();
    for line in text.lines() {
        let values: Vec<_> = line.split(',').map(str::parse::<f64>).collect();
        match values.as_slice() {
            [Ok(time), Ok(value)] => scaled += &format!("{time},{}\n", 6.0 * value),
            _ => scaled += &format!("{line}\n"),
        }
    }
    std::fs::write(bench.path("b.csv"), scaled).unwrap();
    let told = bench.text("sweep study.toml -o whole.h5");
    assert!(told.contains("larger than any recorded"), "{told}");
    for shard in [3, 1, 2] {
        let told = bench.text(&format!("sweep study.toml --shard {shard}/3 --into all"));
        assert!(told.contains("larger than any recorded"), "{shard}: {told}");
    }
    bench.text("merge all -o merged.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
}

/// A list and a status file that are somebody's stay, and so does what links in the places of their folders lead to:
/// before any work, with place and remedy.
#[cfg(unix)]
#[test]
fn what_is_somebodys_in_a_folder_of_shards_stays() {
    use std::os::unix::fs::symlink;
    let bench = bench();
    std::fs::rename(bench.path("study.toml"), bench.path("s.toml")).unwrap();
    let shard = "sweep s.toml --shard 1/3 --into all";
    let status = "all/status/s.shard-1-of-3.json";
    let list = "all/records/list.json";
    std::fs::create_dir(bench.path("mine")).unwrap();
    for (place, text) in [
        (list, "{\"mine\":1}"),
        (list, "{\"study\":\"mine\"}"),
        (status, "notes"),
        (status, "{\"state\":\"Bavaria\"}"),
    ] {
        let at = bench.path(place);
        for is_linked in [false, true] {
            std::fs::create_dir_all(at.parent().unwrap()).unwrap();
            if is_linked {
                std::fs::remove_dir(at.parent().unwrap()).unwrap();
                symlink("../mine", at.parent().unwrap()).unwrap();
            }
            std::fs::write(&at, text).unwrap();
            let told = bench.complaint(shard, 4);
            let named = match is_linked {
                false => {
                    format!("cannot write {place}: a file stands there that is not of this program")
                }
                true => format!(
                    "cannot write {}: it is a link, which is not followed there",
                    place.rsplit_once('/').unwrap().0
                ),
            };
            assert!(told.contains(&named), "{named}: {told}");
            assert!(
                told.contains("help: move it away, or give the shards"),
                "{told}"
            );
            assert_eq!(std::fs::read_to_string(&at).unwrap(), text, "{place}");
            assert_eq!(std::fs::read_dir(at.parent().unwrap()).unwrap().count(), 1);
            assert!(!bench.path("all/s.shard-1-of-3.h5").exists(), "{place}");
            std::fs::remove_file(&at).unwrap();
            std::fs::remove_dir_all(bench.path("all")).unwrap();
        }
    }
}

/// Files that a former version, another study or a damage has left are replaced, and so are empty ones.
#[test]
fn former_lists_and_status_files_are_replaced() {
    let bench = bench();
    std::fs::rename(bench.path("study.toml"), bench.path("s.toml")).unwrap();
    let list = format!("{{\"study\":\"{}\",\"records\":[]}}", "0".repeat(64));
    for (list, status) in [
        ("", ""),
        ("\0\0\0\0", "\0\n"),
        ("{\"stu", "{\"st"),
        (&list[..20], "{\"state\":\"don"),
        (&list.replace(':', ": "), "{\"state\":\"running\""),
        (&*list, "{\"state\":\"done\",\"runs\":1}"),
        (&list[..80], "{\"state\":\"running\",\"ru"),
        (&list, "{\"runs\":1, \"finished\":1, \"state\":\"done\"}"),
    ] {
        for (place, text) in [("records/list", list), ("status/s.shard-1-of-3", status)] {
            let at = bench.path(&format!("all/{place}.json"));
            std::fs::create_dir_all(at.parent().unwrap()).unwrap();
            std::fs::write(at, text).unwrap();
        }
        bench.text("sweep s.toml --shard 1/3 --into all");
        let told = bench.bytes("all/status/s.shard-1-of-3.json");
        assert!(
            told.starts_with(b"{\"state\":\"done\",\"runs\":4,"),
            "{status}"
        );
        let known = String::from_utf8(bench.bytes("all/records/list.json")).unwrap();
        assert!(known.contains("b.csv"), "{known}");
        std::fs::remove_dir_all(bench.path("all")).unwrap();
    }
}

/// What a changed digit makes of a list is not believed: the records are read again, and the list is as it was.
#[test]
fn a_damaged_list_is_not_believed() {
    let bench = bench();
    bench.text("sweep study.toml -o whole.h5");
    bench.text("sweep study.toml --shard 1/3 --into all");
    let list = String::from_utf8(bench.bytes("all/records/list.json")).unwrap();
    let (before, after) = list.split_once("\"peak_time\":").unwrap();
    // A peak at 2e9 s, beyond the end of every run.
    let (_, after) = after.split_once(',').unwrap();
    let late = 2.0e9_f64.to_bits();
    let changed = format!("{before}\"peak_time\":{late},{after}");
    std::fs::write(bench.path("all/records/list.json"), changed).unwrap();
    for shard in [2, 3] {
        let told = bench.text(&format!("sweep study.toml --shard {shard}/3 --into all"));
        assert!(!told.contains("peak of"), "{told}");
    }
    assert_eq!(bench.bytes("all/records/list.json"), list.as_bytes());
    bench.text("merge all -o merged.h5");
    assert!(bench.bytes("merged.h5") == bench.bytes("whole.h5"));
}
