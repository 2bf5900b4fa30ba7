//! The record of a case: how it is read and what is done to it.
use std::path::Path;

use pounding_case::{BandSource, Case, CaseError, SpectrumSource, process_steps, schema};
use pounding_ground_motion::processing::{
    Baseline, Butterworth, Interpolation, OffsetCorrection, Phase, ProcessingStep, Scale,
    SegmentWindow, Trim,
};
use pounding_ground_motion::spectra::design::{
    Asce7Of2016, CodeSpectrum, Eurocode8Of2004, GroundType, SpectrumType,
};
use pounding_ground_motion::{AccelerationUnit, Offset};

const START: &str = r#"[[building]]
name = "a"
mass = ["25 t"]
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[ground_motion]
file = "record.at2"
"#;

fn parse(keys: &str) -> Result<Case, CaseError> {
    Case::parse(&format!("{START}{keys}"), Path::new("case.toml"))
}

#[test]
fn nothing_is_done_unless_asked_for() {
    let motion = parse("").unwrap().ground_motion;
    assert_eq!(motion.offset, Offset::Automatic);
    assert!(motion.process.is_empty());
    assert_eq!(motion.scale, None);
    assert_eq!(
        (
            motion.quantity,
            motion.sensitivity,
            motion.gravity,
            motion.skip_columns
        ),
        (None, None, None, 0)
    );
}

#[test]
fn options_of_the_reader() {
    let motion = parse(
        "quantity = \"acceleration\"\nskip_columns = 12\nsensitivity = 213945\ngravity = \"981 gal\"\noffset = \"remove\"\ncomponent = \"N10E\"",
    )
    .unwrap()
    .ground_motion;
    assert_eq!(motion.quantity.unwrap().value, "acceleration");
    assert_eq!(motion.skip_columns, 12);
    assert_eq!(motion.sensitivity, Some(213_945.0));
    assert_eq!(motion.gravity, Some(9.81));
    assert_eq!(motion.offset, Offset::Remove);
    assert_eq!(motion.component.as_deref(), Some("N10E"));
    let counts = parse("sensitivity = \"2139.45 s^2/cm\"").unwrap();
    assert!((counts.ground_motion.sensitivity.unwrap() - 213_945.0).abs() < 1e-9);
}

/// Every step in SI units, in the order of the file.
#[test]
fn steps() {
    let text = r#"process = [
        { true_unit = "g" },
        { sign = "reversed" },
        { remove_offset = "mean" },
        { remove_offset = { pre_event = "5 s" } },
        { remove_offset = { value = "-2 gal" } },
        { filter = { high_pass = "0.1 Hz", low_pass = "25 Hz" } },
        { filter = { low_pass = "62.83185307179586 rad/s", order = 2, phase = "causal" } },
        { baseline = { acceleration = 0 } },
        { baseline = { velocity = 2 } },
        { baseline = { start = "3 s", end = "10 s", fit_from = "20 s" } },
        { baseline = { threshold = "0.5 m/s^2" } },
        { trim = { end = "30 s" } },
        { trim = { arias_from = "0.1 %", arias_to = 0.999 } },
        { taper = { end = "2 s" } },
        { pad = { before = 1, after = "10 s" } },
        { resample = { time_step = "5 ms", interpolation = "band_limited" } },
        { scale = { psa = "0.8 g", period = "1 s" } },
    ]"#;
    let case = parse(text).unwrap();
    let steps: Vec<_> = case
        .ground_motion
        .process
        .iter()
        .map(|s| &s.value)
        .collect();
    assert_eq!(steps.len(), 17);
    let gravity = AccelerationUnit::StandardGravity;
    assert_eq!(*steps[0], ProcessingStep::Unit(gravity));
    assert_eq!(*steps[1], ProcessingStep::Sign);
    assert_eq!(*steps[2], ProcessingStep::Offset(OffsetCorrection::Mean));
    let pre_event = OffsetCorrection::PreEventMean(5.0);
    assert_eq!(*steps[3], ProcessingStep::Offset(pre_event));
    let value = OffsetCorrection::Value(-0.02);
    assert_eq!(*steps[4], ProcessingStep::Offset(value));
    let filter = ProcessingStep::Filter(Butterworth {
        order: 4,
        high_pass: Some(0.1),
        low_pass: Some(25.0),
        phase: Phase::Zero { keep_pads: true },
    });
    assert_eq!(*steps[5], filter);
    // 20 pi rad/s are 10 Hz.
    assert!(matches!(
        steps[6],
        ProcessingStep::Filter(Butterworth {
            order: 2, high_pass: None, low_pass: Some(f), phase: Phase::Causal,
        }) if (f - 10.0).abs() < 1e-12
    ));
    let of_acceleration = Baseline::Acceleration { degree: 0 };
    assert_eq!(*steps[7], ProcessingStep::Baseline(of_acceleration));
    let of_velocity = Baseline::Velocity { degree: 2 };
    assert_eq!(*steps[8], ProcessingStep::Baseline(of_velocity));
    let segments = Baseline::TwoSegments {
        window: SegmentWindow::Times {
            start: 3.0,
            end: 10.0,
        },
        fit_from: Some(20.0),
    };
    assert_eq!(*steps[9], ProcessingStep::Baseline(segments));
    let threshold = Baseline::TwoSegments {
        window: SegmentWindow::Threshold(0.5),
        fit_from: None,
    };
    assert_eq!(*steps[10], ProcessingStep::Baseline(threshold));
    let times = Trim::Times {
        start: 0.0,
        end: 30.0,
    };
    assert_eq!(*steps[11], ProcessingStep::Trim(times));
    let arias = Trim::Arias {
        from: 0.001,
        to: 0.999,
    };
    assert_eq!(*steps[12], ProcessingStep::Trim(arias));
    assert_eq!(
        *steps[13],
        ProcessingStep::Taper {
            start: 0.0,
            end: 2.0
        }
    );
    assert_eq!(
        *steps[14],
        ProcessingStep::Pad {
            before: 1.0,
            after: 10.0
        }
    );
    let resample = ProcessingStep::Resample {
        time_step: 0.005,
        interpolation: Interpolation::BandLimited,
    };
    assert_eq!(*steps[15], resample);
    let scale = Scale::SpectralAcceleration {
        period: 1.0,
        damping: 0.05,
        target: 0.8 * 9.80665,
    };
    assert_eq!(*steps[16], ProcessingStep::Scale(scale));
}

