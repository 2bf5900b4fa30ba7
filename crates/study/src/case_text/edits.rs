//! Finding and replacing entries in the text of a case.

use std::ops::Range;

use pounding_catalogue::suggestion;
use pounding_catalogue::wording::agreeing;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::path::{Path, Step};

type Value<'a> = Spanned<DeValue<'a>>;

/// Where a new value of an entry goes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Entry {
    /// Bytes of the case that the value replaces; none if the case leaves the entry out.
    pub span: Range<usize>,
    /// What stands before the value where the case leaves the entry out.
    pub before: String,
}

impl Entry {
    /// The replacement that gives the entry this value.
    pub(crate) fn with(&self, value: &str) -> (Range<usize>, String) {
        (self.span.clone(), format!("{}{value}", self.before))
    }
}

/// Replacements in a text, in order of their places.
pub(crate) type Edits = Vec<(Range<usize>, String)>;

/// What a path leads to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Found {
    /// An entry of the case.
    Present(Range<usize>),
    /// A table of the case has no such key: it can be put in at this byte, after this.
    Absent(usize, String),
}

/// A path that leads nowhere: why, and what to do.
pub(crate) type Lost = (String, String);

/// Follows a path through the text of a case, which is sound.
pub(crate) fn find(source: &str, path: &Path) -> Result<Found, Lost> {
    let broken = |_| {
        (
            "the case is not TOML".to_owned(),
            "run check on it".to_owned(),
        )
    };
    let tree = DeTable::parse(source).map_err(broken)?;
    let Some((Step::Key(first), rest)) = path.0.split_first() else {
        return Err((
            "a path begins with the name of a table".to_owned(),
            roots(tree.get_ref()),
        ));
    };
    let Some(mut value) = get(tree.get_ref(), first) else {
        return Err((format!("the case has no `{first}`"), roots(tree.get_ref())));
    };
    for (i, step) in rest.iter().enumerate() {
        let last = i + 1 == rest.len();
        let shown = Path(path.0[..=i].to_vec());
        value = match (value.get_ref(), step) {
            (DeValue::Table(table), Step::Key(key)) => match get(table, key) {
                Some(inner) => inner,
                None if last => return absent(source, value, key),
                None => return Err(unknown(&shown, key, &keys(table))),
            },
            (DeValue::Array(items), Step::Index(index)) => items.get(*index).ok_or_else(|| {
                (
                    format!(
                        "`{shown}` has {} {}, counted from 0",
                        items.len(),
                        agreeing(&items.len(), "entry", "entries")
                    ),
                    "correct the number".to_owned(),
                )
            })?,
            (DeValue::Array(items), Step::Key(name)) => {
                let named = items.iter().find(|i| name_of(i).as_deref() == Some(name));
                let names: Vec<String> = items.iter().filter_map(name_of).collect();
                named.ok_or_else(|| unknown(&shown, name, &names))?
            }
            (DeValue::Table(table), Step::Index(n)) => {
                return Err(unknown(&shown, &n.to_string(), &keys(table)));
            }
            _ => {
                return Err((
                    format!("`{shown}` is a single value in the case"),
                    format!("vary `{shown}` itself, or write a list in the case"),
                ));
            }
        };
    }
    Ok(Found::Present(value.span()))
}

/// The place of an entry that a study varies.
pub(crate) fn entry(source: &str, path: &Path) -> Result<Entry, Lost> {
    Ok(match find(source, path)? {
        Found::Present(span) => Entry {
            span,
            before: String::new(),
        },
        Found::Absent(at, before) => Entry {
            span: at..at,
            before,
        },
    })
}

/// Keys that every gap understands, whatever its model.
const OF_ANY_GAP: [&str; 7] = [
    "name",
    "between",
    "width",
    "levels",
    "elevation_tolerance",
    "floor_to_floor",
    "model",
];

/// All that belongs to the model of a gap, from key to value, and the end of the header of
/// the gap's table.
pub(crate) fn options_of_gap(
    source: &str,
    path: &Path,
) -> Result<(Vec<Range<usize>>, usize), Lost> {
    let mine = |key: &str| key == "model" || !OF_ANY_GAP.contains(&key);
    entries(source, path, mine)
}

/// Names of the buildings of a case that is TOML, in the order of the file.
pub(crate) fn building_names(source: &str) -> Vec<String> {
    let Ok(tree) = DeTable::parse(source) else {
        return Vec::new();
    };
    let buildings = get(tree.get_ref(), "building").and_then(|v| v.get_ref().as_array());
    let names = buildings.into_iter().flatten().map(name_of);
    names.map(Option::unwrap_or_default).collect()
}

/// All that says which record to read and how, but for some keys, and the end of the header
/// `[ground_motion]`.
pub(crate) fn options_of_motion(
    source: &str,
    kept: &[&str],
) -> Result<(Vec<Range<usize>>, usize), Lost> {
    let path = Path(vec![Step::Key("ground_motion".to_owned())]);
    entries(source, &path, |key| !kept.contains(&key))
}

