//! Buildings on isolators.
use pounding_shear_building::{
    Damping, DampingMatrix, Isolator, IsolatorError, IsolatorKind, PostYield, ShearBuilding,
    ShearBuildingError, Strength,
};

const MASS: [f64; 4] = [3.0e5, 2.0e5, 2.0e5, 1.5e5];
const STIFFNESS: [f64; 3] = [4.0e8, 3.5e8, 3.0e8];
const HEIGHT: [f64; 4] = [0.5, 3.0, 3.0, 3.0];

fn rubber(post_yield: PostYield, strength: Option<Strength>, stiffness_ratio: f64) -> Isolator {
    Isolator {
        kind: IsolatorKind::LeadRubber {
            post_yield,
            strength,
            stiffness_ratio,
        },
        dashpot: 1.0e5,
    }
}

fn lead_rubber() -> Isolator {
    rubber(PostYield::Period(2.5), Some(Strength::OfWeight(0.05)), 10.0)
}

fn on(isolator: Isolator, damping: Damping) -> Result<ShearBuilding, ShearBuildingError> {
    let (mass, height) = (MASS.to_vec(), HEIGHT.to_vec());
    ShearBuilding::on_isolators("b".into(), mass, &STIFFNESS, height, damping, isolator)
}

fn kinds() -> [Damping; 6] {
    [
        Damping::Modal {
            ratios: vec![0.02, 0.03, 0.05],
        },
        Damping::RayleighRatio {
            ratio: 0.05,
            modes: [1, 3],
        },
        Damping::Rayleigh {
            alpha: 0.3,
            beta: 1.0e-3,
        },
        Damping::MassProportional { ratio: 0.04 },
        Damping::StiffnessProportional { ratio: 0.03 },
        Damping::Dashpots {
            coefficients: vec![1.2e6, 1.0e6, 8.0e5],
        },
    ]
}

/// On floors relative to the slab the matrix is that of the building above it on a fixed
/// base, and a motion of all floors together meets the dashpot of the isolators alone.
#[test]
fn superstructure_damping_does_not_brake_the_isolators() {
    for damping in kinds() {
        let building = on(lead_rubber(), damping.clone()).unwrap();
        assert!(building.damping().couples_modes());
        let fixed = ShearBuilding::new(
            "fixed".into(),
            MASS[1..].to_vec(),
            STIFFNESS.to_vec(),
            HEIGHT[1..].to_vec(),
            damping.clone(),
        );
        let fixed = fixed.unwrap();
        let (c, above) = (building.damping_matrix(), fixed.damping_matrix());
        let largest = c.entry(1, 1);
        for i in 0..3 {
            for j in 0..3 {
                let off = (c.entry(i + 1, j + 1) - above.entry(i, j)).abs();
                assert!(off < 1e-12 * largest, "{damping:?}");
            }
        }
        let mut force = vec![0.0; 4];
        building.apply_damping(&[1.0; 4], &mut force);
        assert!((force[0] - 1.0e5).abs() < 1e-9 * largest, "{force:?}");
        assert!(force[1..].iter().all(|f| f.abs() < 1e-9 * largest));
        for i in 0..4 {
            for j in 0..i {
                assert_eq!(c.entry(i, j), c.entry(j, i), "{damping:?}");
            }
        }
        let chain = matches!(
            damping,
            Damping::Dashpots { .. } | Damping::StiffnessProportional { .. }
        );
        assert_eq!(matches!(c, DampingMatrix::Tridiagonal(_)), chain);
    }
}

/// A slab of no account on isolators as hard as rock leaves the ratios asked for.
#[test]
fn ratios_are_those_above_a_fixed_slab() {
    let mut rock = rubber(PostYield::Stiffness(1.0e14), None, 1.0);
    rock.dashpot = 0.0;
    let asked = [0.02, 0.03, 0.05];
    let damping = Damping::Modal {
        ratios: asked.to_vec(),
    };
    let ratios = on(rock, damping).unwrap().modes().damping_ratio.clone();
    for (ratio, asked) in ratios.iter().zip(asked) {
        assert!((ratio - asked).abs() < 1e-5, "{ratios:?}");
    }
}