#[test]
fn scales() {
    let scale = |text: &str| {
        parse(&format!("scale = {text}")).map(|c| c.ground_motion.scale.unwrap().value)
    };
    assert_eq!(scale("2").unwrap(), Scale::Factor(2.0));
    assert_eq!(
        scale("{ pgv = \"40 cm/s\" }").unwrap(),
        Scale::PeakVelocity(0.4)
    );
    let band = scale("{ target = \"s.csv\", from = \"0.2 s\", to = \"2 s\", damping = \"2 %\" }");
    assert!(matches!(
        band.unwrap(),
        Scale::Band(BandSource { spectrum: SpectrumSource::File(target), from: Some(0.2), to: Some(2.0), times: 1.0 })
            if target.file.value == Path::new("s.csv") && target.damping == 0.02
    ));
    let of_code = |text: &str| match scale(text).unwrap() {
        Scale::Band(BandSource {
            spectrum: SpectrumSource::Code(code),
            from,
            to,
            times: 1.0,
        }) => (code.value, from, to),
        other => panic!("{other:?}"),
    };
    let eurocode = CodeSpectrum::Eurocode8Of2004(Eurocode8Of2004 {
        ground_acceleration: 0.25 * 9.80665,
        ground: GroundType::C,
        spectrum: SpectrumType::Type1,
        damping: 0.05,
    });
    let text = "{ code = \"eurocode_8_2004\", ground_type = \"C\", ag = \"0.25 g\" }";
    assert_eq!(of_code(text), (eurocode, None, None));
    let asce = CodeSpectrum::Asce7Of2016(Asce7Of2016 {
        short_period: 9.80665,
        one_second: 6.0,
        long_transition: 8.0,
    });
    let text = "{ code = \"asce_7_2016\", s_ds = \"1 g\", s_d1 = 6.0, t_l = \"8 s\", from = \"0.2 s\", to = 2 }";
    assert_eq!(of_code(text), (asce, Some(0.2), Some(2.0)));
}

