//! Modes and damping against closed forms and definitions.
use pounding_shear_building::{
    Damping, DampingMatrix, ShearBuilding, ShearBuildingError, SymmetricTridiagonal,
    TridiagonalFactor,
};
use proptest::prelude::*;

fn uniform(n: usize, damping: Damping) -> ShearBuilding {
    ShearBuilding::new(
        "b".into(),
        vec![2.5e4; n],
        vec![3.46e6; n],
        vec![3.0; n],
        damping,
    )
    .unwrap()
}

/// Closed form of the uniform chain: `2 sqrt(k/m) sin((2j-1) pi / (2 (2n+1)))`.
#[test]
fn frequencies_of_uniform_buildings() {
    for n in [1, 3, 10, 40, 80, 100, 101, 250] {
        let b = uniform(n, Damping::StiffnessProportional { ratio: 0.05 });
        let modes = b.modes();
        for (j, w) in modes.circular_frequency.iter().enumerate() {
            let angle = (2 * j + 1) as f64 * std::f64::consts::PI / (2 * (2 * n + 1)) as f64;
            let exact = 2.0 * (3.46e6_f64 / 2.5e4).sqrt() * angle.sin();
            assert!((w / exact - 1.0).abs() < 1e-12, "{n} {j}: {w} {exact}");
        }
        let mass: f64 = modes.effective_mass.iter().sum();
        assert!((mass / (2.5e4 * n as f64) - 1.0).abs() < 1e-10);
        let identity = modes.shape.transpose() * 2.5e4 * &modes.shape;
        assert!((identity - nalgebra::DMatrix::identity(n, n)).amax() < 1e-10);
    }
}

#[test]
fn damping_ratios_are_those_asked_for() {
    let ratios = |d| uniform(5, d).modes().damping_ratio.clone();
    let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} {b}");
    close(
        ratios(Damping::StiffnessProportional { ratio: 0.05 })[0],
        0.05,
    );
    close(ratios(Damping::MassProportional { ratio: 0.05 })[0], 0.05);
    let rayleigh = ratios(Damping::RayleighRatio {
        ratio: 0.05,
        modes: [1, 3],
    });
    close(rayleigh[0], 0.05);
    close(rayleigh[2], 0.05);
    assert!(rayleigh[1] < 0.05 && rayleigh[4] > 0.05);
    let modal = vec![0.01, 0.02, 0.03, 0.04, 0.05];
    for (a, b) in ratios(Damping::Modal {
        ratios: modal.clone(),
    })
    .iter()
    .zip(&modal)
    {
        close(*a, *b);
    }
    let k = uniform(
        5,
        Damping::Dashpots {
            coefficients: vec![3.46e6 * 0.01; 5],
        },
    );
    let proportional = uniform(
        5,
        Damping::Rayleigh {
            alpha: 0.0,
            beta: 0.01,
        },
    );
    assert_eq!(k.damping_matrix(), proportional.damping_matrix());
}

#[test]
fn what_cannot_be_is_refused() {
    let new = |m: Vec<f64>, k: Vec<f64>, d| {
        ShearBuilding::new("b".into(), m, k, vec![3.0; 2], d).map(|_| ())
    };
    let sound = || Damping::MassProportional { ratio: 0.05 };
    assert!(matches!(
        new(vec![1.0, -1.0], vec![1.0; 2], sound()),
        Err(ShearBuildingError::Value { storey: 2, .. })
    ));
    assert!(matches!(
        new(vec![1.0; 2], vec![0.0, 1.0], sound()),
        Err(ShearBuildingError::Value { storey: 1, .. })
    ));
    assert!(matches!(
        new(vec![1.0; 2], vec![1.0; 3], sound()),
        Err(ShearBuildingError::Length { .. })
    ));
    assert!(matches!(
        new(vec![1.0, f64::NAN], vec![1.0; 2], sound()),
        Err(ShearBuildingError::Value { .. })
    ));
    // Sums that are no numbers: the weight on the lowest storey was `NaN N`.
    let heavy = new(vec![1e308; 2], vec![1.0; 2], sound()).unwrap_err();
    let text = heavy.to_string();
    assert!(text.contains("storey 1: mass = 1e308 must be"), "{text}");
    assert!(matches!(
        new(vec![1.0; 2], vec![0.7e300; 2], sound()),
        Err(ShearBuildingError::Value { storey: 2, .. })
    ));
    for d in [
        Damping::RayleighRatio {
            ratio: 0.05,
            modes: [1, 1],
        },
        Damping::RayleighRatio {
            ratio: 0.05,
            modes: [1, 3],
        },
        Damping::StiffnessProportional { ratio: 5.0 },
        Damping::Modal {
            ratios: vec![0.05; 3],
        },
        Damping::Dashpots {
            coefficients: vec![-1.0, 1.0],
        },
    ] {
        assert!(matches!(
            new(vec![1.0; 2], vec![1.0; 2], d),
            Err(ShearBuildingError::Damping { .. })
        ));
    }
}

