//! Codes as a whole: which of their provisions hold on one property and across a property
//! line, and what they take of many records.

use pounding_catalogue::{Descriptor, Registry};

use crate::code_width::Rules;
use crate::descriptor::ProvisionDescriptor;
use crate::edition::Edition;
use crate::error::SeparationError;
use crate::ownership::Ownership;
use crate::provision::Provision;
use crate::provisions::{
    as_1170_4, asce_7, asce_7_isolation, asce_41, e_030, eak_2000, eurocode_8, gb_50011, iran_2800,
    is_1893, is_4326, japan, mexico_city, nbcc, nch_433, nec_se_ds, nsr_10, ntc_2018, nzs_1170_5,
    rpa_2024, taiwan_2011, turkey, ubc_1997, ufc_3_310_03a,
};
use crate::suite_rule::{self, SuiteRule};

/// Provisions of a code that give one width together.
#[derive(Debug, Clone, Copy)]
pub struct Listed {
    /// Of these the first that applies.
    either: &'static [&'static ProvisionDescriptor],
    /// A width that holds beside it.
    minimum: Option<&'static ProvisionDescriptor>,
}

/// Whether a code asks who owns the ground.
#[derive(Debug, Clone, Copy)]
pub enum Cases {
    /// The same rules for both.
    Alike(Listed),
    /// Other rules across a property line.
    ByOwner {
        /// On one property.
        same: Listed,
        /// Across a property line: rules for one building, summed over both sides.
        different: Listed,
    },
}

/// A code: its rules for the gap, and what it takes of many records.
#[derive(Debug, Clone, Copy)]
pub struct CodeDescriptor {
    /// Name, with the edition.
    pub name: &'static str,
    /// Name of all its editions.
    pub family: &'static str,
    /// Its rules.
    pub cases: Cases,
    /// Its rule for buildings on isolators, for which the others do not hold; `None` where none
    /// is known here.
    pub isolated: Option<&'static ProvisionDescriptor>,
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

/// What gives the verdict: a code of the registry, or a rule of the user.
#[derive(Debug, Clone)]
pub struct Code {
    /// Name.
    pub name: String,
    /// Code with its edition.
    pub edition: String,
    /// From when to when the edition is in force, as far as that is known, in words.
    pub in_force: Option<String>,
    /// The edition that took its place, if one is known.
    pub superseded_by: Option<&'static str>,
    /// Its rules, for each kind of ownership that it tells apart.
    pub rules: Vec<(Option<Ownership>, Rules)>,
    /// What it takes of responses under many records.
    pub suite: SuiteRule,
}

impl Listed {
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
    fn provisions(&self) -> impl Iterator<Item = &'static ProvisionDescriptor> + use<> {
        self.either.iter().copied().chain(self.minimum)
    }

    fn rules(&self) -> Rules {
        Rules {
            either: self.either.iter().map(|p| Provision::BuiltIn(p)).collect(),
            minimum: self.minimum.map(Provision::BuiltIn),
            isolated: None,
        }
    }
}

impl Code {
    /// A rule of the user as what gives the verdict: the maximum of many records counts.
    #[must_use]
    pub fn of_rule(rule: Provision) -> Self {
        Self {
            name: rule.name().to_owned(),
            edition: match rule.edition() {
                "" => "a rule of your own".to_owned(),
                edition => edition.to_owned(),
            },
            in_force: rule.in_force(),
            superseded_by: rule.superseded_by(),
            suite: suite_rule::OF_A_RULE,
            rules: vec![(
                None,
                Rules {
                    either: vec![rule],
                    minimum: None,
                    isolated: None,
                },
            )],
        }
    }

    /// Rules for one building beside a wall: those across a property line.
    #[must_use]
    pub fn beside_a_wall(&self) -> Option<&Rules> {
        self.rules.last().map(|(_, rules)| rules)
    }
}

impl CodeDescriptor {
    /// Its provisions, for each kind of ownership that it tells apart.
    fn listed(&self) -> Vec<(Option<Ownership>, Listed)> {
        match self.cases {
            Cases::Alike(listed) => vec![(None, listed)],
            Cases::ByOwner { same, different } => vec![
                (Some(Ownership::SameProperty), same),
                (Some(Ownership::DifferentProperties), different),
            ],
        }
    }

