//! Inputs stay inputs when the working folder is another one.
#![allow(clippy::unwrap_used)]

use std::path::Path;

use pounding::prelude::*;

/// A result takes the place of neither case nor record that were read under relative paths from
/// another folder.
#[test]
fn inputs_are_known_after_a_change_of_folder() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folder = tempfile::tempdir().unwrap();
    let case = std::fs::read_to_string(root.join("examples/three_storey_pair/case.toml")).unwrap();
    let case = case.replace("../../ground_motions/el_centro_1940_ns.csv", "record.csv");
    std::fs::write(folder.path().join("case.toml"), case).unwrap();
    let record = root.join("ground_motions/el_centro_1940_ns.csv");
    std::fs::copy(record, folder.path().join("record.csv")).unwrap();
    std::fs::create_dir(folder.path().join("below")).unwrap();

    std::env::set_current_dir(folder.path()).unwrap();
    let of_file = Model::read("case.toml").unwrap();
    let motion = GroundMotion::read("record.csv").unwrap();
    std::env::set_current_dir("below").unwrap();
    let storey = Storey {
        mass: Mass::tonnes(25.0),
        stiffness: Stiffness::meganewtons_per_metre(3.46),
        height: Length::metres(3.0),
    };
    let damping = Damping::StiffnessProportional { ratio: 0.05 };
    let building = Building::shear("a").storeys(1, storey).damping(damping);
    let by_code = Simulation::of([building]).ground_motion(motion).build();
    let by_code = by_code.unwrap();
    for (model, input) in [
        (&of_file, "../case.toml"),
        (&of_file, "../record.csv"),
        (&by_code, "../record.csv"),
    ] {
        let before = std::fs::read(input).unwrap();
        let error = model.run_to_file(input).unwrap_err();
        assert!(matches!(error, Error::FileUse(_)), "{error}");
        assert!(std::fs::read(input).unwrap() == before);
    }
    std::env::set_current_dir("/").unwrap();
}
