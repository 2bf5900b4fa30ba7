//! The folder that the book is made of: pages and what they link to, at their places of the
//! repository.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::Parts;
use crate::error::BookError;
use crate::formulas::rendered;
use crate::outline::{Content, Entry, outline, target};

/// Where the documentation of the crates goes.
pub(crate) const CRATES: &str = "crates";
/// Where the page that computes goes.
pub(crate) const EXPLORER: &str = "explorer.html";
/// The page that leads to the crates.
const PAGE_OF_CRATES: &str = "crates.md";

/// Puts the sources of the book into `stage`.
pub(crate) fn stage(root: &Path, stage: &Path, parts: &Parts<'_>) -> Result<(), BookError> {
    let source = stage.join("src");
    let mut summary = String::from("# Summary\n");
    for entry in outline(root)? {
        match entry {
            Entry::Part(title) => {
                let _ = write!(summary, "\n# {title}\n\n");
            }
            Entry::Page { path, title, depth } => {
                let indent = "  ".repeat(depth);
                let _ = writeln!(summary, "{indent}- [{title}]({})", path.display());
                page(root, &source, &path)?;
            }
        }
    }
    if parts.explorer.is_some() {
        let front = source.join("README.md");
        let text = std::fs::read_to_string(&front)?;
        std::fs::write(front, with_explorer(&text))?;
    }
    if parts.crates.is_some() {
        let _ = write!(summary, "\n- [The crates]({PAGE_OF_CRATES})\n");
        std::fs::write(source.join(PAGE_OF_CRATES), page_of_crates(root)?)?;
    }
    std::fs::write(source.join("SUMMARY.md"), summary)?;
    Ok(())
}

/// A page with its links to folders made links to files, and the files that it links to.
fn page(root: &Path, source: &Path, path: &Path) -> Result<(), BookError> {
    let mut text = std::fs::read_to_string(root.join(path))?;
    let content = Content::read(root, path)?;
    for link in content.links() {
        let Some(file) = target(root, path, link) else {
            continue;
        };
        let bare = link.split('#').next().unwrap_or_default();
        if file.ends_with("README.md") && !bare.ends_with("README.md") {
            let whole = format!("{}/README.md", bare.trim_end_matches('/'));
            text = text.replace(&format!("]({bare}"), &format!("]({whole}"));
        }
        if file.extension().is_none_or(|e| e != "md") {
            copy_file(&root.join(&file), &source.join(&file))?;
        }
    }
    let to = source.join(path);
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(to, rendered(path, &text)?)?;
    Ok(())
}

/// The front page with the page that computes before its second heading.
fn with_explorer(text: &str) -> String {
    let (before, after) = text.split_once("\n## ").unwrap_or((text, ""));
    let frame = format!(
        "<iframe src=\"{EXPLORER}\" title=\"Drag the gap of two three-storey buildings\" style=\"width:100%;height:60rem;border:1px solid #ccc\" loading=\"lazy\"></iframe>"
    );
    format!(
        "{before}\n## Drag the gap\n\nThe solver in the page: [on a page of its own]({EXPLORER}).\n\n{frame}\n\n## {after}"
    )
}

/// What each crate is for, as CONTRIBUTING says, with a link to its documentation.
fn page_of_crates(root: &Path) -> Result<String, BookError> {
    let text = std::fs::read_to_string(root.join("CONTRIBUTING.md"))?;
    let mut page = String::from("# The crates\n\n| crate | purpose |\n|---|---|\n");
    for row in text.lines().filter_map(|l| l.strip_prefix("| `crates/")) {
        let Some((folder, purpose)) = row.split_once("` |") else {
            continue;
        };
        let manifest =
            std::fs::read_to_string(root.join("crates").join(folder).join("Cargo.toml"))?;
        let name = manifest.lines().find_map(|l| l.strip_prefix("name = \""));
        let name = name.and_then(|n| n.split('"').next()).unwrap_or(folder);
        let module = name.replace('-', "_");
        let purpose = purpose.trim_end_matches('|').trim();
        let _ = writeln!(
            page,
            "| [{name}]({CRATES}/{module}/index.html) | {purpose} |"
        );
    }
    Ok(page)
}

fn copy_file(from: &Path, to: &Path) -> Result<(), BookError> {
    if let Some(folder) = to.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::copy(from, to)?;
    Ok(())
}

/// Copies a folder.
pub(crate) fn copy(from: &Path, to: &Path) -> Result<(), BookError> {
    let mut open: Vec<PathBuf> = vec![PathBuf::new()];
    while let Some(folder) = open.pop() {
        std::fs::create_dir_all(to.join(&folder))?;
        for entry in std::fs::read_dir(from.join(&folder))? {
            let entry = entry?;
            let path = folder.join(entry.file_name());
            match entry.file_type()?.is_dir() {
                true => open.push(path),
                false => copy_file(&from.join(&path), &to.join(&path))?,
            }
        }
    }
    Ok(())
}
