//! Boore's point source: its formulas, and a thousand motions against theory.
use std::f64::consts::{PI, TAU};

use crate::ensemble::{G, Mean, SEEDS, grid, near, two_sided};
use pounding_ground_motion::generators::{Boore2003, Diminution};
use pounding_ground_motion::measures::Husid;
use pounding_ground_motion::spectra::{Evaluation, fourier_spectrum, response_spectrum};

fn source() -> Boore2003 {
    Boore2003::western_north_america(6.5, 2.0e4)
}

/// The numbers of the page: corner 0.186 Hz at M 6.5, 8 MPa, 3500 m/s; window one at a
/// fifth of its length, 0.05 at its end.
#[test]
fn a_point_source() {
    let source = source();
    near(source.corner_frequency(), 0.186, 3e-3);
    near(source.moment(), 10.0_f64.powf(18.8), 1e-12);
    let length = 2.0 * source.duration();
    near(source.window(0.2 * length), 1.0, 1e-12);
    near(source.window(length), 0.05, 1e-12);
    assert_eq!(source.window(1.001 * length), 0.0);
    // Beyond 40 km amplitudes fall as the root.
    let at = |r: f64| Boore2003 {
        quality: (1e12, 0.0),
        ..Boore2003::western_north_america(6.5, r)
    };
    near(
        at(4e4).fourier_amplitude(1.0) / at(1.6e5).fourier_amplitude(1.0),
        2.0,
        1e-6,
    );
    near(
        at(1e4).fourier_amplitude(1.0) / at(2e4).fourier_amplitude(1.0),
        2.0,
        1e-6,
    );
    let highest = Boore2003 {
        diminution: Diminution::HighestFrequency(10.0),
        ..source.clone()
    };
    let none = Boore2003 {
        diminution: Diminution::Kappa(0.0),
        ..source.clone()
    };
    near(
        highest.fourier_amplitude(10.0) / none.fourier_amplitude(10.0),
        0.5_f64.sqrt(),
        1e-12,
    );
    assert!(source.generate(grid(0.01, 5.0), 0).is_err());
}

/// Fourier amplitudes, intensity, duration and mean spectrum of a thousand motions: the
/// last against random vibration (Cartwright and Longuet-Higgins 1956; duration of the
/// oscillator by Boore and Joyner 1984, Bull. Seism. Soc. Am. 74, 2035).
#[test]
fn point_source_ensemble() {
    let source = source();
    let grid = grid(0.02, 40.0);
    let (mut arias, mut duration) = (Mean::default(), 0.0);
    // Below the corner frequency too, where the motion before the window makes the amplitudes fall like
    // the square of frequency.
    let bands = [0.05, 0.1, 0.3, 1.0, 3.0, 8.0];
    let mut squares = [Mean::default(); 6];
    let periods = [0.2, 0.5, 1.0];
    let mut spectra = [0.0; 3];
    for seed in 0..SEEDS {
        let motion = source.generate(grid, seed).unwrap().accelerogram;
        let husid = Husid::of(&motion, Evaluation::AtSamples).unwrap();
        arias.add(husid.arias_intensity());
        duration += husid.between(0.05, 0.95).unwrap().duration() / SEEDS as f64;
        let spectrum = fourier_spectrum(&motion, 2048);
        for (band, square) in bands.iter().zip(&mut squares) {
            let (mut found, mut exact) = (0.0, 0.0);
            for (f, a) in spectrum.frequencies.iter().zip(&spectrum.amplitudes) {
                if (f / band).ln().abs() < 0.1 {
                    found += a * a;
                    exact += source.fourier_amplitude(*f).powi(2);
                }
            }
            square.add(found / exact);
        }
        let found =
            response_spectrum(&motion, &periods, 0.05, Evaluation::PiecewiseLinear).unwrap();
        for (sum, a) in spectra.iter_mut().zip(&found.pseudo_acceleration) {
            *sum += a / SEEDS as f64;
        }
    }
    let nyquist = PI / 0.02;
    let square = |w: f64| source.fourier_amplitude(w / TAU).powi(2);
    let whole = two_sided(nyquist, square) / TAU;
    arias.meets(PI / (2.0 * G) * whole, 0.01);
    for square in squares {
        square.meets(1.0, 0.04);
    }
    // The energy of the window between 5 and 95 %.
    let length = 2.0 * source.duration();
    let energy: Vec<f64> = (0..=10_000)
        .scan(0.0, |sum, i| {
            *sum += source.window(length * f64::from(i) / 10_000.0).powi(2);
            Some(*sum)
        })
        .collect();
    let time = |part: f64| {
        energy
            .iter()
            .position(|e| *e >= part * energy[10_000])
            .unwrap() as f64
            / 10_000.0
            * length
    };
    near(duration, time(0.95) - time(0.05), 0.1);
    for (period, mean) in periods.iter().zip(spectra) {
        let exact = by_random_vibration(&source, *period);
        near(mean, exact, 0.15);
    }
}

