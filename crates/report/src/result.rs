//! What a page shows of the result of a run.

use hdf5::H5Type;
use pounding_files::checksum::Checksum;

/// Rows of a quantity over time: one column per storey or level.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    /// Row after row.
    pub values: Vec<f64>,
    /// Columns.
    pub columns: usize,
}

impl Table {
    /// One column.
    pub fn column(&self, index: usize) -> impl Iterator<Item = f64> + '_ {
        self.values
            .iter()
            .skip(index)
            .step_by(self.columns.max(1))
            .copied()
    }
}

/// Peaks of one quantity of all storeys, with and without gaps and links.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StoreyPeaks {
    /// With them.
    pub value: Vec<f64>,
    /// Of the isolated building.
    pub isolated: Vec<f64>,
}

/// Peak overturning moment at the base of a building, with and without gaps and links.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BaseMoment {
    /// With them (N m).
    pub value: f64,
    /// When (s).
    pub time: f64,
    /// Of the isolated building (N m).
    pub isolated: f64,
}

/// The peak of a response with a name of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedResponse {
    /// Name in the file, such as `foundation_rotation`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Peak magnitude.
    pub value: f64,
    /// When (s).
    pub time: f64,
    /// Peak magnitude in the isolated building.
    pub isolated: f64,
}

/// A frame with a law in one storey of a building that turns in plan.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameResult {
    /// `along` the row or `across` it.
    pub direction: String,
    /// Distance from the mass centre (m).
    pub at: f64,
    /// Storey, from 1.
    pub storey: usize,
    /// Name of the law.
    pub law: String,
    /// Maximum force (N).
    pub force: f64,
    /// When (s).
    pub force_time: f64,
    /// Maximum deformation (m).
    pub deformation: f64,
    /// Maximum deformation over that at first yield (-); NaN without a yield force.
    pub ductility: f64,
    /// Deformation at the end less what elastic unloading gives back (m).
    pub residual_deformation: f64,
}

/// Peaks of a response of the levels of a gap.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelResponses {
    /// Name in the file, such as `column_shear_below`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Peak magnitude of every level, bottom first; NaN where a level has no such response.
    pub value: Vec<f64>,
    /// When (s).
    pub time: Vec<f64>,
    /// What every level can bear; NaN where that is not known, empty where it is of none.
    pub capacity: Vec<f64>,
}

/// What the isolators under a building went through, with and without gaps and links.
#[derive(Debug, Clone, PartialEq)]
pub struct IsolatorResult {
    /// Name of their kind.
    pub model: String,
    /// Peak displacement (m).
    pub displacement: f64,
    /// The same of the building without gaps and links.
    pub isolated_displacement: f64,
    /// Peak force of their law (N).
    pub force: f64,
    /// The same of the building without gaps and links.
    pub isolated_force: f64,
    /// Period of the secant stiffness at the peak displacement (s).
    pub effective_period: f64,
    /// Damping ratio of a loop to it (-).
    pub effective_damping_ratio: f64,
}

/// One building.
#[derive(Debug, Clone, PartialEq)]
pub struct BuildingResult {
    /// Name.
    pub name: String,
    /// Elevation of every floor (m), bottom first.
    pub elevation: Vec<f64>,
    /// Whether the ground under it moves.
    pub on_moving_ground: bool,
    /// Whether forces act on its floors.
    pub pushed: bool,
    /// Floor displacement relative to the ground (m).
    pub displacement: Table,
    /// Peak displacement (m).
    pub displacement_peaks: StoreyPeaks,
    /// Peak drift ratio (-).
    pub drift_peaks: StoreyPeaks,
    /// Peak storey shear (N).
    pub shear_peaks: StoreyPeaks,
    /// Peak absolute acceleration (m/s2).
    pub acceleration_peaks: StoreyPeaks,
    /// Peak overturning moment at the base, of a building with a stiffness matrix.
    pub base_moment: Option<BaseMoment>,
    /// Responses with names of their own.
    pub responses: Vec<NamedResponse>,
    /// The isolators that it stands on.
    pub isolator: Option<IsolatorResult>,
    /// Ductility of every storey (-), where any has a law; NaN where there is no yield force.
    pub ductility: Option<Vec<f64>>,
    /// Frames that follow laws, one entry a frame and storey.
    pub frames: Vec<FrameResult>,
    /// Natural periods (s).
    pub period: Vec<f64>,
    /// Modal damping ratios (-).
    pub damping_ratio: Vec<f64>,
}

