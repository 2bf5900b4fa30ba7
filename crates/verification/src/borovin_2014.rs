//! The rubber ball of Borovin, Lapshin and Yurin 2014.

use pounding_gap_element::published::borovin_2014::{
    PRINTED_RADIUS, PRINTED_STIFFNESS, REFERENCE, REFERENCE_RESTITUTION, ball_on_concrete, radius,
    stiffness,
};

use pounding_gap_element::published::borovin_2014::about_table;
use pounding_gap_element::{Bodies, ModelParameters, collide, registry};

use crate::comparison::{
    Comparison, Line, Part, Verdict, largest, largest_relative, number, power, text,
};
use crate::error::VerificationError;

/// Mass (kg) and velocity (m/s) of collisions beside the preprint's own.
const BODIES: Bodies = Bodies {
    mass_left: 0.1,
    mass_right: None,
    velocity_left: 2.0,
    velocity_right: 0.0,
};
/// Agreement of the integration across the corners of a table (-, relative).
const TABLE: f64 = 1.0e-8;
/// Agreement of the integration with the closed form (-, relative).
const CLOSED_FORM: f64 = 1.0e-9;

/// The rubber ball on concrete of Borovin, Lapshin and Yurin 2014: radius and stiffness as
/// printed; collisions against the closed form.
///
/// # Errors
/// A collision or a stiffness that cannot be computed.
pub fn borovin_2014() -> Result<Part, VerificationError> {
    let stiffness = stiffness()?;
    Ok(Part {
        name: "borovin",
        citation: "Borovin, Lapshin and Yurin, Keldysh Institute preprint 46 (2014): rubber ball on concrete, dry friction 0.3",
        comparisons: vec![
            constants(stiffness),
            collisions(stiffness)?,
            any_spring()?,
            plastic()?,
            hunt_crossley()?,
        ],
        findings: [
            "Radius and stiffness come out in all printed digits. Penetration, duration and restitution appear in the preprint's figures only; they are compared with the closed form of its law.",
            "Restitution is sqrt((1 - D) / (1 + D)) = 0.7338 at every speed, and the force drops by (1 - D) / (1 + D) = 0.538 at the turning point.",
            "The restitution holds for any spring, tables too; with D = 1 and above nothing comes back.",
            "Hunt and Crossley's k = 1 - (2/3) b V is the slope at e = 1: 0.0041 low at b V = 0.1, 0.082 at 0.5.",
            "The printed force law lacks a bracket, and the relation of the velocities exchanges before and after (it would return more than 1); equations 3 and 4 use the law as it is here.",
        ]
        .map(str::to_owned)
        .to_vec(),
    })
}

fn constants(stiffness: f64) -> Comparison {
    let line = |name: &str, printed: f64, computed: f64, last_digit: f64| Line {
        cells: vec![text(name), power(printed, 4), power(computed, 9)],
        verdict: Verdict::printed(printed, computed, last_digit),
        claimed: Verdict::Reproduced,
    };
    Comparison {
        title: "Constants".to_owned(),
        columns: vec![
            ("quantity", "quantity"),
            ("printed", "printed"),
            ("computed", "computed"),
        ],
        lines: vec![
            line("radius R1 (m)", PRINTED_RADIUS, radius(), 1.0e-5),
            line("stiffness c (N/m^1.5)", PRINTED_STIFFNESS, stiffness, 100.0),
        ],
    }
}

