//! Damaged files: an error that names the place, never a panic, never a hang.
//! Every reader of the registry gets the same bounded number of inputs.
use crate::common::{self, Fixture, all, fixtures};
use pounding_ground_motion::{
    AccelerationUnit, Format, GroundMotionError, Offset, ReadOptions, read_all_bytes, read_bytes,
};

/// A small generator of random numbers (Marsaglia, 2003, xorshift64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }
}

/// The error names the file first, and a place in it wherever it has one.
fn names_its_place(error: &GroundMotionError, length: usize, what: &str) {
    let text = error.to_string();
    assert!(error.help().is_some(), "{what}: {text}");
    match error {
        GroundMotionError::Parse { line, column, .. }
        | GroundMotionError::TooFewSamples { line, column, .. } => {
            assert!(*line >= 1 && *column >= 1, "{what}: {text}");
            assert!(*line <= length + 2, "{what}: {text}");
            assert!(
                text.starts_with(&format!("file:{line}:{column}: ")),
                "{text}"
            );
        }
        GroundMotionError::Binary { offset, .. } => {
            assert!(*offset <= length, "{what}: {text}");
            assert!(
                text.starts_with(&format!("file: byte {offset}: ")),
                "{text}"
            );
        }
        GroundMotionError::Invalid(reason) => assert!(reason.starts_with("file"), "{text}"),
        GroundMotionError::Unit { .. } => {}
        _ => assert!(text.starts_with("file"), "{what}: {text}"),
    }
}

/// Whether what was read from a damaged file is what the whole file holds.
fn is_whole(fixture: &Fixture, bytes: &[u8]) -> bool {
    let whole = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap();
    let read = read_all_bytes("file", bytes, &fixture.options).unwrap();
    let samples = |r: &pounding_ground_motion::Recording| {
        r.series
            .iter()
            .map(|s| s.samples.clone())
            .collect::<Vec<_>>()
    };
    samples(&read) == samples(&whole)
}

/// Whether a cut at this byte can leave a file that is whole in itself: formats
/// without a count, and between the channels of those with one.
fn may_end_here(fixture: &Fixture, at: usize) -> bool {
    let ends = match fixture.format {
        "csmip_v1" | "csmip_v2" | "caltech_volume_1" | "bhrc" => "/&",
        "cosmos" => "End-of-data",
        "geo_net" => "accelerogram 2",
        "isesd" => "-> ",
        "mini_seed_2" => return at.is_multiple_of(512),
        // The truth is written in the last block, or there is no count.
        _ => return !fixture.counted && fixture.format != "sac",
    };
    // A piece of a header that the next channel starts with is an error of its own.
    let text = String::from_utf8_lossy(&fixture.bytes[..at]).into_owned();
    text.contains(ends)
}

#[test]
fn truncated_at_every_64th_byte() {
    for fixture in all(0) {
        for at in (0..fixture.bytes.len()).step_by(64) {
            let bytes = &fixture.bytes[..at];
            let what = format!("{} cut at {at} of {}", fixture.name, fixture.bytes.len());
            match read_all_bytes("file", bytes, &fixture.options) {
                Err(error) => names_its_place(&error, at, &what),
                Ok(_) => assert!(
                    is_whole(&fixture, bytes) || may_end_here(&fixture, at),
                    "{what} was read"
                ),
            }
        }
    }
}

