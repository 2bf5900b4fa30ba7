//! Parameters of an Iwan density from measured dissipation.

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

/// A fitted density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DissipationFit {
    /// The density; its residual stiffness is that of the guess, because a spring
    /// does not dissipate.
    pub density: IwanDensity,
    /// Root mean square of the relative errors of the dissipation.
    pub relative_error: f64,
    /// Iterations used.
    pub iterations: usize,
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
) -> Result<DissipationFit, HysteresisError> {
    let problem = Problem::new(measured, guess.checked()?)?;
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
            return Ok(DissipationFit {
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
pub fn unknowns_of_fit(start: &LawParameters) -> usize {
    let free = |name: &str| start.values.get(name).copied();
    let lump = usize::from(free("slider_stiffness") != Some(0.0));
    3 + lump + usize::from(free("phi_1").is_some_and(|x| x > 0.0))
}

/// The best of the fits ([`fit_dissipation`]) that set out from these parameters of
/// `iwan_six_parameter`, and from several values of exponent and `phi_2` where they are not
/// given. `phi_1 = 0` and `slider_stiffness = 0` are kept.
///
/// # Errors
/// As [`fit_dissipation`], if no fit comes to a result.
pub fn fit_from_many(
    measured: &[(f64, f64)],
    start: &LawParameters,
    options: FitOptions,
) -> Result<DissipationFit, HysteresisError> {
    let fits = guesses(start, measured)
        .into_iter()
        .map(|guess| fit_dissipation(measured, guess, options));
    let better =
        |best: Result<DissipationFit, _>, fit: Result<DissipationFit, _>| match (&best, &fit) {
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
fn guesses(start: &LawParameters, measured: &[(f64, f64)]) -> Vec<IwanDensity> {
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
        residual_stiffness: get("residual_stiffness").unwrap_or(0.0),
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
    measured: &'a [(f64, f64)],
    guess: IwanDensity,
    unknowns: usize,
}

impl<'a> Problem<'a> {
    fn new(measured: &'a [(f64, f64)], guess: IwanDensity) -> Result<Self, HysteresisError> {
        let lump = usize::from(guess.slider_stiffness > 0.0);
        let unknowns = 2 + usize::from(guess.phi_1 > 0.0);
        let all = unknowns + 1 + lump;
        if measured.len() < all {
            return Err(HysteresisError::Fit {
                reason: format!("{} pairs for {all} unknowns", measured.len()),
                remedy: "measure more amplitudes, or guess phi_1 = 0 or no slider stiffness",
            });
        }
        if let Some((amplitude, energy)) = measured.iter().find(|(a, d)| !(*a > 0.0 && *d > 0.0)) {
            return Err(HysteresisError::Fit {
                reason: format!("the pair of {amplitude} m and {energy} J is not positive"),
                remedy: "leave out cycles without dissipation",
            });
        }
        Ok(Self {
            measured,
            guess,
            unknowns,
        })
    }

    /// ln(alpha+1), ln phi_2, and where free ln(beta/(1-beta)) of the guess.
    fn unknowns(&self) -> DVector<f64> {
        let g = &self.guess;
        let mut values = vec![(g.exponent + 1.0).ln(), g.phi_2.ln()];
        if g.phi_1 > 0.0 {
            values.push((g.phi_1 / (g.phi_2 - g.phi_1)).ln());
        }
        DVector::from_vec(values)
    }

    /// The density of these unknowns with the best R and K2.
    fn density(&self, unknowns: &DVector<f64>) -> IwanDensity {
        let exponent = unknowns[0].exp() - 1.0;
        let phi_2 = unknowns[1].exp();
        let phi_1 = if self.guess.phi_1 > 0.0 {
            phi_2 / (1.0 + (-unknowns[2]).exp())
        } else {
            0.0
        };
        // One N/m in the power density, then one in the lump.
        let powers = IwanDensity {
            density: phi_2.powf(-1.0 - exponent),
            exponent,
            phi_1,
            phi_2,
            slider_stiffness: 0.0,
            residual_stiffness: self.guess.residual_stiffness,
        };
        let lump = IwanDensity {
            density: 0.0,
            slider_stiffness: 1.0,
            ..powers
        };
        let (power_share, lump_share) = self.shares(&powers, &lump);
        IwanDensity {
            density: power_share * powers.density,
            slider_stiffness: lump_share,
            ..powers
        }
    }

    /// The least-squares multiples, not negative, of two densities.
    fn shares(&self, powers: &IwanDensity, lump: &IwanDensity) -> (f64, f64) {
        let (mut pp, mut pl, mut ll, mut p1, mut l1) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for (amplitude, energy) in self.measured {
            let p = powers.cycle_dissipation(*amplitude) / energy;
            let l = lump.cycle_dissipation(*amplitude) / energy;
            pp += p * p;
            pl += p * l;
            ll += l * l;
            p1 += p;
            l1 += l;
        }
        let alone = |inner: f64, square: f64| if square > 0.0 { inner / square } else { 0.0 };
        let determinant = pp * ll - pl * pl;
        if self.guess.slider_stiffness > 0.0 && determinant > 1e-14 * pp * ll {
            let shares = (
                (p1 * ll - l1 * pl) / determinant,
                (l1 * pp - p1 * pl) / determinant,
            );
            if shares.0 < 0.0 {
                return (0.0, alone(l1, ll));
            }
            if shares.1 >= 0.0 {
                return shares;
            }
        }
        (alone(p1, pp), 0.0)
    }

    /// Relative errors of the dissipation.
    fn errors(&self, unknowns: &DVector<f64>) -> DVector<f64> {
        let density = self.density(unknowns);
        let relative = self
            .measured
            .iter()
            .map(|(amplitude, energy)| density.cycle_dissipation(*amplitude) / energy - 1.0);
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
