//! Iwan's parallel-series model of sliders with a truncated power density: closed
//! forms.
//!
//! Sliders of unit stiffness slip at the deformation `phi`; their density is
//! `R phi^alpha` between `phi_1` and `phi_2`, with a lump of stiffness `K2` at
//! `phi_2` and a spring `Kinf` that never slips. The backbone is
//! `F(x) = int_0^x phi rho dphi + x int_x^inf rho dphi` (Iwan, Journal of Applied
//! Mechanics 33 (1966) 893); loops follow from it by Masing's rule. All forms are
//! sums of positive terms, regular as `alpha` approaches -1 and for `phi_1 = 0`.

use crate::error::HysteresisError;
use crate::parameters::LawParameters;
use crate::power_integral::{power, power_moment};

/// The density of sliders.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IwanDensity {
    /// Factor R of the power density (N/m^(2+alpha)).
    pub density: f64,
    /// Exponent alpha of the power density, above -1.
    pub exponent: f64,
    /// Deformation at which the first slider slips (m).
    pub phi_1: f64,
    /// Deformation at which the last slider slips (m).
    pub phi_2: f64,
    /// Stiffness K2 of the sliders that slip together at `phi_2` (N/m).
    pub slider_stiffness: f64,
    /// Stiffness Kinf that never slips (N/m).
    pub residual_stiffness: f64,
}

/// Name under which the errors of the closed forms speak.
pub(super) const LAW: &str = "iwan_six_parameter";

impl IwanDensity {
    /// The parameters of the law `iwan_six_parameter` with this density.
    #[must_use]
    pub fn parameters(&self) -> LawParameters {
        LawParameters::from_pairs(&[
            ("density", self.density),
            ("exponent", self.exponent),
            ("phi_1", self.phi_1),
            ("phi_2", self.phi_2),
            ("slider_stiffness", self.slider_stiffness),
            ("residual_stiffness", self.residual_stiffness),
        ])
    }

    /// The same, if its parameters make a density.
    ///
    /// # Errors
    /// [`HysteresisError::Inconsistent`] with the reason: a negative or infinite
    /// number, an exponent of -1 or less, `phi_1` not below `phi_2`, or no stiffness.
    pub fn checked(self) -> Result<Self, HysteresisError> {
        self.fault().map_or(Ok(self), |(reason, remedy)| {
            Err(HysteresisError::Inconsistent {
                law: LAW,
                reason,
                remedy,
            })
        })
    }

    /// The same of a law that states its density by parameters of its own: `stated` says which.
    pub(crate) fn checked_as(
        self,
        law: &'static str,
        stated: impl FnOnce() -> String,
    ) -> Result<Self, HysteresisError> {
        match self.fault() {
            None => Ok(self),
            Some(_) => Err(HysteresisError::Inconsistent {
                law,
                reason: format!(
                    "{} are beyond what a density of sliders can be computed from",
                    stated()
                ),
                remedy: "check their sizes and units; plain numbers are SI",
            }),
        }
    }

    /// Why the parameters make no density, and what to do.
    fn fault(&self) -> Option<(String, &'static str)> {
        let fail = |reason: String, remedy: &'static str| Some((reason, remedy));
        let (low, high) = (self.phi_1, self.phi_2);
        if !(self.exponent > -1.0) || !self.exponent.is_finite() {
            return fail(
                format!(
                    "the exponent {} makes the stiffness infinite",
                    self.exponent
                ),
                "take an exponent above -1",
            );
        }
        if !(low >= 0.0 && low < high && high.is_finite()) {
            return fail(
                format!("the sliders slip from phi_1 = {low} m to phi_2 = {high} m"),
                "phi_1 is zero or more and below phi_2",
            );
        }
        let others = [self.density, self.slider_stiffness, self.residual_stiffness];
        if others.iter().any(|v| !(*v >= 0.0) || !v.is_finite()) {
            return fail(
                "a density or a stiffness is negative or infinite".to_owned(),
                "density and stiffnesses are zero or more",
            );
        }
        let initial = self.initial_stiffness();
        if !(initial > 0.0) || !initial.is_finite() {
            return fail(
                format!("the initial stiffness is {initial} N/m"),
                "give a positive density or a positive stiffness, in SI units",
            );
        }
        None
    }

    /// The four-parameter density (Segalman, Journal of Applied Mechanics 72 (2005)
    /// 752) from the force `slip_force` at which everything slips (N), the initial
    /// stiffness (N/m), the exponent `chi` in (-1, 0] and the ratio `beta >= 0` of
    /// the lump of sliders to the rest of the stiffness.
    ///
    /// # Errors
    /// [`HysteresisError::Inconsistent`] where a parameter is outside its range.
    pub fn segalman(
        slip_force: f64,
        initial_stiffness: f64,
        chi: f64,
        beta: f64,
    ) -> Result<Self, HysteresisError> {
        const LAW: &str = "segalman_2005";
        let stated = || {
            format!(
                "slip_force = {slip_force:?} N, stiffness = {initial_stiffness:?} N/m, chi = {chi:?} and beta = {beta:?}"
            )
        };
        if !(slip_force > 0.0 && initial_stiffness > 0.0 && beta >= 0.0 && chi > -1.0 && chi <= 0.0)
        {
            return Err(HysteresisError::Inconsistent {
                law: LAW,
                reason: stated(),
                remedy: "force and stiffness are positive, chi lies in (-1, 0], beta is zero or more",
            });
        }
        let order = chi + 1.0;
        let share = beta + order / (chi + 2.0);
        let phi_2 = slip_force * (1.0 + beta) / (initial_stiffness * share);
        Self {
            density: slip_force * order / (libm::pow(phi_2, chi + 2.0) * share),
            exponent: chi,
            phi_1: 0.0,
            phi_2,
            slider_stiffness: slip_force / phi_2 * beta / share,
            residual_stiffness: 0.0,
        }
        .checked_as(LAW, stated)
    }

