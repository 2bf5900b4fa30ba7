//! Codes as a whole: which of their provisions hold on one property and across a property
//! line, and what they take of many records.

use pounding_catalogue::{Descriptor, Registry, Verification};

use crate::descriptor::ProvisionDescriptor;
use crate::error::SeparationError;
use crate::inputs::{Site, Situation, Structure};
use crate::provisions::{
    as_1170_4, asce_7, asce_41, e_030, eak_2000, eurocode_8, gb_50011, iran_2800, is_1893, is_4326,
    japan, mexico_city_2004, nbcc, nch_433, ntc_2018, nzs_1170_5, taiwan_2011, turkey, ubc_1997,
};
use crate::suite_rule::{self, SuiteRule};
use crate::working::Requirement;

/// Who owns the ground on both sides of a gap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ownership {
    /// No property line lies in the gap.
    SameProperty,
    /// Each building stands on its own property.
    DifferentProperties,
}

impl Ownership {
    /// A word for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::SameProperty => "same property",
            Self::DifferentProperties => "different properties",
        }
    }
}

/// Rules of a code that give one width together.
#[derive(Debug, Clone, Copy)]
pub struct Rules {
    /// Of these the first that applies.
    pub either: &'static [&'static ProvisionDescriptor],
    /// A width that holds beside it.
    pub minimum: Option<&'static ProvisionDescriptor>,
}

/// Whether a code asks who owns the ground.
#[derive(Debug, Clone, Copy)]
pub enum Cases {
    /// The same rules for both.
    Alike(Rules),
    /// Other rules across a property line.
    ByOwner {
        /// On one property.
        same: Rules,
        /// Across a property line: rules for one building, summed over both sides.
        different: Rules,
    },
}

/// A code: its rules for the gap, and what it takes of many records.
#[derive(Debug, Clone, Copy)]
pub struct CodeDescriptor {
    /// Name.
    pub name: &'static str,
    /// Its rules.
    pub cases: Cases,
    /// What it takes of responses under many records.
    pub suite: SuiteRule,
}

impl Descriptor for CodeDescriptor {
    const KIND: &'static str = "code";
    const NOUN: &'static str = "code";

    fn name(&self) -> &'static str {
        self.name
    }
}

/// A width by a code at one level.
#[derive(Debug, Clone)]
pub struct CodeWidth {
    /// The provision that gives it.
    pub provision: &'static ProvisionDescriptor,
    /// What it requires.
    pub requirement: Requirement,
}

impl Rules {
    const fn of(either: &'static [&'static ProvisionDescriptor]) -> Self {
        Self {
            either,
            minimum: None,
        }
    }

    const fn with(
        either: &'static [&'static ProvisionDescriptor],
        minimum: &'static ProvisionDescriptor,
    ) -> Self {
        Self {
            either,
            minimum: Some(minimum),
        }
    }

    /// All provisions among them.
    pub fn provisions(&self) -> impl Iterator<Item = &'static ProvisionDescriptor> + use<> {
        self.either.iter().copied().chain(self.minimum)
    }

    /// Width between two buildings, or of one beside a wall: of the rules the first that
    /// applies, and no less than the minimum.
    ///
    /// # Errors
    /// An input that is missing, or no rule that applies.
    pub fn width(&self, sides: &Sides) -> Result<CodeWidth, SeparationError> {
        let of = |provision: &'static ProvisionDescriptor| {
            let requirement = match sides {
                Sides::Between(situation) => provision.between(situation),
                Sides::Wall {
                    structure,
                    elevation,
                    site,
                } => provision.boundary(structure, *elevation, site),
            };
            requirement.map(|requirement| CodeWidth {
                provision,
                requirement,
            })
        };
        let mut first = Err(SeparationError::NotApplicable {
            provision: "the code",
            reason: "it has no rule for this situation".to_owned(),
        });
        for provision in self.either {
            match of(provision) {
                Err(e @ SeparationError::NotApplicable { .. }) => {
                    first = first.or(Err(e));
                }
                found => {
                    first = found;
                    break;
                }
            }
        }
        let first = first?;
        match self.minimum.map(of) {
            // A minimum between buildings says nothing beside a wall.
            None | Some(Err(SeparationError::NotApplicable { .. })) => Ok(first),
            Some(least) => {
                let least = least?;
                let wider = least.requirement.width > first.requirement.width;
                Ok(if wider { least } else { first })
            }
        }
    }
}

