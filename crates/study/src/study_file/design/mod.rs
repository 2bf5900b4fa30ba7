//! How the variables of a study are sampled. Every design gives any run's values from its
//! number alone, so that memory does not grow with the number of runs.

mod latin_hypercube;
mod sobol;

use super::{Value, Values, Variable};
use crate::mixing;

pub use sobol::MOST_DIMENSIONS;

/// How the variables are sampled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Design {
    /// Every combination; the last variable runs fastest.
    Grid {
        /// Values of each variable.
        sizes: Vec<usize>,
    },
    /// Every combination of the variables with values, and sets of random numbers of the others in each.
    SampledGrid(SampledGrid),
    /// The first values of all variables, then the second, ...
    List {
        /// Number of runs.
        runs: usize,
    },
    /// Latin hypercube (McKay, Beckman and Conover 1979, Technometrics 21, 239): each
    /// variable has one run in every equal share of its range.
    LatinHypercube {
        /// Number of runs.
        runs: usize,
        /// Seed.
        seed: u64,
    },
    /// Random numbers that know nothing of one another, as a Monte Carlo simulation takes them.
    MonteCarlo {
        /// Number of runs: more of them leave the first as they are.
        runs: usize,
        /// Seed.
        seed: u64,
    },
    /// Sobol sequence with the direction numbers of Joe and Kuo (2008), SIAM J. Sci.
    /// Comput. 30, 2635; with a seed shifted by random digits, which keeps its evenness.
    Sobol {
        /// Number of runs; powers of two are spread most evenly.
        runs: usize,
        /// Seed of the shift; `None`: the sequence as it is, beginning at zero.
        seed: Option<u64>,
    },
}

/// Every combination of the variables with values, each with so many sets of random numbers of the others: a Latin
/// hypercube, whose sets are the same in all combinations but of other records, of which each has one of its own, which
/// all are one together. The sets stand in the place of the first random variable; the last variable runs fastest.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SampledGrid {
    /// Values of each variable: of the first random one the sets for a record, of the others of them one.
    sizes: Vec<usize>,
    /// The first random variable.
    random: usize,
    /// The variable that chooses the record, if one does.
    record: Option<usize>,
    /// Sets for each record.
    samples: usize,
    /// Seed.
    seed: u64,
}

impl SampledGrid {
    /// The grid of these variables with so many random sets for each record; `None` if none is random.
    pub(crate) fn new(variables: &[Variable], samples: usize, seed: u64) -> Option<Self> {
        let random = variables.iter().position(|v| is_random(&v.values))?;
        let sizes = variables.iter().enumerate().map(|(i, v)| match i {
            _ if i == random => samples,
            _ => v.values.count().unwrap_or(1),
        });
        Some(Self {
            sizes: sizes.collect(),
            random,
            record: variables.iter().position(Variable::is_record),
            samples,
            seed,
        })
    }

    /// Values of each variable.
    pub(crate) fn sizes(&self) -> &[usize] {
        &self.sizes
    }

    /// Sets of random numbers of all records.
    fn sets(&self) -> usize {
        self.samples * self.record.map_or(1, |record| self.sizes[record])
    }

    fn point(&self, run: usize, variables: &[Variable]) -> Vec<Value> {
        let places = places(run, &self.sizes);
        let record = self.record.map_or(0, |record| places[record]);
        let records = self.record.map_or(1, |record| self.sizes[record]);
        let slice = (record as u64, records as u64);
        let sample = (places[self.random] as u64, self.samples as u64);
        let numbered = variables.iter().zip(places).enumerate();
        numbered
            .map(|(d, (variable, place))| match is_random(&variable.values) {
                true => variable.values.sample(latin_hypercube::sliced_coordinate(
                    slice, sample, d as u64, self.seed,
                )),
                false => variable.values.at(place),
            })
            .collect()
    }
}

/// Whether a variable of a grid with samples takes random numbers: those of a distribution, or even ones of a range
/// without a count.
pub(crate) fn is_random(values: &Values) -> bool {
    values.count().is_none()
}

/// Which value each variable of a grid has in a run.
fn places(run: usize, sizes: &[usize]) -> Vec<usize> {
    let mut rest = run;
    let place = |size: &usize| {
        let place = rest % size;
        rest /= size;
        place
    };
    let mut places: Vec<usize> = sizes.iter().rev().map(place).collect();
    places.reverse();
    places
}

impl Design {
    /// A Sobol design, or why there is none.
    pub(crate) fn sobol(runs: usize, seed: Option<u64>, dimensions: usize) -> Result<Self, String> {
        if dimensions > MOST_DIMENSIONS {
            return Err(format!(
                "a Sobol design has at most {MOST_DIMENSIONS} variables"
            ));
        }
        if runs as u64 > 1 << sobol::BITS {
            return Err(format!("a Sobol design has at most 2^{} runs", sobol::BITS));
        }
        Ok(Self::Sobol { runs, seed })
    }

    /// Number of runs.
    #[must_use]
    pub fn runs(&self) -> usize {
        match self {
            Self::Grid { sizes } | Self::SampledGrid(SampledGrid { sizes, .. }) => {
                sizes.iter().product()
            }
            Self::List { runs }
            | Self::LatinHypercube { runs, .. }
            | Self::MonteCarlo { runs, .. }
            | Self::Sobol { runs, .. } => *runs,
        }
    }

    /// Sets of random numbers that differ.
    pub(crate) fn samples(&self) -> usize {
        match self {
            Self::SampledGrid(grid) => grid.sets(),
            _ => self.runs(),
        }
    }

    /// Values of the variables in a run.
    pub(crate) fn point(&self, run: usize, variables: &[Variable]) -> Vec<Value> {
        match self {
            Self::Grid { sizes } => {
                let places = places(run, sizes).into_iter();
                let values = variables.iter().zip(places);
                values.map(|(v, place)| v.values.at(place)).collect()
            }
            Self::SampledGrid(grid) => grid.point(run, variables),
            Self::List { .. } => variables.iter().map(|v| v.values.at(run)).collect(),
            Self::LatinHypercube { runs, seed } => sampled(variables, |d| {
                latin_hypercube::coordinate(run as u64, d as u64, *runs as u64, *seed)
            }),
            Self::MonteCarlo { seed, .. } => {
                // Apart from the numbers of a Latin hypercube of the same seed.
                sampled(variables, |d| {
                    mixing::unit(&[*seed, d as u64, run as u64, 3])
                })
            }
            Self::Sobol { seed, .. } => {
                sampled(variables, |d| sobol::coordinate(run as u64, d, *seed))
            }
        }
    }
}

/// The values at these coordinates, 0 to 1, of every variable.
fn sampled(variables: &[Variable], coordinate: impl Fn(usize) -> f64) -> Vec<Value> {
    let numbered = variables.iter().enumerate();
    numbered
        .map(|(d, v)| v.values.sample(coordinate(d)))
        .collect()
}
