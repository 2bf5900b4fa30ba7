//! A chart as SVG.

use std::borrow::Cow;
use std::fmt::Write as _;

use pounding_catalogue::wording::shortened;

use super::axis::{Axis, Range, Scale};
use super::look::{Look, Marker};
use super::{Chart, LimitPlace, Plot};

/// Faces of text, for whoever shows the picture.
pub(crate) const FACES: &str = "Helvetica, Arial, sans-serif";
/// Size of text (pt).
const TEXT: f64 = 8.5;
/// Width of a letter over the size of the text: no letter of a sentence in a usual sans-serif
/// face is wider on average.
const LETTER: f64 = 0.58;
/// The same of a capital.
const CAPITAL: f64 = 0.7;
/// Width of the name of a model over what a text of as many letters takes in a sentence.
const NAMES: f64 = 1.1;
/// Width of a bold text over that of another.
const BOLD: f64 = 1.08;
/// Part of the width that labels of the vertical axis take at most.
const MOST_OF_NAMES: f64 = 0.62;
/// Distance of lines of text (pt).
const LINE: f64 = 11.5;
/// Sample of a line in the legend (pt).
const SAMPLE: f64 = 24.0;
/// Space around the picture and between parts (pt).
const SPACE: f64 = 6.0;
/// Length of a tick (pt).
const TICK: f64 = 3.0;
/// Margins of the ranges of horizontal and vertical axes.
const MARGINS: (f64, f64) = (0.025, 0.05);
/// Markers along a line that is told apart by them.
const MARKERS: usize = 9;

/// The width of a text (pt): capitals are wider than other letters, and signs of East Asia as
/// wide as they are high.
fn width_of(text: &str) -> f64 {
    let letter = |c: char| match c {
        '\u{2e80}'.. => 1.0,
        c if c.is_uppercase() => CAPITAL,
        _ => LETTER,
    };
    TEXT * text.chars().map(letter).sum::<f64>()
}

/// A legend: its rows of entries, each with its place from the left (pt); further lines of an
/// entry have no look.
type Rows<'c> = Vec<Vec<(f64, Cow<'c, str>, Option<&'c Look>)>>;

/// The chart as SVG.
pub fn drawn(chart: &Chart) -> String {
    let whole = Picture::of(chart);
    whole.svg()
}

struct Picture<'c> {
    chart: &'c Chart,
    /// One legend for all plots.
    shared: Option<Rows<'c>>,
    left: f64,
}

fn entries(plot: &Plot) -> Vec<(&str, &Look)> {
    let series = plot.series.iter().map(|s| (s.name.as_str(), &s.look));
    let limits = plot.limits.iter().map(|l| (l.name.as_str(), &l.look));
    let named = series.chain(limits).filter(|(name, _)| !name.is_empty());
    let mut entries: Vec<(&str, &Look)> = Vec::new();
    for entry in named {
        if !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}

/// Names in one line each that is no wider than this (pt): the middles of wider ones are left out.
fn in_one_line<'c>(names: &[&'c str], width: f64) -> Vec<Cow<'c, str>> {
    if names.iter().all(|name| NAMES * width_of(name) <= width) {
        return names.iter().map(|name| Cow::Borrowed(*name)).collect();
    }
    let of_letter = |name: &&str| width_of(name) / name.chars().count().max(1) as f64;
    let widest = names.iter().map(of_letter).fold(0.0, f64::max);
    let letters = (width / (NAMES * widest)) as usize;
    let names = shortened(names, letters).into_iter();
    names.map(Cow::Owned).collect()
}

/// Names for lines no wider than this (pt): they are left as they are where their words fit.
fn in_lines<'c>(names: &[&'c str], width: f64) -> Vec<Cow<'c, str>> {
    let fits = |word: &str| NAMES * width_of(word) <= width;
    match names.iter().all(|name| name.split_whitespace().all(fits)) {
        true => names.iter().map(|name| Cow::Borrowed(*name)).collect(),
        false => in_one_line(names, width),
    }
}