/// What lies on both sides of a level.
#[derive(Debug, Clone)]
pub enum Sides {
    /// Two buildings.
    Between(Box<Situation>),
    /// A building and a wall.
    Wall {
        /// The building.
        structure: Box<Structure>,
        /// Height of the level above ground (m).
        elevation: f64,
        /// The site.
        site: Site,
    },
}

impl Sides {
    /// The same under this ownership.
    #[must_use]
    pub fn owned(mut self, ownership: Option<Ownership>) -> Self {
        if let Some(ownership) = ownership {
            let same = Some(ownership == Ownership::SameProperty);
            match &mut self {
                Self::Between(situation) => situation.site.same_owner = same,
                Self::Wall { site, .. } => site.same_owner = same,
            }
        }
        self
    }
}

impl CodeDescriptor {
    /// Its rules, for each kind of ownership that it tells apart.
    #[must_use]
    pub fn rules(&self) -> Vec<(Option<Ownership>, Rules)> {
        match self.cases {
            Cases::Alike(rules) => vec![(None, rules)],
            Cases::ByOwner { same, different } => vec![
                (Some(Ownership::SameProperty), same),
                (Some(Ownership::DifferentProperties), different),
            ],
        }
    }

    /// Rules for one building beside a wall, if there are any.
    #[must_use]
    pub fn beside_a_wall(&self) -> Rules {
        match self.cases {
            Cases::Alike(rules)
            | Cases::ByOwner {
                different: rules, ..
            } => rules,
        }
    }

    /// The first of its provisions, which has region, edition and clause.
    #[must_use]
    pub fn provision(&self) -> Option<&'static ProvisionDescriptor> {
        let (_, rules) = self.rules().into_iter().next()?;
        rules.provisions().next()
    }

    /// Code with its edition.
    #[must_use]
    pub fn edition(&self) -> &'static str {
        self.provision().map_or("", |p| p.edition)
    }

    /// Whether a provision is one of this code.
    #[must_use]
    pub fn has(&self, provision: &ProvisionDescriptor) -> bool {
        let all = self.rules().into_iter();
        all.flat_map(|(_, rules)| rules.provisions())
            .any(|p| p.name == provision.name)
    }

    /// How far a provision and the rule for many records have been checked, together.
    #[must_use]
    pub fn status(&self, provision: &ProvisionDescriptor) -> Verification {
        match provision.status {
            Verification::Verified(_) if provision.depends_on_displacement() => self.suite.status,
            status => status,
        }
    }
}

const fn by_owner(same: Rules, different: Rules) -> Cases {
    Cases::ByOwner { same, different }
}

/// A code whose between rule holds on one property, and whose boundary rule across a line.
macro_rules! code {
    ($name:literal, $between:expr, $boundary:expr, $suite:ident) => {
        &CodeDescriptor {
            name: $name,
            cases: by_owner(Rules::of(&[&$between]), Rules::of(&[&$boundary])),
            suite: suite_rule::$suite,
        }
    };
    ($name:literal, $cases:expr, $suite:ident) => {
        &CodeDescriptor {
            name: $name,
            cases: $cases,
            suite: suite_rule::$suite,
        }
    };
}

