//! Response spectra of floors, called as a library.
#![allow(clippy::unwrap_used)]

use std::ops::ControlFlow;
use std::path::Path;

use pounding_study::floor_spectra::{
    FloorSpectraError, FloorSpectraWanted, floor_above, floor_spectra, roofs,
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
    let mut parts = Vec::new();
    // Each period by itself, however many are asked for at once.
    let many: Vec<f64> = (1..40).map(|i| 0.05 * f64::from(i)).collect();
    let lists: [&[f64]; 3] = [&periods, &many, &many[37..38]];
    let made = floor_spectra(&assembly, wanted, &lists, &mut |part| {
        parts.push(part);
        ControlFlow::Continue(())
    });
    let (found, none) = made.unwrap();
    assert_eq!(none, None);
    assert!(parts.is_sorted() && (parts[parts.len() - 1] - 1.0).abs() < 1e-12);
    let [found, all, one] = &found[..] else {
        panic!("{} lists", found.len());
    };
    let [all, one] = [all, one].map(|s| &s.floors[0].spectra[0].pounding);
    assert_eq!(
        (all.periods.len(), all.acceleration[37]),
        (39, one.acceleration[0])
    );
    let light = &found.floors[0].spectra[0];
    let alone = light.alone.as_ref().unwrap();
    assert!(light.pounding.acceleration[0] > 20.0 * alone.acceleration[0]);
    assert!(light.pounding.acceleration[1] < 0.5 * alone.acceleration[1]);
    // In the runs, and in the spectra.
    for end in [0.0, 0.5] {
        let stopped = floor_spectra(&assembly, wanted, &[&many], &mut |part| match part < end {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        });
        assert!(matches!(stopped, Err(FloorSpectraError::Stopped)));
    }
}
