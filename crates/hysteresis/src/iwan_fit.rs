//! Parameters of an Iwan density from measured dissipation, or from a measured backbone.

use nalgebra::{DMatrix, DVector};

use crate::error::HysteresisError;
use crate::iwan::IwanDensity;
use crate::parameters::LawParameters;

/// Exponents from which a fit sets out where none is given.
const EXPONENTS: [f64; 3] = [-0.7, -0.3, 0.2];
/// Shares of the maximum amplitude from which `phi_2` sets out where none is given.
const SHARES: [f64; 3] = [0.1, 0.5, 2.0];

/// When the fit ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitOptions {
    /// Relative change of all parameters below which the fit has converged.
    pub tolerance: f64,
    /// Maximum number of iterations.
    pub iterations: usize,
}

impl Default for FitOptions {
    /// 1e-10 within 500 iterations.
    fn default() -> Self {
        Self {
            tolerance: 1e-10,
            iterations: 500,
        }
    }
}

/// What was measured over the deformation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeasuredCurve {
    /// Dissipation of a cycle (J) over its amplitude (m).
    Dissipation,
    /// Force (N) over the deformation (m) on first loading.
    Backbone,
}

impl MeasuredCurve {
    /// What a density gives at a deformation (m): J or N.
    #[must_use]
    pub fn value(self, density: &IwanDensity, deformation: f64) -> f64 {
        match self {
            Self::Dissipation => density.cycle_dissipation(deformation),
            Self::Backbone => density.backbone(deformation).0,
        }
    }

    /// Unit of what was measured.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Dissipation => "J",
            Self::Backbone => "N",
        }
    }
}

/// A fitted density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DensityFit {
    /// What it was fitted to.
    pub curve: MeasuredCurve,
    /// The density; fitted to dissipation, its residual stiffness is that of the guess,
    /// because a spring does not dissipate.
    pub density: IwanDensity,
    /// Root mean square of the relative errors.
    pub relative_error: f64,
    /// Iterations used.
    pub iterations: usize,
}

/// The density of sliders (N/m2) at the deformations (m) of a measured backbone, deformations and
/// forces (N) growing from above zero, by its curvature: `rho(phi) = -F''(phi)` (Iwan, Journal of Applied
/// Mechanics 33 (1966) 893), here by second differences over three neighbours, the first of them
/// zero. The last point has none. A backbone that is measured with noise has a density of noise:
/// differences of nearby forces are divided by their distance squared.
///
/// # Errors
/// [`HysteresisError::Fit`]: fewer than two points, or deformations that do not grow.
pub fn density_of_backbone(measured: &[(f64, f64)]) -> Result<Vec<(f64, f64)>, HysteresisError> {
    let points: Vec<(f64, f64)> = std::iter::once((0.0, 0.0))
        .chain(measured.iter().copied())
        .collect();
    if points.len() < 3 || !points.windows(2).all(|w| w[1].0 > w[0].0) {
        return Err(HysteresisError::Fit {
            reason: "the deformations of a backbone grow from above zero, over two points or more"
                .to_owned(),
            remedy: "sort the first loading by deformation, and leave unloading out",
        });
    }
    let slope = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
    let curvature = |w: &[(f64, f64)]| {
        let change = slope(w[1], w[2]) - slope(w[0], w[1]);
        (w[1].0, -2.0 * change / (w[2].0 - w[0].0))
    };
    Ok(points.windows(3).map(curvature).collect())
}

/// Fits a density to pairs of amplitude (m) and dissipation of a cycle (J), both
/// positive, by least squares of the relative errors with the method of Levenberg
/// (1944) and Marquardt (1963), from a guess. Where the guess has `phi_1 = 0` or no
/// slider stiffness, the fit keeps it so.
///
/// The dissipation is linear in the density R and in the slider stiffness K2; for
/// each exponent, `phi_1` and `phi_2` the best two that are not negative are solved
/// for (variable projection, Golub and Pereyra 1973), so their guesses do not matter.
/// The other unknowns are logarithms, so that every iterate is a valid density;
/// derivatives are central differences, exact to about 1e-9.
///
/// # Errors
/// [`HysteresisError::Fit`]: fewer pairs than unknowns, a pair that is not positive,
/// or no convergence; [`HysteresisError::Inconsistent`]: an invalid guess.
pub fn fit_dissipation(
    measured: &[(f64, f64)],
    guess: IwanDensity,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    fit(MeasuredCurve::Dissipation, measured, guess, options)
}

