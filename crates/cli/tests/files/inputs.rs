//! No command writes over what it reads, or twice into one file: for all commands and all
//! their outputs, as the definitions of their arguments have them.

use clap::parser::ValueSource;
use clap::{Arg, Command};
use pounding_cli::PathKind;

use super::fixture::{Fixture, message};

/// One way to call a command without its outputs, and every file that it reads then.
struct Call {
    words: &'static str,
    reads: &'static [&'static str],
}

const fn call(words: &'static str, reads: &'static [&'static str]) -> Call {
    Call { words, reads }
}

/// A command that writes has to be here, and every input of it in one of its calls.
const CALLS: [Call; 50] = [
    call("run case.toml", CASE),
    call("floor-spectrum case.toml --at 0.5s", CASE),
    call(
        "floor-spectrum case.toml --at 0.5s --records second.csv",
        &["case.toml", "second.csv", "target.csv", "step.csv"],
    ),
    call(
        "compare case.toml --models anagnostopoulos_2004 --records counts.mseed",
        &["case.toml", "counts.mseed", "station.xml"],
    ),
    call("explore case.toml", CASE),
    call(
        "explore case.toml --rules rules.toml",
        &[
            "case.toml",
            "rules.toml",
            "record.csv",
            "target.csv",
            "step.csv",
        ],
    ),
    call(
        "explore case.toml --records second.csv",
        &[
            "case.toml",
            "record.csv",
            "second.csv",
            "target.csv",
            "step.csv",
        ],
    ),
    call("report result.h5", &["result.h5"]),
    call(
        "report ida.h5 --study study.toml",
        &[
            "ida.h5",
            "study.toml",
            "case.toml",
            "record.csv",
            "second.csv",
            "step.csv",
            "other_step.csv",
            "target.csv",
            "hazard.csv",
        ],
    ),
    call(
        "gap case.toml --points 3 --records record.csv second.csv",
        &[
            "case.toml",
            "record.csv",
            "second.csv",
            "target.csv",
            "step.csv",
        ],
    ),
    // Found beside the record, without being named.
    call(
        "gap case.toml --points 3 --records counts.mseed",
        &["case.toml", "counts.mseed", "station.xml"],
    ),
    call("gap case.toml --points 3", CASE),
    call(
        "gap case.toml --points 3 --rules rules.toml",
        &[
            "case.toml",
            "rules.toml",
            "record.csv",
            "target.csv",
            "step.csv",
        ],
    ),
    call("compare case.toml --models anagnostopoulos_2004", CASE),
    call(
        "compare case.toml --models anagnostopoulos_2004 --records second.csv",
        &["case.toml", "second.csv", "target.csv", "step.csv"],
    ),
    call(
        "gap case.toml --points 3 --merge gap.runs",
        &["case.toml", "record.csv", "gap.runs"],
    ),
    call(
        "compare case.toml --models anagnostopoulos_2004 --merge compare.runs",
        &["case.toml", "record.csv", "compare.runs"],
    ),
    call("sweep study.toml", STUDY),
    call(
        "sweep targets.toml",
        &[
            "targets.toml",
            "case.toml",
            "record.csv",
            "target.csv",
            "other_target.csv",
        ],
    ),
    call("ida study.toml", STUDY),
    call("merge 1.h5 2.h5", &["1.h5", "2.h5"]),
    // What the study reads stays as well, where it is found.
    call("merge 2.h5 --partial", STUDY),
    call(
        "motion info record.csv second.csv",
        &["record.csv", "second.csv"],
    ),
    call("motion spectrum record.csv", &["record.csv"]),
    call(
        "motion spectrum record.csv --rotated --second-file second.csv",
        &["record.csv", "second.csv"],
    ),
    call("motion convert record.csv", &["record.csv"]),
    call(
        "motion process record.csv --scale target=target.csv,from=0.2s,to=0.5s",
        &["record.csv", "target.csv"],
    ),
    call(
        "motion info counts.mseed --response station.xml",
        &["counts.mseed", "station.xml"],
    ),
    call(
        "motion spectrum counts.mseed --response station.xml",
        &["counts.mseed", "station.xml"],
    ),
    // Found beside the record, without being named.
    call(
        "motion convert counts.mseed",
        &["counts.mseed", "station.xml"],
    ),
    call(
        "motion convert counts.mseed --response station.xml",
        &["counts.mseed", "station.xml"],
    ),
    call(
        "motion process counts.mseed --response station.xml --scale target=target.csv,from=0.2s,to=0.5s",
        &["counts.mseed", "station.xml", "target.csv"],
    ),
    call(
        "motion match counts.mseed --response station.xml --target target.csv --from 0.2s --to 0.5s --tolerance 90%",
        &["counts.mseed", "station.xml", "target.csv"],
    ),
    call(
        "motion match record.csv --target target.csv --from 0.2s --to 0.5s --tolerance 90%",
        &["record.csv", "target.csv"],
    ),
    call(
        "motion synth sine --amplitude 1m/s^2 --frequency 1Hz --duration 2s",
        &[],
    ),
    call(
        "motion synth ricker_1953 --amplitude 1m/s^2 --period 0.5s --duration 2s",
        &[],
    ),
    call(
        "motion synth mavroeidis_papageorgiou_2003 --amplitude 1m/s --frequency 1Hz --gamma 2 --duration 4s",
        &[],
    ),
    call(
        "motion synth makris_roussos_2000 --type a --amplitude 1m/s --period 1s --duration 2s",
        &[],
    ),
    call(
        "motion synth kanai_tajimi_1960 --peak-acceleration 0.3g --seed 1 --duration 20s",
        &[],
    ),
    call(
        "motion synth clough_penzien_1975 --peak-acceleration 0.3g --seed 1 --duration 20s",
        &[],
    ),
    call(
        "motion synth rezaeian_der_kiureghian_2010 --significant-duration 3 --middle-time 2 --middle-frequency 4Hz --seed 1 --duration 8s",
        &[],
    ),
    call(
        "motion synth boore_2003 --magnitude 6 --distance 20km --seed 1 --duration 20s",
        &[],
    ),
    call(
        "impact exact_hunt_crossley --example --against measured.csv",
        &["measured.csv"],
    ),
    call("impact exact_hunt_crossley --example --table", &[]),
    call(
        "impact borovin_2014 -p friction=0.3 --spring spring.csv",
        &["spring.csv"],
    ),
    call(
        "hysteresis elastic_perfectly_plastic --history history.csv",
        &["history.csv"],
    ),
    call(
        "hysteresis iwan_six_parameter --set residual_stiffness=1kN/m --fit dissipation dissipation.csv",
        &["dissipation.csv"],
    ),
    call("hysteresis bilinear --cycles 1mm", &[]),
    call("models", &[]),
    call("man", &[]),
];

const CASE: &[&str] = &["case.toml", "record.csv", "target.csv", "step.csv"];
const STUDY: &[&str] = &[
    "study.toml",
    "case.toml",
    "record.csv",
    "second.csv",
    "step.csv",
    "other_step.csv",
    "target.csv",
    "hazard.csv",
];

/// All commands that have arguments, with their names in a row.
fn commands() -> Vec<(String, Command)> {
    fn collect(command: &Command, name: &str, all: &mut Vec<(String, Command)>) {
        all.push((name.trim().to_owned(), command.clone()));
        for sub in command.get_subcommands() {
            collect(sub, &format!("{name} {}", sub.get_name()), all);
        }
    }
    let mut all = Vec::new();
    collect(&pounding_cli::command(), "", &mut all);
    all
}

fn of_kind(command: &Command, wanted: &[PathKind]) -> Vec<Arg> {
    let arguments = command.get_arguments();
    let found = arguments.filter(|a| PathKind::of(a).is_some_and(|k| wanted.contains(&k)));
    found.cloned().collect()
}

/// The command of a call: as many of its first words as name one.
fn called(words: &str, commands: &[(String, Command)]) -> (String, Command) {
    let fits = |name: &str| words == name || words.starts_with(&format!("{name} "));
    let found = commands
        .iter()
        .filter(|(name, _)| !name.is_empty() && fits(name));
    found.max_by_key(|(name, _)| name.len()).unwrap().clone()
}

/// A path of no declared kind would be compared with nothing.
#[test]
fn every_path_is_an_input_or_an_output() {
    let mut outputs = 0;
    for (name, command) in commands() {
        for argument in command.get_arguments() {
            let (kind, id) = (PathKind::of(argument), argument.get_id());
            assert_ne!(
                kind,
                Some(PathKind::Unknown),
                "`{name}`: {id} is a plain path: declare it as InputPath, OutputPath or OutputFolder"
            );
            outputs += usize::from(kind == Some(PathKind::Output));
            // An output that is a plain text would go unseen.
            let named = ["output", "csv", "svg", "plot", "table", "pages"];
            let takes_value = argument.get_action().takes_values();
            if takes_value && named.iter().any(|n| id.as_str().contains(n)) {
                assert!(
                    matches!(kind, Some(PathKind::Output | PathKind::OutputFolder))
                        || id.as_str() == "output_unit",
                    "`{name}`: {id}"
                );
            }
        }
    }
    assert!(outputs >= 35, "{outputs}");
}

/// Every output of every command, and every input that a command has, is tried below.
#[test]
fn every_command_that_writes_is_called() {
    let commands = commands();
    for (name, command) in &commands {
        let writes = of_kind(command, &[PathKind::Output, PathKind::OutputFolder]);
        if writes.is_empty() {
            continue;
        }
        let calls: Vec<_> = CALLS
            .iter()
            .filter(|c| called(c.words, &commands).0 == *name)
            .collect();
        assert!(!calls.is_empty(), "`{name}` writes: add a call of it");
        for input in of_kind(command, &[PathKind::Input]) {
            let given = calls.iter().any(|call| gives(command, name, call, &input));
            assert!(given, "`{name}`: no call gives {}", input.get_id());
        }
    }
}

/// Whether a call gives an argument.
fn gives(command: &Command, name: &str, call: &Call, argument: &Arg) -> bool {
    let mut words: Vec<&str> = vec![name];
    words.extend(call.words[name.len()..].split_whitespace());
    let needed = of_kind(command, &[PathKind::Output]);
    let needed: Vec<String> = needed
        .iter()
        // `merge` needs its own unless it only checks.
        .filter(|a| a.is_required_set() || name == "merge" && a.get_id() == "output")
        .map(|a| format!("--{}=new", a.get_long().unwrap()))
        .collect();
    words.extend(needed.iter().map(String::as_str));
    let matches = command.clone().try_get_matches_from(words).unwrap();
    matches.value_source(argument.get_id().as_str()) == Some(ValueSource::CommandLine)
}

/// The fixture with what other commands make of it.
fn bench() -> Fixture {
    let fixture = Fixture::new();
    for words in [
        "run case.toml -o result.h5",
        "ida study.toml -o ida.h5",
        "sweep study.toml --shard 1/2 -o 1.h5",
        "sweep study.toml --shard 2/2 -o 2.h5",
        "gap case.toml --points 3 --shard 1/1 --into parts",
        "compare case.toml --models anagnostopoulos_2004 --shard 1/1 --into parts",
    ] {
        let output = fixture.run(&words.split_whitespace().collect::<Vec<_>>());
        assert!(output.status.success(), "{}", message(&output));
    }
    for check in ["gap", "compare"] {
        let shard = fixture.path(&format!("parts/case.{check}-shard-1-of-1.runs"));
        std::fs::rename(shard, fixture.path(&format!("{check}.runs"))).unwrap();
    }
    std::fs::remove_dir(fixture.path("parts")).unwrap();
    fixture
}

/// The words of a call with an option set to a path; other outputs that it must have, or
/// would write beside its input, are new files.
fn with_output<'w>(
    call: &'w Call,
    others: &'w [String],
    option: &'w str,
    path: &'w str,
) -> Vec<&'w str> {
    let mut words: Vec<&str> = call.words.split_whitespace().collect();
    // Steps and models take more than one word: outputs come as options of their own.
    words.extend(others.iter().map(String::as_str));
    words.extend([option, path]);
    words
}

