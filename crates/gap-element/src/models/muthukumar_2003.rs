//! Bilinear impact element: the loss is the area of a parallelogram.

use pounding_catalogue::Descriptor;

use crate::classes::hunt_crossley;
use crate::descriptor::{
    AchievedRestitution, Alias, ModelDescriptor, ParameterDescriptor, ParameterUnit, Verification,
    constant,
};
use crate::error::GapElementError;
use crate::model::{
    APPROACH_VELOCITY_FLOOR, ClosedForm, Collision, Direction, Force, Guard, ImpactModel, Memory,
    Phase, SeparationRule, Target, Transition,
};
use crate::parameters::{
    EXPONENT, ModelParameters, POWER_STIFFNESS, RESTITUTION, optional_positive,
};

pub(crate) static DESCRIPTOR: ModelDescriptor = ModelDescriptor {
    name: "muthukumar_2003",
    aliases: &[Alias {
        name: "bilinear_impact",
        citation: "common name; material ImpactMaterial of OpenSees",
    }],
    title: "Bilinear impact element",
    formula: "K = k delta_m^(n-1),  W = k delta_m^(n+1) (1 - e^2) / (n + 1);  K1 = K + W / (a delta_m^2) up to a delta_m,  then K2 = K - W / ((1 - a) delta_m^2);  unloading along K1 down to F = K2 delta",
    citation: "Muthukumar, PhD thesis, Georgia Institute of Technology (2003); OpenSees ImpactMaterial",
    class: "bilinear, hysteretic",
    parameters: &[
        POWER_STIFFNESS,
        RESTITUTION_ASKED,
        YIELD_RATIO,
        DESIGN_PENETRATION,
        EXPONENT,
    ],
    constants: &[
        constant("initial_stiffness", ParameterUnit::NewtonPerMetre),
        constant("hardening_stiffness", ParameterUnit::NewtonPerMetre),
        constant("yield_penetration", ParameterUnit::Metre),
        constant("design_penetration", ParameterUnit::Metre),
    ],
    separation_rules: &[SeparationRule::ZeroPenetration],
    needs_effective_mass: true,
    achieved_restitution: AchievedRestitution::Varies,
    verification: Verification::Verified(
        "the thesis' example in kip and inch, and e = sqrt((1 - c) / (1 + c)), c = (1 - e^2) / (n + 1), at the design penetration",
    ),
    traps: &[
        "The energy to load it is not that of the Hertz spring: at the design penetration it returns 0.7338 for 0.5, 0.7696 for 0.6, 0.7904 for 0.65.",
        "Without design_penetration it is found from approach velocity and effective mass of each collision: the one that a free collision reaches. The restitution is then the same at every speed from 1 mm/s on.",
        "With a design_penetration of the user's own, the restitution depends on the penetration reached.",
        "Evaluated from the penetration itself. ImpactMaterial of OpenSees adds increments to its last state, so that travel outside the gap in the step that closes it counts, by design: peaks of pairs are 2 % apart at steps of 1 ms, 2e-4 at 10 us (pounding verify structures).",
    ],
    build,
    ..hunt_crossley::DESCRIPTOR
};

const RESTITUTION_ASKED: ParameterDescriptor = ParameterDescriptor {
    required: true,
    ..RESTITUTION
};
const YIELD_RATIO: ParameterDescriptor = ParameterDescriptor {
    default: Some(0.1),
    maximum: (1.0, false),
    ..optional_positive(
        "yield_ratio",
        ParameterUnit::One,
        "Yield penetration over design penetration, a",
    )
};
const DESIGN_PENETRATION: ParameterDescriptor = optional_positive(
    "design_penetration",
    ParameterUnit::Metre,
    "Maximum penetration delta_m that the element is made for; by default the one that the collision reaches",
);

/// Loading line `F = K2 delta + (K1 - K2) delta_y`.
const UPPER: Phase = Phase::Branch(0);
/// Unloading line `F = K2 delta`.
const LOWER: Phase = Phase::Branch(1);

/// On the elastic line, in either direction: distance to the upper line and from
/// the lower one.
const ELASTIC: [Transition; 2] = [
    Transition {
        guard: Guard::Model(0),
        direction: Direction::Rising,
        target: Target::Phase(UPPER),
    },
    Transition {
        guard: Guard::Model(1),
        direction: Direction::Falling,
        target: Target::Phase(LOWER),
    },
];
const LOADING: [Transition; 1] = [Transition {
    guard: Guard::Velocity,
    direction: Direction::Falling,
    target: Target::Phase(Phase::Approach),
}];
const UNLOADING: [Transition; 1] = [Transition {
    guard: Guard::Velocity,
    direction: Direction::Rising,
    target: Target::Phase(Phase::Approach),
}];

#[derive(Debug)]
struct BilinearImpact {
    stiffness: f64,
    exponent: f64,
    /// `(1 - e^2) / (n + 1)`.
    loss: f64,
    yield_ratio: f64,
    design_penetration: Option<f64>,
}