/// 850 t weigh 8.3357 MN: k2 = m (2 pi / 2.5)^2 = 5.3692 MN/m, Q = 0.05 W = 416.78 kN,
/// Fy = Q / 0.9 = 463.09 kN, yield at Q / (9 k2) = 8.6251 mm. At 0.2 m the secant is
/// k2 + Q / 0.2 = 7.4531 MN/m: 2.1219 s, and 2 Q (0.2 - y) / (pi k 0.04) = 17.03 %.
#[test]
fn lead_rubber_by_hand() {
    let building = on(lead_rubber(), Damping::MassProportional { ratio: 0.0 }).unwrap();
    let (_, properties) = building.isolator().unwrap();
    let close = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 2e-5, "{found} {expected}");
    };
    close(properties.weight, 8.335_65e6);
    close(properties.post_yield_stiffness, 5.369_15e6);
    close(properties.initial_stiffness, 5.369_15e7);
    close(properties.strength, 416_783.0);
    close(properties.yield_displacement, 8.625_1e-3);
    close(properties.post_yield_period(), 2.5);
    let (period, damping) = properties.effective(0.2);
    close(period, 2.121_9);
    close(damping, 0.170_327);
    let law = building.laws()[0].as_ref().unwrap();
    assert_eq!(law.law.descriptor().name, "bilinear");
    close(law.yield_drift.unwrap(), 8.625_1e-3);
    close(building.stiffness()[0], 5.369_15e7);
    // The same said otherwise.
    let force = properties.strength / 0.9;
    let stiffness = PostYield::Stiffness(properties.post_yield_stiffness);
    let other = rubber(stiffness, Some(Strength::YieldForce(force)), 10.0);
    let other = other.properties(8.5e5).unwrap();
    close(other.strength, properties.strength);
    close(other.yield_displacement, properties.yield_displacement);
}

/// 850 t on a dish of 2 m: 2.8373 s, as a pendulum of that length has.
#[test]
fn friction_pendulum_by_hand() {
    let isolator = Isolator {
        kind: IsolatorKind::FrictionPendulum {
            radius: 2.0,
            friction_fast: 0.08,
            friction_slow: 0.04,
            rate: 30.0,
            yield_displacement: 0.001,
        },
        dashpot: 0.0,
    };
    let building = on(isolator, Damping::MassProportional { ratio: 0.0 }).unwrap();
    let (_, properties) = building.isolator().unwrap();
    assert!((properties.post_yield_period() - 2.837_5).abs() < 1e-4);
    assert!((properties.strength - 0.08 * properties.weight).abs() < 1e-6);
    let law = building.laws()[0].as_ref().unwrap();
    assert_eq!(law.law.descriptor().name, "friction_pendulum");
    assert_eq!(law.law.descriptor().link_alone, None);
    assert_eq!(law.yield_drift, Some(0.001));
    assert_eq!(law.law.initial_stiffness(), building.stiffness()[0]);
}

#[test]
fn isolators_that_cannot_be_are_refused() {
    let period = PostYield::Period(2.5);
    let refused = |isolator: Isolator| match on(isolator, Damping::MassProportional { ratio: 0.0 })
    {
        Err(ShearBuildingError::Isolator { source, .. }) => source,
        other => panic!("{other:?}"),
    };
    let share = |share| Some(Strength::OfWeight(share));
    for wrong in [-2.0, 0.0, f64::INFINITY, f64::NAN, 1.0e-200] {
        let error = refused(rubber(PostYield::Period(wrong), share(0.05), 10.0));
        let said = error.to_string();
        assert!(said.contains("post_yield_period = "), "{wrong}: {said}");
        assert!(error.help().is_some());
    }
    let error = refused(rubber(PostYield::Stiffness(-1.0), share(0.05), 10.0));
    assert!(error.to_string().contains("post_yield_stiffness = -1"));
    for wrong in [0.0, 1.0, -0.1, f64::NAN] {
        let error = refused(rubber(period, share(wrong), 10.0));
        assert!(matches!(error, IsolatorError::Strength { .. }));
        assert!(error.help().is_some());
    }
    let heavy = Some(Strength::YieldForce(1.0e7));
    let error = refused(rubber(period, heavy, 10.0)).to_string();
    assert!(error.contains("below 1"), "{error}");
    let error = refused(rubber(period, share(0.05), 1.0));
    assert_eq!(error, IsolatorError::PlainWithStrength);
    let error = refused(rubber(period, None, 10.0));
    assert_eq!(error, IsolatorError::NoStrength);
    let error = refused(rubber(period, None, 0.5));
    assert_eq!(error, IsolatorError::Ratio { ratio: 0.5 });
    // The storeys above are counted without the isolator.
    let dashpots = Damping::Dashpots {
        coefficients: vec![1.0e6; 4],
    };
    let error = on(lead_rubber(), dashpots).unwrap_err().to_string();
    assert!(error.contains("4 dashpots for 3 storeys"), "{error}");
}
