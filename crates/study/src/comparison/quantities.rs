//! What models are compared by.

use pounding_time_history::{
    BuildingOutcome, Element, LinkLevelOutcome, LinkedMotion, Outcome, Peak, StoreyPeaks, System,
};

use crate::gap_check::{Amplification, closes};
use crate::runs::{Axis, COLUMN_SHEAR, OPENING, RESPONSES, Response};

/// Kind of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum QuantityKind {
    /// Maximum floor displacement of a building (m).
    Displacement,
    /// Maximum drift ratio of a building (-), that of isolators apart.
    DriftRatio,
    /// Maximum storey shear of a building (N).
    StoreyShear,
    /// Maximum absolute floor acceleration of a building (m/s2); not of rigid impacts.
    AccelerationAbsolute,
    /// Maximum ductility of the storeys of a building with a yield force (-), isolators apart.
    Ductility,
    /// Maximum magnitude of the residual drift ratio of the storeys of a building with laws (-), isolators apart.
    ResidualDriftRatio,
    /// Maximum overturning moment at the base of a building with a stiffness matrix or a foundation
    /// (N m).
    BaseMoment,
    /// Maximum of a response of a building with a name, such as the rotation of its foundation.
    Response(&'static Response),
    /// Impacts in a gap (-).
    Impacts,
    /// Maximum contact force of a gap (N); not of rigid impacts.
    PeakForce,
    /// Maximum shear of columns that are hit across a gap (N).
    ColumnShear,
    /// Maximum opening of a joint with a seat, beyond its width at rest (m).
    Opening,
    /// Maximum force of a link between floors or displacements of foundations (N).
    LinkForce,
    /// Maximum deformation of such a link (m).
    LinkDeformation,
    /// Maximum impulse of one impact in a gap (N s).
    Impulse,
    /// Maximum approach velocity in a gap (m/s).
    ApproachVelocity,
    /// Energy dissipated in a gap (J).
    ImpactEnergy,
    /// Restitution over all impacts in a gap (-).
    AchievedRestitution,
}

impl QuantityKind {
    const OF_BUILDINGS: [Self; 4] = [
        Self::Displacement,
        Self::DriftRatio,
        Self::StoreyShear,
        Self::AccelerationAbsolute,
    ];
    const OF_GAPS: [Self; 6] = [
        Self::Impacts,
        Self::PeakForce,
        Self::Impulse,
        Self::ApproachVelocity,
        Self::ImpactEnergy,
        Self::AchievedRestitution,
    ];

    /// Name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::DriftRatio => "drift_ratio",
            Self::StoreyShear => "storey_shear",
            Self::AccelerationAbsolute => "acceleration_absolute",
            Self::Ductility => "ductility",
            Self::ResidualDriftRatio => "residual_drift_ratio",
            Self::BaseMoment => "base_moment",
            Self::Response(response) => response.name,
            Self::Impacts => "impacts",
            Self::PeakForce => "peak_force",
            Self::ColumnShear => "column_shear",
            Self::Opening => "opening",
            Self::LinkForce => "link_force",
            Self::LinkDeformation => "link_deformation",
            Self::Impulse => "impulse",
            Self::ApproachVelocity => "approach_velocity",
            Self::ImpactEnergy => "impact_energy",
            Self::AchievedRestitution => "achieved_restitution",
        }
    }

    /// SI unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement | Self::Opening | Self::LinkDeformation => "m",
            Self::StoreyShear | Self::PeakForce | Self::ColumnShear | Self::LinkForce => "N",
            Self::AccelerationAbsolute => "m/s2",
            Self::BaseMoment => "N m",
            Self::Response(response) => match response.peak.unit {
                "1" => "-",
                "m s-2" => "m/s2",
                unit => unit,
            },
            Self::Impulse => "N s",
            Self::ApproachVelocity => "m/s",
            Self::ImpactEnergy => "J",
            Self::DriftRatio
            | Self::Ductility
            | Self::ResidualDriftRatio
            | Self::Impacts
            | Self::AchievedRestitution => "-",
        }
    }

    /// How one value comes from storeys, or from levels and impacts.
    fn statistic(self) -> &'static str {
        match self {
            Self::Displacement
            | Self::DriftRatio
            | Self::StoreyShear
            | Self::AccelerationAbsolute
            | Self::Ductility
            | Self::ResidualDriftRatio => "maximum over storeys",
            Self::BaseMoment => "at the base",
            Self::Response(response) if response.peak.axis == Axis::Storey => {
                "maximum over storeys"
            }
            Self::Response(_) => "of the building",
            Self::Impacts | Self::ImpactEnergy => "sum over levels",
            Self::PeakForce
            | Self::ColumnShear
            | Self::Opening
            | Self::LinkForce
            | Self::LinkDeformation => "maximum over levels",
            Self::Impulse | Self::ApproachVelocity => "maximum over levels and impacts",
            Self::AchievedRestitution => "over all levels and impacts",
        }
    }

    /// Whether it belongs to a contact: it has no value, not even zero, where the gap does
    /// not close.
    #[must_use]
    pub fn needs_contact(self) -> bool {
        matches!(
            self,
            Self::PeakForce | Self::Impulse | Self::ApproachVelocity | Self::AchievedRestitution
        )
    }

    /// The same among the amplifications of a storey; `None` for what has none.
    pub(super) fn amplification(self) -> Option<fn(&Amplification) -> f64> {
        match self {
            Self::Displacement => Some(|a| a.displacement),
            Self::StoreyShear => Some(|a| a.storey_shear),
            Self::AccelerationAbsolute => Some(|a| a.acceleration_absolute),
            _ => None,
        }
    }

    /// The peak of this kind among those of a storey; `None` for what no storey has.
    #[must_use]
    pub fn peak(self, storey: &StoreyPeaks) -> Option<Peak> {
        match self {
            Self::Displacement => Some(storey.displacement),
            Self::DriftRatio => Some(storey.drift_ratio),
            Self::StoreyShear => Some(storey.storey_shear),
            Self::AccelerationAbsolute => Some(storey.acceleration_absolute),
            _ => None,
        }
    }
}

