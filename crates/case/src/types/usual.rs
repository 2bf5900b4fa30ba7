//! What codes have of the values of `[separation]`: one outside is more often a mistake.

use pounding_catalogue::STANDARD_GRAVITY;
use pounding_catalogue::numbers::six_digits;

use super::Separation;

/// The usual range of a key.
struct Usual {
    key: &'static str,
    /// Least and most usual value, in the unit of the kind.
    range: (f64, f64),
    kind: Kind,
    /// Its values, of one building after the other where it has one for each.
    given: fn(&Separation) -> &[f64],
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
}

const USUAL: [Usual; 8] = [
    Usual {
        key: "response_modification",
        range: (1.0, 12.0),
        kind: Kind::Number,
        given: |s| s.response_modification.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "displacement_amplification",
        range: (1.0, 12.0),
        kind: Kind::Number,
        given: |s| s.displacement_amplification.as_deref().unwrap_or_default(),
    },
    Usual {
        key: "importance",
        range: (0.5, 2.0),
        kind: Kind::Number,
        given: |s| s.importance.as_deref().unwrap_or_default(),
    },
    Usual {
        // Below 0.05 g EN 1998-1, 3.2.1(5), need not be observed at all.
        key: "design_ground_acceleration",
        range: (0.05, 2.0),
        kind: Kind::Acceleration,
        given: |s| s.design_ground_acceleration.as_slice(),
    },
    Usual {
        key: "spectral_acceleration_1s",
        range: (0.05, 4.0),
        kind: Kind::Acceleration,
        given: |s| s.spectral_acceleration_1s.as_slice(),
    },
    Usual {
        key: "seismic_coefficient",
        range: (0.0, 1.0),
        kind: Kind::Number,
        given: |s| s.seismic_coefficient.as_slice(),
    },
    Usual {
        key: "isolation_damping_coefficient",
        range: (0.8, 2.0),
        kind: Kind::Number,
        given: |s| {
            s.isolation_damping_coefficient
                .as_deref()
                .unwrap_or_default()
        },
    },
    Usual {
        key: "isolation_period",
        range: (0.0, 10.0),
        kind: Kind::Time,
        given: |s| s.isolation_period.as_deref().unwrap_or_default(),
    },
];

/// A warning for each key with a value that no code has.
pub(super) fn warnings(separation: &Separation) -> Vec<String> {
    let of_ranges = USUAL.iter().filter_map(|usual| usual.warning(separation));
    of_ranges.chain(eccentricity(separation)).collect()
}

impl Usual {
    fn holds(&self, value: f64) -> bool {
        let (least, most) = self.range;
        let unit = self.kind.unit();
        // A range that is written in g ends where "2 g" does.
        (least * unit..=most * unit).contains(&value)
    }

    fn warning(&self, separation: &Separation) -> Option<String> {
        let given = (self.given)(separation);
        let (place, value) = given.iter().enumerate().find(|(_, v)| !self.holds(**v))?;
        let of = whose(given, place);
        let shown = self.kind.shown(*value);
        let key = self.key;
        let range = self.kind.range(self.range);
        let meant = self.meant(*value);
        let meant = meant.map_or(String::new(), |meant| format!("; {meant}"));
        Some(format!(
            "`{key}` of [separation] is {shown}{of}, and in codes {range}{meant}"
        ))
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
                format!("a number without unit is in m/s2: was \"{number} g\" meant?")
            }),
            Kind::Acceleration => self.holds(value / 100.0).then(|| {
                let number = six_digits(value);
                format!("a number without unit is in m/s2: was \"{number} cm/s2\" meant?")
            }),
            Kind::Time => self.holds(value / 1000.0).then(|| {
                let number = six_digits(value);
                format!("a number without unit is in s: was \"{number} ms\" meant?")
            }),
        }
    }
}

impl Kind {
    /// The unit of its range, in SI.
    fn unit(self) -> f64 {
        match self {
            Self::Acceleration => STANDARD_GRAVITY,
            Self::Number | Self::Time => 1.0,
        }
    }

    fn shown(self, value: f64) -> String {
        let number = six_digits(value);
        match self {
            Self::Number => number,
            Self::Time => format!("{number} s"),
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
