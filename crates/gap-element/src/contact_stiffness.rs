//! Where a contact stiffness comes from: five ways to a number, each with its
//! source and with warnings where it does not hold. Pure functions, SI units.

use crate::classes::elastic_time_factor;
use crate::descriptor::Verification;

/// A contact stiffness and what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactStiffness {
    /// Stiffness `k` of `F = k delta^n` (N/m^n).
    pub value: f64,
    /// Exponent `n` of the law that it belongs to (-).
    pub exponent: f64,
    /// Author, year, journal.
    pub source: &'static str,
    /// How far it has been checked.
    pub status: Verification,
    /// What was computed on the way or follows from it.
    pub intermediate: Vec<Intermediate>,
    /// Where the number does not hold.
    pub warnings: Vec<String>,
}

/// A quantity computed on the way to a stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Intermediate {
    /// Name, spelled out.
    pub name: &'static str,
    /// Value in the unit.
    pub value: f64,
    /// SI unit.
    pub unit: &'static str,
}

/// What cannot be turned into a stiffness.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactStiffnessError {
    /// A quantity that is negative, zero or not a finite number.
    #[error("{quantity} = {value} {unit}, but it must be finite and greater than zero")]
    NotPositive {
        /// The quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// SI unit.
        unit: &'static str,
    },
    /// A quantity outside its range.
    #[error("{quantity} = {value} is outside {range}")]
    OutOfRange {
        /// The quantity.
        quantity: &'static str,
        /// Value (SI).
        value: f64,
        /// Allowed range.
        range: &'static str,
    },
    /// Two flat bodies, which Hertz's theory does not cover.
    #[error("both bodies are flat, and flat on flat is not a Hertz contact")]
    BothFlat,
    /// A result too large or too small for a number.
    #[error("{quantity} comes out as {value}: the input is too large or too small")]
    NotRepresentable {
        /// The quantity.
        quantity: &'static str,
        /// What came out (SI).
        value: f64,
    },
}

impl ContactStiffnessError {
    /// What to do about it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::BothFlat => "slab against slab is linear: see `pounding stiffness slab`",
            Self::OutOfRange { quantity, .. } => match *quantity {
                "Poisson's ratio" => "concrete has about 0.2, steel 0.3, rubber 0.5",
                "exponent" => "1 is a linear law, 1.5 that of Hertz",
                "factor" => "20 is customary, 10 to 100 are in use",
                _ => "restitution is 1 for an elastic impact, 0.65 is customary for concrete",
            },
            Self::NotPositive { .. } | Self::NotRepresentable { .. } => {
                "check the value and its unit; plain numbers are SI"
            }
        }
        .to_owned()
    }
}

impl ContactStiffness {
    /// Unit of the value: `N/m`, or `N/m^n` with the exponent in figures.
    #[must_use]
    pub fn unit(&self) -> String {
        if self.exponent == 1.0 {
            "N/m".to_owned()
        } else {
            format!("N/m^{}", self.exponent)
        }
    }

    /// The line for a gap of a case file. All digits: it reads back as the value.
    #[must_use]
    pub fn case_line(&self) -> String {
        format!("stiffness = \"{:e} {}\"", self.value, self.unit())
    }

    /// Refuses numbers that no run could use.
    fn checked(self) -> Result<Self, ContactStiffnessError> {
        let quantities = self.intermediate.iter().map(|i| (i.name, i.value));
        for (quantity, value) in quantities.chain([("stiffness", self.value)]) {
            if !(value.is_normal() && value > 0.0) {
                return Err(ContactStiffnessError::NotRepresentable { quantity, value });
            }
        }
        Ok(self)
    }
}

/// An elastic sphere, or the curved face of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    /// Radius (m); infinite is a flat half-space.
    pub radius: f64,
    /// Young's modulus (Pa).
    pub elastic_modulus: f64,
    /// Poisson's ratio (-), in (-1, 0.5].
    pub poisson_ratio: f64,
    /// Density (kg/m^3) for the check of waves; `None`: not checked.
    pub density: Option<f64>,
}

/// A floor slab in the direction of impact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slab {
    /// Young's modulus (Pa).
    pub elastic_modulus: f64,
    /// Area of the cross-section that takes the impact (m^2).
    pub area: f64,
    /// Length in the direction of impact (m).
    pub length: f64,
}

/// How two floors meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Approach {
    /// Relative velocity at closure (m/s).
    pub velocity: f64,
    /// `m1 m2 / (m1 + m2)` of the two floors (kg).
    pub effective_mass: f64,
}

