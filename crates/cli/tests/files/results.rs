//! Results of `run`: under which names, beside what stands there, and what is worth keeping.
#![cfg(unix)]

use std::os::unix::fs::PermissionsExt;
use std::process::{Command, Output, Stdio};

use super::fixture::{Fixture, message};
use crate::support::part_files::no_part_file;

/// The whole name of a case file stands in that of its result: gap_0.5 and gap_0.7 are two.
#[test]
fn names_with_dots_are_kept() {
    let fixture = Fixture::new();
    for name in ["gap_0.5", "gap_0.7"] {
        std::fs::copy(
            fixture.path("case.toml"),
            fixture.path(&format!("{name}.toml")),
        )
        .unwrap();
        let output = fixture.run(&["run", &format!("{name}.toml")]);
        assert!(output.status.success(), "{}", message(&output));
        assert!(fixture.path(&format!("{name}.h5")).is_file(), "{name}");
    }
}

/// Renaming asks the folder alone, but who takes away the right to write means the file.
#[test]
fn a_read_only_result_is_not_replaced() {
    let fixture = Fixture::new();
    let old = fixture.path("old.h5");
    std::fs::write(&old, "kept").unwrap();
    std::fs::set_permissions(&old, std::fs::Permissions::from_mode(0o444)).unwrap();
    let output = fixture.run(&["run", "case.toml", "-o", "old.h5"]);
    assert_eq!(output.status.code(), Some(4), "{}", message(&output));
    assert!(
        message(&output).contains("read-only"),
        "{}",
        message(&output)
    );
    assert_eq!(std::fs::read_to_string(&old).unwrap(), "kept");
}

/// A limit of the size of files (SIGXFSZ) is an output that could not be written, in few words.
#[test]
fn a_limit_of_size_is_an_error_of_writing() {
    let fixture = Fixture::new();
    let case = std::fs::read_to_string(fixture.path("case.toml")).unwrap();
    let dense = case.replace(
        "duration = \"2 s\"",
        "duration = \"20 s\"\noutput_step = \"1 ms\"",
    );
    assert!(dense != case);
    std::fs::write(fixture.path("dense.toml"), dense).unwrap();
    // 100 blocks of 512 or 1024 bytes.
    let script = "ulimit -f 100; exec \"$0\" run dense.toml -o new.h5";
    let output = Command::new("sh")
        .args(["-c", script, env!("CARGO_BIN_EXE_pounding")])
        .env("NO_COLOR", "1")
        .stdin(Stdio::null())
        .current_dir(fixture.path(""))
        .output()
        .unwrap();
    let text = message(&output);
    assert_eq!(output.status.code(), Some(4), "{text}");
    assert!(
        text.contains("new.h5") && !text.contains("18446744073709551615"),
        "{text}"
    );
    assert!(!text.contains("0x"), "{text}");
    assert!(!fixture.path("new.h5").exists());
    no_part_file(&fixture.path("").canonicalize().unwrap());
}

