//! Parameters of the motion from an earthquake: Rezaeian and Der Kiureghian (2010),
//! regression with correlated errors.
//!
//! Coefficients as the SCEC Broadband Platform has them. The constant of the Arias
//! intensity, -2.2962, is the journal's -1.844 less ln(pi/2), for an intensity without
//! the factor pi/(2 g) in units of g.

use std::f64::consts::PI;

use crate::distributions::{argument_at, beta_quantile, gamma_quantile, normal_distribution};
use crate::error::{GroundMotionError, within};
use crate::generators::noise::Noise;
use crate::generators::rezaeian_der_kiureghian_2010::RezaeianDerKiureghian2010;
use crate::measures::GRAVITY;

const STEP: &str = "rezaeian_der_kiureghian_2010 scenario";
/// Draws after which no parameters are found.
const MOST_DRAWS: usize = 1000;

/// How the fault moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaultMechanism {
    /// Strike-slip.
    StrikeSlip,
    /// Reverse.
    Reverse,
}

/// An earthquake at a site.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RezaeianDerKiureghianScenario {
    /// Moment magnitude, 6 to 8.
    pub magnitude: f64,
    /// Rupture distance (m), 10 to 100 km.
    pub distance: f64,
    /// Mean shear-wave velocity of the upper 30 m (m/s), 600 and more.
    pub shear_velocity: f64,
    /// Mechanism.
    pub mechanism: FaultMechanism,
}

/// Constant, magnitude, mechanism, distance, velocity, sigma, tau.
const REGRESSION: [[f64; 7]; 6] = [
    [-2.2962, 2.9440, -0.0707, -1.3564, -0.2654, 0.5937, 0.2738],
    [-6.1946, 0.9703, -0.7034, 0.0087, -0.0007, 0.5688, 0.4574],
    [-5.0105, 0.6625, -0.3450, 0.0139, -0.0002, 0.4145, 0.5114],
    [2.2525, -0.2586, -0.0808, -0.0084, 0.0000, 0.7228, 0.6918],
    [-2.4886, 0.3440, 0.0441, 0.0026, -0.0001, 0.9529, 0.1286],
    [-0.2583, 0.1293, -0.4772, -0.0115, 0.0004, 0.7601, 0.6815],
];

/// Correlation of total errors, rows of the lower triangle.
const CORRELATION: [&[f64]; 6] = [
    &[1.0],
    &[-0.3555, 1.0],
    &[0.0066, 0.6729, 1.0],
    &[-0.1545, -0.1303, -0.2761, 1.0],
    &[0.1341, -0.1576, -0.1977, -0.2034, 1.0],
    &[-0.0078, -0.1958, -0.2188, 0.2814, -0.0137, 1.0],
];

/// Logarithm of the Arias intensity without pi/(2 g) in g^2 s: mean and deviation.
const LN_ARIAS: (f64, f64) = (-4.8255, 1.4318);
/// Density of the frequency rate below and above zero: rates of both exponentials.
const RATE_BELOW: f64 = 6.7729;
const RATE_ABOVE: f64 = 17.095;
const RATE_RANGE: (f64, f64) = (-2.0, 0.5);

/// Lower factor L of a matrix given by its lower triangle, L L^T.
fn cholesky(matrix: &[&[f64]; 6]) -> [[f64; 6]; 6] {
    let mut factor = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..=i {
            let before: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
            let rest = matrix[i][j] - before;
            factor[i][j] = if i == j {
                rest.sqrt()
            } else {
                rest / factor[j][j]
            };
        }
    }
    factor
}

/// Distribution function of the frequency rate (Hz/s): two exponentials that meet at
/// zero, cut at both ends.
fn rate_distribution(x: f64) -> f64 {
    let below =
        |x: f64| (libm::exp(RATE_BELOW * x) - libm::exp(RATE_BELOW * RATE_RANGE.0)) / RATE_BELOW;
    let above = |x: f64| (1.0 - libm::exp(-RATE_ABOVE * x)) / RATE_ABOVE;
    let whole = below(0.0) + above(RATE_RANGE.1);
    (below(x.min(0.0)) + above(x.max(0.0))) / whole
}

impl RezaeianDerKiureghianScenario {
    fn check(&self) -> Result<(), GroundMotionError> {
        within(STEP, "magnitude", self.magnitude, 6.0, 8.0)?;
        within(STEP, "distance", self.distance, 1.0e4, 1.0e5)?;
        within(
            STEP,
            "shear-wave velocity",
            self.shear_velocity,
            600.0,
            2500.0,
        )?;
        Ok(())
    }

