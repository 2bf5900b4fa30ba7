//! When a contact is over.

/// When a contact is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SeparationRule {
    /// At zero penetration; the law may pull shortly before.
    ZeroPenetration,
    /// `max(0, F)`: at zero force the floors stop acting on one another
    /// ([`Phase::Released`](crate::Phase::Released)), and act again as soon as the law would push; the
    /// contact is over at zero penetration.
    NoTension,
    /// At zero force the floors stop acting on one another and stay so until
    /// they approach once more or part at zero penetration.
    NoTensionLatched,
    /// At zero force the contact is over, and the penetration left then widens
    /// the gap for all later impacts, as a plastic deformation would.
    GapShift,
}

impl SeparationRule {
    /// All rules.
    pub const ALL: [Self; 4] = [
        Self::ZeroPenetration,
        Self::NoTension,
        Self::NoTensionLatched,
        Self::GapShift,
    ];

    /// Name in the case file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::ZeroPenetration => "zero_penetration",
            Self::NoTension => "no_tension",
            Self::NoTensionLatched => "no_tension_latched",
            Self::GapShift => "gap_shift",
        }
    }

    /// The rule of this name in the case file.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|rule| rule.name() == name)
    }

    /// Whether the contact stops acting at zero force.
    #[must_use]
    pub fn forbids_tension(self) -> bool {
        self != Self::ZeroPenetration
    }
}
