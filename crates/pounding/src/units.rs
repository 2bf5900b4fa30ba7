//! Quantities with units, so that a mass cannot be taken for a stiffness.

use pounding_catalogue::STANDARD_GRAVITY;

/// Declares quantities: their SI unit, and the units that they may be given in. Parts of a unit
/// are divided by, so that 9 mm is the number nearest to 0.009 m.
macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident($si:ident) { $($(#[$unit_doc:meta])* $unit:ident: $factor:tt $(/ $divisor:literal)?),+ $(,)? })+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
        pub struct $name(f64);

        impl $name {
            $(
                $(#[$unit_doc])*
                #[must_use]
                pub const fn $unit(value: f64) -> Self {
                    Self(value * $factor $(/ $divisor)?)
                }
            )+

            /// The value in the SI unit.
            #[must_use]
            pub const fn si(self) -> f64 {
                self.0
            }
        }
    )+};
}

quantities! {
    /// Mass of a floor; SI unit kg.
    Mass(kilograms) {
        /// In kg.
        kilograms: 1.0,
        /// In t, 1000 kg.
        tonnes: 1.0e3,
    }
    /// Stiffness of a storey; SI unit N/m.
    Stiffness(newtons_per_metre) {
        /// In N/m.
        newtons_per_metre: 1.0,
        /// In kN/m.
        kilonewtons_per_metre: 1.0e3,
        /// In MN/m.
        meganewtons_per_metre: 1.0e6,
    }
    /// Height of a storey, width of a gap, displacement; SI unit m.
    Length(metres) {
        /// In m.
        metres: 1.0,
        /// In cm.
        centimetres: 1.0 / 1.0e2,
        /// In mm.
        millimetres: 1.0 / 1.0e3,
    }
    /// Velocity of a floor; SI unit m/s.
    Velocity(metres_per_second) {
        /// In m/s.
        metres_per_second: 1.0,
        /// In cm/s.
        centimetres_per_second: 1.0 / 1.0e2,
    }
    /// Duration, step; SI unit s.
    Time(seconds) {
        /// In s.
        seconds: 1.0,
        /// In ms.
        milliseconds: 1.0 / 1.0e3,
    }
    /// Ground acceleration; SI unit m/s2.
    Acceleration(metres_per_second_squared) {
        /// In m/s2.
        metres_per_second_squared: 1.0,
        /// In standard gravities (9.80665 m/s2). The product is rounded: a case file, whose `0.35 g` is the
        /// number nearest to the decimal product, may have another last digit.
        gravities: STANDARD_GRAVITY,
    }
}
