//! How curves look: told apart by dash, width and marker, and by colour besides.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

/// Colours in turn, of different lightness, all dark enough on white.
const COLOURS: [&str; 7] = [
    "#10437f", "#c8502a", "#2d8a4e", "#8a5bb0", "#a47d00", "#0e8fa0", "#7a2f4a",
];
/// Dashes and spaces of curves in turn (pt); the first is a solid line.
pub const DASHES: [&str; 7] = [
    "",
    "5 1.6",
    "1.3 1.3",
    "6 1.6 1.3 1.6",
    "2.8 1.4",
    "8 1.6 1.3 1.6 1.3 1.6",
    "3.5 3",
];
/// Widths in turn (pt).
const WIDTHS: [f64; 7] = [0.9, 1.1, 1.4, 1.0, 1.2, 0.9, 1.3];

/// A shape at points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Marker {
    /// None.
    Nothing,
    /// Filled or open shape number so many.
    Shape(usize),
    /// The same in the legend alone: points that belong to the line have it.
    InLegend(usize),
}

/// How a curve is drawn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Look {
    /// Colour: `#` and six hexadecimal digits.
    pub colour: Cow<'static, str>,
    /// Dashes and spaces (pt), empty for a solid line; `None` draws no line.
    pub dash: Option<Cow<'static, str>>,
    /// Width (pt).
    pub width: f64,
    /// Shape at the points.
    pub marker: Marker,
    /// Markers at a few points only, which tell lines apart; else at all.
    pub few_markers: bool,
}

impl Look {
    /// Line number so many; from the eighth on with markers.
    pub fn line(number: usize) -> Self {
        let turn = number / COLOURS.len();
        Self {
            colour: COLOURS[number % COLOURS.len()].into(),
            dash: Some(DASHES[number % DASHES.len()].into()),
            width: WIDTHS[number % WIDTHS.len()],
            marker: match turn {
                0 => Marker::Nothing,
                turn => Marker::Shape(turn - 1),
            },
            few_markers: true,
        }
    }

    /// Points without a line.
    pub fn points(number: usize) -> Self {
        Self {
            dash: None,
            marker: Marker::Shape(number),
            few_markers: false,
            ..Self::line(number)
        }
    }

    /// Line number so many, fitted to points of [`Look::points`] with the same number.
    pub fn fitted(number: usize) -> Self {
        Self {
            marker: Marker::InLegend(number),
            ..Self::line(number)
        }
    }

    /// Number so many of what others are compared with: thick and dashed, later ones with
    /// markers.
    pub fn reference(number: usize) -> Self {
        Self {
            colour: "#000000".into(),
            dash: Some("6 2.4".into()),
            width: 1.6,
            marker: match number {
                0 => Marker::Nothing,
                number => Marker::Shape(number - 1),
            },
            few_markers: true,
        }
    }

    /// One of many lines, of which none is to be told from the others.
    pub fn one_of_many() -> Self {
        Self {
            colour: "#9a9a9a".into(),
            dash: Some("".into()),
            width: 0.45,
            marker: Marker::Nothing,
            few_markers: true,
        }
    }

    /// Many points, of which none is to be told from the others.
    pub fn points_of_many() -> Self {
        Self {
            dash: None,
            marker: Marker::Shape(0),
            few_markers: false,
            ..Self::one_of_many()
        }
    }

    /// What stands for many lines.
    pub fn summary(dash: &'static str) -> Self {
        Self {
            colour: "#000000".into(),
            dash: Some(dash.into()),
            width: 1.5,
            marker: Marker::Nothing,
            few_markers: true,
        }
    }

    /// A limit across the panel: dotted and thin, else thicker than any line.
    pub fn limit(dash: &'static str) -> Self {
        Self {
            colour: "#000000".into(),
            dash: Some(dash.into()),
            width: if dash.starts_with('1') { 0.9 } else { 1.5 },
            marker: Marker::Nothing,
            few_markers: true,
        }
    }

    /// Whether it can be drawn as it was read: a colour, lengths of dashes and a width, which
    /// stand in the picture as they are.
    pub fn is_drawable(&self) -> bool {
        let digits = |text: &str| text.chars().all(|c| c.is_ascii_hexdigit());
        let colour = self.colour.strip_prefix('#');
        let length = |c: char| c.is_ascii_digit() || c == '.' || c == ' ';
        let dash = self.dash.as_deref().unwrap_or_default();
        colour.is_some_and(|c| c.len() == 6 && digits(c))
            && dash.chars().all(length)
            && (0.0..=10.0).contains(&self.width)
    }

    /// The line of this look as attributes of SVG.
    pub fn stroke(&self) -> String {
        let dash = match self.dash.as_deref() {
            None | Some("") => String::new(),
            Some(dash) => format!(" stroke-dasharray=\"{dash}\""),
        };
        format!(
            "fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"{dash}",
            self.colour, self.width
        )
    }

    /// Whether its marker is an outline alone.
    pub fn has_open_marker(&self) -> bool {
        match self.marker {
            Marker::Shape(number) | Marker::InLegend(number) => number >= 5 || number % 2 == 1,
            Marker::Nothing => false,
        }
    }

    /// Its marker at a place (pt).
    pub fn marker_at(&self, (x, y): (f64, f64)) -> String {
        let (Marker::Shape(number) | Marker::InLegend(number)) = self.marker else {
            return String::new();
        };
        const R: f64 = 2.1;
        // Through an open one is seen what lies at the same place.
        let fill = match self.has_open_marker() {
            true => "none",
            false => &self.colour,
        };
        let style = format!(
            "fill=\"{fill}\" stroke=\"{}\" stroke-width=\"0.8\"",
            self.colour
        );
        let polygon = |points: &[(f64, f64)]| {
            let points: Vec<String> = points
                .iter()
                .map(|(a, b)| format!("{:.2},{:.2}", x + a * R, y + b * R))
                .collect();
            format!("<polygon points=\"{}\" {style}/>", points.join(" "))
        };
        match number % 5 {
            0 => format!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{R}\" {style}/>"),
            1 => polygon(&[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)]),
            2 => polygon(&[(0.0, -1.2), (1.1, 0.8), (-1.1, 0.8)]),
            3 => polygon(&[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)]),
            _ => polygon(&[(0.0, 1.2), (1.1, -0.8), (-1.1, -0.8)]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without colours no two of the first thirty lines are alike.
    #[test]
    fn lines_differ_in_greyscale() {
        let grey = |number| {
            let look = Look::line(number);
            (
                look.dash.clone(),
                look.width.to_bits(),
                format!("{:?}", look.marker),
            )
        };
        for a in 0..30 {
            for b in 0..a {
                assert_ne!(grey(a), grey(b), "{a} {b}");
            }
        }
        let lightness = |colour: &str| {
            let part = |i: usize| f64::from(u8::from_str_radix(&colour[i..i + 2], 16).unwrap_or(0));
            0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
        };
        for colour in COLOURS {
            assert!(lightness(colour) < 150.0, "{colour} is pale");
        }
    }
}
