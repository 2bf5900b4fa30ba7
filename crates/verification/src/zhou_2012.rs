//! The two steel balls of Zhou et al. 2012.

use std::f64::consts::FRAC_PI_2;

use pounding_gap_element::published::zhou_2012::{
    ADAMS_REFERENCE, APPROACH_VELOCITY, ENERGY_REFERENCE, EXPLICIT_REFERENCE, EXPONENT,
    ExplicitCollision, PRINTED_TIME_FACTOR, REFERENCE_STIFFNESS, adams_impact, bodies, explicit,
    integrated, stiffness,
};
use pounding_gap_element::{CollisionOutcome, CollisionSample, ModelParameters, collide, registry};

use crate::comparison::{
    Cell, Comparison, Line, Part, Verdict, largest_relative, nothing, number, power, text,
};
use crate::error::VerificationError;

/// Agreement with closed-form references (-, relative).
const CLOSED_FORM: f64 = 1.0e-8;
/// Agreement with the independent integration of IMPACT (-, relative).
const INTEGRATION: f64 = 2.0e-8;
/// Agreement of the area of a loop, by a sum over a history, with the energy lost (-, relative).
const LOOP_AREA: f64 = 1.0e-3;
/// Columns of the energy model.
const ENERGY_COLUMNS: [(&str, &str); 8] = [
    ("restitution", "e put in"),
    ("explicit_peak_force", "explicit: force (N)"),
    ("explicit_place", "at delta / delta_max"),
    ("achieved", "integrated: e"),
    ("peak_force", "force (N)"),
    ("peak_penetration", "penetration (m)"),
    ("duration", "duration (s)"),
    ("largest_difference", "largest difference"),
];

/// The two steel balls of Zhou, Wu, Zhang and Xie 2012: stiffness, energy model in both forms,
/// IMPACT.
///
/// # Errors
/// A collision or a stiffness that cannot be computed.
pub fn zhou_2012() -> Result<Part, VerificationError> {
    let stiffness = stiffness()?;
    Ok(Part {
        name: "zhou",
        citation: "Zhou, Wu, Zhang and Xie 2012, collision dynamics from spring-damper models: two steel balls, 25 and 50 mm, 0.2 m/s",
        comparisons: vec![
            facts(stiffness)?,
            energy_model(stiffness)?,
            curves(stiffness)?,
            adams(stiffness)?,
            excess(stiffness)?,
        ],
        findings: findings(),
    })
}

fn facts(stiffness: f64) -> Result<Comparison, VerificationError> {
    let elastic = explicit(1.0)?;
    let factor = elastic.duration * APPROACH_VELOCITY / elastic.peak_penetration;
    let line = |name: &str, published: Cell, computed: Cell, verdict, claimed| Line {
        cells: vec![text(name), published, computed],
        verdict,
        claimed,
    };
    let reference = |name: &str, expected: f64, computed: f64| {
        let verdict = Verdict::reference(largest_relative(&[(computed, expected)]), CLOSED_FORM);
        let (expected, computed) = (power(expected, 9), power(computed, 9));
        line(
            name,
            expected,
            computed,
            verdict,
            Verdict::AgreesWithReference,
        )
    };
    Ok(Comparison {
        title: "Closed forms. 2.94 is printed, the others are references".to_owned(),
        columns: vec![
            ("quantity", "quantity"),
            ("published", "printed or reference"),
            ("computed", "computed"),
        ],
        lines: vec![
            line(
                "contact time over delta_max / v0 (-)",
                number(PRINTED_TIME_FACTOR, 2),
                number(factor, 9),
                Verdict::printed(PRINTED_TIME_FACTOR, factor, 0.01),
                Verdict::Reproduced,
            ),
            reference("Hertz stiffness (N/m^1.5)", REFERENCE_STIFFNESS, stiffness),
            reference(
                "explicit form: penetration (m), any e",
                EXPLICIT_REFERENCE.0,
                elastic.peak_penetration,
            ),
            reference(
                "explicit form: duration (s), any e",
                EXPLICIT_REFERENCE.1,
                elastic.duration,
            ),
        ],
    })
}

