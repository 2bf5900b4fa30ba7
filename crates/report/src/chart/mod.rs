//! Charts: panels of curves, points and limits below one another, as SVG of a width that
//! journals print, text of 8.5 pt.
//!
//! Lines differ by dash, width and marker, never by colour alone; legends stand above the
//! panels, off the data.

use serde::{Deserialize, Serialize};

mod axis;
mod drawing;
mod look;

pub use axis::{Axis, Scale};
pub(crate) use drawing::FACES;
pub use look::{DASHES, Look};

/// A series of points with its look.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name in the legend; empty for a series that has none there.
    pub name: String,
    /// Points in the units of the axes; one that is not finite has no place.
    #[serde(with = "points")]
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub look: Look,
}

/// A straight line across a panel, with its name in the legend.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Limit {
    /// Name.
    pub name: String,
    /// Where it crosses: a value of the horizontal axis or of the vertical one.
    pub at: LimitPlace,
    /// How it is drawn.
    pub look: Look,
}

/// Where a limit crosses a panel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LimitPlace {
    /// Upright, at this value of the horizontal axis.
    Horizontal(f64),
    /// Level, at this value of the vertical axis.
    Vertical(f64),
}

/// One set of axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Heading above it, with quantity and unit of the vertical axis if that has no label.
    pub heading: String,
    /// Horizontal axis.
    pub horizontal: Axis,
    /// Vertical axis.
    pub vertical: Axis,
    /// Series, later ones over earlier ones.
    pub series: Vec<Series>,
    /// Limits, below the series.
    pub limits: Vec<Limit>,
    /// Height of the axes (pt).
    pub height: f64,
}

/// A picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// Plots from the top.
    pub plots: Vec<Plot>,
    /// Width (pt).
    pub width: f64,
    /// Width that the file states, with unit.
    pub stated_width: String,
    /// Height of the whole (pt); by default what the plots need.
    pub height: Option<f64>,
}

/// Points of an inch in a millimetre.
const POINTS_PER_MILLIMETRE: f64 = 72.0 / 25.4;
/// Width of a page of a journal (mm).
pub const PAGE: f64 = 190.0;

impl Chart {
    /// A picture as wide as a page of a journal, [`PAGE`].
    pub(crate) fn of_page(plots: Vec<Plot>) -> Self {
        Self {
            plots,
            width: PAGE * POINTS_PER_MILLIMETRE,
            stated_width: format!("{PAGE}mm"),
            height: None,
        }
    }

    /// The same at another width (mm), such as the 90 mm of a column: the size of the text stays.
    #[must_use]
    pub fn of_width(self, millimetres: f64) -> Self {
        Self {
            width: millimetres * POINTS_PER_MILLIMETRE,
            stated_width: format!("{millimetres}mm"),
            ..self
        }
    }

    /// Whether what a file says of it can be drawn.
    pub(crate) fn is_drawable(&self) -> bool {
        let plots = self.plots.iter();
        let heights = plots.clone().all(|p| (1.0..=5.0e4).contains(&p.height));
        let looks = plots.flat_map(|plot| {
            let series = plot.series.iter().map(|s| &s.look);
            series.chain(plot.limits.iter().map(|l| &l.look))
        });
        heights && looks.into_iter().all(Look::is_drawable)
    }

    /// The picture as SVG.
    #[must_use]
    pub fn svg(&self) -> String {
        drawing::drawn(self)
    }
}

/// Height of the axes (pt) where nothing asks for another.
pub const HEIGHT: f64 = 125.0;

/// Points in files: a coordinate that is not finite is `null` there.
mod points {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    type Point = (Option<f64>, Option<f64>);

    pub fn serialize<S: Serializer>(points: &[(f64, f64)], to: S) -> Result<S::Ok, S::Error> {
        let known = |x: f64| x.is_finite().then_some(x);
        let points = points.iter().map(|(x, y)| (known(*x), known(*y)));
        points.collect::<Vec<Point>>().serialize(to)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<Vec<(f64, f64)>, D::Error> {
        let points = Vec::<Point>::deserialize(from)?.into_iter();
        let known = |x: Option<f64>| x.unwrap_or(f64::NAN);
        Ok(points.map(|(x, y)| (known(x), known(y))).collect())
    }
}
