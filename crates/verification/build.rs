//! Finds the record of the cases: in the repository that of `ground_motions`, in a package the file
//! that Cargo put in the place of the link in `records`. A checkout without links, as on Windows,
//! has a text there instead.

use std::path::Path;

fn main() -> std::io::Result<()> {
    let manifest = std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let own = Path::new(&manifest);
    let places = [
        own.join("../../ground_motions/el_centro_1940_ns.csv"),
        own.join("records/el_centro_1940_ns.csv"),
    ];
    for place in &places {
        println!("cargo::rerun-if-changed={}", place.display());
    }
    let place = places.iter().find(|place| place.is_file());
    let place = place.ok_or_else(|| std::io::Error::other("records holds no record"))?;
    println!(
        "cargo::rustc-env=POUNDING_EL_CENTRO={}",
        place.canonicalize()?.display()
    );
    Ok(())
}
