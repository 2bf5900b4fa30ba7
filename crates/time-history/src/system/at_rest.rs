//! Until when buildings stand still.

use super::{ContactLevel, GroundAcceleration, System};

/// Floors that part by at most this (m) stay in touch, and those that overlap by at most
/// this do no more than touch. Displacements of a decimetre have a round-off of 1e-17 m,
/// which a run gathers to some 1e-15 m.
pub(crate) const TOUCH: f64 = 1.0e-14;

impl System {
    /// Time (s) until which the buildings of each contact level stand still, with all that links
    /// and touching floors join to them: the time of the last sample before their ground moves, and
    /// none where they move from the start. Infinite where nothing but an impact ever moves them.
    pub(crate) fn levels_at_rest_until(&self) -> Vec<f64> {
        let group = self.joined_buildings();
        let mut until = vec![f64::INFINITY; group.len()];
        for (building, group) in group.iter().enumerate() {
            until[*group] = until[*group].min(self.at_rest_until(building));
        }
        let first = self.with_mass();
        let motions = self.motions.as_ref();
        let of_level = |level: &ContactLevel| {
            let sides = self
                .buildings_at(level)
                .map(|building| until[group[building]]);
            let grounds = level.terms.ground.iter().filter_map(|(dof, _)| {
                let motion = &motions?.motions[self.moving_ground[dof - first]];
                begin(&motion.acceleration, motion.delay)
            });
            sides.chain(grounds).fold(f64::INFINITY, f64::min)
        };
        self.levels.iter().map(of_level).collect()
    }

    /// For every building the first of those that links and touching floors join to it: what moves
    /// one of them moves all. A gap that is open joins nothing before it closes.
    pub(crate) fn joined_buildings(&self) -> Vec<usize> {
        let mut group: Vec<usize> = (0..self.buildings.len()).collect();
        let (u, _) = self.initial.split_at(self.initial.len() / 2);
        let touches = |level: &&ContactLevel| level.width - level.relative(u) <= TOUCH;
        let gaps = self.levels.iter().filter(touches);
        let gaps = gaps.map(|level| self.buildings_at(level).collect::<Vec<usize>>());
        let links = self.elements.iter().map(|element| {
            let pushed = element.terms.pushed.iter().map(|(dof, _)| *dof);
            let ends = [element.far, element.near].into_iter().flatten();
            let buildings = ends.chain(pushed).filter_map(|dof| self.building_of(dof));
            buildings.collect()
        });
        let joined: Vec<Vec<usize>> = gaps.chain(links).collect();
        // One after another: a row of them needs as many rounds.
        for _ in 0..group.len() {
            for buildings in &joined {
                let groups = buildings.iter().map(|building| group[*building]);
                if let Some(first) = groups.min() {
                    buildings
                        .iter()
                        .for_each(|building| group[*building] = first);
                }
            }
        }
        group
    }

    /// The buildings that meet at a level, each as often as its force acts on coordinates of it.
    pub(crate) fn buildings_at<'s>(
        &'s self,
        level: &'s ContactLevel,
    ) -> impl Iterator<Item = usize> + 's {
        let sides = [level.left, level.right].into_iter().flatten();
        let pushed = level.terms.pushed.iter().map(|(dof, _)| *dof);
        sides.chain(pushed).filter_map(|dof| self.building_of(dof))
    }

    /// The building that a coordinate belongs to; `None` for that of moving ground.
    fn building_of(&self, dof: usize) -> Option<usize> {
        [&self.offsets, &self.further_offsets]
            .into_iter()
            .find_map(|offsets| {
                let building = offsets
                    .partition_point(|first| *first <= dof)
                    .checked_sub(1)?;
                (building + 1 < offsets.len()).then_some(building)
            })
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
