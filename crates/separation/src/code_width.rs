//! The width that rules of a code give together, between two buildings or beside a wall.

use pounding_catalogue::numbers::rounded_up;

use crate::descriptor::{Basis, Place};
use crate::error::SeparationError;
use crate::inputs::{Site, Situation, Structure};
use crate::ownership::Ownership;
use crate::provision::Provision;
use crate::remedy;
use crate::working::{ReadingWidth, Requirement, Working};

/// Rules that give one width together.
#[derive(Debug, Clone)]
pub struct Rules {
    /// Of these the first that applies.
    pub either: Vec<Provision>,
    /// A width that holds beside it.
    pub minimum: Option<Provision>,
    /// The rule for buildings on isolators, in the place of the others.
    pub isolated: Option<Provision>,
}

/// A width by a code at one level.
#[derive(Debug, Clone)]
pub struct CodeWidth {
    /// The provision that gives it.
    pub provision: Provision,
    /// Across a property line that of the other building, where it goes by another one.
    pub beside: Option<Provision>,
    /// What it requires.
    pub requirement: Requirement,
    /// Whether displacements count in it: whether the provision takes them, or one that was held
    /// against it.
    pub takes_displacements: bool,
    /// What it asks for whatever the displacements are: its least width, of a rule of displacements that
    /// of buildings which stand still, such as a minimum within it. `None` where that is nothing.
    pub without_displacements: Option<LeastWidth>,
}

impl CodeWidth {
    /// The provisions that give it: one, or that of either building.
    pub fn provisions(&self) -> impl Iterator<Item = &Provision> {
        std::iter::once(&self.provision).chain(&self.beside)
    }
}

/// What a code asks for at least, as one of its provisions does without displacements.
#[derive(Debug, Clone)]
pub struct LeastWidth {
    /// The provision.
    pub provision: Provision,
    /// Width (m), without a displacement of the ground.
    pub width: f64,
}

impl Rules {
    /// All provisions among them.
    pub fn provisions(&self) -> impl Iterator<Item = &Provision> {
        self.either
            .iter()
            .chain(&self.minimum)
            .chain(&self.isolated)
    }

    /// The error of the first rule that does not apply, with what can be done where none does.
    fn with_remedy(&self, error: SeparationError, sides: &Sides) -> SeparationError {
        if sides.structures().iter().any(|s| s.on_isolators) {
            return error;
        }
        match error {
            SeparationError::NotApplicable {
                provision, reason, ..
            } => {
                let beside_wall = matches!(sides, Sides::Wall { .. });
                let tried: Vec<&str> = self.either.iter().map(Provision::name).collect();
                let remedy = remedy::where_it_does_not_apply(&provision, beside_wall, &tried);
                SeparationError::NotApplicable {
                    provision,
                    reason,
                    remedy,
                }
            }
            other => other,
        }
    }