    /// Medians of the six normal variables.
    fn medians(&self) -> [f64; 6] {
        let reverse = f64::from(u8::from(self.mechanism == FaultMechanism::Reverse));
        let kilometres = self.distance / 1000.0;
        let scaled = [
            self.magnitude / 7.0,
            reverse,
            libm::log(kilometres / 25.0),
            libm::log(self.shear_velocity / 750.0),
        ];
        let plain = [self.magnitude, reverse, kilometres, self.shear_velocity];
        let mut medians = [0.0; 6];
        for (i, row) in REGRESSION.iter().enumerate() {
            let terms = if i == 0 { &scaled } else { &plain };
            let slopes: f64 = row[1..5].iter().zip(terms).map(|(b, x)| b * x).sum();
            medians[i] = row[0] + slopes;
        }
        medians
    }

    /// Parameters of six normal variables.
    fn parameters(normal: [f64; 6], high_pass: f64) -> RezaeianDerKiureghian2010 {
        let part = normal.map(normal_distribution);
        let beta = |i: usize, a: f64, b: f64| beta_quantile(a, b, part[i]);
        let square = libm::exp(LN_ARIAS.0 + LN_ARIAS.1 * normal[0]) * GRAVITY * GRAVITY;
        RezaeianDerKiureghian2010 {
            arias_intensity: square * PI / (2.0 * GRAVITY),
            significant_duration: 5.0 + 40.0 * beta(1, 1.1314, 2.4474),
            middle_time: 0.5 + 39.5 * beta(2, 1.5792, 3.6405),
            middle_frequency: 1.4330 * gamma_quantile(4.0982, part[3]),
            frequency_rate: argument_at(part[4], RATE_RANGE.0, RATE_RANGE.1, rate_distribution),
            damping: 0.02 + 0.98 * beta(5, 1.4250, 5.7208),
            high_pass,
        }
    }

    /// Parameters of the median earthquake; `high_pass` is the corner (Hz).
    ///
    /// # Errors
    /// A magnitude, distance or velocity outside the data of the regression.
    pub fn median(&self, high_pass: f64) -> Result<RezaeianDerKiureghian2010, GroundMotionError> {
        self.check()?;
        Ok(Self::parameters(self.medians(), high_pass))
    }

    /// Random parameters of a seed, with correlated errors. Draws whose middle time is
    /// beyond their duration, or that have no envelope, are drawn again, as the authors
    /// do.
    ///
    /// # Errors
    /// As [`Self::median`], or no usable draw in a thousand.
    pub fn draw(
        &self,
        high_pass: f64,
        seed: u64,
    ) -> Result<RezaeianDerKiureghian2010, GroundMotionError> {
        self.check()?;
        let medians = self.medians();
        let factor = cholesky(&CORRELATION);
        let mut noise = Noise::new(seed);
        for _ in 0..MOST_DRAWS {
            let mut independent = [0.0; 6];
            independent.fill_with(|| noise.normal());
            let mut normal = medians;
            for i in 0..6 {
                let error: f64 = (0..=i).map(|k| factor[i][k] * independent[k]).sum();
                normal[i] += error * libm::hypot(REGRESSION[i][5], REGRESSION[i][6]);
            }
            let parameters = Self::parameters(normal, high_pass);
            if parameters.middle_time <= parameters.significant_duration && parameters.feasible() {
                return Ok(parameters);
            }
        }
        Err(GroundMotionError::NotPossible {
            step: STEP,
            reason: format!("{MOST_DRAWS} draws gave no usable parameters"),
            remedy: "give the parameters of the motion themselves",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor times itself is the correlation; the rates' law starts at 0, ends at 1
    /// and has its printed density at zero.
    #[test]
    fn tables() {
        let l = cholesky(&CORRELATION);
        for i in 0..6 {
            for j in 0..=i {
                let product: f64 = (0..6).map(|k| l[i][k] * l[j][k]).sum();
                assert!((product - CORRELATION[i][j]).abs() < 1e-14);
            }
        }
        assert_eq!(rate_distribution(-2.0), 0.0);
        assert!((rate_distribution(0.5) - 1.0).abs() < 1e-15);
        let density = (rate_distribution(1e-7) - rate_distribution(-1e-7)) / 2e-7;
        assert!((density / 4.8512 - 1.0).abs() < 2e-4, "{density}");
    }

    /// 7, 25 km, 750 m/s, strike-slip: Ia = 0.31 m/s (processing notes of the model).
    #[test]
    fn a_median_earthquake() {
        let scenario = RezaeianDerKiureghianScenario {
            magnitude: 7.0,
            distance: 2.5e4,
            shear_velocity: 750.0,
            mechanism: FaultMechanism::StrikeSlip,
        };
        let median = scenario.median(0.1).unwrap_or_else(|e| panic!("{e}"));
        assert!((median.arias_intensity - 0.31).abs() < 0.005);
        let far = RezaeianDerKiureghianScenario {
            distance: 2.0e5,
            ..scenario
        };
        assert!(far.median(0.1).is_err());
    }
}