/// What is left of `1.494E-02` is a number of another size.
#[test]
fn a_last_value_cut_before_its_exponent() {
    let file = |values: &str| {
        format!(
            "PEER\nEL CENTRO\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   4, DT=   .0100 SEC\n{values}"
        )
    };
    let mut options = ReadOptions::default();
    for (values, is_cut) in [
        (" .600E-02 -.200E-01\n .370E-01 .149E-01\n", false),
        (" .600E-02 -.200E-01\n .370E-01 .149E-01", false),
        (" .600E-02 -.200E-01\n .370E-01 .149", true),
        (" .600E-02 -.200E-01 .370E-01\n .1", true),
        (" .600E-02 -.200E-01 .370E-01\n .149E-0", true),
        (" .600E-02 -.200E-01\n .370E-01 .149\n", false),
        (" 6e-05 -2.15e-05\n 3.7e-05 0.000149", false),
        (" .006 -.02\n .037 .149", false),
    ] {
        options.lenient = false;
        let read = read_all_bytes("file", file(values).as_bytes(), &options);
        match read {
            Err(error) => {
                let told = error.to_string();
                assert!(
                    is_cut && told.contains("ends within its last value"),
                    "{told}"
                );
            }
            Ok(_) => assert!(!is_cut, "{values:?}"),
        }
        options.lenient = true;
        assert!(read_all_bytes("file", file(values).as_bytes(), &options).is_ok());
    }
}

/// A sensitivity says that a SAC file holds counts, also beside its own unit.
#[test]
fn sac_in_counts() {
    let sac = &fixtures("sac", 0)[0].bytes;
    let mut options = ReadOptions {
        unit: Some(AccelerationUnit::MetrePerSecondSquared),
        offset: Offset::Keep,
        ..ReadOptions::default()
    };
    let peak = |options: &ReadOptions| read_bytes("file", sac, options).unwrap().peak().value.abs();
    let in_unit = peak(&options);
    options.sensitivity = Some(1000.0);
    let counts = peak(&options);
    assert!((counts * 1000.0 / in_unit - 1.0).abs() < 1e-12);
    options.unit = None;
    assert!(peak(&options) == counts);
    options.unit = Some(AccelerationUnit::StandardGravity);
    let both = read_bytes("file", sac, &options).unwrap_err();
    assert!(
        both.to_string()
            .contains("both the unit g and a sensitivity"),
        "{both}"
    );
}

/// Bytes changed, doubled, swapped and taken out, 300 times a file.
#[test]
fn corrupted() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    for fixture in all(0) {
        for round in 0..300 {
            let mut bytes = fixture.bytes.clone();
            for _ in 0..=random.below(6) {
                let at = random.below(bytes.len());
                match random.below(5) {
                    0 => bytes[at] = random.next() as u8,
                    1 => bytes[at] = b"0123456789-+.eED *\n\r\t/|,(:"[random.below(26)],
                    2 => {
                        bytes.remove(at);
                    }
                    3 => bytes.insert(at, b"9- \n\0\xff"[random.below(6)]),
                    _ => {
                        let end = (at + random.below(80)).min(bytes.len());
                        let piece = bytes[at..end].to_vec();
                        let to = random.below(bytes.len());
                        bytes.splice(to..to, piece);
                    }
                }
            }
            let what = format!("{} round {round}", fixture.name);
            let mut options = fixture.options.clone();
            options.lenient = round % 3 == 0;
            options.format = (round % 2 == 0).then(|| Format::find(fixture.format).unwrap());
            options.offset = Offset::Automatic;
            if let Err(error) = read_all_bytes("file", &bytes, &options) {
                names_its_place(&error, bytes.len(), &what);
            }
            options.component = Some("1".to_owned());
            options.time_step = options.time_step.or(Some(0.004)).filter(|_| round % 5 == 0);
            if let Err(error) = read_bytes("file", &bytes, &options) {
                names_its_place(&error, bytes.len(), &what);
            }
        }
    }
}