    /// Width between two buildings, or of one beside a wall: where they stand on isolators that of
    /// the rule for such, if there is one; else of the rules the first that applies, and no less than
    /// the minimum. A minimum stands beside a disputed rule where it
    /// is no less than any of its readings. Where all rules are for one building, each building keeps
    /// the distance of its own rule: either may have another one than its neighbour.
    ///
    /// # Errors
    /// An input that is missing, or no rule that applies.
    pub fn width(&self, sides: &Sides) -> Result<CodeWidth, SeparationError> {
        let ground = sides.site().relative_ground_displacement;
        let of = |provision: &Provision| {
            sides.asks(provision).map(|requirement| {
                let takes_displacements = provision.basis() == Basis::Displacement;
                let least = match (takes_displacements, provision) {
                    (false, _) => Some(requirement.least()),
                    // No width of the registry falls where displacements grow.
                    (true, Provision::BuiltIn(_)) => {
                        let at_rest = sides.at_rest().asks(provision);
                        at_rest
                            .ok()
                            .map(|r| r.least())
                            .filter(|width| *width > ground)
                    }
                    (true, Provision::Own(_)) => None,
                };
                CodeWidth {
                    provision: provision.clone(),
                    beside: None,
                    takes_displacements,
                    without_displacements: least.map(|width| LeastWidth {
                        provision: provision.clone(),
                        width: width - ground,
                    }),
                    requirement,
                }
            })
        };
        if let Some(rule) = &self.isolated
            && sides.structures().iter().any(|s| s.on_isolators)
        {
            sides.all_on_isolators(rule.name())?;
            return of(rule);
        }
        if let Sides::Between(situation) = sides
            && let Some(width) = self.of_unlike_sides(situation)?
        {
            return Ok(width);
        }
        let mut first = Err(SeparationError::NotApplicable {
            provision: "the code".to_owned(),
            reason: "it has no rule for this situation".to_owned(),
            remedy: String::new(),
        });
        for provision in &self.either {
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
        let first = first.map_err(|e| self.with_remedy(e, sides))?;
        match self.minimum.as_ref().map(of) {
            // A minimum between buildings says nothing beside a wall.
            None | Some(Err(SeparationError::NotApplicable { .. })) => Ok(first),
            Some(least) => {
                let least = least?;
                let first = first.no_less_than(&least);
                let takes_displacements = first.takes_displacements || least.takes_displacements;
                // The width of a disputed rule is that of its widest reading.
                let wider = least.requirement.width > first.requirement.width;
                let without = [&first, &least].map(|width| width.without_displacements.clone());
                let without = without.into_iter().flatten();
                Ok(CodeWidth {
                    takes_displacements,
                    without_displacements: without.max_by(|a, b| a.width.total_cmp(&b.width)),
                    ..if wider { least } else { first }
                })
            }
        }
    }

    /// The sum of the distances of both buildings, where they go by different rules for one building, or by different
    /// ones by some reading of a disputed rule; `None` where one rule holds for both, or some rule is for the pair.
    fn of_unlike_sides(&self, situation: &Situation) -> Result<Option<CodeWidth>, SeparationError> {
        let rules = || self.either.iter().chain(&self.minimum);
        if rules().count() < 2 || !rules().all(|p| p.place() == Place::Boundary) {
            return Ok(None);
        }
        // What the ground adds is added once.
        let ground = situation.site.relative_ground_displacement;
        let own = |structure: &Structure| {
            let sides = Sides::Wall {
                structure: Box::new(structure.clone()),
                site: Site {
                    relative_ground_displacement: 0.0,
                    ..situation.site
                },
            };
            self.width(&sides)
        };
        let sides = [own(&situation.left), own(&situation.right)];
        let is_refused =
            |side: &Result<_, _>| matches!(side, Err(SeparationError::NotApplicable { .. }));
        if sides.iter().any(is_refused) {
            return Ok(None);
        }
        let [left, right] = sides;
        let (left, right) = (left?, right?);
        let sides = [left, right];
        let required = sides.each_ref().map(|side| &side.requirement);
        let widths = required.map(|r| r.width);
        let disputed = required.iter().position(|r| !r.readings.is_empty());
        // By each reading; a side without has the same width by all.
        let readings: Vec<ReadingWidth> = match disputed {
            None => Vec::new(),
            Some(side) => (0..required[side].readings.len())
                .map(|k| {
                    let of = |r: &Requirement| r.readings.get(k).map_or(r.width, |own| own.width);
                    ReadingWidth {
                        text: required[side].readings[k].text,
                        width: of(required[0]) + of(required[1]) + ground,
                    }
                })
                .collect(),
        };
        let is_alike = sides[0].provision.name() == sides[1].provision.name();
        if is_alike {
            let both = Sides::Between(Box::new(situation.clone())).asks(&sides[0].provision)?;
            let is_same =
                |(a, b): (&ReadingWidth, &ReadingWidth)| (a.width - b.width).abs() <= 1.0e-12;
            if readings.iter().zip(&both.readings).all(is_same) {
                return Ok(None);
            }
        }
        let total = |of: &dyn Fn(&CodeWidth) -> f64| sides.iter().map(of).sum::<f64>();
        let mut working = Working::new("", remedy::where_it_does_not_apply);
        let width = working.summed(widths[0], widths[1]);
        let caution = required.iter().find_map(|r| r.caution.clone());
        let explained = |k: usize, name: &str| {
            let (rule, told) = (sides[k].provision.name(), &required[k].explanation);
            format!("{name} by {rule}: {told}")
        };
        let formula = format!(
            "{}; {}; summed over both sides",
            explained(0, &situation.left.name),
            explained(1, &situation.right.name)
        );
        let mut requirement = working.finish(&formula, (width, &situation.site), caution)?;
        let factors = required.iter().flat_map(|r| r.factors.iter().cloned());
        requirement.factors = factors.chain(requirement.factors).collect();
        requirement.readings = readings;
        let least = total(&|side| side.without_displacements.as_ref().map_or(0.0, |w| w.width));
        let takes = sides.each_ref().map(|side| side.takes_displacements);
        // Named is the rule that the verdict depends on: a disputed one, one that takes displacements, the wider.
        let wider = usize::from(widths[1] > widths[0]);
        let named = disputed.unwrap_or(match takes {
            [true, false] => 0,
            [false, true] => 1,
            _ => wider,
        });
        let least_of = |side: &CodeWidth| side.without_displacements.clone();
        let of_least = sides.iter().filter_map(least_of);
        let of_least = of_least.max_by(|a, b| a.width.total_cmp(&b.width));
        Ok(Some(CodeWidth {
            provision: sides[named].provision.clone(),
            beside: (!is_alike).then(|| sides[1 - named].provision.clone()),
            takes_displacements: takes.contains(&true),
            without_displacements: of_least.map(|of| LeastWidth { width: least, ..of }),
            requirement,
        }))
    }
}

impl CodeWidth {
    /// The same with readings that all ask for what a minimum does.
    fn no_less_than(mut self, least: &Self) -> Self {
        let width = least.requirement.width;
        let readings = &mut self.requirement.readings;
        if readings.iter().any(|reading| reading.width < width) {
            for reading in readings {
                reading.width = reading.width.max(width);
            }
            self.requirement.explanation.push_str(&format!(
                "; no less than {} mm by {}",
                rounded_up(width * 1e3, 1),
                least.provision.name()
            ));
        }
        self
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
        /// The site.
        site: Site,
    },
}

impl Sides {
    /// The buildings.
    fn structures(&self) -> Vec<&Structure> {
        match self {
            Self::Between(situation) => vec![&situation.left, &situation.right],
            Self::Wall { structure, .. } => vec![structure],
        }
    }

