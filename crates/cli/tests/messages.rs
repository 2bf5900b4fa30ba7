//! What the program says where something is wrong, and that it says all of it.
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const CASE: &str = r#"title = "pair"
[[building]]
name = "a"
storeys = 2
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "b"
storeys = 2
mass = "100 t"
stiffness = "30 MN/m"
height = "3 m"
damping = { ratio = 0.05, modes = [1, 2] }
[[gap]]
between = ["a", "b"]
width = "20 mm"
model = "anagnostopoulos_2004"
stiffness = "93.5 MN/m"
restitution = 0.65
[ground_motion]
file = "record.csv"
[analysis]
duration = "1 s"
"#;

const LINK: &str = r#"[[link]]
between = ["a", "b"]
model = "gap_hook"
tension_stiffness = "10 MN/m"
tension_gap = "5 mm"
"#;

const STUDY: &str = r#"title = "levels"
case = "case.toml"
[[variable]]
records = ["record.csv"]
[[variable]]
intensity = "peak_ground_acceleration"
values = ["0.1 g", "0.2 g"]
[ida]
gaps = ["10 mm", "30 mm"]
hazard = "hazard.csv"
confidence = 0.9
"#;

const HAZARD: &str = "pga (g),annual_frequency\n0.05,0.02\n0.1,0.01\n0.4,0.0004\n";

fn record() -> String {
    let mut text = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..60 {
        let t = f64::from(i) * 0.02;
        text.push_str(&format!("{t:.2},{:.5}\n", 0.4 * (7.0 * t).sin()));
    }
    text
}

/// A folder with a sound case, study, hazard and record.
fn bench() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [
        ("case.toml", CASE.to_owned()),
        ("study.toml", STUDY.to_owned()),
        ("hazard.csv", HAZARD.to_owned()),
        ("record.csv", record()),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn pounding(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .env_remove("COLUMNS");
    command
}

fn run(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace();
    pounding(folder).args(arguments).output().unwrap()
}

/// The message on one line, as it is broken where its writer likes.
fn message(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stderr).replace(['│', '\n'], " ");
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Replaces texts that must be there.
fn changed(text: &str, replaced: &[(&str, &str)]) -> String {
    replaced.iter().fold(text.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replacen(from, to, 1)
    })
}

