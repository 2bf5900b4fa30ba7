//! A shear building.

mod founded;

use nalgebra::DMatrix;

use crate::column::HitLine;
use crate::coordinates::{
    Coordinate, Excitation, GeneralBuilding, ResponseRow, weights_over_heights,
};
use crate::damping::{Damping, DampingMatrix};
use crate::elevation::elevations;
use crate::error::ShearBuildingError;
use crate::isolator::{Isolator, IsolatorProperties};
use crate::lateral::LateralStiffness;
use crate::modes::Modes;
use crate::stiffness::StiffnessMatrix;
use crate::storey_law::StoreyLaw;
use crate::tridiagonal::SymmetricTridiagonal;
use crate::undamped::{Undamped, undamped, undamped_dense};
use crate::yielding_frame::YieldingFrame;

pub use founded::{OVERTURNING_RATIO, OnFoundation, UPLIFT_BEGINS};

/// A column of a building that is hit at points with a mass, for
/// [`ShearBuilding::with_contact_points`].
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLine {
    /// Its storey, from zero.
    pub storey: usize,
    /// Its points, from the bottom.
    pub line: HitLine,
    /// Mass of each point (kg).
    pub mass: f64,
}

/// Storeys of a building at most: its mode shapes are a full matrix, beside which a run
/// keeps eight more of the same size (together 1.2 GB for so many storeys), and the work to
/// find and to use them grows at least with the square of the storeys.
pub const MAXIMUM_STOREYS: usize = 4_000;

/// A chain of storeys with everything that follows from it, computed once.
#[derive(Debug, Clone)]
pub struct ShearBuilding {
    name: String,
    mass: Vec<f64>,
    stiffness: Vec<f64>,
    /// The matrix of a building that is no chain, without what gravity takes off.
    elastic: Option<DMatrix<f64>>,
    asymmetry: f64,
    height: Vec<f64>,
    laws: Vec<Option<StoreyLaw>>,
    frames: Vec<YieldingFrame>,
    isolator: Option<(Isolator, IsolatorProperties)>,
    geometric: Vec<f64>,
    /// The same of all coordinates, of a building that is given so.
    geometric_matrix: Option<DMatrix<f64>>,
    elevations: Vec<f64>,
    damping: Damping,
    stiffness_matrix: StiffnessMatrix,
    damping_matrix: DampingMatrix,
    modes: Modes,
    /// Masses of the floors, then those of the further coordinates.
    inertia: Vec<f64>,
    further: Vec<Coordinate>,
    drifts: Option<Vec<Vec<f64>>>,
    /// Given storey shears and base moment of a building with further coordinates.
    sections: Option<Vec<Vec<f64>>>,
    responses: Vec<ResponseRow>,
    foundation: Option<Box<OnFoundation>>,
    /// Of every further coordinate that floors carry along, their parts in it.
    carried: Vec<Vec<f64>>,
}

impl ShearBuilding {
    /// A building from floor masses (kg), storey stiffnesses (N/m) and storey
    /// heights (m), one a storey, bottom first.
    ///
    /// # Errors
    /// No storeys, more than [`MAXIMUM_STOREYS`], lists of unequal length, a value that is
    /// not positive and finite, values so far apart that the modes cannot be resolved, or damping out
    /// of range.
    pub fn new(
        name: String,
        mass: Vec<f64>,
        stiffness: Vec<f64>,
        height: Vec<f64>,
        damping: Damping,
    ) -> Result<Self, ShearBuildingError> {
        Self::under_gravity(name, mass, stiffness, height, damping, 0.0)
    }

