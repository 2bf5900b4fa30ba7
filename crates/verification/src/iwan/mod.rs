//! The six-parameter Iwan model of a joint.

mod references;

use pounding_hysteresis::iwan::{
    FitOptions, IwanDensity, MeasuredCurve, density_of_backbone, dimensionless_dissipation,
    fit_from_many,
};
use pounding_hysteresis::laboratory::{Cycling, dissipation_curve, history, log_slope};
use pounding_hysteresis::{HysteresisError, HysteresisLaw, LawParameters, build};
use references::{
    BACKBONE, BETAS, DISSIPATION, DOCUMENT, EXPERIMENT_SLOPE, FIGURE_EXPONENT, INITIAL_STIFFNESS,
    KAPPAS, MODEL_SLOPE, OVER_BETA, OVER_KAPPA, SLIP_FORCE, UNLOADING,
};

use crate::comparison::{
    Comparison, Line, Part, Verdict, largest, largest_relative, nothing, number, power, text,
};
use crate::error::VerificationError;

/// Agreement with quadratures (-, relative).
const QUADRATURE: f64 = 1.0e-12;
/// Agreement of a fitted slope with the exponent of a power (-).
const SLOPE: f64 = 1.0e-9;

/// The six-parameter Iwan model of a joint: closed forms, dissipation as in the figures, slopes.
///
/// # Errors
/// A density that the law does not take.
pub fn iwan() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "iwan",
        citation: "Six-parameter Iwan model of a joint: power density on [phi_1, phi_2], lump K2 at phi_2, spring Kinf",
        comparisons: vec![
            closed_forms()?,
            curvature()?,
            backbone_fit()?,
            special_cases()?,
            over_beta()?,
            over_kappa()?,
            slopes()?,
            joint()?,
        ],
        findings: [
            "Formulas of backbone, loops and dissipation agree with quadratures of the density, both as closed forms and as the law driven along its loops. The numbers of the publication's figures are not printed; the curves are held against quadratures.",
            "With beta = 0 the dissipation of micro-slip (A < phi_2) is a pure power, alpha + 3. A positive beta leaves cycles below phi_1 without any loss and makes the curve steeper above; kappa_2 changes nothing before phi_2, and adds 4 kappa_2 (A / phi_2 - 1) beyond.",
            "The density is the negative curvature of the backbone: differences of a backbone give it back to the second order of the distance of its points, and a fit all six parameters.",
            "Experiment and model of the publication differ by 0.04 in the slope. Its parameters are not known here: alpha = -0.13 was put in because 2.87 means that for beta = 0, so that 2.87 comes out shows nothing and is computed only; the measured 2.83 would take alpha = -0.17.",
        ]
        .map(str::to_owned)
        .to_vec(),
    })
}

/// The law of a density.
fn law(density: &IwanDensity) -> Result<Box<dyn HysteresisLaw>, HysteresisError> {
    build("iwan_six_parameter", &density.parameters())
}

/// Closed form and driven law against one reference.
fn line(name: String, reference: f64, computed: f64, driven: Option<f64>) -> Line {
    let pairs: Vec<(f64, f64)> = [Some(computed), driven]
        .into_iter()
        .flatten()
        .map(|value| (value, reference))
        .collect();
    let difference = largest_relative(&pairs);
    Line {
        cells: vec![
            text(name),
            power(reference, 12),
            power(computed, 12),
            driven.map_or_else(nothing, |value| power(value, 12)),
            power(difference, 0),
        ],
        verdict: Verdict::reference(difference, QUADRATURE),
        claimed: Verdict::AgreesWithReference,
    }
}

