//! Pairs of buildings that collide, beside OpenSees: the same cases by its materials and a
//! constant step. What stands here was computed by `scripts/opensees`.

use std::collections::BTreeMap;

use super::case_file::{CaseFile, Run, case_file};
use super::reference_table::rows;
use crate::comparison::{Comparison, Line, Part, Verdict, largest, number, power, text};
use crate::error::VerificationError;

const FILE: &str = "crates/verification/data/opensees_peaks.csv";
const TABLE: &str = include_str!("../../data/opensees_peaks.csv");
/// Its steps (s), as the table writes them.
const STEPS: [&str; 3] = ["0.001", "0.0001", "1e-05"];

/// A case, what it is, and the largest relative difference of a peak that is allowed at the
/// smallest step (-).
///
/// Contacts of 10 to 40 ms have a thousand steps or more. What remains is of first order in the
/// step where OpenSees takes the approach velocity a step late, or begins to count travel before
/// the gap is closed, and of second order with a spring alone.
const CASES: [(CaseFile, &str, f64); 13] = [
    (
        case_file!("opensees/single_storey_linear_elastic"),
        "elastic gap",
        1.0e-6,
    ),
    (
        case_file!("opensees/single_storey_kelvin_voigt"),
        "ViscoelasticGap",
        2.0e-4,
    ),
    (
        case_file!("opensees/single_storey_hertzdamp"),
        "Hertzdamp",
        2.0e-6,
    ),
    (
        case_file!("opensees/single_storey_hertzdamp_ye_li_zhu"),
        "Hertzdamp, Ye",
        5.0e-6,
    ),
    (
        case_file!("opensees/single_storey_jankowski"),
        "JankowskiImpact",
        5.0e-5,
    ),
    (
        case_file!("opensees/single_storey_bilinear"),
        "ImpactMaterial",
        2.0e-4,
    ),
    (
        case_file!("opensees/three_storey_linear_elastic"),
        "elastic gap",
        2.0e-6,
    ),
    (
        case_file!("opensees/three_storey_kelvin_voigt"),
        "ViscoelasticGap",
        2.0e-4,
    ),
    (
        case_file!("opensees/three_storey_hertzdamp"),
        "Hertzdamp",
        2.0e-5,
    ),
    (
        case_file!("opensees/three_storey_jankowski"),
        "JankowskiImpact",
        1.0e-4,
    ),
    (
        case_file!("opensees/three_storey_bilinear"),
        "ImpactMaterial",
        5.0e-4,
    ),
    (
        case_file!("opensees/yielding_hertzdamp"),
        "Hertzdamp, Steel01",
        2.0e-5,
    ),
    (
        case_file!("opensees/yielding_jankowski"),
        "JankowskiImpact, Steel01",
        1.0e-4,
    ),
];

/// Peaks of one run: displacements (m) of all floors from the left, forces (N) and impacts of all
/// levels, steps that did not converge.
#[derive(Debug, Clone, Default)]
struct Peaks {
    displacement: Vec<f64>,
    force: Vec<f64>,
    impacts: Vec<f64>,
    failed_steps: f64,
}

impl Peaks {
    fn of(run: &Run) -> Self {
        let buildings = run.outcome.buildings.iter();
        let levels = run.outcome.gaps.iter().flat_map(|gap| &gap.levels);
        Self {
            displacement: buildings
                .flat_map(|b| b.storeys.iter().map(|s| s.displacement.value))
                .collect(),
            force: levels.clone().map(|l| l.peak_force.value).collect(),
            impacts: levels.map(|l| l.impacts as f64).collect(),
            failed_steps: 0.0,
        }
    }

    /// Largest relative differences of displacements and of forces from others.
    fn differences(&self, others: &Self) -> (f64, f64) {
        let of = |ours: &[f64], theirs: &[f64]| match ours.len() == theirs.len() {
            true => largest(
                ours.iter()
                    .zip(theirs)
                    .map(|(o, t)| (o - t).abs() / t.abs()),
            ),
            false => f64::INFINITY,
        };
        (
            of(&self.displacement, &others.displacement),
            of(&self.force, &others.force),
        )
    }
}

/// The table: peaks by case and step.
fn published() -> Result<BTreeMap<(String, String), Peaks>, VerificationError> {
    let mut found: BTreeMap<_, Peaks> = BTreeMap::new();
    for row in rows::<6>(FILE, TABLE)? {
        let [case, step, quantity, _, _, _] = &row.cells;
        let value = row.number(5)?;
        let peaks = found.entry((case.clone(), step.clone())).or_default();
        match quantity.as_str() {
            "displacement_m" => peaks.displacement.push(value),
            "force_N" => peaks.force.push(value),
            "impacts" => peaks.impacts.push(value),
            "failed_steps" => peaks.failed_steps = value,
            other => return Err(row.error(format!("no quantity is called {other}"))),
        }
    }
    Ok(found)
}