    /// The same with the second-order effect of gravity (P-Delta): in every storey the
    /// weight above, through the drift over the storey height, takes
    /// `weight / height` off the stiffness (Chopra, Dynamics of Structures, section
    /// 9.7, straight-line approximation). Modes, and damping that is given by ratios or
    /// by the stiffness, belong to the reduced stiffness. `gravity` in m/s2; zero
    /// leaves the effect out.
    ///
    /// # Errors
    /// As [`ShearBuilding::new`], and a storey that gravity overturns.
    pub fn under_gravity(
        name: String,
        mass: Vec<f64>,
        stiffness: Vec<f64>,
        height: Vec<f64>,
        damping: Damping,
        gravity: f64,
    ) -> Result<Self, ShearBuildingError> {
        let parts = Parts::new(name, mass, height, damping, gravity)?;
        check(&parts.name, "stiffness", &stiffness, parts.mass.len())?;
        for (i, geometric) in parts.geometric.iter().enumerate() {
            if !(*geometric < stiffness[i]) {
                return Err(ShearBuildingError::Unstable {
                    building: parts.name,
                    storey: i + 1,
                    load: geometric * parts.height[i],
                    height: parts.height[i],
                    geometric: *geometric,
                    stiffness: stiffness[i],
                });
            }
        }
        let storeys = stiffness.iter().zip(&parts.geometric);
        let lateral: Vec<f64> = storeys.map(|(k, g)| k - g).collect();
        let chain = SymmetricTridiagonal::chain(&lateral);
        let undamped = undamped(&parts.mass, &lateral, &chain);
        let matrices = (StiffnessMatrix::Tridiagonal(chain), None);
        Self::finish(parts, stiffness, matrices, undamped)
    }

    /// A building on isolators, which are its first storey, below the base slab: `mass` and
    /// `height` have the slab as their first floor, `stiffness` the storeys above it, one
    /// fewer. `superstructure` damps those as if the slab were fixed
    /// ([`Damping::Isolated`]).
    ///
    /// # Errors
    /// As [`ShearBuilding::new`], and isolators that cannot be.
    pub fn on_isolators(
        name: String,
        mass: Vec<f64>,
        stiffness: &[f64],
        height: Vec<f64>,
        superstructure: Damping,
        isolator: Isolator,
    ) -> Result<Self, ShearBuildingError> {
        let refused = |source| ShearBuildingError::Isolator {
            building: name.clone(),
            source,
        };
        let whole = mass.iter().sum();
        let properties = isolator.properties(whole).map_err(refused)?;
        let law = isolator.law(whole).map_err(refused)?;
        let initial = match &law {
            Some(law) => law.law.initial_stiffness(),
            None => properties.initial_stiffness,
        };
        let storeys = std::iter::once(&initial).chain(stiffness).copied();
        let damping = Damping::Isolated {
            superstructure: Box::new(superstructure),
            isolators: isolator.dashpot,
        };
        let mut building = Self::new(name, mass, storeys.collect(), height, damping)?;
        building.laws[0] = law;
        building.isolator = Some((isolator, properties));
        Ok(building)
    }

    /// The isolators that the building stands on, with what they are under its weight.
    #[must_use]
    pub fn isolator(&self) -> Option<&(Isolator, IsolatorProperties)> {
        self.isolator.as_ref()
    }

    /// A building whose floors all act on one another: a frame or a wall, condensed to the
    /// displacements of its floors. Gravity enters as in [`ShearBuilding::under_gravity`].
    ///
    /// # Errors
    /// As [`ShearBuilding::under_gravity`], a matrix of another size or of storeys of other heights, dashpots as
    /// damping, and a matrix that is not positive definite, with what gravity takes off
    /// it.
    pub fn with_stiffness_matrix(
        name: String,
        mass: Vec<f64>,
        stiffness: LateralStiffness,
        height: Vec<f64>,
        damping: Damping,
        gravity: f64,
    ) -> Result<Self, ShearBuildingError> {
        let parts = Parts::new(name, mass, height, damping, gravity)?;
        let asymmetry = stiffness.asymmetry();
        let n = parts.mass.len();
        let made_from = stiffness.heights().filter(|heights| heights.len() == n);
        let mut both = parts.height.iter().zip(made_from.unwrap_or_default());
        // A unit rounds.
        let differ = |(own, other): (&f64, &f64)| (own - other).abs() > 1.0e-9 * own;
        if let Some(storey) = both.position(differ) {
            return Err(ShearBuildingError::OtherHeight {
                building: parts.name,
                storey: storey + 1,
                height: parts.height[storey],
                of_matrix: made_from.map_or(0.0, |heights| heights[storey]),
            });
        }
        let elastic = stiffness.into_matrix();
        if elastic.nrows() != n {
            return Err(ShearBuildingError::Length {
                building: parts.name,
                quantity: "stiffness matrix",
                found: elastic.nrows(),
                expected: n,
            });
        }
        let off = SymmetricTridiagonal::chain(&parts.geometric);
        let matrix = DMatrix::from_fn(n, n, |i, j| elastic[(i, j)] - off.entry(i, j));
        if gravity > 0.0 && matrix.clone().cholesky().is_none() {
            return Err(ShearBuildingError::UnstableMatrix {
                building: parts.name,
            });
        }
        let undamped = undamped_dense(&parts.mass, &matrix, n);
        let matrices = (StiffnessMatrix::Dense(matrix), Some(elastic));
        let building = Self::finish(parts, Vec::new(), matrices, undamped)?;
        Ok(Self {
            asymmetry,
            ..building
        })
    }

