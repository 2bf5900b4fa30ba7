//! Warnings of floors at different elevations that act on each other, or meet columns and hit nothing.

use crate::system::{ContactLevel, Gap, System};
use crate::warning::Warning;

impl System {
    /// Each gap in which floors at different elevations act on each other, or in which floors
    /// that meet columns hit nothing while others hit columns, as a warning.
    #[must_use]
    pub fn unequal_floor_warnings(&self) -> Vec<Warning> {
        let left_out = self
            .gaps()
            .iter()
            .flat_map(|gap| self.columns_left_out(gap));
        let warned = self.gaps().iter().filter_map(|gap| {
            let unequal = self.unequal_floors(gap);
            let first = unequal.first()?;
            Some(Warning::UnequalFloors {
                gap: gap.name.clone(),
                floors: first.floors(),
                difference: first.difference,
                pairs: unequal.len(),
            })
        });
        warned.chain(left_out).collect()
    }

    /// Floors of both sides of a gap that meet columns and hit nothing, where others hit
    /// columns.
    fn columns_left_out(&self, gap: &Gap) -> Vec<Warning> {
        let levels = self.levels_of(gap);
        let hits = |level: &ContactLevel| (0..2).any(|side| self.is_column(level, side));
        if !levels.iter().any(hits) {
            return Vec::new();
        }
        let of = |side: usize| {
            let places = levels
                .iter()
                .filter_map(|l| self.storey_of(l.between[side]));
            let building = places.map(|(building, _)| building).next()?;
            Some(&self.buildings()[building])
        };
        let (Some(left), Some(right)) = (of(0), of(1)) else {
            return Vec::new();
        };
        let both = [(0, left, right), (1, right, left)];
        let warned = both.into_iter().filter_map(|(side, own, other)| {
            let roof = other.elevations().last().copied().unwrap_or(0.0);
            let hits_nothing = |storey: &usize| {
                !levels.iter().any(|level| {
                    let place = self.storey_of(level.between[side]);
                    !self.is_column(level, side) && place.is_some_and(|(_, s)| s == *storey)
                })
            };
            let below = |storey: &usize| own.elevations()[*storey] < roof;
            let mut floors = (0..own.storeys()).filter(|s| below(s) && hits_nothing(s));
            let first = floors.next()?;
            Some(Warning::ColumnsLeftOut {
                gap: gap.name.clone(),
                floor: format!(
                    "floor {} of \"{}\" at {} m",
                    first + 1,
                    own.name(),
                    own.elevations()[first]
                ),
                hit: other.name().to_owned(),
                floors: 1 + floors.count(),
            })
        });
        warned.collect()
    }
}
