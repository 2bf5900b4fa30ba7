//! Parameters of an Iwan density from measured dissipation, or from a measured backbone.

use nalgebra::{DMatrix, DVector};

use crate::error::HysteresisError;
use pounding_catalogue::numbers::significant;

use super::density::{IwanDensity, LAW};
use super::fall::Fall;
use super::measured_curve::MeasuredCurve;
use crate::parameters::LawParameters;

/// Exponents from which a fit sets out where none is given.
const EXPONENTS: [f64; 3] = [-0.7, -0.3, 0.2];
/// Shares of the maximum amplitude from which `phi_2` sets out where none is given.
const SHARES: [f64; 3] = [0.1, 0.5, 2.0];
/// Places of `phi_2` from the smallest amplitude to twice the largest, and shares of it for `phi_1`, among
/// which more starts are looked for.
const PLACES: u32 = 8;
const SHARES_OF_END: [f64; 3] = [0.05, 0.2, 0.5];
/// The best of these are starts as well.
const MORE_STARTS: usize = 6;
/// Least exponent of a fit above -1, where the density becomes infinite.
const LEAST_ABOVE: f64 = 1.0e-3;
/// Part of the stiffness that slips within data that are no straight line, at least.
const NOTHING_SLIPS: f64 = 1.0e-6;
/// Relative error below which a fit is exact.
const EXACT: f64 = 1.0e-9;
/// Distances between neighbouring data by which `phi_2` of the best fit is moved either way: a lump of sliders
/// has its kink there, and fits stop where a kink would pass one of the data.
const MOVES: [f64; 4] = [-1.5, -0.5, 0.5, 1.5];
/// Times at most that this leads to a better fit.
const MOST_MOVES: usize = 4;
/// Root mean square of the relative errors above which the law does not follow the data.
const MISFIT: f64 = 0.05;

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

/// Parameters that a fit holds at the value that is given, beside `phi_1 = 0`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HeldParameters {
    /// Exponent of the density.
    pub exponent: bool,
    /// Upper end of the density.
    pub phi_2: bool,
    /// Stiffness of the lump of sliders at `phi_2`.
    pub slider_stiffness: bool,
    /// Stiffness that never slips. A fit to dissipation always holds it.
    pub residual_stiffness: bool,
}

impl HeldParameters {
    /// Those that are given: all but `phi_1`, which is where the fit sets out, or zero.
    fn given(start: &LawParameters) -> Result<Self, HysteresisError> {
        let is_given = |name: &str| start.values.contains_key(name);
        if is_given("density") {
            return Err(HysteresisError::Measured {
                reason: format!(
                    "`density` of law {LAW} is fitted, and a value that is given cannot be held"
                ),
                remedy: "leave density out; exponent, phi_2, slider_stiffness and residual_stiffness can be held",
            });
        }
        Ok(Self {
            exponent: is_given("exponent"),
            phi_2: is_given("phi_2"),
            slider_stiffness: is_given("slider_stiffness"),
            residual_stiffness: is_given("residual_stiffness"),
        })
    }

    /// Those that a guess has none of.
    fn nothing(guess: &IwanDensity) -> Self {
        Self {
            slider_stiffness: guess.slider_stiffness == 0.0,
            residual_stiffness: guess.residual_stiffness == 0.0,
            ..Self::default()
        }
    }

    /// With what a curve knows nothing of: a spring does not dissipate.
    fn on(self, curve: MeasuredCurve) -> Self {
        Self {
            residual_stiffness: self.residual_stiffness || curve == MeasuredCurve::Dissipation,
            ..self
        }
    }

