//! Response spectra of floors, called as a library.
#![allow(clippy::unwrap_used)]

use std::ops::ControlFlow;
use std::path::Path;

use pounding_study::floor_spectra::{
    FloorMotions, FloorSpectraError, FloorSpectraWanted, floor_above, roofs,
};

/// What is stiff feels the impacts; what swings with the building feels less than without them. Who does not want a run any
/// more ends it.
#[test]
fn roofs_of_the_three_storey_pair() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/three_storey_pair");
    let file = example.join("case.toml");
    let case = pounding_case::Case::parse(&std::fs::read_to_string(&file).unwrap(), &file).unwrap();
    let assembly = pounding_assembly::assemble(&case).unwrap();
    let roofs = roofs(&assembly.system);
    assert_eq!(
        roofs[0],
        floor_above(&assembly.system, "light", "3").unwrap()
    );
    let periods = [0.05, 1.2];
    let wanted = FloorSpectraWanted {
        floors: &roofs,
        periods: &periods,
        dampings: &[0.05],
    };
    let motions = FloorMotions::new(&assembly, wanted, &mut |_| ControlFlow::Continue(())).unwrap();
    let mut parts = Vec::new();
    let found = motions.spectra(&periods, &mut |part| {
        parts.push(part);
        ControlFlow::Continue(())
    });
    let found = found.unwrap();
    assert!(parts.is_sorted() && parts.last() == Some(&1.0), "{parts:?}");
    let stopped = motions.spectra(&periods, &mut |_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(FloorSpectraError::Stopped)));
    // Each period by itself, however many are asked for at once.
    let many: Vec<f64> = (1..40).map(|i| 0.05 * f64::from(i)).collect();
    let goes_on = &mut |_| ControlFlow::Continue(());
    let all = motions.spectra(&many, goes_on).unwrap();
    let one = motions.spectra(&many[37..38], goes_on).unwrap();
    let [all, one] = [&all, &one].map(|s| &s.floors[0].spectra[0].pounding);
    assert_eq!(
        (all.periods.len(), all.acceleration[37]),
        (39, one.acceleration[0])
    );
    let light = &found.floors[0].spectra[0];
    let alone = light.alone.as_ref().unwrap();
    assert!(light.pounding.acceleration[0] > 20.0 * alone.acceleration[0]);
    assert!(light.pounding.acceleration[1] < 0.5 * alone.acceleration[1]);
    let stopped = FloorMotions::new(&assembly, wanted, &mut |_| ControlFlow::Break(()));
    assert!(matches!(stopped, Err(FloorSpectraError::Stopped)));
}
