//! What the pages show of a model: example collisions and restitution tables.

use pounding_gap_element::{
    Bodies, CollisionOptions, CollisionOutcome, GapElementError, ModelDescriptor, RestitutionTable,
    SeparationRule, collide, registry, restitution_table,
};

/// The bodies of all examples as arguments of `pounding impact`.
pub const BODIES_AS_ARGUMENTS: &str =
    "--mass-left \"25 t\" --mass-right \"40 t\" --velocity \"0.8 m/s\"";
/// The same in words.
pub const BODIES_IN_WORDS: &str = "A floor of 25 t meets one of 40 t at rest with 0.8 m/s";
/// The restitution of the examples of use: customary for concrete.
pub const RESTITUTION: f64 = 0.65;

/// The restitutions whose collisions are shown.
const SHOWN: [f64; 3] = [0.4, RESTITUTION, 0.9];
const BODIES: Bodies = Bodies {
    mass_left: 25.0e3,
    mass_right: Some(40.0e3),
    velocity_left: 0.8,
    velocity_right: 0.0,
};

/// One example collision.
pub struct Shown {
    /// The restitution asked for, where the model takes one.
    pub restitution: Option<f64>,
    /// What came of it.
    pub outcome: CollisionOutcome,
}

/// Everything that is computed for a page.
pub struct Example {
    /// The model's descriptor.
    pub descriptor: &'static ModelDescriptor,
    /// Example collisions with the model's own separation rule.
    pub shown: Vec<Shown>,
    /// Requested against achieved restitution under every separation rule, the
    /// model's own first; empty where no restitution can be asked for.
    pub tables: Vec<(SeparationRule, RestitutionTable)>,
    /// Whether the model is a jump of velocities, without force and penetration.
    pub rigid: bool,
}

/// Lets the bodies of the example collide.
pub fn compute(descriptor: &'static ModelDescriptor) -> Result<Example, GapElementError> {
    let asked: &[f64] = if descriptor.takes_restitution() {
        &SHOWN
    } else {
        &[f64::NAN]
    };
    let mut rigid = false;
    let mut shown = Vec::new();
    for &restitution in asked {
        let parameters = descriptor.example_parameters(restitution);
        let model = registry::build(descriptor.name, &parameters)?;
        rigid = model.rigid_restitution().is_some();
        shown.push(Shown {
            restitution: descriptor.takes_restitution().then_some(restitution),
            outcome: collide(model.as_ref(), &BODIES)?,
        });
    }
    Ok(Example {
        descriptor,
        shown,
        tables: tables(descriptor)?,
        rigid,
    })
}

fn tables(
    descriptor: &'static ModelDescriptor,
) -> Result<Vec<(SeparationRule, RestitutionTable)>, GapElementError> {
    if !descriptor.takes_restitution() {
        return Ok(Vec::new());
    }
    descriptor
        .separation_rules
        .iter()
        .map(|&rule| {
            let parameters = descriptor
                .example_parameters(RESTITUTION)
                .with_separation(rule);
            let options = CollisionOptions::default();
            let table = restitution_table(descriptor, &parameters, &BODIES, &options)?;
            Ok((rule, table))
        })
        .collect()
}
