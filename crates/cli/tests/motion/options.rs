//! Refusals name the option and its bounds in few words; what is accepted beside plain
//! numbers.

use super::refused::refused;
use super::*;

#[test]
fn bounds_are_short_and_options_named() {
    let file = el_centro();
    let spectrum = |more: &[&str], wanted: &[&str]| {
        let arguments = [&["spectrum", &file], more].concat();
        refused(2, &arguments, wanted);
        let output = run(&arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(message.len() < 400, "{message}");
    };
    spectrum(
        &["--from", "3 s", "--to", "1 s"],
        &["--from = 3 s is not below --to = 1 s", "smaller one first"],
    );
    spectrum(
        &["--at", "1e-9 s"],
        &["--at: ", "period = 1e-9 is outside [", "inf)"],
    );
    spectrum(&["--at", "1e-300 s"], &["--at: ", "period = 1e-300"]);
    spectrum(
        &["--from", "-1 s"],
        &["--from: ", "= -1 is outside (0, inf)"],
    );
    spectrum(&["--from", "1e-9 s"], &["--from: ", "= 1e-9 is outside ["]);
    spectrum(
        &["--count", "1"],
        &["--count: ", "= 1 is outside [2, 1000000]"],
    );
    spectrum(
        &["--damping", "2"],
        &["--damping: ", "= 2 is outside [0, 1)"],
    );
    spectrum(
        &["--fourier", "--from", "5 Hz", "--to", "2 Hz"],
        &["--from = 5 Hz is not below --to = 2 Hz"],
    );
    spectrum(&["--fourier", "--smoothing", "0"], &["--smoothing: "]);
    for silent in [&["--damping", "2 %"][..], &["--at-samples"]] {
        spectrum(
            &[&["--fourier"], silent].concat(),
            &["'--fourier' cannot be used with '--"],
        );
    }
    spectrum(
        &["--fourier", "--unsmoothed", "--at", "2 Hz"],
        &["'--unsmoothed' cannot be used with"],
    );
    let folder = Folder::new();
    let out = folder.name("o.csv");
    let process = |option: &str, value: &str, wanted: &[&str]| {
        refused(2, &["process", &file, "-o", &out, option, value], wanted);
    };
    process(
        "--trim",
        "start=5 s, end=2 s",
        &["--trim: ", "start = 5 is not below end = 2"],
    );
    process(
        "--trim",
        "start=5 s, end=99 s",
        &["--trim: ", "end = 99 is outside [0.02, 31.16]"],
    );
    process(
        "--trim",
        "arias_from=0.9, arias_to=0.1",
        &["first part = 0.9 is not below last part = 0.1"],
    );
    process(
        "--baseline",
        "start=20 s, end=5 s",
        &["t1 = 20 is not below t2 = 5"],
    );
    refused(
        2,
        &[
            "match",
            &file,
            "-o",
            &out,
            "--code",
            "eurocode_8_2004, ag=0.25 g, ground_type=B",
            "--from",
            "2 s",
            "--to",
            "1 s",
        ],
        &["--from = 2 s is not below --to = 1 s"],
    );
    assert!(!folder.path("o.csv").exists());
}

/// The remedy fits commands that take the unit, and those that only take files.
#[test]
fn a_missing_unit_has_a_remedy_for_every_command() {
    let folder = Folder::new();
    std::fs::write(folder.path("bare.txt"), "0.1\n0.2\n0.3\n").unwrap();
    let bare = folder.name("bare.txt");
    refused(
        2,
        &["info", &bare, "--time-step", "0.02 s"],
        &["--unit g", "for --records", "`pounding motion convert"],
    );
    refused(
        2,
        &["info", &bare, "--unit", "g"],
        &["--time-step", "for --records", "`pounding motion convert"],
    );
    // What the remedy says goes.
    let out = folder.name("with_unit.csv");
    text(&[
        "convert",
        &bare,
        "--unit",
        "g",
        "--time-step",
        "0.02 s",
        "-o",
        &out,
    ]);
    text(&["info", &out]);
}

#[cfg(unix)]
#[test]
fn devices_and_folders_are_not_read() {
    let folder = Folder::new();
    let path = folder.path(".").display().to_string();
    for (name, wanted) in [
        ("/dev/zero", "no regular file"),
        (path.as_str(), "a folder"),
    ] {
        refused(2, &["info", name], &[wanted, "give the path of a file"]);
    }
    let out = folder.name("o.csv");
    let file = el_centro();
    refused(
        2,
        &["match", &file, "-o", &out, "--target", "/dev/zero"],
        &["no regular file"],
    );
}

#[test]
fn the_rate_of_a_frequency_takes_its_unit() {
    let folder = Folder::new();
    let made = |rate: &[&str], name: &str| {
        let out = folder.name(name);
        let fixed = [
            "synth",
            "rezaeian_der_kiureghian_2010",
            "--arias-intensity",
            "0.5 m/s",
            "--significant-duration",
            "10 s",
            "--middle-time",
            "8 s",
            "--middle-frequency",
            "5 Hz",
            "--duration",
            "30 s",
            "--seed",
            "1",
            "-o",
            &out,
        ];
        text(&[&fixed[..], rate].concat());
        rows(&folder.content(name))
    };
    let plain = made(&["--frequency-rate", "-0.06"], "a.csv");
    assert_eq!(plain, made(&["--frequency-rate", "-0.06 1/s^2"], "b.csv"));
    assert_eq!(plain, made(&["--frequency-rate", "-0.06 Hz/s"], "c.csv"));
    assert_ne!(plain, made(&["--frequency-rate", "-0.3 1/s^2"], "d.csv"));
    let out = folder.name("o.csv");
    let generator = [
        "synth",
        "rezaeian_der_kiureghian_2010",
        "--duration",
        "30 s",
        "--seed",
        "1",
        "-o",
        &out,
    ];
    refused(
        2,
        &generator,
        &[
            "needs one of --magnitude and --significant-",
            "--middle-time",
        ],
    );
    let parameters = [
        "--arias-intensity",
        "0.5 m/s",
        "--significant-duration",
        "10 s",
        "--middle-time",
        "8 s",
        "--middle-frequency",
        "5 Hz",
        "--frequency-rate",
        "-0.06 1/s",
    ];
    refused(
        2,
        &[&generator[..], &parameters[..]].concat(),
        &["--frequency-rate must be"],
    );
}