/// Outputs of a command by their options, and for each those of the others that it needs.
fn outputs(command: &Command) -> Vec<(String, Vec<String>)> {
    let all = of_kind(command, &[PathKind::Output]);
    let option = |a: &Arg| format!("--{}", a.get_long().unwrap());
    all.iter()
        .map(|tried| {
            let needed = all.iter().enumerate().filter(|(_, a)| {
                a.get_id() != tried.get_id() && (a.is_required_set() || a.get_id() == "output")
            });
            let needed = needed.map(|(i, a)| format!("{}=needed-{i}", option(a)));
            (option(tried), needed.collect())
        })
        .collect()
}

/// What is called here does run, and writes the file: else the refusals below show nothing.
#[test]
fn every_call_is_valid_and_writes() {
    let commands = commands();
    let fixture = bench();
    for call in &CALLS {
        let (name, command) = called(call.words, &commands);
        if call.reads.is_empty() && !name.starts_with("motion synth") {
            continue;
        }
        if name == "explore" && !crate::explore::has_module() {
            continue;
        }
        let before = fixture.content();
        let mut words: Vec<String> = call.words.split_whitespace().map(str::to_owned).collect();
        let outputs = outputs(&command);
        assert!(!outputs.is_empty(), "{}", call.words);
        let new = |option: &str| format!("new-{}.svg", option.trim_start_matches('-'));
        words.extend(
            outputs
                .iter()
                .map(|(option, _)| format!("{option}={}", new(option))),
        );
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let output = fixture.run(&words);
        let code = output.status.code().unwrap();
        assert!(
            code == 0 || (code == 1 && name == "gap"),
            "{}: {}",
            call.words,
            message(&output)
        );
        for (option, _) in &outputs {
            let path = fixture.path(&new(option));
            assert!(path.is_file(), "{}: {option}", call.words);
            std::fs::remove_file(path).unwrap();
        }
        assert!(fixture.content() == before, "{}", call.words);
    }
}

