//! Tables of one quantity over another.

use pounding_case::{CaseError, Dimension, RuleText, TableText};

/// Most points of a table.
const MOST_POINTS: usize = 1000;

/// Values over a quantity that rises from point to point.
#[derive(Debug, Clone)]
pub(super) struct Table {
    points: Vec<(f64, f64)>,
    /// Whether a value holds from its point to the next, and that of the last on for ever; else
    /// values in between lie on straight lines.
    steps: bool,
    /// Dimensions of both columns.
    pub dimensions: [Dimension; 2],
}

impl Table {
    /// A table as it was read.
    pub(super) fn of(rule: &RuleText, text: &TableText) -> Result<Self, CaseError> {
        let wrong = |message: String, help: &str| {
            Err(rule.error(text.span.clone(), message, Some(help.to_owned())))
        };
        if text.points.len() < 2 || text.points.len() > MOST_POINTS {
            let message = format!(
                "the table has {} points, and needs 2 to {MOST_POINTS}",
                text.points.len()
            );
            return wrong(message, "write points = [[0, 1], [3, 2]]");
        }
        let mut dimensions = [Dimension::NUMBER; 2];
        for (column, dimension) in dimensions.iter_mut().enumerate() {
            // A plain number is one; a zero may go without the unit of the others.
            let given = text.points.iter().map(|p| &p[column]);
            let stated = given.clone().find_map(|q| q.dimension);
            *dimension = stated.unwrap_or(Dimension::NUMBER);
            let other = given.into_iter().find(|q| {
                let own = q.dimension.unwrap_or(Dimension::NUMBER);
                own != *dimension && !(q.dimension.is_none() && q.value == 0.0)
            });
            if let Some(other) = other {
                let message = format!(
                    "the table has {dimension} and \"{}\" in one column",
                    other.text
                );
                return wrong(message, "give all values of a column the same kind of unit");
            }
        }
        let points: Vec<_> = text
            .points
            .iter()
            .map(|[x, y]| (x.value, y.value))
            .collect();
        if points.windows(2).any(|pair| !(pair[0].0 < pair[1].0)) {
            let message = "the first values of the points of a table do not rise".to_owned();
            return wrong(message, "put the points in order, each first value once");
        }
        Ok(Self {
            points,
            steps: text.steps,
            dimensions,
        })
    }

    /// The value at a place (SI); `Err` with the range where it lies outside.
    pub(super) fn value(&self, x: f64) -> Result<f64, (f64, f64)> {
        let (first, last) = (self.points[0], self.points[self.points.len() - 1]);
        let range = (first.0, if self.steps { f64::INFINITY } else { last.0 });
        if !(x >= range.0 && x <= range.1) {
            return Err(range);
        }
        let after = self.points.partition_point(|p| p.0 <= x);
        let before = self.points[after.max(1) - 1];
        match self.points.get(after) {
            Some(next) if !self.steps => {
                let part = (x - before.0) / (next.0 - before.0);
                Ok(before.1 + part * (next.1 - before.1))
            }
            _ => Ok(before.1),
        }
    }
}