impl Approach {
    /// From the velocity (m/s) and both masses (kg); `None` is a rigid wall.
    ///
    /// # Errors
    /// A velocity or mass that is not positive.
    pub fn new(
        velocity: f64,
        mass_left: f64,
        mass_right: Option<f64>,
    ) -> Result<Self, ContactStiffnessError> {
        positive("left mass", mass_left, "kg")?;
        let effective_mass = match mass_right {
            None => mass_left,
            Some(right) => {
                positive("right mass", right, "kg")?;
                let light = mass_left.min(right);
                light / (1.0 + light / mass_left.max(right))
            }
        };
        Self {
            velocity,
            effective_mass,
        }
        .checked()
    }

    fn checked(self) -> Result<Self, ContactStiffnessError> {
        positive("approach velocity", self.velocity, "m/s")?;
        positive("effective mass", self.effective_mass, "kg")?;
        Ok(self)
    }

    /// Greatest penetration (m) of the elastic law with this stiffness.
    fn penetration(&self, stiffness: f64, exponent: f64) -> f64 {
        let power = exponent + 1.0;
        (0.5 * power * self.effective_mass * self.velocity * self.velocity / stiffness)
            .powf(1.0 / power)
    }

    /// Stiffness (N/m^n) that stops the floors at this penetration (m).
    fn stiffness(&self, penetration: f64, exponent: f64) -> f64 {
        let power = exponent + 1.0;
        0.5 * power * self.effective_mass * self.velocity * self.velocity / penetration.powf(power)
    }

    /// Contact time (s) of the elastic law that penetrates this far (m).
    fn duration(&self, penetration: f64, exponent: f64) -> f64 {
        2.0 * elastic_time_factor(exponent) * penetration / self.velocity
    }
}

/// Least ratio of contact time to wave transit at which waves are taken to have
/// died away during the contact (the assumption of a quasi-static contact).
const LEAST_WAVE_TRANSITS: f64 = 10.0;
/// Greatest contact radius as a part of the effective radius of curvature for
/// which surfaces count as half-spaces.
const GREATEST_CONTACT_RADIUS: f64 = 0.1;
/// Least ratio of contact to storey stiffness that is customary.
const LEAST_STOREY_RATIO: f64 = 5.0;
/// Customary factor of [`multiple`] (Anagnostopoulos 1988).
pub const CUSTOMARY_MULTIPLE: f64 = 20.0;
/// Least and greatest factor of [`multiple`] in use.
pub const MULTIPLES_IN_USE: (f64, f64) = (10.0, 100.0);

/// Two elastic spheres: `k = 4/3 E* sqrt(R*)` in N/m^1.5, with
/// `1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2` and `1/R* = 1/R1 + 1/R2` (Hertz 1882).
///
/// # Errors
/// Radii, moduli, ratios or densities out of range, or two flat bodies.
pub fn hertz(
    left: &Sphere,
    right: &Sphere,
    approach: Option<Approach>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let compliance = sphere_compliance(left)? + sphere_compliance(right)?;
    if left.radius.is_infinite() && right.radius.is_infinite() {
        return Err(ContactStiffnessError::BothFlat);
    }
    let modulus = 1.0 / compliance;
    let radius = 1.0 / (1.0 / left.radius + 1.0 / right.radius);
    let mut result = ContactStiffness {
        value: 4.0 / 3.0 * modulus * radius.sqrt(),
        exponent: 1.5,
        source: "Hertz, J. reine angew. Math. 92 (1882) 156",
        status: Verification::Verified("independent evaluation of the formula, 1e-10"),
        intermediate: vec![
            quantity("effective modulus", modulus, "Pa"),
            quantity("effective radius", radius, "m"),
        ],
        warnings: vec![
            "holds for curved bodies only: flat-on-flat contact of slabs is not Hertzian (there n = 1)".to_owned(),
        ],
    };
    if let Some(approach) = approach {
        hertz_limits(&mut result, [left, right], radius, approach.checked()?);
    }
    result.checked()
}

/// `(1 - nu^2) / E` (1/Pa).
fn sphere_compliance(sphere: &Sphere) -> Result<f64, ContactStiffnessError> {
    if sphere.radius != f64::INFINITY {
        positive("radius", sphere.radius, "m")?;
    }
    positive("elastic modulus", sphere.elastic_modulus, "Pa")?;
    if let Some(density) = sphere.density {
        positive("density", density, "kg/m^3")?;
    }
    let ratio = sphere.poisson_ratio;
    if !(ratio > -1.0 && ratio <= 0.5) {
        return Err(ContactStiffnessError::OutOfRange {
            quantity: "Poisson's ratio",
            value: ratio,
            range: "(-1, 0.5]",
        });
    }
    Ok((1.0 - ratio * ratio) / sphere.elastic_modulus)
}

