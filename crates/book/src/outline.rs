//! Parts and chapters.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};

use crate::error::BookError;

/// The page that lists all others.
const INDEX: &str = "docs/README.md";
/// The page that comes first.
const FRONT: &str = "README.md";

/// A line of the table of contents.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Entry {
    /// The heading of a part.
    Part(String),
    /// A page by its path from the root of the repository.
    Page {
        /// Path.
        path: PathBuf,
        /// Title.
        title: String,
        /// How many pages it stands below.
        depth: usize,
    },
}

/// What stands on a page, as far as a table of contents wants it.
pub(crate) struct Content {
    /// The first heading.
    pub(crate) title: String,
    /// Headings of the second level, each with the links below it; links before them have an
    /// empty one.
    sections: Vec<(String, Vec<String>)>,
}

impl Content {
    /// Of a page.
    pub(crate) fn read(root: &Path, page: &Path) -> Result<Self, BookError> {
        let text = std::fs::read_to_string(root.join(page)).map_err(|error| BookError::Page {
            page: page.to_owned(),
            error,
        })?;
        let mut content = Self {
            title: String::new(),
            sections: vec![(String::new(), Vec::new())],
        };
        let mut heading: Option<(HeadingLevel, String)> = None;
        for event in Parser::new_ext(&text, Options::ENABLE_TABLES) {
            match event {
                Event::Start(Tag::Heading { level, .. }) => heading = Some((level, String::new())),
                Event::Text(words) | Event::Code(words) => {
                    if let Some((_, text)) = &mut heading {
                        text.push_str(&words);
                    }
                }
                Event::End(TagEnd::Heading(_)) => match heading.take() {
                    Some((HeadingLevel::H1, text)) if content.title.is_empty() => {
                        content.title = text;
                    }
                    Some((HeadingLevel::H2, text)) => content.sections.push((text, Vec::new())),
                    _ => {}
                },
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    if let Some((_, links)) = content.sections.last_mut() {
                        links.push(dest_url.into_string());
                    }
                }
                _ => {}
            }
        }
        Ok(content)
    }

    /// All links.
    pub(crate) fn links(&self) -> impl Iterator<Item = &str> {
        self.sections
            .iter()
            .flat_map(|(_, links)| links.iter().map(String::as_str))
    }
}

/// The file of the repository to which a link of a page leads: from the root, without `..`. A
/// folder is its `README.md`, if it has one. `None` for what leads elsewhere.
pub(crate) fn target(root: &Path, page: &Path, link: &str) -> Option<PathBuf> {
    let path = link.split('#').next().unwrap_or_default();
    if path.is_empty() || path.contains("://") || path.starts_with("mailto:") {
        return None;
    }
    let mut whole = PathBuf::new();
    for part in folder(page).join(path).components() {
        match part {
            Component::ParentDir => whole = whole.parent()?.to_owned(),
            Component::Normal(name) => whole.push(name),
            _ => {}
        }
    }
    if root.join(&whole).is_dir() {
        whole.push("README.md");
    }
    root.join(&whole).is_file().then_some(whole)
}

fn is_page(path: &Path) -> bool {
    path.extension().is_some_and(|e| e == "md")
}

/// Pages to which a page links, in the order of its links.
fn pages(root: &Path, page: &Path, links: &[String]) -> Vec<PathBuf> {
    let targets = links.iter().filter_map(|link| target(root, page, link));
    targets.filter(|t| is_page(t)).collect()
}

/// Pages that the `README.md` of a folder above them names, but for those of the root and of the
/// documentation: they stand below it, and not below others that name them before.
fn claimed(root: &Path, listed: &BTreeSet<PathBuf>) -> Result<BTreeSet<PathBuf>, BookError> {
    let mut claimed = BTreeSet::new();
    let general = [Path::new(FRONT), Path::new(INDEX)];
    let indices = listed.iter().filter(|page| page.ends_with("README.md"));
    for index in indices.filter(|page| !general.contains(&page.as_path())) {
        let links: Vec<String> = Content::read(root, index)?
            .links()
            .map(str::to_owned)
            .collect();
        let below = pages(root, index, &links).into_iter();
        claimed.extend(below.filter(|page| page.starts_with(folder(index))));
    }
    Ok(claimed)
}

fn folder(page: &Path) -> &Path {
    page.parent().unwrap_or(Path::new(""))
}

struct Outline<'r> {
    root: &'r Path,
    /// Pages that the index lists, and those that stand below the index of their folder.
    listed: BTreeSet<PathBuf>,
    claimed: BTreeSet<PathBuf>,
    entries: Vec<Entry>,
    placed: BTreeSet<PathBuf>,
}

impl Outline<'_> {
    /// Adds a page, and below it those that only it names.
    fn add(&mut self, path: PathBuf, depth: usize) -> Result<(), BookError> {
        if !self.placed.insert(path.clone()) {
            return Ok(());
        }
        let content = Content::read(self.root, &path)?;
        let links: Vec<String> = content.links().map(str::to_owned).collect();
        let mut further = pages(self.root, &path, &links);
        let is_index = path.ends_with("README.md");
        further.retain(|page| {
            let ours = is_index && page.starts_with(folder(&path));
            !self.listed.contains(page) && (ours || !self.claimed.contains(page))
        });
        self.entries.push(Entry::Page {
            path,
            title: content.title,
            depth,
        });
        for page in further {
            self.add(page, depth + 1)?;
        }
        Ok(())
    }
}

/// Parts and pages of the book of the repository at `root`, in their order.
///
/// # Errors
/// A page that cannot be read.
pub fn outline(root: &Path) -> Result<Vec<Entry>, BookError> {
    let (front, index) = (PathBuf::from(FRONT), PathBuf::from(INDEX));
    let content = Content::read(root, &index)?;
    let sections: Vec<(String, Vec<PathBuf>)> = content
        .sections
        .iter()
        .map(|(heading, links)| (heading.clone(), pages(root, &index, links)))
        .collect();
    let all = sections.iter().flat_map(|(_, pages)| pages.iter().cloned());
    let mut listed: BTreeSet<PathBuf> = all.collect();
    listed.extend([front.clone(), index.clone()]);
    let mut outline = Outline {
        root,
        claimed: claimed(root, &listed)?,
        listed,
        entries: Vec::new(),
        placed: BTreeSet::new(),
    };
    outline.add(front, 0)?;
    outline.add(index, 0)?;
    for (heading, pages) in sections {
        if !heading.is_empty() && !pages.is_empty() {
            outline.entries.push(Entry::Part(heading));
        }
        for page in pages {
            outline.add(page, 0)?;
        }
    }
    Ok(outline.entries)
}