    /// Number of unknowns of a fit, the density among them.
    fn unknowns(self, fits_phi_1: bool) -> usize {
        let held = [
            self.exponent,
            self.phi_2,
            self.slider_stiffness,
            self.residual_stiffness,
            !fits_phi_1,
        ];
        1 + held.into_iter().filter(|held| !held).count()
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
    /// What was not fitted.
    pub held: HeldParameters,
    /// Root mean square of the relative errors.
    pub relative_error: f64,
    /// Iterations used.
    pub iterations: usize,
}

/// What to know of a fit before its parameters are used.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FitDoubt {
    /// The law departs from the data by more than 5 %.
    Misfit {
        /// Root mean square of the relative errors.
        relative_error: f64,
    },
    /// A parameter that lies where nothing was measured, or next to nothing: beyond `phi_2` it takes two of
    /// the data to tell what slips there from what never does, and before it two to tell where that is.
    Outside {
        /// `phi_1` or `phi_2`.
        parameter: &'static str,
        /// Its value (m).
        value: f64,
        /// Least and largest amplitude or deformation of the data (m).
        measured: [f64; 2],
    },
    /// A `phi_2` that was given, beyond which fewer than two of the data lie: a lump of sliders there and what never
    /// slips act alike.
    OneStiffness {
        /// `phi_2` (m).
        phi_2: f64,
    },
    /// A straight line, along which nothing slips.
    Straight,
    /// A lump of sliders alone, beside which a density has next to no part.
    LumpAlone,
    /// An exponent that ran to its limit of -1.
    ExponentAtLimit {
        /// The exponent.
        exponent: f64,
    },
}

impl std::fmt::Display for FitDoubt {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let millimetres = |metres: f64| significant(1.0e3 * metres);
        match self {
            Self::Misfit { relative_error } => write!(
                f,
                "the law does not follow the data: the root mean square of the relative errors is {} %, above {} %",
                significant(100.0 * relative_error),
                significant(100.0 * MISFIT)
            ),
            Self::Outside {
                parameter,
                value,
                measured: [least, largest],
            } => {
                let stiffnesses = match *parameter {
                    "phi_2" => {
                        ", nor how much stiffness slips there (slider_stiffness) and how much never does (residual_stiffness)"
                    }
                    _ => "",
                };
                write!(
                    f,
                    "{parameter} = {} mm lies at the edge of the data or beyond, which reach from {} to {} mm: they do not determine it{stiffnesses}",
                    millimetres(*value),
                    millimetres(*least),
                    millimetres(*largest)
                )
            }
            Self::OneStiffness { phi_2 } => write!(
                f,
                "fewer than two of the data lie beyond phi_2 = {} mm: they determine the sum of slider_stiffness and residual_stiffness alone",
                millimetres(*phi_2)
            ),
            Self::Straight => f.write_str(
                "the fit is a straight line, along which no slider slips: the data determine neither density, exponent nor phi_2, but the sum of all stiffnesses alone",
            ),
            Self::LumpAlone => f.write_str(
                "all that slips is a lump at phi_2 (slider_stiffness): the data determine neither density, exponent nor phi_1",
            ),
            Self::ExponentAtLimit { exponent } => write!(
                f,
                "the exponent {exponent} stands at the limit of the law, -1: the data do not determine it"
            ),
        }
    }
}

impl DensityFit {
    /// What speaks against the parameters of this fit to these data.
    #[must_use]
    pub fn doubts(&self, measured: &[(f64, f64)]) -> Vec<FitDoubt> {
        let mut doubts = Vec::new();
        if self.relative_error > MISFIT {
            doubts.push(FitDoubt::Misfit {
                relative_error: self.relative_error,
            });
        }
        let ends = ends(measured);
        if self.is_straight(ends[1]) {
            doubts.push(FitDoubt::Straight);
            return doubts;
        }
        let IwanDensity {
            exponent,
            phi_1,
            phi_2,
            ..
        } = self.density;
        let beyond = measured.iter().filter(|(reach, _)| *reach > phi_2).count();
        let before = measured.iter().filter(|(reach, _)| *reach < phi_2).count();
        let is_at_edge = beyond < 2 || before < 2;
        let outside = [
            ("phi_1", phi_1, phi_1 > 0.0 && phi_1 < ends[0]),
            ("phi_2", phi_2, is_at_edge && !self.held.phi_2),
        ];
        let outside = outside.into_iter().filter(|(.., outside)| *outside);
        doubts.extend(outside.map(|(parameter, value, _)| FitDoubt::Outside {
            parameter,
            value,
            measured: ends,
        }));
        let held = self.held;
        if beyond < 2 && held.phi_2 && !held.slider_stiffness && !held.residual_stiffness {
            doubts.push(FitDoubt::OneStiffness { phi_2 });
        }
        if self.is_lump_alone() {
            doubts.push(FitDoubt::LumpAlone);
        } else if exponent < -1.0 + 2.0 * LEAST_ABOVE && !self.held.exponent {
            doubts.push(FitDoubt::ExponentAtLimit { exponent });
        }
        doubts
    }