/// Fits a density to pairs of deformation (m) and force (N) on first loading, both positive, as
/// [`fit_dissipation`] does to cycles. The residual stiffness is fitted too, unless the guess has
/// none.
///
/// # Errors
/// As [`fit_dissipation`].
pub fn fit_backbone(
    measured: &[(f64, f64)],
    guess: IwanDensity,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    fit(MeasuredCurve::Backbone, measured, guess, options)
}

fn fit(
    curve: MeasuredCurve,
    measured: &[(f64, f64)],
    guess: IwanDensity,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    let problem = Problem::new(curve, measured, guess.checked()?)?;
    let mut unknowns = problem.unknowns();
    let mut errors = problem.errors(&unknowns);
    let mut damping = 1e-3;
    for iteration in 1..=options.iterations {
        let slopes = problem.slopes(&unknowns);
        let (step, accepted) = loop {
            let step = damped_step(&slopes, &errors, damping)?;
            let trial = &unknowns + &step;
            let trial_errors = problem.errors(&trial);
            if trial_errors.norm_squared() <= errors.norm_squared() {
                (unknowns, errors) = (trial, trial_errors);
                break (step, true);
            }
            damping *= 4.0;
            if damping > 1e12 {
                break (step, false);
            }
        };
        damping = (damping / 9.0).max(1e-14);
        if step.amax() < options.tolerance || !accepted {
            return Ok(DensityFit {
                curve,
                density: problem.density(&unknowns),
                relative_error: (errors.norm_squared() / measured.len() as f64).sqrt(),
                iterations: iteration,
            });
        }
    }
    Err(HysteresisError::Fit {
        reason: format!("no convergence in {} iterations", options.iterations),
        remedy: "start from a nearer guess, or cover micro-slip and full slip with the measured amplitudes",
    })
}

/// Number of unknowns of a fit that sets out from these parameters of `iwan_six_parameter`:
/// density, exponent and `phi_2` always are, and the others unless they are given as nothing.
#[must_use]
pub fn unknowns_of_fit(curve: MeasuredCurve, start: &LawParameters) -> usize {
    let free = |name: &str| start.values.get(name).copied();
    let lump = usize::from(free("slider_stiffness") != Some(0.0));
    let is_backbone = curve == MeasuredCurve::Backbone;
    let residual = usize::from(is_backbone && free("residual_stiffness") != Some(0.0));
    3 + lump + residual + usize::from(free("phi_1").is_some_and(|x| x > 0.0))
}

/// The best of the fits ([`fit_dissipation`], [`fit_backbone`]) that set out from these parameters of
/// `iwan_six_parameter`, and from several values of exponent and `phi_2` where they are not
/// given. `phi_1 = 0`, `slider_stiffness = 0` and, of a backbone, `residual_stiffness = 0` are kept.
///
/// # Errors
/// As [`fit_dissipation`], if no fit comes to a result.
pub fn fit_from_many(
    curve: MeasuredCurve,
    measured: &[(f64, f64)],
    start: &LawParameters,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    let fits = guesses(curve, start, measured)
        .into_iter()
        .map(|guess| fit(curve, measured, guess, options));
    let better = |best: Result<DensityFit, _>, fit: Result<DensityFit, _>| match (&best, &fit) {
        (Ok(b), Ok(f)) if f.relative_error < b.relative_error => fit,
        (Ok(_), _) => best,
        (Err(_), _) => fit,
    };
    let none = HysteresisError::Fit {
        reason: "no start".to_owned(),
        remedy: "give a start with --set",
    };
    fits.fold(Err(none), better)
}

