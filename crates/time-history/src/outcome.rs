//! What a run returns.

use crate::methods::Information;
use crate::peak::{Peak, same};
use crate::system::LevelMotion;
use crate::warning::Warning;

/// Peaks of one storey. Found inside the steps, not on the output grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct StoreyPeaks {
    /// Floor displacement relative to the ground (m).
    pub displacement: Peak,
    /// Storey drift over storey height (-).
    pub drift_ratio: Peak,
    /// Storey shear (N): stiffness times drift, or the force of the storey's law; with a
    /// stiffness matrix the sum of the restoring forces of the floors above.
    pub storey_shear: Peak,
    /// Absolute floor acceleration (m/s2).
    pub acceleration_absolute: Peak,
}

/// Peaks of one building, storeys from the bottom.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct BuildingOutcome {
    /// Name in the case file.
    pub name: String,
    /// Storeys from the bottom.
    pub storeys: Vec<StoreyPeaks>,
    /// Overturning moment at the base (N m), from the restoring forces of the floors; `None`
    /// for a chain of storeys.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub base_moment: Option<Peak>,
    /// Responses with names of the building ([`pounding_shear_building::ShearBuilding::responses`]).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub responses: Vec<NamedPeak>,
    /// What storeys with a law went through, from the bottom; `None` for the others. Of a building that turns in
    /// plan what its frames with a law did, taken together as [`YieldingStorey`] says.
    pub yielding: Vec<Option<YieldingStorey>>,
    /// What frames with a law went through, of a building that turns in plan: in the order of
    /// [`pounding_shear_building::ShearBuilding::yielding_frames`].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub frames: Vec<FrameOutcome>,
    /// What the isolators under the building went through; `None` for one without.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub isolator: Option<IsolatorOutcome>,
}

/// What the isolators under a building went through, all of them together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct IsolatorOutcome {
    /// Name of their kind.
    pub model: &'static str,
    /// Maximum displacement of the base slab relative to the ground (m).
    pub displacement: Peak,
    /// Maximum force of their law (N), without that of a dashpot beside them.
    pub force: Peak,
    /// Period (s) of the secant stiffness at that displacement.
    pub effective_period: f64,
    /// Damping ratio (-) of a loop to that displacement, without the dashpot.
    pub effective_damping_ratio: f64,
}

/// Peak magnitude of a response with a name.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct NamedPeak {
    /// Name, such as `foundation_rotation`.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Peak magnitude.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub peak: Peak,
    /// What the member can bear, in the same unit, where that is known.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub capacity: Option<f64>,
}

impl NamedPeak {
    /// Peak over capacity (-), where that is known.
    #[must_use]
    pub fn demand_ratio(&self) -> Option<f64> {
        self.capacity.map(|capacity| self.peak.value / capacity)
    }
}

impl BuildingOutcome {
    /// Storeys (from the bottom, from zero) that left their elastic range, with their
    /// ductility (-). A storey whose law has a yield or friction force did where its
    /// drift passed that at first yield. One whose law has none did, with `None`, where
    /// the law dissipated energy; a law of the velocity, which dissipates without
    /// yielding, never did.
    #[must_use]
    pub fn inelastic_storeys(&self) -> Vec<(usize, Option<f64>)> {
        let storeys = self.storeys.iter().zip(&self.yielding).enumerate();
        storeys
            .filter_map(|(storey, (peaks, yielding))| {
                let yielding = yielding.as_ref()?;
                let ductility = yielding.ductility.map(|d| d.value);
                let inelastic = ductility.map_or_else(
                    || yielding.dissipates_without_velocity(peaks),
                    |ductility| ductility > 1.0,
                );
                inelastic.then_some((storey, ductility))
            })
            .collect()
    }
}

impl YieldingStorey {
    /// Several frames of one storey, as the storey tells of them.
    pub(crate) fn beside(self, other: &Self) -> Self {
        let of = |storey: &Self| storey.ductility.map_or(0.0, |d| d.value);
        let governs = if of(other) > of(&self) { other } else { &self };
        let residual = [self.residual_drift_ratio, other.residual_drift_ratio];
        let by_magnitude = |a: &f64, b: &f64| a.abs().total_cmp(&b.abs());
        Self {
            law: governs.law,
            ductility: governs.ductility,
            residual_drift_ratio: residual.into_iter().max_by(by_magnitude).unwrap_or(0.0),
            hysteretic_energy: self.hysteretic_energy + other.hysteretic_energy,
            strength_lost: None,
        }
    }