    /// Whether next to nothing of what slips belongs to the density.
    fn is_lump_alone(&self) -> bool {
        let spread = IwanDensity {
            slider_stiffness: 0.0,
            residual_stiffness: 0.0,
            ..self.density
        };
        let spread = spread.initial_stiffness();
        !(spread >= NOTHING_SLIPS * (spread + self.density.slider_stiffness))
    }

    /// Whether of a backbone so little slips up to this deformation (m) that it is a straight line.
    fn is_straight(&self, largest: f64) -> bool {
        let (first, at_end) = (
            self.density.initial_stiffness(),
            self.density.backbone(largest).1,
        );
        self.curve == MeasuredCurve::Backbone && first - at_end < NOTHING_SLIPS * first
    }

    /// Refuses a fit that makes no density.
    fn sound(self) -> Result<Self, HysteresisError> {
        match self.density.checked() {
            Ok(_) => Ok(self),
            Err(_) => Err(HysteresisError::Fit {
                reason: format!("law {LAW} does not follow the data"),
                remedy: self.curve.remedy(),
            }),
        }
    }
}

/// Least and largest amplitude or deformation (m).
fn ends(measured: &[(f64, f64)]) -> [f64; 2] {
    let reaches = measured.iter().map(|(reach, _)| *reach);
    [
        reaches.clone().fold(f64::INFINITY, f64::min),
        reaches.fold(0.0, f64::max),
    ]
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
    let held = HeldParameters::nothing(&guess);
    fit(MeasuredCurve::Dissipation, measured, guess, held, options)
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
    let held = HeldParameters::nothing(&guess);
    fit(MeasuredCurve::Backbone, measured, guess, held, options)
}

fn fit(
    curve: MeasuredCurve,
    measured: &[(f64, f64)],
    guess: IwanDensity,
    held: HeldParameters,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    let held = held.on(curve);
    let problem = Problem::new(curve, measured, guess.checked()?, held)?;
    let mut unknowns = problem.unknowns();
    let mut errors = problem.errors(&unknowns);
    let found = |unknowns: &DVector<f64>, errors: &DVector<f64>, iterations| DensityFit {
        curve,
        density: problem.density(unknowns),
        held,
        relative_error: (errors.norm_squared() / measured.len() as f64).sqrt(),
        iterations,
    };
    // What is linear is solved for at once.
    if unknowns.is_empty() {
        return Ok(found(&unknowns, &errors, 0));
    }
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
            return Ok(found(&unknowns, &errors, iteration));
        }
    }
    Err(HysteresisError::Fit {
        reason: format!("no convergence in {} iterations", options.iterations),
        remedy: "start from a nearer guess, or cover micro-slip and full slip with the measured amplitudes",
    })
}

/// Number of unknowns of a fit with these parameters of `iwan_six_parameter`: density, exponent,
/// `phi_2`, slider stiffness and, of a backbone, residual stiffness unless they are given, and
/// `phi_1` where it is given above zero.
///
/// # Errors
/// A density that is given.
pub fn unknowns_of_fit(
    curve: MeasuredCurve,
    start: &LawParameters,
) -> Result<usize, HysteresisError> {
    let held = HeldParameters::given(start)?.on(curve);
    let fits_phi_1 = start.values.get("phi_1").is_some_and(|x| *x > 0.0);
    Ok(held.unknowns(fits_phi_1))
}

