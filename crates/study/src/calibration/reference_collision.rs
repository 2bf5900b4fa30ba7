//! The collision that models are calibrated in, and the gap's own law in it.

use pounding_gap_element::{
    Bodies, CollisionOutcome, GapElementError, ImpactModel, ModelParameters, SeparationRule,
    collide, registry,
};

/// The law that a gap has in the case.
#[derive(Debug, Clone, PartialEq)]
pub struct OwnLaw {
    /// Name of its model, whatever alias the case has.
    pub model: &'static str,
    /// All its parameters (SI).
    pub parameters: ModelParameters,
    /// Whether models are asked for its restitution, so that it is compared as it is in the case.
    pub gives_restitution: bool,
}

/// The free collision of two floors that models are calibrated in.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceCollision {
    /// Approach velocity (m/s).
    pub approach_velocity: f64,
    /// Whether that is the maximum of the other gaps, as the gap's own law meets none in it.
    pub of_other_gaps: bool,
    /// Effective mass (kg).
    pub effective_mass: f64,
    /// Stiffness of the gap's own law (N/m^n).
    pub stiffness: f64,
    /// Exponent of the gap's own law (-).
    pub exponent: f64,
    /// Restitution that all models are asked for (-).
    pub restitution: f64,
    /// When contacts end, where the case says so of the gap: for all models that offer it.
    pub separation: Option<SeparationRule>,
    /// The gap's own law.
    pub own: Option<OwnLaw>,
}

/// The free collision, integrated.
pub(super) fn collision(
    model: &dyn ImpactModel,
    reference: &ReferenceCollision,
) -> Result<CollisionOutcome, GapElementError> {
    // A body against a wall has its own mass as effective mass.
    let bodies = Bodies {
        mass_left: reference.effective_mass,
        mass_right: None,
        velocity_left: reference.approach_velocity,
        velocity_right: 0.0,
    };
    collide(model, &bodies)
}

/// The collision of the gap's own law without damping, where that is no power of the penetration
/// alone: with a branch for what is crushed.
pub(super) fn crushed(
    reference: &ReferenceCollision,
) -> Result<Option<CollisionOutcome>, GapElementError> {
    let own = reference.own.as_ref();
    let Some(own) = own.filter(|own| own.parameters.given(CRUSHED[0]).is_some()) else {
        return Ok(None);
    };
    let mut parameters = own.parameters.clone();
    parameters.values.remove("restitution");
    let undamped = ("damping_factor".to_owned(), 0.0);
    parameters.values.extend([undamped]);
    let model = registry::build(own.model, &parameters)?;
    collision(model.as_ref(), reference).map(Some)
}

/// Parameters of an example that belong to its stiffness, and make no sense beside another.
pub(super) const CRUSHED: [&str; 2] = ["crush_penetration", "crush_stiffness"];
