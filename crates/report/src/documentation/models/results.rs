//! The numbers on a page: achieved restitution and example collisions.

use pounding_catalogue::numbers::fixed;
use pounding_gap_element::laboratory::EXAMPLE_RESTITUTION;
use pounding_gap_element::{
    AchievedRestitution, CollisionOutcome, RestitutionTable, SeparationRule,
};

use super::example::{BODIES_IN_WORDS, Example};
use super::with_unit;

/// What the achieved restitution depends on, and its table.
pub fn restitution(example: &Example) -> String {
    let depends = match example.descriptor.achieved_restitution {
        AchievedRestitution::Elastic => "It is 1, whatever the parameters and the speed.",
        AchievedRestitution::Constant if example.descriptor.divides_by_approach_velocity() => {
            "It depends on the parameters without a unit alone: it is the same for every mass and stiffness, and for every\nspeed from 1 mm/s on, of a free collision. Slower ones are damped as at 1 mm/s, and return more."
        }
        AchievedRestitution::Constant => {
            "It depends on the parameters without a unit alone: it is the same for every mass, stiffness and speed\nof a free collision."
        }
        AchievedRestitution::Varies => {
            "It depends on mass, stiffness or speed too: these numbers hold for the example below."
        }
    };
    let mut text = format!("## Achieved restitution\n\n{depends}\n");
    let Some(((_, first), others)) = example.tables.split_first() else {
        let returned = example
            .shown
            .first()
            .map_or(f64::NAN, |s| s.outcome.restitution);
        text.push_str(&format!(
            "No restitution can be asked for. The example returns {}.\n",
            fixed(returned, 7)
        ));
        return text;
    };
    let others = distinct(first, others);
    text.push_str("\n| requested | achieved | error (%) |");
    for (names, _) in &others {
        text.push_str(&format!(" with {names} |"));
    }
    text.push_str(&format!("\n|---|---|---|{}\n", "---|".repeat(others.len())));
    for (index, row) in first.rows.iter().enumerate() {
        text.push_str(&format!(
            "| {:.1} | {} | {} |",
            row.requested,
            fixed(row.outcome.restitution, 7),
            fixed(row.error_percent(), 2)
        ));
        for (_, table) in &others {
            let achieved = table.rows[index].outcome.restitution;
            text.push_str(&format!(" {} |", fixed(achieved, 7)));
        }
        text.push('\n');
    }
    text.push_str(&format!("\nMean error {}", mean_errors(first)));
    for (names, table) in &others {
        text.push_str(&format!("; with {names} {}", mean_errors(table)));
    }
    text.push_str(".\n");
    if example.tables.len() > 1 && others.is_empty() {
        text.push_str("In a free collision all its separation rules return the same.\n");
    }
    text
}

fn mean_errors(table: &RestitutionTable) -> String {
    let [all, middle] = table.mean_errors_percent().map(|mean| fixed(mean, 2));
    format!("{all} % over 0.1 to 1.0, {middle} % over 0.5 to 0.8")
}

/// The tables that differ from the first, each with the names of its rules.
fn distinct<'a>(
    first: &RestitutionTable,
    others: &'a [(SeparationRule, RestitutionTable)],
) -> Vec<(String, &'a RestitutionTable)> {
    let same = |a: &RestitutionTable, b: &RestitutionTable| {
        a.rows
            .iter()
            .zip(&b.rows)
            .all(|(a, b)| (a.outcome.restitution - b.outcome.restitution).abs() < 1.0e-8)
    };
    let mut groups: Vec<(String, &RestitutionTable)> = Vec::new();
    for (rule, table) in others {
        let name = format!("`{}`", rule.name());
        if same(first, table) {
            continue;
        }
        match groups.iter_mut().find(|(_, known)| same(known, table)) {
            Some((names, _)) => names.push_str(&format!(", {name}")),
            None => groups.push((name, table)),
        }
    }
    groups
}

/// Peak force, penetration, contact time and loss of the example collisions, and
/// their figure.
pub fn collisions(example: &Example) -> String {
    let mut text = format!(
        "## Example collision\n\n{BODIES_IN_WORDS}{}.\n\n",
        with(example)
    );
    let columns: Vec<_> = example
        .shown
        .iter()
        .map(|s| {
            s.restitution
                .map_or_else(String::new, |e| format!("e = {e}"))
        })
        .collect();
    text.push_str(&format!(
        "| | {} |\n|---|{}\n",
        columns.join(" | "),
        "---|".repeat(columns.len())
    ));
    for (name, value) in QUANTITIES {
        let values: Vec<_> = example.shown.iter().map(|s| value(&s.outcome)).collect();
        text.push_str(&format!("| {name} | {} |\n", values.join(" | ")));
    }
    if example.is_rigid() {
        text.push_str("\nNo figure: velocities jump, and there is neither penetration nor a force to draw over it.\n");
    } else {
        let name = example.descriptor.name;
        text.push_str(&format!(
            "\n![Contact force over penetration of the example collisions, {name}]({name}.svg)\n"
        ));
    }
    text
}

/// The example's parameters but the restitution, in words.
fn with(example: &Example) -> String {
    let d = example.descriptor;
    let mut parameters = d.example_parameters(EXAMPLE_RESTITUTION);
    parameters.values.remove("restitution");
    let list: Vec<_> = d
        .parameters
        .iter()
        .filter_map(|p| Some((p.name, *parameters.values.get(p.name)?)))
        .map(|(name, value)| {
            let (value, _) = with_unit(d, &parameters, name, value);
            format!("`{name}` {value}")
        })
        .collect();
    if list.is_empty() {
        String::new()
    } else {
        format!("; {}", list.join(", "))
    }
}

type Quantity = (&'static str, fn(&CollisionOutcome) -> String);

/// What is shown of a collision.
const QUANTITIES: [Quantity; 8] = [
    ("achieved restitution", |o| fixed(o.restitution, 7)),
    ("peak force (kN)", |o| of_force(o, 1.0e-3 * o.peak_force, 2)),
    ("its time after closure (ms)", |o| {
        of_force(o, 1.0e3 * o.peak_force_time, 3)
    }),
    ("peak penetration (mm)", |o| {
        of_force(o, 1.0e3 * o.peak_penetration, 4)
    }),
    ("contact time (ms)", |o| of_force(o, 1.0e3 * o.duration, 3)),
    ("impulse (kN s)", |o| fixed(1.0e-3 * o.impulse, 4)),
    ("energy lost (kJ)", |o| {
        fixed(1.0e-3 * o.energy_dissipated, 4)
    }),
    ("speeds after, left and right (m/s)", |o| {
        format!(
            "{}, {}",
            fixed(o.velocity_left, 5),
            fixed(o.velocity_right, 5)
        )
    }),
];

/// What belongs to a deforming contact; a jump of velocities has none.
fn of_force(outcome: &CollisionOutcome, value: f64, decimals: usize) -> String {
    if outcome.is_rigid() {
        "none".to_owned()
    } else {
        fixed(value, decimals)
    }
}