    /// Whether a law that does not depend on the velocity dissipated more than round-off
    /// makes of the work of the maximum shear.
    fn dissipates_without_velocity(&self, peaks: &StoreyPeaks) -> bool {
        const ROUND_OFF: f64 = 1.0e-9;
        let of_velocity = pounding_hysteresis::find(self.law).is_ok_and(|law| law.rate_dependent);
        let work = peaks.storey_shear.value * peaks.displacement.value;
        !of_velocity && self.hysteretic_energy > ROUND_OFF * work
    }
}

/// What a frame with a law went through in one storey of a building that turns in plan.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct FrameOutcome {
    /// Direction in which it resists motion: `along` the row of buildings, or `across` it.
    pub direction: &'static str,
    /// Distance from the mass centre (m).
    pub at: f64,
    /// Storey, from 1.
    pub storey: usize,
    /// Name of the law.
    pub law: &'static str,
    /// Maximum deformation between both floors (m).
    pub deformation: Peak,
    /// Maximum force (N).
    pub force: Peak,
    /// Maximum deformation over that at first yield (-), with its time; `None` for a law without a yield force.
    pub ductility: Option<Peak>,
    /// Deformation at the end of the run less what unloading by the initial stiffness gives back (m), signed.
    pub residual_deformation: f64,
    /// Energy dissipated by the law (J).
    pub hysteretic_energy: f64,
    /// When it lost all its strength (s), to bear no force for the rest of the run.
    pub strength_lost: Option<f64>,
}

/// What a storey with a law went through. Where frames of a building that turns in plan have laws: the law and the
/// ductility of the frame with the greatest one, the residual drift of that with the greatest one in magnitude, the
/// energy of all of them, and no loss of strength, which [`BuildingOutcome::frames`] tells of each.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct YieldingStorey {
    /// Name of the law.
    pub law: &'static str,
    /// Maximum drift over the drift at first yield (-), with its time; `None` for a law
    /// without a yield force.
    pub ductility: Option<Peak>,
    /// Drift at the end of the run less what unloading by the initial stiffness gives
    /// back, over the storey height (-), signed.
    pub residual_drift_ratio: f64,
    /// Energy dissipated by the law (J).
    pub hysteretic_energy: f64,
    /// When it lost all its strength (s), to bear no force for the rest of the run.
    pub strength_lost: Option<f64>,
}

/// What a level of a link went through.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LinkLevelOutcome {
    /// Maximum deformation (m).
    pub deformation: Peak,
    /// Maximum force (N).
    pub force: Peak,
    /// Maximum deformation over that at first yield or slip (-); `None` for a law
    /// without such a force.
    pub ductility: Option<Peak>,
    /// Deformation at the end of the run (m), signed.
    pub final_deformation: f64,
    /// Energy dissipated by the law (J).
    pub energy_dissipated: f64,
    /// When it lost all its strength (s), to bear no force for the rest of the run.
    pub strength_lost: Option<f64>,
}

/// What a link went through, levels from the bottom.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LinkOutcome {
    /// Name of the link.
    pub name: String,
    /// Name of its law.
    pub law: &'static str,
    /// Levels from the bottom.
    pub levels: Vec<LinkLevelOutcome>,
}

/// One impact: from a located closure to the located opening. What there is not (NaN) equals what there is not
/// in another.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Impact {
    /// Index in [`crate::System::gaps`].
    pub gap: usize,
    /// Level within the gap, from the bottom, from zero.
    pub level: usize,
    /// Closure (s). For the lasting contact that ends an infinite sequence of rigid
    /// impacts: the end of that sequence.
    pub time_closed: f64,
    /// Opening (s); NaN if the contact outlasts the run.
    pub time_opened: f64,
    /// Relative velocity at closure (m/s).
    pub approach_velocity: f64,
    /// Relative velocity at opening, positive apart (m/s); NaN if still closed.
    pub separation_velocity: f64,
    /// Separation over approach velocity (-). The storeys act during the contact,
    /// so it differs from the restitution of a free collision; NaN if still
    /// closed, or if the floors met at rest, no faster than 1e-9 m/s.
    pub achieved_restitution: f64,
    /// Maximum force (N) with its time; NaN for a velocity jump, which has none.
    pub peak_force: Peak,
    /// Maximum penetration (m) with its time; into a column without mass, from where it would
    /// stand unhit, so that its bow is a part of it.
    pub peak_penetration: Peak,
    /// Impulse of the contact force (N s).
    pub impulse: f64,
    /// Work done on the contact less what its spring still stores (J).
    pub energy_dissipated: f64,
    /// The model's constants of this collision, in the order of its descriptor.
    pub constants: Vec<f64>,
}

