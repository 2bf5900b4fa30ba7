//! Lines of a file whatever their ends and their encoding.

/// Bytes at the start of a file of which one ends a line, in any text that has lines.
const FIRST_ENDS: usize = 1 << 16;

/// Lines with their numbers, read one after another: nothing is stored.
#[derive(Clone)]
pub(crate) struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    number: usize,
    end: u8,
}

/// A line without its end and without trailing blanks.
#[derive(Clone, Copy)]
pub(crate) struct Line<'a> {
    /// Number, from 1.
    pub number: usize,
    /// Content.
    pub bytes: &'a [u8],
}

impl<'a> Lines<'a> {
    /// Ends are LF, CRLF or CR CR LF; CR alone in a file that has no LF in its first 64 KiB.
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        // Bounded: lines are begun anew for every format that a file may be of.
        let start = &bytes[..bytes.len().min(FIRST_ENDS)];
        let end = if !start.contains(&b'\n') && start.contains(&b'\r') {
            b'\r'
        } else {
            b'\n'
        };
        Self {
            bytes,
            at: 0,
            number: 0,
            end,
        }
    }

    /// The same after blank lines.
    pub(crate) fn after_blank(mut self) -> Self {
        let rest = &self.bytes[self.at..];
        let is_blank = |b: &u8| b.is_ascii_whitespace() || *b == 0x1a;
        let blank = rest.iter().position(|b| !is_blank(b)).unwrap_or(rest.len());
        let ends = |bytes: &[u8]| bytes.iter().rposition(|b| *b == self.end);
        if let Some(last) = ends(&rest[..blank]) {
            let ended = rest[..=last].iter().filter(|b| **b == self.end);
            self.number += ended.count();
            self.at += last + 1;
        }
        self
    }

    /// The next line without going on.
    pub(crate) fn peek(&self) -> Option<Line<'a>> {
        self.clone().next()
    }

    /// The next line that is not blank, without going on.
    pub(crate) fn text_ahead(&self) -> Option<Line<'a>> {
        self.clone().find(|line| !line.is_blank())
    }

    /// Number of the line read last.
    pub(crate) fn number(&self) -> usize {
        self.number
    }

    /// Bytes not read yet.
    pub(crate) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let rest = self.bytes.get(self.at..).filter(|r| !r.is_empty())?;
        let length = rest.iter().position(|b| *b == self.end);
        let line = &rest[..length.unwrap_or(rest.len())];
        self.at += length.map_or(rest.len(), |n| n + 1);
        self.number += 1;
        Some(Line {
            number: self.number,
            bytes: trim_end(line),
        })
    }
}

fn trim_end(line: &[u8]) -> &[u8] {
    let end = line
        .iter()
        .rposition(|b| !matches!(b, b' ' | b'\t' | b'\r' | b'\n' | 0x1a))
        .map_or(0, |n| n + 1);
    &line[..end]
}

impl<'a> Line<'a> {
    /// As UTF-8 if it is that, else as Latin-1, in which every byte is a character.
    pub(crate) fn text(&self) -> String {
        decoded(self.bytes)
    }

    /// The same, ASCII letters in lower case.
    pub(crate) fn lower(&self) -> String {
        self.text().to_ascii_lowercase()
    }

    /// Text in columns `from..to` (from 0), without blanks around it. A column is a byte, as the
    /// programs count that write them; a character of several belongs to where it begins.
    pub(crate) fn columns(&self, from: usize, to: usize) -> String {
        let [from, to] = [from, to].map(|at| at.min(self.bytes.len()));
        let field = match std::str::from_utf8(self.bytes) {
            Ok(text) => {
                let [from, to] = [from, to].map(|at| end_of_character(text, at));
                visible(text[from..to.max(from)].chars())
            }
            Err(_) => latin_1(self.bytes.get(from..to).unwrap_or(&[])),
        };
        field
            .trim_matches(|c: char| c.is_ascii_whitespace())
            .to_owned()
    }

    /// Whether there is nothing on it.
    pub(crate) fn is_blank(&self) -> bool {
        self.bytes.trim_ascii().is_empty()
    }

    /// Whether it is text, not numbers: two letters stand together that are not
    /// those of NaN or Inf.
    pub(crate) fn is_text(&self) -> bool {
        let mut words = self
            .bytes
            .split(|b| !b.is_ascii_alphabetic())
            .filter(|w| w.len() > 1);
        words.any(|w| {
            !["nan", "inf", "infinity"]
                .iter()
                .any(|n| w.eq_ignore_ascii_case(n.as_bytes()))
        })
    }

    /// Fields between blanks, tabs, commas and semicolons, with their columns
    /// (from 0).
    pub(crate) fn fields(&self) -> impl Iterator<Item = (usize, &'a [u8])> + use<'a> {
        let bytes = self.bytes;
        let separator = |b: &u8| matches!(b, b' ' | b'\t' | b',' | b';' | b'\r');
        let mut at = 0;
        std::iter::from_fn(move || {
            at += bytes[at..].iter().position(|b| !separator(b))?;
            let length = bytes[at..].iter().position(separator);
            let end = length.map_or(bytes.len(), |n| at + n);
            let field = (at, &bytes[at..end]);
            at = end;
            Some(field)
        })
    }
}

/// The place itself, or the end of the character in which it lies.
fn end_of_character(text: &str, at: usize) -> usize {
    (at..text.len())
        .find(|at| text.is_char_boundary(*at))
        .unwrap_or(text.len())
}

/// Bytes of a text as UTF-8 if they are that, else as Latin-1; control characters are made visible.
pub(crate) fn decoded(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => visible(text.chars()),
        Err(_) => latin_1(bytes),
    }
}

/// Bytes as Latin-1; control characters are made visible.
pub(crate) fn latin_1(bytes: &[u8]) -> String {
    visible(bytes.iter().map(|b| char::from(*b)))
}

fn visible(characters: impl Iterator<Item = char>) -> String {
    characters
        .map(|c| if c.is_control() && c != '\t' { ' ' } else { c })
        .collect()
}

/// What stands in the first brackets of a text, `sec` of `SAMPLING INTERVAL (sec)`.
pub(crate) fn in_brackets(text: &str) -> Option<&str> {
    text.split_once('(')?.1.split(')').next()
}
