//! Paths to several entries: `gap.*.width`, and all numbers of a list.

use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use super::edits::{Edit, Entry, Lost, find, no_list, replaceable, text_agrees, tree};
use super::identity::number;
use super::path::{Path, Step};

/// An entry of a case, with the path to it.
pub(crate) type Found = (Path, Arc<Entry>);

/// The entries that a path leads to: one, or with `*` one for each of a list.
pub(crate) fn entries(source: &str, path: &Path) -> Result<Vec<Found>, Lost> {
    let tree = tree(source)?;
    sound(source, &tree, each(source, &tree, path)?)
}

/// The numbers that a path leads to, also within lists, each with its value (SI).
pub(crate) fn numbers(source: &str, path: &Path) -> Result<Vec<(Found, f64)>, Lost> {
    let tree = tree(source)?;
    let mut numbers = Vec::new();
    for (path, entry) in each(source, &tree, path)? {
        numbers_within(source, &tree, path, entry, &mut numbers)?;
    }
    let entries = numbers.iter().map(|(found, _)| found.clone());
    sound(source, &tree, entries.collect())?;
    Ok(numbers)
}

/// Follows a path to each of its entries.
fn each(source: &str, tree: &DeTable<'_>, path: &Path) -> Result<Vec<Found>, Lost> {
    let Some(star) = path.0.iter().position(|step| *step == Step::Each) else {
        let entry = find(source, tree, path)?;
        return Ok(vec![(path.clone(), Arc::new(entry))]);
    };
    let list = Path(path.0[..star].to_vec());
    if list.0.is_empty() {
        return Err(no_list(path));
    }
    let way = find(source, tree, &list)?.path;
    let Some(DeValue::Array(items)) = value(tree, &way) else {
        return Err(no_list(&list));
    };
    let rest = &path.0[star + 1..];
    let of_item = |place: usize| {
        let steps = list.0.iter().cloned().chain([Step::Index(place)]);
        each(
            source,
            tree,
            &Path(steps.chain(rest.iter().cloned()).collect()),
        )
    };
    let found: Result<Vec<_>, Lost> = (0..items.len()).map(of_item).collect();
    let found = found?.concat();
    match found.is_empty() {
        true => Err((
            format!("`{list}` is an empty list in the case"),
            "name entries that the case has".to_owned(),
        )),
        false => Ok(found),
    }
}

/// The value at the end of a way without names.
fn value<'t, 's>(tree: &'t DeTable<'s>, way: &Path) -> Option<&'t DeValue<'s>> {
    let mut steps = way.0.iter();
    let Step::Key(root) = steps.next()? else {
        return None;
    };
    let mut value = tree.get(root.as_str())?.get_ref();
    for step in steps {
        value = match (value, step) {
            (DeValue::Table(table), Step::Key(key)) => table.get(key.as_str())?.get_ref(),
            (DeValue::Array(items), Step::Index(index)) => items.get(*index)?.get_ref(),
            _ => return None,
        };
    }
    Some(value)
}

/// Collects an entry that is a number, or the numbers of a list.
fn numbers_within(
    source: &str,
    tree: &DeTable<'_>,
    path: Path,
    entry: Arc<Entry>,
    numbers: &mut Vec<(Found, f64)>,
) -> Result<(), Lost> {
    let Some(value) = value(tree, &entry.path) else {
        return Err((
            format!("the case leaves `{path}` out, of which nothing is a multiple"),
            "write it in the case, or remove `relative` and give values".to_owned(),
        ));
    };
    if let DeValue::Array(items) = value {
        for place in 0..items.len() {
            let inner = Path(path.0.iter().cloned().chain([Step::Index(place)]).collect());
            let entry = Arc::new(find(source, tree, &inner)?);
            numbers_within(source, tree, inner, entry, numbers)?;
        }
        return Ok(());
    }
    match number(value) {
        Some(x) if x.is_finite() => {
            numbers.push(((path, entry), x));
            Ok(())
        }
        _ => Err((
            format!("`{path}` is no number in the case, of which there are no multiples"),
            "name numbers of the case, such as building.light.stiffness".to_owned(),
        )),
    }
}

/// The entries, if the text of each can be replaced.
fn sound(source: &str, tree: &DeTable<'_>, found: Vec<Found>) -> Result<Vec<Found>, Lost> {
    let edits: Vec<Edit> = found
        .iter()
        .map(|(_, entry)| Edit::new(entry, "0"))
        .collect();
    // All at once: of long lists each by itself would take its time.
    if !text_agrees(source, tree, &edits) {
        for (path, entry) in &found {
            replaceable(source, tree, path, entry)?;
        }
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::edits::apply;
    use super::*;

    const CASE: &str = "[[building]]\nname = \"a\"\nmass = [1, \"2 t\"]\n[[building]]\nname = \"*\"\nmass = 3\nlaw = [{ model = \"bilinear\", yield_force = [4, 5] }]\n\n[[gap]]\nbetween = [\"a\", \"*\"]\nwidth = \"20 mm\"\n[[gap]]\nname = \"0\"\nwidth = 1e-2\n";

    fn edited(path: &str) -> String {
        let found = entries(CASE, &Path::parse(path).unwrap()).unwrap();
        let edits: Vec<Edit> = found.iter().map(|(_, e)| Edit::new(e, "7")).collect();
        apply(CASE, &edits)
    }

    #[test]
    fn a_star_stands_for_each() {
        let widths = CASE.replace("\"20 mm\"", "7").replace("1e-2", "7");
        assert_eq!(edited("gap.*.width"), widths);
        assert_eq!(edited("gap[*].width"), widths);
        let masses = CASE
            .replace("[1, \"2 t\"]", "7")
            .replace("mass = 3", "mass = 7");
        assert_eq!(edited("building.*.mass"), masses);
        assert_eq!(
            edited("building.a.mass.*"),
            CASE.replace("1, \"2 t\"", "7, 7")
        );
        assert_eq!(
            edited("building[\"*\"].law.*.yield_force.*"),
            CASE.replace("4, 5", "7, 7")
        );
        // What they leave out is put in.
        assert_eq!(
            edited("gap.*.restitution"),
            CASE.replace("[[gap]]", "[[gap]]\nrestitution = 7")
        );
    }

    #[test]
    fn stars_without_a_list_are_refused() {
        let lost = |path: &str| entries(CASE, &Path::parse(path).unwrap()).unwrap_err().0;
        assert!(lost("building.*.mass.*").contains("`building[1].mass` is no list"));
        assert!(lost("*.width").contains("is no list"));
        assert!(lost("gap[0].*").contains("`gap[0]` is no list"));
        assert!(lost("link.*.stiffness").contains("no `link`"));
        assert!(lost("gap.*.width.*").contains("is no list"));
    }

    #[test]
    fn numbers_have_their_values() {
        let numbers = |path: &str| numbers(CASE, &Path::parse(path).unwrap());
        let values = |path: &str| -> Vec<f64> {
            let numbers = numbers(path).unwrap();
            numbers.into_iter().map(|(_, value)| value).collect()
        };
        assert_eq!(values("building.*.mass"), [1.0, 2000.0, 3.0]);
        assert_eq!(values("gap.*.width"), [0.02, 0.01]);
        assert_eq!(values("building.1.law.0.yield_force"), [4.0, 5.0]);
        assert!(
            numbers("building.*.height")
                .unwrap_err()
                .0
                .contains("leaves")
        );
        assert!(
            numbers("building.*.name")
                .unwrap_err()
                .0
                .contains("no number")
        );
        assert!(
            numbers("building.1.law")
                .unwrap_err()
                .0
                .contains("no number")
        );
    }
}
