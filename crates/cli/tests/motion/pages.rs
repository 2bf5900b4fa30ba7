//! The page `docs/reference/ground-motions.md`: its commands run as printed, in their order, and
//! print what the page shows but for digits.

use super::*;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Commands of a page with what is printed below them.
fn sessions(page: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    for block in page.split("```text\n$ ").skip(1) {
        let (block, _) = block.split_once("```").unwrap();
        let block = block.replace("\\\n", " ");
        let (command, shown) = block.split_once('\n').unwrap();
        found.push((command.to_owned(), shown.to_owned()));
    }
    found
}

/// Words of a command line; quotes hold words together.
fn words(command: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (i, part) in command.split('"').enumerate() {
        if i % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// Words and signs without digits: last digits may differ between machines.
fn outline(text: &str) -> Vec<String> {
    let plain = text.replace(['|', '-', '+', '='], " ");
    let number = |word: &str| word.trim_matches(',').parse::<f64>().is_ok();
    plain
        .split_whitespace()
        .filter(|word| !number(word) && !word.starts_with("e-"))
        .map(str::to_owned)
        .collect()
}

#[test]
fn commands_of_the_page_run_as_printed() {
    let page = std::fs::read_to_string(root().join("docs/reference/ground-motions.md")).unwrap();
    let folder = Folder::new();
    std::fs::create_dir(folder.path("ground_motions")).unwrap();
    let record = "ground_motions/el_centro_1940_ns.csv";
    std::fs::copy(root().join(record), folder.path(record)).unwrap();
    let sessions = sessions(&page);
    assert_eq!(sessions.len(), 7);
    for (command, shown) in sessions {
        let words = words(&command);
        assert_eq!(words[..2], ["pounding", "motion"], "{command}");
        let output = Command::new(env!("CARGO_BIN_EXE_pounding"))
            .env("NO_COLOR", "1")
            .current_dir(folder.path("."))
            .args(&words[1..])
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{command}: {errors}");
        let printed = String::from_utf8(output.stdout).unwrap();
        assert_eq!(outline(&printed), outline(&shown), "{command}\n{printed}");
    }
}