static ALL: &[&CodeDescriptor] = &[
    code!(
        "asce_7_2010",
        asce_7::ASCE_7_10_BETWEEN,
        asce_7::ASCE_7_10_BOUNDARY,
        ASCE_7_2010
    ),
    code!(
        "asce_7_2016",
        asce_7::ASCE_7_16_BETWEEN,
        asce_7::ASCE_7_16_BOUNDARY,
        ASCE_7_2016
    ),
    code!(
        "asce_7_2022",
        asce_7::ASCE_7_22_BETWEEN,
        asce_7::ASCE_7_22_BOUNDARY,
        ASCE_7_2022
    ),
    code!(
        "ibc_2009",
        asce_7::IBC_2009_BETWEEN,
        asce_7::IBC_2009_BOUNDARY,
        ASCE_7_2010
    ),
    code!(
        "kds",
        asce_7::KDS_BETWEEN,
        asce_7::KDS_BOUNDARY,
        ASCE_7_2010
    ),
    code!(
        "sni_1726_2019",
        asce_7::SNI_1726_BETWEEN,
        asce_7::SNI_1726_BOUNDARY,
        ASCE_7_2016
    ),
    code!(
        "ubc_1997",
        ubc_1997::UBC_BETWEEN,
        ubc_1997::UBC_BOUNDARY,
        UBC_1997
    ),
    code!(
        "nscp_2015",
        ubc_1997::NSCP_BETWEEN,
        ubc_1997::NSCP_BOUNDARY,
        UBC_1997
    ),
    code!("asce_41", asce_41::BETWEEN, asce_41::BOUNDARY, ASCE_41),
    code!(
        "nbcc_2015",
        Cases::Alike(Rules::of(&[&nbcc::BETWEEN])),
        NBCC
    ),
    code!(
        "eurocode_8_2004",
        eurocode_8::FIRST_BETWEEN,
        eurocode_8::FIRST_BOUNDARY,
        EUROCODE_8
    ),
    code!(
        "eurocode_8_draft",
        eurocode_8::SECOND_BETWEEN,
        eurocode_8::SECOND_BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "ntc_2018",
        Cases::Alike(Rules::with(&[&ntc_2018::SUM], &ntc_2018::MINIMUM)),
        NTC_2018
    ),
    code!(
        "eak_2000",
        Cases::Alike(Rules::of(&[&eak_2000::DISPLACEMENT])),
        NOT_KNOWN
    ),
    code!(
        "nzs_1170_5",
        nzs_1170_5::BETWEEN,
        nzs_1170_5::BOUNDARY,
        NZS_1170_5
    ),
    code!(
        "as_1170_4",
        Cases::Alike(Rules::of(&[&as_1170_4::BOUNDARY])),
        NOT_KNOWN
    ),
    code!(
        "is_1893_2016",
        Cases::Alike(Rules::of(&[&is_1893::EDITION_2016])),
        NOT_KNOWN
    ),
    code!(
        "is_1893_2002",
        Cases::Alike(Rules::of(&[&is_1893::EDITION_2002])),
        NOT_KNOWN
    ),
    code!(
        "is_4326",
        Cases::Alike(Rules::of(&[&is_4326::BETWEEN])),
        NOT_KNOWN
    ),
    code!(
        "iran_2800",
        by_owner(
            Rules::of(&[&iran_2800::BETWEEN]),
            Rules::of(&[
                &iran_2800::BOUNDARY_BY_HEIGHT,
                &iran_2800::BOUNDARY_BY_ANALYSIS
            ]),
        ),
        IRAN_2800
    ),
    code!(
        "tehran",
        Cases::Alike(Rules::of(&[&iran_2800::TEHRAN])),
        NOT_KNOWN
    ),
    code!(
        "taiwan_2011",
        taiwan_2011::BETWEEN,
        taiwan_2011::BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "gb_50011_2010",
        Cases::Alike(Rules::of(&[&gb_50011::BETWEEN])),
        NOT_KNOWN
    ),
    code!(
        "japan_practice",
        Cases::Alike(Rules::of(&[&japan::PRACTICE])),
        NOT_KNOWN
    ),
    code!(
        "tbdy_2018",
        Cases::Alike(Rules::with(
            &[&turkey::TBDY_2018],
            &turkey::TBDY_2018_MINIMUM
        )),
        TBDY_2018
    ),
    code!(
        "tdy_2007",
        Cases::Alike(Rules::with(&[&turkey::TDY_2007], &turkey::TDY_2007_MINIMUM)),
        TDY_2007
    ),
    code!(
        "mexico_city_2004",
        mexico_city_2004::BETWEEN,
        mexico_city_2004::BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "nch_433",
        by_owner(
            Rules::with(&[&nch_433::BETWEEN], &nch_433::BOUNDARY_MINIMUM),
            Rules::with(&[&nch_433::BOUNDARY], &nch_433::BOUNDARY_MINIMUM),
        ),
        NOT_KNOWN
    ),
    code!(
        "e_030",
        by_owner(
            Rules::with(&[&e_030::BETWEEN], &e_030::MINIMUM),
            Rules::of(&[&e_030::BOUNDARY]),
        ),
        E_030
    ),
];

static CODES: Registry<CodeDescriptor> = Registry::new(
    ALL,
    &[
        (&["ec8", "eurocode", "en_1998_1", "en"], "eurocode_8_2004"),
        (&["asce", "asce7", "asce_7_16"], "asce_7_2016"),
        (&["asce_7_10"], "asce_7_2010"),
        (&["asce_7_22"], "asce_7_2022"),
        (&["nbcc", "nbc"], "nbcc_2015"),
        (&["ntc"], "ntc_2018"),
        (&["tbdy", "tbec"], "tbdy_2018"),
    ],
);

/// Descriptors of all codes.
#[must_use]
pub fn codes() -> &'static [&'static CodeDescriptor] {
    CODES.all()
}

