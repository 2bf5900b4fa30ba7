//! What provisions need to know of two structures and their site.

/// An input that provisions may need.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Input {
    /// Peak displacement at the level.
    Displacement,
    /// `R`, `q`, `Rd Ro`, `R*`, `Ra`: what the code divides elastic forces by.
    ResponseModification,
    /// `Cd`.
    DisplacementAmplification,
    /// `I`, `Ie`.
    Importance,
    /// `alpha_y` of the code of Taiwan.
    YieldAmplification,
    /// Kind of structure.
    StructuralSystem,
    /// Whether the floors of both structures lie at equal elevations.
    FloorsAligned,
    /// Whether both structures belong to one owner.
    SameOwner,
    /// Fortification intensity of the Chinese code.
    FortificationIntensity,
    /// Zone I, II or III of Mexico City.
    SoilZone,
    /// `a_g S`.
    DesignGroundAcceleration,
    /// `alpha_h` of the Indian code.
    SeismicCoefficient,
    /// `S_M1` of ASCE 7.
    SpectralAccelerationAtOneSecond,
    /// Whether the neighbour has left its own distance from the property line.
    NeighbourHasGap,
    /// `T_M`: effective period of isolators.
    IsolationPeriod,
    /// `B_M`: what their damping divides displacements by.
    IsolationDampingCoefficient,
    /// Longest dimension in plan.
    PlanLength,
    /// Shortest dimension in plan.
    PlanWidth,
    /// Eccentricity in plan.
    PlanEccentricity,
}

impl Input {
    /// All inputs.
    pub const ALL: [Self; 19] = [
        Self::Displacement,
        Self::ResponseModification,
        Self::DisplacementAmplification,
        Self::Importance,
        Self::YieldAmplification,
        Self::StructuralSystem,
        Self::FloorsAligned,
        Self::SameOwner,
        Self::FortificationIntensity,
        Self::SoilZone,
        Self::DesignGroundAcceleration,
        Self::SeismicCoefficient,
        Self::SpectralAccelerationAtOneSecond,
        Self::NeighbourHasGap,
        Self::IsolationPeriod,
        Self::IsolationDampingCoefficient,
        Self::PlanLength,
        Self::PlanWidth,
        Self::PlanEccentricity,
    ];

    /// Name, which is its key in the table `[separation]` of a case.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::Displacement => "displacement",
            Self::ResponseModification => "response_modification",
            Self::DisplacementAmplification => "displacement_amplification",
            Self::Importance => "importance",
            Self::YieldAmplification => "yield_amplification",
            Self::StructuralSystem => "structural_system",
            Self::FloorsAligned => "floors_aligned",
            Self::SameOwner => "same_owner",
            Self::FortificationIntensity => "fortification_intensity",
            Self::SoilZone => "soil_zone",
            Self::DesignGroundAcceleration => "design_ground_acceleration",
            Self::SeismicCoefficient => "seismic_coefficient",
            Self::SpectralAccelerationAtOneSecond => "spectral_acceleration_1s",
            Self::NeighbourHasGap => "neighbour_has_gap",
            Self::IsolationPeriod => "isolation_period",
            Self::IsolationDampingCoefficient => "isolation_damping_coefficient",
            Self::PlanLength => "plan_length",
            Self::PlanWidth => "plan_width",
            Self::PlanEccentricity => "plan_eccentricity",
        }
    }

    /// What it is, with its unit.
    #[must_use]
    pub fn explanation(self) -> &'static str {
        match self {
            Self::Displacement => "peak displacement at the level, m",
            Self::ResponseModification => "R, q, Rd Ro, R* or Ra",
            Self::DisplacementAmplification => "Cd",
            Self::Importance => "importance factor I",
            Self::YieldAmplification => "alpha_y of the code of Taiwan",
            Self::StructuralSystem => "frame, frame_wall, wall, steel_frame or box_wall",
            Self::FloorsAligned => "true if all floors face floors",
            Self::SameOwner => "true if no property line lies in the gap",
            Self::FortificationIntensity => "6, 7, 8 or 9",
            Self::SoilZone => "I, II or III of Mexico City",
            Self::DesignGroundAcceleration => "a_g S, or Z S g of Peru, m/s2",
            Self::SeismicCoefficient => "alpha_h, -",
            Self::SpectralAccelerationAtOneSecond => {
                "S_M1 of the maximum considered earthquake, m/s2"
            }
            Self::NeighbourHasGap => {
                "true if the neighbour has left its own distance from the property line"
            }
            Self::IsolationPeriod => "effective period T_M of the isolators at D_M, s",
            Self::IsolationDampingCoefficient => "B_M of the damping of the isolators at D_M, -",
            Self::PlanLength => "longest dimension in plan d, m",
            Self::PlanWidth => "shortest dimension in plan b, m",
            Self::PlanEccentricity => {
                "eccentricity e of mass and isolators with the accidental 5 % of the plan length, m"
            }
        }
    }
}

