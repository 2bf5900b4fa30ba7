//! Figures of analyses hold every state and every width, told apart.

use super::Bench;

#[test]
fn every_width_and_state_is_drawn() {
    let widths = [
        "5 mm", "5.04 mm", "10 mm", "16.68 mm", "20 mm", "30 mm", "40 mm", "60 mm", "90 mm",
    ];
    let quoted: Vec<String> = widths.iter().map(|width| format!("{width:?}")).collect();
    let limit = |number: usize| {
        format!(
            "[[ida.limit]]\nname = \"drift {number}\"\ndemand = \"drift_ratio\"\nbuilding = \"light\"\nexceeds = {}\n",
            0.002 * number as f64
        )
    };
    let limits: String = (1..=8).map(limit).collect();
    let bench = Bench::new(&format!(
        "case = \"case.toml\"\n[[variable]]\nrecords = [\"MOTIONS/el_centro_1940_ns.csv\", \"MOTIONS/kobe_1995_jma_ns.csv\"]\n[[variable]]\nintensity = \"peak_ground_acceleration\"\nvalues = [\"0.1 g\", \"0.3 g\", \"0.6 g\"]\n[ida]\ngaps = [{}]\n{limits}",
        quoted.join(", ")
    ));
    bench.text("ida study.toml -o out.h5 --plot figure.svg --report page.html");
    let figure = String::from_utf8(bench.bytes("figure.svg")).unwrap();
    let page = String::from_utf8(bench.bytes("page.html")).unwrap();
    let states = (1..=8).map(|number| format!("drift {number}"));
    for name in states.chain(widths.map(str::to_owned)) {
        for (text, of) in [(&figure, "figure"), (&page, "page")] {
            let drawn = text.matches(&format!(">{name}</text>")).count();
            assert_eq!(drawn, 1, "{name} in the {of}");
        }
    }
    assert!(figure.contains("Probability of a state (2 of 2)"));
    // The text in the place of the picture speaks of what is drawn.
    assert!(page.contains("aria-label=\"Incremental dynamic analysis: Maximum drift ratio"));
}
