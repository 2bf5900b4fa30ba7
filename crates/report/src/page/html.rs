//! Pieces of HTML.

/// A text with what HTML would take for its own written otherwise.
#[must_use]
pub fn escaped(text: &str) -> String {
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

/// A name that its user gave, as it stands among words of ours: one that runs from right to left, or
/// that has signs which turn the direction, is set apart, so that it turns nothing behind it.
pub(super) fn named(name: &str) -> String {
    let text = escaped(name);
    match turns(name) {
        true => format!("<bdi>{text}</bdi>"),
        false => text,
    }
}

/// Whether a text may turn the direction of what stands beside it.
pub(super) fn turns(text: &str) -> bool {
    text.contains(|c: char| {
        matches!(c,
            '\u{590}'..='\u{8ff}'
            | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
            | '\u{fb1d}'..='\u{fdff}' | '\u{fe70}'..='\u{feff}'
            | '\u{10800}'..='\u{10fff}' | '\u{1e800}'..='\u{1efff}')
    })
}

/// JSON as it may stand in a `script`: no text in it ends the element or opens another, and
/// none is a line end to JavaScript.
pub(super) fn escaped_json(json: &serde_json::Value) -> String {
    let text = json.to_string();
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' | '>' | '&' | '\u{2028}' | '\u{2029}' => {
                out.push_str(&format!("\\u{:04x}", u32::from(c)));
            }
            c => out.push(c),
        }
    }
    out
}

/// A section with a heading.
pub(super) fn section(title: &str, inside: &str) -> String {
    section_of([title, "", ""], inside)
}

/// A section whose heading has words, a name and words.
pub(super) fn section_of([before, name, after]: [&str; 3], inside: &str) -> String {
    format!(
        "<section>\n<h2>{}{}{}</h2>\n{inside}</section>\n",
        escaped(before),
        named(name),
        escaped(after)
    )
}

/// A figure with what it says in words, for those who do not see it.
pub(super) fn figure(svg: &str, words: &str) -> String {
    let words = escaped(words);
    let named = svg.replacen(
        "<svg ",
        &format!("<svg role=\"img\" aria-label=\"{words}\" "),
        1,
    );
    format!("<figure tabindex=\"0\" aria-label=\"{words}\">{named}</figure>\n")
}

/// Figures beside one another.
pub(super) fn beside(figures: &[String]) -> String {
    format!("<div class=\"figures\">\n{}</div>\n", figures.concat())
}

/// A number in a sentence that says where it comes from, as columns of tables do.
pub(super) fn number(from: &str, factor: f64, text: &str) -> String {
    let factor = match factor {
        1.0 => String::new(),
        factor => format!(" data-factor=\"{factor:e}\""),
    };
    let (from, text) = (escaped(from), escaped(text));
    format!("<data data-from=\"{from}\"{factor} value=\"{text}\">{text}</data>")
}

/// A list of sentences, which are HTML.
pub(super) fn sentences(points: &[String]) -> String {
    let items: String = points.iter().map(|p| format!("<li>{p}</li>\n")).collect();
    format!("<ul class=\"summary\">\n{items}</ul>\n")
}

/// Warnings, one below the other.
pub(super) fn warnings(texts: &[String]) -> String {
    let one = |text: &String| format!("<p class=\"warning\">Warning: {}</p>\n", escaped(text));
    texts.iter().map(one).collect()
}

/// A remark in small print.
pub(super) fn note(text: &str) -> String {
    format!("<p class=\"note\">{}</p>\n", escaped(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_turn_are_isolated() {
        assert_eq!(named("tower <1>"), "tower &lt;1&gt;");
        assert_eq!(
            named("\u{645}\u{628}\u{646}\u{649} 1"),
            "<bdi>\u{645}\u{628}\u{646}\u{649} 1</bdi>"
        );
        assert_eq!(named("a\u{202e}b"), "<bdi>a\u{202e}b</bdi>");
    }

    #[test]
    fn texts_stay_texts() {
        assert_eq!(
            escaped("<script>a & \"b\" 'c'\u{0}"),
            "&lt;script&gt;a &amp; &quot;b&quot; &#39;c&#39;\u{fffd}"
        );
        let json = serde_json::json!({ "</script>": "<!-- \u{2028} & \"" });
        let text = escaped_json(&json);
        assert!(!text.contains(['<', '>', '&', '\u{2028}']), "{text}");
        let again: serde_json::Value = serde_json::from_str(&text).unwrap_or_default();
        assert_eq!(again, json);
        assert!(
            figure("<svg width=\"1\"/>", "a \"b\"")
                .contains("aria-label=\"a &quot;b&quot;\" width")
        );
    }
}
