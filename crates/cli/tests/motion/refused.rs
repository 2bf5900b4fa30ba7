//! Exit codes, and what is said beside them.

use super::*;

/// Refused with this exit code and these words.
pub fn refused(code: i32, arguments: &[&str], wanted: &[&str]) {
    let output = run(arguments);
    let message = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty());
    for part in wanted {
        assert!(message.contains(part), "\"{part}\" is not in: {message}");
    }
}

#[test]
fn bad_input() {
    let folder = Folder::new();
    let file = el_centro();
    let out = folder.name("o.csv");
    std::fs::write(folder.path("bare.txt"), "0.1\n0.2\n0.3\n").unwrap();
    std::fs::write(folder.path("target.csv"), "period_s,psa_g\n0.1,0.8\n1,x\n").unwrap();
    std::fs::write(folder.path("unit.csv"), "period_s,psa\n0.1,0.8\n").unwrap();
    let (bare, target, unit) = (
        folder.name("bare.txt"),
        folder.name("target.csv"),
        folder.name("unit.csv"),
    );
    let missing = folder.name("missing.csv");
    refused(
        2,
        &["info", &missing],
        &["cannot read the record", "check the path"],
    );
    refused(2, &["info", &bare], &["unit", "--unit g"]);
    for step in ["4e-10", "1e7", "1e300"] {
        refused(
            2,
            &["info", &bare, "--unit", "g", "--time-step", step],
            &["is that of no record", "1e-9 s to 1e6 s", "time_step"],
        );
    }
    refused(
        2,
        &["info", &file, "--format", "peer"],
        &["unknown record format", "peer_at2"],
    );
    refused(
        2,
        &["spectrum", &file, "--at", "1 m"],
        &["--at must be a time (s)"],
    );
    refused(2, &["spectrum", &file, "--at", "-1 s"], &["period = -1"]);
    refused(
        2,
        &["spectrum", &file, "--damping", "5"],
        &["damping ratio = 5 is outside [0, 1)"],
    );
    refused(
        2,
        &["spectrum", &file, "--rotated"],
        &["--second-component"],
    );
    refused(
        2,
        &["spectrum", &file, "--component", "EW"],
        &["no component \"EW\"", "NS"],
    );
    let process = |step: &str, value: &str, wanted: &[&str]| {
        refused(2, &["process", &file, "-o", &out, step, value], wanted);
    };
    process(
        "--filter",
        "high_pass=0.1 s",
        &["--filter", "must be a frequency"],
    );
    process(
        "--filter",
        "high_pas=0.1 Hz",
        &["unknown key `high_pas`", "high_pass"],
    );
    process(
        "--filter",
        "high_pass=30 Hz",
        &["--filter", "high-pass corner"],
    );
    process(
        "--filter",
        "phase=zero",
        &["`high_pass`, `low_pass` or both"],
    );
    for order in ["0", "13"] {
        process(
            "--filter",
            &format!("high_pass=1 Hz, order={order}"),
            &["--filter", "`order` must be a whole number from 1 to 12"],
        );
    }
    process("--scale", "-1", &["greater than zero"]);
    process(
        "--scale",
        "pga=1 g, period=1 s",
        &["`period` has no meaning beside `pga`"],
    );
    process("--remove-offset", "median", &["write \"mean\""]);
    process("--trim", "start=2 s", &["`end`"]);
    process("--taper", "start=1 s, 2 s", &["\"2 s\" is not key=value"]);
    // A word beside pairs was dropped, and the record filtered without phase.
    process(
        "--filter",
        "causal, high_pass=0.1 Hz",
        &["\"causal\" is not key=value"],
    );
    for (step, text) in [
        ("--scale", "2, pga=0.3 g"),
        ("--remove-offset", "mean, value=1 m/s^2"),
        ("--trim", "5, end=10 s"),
        ("--taper", "1 s, end=2 s"),
        ("--pad", "10 s, after=2 s"),
        ("--baseline", "2, velocity=1"),
        ("--resample", "0.01 s, time_step=0.005 s"),
    ] {
        process(step, text, &["is not key=value"]);
    }
    process("--sign", "positive", &["write \"reversed\""]);
    process("--true-unit", "furlong", &["\"furlong\" is not a unit"]);
    refused(
        2,
        &["process", &file, "-o", &out],
        &["no step is asked for"],
    );
    refused(
        2,
        &["convert", &file, "-o", &out, "--quantity", "velocity"],
        &["there is no velocity among"],
    );
    refused(
        2,
        &["convert", &file, "-o", &out, "--output-unit", "g"],
        &["--to plain_columns"],
    );
    let synth = [
        "synth",
        "sine",
        "--amplitude",
        "1 g",
        "--duration",
        "5 s",
        "-o",
        &out,
    ];
    refused(
        2,
        &[&synth[..], &["--frequency", "80 Hz"]].concat(),
        &["below 50 Hz, and this one is 80 Hz", "--time-step"],
    );
    refused(
        2,
        &[&synth[..], &["--frequency", "1 s"]].concat(),
        &["must be a frequency"],
    );
    refused(
        2,
        &[
            &synth[..],
            &["--frequency", "1 Hz", "--envelope", "ramped, rise=1 s"],
        ]
        .concat(),
        &["--envelope needs fall"],
    );
    refused(
        2,
        &["match", &file, "-o", &out, "--target", &target],
        &["target.csv:3:3: \"x\" is not a number"],
    );
    refused(
        2,
        &["match", &file, "-o", &out, "--target", &unit],
        &["unit.csv:1:1", "psa_UNIT"],
    );
    refused(
        2,
        &[
            "match",
            &file,
            "-o",
            &out,
            "--code",
            "eurocode_8_2004, ag=0.2 g, ground_type=F",
        ],
        &["`ground_type`"],
    );
    refused(
        2,
        &[
            "match",
            &file,
            "-o",
            &out,
            "--code",
            "eurocode_8_2004, ag=0.2 g, ground_type=B",
            "--to",
            "5 s",
        ],
        &["last period of the band = 5 is outside [0.01, 4]"],
    );
    assert!(!folder.path("o.csv").exists());
}