/// Entries in rows no wider than this (pt).
fn rows<'c>(entries: &[(&'c str, &'c Look)], width: f64) -> Rows<'c> {
    let mut rows: Rows<'c> = Vec::new();
    let mut x = 0.0;
    let room = width - SAMPLE - SPACE;
    let names: Vec<&str> = entries.iter().map(|(name, _)| *name).collect();
    for (name, (_, look)) in in_lines(&names, room).into_iter().zip(entries) {
        let wide = SAMPLE + SPACE + width_of(&name) + 2.0 * SPACE;
        if wide > width + 2.0 * SPACE {
            // Alone, in lines.
            let lines = wrapped(&name, room).into_iter().enumerate();
            let line =
                |(number, line)| vec![(0.0, Cow::Owned(line), (number == 0).then_some(*look))];
            rows.extend(lines.map(line));
            x = f64::INFINITY;
            continue;
        }
        if rows.is_empty() || x + wide > width + 2.0 * SPACE {
            rows.push(Vec::new());
            x = 0.0;
        }
        if let Some(row) = rows.last_mut() {
            row.push((x, name, Some(*look)));
        }
        x += wide;
    }
    rows
}

impl<'c> Picture<'c> {
    fn of(chart: &'c Chart) -> Self {
        let width = chart.width - 2.0 * SPACE;
        let lists: Vec<_> = chart.plots.iter().map(entries).collect();
        let same = lists.windows(2).all(|pair| pair[0] == pair[1]);
        let first = lists.first().filter(|first| same && first.len() > 1);
        let shared = first.map(|first| rows(first, width));
        let label = |plot: &Plot| {
            let range = vertical_range(plot);
            let ticks = range.ticks(ticks_of(plot.height));
            // Names of few narrow letters are wider than sentences, and none is cut; so are numbers
            // in some faces, which beside a title have no other room.
            let part = match plot.vertical.scale {
                Scale::Names(_) => NAMES,
                _ if !plot.vertical.label.is_empty() => NAMES,
                _ => 1.0,
            };
            let widest = ticks.iter().map(|(_, label)| part * width_of(label));
            let title = if plot.vertical.label.is_empty() {
                0.0
            } else {
                LINE
            };
            widest.fold(0.0, f64::max) + title
        };
        let widest = chart.plots.iter().map(label).fold(0.0, f64::max);
        Self {
            chart,
            shared,
            left: SPACE + widest.min(MOST_OF_NAMES * chart.width) + TICK + 3.0,
        }
    }