fn energy_model(stiffness: f64) -> Result<Comparison, VerificationError> {
    let lines = ENERGY_REFERENCE
        .iter()
        .map(|reference| {
            let form = explicit(reference.restitution)?;
            let out = integrated(stiffness, reference.restitution)?;
            let difference = largest_relative(&[
                (form.peak_force, reference.explicit_peak_force),
                (form.peak_force_place, reference.explicit_place),
                (out.restitution, reference.achieved),
                (out.peak_force, reference.peak_force),
                (out.peak_penetration, reference.peak_penetration),
                (out.duration, reference.duration),
            ]);
            let [achieved, force, penetration, duration] = cells(&out);
            Ok(Line {
                cells: vec![
                    number(reference.restitution, 1),
                    number(form.peak_force, 4),
                    number(form.peak_force_place, 6),
                    achieved,
                    force,
                    penetration,
                    duration,
                    power(difference, 0),
                ],
                verdict: Verdict::reference(difference, CLOSED_FORM),
                claimed: Verdict::AgreesWithReference,
            })
        })
        .collect::<Result<_, VerificationError>>()?;
    Ok(Comparison {
        title: "Energy model: explicit form on the elastic trajectory, and the same law integrated. Against references (relative)".to_owned(),
        columns: ENERGY_COLUMNS.to_vec(),
        lines,
    })
}

/// Restitution, force, penetration, duration.
fn cells(out: &CollisionOutcome) -> [Cell; 4] {
    [
        number(out.restitution, 9),
        number(out.peak_force, 4),
        power(out.peak_penetration, 6),
        power(out.duration, 6),
    ]
}

fn adams(stiffness: f64) -> Result<Comparison, VerificationError> {
    let row = |case: &str, ratio: f64, out: &CollisionOutcome| {
        let [achieved, force, penetration, duration] = cells(out);
        vec![
            text(case),
            power(ratio, 5),
            number(out.collision.constants[1], 1),
            achieved,
            force,
            penetration,
            duration,
        ]
    };
    let mut lines = Vec::new();
    for reference in &ADAMS_REFERENCE {
        let out = adams_impact(stiffness, reference.ratio)?;
        let difference = largest_relative(&[
            (out.collision.constants[1], reference.damping),
            (out.restitution, reference.achieved),
            (out.peak_force, reference.peak_force),
            (out.peak_penetration, reference.peak_penetration),
            (out.duration, reference.duration),
        ]);
        let mut cells = row(reference.case, reference.ratio, &out);
        cells.push(power(difference, 0));
        lines.push(Line {
            cells,
            verdict: Verdict::reference(difference, INTEGRATION),
            claimed: Verdict::AgreesWithReference,
        });
    }
    // The rule's 0.1 % with both numbers in SI: a dashpot 10^1.5 times as strong.
    let ratio = 1.0e-3 * 10.0_f64.powf(1.5);
    let out = adams_impact(stiffness, ratio)?;
    let mut cells = row("0.1 % of k, wrongly in SI", ratio, &out);
    cells.push(nothing());
    lines.push(Line {
        cells,
        verdict: Verdict::ComputedOnly,
        claimed: Verdict::ComputedOnly,
    });
    Ok(Comparison {
        title:
            "IMPACT of ADAMS, n = 1.5, d = 0.1 mm. Against an independent integration (relative)"
                .to_owned(),
        columns: vec![
            ("case", "c_max"),
            ("ratio_n_mm_s", "over k in N, mm, s"),
            ("damping", "c_max (N s/m)"),
            ("achieved", "e"),
            ("peak_force", "force (N)"),
            ("peak_penetration", "penetration (m)"),
            ("duration", "duration (s)"),
            ("largest_difference", "largest difference"),
        ],
        lines,
    })
}

/// Parts of the elastic penetration at which curves are shown (-).
const PLACES: [f64; 4] = [0.2, 0.4, 0.6, 0.8];

