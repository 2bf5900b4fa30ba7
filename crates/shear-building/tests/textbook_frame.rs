//! Rung 2 of the ladder: the five-storey frame of Chopra, Dynamics of Structures,
//! example 13.2.6, by exact modal superposition.
//!
//! Origin of the numbers: the project's exact modal solution, which agrees with
//! Chopra's printed values (6.847 in, 73.278 kip) to 0.2 %. They belong to the
//! reading in which the ground starts from zero and the first tabulated value is at
//! t = 0.02 s, and to g = 9.81 m/s2; with that value at t = 0 and g = 9.80665 m/s2
//! the roof reaches 0.173896 m. Responses are sampled each 0.02 s.
use pounding_shear_building::{Damping, ShearBuilding};

fn frame() -> ShearBuilding {
    ShearBuilding::new(
        "frame".into(),
        vec![45e3; 5],
        vec![5.482e6; 5],
        vec![4.0; 5],
        Damping::Modal { ratios: vec![0.05] },
    )
    .unwrap()
}

fn record() -> Vec<f64> {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../ground_motions/el_centro_1940_ns.csv"
    );
    let text = std::fs::read_to_string(path).unwrap();
    let values = text
        .lines()
        .filter_map(|l| l.split(',').nth(1)?.parse::<f64>().ok())
        .map(|a| a * 9.81);
    std::iter::once(0.0).chain(values).collect()
}

/// One mode over a sample with linear acceleration, by the closed form of the
/// damped oscillator about its particular solution.
fn advance(q: [f64; 2], w: f64, z: f64, load: [f64; 2], h: f64) -> [f64; 2] {
    let slope = (load[1] - load[0]) / h;
    let particular = |t: f64| (load[0] + slope * t) / (w * w) - 2.0 * z * slope / w.powi(3);
    let rate = slope / (w * w);
    let wd = w * (1.0 - z * z).sqrt();
    let (a, b) = (q[0] - particular(0.0), q[1] - rate);
    let c = (b + z * w * a) / wd;
    let (decay, sin, cos) = ((-z * w * h).exp(), (wd * h).sin(), (wd * h).cos());
    let x = decay * (a * cos + c * sin);
    let v = decay * ((c * wd - z * w * a) * cos - (a * wd + z * w * c) * sin);
    [x + particular(h), v + rate]
}

#[test]
fn periods() {
    for (period, expected) in frame()
        .modes()
        .period
        .iter()
        .zip([2.00003, 0.68518, 0.43465, 0.33834, 0.29665])
    {
        assert!((period - expected).abs() < 5e-6, "{period}");
    }
}

#[test]
fn el_centro_response() {
    let frame = frame();
    let modes = frame.modes();
    let record = record();
    assert_eq!(record.len(), 1560);
    let mut q = [[0.0; 2]; 5];
    let (mut roof, mut base, mut top, mut moment) = ((0.0_f64, 0.0), 0.0_f64, 0.0_f64, 0.0_f64);
    for (i, pair) in record.windows(2).enumerate() {
        for (j, state) in q.iter_mut().enumerate() {
            let load = [
                -modes.participation_factor[j] * pair[0],
                -modes.participation_factor[j] * pair[1],
            ];
            *state = advance(*state, modes.circular_frequency[j], 0.05, load, 0.02);
        }
        let u: Vec<f64> = (0..5)
            .map(|s| (0..5).map(|j| modes.shape[(s, j)] * q[j][0]).sum())
            .collect();
        if u[4].abs() > roof.0 {
            roof = (u[4].abs(), (i + 1) as f64 * 0.02);
        }
        let shear = |s: usize| 5.482e6 * (u[s] - if s > 0 { u[s - 1] } else { 0.0 });
        base = base.max(shear(0).abs());
        top = top.max(shear(4).abs());
        moment = moment.max((0..5).map(|s| 4.0 * shear(s)).sum::<f64>().abs());
    }
    assert!((roof.0 - 0.173950).abs() < 5e-7, "{}", roof.0);
    assert!((roof.1 - 12.08).abs() < 1e-9, "{}", roof.1);
    assert!((base - 322_827.0).abs() < 1.0, "{base}");
    assert!((top - 155.4e3).abs() < 50.0, "{top}");
    assert!((moment - 3.8144e6).abs() < 50.0, "{moment}");
}
