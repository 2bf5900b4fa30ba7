//! Isolators under buildings.
use std::path::Path;

use pounding_case::{
    Building, Case, CaseError, Damping, Isolator, IsolatorKind, PostYield, Strength,
};

fn parse(building: &str) -> Result<Case, CaseError> {
    let text = format!(
        "[[building]]\nname = \"a\"\nheight = 3\n{building}\n\n[ground_motion]\nfile = \"r.csv\"\n"
    );
    Case::parse(&text, Path::new("case.toml"))
}

fn building(text: &str) -> Building {
    parse(text).unwrap().buildings.remove(0)
}

const ABOVE: &str = "mass = [2e5, 2e5, 2e5]\nstiffness = [4e8, 3e8]\ndamping = { modal = [0.02, 0.03] }\n[building.isolator]\n";
const RUBBER: &str = "model = \"lead_rubber\"\npost_yield_period = \"2.5 s\"\nstrength = \"6 %\"\n";
const PENDULUM: &str = "model = \"friction_pendulum\"\nradius = \"2 m\"\nfriction_fast = 0.08\nfriction_slow = 0.04\nrate = \"30 s/m\"\nyield_displacement = \"1 mm\"\n";

fn isolator(text: &str) -> Isolator {
    building(&format!("{ABOVE}{text}")).isolator.unwrap().value
}

#[test]
fn every_form_is_read_in_si_units() {
    let rubber = |post_yield, strength, stiffness_ratio, dashpot| Isolator {
        kind: IsolatorKind::LeadRubber {
            post_yield,
            strength,
            stiffness_ratio,
        },
        dashpot,
    };
    let period = PostYield::Period(2.5);
    let share = Some(Strength::OfWeight(0.06));
    assert_eq!(isolator(RUBBER), rubber(period, share, 10.0, 0.0));
    let other = "model = \"lead_rubber\"\npost_yield_stiffness = \"5 MN/m\"\nyield_force = \"400 kN\"\nstiffness_ratio = 8\ndamping = \"200 kN s/m\"\n";
    let stiffness = PostYield::Stiffness(5.0e6);
    let force = Some(Strength::YieldForce(4.0e5));
    assert_eq!(isolator(other), rubber(stiffness, force, 8.0, 2.0e5));
    // Plain rubber, with the strength that it has or without a word of it.
    for plain in ["", "strength = 0\n"] {
        let plain = format!(
            "model = \"lead_rubber\"\npost_yield_period = 2.5\nstiffness_ratio = 1\n{plain}"
        );
        assert_eq!(isolator(&plain), rubber(period, None, 1.0, 0.0));
    }
    let expected = IsolatorKind::FrictionPendulum {
        radius: 2.0,
        friction_fast: 0.08,
        friction_slow: 0.04,
        rate: 30.0,
        yield_displacement: 0.001,
    };
    assert_eq!(isolator(PENDULUM).kind, expected);
}

/// The isolator is storey 1 and the slab floor 1; what is above counts without it.
#[test]
fn storeys_are_counted_with_the_isolator() {
    let listed = building(&format!("{ABOVE}{RUBBER}"));
    assert_eq!((listed.mass.len(), listed.height.len()), (3, 3));
    assert_eq!(listed.stiffness, [4e8, 3e8]);
    let ratios = vec![0.02, 0.03];
    assert_eq!(listed.damping.value, Damping::Modal { ratios });
    let one = "storeys = 4\nmass = 2e5\nstiffness = 4e8\ndamping = { ratio = 0.05, modes = [1, 3] }\nlaw = { model = \"bouc_wen\", yield_force = 1e6 }\n[building.isolator]\n";
    let one = building(&format!("{one}{RUBBER}"));
    assert_eq!((one.mass.len(), one.stiffness.len()), (4, 3));
    assert_eq!(one.laws[0].storeys, [1, 2, 3]);
    // A slab alone has neither.
    let slab = building(&format!("mass = [8e5]\n[building.isolator]\n{PENDULUM}"));
    assert!(slab.stiffness.is_empty() && slab.mass == [8e5]);
}

