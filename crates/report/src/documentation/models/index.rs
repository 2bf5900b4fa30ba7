//! The index of the pages: every model in its family, and what all of them return.

use pounding_catalogue::numbers::fixed;

use super::example::{BODIES_IN_WORDS, Example};

/// The index of all models.
pub fn index(examples: &[Example]) -> String {
    let mut text = format!(
        "\n# Impact models\n\n{} models, grouped by family. Families, conventions and separation rules are explained in\n[contact laws](../../theory/contact-laws.md), stiffnesses in [contact stiffness](../../how-to/contact-stiffness.md); to add a\nmodel, see [the guide](../../how-to/add-an-impact-model.md).\n\n**Recommended** models return the restitution asked for, whatever mass and stiffness, and\nwhatever speed from 1 mm/s on. Mean errors are those of the achieved restitution in a free collision, over requested\nrestitutions of 0.1, 0.2, ... 1.0 and of 0.5 to 0.8, with the separation rule that the model has by default. `secondary sources`: the\nformula or a constant could not be read in the paper itself; the page says what was. Models that take no\nrestitution show what their example returns.\n",
        examples.len()
    );
    let mut families: Vec<&str> = Vec::new();
    for example in examples {
        if !families.contains(&example.descriptor.family()) {
            families.push(example.descriptor.family());
        }
    }
    for family in families {
        text.push_str(&format!(
            "\n## {}\n\n| model | law | class | checked | mean error 0.1-1.0 (%) | mean error 0.5-0.8 (%) |\n|---|---|---|---|---|---|\n",
            capitalised(family)
        ));
        let members = examples.iter().filter(|x| x.descriptor.family() == family);
        members.for_each(|x| text.push_str(&member(x)));
    }
    text.push_str(&overview(examples));
    text
}

fn capitalised(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

fn link(example: &Example) -> String {
    let d = example.descriptor;
    let mark = if d.recommended {
        " **recommended**"
    } else {
        ""
    };
    format!("[`{0}`]({0}.md){mark}", d.name)
}

fn member(example: &Example) -> String {
    let d = example.descriptor;
    let errors = example.tables.first().map_or_else(
        || {
            let returned = example
                .shown
                .first()
                .map_or(f64::NAN, |s| s.outcome.restitution);
            format!("(example returns {}) | -", fixed(returned, 4))
        },
        |(_, table)| {
            let [all, middle] = table.mean_errors_percent().map(|mean| fixed(mean, 2));
            format!("{all} | {middle}")
        },
    );
    format!(
        "| {} | {} | {} | {} | {errors} |\n",
        link(example),
        d.title,
        d.class,
        d.verification.name()
    )
}

/// Requested against achieved restitution of all models that take one.
fn overview(examples: &[Example]) -> String {
    let with_table = || examples.iter().filter_map(|x| Some((x, x.tables.first()?)));
    let Some((_, (_, first))) = with_table().next() else {
        return String::new();
    };
    let mut text = format!(
        "\n## Achieved for requested restitution\n\n{BODIES_IN_WORDS}; each page says with which parameters.\n\n| model |",
    );
    for row in &first.rows {
        text.push_str(&format!(" {:.1} |", row.requested));
    }
    text.push_str(&format!("\n|---|{}\n", "---|".repeat(first.rows.len())));
    for (example, (_, table)) in with_table() {
        text.push_str(&format!("| {} |", link(example)));
        for row in &table.rows {
            text.push_str(&format!(" {} |", fixed(row.outcome.restitution, 4)));
        }
        text.push('\n');
    }
    text
}
