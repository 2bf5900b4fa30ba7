//! What the pages show of a model: example collisions and restitution tables.

use pounding_gap_element::laboratory::{EXAMPLE_BODIES, EXAMPLE_RESTITUTION};
use pounding_gap_element::{
    CollisionOptions, CollisionOutcome, GapElementError, ModelDescriptor, RestitutionTable,
    SeparationRule, collide, registry, restitution_table,
};

use crate::figure::Panel;
use crate::loops::panel;

/// The bodies of all examples as arguments of `pounding impact`.
pub const BODIES_AS_ARGUMENTS: &str =
    "--mass-left \"25 t\" --mass-right \"40 t\" --velocity \"0.8 m/s\"";
/// The same in words.
pub const BODIES_IN_WORDS: &str = "A floor of 25 t meets one of 40 t at rest with 0.8 m/s";
/// The restitutions whose collisions are shown.
const SHOWN: [f64; 3] = [0.4, EXAMPLE_RESTITUTION, 0.9];

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
}

impl Example {
    /// Whether the model is a jump of velocities, without force and penetration.
    pub fn is_rigid(&self) -> bool {
        self.shown.iter().any(|s| s.outcome.is_rigid())
    }

    /// Force over penetration of the collisions; none for a jump of velocities.
    pub fn panel(&self) -> Option<Panel> {
        if self.is_rigid() {
            return None;
        }
        let curves = self.shown.iter().map(|shown| {
            let name = shown.restitution;
            let name = name.map_or_else(|| "example".to_owned(), |e| format!("e = {e}"));
            (name, shown.loop_points())
        });
        let caption = format!("{}: contact force (kN)", self.descriptor.name);
        Some(panel(caption, "penetration (mm)", curves.collect()))
    }
}

impl Shown {
    /// Penetration (m) and force (N), from nothing at closure and to nothing at the end, so that
    /// jumps show as lines.
    fn loop_points(&self) -> Vec<(f64, f64)> {
        let history = &self.outcome.history;
        // Contact ends at zero but for round-off, whose sign would show on the axis.
        let depth = |penetration: f64| penetration.max(0.0);
        let end = history.last().map_or(0.0, |s| depth(s.penetration));
        std::iter::once((0.0, 0.0))
            .chain(history.iter().map(|s| (depth(s.penetration), s.force)))
            .chain([(end, 0.0)])
            .collect()
    }
}

/// Lets the bodies of the example collide.
pub fn compute(descriptor: &'static ModelDescriptor) -> Result<Example, GapElementError> {
    let asked: &[f64] = if descriptor.takes_restitution() {
        &SHOWN
    } else {
        &[f64::NAN]
    };
    let mut shown = Vec::new();
    for &restitution in asked {
        let parameters = descriptor.example_parameters(restitution);
        let model = registry::build(descriptor.name, &parameters)?;
        shown.push(Shown {
            restitution: descriptor.takes_restitution().then_some(restitution),
            outcome: collide(model.as_ref(), &EXAMPLE_BODIES)?,
        });
    }
    Ok(Example {
        descriptor,
        shown,
        tables: tables(descriptor)?,
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
                .example_parameters(EXAMPLE_RESTITUTION)
                .with_separation(rule);
            let options = CollisionOptions::default();
            let table = restitution_table(descriptor, &parameters, &EXAMPLE_BODIES, &options)?;
            Ok((rule, table))
        })
        .collect()
}
