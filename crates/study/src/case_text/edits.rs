//! Finding and replacing entries of a case: in its tree, and in its text.

use std::borrow::Cow;
use std::fmt::Display;
use std::ops::Range;
use std::sync::Arc;

use pounding_catalogue::suggestion;
use pounding_catalogue::wording::agreeing;
use pounding_gap_element::{ModelDescriptor, registry};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::identity::{Lines, canonical};
use super::path::{Path, Step};

type Value<'a> = Spanned<DeValue<'a>>;

/// Where an entry stands, or would stand, in a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// The way to it through keys and places in lists, without names.
    pub path: Path,
    /// Bytes of the case that a value replaces; none if the case leaves the entry out.
    pub span: Range<usize>,
    /// What stands before the value where the case leaves the entry out.
    pub before: String,
    /// What then stands behind it.
    pub after: &'static str,
}

impl Entry {
    /// Whether both are the same entry, or one is within the other.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        let (a, b) = (&self.span, &other.span);
        // Keys that a case leaves out may be put in at one place.
        if a.is_empty() && a == b {
            let (a, b) = (&self.path.0, &other.path.0);
            return a.starts_with(b) || b.starts_with(a);
        }
        a.start < b.end && b.start < a.end
    }
}

/// A new value of an entry, as TOML; `None` takes the entry away with its key.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Edit {
    pub entry: Arc<Entry>,
    pub value: Option<String>,
}

impl Edit {
    pub(crate) fn new(entry: &Arc<Entry>, value: impl Into<String>) -> Self {
        Self {
            entry: Arc::clone(entry),
            value: Some(value.into()),
        }
    }
}

/// A number as it stands in the case of a run.
pub(crate) fn written(x: f64) -> String {
    // Counts must stay whole numbers; all else is read back to the same bits.
    if x.fract() == 0.0 && x.abs() < 1e15 {
        format!("{x:.0}")
    } else {
        format!("{x:e}")
    }
}

/// A path that leads nowhere: why, and what to do.
pub(crate) type Lost = (String, String);

/// The tree of a case, which is sound.
pub(super) fn tree(source: &str) -> Result<DeTable<'_>, Lost> {
    let broken = |_| {
        (
            "the case is not TOML".to_owned(),
            "run check on it".to_owned(),
        )
    };
    Ok(DeTable::parse(source).map_err(broken)?.into_inner())
}

/// Follows a path to one entry through a case.
pub(super) fn find(source: &str, tree: &DeTable<'_>, path: &Path) -> Result<Entry, Lost> {
    let Some((Step::Key(first), rest)) = path.0.split_first() else {
        return Err((
            "a path begins with the name of a table".to_owned(),
            roots(tree),
        ));
    };
    let Some(mut value) = tree.get(first.as_str()) else {
        let keys = keys_of(rest).filter(|_| OPTIONAL_TABLES.contains(&first.as_str()));
        let Some(keys) = keys.filter(|_| !rest.is_empty()) else {
            return Err((format!("the case has no `{first}`"), roots(tree)));
        };
        // Keys of the root stand before all headers.
        let start = source.len() - source.trim_start_matches('\u{feff}').len();
        return Ok(Entry {
            path: path.clone(),
            span: start..start,
            before: format!("{first}.{keys} = "),
            after: "\n",
        });
    };
    let mut way = vec![Step::Key(first.clone())];
    for (i, step) in rest.iter().enumerate() {
        let shown = Path(path.0[..=i].to_vec());
        way.push(step.clone());
        value = match (value.get_ref(), step) {
            (DeValue::Table(table), Step::Key(key)) => match table.get(key.as_str()) {
                Some(inner) => inner,
                None => {
                    let Some(new) = keys_of(&rest[i..]) else {
                        return Err(unknown(&shown, key, &keys(table)));
                    };
                    let (at, before) = room(source, value, &new)?;
                    way.extend_from_slice(&rest[i + 1..]);
                    return Ok(Entry {
                        path: Path(way),
                        span: at..at,
                        before,
                        after: "",
                    });
                }
            },
            (DeValue::Array(items), Step::Index(number) | Step::Number(number)) => {
                let index = match step {
                    Step::Number(_) => numbered(items, *number, &shown, &path.0[i + 2..])?,
                    _ => *number,
                };
                way[i + 1] = Step::Index(index);
                items.get(index).ok_or_else(|| {
                    (
                        format!("`{shown}` has {}", counted_entries(items.len())),
                        "correct the number".to_owned(),
                    )
                })?
            }
            (DeValue::Array(items), Step::Key(name)) => {
                let mut named = items.iter().enumerate();
                let named = named.find(|(_, i)| name_of(i).as_deref() == Some(name));
                let (index, named) = named.ok_or_else(|| {
                    let names: Vec<String> = items.iter().filter_map(name_of).collect();
                    match names.is_empty() {
                        false => unknown(&shown, name, &names),
                        true => (
                            format!("`{shown}` of the case has no `{name}`"),
                            format!("it has {}", counted_entries(items.len())),
                        ),
                    }
                })?;
                way[i + 1] = Step::Index(index);
                named
            }
            (DeValue::Table(table), Step::Index(n) | Step::Number(n)) => {
                return Err(unknown(&shown, &n.to_string(), &keys(table)));
            }
            (DeValue::Table(table), Step::Each) => return Err(no_list(&shown, Some(table))),
            (_, Step::Each) => return Err(no_list(&shown, None)),
            _ => {
                return Err((
                    format!("`{shown}` is a single value in the case"),
                    format!("vary `{shown}` itself, or write a list in the case"),
                ));
            }
        };
    }
    Ok(Entry {
        path: Path(way),
        span: value.span(),
        before: String::new(),
        after: "",
    })
}

