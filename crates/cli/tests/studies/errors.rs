//! Studies that say something wrong.

use super::{Bench, MIXED};

/// Each change of a sound study, and what is said of it.
#[test]
fn errors_point_at_their_place() {
    let bench = Bench::new(MIXED);
    for (from, to, reasons) in [
        (
            "seed = 3",
            "sed = 3",
            vec!["study.toml:", "unknown key `sed`", "did you mean `seed`?"],
        ),
        ("[design]", "[desing]", vec!["did you mean `design`?"]),
        (
            "gap.0.width",
            "gap.0.widht",
            vec!["study.toml:", "unknown key `widht`"],
        ),
        (
            "gap.0.width",
            "gap.light-heavi.width",
            vec!["did you mean `light-heavy`?"],
        ),
        ("gap.0.width", "gap.7.width", vec!["`gap` has 1 entries"]),
        (
            "\"5 mm\"",
            "\"5 kg\"",
            vec!["`width` must be a length (m), but \"5 kg\" is a mass (kg)"],
        ),
        (
            "\"5 mm\"",
            "-0.001",
            vec!["the case refuses this for `gap.0.width`", "zero or more"],
        ),
        ("\"25 t\"", "\"-25 t\"", vec!["must be greater than zero"]),
        (
            "restitution = 0.6 }",
            "restitution = 1.6 }",
            vec!["restitution"],
        ),
        ("\"93.5 MN/m\"", "\"93.5 MN\"", vec!["is a force (N)"]),
        (
            "anagnostopoulos_2004",
            "anagnostopulos_2004",
            vec!["anagnostopoulos_2004"],
        ),
        ("runs = 60", "runs = 0", vec!["whole number from 1 on"]),
        ("latin_hypercube", "latin", vec!["unknown design \"latin\""]),
        (
            "kind = \"latin_hypercube\"\nruns = 60\nseed = 3",
            "kind = \"grid\"",
            vec!["no `count`, which a grid needs"],
        ),
        (
            "name = \"gap\"",
            "name = \"impacts\"",
            vec!["\"impacts\" cannot name a coordinate"],
        ),
        (
            "name = \"gap\"",
            "name = \"model\"",
            vec!["two variables have the name \"model\""],
        ),
        ("case.toml", "nowhere.toml", vec!["cannot read the case"]),
        (
            "from = \"5 mm\"",
            "from = \"5 mm\"\nspacing = \"log\"",
            vec!["\"linear\" or \"logarithmic\""],
        ),
        (
            "to = \"60 mm\"",
            "to = \"5 mm\"",
            vec!["the range is empty"],
        ),
    ] {
        assert!(MIXED.contains(from), "{from}");
        bench.study(&MIXED.replacen(from, to, 1));
        let told = bench.complaint("sweep study.toml", 2);
        for reason in reasons {
            assert!(told.contains(reason), "{to}: {told}");
        }
    }
    let told = bench.complaint("sweep nowhere.toml", 2);
    assert!(told.contains("nowhere.toml"), "{told}");
    bench.study(MIXED);
    bench.complaint("sweep study.toml -o nowhere/out.h5", 4);
    bench.complaint("ida study.toml", 2);
    let told = bench.complaint("sweep study.toml --show 60", 2);
    assert!(told.contains("runs 0 to 59"), "{told}");
}
