//! What can be done where a rule does not speak of a situation.

use crate::combination::CombinationRule;
use crate::descriptor::{Place, ProvisionDescriptor};
use crate::edition::Edition;
use crate::registry::{descriptors, find};

/// What to do where a provision does not apply, beside a wall or between buildings: other rules of
/// its code that may, but those that were tried, or what there is beside the code.
pub(crate) fn where_it_does_not_apply(
    provision: &str,
    beside_wall: bool,
    tried: &[&str],
) -> String {
    let Ok(own) = find(provision) else {
        return match beside_wall {
            true => {
                "a rule for one building, with kind = \"boundary\", speaks of a wall".to_owned()
            }
            false => "state the rule for this situation too".to_owned(),
        };
    };
    let speaks = |p: &&&ProvisionDescriptor| match p.place() {
        Place::Boundary => true,
        Place::Between => !beside_wall,
        Place::Seat => false,
    };
    let all = descriptors().iter();
    let others = all
        .filter(|p| p.edition == own.edition && p.name != own.name)
        .filter(|p| !p.is_of_isolated_structures() && !tried.contains(&p.name))
        .filter(speaks);
    let others: Vec<_> = others.map(|p| p.name).collect();
    if !others.is_empty() {
        return format!(
            "choose the rule of the code that covers this situation, with --provisions: {}",
            others.join(", ")
        );
    }
    if beside_wall {
        let none = match own.place() {
            Place::Boundary => "the code has no other rule",
            Place::Between | Place::Seat => "the code has no rule for one building beside a wall",
        };
        return format!(
            "{none}: without --code the demand of the records decides, and [[separation.rule]] with kind = \"boundary\" states a rule of your own"
        );
    }
    let rules = CombinationRule::ALL.map(|rule| rule.title(None));
    format!(
        "the code has no other rule: --all shows the combination rules {}, and [[separation.rule]] states a rule of your own, which --code takes",
        rules.join(", ")
    )
}

/// What there is beside a code that says nothing of a gap.
pub(crate) const BESIDE_THE_CODE: &str = "without --code the demand of the records decides, and [[separation.rule]] states a rule of your own, which --code takes";

/// What to do where a rule for fixed bases meets a building on isolators.
pub(crate) fn on_isolators(edition: &Edition) -> String {
    let own = descriptors().iter();
    let mut own = own.filter(|p| p.edition == edition && p.is_of_isolated_structures());
    match own.next() {
        Some(rule) => format!(
            "choose the rule of the code for buildings on isolators, with --provisions: {}",
            rule.name
        ),
        None => format!(
            "no rule of the code for buildings on isolators is known here: {BESIDE_THE_CODE}"
        ),
    }
}
