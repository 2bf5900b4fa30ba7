//! Ductilities and residual drifts in studies and comparisons.
use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::Case;
use pounding_files::checksum::WithoutChecksum;
use pounding_study::comparison::{
    Comparison, ComparisonOptions, QuantityKind, RestitutionRule, StiffnessRule, compare,
};
use pounding_study::gap_check::{UNWATCHED, under_records};
use pounding_study::{Ending, ResultReader, Study, case_of_run};
use pounding_time_history::{Outcome, YieldingStorey, run};

use crate::studies::{root, rows};

/// A light building of which two storeys yield, and a heavy one that stays linear, for six seconds.
fn case(folder: &Path) -> Case {
    let text = std::fs::read_to_string(root().join("examples/yielding_pair/case.toml")).unwrap();
    let records = root().join("ground_motions");
    let text = text
        .replace("../../ground_motions", records.to_str().unwrap())
        .replace("31 s", "6 s")
        .replace(
            "law = { model = \"elastic_perfectly_plastic\", yield_force = \"14.42 MN\" }\n",
            "",
        )
        .replace(
            "law = { model = \"elastic_perfectly_plastic\",",
            "law = { storeys = [1, 2], model = \"elastic_perfectly_plastic\",",
        );
    let file = folder.join("case.toml");
    std::fs::write(&file, &text).unwrap();
    Case::parse(&text, &file).unwrap()
}

/// Ductility and residual drift ratio of every storey, from the bottom.
fn of_storeys(outcome: &Outcome) -> [Vec<f64>; 2] {
    let laws = || outcome.buildings.iter().flat_map(|b| &b.yielding);
    let ductility = |law: &Option<YieldingStorey>| {
        law.and_then(|law| law.ductility)
            .map_or(f64::NAN, |d| d.value)
    };
    let residual = |law: &Option<YieldingStorey>| law.map_or(0.0, |law| law.residual_drift_ratio);
    [
        laws().map(ductility).collect(),
        laws().map(residual).collect(),
    ]
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|x| x.to_bits()).collect()
}

/// Those of a study are those of runs of its cases, with pounding and without; linear storeys have no ductility and keep
/// no drift.
#[test]
fn studies_hold_what_runs_say_of_storeys_that_yield() {
    let folder = tempfile::tempdir().unwrap();
    case(folder.path());
    let text = "case = \"case.toml\"\n[output]\nisolated_peaks = true\n[[variable]]\nname = \"gap\"\npath = \"gap.0.width\"\nvalues = [0.01, 0.03]\n[[variable]]\nname = \"force\"\npath = \"building.light.law.yield_force\"\nvalues = [\"90 kN\", \"400 MN\"]\n";
    let study = Study::parse(text, &folder.path().join("study.toml")).unwrap();
    let rows = rows(&study, folder.path());
    let result = folder.path().join("out.h5");
    let reader = ResultReader::open(&result, WithoutChecksum::Refuse).unwrap();
    let layout = &reader.description.layout;
    let mut amplified = 0;
    for (row, _) in &rows {
        assert_eq!(row.ending, Ending::Complete);
        let text = case_of_run(&study, row.run).unwrap();
        let case = Case::parse(&text, &folder.path().join("case.toml")).unwrap();
        let assembly = assemble(&case).unwrap();
        let [pounding, alone] = [&assembly.system, &assembly.system.without_gaps()].map(|system| {
            let outcome = run(system, &assembly.options, &mut [], &mut |_| {});
            of_storeys(&outcome.unwrap())
        });
        let names = ["peak_ductility", "residual_drift_ratio"];
        for (name, (pounding, alone)) in names.iter().zip(pounding.iter().zip(&alone)) {
            let of = |name: &str| bits(&row.values[layout.range(name)]);
            assert_eq!(of(name), bits(pounding), "{name}");
            assert_eq!(of(&format!("isolated_{name}")), bits(alone), "{name}");
        }
        let ductility = &pounding[0];
        assert!(ductility[2..].iter().all(|d| d.is_nan()), "{ductility:?}");
        assert_eq!(pounding[1][2..], [0.0; 4]);
        amplified += usize::from(ductility[0] > 1.0 && pounding[0][0] != alone[0][0]);
    }
    // The weak building yields at both widths, the strong one at none.
    assert_eq!(amplified, 2);

    // One that is chosen.
    let chosen = text.replace(
        "isolated_peaks = true",
        "quantities = [\"isolated_peak_ductility\"]",
    );
    let study = Study::parse(&chosen, &folder.path().join("study.toml")).unwrap();
    self::rows(&study, folder.path());
    let reader = ResultReader::open(&result, WithoutChecksum::Refuse).unwrap();
    let layout = &reader.description.layout;
    assert_eq!(layout.quantities.len(), 1);
    assert_eq!(layout.range("isolated_peak_ductility"), 0..6);
}