/// Exit code 2, these errors, and so many.
fn refused(output: &Output, errors: &[&str]) {
    let said = message(output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    for error in errors {
        assert!(said.contains(error), "{error}: {said}");
    }
    let count = match errors.len() {
        1 => said.contains(" errors"),
        n => !said.ends_with(&format!("{n} errors")),
    };
    assert!(!count, "{said}");
    assert_eq!(said.matches('×').count(), errors.len(), "{said}");
}

#[test]
fn all_errors_of_a_case() {
    let folder = bench();
    let text = changed(
        CASE,
        &[
            ("\"25 t\"", "\"25 kN\""),
            ("width", "wdith"),
            ("\"1 s\"", "\"1 kg\""),
        ],
    );
    std::fs::write(folder.path().join("bad.toml"), text).unwrap();
    for command in ["check", "run --no-output", "gap"] {
        refused(
            &run(folder.path(), &format!("{command} bad.toml")),
            &[
                "bad.toml:5:8:",
                "bad.toml:18:1: unknown key `wdith`",
                "bad.toml:25:12:",
            ],
        );
    }
    // What models and laws refuse comes together, too.
    let text = changed(
        &format!("{CASE}{LINK}"),
        &[
            ("restitution = 0.65", "restitution = 6.5"),
            ("\"93.5 MN/m\"", "\"93.5 MN\""),
            ("gap_hook", "tension_only"),
            ("duration = \"1 s\"", "method = \"newmark\""),
        ],
    );
    std::fs::write(folder.path().join("bad.toml"), text).unwrap();
    refused(
        &run(folder.path(), "check bad.toml"),
        &[
            "bad.toml:20:13:",
            "bad.toml:21:15:",
            "bad.toml:25:10: method \"newmark\" needs a step",
            "bad.toml:28:9: unknown hysteresis law \"tension_only\"",
        ],
    );
}

/// Floors are looked at with a stand-in for the model, to which the spring does not belong.
#[test]
fn a_spring_is_not_blamed_for_another_error() {
    let folder = bench();
    let text = changed(
        CASE,
        &[
            ("\"1 s\"", "\"1 kg\""),
            (
                "model = \"anagnostopoulos_2004\"",
                "model = \"borovin_2014\"\nfriction = 0.3\nspring = [[\"1 mm\", \"10 kN\"]]",
            ),
            ("stiffness = \"93.5 MN/m\"\n", ""),
            ("restitution = 0.65\n", ""),
        ],
    );
    std::fs::write(folder.path().join("bad.toml"), text).unwrap();
    refused(&run(folder.path(), "check bad.toml"), &["1 kg"]);
}

#[test]
fn laws_are_found_by_what_they_do() {
    let folder = bench();
    let text = changed(&format!("{CASE}{LINK}"), &[("gap_hook", "tension_only")]);
    std::fs::write(folder.path().join("bad.toml"), text).unwrap();
    for arguments in ["check bad.toml", "hysteresis tension_only"] {
        let said = message(&run(folder.path(), arguments));
        assert!(said.contains("did you mean \"gap_hook\"?"), "{said}");
    }
    let said = message(&run(folder.path(), "models rigid"));
    assert!(
        said.contains("did you mean \"stereomechanical\"?"),
        "{said}"
    );
}

#[test]
fn all_errors_of_a_study() {
    let folder = bench();
    let study = |replaced: &[(&str, &str)]| {
        let text = changed(STUDY, replaced);
        std::fs::write(folder.path().join("study.toml"), text).unwrap();
        run(folder.path(), "sweep study.toml --plan")
    };
    assert_eq!(
        study(&[]).status.code(),
        Some(0),
        "{}",
        message(&study(&[]))
    );
    refused(
        &study(&[("title", "titel"), ("confidence = 0.9", "confidence = 9")]),
        &["study.toml:1:1: unknown key `titel`", "study.toml:11:14:"],
    );
    refused(
        &study(&[
            ("\"levels\"", "1"),
            ("\"0.1 g\", \"0.2 g\"", "\"0.1 m\", -1, nan"),
            ("[\"record.csv\"]", "1"),
        ]),
        &[
            "study.toml:1:9:",
            "study.toml:4:11:",
            "study.toml:7:11:",
            "study.toml:7:20:",
            "study.toml:7:24:",
        ],
    );
    refused(
        &study(&[("[[variable]]\nrecords", "[[varaible]]\nrecords")]),
        &["study.toml:3:3: unknown key `varaible`"],
    );
    refused(
        &study(&[("= \"levels\"", "= levels"), ("= 0.9", "= ")]),
        &["study.toml:1:9: this is not TOML", "study.toml:11:"],
    );
    // The case of a study, with its own places.
    let bad = changed(CASE, &[("\"25 t\"", "\"25 kN\""), ("\"1 s\"", "\"1 kg\"")]);
    std::fs::write(folder.path().join("case.toml"), bad).unwrap();
    refused(&study(&[]), &["case.toml:5:8:", "case.toml:25:12:"]);
}

#[test]
fn all_errors_of_a_hazard_file() {
    let folder = bench();
    let bad = changed(
        HAZARD,
        &[("0.1,0.01", "0.1,x"), ("0.4,0.0004", "0.4;0.0004;1")],
    );
    std::fs::write(folder.path().join("hazard.csv"), bad).unwrap();
    refused(
        &run(folder.path(), "sweep study.toml --plan"),
        &[
            "hazard.csv:3: \"x\" is not a finite number",
            "hazard.csv:4: there are 3 columns",
        ],
    );
}

#[test]
fn other_encodings_are_named() {
    let folder = bench();
    let latin_1 = |text: &str| -> Vec<u8> { text.chars().map(|c| c as u8).collect() };
    for (name, text, arguments) in [
        (
            "case.toml",
            changed(CASE, &[("pair", "Gebäude")]),
            "check case.toml",
        ),
        (
            "study.toml",
            changed(STUDY, &[("levels", "Höhen")]),
            "sweep study.toml --plan",
        ),
        (
            "hazard.csv",
            format!("# Gefährdung\n{HAZARD}"),
            "sweep study.toml --plan",
        ),
        (
            "case.toml",
            changed(CASE, &[("pair", "Gebäude")]),
            "sweep study.toml --plan",
        ),
    ] {
        let folder = if arguments.starts_with("check") {
            &folder
        } else {
            &bench()
        };
        std::fs::write(folder.path().join(name), latin_1(&text)).unwrap();
        let output = run(folder.path(), arguments);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(&format!("{name}:1:")), "{said}");
        assert!(
            said.contains("Latin-1") && said.contains("save the file as UTF-8"),
            "{said}"
        );
    }
}