/// A quantity of a building, a gap or a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// Kind.
    pub kind: QuantityKind,
    /// Name of the building, gap or link.
    pub of: String,
    /// Its number, from zero.
    pub index: usize,
    /// Whether it is of a building on isolators.
    pub on_isolators: bool,
}

impl Quantity {
    /// How one value comes from storeys, or from levels and impacts.
    #[must_use]
    pub fn statistic(&self) -> &'static str {
        use QuantityKind::{DriftRatio, Ductility, ResidualDriftRatio};
        match self.kind {
            DriftRatio | Ductility | ResidualDriftRatio if self.on_isolators => {
                "maximum over storeys above isolators"
            }
            kind => kind.statistic(),
        }
    }

    /// Whether it belongs to a building, and has a value without pounding.
    #[must_use]
    pub fn is_of_building(&self) -> bool {
        QuantityKind::OF_BUILDINGS.contains(&self.kind)
            || matches!(
                self.kind,
                QuantityKind::Ductility
                    | QuantityKind::ResidualDriftRatio
                    | QuantityKind::BaseMoment
                    | QuantityKind::Response(_)
            )
    }

    /// Whether it belongs to a link.
    #[must_use]
    pub fn is_of_link(&self) -> bool {
        matches!(
            self.kind,
            QuantityKind::LinkForce | QuantityKind::LinkDeformation
        )
    }

    /// Name and owner.
    #[must_use]
    pub fn label(&self) -> String {
        format!("{} {}", self.of, self.kind.name())
    }
}

/// All quantities of a system: of its buildings, then of its gaps, then of its links.
pub(super) fn of_system(system: &System) -> Vec<Quantity> {
    let quantity = |kind, of: &str, index| Quantity {
        kind,
        of: of.to_owned(),
        index,
        on_isolators: false,
    };
    let mut all = Vec::new();
    for (index, b) in system.buildings().iter().enumerate() {
        all.extend(QuantityKind::OF_BUILDINGS.map(|kind| quantity(kind, b.name(), index)));
        for (kind, has) in laws_of(system, index) {
            if has {
                all.push(quantity(kind, b.name(), index));
            }
        }
        if b.stiffness().is_empty() {
            all.push(quantity(QuantityKind::BaseMoment, b.name(), index));
        }
        let has = |r: &&Response| b.responses().iter().any(|row| r.is(&row.name));
        let responses = RESPONSES.iter().filter(has);
        all.extend(responses.map(|r| quantity(QuantityKind::Response(r), b.name(), index)));
    }
    for own in &mut all {
        own.on_isolators = system.buildings()[own.index].isolator().is_some();
    }
    for (index, g) in system.gaps().iter().enumerate() {
        all.extend(QuantityKind::OF_GAPS.map(|kind| quantity(kind, &g.name, index)));
        let levels = g.first_level..g.first_level + g.levels;
        let own: Vec<&str> = system
            .level_responses()
            .filter(|(level, _)| levels.contains(level))
            .map(|(_, response)| response.name.as_str())
            .collect();
        for (of_levels, kind) in [
            (COLUMN_SHEAR, QuantityKind::ColumnShear),
            (OPENING, QuantityKind::Opening),
        ] {
            if own.iter().any(|name| (of_levels.is)(name)) {
                all.push(quantity(kind, &g.name, index));
            }
        }
    }
    for (index, link) in system.links().iter().enumerate() {
        // Rotations are joined by moments.
        if link.joins != LinkedMotion::FoundationRotation {
            let kinds = [QuantityKind::LinkForce, QuantityKind::LinkDeformation];
            all.extend(kinds.map(|kind| quantity(kind, &link.name, index)));
        }
    }
    all
}

/// Which quantities of laws the storeys of a building have, isolators apart.
fn laws_of(system: &System, index: usize) -> [(QuantityKind, bool); 2] {
    let first = usize::from(system.buildings()[index].isolator().is_some());
    let own = |element: &&Element| {
        let place = system.storey_of_element(element.place);
        place.is_some_and(|(building, storey)| building == index && storey >= first)
    };
    let elements = || system.elements().iter().filter(own);
    let yields = elements().any(|element| element.yield_deformation.is_some());
    [
        (QuantityKind::Ductility, yields),
        (
            QuantityKind::ResidualDriftRatio,
            elements().next().is_some(),
        ),
    ]
}