/// Every output of every call over every input of it, under all its names.
#[cfg(unix)]
#[test]
fn no_output_takes_the_place_of_an_input() {
    use std::os::unix::fs::symlink;
    let commands = commands();
    let fixture = bench();
    let mut tried = 0;
    for call in &CALLS {
        let (_, command) = called(call.words, &commands);
        for (option, others) in outputs(&command) {
            for input in call.reads {
                // Figures are refused under other names than these, before anything else.
                let (soft, hard) = ("soft.svg", "hard.svg");
                symlink(input, fixture.path(soft)).unwrap();
                std::fs::hard_link(fixture.path(input), fixture.path(hard)).unwrap();
                let before = fixture.content();
                let detour = format!("./inside/../{input}");
                for path in [*input, &detour, soft, hard] {
                    let words = with_output(call, &others, &option, path);
                    let output = fixture.run(&words);
                    let told = message(&output);
                    assert_eq!(output.status.code(), Some(2), "{words:?}: {told}");
                    if path.ends_with(".svg") || !told.contains("figures are written as SVG") {
                        for part in ["would take the place of", path, "another name"] {
                            assert!(told.contains(part), "{words:?}: {told}");
                        }
                        tried += 1;
                    }
                    assert!(fixture.content() == before, "{words:?}");
                }
                std::fs::remove_file(fixture.path(soft)).unwrap();
                std::fs::remove_file(fixture.path(hard)).unwrap();
            }
        }
    }
    assert!(tried > 300, "{tried}");
}

