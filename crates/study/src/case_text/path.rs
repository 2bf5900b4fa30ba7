//! Where entries stand: `gap.0.width`, `gap["light-heavy"].width`, `building.light.mass`, `gap.*.width`.

use std::fmt;

/// One step into a table or a list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Step {
    /// A key of a table, or the name of a table in a list of tables.
    Key(String),
    /// The name of a table in a list of tables that is this number, or else a place in a list.
    Number(usize),
    /// A place in a list, from zero.
    Index(usize),
    /// Every place in a list, `*`.
    Each,
}

/// A number as it is counted: names may have leading zeros or a sign.
fn index(word: &str) -> Option<usize> {
    let number: usize = word.parse().ok()?;
    (number.to_string() == word).then_some(number)
}

/// The way from the root to an entry.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Path(pub Vec<Step>);

impl Path {
    /// Reads `gap.0.width` or `gap["light-heavy"].width`; the reason if it cannot.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let mut steps = Vec::new();
        let mut rest = text.trim();
        loop {
            if let Some(inner) = rest.strip_prefix('[') {
                let (name, after) = inner
                    .split_once(']')
                    .ok_or_else(|| "a bracket is not closed".to_owned())?;
                let quoted = name.len() >= 2 && name.starts_with('"') && name.ends_with('"');
                steps.push(match index(name) {
                    Some(index) => Step::Index(index),
                    None if name == "*" => Step::Each,
                    None if quoted => Step::Key(name[1..name.len() - 1].to_owned()),
                    None => {
                        return Err(format!(
                            "[{name}] is neither a number, nor a name in quotes, nor *"
                        ));
                    }
                });
                rest = after;
            } else {
                let end = rest.find(['.', '[']).unwrap_or(rest.len());
                let word = &rest[..end];
                if word.is_empty() {
                    return Err("a name is empty".to_owned());
                }
                steps.push(match index(word) {
                    Some(index) => Step::Number(index),
                    None if word == "*" => Step::Each,
                    None => Step::Key(word.to_owned()),
                });
                rest = &rest[end..];
            }
            if rest.is_empty() {
                return Ok(Self(steps));
            }
            // A dot may lead to a bracket or a name; a bracket needs none.
            if let Some(after) = rest.strip_prefix('.') {
                rest = after;
            } else if !rest.starts_with('[') {
                return Err(format!("\"{rest}\" cannot follow a bracket"));
            }
        }
    }

    /// Whether it leads to something of a gap that changes neither buildings nor motion, nor
    /// which floors may touch.
    pub(crate) fn of_gap(&self) -> bool {
        let shapes = ["levels", "elevation_tolerance", "column"];
        self.table() == "gap" && !shapes.iter().any(|key| self.leads_through(key))
    }

    /// Whether it leads to the name of a model or law.
    pub(crate) fn of_model(&self) -> bool {
        self.0.last() == Some(&Step::Key("model".to_owned()))
    }

    /// Whether it leads to the file of the motion.
    pub(crate) fn of_motion_file(&self) -> bool {
        self.to_string() == "ground_motion.file"
    }

    /// Whether it leads to the scale of the motion.
    pub(crate) fn of_scale(&self) -> bool {
        self.table() == "ground_motion" && self.0.get(1) == Some(&Step::Key("scale".to_owned()))
    }

    /// Whether it leads to something that says how the record along the row is read.
    pub(crate) fn of_reading(&self) -> bool {
        let across = Step::Key("across".to_owned());
        self.table() == "ground_motion" && !self.of_scale() && self.0.get(1) != Some(&across)
    }

    /// Whether it leads to a title, or to what decides of histories alone, which a study does not keep.
    pub(crate) fn without_effect(&self) -> bool {
        ["title", "analysis.output_step"].contains(&&*self.to_string())
    }

    /// Whether it leads to what `gap` asks of a code, of which no result of a study tells.
    pub(crate) fn without_result(&self) -> bool {
        self.table() == "separation"
    }

    /// Whether it leads to the seat of a gap.
    pub(crate) fn of_seat(&self) -> bool {
        self.table() == "gap" && self.leads_through("seat")
    }

    /// The key of a method that it leads to, `step` of `analysis.step`.
    pub(crate) fn of_method_key(&self) -> Option<&str> {
        match self.0.as_slice() {
            [_, Step::Key(key)] if self.table() == "analysis" => Some(key),
            _ => None,
        }
    }

    /// Whether it leads to the elevations of floors.
    pub(crate) fn of_elevations(&self) -> bool {
        let heights = ["height", "elevations"];
        self.table() == "building" && heights.iter().any(|key| self.leads_through(key))
    }

    /// Whether it leads to something by which contact points of floors that turn in plan lie.
    pub(crate) fn of_plan(&self) -> bool {
        let of = |table, key| self.table() == table && self.leads_through(key);
        of("building", "plan") || of("gap", "points")
    }

    /// Whether it is that of the number of storeys of a building.
    pub(crate) fn of_storey_count(&self) -> bool {
        self.table() == "building"
            && matches!(self.0.as_slice(), [_, _, Step::Key(key)] if key == "storeys")
    }

    /// Whether it leads through an entry of this key, below the table of a building, a gap or a link, which may be called so.
    pub(crate) fn leads_through(&self, key: &str) -> bool {
        let key = Step::Key(key.to_owned());
        self.0.iter().skip(2).any(|step| *step == key)
    }

    /// Name of the building or the gap that it leads into, out of those of the case in
    /// their order; `None` if it names none of them.
    pub(crate) fn second<'n>(&self, names: impl Iterator<Item = &'n str>) -> Option<String> {
        let names: Vec<&str> = names.collect();
        let (name, index) = match self.0.get(1)? {
            Step::Index(index) => return names.get(*index).map(|name| (*name).to_owned()),
            Step::Number(index) => (&index.to_string(), Some(*index)),
            Step::Key(key) => (key, None),
            Step::Each => return None,
        };
        let named = names.iter().find(|n| *n == name);
        let name = named.or_else(|| names.get(index?));
        name.map(|name| (*name).to_owned())
    }

    /// Whose numbers are places, whatever is called so.
    pub(crate) fn counted(self) -> Self {
        let counted = |step| match step {
            Step::Number(index) => Step::Index(index),
            step => step,
        };
        Self(self.0.into_iter().map(counted).collect())
    }

    /// The first step, if it is a key.
    pub(crate) fn table(&self) -> &str {
        match self.0.first() {
            Some(Step::Key(key)) => key,
            _ => "",
        }
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Number(n) if i == 0 => write!(f, "{n}")?,
                Step::Number(n) => write!(f, ".{n}")?,
                Step::Index(n) => write!(f, "[{n}]")?,
                Step::Each if i == 0 => f.write_str("*")?,
                Step::Each => f.write_str(".*")?,
                Step::Key(key) => {
                    let plain = key.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
                        && index(key).is_none();
                    match (plain, i) {
                        (true, 0) => f.write_str(key)?,
                        (true, _) => write!(f, ".{key}")?,
                        (false, _) => write!(f, "[\"{key}\"]")?,
                    }
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn paths_are_read() {
        let key = |k: &str| Step::Key(k.to_owned());
        for (text, steps, shown) in [
            (
                "gap.0.width",
                vec![key("gap"), Step::Number(0), key("width")],
                "gap.0.width",
            ),
            (
                "gap[0].width",
                vec![key("gap"), Step::Index(0), key("width")],
                "gap[0].width",
            ),
            (
                "gap[\"light-heavy\"].width",
                vec![key("gap"), key("light-heavy"), key("width")],
                "gap[\"light-heavy\"].width",
            ),
            (
                "building.light.mass.2",
                vec![key("building"), key("light"), key("mass"), Step::Number(2)],
                "building.light.mass.2",
            ),
            (
                "gap[*].width",
                vec![key("gap"), Step::Each, key("width")],
                "gap.*.width",
            ),
            (
                "building[\"*\"].mass",
                vec![key("building"), key("*"), key("mass")],
                "building[\"*\"].mass",
            ),
            (
                "building[\"1\"].mass",
                vec![key("building"), key("1"), key("mass")],
                "building[\"1\"].mass",
            ),
            (
                "building.01.mass",
                vec![key("building"), key("01"), key("mass")],
                "building.01.mass",
            ),
        ] {
            let path = Path::parse(text).unwrap();
            assert_eq!(path.0, steps);
            assert_eq!(path.to_string(), shown);
            assert_eq!(Path::parse(shown).unwrap(), path);
        }
        for wrong in [
            "",
            "gap..width",
            "gap[light].width",
            "gap[0",
            "gap[0]width",
            ".",
        ] {
            assert!(Path::parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn names_go_before_numbers() {
        let second = |path: &str, names: &[&str]| {
            let path = Path::parse(path).unwrap();
            path.second(names.iter().copied()).unwrap_or_default()
        };
        assert_eq!(second("building.2.height", &["1", "2"]), "2");
        assert_eq!(second("building.0.height", &["1", "2"]), "1");
        assert_eq!(second("building[1].height", &["1", "2"]), "2");
        assert_eq!(second("building[\"1\"].height", &["1", "2"]), "1");
        assert_eq!(second("building.1.height", &["a", "b"]), "b");
        assert_eq!(second("building.2.height", &["a", "b"]), "");
    }
}
