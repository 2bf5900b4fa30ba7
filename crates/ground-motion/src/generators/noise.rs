//! Random numbers that a seed fixes.

use std::f64::consts::TAU;

use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, StandardNormal, StandardUniform};

/// The ChaCha stream of a seed: the same numbers on every machine.
pub(crate) struct Noise(ChaCha20Rng);

impl Noise {
    pub(crate) fn new(seed: u64) -> Self {
        Self(ChaCha20Rng::seed_from_u64(seed))
    }

    /// Mean zero, variance one.
    pub(crate) fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.0)
    }

    /// In [0, 2 pi).
    pub(crate) fn phase(&mut self) -> f64 {
        let part: f64 = StandardUniform.sample(&mut self.0);
        TAU * part
    }
}
