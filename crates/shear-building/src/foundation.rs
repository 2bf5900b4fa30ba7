//! Foundations and the soil below them.

/// A spring with a dashpot beside it, of a displacement or of a rotation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringDashpot {
    /// Stiffness (N/m, of a rotation N m/rad).
    pub stiffness: f64,
    /// Dashpot coefficient (N s/m, of a rotation N m s/rad).
    pub dashpot: f64,
}

/// Soil below a rectangular foundation on its surface: a homogeneous half-space.
///
/// Circles take the place of the rectangle, of its area `A` for sway and of its second moment
/// of area `I` about the rocking axis for rocking: `r = sqrt(A / pi)`,
/// `r_t = (4 I / pi)^(1/4)`. With `G = rho Vs^2`
///
/// - `k_x = 8 G r / (2 - nu)`, `c_x = rho Vs A`;
/// - `k_t = 8 G r_t^3 / (3 (1 - nu))`, `c_t = rho Vp I` with
///   `Vp = Vs sqrt(2 (1 - nu) / (1 - 2 nu))`.
///
/// Above `nu = 1/3` compression waves are too fast to carry energy away: `2 Vs` takes the
/// place of `Vp`, and soil that moves with the foundation adds `1.2 (nu - 1/3) rho I r_t` to
/// its rotational inertia (Wolf, Foundation Vibration Analysis Using Simple Physical Models,
/// Prentice Hall 1994, chapter 2; not compared with the text, the static stiffnesses
/// derived again from its cones). The dashpots are limits of high frequency: that of rocking damps
/// slow rocking too much. Embedment, layers and kinematic interaction are left out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Soil {
    /// Shear wave speed `Vs` (m/s) at the strain that is expected.
    pub shear_wave_speed: f64,
    /// Density `rho` (kg/m3).
    pub density: f64,
    /// Poisson's ratio `nu` (-), from 0 to below 0.5.
    pub poisson: f64,
    /// Length of the foundation along the motion (m).
    pub length: f64,
    /// Width of the foundation across the motion (m).
    pub width: f64,
}

/// What the soil does to a foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SoilSprings {
    /// Sway (N/m, N s/m).
    pub sway: SpringDashpot,
    /// Rocking (N m/rad, N m s/rad).
    pub rocking: SpringDashpot,
    /// Rotational inertia of soil that moves with the foundation (kg m2).
    pub trapped_inertia: f64,
}

/// A rigid foundation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Foundation {
    mass: f64,
    rotational_inertia: f64,
    sway: Option<SpringDashpot>,
    rocking: Option<SpringDashpot>,
}

/// A foundation or a soil that cannot be.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FoundationError {
    /// A value outside of its range.
    #[error("{quantity} = {value} must be {required}")]
    Value {
        /// Quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// What is allowed.
        required: &'static str,
    },
    /// A foundation that can move, but has no inertia.
    #[error(
        "a foundation that can {motion} needs a {quantity} above zero: without it the mass matrix is singular"
    )]
    NoInertia {
        /// What it can do.
        motion: &'static str,
        /// What is missing.
        quantity: &'static str,
    },
    /// Neither sway nor rocking.
    #[error("the foundation neither sways nor rocks: it is a fixed base")]
    Fixed,
    /// Matrices and lists of other sizes than the floors.
    #[error("{quantity} has {found} values for {expected} floors")]
    Length {
        /// Quantity.
        quantity: &'static str,
        /// Values given.
        found: usize,
        /// Floors.
        expected: usize,
    },
}

fn positive(quantity: &'static str, value: f64) -> Result<(), FoundationError> {
    match value.is_finite() && value > 0.0 {
        true => Ok(()),
        false => Err(FoundationError::Value {
            quantity,
            value,
            required: "greater than zero",
        }),
    }
}

fn not_negative(quantity: &'static str, value: f64) -> Result<(), FoundationError> {
    match value.is_finite() && value >= 0.0 {
        true => Ok(()),
        false => Err(FoundationError::Value {
            quantity,
            value,
            required: "zero or more",
        }),
    }
}