fn collisions(stiffness: f64) -> Result<Comparison, VerificationError> {
    let mut lines = Vec::new();
    for reference in &REFERENCE {
        let ball = ball_on_concrete(stiffness, reference.velocity)?;
        let out = &ball.outcome;
        let difference = largest_relative(&[
            (out.peak_penetration, reference.peak_penetration),
            (out.peak_penetration_time, reference.compression),
            (out.duration, reference.duration),
            (out.peak_force, reference.peak_force),
            (ball.force_after_turning, reference.force_after_turning),
            (out.restitution, REFERENCE_RESTITUTION),
        ]);
        lines.push(Line {
            cells: vec![
                number(reference.velocity, 1),
                power(out.peak_penetration, 9),
                power(out.duration, 9),
                number(out.peak_force, 7),
                number(ball.force_after_turning, 7),
                number(out.restitution, 12),
                power(difference, 0),
            ],
            verdict: Verdict::reference(difference, CLOSED_FORM),
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "Collisions, integrated, against the closed form (relative)".to_owned(),
        columns: vec![
            ("velocity", "V (m/s)"),
            ("peak_penetration", "penetration (m)"),
            ("duration", "duration (s)"),
            ("peak_force", "force, approach (N)"),
            ("force_after_turning", "force, restitution (N)"),
            ("restitution", "e"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// Equations 3 and 4 hold for any spring f(x): tables in its place.
fn any_spring() -> Result<Comparison, VerificationError> {
    // A spring that hardens, one that softens, and Hertz's in 200 lines.
    let hertz = |i: i32| {
        let x = 1.0e-5 * f64::from(i);
        (x, 2.1873e6 * x.powf(1.5))
    };
    let springs: [(&str, Vec<(f64, f64)>); 3] = [
        (
            "hardens",
            vec![(5.0e-4, 10.0), (1.0e-3, 50.0), (2.0e-3, 300.0)],
        ),
        (
            "softens",
            vec![(2.0e-4, 100.0), (6.0e-4, 180.0), (2.0e-3, 220.0)],
        ),
        ("c x^1.5 by lines", (1..=200).map(hertz).collect()),
    ];
    let mut lines = Vec::new();
    for (name, table) in &springs {
        for friction in [0.3, 0.7] {
            let model = about_table(table, friction)?;
            let out = collide(model.as_ref(), &BODIES)?;
            let form = model.closed_form(BODIES.velocity_left, BODIES.mass_left);
            let peak = form.and_then(|f| f.peak_penetration).unwrap_or(f64::NAN);
            let restitution = ((1.0 - friction) / (1.0_f64 + friction)).sqrt();
            let back = out.duration - out.peak_penetration_time;
            let difference = largest_relative(&[
                (out.restitution, restitution),
                (out.peak_penetration, peak),
                // Each time is as long as the other over the restitution.
                (out.peak_penetration_time / back, restitution),
            ]);
            lines.push(Line {
                cells: vec![
                    text(*name),
                    number(friction, 1),
                    number(restitution, 9),
                    number(out.restitution, 9),
                    power(out.peak_penetration, 6),
                    number(out.peak_penetration_time / back, 9),
                    power(difference, 0),
                ],
                verdict: Verdict::reference(difference, TABLE),
                claimed: Verdict::AgreesWithReference,
            });
        }
    }
    Ok(Comparison {
        title: "Any spring f(x), here from tables: restitution sqrt((1 - D) / (1 + D)), and times of approach and restitution in that ratio. Against the closed form (relative)".to_owned(),
        columns: vec![
            ("spring", "f(x)"),
            ("friction", "D"),
            ("closed_form", "closed form"),
            ("restitution", "e"),
            ("peak_penetration", "penetration (m)"),
            ("ratio_of_times", "time in / time out"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// With D of 1 and above the impact is plastic.
fn plastic() -> Result<Comparison, VerificationError> {
    let stiffness = stiffness()?;
    let mut lines = Vec::new();
    for friction in [0.99, 1.0, 1.5] {
        let pairs = [("stiffness", stiffness), ("friction", friction)];
        let model = registry::build("borovin_2014", &ModelParameters::from_pairs(&pairs))?;
        let out = collide(model.as_ref(), &BODIES)?;
        let expected = ((1.0 - friction).max(0.0) / (1.0_f64 + friction)).sqrt();
        let form = model.closed_form(BODIES.velocity_left, BODIES.mass_left);
        let peak = form.and_then(|f| f.peak_penetration).unwrap_or(f64::NAN);
        let energy = 0.5 * BODIES.mass_left * BODIES.velocity_left * BODIES.velocity_left;
        let difference = largest([
            (out.restitution - expected).abs(),
            (out.peak_penetration / peak - 1.0).abs(),
            (out.energy_dissipated / energy - (1.0 - expected * expected)).abs(),
        ]);
        let parts = match out.stays_in_contact {
            true => "stay together",
            false => "part",
        };
        lines.push(Line {
            cells: vec![
                number(friction, 2),
                number(expected, 9),
                number(out.restitution, 9),
                power(out.peak_penetration, 6),
                number(out.energy_dissipated, 9),
                text(parts),
                power(difference, 0),
            ],
            verdict: match out.stays_in_contact == (friction >= 1.0) {
                true => Verdict::reference(difference, CLOSED_FORM),
                false => Verdict::NotReproduced,
            },
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "D of 1 and above: a plastic impact. Against the closed form".to_owned(),
        columns: vec![
            ("friction", "D"),
            ("closed_form", "closed form"),
            ("restitution", "e"),
            ("peak_penetration", "penetration (m)"),
            ("energy_dissipated", "loss (J)"),
            ("end", "they"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// Hunt and Crossley's k = 1 - (2/3) b V, which the preprint quotes.
fn hunt_crossley() -> Result<Comparison, VerificationError> {
    let stiffness = stiffness()?;
    let mut lines = Vec::new();
    for damping in [0.01, 0.02, 0.05, 0.1, 0.2, 0.5] {
        let rate = damping / BODIES.velocity_left;
        let pairs = [
            ("stiffness", stiffness),
            ("friction", 0.0),
            ("damping_rate", rate),
        ];
        let model = registry::build("lapshin_yurin_2016", &ModelParameters::from_pairs(&pairs))?;
        let out = collide(model.as_ref(), &BODIES)?;
        let quoted = 1.0 - 2.0 / 3.0 * damping;
        let next = 4.0 / 9.0 * damping * damping;
        // The series goes on with -(44/135) (b V)^3.
        let rest = (out.restitution - quoted - next).abs();
        lines.push(Line {
            cells: vec![
                number(damping, 2),
                number(quoted, 6),
                number(out.restitution, 9),
                power(out.restitution - quoted, 3),
                power(next, 3),
            ],
            verdict: Verdict::reference(rest, 0.35 * damping.powi(3)),
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "Hunt and Crossley's k = 1 - (2/3) b V, beside F = f(x) (1 + b v) integrated: the first term of a series whose next is (4/9) (b V)^2".to_owned(),
        columns: vec![
            ("damping", "b V"),
            ("quoted", "1 - (2/3) b V"),
            ("restitution", "e"),
            ("difference", "e - quoted"),
            ("next_term", "(4/9) (b V)^2"),
        ],
        lines,
    })
}
