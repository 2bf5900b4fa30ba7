//! The documents of the repository hold together: links lead somewhere, no page is out of
//! reach, and paths that the source names are there.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().unwrap()
}

/// Files below `folder`, but for what is built, downloaded or hidden.
fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_file() {
            found.push(path);
        } else if name == ".github" || !(name.starts_with('.') || name == "target" || name == "out")
        {
            walk(&path, found);
        }
    }
}

fn files(ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    walk(&root(), &mut found);
    found.retain(|path| path.extension().is_some_and(|e| e == ending));
    found.sort();
    found
}

fn shown(path: &Path) -> String {
    let path = path.strip_prefix(root()).unwrap_or(path);
    path.display().to_string().replace('\\', "/")
}

/// The text of a page without its fenced blocks, in which brackets are code.
fn prose(page: &Path) -> String {
    let text = std::fs::read_to_string(page).unwrap();
    let mut fenced = false;
    let mut kept = String::new();
    for line in text.lines() {
        let fence = line.trim_start().starts_with("```");
        fenced ^= fence;
        if !fenced && !fence {
            kept.push_str(line);
            kept.push('\n');
        }
    }
    kept
}

/// Targets of the links and images of a page that lead into the repository: a path and the
/// heading in it, either of which may be empty.
fn links(page: &Path) -> Vec<(String, String)> {
    let text = prose(page);
    let targets = text
        .split("](")
        .skip(1)
        .map(|p| p.split(')').next().unwrap());
    let local = targets.filter(|t| !t.contains("://") && !t.starts_with("mailto:"));
    local
        .map(|target| {
            let (path, heading) = target.split_once('#').unwrap_or((target, ""));
            (path.to_owned(), heading.to_owned())
        })
        .collect()
}

/// Anchors of the headings of a page, as GitHub makes them.
fn anchors(page: &Path) -> BTreeSet<String> {
    let text = prose(page);
    let headings = text.lines().filter(|line| line.starts_with('#'));
    headings
        .map(|line| {
            let words = line.trim_start_matches('#').trim().to_lowercase();
            let kept = words
                .chars()
                .filter(|c| c.is_alphanumeric() || " -_".contains(*c));
            kept.map(|c| if c == ' ' { '-' } else { c }).collect()
        })
        .collect()
}

/// The file that a link of `page` leads to; a folder shows its `README.md`.
fn target(page: &Path, path: &str) -> Option<PathBuf> {
    if path.is_empty() {
        return Some(page.to_owned());
    }
    let there = page.parent().unwrap().join(path).canonicalize().ok()?;
    let readme = there.join("README.md");
    Some(if readme.exists() { readme } else { there })
}

#[test]
fn every_link_leads_somewhere() {
    let pages = files("md");
    assert!(pages.len() > 90, "{}", pages.len());
    let (mut checked, mut wrong) = (0, Vec::new());
    for page in &pages {
        for (path, heading) in links(page) {
            let there = target(page, &path);
            let found = there.is_some_and(|file| {
                heading.is_empty()
                    || file.extension().is_some_and(|e| e == "md")
                        && anchors(&file).contains(&heading)
            });
            checked += 1;
            if !found {
                wrong.push(format!("{}: {path}#{heading}", shown(page)));
            }
        }
    }
    assert!(checked > 300, "{checked}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn every_page_is_reached_from_the_readme() {
    let start = root().join("README.md");
    let mut reached = BTreeSet::from([start.clone()]);
    let mut next = vec![start];
    while let Some(page) = next.pop() {
        for (path, _) in links(&page) {
            if let Some(there) = target(&page, &path)
                && there.extension().is_some_and(|e| e == "md")
                && reached.insert(there.clone())
            {
                next.push(there);
            }
        }
    }
    let mut orphans: Vec<_> = files("md").iter().map(|page| shown(page)).collect();
    let reached: BTreeSet<_> = reached.iter().map(|page| shown(page)).collect();
    orphans.retain(|page| !reached.contains(page) && !page.starts_with(".github"));
    assert!(orphans.is_empty(), "no page leads to {orphans:#?}");
}

/// Messages, comments and descriptors name pages by their paths in the repository.
#[test]
fn pages_that_the_source_names_exist() {
    let mut named = BTreeMap::new();
    for file in files("rs") {
        let text = std::fs::read_to_string(&file).unwrap();
        for folder in ["tutorial", "how-to", "reference", "theory"] {
            for (at, start) in text.match_indices(&format!("docs/{folder}/")) {
                let rest = &text[at + start.len()..];
                let end = rest.find(|c: char| !(c.is_alphanumeric() || "-_./".contains(c)));
                let path = format!("{start}{}", &rest[..end.unwrap_or(rest.len())]);
                let path = path.trim_end_matches(['.', '/']).to_owned();
                named.entry(path).or_insert_with(|| shown(&file));
            }
        }
    }
    assert!(named.len() >= 5, "{named:?}");
    named.retain(|path, _| !root().join(path).exists());
    assert!(named.is_empty(), "no such page: {named:#?}");
}
