//! Discrete Fourier transforms of real samples.
//!
//! Lengths of powers of two go by passes of radix four and two that leave the order as it is (Stockham: Cochran and others
//! 1967, IEEE Trans. Audio Electroacoust. 15 (2) 45), all others as a convolution of such a length (Bluestein 1970, IEEE
//! Trans. Audio Electroacoust. 18 (4) 451). `rustfft` takes its sines from the C library, of which that of glibc rounds
//! otherwise on a processor with fused multiply-add: motions that were resampled or generated had other last bits there.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use num_complex::Complex64;

/// Coefficients `sum a_j exp(-2 pi i j k/n)`, k = 0..=n/2, of `length` samples: those
/// given and zeros after them.
pub(crate) fn transform(samples: &[f64], length: usize) -> Vec<Complex64> {
    let length = length.max(samples.len());
    let mut values: Vec<_> = samples.iter().map(|a| Complex64::from(*a)).collect();
    values.resize(length, Complex64::ZERO);
    let mut coefficients = forward(values);
    coefficients.truncate(length / 2 + 1);
    coefficients
}

/// The `length` samples of such coefficients; what is imaginary at both ends of the
/// band is passed over.
pub(crate) fn inverse_transform(mut coefficients: Vec<Complex64>, length: usize) -> Vec<f64> {
    coefficients.resize(length / 2 + 1, Complex64::ZERO);
    coefficients[0].im = 0.0;
    if length.is_multiple_of(2) {
        coefficients[length / 2].im = 0.0;
    }
    // Samples are real: the inverse is the forward transform of conjugates, and what is above half the sampling rate the
    // conjugate of what is below.
    let mut values: Vec<_> = coefficients.iter().map(Complex64::conj).collect();
    values.resize(length, Complex64::ZERO);
    for k in length / 2 + 1..length {
        values[k] = coefficients[length - k];
    }
    let samples = forward(values);
    samples.iter().map(|a| a.re / length as f64).collect()
}

/// Coefficients `sum a_j exp(-2 pi i j k/n)` for all k.
fn forward(values: Vec<Complex64>) -> Vec<Complex64> {
    if values.len() <= 1 {
        values
    } else if values.len().is_power_of_two() {
        let roots = roots_of_unity(values.len());
        by_passes(values, &roots)
    } else {
        as_convolution(&values)
    }
}

/// `exp(-2 pi i k/n)`, k = 0..n, from angles up to an eighth of a turn, for which sine and cosine are most exact.
fn roots_of_unity(n: usize) -> Vec<Complex64> {
    (0..n).map(|k| root_of_unity(k, n)).collect()
}

/// `exp(-2 pi i k/n)` for k below n.
fn root_of_unity(k: usize, n: usize) -> Complex64 {
    // Eighths of a turn, and what is left of the last one, from that of its ends which is a multiple of a quarter.
    let (eighth, rest) = (8 * k / n, 8 * k % n);
    let from_quarter = if eighth.is_multiple_of(2) {
        rest
    } else {
        n - rest
    };
    let (sine, cosine) = if from_quarter == n {
        (FRAC_1_SQRT_2, FRAC_1_SQRT_2)
    } else {
        libm::sincos(TAU / 8.0 * (from_quarter as f64 / n as f64))
    };
    let (re, im) = match eighth {
        0 => (cosine, -sine),
        1 => (sine, -cosine),
        2 => (-sine, -cosine),
        3 => (-cosine, -sine),
        4 => (-cosine, sine),
        5 => (-sine, cosine),
        6 => (sine, cosine),
        _ => (cosine, sine),
    };
    Complex64::new(re, im)
}

/// The transform of a power of two of values, with the roots of unity of their number.
fn by_passes(mut values: Vec<Complex64>, roots: &[Complex64]) -> Vec<Complex64> {
    let mut passed = vec![Complex64::ZERO; values.len()];
    // Transforms of `length` values each, of which `stride` stand side by side.
    let (mut length, mut stride) = (values.len(), 1);
    while length >= 4 {
        pass_of_four(&values, &mut passed, stride, roots);
        std::mem::swap(&mut values, &mut passed);
        length /= 4;
        stride *= 4;
    }
    if length == 2 {
        let (first, second) = values.split_at(stride);
        let (sum, difference) = passed.split_at_mut(stride);
        for q in 0..stride {
            sum[q] = first[q] + second[q];
            difference[q] = first[q] - second[q];
        }
        std::mem::swap(&mut values, &mut passed);
    }
    values
}