#[test]
fn what_cannot_be_computed_or_written() {
    let folder = Folder::new();
    let file = el_centro();
    let out = folder.name("o.csv");
    let code = "eurocode_8_2004, ag=0.25 g, ground_type=B";
    refused(
        3,
        &[
            "match",
            &file,
            "--code",
            code,
            "--iterations",
            "0",
            "-o",
            &out,
        ],
        &["after 0 iterations"],
    );
    assert!(!folder.path("o.csv").exists());
    let nowhere = folder.name("none/o.csv");
    refused(4, &["convert", &file, "-o", &nowhere], &["cannot write"]);
    let a_folder = folder.0.path().display().to_string();
    refused(
        4,
        &["convert", &file, "-o", &a_folder],
        &["not a regular file"],
    );
}

/// Options that say nothing of what is written.
/// What cannot be read back is not written, messages name what can be mended, and a file stays where
/// the other one of a call has no place.
#[test]
fn no_file_is_lost_to_a_figure_without_a_place() {
    let folder = Folder::new();
    let file = el_centro();
    let out = folder.name("o.csv");
    let eight = "eurocode_8_2004, ag=0.25 g, ground_type=B";
    let short = folder.name("two.csv");
    std::fs::write(&short, "time_s,acceleration_m/s2\n0,0.0\n0.01,1.0\n").unwrap();
    let process = |option: &str, value: &str, wanted: &[&str]| {
        refused(2, &["process", &file, "-o", &out, option, value], wanted);
    };
    process(
        "--scale",
        "1e60",
        &["stands for a missing value", "the unit of the record"],
    );
    process(
        "--trim",
        "start=2 s, end=2.001 s",
        &["less than a step of 0.02 s"],
    );
    let quantity = ["convert", &file, "-o", &out, "--quantity", "velocity"];
    refused(
        2,
        &quantity,
        &["there is no velocity among", "ask for a quantity"],
    );
    let pulse = [
        "synth",
        "mavroeidis_papageorgiou_2003",
        "--amplitude",
        "1 m/s",
        "--frequency",
        "1 Hz",
        "--gamma",
        "1",
        "--duration",
        "2 s",
        "-o",
        &out,
    ];
    refused(2, &pulse, &["gamma = 1 is outside (1, 1000]"]);
    let matched = ["match", &short, "--code", eight, "-o", &out];
    refused(2, &matched, &["give a longer record"]);
    assert!(!folder.path("o.csv").exists());
    std::fs::write(&out, "keep").unwrap();
    std::fs::create_dir(folder.path("d.svg")).unwrap();
    for figure in [folder.name("nowhere/a.svg"), folder.name("d.svg")] {
        let call = [
            "process", &file, "--scale", "2", "--svg", &figure, "-o", &out,
        ];
        refused(4, &call, &[".svg"]);
        assert_eq!(std::fs::read_to_string(&out).unwrap(), "keep");
    }
    // Digits of large numbers are few, and read back.
    let large = ["process", &file, "--scale", "1e30", "-o", &out];
    assert!(run(&large).status.success());
    let longest = std::fs::read_to_string(&out).unwrap();
    let samples = longest.lines().filter(|l| !l.starts_with('#'));
    assert!(samples.map(str::len).max().unwrap() < 40);
    assert!(run(&["info", &out]).status.success());
}