/// The code of this name.
///
/// # Errors
/// [`SeparationError::UnknownProvision`] with the nearest known name.
pub fn find_code(name: &str) -> Result<&'static CodeDescriptor, SeparationError> {
    Ok(CODES.find(name)?)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::registry::descriptors;

    fn structure(u: f64) -> Structure {
        Structure {
            displacement: Some(u),
            height: 9.0,
            storeys: 3,
            ..Structure::default()
        }
    }

    fn between(aligned: bool) -> Sides {
        Sides::Between(Box::new(Situation {
            left: structure(0.08),
            right: structure(0.06),
            elevation: 9.0,
            site: Site {
                floors_aligned: Some(aligned),
                design_ground_acceleration: Some(2.5),
                ..Site::default()
            },
        }))
    }

    fn widths(code: &str, sides: &Sides) -> Vec<(Option<Ownership>, f64)> {
        let rules = find_code(code).unwrap().rules().into_iter();
        rules
            .map(|(ownership, rules)| {
                let width = rules.width(&sides.clone().owned(ownership)).unwrap();
                (ownership, width.requirement.width)
            })
            .collect()
    }

    /// By hand, 80 and 60 mm: root 100 mm, sum 140 mm; times 0.7 by Eurocode 8 where floors
    /// are aligned.
    #[test]
    fn ownership_by_hand() {
        for (aligned, factor) in [(false, 1.0), (true, 0.7)] {
            let found = widths("eurocode_8_2004", &between(aligned));
            assert_eq!(found[0].0, Some(Ownership::SameProperty));
            assert!((found[0].1 - 0.1 * factor).abs() < 1e-12);
            assert_eq!(found[1].0, Some(Ownership::DifferentProperties));
            assert!((found[1].1 - 0.14 * factor).abs() < 1e-12);
        }
        let found = widths("nbcc_2015", &between(true));
        assert!(found.len() == 1 && found[0].0.is_none());
        assert!((found[0].1 - 0.1).abs() < 1e-12);
    }

    /// NTC 2018 at 9 m with a_g S = 2.5 m/s2: 9 m / 100 times 0.50986 is 45.9 mm, less than
    /// the sum of 140 mm, and more than one of 20 mm.
    #[test]
    fn a_minimum_holds_beside_the_rule() {
        let found = widths("ntc_2018", &between(true));
        assert!((found[0].1 - 0.14).abs() < 1e-12);
        let Sides::Between(mut small) = between(true) else {
            unreachable!()
        };
        small.left.displacement = Some(0.01);
        small.right.displacement = Some(0.01);
        let rules = find_code("ntc_2018").unwrap().rules()[0].1;
        let width = rules.width(&Sides::Between(small)).unwrap();
        assert_eq!(width.provision.name, "ntc_2018_minimum");
        assert!((width.requirement.width - 0.09 * 5.0 / 9.806_65).abs() < 1e-12);
    }

    /// Up to 8 storeys by height: 5 mm a metre on either side; above by analysis.
    #[test]
    fn of_alternatives_the_first_that_applies() {
        let found = widths("iran_2800", &between(true));
        assert!((found[1].1 - 2.0 * 0.045).abs() < 1e-12);
        let Sides::Between(mut tall) = between(true) else {
            unreachable!()
        };
        (tall.left.storeys, tall.right.storeys) = (9, 9);
        let found = widths("iran_2800", &Sides::Between(tall));
        assert!((found[1].1 - 0.14).abs() < 1e-12);
    }

    #[test]
    fn names_are_found_or_suggested() {
        assert_eq!(
            find_code("eurocode_8_2004").unwrap().edition(),
            "EN 1998-1:2004"
        );
        for (wrong, meant) in [
            ("eurocode_8", "eurocode_8_2004"),
            ("ec8", "eurocode_8_2004"),
            ("en_1998_1_2004", "eurocode_8_2004"),
            ("asce_7_16", "asce_7_2016"),
            ("nbcc", "nbcc_2015"),
        ] {
            let help = find_code(wrong).unwrap_err().help().unwrap();
            assert_eq!(help, format!("did you mean \"{meant}\"?"), "{wrong}");
        }
    }

    /// Every provision belongs to a code, but alternatives that a code leaves to the engineer
    /// and those for isolated structures.
    #[test]
    fn provisions_without_a_code() {
        let without = descriptors()
            .iter()
            .filter(|p| !codes().iter().any(|c| c.has(p)));
        let without: Vec<_> = without.map(|p| p.name).collect();
        assert_eq!(
            without,
            [
                "asce_7_10_isolation_boundary",
                "asce_7_16_isolation_boundary",
                "asce_7_22_isolation_boundary",
                "eak_2000_joint",
                "mexico_city_2004_boundary_simplified",
                "mexico_city_2004_between_simplified",
            ]
        );
    }
}