/// Warns where the contact is too fast or too wide for Hertz's assumptions.
fn hertz_limits(
    result: &mut ContactStiffness,
    bodies: [&Sphere; 2],
    radius: f64,
    approach: Approach,
) {
    let penetration = approach.penetration(result.value, result.exponent);
    let duration = approach.duration(penetration, result.exponent);
    let contact_radius = (radius * penetration).sqrt();
    result.intermediate.extend([
        quantity("greatest penetration", penetration, "m"),
        quantity("contact time", duration, "s"),
        quantity("contact radius", contact_radius, "m"),
    ]);
    // No wave returns from a half-space.
    let transit = |b: &Sphere| {
        let density = b.density.filter(|_| b.radius.is_finite())?;
        Some(2.0 * b.radius / (b.elastic_modulus / density).sqrt())
    };
    let slowest = bodies.into_iter().filter_map(transit).reduce(f64::max);
    if let Some(transit) = slowest {
        result
            .intermediate
            .push(quantity("wave transit time", transit, "s"));
        if duration < LEAST_WAVE_TRANSITS * transit {
            result.warnings.push(format!(
                "the contact lasts {:.3} times as long as a wave takes through the larger body, not {LEAST_WAVE_TRANSITS} times: waves carry energy away, which Hertz's theory leaves out",
                duration / transit
            ));
        }
    }
    if contact_radius > GREATEST_CONTACT_RADIUS * radius {
        result.warnings.push(format!(
            "the contact radius reaches {:.3} times the effective radius, more than {GREATEST_CONTACT_RADIUS}: the bodies are no half-spaces there",
            contact_radius / radius
        ));
    }
}

/// Axial stiffness of two slabs in series, `1/k = L1/(E1 A1) + L2/(E2 A2)` in N/m
/// (Maison and Kasai 1990, 1992). The storey stiffness (N/m) of the stiffer
/// building, if given, is compared with it.
///
/// # Errors
/// Quantities that are not positive.
pub fn slab(
    left: &Slab,
    right: &Slab,
    storey_stiffness: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let (first, second) = (axial_stiffness(left)?, axial_stiffness(right)?);
    let value = 1.0 / (1.0 / first + 1.0 / second);
    let mut warnings =
        vec!["a stiffness for linear laws only (n = 1), such as linear_elastic".to_owned()];
    if let Some(storey) = storey_stiffness {
        positive("storey stiffness", storey, "N/m")?;
        if value < LEAST_STOREY_RATIO * storey {
            warnings.push(format!(
                "only {:.3} times the storey stiffness, softer than customary ({LEAST_STOREY_RATIO} times and more): penetration will not be small",
                value / storey
            ));
        }
    }
    ContactStiffness {
        value,
        exponent: 1.0,
        source: "Axial stiffness of the floors: Maison and Kasai, Earthquake Spectra 6 (1990) 711; EESD 21 (1992) 771",
        status: Verification::SecondarySources("EA/L is textbook statics; its use for pounding is not checked against the papers"),
        intermediate: vec![
            quantity("left slab stiffness", first, "N/m"),
            quantity("right slab stiffness", second, "N/m"),
        ],
        warnings,
    }
    .checked()
}

fn axial_stiffness(slab: &Slab) -> Result<f64, ContactStiffnessError> {
    positive("elastic modulus", slab.elastic_modulus, "Pa")?;
    positive("cross-section area", slab.area, "m^2")?;
    positive("slab length", slab.length, "m")?;
    Ok(slab.elastic_modulus * slab.area / slab.length)
}

/// Stiffness (N/m^n) of the elastic law `F = k delta^n` whose contact lasts so
/// long (s): `delta_max = T v0 / (2 I_n)` from the contact time of the power law,
/// `T = 2 I_n delta_max / v0`. For n = 1 it is `m (pi / T)^2`. The restitution (-)
/// of the law meant, if it is known, decides whether damping is warned of.
///
/// # Errors
/// Quantities that are not positive, an exponent outside [1, 10].
pub fn duration(
    wanted: f64,
    exponent: f64,
    approach: Approach,
    restitution: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    positive("contact time", wanted, "s")?;
    let penetration = wanted * approach.checked()?.velocity / (2.0 * power_time(exponent)?);
    let mut warnings = Vec::new();
    if exponent != 1.0 {
        warnings.push(format!(
            "holds at {} m/s only: the contact time of a law with n = {exponent} changes with the approach velocity",
            approach.velocity
        ));
    }
    if damped(restitution)? {
        warnings.push("holds without damping: the contact of a damped law lasts differently, see `pounding impact`".to_owned());
    }
    from_penetration(penetration, exponent, approach, warnings)
}