/// Kind of structure, where a provision tells them apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum StructuralSystem {
    /// Reinforced-concrete frame.
    Frame,
    /// Reinforced-concrete frame with walls.
    FrameWall,
    /// Reinforced-concrete walls.
    Wall,
    /// Steel frame.
    SteelFrame,
    /// Box of load-bearing walls.
    BoxWall,
}

impl StructuralSystem {
    /// All kinds.
    pub const ALL: [Self; 5] = [
        Self::Frame,
        Self::FrameWall,
        Self::Wall,
        Self::SteelFrame,
        Self::BoxWall,
    ];

    /// Name in the case file.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Frame => "frame",
            Self::FrameWall => "frame_wall",
            Self::Wall => "wall",
            Self::SteelFrame => "steel_frame",
            Self::BoxWall => "box_wall",
        }
    }

    /// The kind of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|s| s.name() == name)
    }
}

/// Soil of Mexico City: firm, transition, lake bed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SoilZone {
    /// Zone I.
    One,
    /// Zone II.
    Two,
    /// Zone III.
    Three,
}

impl SoilZone {
    /// The zone of this name: I, II or III.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "I" => Some(Self::One),
            "II" => Some(Self::Two),
            "III" => Some(Self::Three),
            _ => None,
        }
    }

    /// The one of three values that belongs to this zone.
    pub(crate) fn choose(self, values: [f64; 3]) -> f64 {
        match self {
            Self::One => values[0],
            Self::Two => values[1],
            Self::Three => values[2],
        }
    }
}

/// One structure. What is not known is `None`; a provision that needs it says so.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Structure {
    /// Name, for messages.
    pub name: String,
    /// Height of the whole structure above ground (m).
    pub height: f64,
    /// Height above ground at which it meets the other one at the level (m): that of its own
    /// floor, or of where its column is hit.
    pub elevation: f64,
    /// Number of storeys.
    pub storeys: usize,
    /// Peak displacement at the level under the design motion, not reduced by `R` (m):
    /// what a time history or an unreduced spectrum gives. Where a code amplifies the
    /// displacement under reduced forces, that one is taken as `I u / R`.
    pub displacement: Option<f64>,
    /// Whether `displacement` comes from an analysis in which the structure yields. Rules
    /// that multiply elastic displacements do not hold for it, and say so.
    pub inelastic: bool,
    /// Displacement at the level under the reduced design forces of the code (m), where
    /// it is known itself. Taken instead of `I u / R`.
    pub elastic_displacement: Option<f64>,
    /// Whether `displacement` holds sway and rotation of the base: the structure stands on a
    /// foundation in the model.
    pub base_moves: bool,
    /// Whether it stands on isolators.
    pub on_isolators: bool,
    /// `R`, `q`, `Rd Ro`, `R*`, `Ra` (-).
    pub response_modification: Option<f64>,
    /// `Cd` (-).
    pub displacement_amplification: Option<f64>,
    /// Importance factor (-).
    pub importance: Option<f64>,
    /// `alpha_y` of the code of Taiwan (-).
    pub yield_amplification: Option<f64>,
    /// Kind of structure.
    pub system: Option<StructuralSystem>,
    /// `T_M`: effective period of its isolators at the displacement `D_M` (s).
    pub isolation_period: Option<f64>,
    /// `B_M`: what the damping of the isolators divides that displacement by (-).
    pub isolation_damping_coefficient: Option<f64>,
    /// Longest dimension in plan (m).
    pub plan_length: Option<f64>,
    /// Shortest dimension in plan (m).
    pub plan_width: Option<f64>,
    /// Eccentricity of the mass above the isolators and their centre of rigidity, with the
    /// accidental one (m).
    pub plan_eccentricity: Option<f64>,
}

/// What both structures share.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Site {
    /// Whether all floors up to the lower roof face floors, of both structures.
    pub floors_aligned: Option<bool>,
    /// Whether both structures belong to one owner, with no property line between.
    pub same_owner: Option<bool>,
    /// Fortification intensity of the Chinese code, 6 to 9.
    pub fortification_intensity: Option<u8>,
    /// Soil zone of Mexico City.
    pub soil_zone: Option<SoilZone>,
    /// `a_g S` (m/s2).
    pub design_ground_acceleration: Option<f64>,
    /// `alpha_h` (-).
    pub seismic_coefficient: Option<f64>,
    /// `S_M1`: spectral acceleration of the maximum considered earthquake at one second, damped
    /// by 5 % (m/s2).
    pub spectral_acceleration_1s: Option<f64>,
    /// Whether the neighbour has left its own distance from the property line.
    pub neighbour_has_gap: Option<bool>,
    /// Maximum displacement of the ground on one side of the gap relative to that on the other
    /// (m): zero where one motion is under both. Codes suppose that, so that it is added to
    /// what they require.
    pub relative_ground_displacement: f64,
}

/// Two structures at one level where they could touch.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Situation {
    /// Left structure.
    pub left: Structure,
    /// Right structure.
    pub right: Structure,
    /// What both share.
    pub site: Site,
}
