//! How the variables of a study are sampled. Every design gives any run's values from its
//! number alone, so that memory does not grow with the number of runs.

mod latin_hypercube;
pub(crate) mod mixing;
mod sobol;

use crate::study_file::{Value, Variable};

pub use sobol::MOST_DIMENSIONS;

/// How the variables are sampled.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Design {
    /// Every combination; the last variable runs fastest.
    Grid {
        /// Values of each variable.
        sizes: Vec<usize>,
    },
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
            Self::Grid { sizes } => sizes.iter().product(),
            Self::List { runs }
            | Self::LatinHypercube { runs, .. }
            | Self::MonteCarlo { runs, .. }
            | Self::Sobol { runs, .. } => *runs,
        }
    }

    /// Values of the variables in a run.
    pub(crate) fn point(&self, run: usize, variables: &[Variable]) -> Vec<Value> {
        match self {
            Self::Grid { sizes } => {
                let mut rest = run;
                let mut values: Vec<Value> = variables
                    .iter()
                    .zip(sizes)
                    .rev()
                    .map(|(variable, size)| {
                        let value = variable.values.at(rest % size);
                        rest /= size;
                        value
                    })
                    .collect();
                values.reverse();
                values
            }
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
