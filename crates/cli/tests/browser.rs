//! Pages in a browser: Chromium without a window, driven by `tests/python/open_pages.py`.
//!
//! `scripts/test` names interpreter and browser in `POUNDING_PYTHON` and `POUNDING_CHROMIUM`.
//! Where they are not named nothing can be opened: the pages are made all the same, and the
//! test says that they were not looked at.
#![allow(clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::{run, text};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Most that the page of a result may weigh (bytes).
const MOST: u64 = 5_000_000;

/// Opens pages, each with what it was made from.
fn open(pages: &[(PathBuf, PathBuf)]) {
    open_with(&[], pages);
}

fn open_with(options: &[&str], pages: &[(PathBuf, PathBuf)]) {
    let named = ["POUNDING_PYTHON", "POUNDING_CHROMIUM"].map(std::env::var_os);
    let [Some(python), Some(_)] = named else {
        eprintln!(
            "skipped: POUNDING_PYTHON or POUNDING_CHROMIUM names no program, no page was opened"
        );
        return;
    };
    let pairs = pages
        .iter()
        .map(|(page, source)| format!("{}={}", page.display(), source.display()));
    let output = Command::new(python)
        .arg(root().join("tests/python/open_pages.py"))
        .args(options)
        .args(pairs)
        .output()
        .unwrap();
    let told = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{told}");
    let seen = String::from_utf8_lossy(&output.stdout);
    eprintln!("{seen}");
    assert_eq!(seen.lines().count(), pages.len(), "{seen}");
}

/// The result of a case, and its page.
fn result_and_page(case: &Path, folder: &Path, name: &str) -> (PathBuf, PathBuf) {
    let [page, result] = ["html", "h5"].map(|end| folder.join(format!("{name}.{end}")));
    text(
        "run",
        &format!("{} -o {}", case.display(), result.display()),
    );
    text("report", &result.display().to_string());
    assert!(page.metadata().unwrap().len() < MOST, "{name}");
    (page, result)
}

/// Chains of storeys, links, levels between floors, plans, walls, velocity jumps.
#[test]
fn runs() {
    let folder = tempfile::tempdir().unwrap();
    let examples = [
        "three_storey_pair",
        "linked_pair",
        "slab_hits_column",
        "pair_that_turns",
        "isolated_building",
        "rigid_impacts",
        "wall_and_frame",
        "yielding_pair",
        "soil_pair",
    ];
    let pages = examples.map(|name| {
        let case = root().join("examples").join(name).join("case.toml");
        result_and_page(&case, folder.path(), name)
    });
    open(&pages);
}

/// Names that would end the script, and characters that end lines in JavaScript alone.
#[test]
fn names_stay_text() {
    let folder = tempfile::tempdir().unwrap();
    let source = root().join("examples/three_storey_pair/case.toml");
    let case = std::fs::read_to_string(source).unwrap();
    let motions = root().join("ground_motions").display().to_string();
    let case = case
        .replace("../../ground_motions", &motions)
        .replace(
            "Three-storey pair,",
            "</script><script>alert(1)</script><img src=x onerror=alert(2)> \\u2028 &amp;",
        )
        .replace("\"light\"", "\"<b onclick='x'>& | wall\"");
    let path = folder.path().join("case.toml");
    std::fs::write(&path, case).unwrap();
    let mut pages = vec![result_and_page(&path, folder.path(), "names")];
    for (command, options) in [
        ("gap", "--points 3"),
        ("compare", "--models linear_elastic,stereomechanical"),
    ] {
        let page = folder.path().join(format!("{command}.html"));
        let arguments = format!(
            "{} {options} --json --report {}",
            path.display(),
            page.display()
        );
        let answer = folder.path().join(format!("{command}.json"));
        std::fs::write(&answer, run(command, &arguments).stdout).unwrap();
        pages.push((page, answer));
    }
    open(&pages);
}

/// Twenty buildings of fifty storeys, and 1,500 impacts.
#[test]
fn towers() {
    let folder = tempfile::tempdir().unwrap();
    let mut case = "title = \"Twenty towers\"\n".to_owned();
    for i in 0..20 {
        case.push_str(&format!(
            "[[building]]\nname = \"tower {i}\"\nstoreys = 50\nmass = \"{} t\"\nstiffness = \"{} MN/m\"\n\
             height = \"3 m\"\ndamping = {{ ratio = 0.03, modes = [1, 3] }}\n",
            400 + (i * 37) % 200,
            700 + (i % 5) * 200,
        ));
    }
    for i in 1..20 {
        case.push_str(&format!(
            "[[gap]]\nbetween = [\"tower {}\", \"tower {i}\"]\nwidth = \"130 mm\"\n\
             model = \"anagnostopoulos_2004\"\nseparation = \"no_tension\"\nstiffness = \"2000 MN/m\"\n\
             restitution = 0.65\n",
            i - 1
        ));
    }
    let motion = root().join("ground_motions/kobe_1995_jma_ns.csv");
    case.push_str(&format!(
        "[ground_motion]\nfile = {:?}\n[analysis]\nduration = \"14 s\"\noutput_step = \"0.01 s\"\n",
        motion.display().to_string()
    ));
    let path = folder.path().join("case.toml");
    std::fs::write(&path, case).unwrap();
    let (page, result) = result_and_page(&path, folder.path(), "towers");
    let file = hdf5::File::open(&result).unwrap();
    let gaps = file.group("gap").unwrap().groups().unwrap();
    let impacts = gaps
        .iter()
        .map(|gap| gap.dataset("impacts").unwrap().size());
    let impacts: usize = impacts.sum();
    file.close().unwrap();
    assert!(impacts >= 1500, "{impacts}");
    open_with(&["--brief"], &[(page, result)]);
}