/// Every pair of outputs of every call under one name, whether the file is there or not.
#[test]
fn no_two_outputs_are_one_file() {
    let commands = commands();
    let fixture = bench();
    std::fs::write(fixture.path("old.svg"), "old").unwrap();
    let before = fixture.content();
    let mut tried = 0;
    for call in &CALLS {
        let (_, command) = called(call.words, &commands);
        let options: Vec<String> = outputs(&command).into_iter().map(|(o, _)| o).collect();
        for (i, one) in options.iter().enumerate() {
            for other in &options[..i] {
                for path in ["new.svg", "old.svg"] {
                    let mut words: Vec<&str> = call.words.split_whitespace().collect();
                    let detour = format!("inside/../{path}");
                    words.extend([one.as_str(), path, other, &detour]);
                    let needed = format!("{}=needed", "--output");
                    let named = [one.as_str(), other].contains(&"--output");
                    if options.iter().any(|o| o == "--output") && !named {
                        words.push(&needed);
                    }
                    let output = fixture.run(&words);
                    let told = message(&output);
                    assert_eq!(output.status.code(), Some(2), "{words:?}: {told}");
                    assert!(told.contains("name the same file"), "{words:?}: {told}");
                    assert!(
                        told.contains(one.as_str()) && told.contains(other.as_str()),
                        "{told}"
                    );
                    assert!(fixture.content() == before, "{words:?}");
                    tried += 1;
                }
            }
        }
    }
    assert!(tried > 50, "{tried}");
}

