//! Every test belongs to a program that `cargo test` builds and runs: what is in a file to which
//! no `mod` line leads, or in a target without tests, would pass unseen.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::metadata;

/// All sources in a folder and those inside it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found
}

/// The modules that a text declares in files of their own.
fn modules(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        line.strip_prefix("mod ")?.strip_suffix(';')
    })
}

/// Adds a source, with modules in its folder, and all to which its `mod` lines lead.
fn reach(source: PathBuf, reached: &mut BTreeSet<PathBuf>) {
    let folder = source.parent().unwrap();
    for module in modules(&std::fs::read_to_string(&source).unwrap()) {
        let file = folder.join(format!("{module}.rs"));
        let inner = folder.join(module).join("mod.rs");
        reach(if file.exists() { file } else { inner }, reached);
    }
    reached.insert(source);
}

/// Whether a text has tests of its own.
fn tested(text: &str) -> bool {
    let starts = ["#[test]", "#[cfg(test)]", "proptest!"];
    text.lines()
        .any(|line| starts.iter().any(|s| line.trim_start().starts_with(s)))
}

/// Whether a text has an example in its documentation.
fn has_example(text: &str) -> bool {
    text.lines().any(|line| {
        let line = line.trim_start();
        let documentation = line.strip_prefix("///").or(line.strip_prefix("//!"));
        documentation.is_some_and(|l| l.trim_start().starts_with("```"))
    })
}

#[test]
fn every_test_is_run() {
    let declared = "mod a;\npub mod b;\nmod tests {\n    mod inner;\n// mod c;\n";
    assert!(modules(declared).eq(["a", "b"]));
    assert!(tested("x\n    #[test]\n") && !tested("// #[test]"));
    assert!(has_example("/// ```\n") && !has_example("// ```\n"));

    let metadata = metadata(&["--no-deps"]);
    let (mut files, mut without) = (0, 0);
    for package in metadata["packages"].as_array().unwrap() {
        let manifest = PathBuf::from(package["manifest_path"].as_str().unwrap());
        let folder = manifest.parent().unwrap();
        let mut reached = BTreeSet::new();
        for target in package["targets"].as_array().unwrap() {
            let source = PathBuf::from(target["src_path"].as_str().unwrap());
            if target["kind"][0] == "test" {
                assert_eq!(target["test"], true, "{source:?}");
                reach(source, &mut reached);
                continue;
            }
            // Of a program this takes the library beside it in, which is none the worse.
            let texts = sources(source.parent().unwrap());
            let texts = texts.iter().map(|s| std::fs::read_to_string(s).unwrap());
            let texts: Vec<String> = texts.collect();
            if target["kind"][0] == "lib" {
                let skipped = target["test"] == false;
                assert!(!skipped || !texts.iter().any(|t| tested(t)), "{source:?}");
                let skipped = target["doctest"] == false;
                let examples = texts.iter().any(|t| has_example(t));
                assert!(!skipped || !examples, "{source:?}");
                without += usize::from(skipped);
            } else if target["kind"][0] == "bin" && target["test"] == false {
                let beside = source.parent().unwrap().join("lib.rs").exists();
                let text = std::fs::read_to_string(&source).unwrap();
                let tests = tested(&text) || !beside && texts.iter().any(|t| tested(t));
                assert!(!tests, "{source:?}");
            }
        }
        for source in sources(&folder.join("tests")) {
            // The package `verification` is a folder `tests` itself.
            assert!(reached.contains(&source), "{source:?} is in no test");
            files += 1;
        }
    }
    assert!(files > 100, "{files}");
    assert!(without > 0);
}
