//! Cases whose files are given as bytes: the systems that the same files on a disk make, and the
//! same words where one is missing or wrong.

use std::path::Path;

use pounding_assembly::assemble;
use pounding_case::{Case, GivenFiles};

/// Every example: records, matrices, target spectra and forces among their files.
#[test]
fn systems_are_those_of_files_on_a_disk() {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let (mut cases, mut kinds) = (0, Vec::new());
    for entry in std::fs::read_dir(&examples).unwrap() {
        let path = entry.unwrap().path().join("case.toml");
        if !path.is_file() {
            continue;
        }
        let case = Case::read(&path).unwrap();
        let mut given = GivenFiles::default();
        for (what, file) in case.named_files() {
            given.insert(file, std::fs::read(case.resolve(file)).unwrap());
            kinds.push(what);
        }
        let in_memory = Case {
            given_files: Some(given),
            ..case.clone()
        };
        let [on_disk, in_memory] = [case, in_memory].map(|case| {
            let made = assemble(&case).unwrap();
            format!(
                "{:?} {:?} {:?}",
                made.system, made.options, made.accelerogram
            )
        });
        assert_eq!(on_disk, in_memory, "{}", path.display());
        cases += 1;
    }
    assert!(cases > 10, "{cases}");
    for kind in ["record", "matrix"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
}

#[test]
fn what_was_not_given_is_missing() {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/three_storey_pair/case.toml");
    let mut case = Case::read(&path).unwrap();
    let mut given = GivenFiles::default();
    given.insert("other.csv", *b"1,2");
    case.given_files = Some(given.clone());
    let refused = assemble(&case).unwrap_err().to_string();
    assert!(refused.ends_with("this file was not given"), "{refused}");
    // By its name alone a file is found too, and refused as one on a disk is.
    given.insert("el_centro_1940_ns.csv", *b"1,2");
    case.given_files = Some(given);
    let refused = assemble(&case).unwrap_err().to_string();
    assert!(refused.contains("el_centro_1940_ns.csv"), "{refused}");
    assert!(!refused.contains("not given"), "{refused}");
}