    fn site(&self) -> &Site {
        match self {
            Self::Between(situation) => &situation.site,
            Self::Wall { site, .. } => site,
        }
    }

    /// What a provision asks for here.
    pub(crate) fn asks(&self, provision: &Provision) -> Result<Requirement, SeparationError> {
        match self {
            Self::Between(situation) => provision.between(situation),
            Self::Wall { structure, site } => provision.boundary(structure, site),
        }
    }

    /// The same with buildings that do not move.
    fn at_rest(&self) -> Self {
        let mut sides = self.clone();
        let still = |structure: &mut Structure| {
            for u in [
                &mut structure.displacement,
                &mut structure.elastic_displacement,
            ] {
                *u = u.map(|_| 0.0);
            }
        };
        match &mut sides {
            Self::Between(situation) => {
                still(&mut situation.left);
                still(&mut situation.right);
            }
            Self::Wall { structure, .. } => still(structure),
        }
        sides
    }

    /// Refuses a building on a fixed base beside one on isolators, of whose own displacement a rule
    /// for isolated buildings says nothing.
    fn all_on_isolators(&self, provision: &str) -> Result<(), SeparationError> {
        let all = self.structures();
        let Some(fixed) = all.iter().find(|s| !s.on_isolators) else {
            return Ok(());
        };
        let isolated = all.iter().filter(|s| s.on_isolators);
        let isolated: Vec<&str> = isolated.map(|s| &*s.name).collect();
        Err(SeparationError::NotApplicable {
            provision: provision.to_owned(),
            reason: format!(
                "it is a rule for buildings on isolators, as {}, and {} stands on none: its own displacement comes on top",
                isolated.join(" and "),
                fixed.name
            ),
            remedy: format!(
                "no rule of the code for both is known here: {}",
                remedy::BESIDE_THE_CODE
            ),
        })
    }

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