/// Between two walls the storey stands; without them it collapses, which takes nothing from
/// the run but its comparison.
#[test]
fn a_run_is_not_lost_with_its_comparison() {
    let fixture = Fixture::new();
    let wall = |between: &str| {
        format!(
            "[[gap]]\nbetween = {between}\nwidth = \"10 mm\"\nmodel = \"jankowski_2005\"\nstiffness = \"2.75e9 N/m^1.5\"\ndamping_ratio = 0.35\n"
        )
    };
    let building = "[[building]]\nname = \"s\"\np_delta = true\nlaw = { model = \"elastic_perfectly_plastic\", yield_force = \"2 kN\" }\nstoreys = 1\nmass = \"100 t\"\nstiffness = \"3.46 MN/m\"\nheight = \"1 m\"\ndamping = { stiffness_proportional = 0.05 }\n";
    let motion = "[ground_motion]\nfile = \"long.csv\"\n";
    let case = [
        building,
        &wall("[\"wall\", \"s\"]"),
        &wall("[\"s\", \"wall\"]"),
        motion,
    ];
    std::fs::write(fixture.path("walls.toml"), case.concat()).unwrap();
    let mut record = "# Unit: g\n# dt: 0.02 s\ntime_s,acceleration_g\n".to_owned();
    for i in 0..600 {
        let t = f64::from(i) * 0.02;
        record.push_str(&format!("{t:.2},{:.5}\n", 0.3 + 0.4 * (7.0 * t).sin()));
    }
    std::fs::write(fixture.path("long.csv"), record).unwrap();
    let output = fixture.run(&["run", "walls.toml", "-o", "walls.h5", "--json"]);
    assert!(output.status.success(), "{}", message(&output));
    let result: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let building = &result["buildings"][0];
    assert!(
        building["storeys"][0]["displacement"]["peak"]
            .as_f64()
            .unwrap()
            > 0.0
    );
    assert!(building["isolated"][0]["displacement"]["peak"].is_null());
    assert!(result["gaps"][0]["levels"][0]["impacts"].as_u64().unwrap() > 0);
    let warnings = result["warnings"].to_string();
    assert!(
        warnings.contains("without gaps and links: s collapsed"),
        "{warnings}"
    );
    let page = fixture.run(&["report", "walls.h5"]);
    assert!(page.status.success(), "{}", message(&page));
    let text = fixture.run(&["run", "walls.toml", "--no-output"]);
    assert!(!String::from_utf8_lossy(&text.stdout).contains("NaN"));
}

#[test]
fn texts_with_a_nul_are_written() {
    let fixture = Fixture::new();
    let case = std::fs::read_to_string(fixture.path("case.toml")).unwrap();
    std::fs::write(
        fixture.path("nul.toml"),
        format!("title = \"a\\u0000b\"\n{case}"),
    )
    .unwrap();
    let output = fixture.run(&["run", "nul.toml", "-o", "nul.h5"]);
    assert!(output.status.success(), "{}", message(&output));
}

/// No table, page or figure takes the place of a result, whose runs may be the work of days.
#[test]
fn no_text_takes_the_place_of_a_result() {
    let fixture = Fixture::new();
    let made = fixture.run(&["run", "case.toml", "-o", "kept.h5"]);
    assert!(made.status.success(), "{}", message(&made));
    let kept = std::fs::read(fixture.path("kept.h5")).unwrap();
    std::fs::copy(fixture.path("kept.h5"), fixture.path("other.h5")).unwrap();
    for command in [
        "gap case.toml --points 0 -o kept.h5",
        "gap case.toml --points 0 --csv kept.h5",
        "gap case.toml --points 0 --report kept.h5",
        "compare case.toml --models linear_elastic -o kept.h5",
        "run case.toml -o new.h5 --report kept.h5",
        "sweep study.toml -o new.h5 --csv kept.h5",
        "report other.h5 -o kept.h5",
        "explore case.toml -o kept.h5",
        "motion info record.csv -o kept.h5",
        "motion convert record.csv -o kept.h5",
        "motion spectrum record.csv --csv kept.h5",
    ] {
        let output = fixture.run(&command.split(' ').collect::<Vec<_>>());
        assert_ne!(output.status.code(), Some(0), "{command}");
        let said = message(&output);
        let is_known = said.contains("kept.h5 is the result of a run");
        assert!(is_known, "{command}: {said}");
        assert!(
            std::fs::read(fixture.path("kept.h5")).unwrap() == kept,
            "{command}"
        );
    }
}

/// Nor of a finished shard of a check, whose runs are stored nowhere else.
#[test]
fn nothing_takes_the_place_of_a_shard_of_a_check() {
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    let made = run("gap case.toml --points 3 --shard 1/2 --into parts");
    assert!(made.status.success(), "{}", message(&made));
    let shard = "parts/case.gap-shard-1-of-2.runs";
    let kept = std::fs::read(fixture.path(shard)).unwrap();
    for command in [
        "gap case.toml --points 0 --csv",
        "gap case.toml --points 0 -o",
        "compare case.toml --models linear_elastic --report",
        "run case.toml -o",
        "sweep study.toml -o",
        "sweep study.toml -o new.h5 --csv",
        "explore case.toml -o",
        "motion convert record.csv -o",
        "motion info record.csv -o",
    ] {
        let output = run(&format!("{command} {shard}"));
        let said = message(&output);
        assert_eq!(output.status.code(), Some(4), "{command}: {said}");
        assert!(
            said.contains("a finished shard of `gap`"),
            "{command}: {said}"
        );
        assert!(
            std::fs::read(fixture.path(shard)).unwrap() == kept,
            "{command}"
        );
    }
}

