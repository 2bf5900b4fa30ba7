//! Memory stays below ten times the file, whatever the file: measured as the peak of
//! the resident set of a process of its own (Linux; skipped elsewhere).
#![allow(clippy::unwrap_used)]

mod common;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::binary::{Seed, record, steim};
use pounding_ground_motion::{AccelerationUnit, ReadOptions, read_all_bytes, read_bytes};

/// Bytes of each file: large beside what the process needs anyway.
const SIZE: usize = 3 << 20;
/// Bytes of noise behind a header.
const NOISE: usize = 10 << 20;
/// What the allocator and the process may hold besides (bytes).
const SLACK: usize = 2 << 20;

fn status(key: &str) -> Option<usize> {
    let text = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find(|l| l.starts_with(key))?;
    Some(line.split_whitespace().nth(1)?.parse::<usize>().ok()? * 1024)
}

/// Names the file to read to a child, which writes growth and success beside it.
const CHILD: &str = "POUNDING_MEMORY_TEST_FILE";

/// Growth of the resident set in a new process that reads the file with the given
/// step and unit, and whether it could be read.
fn growth(path: &Path, step: bool, unit: bool) -> Option<(usize, bool)> {
    let status = Command::new(std::env::current_exe().ok()?)
        .args(["--exact", "child"])
        .env(CHILD, path)
        .env("POUNDING_MEMORY_TEST_STEP", if step { "1" } else { "0" })
        .env("POUNDING_MEMORY_TEST_UNIT", if unit { "1" } else { "0" })
        .stdout(Stdio::null())
        .status()
        .ok()?;
    assert!(status.success());
    let text = std::fs::read_to_string(path.with_extension("out")).ok()?;
    let (used, read) = text.split_once(' ')?;
    Some((used.parse().ok()?, read == "true"))
}

/// Not a test by itself: the process that reads one file.
#[test]
fn child() {
    let Some(path) = std::env::var_os(CHILD).map(PathBuf::from) else {
        return;
    };
    let bytes = std::fs::read(&path).unwrap();
    let on = |key: &str| std::env::var(key).is_ok_and(|v| v == "1");
    let mut options = ReadOptions {
        sensitivity: Some(1.0e5),
        ..ReadOptions::default()
    };
    options.time_step = on("POUNDING_MEMORY_TEST_STEP").then_some(0.01);
    options.unit = on("POUNDING_MEMORY_TEST_UNIT").then_some(AccelerationUnit::Gal);
    let Some(before) = status("VmRSS:") else {
        return;
    };
    let mut chosen = read_bytes("file", &bytes, &options).is_ok();
    // Values that are no counts have no sensitivity, which is found out once they are read.
    if !chosen {
        options.sensitivity = None;
        chosen = read_bytes("file", &bytes, &options).is_ok();
    }
    let used = status("VmHWM:").unwrap().saturating_sub(before);
    // Several components without a choice between them are read all the same.
    let read = chosen || read_all_bytes("file", &bytes, &options).is_ok();
    std::fs::write(path.with_extension("out"), format!("{used} {read}")).unwrap();
}

fn repeat(unit: &[u8]) -> Vec<u8> {
    unit.repeat(SIZE / unit.len())
}

/// Files that make readers hold as much as they can.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mut all = vec![
        ("newlines", repeat(b"\n")),
        ("one row", repeat(b"1 ")),
        ("one column", repeat(b"1\n")),
        // One series along the rows, and columns that are asked about.
        ("rows of four", repeat(b"1 2 3 4\n4 3 2 1\n")),
        ("columns", repeat(b"1 2 3 4\n")),
        ("cards", (1..SIZE / 14).fold(String::new(), |mut text, i| {
            let _ = writeln!(text, "1 2 3 {i}");
            text
        }).into_bytes()),
        ("uneven times", (0..SIZE / 12).fold(String::new(), |mut text, i| {
            let _ = writeln!(text, "{:.3} 1", 0.012 * i as f64 + 0.001 * (i % 3) as f64);
            text
        }).into_bytes()),
        ("at2", [b"a\nb\nUNITS OF G\nNPTS= 1572864, DT= .01\n".to_vec(), repeat(b"1 ")].concat()),
        ("k-net", {
            let rest = repeat(b"1 ");
            let count = common::COUNT + rest.len() / 2;
            let head = String::from_utf8(common::fixtures("k_net", 0)[0].bytes.clone()).unwrap();
            // The duration of all these samples, as the header is held against them.
            let head = head.replace("(s)  0.23", &format!("(s)  {:.2}", count as f64 / 100.0));
            [head.into_bytes(), rest].concat()
        }),
        ("jma", [b"SITE CODE= 1\nSAMPLING RATE= 100Hz\nUNIT = gal\nNS,EW,UD\n".to_vec(), repeat(b"1,2,3\n")].concat()),
        ("isesd", [b"file: a\nwaveform code: 1\nsampling period: 0.01\nunits: m/s*s\n-> acceleration\n".to_vec(), repeat(b"1 ")].concat()),
        ("small blocks", [b"file: a\nwaveform code: 1\nsampling period: 0.01\nunits: m/s*s\n".to_vec(), repeat(b"-> acceleration\n1 2\n")].concat()),
    ];
    for format in [
        "csmip_v1",
        "csmip_v2",
        "cosmos",
        "geo_net",
        "caltech_volume_1",
        "caltech_volume_2",
        "bhrc",
    ] {
        let small = &common::fixtures(format, 0)[0].bytes;
        all.push((format, repeat(small)));
    }
    // Noise behind the header of raw records: every byte, and digits and blanks alone.
    for (format, name, digits) in [
        ("asa", "asa, noise", "asa, digits"),
        ("usgs_smc", "smc, noise", "smc, digits"),
        ("bhrc", "bhrc, noise", "bhrc, digits"),
        ("nsmn", "nsmn, noise", "nsmn, digits"),
        ("caltech_volume_1", "usc, noise", "usc, digits"),
        ("cosmos", "cosmos, noise", "cosmos, digits"),
    ] {
        let file = common::fixtures(format, 0).pop().unwrap().bytes;
        let head = &file[..file.len() / 2];
        all.push((name, [head, &noise(NOISE, false)].concat()));
        all.push((digits, [head, &noise(NOISE, true)].concat()));
    }
    // Rows that a count of the header allows: all are held.
    let nsmn = String::from_utf8_lossy(&common::fixtures("nsmn", 0)[0].bytes).into_owned();
    let end = nsmn.find("U-D\n").unwrap() + 4;
    let rows = repeat(b"1.0 2 3\n");
    let head = nsmn[..end].replace(": 23\n", &format!(": {}\n", rows.len() / 8));
    let pga = head
        .lines()
        .find(|l| l.starts_with("RAW PGA"))
        .unwrap()
        .to_owned();
    let head = head.replace(&pga, "RAW PGA VALUES (gal)    : (N-S) 1.0 (E-W) 2 (U-D) 3");
    all.push(("nsmn", [head.into_bytes(), rows].concat()));
    all.push(("seed, floats", seeds(4, &[0; 4 * 112], 112)));
    all
}