    /// A building of floors and other coordinates with full stiffness and damping matrices,
    /// floors first. Damping by ratios belongs to the modes of all coordinates. Its storeys
    /// have no laws.
    ///
    /// # Errors
    /// As [`ShearBuilding::with_stiffness_matrix`], and matrices and rows whose size is not
    /// that of the coordinates or of the storeys.
    pub fn with_coordinates(general: GeneralBuilding) -> Result<Self, ShearBuildingError> {
        let GeneralBuilding {
            name,
            mass,
            height,
            further,
            mut stiffness,
            damping,
            drifts,
            sections,
            responses,
            geometric,
        } = general;
        let mut parts = Parts::new(name, mass, height, damping, 0.0)?;
        let (floors, all) = (parts.mass.len(), parts.mass.len() + further.len());
        let inertia = further.iter().map(|c| c.inertia);
        for (coordinate, inertia) in further.iter().zip(inertia) {
            if !(inertia.is_finite() && inertia > 0.0) {
                return Err(ShearBuildingError::Inertia {
                    building: parts.name,
                    coordinate: coordinate.name.clone(),
                    value: inertia,
                });
            }
            parts.inertia.push(inertia);
        }
        let of_drifts = drifts.iter().flatten();
        let of_responses = responses.iter().map(|r| &r.weights);
        let by_gravity = geometric.as_ref();
        let matrices = std::iter::once(&stiffness).chain(by_gravity.map(|g| &g.matrix));
        let sizes = matrices.flat_map(|matrix| [matrix.nrows(), matrix.ncols()]);
        let rows = of_drifts.chain(&sections).chain(of_responses);
        let wrong = sizes.chain(rows.map(Vec::len));
        let lists = [
            (drifts.as_ref().map_or(floors, Vec::len), floors),
            (by_gravity.map_or(floors, |g| g.storeys.len()), floors),
            (sections.len(), floors + 1),
        ];
        let wrong = wrong.map(|found| (found, all)).chain(lists);
        for (found, expected) in wrong {
            if found != expected {
                return Err(ShearBuildingError::Length {
                    building: parts.name,
                    quantity: "matrix or row over its coordinates",
                    found,
                    expected,
                });
            }
        }
        let of_responses = responses.iter().map(|r| &r.weights);
        let weights = drifts.iter().flatten().chain(&sections).chain(of_responses);
        let weights = weights.chain(by_gravity.map(|g| &g.storeys));
        if let Some(value) = weights.flatten().find(|weight| !weight.is_finite()) {
            return Err(ShearBuildingError::Weight {
                building: parts.name,
                value: *value,
            });
        }
        let across = |c: &Coordinate| c.excitation != Excitation::Along;
        let still = further.iter().map(across);
        let influence = (vec![false; floors].into_iter().chain(still))
            .map(|still| f64::from(u8::from(!still)))
            .collect();
        let geometric_matrix = geometric.map(|of_gravity| {
            parts.geometric = of_gravity.storeys;
            stiffness -= &of_gravity.matrix;
            of_gravity.matrix
        });
        if geometric_matrix.is_some() && stiffness.clone().cholesky().is_none() {
            return Err(ShearBuildingError::UnstableMatrix {
                building: parts.name,
            });
        }
        let undamped = undamped_dense(&parts.inertia, &stiffness, floors);
        let matrices = (StiffnessMatrix::Dense(stiffness), None);
        let building = Self::finish_with(parts, Vec::new(), matrices, undamped, influence)?;
        Ok(Self {
            geometric_matrix,
            further,
            drifts,
            sections: Some(sections),
            responses,
            ..building
        })
    }

    fn finish(
        parts: Parts,
        stiffness: Vec<f64>,
        matrices: (StiffnessMatrix, Option<DMatrix<f64>>),
        undamped: Undamped,
    ) -> Result<Self, ShearBuildingError> {
        let influence = vec![1.0; parts.mass.len()];
        Self::finish_with(parts, stiffness, matrices, undamped, influence)
    }