/// One pass of radix four.
fn pass_of_four(
    values: &[Complex64],
    passed: &mut [Complex64],
    stride: usize,
    roots: &[Complex64],
) {
    let quarter = values.len() / 4;
    let (a, rest) = values.split_at(quarter);
    let (b, rest) = rest.split_at(quarter);
    let (c, d) = rest.split_at(quarter);
    for (p, passed) in passed.chunks_exact_mut(4 * stride).enumerate() {
        let [w1, w2, w3] = [1, 2, 3].map(|n| roots[n * p * stride]);
        let (s0, rest) = passed.split_at_mut(stride);
        let (s1, rest) = rest.split_at_mut(stride);
        let (s2, s3) = rest.split_at_mut(stride);
        let here = p * stride..(p + 1) * stride;
        let (a, b, c, d) = (
            &a[here.clone()],
            &b[here.clone()],
            &c[here.clone()],
            &d[here],
        );
        for q in 0..stride {
            let (even, odd) = (a[q] + c[q], b[q] + d[q]);
            let (apart, across) = (a[q] - c[q], b[q] - d[q]);
            // i times it.
            let across = Complex64::new(-across.im, across.re);
            s0[q] = even + odd;
            s1[q] = w1 * (apart - across);
            s2[q] = w2 * (even - odd);
            s3[q] = w3 * (apart + across);
        }
    }
}

/// The transform as a convolution: `jk = (j^2 + k^2 - (k - j)^2)/2`.
fn as_convolution(values: &[Complex64]) -> Vec<Complex64> {
    let n = values.len();
    // exp(-i pi j^2/n), whose squares are taken off whole turns before they are rounded.
    let chirp: Vec<Complex64> = (0..n)
        .map(|j| ((j as u128 * j as u128) % (2 * n as u128)) as usize)
        .map(|square| root_of_unity(square, 2 * n))
        .collect();
    let length = (2 * n - 1).next_power_of_two();
    let roots = roots_of_unity(length);
    let mut kernel = vec![Complex64::ZERO; length];
    for (j, c) in chirp.iter().enumerate() {
        kernel[j] = c.conj();
        kernel[(length - j) % length] = c.conj();
    }
    let mut product: Vec<_> = values.iter().zip(&chirp).map(|(a, c)| a * c).collect();
    product.resize(length, Complex64::ZERO);
    let product = by_passes(product, &roots);
    let kernel = by_passes(kernel, &roots);
    // Back by the forward transform of conjugates.
    let product = product.iter().zip(&kernel).map(|(a, b)| (a * b).conj());
    let convolved = by_passes(product.collect(), &roots);
    let scaled = |(a, c): (&Complex64, &Complex64)| a.conj() * c / length as f64;
    convolved.iter().zip(&chirp).map(scaled).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples without a pattern, from the fractional parts of multiples of the golden ratio.
    fn samples(count: usize) -> Vec<f64> {
        let golden = 0.618_033_988_749_895;
        let part = |k: usize| (golden * (k * k + 1) as f64).fract() - 0.5;
        (0..count).map(part).collect()
    }

    /// The sum itself, with angles off whole turns before they are rounded, added up in pairs.
    fn directly(samples: &[f64], length: usize, k: usize) -> Complex64 {
        fn sum(terms: &[Complex64]) -> Complex64 {
            match terms {
                [] => Complex64::ZERO,
                [one] => *one,
                many => {
                    let (left, right) = many.split_at(many.len() / 2);
                    sum(left) + sum(right)
                }
            }
        }
        let term = |(j, a): (usize, &f64)| {
            let angle = -TAU * (((j * k) % length) as f64 / length as f64);
            Complex64::new(a * libm::cos(angle), a * libm::sin(angle))
        };
        sum(&samples.iter().enumerate().map(term).collect::<Vec<_>>())
    }

    #[test]
    fn coefficients_are_the_sums_that_define_them() {
        let lengths = (1..70).chain([97, 100, 128, 243, 256, 500, 512, 1009, 1024, 2047, 4000]);
        for length in lengths {
            let given = samples(length - length / 3);
            let scale = given.iter().map(|a| a * a).sum::<f64>().sqrt();
            let found = transform(&given, length);
            assert_eq!(found.len(), length / 2 + 1);
            for (k, found) in found.iter().enumerate() {
                let error = (found - directly(&given, length, k)).norm_sqr().sqrt();
                assert!(
                    error < 1.0e-14 * scale,
                    "{length}, {k}: {error:e} of {scale}"
                );
            }
        }
    }

    #[test]
    fn what_is_transformed_comes_back() {
        for length in [1, 2, 3, 4, 5, 8, 30, 64, 1000, 1021, 1 << 14, 100_000] {
            let given = samples(length);
            let back = inverse_transform(transform(&given, length), length);
            assert_eq!(back.len(), length);
            for (a, b) in given.iter().zip(&back) {
                assert!((a - b).abs() < 2.0e-15, "{length}: {a} became {b}");
            }
        }
    }

    /// Of squares and symmetry: no root is further from the unit circle than its rounding, and opposite ones are opposite.
    #[test]
    fn roots_of_unity_are_symmetric() {
        for n in [1, 2, 3, 8, 12, 64, 1000] {
            let roots = roots_of_unity(n);
            for (k, root) in roots.iter().enumerate() {
                assert!((root.norm_sqr() - 1.0).abs() < 4.0e-16, "{k}/{n}: {root}");
                assert_eq!(root.conj(), roots[(n - k) % n], "{k}/{n}");
            }
        }
    }
}
