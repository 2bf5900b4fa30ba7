//! Rigid floors in lasting touch beside elements whose branches end at a speed: dampers of a power
//! law and storeys by Bouc and Wen. At every event floors that are held are brought to rest within
//! round-off, which must lead no element off the branch that it has just entered.
use pounding_time_history::{MethodChoice, Outcome, RunOptions};
use rand_chacha::ChaCha20Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Uniform};

use super::motions::{assembled, go};

/// A row of three buildings on delayed grounds, rigid gaps at both levels between neighbours, and
/// dampers of a power law beside them.
fn row(random: &mut ChaCha20Rng, yields: bool) -> String {
    let mut draw = |from: f64, to: f64| Uniform::new(from, to).unwrap().sample(random);
    let mut text = String::new();
    for (number, delay) in [0.0, 0.07, 0.14].into_iter().enumerate() {
        let (mass, stiffness) = (draw(80.0, 220.0), draw(10.0, 40.0));
        text += &format!(
            "[[building]]\nname = \"b{number}\"\nstoreys = 2\nmass = \"{mass} t\"\nstiffness = \"{stiffness} MN/m\"\n\
             height = \"3 m\"\ndamping = {{ stiffness_proportional = 0.05 }}\nground = {{ delay = {delay} }}\n"
        );
        if yields {
            let force = draw(0.05, 0.2) * mass * 9.81 * 2.0;
            text += &format!(
                "[[building.law]]\nmodel = \"bouc_wen\"\nyield_force = \"{force} kN\"\nhardening_ratio = 0.02\n"
            );
        }
    }
    for (number, next) in [(0, 1), (1, 2)] {
        let (width, restitution) = (draw(2.0, 12.0), draw(0.3, 0.8));
        let (damping, exponent) = (draw(100.0, 500.0), draw(0.3, 0.8));
        text += &format!(
            "[[gap]]\nbetween = [\"b{number}\", \"b{next}\"]\nwidth = \"{width} mm\"\nmodel = \"stereomechanical\"\n\
             restitution = {restitution}\n[[link]]\nbetween = [\"b{number}\", \"b{next}\"]\nmodel = \"viscous_damper\"\n\
             damping = {damping}e3\nexponent = {exponent}\n"
        );
    }
    text + "[ground_motion]\nfile = \"../ground_motions/el_centro_1940_ns.csv\"\n[analysis]\nduration = 4\n"
}

/// A row in which a damper came to its transition velocity while floors were held.
const STOPPED: &str = r#"
[[building]]
name = "b0"
storeys = 2
mass = "120 t"
stiffness = "13.082 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
[[building]]
name = "b1"
storeys = 2
mass = "120 t"
stiffness = "26.674 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
ground = { delay = 0.07 }
[[building]]
name = "b2"
storeys = 2
mass = "200 t"
stiffness = "20.652 MN/m"
height = "3 m"
damping = { stiffness_proportional = 0.05 }
ground = { delay = 0.14 }
[[gap]]
between = ["b0", "b1"]
width = "4 mm"
model = "stereomechanical"
restitution = 0.3
[[gap]]
between = ["b1", "b2"]
width = "5 mm"
model = "stereomechanical"
restitution = 0.7
[[link]]
between = ["b0", "b1"]
model = "viscous_damper"
damping = 238e3
exponent = 0.3
[[link]]
between = ["b1", "b2"]
model = "viscous_damper"
damping = 351e3
exponent = 0.5
[ground_motion]
file = "../ground_motions/el_centro_1940_ns.csv"
[analysis]
duration = 3.2
"#;

/// Two methods that find events, and one of fixed steps, which has nothing in common with them but
/// the laws.
fn by_three_methods(text: &str) -> [Outcome; 3] {
    let assembly = assembled(text);
    let methods = [
        MethodChoice::EventDriven {
            relative_tolerance: 1e-10,
        },
        MethodChoice::Adaptive {
            relative_tolerance: 1e-11,
        },
        MethodChoice::Newmark {
            step: 1e-4,
            beta: 0.25,
            gamma: 0.5,
        },
    ];
    methods.map(|method| {
        let options = RunOptions {
            method,
            ..assembly.options
        };
        go(&assembly.system, &options)
    })
}

fn impacts(outcome: &Outcome) -> Vec<usize> {
    let levels = outcome.gaps.iter().flat_map(|gap| &gap.levels);
    levels.map(|level| level.impacts).collect()
}

fn agree(text: &str) {
    let [events, adaptive, steps] = by_three_methods(text);
    assert_eq!(impacts(&events), impacts(&adaptive), "{text}");
    let input = |outcome: &Outcome| outcome.energy.end.input;
    let apart = |other: &Outcome| (input(other) / input(&events) - 1.0).abs();
    assert!(apart(&adaptive) < 1e-7, "{text}: {}", apart(&adaptive));
    assert!(apart(&steps) < 1e-3, "{text}: {}", apart(&steps));
    for outcome in [&events, &adaptive] {
        assert!(outcome.energy.residual_ratio < 1e-9, "{text}");
    }
}

#[test]
fn dampers_at_their_transition_velocity() {
    agree(STOPPED);
    // By Newmark and by Runge and Kutta's fourth order with 0.2 ms, which do not locate branches.
    let [events, ..] = by_three_methods(STOPPED);
    assert!((events.energy.end.input / 158.954e3 - 1.0).abs() < 1e-4);
}

#[test]
fn random_rows() {
    let mut random = ChaCha20Rng::seed_from_u64(20_261_126);
    for number in 0..6 {
        agree(&row(&mut random, number % 2 == 0));
    }
}
