//! Trap 4: forces that start like a broken power of time. The error control of a first
//! step of ordinary length does not see the singularity.
//!
//! `F = k delta^n + c delta^((n-1)/2) v` is a linear oscillator in `delta^((n+1)/2)`
//! when time is stretched by `delta^((n-1)/2)`: closed forms for a free collision with
//! damping in approach alone.

use pounding_gap_element::{ModelParameters, registry};
use pounding_time_history::{DEFAULT_RELATIVE_TOLERANCE, MethodChoice};

use super::case::{Case, Chain, Law, go, steady};
use super::integrate::integrate;
use super::near;

const MASS: f64 = 2.0e4;
const STIFFNESS: f64 = 2.75e9;
const RATIO: f64 = 0.35;
const SPEED: f64 = 0.5;

/// What a free collision of the law of Jankowski (2005) leaves.
struct Collision {
    separation: f64,
    penetration: f64,
    force: f64,
    duration: f64,
}

fn closed_form() -> Collision {
    let (k, m) = (STIFFNESS, MASS);
    let dashpot = 2.0 * RATIO * (k * m).sqrt();
    // z = delta^1.25: z'' + (c/m) z' + 1.25 (k/m) z = 0, z(0) = 0, z'(0) = 1.25 v0.
    let decay = 0.5 * dashpot / m;
    let omega = (1.25 * k / m - decay * decay).sqrt();
    let z = |s: f64| 1.25 * SPEED / omega * (-decay * s).exp() * (omega * s).sin();
    let rate = |s: f64| {
        let (sin, cos) = (omega * s).sin_cos();
        1.25 * SPEED * (-decay * s).exp() * (cos - decay / omega * sin)
    };
    let turning = omega.atan2(decay) / omega;
    let penetration = z(turning).powf(0.8);
    let force = |s: f64| z(s).powf(0.2) * (k * z(s) + dashpot * rate(s) / 1.25);
    let separation = (0.8 * k / m).sqrt() * penetration.powf(1.25);
    // dt = ds / delta^0.25; with s = w^1.25 both ends are smooth.
    let approach = integral(turning.powf(0.8), |w| {
        let s = w.powf(1.25);
        1.25 * (w.powf(1.25) / z(s)).powf(0.2)
    });
    // Elastic half: delta = delta_max (1 - x^2).
    let restitution = integral(1.0, |x| {
        let lost = -f64::exp_m1(2.5 * f64::ln_1p(-x * x));
        2.0 * x / lost.sqrt() * penetration / separation
    });
    Collision {
        separation,
        penetration,
        force: maximum(force, 0.0, turning),
        duration: approach + restitution,
    }
}

/// Integral from zero by Gauss's rule of three points on many panels; it does not ask
/// for the ends, which are limits.
fn integral(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let panels = 20_000;
    let half = 0.5 * end / f64::from(panels);
    let node = half * 0.6_f64.sqrt();
    let sum = (0..panels).map(|i| {
        let middle = half * f64::from(2 * i + 1);
        (5.0 * f(middle - node) + 8.0 * f(middle) + 5.0 * f(middle + node)) / 9.0
    });
    half * sum.sum::<f64>()
}

fn maximum(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let (mut low, mut high) = (low, high);
    for _ in 0..200 {
        let third = (high - low) / 3.0;
        if f(low + third) < f(high - third) {
            low += third;
        } else {
            high -= third;
        }
    }
    f(0.5 * (low + high))
}

/// Separation velocity of an integration at this tolerance whose first step is a tenth
/// of the contact, or shorter as its error control sees fit.
fn naive(tolerance: f64, truth: &Collision) -> f64 {
    let dashpot = 2.0 * RATIO * (STIFFNESS * MASS).sqrt();
    let law = |_: f64, s: &[f64], out: &mut [f64]| {
        let delta = s[0].max(0.0);
        let damping = dashpot * delta.powf(0.25) * s[1].max(0.0);
        out[0] = s[1];
        out[1] = -(STIFFNESS * delta.powf(1.5) + damping) / MASS;
    };
    let scale = [truth.penetration, SPEED];
    let span = (0.1 * truth.duration, truth.duration);
    let end = integrate(law, &[0.0, SPEED], span, (tolerance, &scale)).unwrap();
    -end[1]
}

/// The program keeps within its tolerance; the same pair at the same tolerance, from
/// the exact closure but with a first step of ordinary length, errs by six times as
/// much.
#[test]
fn contacts_that_start_like_a_broken_power() {
    let truth = closed_form();
    let naive_error = |tolerance| (naive(tolerance, &truth) / truth.separation - 1.0).abs();
    assert!(naive_error(1e-4) > 2e-4 && naive_error(1e-6) > 5e-6);
    let law = Law::Spring { k: 1.0 };
    let case = Case::wall(Chain::body(MASS), 0, 0.05, law, steady(0.0, 6, 0.04));
    let case = case.from(&[0.0, SPEED]);
    let pairs = [("stiffness", STIFFNESS), ("damping_ratio", RATIO)];
    let tolerances = [(1e-6, 1e-6), (DEFAULT_RELATIVE_TOLERANCE, 1e-9)];
    for (relative_tolerance, allowed) in tolerances {
        for method in [
            MethodChoice::EventDriven { relative_tolerance },
            MethodChoice::Adaptive { relative_tolerance },
        ] {
            let parameters = ModelParameters::from_pairs(&pairs);
            let model = registry::build("jankowski_2005", &parameters).unwrap();
            let outcome = go(&case.system_with(model.into()), method);
            assert_eq!(outcome.impacts.len(), 1, "{method:?}");
            let impact = &outcome.impacts[0];
            let duration = impact.time_opened - impact.time_closed;
            for (what, computed, expected) in [
                ("closure", impact.time_closed, 0.1),
                ("separation", impact.separation_velocity, truth.separation),
                (
                    "penetration",
                    impact.peak_penetration.value,
                    truth.penetration,
                ),
                ("force", impact.peak_force.value, truth.force),
                ("duration", duration, truth.duration),
            ] {
                near(&format!("{what}, {method:?}"), computed, expected, allowed);
            }
        }
    }
}
