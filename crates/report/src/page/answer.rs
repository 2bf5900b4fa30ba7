//! What a command answers with `--json`, as tables and sentences of a page: every number is
//! taken from its place there by the path that the page shows as its `data-from`.
//!
//! A path is a JSON pointer in which `*` stands for the row of a table and `+` for all
//! members of a list. `count`, `sum`, `minimum` or `maximum` may stand before one, and two
//! with ` / ` between them are divided. `tally` before the path of words counts those that are the same.

use pounding_catalogue::{STANDARD_GRAVITY, numbers};
use serde_json::Value;

use super::html::{self, named};
use super::numbers::{figures, figures_of};
use super::table::{Column, Row, table};

/// The object that a command prints.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer<'a>(pub &'a Value);

impl<'a> Answer<'a> {
    /// All members of a path, in order; nothing where one is absent.
    fn all(self, path: &str, row: &str) -> Vec<&'a Value> {
        let mut found = vec![self.0];
        for part in path.replace('*', row).split('/').skip(1) {
            let next = |value: &'a Value| -> Vec<&'a Value> {
                match (part, value) {
                    ("+", Value::Array(list)) => list.iter().collect(),
                    ("+", Value::Object(map)) => map.values().collect(),
                    (index, Value::Array(list)) => {
                        let place = index.parse::<usize>().ok();
                        place.and_then(|i| list.get(i)).into_iter().collect()
                    }
                    (key, Value::Object(map)) => map.get(key).into_iter().collect(),
                    _ => Vec::new(),
                }
            };
            found = found.into_iter().flat_map(next).collect();
        }
        found
    }

    /// One member; `null` where there is none.
    pub(super) fn at(self, path: &str) -> &'a Value {
        self.all(path, "").first().copied().unwrap_or(&Value::Null)
    }

    /// Members of a list; none of anything else.
    pub(super) fn list(self, path: &str) -> &'a [Value] {
        self.at(path).as_array().map_or(&[], Vec::as_slice)
    }

    /// The text of a path; empty for anything else.
    pub(super) fn text(self, path: &str) -> &'a str {
        self.at(path).as_str().unwrap_or_default()
    }

    /// The number of a source for a row; NaN where there is none.
    pub(super) fn number(self, source: &str, row: &str) -> f64 {
        if let Some((above, below)) = source.split_once(" / ") {
            return self.number(above, row) / self.number(below, row);
        }
        let numbers = |path: &str| {
            let values = self.all(path, row).into_iter().filter_map(Value::as_f64);
            values.collect::<Vec<f64>>()
        };
        match source.split_once(' ') {
            Some(("count", path)) => self.all(path, row).len() as f64,
            // What is missing of an answer is not known: an empty list adds up to -0.
            Some(("sum", path)) => numbers(path)
                .into_iter()
                .reduce(|a, b| a + b)
                .unwrap_or(f64::NAN),
            Some(("minimum", path)) => numbers(path).into_iter().fold(f64::NAN, f64::min),
            Some(("maximum", path)) => numbers(path).into_iter().fold(f64::NAN, f64::max),
            _ => match self.all(source, row).first() {
                Some(value) => value.as_f64().unwrap_or(f64::NAN),
                None => f64::NAN,
            },
        }
    }

    /// A number in a sentence, as HTML that says where it comes from.
    pub(super) fn say(self, source: &str, factor: f64) -> String {
        let text = figures_of(source, factor * self.number(source, ""));
        html::number(source, factor, &text)
    }

    /// A part of a whole in percent, in a sentence: as many digits as it has.
    pub(super) fn say_percent(self, source: &str) -> String {
        let text = numbers::significant(1.0e2 * self.number(source, ""));
        html::number(source, 1.0e2, &text) + " %"
    }

    /// A text of the answer in a sentence, as HTML.
    pub(super) fn quote(self, path: &str) -> String {
        named(self.text(path))
    }

    /// A table of which each row is a member of a list: what stands for `*`, and its head.
    pub(super) fn table(
        self,
        name: &str,
        columns: &[Column],
        rows: impl IntoIterator<Item = (String, String)>,
    ) -> String {
        let rows = rows.into_iter().map(|(index, head)| {
            let cells = columns.iter().skip(1).map(|c| self.cell(c, &index, &head));
            Row::new(&index, std::iter::once(head.clone()).chain(cells).collect())
        });
        table(name, columns, rows)
    }

    fn cell(self, column: &Column, row: &str, head: &str) -> String {
        let Some((source, factor)) = column.source() else {
            return self.words(column.words(), row);
        };
        let factor = if factor.is_nan() {
            unit_factor(head)
        } else {
            factor
        };
        let value = factor * self.number(source, row);
        let whole = column.counts() || source.starts_with("count ") || self.is_whole(source, row);
        match whole && value.is_finite() {
            true => format!("{value}"),
            false => figures_of(&source.replace('*', row), value),
        }
    }

    /// Whether a source is a number of things.
    fn is_whole(self, source: &str, row: &str) -> bool {
        if source.contains(" / ") {
            return false;
        }
        let path = source.rsplit(' ').next().unwrap_or(source);
        self.all(path, row).iter().all(|v| v.is_u64())
    }

    /// Words of a path: texts as they are, yes and no, lists with commas, a dash for nothing.
    fn words(self, path: &str, row: &str) -> String {
        fn words(value: &Value) -> String {
            match value {
                Value::Null => "\u{2013}".to_owned(),
                Value::Bool(yes) => (if *yes { "yes" } else { "no" }).to_owned(),
                Value::String(text) => text.clone(),
                Value::Number(n) => n.to_string(),
                Value::Array(list) => list.iter().map(words).collect::<Vec<_>>().join(", "),
                Value::Object(map) => {
                    let pair = |(k, v): (&String, &Value)| {
                        let number = v.as_f64().map(figures);
                        format!("{k} {}", number.unwrap_or_else(|| words(v)))
                    };
                    map.iter().map(pair).collect::<Vec<_>>().join(", ")
                }
            }
        }
        if let Some(path) = path.strip_prefix("tally ") {
            let mut tally: Vec<(String, usize)> = Vec::new();
            for word in self.all(path, row).into_iter().map(words) {
                match tally.iter_mut().find(|(known, _)| *known == word) {
                    Some((_, times)) => *times += 1,
                    None => tally.push((word, 1)),
                }
            }
            let tally = tally
                .iter()
                .map(|(word, times)| format!("{word} ({times})"));
            let tally: Vec<String> = tally.collect();
            return match tally.is_empty() {
                true => "\u{2013}".to_owned(),
                false => tally.join(", "),
            };
        }
        let found = self.all(path, row);
        match found.is_empty() {
            true => "\u{2013}".to_owned(),
            false => found.into_iter().map(words).collect::<Vec<_>>().join(", "),
        }
    }
}

