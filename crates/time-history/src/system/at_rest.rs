//! Until when buildings stand still.

use super::{GroundAcceleration, System};

impl System {
    /// Time (s) until which the buildings of each contact level stand still, with all that gaps and
    /// links join to them: the time of the last sample before their ground moves, and none where
    /// they move from the start. Zero where nothing ever moves them.
    pub(crate) fn levels_at_rest_until(&self) -> Vec<f64> {
        let mut until: Vec<f64> = (0..self.buildings.len())
            .map(|b| self.at_rest_until(b))
            .collect();
        let place = |name: &String| self.buildings.iter().position(|b| b.name() == name);
        let gaps = self.gaps.iter().map(|gap| &gap.between);
        let joined = gaps.chain(self.links.iter().map(|link| &link.between));
        let joined: Vec<[usize; 2]> = joined
            .filter_map(|[left, right]| Some([place(left)?, place(right)?]))
            .collect();
        // What moves one building comes to those behind it, one after another.
        for _ in 0..until.len() {
            for [a, b] in &joined {
                let earlier = until[*a].min(until[*b]);
                (until[*a], until[*b]) = (earlier, earlier);
            }
        }
        let of_gap = |[left, right]: &[String; 2]| {
            let sides = [place(left), place(right)].into_iter().flatten();
            sides.map(|b| until[b]).fold(f64::INFINITY, f64::min)
        };
        let levels = self.gaps.iter().flat_map(|gap| {
            let of_buildings = of_gap(&gap.between);
            self.levels_of(gap).iter().map(move |l| (l, of_buildings))
        });
        let at_last = |(level, of_buildings): (&super::ContactLevel, f64)| {
            let first = self.with_mass();
            let motions = self.motions.as_ref();
            let grounds = level.terms.ground.iter().filter_map(|(dof, _)| {
                let motion = &motions?.motions[self.moving_ground[dof - first]];
                begin(&motion.acceleration, motion.delay)
            });
            let until = grounds.fold(of_buildings, f64::min);
            if until.is_finite() { until } else { 0.0 }
        };
        levels.map(at_last).collect()
    }

    /// The same of one building by itself; infinite where nothing ever moves it.
    fn at_rest_until(&self, building: usize) -> f64 {
        let half = self.initial.len() / 2;
        let ranges = [&self.offsets, &self.further_offsets].map(|o| o[building]..o[building + 1]);
        let moves = |dof: usize| self.initial[dof] != 0.0 || self.initial[half + dof] != 0.0;
        if ranges.into_iter().flatten().any(moves) {
            return 0.0;
        }
        let Some(motions) = &self.motions else {
            return begin(&self.ground, 0.0).unwrap_or(f64::INFINITY);
        };
        let support = motions.supports[building];
        let grounds = [Some(support.along), support.across];
        let grounds = grounds.into_iter().flatten().filter_map(|motion| {
            let motion = &motions.motions[motion];
            begin(&motion.acceleration, motion.delay)
        });
        let forces = motions.forces.iter().filter(|f| f.building == building);
        let forces = forces.filter_map(|f| f.history.begin());
        grounds.chain(forces).fold(f64::INFINITY, f64::min)
    }
}

/// Time (s) of the last sample before the ground moves; `None` if it never does.
fn begin(ground: &GroundAcceleration, delay: f64) -> Option<f64> {
    let first = ground.samples.iter().position(|a| *a != 0.0)?;
    Some(delay + first.saturating_sub(1) as f64 * ground.time_step)
}
