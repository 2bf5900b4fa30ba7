//! Event-driven and time-stepping references of Siconos (INRIA): a bouncing ball, a column of
//! beads. A few figures out of its reference files.

use super::case_file::{CaseFile, case_file};
use super::quantity::{Quantity, comparison};
use crate::comparison::{Comparison, Part, Verdict, number, text};
use crate::comparison::{Line, nothing};
use crate::error::VerificationError;

const BOUNCING_BALL: CaseFile = case_file!("siconos/bouncing_ball");
const COLUMN: CaseFile = case_file!("siconos/column");
const GRAVITY: f64 = 9.81;

/// Impacts of their ball (s).
const IMPACTS: [(usize, f64); 5] = [
    (1, 0.451_523_640_985_730_8),
    (2, 1.264_266_194_760_045),
    (10, 5.430_218_002_585_27),
    (20, 7.481_054_503_936_557),
    (44, 8.491_374_025_642_981),
];
/// Number of their impacts within 8.5 s.
const COUNT: usize = 44;

/// Where bead 1, 5 and 10 of their column are beside their start (m), at times (s).
const POSITIONS: [(f64, [f64; 3]); 4] = [
    (
        0.1,
        [
            -0.049_050_000_000_000_07,
            -0.049_050_000_000_000_066,
            -0.049_050_000_000_000_094,
        ],
    ),
    (
        0.2,
        [
            -1.822_353_873_953_686e-5,
            -1.822_353_874_023_075e-5,
            -1.822_353_874_039_728e-5,
        ],
    ),
    (
        0.3,
        [
            -0.047_177_335_308_108_255,
            -0.047_177_335_308_109_136,
            -0.047_177_335_308_110_05,
        ],
    ),
    (
        0.49,
        [
            -0.036_399_795_339_822_42,
            -0.036_399_795_339_824_12,
            -0.036_399_795_339_824_4,
        ],
    ),
];

/// The bouncing ball and the column of beads of Siconos.
///
/// # Errors
/// A case that cannot be run.
pub(super) fn siconos() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "siconos",
        citation: "Siconos, INRIA, reference files of its examples: BouncingBallED and the column of ten beads (Newton impact law)",
        comparisons: vec![ball()?, column()?],
        findings: [
            "The closed forms are t_1 = sqrt(2 h / g) and t_(n+1) = t_n + 2 e^n sqrt(2 h / g); their times leave them by up to 4.7e-12 s after 44 impacts, ours by less.",
            "In the column with e = 1 all beads touch, and the impact law acts on all contacts at once: the column falls and rises as one body, so the closed form is that of one ball.",
        ]
        .map(str::to_owned)
        .to_vec(),
    })
}

/// Impact `n`, from 1, of a ball that falls 1 m with e = 0.9 (s).
fn impact(n: usize) -> f64 {
    let fall = (2.0 / GRAVITY).sqrt();
    (1..n).fold(fall, |time, bounce| {
        time + 2.0 * fall * 0.9_f64.powi(i32::try_from(bounce).unwrap_or(i32::MAX))
    })
}

fn ball() -> Result<Comparison, VerificationError> {
    let run = BOUNCING_BALL.run()?;
    let count = run.outcome.impacts.len();
    let counted = match count == COUNT {
        true => Verdict::Reproduced,
        false => Verdict::NotReproduced,
    };
    let mut lines = vec![Line {
        cells: vec![
            text("impacts within 8.5 s"),
            number(COUNT as f64, 0),
            nothing(),
            number(count as f64, 0),
            number(count as f64 - COUNT as f64, 0),
            number(0.0, 0),
        ],
        verdict: counted,
        claimed: Verdict::Reproduced,
    }];
    for (n, theirs) in IMPACTS {
        lines.push(
            Quantity {
                name: &format!("time of impact {n} (s)"),
                theirs,
                closed_form: Some(impact(n)),
                ours: run.impact(n)?.time_closed,
                tolerance: 1.0e-12,
            }
            .reproduced(),
        );
    }
    Ok(comparison(
        "Ball of 1 kg from 1 m, gravity 9.81 m/s2, rigid floor, e = 0.9",
        lines,
    ))
}

/// Where a ball that fell 5 cm with e = 1 is beside its start (m), at a time (s).
fn bouncing(time: f64) -> f64 {
    let fall = (0.1 / GRAVITY).sqrt();
    // From the top of each bounce.
    let phase = (time + fall) % (2.0 * fall) - fall;
    -0.5 * GRAVITY * phase * phase
}

fn column() -> Result<Comparison, VerificationError> {
    let run = COLUMN.run()?;
    let mut lines = Vec::new();
    for (time, theirs) in POSITIONS {
        for (bead, theirs) in [0, 4, 9].into_iter().zip(theirs) {
            lines.push(
                Quantity {
                    name: &format!("bead {} at {time} s (m)", bead + 1),
                    theirs,
                    closed_form: Some(bouncing(time)),
                    ours: run.displacement(bead, time),
                    tolerance: 1.0e-10,
                }
                .reproduced(),
            );
        }
    }
    Ok(comparison(
        "Ten beads of radius 5 mm and 7780 kg/m3, in touch, fall 5 cm on a rigid floor, e = 1 at all contacts, gravity 9.81 m/s2",
        lines,
    ))
}