impl PartialEq for Impact {
    fn eq(&self, other: &Self) -> bool {
        // By name, so that a new field is not forgotten.
        let Self {
            gap,
            level,
            time_closed,
            time_opened,
            approach_velocity,
            separation_velocity,
            achieved_restitution,
            peak_force,
            peak_penetration,
            impulse,
            energy_dissipated,
            constants,
        } = self;
        (*gap, *level) == (other.gap, other.level)
            && *time_closed == other.time_closed
            && same(*time_opened, other.time_opened)
            && *approach_velocity == other.approach_velocity
            && same(*separation_velocity, other.separation_velocity)
            && same(*achieved_restitution, other.achieved_restitution)
            && *peak_force == other.peak_force
            && *peak_penetration == other.peak_penetration
            && *impulse == other.impulse
            && *energy_dissipated == other.energy_dissipated
            && *constants == other.constants
    }
}

/// What happened at one contact level.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct LevelOutcome {
    /// Number of impacts.
    pub impacts: usize,
    /// Time of the first contact (s).
    pub first_contact: Option<f64>,
    /// Maximum force (N); NaN where there were velocity jumps alone.
    pub peak_force: Peak,
    /// Maximum penetration (m), as in [`Impact`].
    pub peak_penetration: Peak,
    /// Maximum impulse of a single impact (N s).
    pub impulse_max: f64,
    /// Maximum relative velocity at closure (m/s).
    pub approach_velocity_max: f64,
    /// Energy dissipated in the contact (J).
    pub energy_dissipated: f64,
    /// Impulse over all impacts (N s).
    pub impulse: f64,
    /// Restitution over all impacts: `sqrt(sum v_out^2 / sum v_in^2)` (-), `None`
    /// without a finished impact, or if the floors met at rest in all of them. The square root of the part of the relative
    /// kinetic energy that the floors kept through contact.
    pub achieved_restitution: Option<f64>,
    /// Number of times that the floors stuck together; for a rigid law, of lasting
    /// contacts.
    pub sticks: usize,
    /// By how much plastic deformation widened the gap (m), where the separation
    /// rule has it.
    pub gap_widening: f64,
    /// Responses of the level ([`crate::System::add_level_response`]).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    pub responses: Vec<NamedPeak>,
    /// Clearance left (m) beside a building on isolators: the width of the gap less the
    /// maximum approach, zero where the gap closed. `None` beside others.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub clearance: Option<f64>,
}

/// What readers of accelerations have to know where velocities jumped at impacts.
pub const VELOCITY_JUMPS: &str =
    "Rigid impacts are jumps of the velocity: floor accelerations leave them out.";

/// The same where forces of contacts stand beside accelerations.
pub const VELOCITY_JUMPS_HAVE_NO_FORCE: &str = "Rigid impacts are jumps of the velocity: floor accelerations leave them out. They have no contact force.";

/// Responses of levels that are the shear of a hit column, below and above the hit.
pub const COLUMN_SHEARS: [&str; 2] = ["column_shear_below", "column_shear_above"];

impl LevelOutcome {
    /// The larger of the shears below and above the hit where columns are hit at this level.
    #[must_use]
    pub fn column_shear(&self) -> Option<&NamedPeak> {
        let shears = self.responses.iter();
        let shears = shears.filter(|r| COLUMN_SHEARS.contains(&r.name.as_str()));
        shears.reduce(|a, b| if b.peak.value > a.peak.value { b } else { a })
    }

    /// How far floors move apart beyond the width at rest, where the gap is a joint with a seat.
    #[must_use]
    pub fn joint_opening(&self) -> Option<&NamedPeak> {
        let mut responses = self.responses.iter();
        responses.find(|r| r.name == LevelMotion::Opening.name())
    }
}

/// What happened in one gap, levels from the bottom.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct GapOutcome {
    /// Name of the gap.
    pub name: String,
    /// Levels from the bottom.
    pub levels: Vec<LevelOutcome>,
}

/// The energy ledger at one time (J), relative to the ground.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Energy {
    /// Work of the ground motion on the buildings, `-sum m int v a_g dt`, and the
    /// energy that they had at time zero.
    pub input: f64,
    /// Kinetic energy relative to the ground.
    pub kinetic: f64,
    /// Recoverable energy in storeys, links and closed contacts, with that of gravity
    /// where P-Delta is on.
    pub strain: f64,
    /// Dissipated by viscous damping.
    pub viscous: f64,
    /// Dissipated by yielding storeys and links; zero for elastic buildings.
    pub hysteretic: f64,
    /// Dissipated in contacts.
    pub impact: f64,
    /// What is missing: kinetic + strain + viscous + hysteretic + impact - input.
    pub residual: f64,
}

