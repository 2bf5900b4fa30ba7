//! Which crate may import which: the table of CONTRIBUTING.md, from the bottom up, against
//! what cargo resolves.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

use super::{metadata, root};

/// Names and dependencies (normal and build) of the packages that cargo resolves.
struct Packages(BTreeMap<String, BTreeSet<String>>);

impl Packages {
    fn resolved() -> Self {
        // What other platforms need would be downloaded.
        let rustc = Command::new("rustc").arg("-vV").output().unwrap();
        let rustc = String::from_utf8(rustc.stdout).unwrap();
        let host = rustc.lines().find_map(|l| l.strip_prefix("host: "));
        let platform = format!("--filter-platform={}", host.unwrap());
        let metadata = metadata(&["--locked", &platform]);
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let packages = metadata["packages"].as_array().unwrap();
        let name: BTreeMap<String, String> = packages
            .iter()
            .map(|p| (text(&p["id"]), text(&p["name"])))
            .collect();
        let nodes = metadata["resolve"]["nodes"].as_array().unwrap();
        let needed = |node: &Value| -> BTreeSet<String> {
            let all = node["deps"].as_array().unwrap().iter();
            let is_for_tests = |kind: &Value| kind["kind"] == "dev";
            all.filter(|d| !d["dep_kinds"].as_array().unwrap().iter().all(is_for_tests))
                .map(|d| name[&text(&d["pkg"])].clone())
                .collect()
        };
        let nodes = nodes
            .iter()
            .map(|n| (name[&text(&n["id"])].clone(), needed(n)));
        let mut all: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
        for (package, needs) in nodes {
            // Two versions of one crate count as one.
            all.entry(package).or_default().extend(needs);
        }
        Self(all)
    }

    /// All that a package needs, and what these need.
    fn tree(&self, package: &str) -> BTreeSet<String> {
        let mut found = BTreeSet::new();
        let mut open = vec![package.to_owned()];
        while let Some(next) = open.pop() {
            for needed in &self.0[&next] {
                if found.insert(needed.clone()) {
                    open.push(needed.clone());
                }
            }
        }
        found
    }
}

/// Crates in the order of the table.
fn table() -> Vec<String> {
    let text = std::fs::read_to_string(root().join("CONTRIBUTING.md")).unwrap();
    let rows = text.lines().filter_map(|l| l.strip_prefix("| `crates/"));
    rows.map(|row| row.split('`').next().unwrap().to_owned())
        .collect()
}

#[test]
fn imports_point_upwards_in_the_table() {
    let table = table();
    let folders = std::fs::read_dir(root().join("crates")).unwrap();
    let folders: BTreeSet<String> = folders
        .map(|f| f.unwrap().file_name().into_string().unwrap())
        .collect();
    assert_eq!(
        folders,
        table.iter().cloned().collect(),
        "crates in the table"
    );
    let packages = Packages::resolved();
    let package = |folder: &str| match folder {
        "pounding" => folder.to_owned(),
        other => format!("pounding-{other}"),
    };
    for (place, folder) in table.iter().enumerate() {
        let needs = &packages.0[&package(folder)];
        for other in &table[place..] {
            assert!(
                !needs.contains(&package(other)),
                "crates/{folder} imports crates/{other}, which stands below it"
            );
        }
    }
}

/// A module with children lies in its `mod.rs`, beside them, and not above them under the name of their folder.
#[test]
fn modules_with_children_lie_in_mod_rs() {
    let mut folders = vec![root().join("crates")];
    let mut looked_at = 0;
    while let Some(folder) = folders.pop() {
        let beside = folder.with_extension("rs");
        assert!(!beside.exists(), "{} and a folder", beside.display());
        looked_at += 1;
        let entries = std::fs::read_dir(&folder).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path());
        folders.extend(paths.filter(|path| path.is_dir()));
    }
    assert!(looked_at > 150, "{looked_at}");
}

#[test]
fn the_solver_needs_no_files() {
    let tree = Packages::resolved().tree("pounding-time-history");
    assert!(tree.contains("pounding-gap-element"), "{tree:?}");
    for none in [
        "hdf5-metno",
        "hdf5-metno-sys",
        "toml",
        "csv",
        "parquet",
        "serde_json",
        "pounding-case",
        "pounding-files",
        "pounding-ground-motion",
    ] {
        assert!(!tree.contains(none), "the solver needs {none}");
    }
}

/// Features with which a package is compiled, by what cargo builds of the whole workspace (`cargo metadata` knows more, of
/// dependencies that are left out).
fn features(package: &str) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--locked", "--workspace"])
        .args(["-e", "features", "-i", package])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let tree = String::from_utf8(output.stdout).unwrap();
    assert!(tree.starts_with(package), "{tree}");
    let named = format!("{package} feature \"");
    tree.lines()
        .filter_map(|l| l.split_once(&named)?.1.split('"').next())
        .map(str::to_owned)
        .collect()
}

/// Libraries that take other instructions where the processor has them round otherwise there: nalgebra's products of matrices
/// with its feature `std`, which are fused multiply-adds of `matrixmultiply`; rustfft has its sines from the C library.
/// `scripts/processors` compares results.
#[test]
fn no_library_rounds_as_the_processor_likes() {
    let expected = ["alloc", "libm-force"].map(str::to_owned);
    assert_eq!(features("nalgebra"), BTreeSet::from(expected));
    let packages = Packages::resolved();
    for none in ["rustfft", "faer", "pulp", "gemm"] {
        assert!(!packages.0.contains_key(none), "{none}");
    }
}

/// Packages of the repository that are no libraries.
const NOT_PUBLISHED: [&str; 7] = [
    "pounding-book",
    "pounding-cli",
    "pounding-explorer",
    "pounding-explorer-page",
    "pounding-python",
    "verification",
    "benchmarks",
];

/// `cargo package` refuses a dependency in a folder without a version, and with another version
/// the study's build text would not name the sources of the crates it is built of.
#[test]
fn libraries_can_be_packaged() {
    let metadata = metadata(&["--no-deps"]);
    let mut libraries = 0;
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        let published = package["publish"].is_null();
        assert_eq!(published, !NOT_PUBLISHED.contains(&name), "{name}");
        if !published {
            continue;
        }
        libraries += 1;
        assert!(package["description"].is_string(), "{name}");
        assert!(package["license"].is_string(), "{name}");
        let exactly = format!("={}", package["version"].as_str().unwrap());
        for dependency in package["dependencies"].as_array().unwrap() {
            if !dependency["path"].is_null() {
                let needed = &dependency["name"];
                assert_eq!(dependency["req"], exactly, "{name} needs {needed}");
            }
        }
    }
    let of_the_table = NOT_PUBLISHED.iter().filter(|n| n.starts_with("pounding-"));
    assert_eq!(libraries + of_the_table.count(), table().len());
}