#[test]
fn conversions_use_every_option() {
    let folder = Folder::new();
    let (file, out) = (el_centro(), folder.name("o.at2"));
    let at2 = ["convert", &file, "-o", &out, "--to", "peer_at2"];
    refused(
        2,
        &[&at2[..], &["--columns", "a"]].concat(),
        &["--columns is of plain columns"],
    );
    let vt2 = "A\nB\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 4, DT= 0.01 SEC\n1 -2 3 -1\n";
    std::fs::write(folder.path("a.vt2"), vt2).unwrap();
    let velocity = folder.name("a.vt2");
    let velocity = [
        "convert",
        &velocity,
        "-o",
        &out,
        "--to",
        "peer_at2",
        "--quantity",
        "velocity",
    ];
    text(&velocity);
    for option in [&["--prepend-zero"][..], &["--offset", "remove"]] {
        let wanted = [option[0], "a velocity is written as it is"];
        refused(2, &[&velocity[..], option].concat(), &wanted);
    }
    // The unit was dropped, and the velocity written in m/s.
    let columns = velocity.map(|word| {
        if word == "peer_at2" {
            "plain_columns"
        } else {
            word
        }
    });
    text(&columns);
    for unit in ["g", "cm/s"] {
        refused(
            2,
            &[&columns[..], &["--output-unit", unit]].concat(),
            &[
                "--output-unit is of accelerations, and a velocity is written in m/s",
                "leave it out, or convert the acceleration",
            ],
        );
    }
}

/// The remedy does not lead into the next error.
#[test]
fn parameters_of_a_motion_do_not_go_with_an_earthquake() {
    let folder = Folder::new();
    let out = folder.name("o.csv");
    for (option, given) in [
        ("--arias-intensity", "1 m/s"),
        ("--frequency-rate", "-0.1"),
        ("--filter-damping", "0.3"),
        ("--middle-time", "8 s"),
        ("--middle-frequency", "3 Hz"),
    ] {
        let arguments = [
            "synth",
            "rezaeian_der_kiureghian_2010",
            "--magnitude",
            "7",
            "--distance",
            "20 km",
            "--shear-velocity",
            "760 m/s",
            "--duration",
            "30 s",
            "--seed",
            "1",
            "-o",
            &out,
            option,
            given,
        ];
        refused(
            2,
            &arguments,
            &["cannot be used with", "--magnitude", option],
        );
    }
}

/// Frequencies of the ground are printed in rad/s and in Hz, of which a plain number is one.
#[test]
fn frequencies_of_the_ground_have_both_units() {
    let folder = Folder::new();
    let out = folder.name("o.csv");
    let shown = text(&[
        "synth",
        "clough_penzien_1975",
        "--peak-acceleration",
        "0.3 g",
        "--ground-frequency",
        "2",
        "--duration",
        "20 s",
        "--seed",
        "1",
        "-o",
        &out,
    ]);
    let lines: Vec<String> = shown
        .lines()
        .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect();
    for line in [
        "ground frequency 12.5664 rad/s",
        "ground frequency in Hz 2 Hz",
        "filter frequency 1.25664 rad/s",
        "filter frequency in Hz 0.2 Hz",
    ] {
        assert!(lines.iter().any(|l| l == line), "{line}: {shown}");
    }
    let help = text(&["synth", "kanai_tajimi_1960", "--help"]);
    assert!(help.contains("a plain number is in Hz"), "{help}");
}

/// Options that nobody gave are not blamed for a record of few samples.
#[test]
fn records_too_short_for_a_smoothed_spectrum() {
    let folder = Folder::new();
    let file = folder.name("short.csv");
    std::fs::write(&file, "time_s,acceleration_g\n0,0.1\n0.01,-0.1\n").unwrap();
    let told = [
        "the record of 2 samples is too short",
        "start at 50 Hz, one over the number of samples times the step of 0.01 s",
        "--unsmoothed",
    ];
    refused(2, &["spectrum", &file, "--fourier"], &told);
}

/// Two seconds of a constant acceleration, of which no change brings more after ten iterations: more of them would not either.
#[test]
fn a_match_that_stalls_does_not_ask_for_more_iterations() {
    let folder = Folder::new();
    let rows: String = (0..100)
        .map(|i| format!("{:.2},1\n", 0.02 * f64::from(i)))
        .collect();
    let rows = format!("time_s,acceleration_m_s2\n{rows}");
    std::fs::write(folder.path("constant.csv"), rows).unwrap();
    let (file, out) = (folder.name("constant.csv"), folder.name("out.csv"));
    let code = "eurocode_8_2004, ag=0.25 g, ground_type=B";
    let call = [
        "match", &file, "-o", &out, "--code", code, "--from", "0.1 s", "--to", "0.5 s",
    ];
    let wanted = [
        "after 10 iterations, more than 0.05; the method has stalled",
        "help: take a record whose own spectrum is nearer the target, or narrow the band",
    ];
    refused(3, &call, &wanted);
    let more = [&call[..], &["--iterations", "1000"]].concat();
    refused(3, &more, &wanted);
    let error = String::from_utf8(run(&more).stderr).unwrap();
    assert!(!error.contains("allow more"), "{error}");
}