/// Each with what its one error says, where, and a remedy.
#[test]
fn what_cannot_be_is_refused_once_at_its_place() {
    let above = |more: &str| format!("{ABOVE}{more}");
    let rubber = |more: &str| above(&format!("model = \"lead_rubber\"\n{more}"));
    let with = |line: &str, other: &str| {
        let key = line.split(' ').next().unwrap();
        let kept = PENDULUM.lines().filter(|l| !l.starts_with(key));
        let kept: Vec<_> = kept.chain([other]).collect();
        above(&kept.join("\n"))
    };
    let table = "[building.isolator]";
    for (text, place, says) in [
        (above("strength = 0.06"), table, "has no `model`"),
        (
            format!("mass = [8e5]\ndamping = {{ dashpots = 5e4 }}\n{table}\n{PENDULUM}"),
            "{ dashpots = 5e4 }",
            "a slab alone on its isolators has no storeys",
        ),
        (
            above("model = \"lead_ruber\""),
            "\"lead_ruber\"",
            "unknown isolator \"lead_ruber\"",
        ),
        (
            rubber("strength = 0.06"),
            table,
            "has no `post_yield_period`",
        ),
        (
            rubber("post_yield_period = 2.5"),
            table,
            "has no `strength`",
        ),
        (
            rubber("post_yield_period = 2.5\npost_yield_stiffness = 5e6\nstrength = 0.06"),
            "5e6",
            "either `post_yield_period` or `post_yield_stiffness`, not both",
        ),
        (
            rubber("post_yield_period = 2.5\nyield_force = 4e5\nstrength = 0.06"),
            "4e5",
            "either `strength` or `yield_force`, not both",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = 0"),
            "0",
            "`strength` = 0 must be above 0 and below 1",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = 1.5"),
            "1.5",
            "`strength` = 1.5 must be above 0 and below 1",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = -0.1"),
            "-0.1",
            "must be zero or more",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = 0.06\nstiffness_ratio = 0.5"),
            "0.5",
            "must be 1 or more",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = 0.06\nstiffness_ratio = 1"),
            "0.06",
            "plain rubber, which does not yield",
        ),
        (
            rubber("post_yield_period = \"2.5 m\"\nstrength = 0.06"),
            "\"2.5 m\"",
            "must be a time (s)",
        ),
        (
            rubber("post_yield_period = 2.5\nstrength = 0.06\nradius = 2"),
            "2",
            "`radius` has no meaning beside model = \"lead_rubber\"",
        ),
        (
            rubber("post_yield_period = 2.5\nstrenght = 0.06"),
            "strenght",
            "unknown key `strenght` in [building.isolator]",
        ),
        (
            with("strength", "strength = 0.06"),
            "0.06",
            "`strength` has no meaning beside model = \"friction_pendulum\"",
        ),
        (with("radius", ""), table, "has no `radius`"),
        (with("rate", ""), table, "has no `rate`"),
        (
            with("friction_slow", "friction_slow = 0.09"),
            "0.09",
            "`friction_slow` = 0.09 is above `friction_fast` = 0.08",
        ),
        (
            with("friction_fast", "friction_fast = 1.2"),
            "1.2",
            "`friction_fast` = 1.2 must be below 1",
        ),
        (
            with("yield_displacement", "yield_displacement = 0"),
            "0",
            "must be greater than zero",
        ),
        (
            format!(
                "mass = [2e5, 2e5, 2e5]\nstiffness = [4e8, 3e8, 3e8]\ndamping = {{ modal = 0.05 }}\n{table}\n{RUBBER}"
            ),
            "[4e8, 3e8, 3e8]",
            "`stiffness` has 3 values, but `mass` says 3 storeys with the isolator",
        ),
        (
            format!("mass = [2e5, 2e5]\ndamping = {{ modal = 0.05 }}\n{table}\n{RUBBER}"),
            "[[building]]",
            "has no `stiffness`",
        ),
        (
            format!("mass = [2e5, 2e5]\nstiffness = 1e8\n{table}\n{RUBBER}"),
            "[[building]]",
            "has no `damping`",
        ),
        (
            format!(
                "mass = [2e5]\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\n{table}\n{RUBBER}"
            ),
            "1e8",
            "no storey above for `stiffness`",
        ),
        (
            format!(
                "mass = [2e5, 2e5]\nstiffness_matrix = [[2e8, -1e8], [-1e8, 1e8]]\ndamping = {{ modal = 0.05 }}\n{table}\n{RUBBER}"
            ),
            "[[2e8, -1e8], [-1e8, 1e8]]",
            "an isolator is the first of a chain of storeys, but this building has `stiffness_matrix`",
        ),
        (
            format!(
                "mass = [2e5, 2e5]\nstiffness = 1e8\np_delta = true\ndamping = {{ modal = 0.05 }}\n{table}\n{RUBBER}"
            ),
            "true",
            "`p_delta` does not go with an isolator",
        ),
        (
            format!(
                "mass = [2e5, 2e5]\nstiffness = 1e8\ndamping = {{ modal = 0.05 }}\nlaw = {{ model = \"bouc_wen\", storeys = [1], yield_force = 1e6 }}\n{table}\n{RUBBER}"
            ),
            "1",
            "storey 1 is the isolator",
        ),
        (
            format!(
                "mass = [2e5, 2e5]\nstiffness = 1e8\ndamping = {{ modal = [0.05, 0.05] }}\n{table}\n{RUBBER}"
            ),
            "[0.05, 0.05]",
            "2 values where there is 1 mode",
        ),
        (
            format!(
                "mass = [2e5, 2e5, 2e5]\nstiffness = 1e8\ndamping = {{ ratio = 0.05, modes = [1, 3] }}\n{table}\n{RUBBER}"
            ),
            "[1, 3]",
            "`modes` must be two different modes from 1 to 2",
        ),
    ] {
        let error = parse(&text).unwrap_err();
        assert!(error.message.contains(says), "{says} is not in {error:?}");
        assert!(error.others.is_empty(), "{text}: {:?}", error.others);
        let source = format!(
            "[[building]]\nname = \"a\"\nheight = 3\n{text}\n\n[ground_motion]\nfile = \"r.csv\"\n"
        );
        let found = &source[error.span.clone()];
        assert!(found.starts_with(place), "{says}: at {found}");
        assert!(error.help.is_some_and(|h| !h.is_empty()), "{says}");
    }
}
