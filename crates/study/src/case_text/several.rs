//! Paths to several entries: `gap.*.width`, and all numbers of a list.

use std::sync::Arc;

use pounding_case::parse_degrees;
use toml::de::{DeTable, DeValue};

use super::edits::{Edit, Entry, Lost, find, no_list, replaceable, text_agrees, tree, within};
use super::identity::number;
use super::path::{Path, Step};

/// An entry of a case, with the path to it.
pub(crate) type Found = (Path, Arc<Entry>);

/// A path that leads nowhere, by its place among others: why, and what to do.
pub(crate) type LostAmong = (usize, Lost);

/// The entries that each of these paths leads to: one, or with `*` one for each of a list.
pub(crate) fn entries(source: &str, paths: &[Path]) -> Result<Vec<Vec<Found>>, LostAmong> {
    let tree = tree(source).map_err(|lost| (0, lost))?;
    let among = |(i, path)| each(source, &tree, path).map_err(|lost| (i, lost));
    let found = paths.iter().enumerate().map(among);
    let found: Vec<Vec<Found>> = found.collect::<Result<_, _>>()?;
    sound(source, &tree, &found)?;
    Ok(found)
}

/// The numbers that each of these paths leads to, also within lists, and their values (SI, or degrees).
pub(crate) fn numbers(source: &str, paths: &[Path]) -> Result<Vec<Vec<(Found, f64)>>, LostAmong> {
    let tree = tree(source).map_err(|lost| (0, lost))?;
    let numbers_of = |path: &Path| {
        let mut numbers = Vec::new();
        for (path, entry) in each(source, &tree, path)? {
            numbers_within(source, &tree, path, entry, &mut numbers)?;
        }
        Ok(numbers)
    };
    let among = |(i, path)| numbers_of(path).map_err(|lost| (i, lost));
    let numbers = paths.iter().enumerate().map(among);
    let numbers: Vec<Vec<(Found, f64)>> = numbers.collect::<Result<_, _>>()?;
    let entries = |of: &Vec<(Found, f64)>| of.iter().map(|(found, _)| found.clone()).collect();
    let found: Vec<Vec<Found>> = numbers.iter().map(entries).collect();
    sound(source, &tree, &found)?;
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
        // A path begins with the name of a table.
        return find(source, tree, path).map(|_| Vec::new());
    }
    let way = find(source, tree, &list)?.path;
    let items = match value(tree, &way) {
        Some(DeValue::Array(items)) => items,
        Some(DeValue::Table(table)) => return Err(no_list(&list, Some(table))),
        Some(_) => return Err(no_list(&list, None)),
        None => {
            return Err((
                format!("the case leaves `{list}` out, of which `*` would be each entry"),
                "write it in the case".to_owned(),
            ));
        }
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
    // A plain number of an angle is of degrees.
    let degrees = || value.as_str().and_then(parse_degrees);
    if let Some(x) = number(value).or_else(degrees).filter(|x| x.is_finite()) {
        numbers.push(((path, entry), x));
        return Ok(());
    }
    Err((
        format!("`{path}` is no number in the case, of which there are no multiples"),
        match value {
            DeValue::Table(table) => format!("name its numbers, such as {}", within(&path, table)),
            _ => "name numbers of the case, such as building.light.stiffness".to_owned(),
        },
    ))
}

/// Refuses entries of which the text cannot be replaced.
fn sound(source: &str, tree: &DeTable<'_>, found: &[Vec<Found>]) -> Result<(), LostAmong> {
    let all = || {
        let found = found.iter().enumerate();
        found.flat_map(|(i, found)| found.iter().map(move |found| (i, found)))
    };
    let edits = all().map(|(_, (_, entry))| Edit::new(entry, "0"));
    let edits: Vec<Edit> = edits.collect();
    // All at once: of long lists each by itself would take its time. Where they lie within one
    // another they cannot be made together.
    if !text_agrees(source, tree, &edits) {
        for (i, (path, entry)) in all() {
            replaceable(source, tree, path, entry).map_err(|lost| (i, lost))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::super::edits::apply;
    use super::*;

    const CASE: &str = "[[building]]\nname = \"a\"\nmass = [1, \"2 t\"]\n[[building]]\nname = \"*\"\nmass = 3\nlaw = [{ model = \"bilinear\", yield_force = [4, 5] }]\n\n[[gap]]\nbetween = [\"a\", \"*\"]\nwidth = \"20 mm\"\n[[gap]]\nname = \"0\"\nwidth = 1e-2\n";

    fn edited(path: &str) -> String {
        let found = entries(CASE, &[Path::parse(path).unwrap()]).unwrap();
        let edits: Vec<Edit> = found[0].iter().map(|(_, e)| Edit::new(e, "7")).collect();
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
        let lost = |path: &str| {
            let path = Path::parse(path).unwrap();
            let refused = entries(CASE, &[Path::parse("gap[0].width").unwrap(), path]);
            let (place, lost) = refused.unwrap_err();
            assert_eq!(place, 1);
            lost
        };
        for (path, why, help) in [
            (
                "building.*.mass.*",
                "`building[1].mass` is no list",
                "`building[1].mass`",
            ),
            (
                "*.width",
                "begins with the name of a table",
                "paths begin with building, gap",
            ),
            (
                "gap[0].*",
                "`gap[0]` is a table",
                "gap[0].between, gap[0].width",
            ),
            (
                "building.a.law.*.x",
                "leaves `building.a.law` out",
                "write it",
            ),
            ("link.*.stiffness", "no `link`", "building, gap"),
            ("gap.*.width.*", "is no list", "`gap[0].width`"),
            (
                "building.a.mass.-1",
                "`building.a.mass` of the case has no `-1`",
                "2 entries",
            ),
            ("building.b.mass", "no `b`", "it has a, building[\"*\"]"),
        ] {
            let (found, remedy) = lost(path);
            assert!(
                found.contains(why) && remedy.contains(help),
                "{path}: {found}: {remedy}"
            );
        }
    }

    #[test]
    fn numbers_have_their_values() {
        let of = |case: &str, path: &str| {
            let found = numbers(case, &[Path::parse(path).unwrap()]);
            found.map(|mut all| {
                all.remove(0)
                    .into_iter()
                    .map(|(_, x)| x)
                    .collect::<Vec<f64>>()
            })
        };
        let values = |path: &str| of(CASE, path).unwrap();
        assert_eq!(values("building.*.mass"), [1.0, 2000.0, 3.0]);
        assert_eq!(values("gap.*.width"), [0.02, 0.01]);
        assert_eq!(values("building.1.law.0.yield_force"), [4.0, 5.0]);
        let other = CASE.replace("mass = 3", "mass = 0x10\nphase = \"90 deg\"");
        assert_eq!(of(&other, "building.1.mass").unwrap(), [16.0]);
        assert_eq!(of(&other, "building.1.phase").unwrap(), [90.0]);
        for (path, why, help) in [
            (
                "building.*.height",
                "leaves `building[0].height` out",
                "write it",
            ),
            ("building.*.name", "no number", "such as"),
            (
                "building.1.law",
                "no number",
                "law[0].model, building.1.law[0].yield_force",
            ),
        ] {
            let (found, remedy) = of(CASE, path).unwrap_err().1;
            assert!(
                found.contains(why) && remedy.contains(help),
                "{path}: {found}: {remedy}"
            );
        }
    }
}