/// Nor does anything but an answer take the place of an answer, and one of another command or file
/// says so.
#[test]
fn only_an_answer_takes_the_place_of_an_answer() {
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    let made = run("gap case.toml --points 0 -o kept.json");
    assert!(
        matches!(made.status.code(), Some(0 | 1)),
        "{}",
        message(&made)
    );
    let kept = std::fs::read(fixture.path("kept.json")).unwrap();
    for command in [
        "gap case.toml --points 0 --csv kept.json",
        "compare case.toml --models linear_elastic --csv kept.json",
        "compare case.toml --models linear_elastic --report kept.json",
        "run case.toml -o kept.json",
        "sweep study.toml -o kept.json",
        "sweep study.toml -o new.h5 --csv kept.json",
        "explore case.toml -o kept.json",
        "motion convert record.csv -o kept.json",
        "motion spectrum record.csv --csv kept.json",
    ] {
        let output = run(command);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(4), "{command}: {said}");
        let is_known = said.contains("kept.json is the answer of `pounding gap`");
        assert!(is_known, "{command}: {said}");
        assert!(
            std::fs::read(fixture.path("kept.json")).unwrap() == kept,
            "{command}"
        );
    }
    let again = run("gap case.toml --points 0 -o kept.json");
    assert!(!message(&again).contains("replaced"));
    let other = run("compare case.toml --models linear_elastic -o kept.json");
    let said = message(&other);
    assert!(
        said.contains("kept.json will be replaced, the answer of `pounding gap` (case.toml)"),
        "{said}"
    );
    std::fs::write(fixture.path("kept.json"), "{}").unwrap();
    let said = message(&run("motion info record.csv -o kept.json"));
    assert!(
        said.contains("which is no answer of this program"),
        "{said}"
    );
}

/// Cases, studies and rules are written by hand, and no command writes TOML: nothing takes their place, whether or not the call
/// reads them.
#[test]
fn files_in_toml_stay() {
    let fixture = Fixture::new();
    let text = "title = \"of another project\"\n";
    std::fs::write(fixture.path("victim.toml"), text).unwrap();
    for command in [
        "run case.toml -o victim.toml",
        "run case.toml --no-output --plot victim.toml",
        "gap case.toml --points 0 --codes-csv victim.toml",
        "gap case.toml --points 0 -o victim.toml",
        "sweep study.toml -o new.h5 --csv victim.toml",
        "impact exact_hunt_crossley --example --csv victim.toml",
        "motion info record.csv --report victim.toml",
    ] {
        let output = fixture.run(&command.split(' ').collect::<Vec<_>>());
        let said = message(&output);
        assert_ne!(output.status.code(), Some(0), "{command}: {said}");
        assert_eq!(
            std::fs::read_to_string(fixture.path("victim.toml")).unwrap(),
            text,
            "{command}"
        );
    }
    let output = fixture.run(&[
        "impact",
        "exact_hunt_crossley",
        "--example",
        "--csv",
        "victim.toml",
    ]);
    assert_eq!(output.status.code(), Some(4));
    assert!(
        message(&output).contains("victim.toml is in TOML"),
        "{}",
        message(&output)
    );
}