/// Entries of a table with a header of its own that `pick` wants.
fn entries(
    source: &str,
    path: &Path,
    pick: impl Fn(&str) -> bool,
) -> Result<(Vec<Range<usize>>, usize), Lost> {
    let Found::Present(span) = find(source, path)? else {
        return Err((format!("the case has no `{path}`"), "add it".to_owned()));
    };
    let with_header = source[span.clone()].starts_with('[');
    let tree = DeTable::parse(source).map_err(|e| (e.to_string(), String::new()))?;
    let table = with_header
        .then(|| table_at(tree.get_ref(), &span))
        .flatten();
    let Some(table) = table else {
        return Err((
            format!("`{path}` has no header of its own in the case"),
            "write it as a table under [ground_motion] or [[gap]]".to_owned(),
        ));
    };
    let picked = table.iter().filter(|(key, _)| pick(key.get_ref()));
    let mut places: Vec<Range<usize>> = picked
        .map(|(key, value)| key.span().start..value.span().end)
        .collect();
    places.sort_by_key(|p| p.start);
    Ok((places, span.end))
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

fn get<'t, 'a>(table: &'t DeTable<'a>, key: &str) -> Option<&'t Value<'a>> {
    table
        .iter()
        .find(|(k, _)| k.get_ref() == key)
        .map(|(_, v)| v)
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
    if let Some(name) = get(table, "name") {
        return Some(name.get_ref().as_str()?.to_owned());
    }
    let between = get(table, "between")?.get_ref().as_array()?;
    let names: Vec<&str> = between
        .iter()
        .filter_map(|v| v.get_ref().as_str())
        .collect();
    Some(names.join("-"))
}

fn unknown(place: &Path, key: &str, known: &[String]) -> Lost {
    let nearest = suggestion::misspelt(key, known);
    let guess = nearest.map_or_else(String::new, |k| format!("did you mean `{k}`? "));
    (
        format!("`{place}` of the case has no `{key}`"),
        format!("{guess}it has {}", known.join(", ")),
    )
}

/// A key that a table leaves out can be put behind its header, or into its braces.
fn absent(source: &str, table: &Value<'_>, key: &str) -> Result<Found, Lost> {
    let span = table.span();
    match source.as_bytes().get(span.start) {
        Some(b'[') => Ok(Found::Absent(span.end, format!("\n{key} = "))),
        Some(b'{') if table.get_ref().as_table().is_some_and(|t| !t.is_empty()) => {
            let last = table
                .get_ref()
                .as_table()
                .and_then(|t| t.values().map(|v| v.span().end).max());
            Ok(Found::Absent(
                last.unwrap_or(span.end),
                format!(", {key} = "),
            ))
        }
        _ => Err((
            format!("the case leaves `{key}` out"),
            "write it in the case with any value".to_owned(),
        )),
    }
}

/// The text with its edits, which do not overlap.
pub(crate) fn apply(source: &str, mut edits: Edits) -> String {
    edits.sort_by_key(|(span, _)| (span.start, span.end));
    let mut text = String::with_capacity(source.len() + 64 * edits.len());
    let mut from = 0;
    for (span, new) in edits {
        text.push_str(source.get(from..span.start).unwrap_or_default());
        text.push_str(&new);
        from = span.end;
    }
    text.push_str(source.get(from..).unwrap_or_default());
    text
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const CASE: &str = "[[building]]\nname = \"light\"\nmass = [1, \"2 t\"]\n\n[[gap]] # the gap\nbetween = [\"light\", \"wall\"]\nwidth = \"20 mm\"   # as built\nmodel = \"hertz_1882\"\nstiffness = 1e9\n\n[ground_motion]\nfile = \"a.csv\"\nscale = { pga = 3 }\n";

    fn edited(path: &str, new: &str) -> String {
        let place = entry(CASE, &Path::parse(path).unwrap()).unwrap();
        apply(CASE, vec![(place.span, format!("{}{new}", place.before))])
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
    fn wrong_paths_say_what_there_is() {
        let lost = |path: &str| find(CASE, &Path::parse(path).unwrap()).unwrap_err();
        assert!(
            lost("gap.lihgt-wall.width")
                .1
                .contains("did you mean `light-wall`")
        );
        assert!(lost("gap.3.width").0.contains("1 entry,"));
        assert!(lost("gaps.0.width").1.contains("gap"));
        assert!(lost("gap.0.width.1").0.contains("single value"));
        assert!(lost("analysis.step").0.contains("no `analysis`"));
    }

    #[test]
    fn options_of_the_model_are_told_from_those_of_the_gap() {
        let (places, header) = options_of_gap(CASE, &Path::parse("gap.0").unwrap()).unwrap();
        let texts: Vec<&str> = places.iter().map(|p| &CASE[p.clone()]).collect();
        assert_eq!(texts, ["model = \"hertz_1882\"", "stiffness = 1e9"]);
        assert!(CASE[..header].ends_with("[[gap]]"));
        let (places, _) = options_of_motion(CASE, &["scale"]).unwrap();
        assert_eq!(&CASE[places[0].clone()], "file = \"a.csv\"");
        assert_eq!(places.len(), 1);
    }
}