/// What is wrong, its column in line 9, and a part of message or remedy.
const WRONG: &[(&str, usize, &str)] = &[
    (
        "scale = { code = \"eurocode_8\", ag = 1 }",
        18,
        "eurocode_8_2004",
    ),
    (
        "scale = { code = \"eurocode_8_2004\", ag = 1 }",
        9,
        "needs `ground_type`",
    ),
    (
        "scale = { code = \"eurocode_8_2004\", ag = 1, ground_type = \"F\" }",
        59,
        "`ground_type`",
    ),
    (
        "scale = { code = \"eurocode_8_2004\", ag = 1, ground_type = \"A\", spectrum_type = 3 }",
        9,
        "write 1 or 2",
    ),
    (
        "scale = { code = \"asce_7_2016\", s_ds = 1, s_d1 = 1, t_l = 8, ag = 1 }",
        9,
        "has no `ag`",
    ),
    (
        "scale = { code = \"asce_7_2016\", s_ds = 1, s_d1 = 1, t_l = 8, damping = 0.02 }",
        9,
        "damping ratio of 5 %",
    ),
    ("rotate = 30", 10, "belong together"),
    ("rotate = \"30 mm\"", 10, "a number of degrees"),
    (
        "rotate = \"30 rad\"\nsecond_component = \"90\"",
        10,
        "a number of degrees for example 30",
    ),
    ("rotate = inf", 10, "not a finite number"),
    ("second_component = \"90\"", 20, "belong together"),
    ("gravity = \"9.81 m\"", 11, "must be an acceleration"),
    ("sensitivity = 0", 15, "greater than zero"),
    ("sensitivity = \"2 m/s^2\"", 15, "`sensitivity` must be"),
    ("skip_columns = -1", 16, "whole number from 0"),
    (
        "offset = \"removed\"",
        10,
        "write \"automatic\" or \"keep\" or \"remove\"",
    ),
    ("offset = true", 10, "must be a text"),
    (
        "scale = { target = \"t.csv\", from = 2, to = \"1 s\" }",
        9,
        "`from` = 2 s is not below `to` = 1 s",
    ),
    (
        "scale = { code = \"eurocode_8_2004\", ag = 3, ground_type = \"C\", from = 1, to = 1 }",
        9,
        "give the smaller one first",
    ),
    (
        "process = [{ scale = { target = \"t.csv\", from = 2, to = 1 } }]",
        12,
        "is not below",
    ),
    ("process = { }", 11, "must be a list of steps"),
    ("process = [\"mean\"]", 12, "must be a table"),
    ("process = [{ }]", 12, "has one key, not 0"),
    (
        "process = [{ sign = \"reversed\", taper = { end = 1 } }]",
        12,
        "has one key, not 2",
    ),
    (
        "process = [{ true_unit = \"m/s\" }]",
        12,
        "it is one of velocity",
    ),
    ("process = [{ filtr = { } }]", 14, "did you mean `filter`?"),
    (
        "process = [{ filter = { high_pass = \"1 s\" } }]",
        37,
        "must be a frequency",
    ),
    (
        "process = [{ filter = { high_pass = 1, phase = \"causal\", keep_pads = false } }]",
        23,
        "`keep_pads` has no meaning beside phase = \"causal\"",
    ),
    (
        "process = [{ filter = { order = 4 } }]",
        23,
        "`high_pass`, `low_pass` or both",
    ),
    (
        "process = [{ filter = { } }]",
        23,
        "`filter` needs `high_pass`, `low_pass` or both for example filter = { high_pass = \"0.1 Hz\", low_pass = \"25 Hz\" }; known keys: high_pass, low_pass, order, phase, keep_pads",
    ),
    (
        "process = [{ filter = { low_pass = 5, order = 0 } }]",
        47,
        "`order` must be a whole number from 1 to 12 correct",
    ),
    (
        "process = [{ filter = { low_pass = 5, order = 13 } }]",
        47,
        "`order` must be a whole number from 1 to 12 correct",
    ),
    (
        "process = [{ filter = { low_pass = 5, phase = \"minimum\" } }]",
        47,
        "write \"zero\" or \"causal\"",
    ),
    (
        "process = [{ remove_offset = 0.1 }]",
        30,
        "must be a text in quotes, or a table, not a number write \"mean\", { pre_event = \"10 s\" } or { value = \"0.1 m/s2\" }",
    ),
    (
        "process = [{ remove_offset = \"median\" }]",
        30,
        "cannot be \"median\" write \"mean\", { pre_event =",
    ),
    (
        "process = [{ remove_offset = { } }]",
        30,
        "`pre_event` or `value`",
    ),
    (
        "process = [{ remove_offset = { pre_event = 1, value = 1 } }]",
        30,
        "nothing of the other kinds",
    ),
    (
        "process = [{ baseline = { acceleration = 1, velocity = 1 } }]",
        25,
        "nothing of the other kinds",
    ),
    (
        "process = [{ baseline = { start = 1 } }]",
        25,
        "`start` with `end`",
    ),
    (
        "process = [{ trim = { start = 1 } }]",
        21,
        "`end` (and `start`)",
    ),
    (
        "process = [{ trim = { end = \"-1 s\" } }]",
        29,
        "zero or more",
    ),
    (
        "process = [{ taper = { } }]",
        22,
        "`start`, `end` or both for example taper = {",
    ),
    (
        "process = [{ pad = { } }]",
        20,
        "`before`, `after` or both for example pad = {",
    ),
    ("process = [{ resample = { } }]", 25, "time_step"),
    (
        "process = [{ scale = { pga = \"1 g\", pgv = 1 } }]",
        22,
        "needs one of",
    ),
    ("scale = { psa = \"1 g\" }", 9, "period"),
    (
        "scale = { psa = \"1 g\", period = 1, damping = 1 }",
        46,
        "damping ratio 1 is not from 0 to below 1",
    ),
    (
        "scale = { target = \"a\", from = 1, to = 2, damping = \"120 %\" }",
        53,
        "damping ratio 1.2 is not from 0 to below 1",
    ),
    (
        "scale = { pga = \"1 g\", damping = 0.05 }",
        24,
        "no meaning beside `pga`",
    ),
    (
        "scale = { target = \"\", from = 1, to = 2 }",
        20,
        "`target` is empty",
    ),
    (
        "scale = { target = \"a\", from = 1, to = \"2 m\" }",
        40,
        "must be a time",
    ),
];

