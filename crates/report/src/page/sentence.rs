//! Sentences that a terminal and a page both show.

use super::html::{escaped, named, number};

/// A piece of a sentence.
#[derive(Debug, Clone, PartialEq)]
enum Piece {
    Words(String),
    /// What stands out where letters may be bold.
    Emphasis(String),
    /// A name that its user gave.
    Name(String),
    /// A number as it is shown, with the place that it comes from and the factor from there.
    Number {
        from: String,
        factor: f64,
        shown: String,
    },
}

/// A sentence with numbers that say where they come from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sentence {
    pieces: Vec<Piece>,
}

impl Sentence {
    /// The same with these words behind it.
    #[must_use]
    pub(super) fn words(self, words: impl Into<String>) -> Self {
        self.and(Piece::Words(words.into()))
    }

    /// The same with words behind it that stand out.
    #[must_use]
    pub(super) fn emphasis(self, words: impl Into<String>) -> Self {
        self.and(Piece::Emphasis(words.into()))
    }

    /// The same with a name behind it that its user gave.
    #[must_use]
    pub(super) fn name(self, name: impl Into<String>) -> Self {
        self.and(Piece::Name(name.into()))
    }

    /// The same with a number behind it, of this place of the result, which the factor takes to what is shown.
    #[must_use]
    pub(super) fn number(
        self,
        from: impl Into<String>,
        factor: f64,
        shown: impl Into<String>,
    ) -> Self {
        self.and(Piece::Number {
            from: from.into(),
            factor,
            shown: shown.into(),
        })
    }

    fn and(mut self, piece: Piece) -> Self {
        self.pieces.push(piece);
        self
    }

    /// The sentence as a terminal shows it.
    #[must_use]
    pub fn text(&self) -> String {
        let pieces = self.pieces.iter().map(|piece| match piece {
            Piece::Words(text) | Piece::Emphasis(text) | Piece::Name(text) => text.as_str(),
            Piece::Number { shown, .. } => shown,
        });
        // Lines of a terminal are broken by others.
        pieces.collect::<String>().replace('\u{a0}', " ")
    }

    /// The sentence as HTML.
    pub(super) fn html(&self) -> String {
        let pieces = self.pieces.iter().map(|piece| match piece {
            Piece::Words(text) => escaped(text),
            Piece::Emphasis(text) => format!("<strong>{}</strong>", escaped(text)),
            Piece::Name(name) => named(name),
            Piece::Number {
                from,
                factor,
                shown,
            } => number(from, *factor, shown),
        });
        pieces.collect()
    }
}
