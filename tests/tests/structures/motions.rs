//! Buildings on different ground motions, from case files.

use std::path::Path;

use pounding_assembly::{Assembly, assemble};
use pounding_case::Case;
use pounding_time_history::{MethodChoice, Outcome, RunOptions, System, run};

use super::reference::Reference;

/// Two buildings; `ground` stands in the table of the second one.
fn pair(ground: &str) -> String {
    format!(
        r#"
[[building]]
name = "A"
mass = [25000.0, 25000.0, 25000.0]
stiffness = 13840000.0
height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 3] }}

[[building]]
name = "B"
mass = [60000.0, 60000.0, 60000.0]
stiffness = 80000000.0
height = "3 m"
damping = {{ ratio = 0.05, modes = [1, 3] }}
{ground}

[[gap]]
between = ["A", "B"]
width = 0.03
model = "anagnostopoulos_2004"
stiffness = 93500000.0
restitution = 0.65

[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"

[analysis]
duration = 25
"#
    )
}

pub(super) fn assembled(text: &str) -> Assembly {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("pair.toml");
    assemble(&Case::parse(text, &file).unwrap()).unwrap()
}

pub(super) fn go(system: &System, options: &RunOptions) -> Outcome {
    run(system, options, &mut [], &mut |_| {}).unwrap()
}

fn by(assembly: &Assembly, method: MethodChoice) -> Outcome {
    let options = RunOptions {
        method,
        ..assembly.options
    };
    go(&assembly.system, &options)
}

#[test]
fn a_delay_in_the_case_gives_the_reference() {
    let text = include_str!("../../data/structures/wave_passage_pair.json");
    let reference = Reference::read(text);
    for ground in [
        "ground = { delay = \"0.13 s\" }",
        "ground = { distance = \"59.8 m\", wave_speed = \"460 m/s\" }",
        "ground = { file = \"../ground_motions/el_centro_1940_ns.csv\", delay = 0.13 }",
    ] {
        let assembly = assembled(&pair(ground));
        reference.agrees(&go(&assembly.system, &assembly.options), 1e-8);
    }
    let adaptive = MethodChoice::Adaptive {
        relative_tolerance: 1e-11,
    };
    let assembly = assembled(&pair("ground = { delay = \"0.13 s\" }"));
    reference.agrees(&by(&assembly, adaptive), 1e-8);
}

/// The implicit method comes to the reference with the square of its step.
#[test]
fn newmark_converges_to_the_reference() {
    let text = include_str!("../../data/structures/wave_passage_pair.json");
    let reference = Reference::read(text);
    let assembly = assembled(&pair("ground = { delay = \"0.13 s\" }"));
    let errors = [2e-4, 1e-4].map(|step| {
        let newmark = MethodChoice::Newmark {
            step,
            beta: 0.25,
            gamma: 0.5,
        };
        let outcome = by(&assembly, newmark);
        let roof = outcome.buildings[0].storeys[2].displacement.value;
        assert!(
            outcome.energy.residual_ratio < 1e-6,
            "{:e}",
            outcome.energy.residual_ratio
        );
        (roof - reference.peak("u_A3")).abs()
    });
    assert!(
        errors[1] < 1e-5 && errors[1] < 0.4 * errors[0],
        "{errors:?}"
    );
}

/// Without delay there is one motion: the bits of a case that says nothing of the ground.
#[test]
fn no_delay_is_one_motion() {
    let alone = assembled(&pair(""));
    let delayed = assembled(&pair("ground = { delay = 0 }"));
    let [a, b] = [&alone, &delayed].map(|x| go(&x.system, &x.options));
    assert_eq!(a, b);
    // The same record as a file of its own: the ground on both sides moves alike.
    let own = "ground = { file = \"../ground_motions/el_centro_1940_ns.csv\" }";
    let twice = assembled(&pair(own));
    let c = go(&twice.system, &twice.options);
    assert_eq!(a.impacts.len(), c.impacts.len());
    for (one, other) in a.impacts.iter().zip(&c.impacts) {
        let off = one.peak_force.value / other.peak_force.value - 1.0;
        assert!(off.abs() < 1e-7, "{off:e}");
    }
}

/// Ground that moves alike under two buildings of one kind, by two motions of their own, takes both
/// along: the gap, a thousandth of what the ground moves by, neither closes nor opens.
#[test]
fn a_rigid_translation_leaves_the_gap_alone() {
    let own = "ground = { file = \"../ground_motions/el_centro_1940_ns.csv\" }";
    let twins = |ground: &str| {
        let alike = pair(ground)
            .replace("60000.0", "25000.0")
            .replace("80000000.0", "13840000.0");
        assembled(&alike.replace("width = 0.03", "width = 1e-4\nseat = 1.0"))
    };
    let together = twins(own);
    let outcome = go(&together.system, &together.options);
    assert_eq!(outcome.impacts.len(), 0);
    assert!(outcome.buildings[0].storeys[2].displacement.value > 0.03);
    for level in &outcome.gaps[0].levels {
        let opening = level.responses[0].peak.value;
        assert!(opening.abs() < 1e-12, "{opening:e}");
        assert_eq!(level.first_contact, None);
    }
    let apart = twins(&own.replace(" }", ", delay = 0.5 }"));
    assert!(!go(&apart.system, &apart.options).impacts.is_empty());
}