/// The best of the fits ([`fit_dissipation`], [`fit_backbone`]) that hold these parameters of
/// `iwan_six_parameter` and set out from several values of the others. `phi_1` above zero is where
/// one sets out, as others do from shares of `phi_2`; else it is nothing.
///
/// # Errors
/// As [`fit_dissipation`], if no fit comes to a result; [`HysteresisError::Measured`]: data that fall
/// ([`Fall`]), or a density that is given.
pub fn fit_from_many(
    curve: MeasuredCurve,
    measured: &[(f64, f64)],
    start: &LawParameters,
    options: FitOptions,
) -> Result<DensityFit, HysteresisError> {
    let held = HeldParameters::given(start)?;
    if let Some(fall) = Fall::of(curve, measured) {
        return Err(fall.into());
    }
    let mut starts = guesses(curve, start, measured, SHARES.to_vec());
    // A value with which none of them is a density is refused, not left unused.
    let checked = starts.iter().map(|guess| guess.checked());
    if let Some(fault) = checked.reduce(|a, b| a.or(b)) {
        fault?;
    }
    starts.extend(near_starts(curve, start, held, measured));
    let mut best: Result<DensityFit, _> = Err(HysteresisError::Fit {
        reason: "no start".to_owned(),
        remedy: "give a start with --set",
    });
    for guess in starts {
        let found = fit(curve, measured, guess, held, options);
        best = match (best, found) {
            (Ok(best), Ok(found)) if found.relative_error < best.relative_error => Ok(found),
            (Ok(best), _) => Ok(best),
            (Err(_), found) => found,
        };
        if matches!(&best, Ok(best) if best.relative_error < EXACT) {
            break;
        }
    }
    let mut best = best?;
    for _ in 0..MOST_MOVES {
        if best.relative_error < EXACT || held.phi_2 {
            break;
        }
        let before = best.relative_error;
        for guess in moved(&best.density, held, measured) {
            if let Ok(found) = fit(curve, measured, guess, held, options)
                && found.relative_error < best.relative_error
            {
                best = found;
            }
        }
        if !(best.relative_error < 0.99 * before) {
            break;
        }
    }
    best.sound()
}

/// A density with its `phi_2` at places between the data around it.
fn moved(density: &IwanDensity, held: HeldParameters, measured: &[(f64, f64)]) -> Vec<IwanDensity> {
    let mut reaches: Vec<f64> = measured.iter().map(|(reach, _)| *reach).collect();
    reaches.sort_by(f64::total_cmp);
    let nearest = |a: &&[f64], b: &&[f64]| {
        let off = |pair: &&[f64]| (0.5 * (pair[0] + pair[1]) - density.phi_2).abs();
        off(a).total_cmp(&off(b))
    };
    let Some(pair) = reaches.windows(2).min_by(nearest) else {
        return Vec::new();
    };
    let distance = pair[1] - pair[0];
    let at = |by: f64| IwanDensity {
        phi_2: density.phi_2 + by * distance,
        // Free shares set out from above nothing.
        density: density.density.max(1.0),
        slider_stiffness: match held.slider_stiffness {
            true => density.slider_stiffness,
            false => 1.0,
        },
        ..*density
    };
    let moved = MOVES.map(at).into_iter();
    moved
        .filter(|density| density.phi_2 > density.phi_1)
        .collect()
}

/// Those of many places of `phi_1` and `phi_2` from which the law comes nearest to the data.
fn near_starts(
    curve: MeasuredCurve,
    start: &LawParameters,
    held: HeldParameters,
    measured: &[(f64, f64)],
) -> Vec<IwanDensity> {
    let [least, largest] = ends(measured);
    let last = f64::from(PLACES - 1);
    let shares = (0..PLACES).map(|k| {
        let (from, to) = (least / largest, 2.0);
        from * libm::pow(to / from, f64::from(k) / last)
    });
    let places = guesses(curve, start, measured, shares.collect());
    let with_first = places.into_iter().flat_map(|guess| {
        let shares = SHARES_OF_END.map(|share| IwanDensity {
            phi_1: share * guess.phi_2,
            ..guess
        });
        let free = (guess.phi_1 > 0.0).then_some(shares);
        std::iter::once(guess).chain(free.into_iter().flatten())
    });
    let mut judged: Vec<(f64, IwanDensity)> = with_first
        .filter_map(|guess| {
            let guess = guess.checked().ok()?;
            let problem = Problem::new(curve, measured, guess, held.on(curve)).ok()?;
            let errors = problem.errors(&problem.unknowns());
            Some((errors.norm_squared(), guess))
        })
        .filter(|(miss, _)| miss.is_finite())
        .collect();
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    judged.truncate(MORE_STARTS);
    judged.into_iter().map(|(_, guess)| guess).collect()
}

