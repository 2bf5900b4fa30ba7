//! What a provision takes for granted of the numbers that it is given.

/// Where a rule measures heights from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HeightDatum {
    /// It takes no height.
    NotUsed,
    /// From the ground, as the elevations of a case.
    Ground,
    /// From the top of the foundation.
    Foundation,
    /// From where was not seen.
    NotSeen,
}

/// Whose ground a rule speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ground {
    /// It does not ask.
    NotAsked,
    /// Both buildings stand on one property.
    OneProperty,
    /// The distance is that to the building's own property line.
    OwnSide,
    /// Parts of one structure.
    OneStructure,
    /// A new building beside one that stands there already.
    BesideExisting,
}

/// What a rule takes for granted, in sentences.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Assumptions {
    /// Which displacement it means, and what stands for it here.
    pub displacement: String,
    /// Where its heights are measured from.
    pub height: String,
    /// Whose ground it speaks of.
    pub ownership: String,
    /// Whether it asks for floors that face floors.
    pub alignment: String,
    /// Anything else; in the words of the user for a rule of theirs.
    pub others: Vec<String>,
}

impl Assumptions {
    /// Each with what it is about, in the order of the fields.
    #[must_use]
    pub fn list(&self) -> Vec<(&'static str, &str)> {
        let mut list = vec![
            ("displacement", self.displacement.as_str()),
            ("height", self.height.as_str()),
            ("ownership", self.ownership.as_str()),
            ("alignment", self.alignment.as_str()),
        ];
        list.extend(self.others.iter().map(|other| ("also", other.as_str())));
        list
    }
}

impl HeightDatum {
    /// In a sentence.
    #[must_use]
    pub fn explanation(self) -> &'static str {
        match self {
            Self::NotUsed => "none is taken",
            Self::Ground => "above ground, as the elevations of the case",
            Self::Foundation => {
                "from the top of the foundation or of a rigid basement; the elevation above ground stands for it, which is less beside a basement that is not rigid"
            }
            Self::NotSeen => {
                "what it is measured from was not seen; the elevation above ground stands for it"
            }
        }
    }
}

impl Ground {
    /// In a sentence.
    #[must_use]
    pub fn explanation(self) -> &'static str {
        match self {
            Self::NotAsked => "the rule does not ask who owns the ground",
            Self::OneProperty => "buildings on one property",
            Self::OwnSide => {
                "each building keeps its own distance from the property line; both are summed for a gap between two"
            }
            Self::OneStructure => "parts of one structure",
            Self::BesideExisting => "a new building beside an existing one",
        }
    }
}