proptest! {
    #[test]
    fn the_factor_solves(storeys in prop::collection::vec(1e5..1e9_f64, 1..20), seed in prop::collection::vec(-1.0..1.0_f64, 20)) {
        let a = SymmetricTridiagonal::chain(&storeys);
        let mut factor = TridiagonalFactor::new(storeys.len());
        factor.factor(&a.diagonal, &a.off_diagonal).unwrap();
        let b = &seed[..storeys.len()];
        let mut x = b.to_vec();
        factor.solve_in_place(&mut x);
        let mut product = vec![0.0; b.len()];
        a.multiply(&x, &mut product);
        for (p, b) in product.iter().zip(b) {
            prop_assert!((p - b).abs() < 1e-8);
        }
    }

    #[test]
    fn damping_takes_energy_and_is_odd(v in prop::collection::vec(-1.0..1.0_f64, 4), ratio in 0.001..0.5_f64) {
        for d in [
            Damping::StiffnessProportional { ratio },
            Damping::RayleighRatio { ratio, modes: [1, 2] },
            Damping::Modal { ratios: vec![ratio] },
            Damping::Dashpots { coefficients: vec![ratio * 1e5; 4] },
        ] {
            let b = uniform(4, d);
            let mut force = vec![0.0; 4];
            b.apply_damping(&v, &mut force);
            let power: f64 = v.iter().zip(&force).map(|(a, b)| a * b).sum();
            prop_assert!(power >= 0.0);
            let negative: Vec<f64> = v.iter().map(|x| -x).collect();
            let mut mirrored = vec![0.0; 4];
            b.apply_damping(&negative, &mut mirrored);
            prop_assert!(force.iter().zip(&mirrored).all(|(a, b)| *a == -b));
            prop_assert!(matches!(b.damping_matrix(), DampingMatrix::Dense(_) | DampingMatrix::Tridiagonal(_)));
        }
    }
}

/// Values too far apart for double precision are an error, never a zero frequency.
#[test]
fn unresolvable_modes_are_refused_or_right() {
    for (m, k) in [
        ([1e-100, 1.0], [1e200, 1e200]),
        ([1e200, 1e200], [1e-100, 1e-100]),
        ([1e3, 1e3], [1.0, 1e18]),
    ] {
        let b = ShearBuilding::new(
            "b".into(),
            m.to_vec(),
            k.to_vec(),
            vec![3.0; 2],
            Damping::MassProportional { ratio: 0.05 },
        );
        match b {
            Err(error) => assert!(matches!(error, ShearBuildingError::Modes { .. }), "{error}"),
            Ok(b) => assert!(b.modes().damping_ratio.iter().all(|z| z.is_finite())),
        }
    }
}

#[test]
fn modal_damping_is_exactly_symmetric() {
    for n in [12_usize, 109] {
        let values = |base: f64| {
            (0..n)
                .map(|i| base * (1.0 + 0.37 * (i * i % 7) as f64))
                .collect::<Vec<_>>()
        };
        let ratios: Vec<f64> = (0..n).map(|j| 0.02 + 0.001 * (j % 40) as f64).collect();
        let b = ShearBuilding::new(
            "b".into(),
            values(2e5),
            values(3e8),
            vec![3.0; n],
            Damping::Modal {
                ratios: ratios.clone(),
            },
        )
        .unwrap();
        let DampingMatrix::Dense(c) = b.damping_matrix() else {
            panic!("modal damping is dense");
        };
        assert_eq!(*c, c.transpose());
        // The definition: the shapes make it diagonal, with twice the ratio times the
        // frequency of each mode.
        let modes = b.modes();
        let generalised = modes.shape.transpose() * c * &modes.shape;
        for i in 0..n {
            assert!((modes.damping_ratio[i] - ratios[i]).abs() < 1e-12);
            for j in 0..n {
                let asked = if i == j {
                    2.0 * ratios[i] * modes.circular_frequency[i]
                } else {
                    0.0
                };
                let found = generalised[(i, j)];
                assert!((found - asked).abs() < 1e-9, "{n} {i} {j}: {found} {asked}");
            }
        }
    }
}

#[test]
fn a_building_of_too_many_storeys_is_refused_before_its_matrices_are_made() {
    let n = 100_000;
    let refused = ShearBuilding::new(
        "tower".into(),
        vec![4.5e4; n],
        vec![5.482e6; n],
        vec![4.0; n],
        Damping::Modal { ratios: vec![0.05] },
    );
    let text = refused.unwrap_err().to_string();
    assert!(text.contains("100000 storeys"), "{text}");
    assert!(text.contains(&pounding_shear_building::MAXIMUM_STOREYS.to_string()));
}