    /// `influence` is the displacement of every coordinate by a unit shift of the ground along
    /// the row.
    fn finish_with(
        parts: Parts,
        stiffness: Vec<f64>,
        (stiffness_matrix, elastic): (StiffnessMatrix, Option<DMatrix<f64>>),
        undamped: Undamped,
        influence: Vec<f64>,
    ) -> Result<Self, ShearBuildingError> {
        let Parts {
            name,
            mass,
            inertia,
            height,
            damping,
            geometric,
        } = parts;
        let wrong = |w: &f64| !(w.is_finite() && *w > 0.0);
        if let Some(j) = undamped.circular_frequency.iter().position(wrong) {
            return Err(ShearBuildingError::Modes {
                building: name,
                mode: j + 1,
                frequency: undamped.circular_frequency[j],
            });
        }
        let damping_matrix = damping
            .matrix(&inertia, &stiffness_matrix, &undamped)
            .map_err(|reason| ShearBuildingError::Damping {
                building: name.clone(),
                reason,
            })?;
        let moved: Vec<f64> = inertia.iter().zip(influence).map(|(m, r)| m * r).collect();
        let modes = Modes::new(undamped, &moved, (&damping, &damping_matrix));
        let elevations = elevations(&height);
        Ok(Self {
            inertia,
            further: Vec::new(),
            drifts: None,
            sections: None,
            responses: Vec::new(),
            foundation: None,
            carried: Vec::new(),
            laws: vec![None; mass.len()],
            frames: Vec::new(),
            isolator: None,
            geometric,
            geometric_matrix: None,
            name,
            mass,
            stiffness,
            elastic,
            asymmetry: 0.0,
            height,
            elevations,
            damping,
            stiffness_matrix,
            damping_matrix,
            modes,
        })
    }

