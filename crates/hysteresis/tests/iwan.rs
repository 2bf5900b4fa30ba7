//! The Iwan family against tabulated values, discrete sliders and limits.
use crate::common::{motion, times};
use pounding_hysteresis::iwan::{IwanDensity, dimensionless_dissipation};
use pounding_hysteresis::laboratory::{Cycling, cycle_dissipation, dissipation_curve, history};
use pounding_hysteresis::{HysteresisLaw, LawParameters, build};
use proptest::prelude::*;
use serde_json::Value;

fn data() -> Value {
    serde_json::from_str(include_str!("data/iwan.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    let row = |r: &Value| r.as_array().unwrap().iter().map(number).collect();
    value.as_array().unwrap().iter().map(row).collect()
}

fn close(value: f64, expected: f64) {
    assert!(
        (value / expected - 1.0).abs() < 1e-12,
        "{value:e} for {expected:e}"
    );
}

fn document() -> IwanDensity {
    let six = &data()["six_parameter"];
    let get = |name: &str| number(&six[name]);
    IwanDensity {
        density: get("density"),
        exponent: get("exponent"),
        phi_1: get("phi_1"),
        phi_2: get("phi_2"),
        slider_stiffness: get("slider_stiffness"),
        residual_stiffness: get("residual_stiffness"),
    }
}

fn law(density: &IwanDensity) -> Box<dyn HysteresisLaw> {
    let parameters = LawParameters::from_pairs(&[
        ("density", density.density),
        ("exponent", density.exponent),
        ("phi_1", density.phi_1),
        ("phi_2", density.phi_2),
        ("slider_stiffness", density.slider_stiffness),
        ("residual_stiffness", density.residual_stiffness),
    ]);
    build("iwan_six_parameter", &parameters).unwrap()
}

#[test]
fn closed_forms_and_the_law_reproduce_the_table() {
    let (table, density) = (data(), document());
    let six = &table["six_parameter"];
    let law = law(&density);
    close(
        density.initial_stiffness(),
        number(&six["initial_stiffness"]),
    );
    close(law.initial_stiffness(), number(&six["initial_stiffness"]));
    close(density.slip_force(), number(&six["slip_force"]));
    let kappa_2 = number(&six["kappa_2"]);
    for row in rows(&six["backbone"]) {
        close(density.backbone(row[0]).0, row[1]);
        close(density.backbone(-row[0]).0, -row[1]);
        close(history(law.as_ref(), &[row[0]], 1.0)[0].force, row[1]);
    }
    for row in rows(&six["unloading"]) {
        close(density.unloading(row[0], row[1]), row[2]);
        close(density.reloading(row[0], -row[1]), -row[2]);
        let points = history(law.as_ref(), &[row[0], row[1]], 1.0);
        close(points[1].force, row[2]);
        let points = history(law.as_ref(), &[row[0], -row[0], -row[1]], 1.0);
        close(points[2].force, -row[2]);
    }
    for row in rows(&six["cycle_dissipation"]) {
        close(density.cycle_dissipation(row[0]), row[1]);
        let coarse = Cycling {
            steps: 2,
            ..Cycling::default()
        };
        close(cycle_dissipation(law.as_ref(), row[0], coarse), row[1]);
        let unit = density.density * density.phi_2.powf(density.exponent + 3.0);
        let ratio = dimensionless_dissipation(
            row[0] / density.phi_2,
            density.exponent,
            density.phi_1 / density.phi_2,
            kappa_2,
        );
        close(ratio.unwrap() * unit, row[1]);
    }
}

/// Where the collection that the table was copied from lies beside the repository,
/// the copy must still be true.
#[test]
fn the_table_is_a_faithful_copy() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../../shared/reference/impact-verification.json"
    );
    let Ok(text) = std::fs::read_to_string(path) else {
        return;
    };
    let all: Value = serde_json::from_str(&text).unwrap();
    let source = &all["document003_iwan"];
    let table = data();
    let six = &table["six_parameter"];
    for (name, key) in [
        ("K0", "initial_stiffness"),
        ("F_slip_part", "slip_force"),
        ("kappa2", "kappa_2"),
    ] {
        assert_eq!(number(&source[name]), number(&six[key]), "{name}");
    }
    for entry in source["D"].as_array().unwrap() {
        let amplitude: f64 = entry["A"].as_str().unwrap().parse().unwrap();
        let copy = rows(&six["cycle_dissipation"]);
        let row = copy.iter().find(|r| r[0] == amplitude).unwrap();
        assert_eq!(row[1], number(&entry["D"]), "{amplitude}");
    }
    let (four, copy) = (&source["segalman"], &table["segalman_2005"]);
    for (name, key) in [
        ("phi_max", "phi_2"),
        ("R", "density"),
        ("S", "slider_stiffness"),
        ("F(phi_max/2)", "force_at_half"),
        ("D(phi_max/2)", "dissipation_at_half"),
    ] {
        assert_eq!(number(&four[name]), number(&copy[key]), "{name}");
    }
}

