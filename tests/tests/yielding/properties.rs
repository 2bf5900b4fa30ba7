//! What holds for any pair that yields: mirror images, far neighbours, the ledger, and
//! rigid impacts, whose jumps of velocity turn elements on the spot.

use std::sync::Arc;

use pounding_gap_element::{ImpactModel, ModelParameters, registry};
use pounding_hysteresis::LawParameters;
use pounding_time_history::{Floor, GroundAcceleration, LinkedPair, Outcome, System};
use proptest::prelude::*;

use super::setup::{ADAPTIVE, EVENT_DRIVEN, TIGHT, building, difference, el_centro, go, law};

const DURATION: f64 = 5.0;
const LAWS: [&str; 5] = [
    "elastic_perfectly_plastic",
    "bouc_wen",
    "modified_clough",
    "takeda",
    "menegotto_pinto_1973",
];

/// A pair: laws by number, yield forces as shares of the weight, and the width of the gap.
#[derive(Debug, Clone, Copy)]
struct Pair {
    laws: [usize; 2],
    strength: [f64; 2],
    period: [f64; 2],
    width: f64,
    rigid: bool,
    linked: bool,
}

fn pairs() -> impl Strategy<Value = Pair> {
    (
        [0..LAWS.len(), 0..LAWS.len()],
        [0.1..0.5_f64, 0.1..0.5_f64],
        [0.3..1.0_f64, 0.3..1.0_f64],
        0.002..0.03_f64,
        any::<bool>(),
        any::<bool>(),
    )
        .prop_map(|(laws, strength, period, width, rigid, linked)| Pair {
            laws,
            strength,
            period,
            width,
            rigid,
            linked,
        })
}

impl Pair {
    fn model(&self) -> Arc<dyn ImpactModel> {
        let (name, stiffness) = if self.rigid {
            ("stereomechanical", None)
        } else {
            ("kelvin_voigt", Some(("stiffness", 2.0e7)))
        };
        let mut parameters = vec![("restitution", 0.6)];
        parameters.extend(stiffness);
        registry::build(name, &ModelParameters::from_pairs(&parameters))
            .unwrap()
            .into()
    }

    fn side(&self, side: usize) -> pounding_shear_building::ShearBuilding {
        const MASS: f64 = 2.0e4;
        let stiffness = 2.0 * MASS * (std::f64::consts::TAU / self.period[side]).powi(2);
        let name = LAWS[self.laws[side]];
        let descriptor = pounding_hysteresis::find(name).unwrap();
        let parameters = descriptor
            .example_parameters()
            .with("stiffness", stiffness)
            .with("yield_force", self.strength[side] * 2.0 * MASS * 9.81);
        let called = ["a", "b"][side];
        building(called, (2, MASS, stiffness), Some(law(name, &parameters)))
    }

    /// The pair, or its mirror image under the reversed motion.
    fn system(&self, mirrored: bool, width: f64, ground: &GroundAcceleration) -> System {
        let mut buildings = vec![Arc::new(self.side(0)), Arc::new(self.side(1))];
        let mut ground = ground.clone();
        if mirrored {
            buildings.reverse();
            ground.samples = Arc::new(ground.samples.iter().map(|a| -a).collect());
        }
        let mut system = System::new(buildings, ground);
        let pairs = (0..2)
            .map(|s| {
                let (left, right) = (Floor::Storey(0, s), Floor::Storey(1, s));
                (left, right, width, self.model())
            })
            .collect();
        let names = || ["left".to_owned(), "right".to_owned()];
        system.add_gap("gap", names(), pairs).unwrap();
        if self.linked {
            let parameters =
                LawParameters::from_pairs(&[("stiffness", 1.0e6), ("yield_force", 5.0e3)]);
            let joint = law("elastic_perfectly_plastic", &parameters);
            let pair = LinkedPair {
                left: Floor::Storey(0, 1),
                right: Floor::Storey(1, 1),
                law: joint.law,
                yield_deformation: joint.yield_drift,
            };
            system.add_link("joint", names(), vec![pair]).unwrap();
        }
        system
    }
}

