//! Further terms of a relative displacement: of a contact or a link that is no difference of two
//! floors on the same ground.

use crate::polynomial::Polynomial;

/// What a relative displacement holds beside its left and right degree of freedom: numbers of
/// degrees of freedom with their weights.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Terms {
    /// Those that the force acts on, with the same weights.
    pub pushed: Vec<(usize, f64)>,
    /// Displacements of the ground, on which no force acts.
    pub ground: Vec<(usize, f64)>,
}

impl Terms {
    pub(crate) fn is_empty(&self) -> bool {
        self.pushed.is_empty() && self.ground.is_empty()
    }

    /// Their part of any quantity given per degree of freedom.
    #[inline]
    pub(crate) fn sum_of(&self, x: impl Fn(usize) -> f64) -> f64 {
        let terms = self.pushed.iter().chain(&self.ground);
        terms.map(|(i, w)| w * x(*i)).sum()
    }

    /// The part of the ground alone.
    #[inline]
    pub(crate) fn ground_of(&self, x: impl Fn(usize) -> f64) -> f64 {
        self.ground.iter().map(|(i, w)| w * x(*i)).sum()
    }

    /// Adds their part of a polynomial.
    pub(crate) fn add_polynomials<'a>(
        &self,
        component: impl Fn(usize) -> &'a Polynomial,
        sum: &mut Polynomial,
    ) {
        for (i, w) in self.pushed.iter().chain(&self.ground) {
            for (sum, c) in sum.iter_mut().zip(component(*i)) {
                *sum += w * c;
            }
        }
    }

    /// Adds a force that acts against the growth of the relative displacement.
    #[inline]
    pub(crate) fn push(&self, force: f64, net: &mut [f64]) {
        for (i, w) in &self.pushed {
            net[*i] -= w * force;
        }
    }
}
