//! An elastic-perfectly-plastic oscillator under El Centro, solved exactly from event to
//! event: written on its own, with nothing of the program in it.

use std::sync::Arc;

use pounding_hysteresis::LawParameters;
use pounding_shear_building::{Damping, ShearBuilding};
use pounding_time_history::{GroundAcceleration, MethodChoice, System};

use super::setup::{ADAPTIVE, EVENT_DRIVEN, el_centro, go, law, newmark};

const MASS: f64 = 25.0e3;
const PERIOD: f64 = 0.5;
const RATIO: f64 = 0.05;

fn stiffness() -> f64 {
    MASS * (std::f64::consts::TAU / PERIOD).powi(2)
}

fn damping() -> f64 {
    2.0 * RATIO * (stiffness() * MASS).sqrt()
}

/// State on a branch `m x'' + c x' + k x + f = -m (a + s t)`, exactly: `k` is the
/// elastic stiffness or zero.
#[derive(Clone, Copy)]
struct Branch {
    k: f64,
    f: f64,
}

/// Displacement and velocity after `t` seconds.
fn flow(branch: Branch, (x, v): (f64, f64), (a, s): (f64, f64), t: f64) -> (f64, f64) {
    let (m, c) = (MASS, damping());
    // A particular solution that is a polynomial of time, then the free motion.
    if branch.k > 0.0 {
        let slope = -m * s / branch.k;
        let constant = (-m * a - branch.f - c * slope) / branch.k;
        let w = (branch.k / m).sqrt();
        let z = c / (2.0 * m * w);
        let wd = w * (1.0 - z * z).sqrt();
        let (x0, v0) = (x - constant, v - slope);
        let b = (v0 + z * w * x0) / wd;
        let decay = (-z * w * t).exp();
        let (sin, cos) = (wd * t).sin_cos();
        let free = decay * (x0 * cos + b * sin);
        let rate = -z * w * free + decay * wd * (b * cos - x0 * sin);
        (constant + slope * t + free, slope + rate)
    } else {
        // m v' + c v = -f - m a - m s t
        let r = c / m;
        let p1 = -s / r;
        let p0 = (-branch.f / m - a - p1) / r;
        let q = v - p0;
        let decay = (-r * t).exp();
        let v1 = p0 + p1 * t + q * decay;
        let x1 = x + p0 * t + 0.5 * p1 * t * t + q * (1.0 - decay) / r;
        (x1, v1)
    }
}

/// First time in `(0, h]` at which `f` changes from negative to positive: fine samples,
/// then bisection.
fn first_crossing(f: impl Fn(f64) -> f64, h: f64) -> Option<f64> {
    const PARTS: usize = 200;
    let at = |i: usize| h * i as f64 / PARTS as f64;
    let i = (1..=PARTS).find(|i| f(at(*i)) > 0.0)?;
    let (mut low, mut high) = (at(i - 1), at(i));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if f(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    Some(high)
}

struct Exact {
    peak: f64,
    end: f64,
    dissipated: f64,
    yieldings: usize,
}

fn exact(ground: &GroundAcceleration, yield_force: f64) -> Exact {
    let k = stiffness();
    let elastic = |plastic: f64| Branch { k, f: -k * plastic };
    let (mut x, mut v, mut plastic) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut branch, mut yielding) = (elastic(0.0), 0.0_f64);
    let mut out = Exact {
        peak: 0.0,
        end: 0.0,
        dissipated: 0.0,
        yieldings: 0,
    };
    let h = ground.time_step;
    for pair in ground.samples.windows(2) {
        let slope = (pair[1] - pair[0]) / h;
        let mut t = 0.0;
        while t < h {
            let load = (pair[0] + slope * t, slope);
            let rest = h - t;
            let state = (x, v);
            let path = |tau: f64| flow(branch, state, load, tau);
            let event = if yielding == 0.0 {
                let over = |tau: f64| (k * (path(tau).0 - plastic)).abs() - yield_force;
                first_crossing(over, rest)
            } else {
                first_crossing(|tau| -yielding * path(tau).1, rest)
            };
            let step = event.unwrap_or(rest);
            for i in 1..=100 {
                out.peak = out.peak.max(path(step * f64::from(i) / 100.0).0.abs());
            }
            let (x1, v1) = path(step);
            if yielding != 0.0 {
                out.dissipated += yield_force * (x1 - x).abs();
                plastic += x1 - x;
            }
            (x, v) = (x1, v1);
            if event.is_some() {
                if yielding == 0.0 {
                    yielding = v.signum();
                    out.yieldings += 1;
                    branch = Branch {
                        k: 0.0,
                        f: yielding * yield_force,
                    };
                } else {
                    yielding = 0.0;
                    branch = elastic(plastic);
                }
            }
            t = if event.is_some() { t + step } else { h };
        }
    }
    out.end = x;
    out
}

fn oscillator(yield_force: f64) -> System {
    let parameters =
        LawParameters::from_pairs(&[("stiffness", stiffness()), ("yield_force", yield_force)]);
    let building = ShearBuilding::new(
        "oscillator".to_owned(),
        vec![MASS],
        vec![stiffness()],
        vec![3.0],
        Damping::Dashpots {
            coefficients: vec![damping()],
        },
    )
    .unwrap()
    .with_laws(vec![Some(law("elastic_perfectly_plastic", &parameters))])
    .unwrap();
    System::new(vec![Arc::new(building)], el_centro())
}

/// An eighth of the elastic strength: dozens of yieldings.
#[test]
fn elastic_perfectly_plastic_oscillator_under_el_centro() {
    let ground = el_centro();
    let duration = ground.time_step * (ground.samples.len() - 1) as f64;
    let yield_force = 0.12 * MASS * 9.81;
    let exact = exact(&ground, yield_force);
    assert!(exact.yieldings > 10, "{} yieldings", exact.yieldings);
    for (name, method, tolerance) in [
        ("adaptive", ADAPTIVE, 1.0e-8),
        ("event_driven", EVENT_DRIVEN, 1.0e-11),
        (
            "runge_kutta_4",
            MethodChoice::RungeKutta4 { step: 1.0e-3 },
            1.0e-6,
        ),
        ("newmark", newmark(2.0e-4), 1.0e-4),
    ] {
        let outcome = go(&oscillator(yield_force), method, duration);
        let storey = outcome.buildings[0].yielding[0].unwrap();
        let peak = outcome.buildings[0].storeys[0].displacement.value;
        let end = outcome.final_displacement[0];
        println!(
            "{name}: peak {:.2e}, end {:.2e}, energy {:.2e}, residual {:.2e}; {} yieldings, {:?}",
            peak / exact.peak - 1.0,
            (end - exact.end) / exact.peak,
            storey.hysteretic_energy / exact.dissipated - 1.0,
            outcome.energy.residual_ratio,
            exact.yieldings,
            outcome.statistics
        );
        assert!((peak / exact.peak - 1.0).abs() < tolerance, "{name}");
        assert!((end - exact.end).abs() < tolerance * exact.peak, "{name}");
        assert!(
            (storey.hysteretic_energy / exact.dissipated - 1.0).abs() < tolerance,
            "{name}"
        );
        let shear = outcome.buildings[0].storeys[0].storey_shear.value;
        assert!(
            (shear / yield_force - 1.0).abs() < 1.0e-9,
            "{name}: {shear}"
        );
        let ductility = storey.ductility.unwrap().value;
        assert!((ductility - peak * stiffness() / yield_force).abs() < 1.0e-9 * ductility);
    }
}