fn closed_forms() -> Result<Comparison, HysteresisError> {
    let law = law(&DOCUMENT)?;
    let force = |path: &[f64]| history(law.as_ref(), path, 1.0).last().map(|p| p.force);
    let mut lines = vec![
        line(
            "initial stiffness (N/m)".to_owned(),
            INITIAL_STIFFNESS,
            DOCUMENT.initial_stiffness(),
            Some(law.initial_stiffness()),
        ),
        line(
            "force of all sliders (N)".to_owned(),
            SLIP_FORCE,
            DOCUMENT.slip_force(),
            None,
        ),
    ];
    lines.extend(BACKBONE.iter().map(|(x, reference)| {
        let name = format!("backbone at {x:e} m (N)");
        line(name, *reference, DOCUMENT.backbone(*x).0, force(&[*x]))
    }));
    lines.extend(UNLOADING.iter().map(|(a, x, reference)| {
        let name = format!("unloading from {a:e} m at {x:e} m (N)");
        line(
            name,
            *reference,
            DOCUMENT.unloading(*a, *x),
            force(&[*a, *x]),
        )
    }));
    lines.extend(UNLOADING.iter().map(|(a, x, reference)| {
        let name = format!("reloading from {:e} m at {:e} m (N)", -a, -x);
        let driven = force(&[*a, -a, -x]);
        line(name, -reference, DOCUMENT.reloading(*a, -x), driven)
    }));
    let cycling = Cycling::default();
    lines.extend(DISSIPATION.iter().map(|(a, reference)| {
        let driven = dissipation_curve(law.as_ref(), &[*a], cycling);
        line(
            format!("dissipation of a cycle at {a:e} m (J)"),
            *reference,
            DOCUMENT.cycle_dissipation(*a),
            driven.first().map(|d| d.1),
        )
    }));
    Ok(Comparison {
        title: "R = 2e6 N/m^1.7, alpha = -0.3, phi_1 = 0.01 mm, phi_2 = 0.1 mm, K2 = 3 kN/m, Kinf = 1 kN/m. Against quadratures (relative)".to_owned(),
        columns: vec![
            ("quantity", "quantity"),
            ("reference", "reference"),
            ("closed_form", "closed form"),
            ("law", "law, driven"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// Backbone of the driven law at even deformations (m) up to 1.2 phi_2.
fn driven_backbone(points: u32) -> Result<Vec<(f64, f64)>, HysteresisError> {
    let law = law(&DOCUMENT)?;
    let reach = |i: u32| 1.2 * DOCUMENT.phi_2 * f64::from(i) / f64::from(points);
    let path: Vec<f64> = (1..=points).map(reach).collect();
    let forces = history(law.as_ref(), &path, 1.0);
    let forces = forces.iter().filter(|p| p.deformation > 0.0);
    Ok(forces.map(|p| (p.deformation, p.force)).collect())
}

/// The density is the negative curvature of the backbone.
fn curvature() -> Result<Comparison, HysteresisError> {
    const POINTS: [u32; 2] = [120, 480];
    let found = POINTS.map(|points| density_of_backbone(&driven_backbone(points)?));
    let [coarse, fine] = found;
    let (coarse, fine) = (coarse?, fine?);
    let at = |curve: &[(f64, f64)], phi: f64| {
        let nearest = curve
            .iter()
            .min_by(|a, b| (a.0 - phi).abs().total_cmp(&(b.0 - phi).abs()));
        nearest.map_or(f64::NAN, |(_, density)| *density)
    };
    let lines = [0.05, 0.2, 0.4, 0.6, 0.8, 0.95].map(|part| {
        let phi = part * DOCUMENT.phi_2;
        let inside = phi > DOCUMENT.phi_1;
        let expected = if inside {
            DOCUMENT.density * phi.powf(DOCUMENT.exponent)
        } else {
            0.0
        };
        // Before phi_1 against the density at phi_2, which has the least.
        let unit = DOCUMENT.density * DOCUMENT.phi_2.powf(DOCUMENT.exponent);
        let error = |curve: &[(f64, f64)]| (at(curve, phi) - expected).abs() / unit;
        let (first, second) = (error(&coarse), error(&fine));
        Line {
            cells: vec![
                number(part, 2),
                power(expected, 6),
                power(at(&coarse, phi), 6),
                power(at(&fine, phi), 6),
                power(second, 0),
            ],
            verdict: match second <= 1.0e-6 || (second <= 0.1 * first && second <= 1.0e-3) {
                true => Verdict::AgreesWithReference,
                false => Verdict::NotReproduced,
            },
            claimed: Verdict::AgreesWithReference,
        }
    });
    Ok(Comparison {
        title: "Density (N/m2) from the curvature of the backbone of the driven law, -F'' by differences over 120 and 480 points up to 1.2 phi_2, against R phi^alpha between phi_1 and phi_2 (over that at phi_2)".to_owned(),
        columns: vec![
            ("phi_ratio", "phi / phi_2"),
            ("density", "R phi^alpha"),
            ("coarse", "120 points"),
            ("fine", "480 points"),
            ("difference", "difference"),
        ],
        lines: lines.to_vec(),
    })
}

/// All six parameters from a backbone, as `--fit backbone` finds them: from several starts, as a
/// single one far away may end in another minimum.
fn backbone_fit() -> Result<Comparison, HysteresisError> {
    let start = LawParameters::from_pairs(&[("phi_1", 0.6e-5)]);
    let measured = driven_backbone(120)?;
    let options = FitOptions::default();
    let found = fit_from_many(MeasuredCurve::Backbone, &measured, &start, options)?.density;
    let lines = [
        ("R (N/m^1.7)", DOCUMENT.density, found.density),
        ("alpha", DOCUMENT.exponent, found.exponent),
        ("phi_1 (m)", DOCUMENT.phi_1, found.phi_1),
        ("phi_2 (m)", DOCUMENT.phi_2, found.phi_2),
        (
            "K2 (N/m)",
            DOCUMENT.slider_stiffness,
            found.slider_stiffness,
        ),
        (
            "Kinf (N/m)",
            DOCUMENT.residual_stiffness,
            found.residual_stiffness,
        ),
    ]
    .map(|(name, put_in, fitted)| {
        let difference = largest_relative(&[(fitted, put_in)]);
        Line {
            cells: vec![
                text(name),
                power(put_in, 6),
                power(fitted, 6),
                power(difference, 0),
            ],
            verdict: Verdict::reference(difference, 1.0e-4),
            claimed: Verdict::AgreesWithReference,
        }
    });
    Ok(Comparison {
        title: "The same backbone, fitted: parameters put in, and found (relative)".to_owned(),
        columns: vec![
            ("parameter", "parameter"),
            ("put_in", "put in"),
            ("found", "found"),
            ("difference", "difference"),
        ],
        lines: lines.to_vec(),
    })
}

/// The densities of Segalman 2005 and Song 2004 are special cases, whose backbones can be written
/// down: their laws driven along loading, unloading and reloading, beside the backbones and Masing's
/// rule.
fn special_cases() -> Result<Comparison, HysteresisError> {
    // Segalman: F_S, K_T, chi, beta, and the density that they mean.
    let (slip, stiffness, chi, beta) = (4000.0, 1.5e7, -0.5_f64, 0.3);
    let share = beta + (chi + 1.0) / (chi + 2.0);
    let last = slip * (1.0 + beta) / (stiffness * share);
    let factor = slip * (chi + 1.0) / (last.powf(chi + 2.0) * share);
    let lump = slip / last * beta / share;
    let segalman = |x: f64| {
        let reach = x.min(last);
        let slipping = factor * reach.powf(chi + 2.0) / (chi + 2.0);
        let stuck = factor * (last.powf(chi + 1.0) - reach.powf(chi + 1.0)) / (chi + 1.0) + lump;
        slipping + reach * stuck
    };
    // Song: a uniform density from 0.05 to 0.5 mm, and a tenth of the stiffness that never slips.
    let (first, end) = (5.0e-5, 5.0e-4);
    let (uniform, residual) = (0.9 * stiffness / (end - first), 0.1 * stiffness);
    let song = |x: f64| {
        let reach = x.clamp(first, end);
        let slipping = 0.5 * uniform * (reach * reach - first * first);
        slipping + uniform * (end - reach) * x.min(end) + residual * x
    };
    let (segalman, song): (&dyn Fn(f64) -> f64, &dyn Fn(f64) -> f64) = (&segalman, &song);
    let cases = [
        (
            "segalman_2005",
            "phi_1 = 0, Kinf = 0",
            vec![
                ("slip_force", slip),
                ("stiffness", stiffness),
                ("chi", chi),
                ("beta", beta),
            ],
            segalman,
        ),
        (
            "song_2004",
            "alpha = 0, K2 = 0",
            vec![
                ("stiffness", stiffness),
                ("residual_ratio", 0.1),
                ("phi_1", first),
                ("phi_2", end),
            ],
            song,
        ),
    ];
    let mut lines = Vec::new();
    for (name, case, parameters, backbone) in cases {
        let law = build(name, &LawParameters::from_pairs(&parameters))?;
        let (mut pairs, mut peak) = (Vec::new(), 0.0);
        for amplitude in [1.0e-4, 3.0e-4, 8.0e-4] {
            peak = backbone(amplitude);
            for part in [1.0, 0.9, 0.3, 0.0, -0.4, -1.0] {
                let x = part * amplitude;
                // Down from the peak, and up again from its mirror image.
                let down = peak - 2.0 * backbone(0.5 * (amplitude - x));
                let driven = |path: &[f64]| {
                    let points = history(law.as_ref(), path, 1.0);
                    points.last().map_or(f64::NAN, |p| p.force)
                };
                pairs.push((driven(&[amplitude, x]), down));
                pairs.push((driven(&[amplitude, -amplitude, -x]), -down));
            }
        }
        let difference = largest(pairs.iter().map(|(a, b)| (a - b).abs() / peak));
        lines.push(Line {
            cells: vec![
                text(name),
                text(case),
                number(pairs.len() as f64, 0),
                power(peak, 9),
                power(difference, 0),
            ],
            verdict: Verdict::reference(difference, QUADRATURE),
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "Special cases of the density, driven along loops of 0.1, 0.3 and 0.8 mm: against their backbones written down and Masing's rule (over the largest force)".to_owned(),
        columns: vec![
            ("law", "law"),
            ("case", "case"),
            ("points", "points"),
            ("peak_force", "largest force (N)"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// A family of curves: one line an amplitude.
fn family(
    rows: &[(f64, [f64; 5])],
    dissipation: impl Fn(f64, usize) -> Result<f64, HysteresisError>,
) -> Result<Vec<Line>, HysteresisError> {
    rows.iter()
        .map(|(amplitude, reference)| {
            let computed = (0..reference.len())
                .map(|curve| dissipation(*amplitude, curve))
                .collect::<Result<Vec<f64>, HysteresisError>>()?;
            // Nothing must come out as nothing.
            let difference = largest(computed.iter().zip(reference).map(|(value, reference)| {
                if *reference == 0.0 {
                    value.abs()
                } else {
                    (value / reference - 1.0).abs()
                }
            }));
            let mut cells = vec![number(*amplitude, 1)];
            cells.extend(computed.iter().map(|value| number(*value, 9)));
            cells.push(power(difference, 0));
            Ok(Line {
                cells,
                verdict: Verdict::reference(difference, QUADRATURE),
                claimed: Verdict::AgreesWithReference,
            })
        })
        .collect()
}

fn over_beta() -> Result<Comparison, HysteresisError> {
    let dissipation = |amplitude, curve: usize| {
        dimensionless_dissipation(amplitude, FIGURE_EXPONENT, BETAS[curve], 0.0)
    };
    Ok(Comparison {
        title:
            "D / (R phi_2^(alpha+3)) for alpha = -0.3, kappa_2 = 0. Against quadratures (relative)"
                .to_owned(),
        columns: vec![
            ("amplitude_ratio", "A / phi_2"),
            ("beta_0", "beta = 0"),
            ("beta_0_2", "0.2"),
            ("beta_0_4", "0.4"),
            ("beta_0_6", "0.6"),
            ("beta_0_8", "0.8"),
            ("largest_difference", "largest difference"),
        ],
        lines: family(&OVER_BETA, dissipation)?,
    })
}

fn over_kappa() -> Result<Comparison, HysteresisError> {
    let dissipation = |amplitude, curve: usize| {
        dimensionless_dissipation(amplitude, FIGURE_EXPONENT, 0.0, KAPPAS[curve])
    };
    Ok(Comparison {
        title: "D / (R phi_2^(alpha+3)) for alpha = -0.3, beta = 0. Against quadratures (relative)"
            .to_owned(),
        columns: vec![
            ("amplitude_ratio", "A / phi_2"),
            ("kappa_2_0", "kappa_2 = 0"),
            ("kappa_2_0_5", "0.5"),
            ("kappa_2_1", "1"),
            ("kappa_2_2", "2"),
            ("kappa_2_5", "5"),
            ("largest_difference", "largest difference"),
        ],
        lines: family(&OVER_KAPPA, dissipation)?,
    })
}

/// Slope of the dissipation of the driven law in micro-slip, from a thousandth of phi_2 to
/// nine tenths of it.
fn slope(exponent: f64, beta: f64) -> Result<f64, HysteresisError> {
    let density = IwanDensity {
        exponent,
        phi_1: beta * DOCUMENT.phi_2,
        ..DOCUMENT
    };
    let law = law(&density)?;
    let amplitudes: Vec<f64> = (0..=20)
        .map(|i| 0.9 * density.phi_2 * 900.0_f64.powf(f64::from(i) / 20.0 - 1.0))
        .collect();
    let curve = dissipation_curve(law.as_ref(), &amplitudes, Cycling::default());
    Ok(log_slope(&curve).unwrap_or(f64::NAN))
}

fn slopes() -> Result<Comparison, HysteresisError> {
    let mut lines = Vec::new();
    for exponent in [-0.9, -0.5, -0.3, 0.0, 0.5] {
        let (reference, computed) = (exponent + 3.0, slope(exponent, 0.0)?);
        let difference = (computed - reference).abs();
        lines.push(Line {
            cells: vec![
                number(exponent, 2),
                number(reference, 2),
                number(computed, 9),
                power(difference, 0),
            ],
            verdict: Verdict::reference(difference, SLOPE),
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "Log-log slope in micro-slip, beta = 0: the law driven from 0.001 to 0.9 phi_2"
            .to_owned(),
        columns: vec![
            ("exponent", "alpha"),
            ("reference", "alpha + 3"),
            ("computed", "computed"),
            ("difference", "difference"),
        ],
        lines,
    })
}

/// Slopes that the publication prints of a bolted joint.
fn joint() -> Result<Comparison, HysteresisError> {
    let computed = slope(MODEL_SLOPE - 3.0, 0.0)?;
    let row = |what: &str, printed: f64, verdict, claimed| Line {
        cells: vec![
            text(what),
            number(printed, 2),
            number(computed, 6),
            number(computed - printed, 6),
        ],
        verdict,
        claimed,
    };
    Ok(Comparison {
        title: "Log-log slope of a bolted joint as printed, beside the law with alpha = -0.13, beta = 0".to_owned(),
        columns: vec![
            ("case", "slope of"),
            ("printed", "printed"),
            ("computed", "computed"),
            ("difference", "computed - printed"),
        ],
        lines: vec![
            // The exponent was put in for it.
            row(
                "the model",
                MODEL_SLOPE,
                Verdict::ComputedOnly,
                Verdict::ComputedOnly,
            ),
            row(
                "the experiment",
                EXPERIMENT_SLOPE,
                Verdict::printed(EXPERIMENT_SLOPE, computed, 0.01),
                Verdict::NotReproduced,
            ),
        ],
    })
}