    fn svg(&self) -> String {
        let chart = self.chart;
        let mut body = String::new();
        let mut y = SPACE;
        if let Some(rows) = &self.shared {
            y = legend(&mut body, rows, y);
        }
        let spare = chart.height.map(|height| {
            let needed = y + self.needed();
            (height - needed) / chart.plots.len().max(1) as f64
        });
        for (number, plot) in chart.plots.iter().enumerate() {
            let height = (plot.height + spare.unwrap_or(0.0)).max(30.0);
            y = self.plot(&mut body, plot, number, (y, height));
        }
        let height = chart.height.unwrap_or(y + 1.0);
        let width = chart.width;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" viewBox=\"0 0 {width:.2} {height:.2}\" font-family=\"{FACES}\" font-size=\"{TEXT}\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{body}</svg>\n",
            chart.stated_width
        )
    }

    /// Height of all plots (pt).
    fn needed(&self) -> f64 {
        let plots = self.chart.plots.iter().enumerate();
        plots
            .map(|(number, plot)| {
                let legend = self.own_legend(plot).len() as f64 * LINE;
                let heading = self.heading(plot).len() as f64 * LINE;
                heading + legend + plot.height + self.below(number)
            })
            .sum::<f64>()
            + SPACE
    }

    /// Lines of the heading, none wider than the picture.
    fn heading(&self, plot: &Plot) -> Vec<String> {
        let width = (self.chart.width - 2.0 * SPACE) / BOLD;
        let words: Vec<&str> = plot.heading.split_whitespace().collect();
        wrapped(&in_one_line(&words, width).join(" "), width)
    }

    fn own_legend(&self, plot: &'c Plot) -> Rows<'c> {
        let entries = entries(plot);
        if self.shared.is_some() || entries.len() < 2 && plot.limits.is_empty() {
            return Vec::new();
        }
        rows(&entries, self.chart.width - 2.0 * SPACE)
    }

    /// The plots above and below this one that have its horizontal axis.
    fn of_one_axis(&self, number: usize) -> &'c [Plot] {
        let plots = &self.chart.plots;
        let groups = plots.chunk_by(|a, b| a.horizontal == b.horizontal);
        let mut before = 0;
        let mut with_end = groups.map(|group| {
            before += group.len();
            (before, group)
        });
        let found = with_end.find(|(end, _)| *end > number);
        found.map_or(&plots[number..=number], |(_, group)| group)
    }

    /// Whether the label of the horizontal axis stands below this plot, and not below a later
    /// one of the same axis.
    fn labelled(&self, number: usize) -> bool {
        let plots = &self.chart.plots;
        let next = plots.get(number + 1);
        next.is_none_or(|next| next.horizontal != plots[number].horizontal)
    }

    /// Lines of the label of the horizontal axis below this plot.
    fn label(&self, number: usize) -> Vec<String> {
        match self.labelled(number) {
            true => wrapped(
                &self.chart.plots[number].horizontal.label,
                self.right() - self.left,
            ),
            false => Vec::new(),
        }
    }

    /// Right end of the axes (pt).
    fn right(&self) -> f64 {
        self.chart.width - SPACE - 4.0
    }

    /// Height below the axes (pt).
    fn below(&self, number: usize) -> f64 {
        TICK + LINE + self.label(number).len() as f64 * LINE + 1.5 * SPACE
    }

    fn plot(
        &self,
        body: &mut String,
        plot: &'c Plot,
        number: usize,
        (top, height): (f64, f64),
    ) -> f64 {
        let mut y = top;
        for words in self.heading(plot) {
            y += LINE;
            text(
                body,
                (SPACE, y - 3.0),
                &words,
                "start",
                " font-weight=\"bold\"",
            );
        }
        y = legend(body, &self.own_legend(plot), y);
        let (left, right) = (self.left, self.right());
        let (upper, lower) = (y + 2.0, y + height);
        let horizontal = horizontal_range(&plot.horizontal, self.of_one_axis(number));
        let vertical = vertical_range(plot);
        let x_at = |x: f64| horizontal.place(x).map(|p| left + p * (right - left));
        let y_at = |y: f64| vertical.place(y).map(|p| lower - p * (lower - upper));
        let ticks = vertical.ticks(ticks_of(height));
        let labels: Vec<&str> = ticks.iter().map(|(_, label)| label.as_str()).collect();
        let title = if plot.vertical.label.is_empty() {
            0.0
        } else {
            LINE
        };
        let labels = match plot.vertical.scale {
            Scale::Names(_) => in_one_line(&labels, left - TICK - 2.0 - SPACE - title),
            _ => labels.into_iter().map(Cow::Borrowed).collect(),
        };
        for ((value, _), label) in ticks.iter().zip(&labels) {
            let Some(y) = y_at(*value) else { continue };
            line(
                body,
                (left, y),
                (right, y),
                "stroke=\"#dddddd\" stroke-width=\"0.4\"",
            );
            line(body, (left - TICK, y), (left, y), AXIS);
            text(body, (left - TICK - 2.0, y + 0.35 * TEXT), label, "end", "");
        }
        let most = ((right - left) / 50.0) as usize;
        let mut free = f64::NEG_INFINITY;
        for (value, label) in horizontal.ticks(most) {
            let Some(x) = x_at(value) else { continue };
            line(
                body,
                (x, upper),
                (x, lower),
                "stroke=\"#dddddd\" stroke-width=\"0.4\"",
            );
            line(body, (x, lower), (x, lower + TICK), AXIS);
            // A label over another could not be read.
            let half = 0.5 * width_of(&label);
            if x - half > free {
                text(body, (x, lower + TICK + TEXT), &label, "middle", "");
                free = x + half + 2.0;
            }
        }
        for x in horizontal.minor_ticks().into_iter().filter_map(x_at) {
            line(body, (x, lower), (x, lower + 0.5 * TICK), AXIS);
        }
        for y in vertical.minor_ticks().into_iter().filter_map(y_at) {
            line(body, (left - 0.5 * TICK, y), (left, y), AXIS);
        }
        // An inner picture of the same coordinates cuts off what passes its edge.
        let (wide, high) = (right - left, lower - upper);
        let _ = writeln!(
            body,
            "<svg x=\"{left:.2}\" y=\"{upper:.2}\" width=\"{wide:.2}\" height=\"{high:.2}\" viewBox=\"{left:.2} {upper:.2} {wide:.2} {high:.2}\">"
        );
        for limit in &plot.limits {
            let ends = match limit.at {
                LimitPlace::Horizontal(value) => x_at(value).map(|x| [(x, upper), (x, lower)]),
                LimitPlace::Vertical(value) => y_at(value).map(|y| [(left, y), (right, y)]),
            };
            if let Some([from, to]) = ends {
                line(body, from, to, &limit.look.stroke());
            }
        }
        // Filled markers would hide open ones at the same place.
        let (mut filled, mut open) = (String::new(), String::new());
        for (turn, series) in plot.series.iter().enumerate() {
            let places = series.points.iter();
            let places = places.map(|(x, y)| Some((x_at(*x)?, y_at(*y)?)));
            let places: Vec<Option<(f64, f64)>> = places.collect();
            curve(body, &series.look, &places);
            let layer = match series.look.has_open_marker() {
                true => &mut open,
                false => &mut filled,
            };
            markers(layer, &series.look, &places, turn);
        }
        body.push_str(&filled);
        body.push_str(&open);
        body.push_str("</svg>\n");
        line(body, (left, upper), (left, lower), AXIS);
        line(body, (left, lower), (right, lower), AXIS);
        let mut below = lower + TICK + LINE;
        for words in self.label(number) {
            below += LINE;
            let middle = 0.5 * (left + right);
            text(body, (middle, below - 2.0), &words, "middle", "");
        }
        if !plot.vertical.label.is_empty() {
            let (x, y) = (SPACE + TEXT, 0.5 * (upper + lower));
            let turned = format!(" transform=\"rotate(-90 {x:.2} {y:.2})\"");
            text(body, (x, y), &plot.vertical.label, "middle", &turned);
        }
        below + 1.5 * SPACE
    }
}

