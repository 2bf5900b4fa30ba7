//! Parameters of an Iwan density from dissipation curves.
use pounding_hysteresis::HysteresisError;
use pounding_hysteresis::LawParameters;
use pounding_hysteresis::iwan::{
    Fall, FitDoubt, FitOptions, IwanDensity, MeasuredCurve, density_of_backbone, fit_backbone,
    fit_dissipation, fit_from_many, unknowns_of_fit,
};

/// A density with all six parameters.
fn document() -> IwanDensity {
    IwanDensity {
        density: 2.0e6,
        exponent: -0.3,
        phi_1: 1.0e-5,
        phi_2: 1.0e-4,
        slider_stiffness: 3.0e3,
        residual_stiffness: 1.0e3,
    }
}

/// Bilinear backbones, of a lump of sliders and a spring without any density, are fitted: the exponent, on
/// which nothing depends then, ran until values were no numbers, and the fit panicked or never ended.
#[test]
fn bilinear_backbones_are_fitted() {
    for slope in [0.4, 0.55, 0.7] {
        for rows in [20, 40, 150] {
            for knee in [1.0e-4, 2.0e-4, 5.0e-4] {
                for phi_1 in [None, Some(1.0e-5)] {
                    let force = |x: f64| 9.0e4 * (x.min(knee) + slope * (x - knee).max(0.0));
                    let measured: Vec<(f64, f64)> = (1..=rows)
                        .map(|i| 1.5e-3 * f64::from(i) / f64::from(rows))
                        .map(|x| (x, force(x)))
                        .collect();
                    let mut start = LawParameters::default();
                    start.values.extend(phi_1.map(|x| ("phi_1".to_owned(), x)));
                    let curve = MeasuredCurve::Backbone;
                    let fit = fit_from_many(curve, &measured, &start, FitOptions::default());
                    let fit = fit.unwrap();
                    // No density was there: that none is determined is said.
                    let doubts = fit.doubts(&measured);
                    let is_said = doubts.contains(&FitDoubt::LumpAlone);
                    let spread = IwanDensity {
                        slider_stiffness: 0.0,
                        residual_stiffness: 0.0,
                        ..fit.density
                    };
                    let share = spread.initial_stiffness() / fit.density.slider_stiffness;
                    assert_eq!(is_said, share < 1.0e-6, "{share}: {doubts:?}");
                    // The kink lies between two of the data.
                    assert!(
                        fit.relative_error < 1.0e-3,
                        "{slope} {rows} {knee}: {fit:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_fit_finds_the_density_that_made_the_curve() {
    let truth = document();
    let measured: Vec<(f64, f64)> = (0..40)
        .map(|i| 1.2e-5 * 1.1_f64.powi(i))
        .map(|a| (a, truth.cycle_dissipation(a)))
        .collect();
    let guess = IwanDensity {
        density: 3e5,
        exponent: -0.5,
        phi_1: 0.6e-5,
        phi_2: 2e-4,
        slider_stiffness: 1e3,
        residual_stiffness: 1e3,
    };
    let fit = fit_dissipation(&measured, guess, FitOptions::default()).unwrap();
    assert!(fit.relative_error < 1e-9, "{fit:?}");
    let pairs = [
        (fit.density.density, truth.density),
        (fit.density.exponent, truth.exponent),
        (fit.density.phi_1, truth.phi_1),
        (fit.density.phi_2, truth.phi_2),
        (fit.density.slider_stiffness, truth.slider_stiffness),
    ];
    for (found, expected) in pairs {
        assert!((found / expected - 1.0).abs() < 1e-5, "{fit:?}");
    }
    assert_eq!(fit.density.residual_stiffness, guess.residual_stiffness);
}

#[test]
fn a_fit_through_scattered_measurements_stays_near_and_reports_the_scatter() {
    let truth = IwanDensity::segalman(4000.0, 1.5e7, -0.5, 0.3).unwrap();
    // A fixed scatter of 2 %, by the golden ratio.
    let scatter = |i: usize| 1.0 + 0.04 * ((i as f64 * 0.618_033_988_75).fract() - 0.5);
    let measured: Vec<(f64, f64)> = (0..60)
        .map(|i| (i, 2e-5 * 1.08_f64.powi(i as i32)))
        .map(|(i, a)| (a, truth.cycle_dissipation(a) * scatter(i)))
        .collect();
    let guess = IwanDensity {
        density: 1e8,
        exponent: -0.2,
        phi_2: 4e-4,
        slider_stiffness: 1e6,
        ..truth
    };
    let fit = fit_dissipation(&measured, guess, FitOptions::default()).unwrap();
    // Uniform scatter of half width 2 % has a root mean square of 1.15 %.
    assert!((0.008..0.013).contains(&fit.relative_error), "{fit:?}");
    assert!(
        (fit.density.exponent - truth.exponent).abs() < 0.03,
        "{fit:?}"
    );
    assert!(
        (fit.density.phi_2 / truth.phi_2 - 1.0).abs() < 0.05,
        "{fit:?}"
    );
}

#[test]
fn data_that_cannot_be_fitted_are_refused_with_a_remedy() {
    let few = [(1e-5, 1e-6), (2e-5, 1e-5)];
    let negative = [
        (1e-5, 1e-6),
        (2e-5, -1e-5),
        (3e-5, 1.0),
        (4e-5, 1.0),
        (5e-5, 1.0),
    ];
    for measured in [&few[..], &negative[..]] {
        let error = fit_dissipation(measured, document(), FitOptions::default()).unwrap_err();
        assert!(matches!(error, HysteresisError::Fit { .. }));
        assert!(error.help().is_some());
    }
}

/// The curvature of a backbone is the density: `R phi^alpha` between both ends and nothing before, to
/// the second order of the distance of the points.
#[test]
fn the_curvature_of_a_backbone_is_the_density() {
    let truth = document();
    let error = |points: u32| {
        let reach = |i: u32| 1.2e-4 * f64::from(i) / f64::from(points);
        let measured: Vec<_> = (1..=points)
            .map(|i| (reach(i), truth.backbone(reach(i)).0))
            .collect();
        let found = density_of_backbone(&measured).unwrap();
        assert_eq!(found.len(), measured.len() - 1);
        // Nothing slips before phi_1.
        for (phi, density) in found.iter().filter(|(phi, _)| *phi < 0.9e-5) {
            assert!(density.abs() < 1e-6 * truth.density, "{phi}: {density}");
        }
        let inside = found.iter().filter(|(phi, _)| (2e-5..9e-5).contains(phi));
        inside
            .map(|(phi, density)| {
                let expected = truth.density * phi.powf(truth.exponent);
                (density / expected - 1.0).abs()
            })
            .fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(60), error(120));
    assert!(coarse < 3e-3 && fine < 0.3 * coarse, "{coarse:e} {fine:e}");
    assert!(density_of_backbone(&[(1e-5, 1.0)]).is_err());
    assert!(density_of_backbone(&[(2e-5, 1.0), (1e-5, 2.0)]).is_err());
}

/// All six parameters from a backbone, the residual stiffness with them.
#[test]
fn a_backbone_gives_its_density_back() {
    let truth = document();
    let measured: Vec<(f64, f64)> = (0..60)
        .map(|i| 4.0e-6 * 1.08_f64.powi(i))
        .map(|a| (a, truth.backbone(a).0))
        .collect();
    let guess = IwanDensity {
        density: 3e5,
        exponent: -0.5,
        phi_1: 0.6e-5,
        phi_2: 2e-4,
        slider_stiffness: 1e3,
        residual_stiffness: 1.0,
    };
    let fit = fit_backbone(&measured, guess, FitOptions::default()).unwrap();
    assert_eq!(fit.curve, MeasuredCurve::Backbone);
    assert!(fit.relative_error < 1e-8, "{fit:?}");
    let pairs = [
        (fit.density.density, truth.density),
        (fit.density.exponent, truth.exponent),
        (fit.density.phi_1, truth.phi_1),
        (fit.density.phi_2, truth.phi_2),
        (fit.density.slider_stiffness, truth.slider_stiffness),
        (fit.density.residual_stiffness, truth.residual_stiffness),
    ];
    for (found, expected) in pairs {
        assert!((found / expected - 1.0).abs() < 1e-4, "{fit:?}");
    }
}

/// The density of a backbone that any start of `phi_1` leads back to.
#[test]
fn a_backbone_gives_its_density_back_from_any_start() {
    let truth = IwanDensity {
        density: 5e8,
        exponent: -0.5,
        phi_1: 5e-4,
        phi_2: 2e-3,
        slider_stiffness: 5e5,
        residual_stiffness: 0.0,
    };
    let measured: Vec<(f64, f64)> = (0..80)
        .map(|i| 4e-5 + f64::from(i) * (6e-3 - 4e-5) / 79.0)
        .map(|x| (x, truth.backbone(x).0))
        .collect();
    for phi_1 in [1e-4, 2e-4, 4.5e-4, 1e-3] {
        let start = LawParameters::from_pairs(&[("phi_1", phi_1)]);
        let options = FitOptions::default();
        let fit = fit_from_many(MeasuredCurve::Backbone, &measured, &start, options).unwrap();
        assert!(fit.relative_error < 1e-9, "{phi_1}: {fit:?}");
        assert!(
            (fit.density.phi_1 / truth.phi_1 - 1.0).abs() < 1e-6,
            "{phi_1}: {fit:?}"
        );
        assert!(
            (fit.density.exponent + 0.5).abs() < 1e-6,
            "{phi_1}: {fit:?}"
        );
        assert_eq!(fit.doubts(&measured), []);
    }
}

/// Data that grow like a square, a straight line and a curve that ends before everything slips are fitted,
/// with what there is to doubt; data that fall are refused in words of their own.
#[test]
fn doubts_of_a_fit_are_told() {
    let fitted = |curve, value: fn(f64) -> f64| {
        let measured: Vec<(f64, f64)> = (1..=9)
            .map(f64::from)
            .map(|i| (1e-3 * i, value(i)))
            .collect();
        let start = LawParameters::default();
        let fit = fit_from_many(curve, &measured, &start, FitOptions::default());
        fit.map(|fit| {
            let doubts = fit.doubts(&measured);
            (fit, doubts)
        })
    };
    let (_, doubts) = fitted(MeasuredCurve::Backbone, |i| 1e3 * i * i).unwrap();
    let misfit =
        |d: &FitDoubt| matches!(d, FitDoubt::Misfit { relative_error } if *relative_error > 0.4);
    assert!(doubts.iter().any(misfit), "{doubts:?}");
    let (_, doubts) = fitted(MeasuredCurve::Backbone, |i| 1e3 * i).unwrap();
    assert_eq!(doubts, [FitDoubt::Straight]);
    // One of the data lies beyond `phi_2`, which may be anywhere before it.
    let (fit, doubts) = fitted(MeasuredCurve::Backbone, |i| 1e3 * (i - i * i / 60.0)).unwrap();
    assert!(fit.relative_error < 1e-3, "{fit:?}");
    let outside = |d: &FitDoubt| {
        matches!(
            d,
            FitDoubt::Outside {
                parameter: "phi_2",
                ..
            }
        )
    };
    assert!(doubts.iter().any(outside), "{fit:?}");
    assert!(
        doubts[0].to_string().contains("from 1 to 9 mm"),
        "{doubts:?}"
    );
    for (curve, what) in [
        (MeasuredCurve::Backbone, "force falls with the deformation"),
        (
            MeasuredCurve::Dissipation,
            "energy falls with the amplitude",
        ),
    ] {
        let error = fitted(curve, |i| 10.0 / i).unwrap_err();
        assert!(error.to_string().contains(what), "{error}");
        assert!(error.to_string().contains("from 10"), "{error}");
        assert!(error.help().is_some());
    }
}

/// From several starts: the density of Segalman 2005, whose residual stiffness is nothing, and a
/// uniform one.
#[test]
fn backbones_of_special_cases_are_found() {
    let segalman = IwanDensity::segalman(4000.0, 1.5e7, -0.5, 0.3).unwrap();
    let uniform = IwanDensity {
        density: 2.0e9,
        exponent: 0.0,
        phi_1: 0.0,
        phi_2: 5.0e-4,
        slider_stiffness: 0.0,
        residual_stiffness: 2.0e5,
    };
    for (truth, set) in [
        (segalman, [("residual_stiffness", 0.0)]),
        (uniform, [("slider_stiffness", 0.0)]),
    ] {
        let measured: Vec<(f64, f64)> = (0..50)
            .map(|i| 1.0e-5 * 1.1_f64.powi(i))
            .map(|a| (a, truth.backbone(a).0))
            .collect();
        let start = LawParameters::from_pairs(&set);
        let fit = fit_from_many(
            MeasuredCurve::Backbone,
            &measured,
            &start,
            FitOptions::default(),
        );
        let fit = fit.unwrap();
        assert!(fit.relative_error < 1e-6, "{fit:?}");
        assert!((fit.density.exponent - truth.exponent).abs() < 1e-4);
        assert!((fit.density.phi_2 / truth.phi_2 - 1.0).abs() < 1e-4);
    }
}

/// What is given is held, whether it is zero or not, and the others are found: those that made the data where it
/// is theirs, and a worse fit that keeps it where it is not. `slider_stiffness = 0` of many rows was fitted.
#[test]
fn what_is_given_is_held() {
    let truth = document();
    for curve in [MeasuredCurve::Backbone, MeasuredCurve::Dissipation] {
        let measured: Vec<(f64, f64)> = (0..40)
            .map(|i| 1.2e-5 * 1.1_f64.powi(i))
            .map(|x| (x, curve.value(&truth, x)))
            .collect();
        let fit = |pairs: &[(&'static str, f64)]| {
            let mut start = LawParameters::from_pairs(pairs);
            start.values.insert("phi_1".to_owned(), 0.8e-5);
            fit_from_many(curve, &measured, &start, FitOptions::default()).unwrap()
        };
        let own = [
            ("exponent", truth.exponent),
            ("phi_2", truth.phi_2),
            ("slider_stiffness", truth.slider_stiffness),
            ("residual_stiffness", truth.residual_stiffness),
        ];
        for held in [&own[..1], &own[1..2], &own[2..3], &own[3..], &own] {
            let found = fit(held);
            assert!(found.relative_error < 1e-7, "{held:?}: {found:?}");
            let values = found.density.parameters().values;
            for (name, expected) in held {
                assert_eq!(values.get(*name), Some(expected), "{found:?}");
            }
            for (found, expected) in [
                (found.density.density, truth.density),
                (found.density.phi_1, truth.phi_1),
                (found.density.slider_stiffness, truth.slider_stiffness),
            ] {
                assert!((found / expected - 1.0).abs() < 1e-4, "{held:?}: {found}");
            }
        }
        for (name, value) in [
            ("exponent", 0.5),
            ("phi_2", 0.7e-4),
            ("slider_stiffness", 0.0),
            ("slider_stiffness", 1.5e4),
            ("residual_stiffness", 0.0),
            ("residual_stiffness", 5.0e3),
        ] {
            let found = fit(&[(name, value)]);
            let held = found.density.parameters().values;
            let held = held.get(name).copied().unwrap_or_default();
            assert_eq!(held, value, "{name}: {found:?}");
        }
    }
}

/// Below a `phi_2` that is given, a lump of sliders there and what never slips are one spring.
#[test]
fn a_given_phi_2_beyond_the_data_leaves_a_sum_of_stiffnesses() {
    let truth = document();
    let curve = MeasuredCurve::Backbone;
    let measured: Vec<(f64, f64)> = (1..40)
        .map(|i| 0.02 * f64::from(i) * truth.phi_2)
        .map(|x| (x, curve.value(&truth, x)))
        .collect();
    let doubted = |pairs: &[(&'static str, f64)]| {
        let start = LawParameters::from_pairs(pairs);
        let fit = fit_from_many(curve, &measured, &start, FitOptions::default()).unwrap();
        let doubts = fit.doubts(&measured);
        doubts.contains(&FitDoubt::OneStiffness { phi_2: truth.phi_2 })
    };
    let (phi_2, residual) = (
        ("phi_2", truth.phi_2),
        ("residual_stiffness", truth.residual_stiffness),
    );
    assert!(doubted(&[phi_2]));
    assert!(!doubted(&[phi_2, residual]));
}

/// Without anything left to search for, the density alone is solved for.
#[test]
fn one_unknown_takes_one_point() {
    let truth = document();
    let start = LawParameters::from_pairs(&[
        ("exponent", truth.exponent),
        ("phi_1", 0.0),
        ("phi_2", truth.phi_2),
        ("slider_stiffness", truth.slider_stiffness),
        ("residual_stiffness", truth.residual_stiffness),
    ]);
    let curve = MeasuredCurve::Backbone;
    assert_eq!(unknowns_of_fit(curve, &start), Ok(1));
    let without_first = IwanDensity {
        phi_1: 0.0,
        ..truth
    };
    let measured = [(5.0e-5, without_first.backbone(5.0e-5).0)];
    let fit = fit_from_many(curve, &measured, &start, FitOptions::default()).unwrap();
    assert!((fit.density.density / truth.density - 1.0).abs() < 1e-9);
    // A start from which nothing sets out is refused, and so is what makes no density.
    for wrong in [
        &[("phi_1", 1.0)][..],
        &[("phi_1", -1.0e-5)],
        &[("phi_1", 2.0e-5), ("phi_2", 1.0e-5)],
        &[("exponent", -1.5)],
        &[("slider_stiffness", -1.0)],
    ] {
        let start = LawParameters::from_pairs(wrong);
        let many: Vec<_> = (1..=8)
            .map(|i| 2.0e-5 * f64::from(i))
            .map(|x| (x, truth.backbone(x).0))
            .collect();
        let found = fit_from_many(curve, &many, &start, FitOptions::default());
        assert!(
            matches!(found, Err(HysteresisError::Inconsistent { .. })),
            "{wrong:?}: {found:?}"
        );
    }
    // A density cannot be held.
    let start = LawParameters::from_pairs(&[("density", 1.0e6)]);
    for error in [
        unknowns_of_fit(curve, &start).unwrap_err(),
        fit_from_many(curve, &measured, &start, FitOptions::default()).unwrap_err(),
    ] {
        assert!(error.to_string().contains("`density`"), "{error}");
        assert!(error.help().unwrap().contains("leave density out"));
    }
}

/// Curves that fall at their end, in the middle or at one point are none of the law; noise is: by hand, of ten
/// equal forces but one of 0.5 the best level is `(9 + 2)/(9 + 4)` where all follow it, with relative errors of
/// 17.5 %.
#[test]
fn falls_are_told_from_noise() {
    let fall = |values: &[f64]| {
        let measured: Vec<(f64, f64)> = (1..)
            .zip(values)
            .map(|(i, y)| (1e-3 * f64::from(i), *y))
            .collect();
        Fall::of(MeasuredCurve::Backbone, &measured)
    };
    let humped = [10., 40., 70., 95., 100., 80., 50., 30., 20., 11.].map(|x| 1e3 * x);
    let found = fall(&humped).unwrap();
    assert_eq!(
        (found.from, found.to, found.place),
        ((5e-3, 1e5), (1e-2, 1.1e4), 9)
    );
    let last = [1., 1., 1., 1., 1., 1., 1., 1., 1., 0.5];
    let found = fall(&last).unwrap();
    assert_eq!(found.place, 9);
    let level = 11.0 / 13.0_f64;
    let misfit = ((9.0 * (level - 1.0).powi(2) + (2.0 * level - 1.0).powi(2)) / 10.0).sqrt();
    assert!((found.misfit - misfit).abs() < 1e-12, "{}", found.misfit);
    // What rises to a force that stays, with noise of up to 10 %.
    let noise = |i: u32| 1.0 + 0.1 * (2.0 * (f64::from(i) * 0.618_033_988_75).fract() - 1.0);
    let noisy: Vec<f64> = (1..60)
        .map(|i| (f64::from(i) / 20.0).min(1.0) * noise(i))
        .collect();
    assert_eq!(fall(&noisy), None);
    assert_eq!(fall(&[]), None);
    // Cycles come in any order.
    let cycles = [(3e-3, 9.0), (1e-3, 1.0), (2e-3, 4.0)];
    assert_eq!(Fall::of(MeasuredCurve::Dissipation, &cycles), None);
}

/// A force that stays from the first deformation on puts the end of the density there or before, however many
/// rows there are: of 40 nothing was said of it.
#[test]
fn an_end_at_the_first_of_the_data_is_doubted() {
    for rows in [10, 20, 40, 80] {
        let measured: Vec<(f64, f64)> = (0..rows)
            .map(|i| f64::from(i) / f64::from(rows - 1))
            .map(|part| (2e-4 * 200_f64.powf(part), 1e5))
            .collect();
        let start = LawParameters::default();
        let curve = MeasuredCurve::Backbone;
        let fit = fit_from_many(curve, &measured, &start, FitOptions::default()).unwrap();
        let is_doubted = fit.doubts(&measured).iter().any(|doubt| {
            matches!(
                doubt,
                FitDoubt::Outside {
                    parameter: "phi_2",
                    ..
                }
            )
        });
        assert!(is_doubted, "{rows}: {fit:?}");
    }
}
