//! The pages of the impact models are what the code says, and what they tell users
//! to type works.
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use pounding_gap_element::{ModelDescriptor, registry};

const REMEDY: &str = "run `cargo run --release --bin pounding -- models --pages docs/reference/models`, look at the difference and commit it";

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/models")
}

fn pounding() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command.env("NO_COLOR", "1");
    command
}

fn succeeds(command: &mut Command, what: &str) {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what}: {errors}");
}

fn files(folder: &Path) -> BTreeSet<String> {
    std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

fn read(folder: &Path, name: &str) -> String {
    std::fs::read_to_string(folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}; {REMEDY}"))
}

/// A law without compliance has no force to draw.
fn has_figure(d: &ModelDescriptor) -> bool {
    let model = registry::build(d.name, &d.example_parameters(0.65)).unwrap();
    model.rigid_restitution().is_none()
}

/// Pages and figures, to the last character: figures too, as their coordinates are
/// whole pixels, far coarser than any machine's round-off.
#[test]
fn committed_pages_are_what_the_code_says() {
    let folder = tempfile::tempdir().unwrap();
    let fresh = folder.path().join("pages");
    succeeds(pounding().args(["models", "--pages"]).arg(&fresh), "pages");
    let (made, kept) = (files(&fresh), files(&committed()));
    let stale: Vec<_> = kept.difference(&made).collect();
    assert!(
        stale.is_empty(),
        "no model makes these files of docs/reference/models, remove them: {stale:?}"
    );
    for name in &made {
        let (new, old) = (read(&fresh, name), read(&committed(), name));
        let line = new.lines().zip(old.lines()).position(|(a, b)| a != b);
        assert!(
            new == old,
            "docs/reference/models/{name} differs from line {} on; {REMEDY}",
            1 + line.unwrap_or_else(|| new.lines().count().min(old.lines().count()))
        );
    }
}

#[test]
fn every_registered_model_has_its_page_and_figure() {
    let folder = committed();
    let index = read(&folder, "README.md");
    let mut wanted = BTreeSet::from(["README.md".to_owned()]);
    for d in registry::descriptors() {
        wanted.insert(format!("{}.md", d.name));
        if has_figure(d) {
            wanted.insert(format!("{}.svg", d.name));
        }
        assert!(index.contains(&format!("]({}.md)", d.name)), "{REMEDY}");
    }
    assert_eq!(wanted, files(&folder), "{REMEDY}");
    for name in wanted {
        let size = std::fs::metadata(folder.join(&name)).unwrap().len();
        assert!(size < 60_000, "{name} has {size} bytes");
    }
}

/// The fenced block of this language on a page.
fn block<'a>(page: &'a str, language: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

const BUILDING: &str = r#"
storeys = 1
mass = "25 t"
stiffness = "3.46 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
"#;

/// A case around the gap of a page.
fn case(gap: &str) -> String {
    let motion = committed().join("../../../ground_motions/el_centro_1940_ns.csv");
    let motion = motion.canonicalize().unwrap();
    format!(
        "[[building]]\nname = \"left\"{BUILDING}[[building]]\nname = \"right\"{BUILDING}{gap}[ground_motion]\nfile = {motion:?}\n"
    )
}

#[test]
fn the_case_files_of_the_pages_are_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    for d in registry::descriptors() {
        let page = read(&committed(), &format!("{}.md", d.name));
        let gap = block(&page, "toml");
        // The default separation rule, and each that the page shows instead.
        let others = gap.lines().filter(|line| line.starts_with("# separation"));
        let mut gaps = vec![gap.to_owned()];
        gaps.extend(others.map(|line| gap.replace(line, line.trim_start_matches("# "))));
        assert_eq!(gaps.len(), d.separation_rules.len(), "{}", d.name);
        for gap in gaps {
            std::fs::write(&file, case(&gap)).unwrap();
            succeeds(pounding().arg("check").arg(&file), &gap);
        }
    }
}

/// The case file takes a key that resembles one of the gap's own for a slip.
#[test]
fn no_parameter_is_mistaken_for_a_key_of_the_gap() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let mut tried = BTreeSet::new();
    for d in registry::descriptors() {
        for p in d.parameters.iter().filter(|p| tried.insert(p.name)) {
            let gap = format!(
                "[[gap]]\nbetween = [\"left\", \"right\"]\nwidth = \"20 mm\"\nmodel = \"{}\"\n{} = 0.5\n",
                d.name, p.name
            );
            std::fs::write(&file, case(&gap)).unwrap();
            let output = pounding().arg("check").arg(&file).output().unwrap();
            let errors = String::from_utf8_lossy(&output.stderr);
            assert!(!errors.contains("unknown key"), "{}: {errors}", p.name);
        }
    }
}

/// Words of a line as a shell takes them apart, quotes being double.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.replace("\\\n", " ").trim().chars() {
        match c {
            '"' => quoted = !quoted,
            c if c.is_whitespace() && !quoted => words.push(String::new()),
            c => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn the_commands_of_the_pages_run() {
    for d in registry::descriptors() {
        let page = read(&committed(), &format!("{}.md", d.name));
        let words = words(block(&page, "sh"));
        assert_eq!(words[0], "pounding");
        succeeds(pounding().args(&words[1..]), d.name);
        if d.takes_restitution() {
            succeeds(pounding().args(&words[1..]).arg("--table"), d.name);
        }
    }
}

/// The hand-kept table of contact-laws.md says what the pages say.
#[test]
fn the_theory_quotes_the_pages() {
    let cells = |line: &str| -> Vec<String> {
        let cells = line.split('|').map(|cell| cell.trim().to_owned());
        cells.collect()
    };
    let mut compared = 0;
    for line in read(&committed().join("../../theory"), "contact-laws.md").lines() {
        let row = cells(line);
        let numbers: Vec<f64> = row.iter().filter_map(|c| c.parse().ok()).collect();
        let (Some((_, rest)), 3) = (line.split_once("](../reference/models/"), numbers.len())
        else {
            continue;
        };
        let page = read(&committed(), rest.split(')').next().unwrap());
        let achieved = page
            .lines()
            .find(|l| l.starts_with("| achieved restitution"));
        for (quoted, said) in row[2..5].iter().zip(&cells(achieved.unwrap())[2..5]) {
            let said: f64 = said.parse().unwrap();
            assert_eq!(*quoted, format!("{said:.4}"), "{line}");
            compared += 1;
        }
    }
    assert!(compared >= 30, "{compared}");
}