#[test]
fn the_four_parameter_conversion_reproduces_the_table_and_its_own_parameters() {
    let table = data();
    let four = &table["segalman_2005"];
    let get = |name: &str| number(&four[name]);
    let density =
        IwanDensity::segalman(get("slip_force"), get("stiffness"), get("chi"), get("beta"))
            .unwrap();
    close(density.phi_2, get("phi_2"));
    close(density.density, get("density"));
    close(density.slider_stiffness, get("slider_stiffness"));
    close(density.initial_stiffness(), get("stiffness"));
    close(density.slip_force(), get("slip_force"));
    let others = density.initial_stiffness() - density.slider_stiffness;
    close(density.slider_stiffness / others, get("beta"));
    close(
        density.backbone(0.5 * density.phi_2).0,
        get("force_at_half"),
    );
    let half = density.cycle_dissipation(0.5 * density.phi_2);
    close(half, get("dissipation_at_half"));
}

#[test]
fn small_cycles_dissipate_like_a_power_of_the_amplitude() {
    // With phi_1 = 0 the exponent is alpha + 3 (Segalman 2005), fitted here through
    // cycles of the law itself.
    for exponent in [-0.999, -0.7, -0.3, 0.0, 0.8] {
        let density = IwanDensity {
            exponent,
            phi_1: 0.0,
            ..document()
        };
        let law = law(&density);
        let amplitudes: Vec<f64> = (0..9).map(|i| 1e-7 * 2.0_f64.powi(i)).collect();
        let cycling = Cycling {
            steps: 2,
            ..Cycling::default()
        };
        let logs: Vec<(f64, f64)> = dissipation_curve(law.as_ref(), &amplitudes, cycling)
            .iter()
            .map(|(a, d)| (a.ln(), d.ln()))
            .collect();
        let n = logs.len() as f64;
        let mean = |f: fn(&(f64, f64)) -> f64| logs.iter().map(f).sum::<f64>() / n;
        let (x, y) = (mean(|p| p.0), mean(|p| p.1));
        let upper: f64 = logs.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
        let lower: f64 = logs.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
        let slope = upper / lower;
        assert!((slope - (exponent + 3.0)).abs() < 1e-10, "{slope}");
    }
}

#[test]
fn no_digits_are_lost_as_the_exponent_approaches_minus_one() {
    // At alpha = -1 the integrals are logarithms; the difference to them is of first
    // order in alpha + 1, with the second-order term below 1e-3 of it here.
    let base = document();
    let (a, b) = (base.phi_1, base.phi_2);
    let k0 = base.density * (b / a).ln() + base.slider_stiffness + base.residual_stiffness;
    let x = 5e-5;
    let force = base.density * ((x - a) + x * (b / x).ln())
        + (base.slider_stiffness + base.residual_stiffness) * x;
    // 4 int phi (x - phi) / phi dphi.
    let cycle = 2.0 * base.density * (x - a) * (x - a);
    let mut before = None;
    for order in [1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let density = IwanDensity {
            exponent: order - 1.0,
            ..base
        }
        .checked()
        .unwrap();
        // The order as it survives in the exponent.
        let order = density.exponent + 1.0;
        let off = [
            density.initial_stiffness() / k0 - 1.0,
            density.backbone(x).0 / force - 1.0,
            density.cycle_dissipation(x) / cycle - 1.0,
        ];
        // Sums of exponents round to 2e-16, times ln(phi) of about -10; the cycle adds
        // two of them.
        let rounding = [2e-15, 2e-15, 8e-15];
        for i in 0..3 {
            // phi^order = 1 + order ln(phi), ln(phi) in [-11.6, -9.2].
            assert!(off[i].abs() < 11.6 * order + rounding[i], "{i} {order}");
            if let Some((last_order, last)) = before {
                let last: [f64; 3] = last;
                let scaled: f64 = last[i] * order / last_order;
                let allowed = 1e-3 * scaled.abs() + rounding[i];
                assert!((off[i] - scaled).abs() < allowed, "{i} {order}");
            }
        }
        before = Some((order, off));
    }
}

/// Discrete sliders in parallel that share the density: an independent model with
/// its own memory, first-order in the number of sliders.
struct Sliders {
    elements: Vec<(f64, f64, f64)>,
    residual: f64,
    dissipated: f64,
    deformation: f64,
}