const AXIS: &str = "stroke=\"#000000\" stroke-width=\"0.6\"";

fn ticks_of(height: f64) -> usize {
    ((height / 24.0) as usize).clamp(2, 10)
}

/// The range of a horizontal axis for all plots that have it.
fn horizontal_range(axis: &Axis, plots: &[Plot]) -> Range {
    let series = plots.iter().flat_map(|plot| &plot.series);
    let points = series.flat_map(|s| s.points.iter().map(|p| p.0));
    let limits = plots.iter().flat_map(|plot| &plot.limits);
    let limits = limits.filter_map(|l| match l.at {
        LimitPlace::Horizontal(x) => Some(x),
        LimitPlace::Vertical(_) => None,
    });
    Range::of(axis, points.chain(limits), MARGINS.0)
}

fn vertical_range(plot: &Plot) -> Range {
    let points = plot
        .series
        .iter()
        .flat_map(|s| s.points.iter().map(|p| p.1));
    let limits = plot.limits.iter().filter_map(|l| match l.at {
        LimitPlace::Vertical(y) => Some(y),
        LimitPlace::Horizontal(_) => None,
    });
    Range::of(&plot.vertical, points.chain(limits), MARGINS.1)
}

/// Rows of a legend from a height on; the height below it.
fn legend(body: &mut String, rows: &Rows<'_>, top: f64) -> f64 {
    let mut y = top;
    for row in rows {
        y += LINE;
        for (x, name, look) in row {
            let (from, middle) = (SPACE + x, y - 0.5 * TEXT);
            if let Some(look) = look.filter(|look| look.dash.is_some()) {
                line(
                    body,
                    (from, middle),
                    (from + SAMPLE, middle),
                    &look.stroke(),
                );
            }
            let marker = look.map(|look| look.marker_at((from + 0.5 * SAMPLE, middle)));
            body.push_str(&marker.unwrap_or_default());
            text(body, (from + SAMPLE + 4.0, y - 1.5), name, "start", "");
        }
    }
    if rows.is_empty() { y } else { y + 3.0 }
}