/// Maximum over the storeys of a building, or that of its base or its foundation. The drifts of isolators count apart.
pub(super) fn of_building(kind: QuantityKind, building: &BuildingOutcome) -> f64 {
    let first = usize::from(building.isolator.is_some());
    match kind {
        QuantityKind::Ductility => {
            let laws = building.yielding.iter().skip(first).flatten();
            let all = laws.filter_map(|law| law.ductility);
            return all.map(|d| d.value).reduce(f64::max).unwrap_or(f64::NAN);
        }
        QuantityKind::ResidualDriftRatio => {
            let laws = building.yielding.iter().skip(first).flatten();
            return laws
                .map(|law| law.residual_drift_ratio.abs())
                .fold(0.0, f64::max);
        }
        QuantityKind::DriftRatio => {
            let above = building.storeys.iter().skip(first);
            return above.map(|s| s.drift_ratio.value).fold(0.0, f64::max);
        }
        _ => {}
    }
    if kind == QuantityKind::BaseMoment {
        return building.base_moment.map_or(f64::NAN, |m| m.value);
    }
    if let QuantityKind::Response(response) = kind {
        return response.of(building).unwrap_or(f64::NAN);
    }
    let peaks = building.storeys.iter().filter_map(|s| kind.peak(s));
    peaks.map(|p| p.value).fold(0.0, f64::max)
}

/// Part of the energy that the ground puts in below which what impacts dissipate is round-off.
const ROUND_OFF: f64 = 1.0e-12;

/// Whether some impact of a rigid law was a jump of the velocity, which has neither a force
/// nor an acceleration.
pub(super) fn jumps(outcome: &Outcome, rigid: bool) -> bool {
    rigid && outcome.impacts.iter().any(|i| i.peak_force.value.is_nan())
}

/// Value in an outcome with or without such jumps; NaN where it has no meaning.
pub(super) fn value(quantity: &Quantity, outcome: &Outcome, jumps: bool) -> f64 {
    if quantity.is_of_building() {
        if jumps && quantity.kind == QuantityKind::AccelerationAbsolute {
            return f64::NAN;
        }
        return of_building(quantity.kind, &outcome.buildings[quantity.index]);
    }
    let of_link = |peak: fn(&LinkLevelOutcome) -> f64| {
        let levels = &outcome.links[quantity.index].levels;
        levels.iter().map(peak).fold(0.0, f64::max)
    };
    match quantity.kind {
        QuantityKind::LinkForce => return of_link(|l| l.force.value),
        QuantityKind::LinkDeformation => return of_link(|l| l.deformation.value),
        _ => {}
    }
    let gap = &outcome.gaps[quantity.index];
    if quantity.kind.needs_contact() && !closes(gap) {
        return f64::NAN;
    }
    let levels = &gap.levels;
    let maximum = |of: fn(&pounding_time_history::LevelOutcome) -> f64| {
        levels.iter().map(of).fold(0.0, f64::max)
    };
    match quantity.kind {
        QuantityKind::Impacts => levels.iter().map(|l| l.impacts).sum::<usize>() as f64,
        QuantityKind::PeakForce if jumps => f64::NAN,
        QuantityKind::PeakForce => maximum(|l| l.peak_force.value),
        QuantityKind::ColumnShear => {
            maximum(|l| l.column_shear().map_or(0.0, |shear| shear.peak.value))
        }
        QuantityKind::Opening => {
            maximum(|l| l.joint_opening().map_or(0.0, |opening| opening.peak.value))
        }
        QuantityKind::Impulse => maximum(|l| l.impulse_max),
        QuantityKind::ApproachVelocity => maximum(|l| l.approach_velocity_max),
        QuantityKind::ImpactEnergy => {
            let lost: f64 = levels.iter().map(|l| l.energy_dissipated).sum();
            let most = outcome.energy.end.input.abs();
            // What round-off leaves of the zero of an elastic law is none, of either sign.
            if lost.abs() > ROUND_OFF * most {
                lost
            } else {
                0.0
            }
        }
        _ => restitution(outcome, quantity.index),
    }
}

/// `sqrt(sum v_out^2 / sum v_in^2)` over the finished impacts of a gap; none where the floors met at rest in all of them.
fn restitution(outcome: &Outcome, gap: usize) -> f64 {
    let finished = outcome
        .impacts
        .iter()
        .filter(|i| i.gap == gap && i.separation_velocity.is_finite());
    let (mut before, mut after, mut met) = (0.0, 0.0, false);
    for impact in finished {
        before += impact.approach_velocity.powi(2);
        after += impact.separation_velocity.powi(2);
        met |= impact.achieved_restitution.is_finite();
    }
    match met {
        true => (after / before).sqrt(),
        false => f64::NAN,
    }
}
