//! The classes that carry most published laws, each with its closed forms.

pub(crate) mod dry_friction;
pub(crate) mod dry_friction_table;
pub(crate) mod hunt_crossley;
pub(crate) mod linear;

use pounding_catalogue::{DefinitionError, Descriptor};

use crate::descriptor::ModelDescriptor;
use crate::error::GapElementError;
use crate::model::{Direction, Guard, ImpactModel, Phase, Target, Transition};
use crate::parameters::ModelParameters;

/// In which phases a law damps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum DampingPhases {
    /// In approach and restitution.
    Both,
    /// In approach only.
    ApproachOnly,
}

/// Stands in the shared descriptors of the classes, where no model is built.
pub(crate) fn unbuilt(_: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    Err(GapElementError::Definition(DefinitionError::UnknownName {
        kind: ModelDescriptor::KIND,
        name: "a class without a model".to_owned(),
        nearest: "exact_hunt_crossley",
        known: Vec::new(),
    }))
}

/// Approach-only damping: it goes off at the turning point and on again if the
/// floors approach once more within the same contact.
pub(crate) fn approach_only(phase: Phase) -> &'static [Transition] {
    const APPROACH: [Transition; 1] = [Transition {
        guard: Guard::Velocity,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Restitution),
    }];
    const RESTITUTION: [Transition; 1] = [Transition {
        guard: Guard::Velocity,
        direction: Direction::Rising,
        target: Target::Phase(Phase::Approach),
    }];
    match phase {
        Phase::Approach => &APPROACH,
        Phase::Restitution => &RESTITUTION,
        _ => &[],
    }
}

/// `max(0, F)` without memory: off at zero force, on again as soon as the law
/// would push.
pub(crate) fn no_tension(phase: Phase) -> &'static [Transition] {
    const APPROACH: [Transition; 1] = [Transition {
        guard: Guard::RawForce,
        direction: Direction::Falling,
        target: Target::Phase(Phase::Released),
    }];
    const RELEASED: [Transition; 1] = [Transition {
        guard: Guard::RawForce,
        direction: Direction::Rising,
        target: Target::Phase(Phase::Approach),
    }];
    match phase {
        Phase::Approach => &APPROACH,
        Phase::Released => &RELEASED,
        _ => &[],
    }
}

/// Off at zero force, on again when the floors approach once more.
pub(crate) fn no_tension_latched(phase: Phase) -> &'static [Transition] {
    const RELEASED: [Transition; 1] = [Transition {
        guard: Guard::Velocity,
        direction: Direction::Rising,
        target: Target::Phase(Phase::Approach),
    }];
    match phase {
        Phase::Released => &RELEASED,
        other => no_tension(other),
    }
}

/// Over at zero force.
pub(crate) fn gap_shift(phase: Phase) -> &'static [Transition] {
    const APPROACH: [Transition; 1] = [Transition {
        guard: Guard::RawForce,
        direction: Direction::Falling,
        target: Target::Open,
    }];
    match phase {
        Phase::Approach => &APPROACH,
        _ => &[],
    }
}

/// Root of an increasing function by bisection of its positive argument in the
/// logarithm, down to neighbouring doubles. Runs once when a model is built.
pub(crate) fn solve_increasing(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..400 {
        let middle = if high > 2.0 * low {
            (low * high).sqrt()
        } else {
            0.5 * (low + high)
        };
        if middle <= low || middle >= high {
            break;
        }
        if f(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// `I_n` of the elastic power law: half the contact time is `I_n delta_max / v0`.
/// `I_n = integral_0^1 dx / sqrt(1 - x^(n+1))`, a Beta function; evaluated with
/// `x = 1 - s^2`, which removes the singularity, by Gauss-Legendre panels.
pub(crate) fn elastic_time_factor(exponent: f64) -> f64 {
    // 10-point Gauss-Legendre on [-1, 1] (Abramowitz and Stegun 1964, table 25.4).
    const NODES: [(f64, f64); 5] = [
        (0.148_874_338_981_631_21, 0.295_524_224_714_752_87),
        (0.433_395_394_129_247_2, 0.269_266_719_309_996_35),
        (0.679_409_568_299_024_4, 0.219_086_362_515_982_04),
        (0.865_063_366_688_984_5, 0.149_451_349_150_580_6),
        (0.973_906_528_517_171_7, 0.066_671_344_308_688_14),
    ];
    const PANELS: usize = 16;
    let power = exponent + 1.0;
    let integrand = |s: f64| {
        let gap = -libm::expm1(power * libm::log1p(-s * s));
        2.0 * s / gap.sqrt()
    };
    let half = 0.5 / PANELS as f64;
    (0..PANELS)
        .map(|panel| {
            let middle = (panel as f64 + 0.5) / PANELS as f64;
            NODES
                .iter()
                .map(|(x, w)| {
                    w * half * (integrand(middle - half * x) + integrand(middle + half * x))
                })
                .sum::<f64>()
        })
        .sum()
}