/// So do those that a link leads to, through other links too, and those whose names say nothing of TOML, also where pages
/// are written into a folder: none of them is written then.
#[test]
fn files_in_toml_stay_behind_links_and_under_other_names() {
    use std::os::unix::fs::symlink;
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    let of_run = run("run case.toml -o run.h5");
    assert!(of_run.status.success(), "{}", message(&of_run));
    std::fs::create_dir(fixture.path("pages")).unwrap();
    let place = |name: &str| fixture.path(name);
    let copies = [
        ("case.toml", "a case"),
        ("study.toml", "a study"),
        ("rules.toml", "a file of rules"),
    ];
    let calls = [
        ("gap case.toml --points 0 --csv ", "mine.csv"),
        ("gap case.toml --points 0 -o ", "mine.json"),
        ("gap case.toml --points 0 --report ", "mine.html"),
        ("run case.toml -o ", "mine.h5"),
        ("run case.toml -o new.h5 --report ", "mine.html"),
        ("run case.toml -o new.h5 --plot ", "mine.svg"),
        ("sweep study.toml -o ", "mine.txt"),
        ("sweep study.toml -o new.h5 --csv ", "mine.csv"),
        ("report run.h5 -o ", "mine.html"),
        ("motion convert record.csv -o ", "mine.csv"),
        ("motion info record.csv -o ", "mine.json"),
        ("gap --list --pages pages", "pages/provisions.md"),
        ("models --pages pages", "pages/README.md"),
        ("man --pages pages", "pages/pounding-run.1"),
    ];
    for (call, name) in calls {
        let command = match call.ends_with(' ') {
            true => format!("{call}{name}"),
            false => call.to_owned(),
        };
        let up = if name.contains('/') { "../" } else { "" };
        let refused = |says: &[&str]| {
            let output = run(&command);
            let told = message(&output);
            assert_eq!(output.status.code(), Some(4), "{command}: {told}");
            for part in says {
                assert!(told.contains(part), "{command}: {told}");
            }
            assert!(!told.contains("replaced"), "{command}: {told}");
            assert!(!place("new.h5").exists(), "{command}");
        };
        let text = std::fs::read(place("case.toml")).unwrap();
        std::fs::write(place("victim.toml"), &text).unwrap();
        symlink(format!("{up}victim.toml"), place(name)).unwrap();
        refused(&["is a link to victim.toml, which is in TOML", name]);
        std::fs::remove_file(place(name)).unwrap();
        // By another name in between.
        std::fs::rename(place("victim.toml"), place("victim")).unwrap();
        symlink("victim", place("alias.TOML")).unwrap();
        symlink(format!("{up}alias.TOML"), place(name)).unwrap();
        refused(&["is a link to victim, which is in TOML"]);
        assert!(std::fs::read(place("victim")).unwrap() == text, "{command}");
        for file in [name, "alias.TOML"] {
            std::fs::remove_file(place(file)).unwrap();
        }
        for (copied, kind) in copies {
            std::fs::copy(place(copied), place(name)).unwrap();
            refused(&[&format!("{name} is {kind}, whatever its name")]);
            let kept = std::fs::read(place(name)).unwrap();
            assert!(kept == std::fs::read(place(copied)).unwrap(), "{command}");
            std::fs::remove_file(place(name)).unwrap();
        }
        assert_eq!(std::fs::read_dir(place("pages")).unwrap().count(), 0);
    }
    // A link to any other file is followed.
    std::fs::write(place("victim"), "").unwrap();
    symlink("victim", place("mine.csv")).unwrap();
    let output = run("motion convert record.csv -o mine.csv");
    assert!(output.status.success(), "{}", message(&output));
    assert!(place("mine.csv").is_symlink());
}