/// Where the fit sets out: every combination of what is not given, `phi_2` at these shares of the largest
/// amplitude.
fn guesses(
    curve: MeasuredCurve,
    start: &LawParameters,
    measured: &[(f64, f64)],
    shares: Vec<f64>,
) -> Vec<IwanDensity> {
    // A spring that does not dissipate is fitted to a backbone alone.
    let residual = match curve {
        MeasuredCurve::Dissipation => 0.0,
        MeasuredCurve::Backbone => 1.0,
    };
    let get = |name: &str| start.values.get(name).copied();
    let [_, maximum] = ends(measured);
    let exponents = get("exponent").map_or_else(|| EXPONENTS.to_vec(), |e| vec![e]);
    let ends = get("phi_2").map_or_else(
        || shares.iter().map(|s| s * maximum).collect(),
        |end| vec![end],
    );
    let guess = |exponent, phi_2| IwanDensity {
        density: 1.0,
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
    solved(matrix, &right, f64::EPSILON).ok_or_else(|| HysteresisError::Fit {
        reason: format!("law {LAW} has no finite values at these data"),
        remedy: "check the measured pairs and their units",
    })
}

/// The least-squares solution by singular values, of which those below `least` count as zero; none where
/// numbers are not finite or the values are not found.
fn solved(matrix: DMatrix<f64>, right: &DVector<f64>, least: f64) -> Option<DVector<f64>> {
    /// Steps of the search for the values, of which a matrix of six columns takes some tens.
    const STEPS: usize = 10_000;
    let mut numbers = matrix.iter().chain(right.iter());
    if !numbers.all(|x| x.is_finite()) {
        return None;
    }
    let values = matrix.try_svd(true, true, 5.0 * f64::EPSILON, STEPS)?;
    values.solve(right, least).ok()
}

/// The data, where the fit sets out and what of it stays.
struct Problem<'a> {
    curve: MeasuredCurve,
    measured: &'a [(f64, f64)],
    guess: IwanDensity,
    held: HeldParameters,
}