/// Where the fit sets out: every combination of what is not given.
fn guesses(
    curve: MeasuredCurve,
    start: &LawParameters,
    measured: &[(f64, f64)],
) -> Vec<IwanDensity> {
    // A spring that does not dissipate is fitted to a backbone alone.
    let residual = match curve {
        MeasuredCurve::Dissipation => 0.0,
        MeasuredCurve::Backbone => 1.0,
    };
    let get = |name: &str| start.values.get(name).copied();
    let maximum = measured.iter().map(|(a, _)| *a).fold(0.0, f64::max);
    let exponents = get("exponent").map_or_else(|| EXPONENTS.to_vec(), |e| vec![e]);
    let ends = get("phi_2").map_or_else(
        || SHARES.iter().map(|s| s * maximum).collect(),
        |end| vec![end],
    );
    let guess = |exponent, phi_2| IwanDensity {
        density: get("density").unwrap_or(1.0),
        exponent,
        phi_1: get("phi_1").unwrap_or(0.0),
        phi_2,
        slider_stiffness: get("slider_stiffness").unwrap_or(1.0),
        residual_stiffness: get("residual_stiffness").unwrap_or(residual),
    };
    let all = exponents.iter();
    all.flat_map(|&exponent| ends.iter().map(move |&phi_2| (exponent, phi_2)))
        .map(|(exponent, phi_2)| guess(exponent, phi_2))
        .collect()
}

/// Solves `min |J s + e|^2 + damping |D s|^2` with D the lengths of the columns of J.
fn damped_step(
    slopes: &DMatrix<f64>,
    errors: &DVector<f64>,
    damping: f64,
) -> Result<DVector<f64>, HysteresisError> {
    let (rows, columns) = slopes.shape();
    let mut matrix = DMatrix::zeros(rows + columns, columns);
    let mut right = DVector::zeros(rows + columns);
    matrix.view_mut((0, 0), (rows, columns)).copy_from(slopes);
    for j in 0..columns {
        let length = slopes.column(j).norm().max(f64::MIN_POSITIVE);
        matrix[(rows + j, j)] = damping.sqrt() * length;
    }
    right.rows_mut(0, rows).copy_from(&(-errors));
    matrix
        .svd(true, true)
        .solve(&right, f64::EPSILON)
        .map_err(|reason| HysteresisError::Fit {
            reason: reason.to_owned(),
            remedy: "check the measured pairs",
        })
}

/// The data and how many unknowns are not solved for directly.
struct Problem<'a> {
    curve: MeasuredCurve,
    measured: &'a [(f64, f64)],
    guess: IwanDensity,
    unknowns: usize,
}

impl<'a> Problem<'a> {
    fn new(
        curve: MeasuredCurve,
        measured: &'a [(f64, f64)],
        guess: IwanDensity,
    ) -> Result<Self, HysteresisError> {
        let lump = usize::from(guess.slider_stiffness > 0.0);
        let is_backbone = curve == MeasuredCurve::Backbone;
        let residual = usize::from(is_backbone && guess.residual_stiffness > 0.0);
        let unknowns = 2 + usize::from(guess.phi_1 > 0.0);
        let all = unknowns + 1 + lump + residual;
        if measured.len() < all {
            return Err(HysteresisError::Fit {
                reason: format!("{} pairs for {all} unknowns", measured.len()),
                remedy: "measure more amplitudes, or guess phi_1 = 0 or no slider stiffness",
            });
        }
        if let Some((reach, value)) = measured.iter().find(|(a, d)| !(*a > 0.0 && *d > 0.0)) {
            let unit = curve.unit();
            return Err(HysteresisError::Fit {
                reason: format!("the pair of {reach} m and {value} {unit} is not positive"),
                remedy: "leave out what is zero: cycles without dissipation, the start of a backbone",
            });
        }
        Ok(Self {
            curve,
            measured,
            guess,
            unknowns,
        })
    }

    /// ln(alpha+1), ln phi_2, and where free ln(beta/(1-beta)) of the guess.
    fn unknowns(&self) -> DVector<f64> {
        let g = &self.guess;
        let mut values = vec![libm::log(g.exponent + 1.0), libm::log(g.phi_2)];
        if g.phi_1 > 0.0 {
            values.push(libm::log(g.phi_1 / (g.phi_2 - g.phi_1)));
        }
        DVector::from_vec(values)
    }

