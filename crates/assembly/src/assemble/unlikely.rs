//! What a case says of its row and of its contacts that hardly any case means: warnings, in words.

use pounding_case::{Case, Side};
use pounding_time_history::short;

/// Damping ratio of a contact that none has: it gives back next to nothing of an approach.
const DAMPING_RATIO: f64 = 4.0;

/// All of them.
pub(super) fn unlikely(case: &Case) -> Vec<String> {
    let mut told = apart(case);
    told.extend(damping_ratios(case));
    told
}

/// Neighbours that nothing joins, where gaps join others: a gap that was forgotten. Buildings are listed from the left.
fn apart(case: &Case) -> Vec<String> {
    let gaps: Vec<[Side; 2]> = case.gaps.iter().map(|gap| gap.between).collect();
    let links = case.links.iter().map(|link| link.between);
    let joins: Vec<[Side; 2]> = gaps.iter().copied().chain(links).collect();
    let between = |left: usize| [left, left + 1].map(Side::Building);
    let lie_between = |sides: &[[Side; 2]], left: usize| {
        let [one, other] = between(left);
        sides.contains(&[one, other]) || sides.contains(&[other, one])
    };
    let lefts = 0..case.buildings.len().saturating_sub(1);
    if !lefts.clone().any(|left| lie_between(&gaps, left)) {
        return Vec::new();
    }
    let lost = lefts.filter(|left| !lie_between(&joins, *left));
    lost.map(|left| {
        let [left, right] = [left, left + 1].map(|b| &case.buildings[b].name.value);
        format!(
            "nothing keeps \"{left}\" and \"{right}\" apart, neighbours in the row with neither gap nor link between them, while others have gaps: is a [[gap]] missing? If they stand far apart, a [[gap]] of that width says so"
        )
    })
    .collect()
}

/// Damping ratios of contacts in percent, the first of each gap.
fn damping_ratios(case: &Case) -> impl Iterator<Item = String> {
    case.gaps.iter().filter_map(|gap| {
        let mut parameters = gap.parameters.iter();
        let given = parameters.find(|p| p.key.value == "damping_ratio")?;
        let mut ratios = given.values.iter().map(|ratio| ratio.value.value);
        let ratio = ratios.find(|ratio| *ratio > DAMPING_RATIO)?;
        Some(format!(
            "gap {}: the `damping_ratio` of its contacts is {}, which gives back next to nothing of an approach: 5 % of critical is 0.05, or \"5 %\"",
            gap.name,
            short(ratio)
        ))
    })
}
