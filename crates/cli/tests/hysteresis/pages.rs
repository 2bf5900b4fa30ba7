//! The pages of the laws are what the code says, and what they tell users to type works.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

use pounding_hysteresis::descriptors;

const REMEDY: &str = "run `cargo run --release --bin pounding -- hysteresis --pages docs/reference/hysteresis`, look at the difference and commit it";

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/hysteresis")
}

fn pounding() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command.env("NO_COLOR", "1");
    command
}

fn succeeds(command: &mut Command, what: &str) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what}: {errors}");
    String::from_utf8(output.stdout).unwrap()
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

fn page(law: &str) -> String {
    read(&committed(), &format!("{law}.md"))
}

/// Pages and figures, to the last character.
#[test]
fn committed_pages_are_what_the_code_says() {
    let folder = tempfile::tempdir().unwrap();
    let fresh = folder.path().join("pages");
    succeeds(
        pounding().args(["hysteresis", "--pages"]).arg(&fresh),
        "pages",
    );
    let (made, kept) = (files(&fresh), files(&committed()));
    assert_eq!(made, kept, "{REMEDY}");
    for name in &made {
        let (new, old) = (read(&fresh, name), read(&committed(), name));
        let line = new.lines().zip(old.lines()).position(|(a, b)| a != b);
        assert!(
            new == old,
            "docs/reference/hysteresis/{name} differs from line {} on; {REMEDY}",
            1 + line.unwrap_or_else(|| new.lines().count().min(old.lines().count()))
        );
    }
}

#[test]
fn every_law_has_its_page_and_figure() {
    let index = page("README");
    let mut wanted = BTreeSet::from(["README.md".to_owned()]);
    for law in descriptors() {
        wanted.insert(format!("{}.md", law.name));
        wanted.insert(format!("{}.svg", law.name));
        assert!(index.contains(&format!("]({}.md)", law.name)), "{REMEDY}");
        assert!(page(law.name).contains(&format!("]({}.svg)", law.name)));
    }
    assert_eq!(wanted, files(&committed()), "{REMEDY}");
}

/// The fenced blocks of this language on a page.
fn blocks<'a>(page: &'a str, language: &str) -> Vec<&'a str> {
    let parts = page
        .split(&format!("```{language}\n"))
        .skip(1)
        .collect::<Vec<_>>();
    parts
        .iter()
        .map(|p| p.split_once("```").unwrap().0)
        .collect()
}

fn building(name: &str) -> String {
    format!(
        "[[building]]\nname = \"{name}\"\nstoreys = 2\nmass = \"25 t\"\nstiffness = \"3.46 MN/m\"\nheight = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\n"
    )
}

/// Storeys and links as on the pages, and that each law is the one that is understood.
#[test]
fn the_case_files_of_the_pages_are_accepted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let motion = committed().join("../../../ground_motions/el_centro_1940_ns.csv");
    let motion = format!(
        "[ground_motion]\nfile = {:?}\n",
        motion.canonicalize().unwrap()
    );
    let mut storeys = 0;
    for law in descriptors() {
        let page = page(law.name);
        let blocks = blocks(&page, "toml");
        let (left, link) = match blocks[..] {
            [storey, link] => (storey.to_owned(), link),
            [link] => (building("left"), link),
            _ => panic!("{}", law.name),
        };
        let right = building("right");
        std::fs::write(&file, format!("{left}{right}{link}{motion}")).unwrap();
        let shown = succeeds(pounding().args(["check", "--json"]).arg(&file), law.name);
        let understood: serde_json::Value = serde_json::from_str(&shown).unwrap();
        for level in understood["links"][0]["laws"].as_array().unwrap() {
            assert_eq!(level, law.name);
        }
        if blocks.len() == 2 {
            storeys += 1;
            let laws = &understood["buildings"][0]["laws"];
            assert_eq!(*laws, serde_json::json!([law.name, law.name]));
        }
    }
    assert!(storeys >= 15, "{storeys}");
}

/// The case of the guide is accepted.
#[test]
fn the_guide_says_what_works() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let guide = read(&committed().join(".."), "yielding-storeys-and-links.md");
    let motion = committed().join("../../../ground_motions/el_centro_1940_ns.csv");
    let motion = motion.canonicalize().unwrap();
    let case = blocks(&guide, "toml")[0];
    std::fs::write(&file, format!("{case}[ground_motion]\nfile = {motion:?}\n")).unwrap();
    let shown = succeeds(pounding().arg("check").arg(&file), "guide");
    for part in [
        "storey 2: law bilinear",
        "P-Delta",
        "Link dampers",
        "viscous_damper",
    ] {
        assert!(shown.contains(part), "{shown}");
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

/// The command on a page gives the numbers on the page.
#[test]
fn the_commands_of_the_pages_give_their_tables() {
    let folder = tempfile::tempdir().unwrap();
    for law in descriptors() {
        let page = page(law.name);
        let words = words(blocks(&page, "sh")[0]);
        assert_eq!(words[0], "pounding");
        let mut command = pounding();
        command.args(&words[1..]).current_dir(folder.path());
        let shown = succeeds(&mut command, law.name);
        assert!(!shown.contains("from the example"), "{shown}");
        let cells =
            |line: &str| -> Vec<String> { line.split('|').map(|c| c.trim().to_owned()).collect() };
        let rows = |text: &str, first: &str| -> Vec<Vec<String>> {
            let start = text.find(first).unwrap();
            let lines = text[start..].lines().filter(|l| l.starts_with('|'));
            let numbers = |row: &Vec<String>| row.iter().any(|c| c.parse::<f64>().is_ok());
            lines.map(cells).filter(numbers).collect()
        };
        let of_page = rows(&page, "Each cycle");
        let of_command = rows(&shown, "Full cycles");
        assert_eq!((of_page.len(), of_command.len()), (4, 4), "{}", law.name);
        for (a, b) in of_page.iter().zip(&of_command) {
            // The command numbers its cycles.
            assert_eq!(a[1..7], b[2..8], "{}", law.name);
        }
        assert!(folder.path().join(format!("{}.csv", law.name)).exists());
        let figure = std::fs::read_to_string(folder.path().join(format!("{}.svg", law.name)));
        assert!(page.contains(&format!("{}.svg", law.name)) && figure.unwrap().contains("</svg>"));
    }
}