/// A pipe is read once, and its text is at hand for the message.
#[test]
#[cfg(unix)]
fn a_case_from_a_pipe_shows_its_line() {
    let folder = bench();
    let text = changed(CASE, &[("\"25 t\"", "\"25 kN\"")]);
    for command in ["check", "run", "gap"] {
        let mut child = pounding(folder.path())
            .args([command, "/dev/stdin"])
            .stdin(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut pipe = child.stdin.take().unwrap();
        pipe.write_all(text.as_bytes()).unwrap();
        drop(pipe);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(said.contains("/dev/stdin:5:8"), "{said}");
        assert!(said.contains("mass = \"25 kN\""), "{said}");
    }
}

/// One bad file among others: these are shown, it is reported.
#[test]
fn info_goes_on_after_a_bad_file() {
    let folder = bench();
    std::fs::write(folder.path().join("bad.csv"), "nothing\n").unwrap();
    let output = run(
        folder.path(),
        "motion info record.csv bad.csv absent.csv record.csv",
    );
    refused(&output, &["bad.csv", "absent.csv"]);
    let shown = String::from_utf8(output.stdout).unwrap();
    assert_eq!(shown.matches("record.csv\n").count(), 2, "{shown}");
    let output = run(folder.path(), "motion info bad.csv record.csv --json");
    refused(&output, &["bad.csv"]);
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("record.csv")
    );
    let output = run(folder.path(), "motion info bad.csv");
    refused(&output, &["bad.csv"]);
    assert!(output.stdout.is_empty());
}

/// Every option that draws writes SVG, PNG or PDF, and refuses another name before any work.
#[test]
fn figures_have_one_of_three_forms() {
    let folder = bench();
    for arguments in [
        "run case.toml --plot",
        "gap case.toml --plot",
        "gap case.toml --spectra",
        "compare case.toml --plot",
        "ida study.toml --plot",
        "impact hertz_1882 --example --svg",
        "hysteresis bilinear --cycles 1mm --svg",
        "motion info record.csv --svg",
        "motion spectrum record.csv --svg",
        "motion process record.csv -o new.csv --svg",
        "motion match record.csv -o new.csv --svg",
        "motion synth ricker_1953 -o new.csv --svg",
    ] {
        for name in ["x.jpg", "x", "x.svg.eps"] {
            let output = run(folder.path(), &format!("{arguments} {name}"));
            let said = message(&output);
            assert_eq!(output.status.code(), Some(2), "{arguments}: {said}");
            assert!(
                said.contains("figures are written as SVG, PNG or PDF"),
                "{arguments}: {said}"
            );
            assert!(output.stdout.is_empty());
        }
    }
    let mut left: Vec<_> = std::fs::read_dir(folder.path())
        .unwrap()
        .map(|f| f.unwrap().file_name())
        .collect();
    left.sort();
    assert_eq!(
        left,
        ["case.toml", "hazard.csv", "record.csv", "study.toml"]
    );
    assert_eq!(
        run(folder.path(), "motion info record.csv --svg X.SVG")
            .status
            .code(),
        Some(0)
    );
    // The list above is whole: so many options say that they draw.
    let mut drawing = 0;
    for command in [
        "run",
        "gap",
        "compare",
        "ida",
        "impact",
        "hysteresis",
        "motion info",
        "motion spectrum",
        "motion process",
        "motion match",
        "motion synth ricker_1953",
        "check",
        "models",
        "sweep",
        "merge",
        "report",
        "verify impact",
        "stiffness",
        "motion convert",
    ] {
        let help = run(folder.path(), &format!("{command} --help")).stdout;
        let help = String::from_utf8_lossy(&help).into_owned();
        let words: Vec<&str> = help.split_whitespace().collect();
        drawing += words.join(" ").matches("(.svg, .png, .pdf)").count();
    }
    assert_eq!(drawing, 12);
}