/// What another program has written stays under a default name; under a given one it is replaced,
/// and that is said. An empty file holds nothing, and results and pages of ours are replaced.
#[test]
fn a_file_of_another_program_is_not_replaced_unasked() {
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    let made = run("run case.toml -o other.h5");
    assert!(made.status.success(), "{}", message(&made));
    let foreign = [b"\x89HDF\r\n\x1a\nof another program".as_slice(), b"a text"];
    for (command, default) in [
        ("run case.toml", "case.h5"),
        ("sweep study.toml", "study.h5"),
        ("report other.h5", "other.html"),
        ("explore case.toml", "case.html"),
    ] {
        let default = match command {
            // Both are called by the folder where they are called `case` and `study`.
            "run case.toml" | "sweep study.toml" => {
                let made = run(command);
                let said = String::from_utf8_lossy(&made.stdout).into_owned();
                assert!(made.status.success(), "{command}: {}", message(&made));
                let ending = if command.starts_with("run") {
                    ".h5"
                } else {
                    ".study.h5"
                };
                let files = std::fs::read_dir(fixture.path("")).unwrap();
                let names = files.map(|f| f.unwrap().file_name().into_string().unwrap());
                let found = names
                    .filter(|n| n.ends_with(ending) && n != "other.h5" && said.contains(n.as_str()))
                    .max_by_key(String::len);
                found.unwrap_or_else(|| panic!("{default}: {said}"))
            }
            _ => default.to_owned(),
        };
        for bytes in foreign {
            std::fs::write(fixture.path(&default), bytes).unwrap();
            let output = run(command);
            let said = message(&output);
            assert_eq!(output.status.code(), Some(4), "{command}: {said}");
            assert!(said.contains("of this program"), "{command}: {said}");
            assert_eq!(std::fs::read(fixture.path(&default)).unwrap(), bytes);
            let named = run(&format!("{command} -o {default}"));
            let said = message(&named);
            assert!(named.status.success(), "{command}: {said}");
            // Of pages it is said when they are written.
            let is_said = ["will be replaced, which is no", "is replaced, which was no"];
            let times = is_said.map(|note| said.matches(note).count());
            assert_eq!(times.iter().sum::<usize>(), 1, "{command}: {said}");
        }
        // Its own, and an empty one.
        let again = run(command);
        assert!(again.status.success(), "{command}: {}", message(&again));
        std::fs::write(fixture.path(&default), "").unwrap();
        let again = run(command);
        assert!(again.status.success(), "{command}: {}", message(&again));
    }
    // A page of a version that did not mark them.
    let page = fixture.path("other.html");
    let marked = std::fs::read_to_string(&page).unwrap();
    let mark = "<meta name=\"generator\" content=\"pounding\">\n";
    assert!(marked.contains(mark));
    std::fs::write(&page, marked.replace(mark, "")).unwrap();
    let again = run("report other.h5");
    assert!(again.status.success(), "{}", message(&again));
}

/// Before any run, and without a trace.
#[test]
fn an_empty_name_is_no_file() {
    let fixture = Fixture::new();
    let before = std::fs::read_dir(fixture.path("")).unwrap().count();
    for command in [
        "run case.toml",
        "sweep study.toml",
        "gap case.toml --points 0",
    ] {
        let mut arguments: Vec<&str> = command.split(' ').collect();
        arguments.extend(["-o", ""]);
        let output = fixture.run(&arguments);
        let said = message(&output);
        assert_eq!(output.status.code(), Some(2), "{command}: {said}");
        assert!(said.contains("the name of a file is empty"), "{said}");
    }
    assert_eq!(std::fs::read_dir(fixture.path("")).unwrap().count(), before);
}