    /// The same building with the points of its columns that floors of a neighbour hit as
    /// coordinates after the floors, column after column. Its storeys, which have these columns
    /// in them, stay as they are, and so do storey shears and base moments: the forces of a hit
    /// stand in the responses of the column ([`HitLine::responses`]).
    ///
    /// Damping in proportion to mass and stiffness has the factors that the building has
    /// without points, on all coordinates. Modal damping stays that of the floors, and a point
    /// moves against its column with the ratio of the highest mode. Dashpots stay those of the
    /// storeys, and a column has the one of its storey in the proportion of the stiffnesses.
    ///
    /// # Errors
    /// A mass that is not above zero, a storey that does not exist, and a building with storey
    /// laws or further coordinates.
    pub fn with_contact_points(self, lines: &[ContactLine]) -> Result<Self, ShearBuildingError> {
        let floors = self.storeys();
        let refuse = |reason: String| {
            Err(ShearBuildingError::ContactPoints {
                building: self.name.clone(),
                reason,
            })
        };
        if self.laws.iter().any(Option::is_some) {
            return refuse("its storeys follow laws".to_owned());
        }
        if !self.further.is_empty() {
            return refuse("it has further coordinates already".to_owned());
        }
        if let Some(line) = lines.iter().find(|l| l.storey >= floors) {
            return refuse(format!("it has no storey {}", line.storey + 1));
        }
        let (mut further, mut inertia) = (Vec::new(), self.mass.clone());
        for line in lines {
            let coordinate = Coordinate {
                name: format!("contact point of storey {}", line.storey + 1),
                inertia: line.mass,
                excitation: Excitation::Along,
            };
            if !(line.mass.is_finite() && line.mass > 0.0) {
                return Err(ShearBuildingError::Inertia {
                    building: self.name,
                    coordinate: coordinate.name,
                    value: line.mass,
                });
            }
            for _ in line.line.points() {
                further.push(coordinate.clone());
                inertia.push(line.mass);
            }
        }
        let all = inertia.len();
        let padded = |entry: &dyn Fn(usize, usize) -> f64| {
            let within = |i: usize, j: usize| i < floors && j < floors;
            DMatrix::from_fn(
                all,
                all,
                |i, j| if within(i, j) { entry(i, j) } else { 0.0 },
            )
        };
        let mut stiffness = padded(&|i, j| self.stiffness_matrix.entry(i, j));
        add_lines(&mut stiffness, floors, lines, &|line| {
            line.line.stiffness().clone()
        });
        let factors = self.damping.factors(&self.modes.circular_frequency);
        let factors = factors.map_err(|reason| ShearBuildingError::Damping {
            building: self.name.clone(),
            reason,
        })?;
        let with_points = |of: &dyn Fn(&ContactLine) -> DMatrix<f64>| {
            let mut matrix = padded(&|i, j| self.damping_matrix.entry(i, j));
            add_lines(&mut matrix, floors, lines, of);
            Damping::Matrix { matrix }
        };
        let damping = match (factors, &self.damping) {
            (Some([alpha, beta]), _) => Damping::Rayleigh { alpha, beta },
            (None, Damping::Modal { ratios }) => with_points(&|line| {
                let ratio = ratios.last().copied().unwrap_or(0.0);
                2.0 * ratio * line.mass.sqrt() * square_root(line.line.stiffness())
            }),
            (None, Damping::Dashpots { coefficients }) => with_points(&|line| {
                let (c, k) = (coefficients[line.storey], self.stiffness[line.storey]);
                line.line.stiffness() * (c / k)
            }),
            (None, _) => {
                return refuse("its damping says nothing of points of columns".to_owned());
            }
        };
        let sections = self.elastic.is_some().then(|| self.section_forces());
        let sections = sections.flatten().map(|rows| {
            let mut rows = rows;
            rows.iter_mut().for_each(|row| row.resize(all, 0.0));
            rows
        });
        let undamped = undamped_dense(&inertia, &stiffness, floors);
        let parts = Parts {
            name: self.name,
            mass: self.mass,
            inertia,
            height: self.height,
            damping,
            geometric: self.geometric,
        };
        let matrices = (StiffnessMatrix::Dense(stiffness), self.elastic);
        let influence = vec![1.0; all];
        let made = Self::finish_with(parts, self.stiffness, matrices, undamped, influence)?;
        let carried = lines.iter().flat_map(|line| {
            line.line.points().iter().map(|point| {
                let [lower, upper] = point.shares();
                let mut parts = vec![0.0; floors];
                parts[line.storey] = upper;
                if let Some(below) = line.storey.checked_sub(1) {
                    parts[below] = lower;
                }
                parts
            })
        });
        Ok(Self {
            asymmetry: self.asymmetry,
            further,
            sections,
            carried: carried.collect(),
            ..made
        })
    }

    /// The same building with laws in the place of storey stiffnesses, one entry a
    /// storey. Modes and damping stay those of the elastic building.
    ///
    /// # Errors
    /// A number of entries other than that of the storeys, a law of links alone, or one whose
    /// initial stiffness is not the stiffness of its storey.
    pub fn with_laws(mut self, laws: Vec<Option<StoreyLaw>>) -> Result<Self, ShearBuildingError> {
        if laws.len() != self.storeys() {
            return Err(ShearBuildingError::Length {
                building: self.name,
                quantity: "storey law",
                found: laws.len(),
                expected: self.mass.len(),
            });
        }
        for (i, law) in laws.iter().enumerate() {
            let Some(StoreyLaw { law, .. }) = law else {
                continue;
            };
            if let Some(reason) = law.descriptor().link_alone {
                return Err(ShearBuildingError::LawOfLinks {
                    building: self.name,
                    storey: i + 1,
                    law: law.descriptor().name,
                    reason,
                });
            }
            let Some(elastic) = self.stiffness.get(i).copied() else {
                return Err(ShearBuildingError::Law {
                    building: self.name,
                    storey: i + 1,
                    law: law.descriptor().name,
                    reason: "a law takes the place of one storey's stiffness, and a stiffness matrix has no storeys".to_owned(),
                });
            };
            let initial = law.initial_stiffness();
            if !((initial - elastic).abs() <= SAME_STIFFNESS * elastic) {
                return Err(ShearBuildingError::Law {
                    building: self.name,
                    storey: i + 1,
                    law: law.descriptor().name,
                    reason: format!(
                        "its initial stiffness is {initial} N/m, that of the storey {elastic} N/m"
                    ),
                });
            }
        }
        self.laws = laws;
        Ok(self)
    }

    /// Laws in the place of storey stiffnesses, one entry a storey, bottom first.
    #[must_use]
    pub fn laws(&self) -> &[Option<StoreyLaw>] {
        &self.laws
    }