/// Random bytes, random numbers, and random bytes after each format's first lines.
#[test]
fn random_bytes() {
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    for format in Format::all() {
        let start = &fixtures(format.name, 0)[0].bytes;
        for round in 0..200 {
            let mut bytes: Vec<u8> = match round % 4 {
                0 => Vec::new(),
                _ => start[..random.below(start.len())].to_vec(),
            };
            for _ in 0..random.below(2000) {
                bytes.push(match round % 3 {
                    0 => random.next() as u8,
                    1 => b"0123456789-+. \n\nE,"[random.below(18)],
                    _ => random.below(128) as u8,
                });
            }
            let options = ReadOptions {
                format: (round % 2 == 0).then_some(*format),
                unit: Some(AccelerationUnit::Gal).filter(|_| round % 5 != 0),
                time_step: Some(0.01).filter(|_| round % 7 != 0),
                lenient: round % 3 == 0,
                sensitivity: Some(1.0e5),
                ..ReadOptions::default()
            };
            let what = format!("{} round {round}", format.name);
            if let Err(error) = read_bytes("file", &bytes, &options) {
                names_its_place(&error, bytes.len(), &what);
            }
        }
    }
}

/// Ten megabytes of noise behind the header of every format are refused, with their place.
#[test]
fn noise_behind_every_header() {
    let mut random = Random(0x9e37_79b9_7f4a_7c15);
    let noise: Vec<u8> = std::iter::repeat_with(|| random.next() as u8)
        .take(10 << 20)
        .collect();
    for format in Format::all() {
        for fixture in fixtures(format.name, 0) {
            let head = &fixture.bytes[..fixture.bytes.len() / 2];
            let bytes = [head, &noise[..]].concat();
            let options = ReadOptions {
                format: Some(format),
                ..fixture.options.clone()
            };
            let read = read_all_bytes("file", &bytes, &options);
            assert!(read.is_err(), "{} is read", fixture.name);
            let error = read.unwrap_err();
            names_its_place(&error, bytes.len(), fixture.name);
        }
    }
}

/// What is no record is told from its start, and what is too large from its size.
#[test]
fn zeros_are_no_record() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("zeros");
    let file = std::fs::File::create(&path).unwrap();
    // Sparse: no disk holds them.
    for (size, says) in [
        (8_u64 << 20, "the format of this record is not known"),
        (300 << 20, "the file has 300 MiB, more than the 256"),
    ] {
        file.set_len(size).unwrap();
        let error = pounding_ground_motion::read(&path, &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
        assert!(error.help().is_some());
    }
}

/// Headers that promise more than any file holds.
#[test]
fn enormous_counts() {
    let huge = "999999999";
    for (format, from) in [
        ("peer_at2", "NPTS=     23"),
        ("dyna", "NDATA: 23"),
        ("isesd", "number of samples: 23"),
        ("asa", "/23/23/23"),
        ("plain_columns", "23 0.005"),
    ] {
        for fixture in fixtures(format, 0).iter().filter(|f| f.counted) {
            let text = String::from_utf8(fixture.bytes.clone()).unwrap();
            assert!(text.contains(from), "{}", fixture.name);
            let text = text.replace(from, &from.replace("23", huge));
            let error = read_all_bytes("file", text.as_bytes(), &fixture.options).unwrap_err();
            assert!(
                matches!(
                    error,
                    GroundMotionError::TooFewSamples {
                        expected: 999_999_999,
                        ..
                    }
                ),
                "{}: {error}",
                fixture.name
            );
        }
    }
    for fixture in fixtures("sac", i64::from(i32::MAX) - common::COUNT as i64) {
        let error = read_all_bytes("file", &fixture.bytes, &fixture.options).unwrap_err();
        assert!(matches!(error, GroundMotionError::Binary { .. }), "{error}");
    }
}

