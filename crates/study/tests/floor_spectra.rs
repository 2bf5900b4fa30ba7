//! Response spectra of floors, called as a library.
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

/// The peak of a stiff oscillator on the frame alone is early, and stays what it is when the run goes on over more than half
/// a million pieces: there round-off of the time made pieces of its own, and 12.61 g of 0.3546 g.
#[test]
fn spectra_of_many_pieces_are_those_of_few() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/three_storey_pair");
    let file = example.join("case.toml");
    let text = std::fs::read_to_string(&file).unwrap();
    let found = ["8 s", "31 s"].map(|duration| {
        let text = text.replace("duration = \"31 s\"", &format!("duration = \"{duration}\""));
        let case = pounding_case::Case::parse(&text, &file).unwrap();
        let assembly = pounding_assembly::assemble(&case).unwrap();
        let floors = [floor_above(&assembly.system, "light", "3").unwrap()];
        let periods: &[f64] = &[0.002];
        let wanted = FloorSpectraWanted {
            floors: &floors,
            periods,
            dampings: &[0.05],
        };
        let made = floor_spectra(&assembly, wanted, &[periods], &mut |_| {
            ControlFlow::Continue(())
        });
        let (found, _) = made.unwrap();
        let spectrum = &found[0].floors[0].spectra[0];
        let alone = spectrum.alone.as_ref().unwrap();
        [alone.acceleration[0], spectrum.pounding.acceleration[0]]
    });
    let [short, long] = &found;
    // By an independent recurrence (Nigam and Jennings) over rows of the run.
    assert!((short[0] / 9.806_65 - 0.3546).abs() < 2e-4, "{short:?}");
    assert!((short[1] / 9.806_65 - 5.563).abs() < 2e-3, "{short:?}");
    for (short, long) in short.iter().zip(long) {
        assert!((long / short - 1.0).abs() < 1e-9, "{short} {long}");
    }
}
