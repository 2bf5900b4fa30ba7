//! The documents of the repository are true: links lead somewhere, no page is out of
//! reach, paths that the source names are there, and commands, keys and numbers are those of the program.
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use pounding_ground_motion::Format;
use pounding_ground_motion::generators::GENERATORS;
use serde_json::Value;

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

/// A path from the root of the repository that stands between backquotes is there; `doe_2026` is whoever adds a model.
#[test]
fn files_that_pages_name_are_there() {
    let (mut checked, mut wrong) = (0, Vec::new());
    for page in files("md") {
        let text = std::fs::read_to_string(&page).unwrap();
        for path in text.split('`').skip(1).step_by(2) {
            let is_path = path
                .chars()
                .all(|c| c.is_ascii_alphanumeric() || "_-./".contains(c));
            if !(path.starts_with("crates/") && is_path) || path.contains("doe_2026") {
                continue;
            }
            checked += 1;
            if !root().join(path).exists() {
                wrong.push(format!("{}: {path}", shown(&page)));
            }
        }
    }
    assert!(checked > 30, "{checked}");
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

fn page(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap()
}

/// The fenced block of this language on a page.
fn block<'a>(page: &'a str, language: &str) -> &'a str {
    let (_, rest) = page.split_once(&format!("```{language}\n")).unwrap();
    rest.split_once("```").unwrap().0
}

fn pounding() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_pounding"));
    command.env("NO_COLOR", "1").env("COLUMNS", "300");
    command.current_dir(root());
    command
}