/// How many entries a list has, in words.
fn counted_entries(count: usize) -> String {
    let entries = agreeing(&count, "entry", "entries");
    format!("{count} {entries}, counted from 0")
}

/// Tables that a case may leave out.
const OPTIONAL_TABLES: [&str; 2] = ["analysis", "separation"];

/// Steps through tables alone, as a key with dots.
fn keys_of(steps: &[Step]) -> Option<String> {
    let key = |step: &Step| match step {
        Step::Key(key) => Some(as_key(key)),
        Step::Index(_) | Step::Number(_) | Step::Each => None,
    };
    let keys: Option<Vec<String>> = steps.iter().map(key).collect();
    Some(keys?.join("."))
}

/// The place in a list that a number means: that of the entry with this name, or else the number
/// itself. It must not mean one entry by its name and another by its place.
fn numbered(items: &[Value<'_>], number: usize, list: &Path, rest: &[Step]) -> Result<usize, Lost> {
    let name = number.to_string();
    let named = items
        .iter()
        .position(|i| name_of(i).as_ref() == Some(&name));
    let (Some(named), Some(counted)) = (named, items.get(number)) else {
        return Ok(named.unwrap_or(number));
    };
    if named == number {
        return Ok(number);
    }
    let spelt = |step: Step| {
        let steps = list.0.iter().cloned().chain([step]);
        Path(steps.chain(rest.iter().cloned()).collect())
    };
    let other = name_of(counted).map_or_else(String::new, |name| format!(", \"{name}\""));
    Err((
        format!(
            "`{list}.{number}` is ambiguous: the entry with the name \"{number}\", or entry {number} counted from 0{other}"
        ),
        format!(
            "write `{}` for the first, `{}` for the other",
            spelt(Step::Key(name)),
            spelt(Step::Index(number))
        ),
    ))
}

/// A path with a `*` to what is no list, maybe a table.
pub(super) fn no_list(place: &Path, table: Option<&DeTable<'_>>) -> Lost {
    match table {
        None => (
            format!("`{place}` is no list in the case, for each entry of which `*` stands"),
            format!("write the path without `*`, such as `{place}`"),
        ),
        Some(table) => (
            format!("`{place}` is a table in the case, and `*` stands for each entry of a list"),
            format!("name one of its entries, such as {}", within(place, table)),
        ),
    }
}

/// The paths to the entries of a table.
pub(super) fn within(place: &Path, table: &DeTable<'_>) -> String {
    let to = |key: String| Path(place.0.iter().cloned().chain([Step::Key(key)]).collect());
    let paths = keys(table).into_iter().map(|key| to(key).to_string());
    paths.collect::<Vec<_>>().join(", ")
}

/// The place of an entry.
pub(crate) fn entry(source: &str, path: &Path) -> Result<Arc<Entry>, Lost> {
    let tree = tree(source)?;
    let entry = Arc::new(find(source, &tree, path)?);
    replaceable(source, &tree, path, &entry)?;
    Ok(entry)
}

/// Refuses an entry whose text cannot be replaced as it is in the tree.
pub(super) fn replaceable(
    source: &str,
    tree: &DeTable<'_>,
    path: &Path,
    entry: &Arc<Entry>,
) -> Result<(), Lost> {
    if text_agrees(source, tree, &[Edit::new(entry, "0")]) {
        return Ok(());
    }
    Err(match entry.before.is_empty() {
        true => (
            format!("`{path}` is a table with a header of its own in the case"),
            "vary one of its entries, or write it in one line, such as scale = { pga = 3 }"
                .to_owned(),
        ),
        false => left_out(path),
    })
}

/// A key that cannot be put in.
fn left_out(key: impl Display) -> Lost {
    (
        format!("the case leaves `{key}` out"),
        "write it in the case with any value".to_owned(),
    )
}

/// Whether edits make of the text what they make of the tree: they do not where a value takes
/// the place of a header.
pub(super) fn text_agrees(source: &str, tree: &DeTable<'_>, edits: &[Edit]) -> bool {
    let lines = |changed| Lines::of(tree).with(&changed);
    changed(tree, edits).map(lines) == Some(canonical(&apply(source, edits)))
}

/// Whether a key of a gap belongs to its impact model: it names the model, or is a parameter of one.
pub(crate) fn of_impact_model(key: &str) -> bool {
    let has = |model: &ModelDescriptor| model.parameters.iter().any(|p| p.name == key);
    ["model", "separation", "spring"].contains(&key)
        || registry::descriptors().iter().any(|model| has(model))
}

/// A gap without all that belongs to its model, and with these keys, as TOML, instead.
pub(crate) fn with_model(
    source: &str,
    gap: &Path,
    options: Vec<(String, String)>,
) -> Result<Vec<Edit>, Lost> {
    rewritten(source, gap, of_impact_model, options)
}

/// Names of the buildings of a case that is TOML, in the order of the file.
pub(crate) fn building_names(source: &str) -> Vec<String> {
    let Ok(tree) = DeTable::parse(source) else {
        return Vec::new();
    };
    let buildings = tree
        .get_ref()
        .get("building")
        .and_then(|v| v.get_ref().as_array());
    let names = buildings.into_iter().flatten().map(name_of);
    names.map(Option::unwrap_or_default).collect()
}

/// Where the first of these keys stands at the root of a text that is TOML and has none of the
/// others there: what kind of file it is.
pub(crate) fn root_key(source: &str, keys: &[&str], others: &[&str]) -> Option<Range<usize>> {
    let tree = DeTable::parse(source).ok()?;
    let root = tree.get_ref();
    if others.iter().any(|key| root.contains_key(*key)) {
        return None;
    }
    let mut found = keys.iter().filter_map(|key| root.get_key_value(*key));
    found.next().map(|(key, _)| key.span())
}

/// Keys of the motion that act on every record without one of its own.
pub(crate) const KEPT: [&str; 2] = ["process", "across"];

/// A case without all that says which record to read and how, but for some keys, and with these
/// keys, as TOML, instead.
pub(crate) fn with_motion(
    source: &str,
    kept: &[&str],
    options: Vec<(String, String)>,
) -> Result<Vec<Edit>, Lost> {
    let path = Path(vec![Step::Key("ground_motion".to_owned())]);
    rewritten(source, &path, |key| !kept.contains(&key), options)
}

/// A case without an entry of a table that has a header of its own; nothing where the case leaves it
/// out.
pub(crate) fn without(source: &str, path: &Path) -> Result<Vec<Edit>, Lost> {
    match path.0.split_last() {
        Some((Step::Key(key), table)) => {
            rewritten(source, &Path(table.to_vec()), |k| k == key, Vec::new())
        }
        _ => Err((
            format!("`{path}` is no key of a table"),
            "name a key, such as gap.0.restitution".to_owned(),
        )),
    }
}

/// A table with a header of its own without the entries that `pick` wants, and with these
/// behind its header.
fn rewritten(
    source: &str,
    path: &Path,
    pick: impl Fn(&str) -> bool,
    new: Vec<(String, String)>,
) -> Result<Vec<Edit>, Lost> {
    let tree = tree(source)?;
    let Entry {
        path: way, span, ..
    } = find(source, &tree, path)?;
    let with_header = source[span.clone()].starts_with('[');
    let table = with_header.then(|| table_at(&tree, &span)).flatten();
    let Some(table) = table else {
        return Err((
            format!("`{path}` has no header of its own in the case"),
            "write it as a table under [ground_motion] or [[gap]]".to_owned(),
        ));
    };
    let edit = |key: &str, span: Range<usize>, before: String, value| {
        let step = Step::Key(key.to_owned());
        let entry = Entry {
            path: Path(way.0.iter().cloned().chain([step]).collect()),
            span,
            before,
            after: "",
        };
        Edit {
            entry: Arc::new(entry),
            value,
        }
    };
    let picked = table.iter().filter(|(key, _)| pick(key.get_ref()));
    let mut edits: Vec<Edit> = picked
        .map(|(key, value)| {
            let place = key.span().start..value.span().end;
            edit(key.get_ref(), place, String::new(), None)
        })
        .collect();
    edits.sort_by_key(|edit| edit.entry.span.start);
    for (key, value) in new {
        let before = format!("\n{} = ", as_key(&key));
        edits.push(edit(&key, span.end..span.end, before, Some(value)));
    }
    match text_agrees(source, &tree, &edits) {
        true => Ok(edits),
        false => Err((
            format!("a table in `{path}` has a header of its own in the case"),
            "write it in one line, such as scale = { pga = 3 } or across = { file = \"ew.csv\" }"
                .to_owned(),
        )),
    }
}

/// The table whose header stands here.
fn table_at<'t, 'a>(root: &'t DeTable<'a>, span: &Range<usize>) -> Option<&'t DeTable<'a>> {
    let of = |value: &'t Value<'a>| match value.get_ref() {
        DeValue::Table(table) if value.span() == *span => Some(table),
        _ => None,
    };
    root.values()
        .find_map(|value| of(value).or_else(|| value.get_ref().as_array()?.iter().find_map(of)))
}

/// A key as TOML.
fn as_key(key: &str) -> String {
    let is_bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !key.is_empty() && key.chars().all(is_bare) {
        true => key.to_owned(),
        false => toml::Value::String(key.to_owned()).to_string(),
    }
}

fn keys(table: &DeTable<'_>) -> Vec<String> {
    table.keys().map(|k| k.get_ref().to_string()).collect()
}

fn roots(table: &DeTable<'_>) -> String {
    format!("paths begin with {}", keys(table).join(", "))
}

/// The name of a building or a gap: that of a gap is `left-right` by default.
fn name_of(value: &Value<'_>) -> Option<String> {
    let table = value.get_ref().as_table()?;
    if let Some(name) = table.get("name") {
        return Some(name.get_ref().as_str()?.to_owned());
    }
    let between = table.get("between")?.get_ref().as_array()?;
    let names: Vec<&str> = between
        .iter()
        .filter_map(|v| v.get_ref().as_str())
        .collect();
    Some(names.join("-"))
}

fn unknown(place: &Path, key: &str, known: &[String]) -> Lost {
    // Names that a path would read otherwise stand in brackets behind what they belong to.
    let spelt = |name: &String| {
        let read = Path::parse(name).map(|path| path.0);
        match read.as_deref() {
            Ok([Step::Key(_) | Step::Number(_)]) => name.clone(),
            _ => format!("{place}[\"{name}\"]"),
        }
    };
    let nearest = suggestion::misspelt(key, known);
    let nearest = nearest.map(|name| spelt(&name.to_owned()));
    let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`? "));
    let known: Vec<String> = known.iter().map(spelt).collect();
    (
        format!("`{place}` of the case has no `{key}`"),
        format!("{guess}it has {}", known.join(", ")),
    )
}

/// Where a key that a table leaves out can be put, as TOML, behind its header or into its braces,
/// and what then stands before the value.
fn room(source: &str, table: &Value<'_>, new: &str) -> Result<(usize, String), Lost> {
    let span = table.span();
    match source.as_bytes().get(span.start) {
        Some(b'[') => Ok((span.end, format!("\n{new} = "))),
        Some(b'{') if table.get_ref().as_table().is_some_and(|t| !t.is_empty()) => {
            let last = table
                .get_ref()
                .as_table()
                .and_then(|t| t.values().map(|v| v.span().end).max());
            Ok((last.unwrap_or(span.end), format!(", {new} = ")))
        }
        _ => Err(left_out(new)),
    }
}

/// Edits in the order of their places.
fn in_order(edits: &[Edit]) -> Vec<&Edit> {
    let mut edits: Vec<&Edit> = edits.iter().collect();
    edits.sort_by_key(|edit| (edit.entry.span.start, edit.entry.span.end));
    edits
}

/// The text with its edits, which do not overlap.
pub(crate) fn apply(source: &str, edits: &[Edit]) -> String {
    let mut text = String::with_capacity(source.len() + 64 * edits.len());
    let mut from = 0;
    for Edit { entry, value } in in_order(edits) {
        let Range { start, end } = entry.span;
        text.push_str(source.get(from..start).unwrap_or_default());
        if let Some(value) = value {
            text.push_str(&entry.before);
            text.push_str(value);
            text.push_str(entry.after);
        }
        from = end;
    }
    text.push_str(source.get(from..).unwrap_or_default());
    text
}

/// Where the keys that edits bring with them stand in the text that [`apply`] makes.
pub(crate) fn places_of_keys(edits: &[Edit]) -> Vec<Range<usize>> {
    let (mut put, mut taken) = (0, 0);
    let of_edit = |edit: &Edit| {
        let Edit { entry, value } = edit;
        let start = entry.span.start + put - taken;
        taken += entry.span.len();
        let Some(value) = value else {
            return start..start;
        };
        put += entry.before.len() + value.len() + entry.after.len();
        start..start + entry.before.len()
    };
    in_order(edits).into_iter().map(of_edit).collect()
}

/// The values of the root keys that edits change in a tree; `None` where they cannot be made.
pub(crate) fn changed<'t>(tree: &DeTable<'t>, edits: &'t [Edit]) -> Option<DeTable<'t>> {
    let mut roots = DeTable::new();
    // What is taken away may be put in again elsewhere.
    let (put, taken): (Vec<_>, Vec<_>) = in_order(edits)
        .into_iter()
        .partition(|edit| edit.value.is_some());
    for edit in taken.into_iter().chain(put) {
        let (Step::Key(root), way) = edit.entry.path.0.split_first()? else {
            return None;
        };
        if !roots.contains_key(root.as_str()) {
            let (key, value) = match tree.get_key_value(root.as_str()) {
                Some((key, value)) => (key.clone(), value.clone()),
                None if edit.entry.before.is_empty() => return None,
                None => {
                    let span = edit.entry.span.clone();
                    let key = Spanned::new(span.clone(), Cow::Borrowed(root.as_str()));
                    (key, Spanned::new(span, DeValue::Table(DeTable::new())))
                }
            };
            roots.insert(key, value);
        }
        make(edit, roots.get_mut(root.as_str())?, way)?;
    }
    Some(roots)
}

/// Makes an edit in the value of a root key, from which this way leads to it; `None` if it
/// cannot be made.
fn make<'t>(edit: &'t Edit, root: &mut Value<'t>, way: &'t [Step]) -> Option<()> {
    let Edit { entry, value } = edit;
    let here = |value| Spanned::new(entry.span.clone(), value);
    let value = match value {
        None => None,
        Some(text) => Some(here(DeValue::parse(text).ok()?.into_inner())),
    };
    match value {
        Some(value) if entry.before.is_empty() => *inside(root, way)? = value,
        value => {
            let (Step::Key(key), way) = way.split_last()? else {
                return None;
            };
            if value.is_some() {
                tables(root, way, &entry.span)?;
            }
            let DeValue::Table(table) = inside(root, way)?.get_mut() else {
                return None;
            };
            let Some(value) = value else {
                return table.remove(key.as_str()).map(drop);
            };
            let key = Spanned::new(entry.span.clone(), Cow::Borrowed(key.as_str()));
            // In the text it must not stand twice.
            return table.insert(key, value).is_none().then_some(());
        }
    }
    Some(())
}

/// Puts in the tables that a way lacks.
fn tables<'t>(mut value: &mut Value<'t>, way: &'t [Step], span: &Range<usize>) -> Option<()> {
    for step in way {
        value = match (value.get_mut(), step) {
            (DeValue::Table(table), Step::Key(key)) => {
                let key = Spanned::new(span.clone(), Cow::Borrowed(key.as_str()));
                let new = || Spanned::new(span.clone(), DeValue::Table(DeTable::new()));
                table.entry(key).or_insert_with(new)
            }
            (DeValue::Array(items), Step::Index(index)) => items.get_mut(*index)?,
            _ => return None,
        };
    }
    Some(())
}

/// The value at the end of a way.
fn inside<'v, 't>(mut value: &'v mut Value<'t>, way: &[Step]) -> Option<&'v mut Value<'t>> {
    for step in way {
        value = match (value.get_mut(), step) {
            (DeValue::Table(table), Step::Key(key)) => table.get_mut(key.as_str())?,
            (DeValue::Array(items), Step::Index(index)) => items.get_mut(*index)?,
            _ => return None,
        };
    }
    Some(value)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const CASE: &str = "[[building]]\nname = \"light\"\nmass = [1, \"2 t\"]\n\n[[gap]] # the gap\nbetween = [\"light\", \"wall\"]\nwidth = \"20 mm\"   # as built\nmodel = \"hertz_1882\"\nstiffness = 1e9\n\n[ground_motion]\nfile = \"a.csv\"\nscale = { pga = 3 }\n";

    fn edited(path: &str, new: &str) -> String {
        let entry = entry(CASE, &Path::parse(path).unwrap()).unwrap();
        apply(CASE, &[Edit::new(&entry, new)])
    }

    #[test]
    fn entries_are_replaced_where_they_stand() {
        for (path, from, to) in [
            ("gap.0.width", "\"20 mm\"", "0.03"),
            ("gap[\"light-wall\"].width", "\"20 mm\"", "0.03"),
            ("building.light.mass.1", "\"2 t\"", "7"),
            ("building.0.mass", "[1, \"2 t\"]", "7"),
            ("ground_motion.scale.pga", "3", "4"),
        ] {
            assert_eq!(edited(path, to), CASE.replacen(from, to, 1), "{path}");
        }
    }

    #[test]
    fn absent_entries_are_put_in() {
        let text = edited("gap.0.restitution", "0.5");
        assert!(
            text.contains("[[gap]]\nrestitution = 0.5 # the gap\nbetween"),
            "{text}"
        );
        let text = edited("ground_motion.scale.factor", "2");
        assert!(text.contains("{ pga = 3, factor = 2 }"), "{text}");
    }

    #[test]
    fn absent_tables_are_put_in() {
        let text = edited("analysis.duration", "\"3 s\"");
        assert_eq!(text, format!("analysis.duration = \"3 s\"\n{CASE}"));
        let text = edited("ground_motion.across.scale.pga", "2");
        assert!(
            text.contains("[ground_motion]\nacross.scale.pga = 2\nfile"),
            "{text}"
        );
        // Several keys of one table.
        let tree = DeTable::parse(CASE).unwrap().into_inner();
        let put = |path: &str| {
            let entry = entry(CASE, &Path::parse(path).unwrap()).unwrap();
            Edit::new(&entry, "1")
        };
        let edits = [
            "analysis.step",
            "separation.importance",
            "analysis.duration",
        ]
        .map(put);
        assert!(text_agrees(CASE, &tree, &edits));
        assert!(!edits[0].entry.overlaps(&edits[2].entry));
        let outer = put("ground_motion.across");
        assert!(
            outer
                .entry
                .overlaps(&put("ground_motion.across.scale").entry)
        );
    }

    #[test]
    fn wrong_paths_say_what_there_is() {
        let lost = |path: &str| entry(CASE, &Path::parse(path).unwrap()).unwrap_err();
        assert!(
            lost("gap.lihgt-wall.width")
                .1
                .contains("did you mean `light-wall`")
        );
        assert!(lost("gap.3.width").0.contains("1 entry,"));
        assert!(lost("gaps.0.width").1.contains("gap"));
        assert!(lost("gap.0.width.1").0.contains("single value"));
        assert!(lost("analysys.step").0.contains("no `analysys`"));
        assert!(lost("analysis").0.contains("no `analysis`"));
        assert!(lost("analysis.0").0.contains("no `analysis`"));
    }

    /// Buildings, gaps and links whose names are numbers.
    #[test]
    fn names_that_are_numbers_go_first() {
        let case = "building = [\n{ name = \"1\", mass = 10 },\n{ name = \"2\", mass = 20 },\n{ name = \"7\", mass = 70 },\n{ name = \"3\", mass = 30 }]\n[[gap]]\nname = \"5\"\nwidth = 50\n[[link]]\nname = \"0\"\nstiffness = [1, 60]\n";
        let found = |path: &str| entry(case, &Path::parse(path).unwrap());
        for (path, value) in [
            ("building.0.mass", "10"),
            ("building[\"1\"].mass", "10"),
            ("building[\"2\"].mass", "20"),
            ("building[2].mass", "70"),
            ("building[1].mass", "20"),
            ("building.7.mass", "70"),
            ("building.3.mass", "30"),
            ("gap.5.width", "50"),
            ("gap.0.width", "50"),
            ("link.0.stiffness.1", "60"),
        ] {
            assert_eq!(&case[found(path).unwrap().span.clone()], value, "{path}");
        }
        let (why, help) = found("building.2.mass").unwrap_err();
        assert_eq!(
            why,
            "`building.2` is ambiguous: the entry with the name \"2\", or entry 2 counted from 0, \"7\""
        );
        assert_eq!(
            help,
            "write `building[\"2\"].mass` for the first, `building[2].mass` for the other"
        );
        assert!(found("building.1.mass").unwrap_err().0.contains("\"2\""));
        assert!(
            found("building.4.mass")
                .unwrap_err()
                .0
                .contains("4 entries")
        );
    }

    #[test]
    fn options_of_the_model_are_told_from_those_of_the_gap() {
        let option = |key: &str, value: &str| (key.to_owned(), value.to_owned());
        let gap = Path::parse("gap.0").unwrap();
        let new = vec![option("model", "\"new\""), option("stiffness", "2")];
        let text = apply(CASE, &with_model(CASE, &gap, new).unwrap());
        let wanted = CASE
            .replace("[[gap]]", "[[gap]]\nmodel = \"new\"\nstiffness = 2")
            .replace("model = \"hertz_1882\"\nstiffness = 1e9\n", "\n\n");
        assert_eq!(text, wanted);
        let new = vec![option("file", "\"b.csv\"")];
        let text = apply(CASE, &with_motion(CASE, &["scale"], new).unwrap());
        let wanted = CASE
            .replace("file = \"a.csv\"", "")
            .replace("[ground_motion]", "[ground_motion]\nfile = \"b.csv\"");
        assert_eq!(text, wanted);
    }

    /// A table with a header of its own cannot be replaced in the text as in the tree.
    #[test]
    fn headers_are_not_replaced() {
        let case = CASE.replace("scale = { pga = 3 }", "[ground_motion.scale]\npga = 3");
        for path in ["ground_motion.scale", "ground_motion", "gap", "gap.0"] {
            let (why, help) = entry(&case, &Path::parse(path).unwrap()).unwrap_err();
            let wanted = format!("`{path}` is a table with a header of its own in the case");
            assert_eq!(why, wanted);
            assert!(help.contains("in one line"));
        }
        let pga = Path::parse("ground_motion.scale.pga").unwrap();
        assert!(entry(&case, &pga).is_ok());
        // Its entries would stay where it is taken away.
        let (why, _) = with_motion(&case, &[], Vec::new()).unwrap_err();
        assert_eq!(
            why,
            "a table in `ground_motion` has a header of its own in the case"
        );
    }

    /// Keys that must be quoted are, so that they stay one key.
    #[test]
    fn keys_are_put_in_whole() {
        let text = edited("gap.0[\"a.b c\"]", "1");
        assert!(text.contains("[[gap]]\n\"a.b c\" = 1 #"), "{text}");
    }

    /// What the text would not bear is not made in the tree.
    #[test]
    fn a_key_is_not_put_in_twice() {
        let tree = DeTable::parse(CASE).unwrap().into_inner();
        let put = entry(CASE, &Path::parse("gap.0.restitution").unwrap()).unwrap();
        let put = Edit::new(&put, "0.5");
        assert!(changed(&tree, std::slice::from_ref(&put)).is_some());
        assert!(changed(&tree, &[put.clone(), put]).is_none());
        let scale = entry(CASE, &Path::parse("ground_motion.scale").unwrap()).unwrap();
        let inner = entry(CASE, &Path::parse("ground_motion.scale.factor").unwrap()).unwrap();
        let edits = [Edit::new(&inner, "2"), Edit::new(&scale, "1")];
        assert!(changed(&tree, &edits).is_none());
    }
}