/// A text in lines no wider than this (pt), unless a word is.
fn wrapped(content: &str, width: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in content.split_whitespace() {
        match lines.last_mut() {
            Some(line) if width_of(line) + width_of(word) + width_of(" ") <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

fn line(body: &mut String, from: (f64, f64), to: (f64, f64), style: &str) {
    let _ = writeln!(
        body,
        "<line x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" {style}/>",
        from.0, from.1, to.0, to.1
    );
}

fn text(body: &mut String, at: (f64, f64), content: &str, anchor: &str, more: &str) {
    let _ = writeln!(
        body,
        "<text x=\"{:.2}\" y=\"{:.2}\" text-anchor=\"{anchor}\"{more}>{}</text>",
        at.0,
        at.1,
        escaped(content)
    );
}

/// As a text of SVG, without characters that XML does not have.
fn escaped(content: &str) -> String {
    let mut out = String::with_capacity(content.len());
    for c in content.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' | '\r' => out.push(' '),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// A curve, broken where a point has no place.
fn curve(body: &mut String, look: &Look, places: &[Option<(f64, f64)>]) {
    if look.dash.is_none() {
        return;
    }
    for part in places.split(Option::is_none).filter(|p| !p.is_empty()) {
        // A point without neighbours is a dot.
        if let [Some((x, y))] = part {
            let _ = writeln!(
                body,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{:.2}\" fill=\"{}\"/>",
                1.2 * look.width,
                look.colour
            );
            continue;
        }
        let points: Vec<String> = part
            .iter()
            .flatten()
            .map(|(x, y)| format!("{x:.2},{y:.2}"))
            .collect();
        let _ = writeln!(
            body,
            "<polyline points=\"{}\" {}/>",
            points.join(" "),
            look.stroke()
        );
    }
}

/// Markers of a curve that has some.
fn markers(body: &mut String, look: &Look, places: &[Option<(f64, f64)>], turn: usize) {
    if !matches!(look.marker, Marker::Shape(_)) {
        return;
    }
    let known: Vec<(f64, f64)> = places.iter().flatten().copied().collect();
    let every = if look.few_markers {
        (known.len() / MARKERS).max(1)
    } else {
        1
    };
    // Markers of neighbouring curves stand at different points.
    let first = if look.few_markers {
        (turn * every) / 3 % every.max(1)
    } else {
        0
    };
    for place in known.iter().skip(first).step_by(every) {
        body.push_str(&look.marker_at(*place));
        body.push('\n');
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::{Curve, Panel, figure};

    /// Names of a legend in a column stand in lines, or are shortened so that they differ.
    #[test]
    fn legends_are_not_cut() {
        let drawn = |names: [&str; 2]| {
            let curve = |name: &str| Curve {
                name: name.to_owned(),
                points: vec![(0.0, 0.0), (1.0, 1.0)],
            };
            let panel = Panel {
                caption: "Displacement (mm)".to_owned(),
                horizontal: "time (s)".to_owned(),
                curves: names.map(curve).to_vec(),
            };
            figure(&[panel]).of_width(90.0).svg()
        };
        let legend = |svg: &str| -> Vec<String> {
            let texts = svg.split("text-anchor=\"start\">").skip(1);
            let texts = texts.filter_map(|t| t.split('<').next());
            texts.map(str::to_owned).collect()
        };
        let sentences = legend(&drawn([
            "the light frame of the old hospital, beside the road to the north",
            "the heavy frame of the old hospital, beside the road to the north",
        ]));
        assert_eq!(sentences.len(), 4, "{sentences:?}");
        assert_eq!(sentences[0].split_whitespace().next(), Some("the"));
        let words = legend(&drawn([
            "../ground_motions/of_the_hospital/recorded_in_the_basement_1.csv",
            "../ground_motions/of_the_hospital/recorded_in_the_basement_2.csv",
        ]));
        assert_eq!(words.len(), 2, "{words:?}");
        assert_ne!(words[0], words[1]);
        let room = 90.0 * 72.0 / 25.4 - 2.0 * SPACE - SAMPLE - 4.0;
        for text in sentences.iter().chain(&words) {
            assert!(width_of(text) <= room, "{text}");
        }
    }

    /// An outline hides nothing, and no filled marker hides one: what was counted at the same place
    /// is seen.
    #[test]
    fn markers_at_the_same_place_are_seen() {
        let series = |number: usize| crate::chart::Series {
            name: String::new(),
            points: vec![(0.5, 0.5)],
            look: Look::points(number),
        };
        let chart = Chart::of_page(vec![Plot {
            heading: String::new(),
            horizontal: Axis::linear("x"),
            vertical: Axis::linear("y"),
            series: (0..5).map(series).collect(),
            limits: Vec::new(),
            height: 100.0,
        }]);
        let svg = chart.svg();
        let markers: Vec<&str> = svg
            .lines()
            .filter(|line| line.starts_with("<polygon") || line.starts_with("<circle"))
            .collect();
        let is_open = |marker: &&str| marker.contains("fill=\"none\"");
        assert_eq!(markers.len(), 5, "{svg}");
        assert!(markers[..3].iter().all(|m| !is_open(m)), "{svg}");
        assert!(markers[3..].iter().all(is_open), "{svg}");
    }
}
