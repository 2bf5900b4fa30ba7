//! Tables, whose columns say where their numbers come from.
//!
//! The attribute `data-from` of a heading names the numbers of the column in the result file
//! or in what the command prints with `--json`: a path in which `*` stands for the
//! `data-row` of the row, or two such paths whose quotient is shown. `data-factor` is what
//! they are multiplied with, or `unit` where the head of the row says the unit. Tests follow them, and so may a reader.

use super::html::escaped;

/// Where the numbers of a column come from.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Source {
    /// Path, or two with ` / ` between them.
    from: String,
    /// What the numbers are multiplied with.
    factor: f64,
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Column {
    /// Heading of this column and those beside it with the same; empty without.
    group: String,
    heading: String,
    source: Option<Source>,
    /// Path of the words that a cell has, where it has no number.
    words: String,
    /// Whether its numbers are numbers of things.
    counts: bool,
}

impl Column {
    /// A column of words, or of numbers that are in no file.
    pub(super) fn new(heading: impl Into<String>) -> Self {
        Self {
            group: String::new(),
            heading: heading.into(),
            source: None,
            words: String::new(),
            counts: false,
        }
    }

    /// Numbers of things of that path.
    pub(super) fn count_of(heading: impl Into<String>, from: impl Into<String>) -> Self {
        Self {
            counts: true,
            ..Self::of(heading, from, 1.0)
        }
    }

    /// Whether its numbers are numbers of things.
    pub(super) fn counts(&self) -> bool {
        self.counts
    }

    /// Words of that path.
    pub(super) fn words_of(heading: impl Into<String>, path: impl Into<String>) -> Self {
        Self {
            words: path.into(),
            ..Self::new(heading)
        }
    }

    /// Path and factor of its numbers.
    pub(super) fn source(&self) -> Option<(&str, f64)> {
        let source = self.source.as_ref();
        source.map(|s| (s.from.as_str(), s.factor))
    }

    /// Path of its words.
    pub(super) fn words(&self) -> &str {
        &self.words
    }

    /// Numbers of that path, times a factor.
    pub(super) fn of(heading: impl Into<String>, from: impl Into<String>, factor: f64) -> Self {
        let source = Source {
            from: from.into(),
            factor,
        };
        Self {
            source: Some(source),
            ..Self::new(heading)
        }
    }

    /// Numbers of that path in the unit that the head of each row names.
    pub(super) fn in_unit_of_row(heading: impl Into<String>, from: impl Into<String>) -> Self {
        // Not a number: tests and readers take the factor of the unit.
        Self::of(heading, from, f64::NAN)
    }

    /// The same below a heading that it shares with its neighbours.
    pub(super) fn below(self, group: impl Into<String>) -> Self {
        Self {
            group: group.into(),
            ..self
        }
    }

    fn class(&self) -> &'static str {
        match self.words.is_empty() {
            true => "",
            false => " class=\"words\"",
        }
    }

    fn head(&self, spans: bool) -> String {
        let source = self.source.as_ref().map(|s| {
            let factor = match s.factor {
                1.0 => String::new(),
                unit if unit.is_nan() => " data-factor=\"unit\"".to_owned(),
                factor => format!(" data-factor=\"{factor:e}\""),
            };
            format!(" data-from=\"{}\"{factor}", escaped(&s.from))
        });
        let source = source.unwrap_or_default();
        let rows = if spans { " rowspan=\"2\"" } else { "" };
        let class = self.class();
        format!(
            "<th scope=\"col\"{rows}{class}{source}>{}</th>",
            escaped(&self.heading)
        )
    }
}

/// A row: what stands for `*` in the paths of the columns, and its cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    index: String,
    cells: Vec<String>,
}

impl Row {
    /// Row of an array.
    pub(super) fn new(index: impl ToString, cells: Vec<String>) -> Self {
        Self {
            index: index.to_string(),
            cells,
        }
    }
}

/// A table with a heading above each column; the first cell of a row heads it.
pub(super) fn table(name: &str, columns: &[Column], rows: impl IntoIterator<Item = Row>) -> String {
    let mut out = begin(name);
    out.push_str(&format!("<thead>\n{}</thead>\n<tbody>\n", head(columns)));
    for row in rows {
        out.push_str(&format!("<tr data-row=\"{}\">", escaped(&row.index)));
        out.push_str(&cells(&row.cells, columns));
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table></div>\n");
    out
}

/// A table of names and values.
pub(super) fn facts(name: &str, rows: &[(&str, String)]) -> String {
    let mut out = begin(name);
    out.push_str("<tbody class=\"facts\">\n");
    for (fact, value) in rows.iter().filter(|(_, value)| !value.is_empty()) {
        let row = cells(&[(*fact).to_owned(), value.clone()], &[]);
        out.push_str(&format!("<tr>{row}</tr>\n"));
    }
    out.push_str("</tbody>\n</table></div>\n");
    out
}

fn begin(name: &str) -> String {
    let name = escaped(name);
    format!("<div class=\"wide\" role=\"region\" tabindex=\"0\" aria-label=\"{name}\"><table>\n")
}

fn head(columns: &[Column]) -> String {
    if columns.iter().all(|c| c.group.is_empty()) {
        let cells: String = columns.iter().map(|c| c.head(false)).collect();
        return format!("<tr>{cells}</tr>\n");
    }
    let (mut above, mut below) = (String::new(), String::new());
    for group in columns.chunk_by(|a, b| !a.group.is_empty() && a.group == b.group) {
        if group[0].group.is_empty() {
            above.push_str(&group[0].head(true));
            continue;
        }
        let (count, name) = (group.len(), escaped(&group[0].group));
        above.push_str(&format!(
            "<th scope=\"colgroup\" colspan=\"{count}\">{name}</th>"
        ));
        below.extend(group.iter().map(|c| c.head(false)));
    }
    format!("<tr>{above}</tr>\n<tr>{below}</tr>\n")
}

fn cells(cells: &[String], columns: &[Column]) -> String {
    let mut out = String::new();
    for (i, cell) in cells.iter().enumerate() {
        let cell = escaped(cell);
        out.push_str(&match i {
            0 => format!("<th scope=\"row\">{cell}</th>"),
            _ => {
                let class = columns.get(i).map_or("", Column::class);
                format!("<td{class}>{cell}</td>")
            }
        });
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_and_cells() {
        let columns = [
            Column::new("a<"),
            Column::of("b", "/x/*/y", 1.0e3).below("both"),
            Column::of("c", "/x/*/z", 1.0).below("both"),
        ];
        let row = Row::new(4, ["<b>", "2", "3"].map(str::to_owned).to_vec());
        let html = table("a table", &columns, [row]);
        for part in [
            "<tr><th scope=\"col\" rowspan=\"2\">a&lt;</th><th scope=\"colgroup\" colspan=\"2\">both</th></tr>",
            "<tr><th scope=\"col\" data-from=\"/x/*/y\" data-factor=\"1e3\">b</th><th scope=\"col\" data-from=\"/x/*/z\">c</th></tr>",
            "<tr data-row=\"4\"><th scope=\"row\">&lt;b&gt;</th><td>2</td><td>3</td></tr>",
        ] {
            assert!(html.contains(part), "{html}");
        }
    }
}