impl Sliders {
    /// `count` sliders, each for an equal span of the deformation at which it slips,
    /// with the stiffness that the left end of its span has.
    fn new(density: &IwanDensity, count: usize) -> Self {
        let width = (density.phi_2 - density.phi_1) / count as f64;
        let mut elements: Vec<_> = (0..count)
            .map(|i| {
                let phi = density.phi_1 + (i as f64 + 1.0) * width;
                (
                    density.density * phi.powf(density.exponent) * width,
                    phi,
                    0.0,
                )
            })
            .collect();
        elements.push((density.slider_stiffness, density.phi_2, 0.0));
        Self {
            elements,
            residual: density.residual_stiffness,
            dissipated: 0.0,
            deformation: 0.0,
        }
    }

    fn advance(&mut self, deformation: f64) -> f64 {
        let step = deformation - self.deformation;
        self.deformation = deformation;
        let mut sum = self.residual * deformation;
        for (stiffness, limit, stretch) in &mut self.elements {
            let free = *stretch + step;
            *stretch = free.clamp(-*limit, *limit);
            self.dissipated += *stiffness * *limit * (free - *stretch).abs();
            sum += *stiffness * *stretch;
        }
        sum
    }
}

#[test]
fn nested_loops_are_those_of_parallel_sliders_as_their_number_grows() {
    let density = document();
    let law = law(&density);
    let path: Vec<f64> = times(30.0, 0.3)
        .iter()
        .map(|t| motion(2.5e-4, *t).deformation)
        .collect();
    let exact = history(law.as_ref(), &path, 1.0);
    let force_max = exact.iter().fold(0.0_f64, |m, p| m.max(p.force.abs()));
    let energy = exact.last().unwrap().dissipated;
    let off = |count: usize| {
        let mut sliders = Sliders::new(&density, count);
        let mut force_off = 0.0_f64;
        for point in &exact {
            let force = sliders.advance(point.deformation);
            force_off = force_off.max((force - point.force).abs() / force_max);
        }
        (force_off, (sliders.dissipated / energy - 1.0).abs())
    };
    let ladder: Vec<_> = [1_250, 5_000, 20_000].map(off).to_vec();
    // A right-hand sum of a falling density over ten times its least limit is off
    // by about half a span of it.
    assert!(ladder[2].0 < 5e-5 && ladder[2].1 < 1e-4, "{ladder:?}");
    for pair in ladder.windows(2) {
        let (force, energy) = (pair[0].0 / pair[1].0, pair[0].1 / pair[1].1);
        assert!((3.6..4.4).contains(&force), "{ladder:?}");
        assert!((3.6..4.4).contains(&energy), "{ladder:?}");
    }
}

#[test]
fn a_closed_inner_loop_is_forgotten() {
    let density = document();
    let law = law(&density);
    let plain = [2e-4, -1.2e-4, 1.6e-4, 2.4e-4];
    let nested = [
        2e-4, 0.4e-4, 0.9e-4, 0.5e-4, 0.7e-4, -1.2e-4, 0.2e-4, -0.5e-4, 1.6e-4, 2.4e-4,
    ];
    let plain = history(law.as_ref(), &plain, 1.0);
    let nested = history(law.as_ref(), &nested, 1.0);
    for (i, j) in [(0, 0), (1, 5), (2, 8), (3, 9)] {
        close(nested[j].force, plain[i].force);
    }
    // The last point lies beyond all turning points: on the backbone.
    close(nested[9].force, density.backbone(2.4e-4).0);
    assert!(nested[9].dissipated > plain[3].dissipated);
}

proptest! {
    /// A loop between two turning points that were both passed before is closed;
    /// it never gives energy back, and no force exceeds the backbone.
    #[test]
    fn loops_dissipate_and_stay_within_the_backbone(
        path in prop::collection::vec(-4e-4..4e-4_f64, 1..40),
        (from, to) in (-3e-4..3e-4_f64, -3e-4..3e-4_f64),
    ) {
        let density = document();
        let law = law(&density);
        let mut all = path.clone();
        all.extend([from, to, from, to, from]);
        let points = history(law.as_ref(), &all, 1.0);
        let n = points.len();
        let unit = density.slip_force() * density.phi_2;
        let (first, second) = (
            points[n - 3].dissipated - points[n - 5].dissipated,
            points[n - 1].dissipated - points[n - 3].dissipated,
        );
        prop_assert!(second >= -1e-14 * unit);
        // The first may open a loop on the backbone; the second repeats a closed one:
        // twice the half cycle of its half width.
        let expected = density.cycle_dissipation(0.5 * (to - from));
        prop_assert!((second - expected).abs() < 1e-12 * unit, "{} {}", second, expected);
        prop_assert!(first >= second - 1e-12 * unit);
        let mut reached = 0.0_f64;
        let mut last = 0.0;
        for point in &points {
            reached = reached.max(point.deformation.abs());
            let bound = density.backbone(reached).0;
            prop_assert!(point.force.abs() <= bound * (1.0 + 1e-14));
            prop_assert!(point.dissipated >= last - 1e-14 * unit);
            last = point.dissipated;
        }
    }
}
