//! Times of first samples: read from headers, moved by what is done to a record, kept in files.
use pounding_ground_motion::processing::{
    Butterworth, Phase, ProcessingStep, Trim, process, rotate,
};
use pounding_ground_motion::writers::{Written, write_pounding_csv};
use pounding_ground_motion::{AccelerationUnit, Accelerogram, ReadOptions, read_bytes};

use crate::common::binary::{SENSITIVITY, Seed, counts, record, sac_with};
use crate::common::fixtures;

fn start(of: &Accelerogram) -> &str {
    &of.origin().unwrap().start_time
}

fn read_sac(begin: f32, reference: [i32; 6], component: &str) -> Accelerogram {
    let integers: Vec<_> = (70..76).zip(reference).collect();
    let options = ReadOptions {
        unit: Some(AccelerationUnit::StandardGravity),
        ..ReadOptions::default()
    };
    let bytes = sac_with(&[(5, begin), (6, begin + 0.22)], &integers, component);
    read_bytes("f", &bytes, &options).unwrap()
}

/// The first sample of a SAC file is B after its reference time.
#[test]
fn sac_starts_after_its_reference() {
    let first = read_sac(10.0, [2019, 187, 3, 19, 53, 40], "HNE");
    assert_eq!(start(&first), "2019 day 187 03:20:03.040 UTC");
    let same = read_sac(0.0, [2019, 187, 3, 20, 3, 40], "HNN");
    assert_eq!(start(&same), start(&first));
    rotate(&first, &same, 30.0).unwrap();
    let later = read_sac(13.0, [2019, 187, 3, 19, 53, 40], "HNN");
    let error = rotate(&first, &later, 30.0).unwrap_err().to_string();
    assert!(
        error.contains("03:20:03.040") && error.contains("03:20:06.040"),
        "{error}"
    );
    let before = read_sac(-0.5, [2000, 1, 0, 0, 0, 0], "HNE");
    assert_eq!(start(&before), "1999 day 365 23:59:59.500 UTC");
    assert_eq!(start(&read_sac(1.0, [2000, 1, 0, 0, 0, -12345], "HNE")), "");
}

/// GeoNet states the start of the buffer in integers, the earthquake's origin in words.
#[test]
fn geo_net_starts_with_its_buffer() {
    let read = |numbers: bool| {
        let fixture = fixtures("geo_net", 0).remove(0);
        let mut lines: Vec<String> = String::from_utf8(fixture.bytes)
            .unwrap()
            .lines()
            .map(str::to_owned)
            .collect();
        // Integer `index` of the header of the first component.
        let mut put = |index: usize, value: i64| {
            let (row, column) = (16 + (index - 1) / 10, 8 * ((index - 1) % 10));
            lines[row].replace_range(column..column + 8, &format!("{value:>8}"));
        };
        if numbers {
            for (index, value) in [
                (9, 2016),
                (10, 11),
                (19, 13),
                (20, 11),
                (39, 2),
                (40, 20_000),
            ] {
                put(index, value);
            }
        }
        let text = lines.join("\n") + "\n";
        let options = ReadOptions {
            component: Some("N10E".to_owned()),
            ..fixture.options
        };
        read_bytes("f", text.as_bytes(), &options).unwrap()
    };
    assert_eq!(start(&read(true)), "2016-11-13 11:02:20.000 UT");
    assert_eq!(start(&read(false)), "");
}

/// A time correction may lead to another day.
#[test]
fn mini_seed_starts_with_its_correction() {
    let read = |clock: u32, correction: i32| {
        let values = counts();
        let mut bytes = record(&Seed {
            channel: b"HNE",
            encoding: 3,
            big: true,
            start: clock,
            count: u16::try_from(values.len()).unwrap(),
            data: values.iter().flat_map(|c| c.to_be_bytes()).collect(),
        });
        bytes[40..44].copy_from_slice(&correction.to_be_bytes());
        let options = ReadOptions {
            sensitivity: Some(SENSITIVITY),
            ..ReadOptions::default()
        };
        read_bytes("f", &bytes, &options).unwrap()
    };
    // In ten-thousandths of a second, from the first of January 2000 on.
    assert_eq!(start(&read(1_100, 0)), "2000 day 1 00:00:00.1100 UTC");
    assert_eq!(
        start(&read(1_000, -5_000)),
        "1999 day 365 23:59:59.6000 UTC"
    );
    let day = 864_000_000;
    assert_eq!(
        start(&read(5_000, day - 2_000)),
        "2000 day 2 00:00:00.3000 UTC"
    );
}

fn csv(component: &str, start: &str) -> Accelerogram {
    let rows: String = (0..400)
        .map(|i| format!("{},{}\n", f64::from(i) * 0.01, f64::from(i % 7) - 3.0))
        .collect();
    let text = format!(
        "# Component: {component}\n# Start: {start}\n# dt: 0.01 s\ntime_s,acceleration_m_s2\n{rows}"
    );
    read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap()
}