#[test]
fn tables_are_as_wide_as_columns_says() {
    let folder = bench();
    let widest = |columns: &str| {
        let mut command = pounding(folder.path());
        command.args(["run", "case.toml", "--no-output"]);
        if !columns.is_empty() {
            command.env("COLUMNS", columns);
        }
        let text = String::from_utf8(command.output().unwrap().stdout).unwrap();
        let lines = text.lines().filter(|l| l.starts_with(['|', '+']));
        (lines.map(|l| l.chars().count()).max().unwrap(), text)
    };
    let (free, whole) = widest("");
    assert!(free > 100, "{whole}");
    for (columns, most) in [("500", free), ("100", 100), ("80", 80), ("nonsense", free)] {
        let (found, text) = widest(columns);
        assert!(found <= most, "{columns}: {text}");
        // Every number stands whole, wherever the cells are broken.
        let numbers = |text: &str| {
            let words = text.split(|c: char| c.is_whitespace() || c == '|');
            let mut words: Vec<String> = words
                .filter(|w| {
                    w.starts_with(['@', 'x']) && w[1..].starts_with(|c: char| c.is_ascii_digit())
                })
                .map(str::to_owned)
                .collect();
            words.sort();
            words
        };
        assert_eq!(numbers(&text), numbers(&whole), "{columns}: {text}");
    }
}

/// Where nobody listens the exit code still tells.
#[test]
#[cfg(unix)]
fn closed_outputs_keep_the_exit_code() {
    let folder = bench();
    std::fs::write(folder.path().join("bad.toml"), "title = 1\n").unwrap();
    let shell = |line: &str| {
        let program = env!("CARGO_BIN_EXE_pounding");
        let output = Command::new("sh")
            .current_dir(folder.path())
            .args(["-c", &line.replace("pounding", &format!("'{program}'"))])
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!errors.contains("panicked"), "{line}: {errors}");
        output.status.code()
    };
    // A reader that has gone before anything is written.
    let gone = "{ sleep 0.2; pounding COMMAND; echo $? > code; }";
    for (command, code) in [
        ("check bad.toml", 2),
        ("check case.toml", 0),
        ("check absent.toml", 2),
        ("gap case.toml", 1),
        ("motion info absent.csv record.csv", 2),
        ("nonsense", 2),
        ("--help", 0),
    ] {
        for redirection in ["2>&-", ">&-", ">&- 2>&-"] {
            let line = format!("pounding {command} {redirection}");
            assert_eq!(shell(&line), Some(code), "{line}");
        }
        let gone = gone.replace("COMMAND", command);
        for line in [format!("{gone} 2>&1 | true"), format!("{gone} | true")] {
            shell(&line);
            let found = std::fs::read_to_string(folder.path().join("code")).unwrap();
            assert_eq!(found.trim(), code.to_string(), "{line}");
        }
    }
}