fn impacts(outcome: &Outcome) -> usize {
    outcome.impacts.len()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Seen in a mirror, a pair does the same; the ledger closes; shears stay within what
    /// an elastic-plastic storey can carry.
    #[test]
    fn mirror_image_and_ledger(pair in pairs()) {
        let ground = el_centro();
        let here = go(&pair.system(false, pair.width, &ground), ADAPTIVE, DURATION);
        let mut there = go(&pair.system(true, pair.width, &ground), ADAPTIVE, DURATION);
        there.buildings.reverse();
        prop_assert!(here.energy.residual_ratio < 1.0e-9, "{:?}", here.energy);
        prop_assert_eq!(impacts(&here), impacts(&there));
        let worst = difference(&here, &there);
        prop_assert!(worst < 1.0e-7, "{worst}");
        for side in 0..2 {
            if LAWS[pair.laws[side]] == "elastic_perfectly_plastic" {
                let yield_force = pair.strength[side] * 2.0 * 2.0e4 * 9.81;
                for storey in &here.buildings[side].storeys {
                    prop_assert!(storey.storey_shear.value <= yield_force * (1.0 + 1.0e-9));
                }
            }
            for storey in here.buildings[side].yielding.iter().flatten() {
                prop_assert!(storey.hysteretic_energy > -1.0e-6 * here.energy.largest_input);
            }
        }
    }

    /// Series from event to event and the explicit pair have nothing in common but the laws.
    #[test]
    fn event_driven_agrees_with_the_pair(pair in pairs()) {
        let straight = pair.laws.map(|law| [0, 2, 2, 3, 3][law]);
        let system = Pair { laws: straight, ..pair }.system(false, pair.width, &el_centro());
        let exact = go(&system, EVENT_DRIVEN, DURATION);
        let stepped = go(&system, TIGHT, DURATION);
        prop_assert!(exact.method.title.contains("exact between events"));
        prop_assert!(exact.energy.residual_ratio < 1.0e-10, "{:?}", exact.energy);
        prop_assert_eq!(impacts(&exact), impacts(&stepped));
        let worst = difference(&exact, &stepped);
        prop_assert!(worst < 1.0e-7, "{worst}");
    }

    /// Neighbours that are far apart and not linked know nothing of each other.
    #[test]
    fn huge_gap_is_two_isolated_runs(pair in pairs()) {
        let pair = Pair { linked: false, ..pair };
        let ground = el_centro();
        let system = pair.system(false, 10.0, &ground);
        let together = go(&system, ADAPTIVE, DURATION);
        let alone = go(&system.isolated(), ADAPTIVE, DURATION);
        prop_assert_eq!(impacts(&together), 0);
        prop_assert!(difference(&together, &alone) < 1.0e-12);
        for side in 0..2 {
            let one = System::new(vec![Arc::new(pair.side(side))], ground.clone());
            let one = go(&one, ADAPTIVE, DURATION);
            let mut of_two = together.clone();
            of_two.buildings = vec![together.buildings[side].clone()];
            prop_assert!(difference(&of_two, &one) < 1.0e-7);
        }
    }
}

/// Floors in lasting contact beside a link: it stands still but for round-off, and must
/// not change its branch for that.
#[test]
fn lasting_contact_beside_a_link() {
    let pair = Pair {
        laws: [2, 0],
        strength: [0.387_116_717_619_984_8, 0.251_592_795_566_577_54],
        period: [0.350_875_787_648_502_1, 0.984_595_888_443_596_7],
        width: 0.023_571_025_044_995,
        rigid: true,
        linked: true,
    };
    let outcome = go(
        &pair.system(false, pair.width, &el_centro()),
        ADAPTIVE,
        DURATION,
    );
    assert!(outcome.gaps[0].levels.iter().any(|l| l.sticks > 0));
    assert!(outcome.energy.residual_ratio < 1.0e-9);
}

/// A Menegotto-Pinto storey that reaches, at one sample, the deformation at which an
/// estimate of the error of its work vanished by chance.
#[test]
fn work_of_a_curved_law_is_exact_everywhere() {
    let pair = Pair {
        laws: [4, 2],
        strength: [0.202_161_913_003_082_83, 0.438_357_667_443_555_5],
        period: [0.520_761_075_056_433_2, 0.309_405_609_919_355_56],
        width: 0.018_890_778_974_695_557,
        rigid: false,
        linked: true,
    };
    let outcome = go(
        &pair.system(false, pair.width, &el_centro()),
        ADAPTIVE,
        DURATION,
    );
    let ratio = outcome.energy.residual_ratio;
    assert!(ratio < 1.0e-9, "{:?}", outcome.energy);
}