/// A slash behind the name of a file: the system finds nothing there and puts nothing there. Every output of every
/// call is refused before any work, whether a file of the name stands or not, also one that is read.
#[test]
fn no_output_ends_as_the_name_of_a_folder() {
    let commands = commands();
    let fixture = bench();
    std::fs::write(fixture.path("old.svg"), "old").unwrap();
    #[cfg(unix)]
    std::os::unix::fs::symlink("old.svg", fixture.path("link.svg")).unwrap();
    let before = fixture.content();
    let mut tried = 0;
    for call in &CALLS {
        let (_, command) = called(call.words, &commands);
        for (option, others) in outputs(&command) {
            let names = [
                "old.svg/",
                "old.svg//",
                "old.svg/.",
                "new.svg/",
                "link.svg/",
                "inside/",
            ];
            let read = call.reads.iter().map(|input| format!("{input}/"));
            for path in names.into_iter().map(str::to_owned).chain(read) {
                let words = with_output(call, &others, &option, &path);
                let output = fixture.run(&words);
                let told = message(&output);
                assert_eq!(output.status.code(), Some(2), "{words:?}: {told}");
                // Figures are refused under other names than these, before anything else.
                if told.contains("figures are written as SVG") {
                    continue;
                }
                let wanted = format!("{option} {path} ends as the name of a folder");
                for part in [wanted.as_str(), "without a slash behind it"] {
                    assert!(told.contains(part), "{words:?}: {told}");
                }
                tried += 1;
            }
        }
    }
    assert!(fixture.content() == before);
    assert!(tried > 300, "{tried}");
}

/// Names that the program gives by itself are compared as well.
#[test]
fn default_outputs_spare_inputs_too() {
    let fixture = bench();
    for (from, to) in [
        ("case.toml", "named.h5"),
        ("study.toml", "studied.h5"),
        ("result.h5", "result.html"),
    ] {
        std::fs::copy(fixture.path(from), fixture.path(to)).unwrap();
    }
    std::fs::hard_link(fixture.path("record.csv"), fixture.path("record.svg")).unwrap();
    let before = fixture.content();
    for words in [
        "run named.h5",
        "run case.toml -o new.h5 --plot record.svg",
        "sweep studied.h5",
        "ida studied.h5",
        "report result.html",
        // The folder of the finished runs is removed at the end, with what lies in it.
        "sweep study.toml -o new.h5 --csv new.h5.parts/runs.csv",
        "sweep study.toml -o new.h5 --csv new.h5.parts",
    ] {
        let output = fixture.run(&words.split_whitespace().collect::<Vec<_>>());
        let told = message(&output);
        assert_eq!(output.status.code(), Some(2), "{words}: {told}");
        let reasons = [
            "would take the place of",
            "lies in new.h5.parts",
            "name the same file",
        ];
        assert!(reasons.iter().any(|r| told.contains(r)), "{words}: {told}");
        assert!(fixture.content() == before, "{words}");
    }
}

/// A file that somebody keeps in the folder of the finished runs is not removed with it.
#[test]
fn files_of_others_stay_in_the_folder_of_finished_runs() {
    let fixture = Fixture::new();
    let folder = fixture.path("new.h5.parts");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("notes.txt"), "mine").unwrap();
    let output = fixture.run(&["sweep", "study.toml", "-o", "new.h5"]);
    assert!(output.status.success(), "{}", message(&output));
    let left: Vec<_> = std::fs::read_dir(&folder).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
    assert_eq!(std::fs::read(folder.join("notes.txt")).unwrap(), b"mine");
}