    /// The same as what gives a verdict.
    #[must_use]
    pub fn code(&self) -> Code {
        let edition = self.edition();
        let rules = self.listed().into_iter();
        let isolated = self.isolated.map(Provision::BuiltIn);
        let of = |listed: Listed| Rules {
            isolated: isolated.clone(),
            ..listed.rules()
        };
        Code {
            name: self.name.to_owned(),
            edition: edition.title.to_owned(),
            in_force: edition.in_force.map(|known| known.explanation()),
            superseded_by: edition.superseded_by,
            rules: rules.map(|(owner, listed)| (owner, of(listed))).collect(),
            suite: self.suite,
        }
    }

    /// Its edition: that of its first provision.
    #[must_use]
    pub fn edition(&self) -> &'static Edition {
        let (Cases::Alike(listed) | Cases::ByOwner { same: listed, .. }) = self.cases;
        listed.either[0].edition
    }

    /// Whether there are days on which the name of its family stands for it: it has one, and dates.
    #[must_use]
    pub fn is_chosen_by_dates(&self) -> bool {
        self.family != self.name && self.edition().in_force.is_some()
    }

    /// Whether a provision is one of this code.
    #[must_use]
    pub fn has(&self, provision: &ProvisionDescriptor) -> bool {
        let all = self.listed().into_iter();
        all.flat_map(|(_, listed)| listed.provisions())
            .chain(self.isolated)
            .any(|p| p.name == provision.name)
    }
}

const fn by_owner(same: Listed, different: Listed) -> Cases {
    Cases::ByOwner { same, different }
}

/// A code whose between rule holds on one property, and whose boundary rule across a line.
macro_rules! code {
    ($name:literal, $family:literal, $between:expr, $boundary:expr, $suite:ident) => {
        &CodeDescriptor {
            name: $name,
            family: $family,
            cases: by_owner(Listed::of(&[&$between]), Listed::of(&[&$boundary])),
            isolated: None,
            suite: suite_rule::$suite,
        }
    };
    ($name:literal, $family:literal, $between:expr, $boundary:expr, $suite:ident, isolated: $isolated:expr) => {
        &CodeDescriptor {
            name: $name,
            family: $family,
            cases: by_owner(Listed::of(&[&$between]), Listed::of(&[&$boundary])),
            isolated: Some(&$isolated),
            suite: suite_rule::$suite,
        }
    };
    ($name:literal, $family:literal, $cases:expr, $suite:ident) => {
        &CodeDescriptor {
            name: $name,
            family: $family,
            cases: $cases,
            isolated: None,
            suite: suite_rule::$suite,
        }
    };
}

