//! Where everything stands in the state of a run.

use crate::system::{Element, System};

/// Where everything stands in the flat state vector.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Layout {
    pub dofs: usize,
    pub levels: usize,
    /// Internal variables of all elements.
    pub variables: usize,
}

impl Layout {
    pub(crate) fn of(system: &System) -> Self {
        Self {
            dofs: system.degrees_of_freedom(),
            levels: system.levels().len(),
            variables: system
                .elements()
                .iter()
                .map(|e| e.law.internal_variables())
                .sum(),
        }
    }
    /// Displacements, velocities and internal variables: what forces depend on.
    pub(crate) fn motion(self) -> usize {
        2 * self.dofs + self.variables
    }
    /// Length of the state vector.
    pub(crate) fn dimension(self) -> usize {
        self.motion() + 2 + 2 * self.levels
    }
    /// Work of the ground motion on the buildings (J).
    pub(crate) fn input(self) -> usize {
        self.motion()
    }
    /// Work of the viscous damping (J).
    pub(crate) fn viscous(self) -> usize {
        self.motion() + 1
    }
    /// Work done on the contact of a level (J).
    pub(crate) fn work(self, level: usize) -> usize {
        self.motion() + 2 + level
    }
    /// Impulse of the contact force of a level (N s).
    pub(crate) fn impulse(self, level: usize) -> usize {
        self.motion() + 2 + self.levels + level
    }
}

impl Element {
    /// Where its internal variables stand in the state.
    pub(crate) fn range(&self, layout: Layout) -> std::ops::Range<usize> {
        let first = 2 * layout.dofs + self.first_variable;
        first..first + self.law.internal_variables()
    }
}