    /// The same building of floors and other coordinates with laws in the place of stiffnesses of its frames in
    /// single storeys. Its stiffness matrix holds the initial stiffnesses of these laws: modes and damping are those
    /// of the elastic building.
    ///
    /// # Errors
    /// A building without other coordinates than floors, a storey or coordinate that it has not, and a law of links alone.
    pub fn with_yielding_frames(
        mut self,
        frames: Vec<YieldingFrame>,
    ) -> Result<Self, ShearBuildingError> {
        for frame in &frames {
            let (law, storey) = (frame.law.law.descriptor(), frame.storey + 1);
            if let Some(reason) = law.link_alone {
                return Err(ShearBuildingError::LawOfLinks {
                    building: self.name,
                    storey,
                    law: law.name,
                    reason,
                });
            }
            let wrong =
                |(i, weight): &(usize, f64)| *i >= self.coordinates() || !weight.is_finite();
            if self.sections.is_none()
                || frame.storey >= self.storeys()
                || frame.deformation.iter().any(wrong)
            {
                return Err(ShearBuildingError::Law {
                    building: self.name,
                    storey,
                    law: law.name,
                    reason: "the building has no such storey, or no such coordinate".to_owned(),
                });
            }
        }
        self.frames = frames;
        Ok(self)
    }

    /// Frames with a law in the place of their stiffness in a storey, one entry a frame and storey.
    #[must_use]
    pub fn yielding_frames(&self) -> &[YieldingFrame] {
        &self.frames
    }

    /// Laws of storeys from the bottom, then those of frames.
    pub fn all_laws(&self) -> impl Iterator<Item = &StoreyLaw> {
        let frames = self.frames.iter().map(|frame| &frame.law);
        self.laws.iter().flatten().chain(frames)
    }

    /// What gravity takes off the storey stiffnesses (N/m); zeros without P-Delta.
    #[must_use]
    pub fn geometric_stiffness(&self) -> &[f64] {
        &self.geometric
    }

    /// What gravity takes off the stiffness of all coordinates (N/m; N m/rad on the diagonal of rotations), where that
    /// was given ([`ShearBuilding::with_coordinates`]).
    #[must_use]
    pub fn geometric_matrix(&self) -> Option<&DMatrix<f64>> {
        self.geometric_matrix.as_ref()
    }

    /// Name of the building.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of storeys.
    #[must_use]
    pub fn storeys(&self) -> usize {
        self.mass.len()
    }

    /// Floor masses (kg), bottom first.
    #[must_use]
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Elastic storey stiffnesses (N/m), bottom first: of the columns, without what
    /// gravity takes off. None where the building has a matrix
    /// ([`ShearBuilding::section_forces`]).
    #[must_use]
    pub fn stiffness(&self) -> &[f64] {
        &self.stiffness
    }

    /// Storey heights (m), bottom first.
    #[must_use]
    pub fn height(&self) -> &[f64] {
        &self.height
    }

    /// Floor elevations above the ground (m), bottom first, as [`elevations`] has them.
    #[must_use]
    pub fn elevations(&self) -> &[f64] {
        &self.elevations
    }

    /// Damping as it was asked for.
    #[must_use]
    pub fn damping(&self) -> &Damping {
        &self.damping
    }

    /// Storey shears (N), bottom first, then the overturning moment at the base (N m), as
    /// rows on the floor displacements: `V_i = sum (K u)_j` over the floors from `i` on,
    /// `M = sum (K u)_j z_j`, with `K` without what gravity takes off (Chopra, Dynamics of
    /// Structures, section 9.4). `None` for a chain of storeys, whose shears are stiffness
    /// times drift. Rows of a building on a foundation are elastic, also of storeys with laws.
    #[must_use]
    pub fn section_forces(&self) -> Option<Vec<Vec<f64>>> {
        if self.sections.is_some() {
            return self.sections.clone();
        }
        let elastic = self.elastic.as_ref()?;
        let n = self.storeys();
        // From the roof down.
        let (mut shear, mut moment) = (vec![0.0; n], vec![0.0; n]);
        let mut rows = vec![Vec::new(); n];
        for i in (0..n).rev() {
            for j in 0..n {
                shear[j] += elastic[(i, j)];
                moment[j] += self.elevations[i] * elastic[(i, j)];
            }
            rows[i].clone_from(&shear);
        }
        rows.push(moment);
        Some(rows)
    }