/// Both buildings later by the same time: the run, later.
#[test]
fn a_delay_of_all_shifts_the_run() {
    let text = pair("ground = { delay = 0.4 }");
    let both = text.replacen(
        "damping = { ratio = 0.05, modes = [1, 3] }",
        "damping = { ratio = 0.05, modes = [1, 3] }\nground = { delay = 0.4 }",
        1,
    );
    let (alone, later) = (assembled(&pair("")), assembled(&both));
    let a = go(&alone.system, &alone.options);
    let b = go(&later.system, &later.options);
    let known: Vec<_> = a.impacts.iter().filter(|i| i.time_closed < 24.5).collect();
    assert!(known.len() > 10 && b.impacts.len() >= known.len());
    for (one, other) in known.iter().zip(&b.impacts) {
        assert!((one.time_closed + 0.4 - other.time_closed).abs() < 1e-8);
        let off = one.peak_force.value / other.peak_force.value - 1.0;
        assert!(off.abs() < 1e-7, "{off:e}");
    }
}

/// A wall that stands still in space meets the absolute displacement; in space, a stiff
/// building moves with the ground.
#[test]
fn a_fixed_wall_meets_the_ground_displacement() {
    let text = |wall: &str, width: f64| {
        format!(
            r#"
[[building]]
name = "A"
mass = [1000.0]
stiffness = 1e10
height = "3 m"
damping = {{ stiffness_proportional = 0.05 }}

[[gap]]
between = ["A", "wall"]
{wall}
width = {width}
model = "anagnostopoulos_2004"
stiffness = 93500000.0
restitution = 0.65
seat = 1.0

[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"

[analysis]
duration = 5
"#
        )
    };
    // The largest displacement of the ground to the right in five seconds, from the samples.
    let record = crate::yielding::setup::el_centro_record();
    let (dt, samples) = (record.time_step(), record.samples());
    let (mut x, mut v, mut most, mut least) = (0.0, 0.0, 0.0_f64, 0.0_f64);
    for pair in samples.windows(2).take((5.0 / dt).round() as usize) {
        let parts = 50;
        for k in 0..parts {
            let h = dt / f64::from(parts);
            let at = |k: f64| pair[0] + (pair[1] - pair[0]) * k / f64::from(parts);
            let (a, b) = (at(f64::from(k)), at(f64::from(k) + 1.0));
            x += h * v + h * h * (2.0 * a + b) / 6.0;
            v += 0.5 * h * (a + b);
            (most, least) = (most.max(x), least.min(x));
        }
    }
    let touch = |wall: &str, width: f64| {
        let assembly = assembled(&text(wall, width));
        go(&assembly.system, &assembly.options)
    };
    let wide = touch("wall = \"fixed\"", most + 1e-4);
    assert_eq!(wide.impacts.len(), 0);
    let opening = wide.gaps[0].levels[0].responses[0].peak.value;
    assert!((opening + least).abs() < 1e-4, "{opening} {least}");
    assert!(!touch("wall = \"fixed\"", most - 1e-4).impacts.is_empty());
    assert_eq!(touch("wall = \"moving\"", most - 1e-4).impacts.len(), 0);
}

/// Works over a step are integrated for the motion in contact, which is much faster than that of
/// slow buildings: the ledger closes to round-off.
#[test]
fn stiff_contacts_of_slow_buildings_close_the_ledger() {
    for (stiffness, restitution) in [(4.0e8, 0.65), (1.6e9, 0.65), (1.6e9, 0.3)] {
        let text = format!(
            r#"
[[building]]
name = "A"
mass = [100000.0]
stiffness = 10000000.0
height = "3 m"
damping = {{ mass_proportional = 0.5 }}

[[building]]
name = "B"
mass = [100000.0]
stiffness = 60000000.0
height = "3 m"
damping = {{ mass_proportional = 0.5 }}
ground = {{ delay = "0.2 s" }}

[[gap]]
between = ["A", "B"]
width = 0.02
model = "anagnostopoulos_2004"
stiffness = {stiffness}
restitution = {restitution}

[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"

[analysis]
duration = 15
"#
        );
        let assembly = assembled(&text);
        let outcome = go(&assembly.system, &assembly.options);
        assert!(outcome.impacts.len() > 5);
        let residual = outcome.energy.residual_ratio;
        assert!(residual < 1.0e-12, "{residual:e}");
    }
}