/// A part of the energy ledger, as results name it.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct EnergyPart {
    /// Name, that of the field.
    pub name: &'static str,
    /// What it is, in a few words.
    pub description: &'static str,
    /// Its value (J).
    pub value: fn(&Energy) -> f64,
}

impl Energy {
    /// All parts of the ledger.
    pub const PARTS: [EnergyPart; 7] = [
        EnergyPart {
            name: "input",
            description: "work of the ground motion, relative formulation, and of forces",
            value: |e| e.input,
        },
        EnergyPart {
            name: "kinetic",
            description: "kinetic energy relative to the ground",
            value: |e| e.kinetic,
        },
        EnergyPart {
            name: "strain",
            description: "recoverable energy of storeys, links and contacts",
            value: |e| e.strain,
        },
        EnergyPart {
            name: "viscous",
            description: "dissipated by viscous damping",
            value: |e| e.viscous,
        },
        EnergyPart {
            name: "hysteretic",
            description: "dissipated by storeys with laws and by links",
            value: |e| e.hysteretic,
        },
        EnergyPart {
            name: "impact",
            description: "dissipated in contacts",
            value: |e| e.impact,
        },
        EnergyPart {
            name: "residual",
            description: "sum of the other parts less the input",
            value: |e| e.residual,
        },
    ];
}

/// The closed ledger of a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Ledger {
    /// At the end of the run.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub end: Energy,
    /// Largest input energy of the run, at its accepted steps (J).
    pub largest_input: f64,
    /// Largest absolute residual of the run over the largest input energy (-).
    pub residual_ratio: f64,
}

/// Work done by the method.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Rejected trial steps.
    pub rejected: u64,
    /// Located events.
    pub events: u64,
    /// Trial steps taken to locate them.
    pub location_steps: u64,
    /// Evaluations of the equations of motion by explicit methods.
    pub evaluations: u64,
    /// Newton iterations of implicit methods.
    pub newton_iterations: u64,
}

impl Outcome {
    /// The same with all peaks of storeys unknown (NaN): what stands in for the run without
    /// gaps where that one failed.
    #[must_use]
    pub fn with_unknown_peaks(&self) -> Self {
        let all: Vec<usize> = (0..self.buildings.len()).collect();
        let mut outcome = self.with_unknown_peaks_of(&all);
        let levels = outcome.gaps.iter_mut().flat_map(|g| &mut g.levels);
        for response in levels.flat_map(|l| &mut l.responses) {
            response.peak = UNKNOWN;
        }
        outcome
    }

    /// The same with the peaks of some buildings, by their numbers, unknown.
    pub(crate) fn with_unknown_peaks_of(&self, buildings: &[usize]) -> Self {
        let mut outcome = self.clone();
        for index in buildings {
            let building = &mut outcome.buildings[*index];
            building.storeys.fill(StoreyPeaks {
                displacement: UNKNOWN,
                drift_ratio: UNKNOWN,
                storey_shear: UNKNOWN,
                acceleration_absolute: UNKNOWN,
            });
            building.base_moment = building.base_moment.map(|_| UNKNOWN);
            building.isolator = building.isolator.map(|isolator| IsolatorOutcome {
                displacement: UNKNOWN,
                force: UNKNOWN,
                effective_period: f64::NAN,
                effective_damping_ratio: f64::NAN,
                ..isolator
            });
            for response in &mut building.responses {
                response.peak = UNKNOWN;
            }
        }
        outcome
    }
}

/// A peak that is not known.
const UNKNOWN: Peak = Peak {
    value: f64::NAN,
    time: f64::NAN,
};

/// Result of a run.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Outcome {
    /// The method used.
    pub method: Information,
    /// Time at the end (s).
    pub end_time: f64,
    /// Buildings from the left.
    pub buildings: Vec<BuildingOutcome>,
    /// Gaps in the order of the case.
    pub gaps: Vec<GapOutcome>,
    /// Links in the order of the case.
    pub links: Vec<LinkOutcome>,
    /// Impacts in order of closure.
    pub impacts: Vec<Impact>,
    /// Energy ledger.
    pub energy: Ledger,
    /// Floor displacements at the end (m), buildings from the left.
    pub final_displacement: Vec<f64>,
    /// Floor velocities at the end (m/s).
    pub final_velocity: Vec<f64>,
    /// Work counts.
    pub statistics: Statistics,
    /// Anything that the user should know.
    pub warnings: Vec<Warning>,
}