#[test]
fn errors_point_at_the_place() {
    for (text, column, part) in WRONG {
        let error = parse(text).unwrap_err();
        let all = format!("{error} {}", error.help.clone().unwrap_or_default());
        assert_eq!((error.line, error.column), (9, *column), "{text}: {all}");
        assert!(all.contains(part), "{text}: {all}");
        assert!(error.help.is_some(), "{text}");
    }
}

/// Radians are pure numbers too: an angle in another unit than degrees is refused, not taken for these.
#[test]
fn a_turn_is_in_degrees() {
    let turned = |angle: &str| parse(&format!("rotate = {angle}\nsecond_component = \"90\""));
    let rotation = turned("30").unwrap().ground_motion.rotation.unwrap();
    assert_eq!(
        (rotation.angle, rotation.second_component.value.as_str()),
        (30.0, "90")
    );
    for angle in ["\"30 deg\"", "\"30 degrees\"", "\"30°\""] {
        let rotation = turned(angle).unwrap().ground_motion.rotation.unwrap();
        assert_eq!(rotation.angle, 30.0);
    }
    let error = turned("\"0.5 rad\"").unwrap_err();
    assert_eq!((error.line, error.column), (9, 10));
    assert!(error.message.contains("is a number of degrees"));
}

#[test]
fn a_list_by_itself() {
    let (steps, asked) =
        process_steps("process = [{ pad = { after = \"10 s\" } }]", "--pad").unwrap();
    assert!(asked.is_empty());
    assert_eq!(
        steps[0].value,
        ProcessingStep::Pad {
            before: 0.0,
            after: 10.0
        }
    );
    for wrong in ["", "process = [", "other = 1", "process = 1"] {
        let error = process_steps(wrong, "--pad").unwrap_err();
        assert!(error.to_string().starts_with("--pad:"), "{error}");
    }
}

/// The schema knows the keys with their kinds.
#[test]
fn schema_of_the_record() {
    let schema = schema();
    let motion = &schema["properties"]["ground_motion"];
    let keys = &motion["properties"];
    for key in [
        "quantity",
        "skip_columns",
        "sensitivity",
        "gravity",
        "offset",
        "process",
    ] {
        assert!(keys[key]["description"].is_string(), "{key}");
    }
    let step = &keys["process"]["items"];
    assert_eq!(step["maxProperties"], 1);
    assert_eq!(step["properties"].as_object().unwrap().len(), 10);
    let filter = &step["properties"]["filter"]["properties"];
    assert!(
        filter["high_pass"]["description"]
            .as_str()
            .unwrap()
            .contains("Hz")
    );
    assert_eq!(
        keys["scale"]["anyOf"][1]["oneOf"].as_array().unwrap().len(),
        6
    );
}

/// The schema bounds the order of a filter as the filter itself does.
#[test]
fn the_schema_knows_the_largest_order_of_a_filter() {
    fn orders(value: &serde_json::Value, found: &mut Vec<serde_json::Value>) {
        let keys = &value["properties"];
        if keys["high_pass"].is_object() {
            found.push(keys["order"].clone());
        }
        match value {
            serde_json::Value::Object(map) => map.values().for_each(|v| orders(v, found)),
            serde_json::Value::Array(list) => list.iter().for_each(|v| orders(v, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    orders(&schema(), &mut found);
    assert!(!found.is_empty());
    for order in found {
        assert!(
            order.to_string().contains("\"maximum\":12,\"minimum\":1"),
            "{order}"
        );
    }
}