    /// Rows of the stiffness matrix (N/m) without what gravity takes off; `None` for a chain
    /// of storeys, which [`ShearBuilding::stiffness`] describes.
    #[must_use]
    pub fn elastic_stiffness_matrix(&self) -> Option<Vec<Vec<f64>>> {
        let rows = self.elastic.as_ref()?.row_iter();
        Some(rows.map(|row| row.iter().copied().collect()).collect())
    }

    /// Difference of entries on both sides of the diagonal that the given matrix had, over its
    /// largest entry ([`LateralStiffness::asymmetry`]).
    #[must_use]
    pub fn asymmetry(&self) -> f64 {
        self.asymmetry
    }

    /// Stiffness matrix (N/m), with what gravity takes off where P-Delta is on.
    #[must_use]
    pub fn stiffness_matrix(&self) -> &StiffnessMatrix {
        &self.stiffness_matrix
    }

    /// Damping matrix (N s/m).
    #[must_use]
    pub fn damping_matrix(&self) -> &DampingMatrix {
        &self.damping_matrix
    }

    /// Modal properties.
    #[must_use]
    pub fn modes(&self) -> &Modes {
        &self.modes
    }

    /// Coordinates after the floors.
    #[must_use]
    pub fn further_coordinates(&self) -> &[Coordinate] {
        &self.further
    }

    /// Value of a further coordinate (from zero) that goes with these values of the floors
    /// while nothing acts on it: that of a point of a column, which its floors carry along;
    /// zero for others.
    #[must_use]
    pub fn carried_along(&self, further: usize, floors: &[f64]) -> f64 {
        let parts = self.carried.get(further).into_iter().flatten();
        parts.zip(floors).map(|(part, x)| part * x).sum()
    }

    /// Number of coordinates: floors and others.
    #[must_use]
    pub fn coordinates(&self) -> usize {
        self.inertia.len()
    }

    /// Masses (kg) and moments of inertia (kg m2) of all coordinates, floors first.
    #[must_use]
    pub fn inertia(&self) -> &[f64] {
        &self.inertia
    }

    /// Drift of every storey (m) as a sum over the coordinates; `None` where it is the
    /// difference of the floors at both its ends.
    #[must_use]
    pub fn drifts(&self) -> Option<&[Vec<f64>]> {
        self.drifts.as_deref()
    }

    /// Responses with names of their own.
    #[must_use]
    pub fn responses(&self) -> &[ResponseRow] {
        &self.responses
    }

    /// Number of the fundamental mode along the row: on a foundation that moves the first one, as the
    /// mass of the foundation may make another one's effective mass the largest, otherwise
    /// [`Modes::fundamental`].
    #[must_use]
    pub fn fundamental_mode(&self) -> usize {
        match &self.foundation {
            Some(_) => 0,
            None => self.modes.fundamental(),
        }
    }

    /// The foundation that the building stands on, if it sways or rocks
    /// ([`ShearBuilding::on_foundation`]).
    #[must_use]
    pub fn foundation(&self) -> Option<&OnFoundation> {
        self.foundation.as_deref()
    }

    /// The building on a fixed base: itself, unless it stands on a foundation that sways or
    /// rocks.
    #[must_use]
    pub fn without_foundation(&self) -> &Self {
        self.foundation().map_or(self, OnFoundation::fixed_base)
    }

    /// The same building, made of another one on this foundation.
    pub(crate) fn standing_on(self, foundation: OnFoundation) -> Self {
        let fixed = foundation.fixed_base();
        Self {
            geometric: fixed.geometric.clone(),
            asymmetry: fixed.asymmetry,
            laws: fixed.laws.clone(),
            foundation: Some(Box::new(foundation)),
            ..self
        }
    }

    /// Stiffness matrix of the floors (N/m) without what gravity takes off; `None` for a
    /// building of floors and other coordinates.
    pub(crate) fn elastic_matrix(&self) -> Option<DMatrix<f64>> {
        if self.sections.is_some() {
            return None;
        }
        Some(self.elastic.clone().unwrap_or_else(|| {
            let chain = SymmetricTridiagonal::chain(&self.stiffness);
            let n = self.storeys();
            DMatrix::from_fn(n, n, |i, j| chain.entry(i, j))
        }))
    }

