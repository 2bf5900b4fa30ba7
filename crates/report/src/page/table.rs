//! Tables, whose columns say where their numbers come from.
//!
//! The attribute `data-from` of a heading names the numbers of the column in the result file
//! or in what the command prints with `--json`: a path in which `*` stands for the
//! `data-row` of the row, or two such paths whose quotient is shown. `data-factor` is what
//! they are multiplied with, or `unit` where the head of the row says the unit. Tests follow them, and so may a reader.

use super::html::{escaped, named};

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
            named(&self.heading)
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

/// A table with a heading above each column; the first cell of a row heads it. One that is too
/// wide for paper is printed in parts, each with the columns that tell its rows.
pub(super) fn table(name: &str, columns: &[Column], rows: impl IntoIterator<Item = Row>) -> String {
    let rows: Vec<Row> = rows.into_iter().collect();
    let parts = parts(columns, &rows);
    let all: Vec<usize> = (0..columns.len()).collect();
    if parts.len() < 2 {
        return begin(name, "wide") + &part(columns, &rows, &all) + "</div>\n";
    }
    let mut out = begin(name, "wide on-screen") + &part(columns, &rows, &all) + "</div>\n";
    out.push_str("<div class=\"on-paper\">");
    out.extend(parts.iter().map(|shown| part(columns, &rows, shown)));
    out.push_str("</div>\n");
    out
}

/// These columns of a table.
fn part(columns: &[Column], rows: &[Row], shown: &[usize]) -> String {
    let columns: Vec<Column> = shown.iter().map(|c| columns[*c].clone()).collect();
    let head = head(&columns);
    let mut out = format!("<table>\n<thead>\n{head}</thead>\n<tbody>\n");
    for row in rows {
        let of_row = shown.iter().filter_map(|c| row.cells.get(*c));
        let of_row: Vec<&str> = of_row.map(String::as_str).collect();
        out.push_str(&format!("<tr data-row=\"{}\">", escaped(&row.index)));
        out.push_str(&cells(&of_row, &columns));
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table>");
    out
}

/// Width of a sheet of A4 between its margins, of a cell without its text and of the size of the
/// text (px), as `page.css` has them for print.
const PAPER: f64 = 703.0;
const PADDING: f64 = 6.7;
const TEXT: f64 = 9.33;

/// The columns of every part of a table that has room on paper, each with those that tell its
/// rows; what stands below one heading stays together where it can.
fn parts(columns: &[Column], rows: &[Row]) -> Vec<Vec<usize>> {
    let widths: Vec<f64> = (0..columns.len())
        .map(|c| least_width(columns, rows, c))
        .collect();
    let wide = |columns: &[usize]| columns.iter().map(|c| widths[*c]).sum::<f64>();
    let heads = heads(columns, &widths);
    let indices: Vec<usize> = (heads.len()..columns.len()).collect();
    let below_one = |a: &usize, b: &usize| {
        let group = &columns[*a].group;
        !group.is_empty() && *group == columns[*b].group
    };
    let mut parts = Vec::new();
    let mut part = heads.clone();
    for group in indices.chunk_by(below_one) {
        // One that no sheet has room for is divided where it stands.
        let fits = wide(&heads) + wide(group) <= PAPER;
        let together = if fits { group.len() } else { 1 };
        for columns in group.chunks(together) {
            if wide(&part) + wide(columns) > PAPER && part.len() > heads.len() {
                parts.push(std::mem::replace(&mut part, heads.clone()));
            }
            part.extend(columns);
        }
    }
    parts.push(part);
    parts
}

/// The columns that stand in every part: those before any common heading, unless they are wide, or
/// the first.
fn heads(columns: &[Column], widths: &[f64]) -> Vec<usize> {
    let before = columns.iter().take_while(|c| c.group.is_empty()).count();
    let wide: f64 = widths.iter().take(before).sum();
    match before < columns.len() && wide <= PAPER / 3.0 {
        true => (0..before.max(1)).collect(),
        false => (0..columns.len().min(1)).collect(),
    }
}

/// The width below which a column does not get on paper (px): headings, heads of rows and words
/// stand in lines, numbers do not.
fn least_width(columns: &[Column], rows: &[Row], number: usize) -> f64 {
    let column = &columns[number];
    let longest = |text: &str| {
        let words = text.split_whitespace().map(width_of);
        words.fold(0.0, f64::max)
    };
    let in_lines = number == 0 || !column.words.is_empty();
    let of_cell = |row: &Row| {
        let cell = row.cells.get(number).map_or("", String::as_str);
        match in_lines {
            true => longest(cell),
            false => width_of(cell),
        }
    };
    // Headings are bold.
    let heading = 1.1 * longest(&column.heading);
    PADDING + TEXT * rows.iter().map(of_cell).fold(heading, f64::max)
}

/// Width of a text over its size, in a face of wide letters.
fn width_of(text: &str) -> f64 {
    let letter = |c: char| match c {
        '.' | ',' | ':' | ';' | '|' | '!' | '\'' | 'i' | 'j' | 'l' | 'I' | ' ' => 0.33,
        '-' | '(' | ')' | '/' | 'f' | 'r' | 't' => 0.41,
        'm' | 'w' | 'M' | 'W' | '%' => 0.97,
        '\u{2e80}'.. => 1.0,
        _ => 0.63,
    };
    text.chars().map(letter).sum()
}

/// A table of names and values.
pub(super) fn facts(name: &str, rows: &[(&str, String)]) -> String {
    let mut out = begin(name, "wide") + "<table>\n<tbody class=\"facts\">\n";
    for (fact, value) in rows.iter().filter(|(_, value)| !value.is_empty()) {
        let row = cells(&[fact, value], &[]);
        out.push_str(&format!("<tr>{row}</tr>\n"));
    }
    out.push_str("</tbody>\n</table></div>\n");
    out
}

fn begin(name: &str, class: &str) -> String {
    let name = escaped(name);
    format!("<div class=\"{class}\" role=\"region\" tabindex=\"0\" aria-label=\"{name}\">")
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
        let (count, name) = (group.len(), named(&group[0].group));
        above.push_str(&format!(
            "<th scope=\"colgroup\" colspan=\"{count}\">{name}</th>"
        ));
        below.extend(group.iter().map(|c| c.head(false)));
    }
    format!("<tr>{above}</tr>\n<tr>{below}</tr>\n")
}

