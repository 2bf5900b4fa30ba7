//! Laws of storeys and links along one path of deformations, beside materials of OpenSees.
//! What stands here was computed by `scripts/opensees`.

use pounding_hysteresis::laboratory::history;
use pounding_hysteresis::{LawParameters, build};

use super::reference_table::rows;
use crate::comparison::{Comparison, Line, Part, Verdict, largest, number, power, text};
use crate::error::VerificationError;

const FILE: &str = "crates/verification/data/opensees_laws.csv";
const TABLE: &str = include_str!("../../data/opensees_laws.csv");
/// Yield force of all of them (N), over which differences are shown.
const YIELD_FORCE: f64 = 2.0e5;
/// Parts of the way from one tabled deformation to the next: what a law of rates needs.
const PARTS: usize = 200;

const YIELDING: [(&str, f64); 3] = [
    ("stiffness", 2.0e7),
    ("yield_force", YIELD_FORCE),
    ("hardening_ratio", 0.05),
];

/// A law beside its material.
struct Compared {
    law: &'static str,
    /// Parameters beside [`YIELDING`].
    more: &'static [(&'static str, f64)],
    /// Whether it takes [`YIELDING`].
    yields: bool,
    /// Difference over the yield force that is allowed (-).
    tolerance: f64,
}

const LAWS: [Compared; 5] = [
    Compared {
        law: "bilinear",
        more: &[],
        yields: true,
        tolerance: 1.0e-12,
    },
    Compared {
        law: "menegotto_pinto_1973",
        more: &[
            ("curvature", 20.0),
            ("curvature_loss", 0.925),
            ("curvature_excursion", 0.15),
        ],
        yields: true,
        tolerance: 1.0e-12,
    },
    // Theirs is an implicit rule of first order: its own error at steps of 2 um.
    Compared {
        law: "bouc_wen",
        more: &[("exponent", 1.0), ("beta", 0.5), ("gamma", 0.5)],
        yields: true,
        tolerance: 1.0e-4,
    },
    Compared {
        law: "elastoplastic_gap",
        more: &[("gap", 0.012)],
        yields: true,
        tolerance: 1.0e-12,
    },
    Compared {
        law: "gap_hook",
        more: &[("compression_stiffness", 2.0e7), ("compression_gap", 0.012)],
        yields: false,
        tolerance: 1.0e-12,
    },
];

/// Laws of storeys and links beside materials of OpenSees.
///
/// # Errors
/// A law that refuses its parameters.
pub(super) fn laws() -> Result<Part, VerificationError> {
    Ok(Part {
        name: "laws",
        citation: "OpenSees 3.7.1 (openseespy 3.7.1.2), run by us: materials Steel01, Steel02, BoucWen and ElasticPPGap along one path; scripts/opensees makes their forces anew",
        comparisons: vec![along_the_path()?],
        findings: vec![
            "Steel01, Steel02 and ElasticPPGap follow to round-off, partial unloadings included. BoucWen integrates its rate equation with a rule of first order: its difference halves with its step, and is that of OpenSees.".to_owned(),
        ],
    })
}

fn along_the_path() -> Result<Comparison, VerificationError> {
    let rows = rows::<4>(FILE, TABLE)?;
    let mut lines = Vec::new();
    for compared in LAWS {
        let Compared {
            law: name,
            more,
            yields,
            tolerance,
        } = compared;
        let of_law = rows.iter().filter(|row| row.cells[0] == name);
        let (mut path, mut theirs, mut material) = (Vec::new(), Vec::new(), String::new());
        let mut from = 0.0;
        for row in of_law {
            let to = row.number(2)?;
            let part = |i: usize| from + (to - from) * i as f64 / PARTS as f64;
            path.extend((1..PARTS).map(part).chain([to]));
            theirs.push(row.number(3)?);
            material.clone_from(&row.cells[1]);
            from = to;
        }
        let yielding: &[(&str, f64)] = if yields { &YIELDING } else { &[] };
        let parameters: Vec<_> = yielding.iter().chain(more).copied().collect();
        let law = build(name, &LawParameters::from_pairs(&parameters))?;
        // In a second each: none of them depends on the rate.
        let points = history(law.as_ref(), &path, 1.0);
        // The path may begin with a point at zero.
        let skipped = points.len() - path.len();
        let ours = points.iter().skip(skipped + PARTS - 1).step_by(PARTS);
        let ours: Vec<f64> = ours.map(|point| point.force).collect();
        let difference = match ours.len() == theirs.len() && !theirs.is_empty() {
            true => largest(
                ours.iter()
                    .zip(&theirs)
                    .map(|(o, t)| (o - t).abs() / YIELD_FORCE),
            ),
            false => f64::INFINITY,
        };
        let peak = |forces: &[f64]| number(1.0e-3 * largest(forces.iter().map(|f| f.abs())), 6);
        lines.push(Line {
            cells: vec![
                text(name),
                text(material),
                number(theirs.len() as f64, 0),
                peak(&theirs),
                peak(&ours),
                power(difference, 1),
                power(tolerance, 0),
            ],
            verdict: match difference <= tolerance {
                true => Verdict::Reproduced,
                false => Verdict::NotReproduced,
            },
            claimed: Verdict::Reproduced,
        });
    }
    Ok(Comparison {
        title: "20 MN/m, 200 kN, hardening 0.05, gaps of 12 mm; from 0 to 20, -20, 30, 5, 30, -50, 50, -10 and 0 mm. Largest difference over the yield force".to_owned(),
        columns: vec![
            ("law", "law"),
            ("material", "material"),
            ("points", "points"),
            ("peak_theirs_kn", "peak force (kN), theirs"),
            ("peak_ours_kn", "ours"),
            ("largest_difference", "largest difference"),
            ("tolerance", "tolerance"),
        ],
        lines,
    })
}
