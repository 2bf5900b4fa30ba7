//! What codes have of the values of `[separation]` and of design spectra: one outside is more often
//! a mistake.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;
use pounding_ground_motion::spectra::design::CodeSpectrum;

use super::Separation;

/// The usual range of a key of `[separation]`.
struct Usual {
    key: &'static str,
    bounds: Bounds,
    /// Its values, of one building after the other where it has one for each.
    given: fn(&Separation) -> &[f64],
}

/// What codes have of a value.
#[derive(Clone, Copy)]
struct Bounds {
    /// Least and most usual value, in the unit of the kind.
    range: (f64, f64),
    kind: Kind,
}

/// What a value is.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// A pure number.
    Number,
    /// An acceleration (m/s2), whose range is in g.
    Acceleration,
    /// A time (s).
    Time,
    /// A length of a building (m).
    Length,
}

const USUAL: [Usual; 11] = [
    Usual {
        key: "response_modification",
        bounds: Bounds::of((1.0, 12.0), Kind::Number),
        given: |s| s.response_modification.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "displacement_amplification",
        bounds: Bounds::of((1.0, 12.0), Kind::Number),
        given: |s| s.displacement_amplification.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "importance",
        bounds: Bounds::of((0.5, 2.0), Kind::Number),
        given: |s| s.importance.as_deref().unwrap_or_default(),
    },
    Usual {
        // Below 0.05 g EN 1998-1, 3.2.1(5), need not be observed at all.
        key: "design_ground_acceleration",
        bounds: Bounds::of((0.05, 2.0), Kind::Acceleration),
        given: |s| s.design_ground_acceleration.as_slice(),
    },
    Usual {
        // S_M1 is 1.5 times S_D1, which below 0.067 g has no design but the least.
        key: "spectral_acceleration_1s",
        bounds: Bounds::of((0.1, 4.0), Kind::Acceleration),
        given: |s| s.spectral_acceleration_1s.as_slice(),
    },
    Usual {
        key: "seismic_coefficient",
        bounds: Bounds::of((0.0, 1.0), Kind::Number),
        given: |s| s.seismic_coefficient.as_slice(),
    },
    Usual {
        key: "isolation_damping_coefficient",
        bounds: Bounds::of((0.8, 2.0), Kind::Number),
        given: |s| {
            s.isolation_damping_coefficient
                .as_deref()
                .unwrap_or_default()
        },
    },
    Usual {
        key: "isolation_period",
        bounds: Bounds::of((0.0, 10.0), Kind::Time),
        given: |s| s.isolation_period.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "yield_amplification",
        bounds: Bounds::of((1.0, 2.0), Kind::Number),
        given: |s| s.yield_amplification.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "plan_length",
        bounds: Bounds::of(PLAN, Kind::Length),
        given: |s| s.plan_length.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "plan_width",
        bounds: Bounds::of(PLAN, Kind::Length),
        given: |s| s.plan_width.as_deref().unwrap_or_default(),
    },
];

/// Least number that is usual in g.
const LEAST_IN_GRAVITY: f64 = 0.02;

/// What is said of an acceleration (m/s2) without a unit that is below what is usual (g).
pub(super) fn bare_acceleration(what: &str, value: f64, least: f64) -> Option<String> {
    let meant = LEAST_IN_GRAVITY..least * STANDARD_GRAVITY;
    meant.contains(&value).then(|| {
        let number = six_digits(value);
        format!(
            "{what} is {}, little for a strong motion; a number without unit is in m/s2: was \"{number} g\" meant? If not, write \"{number} m/s2\"",
            Kind::Acceleration.shown(value)
        )
    })
}

/// Peak ground velocity (m/s) that no record has.
const NO_GROUND_VELOCITY: f64 = 5.0;

/// What is said of a velocity of the ground (m/s) without a unit that no ground reaches.
pub(super) fn bare_ground_velocity(what: &str, value: f64) -> Option<String> {
    (value > NO_GROUND_VELOCITY).then(|| {
        let number = six_digits(value);
        format!("{what} is {number} m/s, which no ground reaches: was \"{number} cm/s\" meant?")
    })
}

/// Width (m) of a gap from which on a number without a unit was more often meant in another one.
const WIDE_GAP: f64 = 1.0;
/// Number from which on the width of a gap was meant in millimetres.
const MANY_MILLIMETRES: f64 = 20.0;

/// What is said of the width of a gap (m) without a unit that hardly a joint has.
pub(super) fn bare_gap_width(what: &str, value: f64) -> Option<String> {
    (value >= WIDE_GAP).then(|| {
        let number = six_digits(value);
        let meant = match value < MANY_MILLIMETRES {
            true => format!("\"{number} cm\" or \"{number} in\""),
            false => format!("\"{number} mm\""),
        };
        format!(
            "{what} {number} m, wide for a joint; a number without unit is in m: was {meant} meant? If not, write \"{number} m\""
        )
    })
}

/// Dimensions in plan (m) of buildings.
const PLAN: (f64, f64) = (1.0, 1000.0);

/// A warning for each key with a value that no code has.
pub(super) fn warnings(separation: &Separation) -> Vec<String> {
    let of_ranges = USUAL.iter().filter_map(|usual| usual.warning(separation));
    of_ranges.chain(eccentricity(separation)).collect()
}