/// What an argument names is replaced with a note where it is no earlier output of the same kind, whichever
/// command writes it.
#[test]
fn what_is_replaced_is_named() {
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    for (command, file, again) in [
        ("motion convert record.csv -o", "mine.txt", true),
        ("motion spectrum record.csv --csv", "mine.csv", true),
        ("motion spectrum record.csv --svg", "mine.svg", true),
        ("sweep study.toml -o new.h5 --csv", "table.csv", true),
        ("gap case.toml --points 2 --csv", "gap.csv", true),
        ("gap case.toml --points 0 --report", "page.html", true),
        ("report run.h5 -o", "report.html", true),
    ] {
        run("run case.toml -o run.h5");
        std::fs::write(fixture.path(file), "mine\n").unwrap();
        // Said ahead of the work where it is long, else when it happens.
        let notes = |told: &str| {
            let of = |said: &str| {
                told.matches(&format!("{file} {said} replaced, which"))
                    .count()
            };
            of("is") + of("will be")
        };
        let output = run(&format!("{command} {file}"));
        let told = message(&output);
        // A gap may be too small.
        let answered = |output: &Output| output.status.code().is_some_and(|code| code < 2);
        assert!(answered(&output), "{command}: {told}");
        assert_eq!(notes(&told), 1, "{command}: {told}");
        let output = run(&format!("{command} {file}"));
        let told = message(&output);
        assert!(answered(&output), "{command}: {told}");
        assert_eq!(notes(&told) == 0, again, "{command}: {told}");
    }
    // A record of another file, and the pages of a folder.
    let told = message(&run("motion convert second.csv -o mine.txt"));
    let note = "mine.txt is replaced, which was made of another record";
    assert!(told.contains(note), "{told}");
    // Columns of numbers name no source: they may be the user's, and are not said to be.
    let columns = "motion convert record.csv --to plain_columns -o columns.txt --output-unit";
    for (unit, told_of) in [("g", 0), ("g", 0), ("m/s2", 1)] {
        let told = message(&run(&format!("{columns} {unit}")));
        let note = "columns.txt is replaced, whose numbers do not say what wrote them";
        assert_eq!(told.matches(note).count(), told_of, "{unit}: {told}");
        assert_eq!(told.matches("replaced").count(), told_of, "{unit}: {told}");
    }
    // A table says what its command was asked for: other values are of the same kind, other columns are not.
    let law = "hysteresis bilinear --set stiffness=1e7 --set yield_force=1e5 --csv law.csv";
    let tables = [
        ("--cycles 20mm", 0),
        ("--cycles 40mm", 0),
        ("--dissipation 1mm,20mm", 1),
    ];
    for ((table, told_of), ratio) in tables.into_iter().zip(["0.05", "0.2", "0.2"]) {
        let told = message(&run(&format!(
            "{law} --set hardening_ratio={ratio} {table}"
        )));
        assert!(fixture.path("law.csv").exists(), "{told}");
        let note = "law.csv is replaced, which was no earlier output of this kind";
        assert_eq!(told.matches(note).count(), told_of, "{table}: {told}");
    }
    let tables = [("curves.csv", "--csv"), ("table.csv", "--table --csv")];
    for ((name, option), stiffness) in tables.into_iter().flat_map(|t| [(t, "9e7"), (t, "8e7")]) {
        let told = message(&run(&format!(
            "impact linear_elastic -p stiffness={stiffness} {option} {name}"
        )));
        assert!(fixture.path(name).exists(), "{told}");
        assert!(!told.contains(&format!("{name} is replaced")), "{told}");
    }
    std::fs::create_dir(fixture.path("man")).unwrap();
    std::fs::write(fixture.path("man/pounding-run.1"), "mine\n").unwrap();
    let told = message(&run("man --pages man"));
    assert_eq!(told.matches("is replaced").count(), 1, "{told}");
    assert!(told.contains("pounding-run.1 is replaced"), "{told}");
    let told = message(&run("man --pages man"));
    assert!(!told.contains("is replaced"), "{told}");
}

/// Nothing is said to be replaced that is refused after it was looked at, for another reason.
#[test]
fn what_is_refused_is_not_said_to_be_replaced() {
    let fixture = Fixture::new();
    let run = |command: &str| fixture.run(&command.split(' ').collect::<Vec<_>>());
    for command in [
        "run case.toml -o run.h5",
        "sweep study.toml --shard 1/2 --into all",
        "sweep study.toml --shard 2/2 --into all",
    ] {
        let output = run(command);
        assert!(output.status.success(), "{}", message(&output));
    }
    std::fs::copy(fixture.path("record.csv"), fixture.path("copy.dat")).unwrap();
    std::fs::write(fixture.path("mine.dat"), "mine").unwrap();
    for (command, code) in [
        ("merge all -o copy.dat", 2),
        ("report run.h5 -o copy.dat", 2),
        ("sweep study.toml -o mine.dat --csv run.h5", 4),
        ("sweep study.toml -o mine.dat --store-every -1s", 2),
        ("merge all -o mine.dat --csv copy.dat", 2),
    ] {
        let before = fixture.content();
        let output = run(command);
        let told = message(&output);
        assert_eq!(output.status.code(), Some(code), "{command}: {told}");
        let is_said = ["will be replaced", "is replaced,"].map(|note| told.contains(note));
        assert_eq!(is_said, [false; 2], "{command}: {told}");
        assert!(fixture.content() == before, "{command}");
    }
    let output = run("merge all -o mine.dat");
    let told = message(&output);
    assert!(output.status.success(), "{told}");
    let note = "mine.dat will be replaced, which is no result of this program";
    assert_eq!(told.matches(note).count(), 1, "{told}");
}

