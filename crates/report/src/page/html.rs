//! Pieces of HTML.

/// A text with what HTML would take for its own written otherwise.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // A browser shows none of these; a NUL would end the page for some readers.
            c if c.is_control() && c != '\n' && c != '\t' => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A section with a heading.
pub(super) fn section(title: &str, inside: &str) -> String {
    format!(
        "<section>\n<h2>{}</h2>\n{inside}</section>\n",
        escaped(title)
    )
}

/// A table; without headings if there are none. Cells are texts.
pub(super) fn table(headings: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let mut out = "<div class=\"wide\"><table>\n".to_owned();
    if !headings.is_empty() {
        let cells = headings.iter().map(|h| format!("<th>{}</th>", escaped(h)));
        let cells: String = cells.collect();
        out.push_str(&format!("<thead><tr>{cells}</tr></thead>\n"));
    }
    out.push_str("<tbody>\n");
    for row in rows {
        let cells = row.iter().map(|c| format!("<td>{}</td>", escaped(c)));
        let cells: String = cells.collect();
        out.push_str(&format!("<tr>{cells}</tr>\n"));
    }
    out.push_str("</tbody>\n</table></div>\n");
    out
}

/// Figures beside one another.
pub(super) fn figures(svgs: &[String]) -> String {
    let inside: String = svgs
        .iter()
        .map(|svg| format!("<figure>{svg}</figure>\n"))
        .collect();
    format!("<div class=\"figures\">\n{inside}</div>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_stay_texts() {
        assert_eq!(
            escaped("<script>a & \"b\" 'c'\u{0}"),
            "&lt;script&gt;a &amp; &quot;b&quot; &#39;c&#39;\u{fffd}"
        );
        let rows = [vec!["<b>".to_owned(), "2".to_owned()]];
        assert!(table(&["a<", "b"], rows.into_iter()).contains("<td>&lt;b&gt;</td>"));
    }
}