/// The ground comes to rest, near where it was: of velocities and displacements some hundredths of
/// their peaks are left, for small near sources as for large far ones.
#[test]
fn the_ground_of_a_point_source_comes_to_rest() {
    for (magnitude, distance) in [(4.0, 5.0e2), (5.0, 1.0e4), (6.5, 2.0e4), (8.0, 1.0e5)] {
        let source = Boore2003::western_north_america(magnitude, distance);
        let corner = source.corner_frequency();
        let least = 2.0 * source.duration() + 2.0 / corner;
        for seed in 0..20 {
            let motion = source.generate(grid(0.01, least + 0.01), seed).unwrap();
            let acceleration = motion.accelerogram.samples();
            let (mut speed, mut place) = (0.0_f64, 0.0_f64);
            let (mut fastest, mut farthest) = (0.0_f64, 0.0_f64);
            for pair in acceleration.windows(2) {
                let next = speed + 0.005 * (pair[0] + pair[1]);
                place += 0.005 * (speed + next);
                speed = next;
                fastest = fastest.max(speed.abs());
                farthest = farthest.max(place.abs());
            }
            let left = (speed.abs() / fastest, place.abs() / farthest);
            assert!(
                left.0 < 0.02 && left.1 < 0.1,
                "M {magnitude}, seed {seed}: {left:?}"
            );
        }
        let short = grid(0.01, least - 0.1);
        assert!(source.generate(short, 0).is_err());
    }
}

fn by_random_vibration(source: &Boore2003, period: f64) -> f64 {
    let (w0, zeta) = (TAU / period, 0.05);
    let power = |w: f64| {
        let below = (w0 * w0 - w * w).powi(2) + (2.0 * zeta * w0 * w).powi(2);
        source.fourier_amplitude(w / TAU).powi(2) * w0.powi(4) / below
    };
    let moment = |k: i32| two_sided(PI / 0.02, |w| power(w) * w.powi(k)) / TAU;
    let (m0, m2, m4) = (moment(0), moment(2), moment(4));
    let strong = source.duration();
    let cube = (strong / period).powi(3);
    let lasting = strong + period / (TAU * zeta) * cube / (cube + 1.0 / 3.0);
    let extremes = (m4 / m2).sqrt() / PI * strong;
    let width = m2 / (m0 * m4).sqrt();
    // sqrt(2) int_0^inf (1 - (1 - width exp(-z^2))^N) dz.
    let factor: f64 = (0..6000)
        .map(|i| {
            1.0 - (1.0 - width * (-(0.001 * (f64::from(i) + 0.5)).powi(2)).exp()).powf(extremes)
        })
        .sum::<f64>()
        * 0.001
        * 2.0_f64.sqrt();
    factor * (m0 / lasting).sqrt()
}