    /// `out = C v` (N); one value a storey.
    pub fn apply_damping(&self, v: &[f64], out: &mut [f64]) {
        self.damping_matrix.multiply(v, out);
    }
}

/// Adds a matrix of each column, on the floors at its ends and on its points, to one of all
/// coordinates.
fn add_lines(
    whole: &mut DMatrix<f64>,
    floors: usize,
    lines: &[ContactLine],
    of: &dyn Fn(&ContactLine) -> DMatrix<f64>,
) {
    let mut first = floors;
    for line in lines {
        let count = line.line.points().len();
        // The ground below the first storey has no coordinate.
        let ends = [line.storey.checked_sub(1), Some(line.storey)];
        let places: Vec<Option<usize>> = ends
            .into_iter()
            .chain((first..first + count).map(Some))
            .collect();
        let matrix = line.line.on_floors(&of(line));
        for (i, row) in places.iter().enumerate() {
            for (j, column) in places.iter().enumerate() {
                if let (Some(row), Some(column)) = (row, column) {
                    // Both triangles alike, to the bit.
                    whole[(*row, *column)] += matrix[(i.min(j), i.max(j))];
                }
            }
        }
        first += count;
    }
}

/// The symmetric square root of a positive definite matrix.
fn square_root(matrix: &DMatrix<f64>) -> DMatrix<f64> {
    let eigen = matrix.clone().symmetric_eigen();
    let roots = eigen.eigenvalues.map(|x| x.max(0.0).sqrt());
    let vectors = &eigen.eigenvectors;
    vectors * DMatrix::from_diagonal(&roots) * vectors.transpose()
}

/// Relative difference of two stiffnesses that are meant to be equal.
const SAME_STIFFNESS: f64 = 1.0e-6;

/// What buildings of all kinds are made of.
struct Parts {
    name: String,
    mass: Vec<f64>,
    /// Masses of all coordinates, floors first.
    inertia: Vec<f64>,
    height: Vec<f64>,
    damping: Damping,
    geometric: Vec<f64>,
}

/// Sum of masses (kg), heights (m) or stiffnesses (N/m) of a building at most: a little beyond it products with
/// gravity are no numbers.
const LARGEST_SUM: f64 = 1.0e300;
/// The smallest of such values: what is divided by it stays a number.
const SMALLEST: f64 = 1.0e-100;

impl Parts {
    fn new(
        name: String,
        mass: Vec<f64>,
        height: Vec<f64>,
        damping: Damping,
        gravity: f64,
    ) -> Result<Self, ShearBuildingError> {
        if mass.is_empty() {
            return Err(ShearBuildingError::NoStoreys { building: name });
        }
        if mass.len() > MAXIMUM_STOREYS {
            return Err(ShearBuildingError::TooManyStoreys {
                building: name,
                storeys: mass.len(),
                largest: MAXIMUM_STOREYS,
            });
        }
        check(&name, "mass", &mass, mass.len())?;
        check(&name, "height", &height, mass.len())?;
        Ok(Self {
            geometric: weights_over_heights(&mass, &height, gravity),
            name,
            inertia: mass.clone(),
            mass,
            height,
            damping,
        })
    }
}

fn check(
    building: &str,
    quantity: &'static str,
    values: &[f64],
    storeys: usize,
) -> Result<(), ShearBuildingError> {
    if values.len() != storeys {
        return Err(ShearBuildingError::Length {
            building: building.to_owned(),
            quantity,
            found: values.len(),
            expected: storeys,
        });
    }
    let refused = |i: usize, required| {
        Err(ShearBuildingError::Value {
            building: building.to_owned(),
            quantity,
            storey: i + 1,
            value: values[i],
            required,
        })
    };
    if let Some(i) = values.iter().position(|x| !(x.is_finite() && *x > 0.0)) {
        return refused(i, "greater than zero");
    }
    if let Some(i) = values.iter().position(|x| *x < SMALLEST) {
        return refused(i, "1e-100 or more: check its unit");
    }
    // The weight of all storeys, and how high they stand, are sums of such values.
    let mut sum = 0.0;
    for (i, value) in values.iter().enumerate() {
        sum += value;
        if sum > LARGEST_SUM {
            return refused(i, "less than 1e300 with those below: check its unit");
        }
    }
    Ok(())
}