/// Pairs of one and of three storeys, elastic and yielding, beside OpenSees.
///
/// # Errors
/// A case that cannot be run.
pub(super) fn opensees() -> Result<Part, VerificationError> {
    let published = published()?;
    let (mut peaks, mut steps) = (Vec::new(), Vec::new());
    for (file, law, tolerance) in &CASES {
        let name = file.name.trim_start_matches("opensees/");
        let ours = Peaks::of(&file.run()?);
        let of_step = |step: &str| {
            let key = (name.to_owned(), step.to_owned());
            published.get(&key).cloned().unwrap_or_default()
        };
        let theirs = STEPS.map(of_step);
        peaks.push(line_of_peaks((name, law), &theirs[2], &ours, *tolerance));
        steps.push(line_of_steps(name, &theirs, &ours));
    }
    Ok(Part {
        name: "opensees",
        citation: "OpenSees 3.7.1 (openseespy 3.7.1.2), run by us: Newmark (1/4, 1/2), El Centro 1940 NS for 12 s; scripts/opensees makes its peaks anew",
        comparisons: vec![of_peaks(peaks), of_steps(steps)],
        findings: [
            "Inputs are the case files in crates/verification/cases/opensees: 25 t (0.6 s) beside 60 t (0.35 s), 10 mm apart; three storeys of 25 t and 3.46 MN/m beside three of 1000 t and 2215 MN/m, 20 mm apart, elastic and with storeys that yield at 137 kN; 5 % damping in the first mode.",
            "Hertzdamp takes the approach velocity at the end of the first step inside the gap, so one step late; ours is that of the located closure. The dashpots of JankowskiImpact and ViscoelasticGap act from the first such step on, not from the closure. Both are of first order in the step and vanish with it.",
            "ImpactMaterial adds increments to its last state: travel outside the gap in the step that closes it counts as penetration, up to its stiffness times the overshoot, by design. That too is of first order in the step. Forces here follow from the penetration alone.",
            "ViscoelasticGap has neither a tangent of its dashpot nor a located closure: with steps of 1 ms 7905 of 12 000 do not converge in the three-storey pair and its peaks mean nothing; with 0.1 ms all do.",
        ]
        .map(str::to_owned)
        .to_vec(),
    })
}

fn line_of_peaks((name, law): (&str, &str), theirs: &Peaks, ours: &Peaks, tolerance: f64) -> Line {
    let (displacement, force) = ours.differences(theirs);
    let difference = largest([displacement, force]);
    let same_impacts = ours.impacts == theirs.impacts && theirs.failed_steps == 0.0;
    let verdict = match same_impacts && difference <= tolerance {
        true => Verdict::Reproduced,
        false => Verdict::NotReproduced,
    };
    // The roof of the lighter building, and the topmost level.
    let roof = |peaks: &Peaks| {
        let storeys = peaks.displacement.len() / 2;
        let value = peaks.displacement.get(storeys.wrapping_sub(1));
        number(1.0e3 * value.copied().unwrap_or(f64::NAN), 5)
    };
    let top = |peaks: &Peaks| number(1.0e-3 * peaks.force.last().copied().unwrap_or(f64::NAN), 4);
    let impacts = |peaks: &Peaks| {
        let levels = peaks.impacts.iter().map(|n| format!("{n:.0}"));
        text(levels.collect::<Vec<_>>().join(", "))
    };
    Line {
        cells: vec![
            text(name),
            text(law),
            roof(theirs),
            roof(ours),
            top(theirs),
            top(ours),
            impacts(theirs),
            impacts(ours),
            power(difference, 1),
            power(tolerance, 0),
        ],
        verdict,
        claimed: Verdict::Reproduced,
    }
}

fn of_peaks(lines: Vec<Line>) -> Comparison {
    Comparison {
        title: "Peaks with steps of 10 us in OpenSees: displacement (mm) of the roof of the lighter building, force (kN) at the topmost level, impacts of all levels; the largest relative difference is that of all floors and levels".to_owned(),
        columns: vec![
            ("case", "case"),
            ("law", "law in OpenSees"),
            ("displacement_theirs_mm", "displacement, theirs"),
            ("displacement_ours_mm", "ours"),
            ("force_theirs_kn", "force, theirs"),
            ("force_ours_kn", "ours"),
            ("impacts_theirs", "impacts, theirs"),
            ("impacts_ours", "ours"),
            ("largest_difference", "largest difference"),
            ("tolerance", "tolerance"),
        ],
        lines,
    }
}

fn line_of_steps(name: &str, theirs: &[Peaks; 3], ours: &Peaks) -> Line {
    let differences = theirs.each_ref().map(|peaks| ours.differences(peaks));
    let [first, second, third] = differences.map(|(u, f)| largest([u, f]));
    let verdict = match third < second && second < first {
        true => Verdict::Reproduced,
        false => Verdict::NotReproduced,
    };
    let mut cells = vec![text(name)];
    cells.extend(
        differences
            .into_iter()
            .flat_map(|(u, f)| [power(u, 1), power(f, 1)]),
    );
    cells.push(number(theirs[0].failed_steps, 0));
    Line {
        cells,
        verdict,
        claimed: Verdict::Reproduced,
    }
}

fn of_steps(lines: Vec<Line>) -> Comparison {
    Comparison {
        title: "Largest relative difference of displacements and of forces from OpenSees with its steps, which must fall with them".to_owned(),
        columns: vec![
            ("case", "case"),
            ("displacement_1_ms", "1 ms: displacement"),
            ("force_1_ms", "force"),
            ("displacement_0_1_ms", "0.1 ms: displacement"),
            ("force_0_1_ms", "force"),
            ("displacement_10_us", "10 us: displacement"),
            ("force_10_us", "force"),
            ("failed_steps_1_ms", "failed steps at 1 ms"),
        ],
        lines,
    }
}
