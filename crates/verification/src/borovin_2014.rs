//! The rubber ball of Borovin, Lapshin and Yurin 2014.

use pounding_gap_element::published::borovin_2014::{
    PRINTED_RADIUS, PRINTED_STIFFNESS, REFERENCE, REFERENCE_RESTITUTION, ball_on_concrete, radius,
    stiffness,
};

use crate::comparison::{Comparison, Line, Part, Verdict, largest_relative, number, power, text};
use crate::error::VerificationError;

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
        comparisons: vec![constants(stiffness), collisions(stiffness)?],
        findings: [
            "Radius and stiffness come out in all printed digits. Penetration, duration and restitution appear in the preprint's figures only; they are compared with the closed form of its law.",
            "Restitution is sqrt((1 - D) / (1 + D)) = 0.7338 at every speed, and the force drops by (1 - D) / (1 + D) = 0.538 at the turning point.",
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