/// The name of a quantity as people say it.
pub(super) fn spoken(name: &str) -> String {
    let name = name.replace('_', " ");
    let name = name.replace("acceleration absolute", "absolute acceleration");
    name.replace("impulse max", "maximum impulse")
}

/// The factor from SI to the unit that people read, and that unit; empty for pure numbers.
pub(super) fn unit_of(unit: &str) -> (f64, &str) {
    match numbers::shown_unit(unit) {
        (factor, "-") => (factor, ""),
        (factor, "m/s2") => (factor, "m/s\u{b2}"),
        (factor, "m s-1") => (factor, "m/s"),
        (_, "kg s-2") => (1.0, "N/m"),
        (_, "kg m-0.5 s-2") => (1.0, "N/m^1.5"),
        (_, "J") => (1.0e-3, "kJ"),
        (_, "N s") => (1.0e-3, "kN s"),
        known => known,
    }
}

/// A unit as people read it, in parentheses; nothing for pure numbers.
pub(super) fn in_parentheses(unit: &str) -> String {
    match unit_of(unit).1 {
        "" => String::new(),
        shown => format!(" ({shown})"),
    }
}

/// The factor to the unit that ends the head of a row, from SI.
fn unit_factor(head: &str) -> f64 {
    let unit = head
        .rsplit_once('(')
        .and_then(|(_, unit)| unit.strip_suffix(')'));
    match unit.unwrap_or_default() {
        "mm" | "mrad" => 1.0e3,
        "cm" | "cm/s" | "%" => 1.0e2,
        "kN" | "kN m" | "kN s" | "kJ" => 1.0e-3,
        "g" => 1.0 / STANDARD_GRAVITY,
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn stiffnesses_are_in_newtons() {
        assert_eq!(in_parentheses("kg m-0.5 s-2"), " (N/m^1.5)");
        assert_eq!(in_parentheses("kg s-2"), " (N/m)");
    }

    #[test]
    fn sources_are_followed() {
        let value = json!({
            "gaps": [{ "demand": [0.1, null, 0.3], "name": "<a>" }, { "demand": [0.2] }],
            "half": 0.05,
        });
        let answer = Answer(&value);
        assert_eq!(answer.number("/gaps/*/demand/0", "1"), 0.2);
        assert_eq!(answer.number("maximum /gaps/+/demand/+", ""), 0.3);
        assert_eq!(answer.number("count /gaps/0/demand/+", ""), 3.0);
        assert_eq!(answer.number("sum /gaps/+/demand/+", ""), 0.1 + 0.3 + 0.2);
        assert!(answer.number("sum /gaps/0/demand/1", "").is_nan());
        assert!(answer.number("sum /gaps/7/demand/+", "").is_nan());
        assert_eq!(answer.number("/gaps/0/demand/0 / /half", ""), 2.0);
        assert!(answer.number("/gaps/7/demand", "").is_nan());
        assert_eq!(
            answer.say("/half", 1.0e3),
            "<data data-from=\"/half\" data-factor=\"1e3\" value=\"50.00\">50.00</data>"
        );
        let columns = [
            Column::new("gap"),
            Column::of("demand (mm)", "/gaps/*/demand/0", 1.0e3),
        ];
        let html = answer.table("gaps", &columns, [("1".to_owned(), "b".to_owned())]);
        assert!(
            html.contains("<tr data-row=\"1\"><th scope=\"row\">b</th><td>200.0</td></tr>"),
            "{html}"
        );
        assert_eq!(answer.quote("/gaps/0/name"), "&lt;a&gt;");
    }

    /// Words of two records: each stands once, with how often it is there.
    #[test]
    fn words_are_counted() {
        let value = json!({
            "of": [{ "minority": [["a", "b"], ["b"]] }, { "minority": [[], []] }]
        });
        let answer = Answer(&value);
        let path = "tally /of/*/minority/+/+";
        assert_eq!(answer.words(path, "0"), "a (1), b (2)");
        assert_eq!(answer.words(path, "1"), "\u{2013}");
    }
}