/// Steps that put samples before the record, or take them off, move its start.
#[test]
fn steps_move_the_start() {
    let first = csv("N-S", "2011/03/11 23:59:58 JST");
    assert_eq!(start(&first), "2011/03/11 23:59:58 JST");
    let filter = |keep_pads| {
        ProcessingStep::Filter(Butterworth {
            phase: Phase::Zero { keep_pads },
            ..Butterworth::zero_phase(Some(1.5), None)
        })
    };
    let cut = ProcessingStep::Trim(Trim::Times {
        start: 2.5,
        end: 3.5,
    });
    let pad = ProcessingStep::Pad {
        before: 1.0,
        after: 2.0,
    };
    for (step, found) in [
        (filter(true), "2011/03/11 23:59:56 JST"),
        (filter(false), "2011/03/11 23:59:58 JST"),
        (cut.clone(), "2011/03/12 00:00:00.5 JST"),
        (pad.clone(), "2011/03/11 23:59:57 JST"),
    ] {
        let moved = process(&first, std::slice::from_ref(&step)).unwrap();
        let moved = moved.accelerogram;
        assert_eq!(start(&moved), found, "{step:?}");
        let text = write_pounding_csv(&Written::of(&moved)).unwrap();
        let back = read_bytes("f", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_eq!(start(&back), found);
    }
    // Filtered components and others do not start together any more.
    let other = csv("E-W", "2011/03/11 23:59:58 JST");
    rotate(&first, &other, 30.0).unwrap();
    for step in [filter(true), cut.clone(), pad] {
        let moved = process(&first, std::slice::from_ref(&step)).unwrap();
        let error = rotate(&moved.accelerogram, &other, 30.0).unwrap_err();
        assert!(error.to_string().contains("start together"), "{step:?}");
        let both = process(&other, &[step]).unwrap().accelerogram;
        rotate(&moved.accelerogram, &both, 30.0).unwrap();
    }
    // What cannot be moved is left out, with a remark.
    let odd = csv("N-S", "in the evening");
    let moved = process(&odd, &[cut]).unwrap().accelerogram;
    assert_eq!(start(&moved), "");
    let warnings = &moved.origin().unwrap().warnings;
    assert!(
        warnings
            .iter()
            .any(|w| w.contains("2.5 s later") && w.contains("evening")),
        "{warnings:?}"
    );
}

/// JMA prints blanks between the parts of a time: records that start apart are no components of one.
#[test]
fn jma_starts_between_blanks() {
    let read = |component: &str, start: &str| {
        let fixture = fixtures("jma_csv", 0).remove(0);
        let text: String = fixture.bytes.iter().map(|b| char::from(*b)).collect();
        let text = text.replace("2000 01 01 00 00 00", start);
        let bytes: Vec<u8> = text.chars().map(|c| c as u8).collect();
        let options = ReadOptions {
            component: Some(component.to_owned()),
            ..fixture.options
        };
        read_bytes("f", &bytes, &options).unwrap()
    };
    let first = read("NS", "2011 03 11 14 46 00");
    assert_eq!(start(&first), "2011 03 11 14 46 00 JST");
    rotate(&first, &read("EW", "2011 03 11 14 46 00"), 30.0).unwrap();
    for other in ["2011 03 11 14 46 10", "2011 03 12 14 46 00"] {
        let error = rotate(&first, &read("EW", other), 30.0).unwrap_err();
        assert!(error.to_string().contains("start together"), "{error}");
    }
    let cut = ProcessingStep::Trim(Trim::Times {
        start: 0.05,
        end: 0.2,
    });
    let moved = process(&first, &[cut]).unwrap().accelerogram;
    assert_eq!(start(&moved), "2011 03 11 14 46 00.05 JST");
    // No such day.
    let odd = read("NS", "2011 13 41 14 46 00");
    assert_eq!(start(&odd), "");
    let said = |w: &String| w.contains("2011 13 41") && w.contains("is not used");
    assert!(odd.origin().unwrap().warnings.iter().any(said));
}

/// Starts in any two notations are compared: as instants where both state their zones, else as clocks show them.
#[test]
fn starts_in_other_notations_are_compared() {
    let first = csv("N-S", "2011/03/11 14:46:15 JST");
    for together in [
        "2011/03/11 05:46:15 UTC",
        "2011-03-11T06:46:15+01:00",
        "2011/03/11 14:46:30 JST less 15 s",
        "2011 day 70 05:46:15.000 UTC",
        "20110311_144615",
        "2011/03/11 02:46:15 PM",
        "",
    ] {
        let pair = rotate(&first, &csv("E-W", together), 30.0).unwrap();
        let warnings = &pair.first.origin().unwrap().warnings;
        assert!(warnings.is_empty(), "{together}: {warnings:?}");
    }
    for apart in [
        "2011/03/11 14:46:15 UTC",
        "2011/03/11 14:46:15 JST less 15 s",
        "2011 day 70 05:46:25 UTC",
        "20110311_144625",
        "2011/03/11 02:46:15 AM",
        "2011-03-11T05:46:15+02:00",
    ] {
        let error = rotate(&first, &csv("E-W", apart), 30.0).unwrap_err();
        let said = error.to_string();
        assert!(
            said.contains("start together") && said.contains(apart),
            "{said}"
        );
    }
    for unlike in ["in the evening", "14:46:15", "2011/03/11 14:46:15 CST"] {
        for (a, b) in [(&first, &csv("E-W", unlike)), (&csv("E-W", unlike), &first)] {
            let pair = rotate(a, b, 30.0).unwrap();
            let warnings = &pair.first.origin().unwrap().warnings;
            let says = |w: &String| w.contains(unlike) && w.contains("cannot be compared");
            assert!(warnings.iter().any(says), "{unlike}: {warnings:?}");
        }
    }
}

/// Hours that are counted to 12 stay in their half of the day.
#[test]
fn starts_before_and_after_noon_are_moved() {
    let cut = ProcessingStep::Trim(Trim::Times {
        start: 1.0,
        end: 1.5,
    });
    for (text, moved) in [
        ("2012/05/29 11:59:59 AM", "2012/05/29 12:00:00 PM"),
        ("2012/05/29 11:59:59 PM", "2012/05/30 12:00:00 AM"),
        ("2012/05/29 12:59:59 PM", "2012/05/29 01:00:00 PM"),
    ] {
        let found = process(&csv("N-S", text), std::slice::from_ref(&cut)).unwrap();
        assert_eq!(start(&found.accelerogram), moved);
    }
}