/// Numbers that no recorder of K-NET can give are refused where they stand: counts beyond
/// its 24 bits (and beyond 32), and a header that promises more samples than fit anywhere.
#[test]
fn impossible_counts_of_k_net_are_refused() {
    let fixture = fixtures("k_net", 0).into_iter().next();
    let fixture = fixture.unwrap();
    let text = String::from_utf8(fixture.bytes.clone()).unwrap();
    let lines = text.lines().count();
    let data = text.find("Memo.").unwrap();
    let end_of_header = data + text[data..].find('\n').unwrap() + 1;
    let free = |counts: &str| format!("{}{counts}\n", &text[..end_of_header]);
    let said = |text: String| {
        let read = read_bytes("file", text.as_bytes(), &fixture.options);
        let error = read.unwrap_err();
        names_its_place(&error, lines, "k_net");
        error.to_string()
    };
    let huge = said(free("1 2 9000000000000000000 3"));
    assert!(huge.contains("9e18") && huge.contains("24 bits"), "{huge}");
    // Without blanks they are no columns of nine digits.
    let row = "9000000000000000000".repeat(8);
    assert_eq!(row.len() % 9, 8);
    let glued = said(free(&row));
    assert!(glued.starts_with("file:18:1: "), "{glued}");
    assert!(glued.contains("24 bits"), "{glued}");
    // Nor where every nine digits of them would be a count that is possible.
    let row = "000000017".repeat(8);
    let glued = said(free(&row[..71]));
    assert!(glued.starts_with("file:18:1: "), "{glued}");
    assert!(glued.contains("24 bits"), "{glued}");
    for count in ["99999999", "8388609", "-8388609"] {
        let shown = said(free(&format!("1 2 {count} 3")));
        assert!(shown.starts_with("file:18:5: "), "{shown}");
        assert!(
            shown.contains(count) && shown.contains("24 bits"),
            "{shown}"
        );
    }
    // The full range, of which -2^23 is a part.
    let full = "8388607 -8388608 ".repeat(common::COUNT);
    let full = free(full.trim()).replace("(s)  0.23", "(s)  0.46");
    // Their peak is not the header's.
    let lenient = ReadOptions {
        lenient: true,
        ..fixture.options.clone()
    };
    read_bytes("file", full.as_bytes(), &lenient).unwrap();
    // 136 samples where the header allows 64.
    let many = free(&"17 ".repeat(136)).replace("(s)  0.23", "(s)  0.64");
    let many = said(many);
    assert!(
        many.contains("0.64 s") && many.contains("136 samples"),
        "{many}"
    );
    let frequency = text.replace("100Hz", "9000000000000000000Hz");
    let promised = said(frequency);
    assert!(
        promised.contains("samples, which no record has"),
        "{promised}"
    );
}

/// Bytes that a system did not write are NUL: a line of them must not pass for a blank one, in no
/// text.
#[test]
fn a_block_of_nul_is_no_blank_line() {
    for fixture in all(0) {
        let bytes = fixture.bytes.clone();
        if ["mini_seed_2", "sac"].contains(&fixture.format) {
            // Zeros are numbers there.
            assert!(bytes.contains(&0), "{}", fixture.name);
            continue;
        }
        assert!(!bytes.contains(&0), "{}", fixture.name);
        let lines: Vec<&[u8]> = bytes.split_inclusive(|b| *b == b'\n').collect();
        // The last line, which is one of values or of an end; and one within the header or the
        // values.
        for at in [lines.len() - 1, lines.len() / 2] {
            let mut damaged = Vec::new();
            for (i, line) in lines.iter().enumerate() {
                let nul = |b: &u8| if b"\r\n".contains(b) { *b } else { 0 };
                match i == at {
                    true => damaged.extend(line.iter().map(nul).chain([0])),
                    false => damaged.extend_from_slice(line),
                }
            }
            let options = ReadOptions {
                format: Some(Format::find(fixture.format).unwrap()),
                lenient: true,
                ..fixture.options.clone()
            };
            let error = read_all_bytes("file", &damaged, &options).unwrap_err();
            let told = error.to_string();
            assert!(told.contains("a NUL byte"), "{}: {told}", fixture.name);
            let (line, after) = (at + 1, at + 2);
            let placed =
                told.contains(&format!("file:{line}:")) || told.contains(&format!("file:{after}:"));
            assert!(placed, "{} line {line}: {told}", fixture.name);
        }
    }
}