static ALL: &[&CodeDescriptor] = &[
    code!(
        "asce_7_2010",
        "asce_7",
        asce_7::ASCE_7_10_BETWEEN,
        asce_7::ASCE_7_10_BOUNDARY,
        ASCE_7_2010,
        isolated: asce_7_isolation::ASCE_7_10
    ),
    code!(
        "asce_7_2016",
        "asce_7",
        asce_7::ASCE_7_16_BETWEEN,
        asce_7::ASCE_7_16_BOUNDARY,
        ASCE_7_2016,
        isolated: asce_7_isolation::ASCE_7_16
    ),
    code!(
        "asce_7_2022",
        "asce_7",
        asce_7::ASCE_7_22_BETWEEN,
        asce_7::ASCE_7_22_BOUNDARY,
        ASCE_7_2022,
        isolated: asce_7_isolation::ASCE_7_22
    ),
    code!(
        "ibc_2009",
        "ibc",
        asce_7::IBC_2009_BETWEEN,
        asce_7::IBC_2009_BOUNDARY,
        ASCE_7_2010
    ),
    code!(
        "kds",
        "kds",
        asce_7::KDS_BETWEEN,
        asce_7::KDS_BOUNDARY,
        ASCE_7_2010
    ),
    code!(
        "sni_1726_2019",
        "sni_1726",
        asce_7::SNI_1726_BETWEEN,
        asce_7::SNI_1726_BOUNDARY,
        ASCE_7_2016
    ),
    code!(
        "ubc_1997",
        "ubc",
        ubc_1997::UBC_BETWEEN,
        ubc_1997::UBC_BOUNDARY,
        UBC_1997
    ),
    code!(
        "nscp_2015",
        "nscp",
        ubc_1997::NSCP_BETWEEN,
        ubc_1997::NSCP_BOUNDARY,
        UBC_1997
    ),
    code!(
        "asce_41",
        "asce_41",
        asce_41::BETWEEN,
        asce_41::BOUNDARY,
        ASCE_41
    ),
    code!(
        "nbcc_2015",
        "nbcc",
        Cases::Alike(Listed::of(&[&nbcc::BETWEEN])),
        NBCC
    ),
    code!(
        "eurocode_8_2004",
        "eurocode_8",
        eurocode_8::FIRST_BETWEEN,
        eurocode_8::FIRST_BOUNDARY,
        EUROCODE_8
    ),
    code!(
        "eurocode_8_draft",
        "eurocode_8",
        eurocode_8::SECOND_BETWEEN,
        eurocode_8::SECOND_BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "ntc_2018",
        "ntc",
        Cases::Alike(Listed::with(&[&ntc_2018::SUM], &ntc_2018::MINIMUM)),
        NTC_2018
    ),
    code!(
        "eak_2000",
        "eak",
        Cases::Alike(Listed::of(&[&eak_2000::DISPLACEMENT])),
        NOT_KNOWN
    ),
    code!(
        "nzs_1170_5",
        "nzs_1170_5",
        nzs_1170_5::BETWEEN,
        nzs_1170_5::BOUNDARY,
        NZS_1170_5
    ),
    code!(
        "as_1170_4",
        "as_1170_4",
        Cases::Alike(Listed::of(&[&as_1170_4::BOUNDARY])),
        NOT_KNOWN
    ),
    code!(
        "is_1893_2016",
        "is_1893",
        Cases::Alike(Listed::of(&[&is_1893::EDITION_2016])),
        NOT_KNOWN
    ),
    code!(
        "is_1893_2002",
        "is_1893",
        Cases::Alike(Listed::of(&[&is_1893::EDITION_2002])),
        NOT_KNOWN
    ),
    code!(
        "is_4326",
        "is_4326",
        Cases::Alike(Listed::of(&[&is_4326::BETWEEN])),
        NOT_KNOWN
    ),
    code!(
        "iran_2800",
        "iran_2800",
        by_owner(
            Listed::of(&[&iran_2800::BETWEEN_BY_HEIGHT, &iran_2800::BETWEEN]),
            Listed::of(&[
                &iran_2800::BOUNDARY_BY_HEIGHT,
                &iran_2800::BOUNDARY_BY_ANALYSIS
            ]),
        ),
        IRAN_2800
    ),
    code!(
        "tehran",
        "tehran",
        Cases::Alike(Listed::of(&[&iran_2800::TEHRAN])),
        NOT_KNOWN
    ),
    code!(
        "taiwan_2011",
        "taiwan",
        taiwan_2011::BETWEEN,
        taiwan_2011::BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "gb_50011_2010",
        "gb_50011",
        Cases::Alike(Listed::of(&[&gb_50011::BETWEEN])),
        NOT_KNOWN
    ),
    code!(
        "japan_practice",
        "japan",
        Cases::Alike(Listed::of(&[&japan::PRACTICE])),
        NOT_KNOWN
    ),
    code!(
        "tbdy_2018",
        "turkey",
        Cases::Alike(Listed::with(
            &[&turkey::TBDY_2018],
            &turkey::TBDY_2018_MINIMUM
        )),
        TBDY_2018
    ),
    code!(
        "tdy_2007",
        "turkey",
        Cases::Alike(Listed::with(
            &[&turkey::TDY_2007],
            &turkey::TDY_2007_MINIMUM
        )),
        TDY_2007
    ),
    code!(
        "mexico_city_2004",
        "mexico_city",
        mexico_city::BETWEEN,
        mexico_city::BOUNDARY,
        NOT_KNOWN
    ),
    code!(
        "nch_433",
        "nch_433",
        by_owner(
            Listed::with(&[&nch_433::BETWEEN], &nch_433::BOUNDARY_MINIMUM),
            Listed::with(&[&nch_433::BOUNDARY], &nch_433::BOUNDARY_MINIMUM),
        ),
        NOT_KNOWN
    ),
    code!(
        "mexico_city_2020",
        "mexico_city",
        Cases::Alike(Listed::of(&[&mexico_city::BOUNDARY_2020])),
        NOT_KNOWN
    ),
    code!(
        "e_030_2018",
        "e_030",
        by_owner(
            Listed::with(&[&e_030::BETWEEN_2018], &e_030::MINIMUM_2018),
            Listed::of(&[&e_030::BOUNDARY_2018]),
        ),
        E_030
    ),
    code!(
        "e_030_2026",
        "e_030",
        by_owner(
            Listed::with(&[&e_030::BETWEEN_2026], &e_030::MINIMUM_2026),
            Listed::of(&[&e_030::BOUNDARY_2026]),
        ),
        NOT_KNOWN
    ),
    code!(
        "nsr_10",
        "nsr_10",
        by_owner(
            Listed::of(&[&nsr_10::WITHIN]),
            Listed::of(&[&nsr_10::BESIDE_EXISTING, &nsr_10::BOUNDARY]),
        ),
        NOT_KNOWN
    ),
    code!(
        "nec_se_ds",
        "nec_se_ds",
        Cases::Alike(Listed::of(&[&nec_se_ds::WITHIN])),
        NOT_KNOWN
    ),
    code!(
        "rpa_2024",
        "rpa",
        Cases::Alike(Listed::of(&[&rpa_2024::BETWEEN])),
        NOT_KNOWN
    ),
    code!(
        "ufc_3_310_03a",
        "ufc_3_310",
        Cases::Alike(Listed::of(&[&ufc_3_310_03a::FLEXIBLE])),
        NOT_KNOWN
    ),
];

