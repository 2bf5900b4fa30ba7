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

/// An option that would do nothing is an error.
#[test]
fn options_without_effect_are_refused() {
    let file = el_centro();
    let folder = Folder::new();
    let out = folder.name("o.csv");
    let no_use = |arguments: &[&str], wanted: &[&str]| refused(2, arguments, wanted);
    for more in [&["--damping", "2 %"][..], &["--at-samples"]] {
        let arguments = [&["spectrum", &file, "--fourier"], more].concat();
        no_use(&arguments, &["--fourier", more[0]]);
    }
    let unsmoothed = ["spectrum", &file, "--fourier", "--unsmoothed"];
    no_use(&[&unsmoothed[..], &["--at", "1 Hz"]].concat(), &["--at"]);
    let code = "eurocode_8_2004, ag=0.25 g, ground_type=B";
    for more in [
        &["--unit", "g"][..],
        &["--component", "90"],
        &["--time-step", "0.01 s"],
        &["--lenient"],
        &["--gravity", "9.81"],
        &["--at-samples"],
        &["--second-component", "90"],
        &["--smoothing", "20"],
    ] {
        let arguments = [&["spectrum", "--code", code], more].concat();
        no_use(&arguments, &[more[0]]);
    }
    let process = ["process", &file, "-o", &out];
    let causal = [
        "--filter",
        "high_pass=0.1 Hz, phase=causal, keep_pads=false",
    ];
    no_use(
        &[&process[..], &causal].concat(),
        &["`keep_pads` has no meaning beside phase"],
    );
    let pulse = [
        "synth",
        "makris_roussos_2000",
        "--type",
        "a",
        "--cycles",
        "3",
        "--amplitude",
        "1 m/s",
        "--period",
        "1 s",
        "--duration",
        "3 s",
        "-o",
        &out,
    ];
    no_use(&pulse, &["--cycles is of pulses of type C"]);
    let noise = [
        "synth",
        "rezaeian_der_kiureghian_2010",
        "--significant-duration",
        "10 s",
        "--middle-time",
        "8 s",
        "--middle-frequency",
        "4 Hz",
        "--mechanism",
        "reverse",
        "--duration",
        "30 s",
        "--seed",
        "1",
        "-o",
        &out,
    ];
    no_use(&noise, &["--mechanism", "--significant-duration"]);
    let ramps = [
        "synth",
        "sine",
        "--amplitude",
        "0.1 g",
        "--frequency",
        "1 Hz",
        "--duration",
        "60 s",
        "--envelope",
        "ramped, rise=40 s, fall=40 s",
        "-o",
        &out,
    ];
    no_use(&ramps, &["do not fit into 60 s", "shorten"]);
    no_use(
        &["process", &file, "-o", &out, "--baseline", "velocity=0"],
        &["a whole number from 1 to 5"],
    );
    assert!(folder.files().is_empty());
}

/// Angles per second are circular frequencies, wherever a frequency is given.
#[test]
fn circular_frequencies_of_fourier_amplitudes() {
    let file = el_centro();
    let amplitudes = |more: &[&str]| {
        let answer = json(&[&["spectrum", &file, "--fourier"], more].concat());
        let frequencies = answer["frequencies"].as_array().unwrap();
        frequencies.iter().map(number).collect::<Vec<_>>()
    };
    for (circular, hertz) in [
        (
            &["--at", "12.566370614359172 rad/s"][..],
            &["--at", "2 Hz"][..],
        ),
        (
            &[
                "--from",
                "6.283185307179586 rad/s",
                "--to",
                "62.83185307179586 rad/s",
                "--count",
                "3",
            ],
            &["--from", "1 Hz", "--to", "10 Hz", "--count", "3"],
        ),
    ] {
        for (found, expected) in amplitudes(circular).iter().zip(amplitudes(hertz)) {
            close(*found, expected, 1e-12);
        }
    }
}

/// The time of the first sample goes into our CSV, moved by what is cut off; other formats have no
/// place for it.
#[test]
fn start_times_that_are_lost_are_named() {
    let folder = Folder::new();
    let from = folder.name("from.csv");
    let rows: String = (0..50)
        .map(|i| format!("{},{}\n", f64::from(i) * 0.1, f64::from(i % 5) - 2.0))
        .collect();
    let head = "# Start: 2011/03/11 14:46:59 JST\n# dt: 0.1 s\ntime_s,acceleration_m_s2\n";
    std::fs::write(&from, format!("{head}{rows}")).unwrap();
    for (to, name, lost) in [
        ("pounding_csv", "o.csv", false),
        ("peer_at2", "o.at2", true),
        ("plain_columns", "o.txt", true),
    ] {
        let said = text(&["convert", &from, "--to", to, "-o", &folder.name(name)]);
        let named = said.contains("time of the first sample, 2011/03/11 14:46:59 JST");
        assert_eq!(named, lost, "{said}");
    }
    let kept = "# Start: 2011/03/11 14:46:59 JST\n";
    assert!(folder.content("o.csv").contains(kept));
    let out = folder.name("cut.csv");
    text(&["process", &from, "--trim", "start=2 s, end=4 s", "-o", &out]);
    let content = folder.content("cut.csv");
    assert!(
        content.contains("# Start: 2011/03/11 14:47:01 JST\n"),
        "{content}"
    );
}