/// A unit that is not known leads to one that its key takes.
#[test]
fn units_are_suggested_for_their_key() {
    let folder = bench();
    for (from, to, said) in [
        (
            "\"20 mm\"",
            "\"20 mn\"",
            "did you mean \"mm\"? units of a length (m)",
        ),
        (
            "\"20 mm\"",
            "\"20 MM\"",
            "did you mean \"mm\"? units of a length (m)",
        ),
        ("\"30 MN/m\"", "\"30 mn/M\"", "did you mean \"MN/m\"?"),
        (
            "\"1 s\"",
            "\"1 S\"",
            "did you mean \"s\"? units of a time (s)",
        ),
    ] {
        std::fs::write(folder.path().join("bad.toml"), changed(CASE, &[(from, to)])).unwrap();
        let message = message(&run(folder.path(), "check bad.toml"));
        assert!(message.contains(said), "{message}");
    }
    for (arguments, said) in [
        ("gap case.toml --from 20mn --to 1m", "did you mean \"mm\"?"),
        (
            "compare case.toml --approach-velocity 5M/s",
            "did you mean \"m\"?",
        ),
        (
            "sweep study.toml --store-every 5S -o a.h5",
            "did you mean \"s\"?",
        ),
    ] {
        let output = run(folder.path(), arguments);
        let message = message(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains(said), "{arguments}: {message}");
    }
}

/// The tip on a value that the parser takes for an option does what it says.
#[test]
fn values_with_a_dash_are_joined_to_their_option() {
    let folder = bench();
    std::fs::write(folder.path().join("case.toml"), CASE).unwrap();
    let mut gap = pounding(folder.path());
    let output = gap.args(["gap", "case.toml", "--points", "-2 %"]).output();
    let said = message(&output.unwrap());
    let (_, tip) = said.split_once("joined to its option: ").unwrap();
    assert!(tip.starts_with("'--points=-2 %'"), "{said}");
    let joined = run(folder.path(), "gap case.toml --points=-2");
    assert!(!message(&joined).contains("unexpected"), "{joined:?}");
    // A name of a file behind its option, whichever of its two forms that has: what the tip says is taken.
    for (words, joined) in [
        ("run case.toml -o -x.h5", "--output=-x.h5"),
        ("run case.toml --output -x.h5", "--output=-x.h5"),
        ("gap case.toml --records -r.csv", "--records=-r.csv"),
    ] {
        let said = message(&run(folder.path(), words));
        let tip = format!("a value that begins with a dash is joined to its option: '{joined}'");
        assert!(said.contains(&tip), "{words}: {said}");
        let (before, _) = words.split_once(" -").unwrap();
        let output = run(folder.path(), &format!("{before} {joined}"));
        assert!(!message(&output).contains("unexpected"), "{output:?}");
    }
    // What stands behind a switch is no value of it, and a slip in a long option none of the one before.
    let said = message(&run(folder.path(), "run case.toml --json -x"));
    assert!(!said.contains("joined"), "{said}");
    // Nor is a word of its own a value, though one behind an option begins as it does.
    let said = message(&run(folder.path(), "run case.toml -z -o -zz.h5"));
    assert!(said.contains("'-z'") && !said.contains("joined"), "{said}");
    let said = message(&run(folder.path(), "run case.toml -o --jsn"));
    assert!(
        said.contains("--json") && !said.contains("joined"),
        "{said}"
    );
    // Names of files stand behind two dashes.
    let output = run(folder.path(), "motion info -1");
    assert!(message(&output).contains("use '-- -1'"), "{output:?}");
}