    /// Slope of the backbone at rest (N/m).
    #[must_use]
    pub fn initial_stiffness(&self) -> f64 {
        self.density * power(self.exponent, self.phi_1, self.phi_2)
            + self.slider_stiffness
            + self.residual_stiffness
    }

    /// Force (N) of the sliders alone when all of them slip.
    #[must_use]
    pub fn slip_force(&self) -> f64 {
        self.density * power(self.exponent + 1.0, self.phi_1, self.phi_2)
            + self.slider_stiffness * self.phi_2
    }

    /// Force (N) and slope (N/m) on loading from the new state to this deformation
    /// (m); odd in the deformation.
    #[must_use]
    pub fn backbone(&self, deformation: f64) -> (f64, f64) {
        let reach = deformation.abs();
        let corners = [self.phi_1, self.phi_2];
        let segment = corners.iter().take_while(|c| reach >= **c).count();
        let (force, slope) = self.segment(segment, reach);
        (force.copysign(deformation), slope)
    }

    /// Force and slope by the formula of no slip (0), partial slip (1) or full
    /// slip (2) at a deformation that is not negative.
    pub(crate) fn segment(&self, segment: usize, reach: f64) -> (f64, f64) {
        match segment {
            0 => {
                let slope = self.initial_stiffness();
                (slope * reach, slope)
            }
            1 => {
                // The power is defined beyond phi_2 too: an integral over a reversed
                // range, with its sign.
                let stuck = self.signed_power(self.exponent, reach, self.phi_2);
                let slope = self.density * stuck + self.slider_stiffness + self.residual_stiffness;
                let slipping = self.signed_power(self.exponent + 1.0, self.phi_1, reach);
                (self.density * slipping + slope * reach, slope)
            }
            _ => {
                let slope = self.residual_stiffness;
                (self.slip_force() + slope * reach, slope)
            }
        }
    }

    fn signed_power(&self, exponent: f64, low: f64, high: f64) -> f64 {
        power(exponent, low, high) - power(exponent, high, low)
    }

    /// Force (N) at this deformation (m) on unloading from the turning point at
    /// `amplitude` (m) of the backbone, down to its mirror image:
    /// `F(A) - 2 F((A - x) / 2)`.
    #[must_use]
    pub fn unloading(&self, amplitude: f64, deformation: f64) -> f64 {
        self.backbone(amplitude).0 - 2.0 * self.backbone(0.5 * (amplitude - deformation)).0
    }

    /// Force (N) on reloading from `-amplitude` (m) up to `amplitude`.
    #[must_use]
    pub fn reloading(&self, amplitude: f64, deformation: f64) -> f64 {
        -self.unloading(amplitude, -deformation)
    }

    /// Energy (J) dissipated in a closed cycle of this amplitude (m):
    /// `4 int_0^A phi (A - phi) rho dphi`.
    #[must_use]
    pub fn cycle_dissipation(&self, amplitude: f64) -> f64 {
        4.0 * self.slip_work(amplitude.abs())
    }

    /// Energy (J) dissipated on the backbone from zero to this deformation, which
    /// is not negative.
    pub(crate) fn slip_work(&self, reach: f64) -> f64 {
        let slipping = reach.min(self.phi_2);
        self.density * power_moment(self.exponent + 1.0, self.phi_1, slipping, reach)
            + self.slider_stiffness * self.phi_2 * (reach - self.phi_2).max(0.0)
    }

    /// Energy (J) stored on the backbone at this deformation, which is not negative.
    pub(crate) fn stored(&self, reach: f64) -> f64 {
        let slipping = reach.min(self.phi_2);
        let stuck = power(self.exponent, reach.max(self.phi_1), self.phi_2);
        let square = reach * reach;
        0.5 * (self.density * (square * stuck + power(self.exponent + 2.0, self.phi_1, slipping))
            + self.slider_stiffness * slipping * slipping
            + self.residual_stiffness * square)
    }
}

/// Dissipation of a cycle without dimension, `D / (R phi_2^(alpha+3))`, at the
/// amplitude `amplitude_ratio = A / phi_2`, with `beta = phi_1 / phi_2` in [0, 1)
/// and `kappa_2 = K2 / (R phi_2^(alpha+1))`.
///
/// # Errors
/// [`HysteresisError::Inconsistent`] where a parameter is outside its range.
pub fn dimensionless_dissipation(
    amplitude_ratio: f64,
    exponent: f64,
    beta: f64,
    kappa_2: f64,
) -> Result<f64, HysteresisError> {
    let unit = IwanDensity {
        density: 1.0,
        exponent,
        phi_1: beta,
        phi_2: 1.0,
        slider_stiffness: kappa_2,
        residual_stiffness: 0.0,
    };
    Ok(unit.checked()?.cycle_dissipation(amplitude_ratio))
}