/// Forces (N) over penetration, in approach and back, of the two forms of the energy model.
fn curves(stiffness: f64) -> Result<Comparison, VerificationError> {
    let mut lines = Vec::new();
    for restitution in [0.3, 0.5, 0.8] {
        let form = explicit(restitution)?;
        let out = integrated(stiffness, restitution)?;
        let energy = 0.5 * out.collision.effective_mass * APPROACH_VELOCITY * APPROACH_VELOCITY;
        let at = PLACES.map(|place| place * form.peak_penetration);
        let explicit_curve = |in_| at.map(|d| form.force(d, in_));
        let integrated_curve = |in_| at.map(|d| force_at(&out, d, in_));
        let area = loop_area(&form);
        let cases = [
            (
                "explicit",
                explicit_curve(true),
                explicit_curve(false),
                area,
                1.0 - restitution * restitution,
            ),
            (
                "integrated",
                integrated_curve(true),
                integrated_curve(false),
                area_of(&out),
                1.0 - out.restitution * out.restitution,
            ),
        ];
        for (name, approach, back, area, lost) in cases {
            let difference = (area / (lost * energy) - 1.0).abs();
            let mut cells = vec![number(restitution, 1), text(name)];
            cells.extend(approach.map(|f| number(f, 2)));
            cells.extend(back.map(|f| number(f, 2)));
            cells.extend([power(area, 5), power(difference, 0)]);
            lines.push(Line {
                cells,
                verdict: Verdict::reference(difference, LOOP_AREA),
                claimed: Verdict::AgreesWithReference,
            });
        }
    }
    Ok(Comparison {
        title: "Force (N) at 0.2, 0.4, 0.6 and 0.8 of the elastic penetration, in approach and back; area of the loop (J) against (1/2) m v0^2 (1 - e^2) with the e that comes out (relative)".to_owned(),
        columns: vec![
            ("restitution", "e put in"),
            ("form", "form"),
            ("approach_0.2", "in: 0.2"),
            ("approach_0.4", "0.4"),
            ("approach_0.6", "0.6"),
            ("approach_0.8", "0.8"),
            ("restitution_0.2", "back: 0.2"),
            ("restitution_0.4", "0.4"),
            ("restitution_0.6", "0.6"),
            ("restitution_0.8", "0.8"),
            ("loop_area", "area (J)"),
            ("difference", "difference"),
        ],
        lines,
    })
}

/// Area (J) of the loop of the explicit form: by midpoints in the angle whose sine is
/// `(delta / delta_max)^(5/4)`, where nothing is singular.
fn loop_area(form: &ExplicitCollision) -> f64 {
    const PARTS: usize = 20_000;
    let power = 0.5 * (form.exponent + 1.0);
    let width = FRAC_PI_2 / PARTS as f64;
    let part = |i: usize| {
        let (sine, cosine) = ((i as f64 + 0.5) * width).sin_cos();
        let delta = form.peak_penetration * sine.powf(1.0 / power);
        let way = delta / power * cosine / sine * width;
        (form.force(delta, true) - form.force(delta, false)) * way
    };
    (0..PARTS).map(part).sum()
}

/// Area (J) of the loop of an integrated collision, by trapezoids of its history.
fn area_of(out: &CollisionOutcome) -> f64 {
    let part = |w: &[CollisionSample]| {
        0.5 * (w[1].force + w[0].force) * (w[1].penetration - w[0].penetration)
    };
    out.history.windows(2).map(part).sum()
}

/// Force (N) of an integrated collision at a penetration (m), linear between its samples; not a
/// number where it does not come so deep.
fn force_at(out: &CollisionOutcome, penetration: f64, approaching: bool) -> f64 {
    let mut pairs = out.history.windows(2);
    let crosses = |w: &&[CollisionSample]| {
        let (a, b) = (w[0].penetration, w[1].penetration);
        match approaching {
            true => a <= penetration && penetration < b,
            false => a > penetration && penetration >= b,
        }
    };
    pairs.find(crosses).map_or(f64::NAN, |w| {
        let part = (penetration - w[0].penetration) / (w[1].penetration - w[0].penetration);
        w[0].force + part * (w[1].force - w[0].force)
    })
}