/// Pages of commands with many runs, each beside the object that the command prints, or the
/// result that it writes.
#[test]
fn studies() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let root = root();
    let case = root.join("examples/three_storey_pair/case.toml");
    let records = ["el_centro_1940_ns.csv", "kobe_1995_jma_ns.csv"];
    let records = records.map(|name| root.join("ground_motions").join(name));
    let records = records.map(|path| path.display().to_string()).join(" ");
    let case = case.display();
    let mut pages = Vec::new();
    for (name, command, arguments) in [
        (
            "gap",
            "gap",
            format!("{case} --points 12 --records {records}"),
        ),
        (
            "compare",
            "compare",
            format!(
                "{case} --models jankowski_2005,linear_elastic,stereomechanical --records {records}"
            ),
        ),
        ("motion", "motion", format!("info {records}")),
    ] {
        let page = at(&format!("{name}.html"));
        let file = at(&format!("{name}.file.json"));
        let arguments = format!("{arguments} --json -o {}", file.display());
        let output = run(command, &arguments);
        let told = String::from_utf8_lossy(&output.stderr);
        // The answer "too small" is exit code 1.
        assert!(matches!(output.status.code(), Some(0 | 1)), "{told}");
        let answer = at(&format!("{name}.json"));
        std::fs::write(&answer, output.stdout).unwrap();
        // Numbers of the page of the file are those that the command prints.
        text(
            "report",
            &format!("{} -o {}", file.display(), page.display()),
        );
        pages.push((page, answer));
    }
    let study = at("study.toml");
    let text_of_study =
        std::fs::read_to_string(root.join("examples/fragility_three_storey_pair/study.toml"));
    let examples = root.join("examples").display().to_string();
    let hazard = root.join("examples/fragility_three_storey_pair/hazard.csv");
    let text_of_study = text_of_study
        .unwrap()
        .replace(
            "../three_storey_pair",
            &format!("{examples}/three_storey_pair"),
        )
        .replace("hazard.csv", &hazard.display().to_string())
        .replace("count = 40", "count = 6");
    std::fs::write(&study, text_of_study).unwrap();
    let (page, result, answer) = (at("ida.html"), at("ida.h5"), at("ida.json"));
    let arguments = format!("{} -o {} --json", study.display(), result.display());
    let told = text("ida", &format!("{arguments} --report {}", page.display()));
    std::fs::write(&answer, told).unwrap();
    // The result gives the same page.
    let again = at("again.html");
    let arguments = format!("{} --study {}", result.display(), study.display());
    text("report", &format!("{arguments} -o {}", again.display()));
    let pages_of_ida = [&page, &again].map(|page| std::fs::read_to_string(page).unwrap());
    assert_eq!(pages_of_ida[0], pages_of_ida[1]);
    pages.push((page, answer));
    // Without the study the runs have a page.
    text("report", &result.display().to_string());
    let runs = at("runs.html");
    std::fs::rename(at("ida.html"), &runs).unwrap();
    std::fs::write(at("ida.html"), &pages_of_ida[0]).unwrap();
    pages.push((runs, result));
    open(&pages);
}

/// A study that is not that of the result, and a study for a run.
#[test]
fn the_study_is_that_of_the_result() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let examples = root().join("examples");
    let study = |name: &str| examples.join(name).join("study.toml").display().to_string();
    let refused = |arguments: &str, word: &str| {
        let output = run("report", arguments);
        let told = String::from_utf8_lossy(&output.stderr).replace("\n  │ ", " ");
        assert_eq!(output.status.code(), Some(2), "{told}");
        assert!(told.contains(word), "{told}");
    };
    let case = examples.join("three_storey_pair/case.toml");
    text("run", &format!("{} -o {}", case.display(), at("run.h5")));
    let fragility = study("fragility_three_storey_pair");
    refused(
        &format!("{} --study {fragility}", at("run.h5")),
        "result of a run, not of a study",
    );
    text("ida", &format!("{fragility} -o {}", at("ida.h5")));
    let other = study("sweep_three_storey_pair");
    refused(
        &format!("{} --study {other}", at("ida.h5")),
        "is not the study that the result is of",
    );
}