/// A comparison has them of the building that yields, over its storeys; what round-off leaves of elastic ones is none. At a
/// gap that nobody closes they are those of a run, and drifts those above isolators.
#[test]
fn comparisons_have_them_of_buildings_that_yield() {
    let folder = tempfile::tempdir().unwrap();
    case(folder.path());
    let file = folder.path().join("case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let wide = text.replace("\"20 mm\"", "\"2 m\"");
    for (force, yields) in [("90 kN", true), ("400 MN", false)] {
        let case = Case::parse(&wide.replace("136.9 kN", force), &file).unwrap();
        let (comparison, outcome) = compared(&case);
        let of = |kind| value(&comparison, kind, "light");
        let [ductility, residual] = of_storeys(&outcome);
        let most = ductility.iter().copied().fold(0.0, f64::max);
        assert_eq!(of(QuantityKind::Ductility), Some(most));
        assert_eq!(most > 1.0, yields);
        let most = residual.iter().map(|r| r.abs()).fold(0.0, f64::max);
        assert_eq!(of(QuantityKind::ResidualDriftRatio), Some(most));
        // Round-off leaves nothing of an elastic storey.
        assert_eq!(most != 0.0, yields);
        assert_eq!(value(&comparison, QuantityKind::Ductility, "heavy"), None);
    }
    let file = root().join("examples/isolated_building/case.toml");
    let isolated = std::fs::read_to_string(&file).unwrap();
    let case = Case::parse(&isolated, &file).unwrap();
    let (comparison, outcome) = compared(&case);
    let index = case.buildings.iter().position(|b| b.isolator.is_some());
    let building = &outcome.buildings[index.unwrap()];
    let drifts: Vec<f64> = building
        .storeys
        .iter()
        .map(|s| s.drift_ratio.value)
        .collect();
    let above = drifts[1..].iter().copied().fold(0.0, f64::max);
    assert!(above < drifts[0], "{drifts:?}");
    let found = value(&comparison, QuantityKind::DriftRatio, &building.name).unwrap();
    assert!(found < drifts[0], "{found}, {drifts:?}");
    assert_eq!(
        value(&comparison, QuantityKind::Ductility, &building.name),
        None
    );
}

/// What the model of the case does in a comparison, and in a run.
fn compared(case: &Case) -> (Comparison, Outcome) {
    let options = ComparisonOptions {
        models: vec![case.gaps[0].model.value.clone()],
        stiffness_rule: StiffnessRule::Penetration,
        restitution_rule: RestitutionRule::AsPublished,
        restitution: None,
        approach_velocity: Some(0.3),
        threads: 1,
    };
    let records = under_records(case, &[]).unwrap();
    let assembly = assemble(case).unwrap();
    let outcome = run(&assembly.system, &assembly.options, &mut [], &mut |_| {});
    (
        compare(case, &records, &options, UNWATCHED).unwrap(),
        outcome.unwrap(),
    )
}

fn value(comparison: &Comparison, kind: QuantityKind, of: &str) -> Option<f64> {
    let mut quantities = comparison.quantities.iter();
    let quantity = quantities.position(|q| q.kind == kind && q.of == of)?;
    Some(comparison.value(0, 0, quantity))
}