/// Conversions say what a format cannot hold; a file that is made names no folder.
#[test]
fn initial_velocities_that_are_lost_are_named() {
    let folder = Folder::new();
    let from = folder.name("from.csv");
    let text = "# Initial velocity: 0.5 m/s\n# dt: 0.1 s\ntime_s,acceleration_m_s2\n0,-3\n0.1,-3\n0.2,-2\n";
    std::fs::write(&from, text).unwrap();
    let peak_velocity = |file: &str| {
        let answer = json(&["info", file]);
        answer.to_string()
    };
    for (to, name, lost) in [
        ("pounding_csv", "o.csv", false),
        ("peer_at2", "o.at2", true),
        ("plain_columns", "o.txt", true),
    ] {
        let out = folder.name(name);
        let said = super::text(&["convert", &from, "--to", to, "-o", &out]);
        assert_eq!(
            said.contains("velocity and displacement of the first sample, 0.5 m/s"),
            lost,
            "{said}"
        );
    }
    assert!(
        folder
            .content("o.csv")
            .contains("# Initial velocity: 0.5 m/s\n")
    );
    assert!(peak_velocity(&folder.name("o.csv")).contains("\"initial_velocity\":0.5"));
    let out = folder.name("scaled.csv");
    super::text(&["process", &from, "--scale", "pgv=1 m/s", "-o", &out]);
    let content = folder.content("scaled.csv");
    assert!(content.contains("# Initial velocity: 1 m/s\n"), "{content}");
    assert!(
        content.starts_with("# Event: from.csv, processed\n"),
        "{content}"
    );
}

/// The one component of a file has no second one beside it.
#[test]
fn a_component_is_not_turned_against_itself() {
    let file = el_centro();
    let folder = Folder::new();
    let out = folder.name("o.csv");
    for arguments in [
        &["spectrum", &file, "--rotated", "--second-component", "1"][..],
        &[
            "process",
            &file,
            "-o",
            &out,
            "--rotate",
            "30",
            "--second-component",
            "1",
            "--sign",
            "reversed",
        ],
    ] {
        refused(2, arguments, &["rotation: "]);
    }
}

/// What the program's own messages say to type: a layout whose first column is passed over.
#[test]
fn layouts_that_begin_with_a_hyphen() {
    let folder = Folder::new();
    let (file, out) = (folder.name("rows.txt"), folder.name("o.csv"));
    let rows: String = (1..30)
        .map(|i| format!("{i} {}.5\n", (i * 7) % 5 - 2))
        .collect();
    std::fs::write(&file, rows).unwrap();
    let given = [
        "convert",
        &file,
        "--unit",
        "g",
        "--time-step",
        "0.01 s",
        "-o",
        &out,
    ];
    refused(2, &given, &["--layout \"-,a\""]);
    let output = run(&[&given[..], &["--layout", "-,a"]].concat());
    assert!(output.status.success(), "{output:?}");
}

/// 0.3 where 0.3 g is meant: asked about as in a case; with a unit nothing is said.
#[test]
fn accelerations_without_a_unit_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.csv").display().to_string();
    let file = el_centro();
    for (peak, asked) in [("0.3", true), ("0.3 m/s2", false), ("3", false)] {
        let scale = format!("pga={peak}");
        let process = ["process", &file, "--scale", &scale, "-o", &out];
        let synth = [
            "synth",
            "kanai_tajimi_1960",
            "--peak-acceleration",
            peak,
            "--duration",
            "5",
            "--seed",
            "1",
            "-o",
            &out,
        ];
        let sine = |name| {
            [
                "synth",
                name,
                "--amplitude",
                peak,
                "--duration",
                "5",
                "-o",
                &out,
            ]
        };
        let ricker = [&sine("ricker_1953")[..], &["--period", "0.5"]].concat();
        let sine = [&sine("sine")[..], &["--frequency", "2"]].concat();
        for arguments in [&process[..], &synth, &ricker, &sine] {
            let output = run(arguments);
            let told = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{told}");
            let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
            assert_eq!(told.contains("was \"0.3 g\" meant?"), asked, "{told}");
        }
    }
}

/// Numbers without a unit that no motion has are asked about, and a peak that no record reaches is said.
#[test]
fn synth_asks_about_bare_numbers() {
    let folder = Folder::new();
    let out = folder.name("made.csv");
    let said = |arguments: &str| {
        let mut words: Vec<&str> = arguments.split(' ').collect();
        words.splice(0..0, ["synth"]);
        words.extend(["--duration", "120", "-o", &out]);
        let output = run(&words);
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{told}");
        told.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let boore = "boore_2003 --magnitude 6.5 --seed 1";
    let near = said(&format!("{boore} --distance 20"));
    assert!(
        near.contains("--distance is 20 m") && near.contains("was \"20 km\" meant?"),
        "{near}"
    );
    assert!(near.contains("that the strongest records reach"), "{near}");
    for usual in ["20km", "20000"] {
        let usual = said(&format!("{boore} --distance {usual}"));
        assert!(!usual.contains("warning"), "{usual}");
    }
    assert!(!said(&format!("{boore} --distance 20m")).contains("meant?"));
    let weak = said(&format!("{boore} --distance 20km --stress-parameter 90000"));
    assert!(
        weak.contains("--stress-parameter is 90000 Pa") && weak.contains("\"8 MPa\""),
        "{weak}"
    );
    for pulse in [
        "makris_roussos_2000 --type a --period 2",
        "mavroeidis_papageorgiou_2003 --frequency 0.5 --gamma 2",
    ] {
        let fast = said(&format!("{pulse} --amplitude 80"));
        assert!(
            fast.contains("--amplitude is 80 m/s") && fast.contains("was \"80 cm/s\" meant?"),
            "{fast}"
        );
        assert!(fast.contains("that the strongest records reach"), "{fast}");
        let usual = said(&format!("{pulse} --amplitude 0.8"));
        assert!(!usual.contains("warning"), "{usual}");
    }
    let strong = said("sine --amplitude 3.1g --frequency 2.5");
    assert!(
        strong.contains("peak ground acceleration is 3.1"),
        "{strong}"
    );
    assert!(!said("sine --amplitude 3g --frequency 2").contains("warning"));
}