/// A warning for each parameter of the spectrum of a code that no code has.
pub(super) fn of_spectrum(spectrum: &CodeSpectrum) -> Vec<String> {
    let acceleration = |range| Bounds::of(range, Kind::Acceleration);
    let parameters = match spectrum {
        CodeSpectrum::Eurocode8Of2004(of) => {
            vec![("ag", of.ground_acceleration, acceleration((0.05, 2.0)))]
        }
        // Below both of the least values ASCE 7, 11.6, asks for no seismic design but the least.
        CodeSpectrum::Asce7Of2016(of) => vec![
            ("s_ds", of.short_period, acceleration((0.167, 4.0))),
            ("s_d1", of.one_second, acceleration((0.067, 4.0))),
        ],
    };
    let unusual = parameters
        .iter()
        .filter(|(_, value, bounds)| !bounds.holds(*value));
    unusual
        .map(|(key, value, bounds)| {
            let place = format!("the spectrum of {}", spectrum.name());
            bounds.warning(key, &place, *value, "")
        })
        .collect()
}

impl Usual {
    fn warning(&self, separation: &Separation) -> Option<String> {
        let given = (self.given)(separation);
        let mut places = given.iter().enumerate();
        let (place, value) = places.find(|(_, v)| !self.bounds.holds(**v))?;
        let of = whose(given, place);
        Some(self.bounds.warning(self.key, "[separation]", *value, &of))
    }
}

impl Bounds {
    const fn of(range: (f64, f64), kind: Kind) -> Self {
        Self { range, kind }
    }

    fn holds(&self, value: f64) -> bool {
        let (least, most) = self.range;
        let unit = self.kind.unit();
        // A range that is written in g ends where "2 g" does.
        (least * unit..=most * unit).contains(&value)
    }

    /// What is said of a value outside that stands at a key of a place.
    fn warning(&self, key: &str, place: &str, value: f64, of: &str) -> String {
        let shown = self.kind.shown(value);
        let range = self.kind.range(self.range);
        let meant = self.meant(value);
        let meant = meant.map_or(String::new(), |meant| format!("; {meant}"));
        let usual = match self.kind {
            Kind::Length => "buildings have",
            _ => "in codes",
        };
        format!("`{key}` of {place} is {shown}{of}, and {usual} {range}{meant}")
    }

    /// What was probably meant.
    fn meant(&self, value: f64) -> Option<String> {
        let (least, _) = self.range;
        let low = value < least * self.kind.unit();
        match self.kind {
            Kind::Number if low => {
                let inverse = 1.0 / value;
                self.holds(inverse)
                    .then(|| format!("its inverse is {}", six_digits(inverse)))
            }
            Kind::Number if self.holds(value / 100.0) => {
                let factor = six_digits(value / 100.0);
                Some(format!("a percentage is written as a factor, {factor}"))
            }
            Kind::Number => self.holds(value / 10.0).then(|| {
                let point = six_digits(value / 10.0);
                format!("with a decimal point it is {point}")
            }),
            Kind::Acceleration if low => self.holds(value * STANDARD_GRAVITY).then(|| {
                let number = six_digits(value);
                format!("if it has no unit, which is m/s2, was \"{number} g\" meant?")
            }),
            Kind::Acceleration => self.holds(value / 100.0).then(|| {
                let number = six_digits(value);
                format!("if it has no unit, which is m/s2, was \"{number} cm/s2\" meant?")
            }),
            Kind::Time => self.holds(value / 1000.0).then(|| {
                let number = six_digits(value);
                format!("if it has no unit, which is s, was \"{number} ms\" meant?")
            }),
            Kind::Length => self.holds(value / 1000.0).then(|| {
                let number = six_digits(value);
                format!("if it has no unit, which is m, was \"{number} mm\" meant?")
            }),
        }
    }
}

impl Kind {
    /// The unit of its range, in SI.
    fn unit(self) -> f64 {
        match self {
            Self::Acceleration => STANDARD_GRAVITY,
            Self::Number | Self::Time | Self::Length => 1.0,
        }
    }

    fn shown(self, value: f64) -> String {
        let number = six_digits(value);
        match self {
            Self::Number => number,
            Self::Time => format!("{number} s"),
            Self::Length => format!("{number} m"),
            Self::Acceleration => {
                let of_gravity = six_digits(value / STANDARD_GRAVITY);
                format!("{number} m/s2 ({of_gravity} g)")
            }
        }
    }

    fn range(self, (least, most): (f64, f64)) -> String {
        let unit = match self {
            Self::Number => "",
            Self::Time => " s",
            Self::Length => " m",
            Self::Acceleration => " g",
        };
        match least == 0.0 {
            true => format!("at most {most}{unit}"),
            false => format!("{least}{unit} to {most}{unit}"),
        }
    }
}

/// Of which building a value is, where others differ.
fn whose(given: &[f64], place: usize) -> String {
    match given.iter().all(|v| *v == given[place]) {
        true => String::new(),
        false => format!(" for building {}", place + 1),
    }
}

/// An eccentricity that puts the mass beside the building.
fn eccentricity(separation: &Separation) -> Option<String> {
    let given = separation.plan_eccentricity.as_deref()?;
    let longest = separation.plan_length.as_ref();
    let longest = longest.or(separation.plan_width.as_ref())?;
    let both = given.iter().zip(longest);
    let (place, (e, length)) = both.enumerate().find(|(_, (e, l))| **e > 0.5 * **l)?;
    Some(format!(
        "`plan_eccentricity` of [separation] is {} m{}, more than half of the plan of {} m: the mass would stand beside the building; it is a length, 0.05 of the plan for the accidental part",
        six_digits(*e),
        whose(given, place),
        six_digits(*length),
    ))
}