/// An option out of range is shown where it stands, with whatever else is wrong.
#[test]
fn options_are_shown_where_they_stand() {
    let folder = bench();
    let last = CASE.lines().count();
    for (method, option) in [
        ("method = \"moreau_jean\"\nstep = \"1 ms\"", "theta = 7"),
        ("method = \"newmark\"\nstep = \"1 ms\"", "beta = -1"),
        ("method = \"hht_alpha\"\nstep = \"1 ms\"", "alpha = 0.5"),
        ("method = \"adaptive\"\n", "relative_tolerance = 2"),
    ] {
        let (key, _) = option.split_once(" = ").unwrap();
        let text = format!("{CASE}{method}\n{option}\n");
        let place = format!("bad.toml:{}:{}: `{key}` = ", last + 3, key.len() + 4);
        std::fs::write(folder.path().join("bad.toml"), &text).unwrap();
        refused(&run(folder.path(), "check bad.toml"), &[&place]);
        let text = changed(&text, &[("\"25 t\"", "\"25 kN\"")]);
        std::fs::write(folder.path().join("bad.toml"), text).unwrap();
        refused(
            &run(folder.path(), "check bad.toml"),
            &["bad.toml:5:8:", &place],
        );
    }
}

const SEPARATION: &str = r#"[separation]
structural_system = ["frame", "timber"]
soil_zone = "IV"
provisions = ["asce_7_16_boundary", "asce_7", "no_such_code"]
"#;

/// Words of `[separation]` that are not known do not wait until all else is right.
#[test]
fn words_of_separation_come_with_the_others() {
    let folder = bench();
    let first = CASE.lines().count() + 1;
    let words = |line: usize, column: usize, what: &str| {
        format!("bad.toml:{}:{column}: {what}", first + line)
    };
    let wrong = [
        words(1, 31, "unknown structural system \"timber\""),
        words(2, 13, "unknown soil zone \"IV\""),
        words(3, 37, "unknown provision \"asce_7\""),
        words(3, 47, "unknown provision \"no_such_code\""),
    ];
    let wrong: Vec<&str> = wrong.iter().map(String::as_str).collect();
    let case = format!("{CASE}{SEPARATION}");
    for command in ["gap", "check"] {
        std::fs::write(folder.path().join("bad.toml"), &case).unwrap();
        refused(&run(folder.path(), &format!("{command} bad.toml")), &wrong);
        // With what reading finds, and what putting it together finds.
        for (from, to, place) in [
            ("\"25 t\"", "\"25 kN\"", "bad.toml:5:8:"),
            ("anagnostopoulos_2004", "no_such_model", "bad.toml:19:9:"),
        ] {
            let both = changed(&case, &[(from, to)]);
            std::fs::write(folder.path().join("bad.toml"), both).unwrap();
            let all = [&[place], wrong.as_slice()].concat();
            refused(&run(folder.path(), &format!("{command} bad.toml")), &all);
        }
    }
}

/// Whoever looks for a law that pulls among the models of gaps is told where it belongs,
/// wherever the model is named.
#[test]
fn laws_of_links_are_not_models_of_gaps() {
    let folder = bench();
    for arguments in [
        "compare case.toml --models tension_only",
        "compare case.toml --models hertz_1882,gap_hook",
        "models tension_only",
        "impact tension_only --example",
    ] {
        let output = run(folder.path(), arguments);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(
            said.contains("[[link]] with model = \"gap_hook\""),
            "{said}"
        );
        assert!(!said.contains("did you mean"), "{said}");
    }
    let said = message(&run(folder.path(), "compare case.toml --models hertz_1883"));
    assert!(said.contains("did you mean \"hertz_1882\"?"), "{said}");
}