/// Bytes of a small generator (Marsaglia, 2003, xorshift64), or digits, points and blanks.
fn noise(count: usize, digits: bool) -> Vec<u8> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        if digits {
            b"0123456789.- \n"[(state % 14) as usize]
        } else {
            state as u8
        }
    };
    std::iter::repeat_with(next).take(count).collect()
}

fn seeds(encoding: u8, data: &[u8], count: u16) -> Vec<u8> {
    let one = record(&Seed {
        channel: b"HNE",
        encoding,
        big: true,
        start: 0,
        count,
        data: data.to_vec(),
    });
    let mut bytes = Vec::with_capacity(SIZE + one.len());
    for i in 0..SIZE / one.len() {
        let at = bytes.len();
        bytes.extend(&one);
        // Records follow one another in time, 100 samples a second.
        let tick = i * usize::from(count) * 100;
        let seconds = tick / 10_000;
        let field = &mut bytes[at..];
        field[22..24].copy_from_slice(&(1 + (seconds / 86_400) as u16).to_be_bytes());
        field[24] = (seconds / 3600 % 24) as u8;
        field[25] = (seconds / 60 % 60) as u8;
        field[26] = (seconds % 60) as u8;
        field[28..30].copy_from_slice(&((tick % 10_000) as u16).to_be_bytes());
    }
    bytes
}

/// How many times the file the process took at most beside it, under all options; `None` where that cannot be measured.
fn times_the_file(folder: &Path, number: usize, (name, bytes): &(&str, Vec<u8>)) -> Option<f64> {
    let path = folder.join(number.to_string());
    std::fs::write(&path, bytes).unwrap();
    let (mut worst, mut read) = (0.0_f64, false);
    for (step, unit) in [(false, true), (true, true), (false, false), (true, false)] {
        let (used, done) = growth(&path, step, unit)?;
        read |= done;
        let times = used.saturating_sub(SLACK) as f64 / bytes.len() as f64;
        worst = worst.max(times);
        // The file itself is the tenth part.
        assert!(times <= 9.0, "{name}: {times:.2} times the file");
    }
    let refused = ["newlines", "columns", "small blocks"].contains(name)
        || name.contains(", noise")
        || name.contains(", digits");
    assert!(read || refused, "{name} could not be read");
    Some(worst)
}

#[test]
fn ten_times_the_file_at_most() {
    let folder = tempfile::tempdir().unwrap();
    let files = files();
    // Each process measures itself: as many at once as there are cores.
    let (next, worst) = (AtomicUsize::new(0), Mutex::new(0.0_f64));
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let measured = std::thread::scope(|scope| {
        let work = || {
            while let Some((number, file)) = {
                let number = next.fetch_add(1, Ordering::Relaxed);
                files.get(number).map(|file| (number, file))
            } {
                let times = times_the_file(folder.path(), number, file)?;
                let mut worst = worst.lock().unwrap();
                *worst = worst.max(times);
            }
            Some(())
        };
        let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
        let ended = workers.into_iter().map(|worker| worker.join().unwrap());
        ended.collect::<Option<Vec<()>>>().is_some()
    });
    if !measured {
        return;
    }
    let worst = worst.into_inner().unwrap();
    // A measure that sees nothing would let everything pass.
    assert!(worst > 2.0, "{worst}");
    // Steim-2 packs up to 1.75 samples in a byte, a sample takes eight bytes here.
    let flat = vec![0; 720];
    let bytes = seeds(11, &steim(&flat, 2, true)[..448], 720);
    let count = bytes.len() / 512 * 720;
    let path = folder.path().join("packed");
    std::fs::write(&path, &bytes).unwrap();
    let (used, read) = growth(&path, false, false).unwrap();
    assert!(read);
    let beside = used.saturating_sub(SLACK + 8 * count);
    assert!(
        beside < bytes.len(),
        "{beside} bytes beside {count} samples"
    );
}
