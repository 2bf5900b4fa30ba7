//! Names of a system, under which its parts stand in results.

use pounding_shear_building::{NameError, check_names};

use super::System;

impl System {
    /// Refuses names that cannot stand in messages and results: of buildings, gaps and links, all
    /// different, and of the responses of each building and contact level. Who builds a system by hand may
    /// give it any; writers of results ask for this first.
    ///
    /// # Errors
    /// The first name that cannot be, with what it names and why.
    pub fn check_names(&self) -> Result<(), NameError> {
        check_names("building", self.buildings.iter().map(|b| b.name()))?;
        check_names("gap", self.gaps.iter().map(|g| &*g.name))?;
        check_names("link", self.links.iter().map(|l| &*l.name))?;
        for building in &self.buildings {
            let names = building.responses().iter().map(|r| &*r.name);
            check_names("response of a building", names)?;
        }
        for level in 0..self.levels.len() {
            let own = self.level_rows.iter().filter(|row| row.level == level);
            check_names("response of a gap", own.map(|row| &*row.given.name))?;
        }
        Ok(())
    }
}