fn printed(command: &mut Command, what: &str) -> String {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{what}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// The README is a page, and what it shows is what its command prints.
#[test]
fn the_readme() {
    let readme = page("README.md");
    let words = readme.split_whitespace().count();
    assert!(words < 400, "{words} words");
    let (_, command) = block(&readme, "sh")
        .split_once("--bin pounding -- ")
        .unwrap();
    let folder = tempfile::tempdir().unwrap();
    let figure = folder.path().join("pair.svg");
    let words: Vec<&str> = command.split_whitespace().collect();
    let [run, case, "--plot", "pair.svg"] = words[..] else {
        panic!("{words:?}");
    };
    let shown = printed(
        pounding()
            .args([run, case, "--no-output", "--plot"])
            .arg(&figure),
        command,
    );
    assert!(figure.exists());
    let lines: Vec<&str> = block(&readme, "text")
        .lines()
        .filter(|l| *l != "...")
        .collect();
    assert!(lines.len() >= 3, "{lines:?}");
    for line in lines {
        assert!(shown.lines().any(|l| l == line), "{line}\n{shown}");
    }
}

#[test]
fn every_command_has_its_line() {
    let page = page("docs/reference/commands.md");
    let rows: Vec<&str> = page
        .lines()
        .filter(|l| l.starts_with("| `pounding"))
        .collect();
    let names = |text: &str, name: &str| {
        text.split(|c: char| !(c.is_alphanumeric() || "-_".contains(c)))
            .any(|word| word == name)
    };
    for command in pounding_cli::command().get_subcommands() {
        let start = format!("`pounding {}", command.get_name());
        let of_it: Vec<_> = rows.iter().filter(|row| row.contains(&start)).collect();
        assert!(!of_it.is_empty(), "{start}");
        for inner in command.get_subcommands() {
            let named = of_it.iter().any(|row| names(row, inner.get_name()));
            assert!(named, "{start} {}", inner.get_name());
        }
    }
}

/// Keys of a part of the JSON Schema, and of all parts in it.
fn keys(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(map) => {
            if let Some(Value::Object(properties)) = map.get("properties") {
                found.extend(properties.keys().cloned());
            }
            map.values().for_each(|value| keys(value, found));
        }
        Value::Array(values) => values.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

/// The keys of the schemas that stand on none of these pages of the reference.
fn undocumented(schemas: &[&str], pages: &[&str]) -> (usize, BTreeSet<String>) {
    let mut found = BTreeSet::new();
    for file in schemas {
        let schema = printed(pounding().args(["schema", file]), file);
        keys(&serde_json::from_str(&schema).unwrap(), &mut found);
    }
    let pages = pages
        .iter()
        .map(|name| page(&format!("docs/reference/{name}.md")));
    let pages: String = pages.collect();
    let named: BTreeSet<&str> = pages
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .collect();
    let all = found.len();
    found.retain(|key| !named.contains(key.as_str()));
    (all, found)
}

#[test]
fn every_key_of_the_input_files_is_documented() {
    let of_case = [
        "case-file",
        "ground-motions",
        "yielding-storeys-and-links",
        "gap-check",
        "own-rules",
    ];
    let (all, lost) = undocumented(&["case"], &of_case);
    assert!(
        all > 80 && lost.is_empty(),
        "of {all}, no page names {lost:?}"
    );
    let of_study = ["studies", "ground-motions", "case-file"];
    let (all, lost) = undocumented(&["study", "hazard"], &of_study);
    assert!(
        all > 40 && lost.is_empty(),
        "of {all}, no page names {lost:?}"
    );
}

/// Whether a value may stand where this schema does, as far as keys and kinds of values go.
fn fits(value: &Value, schema: &Value) -> bool {
    let Value::Object(rules) = schema else {
        return schema != &Value::Bool(false);
    };
    assert!(!rules.contains_key("$ref"), "{schema} is not followed");
    for choice in ["anyOf", "oneOf"] {
        if let Some(Value::Array(choices)) = rules.get(choice)
            && !choices.iter().any(|choice| fits(value, choice))
        {
            return false;
        }
    }
    let kind = match value {
        Value::Object(_) => "object",
        Value::Array(_) => "array",
        Value::String(_) => "string",
        Value::Bool(_) => "boolean",
        Value::Number(n) if n.is_f64() => "number",
        _ => "integer",
    };
    let allowed = |wanted: &Value| wanted == kind || (wanted == "number" && kind == "integer");
    let typed = match rules.get("type") {
        Some(Value::Array(kinds)) => kinds.iter().any(allowed),
        Some(wanted) => allowed(wanted),
        None => true,
    };
    let open = Value::Bool(true);
    let words = rules.get("enum").and_then(Value::as_array);
    typed
        && words.is_none_or(|words| words.contains(value))
        && match value {
            Value::Object(entries) => {
                let others = rules.get("additionalProperties").unwrap_or(&open);
                let known = |key: &String| rules.get("properties").and_then(|p| p.get(key));
                let needed = rules.get("required").and_then(Value::as_array);
                let has = |key: &Value| key.as_str().is_some_and(|k| entries.contains_key(k));
                needed.is_none_or(|keys| keys.iter().all(has))
                    && entries
                        .iter()
                        .all(|(key, value)| fits(value, known(key).unwrap_or(others)))
            }
            Value::Array(items) => {
                let each = rules.get("items").unwrap_or(&open);
                items.iter().all(|item| fits(item, each))
            }
            _ => true,
        }
}

/// Editors complete methods, impact models and laws of a case: all of each stand in its schema, and a method that is
/// none does not fit.
#[test]
fn the_schema_of_a_case_has_its_words() {
    let schema = printed(pounding().args(["schema", "case"]), "case");
    let schema: Value = serde_json::from_str(&schema).unwrap();
    let words = |path: &str, keyword: &str| -> BTreeSet<String> {
        let list = schema.pointer(path).and_then(|of| of.get(keyword));
        let list = list.and_then(Value::as_array);
        let list = list.unwrap_or_else(|| panic!("{path} has no {keyword}"));
        list.iter()
            .map(|w| w.as_str().unwrap().to_owned())
            .collect()
    };
    let law = "/properties/building/items/properties/law/anyOf";
    let methods = words("/properties/analysis/properties/method", "enum");
    assert!(methods.contains("event_driven") && methods.len() == 6);
    let models = words("/properties/gap/items/properties/model", "examples");
    let registered = pounding_gap_element::registry::descriptors();
    assert_eq!(models.len(), registered.len());
    let of_links = words("/properties/link/items/properties/model", "examples");
    assert_eq!(
        of_links.len(),
        pounding_hysteresis::registry::descriptors().len()
    );
    for form in ["0", "1/items"] {
        let of_storeys = words(&format!("{law}/{form}/properties/model"), "examples");
        assert!(of_storeys.contains("bouc_wen") && !of_storeys.contains("gap_hook"));
        assert!(of_storeys.is_subset(&of_links));
    }
}

/// The cases and studies of the examples fit the schemas; with a key misspelt they do not.
#[test]
fn the_examples_fit_the_schemas() {
    let mut checked = [0; 2];
    for (count, (file, name, key)) in checked.iter_mut().zip([
        ("case", "case.toml", "width"),
        ("study", "study.toml", "path"),
    ]) {
        let schema = printed(pounding().args(["schema", file]), file);
        let schema: Value = serde_json::from_str(&schema).unwrap();
        for example in std::fs::read_dir(root().join("examples")).unwrap() {
            let Ok(text) = std::fs::read_to_string(example.unwrap().path().join(name)) else {
                continue;
            };
            *count += 1;
            let value: Value = toml::from_str(&text).unwrap();
            assert!(fits(&value, &schema), "{text}");
            let misspelt = text.replacen(&format!("\n{key} ="), "\nnosuchkey =", 1);
            if misspelt != text && file == "study" {
                let value: Value = toml::from_str(&misspelt).unwrap();
                assert!(!fits(&value, &schema), "{misspelt}");
            }
        }
    }
    assert!(checked[0] >= 10 && checked[1] >= 2, "{checked:?}");
    let study = printed(pounding().args(["schema", "study"]), "study");
    let study: Value = serde_json::from_str(&study).unwrap();
    let page = page("docs/reference/studies.md");
    let of_page = page.split("```toml\n").nth(1).unwrap();
    let of_page = of_page.split("```").next().unwrap();
    let value: Value = toml::from_str(of_page).unwrap();
    assert!(of_page.contains("records = [\"a.csv\", {") && fits(&value, &study));
    for wrong in [
        "path = \"a\"\nvalues = true",
        "records = [{ nmae = \"a\", file = \"b.csv\" }]",
        "path = \"a\"\nvalues = [{ stiffness = 1 }]",
    ] {
        let wrong = format!("case = \"case.toml\"\n[[variable]]\n{wrong}\n");
        let value: Value = toml::from_str(&wrong).unwrap();
        assert!(!fits(&value, &study), "{wrong}");
    }
    let hazard = printed(pounding().args(["schema", "hazard"]), "hazard");
    let hazard: Value = serde_json::from_str(&hazard).unwrap();
    let points: Value = serde_json::from_str("[[0.1, 1e-2], [\"0.5 g\", 1e-4]]").unwrap();
    assert!(fits(&points, &hazard) && !fits(&Value::from(3), &hazard));
}

/// The case of the page, and every kind of damping in its table.
#[test]
fn the_case_file_of_the_reference_is_accepted() {
    let page = page("docs/reference/case-file.md");
    let motions = root().join("ground_motions");
    let case = block(&page, "toml").replace("../../ground_motions", motions.to_str().unwrap());
    let kinds = page.lines().filter_map(|line| {
        let kind = line.strip_prefix("| `{ ")?.split_once('`')?.0;
        Some(format!("damping = {{ {kind}"))
    });
    let kinds: Vec<String> = kinds.collect();
    assert_eq!(kinds.len(), 6);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("case.toml");
    let first = "damping = { stiffness_proportional = 0.05 }";
    assert!(case.contains(first));
    for kind in kinds {
        std::fs::write(&file, case.replacen(first, &kind, 1)).unwrap();
        printed(pounding().arg("check").arg(&file), &kind);
    }
}

/// The tables of record formats and of generators say what their descriptors say.
#[test]
fn formats_and_generators_are_in_their_tables() {
    let page = page("docs/reference/ground-motions.md");
    for f in Format::all() {
        let Format {
            name,
            title,
            source,
            recognised_by,
            ..
        } = f;
        let row = format!("\n| `{name}` | {title} | {source} | {recognised_by} |\n");
        assert!(page.contains(&row), "{row}");
    }
    // Lines are wrapped.
    let help = |arguments: &[&str]| {
        let printed = printed(pounding().args(["motion", "synth"]).args(arguments), "help");
        printed.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let all = help(&["--help"]);
    for g in GENERATORS.all() {
        let row = format!("\n| `{}` | {} | {} |\n", g.name, g.title, g.source);
        assert!(page.contains(&row), "{row}");
        assert!(all.contains(&format!(" {} {} ", g.name, g.title)), "{all}");
        let own = help(&[g.name, "--help"]);
        assert!(own.starts_with(g.title), "{own}");
        assert!(own.contains(&format!("Source: {}", g.source)), "{own}");
    }
}

/// The gallery shows every example.
#[test]
fn the_gallery_names_every_example() {
    let gallery = page("docs/gallery.md");
    let mut seen = 0;
    for entry in std::fs::read_dir(root().join("examples")).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_dir() {
            let name = entry.file_name().into_string().unwrap();
            let link = format!("(../examples/{name}/README.md)");
            assert!(gallery.contains(&link), "docs/gallery.md lacks {name}");
            seen += 1;
        }
    }
    assert!(seen >= 20, "{seen}");
}