/// Stiffness (N/m^n) of the elastic law `F = k delta^n` that stops the floors at
/// this penetration (m): `k = (n + 1) m v0^2 / (2 delta_max^(n + 1))`, energy
/// conservation. Restitution (-) and gap width (m), if known, decide on warnings.
///
/// # Errors
/// Quantities that are not positive, an exponent outside [1, 10].
pub fn penetration(
    wanted: f64,
    exponent: f64,
    approach: Approach,
    restitution: Option<f64>,
    gap_width: Option<f64>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    positive("greatest penetration", wanted, "m")?;
    approach.checked()?;
    power_time(exponent)?;
    let mut warnings = Vec::new();
    if damped(restitution)? {
        warnings.push("holds without damping: a damped law penetrates less".to_owned());
    }
    if let Some(width) = gap_width {
        positive("gap width", width, "m")?;
        if wanted > width {
            warnings.push(format!(
                "the penetration of {wanted} m exceeds the gap of {width} m: the floors would overlap by more than they are apart"
            ));
        }
    }
    from_penetration(wanted, exponent, approach, warnings)
}

/// What [`duration`] and [`penetration`] share.
fn from_penetration(
    penetration: f64,
    exponent: f64,
    approach: Approach,
    warnings: Vec<String>,
) -> Result<ContactStiffness, ContactStiffnessError> {
    let value = approach.stiffness(penetration, exponent);
    ContactStiffness {
        value,
        exponent,
        source: "Energy and contact time of the elastic power law, closed form",
        status: Verification::Verified(
            "integrated collisions of linear_elastic and hertz_1882, 1e-9",
        ),
        intermediate: vec![
            quantity("effective mass", approach.effective_mass, "kg"),
            quantity("greatest penetration", penetration, "m"),
            quantity(
                "contact time",
                approach.duration(penetration, exponent),
                "s",
            ),
            quantity("greatest force", value * penetration.powf(exponent), "N"),
        ],
        warnings,
    }
    .checked()
}

/// A multiple of the lateral storey stiffness (N/m) of the stiffer building
/// (Anagnostopoulos 1988: about 20 times), in N/m.
///
/// # Errors
/// Quantities that are not positive.
pub fn multiple(
    factor: f64,
    storey_stiffness: f64,
) -> Result<ContactStiffness, ContactStiffnessError> {
    if !(factor.is_finite() && factor > 0.0) {
        return Err(ContactStiffnessError::OutOfRange {
            quantity: "factor",
            value: factor,
            range: "(0, inf)",
        });
    }
    positive("storey stiffness", storey_stiffness, "N/m")?;
    let (least, greatest) = MULTIPLES_IN_USE;
    let mut warnings = Vec::new();
    if !(least..=greatest).contains(&factor) {
        warnings.push(format!(
            "a factor of {factor} is outside the range in use, {least} to {greatest}"
        ));
    }
    ContactStiffness {
        value: factor * storey_stiffness,
        exponent: 1.0,
        source: "About 20 times the lateral stiffness of the stiffer building: Anagnostopoulos, EESD 16 (1988) 443",
        status: Verification::SecondarySources("rule of thumb, not checked against the paper"),
        intermediate: Vec::new(),
        warnings,
    }
    .checked()
}

fn quantity(name: &'static str, value: f64, unit: &'static str) -> Intermediate {
    Intermediate { name, value, unit }
}

fn positive(
    quantity: &'static str,
    value: f64,
    unit: &'static str,
) -> Result<(), ContactStiffnessError> {
    if value.is_finite() && value > 0.0 {
        return Ok(());
    }
    Err(ContactStiffnessError::NotPositive {
        quantity,
        value,
        unit,
    })
}

/// `I_n` after a check of the exponent: below 1 the force would start infinitely
/// stiff, and published laws end at about 2.5.
fn power_time(exponent: f64) -> Result<f64, ContactStiffnessError> {
    if (1.0..=10.0).contains(&exponent) {
        return Ok(elastic_time_factor(exponent));
    }
    Err(ContactStiffnessError::OutOfRange {
        quantity: "exponent",
        value: exponent,
        range: "[1, 10]",
    })
}

/// Whether the law meant may have damping: unless its restitution is 1.
fn damped(restitution: Option<f64>) -> Result<bool, ContactStiffnessError> {
    match restitution {
        Some(value) if !(value > 0.0 && value <= 1.0) => Err(ContactStiffnessError::OutOfRange {
            quantity: "restitution",
            value,
            range: "(0, 1]",
        }),
        given => Ok(given != Some(1.0)),
    }
}