static CODES: Registry<CodeDescriptor> = Registry::new(
    ALL,
    &[
        (
            &[
                "ec8",
                "ec_8",
                "eurocode",
                "eurocode8",
                "en_1998_1",
                "en1998",
                "en1998_1",
                "en_1998",
                "en",
            ],
            "eurocode_8_2004",
        ),
        (&["asce", "asce7", "asce_7_16"], "asce_7_2016"),
        (&["asce_7_10"], "asce_7_2010"),
        (&["asce_7_22"], "asce_7_2022"),
        (&["nbc"], "nbcc_2015"),
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
    use crate::code_width::Sides;
    use crate::descriptor::Place;
    use crate::edition::Date;
    use crate::inputs::{Site, Situation, Structure};
    use crate::registry::descriptors;

    fn structure(u: f64) -> Structure {
        Structure {
            displacement: Some(u),
            height: 9.0,
            elevation: 9.0,
            storeys: 3,
            ..Structure::default()
        }
    }

    fn between(aligned: bool) -> Sides {
        Sides::Between(Box::new(Situation {
            left: structure(0.08),
            right: structure(0.06),
            site: Site {
                floors_aligned: Some(aligned),
                design_ground_acceleration: Some(2.5),
                ..Site::default()
            },
        }))
    }

    fn widths(code: &str, sides: &Sides) -> Vec<(Option<Ownership>, f64)> {
        let rules = find_code(code).unwrap().code().rules.into_iter();
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
        let rules = &find_code("ntc_2018").unwrap().code().rules[0].1;
        let width = rules.width(&Sides::Between(small)).unwrap();
        assert_eq!(width.provision.name(), "ntc_2018_minimum");
        assert!((width.requirement.width - 0.09 * 5.0 / 9.806_65).abs() < 1e-12);
    }

    /// Up to 8 storeys by height: 10 mm a metre between, 5 mm a metre on either side; above by analysis.
    #[test]
    fn of_alternatives_the_first_that_applies() {
        let found = widths("iran_2800", &between(true));
        assert!((found[0].1 - 0.09).abs() < 1e-12);
        assert!((found[1].1 - 2.0 * 0.045).abs() < 1e-12);
        let Sides::Between(mut tall) = between(true) else {
            unreachable!()
        };
        (tall.left.storeys, tall.right.storeys) = (9, 9);
        let found = widths("iran_2800", &Sides::Between(tall));
        assert!((found[0].1 - 0.1).abs() < 1e-12);
        assert!((found[1].1 - 0.14).abs() < 1e-12);
        let Sides::Between(mut important) = between(true) else {
            unreachable!()
        };
        important.left.importance = Some(1.4);
        let found = widths("iran_2800", &Sides::Between(important));
        // 80 mm by analysis for the important one, 5 mm a metre of 9 m for the other.
        assert!((found[1].1 - 0.125).abs() < 1e-12);
    }

    /// Across a property line the low building keeps its distance by height, whatever its neighbour is: by hand
    /// 0.005 times 9 m and 60 mm, or 80 mm and 0.005 times 9 m, and 7 mm of the ground once.
    #[test]
    fn either_side_goes_by_its_own_rule() {
        let rules = &find_code("iran_2800").unwrap().code().rules[1].1;
        for (tall, own) in [(0, [0.08, 0.045]), (1, [0.045, 0.06])] {
            let Sides::Between(mut sides) = between(true) else {
                unreachable!()
            };
            let structure = match tall {
                0 => &mut sides.left,
                _ => &mut sides.right,
            };
            structure.storeys = 9;
            sides.left.name = "left".into();
            sides.right.name = "right".into();
            sides.site.relative_ground_displacement = 0.007;
            let found = rules.width(&Sides::Between(sides)).unwrap();
            assert!((found.requirement.width - (own[0] + own[1] + 0.007)).abs() < 1e-12);
            assert_eq!(found.provision.name(), "iran_2800_boundary_by_analysis");
            let beside = found.beside.unwrap();
            assert_eq!(beside.name(), "iran_2800_boundary_by_height");
            assert!(found.takes_displacements);
            // Whatever the displacements are, the low one keeps its distance.
            let least = found.without_displacements.unwrap();
            assert!((least.width - 0.045).abs() < 1e-12);
            assert_eq!(least.provision.name(), "iran_2800_boundary_by_height");
            for part in [
                "left by iran_2800_boundary_by_",
                "right by iran_2800_boundary_by_",
                "own side, left",
                "u_g",
            ] {
                let told = &found.requirement.explanation;
                assert!(told.contains(part), "{part}: {told}");
            }
        }
        // NCh433: R* d / 3 of 80 mm is 26.7 mm, or twice that, and 2 per mil of 9 m are 18 mm, more than
        // either reading of 20 mm: 6.7 and 13.3 mm.
        let rules = &find_code("nch_433").unwrap().code().rules[1].1;
        let Sides::Between(mut sides) = between(true) else {
            unreachable!()
        };
        (sides.left.importance, sides.right.importance) = (Some(1.0), Some(1.0));
        sides.right.displacement = Some(0.02);
        let found = rules.width(&Sides::Between(sides)).unwrap();
        assert_eq!(found.provision.name(), "nch_433_boundary");
        let readings = found.requirement.readings.iter().map(|r| r.width);
        let readings: Vec<f64> = readings.collect();
        for (found, thirds) in readings.iter().zip([1.0, 2.0]) {
            assert!(
                (found - (thirds * 0.08 / 3.0 + 0.018)).abs() < 1e-12,
                "{readings:?}"
            );
        }
        assert_eq!(readings.len(), 2);
        assert!(found.requirement.undecided().is_some());
        // By the narrow reading of 40 mm, 13.3 mm, the right one keeps its 18 mm; by the wide one 26.7 mm.
        let Sides::Between(mut sides) = between(true) else {
            unreachable!()
        };
        (sides.left.importance, sides.right.importance) = (Some(1.0), Some(1.0));
        sides.right.displacement = Some(0.04);
        sides.site.relative_ground_displacement = 0.005;
        let found = rules.width(&Sides::Between(sides)).unwrap();
        let readings: Vec<f64> = found.requirement.readings.iter().map(|r| r.width).collect();
        for (found, own) in readings.iter().zip([0.08 / 3.0 + 0.018, 0.24 / 3.0]) {
            assert!((found - own - 0.005).abs() < 1e-12, "{readings:?}");
        }
        assert!((found.requirement.width - 0.085).abs() < 1e-12);
        assert!(found.beside.is_none());
        let told = &found.requirement.explanation;
        assert!(
            told.contains("no less than 18.0 mm by nch_433_boundary_minimum"),
            "{told}"
        );
    }

    /// Where all rules of a code are for one building, the distances of both make the width, as either keeps
    /// its own beside a wall: for buildings and displacements of all kinds.
    #[test]
    fn the_sum_of_both_sides_is_the_width() {
        let (mut held, mut unlike) = (0, 0);
        for code in codes() {
            let code = code.code();
            for (_, rules) in &code.rules {
                if !rules.provisions().all(|p| p.place() == Place::Boundary) {
                    continue;
                }
                for left in 0..24_usize {
                    for right in 0..24_usize {
                        let of = |kind: usize| Structure {
                            storeys: [3, 6, 9][kind % 3],
                            height: [9.0, 18.0, 27.0][kind % 3],
                            elevation: [6.0, 9.0, 27.0][kind % 3],
                            importance: Some([1.0, 1.3][kind / 3 % 2]),
                            response_modification: Some(4.0),
                            ..structure([0.001, 0.02, 0.08, 0.3][kind / 6])
                        };
                        let site = Site {
                            same_owner: Some(false),
                            soil_zone: Some(crate::inputs::SoilZone::Two),
                            floors_aligned: Some(true),
                            ..Site::default()
                        };
                        let own = |structure: Structure| {
                            let structure = Box::new(structure);
                            rules.width(&Sides::Wall { structure, site })
                        };
                        let (Ok(one), Ok(other)) = (own(of(left)), own(of(right))) else {
                            continue;
                        };
                        let situation = Situation {
                            left: of(left),
                            right: of(right),
                            site,
                        };
                        let both = rules.width(&Sides::Between(Box::new(situation))).unwrap();
                        let sum = one.requirement.width + other.requirement.width;
                        let width = both.requirement.width;
                        assert!((width - sum).abs() < 1e-12, "{}: {width} {sum}", code.name);
                        held += 1;
                        unlike += usize::from(one.provision.name() != other.provision.name());
                    }
                }
            }
        }
        assert!(held > 1000 && unlike > 300, "{held} {unlike}");
    }

    /// By hand, E.030-2018 beside a wall: half of 0.006 times 9 m is 27 mm (more than half of 30 mm), whatever
    /// 2/3 u is. Rules of displacements alone ask for nothing without them.
    #[test]
    fn a_floor_within_a_rule_of_displacements_is_asked_for_anyway() {
        let wall = |code: &str, u: f64| {
            let rules = find_code(code).unwrap().code();
            let sides = Sides::Wall {
                structure: Box::new(structure(u)),
                site: Site {
                    relative_ground_displacement: 0.005,
                    floors_aligned: Some(false),
                    ..Site::default()
                },
            };
            rules.beside_a_wall().unwrap().width(&sides).unwrap()
        };
        for u in [0.001, 0.08] {
            let least = wall("e_030_2018", u).without_displacements.unwrap();
            assert!((least.width - 0.027).abs() < 1e-12, "{}", least.width);
            assert_eq!(least.provision.name(), "e_030_2018_boundary");
            assert!(wall("eurocode_8_2004", u).without_displacements.is_none());
        }
    }

    /// Widths never fall where displacements grow: what buildings at rest are asked to keep is asked of all.
    #[test]
    fn widths_rise_with_displacements() {
        let mut held = 0;
        let kinds = [None, Some(true), Some(false)];
        for provision in descriptors() {
            for (aligned, storeys) in [(true, 3), (false, 12)] {
                for same_owner in kinds {
                    let of = |u: f64| {
                        let of_factor = |factor: f64| Structure {
                            storeys,
                            height: 3.0 * storeys as f64,
                            elevation: 3.0 * storeys as f64,
                            response_modification: Some(4.0),
                            displacement_amplification: Some(3.0),
                            importance: Some(1.0),
                            yield_amplification: Some(1.4),
                            isolation_period: Some(2.5),
                            isolation_damping_coefficient: Some(1.3),
                            plan_length: Some(20.0),
                            plan_width: Some(10.0),
                            plan_eccentricity: Some(0.5),
                            on_isolators: provision.name.contains("isolation"),
                            ..structure(u * factor)
                        };
                        let site = Site {
                            floors_aligned: Some(aligned),
                            same_owner,
                            design_ground_acceleration: Some(2.5),
                            fortification_intensity: Some(8),
                            soil_zone: Some(crate::inputs::SoilZone::Two),
                            ..Site::default()
                        };
                        let sides = Sides::Between(Box::new(Situation {
                            left: of_factor(1.0),
                            right: of_factor(0.7),
                            site,
                        }));
                        sides.asks(&Provision::BuiltIn(provision))
                    };
                    let widths = [0.0, 1e-3, 0.02, 0.3, 2.0].map(of);
                    let widths: Vec<f64> = widths.iter().flatten().map(|r| r.least()).collect();
                    if widths.len() == 5 {
                        held += 1;
                        assert!(widths.is_sorted(), "{}: {widths:?}", provision.name);
                    }
                }
            }
        }
        assert!(held > 150, "{held}");
    }

    /// A building on isolators: no rule of a code for fixed bases speaks of it, whatever inputs there
    /// are, and what helps is no other of them. A rule of the user does.
    #[test]
    fn rules_for_fixed_bases_refuse_isolators() {
        let Sides::Between(mut pair) = between(true) else {
            unreachable!()
        };
        pair.right.on_isolators = true;
        pair.right.name = "office".to_owned();
        let wall = Sides::Wall {
            structure: Box::new(pair.right.clone()),
            site: pair.site,
        };
        for code in codes() {
            for (ownership, rules) in code.code().rules {
                for sides in [Sides::Between(pair.clone()), wall.clone()] {
                    let error = rules.width(&sides.owned(ownership)).unwrap_err();
                    let said = error.to_string();
                    let Some(own) = code.isolated else {
                        assert!(said.contains("fixed bases, and office"), "{said}");
                        let help = error.help().unwrap();
                        assert!(help.starts_with("no rule of the code"), "{help}");
                        continue;
                    };
                    assert!(said.contains(own.name), "{}: {said}", code.name);
                }
            }
        }
        let error = asce_7::ASCE_7_16_BETWEEN.between(&pair).unwrap_err();
        assert!(
            error
                .help()
                .unwrap()
                .ends_with("--provisions: asce_7_16_isolation_boundary")
        );
    }

    /// What to do where no rule of a code applies: other rules of it, if it has any that were not
    /// tried, else what there is beside it.
    #[test]
    fn remedies_name_rules_that_there_are() {
        let wall = || Sides::Wall {
            structure: Box::new(structure(0.08)),
            site: Site::default(),
        };
        for (code, sides, says) in [
            (
                "nbcc_2015",
                wall(),
                "no rule for one building beside a wall",
            ),
            ("ntc_2018", wall(), "no rule for one building beside a wall"),
            ("as_1170_4", wall(), "the code has no other rule"),
            ("as_1170_4", between(true), "the code has no other rule"),
            ("tehran", between(true), "the code has no other rule"),
        ] {
            let code_rules = find_code(code).unwrap().code();
            let rules = match sides {
                Sides::Wall { .. } => code_rules.beside_a_wall().unwrap(),
                Sides::Between(_) => &code_rules.rules[0].1,
            };
            let help = rules.width(&sides).unwrap_err().help().unwrap();
            assert!(help.contains(says), "{code}: {help}");
            assert!(!help.contains("choose the rule"), "{code}: {help}");
        }
        let Sides::Between(across) = between(true).owned(Some(Ownership::DifferentProperties))
        else {
            unreachable!()
        };
        let help = eurocode_8::FIRST_BETWEEN
            .between(&across)
            .unwrap_err()
            .help();
        assert_eq!(
            help.unwrap(),
            "choose the rule of the code that covers this situation, with --provisions: en_1998_1_2004_boundary"
        );
    }

    #[test]
    fn names_are_found_or_suggested() {
        assert_eq!(
            find_code("eurocode_8_2004").unwrap().edition().title,
            "EN 1998-1:2004"
        );
        for (wrong, meant) in [
            ("ec8", "eurocode_8_2004"),
            ("eurocode8", "eurocode_8_2004"),
            ("EN1998", "eurocode_8_2004"),
            ("en1998-1", "eurocode_8_2004"),
            ("en_1998_1_2004", "eurocode_8_2004"),
            ("asce_7_16", "asce_7_2016"),
            // As near to `asce_41` by letters.
            ("asce7-16", "asce_7_2016"),
            ("ASCE 7-22", "asce_7_2022"),
            ("asce41", "asce_41"),
        ] {
            let help = find_code(wrong).unwrap_err().help().unwrap();
            assert_eq!(help, format!("did you mean \"{meant}\"?"), "{wrong}");
        }
    }

    /// Every provision belongs to a code, but alternatives that a code leaves to the engineer.
    #[test]
    fn provisions_without_a_code() {
        let without = descriptors()
            .iter()
            .filter(|p| !codes().iter().any(|c| c.has(p)));
        let without: Vec<_> = without.map(|p| p.name).collect();
        assert_eq!(
            without,
            [
                "ntc_2018_without_calculation",
                "eak_2000_joint",
                "tbdy_2018_bridge_seat",
                "mexico_city_2004_boundary_simplified",
                "mexico_city_2004_between_simplified",
                "e_030_2018_beside_existing",
                "e_030_2026_beside_existing",
            ]
        );
    }

    /// Dates are years or days, an edition ends after it begins, and one that ends names what
    /// follows; names with an edition are no families of others.
    #[test]
    fn editions_are_complete() {
        let right = |text: &str| match text.len() {
            4 => format!("{text}-01-01").parse::<Date>().is_ok(),
            _ => text.parse::<Date>().is_ok(),
        };
        for code in codes() {
            let edition = code.edition();
            if let Some(known) = edition.in_force {
                let ends = known
                    .until
                    .is_none_or(|until| right(until) && known.from < until);
                assert!(right(known.from) && ends, "{}", code.name);
                assert!(
                    known.until.is_none() || edition.superseded_by.is_some(),
                    "{}",
                    code.name
                );
            }
            let others = codes().iter().filter(|c| c.family == code.name);
            assert!(others.count() <= 1, "{}", code.name);
            for (_, listed) in code.listed() {
                assert!(!listed.either.is_empty(), "{}", code.name);
                assert!(
                    listed.provisions().all(|p| p.edition == edition),
                    "{}",
                    code.name
                );
            }
        }
    }

    /// The widest reading of a disputed rule is no verdict, and neither is a minimum below it;
    /// one above all readings is. By hand, R* d = 80 and 60 mm: 140 / 3 or 280 / 3 mm, and 18 mm,
    /// or 180 mm at 90 m.
    #[test]
    fn a_disputed_rule_decides_nothing() {
        let rules = &find_code("nch_433").unwrap().code().rules[0].1;
        let Sides::Between(mut sides) = between(true) else {
            unreachable!()
        };
        (sides.left.importance, sides.right.importance) = (Some(1.0), Some(1.0));
        let found = rules.width(&Sides::Between(sides.clone())).unwrap();
        assert_eq!(found.provision.name(), "nch_433_between");
        let widths: Vec<f64> = found.requirement.readings.iter().map(|r| r.width).collect();
        assert!((widths[0] - 0.14 / 3.0).abs() < 1e-12 && (widths[1] - 0.28 / 3.0).abs() < 1e-12);
        assert!(found.requirement.undecided().is_some());
        (sides.left.elevation, sides.right.elevation) = (90.0, 90.0);
        let found = rules.width(&Sides::Between(sides)).unwrap();
        assert_eq!(found.provision.name(), "nch_433_boundary_minimum");
        assert!((found.requirement.width - 0.36).abs() < 1e-12);
        assert_eq!(found.requirement.undecided(), None);
    }
}