/// One of anything is not `1 gaps`.
#[test]
fn one_is_singular() {
    let folder = bench();
    let one_storey = changed(
        CASE,
        &[
            ("storeys = 2", "storeys = 1"),
            ("storeys = 2", "storeys = 1"),
            (
                "{ ratio = 0.05, modes = [1, 2] }",
                "{ mass_proportional = 0.05 }",
            ),
        ],
    );
    let lists = changed(&one_storey, &[("\"100 t\"", "[\"100 t\", \"90 t\"]")]);
    let levels = changed(&one_storey, &[("width =", "levels = [2]\nwidth =")]);
    for (name, text) in [
        ("one.toml", &one_storey),
        ("lists.toml", &lists),
        ("levels.toml", &levels),
    ] {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let study = changed(STUDY, &[("\"0.1 g\", \"0.2 g\"", "\"0.1 g\"")]);
    std::fs::write(folder.path().join("one_run.toml"), study).unwrap();
    let mut all = String::new();
    for arguments in [
        "check one.toml",
        "run one.toml -o one.h5",
        "report one.h5 -o one.html",
        "gap one.toml --points 2 --from 10mm --to 20mm",
        "gap one.toml --all --points 0",
        "compare one.toml --models hertz_1882",
        "check lists.toml",
        "check levels.toml",
        "sweep one_run.toml --plan",
        "sweep one_run.toml -o sweep.h5",
    ] {
        let output = run(folder.path(), arguments);
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        all.push_str(&format!("{arguments}\n{printed}\n{}\n", message(&output)));
    }
    all.push_str(&std::fs::read_to_string(folder.path().join("one.html")).unwrap());
    let plural = all.lines().find(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let bare = |word: &str| word.trim_matches(|c: char| !c.is_alphanumeric()).to_owned();
        let nouns = [
            "gaps",
            "storeys",
            "impacts",
            "runs",
            "records",
            "levels",
            "buildings",
            "models",
            "widths",
            "steps",
            "events",
            "values",
            "times",
            "errors",
            "places",
            "provisions",
        ];
        words.windows(2).any(|pair| {
            pair[0].trim_matches(['(', ',']) == "1" && nouns.contains(&bare(pair[1]).as_str())
        })
    });
    assert_eq!(plural, None, "{all}");
    for said in [
        "2 buildings, 1 gap, ",
        "under 1 record",
        "of 1 record",
        "1 model, calibrated alike",
        "1 run in sweep.h5",
        "1 run in 1 shard",
    ] {
        assert!(all.contains(said), "{said}: {all}");
    }
}

/// What users write is shown, and never obeyed by the terminal.
#[test]
fn terminals_obey_no_text_of_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let case = std::fs::read_to_string(root.join("examples/three_storey_pair/case.toml")).unwrap();
    let motions = root.canonicalize().unwrap().join("ground_motions");
    let case = case.replace("../../ground_motions", motions.to_str().unwrap());
    let title = "title = \"Geb\u{e4}ude \u{5efa}\\u001b[2J\u{202e}\u{9b}1m\"";
    let titled = case.lines().map(|line| match line.starts_with("title") {
        true => title,
        false => line,
    });
    let titled: Vec<&str> = titled.collect();
    std::fs::write(folder.path().join("case.toml"), titled.join("\n")).unwrap();
    let wrong = titled.join("\n").replace("Geb", "Geb\u{1b}") + "\nmisplaced \u{2066} = \u{1b}[2J";
    std::fs::write(folder.path().join("wrong.toml"), wrong).unwrap();
    for (arguments, code, words) in [
        (
            &["run", "case.toml", "--no-output"][..],
            0,
            &["Geb\u{e4}ude \u{5efa}\\u{1b}[2J\\u{202e}\\u{9b}1m"][..],
        ),
        (&["check", "wrong.toml"], 2, &["\\u{1b}"]),
        (
            &["--color", "always", "check", "wrong.toml"],
            2,
            &["\\u{1b}"],
        ),
        (
            &["check", "\u{1b}[2J\u{202e}.toml"],
            2,
            &["\\u{1b}[2J\\u{202e}"],
        ),
    ] {
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .current_dir(folder.path())
            .env("COLUMNS", "200")
            .args(arguments)
            .output()
            .unwrap();
        let told = [output.stdout, output.stderr].concat();
        let told = String::from_utf8(told).unwrap();
        assert_eq!(output.status.code(), Some(code), "{arguments:?} {told}");
        for word in words {
            assert!(told.contains(word), "{arguments:?} {word}: {told:?}");
        }
        assert!(!told.contains("\u{1b}[2J"), "{arguments:?}: {told:?}");
        assert!(
            !told.contains(['\u{202e}', '\u{2066}', '\u{9b}']),
            "{arguments:?}: {told:?}"
        );
    }
}