fn build(parameters: &ModelParameters) -> Result<Box<dyn ImpactModel>, GapElementError> {
    let exponent = parameters.exponent(&DESCRIPTOR);
    let e = parameters.get(&DESCRIPTOR, "restitution")?;
    let loss = (1.0 - e * e) / (exponent + 1.0);
    let yield_ratio = parameters.get(&DESCRIPTOR, "yield_ratio")?;
    if loss >= 1.0 - yield_ratio {
        let range = format!(
            "(0, {}), beyond which the second stiffness is negative",
            1.0 - loss
        );
        return Err(DESCRIPTOR
            .out_of_range(&YIELD_RATIO, yield_ratio, range)
            .into());
    }
    Ok(Box::new(BilinearImpact {
        stiffness: parameters.get(&DESCRIPTOR, "stiffness")?,
        exponent,
        loss,
        yield_ratio,
        design_penetration: parameters.given("design_penetration"),
    }))
}

impl BilinearImpact {
    /// The penetration at which the loading work `k d^(n+1) (1 + c) / 2` is the
    /// kinetic energy: the element is then as deep as it was made for.
    fn reached(&self, velocity: f64, mass: f64) -> f64 {
        libm::pow(
            mass * velocity * velocity / (self.stiffness * (1.0 + self.loss)),
            1.0 / (self.exponent + 1.0),
        )
    }

    /// `(K1 - K2) delta_y`.
    fn offset(collision: &Collision) -> f64 {
        let [k1, k2, yielding, _] = collision.constants;
        (k1 - k2) * yielding
    }
}

impl ImpactModel for BilinearImpact {
    fn descriptor(&self) -> &'static ModelDescriptor {
        &DESCRIPTOR
    }
    fn separation(&self) -> SeparationRule {
        SeparationRule::ZeroPenetration
    }
    fn begin(&self, approach_velocity: f64, effective_mass: f64) -> Collision {
        let depth = self.design_penetration.unwrap_or_else(|| {
            self.reached(
                approach_velocity.max(APPROACH_VELOCITY_FLOOR),
                effective_mass,
            )
        });
        let k = self.stiffness * libm::pow(depth, self.exponent - 1.0);
        let (a, c) = (self.yield_ratio, self.loss);
        Collision {
            approach_velocity,
            effective_mass,
            constants: [
                k * (1.0 + c / a),
                k * (1.0 - c / (1.0 - a)),
                a * depth,
                depth,
            ],
        }
    }
    fn force(
        &self,
        collision: &Collision,
        memory: &Memory,
        phase: Phase,
        delta: f64,
        _velocity: f64,
    ) -> Force {
        let [k1, k2, ..] = collision.constants;
        let (value, slope) = match phase {
            Phase::Approach => (k1 * (delta - memory.plastic_penetration), k1),
            UPPER => (k2 * delta + Self::offset(collision), k2),
            LOWER => (k2 * delta, k2),
            _ => (0.0, 0.0),
        };
        Force {
            value,
            by_penetration: slope,
            by_velocity: 0.0,
        }
    }
    fn guard(
        &self,
        index: u8,
        collision: &Collision,
        memory: &Memory,
        delta: f64,
        _velocity: f64,
    ) -> f64 {
        let [k1, k2, ..] = collision.constants;
        let above_lower = k1 * (delta - memory.plastic_penetration) - k2 * delta;
        if index == 0 {
            above_lower - Self::offset(collision)
        } else {
            above_lower
        }
    }
    /// The elastic line goes through the point at which the present line is left.
    fn enter(
        &self,
        collision: &Collision,
        memory: &mut Memory,
        (from, to): (Phase, Phase),
        delta: f64,
    ) {
        if to == Phase::Approach {
            let force = self.force(collision, memory, from, delta, 0.0).value;
            memory.plastic_penetration = delta - force / collision.constants[0];
        }
    }
    fn is_affine(&self, _: &Collision, _: Phase) -> bool {
        true
    }
    fn stored_energy(
        &self,
        collision: &Collision,
        memory: &Memory,
        phase: Phase,
        delta: f64,
    ) -> f64 {
        // Unloading: along K1 down to the lower line, then along K2 to zero.
        let [k1, k2, ..] = collision.constants;
        let force = self.force(collision, memory, phase, delta, 0.0).value;
        // Without loss both are one line.
        let drop = if k1 > k2 {
            (force - k2 * delta) / (k1 - k2)
        } else {
            0.0
        };
        let corner = delta - drop;
        0.5 * (force + k2 * corner) * drop + 0.5 * k2 * corner * corner
    }
    fn transitions(&self, phase: Phase) -> &'static [Transition] {
        match phase {
            Phase::Approach => &ELASTIC,
            UPPER => &LOADING,
            LOWER => &UNLOADING,
            _ => &[],
        }
    }
    fn closed_form(&self, approach_velocity: f64, effective_mass: f64) -> Option<ClosedForm> {
        let found = self.design_penetration.is_none();
        (found && approach_velocity >= APPROACH_VELOCITY_FLOOR).then(|| {
            let depth = self.reached(approach_velocity, effective_mass);
            ClosedForm {
                restitution: ((1.0 - self.loss) / (1.0 + self.loss)).sqrt(),
                peak_penetration: Some(depth),
                peak_force: Some(self.stiffness * libm::pow(depth, self.exponent)),
                duration: None,
            }
        })
    }
    fn smooth_at_closure(&self) -> bool {
        true
    }
}