/// One impact.
#[derive(Debug, Clone, Copy, PartialEq, H5Type)]
#[repr(C)]
pub struct ImpactResult {
    /// Level from 1, bottom first.
    pub level: u64,
    /// Time of closure (s).
    pub t_close: f64,
    /// Time of separation (s).
    pub t_open: f64,
    /// Approach velocity (m/s).
    pub approach_velocity: f64,
    /// Separation velocity (m/s).
    pub separation_velocity: f64,
    /// Achieved restitution (-).
    pub achieved_restitution: f64,
    /// Peak force (N); NaN for velocity jumps.
    pub peak_force: f64,
    /// Its time (s).
    pub peak_force_time: f64,
    /// Peak penetration (m).
    pub peak_penetration: f64,
    /// Impulse (N s).
    pub impulse: f64,
    /// Dissipated energy (J).
    pub energy_dissipated: f64,
    /// Constants of the model.
    pub constants: [f64; 4],
}

impl ImpactResult {
    /// Peak force (N); NaN for a jump of the velocity, which has none.
    #[must_use]
    pub fn force(&self) -> f64 {
        match self.peak_force > 0.0 {
            true => self.peak_force,
            false => f64::NAN,
        }
    }
}

/// A level of a gap or a link.
#[derive(Debug, Clone, PartialEq)]
pub struct LevelResult {
    /// Storeys of the left and the right building, such as `3-3`.
    pub label: String,
    /// Elevations of the left and the right floor (m); NaN for a wall.
    pub elevations: [f64; 2],
}

/// One gap.
#[derive(Debug, Clone, PartialEq)]
pub struct GapResult {
    /// Name.
    pub name: String,
    /// What stands on both sides, `left | right`.
    pub between: String,
    /// Impact model; empty without levels.
    pub model: String,
    /// Rule of separation.
    pub separation: String,
    /// Its levels, bottom first.
    pub levels: Vec<LevelResult>,
    /// Width at rest (m).
    pub width: Vec<f64>,
    /// Clearance left at every level (m), beside a building on isolators; NaN at levels that
    /// are not beside it.
    pub clearance: Option<Vec<f64>>,
    /// Penetration (m), negative while the gap is open.
    pub penetration: Table,
    /// Contact force (N), positive pushes apart.
    pub force: Table,
    /// Impacts in order of closure.
    pub impacts: Vec<ImpactResult>,
    /// What its levels bear beside contact forces.
    pub responses: Vec<LevelResponses>,
}

impl GapResult {
    /// Whether velocities jump at impacts: some that are over had no force.
    #[must_use]
    pub fn jumps(&self) -> bool {
        let mut over = self.impacts.iter().filter(|i| i.t_open.is_finite());
        over.any(|i| i.force().is_nan())
    }

    /// The hardest impacts first: by force, or by impulse where velocities jump, since the
    /// only forces there are those that hold floors together.
    #[must_use]
    pub fn hardest_first(&self) -> Vec<&ImpactResult> {
        let jumps = self.jumps();
        let size = |i: &ImpactResult| {
            let size = if jumps { i.impulse } else { i.force() };
            if size.is_finite() { size } else { 0.0 }
        };
        let mut impacts: Vec<&ImpactResult> = self.impacts.iter().collect();
        impacts.sort_by(|a, b| size(b).total_cmp(&size(a)));
        impacts
    }

    /// The governing level: that with the hardest impact, or without impacts that which comes closest.
    #[must_use]
    pub fn governing_level(&self) -> Option<usize> {
        let hardest = self.hardest_first().first().map(|i| i.level as usize - 1);
        let closest = || {
            let nearest = |l: &usize| {
                self.penetration
                    .column(*l)
                    .fold(f64::NEG_INFINITY, f64::max)
            };
            (0..self.levels.len()).max_by(|a, b| nearest(a).total_cmp(&nearest(b)))
        };
        hardest.or_else(closest)
    }
}

