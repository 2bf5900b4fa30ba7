//! The index of the pages.

use pounding_hysteresis::LawDescriptor;

/// The index of all laws.
pub fn index(laws: &[&'static LawDescriptor]) -> String {
    let mut text = format!(
        "\n# Laws of storeys and links\n\n{} laws. What they are for, how a storey or a link gets one and what comes out: [hysteresis](../yielding-storeys-and-links.md);\nto add one, see [the guide](../../how-to/add-a-hysteresis-law.md). `secondary sources`: the rules could not be read in the\npapers themselves; the page says what was checked. Every law serves as a link; a storey needs one that\nresists lasting deformations in both directions.\n\n| law | | storey | depends on the rate | checked |\n|---|---|---|---|---|\n",
        laws.len()
    );
    let mark = |yes: bool| if yes { "yes" } else { "" };
    for law in laws {
        text.push_str(&format!(
            "| [`{0}`]({0}.md) | {1} | {2} | {3} | {4} |\n",
            law.name,
            law.title,
            mark(law.link_alone.is_none()),
            mark(law.rate_dependent),
            law.verification.name()
        ));
    }
    text
}