/// By how much the peak of IMPACT, tuned to a restitution, exceeds that of the exact law (%), as
/// measured beforehand by an independent integration.
const EXCESS: [(f64, f64, f64); 4] = [
    (0.8, 1.8, 0.1),
    (0.7, 3.6, 0.1),
    (0.5, 7.6, 0.1),
    (0.3, 12.0, 1.0),
];

/// The claim that IMPACT is good above e = 0.7 and poor below.
fn excess(stiffness: f64) -> Result<Comparison, VerificationError> {
    let mut lines = Vec::new();
    for (restitution, measured, last_digit) in EXCESS {
        let out = tuned(stiffness, restitution)?;
        let parameters = ModelParameters::from_pairs(&[
            ("stiffness", stiffness),
            ("restitution", restitution),
            ("exponent", EXPONENT),
        ]);
        let exact = registry::build("exact_hunt_crossley", &parameters)?;
        let exact = collide(exact.as_ref(), &bodies())?;
        let percent = 100.0 * (out.peak_force / exact.peak_force - 1.0);
        let verdict = match Verdict::printed(measured, percent, last_digit) {
            Verdict::Reproduced => Verdict::AgreesWithReference,
            other => other,
        };
        lines.push(Line {
            cells: vec![
                number(restitution, 1),
                number(out.restitution, 6),
                number(out.peak_force, 2),
                number(exact.peak_force, 2),
                number(measured, if last_digit < 1.0 { 1 } else { 0 }),
                number(percent, 2),
            ],
            verdict,
            claimed: Verdict::AgreesWithReference,
        });
    }
    Ok(Comparison {
        title: "IMPACT tuned to a restitution, beside the exact law of Hunt and Crossley's class: peak forces, and by how much IMPACT exceeds (%)".to_owned(),
        columns: vec![
            ("restitution", "e"),
            ("achieved", "achieved"),
            ("impact_peak_force", "IMPACT: force (N)"),
            ("exact_peak_force", "exact law: force (N)"),
            ("reference_percent", "excess, reference (%)"),
            ("percent", "excess (%)"),
        ],
        lines,
    })
}

/// IMPACT with the dashpot that returns a restitution.
fn tuned(stiffness: f64, restitution: f64) -> Result<CollisionOutcome, VerificationError> {
    // The restitution falls as the dashpot grows.
    let (mut low, mut high) = (0.0, 1.0e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if adams_impact(stiffness, middle)?.restitution > restitution {
            low = middle;
        } else {
            high = middle;
        }
    }
    Ok(adams_impact(stiffness, 0.5 * (low + high))?)
}

fn findings() -> Vec<String> {
    [
        "The numbers of the paper's table 1 are lost, so these are computed values beside independent references; only 2.94 delta_max / v0 can be held against print, and it agrees.",
        "That the maximum penetration does not depend on e holds for the explicit form alone: it takes the speed from the elastic trajectory. Integrated, the same law penetrates 6 to 14 % less, hits 10 to 21 % softer, and returns 0.68 for 0.3.",
        "The paper finds IMPACT adequate above e = 0.7 and poor below. Tuned to the restitution, its peak exceeds that of the exact law by 1.8 % at 0.8, 3.6 % at 0.7, 7.6 % at 0.5 and 12 % at 0.3: there is no edge at 0.7, and what is poor is a dashpot that was not tuned.",
        "The recommended c_max of 0.1 to 1 % of k is a ratio of numbers in N, mm and s. It returns 0.23 to 0.04 here, so 0.3 to 0.8 lie outside it: 0.8 needs 0.0068 %. Taken in SI the same percentage means a dashpot 31.6 times as strong.",
    ]
    .map(str::to_owned)
    .to_vec()
}