/// What a process has opened is no place for a file: neither the link is replaced that leads there, nor what
/// the shell writes into.
#[cfg(target_os = "linux")]
#[test]
fn descriptors_are_no_outputs() {
    let fixture = Fixture::new();
    std::os::unix::fs::symlink("/proc/self/fd/1", fixture.path("link")).unwrap();
    for command in [
        "motion convert record.csv -o",
        "gap case.toml --points 0 --csv",
        "gap case.toml --points 0 -o",
        "run case.toml -o",
        "sweep study.toml -o new.h5 --csv",
    ] {
        for output in ["link", "/proc/self/fd/1"] {
            for before in ["echo precious > log;", "echo precious > log; rm log;"] {
                let program = env!("CARGO_BIN_EXE_pounding");
                let script = match before.contains("rm") {
                    false => format!("{before} {program} {command} {output} >> log"),
                    true => format!(
                        "echo precious > log; exec 3>> log; rm log; {program} {command} {output} >&3"
                    ),
                };
                let output = Command::new("sh")
                    .args(["-c", &script])
                    .env("NO_COLOR", "1")
                    .current_dir(fixture.path("."))
                    .output()
                    .unwrap();
                let told = message(&output);
                assert_eq!(output.status.code(), Some(4), "{script}: {told}");
                assert!(told.contains("not a regular file"), "{script}: {told}");
                assert!(fixture.path("link").is_symlink(), "{script}");
                if !before.contains("rm") {
                    let log = std::fs::read(fixture.path("log")).unwrap();
                    assert!(log.starts_with(b"precious"), "{script}");
                }
            }
        }
    }
}

/// The table of impacts and its dimension are there, of length 0, where floors never touch, as the page of the result file says.
#[test]
fn impacts_are_there_where_there_are_none() {
    let fixture = Fixture::new();
    let case = std::fs::read_to_string(fixture.path("case.toml")).unwrap();
    let widths: Vec<&str> = case.lines().filter(|l| l.starts_with("width")).collect();
    let wide = case.replace(widths[0], "width = \"3 m\"");
    std::fs::write(fixture.path("wide.toml"), wide).unwrap();
    let output = fixture.run(&["run", "wide.toml"]);
    assert!(output.status.success(), "{}", message(&output));
    let file = hdf5::File::open(fixture.path("wide.h5")).unwrap();
    let gap = &file.group("gap").unwrap().groups().unwrap()[0];
    for name in ["impact", "impacts"] {
        assert_eq!(gap.dataset(name).unwrap().shape(), [0], "{name}");
    }
    let page = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../docs/reference/result-file.md"
    );
    let page = std::fs::read_to_string(page).unwrap();
    let said = "number of the impact; of length 0 if there is none";
    assert!(page.contains(said), "{said}");
}

/// A run is held against the buildings without gaps and links, a study against those without gaps alone: names of peaks say it.
#[test]
fn isolated_peaks_say_what_they_are_without() {
    let fixture = Fixture::new();
    let output = fixture.run(&["run", "case.toml", "-o", "run.h5"]);
    assert!(output.status.success(), "{}", message(&output));
    let study = "case = \"case.toml\"\n[[variable]]\npath = \"gap.0.width\"\nvalues = [\"20 mm\", \"30 mm\"]\n\
                 [output]\nisolated_peaks = true\n";
    std::fs::write(fixture.path("peaks.toml"), study).unwrap();
    let output = fixture.run(&["sweep", "peaks.toml"]);
    assert!(output.status.success(), "{}", message(&output));
    let said = |data: &hdf5::Dataset| -> String {
        let name: hdf5::types::VarLenUnicode =
            data.attr("long_name").unwrap().read_scalar().unwrap();
        name.to_string()
    };
    let file = hdf5::File::open(fixture.path("run.h5")).unwrap();
    for building in file.group("building").unwrap().groups().unwrap() {
        let peaks = building.group("peak").unwrap().datasets().unwrap();
        let isolated = peaks.iter().filter(|p| p.name().contains("/isolated_"));
        let names: Vec<String> = isolated.map(said).collect();
        assert!(names.len() >= 8, "{names:?}");
        for name in names {
            assert!(name.ends_with(" without gaps and links"), "{name}");
        }
    }
    let file = hdf5::File::open(fixture.path("peaks.h5")).unwrap();
    let name = said(&file.dataset("isolated_peak_storey_shear").unwrap());
    assert!(name.contains(" without gaps, missing where"), "{name}");
}