/// One link.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkResult {
    /// Name.
    pub name: String,
    /// Law.
    pub law: String,
    /// Its levels, bottom first.
    pub levels: Vec<LevelResult>,
    /// SI units of deformation and force.
    pub units: [String; 2],
    /// Peak deformation.
    pub deformation: Vec<f64>,
    /// When it comes (s).
    pub deformation_time: Vec<f64>,
    /// Peak force, or moment between rotations.
    pub force: Vec<f64>,
    /// When it comes (s).
    pub force_time: Vec<f64>,
    /// Deformation over time, a column for each level.
    pub deformations: Table,
    /// The same of the force, positive in tension.
    pub forces: Table,
    /// Energy dissipated by the end (J).
    pub energy_dissipated: Vec<f64>,
}

/// Part of a peak that an output beside it has to have to tell its direction.
const MOST_OF_PEAK: f64 = 0.7;

impl LinkResult {
    /// Whether it joins rotations of foundations, so that moments take the place of forces.
    #[must_use]
    pub fn turns(&self) -> bool {
        self.units[0] == "rad"
    }

    /// The level with the greatest force.
    #[must_use]
    pub fn governing_level(&self) -> Option<usize> {
        let levels = 0..self.force.len();
        levels.max_by(|a, b| self.force[*a].total_cmp(&self.force[*b]))
    }

    /// Whether the greatest force of a level is one in tension: as the output times beside it tell, where one of them has
    /// most of that force and the other one is not of the opposite sign. `None` where they do not tell, and without a force.
    #[must_use]
    pub fn in_tension(&self, times: &[f64], level: usize) -> Option<bool> {
        let (peak, at) = (*self.force.get(level)?, *self.force_time.get(level)?);
        let last = times.len().checked_sub(1)?;
        let after = times.partition_point(|t| *t < at).min(last);
        let near = |row: usize| {
            let values = &self.forces.values;
            values.get(row * self.forces.columns + level).copied()
        };
        let [before, after] = [near(after.saturating_sub(1))?, near(after)?];
        let greater = if before.abs() > after.abs() {
            before
        } else {
            after
        };
        let tells = peak > 0.0 && greater.abs() >= MOST_OF_PEAK * peak && before * after >= 0.0;
        tells.then_some(greater > 0.0)
    }
}

/// Energies over time (J).
#[derive(Debug, Clone, PartialEq)]
pub struct EnergyHistory {
    /// Work of the ground motion.
    pub input: Vec<f64>,
    /// Kinetic energy.
    pub kinetic: Vec<f64>,
    /// Recoverable energy.
    pub strain: Vec<f64>,
    /// Dissipated by damping.
    pub viscous: Vec<f64>,
    /// Dissipated by storeys with laws and by links.
    pub hysteretic: Vec<f64>,
    /// Dissipated in contacts.
    pub impact: Vec<f64>,
}

/// All that a page shows of a result file.
#[derive(Debug, Clone, PartialEq)]
pub struct RunResult {
    /// Title of the case.
    pub title: String,
    /// Program version that ran it.
    pub version: String,
    /// Text of the case.
    pub case: String,
    /// Hash of the text.
    pub case_sha256: String,
    /// Hash of the record.
    pub record_sha256: String,
    /// What was read and done to the record, line by line.
    pub record: String,
    /// Method of integration.
    pub method: String,
    /// Warnings of the run, and one if the file has no checksum.
    pub warnings: Vec<String>,
    /// What the checksum of the file says.
    pub checksum: Checksum,
    /// Steps taken.
    pub steps: u64,
    /// Time that the run took (s).
    pub wall_time: f64,
    /// Largest residual of the energy over the largest input energy (-).
    pub residual_ratio: f64,
    /// Output times (s).
    pub time: Vec<f64>,
    /// Ground acceleration (m/s2).
    pub ground_acceleration: Vec<f64>,
    /// Buildings by name.
    pub buildings: Vec<BuildingResult>,
    /// Gaps by name.
    pub gaps: Vec<GapResult>,
    /// Links by name.
    pub links: Vec<LinkResult>,
    /// Energies.
    pub energy: EnergyHistory,
}
