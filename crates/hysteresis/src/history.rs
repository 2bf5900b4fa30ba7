//! What an element remembers: a value shared by all laws.

/// Maximum number of internal variables of a law.
pub const MAXIMUM_INTERNAL_VARIABLES: usize = 2;

/// A point of the force-deformation plane.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// Deformation (m).
    pub deformation: f64,
    /// Force (N).
    pub force: f64,
}

impl Point {
    /// Both coordinates with the sign `side`: a law writes its rules for the
    /// positive side once and mirrors.
    pub(crate) fn mirrored(self, side: f64) -> Self {
        Self {
            deformation: side * self.deformation,
            force: side * self.force,
        }
    }
}

/// The branch that a law is on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Branch {
    /// Number of the branch in the law's own list.
    pub kind: u8,
    /// +1 or -1: the side of the law that the branch belongs to.
    pub side: f64,
    /// +1 or -1 where the branch may be followed in one direction only; 0 where it
    /// may be followed in both.
    pub direction: f64,
    /// Where the branch begins.
    pub start: Point,
    /// Slope of a straight branch (N/m).
    pub stiffness: f64,
    /// Least deformation (m) of the branch; least velocity (m/s) of a viscous law.
    pub lower: f64,
    /// Maximum deformation (m) or velocity (m/s).
    pub upper: f64,
    /// Work of the force (J) up to the start of the branch.
    pub work: f64,
}

impl Branch {
    /// A straight line without ends, to be followed in both directions.
    pub fn line(kind: u8, side: f64, start: Point, stiffness: f64) -> Self {
        Self {
            kind,
            side,
            direction: 0.0,
            start,
            stiffness,
            lower: f64::NEG_INFINITY,
            upper: f64::INFINITY,
            work: 0.0,
        }
    }

    /// The same to be followed in one direction only.
    pub fn towards(mut self, direction: f64) -> Self {
        self.direction = direction;
        self
    }

    /// The same between two deformations on the branch's own side, mirrored.
    pub fn between(mut self, back: f64, front: f64) -> Self {
        (self.lower, self.upper) = if self.side > 0.0 {
            (back, front)
        } else {
            (-front, -back)
        };
        self
    }

    /// Force of a straight branch.
    pub fn force(&self, deformation: f64) -> f64 {
        self.start.force + self.stiffness * (deformation - self.start.deformation)
    }
}

/// What a degrading law remembers of one side, mirrored to the positive side. Each
/// law uses what it needs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Side {
    /// Farthest point reached on the backbone, or the yield point before that.
    pub peak: Point,
    /// Yield force (N) that is left.
    pub yield_force: f64,
    /// Hardening stiffness (N/m) that is left.
    pub hardening: f64,
    /// Force (N) at which the falling line of the backbone meets zero deformation.
    pub cap_intercept: f64,
    /// Maximum force (N) that the side can still reach.
    pub force_limit: f64,
    /// Maximum residual deformation (m) after unloading from this side.
    pub residual: f64,
    /// Where the two legs of pinched reloading meet.
    pub break_point: Point,
}

/// Everything that an element remembers.
///
/// [`Clone::clone_from`] reuses the memory of the target, so that copies in the
/// loop of a method do not allocate.
#[derive(Debug, PartialEq)]
pub struct History {
    pub(crate) deformation: f64,
    pub(crate) velocity: f64,
    pub(crate) variables: [f64; MAXIMUM_INTERNAL_VARIABLES],
    pub(crate) internal_variables: usize,
    pub(crate) branch: Branch,
    pub(crate) sides: [Side; 2],
    /// Unloading stiffness (N/m) of a law that degrades.
    pub(crate) unloading_stiffness: f64,
    /// Energy (J) dissipated when the last excursion was reckoned up.
    pub(crate) reckoned: f64,
    /// Energy (J) dissipated when the unloading stiffness last fell.
    pub(crate) reckoned_unloading: f64,
    /// Energy (J) dissipated before the branch: together with the law's dissipation
    /// along it, the whole.
    pub(crate) dissipated: f64,
    /// Turning points whose loops are still open, the oldest first.
    pub(crate) reversals: Vec<Point>,
}

impl History {
    /// A history at rest on this branch.
    pub(crate) fn new(branch: Branch) -> Self {
        Self {
            deformation: 0.0,
            velocity: 0.0,
            variables: [0.0; MAXIMUM_INTERNAL_VARIABLES],
            internal_variables: 0,
            branch,
            sides: [Side::default(); 2],
            unloading_stiffness: 0.0,
            reckoned: 0.0,
            reckoned_unloading: 0.0,
            dissipated: 0.0,
            reversals: Vec::new(),
        }
    }

    /// Makes the outcome of a trial the committed history. The candidate is left
    /// with some former content, ready for the next trial.
    pub fn commit(&mut self, candidate: &mut Self) {
        std::mem::swap(self, candidate);
    }

    /// Internal variables of the last committed or accepted state.
    #[must_use]
    pub fn variables(&self) -> &[f64] {
        &self.variables[..self.internal_variables]
    }

    /// Number of the held branch in the law's own list: to distinguish branches.
    #[must_use]
    pub fn branch(&self) -> u8 {
        self.branch.kind
    }

    /// What is remembered of the side with this sign.
    pub(crate) fn side(&self, side: f64) -> &Side {
        &self.sides[usize::from(side < 0.0)]
    }

    /// The same to be changed.
    pub(crate) fn side_mut(&mut self, side: f64) -> &mut Side {
        &mut self.sides[usize::from(side < 0.0)]
    }
}

impl Clone for History {
    fn clone(&self) -> Self {
        let mut copy = Self::new(self.branch);
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, source: &Self) {
        self.deformation = source.deformation;
        self.velocity = source.velocity;
        self.variables = source.variables;
        self.internal_variables = source.internal_variables;
        self.branch = source.branch;
        self.sides = source.sides;
        self.unloading_stiffness = source.unloading_stiffness;
        self.reckoned = source.reckoned;
        self.reckoned_unloading = source.reckoned_unloading;
        self.dissipated = source.dissipated;
        self.reversals.clone_from(&source.reversals);
    }
}