impl Soil {
    /// Springs, dashpots and trapped mass.
    ///
    /// # Errors
    /// A Poisson's ratio outside of 0 to below 0.5, any other value that is not above zero.
    pub fn springs(&self) -> Result<SoilSprings, FoundationError> {
        positive("shear wave speed", self.shear_wave_speed)?;
        positive("density", self.density)?;
        positive("length", self.length)?;
        positive("width", self.width)?;
        let nu = self.poisson;
        if !(0.0..0.5).contains(&nu) {
            return Err(FoundationError::Value {
                quantity: "Poisson's ratio",
                value: nu,
                required: "from 0 to below 0.5",
            });
        }
        let (speed, density) = (self.shear_wave_speed, self.density);
        let modulus = density * speed * speed;
        let area = self.length * self.width;
        let second_moment = self.width * self.length.powi(3) / 12.0;
        let sway_radius = (area / std::f64::consts::PI).sqrt();
        let rocking_radius = libm::pow(4.0 * second_moment / std::f64::consts::PI, 0.25);
        let nearly_incompressible = nu > 1.0 / 3.0;
        let (compression_speed, trapped_inertia) = if nearly_incompressible {
            let trapped = 1.2 * (nu - 1.0 / 3.0) * density * second_moment * rocking_radius;
            (2.0 * speed, trapped)
        } else {
            (speed * (2.0 * (1.0 - nu) / (1.0 - 2.0 * nu)).sqrt(), 0.0)
        };
        Ok(SoilSprings {
            sway: SpringDashpot {
                stiffness: 8.0 * modulus * sway_radius / (2.0 - nu),
                dashpot: density * speed * area,
            },
            rocking: SpringDashpot {
                stiffness: 8.0 * modulus * rocking_radius.powi(3) / (3.0 * (1.0 - nu)),
                dashpot: density * compression_speed * second_moment,
            },
            trapped_inertia,
        })
    }
}

impl Foundation {
    /// A foundation from its mass (kg), the rotational inertia of foundation and floors about
    /// their own axes together (kg m2), and what holds its sway and its rocking; one of the
    /// two that is left out is rigid.
    ///
    /// # Errors
    /// Neither sway nor rocking, a stiffness that is not above zero, a negative dashpot, mass
    /// or inertia, sway without mass, and rocking without rotational inertia.
    pub fn new(
        mass: f64,
        rotational_inertia: f64,
        sway: Option<SpringDashpot>,
        rocking: Option<SpringDashpot>,
    ) -> Result<Self, FoundationError> {
        not_negative("mass of the foundation", mass)?;
        not_negative("rotational inertia", rotational_inertia)?;
        for (held, [stiffness, dashpot]) in [
            (&sway, ["sway stiffness", "sway dashpot"]),
            (&rocking, ["rocking stiffness", "rocking dashpot"]),
        ] {
            if let Some(held) = held {
                positive(stiffness, held.stiffness)?;
                not_negative(dashpot, held.dashpot)?;
            }
        }
        if sway.is_none() && rocking.is_none() {
            return Err(FoundationError::Fixed);
        }
        if sway.is_some() && mass == 0.0 {
            return Err(FoundationError::NoInertia {
                motion: "sway",
                quantity: "mass",
            });
        }
        if rocking.is_some() && rotational_inertia == 0.0 {
            return Err(FoundationError::NoInertia {
                motion: "rock",
                quantity: "rotational inertia",
            });
        }
        Ok(Self {
            mass,
            rotational_inertia,
            sway,
            rocking,
        })
    }

    /// A foundation that sways and rocks on soil, whose trapped mass is added to the rotational
    /// inertia.
    ///
    /// # Errors
    /// As [`Soil::springs`] and [`Foundation::new`].
    pub fn on_soil(
        mass: f64,
        rotational_inertia: f64,
        soil: &Soil,
    ) -> Result<Self, FoundationError> {
        let springs = soil.springs()?;
        not_negative("rotational inertia", rotational_inertia)?;
        if rotational_inertia == 0.0 {
            return Err(FoundationError::NoInertia {
                motion: "rock",
                quantity: "rotational inertia",
            });
        }
        let inertia = rotational_inertia + springs.trapped_inertia;
        Self::new(mass, inertia, Some(springs.sway), Some(springs.rocking))
    }

    /// Mass of the foundation (kg).
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Rotational inertia of foundation and floors about their own axes, with that of soil that
    /// moves with them (kg m2).
    #[must_use]
    pub fn rotational_inertia(&self) -> f64 {
        self.rotational_inertia
    }

    /// What holds the sway; `None` where it is rigid.
    #[must_use]
    pub fn sway(&self) -> Option<SpringDashpot> {
        self.sway
    }