/// What sweeps and their shards keep beside their results is written through no link, and the file that their lock is
/// taken of is neither emptied nor removed where it is somebody's: files that are read stay, and so do others.
#[cfg(unix)]
#[test]
fn files_beside_results_are_written_through_no_link() {
    use std::os::unix::fs::symlink;
    let fixture = Fixture::new();
    std::fs::write(fixture.path("mine.txt"), "mine").unwrap();
    // Files of `study.toml` are called by its folder.
    std::fs::copy(fixture.path("study.toml"), fixture.path("named.toml")).unwrap();
    let before = fixture.content();
    let into = "D/named.shard-1-of-2";
    let sweep = "sweep named.toml -o o.h5";
    let shard = "sweep named.toml --shard 1/2 --into D";
    for (words, place) in [
        (sweep, "o.h5.parts/lock".to_owned()),
        (sweep, "o.h5.parts/study.txt".to_owned()),
        (shard, format!("{into}.h5.parts/lock")),
        (shard, format!("{into}.h5.parts/study.txt")),
        (shard, "D/status/named.shard-1-of-2.json".to_owned()),
        (shard, "D/records/list.json".to_owned()),
        (
            "gap case.toml --points 3 --shard 1/2 --into D",
            "D/case.gap-shard-1-of-2.runs".to_owned(),
        ),
    ] {
        let at = fixture.path(&place);
        let folder = at.parent().unwrap();
        let up = "../".repeat(place.matches('/').count());
        for to in ["record.csv", "named.toml", "mine.txt", "nothing"] {
            for is_hard in [false, true] {
                std::fs::create_dir_all(folder).unwrap();
                match is_hard {
                    false => symlink(format!("{up}{to}"), &at).unwrap(),
                    true if to == "nothing" => continue,
                    true => std::fs::hard_link(fixture.path(to), &at).unwrap(),
                }
                let output = fixture.run(&words.split(' ').collect::<Vec<_>>());
                let told = message(&output);
                for (path, bytes) in &before {
                    let what = format!("{words}, {place}, {to}, {is_hard}: {told}");
                    assert!(std::fs::read(path).unwrap() == *bytes, "{what}");
                }
                assert!(!fixture.path("nothing").exists());
                assert!(!output.status.success(), "{words}, {place}, {to}: {told}");
                assert!(told.contains(&place) || told.contains("parts"), "{told}");
                let stays = at.is_symlink() || is_hard && at.is_file();
                assert!(stays, "{words}, {place}, {to}");
                for made in ["D", "o.h5.parts"] {
                    let _ = std::fs::remove_dir_all(fixture.path(made));
                }
                let _ = std::fs::remove_file(fixture.path("o.h5"));
            }
        }
    }
    // A lock that holds something is none, and an empty one is taken.
    std::fs::create_dir(fixture.path("o.h5.parts")).unwrap();
    std::fs::write(fixture.path("o.h5.parts/lock"), "mine").unwrap();
    let words: Vec<&str> = sweep.split(' ').collect();
    let output = fixture.run(&words);
    let told = message(&output);
    assert_eq!(output.status.code(), Some(4), "{told}");
    assert!(told.contains("this file holds something"), "{told}");
    let kept = std::fs::read(fixture.path("o.h5.parts/lock")).unwrap();
    assert_eq!(kept, b"mine");
    std::fs::write(fixture.path("o.h5.parts/lock"), "").unwrap();
    let output = fixture.run(&words);
    assert!(output.status.success(), "{}", message(&output));
    assert!(!fixture.path("o.h5.parts").exists());
}

/// A link to a file is followed and stays; a link to nothing is refused.
#[cfg(unix)]
#[test]
fn links_as_outputs() {
    use std::os::unix::fs::symlink;
    let fixture = Fixture::new();
    std::fs::write(fixture.path("inside/real.h5"), "old").unwrap();
    symlink("inside/real.h5", fixture.path("link.h5")).unwrap();
    let output = fixture.run(&["run", "case.toml", "-o", "link.h5"]);
    assert!(output.status.success(), "{}", message(&output));
    assert!(fixture.path("link.h5").is_symlink());
    let output = fixture.run(&["report", "inside/real.h5"]);
    assert!(output.status.success(), "{}", message(&output));
    symlink("nowhere.svg", fixture.path("dangling.svg")).unwrap();
    let output = fixture.run(&["run", "case.toml", "-o", "new.h5", "--plot", "dangling.svg"]);
    let told = message(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(
        told.contains("a link to nowhere.svg, which does not exist"),
        "{told}"
    );
    assert!(!fixture.path("new.h5").exists() && !fixture.path("nowhere.svg").exists());
    crate::support::part_files::no_part_file(&fixture.path("inside"));
}

/// Pages are written into a folder only.
#[test]
fn pages_do_not_take_the_place_of_a_file() {
    let fixture = Fixture::new();
    let before = fixture.content();
    for command in [&["models"][..], &["hysteresis"], &["gap", "--list"]] {
        let output = fixture.run(&[command, &["--pages", "case.toml"]].concat());
        let told = message(&output);
        assert_eq!(output.status.code(), Some(4), "{command:?}: {told}");
        assert!(
            told.contains("cannot write case.toml"),
            "{command:?}: {told}"
        );
        assert!(fixture.content() == before);
    }
}