impl<'a> Problem<'a> {
    fn new(
        curve: MeasuredCurve,
        measured: &'a [(f64, f64)],
        guess: IwanDensity,
        held: HeldParameters,
    ) -> Result<Self, HysteresisError> {
        let all = held.unknowns(guess.phi_1 > 0.0);
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
            held,
        })
    }

    /// Of the guess those that are free of ln(alpha + 1 - [`LEAST_ABOVE`]), ln phi_2 and ln(beta/(1-beta)).
    fn unknowns(&self) -> DVector<f64> {
        let g = &self.guess;
        let mut values = Vec::new();
        if !self.held.exponent {
            let above = (g.exponent + 1.0 - LEAST_ABOVE).max(LEAST_ABOVE);
            values.push(libm::log(above));
        }
        if !self.held.phi_2 {
            values.push(libm::log(g.phi_2));
        }
        if g.phi_1 > 0.0 {
            values.push(libm::log(g.phi_1 / (g.phi_2 - g.phi_1)));
        }
        DVector::from_vec(values)
    }

    /// Exponent, `phi_1` and `phi_2` of these unknowns.
    fn shape(&self, unknowns: &DVector<f64>) -> [f64; 3] {
        let g = &self.guess;
        let mut unknowns = unknowns.iter();
        let mut value = |is_held, held, of: fn(f64) -> f64| match is_held {
            true => held,
            false => unknowns.next().map_or(held, |x| of(*x)),
        };
        let exponent = value(self.held.exponent, g.exponent, |x| {
            libm::exp(x) + LEAST_ABOVE - 1.0
        });
        let phi_2 = value(self.held.phi_2, g.phi_2, libm::exp);
        let over = value(g.phi_1 <= 0.0, f64::INFINITY, |x| 1.0 + libm::exp(-x));
        [exponent, phi_2 / over, phi_2]
    }

    /// The density of these unknowns with the best R and K2.
    fn density(&self, unknowns: &DVector<f64>) -> IwanDensity {
        let [exponent, phi_1, phi_2] = self.shape(unknowns);
        // What is held, and one N/m in the power density, in the lump, in the residual spring.
        let stays = |is_held, value| if is_held { value } else { 0.0 };
        let held = IwanDensity {
            density: 0.0,
            exponent,
            phi_1,
            phi_2,
            slider_stiffness: stays(self.held.slider_stiffness, self.guess.slider_stiffness),
            residual_stiffness: stays(self.held.residual_stiffness, self.guess.residual_stiffness),
        };
        let nothing = IwanDensity {
            slider_stiffness: 0.0,
            residual_stiffness: 0.0,
            ..held
        };
        let powers = IwanDensity {
            density: libm::pow(phi_2, -1.0 - exponent),
            ..nothing
        };
        let lump = IwanDensity {
            slider_stiffness: 1.0,
            ..nothing
        };
        let residual = IwanDensity {
            residual_stiffness: 1.0,
            ..nothing
        };
        let is_free = [
            true,
            !self.held.slider_stiffness,
            !self.held.residual_stiffness,
        ];
        let shares = self.shares(&held, &[powers, lump, residual], is_free);
        // Nothing depends on exponent and phi_1 then, which may be anywhere.
        let (exponent, phi_1) = match shares[0] == 0.0 {
            true => (
                self.guess.exponent,
                phi_2 * (self.guess.phi_1 / self.guess.phi_2),
            ),
            false => (exponent, phi_1),
        };
        IwanDensity {
            density: shares[0] * powers.density,
            exponent,
            phi_1,
            slider_stiffness: held.slider_stiffness + shares[1],
            residual_stiffness: held.residual_stiffness + shares[2],
            ..held
        }
    }

    /// The least-squares multiples, not negative, of three densities, of which some are free, beside
    /// what is held: the best of those with any of them left out.
    fn shares(
        &self,
        held: &IwanDensity,
        densities: &[IwanDensity; 3],
        is_free: [bool; 3],
    ) -> [f64; 3] {
        let rows = self.measured.len();
        let relative = |density: &IwanDensity, i: usize| {
            let (reach, value) = self.measured[i];
            self.curve.value(density, reach) / value
        };
        let columns: [DVector<f64>; 3] =
            std::array::from_fn(|j| DVector::from_fn(rows, |i, _| relative(&densities[j], i)));
        let rest = DVector::from_fn(rows, |i, _| 1.0 - relative(held, i));
        // A step far out may overflow: it is not taken.
        let free = columns.iter().zip(is_free).filter(|(_, free)| *free);
        let mut numbers = free.flat_map(|(c, _)| c.iter()).chain(rest.iter());
        if numbers.any(|x| !x.is_finite()) {
            return [f64::NAN; 3];
        }
        // Orthogonal rotations take all rows into four, of which the shares are found faster.
        let [a, b, c] = &columns;
        let all = DMatrix::from_columns(&[a.clone(), b.clone(), c.clone(), rest]);
        let rotated = all.qr().r();
        let columns: [DVector<f64>; 3] = std::array::from_fn(|j| rotated.column(j).into_owned());
        let rest = rotated.column(3).into_owned();
        let mut best = ([0.0; 3], f64::INFINITY);
        for subset in 1..8_usize {
            let chosen: Vec<usize> = (0..3).filter(|j| subset >> j & 1 == 1).collect();
            if chosen.iter().any(|j| !is_free[*j]) {
                continue;
            }
            let chosen_columns: Vec<_> = chosen.iter().map(|j| columns[*j].clone()).collect();
            let matrix = DMatrix::from_columns(&chosen_columns);
            let Some(found) = solved(matrix.clone(), &rest, 1e-12) else {
                continue;
            };
            let miss = (&matrix * &found - &rest).norm_squared();
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
        let mut slopes = DMatrix::zeros(self.measured.len(), unknowns.len());
        for j in 0..unknowns.len() {
            let mut shifted = unknowns.clone();
            shifted[j] += width;
            let above = self.errors(&shifted);
            shifted[j] -= 2.0 * width;
            let below = self.errors(&shifted);
            let slope = (above - below) / (2.0 * width);
            // Where values overflow, as with an exponent that no share of sliders depends on, there is no way on.
            if slope.iter().all(|x| x.is_finite()) {
                slopes.set_column(j, &slope);
            }
        }
        slopes
    }
}
