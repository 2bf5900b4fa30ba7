//! The book of this repository.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use book::{Entry, Parts, build, outline};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .canonicalize()
        .unwrap()
}

fn html(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            html(&path, found);
        } else if path.extension().is_some_and(|e| e == "html") {
            found.push(path);
        }
    }
}

/// Values of an attribute.
fn values<'t>(text: &'t str, attribute: &str) -> Vec<&'t str> {
    let start = format!(" {attribute}=\"");
    text.split(start.as_str())
        .skip(1)
        .map(|rest| rest.split('"').next().unwrap())
        .collect()
}

/// Every page of the documentation is a chapter, once, in the order of the index.
#[test]
fn every_page_is_a_chapter() {
    let entries = outline(&root()).unwrap();
    let mut seen = BTreeSet::new();
    let mut parts = Vec::new();
    for entry in &entries {
        match entry {
            Entry::Part(title) => parts.push(title.as_str()),
            Entry::Page { path, title, .. } => {
                assert!(!title.is_empty(), "{}", path.display());
                assert!(seen.insert(path.clone()), "{} twice", path.display());
            }
        }
    }
    assert_eq!(parts[..4], ["Tutorial", "How to", "Reference", "Theory"]);
    let docs = root().join("docs");
    let mut open = vec![docs];
    while let Some(folder) = open.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|e| e == "md") {
                let path = path.strip_prefix(root()).unwrap();
                assert!(seen.contains(path), "{} is no chapter", path.display());
            }
        }
    }
}

/// No link of the book is dead, and it fetches nothing.
#[test]
fn links_lead_somewhere() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("book");
    // Stands for the page of `pounding explore`.
    let explorer = folder.path().join("page.html");
    std::fs::write(&explorer, "<!DOCTYPE html>").unwrap();
    let parts = Parts {
        explorer: Some(&explorer),
        ..Parts::default()
    };
    build(&root(), &output, &parts).unwrap();
    let front = std::fs::read_to_string(output.join("index.html")).unwrap();
    assert!(front.contains("<iframe src=\"explorer.html\""));
    let mut pages = Vec::new();
    html(&output, &mut pages);
    assert!(pages.len() > 100, "{}", pages.len());
    let (mut checked, mut wrong) = (0, Vec::new());
    for page in &pages {
        // The page of errors stands for pages at any depth.
        if page.ends_with("404.html") {
            continue;
        }
        let text = std::fs::read_to_string(page).unwrap();
        let fetched = values(&text, "src");
        let links = values(&text, "href");
        for value in fetched.iter().filter(|v| v.contains("//")) {
            wrong.push(format!("{}: {value} is fetched", page.display()));
        }
        for value in fetched.into_iter().chain(links) {
            let (path, heading) = value.split_once('#').unwrap_or((value, ""));
            if path.contains("://") || path.starts_with("mailto:") || path.starts_with("data:") {
                continue;
            }
            checked += 1;
            let there = match path {
                "" => page.clone(),
                path => page.parent().unwrap().join(path),
            };
            let found = there.is_file()
                && (heading.is_empty() || {
                    let other = std::fs::read_to_string(&there).unwrap();
                    values(&other, "id").contains(&heading)
                });
            if !found {
                wrong.push(format!(
                    "{}: {value}",
                    page.strip_prefix(&output).unwrap().display()
                ));
            }
        }
    }
    assert!(checked > 2000, "{checked}");
    wrong.sort();
    wrong.dedup();
    assert!(wrong.is_empty(), "{} of {checked}: {wrong:#?}", wrong.len());
    // Words are found in the book itself.
    let index = std::fs::read_dir(&output).unwrap();
    let names = index.map(|f| f.unwrap().file_name().into_string().unwrap());
    assert!(names.into_iter().any(|n| n.starts_with("searchindex")));
}