    /// What holds the rotation; `None` where it is rigid.
    #[must_use]
    pub fn rocking(&self) -> Option<SpringDashpot> {
        self.rocking
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const BESIDE: SpringDashpot = SpringDashpot {
        stiffness: 1.0e9,
        dashpot: 0.0,
    };

    pub(crate) fn near(found: f64, expected: f64, tolerance: f64) {
        let error = (found - expected).abs();
        assert!(
            error <= tolerance * expected.abs(),
            "{found} for {expected}: {error:e}"
        );
    }

    pub(crate) fn soil() -> Soil {
        Soil {
            shear_wave_speed: 180.0,
            density: 1800.0,
            poisson: 0.33,
            length: 12.0,
            width: 12.0,
        }
    }

    /// A pair of buildings on foundations of 12 m by 12 m and 15 m by 12 m, evaluated apart
    /// from this code.
    #[test]
    fn soil_has_the_springs_of_its_half_space() {
        for (length, [k_x, k_t, c_x, c_t]) in [
            (
                12.0,
                [
                    1891460781.5571823,
                    74567887107.42413,
                    46656000.0,
                    1111480093.6993349,
                ],
            ),
            (
                15.0,
                [
                    2114717442.16837,
                    123196782816.98497,
                    58320000.0,
                    2170859558.0065136,
                ],
            ),
        ] {
            let springs = Soil { length, ..soil() }.springs().unwrap();
            near(springs.sway.stiffness, k_x, 1e-14);
            near(springs.rocking.stiffness, k_t, 1e-14);
            near(springs.sway.dashpot, c_x, 1e-14);
            near(springs.rocking.dashpot, c_t, 1e-14);
            assert_eq!(springs.trapped_inertia, 0.0);
        }
    }

    /// Above a third: twice the shear wave speed, and the trapped mass, by hand for a square
    /// of 2 m (I = 4/3, r_t = (16 / (3 pi))^(1/4)).
    #[test]
    fn nearly_incompressible_soil_moves_with_the_foundation() {
        let wet = Soil {
            poisson: 0.45,
            length: 2.0,
            width: 2.0,
            ..soil()
        };
        let springs = wet.springs().unwrap();
        near(springs.rocking.dashpot, 1800.0 * 360.0 * 4.0 / 3.0, 1e-14);
        let radius = libm::pow(16.0 / (3.0 * std::f64::consts::PI), 0.25);
        let trapped = 1.2 * (0.45 - 1.0 / 3.0) * 1800.0 * (4.0 / 3.0) * radius;
        near(springs.trapped_inertia, trapped, 1e-14);
        let foundation = Foundation::on_soil(1e3, 500.0, &wet).unwrap();
        near(foundation.rotational_inertia(), 500.0 + trapped, 1e-14);
        // The speeds meet at a third.
        let third = Soil {
            poisson: 1.0 / 3.0,
            ..soil()
        };
        let dashpot = third.springs().unwrap().rocking.dashpot;
        near(dashpot, 1800.0 * 360.0 * 1728.0, 1e-12);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let told = |e: FoundationError| e.to_string();
        for (soil, says) in [
            (
                Soil {
                    poisson: 0.5,
                    ..soil()
                },
                "Poisson's ratio = 0.5 must be from 0 to below 0.5",
            ),
            (
                Soil {
                    poisson: -0.1,
                    ..soil()
                },
                "Poisson's ratio",
            ),
            (
                Soil {
                    density: 0.0,
                    ..soil()
                },
                "density = 0 must be greater than zero",
            ),
        ] {
            let error = told(soil.springs().unwrap_err());
            assert!(error.contains(says), "{error}");
        }
        let held = Some(BESIDE);
        let error = told(Foundation::new(1e5, 0.0, None, held).unwrap_err());
        assert!(error.contains("rock needs a rotational inertia"), "{error}");
        let error = told(Foundation::new(0.0, 1e5, held, None).unwrap_err());
        assert!(error.contains("sway needs a mass"), "{error}");
        let error = told(Foundation::new(1e5, 1e5, None, None).unwrap_err());
        assert!(error.contains("neither sways nor rocks"), "{error}");
        let error = told(Foundation::on_soil(1e5, 0.0, &soil()).unwrap_err());
        assert!(error.contains("rotational inertia"), "{error}");
        let soft = Some(SpringDashpot {
            dashpot: -1.0,
            ..BESIDE
        });
        let error = told(Foundation::new(1e5, 1e5, soft, None).unwrap_err());
        assert!(error.contains("sway dashpot = -1"), "{error}");
    }
}