fn cells(cells: &[&str], columns: &[Column]) -> String {
    let mut out = String::new();
    for (i, text) in cells.iter().enumerate() {
        let cell = named(text);
        out.push_str(&match i {
            // Words of the head of a row stand in lines; a number does not end at the minus of its power.
            0 if text.contains('-') && text.parse::<f64>().is_ok() => {
                format!("<th scope=\"row\" class=\"number\">{cell}</th>")
            }
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
        // It has room on paper.
        assert!(!html.contains("on-paper"), "{html}");
    }

    /// A table that no sheet has room for is printed in parts that leave out no column, and what
    /// stands below one heading stays together.
    #[test]
    fn wide_tables_are_printed_in_parts() {
        let columns = |count: usize| -> Vec<Column> {
            let of = |b: usize| {
                let group = format!("building {b}");
                ["displacement", "acceleration", "shear"].map(|what| {
                    Column::of(what, format!("/x/*/{b}/{what}"), 1.0).below(group.clone())
                })
            };
            let heads = ["number", "width (mm)"].map(Column::new).into_iter();
            heads.chain((0..count).flat_map(of)).collect()
        };
        let row = |count: usize| {
            let cells = (0..2 + 3 * count).map(|i| format!("{}.5", 100 + i));
            Row::new(0, cells.collect())
        };
        let many = columns(12);
        let parts = parts(&many, &[row(12)]);
        assert!(parts.len() > 2, "{parts:?}");
        for part in &parts {
            let wide: f64 = part
                .iter()
                .map(|c| least_width(&many, &[row(12)], *c))
                .sum();
            assert!(part[..2] == [0, 1] && wide <= PAPER, "{part:?} {wide}");
            assert_eq!((part.len() - 2) % 3, 0, "{part:?}");
        }
        let printed: Vec<usize> = parts.iter().flat_map(|part| &part[2..]).copied().collect();
        assert_eq!(printed, (2..38).collect::<Vec<_>>());
        let html = table("t", &many, [row(12)]);
        let (screen, paper) = html
            .split_once("<div class=\"on-paper\">")
            .unwrap_or_default();
        assert_eq!(screen.matches("building 11").count(), 1);
        assert_eq!(paper.matches("building 11").count(), 1);
        assert_eq!(
            paper.matches("<th scope=\"row\">100.5</th>").count(),
            parts.len()
        );
        assert!(!table("t", &columns(2), [row(2)]).contains("on-paper"));
    }

    /// Numbers at the head of a row are kept in one line, as those of cells.
    #[test]
    fn numbers_are_not_broken() {
        let cell = cells(&["7.184e-6", "2"], &[]);
        assert_eq!(
            cell,
            "<th scope=\"row\" class=\"number\">7.184e-6</th><td>2</td>"
        );
        for text in ["a-6", "12"] {
            assert!(cells(&[text], &[]).starts_with("<th scope=\"row\">"));
        }
    }
}