    /// The density of these unknowns with the best R and K2.
    fn density(&self, unknowns: &DVector<f64>) -> IwanDensity {
        let exponent = libm::exp(unknowns[0]) - 1.0;
        let phi_2 = libm::exp(unknowns[1]);
        let phi_1 = if self.guess.phi_1 > 0.0 {
            phi_2 / (1.0 + libm::exp(-unknowns[2]))
        } else {
            0.0
        };
        // One N/m in the power density, in the lump, in the residual spring.
        let is_backbone = self.curve == MeasuredCurve::Backbone;
        let powers = IwanDensity {
            density: libm::pow(phi_2, -1.0 - exponent),
            exponent,
            phi_1,
            phi_2,
            slider_stiffness: 0.0,
            residual_stiffness: match is_backbone {
                true => 0.0,
                false => self.guess.residual_stiffness,
            },
        };
        let lump = IwanDensity {
            density: 0.0,
            slider_stiffness: 1.0,
            ..powers
        };
        let residual = IwanDensity {
            density: 0.0,
            residual_stiffness: 1.0,
            ..powers
        };
        let is_free = [
            true,
            self.guess.slider_stiffness > 0.0,
            is_backbone && self.guess.residual_stiffness > 0.0,
        ];
        let shares = self.shares(&[powers, lump, residual], is_free);
        IwanDensity {
            density: shares[0] * powers.density,
            slider_stiffness: shares[1],
            residual_stiffness: powers.residual_stiffness + shares[2],
            ..powers
        }
    }

    /// The least-squares multiples, not negative, of three densities, of which some are free: the
    /// best of those with any of them left out.
    fn shares(&self, densities: &[IwanDensity; 3], is_free: [bool; 3]) -> [f64; 3] {
        let rows = self.measured.len();
        let relative = |j: usize, i: usize| {
            let (reach, value) = self.measured[i];
            self.curve.value(&densities[j], reach) / value
        };
        let columns: [DVector<f64>; 3] =
            std::array::from_fn(|j| DVector::from_fn(rows, |i, _| relative(j, i)));
        // A step far out may overflow: it is not taken.
        let free = columns.iter().zip(is_free).filter(|(_, free)| *free);
        if free.flat_map(|(c, _)| c.iter()).any(|x| !x.is_finite()) {
            return [f64::NAN; 3];
        }
        let ones = DVector::from_element(rows, 1.0);
        let mut best = ([0.0; 3], f64::INFINITY);
        for subset in 1..8_usize {
            let chosen: Vec<usize> = (0..3).filter(|j| subset >> j & 1 == 1).collect();
            if chosen.iter().any(|j| !is_free[*j]) {
                continue;
            }
            let chosen_columns: Vec<_> = chosen.iter().map(|j| columns[*j].clone()).collect();
            let matrix = DMatrix::from_columns(&chosen_columns);
            let Ok(found) = matrix.clone().svd(true, true).solve(&ones, 1e-12) else {
                continue;
            };
            let miss = (&matrix * &found - &ones).norm_squared();
            if found.iter().all(|share| *share >= 0.0) && miss < best.1 {
                let mut shares = [0.0; 3];
                for (j, share) in chosen.iter().zip(found.iter()) {
                    shares[*j] = *share;
                }
                best = (shares, miss);
            }
        }
        best.0
    }

    /// Relative errors.
    fn errors(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let density = self.density(unknowns);
        let relative = self
            .measured
            .iter()
            .map(|(reach, value)| self.curve.value(&density, *reach) / value - 1.0);
        DVector::from_iterator(self.measured.len(), relative)
    }

    /// Derivatives of the errors, a column an unknown.
    fn slopes(&self, unknowns: &DVector<f64>) -> DMatrix<f64> {
        let width = 1e-5;
        let mut slopes = DMatrix::zeros(self.measured.len(), self.unknowns);
        for j in 0..self.unknowns {
            let mut shifted = unknowns.clone();
            shifted[j] += width;
            let above = self.errors(&shifted);
            shifted[j] -= 2.0 * width;
            let below = self.errors(&shifted);
            slopes.set_column(j, &((above - below) / (2.0 * width)));
        }
        slopes
    }
}
